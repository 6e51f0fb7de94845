//! What a film is: independent of threads, tiles and pruning.

use std::collections::BTreeSet;
use std::sync::atomic::{AtomicUsize, Ordering};

use super::*;
use crate::film::Pixel;
use crate::math::wide::Instructions;
use crate::world::Focus;

#[test]
fn the_film_has_the_same_bits_for_any_number_of_threads() {
    let world = varied();
    let options = options(70, 50, Antialias::default());
    let plan = plan(&world, &Origins::default(), &options);
    let alone = traced_by(&world, &plan);
    let counts: BTreeSet<u32> = alone.film.samples().collect();
    assert!(counts.len() > 3 && counts.iter().all(|count| [1, 4, 8, 16, 32, 64].contains(count)));
    let clear = Plan { alpha: true, ..plan.clone() };
    for (plan, alone) in [(&plan, &alone), (&clear, &traced_by(&world, &clear))] {
        for threads in [2, 3, 7] {
            let shared = trace(&world, plan, &TraceOptions::on_threads(threads), &Unwatched);
            assert_eq!(shared, *alone);
        }
    }
}

#[test]
fn the_film_has_the_same_bits_whatever_the_instructions() {
    let world = varied();
    let options = options(70, 50, Antialias::default());
    let plan = plan(&world, &Origins::default(), &options);
    let alone = traced_by(&world, &plan);
    for instructions in Instructions::all() {
        let geometry = geometry(&world, &plan, &TraceOptions::default()).with(instructions);
        let traced = trace_in(&world, &geometry, &plan, &TraceOptions::default(), &Unwatched);
        assert_eq!(traced.film, alone.film, "{instructions:?}");
    }
}

#[test]
fn blurred_pixels_have_the_same_bits_for_any_threads_and_tiles_and_in_any_region() {
    let mut world = varied();
    let focus = Focus {
        radius: 0.3,
        distance: 4.0,
        least: 4,
        most: 30,
        confidence: 0.9,
        variance: 1.0 / 512.0,
        bokeh: None,
    };
    world.camera.focus = Some(focus);
    let mut options = options(36, 25, Antialias::Off);
    let traced = |options: &PlanOptions, threads, tile_side| {
        let plan = plan(&world, &Origins::default(), options);
        let trace_options = TraceOptions { tile_side, ..TraceOptions::on_threads(threads) };
        trace(&world, &plan, &trace_options, &Unwatched)
    };
    let first = traced(&options, 1, None);
    let has = |is: fn(u32) -> bool| first.film.samples().any(is);
    assert!(has(|samples| samples < 30) && has(|samples| samples == 30));
    for (threads, tile_side) in [(2, None), (5, None), (1, Some(1)), (2, Some(7)), (5, Some(64))] {
        assert_eq!(traced(&options, threads, tile_side), first, "{threads} {tile_side:?}");
    }
    let region = Region { x: 5, y: 9, width: 20, height: 3 };
    options.frame.region = region;
    assert_eq!(traced(&options, 2, Some(3)).film, first.film.crop(region));
}

#[test]
fn a_region_is_an_exact_crop_of_the_whole() {
    let world = varied();
    let mut options = options(70, 50, Antialias::default());
    let whole = traced_by(&world, &plan(&world, &Origins::default(), &options)).film;
    for (x, y, width, height) in [(0, 0, 33, 50), (20, 10, 35, 33), (69, 49, 1, 1), (31, 0, 2, 9)] {
        let region = Region { x, y, width, height };
        options.frame.region = region;
        let part = traced_by(&world, &plan(&world, &Origins::default(), &options)).film;
        assert_eq!(part, whole.clone().crop(region));
    }
}

#[test]
fn a_mirrored_world_makes_a_mirrored_film() {
    let world = varied();
    let mut mirrored = world.clone();
    mirrored.spheres.iter_mut().for_each(|s| s.centre.x = -s.centre.x);
    mirrored.boxes.iter_mut().for_each(|b| b.centre.x = -b.centre.x);
    for light in &mut mirrored.lights {
        if let LightKind::Point { position } = &mut light.kind {
            position.x = -position.x;
        }
    }
    // A checker is not mirrored by a mirrored point on the lattice; a colour is.
    let plain = |mut world: World| {
        world.textures[0] = Texture::Plain(matte(0.4, 0.5, 0.6));
        traced(&world, 61, 40, Antialias::Off).film.pixels
    };
    let (left, mut right) = (plain(world), plain(mirrored));
    right.chunks_mut(61).for_each(|row| row.reverse());
    assert_eq!(left, right);
}

