//! A ray followed through the scene: an explicit chain of surfaces, folded back from the last to
//! the first.
//!
//! **In:** a ray. **Out:** the radiance that comes back along it. **Invariant:** nothing grows on
//! the call stack; colours are folded, never accumulated into a throughput, so a clamp at each
//! surface is possible and every kernel rounds alike. Where a path forks, the mirrored ray is
//! followed first, and the one behind the surface waits on a stack of its own. What is inlined into
//! a kernel is said outright where it is written, so a kernel is the same machine code whichever
//! others stand beside it.

use super::shade::{Flat, Place};
use super::sharpness::Sharpness;
use super::way::{Inside, Way};
use super::{Walk, Watch, extras, reflection, shade, sky, texture};
use crate::color::{Color, Rgb};
use crate::geometry::{self, ANY, Geometry, Hit};
use crate::math::Vector;
use crate::plan::{Effect, Plan};
use crate::shape::{Ray, SurfacePoint};
use crate::world::{Finish, Plain, Texture, World};

/// A World to be traced: nothing in it is without weight, so nothing is asked twice.
pub(super) struct Tracer<'a> {
    pub world: &'a World,
    /// Everything: what stands in the way of light.
    pub geometry: &'a Geometry,
    /// What the camera's rays meet.
    pub in_image: &'a Geometry,
    /// What mirrored rays meet.
    in_reflections: &'a Geometry,
    pub sharpness: Sharpness,
    /// Rays go on behind clear surfaces.
    pub clear: bool,
    /// Of each texture with parts, whether light passes through it anywhere.
    pub clear_composites: Vec<bool>,
    /// Rays change in interiors: they are bent, split or dimmed.
    pub bends: bool,
    /// Interiors dim light.
    pub absorbs: bool,
    /// Light comes through clear surfaces.
    pub filters_shadows: bool,
    pub max_trace_level: u32,
    pub adc_bailout: f64,
    /// Asked within a pixel, where work can pile up.
    pub watch: &'a dyn Watch,
}

/// A surface on a path, waiting for what the ray that goes on from it sees.
#[derive(Debug)]
pub(super) struct Link {
    /// Everything but that.
    pub local: Rgb,
    /// The part of it that comes back.
    pub factor: Rgb,
    pub exponent: f64,
    /// The seed's clamp applies.
    pub seed: bool,
    /// A second ray waits, the last of the walk's forks.
    pub forks: bool,
}

/// A ray that waits behind a surface until the mirrored one has come back.
#[derive(Debug)]
pub(super) struct Fork {
    pub way: Way,
    /// The part of what it sees that comes back.
    pub factor: Rgb,
    pub exponent: f64,
    /// Another ray from the same surface waits.
    pub more: bool,
    /// Where the solids it is in are kept.
    pub media: usize,
}

/// Where a ray meets a surface.
struct Stand<'a> {
    surface: SurfacePoint,
    paint: Color,
    place: Place<'a>,
}

/// A surface that a ray has met.
pub(super) struct Met<'a> {
    pub hit: Hit,
    pub place: Place<'a>,
    pub paint: Color,
    /// Where rays start that go on behind it.
    pub behind: Vector,
    /// What it shows by itself.
    pub local: Rgb,
}

impl<'a> Tracer<'a> {
    pub fn new(
        world: &'a World,
        geometry: &'a Geometry,
        plan: &Plan,
        watch: &'a dyn Watch,
    ) -> Self {
        Self {
            world,
            geometry,
            in_image: geometry.in_image(),
            in_reflections: geometry.in_reflections(),
            sharpness: Sharpness::of(world),
            clear: plan.simulates(Effect::Transparency),
            clear_composites: world
                .textures
                .iter()
                .map(|texture| !matches!(texture, Texture::Plain(_)) && texture.is_clear())
                .collect(),
            bends: [Effect::Refraction, Effect::Absorption, Effect::Dispersion]
                .into_iter()
                .any(|effect| plan.simulates(effect)),
            absorbs: plan.simulates(Effect::Absorption),
            filters_shadows: plan.simulates(Effect::ColoredShadows),
            max_trace_level: plan.max_trace_level,
            adc_bailout: plan.adc_bailout,
            watch,
        }
    }

    /// The radiance seen along a ray of the camera.
    #[inline(never)]
    pub fn seen<
        const SHADOWS: bool,
        const SECONDARY: bool,
        const KINDS: bool,
        const COUNTS: bool,
    >(
        &self,
        walk: &mut Walk,
        ray: Ray,
    ) -> Rgb {
        let hit = self.in_image.nearest_counted::<KINDS>(&ray, &mut walk.counters.work);
        self.radiance::<SHADOWS, SECONDARY, KINDS, COUNTS>(walk, ray, hit)
    }

