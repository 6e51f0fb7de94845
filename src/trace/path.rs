//! A ray followed through the scene: an explicit chain of surfaces, folded back from the last to
//! the first.
//!
//! **In:** a ray. **Out:** the radiance that comes back along it. **Invariant:** nothing grows on
//! the call stack; colours are folded, never accumulated into a throughput, so a clamp at each
//! surface is possible and every kernel rounds alike. Where a path forks, the mirrored ray is
//! followed first, and the one behind the surface waits on a stack of its own. What is inlined into
//! a kernel is said outright where it is written, so a kernel is the same machine code whichever
//! others stand beside it.

use super::media::Border;
use super::shade::{Flat, Place};
use super::sharpness::Sharpness;
use super::way::{Inside, Way};
use super::{Walk, Watch, pigment, reflection, refraction, shade, sky};
use crate::color::{Color, Rgb};
use crate::geometry::{self, ANY, Geometry, Hit};
use crate::math::Vector;
use crate::plan::{Effect, Plan};
use crate::shape::{Ray, SurfacePoint};
use crate::world::{Finish, Material, Pigment, World};

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
    /// Rays go on behind clear surfaces.
    pub clear: bool,
    /// Interiors have indices of refraction.
    pub bends: bool,
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
    local: Rgb,
    /// The part of it that comes back.
    factor: Rgb,
    exponent: f64,
    /// The seed's clamp applies.
    seed: bool,
    /// A second ray waits, the last of the walk's forks.
    forks: bool,
}

/// A ray that waits behind a surface until the mirrored one has come back.
#[derive(Debug)]
pub(super) struct Fork {
    way: Way,
    /// The part of what it sees that comes back.
    factor: Rgb,
    /// Where the solids it is in are kept.
    media: usize,
}

/// Where a ray meets a surface.
struct Stand<'a> {
    surface: SurfacePoint,
    paint: Color,
    place: Place<'a>,
}

