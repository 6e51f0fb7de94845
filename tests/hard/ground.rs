//! Planes to the horizon, and checkers on them: rows 9, 11, 12, 13, 15 and 69.

use super::held::{hold, hold_horizon};
use super::scene::{Camera, Light, Object, Scene, Step, Triple, WHITE, cuboid, plane, sphere, ten};

const FLOOR: Triple = [0.0, 1.0, 0.0];

/// Looks along −z.
fn level(location: Triple) -> Camera {
    Camera::Perspective {
        location,
        direction: [0.0, 0.0, -1.0],
        right: [4.0 / 3.0, 0.0, 0.0],
        up: FLOOR,
    }
}

/// Looks from `location` along −z and down.
fn down(location: Triple) -> Camera {
    Camera::Perspective {
        location,
        direction: [0.0, -1.0, -1.0],
        right: [4.0 / 3.0, 0.0, 0.0],
        up: [0.0, 0.5, -0.5],
    }
}

fn sun(location: Triple) -> Light {
    let position = [location[0] + 30.0, location[1] + 50.0, location[2] + 20.0];
    Light { position, color: WHITE }
}

#[test]
fn row_11_the_horizon_is_level_from_any_height() {
    for exponent in -5..=9 {
        let height = ten(exponent);
        let camera = level([0.0, height, 0.0]);
        let light = Light { position: [0.0, 3.0 * height, 0.0], color: WHITE };
        let scene = Scene::new(camera, &[light], vec![plane(FLOOR, 0.0)]);
        hold(&format!("a horizon from 1e{exponent}"), &scene);
        // The same, leaning, and off the origin.
        let slope = Step::Rotate([7.0, 0.0, 11.0]);
        let scene = Scene { objects: vec![plane(FLOOR, -3.0).moved(slope)], ..scene };
        hold(&format!("a leaning horizon from 1e{exponent}"), &scene);
    }
}

#[test]
fn row_12_a_checker_is_a_checker_out_to_1e10() {
    for exponent in 0..=10 {
        let far = ten(exponent);
        for [x, z] in [[far, far], [-far, 0.5], [0.25, far + 0.5]] {
            let location = [x, 3.0, z];
            let floor = || plane(FLOOR, 0.0).checker(&[]);
            let scene = Scene::new(down(location), &[sun(location)], vec![floor()]);
            hold(&format!("a checker at {x:e}, {z:e}"), &scene);
            // Most of what is near the horizon changes faster than a pixel can tell.
            let camera = level([x, 3.0, z]);
            let scene = Scene::new(camera, &[sun(location)], vec![floor().finish(0.6, 0.0, 0.0)]);
            hold_horizon(&format!("a checker to the horizon at {x:e}, {z:e}"), &scene, (48, 12));
        }
    }
}

#[test]
fn row_12_cells_beyond_any_number_are_some_colour() {
    for far in [4e9, 1e16, 1e300] {
        let location = [far, 3.0, -far];
        let scene = Scene::new(down(location), &[], vec![plane(FLOOR, 0.0).checker(&[])]);
        let film = super::held::rendered(&scene.text(), (8, 8));
        assert!(film.radiances().all(|c| c.is_finite()), "{far:e}");
    }
}

