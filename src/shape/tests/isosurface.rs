//! Surfaces of functions against twice the digits, where their functions have such; else against themselves,
//! looked at closely.

use std::sync::Arc;

use super::placed::{
    assert_crossed_where_it_is, assert_left_into_the_open, assert_left_where_it_is, placed,
    ray_at_placed,
};
use super::*;
use crate::function::{Binary, Builder, Function, Node, NoiseFunction, OutsideId, Unary};
use crate::math::random::tries_in;
use crate::noise::NoiseGenerator;
use crate::shape::Body;
use crate::shape::Memory;
use crate::shape::exact::Triple;
use crate::shape::isosurface::{Container, Isosurface};
use crate::shape::local::{Crossings, Local, LocalRay, Met};
use crate::texture::{Asked, Closed};

/// Operations as they are read.
pub(super) struct Formula(Builder);

impl Formula {
    pub fn number(&mut self, value: f64) -> Node {
        self.0.constant(value).expect("short")
    }

    pub fn one(&mut self, operation: Unary, a: Node) -> Node {
        self.0.unary(operation, a).expect("short")
    }

    pub fn two(&mut self, operation: Binary, a: Node, b: Node) -> Node {
        self.0.binary(operation, a, b).expect("short")
    }

    fn less(&mut self, a: Node, by: f64) -> Node {
        let by = self.number(by);
        self.two(Binary::Subtract, a, by)
    }

    fn times(&mut self, a: Node, by: f64) -> Node {
        let by = self.number(by);
        self.two(Binary::Multiply, a, by)
    }

    fn root_of_squares(&mut self, all: &[Node]) -> Node {
        let squares: Vec<Node> = all.iter().map(|a| self.one(Unary::Square, *a)).collect();
        let sum = squares.into_iter().reduce(|a, b| self.two(Binary::Add, a, b)).expect("some");
        self.one(Unary::Sqrt, sum)
    }
}

pub(super) fn function(make: impl FnOnce(&mut Formula, [Node; 3]) -> Node) -> Arc<Closed> {
    let mut formula = Formula(Builder::new(3).expect("three"));
    let axes = [0, 1, 2].map(|axis| formula.0.parameter(axis).expect("three"));
    let result = make(&mut formula, axes);
    let function: Function = formula.0.finish(result);
    Arc::new(Closed::new(function, |_| None).expect("asks nothing"))
}

fn surface(function: Arc<Closed>, container: Container) -> Isosurface {
    Isosurface {
        function,
        threshold: 0.0,
        container,
        centre: Vector::ZERO,
        scale: 1.0,
        accuracy: 1e-3,
        open: false,
        cells: Memory::default(),
    }
}

fn radius(f: &mut Formula, [x, y, z]: [Node; 3]) -> Node {
    f.root_of_squares(&[x, y, z])
}

/// A ball in a space of the author's, seen through a container that may cut it.
fn ball(random: &mut Random) -> Isosurface {
    let scale = [1.0, 0.125, 1024.0][random.below(3)];
    let centre = Vector::new(3.0, -2.0, 0.5) * [0.0, 1.0, 1024.0][random.below(3)];
    let function = function(|f, [x, y, z]| {
        let moved = [f.less(x, centre.x), f.less(y, centre.y), f.less(z, centre.z)];
        radius(f, moved)
    });
    let container = match random.below(3) {
        0 => Container::Box(Vector::ONE),
        1 => Container::Box(Vector::new(0.5, 0.75, 1.0)),
        _ => Container::Sphere(0.875),
    };
    Isosurface { threshold: 0.75 * scale, centre, scale, ..surface(function, container) }
}

fn greater(a: Double, b: Double) -> Double {
    if (a - b).0 < 0.0 { b } else { a }
}

fn within(container: Container, [x, y, z]: Triple) -> Double {
    match container {
        Container::Sphere(radius) => (x * x + y * y + z * z).sqrt() - Double::of(radius),
        Container::Box(half) => {
            let [x, y, z] = [x, y, z].map(Double::abs);
            let sides = [x - Double::of(half.x), y - Double::of(half.y), z - Double::of(half.z)];
            greater(sides[0], greater(sides[1], sides[2]))
        }
    }
}

