//! Sphere: |P − C| = r. The outside is away from the centre.

use super::{Approach, Bounds, Chord, Crossing, Ray, Rounding, SurfacePoint, U};
use crate::math::{Real, Vector, Vector3, reciprocal_power_of_two};

/// A sphere. **Invariant:** `radius` > 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sphere {
    pub centre: Vector,
    pub radius: f64,
}

impl Sphere {
    #[inline(always)]
    pub fn chord(&self, ray: &Ray) -> Option<Chord> {
        chord(self.centre, self.radius, ray)
    }

    /// Returns the point where `ray` crosses the sphere at `t`: C + r·n.
    ///
    /// Its distance to the sphere is at most 4u·r (length of n, product) plus u·|n|·|P| (sum). The error
    /// counts this twice, the second time for the start of the next ray, and adds 4u·r for the evaluation by
    /// [`chord`].
    #[inline(always)]
    pub fn surface(&self, ray: &Ray, t: f64) -> SurfacePoint {
        let rough = ray.at(t);
        if is_planet(self.radius, rough) {
            return self.ground(rough);
        }
        let near = ray.slide(self.centre);
        let from_centre = near.offset + ray.direction * (t + near.along);
        let scale = reciprocal_power_of_two(self.radius);
        let normal = (from_centre * scale).normalize_or(-ray.direction);
        let point = self.centre + normal * self.radius;
        let error = U * (12.0 * self.radius + 2.0 * normal.abs_dot(point));
        SurfacePoint { point, normal, error, face: 0 }
    }

    /// Returns the surface point of a planet near `rough`, which is almost on it: the residual of |P − C| − r
    /// is subtracted along the normal.
    ///
    /// Its distance to the sphere is at most u·|n|·|P| (sum), 6u of the residual, and 16u²·r (see
    /// [`fine_power`]). The error counts this twice, the second time for the start of the next ray and its
    /// evaluation.
    #[cold]
    fn ground(&self, rough: Vector) -> SurfacePoint {
        let from_centre = rough - self.centre;
        let distance = from_centre.length();
        let normal = from_centre / distance;
        let height = fine_power(rough, self.centre, self.radius) / (distance + self.radius);
        let point = rough - normal * height;
        let error =
            U * (4.0 * normal.abs_dot(point) + 16.0 * height.abs()) + U * U * (64.0 * self.radius);
        SurfacePoint { point, normal, error, face: 0 }
    }

    pub fn bounds(&self, rounding: Rounding) -> Bounds {
        let extent = Vector::splat(self.radius);
        Bounds::around(self.centre, [-extent, extent], extent * (8.0 * U), rounding)
    }

    /// Returns r − |P − C|, positive inside.
    pub fn signed_distance(&self, point: Vector) -> f64 {
        let scale = reciprocal_power_of_two(self.radius);
        self.radius - ((point - self.centre) * scale).length() / scale
    }

    pub fn contains(&self, point: Vector) -> bool {
        self.signed_distance(point) > 0.0
    }
}

/// Returns the chord of a sphere; `None` if the ray's line misses or touches it.
///
/// With f = S − C, b = f·D, q = f − b·D and m = |q|, half the chord is h = √((r − m)(r + m)). The crossing
/// farther from the start is at |b| + h, on the side of −b. The nearer crossing is the constant term |f|² −
/// r² divided by it, so its sign, which says whether the start is inside, is correct down to 4u·r from the
/// surface, however flat the ray.
///
/// **Domain:** radii from 1e-150 to 1e150, starts up to 1e8 radii away. **Error:** see [`Roots::chord`].
///
/// **Source:** Haines, Günther, Akenine-Möller, Ray Tracing Gems (2019), ch. 7; the pair of roots: N. Higham,
/// Accuracy and Stability of Numerical Algorithms, 2nd ed., §1.8.
#[inline(always)]
pub fn chord<R: Real>(centre: R::Vector, radius: R, ray: &Ray<R>) -> Option<Chord<R>> {
    Some(roots(centre, radius, ray)?.chord())
}

/// Returns the roots for [`chord`], without computing their error bounds.
#[inline(always)]
pub fn roots<R: Real>(centre: R::Vector, radius: R, ray: &Ray<R>) -> Option<Roots<R>> {
    Some(Roots::of(&ray.slide(centre), radius)?.refined(centre, radius, ray))
}

/// Returns [`roots`], but also `None` if the ray starts outside and moves away.
#[inline(always)]
pub fn roots_ahead<R: Real>(centre: R::Vector, radius: R, ray: &Ray<R>) -> Option<Roots<R>> {
    let near = ray.slide(centre);
    if near.along > R::ZERO && near.start.length_squared() > radius * radius {
        return None;
    }
    Some(Roots::of(&near, radius)?.refined(centre, radius, ray))
}

