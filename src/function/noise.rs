//! Functions based on noise: `f_noise3d`, and fractals that sum it at finer and finer scales.
//!
//! **In:** a point and, for fractals, the parameters of their octaves. **Out:** a number or its bounds, both
//! computed by the same steps on numbers or on intervals. **Invariant:** bounds are finite if the parameters
//! of a fractal (octaves, scale and weight) are single numbers; otherwise they are [`Interval::EVERYTHING`].
//!
//! **Source:** F. K. Musgrave in Ebert and others, *Texturing and Modeling*, 3rd ed., chapter 16, for the two
//! multifractals; differences from it, and `f_ridge`, were measured on POV-Ray 3.7.

use std::cell::Cell;

use super::number::Number;
use super::operation::{Binary, Unary};
use super::rounded::Rounded;
use super::slope::Sloped;
use crate::math::Vector;
use crate::math::elementary::pow;
use crate::math::interval::Interval;
use crate::noise::{self, NoiseGenerator};

/// An external function based on noise.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NoiseFunction {
    /// Noise of the scene's generator.
    Noise3d,
    /// Noise of the generator given as the last argument.
    Generator,
    /// H, lacunarity, octaves, offset, T, generator: high places are rough, low ones smooth.
    Hetero,
    /// H, lacunarity, octaves, offset, gain, generator: ridges.
    Ridged,
    /// λ, octaves, ω, offset, ridge, generator.
    Ridge,
}

/// Noise with the bounds of its gradient.
fn sloped<const N: usize>(generator: NoiseGenerator, point: [Sloped<N>; 3]) -> Sloped<N> {
    let at = point.map(|coordinate| coordinate.value);
    let (value, steepness) = noise::bounds_and_slopes(generator, at);
    Sloped::follow_point(value, steepness, &point)
}

/// Noise with the error of a computed number.
fn rounded(generator: NoiseGenerator, point: [Rounded; 3]) -> Rounded {
    let sloped = sloped(generator, point.map(|coordinate| coordinate.sloped()));
    let Rounded { value, error } = Rounded::new(sloped, 0.0);
    Rounded { value, error: error + noise::rounding(generator) }
}

/// Maximum number of octaves; further ones are below the precision of numbers, or all equal.
const MOST_OCTAVES: f64 = 1_000.0;

impl NoiseFunction {
    /// Returns the number of arguments, including the three coordinates of the point.
    pub fn parameters(self) -> usize {
        match self {
            Self::Noise3d => 3,
            Self::Generator => 4,
            Self::Hetero | Self::Ridged | Self::Ridge => 9,
        }
    }

    /// Returns the value, where `own` is the scene's generator; missing arguments are zero.
    pub fn value(self, own: NoiseGenerator, arguments: &[f64]) -> f64 {
        let noise = |generator, p: [f64; 3]| noise::noise(generator, Vector::from_array(p));
        self.of(own, arguments, noise, Some).unwrap_or(f64::NAN)
    }

    /// Returns an interval that contains the value for all arguments in these intervals.
    pub fn bounds(self, own: NoiseGenerator, arguments: &[Interval]) -> Interval {
        self.of(own, arguments, noise::bounds, Interval::single).unwrap_or(Interval::EVERYTHING)
    }

    /// Returns the bounds with bounds on the slopes.
    pub fn sloped<const N: usize>(self, own: NoiseGenerator, arguments: &[Sloped<N>]) -> Sloped<N> {
        let level = arguments.iter().all(Sloped::is_level);
        self.of(own, arguments, sloped, |argument| argument.value.single())
            .unwrap_or(Sloped::anyhow(Interval::EVERYTHING, level))
    }

    /// Returns the bounds with the error of a computed number.
    pub fn rounded(self, own: NoiseGenerator, arguments: &[Rounded]) -> Rounded {
        let single = |argument: Rounded| argument.value.single();
        self.of(own, arguments, rounded, single).unwrap_or(Rounded::anyhow(Interval::EVERYTHING))
    }

