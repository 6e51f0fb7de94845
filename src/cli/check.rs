//! `lucarne check`: messages, and no picture.

use std::fs;
use std::io::Write;
use std::path::Path;

use lucarne::diagnostic::{Diagnostic, Fix};
use lucarne::road::Road;
use lucarne::source::FileId;

use super::arguments::CheckArguments;
use super::exit::{Exit, Failure, Outcome, reason};
use super::files::{DiskFiles, read_main};
use super::messages::{self, Messages};

/// One fix may bring out another; more rounds than this are not made.
const MOST_ROUNDS: usize = 8;

const BYTE_ORDER_MARK: &[u8] = "\u{feff}".as_bytes();

pub fn run(arguments: &CheckArguments) -> Outcome {
    let mut messages = arguments.scene.messages();
    let mut exit = Exit::Done;
    for file in &arguments.files {
        let checked = match arguments.fix {
            true => fix(file, arguments).and_then(|()| check(file, arguments, &mut messages)),
            false => check(file, arguments, &mut messages),
        };
        // A file that cannot be read is no reason not to check the others.
        if let Err(failure) = checked {
            messages::fail(&failure);
            exit = exit.max(failure.exit);
        }
    }
    messages.summarize();
    Ok(exit.max(messages.exit()))
}

fn check(file: &Path, arguments: &CheckArguments, messages: &mut Messages) -> Result<(), Failure> {
    let bytes = read_main(file)?;
    compiled(file, bytes, arguments, |road| {
        messages.print(road.diagnostics.in_text_order().into_iter(), &road.sources)
    })
}

/// Takes the file as far as the messages come from, and hands it to `then`.
fn compiled<T>(
    file: &Path,
    bytes: Vec<u8>,
    arguments: &CheckArguments,
    then: impl FnOnce(&Road) -> T,
) -> T {
    let files = DiskFiles::new(file, &arguments.scene.include);
    let mut road = Road::new(&files, arguments.scene.options(file, None));
    let id = road.read(&file.to_string_lossy(), bytes);
    let ast = road.parse(id);
    if !arguments.syntax_only {
        let scene = road.evaluate(&ast);
        road.lower(scene);
    }
    then(&road)
}

/// Applies the fixes that messages offer for this file, until there are none.
fn fix(file: &Path, arguments: &CheckArguments) -> Result<(), Failure> {
    let mut fixed = 0;
    for _ in 0..MOST_ROUNDS {
        let bytes = read_main(file)?;
        let mark = bytes.starts_with(BYTE_ORDER_MARK);
        if std::str::from_utf8(&bytes).is_err() {
            let sentence = format!("cannot fix `{}`: it is not UTF-8", file.display());
            return Err(Failure::file(sentence).help("save it as UTF-8 first"));
        }
        let (text, applied) = compiled(file, bytes, arguments, |road| {
            apply(&road.sources.get(FileId(0)).text, road.diagnostics.iter())
        });
        if applied == 0 {
            break;
        }
        let mut bytes = if mark { BYTE_ORDER_MARK.to_vec() } else { Vec::new() };
        bytes.extend_from_slice(text.as_bytes());
        replace(file, &bytes)?;
        fixed += applied;
    }
    if fixed > 0 {
        let es = if fixed == 1 { "" } else { "es" };
        messages::eprint(&format!("{}: {fixed} fix{es} applied\n", file.display()));
    }
    Ok(())
}

/// The main text with all fixes that do not overlap an earlier one, and how many messages they
/// mend. The fixes of one message are applied together or not at all.
fn apply<'a>(text: &str, diagnostics: impl Iterator<Item = &'a Diagnostic>) -> (String, usize) {
    let mut chosen: Vec<&Fix> = Vec::new();
    let mut mended = 0;
    for diagnostic in diagnostics {
        let fixes = &diagnostic.fixes;
        let free = |fix: &Fix| {
            let (start, end) = (fix.span.start, fix.span.end);
            // Two insertions at one place have no order: the second waits too.
            let apart = |other: &Fix| {
                let before = other.span.end <= start && other.span.start < start;
                before || (end <= other.span.start && start < other.span.start)
            };
            fix.span.file == FileId(0) && chosen.iter().all(|other| apart(other))
        };
        if !fixes.is_empty() && fixes.iter().all(free) {
            chosen.extend(fixes);
            mended += 1;
        }
    }
    chosen.sort_by_key(|fix| fix.span.start);
    let (mut out, mut at) = (String::with_capacity(text.len()), 0);
    for fix in chosen {
        out.push_str(&text[at..fix.span.start as usize]);
        out.push_str(&fix.text);
        at = fix.span.end as usize;
    }
    out.push_str(&text[at..]);
    (out, mended)
}

/// Writes the file anew, beside and renamed, with the permissions it had.
fn replace(file: &Path, bytes: &[u8]) -> Result<(), Failure> {
    let path = fs::canonicalize(file).unwrap_or(file.to_owned());
    let folder = path.parent().unwrap_or(Path::new("."));
    let cannot = |why: String| Failure::file(format!("cannot write `{}`: {why}", file.display()));
    let mut beside = tempfile::Builder::new()
        .prefix(".lucarne-")
        .tempfile_in(folder)
        .map_err(|error| cannot(reason(&error)))?;
    beside.write_all(bytes).map_err(|error| cannot(reason(&error)))?;
    if let Ok(about) = fs::metadata(&path) {
        let set = beside.as_file().set_permissions(about.permissions());
        set.map_err(|error| cannot(reason(&error)))?;
    }
    beside.persist(&path).map_err(|error| cannot(reason(&error.error)))?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use lucarne::diagnostic::Code;
    use lucarne::source::Span;

    fn wrong(fixes: &[(usize, usize, &str)]) -> Diagnostic {
        let start = Diagnostic::new(Code::UnknownWord, "wrong");
        fixes.iter().fold(start, |diagnostic, &(start, end, text)| {
            diagnostic.fix(Span::new(FileId(0), start, end), text)
        })
    }

    #[test]
    fn fixes_are_applied_in_any_order() {
        let list = [wrong(&[(4, 7, "two")]), wrong(&[(0, 3, "one"), (7, 7, "!")]), wrong(&[])];
        assert_eq!(apply("eno owt", list.iter()), ("one two!".to_owned(), 2));
    }

    #[test]
    fn fixes_that_overlap_wait_for_the_next_round() {
        let list = [wrong(&[(0, 3, "a")]), wrong(&[(2, 5, "b")]), wrong(&[(0, 0, "c")])];
        assert_eq!(apply("123456", list.iter()), ("a456".to_owned(), 1));
    }

    #[test]
    fn a_fix_in_another_file_is_left_alone() {
        let other =
            Diagnostic::new(Code::UnknownWord, "wrong").fix(Span::new(FileId(1), 0, 1), "a");
        assert_eq!(apply("1", [other].iter()), ("1".to_owned(), 0));
    }
}
