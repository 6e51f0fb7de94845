//! Each shape's kernels against exact arithmetic and the seed's terms.

use super::exact::{self, Double};
use super::*;
use crate::math::placement::Placement;
use crate::math::random::{Random, tries, tries_in};
use crate::math::{Matrix, UnitVector};
use leave::assert_leaves_for_good;

mod algebraic;
mod blob;
mod height_field;
mod isosurface;
mod julia_fractal;
mod leave;
mod mesh;
mod outline;
mod ovus;
mod parametric;
mod placed;
mod sheets;
mod superellipsoid;
mod sweep;

const EPS: f64 = f64::EPSILON;

/// A ray aimed at or near a thing of a given size, from `far` sizes away.
fn ray_at(random: &mut Random, centre: Vector, size: f64, far: f64) -> Ray {
    let origin = centre + random.direction().get() * (size * far);
    let reach = size * [0.5, 1.0, 1.2][random.below(3)];
    let target = centre + random.direction().get() * reach;
    let direction = UnitVector::from_direction(target - origin).unwrap_or(UnitVector::Z).get();
    Ray { origin, direction }
}

fn assert_within(crossing: Crossing, exact: Double, what: impl std::fmt::Debug) {
    let off = (Double::of(crossing.t) - exact).abs().0;
    assert!(off <= crossing.error, "off by {off:e}, claimed {:e}: {what:?}", crossing.error);
}

#[test]
fn a_sphere_is_hit_where_exact_arithmetic_hits_it_at_any_size_and_distance() {
    let mut random = Random(1);
    for _ in 0..tries() {
        let radius = random.size(-150.0, 150.0);
        let far = random.size(-1.0, 8.0);
        let centre = random.direction().get() * (radius * random.size(-8.0, 3.0));
        let ray = ray_at(&mut random, centre, radius, far);
        let sphere = Sphere { centre, radius };
        let (share, roots) = exact::sphere(centre, radius, &ray);
        match (sphere.chord(&ray), roots) {
            (Some(chord), Some([enter, leave])) => {
                assert_within(chord.enter, enter, (sphere, ray, share));
                assert_within(chord.leave, leave, (sphere, ray, share));
                assert!(chord.enter.t <= chord.leave.t);
                // And the claim is not idle.
                let blur = 30.0 * EPS * (far + 1.0);
                let fair = blur * (1.0 + (1.0 / share.sqrt()).min(1.0 / blur.sqrt()));
                let claimed = chord.leave.error.max(chord.enter.error) / radius;
                assert!(claimed <= 4.0 * fair.max(blur), "{claimed:e} {far:e} {share:e} {ray:?}");
            }
            (None, None) => {}
            (found, _) => assert!(
                share.abs() <= 16.0 * EPS * (far + 2.0),
                "{found:?}, h²/r² = {share:e}, {far:e} radii away"
            ),
        }
    }
}

#[test]
fn the_ground_of_a_planet_is_met_as_exactly_as_what_stands_on_it() {
    let mut random = Random(14);
    for _ in 0..tries() {
        let radius = random.size(4.5, 13.0);
        let up = [random.direction().get(), Vector::Y, -Vector::X][random.below(3)];
        let sphere = Sphere { centre: up * -radius, radius };
        let height = [1.0, -1.0][random.below(2)] * random.size(-9.0, 0.0);
        let origin = up * height + up.cross(random.direction().get());
        let direction = random.direction().get();
        let ray = Ray { origin, direction };
        let (_, roots) = exact::sphere(sphere.centre, radius, &ray);
        let (Some(chord), Some([enter, leave])) = (sphere.chord(&ray), roots) else { continue };
        let (crossing, exact) =
            if enter.0 > 0.0 { (chord.enter, enter) } else { (chord.leave, leave) };
        assert_within(crossing, exact, (sphere, ray));
        if crossing.t < 0.01 * radius && direction.dot(up).abs() > 0.1 {
            assert!(
                crossing.error <= 2000.0 * EPS * (crossing.t.abs() + 1.0),
                "{crossing:?} {ray:?}"
            );
        }
        let surface = sphere.surface(&ray, crossing.t);
        let above = exact::above_sphere(sphere.centre, radius, surface.point);
        assert!(above.abs() <= surface.error, "{above:e}: {sphere:?} {ray:?} {surface:?}");
        if surface.point.length() < 10.0 {
            assert!(surface.error < 1e3 * EPS, "{surface:?} {sphere:?} {ray:?}");
        }
        assert_leaves_for_good(&mut random, &surface, false, |ray| sphere.chord(ray), sphere);
    }
}

