//! Every scene and include that ships with POV-Ray is read without a syntax error.

use std::path::{Path, PathBuf};

use lucarne::diagnostic::{Diagnostics, Severity};
use lucarne::scene::Dialect;
use lucarne::source::{Source, Sources, decode};
use lucarne::syntax::ast::{Ast, DirectiveKind, ItemKind, Items};
use lucarne::syntax::{ParseOptions, dump, parse, print};
use lucarne::vocabulary::standard_include_of;

use super::{INCLUDES, SCENES, files, is_installed};

/// A form to be filled in, not a scene; POV-Ray rejects it too.
const TEMPLATES: &[&str] = &["__empty.pov"];

/// The messages of each file that has errors.
fn errors(paths: &[PathBuf]) -> Vec<(PathBuf, Vec<String>)> {
    let mut bad = Vec::new();
    for path in paths {
        let Ok(bytes) = std::fs::read(path) else { continue };
        let (text, _) = decode(bytes);
        let mut sources = Sources::default();
        let file = sources.add(Source::new(path.display().to_string(), text));
        let source = sources.get(file);
        let mut diagnostics = Diagnostics::new(false);
        let options = ParseOptions { dialect: Dialect::Pov, ..ParseOptions::default() };
        parse(source, file, &options, &mut diagnostics);
        let messages: Vec<String> = diagnostics
            .iter()
            .filter(|d| d.severity == Severity::Error)
            .map(|d| {
                let place = d.primary().map(|l| source.position(l.span.start as usize));
                let line = place.map_or(0, |p| p.line);
                format!("line {line}: {} [{}]", d.message, d.code.name())
            })
            .collect();
        if !messages.is_empty() {
            bad.push((path.clone(), messages));
        }
    }
    bad
}

fn check(package: &str, folder: &str, extensions: &[&str], at_least: usize) {
    let paths = files(folder, extensions);
    if !is_installed(package, &paths) {
        return;
    }
    let bad = errors(&paths);
    let is_template = |path: &Path| TEMPLATES.iter().any(|t| path.ends_with(t));
    let (templates, faults): (Vec<_>, Vec<_>) = bad.iter().partition(|(p, _)| is_template(p));
    println!(
        "{package}: {} of {} files without a syntax error",
        paths.len() - bad.len(),
        paths.len()
    );
    for (path, messages) in &faults {
        println!("{}:", path.display());
        for message in messages.iter().take(4) {
            println!("    {message}");
        }
    }
    assert!(faults.is_empty(), "{} files have errors", faults.len());
    assert!(templates.len() <= TEMPLATES.len());
    assert!(paths.len() >= at_least, "only {} files found", paths.len());
}

#[test]
fn every_example_scene_is_read_without_an_error() {
    check("povray-examples", SCENES, &["pov"], 396);
}

#[test]
fn every_include_of_the_examples_is_read_without_an_error() {
    check("povray-examples", SCENES, &["inc"], 1);
}

#[test]
fn every_standard_include_is_read_without_an_error() {
    check("povray-includes", INCLUDES, &["inc", "map"], 40);
}

/// The tree of a text and the text printed from it.
fn printed(text: String) -> (String, String, bool) {
    let mut sources = Sources::default();
    let file = sources.add(Source::new("a.pov", text));
    let source = sources.get(file);
    let mut diagnostics = Diagnostics::new(false);
    let options = ParseOptions { dialect: Dialect::Pov, ..ParseOptions::default() };
    let ast = parse(source, file, &options, &mut diagnostics);
    (dump(&ast, source), print(&ast, source), diagnostics.has_errors())
}

#[test]
fn a_printed_example_is_read_as_the_same_tree() {
    let mut paths = files(SCENES, &["pov", "inc"]);
    paths.extend(files(INCLUDES, &["inc"]));
    if !is_installed("povray-examples", &paths) {
        return;
    }
    let mut faults = 0;
    for path in &paths {
        let Ok(bytes) = std::fs::read(path) else { continue };
        let (tree, text, errors) = printed(decode(bytes).0);
        if errors {
            continue;
        }
        let (again, _, errors) = printed(text);
        // A comma that print adds to `<1 2>` can make a run of numbers out of single ones.
        let runs = |tree: &str| tree.contains("numbers ");
        if errors || (tree != again && !runs(&tree) && !runs(&again)) {
            println!("{}", path.display());
            faults += 1;
        }
    }
    println!("{} of {} files printed and read again", paths.len() - faults, paths.len());
    assert_eq!(faults, 0);
}

/// Every name that these items declare, macros' bodies aside.
fn declared(ast: &Ast, items: Items, names: &mut Vec<String>) {
    for item in ast.items(items) {
        let ItemKind::Directive(id) = item.kind else { continue };
        match &ast.directive(id).kind {
            DirectiveKind::Declare { local: false, target } => {
                names.push(ast.name(target.name).to_owned())
            }
            DirectiveKind::Macro { name, .. } => names.push(ast.name(*name).to_owned()),
            DirectiveKind::If { then, otherwise, .. } => {
                declared(ast, *then, names);
                declared(ast, *otherwise, names);
            }
            DirectiveKind::While { body, .. } | DirectiveKind::For { body, .. } => {
                declared(ast, *body, names);
            }
            DirectiveKind::Switch { cases, .. } => {
                cases.iter().for_each(|case| declared(ast, case.body, names));
            }
            _ => {}
        }
    }
}

#[test]
fn every_name_of_the_standard_includes_leads_to_one_of_them() {
    let paths = files(INCLUDES, &["inc"]);
    let mut missing = Vec::new();
    for path in &paths {
        let Ok(bytes) = std::fs::read(path) else { continue };
        let mut sources = Sources::default();
        let file = sources.add(Source::new(path.display().to_string(), decode(bytes).0));
        let options = ParseOptions { dialect: Dialect::Pov, ..ParseOptions::default() };
        let ast = parse(sources.get(file), file, &options, &mut Diagnostics::default());
        let mut names = Vec::new();
        declared(&ast, ast.root, &mut names);
        // A name that only tells that its include was read is no one's to use.
        names.retain(|name| !name.to_lowercase().ends_with("_inc_temp"));
        names.retain(|name| standard_include_of(name).is_none());
        missing.extend(names.into_iter().map(|name| format!("{}: {name}", path.display())));
    }
    assert!(missing.is_empty(), "{} names\n{}", missing.len(), missing.join("\n"));
}