/// Returns whether the sphere is so much larger than the distance of `place` from the origin that roundings
/// of r would blur the surface there.
#[inline(always)]
fn is_planet<R: Real>(radius: R, place: R::Vector) -> bool {
    let is_larger = |axis| radius > R::from_f64(1024.0) * place.component(axis).abs();
    let square = radius * radius;
    (0..3).all(is_larger) && square > R::SAFE_SQUARES.0 && square < R::SAFE_SQUARES.1
}

/// |S − C|² − r² in twice the precision, rounded once: within u of itself plus 32u²·r² of the exact value,
/// where S is within 2r of C.
///
/// **Source:** T. Ogita, S. Rump, S. Oishi, "Accurate sum and dot product", SIAM J. Sci. Comput. 26 (2005),
/// algorithm 5.3; T. Dekker, Numerische Mathematik 18 (1971).
fn fine_power<R: Real>(start: R::Vector, centre: R::Vector, radius: R) -> R {
    let (square, mut rest) = square(radius);
    let (mut sum, mut low) = (-square, R::ZERO);
    rest = -rest;
    for axis in 0..3 {
        let (high, error) = two_sum(start.component(axis), -centre.component(axis));
        let (high_square, square_rest) = self::square(high);
        (sum, low) = {
            let (sum, lost) = two_sum(sum, high_square);
            (sum, low + lost)
        };
        rest = rest + square_rest + (high + high + error) * error;
    }
    sum + (low + rest)
}

/// a + b, and the rounding error of the sum.
fn two_sum<R: Real>(a: R, b: R) -> (R, R) {
    let sum = a + b;
    let part = sum - a;
    (sum, (a - (sum - part)) + (b - part))
}

/// a², and its rounding error.
fn square<R: Real>(a: R) -> (R, R) {
    let square = a * a;
    let spread = a * R::SPLITTER;
    let high = spread - (spread - a);
    let low = a - high;
    (square, ((high * high - square) + R::from_f64(2.0) * high * low) + low * low)
}

/// Error that a transformation into the sphere's space adds.
#[derive(Debug, Clone, Copy)]
pub(super) struct Blur<R: Real = f64> {
    /// Error across the ray.
    pub miss: R,
    /// Error along the ray.
    pub along: R,
    /// Error of |f|² − r².
    pub power: R,
    /// Relative error of every distance.
    pub scale: R,
}

/// The two crossings, and the terms of their error bounds.
#[derive(Debug, Clone, Copy)]
pub struct Roots<R: Real = f64> {
    enter: R,
    leave: R,
    /// h, half the chord.
    half: R,
    /// m, the distance of the line from the centre.
    miss: R,
    along: R,
    /// |f|² − r², and the quantity its roundings are proportional to: 6|f|² + 2r² where nothing is refined.
    power: R,
    squares: R,
    /// The unit of all these lengths, in the ray's units.
    unit: R,
}

impl Roots {
    /// Returns the crossing at `t`, one of the two, with a loose but cheap bound; `None` so near the start
    /// that only the tight bound can decide whether it is ahead.
    ///
    /// With S = |b| + m + h ≥ |f|, r: the far crossing's bound F is at most √(14u)·S + 40u·S. The near one's
    /// bound, where the far one is at S/1024 or beyond, is at most 17·1024·u·S + F + 2u·S and a little more
    /// (see [`Roots::chord`]). Both are below S/2²⁰.
    #[inline(always)]
    pub fn roughly(&self, t: f64) -> Option<Crossing> {
        let size = (self.along.abs() + self.miss + self.half) * self.unit;
        let clear = t > size / 1024.0;
        clear.then_some(Crossing { t, error: size / 1_048_576.0 })
    }
}

impl<R: Real> Roots<R> {
    #[inline(always)]
    fn of(near: &Approach<R>, radius: R) -> Option<Self> {
        let miss_squared = near.offset.length_squared();
        let radius_squared = radius * radius;
        if miss_squared > radius_squared {
            return None;
        }
        let start_squared = near.start.length_squared();
        let size = start_squared + radius_squared;
        if size > R::SAFE_SQUARES.0 && size < R::SAFE_SQUARES.1 {
            Self::solve(near.along, miss_squared.sqrt(), radius, start_squared, R::ONE)
        } else {
            Self::rescaled(near, radius)
        }
    }

    /// Solves for the crossings. `miss` ≥ 0 is the distance of the line to the centre, `start_squared` the
    /// squared distance of the start.
    #[inline(always)]
    pub(super) fn solve(along: R, miss: R, radius: R, start_squared: R, unit: R) -> Option<Self> {
        let half = ((radius - miss) * (radius + miss)).sqrt();
        // Also so when `half` is no number: `miss` a little over `radius`.
        if !half.gt(&R::ZERO) {
            return None;
        }
        let number = R::from_f64;
        let radius_squared = radius * radius;
        let power = start_squared - radius_squared;
        let squares = number(6.0) * start_squared + number(2.0) * radius_squared;
        let far = along.abs() + half;
        let near = power / far;
        let near = if near < far { near } else { far };
        let (enter, leave) = if along > R::ZERO { (-far, -near) } else { (near, far) };
        Some(Self { enter, leave, half, miss, along, power, squares, unit })
    }

