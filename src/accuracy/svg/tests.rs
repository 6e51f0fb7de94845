//! What a diagram shows, read back from its text.

use super::*;
use crate::accuracy::statistics::Estimate;
use crate::accuracy::{Cut, KNOBS, Row, Setting, Times, Tried};
use crate::math::elementary::pow;
use crate::math::random::{Random, long};
use crate::plan::Frame;
use crate::trace::Counters;

fn host() -> Host {
    Host {
        os: "linux".to_owned(),
        arch: "x86_64".to_owned(),
        cpu: "A Processor With a Name as Long as They Come, With Cores @ 3.14 GHz".to_owned(),
        cores: 2,
        threads: 2,
        version: "0.1.0".to_owned(),
    }
}

/// A number that `element` says of itself.
fn number_of(element: &str, name: &str) -> Option<f64> {
    let (_, rest) = element.split_once(&format!(" {name}=\""))?;
    rest.split('"').next()?.parse().ok()
}

/// The box of every text, as its class and anchor have it.
fn texts(svg: &str) -> Vec<(String, Rectangle)> {
    let mut all = Vec::new();
    for element in svg.split("<text").skip(1) {
        let (head, rest) = element.split_once('>').expect("an element");
        let text = rest.split("</text>").next().expect("its end");
        let text = text.replace("&lt;", "<").replace("&gt;", ">").replace("&amp;", "&");
        let class = head.split("class=\"").nth(1).and_then(|c| c.split('"').next()).unwrap_or("");
        let size = match class {
            "" => TEXT,
            "big" => BIG,
            "small dim" | "label" => SMALL,
            other => panic!("{other}"),
        };
        let side = match head.split("text-anchor=\"").nth(1).and_then(|a| a.split('"').next()) {
            None => Start,
            Some("middle") => Middle,
            Some("end") => End,
            Some(other) => panic!("{other}"),
        };
        let place = number_of(head, "x").zip(number_of(head, "y"));
        let found = match place {
            Some(place) => text_box(&text, size, side, place),
            None => {
                // The one that stands upright: turned about its place.
                let (_, place) = head.split_once("translate(").expect("a place");
                let (place, _) = place.split_once(')').expect("its end");
                let (x, y) = place.split_once(' ').expect("two numbers");
                let (x, y): (f64, f64) = (x.parse().expect("one"), y.parse().expect("one"));
                let flat = text_box(&text, size, side, (0.0, 0.0));
                let (left, right) = (x + flat.top, x + flat.bottom);
                Rectangle { left, right, top: y - flat.right, bottom: y - flat.left }
            }
        };
        all.push((text, found));
    }
    all
}

/// The box of every marker and ring.
fn markers(svg: &str) -> Vec<Rectangle> {
    let mut all = Vec::new();
    for circle in svg.split("<circle").skip(1) {
        let of = |name| number_of(circle, name).expect("a number");
        all.push(Rectangle::about((of("cx"), of("cy")), of("r")));
    }
    for square in svg.split("<rect").skip(1).filter(|rect| rect.contains("width=\"7.6\"")) {
        let of = |name| number_of(square, name).expect("a number");
        all.push(Rectangle::about((of("x") + 3.8, of("y") + 3.8), 3.8));
    }
    for path in svg.split(" d=\"M").skip(1).filter(|path| path.contains('z')) {
        let path = path.split('z').next().expect("its end");
        let start = path.find(['l', 'h']).expect("a place");
        let (x, y) = path[..start].split_once(' ').expect("two numbers");
        let (mut x, mut y): (f64, f64) = (x.parse().expect("one"), y.parse().expect("one"));
        let mut all_of_it = Rectangle { left: x, right: x, top: y, bottom: y };
        // Of `l4.8 8.4h-9.6`, step by step.
        let spaced = path[start..].replace('-', " -").replace(['l', 'h', 'v'], " ");
        let mut numbers = spaced.split_whitespace().map(|n| n.parse::<f64>().expect("a number"));
        let mut step = |kind: char| match kind {
            'h' => (numbers.next().expect("one"), 0.0),
            'v' => (0.0, numbers.next().expect("one")),
            _ => (numbers.next().expect("one"), numbers.next().expect("two")),
        };
        let pairs = path[start..].matches(['l', 'h', 'v']).flat_map(|kind| kind.chars());
        for kind in pairs {
            let (dx, dy) = step(kind);
            (x, y) = (x + dx, y + dy);
            all_of_it.left = all_of_it.left.min(x);
            all_of_it.right = all_of_it.right.max(x);
            all_of_it.top = all_of_it.top.min(y);
            all_of_it.bottom = all_of_it.bottom.max(y);
        }
        all.push(all_of_it);
    }
    all
}

