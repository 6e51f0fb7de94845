//! Transformations as they are written: in order, rotations in degrees.

use super::Vector;

/// One step, as written.
#[derive(Debug, Clone, PartialEq)]
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
    /// What undoes all of these steps.
    InverseOf(Vec<Step>),
}
