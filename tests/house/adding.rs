//! `docs/adding.md` says which files a thing has: they are there, for each thing that there is.

use std::collections::BTreeMap;
use std::fs;

use lucarne::diagnostic::Code;
use lucarne::vocabulary::{Family, Word};

use super::{assert_none, root};

/// The page's parts, by their titles.
fn sections(page: &str) -> Vec<(&str, &str)> {
    page.split("\n## ").skip(1).filter_map(|section| section.split_once('\n')).collect()
}

/// What stands between backticks.
fn quoted(text: &str) -> impl Iterator<Item = &str> {
    text.split('`').skip(1).step_by(2)
}

/// What is in a file of another name: "* `triangle` and `mesh2` are `mesh`."
fn other_names(section: &str) -> BTreeMap<&str, &str> {
    let mut names = BTreeMap::new();
    for line in section.lines().filter_map(|line| line.strip_prefix("* ")) {
        let all: Vec<&str> = quoted(line.split(':').next().unwrap_or(line)).collect();
        if let Some((file, words)) = all.split_last() {
            names.extend(words.iter().map(|word| (*word, *file)));
        }
    }
    names
}

fn is_there(path: &str) -> bool {
    let folder = path.strip_suffix(".rs").map(|name| format!("{name}/mod.rs"));
    [Some(path.to_owned()), folder].iter().flatten().any(|path| root().join(path).exists())
}

fn built(family: Family) -> Vec<&'static str> {
    let words = Word::ALL.iter().filter(|word| word.is_built() && word.family() == family);
    words.map(|word| word.name()).collect()
}

#[test]
fn the_page_on_adding_is_true_for_each_shape_pattern_and_message() {
    let page = fs::read_to_string(root().join("docs/adding.md")).expect("readable");
    let mut faults = Vec::new();
    for (title, section) in sections(&page) {
        let things: Vec<&str> = match title {
            "A shape" => built(Family::Shape),
            "A pattern" => built(Family::Pattern),
            "A message" => Code::ALL.iter().map(|code| code.name()).collect(),
            _ => Vec::new(),
        };
        let names = other_names(section);
        let unknown = names.keys().filter(|word| !things.contains(word));
        faults.extend(unknown.map(|word| format!("{title}: `{word}` is none")));
        let links = section.split("](../").skip(1).filter_map(|rest| rest.split(')').next());
        let paths = quoted(section).filter(|text| text.contains('/') && !text.contains(' '));
        // Those of other names are relative to the folder of NAME.
        let paths = paths.filter(|text| !text.starts_with("../"));
        for path in paths.chain(links) {
            let is_of_each = ["NAME", "WORD", "CODE"].iter().any(|each| path.contains(each));
            if !is_of_each && !is_there(path) {
                faults.push(format!("{title}: there is no {path}"));
            }
            for thing in things.iter().filter(|_| is_of_each) {
                let name = names.get(thing).unwrap_or(thing);
                let path = path.replace("NAME", name).replace("WORD", thing).replace("CODE", thing);
                if !is_there(&path.replace("/mod.rs", ".rs")) {
                    faults.push(format!("{title}: `{thing}` has no {path}"));
                }
            }
        }
    }
    assert!(sections(&page).iter().any(|(title, _)| *title == "A shape"));
    assert_none(faults);
}
