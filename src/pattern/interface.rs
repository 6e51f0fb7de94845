//! What a pattern implements: a value at a point, and what follows from how its values run.

use super::parameter::Parameters;
use super::{Measured, Sample, Setting, WaveKind};
use crate::math::Vector;
use crate::math::interval::Interval;
use crate::math::wide::{Row, Rows, numbers};

/// What a pattern implements; its parameters are declared by `parameters!`.
pub(super) trait Pattern: Parameters + Copy {
    /// The number of values, if they are the whole numbers from 0 on and take a list of as many colours.
    const LIST: Option<usize> = None;
    /// Whether values jump anywhere: then `value` treats a point as being on a seam if it may be there.
    const HAS_SEAMS: bool = false;
    /// Whether `value` applies [`Setting::amount`] itself.
    const APPLIES_TURBULENCE: bool = false;
    /// The wave that its values run through its map by, unless its block names another.
    const WAVE: WaveKind = WaveKind::Ramp;
    /// The frequency of its wave, unless its block names another; with 0, values go to the map as they are.
    const FREQUENCY: f64 = if Self::LIST.is_some() { 0.0 } else { 1.0 };
    /// Its colours as a pigment without a map: positions with red, green and blue.
    const COLORS: &[(f64, [f64; 3])] = &[(0.0, [0.0; 3]), (1.0, [1.0; 3])];
    /// Whether the amount of a normal scales the pattern's own [`Pattern::displacement`].
    const SCALES_BY_AMOUNT: bool = true;
    /// What it evaluates at a point, in words.
    const COST: &str = "a formula a point";
    /// The least and the greatest value.
    const RANGE: Interval = Interval { low: 0.0, high: 1.0 };

    /// Returns the same pattern with parameters in canonical form, for example of length 1, or within the range
    /// that makes a difference. Values are defined for canonical parameters only.
    fn canonical(self) -> Self {
        self
    }

    /// Returns the value at a point.
    fn value(&self, sample: &Sample) -> f64;

    /// Returns the value with its error bound: 0 where maps need not know it.
    #[inline]
    fn measured(&self, sample: &Sample) -> Measured {
        Measured { value: self.value(sample), error: 0.0 }
    }

    /// See [`Kind::is_exact`].
    fn is_exact(&self, _setting: &Setting) -> bool {
        !Self::HAS_SEAMS
    }

    /// See [`Kind::values`].
    #[inline]
    fn values(&self, points: &Rows, mask: u32, setting: &Setting, values: &mut Row) {
        for number in numbers(mask) {
            let point = points.at(number);
            values[number] = self.value(&Sample { point, error: Vector::ZERO, setting });
        }
    }

    /// Returns the value if the point's error does not matter; see [`Kind::value_off_seams`].
    #[inline]
    fn value_off_seams(&self, sample: &Sample) -> Option<Measured> {
        (!Self::HAS_SEAMS).then(|| self.measured(sample))
    }

    /// Returns the vector to add to a normal; see [`Kind::displacement`].
    fn displacement(&self, _normal: Vector, _sample: &Sample) -> Option<Vector> {
        None
    }

    /// See [`Kind::displacements`].
    fn displacements(
        &self,
        normals: &Rows,
        points: &Rows,
        mask: u32,
        setting: &Setting,
        vectors: &mut Rows,
    ) -> bool {
        for number in numbers(mask) {
            let sample = Sample { point: points.at(number), error: Vector::ZERO, setting };
            let Some(vector) = self.displacement(normals.at(number), &sample) else { return false };
            vectors.set(number, vector);
        }
        true
    }

    /// Returns an interval that contains the value at each point within `reach` of `point` along each axis.
    fn bounds(&self, _point: Vector, _reach: Vector, _setting: &Setting) -> Interval {
        Self::RANGE
    }

    /// Returns [`Pattern::bounds`], and intervals that contain the slope along each axis; `None` if slopes are not
    /// known.
    fn sloped(
        &self,
        _point: Vector,
        _reach: Vector,
        _setting: &Setting,
    ) -> Option<(Interval, [Interval; 3])> {
        None
    }
}
