//! How rainbows veil what a ray shows.
//!
//! **In:** rainbows, and one ray from its start to what it hits, or to the sky. **Out:** a [`Veil`]. A pure function:
//! also its jitter is one of the ray. **Invariant:** every veil is finite.
//!
//! **Source:** POV-Ray manual, section 3.4.3.5 "Rainbow"; the formulas were measured on POV-Ray 3.7 to 1/65,535.

use super::fog::{BRIGHTEST, Veil};
use crate::color::{Color, Rgb};
use crate::math::Vector;
use crate::math::elementary::{atan2, exp};
use crate::math::random::Random;
use crate::pattern::Measured;
use crate::texture::blend::{Mix, look_up};
use crate::world::Rainbow;

/// Begins the random numbers of jitter.
const SEED: u64 = 0x7261_696e_626f_7700;

/// Returns the veil of several rainbows on a ray: the mean of those that it is in. `direction` has length 1.
pub(super) fn veil(
    rainbows: &[Rainbow],
    start: Vector,
    direction: Vector,
    length: f64,
) -> Option<Veil> {
    let length = length.min(f64::MAX);
    let veils = rainbows.iter().enumerate().filter_map(|(number, rainbow)| {
        let position = rainbow.position(direction)?;
        let position = match rainbow.jitter == 0.0 {
            true => position,
            // Starts and directions are hashed one after the other, so that parallel rays differ, too.
            false => {
                let seed = Random::at(SEED, start, [number as u64, 0]).bits();
                position + rainbow.jitter * Random::at(seed, direction, [0, 0]).number(-1.0, 1.0)
            }
        };
        let color = rainbow.color(position)?;
        Some(rainbow.veil(color, rainbow.faded(direction)?, length))
    });
    let none = Veil { through: Rgb::BLACK, added: Rgb::BLACK };
    let (sum, count) = veils.fold((none, 0u32), |(sum, count), veil| {
        let (through, added) = (sum.through + veil.through, sum.added + veil.added);
        (Veil { through, added }, count + 1)
    });
    let part = 1.0 / f64::from(count);
    (count > 0).then(|| Veil {
        through: (sum.through * part).bounded(),
        added: (sum.added * part).bounded(),
    })
}

impl Rainbow {
    /// Returns the position in the colours, without jitter; `None` for a ray that points away.
    fn position(&self, direction: Vector) -> Option<f64> {
        let axis = self.direction.get();
        let along = direction.dot(axis);
        let angle = atan2(direction.cross(axis).length(), along);
        (along >= 0.0).then_some((angle - self.inner) / self.width)
    }

    fn color(&self, position: f64) -> Option<Color> {
        if !(0.0..=1.0).contains(&position) {
            return None;
        }
        match look_up(&self.colors, Measured { value: position, error: 0.0 })? {
            Mix::One(color) => Some(*color),
            Mix::Two(low, high, weight) => Some(low.lerp(*high, weight)),
        }
    }

    /// Returns how far it has faded on its arc: 0 … 1; `None` beyond it.
    fn faded(&self, direction: Vector) -> Option<f64> {
        let up = self.up.get();
        let side = self.direction.get().cross(up);
        let angle = atan2(direction.dot(side), direction.dot(up)).abs();
        if angle > self.arc {
            return None;
        }
        if angle <= self.fade {
            return Some(0.0);
        }
        let t = (angle - self.fade) / (self.arc - self.fade);
        Some(t * t * (3.0 - 2.0 * t))
    }

    fn veil(&self, Color { rgb, filter, transmit }: Color, faded: f64, length: f64) -> Veil {
        let left = exp(-length / self.distance);
        // As with fog, beyond all numbers POV-Ray 3.7 shows black (measured).
        if !left.is_finite() {
            return Veil { through: Rgb::BLACK, added: Rgb::BLACK };
        }
        let left = left.max(faded + (1.0 - faded) * transmit).min(BRIGHTEST);
        let part = 1.0 - left;
        let tint = rgb.map(|c| 1.0 - filter * part * (1.0 - c));
        Veil { through: tint * left, added: rgb * part }
    }
}

#[cfg(test)]
mod tests;
