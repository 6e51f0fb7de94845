//! Numeric functions: rounding, powers, angles, selection.
//!
//! **Invariant:** outside a function's domain there is an error, never a `nan`. The domain includes a margin
//! for rounding: `acos(vdot(A, B))` of two unit vectors must not fail because of the last digit, so values up
//! to [`BORDER`] beyond ±1 count as ±1.

use std::ops::RangeInclusive;

use super::{Arguments, CallError, CallErrorKind, Function, Written};
use crate::math::elementary::{
    RADIANS_PER_DEGREE, acos, acosh, asin, asinh, atan, atan2, atanh, ceil, cos, cosh, exp, floor,
    fmod, log, log10, pow, sin, sinh, tan, tanh,
};
use crate::vocabulary::Word;

/// 16 units in the last place of 1: more than the error of a dot product of two normalized vectors.
const BORDER: f64 = 16.0 * f64::EPSILON;

/// One or more.
const ANY: RangeInclusive<usize> = 1..=usize::MAX;

/// Returns the function that `word` names, if it is in this family.
pub(super) fn function(word: Word) -> Option<Function> {
    match word {
        Word::Abs => Function::plain(f64::abs),
        Word::Acos => Function::number(1..=1, |a| Ok(acos(sine_or_cosine(a)?))),
        Word::Acosh => Function::number(1..=1, |a| match a.number(0)? {
            n if n >= 1.0 => Ok(acosh(n)),
            n if n >= 1.0 - BORDER => Ok(0.0),
            _ => Err(a.out_of_range(0, "a number of at least 1")),
        }),
        Word::Asin => Function::number(1..=1, |a| Ok(asin(sine_or_cosine(a)?))),
        Word::Asinh => Function::plain(asinh),
        Word::Atan => Function::plain(atan),
        Word::Atan2 => Function::number(2..=2, |a| match (a.number(0)?, a.number(1)?) {
            (0.0, 0.0) => {
                let message = "of 0 and 0 is no angle: the point has no direction".to_owned();
                Err(a.error(CallErrorKind::OutOfRange, None, message))
            }
            (y, x) => Ok(atan2(y, x)),
        }),
        Word::Atanh => Function::number(1..=1, |a| match a.number(0)? {
            n if n.abs() < 1.0 => Ok(atanh(n)),
            _ => Err(a.out_of_range(0, "a number between -1 and 1, ends left out")),
        }),
        Word::BitwiseAnd => Function::number(ANY, |a| bitwise(a, |x, y| x & y)),
        Word::BitwiseOr => Function::number(ANY, |a| bitwise(a, |x, y| x | y)),
        Word::BitwiseXor => Function::number(ANY, |a| bitwise(a, |x, y| x ^ y)),
        Word::Ceil => Function::plain(ceil),
        Word::Cos => Function::plain(cos),
        Word::Cosh => Function::plain(cosh),
        Word::Degrees => Function::plain(|n| n / std::f64::consts::PI * 180.0),
        Word::Div => Function::number(2..=2, |a| Ok(whole_part(a.number(0)? / divisor(a)?))),
        Word::Exp => Function::plain(exp),
        Word::Floor => Function::plain(floor),
        Word::Int => Function::plain(whole_part),
        Word::Ln => Function::number(1..=1, |a| Ok(log(above_zero(a)?))),
        Word::Log => Function::number(1..=1, |a| Ok(log10(above_zero(a)?))),
        Word::Max => Function::number(ANY, |a| chosen(a, |next, most| next > most)),
        Word::Min => Function::number(ANY, |a| chosen(a, |next, least| next < least)),
        Word::Mod => Function::number(2..=2, |a| Ok(fmod(a.number(0)?, divisor(a)?))),
        Word::Pow => Function::number(2..=2, power),
        Word::Radians => Function::plain(|n| n * RADIANS_PER_DEGREE),
        Word::Select => Function::number(3..=4, select),
        Word::Sin => Function::plain(sin),
        Word::Sinh => Function::plain(sinh),
        Word::Sqrt => Function::number(1..=1, |a| match a.number(0)? {
            n if n >= 0.0 => Ok(n.sqrt()),
            _ => Err(a.out_of_range(0, "a number of at least 0")),
        }),
        Word::Tan => Function::plain(tan),
        Word::Tanh => Function::plain(tanh),
        _ => None,
    }
}

/// Returns the first number, or a later one that is better; NaN never is, as in POV-Ray 3.7 (measured).
fn chosen(a: &Arguments, is_better: fn(f64, f64) -> bool) -> Result<f64, CallError> {
    let best = |best, next| if is_better(next, best) { next } else { best };
    Ok(a.all_numbers()?.reduce(best).unwrap_or(f64::NAN))
}

/// Truncates toward zero. POV-Ray uses 32 bits and gives -2147483648 for larger numbers; here the integer
/// part has no such limit.
fn whole_part(n: f64) -> f64 {
    n.trunc() + 0.0 // the sum turns -0 into 0
}

