//! Lowers interiors, as far as they affect a ray.
//!
//! **Invariant:** pruning is exact. An interior is dropped only if no ray can enter it, or if the whole scene
//! has the same one.

use std::collections::HashSet;

use super::{Fault, Lowering};
use crate::diagnostic::{Code, Diagnostic};
use crate::scene::{ClassicFinish, Finish, FinishId, InteriorId};
use crate::source::Site;
use crate::world::{CameraKind, Interior, Object, World};

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
        if let Some(site) = written.and_then(|interior| interior.caustics) {
            let told = Diagnostic::new(Code::NotSupportedYet, "`caustics` is not simulated yet")
                .at(site.span, "the scene is rendered without it")
                .as_warning();
            self.reporter.diagnostics.push(told.traced(site, self.reporter.expansions));
        }
        let ior = old.or(written.map(|interior| interior.ior))?;
        let site = self.interior_sites((interior, finish)).first().copied().unwrap_or(object);
        if !ior.is_finite() {
            self.reporter.fault(Fault::not_finite("this interior"), site);
            return None;
        }
        let interiors = &mut self.world.interiors;
        // Zero has no sign.
        let index = *self.known_interiors.entry((ior + 0.0).to_bits()).or_insert_with(|| {
            interiors.push(Interior { ior });
            interiors.len() as u32 - 1
        });
        self.fillings.push((interior, finish));
        Some(index)
    }

    /// Returns the source pieces that give an object its interior: for one other than air, the pieces to
    /// remove to be rid of it.
    fn interior_sites(&self, (interior, finish): Filling) -> Vec<Site> {
        let written = interior.map(|id| &self.scene.interiors[id.index()]);
        let of_interior = || written.map_or(vec![], |interior| interior.sites.clone());
        let Finish::Classic(ClassicFinish { ior: Some(old), .. }) =
            self.scene.finishes[finish.index()]
        else {
            return of_interior();
        };
        let origin = self.scene.finish_origins.get(finish.index());
        let mut sites = origin.map_or(vec![], |origin| origin.ior.clone());
        // Without it the interior's own `ior` applies again.
        if old != 1.0 && written.is_some_and(|interior| interior.ior != 1.0) {
            sites.extend(of_interior());
        }
        sites
    }

    /// Drops the interiors that no ray can reveal, and records that.
    pub(super) fn prune_interiors(&mut self) {
        if self.world.interiors.is_empty() {
            return;
        }
        let bent = |object: &Object| {
            let ior = object.interior.map(|index| self.world.interiors[index as usize].ior);
            ior.is_some_and(|ior| ior != 1.0) && is_entered(&self.world, object)
        };
        let bends = self.world.objects.iter().any(bent);
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
                self.origins.interiors.push(Vec::new());
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
            let sites = self.interior_sites(filling);
            match new {
                Some(new) if kept => {
                    let called = &mut self.origins.interiors[new as usize];
                    called.extend(sites.into_iter().filter(|s| listed.insert((new, s.span))));
                }
                Some(_) => {}
                None => {
                    let why = match old[index as usize].ior == 1.0 && !bends {
                        true => "an `ior` of 1 bends no light",
                        false => "no light goes into what it fills",
                    };
                    sites.into_iter().for_each(|site| self.drop_part(site, "interior", why));
                }
            }
        }
    }
}

/// Returns whether the object's surface uses the indices of refraction.
fn asks(world: &World, object: &Object) -> bool {
    let material = &world.materials[object.material as usize];
    let fresnel = material.finish.reflection.as_ref().is_some_and(|r| r.fresnel);
    fresnel || material.pigment.is_clear()
}

/// Returns whether a ray may be inside: through the surface, or because the camera is. The ray origins of an
/// orthographic camera are not checked.
fn is_entered(world: &World, object: &Object) -> bool {
    asks(world, object)
        || world.camera.kind == CameraKind::Orthographic
        || world.contains(object, world.camera.location)
}
