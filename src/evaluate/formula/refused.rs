//! Diagnostics for what has no meaning in a function: a vector's component that is not a parameter, a stream
//! of random numbers.

use super::Formula;
use crate::diagnostic::{Code, Diagnostic};
use crate::evaluate::{Evaluator, Here, Outcome, Reported};
use crate::function::Node;
use crate::source::Span;
use crate::syntax::ast::{Argument, BinaryOperator, Callee, ExpressionId, ExpressionKind};
use crate::vocabulary::{Dialect, Word};

impl Evaluator<'_> {
    pub(in crate::evaluate) fn too_long(&mut self, here: &Here, span: Span) -> Reported {
        let diagnostic = Diagnostic::new(Code::OutOfRange, "this function is too long")
            .at(span, "it comes to more than a million operations, or 56 loops inside each other");
        self.report(here, diagnostic)
    }

    /// Reports a division by the literal 0, which POV-Ray 3.7 refuses as well.
    pub(super) fn divides(
        &mut self,
        here: &Here,
        formula: &Formula,
        operator: BinaryOperator,
        [left, right]: [Node; 2],
        span: Span,
    ) -> Outcome<()> {
        if operator != BinaryOperator::Divide
            || self.options.dialect == Dialect::Scene
            || !formula.builder.divides_by_zero(left, right)
        {
            return Ok(());
        }
        let message = "this function divides by zero, whatever it is given";
        let told = Diagnostic::new(Code::DivisionByZero, message);
        Err(self.report(here, told.at(span, "expected another divisor")))
    }

    pub(super) fn no_parameter(&mut self, here: &Here, span: Span) -> Reported {
        let text = self.sources.text(span).to_owned();
        let diagnostic = Diagnostic::new(
            Code::UndeclaredName,
            format!("`{text}` is no parameter of this function"),
        )
        .at(span, "a vector elsewhere; in a function it must be a parameter")
        .help(format!("`function (…, {text}) {{ … }}` would make it one"));
        self.report(here, diagnostic)
    }

    /// Reports a vector function of parameters, `vlength(<x, y, z>)`: a function operates on numbers.
    pub(super) fn length_of_parameters(
        &mut self,
        here: &Here,
        id: ExpressionId,
    ) -> Option<Reported> {
        let ast = &here.unit.ast;
        let ExpressionKind::Call(Callee::Word(Word::Vlength, word), list) =
            here.unit.expression(id).kind
        else {
            return None;
        };
        let [Argument::Expression(vector)] = *ast.arguments(list) else { return None };
        let ExpressionKind::Vector(components) = here.unit.expression(vector).kind else {
            return None;
        };
        let squares: Option<Vec<String>> = ast
            .arguments(components)
            .iter()
            .map(|component| {
                let Argument::Expression(id) = *component else { return None };
                let expression = here.unit.expression(id);
                let text = self.sources.text(expression.span);
                Some(match expression.kind {
                    ExpressionKind::Name(_) | ExpressionKind::Word(_) => format!("{text}*{text}"),
                    _ => format!("pow({text}, 2)"),
                })
            })
            .collect();
        let right = format!("sqrt({})", squares?.join(" + "));
        let message = "a function works on numbers, and `vlength` on a vector";
        let diagnostic = Diagnostic::new(Code::WrongType, message)
            .at(word, "no function of numbers")
            .help(format!("write `{right}`"))
            .fix(here.unit.expression(id).span, right);
        Some(self.report(here, diagnostic))
    }

    /// Reports `rand(S)` in a body, which must have one value for each set of arguments; POV-Ray refuses it
    /// as well.
    pub(super) fn no_stream(&mut self, here: &Here, word: Word, span: Span) -> Reported {
        let message = format!("`{}` cannot be called in a function", word.name());
        let diagnostic = Diagnostic::new(Code::NotCallable, message)
            .at(span, "a function gives the same value for the same arguments, and has no stream")
            .help("draw before it: `#declare R = rand(S);`, and write `R` here");
        let diagnostic = match word {
            Word::Rand => diagnostic
                .help("a macro draws at each call: `#macro R() rand(S) #end`")
                .help("what differs from place to place is noise: `f_noise3d(x, y, z)` of \"functions.inc\""),
            _ => diagnostic,
        };
        self.report(here, diagnostic)
    }
}
