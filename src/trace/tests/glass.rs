//! What lies behind clear surfaces: laws of filters, of bent rays and of what solids are in.

use super::*;
use crate::math::elementary::{cos, sin};
use crate::plan::{Called, Effect, Stage};
use crate::world::Interior;

/// A surface that shows nothing of itself and lets `transmit` through.
fn pane(transmit: f64) -> Plain {
    let color = Color { rgb: Rgb::WHITE, filter: 0.0, transmit };
    plain(color, NO_FINISH)
}

/// Clear through and through, and mirroring by Fresnel's equations what does not go in.
fn glass() -> Plain {
    let mut glass = mirror(1.0, 0.0);
    glass.pigment = pane(1.0).pigment;
    glass.finish.conserve_energy = true;
    if let Some(reflection) = &mut glass.finish.reflection {
        (reflection.fresnel, reflection.minimum) = (true, Rgb::BLACK);
    }
    glass
}

impl Built {
    /// Fills the object that was added last.
    fn filled(mut self, ior: f64) -> Self {
        self.0.interiors.push(Interior::of(ior));
        if let Some(object) = self.0.objects.last_mut() {
            object.interior = Some(self.0.interiors.len() as u32 - 1);
        }
        self
    }

    /// All of space beyond `depth` before the camera, across `TILT` from its sight.
    fn beyond(self, depth: f64, texture: Plain) -> Self {
        self.plane(UnitVector::from_unit(TILT), TILT.z * -depth, texture)
    }

    /// The same between two depths.
    fn slab(mut self, from: f64, to: f64, texture: Plain) -> Self {
        let across = UnitVector::from_direction(TILT.cross(Vector::X)).expect("not along");
        self.0.boxes.push(Box_ {
            centre: Vector::Z * (-0.5 * (from + to)),
            normals: [UnitVector::X, across, UnitVector::from_unit(TILT)],
            half_widths: [1e6, 1e6, 0.5 * (to - from) * TILT.z],
        });
        let shape = Shape::Box(self.0.boxes.len() as u32 - 1);
        self.object(shape, texture)
    }
}

/// Balls of glass, mirrors among them, over a chequered floor.
pub(super) fn heap() -> World {
    let ball = |built: Built, i: u32| {
        let place =
            [f64::from(i % 3) - 1.0, 0.4 * f64::from(i / 3) - 0.6, -4.0 - 0.3 * f64::from(i % 2)];
        built.sphere(place, 0.55, glass()).filled(1.5)
    };
    let mut floor = matte(1.0, 1.0, 1.0);
    let squares = vec![(0.0, Color::WHITE), (1.0, Color::opaque(Rgb::new(0.2, 0.3, 0.4)))];
    floor.pigment = ramp(Kind::Checker(Checker {}), vec![], squares);
    let floor = Built::default().plane(UnitVector::Y, -1.2, floor);
    let heap = (0..6).fold(floor, ball).sphere([0.0, 1.0, -6.0], 0.8, mirror(0.6, 0.1));
    heap.light([3.0, 5.0, 0.0], 0.8).world(|world| world.settings.max_trace_level = 12)
}

/// A direction 30° off the camera's sight, out of the panes and toward the camera.
const TILT: Vector = Vector::new(0.0, 0.5, 0.866_025_403_784_438_6);

/// By which index of refraction the medium in which the ray ends shows itself: the sky tells the
/// ray's direction.
fn index_behind(built: Built) -> f64 {
    let axis = |direction: Vector| {
        // From −1 … 1 to 0 … 1.
        let matrix = Matrix::from_diagonal(Vector::splat(0.499_999));
        let step = Step::Map(Map::new(direction * -1.0, matrix));
        ramp(gradient(direction), vec![step], black_to_white())
    };
    let along = |direction: Vector| {
        let world = Built(built.0.clone()).world(|world| {
            world.sky = Some(Sky { pigments: vec![axis(direction)], emission: Rgb::WHITE });
            world.settings.max_trace_level = 50;
        });
        centre(&world).red / 0.499_999 - 1.0
    };
    let direction = Vector::new(0.0, along(Vector::Y), along(Vector::Z));
    0.5 / direction.cross(TILT).length()
}

fn assert_index(built: Built, expected: f64) {
    let found = index_behind(built);
    assert!((found - expected).abs() < 1e-5, "{found} is not {expected}");
}

