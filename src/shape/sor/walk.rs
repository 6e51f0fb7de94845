//! Intersects a line with the side of a surface of revolution, stepping between the extrema of ρ² − F and the
//! ends of segments.
//!
//! **Invariant:** ρ² − F is monotone between these points, so the sides at both determine the crossing. Where
//! its Bézier points decide an entire segment, no point within it is evaluated.

use smallvec::SmallVec;

use super::super::U;
use super::super::cylinder::SIDE;
use super::super::local::{LocalRay, Met};
use super::{Bounded, FAR, Segment, Sor};
use crate::math::Vector;
use crate::math::roots::bracket::{Root, root};
use crate::shape::curve::Isolated;

/// Whether it is certainly outside; `None` if rounding decides.
type Side = Option<bool>;

/// The course of ρ² − F along the line through one segment.
struct Course {
    /// The side of the line at each end of the segment.
    sides: [Side; 2],
    /// Whether these determine all crossings between them.
    tells_all: bool,
    /// Approximate position of its single root; NaN if there is none, or possibly more than one.
    root: f64,
}

impl Sor {
    /// Returns the course through a segment, between the positions of its ends. **Method:** along the line,
    /// ρ² − F is a cubic; it is bounded by its Bézier points and has at most as many roots as these have sign
    /// changes.
    fn course(&self, ray: &LocalRay, bounded: &Bounded, ends: [f64; 2]) -> Course {
        let Bounded { segment, greatest: greatest_square, steepness, .. } = bounded;
        if !ends.iter().all(|s| s.abs() < FAR) {
            return Course { sides: [None; 2], tells_all: false, root: f64::NAN };
        }
        let [a, b] = ends.map(|s| ray.at(s));
        let dot = |a: Vector, b: Vector| a.x * b.x + a.y * b.y;
        let (first, middle, last) = (dot(a, a), dot(a, b), dot(b, b));
        let squares = [first, (first + 2.0 * middle) / 3.0, (last + 2.0 * middle) / 3.0, last];
        let greatest = first.max(last);
        let farthest = ends[0].abs().max(ends[1].abs());
        let off = ray.blur_at(farthest) + 8.0 * U * (1.0 + farthest);
        let steepness = 2.0 * greatest.sqrt() + steepness;
        // Of a sample as well as of the Bézier points.
        let error = 32.0 * U * (greatest + greatest_square)
            + 2.0 * off * (steepness + off * (1.0 + self.bend));
        let [p, q, r, t] = segment.squares;
        let points = if ray.direction.z < 0.0 { [t, r, q, p] } else { [p, q, r, t] };
        let values = [0, 1, 2, 3].map(|i| squares[i] - points[i]);
        let sides = values.map(|value| (value.abs() > error).then_some(value > 0.0));
        let turned = sides.windows(2).filter(|pair| pair[0] != pair[1]).count();
        let tells_all = sides.iter().all(Option::is_some) && turned <= 1;
        let root = match tells_all && turned == 1 {
            true => Isolated { from: ends[0], to: ends[1], coefficients: values }.near_root(),
            false => f64::NAN,
        };
        Course { sides: [sides[0], sides[3]], tells_all, root }
    }

    /// Returns where ρ² − F may have extrema along the line within a segment, in order; NaN for those beyond
    /// it.
    fn turns(&self, ray: &LocalRay, segment: &Segment, nearest: f64) -> [f64; 3] {
        let (n, d) = (ray.nearest, ray.direction);
        let Segment { low, high, squares: [a, b, c, e] } = segment;
        let (size, start) = (high - low, low - n.z);
        let across = d.x * d.x + d.y * d.y;
        let along = n.x * d.x + n.y * d.y;
        // Half of the slope of ρ² − F by t, times dz².
        let bend = d.z * d.z;
        let constant = (across * start + along * d.z) * size - 1.5 * (b - a) * bend;
        let linear = across * size * size - 3.0 * ((c - b) - (b - a)) * bend;
        let quadratic = -1.5 * ((e - a) - 3.0 * (c - b)) * bend;
        let root = (linear * linear - 4.0 * quadratic * constant).sqrt();
        let half = -0.5 * (linear + root.copysign(linear));
        let place = |t: f64| match t > 0.0 && t < 1.0 {
            true => (start + t * size) / d.z,
            false => f64::NAN,
        };
        // Across the axis t says little.
        let mut turns = [place(half / quadratic), place(constant / half), nearest];
        turns.sort_unstable_by(f64::total_cmp);
        turns
    }

