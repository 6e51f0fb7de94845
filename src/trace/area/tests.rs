//! Area lights beside POV-Ray's, and the laws of their grids.

use super::*;
use crate::math::UnitVector;
use crate::plan::{Antialias, Frame, PlanOptions, Samples, plan};
use crate::shape::{Plane, Shape, Sphere};
use crate::trace::{TraceOptions, Traced, Unwatched, trace};
use crate::world::{
    Attenuation, Camera, CameraKind, Fade, Finish, Object, Origins, Pigment, Plain, Texture, World,
};

/// What POV-Ray 3.7 shows.
const MEASURED: &str = include_str!("../measured/area.txt");

const EVERY_NODE: Area = Area {
    sides: [Vector::X, Vector::Y],
    nodes: [2, 2],
    least_divisions: Area::ALL_NODES,
    jitter: false,
    circular: false,
    orient: false,
    illuminates: false,
    target: None,
};

/// A white wall, a ball before it, and a light before both.
fn wall(area: Option<Area>) -> World {
    let finish = Finish {
        conserve_energy: false,
        emission: Rgb::BLACK,
        diffuse: 1.0,
        brilliance: 1.0,
        lobes: Vec::new(),
        reflection: None,
        seed: false,
        extras: None,
    };
    let pigment = Pigment::Color(crate::color::Color::WHITE);
    World {
        camera: Camera {
            kind: CameraKind::Orthographic,
            location: Vector::new(0.0, 0.0, -2.6),
            forward: -Vector::Z,
            right: Vector::X * 4.0,
            up: Vector::Y * 3.0,
            ..Camera::default()
        },
        planes: vec![Plane { normal: UnitVector::Z, distance: -3.0 }],
        spheres: vec![Sphere { centre: Vector::new(0.1, 0.2, -1.5), radius: 0.4 }],
        objects: vec![Object::plain(Shape::Plane(0)), Object::plain(Shape::Sphere(0))],
        textures: vec![Texture::Plain(Plain { pigment, normal: None, finish })],
        lights: vec![Light {
            kind: LightKind::Point { position: Vector::new(0.3, 0.0, 2.0) },
            color: Rgb::WHITE,
            casts_shadows: true,
            attenuation: None,
            area,
            through: None,
        }],
        ..World::default()
    }
}

fn traced(world: &World, (width, height): (u32, u32), options: &TraceOptions) -> Traced {
    let antialias = Antialias::Off;
    let plan_options = PlanOptions { antialias, ..PlanOptions::new(Frame::whole(width, height)) };
    let plan = plan(world, &Origins::default(), &plan_options);
    trace(world, &plan, options, &Unwatched)
}

fn red(world: &World, width: u32, height: u32) -> Vec<f64> {
    let traced = traced(world, (width, height), &TraceOptions::on_threads(1));
    traced.film.radiances().map(|seen| seen.red).collect()
}

#[test]
fn penumbras_are_those_of_the_other_program() {
    for line in MEASURED.lines().filter(|line| !line.starts_with('#')) {
        let (light, expected) = line.split_once(':').expect("a light and its picture");
        let words: Vec<&str> = light.split_whitespace().collect();
        let number = |at: usize| words[at].parse::<u32>().expect("a number");
        let has = |word: &str| words.contains(&word);
        let adaptive = words.iter().position(|word| *word == "adaptive");
        let area = Area {
            sides: [Vector::X * f64::from(number(0)), Vector::Y * f64::from(number(1))],
            nodes: [number(2), number(3)],
            least_divisions: adaptive.map_or(Area::ALL_NODES, |at| number(at + 1)),
            circular: has("circular"),
            orient: has("orient"),
            illuminates: has("area_illumination"),
            ..EVERY_NODE
        };
        let seen = red(&wall(Some(area)), 8, 6);
        for (place, (seen, expected)) in seen.iter().zip(expected.split_whitespace()).enumerate() {
            let expected: f64 = expected.parse().expect("a number");
            assert!((seen - expected).abs() < 3e-5, "{light}, {place}: {seen} {expected}");
        }
    }
}

