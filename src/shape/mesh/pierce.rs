//! Watertight intersection of a line with a triangle.
//!
//! **Invariant:** the projection of a corner does not depend on the triangle or mesh that requests it, and
//! the test is exact for the projections. Where the line passes through an edge, it is displaced by (ε, ε²),
//! ε a positive infinitesimal: so no line passes through an edge, and adjacent triangles never both contain
//! the line or both miss it.
//!
//! **Source:** S. Woop, C. Benthin, I. Wald, "Watertight ray/triangle intersection", JCGT 2 (1), 2013; H.
//! Edelsbrunner, E. Mücke, "Simulation of simplicity", ACM Transactions on Graphics 9 (1), 1990.

use std::cell::Cell;

use super::super::local::{InWorld, LocalRay, Met};
use super::super::slab::{NEARLY_ALONG, lies_in, meant, nudge};
use super::super::{Ray, U};
use super::Flat;
use crate::math::Vector;
use crate::math::double::Double;
use crate::math::placement::ExactPlacement;

/// Projects corners along a line.
pub(in super::super) struct View<'a> {
    across: Across,
    /// Maximum deviation of a corner from its position in world space.
    pub doubt: f64,
    in_world: Option<(&'a Ray, &'a ExactPlacement)>,
    /// Whether the line cannot be separated from the plane of some triangle that was tested.
    pub is_in_a_plane: Cell<bool>,
}

/// A projection along a line.
struct Across {
    start: Vector,
    /// The line's dominant axis, followed by the other two in cyclic order.
    axes: [usize; 3],
    shear: [f64; 2],
    /// Whether the line goes against its dominant axis.
    is_against: bool,
}

impl Across {
    fn new(start: Vector, direction: Vector) -> Self {
        let main = direction.abs().max_position();
        let axes = [main, (main + 1) % 3, (main + 2) % 3];
        let shear = [1, 2].map(|i| direction[axes[i]] / direction[main]);
        Self { start, axes, shear, is_against: direction[main] < 0.0 }
    }

    /// Returns the projection of a point.
    #[inline]
    fn seen(&self, point: Vector) -> [f64; 2] {
        let from_start = point - self.start;
        let [main, a, b] = self.axes.map(|axis| from_start[axis]);
        [a - self.shear[0] * main, b - self.shear[1] * main]
    }

    /// Like [`View::pierces`], always exact.
    fn pierces_exactly(&self, corners: [Vector; 3]) -> Option<bool> {
        let [a, b, c] = corners.map(|corner| self.seen(corner));
        let turn = turns_left(a, b)?;
        let all = turns_left(b, c)? == turn && turns_left(c, a)? == turn;
        all.then_some(turn == self.is_against)
    }
}

impl<'a> View<'a> {
    /// Builds the view of a line, for corners within `size` of the local origin.
    pub fn along(ray: &LocalRay<'a>, size: f64) -> Self {
        let LocalRay { nearest, direction, blur, turn, in_world, .. } = *ray;
        let in_world = in_world.and_then(|InWorld { ray, placed }| {
            placed.exact.as_deref().map(|placement| (ray, placement))
        });
        let across = Across::new(nearest, direction);
        let meant_off = meant(ray);
        // The line's own error, what the local view rounds by, what the world's does, and what the world may have meant
        // to lie in a plane; as seen aslant, twice.
        let doubt = in_world.map_or(0.0, |(ray, placement)| {
            let reach = size + nearest.length();
            let far = (ray.origin - placement.centre.round()).length();
            let rounded = reach + placement.condition * size + placement.norm * far;
            2.0 * (blur + turn * reach + 16.0 * U * rounded + meant_off)
        });
        Self { across, doubt, in_world, is_in_a_plane: Cell::new(false) }
    }

    /// Returns the line's dominant axis, followed by the other two in cyclic order.
    pub fn axes(&self) -> [usize; 3] {
        self.across.axes
    }

    /// Returns whether the line goes against its dominant axis.
    pub fn is_against(&self) -> bool {
        self.across.is_against
    }

    /// Returns a point of the line, and its slope across the dominant axis.
    pub fn line(&self) -> (Vector, [f64; 2]) {
        (self.across.start, self.across.shear)
    }

    /// Returns whether the line pierces the triangle: `Some(true)` if it goes in the direction that the
    /// surface faces.
    #[inline]
    pub fn pierces(&self, corners: [Vector; 3]) -> Option<bool> {
        let [a, b, c] = corners.map(|corner| self.across.seen(corner));
        let (ab, bc) = (self.turns_surely(a, b), self.turns_surely(b, c));
        if ab * bc < 0 {
            return None;
        }
        let ca = self.turns_surely(c, a);
        match ab + bc + ca {
            3 => Some(self.across.is_against),
            -3 => Some(!self.across.is_against),
            _ if ca * ab < 0 || ca * bc < 0 => None,
            _ => {
                if ab == 0 && bc == 0 && ca == 0 && !self.is_in_a_plane.get() {
                    self.is_in_a_plane.set(self.lies_in_plane(corners));
                }
                self.pierces_exactly(corners)
            }
        }
    }

    /// Returns whether the line lies in the plane of a triangle, none of whose edges it certainly passes on
    /// one side. Determined in world space, if the body is placed there.
    #[cold]
    fn lies_in_plane(&self, corners: [Vector; 3]) -> bool {
        let rise = |(ray, placement): (&Ray, &ExactPlacement)| {
            placement.rise_from(corners, ray.origin, ray.direction)
        };
        self.in_world.and_then(rise).is_none_or(|rise| lies_in(&rise, 0.0))
    }

