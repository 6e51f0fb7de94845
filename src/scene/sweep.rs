//! Sphere sweeps as written.

use crate::math::Vector;
use crate::vocabulary::Word;

/// The parts of a `sphere_sweep`.
#[derive(Debug, Clone, PartialEq)]
pub struct Sweep {
    pub kind: Kind,
    /// The centre and radius of each; at least as many as the kind requires.
    pub spheres: Vec<(Vector, f64)>,
}

/// The interpolation from sphere to sphere.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Linear.
    Linear,
    /// Smooth, near all spheres.
    BSpline,
    /// Smooth, through all spheres but the first and the last.
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

    /// Returns the least number of spheres.
    pub fn least(self) -> usize {
        match self {
            Self::Linear => 2,
            Self::BSpline | Self::Cubic => 4,
        }
    }
}

impl Sweep {
    /// Returns its size in bytes.
    pub fn bytes(&self) -> u64 {
        size_of_val(&self.spheres[..]) as u64
    }

    pub fn is_sizeless(&self) -> bool {
        self.spheres.iter().all(|(_, radius)| *radius == 0.0)
    }
}
