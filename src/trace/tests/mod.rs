//! Small worlds to trace, built by hand.

mod batch;
mod film;
mod fog;
mod glass;
mod layered;
mod light;
mod projection;
mod single;
mod work;

use super::camera::Lens;
use super::*;
use crate::color::{Color, Rgb};
use crate::math::placement::Map;
use crate::math::{Matrix, UnitVector, Vector};
use crate::pattern::{Checker, Gradient, Kind, Setting, Wave};
use crate::plan::{Antialias, Effect, PlanOptions, plan};
use crate::shape::{Box_, Plane, Shape, Sphere};
use crate::texture::space::Start;
use crate::texture::{Blend, Pattern, Source, Space, Step};
use crate::world::{
    CameraKind, FaceCoordinates, Finish, Light, LightKind, Lobe, LobeKind, Object, Origins,
    Pigment, Plain, Reflection, Settings, Sky, Texture,
};

const NO_FINISH: Finish = Finish {
    conserve_energy: false,
    emission: Rgb::BLACK,
    diffuse: 0.0,
    brilliance: 1.0,
    lobes: Vec::new(),
    reflection: None,
    seed: false,
    extras: None,
};

fn plain(color: Color, finish: Finish) -> Plain {
    Plain { pigment: Pigment::Color(color), normal: None, finish }
}

fn glowing(emission: f64) -> Plain {
    let finish = Finish { emission: Rgb::gray(emission), ..NO_FINISH };
    plain(Color::WHITE, finish)
}

fn mirror(albedo: f64, emission: f64) -> Plain {
    let all = Rgb::gray(albedo);
    let reflection = Reflection {
        fresnel: false,
        minimum: all,
        maximum: all,
        falloff: 1.0,
        exponent: 1.0,
        metallic: 0.0,
    };
    let finish =
        Finish { emission: Rgb::gray(emission), reflection: Some(reflection), ..NO_FINISH };
    plain(Color::WHITE, finish)
}

fn matte(red: f64, green: f64, blue: f64) -> Plain {
    let finish = Finish { emission: Rgb::gray(0.1), diffuse: 0.6, ..NO_FINISH };
    plain(Color::opaque(Rgb::new(red, green, blue)), finish)
}

fn seed(rgb: Rgb, kd: f64, ks: f64, exponent: f64, ambient: f64) -> Plain {
    let mut texture = mirror(ks, kd * ambient);
    let lobe = Lobe { kind: LobeKind::Blinn, weight: ks, exponent, metallic: 1.0 };
    texture.pigment = Pigment::Color(Color::opaque(rgb));
    texture.finish = Finish { diffuse: kd, lobes: vec![lobe], seed: true, ..texture.finish };
    texture
}

/// Colours over a pattern. `steps` lead from the texture's space to the pattern's.
fn ramp(kind: Kind, steps: Vec<Step>, entries: Vec<(f64, Color)>) -> Pigment {
    let wave = Wave::new(kind.wave(), kind.frequency(), 0.0);
    let pattern = Pattern { source: Source::Kind(kind), setting: Setting::default(), wave };
    let space = Space { start: Start::Slot(0), steps };
    Pigment::Ramp(Box::new(Blend { space, pattern, entries }))
}

fn gradient(direction: Vector) -> Kind {
    Kind::Gradient(Gradient { direction })
}

fn black_to_white() -> Vec<(f64, Color)> {
    vec![(0.0, Color::BLACK), (1.0, Color::WHITE)]
}

/// The finishes of a World's textures.
fn finishes(world: &mut World) -> impl Iterator<Item = &mut Finish> {
    world.textures.iter_mut().map(|texture| match texture {
        Texture::Plain(plain) => &mut plain.finish,
        _ => unreachable!("these are plain"),
    })
}

/// A World under construction.
#[derive(Default)]
struct Built(World);

impl Built {
    fn object(mut self, shape: Shape, texture: Plain) -> Self {
        let index = self.0.textures.len() as u32;
        self.0.objects.push(Object { texture: index, ..Object::plain(shape) });
        self.0.textures.push(Texture::Plain(texture));
        self
    }

