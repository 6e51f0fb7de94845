//! Limit on the memory that a scene may use.

use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;

use super::{Evaluator, Here, Reported};

impl Evaluator<'_> {
    /// Returns whether this many more bytes may be used.
    pub(super) fn has_memory(&self, more: u64) -> bool {
        let held = self.stored.saturating_add(self.scopes.held()).saturating_add(more);
        held >> 20 < self.options.limits.memory
    }

    /// Returns how many more bytes may be used.
    pub(super) fn memory_left(&self) -> u64 {
        let held = self.stored.saturating_add(self.scopes.held());
        (self.options.limits.memory << 20).saturating_sub(held)
    }

    /// Reports that the memory limit is reached, and halts the evaluation.
    #[cold]
    pub(super) fn too_much_memory(&mut self, here: &Here, span: Span) -> Reported {
        let limit = self.options.limits.memory;
        let message = format!("what this scene has to remember is larger than {limit} MiB");
        let diagnostic =
            Diagnostic::new(Code::MemoryLimit, message).at(span, "reached before this").help(
                "strings, maps, arrays and lists of transforms count; `--limit memory=N` raises the limit",
            );
        self.halt(here.expansion, diagnostic)
    }
}
