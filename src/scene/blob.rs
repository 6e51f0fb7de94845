//! Blobs as written.

use crate::math::Vector;
use crate::scene::{TextureId, TransformId};

/// The parts of a `blob`.
#[derive(Debug, Clone, PartialEq)]
pub struct Blob {
    /// The field's threshold, more than 0.
    pub threshold: f64,
    pub components: Vec<Component>,
    /// Textures of single components.
    pub textures: Vec<TextureId>,
}

/// A `sphere` or a `cylinder` of a blob.
#[derive(Debug, Clone, PartialEq)]
pub struct Component {
    /// The centres of a cylinder's ends; for a sphere, its centre twice.
    pub ends: [Vector; 2],
    /// Not 0.
    pub radius: f64,
    /// Not 0.
    pub strength: f64,
    /// In written order.
    pub transforms: Vec<TransformId>,
    /// Its own texture: an index into the blob's.
    pub paint: Option<u32>,
}

/// Above this many components, pairs are not compared.
const MOST: usize = 1000;

impl Blob {
    /// Returns whether the field certainly stays below the threshold everywhere, judged by the strengths of
    /// the components that overlap each one.
    pub fn is_weak(&self) -> bool {
        let sum = |reaching: &dyn Fn(&Component) -> bool| {
            let all = self.components.iter().filter(|other| reaching(other));
            all.map(|component| component.strength.max(0.0)).sum::<f64>()
        };
        sum(&|_| true) <= self.threshold
            || self.components.len() <= MOST
                && self.components.iter().all(|one| sum(&|it| one.reaches(it)) <= self.threshold)
    }
}

impl Component {
    /// Returns its size in bytes.
    pub fn bytes(&self) -> u64 {
        (size_of::<Self>() + size_of_val(&self.transforms[..])) as u64
    }

    /// Returns whether the bounding spheres of two components overlap; always true if one is transformed.
    fn reaches(&self, other: &Self) -> bool {
        if !(self.transforms.is_empty() && other.transforms.is_empty()) {
            return true;
        }
        let ball = |one: &Self| {
            let [a, b] = one.ends;
            ((a + b) * 0.5, (b - a).length() * 0.5 + one.radius.abs())
        };
        let ((a, wide), (b, tall)) = (ball(self), ball(other));
        let apart = (b - a).length() * (1.0 - 8.0 * f64::EPSILON);
        apart.is_nan() || apart <= wide + tall
    }
}
