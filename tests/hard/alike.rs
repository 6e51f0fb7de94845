//! Shapes of other words that are spheres: row 30.

use crate::held::{SIZE, hold_text};
use crate::scene::{Camera, Light, Scene, Triple, WHITE, sphere, ten};

const CLAY: Triple = [0.9, 0.5, 0.2];

/// What is a ball of radius r around the origin, up to its braces.
fn balls(r: f64) -> [(&'static str, String); 6] {
    let (wide, half, third) = (r * 2.0_f64.sqrt(), r / 2.0, r / 3.0);
    [
        ("a blob", format!("blob {{ sphere {{ <0, 0, 0>, {wide:e}, 4 }}")),
        (
            "a blob of two thresholds",
            format!(
                "blob {{ threshold 2 sphere {{ <0, 0, 0>, {wide:e}, 3 }} sphere {{ <0, 0, 0>, {wide:e}, 5 }}"
            ),
        ),
        ("a superellipsoid", format!("superellipsoid {{ <1, 1> scale {r:e}")),
        ("an ovus", format!("ovus {{ {third:e}, {r:e} translate {:e}*y", -third)),
        (
            "a sweep",
            format!(
                "sphere_sweep {{ linear_spline 2, <0, 0, 0>, {r:e}, <{half:e}, 0, 0>, {third:e}"
            ),
        ),
        (
            "a curved sweep",
            format!("sphere_sweep {{ b_spline 4, {}", format!("<0, 0, 0>, {r:e}, ").repeat(4)),
        ),
    ]
}

#[test]
fn row_30_blobs_superellipsoids_eggs_and_sweeps_may_be_spheres_of_any_size() {
    for exponent in (-12..=12).step_by(4) {
        let r = ten(exponent);
        let camera = Camera::LookAt { location: [0.0, r, 3.0 * r], look_at: [0.0; 3], angle: 50.0 };
        let lights = [Light { position: [4.0 * r, 5.0 * r, 3.0 * r], color: WHITE }];
        let scene = Scene::new(camera, &lights, vec![sphere([0.0; 3], r).color(CLAY)]);
        let text = scene.text();
        let start = text.find("sphere {").expect("the sphere");
        let end = start + text[start..].find(" pigment").expect("its pigment");
        for (name, ball) in balls(r) {
            let text = format!("{}{ball}{}", &text[..start], &text[end..]);
            hold_text(&format!("{name} of radius 1e{exponent}"), &scene, &text, SIZE);
        }
    }
}
