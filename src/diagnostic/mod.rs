//! What we tell the author: a code, a sentence, the places it concerns, and what to do.
//!
//! **Invariant:** plain data; nothing here prints. Style: lower case, no full stop, the author's
//! words in backticks, says what is wrong *and* what was expected.

mod allowance;
mod code;
mod cut;
mod excerpt;
pub mod json;
mod level;
pub mod mend;
pub mod narrate;
mod quote;
pub mod render;
pub mod suggest;
mod wrap;

pub use allowance::{Allowance, allowances};
pub use code::Code;
pub use level::{Level, Levels};

use std::collections::HashMap;

use crate::source::{Expansion, ExpansionKind, Expansions, Site, Span};

#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// The author's own `#debug`.
    Note,
    /// Probably a mistake; the picture is made all the same.
    Warning,
    /// Certainly a mistake; no picture is made.
    Error,
}

/// A place and what it has to do with the matter.
#[derive(Debug, Clone, PartialEq)]
pub struct Label {
    pub span: Span,
    pub text: String,
    pub primary: bool,
}

/// A replacement that can be applied by machine. An empty span inserts.
#[derive(Debug, Clone, PartialEq)]
pub struct Fix {
    pub span: Span,
    pub text: String,
}

/// One step of how evaluation came to the primary label.
#[derive(Debug, Clone, PartialEq)]
pub struct TraceStep {
    pub span: Span,
    pub text: String,
}

#[derive(Debug, Clone, PartialEq)]
pub struct Diagnostic {
    pub code: Code,
    pub severity: Severity,
    pub message: String,
    /// The first is primary where there is one; a whole-scene message has none.
    pub labels: Vec<Label>,
    /// Innermost first.
    pub trace: Vec<TraceStep>,
    pub help: Vec<String>,
    pub fixes: Vec<Fix>,
}

impl Diagnostic {
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

    /// The place that is wrong, and why it is wrong here.
    pub fn at(mut self, span: Span, text: impl Into<String>) -> Self {
        self.labels.insert(0, Label { span, text: text.into(), primary: true });
        self
    }

    /// Another place that has to do with it: a declaration, an opening brace.
    pub fn also(mut self, span: Span, text: impl Into<String>) -> Self {
        self.labels.push(Label { span, text: text.into(), primary: false });
        self
    }

    pub fn help(mut self, text: impl Into<String>) -> Self {
        self.help.push(text.into());
        self
    }

    pub fn fix(mut self, span: Span, text: impl Into<String>) -> Self {
        self.fixes.push(Fix { span, text: text.into() });
        self
    }

    /// Adds the calls and includes that led to `site`; a call that was made again and again stands once.
    pub fn traced(mut self, site: Site, expansions: &Expansions) -> Self {
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

    /// The same as a warning: an opinion on what POV-Ray 3.7 renders all the same.
    pub fn as_warning(mut self) -> Self {
        self.severity = Severity::Warning;
        self
    }

    /// Whether something is certainly wrong; a denied warning is an error only to who denied it.
    pub fn is_error(&self) -> bool {
        self.code.severity() == Severity::Error && self.severity == Severity::Error
    }

    pub fn primary(&self) -> Option<&Label> {
        self.labels.iter().find(|label| label.primary)
    }

    /// What two messages share that may be one.
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

/// How many messages of one code are kept at one place: what loops say there differs in its numbers only.
const MOST_AT_A_PLACE: usize = 16;
/// How many of what the author's own `#warning` has said at its place a new one is compared with.
const MOST_COMPARED: usize = 256;

/// The sink every verb reports to. The same message at the same place is kept once.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Diagnostics {
    list: Vec<Diagnostic>,
    /// Where in the list the messages of a code at a place are, in rising order; notes are not there.
    kept: HashMap<(Code, Option<Span>), Vec<usize>>,
    /// How often a message at a place was one that is kept but for its numbers.
    turned: HashMap<(Code, Option<Span>), usize>,
    levels: Levels,
    allowances: Vec<Allowance>,
}

impl Diagnostics {
    /// A sink that keeps all lints, or drops them.
    pub fn new(lints: bool) -> Self {
        Self::with_levels(Levels::new(lints))
    }

