//! Lines through a mesh side by side: of four at once it is known which certainly miss a triangle.
//!
//! **Invariant:** each line finds what it finds alone: where four at once do not tell, a triangle is tested for it
//! alone.

use std::ops::Range;

use super::super::U;
use super::super::local::{LocalRay, Met};
use super::Mesh;
use super::pierce::{self, View};
use crate::bvh::packet::PacketSeeker;
use crate::math::Vector;
use crate::math::ray::Ray;
use crate::math::wide::*;

/// Lines that go much the same way: along the same axis, and in the same direction along each.
struct Search<'a, 'b, F> {
    mesh: &'a Mesh,
    lines: &'a [LocalRay<'b>],
    /// Where the search along each begins.
    from: Row,
    /// How far each goes from there.
    limits: Row,
    /// The dominant axis of all, and the other two in cyclic order.
    axes: [usize; 3],
    /// Of the lines' starts, along these axes.
    starts: [Row; 3],
    shears: [Row; 2],
    doubts: Row,
    /// A bit for each line that goes against the dominant axis.
    against: u32,
    found: F,
}

impl Mesh {
    /// Calls `found` with the number of a line and a face that it pierces, as [`Mesh::pierced`] does for one line.
    /// Returns whether it did: only up to [`ROW`] lines that go much the same way are searched together.
    pub(super) fn pierced_together(
        &self,
        lines: &[LocalRay],
        between: &[(f64, f64)],
        found: impl FnMut(usize, Met) -> f64,
    ) -> bool {
        let (Some(first), Some(tree)) = (lines.first(), &self.tree) else { return false };
        let axes = View::along(first, self.reach).axes();
        if lines.len() > ROW {
            return false;
        }
        let (mut rays, mut slack) = (Rays::NONE, 0.0f64);
        let mut search = Search {
            mesh: self,
            lines,
            from: [0.0; ROW],
            limits: [f64::NEG_INFINITY; ROW],
            axes,
            starts: [[0.0; ROW]; 3],
            shears: [[0.0; ROW]; 2],
            doubts: [0.0; ROW],
            against: 0,
            found,
        };
        for (number, (line, (from, to))) in lines.iter().zip(between).enumerate() {
            let view = View::along(line, self.reach);
            if view.axes() != axes {
                return false;
            }
            let own = 32.0 * U * (self.reach + line.nearest.length()) + view.doubt;
            let from = from.max(-self.reach - own);
            slack = slack.max(own);
            rays.set(number, &Ray { origin: line.at(from), direction: line.direction });
            (search.from[number], search.limits[number]) = (from, to - from);
            let (start, shear) = view.line();
            for (row, axis) in search.starts.iter_mut().zip(axes) {
                row[number] = start[axis];
            }
            for (row, shear) in search.shears.iter_mut().zip(shear) {
                row[number] = shear;
            }
            search.doubts[number] = view.doubt;
            search.against |= u32::from(view.is_against()) << number;
        }
        tree.visit_together(&rays, slack, &mut search);
        true
    }
}

impl<F: FnMut(usize, Met) -> f64> Search<'_, '_, F> {
    /// Looks at faces for the lines whose bits are set.
    #[inline(always)]
    fn faces<S: Simd>(&mut self, simd: S, faces: Range<usize>, mask: u32) {
        for number in faces {
            self.face(simd, number, mask);
        }
    }

    #[inline(always)]
    fn face<S: Simd>(&mut self, simd: S, number: usize, mask: u32) {
        let corners = self.mesh.corners_of(&self.mesh.faces[number]);
        // Found for the first line that needs it.
        let mut flat = None;
        for group in 0..GROUPS {
            if !has(mask, group) {
                continue;
            }
            let sides = self.sides(simd, group, &corners);
            let may_pierce = bits(sides.may_pierce, group) & mask;
            let [left, right] = sides.around_all.map(|mask| bits(mask, group));
            for line in numbers(may_pierce) {
                let is_against = self.against >> line & 1 == 1;
                let leaving = match (left >> line & 1, right >> line & 1) {
                    (0, 0) => {
                        match View::along(&self.lines[line], self.mesh.reach).pierces(corners) {
                            Some(leaving) => leaving,
                            None => continue,
                        }
                    }
                    (is_left, _) => (is_left == 1) == is_against,
                };
                let flat = *flat.get_or_insert_with(|| self.mesh.flat(number));
                let (ray, part) = (&self.lines[line], 2 * number as u32);
                let met = pierce::met(ray, corners, flat, leaving, part);
                self.limits[line] = (self.found)(line, met) - self.from[line];
            }
        }
    }

    /// Returns how four lines pass the edges of a triangle.
    #[inline(always)]
    fn sides<S: Simd>(&self, simd: S, group: usize, corners: &[Vector; 3]) -> Sides<S> {
        let [a, b, c] = corners;
        let (a, b, c) =
            (self.seen(simd, group, *a), self.seen(simd, group, *b), self.seen(simd, group, *c));
        let doubt = four(simd, &self.doubts, group);
        let ab = turns_surely(simd, doubt, a, b);
        let bc = turns_surely(simd, doubt, b, c);
        let ca = turns_surely(simd, doubt, c, a);
        Sides {
            may_pierce: !((ab[0] | bc[0] | ca[0]) & (ab[1] | bc[1] | ca[1])),
            around_all: [ab[0] & bc[0] & ca[0], ab[1] & bc[1] & ca[1]],
        }
    }

    /// Returns the projection of a point, as [`View`] sees it.
    #[inline(always)]
    fn seen<S: Simd>(&self, simd: S, group: usize, point: Vector) -> [Wide<S>; 2] {
        let [main, first, second] = self.axes;
        let [along, right, up] = &self.starts;
        let main = all(simd, point[main]) - four(simd, along, group);
        let first = all(simd, point[first]) - four(simd, right, group);
        let second = all(simd, point[second]) - four(simd, up, group);
        let [right, up] = &self.shears;
        [first - four(simd, right, group) * main, second - four(simd, up, group) * main]
    }
}

/// How four lines pass the edges of a triangle.
struct Sides<S: Simd> {
    /// Those that do not certainly turn to the left around one edge and to the right around another.
    may_pierce: Mask<S>,
    /// Those that certainly turn to the left around all edges, and to the right.
    around_all: [Mask<S>; 2],
}

/// Returns which lines see certainly a turn to the left from `p` to `q`, and which to the right: [`View`]'s
/// `turns_surely`.
#[inline(always)]
fn turns_surely<S: Simd>(
    simd: S,
    doubt: Wide<S>,
    p: [Wide<S>; 2],
    q: [Wide<S>; 2],
) -> [Mask<S>; 2] {
    let (left, right) = (p[0] * q[1], p[1] * q[0]);
    let turn = left - right;
    let sizes = p[0].abs() + p[1].abs() + q[0].abs() + q[1].abs();
    let off = all(simd, 3.0 * U) * (left.abs() + right.abs())
        + doubt * (sizes + all(simd, 2.0) * doubt)
        + all(simd, f64::MIN_POSITIVE);
    [turn.simd_gt(off), turn.simd_lt(-off)]
}

impl<F: FnMut(usize, Met) -> f64> PacketSeeker for Search<'_, '_, F> {
    #[inline(always)]
    fn leaf(&mut self, mask: u32, pieces: Range<usize>) {
        dispatch!(self.instructions().level(), simd => self.faces(simd, pieces, mask));
    }

    #[inline(always)]
    fn limits(&self) -> &Row {
        &self.limits
    }

    #[inline(always)]
    fn node(&mut self) {}
}
