//! Octree over the box of an isosurface, subdivided where the function may be 0.
//!
//! **In:** bounds of the function over boxes; a line. **Out:** the line's pieces, in order, each with what is
//! known of the function there. **Invariant:** the contents of a cell depend only on its position, so results
//! do not depend on which line comes first. Cells are created on demand, at most 64 along each axis.

use std::sync::OnceLock;

use smallvec::SmallVec;

use crate::function::Sloped;
use crate::math::Vector;
use crate::math::interval::Interval;
use crate::shape::local::LocalRay;

/// Maximum number of subdivisions of the box along each axis.
const DEPTH: u32 = 6;

/// Number of subdivisions from which on the errors of computed numbers are those of the cell around.
const ROUNDED: u32 = 3;

/// Margin by which cells are enlarged, relative to the box's size; lines with a smaller error can be traced
/// through cells.
pub(super) const MARGIN: f64 = 1.0 / 4_294_967_296.0;

/// A cell is not subdivided if the gradient varies by less than this fraction of its length.
const FLAT: f64 = 0.125;

/// Cached bounds of a function in a box.
#[derive(Default)]
pub struct Cells {
    root: Cell,
}

#[derive(Default)]
struct Cell {
    known: OnceLock<Known>,
    parts: OnceLock<Box<[Cell; 8]>>,
}

/// Bounds of a function in a cell.
#[derive(Debug, Clone, Copy)]
pub(super) struct Known {
    /// Whether it is negative throughout; `None` if its sign may change.
    pub negative: Option<bool>,
    /// Whether it is undefined throughout.
    pub undefined: bool,
    /// Value at the middle.
    value: Interval,
    /// How far a number computed for a point of the cell may be from the exact one; infinite if that is not known.
    error: f32,
    /// Range of the gradient in the cell; valid only there.
    slopes: [[f32; 2]; 3],
}

/// Part of a line, in one cell.
#[derive(Debug, Clone, Copy)]
pub(super) struct Piece<'a> {
    pub from: f64,
    pub to: f64,
    pub known: &'a Known,
    pub middle: Vector,
}

impl Clone for Cells {
    /// Returns an empty cache: its contents are recomputed.
    fn clone(&self) -> Self {
        Self::default()
    }
}

/// Evaluates the function over boxes.
pub(super) struct Evaluate<B, V, E> {
    /// Bounds of the value and the gradient; `None` where it is undefined.
    pub bounds: B,
    pub value: V,
    /// Error of a number computed for a point.
    pub error: E,
}

impl Known {
    fn new(
        evaluate: &Evaluate<
            impl Fn([Interval; 3]) -> Option<Sloped<3>>,
            impl Fn([Interval; 3]) -> Interval,
            impl Fn([Interval; 3]) -> f64,
        >,
        middle: Vector,
        half: Vector,
        margin: f64,
        (depth, error): (u32, f32),
    ) -> Self {
        let around = |axis: usize| {
            let (at, far) = (middle[axis], half[axis] + margin);
            Interval { low: at - far, high: at + far }
        };
        let (all, undefined) = match (evaluate.bounds)([0, 1, 2].map(around)) {
            Some(all) => (all, false),
            None => (Sloped::anyhow(Interval::EVERYTHING, false), true),
        };
        let Sloped { value: all, slopes } = all;
        let slopes = slopes
            .map(|Interval { low, high }| [(low as f32).next_down(), (high as f32).next_up()]);
        let mut known =
            Self { negative: sign(all), undefined, value: Interval::EVERYTHING, error, slopes };
        if known.negative.is_none() {
            known.value = (evaluate.value)(middle.to_array().map(Interval::point));
            let step = |axis: usize| {
                let far = half[axis] + margin;
                known.slope(axis) * Interval { low: -far, high: far }
            };
            known.negative = sign(known.value + step(0) + step(1) + step(2));
        }
        let is_leaf = depth == DEPTH || known.is_flat();
        if known.negative.is_none()
            && !undefined
            && error == f32::INFINITY
            && (is_leaf || depth == ROUNDED)
        {
            known.error = ((evaluate.error)([0, 1, 2].map(around)) as f32).next_up();
        }
        known
    }

    fn slope(&self, axis: usize) -> Interval {
        let [low, high] = self.slopes[axis];
        Interval { low: f64::from(low), high: f64::from(high) }
    }

