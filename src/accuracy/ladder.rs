//! Ladders of settings that are not numbers: a knob's numbers are places on them.

use crate::plan::{Antialias, Samples};

/// Antialiasing modes, approximately from coarse to fine; the third is the default of `render`.
pub const LADDER: [Antialias; 14] = [
    Antialias::Off,
    Antialias::Adaptive { threshold: 0.1, grid: 4 },
    Antialias::Adaptive { threshold: 0.05, grid: 8 },
    Antialias::Adaptive { threshold: 0.02, grid: 12 },
    Antialias::Adaptive { threshold: 0.01, grid: 16 },
    Antialias::Grid(2),
    Antialias::Grid(3),
    Antialias::Grid(4),
    Antialias::Grid(6),
    Antialias::Grid(8),
    Antialias::Grid(12),
    Antialias::Grid(16),
    Antialias::Grid(24),
    Antialias::Grid(32),
];

/// Returns the indices into a ladder, as settings.
pub const fn places<const COUNT: usize>() -> [f64; COUNT] {
    let mut places = [0.0; COUNT];
    let mut place = 1;
    while place < COUNT {
        places[place] = places[place - 1] + 1.0;
        place += 1;
    }
    places
}

/// Returns the mode for an index into [`LADDER`].
pub fn rung(place: f64) -> Antialias {
    LADDER[(place as usize).min(LADDER.len() - 1)]
}

/// Samples of area lights, approximately from coarse to fine. The fourth has no error but noise.
pub const LIGHTS: [Samples; 10] = [
    Samples::Fixed(1),
    Samples::Fixed(4),
    Samples::Scene,
    Samples::Fixed(16),
    Samples::Adaptive { threshold: 0.05, most: 64 },
    Samples::Fixed(32),
    Samples::Adaptive { threshold: 0.02, most: 256 },
    Samples::Fixed(64),
    Samples::Adaptive { threshold: 0.01, most: 512 },
    Samples::Fixed(256),
];

/// Samples of blurred pixels, likewise.
pub const BLURS: [Samples; 14] = [
    Samples::Fixed(1),
    Samples::Fixed(4),
    Samples::Scene,
    Samples::Fixed(10),
    Samples::Adaptive { threshold: 0.05, most: 100 },
    Samples::Fixed(25),
    Samples::Adaptive { threshold: 0.02, most: 200 },
    Samples::Fixed(50),
    Samples::Fixed(100),
    Samples::Adaptive { threshold: 0.01, most: 500 },
    Samples::Fixed(200),
    Samples::Adaptive { threshold: 0.005, most: 1000 },
    Samples::Fixed(500),
    Samples::Fixed(1000),
];

/// Returns the samples for an index into a ladder of them.
pub fn samples(ladder: &[Samples], place: f64) -> Samples {
    ladder[(place as usize).min(ladder.len() - 1)]
}

pub fn place_of(ladder: &[Samples], samples: Samples) -> f64 {
    let is_it = |known: &Samples| *known == samples;
    let scene = |known: &Samples| *known == Samples::Scene;
    ladder.iter().position(is_it).or(ladder.iter().position(scene)).unwrap_or(0) as f64
}

pub fn flag_of(samples: Samples) -> String {
    samples.to_string().replace(' ', ":")
}
