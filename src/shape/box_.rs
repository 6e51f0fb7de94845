//! Box: three pairs of parallel faces, |N_i·(P − C)| ≤ l_i. The normals need not be at right
//! angles: then it is a parallelepiped.

use crate::math::{UnitVector, Vector};

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
    pub fn face(&self, i: usize) -> Face {
        Face {
            normal: self.normals[i],
            centre: self.centre,
            distance: 0.0,
            opposite_centre: self.centre,
            opposite_distance: 0.0,
            half_width: 0.0,
        }
    }
}
