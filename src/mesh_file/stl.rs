//! STL: independent triangles, as text or in binary; the only file that uses `stl_io`.
//!
//! A file is binary if it has the length that its triangle count implies, or a zero in its header: many
//! binary files begin with the word `solid`, too. The normals are those of the flat triangles, and are
//! ignored.
//!
//! **Source:** 3D Systems, "StereoLithography Interface Specification", 1989.

use std::collections::HashMap;
use std::io::{self, ErrorKind, Read, Seek, SeekFrom};

use stl_io::{Triangle, create_stl_reader};

use super::build::{Builder, Corner};
use super::{Fault, Place, line_at, said};

/// A title and a count of 4 bytes; 50 bytes follow for each triangle.
const HEAD: usize = 84;
const EACH: usize = 50;

pub(super) fn read(bytes: &[u8], builder: &mut Builder) -> Result<(), Fault> {
    let mut soup = Soup { builder, known: HashMap::new() };
    // No text has the zeros of a count.
    let is_text = bytes.trim_ascii_start().starts_with(b"solid")
        && length_told(bytes) != bytes.len()
        && !bytes[..bytes.len().min(HEAD)].contains(&0);
    if !is_text {
        let title =
            bytes.get(HEAD - 4..).map(|rest| Pieces::new(&[b' '; HEAD - 4], rest, usize::MAX));
        let mut pieces = title.ok_or_else(|| {
            let reason = match bytes.is_empty() {
                true => "the file is empty",
                false => {
                    "it does not begin with `solid`, as a text, and ends in the head of a binary file"
                }
            };
            Fault::new(reason).at(Place::Byte(bytes.len()))
        })?;
        return soup.read(&mut pieces).map_err(|fault| fault.at(Place::Byte(pieces.at)));
    }
    // A text may hold several solids.
    let mut at = 0;
    while let Some(head) = bytes[at..].split_inclusive(|byte| *byte == b'\n').next() {
        if head.trim_ascii().is_empty() {
            at += head.len();
            continue;
        }
        if !head.trim_ascii_start().starts_with(b"solid") {
            let found = said::found(&String::from_utf8_lossy(head));
            return Err(Fault::line(line_at(bytes, at), format!("expected `solid`, {found}")));
        }
        at += head.len();
        // Of the line, the crate wants no more than the word and a blank.
        let mut pieces = Pieces::new(b"solid \n", &bytes[at..], 1);
        let outcome = soup.read(&mut pieces);
        at += pieces.at - pieces.head.len().min(pieces.at);
        // The line that was given last.
        outcome.map_err(|fault| {
            let line = line_at(bytes, at.saturating_sub(1));
            let fault = match fault.reason.is_empty() {
                true => Fault { reason: said::of_stl(bytes, line), ..fault },
                false => fault,
            };
            fault.at(Place::Line(line))
        })?;
    }
    Ok(())
}

/// Length of a binary file, according to its count.
fn length_told(bytes: &[u8]) -> usize {
    let count = bytes.get(HEAD - 4..HEAD).and_then(|count| count.try_into().ok());
    let count = count.map_or(0, |count| u32::from_le_bytes(count) as usize);
    HEAD.saturating_add(count.saturating_mul(EACH))
}

/// Independent triangles: equal corners become one vertex.
struct Soup<'b> {
    builder: &'b mut Builder,
    known: HashMap<[u32; 3], u32>,
}

impl Soup<'_> {
    /// Reads the triangles. A fault without a reason concerns the last line read.
    fn read(&mut self, pieces: &mut Pieces) -> Result<(), Fault> {
        let is_text = pieces.lines == 1;
        let told = |error: io::Error| match error.kind() {
            ErrorKind::UnexpectedEof if is_text => Fault::new("the file ends before `endsolid`"),
            ErrorKind::UnexpectedEof => Fault::new("the file ends in the middle of a triangle"),
            _ if is_text => Fault::new(""),
            _ => Fault::new(error.to_string()),
        };
        let triangles = create_stl_reader(pieces).map_err(told)?;
        for triangle in triangles {
            self.add(&triangle.map_err(told)?)?;
        }
        Ok(())
    }

    fn add(&mut self, triangle: &Triangle) -> Result<(), Fault> {
        let mut corners = [Corner::default(); 3];
        for (corner, vertex) in corners.iter_mut().zip(&triangle.vertices) {
            // Adding zero turns −0 into 0.
            let key = vertex.0.map(|number| (number + 0.0).to_bits());
            corner.vertex = match self.known.get(&key) {
                Some(&known) => known,
                None => {
                    let new = self.builder.vertex(vertex.0.map(f64::from))?;
                    self.known.insert(key, new);
                    new
                }
            };
        }
        self.builder.triangle(corners);
        Ok(())
    }
}

/// Two texts as one, supplied one line at a time, so that the last line supplied is the last one read.
struct Pieces<'t> {
    head: &'t [u8],
    rest: &'t [u8],
    /// Number of bytes already read.
    at: usize,
    lines: usize,
}

impl<'t> Pieces<'t> {
    /// Supplies about `lines` lines at once.
    fn new(head: &'t [u8], rest: &'t [u8], lines: usize) -> Self {
        Self { head, rest, at: 0, lines }
    }
}

impl Read for Pieces<'_> {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        let left = match self.at.checked_sub(self.head.len()) {
            None => &self.head[self.at..],
            Some(at) => self.rest.get(at..).unwrap_or_default(),
        };
        let end = left.iter().position(|byte| *byte == b'\n').filter(|_| self.lines == 1);
        let count = end.map_or(left.len(), |end| end + 1).min(into.len());
        into[..count].copy_from_slice(&left[..count]);
        self.at += count;
        Ok(count)
    }
}

impl Seek for Pieces<'_> {
    /// Returns to the start, which the crate requests to detect the format.
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        match to {
            SeekFrom::Start(at) => self.at = at as usize,
            SeekFrom::Current(_) | SeekFrom::End(_) => return Err(ErrorKind::Unsupported.into()),
        }
        Ok(self.at as u64)
    }
}
