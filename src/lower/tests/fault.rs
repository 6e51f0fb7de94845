//! What cannot be built is reported where it stands, and the rest is built.

use super::super::{LowerOptions, lower};
use super::build::*;
use crate::color::Rgb;
use crate::diagnostic::{Code, Diagnostics};
use crate::math::Vector;
use crate::math::transform::Step;
use crate::scene::*;

/// The codes of a Scene that holds one object under steps.
fn codes(kind: ObjectKind, steps: Vec<Step>) -> Vec<Code> {
    let mut build = Build::new();
    let object = build.moved(kind, steps);
    build.root(object);
    build.codes()
}

#[test]
fn a_transform_that_flattens_is_named_and_its_object_left_out() {
    let mut build = Build::new();
    let flat = build.moved(sphere(0.0, 0.0, 0.0, 1.0), vec![scale(1.0, 0.0, 1.0)]);
    let whole = build.object(sphere(0.0, 0.0, 0.0, 1.0), vec![]);
    build.root(flat);
    build.root(whole);
    let (world, _, diagnostics) = build.lower();
    let list: Vec<_> = diagnostics.iter().collect();
    assert_eq!(list.len(), 1);
    assert_eq!(list[0].code, Code::ZeroScale);
    assert_eq!(list[0].primary().map(|l| l.span), Some(site(500).span));
    assert_eq!(world.objects.len(), 1);
}

#[test]
fn a_singular_matrix_is_a_zero_scale_also_when_rounding_hides_it() {
    let rows = |a: Vector, b: Vector| Step::Matrix([a, b, a * 2.0 + b * 3.0, Vector::ZERO]);
    let ball = || sphere(0.0, 0.0, 0.0, 1.0);
    assert_eq!(codes(ball(), vec![rows(v(1.0, 2.0, 3.0), v(4.0, 5.0, 6.0))]), [Code::ZeroScale]);
    let turned = vec![
        rotate(10.0, 20.0, 30.0),
        rows(v(1.0, 2.0, 3.0), v(4.0, 5.0, 6.0)),
        rotate(40.0, 50.0, 60.0),
    ];
    assert_eq!(codes(ball(), turned), [Code::ZeroScale]);
    assert_eq!(
        codes(ball(), vec![scale(1.0, 1e-20, 1.0), rotate(10.0, 20.0, 30.0)]),
        [Code::NoLight]
    );
}

#[test]
fn numbers_without_end_are_reported() {
    let huge = vec![scale(1e200, 1e200, 1e200), scale(1e200, 1e200, 1e200)];
    assert_eq!(codes(sphere(0.0, 0.0, 0.0, 1.0), huge), [Code::NotANumber]);
    let nan = vec![rotate(f64::NAN, 0.0, 0.0)];
    assert_eq!(codes(plane(0.0, 1.0, 0.0, 1.0), nan), [Code::NotANumber]);
    let ball = |r| sphere(f64::INFINITY, 0.0, 0.0, r);
    assert_eq!(codes(ball(1.0), vec![]), [Code::NotANumber]);
    assert_eq!(codes(sphere(0.0, 0.0, 0.0, f64::NAN), vec![]), [Code::NotANumber]);
    assert_eq!(codes(plane(0.0, f64::NAN, 1.0, 0.0), vec![]), [Code::NotANumber]);
    assert_eq!(codes(plane(0.0, 1.0, 0.0, f64::NAN), vec![]), [Code::NotANumber]);
    let cube = box_(v(0.0, 0.0, 0.0), v(1.0, f64::NAN, 1.0));
    assert_eq!(codes(cube, vec![]), [Code::NotANumber]);
}

#[test]
fn things_without_size_are_reported() {
    assert_eq!(codes(sphere(0.0, 0.0, 0.0, 0.0), vec![]), [Code::ZeroSize]);
    assert_eq!(codes(plane(0.0, 0.0, 0.0, 1.0), vec![]), [Code::ZeroVector]);
    let point = v(1.0, 2.0, 3.0);
    assert_eq!(codes(box_(point, point), vec![]), [Code::ZeroSize]);
    assert_eq!(codes(box_(point, v(1.0, 2.0, 4.0)), vec![]), [Code::ZeroSize]);
    assert_eq!(
        codes(box_(point, v(1.0, 4.0, 4.0)), vec![]),
        [Code::DegenerateShape, Code::NoLight, Code::NothingInView]
    );
}

#[test]
fn what_transforms_bring_to_nothing_is_reported() {
    let ball = sphere(0.0, 0.0, 0.0, 1.0);
    assert_eq!(codes(ball.clone(), vec![scale(0.0, 0.0, 0.0)]), [Code::ZeroScale]);
    let tiny = vec![scale(1e-150, 1e-150, 1e-150)];
    assert_eq!(codes(sphere(0.0, 0.0, 0.0, 1e-200), tiny.clone()), [Code::ZeroSize]);
    let cube = box_(Vector::ZERO, v(1e-200, 1e-200, 1.0));
    assert_eq!(codes(cube, tiny), [Code::ZeroSize]);
}

