//! How much has been told, and taking it back.

use super::Evaluator;
use super::value::Value;

/// How much was told at some time.
#[derive(Debug, Clone, Copy)]
pub(super) struct Told {
    diagnostics: usize,
    assumed: usize,
    ends: usize,
}

impl Evaluator<'_> {
    /// How much was told so far, for [`Self::take_back`].
    pub(super) fn told(&self) -> Told {
        Told {
            diagnostics: self.diagnostics.len(),
            assumed: self.assumed.len(),
            ends: self.ends_told.len(),
        }
    }

    /// Takes back what was told since: it was about text that does not count. A name that was told there is
    /// told where it stands next.
    pub(super) fn take_back(&mut self, since: Told) {
        self.diagnostics.forget_after(since.diagnostics);
        self.ends_told.truncate(since.ends);
        for symbol in self.assumed.drain(since.assumed.min(self.assumed.len())..) {
            if let Some(Value::Broken) = self.scopes.read(symbol) {
                self.scopes.undefine(symbol);
            }
        }
    }
}
