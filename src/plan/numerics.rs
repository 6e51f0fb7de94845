//! How hard a World is on arithmetic: its range of sizes, how far off its smallest things are, and which
//! maps nearly flatten space.
//!
//! **In:** [`World`], its [`Origins`]. **Out:** [`Numerics`]. **Invariant:** computed, not guessed;
//! changes nothing.

use crate::math::Vector;
use crate::math::singular::singular_values;
use crate::shape::Shape;
use crate::shape::body::Local;
use crate::source::Site;
use crate::world::{NearSingular, Origins, World};

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
    /// Maps with a condition number of 2²⁶ or more, in text order.
    pub near_singular: Vec<NearSingular>,
}

/// A number, and the object it is of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measured {
    pub value: f64,
    pub site: Option<Site>,
}

pub(super) fn numerics(world: &World, origins: &Origins) -> Numerics {
    let mut found =
        Numerics { near_singular: origins.near_singular.clone(), ..Numerics::default() };
    for (i, object) in world.objects.iter().enumerate() {
        let Some((centre, least, greatest)) = extent(world, object.shape) else { continue };
        let site = origins.objects.get(i).copied();
        let distance = length(centre - world.camera.location) / least;
        keep(&mut found.smallest, least, site, |new, old| new < old);
        keep(&mut found.largest, greatest, site, |new, old| new > old);
        keep(&mut found.farthest, distance, site, |new, old| new > old);
    }
    found
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
            let placed = &world.placed[at as usize];
            let [greatest, _, least] = singular_values(placed.placement.world_from_local);
            let reach = placed.body.reach();
            reach.is_finite().then_some((placed.placement.centre, least, greatest * reach))
        }
        Shape::Plane(_) => None,
    }
}

/// |v|, also where its square over- or underflows.
fn length(v: Vector) -> f64 {
    let largest = v.abs().max_element();
    if largest == 0.0 { 0.0 } else { (v / largest).length() * largest }
}
