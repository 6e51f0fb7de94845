//! Packets: rays that go together meet what each meets alone, whatever the instructions.

use super::*;
use crate::bvh::packet;
use crate::math::wide::{Instructions, ROW, Rays, Row};
use std::array::from_fn;

/// Compares rays in rows with each of them alone; returns how many meet something, and how many are shadowed.
fn assert_alike(world: &World, random: &mut Random, reach: f64, count: usize) -> [usize; 2] {
    let geometry = Geometry::build(world);
    let geometries = Instructions::all().map(|instructions| geometry.clone().with(instructions));
    let (mut met, mut shadowed) = (0, 0);
    for number in 0..count {
        let geometry = &geometries[number % geometries.len()];
        let instructions = geometry.instructions();
        let first = random_ray(random, world, reach);
        let spread = random.size(-6.0, 0.0);
        let rays: Vec<Ray> = (0..1 + random.below(packet::MOST))
            .map(|_| Ray {
                origin: first.origin + random.point(reach * spread * 0.1),
                direction: (first.direction + random.point(spread)).normalize(),
            })
            .collect();
        let mut together = [Hit::NOTHING; ROW];
        let row = Rays::new(rays.iter());
        geometry.nearest_together(&row, &mut together, &mut Work::default());
        for (ray, hit) in rays.iter().zip(together) {
            let alone = geometry.nearest(ray);
            assert_eq!(hit.found(), alone, "{instructions:?} {ray:?} of {rays:?}");
            met += usize::from(hit.found().is_some());
        }
        let distances: Row = from_fn(|_| [f64::INFINITY, reach][random.below(2)]);
        let mut guess = [Occluder::NONE, Occluder(0)][random.below(2)];
        let found = geometry.occluded_together(&row, &distances, &mut guess, &mut Work::default());
        for (number, (ray, distance)) in rays.iter().zip(distances).enumerate() {
            let is_shadowed = found >> number & 1 == 1;
            let alone = geometry.occluded(ray, distance);
            assert_eq!(is_shadowed, alone, "{instructions:?} {ray:?} of {rays:?}");
            shadowed += usize::from(is_shadowed);
        }
        assert_eq!(found & !row.mask, 0);
    }
    [met, shadowed]
}

#[test]
fn rays_that_go_together_meet_what_each_meets_alone() {
    let mut random = Random(11);
    let (mut met, mut shadowed) = (0, 0);
    for turn in 0..40 {
        let reach = random.size(-8.0, 8.0);
        // Few need no tree.
        let world = random_world(&mut random, [60, 5][turn % 2], reach);
        let found = assert_alike(&world, &mut random, reach, tries_in(400));
        (met, shadowed) = (met + found[0], shadowed + found[1]);
    }
    assert!(met.min(shadowed) > tries() / 20, "{met} {shadowed}");
}

#[test]
fn rays_that_go_together_meet_bodies_and_csg_solids_as_each_alone() {
    let mut random = Random(12);
    let (mut met, mut shadowed) = (0, 0);
    for turn in 0..60 {
        let reach = random.size(-4.0, 4.0);
        let world = every_body::crowd(&mut random, reach, [20, 4][turn % 2]);
        let found = assert_alike(&world, &mut random, reach, tries_in(200));
        (met, shadowed) = (met + found[0], shadowed + found[1]);
    }
    assert!(met.min(shadowed) > tries_in(10), "{met} {shadowed}");
}
