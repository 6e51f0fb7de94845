//! Meshes from files: PLY, OBJ, STL and glTF.
//!
//! **In:** a file's name and bytes, and access to the files that it refers to. **Out:** a [`Model`], or the
//! first [`Fault`]. **Invariant:** never panics, for any bytes, and trusts no count before there are bytes
//! for it. Coordinates are those of the file; the winding is converted so that the outside in the file (from
//! where corners are counterclockwise, in a right-handed space) is the outside here.

mod build;
mod data_uri;
mod glb;
mod gltf2;
mod json;
mod material;
mod obj;
mod ply;
mod said;
mod stl;
#[cfg(test)]
mod tests;

use std::fmt;

use crate::color::Color;
use crate::scene::mesh::Triangles;
use build::Builder;

/// The triangles of a file.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Model {
    /// Some may be degenerate: lines or points.
    pub triangles: Triangles,
    /// Linear colours, to which the indices in `Face::paint` refer. Empty if the file has no colours.
    pub colors: Vec<Color>,
    /// What the file requires but is missing, and what is not read: one sentence each.
    pub lacks: Vec<String>,
}

/// Why a file is not a mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct Fault {
    /// Name of another file, if that is at fault.
    pub file: Option<String>,
    /// `None` if the size limit is exceeded, or if a file does not exist.
    pub place: Option<Place>,
    /// For example, `a vertex has three numbers`.
    pub reason: String,
    /// Whether the file is valid, but exceeds the size limit.
    pub is_too_large: bool,
}

/// A location in a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// Counted from 1.
    Line(usize),
    /// Counted from 0.
    Byte(usize),
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line(line) => write!(f, "line {line}"),
            Self::Byte(byte) => write!(f, "byte {byte}"),
        }
    }
}

impl Fault {
    fn new(reason: impl Into<String>) -> Self {
        Self { file: None, place: None, reason: reason.into(), is_too_large: false }
    }

    fn at(self, place: Place) -> Self {
        Self { place: Some(self.place.unwrap_or(place)), ..self }
    }

    fn line(line: usize, reason: impl Into<String>) -> Self {
        Self::new(reason).at(Place::Line(line))
    }

    fn in_file(self, name: &str) -> Self {
        Self { file: Some(name.to_owned()), ..self }
    }
}

/// Line number of a byte, from 1.
fn line_at(bytes: &[u8], at: usize) -> usize {
    1 + bytes[..at.min(bytes.len())].iter().filter(|byte| **byte == b'\n').count()
}

/// Reads a file beside the mesh file; the error is a reason, such as `it is not found`.
pub type Beside<'a> = dyn FnMut(&str) -> Result<Vec<u8>, String> + 'a;

/// The format of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Format {
    Ply,
    Obj,
    Stl,
    Gltf,
}

impl Format {
    /// In the order of [`ENDINGS`].
    const ALL: [Self; 5] = [Self::Ply, Self::Obj, Self::Stl, Self::Gltf, Self::Gltf];

    /// Determines the format from the extension of a file's name.
    fn of(name: &str) -> Option<Self> {
        let extension = name.rsplit_once('.')?.1;
        let known = ENDINGS.iter().position(|known| extension.eq_ignore_ascii_case(known));
        known.map(|at| Self::ALL[at])
    }
}

/// File name extensions of meshes.
pub const ENDINGS: [&str; 5] = ["ply", "obj", "stl", "gltf", "glb"];

/// Returns whether a file's name has the extension of a mesh.
pub fn is_named(name: &str) -> bool {
    Format::of(name).is_some()
}

/// Reads a mesh. The result and all intermediate data use about `most` bytes, or less.
///
/// # Errors
/// Returns the first fault, in the file or in one that it requires.
pub fn read(name: &str, bytes: &[u8], beside: &mut Beside, most: u64) -> Result<Model, Fault> {
    let mut builder = Builder::new(most);
    match Format::of(name) {
        Some(Format::Ply) => ply::read(bytes, &mut builder)?,
        Some(Format::Obj) => obj::read(bytes, &mut builder, beside)?,
        Some(Format::Stl) => stl::read(bytes, &mut builder)?,
        Some(Format::Gltf) => gltf2::read(bytes, &mut builder, beside)?,
        None => {
            let known = ENDINGS.map(|ending| format!("`.{ending}`")).join(", ");
            return Err(Fault::new(format!("its name tells no format of meshes: {known}")));
        }
    }
    builder.finish()
}
