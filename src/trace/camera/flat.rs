//! The perspective and the orthographic camera: the screen is a plane.

use super::{Focus, Projection, unit};
use crate::math::Vector;
use crate::math::wide::*;
use crate::shape::Ray;
use crate::world::{Camera, CameraKind};

/// Where the ray of each point (u, v) of the screen begins and where it goes: both are linear in u and v.
pub(in crate::trace) struct Flat {
    origin: Vector,
    /// What the origin moves by along u and along v.
    shift: [Vector; 2],
    direction: Vector,
    /// What the direction turns by along u and along v.
    turn: [Vector; 2],
}

impl Flat {
    pub(super) fn new(camera: &Camera) -> Self {
        let &Camera { location: origin, forward: direction, right, up, .. } = camera;
        let (screen, still) = ([right, up], [Vector::ZERO; 2]);
        let (shift, turn) = match camera.kind {
            CameraKind::Orthographic => (screen, still),
            _ => (still, screen),
        };
        Self { origin, shift, direction, turn }
    }

    /// Finds the rays through points (u, v) of the screen, one for each bit of the rays' mask.
    #[inline(always)]
    pub fn find(&self, instructions: Instructions, [u, v]: &[Row; 2], rays: &mut Rays) {
        let odd = dispatch!(instructions.level(), simd => self.aim(simd, [u, v], rays));
        for number in numbers(odd & rays.mask) {
            rays.directions.set(number, unit(self.line(u[number], v[number]).direction));
        }
    }

    /// Finds rays; returns a bit for each whose direction has too long or too short a square.
    #[inline(always)]
    fn aim<S: Simd>(&self, simd: S, [u, v]: [&Row; 2], rays: &mut Rays) -> u32 {
        let mut odd = 0;
        for group in 0..GROUPS {
            if !has(rays.mask, group) {
                continue;
            }
            let (u, v) = (four(simd, u, group), four(simd, v, group));
            let shift = along(simd, self.shift, u, v);
            let turn = along(simd, self.turn, u, v);
            (WideVector::splat(simd, self.origin) + shift).store(&mut rays.origins, group);
            let direction = WideVector::splat(simd, self.direction) + turn;
            let square = direction.length_squared();
            (direction / square.sqrt()).store(&mut rays.directions, group);
            odd |= bits(!square.is_normal(), group);
        }
        odd
    }

    /// Finds the rays of a lens through points (u, v) of the screen and (x, y) of the lens, one for each bit of the rays'
    /// mask.
    #[inline(always)]
    pub fn find_blurred(
        &self,
        instructions: Instructions,
        focus: &Focus,
        places: &[Row; 4],
        rays: &mut Rays,
    ) {
        let odd = dispatch!(instructions.level(), simd => self.bend(simd, focus, places, rays));
        for number in numbers(odd) {
            let [u, v, x, y] = places.each_ref().map(|row| row[number]);
            let ray = focus.bent(self.line(u, v), [x, y]);
            rays.set(number, &Ray { direction: unit(ray.direction), ..ray });
        }
    }

    /// Finds the rays of a lens, as [`Focus::bent`] does; returns a bit for each whose direction has too long or too
    /// short a square.
    #[inline(always)]
    fn bend<S: Simd>(
        &self,
        simd: S,
        focus: &Focus,
        [u, v, x, y]: &[Row; 4],
        rays: &mut Rays,
    ) -> u32 {
        let mut odd = 0;
        for group in 0..GROUPS {
            if !has(rays.mask, group) {
                continue;
            }
            let (u, v) = (four(simd, u, group), four(simd, v, group));
            let (x, y) = (four(simd, x, group), four(simd, y, group));
            let start = WideVector::splat(simd, self.origin) + along(simd, self.shift, u, v);
            let way = WideVector::splat(simd, self.direction) + along(simd, self.turn, u, v);
            let lens = along(simd, focus.axes(), x, y) * all(simd, focus.radius);
            let way = way / all(simd, focus.depth_of_flat());
            let direction = match focus.distance > focus.radius {
                true => way - lens / all(simd, focus.distance),
                false => way * all(simd, focus.distance) - lens,
            };
            let square = direction.length_squared();
            (start + lens).store(&mut rays.origins, group);
            (direction / square.sqrt()).store(&mut rays.directions, group);
            odd |= bits(!square.is_normal(), group);
        }
        odd & rays.mask
    }

    fn line(&self, u: f64, v: f64) -> Ray {
        let along = |[right, up]: [Vector; 2]| right * u + up * v;
        Ray {
            origin: self.origin + along(self.shift),
            direction: self.direction + along(self.turn),
        }
    }
}

/// Returns how far points (u, v) are from the middle of the screen.
#[inline(always)]
fn along<S: Simd>(simd: S, [right, up]: [Vector; 2], u: Wide<S>, v: Wide<S>) -> WideVector<S> {
    WideVector::splat(simd, right) * u + WideVector::splat(simd, up) * v
}

impl Projection for Flat {
    fn through(&self, u: f64, v: f64) -> Option<Ray> {
        Some(self.line(u, v))
    }
}
