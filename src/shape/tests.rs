//! Each shape's kernels against exact arithmetic and the seed's terms.

use super::exact::{self, Double};
use super::*;
use crate::math::placement::Placement;
use crate::math::random::{Random, tries, tries_in};
use crate::math::{Matrix, UnitVector};
use box_::random_box;
use leave::assert_leaves_for_good;

mod algebraic;
mod algebraic_ends;
mod bicubic_patch;
mod blob;
mod box_;
mod cone;
mod cylinder;
mod disc;
mod ellipsoid;
mod height_field;
mod isosurface;
mod julia_fractal;
mod lathe;
mod leave;
mod level;
mod mesh;
mod outline;
mod ovus;
mod parametric;
mod placed;
mod plane;
mod polygon;
mod prism;
mod sor;
mod sphere;
mod sphere_sweep;
mod superellipsoid;
mod text;
mod torus;

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
fn distances_are_positive_inside() {
    let plane = Plane { normal: UnitVector::Y, distance: 2.0 };
    assert_eq!([0.0, 2.0, 5.0].map(|y| plane.signed_distance(Vector::Y * y)), [2.0, 0.0, -3.0]);
    let sphere = Sphere { centre: Vector::X, radius: 2.0 };
    assert_eq!([1.0, 3.0, 6.0].map(|x| sphere.signed_distance(Vector::X * x)), [2.0, 0.0, -3.0]);
}
