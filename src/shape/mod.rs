//! Solids in canonical form; one file, one shape: its equation, its crossings, its bounds.
//!
//! **Invariant:** knows only `math`. Distances along a ray are in (0, ∞): there is no least and no
//! greatest distance, each crossing carries its own error bound instead.

pub mod box_;
pub mod ellipsoid;
pub mod plane;
pub mod sphere;

pub use box_::Box_;
pub use ellipsoid::Ellipsoid;
pub use plane::Plane;
pub use sphere::Sphere;

use crate::math::{Real, Vector};

/// Names one shape of the World: its kind, and its place in that kind's list.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Shape {
    Sphere(u32),
    Plane(u32),
    Box(u32),
    Ellipsoid(u32),
}

/// A half-line: `origin + t · direction`, t > 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ray<R: Real = f64> {
    pub origin: R::Vector,
    /// Of length 1 within rounding.
    pub direction: R::Vector,
}

/// Where a ray passes through a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crossing<R: Real = f64> {
    /// Distance along the ray.
    pub t: R,
    /// The true crossing lies within this distance of `t`.
    pub error: R,
}

/// The part of a ray inside a convex solid: where it enters and where it leaves; `enter.t` may be
/// negative or −∞, `leave.t` may be +∞.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Chord<R: Real = f64> {
    pub enter: Crossing<R>,
    pub leave: Crossing<R>,
}

/// The surface where a ray hit it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfacePoint {
    /// The hit, put back onto the surface.
    pub point: Vector,
    /// Of length 1, out of the solid.
    pub normal: Vector,
    /// The true surface lies within this distance of `point`, along the normal.
    pub error: f64,
    /// Which flat face was hit, for shapes that have such: plane 0; box 2i for face i, 2i + 1 for
    /// the one opposite.
    pub face: u32,
}

/// A box along the axes that holds a shape.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    pub low: Vector,
    pub high: Vector,
}
