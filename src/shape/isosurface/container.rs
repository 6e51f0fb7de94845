//! Containers of isosurfaces: a box or a sphere around the local origin, whose own surface closes what it
//! clips.

use super::SURFACE;
use crate::math::Vector;
use crate::math::interval::Interval;
use crate::shape::U;
use crate::shape::local::{Height, LocalRay, Met};
use crate::shape::slab::Slab;

/// The container of an isosurface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Container {
    /// Half widths of a box.
    Box(Vector),
    /// Radius of a sphere.
    Sphere(f64),
}

impl Container {
    /// Returns where a line is inside.
    pub(super) fn chord(&self, ray: &LocalRay) -> Option<(Met, Met)> {
        match *self {
            Self::Sphere(radius) => ball(ray, radius),
            Self::Box(half) => {
                let endless = |t, leaving| Met { t, error: 0.0, leaving, part: 1 };
                let whole = (endless(f64::NEG_INFINITY, false), endless(f64::INFINITY, true));
                let far = 2.0 * half.length();
                (0..3).try_fold(whole, |(enter, leave), axis| {
                    let part = SURFACE + 1 + 2 * axis as u32;
                    let heights = [-half[axis], half[axis]];
                    let (off, parts) = (U * far, [part, part + 1]);
                    let slab = Slab { axis, heights, far, off, parts };
                    let (first, last) = slab.chord(ray)?;
                    Some((enter.later(first), leave.earlier(last)))
                })
            }
        }
    }

    /// Returns whether a box certainly lies outside.
    pub(in crate::shape) fn misses(&self, other: &[Interval; 3]) -> bool {
        let outside = |distance: f64, reach: f64| distance > reach * (1.0 + 16.0 * U);
        let nearest = other.map(|along| along.low.max(-along.high).max(0.0));
        match *self {
            Self::Box(half) => (0..3).any(|axis| outside(nearest[axis], half[axis])),
            Self::Sphere(radius) => outside(Vector::from_array(nearest).length(), radius),
        }
    }

    /// Returns the maximum of `along`·P.
    pub(in crate::shape) fn extent(&self, along: Vector) -> f64 {
        match self {
            Self::Box(half) => along.abs().dot(*half),
            Self::Sphere(radius) => along.length() * radius,
        }
    }

    pub(in crate::shape) fn reach(&self) -> f64 {
        match self {
            Self::Box(half) => half.length(),
            Self::Sphere(radius) => *radius,
        }
    }

    /// Returns the half widths of its bounding box.
    pub(in crate::shape) fn half(&self) -> Vector {
        match *self {
            Self::Box(half) => half,
            Self::Sphere(radius) => Vector::splat(radius),
        }
    }

    pub(in crate::shape) fn contains(&self, point: Vector) -> bool {
        match self {
            Self::Box(half) => point.abs().cmplt(*half).all(),
            Self::Sphere(radius) => point.length() < *radius,
        }
    }
}

/// Chord of a sphere, computed as for the side of a cylinder. **Error** of s: with m the distance of the
/// line, h half of the chord and δ their error: δ·m/h or √(2δ·m + δ²), plus δ.
fn ball(ray: &LocalRay, radius: f64) -> Option<(Met, Met)> {
    let miss = ray.nearest.length();
    let half = ((radius - miss) * (radius + miss)).sqrt();
    if !half.gt(&0.0) {
        return None;
    }
    let off = ray.blur_at(half) + 8.0 * U * radius;
    let error = (off * miss / half).min((2.0 * off * miss + off * off).sqrt()) + off;
    let met = |t, leaving| Met { t, error, leaving, part: SURFACE + 1 };
    Some((met(-half, false), met(half, true)))
}

impl Container {
    pub(super) fn height(&self, part: u32, point: Vector) -> Height {
        match self {
            Self::Sphere(radius) => {
                let distance = point.length();
                let gradient = (point / distance).normalize_or(Vector::Y);
                Height { value: distance - radius, gradient, error: 8.0 * U * radius }
            }
            Self::Box(half) => {
                let side = part.saturating_sub(SURFACE + 1);
                let axis = (side / 2).min(2) as usize;
                let way = if side % 2 == 1 { 1.0 } else { -1.0 };
                let gradient = [Vector::X, Vector::Y, Vector::Z][axis] * way;
                Height {
                    value: point.dot(gradient) - half[axis],
                    gradient,
                    error: 2.0 * U * half[axis],
                }
            }
        }
    }
}
