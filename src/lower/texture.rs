//! Lowers textures: turns pigments and finishes with transforms into shared materials and maps.
//!
//! **In:** a pigment, a finish and the placement of the pattern. **Out:** indices into the World's lists.
//! **Invariant:** equal materials, and equal maps, share one entry, in the order of first use. An object's
//! texture space is the space of its pattern, so that all transforms of a pigment are in the object's map,
//! and a coordinate that is constant over a flat face is one of the pattern's own.

use std::rc::Rc;
use std::sync::Arc;

use rustc_hash::{FxHashMap, FxHashSet};
use smallvec::SmallVec;

use super::finish::{BARE, lower_finish};
use super::shape::LocalFace;
use super::transform::{Affine, Transforms};
use super::{Fault, Lowering};
use crate::color::Color;
use crate::math::UnitVector;
use crate::math::double::Double;
use crate::math::placement::Map;
use crate::pattern::Pattern;
use crate::scene::mesh::Triangles;
use crate::scene::{self, FinishId, PigmentId, PigmentKind, TextureId};
use crate::source::{Site, Span};
use crate::world::{
    FaceCoordinates, Finish, Material, MaterialOrigin, Pigment, Sky, SkyOrigin, World,
};

/// The entries of the World's lists of materials and maps so far.
#[derive(Default)]
pub struct Materials {
    /// For each pigment, the finish that it had last, and the material of both.
    of_pigments: Vec<Option<(FinishId, u32)>>,
    /// Materials that share the numbers in which most differ, to be compared for equality.
    alike: FxHashMap<[u64; 6], SmallVec<[u32; 1]>>,
    maps: FxHashMap<[u64; 12], u32>,
    /// The sites already listed in each material's origin.
    noted: FxHashSet<(u32, Part, Span)>,
}

/// A part of a material whose sites are listed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
enum Part {
    Pattern,
    Highlights,
    Reflection,
    Clear,
    Filter,
}

/// A texture that is inherited down the object tree.
///
/// In POV-Ray (measured) a pigment that replaces another keeps the other's placement: its own transforms come
/// after all those that moved the pigment before it.
#[derive(Debug, Clone)]
pub struct Surface {
    pub pigment: PigmentId,
    pub finish: FinishId,
    /// Shared by all objects that inherit the surface unchanged.
    pub(super) places: Rc<Places>,
    /// The mesh whose faces have textures of their own.
    pub faces: Option<Arc<Triangles>>,
}

#[derive(Debug, Clone)]
pub(super) struct Places {
    /// The pattern's placement, in the space of the surface's current holder.
    place: Affine,
    /// The pattern's placement when the pigment was set, and the map there from the solid's space: the
    /// shortest chain from solid to pattern, without the transforms that moved both.
    set_place: Affine,
    set_from_solid: Affine,
}

impl Surface {
    /// Returns the texture `id`, set in the space that `set_from_solid` maps to.
    pub fn set(
        scene: &scene::Scene,
        transforms: &mut Transforms,
        id: TextureId,
        set_from_solid: Affine,
    ) -> Result<Self, (Fault, Site)> {
        let texture = &scene.textures[id.index()];
        let pigment = &scene.pigments[texture.pigment.index()];
        let place = || {
            let inner = transforms.product(&pigment.transforms)?;
            Ok(transforms.product(&texture.transforms)?.after(&inner))
        };
        let place: Affine = { place }().map_err(|fault| (fault, pigment.site))?;
        let places = Rc::new(Places { place, set_place: place, set_from_solid });
        Ok(Self { pigment: texture.pigment, finish: texture.finish, places, faces: None })
    }

    /// Replaces the pigment.
    pub fn repaint(
        &mut self,
        scene: &scene::Scene,
        transforms: &mut Transforms,
        id: PigmentId,
        set_from_solid: Affine,
    ) -> Result<(), (Fault, Site)> {
        let pigment = &scene.pigments[id.index()];
        let own = transforms.product(&pigment.transforms).map_err(|f| (f, pigment.site))?;
        self.pigment = id;
        let Places { place, set_place, set_from_solid: before } = &*self.places;
        let same = |a: &Affine, b: &Affine| a.moves_nothing() && b.moves_nothing() || a == b;
        if own.moves_nothing() && same(place, set_place) && same(before, &set_from_solid) {
            return Ok(());
        }
        let place = own.after(place);
        self.places = Rc::new(Places { place, set_place: place, set_from_solid });
        Ok(())
    }

