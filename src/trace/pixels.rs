//! Single pixels of a picture: as its Plan has them, or sampled anew as finely as one likes.
//!
//! **In:** a list of pixels. **Out:** what is [`Seen`] in them. **Invariant:** as for the film, nothing depends
//! on the number of threads; a planned pixel has the bits that [`super::trace`] puts there.

use super::antialias::Edges;
use super::camera::{Lens, Point};
use super::rounds::Sums;
use super::sight::Sight;
use super::tiles::Crew;
use super::tracer::Tracer;
use super::{Counters, TraceOptions, Walk, Watch, grown};
use crate::film::{Film, Pixel};
use crate::geometry::Geometry;
use crate::math::random::Random;
use crate::plan::{Antialias, Frame, Plan, Region};
use crate::world::World;

/// Samples that a blurred pixel gets at once after the first.
const ROUND: u32 = 6;

/// Which samples of a pixel are taken.
#[derive(Debug, Clone, Copy, PartialEq)]
#[allow(missing_docs)]
pub enum Sampling {
    /// As the Plan says. An adaptive Plan looks at the neighbours first; their rays are counted
    /// with theirs, not here.
    Planned,
    /// One sample somewhere in each of `side` × `side` equal parts of the pixel: an unbiased
    /// estimate of the mean over the pixel, independent of that of any other `seed`.
    ///
    /// **Source:** R. Cook, "Stochastic sampling in computer graphics", ACM TOG 5(1), 1986.
    Jittered { side: u32, seed: u64 },
    /// Those of the pixel's own sequence from number `first` to before `end`; those before them have this `sum`. For a
    /// Plan that is not of a grid.
    Numbered { first: u32, end: u32, sum: Sight },
}

/// A pixel, and which of its samples are taken.
pub type Aim = ((u32, u32), Sampling);

/// Returns these pixels, all with the same sampling.
pub fn aims(list: &[(u32, u32)], sampling: Sampling) -> Vec<Aim> {
    list.iter().map(|&place| (place, sampling)).collect()
}

/// What was seen in a pixel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Seen {
    /// Of its samples, in the scene's working space; where it is planned, as the film rounds it.
    pub mean: Sight,
    /// Of all its samples, also those before numbered ones.
    pub sum: Sight,
    /// Of numbered samples, in linear light, as errors are measured: the sum over the components.
    pub variance: f64,
}

/// Traces pixels of the Plan's frame, which must lie in its region; `None` for those that the watch left undone, the last
/// of the list as a rule. `geometry` is that of [`super::geometry`] for this Plan, or one like it.
pub fn pixels(
    world: &World,
    geometry: &Geometry,
    plan: &Plan,
    list: &[Aim],
    options: &TraceOptions,
    watch: &dyn Watch,
) -> (Vec<Option<Seen>>, Counters) {
    let world = &*world.within_julia_iterations(plan.julia_iterations);
    let tracer = Tracer::new(world, geometry, plan, watch);
    let screen = Screen::new(&tracer, plan);
    Crew::new(options, watch).each(list, |walk, aims| screen.seen(walk, aims))
}

/// A picture, and how its pixels are sampled.
pub(super) struct Screen<'a> {
    pub plan: &'a Plan,
    pub tracer: &'a Tracer<'a>,
    pub lens: Lens,
}

impl<'a> Screen<'a> {
    pub fn new(tracer: &'a Tracer<'a>, plan: &'a Plan) -> Self {
        let Frame { width, height, .. } = plan.frame;
        let lens = Lens::new(&tracer.world.camera, width, height).sampled(plan.blur_samples);
        Self { plan, tracer, lens }
    }

    /// Returns the threshold and the grid of adaptive antialiasing; a lens that blurs takes its place.
    pub fn adaptive(&self) -> Option<(f64, u32)> {
        match self.plan.antialias {
            Antialias::Adaptive { threshold, grid } if self.lens.focus().is_none() => {
                Some((threshold, grid))
            }
            _ => None,
        }
    }

    /// Samples pixels side by side: as the lens blurs them, or on the Plan's grid; if that is adaptive, once. Calls `done`
    /// with the number of each, but for those for which the watch wanted no more.
    pub fn sample(
        &self,
        walk: &mut Walk,
        places: &[(u32, u32)],
        mut done: impl FnMut(usize, &Sums),
    ) {
        if let Some(focus) = self.lens.focus() {
            let round = focus.at_once(ROUND);
            let wanted = |_, sums: &Sums| match sums.count {
                0 => focus.at_once(focus.least).max(1),
                count if focus.is_enough(count, sums.variance()) => count,
                count => focus.most.min(count.saturating_add(round)),
            };
            return self.in_rounds(walk, places, vec![Sums::NONE; places.len()], wanted, done);
        }
        let grid = match self.plan.antialias {
            Antialias::Off | Antialias::Adaptive { .. } => 1,
            Antialias::Grid(grid) => grid.max(1),
        };
        if grid > 1 {
            let wanted = |_, _: &Sums| grid * grid;
            return self.in_rounds(walk, places, vec![Sums::NONE; places.len()], wanted, done);
        }
        let points = places.iter().map(|&place| self.lens.point(place, (0, 0), 1));
        let mut i = 0;
        self.tracer.each_sample(walk, &self.lens, points, |seen| {
            done(i, &Sums::after(1, seen));
            i += 1;
        });
    }

