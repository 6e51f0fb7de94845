//! Decides which effects a World calls for.
//!
//! **In:** [`World`], its [`Origins`], what the caller asks. **Out:** [`Plan`]. **Invariant:** an
//! effect is left out only when it could not change a bit of the film: its weight is exactly
//! zero, or nothing by its own flags can take part in it. No guess about what is visible.

use super::{Antialias, Called, Effect, LeftOut, Plan, PlanOptions};
use crate::source::Site;
use crate::world::{Light, Material, Origins, Pigment, World};

/// Lists every effect the picture needs with what called for it, and every one it does not need
/// with the reason.
pub fn plan(world: &World, origins: &Origins, options: &PlanOptions) -> Plan {
    // As POV-Ray: 0 still follows the camera's ray.
    let max_trace_level = options.depth.unwrap_or(world.settings.max_trace_level).max(1);
    let mut plan = Plan {
        frame: options.frame,
        antialias: options.antialias,
        max_trace_level,
        adc_bailout: world.settings.adc_bailout,
        effects: Vec::new(),
        left_out: Vec::new(),
    };
    let census = Census::new(world, origins);
    for effect in Effect::ALL {
        match census.decide(effect, &plan, options) {
            Ok((by, cost)) => plan.effects.push(Called { effect, by, cost }),
            Err((why, site)) => {
                plan.left_out.push(LeftOut { what: effect.name().to_owned(), why, site });
            }
        }
    }
    census.single_parts(&mut plan);
    plan
}

/// Who called and what it costs, or why not and where that is said.
type Decision = Result<(Vec<Site>, String), (String, Option<Site>)>;

fn because<T>(why: &str, site: Option<Site>) -> Result<T, (String, Option<Site>)> {
    Err((why.to_owned(), site))
}

struct Census<'a> {
    world: &'a World,
    origins: &'a Origins,
    /// What called for each material's pigment: where it was written, else the first object that has it.
    pigments: Vec<Option<Site>>,
    /// The same of its finish.
    finishes: Vec<Option<Site>>,
}

impl<'a> Census<'a> {
    fn new(world: &'a World, origins: &'a Origins) -> Self {
        let origin = |i| origins.materials.get(i).copied().unwrap_or_default();
        let count = world.materials.len();
        let mut pigments: Vec<_> = (0..count).map(|i| origin(i).pigment).collect();
        let mut finishes: Vec<_> = (0..count).map(|i| origin(i).finish).collect();
        for (object, site) in world.objects.iter().zip(&origins.objects) {
            pigments[object.material as usize].get_or_insert(*site);
            finishes[object.material as usize].get_or_insert(*site);
        }
        Self { world, origins, pigments, finishes }
    }

    fn decide(&self, effect: Effect, plan: &Plan, options: &PlanOptions) -> Decision {
        match effect {
            Effect::Diffuse => self.diffuse(),
            Effect::Highlights => self.highlights(),
            Effect::Shadows => self.shadows(),
            Effect::Reflection => self.reflection(plan, options),
            Effect::Patterns => self.patterns(),
            Effect::Sky => self.sky(),
            Effect::Antialiasing => antialiasing(plan.antialias),
        }
    }

    fn diffuse(&self) -> Decision {
        if self.lights().next().is_none() {
            return because("no light", None);
        }
        if !self.materials().any(|(_, m)| scatters(m)) {
            return because("no surface scatters light", None);
        }
        Ok((self.sites(&self.finishes, scatters), "one cosine a light and hit".to_owned()))
    }

    fn highlights(&self) -> Decision {
        if self.lights().next().is_none() {
            return because("no light", None);
        }
        if !self.materials().any(|(_, m)| shines(m)) {
            return because("no surface has a highlight", None);
        }
        let lit = |m: &Material| {
            shines(m) && self.lights().any(|(_, light)| m.finish.seed || light.casts_shadows)
        };
        if !self.materials().any(|(_, m)| lit(m)) {
            return because("shadowless lights make no highlight", None);
        }
        Ok((self.sites(&self.finishes, lit), "one power a lobe, light and hit".to_owned()))
    }