    /// Replaces the finish.
    pub fn polished(self, finish: FinishId) -> Self {
        Self { finish, ..self }
    }

    /// Returns the same surface for a child whose own transforms compose to `child`.
    pub fn under(mut self, child: &Affine) -> Self {
        let places = Rc::make_mut(&mut self.places);
        places.set_from_solid = places.set_from_solid.after(child);
        self
    }

    /// Returns the same surface in the space outside `outer`.
    pub fn within(mut self, outer: &Affine) -> Self {
        if !outer.moves_nothing() {
            let places = Rc::make_mut(&mut self.places);
            places.place = outer.after(&places.place);
        }
        self
    }
}

impl Lowering<'_, '_> {
    /// Returns the World's index of a material; `site` is the object's, for faults of its finish.
    pub(super) fn material(&mut self, pigment: PigmentId, finish: FinishId, site: Site) -> u32 {
        if let Some(&Some((last, index))) = self.materials.of_pigments.get(pigment.index())
            && last == finish
        {
            return index;
        }
        let scene = self.scene;
        let written = &scene.pigments[pigment.index()];
        let lowered = lower_pigment(&written.kind, Map::IDENTITY);
        let paint = self.reporter.made(lowered, written.site);
        self.note_folded(written);
        let lowered = lower_finish(&scene.finishes[finish.index()], scene.settings.ambient_light);
        let finish_lowered = self.reporter.made(lowered, site);
        let paint = paint.unwrap_or(Pigment::Color(Color::BLACK));
        let material = material(paint, finish_lowered.unwrap_or(BARE));
        let index = self.index(material, self.origin(pigment, finish));
        self.note_material(index, written, finish);
        let known = &mut self.materials.of_pigments;
        known.resize(scene.pigments.len(), None);
        known[pigment.index()] = Some((finish, index));
        index
    }

    /// Returns the origin of a material with this pigment and finish.
    pub(super) fn origin(&self, pigment: PigmentId, finish: FinishId) -> MaterialOrigin {
        let pigment = self.scene.pigments[pigment.index()].written();
        let finish = self.scene.finish_origins.get(finish.index()).and_then(|origin| origin.site);
        MaterialOrigin { pigment, finish, ..Default::default() }
    }

    /// Returns the material of an object that no ray hits.
    pub(super) fn bare_material(&mut self) -> u32 {
        let material = Material { pigment: Pigment::Color(Color::BLACK), finish: BARE };
        self.index(material, MaterialOrigin::default())
    }

    /// Returns the World's index of a material; `origin` is recorded with a new one.
    pub(super) fn index(&mut self, material: Material, origin: MaterialOrigin) -> u32 {
        let materials = &mut self.world.materials;
        let alike = self.materials.alike.entry(telling_numbers(&material)).or_default();
        let known = alike.iter().copied().find(|&i| materials[i as usize] == material);
        known.unwrap_or_else(|| {
            let index = materials.len() as u32;
            materials.push(material);
            self.origins.materials.push(origin);
            alike.push(index);
            index
        })
    }

    /// Records another pigment and finish that lower to the material `index`: each site is listed once,
    /// however many loops and macros visit it.
    pub(super) fn note_material(&mut self, index: u32, pigment: &scene::Pigment, finish: FinishId) {
        let origin = &mut self.origins.materials[index as usize];
        let noted = &mut self.materials.noted;
        let mut note = |part: Part, list: &mut Vec<Site>, sites: &mut dyn Iterator<Item = Site>| {
            list.extend(sites.filter(|site| noted.insert((index, part, site.span))));
        };
        note(Part::Pattern, &mut origin.pattern, &mut pigment.pattern.iter().copied());
        note(Part::Clear, &mut origin.clear, &mut pigment.clear.iter().copied());
        let Some(finish) = self.scene.finish_origins.get(finish.index()) else { return };
        let mut highlights = finish.highlights.iter().map(|(_, site)| *site);
        note(Part::Highlights, &mut origin.highlights, &mut highlights);
        note(Part::Reflection, &mut origin.reflection, &mut finish.reflection.iter().copied());
        for &(word, site) in &finish.zeros {
            self.drop_part(site, word.name(), "its weight is zero");
        }
    }