/// Checks the argument of an inverse sine or cosine. POV-Ray clamps anything beyond ±1, with a warning.
fn sine_or_cosine(a: &Arguments) -> Result<f64, CallError> {
    let n = a.number(0)?;
    if n.abs() <= 1.0 + BORDER {
        return Ok(n.clamp(-1.0, 1.0));
    }
    let error = a.out_of_range(0, "a number from -1 to 1");
    Err(error.with_help("`min(1, max(-1, a))` keeps a number in these bounds"))
}

fn above_zero(a: &Arguments) -> Result<f64, CallError> {
    match a.number(0)? {
        n if n > 0.0 => Ok(n),
        _ => Err(a.out_of_range(0, "a number above 0")),
    }
}

fn divisor(a: &Arguments) -> Result<f64, CallError> {
    match a.number(1)? {
        0.0 => {
            let message = "divides by its second argument, which is 0".to_owned();
            Err(a.error(CallErrorKind::DivisionByZero, Some(1), message))
        }
        n => Ok(n),
    }
}

/// Combines the bits of integers; negative ones are sign-extended.
///
/// POV-Ray uses 32 bits; this uses up to 53, which a number holds exactly, with the same result wherever 32
/// are enough.
fn bitwise(a: &Arguments, combine: fn(i64, i64) -> i64) -> Result<f64, CallError> {
    const LARGEST: i64 = (1 << 53) - 1;
    let whole = |i| a.whole(i, -LARGEST..=LARGEST, "whole numbers");
    let mut result = whole(0)?;
    for i in 1..a.values.len() {
        result = combine(result, whole(i)?);
    }
    Ok(result as f64)
}

/// Raises to a power. As in POV-Ray, 0 to the power of 0 has no value.
fn power(a: &Arguments) -> Result<f64, CallError> {
    let (base, exponent) = (a.number(0)?, a.number(1)?);
    if base == 0.0 && exponent <= 0.0 {
        let (kind, reason) = if exponent == 0.0 {
            (CallErrorKind::OutOfRange, "has no value")
        } else {
            (CallErrorKind::DivisionByZero, "divides by 0")
        };
        let message = format!("of 0 with the exponent {} {reason}", Written(exponent));
        return Err(a.error(kind, Some(1), message));
    }
    if base < 0.0 && exponent.fract() != 0.0 {
        let message = format!(
            "of a negative number takes a whole exponent, and {} is not whole",
            Written(exponent)
        );
        let error = a.error(CallErrorKind::OutOfRange, Some(1), message);
        return Err(error.with_help("for an odd root of a negative number write `-pow(-a, b)`"));
    }
    Ok(pow(base, exponent))
}

