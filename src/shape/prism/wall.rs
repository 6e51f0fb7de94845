//! Lines that lie in a wall that two prisms share: exactly one of the prisms contains the line, as if it were
//! displaced to its side.

use crate::math::Vector;
use crate::shape::U;
use crate::shape::local::LocalRay;
use crate::shape::slab::nudge;

/// Distance from the tip below which a line cannot be separated from one through it.
pub(super) fn tip(ray: &LocalRay) -> f64 {
    16.0 * (ray.blur_at(2.0) + 32.0 * U)
}

/// Returns the direction in which all lines are displaced: unit length, perpendicular to this line.
#[cold]
pub(super) fn aside(ray: &LocalRay) -> Vector {
    let way = nudge(ray);
    (way - ray.direction * way.dot(ray.direction)).normalize_or(Vector::ZERO)
}

/// Returns the line, displaced far enough to be separable from the wall and from the tip; by `least` or more.
#[cold]
pub(super) fn beside<'a>(ray: &LocalRay<'a>, conic: bool, least: f64) -> LocalRay<'a> {
    let LocalRay { nearest, direction, blur, turn, .. } = *ray;
    let aside = aside(ray);
    // The nearer to straight up it goes, the less a turn leaves of where it goes.
    let across = direction.x * direction.x + direction.y * direction.y;
    let sine = if conic { 1.0 } else { across.max(turn).sqrt() };
    let mut far = least.max(64.0 * (blur + turn / sine + 4.0 * U * (1.0 + nearest.length())));
    if conic && (nearest + aside * far).length() <= 2.0 * tip(ray) {
        far += 4.0 * tip(ray);
    }
    LocalRay { nearest: nearest + aside * far, in_world: None, ..*ray }
}
