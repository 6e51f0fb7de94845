use std::sync::atomic::{AtomicUsize, Ordering};

use super::*;
use crate::color::Color;
use crate::math::placement::Map;
use crate::math::{UnitVector, Vector};
use crate::pattern::Pattern;
use crate::plan::{Called, PlanOptions, plan};
use crate::shape::{Box_, Plane, Shape, Sphere};
use crate::world::{
    Camera, CameraKind, FaceCoordinates, Finish, Light, LightKind, Lobe, LobeKind, Material,
    Object, Origins, Pigment, Reflection, Settings, Sky,
};

const NO_FINISH: Finish = Finish {
    glow: Rgb::BLACK,
    diffuse: 0.0,
    brilliance: 1.0,
    lobes: Vec::new(),
    reflection: None,
    seed: false,
};

fn glowing(glow: f64) -> Material {
    let finish = Finish { glow: Rgb::gray(glow), ..NO_FINISH };
    Material { pigment: Pigment::Color(Color::WHITE), finish }
}

fn mirror(albedo: f64, glow: f64) -> Material {
    let all = Rgb::gray(albedo);
    let reflection =
        Reflection { minimum: all, maximum: all, falloff: 1.0, exponent: 1.0, metallic: 0.0 };
    let finish = Finish { glow: Rgb::gray(glow), reflection: Some(reflection), ..NO_FINISH };
    Material { pigment: Pigment::Color(Color::WHITE), finish }
}

fn matte(red: f64, green: f64, blue: f64) -> Material {
    let finish = Finish { glow: Rgb::gray(0.1), diffuse: 0.6, ..NO_FINISH };
    Material { pigment: Pigment::Color(Color::opaque(Rgb::new(red, green, blue))), finish }
}

fn seed(rgb: Rgb, kd: f64, ks: f64, exponent: f64, ambient: f64) -> Material {
    let mut material = mirror(ks, kd * ambient);
    let lobe = Lobe { kind: LobeKind::Blinn, weight: ks, exponent, metallic: 1.0 };
    material.pigment = Pigment::Color(Color::opaque(rgb));
    material.finish = Finish { diffuse: kd, lobes: vec![lobe], seed: true, ..material.finish };
    material
}

/// A World under construction.
#[derive(Default)]
struct Built(World);

impl Built {
    fn object(mut self, shape: Shape, material: Material) -> Self {
        self.0.objects.push(Object {
            shape,
            material: self.0.materials.len() as u32,
            texture_from_world: None,
            faces: None,
            casts_shadow: true,
            inverse: false,
        });
        self.0.materials.push(material);
        self
    }

    fn sphere(mut self, centre: [f64; 3], radius: f64, material: Material) -> Self {
        self.0.spheres.push(Sphere { centre: Vector::from_array(centre), radius });
        let shape = Shape::Sphere(self.0.spheres.len() as u32 - 1);
        self.object(shape, material)
    }

    fn plane(mut self, normal: UnitVector, distance: f64, material: Material) -> Self {
        self.0.planes.push(Plane { normal, distance });
        let shape = Shape::Plane(self.0.planes.len() as u32 - 1);
        self.object(shape, material)
    }

    fn cube(mut self, centre: [f64; 3], half_width: f64, material: Material) -> Self {
        self.0.boxes.push(Box_ {
            centre: Vector::from_array(centre),
            normals: [UnitVector::X, UnitVector::Y, UnitVector::Z],
            half_widths: [half_width; 3],
        });
        let shape = Shape::Box(self.0.boxes.len() as u32 - 1);
        self.object(shape, material)
    }

    fn light(mut self, position: [f64; 3], intensity: f64) -> Self {
        let kind = LightKind::Point { position: Vector::from_array(position) };
        self.0.lights.push(Light { kind, color: Rgb::gray(intensity), casts_shadows: true });
        self
    }

    fn world(mut self, change: impl FnOnce(&mut World)) -> World {
        change(&mut self.0);
        self.0
    }
}

/// Two mirrors that face each other across the camera, which looks straight at one.
fn corridor(material: &Material) -> Built {
    Built::default().plane(UnitVector::Z, -3.0, material.clone()).plane(
        -UnitVector::Z,
        -3.0,
        material.clone(),
    )
}

/// A bit of everything.
fn varied() -> World {
    let mut ground = matte(1.0, 1.0, 1.0);
    ground.pigment = Pigment::Patterned {
        pattern: Pattern::Checker,
        pattern_from_texture: Map::IDENTITY,
        map: vec![(0.0, Color::WHITE), (1.0, Color::opaque(Rgb::new(0.2, 0.3, 0.4)))],
    };
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
    PlanOptions { frame: Frame::whole(width, height), antialias, depth: None }
}