#[test]
fn a_box_without_thickness_is_a_sheet() {
    let world = spend(box_(v(0.0, 2.0, 0.0), v(1.0, 2.0, 1.0)), vec![]);
    assert_eq!(world.boxes[0].half_widths, [0.5, 0.0, 0.5]);
}

fn light(color: Rgb) -> ObjectKind {
    let kind = LightKind::Point { location: v(1.0, 2.0, 3.0) };
    ObjectKind::LightSource(Box::new(LightSource::new(kind, color)))
}

#[test]
fn a_black_light_is_dropped_and_that_is_said() {
    let mut build = Build::new();
    for color in [Rgb::BLACK, Rgb::WHITE] {
        let light = build.moved(light(color), vec![scale(2.0, 2.0, 2.0)]);
        build.root(light);
    }
    let (world, origins, _) = build.lower();
    assert_eq!(world.lights.len(), 1);
    let position = v(2.0, 4.0, 6.0);
    assert_eq!(world.lights[0].kind, crate::world::LightKind::Point { position });
    let dropped = &origins.dropped[0];
    assert_eq!((&*dropped.what, &*dropped.why), ("light_source", "its colour is black"));
}

#[test]
fn parallel_light_comes_from_where_it_stands() {
    let mut build = Build::new();
    let kind =
        LightKind::Parallel { location: v(0.0, 9.0, 0.0), point_at: v(0.0, 1.0, 0.0), beam: None };
    let source = LightSource { shadowless: true, ..LightSource::new(kind, Rgb::WHITE) };
    let light =
        build.moved(ObjectKind::LightSource(Box::new(source)), vec![rotate(90.0, 0.0, 0.0)]);
    build.root(light);
    let light = build.world().lights[0];
    let to_light = crate::math::UnitVector::Z;
    let position = v(0.0, 0.0, 9.0);
    assert_eq!(light.kind, crate::world::LightKind::Parallel { position, to_light });
    assert!(!light.casts_shadows);
}

#[test]
fn a_scene_nobody_can_see_is_told_so() {
    let mut dark = Build::new();
    dark.0.finishes[0] =
        Finish::Classic(ClassicFinish { ambient: Rgb::BLACK, ..Default::default() });
    let object = dark.object(sphere(0.0, 0.0, 0.0, 1.0), vec![]);
    dark.root(object);
    assert_eq!(dark.codes(), [Code::NoLight]);
    // The default ambient, 0.1 of white, leaves the picture dark; more is meant.
    assert_eq!(codes(sphere(0.0, 0.0, 0.0, 1.0), vec![]), [Code::NoLight]);
    let mut glowing = Build::new();
    glowing.0.finishes[0] =
        Finish::Classic(ClassicFinish { ambient: Rgb::gray(0.5), ..Default::default() });
    let object = glowing.object(sphere(0.0, 0.0, 0.0, 1.0), vec![]);
    glowing.root(object);
    assert_eq!(glowing.codes(), []);
    assert_eq!(Build::new().codes(), [Code::EmptyScene]);
    let mut blind = Build::new();
    blind.0.cameras.clear();
    assert_eq!(blind.codes(), [Code::NoCamera, Code::EmptyScene]);
    let mut double = Build::new();
    let camera = double.0.cameras[0].clone();
    double.0.cameras.push(camera);
    assert_eq!(double.codes(), [Code::DuplicateCamera, Code::EmptyScene]);
}

#[test]
fn unions_that_double_for_ever_meet_a_limit() {
    let mut build = Build::new();
    let mut object = build.object(ObjectKind::Union(vec![]), vec![]);
    for _ in 0..60 {
        object = build.object(ObjectKind::Union(vec![object, object]), vec![]);
    }
    build.root(object);
    assert_eq!(build.codes(), [Code::ObjectLimit]);
}

#[test]
fn a_solid_that_meets_the_limit_leaves_its_parts() {
    let mut build = Build::new();
    let mut ball = || build.object(sphere(0.0, 0.0, 0.0, 1.0), vec![]);
    let children = vec![ball(), ball(), ball()];
    let solid = ObjectKind::Csg { operation: Operation::Intersection, children };
    let solid = build.object(solid, vec![]);
    build.root(solid);
    let mut told = Diagnostics::new(true);
    let options = LowerOptions { objects: 3, ..LowerOptions::default() };
    let (world, _) = lower(build.0, &options, &mut told);
    assert!(told.iter().any(|one| one.code == Code::ObjectLimit));
    assert_eq!(world.solids().count(), 2);
}