    /// Adds samples to pixels that have one, if they are near edges. Calls `done` as [`Self::sample`] does.
    pub fn refine(
        &self,
        walk: &mut Walk,
        edges: &Edges,
        places: &[(u32, u32)],
        pixels: &[Pixel],
        done: impl FnMut(usize, &Sums),
    ) {
        let mut first = vec![Sums::NONE; pixels.len()];
        first.iter_mut().zip(pixels).for_each(|(sums, &pixel)| sums.add(pixel.into()));
        self.in_rounds(walk, places, first, |i, sums| edges.wanted(places[i], sums), done);
    }

    fn seen(&self, walk: &mut Walk, aims: &[Aim]) -> Vec<Option<Seen>> {
        let mut all = vec![None; aims.len()];
        let (mut which, mut places, mut sums, mut ends) = (vec![], vec![], vec![], vec![]);
        for (i, &(place, sampling)) in aims.iter().enumerate() {
            if walk.patience.is_over {
                return all;
            }
            let seen = match sampling {
                Sampling::Planned => self.planned(walk, place),
                Sampling::Jittered { side, seed } => self.jittered(walk, place, side, seed),
                Sampling::Numbered { first, end, sum } => {
                    which.push(i);
                    places.push(place);
                    sums.push(Sums::after(first, sum));
                    ends.push(end);
                    continue;
                }
            };
            all[i] = (!walk.patience.is_over).then_some(seen);
        }
        let gamma = self.tracer.world.settings.assumed_gamma;
        self.in_rounds(
            walk,
            &places,
            sums,
            |i, _| ends[i],
            |i, sums| {
                let variance = sums.linear_variance(gamma);
                all[which[i]] = Some(Seen { mean: sums.mean(), sum: sums.seen, variance });
            },
        );
        all
    }

    fn planned(&self, walk: &mut Walk, place: (u32, u32)) -> Seen {
        let mut seen = Sums::NONE;
        self.sample(walk, &[place], |_, sums| seen = *sums);
        if let Some(adaptive) = self.adaptive() {
            let first = seen.pixel();
            if let Some(edges) = self.edges_near(walk, place, first, adaptive) {
                self.refine(walk, &edges, &[place], &[first], |_, sums| seen = *sums);
            }
        }
        Seen { mean: seen.pixel().into(), sum: seen.seen, variance: 0.0 }
    }

    /// Returns the edges around a pixel, given its own first sample; `None` if there are none. The samples of the pixels
    /// around it are not counted.
    fn edges_near(
        &self,
        walk: &mut Walk,
        (x, y): (u32, u32),
        first: Pixel,
        adaptive: (f64, u32),
    ) -> Option<Edges> {
        let mut known = Region { x, y, width: 1, height: 1 };
        let region = |reach| grown(known, reach, self.plan.frame);
        let (near, far) = (region(1), region(Edges::REACH));
        let frame = Frame { region: far, ..self.plan.frame };
        let mut film = Film::new(frame, self.tracer.world.settings.assumed_gamma);
        let own = film.index(x, y);
        film.pixels[own] = first;
        let alone = Crew::new(&TraceOptions::on_threads(1), self.tracer.watch);
        let before = walk.counters;
        // Most pixels near an edge have it among their neighbours.
        let edges = [near, far].into_iter().find_map(|region| {
            let places = region.places().filter(|&place| !known.contains(place));
            let places: Vec<_> = places.collect();
            self.sample(walk, &places, |i, sums| {
                let index = film.index(places[i].0, places[i].1);
                film.pixels[index] = sums.pixel();
            });
            known = region;
            let edges = Edges::new(&alone, &film.clone().crop(region), adaptive);
            edges.are_near((x, y)).then_some(edges)
        });
        walk.counters = before;
        edges
    }

    fn jittered(&self, walk: &mut Walk, (x, y): (u32, u32), side: u32, seed: u64) -> Seen {
        let mut random = Random::of(seed, u64::from(x) << 32 | u64::from(y));
        let within = |part: u32, random: &mut Random| {
            (f64::from(part) + random.number(0.0, 1.0)) / f64::from(side)
        };
        let places = (0..side * side).map(|k| {
            let right = within(k % side, &mut random);
            (right, within(k / side, &mut random))
        });
        let Some(_) = self.lens.focus() else {
            let points = places.map(|place| self.lens.point_within((x, y), place, [0.0; 2]));
            return self.mean(walk, points);
        };
        // One in each part of the lens, too, in any order.
        let mut over_lens = Random::of(!seed, u64::from(x) << 32 | u64::from(y));
        let mut parts: Vec<u32> = (0..side * side).collect();
        for last in (1..parts.len()).rev() {
            parts.swap(last, over_lens.below(last + 1));
        }
        let lenses = parts.into_iter().map(|part| {
            let first = within(part % side, &mut over_lens);
            [first, within(part / side, &mut over_lens)]
        });
        let points = places.zip(lenses);
        let points = points.map(|(place, lens)| self.lens.point_within((x, y), place, lens));
        self.mean(walk, points)
    }

    fn mean(&self, walk: &mut Walk, points: impl Iterator<Item = Point>) -> Seen {
        let mut sums = Sums::NONE;
        self.tracer.each_sample(walk, &self.lens, points, |seen| sums.add(seen));
        Seen { mean: sums.mean(), sum: sums.seen, variance: 0.0 }
    }
}
