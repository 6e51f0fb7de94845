//! Formats a message as one line of JSON.
//!
//! **Invariant:** lines and columns count from 1, columns are in characters, ends are exclusive. The output
//! is a single line whatever the message contains. A message about the scene as a unit is located at the
//! start of the main file.

use serde::Serialize;

use super::{Diagnostic, Severity};
use crate::source::{FileId, Position, Sources, Span};

#[derive(Serialize)]
struct Message<'a> {
    code: &'static str,
    severity: &'static str,
    message: &'a str,
    labels: Vec<Label<'a>>,
    trace: Vec<Step<'a>>,
    help: &'a [String],
    fixes: Vec<Fix<'a>>,
}

#[derive(Serialize)]
struct Label<'a> {
    #[serde(flatten)]
    place: Place<'a>,
    text: &'a str,
    primary: bool,
}

#[derive(Serialize)]
struct Step<'a> {
    file: &'a str,
    line: usize,
    column: usize,
    text: &'a str,
}

#[derive(Serialize)]
struct Fix<'a> {
    #[serde(flatten)]
    place: Place<'a>,
    text: &'a str,
}

/// A span by its lines and columns.
#[derive(Serialize)]
pub(super) struct Place<'a> {
    pub file: &'a str,
    pub line: usize,
    pub column: usize,
    pub end_line: usize,
    pub end_column: usize,
}

impl<'a> Place<'a> {
    pub fn of(span: Span, sources: &'a Sources) -> Self {
        let source = sources.get(span.file);
        let Position { line, column } = source.position(span.start as usize);
        let end = source.position(span.end as usize);
        Self { file: &source.name, line, column, end_line: end.line, end_column: end.column }
    }
}

impl<'a> Place<'a> {
    /// Returns where a message is: about the scene as a unit, at the start of the main file.
    pub fn primary(diagnostic: &Diagnostic, sources: &'a Sources) -> Self {
        let span = diagnostic.primary().map_or(Span::new(FileId(0), 0, 0), |label| label.span);
        match sources.iter().next() {
            Some(_) => Self::of(span, sources),
            None => Self { file: "", line: 1, column: 1, end_line: 1, end_column: 1 },
        }
    }
}

/// Returns the name of a severity in JSON and in short messages.
pub(crate) fn severity_name(severity: Severity) -> &'static str {
    match severity {
        Severity::Note => "note",
        Severity::Warning => "warning",
        Severity::Error => "error",
    }
}

/// Returns one JSON object without a trailing line break.
pub fn line(diagnostic: &Diagnostic, sources: &Sources) -> String {
    let label = |span, text, primary| Label { place: Place::of(span, sources), text, primary };
    let mut labels: Vec<Label> = diagnostic
        .labels
        .iter()
        .map(|one| label(one.span, one.text.as_str(), one.primary))
        .collect();
    if let (true, Some((main, _))) = (labels.is_empty(), sources.iter().next()) {
        labels.push(label(Span::new(main, 0, 0), "", true));
    }
    let message = Message {
        code: diagnostic.code.name(),
        severity: severity_name(diagnostic.severity),
        message: diagnostic.message.trim_end_matches('\n'),
        labels,
        trace: diagnostic
            .trace
            .iter()
            .map(|step| {
                let Place { file, line, column, .. } = Place::of(step.span, sources);
                Step { file, line, column, text: &step.text }
            })
            .collect(),
        help: &diagnostic.help,
        fixes: diagnostic
            .fixes
            .iter()
            .map(|fix| Fix { place: Place::of(fix.span, sources), text: &fix.text })
            .collect(),
    };
    // Strings, numbers and lists of them: nothing here can fail to serialise.
    serde_json::to_string(&message).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnostic::{Code, TraceStep};
    use crate::source::Source;

    #[test]
    fn a_message_is_one_line_with_every_key_in_order() {
        let mut sources = Sources::default();
        let file = sources.add(Source::new("a.scene", "é\tpigmnt { }\n\u{1}\n"));
        let word = Span::new(file, 3, 9);
        let mut diagnostic = Diagnostic::new(Code::UnknownWord, "unknown word `pigmnt`")
            .at(word, "not known\nhere")
            .also(Span::new(file, 10, 13), "in this block")
            .help("did you mean `pigment`?")
            .fix(word, "pigment");
        diagnostic
            .trace
            .push(TraceStep { span: word, text: "in this call of macro `Lamp`".into() });
        assert_eq!(
            line(&diagnostic, &sources),
            concat!(
                r#"{"code":"unknown-word","severity":"error","message":"unknown word `pigmnt`","#,
                r#""labels":[{"file":"a.scene","line":1,"column":3,"end_line":1,"end_column":9,"#,
                r#""text":"not known\nhere","primary":true},"#,
                r#"{"file":"a.scene","line":1,"column":10,"end_line":1,"end_column":13,"#,
                r#""text":"in this block","primary":false}],"#,
                r#""trace":[{"file":"a.scene","line":1,"column":3,"#,
                r#""text":"in this call of macro `Lamp`"}],"#,
                r#""help":["did you mean `pigment`?"],"#,
                r#""fixes":[{"file":"a.scene","line":1,"column":3,"end_line":1,"end_column":9,"#,
                r#""text":"pigment"}]}"#
            )
        );
    }

    #[test]
    fn what_is_about_the_whole_scene_is_at_its_first_place() {
        let mut sources = Sources::default();
        sources.add(Source::new("a.scene", "sphere { 0, 1 }"));
        let text = line(&Diagnostic::new(Code::NoLight, "nothing gives light"), &sources);
        let place =
            r#"{"file":"a.scene","line":1,"column":1,"end_line":1,"end_column":1,"text":"""#;
        assert!(text.contains(place), "{text}");
    }

    #[test]
    fn control_characters_are_escaped() {
        let text =
            line(&Diagnostic::new(Code::AuthorError, "a\u{1b}[31m\nb\u{7f}"), &Sources::default());
        assert!(!text.chars().any(|c| c < ' '), "{text}");
        assert!(text.contains(r"a\u001b[31m\nb"), "{text}");
    }
}
