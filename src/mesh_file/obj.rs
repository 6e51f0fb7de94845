//! OBJ: vertices and faces, one statement per line; groups and objects are merged into one mesh.
//!
//! It is parsed here. The existing crates (tobj, obj, wobj, wavefront_obj) panic on some texts, assign
//! normals to the wrong corners if not all faces have them, or lose the material at a new group; and none
//! reports the line of an invalid index.
//!
//! **Source:** Alias|Wavefront, "Advanced Visualizer Manual", appendix B1 "Object Files"; vertex colours as
//! in MeshLab and Blender, in display values.

use std::collections::HashMap;

use super::build::{Builder, Corner};
use super::material::{self, Material};
use super::{Beside, Fault, said};
use crate::color::srgb_decode;

struct Reader<'b, 'f> {
    builder: &'b mut Builder,
    beside: &'b mut Beside<'f>,
    materials: HashMap<String, Option<Material>>,
    /// One for each vertex.
    colors: Vec<Option<u32>>,
    /// Colour of the current material.
    color: Option<u32>,
    corners: Vec<Corner>,
    /// Number of the current line.
    line: usize,
    /// Polygons with indices, counted from the start of the file, of entries that follow later.
    ahead: Vec<Polygon>,
}

/// A polygon whose indices may be invalid.
struct Polygon {
    line: usize,
    corners: Vec<Corner>,
}

pub(super) fn read(bytes: &[u8], builder: &mut Builder, beside: &mut Beside) -> Result<(), Fault> {
    let text = String::from_utf8_lossy(bytes);
    let mut reader = Reader {
        builder,
        beside,
        materials: HashMap::new(),
        colors: Vec::new(),
        color: None,
        corners: Vec::new(),
        line: 0,
        ahead: Vec::new(),
    };
    let mut begun = String::new();
    for (number, line) in text.lines().enumerate() {
        reader.line = number + 1;
        let line = line.split('#').next().unwrap_or("").trim();
        // A line goes on where it ends with a backslash.
        if let Some(part) = line.strip_suffix('\\') {
            begun.push_str(part);
            begun.push(' ');
            continue;
        }
        let read = if begun.is_empty() {
            reader.statement(line)
        } else {
            begun.push_str(line);
            reader.statement(&std::mem::take(&mut begun))
        };
        // One in another file has its place there.
        read.map_err(|fault| match fault.file {
            Some(_) => fault,
            None => fault.at(super::Place::Line(number + 1)),
        })?;
    }
    reader.polygons_ahead()
}

