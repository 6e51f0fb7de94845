//! Lines through a mesh side by side: of four at once it is known which certainly miss a triangle.
//!
//! **Invariant:** each line finds what it finds alone: a triangle that it may pierce is tested for it alone.

use std::ops::Range;

use super::super::U;
use super::super::local::{LocalRay, Met};
use super::Mesh;
use super::pierce::{self, View};
use crate::bvh::packet::PacketSeeker;
use crate::math::Vector;
use crate::math::ray::Ray;
use crate::math::wide::*;
use smallvec::SmallVec;

/// Lines that go much the same way: along the same axis, and in the same direction along each.
struct Search<'a, 'b, F> {
    mesh: &'a Mesh,
    lines: &'a [LocalRay<'b>],
    views: SmallVec<[View<'b>; ROW]>,
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
        let views = lines.iter().map(|line| View::along(line, self.reach));
        let views: SmallVec<[View; ROW]> = views.take(ROW).collect();
        let Some(first) = views.first() else { return true };
        let axes = first.axes();
        if lines.len() > ROW || views.iter().any(|view| view.axes() != axes) {
            return false;
        }
        let (mut rays, mut slack) = (Rays::NONE, 0.0f64);
        let mut search = Search {
            mesh: self,
            lines,
            views,
            from: [0.0; ROW],
            limits: [f64::NEG_INFINITY; ROW],
            axes,
            starts: [[0.0; ROW]; 3],
            shears: [[0.0; ROW]; 2],
            doubts: [0.0; ROW],
            found,
        };
        for (number, (line, (from, to))) in lines.iter().zip(between).enumerate() {
            let view = &search.views[number];
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
        }
        self.tree.visit_together(&rays, slack, &mut search);
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
        for group in 0..GROUPS {
            if !has(mask, group) {
                continue;
            }
            let pierced = bits(self.may_pierce(simd, group, &corners), group) & mask;
            for line in numbers(pierced) {
                if let Some(pierced) = self.views[line].pierces(corners) {
                    let met = pierce::met(&self.lines[line], corners, pierced, 2 * number as u32);
                    self.limits[line] = (self.found)(line, met) - self.from[line];
                }
            }
        }
    }

    /// Returns which of four lines do not certainly turn to the left around one edge and to the right around another.
    #[inline(always)]
    fn may_pierce<S: Simd>(&self, simd: S, group: usize, corners: &[Vector; 3]) -> Mask<S> {
        let [a, b, c] = corners;
        let (a, b, c) =
            (self.seen(simd, group, *a), self.seen(simd, group, *b), self.seen(simd, group, *c));
        let doubt = four(simd, &self.doubts, group);
        let ab = turns_surely(simd, doubt, a, b);
        let bc = turns_surely(simd, doubt, b, c);
        let ca = turns_surely(simd, doubt, c, a);
        !((ab[0] | bc[0] | ca[0]) & (ab[1] | bc[1] | ca[1]))
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