fn random_plane(random: &mut Random) -> (UnitVector, f64) {
    let normal = match random.below(3) {
        0 => [UnitVector::X, UnitVector::Y, -UnitVector::Z][random.below(3)],
        _ => random.direction(),
    };
    (normal, random.number(-1.0, 1.0) * random.size(-8.0, 8.0))
}

#[test]
fn a_plane_is_crossed_where_exact_arithmetic_crosses_it() {
    let mut random = Random(2);
    let mut told = 0;
    for _ in 0..tries() {
        let (normal, distance) = random_plane(&mut random);
        let reach = random.size(-8.0, 8.0);
        let mut direction = random.direction().get();
        if random.below(2) == 0 {
            // Nearly along the plane.
            let off =
                normal.get() * (direction.dot(normal.get()) * (1.0 - random.size(-16.0, 0.0)));
            direction = UnitVector::from_direction(direction - off).unwrap_or(normal).get();
        }
        let ray = Ray { origin: random.point(reach), direction };
        let exact = exact::plane(normal.get(), distance, &ray);
        let chord = Plane { normal, distance }.chord(&ray);
        let Some(Chord { enter, leave }) = chord else { continue };
        let crossing = if enter.t.is_finite() { enter } else { leave };
        if crossing.t.is_finite() && crossing.error < crossing.t.abs() {
            told += 1;
            assert_within(crossing, exact, (normal, distance, ray));
        }
    }
    assert!(told > 4 * tries() / 5, "{told} crossings told from the start");
}

#[test]
fn a_ray_along_a_plane_is_inside_or_misses() {
    let plane = Plane { normal: UnitVector::Y, distance: 1.0 };
    for zero in [0.0, -0.0] {
        let chord = |y| {
            let direction = Vector::new(1.0, zero, 0.0);
            plane.chord(&Ray { origin: Vector::new(0.0, y, 0.0), direction })
        };
        assert_eq!(chord(1.0), None);
        assert_eq!(chord(2.0), None);
        let through = Chord { enter: Crossing::BEFORE_ALL, leave: Crossing::BEYOND_ALL };
        assert_eq!(chord(0.5), Some(through));
    }
    // A slope of 1e-320 is a slope.
    let ray = Ray { origin: Vector::Y * 1.5, direction: Vector::new(1.0, -1e-300, 0.0) };
    let enter = plane.chord(&ray).map(|chord| chord.enter);
    assert!(enter.is_some_and(|enter| enter.is_ahead() && enter.t > 1e299), "{enter:?}");
}

fn random_box(random: &mut Random) -> Box_ {
    let size = random.size(-8.0, 8.0);
    let normals = loop {
        let normals = match random.below(3) {
            0 => [UnitVector::X, -UnitVector::Y, UnitVector::Z],
            1 => {
                let a = random.direction().get();
                let b = a.cross(random.direction().get());
                let Some(b) = UnitVector::from_direction(b) else { continue };
                let Some(c) = UnitVector::from_direction(a.cross(b.get())) else { continue };
                [UnitVector::from_unit(a), b, c]
            }
            _ => [random.direction(), random.direction(), random.direction()],
        };
        let [a, b, c] = normals.map(UnitVector::get);
        if a.dot(b.cross(c)).abs() > 1e-3 {
            break normals;
        }
    };
    let half_widths =
        [0; 3].map(|_| if random.below(20) == 0 { 0.0 } else { size * random.size(-3.0, 0.0) });
    let centre = random.direction().get() * (size * random.size(-8.0, 4.0));
    Box_ { centre, normals, half_widths }
}

