//! Box: three pairs of parallel faces, |N_i·(P − C)| ≤ l_i. If the normals are not orthogonal, it is a
//! parallelepiped.

pub(super) mod slabs;

use super::slab::{falls_inside, lies_in};
use super::{Bounds, Chord, Ray, Rounding, SurfacePoint, U};
use crate::math::double::{Double, DoubleVector};
use crate::math::placement::Rise;
use crate::math::{AbsDot, UnitVector, Vector};
use slabs::{Along, Slabs, slabs, through, through_steeply};

/// A box. **Invariant:** `half_widths` ≥ 0 (a zero makes a flat sheet); the normals are linearly independent.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Box_ {
    pub centre: Vector,
    /// Outward normals of three faces that share a vertex.
    pub normals: [UnitVector; 3],
    /// Half the distance between each face and the opposite one.
    pub half_widths: [f64; 3],
}

/// One face, in the terms of the seed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Face {
    /// N: unit, outward.
    pub normal: UnitVector,
    /// C_f: the centre of the face.
    pub centre: Vector,
    /// d_f: signed distance of the face's plane from the origin.
    pub distance: f64,
    /// C_o: the centre of the opposite face.
    pub opposite_centre: Vector,
    /// d_o: signed distance of the opposite face's plane (whose normal is −N) from the origin.
    pub opposite_distance: f64,
    /// l: half the distance between the two faces.
    pub half_width: f64,
}

impl Box_ {
    /// Returns the normals. Written out because `map` on an array compiles to a call.
    #[inline(always)]
    fn directions(&self) -> [Vector; 3] {
        let [first, second, third] = self.normals;
        [first.get(), second.get(), third.get()]
    }

    /// Returns whether it has no inside: a line that does not lie in it crosses it at one point.
    pub fn is_flat(&self) -> bool {
        self.half_widths.contains(&0.0)
    }

    #[inline(always)]
    pub fn chord(&self, ray: &Ray) -> Option<Chord> {
        Some(slabs(self.centre, self.directions(), self.half_widths, ray)?.chord())
    }

    /// Returns the chord of a part of a CSG solid. If the line lies in a face, within rounding, and would be
    /// assigned to the other of two solids that touch there, it misses this one.
    #[inline(always)]
    pub fn chord_of_part(&self, ray: &Ray) -> Option<Chord> {
        match through_steeply(self.centre, self.directions(), self.half_widths, ray) {
            Some(slabs) => Some(slabs?.chord()),
            None => {
                let Chord { enter, leave } = self.chord_along(ray)?;
                Some(Chord { enter, leave })
            }
        }
    }

    /// [`Self::chord_of_part`] for a line nearly parallel to a face.
    #[cold]
    #[inline(never)]
    fn chord_along(&self, ray: &Ray) -> Option<Chord> {
        let along = self.along_of_part(ray)?;
        let all = through(self.centre, self.directions(), self.half_widths, ray, Some(along));
        Some(all?.chord())
    }

    /// Returns the slabs that a line is parallel to.
    fn along(&self, ray: &Ray) -> Along {
        Along::of(self.centre, self.directions(), self.half_widths, ray)
    }

    /// Returns [`Self::along`] for a part of a CSG solid; `None` where the line is beside the box.
    #[cold]
    fn along_of_part(&self, ray: &Ray) -> Option<Along> {
        let mut along = self.along(ray);
        for axis in 0..3 {
            // A sheet has a line in it.
            if along.axes[axis] && self.half_widths[axis] > 0.0 {
                along.known[axis] = Some(self.within(axis, ray)?);
            }
        }
        Some(along)
    }