    fn shadows(&self) -> Decision {
        if self.lights().next().is_none() {
            return because("no light", None);
        }
        if !self.lights().any(|(_, light)| light.casts_shadows) {
            return because("all lights are shadowless", None);
        }
        if !self.materials().any(|(_, m)| scatters(m) || shines(m)) {
            return because("no surface answers a light", None);
        }
        if !self.world.objects.iter().any(|object| object.casts_shadow) {
            return because("no object casts a shadow", None);
        }
        let casting = self.lights().filter(|(_, light)| light.casts_shadows);
        let by = casting.filter_map(|(i, _)| self.origins.lights.get(i).copied()).collect();
        Ok((by, "one shadow ray a casting light and lit hit".to_owned()))
    }

    fn reflection(&self, plan: &Plan, options: &PlanOptions) -> Decision {
        if !self.materials().any(|(_, m)| reflects(m)) {
            return because("no surface reflects", None);
        }
        if plan.max_trace_level <= 1 {
            let site = self.origins.max_trace_level.filter(|_| options.depth.is_none());
            return because("`max_trace_level` is 1: a ray ends at the first surface", site);
        }
        let cost = format!("up to {} more rays a camera ray", plan.max_trace_level - 1);
        Ok((self.sites(&self.finishes, reflects), cost))
    }

    fn patterns(&self) -> Decision {
        let patterned = |pigment: &Pigment| matches!(pigment, Pigment::Patterned { .. });
        let in_sky = self.world.sky.iter().any(|sky| sky.pigments.iter().any(patterned));
        if !in_sky && !self.materials().any(|(_, m)| patterned(&m.pigment)) {
            return because("every colour is constant", None);
        }
        let mut by = self.sites(&self.pigments, |m| patterned(&m.pigment));
        by.extend(self.origins.sky.filter(|_| in_sky));
        Ok((by, "one pattern and one map entry a hit".to_owned()))
    }

    fn sky(&self) -> Decision {
        match &self.world.sky {
            Some(sky) if !sky.pigments.is_empty() => {
                let cost = format!("{} a ray that leaves", count(sky.pigments.len(), "pigment"));
                Ok((self.origins.sky.into_iter().collect(), cost))
            }
            Some(_) => because("the sky has no pigment", self.origins.sky),
            None => because("no `sky_sphere`", None),
        }
    }

    /// What single lights and lowering leave out.
    fn single_parts(&self, plan: &mut Plan) {
        for (i, light) in self.world.lights.iter().enumerate() {
            let site = self.origins.lights.get(i).copied();
            let mut leave_out = |what: &str, why: &str| {
                plan.left_out.push(LeftOut { what: what.to_owned(), why: why.to_owned(), site });
            };
            if light.color.is_black() {
                leave_out("light", "its colour is black");
            } else if !light.casts_shadows {
                leave_out("shadows and highlights of one light", "it is shadowless");
            }
        }
        plan.left_out.extend(self.origins.dropped.iter().map(|dropped| LeftOut {
            what: dropped.what.clone(),
            why: dropped.why.clone(),
            site: Some(dropped.site),
        }));
    }

    /// The lights that shine, with their places in `World::lights`.
    fn lights(&self) -> impl Iterator<Item = (usize, &Light)> {
        self.world.lights.iter().enumerate().filter(|(_, light)| !light.color.is_black())
    }

    fn materials(&self) -> impl Iterator<Item = (usize, &Material)> {
        self.world.materials.iter().enumerate()
    }

    /// The sites of the materials that call, from one of the lists of sites.
    fn sites(&self, of: &[Option<Site>], calls: impl Fn(&Material) -> bool) -> Vec<Site> {
        let calling = self.materials().filter(|(_, material)| calls(material));
        calling.filter_map(|(i, _)| of[i]).collect()
    }
}

fn antialiasing(antialias: Antialias) -> Decision {
    let cost = match antialias {
        Antialias::Off => return because("one ray through each pixel's centre was asked", None),
        Antialias::Grid(n) => format!("{n} × {n} rays a pixel"),
        Antialias::Adaptive { grid, .. } => format!("{grid} × {grid} rays a pixel on an edge"),
    };
    Ok((Vec::new(), cost))
}

fn scatters(material: &Material) -> bool {
    material.finish.diffuse != 0.0
}

fn shines(material: &Material) -> bool {
    material.finish.lobes.iter().any(|lobe| lobe.weight != 0.0)
}

