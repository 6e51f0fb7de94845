//! Numbers, vectors and maps between spaces.
//!
//! **Architecture invariant:** independent of scenes, shapes and the language. The only module that calls the
//! elementary functions (through `libm`, so that a picture is the same on every machine), and the only one
//! that uses `glam`.

pub mod bounds;
pub mod double;
pub mod elementary;
pub(crate) mod finite;
pub mod interval;
pub mod placement;
pub mod power;
pub(crate) mod random;
pub mod ray;
pub mod roots;
pub mod singular;
pub mod terms;
pub mod transform;
pub mod vector;
pub mod wide;

pub(crate) use vector::reciprocal_power_of_two;
pub use vector::{AbsDot, Lanes, Matrix, UnitVector, Vector};
