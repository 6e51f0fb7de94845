//! Meshes from files: PLY, OBJ, STL and glTF.
//!
//! **In:** a file's name and bytes, and who has the files that it names. **Out:** a [`Model`], or the
//! first [`Fault`]. **Invariant:** no bytes make it panic, and no count is believed before there are bytes
//! for it. Coordinates are the file's; corners turn so that what is outside in the file (where they turn
//! left, seen in a right-handed space) is outside here.

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
    /// Some may be lines or points.
    pub triangles: Triangles,
    /// Linear; what `Face::paint` counts. Empty where the file has no colours.
    pub colors: Vec<Color>,
    /// What the file asks for that there is not, and what of it is not read: a sentence each.
    pub lacks: Vec<String>,
}

/// Why a file is no mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct Fault {
    /// The name of another file, where that is at fault.
    pub file: Option<String>,
    /// `None` of what is larger than the limit, and of a file that is not there.
    pub place: Option<Place>,
    /// `a vertex has three numbers`.
    pub reason: String,
    /// The file is not at fault: what it says is larger than the limit.
    pub is_too_large: bool,
}

/// A place in a file.
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

/// The line of a byte, from 1.
fn line_at(bytes: &[u8], at: usize) -> usize {
    1 + bytes[..at.min(bytes.len())].iter().filter(|byte| **byte == b'\n').count()
}

/// Who has the files that lie beside one; the error is a reason, such as `it is not found`.
pub type Beside<'a> = dyn FnMut(&str) -> Result<Vec<u8>, String> + 'a;

/// What a file may be.
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

    /// By the end of a file's name.
    fn of(name: &str) -> Option<Self> {
        let extension = name.rsplit_once('.')?.1;
        let known = ENDINGS.iter().position(|known| extension.eq_ignore_ascii_case(known));
        known.map(|at| Self::ALL[at])
    }
}

/// How the names of meshes end.
pub const ENDINGS: [&str; 5] = ["ply", "obj", "stl", "gltf", "glb"];

/// Whether a file's name ends as that of a mesh.
pub fn is_named(name: &str) -> bool {
    Format::of(name).is_some()
}

/// The mesh that a file is. It and all that is made on the way take about `most` bytes, or less.
///
/// # Errors
/// The first fault, in the file or in one that it cannot do without.
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
