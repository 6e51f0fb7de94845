//! Lights in hard places, of hard strength, and many objects in one place: rows 43, 44, 60, 61 and
//! 63.

use std::time::Instant;

use super::held::{apart, hold, rendered};
use super::scene::{
    BLACK, Camera, Light, Object, Scene, Step, Triple, WHITE, cuboid, plane, sphere, ten,
};

fn above() -> Camera {
    Camera::LookAt { location: [1.0, 3.0, 6.0], look_at: [0.0, 0.2, 0.0], angle: 40.0 }
}

fn light(position: Triple) -> Light {
    Light { position, color: WHITE }
}

fn floor() -> Object {
    plane([0.0, 1.0, 0.0], 0.0)
}

#[test]
fn row_43_a_plate_just_off_a_wall_casts_its_shadow() {
    for gap in [1e-1, 1e-2, 1e-3, 1e-4, 5e-5] {
        let plate = cuboid([-1.0, gap, -1.0], [1.0, gap + 0.05, 1.0]).color([0.9, 0.4, 0.2]);
        for lamp in [[0.0, 5.0, 0.0], [8.0, 4.0, 3.0], [30.0, 1.0, 0.0]] {
            let scene = Scene::new(above(), &[light(lamp)], vec![floor(), plate.clone()]);
            hold(&format!("a plate {gap:e} off, lit from {lamp:?}"), &scene);
        }
        // Seen from between the two.
        let camera = Camera::Perspective {
            location: [0.0, 0.5 * gap, 3.0],
            direction: [0.0, 0.0, -1.0],
            right: [4.0 / 3.0, 0.0, 0.0],
            up: [0.0, gap, 0.0],
        };
        let scene = Scene::new(camera, &[light([0.3, 0.6 * gap, 2.0])], vec![floor(), plate]);
        hold(&format!("the gap of {gap:e}"), &scene);
    }
}

#[test]
fn row_43_a_light_just_above_a_box_lights_it() {
    for exponent in 2..=5 {
        let gap = ten(-exponent);
        let block = cuboid([-1.0, 0.0, -1.0], [1.0, 0.7, 1.0]).color([0.9, 0.4, 0.2]);
        let scene = Scene::new(above(), &[light([0.1, 0.7 + gap, 0.2])], vec![floor(), block]);
        hold(&format!("a light {gap:e} above a box"), &scene);
    }
}

#[test]
fn row_44_a_light_may_stand_inside_or_low() {
    let ball = || sphere([0.0, 1.0, 0.0], 1.0).color([0.9, 0.4, 0.2]);
    for lamp in [
        [0.1, 1.2, 0.3],            // inside the ball
        [0.0, 1.0, 0.0],            // at its centre
        [0.0, 2.0, 0.0],            // on it
        [0.6, 1.8, 0.0],            // on it, nearly
        [5.0, 5.0 * 0.005236, 0.0], // 0.3° above the floor
        [5.0, 0.0, 0.0],            // on the floor
        [5.0, -1.0, 0.0],           // below it
    ] {
        let scene = Scene::new(above(), &[light(lamp)], vec![floor(), ball()]);
        hold(&format!("a light at {lamp:?}"), &scene);
    }
}

#[test]
fn row_36_a_thin_shell_keeps_the_light_in() {
    for exponent in 2..=12 {
        // Two spheres and two boxes, one just inside of the other.
        let thin = ten(-exponent);
        let spheres = |r: f64| sphere([-0.7, 0.8, 0.0], r).color([0.9, 0.4, 0.2]);
        let boxes = |r: f64| cuboid([0.9 - r, 0.6 - r, -r], [0.9 + r, 0.6 + r, r]);
        let objects =
            vec![floor(), spheres(0.7), spheres(0.7 - thin), boxes(0.5), boxes(0.5 - thin)];
        let lights = [light([-0.7, 0.9, 0.1]), light([0.8, 0.7, 0.1])];
        hold(&format!("shells 1e-{exponent} thick"), &Scene::new(above(), &lights, objects));
    }
}

#[test]
fn row_60_a_thousand_lights_are_one() {
    let objects = || vec![floor(), sphere([0.0, 1.0, 0.0], 1.0).color([0.9, 0.4, 0.2])];
    let part = Light { color: [1e-3; 3], ..light([5.0, 8.0, 6.0]) };
    let many = rendered(&Scene::new(above(), &[part; 1000], objects()).text(), (32, 24));
    let one = rendered(&Scene::new(above(), &[light([5.0, 8.0, 6.0])], objects()).text(), (32, 24));
    let off = many.radiances().zip(one.radiances());
    let off = off.map(|(a, b)| apart(a.components(), b.components())).fold(0.0, f64::max);
    assert!(off < 1e-6, "{off:e}");
}

#[test]
fn row_61_light_of_any_strength_is_white_or_black() {
    let ball = |ambient: f64| {
        let color = [0.9, 0.4, 0.2];
        vec![
            floor().finish(0.0, 0.5, 0.3),
            sphere([0.0, 1.0, 0.0], 1.0).color(color).finish(ambient, 0.5, 0.0),
        ]
    };
    for strength in [1e6, 1e12, 1e150, 1e300, 1e308, -1.0, -1e300] {
        for color in [[strength; 3], [strength, 0.5, -strength], [0.0, strength, 0.2]] {
            let light = Light { color, ..light([5.0, 8.0, 6.0]) };
            hold(&format!("a light of {color:?}"), &Scene::new(above(), &[light], ball(0.1)));
            // Two of them are past all numbers.
            let scene = Scene::new(above(), &[light, light], ball(0.0));
            hold(&format!("two lights of {color:?}"), &scene);
        }
        if strength > 0.0 {
            let scene = Scene::new(above(), &[light([5.0, 8.0, 6.0])], ball(strength));
            hold(&format!("an emission of {strength:e}"), &scene);
        }
    }
    let scene = Scene::new(above(), &[light([5.0, 8.0, 6.0])], ball(0.1));
    hold(
        "behind all, white without end",
        &Scene { background: [1e300, 1e308, 2.0], ..scene.clone() },
    );
    hold(
        "behind all, less than black",
        &Scene { background: [-1e300, -1.0, 0.0], ..scene.clone() },
    );
    hold("behind all, black", &Scene { background: BLACK, ..scene });
}

#[test]
fn row_63_ten_thousand_spheres_in_one_place_are_one() {
    let many = |object: Object| Object { copies: 10_000, ..object };
    let first = sphere([0.0, 1.0, 0.0], 1.0).color([0.9, 0.4, 0.2]);
    let rest = sphere([0.0, 1.0, 0.0], 1.0).color([0.1, 0.2, 0.9]);
    let start = Instant::now();
    let scene = Scene::new(above(), &[light([5.0, 8.0, 6.0])], vec![floor(), first, many(rest)]);
    // Few pixels: every ray at the place tries all.
    super::held::hold_sized("spheres in one place", &scene, (16, 12));
    let turned = |color: Triple, copies: u32| Object {
        copies,
        ..cuboid([-0.5; 3], [0.5; 3])
            .color(color)
            .moved(Step::Rotate([10.0, 20.0, 30.0]))
            .moved(Step::Translate([0.0, 1.0, 0.0]))
    };
    let objects = vec![turned([0.9, 0.4, 0.2], 1), floor(), turned([0.1, 0.2, 0.9], 10_000)];
    let scene = Scene::new(above(), &[light([5.0, 8.0, 6.0])], objects);
    super::held::hold_sized("boxes in one place", &scene, (16, 12));
    assert!(start.elapsed().as_secs() < 60, "{:?}", start.elapsed());
}
