//! `render --max-error` and `render --time-budget`: renders a picture and reports whether the promise was
//! kept.

use lucarne::accuracy::{self, Audit, KNOBS, Knob, Metric, Options, Step, TooSmall, share, table};
use lucarne::film::{Channels, Depth, Film};
use lucarne::picture::Format;
use lucarne::plan::{Frame, PlanOptions, plan};
use lucarne::trace::{TraceOptions, Traced, Watch, geometry, trace_on};
use lucarne::world::{Origins, World};

use super::arguments::RenderArguments;
use super::budget::spend;
use super::exit::{Exit, Failure};
use super::heartbeat::duration;
use super::progress::Progress;
use super::stats::Stopwatch;

/// A picture and the report on it.
pub struct Made {
    pub traced: Traced,
    /// Report for people; empty if nothing was promised.
    pub said: String,
    /// Exit code of the program once the picture is written.
    pub exit: Exit,
}

/// Renders the picture as requested on the command line.
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
        alpha: arguments.alpha,
        trace: trace_options,
    };
    if let Some(promise) = arguments.max_error {
        return keep(world, origins, &options, promise, clock, progress);
    }
    if let Some(seconds) = arguments.time_budget {
        // Excludes knobs that change the solids themselves.
        let knobs: Vec<Knob> =
            KNOBS.iter().filter(|knob| !knob.changes_solids()).copied().collect();
        let options = Options { knobs: &knobs, ..options };
        return Ok(spend((world, origins), &options, seconds, written, clock, progress));
    }
    Ok(plainly((world, origins), plain, &trace_options, progress, Vec::new()))
}

/// Renders the picture with these options, from what was begun of it.
pub fn plainly(
    (world, origins): (&World, &Origins),
    options: &PlanOptions,
    trace_options: &TraceOptions,
    watch: &dyn Watch,
    begun: Vec<Film>,
) -> Made {
    let plan = plan(world, origins, options);
    let geometry = geometry(world, &plan, trace_options);
    let traced = trace_on(world, &geometry, &plan, trace_options, watch, begun);
    let exit = if traced.complete { Exit::Done } else { Exit::Interrupted };
    Made { traced, said: String::new(), exit }
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
        return Ok(interrupted(Traced::unbegun(
            options.frame,
            gamma,
            Channels::with(options.alpha),
        )));
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
    let own = world.settings.max_trace_level;
    if audit.depth.is_some_and(|depth| depth < own) {
        // An error measured against a shallower reference would be too small.
        let surfaces = if own == 1 { "surface" } else { "surfaces" };
        let said = format!(
            "warning: how far off it is is not known: it takes too long to look {own} {surfaces} deep, as the scene does\nthe same picture: {flags}\n"
        );
        return Ok(Made { traced: kept.traced, said, exit: Exit::Promise });
    }
    let said = format!(
        "{} {sign} {amount}, on {} fresh pixels{refined}{better}\n{}the same picture: {flags}\n",
        error(&audit),
        audit.pixels,
        glare(world)
    );
    Ok(Made { traced: kept.traced, said, exit: if proven { Exit::Done } else { Exit::Promise } })
}

/// Returns a note if lights are so bright that sampling cannot bound the error; otherwise an empty string.
pub(super) fn glare(world: &World) -> String {
    accuracy::glare(world).map_or_else(String::new, |whites| {
        let whites: f64 = format!("{whites:.1e}").parse().unwrap_or(whites);
        format!(
            "note: light here is up to {whites} times white: where less of a pixel than a sample has shows it, \
             the error does not tell\n"
        )
    })
}

/// Name of a step, for the progress display.
fn name(step: &Step) -> &'static str {
    match step {
        Step::Choosing | Step::Unreachable { .. } | Step::Refining(_) => "choosing settings",
        Step::Learning { .. } => "finding out what pixels look like",
        Step::Trying { .. } => "trying settings",
        Step::Rendering { .. } => "rendering",
    }
}

/// Note to print on a step, if it takes long enough.
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
        Step::Unreachable { error, resolution, pixels }
            if error.value.max(*resolution) <= promise =>
        {
            Some(format!(
                "{pixels} pixels cannot prove {}: of the finest settings they say {} [{}, {}]; rendering those",
                amount(promise),
                amount(error.value),
                amount(error.low),
                amount(error.high)
            ))
        }
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
            let seconds = match *seconds {
                ..1.0 => "less than a second".to_owned(),
                seconds => format!("about {}", duration(seconds)),
            };
            Some(format!("rendering with {flags}\nnote: that takes {seconds}{audit}"))
        }
        Step::Refining(audit) => {
            Some(format!("{}: not proven, choosing better settings", error(audit)))
        }
    }
}

/// Errors below this are not reported.
const NOTHING: f64 = 1e-6;
/// Steps that take at least this many seconds are announced.
const WORTH_TELLING: f64 = 5.0;

/// Formats the error (`error 0.0088 [0.0081, 0.0096]`) and the limits of the reference.
pub(super) fn error(audit: &Audit) -> String {
    let amount = |error: f64| table::amount(audit.metric, error);
    // Below the resolution of the reference, only an upper bound is known.
    let error = match audit.error.value < audit.resolution {
        true => {
            let most = audit.resolution.max(audit.error.high);
            // Errors this small are rounding errors of the film.
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
        Some(1) => Some("one surface deep".to_owned()),
        Some(depth) => Some(format!("{depth} surfaces deep")),
        None => None,
    };
    let weight =
        audit.adc_bailout.map(|weight| format!("of rays that count {} and more", share(weight)));
    let cut: Vec<String> = depth.into_iter().chain(weight).collect();
    let against = match cut.as_slice() {
        [] => String::new(),
        cut => format!(" against a reference only {}", cut.join(" and ")),
    };
    format!("error {error}{against}")
}
