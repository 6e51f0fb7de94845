//! Shapes in canonical form, and where rays cross them; one file for each shape.
//!
//! **Invariant:** depends only on `math`, and on `function` for shapes defined by functions. Distances along
//! a ray are in (0, ∞): there is no minimum or maximum distance; instead, each crossing carries its own error
//! bound.

pub(crate) mod algebraic;
pub(crate) mod bicubic_patch;
pub mod blob;
pub(crate) mod body;
pub(crate) mod box_;
pub(crate) mod cone;
pub(crate) mod csg;
pub mod curve;
pub(crate) mod cylinder;
pub(crate) mod disc;
pub(crate) mod ellipsoid;
pub(crate) mod height_field;
pub mod isosurface;
pub mod julia_fractal;
pub(crate) mod lathe;
pub(crate) mod local;
mod memory;
pub mod mesh;
mod multiple;
pub(crate) mod ovus;
pub(crate) mod parametric;
pub(crate) mod placed;
pub(crate) mod plane;
pub(crate) mod polygon;
pub(crate) mod prism;
pub(crate) mod seen;
mod slab;
pub mod sor;
pub(crate) mod sphere;
pub mod sphere_sweep;
pub(crate) mod superellipsoid;
pub(crate) mod text;
pub(crate) mod torus;
mod tree;
pub(crate) mod uv;
mod wide;

pub use algebraic::Algebraic;
pub use bicubic_patch::BicubicPatch;
pub use blob::Blob;
pub use body::Body;
pub use box_::Box_;
pub use cone::Cone;
pub use cylinder::Cylinder;
pub use disc::Disc;
pub use ellipsoid::Ellipsoid;
pub use height_field::HeightField;
pub use isosurface::Isosurface;
pub use julia_fractal::JuliaFractal;
pub use lathe::Lathe;
#[doc(hidden)]
pub use memory::Memory;
pub use mesh::Mesh;
pub use ovus::Ovus;
pub use parametric::Parametric;
pub use placed::Placed;
pub use plane::Plane;
pub use polygon::Polygon;
pub use prism::Prism;
pub use sor::Sor;
pub use sphere::Sphere;
pub use sphere_sweep::SphereSweep;
pub use superellipsoid::Superellipsoid;
pub use text::Text;
pub use torus::Torus;
pub(crate) use wide::chords::{Chords, ChordsOfFour};
pub(crate) use wide::points::WideFacets;
pub(crate) use wide::{First, FirstOfFour, WidePlanes, WidePoints, WideSpheres};

use crate::math::Vector;
pub use crate::math::bounds::Bounds;
pub(crate) use crate::math::bounds::Rounding;
pub(crate) use crate::math::ray::Approach;
pub use crate::math::ray::Ray;

/// Identifies one shape of the world by its kind and its index in that kind's list.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Shape {
    Sphere(u32),
    Plane(u32),
    Box(u32),
    Ellipsoid(u32),
    Placed(u32),
}

pub(crate) use crate::texture::space::Paint;

/// A point where a ray passes through a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crossing {
    /// Distance along the ray.
    pub t: f64,
    /// Error bound: the true crossing lies within this distance of `t`.
    pub error: f64,
}

/// The part of a line inside a convex solid, from entry to exit; `enter.t` may be negative or −∞, `leave.t`
/// may be +∞.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Chord {
    pub enter: Crossing,
    pub leave: Crossing,
}

impl Chord {
    /// The chord of a line that lies entirely inside.
    pub const WHOLE: Self = Self { enter: Crossing::BEFORE_ALL, leave: Crossing::BEYOND_ALL };
}

impl Crossing {
    pub const BEFORE_ALL: Self = Self { t: f64::NEG_INFINITY, error: 0.0 };
    pub const BEYOND_ALL: Self = Self { t: f64::INFINITY, error: 0.0 };

    /// Returns whether the crossing is certainly ahead of the ray's start, at a finite distance. A crossing
    /// that rounding cannot separate from the start belongs to the surface the ray starts on.
    #[inline]
    pub fn is_ahead(&self) -> bool {
        self.t > self.error && self.t < f64::INFINITY
    }
}

/// The point of a surface that a ray hits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfacePoint {
    /// The hit point, projected onto the surface.
    pub point: Vector,
    /// Outward unit normal.
    pub normal: Vector,
    /// Error bound: the true surface lies within this distance of `point` along the normal.
    pub error: f64,
    /// The flat face that was hit, for shapes that have faces: 0 for a plane; for face i of a box, 2i, and
    /// for the opposite face, 2i + 1.
    pub face: u32,
}

impl SurfacePoint {
    /// Returns, for each axis, a bound on the distance from `point`, found at `t`, to the exact crossing of
    /// the intended `ray`; `crossing` is the kernel's result.
    ///
    /// Along the ray, the bound is twice the crossing's error, as start and direction are known no better
    /// than that. Flat faces add 4u·t/|N·D|: the vectors of the camera or of a mirror may nearly have
    /// cancelled in a component, so that a direction is off by roundoffs of its length, not of its component.
    /// The error bounds of curved shapes include that term, and those surfaces bend away where |N·D| may
    /// be 0. The remaining terms cover the rounding of start, direction and point, and of the projection onto
    /// the surface.
    pub fn spread(&self, ray: &Ray, t: f64, crossing: &Crossing, is_flat: bool) -> Vector {
        let turned = 4.0 * U * t / self.normal.dot(ray.direction).abs();
        let along =
            (t - crossing.t).abs() + 2.0 * crossing.error + if is_flat { turned } else { 0.0 };
        let across = ray.origin.abs() * (4.0 * U) + Vector::splat(8.0 * U * t);
        ray.direction.abs() * along + across + self.normal.abs() * self.error
    }

    /// Returns a cheap upper bound on [`SurfacePoint::spread`] along every axis; `error` bounds the
    /// crossing's error. The result leaves room for 16u·|P| more along each axis, P the point.
    ///
    /// The crossing's bound counts four times, as the kernel's own t may be off as well. Along each axis, the
    /// start is at most |P| + t from the origin.
    #[inline]
    pub fn spread_at_most(&self, ray: &Ray, t: f64, error: f64) -> f64 {
        let slope = self.normal.dot(ray.direction).abs();
        let size = self.point.abs().max_element() + t;
        4.0 * error + 4.0 * U * t / slope + 32.0 * U * size + self.error
    }

    /// Returns the origin of a ray that continues from here toward `direction`: `point`, moved along the
    /// normal by the error bound alone, to the side on which the ray leaves. The bound leaves room for the
    /// rounding of this sum.
    #[inline]
    pub fn spawn(&self, direction: Vector) -> Vector {
        let side = if direction.dot(self.normal) < 0.0 { -self.error } else { self.error };
        self.point + self.normal * side
    }
}

/// Unit roundoff of `f64`, 2⁻⁵³.
const U: f64 = f64::EPSILON / 2.0;

#[cfg(test)]
mod exact;
#[cfg(test)]
mod tests;