fn traced_by(world: &World, plan: &Plan) -> Traced {
    trace(world, plan, &TraceOptions { threads: Some(1) }, &Unwatched)
}

fn traced(world: &World, width: u32, height: u32, antialias: Antialias) -> Traced {
    let options = options(width, height, antialias);
    traced_by(world, &plan(world, &Origins::default(), &options))
}

/// What the camera's central ray sees.
fn centre(world: &World) -> Rgb {
    traced(world, 1, 1, Antialias::Off).film.radiance[0]
}

#[test]
fn a_perfect_mirror_before_a_white_background_is_exactly_white_200_mirrors_deep() {
    // The camera looks into an open corner of two perfect mirrors, and into a bowl of spheres.
    let world = Built::default()
        .plane(UnitVector::Z, -3.0, mirror(1.0, 0.0))
        .plane(-UnitVector::X, -2.0, mirror(1.0, 0.0))
        .sphere([0.4, 0.3, -2.0], 0.5, mirror(1.0, 0.0))
        .sphere([-0.7, -0.2, -1.8], 0.5, mirror(1.0, 0.0))
        .world(|world| {
            world.background = Rgb::WHITE;
            world.settings.max_trace_level = 200;
        });
    let result = traced(&world, 40, 30, Antialias::Off);
    assert!(result.counters.reflection > 1200, "{:?}", result.counters);
    assert!(result.film.radiance.iter().all(|&radiance| radiance == Rgb::WHITE));
}

#[test]
fn max_trace_level_counts_the_cameras_ray_and_black_lies_beyond() {
    for levels in [0, 1, 2, 5, 200] {
        let surfaces = u32::max(levels, 1);
        let world = corridor(&mirror(1.0, 1.0)).world(|world| {
            world.settings.max_trace_level = levels;
            world.background = Rgb::gray(1e9);
        });
        let result = traced(&world, 1, 1, Antialias::Off);
        assert_eq!(result.film.radiance[0], Rgb::gray(f64::from(surfaces)));
        assert_eq!(result.counters.reflection, u64::from(surfaces) - 1);
    }
}

#[test]
fn a_hundred_thousand_mirrors_deep_overflow_no_stack() {
    let world = corridor(&mirror(1.0, 1.0)).world(|world| world.settings.max_trace_level = 100_000);
    let tiny = std::thread::Builder::new().stack_size(256 * 1024);
    let seen = tiny.spawn(move || centre(&world)).expect("a thread").join().expect("no overflow");
    assert_eq!(seen, Rgb::gray(100_000.0));
}

#[test]
fn adc_bailout_cuts_where_the_weight_falls_below_it() {
    // What POV-Ray shows for mirrors of one half: a weight equal to the bound is followed.
    for (adc_bailout, surfaces) in [(0.5, 2), (0.2501, 2), (0.25, 3), (0.1, 4), (0.03, 6)] {
        let world = corridor(&mirror(0.5, 0.1)).world(|world| {
            world.settings = Settings { adc_bailout, max_trace_level: 50, ..world.settings };
        });
        let expected: f64 = (0..surfaces).map(|k| 0.1 * 0.5f64.powi(k)).sum();
        assert!((centre(&world).red - expected).abs() < 1e-12, "{adc_bailout}");
    }
}

#[test]
fn a_seed_path_is_never_cut_by_its_weight() {
    let world = corridor(&seed(Rgb::WHITE, 0.5, 0.001, 9.0, 1.0)).world(|world| {
        world.settings.adc_bailout = 0.5;
    });
    assert_eq!(traced(&world, 1, 1, Antialias::Off).counters.reflection, 4);
}

#[test]
fn a_seed_radiance_is_clamped_at_every_level() {
    // Each mirror glows 0.8 and reflects one half of what the next shows: unclamped, the sum goes
    // to 1.6; clamped at every level it is 1 only where 0.8 + 0.5·1 is clamped once more.
    let mut dim = seed(Rgb::new(1.0, 0.25, 0.0), 1.0, 0.5, 9.0, 0.8);
    let world = corridor(&dim).world(|_| ());
    let seen = centre(&world);
    assert_eq!(seen.red, 1.0);
    // 0.2·(1 + ½ + ¼ + ⅛ + 1/16), unclamped.
    assert!((seen.green - 0.2 * 1.9375).abs() < 1e-15);
    assert_eq!(seen.blue, 0.0);
    dim.finish.seed = false;
    assert!(centre(&corridor(&dim).world(|_| ())).red > 1.5);
}

