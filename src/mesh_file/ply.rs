//! PLY: elements with properties, as text or in binary of either byte order; the only file that uses
//! `ply_rs_bw`.
//!
//! Reads the `vertex` elements (x y z, nx ny nz, red green blue alpha, s t) and the `face` elements
//! (vertex_indices, red green blue alpha). Integer colours are display values.
//!
//! **Source:** G. Turk, "The PLY Polygon File Format", 1994.

use std::borrow::Cow;
use std::io::{Cursor, ErrorKind};

use ply_rs_bw::parser::{Parser, Reader};
use ply_rs_bw::ply::{
    ElementDef, Encoding, Header, Property, PropertyAccess, PropertyAccessResult, PropertyType,
    ScalarType,
};

use super::build::{Builder, Corner};
use super::{Fault, Place, said};
use crate::color::srgb_decode;

type Bytes<'b> = Reader<Cursor<&'b [u8]>>;

/// Names of the property of a face that lists its vertices.
const INDICES: [&str; 2] = ["vertex_indices", "vertex_index"];

pub(super) fn read(bytes: &[u8], builder: &mut Builder) -> Result<(), Fault> {
    let bytes = &*with_plain_head(bytes);
    let mut reader = Reader::new(Cursor::new(bytes));
    let header = Parser::<Unread>::new().read_header(&mut reader).map_err(|error| {
        // Of what is missing, where it ends.
        let line = error.line().unwrap_or_else(|| reader.line().saturating_sub(1).max(1));
        Fault::line(
            line,
            match error.kind() {
                ErrorKind::UnexpectedEof => "the file ends before `end_header`".to_owned(),
                _ => said::of_ply_head(bytes, line),
            },
        )
    })?;
    let declared = |name: &str| Place::Line(line_of(bytes, &format!("element {name}")));
    let mut colors = Vec::new();
    let mut has = Has { normals: false, uvs: false };
    let mut has_faces = false;
    for element in header.elements.values() {
        check_count(element, &header, bytes.len() - reader.get_ref().position() as usize)
            .and_then(|()| check_lists(element, &header))
            .map_err(|fault| fault.at(declared(&element.name)))?;
        match element.name.as_str() {
            "vertex" => {
                let gives = |names: &[&str]| {
                    names.iter().all(|name| element.properties.contains_key(*name))
                };
                if !gives(&["x", "y", "z"]) {
                    let fault = Fault::new("its vertices have no x, y and z");
                    return Err(fault.at(declared(&element.name)));
                }
                has.normals = gives(&["nx", "ny", "nz"]);
                has.uvs =
                    [["s", "t"], ["u", "v"], ["texture_u", "texture_v"]].iter().any(|n| gives(n));
                let vertices = elements::<Vertex>(&mut reader, element, &header)?;
                for (number, (place, vertex)) in vertices.iter().enumerate() {
                    let added = vertex.add(has, builder);
                    colors.push(added.map_err(|f| in_element("vertex", number, *place, f))?);
                }
            }
            "face" => {
                has_faces = true;
                let polygons = elements::<Polygon>(&mut reader, element, &header)?;
                for (number, (place, polygon)) in polygons.iter().enumerate() {
                    let added = polygon.add(&colors, has, builder);
                    added.map_err(|fault| in_element("face", number, *place, fault))?;
                }
            }
            _ => drop(elements::<Unread>(&mut reader, element, &header)?),
        }
    }
    match has_faces {
        true => Ok(()),
        false => Err(Fault::line(
            line_of(bytes, "end_header"),
            "it has no `face` elements: points alone, or strips of triangles",
        )),
    }
}

fn in_element(what: &str, number: usize, place: Place, fault: Fault) -> Fault {
    Fault { reason: format!("{what} {number}: {}", fault.reason), ..fault }.at(place)
}

/// Number of the header line that begins with these words.
fn line_of(bytes: &[u8], words: &str) -> usize {
    let mut lines = bytes.split(|byte| *byte == b'\n');
    let begins = |line: &[u8]| {
        let mut found = line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
        words.split(' ').all(|word| found.next() == Some(word.as_bytes()))
    };
    lines.position(begins).map_or(1, |number| number + 1)
}

/// Replaces non-ASCII bytes in the header: comments may be in any encoding, but the crate reads UTF-8.
fn with_plain_head(bytes: &[u8]) -> Cow<'_, [u8]> {
    const END: &[u8] = b"end_header";
    let end = bytes.windows(END.len()).position(|window| window == END).unwrap_or(bytes.len());
    if bytes[..end].is_ascii() {
        return Cow::Borrowed(bytes);
    }
    let mut bytes = bytes.to_vec();
    bytes[..end].iter_mut().filter(|byte| !byte.is_ascii()).for_each(|byte| *byte = b'?');
    Cow::Owned(bytes)
}

