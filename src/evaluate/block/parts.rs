//! Blocks whose items come in any order: one reader for all of them, and one line for each plain word.
//!
//! **In:** a block's list of [`Part`]s. **Out:** the block, with each value stored. **Invariant:** an item that
//! is no part is inert, transforms the block, or is reported for its [`Place`].

use crate::color::Rgb;
use crate::evaluate::stream::{Token, TokenKind};
use crate::evaluate::value::Value;
use crate::evaluate::{Evaluator, Outcome, Reported};
use crate::math::Vector;
use crate::scene::TransformId;
use crate::source::Site;
use crate::syntax::ast::ExpressionId;
use crate::vocabulary::{Family, Word};

use super::Place;
use super::range::Range;

/// A block during reading.
pub(super) trait Block: Sized + 'static {
    const PLACE: Place;
    const PARTS: Parts<Self>;

    /// Goes on from a declared value; returns `false` if the block cannot begin with one of this kind.
    fn inherit(&mut self, _: &Evaluator, _: &Value) -> bool {
        false
    }

    /// Moves the block, if its place allows transforms.
    fn transform(&mut self, _: &mut Evaluator, _: TransformId, _: Site) {}

    /// Reads an item that is neither a part nor a declared value of the block; `None` for other items.
    fn other(&mut self, _: &mut Evaluator, _: &Token) -> Option<Outcome<()>> {
        None
    }

    /// Records that the part `word` was read.
    fn after(&mut self, _: &mut Evaluator, _: &Token, _: Word) {}
}

/// The parts of a block.
pub(super) type Parts<B> = &'static [Part<B>];