    fn sphere(mut self, centre: [f64; 3], radius: f64, texture: Plain) -> Self {
        self.0.spheres.push(Sphere { centre: Vector::from_array(centre), radius });
        let shape = Shape::Sphere(self.0.spheres.len() as u32 - 1);
        self.object(shape, texture)
    }

    fn plane(mut self, normal: UnitVector, distance: f64, texture: Plain) -> Self {
        self.0.planes.push(Plane { normal, distance });
        let shape = Shape::Plane(self.0.planes.len() as u32 - 1);
        self.object(shape, texture)
    }

    fn cube(mut self, centre: [f64; 3], half_width: f64, texture: Plain) -> Self {
        self.0.boxes.push(Box_ {
            centre: Vector::from_array(centre),
            normals: [UnitVector::X, UnitVector::Y, UnitVector::Z],
            half_widths: [half_width; 3],
        });
        let shape = Shape::Box(self.0.boxes.len() as u32 - 1);
        self.object(shape, texture)
    }

    fn light(mut self, position: [f64; 3], intensity: f64) -> Self {
        let kind = LightKind::Point { position: Vector::from_array(position) };
        self.0.lights.push(Light {
            kind,
            color: Rgb::gray(intensity),
            casts_shadows: true,
            attenuation: None,
            area: None,
            through: None,
        });
        self
    }

    fn world(mut self, change: impl FnOnce(&mut World)) -> World {
        change(&mut self.0);
        self.0
    }
}

/// Two mirrors that face each other across the camera, which looks straight at one.
fn corridor(texture: &Plain) -> Built {
    Built::default().plane(UnitVector::Z, -3.0, texture.clone()).plane(
        -UnitVector::Z,
        -3.0,
        texture.clone(),
    )
}

/// A bit of everything.
fn varied() -> World {
    let mut ground = matte(1.0, 1.0, 1.0);
    let squares = vec![(0.0, Color::WHITE), (1.0, Color::opaque(Rgb::new(0.2, 0.3, 0.4)))];
    ground.pigment = ramp(Kind::Checker(Checker {}), vec![], squares);
    let mut shiny = matte(1.0, 0.5, 0.2);
    let lobe = Lobe { kind: LobeKind::Phong, weight: 0.7, exponent: 30.0, metallic: 0.5 };
    shiny.finish.lobes.push(lobe);
    Built::default()
        .plane(UnitVector::Y, -1.0, ground)
        .sphere([-1.1, 0.0, -5.0], 1.0, mirror(0.7, 0.05))
        .sphere([1.1, 0.2, -4.0], 0.8, shiny)
        .cube([0.2, -0.5, -3.0], 0.3, seed(Rgb::new(0.2, 0.9, 0.4), 0.7, 0.3, 20.0, 0.2))
        .light([3.0, 5.0, 0.0], 0.8)
        .light([-4.0, 2.0, -1.0], 0.5)
        .world(|world| world.background = Rgb::new(0.3, 0.5, 0.9))
}

fn options(width: u32, height: u32, antialias: Antialias) -> PlanOptions {
    PlanOptions { antialias, ..PlanOptions::new(Frame::whole(width, height)) }
}

fn traced_by(world: &World, plan: &Plan) -> Traced {
    trace(world, plan, &TraceOptions::on_threads(1), &Unwatched)
}

fn traced(world: &World, width: u32, height: u32, antialias: Antialias) -> Traced {
    let options = options(width, height, antialias);
    traced_by(world, &plan(world, &Origins::default(), &options))
}

/// What the camera's central ray sees, before a film rounds it.
fn centre(world: &World) -> Rgb {
    let plan = plan(world, &Origins::default(), &options(1, 1, Antialias::Off));
    let first = Sampling::Numbered { first: 0, end: 1, sum: Sight::NOTHING };
    let (geometry, threads) = (Geometry::build(world), TraceOptions::on_threads(1));
    let (seen, _) = pixels(world, &geometry, &plan, &[((0, 0), first)], &threads, &Unwatched);
    seen[0].expect("not stopped").mean.radiance
}
