mod algebraic;
mod between;
mod every_body;
mod packets;
mod polyhedra;
mod wholes;

use super::*;
use crate::color::{Color, Rgb};
use crate::math::placement::Placement;
use crate::math::random::{Random, tries, tries_in};
use crate::math::{Matrix, UnitVector, Vector};
use crate::world::{Finish, Object, Pigment, Plain, Texture};

fn empty() -> World {
    let texture = |seed| {
        let finish = Finish {
            conserve_energy: false,
            emission: Rgb::default(),
            diffuse: 0.6,
            brilliance: 1.0,
            lobes: Vec::new(),
            reflection: None,
            seed,
            extras: None,
        };
        let pigment = Pigment::Color(Color::default());
        Texture::Plain(Plain { pigment, normal: None, finish })
    };
    World { textures: vec![texture(false), texture(true)], ..World::default() }
}

fn add(world: &mut World, shape: Shape) {
    let object = Object::plain(shape);
    world.objects.push(object);
}

fn add_sphere(world: &mut World, centre: Vector, radius: f64) {
    world.spheres.push(Sphere { centre, radius });
    let shape = Shape::Sphere(world.spheres.len() as u32 - 1);
    add(world, shape);
}

fn add_plane(world: &mut World, normal: UnitVector, distance: f64) {
    world.planes.push(Plane { normal, distance });
    let shape = Shape::Plane(world.planes.len() as u32 - 1);
    add(world, shape);
}

fn add_box(world: &mut World, box_: Box_) {
    world.boxes.push(box_);
    let shape = Shape::Box(world.boxes.len() as u32 - 1);
    add(world, shape);
}

fn add_ellipsoid(world: &mut World, centre: Vector, world_from_local: Matrix) {
    let local_from_world = world_from_local.inverse();
    let placement = Placement { centre, world_from_local, local_from_world };
    world.ellipsoids.push(Ellipsoid { placement });
    let shape = Shape::Ellipsoid(world.ellipsoids.len() as u32 - 1);
    add(world, shape);
}

fn aligned_box(centre: Vector, half_widths: [f64; 3]) -> Box_ {
    Box_ { centre, normals: [UnitVector::X, UnitVector::Y, UnitVector::Z], half_widths }
}

/// Anything at all, of the given number of objects within `reach`.
fn random_world(random: &mut Random, count: usize, reach: f64) -> World {
    let mut world = empty();
    for _ in 0..count {
        let centre = random.point(reach);
        let size = reach * random.size(-2.5, -0.5);
        match random.below(8) {
            0..4 => add_sphere(&mut world, centre, size),
            4 => add_plane(&mut world, random.direction(), random.number(-reach, reach)),
            5 => add_box(
                &mut world,
                aligned_box(centre, [0; 3].map(|_| size * random.number(0.0, 1.0))),
            ),
            6 => {
                let normals = [random.direction(), random.direction(), random.direction()];
                let [a, b, c] = normals.map(UnitVector::get);
                if a.dot(b.cross(c)).abs() > 0.02 {
                    add_box(&mut world, Box_ { centre, normals, half_widths: [size; 3] });
                }
            }
            _ => add_ellipsoid(&mut world, centre, random.matrix() * size),
        }
    }
    for object in &mut world.objects {
        object.texture = random.below(2) as u32;
        object.inverse = random.below(3) == 0;
        object.casts_shadow = random.below(4) != 0;
    }
    world
}

/// The same entries, tried one after the other.
fn without_tree(geometry: &Geometry) -> Geometry {
    let bounded = geometry.entries.len() - geometry.unbounded;
    let balls = vec![Ball::EVERYWHERE; bounded];
    let balls = balls.chunks(balls::LANES).map(Balls::new).collect();
    let wholes = geometry.wholes.iter().map(Whole::without_tree).collect();
    Geometry { tree: None, balls, hulls: vec![None; bounded], wholes, ..geometry.clone() }
}

/// Rays from anywhere, from surfaces, along axes, at centres.
fn random_ray(random: &mut Random, world: &World, reach: f64) -> Ray {
    let far = reach * random.size(0.0, 4.0);
    let origin = match random.below(4) {
        0 => random.point(reach * 3.0),
        1 => random.point(far),
        2 => random.point(reach),
        _ => world.spheres.first().map_or(Vector::ZERO, |sphere| sphere.centre),
    };
    let direction = match random.below(4) {
        0 => random.structured_direction(),
        1 => random.direction(),
        _ => UnitVector::from_direction(random.point(reach) - origin).unwrap_or(UnitVector::Z),
    };
    Ray { origin, direction: direction.get() }
}

