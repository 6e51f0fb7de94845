//! What may stand between a place and an area: one search for all rays from the one to the other.
//!
//! **In:** a [`Shaft`]. **Out:** [`Between`]. **Invariant:** what is not in it shadows none of these rays; what is in it
//! may.

use super::shades::Shades;
use super::{Entry, Geometry, Occluder, Solid, Work};
use crate::bvh::shaft::Shaft;
use crate::math::Vector;
use crate::math::wide::*;
use crate::shape::{Box_, Plane, Sphere};
use smallvec::SmallVec;

/// More are searched for ray by ray.
const MOST: usize = 8;

/// For the rounding of tests, of cosines and relative to lengths.
const SLACK: f64 = 1e-9;

/// A few entries that may stop light, or a part of it, on its way from an area to a place.
#[derive(Debug, Default)]
pub struct Between {
    places: SmallVec<[usize; MOST]>,
    /// One of them stops a part of it.
    pub filters: bool,
}

impl Between {
    pub fn is_empty(&self) -> bool {
        self.places.is_empty()
    }
}

/// A cone around a shaft.
struct Cone {
    from: Vector,
    axis: Vector,
    sine: f64,
    cosine: f64,
}

impl Cone {
    /// Returns `None` if the place is too near to the area, or in it.
    fn around(shaft: &Shaft) -> Option<Self> {
        let middle = (shaft.to.low + shaft.to.high) * 0.5;
        let radius = (shaft.to.high - shaft.to.low).length() * 0.5;
        let way = middle - shaft.from;
        let length = way.length();
        let sine = radius / length;
        (sine < 1.0).then(|| Self {
            from: shaft.from,
            axis: way / length,
            sine,
            cosine: (1.0 - sine * sine).sqrt(),
        })
    }

    /// Whether it passes by a ball: the angle between the axis and the centre is larger than its own and the ball's
    /// together.
    #[inline(always)]
    fn misses(&self, &Sphere { centre, radius }: &Sphere) -> bool {
        let way = centre - self.from;
        let length = way.length();
        // A place on the ball sees it in half of all directions.
        let sine = (radius / length).min(1.0);
        let cosine = (1.0 - sine * sine).max(0.0).sqrt();
        let between = self.axis.dot(way) / length;
        // One in it may see all of it.
        radius < length * (1.0 - f64::EPSILON)
            && between < self.cosine * cosine - self.sine * sine - SLACK
    }
}

/// Whether the place and all of the area are on the outer side of N·P = d.
#[inline(always)]
fn is_beyond(shaft: &Shaft, normal: Vector, distance: f64) -> bool {
    let nearest = |axis: usize| match normal[axis] < 0.0 {
        true => normal[axis] * shaft.to.high[axis],
        false => normal[axis] * shaft.to.low[axis],
    };
    let least = nearest(0) + nearest(1) + nearest(2);
    let size = |of: Vector| (normal.abs() * of).element_sum() + distance.abs();
    let slack = SLACK * size(shaft.to.low.abs().max(shaft.to.high.abs()));
    // Not in it: rays that start there would meet it.
    let start = normal.dot(shaft.from) - f64::EPSILON * size(shaft.from.abs());
    start > distance && least - slack > distance
}

/// Whether a shaft passes by a box, since both its ends are beyond one of the faces.
fn passes_box(shaft: &Shaft, box_: &Box_) -> bool {
    let sides = box_.normals.iter().zip(box_.half_widths);
    sides.into_iter().any(|(normal, half)| {
        let normal = normal.get();
        let middle = normal.dot(box_.centre);
        is_beyond(shaft, normal, middle + half) || is_beyond(shaft, -normal, half - middle)
    })
}

fn passes_plane(shaft: &Shaft, plane: &Plane) -> bool {
    let (normal, distance) = (plane.normal.get(), plane.distance);
    is_beyond(shaft, normal, distance) || is_beyond(shaft, -normal, -distance)
}

impl Geometry {
    /// Returns what may shadow rays of a shaft; `None` if that is more than a few entries.
    #[inline(never)]
    pub fn between(&self, shaft: &Shaft, work: &mut Work) -> Option<Between> {
        let mut between = Between::default();
        let cone = Cone::around(shaft)?;
        for place in 0..self.unbounded {
            self.stands(&mut between, place, shaft, &cone);
        }
        match &self.tree {
            Some(tree) => tree.visit_between(
                shaft,
                || work.box_visits += u64::from(self.counts),
                |pieces| {
                    for piece in pieces {
                        self.stands(&mut between, self.unbounded + piece, shaft, &cone);
                    }
                    between.places.len() <= MOST
                },
            ),
            None => {
                for place in self.unbounded..self.entries.len() {
                    self.stands(&mut between, place, shaft, &cone);
                }
            }
        }
        (between.places.len() <= MOST).then_some(between)
    }

    /// Adds an entry, if it may shadow rays of a shaft.
    #[inline(always)]
    fn stands(&self, between: &mut Between, place: usize, shaft: &Shaft, cone: &Cone) {
        let entry = &self.entries[place];
        if (entry.blocks || entry.filters) && !self.passes(entry, shaft, cone) {
            between.places.push(place);
            between.filters |= entry.filters;
        }
    }

    #[inline(always)]
    fn passes(&self, entry: &Entry, shaft: &Shaft, cone: &Cone) -> bool {
        match &entry.solid {
            Solid::Sphere(sphere) => cone.misses(sphere),
            Solid::Plane(plane) => passes_plane(shaft, plane),
            Solid::Box(i) => {
                let (box_, reach_squared) = &self.boxes[*i as usize];
                let ball = Sphere { centre: box_.centre, radius: reach_squared.sqrt() };
                cone.misses(&ball) || passes_box(shaft, box_)
            }
            Solid::Ellipsoid(_) | Solid::Placed(_) | Solid::Whole(_) => false,
        }
    }

    /// [`Self::occluded_together`] for rays of a shaft that only these entries may shadow.
    #[inline(never)]
    pub fn occluded_between(
        &self,
        between: &Between,
        (rays, distances): (&Rays, &Row),
        guess: &mut Occluder,
        work: &mut Work,
    ) -> u32 {
        let mut shades = Shades::new(self, rays, distances, self.counts.then_some(work));
        dispatch!(self.instructions.level(), simd => shades.look_at(simd, &between.places, *guess));
        shades.finish(guess)
    }
}
