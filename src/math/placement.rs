//! Affine maps in the form in which they are applied: subtract the centre, then multiply.
//!
//! **Invariant:** every [`Placement`] is invertible, and its two matrices are inverses within rounding.

use super::double::{Double, DoubleVector};
use super::{Matrix, Vector, reciprocal_power_of_two};

/// The map `p ↦ matrix · (p − centre)`.
///
/// Subtracting first preserves the digits of distant objects: for an ellipsoid 10⁶ units from the origin, the
/// relative error of t is 3e-15, compared with 4e-11 for a 4×4 matrix.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Map {
    pub centre: Vector,
    pub matrix: Matrix,
    /// The inverse transpose of the matrix, which maps normals.
    pub normals: Matrix,
}

impl Map {
    pub const IDENTITY: Self =
        Self { centre: Vector::ZERO, matrix: Matrix::IDENTITY, normals: Matrix::IDENTITY };

    pub fn new(centre: Vector, matrix: Matrix) -> Self {
        Self { centre, matrix, normals: matrix.inverse().transpose() }
    }

    #[inline]
    pub fn point(&self, p: Vector) -> Vector {
        self.matrix * (p - self.centre)
    }

    #[inline]
    pub fn direction(&self, d: Vector) -> Vector {
        self.matrix * d
    }

    /// Returns the error of [`Map::point`] for `p` along each axis, given the error of `p`.
    ///
    /// With M the matrix and c the centre: |M|·(error + u·|c| + u·|p − c|) for the input, the rounding of the
    /// centre and that of the difference, plus 4u·|M|·|p − c| for the matrix and the sums.
    pub fn point_error(&self, p: Vector, error: Vector) -> Vector {
        let centre = self.centre.abs() * f64::EPSILON;
        let difference = (p - self.centre).abs() * (4.0 * f64::EPSILON);
        let [x, y, z] =
            [self.matrix.x_axis, self.matrix.y_axis, self.matrix.z_axis].map(Vector::abs);
        Matrix::from_cols(x, y, z) * (error + centre + difference)
    }
}

impl Default for Map {
    fn default() -> Self {
        Self::IDENTITY
    }
}

/// The placement of a local space in world space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placement {
    /// The local origin in world space.
    pub centre: Vector,
    pub world_from_local: Matrix,
    pub local_from_world: Matrix,
}

impl Placement {
    #[inline]
    pub fn local_point(&self, world: Vector) -> Vector {
        self.local_from_world * (world - self.centre)
    }

    #[inline]
    pub fn local_direction(&self, world: Vector) -> Vector {
        self.local_from_world * world
    }

    #[inline]
    pub fn world_point(&self, local: Vector) -> Vector {
        self.world_from_local * local + self.centre
    }

    /// Returns the normal in world space, not normalized, by the inverse transpose.
    #[inline]
    pub fn world_normal(&self, local: Vector) -> Vector {
        self.local_from_world.transpose() * local
    }

    /// Returns the condition number in the Frobenius norm: the number of roundings by which the two matrices
    /// may fail to be inverses.
    pub fn condition(&self) -> f64 {
        norm(self.world_from_local) * norm(self.local_from_world)
    }
}

/// Returns the Frobenius norm.
pub(crate) fn norm(Matrix { x_axis, y_axis, z_axis }: Matrix) -> f64 {
    (x_axis.length_squared() + y_axis.length_squared() + z_axis.length_squared()).sqrt()
}

/// A line relative to a plane: either perpendicular to a local axis, in lengths along that axis, or in world
/// space.
#[doc(hidden)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rise {
    /// Height of its start above the plane.
    pub up: f64,
    /// Rise per unit length of the ray.
    pub speed: f64,
    /// Upper bound on the terms of `up`, along the plane's normal: the start, and the distance of the plane
    /// from 0. It is the same for all bodies that share the plane.
    pub up_size: f64,
    /// The same for `speed`.
    pub speed_size: f64,
}

impl Rise {
    /// Returns the exact position relative to the plane normal·P = distance.
    pub(crate) fn from_plane(
        normal: Vector,
        distance: Double,
        origin: Vector,
        direction: Vector,
    ) -> Self {
        let normal = DoubleVector::from(normal);
        let up = normal.dot(origin.into()) - distance;
        Self::along(normal, (up, distance.round()), origin, direction)
    }

    /// Returns the position of a line that starts `up` along a normal from a plane at `distance` from 0.
    fn along(
        normal: DoubleVector,
        (up, distance): (Double, f64),
        origin: Vector,
        direction: Vector,
    ) -> Self {
        let greatest = origin.abs().max_element().max(distance.abs());
        let size = |greatest: f64| normal.round().abs().element_sum() * greatest;
        Self {
            up: up.round(),
            speed: normal.dot(direction.into()).round(),
            up_size: size(greatest),
            speed_size: size(direction.abs().max_element()),
        }
    }
}

/// The placement of a local space in world space, to 106 bits: points of two such spaces that coincide in
/// world space are bit-identical.
#[doc(hidden)]
#[derive(Debug, Clone, PartialEq)]
pub struct ExactPlacement {
    /// The rows of `world_from_local`.
    pub rows: [DoubleVector; 3],
    pub centre: DoubleVector,
    /// The Frobenius norm of `local_from_world`.
    pub norm: f64,
    /// [`Placement::condition`].
    pub condition: f64,
    /// Whether left and right are swapped.
    pub is_mirrored: bool,
}

