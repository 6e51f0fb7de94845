//! `triangular`: triangular rods along y in six kinds.

use super::lattice::remainder;
use super::parameter::parameters;
use super::triangle::Triangle;
use super::{Cubic, Pattern, Sample, Setting};
use crate::math::Vector;
use crate::math::interval::Interval;

parameters! {
    /// A different number from 0 to 5 in each of the six triangles around a corner, which have sides of length
    /// 1. At the origin they are 0 in the first sixth of a turn from x towards z, and then on from 1 to 5.
    ///
    /// **Source:** POV-Ray manual, section "Triangular Pattern"; measured on POV-Ray 3.7.
    pub struct Triangular {}
}

/// √3 / 2.
const HEIGHT: f64 = 0.866_025_403_784_438_6;

impl Pattern for Triangular {
    const COLORS: &[(f64, [f64; 3])] = Cubic::COLORS;
    const LIST: Option<usize> = Some(6);
    const HAS_SEAMS: bool = true;
    const RANGE: Interval = Interval { low: 0.0, high: 5.0 };

    #[inline]
    fn value(&self, sample: &Sample) -> f64 {
        kind(Triangle::at(sample.point, sample.error, HEIGHT))
    }

    fn bounds(&self, point: Vector, reach: Vector, _setting: &Setting) -> Interval {
        let one = Triangle::around(point, reach, HEIGHT);
        one.map_or(Self::RANGE, |triangle| Interval::point(kind(triangle)))
    }
}

/// Returns the number of a triangle.
#[inline]
fn kind(Triangle { u, v, is_upright }: Triangle) -> f64 {
    let class = remainder(v - u, 3);
    f64::from(if is_upright { 2 * class } else { (9 - 2 * class) % 6 })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{Vector, elementary};
    use crate::pattern::{Kind, Setting, measured};

    #[test]
    fn values_are_those_of_pov_ray() {
        let table = include_str!("measured/triangular.txt");
        measured::values_are_those_measured(Kind::of_word("triangular"), table, 0.0);
    }

    #[test]
    fn the_triangles_around_the_origin_all_differ() {
        let (setting, error) = (Setting::default(), Vector::ZERO);
        let around = [0, 1, 2, 3, 4, 5].map(|sixth| {
            let (sine, cosine) = elementary::sin_cos_degrees(30.0 + 60.0 * f64::from(sixth));
            let point = Vector::new(0.5 * cosine, 0.0, 0.5 * sine);
            Triangular {}.value(&Sample { point, error, setting: &setting })
        });
        assert_eq!(around, [0.0, 1.0, 2.0, 3.0, 4.0, 5.0]);
    }
}
