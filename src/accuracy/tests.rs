//! Whole measurements of small pictures, held against what every pixel says.

use std::sync::atomic::{AtomicU64, Ordering};

use super::knob::Own;
use super::reference::clamped;
use super::statistics::Deviation;
use super::table::Width;
use super::*;
use crate::plan::{Antialias, Effect};
use crate::road::{Options as RoadOptions, Road};
use crate::scene::Dialect;
use crate::source::NoFiles;
use crate::trace::{Traced, Unwatched, trace};

/// Balls over a checker, in one another's mirrors; `{}` is a number to vary it by.
pub(super) const BALLS: &str = "
camera { location <0, 1.5, 7> look_at <0, 0.6, 0> angle 45 }
light_source { <4, 7, 5>, rgb 1 }
background { rgb <0.3, 0.5, 0.8> }
plane { y, 0 pigment { checker rgb 1, rgb 0.1 } finish { reflection 0.1 } }
sphere { <-1, 0.8, {}>, 0.8 pigment { rgb <0.8, 0.3, 0.1> } finish { reflection 0.7 } }
sphere { <1, 0.7, 0.3>, 0.7 pigment { rgb 0.1 } finish { reflection 0.8 phong 0.7 } }
box { <-0.3, 0, 1.6>, <0.3, 0.5, 2.1> rotate 20*y pigment { rgb <0.2, 0.7, 0.3> } }
";

/// No mirror: nothing of depth.
const PLAIN: &str = "
camera { location <0, 1.5, 7> look_at 0 angle 40 }
light_source { <4, 7, 5>, rgb 1 }
sphere { <-0.6, {}, 0>, 1 pigment { rgb <1, 0.6, 0.2> } }
box { <0.4, -1, -1>, <1.6, 0.3, 1> rotate 30*y pigment { rgb <0.3, 0.5, 1> } }
plane { y, -1 pigment { rgb 0.7 } }
";

/// What bends light, and what crossings are stepped to.
const GLASS: &str = "
camera { location <0, 2, 7> look_at 0 angle 40 }
light_source { <4, 7, 5>, rgb 1 }
background { rgb <0.6, 0.7, 0.9> }
plane { y, -1 pigment { checker rgb 0.9, rgb 0.2 } }
sphere { <-1.3, {}, 0>, 1 pigment { rgbt <1, 1, 1, 0.95> } finish { ambient 0 diffuse 0.05 phong 0.6 } interior { ior 1.5 } }
torus { 0.7, 0.25 rotate 60*x translate <1, -0.2, -0.5> pigment { rgb <1, 0.6, 0.2> } finish { phong 0.5 } }
blob { threshold 0.5 sphere { <0.6, -0.6, 1.5>, 0.6, 1 } sphere { <1.1, -0.5, 1.6>, 0.6, 1 } pigment { rgb <0.3, 0.5, 1> } }
";

pub(super) fn compiled(text: &str, number: f64) -> (World, Origins) {
    let mut road = Road::new(&NoFiles, RoadOptions::new(Dialect::Scene));
    let text = text.replace("{}", &number.to_string());
    let compiled = road.compile("a.scene", text.into_bytes());
    assert_eq!(road.diagnostics.len(), 0, "{:?}", road.diagnostics.iter().collect::<Vec<_>>());
    compiled
}

pub(super) const ONE_THREAD: TraceOptions = TraceOptions::on_threads(1);

pub(super) fn asked(width: u32, height: u32) -> Options<'static> {
    Options {
        frame: Frame::whole(width, height),
        knobs: KNOBS,
        metric: Metric::Rmse,
        budget: 1e4,
        seed: 1,
        alpha: false,
        trace: ONE_THREAD,
    }
}

/// A clock that stands still unless it is asked: then a tick passes.
pub(super) struct Ticking(AtomicU64, f64);

impl Ticking {
    pub(super) fn new(tick: f64) -> Self {
        Self(AtomicU64::new(0), tick)
    }
}

impl Clock for Ticking {
    fn wall(&self) -> f64 {
        self.0.fetch_add(1, Ordering::Relaxed) as f64 * self.1
    }

    fn cpu(&self) -> f64 {
        self.wall()
    }
}

/// Every pixel of a film against a fine reference.
pub(super) struct Truth {
    reference: Reference,
    list: Vec<(u32, u32)>,
}

