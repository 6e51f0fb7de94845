//! Points of the screen to rays.
//!
//! **In:** the World's [`Camera`], the size of the full picture. **Out:** rays of unit direction; `None` for points
//! outside of a round picture. **Invariant:** mirrored points of the screen have exactly mirrored coordinates.
//!
//! A kind of camera is a [`Projection`], and has a file. The kind is chosen once for many rays.

mod cylinder;
mod fisheye;
mod flat;
mod focus;
mod mesh;
mod omnimax;
mod panoramic;
mod spherical;
mod ultra_wide_angle;

#[cfg(test)]
mod tests;

use std::f64::consts::{FRAC_PI_2, TAU};
use std::sync::Arc;

use crate::math::elementary::{atan2, sin_cos_degrees};
use crate::math::{UnitVector, Vector};
use crate::plan::Samples;
use crate::shape::Ray;
use crate::texture::Normal;
use crate::texture::space::Nowhere;
use crate::world::{Camera, CameraKind};

use cylinder::Cylinder;
use fisheye::Fisheye;
use flat::Flat;
pub(super) use focus::{Focus, Shift};
use mesh::Meshes;
use omnimax::Omnimax;
use panoramic::Panoramic;
use spherical::Spherical;
use ultra_wide_angle::UltraWideAngle;

/// A way to show the space around a camera on a screen.
trait Projection {
    /// Returns the ray through the point (`u`, `v`) of the screen, −½ … ½ from left to right and from bottom to
    /// top. Its direction has any length.
    fn through(&self, u: f64, v: f64) -> Option<Ray>;

    /// Returns the point at which a camera's normal is evaluated for the point (`u`, `v`) of the screen.
    fn film(&self, u: f64, v: f64) -> (f64, f64) {
        (u, v)
    }
}

/// The kinds of cameras.
enum Kind {
    /// Perspective and orthographic: origin and direction are linear in u and v.
    Flat(Flat),
    Fisheye(Fisheye),
    UltraWideAngle(UltraWideAngle),
    Omnimax(Omnimax),
    Panoramic(Panoramic),
    Cylinder(Cylinder),
    Spherical(Spherical),
    Meshes(Meshes),
}

/// A camera and the picture it makes.
pub(super) struct Lens {
    kind: Kind,
    focus: Option<Focus>,
    normal: Option<Arc<Normal>>,
    width: u32,
    height: u32,
}

/// A point of the screen, and one of a lens that blurs.
#[derive(Debug, Clone, Copy)]
pub(super) struct Point {
    pub u: f64,
    pub v: f64,
    /// −1 … 1 to the right and up.
    pub lens: [f64; 2],
}

impl Lens {
    pub fn new(camera: &Camera, width: u32, height: u32) -> Self {
        let kind = match camera.kind {
            CameraKind::Perspective | CameraKind::Orthographic => Kind::Flat(Flat::new(camera)),
            CameraKind::Fisheye { angle } => Kind::Fisheye(Fisheye::new(camera, angle)),
            CameraKind::UltraWideAngle { angle } => {
                Kind::UltraWideAngle(UltraWideAngle::new(camera, angle))
            }
            CameraKind::Omnimax => Kind::Omnimax(Omnimax::new(camera)),
            CameraKind::Panoramic => Kind::Panoramic(Panoramic::new(camera)),
            CameraKind::Cylinder { upright, moving, angle } => {
                Kind::Cylinder(Cylinder::new(camera, upright, moving, angle))
            }
            CameraKind::Mesh => match &camera.meshes {
                Some(meshes) => Kind::Meshes(Meshes::new(meshes.clone(), width, height)),
                None => Kind::Flat(Flat::new(camera)),
            },
            CameraKind::Spherical { across, down } => {
                Kind::Spherical(Spherical::new(camera, across, down))
            }
        };
        let focus = camera.focus.as_ref().map(|focus| Focus::new(camera, focus));
        Self { kind, focus, normal: camera.normal.clone(), width, height }
    }

    /// Returns the same lens, whose blur is sampled as the options say.
    pub fn sampled(self, samples: Samples) -> Self {
        Self { focus: self.focus.map(|focus| focus.sampled(samples)), ..self }
    }

    /// Returns the point of sample (`i`, `j`) of the `grid` × `grid` samples of pixel (`x`, `y`), both counted
    /// from the top left.
    #[inline(always)]
    pub fn point(&self, (x, y): (u32, u32), (i, j): (u32, u32), grid: u32) -> Point {
        let (u, v) = (centre(x, i, self.width, grid), -centre(y, j, self.height, grid));
        Point { u, v, lens: [0.0; 2] }
    }

    /// Returns the point of pixel (`x`, `y`) at a place, 0 … 1 from its left and from its top, a whole multiple of 2⁻³².
    /// In its centre, it is that of a single sample.
    #[inline(always)]
    pub fn at(&self, (x, y): (u32, u32), (right, down): (f64, f64)) -> Point {
        // Only the division rounds.
        let place = |pixel: u32, within: f64, pixels: u32| {
            let n = f64::from(pixels);
            (2.0 * (f64::from(pixel) + within) - n) / (2.0 * n)
        };
        Point { u: place(x, right, self.width), v: -place(y, down, self.height), lens: [0.0; 2] }
    }

    /// Returns a point of pixel (`x`, `y`), 0 … 1 from its left and from its top, and the point of the lens for two
    /// numbers from 0 to 1.
    pub fn point_within(&self, pixel: (u32, u32), within: (f64, f64), lens: [f64; 2]) -> Point {
        let (u, v) = self.place(pixel, within);
        Point { u, v, lens: self.focus.as_ref().map_or([0.0; 2], |focus| focus.point(lens)) }
    }

