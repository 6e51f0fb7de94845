//! Bicubic patch: a Bézier surface of degree 3 in both parameters, in local space. It is a sheet.
//!
//! A line intersects it where two polynomials in u and v vanish together: the distances of the surface point
//! from the line along two directions across it. A tree finds the pieces near the line. Pieces whose net is
//! beside the line are dropped; a piece whose map is so nearly linear that it is injective is solved by
//! Newton's method; others are halved.
//!
//! **Invariant:** its edges belong to it, as with polygons: no gap appears between two patches that share an
//! edge.
//!
//! **Source:** R. Moore, R. Kearfott, M. Cloud, *Introduction to Interval Analysis* (2009), § 8.2 (Krawczyk's
//! test); T. Nishita, T. Sederberg, M. Kakimoto, "Ray tracing trimmed rational surface patches", SIGGRAPH
//! 1990.

mod foot;
mod net;

use super::local::{Crossings, Height, Local, LocalRay, Met};
use super::tree::Tree;
use super::{Bounds, U};
use crate::math::Vector;
use net::{Across, Net, Place, bounds};
use smallvec::SmallVec;

/// Maximum number of pieces. A line that is not tangent to the patch, within rounding, never needs as many.
const MOST_PIECES: usize = 1 << 14;

/// Maximum deviation of a piece's map from a linear one for Newton's method: below 1/3, convergence to the
/// single root is certain.
const NEARLY_LINEAR: f64 = 0.3;

/// Area in u and v up to which a piece is not halved in advance, however bent it is.
const SMALLEST: f64 = 1.0 / 64.0;

/// Number of positions along u and v that a part number distinguishes: [`Local::height`] starts its search
/// from there.
const STEPS: f64 = (1 << 15) as f64 - 1.0;

/// A bicubic patch. A part number encodes a position on the surface: u in the upper half, v in the lower
/// half, in units of `STEPS`.
#[derive(Debug, Clone, PartialEq)]
pub struct BicubicPatch {
    net: Net,
    /// The entire surface in pieces, in the order of the tree.
    pieces: Vec<Piece>,
    tree: Tree,
    /// Which edges degenerate to points: u = 0, u = 1, v = 0, v = 1.
    tips: [bool; 4],
    reach: f64,
}

/// A part of the surface; relative to a line, x and y are across it, and z is along it.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Piece {
    net: Net,
    /// Start in u and v.
    start: [f64; 2],
    /// Extent in u and v.
    size: [f64; 2],
}

/// Classification of a piece.
enum Seen {
    /// Beside the line, or beside the requested range of it.
    Beside,
    /// The map from u and v to the distances from the line is nearly linear: composed with this matrix, it
    /// differs from the identity by at most the second value.
    Linear([[f64; 2]; 2], f64),
    /// Entirely on the line, within rounding.
    Point,
    /// None of these.
    Bent,
}

/// An intersection of the line with the surface.
struct Root {
    met: Met,
    place: [f64; 2],
    /// Error of `place`.
    off: [f64; 2],
}

impl BicubicPatch {
    /// Builds a patch from finite control points.
    pub fn new(points: [Vector; 16]) -> Self {
        let net = Net(points);
        let mut pieces = Vec::new();
        let mut bent = vec![Piece { net, start: [0.0; 2], size: [1.0; 2] }];
        while let Some(mut piece) = bent.pop() {
            match piece.size[0] * piece.size[1] > SMALLEST && piece.is_bent() {
                true => {
                    let second = piece.halve(Vector::length);
                    bent.extend([piece, second]);
                }
                false => pieces.push(piece),
            }
        }
        let boxes = pieces.iter().map(|piece: &Piece| {
            let (low, high) = piece.net.bounds();
            Bounds { low, high }
        });
        let boxes: Vec<Bounds> = boxes.collect();
        let (tree, order) = Tree::of_costly(&boxes);
        let pieces = order.iter().map(|&piece| pieces[piece as usize]).collect();
        let reach = points.iter().map(|point| point.length()).fold(0.0, f64::max);
        let tips = [0, 1, 2, 3].map(|edge| {
            let (low, high) = bounds(&net.edge(edge));
            low == high
        });
        Self { net, pieces, tree, tips, reach: reach * (1.0 + 4.0 * U) }
    }

