//! Traverses the cells of a grid under a line, column by column in the order of the line.
//!
//! **Invariant:** every cell that the line may pass over is reported once; rounding may add a few more.

use std::cell::Cell;

use super::super::local::LocalRay;
use super::U;

/// A line over the grid, limited to a range.
#[derive(Debug, Clone, Copy)]
pub(super) struct Track {
    /// Its position at s = 0: along x and z, in cells; along y, as it is.
    start: [f64; 3],
    step: [f64; 3],
    /// 1 over that.
    inverse: [f64; 3],
    /// Rounding error of each coordinate.
    slack: [f64; 3],
    /// The range of s that counts.
    span: [f64; 2],
}

/// A rectangle of cells along x and z; `to` is exclusive.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Cells {
    pub from: [usize; 2],
    pub to: [usize; 2],
}

impl Track {
    /// Returns the part of a line, with position error `doubt`, over the unit square around the origin,
    /// between two heights and in a range of s. `None` if it is empty.
    pub fn new(
        ray: &LocalRay,
        doubt: f64,
        (from, to): (f64, f64),
        cells: [usize; 2],
        [low, high]: [f64; 2],
    ) -> Option<Self> {
        let (n, d) = (ray.nearest, ray.direction);
        let off = 64.0 * U * (2.0 + n.length()) + doubt;
        let sizes = cells.map(|count| count as f64);
        let step = [d.x * sizes[0], d.z * sizes[1], d.y];
        let mut track = Self {
            start: [(n.x + 0.5) * sizes[0], (n.z + 0.5) * sizes[1], n.y],
            step,
            inverse: step.map(f64::recip),
            slack: [off * sizes[0], off * sizes[1], off],
            span: [from.max(-4.0) - off, to.min(4.0) + off],
        };
        for (axis, [low, high]) in
            [[0.0, sizes[0]], [0.0, sizes[1]], [low, high]].into_iter().enumerate()
        {
            track.span = track.within(axis, low, high)?;
        }
        Some(track)
    }

    /// Returns the part of the span where a coordinate may be between two values.
    #[inline(always)]
    fn within(&self, axis: usize, low: f64, high: f64) -> Option<[f64; 2]> {
        let (start, inverse, slack) = (self.start[axis], self.inverse[axis], self.slack[axis]);
        let (low, high) = (low - slack - start, high + slack - start);
        let (a, b) = (low * inverse, high * inverse);
        if !(a.is_finite() && b.is_finite()) {
            return (low <= 0.0 && 0.0 <= high).then_some(self.span);
        }
        let [first, last] = self.span;
        let span = [most(first, least(a, b)), least(last, most(a, b))];
        (span[0] <= span[1]).then_some(span)
    }

    /// Returns the range of a coordinate over a part of the span.
    #[inline(always)]
    fn range(&self, axis: usize, span: [f64; 2]) -> [f64; 2] {
        let [a, b] = span.map(|s| self.start[axis] + self.step[axis] * s);
        [least(a, b) - self.slack[axis], most(a, b) + self.slack[axis]]
    }

    /// Calls `found` with the blocks of `SIZE` cells of a region that the line may pass over, and with the
    /// range of the line's heights there; column by column as the line goes, up to the limit, which `found`
    /// may lower.
    pub fn blocks<const SIZE: usize>(
        &self,
        region: Cells,
        limit: &Cell<f64>,
        mut found: impl FnMut(Cells, [f64; 2]),
    ) {
        let main = usize::from(self.step[1].abs() > self.step[0].abs());
        let other = 1 - main;
        let froms = region.from.map(|from| from as i32);
        // The numbers of the blocks that hold a range of places along an axis: no field is as wide as `i32`.
        let numbers = |axis: usize, [low, high]: [f64; 2]| {
            let last = region.to[axis] as i32 - 1;
            let within = |place: f64| (place as i32).max(froms[axis]).min(last) as usize / SIZE;
            (within(low), within(high))
        };
        let block = |axis: usize, number: usize| {
            let from = (number * SIZE).max(region.from[axis]);
            (from, ((number + 1) * SIZE).min(region.to[axis]))
        };
        let (first, last) = numbers(main, self.range(main, self.span));
        let is_backward = self.step[main] < 0.0;
        for column in first..=last {
            let column = if is_backward { first + (last - column) } else { column };
            let (from, to) = block(main, column);
            let Some(span) = self.within(main, from as f64, to as f64) else { continue };
            if span[0] > limit.get() {
                return;
            }
            let heights = self.range(2, span);
            let (lowest, highest) = numbers(other, self.range(other, span));
            for row in lowest..=highest {
                let (begin, end) = block(other, row);
                let cells = match main {
                    0 => Cells { from: [from, begin], to: [to, end] },
                    _ => Cells { from: [begin, from], to: [end, to] },
                };
                found(cells, heights);
            }
        }
    }
}

/// The lesser of two numbers, in one instruction: neither is NaN, or it does not matter.
#[inline(always)]
fn least(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// The greater of two numbers, as [`least`].
#[inline(always)]
fn most(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}