/// A point in or on the box: each coordinate inside, on a face, or in the middle.
fn point_of(random: &mut Random, box_: &Box_) -> Vector {
    let edges = [0, 1, 2].map(|axis| box_.face(axis).centre - box_.centre);
    edges.into_iter().fold(box_.centre, |sum, edge| {
        sum + edge * [-1.0, 0.0, 1.0, random.number(-1.1, 1.1)][random.below(4)]
    })
}

#[test]
fn a_box_is_crossed_where_exact_arithmetic_crosses_it() {
    let mut random = Random(3);
    let (mut hits, mut misses) = (0, 0);
    for _ in 0..tries() {
        let box_ = random_box(&mut random);
        let size = box_.half_widths.iter().copied().fold(0.0, f64::max);
        let target = point_of(&mut random, &box_);
        let origin = target + random.direction().get() * (size * random.size(-1.0, 5.0));
        let Some(direction) = UnitVector::from_direction(target - origin) else { continue };
        let ray = Ray { origin, direction: direction.get() };
        let [enter, leave] = exact::slabs(&box_, &ray);
        match box_.chord(&ray) {
            Some(chord) => {
                hits += 1;
                let slack = chord.enter.error + chord.leave.error;
                assert!((leave - enter).0 >= -slack, "a false hit of {box_:?} {ray:?}");
                if chord.enter.t < chord.leave.t {
                    assert_within(chord.enter, enter, (box_, ray));
                    assert_within(chord.leave, leave, (box_, ray));
                }
            }
            None => {
                misses += 1;
                assert!((leave - enter).0 <= 0.0, "a hole in {box_:?} {ray:?}");
            }
        }
    }
    assert!(hits > tries() / 3 && misses > tries() / 50, "{hits} hits, {misses} misses");
}

#[test]
fn a_box_answers_structured_rays_without_a_nan() {
    let cube = Box_ {
        centre: Vector::ZERO,
        normals: [UnitVector::X, UnitVector::Y, UnitVector::Z],
        half_widths: [1.0; 3],
    };
    let places = [-2.0, -1.0, -0.0, 0.0, 0.5, 1.0, 2.0];
    let slopes = [-1.0, -1e-310, -1e-160, -0.0, 0.0, 1e-300, 1e-17, 1.0];
    let mut random = Random(4);
    for _ in 0..tries() {
        let origin = Vector::from_array([0; 3].map(|_| places[random.below(7)]));
        let v = Vector::from_array([0; 3].map(|_| slopes[random.below(8)]));
        let Some(direction) = UnitVector::from_direction(v) else { continue };
        let ray = Ray { origin, direction: direction.get() };
        let Some(chord) = cube.chord(&ray) else { continue };
        assert!(!chord.enter.t.is_nan() && !chord.leave.t.is_nan(), "{ray:?} {chord:?}");
        assert!(!chord.enter.error.is_nan() && !chord.leave.error.is_nan(), "{ray:?} {chord:?}");
        assert!(chord.enter.t <= chord.leave.t, "{ray:?} {chord:?}");
        for (crossing, leaving) in [(chord.enter, false), (chord.leave, true)] {
            if crossing.t.abs() < 1e10 {
                let surface = cube.surface(&ray, crossing.t, leaving);
                let above = exact::above_face(&cube, surface.face, surface.point);
                assert!(above.abs() <= surface.error && surface.point.is_finite(), "{ray:?}");
            }
        }
    }
}

#[test]
fn a_wall_of_boxes_has_no_holes_where_they_touch() {
    let mut random = Random(5);
    for _ in 0..tries() {
        let [a, b, c] = [0; 3].map(|_| random.direction());
        let size = random.size(-4.0, 4.0);
        let half_widths = [size; 3];
        let left = Box_ { centre: random.point(1e3), normals: [a, b, c], half_widths };
        let seam = left.face(0).centre;
        let right = Box_ { centre: seam + (seam - left.centre), ..left };
        let target =
            seam + b.get().cross(c.get()).cross(a.get()) * (size * random.number(-0.3, 0.3));
        let origin = target + random.direction().get() * (size * 20.0);
        let Some(direction) = UnitVector::from_direction(target - origin) else { continue };
        let ray = Ray { origin, direction: direction.get() };
        // The right box's centre was rounded: as far as that opens a gap it is a gap.
        let gap =
            exact::above_face(&right, 1, seam).abs() + exact::above_face(&left, 0, seam).abs();
        if gap < 1e-13 * size {
            assert!(left.chord(&ray).is_some() || right.chord(&ray).is_some(), "{left:?} {ray:?}");
        }
    }
}

