//! Complex functions over balls: the maps that a `julia_fractal` of hypercomplex numbers iterates.
//!
//! **In:** a ball of complex numbers. **Out:** a ball that contains the function's values, and one that
//! contains its derivatives. **Invariant:** an analytic function maps two numbers at most as far apart as the
//! maximum slope between them allows; where a ball touches a branch cut or a pole, the result is unbounded.
//!
//! **Source:** NIST Digital Library of Mathematical Functions, chapter 4 (the principal values).

use super::ball::Ball;
use crate::math::elementary::{atan2, cos, cosh, exp, log, sin, sinh};
use crate::shape::U;

type Complex = Ball<2>;

/// The iterated function.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Function {
    Sqr,
    Cube,
    Exp,
    Reciprocal,
    Sin,
    Asin,
    Sinh,
    Asinh,
    Cos,
    Acos,
    Cosh,
    Acosh,
    Tan,
    Atan,
    Tanh,
    Atanh,
    Ln,
    /// A complex power.
    Pwr([f64; 2]),
}

const ONE: Complex = Ball { middle: [1.0, 0.0], radius: 0.0 };
const I: Complex = Ball { middle: [0.0, 1.0], radius: 0.0 };
const MINUS_I: Complex = Ball { middle: [0.0, -1.0], radius: 0.0 };

impl Function {
    /// Returns the value and the derivative.
    pub fn of(self, z: Complex) -> (Complex, Complex) {
        let two = |z: Complex| z.times_number(2.0);
        match self {
            Self::Sqr => (z * z, two(z)),
            Self::Cube => {
                let square = z * z;
                (square * z, square.times_number(3.0))
            }
            Self::Exp => {
                let power = power(z);
                (power, power)
            }
            Self::Reciprocal => {
                let over = over(z);
                (over, minus(over * over))
            }
            Self::Sin => (sine(z), cosine(z)),
            Self::Cos => (cosine(z), minus(sine(z))),
            Self::Sinh => (hyperbolic_sine(z), hyperbolic_cosine(z)),
            Self::Cosh => (hyperbolic_cosine(z), hyperbolic_sine(z)),
            Self::Tan => {
                let tan = sine(z) * over(cosine(z));
                (tan, ONE + tan * tan)
            }
            Self::Tanh => {
                let tanh = hyperbolic_sine(z) * over(hyperbolic_cosine(z));
                (tanh, ONE + minus(tanh * tanh))
            }
            Self::Ln => (logarithm(z), over(z)),
            Self::Asin => {
                let root = root(ONE + minus(z * z));
                (MINUS_I * logarithm(I * z + root), over(root))
            }
            Self::Acos => {
                let (asin, slope) = Self::Asin.of(z);
                let quarter = Ball::new([std::f64::consts::FRAC_PI_2, 0.0], U);
                (quarter + minus(asin), minus(slope))
            }
            Self::Asinh => {
                let root = root(ONE + z * z);
                (logarithm(z + root), over(root))
            }
            Self::Acosh => {
                let roots = root(z + ONE) * root(z + minus(ONE));
                (logarithm(z + roots), over(roots))
            }
            Self::Atan => {
                let turned = I * z;
                let value = logarithm(ONE + turned) + minus(logarithm(ONE + minus(turned)));
                (MINUS_I.times_number(0.5) * value, over(ONE + z * z))
            }
            Self::Atanh => {
                let value = logarithm(ONE + z) + minus(logarithm(ONE + minus(z)));
                (value.times_number(0.5), over(ONE + minus(z * z)))
            }
            Self::Pwr(by) => {
                let by = Ball::point(by);
                let value = power(by * logarithm(z));
                (value, by * value * over(z))
            }
        }
    }
}

fn minus(z: Complex) -> Complex {
    Ball { middle: z.middle.map(|component| -component), ..z }
}

