//! Samples pixels in rounds: each gets more samples as long as those that it has do not suffice.
//!
//! **In:** pixels. **Out:** the sums of their samples. **Invariant:** a sample depends on its pixel and its number, and how
//! many a pixel gets on its own samples.

use std::ops::Range;

use super::Walk;
use super::camera::{Focus, Shift};
use super::pixels::Screen;
use super::sampler::Sampler;
use super::sight::Sight;
use crate::color::Gamma;
use crate::film::Pixel;
use crate::plan::Antialias;

/// Samples that are taken together: few enough for the caches.
const TOGETHER: usize = 1024;

/// The samples of a pixel so far.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sums {
    pub count: u32,
    pub seen: Sight,
    /// Number of samples in the sums below; excludes those passed to [`Self::after`].
    added: u32,
    /// Of each component as a display shows it, 0 to 1, and the opacity, and of its square.
    shown: [f64; 4],
    squares: [f64; 4],
}

impl Sums {
    /// No samples.
    pub const NONE: Self = Self::after(0, Sight::NOTHING);

    /// Returns sums of samples whose sum alone is known.
    pub const fn after(count: u32, seen: Sight) -> Self {
        Self { count, seen, added: 0, shown: [0.0; 4], squares: [0.0; 4] }
    }

    pub fn add(&mut self, seen: Sight) {
        self.count += 1;
        self.added += 1;
        self.seen += seen;
        let [red, green, blue] = seen.radiance.components();
        for (i, c) in [red, green, blue, seen.opacity].into_iter().enumerate() {
            let c = c.clamp(0.0, 1.0);
            self.shown[i] += c;
            self.squares[i] += c * c;
        }
    }

    /// Returns the largest variance of a component.
    pub fn variance(&self) -> f64 {
        let n = f64::from(self.added);
        let of = |i: usize| (self.squares[i] - self.shown[i] * self.shown[i] / n) / (n - 1.0);
        (0..4).map(of).fold(0.0, f64::max)
    }

    /// Returns the variance of the added samples in linear light, summed over the components and the opacity, which is
    /// constant unless the picture has an alpha channel.
    pub fn linear_variance(&self, gamma: Gamma) -> f64 {
        let n = f64::from(self.added.max(1));
        let of = |i: usize| {
            let mean = self.shown[i] / n;
            let off = (self.squares[i] / n - mean * mean).max(0.0).sqrt();
            let (low, high) = ((mean - off).max(0.0), (mean + off).min(1.0));
            // The curve is taken as straight between them; opacity has none.
            let light = match i {
                3 => high - low,
                _ => gamma.linear(high) - gamma.linear(low),
            };
            let off = if low < high { off * light / (high - low) } else { 0.0 };
            off * off
        };
        (0..4).map(of).sum()
    }

    pub fn mean(&self) -> Sight {
        self.seen.mean(f64::from(self.count))
    }

    pub fn pixel(&self) -> Pixel {
        self.mean().pixel(self.count)
    }
}

/// Where the samples of a pixel lie.
enum Sequence<'a> {
    /// On a regular grid, this many in a row.
    Grid(u32),
    Sharp(Sampler),
    Blurred(&'a Focus, Shift),
}

impl Screen<'_> {
    /// Samples pixels side by side, until `wanted` returns no more samples than a pixel has. Calls `done` with the number
    /// of each finished pixel, but not for those that the watch stops.
    pub fn in_rounds(
        &self,
        walk: &mut Walk,
        places: &[(u32, u32)],
        mut pixels: Vec<Sums>,
        wanted: impl Fn(usize, &Sums) -> u32,
        mut done: impl FnMut(usize, &Sums),
    ) {
        let sequence = |&place: &(u32, u32)| match (self.lens.focus(), self.plan.antialias) {
            (Some(focus), _) => Sequence::Blurred(focus, Shift::of(place)),
            (None, Antialias::Grid(grid)) => Sequence::Grid(grid),
            (None, _) => Sequence::Sharp(Sampler::of(place)),
        };
        let sequences: Vec<Sequence> = places.iter().map(sequence).collect();
        let point = |&(i, number): &(usize, u32)| match &sequences[i] {
            &Sequence::Grid(grid) => {
                self.lens.point(places[i], (number % grid, number / grid), grid)
            }
            Sequence::Sharp(sampler) => self.lens.at(places[i], sampler.offset(number)),
            Sequence::Blurred(focus, shift) => self.lens.blurred(focus, places[i], shift, number),
        };
        let mut open: Vec<(usize, Range<u32>)> = (0..pixels.len()).map(|i| (i, 0..0)).collect();
        let mut together = Vec::with_capacity(TOGETHER);
        loop {
            open.retain_mut(|(i, numbers)| {
                *numbers = pixels[*i].count..wanted(*i, &pixels[*i]);
                let is_open = numbers.start < numbers.end;
                if !is_open {
                    done(*i, &pixels[*i]);
                }
                is_open
            });
            if open.is_empty() {
                return;
            }
            let mut samples = open
                .iter()
                .flat_map(|(i, numbers)| numbers.clone().map(move |number| (*i, number)));
            loop {
                together.clear();
                together.extend(samples.by_ref().take(TOGETHER));
                if together.is_empty() {
                    break;
                }
                let mut taken = together.iter();
                self.tracer.each_sample(walk, &self.lens, together.iter().map(point), |seen| {
                    taken.next().into_iter().for_each(|&(i, _)| pixels[i].add(seen));
                });
                // By the watch.
                if taken.next().is_some() {
                    return;
                }
            }
        }
    }
}
