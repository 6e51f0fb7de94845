//! Messages for the author of a scene: what is wrong, where, and how to mend it.
//!
//! **Invariant:** plain data; nothing here prints. Style: lower case, no full stop, the author's words in
//! backticks; each message says what is wrong *and* what was expected.

mod allowance;
mod code;
mod cut;
mod excerpt;
pub mod json;
mod level;
pub mod mend;
mod messages;
pub mod narrate;
mod quote;
pub mod render;
pub mod sarif;
pub mod suggest;
mod wrap;

pub(crate) use allowance::{Allowance, allowances};
pub use code::Code;
pub use level::{Level, Levels};
pub use messages::Messages;

use std::collections::HashMap;

use crate::source::{Expansion, ExpansionKind, Expansions, Site, Span};

/// How bad it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// Output of the author's own `#debug`.
    Note,
    /// Probably a mistake; the picture is rendered anyway.
    Warning,
    /// Certainly a mistake; no picture is rendered.
    Error,
}

/// A source location and its role in the message.
#[derive(Debug, Clone, PartialEq)]
pub struct Label {
    /// The location.
    pub span: Span,
    /// What is there, in a few words.
    pub text: String,
    /// Whether it is the location of the problem itself.
    pub primary: bool,
}

/// A replacement that can be applied automatically. An empty span inserts.
#[derive(Debug, Clone, PartialEq)]
pub struct Fix {
    /// The text to replace.
    pub span: Span,
    /// The new text.
    pub text: String,
}

/// One step of the evaluation that led to the primary label.
#[derive(Debug, Clone, PartialEq)]
pub struct TraceStep {
    /// The call or include.
    pub span: Span,
    /// Describes the step: ``in this call of macro `Tree` ``.
    pub text: String,
}

/// A message about a scene.
///
/// [`Messages::sources`] turns its spans into lines and columns.
#[derive(Debug, Clone, PartialEq)]
pub struct Diagnostic {
    /// Its kind, with a page of its own: [`Code::page`].
    pub code: Code,
    /// Whether it prevents a picture.
    pub severity: Severity,
    /// What is wrong, in one sentence.
    pub message: String,
    /// The first one is primary, if any is; messages about the scene as a unit have none.
    pub labels: Vec<Label>,
    /// Innermost step first.
    pub trace: Vec<TraceStep>,
    /// What to do, or why it is wrong.
    pub help: Vec<String>,
    /// The replacements that mend it, all of them together.
    pub fixes: Vec<Fix>,
}

impl Diagnostic {
    /// Returns a message without locations, with the severity of its code.
    pub fn new(code: Code, message: impl Into<String>) -> Self {
        Self {
            code,
            severity: code.severity(),
            message: message.into(),
            labels: Vec::new(),
            trace: Vec::new(),
            help: Vec::new(),
            fixes: Vec::new(),
        }
    }

    /// Adds the primary label: the location of the problem, and what is wrong there.
    pub fn at(mut self, span: Span, text: impl Into<String>) -> Self {
        self.labels.insert(0, Label { span, text: text.into(), primary: true });
        self
    }

    /// Adds a secondary label: a related location, such as a declaration or an opening brace.
    pub fn also(mut self, span: Span, text: impl Into<String>) -> Self {
        self.labels.push(Label { span, text: text.into(), primary: false });
        self
    }

    /// Adds a line of help.
    pub fn help(mut self, text: impl Into<String>) -> Self {
        self.help.push(text.into());
        self
    }

    /// Adds a replacement that mends it.
    pub fn fix(mut self, span: Span, text: impl Into<String>) -> Self {
        self.fixes.push(Fix { span, text: text.into() });
        self
    }

    /// Adds the calls and includes that led to `site`; a repeated call is listed once.
    pub(crate) fn traced(mut self, site: Site, expansions: &Expansions) -> Self {
        let mut times: HashMap<Span, usize> = HashMap::new();
        self.trace.clear();
        for expansion in expansions.chain(site.expansion) {
            let times = times.entry(expansion.call).or_default();
            *times += 1;
            if *times == 1 {
                self.trace.push(TraceStep::of(expansion, expansions.name(expansion)));
            }
        }
        for step in &mut self.trace {
            if let Some(&times @ 2..) = times.get(&step.span) {
                step.text += &format!(", {times} times");
            }
        }
        self
    }

