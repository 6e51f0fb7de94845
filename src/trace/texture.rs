//! The colour of a texture where a ray hits its surface.
//!
//! **In:** a [`Pigment`], and the hit. **Out:** the pigment's colour at that point.

use std::cell::OnceCell;

use super::tracer::Tracer;
use crate::color::{Color, Rgb};
use crate::geometry::{self, Hit, SurfacePoints};
use crate::math::Vector;
use crate::math::placement::Map;
use crate::math::power::power;
use crate::math::wide::{ROW, Rows, numbers};
use crate::shape::{Paint, Ray, Shape, SurfacePoint};
use crate::texture::blend::Mix;
use crate::texture::normal::Bumps;
use crate::texture::space::Turn;
use crate::texture::{self, Blend, Normal, Place, Surroundings, Together};
use crate::world::{Coat, FaceCoordinates, Object, Pigment, Plain, Texture, World};

/// Returns the colour of a pigment where the ray hits its surface.
#[inline(always)]
pub(super) fn color(
    tracer: &Tracer,
    plain: &Plain,
    ray: &Ray,
    hit: &Hit,
    surface: &SurfacePoint,
) -> Color {
    match &plain.pigment {
        Pigment::Color(color) => *color,
        _ => patterned(tracer, plain, *ray, *hit, *surface),
    }
}

/// The surfaces of one side of an object among those that are shaded together.
#[derive(Clone, Copy)]
pub(super) struct ObjectSide<'a> {
    /// The first of its hits.
    pub hit: &'a Hit,
    /// A bit for each.
    pub mask: u32,
    pub surfaces: &'a SurfacePoints,
}

/// Finds the colours of the surfaces of a side.
#[inline(never)]
pub(super) fn colors(
    tracer: &Tracer,
    together: &Together<Blend<Color>>,
    side: ObjectSide,
    colors: &mut [Color; ROW],
) {
    let mut points = Rows::ZERO;
    side.points(tracer.world, together.slot, &mut points);
    together.colors(&mut points, side.mask, colors);
}

/// Perturbs the normals of the surfaces of a side, which point toward the viewer.
#[inline(never)]
pub(super) fn perturb(
    tracer: &Tracer,
    together: &Together<Bumps>,
    side: ObjectSide,
    normals: &mut Rows,
) {
    let mut points = Rows::ZERO;
    let map = side.points(tracer.world, together.slot, &mut points);
    let turn = map.map_or(Turn::NONE, Turn::of);
    together.perturb(turn, &mut points, side.mask, normals);
}

impl<'a> ObjectSide<'a> {
    /// Returns the first of some surfaces, with those of the same side of the same object.
    #[inline(always)]
    pub fn first(hits: &'a [Hit], some: u32, surfaces: &'a SurfacePoints) -> Self {
        let hit = &hits[some.trailing_zeros() as usize];
        let mut mask = 0;
        for number in numbers(some) {
            let other = &hits[number];
            let is_same = (other.object, other.leaving) == (hit.object, hit.leaving);
            mask |= if is_same { 1 << number } else { 0 };
        }
        Self { hit, mask, surfaces }
    }

    /// Returns the number of its first surface.
    #[inline(always)]
    pub fn first_number(&self) -> usize {
        self.mask.trailing_zeros() as usize % ROW
    }

    /// Returns whether it has only one surface, which gains nothing by rows.
    #[inline(always)]
    pub fn is_single(&self) -> bool {
        self.mask.count_ones() == 1
    }

    /// Finds the points of the surfaces in the space of a slot; returns the map to there.
    #[inline(always)]
    fn points<'w>(&self, world: &'w World, slot: u32, points: &mut Rows) -> Option<&'w Map> {
        let Self { hit, mask, surfaces } = *self;
        let object = &world.objects[hit.object as usize];
        let coat = world.coat(object, hit.leaving);
        let map = map_of(world, &coat, slot);
        for number in numbers(mask) {
            let constants = constants(world, object, &coat, (slot, surfaces.face(number)));
            points.set(number, in_slot(map, constants, surfaces.points.at(number)));
        }
        map
    }
}

