//! Clear sheets, slabs and balls: rows 37, 38 and 39.
//!
//! That what is mirrored and what goes through come to all, and that equal indices change no bit
//! (row 40), is tested beside the laws, in `trace/refraction.rs`.

use super::held::{hold, hold_sized, unrounded};
use super::scene::{Camera, Light, Object, Scene, Step, Triple, WHITE, cuboid, plane, sphere, ten};

fn above() -> Camera {
    Camera::LookAt { location: [1.0, 3.0, 6.0], look_at: [0.0, 0.2, 0.0], angle: 40.0 }
}

fn light(position: Triple) -> Light {
    Light { position, color: WHITE }
}

/// What is behind is seen as far as `filter` and `transmit` say.
fn clear(object: Object, filter: f64, transmit: f64, ior: f64) -> Object {
    Object { filter, transmit, ior, ..object }
}

fn floor() -> Object {
    plane([0.0, 1.0, 0.0], 0.0).checker(&[Step::Scale([0.7; 3]), Step::Translate([0.1, 0.5, 0.2])])
}

#[test]
fn row_37_a_clear_sheet_lies_just_above_a_floor() {
    for exponent in 2..=9 {
        let gap = ten(-exponent);
        let sheets = [
            cuboid([-1.0, gap, -1.0], [1.0, gap, 1.0]),
            cuboid([-1.0, gap, -1.0], [1.0, 2.0 * gap, 1.0]),
            plane([0.0, 1.0, 0.0], gap),
        ];
        for sheet in sheets {
            let sheet = clear(sheet.color([0.9, 0.5, 0.2]), 0.6, 0.2, 1.0);
            let scene = Scene::new(above(), &[light([5.0, 8.0, 6.0])], vec![floor(), sheet]);
            hold(&format!("a sheet {gap:e} above the floor"), &scene.deep(20));
        }
    }
}

#[test]
fn rows_17_and_37_a_flat_box_is_one_sheet_to_the_eye_and_to_the_light() {
    let center = |text: &str| unrounded(text, (1, 1))[0].components();
    for box_ in
        ["box { <-9, 1, -9>, <9, 1, 9>", "box { <-9, 0, -9>, <9, 0, 9> rotate x translate y"]
    {
        for interior in ["", "interior { ior 1.5 }", "interior { ior 1.0000001 }"] {
            let sheet = format!(
                "{box_} pigment {{ rgbf <0.5, 0.25, 1, 1> }} finish {{ diffuse 0 ambient 0 }} {interior} }}"
            );
            let seen = format!(
                "camera {{ location 5*y look_at 0 angle 1 sky z }} {sheet}
                plane {{ y, 0 pigment {{ rgb 1 }} finish {{ ambient 1 diffuse 0 }} }}"
            );
            let lit = format!(
                "camera {{ location <0, 0.4, 2> look_at 0 angle 1 }} {sheet}
                light_source {{ 1e9*y, rgb 1 }}
                plane {{ y, 0 pigment {{ rgb 1 }} finish {{ ambient 0 diffuse 1 }} }}"
            );
            for text in [seen, lit] {
                let found = center(&text);
                let is = |(found, meant): (f64, f64)| (found - meant).abs() < 1e-12;
                assert!(found.into_iter().zip([0.5, 0.25, 1.0]).all(is), "{found:?}: {text}");
            }
        }
    }
}

#[test]
fn row_37_forty_filters_lie_close_together() {
    for exponent in 2..=6 {
        let gap = ten(-exponent);
        let mut objects = vec![plane([0.0, 1.0, 0.0], 0.0).finish(0.3, 0.6, 0.0)];
        objects.extend((1..=40).map(|i| {
            let sheet = plane([0.0, 1.0, 0.0], gap * f64::from(i));
            clear(sheet.color([0.97; 3]), 1.0, 0.0, 1.0)
        }));
        let scene = Scene::new(above(), &[light([5.0, 8.0, 6.0])], objects);
        hold_sized(&format!("40 filters {gap:e} apart"), &scene.deep(50), (8, 6));
        // Standing upright, before the sky.
        let mut objects = vec![floor()];
        objects.extend((1..=40).map(|i| {
            let z = 1.0 + gap * f64::from(i);
            let sheet = cuboid([-0.5, 0.0, z], [0.5, 1.0, z]);
            clear(sheet.color([0.97; 3]), 1.0, 0.0, 1.0)
        }));
        let scene = Scene::new(above(), &[light([5.0, 8.0, 6.0])], objects);
        hold_sized(&format!("40 upright filters {gap:e} apart"), &scene.deep(50), (8, 6));
    }
}

