//! What a ray sees: laws of light, of paths and of their bounds.

use super::*;

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
    assert!(result.film.radiances().all(|radiance| radiance == Rgb::WHITE));
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
        assert_eq!(result.film.radiance(0), Rgb::gray(f64::from(surfaces)));
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
    // Between a seed surface and a mirror of one half, the mirror's weights alone count: ½, then ¼.
    let world = Built::default()
        .plane(UnitVector::Z, -3.0, seed(Rgb::WHITE, 0.5, 0.001, 9.0, 1.0))
        .plane(-UnitVector::Z, -3.0, mirror(0.5, 0.0))
        .world(|world| world.settings.adc_bailout = 0.3);
    assert_eq!(traced(&world, 1, 1, Antialias::Off).counters.reflection, 3);
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
    let emission = 0.1;
    assert_eq!(centre(&wall().light([0.0, 0.0, -5.0], 1.0).world(|_| ())).red, emission);
    let behind = wall().light([0.0, 0.0, -5.0], 1.0);
    let shining_through = behind.world(|world| world.lights[0].casts_shadows = false);
    assert_eq!(centre(&shining_through).red, emission);
    assert_eq!(centre(&wall().light([0.0, 0.0, -3.0], 1.0).world(|_| ())).red, emission);
    let lit = wall().light([0.0, 2.0, 0.0], 1.0);
    assert!(centre(&lit.world(|_| ())).red > 0.5);
    let covered = || wall().light([0.0, 2.0, 0.0], 1.0).sphere([0.0, 1.0, -1.5], 0.5, glowing(0.0));
    assert_eq!(centre(&covered().world(|_| ())).red, emission);
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
        let light = Light {
            kind,
            color: Rgb::WHITE,
            casts_shadows: true,
            attenuation: None,
            area: None,
            through: None,
        };
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
    let step = Step::Map(Map { centre: Vector::Z * 0.5, ..Map::IDENTITY });
    checkered.pigment = ramp(gradient(Vector::Z), vec![step], black_to_white());
    let world = Built::default().plane(UnitVector::Z, -3.0, checkered).world(|world| {
        world.objects[0].faces = Some(1);
        world.faces = vec![FaceCoordinates::default(), FaceCoordinates([None, None, Some(0.75)])];
    });
    assert_eq!(centre(&world), Rgb::gray(0.25));
}

#[test]
fn a_pattern_is_read_in_the_textures_space_and_then_in_its_own() {
    let mut striped = glowing(1.0);
    let step = Step::Map(Map { centre: Vector::X * 0.125, ..Map::IDENTITY });
    striped.pigment = ramp(gradient(Vector::X), vec![step], black_to_white());
    let world = Built::default().plane(UnitVector::Z, -3.0, striped).world(|world| {
        let matrix = Matrix::from_diagonal(Vector::splat(0.25));
        world.texture_maps = vec![Map::IDENTITY, Map::new(Vector::X * -2.0, matrix)];
        world.objects[0].places = Some(1);
    });
    // Seen at x = 0: (0 + 2) / 4 in the texture, an eighth less in the pattern.
    assert_eq!(centre(&world), Rgb::gray(0.375));
}

#[test]
fn the_sky_is_seen_directly_and_in_mirrors() {
    let sky = Sky {
        pigments: vec![Pigment::Color(Color::opaque(Rgb::new(0.1, 0.2, 0.3)))],
        emission: Rgb::WHITE,
    };
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
        world.camera.forward = Vector::new(1.0, 2.0, 3.0) * 1e-200;
    });
    assert!(traced(&world, 7, 3, Antialias::Grid(2)).film.radiances().all(|c| c.red == 0.5));
}

#[test]
fn what_the_camera_does_not_see_mirrors_do_and_the_other_way_round() {
    // A mirror before the camera, a glowing ball behind it; and that ball before it, without a mirror.
    let seen = |z: f64, in_image: bool, in_reflections: bool| {
        let ball = Built::default().sphere([0.0, 0.0, z], 0.5, glowing(1.0));
        let wall = if z > 0.0 { mirror(1.0, 0.0) } else { glowing(0.0) };
        let world = ball.plane(UnitVector::Z, -3.0, wall).world(|world| {
            (world.objects[0].in_image, world.objects[0].in_reflections) =
                (in_image, in_reflections);
        });
        centre(&world).red
    };
    for in_image in [true, false] {
        for in_reflections in [true, false] {
            assert_eq!(seen(-2.0, in_image, in_reflections), f64::from(u8::from(in_image)));
            assert_eq!(seen(2.0, in_image, in_reflections), f64::from(u8::from(in_reflections)));
        }
    }
}

#[test]
fn what_neither_the_camera_nor_mirrors_see_casts_its_shadow() {
    let lit = |casts_shadow| {
        let floor = Built::default().plane(UnitVector::Z, -3.0, matte(1.0, 1.0, 1.0));
        let ball = floor.sphere([0.0, 0.0, -2.0], 0.5, glowing(1.0)).light([0.0, 0.0, 0.0], 1.0);
        centre(&ball.world(|world| {
            let ball = &mut world.objects[1];
            (ball.in_image, ball.in_reflections) = (false, false);
            ball.casts_shadow = casts_shadow;
        }))
    };
    assert_eq!(lit(true).red, 0.1);
    assert_eq!(lit(false).red, 0.7);
}

/// The numbers are POV-Ray 3.7's, of the same plane.
#[test]
fn a_surface_lit_on_both_sides_answers_the_light_behind_it() {
    let seen = |finish: Finish, double_illuminate: bool, blocked: bool| {
        let color = Color::opaque(Rgb::new(1.0, 0.5, 0.25));
        let wall = Built::default().plane(UnitVector::Z, -5.0, plain(color, finish));
        let wall = wall.light([3.0, 0.0, -9.0], 1.0);
        let wall = if blocked { wall.sphere([1.5, 0.0, -7.0], 0.3, glowing(0.0)) } else { wall };
        centre(&wall.world(|world| world.objects[0].double_illuminate = double_illuminate))
    };
    let scatters = || Finish { diffuse: 1.0, ..NO_FINISH };
    let shines = |kind, metallic| {
        let lobe = Lobe { kind, weight: 1.0, exponent: 1.0, metallic };
        Finish { lobes: vec![lobe], ..NO_FINISH }
    };
    assert!((seen(scatters(), true, false).red - 0.8).abs() < 1e-14);
    let bent = Finish { brilliance: 2.0, ..scatters() };
    assert!((seen(bent, true, false).green - 0.32).abs() < 1e-14);
    assert!((seen(shines(LobeKind::Blinn, 0.0), true, false).blue - 0.3162).abs() < 1e-4);
    assert!((seen(shines(LobeKind::Blinn, 1.0), true, false).green - 0.167).abs() < 1e-3);
    assert_eq!(seen(shines(LobeKind::Phong, 0.0), true, false), Rgb::BLACK);
    assert_eq!(seen(scatters(), true, true), Rgb::BLACK);
    assert_eq!(seen(scatters(), false, false), Rgb::BLACK);
}