fn of(body: &Body) -> &Isosurface {
    let Body::Isosurface(surface) = body else { panic!("{body:?}") };
    surface
}

fn in_ball(body: &Body, point: Triple) -> Double {
    let [x, y, z] = point;
    let height = (x * x + y * y + z * z).sqrt() - Double::of(0.75);
    greater(height, within(of(body).container, point))
}

#[test]
fn a_ball_as_an_isosurface_is_crossed_where_exact_arithmetic_crosses_it() {
    let mut random = Random(91);
    let mut crossed = 0;
    for _ in 0..tries_in(20) {
        let body = Body::Isosurface(ball(&mut random));
        let placed = placed(&mut random, body);
        let ray = ray_at_placed(&mut random, &placed);
        crossed += assert_crossed_where_it_is(&mut random, &placed, &ray, in_ball);
        assert_left_where_it_is(&mut random, &placed, &ray, in_ball);
    }
    assert!(crossed > tries_in(20) / 2, "{crossed}");
}

const MAJOR: f64 = 0.75;
const MINOR: f64 = 0.1875;

fn torus(f: &mut Formula, [x, y, z]: [Node; 3]) -> Node {
    let across = f.root_of_squares(&[x, y]);
    let off = f.less(across, MAJOR);
    let middle = f.root_of_squares(&[off, z]);
    f.less(middle, MINOR)
}

fn in_torus(body: &Body, point: Triple) -> Double {
    let [x, y, z] = point;
    let off = (x * x + y * y).sqrt() - Double::of(MAJOR);
    greater((off * off + z * z).sqrt() - Double::of(MINOR), within(of(body).container, point))
}

#[test]
fn a_torus_as_an_isosurface_is_crossed_where_exact_arithmetic_crosses_it() {
    let mut random = Random(92);
    let mut crossed = 0;
    for _ in 0..tries_in(20) {
        let container = [Container::Sphere(1.0), Container::Box(Vector::new(1.0, 0.5, 0.25))];
        let body = Body::Isosurface(surface(function(torus), container[random.below(2)]));
        let placed = placed(&mut random, body);
        let ray = ray_at_placed(&mut random, &placed);
        crossed += assert_crossed_where_it_is(&mut random, &placed, &ray, in_torus);
        assert_left_into_the_open(&mut random, &placed, &ray, in_torus);
    }
    assert!(crossed > tries_in(20) / 2, "{crossed}");
}

pub(super) fn line(random: &mut Random) -> LocalRay<'static> {
    let direction = random.direction().get();
    let across = random.direction().get().cross(direction) * random.number(0.0, 0.9);
    LocalRay {
        nearest: across,
        direction,
        blur: 1e-16,
        turn: 1e-16,
        tolerance: 0.0,
        in_world: None,
    }
}

fn met(surface: &Isosurface, ray: &LocalRay) -> Vec<Met> {
    let mut found = Crossings::new();
    surface.crossings(ray, &mut found);
    found.to_vec()
}

fn gyroid(f: &mut Formula, axes: [Node; 3]) -> Node {
    let [x, y, z] = axes.map(|a| f.times(a, 12.0));
    let mut term = |a: Node, b: Node| {
        let (sine, cosine) = (f.one(Unary::Sin, a), f.one(Unary::Cos, b));
        f.two(Binary::Multiply, sine, cosine)
    };
    let terms = [term(x, y), term(y, z), term(z, x)];
    let sum = f.two(Binary::Add, terms[0], terms[1]);
    f.two(Binary::Add, sum, terms[2])
}

/// Everywhere along the line the crossings before say whether it is inside.
fn assert_told_everywhere(surface: &Isosurface, ray: &LocalRay, all: &[Met], places: usize) {
    for i in 0..places {
        let s = 2.0 * (i as f64 + 0.5) / places as f64 - 1.0;
        if all.iter().any(|met| (met.t - s).abs() <= met.error + 1e-9) {
            continue;
        }
        let passed = all.iter().filter(|met| met.t < s).count();
        assert_eq!(surface.contains(ray.at(s)), passed % 2 == 1, "at {s}: {all:?} {ray:?}");
    }
}

