//! Rays of each kind of camera, with POV-Ray 3.7's.

use super::*;
use crate::math::wide::{Instructions, ROW, Rays};
use crate::road::{Options, Road};
use crate::scene::Dialect;
use crate::source::NoFiles;
use crate::world::{self, World};

/// Rays of POV-Ray 3.7 from cameras at the origin, each line with: the kind and its angles in degrees (0 for none);
/// `direction`, `right` and `up`; u and v; the point of the ball of radius 100 about the origin, over 100, that is
/// seen, or `none` for black.
const MEASURED: &str = include_str!("measured.txt");

fn kind(words: &[&str]) -> CameraKind {
    let turns = |i: usize| words[i].parse::<f64>().expect("an angle") / 360.0;
    let angle = turns(1);
    match words[0] {
        "fisheye" => CameraKind::Fisheye { angle },
        "ultra_wide_angle" => CameraKind::UltraWideAngle { angle },
        "omnimax" => CameraKind::Omnimax,
        "panoramic" => CameraKind::Panoramic,
        "spherical" => CameraKind::Spherical { across: angle, down: turns(2) },
        number => CameraKind::Cylinder {
            upright: matches!(number, "cylinder_1" | "cylinder_3"),
            moving: matches!(number, "cylinder_3" | "cylinder_4"),
            angle,
        },
    }
}

#[test]
fn every_kind_has_the_rays_of_povray() {
    let mut kinds = std::collections::BTreeSet::new();
    for line in MEASURED.lines() {
        let words: Vec<&str> = line.split_whitespace().collect();
        let number = |i: usize| words[i].parse::<f64>().expect("a number");
        let vector = |i: usize| Vector::new(number(i), number(i + 1), number(i + 2));
        let [forward, right, up] = [3, 6, 9].map(vector);
        let camera = Camera {
            kind: kind(&words),
            location: Vector::ZERO,
            forward,
            right,
            up,
            ..Camera::default()
        };
        let lens = Lens::new(&camera, 16, 12);
        let point = Point { u: number(12), v: number(13), lens: [0.0; 2] };
        let ray = lens.rays(&[point])[0];
        assert_eq!(ray.is_some(), words[14] != "none", "{line}");
        kinds.insert(words[0]);
        let Some(Ray { origin, direction }) = ray else { continue };
        assert!((direction.length() - 1.0).abs() < 1e-15, "{line}");
        let b = origin.dot(direction);
        let seen = origin + direction * ((b * b - origin.length_squared() + 1e4).sqrt() - b);
        let off = (seen * 0.01 - vector(14)).abs().max_element();
        assert!(off < 3e-7, "{line}: {off}");
    }
    assert_eq!(kinds.len(), 9);
}

fn rays(kind: CameraKind, points: &[(f64, f64)]) -> Vec<Option<Vector>> {
    let camera = Camera { kind, forward: Vector::Z, right: Vector::X, ..Camera::default() };
    let points: Vec<Point> = points.iter().map(|&(u, v)| Point { u, v, lens: [0.0; 2] }).collect();
    let rays = Lens::new(&camera, 4, 3).rays(&points);
    rays.into_iter().map(|ray| ray.map(|ray| ray.direction)).collect()
}

#[test]
fn poles_and_edges_of_panoramas_are_exact() {
    let spherical = CameraKind::Spherical { across: 1.0, down: 0.5 };
    let seen = rays(spherical, &[(0.0, 0.0), (0.25, 0.0), (-0.25, 0.0), (0.5, 0.0), (0.3, 0.5)]);
    let expected = [Vector::Z, Vector::X, -Vector::X, -Vector::Z, Vector::Y];
    assert_eq!(seen, expected.map(Some));
    let seen = rays(CameraKind::Panoramic, &[(0.0, 0.5), (0.5, 0.0), (0.1, -0.5)]);
    assert_eq!(seen, [Vector::Y, Vector::X, -Vector::Y].map(Some));
    let half = CameraKind::Fisheye { angle: 0.5 };
    assert_eq!(
        rays(half, &[(0.5, 0.0), (0.0, 0.0), (0.0, -0.5), (0.4, 0.4)]),
        [Some(Vector::X), Some(Vector::Z), Some(-Vector::Y), None]
    );
}

