//! Stretches of a line on which every orbit certainly escapes, or none does, for maps that are a power and a
//! sum.
//!
//! **In:** a position on a line. **Out:** how far from there the orbits of all lines that may be intended do
//! the same. **Invariant:** never too far; 0 says nothing. The orbit is a Taylor polynomial of first degree in
//! the distance, with a bound on its second derivative: H = h + δ·h′ + R with |R| ≤ ½·S·δ².
//!
//! **Source:** K. Makino, M. Berz, "Taylor models and other validated functional inclusion methods",
//! International Journal of Pure and Applied Mathematics 4 (2003).

use super::ball::{Ball, Multiply};
use super::{Algebra, Function, JuliaFractal};
use crate::shape::U;
use crate::shape::local::LocalRay;

/// How far the orbits are alike, and whether they escape.
pub type Stretch = (f64, bool);

/// Norm from which on no later number is looked at, relative to what escapes.
const BEYOND: f64 = 1.5;

/// A number of an orbit, or an independent part of it.
struct Part<const N: usize> {
    value: [f64; N],
    slope: [f64; N],
    /// Error bounds of both.
    value_off: f64,
    slope_off: f64,
    /// Bound on the norm of the second derivative.
    bend: f64,
}

impl JuliaFractal {
    /// Returns the stretch from a position on, at most as long as given; `None` for functions without a
    /// known bound on it.
    pub(super) fn stretch(&self, ray: &LocalRay, s: f64, most: f64) -> Option<Stretch> {
        let blur = ray.blur_at(s.abs() + most);
        let start = self.lift(ray.at(s), blur + 16.0 * U * (self.radius() + s.abs()));
        let way = self.way(ray.direction, ray.turn);
        let whole = |number: Ball<4>| (number.middle, number.radius);
        let half = |sign: f64| {
            let half = |number: Ball<4>| {
                let [x, y, z, w] = number.middle;
                // Each half is √2 times as far off as the number, at most.
                ([x - sign * w, y + sign * z], 1.5 * number.radius + 4.0 * U * number.size())
            };
            (part(half(start), half(way)), half(Ball::point(self.parameter)).0)
        };
        match self.algebra {
            Algebra::Quaternion { is_cube } => {
                let all = [part(whole(start), whole(way))];
                Some(self.stretch_of(all, [self.parameter], most, is_cube))
            }
            Algebra::Hypercomplex(function @ (Function::Sqr | Function::Cube)) => {
                let [(a, p), (b, q)] = [1.0, -1.0].map(half);
                Some(self.stretch_of([a, b], [p, q], most, function == Function::Cube))
            }
            Algebra::Hypercomplex(_) => None,
        }
    }

    /// Like [`Self::stretch`], of parts whose squared norms add up to the number's squared norm times their
    /// count.
    fn stretch_of<const N: usize, const K: usize>(
        &self,
        mut parts: [Part<N>; K],
        parameters: [[f64; N]; K],
        most: f64,
        is_cube: bool,
    ) -> Stretch
    where
        [f64; N]: Multiply,
    {
        let bound = self.radius() * (K as f64).sqrt();
        let parameter_sizes = parameters.map(|parameter| norm(&parameter));
        let (mut outside, mut is_inside) = (0.0_f64, true);
        for step in 1..=self.iterations {
            let sizes = parts.each_ref().map(|part| norm(&part.value));
            let size = total(sizes);
            if size > bound {
                let off = total(parts.each_ref().map(|part| part.value_off));
                let slope_off = total(parts.each_ref().map(|part| part.slope_off));
                let room = size - bound - off - 16.0 * U * size;
                let along: f64 = parts.iter().map(|part| dot(&part.value, &part.slope)).sum();
                let speed = total(parts.each_ref().map(|part| norm(&part.slope)));
                let rise = along / size - slope_off - 16.0 * U * speed;
                if room > 0.0 {
                    let bend = total(parts.each_ref().map(|part| part.bend));
                    outside = outside.max(first_zero(room, rise, bend)).min(most);
                }
            }
            if size > BEYOND * bound || size.is_nan() {
                break;
            }
            let mut fars = sizes;
            for (i, part) in parts.iter_mut().enumerate() {
                let (next, far) =
                    part.next(sizes[i], (&parameters[i], parameter_sizes[i]), most, is_cube);
                fars[i] = far;
                *part = next;
            }
            is_inside &= total(fars) * (1.0 + 16.0 * U) < bound;
            if step == self.iterations {
                break;
            }
        }
        match outside > 0.0 {
            true => (outside, true),
            false => (if is_inside { most } else { 0.0 }, false),
        }
    }
}

