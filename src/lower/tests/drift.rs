//! Long chains and far places: what extended precision is for.

use super::build::*;
use super::seed_rules::Numbers;
use crate::math::Matrix;
use crate::math::elementary::pow;
use crate::math::transform::Step;
use crate::shape::Shape;

#[test]
fn a_hundred_thousand_small_turns_are_one_turn() {
    let angle = 1.0 / 1024.0;
    let chained = spend(sphere(1.0, 0.0, 0.0, 1.0), vec![rotate(0.0, angle, 0.0); 100_000]);
    let once = spend(sphere(1.0, 0.0, 0.0, 1.0), vec![rotate(0.0, angle * 100_000.0, 0.0)]);
    assert_eq!(chained.spheres, once.spheres);
    let full = spend(sphere(3.0, 0.0, 0.0, 1.0), vec![rotate(0.0, 0.0, 360.0 / 1024.0); 102_400]);
    assert!(full.spheres[0].centre.distance(v(3.0, 0.0, 0.0)) < 1e-29);
    assert_eq!(full.spheres[0].radius, 1.0);
}

#[test]
fn a_thousand_turns_about_all_axes_keep_a_sphere_a_sphere_and_a_box_square() {
    let mut numbers = Numbers::new(7);
    let steps: Vec<_> = (0..1000).map(|_| Step::Rotate(numbers.vector(180.0))).collect();
    let ball = spend(sphere(0.0, 0.0, 0.0, 1.0), steps.clone());
    assert_eq!(ball.objects[0].shape, Shape::Sphere(0));
    assert_eq!(ball.spheres[0].radius, 1.0);
    let cube = spend(box_(v(-1.0, -1.0, -1.0), v(1.0, 1.0, 1.0)), steps).boxes[0];
    assert_eq!(cube.half_widths, [1.0; 3]);
    let [x, y, z] = cube.normals.map(|n| n.get());
    assert!(x.dot(y).abs().max(y.dot(z).abs()).max(z.dot(x).abs()) < 3e-16);
}

#[test]
fn a_step_in_ten_quadrillion_is_seen() {
    let world = spend(sphere(0.0, 0.0, 0.0, 1.0), vec![scale(1.0, 1.0 + f64::EPSILON, 1.0)]);
    assert_eq!(world.objects[0].shape, Shape::Ellipsoid(0));
}

#[test]
fn an_ellipsoids_two_matrices_undo_each_other() {
    let mut numbers = Numbers::new(3);
    for _ in 0..200 {
        let mut steps = vec![];
        for _ in 0..4 {
            steps.push(Step::Rotate(numbers.vector(180.0)));
            let stretch = numbers.vector(4.0).map(|c| pow(10.0, c.trunc()));
            steps.push(Step::Scale(stretch));
            steps.push(Step::Translate(numbers.vector(1e6)));
        }
        let world = spend(sphere(0.0, 0.0, 0.0, 1.0), steps);
        let Some(ellipsoid) = world.ellipsoids.first() else { continue };
        let (there, back) =
            (ellipsoid.placement.world_from_local, ellipsoid.placement.local_from_world);
        let norm = |m: Matrix| m.to_cols_array().iter().fold(0.0f64, |a, c| a.max(c.abs()));
        let condition = norm(there) * norm(back);
        assert!(norm(there * back - Matrix::IDENTITY) <= 8.0 * f64::EPSILON * condition);
        assert_eq!(there, there.transpose());
        assert_eq!(back, back.transpose());
    }
}

#[test]
fn sizes_far_from_one_lose_nothing() {
    for power in [-120, -40, 40, 120] {
        let k = pow(2.0, f64::from(power * 4));
        let ball = spend(sphere(1.0, 2.0, 3.0, 5.0), vec![rotate(1.0, 2.0, 3.0), scale(k, k, k)]);
        let near = spend(sphere(1.0, 2.0, 3.0, 5.0), vec![rotate(1.0, 2.0, 3.0)]);
        assert_eq!(ball.spheres[0].centre, near.spheres[0].centre * k, "2^{}", power * 4);
        assert_eq!(ball.spheres[0].radius, 5.0 * k);
        let cube = || box_(v(-1.0, 2.0, -3.0), v(4.0, 5.0, 6.0));
        let far = spend(cube(), vec![rotate(1.0, 2.0, 3.0), scale(k, k, k)]).boxes[0];
        let near = spend(cube(), vec![rotate(1.0, 2.0, 3.0)]).boxes[0];
        assert_eq!(far.normals, near.normals);
        assert_eq!(far.half_widths, near.half_widths.map(|w| w * k));
    }
}

#[test]
fn the_deepest_nest_and_the_longest_chain_of_uses_overflow_nothing() {
    use crate::scene::ObjectKind;
    let mut build = Build::new();
    let mut object = build.object(sphere(0.0, 0.0, 0.0, 1.0), vec![]);
    for level in 0..100_000 {
        let kind = match level % 2 {
            0 => ObjectKind::Union(vec![object]),
            _ => ObjectKind::Use(object),
        };
        object = build.object(kind, vec![]);
    }
    build.root(object);
    assert_eq!(build.world().spheres.len(), 1);
}