#[test]
fn any_angle_and_any_size_gives_directions_of_length_one() {
    use CameraKind::{Cylinder, Fisheye, Omnimax, Panoramic, Spherical, UltraWideAngle};
    for angle in [0.0, 1e-300, 0.5, 1.0, 7.3, 1e15, 1e300] {
        for size in [1e-300, 1e-9, 1.0, 1e9, 1e300] {
            for kind in [
                Fisheye { angle },
                UltraWideAngle { angle },
                Omnimax,
                Panoramic,
                Cylinder { upright: true, moving: false, angle },
                Cylinder { upright: false, moving: true, angle },
                Spherical { across: angle, down: angle },
            ] {
                let camera = Camera { kind, up: Vector::Y * size, ..Camera::default() };
                let lens = Lens::new(&camera, 4, 3);
                let points = [(-0.5, 0.5), (0.0, 0.0), (0.1, -0.2), (0.5, 0.5)];
                let points = points.map(|(u, v)| Point { u, v, lens: [0.0; 2] });
                for ray in lens.rays(&points).into_iter().flatten() {
                    let long = ray.direction.length();
                    assert!((long - 1.0).abs() < 1e-15, "{kind:?} {size}: {ray:?}");
                }
            }
        }
    }
}

fn blurred(kind: CameraKind, distance: f64, radius: f64) -> Lens {
    let (least, most, confidence, variance, bokeh) = (7, 50, 0.9, 1.0 / 128.0, None);
    let focus = world::Focus { radius, distance, least, most, confidence, variance, bokeh };
    Lens::new(&Camera { kind, focus: Some(focus), ..Camera::default() }, 4, 3)
}

#[test]
fn rays_of_a_lens_meet_where_it_is_in_focus() {
    for kind in [CameraKind::Perspective, CameraKind::Fisheye { angle: 0.3 }] {
        let lens = blurred(kind, 10.0, 2.0);
        let lenses = [[0.1, 0.2], [0.9, 0.4], [0.5, 0.7]];
        let rays = lens.rays(&lenses.map(|lens| Point { u: 0.2, v: 0.3, lens }));
        let middle = lens.rays(&[Point { u: 0.2, v: 0.3, lens: [0.0; 2] }])[0].expect("a ray");
        // A flat screen is in focus in a plane, others in a ball.
        let far = if kind.is_flat() { 10.0 / -middle.direction.z } else { 10.0 };
        let meets = middle.direction * far;
        for ray in rays.into_iter().flatten() {
            assert!(ray.origin.length() > 0.1 && ray.origin.length() <= 2.0);
            let aside = (meets - ray.origin).cross(ray.direction).length();
            assert!(aside < 1e-13, "{kind:?}: {aside}");
        }
    }
}

#[test]
fn any_lens_gives_directions_of_length_one() {
    for distance in [0.0, 1e-300, 1.0, 1e300] {
        for radius in [1e-300, 1e-5, 1.0, 1e300] {
            let lens = blurred(CameraKind::Perspective, distance, radius);
            let (focus, shift) = (lens.focus().expect("blurs"), Shift::of((1, 2)));
            let points: Vec<Point> =
                (0..20).map(|k| lens.blurred(focus, (1, 2), &shift, k)).collect();
            for ray in lens.rays(&points).into_iter().flatten() {
                let long = ray.direction.length();
                assert!((long - 1.0).abs() < 1e-15, "{distance} {radius}: {ray:?}");
            }
        }
    }
}

#[test]
fn rays_of_a_lens_side_by_side_are_those_of_each_alone() {
    for distance in [0.0, 1e-300, 1.0, 7.3, 1e300] {
        for radius in [1e-300, 0.3, 1e300] {
            let lens = blurred(CameraKind::Perspective, distance, radius);
            let (flat, focus) = lens.flat().expect("a flat camera");
            let (focus, shift) = (focus.expect("blurs"), Shift::of((2, 1)));
            let points: [Point; ROW] =
                std::array::from_fn(|k| lens.blurred(focus, (2, 1), &shift, k as u32));
            let of = |place: fn(&Point) -> f64| points.each_ref().map(place);
            let places = [of(|p| p.u), of(|p| p.v), of(|p| p.lens[0]), of(|p| p.lens[1])];
            let alone = lens.rays(&points);
            for instructions in Instructions::all() {
                let mut rays = Rays { mask: 0x7fff, ..Rays::NONE };
                flat.find_blurred(instructions, focus, &places, &mut rays);
                for (number, ray) in alone.iter().enumerate().take(15) {
                    assert_eq!(Some(rays.at(number)), *ray, "{distance} {radius}");
                }
            }
        }
    }
}

