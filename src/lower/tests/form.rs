//! The rows of the table: which canonical form a solid takes, and that it is the right one.

use super::build::*;
use crate::math::transform::Step;
use crate::math::{Matrix, UnitVector, Vector};
use crate::shape::{Box_, Plane, Shape, Sphere};

fn unit(x: f64, y: f64, z: f64) -> UnitVector {
    UnitVector::from_direction(v(x, y, z)).expect("a direction")
}

#[test]
fn a_sphere_moved_turned_and_scaled_evenly_is_a_sphere() {
    let world = spend(
        sphere(1.0, 0.0, 0.0, 2.0),
        vec![scale(3.0, 3.0, 3.0), rotate(0.0, 0.0, 90.0), translate(0.5, 0.0, -4.0)],
    );
    assert_eq!(world.spheres, [Sphere { centre: v(0.5, 3.0, -4.0), radius: 6.0 }]);
    let odd =
        spend(sphere(0.0, 0.0, 0.0, 1.0), vec![rotate(10.0, 20.0, 33.0), scale(0.1, 0.1, 0.1)]);
    assert_eq!(odd.objects[0].shape, Shape::Sphere(0));
    assert_eq!(odd.spheres[0].radius, 0.1);
}

#[test]
fn a_mirrored_sphere_is_a_sphere() {
    let world = spend(sphere(1.0, 2.0, 3.0, 2.0), vec![scale(-2.0, 2.0, 2.0)]);
    assert_eq!(world.spheres, [Sphere { centre: v(-2.0, 4.0, 6.0), radius: 4.0 }]);
}

#[test]
fn a_sphere_scaled_unevenly_is_an_ellipsoid() {
    let world =
        spend(sphere(1.0, 1.0, 1.0, 2.0), vec![scale(1.0, 2.0, -4.0), translate(10.0, 0.0, 0.0)]);
    let placement = world.ellipsoids[0].placement;
    assert_eq!(placement.centre, v(11.0, 2.0, -4.0));
    assert_eq!(placement.world_from_local, Matrix::from_diagonal(v(2.0, 4.0, 8.0)));
    assert_eq!(placement.local_from_world, Matrix::from_diagonal(v(0.5, 0.25, 0.125)));
}

#[test]
fn a_plane_stays_a_plane_under_every_map() {
    let moved = spend(plane(0.0, 2.0, 0.0, 1.5), vec![translate(7.0, 0.5, 0.0)]);
    assert_eq!(moved.planes, [Plane { normal: UnitVector::Y, distance: 2.0 }]);
    let sheared =
        spend(plane(1.0, 1.0, 0.0, 0.0), vec![scale(2.0, 1.0, 1.0), translate(0.0, 1.0, 0.0)]);
    let Plane { normal, distance } = sheared.planes[0];
    assert!((normal.get() - unit(1.0, 2.0, 0.0).get()).length() < 1e-16);
    assert!((distance - 2.0 / 5f64.sqrt()).abs() < 1e-16);
}

#[test]
fn a_box_under_a_shear_is_a_parallelepiped() {
    let shear =
        Step::Matrix([v(1.0, 0.0, 0.0), v(1.0, 1.0, 0.0), v(0.0, 0.0, 1.0), v(0.0, 0.0, 0.0)]);
    let world = spend(box_(v(-1.0, -1.0, -1.0), v(1.0, 1.0, 1.0)), vec![shear]);
    let Box_ { centre, normals, half_widths } = world.boxes[0];
    assert_eq!(centre, Vector::ZERO);
    assert_eq!(normals[1], UnitVector::Y);
    assert_eq!(normals[2], UnitVector::Z);
    assert!((normals[0].get() - unit(1.0, -1.0, 0.0).get()).length() < 2e-16);
    assert!((half_widths[0] - 0.5f64.sqrt()).abs() < 2e-16);
    assert_eq!(half_widths[1..], [1.0, 1.0]);
}
