//! Non-finite results: an error in a `.scene`; a warning in a `.pov`, where calculations go on with them as
//! in POV-Ray 3.7.

use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::syntax::ast::{BinaryOperator, ExpressionId, ExpressionKind};
use crate::vocabulary::{Dialect, Word};

use super::builtin::{self, CallError, CallErrorKind};
use super::value::{self, OperationError, Value};
use super::{Evaluator, Here, Outcome};

/// The range of 32-bit integers, in which POV-Ray 3.7 stores integer parts.
const WHOLE: std::ops::RangeInclusive<f64> = i32::MIN as f64..=i32::MAX as f64;

impl Evaluator<'_> {
    /// Handles an operation on `values` without a finite result. Reports it only if the operands themselves
    /// are finite.
    #[cold]
    pub(super) fn no_plain_result(
        &mut self,
        here: &Here,
        operator: BinaryOperator,
        error: OperationError,
        (span, operands): (Span, [ExpressionId; 2]),
        values: [&Value; 2],
    ) -> Outcome<Value> {
        let [a, b] = values;
        let symbol = format!("`{}`", operator.symbol());
        match value::unbounded(operator, a, b, self.comparison()) {
            Ok(result) if self.options.dialect == Dialect::Pov => {
                if a.is_finite() && b.is_finite() {
                    let diagnostic = self.no_finite_result(here, error, span, operands[1]);
                    self.opinion(here, diagnostic)?;
                }
                Ok(result)
            }
            _ => Err(self.operation_error(here, error, &symbol, span, operands, values)),
        }
    }

    /// Returns whether POV-Ray's result of a call differs from this one because its integer part needs more
    /// than 32 bits.
    pub(super) fn is_cut_off(&self, word: Word, result: f64) -> bool {
        matches!(word, Word::Int | Word::Div)
            && self.options.dialect == Dialect::Pov
            && !WHOLE.contains(&result)
    }

    /// Returns POV-Ray's result for a call that has none here, or a different one; `None` if POV-Ray refuses
    /// it too.
    pub(super) fn unbounded_call(
        &self,
        word: Word,
        values: &[Value],
        result: &Result<Value, CallError>,
    ) -> Option<Value> {
        let has_another = match result {
            Ok(value) => value.as_number().is_some_and(|number| self.is_cut_off(word, number)),
            Err(error) => matches!(
                error.kind,
                CallErrorKind::OutOfRange
                    | CallErrorKind::DivisionByZero
                    | CallErrorKind::ZeroVector
                    | CallErrorKind::NotFinite
            ),
        };
        let rendered = has_another && self.options.dialect == Dialect::Pov;
        rendered.then(|| builtin::rendered(word, values)).flatten()
    }

    /// Handles a function's value that is not finite.
    #[cold]
    pub(super) fn no_finite_value(
        &mut self,
        here: &Here,
        span: Span,
        value: f64,
    ) -> Outcome<Value> {
        let gives = if value.is_nan() { "no number" } else { "infinity" };
        let diagnostic =
            Diagnostic::new(Code::NotANumber, "this function has no finite value here")
                .at(span, format!("the formula gives {gives}"))
                .help("it divides by zero, or takes a root or a logarithm of what has none");
        self.opinion(here, diagnostic)?;
        Ok(Value::Number(value))
    }

    /// Explains why an operation has no finite result.
    pub(super) fn no_finite_result(
        &self,
        here: &Here,
        error: OperationError,
        span: Span,
        right: ExpressionId,
    ) -> Diagnostic {
        if error == OperationError::NotFinite {
            return Diagnostic::new(Code::NotANumber, "this calculation has no finite result")
                .at(span, "the result is larger than any number (about 1.8e308)");
        }
        let divisor = here.unit.expression(right);
        let diagnostic = Diagnostic::new(Code::DivisionByZero, "division by zero");
        match divisor.kind {
            ExpressionKind::Number(_) => diagnostic.at(divisor.span, "this is zero"),
            ExpressionKind::Name(name) => {
                let text = self.sources.text(divisor.span);
                let diagnostic = diagnostic.at(divisor.span, format!("`{text}` is zero here"));
                match self.scopes.declared(here.symbol(name)) {
                    Some(declared) => diagnostic.also(declared.site.span, "declared here"),
                    None => diagnostic,
                }
            }
            _ => diagnostic.at(divisor.span, "this is zero here"),
        }
    }
}
