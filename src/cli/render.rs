//! `lucarne render`: renders a scene file to a picture file.

use std::num::NonZero;
use std::thread::available_parallelism;

use lucarne::accuracy;
use lucarne::film::{Channels, Developer, Film};
use lucarne::picture;
use lucarne::plan::{PlanOptions, Region};
use lucarne::road::Road;
use lucarne::trace::TraceOptions;

use super::arguments::RenderArguments;
use super::exit::{Exit, Failure, Outcome};
use super::files;
use super::messages;
use super::output::{Output, Picture};
use super::progress::{self, Progress};
use super::promise::{self, Made};
use super::stats::{Stats, Stopwatch, peak_rss_bytes};
use super::text::{name_of, read_scene};

pub fn run(arguments: &RenderArguments) -> Outcome {
    let mut watch = Stopwatch::start();
    let mut stats = Stats::default();
    let output = Output::from_arguments(&arguments.file, arguments.output.as_deref())?;
    let format = output.format();
    let depth = format.depth(arguments.bits).ok_or_else(|| {
        let bits = arguments.bits.unwrap_or_default();
        let name = format.extensions()[0];
        Failure::usage(format!("a .{name} picture cannot have {bits} bits a channel"))
            .help("`--bits` may be 8 (png, jpg, ppm, qoi, tga, bmp) or 16 (png, ppm)")
    })?;
    if arguments.alpha && !format.holds_alpha() {
        let name = format.extensions()[0];
        return Err(Failure::usage(format!("a .{name} picture cannot have an alpha channel"))
            .help("with `--alpha`, write a .png, .qoi, .tga, .bmp or .exr"));
    }
    let frame = arguments.picture.frame(&arguments.scene)?;
    let bytes = read_scene(&arguments.file)?;
    output.check(frame.region, depth, arguments.force)?;
    let channels = Channels::with(arguments.alpha);
    fits(frame.region, format.bytes_per_pixel(channels), arguments.time_budget.is_some())?;

    let dialect = arguments.scene.dialect(&arguments.file, &bytes);
    let life = progress::life("reading the scene");
    let files = files::of(&arguments.file, &arguments.scene);
    let options = arguments.scene.options(dialect, Some(frame));
    let mut road = Road::new(&files, options);
    watch.lap();
    let file = road.read(&name_of(&arguments.file), bytes);
    let ast = road.parse(file);
    stats.parse_cpu_s = watch.lap();
    let scene = road.evaluate(ast);
    stats.evaluate_cpu_s = watch.lap();
    let (world, origins) = road.lower(scene);
    stats.lower_cpu_s = watch.lap();

    let mut messages = arguments.scene.messages();
    messages.picture_on_stdout = output == Output::Stdout;
    messages.print(road.diagnostics.in_text_order().into_iter(), &road.sources)?;
    messages.summarize();
    files::settle(&files, messages.exit() == Exit::Done)?;
    match messages.exit() {
        Exit::Done => {}
        other => return Ok(other),
    }
    output.keeps(&road.sources)?;

    let picture = &arguments.picture;
    let options = PlanOptions { alpha: arguments.alpha, ..picture.options(frame) };
    watch.lap();
    drop(life);
    let progress = Progress::start("rendering");
    let threads = arguments.threads.map(|wanted| usize::from(wanted).min(most_threads()));
    let threads = TraceOptions { threads, count_work: arguments.stats.is_some(), tile_side: None };
    let (scene, written) = ((&world, &origins), (depth, format));
    let made = promise::make(arguments, scene, &options, threads, written, (&watch, &progress));
    progress.end();
    let Made { traced, said, exit } = made?;
    stats.build_cpu_s = progress.build_cpu_seconds();
    stats.trace_cpu_s = (watch.lap() - stats.build_cpu_s).max(0.0);

    let film = &traced.film;
    let pixels = film.pixels.len();
    let done = film.samples().filter(|samples| *samples > 0).count();
    let written = match traced.complete {
        true => Some(output.clone()),
        false if done == 0 && exit == Exit::Interrupted => None,
        // Standard output gets a picture that ran out of time, but not an interrupted one.
        false => output.partial().or_else(|| (exit == Exit::Limit).then(|| output.clone())),
    };
    if let Some(place) = &written {
        let developer = Developer::new(depth, film.assumed_gamma, pixels);
        let picture: Picture = &|out| picture::write(film, &developer, format, out);
        place.write(picture).map_err(|failure| output.rescue(place, picture, failure))?;
    }
    stats.encode_cpu_s = watch.lap();
    stats.wall_s = watch.wall_seconds();
    stats.peak_rss_bytes = peak_rss_bytes();
    (stats.objects, stats.lights) = (world.objects.len(), world.lights.len());
    stats.count(&traced.counters);

    if !traced.complete && exit == Exit::Interrupted {
        messages::eprint(&match written {
            Some(place) => {
                let what = match 100 * done / pixels.max(1) {
                    100 => "one ray of each pixel, and a part of the smooth edges, are".to_owned(),
                    share => format!("the {share} % that are done are"),
                };
                format!("interrupted: {what} in {}\n", place.name())
            }
            None => "interrupted: nothing was written\n".to_owned(),
        });
        return Ok(Exit::Interrupted);
    }
    let count = |n: usize, what: &str| format!("{n} {what}{}", if n == 1 { "" } else { "s" });
    messages::eprint(&format!(
        "{}: {}×{}, {}, {}, {:.2} s\n{said}",
        written.as_ref().unwrap_or(&output).name(),
        frame.region.width,
        frame.region.height,
        count(stats.objects, "object"),
        count(stats.lights, "light"),
        stats.wall_s
    ));
    if arguments.alpha && film.pixels.iter().all(|pixel| pixel.opacity() == 1.0) {
        messages::eprint(
            "note: every pixel is opaque; `background` and `sky_sphere` are, unless their colours `transmit`\n",
        );
    }
    if let Some(format) = arguments.stats {
        stats.print(format, output == Output::Stdout)?;
    }
    Ok(exit)
}

/// Fails if there is clearly too little memory for the picture; a failed allocation would abort the program.
fn fits(part: Region, writing: u64, refined: bool) -> Result<(), Failure> {
    let pixels = u64::from(part.width) * u64::from(part.height);
    let refining = if refined { accuracy::BYTES_PER_PIXEL } else { 0 };
    let a_pixel = Film::BYTES_PER_PIXEL + refining.max(writing);
    let bytes = pixels.saturating_mul(a_pixel);
    let reserved =
        usize::try_from(bytes).is_ok_and(|bytes| Vec::<u8>::new().try_reserve_exact(bytes).is_ok());
    match reserved {
        true => Ok(()),
        false => Err(Failure::limit(format!(
            "a picture of {pixels} pixels takes about {:.1} GiB of memory, which cannot be had",
            bytes as f64 / f64::from(1 << 30)
        ))
        .help(
            "`--region` renders a part; `--limit pixels=N` refuses pictures of more than N pixels",
        )),
    }
}

/// Largest useful number of threads; more only add startup cost, as the picture does not depend on it.
fn most_threads() -> usize {
    4 * available_parallelism().map_or(1, NonZero::get)
}
