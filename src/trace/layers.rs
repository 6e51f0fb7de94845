//! Textures with parts: layers, and blends of textures over a pattern.
//!
//! **In:** a ray, and where it hits such a texture. **Out:** the light that the surface sends back by itself, and
//! the rays that go on: one for each part that reflects, and one behind the surface.
//!
//! Layers are walked from the top down. Each shows its own light, weighted by what the layers above let through;
//! it reflects by its own finish alone. A blend shows both of its textures by their weights.
//!
//! **Source:** POV-Ray 3.7's behaviour, measured with random stacks of layers to 2/65,535.

use super::area::Ground;
use super::batch::{Back, Onward};
use super::layered::Known;
use super::media::Border;
use super::parts::Surface;
use super::shade::{self, Flat, Place};
use super::texture::SurfaceInteraction;
use super::tracer::Tracer;
use super::way::{Inside, Way};
use super::{Walk, behind, bumpy, dispersion, extras, reflection, refraction};
use crate::color::Rgb;
use crate::geometry::{self, Hit};
use crate::math::Vector;
use crate::shape::Ray;
use crate::world::Texture;
use smallvec::SmallVec;

/// The light behind a stack that is not opaque.
struct Open {
    /// The stack's share in the blends around it.
    share: f64,
    factor: Rgb,
    weight: f64,
    /// The normal that bends it: the top layer's.
    top: Vector,
}

