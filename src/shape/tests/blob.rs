//! Blobs against twice the digits.

use super::placed::{
    assert_crossed_where_it_is, assert_first_found_up_to_a_limit, assert_left_into_the_open,
    placed, ray_at_placed, stand,
};
use super::*;
use crate::shape::blob::Component;
use crate::shape::exact::Triple;
use crate::shape::local::Local;
use crate::shape::{Blob, Body};

/// What is missing to 1, over how fast that grows.
fn inside(body: &Body, point: Triple) -> Double {
    let Body::Blob(blob) = body else { panic!("{body:?}") };
    let there = Vector::new(point[0].0, point[1].0, point[2].0);
    let steep = blob.height(0, there).gradient.length();
    blob.exactly(point) / Double::of(steep.max(f64::MIN_POSITIVE))
}

fn ball(centre: Vector, radius: f64, strength: f64) -> Component {
    Component {
        strength,
        centre,
        half: 0.0,
        blob_from_unit: Matrix::from_diagonal(Vector::splat(radius)),
        unit_from_blob: Matrix::from_diagonal(Vector::splat(1.0 / radius)),
    }
}

fn any_component(random: &mut Random) -> Component {
    let radius = [0.5, random.number(0.2, 0.8), random.size(-3.0, -0.5)][random.below(3)];
    let strength = match random.below(6) {
        0 => -random.number(0.2, 2.0),
        1 => [1.0, 2.0, 4.0][random.below(3)],
        _ => random.number(0.3, 4.0),
    };
    let plain = ball(random.point(0.4), radius, strength);
    let half = if random.below(2) == 0 { 0.0 } else { random.size(-2.0, 0.3) };
    if half == 0.0 && random.below(2) == 0 {
        return plain;
    }
    let axes = [(); 3].map(|()| random.direction().get() * random.number(0.3, 1.0));
    let [x, y, z] = axes.map(|axis| axis * radius);
    let blob_from_unit = Matrix::from_cols(x, y, z);
    if blob_from_unit.determinant().abs() < 1e-2 * radius.powi(3) {
        return plain;
    }
    Component { half, blob_from_unit, unit_from_blob: blob_from_unit.inverse(), ..plain }
}

fn any_blob(random: &mut Random) -> Blob {
    loop {
        let count = 1 + random.below(7);
        if let Some(blob) = Blob::new((0..count).map(|_| any_component(random)).collect()) {
            return blob;
        }
    }
}

#[test]
fn a_blob_is_crossed_where_exact_arithmetic_crosses_it() {
    let mut random = Random(71);
    let mut crossed = 0;
    for _ in 0..tries_in(8) {
        let body = any_blob(&mut random);
        let placed = placed(&mut random, Body::Blob(body));
        for _ in 0..4 {
            let ray = ray_at_placed(&mut random, &placed);
            crossed += assert_crossed_where_it_is(&mut random, &placed, &ray, inside);
            assert_left_into_the_open(&mut random, &placed, &ray, inside);
            assert_first_found_up_to_a_limit(&mut random, &placed, &ray);
        }
    }
    assert!(crossed > tries_in(8), "{crossed}");
}

#[test]
fn a_lone_ball_is_a_sphere_and_a_ray_that_touches_it_misses() {
    let mut random = Random(72);
    for _ in 0..tries_in(4) {
        let strength = 1.0 + random.size(-4.0, 3.0);
        let Some(blob) = Blob::new(vec![ball(Vector::ZERO, 1.0, strength)]) else { panic!() };
        let radius = (1.0 - 1.0 / strength.sqrt()).sqrt();
        assert!((blob.reach() - radius).abs() <= 1e-13, "{blob:?}");
        let off = [0.0, random.size(-14.0, 0.0), -random.size(-14.0, 0.0)][random.below(3)];
        let (out, aside) = (random.direction().get(), random.direction().get());
        let placement = Placement {
            centre: Vector::ZERO,
            world_from_local: Matrix::IDENTITY,
            local_from_world: Matrix::IDENTITY,
        };
        let body = std::sync::Arc::new(Body::Blob(blob));
        let placed = stand(body, placement);
        let direction = out.cross(aside).normalize_or(Vector::X);
        let origin = out * (radius * (1.0 + off)) - direction * 3.0;
        let ray = Ray { origin, direction };
        let count = assert_crossed_where_it_is(&mut random, &placed, &ray, inside);
        // As far as its own numbers tell.
        let told = 1e-13 / (radius * radius);
        assert!(off.abs() < told || (count == 2) == (off < 0.0), "{off} {count} {strength}");
    }
}

