//! `#ff8000`: a colour as the web writes it.

use super::Reader;
use crate::color::{Rgb, web};
use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::syntax::token::{Token, TokenKind};
use crate::vocabulary::{Family, Word};

impl Reader<'_> {
    /// Takes `#` and its digits, which are tokens of many kinds.
    pub(super) fn web_color(&mut self, meant: &mut Vec<Token>) -> bool {
        let token = self.tokens[self.at];
        let rest = self.text.get(token.start as usize..).unwrap_or("");
        let before = meant.last().map(|token| token.kind);
        let Some((text, color)) = color_at(rest, before) else { return false };
        let bare = after_color(before).is_some_and(|word| word != Word::Color);
        let end = token.start + text.len() as u32;
        let span = Span { end, ..self.span(0, 0) };
        let ours = if bare { color.to_string() } else { format!("rgb {color}") };
        let diagnostic =
            Diagnostic::new(Code::ForeignWord, format!("`{text}` is how the web writes a colour"))
                .at(span, "expected numbers from 0 to 1, linear in light")
                .help(format!("write `{ours}`"))
                .fix(span, ours);
        self.diagnostics.push(diagnostic);
        // Any colour stands in for it: nothing is drawn after a mistake.
        let word = |word| Token { kind: TokenKind::Word(word), end, ..token };
        if !bare {
            meant.push(word(Word::Rgb));
        }
        meant.push(word(Word::X));
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