/// Returns a ball around a value, for a function whose slope in the ball is at most `steepest`; each
/// component of the value was rounded a few times, starting from numbers of the given size.
fn image(middle: [f64; 2], z: &Complex, steepest: f64, size: f64) -> Complex {
    if !(steepest.is_finite() && size.is_finite()) {
        return Ball::EVERYTHING;
    }
    let moved = if z.radius == 0.0 { 0.0 } else { z.radius * steepest };
    Ball { middle, radius: (moved + 16.0 * U * size) * (1.0 + 16.0 * U) }
}

/// e to that power.
fn power(z: Complex) -> Complex {
    let [a, b] = z.middle;
    let size = exp(a);
    image([size * cos(b), size * sin(b)], &z, exp(a + z.radius), size)
}

fn sine(z: Complex) -> Complex {
    let [a, b] = z.middle;
    image([sin(a) * cosh(b), cos(a) * sinh(b)], &z, cosh(b.abs() + z.radius), cosh(b))
}

fn cosine(z: Complex) -> Complex {
    let [a, b] = z.middle;
    image([cos(a) * cosh(b), -sin(a) * sinh(b)], &z, cosh(b.abs() + z.radius), cosh(b))
}

fn hyperbolic_sine(z: Complex) -> Complex {
    let [a, b] = z.middle;
    image([sinh(a) * cos(b), cosh(a) * sin(b)], &z, cosh(a.abs() + z.radius), cosh(a))
}

fn hyperbolic_cosine(z: Complex) -> Complex {
    let [a, b] = z.middle;
    image([cosh(a) * cos(b), sinh(a) * sin(b)], &z, cosh(a.abs() + z.radius), cosh(a))
}

/// 1 / z.
fn over(z: Complex) -> Complex {
    let [a, b] = z.middle;
    let size = z.size();
    let nearest = size * (1.0 - 16.0 * U) - z.radius;
    if nearest.is_nan() || nearest <= 0.0 {
        return Ball::EVERYTHING;
    }
    // In two steps: the square of a size may be no number where the size is one.
    let unit = [a / size, -b / size];
    image(unit.map(|component| component / size), &z, 1.0 / nearest / nearest, 1.0 / nearest)
}

/// Returns its minimum distance from 0, if it is off the branch cut along the negative numbers.
fn beside_the_cut(z: &Complex) -> Option<f64> {
    let [a, b] = z.middle;
    let nearest = z.size() * (1.0 - 16.0 * U) - z.radius;
    (nearest > 0.0 && (a > z.radius || b.abs() > z.radius)).then_some(nearest)
}

fn logarithm(z: Complex) -> Complex {
    let Some(nearest) = beside_the_cut(&z) else { return Ball::EVERYTHING };
    let [a, b] = z.middle;
    let middle = [log(z.size()), atan2(b, a)];
    image(middle, &z, 1.0 / nearest, 4.0 + middle[0].abs())
}

