//! Applies an object's modifiers, in written order.
//!
//! **Invariant:** a transform moves what precedes it: the solid, any texture it already has, and its clipping
//! objects.

use super::Lowering;
use super::surface::Surface;
use super::transform::Affine;
use crate::scene::{InteriorId, ModifierKind, ObjectId, TextureId};
use crate::source::Site;
use crate::vocabulary::Word;

/// The result of an object's modifiers.
#[derive(Default)]
pub(super) struct Modified {
    /// The map from the object's own space to its parent's; `None` if they are the same.
    pub map: Option<Affine>,
    /// Placed in the parent's space.
    pub surface: Option<Surface>,
    /// The surface of the inner side, likewise.
    pub lining: Option<Surface>,
    pub interior: Option<InteriorId>,
    pub flags: Flags,
    /// The use whose flags, with those of the object it uses, hide it from every ray.
    pub hidden_by: Option<ObjectId>,
    pub strained: bool,
    pub calls: Calls,
    /// The clipping objects, each with the map to the parent's space.
    pub clips: Vec<(ObjectId, Affine)>,
    /// `cutaway_textures`.
    pub cuts_away: bool,
    /// A light group, and whether other lights light it, too.
    pub light_group: Option<bool>,
}

impl Modified {
    /// Returns a surface that the object inherits.
    pub fn under(&self, inherited: Surface) -> Surface {
        match &self.map {
            Some(map) => inherited.under(map),
            None => inherited,
        }
    }
}

/// Flags of an object, all unset by default.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Flags {
    pub no_shadow: bool,
    pub no_image: bool,
    pub no_reflection: bool,
    pub double_illuminate: bool,
    /// As written; of an object that is about to be placed, as it counts.
    pub hollow: bool,
    pub inverse: bool,
}

impl Flags {
    /// Returns the flags of an object inside another.
    pub fn under(self, above: Self) -> Self {
        Self {
            no_shadow: self.no_shadow || above.no_shadow,
            no_image: self.no_image || above.no_image,
            no_reflection: self.no_reflection || above.no_reflection,
            double_illuminate: self.double_illuminate || above.double_illuminate,
            hollow: self.hollow,
            inverse: self.inverse != above.inverse,
        }
    }

    /// Returns whether no ray hits the object.
    pub fn hide(self) -> bool {
        self.no_shadow && self.no_image && self.no_reflection
    }
}

/// The modifiers that enable an effect if a solid has them: the effect is absent when all sites of its
/// keyword are removed.
#[derive(Debug, Clone, Default)]
pub(super) struct Calls(Vec<(Word, Site)>);

impl Calls {
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Records a keyword. Turning it off discards the earlier sites; turning it on again records only the new
    /// one.
    fn note(&mut self, word: Word, on: bool, site: Site) {
        match on {
            true => self.0.push((word, site)),
            false => self.forget(word),
        }
    }

    pub fn forget(&mut self, word: Word) {
        self.0.retain(|(noted, _)| *noted != word);
    }

    /// Returns the sites of a keyword.
    pub fn of(&self, word: Word) -> impl Iterator<Item = Site> {
        self.0.iter().filter(move |(noted, _)| *noted == word).map(|(_, site)| *site)
    }
}

impl Lowering<'_, '_> {
    /// Applies the modifiers of an object, or of a use, which follow the object's own. Reports a fault and
    /// returns `None` if a transform cannot be applied.
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
                    modified.lining = modified.lining.take().map(|lining| lining.within(&step));
                    for (_, parent_from_region) in &mut modified.clips {
                        *parent_from_region = step.after(parent_from_region);
                    }
                }
                ModifierKind::Texture(id) => {
                    modified.surface = Some(self.set_surface(id, map)?);
                }
                ModifierKind::InteriorTexture(id) => {
                    modified.lining = Some(self.set_surface(id, map)?);
                }
                ModifierKind::Pigment(id) => {
                    let mut surface =
                        self.textured(modified.surface.take(), default_texture, map)?;
                    let painted = surface.repaint(scene, &mut self.transforms, id, map);
                    self.reporter.made_there(painted)?;
                    modified.surface = Some(surface);
                }
                ModifierKind::Normal(id) => {
                    let mut surface =
                        self.textured(modified.surface.take(), default_texture, map)?;
                    let bumped = surface.bumped(scene, &mut self.transforms, id, map);
                    self.reporter.made_there(bumped)?;
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
                ModifierKind::Hollow(on) => flags.hollow = on,
                ModifierKind::Inverse => flags.inverse = !flags.inverse,
                ModifierKind::LightGroup(global) => modified.light_group = Some(global),
                ModifierKind::CutawayTextures => modified.cuts_away = true,
                ModifierKind::ClippedBy(region) => modified.clips.push((region, Affine::IDENTITY)),
            }
            let hiding = flags.hide();
            modified.hidden_by = modified.hidden_by.or(Some(id)).filter(|_| hiding);
        }
        Some(())
    }

    /// Returns the object's own surface; the default texture if it has none yet.
    fn textured(
        &mut self,
        own: Option<Surface>,
        default: TextureId,
        map: Affine,
    ) -> Option<Surface> {
        own.or_else(|| self.set_surface(default, map))
    }

    /// Returns the surface of a texture set under `map`; reports a fault and returns `None` if a transform
    /// cannot be applied.
    pub(super) fn set_surface(&mut self, texture: TextureId, map: Affine) -> Option<Surface> {
        // Usually the same as before: the default texture, under a pigment.
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