#[test]
fn a_seed_surface_follows_the_seeds_formula() {
    let rgb = Rgb::new(0.9, 0.5, 0.1);
    let (kd, ks, n, ambient) = (0.6, 0.4, 12.0, 0.3);
    let world = Built::default()
        .sphere([0.0, 0.0, -4.0], 1.0, seed(rgb, kd, ks, n, ambient))
        .light([2.0, 2.0, 1.0], 0.7)
        .light([-3.0, 0.5, 2.0], 0.2)
        .world(|world| world.background = Rgb::new(0.1, 0.2, 0.3));
    let (normal, view) = (Vector::Z, Vector::Z);
    let mut expected = rgb * (kd * ambient) + world.background * ks;
    for (position, intensity) in [([2.0, 2.0, 1.0], 0.7), ([-3.0, 0.5, 2.0], 0.2)] {
        let light = (Vector::from_array(position) - Vector::new(0.0, 0.0, -3.0)).normalize();
        let bisector = (light + view).normalize();
        expected += rgb * (kd * normal.dot(light) * intensity);
        expected += rgb * (ks * normal.dot(bisector).powf(n) * intensity);
    }
    let seen = centre(&world);
    for (seen, expected) in seen.components().into_iter().zip(expected.components()) {
        assert!((seen - expected).abs() < 1e-12, "{seen} {expected}");
    }
}

#[test]
fn a_light_behind_the_surface_or_on_it_or_behind_something_gives_nothing() {
    let wall = || Built::default().plane(UnitVector::Z, -3.0, matte(1.0, 1.0, 1.0));
    let glow = 0.1;
    assert_eq!(centre(&wall().light([0.0, 0.0, -5.0], 1.0).world(|_| ())).red, glow);
    assert_eq!(centre(&wall().light([0.0, 0.0, -3.0], 1.0).world(|_| ())).red, glow);
    let lit = wall().light([0.0, 2.0, 0.0], 1.0);
    assert!(centre(&lit.world(|_| ())).red > 0.5);
    let covered = || wall().light([0.0, 2.0, 0.0], 1.0).sphere([0.0, 1.0, -1.5], 0.5, glowing(0.0));
    assert_eq!(centre(&covered().world(|_| ())).red, glow);
    let transparent = covered().world(|world| world.objects[1].casts_shadow = false);
    assert!(centre(&transparent).red > 0.5);
    let shadowless = covered().world(|world| world.lights[0].casts_shadows = false);
    assert!(centre(&shadowless).red > 0.5);
}

#[test]
fn a_shadowless_light_makes_no_highlight_on_a_classic_finish() {
    let mut shiny = glowing(0.0);
    shiny.finish.lobes =
        vec![Lobe { kind: LobeKind::Phong, weight: 1.0, exponent: 1.0, metallic: 0.0 }];
    let wall = Built::default().plane(UnitVector::Z, -3.0, shiny).light([0.0, 0.0, 1.0], 1.0);
    let mut world = wall.world(|_| ());
    assert_eq!(centre(&world), Rgb::WHITE);
    world.lights[0].casts_shadows = false;
    assert_eq!(centre(&world), Rgb::BLACK);
}

#[test]
fn a_surface_is_lit_on_the_side_it_is_seen_from() {
    // From inside a classic sphere, by a light inside.
    let room = || Built::default().sphere([0.0; 3], 5.0, matte(1.0, 1.0, 1.0));
    assert!(centre(&room().light([0.0, 1.0, 0.0], 1.0).world(|_| ())).red > 0.5);
    assert_eq!(centre(&room().light([0.0, 0.0, -9.0], 1.0).world(|_| ())).red, 0.1);
    // A seed sphere is not there from inside.
    let seed = Built::default().sphere([0.0; 3], 5.0, seed(Rgb::WHITE, 0.5, 0.5, 9.0, 1.0));
    assert_eq!(centre(&seed.world(|world| world.background = Rgb::gray(7.0))).red, 7.0);
}

#[test]
fn a_parallel_light_throws_shadows_from_its_plane_only() {
    let with_ball_at = |z: f64| {
        let kind = LightKind::Parallel { position: Vector::ZERO, to_light: UnitVector::Z };
        let light = Light { kind, color: Rgb::WHITE, casts_shadows: true };
        let wall = Built::default().plane(UnitVector::Z, -3.0, matte(1.0, 1.0, 1.0)).sphere(
            [1.5, 0.0, z],
            0.5,
            glowing(0.0),
        );
        centre(&wall.world(|world| {
            world.lights.push(light);
            // Seen slantwise, so that the ball does not hide the wall.
            world.camera.location = Vector::new(-1.5, 0.0, 0.0);
            world.camera.forward = Vector::new(1.0, 0.0, -1.0);
        }))
    };
    assert_eq!(with_ball_at(-1.0).red, 0.1);
    assert_eq!(with_ball_at(2.0).red, 0.7);
}

