//! Lowers interiors, as far as they affect a ray.
//!
//! **Invariant:** pruning is exact. An interior is dropped only if no ray can enter it, or if the whole scene
//! has the same one.

use std::collections::HashSet;

use super::{Fault, Lowering};
use crate::color::Rgb;
use crate::scene::{self, ClassicFinish, Finish, FinishId, InteriorId};
use crate::source::Site;
use crate::vocabulary::Word;
use crate::world::{Absorption, Dispersion, Interior, InteriorOrigin, Object, Plain, World};

/// The origins of an object's interior: its `interior` block, and its finish.
pub type Filling = (Option<InteriorId>, FinishId);

impl Lowering<'_, '_> {
    /// Returns the World's index of an object's interior. The old `ior` in a finish takes precedence.
    pub(super) fn interior(
        &mut self,
        interior: Option<InteriorId>,
        finish: FinishId,
        object: Site,
    ) -> Option<u32> {
        let scene = self.scene;
        let written = interior.map(|id| &scene.interiors[id.index()]);
        let old = match &scene.finishes[finish.index()] {
            Finish::Classic(classic) => classic.ior,
            Finish::Seed { .. } => None,
        };
        let ior = old.or(written.map(|interior| interior.ior))?;
        let lowered = lowered(ior, old.is_some(), written);
        let Some((lowered, key)) = lowered else {
            let site = self.ior_site((interior, finish)).unwrap_or(object);
            self.reporter.fault(Fault::not_finite("this interior"), site);
            return None;
        };
        let interiors = &mut self.world.interiors;
        let index = *self.known_interiors.entry(key).or_insert_with(|| {
            interiors.push(lowered);
            interiors.len() as u32 - 1
        });
        self.fillings.push((interior, finish));
        Some(index)
    }

    /// Returns the exponent of an object's caustics; 0 for none. The old word in a finish takes precedence.
    ///
    /// **Source:** POV-Ray 3.7's behaviour, measured.
    pub(super) fn caustics(&self, interior: Option<InteriorId>, finish: FinishId) -> f64 {
        let exponent = match &self.scene.finishes[finish.index()] {
            Finish::Classic(ClassicFinish { caustics: Some(old), .. }) => old.max(0.0),
            _ => {
                let written = interior.map(|id| &self.scene.interiors[id.index()]);
                written.and_then(|interior| interior.caustics).map_or(0.0, |given| 45.0 * given)
            }
        };
        if exponent.is_finite() { exponent } else { 0.0 }
    }

    /// Returns the `ior` that gives an object its index of refraction.
    fn ior_site(&self, (interior, finish): Filling) -> Option<Site> {
        match self.scene.finishes[finish.index()] {
            Finish::Classic(ClassicFinish { ior: Some(_), .. }) => {
                self.scene.finish_origins.get(finish.index())?.of(Word::Ior)
            }
            _ => self.scene.interiors[interior?.index()].ior_site,
        }
    }

    /// Drops the interiors that no ray can reveal, and records that.
    pub(super) fn prune_interiors(&mut self) {
        if self.world.interiors.is_empty() {
            return;
        }
        let acts = |object: &Object| {
            let interior = object.interior.map(|index| self.world.interiors[index as usize]);
            interior.is_some_and(|it| it.is_active()) && is_entered(&self.world, object)
        };
        let bends = self.world.objects.iter().any(acts);
        let asked = self.world.objects.iter().any(|object| asks(&self.world, object));
        let objects = self.world.objects.iter().enumerate();
        let filled = objects.filter_map(|(i, object)| {
            let kept = bends && asked && is_entered(&self.world, object);
            Some((i, object.interior?, kept))
        });
        let filled: Vec<(usize, u32, bool)> = filled.collect();
        let fillings = std::mem::take(&mut self.fillings);
        let old = std::mem::take(&mut self.world.interiors);
        let mut renamed: Vec<Option<u32>> = vec![None; old.len()];
        for (_, index, _) in filled.iter().filter(|(.., kept)| *kept) {
            renamed[*index as usize].get_or_insert_with(|| {
                self.world.interiors.push(old[*index as usize]);
                self.origins.interiors.push(InteriorOrigin::default());
                self.world.interiors.len() as u32 - 1
            });
        }
        let (mut noted, mut listed) = (HashSet::new(), HashSet::new());
        for ((object, index, kept), filling) in filled.into_iter().zip(fillings) {
            let new = renamed[index as usize];
            self.world.objects[object].interior = new.filter(|_| kept);
            // The same pair recurs.
            if !noted.insert((filling, kept)) {
                continue;
            }
            let ior = self.ior_site(filling);
            let written = filling.0.map(|id| &self.scene.interiors[id.index()]);
            let interior = old[index as usize];
            let absorption = interior.absorption.and(written).and_then(|it| it.fade_site);
            let dispersion = interior.dispersion.and(written).and_then(|it| it.dispersion_site);
            let sites = [ior, absorption, dispersion];
            match new {
                Some(new) if kept => {
                    let origin = &mut self.origins.interiors[new as usize];
                    let lists = [&mut origin.ior, &mut origin.absorption, &mut origin.dispersion];
                    for (list, site) in lists.into_iter().zip(sites) {
                        list.extend(site.filter(|site| listed.insert((new, site.span))));
                    }
                }
                Some(_) => {}
                None => {
                    let why = match interior.is_active() || bends {
                        true => "no light goes into what it fills",
                        false => "an `ior` of 1 bends no light",
                    };
                    let sites = sites.into_iter().flatten();
                    sites.for_each(|site| self.drop_part(site, "interior", why));
                }
            }
        }
    }
}

/// Returns an interior, and a key of its numbers; `None` if one is not finite. `is_old`: a finish gives its
/// index of refraction.
fn lowered(
    ior: f64,
    is_old: bool,
    written: Option<&scene::Interior>,
) -> Option<(Interior, [u64; 8])> {
    let default = scene::Interior::default();
    let written = written.unwrap_or(&default);
    let absorption = (written.fade_distance != 0.0).then_some(Absorption {
        distance: written.fade_distance,
        power: written.fade_power,
        color: written.fade_color,
    });
    let disperses = written.dispersion != 1.0 && (written.is_refractive || is_old);
    let dispersion = disperses
        .then_some(Dispersion { ratio: written.dispersion, samples: written.dispersion_samples });
    let Absorption { distance, power, color } =
        absorption.unwrap_or(Absorption { distance: 0.0, power: 0.0, color: Rgb::BLACK });
    let Dispersion { ratio, samples } = dispersion.unwrap_or(Dispersion { ratio: 1.0, samples: 0 });
    let [red, green, blue] = color.components();
    let numbers = [ior, distance, power, red, green, blue, ratio, f64::from(samples)];
    let interior = Interior { ior, absorption, dispersion };
    let is_finite = numbers.iter().all(|number| number.is_finite());
    // Zero has no sign.
    is_finite.then_some((interior, numbers.map(|number| (number + 0.0).to_bits())))
}

/// Returns whether the object's surface uses the indices of refraction.
fn asks(world: &World, object: &Object) -> bool {
    let fresnel = |plain: &Plain| plain.finish.reflection.as_ref().is_some_and(|r| r.fresnel);
    world.textures_of(object).any(|texture| texture.any(fresnel) || texture.is_clear())
}

/// Returns whether a ray may be inside: through the surface, or because the camera is. The ray origins of an
/// orthographic camera are not checked.
fn is_entered(world: &World, object: &Object) -> bool {
    asks(world, object)
        || !world.camera.has_one_origin()
        || world.contains(object, world.camera.location)
}
