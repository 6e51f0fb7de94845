//! Lowers sphere sweeps to one polynomial for each segment between spheres, about their common centre.

use super::Fault;
use super::transform::{Affine, exact};
use crate::math::double::{Double, DoubleVector};
use crate::math::{Vector, reciprocal_power_of_two};
use crate::scene::sweep::{Kind, Sweep};
use crate::shape::sphere_sweep::Segment;
use crate::shape::{Body, SphereSweep};

/// The contribution of each control point to each coefficient.
type Basis = [[f64; 4]; 4];

const LINEAR: Basis = [[1.0, 0.0, 0.0, 0.0], [-1.0, 1.0, 0.0, 0.0], [0.0; 4], [0.0; 4]];

/// Divided by 6. **Source:** C. de Boor, *A Practical Guide to Splines* (1978), ch. IX.
const B_SPLINE: Basis =
    [[1.0, 4.0, 1.0, 0.0], [-3.0, 0.0, 3.0, 0.0], [3.0, -6.0, 3.0, 0.0], [-1.0, 3.0, -3.0, 1.0]];

/// Divided by 2; passes through the middle two points, at each one parallel to the line between its
/// neighbours.
/// **Source:** E. Catmull, R. Rom, "A class of local interpolating splines" (1974); that POV-Ray uses this
/// spline was measured with `trace`.
const CATMULL_ROM: Basis =
    [[0.0, 2.0, 0.0, 0.0], [-1.0, 0.0, 1.0, 0.0], [2.0, -5.0, 4.0, -1.0], [-1.0, 3.0, -3.0, 1.0]];

/// Returns the sweep at size about 1, about the centre of the box that holds all spheres as written. The
/// centre is rounded to 1/256 of the size, and the size to a power of two. `None` where every radius is 0.
pub fn sphere_sweep(sweep: &Sweep) -> Result<Option<(Body, Affine)>, Fault> {
    if sweep.is_sizeless() {
        return Ok(None);
    }
    let all = sweep.spheres.iter();
    let (low, high) = all.fold((Vector::INFINITY, Vector::NEG_INFINITY), |(low, high), sphere| {
        let (centre, reach) = (sphere.0, Vector::splat(sphere.1.abs()));
        (low.min(centre - reach), high.max(centre + reach))
    });
    let (low, high) = (low * 0.5, high * 0.5);
    if !(low.is_finite() && high.is_finite()) {
        return Err(Fault::not_finite("this sphere_sweep"));
    }
    let inverse_size = reciprocal_power_of_two((high - low).max_element());
    let size = 1.0 / inverse_size;
    let step = size / 256.0;
    let middle = ((low + high) / step).round() * step;
    let middle = if middle.is_finite() { middle } else { low + high };
    let scale = Double::from(0.5 * inverse_size);
    let centre = |i: usize| (exact(sweep.spheres[i].0) - exact(middle)) * scale;
    let radius = |i: usize| Double::from(sweep.spheres[i].1) * scale;
    let (basis, over) = match sweep.kind {
        Kind::Linear => (LINEAR, 1.0),
        Kind::BSpline => (B_SPLINE, 6.0),
        Kind::Cubic => (CATMULL_ROM, 2.0),
    };
    let least = sweep.kind.least();
    let segment = |first: usize| {
        let sums = basis.map(|row| {
            let parts = (0..least).map(|k| (first + k, Double::from(row[k])));
            let (place, width) = parts
                .fold((DoubleVector::ZERO, Double::ZERO), |sum, (i, share)| {
                    (sum.0 + centre(i) * share, sum.1 + radius(i) * share)
                });
            let over = Double::from(over);
            (place.map(|c| c / over).round(), (width / over).round())
        });
        Segment { centre: sums.map(|(place, _)| place), radius: sums.map(|(_, width)| width) }
    };
    let segments = (0..=sweep.spheres.len() - least).map(segment).collect();
    let columns = [0, 1, 2].map(|i| DoubleVector::axis(i) * Double::from(2.0 * size));
    let frame = Affine::from_columns(columns, exact(middle));
    Ok(SphereSweep::new(segments).map(|body| (Body::SphereSweep(body), frame)))
}
