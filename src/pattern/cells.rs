//! `cells`: unit cubes, each with a random value.

use super::lattice::{cell, cell_off_seams};
use super::parameter::parameters;
use super::scatter::{cell_at, numbers};
use super::{Measured, Pattern, Sample, Setting};
use crate::math::Vector;
use crate::math::interval::Interval;

parameters! {
    /// A random value for each cell of the unit lattice, evenly distributed over 0 … 1.
    ///
    /// **Source:** POV-Ray manual, section "Cells Pattern"; measured on POV-Ray 3.7.
    pub struct Cells {}
}

/// Returns the value of the cell with these lower ends.
#[inline]
fn random(low: Vector) -> f64 {
    numbers(cell_at(low)).x
}

impl Pattern for Cells {
    const HAS_SEAMS: bool = true;

    #[inline]
    fn value(&self, sample: &Sample) -> f64 {
        let Sample { point, error, .. } = *sample;
        random(Vector::from_array([0, 1, 2].map(|axis| cell(point[axis], error[axis]))))
    }

    #[inline]
    fn value_off_seams(&self, sample: &Sample) -> Option<Measured> {
        let Vector { x, y, z } = sample.point;
        let cell = Vector::new(cell_off_seams(x)?, cell_off_seams(y)?, cell_off_seams(z)?);
        Some(Measured { value: random(cell), error: 0.0 })
    }

    fn bounds(&self, point: Vector, reach: Vector, _setting: &Setting) -> Interval {
        let (low, high) = ((point - reach).floor(), (point + reach).floor());
        if low == high { Interval::point(random(low)) } else { Self::RANGE }
    }
}

#[cfg(test)]
mod tests {
    use crate::pattern::{Kind, measured};

    #[test]
    fn values_are_those_of_pov_ray() {
        let table = include_str!("measured/cells.txt");
        measured::values_are_those_measured(Kind::of_word("cells"), table, 0.0);
    }
}