#[test]
fn samples_of_a_pixel_cover_it_and_the_lens_evenly() {
    let count = 1000;
    let lens = blurred(CameraKind::Perspective, 10.0, 2.0);
    let (focus, shift) = (lens.focus().expect("blurs"), Shift::of((3, 5)));
    let mut means = [[0.0; 2]; 4];
    for number in 0..count {
        let [within, lens] = focus.sample(&shift, number);
        assert!(within.iter().all(|x| (0.0..1.0).contains(x)));
        assert!(lens[0] * lens[0] + lens[1] * lens[1] <= 1.0);
        for (mean, x) in means.iter_mut().zip(within.into_iter().chain(lens)) {
            *mean = [mean[0] + x, mean[1] + x * x];
        }
    }
    let means = means.map(|mean| mean.map(|sum| sum / f64::from(count)));
    // The square's mean of a square's side, and of a disc's coordinate.
    for ([mean, square], expected) in means.into_iter().zip([0.5, 0.5, 0.0, 0.0]) {
        let square_expected = if expected > 0.0 { 1.0 / 3.0 } else { 0.25 };
        assert!((mean - expected).abs() < 0.01, "{mean} {expected}");
        assert!((square - square_expected).abs() < 0.01, "{square} {expected}");
    }
}

#[test]
fn mirrored_samples_have_exactly_mirrored_coordinates() {
    for (pixels, grid) in [(1, 1), (3, 1), (640, 3), (1919, 7)] {
        for pixel in 0..pixels {
            for sample in 0..grid {
                let here = centre(pixel, sample, pixels, grid);
                let there = centre(pixels - 1 - pixel, grid - 1 - sample, pixels, grid);
                assert_eq!(here, -there);
            }
        }
    }
}

fn world(text: &str) -> World {
    let mut road = Road::new(&NoFiles, Options::new(Dialect::Pov));
    let (world, _) = road.compile("a.pov", text.as_bytes().to_vec());
    assert!(!road.diagnostics.has_errors(), "{text}");
    world
}

/// Where a ray leaves the sphere, or comes into it from outside; `None` if it misses.
fn met(ray: &Ray) -> Option<Vector> {
    let (b, c) = (ray.origin.dot(ray.direction), ray.origin.length_squared() - 1e4);
    let root = (b * b - c).max(0.0).sqrt();
    let t = if -b - root > 0.0 { -b - root } else { -b + root };
    (t > 0.0).then(|| ray.origin + ray.direction * t)
}

/// Asserts where the rays of cameras meet a sphere of radius 100 around the origin. Each line of `measured`: the width
/// and the height of a picture, a camera's items, and for each pixel the mean of where its rays meet the sphere; `-` for
/// black pixels.
pub(super) fn assert_meets(measured: &str, count: u32) {
    let is_case = |line: &&str| line.contains(';') && !line.starts_with('#');
    let declared: Vec<&str> = measured.lines().filter(|line| line.starts_with('#')).collect();
    let mut pixels = 0u32;
    for case in measured.lines().filter(is_case) {
        let parts: Vec<&str> = case.split("; ").collect();
        let sizes: Vec<u32> = parts[0].split(' ').map(|n| n.parse().expect("a size")).collect();
        let text = format!(
            "#version 3.7; global_settings {{ assumed_gamma 1 }} {} camera {{ {} }}",
            declared.join("\n"),
            parts[1]
        );
        let lens = Lens::new(&world(&text).camera, sizes[0], sizes[1]);
        let places = (0..sizes[1]).flat_map(|y| (0..sizes[0]).map(move |x| (x, y)));
        for (place, theirs) in places.zip(parts[2].split(' ')) {
            let points = [lens.point(place, (0, 0), 1)];
            let rays = lens.rays(&points);
            let met: Vec<Vector> = rays.iter().flatten().filter_map(met).collect();
            pixels += 1;
            if theirs == "-" {
                assert!(met.is_empty(), "{} {place:?}", parts[1]);
                continue;
            }
            let theirs: Vec<f64> =
                theirs.split(',').map(|n| n.parse().expect("a coordinate")).collect();
            let theirs = Vector::new(theirs[0], theirs[1], theirs[2]);
            let mean = met.iter().fold(Vector::ZERO, |sum, &one| sum + one) / met.len() as f64;
            assert!((mean - theirs).length() < 0.006, "{} {place:?}: {mean} {theirs}", parts[1]);
        }
    }
    assert_eq!(pixels, count);
}

#[test]
fn a_normal_of_a_bent_screen_is_evaluated_where_pov_ray_does() {
    assert_meets(include_str!("normals.txt"), 125);
}
