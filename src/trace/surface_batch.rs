//! Surfaces that are shaded together, with their textures as far as these are evaluated.

use super::batch::SLICE;
use super::media::Within;
use super::packet::Packet;
use super::shade::{Flat, Place};
use super::traits::Masks;
use super::way::Way;
use crate::color::{Clearness, Color, Rgb};
use crate::geometry::{Hit, SurfacePoints};
use crate::math::Vector;
use crate::math::wide::{ROW, Row, Rows};
use crate::shape::SurfacePoint;
use crate::world::{Finish, Plain};
use smallvec::SmallVec;

/// A surface with a plain texture, at the hit of a ray.
pub(super) struct ShadedSurface<'a, 'b> {
    pub way: Way,
    pub hit: &'b Hit,
    pub surface: SurfacePoint,
    pub paint: Color,
    pub place: Place<'a>,
}

/// Surfaces of plain textures among those that are shaded together, by their number among these; or one layer of
/// textures at them.
pub(super) struct SurfaceBatch<'a, 'b, 'c> {
    pub packet: &'b Packet,
    /// A bit for each.
    pub mask: u32,
    pub plains: [Option<&'a Plain>; SLICE],
    pub surfaces: &'c SurfacePoints,
    pub traits: Masks,
    /// How clear paints are for bodies.
    pub clearness: Clearness,
    pub paints: [Color; SLICE],
    /// As much of each paint as is not clear, and the finish's `diffuse`.
    pub bodies: Rows,
    pub diffuse: Row,
    /// Those that are lit by another normal than they lie by.
    pub shaped: u32,
    pub shapes: SmallVec<[ShadingNormal; SLICE]>,
    /// What each shows by itself.
    pub local: Rows,
}

/// The normal by which a smooth or bumpy surface is lit.
#[derive(Clone, Copy)]
pub(super) struct ShadingNormal {
    pub normal: Vector,
    pub flat: Flat,
    pub smooth: Option<Vector>,
}

impl<'a, 'b, 'c> SurfaceBatch<'a, 'b, 'c> {
    /// Returns surfaces whose textures are not evaluated yet.
    #[inline(always)]
    pub fn new(
        packet: &'b Packet,
        plains: [Option<&'a Plain>; SLICE],
        (mask, traits): (u32, Masks),
        surfaces: &'c SurfacePoints,
        clearness: Clearness,
    ) -> Self {
        Self {
            packet,
            mask,
            plains,
            surfaces,
            traits,
            clearness,
            paints: [Color::default(); SLICE],
            bodies: Rows::ZERO,
            diffuse: [0.0; ROW],
            shaped: 0,
            shapes: SmallVec::new(),
            local: Rows::ZERO,
        }
    }

    /// Returns what the surface of this number shows by itself.
    #[inline(always)]
    pub fn local(&self, number: usize) -> Rgb {
        color(self.local.at(number))
    }

    /// Adds to what the surface of this number shows by itself.
    #[inline(always)]
    pub fn add(&mut self, number: usize, light: Rgb) {
        self.local.set(number, self.local.at(number) + vector(light));
    }

    /// Returns the normal by which the surface of this number is lit.
    pub fn normal(&self, number: usize) -> Vector {
        match self.shaped >> number & 1 == 1 {
            true => self.shapes[self.place_of_shape(number)].normal,
            false => self.surfaces.facing.at(number),
        }
    }

    /// Returns the finish of the surface of this number, which is there.
    #[inline(always)]
    pub fn finish(&self, number: usize) -> Option<&'a Finish> {
        self.plains[number].map(|plain| &plain.finish)
    }

    /// Returns the solids that the ray of this number is in.
    #[inline(always)]
    pub fn within(&self, number: usize) -> Within {
        self.packet.within(number)
    }

    /// Returns the points of surfaces, where rays start that leave them, and the normals that they lie by.
    pub fn rows(&self) -> (&'c Rows, &'c Rows, &'c Rows) {
        let SurfacePoints { points, origins, facing, .. } = self.surfaces;
        (points, origins, facing)
    }

    /// Returns the place among the shapes of that of this number.
    #[inline(always)]
    pub fn place_of_shape(&self, number: usize) -> usize {
        (self.shaped & ((1 << number) - 1)).count_ones() as usize
    }

    /// Returns the surface of this number; `None` if it is not there.
    #[inline(always)]
    pub fn at(&self, number: usize) -> Option<ShadedSurface<'a, 'b>> {
        let finish = self.finish(number)?;
        let (way, hit) = (self.packet.way(number), &self.packet.hits[number]);
        let (surface, paint) = (self.surfaces.at(number), self.paints[number]);
        let mut place = Place {
            finish,
            color: paint.rgb,
            body: color(self.bodies.at(number)),
            point: surface.point,
            origin: self.surfaces.origins.at(number),
            normal: self.surfaces.facing.at(number),
            flat: None,
            smooth: None,
            to_viewer: -way.ray.direction,
            within: way.within,
        };
        if self.shaped >> number & 1 == 1 {
            let ShadingNormal { normal, flat, smooth } = self.shapes[self.place_of_shape(number)];
            (place.normal, place.flat, place.smooth) = (normal, Some(flat), smooth);
        }
        Some(ShadedSurface { way, hit, surface, paint, place })
    }
}

#[inline(always)]
pub(super) fn vector(Rgb { red, green, blue }: Rgb) -> Vector {
    Vector::new(red, green, blue)
}

#[inline(always)]
fn color(Vector { x: red, y: green, z: blue }: Vector) -> Rgb {
    Rgb { red, green, blue }
}
