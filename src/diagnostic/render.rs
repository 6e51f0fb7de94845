//! Formats a message for people; the only file that uses miette.
//!
//! **In:** a [`Diagnostic`] and the texts it refers to. **Out:** text. **Invariant:** the cost depends on
//! the lines shown, not on the length of the file or of its lines; no line is wider than the window;
//! nothing the author wrote can move the cursor.

mod beside;

use std::fmt;

use miette::{GraphicalReportHandler, GraphicalTheme, LabeledSpan, MietteError, SourceSpan};

use super::cut::ending;
use super::excerpt::{Excerpt, visible, visible_untrimmed};
use super::json::severity_name;
use super::wrap::wrapped;
use super::{Diagnostic, Severity};
use crate::source::{FileId, Position, Source, Sources, Span};

/// Style in which messages are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Style {
    /// Columns of the terminal.
    pub width: usize,
    /// Whether to use the colours of ANSI terminals.
    pub color: bool,
}

impl Style {
    /// 80 columns without color, for files and snapshots.
    pub const PLAIN: Self = Self { width: 80, color: false };
}

/// Minimum width: a narrower window is treated as this many columns wide.
const LEAST_WIDTH: usize = 30;
/// Columns that miette puts before the lines of a message and its help, plus the free columns after them.
const BESIDE_MESSAGE: usize = 6;
const BESIDE_HELP: usize = 10;
/// Columns next to a line number and next to the location in a frame's header.
const BESIDE_PLACE: usize = 6;

/// Maximum number of trace steps shown: the innermost ones and the outermost.
const TRACE_SHOWN: usize = 3;

/// Returns the message with source excerpts, ending in a line break.
pub fn human(diagnostic: &Diagnostic, sources: &Sources, style: Style) -> String {
    let theme = match style.color {
        true => GraphicalTheme::unicode(),
        false => GraphicalTheme::unicode_nocolor(),
    };
    let width = style.width.max(LEAST_WIDTH);
    let view = View::new(diagnostic, sources, width);
    let mut text = String::new();
    // Writing to a string fails only where a label lies outside of its text, and `Excerpt`
    // places every one; a bare sentence is still better than none.
    let drawn = GraphicalReportHandler::new_themed(theme)
        .with_wrap_lines(false)
        .with_context_lines(1)
        .with_links(false)
        .render_report(&mut text, &view);
    if drawn.is_err() {
        text = short(diagnostic, sources) + "\n";
    }
    beside::completed(&text, &view.texts, width)
}

/// Returns the text of the message alone, formatted by the scene's author; it may be part of a line.
pub fn plain(diagnostic: &Diagnostic) -> String {
    visible_untrimmed(&diagnostic.message)
}

/// Returns `file:line:column: error[code]: message` on one line, without a trailing line break.
pub fn short(diagnostic: &Diagnostic, sources: &Sources) -> String {
    let at = diagnostic.primary().map(|label| label.span).unwrap_or(Span::new(FileId(0), 0, 0));
    let place = sources.iter().nth(at.file.0 as usize).map_or(String::new(), |(_, source)| {
        let Position { line, column } = source.position(at.start as usize);
        format!("{}:{line}:{column}: ", visible(&source.name))
    });
    let (severity, code) = (severity_name(diagnostic.severity), diagnostic.code.name());
    let message = visible(diagnostic.message.trim_end_matches('\n')).replace('\n', "␊");
    format!("{place}{severity}[{code}]: {message}")
}

/// Returns `2 errors, 1 warning`, or `None` if there are neither.
pub fn summary(errors: usize, warnings: usize) -> Option<String> {
    let count = |n: usize, what: &str| match n {
        0 => None,
        1 => Some(format!("1 {what}")),
        n => Some(format!("{n} {what}s")),
    };
    let parts: Vec<String> =
        [count(errors, "error"), count(warnings, "warning")].into_iter().flatten().collect();
    (!parts.is_empty()).then(|| parts.join(", "))
}

