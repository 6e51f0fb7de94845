//! Audits a picture on fresh pixels, to prove a promise.
//!
//! **In:** a picture, and pixels with a known reference that were not used to choose its settings. **Out:**
//! an [`Audit`].

use super::audit;
use super::reference::{Reference, colors_of};
use super::statistics::{Estimate, Metric};
use crate::trace::Traced;

/// Error of a picture, measured on fresh pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Audit {
    /// How the error is measured.
    pub metric: Metric,
    /// The error of the picture.
    pub error: Estimate,
    /// Four times the reference's own error; smaller errors cannot be distinguished from it.
    pub resolution: f64,
    /// Number of pixels on which it was measured.
    pub pixels: usize,
    /// Depth of the reference, if less than the maximum: nothing is known about deeper contributions.
    pub depth: Option<u32>,
    /// Weight below which the reference dropped rays, if above the minimum.
    pub adc_bailout: Option<f64>,
}

impl Audit {
    /// Whether the interval ends at or below `most`, the reference resolves so small an error, and was not
    /// limited in depth or weight.
    pub fn proves(&self, most: f64) -> bool {
        self.shows(most) && self.depth.is_none() && self.adc_bailout.is_none()
    }

    /// Like [`Self::proves`], but within the limits of the reference.
    pub fn shows(&self, most: f64) -> bool {
        self.error.high.max(self.resolution) <= most
    }
}

/// Audits a picture on the pixels of a list with a known reference.
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

/// Returns the upper end that an audit on `fresh` pixels is unlikely to exceed, for settings whose error is
/// known from `known` pixels: intervals widen as the number of pixels falls, and both are subject to
/// chance.
pub fn expected(error: &Estimate, known: usize, fresh: usize) -> f64 {
    let more = known as f64 / fresh as f64;
    let width = (error.high - error.value) * more.sqrt();
    error.value + width * (1.0 + (1.0 + 1.0 / more).sqrt())
}
