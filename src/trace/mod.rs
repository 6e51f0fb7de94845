//! Gathers the light of a World by its Plan.
//!
//! **In:** [`World`], [`Plan`]. **Out:** [`Traced`]. **Invariant:** the film's bits do not depend
//! on the number of threads, on their timing, on the tiles or on what is traced together.
//!
//! Rays are traced in batches that pass through stages: the camera makes rays, `batch` follows them from generation
//! to generation, `batch::intersect` finds what they meet, `surface` tells what is there, `light` adds the lights,
//! `transmission` and `layers` send rays on, and what comes back is folded.

mod absorption;
mod antialias;
mod area;
mod attenuation;
mod batch;
mod behind;
mod blur;
mod bumpy;
mod camera;
mod counters;
mod dispersion;
mod extras;
mod fog;
mod grain;
mod highlight;
mod irid;
mod layered;
mod layers;
mod light;
mod media;
mod metal;
mod packet;
mod paint;
mod pixels;
mod projection;
mod rainbow;
mod reflection;
mod refraction;
mod samples;
mod shade;
mod shadow;
mod sharpness;
mod sight;
mod sky;
mod split;
mod surface;
mod surface_batch;
mod texture;
mod tiles;
mod tracer;
mod traits;
mod transmission;
mod veil;
mod watch;
mod way;

use crate::color::{Gamma, Rgb};
use crate::film::{Channels, Film};
use crate::geometry::{Geometry, Hit, Occluder};
use crate::plan::{Antialias, Frame, Plan, Region};
use crate::world::World;

use antialias::Edges;
use area::Nodes;
use batch::{Batch, Onwards};
use camera::Lens;
use media::Media;
use shadow::Filters;
use sight::Sight;
use tiles::Crew;
use tracer::Tracer;
use watch::Patience;

pub use counters::{Counters, Evaluations};
pub use pixels::{Aim, Pixels, Sampling, Seen, pixels, seen};
pub use watch::{Limited, Unwatched, Watch};

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct TraceOptions {
    /// `None`: one for each processor.
    pub threads: Option<usize>,
    /// Count the [`crate::geometry::Work`] and the [`Evaluations`], too. Some scenes take 1 % longer.
    pub count_work: bool,
    /// Pixels along the side of a tile, what a thread takes at once; `None`: 32. No bit of a picture depends on it,
    /// nor on the threads.
    pub tile_side: Option<u32>,
}

impl TraceOptions {
    pub const fn on_threads(threads: usize) -> Self {
        Self { threads: Some(threads), count_work: false, tile_side: None }
    }
}

#[derive(Debug, Clone, PartialEq)]
pub struct Traced {
    pub film: Film,
    pub counters: Counters,
    /// False when the watch stopped it: some pixels then have fewer samples, or none.
    pub complete: bool,
}

impl Traced {
    /// Before any ray: every pixel black.
    pub fn unbegun(frame: Frame, assumed_gamma: Gamma, channels: Channels) -> Self {
        let film = Film { channels, ..Film::new(frame, assumed_gamma) };
        Self { film, counters: Counters::default(), complete: false }
    }
}

/// What a thread keeps from batch to batch.
#[derive(Debug, Default)]
pub(crate) struct Walk {
    batch: Batch,
    /// Rays that go on before the surfaces at hand, where these mirror them, and behind them.
    onward: Onwards,
    behind: Onwards,
    media: Media,
    /// Surfaces that coincide with the one at hand.
    coinciding: Vec<Hit>,
    filters: Filters,
    /// The nodes of the area light at hand.
    nodes: Nodes,
    /// The place, in its texture, of the finish at hand; 0 if it is the only one.
    part: u32,
    /// What each light sends to the parts of the texture at hand, before the surface and behind it, once it is
    /// known: the same for all parts.
    arrived: Vec<[Option<Option<Rgb>>; 2]>,
    /// For each light what last stood before it, or nothing: a guess, worth no more than time, and
    /// forgotten at each tile, so that no count depends on who takes it.
    occluders: Vec<Occluder>,
    counters: Counters,
    patience: Patience,
}

impl Walk {
    /// How many rays go on from surfaces.
    fn pending(&self) -> usize {
        self.onward.len() + self.behind.len()
    }

    #[inline(never)]
    fn remember(&mut self, light: usize, occluder: Occluder) {
        if self.occluders.len() <= light {
            self.occluders.resize(light + 1, Occluder::NONE);
        }
        self.occluders[light] = occluder;
    }
}

/// Traces the frame's region.
///
/// Adaptive antialiasing passes over the whole film twice: one ray through each pixel's centre
/// (and through those of a border one pixel wide around a region), then `grid` × `grid` samples
/// instead in each pixel that differs from a neighbour.
pub fn trace(world: &World, plan: &Plan, options: &TraceOptions, watch: &dyn Watch) -> Traced {
    trace_in(world, &geometry(world, plan, options), plan, options, watch)
}

