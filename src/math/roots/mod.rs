//! Roots of functions of one variable, each with an error bound.

pub mod bracket;
pub mod convex;
pub mod isolate;
pub mod monotone;
pub mod polynomial;
