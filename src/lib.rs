//! Compiler and ray tracer for a POV-Ray-like scene language.
//!
//! A scene passes through seven representations, connected by six stages. Each stage can report
//! diagnostics.
//!
//! ```text
//! Source ─parse→ Ast ─evaluate→ Scene ─lower→ World ─plan→ Plan ─trace→ Film ─develop→ Image
//! ```
#![forbid(unsafe_code)]

// The code that pest makes of the grammar names it.
extern crate alloc;

pub mod accuracy;
pub mod bvh;
pub mod color;
pub mod diagnostic;
pub mod evaluate;
pub mod film;
pub mod font;
pub mod function;
pub mod geometry;
pub mod lower;
pub mod math;
pub mod mesh_file;
pub mod noise;
pub mod pattern;
pub mod picture;
pub mod pilot;
pub mod plan;
pub mod road;
pub mod scene;
pub mod shape;
pub mod source;
pub mod spline;
pub mod standard;
pub mod syntax;
pub mod texture;
pub mod trace;
pub mod vocabulary;
pub mod world;
