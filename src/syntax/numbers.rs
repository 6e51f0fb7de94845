//! Decodes runs of literals directly, so that megabytes of mesh data need no node each.
//!
//! **In:** the text of a run. **Out:** correctly rounded numbers, in order. **Invariant:** a run contains
//! only what `numeric` accepts as one.

/// One literal, vector bracket or comma of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Piece {
    /// A literal with its sign, as a byte range of the run.
    Number {
        start: usize,
        end: usize,
    },
    Open,
    Close,
    Comma,
}

/// An iterator over the pieces of a run and the byte each starts at.
pub(super) struct Pieces<'a> {
    run: &'a [u8],
    at: usize,
}

impl<'a> Pieces<'a> {
    pub fn of(run: &'a str) -> Self {
        Self { run: run.as_bytes(), at: 0 }
    }
}

impl Iterator for Pieces<'_> {
    type Item = (usize, Piece);

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            let start = self.at;
            let byte = *self.run.get(start)?;
            self.at += 1;
            match byte {
                b',' => return Some((start, Piece::Comma)),
                b'<' => return Some((start, Piece::Open)),
                b'>' => return Some((start, Piece::Close)),
                b'0'..=b'9' | b'.' | b'+' | b'-' => {
                    while let Some(b'0'..=b'9' | b'.' | b'e' | b'E' | b'+' | b'-') =
                        self.run.get(self.at)
                    {
                        self.at += 1;
                    }
                    return Some((start, Piece::Number { start, end: self.at }));
                }
                _ => {}
            }
        }
    }
}

/// Consecutive vectors of one width: `count` of them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Row {
    pub count: u32,
    pub width: u32,
    /// The byte range of the run that it covers.
    pub start: usize,
    pub end: usize,
}

/// Appends the numbers of a run to `numbers`; a new row starts where the width changes.
pub(super) fn decode(run: &str, numbers: &mut Vec<f64>) -> Vec<Row> {
    let mut rows: Vec<Row> = Vec::new();
    let (mut start, mut width, mut inside) = (0, 0, false);
    for (at, piece) in Pieces::of(run) {
        match piece {
            Piece::Number { start: from, end } => {
                if !inside {
                    start = from;
                }
                width += 1;
                numbers.push(run[from..end].parse().unwrap_or(f64::NAN));
            }
            Piece::Open => (start, inside) = (at, true),
            Piece::Close => inside = false,
            Piece::Comma if inside => {}
            Piece::Comma => {
                match rows.last_mut() {
                    Some(row) if row.width == width => {
                        (row.count, row.end) = (row.count + 1, at + 1)
                    }
                    _ => rows.push(Row { count: 1, width, start, end: at + 1 }),
                }
                width = 0;
            }
        }
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_decoded_in_order() {
        let mut numbers = vec![7.0];
        let rows = decode("1, -2.5,\n+.5 ,3.,1e-3, 4E+2,", &mut numbers);
        assert_eq!(numbers, [7.0, 1.0, -2.5, 0.5, 3.0, 1e-3, 4e2]);
        assert_eq!(rows, [Row { count: 6, width: 1, start: 0, end: 28 }]);
    }

    #[test]
    fn vectors_of_another_width_start_a_row() {
        let mut numbers = Vec::new();
        let rows = decode("<1,2>, <3,4>, < 5 , 6 , 7 >,", &mut numbers);
        assert_eq!(numbers, [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]);
        assert_eq!(
            rows,
            [
                Row { count: 2, width: 2, start: 0, end: 13 },
                Row { count: 1, width: 3, start: 14, end: 28 },
            ]
        );
    }
}
