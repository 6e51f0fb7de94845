//! Lists the kinds of shapes in a World, and what intersecting each of them costs.
//!
//! **In:** [`World`], its [`Origins`]. **Out:** each kind once, under its name in the language, in a fixed
//! order. **Invariant:** kinds that do not occur are not listed.

use std::collections::BTreeMap;

use crate::shape::local::Local;
use crate::shape::{Body, Shape};
use crate::source::Site;
use crate::world::{Origins, World};

/// Kind of shape, operation on shapes, or part of surfaces that occurs in the World.
#[derive(Debug, Clone, PartialEq)]
pub struct Kind {
    /// Name in the language: `sphere`, `difference`, `wood`.
    pub word: String,
    /// Number of shapes to intersect; for anything else, the number of occurrences in the scene.
    pub count: usize,
    /// Source locations in text order, without duplicates.
    pub by: Vec<Site>,
    /// Cost of intersecting one shape with a ray, or of evaluating the part once.
    pub cost: &'static str,
}

impl Kind {
    pub(super) fn sort_places(&mut self) {
        self.by.sort_by_key(|site| (site.span, site.expansion));
        self.by.dedup_by_key(|site| site.span);
    }
}

/// Returns the name of an object's shape, and its cost per ray.
pub(super) fn word_and_cost(world: &World, shape: Shape) -> (&'static str, &'static str) {
    match shape {
        Shape::Sphere(_) => ("sphere", "a square root a ray"),
        Shape::Plane(_) => ("plane", "a division a ray"),
        Shape::Box(_) => ("box", "three pairs of planes a ray"),
        Shape::Ellipsoid(_) => ("stretched sphere", "a map and a square root a ray"),
        Shape::Placed(at) => {
            let body = &*world.placed[at as usize].body;
            let cost = match body {
                Body::Cylinder(_) | Body::Cone(_) => "a map and a square root a ray",
                Body::Disc(_) | Body::Polygon(_) => "a map and a division a ray",
                Body::Torus(_) => "a map and up to four roots by steps a ray",
                Body::Prism(_) if !body.is_iterated() => {
                    "a map and a root for each piece of the outline a ray"
                }
                Body::Algebraic(_)
                | Body::Blob(_)
                | Body::Lathe(_)
                | Body::Ovus(_)
                | Body::Prism(_)
                | Body::Sor(_)
                | Body::SphereSweep(_)
                | Body::Superellipsoid(_) => "a map and all roots by steps a ray",
                Body::Isosurface(_) => {
                    "a map and bounds of its function, until each root stands alone, a ray"
                }
                Body::JuliaFractal(_) => {
                    "a map and bounds of its orbit, until each root stands alone, a ray"
                }
                Body::Parametric(_) => {
                    "a map and bounds of its three functions a part a ray may meet"
                }
                Body::BicubicPatch(_) => {
                    "a map, and parts of the patch until each crossing stands alone, a ray"
                }
                Body::HeightField(_) => "a map and a walk over the grid below a ray",
                Body::Text(_) => "a map and the outlines of the letters a ray may meet",
                Body::Mesh(_) => "a map and a tree of triangles a ray",
            };
            let word = match body {
                Body::Algebraic(surface) => surface.word(),
                other => other.word(),
            };
            (word, cost)
        }
    }
}

pub(super) fn kinds(world: &World, origins: &Origins) -> Vec<Kind> {
    let mut found: BTreeMap<(u8, &'static str), Kind> = BTreeMap::new();
    let mut note = |order: u8, word: &'static str, cost, site: Option<Site>| {
        let fresh = || Kind { word: word.to_owned(), count: 0, by: Vec::new(), cost };
        let kind = found.entry((order, word)).or_insert_with(fresh);
        kind.count += 1;
        kind.by.extend(site);
    };
    for (i, object) in world.objects.iter().enumerate() {
        let (word, cost) = word_and_cost(world, object.shape);
        note(0, word, cost, origins.objects.get(i).copied());
    }
    for operation in &origins.operations {
        note(1, operation.word, "the crossings of all its parts, in order", Some(operation.site));
    }
    let mut kinds: Vec<Kind> = found.into_values().collect();
    kinds.iter_mut().for_each(Kind::sort_places);
    kinds
}
