//! Interiors: who takes which, what is dropped, and what is said of it.

use super::build::*;
use crate::color::{Color, Rgb};
use crate::diagnostic::Code;
use crate::math::Vector;
use crate::scene::*;
use crate::world::{self, World};

impl Build {
    fn interior(&mut self, ior: f64) -> ModifierKind {
        self.0.interiors.push(Interior {
            ior,
            ior_site: Some(site(700 + self.0.interiors.len())),
            ..Interior::default()
        });
        ModifierKind::Interior(InteriorId(self.0.interiors.len() as u32 - 1))
    }

    fn clear(&mut self, filter: f64, transmit: f64) -> ModifierKind {
        let color = Color { filter, transmit, ..Color::WHITE };
        let pigment = self.pigment(PigmentKind::Color(color), vec![]);
        ModifierKind::Texture(self.texture(pigment, vec![]))
    }

    fn finish(&mut self, finish: ClassicFinish) -> ModifierKind {
        self.0.finishes.push(Finish::Classic(finish));
        ModifierKind::Finish(FinishId(self.0.finishes.len() as u32 - 1))
    }

    fn ball(&mut self, x: f64, modifiers: Vec<ModifierKind>) {
        let ball = self.object(sphere(x, 0.0, 9.0, 1.0), modifiers);
        self.root(ball);
    }
}

/// The index of refraction of each object.
fn iors(world: &World) -> Vec<Option<f64>> {
    let ior = |i: u32| world.interiors[i as usize].ior;
    world.objects.iter().map(|object| object.interior.map(ior)).collect()
}

#[test]
fn a_childs_own_interior_wins_and_else_its_parents() {
    let mut build = Build::new();
    let clear = build.clear(0.9, 0.0);
    let (glass, water) = (build.interior(1.5), build.interior(1.33));
    let own = build.object(sphere(0.0, 0.0, 9.0, 1.0), vec![clear, water]);
    let bare = build.object(sphere(3.0, 0.0, 9.0, 1.0), vec![clear]);
    let union = build.object(ObjectKind::Union(vec![own, bare]), vec![glass]);
    build.root(union);
    // A use puts its own in the place of that of what it uses.
    let used = build.object(ObjectKind::Use(own), vec![glass]);
    build.root(used);
    let world = build.world();
    assert_eq!(iors(&world), [Some(1.33), Some(1.5), Some(1.5)], "measured");
    assert_eq!(world.interiors.len(), 2);
}

#[test]
fn the_old_ior_of_a_finish_outdoes_the_interior() {
    let mut build = Build::new();
    let clear = build.clear(0.0, 1.0);
    let glass = build.interior(1.5);
    let old = build.finish(ClassicFinish { ior: Some(2.0), ..ClassicFinish::default() });
    build.ball(0.0, vec![clear, glass, old]);
    build.ball(3.0, vec![clear, old, glass]);
    build.ball(6.0, vec![clear, old]);
    assert_eq!(iors(&build.world()), [Some(2.0); 3], "measured");
}

#[test]
fn an_interior_that_no_light_enters_is_dropped_and_that_is_said() {
    let mut build = Build::new();
    let (clear, glass) = (build.clear(0.0, 1.0), build.interior(1.5));
    let water = build.interior(1.33);
    build.ball(0.0, vec![water]);
    build.ball(3.0, vec![clear, glass]);
    // The camera, at the origin, is inside of this one.
    let around = build.object(sphere(0.0, 0.0, 0.0, 100.0), vec![water]);
    build.root(around);
    let (world, origins, _) = build.lower();
    assert_eq!(iors(&world), [None, Some(1.5), Some(1.33)]);
    assert_eq!(world.interiors, [1.5, 1.33].map(world::Interior::of));
    let sites: Vec<_> = origins.interiors.iter().map(|origin| origin.ior.clone()).collect();
    assert_eq!(sites, [[site(700)], [site(701)]]);
    assert!(origins.dropped.is_empty());

    let mut build = Build::new();
    let glass = build.interior(1.5);
    build.ball(0.0, vec![glass]);
    let (world, origins, _) = build.lower();
    assert!(world.interiors.is_empty() && iors(&world) == [None]);
    assert_eq!(origins.dropped[0].why, "no light goes into what it fills");
    assert_eq!(origins.dropped[0].site, site(700));
}

