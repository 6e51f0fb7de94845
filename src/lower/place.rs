//! Places canonical solids: their materials, the placement of their textures, their interiors.

use std::sync::Arc;

use super::cutaway::UNKNOWN;
use super::inherited::Inherited;
use super::modifier::{Calls, Flags, Modified};
use super::shape::LocalFace;
use super::surface::Surface;
use super::transform::Affine;
use super::{Fault, Lowering, body};
use crate::scene::ObjectId;
use crate::shape::{Body, Shape};
use crate::source::Site;
use crate::vocabulary::Word;
use crate::world::{Coat, NearSingular, Object, Plain};

impl Lowering<'_, '_> {
    /// Drops a solid that is empty, for the reason given.
    pub(super) fn place_nowhere(
        &mut self,
        here: &Inherited,
        site: Site,
        (word, why): (&'static str, &'static str),
    ) -> Result<(), Fault> {
        self.drop_part(site, word, why);
        self.nothing(here.flags.inverse, site);
        Ok(())
    }

    /// Places a body that is built once, however often it is used; places nothing if there is none.
    pub(super) fn place_stored(
        &mut self,
        id: ObjectId,
        make: impl FnOnce() -> Result<Option<(Body, Affine)>, Fault>,
        here: &Inherited,
        site: Site,
    ) -> Result<(), Fault> {
        match self.shared(id, |_| make())? {
            Some((body, frame)) => self.place_body(body, &frame, here, site),
            None => Ok(()),
        }
    }

    /// Likewise, for a body that may be empty, which is reported.
    pub(super) fn place_if_somewhere(
        &mut self,
        id: ObjectId,
        make: impl FnOnce() -> Result<(Body, Affine), Fault>,
        here: &Inherited,
        site: Site,
        nowhere: (&'static str, &'static str),
    ) -> Result<(), Fault> {
        let made = self.shared(id, |lowering| {
            let made = make()?;
            Ok(lowering.is_somewhere(&made.0, nowhere.0, site).then_some(made))
        })?;
        match made {
            Some((body, frame)) => self.place_body(body, &frame, here, site),
            None => self.place_nowhere(here, site, nowhere),
        }
    }

    /// Returns the body that a solid was lowered to on its first use, or lowers it now.
    pub(super) fn shared(
        &mut self,
        id: ObjectId,
        make: impl FnOnce(&mut Self) -> Result<Option<(Body, Affine)>, Fault>,
    ) -> Result<Option<(Arc<Body>, Affine)>, Fault> {
        if let Some(known) = self.shared.get(&id) {
            return Ok(known.clone());
        }
        let made = make(self)?.map(|(body, frame)| (Arc::new(body), frame));
        Ok(self.shared.entry(id).or_insert(made).clone())
    }

    /// Places a body that is not shared, with the map from its own space.
    pub(super) fn place_made(
        &mut self,
        (body, frame): (Body, Affine),
        here: &Inherited,
        site: Site,
    ) -> Result<(), Fault> {
        self.place_body(Arc::new(body), &frame, here, site)
    }

    /// Places a body with the map from its own space.
    pub(super) fn place_body(
        &mut self,
        body: Arc<Body>,
        frame: &Affine,
        here: &Inherited,
        site: Site,
    ) -> Result<(), Fault> {
        let placed = body::place(body, &here.world_from_here.after(frame))?;
        let shape = Shape::Placed(next(&mut self.world.placed, placed));
        self.place(shape, here, here.flags.inverse, &[], site)
    }

    pub(super) fn place(
        &mut self,
        shape: Shape,
        here: &Inherited,
        inverse: bool,
        faces: &[LocalFace],
        site: Site,
    ) -> Result<(), Fault> {
        let Flags { no_shadow, no_image, no_reflection, double_illuminate, .. } = here.flags;
        let hollow = here.flags.hollow && self.world.has_haze();
        let object = Object {
            casts_shadow: !no_shadow,
            in_image: !no_image,
            in_reflections: !no_reflection,
            double_illuminate,
            hollow,
            inverse,
            // Until it has a set of lights.
            lights: here.light_group.map_or(0, |group| group + 1),
            ..Object::plain(shape)
        };
        if let Some(by) = here.hidden_by
            && self.building.is_none()
            && self.drop_unseen(&object, by)
        {
            return Ok(());
        }
        let surface = &here.surface;
        let is_cut = self.building.is_some() && here.is_cut();
        let written = faces;
        let Coat { texture, places, faces } = match here.hidden_by {
            Some(_) => Coat { texture: self.bare_texture(), places: None, faces: None },
            None if is_cut => UNKNOWN,
            None => self.coat(surface, faces, site)?,
        };
        let lining = match (&here.lining, here.hidden_by) {
            (Some(lining), None) => {
                Some(self.lining(lining, written, object.casts_shadow, site)?)
            }
            (Some(_), Some(_)) | (None, _) => None,
        };
        self.note_near_singular(here, site);
        if object.casts_shadow && !is_cut {
            self.note_filters(texture, surface);
        }
        let interior = self.interior(here.interior, surface.medium(self.scene), site);
        let csg_solid = self.leaf(inverse);
        let object = Object { texture, places, faces, lining, interior, csg_solid, ..object };
        let caustics = self.caustics(here.interior, surface.medium(self.scene));
        if caustics != 0.0 {
            self.world.caustics.resize(self.world.objects.len(), 0.0);
            self.world.caustics.push(caustics);
        }
        self.world.objects.push(object);
        self.origins.objects.push(site);
        if csg_solid.is_some() {
            self.know_leaf(inverse, site);
            self.note_shown(here, written, site);
        }
        Ok(())
    }

