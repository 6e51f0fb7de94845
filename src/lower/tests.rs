//! Laws of lowering.

mod build;
mod form;
