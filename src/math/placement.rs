//! Affine maps as they are used: subtract the centre first, then multiply.
//!
//! **Invariant:** every [`Placement`] is invertible and its two matrices undo each other within
//! rounding.

use super::double::DoubleVector;
use super::{Matrix, Vector, reciprocal_power_of_two};

/// `p ↦ matrix · (p − centre)`.
///
/// Subtracting first keeps the digits of far things: for an ellipsoid 10⁶ units from the origin
/// the relative error of t is 3e-15 so, and 4e-11 with a 4×4 matrix.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Map {
    pub centre: Vector,
    pub matrix: Matrix,
}

impl Map {
    pub const IDENTITY: Self = Self { centre: Vector::ZERO, matrix: Matrix::IDENTITY };

    #[inline]
    pub fn point(&self, p: Vector) -> Vector {
        self.matrix * (p - self.centre)
    }

    #[inline]
    pub fn direction(&self, d: Vector) -> Vector {
        self.matrix * d
    }

    /// How far [`Map::point`] of `p` may be off along each axis, where `p` is by `error`.
    ///
    /// With M the matrix and c the centre: |M|·(error + u·|c| + u·|p − c|) for what comes in, the
    /// centre's rounding and the difference's, and 4u·|M|·|p − c| for the matrix' and the sums.
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

/// Where a local shape stands in the world.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placement {
    /// The world point of the local origin.
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

    /// The (unnormalised) world normal of a local one: by the inverse transpose.
    #[inline]
    pub fn world_normal(&self, local: Vector) -> Vector {
        self.local_from_world.transpose() * local
    }

    /// By how many roundings the two matrices may be from undoing each other: the product of their Frobenius
    /// norms.
    pub fn condition(&self) -> f64 {
        norm(self.world_from_local) * norm(self.local_from_world)
    }
}

/// The Frobenius norm.
pub fn norm(Matrix { x_axis, y_axis, z_axis }: Matrix) -> f64 {
    (x_axis.length_squared() + y_axis.length_squared() + z_axis.length_squared()).sqrt()
}

/// Where a local space stands in the world, to 106 bits: points of two such spaces that are one point of the
/// world are so to the bit.
#[derive(Debug, Clone, PartialEq)]
pub struct ExactPlacement {
    /// The rows of `world_from_local`.
    pub rows: [DoubleVector; 3],
    pub centre: DoubleVector,
    /// The Frobenius norm of `local_from_world`.
    pub norm: f64,
    /// [`Placement::condition`].
    pub condition: f64,
    /// Left and right are swapped.
    pub is_mirrored: bool,
}

impl ExactPlacement {
    /// Of the place that `placement` is, rounded.
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

    /// The way from a point of the world to a local one, rounded once.
    pub fn way(&self, from: Vector, local: Vector) -> Vector {
        let local = DoubleVector::from(local);
        let [x, y, z] = self.rows.map(|row| row.dot(local));
        (DoubleVector::new(x, y, z) + (self.centre - DoubleVector::from(from))).round()
    }
}
