//! Budgets are kept where one pixel is more work than all others together. Time is counted here:
//! a clock that ticks whenever it is asked, and it is asked the more the more is traced.

use super::reference::{Geometries, Reference, Studio};
use super::refine::{Canvas, Pace, is_finest, spread};
use super::tests::{ONE_THREAD, Ticking, asked, compiled};
use super::*;
use crate::film::Film;
use crate::plan::Antialias;
use crate::trace::{Sampling, Sight, Traced, Unwatched, trace};

/// Clear balls that mirror: every path forks at each surface, as deep as one looks.
const GLASS: &str = "
global_settings { max_trace_level {} }
camera { location <0, 3, 6> look_at 0 angle 45 }
light_source { <-8, 12, 10>, rgb 1 }
background { rgb <0.3, 0.5, 0.8> }
plane { y, -1 pigment { checker rgb 1, rgb 0.1 } }
#for (I, 0, 3)
  #for (J, 0, 3)
    sphere {
      <2*I - 3, 0, 2*J - 3>, 0.9
      pigment { rgbt 1 } finish { ambient 0 diffuse 0 reflection 0.9 } interior { ior 1.5 }
    }
  #end
#end
";

/// Mirrors all around: a path ends only where one looks no deeper.
const MIRRORS: &str = "
global_settings { max_trace_level {} adc_bailout 0 }
camera { location 0.1 look_at z }
light_source { 0.2, rgb 1 }
box { -1, 1 pigment { rgb 1 } finish { reflection 1 ambient 0.1 } }
";

#[test]
fn work_is_stopped_within_a_pixel_and_the_pixel_is_left_undone() {
    // A single one of these pixels would take longer than there is.
    for (text, depth) in [(GLASS, 200.0), (MIRRORS, 1e6)] {
        let (world, origins) = compiled(text, depth);
        let own = own(&world, Frame::whole(8, 6));
        for antialias in [Antialias::Off, Antialias::Grid(3), Antialias::default()] {
            let plan = plan(&world, &origins, &PlanOptions { antialias, ..own });
            let clock = Ticking::new(1.0);
            let watch =
                affordable_reference::Deadline { clock: &clock, until: 300.0, watch: &Unwatched };
            let Traced { film, counters, complete } = trace(&world, &plan, &ONE_THREAD, &watch);
            assert!(!complete && film.samples().any(|samples| samples == 0), "{antialias:?}");
            assert!(counters.rays() < 300 * 1000, "{counters:?}");
            let mut undone = film.pixels.iter().filter(|pixel| pixel.samples() == 0);
            assert!(undone.all(|pixel| pixel.radiance().is_black()));
        }
    }
}

#[test]
fn a_time_is_kept_where_paths_fork_and_the_error_is_told_against_what_could_be_looked_at() {
    let (world, origins) = compiled(GLASS, 5.0);
    for time in [3000.0, 20_000.0] {
        let clock = Ticking::new(1.0);
        let spent = spend(&world, &origins, &asked(48, 36), &|_| time, &clock, &Unwatched);
        let within = (0.95 * time..=1.05 * time).contains(&clock.wall());
        assert!(spent.traced.complete && within, "{}", clock.wall());
        // As deep as the scene looks, where all the way takes too long.
        let audit = spent.audit.expect("told");
        assert_eq!((audit.depth, audit.adc_bailout), (Some(5), Some(1.0 / 255.0)));
        assert!(!spent.is_less && spent.traced.film.samples().any(|samples| samples > 1));
    }
}

#[test]
fn a_reference_that_gives_up_rays_as_soon_as_the_scene_does_says_so() {
    // As deep as can be, and yet not all the way.
    let hasty = GLASS.replace("max_trace_level", "adc_bailout 0.5 max_trace_level");
    let (world, origins) = compiled(&hasty, 250.0);
    let clock = Ticking::new(1.0);
    let spent = spend(&world, &origins, &asked(48, 36), &|_| 20_000.0, &clock, &Unwatched);
    let audit = spent.audit.expect("told");
    assert_eq!((audit.depth, audit.adc_bailout), (None, Some(0.5)));
    assert!(!audit.proves(1.0));
}

