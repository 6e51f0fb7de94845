//! `render --time-budget`: schedules tracing so that the picture is written in time, and reports the
//! result.

use std::cell::Cell;
use std::thread::available_parallelism;

use lucarne::accuracy::{self, Clock, First, Options, Spent};
use lucarne::color::Rgb;
use lucarne::film::{Channels, Depth, Developer, Film, Pixel};
use lucarne::picture::{self, Format};
use lucarne::plan::Region;
use lucarne::world::{Origins, World};

use super::exit::Exit;
use super::progress::Progress;
use super::promise::{Made, error, glare};
use super::stats::Stopwatch;

/// Fraction of the budget that tracing and writing may use by forecast. The rest is half of the promised 5
/// %, kept for errors of the forecast.
const PLANNED: f64 = 0.975;
/// One row in `ON_TRIAL` is encoded on trial, in `BANDS` bands. Encoding the full picture may take `SLOWER`
/// times as long per row, because it has more detail and uses fresh memory.
const ON_TRIAL: u32 = 16;
const BANDS: u32 = 8;
const SLOWER: f64 = 1.3;
/// Encoding trials stop after `TRIAL` seconds or `TRIALS` runs. A shorter measurement does not show what
/// share of a processor the program gets.
const TRIAL: f64 = 0.01;
const TRIALS: u32 = 8;
/// Fraction of the budget reserved for the error audit, however long writing takes.
const FOR_ERROR: f64 = 0.02;
/// Seconds needed to stop and exit if each thread has a processor of its own.
const TO_END: f64 = 0.01;
/// If reading used up the budget: extra time allowed for a first pass, as a fraction of the reading time.
const LATE: f64 = 0.1;

/// Renders for `seconds`, counted from the start of the program, and reports the result.
pub(super) fn spend(
    (world, origins): (&World, &Origins),
    options: &Options,
    seconds: f64,
    written: (Depth, Format),
    clock: &Stopwatch,
    progress: &Progress,
) -> Made {
    let desk = Desk::new(world, options, written, clock);
    let threads = options.trace.threads.or_else(|| Some(available_parallelism().ok()?.get()));
    // Time at which the scene was read and the bounding volume hierarchy built; time needed to write the
    // picture.
    let (read, to_end) = (Cell::new(0.0), Cell::new(0.0));
    let end = |Writing { seconds: write, busy }: Writing, busy_by_now: f64| {
        let busy = busy.max(busy_by_now);
        to_end.set(write + TO_END * busy);
        PLANNED * seconds - to_end.get()
    };
    let until = |first: Option<First>| match first {
        None => {
            let wall = clock.wall();
            read.set(wall);
            let end = end(desk.writing(&unknown(options, world)), 1.0);
            if is_late(wall, seconds) {
                return end.max(wall * (1.0 + LATE));
            }
            // Reserves half of the time for tracing, however long writing takes.
            end.max(wall + 0.5 * (PLANNED * seconds - wall))
        }
        Some(First { film, processors }) => {
            let busy = threads.map_or(1.0, |threads| threads as f64 / processors);
            let end = end(desk.writing(film), busy);
            // Prefers being slightly late to a picture with an unknown error.
            end.max(clock.wall() + FOR_ERROR * seconds)
        }
    };
    let spent = accuracy::spend(world, origins, options, &until, clock, progress);
    let about = About { seconds, read: read.get(), now: clock.wall(), to_end: to_end.get() };
    let (said, exit) = match (progress.is_stopped(), spent.traced.complete) {
        (true, complete) => (about.interrupted(&spent, complete), Exit::Interrupted),
        (false, false) => (about.unfinished(&spent), Exit::Limit),
        (false, true) => about.finished(&spent, world),
    };
    Made { traced: spent.traced, said, exit }
}

/// Whether reading the scene used up the budget.
fn is_late(read: f64, seconds: f64) -> bool {
    read >= PLANNED * seconds
}

/// Clock readings, in seconds since the program started.
struct About {
    /// The promised time.
    seconds: f64,
    /// When tracing started.
    read: f64,
    now: f64,
    to_end: f64,
}

impl About {
    fn finished(&self, spent: &Spent, world: &World) -> (String, Exit) {
        let (made, depth) = (made(spent), world.settings.max_trace_level);
        match &spent.audit {
            _ if is_late(self.read, self.seconds) => {
                let Self { read, seconds, now, to_end } = self;
                let needed = now + to_end;
                let said = format!(
                    "warning: reading the scene took {read:.2} s of the {seconds} s; with one ray a pixel it takes {needed:.2} s\n{made}\n"
                );
                (said, Exit::Promise)
            }
            Some(audit) => {
                let pixels = match audit.pixels {
                    1 => "1 pixel".to_owned(),
                    pixels => format!("{pixels} pixels"),
                };
                let said = format!(
                    "{}, on {pixels}, after {:.2} s\n{}{made}\n",
                    error(audit),
                    self.now,
                    glare(world)
                );
                (said, Exit::Done)
            }
            None if spent.is_less => {
                let surfaces = if depth == 1 { "surface" } else { "surfaces" };
                let said = format!(
                    "warning: how far off it is is not known: there was no time to look {depth} {surfaces} deep, as the scene does\n{made}\n"
                );
                (said, Exit::Promise)
            }
            None => {
                let said = format!(
                    "warning: how far off it is is not known: the first rays left no time to find out\n{made}\n"
                );
                (said, Exit::Promise)
            }
        }
    }

