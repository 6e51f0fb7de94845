//! `render --max-error` and `render --time-budget`: a picture and what was promised of it.

use std::collections::BTreeMap;
use std::thread::available_parallelism;

use lucarne::accuracy::{
    self, Audit, Clock, First, KNOBS, Metric, Options, Spent, Step, TooSmall, table,
};
use lucarne::film::{Depth, Film, develop};
use lucarne::picture::{Format, encode};
use lucarne::plan::{Frame, PlanOptions, Region, plan};
use lucarne::trace::{TraceOptions, Traced, trace};
use lucarne::world::{Origins, World};

use super::arguments::RenderArguments;
use super::exit::{Exit, Failure};
use super::life::duration;
use super::progress::Progress;
use super::stats::Stopwatch;

/// Seconds to encode and write a pixel of one colour in.
const LEAST_TO_WRITE: f64 = 2e-8;
/// Of a picture's rows one of so many is written on trial, in so many bands; and how much longer the final
/// picture, which is finer, may take.
const ON_TRIAL: u32 = 8;
const BANDS: u32 = 8;
const FINER: f64 = 1.2;
/// Seconds to stop and to end in, where each thread has a processor.
const TO_END: f64 = 0.01;
/// Of the time there is: the most that is kept for what else the machine does.
const FOR_OTHERS: f64 = 0.1;

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
    written: (Depth, Format),
    (clock, progress): (&Stopwatch, &Progress),
) -> Result<Made, Failure> {
    let options = Options {
        frame: plain.frame,
        knobs: KNOBS,
        metric: arguments.metric.into(),
        budget: 0.0,
        seed: arguments.seed,
        trace: trace_options,
    };
    if let Some(promise) = arguments.max_error {
        return keep(world, origins, &options, promise, clock, progress);
    }
    if let Some(seconds) = arguments.time_budget {
        return Ok(spend((world, origins), &options, seconds, written, clock, progress));
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
    clock: &Stopwatch,
    progress: &Progress,
) -> Result<Made, Failure> {
    let tell = |step: Step| {
        progress.next(name(&step));
        let note = note(&step, options.metric, promise);
        note.iter().for_each(|note| progress.say(&format!("note: {note}\n")));
    };
    let kept = accuracy::keep(world, origins, options, promise, clock, (progress, &tell));
    let kept = kept.map_err(|TooSmall| {
        let Frame { region, .. } = options.frame;
        let (width, height) = (region.width, region.height);
        Failure::usage(format!("{width}×{height} pixels are too few to prove an error by"))
            .help("`--max-error` needs about 16×16")
    })?;
    let interrupted = |traced| Made { traced, said: String::new(), exit: Exit::Interrupted };
    let Some(kept) = kept else {
        let gamma = world.settings.assumed_gamma;
        return Ok(interrupted(Traced::unbegun(options.frame, gamma)));
    };
    let Some(audit) = kept.audit else { return Ok(interrupted(kept.traced)) };
    let proven = audit.proves(promise);
    let may_be = audit.error.value <= promise || audit.error.value < audit.resolution;
    let sign = match (proven, may_be) {
        (true, _) => "≤",
        (false, true) => "is not proven to be ≤",
        (false, false) => ">",
    };
    let amount = table::amount(audit.metric, promise);
    let refined = if kept.refined { ", in the second picture" } else { "" };
    let better = match (proven, audit.depth, kept.is_dearest) {
        (true, ..) => "",
        (false, Some(_), _) => "; what lies deeper took too long to look at",
        (false, None, _) if audit.resolution > promise => {
            "; the pixels are so noisy that not even their reference tells so small an error"
        }
        (false, None, true) if audit.error.value <= promise => {
            "; so few pixels prove no less: a larger `--size` has more"
        }
        (false, None, true) => {
            "; these are the finest settings it tries: `--antialias 64` is finer, and `--time-budget` \
             comes as near sooner"
        }
        (false, None, false) => "; no settings are known to be better",
    };
    let flags = match kept.flags.as_str() {
        "" => "any settings make it",
        flags => flags,
    };
    let said = format!(
        "{} {sign} {amount}, on {} fresh pixels{refined}{better}\nthe same picture: {flags}\n",
        error(&audit),
        audit.pixels
    );
    Ok(Made { traced: kept.traced, said, exit: if proven { Exit::Done } else { Exit::Promise } })
}

/// What is being done.
fn name(step: &Step) -> &'static str {
    match step {
        Step::Choosing | Step::Unreachable { .. } | Step::Refining(_) => "choosing settings",
        Step::Learning { .. } => "finding out what pixels look like",
        Step::Trying { .. } => "trying settings",
        Step::Rendering { .. } => "rendering",
    }
}

