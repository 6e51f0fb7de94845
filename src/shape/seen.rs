//! Rays in the local space of a placed body.
//!
//! **Invariant:** rays side by side have the bits of each alone.

use super::body::Body;
use super::local::{InWorld, Local, LocalRay, Met};
use super::mesh::missed::WideLines;
use super::wide::points::times;
use super::{Placed, Ray, U};
use crate::math::placement::Placement;
use crate::math::wide::*;

/// A ray in the local space of a placed body.
#[derive(Debug, Clone, Copy)]
pub(super) struct Seen<'a> {
    pub line: LocalRay<'a>,
    /// Distance of the line from the local origin.
    pub miss: f64,
    /// Position of the ray's start on the line.
    start: f64,
    /// Ratio of local lengths to those along the ray.
    speed: f64,
    /// Error bound of `start`.
    start_error: f64,
}

impl<'a> Seen<'a> {
    /// Transforms the ray to local space and moves its origin to the closest approach there.
    ///
    /// With |L| the matrix of absolute values, f the ray's start relative to the centre, R = ‖|L|·|f|‖ and κ
    /// = ‖|L|·|D|‖ / |L·D|, the line is off by u·(6R + 6κ·|b|) at its closest approach and by 6u·κ more per
    /// unit of length along it; the start is off by u·(6R + 6κ·(|b| + m)), and every t by 6u·κ·|t|, as for an
    /// ellipsoid. Both bounds grow by `moved`, the distance in local space between the centre and its
    /// intended position.
    pub fn new(placed: &'a Placed, ray: &'a Ray, moved: f64) -> Self {
        let Placed { placement, root_tolerance: tolerance, .. } = *placed;
        let matrix = placement.local_from_world;
        let sizes = matrix.abs();
        let from_centre = ray.origin - placement.centre;
        let origin = matrix * from_centre;
        let step = matrix * ray.direction;
        let speed = step.length();
        let direction = step / speed;
        let start = origin.dot(direction);
        let nearest = origin - direction * start;

        let reach = (sizes * from_centre.abs()).length();
        let turn = U * 6.0 * (sizes * ray.direction.abs()).length() / speed;
        let blur = U * 6.0 * reach + turn * start.abs() + moved;
        let miss = nearest.length();
        let start_error = blur + turn * miss;
        let in_world = Some(InWorld { ray, placed });
        let line = LocalRay { nearest, direction, blur, turn, tolerance, in_world };
        Self { line, miss, start, speed, start_error }
    }

    /// Returns the position on the line of the ray's point at `t`; moved by its error bound backward if `way`
    /// is −1 and forward if it is 1.
    pub fn place(&self, t: f64, way: f64) -> f64 {
        let along = t * self.speed;
        let off = self.start_error
            + along.abs() * (self.line.turn + 8.0 * U)
            + 8.0 * U * self.start.abs();
        self.start + along + way * off
    }

    /// Converts a crossing of the line to one of the ray.
    pub fn met(&self, local: Met) -> Met {
        ray_crossing(local, self.start, self.speed, self.start_error, self.line.turn)
    }
}

#[inline(always)]
fn ray_crossing(local: Met, start: f64, speed: f64, start_error: f64, turn: f64) -> Met {
    let t = (local.t - start) / speed;
    let rounded = 2.0 * U * (local.t.abs() + start.abs());
    let error = (local.error + start_error + rounded) / speed + t.abs() * (turn + 4.0 * U);
    Met { t, error, ..local }
}

/// [`Seen`] for rays side by side.
pub(crate) struct SeenRow {
    nearest: Rows,
    directions: Rows,
    blurs: Row,
    turns: Row,
    starts: Row,
    speeds: Row,
    start_errors: Row,
    /// From where on each line is searched.
    from: Row,
    /// Up to where each line is searched.
    to: Row,
    /// A bit for each ray that is here.
    here: u32,
    /// A bit for each ray whose line may meet the body.
    pub reaching: u32,
}

impl SeenRow {
    pub const NONE: Self = {
        let none = [0.0; ROW];
        Self {
            nearest: Rows::ZERO,
            directions: Rows::ZERO,
            blurs: none,
            turns: none,
            starts: none,
            speeds: none,
            start_errors: none,
            from: none,
            to: none,
            here: 0,
            reaching: 0,
        }
    };

