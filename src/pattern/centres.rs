//! Waves from many centres: what `ripples` and `waves` share.

use std::f64::consts::TAU;
use std::sync::LazyLock;

use super::{Sample, Setting};
use crate::math::elementary::sin;
use crate::math::finite::{finite, length, single};
use crate::math::{UnitVector, Vector};
use crate::noise::vector_noise;

/// A centre of waves.
pub(super) struct Centre {
    at: Vector,
    /// The frequency of its waves, 0.01 … 1.01; only `waves` uses it.
    pub frequency: f64,
}

/// The greatest number of centres: as many as there are different ones.
const MOST: usize = 4096;

/// The centres are on the unit sphere, in the directions of the vector noise along the x axis; their
/// frequencies are numbers of the generator of `rand`.
///
/// **Source:** found by experiment on POV-Ray 3.7: the sums of distances for waves of very low frequency, and
/// a least-squares fit of the frequencies, which are whole multiples of [`STEP`] from 0.01 on.
static CENTRES: LazyLock<Vec<Centre>> = LazyLock::new(|| {
    let mut state: u32 = 1;
    let mut draw = || {
        state = state.wrapping_mul(1_812_433_253).wrapping_add(12_345);
        f64::from((state >> 16) % 0x8000)
    };
    (0..DRAWN_BEFORE).for_each(|_| _ = draw());
    let centre = |i| {
        let direction = UnitVector::from_direction(vector_noise(Vector::X * f64::from(i)));
        let at = direction.map_or(Vector::X, UnitVector::get);
        Centre { at, frequency: 0.01 + draw() * STEP }
    };
    (0..MOST as u32).map(centre).collect()
});

/// 1 / 32767, with the eleven digits that POV-Ray 3.7 uses (measured).
const STEP: f64 = 3.051_850_947_6e-5;

/// How many numbers are drawn after `seed(1)` before the first frequency.
const DRAWN_BEFORE: usize = 7_168;

/// Returns the centres of a setting.
pub(super) fn centres(setting: &Setting) -> &'static [Centre] {
    &CENTRES[..setting.waves.clamp(1, MOST)]
}

/// The frequency and the phase of a setting.
#[derive(Clone, Copy)]
pub(super) struct Beat {
    pub frequency: f64,
    phase: f64,
}

impl Beat {
    /// They are in single precision, as in POV-Ray 3.7 (measured).
    pub fn of(setting: &Setting) -> Self {
        Self { frequency: single(setting.frequency), phase: single(setting.phase) }
    }

    /// Returns the wave, −1 … 1, at a distance from its centre.
    #[inline]
    pub fn wave(self, distance: f64) -> f64 {
        sin(finite(TAU * (distance * self.frequency + self.phase)))
    }
}

impl Centre {
    #[inline]
    pub fn distance(&self, point: Vector) -> f64 {
        length(point - self.at)
    }
}

/// Returns the mean over the centres of the direction away from each, times the wave there.
pub(super) fn mean_away(sample: &Sample, wave: impl Fn(&Centre, f64) -> f64) -> Vector {
    let centres = centres(sample.setting);
    let away = |centre: &Centre| {
        let direction = UnitVector::from_direction(sample.point - centre.at);
        let height = wave(centre, centre.distance(sample.point));
        direction.map_or(Vector::ZERO, UnitVector::get) * height
    };
    let sum = centres.iter().map(away).fold(Vector::ZERO, |sum, away| sum + away);
    sum / centres.len() as f64
}

/// Returns by how much the mean of waves of height 1 may change within `reach` of `point`: each is at most
/// 2π times as steep as its frequency.
pub(super) fn change(beat: Beat, point: Vector, reach: Vector) -> f64 {
    let rounding = (length(point) + 2.0) * (8.0 * f64::EPSILON);
    TAU * beat.frequency.abs() * (length(reach) + rounding) + rounding
}
