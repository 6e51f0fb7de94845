//! A vector whose `<` is missing: `sphere { 0, 1, 0>, 1 }`.

use super::Reader;
use super::part::Inside;
use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::syntax::token::{Bracket, Mark, Token, TokenKind};
use crate::vocabulary::Role;

/// So many tokens before its `>` a vector may begin.
const LONGEST: usize = 40;

/// How many components stand in a vector that is told: fewer are rather a comparison.
const COMPONENTS: std::ops::RangeInclusive<usize> = 3..=5;

impl Reader<'_> {
    /// A `>` behind numbers and commas that no `<` stands before.
    pub(super) fn unopened_vector(&mut self, meant: &mut Vec<Token>) -> bool {
        let in_parentheses = self.inside.last().is_some_and(|inside| inside.is(Bracket::Round));
        if in_parentheses && self.is_operand(1) {
            return false;
        }
        let Some((first, components)) = begin(meant) else { return false };
        if meant.get(first).is_none_or(|token| token.kind == TokenKind::Mark(Mark::Comma)) {
            return false;
        }
        // A list of points begins with their count, and each has two numbers.
        let in_list = self.inside.last().is_some_and(Inside::holds_flat_points);
        let is_one = match in_list {
            true => components == 2 && follows_a_vector(&meant[..first]),
            false => COMPONENTS.contains(&components),
        };
        if !is_one {
            return false;
        }
        let closer = self.span(0, 0);
        let start = meant[first].start;
        let whole = Span { start, ..closer };
        let text = self.text.get(whole.range()).unwrap_or("");
        let here = Span { start, end: meant[first].end, ..closer };
        self.diagnostics.push(
            Diagnostic::new(Code::StrayCloser, "this vector has no `<`")
                .at(here, "expected `<` before this")
                .also(closer, "it ends here")
                .help(format!("write `<{text}`"))
                .fix(Span { end: start, ..here }, "<"),
        );
        let open = Token { kind: TokenKind::Mark(Mark::Less), start, end: start };
        meant.insert(first, open);
        meant.push(self.tokens[self.at]);
        self.at += 1;
        true
    }

    fn is_operand(&self, ahead: usize) -> bool {
        match self.kind(ahead) {
            Some(TokenKind::Number | TokenKind::Name | TokenKind::String) => true,
            Some(TokenKind::Word(word)) => word.role() != Role::Statement,
            Some(TokenKind::Mark(mark)) => {
                matches!(
                    mark,
                    Mark::Open(Bracket::Round)
                        | Mark::Minus
                        | Mark::Plus
                        | Mark::Less
                        | Mark::Equal
                )
            }
            _ => false,
        }
    }
}

fn follows_a_vector(meant: &[Token]) -> bool {
    matches!(meant, [.., close, comma] if close.kind == TokenKind::Mark(Mark::Greater)
        && comma.kind == TokenKind::Mark(Mark::Comma))
}

/// Where what is read begins that a vector could hold, with the number of its components; `None` where it has begun
/// with a `<`.
fn begin(meant: &[Token]) -> Option<(usize, usize)> {
    let (mut components, mut depth, mut first) = (1, 0usize, meant.len());
    for (at, token) in meant.iter().enumerate().rev().take(LONGEST) {
        match token.kind {
            TokenKind::Number | TokenKind::Name => {}
            TokenKind::Word(word) if word.role() != Role::Statement => {}
            // `C.red`
            TokenKind::Word(_) if at > 0 && meant[at - 1].kind == TokenKind::Mark(Mark::Dot) => {}
            TokenKind::Mark(Mark::Close(Bracket::Round)) => depth += 1,
            TokenKind::Mark(Mark::Open(Bracket::Round)) if depth > 0 => depth -= 1,
            TokenKind::Mark(Mark::Comma) if depth > 0 => {}
            TokenKind::Mark(Mark::Comma) => components += 1,
            TokenKind::Mark(Mark::Plus | Mark::Minus | Mark::Star | Mark::Slash | Mark::Dot) => {}
            TokenKind::Mark(Mark::Less) => return None,
            _ if depth > 0 => return None,
            // What stands before the comma behind another vector is that.
            TokenKind::Mark(Mark::Greater) => {
                return match meant.get(at + 1)?.kind {
                    TokenKind::Mark(Mark::Comma) => Some((at + 2, components - 1)),
                    TokenKind::Number | TokenKind::Name => Some((at + 1, components)),
                    _ => None,
                };
            }
            TokenKind::Mark(Mark::Open(Bracket::Round)) if in_vector(&meant[..at]) => return None,
            TokenKind::Word(_)
            | TokenKind::Mark(Mark::Open(Bracket::Brace | Bracket::Round) | Mark::Equal) => {
                return Some((first, components));
            }
            _ => return None,
        }
        first = at;
    }
    (first == 0).then_some((first, components))
}

/// Whether a `<` is open at the end of what is read: `<cos(1, 2, 3>`.
fn in_vector(meant: &[Token]) -> bool {
    for token in meant.iter().rev().take(LONGEST) {
        match token.kind {
            TokenKind::Mark(Mark::Less) => return true,
            TokenKind::Mark(Mark::Greater | Mark::Open(Bracket::Brace))
            | TokenKind::Directive(_) => {
                return false;
            }
            _ => {}
        }
    }
    false
}
