//! How hard a World is on arithmetic: its range of sizes, how far off its smallest things are, what is
//! thin for its length, and which maps nearly flatten space.
//!
//! **In:** [`World`], its [`Origins`]. **Out:** [`Numerics`]. **Invariant:** computed, not guessed;
//! changes nothing.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::kinds::word_and_cost;
use crate::math::singular::singular_values;
use crate::math::{Matrix, Vector};
use crate::shape::body::Local;
use crate::shape::{Body, Placed, Shape};
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

/// A solid that is nearly a line or a point in some direction, and not in others.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Thin {
    /// What is thin: `torus`, `triangle of a mesh`.
    pub what: &'static str,
    /// Its length in thicknesses: of a torus R/r; of a triangle its longest side over its height there.
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
        let Some((centre, least, greatest)) = extent(world, object.shape) else {
            if found.endless.iter().all(|(known, _)| *known != word) {
                found.endless.push((word, site));
            }
            continue;
        };
        // Of what is smaller than numbers can say, no less than the greatest number.
        let distance = (length(centre - world.camera.location) / least).min(f64::MAX);
        keep(&mut found.smallest, least, site, |new, old| new < old);
        keep(&mut found.largest, greatest, site, |new, old| new > old);
        keep(&mut found.farthest, distance, site, |new, old| new > old);
        let (what, slenderness) =
            triangles.thinnest(world, object.shape).unwrap_or((word, greatest / least));
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

/// Centre, least and greatest half width; `None` for what has no end.
fn extent(world: &World, shape: Shape) -> Option<(Vector, f64, f64)> {
    match shape {
        Shape::Sphere(at) => {
            let sphere = &world.spheres[at as usize];
            Some((sphere.centre, sphere.radius, sphere.radius))
        }
        Shape::Ellipsoid(at) => {
            let placement = &world.ellipsoids[at as usize].placement;
            let [greatest, _, least] = singular_values(placement.world_from_local);
            Some((placement.centre, least, greatest))
        }
        Shape::Box(at) => {
            let solid = &world.boxes[at as usize];
            // A flat box has two sides that count.
            let sides = solid.half_widths.into_iter().filter(|&side| side > 0.0);
            let least = sides.clone().fold(f64::INFINITY, f64::min);
            Some((solid.centre, least, sides.fold(0.0, f64::max)))
        }
        Shape::Placed(at) => {
            let Placed { body, placement, .. } = &world.placed[at as usize];
            let extents = [Vector::X, Vector::Y, Vector::Z].map(|axis| body.extent(axis));
            let half = |(low, high): (f64, f64)| 0.5 * high - 0.5 * low;
            // What is beyond its plane is the room for rounding that its extent has.
            let is_flat = |axis: usize| axis == 2 && matches!(&**body, Body::Disc(_));
            let half_along = |axis: usize| if is_flat(axis) { 0.0 } else { half(extents[axis]) };
            let middle = extents.map(|(low, high)| 0.5 * low + 0.5 * high);
            if !extents.into_iter().all(|extent| half(extent).is_finite()) {
                return None;
            }
            let [x, y, z] = [0, 1, 2].map(|i| placement.world_from_local.col(i) * half_along(i));
            let centre = placement.centre + placement.world_from_local * Vector::from_array(middle);
            // A flat one has two that count.
            let half_widths = singular_values(Matrix::from_cols(x, y, z));
            let least = half_widths.into_iter().rfind(|&half| half > 0.0)?;
            Some((centre, least, half_widths[0]))
        }
        Shape::Plane(_) => None,
    }
}

/// |v|, also where its square over- or underflows.
fn length(v: Vector) -> f64 {
    let largest = v.abs().max_element();
    if largest == 0.0 { 0.0 } else { (v / largest).length() * largest }
}
