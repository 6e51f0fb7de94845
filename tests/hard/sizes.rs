//! Things of all sizes, near and far: rows 1, 3, 7, 16, 46, 48 and 64.

use super::exact::Exact;
use super::held::{apart, changes_near, hold, rendered};
use super::scene::{Camera, Light, Object, Scene, Step, Triple, WHITE, cuboid, plane, sphere, ten};

const CLAY: Triple = [0.9, 0.5, 0.2];
const SLATE: Triple = [0.3, 0.5, 0.8];

fn light(position: Triple) -> Light {
    Light { position, color: WHITE }
}

#[test]
fn row_1_a_sphere_of_any_size_is_round() {
    for exponent in (-12..=12).step_by(3) {
        let r = ten(exponent);
        let camera = Camera::LookAt { location: [0.0, r, 3.0 * r], look_at: [0.0; 3], angle: 50.0 };
        let lights = [light([4.0 * r, 5.0 * r, 3.0 * r])];
        let scene = Scene::new(camera, &lights, vec![sphere([0.0; 3], r).color(CLAY)]);
        hold(&format!("a sphere of radius 1e{exponent}"), &scene);
    }
}

#[test]
fn row_3_a_telephoto_lens_shows_what_is_far() {
    for exponent in 3..=8 {
        let far = ten(exponent);
        for place in [[0.0, 0.0, far], [0.6 * far, 0.0, 0.8 * far], [far, far, far]] {
            // Four units wide where it looks.
            let length = place.iter().map(|c| c * c).sum::<f64>().sqrt();
            let direction = place.map(|c| -c / 3.0);
            let right = [4.0 / 3.0 * place[2] / length, 0.0, -4.0 / 3.0 * place[0] / length];
            let up = [0.0, 1.0, 0.0];
            let camera = Camera::Perspective { location: place, direction, right, up };
            let objects = vec![
                sphere([-0.7, 0.2, 0.0], 0.8).color(CLAY),
                cuboid([0.3, -0.7, -0.4], [1.1, 0.5, 0.6])
                    .color(SLATE)
                    .moved(Step::Rotate([10.0, 20.0, 30.0])),
                sphere([0.0; 3], 0.5)
                    .moved(Step::Scale([2.0, 0.3, 1.0]))
                    .moved(Step::Rotate([0.0, 0.0, 25.0]))
                    .moved(Step::Translate([0.0, -1.0, 0.0])),
            ];
            let scene = Scene::new(camera, &[light([3.0, 5.0, 4.0])], objects);
            hold(&format!("a lens 1e{exponent} away, at {place:?}"), &scene);
        }
    }
}

#[test]
fn row_7_a_pebble_lies_on_a_planet() {
    for exponent in 3..=12 {
        let r = ten(exponent);
        let camera =
            Camera::LookAt { location: [0.3, 2.0, 5.0], look_at: [0.0, 0.4, 0.0], angle: 45.0 };
        let objects = vec![
            sphere([0.0, -r, 0.0], r).color(SLATE),
            sphere([-0.4, 0.5, 0.0], 0.5).color(CLAY),
            cuboid([0.4, -0.1, -0.3], [1.0, 0.5, 0.3]).moved(Step::Rotate([0.0, 30.0, 0.0])),
        ];
        let scene = Scene::new(camera, &[light([4.0, 6.0, 3.0])], objects);
        hold(&format!("a planet of radius 1e{exponent}"), &scene);
    }
}

/// What a planet may be: a sphere, an egg or a block whose top is at the origin.
fn planets(r: f64) -> [Object; 3] {
    [
        sphere([0.0, -r, 0.0], r),
        sphere([0.0, -1.0, 0.0], 1.0).moved(Step::Scale([1.5 * r, r, 0.7 * r])),
        cuboid([-r, -2.0 * r, -r], [r, 0.0, r]),
    ]
}

