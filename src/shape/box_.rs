//! Box: three pairs of parallel faces, |N_i·(P − C)| ≤ l_i. The normals need not be at right
//! angles: then it is a parallelepiped.

use super::slab::falls_inside;
use super::{Bounds, Chord, Crossing, Ray, Rounding, SurfacePoint, U};
use crate::math::{Real, UnitVector, Vector, Vector3};

/// **Invariant:** `half_widths` ≥ 0 (a zero makes a flat sheet); the normals are independent.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Box_ {
    pub centre: Vector,
    /// Outward normals of three faces that share a vertex.
    pub normals: [UnitVector; 3],
    /// Half the distance between each face and its opposite.
    pub half_widths: [f64; 3],
}

/// One face in the seed's terms.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Face {
    /// N: unit, outward.
    pub normal: UnitVector,
    /// C_f: the face's centre.
    pub centre: Vector,
    /// d_f: signed distance of the face's plane to the origin.
    pub distance: f64,
    /// C_o: centre of the opposite face.
    pub opposite_centre: Vector,
    /// d_o: signed distance of the opposite face's plane (whose normal is −N) to the origin.
    pub opposite_distance: f64,
    /// l: half the distance between the two faces.
    pub half_width: f64,
}

impl Box_ {
    /// The normals. Written out, as `map` on an array is a call.
    #[inline(always)]
    fn directions(&self) -> [Vector; 3] {
        let [first, second, third] = self.normals;
        [first.get(), second.get(), third.get()]
    }

    /// It has no inside: a line that does not lie in it meets it in one place.
    pub fn is_flat(&self) -> bool {
        self.half_widths.contains(&0.0)
    }

    #[inline(always)]
    pub fn chord(&self, ray: &Ray) -> Option<Chord> {
        let slabs = slabs(self.centre, self.directions(), self.half_widths, ray)?;
        Some(Chord { enter: slabs.enter, leave: slabs.leave })
    }

    /// As of a part of a whole: a line in a face, as far as rounding tells, that of two solids which touch there
    /// is the other's, misses it.
    #[inline(always)]
    pub fn chord_of_part(&self, ray: &Ray) -> Option<Chord> {
        self.chord(ray).filter(|_| !self.yields(ray))
    }

    #[inline(always)]
    fn yields(&self, ray: &Ray) -> bool {
        let is_along = |normal: Vector| normal.dot(ray.direction).abs() <= STEEP;
        self.directions().into_iter().any(is_along) && self.yields_face(ray)
    }

    /// **Error:** as of [`slabs`]. Nothing that starts from the surface is so near to a face.
    #[cold]
    fn yields_face(&self, ray: &Ray) -> bool {
        let along = Along::of(self.centre, self.directions(), self.half_widths, ray);
        (0..3).any(|axis| {
            let normal = self.normals[axis].get();
            let line = Line::of(self.centre, normal, self.half_widths[axis], ray);
            let place = line.place + line.speed * along.middle;
            let is_near = (place.abs() - self.half_widths[axis]).abs() <= line.place_error;
            let is_sheet = self.half_widths[axis] == 0.0;
            along.axes[axis] && !is_sheet && is_near && !falls_inside(normal * place.signum())
        })
    }

    /// The point where `ray` enters or leaves, put onto the face it crosses there.
    ///
    /// Its distance to the face is at most u·(6·|P − C|₁ + 2·l) and u·|N|·|P|; the same again is
    /// for the start of the next ray, and u·(6·|P − C|₁ + 3·l + 2·|N|·|C|) for its reading by [`slabs`].
    #[inline(never)]
    pub fn surface(&self, ray: &Ray, t: f64, leaving: bool) -> SurfacePoint {
        let face = match slabs(self.centre, self.directions(), self.half_widths, ray) {
            Some(slabs) if leaving => slabs.leave_face,
            Some(slabs) => slabs.enter_face,
            None => 0, // Not a crossing of this box.
        };
        self.surface_of_face(face, ray, t)
    }

    /// As [`Box_::surface`], on a face that is given.
    pub fn surface_of_face(&self, face: u32, ray: &Ray, t: f64) -> SurfacePoint {
        let normals = self.directions();
        let axis = (face / 2) as usize;
        let normal = if face.is_multiple_of(2) { normals[axis] } else { -normals[axis] };
        let half_width = self.half_widths[axis];
        let rough = (ray.origin - self.centre) + ray.direction * t;
        let local = rough - normal * (normal.dot(rough) - half_width);
        let point = self.centre + local;
        let reach = local.abs().element_sum();
        let far = 2.0 * (normal.abs_dot(self.centre) + normal.abs_dot(point));
        let error = U * (24.0 * reach + 12.0 * half_width + far);
        SurfacePoint { point, normal, error, face }
    }

