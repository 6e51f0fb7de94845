//! Text: a row of letters in one local space, each a prism from z = −1 to 1; or, if flat, a sheet at z = 0.
//! Overlapping letters are merged.
//!
//! **Invariant:** a line is tested only against the letters whose boxes it passes through.
//!
//! **Source:** POV-Ray 3.7 manual, 3.4.5.1.16; how outlines are filled: the OpenType specification, `glyf`.

use smallvec::SmallVec;

use super::curve::Outline;
use super::local::{Crossings, Height, Local, LocalRay, Met, Span, unite};
use super::polygon::on_the_plane;
use super::prism::Prism;
use super::slab::meant;
use super::tree::Tree;
use super::{Bounds, U};
use crate::math::Vector;

/// A letter, and its range of part numbers.
#[derive(Debug, Clone, PartialEq)]
struct Letter {
    prism: Prism,
    first_part: u32,
}

/// A row of letters, each a prism from z = −1 to 1, or a sheet.
#[derive(Debug, Clone, PartialEq)]
pub struct Text {
    /// In the order of the tree.
    letters: Vec<Letter>,
    tree: Tree,
    reach: f64,
    is_flat: bool,
}

impl Text {
    /// Builds the text; `None` if there are no letters, or more than part numbers allow.
    pub fn new(outlines: Vec<Outline>, is_flat: bool) -> Option<Self> {
        if outlines.is_empty() {
            return None;
        }
        let heights = if is_flat { [0.0; 2] } else { [-1.0, 1.0] };
        let prism = |outline| Prism { outline, conic: false, heights, open: false };
        let prisms: Vec<Prism> = outlines.into_iter().map(prism).collect();
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
        Some(Self { letters, tree, reach, is_flat })
    }

    /// Returns the letter that a part belongs to, and the part's number within the letter.
    fn letter_of(&self, part: u32) -> (&Letter, u32) {
        let after = self.letters.partition_point(|letter| letter.first_part <= part);
        let letter = &self.letters[after.saturating_sub(1)];
        (letter, part - letter.first_part)
    }

    /// Returns the crossing of a line with flat letters, whose outlines belong to them.
    fn met_flat(&self, ray: &LocalRay) -> Option<Met> {
        let (met, drift) = on_the_plane(ray, self.reach)?;
        let Vector { x, y, .. } = ray.at(met.t);
        let mut is_there = false;
        self.tree.along(ray, drift + 16.0 * U, |run| {
            let mut near = self.letters[run].iter();
            let outside =
                |letter: &Letter| letter.prism.outline.is_inside([x, y], drift) == Some(false);
            is_there = is_there || near.any(|letter| !outside(letter));
        });
        is_there.then_some(met)
    }
}

impl Local for Text {
    fn crossings(&self, ray: &LocalRay, found: &mut Crossings) {
        self.first_crossings(ray, (f64::NEG_INFINITY, f64::INFINITY), found);
    }

    /// Adds the crossings of the letters that the line passes through in the range; beyond its ends, a letter may be
    /// missing that hides a crossing.
    fn first_crossings(&self, ray: &LocalRay, between: (f64, f64), found: &mut Crossings) {
        if self.is_flat {
            found.extend(self.met_flat(ray));
            return;
        }
        let mut spans: SmallVec<[Span; 4]> = SmallVec::new();
        let mut own = Crossings::new();
        // Nothing goes farther than √2.
        self.tree.along(ray, ray.blur_at(2.0) + 16.0 * U + meant(ray), |run| {
            for letter in &self.letters[run] {
                own.clear();
                letter.prism.first_crossings(ray, between, &mut own);
                let named = |met: Met| Met { part: met.part + letter.first_part, ..met };
                spans.extend(own.chunks_exact(2).map(|pair| (named(pair[0]), named(pair[1]))));
            }
        });
        unite(&mut spans, found);
    }

    /// Known where only one letter is possible.
    fn part_at(&self, ray: &LocalRay, s: f64, leaving: bool) -> Option<u32> {
        if self.is_flat {
            return None;
        }
        let point = ray.at(s);
        let off = 64.0 * (ray.blur_at(s) + U * (1.0 + s.abs())) + 2.0 * ray.tolerance;
        let near = Bounds { low: point - off, high: point + off };
        let mut found: SmallVec<[usize; 4]> = SmallVec::new();
        self.tree.touching(&near, |run| found.extend(run));
        let [number] = found[..] else { return None };
        let Letter { prism, first_part } = &self.letters[number];
        Some(first_part + prism.part_at(ray, s, leaving)?)
    }

    fn height(&self, part: u32, point: Vector) -> Height {
        if self.is_flat {
            return Height { value: point.z, gradient: Vector::Z, error: 0.0 };
        }
        let (letter, part) = self.letter_of(part);
        letter.prism.height(part, point)
    }

    fn extent(&self, along: Vector) -> (f64, f64) {
        let extents = self.letters.iter().map(|letter| letter.prism.extent(along));
        extents.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), (from, to)| {
            (low.min(from), high.max(to))
        })
    }

    /// Not measured: assumed from similar shapes.
    fn price(&self) -> u64 {
        100 + 7 * u64::from(self.letters.len().max(1).ilog2())
    }

    fn reach(&self) -> f64 {
        self.reach
    }

    fn numbers(&self) -> String {
        let pieces: usize =
            self.letters.iter().map(|letter| letter.prism.outline.pieces.len()).sum();
        let flat = if self.is_flat { " flat" } else { "" };
        format!(" of {}{flat} letters, {pieces} pieces", self.letters.len())
    }

    fn contains(&self, point: Vector) -> bool {
        !self.is_flat && self.letters.iter().any(|letter| letter.prism.contains(point))
    }

    fn is_iterated(&self) -> bool {
        !self.is_flat && self.letters.iter().any(|letter| letter.prism.is_iterated())
    }

    fn is_sheet(&self) -> bool {
        self.is_flat
    }
}

#[cfg(test)]
impl Text {
    pub(super) fn outlines(&self) -> impl Iterator<Item = &Outline> {
        self.letters.iter().map(|letter| &letter.prism.outline)
    }
}
