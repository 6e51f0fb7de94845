//! Small Worlds, and which effects they call for.

use super::*;
use crate::color::{Color, Rgb};
use crate::math::Vector;
use crate::pattern::{Checker, Kind, Setting, Wave};
use crate::plan::{Frame, Samples};
use crate::shape::{Shape, Sphere};
use crate::source::{ExpansionId, FileId, Span};
use crate::texture::{Blend, Pattern, Source, Space};
use crate::world::{
    Dropped, Finish, LightKind, Lobe, LobeKind, Object, Reflection, Sky, SkyOrigin, TextureOrigin,
};

fn site(place: usize) -> Site {
    Site { span: Span::new(FileId(0), place, place + 1), expansion: ExpansionId::MAIN }
}

/// A mirroring, shining sphere (texture called for at 10) under a lamp (at 20).
fn lit_mirror() -> (World, Origins) {
    let part = Rgb::gray(0.5);
    let lobe = Lobe { kind: LobeKind::Phong, weight: 0.5, exponent: 9.0, metallic: 0.0 };
    let finish = Finish {
        conserve_energy: false,
        emission: Rgb::BLACK,
        diffuse: 0.5,
        brilliance: 1.0,
        lobes: vec![lobe],
        reflection: Some(Reflection {
            fresnel: false,
            minimum: part,
            maximum: part,
            falloff: 1.0,
            exponent: 1.0,
            metallic: 0.0,
        }),
        seed: false,
        extras: None,
    };
    let pigment = Pigment::Color(Color::WHITE);
    let world = World {
        spheres: vec![Sphere { centre: Vector::ZERO, radius: 1.0 }],
        objects: vec![Object::plain(Shape::Sphere(0))],
        textures: vec![Texture::Plain(Plain { pigment, normal: None, finish })],
        lights: vec![Light {
            kind: LightKind::Point { position: Vector::Y },
            color: Rgb::WHITE,
            casts_shadows: true,
            attenuation: None,
            area: None,
            through: None,
        }],
        ..World::default()
    };
    let origins = Origins {
        objects: vec![site(1)],
        lights: vec![site(20)],
        textures: vec![TextureOrigin {
            pigment: Some(site(9)),
            finish: Some(site(10)),
            sites: vec![
                (TexturePart::Highlights, site(12)),
                (TexturePart::Highlights, site(11)),
                (TexturePart::Highlights, site(12)),
                (TexturePart::Reflection, site(13)),
            ],
        }],
        max_trace_level: Some(site(30)),
        ..Origins::default()
    };
    (world, origins)
}

/// The finish of the lit mirror.
fn finish(world: &mut World) -> &mut Finish {
    match &mut world.textures[0] {
        Texture::Plain(plain) => &mut plain.finish,
        _ => unreachable!("it has one part"),
    }
}

const OPTIONS: PlanOptions = PlanOptions {
    frame: Frame::whole(4, 3),
    antialias: Antialias::Off,
    depth: None,
    adc_bailout: None,
    root_tolerance: 0.0,
    julia_iterations: None,
    light_samples: Samples::Scene,
    blur_samples: Samples::Scene,
    alpha: false,
};

/// Changes the lit mirror and asks why the effect is left out.
fn why_not(effect: Effect, change: impl FnOnce(&mut World)) -> (String, Option<Site>) {
    let (mut world, origins) = lit_mirror();
    change(&mut world);
    let plan = plan(&world, &origins, &OPTIONS);
    assert!(!plan.simulates(effect));
    let left_out = plan.left_out.into_iter().find(|left| left.effect == effect);
    left_out.map(|left| (left.why, left.site)).expect("named")
}

#[test]
fn every_effect_is_either_called_for_or_left_out_with_a_reason() {
    let (world, origins) = lit_mirror();
    let plan = plan(&world, &origins, &OPTIONS);
    for effect in Effect::ALL {
        let left_out = plan.left_out.iter().any(|left| left.effect == effect);
        assert_ne!(plan.simulates(effect), left_out, "{effect:?}");
    }
    let called: Vec<_> = plan.effects.iter().map(|c| (c.effect, c.by.as_slice())).collect();
    let expected: [(Effect, &[Site]); 4] = [
        (Effect::Diffuse, &[site(20)]),
        (Effect::Highlights, &[site(11), site(12)]),
        (Effect::Shadows, &[site(20)]),
        (Effect::Reflection, &[site(13)]),
    ];
    assert_eq!(called, expected);
    let all: Vec<Stage> = Stage::ALL.into_iter().filter(|&stage| stage != Stage::Medium).collect();
    assert_eq!(plan.stages, all);
}

#[test]
fn the_stages_are_those_that_the_effects_need() {
    let (mut world, origins) = lit_mirror();
    world.lights[0].casts_shadows = false;
    let stages = |world: &World| plan(world, &origins, &OPTIONS).stages;
    use Stage::{Camera, Fold, Intersect, Light, Scatter, Surface};
    assert_eq!(stages(&world), [Camera, Intersect, Surface, Light, Scatter, Fold]);
    finish(&mut world).reflection = None;
    assert_eq!(stages(&world), [Camera, Intersect, Surface, Light]);
    world.lights.clear();
    assert_eq!(stages(&world), [Camera, Intersect, Surface]);
}