#[test]
fn where_the_scenes_own_settings_do_not_fit_the_first_pass_is_made_with_what_does() {
    // A single pixel would take longer.
    let (world, origins) = compiled(GLASS, 200.0);
    let spent = |time: f64| {
        let clock = Ticking::new(1.0);
        let spent = spend(&world, &origins, &asked(48, 36), &|_| time, &clock, &Unwatched);
        assert!(clock.wall() <= 1.05 * time, "{}", clock.wall());
        spent
    };
    let depth = |flags: &str| {
        let (_, depth) = flags.split_once("--depth ").expect("a depth");
        depth.split(' ').next().and_then(|depth| depth.parse::<u32>().ok()).expect("a number")
    };
    let mut last = 0;
    for time in [1000.0, 5000.0, 30_000.0] {
        let spent = spent(time);
        assert!(spent.traced.complete && spent.is_less, "{time}");
        // Of what lies deeper nothing is known: no number is better than one that is too small.
        assert!(spent.audit.is_none(), "{:?}", spent.audit);
        assert!((1..=25).contains(&depth(&spent.flags)), "{}", spent.flags);
        assert!(depth(&spent.flags) >= last, "{}", spent.flags);
        last = depth(&spent.flags);
    }
    assert!(last > 1, "more time is used for more depth");
    // Not even the cheapest.
    let spent = spent(60.0);
    assert!(!spent.traced.complete && spent.is_less && spent.audit.is_none());
    assert_eq!(spent.flags, "--depth 1 --adc-bailout 1/10");
    assert_eq!(spent.flags, spent.least);
}

#[test]
fn pixels_that_turn_out_too_dear_are_made_with_the_cheapest_settings_and_hold_up_no_other() {
    // The heap is a corner of the picture: of the few pixels that are looked at first, none shows it. Each that
    // does would take longer than there is.
    let (world, origins) = compiled(&GLASS.replace("0 angle 45", "<9, 9, 0> angle 130"), 200.0);
    let options = asked(48, 36);
    let easel = render_settings::Easel::new(&world, &origins, &options);
    let geometry = Geometries::default();
    let studio =
        Studio { world: &world, geometry: &geometry, options: ONE_THREAD, watch: &Unwatched };
    let begun = |time: f64| {
        let clock = Ticking::new(1.0);
        let begun = first_samples::begin(&studio, &origins, &easel, 1, (&clock, time));
        assert!(begun.traced.complete && clock.wall() <= time, "{time} {}", clock.wall());
        assert!(!begun.is_less && begun.settings.antialias == Antialias::Off);
        let least = plan(&world, &origins, &begun.least);
        let cheapest = trace(&world, &least, &ONE_THREAD, &Unwatched).film;
        let as_cheap =
            begun.traced.film.radiances().zip(cheapest.radiances()).filter(|(a, b)| a == b);
        assert!(as_cheap.count() >= begun.rest.len());
        begun.rest.len()
    };
    let (short, long) = (begun(2000.0), begun(16_000.0));
    assert!(0 < long && long < short && short < 48 * 36 / 3, "{short} {long}");
    assert!(long < 48 * 36 / 16, "{long}");
}

#[test]
fn a_picture_as_fine_as_it_gets_is_said_to_be_and_takes_no_more_time() {
    let (world, origins) = compiled(GLASS, 2.0);
    let clock = Ticking::new(1.0);
    let spent = spend(&world, &origins, &asked(16, 12), &|_| 2e5, &clock, &Unwatched);
    assert!(spent.is_finest && clock.wall() < 1.9e5, "{}", clock.wall());
    assert!(spent.traced.film.samples().all(|samples| samples == 1024));
}

