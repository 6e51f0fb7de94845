//! Surfaces of u and v against the balls and planes that they are.

use std::f64::consts::PI;

use super::isosurface::{Formula, function, line};
use super::*;
use crate::function::{Binary, Node, Unary};
use crate::math::random::tries_in;
use crate::shape::Parametric;
use crate::shape::isosurface::Container;
use crate::shape::local::{Crossings, Local, LocalRay, Met};

/// Of radius ½ around the origin.
fn ball() -> Parametric {
    ball_in(Container::Box(Vector::ONE), Vector::ZERO)
}

fn ball_in(container: Container, centre: Vector) -> Parametric {
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
    Parametric::new([x, y, z], corners, container, centre, 1.0)
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

/// Of one that is as far beside the origin as `nearest`.
fn toward(nearest: Vector, direction: Vector) -> LocalRay<'static> {
    LocalRay {
        nearest,
        direction: direction.normalize(),
        blur: 1e-16,
        turn: 1e-16,
        tolerance: 0.0,
        in_world: None,
    }
}

/// Where a line crosses a surface, of which no more than so many parts were looked at.
fn met_in(looks: usize, surface: &Parametric, ray: &LocalRay) -> Vec<Met> {
    let looked = surface.parts_looked_at(ray);
    assert!(looked <= looks, "{looked} parts for {ray:?}");
    met(surface, ray)
}

fn over([x, y, z]: [fn(&mut Formula, [Node; 3]) -> Node; 3], corners: [[f64; 2]; 2]) -> Parametric {
    let functions = [function(x), function(y), function(z)];
    Parametric::new(functions, corners, Container::Box(Vector::ONE), Vector::ZERO, 1.0)
}

#[test]
fn a_touch_is_told_in_some_hundred_looks_and_beside_it_rightly() {
    let mut random = Random(98);
    let ball = ball();
    for _ in 0..tries_in(500) {
        let out = random.direction().get();
        let direction = out.cross(random.direction().get()).normalize();
        for off in [0.0, 1e-16, 1e-13, 1e-10, 1e-6, 1e-3] {
            for beside in [0.5 - off, 0.5 + off] {
                let ray = toward(out * beside, direction);
                let all = met_in(2000, &ball, &ray);
                let miss = ray.nearest.length();
                if off < 5e-14 {
                    continue;
                }
                assert_eq!(all.len(), if miss < 0.5 { 2 } else { 0 }, "{off} {all:?} {ray:?}");
                let half = (0.25 - miss * miss).max(0.0).sqrt();
                for (met, way) in all.iter().zip([-1.0, 1.0]) {
                    assert!((met.t - way * half).abs() <= met.error + 1e-15 / half, "{all:?}");
                }
            }
        }
    }
}

#[test]
fn a_line_through_a_pole_meets_it_once_and_one_that_touches_it_misses() {
    let ball = ball();
    for direction in [Vector::Z, -Vector::Z] {
        let all = met_in(5000, &ball, &toward(Vector::ZERO, direction));
        assert!(all.len() == 2 && !all[1].leaving && all[0].leaving, "{all:?}");
        for (met, place) in all.iter().zip([-0.5, 0.5]) {
            assert!((met.t - place).abs() <= met.error && met.error < 1e-14, "{all:?}");
            let normal = ball.height(met.part, direction * place).gradient;
            assert!(normal.z.abs() > 1.0 - 1e-6, "{normal}");
        }
    }
    for direction in [Vector::X, Vector::Y, Vector::new(0.3, 0.4, 0.0)] {
        assert!(met_in(7000, &ball, &toward(Vector::Z * 0.5, direction)).is_empty());
    }
    // The tip of a cone: within it, across it, and along its side.
    let cone = over(
        [
            |f, [u, v, _]| {
                let cosine = f.one(Unary::Cos, u);
                f.two(Binary::Multiply, v, cosine)
            },
            |f, [u, v, _]| {
                let sine = f.one(Unary::Sin, u);
                f.two(Binary::Multiply, v, sine)
            },
            |_, [_, v, _]| v,
        ],
        [[0.0, 0.0], [2.0 * PI, 0.5]],
    );
    for within in [Vector::Z, Vector::new(0.2, 0.1, 1.0)] {
        let all = met_in(5000, &cone, &toward(Vector::ZERO, within));
        assert!(all.len() == 1 && all[0].t.abs() <= all[0].error, "{all:?}");
        let normal = cone.height(all[0].part, Vector::ZERO).gradient;
        assert!((normal.z.abs() - 0.5_f64.sqrt()).abs() < 1e-6, "{normal}");
    }
    assert!(met_in(5000, &cone, &toward(Vector::ZERO, Vector::X)).is_empty());
    assert!(met_in(20_000, &cone, &toward(Vector::ZERO, Vector::new(1.0, 0.0, 1.0))).is_empty());
}

#[test]
fn a_line_in_a_surface_misses_it_and_ends() {
    let corners = [[-0.5, -0.5], [0.5, 0.5]];
    let plane = over([|_, [u, ..]| u, |_, [_, v, _]| v, |f, _| f.number(0.25)], corners);
    for direction in [Vector::X, Vector::Y, Vector::new(1.0, 0.7, 0.0)] {
        assert!(met_in(200, &plane, &toward(Vector::Z * 0.25, direction)).is_empty());
    }
    let saddle = over(
        [
            |_, [u, ..]| u,
            |_, [_, v, _]| v,
            |f, [u, v, _]| {
                let (first, second) = (f.one(Unary::Square, u), f.one(Unary::Square, v));
                f.two(Binary::Subtract, first, second)
            },
        ],
        corners,
    );
    // It holds the line, aslant to u and v: there bounds of their own never tell where it ends.
    let all = met_in(100_000, &saddle, &toward(Vector::ZERO, Vector::new(1.0, 1.0, 0.0)));
    assert!(all.is_empty(), "{all:?}");
}

#[test]
fn a_line_through_a_crease_or_along_a_turning_point_meets_the_surface_once() {
    let corners = [[-0.5, -0.5], [0.5, 0.5]];
    let roof = over([|_, [u, ..]| u, |_, [_, v, _]| v, |f, [u, ..]| f.one(Unary::Abs, u)], corners);
    let beside = Vector::Y * 0.1;
    assert_eq!(met_in(1000, &roof, &toward(beside, Vector::Z)).len(), 1);
    assert!(met_in(1000, &roof, &toward(beside, Vector::X)).is_empty());
    let wave = over(
        [
            |_, [u, ..]| u,
            |_, [_, v, _]| v,
            |f, [u, ..]| {
                let square = f.one(Unary::Square, u);
                f.two(Binary::Multiply, square, u)
            },
        ],
        corners,
    );
    let all = met_in(1000, &wave, &toward(beside, Vector::X));
    assert!(all.len() == 1 && all[0].t.abs() <= all[0].error, "{all:?}");
}

#[test]
fn a_surface_is_told_to_be_outside_of_its_container_where_it_is() {
    let cube = |half: f64| Container::Box(Vector::splat(half));
    for (container, at, is_outside) in [
        (cube(0.4), 1.0, true),
        (cube(0.4), 0.8, false),
        (Container::Sphere(0.5), 1.2, true),
        (Container::Sphere(0.5), 0.99, false),
        // All around it.
        (cube(0.2), 0.0, true),
        (Container::Sphere(0.4), 0.0, true),
        (cube(0.3), 0.0, false),
        (Container::Sphere(0.51), 0.0, false),
    ] {
        let surface = ball_in(container, at * Vector::X);
        assert_eq!(surface.is_outside(), is_outside, "{container:?} at {at}");
    }
}