#[test]
fn row_7_planets_of_any_form_may_be_mirrors() {
    for (exponent, x) in
        [(3, 0.3), (6, -0.7), (9, 0.1), (11, 0.4), (12, 0.3), (12, -1.0), (12, 0.7)]
    {
        let r = ten(exponent);
        let camera =
            Camera::LookAt { location: [x, 2.0, 5.0], look_at: [0.0, 0.4, 0.0], angle: 45.0 };
        // An egg of 1e12 is only known to 1e-4.
        let kinds = if exponent == 12 { 1 } else { 3 };
        for planet in planets(r).into_iter().take(kinds) {
            let pebbles = [
                sphere([-0.4, 0.5, 0.0], 0.5).color(CLAY),
                cuboid([0.4, -0.1, -0.3], [1.0, 0.5, 0.3]).moved(Step::Rotate([0.0, 30.0, 0.0])),
            ];
            let objects = [vec![planet.finish(0.05, 0.3, 0.6)], pebbles.to_vec()].concat();
            let scene = Scene::new(camera, &[light([4.0, 6.0, 3.0])], objects);
            hold(&format!("a mirror planet of radius 1e{exponent}"), &scene);
        }
    }
}

#[test]
fn row_3_an_orthographic_camera_may_stand_anywhere() {
    for exponent in [1, 4, 8, 10] {
        let far = ten(exponent);
        let camera = Camera::Orthographic {
            location: [0.6 * far, 0.0, 0.8 * far],
            direction: [-0.6, 0.0, -0.8],
            right: [0.8 * 4.0, 0.0, -0.6 * 4.0],
            up: [0.0, 3.0, 0.0],
        };
        let objects = vec![
            sphere([-0.7, 0.2, 0.0], 0.8).color(CLAY),
            cuboid([0.3, -0.7, -0.4], [1.1, 0.5, 0.6]).moved(Step::Rotate([10.0, 20.0, 30.0])),
            plane([0.3, 0.9, 0.1], -1.5).checker(&[]),
        ];
        let scene = Scene::new(camera, &[light([3.0, 5.0, 4.0])], objects);
        hold(&format!("an orthographic camera at 1e{exponent}"), &scene);
    }
}

/// A sphere, a turned box, an ellipsoid and a mirror, on a checkered floor, a thousandth to the
/// side of the lattice; all lengths times `k`, and then moved.
fn still_life(k: f64, offset: Triple) -> Scene {
    let at = |p: Triple| -> Triple { std::array::from_fn(|i| p[i] * k + offset[i]) };
    let moved = |object: Object| object.moved(Step::Scale([k; 3])).moved(Step::Translate(offset));
    let camera =
        Camera::LookAt { location: at([1.0, 2.0, 6.0]), look_at: at([0.0, 0.6, 0.0]), angle: 45.0 };
    let objects = vec![
        moved(plane([0.0, 1.0, 0.0], 0.0).checker(&[Step::Translate([0.001, 0.0, 0.001])])),
        moved(sphere([-1.2, 0.8, 0.0], 0.8).color(CLAY)),
        moved(
            cuboid([-0.5; 3], [0.5; 3])
                .moved(Step::Rotate([0.0, 30.0, 0.0]))
                .moved(Step::Translate([1.2, 0.5, 0.4])),
        ),
        moved(
            sphere([0.0; 3], 1.0)
                .moved(Step::Scale([0.6, 1.2, 0.6]))
                .moved(Step::Translate([0.3, 1.2, -1.4])),
        )
        .finish(0.0, 0.2, 0.7),
    ];
    Scene::new(camera, &[light(at([5.0, 7.0, 4.0]))], objects)
}

#[test]
fn row_46_a_lit_scene_may_have_any_scale() {
    for exponent in (-12..=12).step_by(2) {
        hold(&format!("a still life times 1e{exponent}"), &still_life(ten(exponent), [0.0; 3]));
    }
}

#[test]
fn row_48_a_lit_scene_may_stand_anywhere() {
    for exponent in [3, 6, 8, 9, 10, 11] {
        let far = ten(exponent);
        hold(&format!("a still life at 1e{exponent}"), &still_life(1.0, [far, far, -far]));
    }
}

