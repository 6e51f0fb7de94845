//! How an interior dims the light that leaves it, by the length of the way through.

use crate::color::Rgb;
use crate::math::elementary::{exp, pow};
use crate::world::Absorption;

/// From this power on, attenuation is exponential.
const EXPONENTIAL: f64 = 1000.0;

impl Absorption {
    /// Returns the part of light that is left after a way of length `depth`: with c the colour,
    /// `c + (1 − c)/(1 + (depth/distance)^power)`, or `e^((c − 1)·depth/distance)` for a power of 1000 or
    /// more.
    ///
    /// **Source:** POV-Ray manual, section "Attenuation"; measured to 1/65,535 (colour and distance also where
    /// they are not physical).
    pub(super) fn at(&self, depth: f64) -> Rgb {
        let Self { distance, power, color } = *self;
        let ratio = depth / distance;
        let left = if power >= EXPONENTIAL {
            color.map(|c| exp((c - 1.0) * ratio))
        } else {
            let left = 1.0 / (1.0 + pow(ratio, power));
            color.map(|c| c + (1.0 - c) * left)
        };
        left.bounded()
    }

    /// Returns the same for light on its way to a surface, which only a positive power dims.
    ///
    /// **Source:** POV-Ray 3.7's behaviour, measured.
    pub(super) fn in_shadow(&self, depth: f64) -> Rgb {
        if self.power > 0.0 { self.at(depth) } else { Rgb::WHITE }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn left(power: f64, depth: f64) -> Rgb {
        Absorption { distance: 2.0, power, color: Rgb::new(0.0, 0.5, 0.25) }.at(depth)
    }

    #[test]
    fn what_is_left_is_what_pov_ray_shows() {
        let close = |seen: Rgb, [r, g, b]: [f64; 3]| {
            assert!((seen + Rgb::new(-r, -g, -b)).largest() < 2e-5, "{seen}");
        };
        close(left(1.0, 0.25), [0.88889, 0.94444, 0.91667]);
        close(left(1.0, 8.0), [0.2, 0.6, 0.4]);
        close(left(2.0, 0.5), [0.94118, 0.97059, 0.95588]);
        close(left(0.5, 4.0), [0.41421, 0.70709, 0.56066]);
        close(left(0.0, 4.0), [0.5, 0.75, 0.625]);
        close(left(-1.0, 0.25), [0.11111, 0.55556, 0.33333]);
        close(left(999.0, 1.0), [1.0, 1.0, 1.0]);
        close(left(1000.0, 2.0), [0.36788, 0.60653, 0.47237]);
        close(left(1001.0, 8.0), [0.01832, 0.13534, 0.04979]);
    }

    #[test]
    fn light_to_a_surface_is_dimmed_only_by_a_positive_power() {
        let with = |power| Absorption { distance: 2.0, power, color: Rgb::BLACK };
        assert_eq!([0.0, -1.0].map(|p| with(p).in_shadow(1.0)), [Rgb::WHITE; 2]);
        assert_eq!(with(1.0).in_shadow(2.0), Rgb::gray(0.5));
    }

    #[test]
    fn no_numbers_break_it() {
        for distance in [-2.0, 1e-300, 1e300] {
            for power in [-1e300, -2.5, 0.0, 0.5, 999.9, 1000.0, 1e300] {
                for depth in [0.0, 2.0, 1e-300, 1e300] {
                    let color = Rgb::new(1.0, 2.0, -0.5);
                    assert!(Absorption { distance, power, color }.at(depth).is_finite());
                }
            }
        }
    }
}
