//! `crackle`: cells around random points, coloured by the distances to the nearest of them.

use super::parameter::parameters;
use super::scatter::{cell_at, numbers};
use super::{Pattern, Sample, Setting};
use crate::math::interval::Interval;
use crate::math::{Vector, elementary};
use crate::noise::noise;

parameters! {
    /// Each cell of the unit lattice contains a random point. The value is `form.x` times the distance to the
    /// nearest, plus `form.y` times that to the second nearest, plus `form.z` times that to the third, clamped
    /// to 0 … 1. With `solid`, it is the noise at the nearest of the points.
    ///
    /// The distance is (|x|ᵐ + |y|ᵐ + |z|ᵐ + offsetᵐ)^(1/m), with m the `metric`. Only the 81 cells around that
    /// of the point are searched that are two cells away along at most one axis.
    ///
    /// **Source:** POV-Ray manual, section "Crackle Pattern"; measured on POV-Ray 3.7: which cells are searched
    /// is evident with a negative metric.
    pub struct Crackle {
        "form" form: Vector = Vector::new(-1.0, 1.0, 0.0), "the factors of the three shortest distances";
        "metric" metric: f64 = 2.0, "the exponent of the distance";
        "offset" offset: f64 = 0.0, "the distance along a fourth axis";
        "solid" is_solid: bool = false, "whether each cell has one value";
    }
}

/// The points nearest to a point.
#[derive(Debug, Clone, Copy)]
struct Nearest {
    /// The sums of powers of the coordinates of the three nearest, in ascending order.
    sums: [f64; 3],
    /// The nearest one.
    point: Vector,
}

impl Nearest {
    /// Searches around `point` with a function that returns the power of a coordinate's absolute value, and
    /// rises with it if `is_rising`.
    #[inline]
    fn to(point: Vector, is_rising: bool, power: impl Fn(f64) -> f64) -> Self {
        let cell = point.floor();
        let fraction = point - cell;
        let own = cell_at(cell);
        // The least that each axis contributes for each of the cells −2 … 2.
        let least = fraction.to_array().map(|at| match is_rising {
            true => [1.0 + at, at, 0.0, 1.0 - at, 2.0 - at].map(&power),
            false => [0.0; 5],
        });
        let mut nearest = Self { sums: [f64::INFINITY; 3], point: cell };
        for [i, j, k] in NEIGHBOURS {
            if least[0][i] + least[1][j] + least[2][k] > nearest.sums[2] {
                continue;
            }
            let neighbour = Vector::new(i as f64 - 2.0, j as f64 - 2.0, k as f64 - 2.0);
            let inside = numbers([
                own[0].wrapping_add(i as i64 - 2),
                own[1].wrapping_add(j as i64 - 2),
                own[2].wrapping_add(k as i64 - 2),
            ]);
            let offset = neighbour + inside - fraction;
            let sum = power(offset.x) + power(offset.y) + power(offset.z);
            let [first, second, third] = nearest.sums;
            if sum < first {
                nearest = Self { sums: [sum, first, second], point: cell + neighbour + inside };
            } else if sum < second {
                nearest.sums = [first, sum, second];
            } else if sum < third {
                nearest.sums[2] = sum;
            }
        }
        nearest
    }
}

/// The cells that are searched, from near to far, as indices along each axis; 2 is the point's own cell.
const NEIGHBOURS: [[usize; 3]; 81] = neighbours();

const fn neighbours() -> [[usize; 3]; 81] {
    let mut found = [[0; 3]; 81];
    let mut count = 0;
    let mut ring = 0;
    while ring <= 6 {
        let mut at = 0_usize;
        while at < 125 {
            let [i, j, k] = [at / 25, at / 5 % 5, at % 5];
            let (x, y, z) = (i.abs_diff(2), j.abs_diff(2), k.abs_diff(2));
            if x / 2 + y / 2 + z / 2 <= 1 && x * x + y * y + z * z == ring {
                found[count] = [i, j, k];
                count += 1;
            }
            at += 1;
        }
        ring += 1;
    }
    found
}

/// Returns the random point that is nearest to a point.
pub(super) fn seed(point: Vector) -> Vector {
    Nearest::to(point, true, |along| along * along).point
}

impl Crackle {
    #[inline]
    fn nearest(&self, point: Vector) -> Nearest {
        let metric = self.metric;
        if metric == 2.0 {
            Nearest::to(point, true, |along| along * along)
        } else if metric == 1.0 {
            Nearest::to(point, true, f64::abs)
        } else {
            Nearest::to(point, metric > 0.0, |along| elementary::pow(along.abs(), metric))
        }
    }