    /// Returns a visible surface in the World's terms; `faces` are the solid's flat faces.
    pub(super) fn coat(
        &mut self,
        surface: &Surface,
        faces: &[LocalFace],
        site: Site,
    ) -> Result<Coat, Fault> {
        let texture = self.seen_texture(surface, site)?;
        let places = self.places(surface, texture)?;
        let faces = match faces {
            [] => None,
            faces => self.faces(surface, texture, faces)?,
        };
        Ok(Coat { texture, places, faces })
    }

    /// Records the filters of a surface that casts a shadow.
    pub(super) fn note_filters(&mut self, texture: u32, surface: &Surface) {
        for (pigment, _) in surface.all(self.scene) {
            self.note_filter(texture, pigment);
        }
    }

    /// Returns the texture of an object that may be visible.
    pub(super) fn seen_texture(&mut self, surface: &Surface, site: Site) -> Result<u32, Fault> {
        let texture = match &surface.faces {
            None => self.texture(surface, site),
            Some(_) => self.texture_of_faces(surface, site)?,
        };
        let (pigment, _) = surface.plain(self.scene);
        let unpainted = self.scene.pigments[pigment.index()].written().is_none();
        // A mirror is visible by its reflections.
        let mirrors = |plain: &Plain| plain.finish.reflection.is_some();
        if unpainted && !self.world.textures[texture as usize].any(mirrors) {
            // A loop visits the same site repeatedly.
            let known = self.unpainted.last().is_some_and(|last| last.span == site.span);
            self.unpainted.extend((!known).then_some(site));
        }
        Ok(texture)
    }

    /// Drops the visibility flags of a part: it is visible and casts shadows as its CSG solid does.
    ///
    /// **Source:** measured on POV-Ray 3.7, in `intersection`, `difference` and `merge`.
    pub(super) fn drop_flags_of_part(&mut self, modified: &mut Modified, site: Site) {
        let Modified { flags, calls, hidden_by, .. } = modified;
        let words = [
            (&mut flags.no_shadow, "no_shadow"),
            (&mut flags.no_image, "no_image"),
            (&mut flags.no_reflection, "no_reflection"),
        ];
        for (flag, word) in words {
            if std::mem::take(flag) {
                self.drop_part(site, word, "it is a part: that of the whole counts");
            }
        }
        calls.forget(Word::NoImage);
        calls.forget(Word::NoReflection);
        *hidden_by = None;
    }

    /// Drops a CSG solid that no ray hits, as one object, with all of its parts. It stays if the scene
    /// refracts light.
    pub(super) fn drop_unseen_whole(&mut self, here: &Inherited) -> bool {
        let Some(by) = here.hidden_by.filter(|_| !self.bends_light()) else { return false };
        self.drop_hidden(by);
        true
    }

    /// Records modifiers that apply to solids if any were placed since there were `before`.
    pub(super) fn note_calls(&mut self, calls: &Calls, before: usize) {
        if calls.is_empty() || self.world.objects.len() == before {
            return;
        }
        let hidden =
            [Word::NoImage, Word::NoReflection].into_iter().flat_map(|word| calls.of(word));
        self.origins.hidden.extend(hidden);
        self.origins.double_illuminate.extend(calls.of(Word::DoubleIlluminate));
    }

    /// Records an object whose transforms together nearly flatten space, while none alone does.
    pub(super) fn note_near_singular(&mut self, here: &Inherited, site: Site) {
        if !here.strained
            && let Some(condition) = here.world_from_here.near_singular()
        {
            self.origins.near_singular.push(NearSingular { site, condition });
        }
    }
}

/// Appends `item` and returns its index.
pub(super) fn next<T>(list: &mut Vec<T>, item: T) -> u32 {
    list.push(item);
    list.len() as u32 - 1
}