/// What is said of it; nothing of what takes no time.
fn note(step: &Step, metric: Metric, promise: f64) -> Option<String> {
    let amount = |error| table::amount(metric, error);
    match step {
        Step::Choosing => Some("choosing settings on a few pixels".to_owned()),
        Step::Learning { seconds, .. } | Step::Trying { seconds, .. }
            if *seconds < WORTH_TELLING =>
        {
            None
        }
        Step::Learning { pixels, samples, seconds } => Some(format!(
            "finding out what {pixels} pixels look like, by {samples} samples of each, takes about {}",
            duration(*seconds)
        )),
        Step::Trying { knob, seconds } => Some(format!(
            "trying settings of {knob} on them, cheap ones first; all of them would take about {}",
            duration(*seconds)
        )),
        Step::Unreachable { error, pixels, .. } if error.value <= promise => Some(format!(
            "{pixels} pixels cannot prove {}: of the finest settings they say {} [{}, {}]; rendering those",
            amount(promise),
            amount(error.value),
            amount(error.low),
            amount(error.high)
        )),
        Step::Unreachable { error, resolution, .. } => {
            let best = match error.value < *resolution {
                true => format!("below {}", amount(resolution.max(error.high))),
                false => format!("about {}", amount(error.value)),
            };
            Some(format!(
                "no settings are known to keep {}; the best that can be reached here is {best}: rendering that",
                amount(promise)
            ))
        }
        Step::Rendering { flags, seconds, audit } => {
            let audit = match *audit >= WORTH_TELLING {
                true => format!(", and to find out the error {}", duration(*audit)),
                false => String::new(),
            };
            let flags = match flags.as_str() {
                "" => "any settings",
                flags => flags,
            };
            let seconds = duration(*seconds);
            Some(format!("rendering with {flags}\nnote: that takes about {seconds}{audit}"))
        }
        Step::Refining(audit) => {
            Some(format!("{}: not proven, choosing better settings", error(audit)))
        }
    }
}

/// An error that nobody asks about.
const NOTHING: f64 = 1e-9;
/// Seconds that one wants to be told of beforehand.
const WORTH_TELLING: f64 = 5.0;

fn spend(
    (world, origins): (&World, &Origins),
    options: &Options,
    seconds: f64,
    written: (Depth, Format),
    clock: &Stopwatch,
    progress: &Progress,
) -> Made {
    let region = options.frame.region;
    let pixels = f64::from(region.width) * f64::from(region.height);
    let threads = options.trace.threads.or_else(|| Some(available_parallelism().ok()?.get()));
    // What it takes to write is known once there is something to write; and how busy the machine is,
    // once something was traced.
    let until = |first: Option<First>| {
        let to_end = first.map_or(LEAST_TO_WRITE * pixels, |First { film, processors }| {
            let busy = threads.map_or(1.0, |threads| threads as f64 / processors);
            let alone = to_write(film, written, clock) + TO_END;
            alone + (alone * (busy - 1.0)).clamp(0.0, FOR_OTHERS * seconds)
        });
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
            let with = match spent.is_less || spent.rest > 0 {
                true => format!(", even with {}", spent.least),
                false => String::new(),
            };
            format!(
                "{seconds} s are too few for one ray a pixel{with}: {share} % of them are done\n"
            )
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

/// About how many seconds of one processor it takes to write a picture: measured on some of its rows,
/// from top to bottom.
fn to_write(film: &Film, (depth, format): (Depth, Format), clock: &Stopwatch) -> f64 {
    let Region { width, height, .. } = film.frame.region;
    let row = width as usize;
    let high = (height / (BANDS * ON_TRIAL)).max(1);
    let mut some = Film { radiance: Vec::new(), samples: Vec::new(), ..*film };
    for band in 0..BANDS.min(height) {
        let top = (height - high) / BANDS.min(height) * band;
        let rows = row * top as usize..row * (top + high) as usize;
        some.radiance.extend(&film.radiance[rows.clone()]);
        some.samples.extend(&film.samples[rows]);
    }
    some.frame.region.height = BANDS.min(height) * high;
    let part = f64::from(some.frame.region.height) / f64::from(height);
    let began = clock.cpu();
    // What cannot be written is told when it is.
    drop(encode(&develop(&some, depth), format));
    FINER * (clock.cpu() - began) / part
}

/// What was done: `one ray a pixel (--depth 5 …), then 4 samples in 20 % of the pixels, 16 in 7 %`.
fn made(spent: &Spent) -> String {
    let mut pixels_with = BTreeMap::new();
    for &samples in &spent.traced.film.samples {
        *pixels_with.entry(samples).or_insert(0) += 1;
    }
    let all = spent.traced.film.samples.len();
    let less = if spent.is_less { ": more would not fit" } else { "" };
    let rest = match spent.rest {
        0 => String::new(),
        rest => format!("; {} of the pixels with {}", share(rest, all), spent.least),
    };
    let mut said = format!("one ray a pixel ({}{less}{rest})", spent.first);
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
    if spent.is_finest {
        said += "; that is the most there is, and more time changes nothing";
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
            let most = audit.resolution.max(audit.error.high);
            // Sums are rounded by as much.
            let why = match most {
                ..=NOTHING => "",
                _ => " (it could not be told better than that)",
            };
            format!("< {}{why}", amount(most))
        }
        false => {
            let [value, low, high] =
                [audit.error.value, audit.error.low, audit.error.high].map(amount);
            format!("{value} [{low}, {high}]")
        }
    };
    let depth = match audit.depth {
        Some(1) => " against a reference only one surface deep".to_owned(),
        Some(depth) => format!(" against a reference only {depth} surfaces deep"),
        None => String::new(),
    };
    format!("error {error}{depth}")
}
