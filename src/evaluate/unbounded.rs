//! Results that are no finite numbers: an error in a `.scene`; in a `.pov` a warning, and calculations go on with
//! them as in POV-Ray 3.7.

use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::syntax::ast::{BinaryOperator, ExpressionId, ExpressionKind};
use crate::vocabulary::{Dialect, Word};

use super::builtin::{self, CallError, CallErrorKind};
use super::value::{self, OperationError, Value};
use super::{Evaluator, Here, Outcome};

/// The numbers of 32 bits, in which POV-Ray 3.7 keeps whole parts.
const WHOLE: std::ops::RangeInclusive<f64> = i32::MIN as f64..=i32::MAX as f64;

impl Evaluator<'_> {
    /// What an operation on `values` comes to that has no finite result. Only where they are finite themselves
    /// is there something to tell.
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

    /// Whether POV-Ray's answer to a call is another than the result here: a whole part that needs more than 32
    /// bits.
    pub(super) fn is_cut_off(&self, word: Word, result: f64) -> bool {
        matches!(word, Word::Int | Word::Div)
            && self.options.dialect == Dialect::Pov
            && !WHOLE.contains(&result)
    }

    /// What POV-Ray gives for a call that has no result here, or another one; `None` where it refuses it, too.
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

    /// The value of a function that is no finite number.
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

    /// Why an operation has no finite result.
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
