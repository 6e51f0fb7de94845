//! Sphere: |P − C| = r. The outside is away from the centre.

use super::{Approach, Bounds, Chord, Crossing, Ray, Rounding, SurfacePoint, U};
use crate::math::{AbsDot, Vector, reciprocal_power_of_two};

/// A sphere. **Invariant:** `radius` > 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sphere {
    pub centre: Vector,
    pub radius: f64,
}

impl Sphere {
    /// Sums of squares between these neither overflow nor underflow, and neither do their parts, down to the square
    /// of the roundoff: 2⁻⁹⁰⁰ to 2¹⁰⁰⁰.
    pub(super) const SAFE_SQUARES: [f64; 2] =
        [f64::from_bits(123 << 52), f64::from_bits(2023 << 52)];

    /// Returns the chord; `None` if the ray's line misses or touches it.
    ///
    /// With f = S − C, b = f·D, q = f − b·D and m = |q|, half the chord is h = √((r − m)(r + m)). The
    /// crossing farther from the start is at |b| + h, on the side of −b. The nearer crossing is the constant
    /// term |f|² − r² divided by it, so its sign, which says whether the start is inside, is correct down to
    /// 4u·r from the surface, however flat the ray.
    ///
    /// **Domain:** radii from 1e-150 to 1e150, starts up to 1e8 radii away. **Error:** see `Roots::chord`.
    ///
    /// **Source:** Haines, Günther, Akenine-Möller, Ray Tracing Gems (2019), ch. 7; the pair of roots: N.
    /// Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed., §1.8.
    #[inline(always)]
    pub fn chord(&self, ray: &Ray) -> Option<Chord> {
        let roots = Roots::of(&ray.slide(self.centre), self.radius)?;
        Some(roots.refined(self.centre, self.radius, ray).chord())
    }

    /// Returns the roots for [`Sphere::chord`], without computing their error bounds; `None` also if the ray
    /// starts outside and moves away.
    #[inline(always)]
    pub fn roots_ahead(&self, ray: &Ray) -> Option<Roots> {
        let near = ray.slide(self.centre);
        if near.along > 0.0 && near.start.length_squared() > self.radius * self.radius {
            return None;
        }
        Some(Roots::of(&near, self.radius)?.refined(self.centre, self.radius, ray))
    }

    /// Returns the point where `ray` crosses the sphere at `t`: C + r·n.
    ///
    /// Its distance to the sphere is at most 4u·r (length of n, product) plus u·|n|·|P| (sum). The error
    /// counts this twice, the second time for the start of the next ray, and adds 4u·r for the evaluation by
    /// [`Sphere::chord`].
    #[inline(always)]
    pub fn surface(&self, ray: &Ray, t: f64) -> SurfacePoint {
        let rough = ray.at(t);
        if is_planet(self.radius, rough) {
            return self.ground(rough);
        }
        let near = ray.slide(self.centre);
        let from_centre = near.offset + ray.direction * (t + near.along);
        let normal = (from_centre * self.scale()).normalize_or(-ray.direction);
        let point = self.centre + normal * self.radius;
        let error = U * (12.0 * self.radius + 2.0 * normal.abs_dot(point));
        SurfacePoint { point, normal, error, face: 0 }
    }

