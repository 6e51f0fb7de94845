//! A ray that goes on from a surface does not meet it there again.

use super::box_::{point_of, random_box};
use super::ellipsoid::random_ellipsoid;
use super::plane::random_plane;
use super::*;

/// The ways a ray may go on from a surface: anywhere, nearly along it, straight up.
fn onward(random: &mut Random, normal: Vector) -> Vector {
    let across = normal.cross(random.direction().get());
    let steep = [random.number(-1.0, 1.0), random.size(-18.0, -1.0), -random.size(-18.0, -1.0)];
    let v = across + normal * steep[random.below(3)];
    [random.direction().get(), v, normal, v][random.below(4)]
}

/// Goes on from a surface point outward and finds nothing of the convex solid it left; goes on
/// inward and finds no entry.
pub(super) fn assert_leaves_for_good(
    random: &mut Random,
    surface: &SurfacePoint,
    at_edge: bool,
    chord: impl Fn(&Ray) -> Option<Chord>,
    what: impl std::fmt::Debug,
) {
    let Some(direction) = UnitVector::from_direction(onward(random, surface.normal)) else {
        return;
    };
    let direction = direction.get();
    let ray = Ray { origin: surface.spawn(direction), direction };
    let Some(Chord { enter, leave }) = chord(&ray) else { return };
    let slope = direction.dot(surface.normal);
    // At an edge the inside of one face may be outside of another.
    if slope < 0.0 && at_edge {
        return;
    }
    assert!(!enter.is_ahead(), "entered again, slope {slope:e}: {ray:?} {what:?}");
    assert!(slope < 0.0 || !leave.is_ahead(), "left again, slope {slope:e}: {ray:?} {what:?}");
    assert!(slope >= 0.0 || leave.t > 0.0, "no way out, slope {slope:e}: {ray:?} {what:?}");
}

#[test]
fn a_spawned_ray_does_not_meet_the_sphere_it_leaves() {
    let mut random = Random(7);
    for _ in 0..tries() {
        let radius = random.size(-8.0, 8.0);
        let centre = random.direction().get() * random.size(-8.0, 8.0);
        // Numbers about its centre lie farther apart than its radius: none is inside for a ray to
        // go on from.
        if radius < EPS * centre.length() {
            continue;
        }
        let sphere = Sphere { centre, radius };
        let ray = ray_at(&mut random, centre, radius, 10.0);
        let Some(chord) = sphere.chord(&ray) else { continue };
        let crossing = [chord.enter, chord.leave][random.below(2)];
        let surface = sphere.surface(&ray, crossing.t);
        let above = exact::above_sphere(centre, radius, surface.point);
        assert!(above.abs() <= surface.error, "{above:e}: {sphere:?} {ray:?}");
        assert!(sphere.bounds(Rounding::Outward).contains(surface.point), "{sphere:?} {ray:?}");
        assert_leaves_for_good(&mut random, &surface, false, |ray| sphere.chord(ray), sphere);
    }
}

#[test]
fn a_spawned_ray_does_not_meet_the_plane_it_leaves() {
    let mut random = Random(8);
    for _ in 0..tries() {
        let (normal, distance) = random_plane(&mut random);
        let plane = Plane { normal, distance };
        let ray = Ray { origin: random.point(10.0), direction: random.direction().get() };
        let Some(chord) = plane.chord(&ray) else { continue };
        let t = if chord.enter.t.is_finite() { chord.enter.t } else { chord.leave.t };
        let surface = plane.surface(&ray, t);
        let above = exact::above_plane(normal.get(), distance, surface.point);
        assert!(above.abs() <= surface.error, "{above:e}: {plane:?} {ray:?}");
        assert_leaves_for_good(&mut random, &surface, false, |ray| plane.chord(ray), plane);
    }
}

#[test]
fn a_spawned_ray_does_not_meet_the_box_it_leaves() {
    let mut random = Random(9);
    for _ in 0..tries() {
        let box_ = random_box(&mut random);
        let target = point_of(&mut random, &box_);
        let size = box_.half_widths.iter().copied().fold(0.0, f64::max);
        let origin = target + random.direction().get() * (size * 10.0);
        let Some(direction) = UnitVector::from_direction(target - origin) else { continue };
        let ray = Ray { origin, direction: direction.get() };
        let Some(chord) = box_.chord(&ray) else { continue };
        let leaving = random.below(2) == 1;
        let crossing = if leaving { chord.leave } else { chord.enter };
        let surface = box_.surface(&ray, crossing.t, leaving);
        let above = exact::above_face(&box_, surface.face, surface.point);
        assert!(above.abs() <= surface.error, "{above:e}: {box_:?} {ray:?}");
        let Bounds { low, high } = box_.bounds(Rounding::Outward);
        // An edge is met within the error of the ray, and of the box's place.
        let outside = (low - surface.point).max(surface.point - high).max_element();
        let blur = 1e5 * EPS * ((origin - box_.centre).length() + box_.centre.length());
        assert!(outside <= blur, "{outside:e}: {box_:?} {ray:?} {surface:?}");
        let near = |face: u32| exact::above_face(&box_, face, surface.point) > -4.0 * surface.error;
        let at_edge = (0..6).filter(|&face| near(face)).count() > 1;
        assert_leaves_for_good(&mut random, &surface, at_edge, |ray| box_.chord(ray), box_);
    }
}

#[test]
fn a_spawned_ray_does_not_meet_the_ellipsoid_it_leaves() {
    let mut random = Random(10);
    for _ in 0..tries() {
        let ellipsoid = random_ellipsoid(&mut random);
        let Placement { centre, world_from_local, local_from_world } = ellipsoid.placement;
        let target = centre + world_from_local * (random.direction().get() * 0.9);
        let origin = target + random.direction().get() * (world_from_local.x_axis.length() * 10.0);
        let Some(direction) = UnitVector::from_direction(target - origin) else { continue };
        let ray = Ray { origin, direction: direction.get() };
        let Some(chord) = ellipsoid.chord(&ray) else { continue };
        let crossing = [chord.enter, chord.leave][random.below(2)];
        let surface = ellipsoid.surface(&ray, crossing.t);
        let steepness = 1.0 / (world_from_local.transpose() * surface.normal).length();
        let above = exact::above_ellipsoid(&ellipsoid.placement, surface.point) / steepness;
        assert!(above.abs() <= surface.error, "{above:e}: {ellipsoid:?} {ray:?}");
        assert!(
            ellipsoid.bounds(Rounding::Outward).contains(surface.point),
            "{ellipsoid:?} {ray:?}"
        );
        assert!(local_from_world.determinant() != 0.0);
        assert_leaves_for_good(&mut random, &surface, false, |ray| ellipsoid.chord(ray), ellipsoid);
    }
}

#[test]
fn a_ray_that_starts_on_a_surface_does_not_meet_it_there() {
    let mut random = Random(11);
    for _ in 0..tries() {
        let radius = random.size(-8.0, 8.0);
        let sphere = Sphere { centre: Vector::ZERO, radius };
        let axis = [Vector::X, -Vector::Y, Vector::Z][random.below(3)];
        let direction = random.direction().get();
        let ray = Ray { origin: axis * radius, direction };
        let Some(Chord { enter, leave }) = sphere.chord(&ray) else { continue };
        assert!(!enter.is_ahead(), "{ray:?} {enter:?}");
        // Inward the far side is met; outward nothing.
        let slope = -direction.dot(axis);
        if slope.abs() > 1e-12 {
            assert_eq!(leave.is_ahead(), slope > 0.0, "{ray:?} {leave:?}");
        }
    }
}
