//! Focal blur: rays through a lens that meet where it is in focus.
//!
//! **Source:** measured on POV-Ray 3.7: the lens is a disc whose points are all alike, or a square that is as bright as
//! a pigment; it lies across `right` and `up`. S. Halton, "On the efficiency of certain quasi-random sequences",
//! Numer. Math. 2, 1960; R. Cranley, T. Patterson, "Randomization of number theoretic methods for multiple
//! integration", SIAM J. Numer. Anal. 13(6), 1976.

use super::{Axes, length, unit};
use crate::math::Vector;
use crate::math::elementary::erf;
use crate::math::random::Random;
use crate::plan::Samples;
use crate::shape::Ray;
use crate::texture::Pigment;
use crate::world::{self, Camera};

/// Bases of the sequences of samples: two for the pixel, two for the lens.
const BASES: [u32; 4] = [2, 3, 5, 7];

/// Samples with which a pixel is known to no error at all, if they agree; and the probability with which the error of
/// others is below what is wanted: for samples that are not the scene's.
const LEAST: u32 = 8;
const CONFIDENCE: f64 = 0.9;

/// A lens that blurs.
pub(in crate::trace) struct Focus {
    pub least: u32,
    pub most: u32,
    /// A pixel needs no more than its first n samples if their variance is below that at index n: with a wanted
    /// variance of 0, it always has the most (as in POV-Ray).
    limits: Vec<f64>,
    pub(super) radius: f64,
    pub(super) distance: f64,
    /// What the direction of a flat camera's ray is divided by, so that it reaches the plane at distance 1.
    depth: Option<f64>,
    right: Vector,
    up: Vector,
    bokeh: Option<Bokeh>,
    /// The first samples.
    samples: Vec<Sample>,
}

/// Samples that are found once for all pixels.
const KNOWN: u32 = 1024;

impl Focus {
    pub fn new(camera: &Camera, focus: &world::Focus) -> Self {
        let Axes { forward, right, up } = Axes::of(camera);
        let &world::Focus { radius, distance, least, most, confidence, variance, .. } = focus;
        let across = right.cross(up);
        let depth = length(camera.forward) * unit(across).dot(forward).abs();
        let depth = if depth > 0.0 { depth } else { length(camera.forward) };
        Self {
            least,
            most,
            limits: limits(most, confidence, variance).collect(),
            radius,
            distance,
            depth: camera.kind.is_flat().then_some(depth),
            right,
            up,
            bokeh: focus.bokeh.as_deref().and_then(Bokeh::new),
            samples: (0..KNOWN).map(Sample::new).collect(),
        }
    }

    /// Returns the same lens, sampled as the options say.
    pub fn sampled(self, samples: Samples) -> Self {
        match samples {
            Samples::Scene => self,
            Samples::Fixed(most) => Self { least: most, most, limits: Vec::new(), ..self },
            Samples::Adaptive { threshold, most } => {
                let least = LEAST.min(most);
                let variance = threshold * threshold;
                // Here, what is wanted does not depend on how many more there may be.
                let limits = limits(most, CONFIDENCE, variance).zip(0..);
                let limits = limits
                    .map(|(limit, n): (f64, u32)| limit * f64::from(most) / f64::from(n.max(1)));
                Self { least, most, limits: limits.collect(), ..self }
            }
        }
    }

    /// Returns the point of the lens, −1 … 1 to the right and up, for two numbers from 0 to 1.
    pub fn point(&self, numbers: [f64; 2]) -> [f64; 2] {
        match &self.bokeh {
            Some(bokeh) => bokeh.place(numbers),
            None => {
                let [radial, turn] = numbers;
                let (sine, cosine) = super::sin_cos(turn);
                let radius = radial.sqrt();
                [radius * cosine, radius * sine]
            }
        }
    }

    /// Returns sample `number` of a pixel: a point of the pixel, 0 … 1 from its left and from its top, and one of the
    /// lens. It depends on nothing else.
    #[inline(always)]
    pub fn sample(&self, shift: &Shift, number: u32) -> [[f64; 2]; 2] {
        let known = self.samples.get(number as usize);
        let Sample { numbers: [a, b, c, d], cosine, sine } =
            known.copied().unwrap_or_else(|| Sample::new(number));
        let [right, down, first, second] = shift.numbers;
        let within = [wrapped(a + right), wrapped(b + down)];
        let radial = wrapped(c + first);
        if self.bokeh.is_some() {
            return [within, self.point([radial, wrapped(d + second)])];
        }
        let radius = radial.sqrt();
        let x = cosine * shift.cosine - sine * shift.sine;
        let y = sine * shift.cosine + cosine * shift.sine;
        [within, [radius * x, radius * y]]
    }

    /// Returns the ray through a point of the lens, −1 … 1 to the right and up, instead of one through its middle.
    pub fn bent(&self, ray: Ray, [x, y]: [f64; 2]) -> Ray {
        let lens = (self.right * x + self.up * y) * self.radius;
        let along = match self.depth {
            Some(depth) => ray.direction / depth,
            None => unit(ray.direction),
        };
        let direction = match self.distance > self.radius {
            true => along - lens / self.distance,
            false => along * self.distance - lens,
        };
        let is_lost = direction == Vector::ZERO || !direction.is_finite();
        Ray { origin: ray.origin + lens, direction: if is_lost { along } else { direction } }
    }

    /// Returns the directions in which points of the lens are counted.
    pub(super) fn axes(&self) -> [Vector; 2] {
        [self.right, self.up]
    }

