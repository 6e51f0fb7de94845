//! Surfaces of u and v against the balls and planes that they are.

use std::f64::consts::PI;

use super::isosurface::{function, line};
use super::*;
use crate::function::{Binary, Unary};
use crate::math::random::tries_in;
use crate::shape::Parametric;
use crate::shape::body::{Crossings, Local, LocalRay, Met};
use crate::shape::isosurface::Container;

/// Of radius ½ around the origin.
fn ball() -> Parametric {
    let x = function(|f, [u, v, _]| {
        let (sine, cosine) = (f.one(Unary::Sin, v), f.one(Unary::Cos, u));
        let (half, product) = (f.number(0.5), f.two(Binary::Multiply, sine, cosine));
        f.two(Binary::Multiply, half, product)
    });
    let y = function(|f, [u, v, _]| {
        let (sine, cosine) = (f.one(Unary::Sin, v), f.one(Unary::Sin, u));
        let (half, product) = (f.number(0.5), f.two(Binary::Multiply, sine, cosine));
        f.two(Binary::Multiply, half, product)
    });
    let z = function(|f, [_, v, _]| {
        let (half, cosine) = (f.number(0.5), f.one(Unary::Cos, v));
        f.two(Binary::Multiply, half, cosine)
    });
    let corners = [[0.0, 0.0], [2.0 * PI, PI]];
    Parametric::new([x, y, z], corners, Container::Box(Vector::ONE), Vector::ZERO, 1.0)
}

fn met(surface: &Parametric, ray: &LocalRay) -> Vec<Met> {
    let mut found = Crossings::new();
    surface.crossings(ray, &mut found);
    found.to_vec()
}

#[test]
fn a_ball_of_longitudes_is_crossed_where_the_ball_is() {
    let mut random = Random(97);
    let ball = ball();
    let mut crossed = 0;
    for _ in 0..tries_in(50) {
        let ray = line(&mut random);
        let miss = ray.nearest.length();
        // Nearer to a touch, rounding tells no two crossings.
        if (miss - 0.5).abs() < 1e-9 {
            continue;
        }
        let all = met(&ball, &ray);
        let half = (0.25 - miss * miss).sqrt();
        assert_eq!(all.len(), if miss < 0.5 { 2 } else { 0 }, "{miss} {all:?} {ray:?}");
        for (met, way) in all.iter().zip([-1.0, 1.0]) {
            assert!((met.t - way * half).abs() <= met.error + 1e-15, "{half} {all:?} {ray:?}");
            assert!(met.error * half < 1e-12, "{half} {all:?}");
            let height = ball.height(met.part, ray.at(met.t));
            assert!(height.value.abs() < 1e-9, "{height:?} {met:?}");
            let out = ray.at(met.t).normalize();
            assert!(height.gradient.dot(out).abs() > 1.0 - 1e-6, "{height:?} {out}");
            // ∂u × ∂v goes inward.
            assert_eq!(met.leaving, out.dot(ray.direction) < 0.0, "{met:?}");
        }
        crossed += all.len();
    }
    assert!(crossed > tries_in(50) / 2, "{crossed}");
}

#[test]
fn a_sheet_ends_where_its_rectangle_and_its_container_do() {
    let sheet = |container| {
        let x = function(|_, [u, ..]| u);
        let y = function(|_, [_, v, _]| v);
        let z = function(|f, _| f.number(0.25));
        let corners = [[-0.5, -0.5], [0.5, 0.5]];
        Parametric::new([x, y, z], corners, container, Vector::ZERO, 1.0)
    };
    let at = |x: f64, y: f64| LocalRay {
        nearest: Vector::new(x, y, 0.0),
        direction: Vector::Z,
        blur: 1e-16,
        turn: 1e-16,
        tolerance: 0.0,
        in_world: None,
    };
    let whole = sheet(Container::Box(Vector::ONE));
    let found = met(&whole, &at(0.3, -0.49));
    assert!(found.len() == 1 && (found[0].t - 0.25).abs() <= found[0].error, "{found:?}");
    // Where four parts of the rectangle meet.
    assert_eq!(met(&whole, &at(0.0, 0.0)).len(), 1);
    assert!(met(&whole, &at(0.51, 0.0)).is_empty());
    let cut = sheet(Container::Sphere(0.5));
    assert_eq!(met(&cut, &at(0.4, 0.0)).len(), 1);
    assert!(met(&cut, &at(0.45, 0.0)).is_empty());
}
