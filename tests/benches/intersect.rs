//! How fast rays meet the World: single shapes, nearest hits, obstructions,
//! building the tree.
//!
//! `cargo bench --bench intersect`. The two scenes are those of the speed promise: three spheres, a
//! box and a plane, and 100,000 spheres.

use divan::counter::ItemsCount;
use lucarne::color::{Color, Rgb};
use lucarne::geometry::{Geometry, surface};
use lucarne::math::placement::Placement;
use lucarne::math::{Matrix, UnitVector, Vector};
use lucarne::shape::{Box_, Chord, Ellipsoid, Plane, Ray, Shape, Sphere};
use lucarne::world::{Finish, Object, Pigment, Plain, Texture, World};

fn main() {
    divan::main();
}

const WIDTH: u32 = 1920;
const HEIGHT: u32 = 1080;
const LIGHTS: [Vector; 2] = [Vector::new(50.0, 80.0, 60.0), Vector::new(-60.0, 50.0, 30.0)];

fn empty() -> World {
    let finish = Finish {
        conserve_energy: false,
        emission: Rgb::default(),
        diffuse: 0.6,
        brilliance: 1.0,
        lobes: Vec::new(),
        reflection: None,
        seed: false,
        extras: None,
    };
    let pigment = Pigment::Color(Color::default());
    let texture = Texture::Plain(Plain { pigment, normal: None, finish });
    World { textures: vec![texture], ..World::default() }
}

fn object(shape: Shape) -> Object {
    Object::plain(shape)
}

fn add_sphere(world: &mut World, centre: Vector, radius: f64) {
    world.spheres.push(Sphere { centre, radius });
    world.objects.push(object(Shape::Sphere(world.spheres.len() as u32 - 1)));
}

fn few() -> (World, Vector) {
    let mut world = empty();
    world.planes.push(Plane { normal: UnitVector::Y, distance: 0.0 });
    world.objects.push(object(Shape::Plane(0)));
    add_sphere(&mut world, Vector::new(0.0, 1.0, 0.0), 1.0);
    add_sphere(&mut world, Vector::new(-2.0, 0.6, 0.8), 0.6);
    add_sphere(&mut world, Vector::new(1.6, 0.5, 1.6), 0.5);
    let (c, s) = (3f64.sqrt() / 2.0, 0.5);
    world.boxes.push(Box_ {
        centre: Vector::new(2.4, 0.5, -0.6),
        normals: [
            UnitVector::from_unit(Vector::new(c, 0.0, -s)),
            UnitVector::Y,
            UnitVector::from_unit(Vector::new(s, 0.0, c)),
        ],
        half_widths: [0.5; 3],
    });
    world.objects.push(object(Shape::Box(0)));
    (world, Vector::new(0.0, 1.2, 6.0))
}

fn spheres(count: usize) -> (World, Vector) {
    let mut world = empty();
    let mut state = 7u64;
    let mut number = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    for _ in 0..count {
        let centre = Vector::new(number(), number(), number()) * 20.0 - Vector::splat(10.0);
        add_sphere(&mut world, centre, 0.03 + 0.09 * number());
    }
    (world, Vector::new(0.0, 0.0, 30.0))
}

/// What a picture asks for, in the order a tracer would ask: camera rays, from each hit a ray to
/// each light and a mirrored ray.
struct Questions {
    nearest: Vec<Ray>,
    occluded: Vec<(Ray, f64)>,
}

fn questions(world: &World, eye: Vector, depth: usize) -> Questions {
    let geometry = Geometry::build(world);
    let mut asked = Questions { nearest: Vec::new(), occluded: Vec::new() };
    let towards = |v: Vector| UnitVector::from_direction(v).map_or(Vector::Z, UnitVector::get);
    for y in 0..HEIGHT {
        for x in 0..WIDTH {
            let u = (f64::from(2 * x + 1) - f64::from(WIDTH)) / f64::from(HEIGHT);
            let v = (f64::from(HEIGHT) - f64::from(2 * y + 1)) / f64::from(HEIGHT);
            let mut ray =
                Ray { origin: eye, direction: towards(Vector::new(0.414 * u, 0.414 * v, -1.0)) };
            for _ in 0..depth {
                asked.nearest.push(ray);
                let Some(hit) = geometry.nearest(&ray) else { break };
                let point = surface(world, &ray, &hit);
                for light in LIGHTS {
                    let to_light = light - point.point;
                    let direction = towards(to_light);
                    if direction.dot(point.normal) > 0.0 {
                        let origin = point.spawn(direction);
                        asked.occluded.push((Ray { origin, direction }, to_light.length()));
                    }
                }
                let mirrored =
                    ray.direction - point.normal * (2.0 * ray.direction.dot(point.normal));
                ray = Ray { origin: point.spawn(mirrored), direction: mirrored };
            }
        }
    }
    asked
}

