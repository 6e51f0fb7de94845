//! What a call of a macro was given and its body cannot use: one mistake of the call, however often the body
//! has it.
//!
//! **Invariant:** only what was told, and still is, makes anything else its repetition.

use crate::source::{ExpansionKind, Span};

use super::value::Value;
use super::{Evaluator, Here, Symbol};

/// The first argument of a call that its macro could not use.
#[derive(Debug, Clone, Copy)]
pub(super) struct Refused {
    parameter: Symbol,
    kind: &'static str,
    /// Where that was told.
    told: Span,
}

impl Evaluator<'_> {
    /// Whether `found`, which is of no use at `span`, is a parameter of the macro that is being run, and says
    /// nothing new: that parameter was told, or another one of another kind, so that the two arguments rather
    /// changed places.
    pub(super) fn is_refused_again(&mut self, here: &Here, span: Span, found: &Value) -> bool {
        let mut calls = self.scene.expansions.chain(here.expansion);
        let Some(call) = calls.find(|call| call.kind == ExpansionKind::Macro).map(|call| call.call)
        else {
            return false;
        };
        let Some(parameter) = self.scopes.symbol(self.sources.text(span)) else { return false };
        if !self.is_a_parameter(parameter) {
            return false;
        }
        let refused = Refused { parameter, kind: found.kind(), told: span };
        if let Some(first) = self.remembered.refused.get(&call)
            && first.told != span
            && (first.parameter == parameter || first.kind != refused.kind)
            && self.tells_at(first.told)
        {
            return true;
        }
        self.remembered.refused.insert(call, refused);
        false
    }

    fn is_a_parameter(&self, symbol: Symbol) -> bool {
        self.macros.iter().any(|one| one.parameters.iter().any(|&(name, _)| name == symbol))
    }

    fn tells_at(&self, place: Span) -> bool {
        self.diagnostics.iter().any(|told| told.primary().is_some_and(|label| label.span == place))
    }
}