    /// Determined in world space, in which other bodies see the same corners; in local space if the body is
    /// not placed.
    #[cold]
    fn pierces_exactly(&self, corners: [Vector; 3]) -> Option<bool> {
        let Some((ray, placement)) = self.in_world else {
            return self.across.pierces_exactly(corners);
        };
        let ways = corners.map(|corner| placement.way(ray.origin, corner));
        let pierced = Across::new(Vector::ZERO, ray.direction).pierces_exactly(ways)?;
        Some(pierced != placement.is_mirrored)
    }

    /// Returns the direction of the turn from `p` to `q` around the line: 1 to the left, −1 to the right, 0
    /// if that is uncertain.
    ///
    /// It is the sign of p.x·q.y − p.y·q.x, which is certain if the value exceeds 2u of both products, so
    /// that neither their roundings nor its own explain it, plus the effect of the corners' doubt.
    #[inline]
    fn turns_surely(&self, p: [f64; 2], q: [f64; 2]) -> i32 {
        let (left, right) = (p[0] * q[1], p[1] * q[0]);
        let turn = left - right;
        let sizes = p[0].abs() + p[1].abs() + q[0].abs() + q[1].abs();
        let off = 3.0 * U * (left.abs() + right.abs()) + self.doubt * (sizes + 2.0 * self.doubt);
        // And room for products that underflow.
        i32::from(turn > off + f64::MIN_POSITIVE) - i32::from(turn < -off - f64::MIN_POSITIVE)
    }
}

/// Returns a line beside one that lies in the plane of a face, whose crossing might be anywhere along the
/// face. The displacement exceeds the rounding, both here and of a ray meant to lie in the plane, and is on
/// the side of [`nudge`], which is common to all bodies that touch there. The body is at most of size `size`.
#[cold]
pub(in super::super) fn beside<'a>(ray: &LocalRay<'a>, size: f64) -> LocalRay<'a> {
    let LocalRay { nearest, direction, blur, .. } = *ray;
    let doubt = View::along(ray, size).doubt.max(16.0 * U * (size + nearest.length()));
    let way = nudge(ray);
    let aside = (way - direction * way.dot(direction)).normalize_or(Vector::ZERO);
    let far = 16.0 * doubt;
    LocalRay { nearest: nearest + aside * far, blur: blur + far, in_world: None, ..*ray }
}

/// Returns whether `q` is to the left of `p` as seen from the line, exactly; `None` if they coincide.
fn turns_left(p: [f64; 2], q: [f64; 2]) -> Option<bool> {
    // Multiplied by powers of two, so that the products have all their digits.
    let [p_near_1, q_near_1] = [p, q].map(|[x, y]| {
        let by = crate::math::reciprocal_power_of_two(x.abs().max(y.abs()));
        [Double::from(x * by), Double::from(y * by)]
    });
    // Two products are each exact in a double-double, so their comparison is.
    let (left, right) = (p_near_1[0] * q_near_1[1], p_near_1[1] * q_near_1[0]);
    let by_edge = || (p[1] != q[1]).then(|| p[1] > q[1]);
    let by_second = || (p[0] != q[0]).then(|| p[0] < q[0]);
    match left.partial_cmp(&right) {
        Some(std::cmp::Ordering::Equal) | None => by_edge().or_else(by_second),
        Some(order) => Some(order.is_gt()),
    }
}

/// Returns the crossing of a line with a triangle that it pierces, and whose plane is `flat`, if it has one.
///
/// With n the normal and P the crossing, s = n·(A − start)/n·d. **Error:** B, the error of the line there,
/// plus the rounding of A − start and s·d, plus the displacement at P when the normal's error turns the plane
/// about A, all over |n·d|. The crossing lies between the triangle's ends along the line.
pub(in super::super) fn met(
    ray: &LocalRay,
    corners: [Vector; 3],
    flat: Option<Flat>,
    leaving: bool,
    part: u32,
) -> Met {
    let LocalRay { nearest, direction, .. } = *ray;
    let depths = corners.map(|corner| (corner - nearest).dot(direction));
    let low = depths.into_iter().fold(f64::INFINITY, f64::min);
    let high = depths.into_iter().fold(f64::NEG_INFINITY, f64::max);
    let off =
        |t: f64| ray.blur_at(t) + 8.0 * U * (nearest.length() + corners[0].length() + t.abs());
    let middle = 0.5 * (low + high);
    let anywhere = Met { t: middle, error: 0.5 * (high - low) + off(middle), leaving, part };
    let Some(Flat { normal, turn }) = flat else { return anywhere };
    let slope = normal.dot(direction);
    let t = (normal.dot(corners[0] - nearest) / slope).clamp(low, high);
    if !t.is_finite() {
        return anywhere;
    }
    let size = (ray.at(t) - corners[0]).length();
    let error = (off(t) + turn * size) / slope.abs();
    let is_nearly_along = slope.abs() * NEARLY_ALONG < 1.0 && error * NEARLY_ALONG >= high - low;
    if is_nearly_along && let Some((t, error)) = met_exactly(ray, corners) {
        return Met { t: t.clamp(low, high), error, leaving, part };
    }
    Met { t, error: error.min(high - low + off(t)), leaving, part }
}

/// Returns where a nearly parallel line crosses the plane of a triangle, with its error, as exactly as the
/// ray and the placement allow: solids that touch there get the same crossing.
#[cold]
fn met_exactly(ray: &LocalRay, corners: [Vector; 3]) -> Option<(f64, f64)> {
    let InWorld { ray: line, placed } = ray.in_world?;
    let rise = placed.exact.as_deref()?.rise_from(corners, line.origin, line.direction)?;
    let start = placed.placement.local_point(line.origin).dot(ray.direction);
    let step = placed.placement.local_direction(line.direction).length();
    let s = start - step * (rise.up / rise.speed);
    s.is_finite().then_some((s, 4.0 * U * (start.abs() + s.abs())))
}
