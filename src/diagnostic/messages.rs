//! Messages together with the texts that they are about.

use std::fmt;

use super::{Diagnostic, json, render};
use crate::source::Sources;

/// Messages about one scene, as data and as text: the warnings of a [`Picture`](crate::Picture), or the errors because of
/// which there is none.
///
/// ```
/// use lucarne::{RenderOptions, diagnostic::{Code, mend}, render};
///
/// let text = "sphere { 0, 1 pigmnt { rgb 1 } }";
/// let messages = render(text, &RenderOptions { name: "a.scene", ..RenderOptions::default() }).unwrap_err();
/// let error = messages.iter().find(|one| one.code == Code::UnknownWord).expect("a misspelling");
/// assert_eq!(messages.sources().place(error.primary().unwrap().span), "a.scene:1:15");
/// assert_eq!(error.fixes[0].text, "pigment");
/// let (mended, _) = mend::apply(text, messages.iter());
/// assert_eq!(mended, "sphere { 0, 1 pigment { rgb 1 } }");
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Messages {
    list: Vec<Diagnostic>,
    sources: Sources,
}

impl Messages {
    /// `list` is in reading order; its spans are of these `sources`.
    pub fn new(list: Vec<Diagnostic>, sources: Sources) -> Self {
        Self { list, sources }
    }

    /// Returns the messages in reading order.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &Diagnostic> {
        self.list.iter()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// Whether one of them is an error: then there is no picture.
    pub fn has_errors(&self) -> bool {
        self.list.iter().any(Diagnostic::is_error)
    }

    /// The texts in which spans are; [`Sources::place`] returns `file:line:column` of one.
    pub fn sources(&self) -> &Sources {
        &self.sources
    }

    /// Returns the messages with excerpts of the texts, as on a terminal.
    pub fn drawn(&self, style: render::Style) -> String {
        let drawn = self.list.iter().map(|one| render::human(one, &self.sources, style));
        drawn.collect::<Vec<_>>().join("\n")
    }

    /// Returns one line for each message: `file:line:column: error[code]: message`.
    pub fn lines(&self) -> impl Iterator<Item = String> {
        self.list.iter().map(|one| render::short(one, &self.sources))
    }

    /// Returns one JSON object for each message, as `lucarne check --message-format json`: `code`, `severity`, `message`,
    /// `labels`, `trace`, `help` and `fixes`. Lines and columns count from 1.
    pub fn json_lines(&self) -> impl Iterator<Item = String> {
        self.list.iter().map(|one| json::line(one, &self.sources))
    }
}

/// As [`Messages::drawn`] in 80 columns without color.
impl fmt::Display for Messages {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.drawn(render::Style::PLAIN))
    }
}

impl std::error::Error for Messages {}
