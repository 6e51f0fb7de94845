//! Object modifiers: transforms, textures, interior and flags, in source order.

use crate::diagnostic::{Code, Diagnostic};
use crate::scene::{Modifier, ModifierKind, ObjectId};
use crate::source::{Site, Span};
use crate::vocabulary::{Dialect, Family, Word};

use super::super::stream::{Token, TokenKind};
use super::super::{Evaluator, Outcome, Reported};
use super::Place;
use super::place::is_before_modifiers;

/// The first part after the modifiers of its block, and the number of others that follow.
struct Late {
    token: Token,
    diagnostic: Diagnostic,
    others: u32,
}

impl Evaluator<'_> {
    /// Reads everything after the parts. `used` is the declared object being modified; if it has a texture, a
    /// pigment or finish alone modifies that texture.
    pub(super) fn modifiers(
        &mut self,
        word: Word,
        used: Option<ObjectId>,
        modifiers: &mut Vec<Modifier>,
    ) -> Outcome<()> {
        // As of most objects in loops.
        if self.peek().is_none() {
            return Ok(());
        }
        let is_texture = |modifier: &Modifier| matches!(modifier.kind, ModifierKind::Texture(_));
        let mut textured = used.is_some_and(|used| self.made[used.index()].textured)
            || modifiers.iter().any(is_texture);
        let place = || match word.family() {
            Family::Csg => Place::csg(word),
            _ => Place::shape(word),
        };
        let (mut failed, mut painted): (bool, Option<Site>) = (false, None);
        // Whether that is the pigment of a texture.
        let mut within = false;
        let mut first: Option<Site> = None;
        let mut late: Option<Late> = None;
        let mut mapped = false;
        while let Some(token) = self.next() {
            if let TokenKind::Word(Word::UvMapping) = token.kind {
                mapped = true;
                continue;
            }
            let set_before = modifiers.len();
            let before = self.poison;
            if let TokenKind::Word(item) = token.kind
                && let Some(first) = first
                && used.is_none()
                && is_before_modifiers(word, item)
            {
                self.too_late(&token, word, first, &mut late);
                failed = true;
                continue;
            }
            if matches!(token.kind, TokenKind::Word(item) if place().holds(item)) {
                first.get_or_insert(token.here.site(token.span));
            }
            match token.kind {
                TokenKind::Word(Word::Pigment) => {
                    let site = token.here.site(token.span);
                    // A macro's result may be modified by its caller.
                    let of_texture = std::mem::take(&mut within);
                    if let Some(first) = painted.replace(site)
                        && first.expansion == site.expansion
                        && (!of_texture || self.begins_with_color())
                    {
                        self.lint_replaced(&token, first, "object");
                    }
                }
                TokenKind::Word(Word::Texture) => {
                    let inner = self.pigment_within(&token);
                    let before = painted.filter(|_| !within);
                    // It is visible through a transparent one.
                    if let (Some(first), Some(inner)) = (before, inner)
                        && first.expansion == inner.expansion
                        && self.is_opaque_as_written(inner)
                    {
                        self.lint_replaced(&token, first, "object");
                    }
                    painted = inner;
                    within = true;
                }
                TokenKind::Word(Word::Material) => painted = None,
                TokenKind::Word(Word::CutawayTextures) => {
                    let of = used.map_or(word, |used| self.made[used.index()].word);
                    if !matches!(of, Word::Difference | Word::Intersection) {
                        self.cuts_nothing(&token, of);
                        failed = true;
                        continue;
                    }
                }
                _ => {}
            }
            match self.modifier(&token, used, modifiers, &mut textured) {
                Some(Ok(kind)) => {
                    if let Some(kind) = kind {
                        let site = match kind {
                            // With its `on`.
                            ModifierKind::NoImage(_)
                            | ModifierKind::NoReflection(_)
                            | ModifierKind::DoubleIlluminate(_) => self.whole(&token),
                            _ => token.here.site(token.span),
                        };
                        // Most objects have one.
                        modifiers.reserve_exact(usize::from(modifiers.is_empty()));
                        modifiers.push(Modifier { kind, site });
                    }
                }
                Some(Err(Reported)) => failed = true,
                None => match self.quick_color(&token).or_else(|| self.inert(&token, place())) {
                    Some(outcome) => failed |= outcome.is_err(),
                    None => {
                        self.unexpected(&token, place());
                        // After an object with a misspelt word, or a camera, others may follow.
                        let no_modifier = match token.kind {
                            TokenKind::Expression(_) => true,
                            TokenKind::Word(of) => modifiers.is_empty() && !place().holds(of),
                            _ => false,
                        };
                        if word.family() == Family::Csg && no_modifier {
                            self.children();
                        }
                        let harmless =
                            matches!(token.kind, TokenKind::Comma | TokenKind::Semicolon);
                        failed |= !harmless && before.is_none() && self.poison.is_none();
                    }
                },
            }
            if mapped {
                for modifier in &mut modifiers[set_before..] {
                    if let ModifierKind::Texture(texture) = &mut modifier.kind {
                        *texture = self.mapped(*texture);
                    }
                }
            }
        }
        let is_lining = |it: &&Modifier| matches!(it.kind, ModifierKind::InteriorTexture(_));
        if !textured && let Some(&Modifier { site, .. }) = modifiers.iter().find(is_lining) {
            let message = "`interior_texture` needs a `texture` beside it";
            let diagnostic = Diagnostic::new(Code::MissingPart, message)
                .at(site.span, "the texture seen from inside")
                .help("write the texture seen from outside, too: `texture { … }`");
            failed = true;
            self.report_in(site.expansion, diagnostic);
        }
        if let Some(Late { token, diagnostic, others }) = late {
            let diagnostic = match others {
                0 => diagnostic,
                1 => diagnostic.help("so does one more part behind it"),
                others => diagnostic.help(format!("so do {others} more parts behind it")),
            };
            self.report(&token.here, diagnostic);
        }
        if failed { Err(Reported) } else { Ok(()) }
    }

    /// Reports children after a modifier, with one message for all: `union { sphere { 0, 1 } pigment { rgb 1
    /// } box { … } }`.
    fn late_part(
        &mut self,
        token: &Token,
        [item, of]: [Word; 2],
        first: Site,
        late: &mut Option<Late>,
    ) {
        match of.family() {
            // Each may have mistakes of its own.
            Family::Csg => drop(self.object(token, item)),
            _ => self.skip_arguments(item),
        }
        if let Some(late) = late {
            late.others += 1;
            return;
        }
        let (name, of) = (item.name(), of.name());
        let modifier = self.sources.text(first.span).to_owned();
        let message = format!("this `{name}` stands after the modifiers of `{of}`");
        let diagnostic = Diagnostic::new(Code::MisplacedBlock, message)
            .at(token.span, format!("the parts of `{of}` come first"))
            .also(first.span, "its modifiers begin here");
        let diagnostic = match self.openers.last() {
            Some(&opener) => diagnostic.also(opener, "inside this block"),
            None => diagnostic,
        };
        let diagnostic =
            diagnostic.help(format!("move `{modifier}` behind the last part of `{of}`"));
        *late = Some(Late { token: token.clone(), diagnostic, others: 0 });
    }

    /// Reports a part of the shape after its first modifier: `cylinder { 0, y, 1 pigment { … } open }`.
    fn too_late(&mut self, token: &Token, shape: Word, first: Site, late: &mut Option<Late>) {
        let TokenKind::Word(item) = token.kind else { return };
        if matches!(item.family(), Family::Shape | Family::Csg)
            || matches!(item, Word::Object | Word::LightSource | Word::LightGroup | Word::Component)
        {
            return self.late_part(token, [item, shape], first, late);
        }
        self.skip_arguments(item);
        let whole = self.whole(token);
        let text = self.sources.text(whole.span).to_owned();
        let (name, shape) = (item.name(), shape.name());
        let modifier = self.sources.text(first.span).to_owned();
        let diagnostic =
            Diagnostic::new(Code::MisplacedBlock, format!("`{name}` stands too late in `{shape}`"))
                .at(token.span, format!("a part of `{shape}`: parts stand before what modifies it"))
                .also(first.span, "its modifiers begin here")
                .help(format!("move it before `{modifier}`"));
        let near = whole.expansion == first.expansion && whole.span.file == first.span.file;
        let diagnostic = match near {
            true => diagnostic
                .fix(Span { end: first.span.start, ..first.span }, format!("{text} "))
                .fix(whole.span, ""),
            false => diagnostic,
        };
        self.report(&token.here, diagnostic);
    }

    /// Reports `cutaway_textures` of an object that has no cut faces.
    fn cuts_nothing(&mut self, token: &Token, of: Word) {
        let message = format!("`cutaway_textures` has no meaning for `{}`", of.name());
        let diagnostic = Diagnostic::new(Code::MisplacedBlock, message)
            .at(token.span, "only a `difference` or an `intersection` has cut faces")
            .help("remove it")
            .fix(token.span, "");
        self.report(&token.here, diagnostic);
    }

    /// Reads one modifier; returns `None` if the token is not one, `Some(Ok(None))` if it has no effect.
    pub(super) fn modifier(
        &mut self,
        token: &Token,
        used: Option<ObjectId>,
        modifiers: &mut Vec<Modifier>,
        textured: &mut bool,
    ) -> Option<Outcome<Option<ModifierKind>>> {
        if let Some(transform) = self.transform_from(token) {
            return Some(transform.map(|id| Some(ModifierKind::Transform(id))));
        }
        let TokenKind::Word(word) = token.kind else { return None };
        let site = token.here.site(token.span);
        let kind = match word {
            Word::Texture => self.texture(token).map(|texture| {
                *textured = true;
                Some(ModifierKind::Texture(self.layered(modifiers, used, texture)))
            }),
            Word::InteriorTexture => self
                .layers_of(word, token)
                .map(|texture| Some(ModifierKind::InteriorTexture(texture))),
            Word::Interior => {
                self.interior(token).map(|interior| Some(ModifierKind::Interior(interior)))
            }
            Word::Material => self.material(token).map(|material| {
                *textured |= material.texture.is_some();
                let texture = material.texture.map(|it| self.layered(modifiers, used, it));
                let parts = [
                    texture.map(ModifierKind::Texture),
                    material.interior_texture.map(ModifierKind::InteriorTexture),
                    material.interior.map(ModifierKind::Interior),
                ];
                modifiers.extend(parts.into_iter().flatten().map(|kind| Modifier { kind, site }));
                None
            }),
            Word::Pigment | Word::Normal | Word::Finish => {
                // Alone it modifies a copy of the default texture.
                if !std::mem::replace(textured, true) {
                    let kind = ModifierKind::Texture(self.default_texture);
                    modifiers.push(Modifier { kind, site });
                }
                if let Err(told) = self.plain_before(token, word, modifiers, used) {
                    return Some(Err(told));
                }
                let part = match word {
                    Word::Pigment => {
                        let start = self.pigment_of(modifiers, used);
                        self.pigment_from(token, start).map(ModifierKind::Pigment)
                    }
                    Word::Normal => {
                        let start = self.normal_of(modifiers, used);
                        self.normal_from(token, start).map(ModifierKind::Normal)
                    }
                    _ => {
                        let start = self.finish_of(modifiers, used);
                        self.finish_from(token, start).map(ModifierKind::Finish)
                    }
                };
                part.map(Some)
            }
            Word::NoShadow => {
                self.optional_flag(token).map(|on| on.then_some(ModifierKind::NoShadow))
            }
            Word::NoImage => self.optional_flag(token).map(|on| Some(ModifierKind::NoImage(on))),
            Word::NoReflection => {
                self.optional_flag(token).map(|on| Some(ModifierKind::NoReflection(on)))
            }
            Word::DoubleIlluminate => {
                self.optional_flag(token).map(|on| Some(ModifierKind::DoubleIlluminate(on)))
            }
            Word::Hollow => self.optional_flag(token).map(|on| Some(ModifierKind::Hollow(on))),
            Word::Inverse => {
                self.optional_flag(token).map(|on| on.then_some(ModifierKind::Inverse))
            }
            Word::CutawayTextures => Ok(Some(ModifierKind::CutawayTextures)),
            Word::ClippedBy => self.clips(token).map(|clips| {
                modifiers.extend(
                    clips
                        .into_iter()
                        .map(|clip| Modifier { kind: ModifierKind::ClippedBy(clip), site }),
                );
                None
            }),
            Word::Radiosity if self.options.dialect == Dialect::Pov => {
                self.importance(token).map(|()| None)
            }
            _ => return None,
        };
        Some(kind)
    }
}