    /// Returns the tip at which a piece ends, if any.
    fn tip_of(&self, piece: &Piece) -> Option<usize> {
        let [u, v] = piece.start;
        let [u_size, v_size] = piece.size;
        let at = [u == 0.0, u + u_size == 1.0, v == 0.0, v + v_size == 1.0];
        (0..4).find(|&edge| self.tips[edge] && at[edge])
    }
}

impl Piece {
    /// Returns whether lines that intersect its box are likely to need its halves.
    fn is_bent(&self) -> bool {
        let off = |steps: [Vector; 12]| {
            let mean = steps.iter().copied().sum::<Vector>() / 12.0;
            let farthest = steps.iter().map(|step| (*step - mean).length()).fold(0.0, f64::max);
            farthest > NEARLY_LINEAR * mean.length()
        };
        off(self.net.steps_along_u()) || off(self.net.steps_along_v())
    }

    /// Classifies it for a range along the line, where distances below `off` count as 0.
    fn look(&self, (from, to): (f64, f64), off: f64) -> Seen {
        let (low, high) = self.net.bounds();
        if low.x > off || low.y > off || high.x < -off || high.y < -off {
            return Seen::Beside;
        }
        if low.z > to + off || high.z < from - off {
            return Seen::Beside;
        }
        let greatest = low.abs().max(high.abs());
        if greatest.x <= off && greatest.y <= off {
            return Seen::Point;
        }
        let points = &self.net.0;
        let along_u = points[3] + points[15] - points[0] - points[12];
        let along_v = points[12] + points[15] - points[0] - points[3];
        let Some(inverse) = inverse(along_u * 0.5, along_v * 0.5) else { return Seen::Bent };
        let [[a, b], [c, d]] = inverse;
        let straight = |p: Vector| Vector::new(a * p.x + b * p.y, c * p.x + d * p.y, p.z);
        let net = self.net.map(straight);
        let (low, high) = net.bounds();
        let (off_u, off_v) = (off * (a.abs() + b.abs()), off * (c.abs() + d.abs()));
        if low.x > off_u || high.x < -off_u || low.y > off_v || high.y < -off_v {
            return Seen::Beside;
        }
        // How far the derivative is from the identity.
        let farthest = |steps: [Vector; 12], from: Vector| {
            let (low, high) = bounds(&steps);
            (low - from).abs().max((high - from).abs())
        };
        let by_u = farthest(net.steps_along_u(), Vector::X);
        let by_v = farthest(net.steps_along_v(), Vector::Y);
        let bend = (by_u.x + by_v.x).max(by_u.y + by_v.y);
        if bend <= NEARLY_LINEAR { Seen::Linear(inverse, bend) } else { Seen::Bent }
    }

    /// Keeps one half, split along its longer parameter direction, and returns the other.
    fn halve(&mut self, length: impl Fn(Vector) -> f64) -> Self {
        let length = |steps: [Vector; 12]| steps.into_iter().map(&length).sum::<f64>();
        let is_along_u = length(self.net.steps_along_u()) >= length(self.net.steps_along_v());
        let net = if is_along_u { self.net.halve_along_u() } else { self.net.halve_along_v() };
        let axis = usize::from(!is_along_u);
        self.size[axis] *= 0.5;
        let mut start = self.start;
        start[axis] += self.size[axis];
        Self { net, start, size: self.size }
    }

