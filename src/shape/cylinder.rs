//! Cylinder: in local space, x² + y² ≤ 1, |z| ≤ 1. Outward is away from the axis; at the ends, along it.

use super::U;
use super::local::{Crossings, Height, Local, LocalRay, Met};
use super::slab::Slab;
use crate::math::Vector;

/// Part number of the side.
pub(super) const SIDE: u32 = 0;
/// Part number of the end at z = 1.
pub(super) const CAP: u32 = 1;
/// Part number of the end at z = −1.
pub(super) const BASE: u32 = 2;

/// x² + y² ≤ 1, |z| ≤ 1, in local space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cylinder {
    /// Whether its ends are invisible; it is still solid.
    pub open: bool,
}

impl Local for Cylinder {
    /// Adds the part of the line inside the infinite cylinder, which projects to the chord of a circle,
    /// clipped to the two ends.
    ///
    /// Across the axis, with q the nearest point and e the direction, m = |q × e| / |e| is the distance to
    /// the axis, and the chord extends h = √((1 − m)(1 + m)) to each side. **Error** of s, B the line's blur
    /// there: the error of h, which is δ·m/h or √(2δ·m + δ²) for δ = B + 4u·(|q| + |e·s|), plus δ, over |e|.
    fn crossings(&self, ray: &LocalRay, found: &mut Crossings) {
        let Some((enter, leave)) = round(ray) else { return };
        let Some((first, last)) = ends(ray) else { return };
        let (enter, leave) = (enter.later(first), leave.earlier(last));
        if enter.t < leave.t {
            let seen = |met: Met| match met.part {
                CAP | BASE if self.open => Met { part: Met::UNSEEN, ..met },
                _ => met,
            };
            found.extend([seen(enter), seen(leave)]);
        }
    }

    fn height(&self, part: u32, point: Vector) -> Height {
        match part {
            CAP => Height { value: point.z - 1.0, gradient: Vector::Z, error: U },
            BASE => Height { value: -point.z - 1.0, gradient: -Vector::Z, error: U },
            _ => {
                let across = Vector::new(point.x, point.y, 0.0);
                let distance = across.length();
                Height { value: distance - 1.0, gradient: across / distance, error: 4.0 * U }
            }
        }
    }

    fn extent(&self, along: Vector) -> (f64, f64) {
        let half = Vector::new(along.x, along.y, 0.0).length() + along.z.abs();
        (-half, half)
    }

    fn price(&self) -> u64 {
        8
    }

    fn reach(&self) -> f64 {
        std::f64::consts::SQRT_2
    }

    fn numbers(&self) -> String {
        if self.open { " open".into() } else { String::new() }
    }

    fn contains(&self, point: Vector) -> bool {
        point.x * point.x + point.y * point.y < 1.0 && point.z.abs() < 1.0
    }
}

/// Returns where the line is nearer to the axis than 1.
fn round(ray: &LocalRay) -> Option<(Met, Met)> {
    let across = |v: Vector| Vector::new(v.x, v.y, 0.0);
    let (nearest, direction) = (across(ray.nearest), across(ray.direction));
    let slope = direction.length();
    // Along the axis the side is met far beyond the body, which ends at √2, if at all; for all that is known
    // of so small a slope, it might be met anywhere else beyond.
    let distance = nearest.length();
    let drift = 2.0 * slope + ray.blur_at(2.0) + 4.0 * U;
    if distance + drift < 1.0 || slope == 0.0 {
        let met = |t, leaving| Met { t, error: 0.0, leaving, part: SIDE };
        return (distance < 1.0)
            .then_some((met(f64::NEG_INFINITY, false), met(f64::INFINITY, true)));
    }
    let direction = direction / slope;
    let along = nearest.dot(direction);
    let miss = (nearest.x * direction.y - nearest.y * direction.x).abs();
    let half = ((1.0 - miss) * (1.0 + miss)).sqrt();
    // Also so when `half` is no number: `miss` a little over 1.
    if !half.gt(&0.0) {
        return None;
    }
    let met = |way: f64, leaving| {
        let t = way / slope;
        let off = ray.blur_at(t) + 4.0 * U * (nearest.length() + way.abs());
        let half_error = (off * miss / half).min((2.0 * off * miss + off * off).sqrt());
        Met { t, error: (half_error + off + 4.0 * U * half) / slope, leaving, part: SIDE }
    };
    Some((met(-along - half, false), met(half - along, true)))
}

/// Returns where the line is between the ends.
pub(super) fn ends(ray: &LocalRay) -> Option<(Met, Met)> {
    between(ray, [-1.0, 1.0])
}

/// Returns where the line is between two exact heights, for a body that extends to at most √2.
pub(super) fn between(ray: &LocalRay, heights: [f64; 2]) -> Option<(Met, Met)> {
    Slab { axis: 2, heights, far: 2.0, off: 0.0, parts: [BASE, CAP] }.chord(ray)
}
