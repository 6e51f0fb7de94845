//! Typeset letters: closed curves in the plane z = 0, in units of the font size.

/// A point in the plane.
pub type Point = [f64; 2];

/// A closed curve of lines and Bézier curves; a line closes it from its last point to its first.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Contour {
    /// The Bézier points of all pieces in sequence; the last of a piece is the first of the next.
    pub points: Vec<Point>,
    /// The degree of each piece: 1, 2 or 3.
    pub degrees: Vec<u8>,
}

impl Contour {
    /// Returns the Bézier points of each piece.
    pub fn pieces(&self) -> impl Iterator<Item = &[Point]> {
        let mut at = 0;
        self.degrees.iter().filter_map(move |degree| {
            let piece = self.points.get(at..=at + usize::from(*degree));
            at += usize::from(*degree);
            piece
        })
    }
}

/// A glyph outline, filled by the even-odd rule.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Letter {
    pub contours: Vec<Contour>,
}

impl Letter {
    /// Returns its size in bytes.
    pub fn bytes(&self) -> u64 {
        let sizes = self.contours.iter().map(|contour| {
            size_of::<Contour>() + size_of_val(&contour.points[..]) + contour.degrees.len()
        });
        sizes.sum::<usize>() as u64
    }
}

/// Letters from z = 0 to `thickness`; with thickness 0 they are a sheet.
#[derive(Debug, Clone, PartialEq)]
pub struct Text {
    /// The text as written.
    pub string: String,
    /// Only the visible letters.
    pub letters: Vec<Letter>,
    pub thickness: f64,
}

impl Text {
    pub fn is_nothing(&self) -> bool {
        self.letters.is_empty()
    }
}
