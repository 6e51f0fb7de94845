//! Polynomial surfaces against twice the digits.

use std::collections::BTreeMap;

use super::placed::{assert_crossed_where_it_is, assert_left_where_it_is, placed, ray_at_placed};
use super::*;
use crate::math::random::tries_in;
use crate::math::terms::{count_of_terms, exponents};
use crate::shape::Body;
use crate::shape::algebraic::Algebraic;
use crate::shape::exact::Triple;
use crate::shape::local::{Local, LocalRay, Met};

/// Each coefficient and its powers.
pub(super) type Terms = Vec<(f64, [usize; 3])>;

pub(super) fn surface(degree: usize, terms: &Terms) -> Algebraic {
    let places: BTreeMap<[usize; 3], usize> = exponents(degree).zip(0..).collect();
    let mut all = vec![0.0; count_of_terms(degree)];
    for (term, powers) in terms {
        all[places[powers]] += term;
    }
    Algebraic::new(degree, all).expect("as many terms as there are")
}

pub(super) fn product(a: &Terms, b: &Terms) -> Terms {
    let mut all = BTreeMap::new();
    for (x, i) in a {
        for (y, j) in b {
            *all.entry([i[0] + j[0], i[1] + j[1], i[2] + j[2]]).or_insert(0.0) += x * y;
        }
    }
    all.into_iter().map(|(powers, term)| (term, powers)).collect()
}

/// ax² + by² + cz² + d.
pub(super) fn squares(a: f64, b: f64, c: f64, d: f64) -> Terms {
    vec![(a, [2, 0, 0]), (b, [0, 2, 0]), (c, [0, 0, 2]), (d, [0, 0, 0])]
}

/// The torus about the y axis.
pub(super) fn torus(major: f64, minor: f64) -> Terms {
    let mut terms = product(
        &squares(1.0, 1.0, 1.0, major * major - minor * minor),
        &squares(1.0, 1.0, 1.0, major * major - minor * minor),
    );
    let four = -4.0 * major * major;
    terms.extend([(four, [2, 0, 0]), (four, [0, 0, 2])]);
    terms
}

/// The polynomial's value over its gradient's length.
fn inside(body: &Body, point: Triple) -> Double {
    let Body::Algebraic(surface) = body else { panic!("{body:?}") };
    let value = surface.exactly(point);
    let there = Vector::new(point[0].0, point[1].0, point[2].0);
    let steep = surface.height(0, there).gradient.length();
    value / Double::of(steep.max(f64::MIN_POSITIVE))
}

fn families(random: &mut Random) -> Vec<(usize, Terms)> {
    let n = |random: &mut Random| random.number(0.3, 1.5);
    let [a, b, c] = [0; 3].map(|_| n(random));
    let sphere = |random: &mut Random| {
        let centre = random.point(0.6);
        let size = random.number(0.2, 0.8);
        let mut terms = squares(1.0, 1.0, 1.0, centre.length_squared() - size * size);
        terms.push((-2.0 * centre.x, [1, 0, 0]));
        terms.push((-2.0 * centre.y, [0, 1, 0]));
        terms.push((-2.0 * centre.z, [0, 0, 1]));
        terms
    };
    let several = |random: &mut Random, count: usize| {
        (0..count).fold(vec![(1.0, [0, 0, 0])], |all, _| product(&all, &sphere(random)))
    };
    let mut paraboloid = squares(a, b, 0.0, 0.0);
    paraboloid.push((-c, [0, 0, 1]));
    let random_terms = |random: &mut Random, degree: usize| {
        exponents(degree).map(|powers| (random.number(-1.0, 1.0), powers)).collect()
    };
    vec![
        (2, squares(a, b, c, -1.0)),
        (2, squares(a, b, 0.0, -1.0)),
        (2, squares(a, b, -c, 0.0)),
        (2, squares(a, b, -c, -1.0)),
        (2, squares(a, -b, -c, -1.0)),
        (2, paraboloid),
        (4, torus(1.0, 0.3 * a)),
        (2, sphere(random)),
        (4, several(random, 2)),
        (6, several(random, 3)),
        (10, several(random, 5)),
        (14, several(random, 7)),
        (3, random_terms(random, 3)),
        (4, random_terms(random, 4)),
        (7, random_terms(random, 7)),
        (15, random_terms(random, 15)),
    ]
}

#[test]
fn polynomial_surfaces_are_crossed_where_exact_arithmetic_crosses_them() {
    let mut random = Random(81);
    let mut crossed = 0;
    // A line takes milliseconds.
    let rounds = tries_in(2_000);
    for _ in 0..rounds {
        for (degree, terms) in families(&mut random) {
            let placed = placed(&mut random, Body::Algebraic(surface(degree, &terms)));
            for _ in 0..4 {
                let ray = ray_at_placed(&mut random, &placed);
                crossed += assert_crossed_where_it_is(&mut random, &placed, &ray, inside);
            }
        }
    }
    assert!(crossed > rounds * 32, "{crossed}");
}

#[test]
fn a_convex_quadric_is_left_for_good() {
    let mut random = Random(82);
    for _ in 0..tries_in(10) {
        let [a, b, c] = [0; 3].map(|_| random.number(0.3, 1.5));
        let placed = placed(&mut random, Body::Algebraic(surface(2, &squares(a, b, c, -1.0))));
        let ray = ray_at_placed(&mut random, &placed);
        assert_left_where_it_is(&mut random, &placed, &ray, inside);
    }
}

