//! Decides which effects a World calls for.
//!
//! **In:** [`World`], its [`Origins`], what the caller asks. **Out:** [`Plan`]. **Invariant:** an
//! effect is left out only when it could not change a bit of the film: its weight is exactly
//! zero, or nothing by its own flags can take part in it. No guess about what is visible.

use super::numerics::numerics;
use super::{Antialias, Called, Effect, Kernel, LeftOut, Plan, PlanOptions, Precision};
use crate::shape::Shape;
use crate::source::Site;
use crate::world::{Dropped, Light, Material, MaterialOrigin, Origins, Pigment, World};

/// Lists every effect the picture needs with what called for it, and every one it does not need
/// with the reason.
pub fn plan(world: &World, origins: &Origins, options: &PlanOptions) -> Plan {
    // As POV-Ray: 0 still follows the camera's ray.
    let max_trace_level = options.depth.unwrap_or(world.settings.max_trace_level).max(1);
    let census = Census { world, origins, options, max_trace_level };
    let mut plan = Plan {
        frame: options.frame,
        antialias: options.antialias,
        max_trace_level,
        adc_bailout: options.adc_bailout.unwrap_or(world.settings.adc_bailout),
        precision: options.precision,
        kernel: Kernel { shadows: false, secondary: false },
        effects: Vec::new(),
        left_out: Vec::new(),
        dropped: census.dropped(),
        numerics: numerics(world, origins),
        pilot: None,
    };
    for effect in Effect::ALL {
        match census.decide(effect) {
            Ok((mut by, cost)) => {
                by.sort_by_key(|site| (site.span, site.expansion));
                by.dedup_by_key(|site| site.span);
                plan.effects.push(Called { effect, by, cost, rays: None });
            }
            Err((why, site)) => plan.left_out.push(LeftOut { effect, why, site }),
        }
    }
    plan.kernel = Kernel {
        shadows: plan.simulates(Effect::Shadows),
        secondary: plan.simulates(Effect::Reflection) || plan.simulates(Effect::Transparency),
    };
    plan
}

/// Who called and what it costs, or why not and where that is said.
type Decision = Result<(Vec<Site>, String), (String, Option<Site>)>;

fn because<T>(why: &str, site: Option<Site>) -> Result<T, (String, Option<Site>)> {
    Err((why.to_owned(), site))
}

/// What there is, and what the caller wants of it.
///
/// Of several conditions of an effect, the one that the author wrote down calls for it: a light for what
/// every surface answers by default, a surface's own word for the rest.
struct Census<'a> {
    world: &'a World,
    origins: &'a Origins,
    options: &'a PlanOptions,
    max_trace_level: u32,
}

