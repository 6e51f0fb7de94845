//! Intersects a line with the side of a surface of revolution, where the Bézier coefficients of ρ² − F along the
//! line isolate all crossings: nearly always.
//!
//! **Invariant:** what rounding may decide is left to [`Sor::stepped`].

use smallvec::SmallVec;

use super::super::U;
use super::super::cylinder::SIDE;
use super::super::local::{LocalRay, Met};
use super::{Bounded, FAR, Sor};
use crate::math::Vector;
use crate::math::roots::bracket::root;
use crate::shape::curve::{Isolated, isolate};

/// Square of the radius of a cylinder around the body, relative to that of the body: enough for the line to be
/// certainly outside where it leaves the cylinder.
const WIDER: f64 = 1.0625;

/// Vertical speed below which rounding may decide between which heights the line is.
const FLAT: f64 = 1e-6;

/// Square of the speed across the axis below which a line is not held against that cylinder. Affects only the
/// running time.
const UPRIGHT_SQUARED: f64 = 1e-6;

fn dot(a: Vector, b: Vector) -> f64 {
    a.x * b.x + a.y * b.y
}

impl Sor {
    /// Returns the crossings with the side, without the ends, up to one for which `is_enough`; `None` where rounding
    /// may decide. Those that are certainly not in a range have wide bounds.
    pub(super) fn isolated(
        &self,
        ray: &LocalRay,
        range: (f64, f64),
        is_enough: impl Fn(&Met) -> bool,
    ) -> Option<SmallVec<[Met; 6]>> {
        let (n, d) = (ray.nearest, ray.direction);
        if d.z.abs() < FLAT {
            return None;
        }
        let mut found = SmallVec::new();
        let (from, to) = match self.within_cylinder(ray)? {
            Some(chord) => chord,
            None => return Some(found),
        };
        let met = |t, error, leaving| Met { t, error, leaving, part: SIDE };
        let mut is_done = false;
        // The last position, and whether the line is outside there.
        let mut last: Option<(f64, bool)> = None;
        let (count, is_down) = (self.segments.len(), d.z < 0.0);
        for number in 0..count {
            let bounded = &self.segments[if is_down { count - 1 - number } else { number }];
            let place = |z: f64| (z - n.z) / d.z;
            let ends = (place(bounded.segment.low), place(bounded.segment.high));
            let (begin, end) = if is_down { (ends.1, ends.0) } else { ends };
            let (begin, end) = (begin.max(from), end.min(to));
            if begin >= end {
                continue;
            }
            let (coefficients, error) = self.coefficients(ray, bounded, (begin, end));
            if last.is_none() && coefficients[0] < 0.0 {
                found.push(met(-FAR, begin + FAR, false));
            }
            let sample = |s: f64| {
                let square = bounded.at(ray.at(s).z);
                let slope = square.slope;
                self.sample_of(ray, s, square, slope)
            };
            let at = |t: f64| begin + (end - begin) * t;
            let is_told = isolate(coefficients, error, &mut |part: &Isolated<4>| {
                if is_done {
                    return;
                }
                let (low, high) = (at(part.from), at(part.to));
                if high < range.0 || low > range.1 {
                    found.push(met(0.5 * (low + high), 0.5 * (high - low), part.rises()));
                    return;
                }
                let ends = if part.rises() { (high, low) } else { (low, high) };
                let root = root(sample, ends, at(part.near_root()), ray.tolerance);
                let met = met(root.t, root.error, part.rises());
                found.push(met);
                is_done = is_enough(&met);
            });
            if is_done {
                return Some(found);
            }
            if !is_told {
                return None;
            }
            last = Some((end, coefficients[3] > 0.0));
        }
        if let Some((end, false)) = last {
            found.push(met(FAR, FAR - end, true));
        }
        Some(found)
    }

    /// Returns the part of the line within a cylinder around the body, if it passes through it; `None` where
    /// rounding may decide.
    fn within_cylinder(&self, ray: &LocalRay) -> Option<Option<(f64, f64)>> {
        let off = ray.blur_at(FAR) + 8.0 * U * (1.0 + FAR);
        let around = WIDER * self.widest;
        let steepness = 2.0 * around.sqrt() + self.steepest;
        let error = 1024.0 * U * self.widest + 2.0 * off * (steepness + off * (1.0 + self.bend));
        let is_told = around - self.widest > error;
        if !is_told {
            return None;
        }
        let speed_squared = dot(ray.direction, ray.direction);
        if speed_squared < UPRIGHT_SQUARED {
            return Some(Some((-FAR, FAR)));
        }
        let nearest = -dot(ray.nearest, ray.direction) / speed_squared;
        let point = ray.at(nearest);
        let room = around - dot(point, point);
        let half = (room / speed_squared).sqrt();
        Some((room > 0.0).then_some(((nearest - half).max(-FAR), (nearest + half).min(FAR))))
    }

    /// Returns the Bézier coefficients of ρ² − F between two positions within a segment, and their error, which is
    /// also that of a sample there.
    #[inline(always)]
    fn coefficients(
        &self,
        ray: &LocalRay,
        bounded: &Bounded,
        (begin, end): (f64, f64),
    ) -> ([f64; 4], f64) {
        let (a, b) = (ray.at(begin), ray.at(end));
        let (first, middle, last) = (dot(a, a), dot(a, b), dot(b, b));
        let size = bounded.segment.high - bounded.segment.low;
        let [start, stop] =
            [(a.z - bounded.segment.low) / size, (b.z - bounded.segment.low) / size];
        let ((low, rise), (high, fall)) = (bounded.by_powers(start), bounded.by_powers(stop));
        let third = (stop - start) / 3.0;
        let coefficients = [
            first - low,
            (first + 2.0 * middle) / 3.0 - (low + third * rise),
            (last + 2.0 * middle) / 3.0 - (high - third * fall),
            last - high,
        ];
        let greatest = first.max(last);
        let farthest = begin.abs().max(end.abs());
        let off = ray.blur_at(farthest) + 8.0 * U * (1.0 + farthest);
        let steepness = 2.0 * greatest.sqrt() + bounded.steepness;
        let error = 512.0 * U * (greatest + bounded.greatest)
            + 2.0 * off * (steepness + off * (1.0 + self.bend));
        (coefficients, error)
    }
}

#[cfg(test)]
impl Sor {
    /// Returns the crossings with the side, as isolated and as stepped to: positions and errors in order. `None` where
    /// one is not between the ends: only steps go on beyond them.
    pub(in crate::shape) fn both_ways(&self, ray: &LocalRay) -> [Option<Vec<(f64, f64)>>; 2] {
        let isolated = self.isolated(ray, (f64::NEG_INFINITY, f64::INFINITY), |_| false);
        let (stepped, [low, high]) = (self.stepped(ray), self.heights());
        let is_between = |met: &Met| (low..high).contains(&ray.at(met.t).z);
        if !stepped.iter().all(is_between) {
            return [None, None];
        }
        [isolated, Some(stepped)]
            .map(|all| Some(all?.iter().map(|met| (met.t, met.error)).collect()))
    }
}
