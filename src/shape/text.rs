//! Text: letters side by side, each a prism of its own, in one space. Where they overlap they are one.
//!
//! **Invariant:** a line asks only the letters whose boxes it goes through.

use smallvec::SmallVec;

use super::body::{Crossings, Height, Local, LocalRay, Met};
use super::prism::Prism;
use super::tree::Tree;
use super::{Bounds, U};
use crate::math::Vector;

/// A letter, and what of the parts is its own.
#[derive(Debug, Clone, PartialEq)]
struct Letter {
    prism: Prism,
    first_part: u32,
}

#[derive(Debug, Clone, PartialEq)]
pub struct Text {
    /// In the order of the tree.
    letters: Vec<Letter>,
    tree: Tree,
    reach: f64,
}

impl Text {
    /// `None` of no letters, or of more than can be numbered.
    pub fn new(prisms: Vec<Prism>) -> Option<Self> {
        if prisms.is_empty() {
            return None;
        }
        let bounds = |prism: &Prism| {
            let extents = [Vector::X, Vector::Y, Vector::Z].map(|axis| prism.extent(axis));
            let low = Vector::from_array(extents.map(|(low, _)| low));
            let high = Vector::from_array(extents.map(|(_, high)| high));
            Bounds { low, high }
        };
        let (tree, order) = Tree::of_costly(&prisms.iter().map(bounds).collect::<Vec<_>>());
        let mut first_part = 0u32;
        let mut letters = Vec::with_capacity(prisms.len());
        for number in order {
            let prism = prisms[number as usize].clone();
            // Its two ends, and both sides of each piece.
            let parts = 3 + 2 * u32::try_from(prism.outline.pieces.len()).ok()?;
            letters.push(Letter { prism, first_part });
            first_part = first_part.checked_add(parts).filter(|part| *part < Met::UNSEEN)?;
        }
        let reach = letters.iter().map(|letter| letter.prism.reach()).fold(0.0, f64::max);
        Some(Self { letters, tree, reach })
    }

    /// The letter that a part is of, and what it calls it.
    fn letter_of(&self, part: u32) -> (&Letter, u32) {
        let after = self.letters.partition_point(|letter| letter.first_part <= part);
        let letter = &self.letters[after.saturating_sub(1)];
        (letter, part - letter.first_part)
    }
}

impl Local for Text {
    /// Spans of letters that overlap or touch, as far as rounding tells, become one.
    fn crossings(&self, ray: &LocalRay, found: &mut Crossings) {
        let mut spans: SmallVec<[(Met, Met); 4]> = SmallVec::new();
        let mut own = Crossings::new();
        // Nothing goes farther than √2.
        self.tree.along(ray, ray.blur_at(2.0) + 16.0 * U, |run| {
            for letter in &self.letters[run] {
                own.clear();
                letter.prism.crossings(ray, &mut own);
                let named = |met: Met| Met { part: met.part + letter.first_part, ..met };
                spans.extend(own.chunks_exact(2).map(|pair| (named(pair[0]), named(pair[1]))));
            }
        });
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