impl Reader<'_, '_> {
    fn statement(&mut self, line: &str) -> Result<(), Fault> {
        let (word, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
        match word {
            "v" => self.vertex(rest),
            "vn" => {
                let [x, y, z] = numbers(rest, "a normal has three numbers")?;
                self.builder.normal([x, y, z]).map(drop)
            }
            "vt" => {
                let mut words = rest.split_whitespace().map(str::parse);
                let (u, v) = (words.next(), words.next().unwrap_or(Ok(0.0)));
                let (Some(Ok(u)), Ok(v)) = (u, v) else {
                    return Err(Fault::new("a place in a texture has one number or more"));
                };
                self.builder.uv([u, v]).map(drop)
            }
            // An old word for the same.
            "f" | "fo" => self.face(rest),
            "mtllib" => self.library(rest.trim()),
            "usemtl" => self.material(rest.trim()),
            _ => Ok(()),
        }
    }

    fn vertex(&mut self, rest: &str) -> Result<(), Fault> {
        let all: Option<Vec<f64>> = rest.split_whitespace().map(|n| n.parse().ok()).collect();
        let (place, color) = match all.as_deref() {
            Some(&[x, y, z, red, green, blue, ..]) => ([x, y, z], Some([red, green, blue])),
            Some(&[x, y, z, w, ..]) if w != 0.0 => ([x / w, y / w, z / w], None),
            Some(&[x, y, z]) => ([x, y, z], None),
            _ => return Err(lacks_numbers("a vertex has three numbers", rest)),
        };
        self.builder.vertex(place)?;
        let color = color.map(|rgb| self.builder.color(rgb.map(srgb_decode), 1.0));
        self.colors.push(color.transpose()?);
        Ok(())
    }

    fn face(&mut self, rest: &str) -> Result<(), Fault> {
        let counts = self.builder.counts();
        self.corners.clear();
        for word in rest.split_whitespace() {
            let mut parts = word.split('/');
            let mut index = |which: usize| {
                let part = parts.next().filter(|part| !part.is_empty());
                part.map(|part| index(part, counts[which], which)).transpose()
            };
            let (vertex, uv, normal) = (index(0)?, index(2)?, index(1)?);
            let vertex = vertex.ok_or_else(|| Fault::new("a corner has no vertex"))?;
            self.corners.push(Corner { vertex, normal, color: self.color, uv });
        }
        if self.corners.len() < 3 {
            let lack = format!("the face on line {} has fewer than three corners", self.line);
            self.builder.lacks(lack);
            return Ok(());
        }
        match self.missing(&self.corners) {
            None => {
                let mut corners = std::mem::take(&mut self.corners);
                self.polygon(&mut corners);
                self.corners = corners;
            }
            Some(_) => {
                self.ahead.push(Polygon { line: self.line, corners: self.corners.clone() });
            }
        }
        Ok(())
    }

    /// Adds a polygon; vertex colours take precedence over that of the material.
    fn polygon(&mut self, corners: &mut [Corner]) {
        for corner in &mut *corners {
            let own = self.colors.get(corner.vertex as usize).copied().flatten();
            corner.color = own.or(corner.color);
        }
        self.builder.polygon(corners);
    }

    /// Returns a fault for the first index of an entry that does not exist so far.
    fn missing(&self, corners: &[Corner]) -> Option<Fault> {
        let counts = self.builder.counts();
        let indices = |corner: &Corner| [Some(corner.vertex), corner.normal, corner.uv];
        let mut all = corners.iter().flat_map(|corner| indices(corner).into_iter().enumerate());
        all.find_map(|(which, index)| {
            let index = index.filter(|&index| index as usize >= counts[which])?;
            Some(of_nothing(i64::from(index) + 1, counts[which], which))
        })
    }

    fn polygons_ahead(&mut self) -> Result<(), Fault> {
        for Polygon { line, mut corners } in std::mem::take(&mut self.ahead) {
            if let Some(fault) = self.missing(&corners) {
                return Err(fault.at(super::Place::Line(line)));
            }
            self.polygon(&mut corners);
        }
        Ok(())
    }

    /// Reads a material library; a missing one only loses the colours.
    fn library(&mut self, name: &str) -> Result<(), Fault> {
        match (self.beside)(name) {
            Ok(bytes) => {
                let text = String::from_utf8_lossy(&bytes);
                let materials = material::read(&text).map_err(|fault| fault.in_file(name))?;
                for (name, material) in materials {
                    self.materials.entry(name).or_insert(material);
                }
            }
            Err(reason) => {
                self.builder.lacks(format!("its materials are missing: `{name}`, {reason}"));
            }
        }
        Ok(())
    }

    fn material(&mut self, name: &str) -> Result<(), Fault> {
        self.color = match self.materials.get(name) {
            Some(Some(material)) => {
                if material.pictured {
                    let pictures = "pictures on its surface are not read yet (`map_Kd`)";
                    self.builder.lacks(pictures.to_owned());
                }
                Some(self.builder.color(material.rgb, material.alpha)?)
            }
            Some(None) => None,
            None => {
                // Of a library that is missing, that is told.
                if !self.materials.is_empty() {
                    let lack =
                        format!("its materials have no `{name}`, which line {} uses", self.line);
                    self.builder.lacks(lack);
                }
                None
            }
        };
        Ok(())
    }
}

fn numbers(text: &str, wanted: &str) -> Result<[f64; 3], Fault> {
    let mut words = text.split_whitespace().map(str::parse);
    match [words.next(), words.next(), words.next()] {
        [Some(Ok(x)), Some(Ok(y)), Some(Ok(z))] => Ok([x, y, z]),
        _ => Err(lacks_numbers(wanted, text)),
    }
}

fn lacks_numbers(wanted: &str, text: &str) -> Fault {
    match text.trim() {
        "" => Fault::new(format!("{wanted}, found none")),
        text => Fault::new(format!("{wanted}, {}", said::found(text))),
    }
}

/// Converts an index, which counts from 1 and may refer to later entries, or backward from the last entry so
/// far.
fn index(text: &str, count: usize, which: usize) -> Result<u32, Fault> {
    let number: i64 = text.parse().map_err(|_| Fault::new(format!("`{text}` is no index")))?;
    if number == 0 {
        return Err(Fault::new("index 0 is of nothing: OBJ counts from 1"));
    }
    let from_zero =
        if number < 0 { number.checked_add(count as i64) } else { number.checked_sub(1) };
    let index = from_zero.and_then(|index| u32::try_from(index).ok());
    index.ok_or_else(|| of_nothing(number, count, which))
}

fn of_nothing(number: i64, count: usize, which: usize) -> Fault {
    let what = ["vertices", "normals", "places in a texture"][which];
    let before = if number < 0 { " before it" } else { "" };
    Fault::new(format!("index {number} is of nothing: there are {count} {what}{before}"))
}
