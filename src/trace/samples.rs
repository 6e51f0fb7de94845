//! Light at points of the screen.
//!
//! **In:** points of the screen, in order. **Out:** what is seen through each, in that order: black where the camera
//! has no ray.

use super::Walk;
use super::camera::{Lens, Point};
use super::tracer::Tracer;
use crate::color::Rgb;
use crate::math::wide::{ROW, Rays};
use crate::shape::Ray;

impl Tracer<'_> {
    /// Shows `look` the radiance at each point of the screen, in their order; stops early where the watch wants no
    /// more.
    pub fn each_sample(
        &self,
        walk: &mut Walk,
        lens: &Lens,
        points: impl Iterator<Item = Point>,
        mut look: impl FnMut(Rgb),
    ) {
        match lens.plain() {
            Some(flat) => {
                let (instructions, mut points) = (self.geometry.instructions(), points);
                let mut places = [[0.0; ROW]; 2];
                let fill = |rays: &mut Rays| {
                    rays.mask = 0;
                    let [all_u, all_v] = &mut places;
                    for (number, (at_u, at_v)) in all_u.iter_mut().zip(all_v).enumerate() {
                        let Some(Point { u, v, .. }) = points.next() else { break };
                        (*at_u, *at_v) = (u, v);
                        rays.mask |= 1 << number;
                    }
                    flat.find(instructions, &places, rays);
                };
                self.each_seen(walk, fill, look);
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
                let mut next = 0;
                let sent: Vec<Ray> = rays.iter().flatten().copied().collect();
                let mut rows = sent.chunks(ROW);
                let fill = |rays: &mut Rays| *rays = Rays::new(rows.next().unwrap_or(&[]).iter());
                self.each_seen(walk, fill, |seen| {
                    while rays[next].is_none() {
                        look(Rgb::BLACK);
                        next += 1;
                    }
                    look(seen);
                    next += 1;
                });
                rays[next..].iter().take_while(|ray| ray.is_none()).for_each(|_| look(Rgb::BLACK));
            }
        }
    }
}
