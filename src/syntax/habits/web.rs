//! `#ff8000`, `0xff8000`: a colour as the web writes it.

use super::Reader;
use crate::color::{Rgb, rounded, srgb_decode, web};
use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::syntax::token::{Bracket, Mark, Token, TokenKind};
use crate::vocabulary::{Family, Word};

impl Reader<'_> {
    /// Takes `#` and its digits, which are tokens of many kinds.
    pub(super) fn web_color(&mut self, meant: &mut Vec<Token>) -> bool {
        let start = self.tokens[self.at].start;
        let rest = self.text.get(start as usize..).unwrap_or("");
        let before = meant.last().map(|token| token.kind);
        let Some((text, color)) = color_at(rest, before) else { return false };
        self.take_color(text.len(), color, meant)
    }

    /// Takes `0xff8000` where a colour is wanted.
    pub(super) fn hexadecimal_color(&mut self, meant: &mut Vec<Token>) -> bool {
        if self.kind(1) != Some(TokenKind::Name) || !self.touches(1) || self.slice(0) != "0" {
            return false;
        }
        let Some(color) = self
            .slice(1)
            .strip_prefix(['x', 'X'])
            .and_then(|digits| (digits.len() == 6).then(|| web(&format!("#{digits}"))).flatten())
        else {
            return false;
        };
        let before = meant.last().map(|token| token.kind);
        let colors = [Word::LightSource, Word::Pigment, Word::Background, Word::Fog];
        let in_colors =
            colors.iter().any(|word| self.inside.last().is_some_and(|i| i.opens(*word)));
        let ends = matches!(
            self.kind(2),
            None | Some(
                TokenKind::Mark(Mark::Close(Bracket::Brace | Bracket::Square) | Mark::Semicolon)
                    | TokenKind::Word(_)
                    | TokenKind::Directive(_)
            )
        );
        let wanted = ends && (in_colors || after_color(before).is_some());
        wanted && self.take_color(8, color, meant)
    }

    fn take_color(&mut self, length: usize, color: Rgb, meant: &mut Vec<Token>) -> bool {
        let token = self.tokens[self.at];
        let end = token.start + length as u32;
        let span = Span { end, ..self.span(0, 0) };
        let text = self.text.get(span.range()).unwrap_or("");
        let before = meant.last().map(|token| token.kind);
        let word = after_color(before).filter(|word| *word != Word::Color);
        let ours = match word {
            Some(Word::Srgb | Word::Srgbf | Word::Srgbt | Word::Srgbft) => rounded(color),
            Some(_) => rounded(color.map(srgb_decode)),
            None => format!("srgb {}", rounded(color)),
        };
        let diagnostic =
            Diagnostic::new(Code::ForeignWord, format!("`{text}` is how the web writes a colour"))
                .at(span, "expected numbers from 0 to 1")
                .help(format!("write `{ours}`"))
                .fix(span, ours);
        self.diagnostics.push(diagnostic);
        // Any colour stands in for it: nothing is drawn after a mistake.
        let made = |word| Token { kind: TokenKind::Word(word), end, ..token };
        if word.is_none() {
            meant.push(made(Word::Rgb));
        }
        meant.push(made(Word::X));
        while self.tokens.get(self.at).is_some_and(|token| token.start < end) {
            self.at += 1;
        }
        true
    }
}

/// The colour that `rest` begins with, and its text. Three letters are rather a misspelt directive, but
/// after the word of a colour.
pub(in crate::syntax) fn color_at(rest: &str, before: Option<TokenKind>) -> Option<(&str, Rgb)> {
    let digits = rest.strip_prefix('#')?.bytes();
    let digits = digits.take_while(|b| b.is_ascii_alphanumeric() || *b == b'_').count();
    let text = &rest[..=digits];
    let certain = text.len() > 4 || text.contains(|c: char| c.is_ascii_digit());
    let color = web(text).filter(|_| certain || after_color(before).is_some())?;
    Some((text, color))
}

fn after_color(before: Option<TokenKind>) -> Option<Word> {
    match before? {
        TokenKind::Word(word) => (word.family() == Family::Color).then_some(word),
        _ => None,
    }
}
