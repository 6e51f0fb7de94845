//! How much work a picture was: rays by what sent them, what finding what they meet took, and how often
//! each effect was evaluated.
//!
//! **Invariant:** depends on World, Plan and pixels alone. Rays are always counted; work and evaluations
//! where that is asked for, by kernels of their own: one that does not count has not an instruction for it.

use std::ops::AddAssign;

use crate::geometry::{Hit, Work};
use crate::world::{Pigment, World};

/// Numbers of rays and evaluations.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Counters {
    /// Rays from the camera.
    pub camera: u64,
    /// Rays toward lights.
    pub shadow: u64,
    /// Rays that a finish mirrors.
    pub reflection: u64,
    /// Rays that go on behind a clear surface.
    pub transmission: u64,
    /// Rays that a clear surface mirrors whole, where nothing can go through.
    pub total_reflection: u64,
    /// What it took to find what they meet; nothing where it was not to be counted.
    pub work: Work,
    /// Likewise.
    pub evaluations: Evaluations,
}

impl Counters {
    /// Of every kind.
    pub fn rays(&self) -> u64 {
        self.camera + self.shadow + self.reflection + self.transmission + self.total_reflection
    }
}

impl AddAssign for Counters {
    fn add_assign(&mut self, other: Self) {
        self.camera += other.camera;
        self.shadow += other.shadow;
        self.reflection += other.reflection;
        self.transmission += other.transmission;
        self.total_reflection += other.total_reflection;
        self.work += other.work;
        self.evaluations += other.evaluations;
    }
}

/// How often each effect was evaluated that sends no rays of its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Evaluations {
    /// Lights whose light a surface scatters.
    pub diffuse: u64,
    /// Lobes that answer a light.
    pub highlights: u64,
    /// Lights that are less than their colour somewhere, asked what of it comes to a place.
    pub attenuation: u64,
    /// Area lights, asked what of their shadows falls on a place.
    pub area_lights: u64,
    /// Ways to a light, searched for the object that it shines through.
    pub projections: u64,
    /// Lights of groups, asked whether they light an object.
    pub light_groups: u64,
    /// Surfaces asked what the lights on their other side add.
    pub from_behind: u64,
    /// Borders between media, asked where a ray goes on.
    pub refraction: u64,
    /// Ways through an interior that dims light, up to where it is left.
    pub absorption: u64,
    /// Rays split into their colours.
    pub dispersion: u64,
    /// Ways to a light, searched for what lets a part of it through.
    pub colored_shadows: u64,
    /// Patterns of surfaces and of the sky.
    pub patterns: u64,
    /// Rays that do not meet all there is.
    pub hiding: u64,
    /// Pigments of the sky.
    pub sky: u64,
    /// Rays through a lens that blurs.
    pub focal_blur: u64,
    /// Rays through a camera's normal.
    pub camera_normal: u64,
    /// Fogs on the ways of rays.
    pub fog: u64,
    /// Rainbows on the ways of rays.
    pub rainbows: u64,
}

impl Evaluations {
    /// What a ray evaluates that has found something, or leaves, whatever the lights are; `hidden` where it
    /// did not look at all there is.
    pub(super) fn count(&mut self, world: &World, found: Option<&Hit>, hidden: bool) {
        self.hiding += u64::from(hidden);
        let patterned = |pigment: &&Pigment| pigment.is_patterned();
        match found {
            Some(hit) => {
                let texture = world.coat(&world.objects[hit.object as usize], hit.leaving).texture;
                self.patterns += u64::from(world.textures[texture as usize].is_patterned());
            }
            None => {
                let pigments = || world.sky.iter().flat_map(|sky| &sky.pigments);
                self.sky += pigments().count() as u64;
                self.patterns += pigments().filter(patterned).count() as u64;
            }
        }
    }
}

impl AddAssign for Evaluations {
    fn add_assign(&mut self, other: Self) {
        self.diffuse += other.diffuse;
        self.highlights += other.highlights;
        self.attenuation += other.attenuation;
        self.area_lights += other.area_lights;
        self.projections += other.projections;
        self.light_groups += other.light_groups;
        self.from_behind += other.from_behind;
        self.refraction += other.refraction;
        self.absorption += other.absorption;
        self.dispersion += other.dispersion;
        self.colored_shadows += other.colored_shadows;
        self.patterns += other.patterns;
        self.hiding += other.hiding;
        self.sky += other.sky;
        self.focal_blur += other.focal_blur;
        self.camera_normal += other.camera_normal;
        self.fog += other.fog;
        self.rainbows += other.rainbows;
    }
}
