//! Fractals of four dimensions against twice the digits, and of those that go through functions that have no
//! more digits, where they are far from a tie.

use super::placed::{assert_crossed_where_it_is, assert_left_into_the_open, placed, ray_at_placed};
use super::*;
use crate::math::elementary::pow;
use crate::shape::exact::Triple;
use crate::shape::julia_fractal::{Algebra, Function};
use crate::shape::local::{Crossings, Local, LocalRay};
use crate::shape::{Body, JuliaFractal};

fn product(a: [Double; 4], b: [Double; 4]) -> [Double; 4] {
    let ([a, b, c, d], [e, f, g, h]) = (a, b);
    [
        a * e - b * f - c * g - d * h,
        a * f + b * e + c * h - d * g,
        a * g - b * h + c * e + d * f,
        a * h + b * g - c * f + d * e,
    ]
}

/// The farthest square less that of the radius; over what the map may have grown by.
fn inside(body: &Body, point: Triple) -> Double {
    let Body::JuliaFractal(fractal) = body else { panic!("{body:?}") };
    let [x, y, z] = point;
    let exact = |number: f64| Double::of(number);
    let [a, b, c, d] = fractal.normal.map(exact);
    let w = (exact(fractal.distance) - a * x - b * y - c * z) / d;
    let mut h = [x, y, z, w];
    let radius = exact(fractal.radius());
    let mut farthest = exact(-f64::INFINITY);
    for _ in 0..fractal.iterations {
        let squared = h.into_iter().fold(exact(0.0), |sum, part| sum + part * part);
        let beyond = squared - radius * radius;
        if beyond.0 > farthest.0 {
            farthest = beyond;
        }
        // Farther out numbers soon have no size.
        if beyond.0 > 1e6 {
            break;
        }
        let power = match fractal.algebra {
            Algebra::Quaternion { is_cube: false } => product(h, h),
            Algebra::Quaternion { is_cube: true } => product(product(h, h), h),
            Algebra::Hypercomplex(_) => panic!("no digits"),
        };
        h = std::array::from_fn(|i| power[i] + exact(fractal.parameter[i]));
    }
    farthest * exact(pow(0.5 / radius.0, f64::from(fractal.iterations - 1)))
}

fn any_slice(random: &mut Random) -> ([f64; 4], f64) {
    let mut normal = [(); 4].map(|()| random.number(-1.0, 1.0));
    match random.below(2) {
        0 => normal = [0.0, 0.0, 0.0, 1.0],
        _ => normal[3] += normal[3].signum(),
    }
    let length = normal.iter().map(|part| part * part).sum::<f64>().sqrt();
    (normal.map(|part| part / length), random.number(-0.3, 0.3))
}

fn any_quaternion(random: &mut Random, iterations: u32) -> JuliaFractal {
    let (normal, distance) = any_slice(random);
    JuliaFractal {
        parameter: [(); 4].map(|()| random.number(-0.6, 0.6)),
        algebra: Algebra::Quaternion { is_cube: random.below(2) == 1 },
        iterations,
        normal,
        distance,
    }
}

#[test]
fn a_fractal_of_quaternions_is_crossed_where_exact_arithmetic_crosses_it() {
    let mut random = Random(141);
    let mut crossed = 0;
    for _ in 0..tries_in(60) {
        let iterations = 1 + random.below(6) as u32;
        let body = any_quaternion(&mut random, iterations);
        let placed = placed(&mut random, Body::JuliaFractal(body));
        let ray = ray_at_placed(&mut random, &placed);
        crossed += assert_crossed_where_it_is(&mut random, &placed, &ray, inside);
        assert_left_into_the_open(&mut random, &placed, &ray, inside);
    }
    assert!(crossed > tries_in(100), "{crossed}");
}

const FUNCTIONS: [Function; 18] = [
    Function::Sqr,
    Function::Cube,
    Function::Exp,
    Function::Reciprocal,
    Function::Sin,
    Function::Asin,
    Function::Sinh,
    Function::Asinh,
    Function::Cos,
    Function::Acos,
    Function::Cosh,
    Function::Acosh,
    Function::Tan,
    Function::Atan,
    Function::Tanh,
    Function::Atanh,
    Function::Ln,
    Function::Pwr([2.0, 0.5]),
];

#[test]
fn of_every_function_the_crossings_before_a_place_say_whether_it_is_inside() {
    let mut random = Random(142);
    for _ in 0..tries_in(40 * FUNCTIONS.len()) {
        for function in FUNCTIONS {
            let (normal, distance) = any_slice(&mut random);
            let body = JuliaFractal {
                parameter: [(); 4].map(|()| random.number(-0.6, 0.6)),
                algebra: Algebra::Hypercomplex(function),
                iterations: 1 + random.below(4) as u32,
                normal,
                distance,
            };
            let direction = random.direction().get();
            let aside = random.direction().get() * random.number(0.0, 2.0);
            let nearest = aside - direction * aside.dot(direction);
            let blur = 16.0 * EPS;
            let ray =
                LocalRay { nearest, direction, blur, turn: EPS, tolerance: 0.0, in_world: None };
            let mut all = Crossings::new();
            body.crossings(&ray, &mut all);
            let (mut wrong, mut looked) = (0, 0);
            for _ in 0..64 {
                let s = random.number(-4.5, 4.5);
                if all.iter().any(|met| (met.t - s).abs() <= met.error + 1e-3) {
                    continue;
                }
                looked += 1;
                let before = all.iter().filter(|met| met.t < s).count();
                wrong += usize::from(body.contains(ray.at(s)) != (before % 2 == 1));
            }
            // Beside cuts and poles threads are finer than a line is looked at.
            assert!(8 * wrong <= looked, "{wrong} of {looked}: {body:?} {ray:?} {all:?}");
        }
    }
}

#[test]
fn without_a_parameter_quaternions_whose_squares_stay_are_a_ball() {
    let ball = |distance: f64| JuliaFractal {
        parameter: [0.0; 4],
        algebra: Algebra::Quaternion { is_cube: false },
        iterations: 12,
        normal: [0.0, 0.0, 0.0, 1.0],
        distance,
    };
    for (distance, radius) in [(0.0, 1.0), (0.6, 0.8)] {
        let ray = LocalRay {
            nearest: Vector::ZERO,
            direction: Vector::new(0.6, 0.0, 0.8),
            blur: EPS,
            turn: EPS,
            tolerance: 0.0,
            in_world: None,
        };
        let mut all = Crossings::new();
        ball(distance).crossings(&ray, &mut all);
        let [enter, leave] = all[..] else { panic!("{all:?}") };
        assert!((enter.t + radius).abs() <= enter.error && enter.error < 1e-13, "{enter:?}");
        assert!((leave.t - radius).abs() <= leave.error && leave.error < 1e-13, "{leave:?}");
        assert!(leave.leaving && !enter.leaving);
    }
}

#[test]
fn a_slice_that_is_told_to_be_beyond_a_fractal_is_met_by_no_line() {
    let mut random = Random(83);
    for distance in [0.0, 1.7, 2.0 + 1e-12, 9.0] {
        for _ in 0..tries_in(50) {
            let body = JuliaFractal { distance, ..any_quaternion(&mut random, 3) };
            assert_eq!(body.is_beyond(), distance > body.radius(), "{body:?}");
            let mut all = Crossings::new();
            body.crossings(&super::isosurface::line(&mut random), &mut all);
            assert!(all.is_empty() || !body.is_beyond(), "{body:?} {all:?}");
        }
    }
}
