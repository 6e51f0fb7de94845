//! Where surfaces only touch, which of them a ray sees: the one that rays right beside it see.
//!
//! **In:** a ray, and its first hit where error bounds do not tell that from other crossings. **Out:** the hit,
//! with the object that is nearer all around. **Invariant:** of surfaces that coincide none is, nor of those that
//! meet in an edge; there the order of the objects decides, as it did. So a ball that stands on a floor, seen
//! from below, is no speck in it, however exactly a ray aims at where they touch.

use super::nearest::Hit;
use super::search::Each;
use super::work::Uncounted;
use super::{Entry, Geometry, Solid, TIGHT};
use crate::math::Vector;
use crate::math::placement::norm;
use crate::shape::Ray;
use crate::shape::local::{Local, Met};

/// How far beside the ray is looked, in sizes of the smallest solid that is met: so near that a picture does
/// not show it, and so far that surfaces that touch are apart; farther where they still are not, as where a
/// superellipsoid is nearly flat.
const BESIDE: [f64; 2] = [1.0 / 1024.0, 1.0 / 16.0];

/// The four ways beside a ray, two by two: across it, and along no line that surfaces are likely to touch in.
const WAYS: [[f64; 2]; 2] = [[0.92, 0.39], [-0.39, 0.92]];

/// What an entry is made of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Grain {
    /// Its radius, or that of its smallest part; ∞ where all are endless.
    size: f64,
    /// Surfaces that are flat coincide, or meet in an edge.
    is_flat: bool,
}

impl Grain {
    /// What both are made of.
    fn and(self, other: Self) -> Self {
        Self { size: self.size.min(other.size), is_flat: self.is_flat && other.is_flat }
    }

    const NOTHING: Self = Self { size: f64::INFINITY, is_flat: true };
}

impl Geometry {
    pub(super) fn grain(&self, entry: &Entry) -> Grain {
        let round = |size| Grain { size, is_flat: false };
        match entry.solid {
            Solid::Sphere(sphere) => round(sphere.radius),
            Solid::Plane(_) => Grain::NOTHING,
            Solid::Box(i) => Grain { size: self.boxes[i as usize].1.sqrt(), is_flat: true },
            Solid::Ellipsoid(i) => {
                round(1.0 / norm(self.ellipsoids[i as usize].placement.local_from_world))
            }
            Solid::Placed(i) => {
                let placed = &self.placed[i as usize];
                round(placed.body.reach() / norm(placed.placement.local_from_world))
            }
            Solid::Whole(i) => {
                let leaves = self.wholes[i as usize].leaves.iter();
                leaves.map(|leaf| self.grain(leaf)).fold(Grain::NOTHING, Grain::and)
            }
        }
    }

    /// The hit, by the surface that is nearer all around. What crosses the ray at `limit` or before cannot be
    /// told from it.
    #[cold]
    #[inline(never)]
    pub(super) fn as_seen_beside(&self, ray: &Ray, hit: Hit, limit: f64) -> Hit {
        let Some(nearer) = self.nearer_around(ray, hit, limit) else { return hit };
        Hit { object: nearer.object, leaving: nearer.leaving, part: Met::UNKNOWN, ..hit }
    }

    fn nearer_around(&self, ray: &Ray, hit: Hit, limit: f64) -> Option<Hit> {
        let (mut grain, mut is_clear) = (Grain::NOTHING, false);
        let look = |place: usize, _: &mut Uncounted| {
            let entry = &self.entries[place];
            if self.first_crossing::<TIGHT>(entry, ray, limit).is_some() {
                grain = grain.and(self.grains[place]);
                is_clear |= entry.filters || entry.clear;
            }
            limit
        };
        self.search(ray, limit, &mut Each(Uncounted, look));
        if grain.is_flat || is_clear {
            return None;
        }
        // Surfaces that touch are told from one another, so far beside.
        let told = (32.0 * (hit.error + (limit - hit.t)) * grain.size).sqrt();
        let ways = BESIDE.map(|share| (share * grain.size).max(told));
        let seen = ways.into_iter().filter(|far| *far < grain.size);
        seen.map(|far| self.around(ray, &hit, [far, grain.size])).find_map(|seen| match seen {
            Around::Nothing => None,
            Around::Different => Some(None),
            Around::Same(nearer) => Some((nearer.object != hit.object).then_some(nearer)),
        })?
    }

    /// What rays so far beside meet at about the same distance, where what was hit goes on right behind that: beside
    /// the edge of a face that coincides with another it does not. Where one of them meets both, as on such a face,
    /// nothing is told.
    fn around(&self, ray: &Ray, hit: &Hit, [far, size]: [f64; 2]) -> Around {
        // What bends away is so near behind, and what has a tip unless it is a needle's.
        let behind = (size / 64.0).max(far / 4.0);
        let (aside, across) = ray.direction.any_orthonormal_pair();
        let mut seen = Around::Nothing;
        for [a, b] in WAYS {
            let step = (aside * a + across * b) * far;
            let [one, other] = [step, -step].map(|step| beside(ray, step));
            let [Some(first), Some(second)] = [&one, &other].map(|ray| self.raced(ray)) else {
                return Around::Different;
            };
            if first.contested || second.contested {
                return Around::Nothing;
            }
            let is_here = (0.5 * (first.t + second.t) - hit.t).abs() <= far;
            let is_same = |known: &Hit| known.object == first.object;
            let is_one = first.object == second.object && first.leaving == second.leaving;
            let goes_on = || {
                let both = [(&one, first.t), (&other, second.t)];
                both.into_iter().all(|(ray, t)| self.goes_on(ray, hit, t, behind))
            };
            seen = match seen {
                Around::Nothing if is_here && is_one && goes_on() => Around::Same(first),
                Around::Same(known) if is_here && is_one && is_same(&known) && goes_on() => seen,
                _ => return Around::Different,
            };
        }
        seen
    }

    /// Whether a ray beside meets what was hit no farther than `far` from `t`: behind or, of what others cut, before.
    fn goes_on(&self, beside: &Ray, hit: &Hit, t: f64, far: f64) -> bool {
        let is_near = |met: &Met| (met.t - t).abs() <= far;
        let meets = |leaf: &Entry| {
            leaf.object == hit.object && self.crossings(&leaf.solid, beside).iter().any(is_near)
        };
        let (limit, mut found) = (t + far, false);
        let look = |place: usize, _: &mut Uncounted| {
            let entry = &self.entries[place];
            found |= match entry.solid {
                Solid::Whole(i) => self.wholes[i as usize].leaves.iter().any(meets),
                Solid::Sphere(_)
                | Solid::Plane(_)
                | Solid::Box(_)
                | Solid::Ellipsoid(_)
                | Solid::Placed(_) => meets(entry),
            };
            if found { f64::NEG_INFINITY } else { limit }
        };
        self.search(beside, limit, &mut Each(Uncounted, look));
        found
    }
}

/// A ray beside another.
fn beside(ray: &Ray, step: Vector) -> Ray {
    Ray { origin: ray.origin + step, direction: ray.direction }
}

/// What rays around another see.
enum Around {
    /// Not one can tell.
    Nothing,
    /// One object, all that can tell.
    Same(Hit),
    Different,
}
