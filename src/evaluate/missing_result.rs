//! Macros that were called for a value and leave none.
//!
//! **Invariant:** the diagnostic is about the call, not about the text after it.

use crate::diagnostic::{Code, Diagnostic};
use crate::source::{ExpansionId, Span};

use super::stream::TokenKind;
use super::{Evaluator, Reported};

impl Evaluator<'_> {
    /// Reports a missing value if the macro called last left no item.
    pub(super) fn blame_macro(&mut self, wanted: &str) -> Option<Reported> {
        let silent = self.silent.take()?;
        Some(silent.called.map_or(Reported, |called| self.leaves_no_value(called, wanted)))
    }

    /// Reports a macro that was called for a value and ended without an item.
    pub(super) fn leaves_no_value(&mut self, called: ExpansionId, wanted: &str) -> Reported {
        if self.wrong_calls.contains(&called) {
            return Reported;
        }
        let Some(&expansion) = self.scene.expansions.get(called) else { return Reported };
        let name = self.scene.expansions.name(&expansion).to_owned();
        let message = format!("expected {wanted}, and macro `{name}` leaves none");
        let mut diagnostic = Diagnostic::new(Code::MissingPart, message)
            .at(expansion.call, "nothing stands here after it has run");
        let symbol = self.scopes.symbol(&name);
        if let Some(declared) = symbol.and_then(|symbol| self.scopes.declared(symbol)) {
            diagnostic = diagnostic.also(declared.site.span, "defined here");
        }
        let help = "the value stands alone in the body: `#macro Twice(N) 2*N #end`";
        self.report_in(expansion.parent, diagnostic.help(help))
    }

    /// Warns when the item after a macro that leaves no value is taken as its value, as in POV-Ray, even if
    /// it is the next object of the scene: `#declare A = Prepare() 3;`.
    pub(super) fn lint_silent_macro(&mut self, target: Span) {
        let first = match self.peek() {
            Some(first)
                if matches!(
                    first.kind,
                    TokenKind::Word(_) | TokenKind::Expression(_) | TokenKind::Literal(_)
                ) =>
            {
                first.span
            }
            // No value: the macro is the cause.
            Some(_) | None => return,
        };
        let called = self.silent.take().and_then(|silent| silent.called);
        let Some(&expansion) = called.and_then(|called| self.scene.expansions.get(called)) else {
            return;
        };
        let name = self.scene.expansions.name(&expansion).to_owned();
        let of = self.sources.text(target);
        let message = format!("macro `{name}` leaves no value, and `{of}` takes what comes next");
        let diagnostic = Diagnostic::new(Code::SilentMacro, message)
            .at(expansion.call, "nothing stands here after it has run")
            .also(first, "this is taken")
            .help("the value stands alone in the body: `#macro Twice(N) 2*N #end`");
        self.report_in(expansion.parent, diagnostic);
    }
}
