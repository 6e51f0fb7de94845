//! Numbers, vectors and the maps between spaces.
//!
//! **Architecture invariant:** knows nothing of scenes, shapes or the language, and is the only
//! room that calls the elementary functions (through `libm`, so that a picture is the same on
//! every machine) and the only one that names `glam`.

pub mod double;
pub mod elementary;
pub mod interval;
pub mod placement;
pub mod power;
pub(crate) mod random;
pub mod roots;
pub mod singular;
pub mod terms;
pub mod transform;
pub mod vector;

pub(crate) use vector::reciprocal_power_of_two;
pub use vector::{Lanes, Matrix, Real, UnitVector, Vector, Vector3};
