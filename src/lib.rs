//! Compiler and ray tracer for a POV-Ray-like scene language.
//!
//! [`render()`] makes a picture of the text of a scene:
//!
//! ```
//! use lucarne::{RenderOptions, picture::Format, render};
//!
//! let text = "camera { location <0, 2, 5> look_at 0 } light_source { <9, 9, 9>, rgb 1 }
//!     sphere { 0, 1 pigment { rgb <1, 0.5, 0> } finish { phong 1 } }
//!     plane { y, -1 pigment { checker rgb 1 rgb 0.2 } }";
//! let picture = render(text, &RenderOptions::of_size(160, 120))?;
//! let mut png = Vec::new();
//! picture.write(Format::Png, &mut png)?;
//! # assert_eq!(&png[1..4], b"PNG");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A scene passes through seven representations, connected by six stages. Each stage can report
//! diagnostics, and can be called by itself; [`road::Road`] calls one after the other.
//!
//! ```text
//! Source ─parse→ Ast ─evaluate→ Scene ─lower→ World ─plan→ Plan ─trace→ Film ─develop→ Image
//! ```
#![forbid(unsafe_code)]

// The code that pest makes of the grammar names it.
extern crate alloc;

pub mod accuracy;
pub(crate) mod bvh;
pub mod color;
pub mod diagnostic;
pub mod disk;
pub mod evaluate;
pub mod film;
pub(crate) mod font;
#[doc(hidden)]
pub mod function;
#[doc(hidden)]
pub mod geometry;
pub mod lower;
pub mod math;
#[doc(hidden)]
pub mod mesh_file;
pub(crate) mod noise;
pub mod pattern;
pub mod picture;
pub mod pilot;
pub mod plan;
mod render;
pub mod road;
pub mod scene;
pub mod shape;
pub mod source;
pub(crate) mod spline;
#[doc(hidden)]
pub mod standard;
pub mod syntax;
pub mod texture;
pub mod trace;
pub mod vocabulary;
pub mod world;

pub use diagnostic::Messages;
pub use render::{Picture, RenderOptions, render};