    /// Returns the intersection with a nearly linear piece, if it is within the piece's bounds, to rounding:
    /// Newton's method, clamped near them.
    ///
    /// **Error**: with M the inverse of the derivative and κ its deviation from linear, u and v are off by at
    /// most |M|·off/(1 − κ), counted twice; the position along the line is off by that times the largest
    /// derivative.
    fn root(
        &self,
        whole: &Net,
        across: &Across,
        inverse: [[f64; 2]; 2],
        bend: f64,
        off: f64,
    ) -> Option<Root> {
        let Self { start, size, .. } = *self;
        let global = |x: [f64; 2]| [start[0] + x[0] * size[0], start[1] + x[1] * size[1]];
        let mut x = [0.5, 0.5];
        for _ in 0..32 {
            let [u, v] = global(x);
            let [point, along_u, along_v] = across.at(u, v);
            // Far less than what can be told.
            if point[0].abs().max(point[1].abs()) <= off / 16.0 {
                break;
            }
            let way = |along: [f64; 2], size: f64| Vector::new(along[0], along[1], 0.0) * size;
            let Some([[a, b], [c, d]]) =
                self::inverse(way(along_u, size[0]), way(along_v, size[1]))
            else {
                break;
            };
            let step = [a * point[0] + b * point[1], c * point[0] + d * point[1]];
            let next = [0, 1].map(|i| (x[i] - step[i]).clamp(-0.25, 1.25));
            let moved = (next[0] - x[0]).abs().max((next[1] - x[1]).abs());
            x = next;
            if moved <= 2.0 * U {
                break;
            }
        }
        let [[a, b], [c, d]] = inverse;
        let spread = 2.0 * off / (1.0 - bend);
        let spread = [spread * (a.abs() + b.abs()), spread * (c.abs() + d.abs())];
        let place = global(x);
        let Place { point, along_u, along_v } = whole.at(place[0], place[1]);
        let within = (0..2).all(|i| -spread[i] <= x[i] && x[i] <= 1.0 + spread[i]);
        if !within || point.x.abs().max(point.y.abs()) > off {
            return None;
        }
        let steepest =
            |steps: [Vector; 12]| steps.iter().map(|step| step.z.abs()).fold(0.0, f64::max);
        let error = spread[0] * steepest(self.net.steps_along_u())
            + spread[1] * steepest(self.net.steps_along_v())
            + off;
        // The normal is v × u.
        let leaving = along_u.x * along_v.y - along_u.y * along_v.x < 0.0;
        let met = Met { t: point.z, error, leaving, part: part_at(place) };
        Some(Root { met, place, off: [spread[0] * size[0], spread[1] * size[1]] })
    }
}

impl Root {
    /// Returns whether both are the same intersection, found in two adjacent pieces.
    fn is(&self, other: &Self) -> bool {
        let near = |i: usize| {
            let apart = (self.place[i] - other.place[i]).abs();
            apart <= self.off[i] + other.off[i] + 8.0 * U
        };
        self.met.leaving == other.met.leaving && near(0) && near(1)
    }
}

fn part_at([u, v]: [f64; 2]) -> u32 {
    let number = |t: f64| (t.clamp(0.0, 1.0) * STEPS).round() as u32;
    (number(u) << 15) | number(v)
}

/// Returns the inverse of the matrix with these derivatives along u and v, restricted to the directions
/// across the line.
fn inverse(along_u: Vector, along_v: Vector) -> Option<[[f64; 2]; 2]> {
    let determinant = along_u.x * along_v.y - along_v.x * along_u.y;
    let by = 1.0 / determinant;
    let inverse = [[along_v.y * by, -along_v.x * by], [-along_u.y * by, along_u.x * by]];
    inverse.iter().flatten().all(|entry| entry.is_finite()).then_some(inverse)
}

impl BicubicPatch {
    /// Adds the crossings that may lie in a range, in order.
    fn meet(&self, ray: &LocalRay, between: (f64, f64), found: &mut Crossings) {
        // What the view rounds points by, what halving does and what a value does, generously.
        let size = self.reach + ray.nearest.length();
        let off = ray.blur_at(size) + 128.0 * U * size;
        let mut roots: SmallVec<[Root; 4]> = SmallVec::new();
        let mut tips = [false; 4];
        let mut near: SmallVec<[usize; 16]> = SmallVec::new();
        self.tree.along(ray, off, |run| near.extend(run));
        if near.is_empty() {
            return;
        }
        let LocalRay { nearest, direction, .. } = *ray;
        let (aside, across) = direction.any_orthonormal_pair();
        let seen = |point: Vector| {
            let from = point - nearest;
            Vector::new(from.dot(aside), from.dot(across), from.dot(direction))
        };
        let whole = self.net.map(seen);
        let across = whole.across();
        let mut pieces: SmallVec<[Piece; 16]> = SmallVec::new();
        let mut count = 0;
        let placed = |number: usize| {
            let piece = &self.pieces[number];
            Piece { net: piece.net.map(seen), ..*piece }
        };
        loop {
            if pieces.is_empty() {
                pieces.extend(near.pop().map(&placed));
            }
            let Some(piece) = pieces.last_mut() else { break };
            count += 1;
            if count > MOST_PIECES {
                break;
            }
            match piece.look(between, off) {
                Seen::Beside => {}
                Seen::Linear(inverse, bend) => {
                    let root = piece.root(&whole, &across, inverse, bend, off);
                    let new = root.filter(|root| !roots.iter().any(|other| other.is(root)));
                    roots.extend(new);
                }
                // The halves are looked at where they lie: they are large.
                Seen::Bent => {
                    let second = piece.halve(|step| step.x.abs().max(step.y.abs()));
                    pieces.push(second);
                    continue;
                }
                // It is grazed, or met at a tip.
                Seen::Point => {
                    if let Some(edge) = self.tip_of(piece)
                        && !std::mem::replace(&mut tips[edge], true)
                    {
                        roots.push(self.at_tip(ray, piece, off));
                    }
                }
            }
            pieces.pop();
        }
        found.extend(roots.into_iter().map(|root| root.met));
        found.sort_unstable_by(|a, b| a.t.total_cmp(&b.t).then(a.part.cmp(&b.part)));
    }
}

