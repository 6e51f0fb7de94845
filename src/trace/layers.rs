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
use super::shade::{self, Flat, Place};
use super::texture::SurfaceInteraction;
use super::tracer::Tracer;
use super::way::{Inside, Way};
use super::{Walk, behind, bumpy, dispersion, extras, reflection, refraction};
use crate::color::{Clearness, Color, Rgb};
use crate::geometry::{self, Hit};
use crate::math::Vector;
use crate::shape::Ray;
use crate::texture;
use crate::texture::blend::Mix;
use crate::world::{Plain, Texture};
use smallvec::SmallVec;

/// A plain texture that is part of another.
struct Part<'a> {
    plain: &'a Plain,
    paint: Color,
    /// The normal by which it is lit.
    normal: Vector,
    /// The part of its light that the layers above it let through.
    above: Rgb,
    /// Its share in the blends inside of its stack.
    share: f64,
    /// It tints the light behind; a part that does not is as clear as its `filter` says, in any version.
    tints: bool,
}

/// Most textures have no more parts than this; further ones are allocated.
type Parts<'a> = SmallVec<[Part<'a>; 4]>;

/// Likewise for the alternatives.
type Stacks<'a> = SmallVec<[Stack<'a>; 1]>;

/// Layers that cover each other, from the top down: one alternative of the blends around it.
struct Stack<'a> {
    /// Its share in the blends around it.
    share: f64,
    parts: Parts<'a>,
    /// The part of the light behind it that passes through.
    through: Rgb,
}

/// The light behind a stack that is not opaque.
struct Open {
    /// The stack's share in the blends around it.
    share: f64,
    factor: Rgb,
    weight: f64,
    /// The normal that bends it: the top layer's.
    top: Vector,
}

/// What comes onto a part of a texture from the parts above.
struct Onto {
    light: Rgb,
    /// The part's share in the blends inside of its stack.
    share: f64,
    /// The part tints the light behind.
    tints: bool,
}

/// A point on a surface, as its texture is evaluated there.
struct Surface<'a, 'p> {
    around: SurfaceInteraction<'a, 'p>,
    adc_bailout: f64,
    /// See the World's settings.
    untinted_layers: bool,
    /// Toward the viewer's side.
    normal: Vector,
    to_viewer: Vector,
    /// The fraction that is reflected by Fresnel's equations at a normal.
    fresnel: &'p dyn Fn(Vector) -> f64,
    known: Known<'a, 'p>,
}

impl<'a: 'p, 'p> Surface<'a, 'p> {
    /// Adds the stacks of a texture.
    fn stacks(
        &self,
        texture: &'a Texture,
        outer: Option<&texture::Place>,
        share: f64,
        stacks: &mut Stacks<'a>,
    ) {
        if let Texture::Faces(textures) = texture {
            // What has less is lost in POV-Ray 3.7, too (measured).
            let shares = texture::at_face(textures, &self.around);
            for (texture, weight) in shares.into_iter().filter(|one| one.1 >= self.adc_bailout) {
                self.stacks(texture, outer, share * weight, stacks);
            }
            return;
        }
        if let Texture::Average { space, entries } = texture {
            let place = texture::Place::new(space, outer, &self.around);
            for (weight, texture) in entries {
                self.stacks(texture, Some(&place), share * weight, stacks);
            }
            return;
        }
        if let Texture::Blend(blend) = texture {
            let (place, mix) = blend.at(outer, &self.around);
            match mix {
                None => {}
                Some(Mix::One(texture)) => self.stacks(texture, Some(&place), share, stacks),
                Some(Mix::Two(low, high, weight)) => {
                    self.stacks(low, Some(&place), share * (1.0 - weight), stacks);
                    self.stacks(high, Some(&place), share * weight, stacks);
                }
            }
            return;
        }
        let mut parts = Parts::new();
        let onto = Onto { light: Rgb::WHITE, share: 1.0, tints: true };
        let through = self.parts(texture, outer, onto, &mut parts);
        stacks.push(Stack { share, parts, through });
    }

    /// Adds the parts of a texture, and returns the part of the light behind it that passes through.
    fn parts(
        &self,
        texture: &'a Texture,
        outer: Option<&texture::Place>,
        Onto { light: above, share, tints }: Onto,
        parts: &mut Parts<'a>,
    ) -> Rgb {
        match texture {
            Texture::Plain(plain) => {
                let known = if outer.is_none() { self.known.part(plain) } else { None };
                let (paint, normal) = known.unwrap_or_else(|| {
                    let around = self.around.with(plain.normal.as_deref());
                    let normal = match &plain.normal {
                        Some(bumps) => bumps.perturbed(self.normal, outer, &self.around),
                        None => self.normal,
                    };
                    (plain.pigment.color(outer, &around), normal)
                });
                let part = Part { plain, paint, normal, above, share, tints };
                let own = if tints { paint.transmittance() } else { paint.untinted() };
                let through = match plain.finish.conserve_energy {
                    true => own * self.reflectance(&part).map(|r| 1.0 - r),
                    false => own,
                };
                parts.push(part);
                through
            }
            Texture::Layers(layers) => {
                let mut through = Rgb::WHITE;
                for (place, layer) in layers.iter().enumerate().rev() {
                    if (above * through).brightness() < self.adc_bailout {
                        break;
                    }
                    let tints = place == 0 || !self.untinted_layers;
                    let onto = Onto { light: above * through, share, tints };
                    through = through * self.parts(layer, outer, onto, parts);
                }
                through
            }
            Texture::Faces(textures) => {
                let shares = texture::at_face(textures, &self.around).into_iter();
                shares.fold(Rgb::BLACK, |sum, (texture, weight)| {
                    let onto = Onto { light: above, share: share * weight, tints };
                    sum + self.parts(texture, outer, onto, parts) * weight
                })
            }
            Texture::Average { space, entries } => {
                let place = texture::Place::new(space, outer, &self.around);
                entries.iter().fold(Rgb::BLACK, |sum, (weight, texture)| {
                    let onto = Onto { light: above, share: share * weight, tints };
                    sum + self.parts(texture, Some(&place), onto, parts) * *weight
                })
            }
            Texture::Blend(blend) => {
                let (place, mix) = blend.at(outer, &self.around);
                match mix {
                    None => Rgb::BLACK,
                    Some(Mix::One(texture)) => self.parts(
                        texture,
                        Some(&place),
                        Onto { light: above, share, tints },
                        parts,
                    ),
                    Some(Mix::Two(low, high, weight)) => {
                        let rest = 1.0 - weight;
                        let onto = |part| Onto { light: above, share: share * part, tints };
                        let low = self.parts(low, Some(&place), onto(rest), parts);
                        let high = self.parts(high, Some(&place), onto(weight), parts);
                        low * rest + high * weight
                    }
                }
            }
        }
    }

    fn reflectance(&self, part: &Part) -> Rgb {
        match &part.plain.finish.reflection {
            Some(reflection) => {
                let cosine = part.normal.dot(self.to_viewer);
                let fresnel = if cosine < 0.0 { 1.0 } else { (self.fresnel)(part.normal) };
                reflection::reflectance(reflection, part.paint.rgb, cosine, fresnel)
            }
            None => Rgb::BLACK,
        }
    }
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
        let mut stacks = Stacks::new();
        surface.stacks(texture, None, 1.0, &mut stacks);
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
                let clearness = match part.tints {
                    true => world.settings.clearness,
                    false => Clearness::Current,
                };
                let place = Place {
                    finish: &part.plain.finish,
                    color: part.paint.rgb,
                    body: part.paint.body(clearness),
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
