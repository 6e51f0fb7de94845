//! Shapes in other words: spheres (row 30) and tori (row 29).

use super::held::{SIZE, Truth};
use super::scene::{Camera, Light, Scene, Step, Triple, WHITE, sphere, ten, torus};

const CLAY: Triple = [0.9, 0.5, 0.2];

/// What is a ball of radius r around the origin, up to its braces.
fn balls(r: f64) -> [(&'static str, String); 8] {
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
        ("a fractal", format!("julia_fractal {{ 0 quaternion cube max_iteration 5 scale {r:e}")),
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
        (
            "an isosurface",
            format!(
                "isosurface {{ function {{ x*x + y*y + z*z - 1 }} contained_by {{ box {{ -1.1, 1.1 }} }} scale {r:e}"
            ),
        ),
    ]
}

#[test]
fn row_30_blobs_superellipsoids_eggs_sweeps_fractals_and_isosurfaces_may_be_spheres_of_any_size() {
    for exponent in (-12..=12).step_by(4) {
        let r = ten(exponent);
        let camera = Camera::LookAt { location: [0.0, r, 3.0 * r], look_at: [0.0; 3], angle: 50.0 };
        let lights = [Light { position: [4.0 * r, 5.0 * r, 3.0 * r], color: WHITE }];
        let scene = Scene::new(camera, &lights, vec![sphere([0.0; 3], r).color(CLAY)]);
        let truth = Truth::of(&scene, SIZE);
        let text = scene.text();
        let start = text.find("sphere {").expect("the sphere");
        let end = start + text[start..].find(" pigment").expect("its pigment");
        for (name, ball) in balls(r) {
            let text = format!("{}{ball}{}", &text[..start], &text[end..]);
            truth.hold(&format!("{name} of radius 1e{exponent}"), &text);
        }
    }
}

/// What is a torus, up to its braces: (p² + k)² = 4R²·(x² + z²), k = R² − r².
fn tori(major: f64, minor: f64) -> [(&'static str, String); 3] {
    let k = major * major - minor * minor;
    let ring = 2.0 * k - 4.0 * major * major;
    let terms = [
        ((4, 0, 0), 1.0),
        ((0, 4, 0), 1.0),
        ((0, 0, 4), 1.0),
        ((2, 2, 0), 2.0),
        ((2, 0, 2), 2.0),
        ((0, 2, 2), 2.0),
        ((2, 0, 0), ring),
        ((0, 2, 0), 2.0 * k),
        ((0, 0, 2), ring),
        ((0, 0, 0), k * k),
    ];
    // All terms, those of higher powers of x and then of y first.
    let mut all = Vec::new();
    for x in (0..=4).rev() {
        for y in (0..=4 - x).rev() {
            for z in (0..=4 - x - y).rev() {
                let known = terms.iter().find(|(powers, _)| *powers == (x, y, z));
                all.push(format!("{:e}", known.map_or(0.0, |(_, factor)| *factor)));
            }
        }
    }
    let named: Vec<String> =
        terms.iter().map(|((x, y, z), factor)| format!("xyz({x}, {y}, {z}): {factor:e}")).collect();
    [
        ("a quartic", format!("quartic {{ <{}>", all.join(", "))),
        ("a poly", format!("poly {{ 4, <{}>", all.join(", "))),
        ("a polynomial", format!("polynomial {{ 4, {}", named.join(", "))),
    ]
}

#[test]
fn row_29_quartics_and_polynomials_may_be_tori_of_any_size() {
    for (major, minor) in [(1.0, 0.25), (0.8, 0.5), (0.7, 0.7), (1.0, 0.02)] {
        for exponent in [-9, -4, 0, 6, 12] {
            let r = ten(exponent);
            let camera = Camera::LookAt {
                location: [0.5 * r, 2.0 * r, 3.0 * r],
                look_at: [0.0; 3],
                angle: 45.0,
            };
            let lights = [Light { position: [4.0 * r, 5.0 * r, 3.0 * r], color: WHITE }];
            let ring = torus(major, minor).color(CLAY);
            let ring = ring.moved(Step::Rotate([20.0, 0.0, 10.0])).moved(Step::Scale([r; 3]));
            let scene = Scene::new(camera, &lights, vec![ring]);
            let text = scene.text();
            let name = format!("a torus of {major} and {minor}, times 1e{exponent}");
            let truth = Truth::of(&scene, (32, 24));
            truth.hold(&name, &text);
            let start = text.find("torus {").expect("the torus");
            let end = start + text[start..].find(" pigment").expect("its pigment");
            for (word, other) in tori(major, minor) {
                let text = format!("{}{other}{}", &text[..start], &text[end..]);
                truth.hold(&format!("{word} for {name}"), &text);
            }
        }
    }
}
