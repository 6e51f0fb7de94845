//! Solids under transformations: rows 50 and 51.

use super::held::hold;
use super::scene::{Camera, Light, Object, Scene, Step, Triple, WHITE, cuboid, sphere, ten};

fn shown(objects: Vec<Object>) -> Scene {
    let camera = Camera::LookAt { location: [2.0, 3.0, 7.0], look_at: [0.0; 3], angle: 35.0 };
    Scene::new(camera, &[Light { position: [4.0, 8.0, 5.0], color: WHITE }], objects)
}

fn block() -> Object {
    cuboid([-1.0, -0.4, -0.7], [1.2, 0.5, 0.6]).checker(&[Step::Scale([0.37; 3])])
}

fn ball() -> Object {
    sphere([0.2, 0.1, 0.0], 1.3).checker(&[Step::Scale([0.37; 3])])
}

#[test]
fn row_50_many_rotations_are_one() {
    for (degrees, times) in [(0.377, 1000), (-123.456, 1000), (0.0123, 100_000), (77.7, 100_000)] {
        for axis in 0..3 {
            let spin = Step::Spin { axis, degrees, times };
            hold(&format!("{times} rotations by {degrees}"), &shown(vec![block().moved(spin)]));
        }
        let spin = Step::Spin { axis: 1, degrees, times };
        let tilted = ball().moved(Step::Scale([1.0, 0.5, 0.3])).moved(spin);
        hold(&format!("{times} rotations of an ellipsoid"), &shown(vec![tilted]));
    }
}

/// A block and a ball, stretched, then turned.
fn stretched(name: &str, stretch: Step) {
    for turn in [[0.0; 3], [20.0, 30.0, 40.0]] {
        let place = |object: Object| object.moved(stretch).moved(Step::Rotate(turn));
        hold(&format!("a box, {name}, turned {turn:?}"), &shown(vec![place(block())]));
        hold(&format!("a ball, {name}, turned {turn:?}"), &shown(vec![place(ball())]));
    }
}

#[test]
fn row_51_solids_may_be_mirrored() {
    for scale in [[-1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0; 3], [-0.5, 0.7, 1.1]] {
        stretched(&format!("scaled {scale:?}"), Step::Scale(scale));
    }
}

#[test]
fn row_51_solids_may_be_flat_or_needles() {
    for exponent in [-3, -6, -9] {
        let thin = ten(exponent);
        stretched(&format!("1e{exponent} thick"), Step::Scale([1.0, thin, 1.0]));
        stretched(&format!("1e{exponent} thick, across"), Step::Scale([1.0, 1.0, thin]));
        let long = 1.0 / thin;
        stretched(&format!("{long:e} long"), Step::Scale([long, 0.3, 0.3]));
        stretched(&format!("{long:e} long, upright"), Step::Scale([0.3, long, 0.3]));
        stretched(&format!("{long:e} long, toward the eye"), Step::Scale([0.3, 0.3, long]));
    }
}

#[test]
fn row_51_solids_may_be_sheared_nearly_flat() {
    for exponent in [-3, -6, -9] {
        // x and y become nearly one direction: the determinant is 1e<exponent>.
        let thin = ten(exponent);
        let rows: [Triple; 4] =
            [[1.0, 0.0, 0.0], [1.0, thin, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, 0.0]];
        stretched(&format!("sheared to 1e{exponent}"), Step::Matrix(rows));
        let rows: [Triple; 4] =
            [[1.0, 0.3, 0.2], [1.0, 0.3 + thin, 0.2], [0.0, 0.5, 1.0], [0.1, 0.2, 0.3]];
        stretched(&format!("sheared aslant to 1e{exponent}"), Step::Matrix(rows));
    }
}
