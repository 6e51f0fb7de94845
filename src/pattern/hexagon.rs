//! `hexagon`: hexagonal rods along y in three kinds.

use super::lattice::remainder;
use super::parameter::parameters;
use super::triangle::Triangle;
use super::{Pattern, Sample, Setting};
use crate::math::Vector;
use crate::math::interval::Interval;

parameters! {
    /// 0 in the regular hexagon around the origin, with sides of length 1 and corners on the x axis; 1 in its
    /// neighbour along z, 2 in the neighbours of both; every three hexagons around a corner differ.
    ///
    /// **Source:** POV-Ray manual, section "Hexagon Pattern"; measured on POV-Ray 3.7.
    pub struct Hexagon {}
}

/// √3 / 2 to nine digits, as POV-Ray 3.7 has it: at z = 10⁶ the difference is visible.
const HEIGHT: f64 = 0.866_025_404;

impl Pattern for Hexagon {
    const COLORS: &[(f64, [f64; 3])] =
        &[(0.0, [0.0, 0.0, 1.0]), (1.0, [0.0, 1.0, 0.0]), (2.0, [1.0, 0.0, 0.0])];
    const LIST: Option<usize> = Some(3);
    const HAS_SEAMS: bool = true;
    const RANGE: Interval = Interval { low: 0.0, high: 2.0 };

    #[inline]
    fn value(&self, sample: &Sample) -> f64 {
        kind(Triangle::at(sample.point, sample.error, HEIGHT))
    }

    fn bounds(&self, point: Vector, reach: Vector, _setting: &Setting) -> Interval {
        let one = Triangle::around(point, reach, HEIGHT);
        one.map_or(Self::RANGE, |triangle| Interval::point(kind(triangle)))
    }
}

/// Returns the kind of the hexagon that contains a triangle.
#[inline]
fn kind(Triangle { u, v, is_upright }: Triangle) -> f64 {
    // A hexagon is the six triangles around its centre. The centres are the corners where v − u is
    // divisible by three: each triangle has one.
    let from_centre = match (remainder(v - u, 3), is_upright) {
        (0, true) => 0.0,
        (0, false) | (1, _) => 1.0,
        _ => 0.0,
    };
    f64::from(remainder(-(u + from_centre), 3))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Vector;
    use crate::pattern::{Kind, Setting, measured};

    #[test]
    fn values_are_those_of_pov_ray() {
        let table = include_str!("measured/hexagon.txt");
        measured::values_are_those_measured(Kind::of_word("hexagon"), table, 0.0);
    }

    #[test]
    fn a_hexagon_contains_its_lower_side() {
        let setting = Setting::default();
        let value = |z| {
            let (point, error) = (Vector::new(0.1, 0.0, z), Vector::splat(1e-12));
            Hexagon {}.value(&Sample { point, error, setting: &setting })
        };
        for off in [-9e-13, 0.0, 9e-13] {
            assert_eq!([value(HEIGHT + off), value(-HEIGHT + off)], [1.0, 0.0]);
        }
        assert_eq!([value(HEIGHT - 1e-9), value(-HEIGHT - 1e-9)], [0.0, 2.0]);
    }
}
