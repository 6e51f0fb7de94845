//! Points of the screen to rays.
//!
//! **In:** the World's [`Camera`], the whole picture's size. **Out:** rays of unit direction.
//! **Invariant:** mirrored points of the screen have exactly mirrored coordinates.

use crate::math::{UnitVector, Vector};
use crate::shape::Ray;
use crate::world::{Camera, CameraKind};

/// A camera and the picture it makes: of each point (u, v) of the screen, where its ray begins and, in no
/// unit, where it goes; both are linear in u and v, whatever the kind of camera.
pub(super) struct Lens {
    origin: Vector,
    /// What the origin moves by along u and along v.
    shift: [Vector; 2],
    direction: Vector,
    /// What the direction turns by along u and along v.
    turn: [Vector; 2],
    width: u32,
    height: u32,
}

impl Lens {
    pub fn new(camera: &Camera, width: u32, height: u32) -> Self {
        let &Camera { kind, location: origin, forward: direction, right, up } = camera;
        let (screen, still) = ([right, up], [Vector::ZERO; 2]);
        let (shift, turn) = match kind {
            CameraKind::Perspective => (still, screen),
            CameraKind::Orthographic => (screen, still),
        };
        Self { origin, shift, direction, turn, width, height }
    }

    /// The ray through sample (`i`, `j`) of the `grid` × `grid` samples of pixel (`x`, `y`), both
    /// counted from the top left.
    #[inline(always)]
    pub fn ray(&self, (x, y): (u32, u32), (i, j): (u32, u32), grid: u32) -> Ray {
        self.through(centre(x, i, self.width, grid), -centre(y, j, self.height, grid))
    }

    /// The ray through a point of pixel (`x`, `y`), 0 … 1 from its left and from its top.
    pub fn ray_within(&self, (x, y): (u32, u32), (right, down): (f64, f64)) -> Ray {
        let place = |pixel: u32, within: f64, pixels: u32| {
            (f64::from(pixel) + within) / f64::from(pixels) - 0.5
        };
        self.through(place(x, right, self.width), -place(y, down, self.height))
    }

    /// The ray through the point (`u`, `v`) of the screen.
    #[inline(always)]
    fn through(&self, u: f64, v: f64) -> Ray {
        let along = |[right, up]: [Vector; 2]| right * u + up * v;
        Ray {
            origin: self.origin + along(self.shift),
            direction: unit(self.direction + along(self.turn)),
        }
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mirrored_samples_have_exactly_mirrored_coordinates() {
        for (pixels, grid) in [(1, 1), (3, 1), (640, 3), (1919, 7)] {
            for pixel in 0..pixels {
                for sample in 0..grid {
                    let here = centre(pixel, sample, pixels, grid);
                    let there = centre(pixels - 1 - pixel, grid - 1 - sample, pixels, grid);
                    assert_eq!(here, -there);
                }
            }
        }
    }

    #[test]
    fn a_single_sample_is_the_pixels_centre_and_the_top_row_is_up() {
        let camera = Camera::default();
        let lens = Lens::new(&camera, 4, 2);
        let ray = lens.ray((3, 0), (0, 0), 1);
        let expected = Vector::new(4.0 / 3.0 * 0.375, 0.25, -1.0).normalize();
        assert!((ray.direction - expected).length() < 1e-15, "{ray:?}");
    }

    #[test]
    fn the_middle_of_a_pixel_is_its_single_sample() {
        let camera = Camera::default();
        let lens = Lens::new(&camera, 4, 2);
        let (middle, sample) = (lens.ray_within((3, 0), (0.5, 0.5)), lens.ray((3, 0), (0, 0), 1));
        assert_eq!(middle, sample);
    }

    #[test]
    fn an_orthographic_camera_moves_the_origin_only() {
        let camera = Camera { kind: CameraKind::Orthographic, ..Camera::default() };
        let lens = Lens::new(&camera, 2, 2);
        let ray = lens.ray((0, 1), (0, 0), 1);
        assert_eq!(ray.direction, -Vector::Z);
        assert_eq!(ray.origin, Vector::new(-1.0 / 3.0, -0.25, 0.0));
    }
}