impl Truth {
    pub(super) fn new(world: &World, origins: &Origins, frame: Frame, step: usize) -> Self {
        let geometry = Geometries::default();
        let studio = Studio { world, geometry: &geometry, options: ONE_THREAD, watch: &Unwatched };
        let list = audit::sets(frame.region, u32::MAX, 1, 0).remove(0);
        let deep = plan(world, origins, &dearest(own(world, frame), KNOBS));
        let reference = Reference::new(&studio, &deep, &list, 77, Reference::COARSEST + step)
            .expect("not stopped");
        Self { reference, list }
    }

    pub(super) fn deviations(&self, traced: &Traced) -> Vec<Deviation> {
        let film = &traced.film;
        let color =
            |&(x, y): &(u32, u32)| clamped(film.radiance(film.index(x, y)), film.assumed_gamma);
        self.reference.deviations(&self.list.iter().map(color).collect::<Vec<_>>())
    }
}

#[test]
fn the_true_error_lies_in_the_interval_90_to_99_times_of_100() {
    // The plain picture is off at a few edges alone. It is larger, so that those drawn are few of its pixels:
    // the intervals do not count on having seen a good part of the picture.
    for (text, antialias, frame) in [
        (BALLS, Antialias::Grid(2), Frame::whole(96, 72)),
        (BALLS, Antialias::default(), Frame::whole(96, 72)),
        (PLAIN, Antialias::Off, Frame::whole(144, 108)),
        (GLASS, Antialias::default(), Frame::whole(96, 72)),
    ] {
        let (world, origins) = compiled(text, 0.0);
        let truth = Truth::new(&world, &origins, frame, 2);
        let own = own(&world, frame);
        let deep = plan(&world, &origins, &dearest(own, KNOBS));
        let plan = plan(&world, &origins, &PlanOptions { antialias, ..own });
        let traced = trace(&world, &plan, &ONE_THREAD, &Unwatched);
        let exact = truth.deviations(&traced);
        let geometry = Geometries::default();
        let studio =
            Studio { world: &world, geometry: &geometry, options: ONE_THREAD, watch: &Unwatched };
        let mut holds = [0; 3];
        for seed in 0..100 {
            let list = audit::sets(frame.region, 700, 1, seed).remove(0);
            let reference = Reference::new(&studio, &deep, &list, seed, Reference::COARSEST)
                .expect("not stopped");
            let film = &traced.film;
            let colors: Vec<_> = list
                .iter()
                .map(|&(x, y)| clamped(film.radiance(film.index(x, y)), film.assumed_gamma))
                .collect();
            let off = reference.deviations(&colors);
            for (holds, metric) in holds.iter_mut().zip(Metric::ALL) {
                let Estimate { low, high, .. } = metric.estimate(&off, frame.region.pixels());
                *holds += u32::from((low..=high).contains(&metric.of(&exact)));
            }
        }
        assert!(holds.iter().all(|holds| (90..=99).contains(holds)), "{antialias:?} {holds:?}");
    }
}

/// Changes what no scene notices.
const PLANTED: Knob = Knob {
    name: "planted",
    needs: Need::Effect(&[Effect::Antialiasing]),
    idle: "nothing ever calls for it",
    settings: &[1.0, 2.0, 3.0],
    own: Own::Among,
    reference: None,
    set: |_, _| (),
    get: |_| 2.0,
    least: |_| 1.0,
    factor: |_| 1.0,
    label: |value| format!("{value}"),
    flag: |value| format!("--planted {value}"),
};

#[test]
fn a_knob_that_does_nothing_is_said_to_buy_nothing() {
    let (world, origins) = compiled(BALLS, 0.0);
    let options = Options { knobs: &[KNOBS[0], PLANTED], ..asked(24, 18) };
    let clock = Ticking::new(1.0 / 1024.0);
    let report = accuracy(&world, &origins, &options, &clock, &Unwatched).expect("not stopped");
    let planted = report.knobs.iter().find(|knob| knob.name == "planted").expect("tried");
    assert_eq!(
        planted.sentence,
        "planted buys nothing here: from 1 to 3 not one of 432 audited pixels changes."
    );
    assert!(planted.settings[1].is_own && planted.settings[1].row == 0);
    let antialias = &report.knobs[0];
    assert!(
        antialias.sentence.starts_with("antialias bought, from off to "),
        "{}",
        antialias.sentence
    );
}

