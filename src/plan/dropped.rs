//! Parts of the scene that cannot change the picture, and why.
//!
//! **In:** [`World`], its [`Origins`], the arithmetic asked for. **Out:** each part once, at its place.
//! **Invariant:** nothing is dropped here: what has no weight is not in the World, and what a single
//! light or shape lacks the tracer does not ask it for.

use super::Precision;
use super::kinds::without_single_kernel;
use crate::world::{Dropped, Origins, World};

/// What single lights and shapes lack, and what lowering dropped.
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

/// The first of each kind of shapes that is met in double precision all the same.
fn without_single_precision(world: &World, origins: &Origins) -> impl Iterator<Item = Dropped> {
    without_single_kernel(world, origins).into_iter().map(|(word, site)| Dropped {
        site,
        what: format!("single precision of every {word}"),
        why: "it has no kernel for it".to_owned(),
        calls: Vec::new(),
    })
}