    /// Records that an object of the material `index` casts a shadow into which its `pigment` may let light.
    pub(super) fn note_filter(&mut self, index: u32, pigment: PigmentId) {
        let noted = &mut self.materials.noted;
        let clear = self.scene.pigments[pigment.index()].clear.iter();
        let new = clear.filter(|site| noted.insert((index, Part::Filter, site.span)));
        self.origins.materials[index as usize].filter.extend(new);
    }

    /// Records that a pattern whose colours are all the same is dropped.
    fn note_folded(&mut self, pigment: &scene::Pigment) {
        let PigmentKind::Patterned { pattern, map } = &pigment.kind else { return };
        if map.lone_color().is_none() {
            return;
        }
        let what = match pattern {
            Pattern::Checker => "checker",
            Pattern::Gradient { .. } => "gradient",
        };
        let site = pigment.pattern.last().copied().unwrap_or(pigment.site);
        self.drop_part(site, what, "its colours are all the same");
    }

    /// Returns the World's index of the map into a surface's pattern; `None` if there is no pattern or the
    /// map is the identity.
    pub(super) fn texture_map(
        &mut self,
        surface: &Surface,
        material: u32,
    ) -> Result<Option<u32>, Fault> {
        if !is_patterned(&self.world, material) || surface.places.place.is_identity() {
            return Ok(None);
        }
        let map = inverse_map(&surface.places.place)?;
        let numbers = map.matrix.to_cols_array().into_iter().chain(map.centre.to_array());
        let mut key = [0; 12];
        for (slot, number) in key.iter_mut().zip(numbers) {
            *slot = bits(number);
        }
        let maps = &mut self.world.texture_maps;
        Ok(Some(*self.materials.maps.entry(key).or_insert_with(|| {
            maps.push(map);
            maps.len() as u32 - 1
        })))
    }

    /// Returns the World's index of the first entry of the pattern coordinates that are constant over each of
    /// a solid's flat faces.
    pub(super) fn faces(
        &mut self,
        surface: &Surface,
        material: u32,
        faces: &[LocalFace],
    ) -> Result<Option<u32>, Fault> {
        if !is_patterned(&self.world, material) {
            return Ok(None);
        }
        let places = &surface.places;
        let pattern_from_solid = places.set_place.checked()?.after(&places.set_from_solid);
        let start = self.world.faces.len() as u32;
        self.world.faces.extend(faces.iter().map(|face| coordinates(face, &pattern_from_solid)));
        Ok(Some(start))
    }

    pub(super) fn sky(&mut self) {
        let scene = self.scene;
        let Some(sky) = &scene.sky_sphere else { return };
        for id in &sky.pigments {
            self.note_folded(&scene.pigments[id.index()]);
        }
        let transforms = &mut self.transforms;
        let pigments = sky.pigments.iter().filter_map(|id| {
            let written = &scene.pigments[id.index()];
            let map = transforms
                .product(&written.transforms)
                .and_then(|inner| inverse_map(&transforms.product(&sky.transforms)?.after(&inner)));
            let pigment = map.and_then(|map| lower_pigment(&written.kind, map));
            self.reporter.made(pigment, written.site)
        });
        let pigments: Vec<_> = pigments.collect();
        self.world.sky = (!pigments.is_empty()).then_some(Sky { pigments });
        let written = sky.pigments.iter().map(|id| &scene.pigments[id.index()]);
        let pattern = written.filter(|written| is_pattern(&written.kind)).flat_map(|p| &p.pattern);
        let (site, items, pattern) = (sky.site, sky.items.clone(), pattern.copied().collect());
        self.origins.sky = Some(SkyOrigin { site, items, pattern });
    }
}

/// Returns a material without the settings that have no effect in it.
pub(super) fn material(pigment: Pigment, mut finish: Finish) -> Material {
    if !pigment.is_clear() || finish.reflection.is_none() {
        finish.conserve_energy = false;
    }
    Material { pigment, finish }
}