#[test]
fn a_knob_whose_effect_the_scene_does_not_call_for_does_not_appear() {
    let names = |text| {
        let (world, origins) = compiled(text, 0.0);
        let own = own(&world, Frame::whole(8, 6));
        let called = called_for(&world, &origins, own, KNOBS);
        called.iter().map(|knob| knob.name).collect::<Vec<_>>()
    };
    assert_eq!(names(PLAIN), ["antialias"]);
    assert_eq!(names(BALLS), ["antialias", "depth", "adc-bailout"]);
    // A torus, also as a part of something else, is met by steps.
    let torus = "torus { 1, 0.2 pigment { rgb 1 } }";
    let lit = "camera { location 9*z look_at 0 } light_source { 9, rgb 1 }";
    let alone = format!("{lit} {torus}");
    assert_eq!(names(&alone), ["antialias", "root-tolerance"]);
    let cut = format!("{lit} intersection {{ {torus} sphere {{ 0, 1 pigment {{ rgb 1 }} }} }}");
    assert_eq!(names(&cut), ["antialias", "root-tolerance"]);
    let fractal = format!("{lit} julia_fractal {{ 0.1 max_iteration 5 pigment {{ rgb 1 }} }}");
    assert_eq!(names(&fractal), ["antialias", "root-tolerance", "julia-iterations"]);
    let soft = "camera { location 9*z look_at 0 }
        light_source { 9, rgb 1 area_light 2*x, 2*y, 3, 3 } sphere { 0, 1 pigment { rgb 1 } }";
    assert_eq!(names(soft), ["antialias", "light-samples"]);
    // A lens spreads its samples over the pixel, too.
    let blurred = "camera { location 9*z look_at 0 aperture 1 focal_point 0 blur_samples 9 }
        light_source { 9, rgb 1 } sphere { 0, 1 pigment { rgb 1 } }";
    assert_eq!(names(blurred), ["blur-samples"]);
    // A sky, and nothing that a ray could meet.
    assert_eq!(names("camera { } background { rgb 0.5 }"), [""; 0]);
    let sky = "camera { } sky_sphere { pigment { gradient y color_map { [0 rgb 0] [1 rgb 1] } } }";
    assert_eq!(names(sky), ["antialias"]);
    // A scene that reflects and says how deep not to look is told what that costs it.
    let flat = format!("global_settings {{ max_trace_level 1 }}{BALLS}");
    assert_eq!(names(&flat), ["antialias", "depth", "adc-bailout"]);
}

#[test]
fn of_a_knob_that_is_not_called_for_it_is_said_why() {
    let said = |text, knobs| {
        let (world, origins) = compiled(text, 0.0);
        idle(&world, &origins, Frame::whole(8, 6), knobs)
    };
    let why = "does nothing here: no surface reflects or is clear";
    assert_eq!(said(PLAIN, &KNOBS[..3]), [format!("depth {why}"), format!("adc-bailout {why}")]);
    assert_eq!(said(BALLS, &KNOBS[..3]), [""; 0]);
}

/// The wall clock's seconds of a picture are of its work: so a forecast by work is one by seconds.
#[test]
fn of_every_knob_the_cheap_settings_are_tried_before_the_dear_ones() {
    let (world, origins) = compiled(BALLS, 0.0);
    let mut left = Vec::new();
    for budget in [6e4, 1.2e5, 3e5, 1.2e6] {
        let options = Options { budget, knobs: &KNOBS[..3], ..asked(160, 120) };
        let clock = Ticking::new(1.0);
        let report = accuracy(&world, &origins, &options, &clock, &Unwatched).expect("measured");
        assert!(clock.wall() <= 1.05 * budget, "{} of {budget}", clock.wall());
        let dearest =
            report.rows.iter().map(|row| Span::of(&row.times.wall).min).fold(0.0, f64::max);
        for knob in &report.knobs {
            // What was left out is dearer than what was tried: grids are told by their samples.
            let side = |label: &str| label.split_once('×').and_then(|(_, n)| n.parse::<u32>().ok());
            let grids = knob.settings.iter().filter(|s| !s.label.starts_with("adaptive"));
            let most = grids.filter_map(|setting| side(&setting.label)).max();
            let least = knob
                .left_out
                .iter()
                .filter(|l| !l.starts_with("adaptive"))
                .filter_map(|l| side(l))
                .min();
            assert!(most.zip(least).is_none_or(|(most, least)| most < least), "{knob:?}");
            if knob.name != "antialias" && !knob.left_out.is_empty() {
                // Their pictures take about as long as the scene's own.
                let own = Span::of(&report.rows[0].times.wall).min;
                assert!(dearest < 2.0 * own, "{budget}: {dearest} {own} {knob:?}");
            }
        }
        left.push(report.knobs.iter().map(|knob| knob.left_out.len()).sum::<usize>());
    }
    assert!(left.is_sorted_by(|a, b| a >= b) && left[0] > left[3], "{left:?}");
}