fn assert_tree_agrees(world: &World, random: &mut Random, reach: f64, rays: usize) {
    let geometry = Geometry::build(world);
    let list = without_tree(&geometry);
    for _ in 0..rays {
        let ray = random_ray(random, world, reach);
        assert_eq!(geometry.nearest(&ray), list.nearest(&ray), "{ray:?}");
        let distance = [reach * random.size(-2.0, 1.0), f64::INFINITY][random.below(2)];
        assert_eq!(
            geometry.occluded(&ray, distance),
            list.occluded(&ray, distance),
            "{ray:?} {distance}"
        );
    }
}

#[test]
fn the_tree_finds_what_trying_every_object_finds() {
    let mut random = Random(1);
    for scene in 0..200 {
        let reach = random.size(-8.0, 8.0);
        let count = [10, 50, 300][scene % 3];
        let world = random_world(&mut random, count, reach);
        assert_tree_agrees(&world, &mut random, reach, tries_in(200));
    }
}

/// Grids, equal centres, flat boxes, one giant among specks, far from the origin.
fn structured_worlds() -> Vec<World> {
    let mut grid = empty();
    let mut flat = empty();
    for x in 0..8 {
        for y in 0..8 {
            for z in 0..3 {
                let centre = Vector::new(f64::from(x), f64::from(y), f64::from(z));
                add_sphere(&mut grid, centre, 0.5);
                add_box(&mut flat, aligned_box(centre, [0.5, 0.5, 0.0]));
            }
        }
    }
    let mut nested = empty();
    let mut giant = empty();
    add_sphere(&mut giant, Vector::splat(1e12), 1.7e12);
    let mut far = empty();
    for i in 0..60 {
        let i = f64::from(i);
        add_sphere(&mut nested, Vector::splat(3.0), 0.1 * (1.0 + i));
        add_sphere(&mut giant, Vector::new(i, -i, 0.5 * i) * 0.1, 0.01 * (i + 1.0));
        add_box(&mut far, aligned_box(Vector::new(1e10, -1e10, i), [0.3; 3]));
    }
    vec![grid, flat, nested, giant, far]
}

#[test]
fn a_point_is_nowhere_farther_off_than_is_easily_said() {
    let mut random = Random(9);
    let (mut hits, mut sharp) = (0, 0);
    for _ in 0..60 {
        let reach = random.size(-6.0, 6.0);
        let world = random_world(&mut random, 20, reach);
        let geometry = Geometry::build(&world);
        for _ in 0..tries_in(60) {
            let ray = random_ray(&mut random, &world, reach);
            let Some(hit) = geometry.nearest(&ray) else { continue };
            let surface = surface(&world, &ray, &hit);
            let easy = surface.spread_at_most(&ray, hit.t, hit.error);
            // Along a surface nothing is known.
            if easy.is_finite() {
                let room = surface.point.abs() * (8.0 * f64::EPSILON);
                let tight = spread(&world, &ray, &hit, &surface) + room;
                assert!(tight.max_element() <= easy, "{easy:e} {tight} {hit:?} {ray:?}");
                hits += 1;
                sharp += usize::from(easy < (hit.t + reach) / 10_000.0);
            }
        }
    }
    assert!(hits > tries() / 3 && sharp * 10 > hits * 9, "{sharp} of {hits}");
}

#[test]
fn the_tree_agrees_on_structured_scenes() {
    let mut random = Random(2);
    for world in structured_worlds() {
        assert_tree_agrees(&world, &mut random, 10.0, tries_in(5));
    }
}

#[test]
fn something_is_in_the_way_exactly_when_a_first_hit_of_the_casters_is_certainly_nearer() {
    let mut random = Random(3);
    let mut shadowed = 0;
    for _ in 0..40 {
        let world = random_world(&mut random, 30, 1.0);
        let casters = World {
            objects: world.objects.iter().copied().filter(|object| object.casts_shadow).collect(),
            ..world.clone()
        };
        let (all, casters) = (Geometry::build(&world), Geometry::build(&casters));
        for _ in 0..tries_in(40) {
            let ray = random_ray(&mut random, &world, 1.0);
            let distance = random.size(-2.0, 2.0);
            let first = casters.nearest(&ray).and_then(|hit| {
                let entry = casters.entries.iter().find(|entry| entry.object == hit.object)?;
                casters.first_crossing::<TIGHT>(entry, &ray, hit.t)
            });
            let nearer = first.is_some_and(|first| first.t + first.error < distance);
            assert_eq!(all.occluded(&ray, distance), nearer, "{ray:?} {distance}");
            shadowed += usize::from(nearer);
        }
    }
    assert!(shadowed > tries() / 20, "{shadowed}");
}

