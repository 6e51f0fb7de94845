//! Letters as they were set: closed curves in the plane z = 0, in units of the letters' size.

/// A place in the plane.
pub type Point = [f64; 2];

/// A closed curve of lines and Bézier curves; a line leads from its last point to its first.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Contour {
    /// The Bézier points of all pieces in a row; the last of a piece is the first of the next.
    pub points: Vec<Point>,
    /// The degree of each piece: 1, 2 or 3.
    pub degrees: Vec<u8>,
}

impl Contour {
    /// The Bézier points of each piece.
    pub fn pieces(&self) -> impl Iterator<Item = &[Point]> {
        let mut at = 0;
        self.degrees.iter().filter_map(move |degree| {
            let piece = self.points.get(at..=at + usize::from(*degree));
            at += usize::from(*degree);
            piece
        })
    }
}

/// What its contours go around an odd number of times.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Letter {
    pub contours: Vec<Contour>,
}

impl Letter {
    /// How many bytes it holds.
    pub fn bytes(&self) -> u64 {
        let sizes = self.contours.iter().map(|contour| {
            size_of::<Contour>() + size_of_val(&contour.points[..]) + contour.degrees.len()
        });
        sizes.sum::<usize>() as u64
    }
}

/// Letters from z = 0 to `thickness`; of thickness 0 they are a sheet.
#[derive(Debug, Clone, PartialEq)]
pub struct Text {
    /// What was written.
    pub string: String,
    /// Those that show something.
    pub letters: Vec<Letter>,
    pub thickness: f64,
}

impl Text {
    pub fn is_nothing(&self) -> bool {
        self.letters.is_empty()
    }
}