#[test]
fn what_changes_no_audited_pixel_is_not_timed() {
    // One colour: a glowing wall, and a mirror behind the camera.
    let flat = "camera { location -9*z look_at 0 } plane { -z, 0 pigment { rgb 0.5 } finish { ambient 1 diffuse 0 } }
        sphere { -20*z, 1 pigment { rgb 1 } finish { ambient 0 diffuse 0 reflection 1 } }";
    let (world, origins) = compiled(flat, 0.0);
    let (clock, whole) = (Ticking::new(1.0), 6e5);
    let options = Options { budget: whole, ..asked(160, 120) };
    let report = accuracy(&world, &origins, &options, &clock, &Unwatched).expect("measured");
    assert!(clock.wall() < 0.15 * whole, "{}", clock.wall());
    assert_eq!(report.rows.len(), 1, "nothing but the scene's own picture");
    let knob = |name| report.knobs.iter().find(|knob| knob.name == name).expect("called for");
    let antialias = knob("antialias");
    // One ray a pixel is the same work with and without a look at the neighbours.
    assert_eq!((antialias.vain.len(), antialias.settings.len()), (9, 5), "{:?}", antialias.vain);
    // Depth is the same work, ray by ray, and so are its lines.
    let depth: Vec<String> = knob("depth").lines().map(|line| line.label).collect();
    assert_eq!(depth, ["1 … 250"]);
    for (name, from, to) in [("antialias", "off", "32×32"), ("depth", "1", "250")] {
        let said = format!("{name} buys nothing here: from {from} to {to} not one of ");
        assert!(knob(name).sentence.starts_with(&said), "{}", knob(name).sentence);
    }
    let table = table::text(&report, "a.scene", 1, Width::Narrow);
    assert!(table.starts_with("keep the scene's own settings: no knob changes"), "{table}");
    assert!(
        table.contains("\n* 1 … 250 ") && table.contains("\n  the same picture: 2×2, "),
        "{table}"
    );
}

#[test]
fn of_two_lines_of_a_knob_no_two_point_at_each_other() {
    let (world, origins) = compiled(BALLS, 0.0);
    let options = Options { knobs: &KNOBS[1..3], ..asked(40, 30) };
    let clock = Ticking::new(1.0 / 1024.0);
    let report = accuracy(&world, &origins, &options, &clock, &Unwatched).expect("not stopped");
    for knob in &report.knobs {
        for setting in &knob.settings {
            let cost = |row| report.cost(row);
            match setting.verdict {
                Verdict::Tied { with } => assert!(cost(with) <= cost(setting.row)),
                Verdict::Unproven { over, .. } => assert!(cost(over) < cost(setting.row)),
                Verdict::Front | Verdict::Dominated { .. } => (),
            }
        }
    }
}

#[test]
fn of_single_runs_only_what_lies_far_apart_is_told_apart() {
    let mut report =
        svg::tests::report(&[(1.0, 0.1, 0.0), (1.06, 0.1, 0.0), (3.0, 0.1, 0.0)], &["k"], 0.0);
    let verdicts = |report: &mut Report| {
        report.judge();
        report.rows.iter().map(|row| row.verdict).collect::<Vec<_>>()
    };
    assert!(matches!(verdicts(&mut report)[1], Verdict::Dominated { by: 0, .. }));
    // The runs of the others lie 5 % apart.
    report.rows[1].times.cpu.truncate(1);
    assert_eq!(verdicts(&mut report)[1], Verdict::Tied { with: 0 });
    assert!(matches!(verdicts(&mut report)[2], Verdict::Dominated { by: 0, .. }));
    // Nothing says how far runs lie apart.
    report.rows.iter_mut().for_each(|row| row.times.cpu.truncate(1));
    assert_eq!(verdicts(&mut report)[2], Verdict::Tied { with: 0 });
}

