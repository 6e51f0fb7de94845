//! Splits numeric text into its tokens: literals, the tokens between them, and long runs of both.
//!
//! **In:** text that the grammar accepts as `numeric`. **Out:** its tokens, in order. **Invariant:** linear
//! in time; every byte that is not blank is in exactly one token.

use super::token::{Mark, Token, TokenKind, word};

/// The fewest literals or vectors of a run, each with its comma. No operator can follow any of them, so they
/// are complete values. A sign before the first might be an operator; after a comma it is a sign.
const RUN: usize = 8;

/// Returns whether a character may be in numeric text.
pub(super) fn is_figure(byte: u8) -> bool {
    matches!(byte, b'+'..=b'9' | b'<' | b'>')
}

pub(super) fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t'..=b'\r' | b'\0')
}

/// Returns the end of the numeric text that begins at `at`, without what follows an exponent's `e`.
pub(super) fn end(text: &[u8], at: usize) -> usize {
    let rest = text.get(at..).unwrap_or(&[]);
    let length = rest.iter().position(|&byte| !is_figure(byte) && !is_blank(byte));
    length.map_or(text.len(), |length| at + length)
}

/// Adds the tokens from `start` to `end`, and returns the end of the last one: past `end` if the token
/// continues there (`>` and its `=`).
pub(super) fn part(text: &str, start: usize, end: usize, tokens: &mut Vec<Token>) -> usize {
    let scan = Scan(text.as_bytes());
    // No run begins before these: the search got this far.
    let (mut literals_told, mut vectors_told) = (start, start);
    let mut at = start;
    while at < end {
        let begin = at;
        let kind = match scan.byte(at) {
            Some(b'<') if begin >= vectors_told => match scan.run(at, Scan::vector, Scan::vector) {
                Ok(behind) => {
                    at = behind;
                    TokenKind::Vectors
                }
                Err(behind) => {
                    vectors_told = behind;
                    scan.comparison(&mut at, Mark::Less, Mark::LessOrEqual)
                }
            },
            Some(b'<') => scan.comparison(&mut at, Mark::Less, Mark::LessOrEqual),
            Some(b'>') => scan.comparison(&mut at, Mark::Greater, Mark::GreaterOrEqual),
            Some(b'.' | b'0'..=b'9') => match scan.literal(at) {
                None => scan.mark(&mut at, Mark::Dot),
                Some(_)
                    if begin >= literals_told
                        && let Ok(behind) = scan
                            .run(at, Scan::literal, Scan::signed)
                            .map_err(|behind| literals_told = behind) =>
                {
                    at = behind;
                    TokenKind::Numbers
                }
                Some(behind) => {
                    at = behind;
                    TokenKind::Number
                }
            },
            Some(b',') => scan.mark(&mut at, Mark::Comma),
            Some(b'+') => scan.mark(&mut at, Mark::Plus),
            Some(b'-') => scan.mark(&mut at, Mark::Minus),
            Some(b'/') => scan.mark(&mut at, Mark::Slash),
            // An `e` that is not part of a literal begins a word.
            Some(b'a'..=b'z' | b'A'..=b'Z') => {
                at = scan.word(at);
                word(&text[begin..at])
            }
            _ => {
                at += 1;
                continue;
            }
        };
        tokens.push(Token { kind, start: begin as u32, end: at as u32 });
    }
    at
}

/// Finds the ends of tokens in a text: each function takes the offset where one might begin.
#[derive(Clone, Copy)]
struct Scan<'a>(&'a [u8]);