/// Returns the coordinates that are constant over a face, in the space of a slot.
#[inline]
fn constants(
    world: &World,
    object: &Object,
    coat: &Coat,
    (slot, face): (u32, u32),
) -> FaceCoordinates {
    let Some(first) = coat.faces else { return FaceCoordinates([None; 3]) };
    let count = if let Shape::Plane(_) = object.shape { 1 } else { 6 };
    world.faces[(first + slot * count + face) as usize]
}

/// Returns the map from the world into the space of a slot, unless that is the world.
#[inline]
fn map_of<'w>(world: &'w World, coat: &Coat, slot: u32) -> Option<&'w Map> {
    coat.places.map(|first| &world.texture_maps[(first + slot) as usize])
}

/// Returns a point of a face in the space of a slot, with the coordinates that are constant there.
#[inline]
fn in_slot(
    map: Option<&Map>,
    FaceCoordinates([x, y, z]): FaceCoordinates,
    point: Vector,
) -> Vector {
    let point = map.map_or(point, |map| map.point(point));
    Vector::new(x.unwrap_or(point.x), y.unwrap_or(point.y), z.unwrap_or(point.z))
}

/// The ray and the hit are passed as copies: if they were pointed to, they would be in memory for surfaces of
/// one colour, too.
#[inline(never)]
fn patterned(
    tracer: &Tracer,
    Plain { pigment, normal: bumps, .. }: &Plain,
    ray: Ray,
    hit: Hit,
    surface: SurfacePoint,
) -> Color {
    let around = SurfaceInteraction::new(tracer, &ray, &hit, &surface);
    pigment.color(None, &SurfaceInteraction { bumps: bumps.as_deref(), ..around })
}

/// Returns the normal that bumps make of `normal`, which points toward the viewer.
#[inline(never)]
pub(super) fn perturbed(
    tracer: &Tracer,
    bumps: &Normal,
    normal: Vector,
    (ray, hit, surface): (&Ray, &Hit, &SurfacePoint),
) -> Vector {
    bumps.perturbed(normal, None, &SurfaceInteraction::new(tracer, ray, hit, surface))
}

/// Returns the part of the light behind the surface at `hit` that passes through it.
pub(super) fn transmittance(tracer: &Tracer, ray: &Ray, hit: &Hit) -> Rgb {
    let object = &tracer.world.objects[hit.object as usize];
    let coat = tracer.world.coat(object, hit.leaving);
    let texture = &tracer.world.textures[coat.texture as usize];
    if let Texture::Plain(plain) = texture
        && let Pigment::Color(color) = plain.pigment
    {
        return color.transmittance();
    }
    let surface = geometry::surface(tracer.world, ray, hit);
    let passing = Passing { focus: None, ..Passing::of(tracer.world) };
    through(texture, None, &SurfaceInteraction::new(tracer, ray, hit, &surface), &passing)
}

/// Returns the same for light that comes from where the ray goes, with the object's caustics.
pub(super) fn to_light(tracer: &Tracer, ray: &Ray, hit: &Hit) -> Rgb {
    let world = tracer.world;
    let exponent = match world.caustics.get(hit.object as usize) {
        Some(exponent) if *exponent != 0.0 => *exponent,
        _ => return transmittance(tracer, ray, hit),
    };
    let coat = world.coat(&world.objects[hit.object as usize], hit.leaving);
    let texture = &world.textures[coat.texture as usize];
    let surface = geometry::surface(world, ray, hit);
    let normal = geometry::shading_normal(world, hit, &surface).unwrap_or(surface.normal);
    let normal = if normal.dot(ray.direction) > 0.0 { -normal } else { normal };
    let focus = Focus { exponent, normal, direction: ray.direction };
    let around = SurfaceInteraction::new(tracer, ray, hit, &surface);
    let passing = Passing { focus: Some(&focus), ..Passing::of(world) };
    through(texture, None, &around, &passing).bounded()
}

