//! Polyhedra: the box around what planes share, held against all of their corners.

use super::*;
use crate::math::double::{Double, DoubleVector};
use crate::shape::csg::Node;

/// What some planes share, as one whole.
fn polyhedron(planes: &[Plane]) -> World {
    let mut world = empty();
    let mut nodes = Vec::new();
    for plane in planes {
        add_plane(&mut world, plane.normal, plane.distance);
        nodes.push(Node::Leaf { inverse: false });
    }
    world.objects.iter_mut().for_each(|object| object.csg_solid = Some(0));
    nodes.push(Node::Intersection(planes.len() as u32));
    world.csg_solids.push(crate::world::CsgSolid {
        nodes,
        first: 0,
        count: planes.len() as u32,
        cutaway: Vec::new(),
    });
    world
}

fn bounds_of(planes: &[Plane], rounding: Rounding) -> Option<Bounds> {
    Extent::of(&polyhedron(planes), 0, rounding).bounds()
}

/// Around a small ball, some of them through one point, parallel, or nearly so.
fn random_planes(random: &mut Random, centre: Vector, size: f64) -> Vec<Plane> {
    let mut planes: Vec<Plane> = Vec::new();
    let tip = random.direction().get();
    for _ in 0..4 + random.below(12) {
        let normal = match (random.below(4), planes.last()) {
            (0, _) => random.structured_direction(),
            (1, Some(last)) => {
                let near = last.normal.get() + random.direction().get() * random.size(-6.0, 0.0);
                UnitVector::from_direction(near).unwrap_or(UnitVector::X)
            }
            (2, Some(last)) => -last.normal,
            _ => random.direction(),
        };
        let through_tip = normal.get().dot(tip);
        let through_tip = if through_tip < 0.1 { 1.0 } else { through_tip };
        let share = [1.0, through_tip, random.number(0.1, 1.0)][random.below(3)];
        planes.push(Plane { normal, distance: normal.get().dot(centre) + size * share });
    }
    planes
}

/// Where three planes meet, and how far rounding may have moved it where numbers are as large as `far`.
fn corner([a, b, c]: [&Plane; 3], far: f64) -> Option<(Vector, f64)> {
    let normals = [a, b, c].map(|plane| plane.normal.get());
    let matrix = Matrix::from_cols(normals[0], normals[1], normals[2]).transpose();
    let flatness = 1.0 / matrix.determinant().abs();
    let distances = Vector::new(a.distance, b.distance, c.distance);
    let inverse = matrix.inverse();
    let rough = inverse * distances;
    let point = rough + inverse * (distances - matrix * rough);
    let size = distances.abs().max_element() + point.abs().max_element().max(far);
    (flatness < 1e13).then_some((point, 64.0 * f64::EPSILON * size * flatness))
}

/// Whether a place lies in all of them, in twice the digits.
fn contains(planes: &[Plane], point: Vector) -> bool {
    planes.iter().all(|plane| {
        let place = DoubleVector::from(plane.normal.get()).dot(DoubleVector::from(point));
        (place - Double::from(plane.distance)).round() <= 0.0
    })
}

fn corners(planes: &[Plane], far: f64) -> Vec<(Vector, f64)> {
    let triples = (0..planes.len())
        .flat_map(|i| (0..i).flat_map(move |j| (0..j).map(move |k| [i, j, k])))
        .filter_map(|triple| corner(triple.map(|i| &planes[i]), far));
    triples
        .filter(|(point, off)| {
            planes.iter().all(|plane| plane.signed_distance(*point) >= -4.0 * off)
        })
        .collect()
}

#[test]
fn a_polyhedron_lies_in_its_bounds_and_they_are_no_wider_than_its_corners() {
    let mut random = Random(31);
    let (mut inside, mut tight) = (0, 0);
    for _ in 0..tries_in(40) {
        let size = random.size(-150.0, 150.0);
        let far = [0.0, 1.0, 1e3][random.below(3)];
        let centre = random.point(size * far);
        let planes = random_planes(&mut random, centre, size);
        let Some(Bounds { low, high }) = bounds_of(&planes, Rounding::Outward) else { continue };
        let corners = corners(&planes, low.abs().max(high.abs()).max_element());
        for (point, off) in &corners {
            // Beside it, too, by a few roundings, inward for the most part.
            for _ in 0..4 {
                let beside =
                    *point + random.point(*off) + (centre - *point) * random.size(-17.0, -14.0);
                if contains(&planes, beside) {
                    assert!(
                        Bounds { low, high }.contains(beside),
                        "{beside} {low} {high} {planes:?}"
                    );
                    inside += 1;
                }
            }
        }
        // In a spike a thousand times as long as the ball is large, planes are too nearly parallel to be told.
        if (high - low).max_element() > 1e3 * size {
            continue;
        }
        for axis in 0..3 {
            for (sign, end) in [(1.0, high[axis]), (-1.0, -low[axis])] {
                let room = |(point, off): &(Vector, f64)| sign * point[axis] + 8.0 * off;
                let most = corners.iter().map(room).fold(f64::NEG_INFINITY, f64::max);
                if most.is_finite() {
                    assert!(end <= most, "{end} {most} {planes:?}");
                    tight += 1;
                }
            }
        }
    }
    assert!(inside > tries() / 20 && tight > tries() / 20, "{inside} inside, {tight} tight");
}

