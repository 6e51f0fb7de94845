//! Plane: N·P = d; the inside is the half-space N·P < d, and N points outward.

use super::slab::{falls_inside, lies_in};
use super::{Bounds, Chord, Crossing, Ray, Rounding, SurfacePoint, U};
use crate::math::placement::Rise;
use crate::math::{AbsDot, UnitVector, Vector};

/// N·P = d; the inside is the half-space N·P < d.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane {
    pub normal: UnitVector,
    /// Signed: positive exactly when the origin is inside.
    pub distance: f64,
}

impl Plane {
    /// Returns the part of the ray's line inside the half-space: from −∞, to +∞, or both if the line is
    /// parallel and inside (v is 0 within its error, or the crossing overflows). Outside, the line misses; a
    /// line in the plane is inside exactly one of the two half-spaces.
    ///
    /// t = a / v with a = d − N·S, v = N·D. **Error:** a is off by α = u·(4·|N|·|S| + 2·|d|) and v by ν =
    /// 6u·|N|·|D| (sums of absolute products: a normal along an axis loses nothing), so t is off by (α +
    /// |t|·ν) / (|v| − ν) + 2u·|t|.
    ///
    /// **Source:** γₙ bounds: Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed., §3.1.
    #[inline]
    pub fn chord(&self, ray: &Ray) -> Option<Chord> {
        let normal = self.normal.get();
        let inside = self.signed_distance(ray.origin);
        let speed = normal.dot(ray.direction);
        let speed_error = 6.0 * U * normal.abs_dot(ray.direction);
        let t = inside / speed;
        if speed.abs() <= speed_error || t.abs() == f64::INFINITY {
            // Of two that share the plane, one has what lies in it.
            let is_inside = inside > 0.0 || inside == 0.0 && falls_inside(normal);
            return is_inside.then_some(Chord::WHOLE);
        }
        let inside_error = U * (4.0 * normal.abs_dot(ray.origin) + 2.0 * self.distance.abs());
        let error = (inside_error + t.abs() * speed_error) / (speed.abs() - speed_error)
            + 2.0 * U * t.abs();
        let crossing = Crossing { t, error };
        Some(if speed < 0.0 {
            Chord { enter: crossing, leave: Crossing::BEYOND_ALL }
        } else {
            Chord { enter: Crossing::BEFORE_ALL, leave: crossing }
        })
    }

    /// Returns the chord of a part of a CSG solid. If two parts share the plane and the line lies in it,
    /// within rounding near the ray's start and the origin, exactly one of them contains the line.
    #[inline(always)]
    pub fn chord_of_part(&self, ray: &Ray) -> Option<Chord> {
        let speed = self.normal.get().dot(ray.direction);
        match speed.abs() <= NEARLY_ALONG {
            true => self.chord_along(ray),
            false => self.chord(ray),
        }
    }

    /// Returns the chord of a line nearly parallel to the plane.
    ///
    /// **Error:** as for [`Plane::chord`]. A line that leaves the plane at such a small slope may be classified
    /// as lying in it: it contributes no light.
    #[cold]
    fn chord_along(&self, ray: &Ray) -> Option<Chord> {
        let normal = self.normal.get();
        let rise = Rise::from_plane(normal, self.distance.into(), ray.origin, ray.direction);
        if lies_in(&rise, 0.0) {
            return falls_inside(normal).then_some(Chord::WHOLE);
        }
        self.chord(ray)
    }

    /// Returns whether the ray moves toward the plane.
    #[inline(always)]
    pub fn is_ahead(&self, ray: &Ray) -> bool {
        self.signed_distance(ray.origin) * self.normal.get().dot(ray.direction) > 0.0
    }

    /// Returns N·D and the t of the crossing, for a ray that moves toward the plane.
    #[inline(always)]
    pub fn pass(&self, ray: &Ray) -> Option<(f64, f64)> {
        let speed = self.normal.get().dot(ray.direction);
        self.is_ahead(ray).then(|| (speed, self.signed_distance(ray.origin) / speed))
    }