/// A World, the camera's place, and how many surfaces deep its rays go.
fn scene(name: &str) -> (World, Vector, usize) {
    let ((world, eye), depth) = match name {
        "3 spheres, box, plane" => (few(), 5),
        count => (spheres(count.parse().expect("a number of spheres")), 1),
    };
    (world, eye, depth)
}

#[divan::bench(sample_count = 10, args = ["3 spheres, box, plane", "6", "8", "12", "16", "100000"])]
fn nearest(bencher: divan::Bencher, name: &str) {
    let (world, eye, depth) = scene(name);
    let geometry = Geometry::build(&world);
    let Questions { nearest, .. } = questions(&world, eye, depth);
    bencher
        .counter(ItemsCount::new(nearest.len()))
        .bench(|| nearest.iter().filter(|ray| geometry.nearest(ray).is_some()).count());
}

#[divan::bench(sample_count = 10, args = ["3 spheres, box, plane", "6", "8", "12", "16", "100000"])]
fn occluded(bencher: divan::Bencher, name: &str) {
    let (world, eye, depth) = scene(name);
    let geometry = Geometry::build(&world);
    let Questions { occluded, .. } = questions(&world, eye, depth);
    bencher.counter(ItemsCount::new(occluded.len())).bench(|| {
        occluded.iter().filter(|(ray, distance)| geometry.occluded(ray, *distance)).count()
    });
}

/// Rays from all around at something of about size 1, ten sizes off; half of them miss.
fn aimed() -> Vec<Ray> {
    let mut state = 11u64;
    let mut number = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    };
    let mut vector = || Vector::new(number(), number(), number());
    let ray = |_| {
        let origin = UnitVector::from_direction(vector()).map_or(Vector::Z, UnitVector::get) * 10.0;
        let towards = UnitVector::from_direction(vector() * 1.6 - origin);
        Ray { origin, direction: towards.map_or(Vector::Z, UnitVector::get) }
    };
    (0..10_000).map(ray).collect()
}

#[divan::bench(args = ["sphere", "plane", "box", "ellipsoid"])]
fn chord(bencher: divan::Bencher, shape: &str) {
    let rays = aimed();
    let normal = UnitVector::from_direction(Vector::new(0.3, 0.9, -0.2)).expect("not zero");
    let sphere = Sphere { centre: Vector::ZERO, radius: 1.0 };
    let plane = Plane { normal, distance: 0.3 };
    let normals = [UnitVector::X, UnitVector::Y, UnitVector::Z];
    let box_ = Box_ { centre: Vector::ZERO, normals, half_widths: [0.8; 3] };
    let world_from_local = Matrix::from_diagonal(Vector::new(1.0, 0.7, 1.2));
    let local_from_world = world_from_local.inverse();
    let placement = Placement { centre: Vector::ZERO, world_from_local, local_from_world };
    let ellipsoid = Ellipsoid { placement };
    let bencher = bencher.counter(ItemsCount::new(rays.len()));
    let error = |chord: Option<Chord>| chord.map_or(0.0, |c| c.enter.t + c.enter.error);
    match shape {
        "sphere" => bencher.bench(|| rays.iter().map(|ray| error(sphere.chord(ray))).sum::<f64>()),
        "plane" => bencher.bench(|| rays.iter().map(|ray| error(plane.chord(ray))).sum::<f64>()),
        "box" => bencher.bench(|| rays.iter().map(|ray| error(box_.chord(ray))).sum::<f64>()),
        _ => bencher.bench(|| rays.iter().map(|ray| error(ellipsoid.chord(ray))).sum::<f64>()),
    }
}

#[divan::bench(sample_count = 20, args = [1000, 100_000])]
fn build(bencher: divan::Bencher, count: usize) {
    let (world, _) = spheres(count);
    bencher.counter(ItemsCount::new(count)).bench(|| Geometry::build(&world));
}