    /// Returns sample `number` of a blurred pixel with this shift, somewhere in it and on the lens. It depends on nothing
    /// else.
    #[inline(always)]
    pub fn blurred(&self, focus: &Focus, pixel: (u32, u32), shift: &Shift, number: u32) -> Point {
        let [[right, down], lens] = focus.sample(shift, number);
        let (u, v) = self.place(pixel, (right, down));
        Point { u, v, lens }
    }

    #[inline(always)]
    fn place(&self, (x, y): (u32, u32), (right, down): (f64, f64)) -> (f64, f64) {
        let place = |pixel: u32, within: f64, pixels: u32| {
            (f64::from(pixel) + within) / f64::from(pixels) - 0.5
        };
        (place(x, right, self.width), -place(y, down, self.height))
    }

    /// Returns the lens, if it blurs.
    pub fn focus(&self) -> Option<&Focus> {
        self.focus.as_ref()
    }

    pub fn has_normal(&self) -> bool {
        self.normal.is_some()
    }

    /// Returns the camera and its lens, if it blurs, where rays need nothing but [`Flat::find`] or [`Flat::find_blurred`].
    #[inline(always)]
    pub fn flat(&self) -> Option<(&Flat, Option<&Focus>)> {
        match &self.kind {
            Kind::Flat(flat) if self.normal.is_none() => Some((flat, self.focus.as_ref())),
            _ => None,
        }
    }

    /// Returns how many rays there are for each point of the screen.
    pub fn rays_of_a_point(&self) -> usize {
        match &self.kind {
            Kind::Meshes(meshes) => meshes.rays_of_a_place(),
            _ => 1,
        }
    }

    /// Returns the rays through points of the screen; for a point of several, they are neighbours.
    pub fn rays(&self, points: &[Point]) -> Vec<Option<Ray>> {
        match &self.kind {
            Kind::Flat(kind) => self.each(kind, points),
            Kind::Fisheye(kind) => self.each(kind, points),
            Kind::UltraWideAngle(kind) => self.each(kind, points),
            Kind::Omnimax(kind) => self.each(kind, points),
            Kind::Panoramic(kind) => self.each(kind, points),
            Kind::Cylinder(kind) => self.each(kind, points),
            Kind::Spherical(kind) => self.each(kind, points),
            Kind::Meshes(kind) => points.iter().flat_map(|p| kind.rays(p.u, p.v)).collect(),
        }
    }

    fn each(&self, kind: &impl Projection, points: &[Point]) -> Vec<Option<Ray>> {
        let ray = |&Point { u, v, lens }: &Point| {
            let ray = kind.through(u, v)?;
            let ray = self.focus.as_ref().map_or(ray, |focus| focus.bent(ray, lens));
            let direction = unit(ray.direction);
            let direction = match &self.normal {
                Some(normal) => bumped(normal, direction, kind.film(u, v)),
                None => direction,
            };
            Some(Ray { direction, ..ray })
        };
        points.iter().map(ray).collect()
    }
}

/// Returns the direction of a ray through a camera's normal: that of the ray, perturbed as the normal of a surface at
/// a point of the screen.
///
/// **Source:** measured on POV-Ray 3.7.
fn bumped(normal: &Normal, direction: Vector, (x, y): (f64, f64)) -> Vector {
    normal.perturbed(direction, None, &Nowhere::exact(Vector::new(x, y, 0.0)))
}

/// The camera's vectors, each of length 1.
struct Axes {
    forward: Vector,
    right: Vector,
    up: Vector,
}

impl Axes {
    fn of(camera: &Camera) -> Self {
        let [forward, right, up] = [camera.forward, camera.right, camera.up].map(unit);
        Self { forward, right, up }
    }
}

/// Returns the length of a vector, also where its square over- or underflows.
fn length(v: Vector) -> f64 {
    let largest = v.abs().max_element();
    if largest == 0.0 || !largest.is_finite() { largest } else { (v / largest).length() * largest }
}

/// Returns the angle of (x, y) from x toward y in radians, −π/2 … 3π/2, as POV-Ray 3.7 measures it for a camera's
/// normal.
fn polar_angle(x: f64, y: f64) -> f64 {
    let angle = atan2(y, x);
    if angle < -FRAC_PI_2 { angle + TAU } else { angle }
}

/// Returns the sine and cosine of an angle in turns: exact at quarters.
fn sin_cos(turns: f64) -> (f64, f64) {
    sin_cos_degrees(360.0 * turns)
}

/// A direction `turns` from `forward` toward (`x`, `y`) along `right` and `up`, where (x, y) has the length `radius`.
fn around(axes: &Axes, (sine, cosine): (f64, f64), (x, y): (f64, f64), radius: f64) -> Vector {
    if radius == 0.0 {
        return axes.forward;
    }
    (axes.right * (x / radius) + axes.up * (y / radius)) * sine + axes.forward * cosine
}

/// Where the centre of sample `sample` of pixel `pixel` lies between −½ and ½ of a screen `pixels`
/// wide: (2k + 1 − n) / 2n for the k-th of n, whose numerator is a whole number.
#[inline(always)]
fn centre(pixel: u32, sample: u32, pixels: u32, grid: u32) -> f64 {
    let n = f64::from(pixels) * f64::from(grid);
    let k = f64::from(pixel) * f64::from(grid) + f64::from(sample);
    (2.0 * k + 1.0 - n) / (2.0 * n)
}

/// The direction of `v`, also where its square over- or underflows. A screen whose axes are at
/// right angles to its (non-zero) `forward` has no point in direction zero.
#[inline(always)]
fn unit(v: Vector) -> Vector {
    let square = v.length_squared();
    if square.is_normal() {
        v / square.sqrt()
    } else {
        UnitVector::from_direction(v).map_or(Vector::ZERO, UnitVector::get)
    }
}
