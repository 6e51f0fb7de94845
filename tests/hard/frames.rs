//! Pictures of hard shapes, deep paths, knife edges and the display's curve: rows 45, 62, 73, 74,
//! 75 and 76.

use lucarne::color::{Gamma, Rgb, srgb_decode, srgb_encode};
use lucarne::film::{Components, Depth, Film, Pixel, develop};
use lucarne::math::elementary::sin_cos_degrees;
use lucarne::plan::{Antialias, Frame, PlanOptions, plan};
use lucarne::trace::{TraceOptions, Unwatched, trace};

use super::held::{compiled, hold_sized, rendered, unrounded};
use super::scene::{Camera, Light, Scene, Triple, WHITE, cuboid, plane, sphere};
use crate::dice::Dice;
use crate::unrounded::radiances;

fn sampled(text: &str, (width, height): (u32, u32), antialias: Antialias) -> Film {
    let (world, origins) = compiled(text);
    let frame = Frame::whole(width, height);
    let plan = plan(&world, &origins, &PlanOptions { antialias, ..PlanOptions::new(frame) });
    trace(&world, &plan, &TraceOptions::on_threads(1), &Unwatched).film
}

#[test]
fn row_45_a_light_on_the_surface_itself_or_in_its_plane_gives_nothing() {
    // The rays of this camera meet the floor at whole numbers.
    let camera = Camera::Orthographic {
        location: [0.0, 5.0, 0.0],
        direction: [0.0, -1.0, 0.0],
        right: [5.0, 0.0, 0.0],
        up: [0.0, 0.0, -5.0],
    };
    let floor = || plane([0.0, 1.0, 0.0], 1.0);
    let dark = |position: Triple, expected: f64| {
        let scene = Scene::new(camera, &[Light { position, color: WHITE }], vec![floor()]);
        for c in unrounded(&scene.text(), (5, 5)) {
            assert!((c.red - expected).abs() < 1e-15, "{position:?}: {c:?}");
        }
        // The seed's finish, too: with N·L = 0 its highlight looks for N·H.
        let seed = scene.text().replace(
            "finish { ambient 1e-1 diffuse 7e-1 reflection { rgb 0e0 } }",
            "finish { kd 0.5 ks 0.3 phong_exponent 20 }",
        );
        assert_ne!(seed, scene.text());
        let film = rendered(&seed, (5, 5));
        assert!(film.radiances().all(|c| c.is_finite()), "{position:?}");
    };
    for x in -2..=2 {
        for z in -2..=2 {
            dark([f64::from(x), 1.0, f64::from(z)], 0.1);
        }
    }
    for position in [[1e9, 1.0, 3.0], [1e-300, 1.0, 0.0], [0.5, 1.0, -0.25]] {
        dark(position, 0.1);
    }
    // On a ball, seen where the light is: the light is at one pixel's point.
    let ball = sphere([0.0; 3], 1.0);
    let light = Light { position: [0.0, 1.0, 0.0], color: WHITE };
    let seen = unrounded(&Scene::new(camera, &[light], vec![ball]).text(), (5, 5));
    assert_eq!(seen[12], Rgb::gray(0.1));
}

#[test]
fn row_62_the_displays_curve_is_monotone_and_keeps_its_numbers() {
    assert_eq!((srgb_encode(0.0), srgb_encode(1.0)), (0.0, 1.0));
    assert_eq!(srgb_encode(f64::NAN), 0.0);
    let shown = |radiance: Vec<Rgb>, depth: Depth| {
        let mut film = Film::new(Frame::whole(radiance.len() as u32, 1), Gamma::LINEAR);
        film.pixels = radiance.into_iter().map(|radiance| Pixel::new(radiance, 1)).collect();
        develop(&film, depth).components
    };
    let codes = |last: u32| (0..=last).map(move |n| srgb_decode(f64::from(n) / f64::from(last)));
    // What was decoded is encoded to itself.
    let Components::Eight(eight) = shown(codes(255).map(Rgb::gray).collect(), Depth::Eight) else {
        panic!("eight bits")
    };
    assert!(eight.iter().enumerate().all(|(i, &code)| usize::from(code) == i / 3));
    let Components::Sixteen(wide) = shown(codes(65_535).map(Rgb::gray).collect(), Depth::Sixteen)
    else {
        panic!("sixteen bits")
    };
    assert!(wide.iter().enumerate().all(|(i, &code)| usize::from(code) == i / 3));
    // And in 65,536 equal steps of light none is darker than the one before.
    let steps = (0..=65_535).map(|n| Rgb::gray(f64::from(n) / 65_535.0)).collect::<Vec<_>>();
    let Components::Eight(eight) = shown(steps, Depth::Eight) else { panic!("eight bits") };
    assert!(eight.is_sorted() && eight[..3] == [0; 3] && eight[3 * 65_535..] == [255; 3]);
    let seen: std::collections::BTreeSet<u8> = eight.into_iter().collect();
    assert_eq!(seen.len(), 256);
}