#[test]
fn row_13_a_checker_does_not_flicker_on_its_own_lattice() {
    let turn = [13.0, 37.0, -21.0];
    for (height, lift) in [(0.0, 0.0), (3.0, 0.0), (-7.0, 1e3), (2.0, 1e7)] {
        for turn in [[0.0; 3], turn] {
            let place = |object: Object| {
                object.moved(Step::Rotate(turn)).moved(Step::Translate([0.0, lift, 0.0]))
            };
            let floor = place(plane(FLOOR, height).checker(&[]));
            let block = place(cuboid([-2.0, height, -3.0], [1.0, height + 2.0, 2.0]).checker(&[]));
            let camera = Camera::LookAt {
                location: [3.0, lift + height + 5.0, 9.0],
                look_at: [0.0, lift + height + 0.5, 0.0],
                angle: 45.0,
            };
            for objects in [vec![block.clone()], vec![floor, block]] {
                let light = sun([0.0, lift + height, 0.0]);
                let scene = Scene::new(camera, &[light], objects);
                hold(&format!("a lattice at {height}, turned {turn:?}, lifted {lift:e}"), &scene);
            }
        }
    }
    // Thirds and tenths: the lattice is that of the written numbers.
    for size in [0.1, 1.0 / 3.0, 1e-3, 7e5] {
        let cube =
            cuboid([-2.0 * size, -size, -size], [size; 3]).checker(&[Step::Scale([size; 3])]);
        let at = |p: Triple| p.map(|c| c * size);
        let camera =
            Camera::LookAt { location: at([3.0, 4.0, 6.0]), look_at: [0.0; 3], angle: 40.0 };
        let light = Light { position: at([5.0, 9.0, 7.0]), color: WHITE };
        hold(&format!("a lattice of {size:e}"), &Scene::new(camera, &[light], vec![cube]));
    }
}

#[test]
fn row_13_a_seam_in_the_middle_of_pixels_is_one_colour_all_along() {
    // From 1.5 above the floor, z = 2 is seen in the middle of the pixels of row 82.
    let row = |turn: f64, away: &str, pigment: &str, nudge: f64| {
        let text = format!(
            "camera {{ location <0, 0.5, -6> direction z right 4/3*x up y
               rotate {turn}*y translate {away} }}
             plane {{ y, -1 pigment {{ {pigment} translate {nudge}*z rotate {turn}*y
               translate {away} }} finish {{ ambient 1 diffuse 0 }} }}"
        );
        let film = super::held::rendered(&text, (160, 120));
        let first = film.index(0, 82);
        film.radiances().skip(first).take(160).map(|c| c.red).collect::<Vec<f64>>()
    };
    for turn in [0.0, 37.0, 123.456] {
        for away in ["0", "<100, 0, 77>", "<1e5, 0, -3e4>"] {
            let name = format!("turned {turn}, at {away}");
            // A seam belongs to the cell on its positive side.
            let checker = |nudge| row(turn, away, "checker rgb 0.1 rgb 0.9", nudge);
            assert_eq!(checker(0.0), checker(-1e-6), "{name}");
            assert_ne!(checker(0.0), checker(1e-6), "{name}");
            let steps = [
                "gradient z color_map { [0 rgb 0] [1 rgb 1] }",
                "gradient z color_map { [0.5 rgb 0.1] [0.5 rgb 0.9] } translate 0.5*z",
            ];
            for step in steps {
                let seen = row(turn, away, step, 0.0);
                let apart = seen.iter().map(|c| (c - seen[0]).abs()).fold(0.0, f64::max);
                assert!(apart < 1e-4, "{name}, {step}: {seen:?}");
            }
        }
    }
}

#[test]
fn row_9_a_camera_on_a_surface_sees_past_it() {
    let scene = |location: Triple, direction: Triple, object: Object| {
        let right = [4.0 / 3.0 * -direction[2], 0.0, 4.0 / 3.0 * direction[0]];
        let camera = Camera::Perspective { location, direction, right, up: FLOOR };
        let ball = sphere([location[0], location[1] + 0.5, location[2] - 4.0], 1.0);
        let lamp = Light { position: [location[0], location[1] + 0.5, location[2]], color: WHITE };
        Scene::new(camera, &[lamp], vec![object, ball.color([0.9, 0.2, 0.1])])
    };
    let ahead = [0.0, 0.0, -1.0];
    for size in [1.0 / 1_048_576.0, 1.0, 1_048_576.0] {
        // Outward, and inward to the far side.
        hold("on a sphere", &scene([0.0, 0.0, -size], ahead, sphere([0.0; 3], size)));
        hold("on a sphere, inward", &scene([0.0, 0.0, size], ahead, sphere([0.0; 3], size)));
        // 3, 4, 5: on it to the last bit.
        let place = [0.0, 3.0 * size, 4.0 * size];
        hold("on a sphere, aslant", &scene(place, ahead, sphere([0.0; 3], 5.0 * size)));
        hold("on a floor", &scene([0.0, size, 0.0], ahead, plane(FLOOR, size)));
        let block = || cuboid([-size; 3], [size; 3]);
        hold("on a box", &scene([0.0, size, 0.0], ahead, block()));
        hold("on a box, inward", &scene([0.5 * size, 0.0, size], ahead, block()));
        hold("at a box's corner", &scene([-size, -size, size], ahead, block()));
    }
}

