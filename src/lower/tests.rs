//! Laws of lowering.

mod build;
mod camera;
mod drift;
mod fault;
mod form;
mod gap;
mod interior;
mod mesh;
mod seed_rules;
mod shared;
mod spelling;
mod texture;
