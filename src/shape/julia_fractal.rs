//! Julia fractal: the points of a slice of four dimensions whose iterates h ← f(h) + p all stay within a
//! ball.
//!
//! It is the isosurface of the greatest of their |h|², less the ball's radius squared: so bounds find it, as
//! those of any other function. Of quaternions the ball's radius is 1 + |p|, beyond which a square or cube only
//! grows; of hypercomplex numbers 4.
//!
//! What is thinner along a line than the surface's `finest` may be lost: a fractal has no end of that.
//!
//! **Source:** manual, section 3.4.5.1.7; the radii and the number of iterates (h₀ … hₙ₋₁) were measured on
//! POV-Ray 3.7, whose manual has 4 for both. A hypercomplex number is two complex ones (x − w, y + z) and
//! (x + w, y − z), which never meet: J. Hart, D. Sandin, L. Kauffman, "Ray tracing deterministic 3-D fractals",
//! SIGGRAPH 1989, for the fractals.

use super::body::{Crossings, Height, Local, LocalRay};
use super::isosurface::Isosurface;
use crate::function::{Binary, Number};
use crate::math::Vector;

mod complex;

use complex::{Complex, add, scaled, square, subtract, times};

/// What is iterated of hypercomplex numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum HypercomplexFunction {
    Square,
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
    /// To this complex power.
    Power(f64, f64),
}

/// The algebra, and the function iterated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Iteration {
    QuaternionSquare,
    QuaternionCube,
    Hypercomplex(HypercomplexFunction),
}

#[derive(Debug, Clone, PartialEq)]
pub struct Julia {
    pub parameter: [f64; 4],
    pub iteration: Iteration,
    /// How many iterates must stay: at least 1.
    pub count: u32,
    /// The fourth coordinate is `slice · (x, y, z) + offset`.
    pub slice: Vector,
    pub offset: f64,
}

impl Julia {
    /// The radius that no iterate may leave.
    pub fn radius(&self) -> f64 {
        match self.iteration {
            Iteration::QuaternionSquare | Iteration::QuaternionCube => {
                1.0 + self.parameter.iter().map(|p| p * p).sum::<f64>().sqrt()
            }
            Iteration::Hypercomplex(_) => 4.0,
        }
    }

    /// The greatest |h|² less the square of the radius; of what certainly escapes, that of the iterate that does.
    /// `low` is the least that a number stands for.
    pub(super) fn at<N: Number>(&self, [x, y, z]: [N; 3], low: impl Fn(N) -> f64) -> N {
        let most = self.radius() * self.radius();
        let across = |axis: usize, a: N| scaled(a, self.slice[axis]);
        let w = add(add(across(0, x), across(1, y)), add(across(2, z), N::constant(self.offset)));
        let less = |norm: N| subtract(norm, N::constant(most));
        let mut point = match self.iteration {
            Iteration::QuaternionSquare | Iteration::QuaternionCube => [x, y, z, w],
            Iteration::Hypercomplex(_) => [subtract(x, w), add(y, z), add(x, w), subtract(y, z)],
        };
        let mut greatest = less(self.norm(point));
        for _ in 1..self.count {
            let least = low(greatest);
            // Certainly outside, or not known of.
            if least > 0.0 || !least.is_finite() {
                break;
            }
            point = self.next(point);
            let value = less(self.norm(point));
            if low(value) > 0.0 || !low(value).is_finite() {
                return value;
            }
            greatest = N::binary(Binary::Max, greatest, value);
        }
        greatest
    }

    fn norm<N: Number>(&self, h: [N; 4]) -> N {
        let [a, b, c, d] = h.map(square);
        let sum = add(add(a, b), add(c, d));
        match self.iteration {
            Iteration::QuaternionSquare | Iteration::QuaternionCube => sum,
            Iteration::Hypercomplex(_) => scaled(sum, 0.5),
        }
    }

    fn next<N: Number>(&self, [a, b, c, d]: [N; 4]) -> [N; 4] {
        let [p, q, r, s] = self.parameter;
        let plus = |values: [N; 4], more: [f64; 4]| {
            std::array::from_fn(|at| add(values[at], N::constant(more[at])))
        };
        let vector_norm = || add(square(b), add(square(c), square(d)));
        match self.iteration {
            // A quaternion commutes with itself: its powers are as of complex numbers.
            Iteration::QuaternionSquare => {
                let twice = scaled(a, 2.0);
                let real = subtract(square(a), vector_norm());
                let values = [real, times(twice, b), times(twice, c), times(twice, d)];
                plus(values, self.parameter)
            }
            Iteration::QuaternionCube => {
                let (real, rest) = (square(a), vector_norm());
                let first = times(a, subtract(real, scaled(rest, 3.0)));
                let others = subtract(scaled(real, 3.0), rest);
                plus([first, times(others, b), times(others, c), times(others, d)], self.parameter)
            }
            Iteration::Hypercomplex(function) => {
                let (Complex(a, b), Complex(c, d)) =
                    (function.of(Complex(a, b)), function.of(Complex(c, d)));
                plus([a, b, c, d], [p - s, q + r, p + s, q - r])
            }
        }
    }

    pub(super) fn numbers(&self) -> String {
        let Self { parameter, iteration, count, slice, offset } = self;
        format!(
            " {parameter:?} {iteration:?}, {count} iterates, fourth coordinate {slice} + {offset}"
        )
    }
}

impl HypercomplexFunction {
    fn of<N: Number>(self, z: Complex<N>) -> Complex<N> {
        match self {
            Self::Square => z.square(),
            Self::Cube => z.square().times(z),
            Self::Exp => z.exp(),
            Self::Reciprocal => z.reciprocal(),
            Self::Sin => z.sin(),
            Self::Asin => z.asin(),
            Self::Sinh => z.sinh(),
            Self::Asinh => z.asinh(),
            Self::Cos => z.cos(),
            Self::Acos => z.acos(),
            Self::Cosh => z.cosh(),
            Self::Acosh => z.acosh(),
            Self::Tan => z.tan(),
            Self::Atan => z.atan(),
            Self::Tanh => z.tanh(),
            Self::Atanh => z.atanh(),
            Self::Ln => z.ln(),
            Self::Power(re, im) => z.power(Complex::constant(re, im)),
        }
    }
}

/// A Julia fractal within the ball that its iterates must not leave.
#[derive(Debug, Clone, PartialEq)]
pub struct JuliaFractal(pub Isosurface);

impl Local for JuliaFractal {
    fn crossings(&self, ray: &LocalRay, found: &mut Crossings) {
        self.0.crossings(ray, found);
    }

    fn height(&self, part: u32, point: Vector) -> Height {
        self.0.height(part, point)
    }

    fn extent(&self, along: Vector) -> (f64, f64) {
        self.0.extent(along)
    }

    fn reach(&self) -> f64 {
        self.0.reach()
    }

    fn is_iterated(&self) -> bool {
        true
    }

    fn contains(&self, point: Vector) -> bool {
        self.0.contains(point)
    }

    fn numbers(&self) -> String {
        self.0.numbers()
    }
}
