//! Diagnostics for a light's colour or direction in the wrong order.
//!
//! **Invariant:** a late or early colour causes no second error.

use crate::diagnostic::{Code, Diagnostic};
use crate::scene::{LightKind, LightSource};
use crate::source::{Site, Span};
use crate::vocabulary::{Family, Word};

use super::super::super::stream::{Token, TokenKind};
use super::super::super::{Evaluator, Outcome, Reported};
use super::is_of_a_place;

/// A light's colour that is missing from its position; it may follow other words.
pub(super) struct Late {
    opener: Token,
    /// The item in its position; `None` at the end of the block.
    found: Option<Token>,
    /// The end of the item before that.
    place: Site,
}

impl Late {
    /// Returns whether the block ends where the colour is expected.
    pub fn ends_block(&self) -> bool {
        self.found.is_none()
    }
}

impl Evaluator<'_> {
    pub(in crate::evaluate::block) fn at_color_word(&mut self) -> bool {
        let next = self.peek().map(|token| &token.kind);
        matches!(next, Some(TokenKind::Word(word)) if word.family() == Family::Color)
    }

    /// Returns a record of the missing colour if none follows a light's position.
    pub(super) fn late_color(&mut self, opener: &Token) -> Option<Late> {
        let before = self.taken?;
        let found = self.peek().cloned();
        let is_late = found.as_ref().is_none_or(|found| {
            is_of_a_place(found) || found.kind == TokenKind::Word(Word::Shadowless)
        });
        let place = Site { span: before.span.after(), ..before };
        is_late.then(|| Late { opener: opener.clone(), found, place })
    }

    /// Reads the colour, which should have followed the light's position.
    pub(super) fn take_late_color(
        &mut self,
        token: &Token,
        late: Option<Late>,
        light: Option<&mut LightSource>,
    ) -> Outcome<()> {
        let color = self.color_from(token)?;
        // Without a light there has been an error already.
        let Some(light) = light else { return Err(Reported) };
        let Some(late) = late else {
            let diagnostic = Diagnostic::new(Code::ExtraPart, "this light has a colour already")
                .at(token.span, "expected one colour, right after the light's place");
            return Err(self.report(&token.here, diagnostic));
        };
        light.color = color.rgb;
        let site = self.whole(token);
        let after = match light.kind {
            LightKind::Direction { .. } => "direction",
            _ => "place",
        };
        let mut diagnostic = Diagnostic::new(
            Code::MissingPart,
            format!("the colour of a light stands right after its {after}"),
        )
        .at(site.span, "expected before the light's other words")
        .also(late.place.span, "it belongs here");
        let text = self.sources.text(site.span);
        let movable = late.place.expansion == site.expansion
            && late.place.span.file == site.span.file
            && !self.sources.text(late.place.span.to(site.span)).contains('#');
        if movable {
            let text = format!(", {text}");
            diagnostic = diagnostic.fix(late.place.span, text).fix(site.span, "");
        }
        Err(self.report(&token.here, diagnostic))
    }

    /// Reports that the light has no colour.
    pub(super) fn no_color(&mut self, late: &Late) -> Outcome<()> {
        if self.poison.is_some() {
            return Ok(());
        }
        let name = self.describe(&late.opener);
        let found = match &late.found {
            Some(found) => format!(", found {}", self.describe(found)),
            // It is taken and reported after the block.
            None if self.closer_before_color().is_some() => return Err(Reported),
            None => String::new(),
        };
        let mut diagnostic = Diagnostic::new(
            Code::MissingPart,
            format!("expected a colour for the light after {name}{found}"),
        )
        .also(late.opener.span, "for this");
        diagnostic = match &late.found {
            Some(found) => diagnostic.at(found.span, "expected a colour for the light"),
            None => {
                let sign = self.sources.sign_before(late.place.span);
                diagnostic.at(sign, "expected a colour for the light after this")
            }
        };
        diagnostic = diagnostic.help(format!(
            "behind {} write a colour such as `rgb 1`",
            self.before(late.place.span)
        ));
        if late.ends_block() && late.place.expansion == late.opener.here.expansion {
            diagnostic = diagnostic.fix(late.place.span, ", rgb 1");
        }
        self.opinion(&late.opener.here, diagnostic)
    }

    /// Returns the end of the line before a position, in backticks.
    fn before(&self, place: Span) -> String {
        let text = &self.sources.get(place.file).text;
        let before = text.get(..place.start as usize).unwrap_or("");
        let piece = before.rfind(['{', '\n']).map_or(before, |at| &before[at + 1..]).trim();
        if piece.is_empty() { "its place".to_owned() } else { format!("`{piece}`") }
    }

    /// Reads a light whose colour precedes the position or the direction: `light_source { rgb 1 <1, 2, 3> }`.
    pub(super) fn color_before_place(&mut self, opener: &Token) -> Outcome<LightSource> {
        let Some(first) = self.next() else { return Err(Reported) };
        let color = self.color_from(&first);
        let colored = self.whole(&first);
        self.skip_commas();
        let next = self.peek().cloned();
        let is_place = match next.as_ref().map(|next| &next.kind) {
            Some(TokenKind::Word(word)) => *word == Word::Direction,
            Some(TokenKind::Expression(_) | TokenKind::Literal(_)) => true,
            _ => false,
        };
        let Some(next) = next.filter(|_| is_place && color.is_ok()) else {
            color?;
            let (name, found) = (self.describe(opener), self.describe(&first));
            let message =
                format!("expected a vector for the light's place after {name}, found {found}");
            let diagnostic = Diagnostic::new(Code::MissingPart, message)
                .at(first.span, "expected a vector for the light's place")
                .also(opener.span, "for this")
                .help(Word::LightSource.sentence());
            return Err(self.report(&first.here, diagnostic));
        };
        let kind = self.light_place(opener)?;
        let placed = self.whole(&next);
        let what = match kind {
            LightKind::Direction { .. } => "direction",
            _ => "place",
        };
        let message = format!("the {what} of a light stands first, and then its colour");
        let mut diagnostic = Diagnostic::new(Code::MissingPart, message)
            .at(placed.span, "expected before the colour")
            .also(colored.span, "the colour");
        let all = colored.span.to(placed.span);
        let movable = colored.expansion == placed.expansion
            && colored.span.file == placed.span.file
            && !self.sources.text(all).contains('#');
        if movable {
            let [place, color] = [placed, colored].map(|site| self.sources.text(site.span));
            let swapped = format!("{place}, {color}");
            diagnostic = diagnostic.help(format!("write `{swapped}`")).fix(all, swapped);
        }
        Err(self.report(&next.here, diagnostic))
    }

    /// Reports a `direction` after the position or another direction.
    pub(super) fn second_direction(
        &mut self,
        token: &Token,
        light: Option<&LightSource>,
    ) -> Outcome<()> {
        let before = self.told();
        self.skip_values();
        self.take_back(before);
        let (message, label) = match light.map(|light| &light.kind) {
            // Without a light there has been an error already.
            None => return Err(Reported),
            Some(LightKind::Direction { .. }) => {
                ("this light has a `direction` already", "expected one")
            }
            Some(_) => (
                "a light has a place or a `direction`, not both",
                "a direction stands first, instead of the place",
            ),
        };
        let diagnostic = Diagnostic::new(Code::ExtraPart, message)
            .at(token.span, label)
            .help("`light_source { <place>, rgb 1 }` or `light_source { direction <…>, rgb 1 }`");
        Err(self.report(&token.here, diagnostic))
    }
}