/// Selects an argument by the sign of the first. The comparison with zero is exact, as in POV-Ray.
fn select(a: &Arguments) -> Result<f64, CallError> {
    let (n, negative, zero) = (a.number(0)?, a.number(1)?, a.number(2)?);
    let positive = if a.values.len() > 3 { a.number(3)? } else { zero };
    Ok(match n {
        n if n < 0.0 => negative,
        0.0 => zero,
        _ => positive,
    })
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::{CallErrorKind, RandomStreams, call, measured};
    use crate::diagnostic::Code;
    use crate::evaluate::value::Value;
    use crate::vocabulary::Word;

    fn number(word: Word, arguments: &[f64]) -> Result<f64, super::CallError> {
        let arguments: Vec<Value> = arguments.iter().map(|n| Value::Number(*n)).collect();
        let value = call(word, &arguments, &mut RandomStreams::default(), usize::MAX)?;
        Ok(value.as_number().expect("a number"))
    }

    #[test]
    fn numbers_are_those_that_pov_ray_prints() {
        measured::check(measured::FLOAT);
    }

    #[test]
    fn outside_its_domain_a_function_says_what_it_takes() {
        let cases: [(Word, &[f64], Code, &str); 16] = [
            (Word::Sqrt, &[-1.0], Code::OutOfRange, "takes a number of at least 0, not -1"),
            (
                Word::Acos,
                &[1.0 + 1e-10],
                Code::OutOfRange,
                "takes a number from -1 to 1, not 1.0000000001",
            ),
            (Word::Asin, &[-2.0], Code::OutOfRange, "takes a number from -1 to 1, not -2"),
            (Word::Acosh, &[0.5], Code::OutOfRange, "takes a number of at least 1, not 0.5"),
            (
                Word::Atanh,
                &[1.0],
                Code::OutOfRange,
                "takes a number between -1 and 1, ends left out, not 1",
            ),
            (Word::Ln, &[0.0], Code::OutOfRange, "takes a number above 0, not 0"),
            (Word::Log, &[-1e-30], Code::OutOfRange, "takes a number above 0, not -1e-30"),
            (
                Word::Atan2,
                &[0.0, 0.0],
                Code::OutOfRange,
                "of 0 and 0 is no angle: the point has no direction",
            ),
            (
                Word::Pow,
                &[-8.0, 1.5],
                Code::OutOfRange,
                "of a negative number takes a whole exponent, and 1.5 is not whole",
            ),
            (Word::Pow, &[0.0, 0.0], Code::OutOfRange, "of 0 with the exponent 0 has no value"),
            (
                Word::Pow,
                &[0.0, -1.0],
                Code::DivisionByZero,
                "of 0 with the exponent -1 divides by 0",
            ),
            (
                Word::Pow,
                &[10.0, 400.0],
                Code::NotANumber,
                "has a result too large for a number (beyond about 1.8e308)",
            ),
            (
                Word::Mod,
                &[1.0, 0.0],
                Code::DivisionByZero,
                "divides by its second argument, which is 0",
            ),
            (
                Word::Div,
                &[1.0, 0.0],
                Code::DivisionByZero,
                "divides by its second argument, which is 0",
            ),
            (
                Word::Div,
                &[1e300, 1e-300],
                Code::NotANumber,
                "has a result too large for a number (beyond about 1.8e308)",
            ),
            (
                Word::BitwiseOr,
                &[1.0, 1e16],
                Code::OutOfRange,
                "takes whole numbers from -9007199254740991 to 9007199254740991, not 1e16",
            ),
        ];
        for (word, arguments, code, rest) in cases {
            let error = number(word, arguments).expect_err(rest);
            assert_eq!(error.message, format!("`{}` {rest}", word.name()));
            assert_eq!(error.kind.code(), code, "{rest}");
        }
    }

    #[test]
    fn the_border_of_a_domain_forgives_the_last_digits() {
        assert_eq!(number(Word::Acos, &[1.0 + f64::EPSILON]), Ok(0.0));
        assert_eq!(number(Word::Asin, &[-1.0 - f64::EPSILON]), number(Word::Asin, &[-1.0]));
        assert_eq!(number(Word::Acosh, &[1.0 - f64::EPSILON]), Ok(0.0));
        let error = number(Word::Atanh, &[1.0]).expect_err("infinite");
        assert_eq!(error.kind, CallErrorKind::OutOfRange);
    }

    #[test]
    fn whole_parts_have_no_size_limit_and_no_negative_zero() {
        assert_eq!(number(Word::Int, &[-5e9 - 0.5]), Ok(-5e9));
        assert!(number(Word::Int, &[-0.5]).expect("a number").is_sign_positive());
        assert_eq!(number(Word::BitwiseXor, &[2f64.powi(40), 1.0]), Ok(2f64.powi(40) + 1.0));
    }

    proptest! {
        #[test]
        fn what_division_drops_modulo_keeps(a in -1e6..1e6f64, b in 0.1..1e3f64) {
            let quotient = number(Word::Div, &[a, b]).expect("b is not 0");
            let rest = number(Word::Mod, &[a, b]).expect("b is not 0");
            prop_assert!(rest.abs() < b && rest * a >= 0.0);
            // Either may round across a multiple of b.
            let left = a - quotient * b - rest;
            let turns = (left / b).round();
            prop_assert!(turns.abs() <= 1.0 && (left - turns * b).abs() <= 1e-9);
        }

        #[test]
        fn inverse_functions_undo(a in -0.999..0.999f64) {
            let pairs = [
                (Word::Sin, Word::Asin),
                (Word::Tan, Word::Atan),
                (Word::Sinh, Word::Asinh),
                (Word::Tanh, Word::Atanh),
                (Word::Exp, Word::Ln),
                (Word::Degrees, Word::Radians),
            ];
            for (word, inverse) in pairs {
                let there = number(word, &[a]).expect("in the domain");
                let back = number(inverse, &[there]).expect("in the domain");
                prop_assert!((back - a).abs() <= 4e-15, "{word:?} {a} {back}");
            }
        }

        #[test]
        fn no_call_gives_a_number_that_is_not_finite(numbers in proptest::collection::vec(any_finite(), 4)) {
            let arguments: Vec<Value> = numbers.iter().map(|n| Value::Number(*n)).collect();
            for &word in Word::ALL {
                let Some(arity) = super::super::arity(word) else { continue };
                let count = (*arity.end()).min(arguments.len());
                let result = call(word, &arguments[..count], &mut RandomStreams::default(), usize::MAX);
                if let Some(numbers) = result.ok().and_then(|value| value.numbers()) {
                    prop_assert!(numbers.as_slice().iter().all(|n| n.is_finite()), "{word:?}");
                }
            }
        }
    }

    fn any_finite() -> impl Strategy<Value = f64> {
        use proptest::num::f64::{NEGATIVE, NORMAL, POSITIVE, SUBNORMAL, ZERO};
        prop_oneof![-2.0..2.0f64, NORMAL | SUBNORMAL | ZERO | POSITIVE | NEGATIVE]
    }
}