#[test]
fn a_furnace_of_glass_is_white() {
    // Whatever is reflected and let through, in a white world all of it is white.
    let world = Built::default()
        .sphere([0.3, 0.2, -4.0], 1.2, glass())
        .filled(1.5)
        .sphere([0.1, 0.1, -4.2], 0.6, glass())
        .filled(1.1)
        .cube([-1.2, -0.4, -3.0], 0.6, glass())
        .filled(2.4)
        .world(|world| {
            world.background = Rgb::WHITE;
            world.settings = Settings { max_trace_level: 12, adc_bailout: 0.0, ..world.settings };
        });
    let result = traced(&world, 24, 18, Antialias::Off);
    let most = result.film.radiances().map(|c| c.red).fold(0.0, f64::max);
    let mean = result.film.radiances().map(|c| c.red).sum::<f64>() / (24.0 * 18.0);
    assert!(most <= 1.0 + 1e-12 && mean > 0.998, "{most} {mean}");
    assert!(result.counters.transmission > 400 && result.counters.reflection > 400);
    // Nothing is lost where no path is too long.
    let ball = Built::default().sphere([0.0, 0.0, -4.0], 1.0, glass()).filled(1.5);
    let world = ball.world(|world| {
        world.background = Rgb::WHITE;
        world.settings = Settings { max_trace_level: 14, adc_bailout: 0.0, ..world.settings };
    });
    assert!((centre(&world).red - 1.0).abs() < 1e-12);
}

#[test]
fn forty_filters_a_millionth_apart_let_through_their_product() {
    for gap in [1e-2, 1e-6, 1e-9] {
        let filters = (0..40).fold(Built::default(), |built, i| {
            built.plane(UnitVector::Z, -3.0 - f64::from(i) * gap, pane(0.97))
        });
        let world = filters.world(|world| world.background = Rgb::WHITE);
        let expected = 0.97f64.powi(40);
        assert!((centre(&world).red - expected).abs() < 1e-15, "{gap}");
        assert_eq!(traced(&world, 1, 1, Antialias::Off).counters.transmission, 40);
    }
}

#[test]
fn a_light_behind_forty_filters_lights_by_their_product() {
    let shaded = |filters: u32| {
        let floor = Built::default().plane(UnitVector::Z, -3.0, matte(1.0, 1.0, 1.0));
        let filters = (0..filters).fold(floor, |built, i| {
            built.plane(-UnitVector::Z, -1.0 - f64::from(i) * 1e-6, pane(0.97))
        });
        centre(&filters.light([0.0, 0.0, 9.0], 1.0).world(|_| ())).red - 0.1
    };
    // The camera is before the filters; the light behind it.
    assert!((shaded(40) / shaded(0) - 0.97f64.powi(40)).abs() < 1e-12);
    assert!((shaded(1) / shaded(0) - 0.97).abs() < 1e-14);
}

#[test]
fn a_sheet_just_above_a_floor_hides_nothing_of_it() {
    for gap in [1e-2, 1e-6, 1e-9, 1e-12] {
        let world = Built::default()
            .plane(UnitVector::Z, -3.0, glowing(0.5))
            .plane(UnitVector::Z, -3.0 + gap, pane(0.9))
            .world(|_| ());
        assert_eq!(centre(&world), Rgb::gray(0.5) * 0.9, "{gap}");
    }
}

#[test]
fn where_glass_stands_on_a_floor_the_floor_is_seen_whichever_comes_first() {
    let block = || {
        let mut block = Built::default();
        block.0.camera.location = Vector::ZERO;
        block
    };
    // A cube from z = −3 to −5 before a floor at −5.
    let after = block().cube([0.0, 0.0, -4.0], 1.0, pane(0.5)).filled(1.5);
    let after = after.plane(UnitVector::Z, -5.0, glowing(1.0));
    let before = block().plane(UnitVector::Z, -5.0, glowing(1.0));
    let before = before.cube([0.0, 0.0, -4.0], 1.0, pane(0.5)).filled(1.5);
    for built in [after, before] {
        assert_eq!(centre(&built.world(|_| ())), Rgb::gray(0.5));
    }
}

