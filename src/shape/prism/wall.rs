//! A line that lies in a wall, of two prisms that share it: one of them has it, as if it were moved to its side.

use crate::math::Vector;
use crate::shape::U;
use crate::shape::body::LocalRay;
use crate::shape::slab::nudge;

/// The line, moved so far that rounding tells it from the wall: the way that all lines are, whatever they lie in.
#[cold]
pub(super) fn beside<'a>(ray: &LocalRay<'a>, conic: bool) -> LocalRay<'a> {
    let LocalRay { nearest, direction, blur, turn, .. } = *ray;
    let way = nudge(ray);
    let aside = (way - direction * way.dot(direction)).normalize_or(Vector::ZERO);
    // The nearer to straight up it goes, the less a turn leaves of where it goes.
    let across = direction.x * direction.x + direction.y * direction.y;
    let sine = if conic { 1.0 } else { across.max(turn).sqrt() };
    let far = 64.0 * (blur + turn / sine + 4.0 * U * (1.0 + nearest.length()));
    LocalRay { nearest: nearest + aside * far, in_world: None, ..*ray }
}
