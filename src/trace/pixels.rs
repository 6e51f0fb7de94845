//! Single pixels of a picture: as its Plan has them, or sampled anew as finely as one likes.
//!
//! **In:** a list of pixels. **Out:** [`Pixels`]. **Invariant:** as for the film, nothing depends
//! on the number of threads; a planned pixel has the bits that [`super::trace`] puts there.

use super::antialias::Edges;
use super::camera::{Lens, Point, Shift};
use super::sight::Sight;
use super::tiles::Crew;
use super::tracer::Tracer;
use super::{Counters, TraceOptions, Walk, Watch, grown};
use crate::color::Rgb;
use crate::film::Film;
use crate::geometry::Geometry;
use crate::math::random::Random;
use crate::plan::{Antialias, Frame, Plan, Region};
use crate::world::World;

/// Where a pixel's samples lie.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sampling {
    /// As the Plan says. An adaptive Plan looks at the neighbours first; their rays are counted
    /// with theirs, not here.
    Planned,
    /// One sample somewhere in each of `side` × `side` equal parts of the pixel: an unbiased
    /// estimate of the mean over the pixel, independent of that of any other `seed`.
    ///
    /// **Source:** R. Cook, "Stochastic sampling in computer graphics", ACM TOG 5(1), 1986.
    Jittered { side: u32, seed: u64 },
}

/// What was seen in the pixels of a list, in its order.
#[derive(Debug, Clone, PartialEq)]
pub struct Pixels {
    /// The mean of each pixel's samples, in the scene's working space; `None` for those that the
    /// watch left undone, the last of the list as a rule.
    pub radiance: Vec<Option<Rgb>>,
    /// Of each, how much of it is not the background, if the Plan asks for that.
    pub opacity: Vec<f64>,
    pub counters: Counters,
}

/// Traces the pixels `list` of the Plan's frame; all must lie in its region. `geometry` is that of
/// [`super::geometry`] for this Plan, or one like it.
pub fn pixels(
    world: &World,
    geometry: &Geometry,
    plan: &Plan,
    list: &[(u32, u32)],
    sampling: Sampling,
    options: &TraceOptions,
    watch: &dyn Watch,
) -> Pixels {
    let world = &*world.within_julia_iterations(plan.julia_iterations);
    let tracer = Tracer::new(world, geometry, plan, watch);
    let pixel = Pixel::new(&tracer, plan);
    let crew = Crew::new(options, watch);
    let (seen, counters) = crew.each(list, |walk, &place| match sampling {
        // As the film holds it.
        Sampling::Planned => pixel.planned(walk, place).pixel(1).into(),
        Sampling::Jittered { side, seed } => pixel.jittered(walk, place, side, seed),
    });
    let radiance = seen.iter().map(|seen| Some(seen.as_ref()?.radiance)).collect();
    let opacity = seen.iter().map(|seen| seen.map_or(0.0, |seen| seen.opacity)).collect();
    Pixels { radiance, opacity, counters }
}

/// A pixel, and how to look at it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Aim {
    pub place: (u32, u32),
    /// By `side` × `side` samples.
    pub side: u32,
    /// As [`Sampling::Jittered`]; `None`: in the middle of each part, as the film has them.
    pub seed: Option<u64>,
}

/// What was seen in a pixel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Seen {
    /// Of the samples, in the scene's working space.
    pub mean: Rgb,
    /// How much of it is not the background, if the Plan asks for that.
    pub opacity: f64,
    /// The standard deviation of each component of the samples, those beyond [`Seen::BRIGHTEST`] counted
    /// as that; 0 of samples drawn at random.
    pub deviation: [f64; 3],
}

impl Seen {
    /// A little beyond what a display shows: a pixel is not noisier for being brighter than that.
    pub const BRIGHTEST: f64 = 4.0;
}

/// Traces pixels of the Plan's frame, each as finely as it says; `None` for those that the watch left
/// undone, the last of the list as a rule.
pub fn seen(
    world: &World,
    geometry: &Geometry,
    plan: &Plan,
    list: &[Aim],
    options: &TraceOptions,
    watch: &dyn Watch,
) -> (Vec<Option<Seen>>, Counters) {
    let world = &*world.within_julia_iterations(plan.julia_iterations);
    let tracer = Tracer::new(world, geometry, plan, watch);
    let pixel = Pixel::new(&tracer, plan);
    Crew::new(options, watch).each(list, |walk, aim| pixel.aimed(walk, aim))
}

struct Pixel<'a> {
    plan: &'a Plan,
    tracer: &'a Tracer<'a>,
    lens: Lens,
}