    fn of<N: Number>(
        self,
        own: NoiseGenerator,
        arguments: &[N],
        noise: impl Fn(NoiseGenerator, [N; 3]) -> N,
        single: impl Fn(N) -> Option<f64>,
    ) -> Option<N> {
        let argument = |at: usize| arguments.get(at).copied().unwrap_or_else(|| N::constant(0.0));
        let shape = |at: usize| single(argument(at));
        let point = [0, 1, 2].map(argument);
        let last = self.parameters() - 1;
        let generator = match self {
            Self::Noise3d => own,
            _ => generator(shape(last)?),
        };
        let noise = |p| noise(generator, p);
        Some(match self {
            Self::Noise3d | Self::Generator => noise(point),
            Self::Hetero => {
                let octaves = Octaves::new(shape(3)?, shape(4)?, shape(5)?);
                let exponent = N::constant(shape(7)?.trunc().max(0.0));
                hetero(point, octaves, argument(6), exponent, noise)
            }
            Self::Ridged => {
                let octaves = Octaves::new(shape(3)?, shape(4)?, shape(5)?);
                ridged(point, octaves, argument(6), argument(7), noise)
            }
            Self::Ridge => {
                let octaves =
                    Octaves { weight: shape(5)?, ..Octaves::new(0.0, shape(3)?, shape(4)?) };
                ridge(point, octaves, [shape(6)?, shape(7)?], noise)
            }
        })
    }
}

/// Returns the generator that a number selects; only the last two bits of its integer part count.
fn generator(number: f64) -> NoiseGenerator {
    match number as i64 & 3 {
        2 => NoiseGenerator::RangeCorrected,
        3 => NoiseGenerator::Perlin,
        _ => NoiseGenerator::Plateaus,
    }
}

/// How the octaves after the first are summed.
#[derive(Clone, Copy)]
struct Octaves {
    /// Ratio of the frequencies of consecutive octaves.
    scale: f64,
    /// Ratio of the weights of consecutive octaves.
    weight: f64,
    count: f64,
}

impl Octaves {
    fn new(h: f64, scale: f64, count: f64) -> Self {
        thread_local! {
            /// The last power: mostly it is the same for all points.
            static LAST: Cell<[f64; 3]> = const { Cell::new([1.0; 3]) };
        }
        let [last_scale, last_h, last] = LAST.get();
        let is_last = last_scale == scale && last_h == h;
        let weight = if is_last { last } else { pow(scale, -h) };
        LAST.set([scale, h, weight]);
        Self { scale, weight, count: count.min(MOST_OCTAVES) }
    }

    /// The fractional part of the count.
    fn rest(self) -> f64 {
        if self.count > 0.0 { self.count.fract() } else { 0.0 }
    }

    fn finer<N: Number>(self, point: [N; 3]) -> [N; 3] {
        point.map(|c| times(c, N::constant(self.scale)))
    }
}

fn plus<N: Number>(a: N, b: N) -> N {
    N::binary(Binary::Add, a, b)
}

fn minus<N: Number>(a: N, b: N) -> N {
    N::binary(Binary::Subtract, a, b)
}

fn times<N: Number>(a: N, b: N) -> N {
    N::binary(Binary::Multiply, a, b)
}

/// Maps 0 … 1 to −1 … 1.
fn signed<N: Number>(noise: N) -> N {
    minus(times(N::constant(2.0), noise), N::constant(1.0))
}

fn hetero<N: Number>(
    mut point: [N; 3],
    octaves: Octaves,
    offset: N,
    exponent: N,
    noise: impl Fn([N; 3]) -> N,
) -> N {
    let raised = |point, weight| times(plus(signed(noise(point)), offset), N::constant(weight));
    let mut value = raised(point, 1.0);
    let (mut weight, mut at) = (1.0, 1.0);
    while at < octaves.count {
        (point, weight, at) = (octaves.finer(point), weight * octaves.weight, at + 1.0);
        let height = N::binary(Binary::Pow, value, exponent);
        value = plus(value, times(raised(point, weight), height));
    }
    if octaves.rest() > 0.0 {
        let last = raised(octaves.finer(point), weight * octaves.weight * octaves.rest());
        value = plus(value, times(last, value));
    }
    value
}

