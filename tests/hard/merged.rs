//! Glass of several parts that touch, solids taken from one another forty times, balls that touch from
//! inside: row 35.

use super::coinciding::text_moved;
use super::held::Truth;
use super::scene::{
    Camera, Light, Object, Operation, Scene, Step, WHITE, cone, cuboid, sphere, ten, whole,
};

const SIZE: (u32, u32) = (32, 24);

/// Holds a scene, shown by the words of another that is to look alike, in several sizes and places.
#[track_caller]
fn hold_alike(name: &str, scene: &Scene, alike: &Scene) {
    let truth = Truth::of(scene, SIZE);
    for exponent in [-12, -3, 0, 5, 12] {
        for (turn, far) in [(0.0, 0.0), (77.7, 10.0), (1e-5, 1e4)] {
            let k = ten(exponent);
            let steps = [
                Step::Rotate([turn, 2.0 * turn, -turn]),
                Step::Scale([k; 3]),
                Step::Translate([far * k, -far * k, 0.3 * far * k]),
            ];
            let name = format!("{name}, size 1e{exponent}, turned by {turn}, {far} sizes off");
            truth.hold(&name, &text_moved(alike, &steps));
        }
    }
}

fn seen(objects: Vec<Object>) -> Scene {
    let camera =
        Camera::LookAt { location: [1.7, 2.3, 4.1], look_at: [0.0, -0.1, 0.0], angle: 40.0 };
    let board = cuboid([-5.0, -2.0, -5.0], [5.0, -1.5, 5.0]);
    let board = board.checker(&[Step::Scale([0.7; 3])]).finish(0.3, 0.6, 0.0);
    let light = Light { position: [4.0, 6.0, 5.0], color: WHITE };
    Scene::new(camera, &[light], [vec![board], objects].concat()).deep(12)
}

fn glass(object: Object, ior: f64) -> Object {
    let solid = match object.solid {
        super::scene::Solid::Whole { operation, parts } => super::scene::Solid::Whole {
            operation,
            parts: parts.into_iter().map(|part| glass(part, ior)).collect(),
        },
        solid => solid,
    };
    let object = Object { solid, ..object }.color([0.9, 0.6, 0.5]).finish(0.1, 0.0, 0.0);
    Object { filter: 0.8, transmit: 0.1, ior, ..object }
}

/// A solid, and what is the same of parts that touch.
fn alike() -> Vec<(&'static str, Object, Object)> {
    let merge = |parts| whole(Operation::Merge, parts);
    let half =
        |low, high| whole(Operation::Intersection, vec![sphere([0.0; 3], 1.0), cuboid(low, high)]);
    let bar = |low: f64, high: f64| cone([[0.0, low, 0.0], [0.0, high, 0.0]], [0.7, 0.7]);
    vec![
        (
            "a block of two",
            cuboid([-1.0; 3], [1.0; 3]),
            merge(vec![cuboid([-1.0; 3], [0.3, 1.0, 1.0]), cuboid([0.3, -1.0, -1.0], [1.0; 3])]),
        ),
        (
            "a block of eight",
            cuboid([-1.0; 3], [1.0; 3]),
            merge(
                (0..8)
                    .map(|i| {
                        let end = |axis: usize| if i >> axis & 1 == 1 { 1.0 } else { -1.0 };
                        cuboid([0.1; 3], [end(0), end(1), end(2)])
                    })
                    .collect(),
            ),
        ),
        (
            "a block and another in its midst",
            cuboid([-1.0; 3], [1.0; 3]),
            merge(vec![cuboid([-1.0; 3], [1.0; 3]), cuboid([-1.0, -0.5, -0.5], [1.0, 0.5, 0.5])]),
        ),
        (
            "a bar of three",
            bar(-1.0, 1.0),
            merge(vec![bar(-1.0, -0.3), bar(-0.3, 0.6), bar(0.6, 1.0)]),
        ),
        (
            "a ball of halves",
            sphere([0.0; 3], 1.0),
            merge(vec![half([-2.0; 3], [0.3, 2.0, 2.0]), half([0.3, -2.0, -2.0], [2.0; 3])]),
        ),
        (
            "a ball, and once more",
            sphere([0.0; 3], 1.0),
            merge(vec![
                sphere([0.0; 3], 1.0),
                sphere([0.0; 3], 1.0).moved(Step::Rotate([10.0, 20.0, 30.0])),
            ]),
        ),
        (
            "a cone of two",
            cone([[0.0, -1.0, 0.0], [0.0, 1.0, 0.0]], [1.0, 0.0]),
            merge(vec![
                cone([[0.0, -1.0, 0.0], [0.0, 0.5, 0.0]], [1.0, 0.25]),
                cone([[0.0, 1.0, 0.0], [0.0, 0.5, 0.0]], [0.0, 0.25]),
            ]),
        ),
    ]
}

#[test]
fn row_35_glass_that_touches_merges_without_a_wall() {
    for (name, one, parts) in alike() {
        for ior in [1.0, 1.5] {
            let scenes = [&one, &parts].map(|solid| seen(vec![glass(solid.clone(), ior)]));
            hold_alike(name, &scenes[0], &scenes[1]);
        }
    }
}

#[test]
fn row_35_forty_solids_are_taken_from_one_another() {
    // Flush with the front, so that each leaves a ring there.
    let block = |i: u32| {
        let half = 1.0 - 0.02 * f64::from(i);
        let shade = 0.3 + 0.6 * f64::from(i % 3) / 2.0;
        cuboid([-half, -half, -half], [half, half, 1.0]).color([shade, 0.8 - shade / 2.0, 0.5])
    };
    let inward = (0..40)
        .rev()
        .fold(block(40), |inner, i| whole(Operation::Difference, vec![block(i), inner]));
    hold_alike("A − (B − (C − …))", &seen(vec![inward.clone()]), &seen(vec![inward]));
    let slice = |i: u32| {
        let x = -1.0 + 0.05 * f64::from(i);
        cuboid([x, -1.0, 0.5], [x + 0.025, 1.0, 1.0]).color([0.2, 0.9, 0.3])
    };
    let outward =
        (0..40).fold(block(0), |outer, i| whole(Operation::Difference, vec![outer, slice(i)]));
    hold_alike("((A − B) − C) − …", &seen(vec![outward.clone()]), &seen(vec![outward]));
}

#[test]
fn row_35_a_ball_is_taken_from_one_that_it_touches() {
    let outer = || sphere([0.0; 3], 1.0);
    let inner = || sphere([0.4, 0.0, 0.0], 0.6).color([0.9, 0.3, 0.2]);
    let cut = |part| whole(Operation::Difference, vec![part, cuboid([-2.0, 0.0, -2.0], [2.0; 3])]);
    let hollow = || whole(Operation::Difference, vec![outer(), inner()]);
    let both = [
        ("hollow", hollow()),
        ("hollow and cut", cut(hollow())),
        ("of glass", glass(hollow(), 1.5)),
    ];
    for (name, solid) in both {
        hold_alike(name, &seen(vec![solid.clone()]), &seen(vec![solid]));
    }
}