impl ExactPlacement {
    /// Builds the exact form of `placement`, which is rounded.
    pub fn new(rows: [DoubleVector; 3], centre: DoubleVector, placement: &Placement) -> Self {
        // Near 1, so that the product of three does not underflow.
        let [x, y, z] = rows.map(|row| {
            let row = row.round();
            row * reciprocal_power_of_two(row.abs().max_element())
        });
        let norm = norm(placement.local_from_world);
        let is_mirrored = x.cross(y).dot(z) < 0.0;
        Self { rows, centre, norm, condition: placement.condition(), is_mirrored }
    }

    /// Returns a line in world space relative to the plane in which the coordinate of a local axis is `end`,
    /// as exactly as the ray and the placement allow.
    pub(crate) fn rise(&self, axis: usize, end: f64, origin: Vector, direction: Vector) -> Rise {
        let column = |index: usize| {
            let [x, y, z] = self.rows.map(|row| row.components()[index % 3]);
            DoubleVector::new(x, y, z)
        };
        let unit = |v: DoubleVector| v.normalized().unwrap_or(DoubleVector::ZERO);
        let along = column(axis);
        let normal = unit(unit(column(axis + 1)).cross(unit(column(axis + 2))));
        let tall = normal.dot(along);
        let from_plane = DoubleVector::from(origin) - self.centre - along * end.into();
        let distance = normal.dot(DoubleVector::from(origin) - from_plane).round();
        // In lengths along the axis.
        let steep = normal.map(|c| c / tall);
        Rise::along(steep, (steep.dot(from_plane), distance), origin, direction)
    }

    /// Returns the vector from a point in world space to a local point, rounded once.
    pub(crate) fn way(&self, from: Vector, local: Vector) -> Vector {
        (self.centred(local) + (self.centre - DoubleVector::from(from))).round()
    }

    /// The vector from the centre to a local point, in world space.
    fn centred(&self, local: Vector) -> DoubleVector {
        let local = DoubleVector::from(local);
        let [x, y, z] = self.rows.map(|row| row.dot(local));
        DoubleVector::new(x, y, z)
    }

    /// Returns a line in world space relative to the plane through three local points; `None` if they are
    /// collinear.
    pub(crate) fn rise_from(
        &self,
        points: [Vector; 3],
        origin: Vector,
        direction: Vector,
    ) -> Option<Rise> {
        let [a, b, c] = points.map(|point| self.centred(point));
        let (first, second) = ((b - a).normalized()?, (c - a).normalized()?);
        let normal = first.cross(second).normalized()?;
        let up = normal.dot(DoubleVector::from(origin) - self.centre - a);
        let distance = normal.dot(a + self.centre).round();
        Some(Rise::along(normal, (up, distance), origin, direction))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::{Random, tries};

    fn space(axes: [DoubleVector; 3], centre: DoubleVector) -> ExactPlacement {
        let [x, y, z] = axes.map(DoubleVector::components);
        let rows = [0, 1, 2].map(|i| DoubleVector::new(x[i], y[i], z[i]));
        let [x, y, z] = axes.map(DoubleVector::round);
        let world_from_local = Matrix::from_cols(x, y, z);
        let local_from_world = world_from_local.inverse();
        let placement = Placement { centre: centre.round(), world_from_local, local_from_world };
        ExactPlacement::new(rows, centre, &placement)
    }

    #[test]
    fn a_ray_rises_alike_from_a_plane_that_two_spaces_share() {
        let mut random = Random(1);
        for _ in 0..tries() / 4 {
            let double = DoubleVector::from;
            let axes = random.matrix();
            let [x, y, z] = [axes.x_axis, axes.y_axis, axes.z_axis];
            let centre = random.point(1000.0);
            // The plane at 1 of the one is that at −1 of the other.
            // Turned, so that the plane is across each axis; the other's space may be mirrored.
            let axis = random.below(3);
            let turned = |mut axes: [DoubleVector; 3]| {
                axes.rotate_left(2 - axis);
                axes
            };
            let one = space(turned([x, y, z].map(double)), double(centre));
            let side = [1.0, -1.0][random.below(2)];
            let quarter = double(y * 0.25);
            let up = double(x * 0.5 - y) + double(z);
            let middle = double(centre) + double(z) + up;
            let first = (double(x) + quarter) * side.into();
            let other = space(turned([first, double(y) - double(x * 4.0), up]), middle);

            let little = random.number(-8.0, 8.0) * f64::EPSILON;
            let mut along =
                |slope| (x * random.number(-9.0, 9.0) + y * random.number(-9.0, 9.0)) + z * slope;
            let (origin, way) = (centre + z + along(1000.0 * little), along(little));
            let direction = way.normalize_or(x);
            let rises =
                [one.rise(axis, 1.0, origin, direction), other.rise(axis, -1.0, origin, direction)];
            // How much higher the other is.
            let [share, same] =
                [rises[0].up_size / rises[1].up_size, rises[0].speed_size / rises[1].speed_size];
            let is_one = |a: f64, b: f64| (a - share * b).abs() <= 1e-14 * a.abs() + 1e-25;
            let [a, b] = rises;
            assert!((share / same - 1.0).abs() < 1e-14, "{a:?} {b:?}");
            assert!(is_one(a.up, b.up) && is_one(a.speed, b.speed), "{a:?} {b:?}");
        }
    }
}
