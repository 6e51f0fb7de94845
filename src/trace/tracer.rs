//! What the stages of a frame share: the World, what rays meet, and which stages run.

use super::Watch;
use super::area::Panel;
use super::batch::SLICE;
use super::media::Around;
use super::sharpness::Sharpness;
use super::traits::Traits;
use super::way::Way;
use crate::geometry::Geometry;
use crate::plan::{Effect, Plan, Stage};
use crate::world::{Finish, Light, Texture, World};

/// A World to be traced: nothing in it is without weight, so nothing is asked twice.
pub(super) struct Tracer<'a> {
    pub world: &'a World,
    /// Everything: what stands in the way of light.
    pub geometry: &'a Geometry,
    /// What the camera's rays meet.
    in_image: &'a Geometry,
    /// What mirrored rays meet.
    in_reflections: &'a Geometry,
    pub sharpness: Sharpness,
    /// Of each light that has an area, where its light comes from.
    pub panels: Vec<Option<Panel>>,
    /// Surfaces are lit.
    pub lights: bool,
    /// All lights are points or directions, and light everything.
    pub lights_are_plain: bool,
    /// Rays go toward lights.
    pub shadows: bool,
    /// Rays go on from surfaces.
    pub secondary: bool,
    /// Rays go on behind clear surfaces.
    pub clear: bool,
    /// Of each texture with parts, whether light passes through it anywhere.
    pub clear_composites: Vec<bool>,
    /// Of each plain texture.
    pub traits: Vec<Traits>,
    /// Rays change in interiors: they are bent, split or dimmed.
    pub bends: bool,
    /// What rays are in is followed: interiors change them, or fog and rainbows do not fill all solids.
    pub follows_media: bool,
    /// What the camera may be in, if that is followed.
    around: Around,
    /// Fog or rainbows veil what rays meet.
    pub has_fog: bool,
    /// How much of each pixel is not the background is asked for.
    pub has_alpha: bool,
    /// Interiors dim light.
    pub absorbs: bool,
    /// Light comes through clear surfaces.
    pub filters_shadows: bool,
    /// Surfaces that are shaded together: fewer where each may send on many rays.
    pub slice: usize,
    /// Evaluations are counted.
    pub counts: bool,
    pub max_trace_level: u32,
    pub adc_bailout: f64,
    /// Asked within a batch, where work can pile up.
    pub watch: &'a dyn Watch,
}

impl<'a> Tracer<'a> {
    pub fn new(
        world: &'a World,
        geometry: &'a Geometry,
        plan: &Plan,
        watch: &'a dyn Watch,
    ) -> Self {
        let bends = (plan.runs(Stage::Shadow) || plan.runs(Stage::Scatter))
            && [Effect::Refraction, Effect::Absorption, Effect::Dispersion]
                .into_iter()
                .any(|effect| plan.simulates(effect));
        let has_fog = plan.runs(Stage::Medium);
        let fills_all = world.objects.iter().all(|object| object.hollow);
        let follows_media = bends || (has_fog && !fills_all);
        Self {
            world,
            geometry,
            in_image: geometry.in_image(),
            in_reflections: geometry.in_reflections(),
            sharpness: Sharpness::of(world),
            panels: panels(world, plan),
            lights: plan.runs(Stage::Light),
            lights_are_plain: world.light_sets.is_empty()
                && world.lights.iter().all(Light::is_plain),
            shadows: plan.runs(Stage::Shadow),
            secondary: plan.runs(Stage::Scatter),
            clear: plan.simulates(Effect::Transparency),
            clear_composites: world
                .textures
                .iter()
                .map(|texture| !matches!(texture, Texture::Plain(_)) && texture.is_clear())
                .collect(),
            traits: world
                .textures
                .iter()
                .map(|texture| match texture {
                    Texture::Plain(plain) => Traits::of(plain, bends),
                    _ => Traits::default(),
                })
                .collect(),
            bends,
            follows_media,
            around: if follows_media { Around::of(world) } else { Around::default() },
            has_fog,
            has_alpha: plan.alpha,
            absorbs: plan.simulates(Effect::Absorption),
            filters_shadows: plan.runs(Stage::Shadow) && plan.simulates(Effect::ColoredShadows),
            slice: slice(world),
            counts: geometry.counts(),
            max_trace_level: plan.max_trace_level,
            adc_bailout: plan.adc_bailout,
            watch,
        }
    }

    /// The World, and what the camera may be in.
    pub fn solids(&self) -> (&'a World, &Around) {
        (self.world, &self.around)
    }

    /// What the camera's rays and what mirrored rays can meet.
    pub fn met(&self) -> [&'a Geometry; 2] {
        [self.in_image, self.in_reflections]
    }

    /// What a ray under way can meet.
    #[inline(always)]
    pub fn met_by(&self, way: &Way) -> &'a Geometry {
        if way.mirrored { self.in_reflections } else { self.in_image }
    }

    /// The weight of a ray that brings back a part of what it sees; `None` where it is cut.
    ///
    /// The weight that `adc_bailout` cuts at is the product of [`most`](super::reflection::most) of each surface that
    /// mirrors, and of the largest component of what each surface lets through; of a surface that lets through less
    /// brightness than that, whatever the weight, nothing is followed either, as in POV-Ray. A seed finish neither
    /// lowers the weight nor is cut by it.
    #[inline(always)]
    pub fn weight(&self, weight: f64, finish: &Finish, part: impl Fn() -> f64) -> Option<f64> {
        if finish.seed {
            return Some(weight);
        }
        let weight = weight * part();
        let cut = weight < self.adc_bailout;
        (!cut).then_some(weight)
    }
}

fn panels(world: &World, plan: &Plan) -> Vec<Option<Panel>> {
    let lights = world.lights.iter().enumerate();
    lights.map(|(number, light)| Panel::new(number, light, plan.light_samples)).collect()
}

/// How many surfaces are shaded together, where dispersion may split a ray at each of them.
fn slice(world: &World) -> usize {
    let samples = world.interiors.iter().filter_map(|interior| interior.dispersion);
    let most = samples.map(|dispersion| dispersion.samples as usize).max().unwrap_or(1);
    (4 * SLICE / most.max(1)).clamp(1, SLICE)
}