/// Returns whether the pigment has more than one colour.
fn is_pattern(kind: &PigmentKind) -> bool {
    matches!(kind, PigmentKind::Patterned { map, .. } if map.lone_color().is_none())
}

fn is_patterned(world: &World, material: u32) -> bool {
    matches!(world.materials[material as usize].pigment, Pigment::Patterned { .. })
}

/// Returns the map from the world back to a pattern placed by `place`.
pub(super) fn inverse_map(place: &Affine) -> Result<Map, Fault> {
    let map = Map { centre: place.offset().round(), matrix: place.checked()?.matrix(Double::ONE) };
    if map.centre.is_finite() && map.matrix.is_finite() {
        Ok(map)
    } else {
        Err(Fault::not_finite("this texture's place"))
    }
}

/// A coordinate is constant over a face exactly if its row is parallel to the face's normal, here within the
/// map's bound.
fn coordinates(face: &LocalFace, pattern_from_solid: &Affine) -> FaceCoordinates {
    let offset = pattern_from_solid.offset().components();
    let rows = pattern_from_solid.rows();
    FaceCoordinates(std::array::from_fn(|i| {
        let along = rows[i].dot(face.normal);
        let across = rows[i] - face.normal * along;
        let constant = across.largest() <= pattern_from_solid.bound() * rows[i].largest();
        constant.then(|| (along * face.distance + offset[i]).round())
    }))
}

/// Only the direction of a gradient matters, not its length (checked on POV-Ray 3.7: `gradient 2*x` is
/// `gradient x`).
fn lower_pattern(pattern: Pattern) -> Pattern {
    match pattern {
        Pattern::Checker => Pattern::Checker,
        Pattern::Gradient { direction } => Pattern::Gradient {
            direction: UnitVector::from_direction(direction).map_or(direction, UnitVector::get),
        },
    }
}

/// Returns the pigment; one of a single colour has no pattern.
pub(super) fn lower_pigment(kind: &PigmentKind, map: Map) -> Result<Pigment, Fault> {
    let pigment = match kind {
        PigmentKind::Color(color) => Pigment::Color(color.of_numbers()),
        PigmentKind::Faces(colors) => match &colors[..] {
            [] => Pigment::Color(Color::BLACK),
            [color, others @ ..] if others.iter().all(|other| other == color) => {
                Pigment::Color(color.of_numbers())
            }
            _ => Pigment::Faces(colors.iter().map(|color| color.of_numbers()).collect()),
        },
        PigmentKind::Patterned { pattern, map: colors } => match colors.lone_color() {
            Some(color) => Pigment::Color(color.of_numbers()),
            None => Pigment::Patterned {
                pattern: lower_pattern(*pattern),
                pattern_from_texture: map,
                map: colors.0.iter().map(|&(value, color)| (value, color.of_numbers())).collect(),
            },
        },
    };
    let places = match &pigment {
        Pigment::Patterned { map, .. } => map.as_slice(),
        Pigment::Color(_) | Pigment::Faces(_) => &[],
    };
    let is_finite = |color: Color| {
        color.rgb.is_finite() && color.filter.is_finite() && color.transmit.is_finite()
    };
    if !pigment.colors().all(is_finite) || places.iter().any(|(value, _)| !value.is_finite()) {
        return Err(Fault::not_finite("this pigment"));
    }
    Ok(pigment)
}

/// Returns bits that are the same for equal numbers: both zeros give the same.
fn bits(number: f64) -> u64 {
    (number + 0.0).to_bits()
}

/// Returns the numbers in which most materials differ.
fn telling_numbers(material: &Material) -> [u64; 6] {
    let color = match &material.pigment {
        Pigment::Color(color) => *color,
        Pigment::Patterned { map, .. } => map.first().map_or(Color::BLACK, |(_, color)| *color),
        Pigment::Faces(colors) => colors.first().copied().unwrap_or(Color::BLACK),
    };
    let [red, green, blue] = color.rgb.components();
    let Finish { emission, diffuse, ref lobes, .. } = material.finish;
    [red, green, blue, emission.red, diffuse, lobes.first().map_or(0.0, |lobe| lobe.weight)]
        .map(bits)
}
