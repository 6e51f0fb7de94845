//! Interiors: what solids are filled with, as far as any ray can tell.
//!
//! **Invariant:** pruning is exact. An interior goes only when no ray can come into it, or when all
//! of the scene is filled alike.

use super::{Fault, Lowering};
use crate::scene::{Finish, FinishId, InteriorId};
use crate::source::Site;
use crate::world::{CameraKind, Interior, Object, World};

impl Lowering<'_, '_> {
    /// The World's index of an object's interior. A finish with the old `ior` has the last word.
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
        let sites = match (old, written) {
            (None, Some(interior)) => interior.sites.clone(),
            _ => scene.finish_origins.get(finish.index()).map_or(vec![], |o| o.ior.clone()),
        };
        let site = sites.first().copied().unwrap_or(object);
        if !ior.is_finite() {
            self.reporter.fault(Fault::not_finite("this interior"), site);
            return None;
        }
        let interiors = &mut self.world.interiors;
        let known = interiors.iter().position(|interior| interior.ior == ior);
        let index = known.unwrap_or_else(|| {
            interiors.push(Interior { ior });
            self.origins.interiors.push(Vec::new());
            interiors.len() - 1
        });
        let called = &mut self.origins.interiors[index];
        for site in sites {
            if self.noted_interiors.insert((index, site.span)) {
                called.push(site);
            }
        }
        Some(index as u32)
    }

    /// Drops the interiors that nothing can show, and tells so.
    pub(super) fn prune_interiors(&mut self) {
        let bends = self.world.interiors.iter().any(|interior| interior.ior != 1.0);
        let asked = self.world.objects.iter().any(|object| asks(&self.world, object));
        let kept: Vec<bool> = (self.world.objects.iter())
            .map(|object| bends && asked && is_entered(&self.world, object))
            .collect();
        for (object, kept) in self.world.objects.iter_mut().zip(kept) {
            if !kept {
                object.interior = None;
            }
        }
        let old = std::mem::take(&mut self.world.interiors);
        let sites = std::mem::take(&mut self.origins.interiors);
        let mut renamed: Vec<Option<u32>> = vec![None; old.len()];
        for object in &mut self.world.objects {
            let Some(index) = object.interior else { continue };
            object.interior = Some(*renamed[index as usize].get_or_insert_with(|| {
                self.world.interiors.push(old[index as usize]);
                self.origins.interiors.push(sites[index as usize].clone());
                self.world.interiors.len() as u32 - 1
            }));
        }
        for (interior, sites) in sites.iter().enumerate().filter(|(i, _)| renamed[*i].is_none()) {
            let why = match old[interior].ior == 1.0 && !bends {
                true => "an `ior` of 1 bends no light",
                false => "no light goes into what it fills",
            };
            sites.iter().for_each(|&site| self.drop_part(site, "interior", why));
        }
    }
}

/// Whether the object's surface does anything by the indices of refraction.
fn asks(world: &World, object: &Object) -> bool {
    let material = &world.materials[object.material as usize];
    let fresnel = material.finish.reflection.as_ref().is_some_and(|r| r.fresnel);
    fresnel || material.pigment.is_clear()
}

/// Whether a ray may be inside: through its surface, or because the camera is. Which points are an
/// orthographic camera's is not asked.
fn is_entered(world: &World, object: &Object) -> bool {
    asks(world, object)
        || world.camera.kind == CameraKind::Orthographic
        || world.contains(object, world.camera.location)
}
