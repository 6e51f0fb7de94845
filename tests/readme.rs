//! The README's broken scene is told what the README says.

use lucarne::diagnostic::render::{Style, human};
use lucarne::road::{Options, Road};
use lucarne::scene::Dialect;
use lucarne::source::NoFiles;

fn block<'a>(page: &'a str, kind: &str) -> &'a str {
    let start = format!("```{kind}\n");
    let from = page.find(&start).expect("the block is there") + start.len();
    let length = page[from..].find("```").expect("the block ends");
    &page[from..from + length]
}

#[test]
fn the_readmes_broken_scene_is_told_what_the_readme_says() {
    let page = include_str!("../README.md");
    let (scene, said) = (block(page, "scene"), block(page, "text"));
    let mut road = Road::new(&NoFiles, Options::new(Dialect::Scene));
    road.compile("ball.scene", scene.as_bytes().to_vec());
    let messages: Vec<String> = road
        .diagnostics
        .iter()
        .map(|message| human(message, &road.sources, Style::PLAIN))
        .collect();
    assert_eq!(messages.len(), 2, "{}", messages.join("\n"));
    assert_eq!(messages[0].trim(), said.trim());
}