fn random_ellipsoid(random: &mut Random) -> Ellipsoid {
    let size = random.size(-6.0, 6.0);
    let stretch = Vector::from_array([0; 3].map(|_| random.size(-2.0, 1.0)));
    let world_from_local = random.matrix() * Matrix::from_diagonal(stretch * size);
    let centre = random.direction().get() * (size * random.size(-8.0, 4.0));
    let local_from_world = world_from_local.inverse();
    Ellipsoid { placement: Placement { centre, world_from_local, local_from_world } }
}

#[test]
fn an_ellipsoid_is_hit_where_exact_arithmetic_hits_it() {
    let mut random = Random(6);
    let (mut hits, mut misses) = (0, 0);
    for _ in 0..tries() {
        let ellipsoid = random_ellipsoid(&mut random);
        let Placement { centre, world_from_local, .. } = ellipsoid.placement;
        let target = centre + world_from_local * (random.direction().get() * 1.05);
        let far = random.size(-1.0, 6.0);
        let size = world_from_local.x_axis.length();
        let origin = target + random.direction().get() * (size * far);
        let Some(direction) = UnitVector::from_direction(target - origin) else { continue };
        let ray = Ray { origin, direction: direction.get() };
        let (share, roots) = exact::ellipsoid(&ellipsoid.placement, &ray);
        match (ellipsoid.chord(&ray), roots) {
            (Some(chord), Some([enter, leave])) => {
                hits += 1;
                assert_within(chord.enter, enter, (ellipsoid, ray));
                assert_within(chord.leave, leave, (ellipsoid, ray));
            }
            (None, None) => misses += 1,
            _ => assert!(share.abs() < 1e5 * EPS * (far + 1.0), "{share:e} {far:e}"),
        }
    }
    assert!(hits > tries() / 5 && misses > tries() / 50, "{hits} hits, {misses} misses");
}

#[test]
fn a_moved_ray_hits_a_moved_shape_at_the_same_distance() {
    let mut random = Random(12);
    for _ in 0..tries() {
        let a = random.direction().get();
        let Some(b) = UnitVector::from_direction(a.cross(random.direction().get())) else {
            continue;
        };
        let turn = Matrix::from_cols(a, b.get(), a.cross(b.get()));
        let shift = random.point(10.0);
        let place = |p: Vector| turn * p + shift;
        let sphere = Sphere { centre: random.point(1.0), radius: 0.7 };
        let box_ = Box_ {
            half_widths: [0.7, 0.5, 0.3],
            centre: random.point(1.0),
            ..random_box(&mut random)
        };
        let ray = ray_at(&mut random, box_.centre, 0.5, 5.0);
        let moved = Ray { origin: place(ray.origin), direction: turn * ray.direction };
        let moved_sphere = Sphere { centre: place(sphere.centre), ..sphere };
        let unit = |n: UnitVector| UnitVector::from_unit((turn * n.get()).normalize());
        let moved_box =
            Box_ { centre: place(box_.centre), normals: box_.normals.map(unit), ..box_ };
        for (here, there) in [
            (sphere.chord(&ray), moved_sphere.chord(&moved)),
            (box_.chord(&ray), moved_box.chord(&moved)),
        ] {
            if let (Some(here), Some(there)) = (here, there) {
                // The move itself rounds: as much as a start some 20 units off.
                let off = (here.enter.t - there.enter.t).abs();
                let slack = 100.0 * (here.enter.error + there.enter.error) + 1e-13;
                assert!(off <= slack, "{off:e}: {ray:?}");
            }
        }
    }
}