/// As [`trace`], with a `geometry` that stands already: that of [`geometry`] for this Plan, or one
/// like it.
pub fn trace_in(
    world: &World,
    geometry: &Geometry,
    plan: &Plan,
    options: &TraceOptions,
    watch: &dyn Watch,
) -> Traced {
    let world = &*world.within_julia_iterations(plan.julia_iterations);
    let tracer = Tracer::new(world, geometry, plan, watch);
    watch.built();
    let crew = Crew::new(options, watch);
    frame(&tracer, plan, &crew)
}

/// The World's geometry in the Plan's arithmetic.
pub fn geometry(world: &World, plan: &Plan, options: &TraceOptions) -> Geometry {
    let geometry = Geometry::build(&world.within_julia_iterations(plan.julia_iterations));
    let geometry = if options.count_work { geometry.counting() } else { geometry };
    match plan.root_tolerance {
        0.0 => geometry,
        tolerance => geometry.within_root_tolerance(tolerance),
    }
}

/// Traces the region. A function of its own, so that its instructions can be counted.
#[inline(never)]
fn frame(tracer: &Tracer, plan: &Plan, crew: &Crew) -> Traced {
    let Frame { width, height, region } = plan.frame;
    let lens = Lens::new(&tracer.world.camera, width, height).sampled(plan.blur_samples);
    let channels = Channels::with(plan.alpha);
    let gamma = tracer.world.settings.assumed_gamma;
    let empty = |region| Film { channels, ..Film::new(Frame { region, ..plan.frame }, gamma) };
    let uniform = |film, which, grid| {
        crew.pass(film, which, |walk, places, pixels| {
            sampled(tracer, &lens, walk, places, |_| grid, pixels);
        })
    };
    if let Some(focus) = lens.focus() {
        return crew.pass(empty(region), (0, 1), |walk, places, pixels| {
            pixels.extend(tracer.blurred(walk, &lens, focus, places));
        });
    }
    match plan.antialias {
        Antialias::Off => uniform(empty(region), (0, 1), 1),
        Antialias::Grid(grid) => uniform(empty(region), (0, 1), grid.max(1)),
        Antialias::Adaptive { threshold, grid } => {
            let border = grown(region, width, height);
            let first = uniform(empty(border), (0, 2), 1);
            let edges = first.complete.then(|| Edges::found_by(crew, &first.film, threshold));
            let film = first.film.crop(region);
            let Some(edges) = edges else { return Traced { film, ..first } };
            let mut second = crew.pass(film, (1, 2), |walk, places, pixels| {
                let finer = |(x, y)| match edges.has(x, y) {
                    true => grid.max(1),
                    false => 0,
                };
                sampled(tracer, &lens, walk, places, finer, pixels);
            });
            second.counters += first.counters;
            second
        }
    }
}

/// The mean of a pixel's samples, and how many.
type Sampled = (Sight, u32);

/// Samples pixels side by side: each by `grid` × `grid` samples, whose mean is taken in a fixed order. `None` where
/// `grid` is 0, and where the watch wanted no more.
fn sampled(
    tracer: &Tracer,
    lens: &Lens,
    walk: &mut Walk,
    places: &[(u32, u32)],
    grid: impl Fn((u32, u32)) -> u32,
    pixels: &mut Vec<Option<Sampled>>,
) {
    let grids: Vec<u32> = places.iter().map(|&place| grid(place)).collect();
    let points = places.iter().zip(&grids).flat_map(|(&place, &grid)| {
        (0..grid).flat_map(move |j| (0..grid).map(move |i| lens.point(place, (i, j), grid)))
    });
    let mut sum = (Sight::NOTHING, 0);
    tracer.each_sample(walk, lens, points, |seen| {
        while grids[pixels.len()] == 0 {
            pixels.push(None);
        }
        let grid = grids[pixels.len()];
        sum = (sum.0 + seen, sum.1 + 1);
        if sum.1 == grid * grid {
            pixels.push(Some((sum.0.mean(f64::from(sum.1)), sum.1)));
            sum = (Sight::NOTHING, 0);
        }
    });
    pixels.resize(places.len(), None);
}

/// The region and the pixels around it.
fn grown(region: Region, width: u32, height: u32) -> Region {
    let (x, y) = (region.x.saturating_sub(1), region.y.saturating_sub(1));
    let right = (region.x + region.width + 1).min(width);
    let bottom = (region.y + region.height + 1).min(height);
    Region { x, y, width: right - x, height: bottom - y }
}

#[cfg(test)]
mod tests;
