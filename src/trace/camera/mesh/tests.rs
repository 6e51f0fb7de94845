//! Cameras on meshes against POV-Ray 3.7's pictures.

use super::super::{Lens, Point};
use crate::math::Vector;
use crate::road::{Options, Road};
use crate::scene::Dialect;
use crate::shape::Ray;
use crate::source::NoFiles;
use crate::world::World;

/// Declarations of meshes; then for each line the width and the height of a picture, a camera's items, and where its
/// rays meet a sphere of radius 100 around the origin: for each pixel the mean of its rays; `-` for black pixels.
const MEASURED: &str = include_str!("measured.txt");

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

#[test]
fn rays_start_where_pov_ray_lets_them() {
    let is_case = |line: &&str| line.contains(';') && !line.starts_with('#');
    let declared: Vec<&str> = MEASURED.lines().filter(|line| line.starts_with('#')).collect();
    let mut pixels = 0;
    for case in MEASURED.lines().filter(is_case) {
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
            let points: [Point; 1] = [lens.point(place, (0, 0), 1)];
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
    assert_eq!(pixels, 214);
}
