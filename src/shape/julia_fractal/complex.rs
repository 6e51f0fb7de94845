//! Complex numbers whose parts are any [`Number`], and their functions.
//!
//! **Source:** M. Abramowitz, I. Stegun, *Handbook of Mathematical Functions*, chapter 4.

use crate::function::{Binary, Number, Unary};

/// The real and the imaginary part.
#[derive(Debug, Clone, Copy)]
pub(super) struct Complex<N>(pub N, pub N);

pub(super) fn add<N: Number>(a: N, b: N) -> N {
    N::binary(Binary::Add, a, b)
}

pub(super) fn subtract<N: Number>(a: N, b: N) -> N {
    N::binary(Binary::Subtract, a, b)
}

pub(super) fn times<N: Number>(a: N, b: N) -> N {
    N::binary(Binary::Multiply, a, b)
}

pub(super) fn scaled<N: Number>(a: N, by: f64) -> N {
    times(a, N::constant(by))
}

pub(super) fn square<N: Number>(a: N) -> N {
    N::unary(Unary::Square, a)
}

fn one<N: Number>(operation: Unary, a: N) -> N {
    N::unary(operation, a)
}

impl<N: Number> Complex<N> {
    pub fn constant(re: f64, im: f64) -> Self {
        Self(N::constant(re), N::constant(im))
    }

    pub fn plus(self, other: Self) -> Self {
        Self(add(self.0, other.0), add(self.1, other.1))
    }

    fn minus(self, other: Self) -> Self {
        Self(subtract(self.0, other.0), subtract(self.1, other.1))
    }

    pub fn times(self, other: Self) -> Self {
        let (a, b) = (self, other);
        Self(subtract(times(a.0, b.0), times(a.1, b.1)), add(times(a.0, b.1), times(a.1, b.0)))
    }

    fn scaled(self, by: f64) -> Self {
        Self(scaled(self.0, by), scaled(self.1, by))
    }

    /// i times it.
    fn turned(self) -> Self {
        Self(one(Unary::Negate, self.1), self.0)
    }

    pub fn square(self) -> Self {
        Self(subtract(square(self.0), square(self.1)), scaled(times(self.0, self.1), 2.0))
    }

    /// |z|².
    pub fn norm(self) -> N {
        add(square(self.0), square(self.1))
    }

    pub fn reciprocal(self) -> Self {
        let norm = self.norm();
        let over = |a: N| N::binary(Binary::Divide, a, norm);
        Self(over(self.0), one(Unary::Negate, over(self.1)))
    }

    pub fn exp(self) -> Self {
        let size = one(Unary::Exp, self.0);
        Self(times(size, one(Unary::Cos, self.1)), times(size, one(Unary::Sin, self.1)))
    }

    pub fn ln(self) -> Self {
        Self(scaled(one(Unary::Ln, self.norm()), 0.5), N::binary(Binary::Atan2, self.1, self.0))
    }

    /// The root whose real part is not negative.
    fn sqrt(self) -> Self {
        let size = one(Unary::Sqrt, self.norm());
        let half_root = |sum: N| {
            let not_negative = N::binary(Binary::Max, sum, N::constant(0.0));
            one(Unary::Sqrt, scaled(not_negative, 0.5))
        };
        let (re, im) = (half_root(add(size, self.0)), half_root(subtract(size, self.0)));
        let is_below = N::binary(Binary::Less, self.1, N::constant(0.0));
        Self(re, N::choose(is_below, one(Unary::Negate, im), im))
    }

    pub fn sinh(self) -> Self {
        let (sine, cosine) = (one(Unary::Sin, self.1), one(Unary::Cos, self.1));
        Self(times(one(Unary::Sinh, self.0), cosine), times(one(Unary::Cosh, self.0), sine))
    }

    pub fn cosh(self) -> Self {
        let (sine, cosine) = (one(Unary::Sin, self.1), one(Unary::Cos, self.1));
        Self(times(one(Unary::Cosh, self.0), cosine), times(one(Unary::Sinh, self.0), sine))
    }

    pub fn tanh(self) -> Self {
        let twice = self.scaled(2.0);
        let below = add(one(Unary::Cosh, twice.0), one(Unary::Cos, twice.1));
        let over = |a: N| N::binary(Binary::Divide, a, below);
        Self(over(one(Unary::Sinh, twice.0)), over(one(Unary::Sin, twice.1)))
    }

    /// −i·f(iz), which makes sin of sinh, tan of tanh, and so on.
    fn across(self, f: impl Fn(Self) -> Self) -> Self {
        f(self.turned()).turned().scaled(-1.0)
    }

    pub fn sin(self) -> Self {
        self.across(Self::sinh)
    }

    pub fn cos(self) -> Self {
        self.turned().cosh()
    }

    pub fn tan(self) -> Self {
        self.across(Self::tanh)
    }

    pub fn asinh(self) -> Self {
        self.plus(self.square().plus(Self::constant(1.0, 0.0)).sqrt()).ln()
    }

    pub fn acosh(self) -> Self {
        let unit = Self::constant(1.0, 0.0);
        self.plus(self.minus(unit).sqrt().times(self.plus(unit).sqrt())).ln()
    }

    pub fn atanh(self) -> Self {
        let unit = Self::constant(1.0, 0.0);
        unit.plus(self).ln().minus(unit.minus(self).ln()).scaled(0.5)
    }

    pub fn asin(self) -> Self {
        self.across(Self::asinh)
    }

    pub fn acos(self) -> Self {
        Self::constant(std::f64::consts::FRAC_PI_2, 0.0).minus(self.asin())
    }

    pub fn atan(self) -> Self {
        self.across(Self::atanh)
    }

    pub fn power(self, exponent: Self) -> Self {
        self.ln().times(exponent).exp()
    }
}
