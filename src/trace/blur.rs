//! Pixels that a lens blurs: as many samples as each needs.
//!
//! **In:** pixels. **Out:** the mean of each one's samples. **Invariant:** a sample depends on its pixel and its number,
//! and how many a pixel has on these samples.

use super::camera::{Focus, Lens, Shift};
use super::sight::Sight;
use super::tracer::Tracer;
use super::{Sampled, Walk};

/// Samples that a pixel gets at once after the first.
const ROUND: u32 = 6;

/// Samples that are taken together.
const TOGETHER: usize = 1024;

/// The samples of a pixel so far.
#[derive(Debug, Clone, Copy)]
struct Sums {
    count: u32,
    seen: Sight,
    /// Of each component as a display shows it, 0 to 1, and the opacity, and of its square.
    shown: [f64; 4],
    squares: [f64; 4],
}

impl Sums {
    const NONE: Self = Self { count: 0, seen: Sight::NOTHING, shown: [0.0; 4], squares: [0.0; 4] };

    fn add(&mut self, seen: Sight) {
        self.count += 1;
        self.seen += seen;
        let [red, green, blue] = seen.radiance.components();
        for (i, c) in [red, green, blue, seen.opacity].into_iter().enumerate() {
            let c = c.clamp(0.0, 1.0);
            self.shown[i] += c;
            self.squares[i] += c * c;
        }
    }

    /// Returns the largest variance of a component.
    fn variance(&self) -> f64 {
        let n = f64::from(self.count);
        let of = |i: usize| (self.squares[i] - self.shown[i] * self.shown[i] / n) / (n - 1.0);
        (0..4).map(of).fold(0.0, f64::max)
    }

    fn is_enough(&self, focus: &Focus) -> bool {
        focus.is_enough(self.count, self.variance())
    }

    fn mean(&self) -> Sampled {
        (self.seen.mean(f64::from(self.count)), self.count)
    }
}

impl Tracer<'_> {
    /// Samples pixels side by side; `None` where the watch wanted no more.
    pub fn blurred(
        &self,
        walk: &mut Walk,
        lens: &Lens,
        focus: &Focus,
        places: &[(u32, u32)],
    ) -> Vec<Option<Sampled>> {
        let mut pixels = vec![Sums::NONE; places.len()];
        let mut open: Vec<usize> = (0..places.len()).collect();
        let shifts: Vec<Shift> = places.iter().map(|&place| Shift::of(place)).collect();
        let round = focus.at_once(ROUND);
        let mut samples = 0..focus.at_once(focus.least);
        while !open.is_empty() && !samples.is_empty() {
            // Few enough for the caches.
            let few = (TOGETHER / samples.len()).max(1);
            let is_stopped = open.chunks(few).any(|some| {
                let numbers = || some.iter().flat_map(|&i| samples.clone().map(move |k| (i, k)));
                let shifts = &shifts;
                let points = numbers().map(|(i, k)| lens.blurred(focus, places[i], &shifts[i], k));
                let mut taken = numbers();
                self.each_sample(walk, lens, points, |seen| {
                    if let Some((i, _)) = taken.next() {
                        pixels[i].add(seen);
                    }
                });
                taken.next().is_some()
            });
            // By the watch.
            if is_stopped {
                break;
            }
            open.retain(|&i| !pixels[i].is_enough(focus));
            samples = samples.end..focus.most.min(samples.end.saturating_add(round));
        }
        let mut done = vec![true; places.len()];
        open.iter().for_each(|&i| done[i] = false);
        pixels.iter().zip(done).map(|(sums, done)| done.then(|| sums.mean())).collect()
    }
}
