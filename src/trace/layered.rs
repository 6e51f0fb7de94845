//! Shading of layered textures on one side of an object.
//!
//! **In:** surfaces side by side. **Out:** the radiance of each by itself, and the rays that go on. **Invariant:** each
//! has, to the bit, the radiance that [`Tracer::composite`] returns for it alone.
//!
//! The colours and normals of each layer are evaluated together for all surfaces where it is visible. Opaque layers that
//! only scatter light are lit together, too: each light is sampled once for all of them.

use std::sync::Arc;

use smallvec::SmallVec;

use super::Walk;
use super::batch::{SLICE, Surfaces};
use super::packet::Packet;
use super::surface_batch::SurfaceBatch;
use super::texture::ObjectSide;
use super::tracer::Tracer;
use super::traits::{Masks, Traits};
use crate::color::{Clearness, Color, Rgb};
use crate::math::Vector;
use crate::math::wide::numbers;
use crate::world::{Plain, Texture};

/// The plain layers of a texture, from the top down, each at the surfaces where it is seen.
struct PaintedLayers<'a, 'b, 'c> {
    batches: SmallVec<[SurfaceBatch<'a, 'b, 'c>; 3]>,
    /// The part of the light of each layer that the layers above it let through, by surface.
    above: SmallVec<[[Rgb; SLICE]; 3]>,
    /// What all of them let through, at most.
    through: [Rgb; SLICE],
}

impl PaintedLayers<'_, '_, '_> {
    #[inline(always)]
    fn new() -> Self {
        Self { batches: SmallVec::new(), above: SmallVec::new(), through: [Rgb::WHITE; SLICE] }
    }
}

/// The evaluated layers of one of the surfaces that are shaded together.
#[derive(Clone, Copy)]
pub(super) struct Known<'a, 'p> {
    layers: &'p [SurfaceBatch<'a, 'p, 'p>],
    number: usize,
}

impl Known<'_, '_> {
    pub const NOTHING: Self = Self { layers: &[], number: 0 };

    /// Returns the colour of a plain texture, and the normal by which it is lit, if they are known.
    #[inline]
    pub fn part(&self, plain: &Plain) -> Option<(Color, Vector)> {
        let number = self.number;
        let is_it = |layer: &&SurfaceBatch| {
            layer.plains[number].is_some_and(|one| std::ptr::eq(one, plain))
        };
        let layer = self.layers.iter().find(is_it)?;
        Some((layer.paints[number], layer.normal(number)))
    }
}

impl<'a> Tracer<'a> {
    /// Shades the surfaces of a side with layers.
    #[inline(never)]
    pub(super) fn shade_layered(
        &self,
        walk: &mut Walk,
        surfaces: &mut Surfaces,
        side: ObjectSide,
        count: &mut impl FnMut(&Walk),
    ) {
        let object = &self.world.objects[side.hit.object as usize];
        let texture = self.world.coat(object, side.hit.leaving).texture as usize;
        let Texture::Layers(textures) = &self.world.textures[texture] else { return };
        let packet = surfaces.packet;
        let mut layers = PaintedLayers::new();
        if !side.is_single() {
            self.paint_layers(textures, packet, side, &mut layers);
        }
        let mut alone = side.mask;
        if !layers.batches.is_empty() && !object.double_illuminate && self.only_scatter(textures) {
            let clear = self.secondary && self.clear && self.clear_composites[texture];
            let mut open = 0;
            for number in numbers(side.mask) {
                let is_seen_through = packet.hits[number].contested
                    || layers.through[number].brightness().abs() >= self.adc_bailout;
                let goes_on = clear && packet.level(number) < self.max_trace_level;
                open |= if goes_on && is_seen_through { 1 << number } else { 0 };
            }
            let together = side.mask & !open;
            layers.batches.iter_mut().for_each(|layer| layer.mask &= together);
            if self.lights && together != 0 {
                self.light(walk, &mut layers.batches);
            }
            for number in numbers(together) {
                let mut local = Rgb::BLACK;
                for (layer, above) in layers.batches.iter().zip(&layers.above) {
                    if layer.mask >> number & 1 == 1 {
                        local += layer.local(number) * above[number];
                    }
                }
                surfaces.show(number, local, false);
                count(walk);
            }
            alone = open;
        }
        for number in numbers(alone) {
            let (way, to) = (packet.way(number), surfaces.first + number as u32);
            let known = Known { layers: &layers.batches, number };
            let local = self.composite(walk, &way, &packet.hits[number], to, known);
            surfaces.show(number, local, false);
            count(walk);
        }
    }

    /// Whether all that layers do is to scatter light, by one normal.
    fn only_scatter(&self, layers: &[Arc<Texture>]) -> bool {
        self.lights_are_plain
            && layers.iter().all(|layer| match &**layer {
                Texture::Plain(Plain { normal, finish, .. }) => {
                    normal.is_none()
                        && finish.reflection.is_none()
                        && finish.extras.is_none()
                        && !finish.seed
                }
                _ => false,
            })
    }

    /// Finds the colours and normals of plain layers, from the top down to where nothing is seen any more.
    fn paint_layers<'b, 'c>(
        &self,
        textures: &'a [Arc<Texture>],
        packet: &'b Packet,
        side: ObjectSide<'c>,
        layers: &mut PaintedLayers<'a, 'b, 'c>,
    ) {
        let settings = &self.world.settings;
        for (place, texture) in textures.iter().enumerate().rev() {
            let Texture::Plain(plain) = &**texture else { continue };
            let mut mask = 0;
            let mut plains = [None; SLICE];
            for number in numbers(side.mask) {
                if layers.through[number].brightness() >= self.adc_bailout {
                    (plains[number], mask) = (Some(plain), mask | 1 << number);
                }
            }
            if mask == 0 {
                break;
            }
            let tints = place == 0 || !settings.untinted_layers;
            let clearness = if tints { settings.clearness } else { Clearness::Current };
            layers.above.push(layers.through);
            let traits = (mask, Masks::alike(mask, Traits::of(plain, self.bends)));
            // Built where it stays: it is large.
            layers.batches.push(SurfaceBatch::new(
                packet,
                plains,
                traits,
                side.surfaces,
                clearness,
            ));
            let Some(batch) = layers.batches.last_mut() else { return };
            self.paint(batch);
            // What a finish reflects by itself is not known here.
            if !plain.finish.conserve_energy {
                for number in numbers(mask) {
                    let paint = batch.paints[number];
                    let own = if tints { paint.transmittance() } else { paint.untinted() };
                    layers.through[number] = layers.through[number] * own;
                }
            }
        }
    }
}
