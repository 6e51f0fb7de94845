//! Intersection of a line with three slabs, which are pairs of parallel planes.
//!
//! **In:** a line, three normals and half widths. **Out:** the entry into the last slab and the exit from the
//! first, each with an error bound. **Invariant:** a line without a result certainly misses.

use super::{Chord, Ray};
use crate::math::{Real, Vector3};
use crate::shape::Crossing;

/// The part of a line inside all three slabs, and the faces through which it enters and leaves.
#[derive(Debug, Clone, Copy)]
pub struct Slabs<R: Real = f64> {
    pub enter: Crossing<R>,
    pub leave: Crossing<R>,
    /// As in [`SurfacePoint::face`](crate::shape::SurfacePoint::face).
    pub enter_face: u32,
    pub leave_face: u32,
}

impl Slabs {
    pub(super) fn chord(self) -> Chord {
        Chord { enter: self.enter, leave: self.leave }
    }
}

/// Intersects a line with three slabs; `None` if it misses their intersection.
///
/// With f = S − C, a = N·f, v = N·D, the line enters a slab at (−l·sgn v − a)/v and leaves it at (l·sgn v −
/// a)/v. A line parallel to a slab (v is ±0, or cannot be separated from it within the other slabs) is
/// entirely inside or misses. The line enters the box with the last slab and leaves it with the first. Where
/// these two are closer than their errors, at an edge, the line counts as passing through, so that boxes that
/// share a face leave no gap. An edge belongs to the first of its faces.
///
/// **Error:** a is off by u·(5·|f|₁ + l), and by u·|N|·|C| from the intended face, because C is rounded:
/// coincident faces of two boxes count as one. v is off by 6u·|N|·|D| ≤ 6u, and 1/v, the difference and the
/// product are rounded. So t is off by e(t) = (u·(6·|f|₁ + 3·l + 2·|N|·|C|) + 10u·|t|) / |v|. The last entry
/// lies between the maximum of t − e(t) and the maximum of t + e(t) over all three slabs.
///
/// **Source:** T. Kay, J. Kajiya, "Ray tracing complex scenes", SIGGRAPH 1986, p. 271.
#[inline(always)]
pub fn slabs<R: Real>(
    centre: R::Vector,
    normals: [R::Vector; 3],
    half_widths: [R; 3],
    ray: &Ray<R>,
) -> Option<Slabs<R>> {
    match through_steeply(centre, normals, half_widths, ray) {
        Some(found) => found,
        None => {
            // Put together anew, so that what is found steeply stays in registers.
            let Slabs { enter, leave, enter_face, leave_face } =
                through_nearly_along(centre, normals, half_widths, ray)?;
            Some(Slabs { enter, leave, enter_face, leave_face })
        }
    }
}

/// Returns the result of [`slabs`]; `None` if the line crosses a slab so slowly that the error of its speed
/// matters.
#[inline(always)]
pub(super) fn through_steeply<R: Real>(
    centre: R::Vector,
    normals: [R::Vector; 3],
    half_widths: [R; 3],
    ray: &Ray<R>,
) -> Option<Option<Slabs<R>>> {
    let start = ray.origin - centre;
    let reach = start.component(0).abs() + start.component(1).abs() + start.component(2).abs();
    let mut part = Part::WHOLE;
    for axis in 0..3 {
        let (normal, half_width) = (normals[axis], half_widths[axis]);
        let line = Line::from(start, reach, centre, normal, half_width, ray.direction);
        if line.speed.abs() <= R::from_f64(STEEP) {
            return None;
        }
        part.cut(axis, line, half_width, speed_error());
    }
    Some(part.slabs())
}

#[cold]
#[inline(never)]
fn through_nearly_along<R: Real>(
    centre: R::Vector,
    normals: [R::Vector; 3],
    half_widths: [R; 3],
    ray: &Ray<R>,
) -> Option<Slabs<R>> {
    let found = through(centre, normals, half_widths, ray, None)?;
    let is_told = |normal: R::Vector| {
        let (speed, size) = (normal.dot(ray.direction), normal.abs_dot(ray.direction));
        speed.abs() > R::from_f64(STEEP) || is_level(speed, speed_error::<R>() * size)
    };
    match normals.into_iter().all(is_told) {
        true => Some(found),
        false => Some(decided(found, centre, normals, half_widths, ray)),
    }
}

