//! Cache of analyses for messages, so that each turn of a loop does not repeat them.
//!
//! **Invariant:** the result of the first analysis of a span is kept. It is reported each time nevertheless:
//! the message may have been withdrawn, and `Diagnostics` decides whether it is a repetition.

use std::collections::{HashMap, HashSet};
use std::rc::Rc;

use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;
use crate::vocabulary::Word;

use super::argument::Refused;
use super::block::Unknown;
use super::{Evaluator, Here, Reported, Symbol};

/// Why a name was compared with words of the language.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum Asked {
    /// It appears where a colour is expected.
    Color,
    /// It appears with a block where a value is expected.
    Block,
    /// It is called where a keyword is expected.
    Call,
}

#[derive(Debug, Default)]
pub(super) struct Remembered {
    /// By span, enclosing block and whether a block follows it.
    pub unknown: HashMap<(Span, Option<Word>, bool), Rc<Unknown>>,
    /// `None` if nothing is to be reported.
    pub undeclared: HashMap<(Span, Symbol), Option<Rc<Diagnostic>>>,
    near: HashMap<(Span, Asked), Option<&'static str>>,
    /// By call, the arguments that its macro could not use.
    pub refused: HashMap<Span, Vec<Refused>>,
    /// The file that was last not found at a span.
    pub missing: HashMap<Span, (String, Rc<Diagnostic>)>,
    /// Spans of the fixes for old forms that were reported before evaluation.
    pub old_forms: Option<HashSet<Span>>,
}

impl Evaluator<'_> {
    /// Reports a diagnostic that may have been reported before.
    pub(super) fn report_again(&mut self, here: &Here, diagnostic: &Diagnostic) -> Reported {
        if self.repeats(diagnostic) {
            return Reported;
        }
        self.report(here, diagnostic.clone())
    }

    /// Returns whether a message has no effect, in which case it counts as reported: the rest of it need not
    /// be worked out.
    pub(super) fn repeats(&mut self, diagnostic: &Diagnostic) -> bool {
        let repeats = self.halted || !self.diagnostics.takes(diagnostic);
        if repeats && !self.halted {
            self.count(diagnostic);
        }
        repeats
    }

    /// Counts a diagnostic that was reported, or would have been.
    pub(super) fn count(&mut self, diagnostic: &Diagnostic) {
        self.reports += 1;
        self.faults += u64::from(diagnostic.severity == Severity::Error);
    }

    /// Returns the word that was most likely meant at a span.
    pub(super) fn near(
        &mut self,
        span: Span,
        asked: Asked,
        search: impl FnOnce() -> Option<&'static str>,
    ) -> Option<&'static str> {
        *self.remembered.near.entry((span, asked)).or_insert_with(search)
    }
}
