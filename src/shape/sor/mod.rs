//! Surface of revolution: in local space, ρ² ≤ F(z) for z between two heights, with ρ the distance from the z
//! axis and F a cubic between adjacent heights.
//!
//! **Source:** manual, section 3.4.5.1.15 ("Surface of Revolution").

mod isolated;
mod walk;

use super::U;
use super::cylinder::{BASE, CAP, SIDE, between};
use super::local::{Crossings, Height, Local, LocalRay, Met};
use crate::math::Vector;
use crate::math::roots::bracket::Sample;

/// The line is searched from −`FAR` to `FAR`; the body ends at √2.
const FAR: f64 = 2.0;

/// F between two heights.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Segment {
    pub low: f64,
    pub high: f64,
    /// Its Bézier points.
    pub squares: [f64; 4],
}

/// F at one height.
struct Square {
    value: f64,
    slope: f64,
    /// Rounding error of the value.
    error: f64,
}

/// A segment, and what bounds F in it.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Bounded {
    segment: Segment,
    /// Upper bound on |F|.
    greatest: f64,
    /// Upper bound on |F′|.
    steepness: f64,
    /// Coefficients of 1, t, t² and t³, with t from 0 to 1.
    powers: [f64; 4],
}

impl Bounded {
    fn new(segment: Segment) -> Self {
        let [a, b, c, d] = segment.squares;
        Self {
            segment,
            greatest: segment.greatest_point(),
            steepness: segment.steepness(),
            powers: [a, 3.0 * (b - a), 3.0 * ((c - b) - (b - a)), (d - a) - 3.0 * (c - b)],
        }
    }

    /// Returns F and its slope by t.
    fn by_powers(&self, t: f64) -> (f64, f64) {
        let [a, b, c, d] = self.powers;
        (a + t * (b + t * (c + t * d)), b + t * (2.0 * c + t * (3.0 * d)))
    }

    fn at(&self, z: f64) -> Square {
        let Segment { low, high, squares: [a, b, c, d] } = self.segment;
        let size = high - low;
        let t = ((z - low) / size).clamp(0.0, 1.0);
        let mix = |a: f64, b: f64| (1.0 - t) * a + t * b;
        let (ab, bc, cd) = (mix(a, b), mix(b, c), mix(c, d));
        let (abc, bcd) = (mix(ab, bc), mix(bc, cd));
        let error = 12.0 * U * self.greatest;
        Square { value: mix(abc, bcd), slope: 3.0 * (bcd - abc) / size, error }
    }

    /// Upper bound on F over one of `parts` equal parts.
    fn greatest(&self, part: usize, parts: usize) -> f64 {
        let Segment { low, high, .. } = self.segment;
        let end = |i: usize| low + (high - low) * (i as f64 / parts as f64);
        let (first, last) = (self.at(end(part)), self.at(end(part + 1)));
        let step = (high - low) / parts as f64;
        first.value.max(last.value) + self.segment.bend() * step * step / 8.0
    }
}

impl Segment {
    /// Upper bound on |F″|.
    fn bend(&self) -> f64 {
        let [a, b, c, d] = self.squares;
        let size = self.high - self.low;
        6.0 * ((c - b) - (b - a)).abs().max(((d - c) - (c - b)).abs()) / (size * size)
    }

    /// Upper bound on |F′|.
    fn steepness(&self) -> f64 {
        let [a, b, c, d] = self.squares;
        3.0 * (b - a).abs().max((c - b).abs()).max((d - c).abs()) / (self.high - self.low)
    }

    /// Upper bound on |F|.
    fn greatest_point(&self) -> f64 {
        self.squares.iter().fold(0.0, |most: f64, point| most.max(point.abs()))
    }
}

/// ρ² ≤ F(z), with F a cubic between adjacent heights, in local space.
#[derive(Debug, Clone, PartialEq)]
pub struct Sor {
    /// In ascending order, end to end.
    segments: Vec<Bounded>,
    /// Whether its ends are invisible; it is still solid.
    pub open: bool,
    /// Upper bound on |F″|.
    bend: f64,
    /// Upper bound on |F|.
    widest: f64,
    /// Upper bound on |F′|.
    steepest: f64,
}

