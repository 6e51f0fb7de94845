//! Roots of functions of one number, each with a bound on its error.

pub mod bracket;
pub mod polynomial;
