//! Decides where a blank separates two atoms of one line.
//!
//! Sums and comparisons are spaced, products are tight: `2*x + 1`, as is usual in scenes. **Invariant:** two
//! atoms never join to become another.

use super::atom::{Atom, Kind, Pair};

/// Returns whether a blank separates two neighbours.
pub(super) fn between(left: &Atom, right: &Atom) -> bool {
    wanted(left.kind, right.kind) || would_join(&left.text, &right.text)
}

fn wanted(left: Kind, right: Kind) -> bool {
    use Kind as K;
    match (left, right) {
        (K::LineComment | K::BlockComment, K::Comma | K::Semicolon) => false,
        (K::LineComment | K::BlockComment, _) | (_, K::LineComment | K::BlockComment) => true,
        (_, K::Comma | K::Semicolon | K::Dot | K::Product) => false,
        (K::Dot | K::Sign | K::Product | K::Callee, _) => false,
        (K::Open(Pair::Brace), K::Close(Pair::Brace)) => false,
        (K::Open(Pair::Brace), _) | (_, K::Close(Pair::Brace)) => true,
        (K::Open(_), _) => false,
        (_, K::Close(_) | K::Open(Pair::Index)) => false,
        (
            K::Word(_)
            | K::OwnWord
            | K::Value
            | K::Directive(_)
            | K::Close(_)
            | K::LooseOpen
            | K::LooseClose
            | K::Comma
            | K::Semicolon
            | K::Operator
            | K::Assign
            | K::Raw
            | K::Stray,
            _,
        ) => true,
    }
}

/// Returns whether the two would be parsed differently without a blank.
fn would_join(left: &str, right: &str) -> bool {
    let (Some(a), Some(b)) = (left.chars().next_back(), right.chars().next()) else {
        return false;
    };
    let wordy = |c: char| c.is_ascii_alphanumeric() || c == '_';
    match (a, b) {
        // `5 .x`, and a single `#` before a word.
        ('.', b) => b.is_ascii_digit(),
        ('#', b) => wordy(b),
        (a, '.') => left.starts_with(|c: char| c.is_ascii_digit() || c == '.') && wordy(a),
        ('<' | '>' | '!' | '=', '=') | ('/', '/' | '*') | ('*', '/') => true,
        (a, b) => wordy(a) && wordy(b),
    }
}
