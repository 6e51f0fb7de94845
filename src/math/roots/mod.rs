//! Roots of functions of one number, each with a bound on its error.

pub mod bracket;
pub mod convex;
pub mod isolate;
pub mod monotone;
pub mod polynomial;
