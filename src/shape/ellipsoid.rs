//! Ellipsoid: the unit sphere under an affine map that does not preserve spheres, |L·(P − C)| = 1, L the
//! placement's `local_from_world`.

use super::sphere::{Blur, Roots};
use super::{Bounds, Chord, Ray, Rounding, SurfacePoint, U};
use crate::math::placement::Placement;
use crate::math::{AbsDot, Vector};

/// The unit sphere under an affine map.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ellipsoid {
    pub placement: Placement,
}

impl Ellipsoid {
    /// Returns the chord, computed in local space, where the solid is the unit sphere. The ray's origin moves
    /// to the closest approach there, not in world space: the closest approach to the centre of a needle may
    /// be a million times as far off as the needle.
    ///
    /// **Error:** that of the sphere, plus what the map adds (`blur`). With |L| the matrix of absolute
    /// values, R = ‖|L|·|f|‖, κ = ‖|L|·|D|‖ / |L·D|, b and m those of the sphere: u·(6R + 6κ·|b|) across the
    /// ray, u·(6R + 6κ·(|b| + m)) along it, 12u·R·|L·f| of |L·f|² − 1, and 6u·κ of every t.
    #[inline(never)]
    pub fn chord(&self, ray: &Ray) -> Option<Chord> {
        let matrix = self.placement.local_from_world;
        let sizes = matrix.abs();
        let from_centre = ray.origin - self.placement.centre;

        let start = matrix * from_centre;
        let step = matrix * ray.direction;
        let speed = step.length();
        let direction = step / speed;
        let along = start.dot(direction);
        let miss = (start - direction * along).length();

        let reach = (sizes * from_centre.abs()).length();
        let turn = (sizes * ray.direction.abs()).length() / speed;
        let blur = Blur {
            miss: U * (6.0 * reach + 6.0 * turn * along.abs()),
            along: U * (6.0 * reach + 6.0 * turn * (along.abs() + miss)),
            power: U * 12.0 * reach * start.length(),
            scale: U * 6.0 * turn,
        };
        let roots = Roots::solve(along, miss, 1.0, start.length_squared(), 1.0 / speed)?;
        Some(roots.blurred_chord(blur))
    }

    /// Returns the point where `ray` crosses the ellipsoid at `t`; the residual of |L·(P − C)| − 1 is
    /// subtracted along the normal, which is the shortest path in world space. The error bound is the
    /// remaining residual plus the rounding of this sum.
    #[inline(never)]
    pub fn surface(&self, ray: &Ray, t: f64) -> SurfacePoint {
        let Placement { centre, local_from_world, .. } = self.placement;
        let local = |point: Vector| {
            let local = local_from_world * (point - centre);
            let length = local.length();
            // Out of the solid, and as long as what is left changes with the distance.
            (length - 1.0, local_from_world.transpose() * local.normalize_or(Vector::X))
        };
        let rough = ray.at(t);
        let (rest, gradient) = local(rough);
        let point = rough - gradient * (rest / gradient.length_squared());
        let (rest, gradient) = local(point);
        let steepness = gradient.length();
        let normal = gradient / steepness;
        let reach = (local_from_world.abs() * (point - centre).abs()).length();
        let error =
            (rest.abs() + U * (24.0 * reach + 12.0)) / steepness + 2.0 * U * normal.abs_dot(point);
        SurfacePoint { point, normal, error, face: 0 }
    }

    /// Returns the bounds; along each axis, half their size is the length of that row of `world_from_local`.
    pub fn bounds(&self, rounding: Rounding) -> Bounds {
        let Placement { centre, world_from_local, .. } = self.placement;
        let rows = world_from_local.transpose();
        let extent = Vector::new(rows.x_axis.length(), rows.y_axis.length(), rows.z_axis.length());
        let slack = extent * (32.0 * U * self.placement.condition());
        Bounds::around(centre, [-extent, extent], slack, rounding)
    }

    /// Returns 1 − |L·(P − C)|, in units of the local sphere: positive inside, zero on the surface.
    pub fn signed_distance(&self, point: Vector) -> f64 {
        1.0 - self.placement.local_point(point).length()
    }

    pub fn contains(&self, point: Vector) -> bool {
        self.signed_distance(point) > 0.0
    }
}
