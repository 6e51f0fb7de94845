//! Tests of the tree: boxes hold what they stand for.

use super::packet::PacketSeeker;
use super::*;
use crate::math::random::{Random, tries};
use crate::math::wide::{Rays, Row};
use std::array::from_fn;

#[test]
fn the_boxes_of_a_tree_hold_the_boxes_they_stand_for() {
    let mut random = Random(7);
    for _ in 0..tries() {
        let far = [0.0, random.size(-290.0, 290.0)][random.below(2)];
        let size = [far * random.size(-16.0, 0.0), random.size(-290.0, 290.0)][random.below(2)];
        let origin = random.point(far);
        let scale = 0.5 * crate::math::reciprocal_power_of_two(size);
        let near = |random: &mut Random| {
            let v = random.point(size);
            // On the origin of the tree, too, and beside it.
            Vector::from_array(v.to_array().map(|c| c * [0.0, 1.0, 1e-17][random.below(3)]))
        };
        let (a, b) = (origin + near(&mut random), origin + near(&mut random));
        let bounds = Bounds { low: a.min(b), high: a.max(b) };
        let [low, high] = Space { origin, scale }.outward(&bounds);
        for axis in 0..3 {
            // What is left of place / scale + origin − p: two sums, exactly (Knuth).
            let above = |place: f32, p: f64| {
                let (a, b) = (f64::from(place) / scale, origin[axis]);
                let sum = a + b;
                let part = sum - a;
                (sum - p) + ((a - (sum - part)) + (b - part))
            };
            assert!(above(low[axis], bounds.low[axis]) <= 0.0, "{bounds:?} {origin} {scale:e}");
            assert!(above(high[axis], bounds.high[axis]) >= 0.0, "{bounds:?} {origin} {scale:e}");
        }
    }
}

/// Random boxes around the origin, of sizes that differ.
fn boxes(random: &mut Random, count: usize, size: f64) -> Vec<Bounds> {
    let around = |random: &mut Random| {
        let small = size * random.size(-3.0, -0.5);
        let (centre, half) = (random.point(size), random.point(small));
        Bounds { low: centre - half.abs(), high: centre + half.abs() }
    };
    (0..count).map(|_| around(random)).collect()
}

/// Returns whether a ray passes a box within `slack`, at `limit` or before.
fn is_met(Bounds { low, high }: &Bounds, ray: &Ray, slack: f64, limit: f64) -> bool {
    let [a, b] = [*low - slack, *high + slack].map(|side| (side - ray.origin) / ray.direction);
    let (enter, leave) = (a.min(b).max_element(), a.max(b).min_element());
    enter.max(0.0) <= leave.min(limit)
}

#[test]
fn every_box_that_a_ray_meets_is_shown() {
    let mut random = Random(8);
    for _ in 0..40 {
        let size = random.size(-30.0, 30.0);
        let count = 1 + random.below(200);
        let all = boxes(&mut random, count, size);
        let (tree, order) = Tree::build(&all);
        for _ in 0..tries() / 100 {
            let far = size * random.size(-1.0, 2.0);
            let origin = random.point(far);
            let ray = Ray { origin, direction: random.direction().get() };
            let slack = size * [0.0, 1e-6, 0.1][random.below(3)];
            let limit = [f64::INFINITY, size][random.below(2)];
            let mut shown = vec![false; count];
            tree.visit(&ray, slack, limit, &mut |run: Range<usize>, limit| {
                order[run].iter().for_each(|&piece| shown[piece as usize] = true);
                limit
            });
            for (bounds, shown) in all.iter().zip(shown) {
                assert!(shown || !is_met(bounds, &ray, slack, limit), "{bounds:?} {ray:?}");
            }
        }
    }
}

#[test]
fn the_greatest_extent_is_that_of_all_pieces() {
    let mut random = Random(9);
    for _ in 0..tries() / 10 {
        let size = random.size(-30.0, 30.0);
        let count = 1 + random.below(60);
        let all = boxes(&mut random, count, size);
        let (tree, order) = Tree::build(&all);
        let along = random.direction().get();
        let extent = |bounds: &Bounds| along.dot((bounds.low + bounds.high) * 0.5);
        let greatest = tree.greatest(along, |run| {
            order[run].iter().map(|&i| extent(&all[i as usize])).fold(f64::NEG_INFINITY, f64::max)
        });
        assert_eq!(greatest, all.iter().map(extent).fold(f64::NEG_INFINITY, f64::max));
    }
}

/// Shows which pieces are shown for which ray.
struct Noted<'a> {
    order: &'a [u32],
    shown: Vec<Vec<bool>>,
    limits: Row,
}

impl PacketSeeker for Noted<'_> {
    fn leaf(&mut self, mask: u32, pieces: Range<usize>) {
        for (_, shown) in self.shown.iter_mut().enumerate().filter(|(ray, _)| mask >> ray & 1 == 1)
        {
            self.order[pieces.clone()].iter().for_each(|&piece| shown[piece as usize] = true);
        }
    }

    fn limits(&self) -> &Row {
        &self.limits
    }

    fn node(&mut self) {}
}

#[test]
fn every_box_that_a_ray_of_a_packet_meets_is_shown_for_it() {
    let mut random = Random(10);
    let mut common = 0;
    for _ in 0..40 {
        let size = random.size(-30.0, 30.0);
        let count = 1 + random.below(200);
        let all = boxes(&mut random, count, size);
        let (tree, order) = Tree::build(&all);
        for _ in 0..tries() / 100 {
            let far = size * random.size(-1.0, 2.0);
            let origin = random.point(far);
            let spread = random.size(-9.0, 0.5);
            let main = random.direction().get();
            let rays: Vec<Ray> = (0..1 + random.below(packet::MOST))
                .map(|_| Ray {
                    origin: origin + random.point(size * spread),
                    direction: (main + random.point(spread)).normalize(),
                })
                .collect();
            let limits: Row = from_fn(|_| [f64::INFINITY, size][random.below(2)]);
            let shown = vec![vec![false; count]; rays.len()];
            let mut noted = Noted { order: &order, shown, limits };
            tree.visit_together(&Rays::new(rays.iter()), 0.0, &mut noted);
            for ((ray, limit), shown) in rays.iter().zip(limits).zip(noted.shown) {
                for (bounds, shown) in all.iter().zip(shown) {
                    let met = is_met(bounds, ray, 0.0, limit);
                    assert!(shown || !met, "{bounds:?} {ray:?} of {}", rays.len());
                    common += usize::from(met && rays.len() > 3);
                }
            }
        }
    }
    assert!(common > tries() / 20, "{common}");
}
