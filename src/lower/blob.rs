//! Lowers blobs: each component to a space where its radius is 1, all about the centre of the positive ones.

use super::Fault;
use super::body::frame;
use super::shape::{FLAT, no_size};
use super::transform::{Affine, Transforms, exact};
use crate::math::double::{Double, DoubleVector};
use crate::math::{Vector, reciprocal_power_of_two};
use crate::scene::blob::{Blob, Component};
use crate::shape::blob::Component as Local;
use crate::shape::{self, Body};

/// A component in its own space, where it has radius 1 about a segment along z, and the map from there.
struct Spent {
    half: f64,
    strength: f64,
    map: Affine,
}

/// Returns the blob at size about 1, about the centre of its box; the centre is rounded to 1/256 of the size,
/// and the size to a power of two. `None` if the field reaches the threshold nowhere.
pub fn blob(blob: &Blob, transforms: &mut Transforms) -> Result<Option<(Body, Affine)>, Fault> {
    let spend = |component| spent(component, blob.threshold, transforms);
    let all = blob.components.iter().map(spend).collect::<Result<Vec<_>, _>>()?;
    let (mut low, mut high) = (Vector::INFINITY, Vector::NEG_INFINITY);
    for Spent { half, map, .. } in all.iter().filter(|component| component.strength > 0.0) {
        let rows = map.rows().map(|row| row.round());
        let reach = rows.map(|row| row.length() + row.z.abs() * half);
        let (middle, reach) = (map.offset().round(), Vector::from_array(reach));
        (low, high) = (low.min(middle - reach), high.max(middle + reach));
    }
    let (low, high) = (low * 0.5, high * 0.5);
    if low.x > high.x {
        return Ok(None);
    }
    if !(low.is_finite() && high.is_finite()) {
        return Err(Fault::not_finite("this blob"));
    }
    let inverse_size = reciprocal_power_of_two((high - low).max_element());
    let size = 1.0 / inverse_size;
    let step = size / 256.0;
    let middle = ((low + high) / step).round() * step;
    let middle = if middle.is_finite() { middle } else { low + high };
    let scale = |factor: f64| [0, 1, 2].map(|i| DoubleVector::axis(i) * Double::from(factor));
    let half_size = 0.5 * inverse_size;
    let to_local = exact(-middle) * Double::from(half_size);
    let local_from_here = Affine::from_columns(scale(half_size), to_local);
    let local = |Spent { half, strength, map }: &Spent| {
        let map = local_from_here.after(map);
        let inverse = map.checked().map_err(|_| no_size(FLAT))?;
        Ok(Local {
            strength: *strength,
            centre: map.offset().round(),
            half: *half,
            blob_from_unit: map.matrix(Double::ONE),
            unit_from_blob: inverse.matrix(Double::ONE),
        })
    };
    let components = all.iter().map(local).collect::<Result<Vec<_>, Fault>>()?;
    let is_finite = |part: &Local| {
        part.unit_from_blob.is_finite() && part.blob_from_unit.is_finite() && part.half.is_finite()
    };
    if !components.iter().all(is_finite) {
        return Err(Fault::not_finite("a component of this blob"));
    }
    let frame = Affine::from_columns(scale(2.0 * size), exact(middle));
    let paint = |one: &Component| one.paint.unwrap_or(blob.textures.len() as u32);
    let paints: Vec<u32> = match blob.textures.is_empty() {
        true => Vec::new(),
        false => blob.components.iter().map(paint).collect(),
    };
    Ok(shape::Blob::painted(components, &paints).map(|blob| (Body::Blob(blob), frame)))
}

fn spent(
    component: &Component,
    threshold: f64,
    transforms: &mut Transforms,
) -> Result<Spent, Fault> {
    let [a, b] = component.ends.map(exact);
    let radius = Double::from(component.radius).abs();
    let half = Double::from(0.5);
    let axis = (b - a) * half;
    let [x, y, z] = match axis.is_zero() {
        true => [0, 1, 2].map(DoubleVector::axis),
        false => frame(axis)?.into(),
    };
    let columns = [x * radius, y * radius, z * radius];
    let own = Affine::from_columns(columns, (a + b) * half);
    Ok(Spent {
        half: (axis.length() / radius).round(),
        strength: (Double::from(component.strength) / Double::from(threshold)).round(),
        map: transforms.product(&component.transforms)?.after(&own),
    })
}
