//! `lucarne accuracy`: measures the cost and the accuracy of each setting; prints a table, a diagram or
//! JSON.

use std::fs;
use std::num::NonZero;
use std::path::Path;
use std::thread::available_parallelism;

use lucarne::accuracy::json::{self, Host};
use lucarne::accuracy::table::Width;
use lucarne::accuracy::{
    Clock, KNOBS, Knob, LEAST_PIXELS, Options, Report, Unmeasured, accuracy, idle, svg, table,
};
use lucarne::plan::Frame;
use lucarne::road::Road;
use lucarne::trace::TraceOptions;

use super::arguments::AccuracyArguments;
use super::exit::{Exit, Failure, Outcome};
use super::files;
use super::heartbeat::duration;
use super::messages;
use super::output::{can_be_made, write_whole};
use super::progress::{self, Progress};
use super::stats::{Stopwatch, cpu_seconds};
use super::text::{name_of, read_scene};

impl Clock for Stopwatch {
    fn wall(&self) -> f64 {
        self.wall_seconds()
    }

    fn cpu(&self) -> f64 {
        cpu_seconds()
    }
}

pub fn run(arguments: &AccuracyArguments) -> Outcome {
    let clock = Stopwatch::start();
    let frame = arguments.frame.frame(&arguments.scene)?;
    let svg_path = arguments.svg.as_deref();
    if let Some(path) = svg_path.filter(|path| path.extension().is_none_or(|e| e != "svg")) {
        let sentence = format!("the diagram is an .svg, and `{}` is not", path.display());
        return Err(Failure::usage(sentence));
    }
    svg_path.map_or(Ok(()), can_be_made)?;
    let bytes = read_scene(&arguments.file)?;
    let dialect = arguments.scene.dialect(&arguments.file, &bytes);
    let life = progress::life("reading the scene");
    let files = files::of(&arguments.file, &arguments.scene);
    let mut road = Road::new(&files, arguments.scene.options(dialect, Some(frame)));
    let name = name_of(&arguments.file);
    let (world, origins) = road.compile(&name, bytes);
    let mut messages = arguments.scene.messages();
    // Standard output is reserved for the report.
    messages.picture_on_stdout = true;
    messages.print(road.diagnostics.in_text_order().into_iter(), &road.sources)?;
    messages.summarize();
    files::announce(&files, messages.exit() == Exit::Done)?;
    match messages.exit() {
        Exit::Done => {}
        other => return Ok(other),
    }

    let asked = |knob: &&Knob| arguments.knobs.is_empty() || arguments.knobs.contains(&knob.name);
    let knobs: Vec<Knob> = KNOBS.iter().filter(asked).copied().collect();
    let mut idle = idle(&world, &origins, frame, &knobs);
    if idle.len() == knobs.len() {
        match arguments.json {
            true => messages::print(&(json::nothing(&name, &idle) + "\n"))?,
            false => messages::print(&(idle.join(".\n") + ".\n"))?,
        }
        if let Some(path) = svg_path {
            messages::eprint(&format!(
                "{}: not written: there is nothing to draw\n",
                path.display()
            ));
        }
        return Ok(Exit::Done);
    }
    if arguments.knobs.is_empty() {
        // The user did not ask about specific knobs.
        idle.clear();
    }
    let cores = available_parallelism().map_or(1, NonZero::get);
    let threads = arguments.threads.map_or(cores, usize::from);
    let options = Options {
        frame,
        knobs: &knobs,
        metric: arguments.metric.into(),
        budget: (arguments.budget - clock.wall_seconds()).max(0.0),
        seed: arguments.seed,
        alpha: false,
        trace: TraceOptions::on_threads(threads),
    };
    let pixels = u64::from(frame.region.width) * u64::from(frame.region.height);
    if pixels < LEAST_PIXELS as u64 {
        let sentence = match pixels {
            1 => "1 pixel is too few to find an error by".to_owned(),
            _ => format!("{pixels} pixels are too few to find an error by"),
        };
        return Err(Failure::usage(sentence).help(format!("{LEAST_PIXELS} are the least")));
    }
    drop(life);
    let progress = Progress::start("measuring");
    let report = accuracy(&world, &origins, &options, &clock, &progress);
    progress.end();
    let report = match report {
        Ok(report) => Report { idle, ..report },
        Err(Unmeasured::Stopped) => {
            messages::eprint("interrupted: nothing was reported\n");
            return Ok(Exit::Interrupted);
        }
        Err(Unmeasured::TooShort { own, enough }) => {
            return Err(too_short(arguments.budget, (own, enough), frame));
        }
    };
    let host = host(cores, threads);
    let width = if arguments.wide { Width::Wide } else { Width::Narrow };
    match arguments.json {
        true => messages::print(&(json::line(&report, &name, &host) + "\n"))?,
        false => messages::print(&table::text(&report, &name, threads, width))?,
    }
    if let Some(path) = svg_path {
        write_whole(path, svg::text(&report, &short(&name), &host).as_bytes())?;
        messages::eprint(&format!("{}: the work-precision diagram\n", path.display()));
    }
    Ok(Exit::Done)
}

/// Returns the failure for a budget that does not fit the scene's own picture, with a budget that would.
fn too_short(budget: f64, (own, enough): (f64, f64), frame: Frame) -> Failure {
    let sentence = format!(
        "{budget} s are too few: the scene's own picture alone takes about {} or more; nothing was measured",
        duration(own)
    );
    let (part, side) = (frame.region, (budget / enough).sqrt());
    // The number of pixels scales with both sides.
    let smaller = |side_of: u32| (side * f64::from(side_of) / 8.0).floor() * 8.0;
    let (width, height) = (smaller(part.width), smaller(part.height));
    let is_whole = (part.width, part.height) == (frame.width, frame.height);
    let instead = match is_whole && width >= 16.0 && height >= 16.0 {
        true => format!("`--size {width}x{height}`"),
        false => "a smaller `--size`".to_owned(),
    };
    Failure::limit(sentence).help(format!("`--budget {}` is enough, or {instead}", round(enough)))
}

/// Rounds a duration up to a value that is short to type.
fn round(seconds: f64) -> String {
    match seconds {
        ..=1.0 => "1s".to_owned(),
        ..=10.0 => format!("{}s", seconds.ceil()),
        ..=90.0 => format!("{}s", 10.0 * (seconds / 10.0).ceil()),
        ..=5400.0 => format!("{}m", (seconds / 60.0).ceil()),
        _ => format!("{}h", (seconds / 3600.0).ceil()),
    }
}

fn short(file: &str) -> String {
    Path::new(file).file_name().unwrap_or_default().to_string_lossy().into_owned()
}

/// Describes the machine the timings were taken on.
fn host(cores: usize, threads: usize) -> Host {
    let about = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model = about.lines().find_map(|line| line.strip_prefix("model name")?.split_once(':'));
    Host {
        os: std::env::consts::OS.to_owned(),
        arch: std::env::consts::ARCH.to_owned(),
        cpu: model.map_or("unknown".to_owned(), |(_, model)| model.trim().to_owned()),
        cores,
        threads,
        version: env!("CARGO_PKG_VERSION").to_owned(),
    }
}