#[test]
fn a_budget_is_kept_and_what_was_given_up_for_it_is_told() {
    let (world, origins) = compiled(GLASS, 5.0);
    for budget in [12_000.0, 60_000.0] {
        let clock = Ticking::new(1.0);
        let options = Options { budget, ..asked(48, 36) };
        let report = accuracy(&world, &origins, &options, &clock, &Unwatched).expect("measured");
        assert!(clock.wall() <= 1.05 * budget, "{} of {budget}", clock.wall());
        let (depth, most) = report.cut.depth.expect("not all the way");
        assert!(depth < most && most == 250, "{depth}");
        let cut = table::cut(&report).join(", ");
        assert!(cut.ends_with(&format!("{depth} of 250 surfaces deep in the reference")), "{cut}");
        let depth = report.knobs.iter().find(|knob| knob.name == "depth").expect("called for");
        assert!(depth.left_out.contains(&"250".to_owned()), "{depth:?}");
        assert!(depth.settings.iter().any(|setting| setting.is_own && setting.row == 0));
        let count = |k: &Tried| k.settings.len() + k.left_out.len() + k.vain.len();
        let all: usize = report.knobs.iter().map(count).sum();
        assert_eq!(all, 14 + 7 + 5, "each is measured or listed as left out");
    }
    let options = Options { budget: 100.0, ..asked(48, 36) };
    let clock = Ticking::new(1.0);
    let none = accuracy(&world, &origins, &options, &clock, &Unwatched);
    let Err(Unmeasured::TooShort { own, enough }) = none else { panic!("{none:?}") };
    assert!(clock.wall() <= 110.0, "{}", clock.wall());
    // What is said to be enough is, and is known long before the time is up.
    assert!(own > 70.0 && enough > 2.0 * own, "{own} {enough}");
    let clock = Ticking::new(1.0);
    let options = Options { budget: 1500.0, ..asked(160, 120) };
    let none = accuracy(&world, &origins, &options, &clock, &Unwatched);
    let Err(Unmeasured::TooShort { enough, .. }) = none else { panic!("{none:?}") };
    assert!(clock.wall() <= 200.0, "{}", clock.wall());
    let options = Options { budget: enough, ..options };
    let clock = Ticking::new(1.0);
    let report = accuracy(&world, &origins, &options, &clock, &Unwatched).expect("measured");
    assert!(report.rows.len() > 1, "{}", report.rows.len());
}

#[test]
fn without_a_clock_a_reference_is_as_deep_on_every_run() {
    let (world, origins) = compiled(GLASS, 5.0);
    let own = own(&world, Frame::whole(48, 36));
    let depths = Depths { origins: &origins, deepest: dearest(own, KNOBS) };
    let list = audit::shuffled(audit::sets(own.frame.region, 200, 1, 3).remove(0), 3);
    let depth = |threads| {
        let geometry = Geometries::default();
        let options = TraceOptions::on_threads(threads);
        let studio = Studio { world: &world, geometry: &geometry, options, watch: &Unwatched };
        affordable_reference::counted_depth(&studio, &depths, &list, 1, 2).expect("not stopped")
    };
    assert_eq!(depth(1), depth(3));
    assert!((5..40).contains(&depth(1)), "{}", depth(1));
    // Where the scene looks deeper than anybody could wait for, it does not.
    let geometry = Geometries::default();
    let studio =
        Studio { world: &world, geometry: &geometry, options: ONE_THREAD, watch: &Unwatched };
    let own =
        affordable_reference::counted_depth(&studio, &depths, &list, 1, 200).expect("not stopped");
    assert!(own >= depth(1) && own < 60, "{own}");
}

/// Clear panes that bend nothing: what lies behind any number of them is as deep as the first.
const PANES: &str = "
camera { location <2, 1, 7> look_at <0, 0.5, 0> angle 40 }
light_source { <4, 8, 6>, rgb 1 }
plane { y, -0.5 pigment { checker rgb 0.9, rgb 0.2 } }
#for (I, 1, {})
  box {
    <-1.5, -0.4, I/2>, <1.5, 1.6, I/2 + 0.02>
    pigment { rgbf <0.95, 0.97, 0.97, 0.95> } finish { diffuse 0.05 reflection 0.15 }
  }
#end
";

#[test]
fn where_a_level_is_worth_many_a_reference_is_as_deep_as_can_be_and_no_look_is_endless() {
    let depth = |panes: f64, asked: u32| {
        let (world, origins) = compiled(PANES, panes);
        let settings = own(&world, Frame::whole(48, 36));
        let depths = Depths { origins: &origins, deepest: dearest(settings, KNOBS) };
        let list = audit::shuffled(audit::sets(settings.frame.region, 200, 1, 3).remove(0), 3);
        let geometry = Geometries::default();
        let studio =
            Studio { world: &world, geometry: &geometry, options: ONE_THREAD, watch: &Unwatched };
        let depth = affordable_reference::counted_depth(&studio, &depths, &list, 1, asked)
            .expect("not stopped");
        let rays = |depth: u32| {
            let plan = depths.plan(&studio, depth);
            let reference = Reference::new(&studio, &plan, &list[..30], 1, Reference::ROUGH);
            let reference = reference.expect("not stopped");
            reference.counters.rays() as f64 / f64::from(reference.samples()) / 30.0
        };
        (depth, rays(depth), rays(depth + 1))
    };
    let (deep, rays, more) = depth(3.0, 2);
    assert!(deep > 3 && rays <= 2048.0 && more > 2048.0, "{deep}: {rays} {more}");
    // As deep as the scene looks more of them are worth sending.
    let (own, rays, _) = depth(3.0, deep + 1);
    assert!(own == deep + 1 && rays > 2048.0, "{own}: {rays}");
}