#[test]
fn a_grid_of_one_light_and_what_nothing_shadows_is_a_point() {
    let point = red(&wall(None), 8, 6);
    let one = Area { nodes: [1, 1], ..EVERY_NODE };
    assert_eq!(red(&wall(Some(one)), 8, 6), point);
    let bare = |area: Option<Area>| {
        let mut world = wall(area);
        world.objects.truncate(1);
        red(&world, 8, 6)
    };
    for nodes in [[3, 3], [4, 7], [6, 5]] {
        assert_eq!(bare(Some(Area { nodes, ..EVERY_NODE })), bare(None));
    }
}

#[test]
fn jitter_is_the_same_on_any_threads_and_tiles_and_keeps_the_mean() {
    let area = Area { nodes: [5, 5], ..EVERY_NODE };
    let jittered = wall(Some(Area { jitter: true, circular: true, ..area }));
    let picture = |threads, tile_side| {
        let options = TraceOptions { tile_side, ..TraceOptions::on_threads(threads) };
        traced(&jittered, (40, 30), &options).film
    };
    let first = picture(1, None);
    assert_eq!(picture(3, Some(7)), first);
    assert_eq!(picture(2, Some(1)), first);
    let mean = |world: &World| red(world, 80, 60).iter().sum::<f64>() / 4800.0;
    let (still, moved) =
        (mean(&wall(Some(area))), mean(&wall(Some(Area { jitter: true, ..area }))));
    assert!((still - moved).abs() < 2e-3, "{still} {moved}");
}

#[test]
fn nodes_are_asked_for_once_and_only_where_shadows_are() {
    let rays = |area: Area, truncated: bool| {
        let mut world = wall(Some(area));
        world.objects.truncate(if truncated { 1 } else { 2 });
        let traced = traced(&world, (8, 6), &TraceOptions::on_threads(1));
        traced.counters.shadow as f64 / 48.0
    };
    let grid = Area { nodes: [9, 9], ..EVERY_NODE };
    // Where nothing is between, nothing is asked; elsewhere, all are.
    let places = rays(grid, false) * 48.0 / 81.0;
    assert!(places.fract() == 0.0 && (1.0..30.0).contains(&places), "{places}");
    assert_eq!(rays(grid, true), 0.0);
    assert_eq!(rays(Area { nodes: [4, 6], ..EVERY_NODE }, false) * 48.0 / 24.0, places);
    let adaptive = rays(Area { least_divisions: 1, ..grid }, false) * 48.0 / places;
    assert!((9.0..60.0).contains(&adaptive), "{adaptive}");
    // Where something is between, as many as are asked for in any case, also if the first of them agree.
    let fine = Area { nodes: [65, 65], least_divisions: 5, ..grid };
    assert!(rays(fine, false) * 48.0 >= 33.0 * 33.0 * places);
}

#[test]
fn samples_spread_over_a_light_come_to_what_a_fine_grid_shows() {
    let seen = |area: Area, light_samples: Samples| {
        let world = wall(Some(area));
        let frame = Frame::whole(40, 30);
        let options =
            PlanOptions { antialias: Antialias::Off, light_samples, ..PlanOptions::new(frame) };
        let plan = plan(&world, &Origins::default(), &options);
        let picture = |threads, tile_side| {
            let options = TraceOptions { tile_side, ..TraceOptions::on_threads(threads) };
            trace(&world, &plan, &options, &Unwatched)
        };
        let traced = picture(1, None);
        assert_eq!(picture(2, Some(7)).film, traced.film);
        let rays = traced.counters.shadow;
        (traced.film.radiances().map(|seen| seen.red).collect::<Vec<_>>(), rays)
    };
    let off = |a: &[f64], b: &[f64]| {
        let squares = a.iter().zip(b).map(|(a, b)| (a - b) * (a - b));
        (squares.sum::<f64>() / a.len() as f64).sqrt()
    };
    for illuminates in [false, true] {
        let area = Area { illuminates, ..EVERY_NODE };
        let (fine, _) = seen(Area { nodes: [65, 65], ..area }, Samples::Scene);
        let errors = [4, 16, 64, 256].map(|count| off(&seen(area, Samples::Fixed(count)).0, &fine));
        // Four times as many leave less than half of the error.
        assert!(errors.windows(2).all(|pair| pair[1] < 0.5 * pair[0]), "{errors:?}");
        let (_, all) = seen(area, Samples::Fixed(256));
        let threshold = 0.02;
        let (known, some) = seen(area, Samples::Adaptive { threshold, most: 256 });
        assert!(off(&known, &fine) < threshold && 2 * some < all, "{some} {all}");
    }
}

