//! Polygon: in local space, the part of z = 0 that its closed lines enclose by the even-odd rule. It is a
//! sheet and faces along z.
//!
//! **Invariant:** its edges belong to it: a line that rounding cannot separate from one through an edge hits
//! the polygon, so no gap appears between polygons that share an edge.
//!
//! **Source:** M. Shimrat, "Algorithm 112: position of point relative to polygon", Communications of the ACM
//! 5 (1962), p. 434.

use super::U;
use super::local::{Crossings, Height, Local, LocalRay, Met};
use crate::math::Vector;

/// The part of z = 0 that closed lines enclose, in local space.
#[derive(Debug, Clone, PartialEq)]
pub struct Polygon {
    /// Start and end of each edge; z is 0.
    pub(super) edges: Vec<[Vector; 2]>,
    reach: f64,
}

/// Where a point of the plane lies relative to a polygon.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Around {
    Inside,
    Outside,
    Edge,
}

impl Polygon {
    /// Builds a polygon from closed lines: each continues from its last corner to its first. `None` if every
    /// line is a single point.
    pub fn new(lines: &[Vec<[f64; 2]>]) -> Option<Self> {
        let corner = |[x, y]: [f64; 2]| Vector::new(x, y, 0.0);
        let closed = |line: &Vec<[f64; 2]>| {
            let next = line.iter().cycle().skip(1);
            let edges = line.iter().zip(next).map(|(from, to)| [corner(*from), corner(*to)]);
            edges.collect::<Vec<_>>()
        };
        let edges: Vec<_> = lines.iter().flat_map(closed).filter(|[from, to]| from != to).collect();
        let reach = edges.iter().map(|[from, _]| from.length()).fold(0.0, f64::max);
        (reach > 0.0).then_some(Self { edges, reach: reach * (1.0 + 4.0 * U) })
    }

    /// Classifies a point of the plane, where `off` is its distance from the intended point.
    ///
    /// The ray from the point along x crosses an edge whose ends are on different sides of the ray if the
    /// point is to the left of the upward edge. That sign is certain if the point is farther from the edge
    /// than `off` plus the rounding of a cross product, 8u of the lengths.
    fn around(&self, point: Vector, off: f64) -> Around {
        if point.length() > self.reach + 2.0 * off {
            return Around::Outside;
        }
        let off = off + 16.0 * U * (self.reach + point.length());
        let mut odd = false;
        for [from, to] in &self.edges {
            let (begin, way) = (*from - point, *to - *from);
            let turn = begin.x * way.y - begin.y * way.x;
            let length2 = way.length_squared();
            let share = (-begin.dot(way) / length2).clamp(0.0, 1.0);
            if (begin + way * share).length() <= off {
                return Around::Edge;
            }
            let (below, above) = (from.y <= point.y, to.y <= point.y);
            odd ^= below != above && (turn > 0.0) == below;
        }
        if odd { Around::Inside } else { Around::Outside }
    }
}

/// Returns the crossing of a line with z = 0, and its error in the plane; `None` if the line is so nearly
/// parallel that the error exceeds `reach`.
pub(super) fn on_the_plane(ray: &LocalRay, reach: f64) -> Option<(Met, f64)> {
    let (place, speed) = (ray.nearest.z, ray.direction.z);
    let t = -place / speed;
    let certain = speed.abs() - ray.turn;
    if !(t.is_finite() && certain > 0.0) {
        return None;
    }
    let off = ray.blur_at(t) + 2.0 * U * place.abs();
    let error = off / certain + 4.0 * U * t.abs();
    // Along the line, and across it.
    let Vector { x, y, .. } = ray.direction;
    let drift = error * (x * x + y * y).sqrt() + off + 2.0 * U * t.abs();
    (drift <= reach).then_some((Met { t, error, leaving: speed > 0.0, part: 0 }, drift))
}

impl Local for Polygon {
    /// Adds the crossing with the plane z = 0 if it lies in the polygon. **Error:** as for a disc.
    fn crossings(&self, ray: &LocalRay, found: &mut Crossings) {
        let Some((met, drift)) = on_the_plane(ray, self.reach) else { return };
        if self.around(ray.at(met.t).with_z(0.0), drift) != Around::Outside {
            found.push(met);
        }
    }

    fn height(&self, _: u32, point: Vector) -> Height {
        Height { value: point.z, gradient: Vector::Z, error: 0.0 }
    }

    /// Includes a margin for the rounding of a point on it.
    fn extent(&self, along: Vector) -> (f64, f64) {
        let slack = 64.0 * U * self.reach * along.length();
        let (low, high) = self.nearest_extent(along);
        (low - slack, high + slack)
    }

    fn nearest_extent(&self, along: Vector) -> (f64, f64) {
        let corners = self.edges.iter().map(|[from, _]| from.dot(along));
        corners.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), height| {
            (low.min(height), high.max(height))
        })
    }

    /// Not measured: assumed from similar shapes.
    fn price(&self) -> u64 {
        8 + self.edges.len() as u64
    }

    fn reach(&self) -> f64 {
        self.reach
    }

    fn numbers(&self) -> String {
        format!(" of {} edges", self.edges.len())
    }

    fn contains(&self, _: Vector) -> bool {
        false
    }

    fn is_sheet(&self) -> bool {
        true
    }
}