/// Returns the norm of parts of these norms.
fn total<const K: usize>(norms: [f64; K]) -> f64 {
    if K == 1 { norms[0] } else { norm(&norms) }
}

fn part<const N: usize>(
    (value, value_off): ([f64; N], f64),
    (slope, slope_off): ([f64; N], f64),
) -> Part<N> {
    Part { value, slope, value_off, slope_off, bend: 0.0 }
}

impl<const N: usize> Part<N>
where
    [f64; N]: Multiply,
{
    /// Returns the power with the parameter added, valid up to the distance `most`; and a bound on this
    /// number's own norm up to there.
    #[inline(always)]
    fn next(
        &self,
        size: f64,
        (parameter, parameter_size): (&[f64; N], f64),
        most: f64,
        is_cube: bool,
    ) -> (Self, f64) {
        let Self { value: h, slope: d, value_off, slope_off, bend } = self;
        let speed = norm(d);
        // At the position, and everywhere up to there.
        let (near, near_speed) = (size + value_off, speed + slope_off);
        let far_speed = near_speed + most * bend;
        let far = near + most * (near_speed + 0.5 * most * bend);
        let square = h.times(h);
        let turned = sum(&h.times(d), &d.times(h));
        let rounded = 64.0 * U;
        let (value, slope, value_off, slope_off, bend) = match is_cube {
            false => (
                square,
                turned,
                value_off * (size + near) + rounded * (size * size + parameter_size),
                2.0 * (near * slope_off + value_off * speed) + rounded * size * speed,
                2.0 * (far_speed * far_speed + far * bend),
            ),
            true => (
                square.times(h),
                sum(&turned.times(h), &square.times(d)),
                3.0 * value_off * near * near + rounded * (size * size * size + parameter_size),
                3.0 * (near * near * slope_off + value_off * (size + near) * speed)
                    + rounded * size * size * speed,
                far * (6.0 * far_speed * far_speed + 3.0 * far * bend),
            ),
        };
        let grown = 1.0 + 64.0 * U;
        let next = Self {
            value: sum(&value, parameter),
            slope,
            value_off: value_off * grown,
            slope_off: slope_off * grown,
            bend: bend * grown,
        };
        (next, far)
    }
}

/// Returns the first positive zero of `room` + `rise`·x − ½·`bend`·x², or slightly less.
fn first_zero(room: f64, rise: f64, bend: f64) -> f64 {
    let root = (rise * rise + 2.0 * bend * room).sqrt();
    let zero = if rise < 0.0 { 2.0 * room / (root - rise) } else { (rise + root) / bend };
    // Infinite where nothing bends; NaN where nothing moves.
    if zero.is_nan() { 0.0 } else { zero * (1.0 - 64.0 * U) }
}

fn norm<const N: usize>(number: &[f64; N]) -> f64 {
    dot(number, number).sqrt()
}

fn dot<const N: usize>(a: &[f64; N], b: &[f64; N]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn sum<const N: usize>(a: &[f64; N], b: &[f64; N]) -> [f64; N] {
    std::array::from_fn(|i| a[i] + b[i])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::{Random, tries};

    #[test]
    fn on_a_stretch_all_orbits_do_the_same() {
        let mut random = Random(143);
        let mut long = 0;
        for _ in 0..tries() {
            let algebra = match random.below(4) {
                power @ 0..2 => Algebra::Quaternion { is_cube: power == 1 },
                2 => Algebra::Hypercomplex(Function::Sqr),
                _ => Algebra::Hypercomplex(Function::Cube),
            };
            let fractal = JuliaFractal {
                parameter: [(); 4].map(|()| random.number(-0.6, 0.6)),
                algebra,
                iterations: 1 + random.below(8) as u32,
                normal: [0.0, 0.0, 0.6, 0.8],
                distance: random.number(-0.3, 0.3),
            };
            let direction = random.direction().get();
            let nearest = random.direction().get().cross(direction) * random.number(0.0, 1.0);
            let ray = LocalRay::exact(nearest, direction);
            let s = fractal.radius() * random.number(-1.0, 1.0);
            let most = random.size(-3.0, 0.0);
            let (far, escapes) = fractal.stretch(&ray, s, most).expect("a power");
            assert!((0.0..=most).contains(&far), "{far}");
            for _ in 0..8 {
                let (value, _) = fractal.at(ray.at(s + far * random.number(0.0, 1.0)));
                let is_so = if escapes { value.high > 0.0 } else { value.low < 0.0 };
                assert!(far == 0.0 || is_so, "{fractal:?} {ray:?} {s} {far} {value:?}");
            }
            long += usize::from(far > 0.1 * most);
        }
        assert!(long > tries() / 2, "{long}");
    }
}