/// A film of one ray a pixel, refined until the clock shows `until`.
fn refined(until: f64) -> (Film, usize) {
    let (world, origins) = compiled(GLASS, 3.0);
    let own = own(&world, Frame::whole(40, 30));
    let plan = plan(&world, &origins, &PlanOptions { antialias: Antialias::Off, ..own });
    let geometry = Geometries::default();
    let clock = Ticking::new(1.0);
    let watch = affordable_reference::Deadline { clock: &clock, until, watch: &Unwatched };
    let studio = Studio { world: &world, geometry: &geometry, options: ONE_THREAD, watch: &watch };
    let Traced { film, counters, .. } = studio.picture(&plan, &Unwatched);
    let pace = Pace { seconds: 100.0, samples: film.pixels.len() as f64 };
    let mut canvas = Canvas::new(film, &[], counters, pace);
    let time = (&clock as &dyn Clock, until);
    while let Some(expected) = canvas.expected(&studio)
        && canvas.pass(&studio, &plan, &expected, time)
    {}
    let finer = canvas.film.samples().filter(|&samples| samples > 1).count();
    (canvas.film, finer)
}

#[test]
fn the_most_samples_are_reached_where_there_is_time() {
    let floor = "camera { location y } light_source { 9, 1 } plane { y, -1 pigment { rgb 1 } }";
    // A thin bar in one of the pixels.
    let noisy = "camera { location 5*z look_at 0 } light_source { 9*z, 1 }
        box { -0.01 + 0.5*x, 0.01 + 0.5*x scale <1, 100, 1> pigment { checker rgb 1 rgb 0 scale 0.01 } }";
    for (text, width, height) in [(floor, 4, 3), (floor, 1, 1), (noisy, 5, 1), (noisy, 1, 1)] {
        let (world, origins) = compiled(text, 1.0);
        let own = own(&world, Frame::whole(width, height));
        let plan = plan(&world, &origins, &PlanOptions { antialias: Antialias::Off, ..own });
        let geometry = Geometries::default();
        let studio =
            Studio { world: &world, geometry: &geometry, options: ONE_THREAD, watch: &Unwatched };
        let clock = Ticking::new(1.0);
        let Traced { film, counters, .. } = studio.picture(&plan, &Unwatched);
        let (first, pace) =
            (film.clone(), Pace { seconds: 1.0, samples: film.pixels.len() as f64 });
        let mut canvas = Canvas::new(film, &[0], counters, pace);
        let time = (&clock as &dyn Clock, 1e9);
        while let Some(expected) = canvas.expected(&studio)
            && canvas.pass(&studio, &plan, &expected, time)
        {}
        assert!(is_finest(&canvas.film), "{:?}", canvas.film.pixels);
        // The first sample of a pixel that was traced with cheaper settings is taken anew.
        for (i, pixel) in first.pixels.iter().enumerate() {
            let (first, sum) = if i == 0 { (0, Sight::NOTHING) } else { (1, (*pixel).into()) };
            let aim = (
                refine::place(canvas.film.frame.region, i),
                Sampling::Numbered { first, end: 1024, sum },
            );
            let seen = studio.pixels(&plan, &[aim]).0[0].expect("not stopped");
            assert_eq!(seen.mean.pixel(1024), canvas.film.pixels[i], "{i}");
        }
    }
}

#[test]
fn a_refined_pixel_has_the_bits_of_one_that_has_as_many_samples_at_once() {
    let (film, pixels) = refined(6000.0);
    let counts: std::collections::BTreeSet<u32> = film.samples().collect();
    assert!(counts.len() > 3 && pixels > 100, "{counts:?}");
    let (world, origins) = compiled(GLASS, 3.0);
    let options = PlanOptions { antialias: Antialias::Off, ..own(&world, film.frame) };
    let plan = plan(&world, &origins, &options);
    let geometry = Geometries::default();
    let studio =
        Studio { world: &world, geometry: &geometry, options: ONE_THREAD, watch: &Unwatched };
    let first = studio.picture(&plan, &Unwatched).film;
    let aim = |(i, end): (usize, u32)| {
        (
            refine::place(film.frame.region, i),
            Sampling::Numbered { first: 1, end, sum: first.pixels[i].into() },
        )
    };
    let aims: Vec<_> = film.samples().enumerate().map(aim).collect();
    for (seen, &pixel) in studio.pixels(&plan, &aims).0.iter().zip(&film.pixels) {
        assert_eq!(seen.expect("not stopped").mean.pixel(pixel.samples()), pixel);
    }
}