    /// Those of its faces that a point on it cannot be told from.
    pub fn faces_at(&self, surface: &SurfacePoint) -> impl Iterator<Item = u32> {
        let local = surface.point - self.centre;
        let room = 8.0 * surface.error;
        (0..6).filter(move |face| {
            let (axis, side) = ((face / 2) as usize, if face % 2 == 0 { 1.0 } else { -1.0 });
            let off = side * self.normals[axis].get().dot(local) - self.half_widths[axis];
            off.abs() <= room
        })
    }

    /// One of the three faces `normals` belong to, and with it the opposite one.
    pub fn face(&self, axis: usize) -> Face {
        let normal = self.normals[axis];
        let to_face = self.face_centre(axis);
        let half_width = self.half_widths[axis];
        let centre_distance = normal.get().dot(self.centre);
        Face {
            normal,
            centre: self.centre + to_face,
            distance: half_width + centre_distance,
            opposite_centre: self.centre - to_face,
            opposite_distance: half_width - centre_distance,
            half_width,
        }
    }

    /// From the centre of the box to that of a face: along the edge that the other two normals
    /// leave free, as far as the face's plane.
    fn face_centre(&self, axis: usize) -> Vector {
        let [n, next, last] = [0, 1, 2].map(|step| self.normals[(axis + step) % 3].get());
        let edge = next.cross(last);
        edge * (self.half_widths[axis] / n.dot(edge))
    }

    pub fn corners(&self) -> [Vector; 8] {
        let edges = [0, 1, 2].map(|axis| self.face_centre(axis));
        std::array::from_fn(|corner| {
            (0..3).fold(self.centre, |sum, axis| {
                if corner >> axis & 1 == 1 { sum + edges[axis] } else { sum - edges[axis] }
            })
        })
    }

    /// The square of a radius about the centre within which the box is, with a little to spare.
    pub fn reach_squared(&self) -> f64 {
        let edges = [0, 1, 2].map(|axis| self.face_centre(axis));
        let diagonals = [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)]
            .map(|(b, c)| (edges[0] + edges[1] * b + edges[2] * c).length_squared());
        diagonals.into_iter().fold(0.0, f64::max) * 1.01
    }

    /// Whether the ray certainly stays outside of the ball of [`Box_::reach_squared`]. The closest
    /// approach is off by 3u·A (see [`Ray::slide`]), far less than the spare hundredth and 2⁻⁴⁰·A.
    #[inline(always)]
    pub fn is_out_of_reach(&self, reach_squared: f64, ray: &Ray) -> bool {
        let near = ray.slide(self.centre);
        let behind = near.along > 0.0 && near.start.length_squared() > reach_squared;
        let blur = near.along * (1.0 / (1u64 << 40) as f64);
        behind || near.offset.length_squared() > reach_squared + blur * blur
    }

    pub fn bounds(&self, rounding: Rounding) -> Bounds {
        let mut extent = Vector::ZERO;
        let mut slack = Vector::ZERO;
        let [a, b, c] = self.normals.map(UnitVector::get);
        // The edges' length, and their error, grow as the normals near one plane.
        let flatness = 1.0 / a.dot(b.cross(c)).abs();
        for axis in 0..3 {
            let edge = self.face_centre(axis).abs();
            extent += edge;
            let far = self.normals[axis].get().abs_dot(self.centre);
            slack += (edge + Vector::splat(self.half_widths[axis] + far)) * (16.0 * U * flatness);
        }
        Bounds::around(self.centre, [-extent, extent], slack, rounding)
    }

    /// Positive inside: the least of the distances to the six faces' planes.
    pub fn signed_distance(&self, point: Vector) -> f64 {
        let local = point - self.centre;
        (0..3).fold(f64::INFINITY, |least, axis| {
            least.min(self.half_widths[axis] - self.normals[axis].get().dot(local).abs())
        })
    }

    pub fn contains(&self, point: Vector) -> bool {
        self.signed_distance(point) > 0.0
    }
}

/// The part of a line inside all three slabs, and the faces where it enters and leaves.
#[derive(Debug, Clone, Copy)]
pub struct Slabs<R: Real = f64> {
    pub enter: Crossing<R>,
    pub leave: Crossing<R>,
    /// As in [`SurfacePoint::face`].
    pub enter_face: u32,
    pub leave_face: u32,
}

/// A line through three slabs; `None` when it misses their common part.
///
/// With f = S − C, a = N·f, v = N·D a slab is entered at (−l·sgn v − a)/v and left at
/// (l·sgn v − a)/v; a line along a slab (v = ±0, or not to be told from it over its way through the
/// others) is in it or misses. The box is entered where the last slab is, left where the first is;
/// where these are closer than their errors, at an edge, the line counts as through: boxes that
/// share a face leave no gap between them. An edge belongs to the first of its faces.
///
/// **Error:** a is off by u·(5·|f|₁ + l), and by u·|N|·|C| from the face that was meant, as C was
/// rounded: faces that two boxes share are one. v is off by 6u·|N|·|D| ≤ 6u, and 1/v, the difference
/// and the product are rounded; so t by e(t) = (u·(6·|f|₁ + 3·l + 2·|N|·|C|) + 10u·|t|) / |v|. The last
/// entry lies between the greatest t − e(t) and the greatest t + e(t), of all three slabs.
///
/// **Source:** T. Kay, J. Kajiya, "Ray tracing complex scenes", SIGGRAPH 1986, p. 271.
#[inline(always)]
pub fn slabs<R: Real>(
    centre: R::Vector,
    normals: [R::Vector; 3],
    half_widths: [R; 3],
    ray: &Ray<R>,
) -> Option<Slabs<R>> {
    let (found, is_flat) = through(centre, normals, half_widths, ray, None)?;
    if is_flat { through_along(centre, normals, half_widths, ray) } else { Some(found) }
}

