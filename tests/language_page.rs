//! `docs/language.md` lists the vocabulary: its second half is made from it.
//!
//! `LUCARNE_UPDATE=1 cargo test language_page` writes it anew.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use lucarne::vocabulary::{Family, PREDECLARED, Word};

const MARK: &str =
    "<!-- From here on this page is made from src/vocabulary by tests/language_page.rs. -->\n";

fn title(family: Family) -> &'static str {
    match family {
        Family::Directive => "Directives",
        Family::Shape => "Shapes",
        Family::ShapeItem => "Parts of shapes",
        Family::Csg => "Several objects as one",
        Family::Modifier => "Modifiers of objects",
        Family::Transform => "Transforms",
        Family::Texture => "Textures",
        Family::Pattern => "Patterns",
        Family::PatternItem => "Parts of patterns",
        Family::FinishItem => "Finish",
        Family::Color => "Colours",
        Family::Camera => "Camera",
        Family::Light => "Lights",
        Family::Interior => "Interiors and media",
        Family::Atmosphere => "Background, sky, atmosphere",
        Family::Setting => "Settings",
        Family::FloatFunction => "Functions that give a number",
        Family::VectorFunction => "Functions that give a vector",
        Family::StringFunction => "Functions that give a string",
        Family::Constant => "Constants",
        Family::Definition => "Functions and arrays",
        Family::FileKind => "Kinds of files",
    }
}

fn words() -> String {
    let mut families: Vec<Family> = Word::ALL.iter().map(|word| word.family()).collect();
    families.dedup();
    families.sort();
    families.dedup();
    let mut page = String::from(
        "\n## The words\n\n### Names that have a value from the start\n\n| name | means |\n|---|---|\n",
    );
    for (name, sentence) in PREDECLARED {
        let _ = writeln!(page, "| `{name}` | {sentence} |");
    }
    for family in families {
        let words = || Word::ALL.iter().filter(move |word| word.family() == family);
        let _ = write!(page, "\n### {}\n\n", title(family));
        let rows = |page: &mut String, wanted: fn(&Word) -> bool| {
            for word in words().filter(|word| wanted(word)) {
                let sentence = word.sentence().replace('|', "\\|");
                let _ = writeln!(page, "| `{}` | {sentence} |", word.name());
            }
        };
        let built = words().any(|word| word.is_built());
        if built {
            page.push_str("| word | means |\n|---|---|\n");
            rows(&mut page, |word| word.is_built() && !word.is_inert());
        }
        if words().any(|word| word.is_inert()) {
            let gap = if built { "\n" } else { "" };
            let _ = write!(
                page,
                "{gap}Read and checked, and without effect on any picture:\n\n| word | says |\n|---|---|\n"
            );
            rows(&mut page, |word| word.is_inert());
        }
        let old: Vec<String> = words()
            .filter_map(|word| Some((word, word.today()?)))
            .map(|(word, today)| format!("`{}`, today `{}`", word.name(), today.name()))
            .collect();
        if !old.is_empty() {
            let gap = if built { "\n" } else { "" };
            let _ = writeln!(page, "{gap}Of old versions: {}.", old.join("; "));
        }
        let later: Vec<String> = words()
            .filter(|word| !word.is_built() && word.today().is_none())
            .map(|word| format!("`{}`", word.name()))
            .collect();
        if !later.is_empty() {
            let gap = if built { "\n" } else { "" };
            let _ = writeln!(page, "{gap}Known, and not built yet: {}.", later.join(", "));
        }
    }
    page
}

#[test]
fn the_page_of_the_language_lists_every_word_as_the_vocabulary_has_it() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/language.md");
    let page = fs::read_to_string(&path).expect("docs/language.md is there");
    let (before, after) = page.split_once(MARK).expect("the page has its mark");
    let expected = words();
    if std::env::var_os("LUCARNE_UPDATE").is_some() {
        fs::write(&path, format!("{before}{MARK}{expected}")).expect("writable");
        return;
    }
    assert!(
        after == expected,
        "docs/language.md is out of date: LUCARNE_UPDATE=1 cargo test language_page"
    );
}