#[test]
fn an_ior_of_1_is_no_interior_unless_it_is_a_bubble_in_another() {
    let scene = |outer: f64| {
        let mut build = Build::new();
        let clear = build.clear(0.0, 1.0);
        let (air, outer) = (build.interior(1.0), build.interior(outer));
        build.ball(0.0, vec![clear, air]);
        build.ball(0.5, vec![clear, outer]);
        build.lower()
    };
    let (world, origins, _) = scene(1.0);
    assert_eq!(iors(&world), [None, None]);
    assert_eq!(origins.dropped[0].why, "an `ior` of 1 bends no light");
    assert_eq!(iors(&scene(1.5).0), [Some(1.0), Some(1.5)]);
}

#[test]
fn an_opaque_object_keeps_its_interior_for_fresnel() {
    let fresnel = |minimum: f64| Reflection {
        minimum: Rgb::gray(minimum),
        maximum: Rgb::WHITE,
        falloff: 3.0,
        fresnel: true,
        exponent: 1.0,
        metallic: 0.0,
    };
    let scene = |minimum: f64, ior: Option<f64>| {
        let mut build = Build::new();
        let reflection = Some(Box::new(fresnel(minimum)));
        let finish = build.finish(ClassicFinish { reflection, ..ClassicFinish::default() });
        let mut modifiers = vec![ModifierKind::Texture(PLAIN), finish];
        modifiers.extend(ior.map(|ior| build.interior(ior)));
        build.ball(0.0, modifiers);
        build.lower()
    };
    let (world, _, messages) = scene(0.0, Some(1.5));
    assert_eq!(iors(&world), [Some(1.5)]);
    let reflection = texture_of(&world, 0).finish.reflection.expect("one");
    assert_eq!((reflection.fresnel, reflection.falloff), (true, 1.0));
    assert!(!messages.iter().any(|m| m.code == Code::FresnelWithoutIor));
    // Between equal ends there is nothing to go by.
    let (world, _, _) = scene(1.0, Some(1.5));
    assert!(!texture_of(&world, 0).finish.reflection.expect("one").fresnel);
    // One of 1 may be a bubble in water.
    for (ior, told) in [(None, 1), (Some(1.0), 0)] {
        let messages = scene(0.0, ior).2;
        assert_eq!(messages.iter().filter(|m| m.code == Code::FresnelWithoutIor).count(), told);
    }
}

#[test]
fn energy_is_conserved_only_where_something_is_both_reflected_and_let_through() {
    let kept = |clear: bool, mirror: f64| {
        let mut build = Build::new();
        let color = build.clear(0.0, if clear { 0.5 } else { 0.0 });
        let part = Rgb::gray(mirror);
        let finish = build.finish(ClassicFinish {
            conserve_energy: true,
            reflection: Some(Box::new(Reflection {
                minimum: part,
                maximum: part,
                falloff: 1.0,
                fresnel: false,
                exponent: 1.0,
                metallic: 0.0,
            })),
            ..ClassicFinish::default()
        });
        build.ball(0.0, vec![color, finish]);
        texture_of(&build.world(), 0).finish.conserve_energy
    };
    assert!(kept(true, 0.5));
    assert!(!kept(false, 0.5) && !kept(true, 0.0));
}

#[test]
fn a_colour_that_lets_through_more_than_comes_is_told_once() {
    let messages = |filter: f64, transmit: f64| {
        let mut build = Build::new();
        let clear = build.clear(filter, transmit);
        let shiny = build.finish(ClassicFinish { phong: 1.0, ..ClassicFinish::default() });
        build.ball(0.0, vec![clear]);
        build.ball(3.0, vec![clear, shiny]);
        build.codes().iter().filter(|&&code| code == Code::TooClear).count()
    };
    assert_eq!(messages(0.6, 0.6), 1);
    assert_eq!(messages(0.7, 0.3) + messages(0.1 + 0.2, 0.7), 0, "rounding is no mistake");
}

#[test]
fn an_interior_without_end_is_reported() {
    let mut build = Build::new();
    let (clear, endless) = (build.clear(0.0, 1.0), build.interior(f64::INFINITY));
    build.ball(0.0, vec![clear, endless]);
    assert!(build.codes().contains(&Code::NotANumber));
}

#[test]
fn an_inside_out_object_is_entered_from_outside() {
    let mut build = Build::new();
    let glass = build.interior(1.5);
    let hole = build.object(sphere(0.0, 0.0, 9.0, 1.0), vec![glass, ModifierKind::Inverse]);
    build.root(hole);
    build.ball(0.0, vec![]);
    let clear = build.clear(0.0, 1.0);
    build.ball(5.0, vec![clear]);
    assert_eq!(build.world().interiors.len(), 1, "the camera at {} is in it", Vector::ZERO);
}