/// How light passes through a texture.
#[derive(Clone, Copy)]
struct Passing<'a> {
    /// See the World's settings.
    untinted_layers: bool,
    /// The part at hand tints it.
    tints: bool,
    focus: Option<&'a Focus>,
}

impl Passing<'_> {
    fn of(world: &World) -> Self {
        Self { untinted_layers: world.settings.untinted_layers, tints: true, focus: None }
    }
}

/// The caustics of a surface, which imitate focused light.
struct Focus {
    exponent: f64,
    /// Toward the ray.
    normal: Vector,
    direction: Vector,
}

impl Focus {
    /// Returns the factor of a plain texture: `1 + |L·N|^exponent`, with the normal perturbed by the texture.
    ///
    /// **Source:** POV-Ray 3.7's behaviour, measured; each layer has its own factor.
    fn factor(&self, plain: &Plain, outer: Option<&Place>, around: &dyn Surroundings) -> f64 {
        let normal = match &plain.normal {
            Some(bumps) => bumps.perturbed(self.normal, outer, around),
            None => self.normal,
        };
        1.0 + power(normal.dot(self.direction).abs(), self.exponent)
    }
}

fn through<'a>(
    texture: &'a Texture,
    outer: Option<&Place>,
    around: &SurfaceInteraction<'a, '_>,
    passing: &Passing,
) -> Rgb {
    match texture {
        Texture::Plain(plain) => {
            let color = plain.pigment.color(outer, &around.with(plain.normal.as_deref()));
            let own = if passing.tints { color.transmittance() } else { color.untinted() };
            passing.focus.map_or(own, |focus| own * focus.factor(plain, outer, around))
        }
        Texture::Layers(layers) => {
            let parts = layers.iter().enumerate().map(|(place, layer)| {
                let how = Passing { tints: place == 0 || !passing.untinted_layers, ..*passing };
                through(layer, outer, around, &how)
            });
            parts.fold(Rgb::WHITE, |product, part| product * part)
        }
        Texture::Faces(textures) => {
            let shares = texture::at_face(textures, around).into_iter();
            shares.fold(Rgb::BLACK, |sum, (texture, weight)| {
                sum + through(texture, outer, around, passing) * weight
            })
        }
        Texture::Average { space, entries } => {
            let place = Place::new(space, outer, around);
            entries.iter().fold(Rgb::BLACK, |sum, (weight, texture)| {
                sum + through(texture, Some(&place), around, passing) * *weight
            })
        }
        Texture::Blend(blend) => {
            let (place, mix) = blend.at(outer, around);
            match mix {
                None => Rgb::BLACK,
                Some(Mix::One(texture)) => through(texture, Some(&place), around, passing),
                Some(Mix::Two(low, high, weight)) => {
                    through(low, Some(&place), around, passing) * (1.0 - weight)
                        + through(high, Some(&place), around, passing) * weight
                }
            }
        }
    }
}

/// A hit on a surface, as textures ask for it. What takes long to compute is computed once.
#[derive(Clone)]
pub(super) struct SurfaceInteraction<'a, 'p> {
    world: &'a World,
    /// The bumps of the plain texture that is evaluated.
    bumps: Option<&'p Normal>,
    ray: &'p Ray,
    hit: &'p Hit,
    surface: &'p SurfacePoint,
    /// Of the side that is hit.
    coat: Coat,
    /// The error below which the point is sharp.
    sharp_below: f64,
    /// See [`geometry::spread`].
    spread: OnceCell<Vector>,
    uv: OnceCell<[f64; 2]>,
}

impl<'a, 'p> SurfaceInteraction<'a, 'p> {
    #[inline]
    pub fn new(tracer: &Tracer<'a>, ray: &'p Ray, hit: &'p Hit, surface: &'p SurfacePoint) -> Self {
        let world = tracer.world;
        let coat = world.coat(&world.objects[hit.object as usize], hit.leaving);
        let sharp_below = tracer.sharpness.sharp_below(hit);
        let (spread, uv) = (OnceCell::new(), OnceCell::new());
        Self { world, bumps: None, ray, hit, surface, coat, sharp_below, spread, uv }
    }