    /// Returns the crossings with the side, without the ends: steps between the extrema of ρ² − F and the
    /// ends of segments, between which it is monotone.
    #[cold]
    pub(super) fn stepped(&self, ray: &LocalRay) -> SmallVec<[Met; 6]> {
        let mut walk = Walk::new(self, ray);
        let (n, d) = (ray.nearest, ray.direction);
        let nearest = -(n.x * d.x + n.y * d.y) / (d.x * d.x + d.y * d.y);
        let (count, is_down) = (self.segments.len(), d.z < 0.0);
        for number in 0..count {
            let bounded = &self.segments[if is_down { count - 1 - number } else { number }];
            let segment = &bounded.segment;
            let place = |z: f64| (z - n.z) / d.z;
            let (low, high) = (place(segment.low), place(segment.high));
            let (begin, end) = if is_down { (high, low) } else { (low, high) };
            let Course { sides, tells_all, root } = self.course(ray, bounded, [begin, end]);
            // Beyond the ends it tells on which side a rim is passed.
            if number == 0 && sides[0].is_none() {
                walk.to(-FAR, None);
                if nearest < begin {
                    walk.to(nearest, None);
                }
            }
            walk.to(begin, sides[0]);
            if !tells_all {
                let is_flat = !(begin.abs() < FAR && end.abs() < FAR);
                let nearest =
                    if is_flat && !(nearest < begin || nearest > end) { nearest } else { f64::NAN };
                for turn in self.turns(ray, segment, nearest) {
                    walk.to(turn, None);
                }
            }
            walk.near = root;
            walk.to(end, sides[1]);
            walk.near = f64::NAN;
            if number + 1 == count && sides[1].is_none() {
                if nearest > end {
                    walk.to(nearest, None);
                }
                walk.to(FAR, None);
            }
        }
        walk.found()
    }
}

/// State of stepping along a line.
struct Walk<'a> {
    sor: &'a Sor,
    ray: &'a LocalRay<'a>,
    found: SmallVec<[Met; 6]>,
    /// The last position whose side was certain.
    told: Option<(f64, bool)>,
    /// The last position.
    last: Option<(f64, Side)>,
    /// Approximate position of the root before the next position, where known.
    near: f64,
}

impl<'a> Walk<'a> {
    fn new(sor: &'a Sor, ray: &'a LocalRay<'a>) -> Self {
        Self { sor, ray, found: SmallVec::new(), told: None, last: None, near: f64::NAN }
    }

    fn side(&self, s: f64) -> Side {
        let sample = self.sor.sample(self.ray, s);
        (sample.is_inside() || sample.is_outside()).then_some(sample.is_outside())
    }

    /// Advances to a position, whose side may be known; skips positions that are behind, because of rounding,
    /// or NaN.
    fn to(&mut self, s: f64, side: Side) {
        let is_ahead = self.last.is_none_or(|(last, _)| last <= s);
        if !(is_ahead && s.abs() <= FAR) {
            return;
        }
        let side = side.or_else(|| self.side(s));
        // Also between them, for where they tell nothing.
        if let Some((last, before)) = self.last
            && (before.is_none() || side.is_none())
        {
            let middle = 0.5 * (last + s);
            self.note(middle, self.side(middle));
        }
        self.note(s, side);
        self.last = Some((s, side));
    }

    fn note(&mut self, s: f64, side: Side) {
        let met = |t, error, leaving| Met { t, error, leaving, part: SIDE };
        let Some(outside) = side else { return };
        match self.told.replace((s, outside)) {
            // What is not told before may all be outside.
            None if !outside => self.found.push(met(-FAR, s + FAR, false)),
            Some((from, was)) if was != outside => {
                let (far, deep) = if outside { (s, from) } else { (from, s) };
                let sample = |s| self.sor.sample(self.ray, s);
                let Root { t, error } = root(sample, (far, deep), self.near, self.ray.tolerance);
                self.found.push(met(t, error, outside));
            }
            _ => {}
        }
    }

    /// Returns the crossings; a line that is inside at the end leaves there.
    fn found(mut self) -> SmallVec<[Met; 6]> {
        if let Some((last, false)) = self.told {
            self.found.push(Met { t: FAR, error: FAR - last, leaving: true, part: SIDE });
        }
        self.found
    }
}
