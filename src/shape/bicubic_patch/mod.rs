//! BicubicPatch: a Bézier surface of degree 3 both ways, in a space of its own. It is a sheet.
//!
//! A line meets it where two polynomials in u and v are zero at once: the distances of the point of the
//! surface from the line, along two ways across it. A tree finds the pieces that are near the line. Those
//! whose net is beside it are dropped; one on which the map is so nearly linear that it is one to one is left
//! to Newton's steps; others are halved.
//!
//! **Invariant:** its edges belong to it, as those of a polygon: nothing shows between two patches that
//! share one.
//!
//! **Source:** R. Moore, R. Kearfott, M. Cloud, *Introduction to Interval Analysis* (2009), § 8.2 (Krawczyk's
//! test); T. Nishita, T. Sederberg, M. Kakimoto, "Ray tracing trimmed rational surface patches", SIGGRAPH
//! 1990.

mod foot;
mod net;

use super::body::{Crossings, Height, Local, LocalRay, Met};
use super::tree::Tree;
use super::{Bounds, U};
use crate::math::Vector;
use net::{Across, Net, Place, bounds};
use smallvec::SmallVec;

/// No line that crosses a patch as far from grazing it as rounding tells needs so many pieces.
const MOST_PIECES: usize = 1 << 14;

/// How far the map of a piece may be from a linear one for Newton's steps: less than 1/3 is certain to end
/// at the one root.
const NEARLY_LINEAR: f64 = 0.3;

/// How much of u and v a piece has that is not halved beforehand, however bent it is.
const SMALLEST: f64 = 1.0 / 64.0;

/// Places along u and along v that a part tells apart: [`Local::height`] starts from there.
const STEPS: f64 = (1 << 15) as f64 - 1.0;

/// A part is where on the surface it is: u in the upper half, v in the lower, in `STEPS`.
#[derive(Debug, Clone, PartialEq)]
pub struct BicubicPatch {
    net: Net,
    /// All of it, as it is, in the order of the tree.
    pieces: Vec<Piece>,
    tree: Tree,
    /// Which edges are points: u = 0, u = 1, v = 0, v = 1.
    tips: [bool; 4],
    reach: f64,
}

/// A part of the surface; as seen along a line, x and y go across that, and z along it.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Piece {
    net: Net,
    /// Where it begins in u and v.
    start: [f64; 2],
    /// How much of u and v it has.
    size: [f64; 2],
}

/// What a piece turns out to be.
enum Seen {
    /// It is beside the line, or beside that part of it which is asked for.
    Beside,
    /// The map from u and v to the distances from the line is nearly linear: times this, nearly the
    /// identity, within the second number.
    Linear([[f64; 2]; 2], f64),
    /// All of it is on the line, as far as rounding tells.
    Point,
    /// None of these.
    Bent,
}

/// Where the line meets the surface.
struct Root {
    met: Met,
    place: [f64; 2],
    /// How far off that may be.
    off: [f64; 2],
}

impl BicubicPatch {
    /// Of finite points.
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

    /// Whether a piece ends in a tip, and in which.
    fn tip_of(&self, piece: &Piece) -> Option<usize> {
        let [u, v] = piece.start;
        let [u_size, v_size] = piece.size;
        let at = [u == 0.0, u + u_size == 1.0, v == 0.0, v + v_size == 1.0];
        (0..4).find(|&edge| self.tips[edge] && at[edge])
    }
}

impl Piece {
    /// Whether lines that meet its box are likely to ask for its halves.
    fn is_bent(&self) -> bool {
        let off = |steps: [Vector; 12]| {
            let mean = steps.iter().copied().sum::<Vector>() / 12.0;
            let farthest = steps.iter().map(|step| (*step - mean).length()).fold(0.0, f64::max);
            farthest > NEARLY_LINEAR * mean.length()
        };
        off(self.net.steps_along_u()) || off(self.net.steps_along_v())
    }

    /// What can be told of it between two places along the line, where what is less than `off` is nothing.
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

    /// Keeps one half, across the way along which it is longer, and gives the other.
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

    /// Where a nearly linear piece is met, if within its bounds as far as rounding tells: Newton's steps,
    /// held near them.
    ///
    /// **Error**: with M the inverse of the derivative and κ how far it is from linear, u and v are off by
    /// no more than |M|·off/(1 − κ), taken twice; the place along the line by that times the greatest derivative.
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
    /// The same one, found in two pieces that touch there.
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

/// The inverse of the derivative that goes so along u and v; across the line alone.
fn inverse(along_u: Vector, along_v: Vector) -> Option<[[f64; 2]; 2]> {
    let determinant = along_u.x * along_v.y - along_v.x * along_u.y;
    let by = 1.0 / determinant;
    let inverse = [[along_v.y * by, -along_v.x * by], [-along_u.y * by, along_u.x * by]];
    inverse.iter().flatten().all(|entry| entry.is_finite()).then_some(inverse)
}

impl BicubicPatch {
    /// The crossings that may lie between two places, in order.
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

    /// Over the tangent plane of the nearest place.
    fn height(&self, part: u32, point: Vector) -> Height {
        let (foot, normal) = self.foot(point, part);
        let normal = normal.normalize_or(Vector::Z);
        let error = 32.0 * U * (self.reach + point.length());
        Height { value: (point - foot).dot(normal), gradient: normal, error }
    }

    /// With room for the rounding of a point on it.
    fn extent(&self, along: Vector) -> (f64, f64) {
        let slack = 64.0 * U * self.reach * along.length();
        let (low, high) = self.nearest_extent(along);
        (low - slack, high + slack)
    }

    fn nearest_extent(&self, along: Vector) -> (f64, f64) {
        (-self.net.greatest(-along), self.net.greatest(along))
    }

    /// Not measured: as of shapes like it.
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

    /// A point of the surface and the normal there.
    pub(super) fn at(&self, u: f64, v: f64) -> (Vector, Vector) {
        (self.net.at(u, v).point, self.normal(u, v).normalize_or(Vector::Z))
    }
}
