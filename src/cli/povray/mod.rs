//! `lucarne povray`: takes the options of POV-Ray 3.7, and answers as it does, for programs that call it.
//!
//! **Invariant:** all text is ASCII and on standard error; standard output has a picture that was asked for, or nothing.
//! The exit code is 0, 1, or 2 if interrupted.

mod inert;
mod quality;
mod rendered;
mod settings;
mod streams;
mod switches;

use std::env;
use std::ffi::OsString;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use lucarne::diagnostic::{Code, Diagnostic, Messages, Severity, render};
use lucarne::disk::DiskFiles;
use lucarne::evaluate::Animation;
use lucarne::film::{Channels, Developer};
use lucarne::picture;
use lucarne::plan::{Frame, PlanOptions, plan};
use lucarne::road::{Options, Road};
use lucarne::scene::Dialect;
use lucarne::source::Files;
use lucarne::trace::{TraceOptions, trace};

pub use self::inert::is_without_effect;
use self::rendered::Rendered;
use self::settings::Problem;
pub use self::settings::Settings;
use self::streams::Stream;
pub use self::switches::section_of;
use super::exit::Failure;
use super::files::Recorded;
use super::kept::Kept;
use super::messages;
use super::output::write_whole;
use super::render::{fits, most_threads};
use super::stop;
use super::text::{name_of, read_main};
use super::values::now;

const VERSION: &str = concat!(
    "POV-Ray 3.7 compatible: lucarne ",
    env!("CARGO_PKG_VERSION"),
    "\nThis is no version of POV-Ray, but a program that renders its scenes.\n"
);

const HELP: &str = "Usage: povray [+/-]option ... [FILE.pov] [FILE.ini[section]] [NAME=VALUE]

  +Iname +Oname +FN   input, output (- is standard output), type: N P T J B E H; +FNg grey
  +Wn +Hn             width and height in pixels
  +A0.3 +AM2 +R3      antialiasing: threshold, method, depth
  +UA                 transparent background
  +KFFn +KIn +KFn     last frame, first and last clock; +SFn +EFn a part; +KC cyclic
  +SRn +ERn +SCn +ECn rows and columns that are rendered
  +Lfolder +WTn +Qn   folder of includes, threads, quality
  +MVn +HIfile        language version, first include
  File_Gamma=n        gamma of the file: sRGB, or a number
  Declare=name=value  declares a number

Example: povray +Iscene.pov +Oscene.png +W640 +H480 +A
`lucarne render --help` describes the options of lucarne itself.
";

/// Why a frame is not finished.
enum Stop {
    /// The reason is printed.
    Failed,
    Interrupted,
}

/// Returns the words behind `lucarne povray`, or all if the program is called by the name `povray`.
pub fn words(all: &[OsString]) -> Option<&[OsString]> {
    let name = Path::new(all.first()?).file_stem()?;
    match name.eq_ignore_ascii_case("povray") {
        true => Some(&all[1..]),
        false => all.get(1).filter(|word| *word == "povray").map(|_| &all[2..]),
    }
}

/// Runs the words of a command line, without the program's name.
pub fn run(words: &[OsString]) -> ExitCode {
    let words: Vec<String> = words.iter().map(|word| word.to_string_lossy().into_owned()).collect();
    let asks = |names: &[&str]| words.iter().any(|word| names.contains(&word.as_str()));
    if asks(&["--version", "-version", "--benchmark", "-benchmark"]) {
        messages::eprint(VERSION);
        return ExitCode::SUCCESS;
    }
    if asks(&["--help", "-help", "-h", "-?"]) {
        messages::eprint(HELP);
        return ExitCode::SUCCESS;
    }
    let problem = |why: &str| {
        let command = words.join(" ");
        messages::eprint(&format!("Problem with option setting\npovray {command}\n{why}\n"));
        ExitCode::FAILURE
    };
    let read = |path: &Path| fs::read(path).ok().map(|bytes| lucarne::source::decode(bytes).0);
    let mut settings = Settings::default();
    let default = default_ini().and_then(|path| read(&path));
    let taken = default
        .map_or(Ok(()), |text| settings.take_text(&text, None, &read))
        .and_then(|()| settings.take(&words, &read));
    if let Err(Problem) = taken {
        return problem("Failed to parse command-line option");
    }
    let Some(input) = settings.input.clone() else { return problem("No input file provided") };
    if !settings.is_supported() {
        return problem("Unsupported combination of options");
    }
    stop::hear_interrupts("Render cancelled by user\n", 2);
    let run = Run { input: found(&input, &settings.folders), settings };
    if run.settings.streams.overwrite(&run.input) {
        return problem("A stream cannot be written to the scene");
    }
    run.settings.streams.begin();
    match run.all() {
        Ok(()) => {
            run.say(Stream::Render, "POV-Ray finished\n");
            ExitCode::SUCCESS
        }
        Err(Stop::Failed) => {
            run.say(Stream::Fatal, "Render failed\n");
            ExitCode::FAILURE
        }
        Err(Stop::Interrupted) => {
            run.say(Stream::Fatal, "Render cancelled by user\n");
            ExitCode::from(2)
        }
    }
}

