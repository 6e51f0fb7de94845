//! `lucarne render`: renders a scene file to a picture file.

use std::collections::BTreeSet;
use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::thread::available_parallelism;

use lucarne::accuracy;
use lucarne::disk::DiskFiles;
use lucarne::evaluate::{Animation, EvaluateOptions, Interrupt};
use lucarne::film::saved::{Purpose, Saved, save};
use lucarne::film::{Channel, Channels, Depth, Developer, Film, Surfaces};
use lucarne::picture::{self, Format};
use lucarne::plan::{self, PlanOptions, Region};
use lucarne::road::Road;
use lucarne::source::Files;
use lucarne::trace::{TraceOptions, Traced, first_surfaces};

use super::arguments::{RenderArguments, Shard};
use super::checkpoint::{self, Begun, Checkpoint};
use super::exit::{Exit, Failure, Outcome};
use super::files::{self, Recorded};
use super::messages::{self, Messages};
use super::output::{Output, Picture, depth_of, write_whole, write_with};
use super::progress::{self, Progress};
use super::promise::{self, Made};
use super::stats::{Stats, Stopwatch, peak_rss_bytes};
use super::stop::{self, Cause};
use super::text::{name_of, read_scene};

pub fn run(arguments: &RenderArguments) -> Outcome {
    let output = Output::from_arguments(&arguments.file, arguments.output.as_deref())?;
    if arguments.work.shard.is_some() && output == Output::Stdout {
        return Err(Failure::usage("a part cannot be written to standard output"));
    }
    let scene = read_scene(&arguments.file)?;
    let disk = files::of(&arguments.file, &arguments.scene);
    let messages = arguments.scene.messages();
    let mut shared = Shared { scene: &scene, disk: &disk, files: &disk, messages };
    picture(arguments, &output, &mut shared, None)
}

/// What the frames of an animation share, and a still has alone.
pub struct Shared<'a> {
    pub scene: &'a [u8],
    pub disk: &'a DiskFiles,
    /// Reads from `disk`, possibly once for all frames.
    pub files: &'a dyn Files,
    pub messages: Messages,
}

/// A frame of an animation, and its clock.
pub type Frame = (Animation, f64);

/// Renders one picture to its place: a still, or a frame.
pub fn picture(
    arguments: &RenderArguments,
    output: &Output,
    shared: &mut Shared,
    frame: Option<Frame>,
) -> Outcome {
    let mut job = Job::new(arguments, output.format())?;
    output.check(job.frame.region, job.depth, arguments.force)?;
    job.fits(arguments)?;
    let Made { traced, said, exit } = match job.make(arguments, output, shared, frame)? {
        Ok(made) => made,
        Err(exit) => return Ok(exit),
    };
    if let Some(part) = job.part(arguments, output) {
        return job.write_part(&part, traced);
    }
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
        let developer = Developer::new(job.depth, film.assumed_gamma, pixels);
        let picture: Picture = &|out| match &job.surfaces {
            Some(surfaces) => picture::write_with_surfaces(film, surfaces, &developer, out),
            None => picture::write(film, &developer, output.format(), out),
        };
        place.write(picture).map_err(|failure| output.rescue(place, picture, failure))?;
    }
    if traced.complete
        && let Some(path) = job.checkpoint(arguments, output)
    {
        checkpoint::remove(&path)?;
    }
    job.stats.encode_cpu_s = job.watch.lap();
    job.stats.wall_s = job.watch.wall_seconds();
    job.stats.peak_rss_bytes = peak_rss_bytes();
    job.stats.count(&traced.counters);

    if !traced.complete && exit == Exit::Interrupted {
        let what = match (written, 100 * done / pixels.max(1)) {
            (None, _) => "nothing was written".to_owned(),
            (Some(place), 100) => {
                format!(
                    "one ray of each pixel, and a part of the smooth edges, are in {}",
                    place.name()
                )
            }
            (Some(place), share) => format!("the {share} % that are done are in {}", place.name()),
        };
        return Ok(job.stopped(&what));
    }
    let Job { stats, frame, .. } = &job;
    let count = |n: usize, what: &str| format!("{n} {what}{}", if n == 1 { "" } else { "s" });
    messages::eprint(&format!(
        "{}: {}×{}, {}, {}, {:.2} s\n{said}",
        written.as_ref().unwrap_or(output).name(),
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
        stats.print(format, *output == Output::Stdout)?;
    }
    Ok(exit)
}

/// What is known of a picture before it is rendered, and what it took.
pub struct Job {
    pub frame: plan::Frame,
    /// The region that the parts cover.
    whole: Region,
    /// Differs for other scenes and options, once the scene is compiled.
    key: u64,
    pub depth: Depth,
    /// Whether there is a checkpoint of what is done.
    is_kept: bool,
    format: Format,
    /// Once they are found, if the picture has them.
    surfaces: Option<Surfaces>,
    stats: Stats,
    watch: Stopwatch,
}

