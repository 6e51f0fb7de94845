//! Text: letters side by side, each a prism of its own, in one space. Where they overlap they are one.
//!
//! **Invariant:** a line asks only the letters whose boxes it goes through.

use smallvec::SmallVec;

use super::U;
use super::body::{Crossings, Height, Local, LocalRay, Met};
use super::prism::Prism;
use crate::math::Vector;

/// A letter, and what of the parts is its own.
#[derive(Debug, Clone, PartialEq)]
struct Letter {
    prism: Prism,
    low: Vector,
    high: Vector,
    first_part: u32,
}

#[derive(Debug, Clone, PartialEq)]
pub struct Text {
    letters: Vec<Letter>,
    reach: f64,
}

impl Text {
    /// `None` of no letters, or of more than can be numbered.
    pub fn new(prisms: Vec<Prism>) -> Option<Self> {
        let mut first_part = 0u32;
        let mut letters = Vec::with_capacity(prisms.len());
        for prism in prisms {
            let extents = [Vector::X, Vector::Y, Vector::Z].map(|axis| prism.extent(axis));
            let low = Vector::from_array(extents.map(|(low, _)| low));
            let high = Vector::from_array(extents.map(|(_, high)| high));
            // Its two ends, and both sides of each piece.
            let parts = 3 + 2 * u32::try_from(prism.outline.pieces.len()).ok()?;
            letters.push(Letter { prism, low, high, first_part });
            first_part = first_part.checked_add(parts).filter(|part| *part < Met::UNSEEN)?;
        }
        let reach = letters.iter().map(|letter| letter.prism.reach()).fold(0.0, f64::max);
        (!letters.is_empty()).then_some(Self { letters, reach })
    }

    /// The letter that a part is of, and what it calls it.
    fn letter_of(&self, part: u32) -> (&Letter, u32) {
        let after = self.letters.partition_point(|letter| letter.first_part <= part);
        let letter = &self.letters[after.saturating_sub(1)];
        (letter, part - letter.first_part)
    }
}

impl Letter {
    /// Whether a line goes through its box, as far as rounding tells.
    fn is_near(&self, ray: &LocalRay) -> bool {
        // Nothing goes farther than √2.
        let off = ray.blur_at(2.0) + 16.0 * U;
        let (mut first, mut last) = (-2.0_f64, 2.0_f64);
        for axis in 0..3 {
            let (place, speed) = (ray.nearest[axis], ray.direction[axis]);
            let (low, high) = (self.low[axis] - off, self.high[axis] + off);
            let ends = ((low - place) / speed, (high - place) / speed);
            if ends.0.is_finite() && ends.1.is_finite() {
                first = first.max(ends.0.min(ends.1));
                last = last.min(ends.0.max(ends.1));
            } else if place < low || place > high {
                return false;
            }
        }
        // Rounding moves each of these by less than the box was made wider, unless the line is nearly along
        // a side: then by no more than this.
        first <= last + 1e-9
    }
}

impl Local for Text {
    /// Spans of letters that overlap or touch, as far as rounding tells, become one.
    fn crossings(&self, ray: &LocalRay, found: &mut Crossings) {
        let mut spans: SmallVec<[(Met, Met); 4]> = SmallVec::new();
        let mut own = Crossings::new();
        for letter in self.letters.iter().filter(|letter| letter.is_near(ray)) {
            own.clear();
            letter.prism.crossings(ray, &mut own);
            let named = |met: Met| Met { part: met.part + letter.first_part, ..met };
            spans.extend(own.chunks_exact(2).map(|pair| (named(pair[0]), named(pair[1]))));
        }
        spans.sort_by(|a, b| a.0.t.total_cmp(&b.0.t));
        let mut spans = spans.into_iter();
        let Some((mut enter, mut leave)) = spans.next() else { return };
        for (next, end) in spans {
            if next.t - next.error <= leave.t + leave.error {
                if end.t > leave.t {
                    leave = end;
                }
            } else {
                found.extend([enter, leave]);
                (enter, leave) = (next, end);
            }
        }
        found.extend([enter, leave]);
    }

    fn height(&self, part: u32, point: Vector) -> Height {
        let (letter, part) = self.letter_of(part);
        letter.prism.height(part, point)
    }

    fn extent(&self, along: Vector) -> (f64, f64) {
        let extents = self.letters.iter().map(|letter| letter.prism.extent(along));
        extents.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), (from, to)| {
            (low.min(from), high.max(to))
        })
    }

    fn reach(&self) -> f64 {
        self.reach
    }

    fn numbers(&self) -> String {
        let pieces: usize =
            self.letters.iter().map(|letter| letter.prism.outline.pieces.len()).sum();
        format!(" of {} letters, {pieces} pieces", self.letters.len())
    }

    fn contains(&self, point: Vector) -> bool {
        self.letters.iter().any(|letter| letter.prism.contains(point))
    }
}