/// Returns the INI file that is read before the command line: the first of these that there is.
fn default_ini() -> Option<PathBuf> {
    let home = env::var_os("HOME").map(PathBuf::from).unwrap_or_default();
    [
        env::var_os("POVINI").map(PathBuf::from),
        Some("povray.ini".into()),
        Some(home.join(".povray/3.7/povray.ini")),
        Some("/etc/povray/3.7/povray.ini".into()),
    ]
    .into_iter()
    .flatten()
    .find(|path| path.is_file())
}

/// Returns the path of the scene: as named, with `.pov`, or in a folder of includes.
fn found(input: &str, folders: &[PathBuf]) -> PathBuf {
    let names = [input.to_owned(), format!("{input}.pov")];
    let here = names.iter().map(PathBuf::from);
    let there = folders.iter().flat_map(|folder| names.iter().map(move |name| folder.join(name)));
    here.chain(there).find(|path| path.is_file()).unwrap_or_else(|| input.into())
}

struct Run {
    input: PathBuf,
    settings: Settings,
}

impl Run {
    fn say(&self, stream: Stream, text: &str) {
        self.settings.streams.say(stream, text);
    }

    /// Renders a still, or each frame of an animation.
    fn all(&self) -> Result<(), Stop> {
        for option in &self.settings.ineffective {
            self.say(Stream::Warning, &format!("lucarne: `{option}` has no effect\n"));
        }
        let bytes = read_main(&self.input).map_err(|failure| {
            self.say(
                Stream::Fatal,
                "Parse Error: Cannot open input file.\nFatal error in parser: Cannot parse input.\n",
            );
            self.failed(&failure)
        })?;
        let bytes = match &self.settings.header {
            Some(file) => [format!("#include \"{file}\" ").as_bytes(), &bytes].concat(),
            None => bytes,
        };
        let disk = DiskFiles::new(&self.input, &self.settings.folders).writing();
        let Some(range) = self.settings.frames() else {
            return self.frame(&bytes, (&disk, &disk), None, self.settings.clock);
        };
        let kept = Kept::new(&disk);
        let frames = range.frames();
        for (number, (animation, clock)) in frames.iter().enumerate() {
            let frame = format!("Rendering frame {} of {}\n", number + 1, frames.len());
            self.say(Stream::Render, &frame);
            self.frame(&bytes, (&disk, &kept), Some(*animation), *clock)?;
        }
        Ok(())
    }

    fn failed(&self, failure: &Failure) -> Stop {
        self.say(Stream::Fatal, &format!("{}\n", failure.sentence));
        let help = failure.help.iter();
        help.for_each(|help| self.say(Stream::Fatal, &format!("  help: {help}\n")));
        Stop::Failed
    }