    /// Turns the error into a warning, for scenes that POV-Ray 3.7 renders anyway.
    pub fn as_warning(mut self) -> Self {
        self.severity = Severity::Warning;
        self
    }

    /// Whether this is an error by itself. A warning that was denied counts as an error only for the caller
    /// that denied it.
    pub fn is_error(&self) -> bool {
        self.code.severity() == Severity::Error && self.severity == Severity::Error
    }

    /// Returns the location of the problem.
    pub fn primary(&self) -> Option<&Label> {
        self.labels.iter().find(|label| label.primary)
    }

    /// Returns what two messages must have in common to be duplicates.
    fn place(&self) -> (Code, Option<Span>) {
        (self.code, self.primary().map(|label| label.span))
    }
}

impl TraceStep {
    fn of(expansion: &Expansion, name: &str) -> Self {
        let text = match expansion.kind {
            ExpansionKind::Macro => format!("in this call of macro `{name}`"),
            ExpansionKind::Include => format!("in this include of `{name}`"),
        };
        Self { span: expansion.call, text }
    }
}

/// Maximum number of messages of one code at one location: in loops, they differ only in their numbers.
const MOST_AT_A_PLACE: usize = 16;
/// Maximum number of `#warning` messages at its location that a new one is compared with.
const MOST_COMPARED: usize = 256;

/// Collects the messages of all compilation stages. The same message at the same location is kept once.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Diagnostics {
    list: Vec<Diagnostic>,
    /// Ascending indices into `list` by code and location; without notes.
    kept: HashMap<(Code, Option<Span>), Vec<usize>>,
    /// Number of messages per code and location that differ from a kept one only in their numbers.
    turned: HashMap<(Code, Option<Span>), usize>,
    levels: Levels,
    allowances: Vec<Allowance>,
}

impl Diagnostics {
    /// Keeps or drops all lints.
    pub fn new(lints: bool) -> Self {
        Self::with_levels(Levels::new(lints))
    }

    /// Drops lints, keeps them or turns them into errors, according to `levels`.
    pub fn with_levels(levels: Levels) -> Self {
        Self { levels, ..Self::default() }
    }

    /// Marks the main file as a complete scene, for which an empty picture is always reported.
    pub(crate) fn of_whole_scene(&mut self) {
        self.levels.of_whole_scene();
    }

    /// Adds a message, unless its level or a comment drops it.
    pub fn push(&mut self, mut diagnostic: Diagnostic) {
        if let Some(level) = self.level(&diagnostic) {
            let Some(severity) = level.severity() else { return };
            diagnostic.severity = severity;
        }
        diagnostic.shorten();
        if self.takes(&diagnostic) {
            self.keep(diagnostic);
        }
    }

    /// Adds a secondary label to the first message that matches `is_meant`. Returns `false` if there is
    /// none.
    pub(crate) fn join(
        &mut self,
        is_meant: impl Fn(&Diagnostic) -> bool,
        span: Span,
        text: impl Into<String>,
    ) -> bool {
        let Some(one) = self.list.iter_mut().find(|one| is_meant(one)) else { return false };
        one.labels.push(Label { span, text: text.into(), primary: false });
        true
    }

    /// Returns the level of a message that is a warning.
    fn level(&self, diagnostic: &Diagnostic) -> Option<Level> {
        match diagnostic.is_error() {
            true => None,
            false => self.levels.of(diagnostic.code),
        }
    }

    /// Whether a lint is reported at all.
    pub(crate) fn tells(&self, lint: Code) -> bool {
        self.levels.of(lint) != Some(Level::Allow)
    }

    /// Whether a message would be kept. Loop iterations and repeated calls produce the same message again,
    /// and it need not be computed in full for that.
    pub(crate) fn takes(&self, diagnostic: &Diagnostic) -> bool {
        if self.level(diagnostic) == Some(Level::Allow) {
            return false;
        }
        let Some(kept) = self.kept.get(&diagnostic.place()) else { return true };
        let own = diagnostic.code == Code::AuthorWarning || diagnostic.primary().is_none();
        let turned = self.turned.get(&diagnostic.place()).copied().unwrap_or(0);
        if !own && kept.len() + turned >= MOST_AT_A_PLACE {
            return false;
        }
        let message = diagnostic.short_message();
        let mut latest = kept.iter().rev().take(MOST_COMPARED);
        !latest.any(|&at| self.list[at].message == message)
    }

