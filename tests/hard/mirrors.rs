//! Light that goes many ways: rows 8, 41 and 42.

use super::held::{hold, hold_sized, unrounded};
use super::scene::{Camera, Light, Object, Scene, Step, Triple, WHITE, cuboid, plane, sphere, ten};

fn ahead(location: Triple) -> Camera {
    Camera::Perspective {
        location,
        direction: [0.1, -0.05, -1.0],
        right: [4.0 / 3.0, 0.0, 0.0],
        up: [0.0, 1.0, 0.0],
    }
}

fn mirror(object: Object) -> Object {
    object.finish(0.004, 0.0, 0.995)
}

#[test]
fn row_8_a_camera_may_stand_inside() {
    let lamp = Light { position: [0.3, 0.6, 0.2], color: WHITE };
    for size in [1e-6, 1.0, 1e6] {
        let at = |p: Triple| p.map(|c| c * size);
        let lamp = Light { position: at(lamp.position), color: WHITE };
        let ball = sphere(at([0.3, -0.1, -0.8]), 0.2 * size).color([0.9, 0.3, 0.1]);
        let shells = [
            sphere([0.0; 3], 1.5 * size).checker(&[Step::Scale([0.31 * size; 3])]),
            sphere([0.0; 3], size)
                .checker(&[Step::Scale([0.31; 3])])
                .moved(Step::Scale([3.0, 1.0, 1.7]))
                .moved(Step::Rotate([0.0, 20.0, 10.0])),
            cuboid([-size; 3], [1.1 * size; 3]).checker(&[Step::Scale([0.31 * size; 3])]),
        ];
        for shell in shells {
            let scene = Scene::new(ahead(at([0.1, 0.1, 0.2])), &[lamp], vec![shell, ball.clone()]);
            hold(&format!("inside, of size {size:e}"), &scene);
        }
    }
}

#[test]
fn row_41_a_mirror_box_is_followed_200_mirrors_deep() {
    let lamp = Light { position: [0.1, 0.7, 0.3], color: [0.6; 3] };
    for depth in [50, 200] {
        let ball = sphere([0.3, -0.4, -0.5], 0.25).color([0.9, 0.3, 0.1]);
        for turn in [[0.0; 3], [13.0, 37.0, -21.0]] {
            let room = mirror(cuboid([-1.0; 3], [1.0; 3])).moved(Step::Rotate(turn));
            let objects = vec![room, ball.clone()];
            let scene = Scene::new(ahead([0.1, 0.2, 0.3]), &[lamp], objects).deep(depth);
            hold_sized(&format!("a mirror box {depth} deep, turned {turn:?}"), &scene, (16, 12));
        }
    }
}

#[test]
fn row_41_a_corridor_of_two_mirrors_is_followed_135_deep() {
    let wall = |z: f64| mirror(plane([0.0, 0.0, 1.0], z));
    let ball = sphere([0.3, -0.4, -0.5], 0.25).color([0.9, 0.3, 0.1]);
    let floor = plane([0.0, 1.0, 0.0], -1.0).checker(&[]);
    let lamp = Light { position: [0.1, 5.7, 0.3], color: WHITE };
    let objects = vec![wall(-2.0), wall(2.0), ball, floor];
    let scene = Scene::new(ahead([0.1, 0.2, 0.3]), &[lamp], objects).deep(136);
    hold_sized("a corridor", &scene, (24, 18));
}

#[test]
fn row_41_balls_that_touch_mirror_each_other_200_deep() {
    let lamp = Light { position: [3.0, 7.0, 6.0], color: WHITE };
    for exponent in [-6, 0, 6] {
        let r = ten(exponent);
        let at = |x: f64, y: f64, z: f64| sphere([x * r, y * r, z * r], r).finish(0.02, 0.3, 0.95);
        // Two that touch at the origin, and one on each axis beside.
        let objects = vec![at(-1.0, 0.0, 0.0), at(1.0, 0.0, 0.0), at(0.0, -3f64.sqrt(), 0.0)];
        let camera = Camera::LookAt {
            location: [0.2 * r, 0.5 * r, 5.0 * r],
            look_at: [0.0; 3],
            angle: 40.0,
        };
        let lamp = Light { position: lamp.position.map(|c| c * r), ..lamp };
        let scene = Scene::new(camera, &[lamp], objects).deep(200);
        hold_sized(&format!("balls of radius 1e{exponent}"), &scene, (32, 24));
    }
}

#[test]
fn row_42_in_a_white_furnace_nothing_is_lost() {
    let room = |depth: u32, finish: (f64, f64)| {
        let shell = |object: Object| object.finish(finish.0, 0.0, finish.1);
        let objects =
            vec![shell(cuboid([-1.0; 3], [1.0; 3])), shell(sphere([0.2, -0.3, -0.4], 0.4))];
        unrounded(&Scene::new(ahead([0.1, 0.2, 0.3]), &[], objects).deep(depth).text(), (32, 24))
    };
    // A surface that gives half and mirrors half: 1 − 2^−depth; 200 deep it is 1.
    let seen = room(200, (0.5, 0.5));
    let worst = seen.into_iter().flat_map(|c| c.components()).map(|c| (1.0 - c).abs());
    assert!(worst.fold(0.0, f64::max) < 1e-12);
    // Nothing is lost by mirrors either: after 199 whole reflections the last one's emission is left.
    let seen = room(200, (1.0 / 200.0, 1.0));
    let worst = seen.into_iter().flat_map(|c| c.components()).map(|c| (1.0 - c).abs());
    assert!(worst.fold(0.0, f64::max) < 1e-12);
}
