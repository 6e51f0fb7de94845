//! Where four rays first meet a sphere or a plane, and what these are like there.
//!
//! **Out:** of each ray what the shape says of it alone, to the bit; where that takes the tight error bound or a rare
//! case, it says so.

pub(crate) mod chords;
pub(crate) mod points;

use super::{Plane, Sphere, U};
use crate::math::wide::*;

/// Where rays first meet a surface.
pub(crate) struct First<S: Simd> {
    /// ∞ where nothing is met, or that is not known.
    pub t: Wide<S>,
    pub error: Wide<S>,
    pub leaving: Mask<S>,
    /// It takes more to tell.
    pub unsure: Mask<S>,
}

/// A solid that is solved for four rays at once.
pub(crate) trait FirstOfFour {
    /// Returns the first crossing of each ray that is seen, at its limit or before, with the error that it has for one
    /// ray; `shows` tells whether the solid is seen where rays enter it, and where they leave it.
    fn first_of_four<S: Simd>(
        &self,
        simd: S,
        ray: &WideRay<S>,
        shows: [bool; 2],
        limit: Wide<S>,
    ) -> First<S>;
}

impl<S: Simd> First<S> {
    #[inline(always)]
    fn none(simd: S) -> Self {
        let (t, none) = (all(simd, f64::INFINITY), Mask::splat(simd, false));
        Self { t, error: all(simd, 0.0), leaving: none, unsure: none }
    }

    #[inline(always)]
    fn new(
        simd: S,
        met: Mask<S>,
        certain: Mask<S>,
        (t, error): (Wide<S>, Wide<S>),
        leaving: Mask<S>,
    ) -> Self {
        let t = (met & certain).select(t, all(simd, f64::INFINITY));
        Self { t, error, leaving, unsure: met & !certain }
    }
}

/// Points of surfaces; see [`super::SurfacePoint`].
pub(crate) struct WidePoints<S: Simd> {
    pub point: WideVector<S>,
    pub normal: WideVector<S>,
    pub error: Wide<S>,
    /// It takes more to tell.
    pub unsure: Mask<S>,
}

/// Four spheres.
pub(crate) struct WideSpheres<S: Simd> {
    pub centre: WideVector<S>,
    pub radius: Wide<S>,
    /// See [`Sphere::scale`].
    pub scale: Wide<S>,
}

impl<S: Simd> WideSpheres<S> {
    /// Returns the points where each of four rays crosses its sphere: [`Sphere::surface`].
    #[inline(always)]
    pub fn surface(&self, simd: S, ray: &WideRay<S>, t: Wide<S>) -> WidePoints<S> {
        let Self { centre, radius, scale } = *self;
        let rough = ray.origin + ray.direction * t;
        let start = ray.origin - centre;
        let along = start.dot(ray.direction);
        let offset = start - ray.direction * along;
        let from_centre = (offset + ray.direction * (t + along)) * scale;
        let reciprocal = all(simd, 1.0) / from_centre.length_squared().sqrt();
        let has_direction = reciprocal.is_finite() & reciprocal.simd_gt(all(simd, 0.0));
        let normal = from_centre * reciprocal;
        let point = centre + normal * radius;
        let error = all(simd, 12.0) * radius + all(simd, 2.0) * normal.abs().dot(point.abs());
        let unsure = !has_direction | is_planet(simd, radius, rough);
        WidePoints { point, normal, error: all(simd, U) * error, unsure }
    }
}

/// Four planes.
pub(crate) struct WidePlanes<S: Simd> {
    pub normal: WideVector<S>,
    pub distance: Wide<S>,
}

impl<S: Simd> WidePlanes<S> {
    /// Returns the points where each of four rays crosses its plane: [`Plane::surface`].
    #[inline(always)]
    pub fn surface(&self, simd: S, ray: &WideRay<S>, t: Wide<S>) -> WidePoints<S> {
        let Self { normal, distance } = *self;
        let rough = ray.origin + ray.direction * t;
        let point = rough - normal * (normal.dot(rough) - distance);
        let error =
            all(simd, 12.0) * normal.abs().dot(point.abs()) + all(simd, 4.0) * distance.abs();
        WidePoints { point, normal, error: all(simd, U) * error, unsure: Mask::splat(simd, false) }
    }
}

/// Returns whether spheres may be planets as seen from places.
#[inline(always)]
fn is_planet<S: Simd>(simd: S, radius: Wide<S>, place: WideVector<S>) -> Mask<S> {
    let (factor, WideVector([x, y, z])) = (all(simd, 1024.0), place.abs());
    radius.simd_gt(factor * x) & radius.simd_gt(factor * y) & radius.simd_gt(factor * z)
}