/// Of a line that may go along a slab, which cannot be told from its speed alone.
#[cold]
#[inline(never)]
fn through_along<R: Real>(
    centre: R::Vector,
    normals: [R::Vector; 3],
    half_widths: [R; 3],
    ray: &Ray<R>,
) -> Option<Slabs<R>> {
    let along = Along::of(centre, normals, half_widths, ray);
    Some(through(centre, normals, half_widths, ray, Some(along))?.0)
}

/// The line's part in all slabs, and whether it is nearly along one that it is not known to go along.
#[inline(always)]
fn through<R: Real>(
    centre: R::Vector,
    normals: [R::Vector; 3],
    half_widths: [R; 3],
    ray: &Ray<R>,
    along: Option<Along<R>>,
) -> Option<(Slabs<R>, bool)> {
    let number = R::from_f64;
    let start = ray.origin - centre;
    let reach = start.component(0).abs() + start.component(1).abs() + start.component(2).abs();
    let mut enter =
        End { t: R::NEG_INFINITY, least: R::NEG_INFINITY, most: R::NEG_INFINITY, face: 0 };
    let mut leave = End { t: R::INFINITY, least: R::INFINITY, most: R::INFINITY, face: 0 };
    let mut is_flat = false;
    for axis in 0..3 {
        let half_width = half_widths[axis];
        let Line { place, speed, place_error } =
            Line::from(start, reach, centre, normals[axis], half_width, ray.direction);
        let mut speed_error = number(10.0) * R::UNIT_ROUNDOFF;
        if speed.abs() <= number(STEEP) {
            // A normal along an axis has an exact speed, however small.
            speed_error = speed_error * normals[axis].abs_dot(ray.direction);
            let middle = match along {
                Some(along) if along.axes[axis] => Some(along.middle),
                _ if is_level(speed, speed_error) => Some(R::ZERO),
                _ => None,
            };
            if let Some(middle) = middle {
                if (place + speed * middle).abs() - half_width > place_error {
                    return None;
                }
                continue;
            }
            is_flat = true;
        }
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
    // Past all numbers when the ray moves along every slab.
    let met = enter.least <= leave.most && enter.t > R::NEG_INFINITY && leave.t < R::INFINITY;
    if !met {
        return None;
    }
    leave.t = leave.t.max(enter.t);
    let slabs = Slabs {
        enter: enter.crossing(),
        leave: leave.crossing(),
        enter_face: enter.face,
        leave_face: leave.face,
    };
    Some((slabs, is_flat))
}

/// Whether a speed cannot be told from 0, or has no reciprocal.
#[inline(always)]
fn is_level<R: Real>(speed: R, speed_error: R) -> bool {
    speed.abs() <= R::from_f64(4.0) * speed_error || speed.abs() <= R::from_f64(LEVEL)
}

/// A line as a slab sees it: a, v, and how far a may be off.
#[derive(Clone, Copy)]
struct Line<R: Real> {
    place: R,
    speed: R,
    place_error: R,
}

impl<R: Real> Line<R> {
    fn of(centre: R::Vector, normal: R::Vector, half_width: R, ray: &Ray<R>) -> Self {
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

/// The slabs that a line goes along: over all of its way through the others it comes no farther from their
/// planes than a few times what these may be off.
#[derive(Clone, Copy)]
struct Along<R: Real> {
    axes: [bool; 3],
    /// The middle of that way, ahead of the ray's start: what leaves a face is off it there.
    middle: R,
}

impl<R: Real> Along<R> {
    #[cold]
    #[inline(never)]
    fn of(centre: R::Vector, normals: [R::Vector; 3], half_widths: [R; 3], ray: &Ray<R>) -> Self {
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
            let speed_error =
                number(10.0) * R::UNIT_ROUNDOFF * normals[axis].abs_dot(ray.direction);
            is_level(speed, speed_error) || speed.abs() * far <= number(4.0) * place_error
        });
        Self { axes, middle: number(0.5) * (enter.max(R::ZERO) + leave.max(R::ZERO)) }
    }
}

/// Slower than this a ray moves so nearly along a slab that its speed's own error counts.
const STEEP: f64 = 1.0 / 1_048_576.0;
/// Slower than this a ray is along the slab: the speed has no reciprocal.
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
