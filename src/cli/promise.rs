//! `render --max-error` and `render --time-budget`: a picture and what was promised of it.

use std::collections::BTreeMap;
use std::io::IsTerminal;

use lucarne::accuracy::{self, Audit, Clock, KNOBS, Options, Spent, Step, TooSmall, table};
use lucarne::film::{Depth, Film, develop};
use lucarne::picture::{Format, encode};
use lucarne::plan::{Frame, PlanOptions, Region, plan};
use lucarne::trace::{TraceOptions, Traced, trace};
use lucarne::world::{Origins, World};

use super::arguments::RenderArguments;
use super::exit::{Exit, Failure};
use super::messages;
use super::progress::Progress;
use super::stats::Stopwatch;

/// The pixels and samples of an audit are drawn from this.
const SEED: u64 = 1;
/// Seconds to encode and write a pixel of one colour in.
const LEAST_TO_WRITE: f64 = 2e-8;
/// Of a picture's rows, those that are written on trial; and how much longer the final picture, which is
/// finer, may take.
const ON_TRIAL: u32 = 8;
const FINER: f64 = 1.2;
/// Seconds to find an interval in.
const TO_REPORT: f64 = 0.02;

/// A picture, and what is to be said of it.
pub struct Made {
    pub traced: Traced,
    /// A line for people; empty where nothing was promised.
    pub said: String,
    /// What the program ends with once the picture is written.
    pub exit: Exit,
}

/// Makes the picture as the command line wants it.
pub fn make(
    arguments: &RenderArguments,
    (world, origins): (&World, &Origins),
    plain: &PlanOptions,
    trace_options: TraceOptions,
    clock: &Stopwatch,
    progress: &Progress,
) -> Result<Made, Failure> {
    let options = Options {
        frame: plain.frame,
        knobs: KNOBS,
        metric: arguments.metric.into(),
        budget: 0.0,
        seed: SEED,
        trace: trace_options,
    };
    if let Some(promise) = arguments.max_error {
        return keep(world, origins, &options, promise, progress);
    }
    if let Some(seconds) = arguments.time_budget {
        return Ok(spend(world, origins, &options, seconds, clock, progress));
    }
    let traced = trace(world, &plan(world, origins, plain), &trace_options, progress);
    let exit = if traced.complete { Exit::Done } else { Exit::Interrupted };
    Ok(Made { traced, said: String::new(), exit })
}

fn keep(
    world: &World,
    origins: &Origins,
    options: &Options,
    promise: f64,
    progress: &Progress,
) -> Result<Made, Failure> {
    // On a terminal the bar shows that it works.
    let silent = std::io::stderr().is_terminal();
    let tell = |step: Step| {
        let note = match step {
            _ if silent => return,
            Step::Choosing => "choosing settings on a few pixels".to_owned(),
            Step::Rendering(flags) => format!("rendering with {flags}"),
            Step::Refining(audit) => {
                format!("{}: not proven, choosing better settings", error(&audit))
            }
        };
        messages::eprint(&format!("note: {note}\n"));
    };
    let kept = accuracy::keep(world, origins, options, promise, progress, &tell);
    let kept = kept.map_err(|TooSmall| {
        let Frame { region, .. } = options.frame;
        let (width, height) = (region.width, region.height);
        Failure::usage(format!("{width}×{height} pixels are too few to prove an error by"))
            .help("`--max-error` needs about 16×16")
    })?;
    let Some(kept) = kept else {
        let gamma = world.settings.assumed_gamma;
        let traced = Traced::unbegun(options.frame, gamma);
        return Ok(Made { traced, said: String::new(), exit: Exit::Interrupted });
    };
    let Some(audit) = kept.audit else {
        return Ok(Made { traced: kept.traced, said: String::new(), exit: Exit::Interrupted });
    };
    let proven = audit.proves(promise);
    let may_be = audit.error.value <= promise || audit.error.value < audit.resolution;
    let sign = match (proven, may_be) {
        (true, _) => "≤",
        (false, true) => "is not proven to be ≤",
        (false, false) => ">",
    };
    let amount = table::amount(audit.metric, promise);
    let refined = match (kept.refined, proven) {
        (true, _) => ", in the second picture",
        (false, true) => "",
        (false, false) => "; no settings are known to be better",
    };
    let said = format!(
        "{} {sign} {amount}, on {} fresh pixels{refined}\nthe same picture: {}\n",
        error(&audit),
        audit.pixels,
        kept.flags
    );
    Ok(Made { traced: kept.traced, said, exit: if proven { Exit::Done } else { Exit::Promise } })
}

