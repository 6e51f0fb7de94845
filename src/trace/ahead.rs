//! The camera's rays whose first surfaces are found ahead, several together.

use super::Walk;
use super::path::Tracer;
use crate::geometry::{Hit, TOGETHER};
use crate::shape::Ray;

/// Rays in the order in which they are asked for, and what they meet.
#[derive(Debug, Default)]
pub(super) struct Ahead {
    rays: Vec<Ray>,
    hits: Vec<Hit>,
    /// The first that was not asked for yet.
    next: usize,
}

impl Ahead {
    pub fn clear(&mut self) {
        self.rays.clear();
        self.hits.clear();
        self.next = 0;
    }

    /// The next ray and the first surface that it meets.
    #[inline(always)]
    pub fn next(&mut self) -> Option<(Ray, Hit)> {
        let next = (*self.rays.get(self.next)?, *self.hits.get(self.next)?);
        self.next += 1;
        Some(next)
    }
}

impl Tracer<'_> {
    /// Finds what the first rays of an iterator meet, up to [`TOGETHER`].
    pub fn look_ahead<const KINDS: bool>(&self, walk: &mut Walk, rays: impl Iterator<Item = Ray>) {
        let Walk { ahead, counters, .. } = walk;
        ahead.clear();
        ahead.rays.extend(rays.take(TOGETHER));
        let Ahead { rays, hits, .. } = ahead;
        self.in_image.nearest_together::<KINDS>(rays, hits, &mut counters.work);
    }
}