    /// Whether the gradient is nearly constant.
    fn is_flat(&self) -> bool {
        let wide = self.slopes.map(|[low, high]| high - low);
        let mid = self.slopes.map(|[low, high]| 0.5 * (high + low));
        let square = |v: [f32; 3]| v.iter().map(|c| c * c).sum::<f32>();
        square(wide) <= (FLAT * FLAT) as f32 * square(mid)
    }

    /// Returns the range of the function's slope along a line whose direction may be off by `turn`.
    pub fn along(&self, direction: Vector, turn: f64) -> Interval {
        let term = |axis: usize| {
            let way = direction[axis];
            self.slope(axis) * Interval { low: way - turn, high: way + turn }
        };
        term(0) + term(1) + term(2)
    }

    /// Returns how far a number computed for a point of the cell may be from the exact one for a point within `off`
    /// along each axis; infinite if that is not known.
    pub fn error(&self, off: f64) -> f64 {
        let steepest = |axis: usize| {
            let Interval { low, high } = self.slope(axis);
            high.max(-low)
        };
        let error = f64::from(self.error) + off * (steepest(0) + steepest(1) + steepest(2));
        if error.is_nan() { f64::INFINITY } else { error }
    }

    /// Returns the range of the function at a point of the cell that may be off by `blur`.
    pub fn at(&self, from_middle: Vector, blur: f64) -> Interval {
        let term = |axis: usize| {
            let step = from_middle[axis];
            self.slope(axis) * Interval { low: step - blur, high: step + blur }
        };
        self.value + (term(0) + term(1) + term(2))
    }
}

fn sign(value: Interval) -> Option<bool> {
    match (value.low > 0.0, value.high < 0.0) {
        (true, _) => Some(false),
        (_, true) => Some(true),
        _ => None,
    }
}

/// A cell to visit.
struct Visit<'a> {
    cell: &'a Cell,
    middle: Vector,
    depth: u32,
    /// As far as known from the cell around it.
    error: f32,
    from: f64,
    to: f64,
}

impl Cells {
    /// Calls `show` with the pieces that the cells of a box with half widths `half` cut a line into, over a
    /// range, until it returns `false`.
    pub(super) fn along(
        &self,
        ray: &LocalRay,
        half: Vector,
        (from, to): (f64, f64),
        evaluate: &Evaluate<
            impl Fn([Interval; 3]) -> Option<Sloped<3>>,
            impl Fn([Interval; 3]) -> Interval,
            impl Fn([Interval; 3]) -> f64,
        >,
        mut show: impl FnMut(Piece) -> bool,
    ) {
        let margin = MARGIN * half.max_element();
        let halves: [Vector; DEPTH as usize + 1] =
            std::array::from_fn(|depth| half / f64::from(1u32 << depth));
        let inverse = ray.direction.recip();
        let mut stack: SmallVec<[Visit; 24]> = SmallVec::new();
        stack.push(Visit {
            cell: &self.root,
            middle: Vector::ZERO,
            depth: 0,
            error: f32::INFINITY,
            from,
            to,
        });
        while let Some(Visit { cell, middle, depth, error, from, to }) = stack.pop() {
            let half = halves[depth as usize];
            let known = cell
                .known
                .get_or_init(|| Known::new(evaluate, middle, half, margin, (depth, error)));
            let is_told = known.negative.is_some() || known.undefined;
            if is_told || depth == DEPTH || known.is_flat() {
                if !show(Piece { from, to, known, middle }) {
                    return;
                }
                continue;
            }
            let parts = cell.parts.get_or_init(Default::default);
            // Where the line passes from part to part.
            let mut ends = [from, to, to, to, to];
            let mut count = 1;
            let passes = (middle - ray.nearest) * inverse;
            for pass in passes.to_array() {
                if from < pass && pass < to {
                    let mut place = count;
                    while place > 1 && ends[place - 1] > pass {
                        ends[place] = ends[place - 1];
                        place -= 1;
                    }
                    ends[place] = pass;
                    count += 1;
                }
            }
            ends[count] = to;
            let quarter = halves[depth as usize + 1];
            for at in (0..count).rev() {
                let (from, to) = (ends[at], ends[at + 1]);
                let place = ray.at(0.5 * (from + to));
                let above = place.cmpge(middle);
                let bit = |axis: usize| usize::from(above.test(axis)) << axis;
                let way =
                    |axis: usize| if above.test(axis) { quarter[axis] } else { -quarter[axis] };
                let cell = &parts[bit(0) | bit(1) | bit(2)];
                let middle = middle + Vector::new(way(0), way(1), way(2));
                stack.push(Visit { cell, middle, depth: depth + 1, error: known.error, from, to });
            }
        }
    }
}
