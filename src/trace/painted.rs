//! Colours of the layers of surfaces that are shaded together, found before each surface is shaded by itself.
//!
//! **In:** surfaces of one side of an object. **Out:** for each layer whose colours are found together, those of the
//! surfaces where it may be seen. **Invariant:** each is that of the layer at that surface alone, to the bit.

use std::sync::Arc;

use smallvec::SmallVec;

use super::texture::{self, Side};
use super::tracer::Tracer;
use crate::color::{Color, Rgb};
use crate::math::wide::{ROW, numbers};
use crate::world::{Pigment, Plain, Texture};

/// The colours of one plain texture at surfaces that the mask has a bit for.
pub(super) struct Painted<'a> {
    plain: &'a Plain,
    mask: u32,
    colors: [Color; ROW],
}

/// What is known of the textures of one of the surfaces that are shaded together.
#[derive(Clone, Copy)]
pub(super) struct Known<'a, 'p> {
    pub painted: &'p [Painted<'a>],
    pub number: usize,
}

impl Known<'_, '_> {
    pub const NOTHING: Self = Self { painted: &[], number: 0 };

    /// Returns the colour of a plain texture if it is known.
    #[inline]
    pub fn color(&self, plain: &Plain) -> Option<Color> {
        let is_it =
            |one: &&Painted| std::ptr::eq(one.plain, plain) && one.mask >> self.number & 1 == 1;
        self.painted.iter().find(is_it).map(|one| one.colors[self.number])
    }
}

impl<'a> Tracer<'a> {
    /// Finds the colours of layers, from the top down to where nothing is seen any more.
    #[inline(never)]
    pub(super) fn paint_layers(
        &self,
        layers: &'a [Arc<Texture>],
        side: Side,
    ) -> SmallVec<[Painted<'a>; 3]> {
        let mut painted = SmallVec::new();
        // What the layers so far let through, at most.
        let mut through = [Rgb::WHITE; ROW];
        for (place, layer) in layers.iter().enumerate().rev() {
            let mut mask = 0;
            for number in numbers(side.mask) {
                let is_seen = through[number].brightness() >= self.adc_bailout;
                mask |= if is_seen { 1 << number } else { 0 };
            }
            let Texture::Plain(plain) = &**layer else { continue };
            let mut colors = [Color::default(); ROW];
            match (&plain.pigment, plain.pigment.together()) {
                (Pigment::Color(color), _) => colors = [*color; ROW],
                (_, Some(together)) if mask != 0 => {
                    texture::colors(self, &together, Side { mask, ..side }, &mut colors);
                    painted.push(Painted { plain, mask, colors });
                }
                _ => continue,
            }
            // What a finish reflects by itself is not known here.
            if plain.finish.conserve_energy {
                continue;
            }
            let tints = place == 0 || !self.world.settings.untinted_layers;
            for number in numbers(mask) {
                let color = colors[number];
                let own = if tints { color.transmittance() } else { color.untinted() };
                through[number] = through[number] * own;
            }
        }
        painted
    }
}
