//! Numbers, vectors and maps between spaces.
//!
//! **Architecture invariant:** independent of scenes, shapes and the language. The only module that calls the
//! elementary functions (through `libm`, so that a picture is the same on every machine), and the only one
//! that uses `glam`.

pub(crate) mod bounds;
#[doc(hidden)]
pub mod double;
#[doc(hidden)]
pub mod elementary;
pub(crate) mod finite;
pub(crate) mod interval;
pub mod placement;
pub(crate) mod power;
pub(crate) mod random;
pub(crate) mod ray;
pub(crate) mod roots;
pub(crate) mod singular;
#[doc(hidden)]
pub mod terms;
pub mod transform;
pub(crate) mod vector;
pub(crate) mod wide;

pub(crate) use vector::{AbsDot, Lanes, reciprocal_power_of_two};
pub use vector::{Matrix, UnitVector, Vector};
