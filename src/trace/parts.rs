//! The plain textures that a texture shows at one point: its layers, and the entries of its blends.
//!
//! **In:** a texture, and a point on a surface. **Out:** its parts, each with its colour, its normal and how much of it
//! is visible.
//!
//! Layers are walked from the top down, to where nothing is seen any more.
//!
//! **Source:** POV-Ray 3.7's behaviour, measured with random stacks of layers to 2/65,535.

use super::layered::Known;
use super::reflection;
use super::texture::SurfaceInteraction;
use crate::color::{Clearness, Color, Rgb};
use crate::math::Vector;
use crate::texture;
use crate::texture::blend::Mix;
use crate::world::{Plain, Texture};
use smallvec::SmallVec;

/// A plain texture that is part of another.
pub(super) struct Part<'a> {
    pub plain: &'a Plain,
    pub paint: Color,
    /// The normal by which it is lit.
    pub normal: Vector,
    /// The part of its light that the layers above it let through.
    pub above: Rgb,
    /// Its share in the blends inside of its stack.
    pub share: f64,
    /// It tints the light behind; a part that does not is as clear as its `filter` says, in any version.
    pub tints: bool,
}

impl Part<'_> {
    /// Returns as much of its colour as is not clear, in a World with this clearness.
    #[inline]
    pub fn body(&self, clearness: Clearness) -> Rgb {
        self.paint.body(if self.tints { clearness } else { Clearness::Current })
    }
}

/// Most textures have no more parts than this; further ones are allocated.
type Parts<'a> = SmallVec<[Part<'a>; 4]>;

/// Likewise for the alternatives.
pub(super) type Stacks<'a> = SmallVec<[Stack<'a>; 1]>;

/// Layers that cover each other, from the top down: one alternative of the blends around it.
pub(super) struct Stack<'a> {
    /// Its share in the blends around it.
    pub share: f64,
    pub parts: Parts<'a>,
    /// The part of the light behind it that passes through.
    pub through: Rgb,
}

/// What comes onto a part of a texture from the parts above.
struct Onto {
    light: Rgb,
    /// The part's share in the blends inside of its stack.
    share: f64,
    /// The part tints the light behind.
    tints: bool,
}

/// A point on a surface, as its texture is evaluated there.
pub(super) struct Surface<'a, 'p> {
    pub around: SurfaceInteraction<'a, 'p>,
    pub adc_bailout: f64,
    /// See the World's settings.
    pub untinted_layers: bool,
    /// Toward the viewer's side.
    pub normal: Vector,
    pub to_viewer: Vector,
    /// The fraction that is reflected by Fresnel's equations at a normal.
    pub fresnel: &'p dyn Fn(Vector) -> f64,
    pub known: Known<'a, 'p>,
}