    /// Returns the same for a plain texture with these bumps.
    pub fn with(&self, bumps: Option<&'p Normal>) -> Self {
        Self { bumps, ..self.clone() }
    }

    /// Returns how far the point may be, along each axis, from where the ray was meant to hit.
    fn spread(&self) -> Vector {
        *self.spread.get_or_init(|| geometry::spread(self.world, self.ray, self.hit, self.surface))
    }

    /// Returns the coordinates that are constant over the face, in the space of a slot.
    fn constants(&self, slot: u32) -> FaceCoordinates {
        let object = &self.world.objects[self.hit.object as usize];
        constants(self.world, object, &self.coat, (slot, self.surface.face))
    }
}

impl Surroundings for SurfaceInteraction<'_, '_> {
    /// On a flat face, the coordinates that are constant there are those that `lower` computed, not those of
    /// the rounded hit.
    fn point(&self, slot: u32) -> Vector {
        let map = map_of(self.world, &self.coat, slot);
        in_slot(map, self.constants(slot), self.surface.point)
    }

    #[cold]
    fn error(&self, slot: u32) -> Vector {
        let mut error = self.spread();
        if let Some(first) = self.coat.places {
            let map = self.world.texture_maps[(first + slot) as usize];
            error = map.point_error(self.surface.point, error);
        }
        for (axis, constant) in self.constants(slot).0.into_iter().enumerate() {
            error[axis] = if constant.is_some() { 0.0 } else { error[axis] };
        }
        error
    }

    fn is_sharp(&self) -> bool {
        self.sharp_below > 0.0
            && self.surface.spread_at_most(self.ray, self.hit.t, self.hit.error) < self.sharp_below
    }

    fn turn(&self, slot: u32) -> Turn {
        let turn = |first: u32| Turn::of(&self.world.texture_maps[(first + slot) as usize]);
        self.coat.places.map_or(Turn::NONE, turn)
    }

    fn uv(&self) -> [f64; 2] {
        let object = &self.world.objects[self.hit.object as usize];
        let placed = match object.shape {
            Shape::Placed(placed) => Some(&self.world.placed[placed as usize]),
            _ => None,
        };
        *self.uv.get_or_init(|| match object.uv {
            Some(mapping) => self.world.uv_mappings[mapping as usize].at(self.surface, placed),
            None => [self.surface.point.x, self.surface.point.y],
        })
    }

    fn in_world(&self) -> Vector {
        self.surface.point
    }

    fn normal(&self) -> Option<Vector> {
        let (world, direction) = (self.world, self.ray.direction);
        let own = match geometry::shading_normal(world, self.hit, self.surface) {
            Some(smooth) => smooth,
            None => self.surface.normal,
        };
        let facing = if own.dot(direction) > 0.0 { -own } else { own };
        Some(match self.bumps {
            Some(bumps) => bumps.perturbed(facing, None, &self.with(None)),
            None => facing,
        })
    }

    fn direction(&self) -> Vector {
        self.ray.direction
    }

    #[cold]
    fn uv_error(&self) -> Vector {
        let object = &self.world.objects[self.hit.object as usize];
        match object.uv {
            Some(_) => Vector::ZERO,
            None => Vector { z: 0.0, ..self.spread() },
        }
    }

    fn paint(&self) -> Option<Paint> {
        // Just inside, where rounding does not decide.
        let inside = self.surface.spawn(-self.surface.normal);
        if let Some(cutaway) = self.world.cutaway(self.hit.object, inside) {
            return Some(cutaway);
        }
        let Shape::Placed(placed) = self.world.objects[self.hit.object as usize].shape else {
            return None;
        };
        self.world.placed[placed as usize].paint(self.surface)
    }
}