#[test]
fn straight_rays_need_no_level_and_bent_ones_do() {
    // What POV-Ray shows, with the same numbers.
    let panes = |ior: f64, count: i32, levels: u32| {
        let built = (0..count).fold(Built::default(), |built, i| {
            let built = built.plane(UnitVector::Z, -f64::from(i) - 2.0, pane(0.9));
            if ior == 1.0 { built } else { built.filled(ior) }
        });
        let world = built.world(|world| {
            world.background = Rgb::gray(0.9);
            world.settings.max_trace_level = levels;
        });
        (centre(&world).red * 1e4).round() / 1e4
    };
    assert_eq!([1, 2, 3].map(|level| panes(1.0, 1, level)), [0.0, 0.81, 0.81]);
    assert_eq!([1, 2, 3].map(|level| panes(1.0, 6, level)), [0.0, 0.4783, 0.4783]);
    assert_eq!([1, 2, 3].map(|level| panes(1.5, 1, level)), [0.0, 0.81, 0.81]);
    assert_eq!([1, 2, 3].map(|level| panes(1.5, 6, level)), [0.0, 0.0, 0.4783]);
}

#[test]
fn a_clear_surface_shows_by_itself_as_much_as_is_not_clear_and_shines_all_the_same() {
    let mut part = pane(0.5);
    let color = Color { rgb: Rgb::new(0.5, 0.6, 0.7), filter: 0.3, transmit: 0.5 };
    part.pigment = Pigment::Color(color);
    part.finish.emission = Rgb::gray(0.4);
    let behind = Rgb::new(0.8, 0.4, 0.2);
    let seen = |part: &Plain| {
        let built = Built::default().plane(UnitVector::Z, -3.0, part.clone());
        centre(&built.world(|world| world.background = behind)).components()
    };
    let close = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12);
    assert!(close(seen(&part), [0.56, 0.32, 0.198]), "measured");
    part.finish.reflection = mirror(0.2, 0.0).finish.reflection;
    part.finish.emission = Rgb::BLACK;
    assert!(close(seen(&part), [0.68, 0.352, 0.182]), "measured");
    part.finish.conserve_energy = true;
    assert!(close(seen(&part), [0.576, 0.2976, 0.1536]), "measured");
}

#[test]
fn the_solid_entered_last_fills_the_place_it_shares() {
    // The table that POV-Ray shows: in front, behind, index of refraction.
    assert_index(Built::default().beyond(2.0, pane(1.0)).filled(1.5), 1.5);
    let nested = Built::default().beyond(2.0, pane(1.0)).filled(1.5);
    assert_index(nested.slab(3.0, 4.0, pane(1.0)).filled(2.0), 1.5);
    let overlap = Built::default().slab(2.0, 4.0, pane(1.0)).filled(1.5);
    assert_index(overlap.beyond(3.0, pane(1.0)).filled(2.0), 2.0);
    let three = || {
        let first = Built::default().beyond(2.0, pane(1.0)).filled(1.5);
        first.slab(3.0, 5.0, pane(1.0)).filled(2.0)
    };
    assert_index(three().beyond(4.0, pane(1.0)).filled(1.2), 1.2);
    assert_index(three().slab(4.0, 6.0, pane(1.0)).filled(1.2), 1.5);
    // An object without interior is a bubble of air.
    let bubble = Built::default().beyond(2.0, pane(1.0)).filled(1.5);
    assert_index(bubble.beyond(3.0, pane(1.0)), 1.0);
}

#[test]
fn slabs_that_touch_are_one_border_whichever_is_declared_first() {
    // POV-Ray loses one of the two faces, and with it the medium.
    let first = Built::default().slab(2.0, 4.0, pane(1.0)).filled(1.5);
    assert_index(first.beyond(4.0, pane(1.0)).filled(2.0), 2.0);
    let second = Built::default().beyond(4.0, pane(1.0)).filled(2.0);
    assert_index(second.slab(2.0, 4.0, pane(1.0)).filled(1.5), 2.0);
    let through = Built::default().slab(2.0, 4.0, pane(1.0)).filled(1.5);
    assert_index(through.slab(4.0, 6.0, pane(1.0)).filled(2.0), 1.0);
    // And each face filters once.
    let world = Built::default()
        .cube([0.0, 0.0, -3.0], 1.0, pane(0.5))
        .cube([0.0, 0.0, -5.0], 1.0, pane(0.5))
        .world(|world| world.background = Rgb::WHITE);
    assert_eq!(centre(&world), Rgb::gray(0.5f64.powi(4)));
}