#[test]
fn row_73_sizes_below_all_normal_numbers_are_drawn_or_refused() {
    let text = |k: &str| {
        format!(
            "camera {{ location <0, 0, 3>*{k} look_at 0 }} light_source {{ <5, 5, 5>*{k}, rgb 1 }}
             sphere {{ 0, {k} }} box {{ -{k}, {k} translate 2*{k}*x }} plane {{ y, -{k} }}"
        )
    };
    for k in ["1e-150", "1e-290", "1e-305", "1e-310", "1e150", "1e290", "1e305"] {
        for c in rendered(&text(k), (16, 12)).radiances() {
            assert!(!c.red.is_nan(), "{k}: {c:?}");
        }
    }
}

#[test]
fn row_74_a_path_may_be_as_long_as_one_likes_on_a_small_stack() {
    let tunnel = |level: u32| {
        let room = cuboid([-1.0; 3], [1.0; 3]).finish(0.25, 0.0, 1.0);
        let camera =
            Camera::LookAt { location: [0.1, 0.2, 0.3], look_at: [0.9, 0.4, -0.8], angle: 40.0 };
        Scene::new(camera, &[], vec![room]).deep(level).text()
    };
    for level in [0, 1, 2, 256, 1_000_000] {
        let text = tunnel(level.max(1));
        let seen = std::thread::Builder::new()
            .stack_size(256 * 1024)
            .spawn(move || {
                let (world, origins) = compiled(&text);
                let frame = Frame::whole(2, 1);
                let options = PlanOptions {
                    antialias: Antialias::Off,
                    depth: Some(level),
                    ..PlanOptions::new(frame)
                };
                let plan = plan(&world, &origins, &options);
                radiances(&world, &plan, &TraceOptions::on_threads(1))
            })
            .expect("a thread")
            .join()
            .expect("no overflow");
        // Each surface adds its emission of ¼; white from 4 on.
        let expected = 0.25 * f64::from(level.max(1));
        for c in seen {
            assert!((c.red / expected - 1.0).abs() < 1e-9, "{level}: {}", c.red);
        }
    }
}

/// The part of the square −½ … ½ where a·x + b·y < c.
fn area(a: f64, b: f64, c: f64) -> f64 {
    // By symmetry 0 ≤ b ≤ a. The line runs from bottom to top between these two places.
    let (a, b) = (a.abs().max(b.abs()), a.abs().min(b.abs()));
    let steps = 4096;
    let width = |y: f64| ((c - b * y) / a + 0.5).clamp(0.0, 1.0);
    (0..steps).map(|i| width((f64::from(i) + 0.5) / f64::from(steps) - 0.5)).sum::<f64>()
        / f64::from(steps)
}

#[test]
fn row_75_a_knife_edge_covers_what_it_covers() {
    let mut dice = Dice(75);
    for n in 0..1000 {
        let degrees = 0.36 * f64::from(n);
        let (sine, cosine) = sin_cos_degrees(degrees);
        let distance = dice.between(-0.8, 0.8);
        // White where the half space is, black elsewhere, on a picture of one pixel.
        let text = format!(
            "camera {{ orthographic location 9*z direction -z right x up y }}
             box {{ <-9, -9, -1>, <{distance:e}, 9, 1> rotate {degrees:e}*z
                    pigment {{ rgb 1 }} finish {{ ambient 1 diffuse 0 }} }}"
        );
        for side in [4, 9] {
            let film = sampled(&text, (1, 1), Antialias::Grid(side));
            let off = film.radiance(0).red - area(cosine, sine, distance);
            let bar = 0.5 / f64::from(side) + 1e-3;
            assert!(off.abs() <= bar, "{degrees}°, {distance}: {off:e} with {side}");
        }
    }
}

fn any_scene(angle: f64) -> Scene {
    let camera = Camera::LookAt { location: [1.0, 2.0, 6.0], look_at: [0.0, 1.0, 0.0], angle };
    let objects = vec![
        plane([0.0, 1.0, 0.0], 0.0).checker(&[]),
        sphere([0.0, 1.0, 0.0], 1.0).finish(0.1, 0.5, 0.4),
        cuboid([1.0, 0.0, -1.0], [2.0, 1.0, 1.0]),
    ];
    Scene::new(camera, &[Light { position: [4.0, 6.0, 5.0], color: WHITE }], objects)
}

#[test]
fn row_76_pictures_may_have_any_shape_and_any_angle() {
    for size in [(1, 1), (1, 200), (200, 1), (3, 97)] {
        hold_sized(&format!("{size:?} pixels"), &any_scene(45.0), size);
    }
    let wide = rendered(&any_scene(45.0).text(), (100_000, 1));
    let high = rendered(&any_scene(45.0).text(), (1, 100_000));
    assert!(wide.radiances().chain(high.radiances()).all(|c| c.is_finite()));
    for angle in [1e-9, 1e-3, 120.0, 170.0, 179.0] {
        hold_sized(&format!("an angle of {angle}"), &any_scene(angle), (16, 12));
    }
    for angle in [1e-300, 179.999, 179.999_999_999] {
        let film = rendered(&any_scene(angle).text(), (16, 12));
        assert!(film.radiances().all(|c| c.is_finite()), "{angle:e}");
    }
}