impl FirstOfFour for Sphere {
    /// Returns the crossing that [`Sphere::roots_ahead`] and [`super::sphere::Roots::roughly`] find: where rays leave
    /// if they see it from inside only, and where they enter if not.
    #[inline(always)]
    fn first_of_four<S: Simd>(
        &self,
        simd: S,
        ray: &WideRay<S>,
        shows: [bool; 2],
        limit: Wide<S>,
    ) -> First<S> {
        let inside = !shows[0];
        let (radius, zero) = (all(simd, self.radius), all(simd, 0.0));
        let radius_squared = all(simd, self.radius * self.radius);
        let start = ray.origin - WideVector::splat(simd, self.centre);
        let along = start.dot(ray.direction);
        let offset = start - ray.direction * along;
        let (start_squared, miss_squared) = (start.length_squared(), offset.length_squared());
        let is_ahead = !(along.simd_gt(zero) & start_squared.simd_gt(radius_squared));
        let is_near = is_ahead & !miss_squared.simd_gt(radius_squared);

        if !is_near.any_true() {
            return First::none(simd);
        }

        let size = start_squared + radius_squared;
        let [least, most] = Self::SAFE_SQUARES;
        let is_safe = size.simd_gt(all(simd, least)) & size.simd_lt(all(simd, most));
        let miss = miss_squared.sqrt();
        let half = ((radius - miss) * (radius + miss)).sqrt();
        let power = start_squared - radius_squared;
        let far = along.abs() + half;
        let near = power / far;
        let near = near.simd_lt(far).select(near, far);
        let away = along.simd_gt(zero);
        let (enter, leave) = (away.select(-far, near), away.select(-near, far));
        // The ground of a planet is found otherwise.
        let is_close = (all(simd, 1024.0) * power.abs()).simd_lt(radius_squared);
        let is_close = is_close & is_planet(simd, radius, ray.origin);
        let is_plain = is_safe & !is_close;

        let t = if inside { leave } else { enter };
        let size = along.abs() + miss + half;
        let is_clear = t.simd_gt(size * all(simd, 1.0 / 1024.0));
        let met = half.simd_gt(zero)
            & leave.simd_gt(zero)
            & enter.simd_le(limit)
            & (!is_clear | t.simd_le(limit));
        let error = size * all(simd, 1.0 / 1_048_576.0);
        let leaving = Mask::splat(simd, inside);
        First::new(simd, is_near & (met | !is_plain), is_plain & is_clear, (t, error), leaving)
    }
}

impl Plane {
    /// Returns which rays move toward the plane.
    #[inline(always)]
    pub(crate) fn is_ahead_of_four<S: Simd>(&self, simd: S, ray: &WideRay<S>) -> Mask<S> {
        let normal = WideVector::splat(simd, self.normal.get());
        let inside = all(simd, self.distance) - normal.dot(ray.origin);
        (inside * normal.dot(ray.direction)).simd_gt(all(simd, 0.0))
    }
}

impl FirstOfFour for Plane {
    /// Returns the crossing that [`Plane::pass`] and [`Plane::roughly`] find.
    #[inline(always)]
    fn first_of_four<S: Simd>(
        &self,
        simd: S,
        ray: &WideRay<S>,
        shows: [bool; 2],
        limit: Wide<S>,
    ) -> First<S> {
        let normal = WideVector::splat(simd, self.normal.get());
        let distance = all(simd, self.distance);
        let speed = normal.dot(ray.direction);
        let inside = distance - normal.dot(ray.origin);
        let t = inside / speed;
        let leaving = speed.simd_gt(all(simd, 0.0));
        let [enter, leave] = shows;
        let is_seen = leaving & Mask::splat(simd, leave) | !leaving & Mask::splat(simd, enter);
        let met = (inside * speed).simd_gt(all(simd, 0.0)) & !t.simd_gt(limit) & is_seen;
        let size = ray.origin.abs().element_sum() + all(simd, self.distance.abs());
        let steep = speed.abs().simd_gt(all(simd, 1.0 / 1024.0));
        let near = size.simd_lt(t * all(simd, 16_384.0));
        First::new(simd, met, steep & near, (t, t * all(simd, 1.0 / 67_108_864.0)), leaving)
    }
}

/// Returns the larger of numbers.
#[inline(always)]
fn larger<S: Simd>(a: Wide<S>, b: Wide<S>) -> Wide<S> {
    b.simd_gt(a).select(b, a)
}