impl<'a> Tracer<'a> {
    /// Returns the light that a texture with parts sends back by itself, and adds the rays that go on to the walk's;
    /// what they see goes back `to` the surface of that number.
    #[inline(never)]
    pub(super) fn composite(
        &self,
        walk: &mut Walk,
        way: &Way,
        hit: &Hit,
        to: u32,
        known: Known<'a, '_>,
    ) -> Rgb {
        let ends = !self.secondary || way.level >= self.max_trace_level;
        let world = self.world;
        let object = &world.objects[hit.object as usize];
        let number = world.coat(object, hit.leaving).texture as usize;
        let texture = &world.textures[number];
        let point = geometry::surface(world, &way.ray, hit);
        let facing = if hit.leaving { -point.normal } else { point.normal };
        let behind = point.spawn(-facing);
        let (normal, flat) = match geometry::shading_normal(world, hit, &point) {
            None => (facing, None),
            Some(smooth) => {
                let smooth = if smooth.dot(way.ray.direction) > 0.0 { -smooth } else { smooth };
                (smooth, Some(Flat { normal: facing, behind }))
            }
        };
        walk.coinciding.clear();
        let clear = self.clear && self.clear_composites[number];
        if !ends && clear && hit.contested {
            let straight = Ray { origin: behind, direction: way.ray.direction };
            let Walk { coinciding, counters, .. } = walk;
            self.met_by(way).coinciding(&way.ray, hit, &straight, coinciding, &mut counters.work);
        }
        if self.counts && !ends {
            walk.counters.evaluations.refraction += u64::from(self.bends);
        }
        let border = match self.follows_media && !ends {
            true => walk.media.border(self.solids(), way, hit, &walk.coinciding),
            false => Border::none(way.within),
        };
        let Border { from, to: after, within: [within, within_behind], .. } = border;
        let left = border.left_after(world, hit.t);
        let samples = border.samples(world).filter(|_| way.spectrum.is_none());
        if self.counts {
            walk.counters.evaluations.absorption += u64::from(left != Rgb::WHITE);
            walk.counters.evaluations.dispersion += u64::from(samples.is_some());
        }
        let bent_between = |normal: Vector, [from, to]: [f64; 2]| {
            let faces_away = way.ray.direction.dot(normal) > 0.0;
            let toward = if faces_away { -normal } else { normal };
            refraction::bent(way.ray.direction, toward, from, to)
        };
        // Mirrors are the same for all colours.
        let [before, beyond] = match way.spectrum {
            None => [from, after],
            Some(_) => border.indices(world, None),
        };
        let fresnel = |normal: Vector| {
            let bent = bent_between(normal, [before, beyond]);
            bent.map_or(1.0, |bent| refraction::fresnel(before, beyond, bent.cosines))
        };
        let around = SurfaceInteraction::new(self, &way.ray, hit, &point);
        let surface = Surface {
            around,
            adc_bailout: self.adc_bailout,
            untinted_layers: world.settings.untinted_layers,
            normal,
            to_viewer: -way.ray.direction,
            fresnel: &fresnel,
            known,
        };
        let stacks = surface.stacks(texture);
        let others = walk.coinciding.iter();
        let others = others.map(|other| super::texture::transmittance(self, &way.ray, other));
        let others = others.fold(Rgb::WHITE, |factor, other| factor * other);
        walk.arrived.clear();
        walk.arrived.resize(world.lights.len(), [None; 2]);
        let mut local = Rgb::BLACK;
        let (since, since_behind) = (walk.onward.len(), walk.behind.len());
        let mut open = SmallVec::<[Open; 1]>::new();
        for stack in &stacks {
            let mut own_mirrors = SmallVec::<[Onward; 1]>::new();
            // Of `refraction` only the top layer's counts, and none in a blend (measured).
            let top = stack.parts.first().filter(|_| matches!(texture, Texture::Layers(_)));
            let passed = top.map_or(1.0, |part| super::transmission::passed(&part.plain.finish));
            for part in &stack.parts {
                let share = stack.share * part.share;
                let place = Place {
                    finish: &part.plain.finish,
                    color: part.paint.rgb,
                    body: part.body(world.settings.clearness),
                    point: point.point,
                    origin: point.spawn(facing),
                    normal: part.normal,
                    flat: match &part.plain.normal {
                        Some(_) => flat.or(Some(Flat { normal: facing, behind })),
                        None => flat,
                    },
                    smooth: part.plain.normal.as_ref().map(|_| normal),
                    to_viewer: -way.ray.direction,
                    within: way.within,
                };
                walk.part += 1;
                let lights = self.lights_of(hit.object);
                let ground = Ground { place: &place, behind, lights };
                let mut own = shade::local(self, walk, &ground);
                if behind::is_lit_behind(place.finish, object.double_illuminate) {
                    if self.counts {
                        walk.counters.evaluations.from_behind += 1;
                    }
                    own += behind::from_behind(self, walk, &ground, object.double_illuminate);
                }
                if part.plain.finish.seed {
                    own = own.at_most_one();
                }
                local += own * part.above * share;
                let mirror = part.plain.finish.reflection.as_ref().filter(|_| !ends);
                let Some(mirror) = mirror else { continue };
                let mut factor = surface.reflectance(part) * share;
                if let Some(extras) = &place.finish.extras {
                    factor = factor * extras::mirrored(extras, &place, mirror.exponent);
                }
                let most = reflection::most(mirror, fresnel(part.normal));
                let weight = way.weight * part.above.brightness() * part.share * most;
                if weight >= self.adc_bailout && !factor.is_black() {
                    let inside = (from != after && hit.leaving).then(|| Inside::of(hit));
                    let way = Way { inside, within, ..way.mirrored(&place, weight) };
                    let back = Back { to, factor, exponent: mirror.exponent };
                    own_mirrors.push(Onward { way, back });
                }
            }
            let factor = stack.through * others;
            let weight = way.weight * factor.largest();
            let is_cut = ends
                || !clear
                || weight < self.adc_bailout
                || factor.brightness().abs() < self.adc_bailout;
            let top = stack.parts.first().map_or(normal, |part| part.normal);
            // All light is thrown back, in the place of what the surface reflects (measured on POV-Ray 3.7).
            let is_total =
                !is_cut && samples.is_none() && bent_between(top, [from, after]).is_none();
            if !is_total {
                own_mirrors.into_iter().for_each(|mirror| walk.onward.join(mirror, since));
            }
            if !is_cut {
                let factor = factor * left * (stack.share * passed);
                open.push(Open { share: stack.share, factor, weight, top });
            }
        }
        for sample in 0..samples.unwrap_or(1) {
            let (spectrum, color, [from, after]) = match samples {
                None => (way.spectrum, Rgb::WHITE, [from, after]),
                Some(samples) => {
                    let spectrum = Some(dispersion::position(sample, samples));
                    let color = dispersion::color(sample, samples);
                    (spectrum, color, border.indices(world, spectrum))
                }
            };
            let since_sample = walk.behind.len();
            for &Open { share, factor, weight, top } in &open {
                match bent_between(top, [from, after]) {
                    Some(bent) => {
                        let ray = Ray { origin: behind, direction: bent.direction };
                        let level = if from == after { way.level } else { way.level + 1 };
                        let inside = (from != after && !hit.leaving).then(|| Inside::of(hit));
                        let within = within_behind;
                        let way = Way { ray, weight, level, inside, spectrum, within, ..*way };
                        let back = Back { to, factor: factor * color, exponent: 1.0 };
                        walk.behind.join(Onward { way, back }, since_sample);
                    }
                    // All light is thrown back.
                    None => {
                        walk.counters.total_reflection += 1;
                        let direction = bumpy::reflected(way.ray.direction, top, normal);
                        let ray = Ray { origin: point.spawn(facing), direction };
                        let (level, inside) = (way.level + 1, hit.leaving.then(|| Inside::of(hit)));
                        let spectrum = way.spectrum;
                        let mirrored = true;
                        let way = Way { ray, weight, level, mirrored, inside, spectrum, within };
                        let factor = match samples {
                            Some(_) => factor * color,
                            None => left * share,
                        };
                        let back = Back { to, factor, exponent: 1.0 };
                        walk.onward.join(Onward { way, back }, since);
                    }
                }
            }
        }
        walk.part = 0;
        walk.counters.reflection += (walk.onward.len() - since) as u64;
        walk.counters.transmission += (walk.behind.len() - since_behind) as u64;
        local
    }
}