#[test]
fn any_grid_at_any_place_gives_finite_light() {
    let sides = [Vector::ZERO, Vector::X * 1e300, Vector::ONE * 1e-300, Vector::Z];
    for (&a, &b) in sides.iter().flat_map(|a| sides.iter().map(move |b| (a, b))) {
        for flags in 0..16 {
            let is = |bit: u32| flags >> bit & 1 == 1;
            let area = Area {
                sides: [a, b],
                nodes: [3, 4],
                least_divisions: 0,
                jitter: is(0),
                circular: is(1),
                orient: is(2),
                illuminates: is(3),
                target: Some(Vector::ZERO),
            };
            let fade = Some(Fade { distance: 1.0, power: 2.0, signed: false });
            let mut world = wall(Some(area));
            world.lights[0].attenuation = Some(Attenuation { beam: None, fade, fog: false });
            for kind in [
                LightKind::Point { position: Vector::new(0.0, 0.0, -3.0) },
                LightKind::Parallel { position: Vector::ZERO, to_light: UnitVector::Z },
            ] {
                world.lights[0].kind = kind;
                assert!(red(&world, 3, 2).iter().all(|red| red.is_finite()), "{area:?}");
            }
        }
    }
}

#[test]
fn a_grid_of_parallel_light_that_turns_faces_all_points_alike() {
    use crate::road::{Options, Road};
    use crate::source::NoFiles;
    // What POV-Ray 3.7 shows of the edge of a board's shadow.
    let across = "box { <0, 1, -99>, <99, 1.01, 99> no_image }";
    let skewed = "box { <-99, 1, 0>, <99, 1.01, 99> no_image rotate 20*y }";
    for (place, board, theirs) in [
        ("<3, 10, -4>", across, [1.0, 1.0, 1.0, 0.1563, 0.0, 0.0, 0.0, 0.0]),
        ("<3, 10, -4>", skewed, [1.0, 1.0, 1.0, 1.0, 1.0, 0.7422, 0.375, 0.043]),
        ("<0, 10, -4>", skewed, [1.0, 1.0, 1.0, 1.0, 1.0, 0.9687, 0.6797, 0.3047]),
        ("<-6, 8, 3>", skewed, [1.0, 0.9687, 0.7187, 0.4219, 0.1289, 0.0, 0.0, 0.0]),
    ] {
        let text = format!(
            "#version 3.7; global_settings {{ assumed_gamma 1 }}
             camera {{ orthographic location 3.5*y direction -y up 0.01*z right 3*x }}
             plane {{ y, 0 pigment {{ rgb 1 }} finish {{ diffuse 1 brilliance 0 ambient 0 }} }}
             light_source {{
               {place} rgb 1 parallel point_at 0 area_light 4*x, 4*y, 9, 9 circular orient
             }} {board}"
        );
        let mut road = Road::new(&NoFiles, Options::new(crate::scene::Dialect::Pov));
        let (world, _) = road.compile("a.pov", text.into_bytes());
        for (ours, theirs) in red(&world, 8, 1).into_iter().zip(theirs) {
            assert!((ours - theirs).abs() < 1e-4, "{place} {board}: {ours} {theirs}");
        }
    }
}
