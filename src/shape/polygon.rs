//! Polygon: that part of z = 0 in its own space around which its closed lines go an odd number of times.
//! It is a sheet, and faces along z.
//!
//! **Invariant:** its edges belong to it: a line that rounding cannot tell from one through an edge meets
//! it, so that nothing shows between two that share one.
//!
//! **Source:** M. Shimrat, "Algorithm 112: position of point relative to polygon", Communications of the ACM 5
//! (1962), p. 434.

use super::U;
use super::body::{Crossings, Height, Local, LocalRay, Met};
use crate::math::Vector;

#[derive(Debug, Clone, PartialEq)]
pub struct Polygon {
    /// Where each edge begins and ends; z is 0.
    pub(super) edges: Vec<[Vector; 2]>,
    reach: f64,
}

/// How a polygon lies about a point of its plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Around {
    Inside,
    Outside,
    Edge,
}

impl Polygon {
    /// Of lines that close: each goes on from its last corner to its first. `None` where not one is longer
    /// than a point.
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

    /// Whether a point of the plane lies inside, where `off` is how far from it the point that was meant
    /// may be.
    ///
    /// The line from the point along x crosses an edge that begins and ends on different sides of it
    /// where the point is on the left of the upward edge. That sign is sure where the point is farther
    /// from the edge than `off` and the rounding of a cross product, 8u of the lengths.
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

/// Where a line crosses z = 0, and how far that may be off in the plane; `None` where it goes so nearly along
/// the plane that this is more than `reach`.
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
    /// The crossing with the plane z = 0, where the polygon is there. **Error:** as of a disc.
    fn crossings(&self, ray: &LocalRay, found: &mut Crossings) {
        let Some((met, drift)) = on_the_plane(ray, self.reach) else { return };
        if self.around(ray.at(met.t).with_z(0.0), drift) != Around::Outside {
            found.push(met);
        }
    }

    fn height(&self, _: u32, point: Vector) -> Height {
        Height { value: point.z, gradient: Vector::Z, error: 0.0 }
    }

    /// With room for the rounding of a point on it.
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

    /// Not measured: as of shapes like it.
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