fn line(nearest: Vector, direction: Vector) -> LocalRay<'static> {
    LocalRay {
        nearest,
        direction: direction.normalize(),
        blur: 1e-16,
        turn: 1e-16,
        tolerance: 0.0,
        in_world: None,
    }
}

fn met(surface: &Algebraic, ray: &LocalRay) -> Vec<Met> {
    let mut found = crate::shape::local::Crossings::new();
    surface.crossings(ray, &mut found);
    found.to_vec()
}

#[test]
fn a_paraboloid_is_entered_once_along_its_axis_and_never_left() {
    let mut terms = squares(1.0, 1.0, 0.0, 0.0);
    terms.push((-1.0, [0, 0, 1]));
    let surface = surface(2, &terms);
    let found = met(&surface, &line(Vector::new(0.5, 0.0, 0.0), Vector::Z));
    assert_eq!(found.len(), 1, "{found:?}");
    assert!((found[0].t - 0.25).abs() <= found[0].error && !found[0].leaving);
}

#[test]
fn a_crossing_is_found_however_far_away() {
    let mut terms = squares(1.0, 1.0, 0.0, 0.0);
    terms.push((-1.0, [0, 0, 1]));
    let surface = surface(2, &terms);
    for tilt in [1e-2, 1e-5, 1e-8] {
        let found = met(&surface, &line(Vector::ZERO, Vector::new(tilt, 0.0, 1.0)));
        assert_eq!(found.len(), 2, "{tilt}: {found:?}");
        let far = 1.0 / (tilt * tilt) * (1.0 + tilt * tilt).sqrt();
        assert!((found[1].t - far).abs() <= found[1].error + 1e-15 * far, "{tilt}: {found:?}");
    }
}

#[test]
fn a_line_in_the_surface_misses_it() {
    let surface = surface(2, &squares(1.0, 0.0, -1.0, 0.0));
    assert!(met(&surface, &line(Vector::ZERO, Vector::Y)).is_empty());
    assert!(met(&surface, &line(Vector::ZERO, Vector::new(1.0, 0.0, 1.0))).is_empty());
}

#[test]
fn a_surface_of_all_degrees_has_the_gradient_of_its_value() {
    let mut random = Random(83);
    for degree in 2..=15 {
        let terms = exponents(degree).map(|powers| (random.number(-1.0, 1.0), powers)).collect();
        let surface = surface(degree, &terms);
        let point = random.point(1.0);
        let height = surface.height(0, point);
        let (step, along) = (1e-6, random.direction().get());
        let [before, after] =
            [-step, step].map(|step| surface.height(0, point + along * step).value);
        let slope = (after - before) / (2.0 * step);
        let told = height.gradient.dot(along);
        assert!((slope - told).abs() <= 1e-6 * (1.0 + told.abs()), "{degree}: {slope} {told}");
    }
}

#[test]
fn a_closed_quadric_lies_within_its_extent_and_its_reach_and_nearly_fills_them() {
    let mut random = Random(41);
    for case in 0..tries_in(500) {
        // (P − c)ᵀ·M·Mᵀ·(P − c) = r², written out.
        let columns = [0; 3].map(|_| random.point(1.0));
        let form = Matrix::from_cols(columns[0], columns[1], columns[2]);
        let form = form * form.transpose() + Matrix::from_diagonal(Vector::splat(1e-3));
        let centre = random.point(5.0);
        let linear = form * centre * -2.0;
        let constant = centre.dot(form * centre) - random.number(0.1, 4.0);
        let [x, y, z] = [form.x_axis, form.y_axis, form.z_axis];
        let terms = [
            x.x,
            2.0 * x.y,
            2.0 * x.z,
            linear.x,
            y.y,
            2.0 * y.z,
            linear.y,
            z.z,
            linear.z,
            constant,
        ];
        let surface = Algebraic::new(2, terms.to_vec()).expect("ten terms");
        let along = random.point(1.0);
        let (low, high) = surface.extent(along);
        assert!(low.is_finite() && high.is_finite(), "{surface:?}");
        // Where it is farthest along: there the gradient is parallel to `along`.
        let depth = centre.dot(form * centre) - constant;
        let way = form.inverse() * along;
        let half = (depth * along.dot(way)).sqrt();
        let exact = (along.dot(centre) - half, along.dot(centre) + half);
        assert!(low <= exact.0 && exact.1 <= high, "{case}: {low} {high} {exact:?}");
        assert!(high - low <= 2.0 * half * (1.0 + 1e-3), "{case}: {low} {high} {exact:?}");
        for sign in [-1.0, 1.0] {
            let point = centre + way * (sign * depth / half);
            assert!(point.length() <= surface.reach(), "{case}: {point}");
        }
    }
    let open = [[1.0, 1.0, -1.0], [1.0, 0.0, 1.0], [1.0, 1e-7, 1.0], [-1.0, -1.0, -1.0]];
    for [a, b, c] in open {
        let surface = surface(2, &squares(a, b, c, -1.0));
        assert_eq!(surface.extent(Vector::X), (f64::NEG_INFINITY, f64::INFINITY));
    }
}
