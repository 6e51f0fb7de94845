//! Packets: rays that go together meet what each meets alone, whatever the instructions.

use super::*;
use crate::bvh::packet;
use crate::math::wide::{Instructions, Rays, Row};
use std::array::from_fn;

#[test]
fn rays_that_go_together_meet_what_each_meets_alone() {
    let mut random = Random(11);
    let (mut met, mut shadowed) = (0, 0);
    for turn in 0..40 {
        let reach = random.size(-8.0, 8.0);
        // Few need no tree.
        let world = random_world(&mut random, [60, 5][turn % 2], reach);
        let geometry = Geometry::build(&world);
        let by_instructions = Instructions::all();
        for number in 0..tries_in(400) {
            let instructions = by_instructions[number % by_instructions.len()];
            let geometry = geometry.clone().with(instructions);
            let first = random_ray(&mut random, &world, reach);
            let spread = random.size(-6.0, 0.0);
            let rays: Vec<Ray> = (0..1 + random.below(packet::MOST))
                .map(|_| Ray {
                    origin: first.origin + random.point(reach * spread * 0.1),
                    direction: (first.direction + random.point(spread)).normalize(),
                })
                .collect();
            let mut together = Vec::new();
            let row = Rays::new(rays.iter());
            geometry.nearest_together(&row, &mut together, &mut Work::default());
            for (ray, hit) in rays.iter().zip(together) {
                assert_eq!(
                    hit.found(),
                    geometry.nearest(ray),
                    "{instructions:?} {ray:?} of {rays:?}"
                );
                met += usize::from(hit.found().is_some());
            }
            let distances: Row = from_fn(|_| [f64::INFINITY, reach][random.below(2)]);
            let mut guess = [Occluder::NONE, Occluder(0)][random.below(2)];
            let found =
                geometry.occluded_together(&row, &distances, &mut guess, &mut Work::default());
            for (number, (ray, distance)) in rays.iter().zip(distances).enumerate() {
                let is_shadowed = found >> number & 1 == 1;
                assert_eq!(
                    is_shadowed,
                    geometry.occluded(ray, distance),
                    "{instructions:?} {ray:?}"
                );
                shadowed += usize::from(is_shadowed);
            }
            assert_eq!(found & !row.mask, 0);
        }
    }
    assert!(met.min(shadowed) > tries() / 20, "{met} {shadowed}");
}
