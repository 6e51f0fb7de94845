//! Rays that start on bodies or leave them: rows 5 and 6, for every kind.

use std::collections::BTreeSet;

use lucarne::math::placement::Placement;
use lucarne::math::{Matrix, UnitVector, Vector};
use lucarne::shape::{Body, Cone, Cylinder, Placed, Plane, Ray, SurfacePoint};

use super::held::compiled;
use crate::dice::{Dice, rays};

/// One of each kind at least, of size about 1, around the origin; the last brace is missing.
const BODIES: &str = include_str!("../bodies.txt");

/// The bodies, each stretched, turned and moved in some way.
fn placed(dice: &mut Dice, copies: usize) -> Vec<(f64, Placed)> {
    let mut all = Vec::new();
    for solid in std::iter::repeat_n(BODIES.lines(), copies).flatten() {
        let size = dice.size(-6.0, 6.0);
        let far = dice.one_of(&[0.0, 1.0, 1e3, 1e6]);
        let mut triple = |reach: f64| {
            let v = dice.point(reach);
            format!("<{:e}, {:e}, {:e}>", v.x, v.y, v.z)
        };
        let (turn, place) = (triple(180.0), triple(far));
        let stretch = dice.one_of(&["", "scale <1, 0.3, 2>"]);
        let text = format!("{solid} {stretch} rotate {turn} translate {place} scale {size:e} }}");
        all.extend(compiled(&text).0.placed.into_iter().map(|placed| (size, placed)));
    }
    all
}

#[test]
fn every_kind_of_body_is_tried() {
    let tried: BTreeSet<_> =
        placed(&mut Dice(60), 1).iter().map(|(_, placed)| placed.body.word()).collect();
    let missing: Vec<_> = Body::WORDS.iter().filter(|word| !tried.contains(*word)).collect();
    assert!(missing.is_empty(), "{missing:?}");
}

/// A ray at a body from near it, and a place of its surface that it meets.
fn any_surface(dice: &mut Dice, size: f64, placed: &Placed) -> Option<SurfacePoint> {
    let middle = placed.placement.centre;
    let origin = middle + dice.direction() * (size * dice.size(0.0, 2.0));
    let target = middle + dice.point(size);
    let direction = UnitVector::from_direction(target - origin)?.get();
    let ray = Ray { origin, direction };
    let seen: Vec<_> = placed.crossings(&ray).into_iter().filter(|met| met.is_seen()).collect();
    if seen.is_empty() {
        return None;
    }
    let met = seen[dice.below(seen.len())];
    Some(placed.surface(&ray, met.t, met.leaving))
}

#[test]
fn row_6_a_ray_that_leaves_a_body_meets_what_lies_four_errors_off_it() {
    let mut dice = Dice(66);
    let mut met = 0;
    for (size, placed) in placed(&mut dice, 10) {
        for _ in 0..rays() / 1000 {
            let Some(surface) = any_surface(&mut dice, size, &placed) else { continue };
            let normal = surface.normal * dice.one_of(&[1.0, -1.0]);
            let across = normal.cross(dice.direction());
            let Some(direction) = UnitVector::from_direction(normal + across) else { continue };
            let direction = direction.get();
            let ray = Ray { origin: surface.spawn(direction), direction };
            // What the neighbour says of itself there is its part of the errors.
            let unit = UnitVector::from_unit(normal);
            let at = |distance: f64| Plane { normal: unit, distance };
            let height = normal.dot(surface.point);
            let upward = Ray { origin: ray.origin, direction: normal };
            let own = at(height).surface(&upward, 0.0).error;
            let gap = 4.0 * (surface.error + own);
            let chord = at(height + gap).chord(&ray);
            let is_met = chord.is_some_and(|c| c.enter.is_ahead() || c.leave.is_ahead());
            assert!(is_met, "a leak, {gap:e} off: {chord:?} {surface:?} {ray:?} {placed:?}");
            met += 1;
        }
    }
    assert!(met > rays() / 20, "{met}");
}