    /// Returns the exact range in which a line nearly parallel to a slab is inside it; for a line in one of
    /// its faces, everything or nothing. `None` where it is outside.
    fn within(&self, axis: usize, ray: &Ray) -> Option<[f64; 2]> {
        let double = DoubleVector::from;
        let mut within = [f64::NEG_INFINITY, f64::INFINITY];
        for outward in [self.normals[axis].get(), -self.normals[axis].get()] {
            let half_width = Double::from(self.half_widths[axis]);
            let distance = double(outward).dot(double(self.centre)) + half_width;
            let rise = Rise::from_plane(outward, distance, ray.origin, ray.direction);
            let is_in = lies_in(&rise, 0.0);
            if is_in && falls_inside(outward) || !is_in && rise.speed == 0.0 && rise.up < 0.0 {
                continue;
            }
            if is_in || rise.speed == 0.0 {
                return None;
            }
            let t = -rise.up / rise.speed;
            match rise.speed > 0.0 {
                true => within[1] = within[1].min(t),
                false => within[0] = within[0].max(t),
            }
        }
        Some(within)
    }

    /// Returns the point where `ray` enters or leaves, projected onto the face that it crosses there.
    ///
    /// Its distance to the face is at most u·(6·|P − C|₁ + 2·l) + u·|N|·|P|. The error counts this twice, the
    /// second time for the start of the next ray, and adds u·(6·|P − C|₁ + 3·l + 2·|N|·|C|) for the
    /// evaluation by `slabs`.
    #[inline(never)]
    pub fn surface(&self, ray: &Ray, t: f64, leaving: bool) -> SurfacePoint {
        let (centre, directions, half_widths) = (self.centre, self.directions(), self.half_widths);
        let end = |slabs: Slabs| match leaving {
            true => (slabs.leave.t, slabs.leave_face),
            false => (slabs.enter.t, slabs.enter_face),
        };
        // 0 where this is no crossing of the box.
        let face = match through_steeply(centre, directions, half_widths, ray) {
            Some(slabs) => slabs.map(end).map_or(0, |(_, face)| face),
            // As it was met: by itself, or as a part.
            None => {
                let off = |(met, _): &(f64, u32)| (met - t).abs();
                let alone = [None, Some(self.along(ray))].into_iter();
                let all = alone.chain(self.along_of_part(ray).map(Some)).filter_map(|along| {
                    through(centre, directions, half_widths, ray, along).map(end)
                });
                all.min_by(|a, b| off(a).total_cmp(&off(b))).map_or(0, |(_, face)| face)
            }
        };
        self.surface_of_face(face, ray, t)
    }

    /// [`Box_::surface`] for a given face.
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

    /// Returns the faces that rounding cannot separate from a point on the box.
    pub fn faces_at(&self, surface: &SurfacePoint) -> impl Iterator<Item = u32> {
        let local = surface.point - self.centre;
        let room = 8.0 * surface.error;
        (0..6).filter(move |face| {
            let (axis, side) = ((face / 2) as usize, if face % 2 == 0 { 1.0 } else { -1.0 });
            let off = side * self.normals[axis].get().dot(local) - self.half_widths[axis];
            off.abs() <= room
        })
    }

    /// Returns the face that `normals[axis]` belongs to, together with the opposite one.
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

    /// Returns the vector from the centre of the box to that of a face: along the edge that is perpendicular
    /// to the other two normals, up to the face's plane.
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

    /// Returns the squared radius, with a small margin, of a sphere around the centre that contains the box.
    pub fn reach_squared(&self) -> f64 {
        let edges = [0, 1, 2].map(|axis| self.face_centre(axis));
        let diagonals = [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)]
            .map(|(b, c)| (edges[0] + edges[1] * b + edges[2] * c).length_squared());
        diagonals.into_iter().fold(0.0, f64::max) * 1.01
    }

    /// Returns whether the ray certainly stays outside of the sphere of [`Box_::reach_squared`]. The closest
    /// approach is off by 3u·A (see [`Ray::slide`]), far less than the margins of 1/100 and 2⁻⁴⁰·A.
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

    /// Returns the minimum of the signed distances to the planes of the six faces, positive inside.
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
