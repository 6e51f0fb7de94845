//! Lists the parts of the scene that cannot change the picture, and why.
//!
//! **In:** [`World`], its [`Origins`]. **Out:** each part once, with its source location. **Invariant:**
//! nothing is dropped here. Parts of zero weight are not in the World, and the tracer never evaluates a
//! property that a light lacks.

use crate::world::{Dropped, Origins, World};

/// Returns the properties that single lights lack, and what lowering dropped.
pub(super) fn dropped(world: &World, origins: &Origins) -> Vec<Dropped> {
    let mut dropped: Vec<Dropped> = shadowless(world, origins).collect();
    // Of one in a macro each call says it once.
    dropped.dedup_by(|later, first| {
        let same = later.site.span == first.site.span;
        if same {
            let calls = later.calls.iter().filter(|call| !first.calls.contains(call));
            let calls: Vec<_> = calls.copied().collect();
            first.calls.extend(calls);
        }
        same
    });
    dropped.extend(origins.dropped.iter().cloned());
    dropped
}

fn shadowless(world: &World, origins: &Origins) -> impl Iterator<Item = Dropped> {
    let lights = world.lights.iter().zip(&origins.lights);
    lights.filter(|(light, _)| !light.casts_shadows).map(|(_, &site)| Dropped {
        site,
        what: "shadows and highlights of one light".to_owned(),
        why: "it is shadowless".to_owned(),
        calls: origins.expansions.get(site.expansion).map(|of| of.call).into_iter().collect(),
    })
}