/// A surface that a ray has met.
struct Met<'a> {
    hit: Hit,
    place: Place<'a>,
    paint: Color,
    /// Where rays start that go on behind it.
    behind: Vector,
    /// What it shows by itself.
    local: Rgb,
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
            bends: plan.simulates(Effect::Refraction),
            filters_shadows: plan.simulates(Effect::ColoredShadows),
            max_trace_level: plan.max_trace_level,
            adc_bailout: plan.adc_bailout,
            watch,
        }
    }

    /// The radiance seen along `ray`.
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
    ) -> Rgb {
        let mut way = Way::from_camera(ray);
        let mut met_by = self.in_image;
        walk.chain.clear();
        if SECONDARY && self.bends {
            walk.media.start(ray.origin);
        }
        loop {
            let mut seen = loop {
                let found = met_by.nearest_counted::<KINDS>(&way.ray, &mut walk.counters.work);
                let found = match way.inside {
                    Some(inside) if SECONDARY => self.left(walk, &way, inside, found),
                    Some(_) | None => found,
                };
                if COUNTS {
                    let hidden = !std::ptr::eq(met_by, self.geometry);
                    walk.counters.evaluations.count(self.world, found.as_ref(), hidden);
                }
                let Some(hit) = found else {
                    break sky::seen(self.world, &self.sharpness, way.ray.direction);
                };
                let Stand { surface, paint, place } = self.stand::<KINDS>(&way.ray, &hit);
                let finish = place.finish;
                let mut local = shade::local::<SHADOWS, KINDS, COUNTS>(self, walk, &place);
                if self.world.objects[hit.object as usize].double_illuminate {
                    local += self.lit_behind::<SHADOWS, COUNTS>(walk, way.ray, hit);
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
            walk.chain.push(Link::behind(seen, fork.factor, seed));
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
    fn left(&self, walk: &mut Walk, way: &Way, inside: Inside, found: Option<Hit>) -> Option<Hit> {
        if found.is_some_and(|hit| hit.leaving) {
            return found;
        }
        let limit = found.map_or(f64::INFINITY, |hit| hit.t);
        let work = &mut walk.counters.work;
        let Inside { object, off } = inside;
        self.met_by(way).left_at_start(&way.ray, object, off, limit, work).or(found)
    }

    /// What there is where a ray meets a surface, on the side it comes from.
    #[inline(always)]
    fn stand<const KINDS: bool>(&self, ray: &Ray, hit: &Hit) -> Stand<'a> {
        let surface = geometry::surface::<KINDS>(self.world, ray, hit);
        let object = &self.world.objects[hit.object as usize];
        let Material { pigment, finish } = &self.world.materials[object.material as usize];
        let normal = if hit.leaving { -surface.normal } else { surface.normal };
        let paint = pigment::on_surface(self, pigment, ray, hit, &surface);
        let origin = surface.spawn(normal);
        let (normal, flat) = match geometry::shading_normal::<KINDS>(self.world, hit, &surface) {
            None => (normal, None),
            Some(smooth) => {
                let behind = surface.spawn(-normal);
                let smooth = if smooth.dot(ray.direction) > 0.0 { -smooth } else { smooth };
                (smooth, Some(Flat { normal, behind }))
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
            to_viewer: -ray.direction,
        };
        Stand { surface, paint, place }
    }

    /// What the lights on the other side of a surface add that is lit from both. Such surfaces are
    /// few: all is found once more, and nothing is kept at hand for it elsewhere.
    #[cold]
    #[inline(never)]
    fn lit_behind<const SHADOWS: bool, const COUNTS: bool>(
        &self,
        walk: &mut Walk,
        ray: Ray,
        hit: Hit,
    ) -> Rgb {
        if COUNTS {
            walk.counters.evaluations.from_behind += 1;
        }
        let Stand { surface, place, .. } = self.stand::<ANY>(&ray, &hit);
        let normal = place.flat.map_or(place.normal, |Flat { normal, .. }| normal);
        shade::from_behind::<SHADOWS, COUNTS>(self, walk, &place, surface.spawn(-normal))
    }

    /// What a ray under way can meet.
    #[inline(always)]
    fn met_by(&self, way: &Way) -> &'a Geometry {
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
    fn mirrored(
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
        let (exponent, seed) = (reflection.exponent, place.finish.seed);
        let link = Link { local, factor, exponent, seed, forks: false };
        (!factor.is_black()).then_some((weight, link))
    }

    /// The weight of a ray that brings back a part of what it sees; `None` where it is cut.
    #[inline(always)]
    fn weight(&self, weight: f64, finish: &Finish, part: impl Fn() -> f64) -> Option<f64> {
        if finish.seed {
            return Some(weight);
        }
        let weight = weight * part();
        let cut = weight < self.adc_bailout;
        (!cut).then_some(weight)
    }

    /// Goes on from a surface that is clear, or mirrors by Fresnel's equations: what it lets through
    /// goes on behind it, what it mirrors before it, and if both are, that behind it waits. `None`
    /// where nothing goes on, or where the watch wants no more: then nor does any ray that waits.
    ///
    /// Where nothing can go through, what is mirrored has the weight of what else would have gone
    /// through, and comes back whole, in the place of the finish's own reflection.
    /// `max_trace_level` does not count a surface that a ray goes straight through, between equal
    /// indices of refraction.
    ///
    /// **Source:** POV-Ray 3.7's behaviour, measured to 1/65,535.
    #[inline(never)]
    fn part<const COUNTS: bool>(&self, walk: &mut Walk, way: Way, met: &Met) -> Option<Way> {
        let Met { ref hit, ref place, paint, local, .. } = *met;
        let seed = place.finish.seed;
        let clear = self.clear && paint.is_clear();
        if walk.patience.is_over_after(1, self.watch) {
            walk.forks.clear();
            return None;
        }
        walk.coinciding.clear();
        if clear && hit.contested {
            let straight = Ray { origin: met.behind, direction: way.ray.direction };
            let Walk { coinciding, counters, .. } = walk;
            let work = &mut counters.work;
            self.met_by(&way).coinciding(&way.ray, hit, &straight, coinciding, work);
        }
        if COUNTS {
            walk.counters.evaluations.refraction += u64::from(self.bends);
        }
        let Border { from, to } = match self.bends {
            true => walk.media.border(self.world, hit, &walk.coinciding),
            false => Border::NONE,
        };
        let bent = refraction::bent(way.ray.direction, place.normal, from, to);
        let fresnel = bent.map_or(1.0, |bent| refraction::fresnel(from, to, bent.cosines));
        let through = match clear {
            true => self.through(&way, met, &walk.coinciding, fresnel),
            false => None,
        };
        let behind = match (through, bent) {
            (Some((weight, _)), None) => {
                walk.counters.total_reflection += 1;
                walk.chain.push(Link::behind(local, Rgb::WHITE, seed));
                let inside = hit.leaving.then(|| Inside::of(hit));
                return Some(Way { inside, ..way.mirrored(place, weight) });
            }
            (Some((weight, factor)), Some(bent)) => {
                walk.counters.transmission += 1;
                let ray = Ray { origin: met.behind, direction: bent.direction };
                let level = if from == to { way.level } else { way.level + 1 };
                let inside = (from != to && !hit.leaving).then(|| Inside::of(hit));
                Some((Way { ray, weight, level, inside, ..way }, factor))
            }
            (None, _) => None,
        };
        match (self.mirrored(way.weight, place, fresnel, local), behind) {
            (None, None) => None,
            (None, Some((behind, factor))) => {
                walk.chain.push(Link::behind(local, factor, seed));
                walk.media.go_through();
                Some(behind)
            }
            (Some((weight, link)), behind) => {
                walk.counters.reflection += 1;
                walk.chain.push(Link { forks: behind.is_some(), ..link });
                if let Some((way, factor)) = behind {
                    let media = walk.media.wait_behind();
                    walk.forks.push(Fork { way, factor, media });
                }
                let inside = (from != to && hit.leaving).then(|| Inside::of(hit));
                Some(Way { inside, ..way.mirrored(place, weight) })
            }
        }
    }

    /// The weight of the ray behind a clear surface and the part of what it sees that comes back;
    /// `None` where it is cut or nothing comes back.
    fn through(
        &self,
        way: &Way,
        met: &Met,
        coinciding: &[Hit],
        fresnel: f64,
    ) -> Option<(f64, Rgb)> {
        let Place { finish, color, normal, to_viewer, .. } = met.place;
        let own = met.paint.transmittance();
        let others = coinciding.iter().map(|hit| self.transmittance(&way.ray, hit));
        let mut factor = others.fold(own, |factor, other| factor * other);
        if finish.conserve_energy
            && let Some(reflection) = &finish.reflection
        {
            let cosine = normal.dot(to_viewer);
            let mirrored = reflection::reflectance(reflection, color, cosine, fresnel);
            factor = factor * mirrored.map(|part| 1.0 - part);
        }
        let weight = self.weight(way.weight, finish, || factor.largest())?;
        let too_dark = !finish.seed && factor.brightness().abs() < self.adc_bailout;
        (!too_dark && !factor.is_black()).then_some((weight, factor))
    }

    /// What the surface at `hit` lets through of the light behind it.
    pub fn transmittance(&self, ray: &Ray, hit: &Hit) -> Rgb {
        let object = &self.world.objects[hit.object as usize];
        let color = match &self.world.materials[object.material as usize].pigment {
            Pigment::Color(color) => *color,
            patterned @ (Pigment::Patterned { .. } | Pigment::Faces(_)) => {
                let surface = geometry::surface::<ANY>(self.world, ray, hit);
                pigment::on_surface(self, patterned, ray, hit, &surface)
            }
        };
        color.transmittance()
    }
}

impl Link {
    /// Of a ray of which `factor` comes back as it is.
    fn behind(local: Rgb, factor: Rgb, seed: bool) -> Self {
        Self { local, factor, exponent: 1.0, seed, forks: false }
    }
}
