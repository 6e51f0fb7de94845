//! Triangles as they were written.

use super::TextureId;
use crate::math::Vector;

/// The parts of a `mesh`, a `mesh2` or a lone triangle.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Triangles {
    pub vertices: Vec<Vector>,
    /// Of any length.
    pub normals: Vec<Vector>,
    /// Places in a texture.
    pub uvs: Vec<[f64; 2]>,
    /// Their indices are those of entries.
    pub faces: Vec<Face>,
    /// Those that faces have themselves.
    pub textures: Vec<TextureId>,
    /// `inside_vector`: it has an inside. Any length but zero.
    pub inside: Option<Vector>,
}

/// A triangle, by indices.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Face {
    pub vertices: [u32; 3],
    /// `None` where it is flat.
    pub normals: Option<[u32; 3]>,
    /// What each corner is painted with: of the mesh's textures, or where it has none, of a list that its
    /// pigment is; `None` where that is not said.
    pub paint: Option<[u32; 3]>,
    pub uvs: Option<[u32; 3]>,
}

impl Triangles {
    /// How many bytes it holds.
    pub fn bytes(&self) -> u64 {
        let Self { vertices, normals, uvs, faces, textures, .. } = self;
        let points = size_of_val(&vertices[..]) + size_of_val(&normals[..]);
        let lists = size_of_val(&uvs[..]) + size_of_val(&textures[..]);
        (points + lists + size_of_val(&faces[..])) as u64
    }
}