#[test]
fn a_gyroid_is_inside_wherever_its_crossings_say() {
    let mut random = Random(93);
    let surface = surface(function(gyroid), Container::Sphere(1.0));
    let mut crossed = 0;
    for _ in 0..tries_in(100) {
        let ray = line(&mut random);
        let all = met(&surface, &ray);
        assert!(all.iter().all(|met| met.error < 1e-6), "{all:?} {ray:?}");
        assert!(all.iter().enumerate().all(|(i, met)| met.leaving == (i % 2 == 1)), "{all:?}");
        assert_told_everywhere(&surface, &ray, &all, 2_000);
        crossed += all.len();
    }
    assert!(crossed > 4 * tries_in(100), "{crossed}");
}

/// What is below noise, with the function of `noise` and its arguments after the point.
fn below(noise: NoiseFunction, arguments: &[f64]) -> Arc<Closed> {
    let mut formula = Formula(Builder::new(3).expect("three"));
    let [x, y, z] = [0, 1, 2].map(|axis| formula.0.parameter(axis).expect("three"));
    let mut asked = [x, y, z].map(|a| formula.times(a, 2.0)).to_vec();
    asked.extend(arguments.iter().map(|argument| formula.number(*argument)));
    let noise_there = formula.0.ask(OutsideId(0), &asked).expect("short");
    let height = formula.times(noise_there, 0.5);
    let result = formula.two(Binary::Subtract, y, height);
    let asked = Asked::Noise { function: noise, generator: NoiseGenerator::RangeCorrected };
    let function = formula.0.finish(result);
    Arc::new(Closed::new(function, |_| Some(asked.clone())).expect("noise"))
}

#[test]
fn landscapes_of_noise_are_inside_wherever_their_crossings_say() {
    let mut random = Random(98);
    let functions = [
        below(NoiseFunction::Noise3d, &[]),
        below(NoiseFunction::Ridged, &[0.9, 2.0, 4.0, 1.0, 2.0, 2.0]),
        below(NoiseFunction::Hetero, &[0.8, 2.2, 3.0, 0.5, 0.6, 2.0]),
        below(NoiseFunction::Generator, &[3.0]),
    ];
    let mut crossed = 0;
    for function in functions {
        let surface = surface(function, Container::Box(Vector::ONE));
        for _ in 0..tries_in(200) {
            let ray = line(&mut random);
            let all = met(&surface, &ray);
            assert!(all.iter().enumerate().all(|(i, met)| met.leaving == (i % 2 == 1)), "{all:?}");
            assert_told_everywhere(&surface, &ray, &all, 1_000);
            // The first of them is found alone, from anywhere.
            let from = random.number(-1.0, 1.0);
            let mut first = Crossings::new();
            surface.first_crossings(&ray, (from, f64::INFINITY), &mut first);
            let next = |all: &[Met]| all.iter().find(|met| met.t > from + 1e-6).map(|met| met.t);
            let is_same = match (next(&all), next(&first)) {
                (Some(one), Some(other)) => (one - other).abs() < 1e-7,
                (one, other) => one == other,
            };
            assert!(is_same, "{from}: {all:?} {first:?} {ray:?}");
            crossed += all.len();
        }
    }
    assert!(crossed > tries_in(200), "{crossed}");
}