#[test]
fn row_38_a_glass_slab_of_any_thickness_bends_and_straightens() {
    for exponent in [1, 2, 3, 4, 5, 6, 9, 12] {
        let thick = ten(-exponent);
        for ior in [1.5, 2.4, 1.0 / 1.5] {
            let slab = cuboid([-1.0, 0.5, -1.0], [1.0, 0.5 + thick, 1.0]).color([0.9, 1.0, 0.9]);
            let slab = clear(slab, 0.9, 0.0, ior);
            for turn in [[0.0; 3], [20.0, 30.0, 10.0]] {
                let slab = slab.clone().moved(Step::Rotate(turn));
                let scene = Scene::new(above(), &[light([5.0, 8.0, 6.0])], vec![floor(), slab]);
                hold(&format!("a slab {thick:e} thick of {ior}"), &scene.deep(12));
            }
        }
    }
}

#[test]
fn row_39_a_glass_ball_of_any_size_turns_the_picture_over() {
    for exponent in -5..=6 {
        let r = ten(exponent);
        let at = |p: Triple| p.map(|c| c * r);
        let floor = plane([0.0, 1.0, 0.0], 0.0)
            .checker(&[Step::Scale([0.7 * r; 3]), Step::Translate(at([0.1, 0.5, 0.2]))]);
        let camera = Camera::LookAt {
            location: at([1.0, 3.0, 6.0]),
            look_at: at([0.0, 0.8, 0.0]),
            angle: 40.0,
        };
        let ball = clear(sphere(at([0.0, 1.1, 0.0]), r).color([1.0, 0.9, 0.9]), 0.9, 0.0, 1.5);
        let scene = Scene::new(camera, &[light(at([5.0, 8.0, 6.0]))], vec![floor, ball]);
        hold(&format!("a glass ball of radius 1e{exponent}"), &scene.deep(8));
    }
}

#[test]
fn row_39_light_leaves_glass_below_the_critical_angle_and_not_above() {
    // Inside of a glass half space: what is above the border is bright.
    for ior in [1.2, 1.5, 2.4, 10.0] {
        let camera = Camera::Perspective {
            location: [0.0, -1.0, 0.0],
            direction: [0.0, 0.7, -0.7],
            right: [4.0 / 3.0, 0.0, 0.0],
            up: [0.0, 0.7, 0.7],
        };
        let water = clear(plane([0.0, 1.0, 0.0], 0.0).finish(0.0, 0.0, 0.0), 1.0, 0.0, ior);
        let bottom = plane([0.0, 1.0, 0.0], -2.0).color([0.9, 0.1, 0.1]).finish(0.8, 0.0, 0.0);
        let scene = Scene::new(camera, &[], vec![water, bottom]);
        hold(&format!("under water of {ior}"), &scene.deep(4));
    }
}

#[test]
fn row_39_light_leaves_a_ball_of_any_size_below_the_critical_angle_and_not_above() {
    for exponent in -5..=6 {
        let r = ten(exponent);
        let at = |p: Triple| p.map(|c| c * r);
        // From off the centre the surface is met at sines up to 0.9: the rim of the critical angle
        // is a circle in the picture. What is mirrored there goes around for ever.
        let camera = Camera::LookAt {
            location: at([0.9, 1.5, 0.0]),
            look_at: at([0.95, 1.45, -1.0]),
            angle: 110.0,
        };
        let floor = plane([0.0, 1.0, 0.0], 0.0).checker(&[Step::Scale([0.7 * r; 3])]);
        for ior in [1.5, 2.4] {
            let ball = sphere(at([0.0, 1.5, 0.0]), r).color([1.0, 0.9, 0.9]).finish(0.2, 0.1, 0.0);
            let ball = clear(ball, 0.9, 0.0, ior);
            let lights = [light(at([5.0, 8.0, 6.0]))];
            let scene = Scene::new(camera, &lights, vec![floor.clone(), ball]);
            let name = format!("inside a ball of {ior}, of radius 1e{exponent}");
            hold_sized(&name, &scene.deep(9), (24, 18));
        }
    }
}
