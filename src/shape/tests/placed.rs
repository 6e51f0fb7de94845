//! Placed bodies against twice the digits: where the line is inside, and where it says it crosses.

use super::*;
use crate::math::double::DoubleVector;
use crate::math::elementary;
use crate::math::placement::ExactPlacement;
use crate::shape::exact::Triple;
use crate::shape::local::{Local, Met};

/// Negative inside of a body, positive outside, and about the distance near the surface; of a local point.
pub(super) type Inside = fn(&Body, Triple) -> Double;

/// The body, stretched, turned and moved.
pub(super) fn placed(random: &mut Random, body: Body) -> Placed {
    let size = random.size(-9.0, 9.0);
    let stretch = |random: &mut Random| match random.below(3) {
        0 => 1.0,
        1 => random.number(0.5, 2.0),
        _ => random.size(-3.0, 0.0),
    };
    let world_from_local = loop {
        let columns = match random.below(3) {
            0 => [Vector::X, Vector::Y, Vector::Z],
            1 => [Vector::Y, -Vector::Z, Vector::X],
            _ => [random.direction().get(), random.direction().get(), random.direction().get()],
        };
        let [x, y, z] = columns.map(|column| column * (size * stretch(random)));
        let matrix = Matrix::from_cols(x, y, z);
        if matrix.determinant().abs() > 1e-12 * size.powi(3) {
            break matrix;
        }
    };
    let local_from_world = world_from_local.inverse();
    let far = [0.0, size, size * random.size(0.0, 6.0)][random.below(3)];
    let centre = random.direction().get() * far;
    let placement = Placement { centre, world_from_local, local_from_world };
    stand(std::sync::Arc::new(body), placement)
}

/// The body where `placement` has it: its `local_from_world` to the bit.
pub(super) fn stand(body: std::sync::Arc<Body>, placement: Placement) -> Placed {
    let [x, y, z] = [0, 1, 2].map(|i| DoubleVector::from(placement.local_from_world.row(i)));
    let determinant = x.cross(y).dot(z);
    let columns = [y.cross(z), z.cross(x), x.cross(y)].map(DoubleVector::components);
    let rows = [0, 1, 2].map(|i| {
        let [a, b, c] = columns.map(|column| column[i] / determinant);
        DoubleVector::new(a, b, c)
    });
    let exact = ExactPlacement::new(rows, placement.centre.into(), &placement);
    let exact = body.keeps_exact_place().then(|| Box::new(exact));
    Placed { body, placement, root_tolerance: 0.0, exact }
}

/// So that rounding a point of it costs no more than rounding the ray.
pub(super) fn at_the_origin(placed: Placed) -> Placed {
    stand(placed.body, Placement { centre: Vector::ZERO, ..placed.placement })
}

/// How far off to look from, in sizes of the body: to 10⁹ of its least, if it is flattened.
pub(super) fn far_off(random: &mut Random, placed: &Placed) -> f64 {
    let flat = elementary::log10(3.0 / placed.placement.condition());
    random.size(0.0, 9.0 + flat.min(0.0))
}

/// A ray at a placed body: from near or far, onto it, past it, along its own axes.
pub(super) fn ray_at_placed(random: &mut Random, placed: &Placed) -> Ray {
    let reach = placed.body.reach().min(4.0);
    let world = |local: Vector| placed.placement.world_point(local);
    let target = world(random.point(1.0) * reach);
    let far = [0.5, 3.0, far_off(random, placed)][random.below(3)];
    let origin = match random.below(4) {
        0 => {
            let axis = [Vector::X, Vector::Y, Vector::Z][random.below(3)];
            target + placed.placement.world_from_local * axis * far
        }
        _ => world(random.direction().get() * (reach * far)),
    };
    let direction = UnitVector::from_direction(target - origin).unwrap_or(UnitVector::Z).get();
    Ray { origin, direction }
}

/// The local point at t + `more`, exactly.
pub(super) fn local_at(placed: &Placed, ray: &Ray, t: f64, more: f64) -> Triple {
    let Placement { centre, local_from_world, .. } = placed.placement;
    let along = Double::of(t) + Double::of(more);
    let (origin, direction) = (exact::triple(ray.origin), exact::triple(ray.direction));
    let point = [0, 1, 2].map(|axis| origin[axis] + direction[axis] * along);
    exact::local(&local_from_world, exact::minus(point, exact::triple(centre)))
}

/// How far rounding may move the ray in local space.
pub(super) fn blur(placed: &Placed, ray: &Ray) -> f64 {
    let start = placed.placement.local_point(ray.origin);
    64.0 * EPS
        * (placed.placement.local_from_world.abs() * (ray.origin - placed.placement.centre).abs())
            .length()
            .max(start.length() + 1.0)
}