/// Resolves a line nearly parallel to a slab: if it would be inside that slab from before it enters the
/// others until after it leaves them, then it is inside, whatever rounding did to the ends of the slab.
fn decided<R: Real>(
    found: Slabs<R>,
    centre: R::Vector,
    normals: [R::Vector; 3],
    half_widths: [R; 3],
    ray: &Ray<R>,
) -> Slabs<R> {
    let along = Along::of(centre, normals, half_widths, ray);
    let others = through(centre, normals, half_widths, ray, Some(along));
    let is_same = |one: Crossing<R>, other: Crossing<R>| one.t == other.t;
    Slabs {
        enter: match others {
            Some(others) if is_same(found.enter, others.enter) => others.enter,
            _ => found.enter,
        },
        leave: match others {
            Some(others) if is_same(found.leave, others.leave) => others.leave,
            _ => found.leave,
        },
        ..found
    }
}

/// Returns the part of the line in all slabs. The line counts as parallel to the slabs where that is certain,
/// and to those that `along` names.
#[cold]
#[inline(never)]
pub(super) fn through<R: Real>(
    centre: R::Vector,
    normals: [R::Vector; 3],
    half_widths: [R; 3],
    ray: &Ray<R>,
    along: Option<Along<R>>,
) -> Option<Slabs<R>> {
    let mut part = Part::WHOLE;
    let known = along.map_or([None; 3], |along| along.known);
    for axis in 0..3 {
        let (normal, half_width) = (normals[axis], half_widths[axis]);
        let line = Line::of(centre, normal, half_width, ray);
        let is_slow = line.speed.abs() <= R::from_f64(STEEP);
        let speed_error = match is_slow {
            // A normal along an axis has an exact speed, however small.
            true => speed_error::<R>() * normal.abs_dot(ray.direction),
            false => speed_error(),
        };
        if let Some(within) = known[axis] {
            part.cut_at(axis, line.speed, within);
            continue;
        }
        let along = match along {
            Some(along) if is_slow && along.axes[axis] => Some(along.middle),
            _ if is_slow && is_level(line.speed, speed_error) => Some(R::ZERO),
            _ => None,
        };
        match along {
            Some(middle) => {
                let place = line.place + line.speed * middle;
                if place.abs() - half_width > line.place_error {
                    return None;
                }
            }
            None => part.cut(axis, line, half_width, speed_error),
        }
    }
    part.slabs()
}

/// The part of a line that is in some slabs.
struct Part<R: Real> {
    enter: End<R>,
    leave: End<R>,
}

impl<R: Real> Part<R> {
    const WHOLE: Self = Self {
        enter: End { t: R::NEG_INFINITY, least: R::NEG_INFINITY, most: R::NEG_INFINITY, face: 0 },
        leave: End { t: R::INFINITY, least: R::INFINITY, most: R::INFINITY, face: 0 },
    };

    /// Clips it to one more slab, which the line crosses.
    #[inline(always)]
    fn cut(&mut self, axis: usize, line: Line<R>, half_width: R, speed_error: R) {
        let Self { enter, leave } = self;
        let Line { place, speed, place_error } = line;
        let reciprocal = R::ONE / speed;
        let rising = speed > R::ZERO;
        let side = if rising { half_width } else { -half_width };
        let error = |t: R| (place_error + speed_error * t.abs()) * reciprocal.abs();
        let (first, second) =
            (2 * axis as u32 + u32::from(rising), 2 * axis as u32 + u32::from(!rising));

        let near = (-side - place) * reciprocal;
        let near_error = error(near);
        enter.least = enter.least.max(near - near_error);
        enter.most = enter.most.max(near + near_error);
        if near > enter.t {
            (enter.t, enter.face) = (near, first);
        }
        let far = (side - place) * reciprocal;
        let far_error = error(far);
        leave.least = leave.least.min(far - far_error);
        leave.most = leave.most.min(far + far_error);
        if far < leave.t {
            (leave.t, leave.face) = (far, second);
        }
    }

    /// Clips it to a range that is accurate to its rounding; a limit of −∞ or ∞ has no effect.
    #[cold]
    fn cut_at(&mut self, axis: usize, speed: R, [near, far]: [R; 2]) {
        let Self { enter, leave } = self;
        let rising = speed > R::ZERO;
        let error = |t: R| R::from_f64(4.0) * R::UNIT_ROUNDOFF * t.abs();
        if near > R::NEG_INFINITY {
            enter.least = enter.least.max(near - error(near));
            enter.most = enter.most.max(near + error(near));
        }
        if near > enter.t {
            (enter.t, enter.face) = (near, 2 * axis as u32 + u32::from(rising));
        }
        if far < R::INFINITY {
            leave.least = leave.least.min(far - error(far));
            leave.most = leave.most.min(far + error(far));
        }
        if far < leave.t {
            (leave.t, leave.face) = (far, 2 * axis as u32 + u32::from(!rising));
        }
    }

