//! Where rays side by side enter and leave a sphere, an ellipsoid or a box.
//!
//! **Out:** of each ray the chord that the shape finds of it alone, to the bit; where that takes a rare case, it says
//! so.

use super::super::box_::slabs::{SPEED_ERROR, STEEP};
use super::super::{Box_, Chord, Crossing, Ellipsoid, Sphere, U};
use super::points::{length, times};
use super::{First, FirstOfFour, is_planet, larger};
use crate::math::AbsDot;
use crate::math::wide::*;

/// The chords of rays side by side.
pub(crate) struct Chords {
    /// The places where each ray enters and leaves, and their errors.
    ends: [Row; 2],
    errors: [Row; 2],
    /// A bit for each ray that has a chord.
    met: u32,
    /// A bit for each ray that is not known to have one.
    unknown: u32,
}

impl Chords {
    /// Of no ray anything is known.
    pub const NONE: Self =
        Self { ends: [[0.0; ROW]; 2], errors: [[0.0; ROW]; 2], met: 0, unknown: u32::MAX };

    /// Returns the chord of the ray of a number; `None` where it takes more to tell.
    #[inline(always)]
    pub fn at(&self, number: usize) -> Option<Option<Chord>> {
        if self.unknown >> number & 1 == 1 {
            return None;
        }
        let crossing =
            |end: usize| Crossing { t: self.ends[end][number], error: self.errors[end][number] };
        let is_met = self.met >> number & 1 == 1;
        Some(is_met.then(|| Chord { enter: crossing(0), leave: crossing(1) }))
    }

    #[inline(always)]
    fn store<S: Simd>(&mut self, group: usize, four: &FourChords<S>) {
        for end in 0..2 {
            store(four.ends[end], &mut self.ends[end], group);
            store(four.errors[end], &mut self.errors[end], group);
        }
        let all = bits(Mask::splat(four.ends[0].simd, true), group);
        self.met |= bits(four.met, group);
        self.unknown = self.unknown & !all | bits(four.unsure, group);
    }
}

/// The chords of four rays.
pub(crate) struct FourChords<S: Simd> {
    ends: [Wide<S>; 2],
    errors: [Wide<S>; 2],
    met: Mask<S>,
    unsure: Mask<S>,
}

/// A solid whose chords are found for four rays at once.
pub(crate) trait ChordsOfFour {
    fn chords_of_four<S: Simd>(&self, simd: S, ray: &WideRay<S>) -> FourChords<S>;

    /// Finds the chords of the rays of `mask`.
    #[inline(always)]
    fn chords<S: Simd>(&self, simd: S, rays: &Rays, mask: u32, chords: &mut Chords) {
        for group in 0..GROUPS {
            if has(mask, group) {
                chords.store(group, &self.chords_of_four(simd, &rays.four(simd, group)));
            }
        }
    }
}

impl<S: Simd> FourChords<S> {
    /// Returns the first crossing that is ahead and seen, of the rays that are `near`.
    #[inline(always)]
    fn first(&self, simd: S, near: Mask<S>, shows: [bool; 2], limit: Wide<S>) -> First<S> {
        let Self { ends: [enter, leave], errors, met, unsure } = *self;
        let (enter_shows, leave_shows) = (Mask::splat(simd, shows[0]), Mask::splat(simd, shows[1]));
        let enters = enter_shows & enter.simd_gt(errors[0]);
        let leaves = leave_shows & leave.simd_gt(errors[1]);
        let t = enters.select(enter, leave);
        let met = near & met & (enters | leaves) & t.simd_le(limit) & !unsure;
        First {
            t: met.select(t, all(simd, f64::INFINITY)),
            error: enters.select(errors[0], errors[1]),
            leaving: !enters,
            unsure: near & unsure,
        }
    }
}

impl ChordsOfFour for Sphere {
    /// Returns [`Sphere::chord`] of each ray.
    #[inline(always)]
    fn chords_of_four<S: Simd>(&self, simd: S, ray: &WideRay<S>) -> FourChords<S> {
        let radius = all(simd, self.radius);
        let radius_squared = all(simd, self.radius * self.radius);
        let start = ray.origin - WideVector::splat(simd, self.centre);
        let along = start.dot(ray.direction);
        let offset = start - ray.direction * along;
        let (start_squared, miss_squared) = (start.length_squared(), offset.length_squared());
        let size = start_squared + radius_squared;
        let [least, most] = Self::SAFE_SQUARES;
        let is_safe = size.simd_gt(all(simd, least)) & size.simd_lt(all(simd, most));

        let power = start_squared - radius_squared;
        let is_close = (all(simd, 1024.0) * power.abs()).simd_lt(radius_squared);
        let is_close = is_close & is_planet(simd, radius, ray.origin);
        let roots = WideRoots { along, miss: miss_squared.sqrt(), start_squared, radius };
        let FourChords { ends, errors, met, unsure } = roots.chord(simd, None);
        let met = met & !miss_squared.simd_gt(radius_squared);
        FourChords { ends, errors, met, unsure: unsure | !is_safe | is_close }
    }
}

