//! `lucarne check`: reports messages without rendering.

use std::collections::BTreeMap;
use std::path::Path;

use lucarne::diagnostic::mend::{apply, mend};
use lucarne::disk::DiskFiles;
use lucarne::road::Road;
use lucarne::scene::Dialect;
use lucarne::source::{FileId, Sources};
use lucarne::standard;
use lucarne::vocabulary::is_standard_include;

use super::arguments::CheckArguments;
use super::exit::{Exit, Failure, Outcome};
use super::files;
use super::language;
use super::messages::{self, Messages};
use super::output::write_over;
use super::text::{is_include, is_stdin, name_of, read_main, read_scene};

const BYTE_ORDER_MARK: &[u8] = "\u{feff}".as_bytes();

pub fn run(arguments: &CheckArguments) -> Outcome {
    let mut messages = arguments.scene.messages();
    let mut exit = Exit::Done;
    for file in &arguments.files {
        let checked = match arguments.fix {
            true => fix(file, arguments).and_then(|()| check(file, arguments, &mut messages)),
            false => check(file, arguments, &mut messages),
        };
        // An unreadable file does not prevent checking the others.
        if let Err(failure) = checked {
            messages.fail(file, &failure)?;
            exit = exit.max(failure.exit);
        }
    }
    messages.summarize();
    Ok(exit.max(messages.exit()))
}

fn check(file: &Path, arguments: &CheckArguments, messages: &mut Messages) -> Result<(), Failure> {
    let bytes = read(file)?;
    let dialect = arguments.scene.dialect(file, &bytes);
    compiled(file, dialect, bytes, arguments, |road, files| {
        messages.print(road.diagnostics.in_text_order().into_iter(), &road.sources)?;
        if arguments.places {
            messages::print(&places(&road.sources))?;
        }
        files::announce(files, !road.diagnostics.has_errors())?;
        if road.diagnostics.is_empty() && !arguments.quiet {
            messages.nothing(&name_of(file));
        }
        Ok(())
    })
}

/// Reads a file. A scene must not be empty; an include file may be.
fn read(file: &Path) -> Result<Vec<u8>, Failure> {
    match is_include(file) {
        true => read_main(file),
        false => read_scene(file),
    }
}

/// Compiles the file as far as messages are reported, and passes the result to `then`.
fn compiled<T>(
    file: &Path,
    dialect: Dialect,
    bytes: Vec<u8>,
    arguments: &CheckArguments,
    then: impl FnOnce(&Road, &DiskFiles) -> T,
) -> T {
    let files = files::of(file, &arguments.scene);
    let mut road = Road::new(&files, arguments.options(file, dialect));
    let id = road.read(&name_of(file), bytes);
    let ast = road.parse(id);
    if !arguments.syntax_only {
        let scene = road.evaluate(ast);
        road.lower(scene);
    }
    then(&road, &files)
}

/// Lists the files that the main file reads, one per line, in reading order.
fn places(sources: &Sources) -> String {
    let mut lines: Vec<String> = Vec::new();
    for (_, source) in sources.iter().skip(1) {
        let path = source.name.as_str();
        let line = match standard::embedded_name(path) {
            Some(name) => format!("{name}: built in\n"),
            None => {
                let name = Path::new(path).file_name().unwrap_or_default();
                format!("{}: {path}\n", name.display())
            }
        };
        if !lines.contains(&line) {
            lines.push(line);
        }
    }
    lines.concat()
}

/// Applies the fixes suggested for this file, if they improve it.
fn fix(file: &Path, arguments: &CheckArguments) -> Result<(), Failure> {
    if is_stdin(file) {
        return Err(Failure::usage("standard input cannot be fixed: only a file can"));
    }
    let bytes = read(file)?;
    let mark: &[u8] = if bytes.starts_with(BYTE_ORDER_MARK) { BYTE_ORDER_MARK } else { b"" };
    let Ok(text) = std::str::from_utf8(&bytes[mark.len()..]) else {
        let sentence = format!("cannot fix `{}`: it is not UTF-8", file.display());
        return Err(Failure::file(sentence).help("save it as UTF-8 first"));
    };
    // It stays the same, whatever is fixed.
    let (dialect, _) = language::of(arguments.scene.language, file, &bytes);
    let messages = |text: &str| {
        let bytes = text.as_bytes().to_vec();
        compiled(file, dialect, bytes, arguments, |road, _| {
            road.diagnostics.iter().cloned().collect()
        })
    };
    let mended = mend(text, messages);
    let fixed = mended.as_ref().map_or(0, |(_, fixed)| *fixed);
    let text = mended.as_ref().map_or(text, |(text, _)| text);
    if fixed > 0 {
        write_over(file, &[mark, text.as_bytes()].concat())?;
    }
    let rest = messages(text);
    for (elsewhere, count) in fixes_elsewhere(file, dialect, text, arguments) {
        let (are, es) = if count == 1 { ("is", "") } else { ("are", "es") };
        messages::eprint(&format!(
            "{count} fix{es} {are} in {elsewhere}: `lucarne check --fix {elsewhere}` applies {}\n",
            if count == 1 { "it" } else { "them" },
        ));
    }
    let all = fixed + apply(text, rest.iter()).1.len();
    let es = if all == 1 { "" } else { "es" };
    let name = file.display();
    let told = match all {
        0 => return Ok(()),
        _ if all == fixed => format!("{name}: {fixed} fix{es} applied\n"),
        _ => format!(
            "{name}: {fixed} of {all} fix{es} applied: the rest would leave as many errors\n"
        ),
    };
    messages::eprint(&told);
    Ok(())
}

/// Returns the included files with suggested fixes, except standard ones, and the number of fixes.
fn fixes_elsewhere(
    file: &Path,
    dialect: Dialect,
    text: &str,
    arguments: &CheckArguments,
) -> Vec<(String, usize)> {
    compiled(file, dialect, text.as_bytes().to_vec(), arguments, |road, _| {
        let mut counts = BTreeMap::new();
        let fixed = road.diagnostics.iter().filter_map(|one| one.fixes.first());
        for place in fixed.map(|fix| fix.span.file).filter(|place| *place != FileId(0)) {
            let name = &road.sources.get(place).name;
            let short = Path::new(name).file_name().unwrap_or_default().to_string_lossy();
            if !is_standard_include(&short) {
                *counts.entry(name.clone()).or_insert(0) += 1;
            }
        }
        counts.into_iter().collect()
    })
}
