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
mod piece;

use super::local::{Crossings, Height, Local, LocalRay, Met};
use super::tree::Tree;
use super::{Bounds, U};
use crate::math::Vector;
use crate::math::wide::*;
use net::{Net, bounds};
use piece::{Piece, Root, Seen};
use smallvec::SmallVec;

/// Maximum number of pieces. A line that is not tangent to the patch, within rounding, never needs as many.
const MOST_PIECES: usize = 1 << 14;

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

impl BicubicPatch {
    /// Builds a patch from finite control points.
    pub fn new(points: [Vector; 16]) -> Self {
        let net = Net::new(&points);
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

fn part_at([u, v]: [f64; 2]) -> u32 {
    let number = |t: f64| (t.clamp(0.0, 1.0) * STEPS).round() as u32;
    (number(u) << 15) | number(v)
}

/// What is asked of a line.
#[derive(Clone, Copy)]
struct Asked {
    /// From where to where crossings may lie.
    between: (f64, f64),
    /// Crossings are wanted up to the first that is certainly ahead of this.
    ahead: f64,
}

impl BicubicPatch {
    /// Adds the crossings that may lie in a range, in order; none are missing before the first that is enough.
    fn meet(&self, ray: &LocalRay, asked: Asked, found: &mut Crossings) {
        // What the view rounds points by, what halving does and what a value does, generously.
        let size = self.reach + ray.nearest.length();
        let off = ray.blur_at(size) + 128.0 * U * size;
        let mut near: SmallVec<[usize; 16]> = SmallVec::new();
        self.tree.along(ray, off, |run| near.extend(run));
        if near.is_empty() {
            return;
        }
        dispatch!(Instructions::best().level(), simd => self.meet_near(simd, ray, asked, off, &near, found));
        found.sort_unstable_by(|a, b| a.t.total_cmp(&b.t).then(a.part.cmp(&b.part)));
    }

    /// [`Self::meet`] for some pieces, in no order.
    #[inline(always)]
    fn meet_near<S: Simd>(
        &self,
        simd: S,
        ray: &LocalRay,
        Asked { between: (from, mut to), ahead }: Asked,
        off: f64,
        near: &[usize],
        found: &mut Crossings,
    ) {
        let LocalRay { nearest, direction, .. } = *ray;
        let (aside, across) = direction.any_orthonormal_pair();
        let axes = [aside, across, direction];
        let mut whole = None;
        let mut roots: SmallVec<[Root; 4]> = SmallVec::new();
        let mut tips = [false; 4];
        let mut pieces: SmallVec<[Piece; 16]> = SmallVec::new();
        let mut near = near.iter().rev();
        let mut count = 0;
        loop {
            if pieces.is_empty() {
                let Some(number) = near.next() else { break };
                let piece = &self.pieces[*number];
                pieces.push(Piece { net: piece.net.seen(simd, nearest, &axes), ..*piece });
            }
            let Some(piece) = pieces.last_mut() else { break };
            count += 1;
            if count > MOST_PIECES {
                break;
            }
            match piece.look(simd, (from, to), off) {
                Seen::Beside => {}
                Seen::Linear(inverse, bend) => {
                    if whole.is_none() {
                        whole = Some(self.net.seen(simd, nearest, &axes));
                    }
                    let root = whole
                        .as_ref()
                        .and_then(|whole| piece.root(simd, whole, (inverse, bend), off));
                    if let Some(root) = root
                        && !roots.iter().any(|other| other.is(&root))
                    {
                        let Met { t, error, .. } = root.met;
                        if t - error > ahead {
                            to = to.min(t + error);
                        }
                        roots.push(root);
                    }
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
    }
}

impl Local for BicubicPatch {
    fn crossings(&self, ray: &LocalRay, found: &mut Crossings) {
        let between = (f64::NEG_INFINITY, f64::INFINITY);
        self.meet(ray, Asked { between, ahead: f64::INFINITY }, found);
    }

    fn first_crossings(&self, ray: &LocalRay, between: (f64, f64), found: &mut Crossings) {
        self.meet(ray, Asked { between, ahead: ray.ahead_of(between.0) }, found);
    }

    fn part_at(&self, ray: &LocalRay, s: f64, _: bool) -> Option<u32> {
        // As far as a place may be from itself when it is told along the ray and back.
        let size = self.reach + ray.nearest.length();
        let near = 8.0 * ray.blur_at(size) + 64.0 * U * size;
        let mut found = Crossings::new();
        let between = (s - near, s + near);
        self.meet(ray, Asked { between, ahead: f64::INFINITY }, &mut found);
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
    pub(super) fn points(&self) -> [Vector; 16] {
        self.net.points()
    }

    /// Returns a point of the surface and its normal.
    pub(super) fn at(&self, u: f64, v: f64) -> (Vector, Vector) {
        let place = dispatch!(Instructions::best().level(), simd => self.net.place(simd, [u, v]));
        (place.point, self.normal(u, v).normalize_or(Vector::Z))
    }
}