impl ChordsOfFour for Ellipsoid {
    /// Returns [`Ellipsoid::chord`] of each ray.
    #[inline(always)]
    fn chords_of_four<S: Simd>(&self, simd: S, ray: &WideRay<S>) -> FourChords<S> {
        let matrix = self.placement.local_from_world;
        let sizes = matrix.abs();
        let from_centre = ray.origin - WideVector::splat(simd, self.placement.centre);
        let start = times(simd, &matrix, from_centre);
        let step = times(simd, &matrix, ray.direction);
        let speed = length(step);
        let direction = step / speed;
        let along = start.dot(direction);
        let miss = length(start - direction * along);

        let (six, u) = (all(simd, 6.0), all(simd, U));
        let reach = length(times(simd, &sizes, from_centre.abs()));
        let turn = length(times(simd, &sizes, ray.direction.abs())) / speed;
        let start_squared = start.length_squared();
        let blur = WideBlur {
            miss: u * (six * reach + six * turn * along.abs()),
            along: u * (six * reach + six * turn * (along.abs() + miss)),
            power: all(simd, U * 12.0) * reach * start_squared.sqrt(),
            scale: all(simd, U * 6.0) * turn,
            unit: all(simd, 1.0) / speed,
        };
        let radius = all(simd, 1.0);
        WideRoots { along, miss, start_squared, radius }.chord(simd, Some(blur))
    }
}

impl FirstOfFour for Ellipsoid {
    #[inline(always)]
    fn first_of_four<S: Simd>(
        &self,
        simd: S,
        ray: &WideRay<S>,
        shows: [bool; 2],
        limit: Wide<S>,
    ) -> First<S> {
        self.chords_of_four(simd, ray).first(simd, Mask::splat(simd, true), shows, limit)
    }
}

/// The terms of [`super::super::sphere::Roots`], for four rays.
struct WideRoots<S: Simd> {
    along: Wide<S>,
    miss: Wide<S>,
    start_squared: Wide<S>,
    radius: Wide<S>,
}

/// [`super::super::sphere::Blur`], and the unit of lengths, for four rays.
struct WideBlur<S: Simd> {
    miss: Wide<S>,
    along: Wide<S>,
    power: Wide<S>,
    scale: Wide<S>,
    unit: Wide<S>,
}

impl<S: Simd> WideRoots<S> {
    /// Returns the chord of roots that need not be refined: `Roots::blurred_chord`.
    #[inline(always)]
    fn chord(&self, simd: S, blur: Option<WideBlur<S>>) -> FourChords<S> {
        let Self { along, miss, start_squared, radius } = *self;
        let (zero, u, two) = (all(simd, 0.0), all(simd, U), all(simd, 2.0));
        let half = ((radius - miss) * (radius + miss)).sqrt();
        let radius_squared = radius * radius;
        let power = start_squared - radius_squared;
        let squares = all(simd, 6.0) * start_squared + two * radius_squared;
        let middle = along.abs();
        let far = middle + half;
        let near = power / far;
        let near = near.simd_lt(far).select(near, far);

        let size = middle + miss;
        let mut slid = all(simd, 16.0 * U) * size;
        if let Some(blur) = &blur {
            slid += blur.along;
        }
        let mut square_error =
            u * (all(simd, 14.0) * miss * size + all(simd, 4.0) * half * half) + slid * slid;
        if let Some(blur) = &blur {
            square_error += blur.miss * (two * miss + blur.miss);
        }
        let is_small = square_error.simd_lt(half * half);
        let half_error = is_small.select(square_error / half, square_error.sqrt());
        let far_error = half_error + slid + all(simd, 8.0 * U) * half;
        let mut power_error = u * (squares + all(simd, 9.0) * power.abs());
        if let Some(blur) = &blur {
            power_error += blur.power;
        }
        let by_power = (power_error + near.abs() * far_error) / (far - far_error)
            + all(simd, 2.0 * U) * near.abs();
        let by_sum = far_error + (near - (middle - half)).abs();
        let near_error = far.simd_gt(far_error + far_error).select(by_power, by_sum);

        let away = along.simd_gt(zero);
        let mut ends = [away.select(-far, near), away.select(-near, far)];
        let mut errors = [away.select(far_error, near_error), away.select(near_error, far_error)];
        if let Some(blur) = &blur {
            for (end, error) in ends.iter_mut().zip(&mut errors) {
                *error = (*error + end.abs() * blur.scale) * blur.unit;
                *end *= blur.unit;
            }
        }
        FourChords { ends, errors, met: half.simd_gt(zero), unsure: Mask::splat(simd, false) }
    }
}