/// Adapts a diagnostic to miette.
#[derive(Debug)]
struct View {
    code: String,
    message: String,
    severity: Severity,
    labels: Vec<LabeledSpan>,
    help: Option<String>,
    /// Texts that replace the marks in the labels.
    texts: Vec<String>,
    text: Text,
}

impl View {
    fn new(diagnostic: &Diagnostic, sources: &Sources, width: usize) -> Self {
        let mut spans: Vec<(Span, String, bool)> = diagnostic
            .labels
            .iter()
            .map(|label| (label.span, visible(&label.text), label.primary))
            .collect();
        spans.extend(calls(diagnostic).map(|(span, text)| (span, text, false)));
        let places: Vec<Span> = spans.iter().map(|(span, ..)| *span).collect();
        let excerpt = Excerpt::around(&places, sources, width);
        let marks = excerpt.marks.iter().map(|&(start, end, _)| (start, end - start));
        let labels = spans.iter().zip(marks).enumerate().map(|(at, ((_, text, primary), mark))| {
            let text = (!text.is_empty()).then(|| beside::mark(at));
            match primary {
                true => LabeledSpan::new_primary_with_span(text, mark),
                false => LabeledSpan::new_with_span(text, mark),
            }
        });
        let labels = labels.collect();
        let help: Vec<String> = advice(diagnostic, sources)
            .iter()
            .flat_map(|text| wrapped(text, width - BESIDE_HELP))
            .collect();
        let places = excerpt.marks.iter();
        let place = places.map(|(.., at)| format!(":{}:{}", at.line, at.column).len()).max();
        let room = width.saturating_sub(excerpt.digits + BESIDE_PLACE + place.unwrap_or(0));
        let name = |source: &Source, room: usize| {
            ending(visible(&source.name).replace('\t', "␉").replace('\n', "␊"), room)
        };
        let names = sources.iter().map(|(_, source)| name(source, room)).collect();
        // A message about the scene as a unit still names the scene.
        let mut code = diagnostic.code.name().to_owned();
        if let (true, Some((_, source))) = (diagnostic.labels.is_empty(), sources.iter().next()) {
            code += " in ";
            code += &name(source, width.saturating_sub(code.len()));
        }
        Self {
            code,
            message: wrapped(&visible(&diagnostic.message), width - BESIDE_MESSAGE).join("\n"),
            severity: diagnostic.severity,
            labels,
            help: (!help.is_empty()).then(|| help.join("\n")),
            texts: spans.into_iter().map(|(_, text, _)| text).collect(),
            text: Text { excerpt, names },
        }
    }
}

/// Returns the calls that led here: the innermost ones and the outermost. Calls from the same location are
/// listed once.
pub(super) fn calls(diagnostic: &Diagnostic) -> impl Iterator<Item = (Span, String)> {
    let mut steps: Vec<(Span, String, usize)> = Vec::new();
    let told = |span: Span| diagnostic.labels.iter().any(|label| label.span == span);
    for step in diagnostic.trace.iter().filter(|step| !told(step.span)) {
        match steps.iter_mut().find(|(span, ..)| *span == step.span) {
            Some((.., times)) => *times += 1,
            None => steps.push((step.span, visible(&step.text), 1)),
        }
    }
    let last = steps.len().saturating_sub(1);
    let between = steps.len().saturating_sub(TRACE_SHOWN);
    let shown = move |&(i, _): &(usize, _)| i + 1 < TRACE_SHOWN || i == last;
    steps.into_iter().enumerate().filter(shown).map(move |(i, (span, mut text, times))| {
        if times > 1 {
            text += &format!(", {times} times");
        }
        if i == last && between > 0 {
            text += &format!(" (and {between} more calls between)");
        }
        (span, text)
    })
}