/// A word, what follows it, and where that is stored: the function receives the block, the value, and the site
/// of the entire item.
pub(super) enum Part<B> {
    /// A word alone.
    Flag(Word, Set<B, ()>),
    /// A number that may be missing: then 1, which is also `on`.
    Optional(Word, Set<B, f64>),
    Number(Word, Set<B, f64>),
    Ranged(Word, Range, Set<B, f64>),
    /// A number that stands for a choice, without its fraction: the list of those for which the function does
    /// not return `None`.
    Choice(Word, &'static str, fn(&mut B, u32) -> Option<()>),
    /// A colour, or a number for a gray, with its description.
    Color(Word, &'static str, Set<B, Rgb>),
    /// A vector, with its description.
    Vector(Word, &'static str, Set<B, Vector>),
    /// A vector that should not be zero, with its description.
    Direction(Word, &'static str, Set<B, Vector>),
    /// What the function reads by hand.
    Special(Word, fn(&mut Evaluator, &Token, &mut B) -> Outcome<()>),
}

type Set<B, T> = fn(&mut B, T, Site);

impl<B> Part<B> {
    fn word(&self) -> Word {
        match self {
            Self::Flag(word, _)
            | Self::Optional(word, _)
            | Self::Number(word, _)
            | Self::Ranged(word, ..)
            | Self::Choice(word, ..)
            | Self::Color(word, ..)
            | Self::Vector(word, ..)
            | Self::Direction(word, ..)
            | Self::Special(word, _) => *word,
        }
    }
}

impl Evaluator<'_> {
    /// Reads the items up to the end of a block.
    pub(super) fn parts<B: Block>(&mut self, block: &mut B) -> Outcome<()> {
        let mut failed = false;
        while let Some(token) = self.next() {
            failed |= self.part(&token, block).is_err();
        }
        if failed { Err(Reported) } else { Ok(()) }
    }

    /// Reads one item of a block; skips its values if it is wrong.
    pub(super) fn part<B: Block>(&mut self, token: &Token, block: &mut B) -> Outcome<()> {
        let contextual = B::PLACE.word.and_then(|of| self.contextual_word(token, of));
        let meant = contextual.map(|word| Token { kind: TokenKind::Word(word), ..token.clone() });
        let token = meant.as_ref().unwrap_or(token);
        let listed = match token.kind {
            TokenKind::Word(word) => self.listed_part(token, word, block),
            _ => None,
        };
        let read = listed.unwrap_or_else(|| self.item_of(token, block));
        if read.is_err() {
            self.skip_values();
        }
        read
    }

    /// Reads a word that is in the list of a block; `None` for other words.
    pub(super) fn listed_part<B: Block>(
        &mut self,
        token: &Token,
        word: Word,
        block: &mut B,
    ) -> Option<Outcome<()>> {
        let part = B::PARTS.iter().find(|part| part.word() == word)?;
        let read = self.value_of_part(token, part, block);
        Some(read.map(|()| block.after(self, token, word)))
    }

    fn value_of_part<B: Block>(
        &mut self,
        token: &Token,
        part: &Part<B>,
        block: &mut B,
    ) -> Outcome<()> {
        match part {
            Part::Flag(_, set) => set(block, (), self.whole(token)),
            Part::Optional(_, set) => {
                set(block, self.optional_number(token, 1.0)?, self.whole(token))
            }
            Part::Number(_, set) => {
                set(block, self.number_after(token, "a number")?.value, self.whole(token));
            }
            Part::Ranged(word, range, set) => {
                set(block, self.number_in(token, *word, range)?, self.whole(token));
            }
            Part::Choice(word, wanted, set) => {
                let given = self.number_after(token, wanted)?;
                let number = (given.value > -1.0).then_some(given.value as u32);
                if number.and_then(|number| set(block, number)).is_none() {
                    return Err(self.out_of_range(&given, *word, wanted));
                }
            }
            Part::Color(_, what, set) => {
                set(block, self.color_after(token, what)?.value.rgb, self.whole(token));
            }
            Part::Vector(_, what, set) => {
                set(block, self.vector_after(token, what)?.value, self.whole(token));
            }
            Part::Direction(_, what, set) => {
                set(block, self.any_direction_after(token, what)?.value, self.whole(token));
            }
            Part::Special(_, read) => read(self, token, block)?,
        }
        Ok(())
    }

    /// Reads an item that is no part of the block.
    fn item_of<B: Block>(&mut self, token: &Token, block: &mut B) -> Outcome<()> {
        if B::PLACE.families.contains(&Family::Transform)
            && let Some(transform) = self.transform_from(token)
        {
            block.transform(self, transform?, token.here.site(token.span));
            return Ok(());
        }
        if let TokenKind::Expression(id) = token.kind {
            match self.declared_item(token, id, B::PLACE) {
                Err(read) => return read,
                Ok(Some(value)) if block.inherit(self, &value) => return Ok(()),
                Ok(_) => {}
            }
        }
        match block.other(self, token) {
            Some(read) => read,
            None => self.other_item(token, B::PLACE),
        }
    }

    /// Returns the value of a declared item. Fails with the result of reading it if its value is missing.
    pub(super) fn declared_item(
        &mut self,
        token: &Token,
        id: ExpressionId,
        place: Place,
    ) -> Result<Option<Value>, Outcome<()>> {
        match self.declared(token, id) {
            Some(Value::Broken) => {
                self.broken_of_place(token, id, place);
                Err(Err(Reported))
            }
            Some(Value::Poison(poison)) => {
                self.is_of_place(token, poison, place);
                self.set_poison(poison);
                Err(Ok(()))
            }
            value => Ok(value),
        }
    }

    /// Returns the value that `read` reads, or the poison in it.
    pub(super) fn value_or_poison(
        &mut self,
        read: impl FnOnce(&mut Self) -> Outcome<Value>,
    ) -> Outcome<Value> {
        let outer = self.poison.take();
        let read = read(self);
        match std::mem::replace(&mut self.poison, outer) {
            Some(poison) => {
                self.set_poison(poison);
                Ok(Value::Poison(poison))
            }
            None => read,
        }
    }

    /// Reads an inert item, or reports one that the place does not accept: a mistake, unless it belongs to
    /// something unsupported.
    pub(super) fn other_item(&mut self, token: &Token, place: Place) -> Outcome<()> {
        if let Some(outcome) = self.inert(token, place) {
            return outcome;
        }
        let poisoned = self.poison.is_some();
        self.unexpected(token, place);
        let harmless = matches!(token.kind, TokenKind::Comma | TokenKind::Semicolon);
        if harmless || poisoned || self.poison.is_some() { Ok(()) } else { Err(Reported) }
    }
}