/// Every text inside the page, none over another, none over a marker.
#[track_caller]
pub fn is_legible(svg: &str) {
    let (texts, markers) = (texts(svg), markers(svg));
    let page = Rectangle { left: 0.0, top: 0.0, right: WIDTH, bottom: HEIGHT };
    for (i, (text, place)) in texts.iter().enumerate() {
        assert!(page.holds(place), "{text} leaves the page: {place:?}");
        for (other, at) in &texts[..i] {
            assert!(!place.meets(at), "{text} over {other}\n{svg}");
        }
        assert!(!markers.iter().any(|marker| marker.meets(place)), "{text} covers one\n{svg}");
    }
}

/// How many points of the front have their name beside them.
fn named(svg: &str) -> usize {
    svg.matches("<text class=\"label\"").count()
}

/// A report of some knobs whose rows are as given: seconds, error, half its interval.
pub(in crate::accuracy) fn report(
    rows: &[(f64, f64, f64)],
    knobs: &[&'static str],
    floor: f64,
) -> Report {
    let rows: Vec<Row> = rows
        .iter()
        .enumerate()
        .map(|(i, &(seconds, value, half))| {
            let counters = Counters { camera: (seconds * 1e6) as u64, ..Counters::default() };
            let estimate = Estimate { value, low: value - half, high: value + half };
            let cpu = vec![seconds, 1.02 * seconds, 1.05 * seconds];
            Row {
                name: i.to_string(),
                times: Times { wall: cpu.clone(), cpu },
                counters,
                factor: 1.0,
                errors: [estimate; 3],
                verdict: Verdict::Front,
                colors: vec![[value; 3]],
                resamples: vec![value - half / 2.0, value + half / 2.0],
            }
        })
        .collect();
    let tried = |(number, &name): (usize, &&'static str)| {
        let mine = (0..rows.len()).filter(|row| *row == 0 || row % knobs.len() == number);
        let setting = |row: usize| Setting {
            label: if row == 0 {
                "own".to_owned()
            } else {
                format!("adaptive 0.0{row} {row}×{row}")
            },
            flag: String::new(),
            is_own: row == 0,
            row,
            verdict: Verdict::Front,
        };
        let settings: Vec<Setting> = mine.map(setting).collect();
        let label =
            |setting: Option<&Setting>| setting.map(|s| s.label.clone()).unwrap_or_default();
        let ends = [label(settings.first()), label(settings.last())];
        let (vain, left_out) = (Vec::new(), Vec::new());
        Tried { name, ends, settings, vain, left_out, sentence: String::new() }
    };
    let knobs = knobs.iter().enumerate().map(tried).collect();
    let mut report = Report {
        frame: Frame::whole(640, 480),
        metric: Metric::Rmse,
        seed: 1,
        audited: 4800,
        cut: Cut::default(),
        reference_samples: 512,
        floors: [floor; 3],
        knobs,
        idle: Vec::new(),
        rows,
    };
    report.judge();
    report
}

const FOUR: [&str; 4] = ["antialias", "depth", "adc-bailout", "root-tolerance"];

#[test]
fn a_crowd_of_points_leaves_every_text_legible() {
    let mut random = Random(21);
    for _ in 0..60 * long() {
        let count = 1 + random.below(30);
        let (times, errors) = (random.number(0.0, 4.0), random.number(0.0, 5.0));
        // Errors fall as time rises, more or less, so that many are on the front.
        let noise = [0.0, 0.02, 0.4][random.below(3)];
        let mut rows = Vec::new();
        for i in 0..count {
            let part = i as f64 / count as f64;
            let seconds = 0.1 * pow(10.0, times * part + random.number(0.0, noise));
            let error = 0.3 * pow(10.0, -errors * part + random.number(0.0, noise));
            rows.push((seconds, error, error * random.number(0.0, 0.5)));
        }
        let floor = [0.0, 0.001, 0.05][random.below(3)];
        let knobs =
            &["antialias", "depth", "adc-bailout", "root-tolerance", "radiosity", "photons"];
        let report = report(&rows, &knobs[..1 + random.below(6)], floor);
        is_legible(&text(&report, "scenes/gallery/first.scene", &host()));
    }
}

#[test]
fn a_usual_front_has_every_name() {
    // The first picture's: antialiasing from one ray to 36.
    let rows = [
        (1.2, 0.0089, 0.0008),
        (0.128, 0.037, 0.002),
        (0.49, 0.016, 0.001),
        (0.57, 0.0142, 0.001),
        (1.07, 0.0101, 0.001),
        (1.84, 0.0070, 0.0005),
        (4.07, 0.0042, 0.0003),
    ];
    let report = report(&rows, &FOUR[..1], 0.0);
    let front = report.rows.iter().filter(|row| row.verdict == Verdict::Front).count();
    let svg = text(&report, "first.scene", &host());
    assert!(front >= 6);
    assert_eq!(named(&svg), front, "{svg}");
    is_legible(&svg);
}

#[test]
fn a_front_in_one_corner_and_a_name_too_long_stay_on_the_page() {
    for (seconds, error) in [(0.1, 0.1), (10.0, 1e-4), (0.1, 1e-4), (10.0, 0.1)] {
        let mut rows = vec![(1.0, 0.01, 0.0), (0.1, 0.1, 0.0), (10.0, 1e-4, 0.0)];
        rows.extend((0..5).map(|i| (seconds * (1.0 + 0.01 * f64::from(i)), error, 0.0)));
        let file = "a_scene_with_a_name_that_no_page_is_wide_enough_for".repeat(4);
        let svg = text(&report(&rows, &FOUR, 0.0), &file, &host());
        is_legible(&svg);
        assert!(svg.contains('…'));
    }
}

#[test]
fn what_the_reference_cannot_resolve_is_an_open_marker_whose_interval_ends_at_the_bottom() {
    let svg =
        text(&report(&[(1.0, 0.01, 0.001), (2.0, 1e-4, 5e-5)], &FOUR[..1], 1e-3), "a", &host());
    assert_eq!(svg.matches("class=\"open\"").count(), 1, "{svg}");
    let group = svg.split("<g ").find(|group| group.contains("class=\"open\"")).expect("there");
    assert!(group.contains("&lt; 0.00400"), "{group}");
    assert!(number_of(group, "y1").is_some_and(|low| low == BOTTOM), "{group}");
    is_legible(&svg);
}

#[test]
fn the_path_goes_down_as_time_goes_on_and_its_points_are_the_front() {
    let rows =
        [(1.0, 0.1, 0.0), (2.0, 0.2, 0.0), (4.0, 0.05, 0.0), (5.0, 0.05, 0.0), (9.0, 0.01, 0.0)];
    let report = report(&rows, &FOUR[..2], 0.0);
    let diagram = Diagram::new(&report);
    assert_eq!(diagram.standing, [0, 2, 4]);
    let path = diagram.path();
    assert_eq!(path.len(), 5);
    assert!(path.windows(2).all(|ends| ends[0].0 <= ends[1].0 && ends[0].1 <= ends[1].1));
    assert!(diagram.standing.iter().all(|&row| path.contains(&diagram.place(row))));
}

#[test]
fn no_point_lies_left_of_the_path_and_below_whatever_clock_and_counters_say() {
    let mut random = Random(23);
    for _ in 0..200 * long() {
        let mut some = |least: f64, most: f64| random.number(least, most);
        let rows: Vec<_> =
            (0..12).map(|_| (some(1.0, 2.0), some(0.01, 0.02), some(0.0, 0.004))).collect();
        let mut report = report(&rows, &FOUR, 0.0);
        report.rows.iter_mut().for_each(|row| row.counters.camera = some(1e6, 2e6) as u64);
        report.judge();
        let diagram = Diagram::new(&report);
        let path = diagram.path();
        for row in 0..rows.len() {
            let (x, y) = diagram.place(row);
            let below = path.iter().all(|&(at, least)| at > x || least < y);
            assert!(!below, "{row} at {x} {y}: {path:?}");
        }
    }
}

#[test]
fn no_two_knobs_have_the_same_shape() {
    let shape = |number| {
        let marker = marker(number, 0.0, 0.0, "");
        marker.split(['"', '<']).map(str::trim).collect::<Vec<_>>().join(" ")
    };
    let shapes: std::collections::BTreeSet<String> = (0..KNOBS.len()).map(shape).collect();
    assert_eq!(shapes.len(), KNOBS.len());
}

#[test]
fn text_of_the_author_is_escaped() {
    assert_eq!(escaped("a<b & \"c\">"), "a&lt;b &amp; &quot;c&quot;&gt;");
}