/// Thirteen by thirteen boxes of side `size` that share their faces, the middle of it at `middle`.
fn wall(size: f64, middle: Triple) -> Vec<Object> {
    (-7..6)
        .flat_map(|i| (-7..6).map(move |j| (f64::from(i) + 0.5, f64::from(j) + 0.5)))
        .map(|(x, y)| {
            let corner = |x: f64, y: f64, z: f64| {
                [middle[0] + x * size, middle[1] + y * size, middle[2] + z * size]
            };
            cuboid(corner(x, y, -1.0), corner(x + 1.0, y + 1.0, 0.0)).finish(1.0, 0.0, 0.0)
        })
        .collect()
}

#[test]
fn row_15_a_wall_of_boxes_has_no_holes() {
    let turn = Step::Rotate([20.0, 30.0, 40.0]);
    for size in [1.0, 0.1, 1.0 / 3.0, 1e-7] {
        for lift in [0.0, 1.0, 1e3, 1e6] {
            for turned in [false, true] {
                let middle = [lift * size, -3.0 * lift * size, 0.0];
                let mut wall = wall(size, middle);
                if turned {
                    wall = wall.into_iter().map(|object| object.moved(turn)).collect();
                }
                // Its seams are in the middle of pixels, for an even number of them; a turned wall
                // is seen from where it is turned to.
                let axes = [[6.0, 0.0, 0.0], [0.0, 6.0, 0.0], [0.0, 0.0, -1.0], [0.0, 0.0, -12.0]];
                let [right, up, ahead, far_ahead] = axes.map(|v| v.map(|c| c * size));
                let location = [middle[0], middle[1], 12.0 * size];
                let steps = if turned { vec![turn] } else { Vec::new() };
                let ortho = Camera::Orthographic { location, direction: ahead, right, up };
                let perspective = Camera::Perspective { location, direction: far_ahead, right, up };
                for camera in [ortho, perspective] {
                    let scene = Scene {
                        camera_steps: steps.clone(),
                        ..Scene::new(camera, &[], wall.clone())
                    };
                    let text = scene.text();
                    for pixels in [5, 6, 12] {
                        let film = super::held::rendered(&text, (pixels, pixels));
                        let holes = film.radiances().filter(|c| c.red < 0.99).count();
                        assert_eq!(holes, 0, "{size} {lift:e} turned {turned}, {pixels} pixels");
                    }
                }
            }
        }
    }
}

#[test]
fn row_69_of_coplanar_faces_the_first_declared_is_seen() {
    let red = [0.9, 0.1, 0.1];
    let floor = plane(FLOOR, 0.0).color([0.1, 0.1, 0.9]);
    for turn in [[0.0; 3], [13.0, 37.0, -21.0]] {
        for lift in [0.0, 1e6] {
            let place = |object: Object| {
                object.moved(Step::Rotate(turn)).moved(Step::Translate([0.0, lift, 0.0]))
            };
            let slab = cuboid([-2.0, -1.0, -2.0], [2.0, 0.0, 2.0]).color(red);
            let camera = Camera::LookAt {
                location: [1.0, lift + 6.0, 9.0],
                look_at: [0.0, lift, 0.0],
                angle: 45.0,
            };
            let light = sun([0.0, lift, 0.0]);
            let both = [place(slab), place(floor.clone())];
            let [slab, floor] = both.clone();
            for objects in [vec![slab.clone(), floor.clone()], vec![floor, slab]] {
                let scene = Scene::new(camera, &[light], objects);
                hold(&format!("coplanar, turned {turn:?}, lifted {lift:e}"), &scene);
            }
        }
    }
}
