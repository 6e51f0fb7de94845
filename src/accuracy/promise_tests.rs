//! Promises, held against what every pixel says: of errors on scenes that people look at, and of times.

use super::tests::{BALLS, Ticking, Truth, asked, compiled};
use super::*;
use crate::math::random::long;
use crate::trace::Unwatched;

/// Neither watches nor hears.
const NOBODY: (&dyn Watch, &dyn Fn(Step)) = (&Unwatched, &|_| ());

/// Of the gallery and the examples: mirrors, glass, beams, patterns, crowds, what crossings are stepped to.
const SCENES: [(&str, &str); 20] = [
    ("gallery/first", include_str!("../../scenes/gallery/first.scene")),
    ("gallery/city", include_str!("../../scenes/gallery/city.scene")),
    ("gallery/sponge", include_str!("../../scenes/gallery/sponge.scene")),
    ("gallery/sunflower", include_str!("../../scenes/gallery/sunflower.scene")),
    ("gallery/sphereflake", include_str!("../../scenes/gallery/sphereflake.scene")),
    ("gallery/chess", include_str!("../../scenes/gallery/chess.scene")),
    ("finishes/reflection", include_str!("../../scenes/finishes/reflection.scene")),
    ("finishes/phong", include_str!("../../scenes/finishes/phong.scene")),
    ("shapes/blob", include_str!("../../scenes/shapes/blob.scene")),
    ("lights/spotlight", include_str!("../../scenes/lights/spotlight.scene")),
    ("lights/fade_distance", include_str!("../../scenes/lights/fade_distance.scene")),
    ("csg/merge", include_str!("../../scenes/csg/merge.scene")),
    ("textures/gradient", include_str!("../../scenes/textures/gradient.scene")),
    ("textures/transmit", include_str!("../../scenes/textures/transmit.scene")),
    ("textures/color_map", include_str!("../../scenes/textures/color_map.scene")),
    ("shapes/torus", include_str!("../../scenes/shapes/torus.scene")),
    ("csg/inverse", include_str!("../../scenes/csg/inverse.scene")),
    ("atmosphere/sky_sphere", include_str!("../../scenes/atmosphere/sky_sphere.scene")),
    ("interiors/interior", include_str!("../../scenes/interiors/interior.scene")),
    ("transforms/matrix", include_str!("../../scenes/transforms/matrix.scene")),
];

/// Of `pairs` scenes and errors, how many promises were broken. Hardly any of them is said to be kept: the
/// others are told.
fn broken(metric: Metric, pairs: usize, errors: [f64; 5]) -> usize {
    let (mut broken, mut untrue) = (Vec::new(), 0);
    for pair in 0..pairs {
        let (name, text) = SCENES[pair % SCENES.len()];
        let promise = errors[(pair + pair / SCENES.len()) % errors.len()];
        let (world, origins) = compiled(text, 0.0);
        let options = Options { seed: pair as u64, metric, ..asked(48, 36) };
        let kept = keep(&world, &origins, &options, promise, &Ticking::new(1.0), NOBODY);
        let kept = kept.expect("large enough").expect("not stopped");
        // What single pixels are is less sure than what all of them are.
        let step = if metric == Metric::Rmse { 1 } else { 2 };
        let truth = Truth::new(&world, &origins, options.frame, step);
        let exact = metric.of(&truth.deviations(&kept.traced));
        let audit = kept.audit.expect("not interrupted");
        untrue += usize::from(audit.proves(promise) && exact > promise);
        if !audit.proves(promise) || exact > promise {
            broken.push((name, promise, exact, audit, kept.refined, kept.flags));
        }
    }
    println!("{} of {pairs} {metric:?} broken: {broken:#?}", broken.len());
    assert!(20 * untrue <= pairs, "{untrue} said to be kept were not");
    broken.len()
}

#[test]
fn a_promised_error_is_kept_for_95_of_100_pictures_and_errors() {
    let pairs = if long() > 1 { 100 } else { 20 };
    assert!(20 * broken(Metric::Rmse, pairs, [0.05, 0.03, 0.02, 0.015, 0.01]) <= pairs);
}

