//! Arguments of calls in a formula: one expression each, or what directives leave.

use super::Formula;
use crate::diagnostic::{Code, Diagnostic};
use crate::evaluate::stream::TokenKind;
use crate::evaluate::{Evaluator, Here, Outcome};
use crate::function::Node;
use crate::source::Span;
use crate::syntax::ast::{Argument, Arguments};

impl Evaluator<'_> {
    pub(super) fn argument_nodes(
        &mut self,
        here: &Here,
        formula: &mut Formula,
        arguments: Arguments,
    ) -> Outcome<Vec<Node>> {
        let unit = here.unit.clone();
        let mut nodes = Vec::new();
        let mut outcome = Ok(());
        for argument in unit.ast.arguments(arguments) {
            let node = match *argument {
                Argument::Expression(id) => self.node(here, formula, id),
                Argument::Items(items) => {
                    let first = unit.ast.items(items).first();
                    let span = first.map_or(Span::new(unit.ast.file, 0, 0), |item| item.span);
                    self.inside(here, items, |evaluator| evaluator.only_node(formula, (here, span)))
                }
            };
            match node {
                Ok(node) => nodes.push(node),
                Err(reported) => outcome = Err(reported),
            }
        }
        outcome.map(|()| nodes)
    }

    /// Returns the only expression that the current items leave: `#if (A) x #else y #end`.
    pub(in crate::evaluate) fn only_node(
        &mut self,
        formula: &mut Formula,
        otherwise: (&Here, Span),
    ) -> Outcome<Node> {
        let next = self.next();
        let Some(TokenKind::Expression(id)) = next.as_ref().map(|next| next.kind.clone()) else {
            return Err(self.expected("a number", next.as_ref(), otherwise));
        };
        let here = next.map_or(otherwise.0.clone(), |next| next.here);
        let node = self.joined_node(&here, formula, id)?;
        if let Some(extra) = self.next() {
            let message = "one value was expected here, and there are more";
            let diagnostic = Diagnostic::new(Code::ExtraPart, message)
                .at(extra.span, "this is more than one value");
            return Err(self.report(&extra.here, diagnostic));
        }
        Ok(node)
    }
}