    /// A sink that drops lints, keeps them or makes errors of them, each as it is said.
    pub fn with_levels(levels: Levels) -> Self {
        Self { levels, ..Self::default() }
    }

    /// The main file is a whole scene: that it shows nothing is told in any case.
    pub fn of_whole_scene(&mut self) {
        self.levels.of_whole_scene();
    }

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

    /// Adds a place to the first message that `is_meant` says yes to; `false` where there is none.
    pub fn join(
        &mut self,
        is_meant: impl Fn(&Diagnostic) -> bool,
        span: Span,
        text: impl Into<String>,
    ) -> bool {
        let Some(one) = self.list.iter_mut().find(|one| is_meant(one)) else { return false };
        one.labels.push(Label { span, text: text.into(), primary: false });
        true
    }

    /// The level of a message that is a warning.
    fn level(&self, diagnostic: &Diagnostic) -> Option<Level> {
        match diagnostic.is_error() {
            true => None,
            false => self.levels.of(diagnostic.code),
        }
    }

    /// Whether a lint is told at all.
    pub fn tells(&self, lint: Code) -> bool {
        self.levels.of(lint) != Some(Level::Allow)
    }

    /// Whether a message would be kept. Loop turns and repeated calls say the same thing again, and once is
    /// enough: what is said again need not be worked out.
    pub fn takes(&self, diagnostic: &Diagnostic) -> bool {
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

    /// Whether a message is one that is kept but for its numbers: another turn of a loop, or another call from
    /// the same place, says nothing new. Of its author's own each counts.
    pub fn turns_of(&mut self, diagnostic: &Diagnostic) -> bool {
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

    /// Takes the messages after the first `len` out.
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

    /// Takes back what was said after the first `len` messages: it was about code that does not count.
    pub fn forget_after(&mut self, len: usize) {
        self.cut(len);
    }

    /// Keeps, of the messages after the first `len`, those that `keep` says yes to.
    pub fn retain_after(&mut self, len: usize, keep: impl Fn(&Diagnostic) -> bool) {
        for one in self.cut(len).into_iter().filter(keep) {
            self.keep(one);
        }
    }

    /// Lints that a comment allows: those that are told already stay.
    pub fn allow(&mut self, allowances: Vec<Allowance>) {
        self.allowances.extend(allowances);
    }

    /// Whether a comment allows a lint at this place: where one message stands for several places, each
    /// has to ask for itself.
    pub fn allows(&self, lint: Code, place: Span) -> bool {
        self.allowances.iter().any(|one| one.reaches(lint, place))
    }

    /// Drops, of the messages after the first `len`, those that a comment allows.
    pub fn drop_allowed_after(&mut self, len: usize) {
        for one in self.cut(len) {
            if !self.allowances.iter().any(|allowed| allowed.silences(&one)) {
                self.keep(one);
            }
        }
    }

    /// Whether anything is certainly wrong; a denied warning is an error only to who denied it.
    pub fn has_errors(&self) -> bool {
        self.list.iter().any(Diagnostic::is_error)
    }

    /// Adds a help to the first error, where there is one.
    pub fn help_first_error(&mut self, text: impl Into<String>) {
        if let Some(first) = self.list.iter_mut().find(|one| one.is_error()) {
            first.help.push(text.into());
        }
    }

    pub fn iter(&self) -> impl Iterator<Item = &Diagnostic> {
        self.list.iter()
    }

    /// As an author reads them: notes first, as they were said; then file by file, from top to bottom.
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

    pub fn len(&self) -> usize {
        self.list.len()
    }

    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }
}