#[test]
fn a_root_that_takes_long_to_find_costs_more_than_one_that_does_not() {
    let cost = |solid: &str| {
        let text = format!("camera {{ location -4*z look_at 0 angle 20 }} {solid}");
        let (world, origins) = compiled(&format!("{text} light_source {{ -9*z, rgb 1 }}"), 0.0);
        let options =
            PlanOptions { antialias: Antialias::Off, ..own(&world, Frame::whole(40, 30)) };
        let counted = TraceOptions { count_work: true, ..ONE_THREAD };
        let traced = trace(&world, &plan(&world, &origins, &options), &counted, &Unwatched);
        assert!(traced.counters.work.solving >= traced.counters.work.root_solves);
        knob::cost(&traced.counters) / traced.counters.camera as f64
    };
    let paint = "pigment { rgb 1 }";
    let sphere = cost(&format!("sphere {{ 0, 1 {paint} }}"));
    let torus = cost(&format!("torus {{ 0.7, 0.3 {paint} }}"));
    let stone = cost(&format!(
        "isosurface {{ function {{ x*x + y*y + z*z - 1 }} contained_by {{ box {{ -1.1, 1.1 }} }} {paint} }}"
    ));
    assert!(torus > 3.0 * sphere && stone > 5.0 * torus, "{sphere} {torus} {stone}");
    // A part of something else is paid for, too.
    let cut = cost(&format!("difference {{ torus {{ 0.7, 0.3 }} sphere {{ 0, 0.5 }} {paint} }}"));
    assert!(cut > torus, "{cut} {torus}");
}

#[test]
fn the_error_of_a_setting_is_that_of_the_picture_it_makes() {
    let (world, origins) = compiled(BALLS, 0.0);
    let options = Options { knobs: &KNOBS[..2], ..asked(24, 18) };
    let clock = Ticking::new(1.0 / 1024.0);
    let report = accuracy(&world, &origins, &options, &clock, &Unwatched).expect("not stopped");
    assert_eq!(report.audited, 432, "all of them");
    let truth = Truth::new(&world, &origins, options.frame, 3);
    for (row, antialias, depth) in [
        (0, Antialias::default(), 5),
        (report.knobs[0].settings[0].row, Antialias::Off, 5),
        (report.knobs[1].settings[1].row, Antialias::default(), 2),
    ] {
        let options = PlanOptions { antialias, depth: Some(depth), ..own(&world, options.frame) };
        let counted = TraceOptions { count_work: true, ..ONE_THREAD };
        let traced = trace(&world, &plan(&world, &origins, &options), &counted, &Unwatched);
        let exact = Metric::Rmse.of(&truth.deviations(&traced));
        let Estimate { value, low, high } = report.rows[row].errors[0];
        assert!((value / exact - 1.0).abs() < 0.1, "{antialias:?} {depth}: {value} {exact}");
        assert!(low < exact && exact < high);
        assert_eq!(report.rows[row].counters, traced.counters);
    }
    // The reference is as fine as the smallest error needs, or as fine as it gets.
    let errors = report.rows.iter().map(|row| row.errors[0].value);
    let least = errors.filter(|&error| error > 0.0).fold(f64::INFINITY, f64::min);
    assert!(4.0 * report.floors[0] <= least || report.reference_samples == 8192, "{least}");
    let rows = &report.knobs[1].settings;
    assert!(rows.iter().position(|setting| setting.is_own) == Some(3) && rows[3].label == "5");
}

#[test]
fn the_same_seed_gives_the_same_errors_whatever_the_threads() {
    let (world, origins) = compiled(BALLS, 0.4);
    let errors = |threads, seed| {
        let trace = TraceOptions::on_threads(threads);
        let options = Options { knobs: &KNOBS[1..], trace, seed, ..asked(120, 90) };
        let clock = Ticking::new(1.0 / 1024.0);
        let report = accuracy(&world, &origins, &options, &clock, &Unwatched).expect("done");
        report.rows.iter().map(|row| row.errors).collect::<Vec<_>>()
    };
    let one = errors(1, 4);
    assert_eq!(one, errors(3, 4));
    assert_ne!(one, errors(1, 5));
}

