//! How fog veils what a ray shows: the part of the light that comes through, and what the fog adds.
//!
//! **In:** fogs, and rays from their starts to what they hit, or to the sky, side by side. **Out:** the [`Veil`] of each.
//! A pure function: it knows nothing of surfaces. **Invariant:** every veil is finite.
//!
//! **Source:** POV-Ray manual, section 3.4.3.3 "Fog"; the formulas were measured on POV-Ray 3.7 to 1/65,535 for
//! rays of all slopes. Its ground fog is 1/(1 + u²) thick, and not 1/(1 + u)² as the manual says.

use crate::color::Rgb;
use crate::math::wide::elementary::{atan, exp, finite, within};
use crate::math::wide::*;
use crate::shape::Ray;
use crate::world::{Churn, Fog, Ground};

/// The length of a ray that leaves the scene, as in POV-Ray 3.7 (measured).
pub(super) const SKY: f64 = 2e10;

/// Heights in fog are limited to this: the product of two of them does not overflow.
const HIGHEST: f64 = 1e150;

/// A fog that brightens what is behind it does so at most by this factor.
pub(super) const BRIGHTEST: f64 = 1e30;

/// The effect of fogs on what a ray shows: `light·through + added`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Veil {
    pub through: Rgb,
    pub added: Rgb,
}

impl Veil {
    pub const NONE: Self = Self { through: Rgb::WHITE, added: Rgb::BLACK };

    /// Returns the effect of this veil before another one.
    pub fn before(self, other: Self) -> Self {
        let through = (self.through * other.through).bounded();
        Self { through, added: self.added + (self.through * other.added).bounded() }
    }

    /// Adds a fog that leaves this part of the light.
    #[inline(always)]
    fn add(&mut self, fog: &Fog, left: f64) {
        self.through = (self.through * fog.tint * left).bounded();
        // No light comes through what brightens it beyond all numbers, and none is added (measured).
        if left != 0.0 || fog.distance > 0.0 {
            self.added += fog.color * (1.0 - left).clamp(-BRIGHTEST, BRIGHTEST);
        }
    }
}

/// Returns the veil of several fogs on a ray of this length.
pub(super) fn veil(fogs: &[Fog], instructions: Instructions, ray: &Ray, length: f64) -> Veil {
    let rays = Rays::new([ray].into_iter());
    let mut veil = [Veil::NONE];
    add(fogs, instructions, (&rays, rays.mask), &[length; ROW], &mut veil);
    let [veil] = veil;
    veil
}

/// Adds to veils those of several fogs on rays, if the mask has bits for these: the product of what each lets through,
/// and the sum of what each adds, however they are ordered.
pub(super) fn add(
    fogs: &[Fog],
    instructions: Instructions,
    (rays, mask): (&Rays, u32),
    lengths: &Row,
    veils: &mut [Veil],
) {
    let level = instructions.level();
    let mut left = [0.0; ROW];
    for fog in fogs {
        // All before any is used, as each takes its time.
        dispatch!(level, simd => {
            for group in 0..GROUPS {
                if has(mask, group) {
                    let length = finite(simd, four(simd, lengths, group));
                    let ray = rays.four(simd, group);
                    let way = Way { ray, length, lanes: lanes(mask, group) };
                    store(way.left(simd, fog), &mut left, group);
                }
            }
        });
        numbers(mask).for_each(|number| veils[number].add(fog, left[number]));
    }
}

/// Four rays, each to where it ends.
#[derive(Clone, Copy)]
struct Way<S: Simd> {
    ray: WideRay<S>,
    /// Finite.
    length: Wide<S>,
    /// A bit for each that there is.
    lanes: u32,
}

impl<S: Simd> Way<S> {
    /// Returns the part of the light that is left behind a fog, at least [`Fog::least`].
    #[inline(always)]
    fn left(&self, simd: S, fog: &Fog) -> Wide<S> {
        let lengths = self.length / all(simd, fog.distance);
        let depth = match &fog.ground {
            Some(ground) => lengths * self.density(simd, ground),
            None => lengths,
        };
        let depth = finite(simd, depth);
        let depth = match &fog.churn {
            Some(churn) => self.thinned(simd, churn, depth, lengths),
            None => depth,
        };
        let left = exp(simd, -depth);
        let brightest = all(simd, BRIGHTEST);
        // Beyond all numbers POV-Ray 3.7 shows black (measured).
        let limited = left.simd_gt(brightest).select(brightest, left);
        let left = left.is_finite().select(limited, all(simd, 0.0));
        let least = all(simd, fog.least);
        left.simd_lt(least).select(least, left)
    }

    /// Returns the mean density over a ray.
    ///
    /// With a and b the heights of its ends, each less the offset and divided by `alt`, the integral of the
    /// density is b − a below the offset and tan⁻¹ b − tan⁻¹ a above it. Above, the difference is computed as
    /// tan⁻¹ ((b − a)/(1 + ab)), where nothing cancels: a level ray has the density of its height, and a ray
    /// high above the fog keeps its digits.
    #[inline(always)]
    fn density(&self, simd: S, ground: &Ground) -> Wide<S> {
        let number = |number| all(simd, number);
        let up = WideVector::splat(simd, ground.up.get());
        let alt = number(ground.alt);
        let rise = finite(simd, self.length * up.dot(self.ray.direction) / alt);
        let from = finite(simd, (up.dot(self.ray.origin) - number(ground.offset)) / alt);
        let [rise, from] = [within(simd, rise, HIGHEST), within(simd, from, HIGHEST)];
        let to = within(simd, from + rise, HIGHEST);
        let (zero, one) = (number(0.0), number(1.0));
        let falls = to.simd_lt(from);
        let (low, high) = (falls.select(to, from), falls.select(from, to));
        let is_below = high.simd_le(zero);
        let crosses = low.simd_le(zero);
        let product = one + low * high;
        let slope = rise / product;
        let angle = atan(simd, crosses.select(high, slope));
        // tan⁻¹ x is x where that is small.
        let is_level = slope.abs().simd_lt(number(1e-8));
        let above = is_level.select(one, angle);
        let over = is_level.select(product, rise);
        let mean = crosses.select(angle - low, above) / crosses.select(high - low, over);
        is_below.select(one, mean)
    }

    /// Returns the optical depth that turbulence leaves of `depth`; `lengths` is the way as a multiple of the
    /// fog's distance.
    #[inline(always)]
    fn thinned(&self, simd: S, churn: &Churn, depth: Wide<S>, lengths: Wide<S>) -> Wide<S> {
        let fading = exp(simd, -lengths);
        let brightest = all(simd, BRIGHTEST);
        let fading = fading.simd_gt(brightest).select(brightest, fading);
        let middle = self.ray.origin + self.ray.direction * (all(simd, 0.5) * self.length);
        let ([x, y, z], [a, b, c]) = (middle.0, churn.scale.to_array());
        let scaled = [x * all(simd, a), y * all(simd, b), z * all(simd, c)];
        let [x, y, z] = scaled;
        let point = WideVector([finite(simd, x), finite(simd, y), finite(simd, z)]);
        let noise = churn.turbulence.numbers_of_four(simd, churn.noise, point, self.lanes);
        let one = all(simd, 1.0);
        let part = finite(simd, all(simd, churn.depth) * finite(simd, noise));
        let part = part.simd_gt(one).select(one, part);
        let thinned = finite(simd, depth * (one - fading * part));
        fading.simd_eq(all(simd, 0.0)).select(depth, thinned)
    }
}

#[cfg(test)]
mod tests;
