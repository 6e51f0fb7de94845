//! Checks what the README and the pages in `docs` quote: scenes, messages, output, tables and links.

use std::path::Path;

use lucarne::diagnostic::render::{Style, human};
use lucarne::pilot::pilot;
use lucarne::plan::{Antialias, Frame, PlanOptions, plan, print};
use lucarne::road::{Options, Road};
use lucarne::scene::Dialect;
use lucarne::source::NoFiles;

/// Returns the contents of the fenced blocks of `kind` on `page`, in order.
fn blocks<'a>(page: &'a str, kind: &str) -> Vec<&'a str> {
    let start = format!("```{kind}\n");
    let rests = page.split(start.as_str()).skip(1);
    rests.map(|rest| rest.split_once("```").expect("the block ends").0).collect()
}

/// Compiles a scene of the README and returns its messages as the command prints them.
fn messages(name: &str, scene: &str) -> Vec<String> {
    let mut road = Road::new(&NoFiles, Options::new(Dialect::Scene));
    road.compile(name, scene.as_bytes().to_vec());
    let messages = road.diagnostics.iter();
    messages.map(|message| human(message, &road.sources, Style::PLAIN)).collect()
}

#[test]
fn the_readmes_first_scene_has_no_mistakes() {
    let scene = blocks(include_str!("../README.md"), "scene")[0];
    assert_eq!(scene.lines().count(), 10);
    let messages = messages("ring.scene", scene);
    assert!(messages.is_empty(), "{}", messages.join("\n"));
}

#[test]
fn the_readmes_broken_scene_is_told_what_the_readme_says() {
    let page = include_str!("../README.md");
    let (scene, said) = (blocks(page, "scene")[1], blocks(page, "text")[0]);
    let messages = messages("ball.scene", scene);
    assert_eq!(messages.len(), 2, "{}", messages.join("\n"));
    assert_eq!(messages[0].trim(), said.trim());
}

#[test]
fn the_plan_of_the_first_picture_is_what_the_pages_say() {
    let name = "scenes/gallery/first.scene";
    let mut road = Road::new(&NoFiles, Options::new(Dialect::Scene));
    let bytes = std::fs::read(name).expect("the scene is there");
    let (world, origins) = road.compile(name, bytes);
    let (frame, antialias) = (Frame::whole(640, 480), Antialias::default());
    let mut plan = plan(&world, &origins, &PlanOptions { antialias, ..PlanOptions::new(frame) });
    pilot(&world, &mut plan);
    let said = print::dump(&plan, &road.sources);
    let page = include_str!("../docs/effects.md");
    assert!(page.contains(&format!("```text\n{said}```\n")), "{said}");
    // The README quotes some lines of it, as they follow each other.
    let excerpt = blocks(include_str!("../README.md"), "text")[1];
    assert!(excerpt.lines().count() >= 5, "{excerpt}");
    assert!(said.contains(&format!("\n{excerpt}")), "{said}");
}

#[test]
fn the_readmes_row_of_numbers_is_one_of_the_page_on_numerics() {
    let row = "\n| sphere | 1e6 | ";
    let page = include_str!("../README.md");
    let from = page.find(row).expect("the row is there") + 1;
    let row = page[from..].lines().next().expect("a line");
    assert!(include_str!("../docs/numerics.md").lines().any(|line| line == row), "{row}");
}

#[test]
fn every_link_of_a_page_leads_somewhere() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut pages = vec![root.join("README.md")];
    let docs = std::fs::read_dir(root.join("docs")).expect("docs are there");
    pages.extend(docs.map(|entry| entry.expect("readable").path()).filter(|path| path.is_file()));
    let mut dead = Vec::new();
    for page in pages {
        let text = std::fs::read_to_string(&page).expect("readable");
        // A scene has no links.
        let text: Vec<&str> = text.split("```").step_by(2).collect();
        let text = text.concat();
        let markdown = text.split("](").skip(1).filter_map(|rest| rest.split(')').next());
        let html = text.split(" src=\"").skip(1).filter_map(|rest| rest.split('"').next());
        for link in markdown.chain(html) {
            let path = link.split('#').next().unwrap_or("");
            let folder = page.parent().expect("a folder");
            if !link.contains("://") && !path.is_empty() && !folder.join(path).exists() {
                dead.push(format!("{}: {link}", page.display()));
            }
        }
    }
    assert!(dead.is_empty(), "{dead:#?}");
}

/// The table of `lucarne accuracy` on a page.
fn accuracy_table(page: &str) -> &str {
    let at = page.find("\nscenes/gallery/first.scene ").expect("the table is there");
    let from = page[..at].rfind("```text\n").expect("its beginning");
    &page[from..from + 8 + page[from + 8..].find("```").expect("it ends")]
}

#[test]
fn the_table_of_accuracy_and_the_diagram_are_of_one_run() {
    let table = accuracy_table(include_str!("../docs/accuracy.md"));
    assert!(include_str!("../README.md").contains("](docs/images/first-accuracy.svg)"));
    let svg = include_str!("../docs/images/first-accuracy.svg");
    let mut knob = "";
    let mut settings = 0;
    for line in table.lines().skip_while(|line| !line.contains("setting  ")).skip(1) {
        // Below the table is an empty line.
        if line.is_empty() {
            break;
        }
        // A knob has a line of its own; what was not timed has no columns.
        let Some(rest) = line.strip_prefix("  ").or(line.strip_prefix("* ")) else {
            knob = line;
            continue;
        };
        if rest.starts_with("not tried") || rest.starts_with("the same") || rest.starts_with(' ') {
            continue;
        }
        let (label, rest) = rest.split_once("  ").expect("columns");
        let cpu = rest.split_whitespace().next().expect("seconds");
        let title = format!("<title>{knob} {label}: ");
        let said = svg.split(&title).nth(1).unwrap_or_else(|| panic!("{title} is not drawn"));
        let (span, error) = said.split_once(" s, ").expect("seconds and an error");
        assert_eq!(span.split("..").nth(1), Some(cpu), "{line}");
        let error = error.split("</title>").next().expect("its end").replace("&lt;", "<");
        assert!(line.contains(&format!(" {error} [")), "{line}: {error}");
        settings += 1;
    }
    assert_eq!(svg.matches(" s, ").count(), settings);
    assert!(settings > 10);
    assert!(table.lines().all(|line| line.chars().count() <= 100), "{table}");
}
