//! `render --max-error` and `render --time-budget`: a picture and what was promised of it.

use std::io::IsTerminal;
use std::sync::Mutex;

use lucarne::accuracy::{self, Audit, Clock, KNOBS, Options, Step, TooSmall, table};
use lucarne::film::Depth;
use lucarne::picture::Format;
use lucarne::plan::{Frame, PlanOptions, plan};
use lucarne::trace::{TraceOptions, Traced, Watch, trace};
use lucarne::world::{Origins, World};

use super::arguments::RenderArguments;
use super::budget::spend;
use super::exit::{Exit, Failure};
use super::messages;
use super::progress::Progress;
use super::stats::Stopwatch;

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
    let told = Told::new(progress, clock, "choosing settings");
    let tell = |step: Step| {
        let (name, note) = match &step {
            Step::Choosing => {
                ("choosing settings", Some("choosing settings on a few pixels".to_owned()))
            }
            Step::Learning { pixels, samples, seconds } => {
                let takes = format!(
                    "finding out what {pixels} pixels look like, by {samples} samples of each, takes about {}",
                    duration(*seconds)
                );
                ("finding out", (*seconds >= WORTH_TELLING).then_some(takes))
            }
            Step::Trying { knob, seconds } => {
                let takes = format!(
                    "trying settings of {knob} on them takes at most about {}",
                    duration(*seconds)
                );
                ("trying settings", (*seconds >= WORTH_TELLING).then_some(takes))
            }
            Step::Unreachable { error, resolution } => {
                let amount = |error| table::amount(options.metric, error);
                let best = match error.value < *resolution {
                    true => format!("below {}", amount(resolution.max(error.high))),
                    false => format!("about {}", amount(error.value)),
                };
                let note = format!(
                    "no settings are known to keep {}; the best that can be reached here is {best}: rendering that",
                    amount(promise)
                );
                ("choosing settings", Some(note))
            }
            Step::Rendering { flags, seconds, audit } => {
                let audit = match *audit >= WORTH_TELLING {
                    true => format!(", and to find out the error {}", duration(*audit)),
                    false => String::new(),
                };
                let seconds = duration(*seconds);
                let note =
                    format!("rendering with {flags}\nnote: that takes about {seconds}{audit}");
                ("rendering", Some(note))
            }
            Step::Refining(audit) => {
                let note = format!("{}: not proven, choosing better settings", error(audit));
                ("choosing settings", Some(note))
            }
        };
        told.now.lock().iter_mut().for_each(|now| **now = Now::new(name, clock));
        note.iter().for_each(|note| progress.say(&format!("note: {note}\n")));
    };
    let kept = accuracy::keep(world, origins, options, promise, clock, (&told, &tell));
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
    let refined = if kept.refined { ", in the second picture" } else { "" };
    let better = match (proven, audit.depth, kept.is_dearest) {
        (true, ..) => "",
        (false, Some(_), _) => "; what lies deeper took too long to look at",
        (false, None, true) => {
            "; these are the finest settings it tries: `--antialias 64` is finer, and `--time-budget` \
             comes as near sooner"
        }
        (false, None, false) => "; no settings are known to be better",
    };
    let said = format!(
        "{} {sign} {amount}, on {} fresh pixels{refined}{better}\nthe same picture: {}\n",
        error(&audit),
        audit.pixels,
        kept.flags
    );
    Ok(Made { traced: kept.traced, said, exit: if proven { Exit::Done } else { Exit::Promise } })
}

/// `8 s`, `3 min`: as well as a forecast knows it.
fn duration(seconds: f64) -> String {
    match seconds {
        5400.0.. => format!("{:.1} h", seconds / 3600.0),
        90.0.. => format!("{:.0} min", seconds / 60.0),
        10.0.. => format!("{seconds:.0} s"),
        _ => format!("{seconds:.1} s"),
    }
}

/// Where no bar can be seen, a line now and then says how far it has come.
pub(super) struct Told<'a> {
    progress: &'a Progress,
    clock: &'a Stopwatch,
    now: Mutex<Now>,
}

/// What is being done.
struct Now {
    name: &'static str,
    /// When it was begun, and when the last line was written.
    began: f64,
    last: f64,
}

impl Now {
    fn new(name: &'static str, clock: &Stopwatch) -> Self {
        let began = clock.wall();
        Self { name, began, last: began }
    }
}

/// Seconds that one wants to be told of beforehand.
const WORTH_TELLING: f64 = 5.0;
/// Seconds from one line to the next.
const NOW_AND_THEN: f64 = 10.0;

impl<'a> Told<'a> {
    pub(super) fn new(progress: &'a Progress, clock: &'a Stopwatch, name: &'static str) -> Self {
        Self { progress, clock, now: Mutex::new(Now::new(name, clock)) }
    }
}

impl Watch for Told<'_> {
    fn progress(&self, done: usize, total: usize) {
        self.progress.progress(done, total);
        if std::io::stderr().is_terminal() {
            return;
        }
        // Whoever comes while a line is written has nothing new to say.
        let Ok(mut now) = self.now.try_lock() else { return };
        let time = self.clock.wall();
        if time - now.last >= NOW_AND_THEN {
            now.last = time;
            let percent = 100 * done / total.max(1);
            let passed = duration(time - now.began);
            messages::eprint(&format!("note: {}: {percent} % after {passed}\n", now.name));
        }
    }

    fn built(&self) {
        self.progress.built();
    }

    fn should_stop(&self) -> bool {
        self.progress.should_stop()
    }
}

/// `error 0.0088 [0.0081, 0.0096]`, and what the reference did not look at.
pub(super) fn error(audit: &Audit) -> String {
    let amount = |error: f64| table::amount(audit.metric, error);
    // Below what the reference resolves nothing is known but that it lies there.
    let error = match audit.error.value < audit.resolution {
        true => {
            let most = amount(audit.resolution.max(audit.error.high));
            format!("< {most} (it could not be told better than that)")
        }
        false => {
            let [value, low, high] =
                [audit.error.value, audit.error.low, audit.error.high].map(amount);
            format!("{value} [{low}, {high}]")
        }
    };
    let depth = match audit.depth {
        Some(1) => " against a reference only 1 surface deep".to_owned(),
        Some(depth) => format!(" against a reference only {depth} surfaces deep"),
        None => String::new(),
    };
    format!("error {error}{depth}")
}