fn spend(
    world: &World,
    origins: &Origins,
    options: &Options,
    seconds: f64,
    clock: &Stopwatch,
    progress: &Progress,
) -> Made {
    let region = options.frame.region;
    let pixels = f64::from(region.width) * f64::from(region.height);
    // What it takes to write is known once there is something to write.
    let until = |film: Option<&Film>| {
        let to_end = film.map_or(LEAST_TO_WRITE * pixels, |film| to_write(film, clock) + TO_REPORT);
        0.99 * seconds - to_end
    };
    let spent = accuracy::spend(world, origins, options, &until, clock, progress);
    let interrupted = progress.is_stopped();
    let said = match (&spent.audit, spent.traced.complete) {
        (_, false) if interrupted => String::new(),
        (_, false) => {
            let samples = &spent.traced.film.samples;
            let done = samples.iter().filter(|samples| **samples > 0).count();
            let share = 100 * done / samples.len().max(1);
            format!("{seconds} s are too few for one ray a pixel: {share} % of them are done\n")
        }
        (None, true) if pixels < 256.0 => {
            format!("too few pixels to find the error by\n{}\n", made(&spent))
        }
        (None, true) => {
            format!("no time was left to find the error by\n{}\n", made(&spent))
        }
        (Some(audit), true) => format!(
            "{}, on {} fresh pixels, after {:.2} s\n{}\n",
            error(audit),
            audit.pixels,
            clock.wall(),
            made(&spent)
        ),
    };
    let exit = match spent.traced.complete {
        _ if interrupted => Exit::Interrupted,
        true => Exit::Done,
        false => Exit::Limit,
    };
    Made { traced: spent.traced, said, exit }
}

/// About how many seconds it takes to write a picture: measured on the rows in its middle.
fn to_write(film: &Film, clock: &Stopwatch) -> f64 {
    let region = film.frame.region;
    let height = region.height.div_ceil(ON_TRIAL);
    let y = region.y + (region.height - height) / 2;
    let began = clock.wall();
    let rows = film.clone().crop(Region { y, height, ..region });
    // What cannot be written is told when it is.
    drop(encode(&develop(&rows, Depth::Eight), Format::Png));
    FINER * (clock.wall() - began) * f64::from(region.height) / f64::from(height)
}

/// What was done: `one ray a pixel (--depth 5 …), then 4 samples in 20 % of the pixels, 16 in 7 %`.
fn made(spent: &Spent) -> String {
    let mut pixels_with = BTreeMap::new();
    for &samples in &spent.traced.film.samples {
        *pixels_with.entry(samples).or_insert(0) += 1;
    }
    let all = spent.traced.film.samples.len();
    let mut said = format!("one ray a pixel ({})", spent.first);
    let more: Vec<String> = pixels_with
        .iter()
        .filter(|&(&samples, _)| samples > 1)
        .map(|(samples, &pixels)| format!("{samples} in {}", share(pixels, all)))
        .collect();
    if !more.is_empty() {
        said += &format!(", then samples instead: {} of the pixels", more.join(", "));
    }
    if let Some(flags) = &spent.then {
        said += &format!("; {} of the pixels anew with {flags}", share(spent.refined, all));
    }
    said
}

fn share(part: usize, all: usize) -> String {
    match 100.0 * part as f64 / all.max(1) as f64 {
        percent if percent > 0.0 && percent < 1.0 => format!("{percent:.2} %"),
        percent => format!("{percent:.0} %"),
    }
}

/// `error 0.0088 [0.0081, 0.0096]`, and what the reference did not look at.
fn error(audit: &Audit) -> String {
    let amount = |error: f64| table::amount(audit.metric, error);
    // Below what the reference resolves nothing is known but that it lies there.
    let error = match audit.error.value < audit.resolution {
        true => {
            let most = amount(audit.resolution.max(audit.error.high));
            format!("< {most} [0, {most}]")
        }
        false => {
            let [value, low, high] =
                [audit.error.value, audit.error.low, audit.error.high].map(amount);
            format!("{value} [{low}, {high}]")
        }
    };
    let depth = match audit.depth {
        Some(depth) => format!(" against a reference only {depth} surfaces deep"),
        None => String::new(),
    };
    format!("error {error}{depth}")
}
