use super::*;
use crate::color::{Color, Rgb};
use crate::math::placement::Placement;
use crate::math::random::{Random, long};
use crate::math::{Matrix, UnitVector, Vector};
use crate::world::{Finish, Material, Object, Pigment};

fn empty() -> World {
    let material = |seed| Material {
        pigment: Pigment::Color(Color::default()),
        finish: Finish {
            glow: Rgb::default(),
            diffuse: 0.6,
            brilliance: 1.0,
            lobes: Vec::new(),
            reflection: None,
            seed,
        },
    };
    World { materials: vec![material(false), material(true)], ..World::default() }
}

fn add(world: &mut World, shape: Shape) {
    let object = Object {
        shape,
        material: 0,
        texture_from_world: None,
        faces: None,
        casts_shadow: true,
        inverse: false,
    };
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
        object.material = random.below(2) as u32;
        object.inverse = random.below(3) == 0;
        object.casts_shadow = random.below(4) != 0;
    }
    world
}

/// The same entries, tried one after the other.
fn without_tree(geometry: &Geometry) -> Geometry {
    Geometry { tree: None, ..geometry.clone() }
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
        assert_tree_agrees(&world, &mut random, reach, 500 * long());
    }
}
