//! Sphere: |P − C| = r. Outward is away from the centre.

use super::{Approach, Bounds, Chord, Crossing, Ray, Rounding, SurfacePoint, U};
use crate::math::{Real, Vector, Vector3, reciprocal_power_of_two};

/// **Invariant:** `radius` > 0.
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

    /// The point of the sphere where `ray` crosses it at `t`: C + r·n.
    ///
    /// Its distance to the sphere is at most 4u·r (the length of n, the product) and u·|n|·|P| (the
    /// sum); the same again is for the start of the next ray, and 4u·r for its reading by [`chord`].
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

    /// The point of a planet below or above `rough`, which is nearly on it: what is left of
    /// |P − C| − r is taken off along the normal.
    ///
    /// Its distance to the sphere is at most u·|n|·|P| (the sum), 6u of what was taken off and
    /// 16u²·r (see [`fine_power`]); the same again is for the start of the next ray and its reading.
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

    /// Positive inside: r − |P − C|.
    pub fn signed_distance(&self, point: Vector) -> f64 {
        let scale = reciprocal_power_of_two(self.radius);
        self.radius - ((point - self.centre) * scale).length() / scale
    }

    pub fn contains(&self, point: Vector) -> bool {
        self.signed_distance(point) > 0.0
    }
}

/// The chord of a sphere; `None` when the ray's line misses or touches it.
///
/// With f = S − C, b = f·D, q = f − b·D and m = |q|, half the chord is h = √((r − m)(r + m)). The
/// crossing farther from the start is at |b| + h, on the side of −b; the nearer one is the constant
/// term |f|² − r² divided by it, so its sign, whether the start is inside, is right up to 4u·r of
/// the surface, however flat the ray.
///
/// **Domain:** radii from 1e-150 to 1e150, starts to 1e8 radii away. **Error:** see [`Roots::chord`].
///
/// **Source:** Haines, Günther, Akenine-Möller, Ray Tracing Gems (2019), ch. 7; the pair of roots:
/// N. Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed., §1.8.
#[inline(always)]
pub fn chord<R: Real>(centre: R::Vector, radius: R, ray: &Ray<R>) -> Option<Chord<R>> {
    Some(roots(centre, radius, ray)?.chord())
}

/// As [`chord`], its error bounds not yet computed.
#[inline(always)]
pub fn roots<R: Real>(centre: R::Vector, radius: R, ray: &Ray<R>) -> Option<Roots<R>> {
    Some(Roots::of(&ray.slide(centre), radius)?.refined(centre, radius, ray))
}

/// As [`roots`], but `None` too when the ray starts outside and moves away.
#[inline(always)]
pub fn roots_ahead<R: Real>(centre: R::Vector, radius: R, ray: &Ray<R>) -> Option<Roots<R>> {
    let near = ray.slide(centre);
    if near.along > R::ZERO && near.start.length_squared() > radius * radius {
        return None;
    }
    Some(Roots::of(&near, radius)?.refined(centre, radius, ray))
}

/// Whether a sphere is so much larger than the distance of a place from the origin that roundings
/// of r would blur what is there.
#[inline(always)]
fn is_planet<R: Real>(radius: R, place: R::Vector) -> bool {
    let is_larger = |axis| radius > R::from_f64(1024.0) * place.component(axis).abs();
    let square = radius * radius;
    (0..3).all(is_larger) && square > R::SAFE_SQUARES.0 && square < R::SAFE_SQUARES.1
}

/// |S − C|² − r² in twice the digits, rounded once: within u of itself and 32u²·r² of the truth,
/// where S is within 2r of C.
///
/// **Source:** T. Ogita, S. Rump, S. Oishi, "Accurate sum and dot product", SIAM J. Sci. Comput. 26
/// (2005), algorithm 5.3; T. Dekker, Numerische Mathematik 18 (1971).
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

/// a + b, and what the sum rounds off.
fn two_sum<R: Real>(a: R, b: R) -> (R, R) {
    let sum = a + b;
    let part = sum - a;
    (sum, (a - (sum - part)) + (b - part))
}

/// a², and what it rounds off.
fn square<R: Real>(a: R) -> (R, R) {
    let square = a * a;
    let spread = a * R::SPLITTER;
    let high = spread - (spread - a);
    let low = a - high;
    (square, ((high * high - square) + R::from_f64(2.0) * high * low) + low * low)
}

/// What a map into the sphere's space adds to the errors there.
#[derive(Debug, Clone, Copy)]
pub(super) struct Blur<R: Real = f64> {
    /// Across the ray.
    pub miss: R,
    /// Along the ray.
    pub along: R,
    /// Of |f|² − r².
    pub power: R,
    /// Of every distance, relative.
    pub scale: R,
}

/// The two crossings, and what their error bounds are made of.
#[derive(Debug, Clone, Copy)]
pub struct Roots<R: Real = f64> {
    enter: R,
    leave: R,
    /// h.
    half: R,
    /// m.
    miss: R,
    along: R,
    /// |f|² − r², and what its roundings are proportional to: 6|f|² + 2r², where nothing is refined.
    power: R,
    squares: R,
    /// All of these are lengths in this unit, in terms of the ray's.
    unit: R,
}

impl Roots {
    /// The crossing at `t`, one of the two, with a bound that is not the tightest but easily had;
    /// `None` so near the start that only the tightest tells whether it is ahead.
    ///
    /// With S = |b| + m + h ≥ |f|, r: the far crossing's bound F is at most √(14u)·S + 40u·S, and
    /// the near one's, where the far one is at S/1024 or beyond, 17·1024·u·S + F + 2u·S and a little
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

    /// `miss` ≥ 0 is the distance of the line to the centre, `start_squared` that of the start.
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

    /// The nearer crossing, computed anew where the ray starts just above or below the ground of a
    /// planet: there |f|² − r² is all rounding.
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

    /// Sizes whose squares leave the range of exponents: all is scaled by a power of two.
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

    /// Adds the error bounds, u the roundoff and A = |b| + m ≥ |f|:
    /// * h² is off by δ = u·(14·m·A + 4·h²) + (16·u·A)², so h by min(δ/h, √δ) + 8u·h;
    /// * the far crossing by F = that + 16u·A;
    /// * |f|² − r² by P = u·(6|f|² + 2r² + 9·||f|² − r²|), so the near crossing by
    ///   (P + |near|·F) / (far − F) + 2u·|near|; or, when far ≤ 2F, by F and the distance to the
    ///   same crossing found as a sum.
    ///
    /// The bounds of a map before it (`blur`) are added to A's, h²'s and P's.
    ///
    /// The terms are those of [`Ray::slide`] and of γₙ = n·u/(1 − n·u) for sums and products.
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
