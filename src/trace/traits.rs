//! What is asked of each surface's texture, found once for each texture and kept in bits.

use super::shade;
use crate::world::{Finish, Pigment, Plain};

/// Bits of a plain texture.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Traits(u8);

/// Its colour comes from a pattern.
pub(super) const PATTERNED: usize = 0;
/// It has bumps.
pub(super) const BUMPY: usize = 1;
/// It answers lights.
pub(super) const ANSWERS: usize = 2;
/// It answers lights by more than its colour and `diffuse`.
pub(super) const ANSWERS_BY_MORE: usize = 3;
/// It is lit by the formula of the seed.
pub(super) const SEED: usize = 4;
/// It mirrors, and if it is not clear, the same at all angles, in its own colour.
pub(super) const MIRRORS: usize = 5;
/// It mirrors otherwise, or has a rare property.
pub(super) const DOES_MORE: usize = 6;
const COUNT: usize = 7;

impl Traits {
    /// `bends`: rays are bent, so that Fresnel's equations tell what is mirrored.
    pub fn of(Plain { pigment, normal, finish, .. }: &Plain, bends: bool) -> Self {
        let Finish { reflection, extras, lobes, .. } = finish;
        let mirrors_simply = reflection.as_ref().is_some_and(|reflection| {
            !(bends && reflection.fresnel)
                && reflection.minimum == reflection.maximum
                && reflection.metallic == 0.0
        });
        let mirrors_simply = mirrors_simply && extras.is_none();
        let mut bits = 0;
        for (place, is_so) in [
            (PATTERNED, !matches!(pigment, Pigment::Color(_))),
            (BUMPY, normal.is_some()),
            (ANSWERS, shade::answers(finish)),
            (ANSWERS_BY_MORE, extras.is_some() || finish.brilliance != 1.0 || !lobes.is_empty()),
            (SEED, finish.seed),
            (MIRRORS, mirrors_simply),
            (DOES_MORE, extras.is_some() || reflection.is_some() && !mirrors_simply),
        ] {
            bits |= u8::from(is_so) << place;
        }
        Self(bits)
    }
}

/// For each trait a bit for each surface, among those that are shaded together.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Masks([u32; COUNT]);

impl Masks {
    /// Adds the surface of this number.
    #[inline(always)]
    pub fn add(&mut self, number: usize, Traits(bits): Traits) {
        for (place, mask) in self.0.iter_mut().enumerate() {
            *mask |= u32::from(bits >> place & 1) << number;
        }
    }

    /// Returns the masks of surfaces with the same traits.
    pub fn alike(mask: u32, Traits(bits): Traits) -> Self {
        Self(std::array::from_fn(|place| if bits >> place & 1 == 1 { mask } else { 0 }))
    }

    /// Returns a bit for each surface with this trait.
    #[inline(always)]
    pub fn of(&self, place: usize) -> u32 {
        self.0[place]
    }
}