/// Checks that the rest of the file can hold this many elements.
fn check_count(element: &ElementDef, header: &Header, room: usize) -> Result<(), Fault> {
    let size = |scalar: &ScalarType| match scalar {
        ScalarType::Char | ScalarType::UChar => 1,
        ScalarType::Short | ScalarType::UShort => 2,
        ScalarType::Int | ScalarType::UInt | ScalarType::Float => 4,
        ScalarType::Double => 8,
    };
    let least: usize = match header.encoding {
        // As a line.
        Encoding::Ascii => 1,
        Encoding::BinaryBigEndian | Encoding::BinaryLittleEndian => {
            let properties = element.properties.values();
            let least = properties.map(|property| match &property.data_type {
                PropertyType::Scalar(scalar) | PropertyType::List(scalar, _) => size(scalar),
            });
            least.sum()
        }
    };
    match element.count.checked_mul(least.max(1)) {
        Some(needed) if needed <= room + 1 => Ok(()),
        _ => {
            let ElementDef { name, count, .. } = element;
            Err(Fault::new(format!("it is too short for {count} `{name}` elements")))
        }
    }
}

/// Checks that vertex indices and list counts are integers; in a text file, counts may be declared with any
/// type.
fn check_lists(element: &ElementDef, header: &Header) -> Result<(), Fault> {
    let is_whole = |scalar: &ScalarType| !matches!(scalar, ScalarType::Float | ScalarType::Double);
    let is_text = header.encoding == Encoding::Ascii;
    for (name, property) in &element.properties {
        let is_index = element.name == "face" && INDICES.contains(&name.as_str());
        let of = &element.name;
        match &property.data_type {
            PropertyType::List(count, _) if !is_text && !is_whole(count) => {
                let reason = format!("the count of `{name}` of its `{of}` is no whole number");
                return Err(Fault::new(reason));
            }
            PropertyType::List(_, entry) if !is_index || is_whole(entry) => {}
            PropertyType::Scalar(_) if !is_index => {}
            _ => {
                let reason = format!("`{name}` of its `{of}` is no list of whole numbers");
                return Err(Fault::new(reason));
            }
        }
    }
    Ok(())
}

/// Reads the elements of a kind, each with its location.
fn elements<E: PropertyAccess>(
    reader: &mut Bytes,
    element: &ElementDef,
    header: &Header,
) -> Result<Vec<(Place, E)>, Fault> {
    let parser = Parser::<E>::new();
    if header.encoding == Encoding::Ascii {
        let first = reader.line();
        let read = parser.read_payload_for_element(reader, element, header);
        let read = read.map_err(|error| {
            let line = error.line().unwrap_or_else(|| reader.line());
            let what = format!("{} {}", element.name, line.saturating_sub(first));
            let bytes = *reader.get_ref().get_ref();
            Fault::line(line, said::of_numbers(&what, &names_of(element), bytes, line))
        })?;
        // A line each.
        return Ok(read
            .into_iter()
            .enumerate()
            .map(|(i, e)| (Place::Line(first + i), e))
            .collect());
    }
    let bytes = reader.get_mut();
    let mut read = Vec::new();
    for number in 0..element.count {
        let at = bytes.position() as usize;
        let one = match header.encoding {
            Encoding::BinaryBigEndian => parser.read_big_endian_element(bytes, element),
            _ => parser.read_little_endian_element(bytes, element),
        };
        let one = one.map_err(|error| match error.kind() {
            ErrorKind::UnexpectedEof => {
                let ElementDef { name, count, .. } = element;
                let reason = format!("the file ends in the middle of {name} {number} of {count}");
                Fault::new(reason).at(Place::Byte(bytes.position() as usize))
            }
            _ => {
                let reason = format!("{} {number}: the length of a list is below 0", element.name);
                Fault::new(reason).at(Place::Byte(at))
            }
        })?;
        read.push((Place::Byte(at), one));
    }
    Ok(read)
}

/// Names of the numbers of an element, in order.
fn names_of(element: &ElementDef) -> String {
    let names = element.properties.iter().map(|(name, property)| match property.data_type {
        PropertyType::Scalar(_) => name.clone(),
        PropertyType::List(..) => format!("how many {name}, and these"),
    });
    names.collect::<Vec<_>>().join(", ")
}

/// An element that is skipped.
struct Unread;

impl PropertyAccess for Unread {
    fn new() -> Self {
        Self
    }
}

/// `red`, `green`, `blue` and `alpha`, display values from 0 to 1; NaN if missing.
#[derive(Clone, Copy)]
struct Paint([f64; 4]);

impl Paint {
    const NONE: Self = Self([f64::NAN; 4]);

