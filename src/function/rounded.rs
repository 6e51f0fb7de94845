//! Rounding of functions over a box: how far a number computed for a point may be from the exact one.
//!
//! **Invariant:** for any point of the box, and arguments within their errors of it, the exact value and that
//! computed with `f64` lie in `value`, and within `error` of each other.
//!
//! Errors of operands are carried on as slopes are: both the exact and the computed operand lie in the operand's
//! interval, so the results differ by no more than the steepest slope in it times their difference.

use super::number::{Number, Turn};
use super::operation::{Binary, Unary};
use super::slope::Sloped;
use super::{Outside, OutsideId};
use crate::math::interval::Interval;

/// The range of a value, and the error of a number computed for it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rounded {
    pub value: Interval,
    /// Infinite if it is not known.
    pub error: f64,
}

/// Unit roundoff of `f64`.
const U: f64 = f64::EPSILON / 2.0;

impl Rounded {
    /// Returns a value of unknown error.
    pub fn anyhow(value: Interval) -> Self {
        Self { value, error: f64::INFINITY }
    }

    /// Returns the value with its error as a slope.
    pub fn sloped(&self) -> Sloped<1> {
        Sloped { value: self.value, slopes: [Interval { low: -self.error, high: self.error }] }
    }

    /// Returns the value whose error is that of a slope, and some further roundings.
    pub fn new(Sloped { value, slopes: [slope] }: Sloped<1>, roundings: f64) -> Self {
        let size = value.low.abs().max(value.high.abs());
        let own = if roundings == 0.0 { 0.0 } else { roundings * U * size + f64::MIN_POSITIVE };
        let error = (slope.high.max(-slope.low) + own) * (1.0 + 4.0 * U);
        Self { value, error: if error.is_nan() { f64::INFINITY } else { error } }
    }
}

impl Number for Rounded {
    fn constant(value: f64) -> Self {
        Self {
            value: Interval::point(value),
            error: if value.is_nan() { f64::INFINITY } else { 0.0 },
        }
    }

    fn unary(operation: Unary, a: Self) -> Self {
        let roundings = match operation {
            Unary::Negate | Unary::Not | Unary::Abs | Unary::Floor | Unary::Ceil | Unary::Int => {
                0.0
            }
            Unary::Square | Unary::Sqrt => 1.0,
            // Less than one unit in the last place.
            _ => 2.0,
        };
        Self::new(Sloped::unary(operation, a.sloped()), roundings)
    }

    fn binary(operation: Binary, a: Self, b: Self) -> Self {
        let roundings = match operation {
            Binary::Add | Binary::Subtract | Binary::Multiply | Binary::Divide => 1.0,
            Binary::Pow | Binary::Atan2 => 2.0,
            _ => 0.0,
        };
        Self::new(Sloped::binary(operation, a.sloped(), b.sloped()), roundings)
    }

    fn choose(condition: Self, then: Self, otherwise: Self) -> Self {
        match condition.value.single() {
            Some(0.0) => otherwise,
            _ if !condition.value.contains(0.0) => then,
            _ => Self::anyhow(then.value.hull(otherwise.value)),
        }
    }

    fn ask(outside: &impl Outside, id: OutsideId, arguments: &[Self]) -> Self {
        outside.rounded(id, arguments)
    }

    fn turn(counter: Self, last: Self) -> Turn<Self> {
        match Interval::turn(counter.value, last.value) {
            Turn::Again(value) => Turn::Again(Self { value, error: 0.0 }),
            Turn::Done => Turn::Done,
            Turn::Unknown => Turn::Unknown,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::function::{Builder, Function, Node, Nothing, TooLong};
    use crate::math::double::Double;
    use crate::math::random::{Random, tries};

    /// ((x·y + z)·(x − z) − y)/x
    fn function() -> Function {
        let make = |b: &mut Builder| -> Result<Node, TooLong> {
            let [x, y, z] = [0, 1, 2].map(|axis| b.parameter(axis).expect("three"));
            let (product, difference) =
                (b.binary(Binary::Multiply, x, y)?, b.binary(Binary::Subtract, x, z)?);
            let sum = b.binary(Binary::Add, product, z)?;
            let product = b.binary(Binary::Multiply, sum, difference)?;
            let rest = b.binary(Binary::Subtract, product, y)?;
            b.binary(Binary::Divide, rest, x)
        };
        let mut builder = Builder::new(3).expect("three");
        let result = make(&mut builder).expect("short");
        builder.finish(result)
    }

    #[test]
    fn a_number_computed_for_a_point_that_is_off_is_within_the_error_of_the_exact_one() {
        let (mut random, function) = (Random(41), function());
        let mut greatest = 0.0_f64;
        for _ in 0..tries() {
            let (width, error) = (random.size(-6.0, 0.0), [0.0, 1e-12, 1e-7][random.below(3)]);
            let corner = [1.5, -1.0, -1.0].map(|low| random.number(low, low + 2.0));
            let side = |low: f64| Interval { low: low - error, high: low + width + error };
            let sides = corner.map(|low| Rounded { value: side(low), error });
            let all = function.run().at(&sides, &Nothing);
            let point = corner.map(|low| random.number(low, low + width));
            let moved = point.map(|at| at + 0.999 * random.number(-error, error));
            let computed: f64 = function.run().at(&moved, &Nothing);
            let [x, y, z] = point.map(Double::from);
            let exact = ((x * y + z) * (x - z) - y) / x;
            let off = (exact - Double::from(computed)).round().abs();
            assert!(off <= all.error, "{off:e} {all:?} {point:?}");
            greatest = greatest.max(off / all.error);
        }
        assert!(greatest > 0.1, "{greatest}");
    }
}