/// The square root with a positive real part.
fn root(z: Complex) -> Complex {
    let Some(nearest) = beside_the_cut(&z) else { return Ball::EVERYTHING };
    let [a, b] = z.middle;
    let size = z.size();
    // Of the two, the part that nothing cancels in.
    let large = (0.5 * (size + a.abs())).sqrt();
    let small = 0.5 * b.abs() / large;
    let middle = match a >= 0.0 {
        true => [large, small.copysign(b)],
        false => [small, large.copysign(b)],
    };
    image(middle, &z, 0.5 / nearest.sqrt(), size.sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::elementary as real;
    use crate::math::random::{Random, tries_in};

    const ALL: [Function; 18] = [
        Function::Sqr,
        Function::Cube,
        Function::Exp,
        Function::Reciprocal,
        Function::Sin,
        Function::Asin,
        Function::Sinh,
        Function::Asinh,
        Function::Cos,
        Function::Acos,
        Function::Cosh,
        Function::Acosh,
        Function::Tan,
        Function::Atan,
        Function::Tanh,
        Function::Atanh,
        Function::Ln,
        Function::Pwr([2.5, -0.5]),
    ];

    fn off(a: [f64; 2], b: [f64; 2]) -> f64 {
        Ball::point([a[0] - b[0], a[1] - b[1]]).size()
    }

    #[test]
    fn of_real_numbers_they_are_the_real_functions() {
        let near = |function: Function, x: f64, expected: f64| {
            let value = function.of(Ball::point([x, 0.0])).0;
            assert!(off(value.middle, [expected, 0.0]) <= 1e-14, "{function:?} {value:?}");
            assert!(off(value.middle, [expected, 0.0]) <= value.radius, "{function:?} {value:?}");
        };
        near(Function::Sqr, 0.4, 0.4 * 0.4);
        near(Function::Cube, 0.4, 0.4 * 0.4 * 0.4);
        near(Function::Exp, 0.4, real::exp(0.4));
        near(Function::Reciprocal, 0.4, 2.5);
        near(Function::Sin, 0.4, real::sin(0.4));
        near(Function::Asin, 0.4, real::asin(0.4));
        near(Function::Sinh, 0.4, real::sinh(0.4));
        near(Function::Asinh, 0.4, real::asinh(0.4));
        near(Function::Cos, 0.4, real::cos(0.4));
        near(Function::Acos, 0.4, real::acos(0.4));
        near(Function::Cosh, 0.4, real::cosh(0.4));
        near(Function::Acosh, 1.4, real::acosh(1.4));
        near(Function::Tan, 0.4, real::tan(0.4));
        near(Function::Atan, 0.4, real::atan(0.4));
        near(Function::Tanh, 0.4, real::tanh(0.4));
        near(Function::Atanh, 0.4, real::atanh(0.4));
        near(Function::Ln, 0.4, real::log(0.4));
        near(Function::Pwr([2.5, 0.0]), 0.4, real::pow(0.4, 2.5));
    }

    #[test]
    fn a_ball_holds_the_values_of_all_its_numbers_and_its_slope_holds_theirs() {
        let mut random = Random(9);
        for _ in 0..tries_in(ALL.len()) {
            for function in ALL {
                let middle = [(); 2].map(|()| random.number(-2.0, 2.0));
                let z = Ball::new(middle, random.size(-6.0, -1.0));
                let turn = random.number(0.0, 7.0);
                let out = random.number(0.0, 0.999);
                let other = [
                    middle[0] + z.radius * out * real::cos(turn),
                    middle[1] + z.radius * out * real::sin(turn),
                ];
                let (value, slope) = function.of(z);
                let (there, slope_there) = function.of(Ball::point(other));
                if !value.radius.is_finite() {
                    continue;
                }
                assert!(off(value.middle, there.middle) <= value.radius, "{function:?} {z:?}");
                if slope.radius.is_finite() {
                    let far = off(slope.middle, slope_there.middle);
                    assert!(far <= slope.radius, "{function:?} {z:?}");
                    // And it is the slope.
                    let step = 1e-6;
                    let (next, _) = function.of(Ball::point([other[0] + step, other[1]]));
                    let rise = [0, 1].map(|i| (next.middle[i] - there.middle[i]) / step);
                    let size = 1.0 + Ball::point(slope_there.middle).size();
                    let curve = off(rise, slope_there.middle);
                    assert!(curve <= 1e-2 * size * size, "{function:?} {other:?} {rise:?}");
                }
            }
        }
    }

    #[test]
    fn of_a_ball_on_a_cut_or_a_pole_nothing_is_known() {
        for (function, middle) in [
            (Function::Ln, [-1.0, 0.0]),
            (Function::Reciprocal, [0.0, 0.0]),
            (Function::Asin, [2.0, 0.0]),
            (Function::Tan, [std::f64::consts::FRAC_PI_2, 0.0]),
            (Function::Pwr([0.5, 0.0]), [-1.0, 0.0]),
        ] {
            let (value, _) = function.of(Ball::new(middle, 1e-6));
            assert!(!value.radius.is_finite(), "{function:?} {value:?}");
        }
    }
}