    /// Returns a power of two that makes the square of the radius a number of ordinary size.
    #[inline(always)]
    pub(crate) fn scale(&self) -> f64 {
        reciprocal_power_of_two(self.radius)
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

/// Returns whether the sphere is so much larger than the distance of `place` from the origin that roundings
/// of r would blur the surface there.
#[inline(always)]
fn is_planet(radius: f64, place: Vector) -> bool {
    let is_larger = |axis| radius > 1024.0 * place[axis].abs();
    let square = radius * radius;
    (0..3).all(is_larger) && are_safe(square)
}

/// Returns whether a sum of squares is one of [`Sphere::SAFE_SQUARES`].
#[inline(always)]
fn are_safe(squares: f64) -> bool {
    let [least, most] = Sphere::SAFE_SQUARES;
    squares > least && squares < most
}

/// |S − C|² − r² in twice the precision, rounded once: within u of itself plus 32u²·r² of the exact value,
/// where S is within 2r of C.
///
/// **Source:** T. Ogita, S. Rump, S. Oishi, "Accurate sum and dot product", SIAM J. Sci. Comput. 26 (2005),
/// algorithm 5.3; T. Dekker, Numerische Mathematik 18 (1971).
fn fine_power(start: Vector, centre: Vector, radius: f64) -> f64 {
    let (square, mut rest) = square(radius);
    let (mut sum, mut low) = (-square, 0.0);
    rest = -rest;
    for axis in 0..3 {
        let (high, error) = two_sum(start[axis], -centre[axis]);
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
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let part = sum - a;
    (sum, (a - (sum - part)) + (b - part))
}

/// 2²⁷ + 1: multiplication by it splits a number into two of half as many bits.
const SPLITTER: f64 = 134_217_729.0;

/// a², and its rounding error.
fn square(a: f64) -> (f64, f64) {
    let square = a * a;
    let spread = a * SPLITTER;
    let high = spread - (spread - a);
    let low = a - high;
    (square, ((high * high - square) + 2.0 * high * low) + low * low)
}

/// Error that a transformation into the sphere's space adds.
#[derive(Debug, Clone, Copy)]
pub(super) struct Blur {
    /// Error across the ray.
    pub miss: f64,
    /// Error along the ray.
    pub along: f64,
    /// Error of |f|² − r².
    pub power: f64,
    /// Relative error of every distance.
    pub scale: f64,
}

/// The two crossings, and the terms of their error bounds.
#[derive(Debug, Clone, Copy)]
pub struct Roots {
    enter: f64,
    leave: f64,
    /// h, half the chord.
    half: f64,
    /// m, the distance of the line from the centre.
    miss: f64,
    along: f64,
    /// |f|² − r², and the quantity its roundings are proportional to: 6|f|² + 2r² where nothing is refined.
    power: f64,
    squares: f64,
    /// The unit of all these lengths, in the ray's units.
    unit: f64,
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

    #[inline(always)]
    fn of(near: &Approach, radius: f64) -> Option<Self> {
        let miss_squared = near.offset.length_squared();
        let radius_squared = radius * radius;
        if miss_squared > radius_squared {
            return None;
        }
        let start_squared = near.start.length_squared();
        let size = start_squared + radius_squared;
        if are_safe(size) {
            Self::solve(near.along, miss_squared.sqrt(), radius, start_squared, 1.0)
        } else {
            Self::rescaled(near, radius)
        }
    }

    /// Solves for the crossings. `miss` ≥ 0 is the distance of the line to the centre, `start_squared` the
    /// squared distance of the start.
    #[inline(always)]
    pub(super) fn solve(
        along: f64,
        miss: f64,
        radius: f64,
        start_squared: f64,
        unit: f64,
    ) -> Option<Self> {
        let half = ((radius - miss) * (radius + miss)).sqrt();
        // It is no number where `miss` is a little over `radius`.
        if half.is_nan() || half <= 0.0 {
            return None;
        }
        let radius_squared = radius * radius;
        let power = start_squared - radius_squared;
        let squares = 6.0 * start_squared + 2.0 * radius_squared;
        let far = along.abs() + half;
        let near = power / far;
        let near = if near < far { near } else { far };
        let (enter, leave) = if along > 0.0 { (-far, -near) } else { (near, far) };
        Some(Self { enter, leave, half, miss, along, power, squares, unit })
    }

    /// Recomputes the nearer crossing where the ray starts just above or below the ground of a planet: there
    /// |f|² − r² is dominated by rounding.
    #[inline(always)]
    fn refined(self, centre: Vector, radius: f64, ray: &Ray) -> Self {
        let close = 1024.0 * self.power.abs() < radius * radius;
        if close && self.unit == 1.0 && is_planet(radius, ray.origin) {
            self.with_power(fine_power(ray.origin, centre, radius), radius)
        } else {
            self
        }
    }

    #[cold]
    fn with_power(self, power: f64, radius: f64) -> Self {
        let squares = 64.0 * U * radius * radius;
        let far = self.along.abs() + self.half;
        let near = (power / far).min(far);
        let (enter, leave) = if self.along > 0.0 { (-far, -near) } else { (near, far) };
        Self { enter, leave, power, squares, ..self }
    }

    /// Solves for sizes whose squares overflow or underflow: all values are scaled by a power of two.
    #[cold]
    fn rescaled(near: &Approach, radius: f64) -> Option<Self> {
        let size = (0..3).fold(radius, |size, axis| size.max(near.start[axis].abs()));
        let scale = reciprocal_power_of_two(size);
        Self::solve(
            near.along * scale,
            (near.offset * scale).length_squared().sqrt(),
            radius * scale,
            (near.start * scale).length_squared(),
            1.0 / scale,
        )
    }

    #[inline(always)]
    pub fn enter(&self) -> f64 {
        self.enter * self.unit
    }

    #[inline(always)]
    pub fn leave(&self) -> f64 {
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
    pub fn chord(&self) -> Chord {
        let none = Blur { miss: 0.0, along: 0.0, power: 0.0, scale: 0.0 };
        self.blurred_chord(none)
    }

    #[inline(always)]
    pub(super) fn blurred_chord(&self, blur: Blur) -> Chord {
        let size = self.along.abs() + self.miss;
        let slid = 16.0 * U * size + blur.along;
        let square_error = U * (14.0 * self.miss * size + 4.0 * self.half * self.half)
            + slid * slid
            + blur.miss * (2.0 * self.miss + blur.miss);
        let half_error = if square_error < self.half * self.half {
            square_error / self.half
        } else {
            square_error.sqrt()
        };
        let far_error = half_error + slid + 8.0 * U * self.half;

        let (far, near) =
            if self.along > 0.0 { (-self.enter, -self.leave) } else { (self.leave, self.enter) };
        let near_error = if far > far_error + far_error {
            let power_error = U * (self.squares + 9.0 * self.power.abs()) + blur.power;
            (power_error + near.abs() * far_error) / (far - far_error) + 2.0 * U * near.abs()
        } else {
            far_error + (near - (self.along.abs() - self.half)).abs()
        };

        let (enter_error, leave_error) =
            if self.along > 0.0 { (far_error, near_error) } else { (near_error, far_error) };
        let crossing = |t: f64, error: f64| Crossing {
            t: t * self.unit,
            error: (error + t.abs() * blur.scale) * self.unit,
        };
        Chord { enter: crossing(self.enter, enter_error), leave: crossing(self.leave, leave_error) }
    }
}
