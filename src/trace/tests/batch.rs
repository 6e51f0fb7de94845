//! Rays see the same alone and in a batch, and a batch takes no more memory than it says.

use super::*;
use crate::math::wide::{ROW, Rays};

/// What the camera sees along the rays of a picture, each by itself or all together.
pub(super) fn seen(world: &World, plan: &Plan, together: bool) -> (Vec<Sight>, usize) {
    let geometry = Geometry::build(world);
    let tracer = Tracer::new(world, &geometry, plan, &Unwatched);
    let Frame { width, height, .. } = plan.frame;
    let lens = Lens::new(&world.camera, width, height);
    let places = (0..width * height).map(|i| (i % width, i / width));
    let points: Vec<_> = places.map(|place| lens.point(place, (0, 0), 1)).collect();
    let rays: Vec<_> = lens.rays(&points).into_iter().flatten().collect();
    let (mut walk, mut all) = (Walk::default(), Vec::new());
    for part in rays.chunks(if together { rays.len() } else { 1 }) {
        let mut rows = part.chunks(ROW);
        let fill = |rays: &mut Rays| *rays = Rays::new(rows.next().unwrap_or(&[]).iter());
        tracer.each_seen(&mut walk, fill, |seen| all.push(seen));
    }
    (all, walk.batch.room())
}

#[test]
fn a_ray_sees_the_same_alone_and_in_a_batch() {
    for world in [varied(), glass::heap()] {
        for alpha in [false, true] {
            let options = PlanOptions { alpha, ..options(24, 18, Antialias::Off) };
            let plan = plan(&world, &Origins::default(), &options);
            let (together, _) = seen(&world, &plan, true);
            assert_eq!(together.len(), 24 * 18);
            assert_eq!(together, seen(&world, &plan, false).0);
            assert_eq!(together.iter().any(|one| one.opacity < 1.0), alpha);
        }
    }
}

#[test]
fn far_down_one_ray_is_followed_at_a_time() {
    let deep = 5000;
    let world = corridor(&mirror(1.0, 1e-6)).world(|world| {
        (world.settings.max_trace_level, world.settings.adc_bailout) = (deep, 0.0);
    });
    let plan = plan(&world, &Origins::default(), &options(8, 8, Antialias::Off));
    let (alone, room) = (seen(&world, &plan, false), seen(&world, &plan, true));
    assert_eq!(alone.0, room.0);
    // All of them together would be 64 times as many.
    assert!(room.1 < 4 * deep as usize, "{} for {}", room.1, alone.1);
    assert!(alone.1 >= deep as usize);
}