#[test]
fn an_easy_bound_is_of_the_same_crossing_and_never_under_the_tightest() {
    let mut random = Random(7);
    let mut easier = 0;
    for _ in 0..40 {
        let reach = random.size(-8.0, 8.0);
        let world = random_world(&mut random, 30, reach);
        let geometry = Geometry::build(&world);
        for _ in 0..tries_in(40) {
            let ray = random_ray(&mut random, &world, reach);
            for entry in &geometry.entries {
                let tight = geometry.first_crossing::<TIGHT>(entry, &ray, f64::INFINITY);
                let easy = geometry.first_crossing::<EASY>(entry, &ray, f64::INFINITY);
                let both = |found: Option<Hit>| found.map(|hit| (hit.t, hit.leaving));
                assert_eq!(both(easy), both(tight), "{ray:?} {entry:?}");
                if let (Some(easy), Some(tight)) = (easy, tight) {
                    assert!(tight.error <= easy.error, "{ray:?} {entry:?}");
                    easier += usize::from(tight.error < easy.error);
                }
            }
        }
    }
    assert!(easier > tries() / 20, "{easier}");
}

#[test]
fn the_order_of_objects_decides_nothing_but_ties() {
    let mut random = Random(4);
    let mut hits = 0;
    for _ in 0..40 {
        let world = random_world(&mut random, 60, 1.0);
        let mut order: Vec<u32> = (0..world.objects.len() as u32).collect();
        for last in (1..order.len()).rev() {
            order.swap(last, random.below(last + 1));
        }
        let objects = order.iter().map(|&object| world.objects[object as usize]).collect();
        let shuffled = World { objects, ..world.clone() };
        let (one, other) = (Geometry::build(&world), Geometry::build(&shuffled));
        for _ in 0..tries_in(40) {
            let ray = random_ray(&mut random, &world, 1.0);
            let found = other.nearest(&ray).map(|hit| (order[hit.object as usize], hit.t));
            let expected = one.nearest(&ray).map(|hit| (hit.object, hit.t));
            assert_eq!(found, expected, "{ray:?}");
            hits += usize::from(expected.is_some());
        }
    }
    assert!(hits > tries() / 10, "{hits}");
}

#[test]
fn of_coinciding_faces_the_first_declared_wins_everywhere() {
    let mut random = Random(5);
    let normals = [random.direction(), random.direction(), random.direction()];
    let tall = Box_ { centre: random.point(1.0), normals, half_widths: [1.0, 2.0, 2.0] };
    let face = tall.face(0).centre;
    // Another box with its face in the same plane, found by another rounding.
    let deep =
        Box_ { centre: face - (face - tall.centre) * 3.0, normals, half_widths: [3.0, 1.0, 1.0] };
    for (first, second) in [(tall, deep), (deep, tall)] {
        for crowd in [0, 20] {
            let mut world = empty();
            add_box(&mut world, first);
            add_box(&mut world, second);
            for _ in 0..crowd {
                add_sphere(&mut world, face - normals[0].get() * 50.0, 1.0);
            }
            let geometry = Geometry::build(&world);
            for _ in 0..tries_in(4) {
                let edges = [1, 2].map(|axis| tall.face(axis).centre - tall.centre);
                let target = face
                    + edges[0] * random.number(-0.2, 0.2)
                    + edges[1] * random.number(-0.2, 0.2);
                let origin = target + (normals[0].get() + random.point(0.5)) * 10.0;
                let direction =
                    UnitVector::from_direction(target - origin).unwrap_or(UnitVector::X);
                let hit = geometry.nearest(&Ray { origin, direction: direction.get() });
                assert_eq!(hit.map(|hit| hit.object), Some(0));
            }
        }
    }
}