    /// Returns the crossing at `t` with a cheap error bound that is larger than that of [`Plane::chord`];
    /// `None` where it would not be a bound. With |v| > 2⁻¹⁰ and |S|₁ + |d| < 2¹⁴·t, the bound of
    /// [`Plane::chord`] is below 2⁻²⁶·t.
    #[inline(always)]
    pub fn roughly(&self, ray: &Ray, speed: f64, t: f64) -> Option<Crossing> {
        let size = ray.origin.abs().element_sum() + self.distance.abs();
        let steep = speed.abs() > 1.0 / 1024.0;
        let near = size < t * 16_384.0;
        (steep && near).then_some(Crossing { t, error: t / 67_108_864.0 })
    }

    /// Returns the point where `ray` crosses the plane at `t`; the residual of N·P − d is subtracted along N.
    ///
    /// Its distance to the plane is at most 4u·|N|·|P| + u·|d|: N·P is evaluated twice, here and by the next
    /// [`Plane::chord`], and each of the two sums that round P adds u·|N|·|P|.
    #[inline(always)]
    pub fn surface(&self, ray: &Ray, t: f64) -> SurfacePoint {
        let normal = self.normal.get();
        let rough = ray.at(t);
        let point = rough - normal * (normal.dot(rough) - self.distance);
        let error = U * (12.0 * normal.abs_dot(point) + 4.0 * self.distance.abs());
        SurfacePoint { point, normal, error, face: 0 }
    }

    /// Returns the complement of the half-space.
    pub fn complement(&self) -> Self {
        Self { normal: -self.normal, distance: -self.distance }
    }

    /// Returns the bounds. Where the normal is along an axis, the half-space ends at the plane, on one side
    /// of that axis: a point's coordinate in the plane is rounded by at most one or two steps.
    pub fn bounds(&self, rounding: Rounding) -> Bounds {
        let (normal, mut bounds) = (self.normal.get(), Bounds::EVERYWHERE);
        let axes = [Vector::X, Vector::Y, Vector::Z];
        if let Some(axis) = axes.iter().position(|axis| normal.abs() == *axis) {
            let place = Vector::splat(self.distance * normal[axis]);
            let ends = Bounds::around(place, [Vector::ZERO; 2], Vector::ZERO, rounding);
            match normal[axis] > 0.0 {
                true => bounds.high[axis] = ends.high[axis],
                false => bounds.low[axis] = ends.low[axis],
            }
        }
        bounds
    }

    /// Returns d − N·P, positive inside.
    #[inline]
    pub fn signed_distance(&self, point: Vector) -> f64 {
        self.distance - self.normal.get().dot(point)
    }

    pub fn contains(&self, point: Vector) -> bool {
        self.signed_distance(point) > 0.0
    }
}

/// Speed toward the plane up to which a ray counts as nearly parallel.
const NEARLY_ALONG: f64 = 1.0 / 1_048_576.0;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_half_space_ends_where_its_plane_lies_across_an_axis() {
        let half = |x: f64, y: f64, z: f64, distance: f64| {
            let normal = UnitVector::from_unit(Vector::new(x, y, z));
            Plane { normal, distance }.bounds(Rounding::Nearest)
        };
        let below = half(0.0, 1.0, -0.0, 2.0);
        assert_eq!(below, Bounds { high: Bounds::EVERYWHERE.high.with_y(2.0), ..below });
        assert_eq!(below.low, Bounds::EVERYWHERE.low);
        let above = half(0.0, 0.0, -1.0, 3.0);
        assert_eq!(above, Bounds { low: Bounds::EVERYWHERE.low.with_z(-3.0), ..above });
        assert_eq!(above.high, Bounds::EVERYWHERE.high);
        // The second is 1 long, as far as numbers tell.
        for askew in [half(0.6, 0.8, 0.0, 1.0), half(1.0, 1e-9, 0.0, 1.0)] {
            assert_eq!(askew, Bounds::EVERYWHERE);
        }
    }
}