#[test]
fn time_is_spent_over_the_whole_picture() {
    // Few pixels are done, and each quarter of those that are worth it has its share.
    let (film, pixels) = refined(60.0);
    let (more, _) = refined(6000.0);
    let quarter = |film: &Film, top: usize, left: usize| {
        let inside = |i: &usize| i / 40 / 15 == top && i % 40 / 20 == left;
        (0..1200).filter(inside).filter(|&i| film.pixels[i].samples() > 1).count()
    };
    assert!(pixels > 0 && pixels < 600, "{pixels}");
    for (top, left) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
        let (done, worth) = (quarter(&film, top, left), quarter(&more, top, left));
        assert!(5 * done >= worth.min(pixels / 4), "{top} {left}: {done} of {worth}, {pixels}");
    }
}

#[test]
fn a_film_that_is_spread_has_all_its_pixels_and_each_first_part_has_some_of_each_part() {
    for count in [0usize, 1, 5, 16, 17, 1000, 4800] {
        let mut list: Vec<usize> = spread(count).collect();
        if count > 500 {
            let first = &list[..count / 4];
            for eighth in 0..8 {
                let inside = first.iter().filter(|&&i| 8 * i / count == eighth).count();
                assert!(4 * inside >= first.len() / 8, "{count}: {eighth} has {inside}");
            }
        }
        list.sort_unstable();
        assert!(list.into_iter().eq(0..count));
    }
}

#[test]
fn a_time_makes_no_worse_a_picture_than_a_plain_grid_that_takes_it() {
    // The truth of a heap of glass takes a minute.
    let long = crate::math::random::long() > 1;
    for text in [super::tests::BALLS, GLASS].into_iter().take(if long { 2 } else { 1 }) {
        let (world, origins) = compiled(text, 4.0);
        let frame = Frame::whole(64, 48);
        let truth = super::tests::Truth::new(&world, &origins, frame, 1);
        for side in [6, 8] {
            let antialias = Antialias::Grid(side);
            let options = PlanOptions { antialias, ..own(&world, frame) };
            let clock = Ticking::new(1.0);
            let watch = affordable_reference::Deadline {
                clock: &clock,
                until: f64::MAX,
                watch: &Unwatched,
            };
            let grid = trace(&world, &plan(&world, &origins, &options), &ONE_THREAD, &watch);
            let time = clock.wall();
            let clock = Ticking::new(1.0);
            let spent = spend(&world, &origins, &asked(64, 48), &|_| time, &clock, &Unwatched);
            let error = |traced| Metric::Rmse.of(&truth.deviations(traced));
            let (mine, theirs) = (error(&spent.traced), error(&grid));
            println!("{side}: {mine} for {theirs}, {:?}", spent.audit);
            assert!(mine <= 1.1 * theirs, "{side}: {mine} for {theirs}");
        }
    }
}

#[test]
fn the_error_that_is_told_holds_the_true_one_90_times_of_100() {
    let (mut all, mut missed) = (0, Vec::new());
    // The truth of a heap of glass takes a minute.
    let long = crate::math::random::long() > 1;
    for text in [super::tests::BALLS, GLASS].into_iter().take(if long { 2 } else { 1 }) {
        let (world, origins) = compiled(text, 3.0);
        let frame = Frame::whole(48, 36);
        let truth = super::tests::Truth::new(&world, &origins, frame, 1);
        let seeds = if long { 30 } else { 20 };
        for (time, seed) in
            [2000.0, 8000.0].into_iter().flat_map(|t| (0..seeds).map(move |s| (t, s)))
        {
            let options = Options { seed, ..asked(48, 36) };
            let clock = Ticking::new(1.0);
            let spent = spend(&world, &origins, &options, &|_| time, &clock, &Unwatched);
            let exact = Metric::Rmse.of(&truth.deviations(&spent.traced));
            let audit = spent.audit.expect("told");
            all += 1;
            if exact > audit.error.high || exact < audit.error.low {
                missed.push((time, seed, exact, audit));
            }
        }
    }
    assert!(10 * missed.len() <= all, "{} of {all}: {missed:#?}", missed.len());
}
