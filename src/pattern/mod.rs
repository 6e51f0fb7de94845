//! Patterns, which map a point to a number; one file for each pattern.
//!
//! **Invariant:** depends only on `math` and `noise`; the enum is closed and matched exhaustively. A value is
//! finite for every finite point and parameter. A point that its error cannot separate from a seam is on the
//! seam: so a seam that coincides with a row of pixels has one colour throughout, however the points of the
//! row are rounded.

mod agate;
mod boxed;
mod bozo;
mod brick;
mod bumps;
mod cells;
mod centres;
mod checker;
mod crackle;
mod cubic;
mod cylindrical;
mod dents;
mod facets;
mod gradient;
mod granite;
mod hexagon;
mod interface;
mod julia;
mod lattice;
#[cfg(test)]
mod laws;
mod layers;
mod leopard;
mod magnet_julia;
mod magnet_mandel;
mod mandel;
mod marble;
#[cfg(test)]
mod measured;
mod onion;
mod orbit;
mod parameter;
mod pavement;
mod planar;
mod quilted;
mod radial;
mod ripples;
mod scatter;
mod spherical;
mod spiral;
mod spiral1;
mod spiral2;
mod spotted;
mod square;
mod tile;
mod tiling;
mod triangle;
mod triangular;
mod turbulent;
pub mod warp;
mod wave;
mod waves;
mod wood;
mod wrinkles;

use interface::Pattern;
use parameter::Parameters;
pub use parameter::{Argument, Parameter};
pub use warp::Warp;
pub use wave::{Wave, WaveKind};

use std::fmt;

use crate::math::Vector;
use crate::math::interval::Interval;
use crate::math::wide::{Row, Rows};
use crate::noise::{NoiseGenerator, Turbulence};

/// Declares the closed set of patterns. A line is the module, which is the pattern's word, and its struct.
macro_rules! patterns {
    ($($file:ident $kind:ident)*) => {
        $(pub use $file::$kind;)*

        /// A pattern with its parameters.
        #[derive(Debug, Clone, Copy, PartialEq)]
        pub enum Kind {
            $($kind($kind),)*
        }

        impl Kind {
            /// All patterns, with their default parameters.
            pub fn all() -> Vec<Self> {
                vec![$(Self::$kind($kind::default())),*]
            }

            /// Returns the pattern of a word, with its default parameters.
            pub fn of_word(word: &str) -> Option<Self> {
                match word {
                    $(stringify!($file) => Some(Self::$kind($kind::default())),)*
                    _ => None,
                }
            }

            /// Returns its word in the language.
            pub fn word(&self) -> &'static str {
                match self {
                    $(Self::$kind(_) => stringify!($file),)*
                }
            }

            pub fn parameters(&self) -> &'static [Parameter] {
                match self {
                    $(Self::$kind(_) => $kind::PARAMETERS,)*
                }
            }

            /// Returns the value of a parameter by its place in [`Kind::parameters`].
            pub fn get(&self, place: usize) -> Option<Argument> {
                match self {
                    $(Self::$kind(kind) => kind.get(place),)*
                }
            }

            /// Sets a parameter by its place in [`Kind::parameters`]; its argument must have the default's type.
            pub fn set(&mut self, place: usize, argument: Argument) {
                match self {
                    $(Self::$kind(kind) => kind.set(place, argument),)*
                }
            }

            /// Returns the number of its values, if they are the whole numbers from 0 on and take a list of as
            /// many colours.
            pub fn list(&self) -> Option<usize> {
                match self {
                    $(Self::$kind(_) => $kind::LIST,)*
                }
            }

            /// Returns whether its values jump, so that the error of a point may matter.
            pub fn has_seams(&self) -> bool {
                match self {
                    $(Self::$kind(_) => $kind::HAS_SEAMS,)*
                }
            }

            /// Returns whether it applies the turbulence of its block to its value; the points are not displaced
            /// then.
            pub fn applies_turbulence(&self) -> bool {
                match self {
                    $(Self::$kind(_) => $kind::APPLIES_TURBULENCE,)*
                }
            }

            /// Returns the same pattern with parameters in canonical form, as values need them.
            pub fn canonical(self) -> Self {
                match self {
                    $(Self::$kind(kind) => Self::$kind(kind.canonical()),)*
                }
            }

            /// Returns its value with an error bound.
            #[inline]
            pub fn measured(&self, sample: &Sample) -> Measured {
                match self {
                    $(Self::$kind(kind) => kind.measured(sample),)*
                }
            }

            /// Returns whether its values do not depend on the error of a point.
            pub fn is_exact(&self, setting: &Setting) -> bool {
                match self {
                    $(Self::$kind(kind) => kind.is_exact(setting),)*
                }
            }

            /// Replaces the values that the mask has a bit for by those at its points; others may have any value
            /// then. The pattern must be [exact](Self::is_exact).
            pub fn values(
                &self,
                points: &Rows,
                mask: u32,
                setting: &Setting,
                values: &mut Row,
            ) {
                match self {
                    $(Self::$kind(kind) => kind.values(points, mask, setting, values),)*
                }
            }

            /// Returns the value for any error less than `NEAR` / 4 along each axis; `None` if the error may
            /// matter. The returned error is an upper bound. Coordinates must be below 2⁴⁰.
            #[inline]
            pub fn value_off_seams(&self, sample: &Sample) -> Option<Measured> {
                match self {
                    $(Self::$kind(kind) => kind.value_off_seams(sample),)*
                }
            }

            /// Returns the wave of its values, unless its block names another.
            pub fn wave(&self) -> WaveKind {
                match self {
                    $(Self::$kind(_) => $kind::WAVE,)*
                }
            }

            /// Returns the frequency of its wave, unless its block names another.
            pub fn frequency(&self) -> f64 {
                match self {
                    $(Self::$kind(_) => $kind::FREQUENCY,)*
                }
            }

            /// Returns its colours as a pigment without a map: positions with red, green and blue; of a pattern
            /// that takes a list, its colours where none are written.
            pub fn colors(&self) -> &'static [(f64, [f64; 3])] {
                match self {
                    $(Self::$kind(_) => $kind::COLORS,)*
                }
            }

            /// Returns an interval that contains all values.
            pub fn range(&self) -> Interval {
                match self {
                    $(Self::$kind(_) => $kind::RANGE,)*
                }
            }

            /// Returns the vector to add to a normal of length 1 in the pattern's space, for an amount of 1; `None`
            /// if that follows from the values around the point.
            pub fn displacement(&self, normal: Vector, sample: &Sample) -> Option<Vector> {
                match self {
                    $(Self::$kind(kind) => kind.displacement(normal, sample),)*
                }
            }

            /// Replaces the vectors that the mask has a bit for by [`Kind::displacement`]; others may have any value
            /// then. Returns false if that is `None`.
            pub fn displacements(
                &self,
                normals: &Rows,
                points: &Rows,
                mask: u32,
                setting: &Setting,
                vectors: &mut Rows,
            ) -> bool {
                match self {
                    $(Self::$kind(kind) => {
                        kind.displacements(normals, points, mask, setting, vectors)
                    })*
                }
            }

            /// Returns whether the amount of a normal scales [`Kind::displacement`].
            pub fn scales_by_amount(&self) -> bool {
                match self {
                    $(Self::$kind(_) => $kind::SCALES_BY_AMOUNT,)*
                }
            }

            /// Returns what it evaluates at a point, in words.
            pub fn cost(&self) -> &'static str {
                match self {
                    $(Self::$kind(_) => $kind::COST,)*
                }
            }

            /// Returns an interval that contains the value at each point within `reach` of `point` along each
            /// axis.
            pub fn bounds(&self, point: Vector, reach: Vector, setting: &Setting) -> Interval {
                match self {
                    $(Self::$kind(kind) => kind.bounds(point, reach, setting),)*
                }
            }

            /// Returns [`Kind::bounds`], and intervals that contain the slope along each axis; `None` if slopes are
            /// not known.
            pub fn sloped(
                &self,
                point: Vector,
                reach: Vector,
                setting: &Setting,
            ) -> Option<(Interval, [Interval; 3])> {
                match self {
                    $(Self::$kind(kind) => kind.sloped(point, reach, setting),)*
                }
            }
        }
    };
}