    /// Renders one picture. `files` reads from `disk`, possibly once for all frames.
    fn frame(
        &self,
        bytes: &[u8],
        (disk, files): (&DiskFiles, &dyn Files),
        animation: Option<Animation>,
        clock: f64,
    ) -> Result<(), Stop> {
        let Settings { width, height, verbose, .. } = self.settings;
        let region = self.settings.region().map_err(|edge| {
            let text = format!("Fatal error in renderer: Invalid {edge} column or row\n");
            self.say(Stream::Fatal, &text);
            Stop::Failed
        })?;
        let frame = Frame { region, ..Frame::whole(width, height) };
        let output =
            self.settings.output(&self.input, animation.map(|animation| animation.frame_number));
        self.say(
            Stream::Render,
            &format!(
                "Image Output Options\n  Image resolution.....{width} by {height} (rows {} to {}, columns {} to {}).\n",
                frame.region.y + 1,
                frame.region.y + frame.region.height,
                frame.region.x + 1,
                frame.region.x + frame.region.width,
            ),
        );
        if self.settings.writes {
            self.say(Stream::Render, &format!("  Output file..........{}\n", output.name()));
            let checked =
                output.check(Frame::whole(width, height).region, self.settings.depth(), true);
            checked.map_err(|failure| self.failed(&failure))?;
        }
        let writing = self.settings.format.bytes_per_pixel(Channels::with(self.settings.alpha));
        fits(Frame::whole(width, height).region, writing, false)
            .map_err(|failure| self.failed(&failure))?;
        self.say(Stream::Render, &header("Parsing"));
        let read = Recorded::new(files);
        let (mut world, origins, encoding) = {
            let mut road = Road::new(&read, self.options(animation, clock));
            let file = road.read(&name_of(&self.input), bytes.to_vec());
            let ast = road.parse(file);
            let mut scene = road.evaluate(ast);
            quality::simplify(&mut scene, self.settings.quality);
            let encoding = self.settings.encoding(&scene);
            let (world, origins) = road.lower(scene);
            if self.settings.writes {
                let kept = output.keeps(&road.sources, &read.names());
                kept.map_err(|failure| self.failed(&failure))?;
            }
            let list = road.diagnostics.in_text_order().into_iter().cloned().collect();
            self.print(&Messages::new(list, road.sources))?;
            (world, origins, encoding)
        };
        for (path, _, bytes) in disk.written().map(|written| written.take()).unwrap_or_default() {
            write_whole(&path, &bytes).map_err(|failure| self.failed(&failure))?;
        }
        quality::dim(&mut world, self.settings.quality);
        let options = PlanOptions {
            antialias: self.settings.antialias(),
            alpha: self.settings.alpha,
            depth: quality::depth(self.settings.quality),
            ..PlanOptions::new(frame)
        };
        let plan = plan(&world, &origins, &options);
        self.say(Stream::Render, &header("Rendering"));
        let threads = self.settings.threads.map(|wanted| wanted.min(most_threads()));
        let threads = TraceOptions { threads, ..TraceOptions::default() };
        let watch = Rendered::new(&self.settings, frame.region);
        stop::begin_tracing();
        let traced = trace(&world, &plan, &threads, &watch);
        if !traced.complete {
            return Err(Stop::Interrupted);
        }
        watch.show(1.0);
        if verbose {
            self.say(Stream::Render, "\n");
        }
        let counters = &traced.counters;
        self.say(
            Stream::Statistic,
            &format!(
                "Render Statistics\nImage Resolution {width} x {height}\nPixels: {}   Samples: {}   Rays: {}\n",
                frame.region.pixels(),
                counters.camera,
                counters.rays()
            ),
        );
        if !self.settings.writes {
            return Ok(());
        }
        let film = traced.film.framed();
        let developer = Developer::with_encoding(
            self.settings.depth(),
            film.assumed_gamma,
            encoding,
            film.pixels.len(),
        );
        let written = output.write(&|out: &mut dyn Write| {
            picture::write(&film, &developer, self.settings.format, out)
        });
        written.map_err(|failure| self.failed(&failure))
    }

    fn options(&self, animation: Option<Animation>, clock: f64) -> Options {
        let Settings { width, height, ref declares, .. } = self.settings;
        let options = Options::new(Dialect::Pov).for_picture((width, height));
        let mut options = options.declaring(declares.clone());
        let evaluate = &mut options.evaluate;
        (evaluate.clock, evaluate.animation) = (clock, animation);
        (evaluate.now, evaluate.version) = (now(), self.settings.version);
        evaluate.interrupt = stop::interrupt();
        options
    }

    /// Prints the messages in POV-Ray's words. Fails if there is an error.
    fn print(&self, messages: &Messages) -> Result<(), Stop> {
        let place = |one: &Diagnostic| {
            one.primary().map_or(String::new(), |label| {
                let source = messages.sources().get(label.span.file);
                let line = source.position(label.span.start as usize).line;
                format!("File '{}' line {line}: ", source.name)
            })
        };
        for one in messages.iter() {
            match one.severity {
                Severity::Note => self.say(Stream::Debug, &render::plain(one)),
                Severity::Warning => {
                    let text = format!("{}Parse Warning: {}\n", place(one), one.message);
                    self.say(Stream::Warning, &text);
                }
                Severity::Error => {}
            }
        }
        if stop::is_set() {
            return Err(Stop::Interrupted);
        }
        let Some(first) = messages.iter().find(|one| one.is_error()) else { return Ok(()) };
        let halted = match first.code {
            Code::AuthorError => "Parse halted by #error directive: ",
            _ => "",
        };
        let text = format!("{}Parse Error: {halted}{}\n", place(first), first.message);
        self.say(Stream::Fatal, &text);
        self.say(Stream::Fatal, "Fatal error in parser: Cannot parse input.\n");
        for one in messages.iter().filter(|one| one.is_error()) {
            let drawn = render::human(one, messages.sources(), render::Style::PLAIN);
            self.say(Stream::Fatal, &format!("\n{drawn}"));
        }
        Err(Stop::Failed)
    }
}

fn header(name: &str) -> String {
    format!("==== [{name}...] {:=<width$}\n", "", width = 65 - name.len())
}
