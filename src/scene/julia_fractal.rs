//! Fractals of four dimensions as they were written.

use std::fmt;

use crate::vocabulary::Word;

/// Where a map, done again and again, leads nowhere far.
#[derive(Debug, Clone, PartialEq)]
pub struct JuliaFractal {
    /// What the map adds.
    pub parameter: [f64; 4],
    /// Of hypercomplex numbers, or else of quaternions.
    pub hypercomplex: bool,
    /// The word of the function: `sqr`, `exp` …
    pub function: Word,
    /// Of `pwr`: real and imaginary.
    pub power: [f64; 2],
    /// 1 or more.
    pub iterations: u32,
    /// Of the three dimensions that are seen; its last component is not 0.
    pub normal: [f64; 4],
    /// Of those from the origin, along the normal at length 1.
    pub distance: f64,
}

impl Default for JuliaFractal {
    /// As POV-Ray has it (manual, 2.4.1.6).
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
