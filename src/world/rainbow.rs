//! Rainbows, in canonical form.

use crate::color::Color;
use crate::math::UnitVector;

/// A rainbow. A ray at the angle θ from `direction` has the position (θ − `inner`)/`width` in `colors`, and shows
/// it if it is from 0 to 1, θ at most a right angle, and its angle from `up` around `direction` at most `arc`.
///
/// On a ray of length d it lets T = max(e^(−d/`distance`), transmit) through, tinted by `filter`, and adds
/// (1 − T)·color. All angles are in radians.
#[derive(Debug, Clone, PartialEq)]
pub struct Rainbow {
    pub direction: UnitVector,
    /// At right angles to `direction`.
    pub up: UnitVector,
    pub inner: f64,
    /// Not 0; if negative, `colors` begins at the outer edge.
    pub width: f64,
    /// Not 0. If negative, the rainbow brightens what is behind it.
    pub distance: f64,
    /// Sorted by position; at least one.
    pub colors: Vec<(f64, Color)>,
    /// The most by which positions are off at random.
    pub jitter: f64,
    /// Half of the arc.
    pub arc: f64,
    /// From this angle on it fades toward `arc`, if it is less.
    pub fade: f64,
}
