//! Lists the parts of the scene that cannot change the picture, and why.
//!
//! **In:** [`World`], its [`Origins`], the requested precision. **Out:** each part once, with its source
//! location. **Invariant:** nothing is dropped here. Parts of zero weight are not in the World, and the
//! tracer never evaluates a property that a light or shape lacks.

use super::Precision;
use super::kinds::without_single_kernel;
use crate::world::{Dropped, Origins, World};

/// Returns the properties that single lights and shapes lack, and what lowering dropped.
pub(super) fn dropped(world: &World, origins: &Origins, precision: Precision) -> Vec<Dropped> {
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
    if precision == Precision::Single {
        dropped.extend(without_single_precision(world, origins));
    }
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

/// Returns the first shape of each kind that is intersected in double precision even if single is
/// requested.
fn without_single_precision(world: &World, origins: &Origins) -> impl Iterator<Item = Dropped> {
    without_single_kernel(world, origins).into_iter().map(|(word, site)| Dropped {
        site,
        what: format!("single precision of every {word}"),
        why: "it has no kernel for it".to_owned(),
        calls: Vec::new(),
    })
}
