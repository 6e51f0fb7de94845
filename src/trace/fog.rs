//! How fog veils what a ray shows: the part of the light that comes through, and what the fog adds.
//!
//! **In:** fogs, and one ray from its start to what it hits, or to the sky. **Out:** a [`Veil`]. A pure
//! function: it knows nothing of surfaces. **Invariant:** every veil is finite.
//!
//! **Source:** POV-Ray manual, section 3.4.3.3 "Fog"; the formulas were measured on POV-Ray 3.7 to 1/65,535 for
//! rays of all slopes. Its ground fog is 1/(1 + u²) thick, and not 1/(1 + u)² as the manual says.

use crate::color::Rgb;
use crate::math::Vector;
use crate::math::elementary::{atan, exp};
use crate::math::finite::finite;
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
}

/// Returns the veil of several fogs on a ray: the product of what each lets through, and the sum of what each
/// adds, however they are ordered. `direction` has length 1.
pub(super) fn veil(fogs: &[Fog], start: Vector, direction: Vector, length: f64) -> Veil {
    let length = length.min(f64::MAX);
    fogs.iter().fold(Veil::NONE, |Veil { through, added }, fog| {
        let left = fog.transmittance(start, direction, length);
        let part = (1.0 - left).clamp(-BRIGHTEST, BRIGHTEST);
        Veil {
            through: (through * fog.tint * left).bounded(),
            // No light comes through what brightens it beyond all numbers, and none is added (measured).
            added: if left == 0.0 && fog.distance < 0.0 { added } else { added + fog.color * part },
        }
    })
}

impl Fog {
    /// Returns the part of the light that comes through, at least [`Fog::least`].
    fn transmittance(&self, start: Vector, direction: Vector, length: f64) -> f64 {
        let lengths = length / self.distance;
        let density = self.ground.map_or(1.0, |ground| ground.density(start, direction, length));
        let depth = finite(lengths * density);
        let depth = match &self.churn {
            Some(churn) => churn.thinned(depth, lengths, start + direction * (0.5 * length)),
            None => depth,
        };
        let left = exp(-depth);
        // Beyond all numbers POV-Ray 3.7 shows black (measured).
        let left = if left.is_finite() { left.min(BRIGHTEST) } else { 0.0 };
        left.max(self.least)
    }
}

impl Ground {
    /// Returns the mean density over a ray.
    ///
    /// With a and b the heights of its ends, each less the offset and divided by `alt`, the integral of the
    /// density is b − a below the offset and tan⁻¹ b − tan⁻¹ a above it. Above, the difference is computed as
    /// tan⁻¹ ((b − a)/(1 + ab)), where nothing cancels: a level ray has the density of its height, and a ray
    /// high above the fog keeps its digits.
    fn density(&self, start: Vector, direction: Vector, length: f64) -> f64 {
        let within = |height: f64| finite(height / self.alt).clamp(-HIGHEST, HIGHEST);
        let up = self.up.get();
        let rise = within(length * up.dot(direction));
        let from = within(up.dot(start) - self.offset);
        let to = (from + rise).clamp(-HIGHEST, HIGHEST);
        let (low, high) = (from.min(to), from.max(to));
        if high <= 0.0 {
            1.0
        } else if low <= 0.0 {
            (atan(high) - low) / (high - low)
        } else {
            let product = 1.0 + low * high;
            atan_over(rise / product) / product
        }
    }
}

impl Churn {
    /// Returns the optical depth that turbulence leaves of `depth`; `lengths` is the way as a multiple of the
    /// fog's distance.
    fn thinned(&self, depth: f64, lengths: f64, middle: Vector) -> f64 {
        let fading = exp(-lengths).min(BRIGHTEST);
        if fading == 0.0 {
            return depth;
        }
        let point = (middle * self.scale).to_array().map(finite);
        let noise = finite(self.turbulence.number(self.noise, Vector::from_array(point)));
        finite(depth * (1.0 - fading * finite(self.depth * noise).min(1.0)))
    }
}

/// tan⁻¹ x / x; 1 at 0.
fn atan_over(x: f64) -> f64 {
    if x == 0.0 { 1.0 } else { atan(x) / x }
}

#[cfg(test)]
mod tests;