#[test]
fn the_pruned_stages_and_all_of_them_give_the_same_bits() {
    let all = || crate::plan::Stage::ALL.to_vec();
    let full_plan = |plan: &Plan| Plan { stages: all(), ..plan.clone() };
    use Effect::{Diffuse, Highlights, Reflection, Shadows};
    let without_reflection =
        |w: &mut World| finishes(w).for_each(|finish| finish.reflection = None);
    type Change<'a> = &'a dyn Fn(&mut World);
    let changes: [(&[Effect], Change); 5] = [
        (&[Shadows], &|w| w.lights.iter_mut().for_each(|light| light.casts_shadows = false)),
        (&[Reflection], &without_reflection),
        (&[Reflection], &|w| w.settings.max_trace_level = 1),
        (&[Diffuse, Highlights, Shadows], &|w| w.lights.clear()),
        (&[Diffuse, Highlights, Shadows, Reflection], &|w| {
            w.lights.clear();
            without_reflection(w);
        }),
    ];
    for (pruned_effects, change) in changes {
        let mut world = varied();
        change(&mut world);
        let pruned = plan(&world, &Origins::default(), &options(40, 30, Antialias::default()));
        let called = [Diffuse, Highlights, Shadows, Reflection];
        let missing: Vec<_> = called.into_iter().filter(|&e| !pruned.simulates(e)).collect();
        assert_eq!(missing, pruned_effects);
        let film = traced_by(&world, &pruned).film;
        assert_eq!(film, traced_by(&world, &full_plan(&pruned)).film);
    }
}

#[test]
fn what_nothing_calls_for_is_counted_zero() {
    let rays = |change: &dyn Fn(&mut World)| {
        let mut world = varied();
        change(&mut world);
        traced(&world, 40, 30, Antialias::Off).counters
    };
    let all = rays(&|_| ());
    assert!(all.camera == 1200 && all.shadow > 0 && all.reflection > 0);
    assert_eq!(rays(&|w| w.lights.clear()).shadow, 0);
    assert_eq!(rays(&|w| w.lights.iter_mut().for_each(|l| l.casts_shadows = false)).shadow, 0);
    assert_eq!(rays(&|w| w.objects.iter_mut().for_each(|o| o.casts_shadow = false)).shadow, 0);
    let unanswering = |w: &mut World| {
        finishes(w).for_each(|finish| *finish = Finish { ..NO_FINISH });
    };
    assert_eq!(rays(&unanswering), Counters { camera: 1200, ..rays(&unanswering) });
    assert_eq!(rays(&unanswering).shadow + rays(&unanswering).reflection, 0);
    assert_eq!(rays(&|w| w.settings.max_trace_level = 1).reflection, 0);
}

#[test]
fn grid_antialiasing_takes_the_mean_of_all_samples() {
    // A vertical edge just right of the picture's middle: black left of it, 8 right of it.
    let world = Built::default().cube([2.01, 0.0, -4.0], 2.0, glowing(8.0)).world(|world| {
        world.camera.kind = CameraKind::Orthographic;
        world.camera.right = Vector::X;
        world.camera.forward = -Vector::Z;
    });
    let film = traced(&world, 1, 1, Antialias::Grid(4)).film;
    assert_eq!(film.pixels, [Pixel::new(Rgb::gray(4.0), 16)]);
    // The middle pixel straddles the edge; its centre is black and its right neighbour is not.
    let film = traced(&world, 5, 1, Antialias::Adaptive { threshold: 0.1, grid: 2 }).film;
    assert!(film.samples().eq([1, 4, 4, 4, 4]), "{:?}", film.pixels);
    // One of its first samples lies right of the edge.
    assert_eq!(film.radiance(2), Rgb::gray(2.0));
}

#[test]
fn a_stopped_film_knows_which_pixels_were_reached() {
    struct Impatient(AtomicUsize);
    impl Watch for Impatient {
        fn progress(&self, done: usize, total: usize) {
            assert!(done <= total);
            self.0.fetch_max(done, Ordering::Relaxed);
        }
        fn should_stop(&self) -> bool {
            self.0.load(Ordering::Relaxed) >= 2
        }
    }
    let world = varied();
    let plan = plan(&world, &Origins::default(), &options(100, 40, Antialias::default()));
    let watch = Impatient(AtomicUsize::new(0));
    let result = trace(&world, &plan, &TraceOptions::on_threads(1), &watch);
    assert!(!result.complete);
    let whole = traced(&world, 100, 40, Antialias::Off).film;
    assert_eq!(result.film.samples().filter(|&n| n > 0).count(), 2 * 32 * 32);
    for (i, samples) in result.film.samples().enumerate() {
        let expected = if samples == 0 { Rgb::BLACK } else { whole.radiance(i) };
        assert_eq!(result.film.radiance(i), expected);
    }
}
