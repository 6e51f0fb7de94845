//! `rainbow` as written: a coloured arc around a direction.

use super::ColorMap;
use crate::math::Vector;
use crate::source::Site;

/// A `rainbow`, with POV-Ray's defaults for what is not written.
#[derive(Debug, Clone, PartialEq)]
pub struct Rainbow {
    /// The axis, in which the light of the sun goes; zero if missing.
    pub direction: Vector,
    /// In degrees, between a ray and the axis, in the middle of the band.
    pub angle: f64,
    /// In degrees.
    pub width: f64,
    /// The distance after which 1/e of the light is left; 0: the rainbow is off.
    pub distance: f64,
    /// From the inner edge, at 0, to the outer one, at 1.
    pub colors: Option<ColorMap>,
    /// The most by which positions in `colors` are off at random.
    pub jitter: f64,
    /// Where the middle of the arc is.
    pub up: Vector,
    /// In degrees; `None`: all around.
    pub arc_angle: Option<f64>,
    /// In degrees; `None`: the arc ends abruptly.
    pub falloff_angle: Option<f64>,
    /// The keyword.
    pub site: Site,
    /// The whole block, where it is placed.
    pub item: Site,
}

impl Rainbow {
    /// The distance if none is written.
    ///
    /// **Source:** POV-Ray 3.7's behaviour, measured.
    const DISTANCE: f64 = 1e7;

    /// Returns the heap size of its colours.
    pub fn bytes(&self) -> u64 {
        self.colors.as_ref().map_or(0, |map| size_of_val(&map.0[..]) as u64)
    }

    /// Returns a rainbow without any items.
    pub fn new(site: Site) -> Self {
        Self {
            direction: Vector::ZERO,
            angle: 0.0,
            width: 0.0,
            distance: Self::DISTANCE,
            colors: None,
            jitter: 0.0,
            up: Vector::Y,
            arc_angle: None,
            falloff_angle: None,
            site,
            item: site,
        }
    }
}
