//! Messages together with the texts that they are about.

use std::fmt;

use super::{Diagnostic, json, render};
use crate::source::Sources;

/// Messages about one scene, as data and as text.
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

    pub fn iter(&self) -> impl ExactSizeIterator<Item = &Diagnostic> {
        self.list.iter()
    }

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

    /// Returns one JSON object for each message, with fixes; `docs/messages.md` describes it.
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
