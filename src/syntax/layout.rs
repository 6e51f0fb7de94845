//! Computes the layout of the source: which tokens begin a line, and their indentation.

use super::token::Token;

/// The position of a token in its line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Place {
    /// Only blanks precede it in its line.
    pub first: bool,
    /// Indentation of its line; a tab advances to the next multiple of four.
    pub indent: u32,
}

pub(super) struct Layout(Vec<Place>);

impl Layout {
    /// Measures each token of `text`, the source as written.
    pub fn of(tokens: &[Token], text: &str) -> Self {
        let bytes = text.as_bytes();
        let mut places = Vec::with_capacity(tokens.len());
        let (mut end, mut indent) = (0_usize, 0);
        for token in tokens {
            // A string without its quote ends with its line break.
            let gap = bytes.get(end.saturating_sub(1)..token.start as usize).unwrap_or(&[]);
            let line = gap.iter().rposition(|byte| matches!(byte, b'\n' | b'\r'));
            let first = line.is_some() || places.is_empty();
            if first {
                let blanks = &gap[line.map_or(0, |line| line + 1)..];
                indent = blanks.iter().fold(0, |width: u32, &byte| match byte {
                    b'\t' => (width / 4 + 1) * 4,
                    _ => width + 1,
                });
            }
            places.push(Place { first, indent });
            end = token.end as usize;
        }
        Self(places)
    }

    /// Returns a token's place; past the last token, that of a new line.
    pub fn place(&self, token: usize) -> Place {
        self.0.get(token).copied().unwrap_or(Place { first: true, indent: 0 })
    }
}
