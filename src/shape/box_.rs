//! Box: three pairs of parallel faces, |N_i·(P − C)| ≤ l_i. The normals need not be at right
//! angles: then it is a parallelepiped.

use super::{Bounds, Chord, Crossing, Ray, SurfacePoint, U};
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
    #[inline]
    pub fn chord(&self, ray: &Ray) -> Option<Chord> {
        let slabs = slabs(self.centre, self.normals.map(UnitVector::get), self.half_widths, ray)?;
        Some(Chord { enter: slabs.enter, leave: slabs.leave })
    }

    /// The point where `ray` enters or leaves, put onto the face it crosses there.
    ///
    /// Its distance to the face is at most u·(8·|N|·|P − C| + 2·l) and twice u·|N|·|P|; the same
    /// again is for the start of the next ray and its reading by [`slabs`].
    pub fn surface(&self, ray: &Ray, crossing: &Crossing, leaving: bool) -> SurfacePoint {
        let normals = self.normals.map(UnitVector::get);
        let face = match slabs(self.centre, normals, self.half_widths, ray) {
            Some(slabs) if leaving => slabs.leave_face,
            Some(slabs) => slabs.enter_face,
            None => 0, // Not a crossing of this box.
        };
        let axis = (face / 2) as usize;
        let normal = if face % 2 == 0 { normals[axis] } else { -normals[axis] };
        let half_width = self.half_widths[axis];
        let rough = (ray.origin - self.centre) + ray.direction * crossing.t;
        let local = rough - normal * (normal.dot(rough) - half_width);
        let point = self.centre + local;
        let error =
            U * (16.0 * normal.abs_dot(local) + 4.0 * half_width + 4.0 * normal.abs_dot(point));
        SurfacePoint { point, normal, error, face }
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

    pub fn bounds(&self) -> Bounds {
        let mut extent = Vector::ZERO;
        let mut slack = Vector::ZERO;
        let [a, b, c] = self.normals.map(UnitVector::get);
        // The edges' length, and their error, grow as the normals near one plane.
        let flatness = 1.0 / a.dot(b.cross(c)).abs();
        for axis in 0..3 {
            let edge = self.face_centre(axis).abs();
            extent += edge;
            slack += (edge + Vector::splat(self.half_widths[axis])) * (16.0 * U * flatness);
        }
        Bounds::around(self.centre, extent, slack)
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
/// (l·sgn v − a)/v; a line along a slab (v not to be told
/// from ±0) is in it or misses. Where entry and exit are
/// closer than their errors, at an edge, the line counts as through: boxes that share a face leave
/// no gap between them. An edge belongs to the first of its faces.
///
/// **Error:** that of a plane: a by u·(5·|N|·|f| + 2·l), v by 4u·|N|·|D|.
///
/// **Source:** T. Kay, J. Kajiya, "Ray tracing complex scenes", SIGGRAPH 1986, p. 271.
#[inline]
pub fn slabs<R: Real>(
    centre: R::Vector,
    normals: [R::Vector; 3],
    half_widths: [R; 3],
    ray: &Ray<R>,
) -> Option<Slabs<R>> {
    let number = R::from_f64;
    let u = R::UNIT_ROUNDOFF;
    let start = ray.origin - centre;
    let place_error = |axis: usize| {
        u * (number(5.0) * normals[axis].abs_dot(start) + number(2.0) * half_widths[axis])
    };
    let speed_error = |axis: usize| number(4.0) * u * normals[axis].abs_dot(ray.direction);
    // No `speed_error` is more.
    let parallel = number(8.0) * u;
    let (mut enter, mut leave) = (R::NEG_INFINITY, R::INFINITY);
    let (mut enter_axis, mut leave_axis) = (0, 0);
    let mut speeds = [R::ZERO; 3];
    for axis in 0..3 {
        let place = normals[axis].dot(start);
        let speed = normals[axis].dot(ray.direction);
        let half_width = half_widths[axis];
        speeds[axis] = speed;
        if speed.abs() <= parallel && speed.abs() <= speed_error(axis) {
            if place.abs() - half_width > place_error(axis) {
                return None;
            }
            continue;
        }
        let side = if speed < R::ZERO { -half_width } else { half_width };
        let (near, far) = ((-side - place) / speed, (side - place) / speed);
        if near > enter {
            (enter, enter_axis) = (near, axis);
        }
        if far < leave {
            (leave, leave_axis) = (far, axis);
        }
    }
    let crossing = |t: R, axis: usize| {
        Crossing::at_quotient(t, place_error(axis), speeds[axis], speed_error(axis))
    };
    if enter == R::NEG_INFINITY || leave == R::INFINITY || enter == R::INFINITY {
        // Only a ray along every slab, or whose crossings are past all numbers.
        return None;
    }
    let entering = crossing(enter, enter_axis);
    let mut leaving = crossing(leave, leave_axis);
    if enter > leave {
        if enter - leave > entering.error + leaving.error {
            return None;
        }
        leaving = Crossing { t: enter, error: entering.error + leaving.error };
    }
    let face = |axis: usize, outward: bool| 2 * axis as u32 + u32::from(!outward);
    Some(Slabs {
        enter: entering,
        leave: leaving,
        enter_face: face(enter_axis, speeds[enter_axis] < R::ZERO),
        leave_face: face(leave_axis, speeds[leave_axis] > R::ZERO),
    })
}
