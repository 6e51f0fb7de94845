//! POV-Ray 3.7's results for calls that have no value here, or a different one.
//!
//! **Source:** measured, call by call. POV-Ray refuses roots of negative numbers, logarithms of numbers that
//! are not positive, `pow(0, 0)`, `atan2(0, 0)`, and streams that are not open. All other results are those
//! of IEEE 754, or the ones listed here.

use super::string::LONGEST;
use super::{Arguments, Body, CallError, CallErrorKind, RandomStreams, Value, call, function};
use crate::math::Vector;
use crate::math::elementary::{acos, acosh, asin, atanh, fmod, pow};
use crate::vocabulary::Word;

/// Returns POV-Ray's result; `None` if it refuses the call too.
pub fn rendered(word: Word, values: &[Value]) -> Option<Value> {
    let number = |i: usize| values.get(i).and_then(Value::as_number);
    let result = match word {
        Word::Acos => acos(number(0)?.clamp(-1.0, 1.0)),
        Word::Asin => asin(number(0)?.clamp(-1.0, 1.0)),
        Word::Acosh => acosh(number(0)?),
        Word::Atanh => atanh(number(0)?),
        Word::Sqrt | Word::Ln | Word::Log => {
            number(0).filter(|number| number.is_nan() || *number == f64::INFINITY)?
        }
        Word::Pow => match (number(0)?, number(1)?) {
            (0.0, 0.0) => return None,
            (base, exponent) => pow(base, exponent),
        },
        Word::Mod => fmod(number(0)?, number(1)?),
        Word::Int => in_32_bits(number(0)?),
        Word::Div => in_32_bits(number(0)? / number(1)?),
        Word::BitwiseAnd | Word::BitwiseOr | Word::BitwiseXor => {
            let whole = values.iter().map(|value| value.as_number().map(in_32_bits));
            whole.reduce(|a, b| super::number(word, [a?, b?]))??
        }
        Word::Vnormalize => {
            let vector = values.first()?.as_vector3()?;
            let length = vector.length();
            return Some(Value::vector3(match length == 0.0 {
                true => Vector::ZERO,
                false => vector / length,
            }));
        }
        Word::VaxisRotate => return Some(Value::vector3(Vector::NAN)),
        Word::Substr => return (number(1)?.trunc() == 0.0).then(|| Value::string("")),
        // Half a surrogate pair.
        Word::Chr => {
            let is_half = (55_296.0..57_344.0).contains(&number(0)?);
            return is_half.then(|| Value::string("\u{fffd}"));
        }
        Word::Str => {
            let longest = LONGEST as f64;
            let bounded = |i| number(i).map(|n| Value::Number(n.clamp(-longest, longest)));
            let values = [values.first()?.clone(), bounded(1)?, bounded(2)?];
            return call(word, &values, &mut RandomStreams::default(), usize::MAX).ok();
        }
        _ => return unchecked(word, values),
    };
    Some(Value::Number(result))
}

/// Returns the value of a call, finite or not.
fn unchecked(word: Word, values: &[Value]) -> Option<Value> {
    let arguments = Arguments { word, values, longest: usize::MAX };
    match function(word)?.body {
        Body::Plain(f) => Some(Value::Number(f(arguments.number(0).ok()?))),
        Body::Number(f) => Some(Value::Number(f(&arguments).ok()?)),
        Body::Vector(f) => Some(Value::vector3(f(&arguments).ok()?)),
        Body::String(_) | Body::Random(_) => None,
    }
}

/// Returns the integer part; if it does not fit into 32 bits or is NaN, the least 32-bit integer.
fn in_32_bits(number: f64) -> f64 {
    let whole = number.trunc() + 0.0; // the sum turns -0 into 0
    let fits = (f64::from(i32::MIN)..=f64::from(i32::MAX)).contains(&whole);
    if fits { whole } else { f64::from(i32::MIN) }
}

/// Explains why POV-Ray returns -2147483648.
pub fn beyond_32_bits(word: Word) -> CallError {
    CallError {
        kind: CallErrorKind::OutOfRange,
        argument: None,
        message: format!("`{}` gives a whole number of 32 bits, and this is larger", word.name()),
        help: Some("as in POV-Ray, it is -2147483648; `floor` has no such limit".to_owned()),
    }
}
