//! `facets`: a normal for each cell of `crackle`. It has no values of its own.

use super::crackle::seed;
use super::parameter::parameters;
use super::{Pattern, Sample};
use crate::math::interval::Interval;
use crate::math::{UnitVector, Vector};
use crate::noise::vector_noise;

parameters! {
    /// With `coords`, the noise at the seed of the cell of `crackle` that contains ten times the point, without
    /// its part along the normal: the number is the strength of the facets, whose width is always about 1/10.
    /// Else the direction of the seed of the cell that contains the normal, divided by `size`.
    ///
    /// **Source:** POV-Ray manual, section 3.4.7.1.10 "Facets Pattern"; formulas are measured on POV-Ray 3.7, in
    /// which the amount, `bump_size` and `accuracy` have no effect.
    pub struct Facets {
        "coords" coords: f64 = 0.0, "the strength of facets over the surface";
        "size" size: f64 = 0.1, "the size of facets over the directions";
    }
}

/// Cells of `coords` for each unit.
const CELLS: f64 = 10.0;

impl Pattern for Facets {
    const RANGE: Interval = Interval { low: 0.0, high: 0.0 };
    const COST: &str = "the random points of the cells around a point";
    const SCALES_BY_AMOUNT: bool = false;

    fn value(&self, _sample: &Sample) -> f64 {
        0.0
    }

    fn displacement(&self, normal: Vector, sample: &Sample) -> Option<Vector> {
        if self.coords != 0.0 {
            let noise = vector_noise(seed(sample.point * CELLS));
            return Some((noise - normal * noise.dot(normal)) * self.coords);
        }
        let scaled = normal / self.size;
        let direction = scaled.is_finite().then(|| UnitVector::from_direction(seed(scaled)));
        Some(direction.flatten().map_or(Vector::ZERO, |facet| facet.get() - normal))
    }
}
