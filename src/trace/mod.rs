//! Gathers the light of a World by its Plan.
//!
//! **In:** [`World`], [`Plan`]. **Out:** [`Traced`]. **Invariant:** the film's bits do not depend
//! on the number of threads, on their timing or on the tiles; nothing is allocated per ray; a kernel has no
//! instruction for a hot effect that the Plan leaves out, and for what is data (a material's lobes, a light's
//! beam) asks where it stands.

mod absorption;
mod ahead;
mod antialias;
mod attenuation;
mod bumpy;
mod camera;
mod counters;
mod dispersion;
mod extras;
mod grain;
mod highlight;
mod irid;
mod kernel;
mod layers;
mod media;
mod metal;
mod onward;
mod path;
mod pixels;
mod reflection;
mod refraction;
mod shade;
mod shadow;
mod sharpness;
mod sky;
mod split;
mod texture;
mod tiles;
mod transmission;
mod watch;
mod way;

use crate::color::{Gamma, Rgb};
use crate::film::Film;
use crate::geometry::{Geometry, Hit, Occluder};
use crate::plan::{Antialias, Frame, Plan, Region};
use crate::world::World;

use ahead::Ahead;
use antialias::Shown;
use camera::Lens;
use kernel::kernel;
use media::Media;
use path::{Fork, Link, Tracer};
use shadow::Filters;
use tiles::Crew;
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
    pub fn unbegun(frame: Frame, assumed_gamma: Gamma) -> Self {
        let film = Film::new(frame, assumed_gamma);
        Self { film, counters: Counters::default(), complete: false }
    }
}

/// What a thread keeps from ray to ray.
#[derive(Debug, Default)]
pub(crate) struct Walk {
    ahead: Ahead,
    chain: Vec<Link>,
    /// Rays that wait until a mirrored one has come back, the last to be traced next.
    forks: Vec<Fork>,
    media: Media,
    /// Surfaces that coincide with the one at hand.
    coinciding: Vec<Hit>,
    filters: Filters,
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
    let frame = kernel!(plan.kernel, geometry.counts(), frame);
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

/// Traces the region with one kernel. A function of its own, so that its instructions can be counted.
#[inline(never)]
fn frame<const SHADOWS: bool, const SECONDARY: bool, const KINDS: bool, const COUNTS: bool>(
    tracer: &Tracer,
    plan: &Plan,
    crew: &Crew,
) -> Traced {
    let Frame { width, height, .. } = plan.frame;
    let lens = Lens::new(&tracer.world.camera, width, height);
    // Inlined into each pass: as a closure of its own it would be called for each pixel.
    let sampled = sampled::<SHADOWS, SECONDARY, KINDS, COUNTS>;
    let together = tracer.in_image.has_tree();
    // Of pixels with one sample each; more of them look ahead themselves.
    let prepared = |walk: &mut Walk, Region { x, y, width, height }: Region| {
        if together {
            let places = (y..y + height).flat_map(|y| (x..x + width).map(move |x| (x, y)));
            tracer.look_ahead::<KINDS>(walk, places.map(|place| lens.ray(place, (0, 0), 1)));
        }
    };
    let alone = |_: &mut Walk, _: Region| {};
    let region = plan.frame.region;
    let empty =
        |region| Film::new(Frame { region, ..plan.frame }, tracer.world.settings.assumed_gamma);
    match plan.antialias {
        Antialias::Off | Antialias::Grid(0..=1) => {
            crew.pass(empty(region), (0, 1), prepared, |walk, x, y| {
                Some(sampled(tracer, &lens, walk, (x, y), 1))
            })
        }
        Antialias::Grid(grid) => crew.pass(empty(region), (0, 1), alone, |walk, x, y| {
            Some(sampled(tracer, &lens, walk, (x, y), grid))
        }),
        Antialias::Adaptive { threshold, grid } => {
            let border = grown(region, width, height);
            let first = crew.pass(empty(border), (0, 2), prepared, |walk, x, y| {
                Some(sampled(tracer, &lens, walk, (x, y), 1))
            });
            let shown = first.complete.then(|| Shown::new(&first.film));
            let film = first.film.crop(region);
            let Some(shown) = shown else { return Traced { film, ..first } };
            let mut second = crew.pass(film, (1, 2), alone, |walk, x, y| {
                let edge = shown.is_edge(x, y, threshold);
                edge.then(|| sampled(tracer, &lens, walk, (x, y), grid.max(1)))
            });
            second.counters += first.counters;
            second
        }
    }
}

/// The mean of a pixel's samples, and how many.
#[inline(always)]
fn sampled<const SHADOWS: bool, const SECONDARY: bool, const KINDS: bool, const COUNTS: bool>(
    tracer: &Tracer,
    lens: &Lens,
    walk: &mut Walk,
    pixel: (u32, u32),
    grid: u32,
) -> (Rgb, u32) {
    let together = tracer.in_image.has_tree();
    if together && grid > 1 {
        walk.ahead.clear();
    }
    let radiance = antialias::mean(walk, tracer.watch, grid, |walk, i, j| {
        walk.counters.camera += 1;
        if !together {
            let ray = lens.ray(pixel, (i, j), grid);
            return tracer.seen::<SHADOWS, SECONDARY, KINDS, COUNTS>(walk, ray);
        }
        let (ray, hit) = walk.ahead.next().unwrap_or_else(|| {
            let rest = j * grid + i..grid * grid;
            let rays = rest.map(|k| lens.ray(pixel, (k % grid, k / grid), grid));
            tracer.look_ahead::<KINDS>(walk, rays);
            walk.ahead.next().unwrap_or((lens.ray(pixel, (i, j), grid), Hit::NOTHING))
        });
        tracer.radiance::<SHADOWS, SECONDARY, KINDS, COUNTS>(walk, ray, hit)
    });
    (radiance, grid * grid)
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
