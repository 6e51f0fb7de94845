//! Shapes that are not built yet: their parts and modifiers are read all the same, for the mistakes in them.
//!
//! **Invariant:** the object is poison, whatever is found in it.

use crate::vocabulary::{Family, Word};

use super::super::stream::{Token, TokenKind};
use super::super::value::{Poison, Value};
use super::super::{Evaluator, Outcome, Reported};

/// The parts of a shape that come before its modifiers, where their number is fixed: vectors all.
fn parts_not_built(word: Word) -> Option<&'static [&'static str]> {
    Some(match word {
        Word::JuliaFractal => &["a vector for the parameter"],
        _ => return None,
    })
}

impl Evaluator<'_> {
    pub(super) fn shape_not_built(&mut self, token: &Token, word: Word) -> Reported {
        let poison = Poison { word, site: token.here.site(token.span) };
        let Some(parts) = parts_not_built(word) else {
            self.set_poison(poison);
            self.skip_arguments(word);
            return Reported;
        };
        let _: Outcome<()> = self.block(token, word, |evaluator| {
            if !evaluator.takes_declared_object() {
                let each = parts.iter().try_for_each(|part| evaluator.unbuilt_part(token, part));
                if each.is_err() {
                    evaluator.skip_parts();
                }
            }
            evaluator.modifiers(word, None, &mut Vec::new())
        });
        let inside = self.poison.take();
        self.set_poison(poison);
        // `open` and the like go with their shape.
        if let Some(inside) = inside.filter(|inside| inside.word.family() != Family::ShapeItem) {
            self.set_poison(inside);
        }
        Reported
    }

    /// `ovus { Egg … }`.
    fn takes_declared_object(&mut self) -> bool {
        let declared = matches!(
            self.peek_declared(),
            Some(Value::Object(_) | Value::Poison(_) | Value::Broken)
        );
        // A name alone, not the first of several values.
        let alone = declared
            && !matches!(
                self.peek_on().map(|next| &next.kind),
                Some(TokenKind::Comma | TokenKind::Expression(_) | TokenKind::Literal(_))
            );
        if alone {
            self.next();
        }
        alone
    }

    fn unbuilt_part(&mut self, token: &Token, wanted: &str) -> Outcome<()> {
        let given = self.given(token, wanted)?;
        match &given.value {
            Value::Poison(_) | Value::Broken => Ok(()),
            value if value.numbers().is_some() => Ok(()),
            value => Err(self.wrong_type(&given.here, given.span, wanted, value)),
        }
    }
}