fn ridged<N: Number>(
    mut point: [N; 3],
    octaves: Octaves,
    offset: N,
    gain: N,
    noise: impl Fn([N; 3]) -> N,
) -> N {
    let signal = |point| {
        let ridge = minus(offset, N::unary(Unary::Abs, signed(noise(point))));
        N::unary(Unary::Square, ridge)
    };
    let mut last = signal(point);
    let mut value = last;
    let (mut weight, mut at) = (1.0, 1.0);
    while at < octaves.count {
        (point, weight, at) = (octaves.finer(point), weight * octaves.weight, at + 1.0);
        let above = N::binary(Binary::Max, times(last, gain), N::constant(0.0));
        let part = N::binary(Binary::Min, above, N::constant(1.0));
        last = times(signal(point), part);
        value = plus(value, times(last, N::constant(weight)));
    }
    value
}

fn ridge<N: Number>(
    mut point: [N; 3],
    octaves: Octaves,
    [offset, ridge]: [f64; 2],
    noise: impl Fn([N; 3]) -> N,
) -> N {
    let away = |point| N::unary(Unary::Abs, minus(noise(point), N::constant(ridge)));
    let mut sum = away(point);
    let (mut weight, mut all, mut at) = (1.0, 1.0, 2.0);
    while at <= octaves.count {
        (point, weight, at) = (octaves.finer(point), weight * octaves.weight, at + 1.0);
        sum = plus(sum, times(away(point), N::constant(weight)));
        all += weight;
    }
    if octaves.rest() > 0.0 {
        let weight = weight * octaves.weight * octaves.rest();
        sum = plus(sum, times(away(octaves.finer(point)), N::constant(weight)));
        all += weight;
    }
    let part = N::binary(Binary::Divide, sum, N::constant(all * ridge.max(1.0 - ridge)));
    let lowered = minus(part, N::constant(offset));
    N::binary(Binary::Divide, lowered, N::constant(offset.max(1.0 - offset)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::{Random, long};

    const ALL: [NoiseFunction; 5] = [
        NoiseFunction::Noise3d,
        NoiseFunction::Generator,
        NoiseFunction::Hetero,
        NoiseFunction::Ridged,
        NoiseFunction::Ridge,
    ];

    fn arguments(function: NoiseFunction, draw: &mut Random) -> Vec<f64> {
        let point = [(); 3].map(|()| draw.number(-9.0, 9.0));
        let generator = draw.below(4) as f64;
        let rest = match function {
            NoiseFunction::Noise3d => Vec::new(),
            NoiseFunction::Generator => vec![generator],
            NoiseFunction::Hetero | NoiseFunction::Ridged => {
                let (h, octaves) = (draw.number(0.0, 1.5), draw.number(0.0, 4.0));
                vec![h, draw.number(1.0, 3.0), octaves, 0.7, draw.number(0.0, 2.0), generator]
            }
            NoiseFunction::Ridge => {
                let (octaves, omega) = (draw.number(0.0, 4.0), draw.number(0.2, 0.8));
                vec![draw.number(1.0, 3.0), octaves, omega, 0.3, draw.number(0.1, 1.0), generator]
            }
        };
        point.into_iter().chain(rest).collect()
    }

    #[test]
    fn every_value_lies_in_the_bounds_of_a_box_around_its_point() {
        let mut narrow = 0;
        for seed in 0..(2_000 * long() as u64) {
            let mut draw = Random::of(seed, 5);
            let function = ALL[draw.below(ALL.len())];
            let mut at = arguments(function, &mut draw);
            let width = [0.0, 1e-4, 0.5][draw.below(3)];
            let boxed = |(index, &low): (usize, &f64)| Interval {
                low,
                high: if index < 3 { low + width } else { low },
            };
            let boxed: Vec<_> = at.iter().enumerate().map(boxed).collect();
            let bounds = function.bounds(NoiseGenerator::Perlin, &boxed);
            narrow += usize::from(bounds.high - bounds.low < 0.1);
            for _ in 0..8 {
                for axis in 0..3 {
                    at[axis] = draw.number(boxed[axis].low, boxed[axis].high).min(boxed[axis].high);
                }
                let value = function.value(NoiseGenerator::Perlin, &at);
                assert!(bounds.contains(value), "{function:?} {at:?}: {value} not in {bounds:?}");
            }
        }
        assert!(narrow > 700, "{narrow}");
    }

    #[test]
    fn what_is_not_one_number_shapes_nothing_that_is_bounded() {
        let boxed = [Interval::between(0.0, 1.0); 9];
        assert_eq!(
            NoiseFunction::Ridged.bounds(NoiseGenerator::Perlin, &boxed),
            Interval::EVERYTHING
        );
    }
}
