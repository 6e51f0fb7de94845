//! The items of unsupported blocks, with the number of values each takes, to report the mistakes in them.
//!
//! **Source:** POV-Ray 3.7 manual, 3.4.3.3 "Radiosity", 3.4.7 "Patterns", 3.4.8.1 "Media", 3.4.8.2 "Photons",
//! and what the program refuses.

use crate::diagnostic::{Code, Diagnostic, suggest};
use crate::source::Span;
use crate::syntax::ast::ExpressionId;
use crate::vocabulary::{Dialect, Family, Word};

use super::super::super::stream::{Token, TokenKind};
use super::super::super::{Evaluator, Outcome};
use super::super::Place;
use super::super::place::home;
use super::ranges;

/// Returns the minimum and maximum number of values after an item of `block`.
fn numbers(item: Word, block: Word) -> Option<(usize, usize)> {
    use Word as W;
    Some(match (block, item) {
        (W::Radiosity, W::Count | W::NearestCount) => (1, 2),
        (W::Radiosity, W::AlwaysSample | W::Subsurface) => (0, 1),
        (W::Radiosity, item) if home(item) == Some(W::Radiosity) => (1, 1),
        (W::Radiosity, W::AdcBailout | W::MaxTraceLevel) => (1, 1),
        (W::Photons, W::Gather | W::ExpandThresholds) => (2, 2),
        (W::Photons, W::Spacing | W::Count | W::Autostop) => (1, 1),
        (W::Photons, W::Jitter | W::MaxTraceLevel | W::AdcBailout) => (1, 1),
        (W::Photons, W::Media) => (1, 2),
        (W::Photons, W::Radius) => (0, 4),
        (W::Photons, W::Target | W::Refraction | W::Reflection) => (0, 1),
        (W::Photons, W::Collect | W::PassThrough | W::AreaLight) => (0, 1),
        (W::Media, W::Intervals | W::Confidence | W::Variance | W::Ratio | W::Method) => (1, 1),
        (W::Media, W::Jitter | W::AaLevel | W::AaThreshold) => (1, 1),
        (W::Media, W::Samples) => (1, 2),
        (W::Scattering, W::Eccentricity | W::Extinction) => (1, 1),
        _ => return None,
    })
}

/// Returns whether an item that is not specific to a block is valid in it.
fn is_also_of(item: Word, block: Word) -> bool {
    match block {
        Word::Normal => Place::NORMAL.holds(item) || matches!(item, Word::SlopeMap | Word::BumpMap),
        Word::ImageMap => Place::IMAGE.holds(item),
        Word::Media => item == Word::Density || item.family() == Family::Transform,
        Word::Radiosity => item == Word::Normal || item == Word::Media,
        _ => false,
    }
}

/// Returns whether an item of `block` takes a colour.
fn takes_color(item: Word, block: Word) -> bool {
    block == Word::Media && matches!(item, Word::Absorption | Word::Emission)
}

