//! What was worked out for messages, so that no turn of a loop works it out again.
//!
//! **Invariant:** what the first look at a place has found stays. It is reported each time all the same:
//! the message may have been taken back, and whether it is a repetition is for `Diagnostics` to say.

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
    /// It stands where a colour should.
    Color,
    /// A block follows it where a value should stand.
    Block,
    /// It is called where a word should stand.
    Call,
}

#[derive(Debug, Default)]
pub(super) struct Remembered {
    /// By place, the block that it stands in, and whether a block follows it.
    pub unknown: HashMap<(Span, Option<Word>, bool), Rc<Unknown>>,
    /// `None` where nothing is to be said.
    pub undeclared: HashMap<(Span, Symbol), Option<Rc<Diagnostic>>>,
    near: HashMap<(Span, Asked), Option<&'static str>>,
    /// By call, what its macro could not use.
    pub refused: HashMap<Span, Vec<Refused>>,
    /// The file that was last not found at a place.
    pub missing: HashMap<Span, (String, Rc<Diagnostic>)>,
    /// Where the fixes are of what was told as an old form before anything ran.
    pub old_forms: Option<HashSet<Span>>,
}

impl Evaluator<'_> {
    /// Reports what may have been reported before.
    pub(super) fn report_again(&mut self, here: &Here, diagnostic: &Diagnostic) -> Reported {
        if self.repeats(diagnostic) {
            return Reported;
        }
        self.report(here, diagnostic.clone())
    }

    /// Whether nothing comes of a message, which counts as reported then: the rest of it need not be worked
    /// out.
    pub(super) fn repeats(&mut self, diagnostic: &Diagnostic) -> bool {
        let repeats = self.halted || !self.diagnostics.takes(diagnostic);
        if repeats && !self.halted {
            self.count(diagnostic);
        }
        repeats
    }

    /// Notes that something was said, or would have been.
    pub(super) fn count(&mut self, diagnostic: &Diagnostic) {
        self.reports += 1;
        self.faults += u64::from(diagnostic.severity == Severity::Error);
    }

    /// The word that was most likely meant at a place.
    pub(super) fn near(
        &mut self,
        span: Span,
        asked: Asked,
        search: impl FnOnce() -> Option<&'static str>,
    ) -> Option<&'static str> {
        *self.remembered.near.entry((span, asked)).or_insert_with(search)
    }
}