#[test]
fn what_planes_share_without_an_end_has_no_bounds() {
    let mut random = Random(32);
    for _ in 0..tries_in(100) {
        let size = random.size(-8.0, 8.0);
        let centre = random.point(size);
        let away = random.direction().get();
        let mut planes = random_planes(&mut random, centre, size);
        // None of them ends that way, and the centre is in all.
        for plane in &mut planes {
            if plane.normal.get().dot(away) > -1e-3 {
                let turned = plane.normal.get() - away * (plane.normal.get().dot(away) + 0.1);
                plane.normal = UnitVector::from_direction(turned).unwrap_or(UnitVector::X);
            }
            plane.distance = plane.normal.get().dot(centre) + size;
        }
        if planes.iter().all(|plane| plane.normal.get().dot(away) < 0.0) {
            assert_eq!(bounds_of(&planes, Rounding::Outward), None, "{planes:?}");
        }
    }
}

#[test]
fn a_tetrahedron_an_octahedron_and_a_leaning_box_end_where_they_do() {
    let facing = |x: f64, y: f64, z: f64, distance: f64| {
        let normal = UnitVector::from_direction(Vector::new(x, y, z)).unwrap_or(UnitVector::X);
        Plane { normal, distance }
    };
    let ends = |planes: &[Plane], corner: Vector| {
        let Some(Bounds { low, high }) = bounds_of(planes, Rounding::Nearest) else {
            panic!("no bounds of {planes:?}");
        };
        assert!((high - corner).abs().max_element() < 1e-14, "{high}");
        assert!((low + corner).abs().max_element() < 1e-14, "{low}");
    };
    let signs = [-1.0, 1.0];
    let octahedron = signs.into_iter().flat_map(|x| signs.map(|y| [x, y]));
    let octahedron = octahedron.flat_map(|[x, y]| signs.map(|z| facing(x, y, z, 1.0)));
    ends(&octahedron.collect::<Vec<_>>(), Vector::splat(3.0_f64.sqrt()));
    let tetrahedron = [(1.0, 1.0, 1.0), (1.0, -1.0, -1.0), (-1.0, 1.0, -1.0), (-1.0, -1.0, 1.0)];
    let tetrahedron = tetrahedron.map(|(x, y, z)| facing(x, y, z, 1.0));
    ends(&tetrahedron, Vector::splat(3.0_f64.sqrt()));
    let leaning = [(3.0, -4.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)];
    let leaning = leaning.map(|(x, y, z)| [facing(x, y, z, 1.0), facing(-x, -y, -z, 1.0)]);
    ends(leaning.as_flattened(), Vector::new(3.0, 1.0, 1.0));
    // Without one of its faces it has no end.
    assert_eq!(bounds_of(&leaning.as_flattened()[1..], Rounding::Outward), None);
    assert_eq!(bounds_of(&tetrahedron[1..], Rounding::Outward), None);
}

#[test]
fn a_ball_that_planes_cut_ends_at_them() {
    let mut world = polyhedron(&[Plane {
        normal: UnitVector::from_direction(Vector::new(1.0, 1.0, 0.0)).unwrap_or(UnitVector::X),
        distance: -0.5 * 2.0_f64.sqrt(),
    }]);
    add_sphere(&mut world, Vector::ZERO, 1.0);
    world.objects[1].csg_solid = Some(0);
    let leaf = Node::Leaf { inverse: false };
    world.csg_solids[0].nodes = vec![leaf, leaf, Node::Intersection(2)];
    world.csg_solids[0].count = 2;
    let Extent(bounds) = Extent::of(&world, 0, Rounding::Nearest);
    // x ≤ −1 − y, and y ≥ −1.
    assert!((bounds.high - Vector::new(0.0, 0.0, 1.0)).abs().max_element() < 1e-14, "{bounds:?}");
    assert_eq!(bounds.low, Vector::splat(-1.0));
}

/// A round of a hundred thousand faces, and one of two.
#[test]
fn many_faces_are_told_in_time() {
    let mut random = Random(33);
    let planes: Vec<Plane> =
        (0..100_000).map(|_| Plane { normal: random.direction(), distance: 1.0 }).collect();
    let Some(Bounds { low, high }) = bounds_of(&planes, Rounding::Outward) else {
        panic!("no bounds")
    };
    assert!(low.abs().max(high.abs()).max_element() < 1.001, "{low} {high}");
    assert_eq!(bounds_of(&planes[..2], Rounding::Outward), None);
}
