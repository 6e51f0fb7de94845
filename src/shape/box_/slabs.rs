//! Intersection of a line with three slabs, which are pairs of parallel planes.
//!
//! **In:** a line, three normals and half widths. **Out:** the entry into the last slab and the exit from the
//! first, each with an error bound. **Invariant:** a line without a result certainly misses.

use super::{Chord, Ray, U};
use crate::math::{AbsDot, Vector};
use crate::shape::Crossing;

/// The part of a line inside all three slabs, and the faces through which it enters and leaves.
#[derive(Debug, Clone, Copy)]
pub(super) struct Slabs {
    pub enter: Crossing,
    pub leave: Crossing,
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
pub(super) fn slabs(
    centre: Vector,
    normals: [Vector; 3],
    half_widths: [f64; 3],
    ray: &Ray,
) -> Option<Slabs> {
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
pub(super) fn through_steeply(
    centre: Vector,
    normals: [Vector; 3],
    half_widths: [f64; 3],
    ray: &Ray,
) -> Option<Option<Slabs>> {
    let start = ray.origin - centre;
    let reach = start.x.abs() + start.y.abs() + start.z.abs();
    let mut part = Part::WHOLE;
    for axis in 0..3 {
        let (normal, half_width) = (normals[axis], half_widths[axis]);
        let line = Line::from(start, reach, centre, normal, half_width, ray.direction);
        if line.speed.abs() <= STEEP {
            return None;
        }
        part.cut(axis, line, half_width, SPEED_ERROR);
    }
    Some(part.slabs())
}

#[cold]
#[inline(never)]
fn through_nearly_along(
    centre: Vector,
    normals: [Vector; 3],
    half_widths: [f64; 3],
    ray: &Ray,
) -> Option<Slabs> {
    let found = through(centre, normals, half_widths, ray, None)?;
    let is_told = |normal: Vector| {
        let (speed, size) = (normal.dot(ray.direction), normal.abs_dot(ray.direction));
        speed.abs() > STEEP || is_level(speed, SPEED_ERROR * size)
    };
    match normals.into_iter().all(is_told) {
        true => Some(found),
        false => Some(decided(found, centre, normals, half_widths, ray)),
    }
}

/// Resolves a line nearly parallel to a slab: if it would be inside that slab from before it enters the
/// others until after it leaves them, then it is inside, whatever rounding did to the ends of the slab.
fn decided(
    found: Slabs,
    centre: Vector,
    normals: [Vector; 3],
    half_widths: [f64; 3],
    ray: &Ray,
) -> Slabs {
    let along = Along::of(centre, normals, half_widths, ray);
    let others = through(centre, normals, half_widths, ray, Some(along));
    let is_same = |one: Crossing, other: Crossing| one.t == other.t;
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
pub(super) fn through(
    centre: Vector,
    normals: [Vector; 3],
    half_widths: [f64; 3],
    ray: &Ray,
    along: Option<Along>,
) -> Option<Slabs> {
    let mut part = Part::WHOLE;
    let known = along.map_or([None; 3], |along| along.known);
    for axis in 0..3 {
        let (normal, half_width) = (normals[axis], half_widths[axis]);
        let line = Line::of(centre, normal, half_width, ray);
        let is_slow = line.speed.abs() <= STEEP;
        let speed_error = match is_slow {
            // A normal along an axis has an exact speed, however small.
            true => SPEED_ERROR * normal.abs_dot(ray.direction),
            false => SPEED_ERROR,
        };
        if let Some(within) = known[axis] {
            part.cut_at(axis, line.speed, within);
            continue;
        }
        let along = match along {
            Some(along) if is_slow && along.axes[axis] => Some(along.middle),
            _ if is_slow && is_level(line.speed, speed_error) => Some(0.0),
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
struct Part {
    enter: End,
    leave: End,
}

impl Part {
    const WHOLE: Self = Self {
        enter: End {
            t: f64::NEG_INFINITY,
            least: f64::NEG_INFINITY,
            most: f64::NEG_INFINITY,
            face: 0,
        },
        leave: End { t: f64::INFINITY, least: f64::INFINITY, most: f64::INFINITY, face: 0 },
    };

    /// Clips it to one more slab, which the line crosses.
    #[inline(always)]
    fn cut(&mut self, axis: usize, line: Line, half_width: f64, speed_error: f64) {
        let Self { enter, leave } = self;
        let Line { place, speed, place_error } = line;
        let reciprocal = 1.0 / speed;
        let rising = speed > 0.0;
        let side = if rising { half_width } else { -half_width };
        let error = |t: f64| (place_error + speed_error * t.abs()) * reciprocal.abs();
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
    fn cut_at(&mut self, axis: usize, speed: f64, [near, far]: [f64; 2]) {
        let Self { enter, leave } = self;
        let rising = speed > 0.0;
        let error = |t: f64| 4.0 * U * t.abs();
        if near > f64::NEG_INFINITY {
            enter.least = enter.least.max(near - error(near));
            enter.most = enter.most.max(near + error(near));
        }
        if near > enter.t {
            (enter.t, enter.face) = (near, 2 * axis as u32 + u32::from(rising));
        }
        if far < f64::INFINITY {
            leave.least = leave.least.min(far - error(far));
            leave.most = leave.most.min(far + error(far));
        }
        if far < leave.t {
            (leave.t, leave.face) = (far, 2 * axis as u32 + u32::from(!rising));
        }
    }

    #[inline(always)]
    fn slabs(self) -> Option<Slabs> {
        let Self { enter, mut leave } = self;
        // Past all numbers when the ray moves along every slab.
        let met =
            enter.least <= leave.most && enter.t > f64::NEG_INFINITY && leave.t < f64::INFINITY;
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

/// Returns whether a speed cannot be separated from 0, or is too small to count.
#[inline(always)]
fn is_level(speed: f64, speed_error: f64) -> bool {
    speed.abs() <= 4.0 * speed_error || speed.abs() <= LEVEL
}

/// A line relative to a slab: a, v, and the error bound of a.
#[derive(Clone, Copy)]
pub(super) struct Line {
    pub place: f64,
    pub speed: f64,
    pub place_error: f64,
}

impl Line {
    pub fn of(centre: Vector, normal: Vector, half_width: f64, ray: &Ray) -> Self {
        let start = ray.origin - centre;
        let reach = start.x.abs() + start.y.abs() + start.z.abs();
        Self::from(start, reach, centre, normal, half_width, ray.direction)
    }

    #[inline(always)]
    fn from(
        start: Vector,
        reach: f64,
        centre: Vector,
        normal: Vector,
        half_width: f64,
        direction: Vector,
    ) -> Self {
        let far = 2.0 * normal.abs_dot(centre);
        let place_error = U * (6.0 * reach + 3.0 * half_width + far);
        Self { place: normal.dot(start), speed: normal.dot(direction), place_error }
    }
}

/// The slabs that a line is parallel to: within the other slabs, its distance to their planes changes by no
/// more than a few times the error of the planes.
#[derive(Clone, Copy)]
pub(super) struct Along {
    pub axes: [bool; 3],
    /// Range of the line in those slabs for which it is known exactly.
    pub known: [Option<[f64; 2]>; 3],
    /// Middle of the range within the other slabs, ahead of the ray's start: a ray that starts on a face is
    /// clear of it there.
    pub middle: f64,
}

impl Along {
    #[cold]
    #[inline(never)]
    pub fn of(centre: Vector, normals: [Vector; 3], half_widths: [f64; 3], ray: &Ray) -> Self {
        let lines = [0, 1, 2].map(|axis| Line::of(centre, normals[axis], half_widths[axis], ray));
        let (mut enter, mut leave) = (f64::NEG_INFINITY, f64::INFINITY);
        for (line, half_width) in lines.iter().zip(half_widths) {
            if line.speed.abs() > STEEP {
                let (middle, way) = (-line.place / line.speed, half_width / line.speed.abs());
                (enter, leave) = (enter.max(middle - way), leave.min(middle + way));
            }
        }
        let far = enter.abs().max(leave.abs());
        let axes = [0, 1, 2].map(|axis| {
            let Line { speed, place_error, .. } = lines[axis];
            let speed_error = SPEED_ERROR * normals[axis].abs_dot(ray.direction);
            is_level(speed, speed_error) || speed.abs() * far <= 4.0 * place_error
        });
        let middle = 0.5 * (enter.max(0.0) + leave.max(0.0));
        // It has no end where the line is nearly along all three.
        Self { axes, known: [None; 3], middle: if far < f64::INFINITY { middle } else { 0.0 } }
    }
}

/// Speed across a slab below which the error of the speed itself matters.
pub(crate) const STEEP: f64 = 1.0 / 1_048_576.0;
/// Speed up to which a line is parallel to the slab even if it is known exactly, 2⁻¹²⁴: it crosses no slab
/// within a distance that counts.
const LEVEL: f64 = 1.0 / (1_u128 << 124) as f64;
/// Error bound of v.
pub(crate) const SPEED_ERROR: f64 = 10.0 * U;

struct End {
    t: f64,
    least: f64,
    most: f64,
    face: u32,
}

impl End {
    fn crossing(&self) -> Crossing {
        Crossing { t: self.t, error: (self.t - self.least).max(self.most - self.t) }
    }
}
