//! Where rays side by side cross the leaves of a whole.
//!
//! **Invariant:** what is known of a ray is what its leaf's kernel finds of it alone.

use smallvec::SmallVec;

use super::super::{Geometry, Solid};
use super::{MOST_BALLS, Whole, begin_inside};
use crate::math::wide::*;
use crate::shape::local::Crossings;
use crate::shape::seen::SeenRow;
use crate::shape::{Chord, Chords, ChordsOfFour, Ray};

/// A ray that crosses a whole, and what is known of where it crosses the leaves.
#[derive(Clone, Copy)]
pub(in crate::geometry) struct Line<'a> {
    pub ray: &'a Ray,
    /// With its number in the row.
    pub known: Option<(&'a Known, usize)>,
}

impl<'a> Line<'a> {
    /// Of which nothing is known.
    pub fn alone(ray: &'a Ray) -> Self {
        Self { ray, known: None }
    }

    /// Returns which leaves of the whole it may meet.
    #[inline(always)]
    pub fn near(&self, whole: &Whole) -> Near {
        Near(match self.known {
            Some((known, number)) => known.near[number],
            None => whole.near(self.ray),
        })
    }
}

/// A bit for each of the first leaves of a whole that a line may meet.
#[derive(Clone, Copy)]
pub(in crate::geometry) struct Near(pub u32);

impl Near {
    /// Whether the line may meet a leaf: of those without a bit, each.
    #[inline(always)]
    pub fn has(self, leaf: u32) -> bool {
        leaf >= MOST_BALLS || self.0 >> leaf & 1 != 0
    }
}

/// What is known of the first leaves of a whole, for rays side by side.
pub(in crate::geometry) struct Known {
    /// Of each leaf where in its list it is found.
    places: [Place; MOST_BALLS as usize],
    /// For each ray, the leaves that its line may meet.
    near: [u32; ROW],
    chords: SmallVec<[Chords; 4]>,
    seen: SmallVec<[SeenRow; 2]>,
}

#[derive(Clone, Copy)]
enum Place {
    Nowhere,
    Chords(u8),
    Seen(u8),
}

impl Known {
    /// Nothing.
    #[inline(always)]
    pub fn new() -> Self {
        let places = [Place::Nowhere; MOST_BALLS as usize];
        Self { places, near: [0; ROW], chords: SmallVec::new(), seen: SmallVec::new() }
    }

    /// Adds the chords of a leaf, which are to be filled in: in place, as they are large.
    #[inline(always)]
    fn next_chords(&mut self, leaf: usize) -> &mut Chords {
        let place = self.chords.len();
        self.places[leaf] = Place::Chords(place as u8);
        self.chords.push(Chords::NONE);
        &mut self.chords[place]
    }

    /// Adds what a leaf sees, likewise.
    #[inline(always)]
    fn next_seen(&mut self, leaf: usize) -> &mut SeenRow {
        let place = self.seen.len();
        self.places[leaf] = Place::Seen(place as u8);
        self.seen.push(SeenRow::NONE);
        &mut self.seen[place]
    }

    fn place(&self, leaf: u32) -> Place {
        self.places.get(leaf as usize).copied().unwrap_or(Place::Nowhere)
    }
}

impl Geometry {
    /// Brings rays side by side to the leaves of a whole that they may meet. What is `known` is filled in: it is
    /// large.
    #[inline(always)]
    pub(in crate::geometry) fn bring_to_leaves<S: Simd>(
        &self,
        simd: S,
        whole: &Whole,
        rays: &Rays,
        mask: u32,
        known: &mut Known,
    ) {
        for (leaf, entry) in whole.leaves.iter().enumerate().take(MOST_BALLS as usize) {
            let near = whole.near_leaf(simd, leaf, rays, mask);
            numbers(near).for_each(|number| known.near[number] |= 1 << leaf);
            if near.count_ones() < 2 || whole.tree.is_some() {
                continue;
            }
            match entry.solid {
                Solid::Sphere(sphere) => sphere.chords(simd, rays, near, known.next_chords(leaf)),
                Solid::Box(i) => {
                    self.boxes[i as usize].0.chords(simd, rays, near, known.next_chords(leaf));
                }
                Solid::Placed(i) => {
                    self.placed[i as usize].see_part(simd, rays, near, known.next_seen(leaf));
                }
                Solid::Ellipsoid(i) => {
                    let ellipsoid = &self.ellipsoids[i as usize];
                    ellipsoid.chords(simd, rays, near, known.next_chords(leaf));
                }
                Solid::Plane(_) | Solid::Whole(_) => {}
            }
        }
    }

    /// [`Geometry::chord`] of a leaf.
    #[inline(always)]
    pub(in crate::geometry) fn chord_of_leaf(
        &self,
        leaf: u32,
        solid: &Solid,
        line: &Line,
    ) -> Option<Chord> {
        if let Some((known, number)) = line.known
            && let Place::Chords(place) = known.place(leaf)
            && let Some(chord) = known.chords[place as usize].at(number)
        {
            return chord;
        }
        self.chord(solid, line.ray)
    }

    /// Adds [`Geometry::crossings`] of a leaf.
    #[inline(always)]
    pub(in crate::geometry) fn add_crossings_of_leaf(
        &self,
        leaf: u32,
        solid: &Solid,
        line: &Line,
        all: &mut Crossings,
    ) {
        if let Some((known, number)) = line.known
            && let (Place::Seen(place), Solid::Placed(i)) = (known.place(leaf), solid)
            && let row = &known.seen[place as usize]
            && row.holds(number)
        {
            let placed = &self.placed[*i as usize];
            placed.add_crossings_of_part_in(row, number, line.ray, all);
            begin_inside(placed, line.ray, all);
            return;
        }
        *all = self.crossings(solid, line.ray);
    }
}