fn reflects(material: &Material) -> bool {
    let reflection = material.finish.reflection.as_ref();
    reflection.is_some_and(|r| !(r.minimum.is_black() && r.maximum.is_black()))
}

fn count(n: usize, noun: &str) -> String {
    if n == 1 { format!("1 {noun}") } else { format!("{n} {noun}s") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::{Color, Rgb};
    use crate::math::Vector;
    use crate::plan::Frame;
    use crate::shape::{Shape, Sphere};
    use crate::source::{ExpansionId, FileId, Span};
    use crate::world::{
        Dropped, Finish, LightKind, Lobe, LobeKind, MaterialOrigin, Object, Reflection, Sky,
    };

    fn site(place: usize) -> Site {
        Site { span: Span::new(FileId(0), place, place + 1), expansion: ExpansionId::MAIN }
    }

    /// A mirroring, shining sphere (material called for at 10) under a lamp (at 20).
    fn lit_mirror() -> (World, Origins) {
        let part = Rgb::gray(0.5);
        let lobe = Lobe { kind: LobeKind::Phong, weight: 0.5, exponent: 9.0, metallic: 0.0 };
        let finish = Finish {
            glow: Rgb::BLACK,
            diffuse: 0.5,
            brilliance: 1.0,
            lobes: vec![lobe],
            reflection: Some(Reflection {
                minimum: part,
                maximum: part,
                falloff: 1.0,
                exponent: 1.0,
                metallic: 0.0,
            }),
            seed: false,
        };
        let world = World {
            spheres: vec![Sphere { centre: Vector::ZERO, radius: 1.0 }],
            objects: vec![Object {
                shape: Shape::Sphere(0),
                material: 0,
                texture_from_world: None,
                faces: None,
                casts_shadow: true,
                inverse: false,
            }],
            materials: vec![Material { pigment: Pigment::Color(Color::WHITE), finish }],
            lights: vec![Light {
                kind: LightKind::Point { position: Vector::Y },
                color: Rgb::WHITE,
                casts_shadows: true,
            }],
            ..World::default()
        };
        let origins = Origins {
            objects: vec![site(1)],
            lights: vec![site(20)],
            materials: vec![MaterialOrigin { pigment: Some(site(9)), finish: Some(site(10)) }],
            max_trace_level: Some(site(30)),
            ..Origins::default()
        };
        (world, origins)
    }

    const OPTIONS: PlanOptions =
        PlanOptions { frame: Frame::whole(4, 3), antialias: Antialias::Off, depth: None };

    /// Changes the lit mirror and asks why the effect is left out.
    fn why_not(effect: Effect, change: impl FnOnce(&mut World)) -> (String, Option<Site>) {
        let (mut world, origins) = lit_mirror();
        change(&mut world);
        let plan = plan(&world, &origins, &OPTIONS);
        assert!(!plan.simulates(effect));
        let left_out = plan.left_out.into_iter().find(|left| left.what == effect.name());
        left_out.map(|left| (left.why, left.site)).expect("named")
    }

    #[test]
    fn every_effect_is_either_called_for_or_left_out_with_a_reason() {
        let (world, origins) = lit_mirror();
        let plan = plan(&world, &origins, &OPTIONS);
        for effect in Effect::ALL {
            let left_out = plan.left_out.iter().any(|left| left.what == effect.name());
            assert_ne!(plan.simulates(effect), left_out, "{effect:?}");
        }
        let called: Vec<_> = plan.effects.iter().map(|c| (c.effect, c.by.as_slice())).collect();
        let expected: [(Effect, &[Site]); 4] = [
            (Effect::Diffuse, &[site(10)]),
            (Effect::Highlights, &[site(10)]),
            (Effect::Shadows, &[site(20)]),
            (Effect::Reflection, &[site(10)]),
        ];
        assert_eq!(called, expected);
    }

    #[test]
    fn a_material_nobody_wrote_is_called_for_by_the_first_object_that_has_it() {
        let (mut world, mut origins) = lit_mirror();
        world.objects.push(world.objects[0]);
        origins.objects.push(site(2));
        origins.materials = vec![MaterialOrigin::default()];
        assert_eq!(plan(&world, &origins, &OPTIONS).effects[0].by, [site(1)]);
    }

    #[test]
    fn shadows_are_left_out_for_the_reason_that_holds() {
        let why = |change: &dyn Fn(&mut World)| why_not(Effect::Shadows, change).0;
        assert_eq!(why(&|w| w.lights.clear()), "no light");
        assert_eq!(why(&|w| w.lights[0].color = Rgb::BLACK), "no light");
        assert_eq!(why(&|w| w.lights[0].casts_shadows = false), "all lights are shadowless");
        assert_eq!(why(&|w| w.objects[0].casts_shadow = false), "no object casts a shadow");
        let dull = |w: &mut World| {
            w.materials[0].finish.diffuse = 0.0;
            w.materials[0].finish.lobes.clear();
        };
        assert_eq!(why(&dull), "no surface answers a light");
    }

    #[test]
    fn highlights_need_a_lobe_and_a_light_that_makes_them() {
        let why = |change: &dyn Fn(&mut World)| why_not(Effect::Highlights, change).0;
        assert_eq!(
            why(&|w| w.materials[0].finish.lobes[0].weight = 0.0),
            "no surface has a highlight"
        );
        assert_eq!(
            why(&|w| w.lights[0].casts_shadows = false),
            "shadowless lights make no highlight"
        );
        let (mut world, origins) = lit_mirror();
        world.lights[0].casts_shadows = false;
        world.materials[0].finish.seed = true;
        assert!(plan(&world, &origins, &OPTIONS).simulates(Effect::Highlights));
    }

    #[test]
    fn reflection_needs_a_surface_that_reflects_and_a_second_level() {
        let black = |w: &mut World| {
            let reflection = w.materials[0].finish.reflection.as_mut().expect("one");
            (reflection.minimum, reflection.maximum) = (Rgb::BLACK, Rgb::BLACK);
        };
        assert_eq!(why_not(Effect::Reflection, black), ("no surface reflects".to_owned(), None));
        let (why, at) = why_not(Effect::Reflection, |w| w.settings.max_trace_level = 0);
        assert_eq!((why.contains("`max_trace_level` is 1"), at), (true, Some(site(30))));
        // The caller's depth overrides the scene's, both ways, and then the scene is not to blame.
        let (mut world, origins) = lit_mirror();
        world.settings.max_trace_level = 1;
        let deep = plan(&world, &origins, &PlanOptions { depth: Some(3), ..OPTIONS });
        assert!(deep.simulates(Effect::Reflection) && deep.max_trace_level == 3);
        let flat = plan(&world, &origins, &PlanOptions { depth: Some(0), ..OPTIONS });
        assert_eq!(flat.max_trace_level, 1);
        let reason = flat.left_out.iter().find(|left| left.what == "reflection").expect("named");
        assert_eq!(reason.site, None);
    }

    #[test]
    fn a_sky_and_its_patterns_are_called_for_by_the_sky() {
        let (mut world, mut origins) = lit_mirror();
        origins.sky = Some(site(40));
        world.sky = Some(Sky {
            pigments: vec![Pigment::Patterned {
                pattern: crate::pattern::Pattern::Checker,
                pattern_from_texture: crate::math::placement::Map::IDENTITY,
                map: vec![(0.0, Color::WHITE)],
            }],
        });
        let plan = plan(&world, &origins, &OPTIONS);
        for effect in [Effect::Sky, Effect::Patterns] {
            let called = plan.effects.iter().find(|called| called.effect == effect);
            assert_eq!(called.map(|called| called.by.clone()), Some(vec![site(40)]));
        }
    }

    #[test]
    fn single_lights_and_what_lowering_dropped_are_listed_with_their_places() {
        let (mut world, mut origins) = lit_mirror();
        world.lights.push(Light { color: Rgb::BLACK, ..world.lights[0] });
        world.lights.push(Light { casts_shadows: false, ..world.lights[0] });
        origins.lights.extend([site(21), site(22)]);
        origins.dropped.push(Dropped {
            site: site(50),
            what: "light_source".to_owned(),
            why: "its colour is black".to_owned(),
        });
        let plan = plan(&world, &origins, &OPTIONS);
        let sites = plan.left_out.iter().filter_map(|left| left.site);
        assert_eq!(sites.collect::<Vec<_>>(), [site(21), site(22), site(50)]);
    }
}
