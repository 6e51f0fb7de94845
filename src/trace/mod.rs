//! Traces a World by its Plan: gathers the light of each pixel.
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
mod bumpy;
mod camera;
mod counters;
mod dispersion;
mod extras;
mod first_surface;
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
mod parts;
mod pixels;
mod projection;
mod rainbow;
mod reflection;
mod refraction;
mod rounds;
mod sampler;
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
use crate::film::{Channels, Film, Pixel};
use crate::geometry::{Geometry, Hit, Occluder};
use crate::plan::{Frame, Plan, Region};
use crate::world::World;

use antialias::Edges;
use area::Nodes;
use batch::{Batch, Onwards};
use media::Media;
use pixels::Screen;
use shadow::Filters;
use tracer::Tracer;
use watch::Patience;

pub(crate) use antialias::{FEW, expected, gain, of_edge};
pub use counters::{Counters, Evaluations};
pub use first_surface::first_surfaces;
#[doc(hidden)]
pub use pixels::{Aim, Sampling, Seen, aims, pixels};
pub(crate) use sight::Sight;
pub(crate) use tiles::Crew;
pub(crate) use watch::Limited;
pub use watch::{Unwatched, Watch, Watched};

/// Options of [`trace()`]. None of them changes a bit of the picture.
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
    /// Returns the defaults with so many threads.
    pub const fn on_threads(threads: usize) -> Self {
        Self { threads: Some(threads), count_work: false, tile_side: None }
    }
}

/// A traced picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Traced {
    /// The light of each pixel.
    pub film: Film,
    /// The rays that it took.
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
/// Adaptive antialiasing passes over the whole film twice: one ray through each pixel's centre (and through those of a
/// border around a region), then more samples in each pixel near an edge, as many as its samples call for.
///
/// ```
/// use lucarne::plan::{Antialias, Frame, PlanOptions, plan};
/// use lucarne::trace::{TraceOptions, Unwatched, trace};
/// use lucarne::{road::{Options, Road}, source::NoFiles};
///
/// let mut road = Road::new(&NoFiles, Options::default());
/// let (world, origins) = road.compile("a.scene", "background { rgb <1, 0.5, 0.25> }");
/// let options = PlanOptions { antialias: Antialias::Off, ..PlanOptions::new(Frame::whole(8, 6)) };
/// let traced = trace(&world, &plan(&world, &origins, &options), &TraceOptions::default(), &Unwatched);
/// assert_eq!(traced.film.radiance(0).components(), [1.0, 0.5, 0.25]);
/// assert_eq!(traced.counters.camera, 8 * 6);
/// ```
pub fn trace(world: &World, plan: &Plan, options: &TraceOptions, watch: &dyn Watch) -> Traced {
    trace_in(world, &geometry(world, plan, options), plan, options, watch)
}

/// As [`trace`], with a `geometry` that stands already: that of [`geometry`] for this Plan, or one
/// like it.
pub(crate) fn trace_in(
    world: &World,
    geometry: &Geometry,
    plan: &Plan,
    options: &TraceOptions,
    watch: &dyn Watch,
) -> Traced {
    trace_on(world, geometry, plan, options, watch, Vec::new())
}

/// As [`trace()`] with the `geometry` of the World and the Plan, going on from the films of the passes that were
/// [begun](Watch::begins) before: the picture is the same to the bit.
pub fn trace_on(
    world: &World,
    geometry: &Geometry,
    plan: &Plan,
    options: &TraceOptions,
    watch: &dyn Watch,
    begun: Vec<Film>,
) -> Traced {
    let world = &*world.within_julia_iterations(plan.julia_iterations);
    let tracer = Tracer::new(world, geometry, plan, watch);
    watch.built();
    let crew = Crew::new(options, watch);
    frame(&tracer, plan, &crew, begun)
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
fn frame(tracer: &Tracer, plan: &Plan, crew: &Crew, begun: Vec<Film>) -> Traced {
    let (screen, channels) = (Screen::new(tracer, plan), Channels::with(plan.alpha));
    let gamma = tracer.world.settings.assumed_gamma;
    let goes_on = !begun.is_empty();
    let mut begun = begun.into_iter();
    let mut pass = |region, which| {
        let frame = Frame { region, ..plan.frame };
        let film = begun.next().filter(|film| film.frame == frame);
        let film = film.unwrap_or_else(|| Traced::unbegun(frame, gamma, channels).film);
        crew.pass(film, which, |walk, places, pixels| match goes_on {
            false => screen.sample(walk, places, |i, sums| pixels[i] = sums.pixel()),
            true => each_open(places, pixels, 0, |places, _, done| {
                screen.sample(walk, places, |i, sums| done(i, sums.pixel()));
            }),
        })
    };
    let region = plan.frame.region;
    let Some(adaptive) = screen.adaptive() else { return pass(region, (0, 1)) };
    let first = pass(grown(region, Edges::REACH, plan.frame), (0, 2));
    let edges = first.complete.then(|| Edges::new(crew, &first.film, adaptive));
    let film = first.film.crop(region);
    let Some(edges) = edges else { return Traced { film, ..first } };
    let mut film = film;
    if let Some(begun) = begun.next().filter(|begun| begun.frame == film.frame) {
        let both = film.pixels.iter_mut().zip(begun.pixels);
        both.filter(|(_, begun)| begun.samples() > 1).for_each(|(pixel, begun)| *pixel = begun);
    }
    let mut second = crew.pass(film, (1, 2), |walk, places, pixels| {
        each_open(places, pixels, 1, |places, before, done| {
            screen.refine(walk, &edges, places, before, |i, sums| done(i, sums.pixel()));
        });
    });
    second.counters += first.counters;
    second
}

/// Lets `trace` change those pixels that have so many samples: others were done before.
fn each_open(
    places: &[(u32, u32)],
    pixels: &mut [Pixel],
    samples: u32,
    trace: impl FnOnce(&[(u32, u32)], &[Pixel], &mut dyn FnMut(usize, Pixel)),
) {
    let open: Vec<usize> = (0..pixels.len()).filter(|&i| pixels[i].samples() == samples).collect();
    let places: Vec<_> = open.iter().map(|&i| places[i]).collect();
    let before: Vec<_> = open.iter().map(|&i| pixels[i]).collect();
    trace(&places, &before, &mut |i, pixel| pixels[open[i]] = pixel);
}

/// The region and the pixels around it that are at most `reach` away.
fn grown(region: Region, reach: u32, Frame { width, height, .. }: Frame) -> Region {
    let before = |start: u32| start.saturating_sub(reach);
    let behind = |end: u32, all: u32| end.saturating_add(reach).min(all);
    let (x, y) = (before(region.x), before(region.y));
    let right = behind(region.x + region.width, width);
    let bottom = behind(region.y + region.height, height);
    Region { x, y, width: right - x, height: bottom - y }
}

#[cfg(test)]
mod tests;