impl Evaluator<'_> {
    /// Returns whether the items of an unsupported block are known.
    pub(in crate::evaluate::block) fn knows_items(block: Word) -> bool {
        matches!(block, Word::Radiosity | Word::Photons | Word::Media | Word::Scattering)
    }

    /// Reads the items of an unsupported block.
    pub(in crate::evaluate::block) fn items_not_built(&mut self, opener: &Token, block: Word) {
        if block == Word::Scattering {
            self.scattering(opener);
        }
        while let Some(token) = self.next() {
            match token.kind {
                TokenKind::Word(item) => self.item_not_built(&token, item, block),
                TokenKind::Expression(id) => {
                    if !self.misspelt_item(&token, id, block) {
                        self.run_expression(&token.here, id);
                    }
                }
                TokenKind::Block(contents) => {
                    self.inside_block(&token.here, contents, token.span, Self::run_items);
                }
                TokenKind::Entry(items) => self.inside(&token.here, items, Self::run_items),
                TokenKind::Comma | TokenKind::Semicolon | TokenKind::Literal(_) => {}
            }
        }
    }

    fn item_not_built(&mut self, token: &Token, item: Word, block: Word) {
        if takes_color(item, block) {
            let outer = self.poison.take();
            let read: Outcome<()> = self.color_after(token, "a colour").map(drop);
            self.poison = outer;
            if read.is_err() {
                self.skip_values();
            }
            return;
        }
        if item == Word::ColorMap {
            let outer = self.poison.take();
            let read = self.color_map(token).map(drop);
            self.poison = outer;
            return read.unwrap_or(());
        }
        if block == Word::Radiosity && item == Word::Samples {
            let place = Place { word: Some(block), families: &[], others: &[Word::Count] };
            self.unexpected_word(token, item, place);
            return;
        }
        let Some((least, most)) = numbers(item, block).filter(|_| !self.is_before_block()) else {
            return self.pass_not_built(token, item);
        };
        self.numbers_not_built(token, item, block, (least, most));
    }

    /// Reads the numbers after an unsupported item.
    fn numbers_not_built(
        &mut self,
        token: &Token,
        item: Word,
        block: Word,
        (least, most): (usize, usize),
    ) {
        let outer = self.poison.take();
        let mut range = ranges::of_item(item, block);
        for count in 0..most {
            if count >= least && !self.is_before_value() {
                break;
            }
            let read = match range.take() {
                Some(range) => self.number_after(token, "a number").map(|given| {
                    self.within(&given, item, &range);
                }),
                None => self.unbuilt_part(token, "a number"),
            };
            if read.is_err() {
                self.poison = outer;
                return;
            }
        }
        self.poison = outer;
        if !self.is_before_value() {
            return;
        }
        let Some(extra) = self.next() else { return };
        // `fog { distance 200 White }`: a colour is an item of its own.
        let value = match &extra.kind {
            TokenKind::Expression(id) => self.expression(&extra.here, *id).ok(),
            TokenKind::Literal(value) => Some(value.as_ref().clone()),
            _ => None,
        };
        if value.is_none_or(|value| value.as_number().is_none()) {
            return;
        }
        let name = item.name();
        let takes = match most {
            1 => "one number".to_owned(),
            most => format!("{most} numbers"),
        };
        let message = format!("`{name}` takes {takes}, and here is one more");
        let diagnostic = Diagnostic::new(Code::WrongArity, message);
        let diagnostic = match self.comma_before(extra.span) {
            Some((span, number)) => diagnostic
                .at(span, "two numbers, and not one with a fraction")
                .help(format!("a fraction is written with a point: `{number}`"))
                .fix(span, number),
            None => diagnostic.at(extra.span, "one too many").also(token.span, "for this"),
        };
        self.report(&token.here, diagnostic);
        self.skip_values();
    }

    /// Returns whether a value comes next, with or without a comma before it; an undeclared name does not
    /// count.
    pub(in crate::evaluate::block) fn is_before_value(&mut self) -> bool {
        self.skip_commas();
        match self.peek().cloned() {
            Some(Token { kind: TokenKind::Expression(id), here, .. }) => {
                self.unknown_name(&here, id).is_none()
            }
            Some(Token { kind: TokenKind::Literal(_), .. }) => true,
            _ => false,
        }
    }

    /// Reads a kind and a colour: `scattering { 1, rgb 0.5 … }`.
    fn scattering(&mut self, opener: &Token) {
        let lacks_kind = match self.peek().cloned() {
            Some(Token { kind: TokenKind::Word(word), here, span })
                if word.family() == Family::Color =>
            {
                Some((here, span))
            }
            _ => None,
        };
        let outer = self.poison.take();
        if let Some((here, span)) = lacks_kind {
            let message = "`scattering` begins with its kind, a number from 1 to 5";
            let diagnostic = Diagnostic::new(Code::MissingPart, message)
                .at(opener.span, "the kind of this is not said")
                .also(span, "expected a number before the colour")
                .help("1 scatters alike to all sides: `scattering { 1, rgb … }`")
                .fix(Span { end: span.start, ..span }, "1, ");
            self.report(&here, diagnostic);
        } else if let Ok(kind) = self.number_after(opener, "a number from 1 to 5 for the kind")
            && !(1.0..6.0).contains(&kind.value)
            && self.options.dialect == Dialect::Scene
        {
            self.out_of_range(&kind, Word::Scattering, "a kind from 1 to 5");
        }
        let read: Outcome<()> = self.color_after(opener, "a colour").map(drop);
        if read.is_err() {
            self.skip_values();
        }
        self.poison = outer;
    }

    /// Reports an undeclared name that resembles a word of the block: `extinct 0.9`.
    pub(in crate::evaluate::block) fn misspelt_item(
        &mut self,
        token: &Token,
        id: ExpressionId,
        block: Word,
    ) -> bool {
        if self.unknown_name(&token.here, id).is_none() {
            return false;
        }
        let name = self.sources.text(token.span).to_owned();
        let of_block = |word: &&Word| {
            home(**word) == Some(block)
                || numbers(**word, block).is_some()
                || is_also_of(**word, block)
        };
        let words = || Word::ALL.iter().filter(of_block).map(|word| word.name());
        let near = suggest::reworded(&name, words())
            .or_else(|| suggest::closest(&name, words()))
            .or_else(|| suggest::abridged(&name, words()))
            .or_else(|| suggest::begun(&name, words()))
            .or_else(|| suggest::short_of(&name, words()));
        let Some(near) = near else { return false };
        let message = format!("`{name}` is not a word in `{}`", block.name());
        let diagnostic = Diagnostic::new(Code::UnknownWord, message)
            .at(token.span, format!("did you mean `{near}`?"))
            .help(format!("replace it with `{near}`"))
            .fix(token.span, near);
        self.report(&token.here, diagnostic);
        match Word::from_name(near) {
            Some(word) => {
                let token = Token { kind: TokenKind::Word(word), ..token.clone() };
                self.item_not_built(&token, word, block);
            }
            None => self.skip_values(),
        }
        true
    }
}