impl ChordsOfFour for Box_ {
    /// Returns [`Box_::chord_of_part`] of each ray.
    #[inline(always)]
    fn chords_of_four<S: Simd>(&self, simd: S, ray: &WideRay<S>) -> FourChords<S> {
        let start = ray.origin - WideVector::splat(simd, self.centre);
        let reach = start.abs().element_sum();
        let infinity = all(simd, f64::INFINITY);
        let mut unsure = Mask::splat(simd, false);
        let [mut enter, mut enter_least, mut enter_most] = [-infinity; 3];
        let [mut leave, mut leave_least, mut leave_most] = [infinity; 3];
        for axis in 0..3 {
            let (normal, half_width) = (self.normals[axis].get(), self.half_widths[axis]);
            let far = 2.0 * normal.abs_dot(self.centre);
            let place_error = all(simd, U)
                * (all(simd, 6.0) * reach + all(simd, 3.0 * half_width) + all(simd, far));
            let normal = WideVector::splat(simd, normal);
            let (place, speed) = (normal.dot(start), normal.dot(ray.direction));
            let half_width = all(simd, half_width);
            let reciprocal = all(simd, 1.0) / speed;
            let side = speed.simd_gt(all(simd, 0.0)).select(half_width, -half_width);
            let steepness = reciprocal.abs();

            let near = (-side - place) * reciprocal;
            let near_error = (place_error + all(simd, SPEED_ERROR) * near.abs()) * steepness;
            enter_least = larger(enter_least, near - near_error);
            enter_most = larger(enter_most, near + near_error);
            enter = larger(enter, near);
            let far = (side - place) * reciprocal;
            let far_error = (place_error + all(simd, SPEED_ERROR) * far.abs()) * steepness;
            leave_least = smaller(leave_least, far - far_error);
            leave_most = smaller(leave_most, far + far_error);
            leave = smaller(leave, far);

            let is_steep = speed.abs().simd_gt(all(simd, STEEP));
            unsure |= !(is_steep & near.is_finite() & far.is_finite());
        }
        let met = !enter_least.simd_gt(leave_most);
        let leave = larger(leave, enter);
        FourChords {
            ends: [enter, leave],
            errors: [
                larger(enter - enter_least, enter_most - enter),
                larger(leave - leave_least, leave_most - leave),
            ],
            met,
            unsure,
        }
    }
}

/// A box, and the square of the radius that holds it.
impl FirstOfFour for (Box_, f64) {
    /// Returns the first crossing that is seen of [`Box_::chord`], unless [`Box_::is_out_of_reach`].
    #[inline(always)]
    fn first_of_four<S: Simd>(
        &self,
        simd: S,
        ray: &WideRay<S>,
        shows: [bool; 2],
        limit: Wide<S>,
    ) -> First<S> {
        let (solid, reach_squared) = self;
        let reach_squared = all(simd, *reach_squared);
        let start = ray.origin - WideVector::splat(simd, solid.centre);
        let along = start.dot(ray.direction);
        let offset = start - ray.direction * along;
        let is_away = along.simd_gt(all(simd, 0.0));
        let behind = is_away & start.length_squared().simd_gt(reach_squared);
        let blur = along * all(simd, 1.0 / (1u64 << 40) as f64);
        let beside = offset.length_squared().simd_gt(reach_squared + blur * blur);
        let near = !(behind | beside);
        if !near.any_true() {
            return First::none(simd);
        }
        solid.chords_of_four(simd, ray).first(simd, near, shows, limit)
    }
}

/// Returns the smaller of numbers.
#[inline(always)]
fn smaller<S: Simd>(a: Wide<S>, b: Wide<S>) -> Wide<S> {
    b.simd_lt(a).select(b, a)
}
