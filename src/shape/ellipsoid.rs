//! Ellipsoid: the unit sphere under an affine map that keeps no sphere: |L·(P − C)| = 1, L the
//! placement's `local_from_world`.

use super::sphere::{Blur, Roots};
use super::{Bounds, Chord, Ray, SurfacePoint, U};
use crate::math::placement::Placement;
use crate::math::{Matrix, Vector, Vector3};

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ellipsoid {
    pub placement: Placement,
}

impl Ellipsoid {
    /// The chord, in local space, where the solid is the unit sphere; the ray is slid twice: in the
    /// world, where a far start costs no digits, and again there, where the two closest approaches
    /// differ. **Error:** that of the sphere, and what the map adds (`blur`), with |L| the matrix
    /// of absolute values and R = ‖|L|·(|f| + |b|·|D|)‖, κ = ‖|L|·|D|‖ / |L·D|: u·(8R + 4κ·(1 + |b|))
    /// across the ray, u·(8R + 5κ·|b|) along it, 12u·R·|L·f| of |L·f|² − 1, and 5u·κ of every t.
    pub fn chord(&self, ray: &Ray) -> Option<Chord> {
        let matrix = self.placement.local_from_world;
        let sizes = matrix.abs();
        let world = ray.slide(self.placement.centre);

        let offset = matrix * world.offset;
        let step = matrix * ray.direction;
        let speed = step.length();
        let direction = step / speed;
        let again = offset.dot(direction);
        let miss = (offset - direction * again).length();
        let along = world.along * speed + again;
        let start = matrix * world.start;

        let reach =
            (sizes * (world.start.abs() + ray.direction.abs() * world.along.abs())).length();
        let turn = (sizes * ray.direction.abs()).length() / speed;
        let blur = Blur {
            miss: U * (8.0 * reach + 4.0 * turn * (1.0 + again.abs())),
            along: U * (8.0 * reach + 5.0 * turn * along.abs()),
            power: U * 12.0 * reach * start.length(),
            scale: U * 5.0 * turn,
        };
        let roots = Roots::solve(along, miss, 1.0, start.length_squared(), 1.0 / speed)?;
        Some(roots.blurred_chord(blur))
    }

    /// The point of the ellipsoid where `ray` crosses it at `t`; its distance is bounded by what
    /// is left of |L·(P − C)| − 1 there and the rounding of that very sum.
    pub fn surface(&self, ray: &Ray, t: f64) -> SurfacePoint {
        let Placement { centre, world_from_local, local_from_world } = self.placement;
        let near = ray.slide(centre);
        let rough = local_from_world * (near.offset + ray.direction * (t + near.along));
        let local = rough.normalize_or(Vector::X);
        let gradient = local_from_world.transpose() * local;
        let steepness = gradient.length();
        let normal = gradient / steepness;
        let point = world_from_local * local + centre;
        let from_centre = point - centre;
        let rest = ((local_from_world * from_centre).length() - 1.0).abs();
        let reach = (local_from_world.abs() * from_centre.abs()).length();
        let error =
            (rest + U * (24.0 * reach + 12.0)) / steepness + 2.0 * U * normal.abs_dot(point);
        SurfacePoint { point, normal, error, face: 0 }
    }

    /// Along each axis the length of that row of `world_from_local`.
    pub fn bounds(&self) -> Bounds {
        let Placement { centre, world_from_local, local_from_world } = self.placement;
        let rows = world_from_local.transpose();
        let extent = Vector::new(rows.x_axis.length(), rows.y_axis.length(), rows.z_axis.length());
        // How far the two matrices may be from undoing each other.
        let condition = norm(world_from_local) * norm(local_from_world);
        Bounds::around(centre, extent, extent * (32.0 * U * condition))
    }

    /// Positive inside, zero on the surface, in units of the local sphere: 1 − |L·(P − C)|.
    pub fn signed_distance(&self, point: Vector) -> f64 {
        1.0 - self.placement.local_point(point).length()
    }

    pub fn contains(&self, point: Vector) -> bool {
        self.signed_distance(point) > 0.0
    }
}

/// The Frobenius norm.
fn norm(matrix: Matrix) -> f64 {
    let Matrix { x_axis, y_axis, z_axis } = matrix;
    (x_axis.length_squared() + y_axis.length_squared() + z_axis.length_squared()).sqrt()
}
