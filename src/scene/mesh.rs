//! Triangles as written.

use super::TextureId;
use crate::math::Vector;

/// The parts of a `mesh`, a `mesh2` or a single triangle.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Triangles {
    pub vertices: Vec<Vector>,
    /// Of any length.
    pub normals: Vec<Vector>,
    /// Texture coordinates.
    pub uvs: Vec<[f64; 2]>,
    /// Faces, which index the lists above.
    pub faces: Vec<Face>,
    /// Textures of single faces.
    pub textures: Vec<TextureId>,
    /// `inside_vector`: gives the mesh an inside. Any length but zero.
    pub inside: Option<Vector>,
}

/// A triangle, as indices.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Face {
    pub vertices: [u32; 3],
    /// `None` if flat-shaded.
    pub normals: Option<[u32; 3]>,
    /// The paint of each corner: an index into the mesh's textures, or without any, into the pigment's list
    /// of colours; `None` if not given.
    pub paint: Option<[u32; 3]>,
    pub uvs: Option<[u32; 3]>,
}

impl Triangles {
    /// Returns whether the normals of the first face point against the turn of its corners.
    pub fn is_turned(&self) -> bool {
        let Some(Face { vertices, normals: Some(normals), .. }) = self.faces.first() else {
            return false;
        };
        let [a, b, c] =
            vertices.map(|i| self.vertices.get(i as usize).copied().unwrap_or_default());
        let normals = normals.map(|i| self.normals.get(i as usize).copied().unwrap_or_default());
        let sum = normals.into_iter().fold(Vector::ZERO, |sum, n| sum + n.normalize_or_zero());
        // The corners of a face turn around the direction away from its outer side.
        (b - a).cross(c - a).dot(sum) > 0.0
    }

    /// Returns its size in bytes.
    pub fn bytes(&self) -> u64 {
        let Self { vertices, normals, uvs, faces, textures, .. } = self;
        let points = size_of_val(&vertices[..]) + size_of_val(&normals[..]);
        let lists = size_of_val(&uvs[..]) + size_of_val(&textures[..]);
        (points + lists + size_of_val(&faces[..])) as u64
    }
}