    fn set(&mut self, name: &str, number: &Property) {
        let slot = match name {
            "red" | "diffuse_red" | "r" => 0,
            "green" | "diffuse_green" | "g" => 1,
            "blue" | "diffuse_blue" | "b" => 2,
            "alpha" | "a" => 3,
            _ => return,
        };
        let most = match number {
            Property::Float(_) | Property::Double(_) => 1.0,
            Property::UShort(_) => f64::from(u16::MAX),
            // Whole numbers of other kinds hold the same 256 values.
            _ => 255.0,
        };
        self.0[slot] = number_of(number) / most;
    }

    fn add(self, builder: &mut Builder) -> Result<Option<u32>, Fault> {
        let [red, green, blue, alpha] = self.0;
        if [red, green, blue].iter().any(|number| number.is_nan()) {
            return Ok(None);
        }
        let alpha = if alpha.is_nan() { 1.0 } else { alpha };
        builder.color([red, green, blue].map(srgb_decode), alpha).map(Some)
    }
}

fn number_of(property: &Property) -> f64 {
    match *property {
        Property::Char(number) => f64::from(number),
        Property::UChar(number) => f64::from(number),
        Property::Short(number) => f64::from(number),
        Property::UShort(number) => f64::from(number),
        Property::Int(number) => f64::from(number),
        Property::UInt(number) => f64::from(number),
        Property::Float(number) => f64::from(number),
        Property::Double(number) => number,
        _ => f64::NAN,
    }
}

/// x y z, nx ny nz, s t; NaN if missing.
struct Vertex {
    numbers: [f64; 8],
    paint: Paint,
}

impl PropertyAccess for Vertex {
    fn new() -> Self {
        Self { numbers: [f64::NAN; 8], paint: Paint::NONE }
    }

    fn set_property(&mut self, name: &str, number: Property) -> PropertyAccessResult {
        let slot = match name {
            "x" => 0,
            "y" => 1,
            "z" => 2,
            "nx" => 3,
            "ny" => 4,
            "nz" => 5,
            "s" | "u" | "texture_u" => 6,
            "t" | "v" | "texture_v" => 7,
            _ => {
                self.paint.set(name, &number);
                return PropertyAccessResult::Set;
            }
        };
        self.numbers[slot] = number_of(&number);
        PropertyAccessResult::Set
    }
}

/// Which of the lists have an entry for each vertex; the others are empty.
#[derive(Clone, Copy)]
struct Has {
    normals: bool,
    uvs: bool,
}

impl Vertex {
    /// Adds its colour.
    fn add(&self, has: Has, builder: &mut Builder) -> Result<Option<u32>, Fault> {
        let [x, y, z, nx, ny, nz, s, t] = self.numbers;
        builder.vertex([x, y, z])?;
        if has.normals {
            builder.normal([nx, ny, nz])?;
        }
        if has.uvs {
            builder.uv([s, t])?;
        }
        self.paint.add(builder)
    }
}

struct Polygon {
    /// −1 for an invalid index.
    vertices: Vec<i64>,
    paint: Paint,
}

impl PropertyAccess for Polygon {
    fn new() -> Self {
        Self { vertices: Vec::new(), paint: Paint::NONE }
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        if !INDICES.contains(&name) {
            self.paint.set(name, &property);
            return PropertyAccessResult::Set;
        }
        self.vertices = match property {
            Property::ListChar(all) => all.into_iter().map(i64::from).collect(),
            Property::ListUChar(all) => all.into_iter().map(i64::from).collect(),
            Property::ListShort(all) => all.into_iter().map(i64::from).collect(),
            Property::ListUShort(all) => all.into_iter().map(i64::from).collect(),
            Property::ListInt(all) => all.into_iter().map(i64::from).collect(),
            Property::ListUInt(all) => all.into_iter().map(i64::from).collect(),
            _ => return PropertyAccessResult::UnsupportedType,
        };
        PropertyAccessResult::Set
    }
}

impl Polygon {
    /// Adds the face; its own colour takes precedence over those of its vertices.
    fn add(&self, colors: &[Option<u32>], has: Has, builder: &mut Builder) -> Result<(), Fault> {
        let own = self.paint.add(builder)?;
        let corner = |&vertex: &i64| {
            let color = usize::try_from(vertex).ok().and_then(|vertex| colors.get(vertex));
            let Some(color) = color else {
                let count = colors.len();
                let message = format!("index {vertex} is of nothing: there are {count} vertices");
                return Err(Fault::new(message));
            };
            let vertex = vertex as u32;
            let (normal, uv) = (has.normals.then_some(vertex), has.uvs.then_some(vertex));
            Ok(Corner { vertex, normal, color: own.or(*color), uv })
        };
        let corners: Vec<Corner> = self.vertices.iter().map(corner).collect::<Result<_, _>>()?;
        builder.polygon(&corners);
        Ok(())
    }
}