impl<'a: 'p, 'p> Surface<'a, 'p> {
    /// Returns the stacks of a texture.
    #[inline]
    pub fn stacks(&self, texture: &'a Texture) -> Stacks<'a> {
        let mut stacks = Stacks::new();
        self.add_stacks(texture, None, 1.0, &mut stacks);
        stacks
    }

    /// Adds the stacks of a texture.
    fn add_stacks(
        &self,
        texture: &'a Texture,
        outer: Option<&texture::Place>,
        share: f64,
        stacks: &mut Stacks<'a>,
    ) {
        if let Texture::Faces(textures) = texture {
            // What has less is lost in POV-Ray 3.7, too (measured).
            let shares = texture::at_face(textures, &self.around);
            for (texture, weight) in shares.into_iter().filter(|one| one.1 >= self.adc_bailout) {
                self.add_stacks(texture, outer, share * weight, stacks);
            }
            return;
        }
        if let Texture::Average { space, entries } = texture {
            let place = texture::Place::new(space, outer, &self.around);
            for (weight, texture) in entries {
                self.add_stacks(texture, Some(&place), share * weight, stacks);
            }
            return;
        }
        if let Texture::Blend(blend) = texture {
            let (place, mix) = blend.at(outer, &self.around);
            match mix {
                None => {}
                Some(Mix::One(texture)) => self.add_stacks(texture, Some(&place), share, stacks),
                Some(Mix::Two(low, high, weight)) => {
                    self.add_stacks(low, Some(&place), share * (1.0 - weight), stacks);
                    self.add_stacks(high, Some(&place), share * weight, stacks);
                }
            }
            return;
        }
        let mut parts = Parts::new();
        let onto = Onto { light: Rgb::WHITE, share: 1.0, tints: true };
        let through = self.parts(texture, outer, onto, &mut parts);
        stacks.push(Stack { share, parts, through });
    }

    /// Adds the parts of a texture, and returns the part of the light behind it that passes through.
    fn parts(
        &self,
        texture: &'a Texture,
        outer: Option<&texture::Place>,
        Onto { light: above, share, tints }: Onto,
        parts: &mut Parts<'a>,
    ) -> Rgb {
        match texture {
            Texture::Plain(plain) => {
                let known = if outer.is_none() { self.known.part(plain) } else { None };
                let (paint, normal) = known.unwrap_or_else(|| {
                    let around = self.around.with(plain.normal.as_deref());
                    let normal = match &plain.normal {
                        Some(bumps) => bumps.perturbed(self.normal, outer, &self.around),
                        None => self.normal,
                    };
                    (plain.pigment.color(outer, &around), normal)
                });
                let part = Part { plain, paint, normal, above, share, tints };
                let own = if tints { paint.transmittance() } else { paint.untinted() };
                let through = match plain.finish.conserve_energy {
                    true => own * self.reflectance(&part).map(|r| 1.0 - r),
                    false => own,
                };
                parts.push(part);
                through
            }
            Texture::Layers(layers) => {
                let mut through = Rgb::WHITE;
                for (place, layer) in layers.iter().enumerate().rev() {
                    if (above * through).brightness() < self.adc_bailout {
                        break;
                    }
                    let tints = place == 0 || !self.untinted_layers;
                    let onto = Onto { light: above * through, share, tints };
                    through = through * self.parts(layer, outer, onto, parts);
                }
                through
            }
            Texture::Faces(textures) => {
                let shares = texture::at_face(textures, &self.around).into_iter();
                shares.fold(Rgb::BLACK, |sum, (texture, weight)| {
                    let onto = Onto { light: above, share: share * weight, tints };
                    sum + self.parts(texture, outer, onto, parts) * weight
                })
            }
            Texture::Average { space, entries } => {
                let place = texture::Place::new(space, outer, &self.around);
                entries.iter().fold(Rgb::BLACK, |sum, (weight, texture)| {
                    let onto = Onto { light: above, share: share * weight, tints };
                    sum + self.parts(texture, Some(&place), onto, parts) * *weight
                })
            }
            Texture::Blend(blend) => {
                let (place, mix) = blend.at(outer, &self.around);
                match mix {
                    None => Rgb::BLACK,
                    Some(Mix::One(texture)) => self.parts(
                        texture,
                        Some(&place),
                        Onto { light: above, share, tints },
                        parts,
                    ),
                    Some(Mix::Two(low, high, weight)) => {
                        let rest = 1.0 - weight;
                        let onto = |part| Onto { light: above, share: share * part, tints };
                        let low = self.parts(low, Some(&place), onto(rest), parts);
                        let high = self.parts(high, Some(&place), onto(weight), parts);
                        low * rest + high * weight
                    }
                }
            }
        }
    }

    /// Returns how much light a part mirrors.
    pub fn reflectance(&self, part: &Part) -> Rgb {
        match &part.plain.finish.reflection {
            Some(reflection) => {
                let cosine = part.normal.dot(self.to_viewer);
                let fresnel = if cosine < 0.0 { 1.0 } else { (self.fresnel)(part.normal) };
                reflection::reflectance(reflection, part.paint.rgb, cosine, fresnel)
            }
            None => Rgb::BLACK,
        }
    }
}