#[test]
fn a_report_becomes_a_table_a_well_formed_diagram_and_json() {
    let (world, origins) = compiled(BALLS, 0.0);
    let clock = Ticking::new(1.0 / 1024.0);
    let report =
        accuracy(&world, &origins, &asked(24, 18), &clock, &Unwatched).expect("not stopped");
    let table = table::text(&report, "a.scene", 1, Width::Wide);
    let stars: Vec<&str> = table.lines().filter(|line| line.starts_with("* ")).collect();
    assert_eq!(stars.len(), 3, "{table}");
    assert!(stars[0].contains("adaptive 0.05 8×8") && stars[1].contains("5 "), "{table}");
    // What the reference cannot resolve is no number.
    let coarse = Report { floors: [0.1; 3], ..report.clone() };
    assert_eq!(table::error(&coarse, 0), "< 0.400");
    let narrow = table::text(&coarse, "a.scene", 1, Width::Narrow);
    assert!(narrow.contains(" < 0.400 [0, 0.400] "), "{narrow}");
    assert!(narrow.lines().all(|line| line.chars().count() <= 100), "{narrow}");
    let host = json::Host {
        os: "linux".to_owned(),
        arch: "x86_64".to_owned(),
        cpu: "<fast & cheap>".to_owned(),
        cores: 2,
        threads: 1,
        version: "0".to_owned(),
    };
    let value: serde_json::Value =
        serde_json::from_str(&json::line(&report, "a.scene", &host)).expect("JSON");
    assert_eq!(value["host"]["threads"], 1);
    assert_eq!(value["rows"].as_array().map(Vec::len), Some(report.rows.len()));
    let settings = value["knobs"][1]["settings"].as_array().expect("a list");
    let own = settings.iter().find(|setting| setting["own"] == true).expect("the scene's own");
    assert_eq!(own["flag"], "--depth 5");
    let coarse: serde_json::Value =
        serde_json::from_str(&json::line(&coarse, "a.scene", &host)).expect("JSON");
    let error = &coarse["rows"][0]["errors"]["rmse"];
    assert!(error["resolved"] == false && error["low"] == 0.0 && error["high"] == 0.4, "{error}");
    let svg = svg::text(&report, "a<b>.scene", &host);
    balanced(&svg);
    svg::tests::is_legible(&svg);
    let points = report.knobs.iter().map(|knob| knob.lines().count()).sum::<usize>();
    assert_eq!(svg.matches("<g class=\"k").count(), points + report.knobs.len());
    assert!(!svg.contains("NaN") && !svg.contains("inf"));
}

/// Every element that is opened is closed, in order.
fn balanced(svg: &str) {
    let mut open = Vec::new();
    for tag in svg.split('<').skip(1) {
        let (tag, _) = tag.split_once('>').expect("closed");
        assert_eq!(tag.matches('"').count() % 2, 0, "{tag}");
        let name = tag.trim_start_matches('/').split([' ', '/']).next().expect("a name");
        if tag.starts_with('/') {
            assert_eq!(open.pop(), Some(name), "{tag}");
        } else if !tag.ends_with('/') {
            open.push(name);
        }
    }
    assert!(open.is_empty(), "{open:?}");
}

#[test]
fn a_fractal_of_fewer_iterations_is_what_it_is_with_fewer_written() {
    let picture = |written: u32, most: Option<u32>| {
        let scene = format!(
            "camera {{ location 4*z look_at 0 }} light_source {{ 9, rgb 1 }}
            julia_fractal {{ <-0.083, 0, -0.83, -0.025> max_iteration {written} pigment {{ rgb 1 }} }}"
        );
        let (world, origins) = compiled(&scene, 0.0);
        let frame = Frame::whole(24, 18);
        let antialias = Antialias::Off;
        let options = PlanOptions { antialias, julia_iterations: most, ..PlanOptions::new(frame) };
        trace(&world, &plan(&world, &origins, &options), &ONE_THREAD, &Unwatched).film
    };
    assert_eq!(picture(5, Some(2)), picture(2, None));
    assert_eq!(picture(5, Some(9)), picture(5, None));
    assert_ne!(picture(5, Some(2)), picture(5, None));
}
