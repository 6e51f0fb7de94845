//! Transformations as they are written: in order, rotations in degrees.

use super::Vector;

/// Names a list of steps: an index into the Scene's arena of them.
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
    /// Degrees about x, then y, then z, right-hand rule.
    Rotate(Vector),
    /// Three columns of the linear part, as rows of four numbers each are written in the
    /// language: `<m00, m01, m02, m10, … m32>`; a point p becomes
    /// `x·row0 + y·row1 + z·row2 + row3`.
    Matrix([Vector; 4]),
    /// All steps of another list, which stands before this one.
    Transform(TransformId),
    /// What undoes all steps of another list, which stands before this one.
    InverseOf(TransformId),
}
