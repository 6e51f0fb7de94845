//! Real roots of polynomials, each with an error bound.

pub mod polynomial;