patterns! {
    agate Agate
    bozo Bozo
    boxed Boxed
    brick Brick
    bumps Bumps
    cells Cells
    checker Checker
    crackle Crackle
    cubic Cubic
    cylindrical Cylindrical
    dents Dents
    facets Facets
    gradient Gradient
    granite Granite
    hexagon Hexagon
    julia Julia
    leopard Leopard
    magnet_julia MagnetJulia
    magnet_mandel MagnetMandel
    mandel Mandel
    marble Marble
    onion Onion
    pavement Pavement
    planar Planar
    quilted Quilted
    radial Radial
    ripples Ripples
    spherical Spherical
    spiral1 Spiral1
    spiral2 Spiral2
    spotted Spotted
    square Square
    tiling Tiling
    triangular Triangular
    waves Waves
    wood Wood
    wrinkles Wrinkles
}

/// Writes the word and the values of parameters that are not the default's, as in the language.
impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.word())?;
        parameter::write(f, self.parameters(), |place| self.get(place))
    }
}

/// The parts of a block that several patterns use.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Setting {
    pub noise: NoiseGenerator,
    /// `octaves`, `lambda` and `omega`.
    pub turbulence: Turbulence,
    /// `turbulence`, by axis; zero without it. Only patterns that add turbulence to their values use it.
    pub amount: Vector,
    /// `frequency`, which also acts inside `ripples` and `waves`.
    pub frequency: f64,
    /// `phase`, which also acts inside `ripples` and `waves`.
    pub phase: f64,
    /// The scene's `number_of_waves`: the number of centres in `ripples` and `waves`.
    pub waves: usize,
}

impl Default for Setting {
    fn default() -> Self {
        Self {
            noise: NoiseGenerator::default(),
            turbulence: Turbulence::default(),
            amount: Vector::ZERO,
            frequency: 1.0,
            phase: 0.0,
            waves: 10,
        }
    }
}

/// A point in a pattern's own space.
#[doc(hidden)]
#[derive(Debug, Clone, Copy)]
pub struct Sample<'a> {
    pub point: Vector,
    /// By how much the point may be off along each axis; 0 where that is not known.
    pub error: Vector,
    pub setting: &'a Setting,
}

/// A number with its error bound.
#[doc(hidden)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measured {
    pub value: f64,
    pub error: f64,
}

/// Distance from a seam, in cells, within which a point's own error matters; all other errors must only be
/// less than a quarter of this.
pub(crate) const NEAR: f64 = 1.0 / 256.0;

/// Returns the box of the points within `reach` of `point`.
fn sides(point: Vector, reach: Vector) -> [Interval; 3] {
    let (low, high) = (point - reach, point + reach);
    [0, 1, 2].map(|axis| Interval { low: low[axis].next_down(), high: high[axis].next_up() })
}

/// Rounds a coordinate to an integer if its error cannot separate it from that integer.
#[inline]
fn settled(coordinate: f64, error: f64) -> f64 {
    let whole = coordinate.round();
    if (coordinate - whole).abs() <= error { whole } else { coordinate }
}

#[cfg(test)]
mod tests;