impl Job {
    /// Reads the scene, and fails for what is known to be impossible.
    pub fn new(arguments: &RenderArguments, format: Format) -> Result<Self, Failure> {
        let watch = Stopwatch::start();
        let depth = depth_of(format, arguments.bits, arguments.alpha)?;
        arguments.fits_channels(format)?;
        let mut frame = arguments.picture.frame(&arguments.scene)?;
        let whole = frame.region;
        if let Some(shard) = arguments.still_shard() {
            frame.region = shard.of(whole)?;
        }
        Ok(Self {
            frame,
            whole,
            key: 0,
            depth,
            is_kept: false,
            format,
            surfaces: None,
            stats: Stats::default(),
            watch,
        })
    }

    /// Fails if there is clearly too little memory.
    pub fn fits(&self, arguments: &RenderArguments) -> Result<(), Failure> {
        let writing = self.format.bytes_per_pixel(Channels::with(arguments.alpha));
        let surfaces = if arguments.channels.is_empty() { 0 } else { Surfaces::BYTES_PER_PIXEL };
        fits(self.frame.region, writing + surfaces, arguments.time_budget.is_some())
    }

    /// Compiles and traces the scene; returns the exit code instead if its messages forbid that.
    pub fn make(
        &mut self,
        arguments: &RenderArguments,
        output: &Output,
        shared: &mut Shared,
        frame: Option<Frame>,
    ) -> Result<Result<Made, Exit>, Failure> {
        let &mut Shared { scene: bytes, disk, files, ref mut messages } = shared;
        let place = self.checkpoint(arguments, output);
        let Self { stats, watch, .. } = self;
        let dialect = arguments.scene.dialect(&arguments.file, bytes);
        let life = progress::life("reading the scene");
        let read = Recorded::new(files);
        let mut options = arguments.scene.options(dialect, Some(self.frame));
        if let Some((animation, clock)) = frame {
            options.evaluate.animation = Some(animation);
            options.evaluate.clock = clock;
        }
        let now = options.evaluate.now;
        // Neither changes a picture, but for `now` where the scene asks for it.
        let interrupt = Interrupt::default();
        let decided = EvaluateOptions { now: 0.0, interrupt, ..options.evaluate.clone() };
        let mut road = Road::new(&read, options);
        watch.lap();
        let file = road.read(&name_of(&arguments.file), bytes.to_vec());
        let ast = road.parse(file);
        stats.parse_cpu_s = watch.lap();
        let scene = road.evaluate(ast);
        stats.evaluate_cpu_s = watch.lap();
        let (world, origins) = road.lower(scene);
        stats.lower_cpu_s = watch.lap();

        messages.picture_on_stdout = *output == Output::Stdout;
        messages.print(road.diagnostics.in_text_order().into_iter(), &road.sources)?;
        messages.summarize();
        files::settle(disk, messages.exit() == Exit::Done)?;
        if let Some(rule) = &arguments.deps {
            let names = [output.name(), name_of(&arguments.file).into_owned()];
            write_whole(rule, rule_for_make(&names, &read.names()).as_bytes())?;
        }
        match messages.exit() {
            Exit::Done => {}
            other => {
                if let Some(cause @ (Cause::Time(_) | Cause::Memory(_))) = stop::cause() {
                    messages::eprint(&format!("error: {cause}: the scene was being read\n"));
                }
                return Ok(Err(other));
            }
        }
        output.keeps(&road.sources, &read.names())?;

        let options = arguments.picture.options(self.frame);
        let options = PlanOptions { alpha: arguments.alpha, ..options };
        let whole = plan::Frame { region: self.whole, ..self.frame };
        self.key = checkpoint::key(|digest| {
            digest.add(bytes);
            read.add_to(digest);
            let asked = PlanOptions { frame: whole, ..options };
            digest.add(format!("{decided:?} {asked:?}").as_bytes());
            if road.sources.iter().any(|(_, source)| has_word(&source.text, "now")) {
                digest.add(&now.to_bits().to_le_bytes());
            }
        });
        watch.lap();
        drop(life);
        let progress = Progress::start("rendering");
        let threads = arguments.threads.map(|wanted| usize::from(wanted).min(most_threads()));
        let threads =
            TraceOptions { threads, count_work: arguments.stats.is_some(), tile_side: None };
        let written = (self.depth, self.format);
        let scene = (&world, &origins);
        if !arguments.channels.is_empty() {
            let channels: Vec<Channel> = arguments.channels.iter().map(|&one| one.into()).collect();
            let plan = plan::plan(&world, &origins, &options);
            self.surfaces = first_surfaces(scene, &plan, &channels, &threads, &progress);
        }
        let made = match &place {
            Some(path) => {
                let begun = match arguments.work.resume {
                    true => checkpoint::resumed(path, self.key)?,
                    false => Begun::default(),
                };
                let (films, of) = (begun.films.clone(), (self.key, self.whole));
                let when = (arguments.work.checkpoint(), arguments.work.is_limited());
                let saving = Checkpoint::new(&progress, path.clone(), of, when, begun);
                let made = promise::plainly(scene, &options, &threads, &saving, films);
                if !made.traced.complete {
                    saving.save();
                }
                self.is_kept = saving.is_kept();
                Ok(made)
            }
            None => promise::make(arguments, scene, &options, threads, written, (watch, &progress)),
        };
        progress.end();
        stats.build_cpu_s = progress.build_cpu_seconds();
        stats.trace_cpu_s = (watch.lap() - stats.build_cpu_s).max(0.0);
        (stats.objects, stats.lights) = (world.objects.len(), world.lights.len());
        made.map(Ok)
    }