/// Two balls that join, a ray through where their fields begin and end.
#[test]
fn a_crossing_at_a_joint_is_met_once() {
    let mut random = Random(73);
    for _ in 0..tries_in(4) {
        let place = random.number(0.1, 0.9);
        // The first has the strength 1 right where the second begins.
        let inner = 1.0 - place * place;
        let first = ball(Vector::ZERO, 1.0, 1.0 / (inner * inner));
        let second = ball(Vector::X * (place + 0.4), 0.4, random.number(-3.0, 3.0));
        let Some(blob) = Blob::new(vec![first, second]) else { continue };
        let placed = placed(&mut random, Body::Blob(blob));
        let world = |local| placed.placement.world_point(local);
        let (from, to) = (world(Vector::X * random.number(-9.0, 9.0)), world(Vector::X * 9.5));
        let direction = UnitVector::from_direction(to - from).unwrap_or(UnitVector::X).get();
        let ray = Ray { origin: from, direction };
        let count = assert_crossed_where_it_is(&mut random, &placed, &ray, inside);
        assert!(count.is_multiple_of(2) && count > 0, "{count} {placed:?}");
    }
}

#[test]
fn a_blob_of_thousands_is_crossed_where_exact_arithmetic_crosses_it() {
    let mut random = Random(74);
    let components: Vec<Component> = (0..3000)
        .map(|_| ball(random.point(0.5), random.number(0.01, 0.06), random.number(-0.5, 2.0)))
        .collect();
    let Some(blob) = Blob::new(components) else { panic!() };
    let placed = placed(&mut random, Body::Blob(blob));
    let mut crossed = 0;
    for _ in 0..tries_in(400) {
        let ray = ray_at_placed(&mut random, &placed);
        crossed += assert_crossed_where_it_is(&mut random, &placed, &ray, inside);
    }
    assert!(crossed > tries_in(400), "{crossed}");
}

#[test]
fn a_blob_lies_within_its_extent_and_its_reach() {
    let mut random = Random(75);
    for _ in 0..tries_in(40) {
        let blob = any_blob(&mut random);
        let along = random.direction().get();
        let (least, most) = blob.extent(along);
        for _ in 0..200 {
            let point = random.point(2.0);
            if blob.contains(point) {
                let place = point.dot(along);
                assert!(least <= place && place <= most, "{point} {along} {blob:?}");
                assert!(point.length() <= blob.reach(), "{point} {blob:?}");
            }
        }
    }
}

/// Balls in a row, each of which meets a few others.
fn row(count: usize) -> Vec<Component> {
    let n = count as f64;
    (0..count).map(|i| ball(Vector::X * (i as f64 / n), 3.0 / n, 1.7)).collect()
}

/// Bars end to end.
fn chain(count: usize) -> Vec<Component> {
    let half = 0.5 / count as f64;
    let bar = |at: usize| {
        let centre = Vector::new(1.0, 2.0, 3.0) * (2.0 * half * at as f64);
        Component { half: 0.5, ..ball(centre, 2.0 * half, 1.7) }
    };
    (0..count).map(bar).collect()
}

/// Balls that each meet a good part of the others.
fn heap(count: usize) -> Vec<Component> {
    let mut random = Random(5);
    (0..count).map(|_| ball(random.point(0.5), random.number(0.1, 0.6), 1e-4)).collect()
}

/// Balls that all stand in one place.
fn pile(count: usize) -> Vec<Component> {
    vec![ball(Vector::ZERO, 0.5, 1e-4); count]
}

#[test]
fn of_ten_times_as_many_components_the_widths_take_little_more_than_ten_times_as_long() {
    for kind in [row, chain, heap, pile] {
        let [few, many] = [10_000, 100_000].map(|count| Blob::looks(&kind(count)));
        assert!(many <= 13 * few, "{few} looks, then {many}");
    }
}

#[test]
fn a_heap_of_weak_components_has_its_surface_within_what_it_is_told_to_reach() {
    let strong = |mut part: Component| {
        part.strength = 0.02;
        part
    };
    let heap: Vec<Component> = heap(2000).into_iter().map(strong).collect();
    let blob = Blob::new(heap.clone()).expect("they add up");
    let mut random = Random(6);
    for _ in 0..2000 {
        let point = random.point(0.9);
        if blob.contains(point) {
            let along = random.direction().get();
            let (low, high) = blob.extent(along);
            assert!((low..=high).contains(&along.dot(point)), "{point}");
        }
    }
}
