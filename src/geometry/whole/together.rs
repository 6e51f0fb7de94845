//! Where rays side by side cross the leaves of a whole.
//!
//! **Invariant:** what is known of a ray is what its leaf's kernel finds of it alone.

use smallvec::SmallVec;

use super::super::{Geometry, Solid};
use super::{MOST_BALLS, Whole, from_inside};
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
}

/// What is known of the first leaves of a whole, for rays side by side.
pub(in crate::geometry) struct Known {
    /// Of each leaf where in its list it is found.
    places: [Place; MOST_BALLS as usize],
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
    /// Brings rays side by side to the leaves of a whole that they may meet.
    #[inline(always)]
    pub(in crate::geometry) fn known<S: Simd>(
        &self,
        simd: S,
        whole: &Whole,
        rays: &Rays,
        mask: u32,
    ) -> Known {
        let (chords, seen) = (SmallVec::new(), SmallVec::new());
        let mut known = Known { places: [Place::Nowhere; MOST_BALLS as usize], chords, seen };
        if mask.count_ones() < 2 || whole.tree.is_some() {
            return known;
        }
        for (leaf, entry) in whole.leaves.iter().enumerate().take(MOST_BALLS as usize) {
            let near = whole.near_leaf(simd, leaf, rays, mask);
            if near.count_ones() < 2 {
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
        known
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

    /// [`Geometry::crossings`] of a leaf.
    #[inline(always)]
    pub(in crate::geometry) fn crossings_of_leaf(
        &self,
        leaf: u32,
        solid: &Solid,
        line: &Line,
    ) -> Crossings {
        if let Some((known, number)) = line.known
            && let (Place::Seen(place), Solid::Placed(i)) = (known.place(leaf), solid)
            && let row = &known.seen[place as usize]
            && row.holds(number)
        {
            let placed = &self.placed[*i as usize];
            let all = placed.crossings_of_part_in(row, number, line.ray);
            return from_inside(placed, line.ray, all);
        }
        self.crossings(solid, line.ray)
    }
}