    /// Returns where the part goes that this process renders, if it is one.
    fn part(&self, arguments: &RenderArguments, output: &Output) -> Option<PathBuf> {
        let Shard { number, all } = arguments.still_shard()?;
        let path = output.path().map_or("picture".into(), Path::to_owned);
        Some(path.with_extension(format!("{number}-of-{all}.part")))
    }

    /// Returns where the picture or part is saved now and then, unless it has a promise to keep.
    fn checkpoint(&self, arguments: &RenderArguments, output: &Output) -> Option<PathBuf> {
        let is_promised = arguments.max_error.is_some() || arguments.time_budget.is_some();
        let is_frame = arguments.animation.range().is_some();
        let path = self.part(arguments, output).or(output.path().map(Path::to_owned));
        path.filter(|_| !is_promised && !is_frame).map(|path| checkpoint::beside(&path))
    }

    /// Says why the trace stopped, and `what` it left; returns the exit code.
    fn stopped(&self, what: &str) -> Exit {
        let cause = stop::cause().unwrap_or(Cause::Interrupt);
        let resume = if self.is_kept { "; `--resume` goes on from there" } else { "" };
        messages::eprint(&format!("{cause}: {what}{resume}\n"));
        match cause {
            Cause::Time(_) if self.is_kept => Exit::Again,
            Cause::Time(_) | Cause::Memory(_) => Exit::Limit,
            Cause::Interrupt => Exit::Interrupted,
        }
    }

    fn write_part(&self, path: &Path, traced: Traced) -> Outcome {
        let name = path.display();
        if !traced.complete {
            return Ok(self.stopped(&format!("{name} is not written")));
        }
        let part = Saved {
            purpose: Purpose::Part,
            key: self.key,
            region: self.whole,
            films: vec![traced.film],
        };
        write_with(path, &|out| save(&part, out))?;
        checkpoint::remove(&checkpoint::beside(path))?;
        let Region { y, height, .. } = self.frame.region;
        messages::eprint(&format!("{name}: rows {y} to {}\n", y + height - 1));
        Ok(Exit::Done)
    }
}

impl RenderArguments {
    /// Returns the part of a still that is rendered; of an animation, a part is some of its frames.
    fn still_shard(&self) -> Option<Shard> {
        self.work.shard.filter(|_| self.animation.range().is_none())
    }

    /// Fails if further channels are asked for that a picture of this format, or a part of a picture, does not have.
    fn fits_channels(&self, format: Format) -> Result<(), Failure> {
        if self.channels.is_empty() {
            return Ok(());
        }
        if self.still_shard().is_some() {
            let sentence = "a part of a picture has its colours alone, without `--channels`";
            return Err(Failure::usage(sentence).help("`--region` renders a part with channels"));
        }
        match format.holds_channels() {
            true => Ok(()),
            false => Err(Failure::usage("only an .exr picture has further channels")
                .help("with `--channels`, write an .exr, such as `-o OUT.exr`")),
        }
    }
}

fn has_word(text: &str, word: &str) -> bool {
    let of_word = |c: char| c.is_alphanumeric() || c == '_';
    text.split(|c| !of_word(c)).any(|other| other == word)
}

/// Returns a rule by which `make` knows what a picture depends on: the scene, and other files.
fn rule_for_make([picture, scene]: &[String; 2], others: &BTreeSet<String>) -> String {
    let escaped = |name: &str| {
        name.replace('$', "$$").replace('#', "\\#").replace(' ', "\\ ").replace(':', "\\:")
    };
    let files = std::iter::once(scene).chain(others).map(|name| escaped(name));
    let files = files.collect::<Vec<_>>().join(" \\\n  ");
    // Files that are gone do not stop it.
    let phony: String = others.iter().map(|name| format!("\n{}:\n", escaped(name))).collect();
    format!("{}: {files}\n{phony}", escaped(picture))
}

/// Fails if there is clearly too little memory for the picture; a failed allocation would abort the program.
pub fn fits(part: Region, writing: u64, refined: bool) -> Result<(), Failure> {
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
pub fn most_threads() -> usize {
    4 * available_parallelism().map_or(1, NonZero::get)
}
