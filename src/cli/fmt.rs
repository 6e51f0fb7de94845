//! `lucarne fmt`: formats scenes in the canonical layout.

use std::path::Path;

use lucarne::diagnostic::Diagnostics;
use lucarne::source::{Source, Sources, decode, to_latin};
use lucarne::syntax::{ParseOptions, Unformatted, format};
use similar::TextDiff;

use super::arguments::FmtArguments;
use super::exit::{Exit, Failure, Outcome};
use super::language;
use super::messages::{self, Messages};
use super::output::write_over;
use super::text::{is_stdin, name_of, read_main};

const BYTE_ORDER_MARK: &[u8] = "\u{feff}".as_bytes();

pub fn run(arguments: &FmtArguments) -> Outcome {
    let mut messages = Messages::new(arguments.message_format, false);
    let mut exit = Exit::Done;
    for file in &arguments.files {
        match one(file, arguments, &mut messages) {
            Ok(of_file) => exit = exit.max(of_file),
            // An unreadable file does not prevent formatting the others.
            Err(failure) => {
                messages::fail(&failure);
                exit = exit.max(failure.exit);
            }
        }
    }
    messages.summarize();
    Ok(exit.max(messages.exit()))
}

fn one(file: &Path, arguments: &FmtArguments, messages: &mut Messages) -> Outcome {
    let bytes = read_main(file)?;
    let name = name_of(file);
    let mark: &[u8] = if bytes.starts_with(BYTE_ORDER_MARK) { BYTE_ORDER_MARK } else { b"" };
    let (text, latin) = decode(bytes.clone());
    let mut sources = Sources::default();
    let id = sources.add(Source::new(&*name, text));
    // Formatting does not depend on handedness, so the note on the detected language is dropped.
    let (dialect, _) = language::of(arguments.language, file, &bytes);
    let options = ParseOptions { dialect, ..ParseOptions::default() };
    let mut diagnostics = Diagnostics::new(false);
    let source = sources.get(id);
    let formatted = match format(source, id, &options, &mut diagnostics) {
        Ok(formatted) => formatted,
        Err(Unformatted::Broken) => {
            messages.print(diagnostics.in_text_order().into_iter(), &sources)?;
            return Ok(Exit::Scene);
        }
        Err(Unformatted::Unsafe) => {
            let sentence =
                format!("`{name}` is left as it is: its layout would change its meaning");
            return Err(Failure { exit: Exit::Panic, ..Failure::file(sentence) }
                .help("this is a bug in lucarne; please report it with the file"));
        }
    };
    let same = formatted == source.text;
    if arguments.diff && !same {
        let diff = TextDiff::from_lines(&source.text, &formatted);
        let diff = diff.unified_diff().header(&name, &format!("{name} (formatted)")).to_string();
        messages::print(&diff)?;
    } else if arguments.check && !same {
        messages::print(&format!("{name}\n"))?;
    }
    if arguments.check || arguments.diff {
        return Ok(if arguments.check && !same { Exit::Scene } else { Exit::Done });
    }
    let encoded = match latin {
        // Writes each character as the byte it was read from.
        true => to_latin(&formatted),
        false => [mark, formatted.as_bytes()].concat(),
    };
    if is_stdin(file) {
        messages::print_with(&|out| out.write_all(&encoded))?;
    } else if encoded != bytes {
        write_over(file, &encoded)?;
    }
    Ok(Exit::Done)
}