    /// Whether a message differs from a kept one only in its numbers, as in another iteration of a loop or
    /// another call from the same location. The author's own messages each count.
    pub(crate) fn turns_of(&mut self, diagnostic: &Diagnostic) -> bool {
        let place = diagnostic.place();
        let words = |one: &Diagnostic| -> String {
            let of_number = |c: &char| c.is_ascii_digit() || matches!(c, '.' | '-');
            one.message.chars().filter(|c| !of_number(c)).collect()
        };
        let calls = |one: &Diagnostic| one.trace.iter().map(|step| step.span).collect::<Vec<_>>();
        let own = diagnostic.code == Code::AuthorWarning || place.1.is_none();
        let kept = self.kept.get(&place).filter(|_| !own);
        let turns = kept.is_some_and(|kept| {
            kept.iter().any(|&at| {
                let one = &self.list[at];
                words(one) == words(diagnostic) && calls(one) == calls(diagnostic)
            })
        });
        if turns {
            *self.turned.entry(place).or_default() += 1;
        }
        turns
    }

    fn keep(&mut self, diagnostic: Diagnostic) {
        if diagnostic.severity != Severity::Note {
            self.kept.entry(diagnostic.place()).or_default().push(self.list.len());
        }
        self.list.push(diagnostic);
    }

    /// Removes and returns the messages after the first `len`.
    fn cut(&mut self, len: usize) -> Vec<Diagnostic> {
        let later = self.list.split_off(len.min(self.list.len()));
        for one in &later {
            self.turned.remove(&one.place());
            if let Some(kept) = self.kept.get_mut(&one.place()) {
                while kept.last().is_some_and(|at| *at >= len) {
                    kept.pop();
                }
            }
        }
        later
    }

    /// Discards the messages after the first `len`, because they concern code that is not used.
    pub(crate) fn forget_after(&mut self, len: usize) {
        self.cut(len);
    }

    /// Keeps only those messages after the first `len` for which `keep` returns true.
    pub(crate) fn retain_after(&mut self, len: usize, keep: impl Fn(&Diagnostic) -> bool) {
        for one in self.cut(len).into_iter().filter(keep) {
            self.keep(one);
        }
    }

    /// Registers allowances from comments. Lints already reported are kept.
    pub(crate) fn allow(&mut self, allowances: Vec<Allowance>) {
        self.allowances.extend(allowances);
    }

    /// Whether a comment allows a lint at this location. If one message stands for several locations, check
    /// each of them.
    pub(crate) fn allows(&self, lint: Code, place: Span) -> bool {
        self.allowances.iter().any(|one| one.reaches(lint, place))
    }

    /// Drops those messages after the first `len` that a comment allows.
    pub(crate) fn drop_allowed_after(&mut self, len: usize) {
        for one in self.cut(len) {
            if !self.allowances.iter().any(|allowed| allowed.silences(&one)) {
                self.keep(one);
            }
        }
    }

    /// Whether there are errors. A warning that was denied counts as an error only for the caller that
    /// denied it.
    pub fn has_errors(&self) -> bool {
        self.list.iter().any(Diagnostic::is_error)
    }

    /// Adds a help text to the first error, if there is one.
    pub(crate) fn help_first_error(&mut self, text: impl Into<String>) {
        if let Some(first) = self.list.iter_mut().find(|one| one.is_error()) {
            first.help.push(text.into());
        }
    }

    /// Returns the messages in the order in which they were reported.
    pub fn iter(&self) -> impl Iterator<Item = &Diagnostic> {
        self.list.iter()
    }

    /// Returns the messages in reading order: notes first, as they were issued; then by file, from top to
    /// bottom.
    pub fn in_text_order(&self) -> Vec<&Diagnostic> {
        let mut list: Vec<&Diagnostic> = self.list.iter().collect();
        list.sort_by_key(|diagnostic| {
            let place = diagnostic.primary().map(|label| (label.span.file, label.span.start));
            match diagnostic.severity {
                Severity::Note => (0, None),
                Severity::Warning | Severity::Error if place.is_some() => (1, place),
                Severity::Warning | Severity::Error => (2, None),
            }
        });
        list
    }

    /// Returns their number.
    pub fn len(&self) -> usize {
        self.list.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }
}
