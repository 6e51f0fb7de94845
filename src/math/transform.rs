//! Transformations as written: in order, with rotations in degrees.

use super::Vector;

/// Identifies a list of steps: an index into the arena of the `Scene`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct TransformId(pub u32);

impl TransformId {
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// One step, as written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Step {
    Translate(Vector),
    /// Factors along x, y and z.
    Scale(Vector),
    /// Degrees about x, then y, then z, by the right-hand rule.
    Rotate(Vector),
    /// Four rows of three numbers, as the language writes them: `<m00, m01, m02, m10, … m32>`. Maps a point p
    /// to `x·row0 + y·row1 + z·row2 + row3`.
    Matrix([Vector; 4]),
    /// All steps of an earlier list.
    Transform(TransformId),
    /// The inverse of all steps of an earlier list.
    InverseOf(TransformId),
}