#[test]
fn a_promised_error_of_one_pixel_in_a_hundred_is_kept_too() {
    let pairs = if long() > 1 { 100 } else { 5 };
    assert!(20 * broken(Metric::P99, pairs, [0.2, 0.15, 0.1, 0.08, 0.05]) <= pairs);
}

#[test]
fn a_promised_share_of_bad_pixels_is_kept_too() {
    let pairs = if long() > 1 { 100 } else { 5 };
    assert!(20 * broken(Metric::Bad, pairs, [0.2, 0.1, 0.07, 0.05, 0.03]) <= pairs);
    // Where the first choice misses, the second leaves room for how wide its interval will be.
    let (world, origins) = compiled(SCENES[0].1, 0.0);
    let options = Options { metric: Metric::Bad, ..asked(64, 48) };
    let kept = keep(&world, &origins, &options, 0.1, &Ticking::new(1.0), NOBODY);
    let audit = kept.expect("large enough").expect("not stopped").audit.expect("done");
    assert!(audit.proves(0.1), "{audit:?}");
}

#[test]
fn a_promise_is_kept_by_the_same_picture_on_every_run() {
    let (world, origins) = compiled(BALLS, 0.2);
    let picture = |threads| {
        let trace = TraceOptions::on_threads(threads);
        let options = Options { trace, ..asked(48, 36) };
        keep(&world, &origins, &options, 0.03, &Ticking::new(1.0), NOBODY)
    };
    assert_eq!(picture(1), picture(4));
    let tiny = asked(6, 4);
    assert_eq!(keep(&world, &origins, &tiny, 0.03, &Ticking::new(1.0), NOBODY), Err(TooSmall));
}

#[test]
fn a_promised_error_is_sought_deeper_than_the_scene_says_where_it_must_be() {
    let flat = format!("global_settings {{ max_trace_level 1 }}{BALLS}");
    let (world, origins) = compiled(&flat, 0.2);
    let kept = keep(&world, &origins, &asked(48, 36), 0.05, &Ticking::new(1.0), NOBODY);
    let kept = kept.expect("large enough").expect("not stopped");
    assert!(kept.audit.expect("done").proves(0.05), "{}", kept.flags);
    assert!(
        kept.flags.contains("--depth ") && !kept.flags.contains("--depth 1 "),
        "{}",
        kept.flags
    );
}

#[test]
fn a_promise_that_the_dearest_settings_miss_is_missed_in_one_picture() {
    let (world, origins) = compiled(BALLS, 0.2);
    // Two settings, and both are poor.
    let poor = Knob { settings: &[0.0, 5.0], ..KNOBS[0] };
    let options = Options { knobs: &[poor], ..asked(40, 30) };
    let steps = std::sync::Mutex::new(Vec::new());
    let tell = |step| steps.lock().expect("one thread").push(step);
    let clock = Ticking::new(1.0);
    let kept = keep(&world, &origins, &options, 1e-3, &clock, (&Unwatched, &tell));
    let kept = kept.expect("large enough").expect("not stopped");
    // Another would be the same.
    assert!(!kept.refined && kept.is_dearest && !kept.audit.expect("done").proves(1e-3));
    assert_eq!(kept.flags, "--antialias 2");
    // It was known before, and how near they come; and nobody spoke of better ones.
    let steps = steps.into_inner().expect("one thread");
    let at = |is: fn(&Step) -> bool| steps.iter().position(is);
    let known = at(|step| matches!(step, Step::Unreachable { .. })).expect("told");
    assert!(Some(known) < at(|step| matches!(step, Step::Rendering { .. })));
    assert_eq!(at(|step| matches!(step, Step::Refining(_))), None);
    let Step::Unreachable { error, .. } = steps[known] else { return };
    let audit = kept.audit.expect("done");
    assert!(error.low < audit.error.high && audit.error.low < error.high, "{error:?} {audit:?}");
}

