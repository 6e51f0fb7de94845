//! Diagnostics for a misplaced kind of light: before the position, with braces of its own, or as `point`; and
//! for a light that is closed before its colour.
//!
//! **Invariant:** the misplaced items are read as they were meant, so that no further error is reported for
//! them.

use crate::diagnostic::{Code, Diagnostic};
use crate::scene::LightSource;
use crate::source::Span;
use crate::vocabulary::Word;

use super::super::super::stream::{Token, TokenKind};
use super::super::super::{Evaluator, Outcome, Reported};
use super::order::Late;

impl Evaluator<'_> {
    /// Reads a light that begins with its kind: `light_source { spotlight <1, 2, 3> rgb 1 … }`, `light_source
    /// { point <1, 2, 3> … }`.
    pub(super) fn light_by_kind(
        &mut self,
        opener: &Token,
    ) -> Option<(Outcome<LightSource>, Option<Late>)> {
        let first = self.peek()?.clone();
        let kind = match first.kind {
            TokenKind::Word(word @ (Word::Parallel | Word::Spotlight | Word::Cylinder)) => {
                Some(word)
            }
            _ if self.is_all_around(&first) => None,
            _ => return None,
        };
        self.next();
        self.skip_commas();
        let next = self.peek().map(|next| next.span);
        let before = match next.filter(|next| next.file == first.span.file) {
            Some(next) if next.start > first.span.end => Span { end: next.start, ..first.span },
            _ => first.span,
        };
        let Some(kind) = kind else {
            let name = self.sources.text(first.span);
            let message = format!("`{name}` is not a word in `light_source`");
            let told = Diagnostic::new(Code::ForeignWord, message)
                .at(first.span, "without a word a light shines all around")
                .help("leave it out")
                .fix(before, "");
            let reported = self.report(&first.here, told);
            let (_, late) = self.light_parts(opener);
            return Some((Err(reported), late));
        };
        let place = self.light_place(opener);
        self.semicolon_for_comma();
        let color = self.color_after(opener, "a colour for the light");
        if place.is_err() || color.is_err() {
            return Some((Err(Reported), None));
        }
        let name = kind.name();
        let message = format!("`{name}` stands behind the place and the colour of a light");
        let mut told = Diagnostic::new(Code::MissingPart, message)
            .at(first.span, "expected behind the colour")
            .help(format!("`light_source {{ <place>, rgb 1 {name} … }}`"));
        let end = self.taken.filter(|taken| taken.expansion == first.here.expansion);
        if let Some(end) = end.filter(|end| end.span.file == first.span.file) {
            told = told.fix(before, "").fix(end.span.after(), format!(" {name}"));
        }
        Some((Err(self.report(&first.here, told)), None))
    }

    /// Reads a kind with braces of its own: `spotlight { point_at 0 radius 10 }`.
    pub(super) fn kind_without_braces(&mut self, token: &Token) -> Outcome<()> {
        let Some(Token { kind: TokenKind::Block(contents), here, span }) =
            self.next_if(|kind| matches!(kind, TokenKind::Block(_)))
        else {
            return Ok(());
        };
        let name = self.sources.text(token.span);
        let brace = |start: u32| Span { start, end: start + 1, ..span };
        let told = Diagnostic::new(Code::ExtraPart, format!("`{name}` takes no braces"))
            .at(brace(span.start), "its words stand beside it")
            .help("leave the braces out");
        let told = match self.sources.text(span).ends_with('}') {
            true => told.fix(brace(span.start), "").fix(brace(span.end - 1), ""),
            false => told,
        };
        let reported = self.report(&token.here, told);
        let before = self.told();
        self.inside_block(&here, contents, span, Self::run_items);
        self.take_back(before);
        Err(reported)
    }

    /// Returns the `}` of the block being read, if a colour follows it: `{ <1, 2, 3> } rgb 1`.
    pub(super) fn closer_before_color(&self) -> Option<Span> {
        let block = self.blocks.last()?.span;
        if !self.sources.text(block).ends_with('}') {
            return None;
        }
        let text = self.sources.get(block.file).text.get(block.end as usize..)?;
        let line = text.trim_start_matches([' ', '\t', ',']);
        let word = line.split(|c: char| !c.is_ascii_alphanumeric()).next();
        let is_color = matches!(word, Some("rgb" | "srgb" | "color" | "colour"));
        is_color.then_some(Span { start: block.end - 1, ..block })
    }

    /// Takes the colour after the block of a light that `closer` ends, and reports it.
    pub(super) fn color_behind_light(&mut self, token: &Token, closer: Span) -> Reported {
        self.skip_commas();
        self.skip_color(token);
        let end = self.whole(token).span;
        let told = Diagnostic::new(Code::MissingPart, "this light is closed before its colour")
            .at(closer, "closed here")
            .also(token.span, "this light")
            .help("move the `}` behind the colour");
        let told = match end.start == token.span.start && closer.end < end.end {
            true => told.fix(closer, "").fix(end.after(), " }"),
            false => told,
        };
        self.report(&token.here, told)
    }
}
