//! What an object's modifiers come to, in written order.
//!
//! **Invariant:** a transform moves what precedes it: the solid, whichever texture it already has, and what
//! clips it.

use super::Lowering;
use super::texture::Surface;
use super::transform::Affine;
use crate::scene::{InteriorId, ModifierKind, ObjectId, TextureId};
use crate::source::Site;
use crate::vocabulary::Word;

/// An object's modifiers come to this.
#[derive(Default)]
pub(super) struct Modified {
    /// From the space the object was written in to that of its parent; `None` where they are the same.
    pub map: Option<Affine>,
    /// Its place is in the parent's space.
    pub surface: Option<Surface>,
    pub interior: Option<InteriorId>,
    pub flags: Flags,
    /// The use whose flags, with those of what it uses, hide it from everything.
    pub hidden_by: Option<ObjectId>,
    pub strained: bool,
    pub calls: Calls,
    /// What clips it, and the map to the parent's space.
    pub clips: Vec<(ObjectId, Affine)>,
}

/// What an object is that most are not.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Flags {
    pub no_shadow: bool,
    pub no_image: bool,
    pub no_reflection: bool,
    pub double_illuminate: bool,
    pub inverse: bool,
}

impl Flags {
    /// Those of an object inside another.
    pub fn under(self, above: Self) -> Self {
        Self {
            no_shadow: self.no_shadow || above.no_shadow,
            no_image: self.no_image || above.no_image,
            no_reflection: self.no_reflection || above.no_reflection,
            double_illuminate: self.double_illuminate || above.double_illuminate,
            inverse: self.inverse != above.inverse,
        }
    }

    /// No ray meets the object.
    pub fn hide(self) -> bool {
        self.no_shadow && self.no_image && self.no_reflection
    }
}

/// Which modifiers call for an effect, if there is a solid that they hold for: without all of one word it has
/// none.
#[derive(Debug, Clone, Default)]
pub(super) struct Calls(Vec<(Word, Site)>);

impl Calls {
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// What was undone calls for nothing, even where it is done again: then only that does.
    fn note(&mut self, word: Word, on: bool, site: Site) {
        match on {
            true => self.0.push((word, site)),
            false => self.forget(word),
        }
    }

    pub fn forget(&mut self, word: Word) {
        self.0.retain(|(noted, _)| *noted != word);
    }

    /// Where a word stands.
    pub fn of(&self, word: Word) -> impl Iterator<Item = Site> {
        self.0.iter().filter(move |(noted, _)| *noted == word).map(|(_, site)| *site)
    }
}

impl Lowering<'_, '_> {
    /// The modifiers of an object, or of a use of it, which come after its own. `None`, and a message, where
    /// a transform cannot be spent.
    pub(super) fn modify(
        &mut self,
        modified: &mut Modified,
        id: ObjectId,
        default_texture: TextureId,
    ) -> Option<()> {
        let scene = self.scene;
        for modifier in &scene.objects[id.index()].modifiers {
            let map = modified.map.unwrap_or(Affine::IDENTITY);
            let (flags, calls) = (&mut modified.flags, &mut modified.calls);
            match modifier.kind {
                ModifierKind::Transform(id) => {
                    let step = self.transforms.get(id);
                    let step = self.reporter.made(step, modifier.site)?;
                    modified.strained |= self.transforms.near_singular(id).is_some();
                    modified.map = Some(step.after(&map));
                    modified.surface = modified.surface.take().map(|surface| surface.within(&step));
                    for (_, parent_from_region) in &mut modified.clips {
                        *parent_from_region = step.after(parent_from_region);
                    }
                }
                ModifierKind::Texture(id) => {
                    modified.surface = Some(self.set_surface(id, map)?);
                }
                ModifierKind::Pigment(id) => {
                    let mut surface =
                        self.textured(modified.surface.take(), default_texture, map)?;
                    let painted = surface.repaint(scene, &mut self.transforms, id, map);
                    self.reporter.made_there(painted)?;
                    modified.surface = Some(surface);
                }
                ModifierKind::Finish(id) => {
                    let surface = self.textured(modified.surface.take(), default_texture, map)?;
                    modified.surface = Some(surface.polished(id));
                }
                ModifierKind::Interior(id) => modified.interior = Some(id),
                ModifierKind::NoShadow => flags.no_shadow = true,
                ModifierKind::NoImage(on) => {
                    flags.no_image = on;
                    calls.note(Word::NoImage, on, modifier.site);
                }
                ModifierKind::NoReflection(on) => {
                    flags.no_reflection = on;
                    calls.note(Word::NoReflection, on, modifier.site);
                }
                ModifierKind::DoubleIlluminate(on) => {
                    flags.double_illuminate = on;
                    calls.note(Word::DoubleIlluminate, on, modifier.site);
                }
                ModifierKind::Inverse => flags.inverse = !flags.inverse,
                ModifierKind::ClippedBy(region) => modified.clips.push((region, Affine::IDENTITY)),
            }
            let hiding = flags.hide();
            modified.hidden_by = modified.hidden_by.or(Some(id)).filter(|_| hiding);
        }
        Some(())
    }

    /// The object's own surface; the default texture where it has none yet.
    fn textured(
        &mut self,
        own: Option<Surface>,
        default: TextureId,
        map: Affine,
    ) -> Option<Surface> {
        own.or_else(|| self.set_surface(default, map))
    }

    /// A surface of a texture, set where `map` leads; `None`, and a message, where a transform cannot be spent.
    pub(super) fn set_surface(&mut self, texture: TextureId, map: Affine) -> Option<Surface> {
        // Mostly it is the one before: the default, under a pigment.
        let unmoved = map.moves_nothing();
        if unmoved
            && let Some((known, surface)) = &self.last_surface
            && *known == texture
        {
            return Some(surface.clone());
        }
        let set = Surface::set(self.scene, &mut self.transforms, texture, map);
        let surface = self.reporter.made_there(set)?;
        if unmoved {
            self.last_surface = Some((texture, surface.clone()));
        }
        Some(surface)
    }
}