#[test]
fn a_ray_from_a_billion_sizes_away_meets_what_one_from_near_meets_on_the_same_line() {
    let mut dice = Dice(46);
    let mut met = 0;
    for (size, placed) in placed(&mut dice, 10) {
        let middle = placed.placement.centre;
        let direction = dice.one_of(&[Vector::X, -Vector::Y, Vector::Z]);
        let above = |x: f64| lucarne::math::double::power_of_two_near(x) * 2.0;
        // On a grid on which both starts are, so that the two lines are one.
        let grid = above(middle.abs().max_element().max(size)) / (1u64 << 20) as f64;
        let distance = above(size) * (1u64 << 30) as f64;
        for _ in 0..rays() / 1000 {
            let start = middle + dice.point(size) - direction * (8.0 * size);
            let near = Ray { origin: (start / grid).round() * grid, direction };
            let far = Ray { origin: near.origin - direction * distance, direction };
            assert_eq!(far.origin + direction * distance, near.origin);
            let [here, there] = [&near, &far].map(|ray| placed.crossings(ray));
            let case =
                || format!("{} {placed:?}\n{near:?}\n{here:?}\n{there:?}", placed.body.word());
            assert_eq!(here.len(), there.len(), "{}", case());
            for (here, there) in here.iter().zip(&there) {
                let apart = (there.t - distance - here.t).abs();
                assert!(apart <= here.error + there.error, "{apart:e} {}", case());
                met += 1;
            }
        }
    }
    assert!(met > rays() / 20, "{met}");
}

/// Whole a² + b² = c².
const TRIPLES: [[f64; 3]; 4] =
    [[3.0, 4.0, 5.0], [5.0, 12.0, 13.0], [0.0, 1.0, 1.0], [8.0, 15.0, 17.0]];

#[test]
fn row_5_a_ray_that_starts_on_a_cylinder_or_a_cone_does_not_meet_it_there() {
    let mut dice = Dice(51);
    let (mut met, mut left) = (0, 0);
    for _ in 0..rays() {
        let k = dice.power_of_two(-60, 60);
        let [a, b, radius] = dice.one_of(&TRIPLES);
        let whole = |dice: &mut Dice| (dice.below(33) as f64 - 16.0) * k;
        let mut centre = Vector::from_array([0; 3].map(|_| whole(&mut dice)));
        let axis = dice.below(3);
        // From the axis' frame to the world.
        let turn = |v: Vector| {
            let mut v = v.to_array();
            v.rotate_left(axis);
            Vector::from_array(v)
        };
        centre = turn(centre);
        let height = (dice.below(9) + 1) as f64 * k;
        let columns = [Vector::X * radius * k, Vector::Y * radius * k, Vector::Z * height];
        let [x, y, z] = columns.map(turn);
        let world_from_local = Matrix::from_cols(x, y, z);
        let local_from_world = world_from_local.inverse();
        let placement = Placement { centre, world_from_local, local_from_world };
        // At half its height a cone is half as wide.
        let (body, up, width) = match dice.below(2) {
            0 => (Body::Cylinder(Cylinder { open: dice.below(2) == 0 }), 0.5, 1.0),
            _ => (Body::Cone(Cone { cap: 0.0, open: dice.below(2) == 0 }), 0.0, 0.5),
        };
        let placed =
            Placed { body: std::sync::Arc::new(body), placement, root_tolerance: 0.0, exact: None };
        // On its side, or on its base.
        let on_side = dice.below(3) > 0;
        let signs = [dice.one_of(&[1.0, -1.0]), dice.one_of(&[1.0, -1.0])];
        let (out, start) = if on_side {
            let (x, y) = (signs[0] * a * k, signs[1] * b * k);
            let out = Vector::new(
                x,
                y,
                if width < 1.0 { 0.5 * radius * radius * k * k / height } else { 0.0 },
            );
            (out, Vector::new(x * width, y * width, up * height))
        } else {
            (-Vector::Z, Vector::new(0.5 * signs[0] * a * k, 0.25 * signs[1] * b * k, -height))
        };
        let out = turn(out).normalize();
        let direction = dice.direction();
        let ray = Ray { origin: centre + turn(start), direction };
        let slope = direction.dot(out);
        // What is nearly along the surface, rounding tells not.
        if slope.abs() < 1e-6 {
            continue;
        }
        let first = placed.crossings(&ray).into_iter().find(|met| met.crossing().is_ahead());
        let is_solid = match &*placed.body {
            Body::Cylinder(Cylinder { open }) | Body::Cone(Cone { open, .. }) => !open,
            _ => true,
        };
        if slope > 0.0 {
            left += 1;
            assert!(first.is_none(), "{slope:e} {first:?} {placed:?} {ray:?}");
        } else if is_solid {
            // The far side is met, far off.
            met += 1;
            let far = first.map_or(0.0, |met| met.t / (radius * k + height));
            assert!(far > 1e-9, "{slope:e} {first:?} {placed:?} {ray:?}");
            assert!(first.is_some_and(|met| met.leaving), "{first:?} {placed:?} {ray:?}");
        }
    }
    assert!(met > rays() / 8 && left > rays() / 4, "{met} {left}");
}
