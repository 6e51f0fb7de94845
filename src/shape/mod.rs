//! Solids in canonical form; one file, one shape: its equation, its crossings, its bounds.
//!
//! **Invariant:** knows only `math`, and `function` for what is made of one. Distances along a ray are in
//! (0, ∞): there is no least and no greatest distance, each crossing carries its own error bound instead.

pub mod algebraic;
pub mod bicubic_patch;
pub mod blob;
pub mod body;
mod bounds;
pub mod box_;
pub mod cone;
pub mod csg;
pub mod curve;
pub mod cylinder;
pub mod disc;
pub mod ellipsoid;
pub mod height_field;
pub mod isosurface;
pub mod julia_fractal;
pub mod lathe;
mod memory;
pub mod mesh;
mod multiple;
pub mod ovus;
pub mod parametric;
pub mod placed;
pub mod plane;
pub mod polygon;
pub mod prism;
mod slab;
pub mod sor;
pub mod sphere;
pub mod sphere_sweep;
pub mod superellipsoid;
pub mod text;
pub mod torus;
mod tree;

pub use algebraic::Algebraic;
pub use bicubic_patch::BicubicPatch;
pub use blob::Blob;
pub use body::Body;
pub use bounds::{Bounds, Rounding};
pub use box_::Box_;
pub use cone::Cone;
pub use cylinder::Cylinder;
pub use disc::Disc;
pub use ellipsoid::Ellipsoid;
pub use height_field::HeightField;
pub use isosurface::Isosurface;
pub use julia_fractal::JuliaFractal;
pub use lathe::Lathe;
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

use crate::math::{Real, Vector, Vector3};

/// Names one shape of the World: its kind, and its place in that kind's list.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Shape {
    Sphere(u32),
    Plane(u32),
    Box(u32),
    Ellipsoid(u32),
    Placed(u32),
}

impl Shape {
    /// A sphere, a plane or a box.
    #[inline(always)]
    pub fn is_plain(self) -> bool {
        match self {
            Self::Sphere(_) | Self::Plane(_) | Self::Box(_) => true,
            Self::Ellipsoid(_) | Self::Placed(_) => false,
        }
    }
}

/// A half-line: `origin + t · direction`, t > 0.
///
/// The error bounds of crossings hold for the direction that was meant, too, as long as each of its
/// components is off by no more than 2 roundoffs of it: a ray aimed at a point crosses the surfaces
/// through that point there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ray<R: Real = f64> {
    pub origin: R::Vector,
    /// Of length 1 within rounding.
    pub direction: R::Vector,
}

impl<R: Real> Ray<R> {
    #[inline]
    pub fn at(&self, t: R) -> R::Vector {
        self.origin + self.direction * t
    }

    /// Slides the ray to its closest approach to `centre`, before a curved shape sees it, so that
    /// what the shape squares is of the shape's own size and not of the distance. Flat shapes need
    /// none of it: their crossings are linear in the origin, and sliding would add a rounding.
    ///
    /// The error of `offset` across the ray is at most 2u·(|along| + |offset|), u the roundoff;
    /// `along` is off by at most 12u·(|along| + |offset|), as long as the direction's squared
    /// length is 1 within 8u.
    ///
    /// **Source:** E. Haines, J. Günther, T. Akenine-Möller, "Precision improvements for ray/sphere
    /// intersection", Ray Tracing Gems (2019), ch. 7.
    #[inline(always)]
    pub fn slide(&self, centre: R::Vector) -> Approach<R> {
        let start = self.origin - centre;
        let along = start.dot(self.direction);
        Approach { start, along, offset: start - self.direction * along }
    }
}

/// A ray as seen from a centre.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Approach<R: Real = f64> {
    /// From the centre to the ray's origin.
    pub start: R::Vector,
    /// From the closest approach to the origin, along the ray: positive when the ray moves away.
    pub along: R,
    /// From the centre to the closest approach, across the ray.
    pub offset: R::Vector,
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

impl<R: Real> Chord<R> {
    /// Of a line that is inside all along.
    pub const WHOLE: Self = Self { enter: Crossing::BEFORE_ALL, leave: Crossing::BEYOND_ALL };
}

impl<R: Real> Crossing<R> {
    pub const BEFORE_ALL: Self = Self { t: R::NEG_INFINITY, error: R::ZERO };
    pub const BEYOND_ALL: Self = Self { t: R::INFINITY, error: R::ZERO };

    /// Certainly ahead of the ray's start, at a finite distance. A crossing that cannot be told
    /// from the start is the surface the ray starts on.
    #[inline]
    pub fn is_ahead(&self) -> bool {
        self.t > self.error && self.t < R::INFINITY
    }
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

impl SurfacePoint {
    /// How far `point`, which was found at `t`, may be along each axis from where `ray` was meant to
    /// cross the surface; `crossing` is the kernel's.
    ///
    /// Along the ray it is the crossing's error, twice, as start and direction are no better than
    /// that; of a flat face 4u·t/|N·D| more, as the camera's or a mirror's vectors may nearly have cancelled
    /// in a component: a direction is then off by its length's roundoffs, and not by its component's. The
    /// bounds of others count that, and that they bend away: along them |N·D| may be nothing. The rest is what
    /// rounding start, direction and point adds, and putting the point onto the surface.
    pub fn spread(&self, ray: &Ray, t: f64, crossing: &Crossing, is_flat: bool) -> Vector {
        let turned = 4.0 * U * t / self.normal.dot(ray.direction).abs();
        let along =
            (t - crossing.t).abs() + 2.0 * crossing.error + if is_flat { turned } else { 0.0 };
        let across = ray.origin.abs() * (4.0 * U) + Vector::splat(8.0 * U * t);
        ray.direction.abs() * along + across + self.normal.abs() * self.error
    }

    /// A distance that [`SurfacePoint::spread`] exceeds along no axis, by far but easily computed;
    /// `error` bounds the crossing's. It has room for 16u·|P| more along each axis, P the point.
    ///
    /// The crossing's bound counts four times: the kernel's own t may be off as well. The start is
    /// at most |P| + t from the origin, along each axis.
    #[inline]
    pub fn spread_at_most(&self, ray: &Ray, t: f64, error: f64) -> f64 {
        let slope = self.normal.dot(ray.direction).abs();
        let size = self.point.abs().max_element() + t;
        4.0 * error + 4.0 * U * t / slope + 32.0 * U * size + self.error
    }

    /// Where the ray that goes on from here toward `direction` starts: moved along the normal, to
    /// the side on which it leaves, by the error bound and by nothing else. The bound has room for
    /// the rounding of this very sum.
    #[inline]
    pub fn spawn(&self, direction: Vector) -> Vector {
        let side = if direction.dot(self.normal) < 0.0 { -self.error } else { self.error };
        self.point + self.normal * side
    }
}

/// The roundoff of `f64`, 2⁻⁵³.
const U: f64 = f64::EPSILON / 2.0;

#[cfg(test)]
mod exact;
#[cfg(test)]
mod tests;