#[test]
fn a_skin_of_a_billionth_is_entered_and_left_twice_and_no_slope_is_too_steep() {
    let mut random = Random(94);
    let thin = function(|f, axes| {
        let radius = radius(f, axes);
        let off = f.less(radius, 0.75);
        let off = f.one(Unary::Abs, off);
        f.less(off, 1e-9)
    });
    let steep = function(|f, axes| {
        let radius = radius(f, axes);
        let off = f.less(radius, 0.75);
        let steep = f.times(off, 1e12);
        f.one(Unary::Atan, steep)
    });
    let jump = function(|f, axes| {
        let radius = radius(f, axes);
        let most = f.number(0.75);
        let beyond = f.two(Binary::Less, most, radius);
        f.less(beyond, 0.5)
    });
    for _ in 0..tries_in(20) {
        let ray = line(&mut random);
        let distance = ray.nearest.length();
        let half = |radius: f64| (radius * radius - distance * distance).sqrt();
        if (distance - 0.75).abs() < 1e-6 {
            continue;
        }
        let places = if distance < 0.75 { half(0.75) } else { f64::NAN };
        let skin = met(&surface(thin.clone(), Container::Sphere(0.95)), &ray);
        let expected: &[f64] = &[-1e-9, 1e-9].map(|off| half(0.75 + off));
        assert_eq!(skin.len(), if distance < 0.75 { 4 } else { 0 }, "{distance}: {skin:?}");
        for (met, exact) in skin.iter().skip(2).zip(expected) {
            assert!((met.t - exact).abs() <= met.error + 1e-15, "{exact}: {skin:?}");
            assert!(met.error < 1e-10);
        }
        for function in [&steep, &jump] {
            let all = met(&surface(function.clone(), Container::Sphere(0.95)), &ray);
            assert_eq!(all.len(), if distance < 0.75 { 2 } else { 0 }, "{distance}: {all:?}");
            for (met, way) in all.iter().zip([-1.0, 1.0]) {
                assert!((met.t - way * places).abs() <= met.error, "{places} {all:?}");
                assert!(met.error * half(0.75) < 1e-10, "{all:?} {distance}");
            }
        }
    }
}

#[test]
fn an_open_isosurface_ends_where_nothing_is_seen_and_a_closed_one_at_its_container() {
    let bar = |open| Isosurface {
        open,
        ..surface(
            function(|f, [x, y, _]| {
                let across = f.root_of_squares(&[x, y]);
                f.less(across, 0.25)
            }),
            Container::Box(Vector::ONE),
        )
    };
    let along = LocalRay {
        nearest: Vector::X * 0.125,
        direction: Vector::Z,
        blur: 0.0,
        turn: 0.0,
        tolerance: 0.0,
        in_world: None,
    };
    let seen =
        |open| met(&bar(open), &along).iter().map(|met| (met.t, met.is_seen())).collect::<Vec<_>>();
    assert_eq!(seen(true), [(-1.0, false), (1.0, false)]);
    assert_eq!(seen(false), [(-1.0, true), (1.0, true)]);
    let across = LocalRay { nearest: Vector::Z * 0.125, direction: Vector::Y, ..along };
    assert!(met(&bar(true), &across).iter().all(Met::is_seen));
}

/// Through the middle.
const ALONG_X: LocalRay = LocalRay {
    nearest: Vector::ZERO,
    direction: Vector::X,
    blur: 1e-16,
    turn: 1e-16,
    tolerance: 0.0,
    in_world: None,
};

#[test]
fn what_is_undefined_is_no_surface_and_stops_no_search() {
    // √(x) − 0.5, which is no number where x < 0; and what is zero throughout.
    let half = function(|f, [x, ..]| {
        let root = f.one(Unary::Sqrt, x);
        f.less(root, 0.5)
    });
    let all = met(&surface(half, Container::Box(Vector::ONE)), &ALONG_X);
    assert!((all.last().expect("left").t - 0.25).abs() < 1e-12, "{all:?}");
    let zero = function(|f, [x, ..]| f.times(x, 0.0));
    assert!(met(&surface(zero, Container::Box(Vector::ONE)), &ALONG_X).is_empty());
}

#[test]
fn a_surface_touching_its_container_from_inside_is_whole() {
    let touching = surface(
        function(|f, axes| {
            let radius = radius(f, axes);
            f.less(radius, 1.0)
        }),
        Container::Box(Vector::ONE),
    );
    let all = met(&touching, &ALONG_X);
    assert_eq!(all.len(), 2, "{all:?}");
    assert!(
        all.iter().all(|met| (met.t.abs() - 1.0).abs() <= met.error && met.error < 1e-12),
        "{all:?}"
    );
}