    #[inline(always)]
    fn slabs(self) -> Option<Slabs<R>> {
        let Self { enter, mut leave } = self;
        // Past all numbers when the ray moves along every slab.
        let met = enter.least <= leave.most && enter.t > R::NEG_INFINITY && leave.t < R::INFINITY;
        if !met {
            return None;
        }
        leave.t = leave.t.max(enter.t);
        Some(Slabs {
            enter: enter.crossing(),
            leave: leave.crossing(),
            enter_face: enter.face,
            leave_face: leave.face,
        })
    }
}

/// Error bound of v.
#[inline(always)]
fn speed_error<R: Real>() -> R {
    R::from_f64(10.0) * R::UNIT_ROUNDOFF
}

/// Returns whether a speed cannot be separated from 0, or has no reciprocal.
#[inline(always)]
fn is_level<R: Real>(speed: R, speed_error: R) -> bool {
    speed.abs() <= R::from_f64(4.0) * speed_error || speed.abs() <= R::from_f64(LEVEL)
}

/// A line relative to a slab: a, v, and the error bound of a.
#[derive(Clone, Copy)]
pub(super) struct Line<R: Real> {
    pub place: R,
    pub speed: R,
    pub place_error: R,
}

impl<R: Real> Line<R> {
    pub fn of(centre: R::Vector, normal: R::Vector, half_width: R, ray: &Ray<R>) -> Self {
        let start = ray.origin - centre;
        let reach = start.component(0).abs() + start.component(1).abs() + start.component(2).abs();
        Self::from(start, reach, centre, normal, half_width, ray.direction)
    }

    #[inline(always)]
    fn from(
        start: R::Vector,
        reach: R,
        centre: R::Vector,
        normal: R::Vector,
        half_width: R,
        direction: R::Vector,
    ) -> Self {
        let number = R::from_f64;
        let far = number(2.0) * normal.abs_dot(centre);
        let place_error = R::UNIT_ROUNDOFF * (number(6.0) * reach + number(3.0) * half_width + far);
        Self { place: normal.dot(start), speed: normal.dot(direction), place_error }
    }
}

/// The slabs that a line is parallel to: within the other slabs, its distance to their planes changes by no
/// more than a few times the error of the planes.
#[derive(Clone, Copy)]
pub(super) struct Along<R: Real> {
    pub axes: [bool; 3],
    /// Range of the line in those slabs for which it is known exactly.
    pub known: [Option<[R; 2]>; 3],
    /// Middle of the range within the other slabs, ahead of the ray's start: a ray that starts on a face is
    /// clear of it there.
    pub middle: R,
}

impl<R: Real> Along<R> {
    #[cold]
    #[inline(never)]
    pub fn of(
        centre: R::Vector,
        normals: [R::Vector; 3],
        half_widths: [R; 3],
        ray: &Ray<R>,
    ) -> Self {
        let number = R::from_f64;
        let lines = [0, 1, 2].map(|axis| Line::of(centre, normals[axis], half_widths[axis], ray));
        let (mut enter, mut leave) = (R::NEG_INFINITY, R::INFINITY);
        for (line, half_width) in lines.iter().zip(half_widths) {
            if line.speed.abs() > number(STEEP) {
                let (middle, way) = (-line.place / line.speed, half_width / line.speed.abs());
                (enter, leave) = (enter.max(middle - way), leave.min(middle + way));
            }
        }
        let far = enter.abs().max(leave.abs());
        let axes = [0, 1, 2].map(|axis| {
            let Line { speed, place_error, .. } = lines[axis];
            let speed_error = speed_error::<R>() * normals[axis].abs_dot(ray.direction);
            is_level(speed, speed_error) || speed.abs() * far <= number(4.0) * place_error
        });
        let middle = number(0.5) * (enter.max(R::ZERO) + leave.max(R::ZERO));
        // It has no end where the line is nearly along all three.
        Self { axes, known: [None; 3], middle: if far < R::INFINITY { middle } else { R::ZERO } }
    }
}

/// Speed across a slab below which the error of the speed itself matters.
const STEEP: f64 = 1.0 / 1_048_576.0;
/// Speed below which a ray is parallel to the slab: the speed has no reciprocal.
const LEVEL: f64 = 4.0 * f32::MIN_POSITIVE as f64;

struct End<R: Real> {
    t: R,
    least: R,
    most: R,
    face: u32,
}

impl<R: Real> End<R> {
    fn crossing(&self) -> Crossing<R> {
        Crossing { t: self.t, error: (self.t - self.least).max(self.most - self.t) }
    }
}