    /// Returns what the direction of a flat camera's ray is divided by.
    pub(super) fn depth_of_flat(&self) -> f64 {
        self.depth.unwrap_or(1.0)
    }

    /// Returns how many samples a pixel has at once after its first `count`: so many, or all if it has them anyway.
    pub fn at_once(&self, count: u32) -> u32 {
        let may_be_enough = self.limits.last().is_some_and(|most| *most > 0.0);
        if may_be_enough { count } else { self.most }
    }

    /// Returns whether a pixel needs no more than its first `count` samples, of this variance.
    pub fn is_enough(&self, count: u32, variance: f64) -> bool {
        count >= self.most || self.limits.get(count as usize).is_some_and(|most| variance < *most)
    }
}

/// Returns for each count of samples, up to `most`, the largest variance with which so many are enough: the variance of
/// their mean, times the share of the samples that is still open, is then below `variance` with the probability
/// `confidence`.
///
/// **Source:** the dependence on both numbers was measured on POV-Ray 3.7. E. Wilson, M. Hilferty, "The distribution of
/// chi-square", PNAS 17, 1931.
fn limits(most: u32, confidence: f64, variance: f64) -> impl Iterator<Item = f64> {
    let quantile = quantile(confidence);
    (0..=most).map(move |count| {
        if count < 2 {
            return -1.0;
        }
        let n = f64::from(count);
        let freedom = n - 1.0;
        let spread = 2.0 / (9.0 * freedom);
        let root = 1.0 - spread - quantile * spread.sqrt();
        let least = root.max(0.0);
        variance * (n / f64::from(most)) * n * (least * least * least)
    })
}

/// Returns the number below which a normally distributed one lies with this probability.
fn quantile(probability: f64) -> f64 {
    let (mut low, mut high) = (-9.0, 9.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        match 0.5 * (1.0 + erf(middle / std::f64::consts::SQRT_2)) < probability {
            true => low = middle,
            false => high = middle,
        }
    }
    0.5 * (low + high)
}

/// A sample of all pixels, before it is shifted.
#[derive(Debug, Clone, Copy)]
struct Sample {
    numbers: [f64; 4],
    /// Of the turn that the last of them is.
    cosine: f64,
    sine: f64,
}

impl Sample {
    fn new(number: u32) -> Self {
        let numbers = BASES.map(|base| inverse(number + 1, base));
        let (sine, cosine) = super::sin_cos(numbers[3]);
        Self { numbers, cosine, sine }
    }
}

/// By how much the samples of a pixel are shifted, and turned in the lens.
#[derive(Debug, Clone, Copy)]
pub(in crate::trace) struct Shift {
    numbers: [f64; 4],
    cosine: f64,
    sine: f64,
}

impl Shift {
    pub fn of((x, y): (u32, u32)) -> Self {
        let mut random = Random::of(0, u64::from(x) << 32 | u64::from(y));
        let numbers = BASES.map(|_| random.number(0.0, 1.0));
        let (sine, cosine) = super::sin_cos(numbers[3]);
        Self { numbers, cosine, sine }
    }
}

/// Returns the part behind the point of a number from 0 to 2.
#[inline(always)]
fn wrapped(number: f64) -> f64 {
    if number < 1.0 { number } else { number - 1.0 }
}

/// Returns the digits of a number in reverse, behind the point.
fn inverse(mut number: u32, base: u32) -> f64 {
    let (mut value, mut place) = (0.0, 1.0);
    while number > 0 {
        place /= f64::from(base);
        value += place * f64::from(number % base);
        number /= base;
    }
    value
}

/// A lens as bright as a pigment, in cells.
struct Bokeh {
    /// The sum of the brightness of all cells up to each.
    sums: Vec<f64>,
}

/// Cells along a side of the lens.
const SIDE: usize = 128;

impl Bokeh {
    /// Returns a lens; `None` if the pigment is black.
    fn new(pigment: &Pigment) -> Option<Self> {
        let mut sum = 0.0;
        let cell = |k: usize| (k as f64 + 0.5) / SIDE as f64;
        let cells = (0..SIDE * SIDE).map(|k| Vector::new(cell(k % SIDE), cell(k / SIDE), 0.0));
        let sums = cells.map(|at| {
            let bright = pigment.color_at(at).rgb.brightness();
            sum += if bright.is_finite() { bright.max(0.0) } else { 0.0 };
            sum
        });
        let sums: Vec<f64> = sums.collect();
        (sum > 0.0 && sum.is_finite()).then_some(Self { sums })
    }

    /// Returns the point of the lens, −1 … 1 to the right and up; the pigment's y points down.
    fn place(&self, [first, second]: [f64; 2]) -> [f64; 2] {
        let all = self.sums.last().copied().unwrap_or(1.0);
        let wanted = first * all;
        let cell = self.sums.partition_point(|sum| *sum <= wanted).min(SIDE * SIDE - 1);
        let before = if cell == 0 { 0.0 } else { self.sums[cell - 1] };
        let within = ((wanted - before) / (self.sums[cell] - before)).clamp(0.0, 1.0);
        let within = if within.is_finite() { within } else { 0.5 };
        let x = ((cell % SIDE) as f64 + within) / SIDE as f64;
        let y = ((cell / SIDE) as f64 + second) / SIDE as f64;
        [2.0 * x - 1.0, 1.0 - 2.0 * y]
    }
}