#[test]
fn a_flat_face_takes_its_constant_texture_coordinate_from_the_world() {
    let mut checkered = glowing(1.0);
    checkered.pigment = Pigment::Patterned {
        pattern: Pattern::Gradient { direction: Vector::Z },
        pattern_from_texture: Map { centre: Vector::Z * 0.5, ..Map::IDENTITY },
        map: vec![(0.0, Color::BLACK), (1.0, Color::WHITE)],
    };
    let world = Built::default().plane(UnitVector::Z, -3.0, checkered).world(|world| {
        world.objects[0].faces = Some(1);
        world.faces = vec![FaceCoordinates::default(), FaceCoordinates([None, None, Some(0.75)])];
    });
    assert_eq!(centre(&world), Rgb::gray(0.25));
}

#[test]
fn the_film_has_the_same_bits_for_any_number_of_threads() {
    let world = varied();
    let options = options(70, 50, Antialias::default());
    let plan = plan(&world, &Origins::default(), &options);
    let alone = traced_by(&world, &plan);
    assert!(alone.film.samples.contains(&1) && alone.film.samples.contains(&16));
    for threads in [2, 3, 7] {
        let shared = trace(&world, &plan, &TraceOptions { threads: Some(threads) }, &Unwatched);
        assert_eq!(shared, alone);
    }
}

#[test]
fn a_region_is_an_exact_crop_of_the_whole() {
    let world = varied();
    let mut options = options(70, 50, Antialias::default());
    let whole = traced_by(&world, &plan(&world, &Origins::default(), &options)).film;
    for (x, y, width, height) in [(0, 0, 33, 50), (20, 10, 35, 33), (69, 49, 1, 1), (31, 0, 2, 9)] {
        let region = Region { x, y, width, height };
        options.frame.region = region;
        let part = traced_by(&world, &plan(&world, &Origins::default(), &options)).film;
        assert_eq!(part, whole.crop(region));
    }
}

#[test]
fn a_mirrored_world_makes_a_mirrored_film() {
    let world = varied();
    let mut mirrored = world.clone();
    mirrored.spheres.iter_mut().for_each(|s| s.centre.x = -s.centre.x);
    mirrored.boxes.iter_mut().for_each(|b| b.centre.x = -b.centre.x);
    for light in &mut mirrored.lights {
        if let LightKind::Point { position } = &mut light.kind {
            position.x = -position.x;
        }
    }
    // A checker is not mirrored by a mirrored point on the lattice; a colour is.
    let plain = |mut world: World| {
        world.materials[0] = matte(0.4, 0.5, 0.6);
        traced(&world, 61, 40, Antialias::Off).film.radiance
    };
    let (left, mut right) = (plain(world), plain(mirrored));
    right.chunks_mut(61).for_each(|row| row.reverse());
    assert_eq!(left, right);
}

#[test]
fn the_pruned_kernel_and_the_full_one_give_the_same_bits() {
    let full_plan = |plan: &Plan| {
        let by_hand = |effect| Called { effect, by: Vec::new(), cost: String::new() };
        let effects = Effect::ALL.map(by_hand).to_vec();
        Plan { effects, ..plan.clone() }
    };
    use Effect::{Diffuse, Highlights, Reflection, Shadows};
    let without_reflection =
        |w: &mut World| w.materials.iter_mut().for_each(|m| m.finish.reflection = None);
    type Change<'a> = &'a dyn Fn(&mut World);
    let changes: [(&[Effect], Change); 5] = [
        (&[Shadows], &|w| w.lights.iter_mut().for_each(|light| light.casts_shadows = false)),
        (&[Reflection], &without_reflection),
        (&[Reflection], &|w| w.settings.max_trace_level = 1),
        (&[Diffuse, Highlights, Shadows], &|w| w.lights.clear()),
        (&[Diffuse, Highlights, Shadows, Reflection], &|w| {
            w.lights.iter_mut().for_each(|light| light.color = Rgb::BLACK);
            without_reflection(w);
        }),
    ];
    for (pruned_effects, change) in changes {
        let mut world = varied();
        change(&mut world);
        let pruned = plan(&world, &Origins::default(), &options(40, 30, Antialias::default()));
        let called = [Diffuse, Highlights, Shadows, Reflection];
        let missing: Vec<_> = called.into_iter().filter(|&e| !pruned.simulates(e)).collect();
        assert_eq!(missing, pruned_effects);
        let film = traced_by(&world, &pruned).film;
        assert_eq!(film, traced_by(&world, &full_plan(&pruned)).film);
    }
}

