//! Detection of parameters and counters, which have no value yet, in an expression of a formula.

use super::super::Here;
use super::super::function::ParameterName;
use super::Formula;
use crate::source::Span;
use crate::syntax::ast::{Argument, ExpressionId, ExpressionKind};

/// Returns where an expression mentions a parameter or a counter.
pub(super) fn mention(here: &Here, formula: &Formula, id: ExpressionId) -> Option<Span> {
    let mut waiting = vec![id];
    while let Some(id) = waiting.pop() {
        let expression = here.unit.expression(id);
        let name = match expression.kind {
            ExpressionKind::Name(name) => Some(ParameterName::Name(here.symbol(name))),
            ExpressionKind::Word(word) => ParameterName::of_word(word),
            ExpressionKind::Unary(_, a)
            | ExpressionKind::Group(a)
            | ExpressionKind::Component(a, _) => {
                waiting.push(a);
                None
            }
            ExpressionKind::Binary(_, a, b) | ExpressionKind::Index(a, b) => {
                waiting.extend([b, a]);
                None
            }
            ExpressionKind::Conditional(a, b, c) => {
                waiting.extend([c, b, a]);
                None
            }
            ExpressionKind::Vector(arguments) | ExpressionKind::Call(_, arguments) => {
                let arguments = here.unit.ast.arguments(arguments).iter().rev();
                waiting.extend(arguments.filter_map(|argument| match argument {
                    Argument::Expression(id) => Some(*id),
                    Argument::Items(_) => None,
                }));
                None
            }
            ExpressionKind::Number(_)
            | ExpressionKind::Triple(_)
            | ExpressionKind::String
            | ExpressionKind::GroupItems(_)
            | ExpressionKind::Joint
            | ExpressionKind::Missing => None,
        };
        if name.is_some_and(|name| formula.named(name).is_some()) {
            return Some(expression.span);
        }
    }
    None
}
