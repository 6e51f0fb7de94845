//! `cubic`: six pyramids around the origin, one towards each side of a cube.

use super::parameter::parameters;
use super::{Pattern, Sample, Setting};
use crate::math::Vector;
use crate::math::interval::Interval;

parameters! {
    /// 0, 1, 2 where the greatest coordinate is x, y, z, and 3, 4, 5 where it is −x, −y, −z; the first of equal
    /// ones.
    ///
    /// **Source:** POV-Ray manual, section "Cubic Pattern"; the choice of the first measured on POV-Ray 3.7.
    pub struct Cubic {}
}

/// Returns the first number that is not less than any by more than `slack`.
fn first_greatest(point: Vector, slack: f64) -> f64 {
    let Vector { x, y, z } = point;
    let enough = point.abs().max_element() - slack;
    let first = [x, y, z, -x, -y, -z].iter().position(|&along| along >= enough);
    first.unwrap_or(0) as f64
}

impl Pattern for Cubic {
    const COLORS: &[(f64, [f64; 3])] = &[
        (0.0, [1.0, 0.0, 0.0]),
        (1.0, [0.0, 1.0, 0.0]),
        (2.0, [0.0, 0.0, 1.0]),
        (3.0, [1.0, 1.0, 0.0]),
        (4.0, [0.0, 1.0, 1.0]),
        (5.0, [1.0, 0.0, 1.0]),
    ];
    const LIST: Option<usize> = Some(6);
    const HAS_SEAMS: bool = true;
    const RANGE: Interval = Interval { low: 0.0, high: 5.0 };

    #[inline]
    fn value(&self, sample: &Sample) -> f64 {
        first_greatest(sample.point, 2.0 * sample.error.max_element())
    }

    fn bounds(&self, point: Vector, reach: Vector, _setting: &Setting) -> Interval {
        let value = first_greatest(point, 0.0);
        let greatest = point.abs().max_element();
        // The others stay behind; twice the reach, and more than the sums round.
        let far = reach.max_element() * 3.0 + greatest * 1e-9;
        let Vector { x, y, z } = point;
        let near = [x, y, z, -x, -y, -z].iter().filter(|&&along| along >= greatest - far).count();
        if near == 1 { Interval::point(value) } else { Self::RANGE }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::{Kind, measured};

    #[test]
    fn values_are_those_of_pov_ray() {
        let table = include_str!("measured/cubic.txt");
        measured::values_are_those_measured(Kind::of_word("cubic"), table, 0.0);
    }

    #[test]
    fn of_equal_coordinates_the_first_counts() {
        let setting = Setting::default();
        for (x, y, z, expected) in [
            (0.0, 0.0, 0.0, 0.0),
            (1.0, 1.0, 1.0, 0.0),
            (-1.0, 1.0, 0.0, 1.0),
            (-1.0, -1.0, 1.0, 2.0),
            (-1.0, -1.0, -1.0, 3.0),
            (0.5, -1.0, -1.0, 4.0),
            (1.0 - 1e-13, 0.0, -1.0, 0.0),
        ] {
            let (point, error) = (Vector::new(x, y, z), Vector::splat(1e-13));
            let value = Cubic {}.value(&Sample { point, error, setting: &setting });
            assert_eq!(value, expected, "{point}");
        }
    }
}