impl<'a> Pixel<'a> {
    fn new(tracer: &'a Tracer<'a>, plan: &'a Plan) -> Self {
        let Frame { width, height, .. } = plan.frame;
        let lens = Lens::new(&tracer.world.camera, width, height).sampled(plan.blur_samples);
        Self { plan, tracer, lens }
    }

    fn planned(&self, walk: &mut Walk, place: (u32, u32)) -> Sight {
        if let Some(focus) = self.lens.focus() {
            let seen = self.tracer.blurred(walk, &self.lens, focus, &[place]);
            return seen[0].map_or(Sight::NOTHING, |(mean, _)| mean);
        }
        match self.plan.antialias {
            Antialias::Off => self.grid(walk, place, 1),
            Antialias::Grid(n) => self.grid(walk, place, n.max(1)),
            Antialias::Adaptive { threshold, grid } => {
                let (first, is_edge) = self.first_pass(walk, place, threshold);
                if is_edge { self.grid(walk, place, grid.max(1)) } else { first }
            }
        }
    }

    /// The pixel's single sample, and whether its neighbours' make it an edge.
    fn first_pass(&self, walk: &mut Walk, (x, y): (u32, u32), threshold: f64) -> (Sight, bool) {
        let Frame { width, height, .. } = self.plan.frame;
        let region = grown(Region { x, y, width: 1, height: 1 }, width, height);
        let gamma = self.tracer.world.settings.assumed_gamma;
        let mut around = Film::new(Frame { region, ..self.plan.frame }, gamma);
        let mut own = Counters::default();
        for line in region.y..region.y + region.height {
            for column in region.x..region.x + region.width {
                let before = std::mem::take(&mut walk.counters);
                let at = around.index(column, line);
                around.pixels[at] = self.grid(walk, (column, line), 1).pixel(1);
                let these = std::mem::replace(&mut walk.counters, before);
                if (column, line) == (x, y) {
                    own = these;
                }
            }
        }
        walk.counters += own;
        let edge = Edges::new(&around, threshold).has(x, y);
        (around.pixels[around.index(x, y)].into(), edge)
    }

    fn grid(&self, walk: &mut Walk, place: (u32, u32), grid: u32) -> Sight {
        self.grid_seen(walk, place, grid, |_| ())
    }

    /// The mean; `also` is shown each sample.
    fn grid_seen(
        &self,
        walk: &mut Walk,
        place: (u32, u32),
        grid: u32,
        also: impl FnMut(Sight),
    ) -> Sight {
        if let Some(focus) = self.lens.focus() {
            let shift = Shift::of(place);
            let points = (0..grid * grid).map(|k| self.lens.blurred(focus, place, &shift, k));
            return self.mean(walk, grid, points, also);
        }
        let points = (0..grid * grid).map(|k| self.lens.point(place, (k % grid, k / grid), grid));
        self.mean(walk, grid, points, also)
    }

    fn mean(
        &self,
        walk: &mut Walk,
        grid: u32,
        points: impl Iterator<Item = Point>,
        mut also: impl FnMut(Sight),
    ) -> Sight {
        let mut sum = Sight::NOTHING;
        self.tracer.each_sample(walk, &self.lens, points, |seen| {
            also(seen);
            sum += seen;
        });
        sum.mean(f64::from(grid) * f64::from(grid))
    }

    fn aimed(&self, walk: &mut Walk, &Aim { place, side, seed }: &Aim) -> Seen {
        let (mut sum, mut squares) = ([0.0; 3], [0.0; 3]);
        let add = |seen: Sight| {
            for (c, (sum, square)) in
                seen.radiance.components().into_iter().zip(sum.iter_mut().zip(&mut squares))
            {
                let c = c.clamp(0.0, Seen::BRIGHTEST);
                *sum += c;
                *square += c * c;
            }
        };
        let Sight { radiance: mean, opacity } = match seed {
            None => self.grid_seen(walk, place, side, add),
            Some(seed) => self.jittered(walk, place, side, seed),
        };
        let n = f64::from(side) * f64::from(side);
        let deviation = std::array::from_fn(|i| {
            let mean: f64 = sum[i] / n;
            (squares[i] / n - mean * mean).max(0.0).sqrt()
        });
        Seen { mean, opacity, deviation }
    }

    fn jittered(&self, walk: &mut Walk, (x, y): (u32, u32), side: u32, seed: u64) -> Sight {
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
            return self.mean(walk, side, points, |_| ());
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
        self.mean(walk, side, points, |_| ())
    }
}
