//! Decides which effects a World requires.
//!
//! **In:** [`World`], its [`Origins`], the caller's options. **Out:** [`Plan`]. **Invariant:** an effect is
//! left out only if it cannot change a bit of the film: its weight is exactly zero, or flags exclude
//! everything from it. Visibility is not estimated.

mod haze;
mod kept_light;

use super::dropped::dropped;
use super::kinds::kinds;
use super::numerics::numerics;
use super::print::count;
use super::surfaces::surfaces;
use super::{Antialias, Called, Effect, LeftOut, Plan, PlanOptions, Samples, Stage};
use crate::source::Site;
use crate::world::{
    Area, Interior, InteriorOrigin, Light, Object, Origins, Pigment, Plain, Texture, TexturePart,
    World,
};

/// Lists every effect the picture needs with what requires it, and every effect it does not need with the
/// reason.
pub fn plan(world: &World, origins: &Origins, options: &PlanOptions) -> Plan {
    // As POV-Ray: 0 still follows the camera's ray.
    let max_trace_level = options.depth.unwrap_or(world.settings.max_trace_level).max(1);
    let census = Census { world, origins, options, max_trace_level };
    let mut plan = Plan {
        frame: options.frame,
        antialias: match world.camera.focus {
            Some(_) => Antialias::Off,
            None => options.antialias,
        },
        max_trace_level,
        adc_bailout: options.adc_bailout.unwrap_or(world.settings.adc_bailout),
        root_tolerance: options.root_tolerance,
        julia_iterations: options.julia_iterations,
        light_samples: options.light_samples,
        blur_samples: options.blur_samples,
        alpha: options.alpha,
        stages: Vec::new(),
        effects: Vec::new(),
        left_out: Vec::new(),
        dropped: dropped(world, origins),
        numerics: numerics(world, origins),
        kinds: kinds(world, origins),
        surfaces: surfaces(origins),
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
    let scatters = plan.simulates(Effect::Reflection) || plan.simulates(Effect::Transparency);
    plan.stages = Stage::ALL.to_vec();
    plan.stages.retain(|stage| match stage {
        Stage::Camera | Stage::Intersect | Stage::Surface => true,
        Stage::Medium => world.has_haze(),
        Stage::Light => !world.lights.is_empty(),
        Stage::Shadow => plan.effects.iter().any(|called| called.effect == Effect::Shadows),
        Stage::Scatter | Stage::Fold => scatters,
    });
    plan
}

/// The locations that require an effect and its cost, or the reason it is off and where the scene says so.
type Decision = Result<(Vec<Site>, String), (String, Option<Site>)>;

/// Returns what samples cost, where they are not as the scene says.
fn sampled(samples: Samples, of: &str) -> Option<String> {
    match samples {
        Samples::Scene => None,
        Samples::Fixed(n) => Some(format!("{} a {of}", count(n as usize, "ray"))),
        Samples::Adaptive { most, .. } => {
            Some(format!("up to {} a {of}", count(most as usize, "ray")))
        }
    }
}

fn because<T>(why: &str, site: Option<Site>) -> Result<T, (String, Option<Site>)> {
    Err((why.to_owned(), site))
}

/// The World's contents and the caller's options, against which each effect is checked.
///
/// If an effect has several conditions, the reported cause is the one the author wrote down: a light for
/// effects that surfaces show by default, otherwise a property of the surface.
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
            Effect::Attenuation => self.attenuation(),
            Effect::AreaLights => self.area_lights(),
            Effect::Projections => self.projections(),
            Effect::LightGroups => self.light_groups(),
            Effect::DoubleIllumination => self.double_illumination(),
            Effect::Reflection => self.reflection(),
            Effect::Transparency => self.transparency(),
            Effect::Refraction => self.refraction(),
            Effect::Absorption => self.absorption(),
            Effect::Dispersion => self.dispersion(),
            Effect::ColoredShadows => self.colored_shadows(),
            Effect::Patterns => self.patterns(),
            Effect::Hiding => self.hiding(),
            Effect::Sky => self.sky(),
            Effect::FocalBlur => self.focal_blur(),
            Effect::CameraNormal => self.camera_normal(),
            Effect::Antialiasing if self.world.camera.focus.is_some() => {
                because("the rays of focal blur are spread over the pixel", self.origins.aperture)
            }
            Effect::Fog => self.fog(),
            Effect::Rainbows => self.rainbows(),
            Effect::Antialiasing => antialiasing(self.options.antialias),
        }
    }

    fn diffuse(&self) -> Decision {
        if self.world.lights.is_empty() {
            return because("no light", None);
        }
        if !self.any(scatters) {
            return because("no surface scatters light", None);
        }
        Ok((self.lights(|_| true), "one cosine a light and hit".to_owned()))
    }

    fn highlights(&self) -> Decision {
        if !self.any(shines) {
            return because("no surface has a highlight", None);
        }
        if self.world.lights.is_empty() {
            return because("no light", None);
        }
        let casting = self.world.lights.iter().any(|light| light.casts_shadows);
        let lit = |plain: &Plain| shines(plain) && (plain.finish.seed || casting);
        if !self.any(lit) {
            return because("shadowless lights make no highlight", None);
        }
        let by = self.textures(|texture| texture.any(lit), TexturePart::Highlights);
        Ok((by, "one power a lobe, light and hit".to_owned()))
    }

    fn shadows(&self) -> Decision {
        if !self.world.lights.iter().any(|light| light.casts_shadows) {
            return because("no light casts shadows", None);
        }
        if !self.any(|plain| scatters(plain) || shines(plain)) {
            return because("no surface answers a light", None);
        }
        if !self.world.objects.iter().any(|object| object.casts_shadow) {
            return because("no object casts a shadow", None);
        }
        let by = self.lights(|light| light.casts_shadows);
        Ok((by, "one ray a casting light and lit hit".to_owned()))
    }

    fn attenuation(&self) -> Decision {
        let attenuated = |light: &Light| light.attenuation.is_some();
        if !self.world.lights.iter().any(attenuated) {
            return because("every light shines everywhere in its colour", None);
        }
        if !self.any(|plain| scatters(plain) || shines(plain)) {
            return because("no surface answers a light", None);
        }
        Ok((self.origins.attenuation.clone(), "up to three powers a light and hit".to_owned()))
    }

    fn area_lights(&self) -> Decision {
        let areas = || self.world.lights.iter().filter_map(|light| light.area.as_ref());
        if areas().next().is_none() {
            return because("every light is a point or a direction", None);
        }
        if !self.any(|plain| scatters(plain) || shines(plain)) {
            return because("no surface answers a light", None);
        }
        let all = |area: &Area| area.nodes.into_iter().map(u64::from).product::<u64>();
        let least = |area: &Area| {
            let divided = |count: u32| u64::from(count).min((1 << area.least_divisions) + 1);
            area.nodes.into_iter().map(divided).product::<u64>()
        };
        if let Some(cost) = sampled(self.options.light_samples, "light and lit hit") {
            return Ok((self.origins.area_lights.clone(), cost));
        }
        let most = areas().map(all).max().unwrap_or(1);
        let cost = match areas().map(least).min().unwrap_or(1) {
            least if least < most => format!("{least} to {most} rays a light and lit hit"),
            _ => format!("{most} rays a light and lit hit"),
        };
        Ok((self.origins.area_lights.clone(), cost))
    }

    fn double_illumination(&self) -> Decision {
        let is_lit = self.world.objects.iter().any(|object| object.double_illuminate);
        if !is_lit && !self.any(scatters_behind) {
            return because("no object is lit from behind", None);
        }
        if self.world.lights.is_empty() {
            return because("no light", None);
        }
        let mut by = self.origins.double_illuminate.clone();
        by.extend(self.textures(|texture| texture.any(scatters_behind), TexturePart::Behind));
        Ok((by, "light for hits that face away from it".to_owned()))
    }

    fn hiding(&self) -> Decision {
        if self.world.objects.iter().all(|object| object.in_image && object.in_reflections) {
            return because("every object is seen", None);
        }
        let hides = |seen: fn(&Object) -> bool| !self.world.objects.iter().all(seen);
        let both = hides(|object| object.in_image) && hides(|object| object.in_reflections);
        let cost = match both {
            true => "two more acceleration structures",
            false => "one more acceleration structure",
        };
        Ok((self.origins.hidden.clone(), cost.to_owned()))
    }

    fn reflection(&self) -> Decision {
        self.goes_on()?;
        if !self.any(reflects) {
            return because("no surface reflects", None);
        }
        // If paths fork at transparent surfaces, there are more rays than the depth.
        let forks = self.world.textures.iter().any(Texture::is_clear);
        let what = if forks { "surfaces deep" } else { "rays a camera ray" };
        let cost = format!("up to {} {what}", self.max_trace_level - 1);
        Ok((self.textures(|texture| texture.any(reflects), TexturePart::Reflection), cost))
    }

    fn transparency(&self) -> Decision {
        self.goes_on()?;
        if !self.world.textures.iter().any(Texture::is_clear) {
            return because("no surface is clear", None);
        }
        let cost = "a ray behind each clear surface, and a path of its own where that mirrors, too";
        Ok((self.textures(Texture::is_clear, TexturePart::Clear), cost.to_owned()))
    }

    fn refraction(&self) -> Decision {
        self.goes_on()?;
        if self.world.interiors.is_empty() {
            return because("every object is filled with air", None);
        }
        // An interior with the index of air only matters next to another index.
        let bends = |interior: &Interior| interior.ior != 1.0 || interior.dispersion.is_some();
        if !self.world.interiors.iter().any(bends) {
            return because("no interior has an `ior` other than 1", None);
        }
        let by = self.interiors(bends, |origin| &origin.ior);
        Ok((by, "one root a clear surface, a list of what a ray is in, and a ray where all light is thrown back".to_owned()))
    }

    fn absorption(&self) -> Decision {
        let absorbs = |interior: &Interior| interior.absorption.is_some();
        if !self.world.interiors.iter().any(absorbs) {
            return because("no light fades in an interior", None);
        }
        if self.transparency().is_err() {
            self.colored_shadows()?;
        }
        let by = self.interiors(absorbs, |origin| &origin.absorption);
        Ok((by, "three powers a surface through which a ray leaves".to_owned()))
    }

    fn dispersion(&self) -> Decision {
        let disperses = |interior: &Interior| interior.dispersion.is_some();
        if !self.world.interiors.iter().any(disperses) {
            return because("every interior bends all colours alike", None);
        }
        self.transparency()?;
        let by = self.interiors(disperses, |origin| &origin.dispersion);
        Ok((by, "a ray for each colour".to_owned()))
    }

    fn colored_shadows(&self) -> Decision {
        if !self.world.lights.iter().any(|light| light.casts_shadows) {
            return because("no light casts shadows", None);
        }
        let mut filters = vec![false; self.world.textures.len()];
        for object in self.world.objects.iter().filter(|object| object.casts_shadow) {
            let lining = object.lining.map(|lining| self.world.linings[lining as usize].texture);
            for texture in [Some(object.texture), lining].into_iter().flatten() {
                filters[texture as usize] = self.world.textures[texture as usize].is_clear();
            }
        }
        let calling = self.origins.textures.iter().zip(&filters).filter(|(_, filters)| **filters);
        let by: Vec<Site> =
            calling.flat_map(|(origin, _)| origin.of(TexturePart::Filter)).collect();
        if !filters.contains(&true) {
            return because("no clear object casts a shadow", None);
        }
        self.shadows()?;
        Ok((by, "one more search a ray toward a light that nothing opaque stops".to_owned()))
    }

    /// Returns whether any ray continues from a surface.
    fn goes_on(&self) -> Result<(), (String, Option<Site>)> {
        if self.max_trace_level > 1 {
            return Ok(());
        }
        let site = self.origins.max_trace_level.filter(|_| self.options.depth.is_none());
        because("`max_trace_level` is 1: a ray ends at the first surface", site)
    }

    fn patterns(&self) -> Decision {
        let in_sky =
            self.world.sky.iter().any(|sky| sky.pigments.iter().any(Pigment::is_patterned));
        if !in_sky && !self.world.textures.iter().any(Texture::is_patterned) {
            return because("every colour is constant", None);
        }
        let mut by = self.textures(Texture::is_patterned, TexturePart::Pattern);
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
            Some(_) | None => match origin {
                Some(sky) => because("the sky has no pigment", Some(sky.site)),
                None => because("no `sky_sphere`", None),
            },
        }
    }

    fn focal_blur(&self) -> Decision {
        let Some(focus) = &self.world.camera.focus else {
            return because("everything is in focus", None);
        };
        let cost = match (focus.least, focus.most) {
            (least, most) if least == most => format!("{most} rays a pixel"),
            (least, most) => format!("{least} to {most} rays a pixel"),
        };
        let cost = sampled(self.options.blur_samples, "pixel").unwrap_or(cost);
        Ok((self.origins.aperture.into_iter().collect(), cost))
    }

    fn camera_normal(&self) -> Decision {
        if self.world.camera.normal.is_none() {
            return because("the camera has no `normal`", None);
        }
        Ok((self.origins.camera_normal.into_iter().collect(), "one normal a camera ray".to_owned()))
    }

    /// Returns the locations of the lights selected by `calls`.
    fn lights(&self, calls: impl Fn(&Light) -> bool) -> Vec<Site> {
        let lights = self.world.lights.iter().zip(&self.origins.lights);
        lights.filter(|(light, _)| calls(light)).map(|(_, site)| *site).collect()
    }

    /// Returns whether any part of a texture is as `suits` tests.
    fn any(&self, suits: impl Fn(&Plain) -> bool) -> bool {
        self.world.textures.iter().any(|texture| texture.any(&suits))
    }

    /// Returns the locations that gave the selected interiors one of their parts.
    fn interiors(
        &self,
        calls: impl Fn(&Interior) -> bool,
        part: impl Fn(&InteriorOrigin) -> &Vec<Site>,
    ) -> Vec<Site> {
        let interiors = self.world.interiors.iter().zip(&self.origins.interiors);
        let calling = interiors.filter(|(interior, _)| calls(interior));
        calling.flat_map(|(_, origin)| part(origin)).copied().collect()
    }

    /// Returns the locations that gave the selected textures one of their parts.
    fn textures(&self, calls: impl Fn(&Texture) -> bool, part: TexturePart) -> Vec<Site> {
        let textures = self.world.textures.iter().zip(&self.origins.textures);
        let calling = textures.filter(|(texture, _)| calls(texture));
        calling.flat_map(|(_, origin)| origin.of(part)).collect()
    }
}

fn antialiasing(antialias: Antialias) -> Decision {
    let cost = match antialias {
        Antialias::Off => return because("one ray through each pixel's centre was asked", None),
        Antialias::Grid(n) => format!("{n} × {n} rays a pixel"),
        Antialias::Adaptive { grid, .. } => {
            format!("up to {grid} × {grid} rays a pixel near an edge")
        }
    };
    Ok((Vec::new(), cost))
}

fn scatters(plain: &Plain) -> bool {
    plain.finish.diffuse != 0.0 || scatters_behind(plain)
}

fn scatters_behind(plain: &Plain) -> bool {
    plain.finish.extras.as_ref().is_some_and(|extras| extras.behind != 0.0)
}

fn shines(plain: &Plain) -> bool {
    !plain.finish.lobes.is_empty()
}

fn reflects(plain: &Plain) -> bool {
    plain.finish.reflection.is_some()
}

#[cfg(test)]
mod tests;