    /// Recomputes the nearer crossing where the ray starts just above or below the ground of a planet: there
    /// |f|² − r² is dominated by rounding.
    #[inline(always)]
    fn refined(self, centre: R::Vector, radius: R, ray: &Ray<R>) -> Self {
        let number = R::from_f64;
        let close = number(1024.0) * self.power.abs() < radius * radius;
        if close && self.unit == R::ONE && is_planet(radius, ray.origin) {
            self.with_power(fine_power(ray.origin, centre, radius), radius)
        } else {
            self
        }
    }

    #[cold]
    fn with_power(self, power: R, radius: R) -> Self {
        let squares = R::from_f64(64.0) * R::UNIT_ROUNDOFF * radius * radius;
        let far = self.along.abs() + self.half;
        let near = (power / far).min(far);
        let (enter, leave) = if self.along > R::ZERO { (-far, -near) } else { (near, far) };
        Self { enter, leave, power, squares, ..self }
    }

    /// Solves for sizes whose squares overflow or underflow: all values are scaled by a power of two.
    #[cold]
    fn rescaled(near: &Approach<R>, radius: R) -> Option<Self> {
        let size = (0..3).fold(radius, |size, axis| size.max(near.start.component(axis).abs()));
        let scale = R::from_f64(reciprocal_power_of_two(size.to_f64()));
        Self::solve(
            near.along * scale,
            (near.offset * scale).length_squared().sqrt(),
            radius * scale,
            (near.start * scale).length_squared(),
            R::ONE / scale,
        )
    }

    #[inline(always)]
    pub fn enter(&self) -> R {
        self.enter * self.unit
    }

    #[inline(always)]
    pub fn leave(&self) -> R {
        self.leave * self.unit
    }

    /// Returns the chord with error bounds, u the roundoff and A = |b| + m ≥ |f|:
    /// * h² is off by δ = u·(14·m·A + 4·h²) + (16·u·A)², so h is off by min(δ/h, √δ) + 8u·h;
    /// * the far crossing is off by F = that + 16u·A;
    /// * |f|² − r² is off by P = u·(6|f|² + 2r² + 9·||f|² − r²|), so the near crossing is off by (P +
    ///   |near|·F) / (far − F) + 2u·|near|; or, if far ≤ 2F, by F and the distance to the same crossing found
    ///   as a sum.
    ///
    /// The bounds of a preceding transformation (`blur`) are added to those of A, h² and P.
    ///
    /// The terms follow from [`Ray::slide`] and from γₙ = n·u/(1 − n·u) for sums and products.
    #[inline]
    pub fn chord(&self) -> Chord<R> {
        let none = Blur { miss: R::ZERO, along: R::ZERO, power: R::ZERO, scale: R::ZERO };
        self.blurred_chord(none)
    }

    #[inline(always)]
    pub(super) fn blurred_chord(&self, blur: Blur<R>) -> Chord<R> {
        let number = R::from_f64;
        let u = R::UNIT_ROUNDOFF;
        let size = self.along.abs() + self.miss;
        let slid = number(16.0) * u * size + blur.along;
        let square_error = u
            * (number(14.0) * self.miss * size + number(4.0) * self.half * self.half)
            + slid * slid
            + blur.miss * (number(2.0) * self.miss + blur.miss);
        let half_error = if square_error < self.half * self.half {
            square_error / self.half
        } else {
            square_error.sqrt()
        };
        let far_error = half_error + slid + number(8.0) * u * self.half;

        let (far, near) = if self.along > R::ZERO {
            (-self.enter, -self.leave)
        } else {
            (self.leave, self.enter)
        };
        let near_error = if far > far_error + far_error {
            let power_error = u * (self.squares + number(9.0) * self.power.abs()) + blur.power;
            (power_error + near.abs() * far_error) / (far - far_error)
                + number(2.0) * u * near.abs()
        } else {
            far_error + (near - (self.along.abs() - self.half)).abs()
        };

        let (enter_error, leave_error) =
            if self.along > R::ZERO { (far_error, near_error) } else { (near_error, far_error) };
        let crossing = |t: R, error: R| Crossing {
            t: t * self.unit,
            error: (error + t.abs() * blur.scale) * self.unit,
        };
        Chord { enter: crossing(self.enter, enter_error), leave: crossing(self.leave, leave_error) }
    }
}
