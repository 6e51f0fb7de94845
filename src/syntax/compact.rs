//! Parses a text in which a vector of three literals is one token: most of a large text is these.
//!
//! **In:** the tokens of a text. **Out:** its tree, if nothing had to be reported. **Invariant:** it is the
//! tree that all tokens give: vectors are joined only where nothing but their place matters to what looks for
//! mistakes, and at the first doubt the text is parsed token by token.

use super::ast::{Ast, Triple};
use super::balance::pairs;
use super::comment::Quiet;
use super::literal::literal_vector;
use super::numbers::{Piece, Pieces, number};
use super::token::{Bracket, Mark, Token, TokenKind};
use super::{ParseOptions, balance, habits, nest, old_words, spelling};
use crate::diagnostic::Diagnostics;
use crate::source::FileId;
use crate::vocabulary::{Family, Word};

/// Returns the tree of a text without mistakes, else `None`.
pub(super) fn parse(
    mut tokens: Vec<Token>,
    quiet: &Quiet,
    source: &str,
    file: FileId,
    options: &ParseOptions,
) -> Option<Ast> {
    let text: &str = &quiet.text;
    if !join(&mut tokens, text) || !pairs(&tokens) {
        return None;
    }
    let mut found = Diagnostics::new(true);
    let count = tokens.len();
    old_words::replace(&mut tokens, file, options.dialect, &mut found);
    spelling::correct_heads(&mut tokens, text, file, options.dialect, &mut found);
    if !found.is_empty() || tokens.len() != count {
        return None;
    }
    let tokens = habits::translate(tokens, text, file, options.dialect, &mut found);
    if !found.is_empty() || tokens.len() != count {
        return None;
    }
    let (tokens, cut) = balance::balance(tokens, source, file, options, &mut found);
    if !found.is_empty() || tokens.len() != count || cut {
        return None;
    }
    let ast = nest::nest_joined(quiet, source.len(), file, &tokens, options, &mut found)?;
    found.is_empty().then_some(ast)
}

/// Replaces each vector of three literals that may be one token by it. Returns whether there are any.
fn join(tokens: &mut Vec<Token>, text: &str) -> bool {
    let (mut kept, mut at) = (0_usize, 0);
    // Only values were read since the brace of a shape or the parenthesis of a call.
    let mut is_list = false;
    while let Some(&token) = tokens.get(at) {
        let kinds = |back: usize| kept.checked_sub(back).map(|place| tokens[place].kind);
        let (before, second) = (kinds(1), kinds(2));
        let mut length = 1;
        let mut joined = token;
        match token.kind {
            TokenKind::Mark(Mark::Less) => {
                let begins = is_list && stands_in_list(before) || is_after_word(before, second);
                match literal_vector(&tokens[at..]).filter(|_| begins) {
                    Some(all) if is_triple(&tokens[at..at + all], text) => {
                        let end = tokens[at + all - 1].end;
                        joined = Token { kind: TokenKind::Triple, end, ..token };
                        length = all;
                    }
                    _ => is_list = false,
                }
            }
            TokenKind::Mark(Mark::Open(Bracket::Brace)) => {
                is_list =
                    matches!(before, Some(TokenKind::Word(word)) if word.family() == Family::Shape);
            }
            TokenKind::Mark(Mark::Open(Bracket::Round)) => {
                is_list = before == Some(TokenKind::Name);
            }
            TokenKind::Mark(Mark::Comma | Mark::Minus) | TokenKind::Number => {}
            _ => is_list = false,
        }
        tokens[kept] = joined;
        kept += 1;
        at += length;
    }
    tokens.truncate(kept);
    tokens.shrink_to_fit();
    kept < at
}

/// Returns whether a vector after this token is an element of a list of values.
fn stands_in_list(before: Option<TokenKind>) -> bool {
    let mark = |mark| Some(TokenKind::Mark(mark));
    before == mark(Mark::Comma)
        || before == mark(Mark::Open(Bracket::Brace))
        || before == mark(Mark::Open(Bracket::Round))
        || before == Some(TokenKind::Triple)
}

/// Returns whether a vector is the value of a transform or a colour: `translate <1, 2, 3>`.
fn is_after_word(before: Option<TokenKind>, second: Option<TokenKind>) -> bool {
    let takes_vector = matches!(
        before,
        Some(TokenKind::Word(Word::Rgb | Word::Translate | Word::Rotate | Word::Scale))
    );
    // No operator: `rgb A + rgb <1, 0, 0>` is a mistake.
    let is_apart = matches!(
        second,
        Some(
            TokenKind::Mark(Mark::Open(Bracket::Brace) | Mark::Close(Bracket::Brace))
                | TokenKind::Word(_)
                | TokenKind::Number
                | TokenKind::Triple
        )
    );
    takes_vector && is_apart
}

/// Returns whether a vector of literals can be a [`Triple`].
pub(super) fn is_triple(tokens: &[Token], text: &str) -> bool {
    let (Some(first), Some(last)) = (tokens.first(), tokens.last()) else { return false };
    let numbers = tokens.iter().filter(|token| token.kind == TokenKind::Number).count();
    let touches =
        |two: &[Token]| two[0].kind != TokenKind::Mark(Mark::Minus) || two[0].end == two[1].start;
    let whole = text.get(first.start as usize..last.end as usize).unwrap_or("\n");
    numbers == 3
        && tokens.windows(2).all(touches)
        && whole.len() <= usize::from(u8::MAX)
        && whole.bytes().fold(true, |all, byte| all & is_plain(byte))
}

/// Returns whether a byte may be in a [`Triple`]: in a text with mistakes, a token may stand for other signs.
fn is_plain(byte: u8) -> bool {
    matches!(byte, b'0'..=b'9' | b',' | b'-' | b'.' | b'<' | b'>' | b' ' | b'\t')
}

/// Reads a vector that may be a [`Triple`]: its numbers, and where each starts and ends.
pub(super) fn read_triple(whole: &str) -> Option<([f64; 3], [u8; 3], [u8; 3])> {
    let (mut numbers, mut starts, mut ends) = ([0.0; 3], [0; 3], [0; 3]);
    let mut count = 0;
    for (_, piece) in Pieces::of(whole) {
        let Piece::Number { start, end } = piece else { continue };
        let place = numbers.get_mut(count)?;
        *place = Some(number(whole, start, end)).filter(|number| number.is_finite())?;
        (starts[count], ends[count]) = (u8::try_from(start).ok()?, u8::try_from(end).ok()?);
        count += 1;
    }
    (count == 3).then_some((numbers, starts, ends))
}

impl nest::Nest<'_> {
    /// Adds the vector of literals at these bytes as one node. Returns `false` if it is none that can be.
    pub(super) fn add_triple(&mut self, whole: crate::source::Span) -> bool {
        let Some((numbers, starts, ends)) = read_triple(self.slice(whole)) else { return false };
        let triple = Triple { numbers: self.ast.numbers.len() as u32, starts, ends };
        self.ast.numbers.extend(numbers);
        self.operand(super::ast::ExpressionKind::Triple(triple), whole, false);
        true
    }
}