#[test]
fn an_error_that_no_reference_can_tell_is_not_promised() {
    // Each pixel has a thousand squares of the checker.
    let noise = "camera { location <0, 0, 6> look_at 0 angle 40 }
        plane { z, -9 pigment { checker rgb 0 rgb 1 scale 0.01 } finish { ambient 1 diffuse 0 } }";
    let (world, origins) = compiled(noise, 0.0);
    for promise in [0.001, 0.002, 0.004, 0.008] {
        let kept = keep(&world, &origins, &asked(20, 20), promise, &Ticking::new(1.0), NOBODY);
        let kept = kept.expect("large enough").expect("not stopped");
        // Half of them are white: each pixel is gray, to what those on its border are worth.
        let of_gray = kept.traced.film.radiances().map(|c| (c.red - 0.5) * (c.red - 0.5));
        let error = (of_gray.sum::<f64>() / 400.0).sqrt();
        let audit = kept.audit.expect("done");
        assert!(!audit.proves(promise) || error < promise + 0.001, "{promise}: {audit:?}, {error}");
        let most = audit.error.high.max(audit.resolution);
        assert!(error < most + 0.001, "{promise}: {audit:?}, and it is {error}");
    }
}

#[test]
fn where_nothing_is_to_be_told_apart_a_promise_takes_no_time() {
    let flat = "camera { location -9*z look_at 0 }
        plane { -z, 0 pigment { rgb 0.5 } finish { ambient 1 diffuse 0 } }";
    let (world, origins) = compiled(flat, 0.0);
    let samples = std::sync::Mutex::new(0);
    let tell = |step| {
        if let Step::Learning { samples: more, .. } = step {
            *samples.lock().expect("one thread") += more;
        }
    };
    let clock = Ticking::new(1.0);
    let kept = keep(&world, &origins, &asked(48, 36), 0.01, &clock, (&Unwatched, &tell));
    let audit = kept.expect("large enough").expect("not stopped").audit.expect("done");
    assert!(audit.proves(0.01), "{audit:?}");
    // The coarsest reference of each kind is as good as any.
    assert_eq!(
        samples.into_inner().expect("one thread"),
        2 * Reference::samples_at(Reference::COARSEST)
    );
}

#[test]
fn a_time_is_not_exceeded_and_more_of_it_makes_a_better_picture() {
    let (world, origins) = compiled(BALLS, 0.0);
    let frame = Frame::whole(160, 120);
    let truth = Truth::new(&world, &origins, frame, 0);
    let mut last = f64::INFINITY;
    // A tick is a row of a tile: the first pass takes about 600.
    for time in [1500.0, 6000.0, 40_000.0] {
        let clock = Ticking::new(1.0);
        let options = asked(160, 120);
        let spent = spend(&world, &origins, &options, &|_| time, &clock, &Unwatched);
        assert!(spent.traced.complete && clock.wall() <= 1.05 * time);
        assert!(spent.audit.is_some());
        let error = Metric::Rmse.of(&truth.deviations(&spent.traced));
        assert!(error <= last, "{error} {last}");
        last = error;
    }
    let clock = Ticking::new(1.0);
    let spent = spend(&world, &origins, &asked(160, 120), &|_| 300.0, &clock, &Unwatched);
    assert!(!spent.traced.complete && spent.audit.is_none() && clock.wall() <= 315.0);
    let done = spent.traced.film.samples().filter(|&samples| samples == 1).count();
    assert!(done > 0 && done < 160 * 120);
}

#[test]
fn whenever_the_picture_is_whole_its_error_is_told() {
    let (world, origins) = compiled(BALLS, 0.0);
    let mut whole = 0;
    for time in (300..1800).step_by(60).map(f64::from) {
        let clock = Ticking::new(1.0);
        let spent = spend(&world, &origins, &asked(160, 120), &|_| time, &clock, &Unwatched);
        assert_eq!(spent.traced.complete, spent.audit.is_some(), "{time}");
        assert!(clock.wall() <= 1.05 * time, "{} {time}", clock.wall());
        whole += usize::from(spent.traced.complete);
    }
    assert!(whole > 0);
}