#[test]
fn what_nothing_calls_for_is_counted_zero() {
    let rays = |change: &dyn Fn(&mut World)| {
        let mut world = varied();
        change(&mut world);
        traced(&world, 40, 30, Antialias::Off).counters
    };
    let all = rays(&|_| ());
    assert!(all.camera == 1200 && all.shadow > 0 && all.reflection > 0);
    assert_eq!(rays(&|w| w.lights.clear()).shadow, 0);
    assert_eq!(rays(&|w| w.lights.iter_mut().for_each(|l| l.casts_shadows = false)).shadow, 0);
    assert_eq!(rays(&|w| w.objects.iter_mut().for_each(|o| o.casts_shadow = false)).shadow, 0);
    assert_eq!(rays(&|w| w.lights.iter_mut().for_each(|l| l.color = Rgb::BLACK)).shadow, 0);
    let unanswering = |w: &mut World| {
        w.materials.iter_mut().for_each(|m| m.finish = Finish { ..NO_FINISH });
    };
    assert_eq!(rays(&unanswering), Counters { camera: 1200, ..rays(&unanswering) });
    assert_eq!(rays(&unanswering).shadow + rays(&unanswering).reflection, 0);
    assert_eq!(rays(&|w| w.settings.max_trace_level = 1).reflection, 0);
}

#[test]
fn grid_antialiasing_takes_the_mean_of_all_samples() {
    // A vertical edge just right of the picture's middle: black left of it, 8 right of it.
    let world = Built::default().cube([2.01, 0.0, -4.0], 2.0, glowing(8.0)).world(|world| {
        world.camera.kind = CameraKind::Orthographic;
        world.camera.right = Vector::X;
        world.camera.forward = -Vector::Z;
    });
    let film = traced(&world, 1, 1, Antialias::Grid(4)).film;
    assert_eq!((film.radiance[0], film.samples[0]), (Rgb::gray(4.0), 16));
    // The middle pixel straddles the edge; its centre is black and its right neighbour is not.
    let film = traced(&world, 5, 1, Antialias::Adaptive { threshold: 0.1, grid: 2 }).film;
    assert_eq!(film.samples, [1, 1, 4, 4, 1], "{:?}", film.radiance);
    assert_eq!(film.radiance[2], Rgb::gray(4.0));
}

#[test]
fn a_stopped_film_knows_which_pixels_were_reached() {
    struct Impatient(AtomicUsize);
    impl Watch for Impatient {
        fn progress(&self, done: usize, total: usize) {
            assert!(done <= total);
            self.0.fetch_max(done, Ordering::Relaxed);
        }
        fn should_stop(&self) -> bool {
            self.0.load(Ordering::Relaxed) >= 2
        }
    }
    let world = varied();
    let plan = plan(&world, &Origins::default(), &options(100, 40, Antialias::default()));
    let watch = Impatient(AtomicUsize::new(0));
    let result = trace(&world, &plan, &TraceOptions { threads: Some(1) }, &watch);
    assert!(!result.complete);
    let whole = traced(&world, 100, 40, Antialias::Off).film;
    assert_eq!(result.film.samples.iter().filter(|&&n| n > 0).count(), 2 * 32 * 32);
    for (i, &samples) in result.film.samples.iter().enumerate() {
        let expected = if samples == 0 { Rgb::BLACK } else { whole.radiance[i] };
        assert_eq!(result.film.radiance[i], expected);
    }
}

#[test]
fn the_sky_is_seen_directly_and_in_mirrors() {
    let sky = Sky { pigments: vec![Pigment::Color(Color::opaque(Rgb::new(0.1, 0.2, 0.3)))] };
    let world = Built::default().plane(UnitVector::Z, -3.0, mirror(0.5, 0.0));
    let world = world.world(|world| world.sky = Some(sky));
    assert_eq!(centre(&world), Rgb::new(0.05, 0.1, 0.15));
    let mut empty = world;
    empty.objects.clear();
    assert_eq!(centre(&empty), Rgb::new(0.1, 0.2, 0.3));
}

#[test]
fn an_empty_world_shows_its_background_from_any_camera() {
    let world = Built::default().world(|world| {
        world.background = Rgb::gray(0.5);
        world.camera = Camera { forward: Vector::new(1.0, 2.0, 3.0) * 1e-200, ..world.camera };
    });
    assert!(traced(&world, 7, 3, Antialias::Grid(2)).film.radiance.iter().all(|c| c.red == 0.5));
}