/// Returns the help texts, and each fix that no help text already contains.
pub(super) fn advice(diagnostic: &Diagnostic, sources: &Sources) -> Vec<String> {
    let mut lines: Vec<String> = diagnostic.help.iter().map(|text| visible(text)).collect();
    // How often each is told, of fixes that read alike.
    let mut alike: Vec<(String, usize)> = Vec::new();
    for fix in &diagnostic.fixes {
        // A line of its own reads as what stands in it.
        let (old, new) = (sources.text(fix.span), visible(fix.text.trim_matches('\n')));
        let said = |line: &String| !new.is_empty() && line.contains(&format!("`{new}`"));
        if lines.iter().any(said) {
            continue;
        }
        let line = match (old.is_empty(), new.is_empty()) {
            (true, _) => format!("insert `{new}`"),
            (false, true) if old.len() > 60 => "remove it".to_owned(),
            (false, true) => format!("remove `{}`", visible(old)),
            (false, false) if old.len() > 60 => format!("replace it with `{new}`"),
            (false, false) => format!("replace `{}` with `{new}`", visible(old)),
        };
        match alike.iter_mut().find(|(other, _)| *other == line) {
            Some((_, times)) => *times += 1,
            None => alike.push((line, 1)),
        }
    }
    lines.extend(alike.into_iter().map(|(line, times)| match times {
        1 => line,
        _ => format!("{line}, {times} times"),
    }));
    lines
}

impl fmt::Display for View {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for View {}

impl miette::Diagnostic for View {
    fn code(&self) -> Option<Box<dyn fmt::Display + '_>> {
        Some(Box::new(&self.code))
    }

    fn severity(&self) -> Option<miette::Severity> {
        Some(match self.severity {
            Severity::Note => miette::Severity::Advice,
            Severity::Warning => miette::Severity::Warning,
            Severity::Error => miette::Severity::Error,
        })
    }

    fn help(&self) -> Option<Box<dyn fmt::Display + '_>> {
        self.help.as_ref().map(|help| Box::new(help) as Box<dyn fmt::Display>)
    }

    fn source_code(&self) -> Option<&dyn miette::SourceCode> {
        Some(&self.text)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        Some(Box::new(self.labels.iter().cloned()))
    }
}

/// Provides the excerpt to miette: each span lies in one run, and each run knows its file.
#[derive(Debug)]
struct Text {
    excerpt: Excerpt,
    names: Vec<String>,
}

impl miette::SourceCode for Text {
    fn read_span<'a>(
        &'a self,
        span: &SourceSpan,
        before: usize,
        after: usize,
    ) -> Result<Box<dyn miette::SpanContents<'a> + 'a>, MietteError> {
        let (start, end) = (span.offset(), span.offset() + span.len());
        let run = self.excerpt.runs.iter().rev().find(|run| run.base <= start);
        let run = run.filter(|run| end <= run.base + run.text.len());
        let run = run.ok_or(MietteError::OutOfBounds)?;
        let lines: Vec<usize> =
            std::iter::once(0).chain(run.text.match_indices('\n').map(|(i, _)| i + 1)).collect();
        let line_of = |at: usize| lines.partition_point(|&l| l <= at - run.base) - 1;
        let first = line_of(start).saturating_sub(before);
        let last = (line_of(end) + 1 + after).min(lines.len() - 1);
        // With no context miette asks where the span is, else for the lines to draw.
        let mark = self.excerpt.marks.iter().find(|mark| mark.0 == start);
        let column = match (before, mark) {
            (0, Some((.., position))) => position.column - 1,
            _ => 0,
        };
        Ok(Box::new(miette::MietteSpanContents::new_named(
            self.names[run.file.0 as usize].clone(),
            &run.text.as_bytes()[lines[first]..lines[last]],
            (run.base + lines[first], lines[last] - lines[first]).into(),
            run.first_line - 1 + first,
            column,
            last - first,
        )))
    }
}

#[cfg(test)]
mod tests;
