//! Sphere sweeps as they were written.

use crate::math::Vector;
use crate::vocabulary::Word;

/// The parts of a `sphere_sweep`.
#[derive(Debug, Clone, PartialEq)]
pub struct Sweep {
    pub kind: Kind,
    /// Centre and radius of each; as many as the kind needs, or more.
    pub spheres: Vec<(Vector, f64)>,
}

/// How it goes from sphere to sphere.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Straight.
    Linear,
    /// Smoothly, near all of them.
    BSpline,
    /// Smoothly, through all but the first and the last.
    Cubic,
}

impl Kind {
    pub const ALL: [Self; 3] = [Self::Linear, Self::BSpline, Self::Cubic];

    pub fn word(self) -> Word {
        match self {
            Self::Linear => Word::LinearSpline,
            Self::BSpline => Word::BSpline,
            Self::Cubic => Word::CubicSpline,
        }
    }

    /// How many spheres it needs.
    pub fn least(self) -> usize {
        match self {
            Self::Linear => 2,
            Self::BSpline | Self::Cubic => 4,
        }
    }
}

impl Sweep {
    /// How many bytes it holds.
    pub fn bytes(&self) -> u64 {
        size_of_val(&self.spheres[..]) as u64
    }

    pub fn is_sizeless(&self) -> bool {
        self.spheres.iter().all(|(_, radius)| *radius == 0.0)
    }
}