impl Local for BicubicPatch {
    fn crossings(&self, ray: &LocalRay, found: &mut Crossings) {
        self.meet(ray, (f64::NEG_INFINITY, f64::INFINITY), found);
    }

    fn first_crossings(&self, ray: &LocalRay, between: (f64, f64), found: &mut Crossings) {
        self.meet(ray, between, found);
    }

    fn part_at(&self, ray: &LocalRay, s: f64, _: bool) -> Option<u32> {
        // As far as a place may be from itself when it is told along the ray and back.
        let size = self.reach + ray.nearest.length();
        let near = 8.0 * ray.blur_at(size) + 64.0 * U * size;
        let mut found = Crossings::new();
        self.meet(ray, (s - near, s + near), &mut found);
        found.retain(|met| (met.t - s).abs() <= near);
        let [met] = found[..] else { return None };
        Some(met.part)
    }

    /// Measured from the tangent plane at the nearest point.
    fn height(&self, part: u32, point: Vector) -> Height {
        let (foot, normal) = self.foot(point, part);
        let normal = normal.normalize_or(Vector::Z);
        let error = 32.0 * U * (self.reach + point.length());
        Height { value: (point - foot).dot(normal), gradient: normal, error }
    }

    /// Includes a margin for the rounding of a point on it.
    fn extent(&self, along: Vector) -> (f64, f64) {
        let slack = 64.0 * U * self.reach * along.length();
        let (low, high) = self.nearest_extent(along);
        (low - slack, high + slack)
    }

    fn nearest_extent(&self, along: Vector) -> (f64, f64) {
        (-self.net.greatest(-along), self.net.greatest(along))
    }

    /// Not measured: assumed from similar shapes.
    fn price(&self) -> u64 {
        150 + 7 * u64::from(self.pieces.len().max(1).ilog2())
    }

    fn reach(&self) -> f64 {
        self.reach
    }

    fn numbers(&self) -> String {
        String::new()
    }

    fn contains(&self, _: Vector) -> bool {
        false
    }

    fn is_sheet(&self) -> bool {
        true
    }
}

impl BicubicPatch {
    fn at_tip(&self, ray: &LocalRay, piece: &Piece, off: f64) -> Root {
        let place = [0, 1].map(|i| piece.start[i] + 0.5 * piece.size[i]);
        let (low, high) = piece.net.bounds();
        let t = 0.5 * (low.z + high.z);
        let leaving = self.normal(place[0], place[1]).dot(ray.direction) > 0.0;
        let met = Met { t, error: 0.5 * (high.z - low.z) + off, leaving, part: part_at(place) };
        Root { met, place, off: piece.size }
    }
}

#[cfg(test)]
impl BicubicPatch {
    pub(super) fn points(&self) -> &[Vector; 16] {
        &self.net.0
    }

    /// Returns a point of the surface and its normal.
    pub(super) fn at(&self, u: f64, v: f64) -> (Vector, Vector) {
        (self.net.at(u, v).point, self.normal(u, v).normalize_or(Vector::Z))
    }
}