#[test]
fn row_49_an_offset_by_exact_numbers_changes_no_pixel() {
    // Few digits: every coordinate is exact in every place.
    let scene = |[x, y, z]: Triple| {
        let at = |a: f64, b: f64, c: f64| [a + x, b + y, c + z];
        let camera = Camera::LookAt {
            location: at(1.0, 2.0, 6.0),
            look_at: at(0.0, 0.625, 0.0),
            angle: 45.0,
        };
        let floor = plane([0.0, 1.0, 0.0], y).checker(&[Step::Translate(at(0.125, 0.0, 0.375))]);
        let objects = vec![
            floor,
            sphere(at(-1.25, 0.75, 0.0), 0.75).color(CLAY),
            cuboid(at(0.5, 0.0, -0.25), at(1.5, 1.0, 0.75)).color(SLATE),
            sphere(at(0.25, 0.5, 1.5), 0.5).finish(0.0, 0.2, 0.7),
        ];
        Scene::new(camera, &[light(at(5.0, 7.0, 4.0))], objects)
    };
    let here = scene([0.0; 3]);
    let exact = Exact::new(&here);
    let (width, height) = (48, 36);
    let film = |scene: &Scene| rendered(&scene.text(), (width, height));
    let plain = film(&here);
    let k = |exponent: i32| 2f64.powi(exponent);
    for offset in [
        [1.0, -2.0, 4.0],
        [k(10), 0.0, -k(12)],
        [k(20), k(20), -k(20)],
        [0.0, -k(30), 3.0 * k(29)],
        [k(36), k(35), -k(36)],
    ] {
        let moved = film(&scene(offset));
        let mut changed = 0;
        for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
            let at = plain.index(x, y);
            let [one, other] = [&plain, &moved].map(|film| film.radiance(at).components());
            // Where nothing changes within a thousandth of a pixel.
            let is_judged = || !changes_near(&exact, (x, y), (width, height));
            if apart(one, other) > 0.003 && is_judged() {
                changed += 1;
            }
        }
        assert_eq!(changed, 0, "{offset:?}");
    }
}

#[test]
fn row_16_a_box_may_stand_anywhere() {
    for exponent in 6..=10 {
        let far = ten(exponent);
        for [x, y, z] in [[far, far, -far], [0.0, far, 0.0], [-far, 1.0, 3.0 * far]] {
            let camera = Camera::LookAt {
                location: [x + 2.0, y + 3.0, z + 4.0],
                look_at: [x, y, z],
                angle: 40.0,
            };
            // Its corners are as they can be written so far away.
            let corner = |s: f64| [x + s, y + 0.75 * s, z + 0.5 * s];
            let scene = Scene::new(
                camera,
                &[light([x + 1.0, y + 8.0, z + 5.0])],
                vec![cuboid(corner(-1.0), corner(1.0)).color(CLAY)],
            );
            hold(&format!("a box at {x:e}, {y:e}, {z:e}"), &scene);
        }
    }
}

#[test]
fn row_64_sizes_over_24_decades_stand_in_one_picture() {
    // Each is five of its radii away, in its own place of the picture.
    let spheres = |shift: Triple| -> Vec<Object> {
        (0..25)
            .map(|i| {
                let r = ten(i - 12);
                let (column, row) = (f64::from(i % 5) - 2.0, f64::from(i / 5) - 2.0);
                let away = 9.0 * r;
                let centre = [0.25 * column * away, 0.19 * row * away, -away];
                sphere(std::array::from_fn(|axis| centre[axis] + shift[axis]), 0.7 * r).color([
                    0.9,
                    0.1 * f64::from(i % 9),
                    0.04 * f64::from(i),
                ])
            })
            .collect()
    };
    let camera = |location| Camera::Perspective {
        location,
        direction: [0.0, 0.0, -1.0],
        right: [4.0 / 3.0, 0.0, 0.0],
        up: [0.0, 1.0, 0.0],
    };
    // From where the picture is taken, and from far above.
    for lamp in [[0.0, 0.0, 1e-13], [1e13, 3e13, 2e13]] {
        let scene = Scene::new(camera([0.0; 3]), &[light(lamp)], spheres([0.0; 3]));
        hold(&format!("24 decades, lit from {lamp:?}"), &scene);
    }
}
