//! Snapshots of the reported diagnostics, and rollback to them.

use super::Evaluator;
use super::value::Value;

/// A snapshot of the reported diagnostics.
#[derive(Debug, Clone, Copy)]
pub(super) struct Told {
    diagnostics: usize,
    assumed: usize,
    ends: usize,
}

impl Evaluator<'_> {
    /// Returns a snapshot for [`Self::take_back`].
    pub(super) fn told(&self) -> Told {
        Told {
            diagnostics: self.diagnostics.len(),
            assumed: self.assumed.len(),
            ends: self.ends_told.len(),
        }
    }

    /// Withdraws the diagnostics reported since the snapshot, which concerned text that does not count. A
    /// name reported there is reported again at its next occurrence.
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