#[test]
fn a_face_is_told_in_the_seeds_terms() {
    let box_ = Box_ {
        centre: Vector::new(1.0, 2.0, 3.0),
        normals: [UnitVector::X, UnitVector::Y, UnitVector::Z],
        half_widths: [0.5, 1.0, 2.0],
    };
    let face = box_.face(1);
    assert_eq!(face.normal, UnitVector::Y);
    assert_eq!((face.centre, face.distance), (Vector::new(1.0, 3.0, 3.0), 3.0));
    assert_eq!((face.opposite_centre, face.opposite_distance), (Vector::new(1.0, 1.0, 3.0), -1.0));
    assert_eq!(face.half_width, 1.0);
    let low = box_.corners().into_iter().fold(Vector::INFINITY, Vector::min);
    assert_eq!(low, Vector::new(0.5, 1.0, 1.0));
    assert_eq!(box_.signed_distance(Vector::new(1.25, 2.0, 3.0)), 0.25);
    assert_eq!(box_.signed_distance(Vector::new(3.0, 2.0, 3.0)), -1.5);
    assert!(box_.contains(box_.centre) && !box_.contains(box_.face(2).centre));
}

#[test]
fn distances_are_positive_inside() {
    let plane = Plane { normal: UnitVector::Y, distance: 2.0 };
    assert_eq!([0.0, 2.0, 5.0].map(|y| plane.signed_distance(Vector::Y * y)), [2.0, 0.0, -3.0]);
    let sphere = Sphere { centre: Vector::X, radius: 2.0 };
    assert_eq!([1.0, 3.0, 6.0].map(|x| sphere.signed_distance(Vector::X * x)), [2.0, 0.0, -3.0]);
}

#[test]
fn single_precision_kernels_keep_their_own_bounds() {
    let mut random = Random(13);
    let mut hits = 0;
    for _ in 0..tries() {
        let sphere = Sphere { centre: random.point(10.0), radius: random.size(-1.0, 1.0) };
        let far = random.size(0.0, 3.0);
        let ray = ray_at(&mut random, sphere.centre, sphere.radius, far);
        let single = Ray::<f32> {
            origin: Vector3::from_vector(ray.origin),
            direction: Vector3::from_vector(ray.direction),
        };
        let wide =
            Ray { origin: single.origin.to_vector(), direction: single.direction.to_vector() };
        let centre = <<f32 as Real>::Vector as Vector3<f32>>::from_vector(sphere.centre);
        let radius = sphere.radius as f32;
        let (_, roots) = exact::sphere(centre.to_vector(), f64::from(radius), &wide);
        if let (Some(chord), Some([enter, leave])) = (sphere::chord(centre, radius, &single), roots)
        {
            hits += 1;
            for (crossing, exact) in [(chord.enter, enter), (chord.leave, leave)] {
                let off = (f64::from(crossing.t) - exact.0).abs();
                assert!(off <= f64::from(crossing.error), "{off:e} {crossing:?} {single:?}");
            }
        }
    }
    assert!(hits > tries() / 4, "{hits}");
}

#[test]
fn a_planes_easy_bound_is_no_less_than_its_bound() {
    let mut random = Random(78);
    let mut count = 0;
    for _ in 0..tries() {
        let size = random.size(-100.0, 100.0);
        let plane = Plane { normal: random.direction(), distance: size * random.number(-1.0, 1.0) };
        let far = random.size(-3.0, 6.0);
        let ray = ray_at(&mut random, Vector::ZERO, size, far);
        let Some((speed, t)) = plane.pass(&ray) else { continue };
        let Some(easy) = plane.roughly(&ray, speed, t) else { continue };
        let Some(chord) = plane.chord(&ray) else { panic!("{plane:?} {ray:?}") };
        let tight = if speed > 0.0 { chord.leave } else { chord.enter };
        assert_eq!(easy.t, tight.t);
        assert!(easy.error >= tight.error && tight.is_ahead(), "{plane:?} {ray:?}");
        count += 1;
    }
    assert!(count > tries() / 4, "{count}");
}