impl Scan<'_> {
    fn byte(self, at: usize) -> Option<u8> {
        self.0.get(at).copied()
    }

    fn mark(self, at: &mut usize, mark: Mark) -> TokenKind {
        *at += 1;
        TokenKind::Mark(mark)
    }

    fn comparison(self, at: &mut usize, alone: Mark, or_equal: Mark) -> TokenKind {
        let equal = self.byte(*at + 1) == Some(b'=');
        *at += usize::from(equal);
        self.mark(at, if equal { or_equal } else { alone })
    }

    fn digits(self, mut at: usize) -> usize {
        while matches!(self.byte(at), Some(b'0'..=b'9')) {
            at += 1;
        }
        at
    }

    fn blanks(self, mut at: usize) -> usize {
        while matches!(self.byte(at), Some(b' ' | b'\t'..=b'\r' | b'\0')) {
            at += 1;
        }
        at
    }

    fn word(self, mut at: usize) -> usize {
        while matches!(self.byte(at), Some(b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'_')) {
            at += 1;
        }
        at
    }

    /// `1`, `1.`, `.5`, `1e5`.
    fn literal(self, at: usize) -> Option<usize> {
        let whole = self.digits(at);
        let mantissa = match self.byte(whole) {
            Some(b'.') => self.digits(whole + 1),
            _ => whole,
        };
        if whole == at && mantissa < at + 2 {
            return None;
        }
        if let Some(b'e' | b'E') = self.byte(mantissa) {
            let sign = usize::from(matches!(self.byte(mantissa + 1), Some(b'+' | b'-')));
            let power = mantissa + 1 + sign;
            let end = self.digits(power);
            if end > power {
                return Some(end);
            }
        }
        Some(mantissa)
    }

    fn signed(self, at: usize) -> Option<usize> {
        self.literal(at + usize::from(matches!(self.byte(at), Some(b'+' | b'-'))))
    }

    /// A comma with the blanks around it.
    fn comma(self, at: usize) -> Option<usize> {
        let at = self.blanks(at);
        (self.byte(at) == Some(b',')).then(|| self.blanks(at + 1))
    }

    /// `<1, -2>`: two literals or more.
    fn vector(self, at: usize) -> Option<usize> {
        if self.byte(at) != Some(b'<') {
            return None;
        }
        let mut end = self.signed(self.blanks(at + 1))?;
        let mut several = false;
        while let Some(next) = self.comma(end) {
            end = self.signed(next)?;
            several = true;
        }
        let end = self.blanks(end);
        (several && self.byte(end) == Some(b'>')).then_some(end + 1)
    }

    /// Returns the end of a run; or, if it is too short, of the part that was searched.
    fn run(
        self,
        at: usize,
        first: fn(Self, usize) -> Option<usize>,
        following: fn(Self, usize) -> Option<usize>,
    ) -> Result<usize, usize> {
        let mut behind = at;
        let mut count = 0;
        let mut entry = first(self, at);
        while let Some(next) = entry.and_then(|end| self.comma(end)) {
            count += 1;
            behind = next;
            entry = following(self, next);
        }
        if count >= RUN { Ok(behind) } else { Err(behind) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn kinds(text: &str) -> Vec<(TokenKind, &str)> {
        let mut tokens = Vec::new();
        part(text, 0, text.len(), &mut tokens);
        tokens.iter().map(|t| (t.kind, &text[t.start as usize..t.end as usize])).collect()
    }

    fn texts(text: &str) -> Vec<&str> {
        kinds(text).into_iter().map(|(_, text)| text).collect()
    }

    #[test]
    fn a_literal_takes_all_that_it_can_and_no_more() {
        assert_eq!(
            texts("1.5e-3 .5 1. 1.2.3 .. -4"),
            ["1.5e-3", ".5", "1.", "1.2", ".3", ".", ".", "-", "4"]
        );
    }

    #[test]
    fn the_e_of_no_literal_begins_a_word() {
        assert_eq!(texts("2 e1 3e4e5"), ["2", "e1", "3e4", "e5"]);
        let mut tokens = Vec::new();
        // The text continues after its numeric part.
        assert_eq!(part("2 e1x_ 3", 0, 4, &mut tokens), 6);
        assert_eq!(tokens[1], Token { kind: TokenKind::Name, start: 2, end: 6 });
    }

    #[test]
    fn a_comparison_takes_its_equal_sign_from_behind_the_end() {
        let mut tokens = Vec::new();
        assert_eq!(part("1 >= 2", 0, 3, &mut tokens), 4);
        let mark = TokenKind::Mark(Mark::GreaterOrEqual);
        assert_eq!(tokens[1], Token { kind: mark, start: 2, end: 4 });
        assert_eq!(texts("<1,2>=3"), ["<", "1", ",", "2", ">=", "3"]);
    }

    #[test]
    fn a_vector_of_many_literals_holds_a_run_of_them() {
        let [(_, open), (kind, run), ..] = kinds("<1, 2,3,4,5,6,7,8, 9>")[..] else { panic!() };
        assert_eq!((open, kind, run), ("<", TokenKind::Numbers, "1, 2,3,4,5,6,7,8, "));
        assert_eq!(kinds("<1,2,3,4,5,6,7,8>").len(), 17);
    }

    #[test]
    fn a_run_of_vectors_ends_with_its_last_comma() {
        let run = "<1, -2>,".repeat(9);
        assert_eq!(texts(&format!("{run}<3,4>")), [&run[..], "<", "3", ",", "4", ">"]);
        assert_eq!(texts(&"<1,2>,".repeat(7)).len(), 42);
    }

    #[test]
    fn short_rows_without_end_are_read_in_linear_time() {
        let text = "<1,2,3,4,5,6,7,<".repeat(20_000);
        assert_eq!(texts(&text).len(), 16 * 20_000);
        let text = "1,".repeat(7) + &"<1,".repeat(100_000);
        assert_eq!(texts(&text).len(), 14 + 300_000);
    }
}
