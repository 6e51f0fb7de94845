//! Single pixels are those of the film.

use super::*;
use crate::geometry::Work;

/// Every pixel of a region, in no particular order.
fn scattered(region: Region) -> Vec<(u32, u32)> {
    let count = region.width * region.height;
    let place = |i: u32| (i * 37) % count;
    (0..count)
        .map(place)
        .map(|i| (region.x + i % region.width, region.y + i / region.width))
        .collect()
}

fn some(
    plan: &Plan,
    world: &World,
    list: &[(u32, u32)],
    sampling: Sampling,
) -> (Vec<Sight>, Counters) {
    let (geometry, aims) = (Geometry::build(world), aims(list, sampling));
    let by = |threads| {
        let threads = TraceOptions::on_threads(threads);
        pixels(world, &geometry, plan, &aims, &threads, &Unwatched)
    };
    let (seen, counters) = by(1);
    assert_eq!((&seen, counters), (&by(3).0, by(3).1), "threads");
    (seen.into_iter().map(|seen| seen.expect("not stopped").mean).collect(), counters)
}

#[test]
fn a_planned_pixel_has_the_films_bits_whatever_the_antialiasing() {
    let world = varied();
    for (gamma, antialias, alpha) in [
        (Gamma::LINEAR, Antialias::Off, false),
        (Gamma::Srgb, Antialias::Grid(3), true),
        (Gamma::LINEAR, Antialias::default(), true),
        (Gamma::Power(2.2), Antialias::Adaptive { threshold: 0.01, grid: 2 }, false),
    ] {
        let mut world = world.clone();
        world.settings.assumed_gamma = gamma;
        let mut options = PlanOptions { alpha, ..options(43, 31, antialias) };
        for region in [options.frame.region, Region { x: 5, y: 0, width: 20, height: 31 }] {
            options.frame.region = region;
            let plan = plan(&world, &Origins::default(), &options);
            let traced = traced_by(&world, &plan);
            let list = scattered(region);
            let (single, counters) = some(&plan, &world, &list, Sampling::Planned);
            for (&(x, y), seen) in list.iter().zip(single) {
                assert_eq!(seen, traced.film.pixels[traced.film.index(x, y)].into(), "{x} {y}");
            }
            let border = matches!(antialias, Antialias::Adaptive { .. }) && region.x > 0;
            // What last shadowed a ray is another where the pixels come in another order.
            let sent = |counters| Counters {
                work: Work::default(),
                evaluations: Evaluations::default(),
                ..counters
            };
            assert!(border || sent(counters) == sent(traced.counters), "{antialias:?}");
        }
    }
}

#[test]
fn jittered_samples_agree_with_a_fine_grid_and_differ_by_their_seed() {
    let world = varied();
    let plan = plan(&world, &Origins::default(), &options(16, 12, Antialias::Grid(24)));
    let list = scattered(plan.frame.region);
    let (fine, _) = some(&plan, &world, &list, Sampling::Planned);
    let jittered = |seed| some(&plan, &world, &list, Sampling::Jittered { side: 12, seed });
    let ((one, counters), (other, _)) = (jittered(1), jittered(2));
    assert_ne!(one, other);
    assert_eq!(counters.camera, list.len() as u64 * 144);
    let rms = |a: &[Sight], b: &[Sight]| {
        let off = |(a, b): (&Sight, &Sight)| (a.radiance.green - b.radiance.green).powi(2);
        let sum: f64 = a.iter().zip(b).map(off).sum();
        (sum / list.len() as f64).sqrt()
    };
    let (noise, bias) = (rms(&one, &other), rms(&one, &fine));
    assert!(noise < 0.02 && bias < noise, "{noise} {bias}");
}
