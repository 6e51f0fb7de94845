//! Measures how demanding a World is numerically: its range of sizes, the distance of its smallest objects,
//! thin shapes, and nearly singular maps.
//!
//! **In:** [`World`], its [`Origins`]. **Out:** [`Numerics`]. **Invariant:** values are computed, not
//! guessed; the World is not changed.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::extent::Extent;
use super::kinds::word_and_cost;
use crate::math::Vector;
use crate::shape::{Body, Shape};
use crate::source::Site;
use crate::world::{Coinciding, NearSingular, Origins, World};

/// Numerical properties of a World, known before tracing.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Numerics {
    /// The smallest half width (radius, half edge, half axis) of any bounded solid, other than 0.
    pub smallest: Option<Measured>,
    /// The largest half width.
    pub largest: Option<Measured>,
    /// The greatest distance from the camera to a solid's centre, in units of that solid's least half
    /// width: the factor by which it magnifies the rounding of coordinates.
    pub farthest: Option<Measured>,
    /// The first shape of each kind that is unbounded, or of unknown extent, and so has no half width.
    pub endless: Vec<(&'static str, Option<Site>)>,
    /// Solids at least 2²⁶ times as long as thick, in the order of the objects.
    pub thin: Vec<Thin>,
    /// Maps with a condition number of at least 2²⁶, in text order.
    pub near_singular: Vec<NearSingular>,
    /// Parts of one solid that share a face, if they were searched for.
    pub coinciding: Vec<Coinciding>,
}

/// A solid that is nearly a sheet, a line or a point, or a sheet that is nearly a line or a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Thin {
    /// Name of the shape: `torus`, `triangle of a mesh`.
    pub what: &'static str,
    /// Ratio of length to thickness: R/r of a torus, the longest side of a triangle over its height there,
    /// the radius of a flat ring over half of its width.
    pub slenderness: f64,
    /// Where it is written.
    pub site: Option<Site>,
}

/// Ratio above which more than half of the 53 bits of a double are lost, 2²⁶.
const THIN: f64 = 67_108_864.0;

/// A value and the object it belongs to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measured {
    /// The value.
    pub value: f64,
    /// Where the object is written.
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
        // Limits an overflow to the greatest finite number.
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

/// Slenderness of the thinnest triangle of each mesh; instances share one entry.
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

/// Keeps the extreme value; of equal values, the first.
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

/// Returns |v|, even if the square over- or underflows.
fn length(v: Vector) -> f64 {
    let largest = v.abs().max_element();
    if largest == 0.0 { 0.0 } else { (v / largest).length() * largest }
}
