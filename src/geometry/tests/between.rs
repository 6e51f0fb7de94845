//! Shafts: what is not between a place and an area shadows no ray from the one to the other.

use super::*;
use crate::math::wide::{Rays, Row};

#[test]
fn a_shaft_has_all_that_shadows_its_rays() {
    let mut random = Random(17);
    let (mut shadowed, mut empty, mut few) = (0, 0, 0);
    for turn in 0..60 {
        let reach = random.size(-8.0, 8.0);
        // Few need no tree.
        let world = random_world(&mut random, [60, 5, 20][turn % 3], reach);
        let geometry = Geometry::build(&world);
        for _ in 0..tries_in(200) {
            let middle = random.point(reach);
            let size = reach * random.size(-4.0, 0.0);
            let half = random.point(size).abs();
            let to = Bounds { low: middle - half, high: middle + half };
            // Some places are on surfaces.
            let ray = random_ray(&mut random, &world, reach);
            let from = match geometry.nearest(&ray) {
                Some(hit) if random.below(2) == 0 => ray.at(hit.t - 2.0 * hit.error),
                _ => ray.origin,
            };
            let between = geometry.between(&Shaft { from, to }, &mut Work::default());
            let (mut rays, mut distances) = (Rays::NONE, [0.0; 16] as Row);
            for (number, distance) in distances.iter_mut().enumerate() {
                let share = random.point(1.0);
                let way = middle + half * share - from;
                *distance = way.length();
                let ray = Ray { origin: from, direction: way / *distance };
                if ray.direction.is_finite() {
                    rays.set(number, &ray);
                }
            }
            let found = between.map(|between| {
                (empty, few) = (empty + usize::from(between.is_empty()), few + 1);
                let all = (&rays, &distances);
                let mut guess = [Occluder::NONE, Occluder(0)][random.below(2)];
                geometry.occluded_between(&between, all, &mut guess, &mut Work::default())
            });
            let Some(found) = found else { continue };
            for (number, &distance) in distances.iter().enumerate() {
                if rays.mask >> number & 1 == 1 {
                    let ray = rays.at(number);
                    let is_shadowed = geometry.occluded(&ray, distance);
                    assert_eq!(found >> number & 1 == 1, is_shadowed, "{ray:?} of {to:?}");
                    shadowed += usize::from(is_shadowed);
                }
            }
        }
    }
    let seen = shadowed.min(10 * empty).min(10 * (few - empty));
    assert!(seen > tries() / 4, "{shadowed} {empty} {few}");
}
