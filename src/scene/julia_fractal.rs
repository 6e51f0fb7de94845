//! Four-dimensional Julia fractals as written.

use std::fmt;

use crate::vocabulary::Word;

/// The points that stay bounded under an iterated map.
#[derive(Debug, Clone, PartialEq)]
pub struct JuliaFractal {
    /// The constant that the map adds.
    pub parameter: [f64; 4],
    /// Uses hypercomplex numbers instead of quaternions.
    pub hypercomplex: bool,
    /// The keyword of the function: `sqr`, `exp` …
    pub function: Word,
    /// The exponent of `pwr`: real and imaginary part.
    pub power: [f64; 2],
    /// At least 1.
    pub iterations: u32,
    /// The normal of the visible three-dimensional slice; its last component is not 0.
    pub normal: [f64; 4],
    /// Distance of the slice from the origin, along the normal at length 1.
    pub distance: f64,
}

impl Default for JuliaFractal {
    /// POV-Ray's defaults (manual, 2.4.1.6).
    fn default() -> Self {
        Self {
            parameter: [0.0; 4],
            hypercomplex: false,
            function: Word::Sqr,
            power: [0.0; 2],
            iterations: 20,
            normal: [0.0, 0.0, 0.0, 1.0],
            distance: 0.0,
        }
    }
}

impl fmt::Display for JuliaFractal {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Self { parameter: [x, y, z, w], function, iterations, normal, distance, .. } = self;
        let algebra = if self.hypercomplex { Word::Hypercomplex } else { Word::Quaternion };
        write!(f, " <{x}, {y}, {z}, {w}> {} {}", algebra.name(), function.name())?;
        if *function == Word::Pwr {
            write!(f, "({}, {})", self.power[0], self.power[1])?;
        }
        let [a, b, c, d] = normal;
        write!(f, " {iterations} iterations, slice <{a}, {b}, {c}, {d}> {distance}")
    }
}
