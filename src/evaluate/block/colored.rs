//! Diagnostics for a pigment or a pattern where a single colour is expected: `light_source { 0, pigment { rgb
//! 1 } }`, `background { gradient y }`.

use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::vocabulary::{Family, Word};

use super::super::stream::{Token, TokenKind};
use super::super::{Evaluator, Reported};

impl Evaluator<'_> {
    /// Reports a pigment or a pattern that comes next where the colour of `after` is expected, and skips it.
    pub(super) fn paint_for_color(&mut self, after: &Token) -> Option<Reported> {
        let TokenKind::Word(of) = after.kind else { return None };
        let next = self.peek()?.clone();
        let TokenKind::Word(word) = next.kind else { return None };
        self.next_is_paint(of, word)?;
        self.next();
        let is_pigment = word == Word::Pigment && self.is_before_block();
        self.skip_arguments(word);
        let whole = self.whole(&next).span;
        let inside = match is_pigment {
            true => self.sources.text(whole).split_once('{').map_or("", |(_, rest)| rest),
            false => word.name(),
        };
        let inside = inside.trim_end_matches('}').trim().to_owned();
        let first = inside.split(|c: char| !c.is_ascii_alphanumeric() && c != '_').next();
        let first = first.and_then(Word::from_name).map(Word::family);
        let name = of.name();
        let message = format!("the colour of a `{name}` stands by itself");
        let told = Diagnostic::new(Code::WrongType, message);
        let told = match first {
            Some(Family::Color) if !inside.contains(['{', '#', '/']) => told
                .at(next.span, "expected a colour, without `pigment`")
                .help(format!("write `{inside}`"))
                .fix(whole, inside),
            Some(Family::Pattern) if of == Word::Background => self.sky_instead(told, next.span),
            _ => told.at(next.span, "expected a colour"),
        };
        Some(self.report(&next.here, told))
    }

    /// Returns whether `word` begins a pigment where `of` takes one colour.
    fn next_is_paint(&self, of: Word, word: Word) -> Option<()> {
        let takes_color =
            matches!(of, Word::LightSource | Word::Background) || of.family() == Family::FinishItem;
        let is_paint =
            word == Word::Pigment || of == Word::Background && word.family() == Family::Pattern;
        (takes_color && is_paint).then_some(())
    }

    /// Suggests `sky_sphere`, which has patterns: `background { gradient y color_map { … } }`.
    fn sky_instead(&self, told: Diagnostic, at: Span) -> Diagnostic {
        let told = told.at(at, "a background is one colour");
        let (Some(&opener), Some(inside)) = (self.openers.last(), self.within_block()) else {
            return told;
        };
        let text = self.sources.text(inside.span);
        let is_pigment = text.trim_start().starts_with(Word::Pigment.name());
        let told = told
            .help("a sky of several: `sky_sphere { pigment { gradient y … } }`")
            .fix(opener, Word::SkySphere.name());
        if is_pigment {
            return told;
        }
        let begin = Span { end: inside.span.start, ..inside.span };
        told.fix(begin, " pigment {").fix(inside.span.after(), "} ")
    }
}
