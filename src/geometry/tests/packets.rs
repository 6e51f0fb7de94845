//! Packets: rays that go together meet what each meets alone.

use super::*;
use crate::bvh::packet;

#[test]
fn rays_that_go_together_meet_what_each_meets_alone() {
    let mut random = Random(11);
    let mut met = 0;
    for _ in 0..40 {
        let reach = random.size(-8.0, 8.0);
        let world = random_world(&mut random, 60, reach);
        let geometry = Geometry::build(&world);
        for _ in 0..tries_in(400) {
            let first = random_ray(&mut random, &world, reach);
            let spread = random.size(-6.0, 0.0);
            let rays: Vec<Ray> = (0..1 + random.below(packet::MOST))
                .map(|_| Ray {
                    origin: first.origin + random.point(reach * spread * 0.1),
                    direction: (first.direction + random.point(spread)).normalize(),
                })
                .collect();
            let mut together = Vec::new();
            let rays: Vec<&Ray> = rays.iter().collect();
            geometry.nearest_together(&rays, &mut together, &mut Work::default());
            for (ray, hit) in rays.iter().zip(together) {
                assert_eq!(hit.found(), geometry.nearest(ray), "{ray:?} of {rays:?}");
                met += usize::from(hit.found().is_some());
            }
        }
    }
    assert!(met > tries() / 20, "{met}");
}
