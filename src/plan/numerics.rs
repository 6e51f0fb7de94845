//! How hard a World is on arithmetic: its range of sizes, how far off its smallest things are, what is
//! thin for its length, and which maps nearly flatten space.
//!
//! **In:** [`World`], its [`Origins`]. **Out:** [`Numerics`]. **Invariant:** computed, not guessed;
//! changes nothing.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::extent::Extent;
use super::kinds::word_and_cost;
use crate::math::Vector;
use crate::shape::{Body, Shape};
use crate::source::Site;
use crate::world::{Coinciding, NearSingular, Origins, World};

/// What is known of a World's numbers before a ray is traced.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Numerics {
    /// The least half width (radius, half edge, half axis) of any solid that has one, other than 0.
    pub smallest: Option<Measured>,
    /// The greatest.
    pub largest: Option<Measured>,
    /// The greatest distance from the camera to a solid's centre, in that solid's least half
    /// widths: so many times the rounding of a coordinate is larger for it.
    pub farthest: Option<Measured>,
    /// The first of each kind of shape that has no end, or none that is known, and so no half width.
    pub endless: Vec<(&'static str, Option<Site>)>,
    /// Solids that are 2²⁶ times as long as thick, or more, in the order of the objects.
    pub thin: Vec<Thin>,
    /// Maps with a condition number of 2²⁶ or more, in text order.
    pub near_singular: Vec<NearSingular>,
    /// Parts of one solid that have a face in common, where they were looked for.
    pub coinciding: Vec<Coinciding>,
}

/// A solid that is nearly a sheet, a line or a point; a sheet that is nearly a line or a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Thin {
    /// What is thin: `torus`, `triangle of a mesh`.
    pub what: &'static str,
    /// Its length in thicknesses: of a torus R/r; of a triangle its longest side over its height there; of a
    /// flat ring its radius over half of its width.
    pub slenderness: f64,
    pub site: Option<Site>,
}

impl Numerics {
    /// Whether 24 bits cannot tell the smallest solid's size from the rounding of a coordinate, on the
    /// largest or as seen from the camera.
    pub fn exceeds_single(&self) -> bool {
        let value = |found: &Option<Measured>| found.map_or(0.0, |found| found.value);
        let range = value(&self.largest) / value(&self.smallest);
        range > SINGLE || value(&self.farthest) > SINGLE
    }
}

/// What 24 bits tell apart.
const SINGLE: f64 = 16_777_216.0;
/// What costs more than half of the 53 bits of a number.
const THIN: f64 = 67_108_864.0;

/// A number, and the object it is of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measured {
    pub value: f64,
    pub site: Option<Site>,
}

pub(super) fn numerics(world: &World, origins: &Origins) -> Numerics {
    let mut found = Numerics {
        near_singular: origins.near_singular.clone(),
        coinciding: origins.coinciding.clone(),
        ..Numerics::default()
    };
    let mut triangles = Triangles::default();
    for (i, object) in world.objects.iter().enumerate() {
        let site = origins.objects.get(i).copied();
        let (word, _) = word_and_cost(world, object.shape);
        let Some(extent) = Extent::of(world, object.shape) else {
            if found.endless.iter().all(|(known, _)| *known != word) {
                found.endless.push((word, site));
            }
            continue;
        };
        let Extent { centre, least, greatest, slenderness } = extent;
        // Of what is smaller than numbers can say, no less than the greatest number.
        let distance = (length(centre - world.camera.location) / least).min(f64::MAX);
        keep(&mut found.smallest, least, site, |new, old| new < old);
        keep(&mut found.largest, greatest, site, |new, old| new > old);
        keep(&mut found.farthest, distance, site, |new, old| new > old);
        let (what, slenderness) =
            triangles.thinnest(world, object.shape).unwrap_or((word, slenderness));
        if slenderness >= THIN {
            found.thin.push(Thin { what, slenderness, site });
        }
    }
    found.thin.dedup_by_key(|thin| thin.site.map(|site| site.span));
    found
}

/// The slenderest triangle of each mesh, however often that is placed.
#[derive(Default)]
struct Triangles(BTreeMap<*const Body, f64>);

impl Triangles {
    fn thinnest(&mut self, world: &World, shape: Shape) -> Option<(&'static str, f64)> {
        let Shape::Placed(at) = shape else { return None };
        let body = &world.placed[at as usize].body;
        let Body::Mesh(mesh) = &**body else { return None };
        let worst = self.0.entry(Arc::as_ptr(body)).or_insert_with(|| mesh.slenderness());
        Some(("triangle of a mesh", *worst))
    }
}

/// Of several the first.
fn keep(
    best: &mut Option<Measured>,
    value: f64,
    site: Option<Site>,
    better: impl Fn(f64, f64) -> bool,
) {
    if best.is_none_or(|old| better(value, old.value)) {
        *best = Some(Measured { value, site });
    }
}

/// |v|, also where its square over- or underflows.
fn length(v: Vector) -> f64 {
    let largest = v.abs().max_element();
    if largest == 0.0 { 0.0 } else { (v / largest).length() * largest }
}
