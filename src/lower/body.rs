//! Bodies: each solid that is no sphere, plane or box becomes a body in a space of its own, and one
//! placement that holds all its transforms.
//!
//! **In:** a solid as written, and the map its transforms come to. **Out:** a [`Placed`].

use std::sync::Arc;

use super::Fault;
use super::shape::{FLAT, no_size};
use super::transform::{Affine, exact};
use crate::math::Vector;
use crate::math::double::{Double, DoubleVector};
use crate::math::placement::Placement;
use crate::shape::{Body, Cylinder, Placed};

/// The round of radius 1 from z = −1 to z = 1, between the middles of the ends.
pub fn cylinder(ends: [Vector; 2], radius: f64, open: bool) -> Result<(Body, Affine), Fault> {
    let frame = along_axis(ends, Double::from(radius).abs())?;
    Ok((Body::Cylinder(Cylinder { open }), frame))
}

/// The map that takes the z axis from −1 to 1 to the line between two points, and lengths across it to
/// `radius` times as much.
fn along_axis([a, b]: [Vector; 2], radius: Double) -> Result<Affine, Fault> {
    let half = Double::from(0.5);
    let (a, b) = (exact(a), exact(b));
    let axis = (b - a) * half;
    let unit = axis.normalized().ok_or_else(|| no_size("this solid has no length"))?;
    // The coordinate axis that is farthest from it.
    let sizes = unit.round().abs();
    let away = (0..3).min_by(|&i, &j| sizes[i].total_cmp(&sizes[j])).unwrap_or(0);
    let across = unit.cross(DoubleVector::axis(away)).normalized();
    let across = across.ok_or_else(|| no_size("this solid has no length"))?;
    let columns = [across * radius, unit.cross(across) * radius, axis];
    Ok(Affine::from_columns(columns, (a + b) * half))
}

/// A body under a map, as it stands in the world.
pub fn place(body: Body, map: &Affine) -> Result<Placed, Fault> {
    let what = format!("this {}", body.word());
    if !map.is_finite() {
        return Err(Fault::not_finite(&what));
    }
    let inverse = map.checked().map_err(|_| no_size(FLAT))?;
    let placement = Placement {
        centre: map.offset().round(),
        world_from_local: map.matrix(Double::ONE),
        local_from_world: inverse.matrix(Double::ONE),
    };
    if !placement.local_from_world.is_finite() || !placement.world_from_local.is_finite() {
        return Err(Fault::not_finite(&what));
    }
    Ok(Placed { body: Arc::new(body), placement })
}
