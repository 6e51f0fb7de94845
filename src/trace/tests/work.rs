//! What finding surfaces took: exact where it can be told by hand, the same whoever shares it out.

use super::*;
use crate::geometry::Work;

/// As it is traced when the work is counted.
fn counted(world: &World, threads: usize, options: PlanOptions) -> Counters {
    let plan = plan(world, &Origins::default(), &options);
    let options = TraceOptions { count_work: true, ..TraceOptions::on_threads(threads) };
    let counted = trace(world, &plan, &options, &Unwatched);
    let plain = traced_by(world, &plan);
    assert_eq!(counted.film, plain.film);
    assert_eq!(
        plain.counters,
        Counters { work: Work::default(), evaluations: Evaluations::default(), ..counted.counters }
    );
    counted.counters
}

/// A row of balls over a floor, under two lamps; from eight balls on there is a tree.
fn row(balls: u32) -> World {
    let floor = Built::default().plane(UnitVector::Y, -1.0, matte(0.9, 0.9, 0.9));
    let place = |i: u32| [f64::from(i) * 0.7 - 4.0, 0.2 * f64::from(i % 3), -7.0];
    let all = (0..balls).fold(floor, |all, i| all.sphere(place(i), 0.3, mirror(0.5, 0.1)));
    all.light([3.0, 5.0, 0.0], 0.8).light([-4.0, 2.0, -1.0], 0.5).world(|_| ())
}

#[test]
fn one_sphere_and_one_plane_are_solved_for_just_the_rays_that_may_meet_them() {
    let (centre, radius) = (Vector::new(0.5, 0.3, -5.0), 1.0);
    let world = Built::default()
        .sphere(centre.to_array(), radius, glowing(1.0))
        .plane(UnitVector::Y, -1.0, glowing(0.5))
        .world(|_| ());
    let (width, height) = (41, 30);
    let lens = Lens::new(&world.camera, width, height);
    let mut solves = 0;
    for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
        let point = lens.point((x, y), (0, 0), 1);
        let ray = lens.rays(&[point])[0].expect("a ray through each point");
        let way = centre - ray.origin;
        let beside = way - ray.direction * way.dot(ray.direction);
        // The camera is above the plane and before the sphere.
        solves += u64::from(ray.direction.y < 0.0) + u64::from(beside.length() <= radius);
    }
    assert!(solves > 700, "{solves}");
    let counters = counted(&world, 1, options(width, height, Antialias::Off));
    assert_eq!(counters.work, Work { box_visits: 0, root_solves: solves, solving: solves });
    // A lamp above shadows nothing but the plane below the sphere: a shadow ray tries what it meets.
    let mut lit = world;
    lit.textures[1] = Texture::Plain(matte(1.0, 1.0, 1.0));
    lit.lights = Built::default().light([0.0, 50.0, 0.0], 1.0).0.lights;
    let counters = counted(&lit, 1, options(width, height, Antialias::Off));
    assert!(counters.shadow > 0 && counters.work.root_solves > solves);
    assert!(counters.work.root_solves <= solves + counters.shadow, "{counters:?}");
}

#[test]
fn no_box_is_visited_without_a_tree() {
    let small = options(48, 36, Antialias::Off);
    let work = |balls| counted(&row(balls), 1, small).work;
    assert_eq!(work(7).box_visits, 0);
    assert!(work(7).root_solves > 48 * 36 / 2);
    assert!(work(8).box_visits > 48 * 36 / 8, "each packet looks at the root");
    assert_eq!(counted(&World::default(), 1, small).work, Work::default());
}

#[test]
fn a_tree_spares_most_solves() {
    let balls = 200;
    let counters = counted(&row(balls), 1, options(48, 36, Antialias::Off));
    assert!(counters.work.root_solves < counters.rays() * u64::from(balls) / 20, "{counters:?}");
}

#[test]
fn the_work_does_not_depend_on_the_threads() {
    for (balls, antialias) in [(5, Antialias::default()), (40, Antialias::Grid(2))] {
        let world = row(balls);
        let options = options(200, 120, antialias);
        let alone = counted(&world, 1, options);
        for threads in [2, 3, 8] {
            assert_eq!(counted(&world, threads, options), alone, "{threads} threads");
        }
    }
}
