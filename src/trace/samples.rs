//! Light at points of the screen.
//!
//! **In:** points of the screen, in order. **Out:** what is seen through each, in that order: black where the camera
//! has no ray.

use super::Walk;
use super::camera::{Lens, Point};
use super::sight::Sight;
use super::tracer::Tracer;
use crate::geometry::Hit;
use crate::math::wide::{ROW, Rays, Row};
use crate::shape::Ray;

impl Tracer<'_> {
    /// Shows `look` what is seen at each point of the screen, in their order; stops early where the watch wants no
    /// more.
    pub fn each_sample(
        &self,
        walk: &mut Walk,
        lens: &Lens,
        points: impl Iterator<Item = Point>,
        mut look: impl FnMut(Sight),
    ) {
        let instructions = self.geometry.instructions();
        match lens.flat() {
            Some((flat, None)) => {
                let (mut places, mut points) = ([[0.0; ROW]; 2], points);
                let fill = |rays: &mut Rays| {
                    fill(&mut places, rays, || points.next().map(|Point { u, v, .. }| [u, v]));
                    flat.find(instructions, &places, rays);
                };
                self.each_seen(walk, fill, look);
            }
            Some((flat, Some(focus))) => {
                let (mut places, mut points, mut sent) = ([[0.0; ROW]; 4], points, 0);
                let fill = |rays: &mut Rays| {
                    let place = |Point { u, v, lens: [x, y] }| [u, v, x, y];
                    fill(&mut places, rays, || points.next().map(place));
                    flat.find_blurred(instructions, focus, &places, rays);
                    sent += u64::from(rays.mask.count_ones());
                };
                self.each_seen(walk, fill, look);
                walk.counters.evaluations.focal_blur += if self.counts { sent } else { 0 };
            }
            None => {
                let points: Vec<Point> = points.collect();
                let rays = lens.rays(&points);
                if self.counts {
                    let sent = rays.iter().flatten().count() as u64;
                    let evaluations = &mut walk.counters.evaluations;
                    evaluations.focal_blur += if lens.focus().is_some() { sent } else { 0 };
                    evaluations.camera_normal += if lens.has_normal() { sent } else { 0 };
                }
                let of_a_point = lens.rays_of_a_point();
                if of_a_point != 1 {
                    return self.each_mean(walk, rays, of_a_point, look);
                }
                let mut next = 0;
                self.each_of(walk, &rays, |seen| {
                    while rays[next].is_none() {
                        look(Sight::NOTHING);
                        next += 1;
                    }
                    look(seen);
                    next += 1;
                });
                rays[next..]
                    .iter()
                    .take_while(|ray| ray.is_none())
                    .for_each(|_| look(Sight::NOTHING));
            }
        }
    }

    /// Shows `look` what is seen along each of the rays that there are.
    fn each_of(&self, walk: &mut Walk, rays: &[Option<Ray>], look: impl FnMut(Sight)) {
        let sent: Vec<Ray> = rays.iter().flatten().copied().collect();
        let mut rows = sent.chunks(ROW);
        let fill = |rays: &mut Rays| *rays = Rays::new(rows.next().unwrap_or(&[]).iter());
        self.each_seen(walk, fill, look);
    }

    /// Forgets what is beyond the reach of the camera's own rays: behind it is the sky.
    #[cold]
    pub(super) fn see_near(&self, hits: &mut [Hit]) {
        let reach = self.world.camera.meshes.as_ref().map_or(f64::INFINITY, |one| one.reach);
        hits.iter_mut().filter(|hit| hit.t > reach).for_each(|hit| *hit = Hit::NOTHING);
    }

    /// Shows `look` the mean of what is seen along each `of_a_point` rays; black where all of them are missing.
    fn each_mean(
        &self,
        walk: &mut Walk,
        rays: Vec<Option<Ray>>,
        of_a_point: usize,
        look: impl FnMut(Sight),
    ) {
        let mut seen = Vec::with_capacity(rays.len());
        self.each_of(walk, &rays, |one| seen.push(one));
        let mut seen = seen.into_iter();
        let means = rays.chunks(of_a_point.max(1)).map_while(|of_point| {
            let count = of_point.iter().flatten().count();
            let there = seen.by_ref().take(count).collect::<Vec<_>>();
            // Otherwise the watch wanted no more.
            (there.len() == count).then(|| {
                let sum = there.into_iter().fold(Sight::NOTHING, |sum, one| sum + one);
                let part = 1.0 / f64::from(count.max(1) as u32);
                Sight { radiance: sum.radiance * part, opacity: sum.opacity * part }
            })
        });
        means.for_each(look);
    }
}

/// Puts the next places into rows, and a bit for each into the mask of rays.
#[inline(always)]
fn fill<const N: usize>(
    rows: &mut [Row; N],
    rays: &mut Rays,
    mut next: impl FnMut() -> Option<[f64; N]>,
) {
    rays.mask = 0;
    for number in 0..ROW {
        let Some(place) = next() else { break };
        rows.iter_mut().zip(place).for_each(|(row, place)| row[number] = place);
        rays.mask |= 1 << number;
    }
}
