//! Formats a message as plain sentences for a screen reader: no drawings, no color, locations in words.
//!
//! **In:** a [`Diagnostic`] and the texts it refers to. **Out:** text, one sentence per line.
//! **Invariant:** contains everything that the drawn form shows.

use super::excerpt::visible;
use super::render::{advice, calls};
use super::{Diagnostic, Severity};
use crate::source::{Sources, Span};

/// Maximum number of characters quoted from a line or from a marked part of it.
const READ: usize = 120;

/// Returns the message in sentences, ending in a line break.
pub fn narrated(diagnostic: &Diagnostic, sources: &Sources) -> String {
    let severity = match diagnostic.severity {
        Severity::Note => "Note",
        Severity::Warning => "Warning",
        Severity::Error => "Error",
    };
    let message = sentence(&visible(&diagnostic.message));
    let mut said = match (diagnostic.primary(), sources.iter().next()) {
        (Some(label), _) => format!("{severity} in {}: {message}\n", place(label.span, sources)),
        (None, Some((_, main))) => format!("{severity} in {}: {message}\n", visible(&main.name)),
        (None, None) => format!("{severity}: {message}\n"),
    };
    for label in &diagnostic.labels {
        let (marked, text) = (marked(label.span, sources), visible(&label.text));
        let line = read_line(label.span, sources);
        let what = match text.is_empty() {
            true => String::new(),
            false => format!(": {}", sentence(&text)),
        };
        if label.primary {
            said += &format!("The line reads: {line}\n");
            if !what.is_empty() {
                said += &format!("There, {marked}{what}\n");
            }
        } else if !what.is_empty() {
            said += &format!("In {}, {marked}{what}\n", place(label.span, sources));
        }
    }
    for (span, text) in calls(diagnostic) {
        said += &format!("It came about {text}, {}.\n", place(span, sources));
    }
    for line in advice(diagnostic, sources) {
        said += &format!("Help: {}\n", sentence(&line));
    }
    said + &format!("The code of this message is {}.\n", diagnostic.code.name())
}

/// Formats a location: `a.scene, line 5, columns 2 to 7`.
fn place(span: Span, sources: &Sources) -> String {
    let source = sources.get(span.file);
    let (start, end) = (source.position(span.start as usize), source.position(span.end as usize));
    let name = visible(&source.name);
    if start.line != end.line {
        return format!(
            "{name}, line {}, column {}, to line {}",
            start.line, start.column, end.line
        );
    }
    match end.column.saturating_sub(start.column) {
        0 | 1 => format!("{name}, line {}, column {}", start.line, start.column),
        _ => format!("{name}, line {}, columns {} to {}", start.line, start.column, end.column - 1),
    }
}

/// Describes the marked text: `at "pigmnt"` or, if that is empty, `before "}"` or `at the end of the line`.
fn marked(span: Span, sources: &Sources) -> String {
    let first_line = |text: &str| cut(text.lines().next().unwrap_or("").trim());
    let piece = first_line(sources.text(span));
    if !piece.is_empty() {
        return format!("at `{piece}`");
    }
    let source = sources.get(span.file);
    match first_line(source.text.get(span.end as usize..).unwrap_or("")) {
        rest if rest.is_empty() => "at the end of the line".to_owned(),
        rest => format!("before `{rest}`"),
    }
}

fn read_line(span: Span, sources: &Sources) -> String {
    let source = sources.get(span.file);
    let position = source.position(span.start as usize);
    let line = source.line(position.line);
    // Quotes only the relevant part of a line that is too long to listen to.
    let around = position.column.saturating_sub(READ / 2);
    match line.chars().count() > READ && around > 0 {
        true => cut(&format!("…{}", line.chars().skip(around).collect::<String>())),
        false => cut(line.trim()),
    }
}

fn cut(text: &str) -> String {
    let text = visible(text);
    match text.chars().count() > READ {
        true => text.chars().take(READ).chain(['…']).collect(),
        false => text,
    }
}

/// Appends a full stop.
fn sentence(text: &str) -> String {
    match text.ends_with(['.', '?', '!', ':']) {
        true => text.to_owned(),
        false => format!("{text}."),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnostic::{Code, TraceStep};
    use crate::source::{FileId, Source};

    #[test]
    fn a_message_is_told_in_sentences_with_its_places_calls_and_help() {
        let mut sources = Sources::default();
        let main = sources.add(Source::new("a.scene", "#include \"b.inc\"\n\tLamp(0)\n"));
        let lamp = sources.add(Source::new("b.inc", "#macro Lamp(S)\n  sphere {\n 0, S }\n#end\n"));
        let find = |file: FileId, text: &str| {
            let start = sources.get(file).text.find(text).expect("in the text");
            Span::new(file, start, start + text.len())
        };
        let mut told = Diagnostic::new(Code::ZeroSize, "the sphere has radius 0")
            .at(find(lamp, "S }").to(find(lamp, "S }")), "this is 0")
            .also(find(lamp, "sphere {"), "of this sphere")
            .help("write a radius that is more than 0");
        let span = find(main, "Lamp(0)");
        told.trace.push(TraceStep { span, text: "in this call of macro `Lamp`".into() });
        insta::assert_snapshot!(narrated(&told, &sources), @"
        Error in b.inc, line 3, columns 5 to 7: the sphere has radius 0.
        The line reads: 0, S }
        There, at `S }`: this is 0.
        In b.inc, line 2, columns 3 to 10, at `sphere {`: of this sphere.
        It came about in this call of macro `Lamp`, a.scene, line 2, columns 2 to 8.
        Help: write a radius that is more than 0.
        The code of this message is zero-size.
        ");
    }

    #[test]
    fn a_message_without_a_place_names_the_scene() {
        let mut sources = Sources::default();
        sources.add(Source::new("a.scene", ""));
        let told = Diagnostic::new(Code::NoLight, "nothing gives light");
        assert_eq!(
            narrated(&told, &sources),
            "Warning in a.scene: nothing gives light.\nThe code of this message is no-light.\n"
        );
    }

    #[test]
    fn the_end_of_a_line_has_no_piece_to_quote() {
        let mut sources = Sources::default();
        let file = sources.add(Source::new("a.scene", "sphere {\n}"));
        assert_eq!(marked(Span::new(file, 8, 8), &sources), "at the end of the line");
        assert_eq!(marked(Span::new(file, 7, 7), &sources), "before `{`");
        assert_eq!(place(Span::new(file, 7, 10), &sources), "a.scene, line 1, column 8, to line 2");
    }
}
