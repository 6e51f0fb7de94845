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

/// Of more components, none is held against each other.
const MOST: usize = 1000;

impl Blob {
    /// Nowhere could its field be as strong as the threshold: where a component is, there are those that
    /// reach into it.
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
    /// How many bytes it holds.
    pub fn bytes(&self) -> u64 {
        (size_of::<Self>() + size_of_val(&self.transforms[..])) as u64
    }

    /// Whether the balls around two of them meet; whatever was transformed may.
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