    /// Transforms the rays of `mask` as [`Seen::new`] does; each is searched from its start up to its limit.
    #[inline(always)]
    pub fn see<S: Simd>(
        &mut self,
        simd: S,
        placed: &Placed,
        rays: &Rays,
        mask: u32,
        limits: &Row,
        moved: f64,
    ) {
        let reach = placed.body.reach();
        self.here = mask;
        let body = (placed, reach, moved);
        for group in 0..GROUPS {
            if has(mask, group) {
                self.fill(simd, body, group, &rays.four(simd, group), limits);
            }
        }
        self.reaching &= mask;
    }

    #[inline(always)]
    fn fill<S: Simd>(
        &mut self,
        simd: S,
        (placed, reach, moved): (&Placed, f64, f64),
        group: usize,
        ray: &WideRay<S>,
        limits: &Row,
    ) {
        let Placement { centre, local_from_world: matrix, .. } = placed.placement;
        let sizes = matrix.abs();
        let from_centre = ray.origin - WideVector::splat(simd, centre);
        let origin = times(simd, &matrix, from_centre);
        let step = times(simd, &matrix, ray.direction);
        let speed = step.length_squared().sqrt();
        let direction = step / speed;
        let start = origin.dot(direction);
        let nearest = origin - direction * start;

        let size = times(simd, &sizes, from_centre.abs()).length_squared().sqrt();
        let slant = times(simd, &sizes, ray.direction.abs()).length_squared().sqrt();
        let turn = all(simd, U * 6.0) * slant / speed;
        let blur = all(simd, U * 6.0) * size + turn * start.abs() + all(simd, moved);
        let miss = nearest.length_squared().sqrt();
        let start_error = blur + turn * miss;
        let is_beyond = miss.simd_gt(all(simd, reach * (1.0 + 8.0 * U)) + blur);

        // `Seen::place` of the start, moved backward, and of the limit, moved forward.
        let rounded = all(simd, 8.0 * U) * start.abs();
        let along = four(simd, limits, group) * speed;
        let off = start_error + along.abs() * (turn + all(simd, 8.0 * U)) + rounded;
        store(start - (start_error + rounded), &mut self.from, group);
        store(start + along + off, &mut self.to, group);

        nearest.store(&mut self.nearest, group);
        direction.store(&mut self.directions, group);
        store(blur, &mut self.blurs, group);
        store(turn, &mut self.turns, group);
        store(start, &mut self.starts, group);
        store(speed, &mut self.speeds, group);
        store(start_error, &mut self.start_errors, group);
        let mut reaching = !is_beyond;
        if let Body::Mesh(mesh) = &*placed.body {
            let lines = WideLines { nearest, direction, blur, turn, miss };
            reaching &= mesh.may_be_pierced(simd, placed, &lines, ray.origin);
        }
        self.reaching |= bits(reaching, group);
    }

    /// Returns whether the ray of a number is one of them.
    #[inline(always)]
    pub fn holds(&self, number: usize) -> bool {
        self.here >> number & 1 == 1
    }

    /// Returns the line of a ray.
    #[inline(always)]
    pub fn line<'a>(&self, number: usize, placed: &'a Placed, ray: &'a Ray) -> LocalRay<'a> {
        LocalRay {
            nearest: self.nearest.at(number),
            direction: self.directions.at(number),
            blur: self.blurs[number],
            turn: self.turns[number],
            tolerance: placed.root_tolerance,
            in_world: Some(InWorld { ray, placed }),
        }
    }

    /// Returns from where to where a line is searched.
    #[inline(always)]
    pub fn between(&self, number: usize) -> (f64, f64) {
        (self.from[number], self.to[number])
    }

    /// [`Seen::met`] for the ray of a number.
    #[inline(always)]
    pub fn met(&self, number: usize, local: Met) -> Met {
        let (start, start_error) = (self.starts[number], self.start_errors[number]);
        ray_crossing(local, start, self.speeds[number], start_error, self.turns[number])
    }
}
