//! `light_group`: lights for some objects alone.

use crate::scene::{Modifier, ModifierKind, Object, ObjectId, ObjectKind};
use crate::vocabulary::{Family, Word};

use super::super::stream::{Token, TokenKind};
use super::super::{Evaluator, Outcome, Reported};
use super::Place;

/// Which words are valid in a `light_group`.
const PLACE: Place = Place {
    word: Some(Word::LightGroup),
    families: &[Family::Transform, Family::Shape, Family::Csg],
    others: &[Word::GlobalLights, Word::LightSource, Word::LightGroup, Word::Object],
};

impl Evaluator<'_> {
    pub(super) fn light_group(&mut self, token: &Token) -> Outcome<ObjectId> {
        let site = token.here.site(token.span);
        let (children, modifiers) = self.block(token, Word::LightGroup, |evaluator| {
            let mut children = Vec::new();
            evaluator.more_children(&mut children, true);
            let (mut modifiers, mut global, mut failed) = (Vec::new(), false, false);
            while let Some(item) = evaluator.next() {
                let outcome = match item.kind {
                    TokenKind::Word(Word::GlobalLights) => {
                        evaluator.optional_flag(&item).map(|on| global = on)
                    }
                    _ => match evaluator.transform_from(&item) {
                        Some(transform) => transform.map(|id| {
                            let kind = ModifierKind::Transform(id);
                            modifiers.push(Modifier { kind, site: item.here.site(item.span) });
                        }),
                        None => evaluator.other_item(&item, PLACE),
                    },
                };
                failed |= outcome.is_err();
            }
            modifiers.push(Modifier { kind: ModifierKind::LightGroup(global), site });
            if failed { Err(Reported) } else { Ok((children, modifiers)) }
        })?;
        self.add_object(Object { kind: ObjectKind::Union(children), modifiers, site, item: None })
    }
}