impl Sor {
    /// Builds it from segments in ascending order, end to end within −1 … 1, with F at most 1; `None` if
    /// there are none.
    pub fn new(segments: Vec<Segment>, open: bool) -> Option<Self> {
        let bend = segments.iter().map(Segment::bend).fold(0.0, f64::max);
        let segments: Vec<Bounded> = segments.into_iter().map(Bounded::new).collect();
        let widest = segments.iter().map(|one| one.greatest).fold(0.0, f64::max);
        let steepest = segments.iter().map(|one| one.steepness).fold(0.0, f64::max);
        (!segments.is_empty()).then_some(Self { segments, open, bend, widest, steepest })
    }

    fn heights(&self) -> [f64; 2] {
        [self.segments[0].segment.low, self.segments[self.segments.len() - 1].segment.high]
    }

    /// Returns whether an end has no width, within rounding; the surface comes to a tip there and has no end
    /// face.
    fn is_tip(&self, end: u32) -> bool {
        let [low, high] = self.heights();
        let Square { value, error, .. } = self.square(if end == CAP { high } else { low });
        value <= error
    }

    /// F at a height, clamped to the ends.
    fn square(&self, z: f64) -> Square {
        let number = self.segments.partition_point(|bounded| bounded.segment.high < z);
        self.segments[number.min(self.segments.len() - 1)].at(z)
    }

    /// ρ² − F along the line. **Error:** with B the error of the point, B·(2ρ + |F′|), plus the change of
    /// that within B.
    fn sample(&self, ray: &LocalRay, s: f64) -> Sample {
        let z = ray.at(s).z;
        let [low, high] = self.heights();
        let Square { value, slope, error } = self.square(z);
        // Beyond the ends it is as wide as there.
        let along = if low < z && z < high { slope } else { 0.0 };
        self.sample_of(ray, s, Square { value, slope, error }, along)
    }

    /// [`Self::sample`], given F at the point's height, and its slope along the line.
    #[inline(always)]
    fn sample_of(&self, ray: &LocalRay, s: f64, square: Square, along: f64) -> Sample {
        let (point, d) = (ray.at(s), ray.direction);
        let off = ray.blur_at(s) + 8.0 * U * (1.0 + s.abs());
        let Square { value, slope, error } = square;
        let square = point.x * point.x + point.y * point.y;
        let steepness = 2.0 * square.sqrt() + slope.abs();
        Sample {
            value: square - value,
            slope: 2.0 * (point.x * d.x + point.y * d.y) - along * d.z,
            error: error + 4.0 * U * square + off * (steepness + off * (1.0 + self.bend)),
        }
    }
}

impl Local for Sor {
    fn crossings(&self, ray: &LocalRay, found: &mut Crossings) {
        self.first_crossings(ray, (f64::NEG_INFINITY, f64::INFINITY), found);
    }

    fn first_crossings(&self, ray: &LocalRay, (from, to): (f64, f64), found: &mut Crossings) {
        let Some((first, last)) = between(ray, self.heights()) else { return };
        let seen = |met: Met| match met.part {
            CAP | BASE if self.open && self.is_tip(met.part) => Met { part: SIDE, ..met },
            CAP | BASE if self.open => Met { part: Met::UNSEEN, ..met },
            _ => met,
        };
        let range = (from.max(first.t - first.error), to.min(last.t + last.error));
        let (ahead, begin, end) = (ray.ahead_of(from), first.t + first.error, last.t - last.error);
        let is_enough = |met: &Met| {
            let low = met.t - met.error;
            low > ahead && low > begin && met.t + met.error < end
        };
        let round = self.isolated(ray, range, is_enough).unwrap_or_else(|| self.stepped(ray));
        for pair in round.chunks(2) {
            let [enter, leave] = *pair else {
                // The search ended at a crossing that is enough.
                found.extend(pair.iter().copied().filter(is_enough));
                return;
            };
            let (mut enter, mut leave) = (enter.later(first), leave.earlier(last));
            if enter.t >= leave.t {
                continue;
            }
            // At a rim, an end may be passed where the round is not told.
            for (met, way) in [(&mut enter, 1.0), (&mut leave, -1.0)] {
                let is_told = |met: &Met| self.sample(ray, met.t + way * met.error).is_inside();
                while met.part != SIDE && met.error < FAR && !is_told(met) {
                    met.error = (2.0 * met.error).max(ray.blur_at(met.t) + U);
                }
            }
            // What rounding cannot tell from a miss is missed.
            if enter.t + enter.error < leave.t - leave.error {
                found.push(seen(enter));
                found.push(seen(leave));
            }
        }
    }

