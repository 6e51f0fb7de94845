//! Equations and inequalities in an isosurface, which needs the difference of the two sides: `isosurface {
//! function { y = sin(x) } … }`.

use crate::diagnostic::{Code, Diagnostic};
use crate::evaluate::enclosure::Contents;
use crate::evaluate::stream::{Token, TokenKind};
use crate::evaluate::{Evaluator, Here};
use crate::source::Span;
use crate::syntax::ast::{BinaryOperator, ExpressionKind, ItemKind};

/// Discontinuous or piecewise functions: an equation with one may describe a solid.
const STEPS: [&str; 9] = ["floor", "ceil", "int", "mod", "div", "select", "abs", "min", "max"];

/// The diagnostic for a comparison, unless it is intended.
pub(in crate::evaluate) struct Compared {
    pub here: Here,
    pub diagnostic: Diagnostic,
    pub is_equation: bool,
}

impl Evaluator<'_> {
    /// Examines the block of an isosurface's function, which comes next.
    pub(in crate::evaluate) fn compared_surface(&mut self) -> Option<Compared> {
        let Token { kind: TokenKind::Block(contents), here, .. } = self.peek()? else {
            return None;
        };
        let (here, Contents::Items(items)) = (here.clone(), *contents) else { return None };
        let [item] = here.unit.ast.items(items) else { return None };
        let ItemKind::Expression(id) = item.kind else { return None };
        let ExpressionKind::Binary(comparison, left, right) = here.unit.expression(id).kind else {
            return None;
        };
        use BinaryOperator::{Equal, Greater, GreaterOrEqual, Less, LessOrEqual};
        let is_equation = comparison == Equal;
        if !(is_equation || matches!(comparison, Less | LessOrEqual | Greater | GreaterOrEqual)) {
            return None;
        }
        let side = |id| here.unit.expression(id);
        let (first, second) = (side(left), side(right));
        // Inside is less.
        let (left, right) = match comparison {
            Greater | GreaterOrEqual => (second, first),
            _ => (first, second),
        };
        // `a = b = c` is something else.
        if let ExpressionKind::Binary(operator, ..) = left.kind
            && !is_arithmetic(operator)
        {
            return None;
        }
        let span = here.unit.expression(id).span;
        let has_step =
            |name: &&str| self.sources.text(span).split(is_no_letter).any(|word| word == *name);
        if is_equation && STEPS.iter().any(has_step) {
            return None;
        }
        let (before, behind) = (self.sources.text(left.span), self.sources.text(right.span));
        let written = match right.kind {
            ExpressionKind::Number(0.0) => before.to_owned(),
            ExpressionKind::Binary(BinaryOperator::Add | BinaryOperator::Subtract, ..)
            | ExpressionKind::Unary(..) => format!("{before} - ({behind})"),
            ExpressionKind::Binary(operator, ..) if !is_arithmetic(operator) => return None,
            ExpressionKind::Conditional(..) => return None,
            _ => format!("{before} - {behind}"),
        };
        let between = Span { start: first.span.end, end: second.span.start, ..span };
        let sign = self.sources.text(between).find(['=', '<', '>']).map(|at| {
            let start = between.start + at as u32;
            let signs =
                if comparison == LessOrEqual || comparison == GreaterOrEqual { 2 } else { 1 };
            Span { start, end: start + signs, ..span }
        });
        let holds = if is_equation { "both sides are equal" } else { "it holds" };
        let message =
            format!("this formula is a comparison: it is 1 where {holds}, and 0 elsewhere");
        let diagnostic = Diagnostic::new(Code::ComparedSurface, message)
            .at(
                sign.unwrap_or(span),
                "the surface is where a formula is 0, so that inside it is less",
            )
            .help(format!("write `{written}`"))
            .fix(span, written);
        Some(Compared { here, diagnostic, is_equation })
    }
}

fn is_no_letter(c: char) -> bool {
    !(c.is_ascii_alphanumeric() || c == '_')
}

fn is_arithmetic(operator: BinaryOperator) -> bool {
    use BinaryOperator::{Add, Divide, Multiply, Subtract};
    matches!(operator, Add | Subtract | Multiply | Divide)
}
