//! Closest-point projection onto a patch, with the normal at that point.

use super::net::Place;
use super::{BicubicPatch, STEPS, U};
use crate::math::Vector;
use crate::math::wide::*;

impl BicubicPatch {
    /// Returns the point on the surface nearest to `point`, which is near the given part, and the normal
    /// there, of any length.
    pub(super) fn foot(&self, point: Vector, part: u32) -> (Vector, Vector) {
        dispatch!(Instructions::best().level(), simd => {
            let place = self.nearest(simd, part, point);
            (self.net.place(simd, place).point, self.normal_in(simd, place))
        })
    }

    /// Returns the parameters there: from the first point of a row to its fourth, and from row to row.
    pub fn uv(&self, part: u32, point: Vector) -> [f64; 2] {
        dispatch!(Instructions::best().level(), simd => self.nearest(simd, part, point))
    }

    #[inline(always)]
    fn nearest<S: Simd>(&self, simd: S, part: u32, point: Vector) -> [f64; 2] {
        let (mut u, mut v) = (f64::from(part >> 15) / STEPS, f64::from(part & 0x7fff) / STEPS);
        for _ in 0..6 {
            let Place { point: here, along_u, along_v } = self.net.place(simd, [u, v]);
            let rest = point - here;
            let (uu, uv, vv) = (along_u.dot(along_u), along_u.dot(along_v), along_v.dot(along_v));
            let (ru, rv) = (rest.dot(along_u), rest.dot(along_v));
            let determinant = uu * vv - uv * uv;
            let step = ((ru * vv - rv * uv) / determinant, (rv * uu - ru * uv) / determinant);
            if !(step.0.is_finite() && step.1.is_finite()) {
                break;
            }
            (u, v) = ((u + step.0).clamp(0.0, 1.0), (v + step.1).clamp(0.0, 1.0));
            if step.0.abs().max(step.1.abs()) <= U {
                break;
            }
        }
        [u, v]
    }

    /// Returns the normal at (u, v). At a tip, and wherever else the derivatives along u and v are parallel,
    /// returns that of a nearby point.
    pub(super) fn normal(&self, u: f64, v: f64) -> Vector {
        dispatch!(Instructions::best().level(), simd => self.normal_in(simd, [u, v]))
    }

    #[inline(always)]
    fn normal_in<S: Simd>(&self, simd: S, [u, v]: [f64; 2]) -> Vector {
        let mut inward = 0.0;
        for _ in 0..4 {
            let near = |t: f64| t + (0.5 - t) * inward;
            let Place { along_u, along_v, .. } = self.net.place(simd, [near(u), near(v)]);
            let normal = along_v.cross(along_u);
            if normal.length() > 1e-8 * self.reach * (along_u.length() + along_v.length()) {
                return normal;
            }
            inward = if inward == 0.0 { 1e-6 } else { inward * 100.0 };
        }
        Vector::Z
    }
}
