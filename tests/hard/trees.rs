//! Nearest hits and obstructions in a World.

use lucarne::color::{Color, Rgb};
use lucarne::geometry::Geometry;
use lucarne::math::Vector;
use lucarne::shape::{Chord, Ray, Shape, Sphere};
use lucarne::world::{Finish, Material, Object, Pigment, World};

/// A World of spheres.
fn of_spheres(spheres: Vec<Sphere>) -> World {
    let finish = Finish {
        glow: Rgb::BLACK,
        diffuse: 0.6,
        brilliance: 1.0,
        lobes: Vec::new(),
        reflection: None,
        seed: false,
    };
    let object = |i| Object {
        shape: Shape::Sphere(i),
        material: 0,
        texture_from_world: None,
        faces: None,
        casts_shadow: true,
        inverse: false,
    };
    World {
        objects: (0..spheres.len() as u32).map(object).collect(),
        spheres,
        materials: vec![Material { pigment: Pigment::Color(Color::WHITE), finish }],
        ..World::default()
    }
}

/// The nearest hit, and whether something is in the way, are what the sphere's own `chord` says,
/// alone and among others far behind.
pub fn assert_all_agree(sphere: &Sphere, ray: &Ray, chord: Option<&Chord>) {
    let first = chord.and_then(|chord| {
        [chord.enter, chord.leave].into_iter().find(|crossing| crossing.is_ahead())
    });
    let behind = ray.origin - ray.direction * (1e3 * sphere.radius);
    let others = (0..9).map(|i| Sphere {
        centre: behind + Vector::X * (sphere.radius * 3.0 * f64::from(i)),
        radius: sphere.radius,
    });
    for spheres in [vec![*sphere], std::iter::once(*sphere).chain(others).collect()] {
        let geometry = Geometry::build(&of_spheres(spheres));
        let hit = geometry.nearest(ray).map(|hit| hit.crossing);
        assert_eq!(hit, first, "{sphere:?} {ray:?}");
        assert_eq!(geometry.occluded(ray, f64::INFINITY), first.is_some(), "{sphere:?} {ray:?}");
    }
}