    /// Certainly the side, where the point is apart from both ends.
    fn part_at(&self, ray: &LocalRay, s: f64, _: bool) -> Option<u32> {
        let z = ray.at(s).z;
        let off = 64.0 * (ray.blur_at(s) + U * (1.0 + s.abs()));
        let is_apart = self.heights().iter().all(|end| (z - end).abs() > off);
        is_apart.then_some(SIDE)
    }

    fn height(&self, part: u32, point: Vector) -> Height {
        let [low, high] = self.heights();
        match part {
            CAP => Height { value: point.z - high, gradient: Vector::Z, error: U },
            BASE => Height { value: low - point.z, gradient: -Vector::Z, error: U },
            _ => {
                let Square { value, slope, error } = self.square(point.z);
                let square = point.x * point.x + point.y * point.y;
                let gradient = Vector::new(2.0 * point.x, 2.0 * point.y, -slope);
                let error = error + 4.0 * U * square;
                if gradient == Vector::ZERO {
                    // At a tip it faces any way.
                    return Height { value: 0.0, gradient: Vector::Z, error: error.sqrt() };
                }
                Height { value: square - value, gradient, error }
            }
        }
    }

    /// Extent of rings that contain it, a few for each segment.
    fn extent(&self, along: Vector) -> (f64, f64) {
        const RINGS: usize = 32;
        let across = Vector::new(along.x, along.y, 0.0).length();
        let greatest = |z: f64| {
            let ring = |bounded: &Bounded, part: usize| {
                let Segment { low, high, .. } = bounded.segment;
                let size = high - low;
                let end = |i: usize| z * (low + size * (i as f64 / RINGS as f64));
                let square = bounded.greatest(part, RINGS).max(0.0);
                across * square.sqrt() + end(part).max(end(part + 1))
            };
            let all = self.segments.iter().flat_map(|s| (0..RINGS).map(move |i| ring(s, i)));
            all.fold(f64::NEG_INFINITY, f64::max)
        };
        (-greatest(-along.z), greatest(along.z))
    }

    fn is_iterated(&self) -> bool {
        true
    }

    fn price(&self) -> u64 {
        35 + 4 * self.segments.len() as u64
    }

    fn reach(&self) -> f64 {
        let squares = self.segments.iter().map(|Bounded { segment, .. }| {
            let height = segment.low.abs().max(segment.high.abs());
            segment.squares.iter().fold(0.0, |most: f64, b| most.max(*b)) + height * height
        });
        squares.fold(0.0, f64::max).sqrt() * (1.0 + 4.0 * U)
    }

    fn numbers(&self) -> String {
        format!(" of {}{}", self.segments.len(), if self.open { " open" } else { "" })
    }

    fn contains(&self, point: Vector) -> bool {
        let [low, high] = self.heights();
        let square = point.x * point.x + point.y * point.y;
        low < point.z && point.z < high && square < self.square(point.z).value
    }
}

#[cfg(test)]
impl Sor {
    pub(super) fn segments(&self) -> Vec<Segment> {
        self.segments.iter().map(|bounded| bounded.segment).collect()
    }

    pub(super) fn radius(&self, z: f64) -> f64 {
        self.square(z).value.max(0.0).sqrt()
    }
}
