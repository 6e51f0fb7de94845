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
    let max_trace_level = options.depth.unwrap_or(world.settings.max_trace_level);
    let mut plan = Plan {
        frame: options.frame,
        antialias: options.antialias,
        max_trace_level,
        adc_bailout: world.settings.adc_bailout,
        effects: Vec::new(),
        left_out: Vec::new(),
    };
    let census = Census { world, origins };
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
}

impl Census<'_> {
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
        Ok((self.material_sites(scatters), "one cosine a light and hit".to_owned()))
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
        Ok((self.material_sites(lit), "one power a lobe, light and hit".to_owned()))
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
            let why = format!("only {} is followed", surfaces(plan.max_trace_level));
            return because(&why, site);
        }
        let cost = format!("up to {} more rays a camera ray", plan.max_trace_level - 1);
        Ok((self.material_sites(reflects), cost))
    }

    fn patterns(&self) -> Decision {
        let patterned = |pigment: &Pigment| matches!(pigment, Pigment::Patterned { .. });
        let in_sky = self.world.sky.iter().any(|sky| sky.pigments.iter().any(patterned));
        if !in_sky && !self.materials().any(|(_, m)| patterned(&m.pigment)) {
            return because("every colour is constant", None);
        }
        let mut by = self.material_sites(|m| patterned(&m.pigment));
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
            what: "part of the scene".to_owned(),
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

    fn material_sites(&self, calls: impl Fn(&Material) -> bool) -> Vec<Site> {
        let calling = self.materials().filter(|(_, material)| calls(material));
        calling.filter_map(|(i, _)| self.origins.materials.get(i).copied().flatten()).collect()
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

fn surfaces(levels: u32) -> String {
    if levels == 0 { "no surface".to_owned() } else { count(levels as usize, "surface") }
}
