//! Blobs as they were written.

use crate::math::Vector;
use crate::scene::TransformId;

/// The parts of a `blob`.
#[derive(Debug, Clone, PartialEq)]
pub struct Blob {
    /// More than 0.
    pub threshold: f64,
    pub components: Vec<Component>,
}

/// A `sphere` or a `cylinder` of a blob.
#[derive(Debug, Clone, PartialEq)]
pub struct Component {
    /// The middles of a cylinder's ends; of a sphere, twice its centre.
    pub ends: [Vector; 2],
    /// Not 0.
    pub radius: f64,
    /// Not 0.
    pub strength: f64,
    /// In written order.
    pub transforms: Vec<TransformId>,
}

impl Blob {
    /// How many bytes it holds.
    pub fn bytes(&self) -> u64 {
        let transforms = |component: &Component| size_of_val(&component.transforms[..]) as u64;
        let lists: u64 = self.components.iter().map(transforms).sum();
        lists + size_of_val(&self.components[..]) as u64
    }

    /// Nowhere could its field be as strong as the threshold.
    pub fn is_weak(&self) -> bool {
        let strengths = self.components.iter().map(|component| component.strength.max(0.0));
        strengths.sum::<f64>() <= self.threshold
    }
}
