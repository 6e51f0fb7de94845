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

/// The powers of ten that a double can hold exactly.
const POWERS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16,
    1e17, 1e18, 1e19, 1e20, 1e21, 1e22,
];

/// Returns the value of the literal at these bytes, correctly rounded; NaN if there is none.
///
/// Few digits make a whole number that is exact, as is the power of ten that divides it: then only the
/// quotient is rounded.
pub(super) fn number(text: &str, start: usize, end: usize) -> f64 {
    let Some(literal) = text.get(start..end) else { return f64::NAN };
    let (mut whole, mut digits, mut decimals) = (0_u64, 0_usize, None);
    let (sign, plain) = match literal.as_bytes() {
        [b'-', plain @ ..] => (-1.0, plain),
        [b'+', plain @ ..] => (1.0, plain),
        plain => (1.0, plain),
    };
    for byte in plain {
        match (byte, decimals) {
            (b'0'..=b'9', _) => {
                whole = whole.wrapping_mul(10).wrapping_add(u64::from(byte - b'0'));
                digits += 1;
                decimals = decimals.map(|count| count + 1);
            }
            (b'.', None) => decimals = Some(0),
            _ => return literal.parse().unwrap_or(f64::NAN),
        }
    }
    let exact = digits > 0 && digits < 20 && whole <= 1 << f64::MANTISSA_DIGITS;
    match POWERS.get(decimals.unwrap_or(0)).filter(|_| exact) {
        Some(power) => sign * (whole as f64 / power),
        None => literal.parse().unwrap_or(f64::NAN),
    }
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
                numbers.push(number(run, from, end));
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
    fn literals_are_rounded_as_by_the_standard_library() {
        let mut state = 1_u64;
        let mut random = |below: u64| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 33) % below
        };
        for _ in 0..20_000 {
            let mut literal = ["", "-", "+"][random(3) as usize].to_owned();
            for _ in 0..random(22) {
                literal.push(char::from(b'0' + random(10) as u8));
            }
            literal += [".", "", ".0", ".000000000000000000000001"][random(4) as usize];
            for _ in 0..random(24) {
                literal.push(char::from(b'0' + random(10) as u8));
            }
            literal += ["", "", "", "e-5", "E12", "e"][random(6) as usize];
            let expected: f64 = literal.parse().unwrap_or(f64::NAN);
            let found = number(&literal, 0, literal.len());
            assert_eq!(found.to_bits(), expected.to_bits(), "{literal}");
        }
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
