//! `cylindrical`, `spherical`, `toroidal` and `planar`: the plane of x and y wrapped around a body, or laid
//! along a plane.
//!
//! The first three map an angle to x, 0 … 1 for a full turn, counted about the y axis from +x towards +z.
//! What becomes y depends on the body; z is the distance from its axis, centre or circle. The angles are
//! multiplied by that distance to the power of `dist_exp`. The result is then brought into the direction of
//! `orientation`.
//!
//! **Source:** POV-Ray manual, section "Mapping using warps"; formulas measured on POV-Ray 3.7.

use std::f64::consts::{PI, TAU};

use super::Warping;
use crate::math::{UnitVector, Vector, elementary};
use crate::pattern::parameter::parameters;

parameters! {
    /// The angle about the y axis; the height; the distance from the axis. Points on the axis stay as they
    /// are.
    pub struct Cylindrical {
        "orientation" orientation: Vector = Vector::Z, "the orientation of the warp";
        "dist_exp" exponent: f64 = 0.0, "the exponent of the distance";
    }
}

parameters! {
    /// The angle about the y axis; the angle from the south pole, 1 at the north pole; the distance from the
    /// origin. The origin stays as it is.
    pub struct Spherical {
        "orientation" orientation: Vector = Vector::Z, "the orientation of the warp";
        "dist_exp" exponent: f64 = 0.0, "the exponent of the distance";
    }
}

parameters! {
    /// The angle about the y axis; the angle around the circle of `radius`, 0 on its inner side, ¼ below, ½
    /// outside and ¾ above; the distance from the circle. Points on the axis stay as they are.
    pub struct Toroidal {
        "orientation" orientation: Vector = Vector::Z, "the orientation of the warp";
        "dist_exp" exponent: f64 = 0.0, "the exponent of the distance";
        "major_radius" radius: f64 = 1.0, "the radius of the circle";
    }
}

parameters! {
    /// x and y stay as they are, z becomes `distance`; then all is brought into the direction of `normal`.
    pub struct Planar {
        after normal: Vector = Vector::Z, "the normal of the plane";
        after distance: f64 = 0.0, "the distance of the plane";
    }
}

impl Warping for Cylindrical {
    fn canonical(self) -> Self {
        Self { orientation: direction(self.orientation), ..self }
    }

    fn moved(&self, point: Vector, error: Vector) -> (Vector, Vector) {
        let radius = elementary::hypot(point.x, point.z);
        if radius == 0.0 {
            return (point, error);
        }
        let apart = error.x.max(error.z) * 2.0;
        let (turn, turn_error) = turn(point, error, apart / radius);
        let (scale, scale_error) = scale(radius, self.exponent, apart);
        let moved = Vector::new(turn * scale, point.y, radius);
        let x_error = turn_error * scale + turn * scale_error;
        oriented(self.orientation, moved, Vector::new(x_error, error.y, apart))
    }
}

impl Warping for Spherical {
    fn canonical(self) -> Self {
        Self { orientation: direction(self.orientation), ..self }
    }

    fn moved(&self, point: Vector, error: Vector) -> (Vector, Vector) {
        let across = elementary::hypot(point.x, point.z);
        let radius = elementary::hypot(across, point.y);
        if radius == 0.0 {
            return (point, error);
        }
        let apart = error.max_element() * 2.0;
        let (turn, turn_error) = turn(point, error, apart / across);
        let (scale, scale_error) = scale(radius, self.exponent, apart);
        let height = 0.5 + elementary::atan2(point.y, across) / PI;
        let moved = Vector::new(turn * scale, height * scale, radius);
        let x_error = turn_error * scale + turn * scale_error;
        let y_error = apart / radius * scale + height * scale_error;
        oriented(self.orientation, moved, Vector::new(x_error, y_error, apart))
    }
}

impl Warping for Toroidal {
    fn canonical(self) -> Self {
        Self { orientation: direction(self.orientation), ..self }
    }

    fn moved(&self, point: Vector, error: Vector) -> (Vector, Vector) {
        let across = elementary::hypot(point.x, point.z);
        if across == 0.0 {
            return (point, error);
        }
        let outward = across - self.radius;
        let radius = elementary::hypot(outward, point.y);
        let apart = error.max_element() * 2.0;
        let (turn, turn_error) = turn(point, error, apart / across);
        let (scale, scale_error) = scale(radius, self.exponent, apart);
        // At the seam on the inner side a period starts.
        let is_above = point.y > if outward < 0.0 { error.y } else { 0.0 };
        let around = match is_above {
            true => elementary::atan2(point.y, outward),
            false => -elementary::atan2(point.y.min(0.0).abs(), outward),
        };
        let height = 0.5 + around / TAU;
        let moved = Vector::new(turn * scale, height * scale, radius);
        let x_error = turn_error * scale + turn * scale_error;
        let y_error = apart / radius * scale + height * scale_error;
        oriented(self.orientation, moved, Vector::new(x_error, y_error, apart))
    }
}

impl Warping for Planar {
    fn canonical(self) -> Self {
        Self { normal: direction(self.normal), ..self }
    }

    fn moved(&self, point: Vector, error: Vector) -> (Vector, Vector) {
        let moved = Vector { z: self.distance, ..point };
        oriented(self.normal, moved, Vector { z: 0.0, ..error })
    }
}

/// Returns the unit vector of an orientation; z if it has none, where POV-Ray 3.7 gives no numbers.
fn direction(v: Vector) -> Vector {
    UnitVector::from_direction(v).map_or(Vector::Z, UnitVector::get)
}

/// Returns the angle about the y axis in turns, 0 … 1, with its error. A point whose error cannot separate
/// it from the seam in the half-plane towards +x is on the seam, at 0.
fn turn(point: Vector, error: Vector, angle_error: f64) -> (f64, f64) {
    let z = if point.x > 0.0 && point.z.abs() <= error.z { 0.0 } else { point.z };
    let turn = elementary::atan2(z, point.x) / TAU;
    (if turn < 0.0 { turn + 1.0 } else { turn }, angle_error.min(1.0))
}

/// Returns the factor of the angles, with its error.
fn scale(distance: f64, exponent: f64, error: f64) -> (f64, f64) {
    if exponent == 0.0 {
        return (1.0, 0.0);
    }
    let scale = elementary::pow(distance, exponent).min(f64::MAX);
    (scale, scale * exponent.abs() * error / distance)
}

/// Brings a point into the direction of a unit vector: a rotation only for some of them, but what POV-Ray 3.7
/// does for all.
fn oriented(Vector { x: a, y: b, z: c }: Vector, p: Vector, error: Vector) -> (Vector, Vector) {
    let along = |a: f64, b: f64, c: f64, signed: bool, p: Vector| {
        let sign = if signed { -1.0 } else { 1.0 };
        let x = p.x * (b + c) + p.z * a;
        let y = p.y * (a + c) + sign * p.z * b;
        Vector::new(x, y, sign * p.x * a + p.y * b + p.z * c)
    };
    let moved = along(a, b, c, true, p);
    (moved, along(a.abs(), b.abs(), c.abs(), false, error))
}