impl Census<'_> {
    fn decide(&self, effect: Effect) -> Decision {
        match effect {
            Effect::Diffuse => self.diffuse(),
            Effect::Highlights => self.highlights(),
            Effect::Shadows => self.shadows(),
            Effect::Reflection => self.reflection(),
            Effect::Transparency => self.transparency(),
            Effect::Refraction => self.refraction(),
            Effect::ColoredShadows => self.colored_shadows(),
            Effect::Patterns => self.patterns(),
            Effect::Sky => self.sky(),
            Effect::Antialiasing => antialiasing(self.options.antialias),
        }
    }

    fn diffuse(&self) -> Decision {
        if self.world.lights.is_empty() {
            return because("no light", None);
        }
        if !self.world.materials.iter().any(scatters) {
            return because("no surface scatters light", None);
        }
        Ok((self.lights(|_| true), "one cosine a light and hit".to_owned()))
    }

    fn highlights(&self) -> Decision {
        if self.world.lights.is_empty() {
            return because("no light", None);
        }
        if !self.world.materials.iter().any(shines) {
            return because("no surface has a highlight", None);
        }
        let casting = self.world.lights.iter().any(|light| light.casts_shadows);
        let lit = |m: &Material| shines(m) && (m.finish.seed || casting);
        if !self.world.materials.iter().any(lit) {
            return because("shadowless lights make no highlight", None);
        }
        let by = self.materials(lit, |origin| &origin.highlights);
        Ok((by, "one power a lobe, light and hit".to_owned()))
    }

    fn shadows(&self) -> Decision {
        if self.world.lights.is_empty() {
            return because("no light", None);
        }
        if !self.world.lights.iter().any(|light| light.casts_shadows) {
            return because("all lights are shadowless", None);
        }
        if !self.world.materials.iter().any(|m| scatters(m) || shines(m)) {
            return because("no surface answers a light", None);
        }
        if !self.world.objects.iter().any(|object| object.casts_shadow) {
            return because("no object casts a shadow", None);
        }
        let by = self.lights(|light| light.casts_shadows);
        Ok((by, "one ray a casting light and lit hit".to_owned()))
    }

    fn reflection(&self) -> Decision {
        if !self.world.materials.iter().any(reflects) {
            return because("no surface reflects", None);
        }
        self.goes_on()?;
        let cost = format!("up to {} rays a camera ray", self.max_trace_level - 1);
        Ok((self.materials(reflects, |origin| &origin.reflection), cost))
    }

    fn transparency(&self) -> Decision {
        if !self.world.materials.iter().any(is_clear) {
            return because("no surface is clear", None);
        }
        self.goes_on()?;
        let cost = "a ray behind each clear surface, and a path of its own where that mirrors, too";
        Ok((self.materials(is_clear, |origin| &origin.clear), cost.to_owned()))
    }

    fn refraction(&self) -> Decision {
        if self.world.interiors.is_empty() {
            return because("every object is filled with air", None);
        }
        self.goes_on()?;
        let by = self.origins.interiors.iter().flatten().copied().collect();
        Ok((by, "one root a clear surface, and a list of what a ray is in".to_owned()))
    }

    fn colored_shadows(&self) -> Decision {
        self.shadows()?;
        let mut filters = vec![false; self.world.materials.len()];
        for object in self.world.objects.iter().filter(|object| object.casts_shadow) {
            let material = object.material as usize;
            filters[material] = is_clear(&self.world.materials[material]);
        }
        let calling = self.origins.materials.iter().zip(&filters).filter(|(_, filters)| **filters);
        let by: Vec<Site> = calling.flat_map(|(origin, _)| &origin.clear).copied().collect();
        if !filters.contains(&true) {
            return because("no clear object casts a shadow", None);
        }
        Ok((by, "one more search a ray toward a light that nothing opaque stops".to_owned()))
    }

    /// Whether any ray goes on from a surface.
    fn goes_on(&self) -> Result<(), (String, Option<Site>)> {
        if self.max_trace_level > 1 {
            return Ok(());
        }
        let site = self.origins.max_trace_level.filter(|_| self.options.depth.is_none());
        because("`max_trace_level` is 1: a ray ends at the first surface", site)
    }

    fn patterns(&self) -> Decision {
        let patterned = |pigment: &Pigment| matches!(pigment, Pigment::Patterned { .. });
        let in_sky = self.world.sky.iter().any(|sky| sky.pigments.iter().any(patterned));
        if !in_sky && !self.world.materials.iter().any(|m| patterned(&m.pigment)) {
            return because("every colour is constant", None);
        }
        let mut by = self.materials(|m| patterned(&m.pigment), |origin| &origin.pattern);
        let sky = self.origins.sky.iter().filter(|_| in_sky);
        by.extend(sky.flat_map(|sky| &sky.pattern));
        Ok((by, "one pattern and one map entry a hit".to_owned()))
    }

    fn sky(&self) -> Decision {
        let origin = self.origins.sky.as_ref();
        match &self.world.sky {
            Some(sky) if !sky.pigments.is_empty() => {
                let cost = format!("{} a ray that leaves", count(sky.pigments.len(), "pigment"));
                Ok((origin.map_or(Vec::new(), |sky| sky.items.clone()), cost))
            }
            Some(_) => because("the sky has no pigment", origin.map(|sky| sky.site)),
            None => because("no `sky_sphere`", None),
        }
    }

    /// What lowering dropped, and what single lights lack.
    fn dropped(&self) -> Vec<Dropped> {
        let shadowless = self.world.lights.iter().zip(&self.origins.lights);
        let shadowless = shadowless.filter(|(light, _)| !light.casts_shadows);
        let mut dropped: Vec<_> = shadowless
            .map(|(_, &site)| Dropped {
                site,
                what: "shadows and highlights of one light".to_owned(),
                why: "it is shadowless".to_owned(),
            })
            .collect();
        dropped.dedup_by_key(|part| part.site.span);
        if self.options.precision == Precision::Single {
            dropped.extend(self.without_single_precision());
        }
        dropped.extend(self.origins.dropped.iter().cloned());
        dropped
    }

    /// The first shape that is met in double precision all the same.
    fn without_single_precision(&self) -> Option<Dropped> {
        let objects = self.world.objects.iter().zip(&self.origins.objects);
        let mut ellipsoids =
            objects.filter(|(object, _)| matches!(object.shape, Shape::Ellipsoid(_)));
        ellipsoids.next().map(|(_, &site)| Dropped {
            site,
            what: "single precision of ellipsoids".to_owned(),
            why: "they have no kernel for it".to_owned(),
        })
    }

    /// Where the lights that call stand.
    fn lights(&self, calls: impl Fn(&Light) -> bool) -> Vec<Site> {
        let lights = self.world.lights.iter().zip(&self.origins.lights);
        lights.filter(|(light, _)| calls(light)).map(|(_, &site)| site).collect()
    }

    /// What gave the materials that call one of their parts.
    fn materials(
        &self,
        calls: impl Fn(&Material) -> bool,
        part: impl Fn(&MaterialOrigin) -> &Vec<Site>,
    ) -> Vec<Site> {
        let materials = self.world.materials.iter().zip(&self.origins.materials);
        let calling = materials.filter(|(material, _)| calls(material));
        calling.flat_map(|(_, origin)| part(origin)).copied().collect()
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
    !material.finish.lobes.is_empty()
}