#[test]
fn a_surface_with_the_seeds_finish_is_seen_from_outside_only() {
    let mut world = empty();
    add_sphere(&mut world, Vector::ZERO, 1.0);
    let hits = |texture, inverse| {
        let mut world = world.clone();
        (world.objects[0].texture, world.objects[0].inverse) = (texture, inverse);
        let geometry = Geometry::build(&world);
        [-3.0, 0.0].map(|x| {
            let ray = Ray { origin: Vector::X * x, direction: Vector::X };
            assert_eq!(geometry.occluded(&ray, 10.0), geometry.nearest(&ray).is_some());
            geometry.nearest(&ray).map(|hit| (hit.t, hit.leaving))
        })
    };
    assert_eq!(hits(0, false), [Some((2.0, false)), Some((1.0, true))]);
    assert_eq!(hits(0, true), hits(0, false));
    assert_eq!(hits(1, false), [Some((2.0, false)), None]);
    assert_eq!(hits(1, true), [Some((4.0, true)), Some((1.0, true))]);
}

#[test]
fn many_coinciding_spheres_make_no_deep_tree_and_the_first_is_hit() {
    for count in [10_000, 100_000, 1_000_000] {
        let mut world = empty();
        for _ in 0..count {
            add_sphere(&mut world, Vector::new(1.0, 2.0, 3.0), 0.5);
        }
        let geometry = Geometry::build(&world);
        // Building it asserts the depth.
        assert!(geometry.tree.is_some());
        let ray = Ray { origin: Vector::new(1.0, 2.0, 9.0), direction: -Vector::Z };
        assert_eq!(geometry.nearest(&ray).map(|hit| (hit.object, hit.t)), Some((0, 5.5)));
    }
}

#[test]
fn a_scene_scaled_by_a_power_of_two_or_mirrored_is_hit_alike_to_the_last_bit() {
    let mut random = Random(6);
    for exponent in [-200, -37, 1, 200] {
        let k = f64::from_bits(((1023 + exponent) as u64) << 52);
        let world = random_world(&mut random, 40, 1.0);
        let moved = |map: fn(Vector) -> Vector, k: f64| {
            let mut moved = world.clone();
            let unit = |n: UnitVector| UnitVector::from_unit(map(n.get()));
            for sphere in &mut moved.spheres {
                (sphere.centre, sphere.radius) = (map(sphere.centre) * k, sphere.radius * k);
            }
            for plane in &mut moved.planes {
                (plane.normal, plane.distance) = (unit(plane.normal), plane.distance * k);
            }
            for box_ in &mut moved.boxes {
                box_.centre = map(box_.centre) * k;
                box_.normals = box_.normals.map(unit);
                box_.half_widths = box_.half_widths.map(|l| l * k);
            }
            for Ellipsoid { placement } in &mut moved.ellipsoids {
                let Placement { centre, world_from_local: w, local_from_world: l } = *placement;
                let mirror = Matrix::from_cols(map(Vector::X), map(Vector::Y), map(Vector::Z));
                placement.centre = map(centre) * k;
                placement.world_from_local = mirror * w * k;
                placement.local_from_world = l * mirror * (1.0 / k);
            }
            Geometry::build(&moved)
        };
        let maps: [fn(Vector) -> Vector; 3] =
            [|v| v, |v| Vector::new(-v.x, v.y, v.z), |v| Vector::new(v.x, v.y, -v.z)];
        for map in maps {
            let (plain, other) = (Geometry::build(&world), moved(map, k));
            for _ in 0..tries_in(12) {
                let ray = random_ray(&mut random, &world, 1.0);
                let there = Ray { origin: map(ray.origin) * k, direction: map(ray.direction) };
                let expected = plain.nearest(&ray).map(|hit| (hit.object, hit.leaving, hit.t));
                let found = other.nearest(&there).map(|hit| (hit.object, hit.leaving, hit.t / k));
                assert_eq!(found, expected, "2^{exponent}: {ray:?}");
            }
        }
    }
}

#[test]
fn balls_around_a_few_change_nothing() {
    let mut random = Random(77);
    for world in 0..400 {
        let reach = random.size(-90.0, 90.0);
        let world = random_world(&mut random, world % (TREE_FROM + 2), reach);
        assert_tree_agrees(&world, &mut random, reach, tries_in(400));
    }
}

#[test]
fn a_ray_so_far_off_that_squares_overflow_meets_nothing_that_is_absent() {
    let mut world = empty();
    add_sphere(&mut world, Vector::ZERO, 1.0);
    let geometry = Geometry::build(&world);
    for far in [1e150, 1e160, 1e300] {
        let ray = Ray { origin: Vector::Z * far, direction: -Vector::Z };
        assert!(geometry.nearest(&ray).is_none_or(|hit| hit.object == 0));
    }
}