/// How far off a ray may cross that rounding hardly tells from one across the axis of a body with ends: it may be taken
/// for one in the plane of an end, as the numbers are that made the ray and the plane.
fn level_off(placed: &Placed, ray: &Ray) -> f64 {
    let step = placed.placement.local_direction(ray.direction);
    let level = match *placed.body {
        Body::Cylinder(_)
        | Body::Cone(_)
        | Body::Prism(_)
        | Body::Sor(_)
        | Body::Lathe(_)
        | Body::Text(_) => step.z.abs(),
        Body::Isosurface(_) => step.abs().min_element(),
        _ => return 0.0,
    };
    let blur = blur(placed, ray);
    if level > blur * step.length() {
        return 0.0;
    }
    let Placement { centre, local_from_world, .. } = placed.placement;
    let greatest = ray.origin.abs().max(centre.abs()).max_element();
    blur + 16.0 * U * (local_from_world.abs() * Vector::splat(greatest)).length()
}

/// Each crossing has the inside on one hand and the outside on the other, within its bound; and wherever
/// one looks along the line, the crossings before say whether it is inside.
pub(super) fn assert_crossed_where_it_is(
    random: &mut Random,
    placed: &Placed,
    ray: &Ray,
    inside: Inside,
) -> usize {
    let all = placed.crossings(ray);
    let height = |t, more| inside(&placed.body, local_at(placed, ray, t, more));
    for (i, met) in all.iter().enumerate() {
        let Met { t, error, leaving, .. } = *met;
        assert!(error >= 0.0 && t.is_finite(), "{met:?} {placed:?} {ray:?}");
        let apart = |other: &Met| (other.t - t).abs() > 2.0 * (error + other.error);
        let alone = all.iter().enumerate().all(|(j, other)| j == i || apart(other));
        if !alone {
            continue;
        }
        let (before, after) = (height(t, -error).0, height(t, error).0);
        let (outer, inner) = if leaving { (after, before) } else { (before, after) };
        // In the plane of an end it is taken to pass on one side of it: where it is crossed, it is near.
        let off = level_off(placed, ray);
        assert!(outer >= -off && inner <= off, "{before:e} {after:e}: {met:?} {placed:?} {ray:?}");
    }
    if !placed.body.is_sheet() {
        assert_inside_where_it_says(random, placed, ray, inside);
    }
    all.len()
}

/// Wherever one looks along the line, the crossings before say whether it is inside.
pub(super) fn assert_inside_where_it_says(
    random: &mut Random,
    placed: &Placed,
    ray: &Ray,
    inside: Inside,
) {
    let all = placed.crossings(ray);
    let height = |t, more| inside(&placed.body, local_at(placed, ray, t, more));
    // What has no end may hold the line's begin.
    let from_inside = match all.first() {
        Some(first) => placed.body.reach().is_infinite() && first.leaving,
        None => placed.body.reach().is_infinite() && placed.contains(ray.origin),
    };
    // Where the line is in reach.
    let reach = placed.body.reach().min(1e3);
    let near = placed.placement.local_point(ray.origin);
    let step = placed.placement.local_direction(ray.direction);
    let middle = -near.dot(step) / step.length_squared();
    for _ in 0..16 {
        let t = middle + random.number(-1.0, 1.0) * reach / step.length();
        if all.iter().any(|met| (met.t - t).abs() <= met.error) {
            continue;
        }
        let height = height(t, 0.0).0;
        let passed = all.iter().filter(|met| met.t < t).count();
        let is_inside = (passed % 2 == 1) != from_inside;
        let blur = blur(placed, ray);
        let mut told = blur.sqrt().min(1e-3).max(blur);
        if blur > 1e-6 && matches!(*placed.body, Body::Algebraic(_)) {
            // Its sheets that are as thin are not seen from so far.
            told = blur.sqrt().sqrt();
        }
        if height.abs() > told {
            assert_eq!(height < 0.0, is_inside, "{height:e} at {t:e}: {all:?} {placed:?} {ray:?}");
        }
    }
}