#[test]
fn shadows_are_left_out_for_the_reason_that_holds() {
    let why = |change: &dyn Fn(&mut World)| why_not(Effect::Shadows, change).0;
    assert_eq!(why(&|w| w.lights.clear()), "no light casts shadows");
    assert_eq!(why(&|w| w.lights[0].casts_shadows = false), "no light casts shadows");
    assert_eq!(why(&|w| w.objects[0].casts_shadow = false), "no object casts a shadow");
    let dull = |w: &mut World| {
        finish(w).diffuse = 0.0;
        finish(w).lobes.clear();
    };
    assert_eq!(why(&dull), "no surface answers a light");
}

#[test]
fn highlights_need_a_lobe_and_a_light_that_makes_them() {
    let why = |change: &dyn Fn(&mut World)| why_not(Effect::Highlights, change).0;
    assert_eq!(why(&|w| finish(w).lobes.clear()), "no surface has a highlight");
    assert_eq!(why(&|w| w.lights[0].casts_shadows = false), "shadowless lights make no highlight");
    let (mut world, origins) = lit_mirror();
    world.lights[0].casts_shadows = false;
    finish(&mut world).seed = true;
    assert!(plan(&world, &origins, &OPTIONS).simulates(Effect::Highlights));
}

#[test]
fn what_lights_and_objects_do_apart_from_the_rest_is_called_for_by_them() {
    assert!(why_not(Effect::Attenuation, |_| {}).0.contains("everywhere in its colour"));
    assert_eq!(why_not(Effect::DoubleIllumination, |_| {}).0, "no object is lit from behind");
    assert_eq!(why_not(Effect::Hiding, |_| {}).0, "every object is seen");
    let fade = crate::world::Fade { distance: 3.0, power: 2.0, signed: false };
    let attenuation = Some(crate::world::Attenuation { beam: None, fade: Some(fade), fog: false });
    let dark = |w: &mut World| {
        w.objects[0].double_illuminate = true;
        w.lights.clear();
    };
    assert_eq!(why_not(Effect::DoubleIllumination, dark).0, "no light");
    let dull = |w: &mut World| {
        w.lights[0].attenuation = attenuation;
        finish(w).diffuse = 0.0;
        finish(w).lobes.clear();
    };
    assert_eq!(why_not(Effect::Attenuation, dull).0, "no surface answers a light");
    let (mut world, mut origins) = lit_mirror();
    world.lights[0].attenuation = attenuation;
    world.objects[0].in_reflections = false;
    world.objects[0].double_illuminate = true;
    (origins.hidden, origins.double_illuminate) = (vec![site(31)], vec![site(32)]);
    origins.attenuation = vec![site(33)];
    let plan = plan(&world, &origins, &OPTIONS);
    let by = |effect| plan.called(effect).map(|called| called.by.clone());
    assert_eq!(by(Effect::Attenuation), Some(vec![site(33)]));
    assert_eq!(by(Effect::Hiding), Some(vec![site(31)]));
    assert_eq!(by(Effect::DoubleIllumination), Some(vec![site(32)]));
}

#[test]
fn reflection_needs_a_surface_that_reflects_and_a_second_level() {
    let dull = |w: &mut World| finish(w).reflection = None;
    assert_eq!(why_not(Effect::Reflection, dull), ("no surface reflects".to_owned(), None));
    let (why, at) = why_not(Effect::Reflection, |w| w.settings.max_trace_level = 0);
    assert_eq!((why.contains("`max_trace_level` is 1"), at), (true, Some(site(30))));
    // The caller's depth overrides the scene's, both ways, and then the scene is not to blame.
    let (mut world, origins) = lit_mirror();
    world.settings.max_trace_level = 1;
    let deep = plan(&world, &origins, &PlanOptions { depth: Some(3), ..OPTIONS });
    assert!(deep.simulates(Effect::Reflection) && deep.max_trace_level == 3);
    let flat = plan(&world, &origins, &PlanOptions { depth: Some(0), ..OPTIONS });
    assert_eq!(flat.max_trace_level, 1);
    let reason = flat.left_out.iter().find(|left| left.effect == Effect::Reflection);
    let reason = reason.expect("named");
    assert_eq!(reason.site, None);
}

#[test]
fn a_sky_and_its_patterns_are_called_for_by_the_sky() {
    let (mut world, mut origins) = lit_mirror();
    let (items, pattern) = (vec![site(40), site(42)], vec![site(43)]);
    origins.sky = Some(SkyOrigin { site: site(41), items, pattern });
    let checker = Pattern {
        source: Source::Kind(Kind::Checker(Checker {})),
        setting: Setting::default(),
        wave: Wave::default(),
    };
    let entries = vec![(0.0, Color::WHITE)];
    let blend = Blend { space: Space::default(), pattern: checker, entries };
    world.sky = Some(Sky { pigments: vec![Pigment::Ramp(Box::new(blend))], emission: Rgb::WHITE });
    let plan = plan(&world, &origins, &OPTIONS);
    let by = |effect| plan.called(effect).map(|called| called.by.clone());
    assert_eq!(by(Effect::Sky), Some(vec![site(40), site(42)]));
    assert_eq!(by(Effect::Patterns), Some(vec![site(43)]));
}

#[test]
fn single_lights_and_what_lowering_dropped_are_listed_with_their_places() {
    let (mut world, mut origins) = lit_mirror();
    world.lights.push(Light { casts_shadows: false, ..world.lights[0] });
    origins.lights.push(site(22));
    origins.dropped.push(Dropped {
        site: site(50),
        what: "light_source".to_owned(),
        why: "its colour is black".to_owned(),
        calls: Vec::new(),
    });
    let plan = plan(&world, &origins, &OPTIONS);
    let sites: Vec<_> = plan.dropped.iter().map(|part| part.site).collect();
    assert_eq!(sites, [site(22), site(50)]);
}