#[test]
fn a_camera_inside_knows_what_it_is_in() {
    let around = |ior: f64| Built::default().slab(-5.0, 3.0, pane(1.0)).filled(ior);
    // Sine ½ · 1.5 in air; the index that shows is 1/1.5.
    assert_index(around(1.5), 1.0 / 1.5);
    // Inside of two the one declared last counts.
    let both = around(1.5).slab(-5.0, 4.0, pane(1.0)).filled(1.2);
    assert_index(both, 1.0 / 1.2);
}

#[test]
fn where_nothing_can_leave_all_comes_back() {
    // From inside, 30° is beyond the critical angle of 2.4; the mirrored ray sees the sky.
    let mut inside = pane(0.5);
    inside.finish.reflection = mirror(0.3, 0.0).finish.reflection;
    let world = Built::default()
        .plane(-UnitVector::from_unit(TILT), 3.0 * TILT.z, inside)
        .filled(2.4)
        .world(|world| world.background = Rgb::gray(0.25));
    assert_eq!(centre(&world), Rgb::gray(0.25), "whole, and not twice");
    let result = traced(&world, 1, 1, Antialias::Off);
    let Counters { reflection, transmission, total_reflection, .. } = result.counters;
    assert_eq!((reflection, transmission, total_reflection), (0, 0, 1));
}

#[test]
fn a_ball_of_any_size_and_a_slab_of_any_thickness_let_the_central_ray_straight_on() {
    for exponent in [-17, -10, 0, 10, 20] {
        let size = 2f64.powi(exponent);
        let world = Built::default()
            .sphere([0.0, 0.0, -3.0 * size], size, pane(1.0))
            .filled(1.5)
            .plane(UnitVector::Z, -9.0 * size, glowing(1.0))
            .world(|_| ());
        assert_eq!(centre(&world), Rgb::WHITE);
    }
    for thickness in [1e-1, 1e-6, 1e-12] {
        // A slanting slab shifts the ray and keeps its direction.
        assert_index(Built::default().slab(3.0, 3.0 + thickness, pane(1.0)).filled(1.6), 1.0);
    }
}

#[test]
fn the_paths_of_a_fork_are_each_folded_at_their_own_surface() {
    // Half mirrored, half let through: before the camera a pane, behind it white, beyond it gray.
    let mut part = pane(0.5);
    part.finish.reflection = mirror(0.5, 0.0).finish.reflection;
    let forks = |count: i32| {
        let panes = (0..count).fold(Built::default(), |built, i| {
            built.plane(UnitVector::Z, -2.0 - f64::from(i), part.clone())
        });
        let world = panes
            .plane(-UnitVector::Z, -4.0, glowing(1.0))
            .plane(UnitVector::Z, -90.0, glowing(0.5))
            .world(|world| {
                world.settings =
                    Settings { max_trace_level: 40, adc_bailout: 0.0, ..world.settings }
            });
        centre(&world).red
    };
    assert_eq!(forks(1), 0.5 + 0.25);
    // Two: what is mirrored to and fro between them makes a series of quarters.
    let between = 1.0 / (1.0 - 0.25);
    let mirrored = 0.5 + 0.25 * 0.5 * between;
    assert!((forks(2) - (mirrored + 0.25 * between * 0.5)).abs() < 1e-9, "{}", forks(2));
}

#[test]
fn adc_bailout_cuts_what_is_let_through_by_its_brightness_and_by_the_weight_of_its_largest_part() {
    // What POV-Ray shows for two filters before a mirror of 0.6: each lets <0.6, 0.24, 0.12>
    // through, of brightness 0.333, and the weights are 0.6 to the second, third, fourth, fifth.
    let mut filter = pane(1.0);
    let rgb = Rgb::new(1.0, 0.4, 0.2);
    filter.pigment = Pigment::Color(Color { rgb, filter: 0.6, transmit: 0.0 });
    for (adc_bailout, through, mirrored) in [
        (0.34, 0, 0),
        (0.33, 2, 0),
        (0.217, 2, 0),
        (0.215, 2, 1),
        (0.13, 2, 1),
        (0.129, 3, 1),
        (0.078, 3, 1),
        (0.077, 4, 1),
    ] {
        let world = Built::default()
            .plane(UnitVector::Z, -2.0, filter.clone())
            .plane(UnitVector::Z, -3.0, filter.clone())
            .plane(UnitVector::Z, -4.0, mirror(0.6, 0.0))
            .world(|world| world.settings = Settings { adc_bailout, ..world.settings });
        let counters = traced(&world, 1, 1, Antialias::Off).counters;
        assert_eq!(
            (counters.transmission, counters.reflection),
            (through, mirrored),
            "{adc_bailout}"
        );
    }
}

