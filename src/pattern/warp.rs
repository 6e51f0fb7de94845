//! Warps, which move the point at which a pattern is evaluated; one file for each family.
//!
//! **In:** a point, and its error. **Out:** the point in the pattern's own space. **Invariant:** finite for
//! all points and parameters.
//!
//! The rules by which a block moves a point, measured on POV-Ray 3.7:
//!
//! 1. Transformations and `warp` statements form one list in the order in which they are written, including
//!    those of an object around the block. A point goes through the list from its end to its start: through
//!    the inverse of a transformation, and through [`Warp::moved`].
//! 2. The plain `turbulence` of the block comes after that, so its amount and scale are those of the
//!    pattern's own space, wherever it is written: the point p becomes p + amount · turbulence(p), by axis.
//!    Of several `turbulence`, `octaves`, `lambda` and `omega`, the last of each counts, also if they come
//!    after an identifier; `turbulence 0` turns it off.
//! 3. The blocks inside of a map, a list or `average` start from that point, turbulence included, and apply
//!    their own rules to it; this is the same in pigments and textures. For `marble` and `wood`, which use
//!    turbulence only in their value, they start from the point before turbulence; `spiral1` and `spiral2` use
//!    it both ways.
//! 4. A `warp { turbulence }` has its own octaves, lambda and omega; those of the block do not affect it. No
//!    noise generator affects turbulence that moves points.
//!
//! **Source:** POV-Ray manual, section "Warp".

mod black_hole;
mod cubic;
mod mapping;
mod repeat;
mod turbulence;

pub use black_hole::BlackHole;
pub use cubic::Cubic;
pub use mapping::{Cylindrical, Planar, Spherical, Toroidal};
pub use repeat::Repeat;
pub use turbulence::Turbulence;

use std::fmt;

use super::parameter::{self, Parameters};
use super::{Argument, Parameter};
use crate::math::Vector;
use crate::math::interval::Interval;
use crate::math::wide::{Rows, numbers};

/// Declares the closed set of warps. A line is the word and the struct.
macro_rules! warps {
    ($($word:literal $kind:ident)*) => {
        /// A warp with its parameters.
        #[derive(Debug, Clone, Copy, PartialEq)]
        pub enum Warp {
            $($kind($kind),)*
        }

        impl Warp {
            /// All warps, with their default parameters.
            pub fn all() -> Vec<Self> {
                vec![$(Self::$kind($kind::default())),*]
            }

            /// Returns the warp of a word, with its default parameters.
            pub fn of_word(word: &str) -> Option<Self> {
                match word {
                    $($word => Some(Self::$kind($kind::default())),)*
                    _ => None,
                }
            }

            /// Returns its word in the language.
            pub fn word(&self) -> &'static str {
                match self {
                    $(Self::$kind(_) => $word,)*
                }
            }

            pub fn parameters(&self) -> &'static [Parameter] {
                match self {
                    $(Self::$kind(_) => $kind::PARAMETERS,)*
                }
            }

            /// Returns the value of a parameter by its place in [`Warp::parameters`].
            pub fn get(&self, place: usize) -> Option<Argument> {
                match self {
                    $(Self::$kind(warp) => warp.get(place),)*
                }
            }

            /// Sets a parameter by its place; its argument must have the default's type.
            pub fn set(&mut self, place: usize, argument: Argument) {
                match self {
                    $(Self::$kind(warp) => warp.set(place, argument),)*
                }
            }

            /// Returns the same warp with parameters in canonical form, as [`Warp::point`] needs them.
            pub fn canonical(self) -> Self {
                match self {
                    $(Self::$kind(warp) => Self::$kind(warp.canonical()),)*
                }
            }

            /// Returns where a point moves to, with its new error; 0 if that is not known any more. A point
            /// that its error cannot separate from a seam of the warp is on the seam.
            #[inline]
            pub fn moved(&self, point: Vector, error: Vector) -> (Vector, Vector) {
                let (point, error) = match self {
                    $(Self::$kind(warp) => warp.moved(point, error),)*
                };
                (finite(point), finite(error))
            }

            /// Returns a box that contains what each point of a box moves to.
            pub fn bounds(&self, sides: [Interval; 3]) -> [Interval; 3] {
                match self {
                    $(Self::$kind(warp) => warp.bounds(sides),)*
                }
            }
        }
    };
}

warps! {
    "black_hole" BlackHole
    "cubic" Cubic
    "cylindrical" Cylindrical
    "planar" Planar
    "repeat" Repeat
    "spherical" Spherical
    "toroidal" Toroidal
    "turbulence" Turbulence
}

/// Writes the word and the values of parameters that are not the default's, as in the language.
impl fmt::Display for Warp {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.word())?;
        parameter::write(f, self.parameters(), |place| self.get(place))
    }
}

impl Warp {
    /// Returns where a point moves to.
    #[inline]
    pub fn point(&self, point: Vector) -> Vector {
        self.moved(point, Vector::ZERO).0
    }

    /// Replaces each of the points that the mask has a bit for by where it moves to.
    pub fn points(&self, points: &mut Rows, mask: u32) {
        match self {
            Self::Turbulence(turbulence) => {
                let mut moves = Rows::ZERO;
                turbulence.moves(points, mask, &mut moves);
                for number in numbers(mask) {
                    points.set(number, finite(points.at(number) + moves.at(number)));
                }
            }
            _ => {
                for number in numbers(mask) {
                    points.set(number, self.point(points.at(number)));
                }
            }
        }
    }
}

/// What a warp implements; its parameters are declared by `parameters!`.
trait Warping: Parameters + Copy {
    /// See [`Warp::canonical`].
    fn canonical(self) -> Self {
        self
    }

    /// See [`Warp::moved`]; coordinates may overflow.
    fn moved(&self, point: Vector, error: Vector) -> (Vector, Vector);

    /// See [`Warp::bounds`].
    fn bounds(&self, _sides: [Interval; 3]) -> [Interval; 3] {
        [Interval::EVERYTHING; 3]
    }
}

/// Clamps coordinates that overflowed.
#[inline]
fn finite(v: Vector) -> Vector {
    const FAR: f64 = 1e300;
    if v.is_finite() {
        return v;
    }
    Vector::from_array(v.to_array().map(|c| if c.is_nan() { 0.0 } else { c.clamp(-FAR, FAR) }))
}

#[cfg(test)]
mod tests;