    /// Returns the distance for a sum of powers.
    #[inline]
    fn distance(&self, sum: f64) -> f64 {
        let (metric, offset) = (self.metric, self.offset);
        if metric == 2.0 {
            (sum + offset * offset).sqrt()
        } else if metric == 1.0 {
            sum + offset
        } else if offset == 0.0 && metric > 0.0 {
            elementary::pow(sum, 1.0 / metric)
        } else {
            // A negative number has no power unless the metric is an integer.
            let along = elementary::pow(offset, metric);
            let along = if along.is_nan() { elementary::pow(-offset, metric) } else { along };
            elementary::pow(sum + along, 1.0 / metric)
        }
    }

    #[inline]
    fn value_of(&self, nearest: &Nearest, setting: &Setting) -> f64 {
        if self.is_solid {
            return noise(setting.noise, nearest.point);
        }
        let mut value = 0.0;
        for (axis, &sum) in nearest.sums.iter().enumerate() {
            // A distance that does not count may be infinite.
            if self.form[axis] != 0.0 {
                value += self.form[axis] * self.distance(sum);
            }
        }
        // ∞ − ∞ has no value.
        if value.is_nan() { 0.0 } else { value.clamp(0.0, 1.0) }
    }
}

impl Pattern for Crackle {
    const COST: &str = "the random points of the cells around a point";

    #[inline]
    fn value(&self, sample: &Sample) -> f64 {
        self.value_of(&self.nearest(sample.point), sample.setting)
    }

    fn bounds(&self, point: Vector, reach: Vector, setting: &Setting) -> Interval {
        let metric = self.metric;
        // Others have no triangle inequality, or powers that vanish.
        if !(1.0..=20.0).contains(&metric) || metric != 2.0 && self.offset < 0.0 || self.is_solid {
            return Self::RANGE;
        }
        let nearest = self.nearest(point);
        let root = |sum: f64| elementary::pow(sum, 1.0 / metric);
        // Both are more than the rounding errors.
        let [x, y, z] = reach.to_array().map(|along| elementary::pow(along.abs(), metric));
        let reach = root(x + y + z) + point.abs().max_element() * 1e-15;
        let rounded = 1e-15 * (8.0 + self.offset.abs());
        // Cells that are not searched are at least 1 away along two axes: within that, distances change as the
        // point moves.
        if root(nearest.sums[2]) + 2.0 * reach > 0.999 * root(2.0) {
            return Self::RANGE;
        }
        let value = self.value_of(&nearest, setting);
        let far = self.form.abs().element_sum() * (reach + rounded);
        Interval { low: (value - far).max(0.0), high: (value + far).min(1.0) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::{Random, tries_in};
    use crate::pattern::measured::{assert_close, rows};

    fn value(crackle: Crackle, point: Vector) -> f64 {
        crackle.value(&Sample { point, error: Vector::ZERO, setting: &Setting::default() })
    }

    #[test]
    fn values_are_those_of_pov_ray() {
        let rows = rows(include_str!("measured/crackle.txt"));
        assert!(rows.len() > 90);
        for [fx, fy, fz, metric, offset, solid, x, y, z, measured] in rows {
            let form = Vector::new(fx, fy, fz);
            let crackle = Crackle { form, metric, offset, is_solid: solid == 1.0 };
            let point = Vector::new(x, y, z);
            assert_close(value(crackle, point), measured, 1e-12, &(crackle, point));
        }
    }

    #[test]
    fn a_search_that_skips_cells_finds_what_one_that_does_not_finds() {
        let mut random = Random(4);
        for _ in 0..tries_in(10) {
            let point = random.point(100.0);
            let square = |along: f64| along * along;
            let (quick, slow) =
                (Nearest::to(point, true, square), Nearest::to(point, false, square));
            assert_eq!((quick.sums, quick.point), (slow.sums, slow.point), "{point}");
        }
    }

    #[test]
    fn values_around_a_point_are_within_its_bounds() {
        let mut random = Random(5);
        let mut narrow = 0;
        for tries in 0..tries_in(20) {
            let form = random.point(1.0);
            let metric = [1.0, 1.5, 2.0, 2.5, 10.0][tries % 5];
            let offset = random.number(if metric == 2.0 { -0.5 } else { 0.0 }, 0.5);
            let crackle = Crackle { form, metric, offset, ..Crackle::default() };
            let (point, reach) = (random.point(50.0), random.size(-4.0, -0.5));
            let bounds = crackle.bounds(point, Vector::splat(reach), &Setting::default());
            narrow += usize::from(bounds.high - bounds.low < 0.5);
            for _ in 0..5 {
                let value = value(crackle, point + random.point(reach));
                assert!(bounds.contains(value), "{crackle:?} {point} {reach}");
            }
        }
        assert!(narrow > tries_in(20) / 2, "{narrow}");
    }
}