    fn unfinished(&self, spent: &Spent) -> String {
        let samples = spent.traced.film.samples();
        let pixels = samples.len();
        let done = samples.filter(|samples| *samples > 0).count();
        let share = match done {
            0 => "none".to_owned(),
            done => format!("{} %", 100 * done / pixels.max(1)),
        };
        let with = match spent.is_less || spent.least != spent.flags {
            true => format!(", even with {}", spent.least),
            false => String::new(),
        };
        let Self { seconds, read, now, to_end } = self;
        let reading = match *read > 0.1 * seconds {
            true => format!("; reading the scene took {read:.2} s"),
            false => String::new(),
        };
        let enough = match done {
            0 => String::new(),
            done => {
                let all = read + (now - read) * pixels as f64 / done as f64 + to_end;
                format!("; about {} s would be enough", no_less(1.1 * all.max(now + to_end)))
            }
        };
        format!(
            "{seconds} s are too few for one ray a pixel{with}: {share} of them are done{reading}{enough}\n"
        )
    }

    fn interrupted(&self, spent: &Spent, complete: bool) -> String {
        match complete {
            // The caller says how many pixels there are.
            false => String::new(),
            true => format!(
                "interrupted after {:.2} s of {} s, and how far off it is was not found out: {}\n",
                self.now,
                self.seconds,
                made(spent)
            ),
        }
    }
}

/// Rounds seconds up to two digits, so that the result is at least what is needed.
fn no_less(seconds: f64) -> String {
    let (digits, scale) = match seconds {
        ..0.1 => (3, 1000.0),
        ..1.0 => (2, 100.0),
        ..10.0 => (1, 10.0),
        _ => (0, 1.0),
    };
    format!("{:.digits$}", (seconds * scale).ceil() / scale)
}

/// Forecast of the time needed to write the picture.
struct Writing {
    seconds: f64,
    /// Slowdown relative to an idle machine, at least 1.
    busy: f64,
}

/// Encodes pictures on trial to forecast the writing time.
struct Desk<'a> {
    developer: Developer,
    /// Seconds spent creating `developer`.
    made: f64,
    format: Format,
    clock: &'a Stopwatch,
}

impl<'a> Desk<'a> {
    fn new(
        world: &World,
        options: &Options,
        (depth, format): (Depth, Format),
        clock: &'a Stopwatch,
    ) -> Self {
        let Region { width, height, .. } = options.frame.region;
        let began = clock.wall();
        let pixels = width as usize * height as usize;
        let developer = Developer::new(depth, world.settings.assumed_gamma, pixels);
        Self { developer, made: clock.wall() - began, format, clock }
    }

    /// Estimates the time needed to write a picture by encoding a sample of its rows, from top to bottom.
    fn writing(&self, film: &Film) -> Writing {
        let Self { developer, made, format, clock } = self;
        let Region { width, height, .. } = film.frame.region;
        let row = width as usize;
        let high = (height / (BANDS * ON_TRIAL)).max(1);
        let bands = BANDS.min(height);
        let mut some = Film { pixels: Vec::new(), ..*film };
        some.frame.region.height = bands * high;
        let part = f64::from(some.frame.region.height) / f64::from(height.max(1));
        if film.pixels.is_empty() {
            some.pixels = (0..row * (bands * high) as usize).map(speckled).collect();
        } else {
            for band in 0..bands {
                let top = (height - high) / bands * band;
                let rows = row * top as usize..row * (top + high) as usize;
                some.pixels.extend(&film.pixels[rows]);
            }
        }
        let began = (clock.cpu(), clock.wall());
        let (mut trials, mut took) = (0, (0.0, 0.0));
        while trials < TRIALS && took.1 < TRIAL {
            // Encoding errors are reported when the picture is written.
            let _ = picture::write(&some, developer, *format, &mut std::io::sink());
            trials += 1;
            took = (clock.cpu() - began.0, clock.wall() - began.1);
        }
        let busy = if took.0 > 0.0 { (took.1 / took.0).max(1.0) } else { 1.0 };
        Writing { seconds: made + SLOWER * took.1 / f64::from(trials.max(1)) / part, busy }
    }
}

/// Returns a film without data.
fn unknown(options: &Options, world: &World) -> Film {
    let (frame, assumed_gamma) = (options.frame, world.settings.assumed_gamma);
    Film { frame, assumed_gamma, channels: Channels::with(options.alpha), pixels: Vec::new() }
}

/// Returns pixel `i` of a picture of typical compressibility: a slow gradient with a little noise.
fn speckled(i: usize) -> Pixel {
    let noise = (i.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 56) as f64 / 255.0;
    Pixel::new(Rgb::gray((i % 1024) as f64 / 1024.0 + 0.02 * noise), 1)
}

/// Describes the samples taken: `4 to 64 samples a pixel, 23 on average`.
fn made(spent: &Spent) -> String {
    let film = &spent.traced.film;
    let least = film.samples().min().unwrap_or(0);
    let most = film.samples().max().unwrap_or(0);
    let sum: u64 = film.samples().map(u64::from).sum();
    let mean = sum as f64 / film.pixels.len().max(1) as f64;
    let mut said = match (least == most, most) {
        (true, 1) => "1 sample a pixel".to_owned(),
        (true, _) => format!("{most} samples a pixel"),
        (false, _) if mean < 10.0 => {
            format!("{least} to {most} samples a pixel, {mean:.1} on average")
        }
        (false, _) => format!("{least} to {most} samples a pixel, {mean:.0} on average"),
    };
    if spent.is_finest {
        said += ": that is the most there is, and more time changes nothing";
    }
    if spent.is_less {
        said += &format!("; with {}: more would not fit", spent.flags);
    }
    match spent.rest {
        0 => {}
        1 => said += &format!("; 1 pixel with {}", spent.least),
        rest => said += &format!("; {rest} pixels with {}", spent.least),
    }
    said
}