fn reflects(material: &Material) -> bool {
    material.finish.reflection.is_some()
}

fn is_clear(material: &Material) -> bool {
    material.pigment.is_clear()
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
    use crate::world::{Finish, LightKind, Lobe, LobeKind, Object, Reflection, Sky, SkyOrigin};

    fn site(place: usize) -> Site {
        Site { span: Span::new(FileId(0), place, place + 1), expansion: ExpansionId::MAIN }
    }

    /// A mirroring, shining sphere (material called for at 10) under a lamp (at 20).
    fn lit_mirror() -> (World, Origins) {
        let part = Rgb::gray(0.5);
        let lobe = Lobe { kind: LobeKind::Phong, weight: 0.5, exponent: 9.0, metallic: 0.0 };
        let finish = Finish {
            conserve_energy: false,
            glow: Rgb::BLACK,
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
        };
        let world = World {
            spheres: vec![Sphere { centre: Vector::ZERO, radius: 1.0 }],
            objects: vec![Object {
                interior: None,
                shape: Shape::Sphere(0),
                material: 0,
                texture_from_world: None,
                faces: None,
                casts_shadow: true,
                in_image: true,
                in_reflections: true,
                double_illuminate: false,
                inverse: false,
            }],
            materials: vec![Material { pigment: Pigment::Color(Color::WHITE), finish }],
            lights: vec![Light {
                kind: LightKind::Point { position: Vector::Y },
                color: Rgb::WHITE,
                casts_shadows: true,
                attenuation: None,
            }],
            ..World::default()
        };
        let origins = Origins {
            objects: vec![site(1)],
            lights: vec![site(20)],
            materials: vec![MaterialOrigin {
                clear: vec![],
                pigment: Some(site(9)),
                finish: Some(site(10)),
                pattern: vec![],
                highlights: vec![site(12), site(11), site(12)],
                reflection: vec![site(13)],
            }],
            max_trace_level: Some(site(30)),
            ..Origins::default()
        };
        (world, origins)
    }

    const OPTIONS: PlanOptions = PlanOptions {
        frame: Frame::whole(4, 3),
        antialias: Antialias::Off,
        depth: None,
        adc_bailout: None,
        precision: Precision::Double,
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
        assert_eq!(plan.kernel, Kernel::EVERYTHING);
    }

    #[test]
    fn the_kernel_has_what_the_effects_need() {
        let (mut world, origins) = lit_mirror();
        world.lights[0].casts_shadows = false;
        let kernel = plan(&world, &origins, &OPTIONS).kernel;
        assert_eq!(kernel, Kernel { shadows: false, secondary: true });
        world.materials[0].finish.reflection = None;
        assert_eq!(plan(&world, &origins, &OPTIONS).kernel.name(), "bare");
    }

    #[test]
    fn shadows_are_left_out_for_the_reason_that_holds() {
        let why = |change: &dyn Fn(&mut World)| why_not(Effect::Shadows, change).0;
        assert_eq!(why(&|w| w.lights.clear()), "no light");
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
        assert_eq!(why(&|w| w.materials[0].finish.lobes.clear()), "no surface has a highlight");
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
        let dull = |w: &mut World| w.materials[0].finish.reflection = None;
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
        world.sky = Some(Sky {
            pigments: vec![Pigment::Patterned {
                pattern: crate::pattern::Pattern::Checker,
                pattern_from_texture: crate::math::placement::Map::IDENTITY,
                map: vec![(0.0, Color::WHITE)],
            }],
        });
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
        });
        let plan = plan(&world, &origins, &OPTIONS);
        let sites: Vec<_> = plan.dropped.iter().map(|part| part.site).collect();
        assert_eq!(sites, [site(22), site(50)]);
    }
}
