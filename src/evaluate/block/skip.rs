//! Skipping of what belongs to a reported mistake, while running its directives and calls.
//!
//! **Invariant:** skipped items cause no second error, except for undeclared names.

use crate::syntax::ast::{Callee, ExpressionId, ExpressionKind};
use crate::vocabulary::{Family, Word};

use super::super::scope::Symbol;
use super::super::stream::{Token, TokenKind};
use super::super::{Evaluator, Here};
use super::Place;
use super::place::{home, is_at_top_level};

impl Evaluator<'_> {
    pub(in crate::evaluate) fn is_before_block(&mut self) -> bool {
        matches!(self.peek().map(|next| &next.kind), Some(TokenKind::Block(_)))
    }

    /// Skips what was written instead of a block: `(…) { … }`, `[…] […]`, `phong 1`, a colour.
    pub(super) fn skip_missing_block(&mut self, token: &Token) {
        let before = self.told();
        self.skip_values();
        self.skip_color(token);
        while let Some(Token { kind: TokenKind::Entry(_), .. }) = self.peek() {
            self.next();
        }
        match self.peek().map(|next| &next.kind) {
            Some(TokenKind::Block(_)) => self.skip_arguments(Word::Union),
            // `camera location … look_at …`
            Some(TokenKind::Word(next)) if matches!(token.kind, TokenKind::Word(word) if home(*next) == Some(word)) => {
                while let Some(&Token { kind: TokenKind::Word(next), .. }) = self.peek()
                    && matches!(token.kind, TokenKind::Word(word) if home(next) == Some(word))
                {
                    self.next();
                    self.skip_arguments(next);
                }
            }
            Some(TokenKind::Word(next)) if next.family() == Family::FinishItem => {
                let next = *next;
                self.next();
                self.skip_arguments(next);
            }
            _ => {}
        }
        self.take_back(before);
    }

    /// Skips a colour that was the value of an unknown word.
    pub(super) fn skip_color(&mut self, after: &Token) {
        if let Some(Token { kind: TokenKind::Word(word), .. }) = self.peek()
            && word.family() == Family::Color
        {
            let before = self.told();
            let _ = self.color_after(after, "a colour");
            self.take_back(before);
        }
    }

    /// Skips the rest of parts that were reported. An undeclared name is an error of its own, and is not
    /// skipped.
    pub(super) fn skip_parts(&mut self) {
        let before = self.told();
        while let Some(token) = self.peek().cloned() {
            match token.kind {
                TokenKind::Word(_) | TokenKind::Semicolon => break,
                TokenKind::Expression(id) => {
                    if let ExpressionKind::Name(name) = token.here.unit.expression(id).kind
                        && self.is_no_part(token.here.symbol(name))
                    {
                        break;
                    }
                    self.next();
                    self.run_expression(&token.here, id);
                }
                TokenKind::Block(contents) => {
                    self.next();
                    self.inside_block(&token.here, contents, token.span, Self::run_items);
                }
                TokenKind::Entry(items) => {
                    self.next();
                    self.inside(&token.here, items, Self::run_items);
                }
                TokenKind::Literal(_) | TokenKind::Comma => drop(self.next()),
            }
        }
        self.take_back(before);
    }

    /// Returns whether a name is probably the next mistake, not a part of a shape.
    fn is_no_part(&self, symbol: Symbol) -> bool {
        use super::super::value::Value;
        match self.scopes.look(symbol) {
            None => self.scopes.slot(symbol).is_none(),
            Some(Value::Texture(_) | Value::Pigment(_) | Value::Finish(_) | Value::Object(_)) => {
                true
            }
            Some(_) => false,
        }
    }

    /// As [`Self::skip_parts`], for the rest of a shape, including the words that are valid only as its
    /// parts.
    pub(super) fn skip_shape_parts(&mut self) {
        self.skip_parts();
        while let Some(&Token { kind: TokenKind::Word(word), .. }) = self.peek()
            && word.family() == Family::ShapeItem
        {
            let before = self.told();
            self.next();
            self.skip_arguments(word);
            self.take_back(before);
            self.skip_parts();
        }
    }

    /// Skips, as the same mistake, the items beside a word that belong with it in the block of `own`:
    /// `sky_sphere { gradient y color_map { … } }`.
    pub(super) fn skip_of_home(&mut self, own: Word, place: Place) -> Vec<String> {
        let stands = |word| match place.word {
            Some(_) => place.holds(word),
            None => is_at_top_level(word),
        };
        let mut beside = Vec::new();
        while let Some(&Token { kind: TokenKind::Word(word), .. }) = self.peek()
            && home(word) == Some(own)
            && !stands(word)
        {
            self.next();
            self.skip_arguments(word);
            beside.push(format!("`{}`", word.name()));
        }
        beside
    }

    /// Returns the name that an expression is, if it was never declared.
    #[inline]
    pub(in crate::evaluate) fn unknown_name(
        &self,
        here: &Here,
        id: ExpressionId,
    ) -> Option<Symbol> {
        let ExpressionKind::Name(name) = here.unit.expression(id).kind else { return None };
        Some(here.symbol(name)).filter(|symbol| self.scopes.slot(*symbol).is_none())
    }

    /// Returns whether an expression is a call of an undeclared name.
    fn unknown_callee(&self, here: &Here, id: ExpressionId) -> bool {
        match here.unit.expression(id).kind {
            ExpressionKind::Call(Callee::Name(name, _), _) => {
                self.scopes.slot(here.symbol(name)).is_none()
            }
            _ => false,
        }
    }

    /// Skips the values after a word, running their directives and calls.
    pub(in crate::evaluate) fn skip_values(&mut self) {
        loop {
            match self.peek().map(|token| (&token.kind, &token.here)) {
                Some((TokenKind::Comma | TokenKind::Literal(_), _)) => drop(self.next()),
                Some((TokenKind::Expression(id), here)) => {
                    let id = *id;
                    // An undeclared name is the next mistake, not a part of this one.
                    let here = here.clone();
                    if self.unknown_callee(&here, id) || self.unknown_name(&here, id).is_some() {
                        return;
                    }
                    if let Some(token) = self.next() {
                        let before = self.told();
                        let _ = self.expression(&token.here, id);
                        self.take_back(before);
                    }
                }
                _ => return,
            }
        }
    }

    /// Skips the textures of a misspelt pattern: `checkerboard texture { … }, texture { … }`.
    pub(super) fn skip_textures(&mut self, near: Option<&str>) {
        let near = near.and_then(Word::from_name).map(Word::family);
        while near == Some(Family::Pattern) && self.take_word(Word::Texture).is_some() {
            self.skip_arguments(Word::Texture);
            self.skip_commas();
        }
    }

    /// Skips the values and the block that belong to a word, running their directives and calls.
    pub(in crate::evaluate) fn skip_arguments(&mut self, word: Word) {
        if word == Word::Function {
            return self.skip_function();
        }
        loop {
            match self.peek().map(|token| &token.kind) {
                Some(TokenKind::Comma | TokenKind::Literal(_)) => drop(self.next()),
                Some(&TokenKind::Expression(id)) => {
                    let Some(Token { here, .. }) = self.peek().cloned() else { return };
                    // Probably a misspelt word, not a part of this one.
                    if self.unknown_name(&here, id).is_some() {
                        return;
                    }
                    self.next();
                    self.run_expression(&here, id);
                }
                Some(TokenKind::Entry(_)) => {
                    if let Some(Token { kind: TokenKind::Entry(items), here, .. }) = self.next() {
                        self.inside(&here, items, Self::run_items);
                    }
                }
                Some(TokenKind::Block(_)) => {
                    if let Some(Token { kind: TokenKind::Block(contents), here, span }) =
                        self.next()
                    {
                        self.inside_block(&here, contents, span, Self::run_items);
                    }
                    return;
                }
                Some(TokenKind::Word(next))
                    if next.family() == Family::Color
                        && (word.family() != Family::Color || word == Word::Color) =>
                {
                    drop(self.next());
                }
                Some(TokenKind::Word(_) | TokenKind::Semicolon) | None => return,
            }
        }
    }
}
