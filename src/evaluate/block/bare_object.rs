//! Bare object names at the top level, without `object`: `Ball`, `Balls[2]`, `Tower translate x`.

use crate::diagnostic::{Code, Diagnostic};
use crate::scene::ObjectId;
use crate::syntax::ast::{ExpressionId, ExpressionKind};
use crate::vocabulary::{Family, Word};

use super::super::Evaluator;
use super::super::stream::{Token, TokenKind};
use super::super::value::Value;
use super::is_object_word;
use super::place::is_at_top_level;

impl Evaluator<'_> {
    /// Reads `Ball` as `object { Ball }`, as POV-Ray does; no modifiers may follow.
    pub(super) fn lone_object(&mut self, token: &Token, id: ExpressionId) -> Option<ObjectId> {
        // Before anything after it runs, which may declare it.
        let object = match token.here.unit.expression(id).kind {
            ExpressionKind::Name(name) => match self.scopes.read(token.here.symbol(name)) {
                Some(&Value::Object(object)) => object,
                _ => return None,
            },
            // An element of an array of objects.
            ExpressionKind::Index(of, _) => {
                let ExpressionKind::Name(array) = token.here.unit.expression(of).kind else {
                    return None;
                };
                let symbol = token.here.symbol(array);
                let Some(Value::Array(held)) = self.scopes.read(symbol) else { return None };
                if !held.holds_objects() {
                    return None;
                }
                match self.expression(&token.here, id) {
                    Ok(Value::Object(object)) => object,
                    _ => return None,
                }
            }
            _ => return None,
        };
        let follows = match self.peek_on().map(|next| &next.kind) {
            Some(TokenKind::Block(_)) => true,
            Some(TokenKind::Word(word)) => !is_at_top_level(*word) && !is_object_word(*word),
            _ => false,
        };
        (!follows).then_some(object)
    }

    /// Handles `Tower translate x` for a `Tower` whose declaration was reported.
    pub(super) fn changed_object(&mut self, token: &Token, id: ExpressionId) -> bool {
        let ExpressionKind::Name(name) = token.here.unit.expression(id).kind else { return false };
        let symbol = token.here.symbol(name);
        let is_broken = matches!(self.scopes.read(symbol), Some(Value::Broken));
        let changes = |word: Word| matches!(word.family(), Family::Transform | Family::Texture);
        let first = self.peek_on().map(|next| next.kind.clone());
        let Some(TokenKind::Word(first)) = first.filter(|_| is_broken) else { return false };
        if !changes(first) {
            return false;
        }
        while let Some(Token { kind: TokenKind::Word(word), .. }) = self.peek_on()
            && changes(*word)
        {
            let word = *word;
            self.next();
            self.skip_arguments(word);
        }
        let text = self.sources.text(token.span).to_owned();
        let message = "an object has no meaning here at the top level";
        let told = Diagnostic::new(Code::ExtraPart, message)
            .at(token.span, "expected an object, a light, a camera, or settings")
            .help(format!("write `object {{ {text} {} … }}`", first.name()));
        self.report(&token.here, told);
        true
    }
}