/// The surface's point is on it within its bound; the ray that goes on from there, aslant or nearly along
/// the surface. `None` where there is none.
fn onward(
    random: &mut Random,
    placed: &Placed,
    ray: &Ray,
    inside: Inside,
) -> Option<(SurfacePoint, Ray)> {
    let all = placed.crossings(ray);
    if all.is_empty() {
        return None;
    }
    let met = all[random.below(all.len())];
    if !met.is_seen() {
        return None;
    }
    let surface = placed.surface(ray, met.t, met.leaving);
    let out = Ray { origin: surface.point, direction: surface.normal };
    let height = |more: f64| inside(&placed.body, local_at(placed, &out, 0.0, more)).0;
    let (inner, outer) = (height(-surface.error), height(surface.error));
    // At an edge, what is inside of one part is outside of another.
    assert!(outer >= 0.0, "{outer:e}: {surface:?} {placed:?} {ray:?}");
    if let Some(bounds) = placed.bounds(Rounding::Outward) {
        assert!(bounds.contains(surface.point), "{bounds:?} {surface:?} {placed:?} {ray:?}");
    }
    if inner > 0.0 {
        return None;
    }
    let sideways = surface.normal.cross(random.direction().get());
    let steep = [random.number(0.0, 1.0), random.size(-18.0, -1.0)][random.below(2)];
    let direction = UnitVector::from_direction(sideways + surface.normal * steep)?.get();
    // Rounding may turn what is nearly along the surface inward.
    if direction.dot(surface.normal) < 0.0 {
        return None;
    }
    // What goes along a flat part by less than rounding may be told to lie in it.
    if direction.dot(surface.normal) <= 16.0 * U * surface.normal.abs().element_sum()
        && is_on_a_flat_part(placed, &surface)
    {
        return None;
    }
    let onward = Ray { origin: surface.spawn(direction), direction };
    Some((surface, onward))
}

/// Whether it may lie on an end, or on a face across an axis.
fn is_on_a_flat_part(placed: &Placed, surface: &SurfacePoint) -> bool {
    let is_across = |axis| {
        let across = placed.placement.world_normal(axis).normalize_or(axis);
        across.cross(surface.normal).length() <= 1e-9
    };
    match *placed.body {
        Body::Mesh(_) | Body::HeightField(_) => true,
        Body::Isosurface(_) => [Vector::X, Vector::Y, Vector::Z].into_iter().any(is_across),
        _ => placed.exact.is_some() && is_across(Vector::Z),
    }
}

/// The surface's point is on it within its bound, and a ray that goes on from there leaves.
pub(super) fn assert_left_where_it_is(
    random: &mut Random,
    placed: &Placed,
    ray: &Ray,
    inside: Inside,
) {
    let Some((surface, onward)) = onward(random, placed, ray, inside) else { return };
    // A convex body is left for good.
    let again = placed.crossings(&onward).into_iter().find(|met| met.crossing().is_ahead());
    if let Some(again) = again {
        let far = again.t * placed.placement.local_direction(onward.direction).length();
        let sound = !again.leaving && far > 1e-3;
        assert!(sound, "met again: {again:?} {surface:?} {onward:?} {placed:?} {ray:?}");
    }
}

/// The same of a body that is not convex, and may be entered again soon: all of the way there lies outside.
/// What is met from inside was entered so near the start that rounding does not tell.
pub(super) fn assert_left_into_the_open(
    random: &mut Random,
    placed: &Placed,
    ray: &Ray,
    inside: Inside,
) {
    let Some((surface, onward)) = onward(random, placed, ray, inside) else { return };
    let all = placed.crossings(&onward);
    let Some(next) = all.iter().position(|met| met.crossing().is_ahead()) else { return };
    let again = all[next];
    let height = |t: f64| inside(&placed.body, local_at(placed, &onward, t, 0.0)).0;
    let blur = blur(placed, &onward);
    // As far as the ray keeps off, it may go in unseen; and as far as rounding tells.
    let steepness = placed.placement.local_direction(surface.normal).length();
    let room = blur + 2.0 * surface.error * steepness;
    for share in [0.0, 1e-6, 1e-3, 0.1, 0.5, 0.9, 1.0] {
        let height = height((again.t - again.error) * share);
        let sound = if again.leaving { height <= room } else { height >= -blur };
        assert!(sound, "{height:e} {share} {again:?} {surface:?} {onward:?} {placed:?}");
    }
}

/// Checks that the first visible crossing is found as well where the search ends soon behind it.
pub(super) fn assert_first_found_up_to_a_limit(random: &mut Random, placed: &Placed, ray: &Ray) {
    let all = placed.crossings(ray);
    let is_told = |met: &&Met| met.is_seen() && met.t > 64.0 * met.error;
    let Some(met) = all.iter().find(is_told) else { return };
    let next = all.iter().find(|next| next.t > met.t).map_or(2.0 * met.t, |next| next.t);
    let limit = met.t + random.number(0.0, 1.0) * (next - met.t) + 4.0 * met.error;
    let first = placed.first_crossings(ray, limit);
    let is_same = |one: &Met| (one.t - met.t).abs() <= one.error + met.error;
    assert!(first.iter().any(is_same), "{placed:?} {ray:?} {met:?} {limit} {first:?}");
}

pub(super) fn square(x: Double) -> Double {
    x * x
}

pub(super) fn greater(a: Double, b: Double) -> Double {
    if (a - b).0 < 0.0 { b } else { a }
}
