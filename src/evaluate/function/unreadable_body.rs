//! Functions whose body could not be read; their number of parameters is known nevertheless.

use crate::source::Span;
use crate::syntax::ast::Arguments;

use super::super::scope::Symbol;
use super::super::{Evaluator, Here, Reported};

impl Evaluator<'_> {
    /// Records, after a `#declare` of `symbol`, what is known of an intended function.
    pub(in crate::evaluate) fn note_broken(&mut self, symbol: Symbol, failed: bool) {
        match self.broken_function.take().filter(|_| failed) {
            Some(parameters) => self.broken_functions.insert(symbol, parameters),
            None if self.broken_functions.is_empty() => None,
            None => self.broken_functions.remove(&symbol),
        };
    }

    /// Checks the number of arguments in a call of a function that was reported.
    pub(in crate::evaluate) fn broken_call(
        &mut self,
        here: &Here,
        symbol: Symbol,
        arguments: Arguments,
        span: Span,
    ) -> Reported {
        if let Some(&wanted) = self.broken_functions.get(&symbol) {
            let list = here.unit.ast.arguments(arguments);
            let _ = self.check_count(here, wanted, (list.len(), list), span);
        }
        Reported
    }
}
