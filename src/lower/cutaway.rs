//! Lowers `cutaway_textures`: faces without a texture show those of the parts that they cut.
//!
//! **Source:** POV-Ray manual, section "Cutaway Textures"; POV-Ray 3.7's behaviour, measured.

use std::rc::Rc;
use std::sync::Arc;

use super::csg::Making;
use super::inherited::Inherited;
use super::modifier::Modified;
use super::shape::LocalFace;
use super::surface::Surface;
use super::texture::Written;
use super::{Fault, Lowering};
use crate::scene::{ModifierKind, ObjectKind, Scene};
use crate::source::Site;
use crate::texture::Texture;
use crate::world::{Coat, Cutaway, TextureOrigin};

/// The coat of a face whose texture depends on parts that are not lowered yet.
pub(super) const UNKNOWN: Coat = Coat { texture: u32::MAX, places: None, faces: None };

/// What an object inherits about textures of cut faces.
#[derive(Debug, Clone, Default)]
pub(super) struct CutFaces {
    /// Parts without a texture show those of others: from the operation with the keyword down, all operations
    /// are intersections. POV-Ray (measured) gives the parts of other operations the default texture.
    is_open: bool,
    /// It or an object around it has a texture.
    is_textured: bool,
    /// It, or an operation around it, is subtracted: no other part shows its texture.
    pub is_subtracted: bool,
    /// The texture of a whole mesh or blob, beside those of its parts.
    pub whole: Option<Surface>,
}

/// What a leaf of a CSG solid shows.
#[derive(Debug)]
pub(super) enum Part {
    /// The textures of the parts around the point.
    Cut { surface: Surface, faces: Vec<LocalFace>, site: Site },
    /// Its own texture, like the cut faces inside of it.
    Shown(Surface),
    /// Its own texture.
    Own,
}

impl CutFaces {
    /// What a clipping object inherits: it shows nothing.
    pub const HIDDEN: Self =
        Self { is_open: false, is_textured: true, is_subtracted: true, whole: None };

    /// Returns what the parts of an object inherit, or the object itself if it has none.
    pub fn within(&self, kind: &ObjectKind, modified: &Modified, inverse: bool) -> Self {
        let is_open = match kind {
            ObjectKind::Csg { operation, .. } => {
                let intersects = Making::Operation(*operation).intersects(inverse);
                intersects && (self.is_open || modified.cuts_away)
            }
            ObjectKind::Union(_) => self.is_open && Making::Union.intersects(inverse),
            ObjectKind::Solid(_) | ObjectKind::Use(_) | ObjectKind::LightSource(_) => self.is_open,
        };
        let is_textured = self.is_textured || modified.surface.is_some();
        Self { is_open, is_textured, ..self.clone() }
    }
}

impl Inherited {
    /// Returns whether a solid shows the textures of the parts around it.
    pub fn is_cut(&self) -> bool {
        let CutFaces { is_open, is_textured, ref whole, .. } = self.cut;
        is_open && !is_textured && whole.is_none() && self.hidden_by.is_none()
    }
}

impl Lowering<'_, '_> {
    /// Records what the last object, a leaf of a CSG solid, shows.
    pub(super) fn note_shown(&mut self, here: &Inherited, faces: &[LocalFace], site: Site) {
        if !self.cuts_away {
            return;
        }
        let Some(building) = &mut self.building else { return };
        let part = match &here.cut {
            _ if here.is_cut() => {
                let (surface, faces) = (here.surface.clone(), faces.to_vec());
                Part::Cut { surface, faces, site }
            }
            cut if cut.is_subtracted => Part::Own,
            cut => Part::Shown(cut.whole.as_ref().unwrap_or(&here.surface).clone()),
        };
        building.shown.push(part);
    }

    /// Gives the cut faces of the leaves from `first` on the textures that they inherit.
    pub(super) fn show_own(&mut self, first: u32, parts: Vec<Part>) {
        for (leaf, part) in (first as usize..).zip(parts) {
            let Part::Cut { surface, faces, site } = part else { continue };
            let coat = self.coat(&surface, &faces, site);
            let coat = self.reporter.made(coat, site).unwrap_or_else(|| self.black());
            self.wear(leaf, coat, &[surface]);
        }
    }

    /// Gives the cut faces of the leaves from `first` on the textures of the leaves that show theirs; returns
    /// how each leaf is related to these faces, or nothing if there is no such face.
    pub(super) fn cut_away(&mut self, first: u32, parts: Vec<Part>) -> Vec<Cutaway> {
        let is_cut = |part: &Part| matches!(part, Part::Cut { .. });
        if !parts.iter().any(is_cut) || parts.iter().all(is_cut) {
            self.show_own(first, parts);
            return Vec::new();
        }
        let mut shown = Vec::new();
        let mut cutaway = Vec::with_capacity(parts.len());
        let mut cut = Vec::new();
        for (leaf, part) in (first as usize..).zip(parts) {
            cutaway.push(match part {
                Part::Cut { site, .. } => {
                    cut.push((leaf, site));
                    Cutaway::Cut
                }
                Part::Shown(surface) => {
                    shown.push(surface);
                    Cutaway::Shown(shown.len() as u32 - 1)
                }
                Part::Own => Cutaway::Own,
            });
        }
        let Some(&(_, site)) = cut.first() else { return Vec::new() };
        let coat = self.coat_of(&shown);
        let coat = coat.map_err(|(fault, at)| (fault, at.unwrap_or(site)));
        let coat = self.reporter.made_there(coat).unwrap_or_else(|| self.black());
        for (leaf, _) in cut {
            self.wear(leaf, coat, &shown);
        }
        cutaway
    }

    /// Returns the coat of faces that show these surfaces; the slots of one follow those of the other.
    fn coat_of(&mut self, shown: &[Surface]) -> Result<Coat, (Fault, Option<Site>)> {
        let Some(first) = shown.first() else { return Ok(self.black()) };
        let (mut slot, mut textures) = (0, Vec::with_capacity(shown.len()));
        for surface in shown {
            let texture = self.node(Written::of(surface), &[], Some(&mut slot), 1)?;
            textures.push(Arc::new(texture));
        }
        let texture = self.index(Texture::Faces(textures), TextureOrigin::default());
        shown.iter().for_each(|surface| self.note_texture(texture, surface));
        let places =
            Rc::new(shown.iter().flat_map(|surface| surface.places.iter().cloned()).collect());
        let all = Surface { places, faces: None, ..first.clone() };
        let places = self.places(&all, texture).map_err(|fault| (fault, None))?;
        Ok(Coat { texture, places, faces: None })
    }

    fn black(&mut self) -> Coat {
        Coat { texture: self.bare_texture(), places: None, faces: None }
    }

    fn wear(&mut self, leaf: usize, coat: Coat, shown: &[Surface]) {
        let object = &mut self.world.objects[leaf];
        (object.texture, object.places, object.faces) = (coat.texture, coat.places, coat.faces);
        if object.casts_shadow {
            shown.iter().for_each(|surface| self.note_filters(coat.texture, surface));
        }
    }
}

/// Returns whether any object of a scene has `cutaway_textures`.
pub(super) fn any(scene: &Scene) -> bool {
    let is_cutaway = |kind: &ModifierKind| matches!(kind, ModifierKind::CutawayTextures);
    scene.objects.iter().any(|object| object.modifiers.iter().any(|it| is_cutaway(&it.kind)))
}
