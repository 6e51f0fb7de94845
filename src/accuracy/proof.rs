//! What fresh pixels say of a picture, and whether that proves a promise.
//!
//! **In:** a picture, and pixels whose truth is known and that had no part in its settings. **Out:** an
//! [`Audit`].

use super::audit;
use super::reference::{Reference, colors_of};
use super::statistics::{Estimate, Metric};
use crate::trace::Traced;

/// What fresh pixels say of a picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Audit {
    pub metric: Metric,
    pub error: Estimate,
    /// Four times the reference's own error: what is below cannot be told from it.
    pub resolution: f64,
    pub pixels: usize,
    /// How deep the reference looked, where that was not as deep as can be: of what lies deeper nothing
    /// is known.
    pub depth: Option<u32>,
    /// Below which weight the reference gave up rays, where that was not as little as can be.
    pub adc_bailout: Option<f64>,
}

impl Audit {
    /// Its interval ends below `most`, the reference tells so small an error, and all that it can see was
    /// looked at.
    pub fn proves(&self, most: f64) -> bool {
        self.shows(most) && self.depth.is_none() && self.adc_bailout.is_none()
    }

    /// The same, of what was looked at.
    pub fn shows(&self, most: f64) -> bool {
        self.error.high.max(self.resolution) <= most
    }
}

/// What the pixels of a list, whose truth is known, say of a picture.
pub fn audited(
    traced: &Traced,
    list: &[(u32, u32)],
    reference: &Reference,
    metric: Metric,
) -> Audit {
    let colors = colors_of(&traced.film, list);
    Audit {
        metric,
        error: metric.estimate(
            &audit::by_place(list, reference.deviations(&colors)),
            traced.film.frame.region.pixels(),
        ),
        resolution: 4.0 * reference.floor(metric),
        pixels: list.len(),
        depth: None,
        adc_bailout: None,
    }
}

/// The upper end that an audit by `fresh` pixels will hardly exceed, of settings of which `known` pixels
/// tell an error: intervals are as much wider as there are fewer pixels, and both are off by chance.
pub fn expected(error: &Estimate, known: usize, fresh: usize) -> f64 {
    let more = known as f64 / fresh as f64;
    let width = (error.high - error.value) * more.sqrt();
    error.value + width * (1.0 + (1.0 + 1.0 / more).sqrt())
}
