//! Renders scenes in POV-Ray's scene language: a compiler, and the ray tracer behind it.
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
//! | to | use |
//! |---|---|
//! | choose the size, the antialiasing, the threads, or the value of `clock` | [`RenderOptions`] |
//! | give the scene files: from memory, or from a folder | [`RenderOptions::files`]: a closure, or [`DiskFiles`](disk::DiskFiles) |
//! | show progress, or stop early | [`RenderOptions::watch`]: a [`Watched`](trace::Watched) closure |
//! | get pixels: in 8 bits, in linear floats, or as a file | [`Picture::rgba8`], [`Picture::linear`], [`Picture::write`] |
//! | read errors and warnings: as data, text or JSON | [`Messages`] |
//! | write an animation | [`Animated`](picture::animated::Animated) |
//!
//! # Stages
//!
//! A scene passes through seven representations, all plain data. Six stages connect them, and each is a function that
//! you can call by itself:
//!
//! | function | takes | returns |
//! |---|---|---|
//! | [`parse`](syntax::parse()) | a [`Source`](source::Source): the text of a file | an [`Ast`](syntax::ast::Ast): the text as a tree |
//! | [`evaluate`](evaluate::evaluate()) | the `Ast`, and [`Files`](source::Files) | a [`Scene`](scene::Scene): objects as written, without macros, loops and names |
//! | [`lower`](lower::lower()) | the `Scene` | a [`World`](world::World): shapes, lights and textures in canonical form, and their [`Origins`](world::Origins) in the text |
//! | [`plan`](plan::plan()) | the `World`, and [`PlanOptions`](plan::PlanOptions) | a [`Plan`](plan::Plan): which effects are simulated, and why |
//! | [`trace`](trace::trace()) | the `World` and the `Plan` | a [`Film`](film::Film): the light of each pixel |
//! | [`develop`](film::develop()) | the `Film` | an [`Image`](film::Image): numbers to show or to store |
//!
//! [`Road`](road::Road) runs the first three, and collects sources and messages. Each of these reports to
//! [`Diagnostics`](diagnostic::Diagnostics), and returns a result even for a text with mistakes. Beside the stages,
//! [`pilot`](pilot::pilot()) predicts the number of rays of a `Plan`, and [`accuracy`](accuracy::accuracy()) measures what
//! each setting costs and gains.
//!
//! # Features
//!
//! `cli`, on by default, builds the program `lucarne`. Without it, the crate needs none of the program's dependencies, and
//! compiles for `wasm32-unknown-unknown`.
#![forbid(unsafe_code)]
#![warn(missing_docs)]

// The code that pest makes of the grammar names it.
extern crate alloc;

pub mod accuracy;
pub mod diagnostic;
pub mod disk;
pub mod evaluate;
pub mod film;
pub mod lower;
pub mod picture;
pub mod pilot;
pub mod plan;
mod render;
pub mod road;
pub mod source;
pub mod syntax;
pub mod trace;
pub mod vocabulary;

// Mostly data: fields and variants are named by the words of the language, or of geometry.
#[allow(missing_docs)]
pub mod color;
#[allow(missing_docs)]
pub mod math;
#[allow(missing_docs)]
pub mod pattern;
#[allow(missing_docs)]
pub mod scene;
#[allow(missing_docs)]
pub mod shape;
#[allow(missing_docs)]
pub mod texture;
#[allow(missing_docs)]
pub mod world;

// Not part of the interface: the crate's own tests and benchmarks call them.
#[doc(hidden)]
pub mod function;
#[doc(hidden)]
pub mod geometry;
#[doc(hidden)]
pub mod mesh_file;
#[doc(hidden)]
pub mod standard;

pub(crate) mod bvh;
pub(crate) mod font;
pub(crate) mod noise;
pub(crate) mod spline;

/// Tests the examples of these pages.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
#[doc = include_str!("../docs/programs.md")]
mod pages {}

#[doc(inline)]
pub use diagnostic::Messages;
pub use render::{Picture, RenderOptions, render};