#[test]
fn a_negative_transmit_takes_light_away() {
    // As POV-Ray shows it: (1 + 0.4)·0.6·C − 0.4·1.
    let mut odd = glowing(0.6);
    let rgb = Rgb::new(0.9, 0.8, 0.7);
    odd.pigment = Pigment::Color(Color { rgb, filter: 0.0, transmit: -0.4 });
    let world = Built::default()
        .plane(UnitVector::Z, -3.0, odd)
        .world(|world| world.background = Rgb::WHITE);
    let off = |(seen, c): (f64, f64)| (seen - (1.4 * 0.6 * c - 0.4)).abs();
    assert!(
        centre(&world).components().into_iter().zip(rgb.components()).map(off).all(|d| d < 1e-12)
    );
}

#[test]
fn a_seed_surface_that_is_clear_is_clamped_with_all_it_shows() {
    let mut clear = seed(Rgb::WHITE, 1.0, 0.5, 9.0, 0.6);
    clear.pigment = Pigment::Color(Color { rgb: Rgb::WHITE, filter: 0.0, transmit: 0.5 });
    let world = Built::default()
        .plane(UnitVector::Z, -3.0, clear)
        .world(|world| world.background = Rgb::gray(1.5));
    assert_eq!(centre(&world), Rgb::WHITE);
}

#[test]
fn an_orthographic_camera_and_a_tree_of_objects_see_the_same_glass() {
    // Eight more objects out of sight make a tree of boxes; nothing else may change.
    let few = || {
        Built::default()
            .sphere([0.2, 0.1, -4.0], 1.0, glass())
            .filled(1.5)
            .plane(UnitVector::Y, -1.0, matte(0.9, 0.5, 0.2))
            .light([3.0, 5.0, 0.0], 0.8)
    };
    let many = (0..8)
        .fold(few(), |built, i| built.sphere([f64::from(i), 0.0, 60.0], 0.1, matte(1.0, 1.0, 1.0)));
    for kind in [CameraKind::Perspective, CameraKind::Orthographic] {
        let picture = |built: Built| {
            let world = built.world(|world| {
                world.background = Rgb::new(0.3, 0.5, 0.9);
                world.camera.kind = kind;
            });
            traced(&world, 16, 12, Antialias::Off).film
        };
        let many = Built(many.0.clone());
        assert_eq!(picture(few()), picture(many));
    }
}

#[test]
fn filters_before_a_light_multiply_in_one_order_however_they_are_declared() {
    let panes: Vec<(f64, f64)> = (0..9)
        .map(f64::from)
        .map(|i| (1.0 + 0.5 * (1.0 + sin(3.7 * i)), 0.3 + 0.6 * cos(1.3 * i).abs()))
        .collect();
    let picture = |order: &[(f64, f64)]| {
        let floor = Built::default().plane(UnitVector::Y, -1.0, matte(0.8, 0.7, 0.6));
        let built = order
            .iter()
            .fold(floor, |built, &(height, part)| built.cube([0.0, height, -4.0], 0.4, pane(part)));
        traced(&built.light([0.0, 9.0, -4.0], 1.0).world(|_| ()), 16, 12, Antialias::Off).film
    };
    let turned: Vec<_> = panes.iter().rev().copied().collect();
    assert_eq!(picture(&panes), picture(&turned));
}

#[test]
fn what_is_opaque_is_traced_alike_by_all_stages() {
    let world = varied();
    let options = options(24, 18, Antialias::Off);
    let pruned = plan(&world, &Origins::default(), &options);
    let mut all = Plan { stages: Stage::ALL.to_vec(), ..pruned.clone() };
    for effect in [Effect::Transparency, Effect::Refraction, Effect::ColoredShadows] {
        assert!(!pruned.simulates(effect));
        all.effects.push(Called { effect, by: Vec::new(), cost: String::new(), rays: None });
    }
    assert_eq!(traced_by(&world, &pruned).film, traced_by(&world, &all).film);
    assert_eq!(traced_by(&world, &all).counters.transmission, 0);
}