    /// The radiance seen along a ray of the camera, which meets `first`.
    ///
    /// The weight that `adc_bailout` cuts at is the product of [`reflection::most`] of each surface
    /// that mirrors, and of the largest component of what each surface lets through; of a surface
    /// that lets through less brightness than that, whatever the weight, nothing is followed either,
    /// as in POV-Ray. A seed finish neither lowers the weight nor is cut by it.
    #[inline(never)]
    pub fn radiance<
        const SHADOWS: bool,
        const SECONDARY: bool,
        const KINDS: bool,
        const COUNTS: bool,
    >(
        &self,
        walk: &mut Walk,
        ray: Ray,
        first: Hit,
    ) -> Rgb {
        let mut is_first = true;
        let mut way = Way::from_camera(ray);
        let mut met_by = self.in_image;
        walk.chain.clear();
        if (SECONDARY || SHADOWS) && self.bends {
            walk.media.start(ray.origin);
        }
        loop {
            let mut seen = loop {
                let found = match is_first {
                    true => first,
                    false => met_by.nearest_counted::<KINDS>(&way.ray, &mut walk.counters.work),
                };
                is_first = false;
                let hit = match way.inside {
                    Some(inside) if SECONDARY => self.left(walk, &way, inside, found),
                    Some(_) | None => found,
                };
                if COUNTS {
                    let hidden = !std::ptr::eq(met_by, self.geometry);
                    walk.counters.evaluations.count(self.world, hit.found().as_ref(), hidden);
                }
                if hit.found().is_none() {
                    break sky::seen(self.world, &self.sharpness, way.ray.direction);
                }
                let object = &self.world.objects[hit.object as usize];
                let texture = self.world.coat(object, hit.leaving).texture;
                let Texture::Plain(plain) = &self.world.textures[texture as usize] else {
                    let ends = !SECONDARY || way.level >= self.max_trace_level;
                    let (local, next) = self.composite::<SHADOWS, COUNTS>(walk, way, &hit, ends);
                    let Some(next) = next else { break local };
                    way = next;
                    met_by = self.met_by(&way);
                    continue;
                };
                let Stand { surface, paint, place } = self.stand::<KINDS>(plain, &way.ray, &hit);
                let finish = place.finish;
                let mut local = shade::local::<SHADOWS, KINDS, COUNTS>(self, walk, &place);
                if object.double_illuminate || finish.extras.is_some() {
                    let both = object.double_illuminate;
                    local += self.lit_behind::<SHADOWS, COUNTS>(walk, plain, way.ray, hit, both);
                }
                let clamped = |c: Rgb| if finish.seed { c.at_most_one() } else { c };
                if !SECONDARY || way.level >= self.max_trace_level {
                    break clamped(local);
                }
                if self.parts(finish, &paint) {
                    let behind = place
                        .flat
                        .map_or_else(|| surface.spawn(-place.normal), |Flat { behind, .. }| behind);
                    let met = Met { hit, place, paint, behind, local };
                    let Some(next) = self.part::<COUNTS>(walk, way, &met) else {
                        break clamped(local);
                    };
                    way = next;
                    met_by = self.met_by(&way);
                    continue;
                }
                let Some((weight, link)) = self.mirrored(way.weight, &place, 0.0, local) else {
                    break clamped(local);
                };
                if walk.patience.is_over_after(1, self.watch) {
                    break clamped(local);
                }
                walk.counters.reflection += 1;
                walk.chain.push(link);
                way = way.mirrored(&place, weight);
                met_by = self.in_reflections;
            };
            let forked = 'fold: {
                for (place, link) in walk.chain.iter().enumerate().rev() {
                    let seen_here = reflection::adapted(seen, link.exponent);
                    seen = link.local + reflection::passed_on(link.factor, seen_here);
                    if SECONDARY && link.forks {
                        break 'fold place;
                    }
                    if link.seed {
                        seen = seen.at_most_one();
                    }
                }
                return seen;
            };
            let Some(fork) = walk.forks.pop() else { return seen };
            // What lies behind the surface comes on top, and then the clamp.
            let seed = walk.chain[forked].seed;
            walk.chain.truncate(forked);
            let (exponent, forks) = (fork.exponent, fork.more);
            walk.chain.push(Link { local: seen, factor: fork.factor, exponent, seed, forks });
            way = fork.way;
            met_by = self.met_by(&way);
            if self.bends {
                walk.media.go_on(fork.media);
            }
        }
    }

    /// What a ray meets that starts inside of an object, on its surface: it leaves that first, even where
    /// it starts in an edge, too near to the other face to tell.
    #[inline(always)]
    fn left(&self, walk: &mut Walk, way: &Way, inside: Inside, found: Hit) -> Hit {
        if found.leaving {
            return found;
        }
        let work = &mut walk.counters.work;
        let Inside { object, off } = inside;
        self.met_by(way).left_at_start(&way.ray, object, off, found.t, work).unwrap_or(found)
    }

    /// What there is where a ray meets a surface, on the side it comes from.
    #[inline(always)]
    fn stand<const KINDS: bool>(&self, plain: &'a Plain, ray: &Ray, hit: &Hit) -> Stand<'a> {
        let surface = geometry::surface::<KINDS>(self.world, ray, hit);
        let Plain { normal: bumps, finish, .. } = plain;
        let normal = if hit.leaving { -surface.normal } else { surface.normal };
        let paint = texture::color(self, plain, ray, hit, &surface);
        let origin = surface.spawn(normal);
        let (normal, flat) = match geometry::shading_normal::<KINDS>(self.world, hit, &surface) {
            None => (normal, None),
            Some(smooth) => {
                let behind = surface.spawn(-normal);
                let smooth = if smooth.dot(ray.direction) > 0.0 { -smooth } else { smooth };
                (smooth, Some(Flat { normal, behind }))
            }
        };
        let (normal, flat, smooth) = match bumps {
            None => (normal, flat, None),
            Some(bumps) => {
                let behind =
                    surface.spawn(if hit.leaving { surface.normal } else { -surface.normal });
                let facing = if hit.leaving { -surface.normal } else { surface.normal };
                let flat = flat.unwrap_or(Flat { normal: facing, behind });
                let bumpy = texture::perturbed(self, bumps, normal, (ray, hit, &surface));
                (bumpy, Some(flat), Some(normal))
            }
        };
        let place = Place {
            finish,
            color: paint.rgb,
            body: paint.body(self.world.settings.clearness),
            point: surface.point,
            origin,
            normal,
            flat,
            smooth,
            to_viewer: -ray.direction,
        };
        Stand { surface, paint, place }
    }

    /// What the lights on the other side of a surface add that is lit on `both`, or scatters their light. Such
    /// surfaces are few: all is found once more, and nothing is kept at hand for it elsewhere.
    #[cold]
    #[inline(never)]
    fn lit_behind<const SHADOWS: bool, const COUNTS: bool>(
        &self,
        walk: &mut Walk,
        plain: &'a Plain,
        ray: Ray,
        hit: Hit,
        both: bool,
    ) -> Rgb {
        if !shade::is_lit_behind(&plain.finish, both) {
            return Rgb::BLACK;
        }
        if COUNTS {
            walk.counters.evaluations.from_behind += 1;
        }
        let Stand { surface, place, .. } = self.stand::<ANY>(plain, &ray, &hit);
        let normal = place.flat.map_or(place.normal, |Flat { normal, .. }| normal);
        shade::from_behind::<SHADOWS, COUNTS>(self, walk, &place, surface.spawn(-normal), both)
    }

    /// What a ray under way can meet.
    #[inline(always)]
    pub(super) fn met_by(&self, way: &Way) -> &'a Geometry {
        if way.mirrored { self.in_reflections } else { self.in_image }
    }

    /// Whether what goes on from a surface may be more, or other, than a mirrored ray.
    #[inline(always)]
    fn parts(&self, finish: &Finish, paint: &Color) -> bool {
        (self.clear && paint.is_clear())
            || (self.bends && finish.reflection.as_ref().is_some_and(|r| r.fresnel))
    }

    /// The weight of the mirrored ray, and what it leaves behind; `None` where it is cut or nothing
    /// of what it sees comes back.
    #[inline(always)]
    pub(super) fn mirrored(
        &self,
        weight: f64,
        place: &Place,
        fresnel: f64,
        local: Rgb,
    ) -> Option<(f64, Link)> {
        let reflection = place.finish.reflection.as_ref()?;
        let most = || reflection::most(reflection, fresnel);
        let weight = self.weight(weight, place.finish, most)?;
        let cosine = place.normal.dot(place.to_viewer);
        let factor = reflection::reflectance(reflection, place.color, cosine, fresnel);
        let factor = match &place.finish.extras {
            None => factor,
            Some(extras) => factor * extras::mirrored(extras, place, reflection.exponent),
        };
        let (exponent, seed) = (reflection.exponent, place.finish.seed);
        let link = Link { local, factor, exponent, seed, forks: false };
        (!factor.is_black()).then_some((weight, link))
    }

    /// The weight of a ray that brings back a part of what it sees; `None` where it is cut.
    #[inline(always)]
    pub(super) fn weight(
        &self,
        weight: f64,
        finish: &Finish,
        part: impl Fn() -> f64,
    ) -> Option<f64> {
        if finish.seed {
            return Some(weight);
        }
        let weight = weight * part();
        let cut = weight < self.adc_bailout;
        (!cut).then_some(weight)
    }
}

/// The old factor of what is seen through a surface.
pub(super) fn passed(finish: &Finish) -> f64 {
    finish.extras.as_ref().map_or(1.0, |extras| extras.passed)
}

impl Link {
    /// Of a ray of which `factor` comes back as it is.
    pub(super) fn behind(local: Rgb, factor: Rgb, seed: bool) -> Self {
        Self { local, factor, exponent: 1.0, seed, forks: false }
    }
}
