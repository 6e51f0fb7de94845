//! Nearest hits and obstructions in a World: rows 63, 67 and 70.
//!
//! That the tree finds what trying every object finds is tested beside it (rows 65 and 66).

use std::sync::OnceLock;
use std::time::Duration;

use lucarne::geometry::Geometry;
use lucarne::math::{UnitVector, Vector};
use lucarne::shape::{Chord, Ray, Shape, Sphere};
use lucarne::world::{Object, World};

use super::held::compiled;
use crate::dice::{Dice, rays};

/// A World of spheres.
fn of_spheres(spheres: Vec<Sphere>) -> World {
    static ONE: OnceLock<World> = OnceLock::new();
    let one = ONE.get_or_init(|| compiled("sphere { 0, 1 }").0);
    let object = |i| Object { shape: Shape::Sphere(i), ..one.objects[0] };
    let objects = (0..spheres.len() as u32).map(object).collect();
    World { objects, spheres, ..one.clone() }
}

/// The nearest hit, and whether something is in the way, are what the sphere's own `chord` says,
/// alone and among others far behind.
pub fn assert_all_agree(sphere: &Sphere, ray: &Ray, chord: Option<&Chord>) {
    let first = chord.and_then(|chord| {
        [chord.enter, chord.leave].into_iter().find(|crossing| crossing.is_ahead())
    });
    let behind = ray.origin - ray.direction * (1e3 * sphere.radius);
    let others = (0..9).map(|i| Sphere {
        centre: behind + Vector::X * (sphere.radius * 3.0 * f64::from(i)),
        radius: sphere.radius,
    });
    for spheres in [vec![*sphere], std::iter::once(*sphere).chain(others).collect()] {
        let geometry = Geometry::build(&of_spheres(spheres));
        let hit = geometry.nearest(ray).map(|hit| hit.t);
        assert_eq!(hit, first.map(|crossing| crossing.t), "{sphere:?} {ray:?}");
        assert_eq!(geometry.occluded(ray, f64::INFINITY), first.is_some(), "{sphere:?} {ray:?}");
    }
}

/// The time that this thread has had of a processor, whatever else runs.
#[cfg(target_os = "linux")]
pub fn processor_time() -> Duration {
    use nix::sys::resource::{UsageWho, getrusage};
    let usage = getrusage(UsageWho::RUSAGE_THREAD).expect("a thread");
    let micros = |time: nix::sys::time::TimeVal| {
        time.tv_sec().unsigned_abs() * 1_000_000 + time.tv_usec().unsigned_abs()
    };
    Duration::from_micros(micros(usage.user_time()) + micros(usage.system_time()))
}

/// Elsewhere the wall's clock will do.
#[cfg(not(target_os = "linux"))]
pub fn processor_time() -> Duration {
    static START: OnceLock<std::time::Instant> = OnceLock::new();
    START.get_or_init(std::time::Instant::now).elapsed()
}

#[test]
fn row_63_a_million_spheres_in_one_place_are_one_and_are_built_in_no_time_on_a_small_stack() {
    let sphere = Sphere { centre: Vector::new(1.0, 2.0, 3.0), radius: 0.5 };
    let try_all = move || {
        let mut dice = Dice(63);
        for count in [10_000, 100_000, 1_000_000] {
            let world = of_spheres(vec![sphere; count]);
            let start = processor_time();
            let geometry = Geometry::build(&world);
            let time = processor_time() - start;
            assert!(time.as_secs_f64() < 2.0, "{count} spheres: built in {time:?}");
            for _ in 0..20 {
                let origin = sphere.centre + dice.direction() * 5.0;
                let target = sphere.centre + dice.direction() * 0.4;
                let direction = UnitVector::from_direction(target - origin).expect("apart").get();
                let ray = Ray { origin, direction };
                let hit = geometry.nearest(&ray).expect("aimed at it");
                assert_eq!((hit.object, Some(hit.t)), (0, sphere.chord(&ray).map(|c| c.enter.t)));
                assert!(geometry.occluded(&ray, f64::INFINITY));
            }
        }
    };
    let small = std::thread::Builder::new().stack_size(256 * 1024);
    small.spawn(try_all).expect("a thread").join().expect("as on a large stack");
}

#[test]
fn rows_67_and_70_equal_crossings_are_won_by_the_first_and_any_hit_is_a_first_hit() {
    let mut dice = Dice(70);
    let (mut ties, mut placed) = (0, 0);
    for _ in 0..rays() / 100 {
        // Spheres that touch or share a point, by whole numbers, and some of them twice.
        let spheres: Vec<Sphere> = (0..12)
            .map(|_| {
                let [x, y, z] = [0; 3].map(|_| dice.below(5) as f64 - 2.0);
                Sphere { centre: Vector::new(x, y, z), radius: dice.one_of(&[0.5, 1.0, 2.0]) }
            })
            .collect();
        let mut order: Vec<usize> = (0..spheres.len()).collect();
        for last in (1..order.len()).rev() {
            order.swap(last, dice.below(last + 1));
        }
        let shuffled = order.iter().map(|&i| spheres[i]).collect();
        let (one, other) =
            (Geometry::build(&of_spheres(spheres.clone())), Geometry::build(&of_spheres(shuffled)));
        for _ in 0..100 {
            let origin = Vector::from_array([0; 3].map(|_| dice.below(13) as f64 - 6.0));
            let direction = dice.structured(&[-1.0, -0.0, 0.0, 1.0, 0.5]);
            let ray = Ray { origin, direction };
            let (here, there) = (one.nearest(&ray), other.nearest(&ray));
            let (Some(here), Some(there)) = (here, there) else {
                assert_eq!(here.is_some(), there.is_some(), "{ray:?}");
                assert!(!one.occluded(&ray, f64::INFINITY), "{ray:?}");
                continue;
            };
            // Each is the first declared of all that are as near as can be told.
            let first = |number: usize| {
                let chord = spheres[number].chord(&ray)?;
                [chord.enter, chord.leave].into_iter().find(|crossing| crossing.is_ahead())
            };
            let crossings = || (0..spheres.len()).filter_map(|i| Some((i, first(i)?)));
            let limit = crossings().map(|(_, c)| c.t + 2.0 * c.error).fold(f64::INFINITY, f64::min);
            let near: Vec<usize> =
                crossings().filter(|(_, c)| c.t <= limit).map(|(i, _)| i).collect();
            ties += usize::from(near.len() > 1);
            let won = [here.object as usize, order[there.object as usize]];
            let first_there = near.iter().min_by_key(|i| order.iter().position(|o| o == *i));
            let by_order = [near.iter().min(), first_there];
            // Where they only touch, one is nearer all around: then the order is no matter.
            let by_place = won[0] == won[1] && near.contains(&won[0]);
            assert!(by_place || [Some(&won[0]), Some(&won[1])] == by_order, "{ray:?}");
            placed += usize::from([Some(&won[0]), Some(&won[1])] != by_order);
            // Something is in the way from just beyond the nearest on, and not before.
            let least = crossings().map(|(_, c)| c.t + c.error).fold(f64::INFINITY, f64::min);
            assert!(one.occluded(&ray, least.next_up()) && other.occluded(&ray, least.next_up()));
            assert!(!one.occluded(&ray, least) && !other.occluded(&ray, least), "{ray:?}");
        }
    }
    assert!(ties > rays() / 1000 && placed < ties / 2, "{ties} {placed}");
}
