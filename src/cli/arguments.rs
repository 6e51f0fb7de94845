//! Defines the command line: every command and flag, and the values they accept.

mod animation;
mod picture;
mod work;

use std::path::{Path, PathBuf};

use clap::{Args, Parser, Subcommand, ValueEnum};
use lucarne::diagnostic::{Code, Level};
use lucarne::plan::Frame;
use lucarne::road::Options;
use lucarne::scene::Dialect;

use super::language::Language;
use super::messages;
use super::scene::SceneArguments;
use super::text::is_include;
pub use animation::AnimationArguments;
pub use picture::{FrameArguments, PictureArguments};
pub use work::{Shard, WorkArguments};

use super::values::{ChannelArgument, MetricArgument, error, knob, seconds, seed, size, threads};

/// Compiler and ray tracer for a POV-Ray-like scene language
///
/// `lucarne FILE` is short for `lucarne render FILE`.
#[derive(Debug, Parser)]
#[command(name = "lucarne", version, arg_required_else_help = true, after_help = HINTS)]
#[command(override_usage = USAGE)]
pub struct Arguments {
    #[command(subcommand)]
    pub command: Command,
}

const USAGE: &str = "\
lucarne [OPTIONS] <FILE>
       lucarne <COMMAND> [OPTIONS] …";

/// Paragraphs are single lines, which clap wraps to the terminal.
const HINTS: &str = "\
The options of `lucarne FILE` are those of `lucarne render --help`.
If FILE is `-`, the scene is read from standard input.
`lucarne povray OPTIONS…` takes the options of POV-Ray, such as `+Iscene.pov +W640 +H480`.

Exit codes:
    0  success
    1  errors in the scene
    2  invalid command line
    3  a file cannot be read or written
    4  a limit was exceeded
    5  `--max-error` or `--time-budget` not met
   70  internal error
   75  a part is missing or was interrupted: render it again
  130  interrupted";

#[derive(Debug, Subcommand)]
pub enum Command {
    /// Render a scene to a picture file
    #[command(
        after_help = "Examples:\n  lucarne scene.pov -o picture.png --size 1920x1080\n  lucarne scene.pov --frames 1..24 -o film.gif\n  lucarne film.ini"
    )]
    Render(Box<RenderArguments>),
    /// Make one picture of the parts that `render --shard` wrote
    #[command(
        after_help = "Example:\n  lucarne merge picture.1-of-2.part picture.2-of-2.part -o picture.png"
    )]
    Merge(MergeArguments),
    /// Print completions of the command line for a shell
    #[command(
        after_help = "Example:\n  lucarne completions bash > ~/.local/share/bash-completion/completions/lucarne"
    )]
    Completions(CompletionsArguments),
    /// Print the manual page, for `man`
    #[command(after_help = "Example:\n  lucarne man > ~/.local/share/man/man1/lucarne.1")]
    Man,
    /// Check scenes for errors and warnings without rendering
    #[command(
        after_help = "Examples:\n  lucarne check scene.pov --fix\n  lucarne check *.scene --deny no-light"
    )]
    Check(CheckArguments),
    /// Format scenes: indentation, spacing and line breaks only
    #[command(after_help = "Examples:\n  lucarne fmt scene.scene\n  lucarne fmt --check *.scene")]
    Fmt(FmtArguments),
    /// Print one intermediate representation of a scene
    #[command(after_help = "Example:\n  lucarne show scene.scene --stage world")]
    Show(ShowArguments),
    /// Print the effects that will be simulated, what requires each of them, and what is left out
    #[command(after_help = "Example:\n  lucarne plan scene.pov")]
    Plan(PlanArguments),
    /// Measure the cost and the accuracy of each render setting on this scene
    #[command(after_help = "Example:\n  lucarne accuracy scene.pov --budget 5m --svg diagram.svg")]
    Accuracy(AccuracyArguments),
    /// Explain a diagnostic code, or list all codes
    #[command(after_help = "Example:\n  lucarne explain unknown-word")]
    Explain(ExplainArguments),
}

#[derive(Debug, Args)]
pub struct RenderArguments {
    /// Scene to render: `.scene`, or `.pov` for POV-Ray; `-` reads standard input. Or an `.ini` or `.ini[section]` of
    /// POV-Ray, which names the scene, and whose options count where the command line has none
    pub file: PathBuf,
    /// Output file; the extension selects the format: png, jpg, ppm, qoi, tga, bmp, hdr or exr; `-` writes a PNG to
    /// standard output [default: the name of the scene with .png, in the current directory]
    #[arg(short, long, value_name = "OUT")]
    pub output: Option<PathBuf>,
    #[command(flatten)]
    pub picture: PictureArguments,
    #[command(flatten)]
    pub scene: SceneArguments,
    #[command(flatten)]
    pub animation: AnimationArguments,
    #[command(flatten)]
    pub work: WorkArguments,
    /// Write a rule for make to this file: OUT depends on the scene and on all files that it reads
    #[arg(long, value_name = "FILE", conflicts_with = "frames")]
    pub deps: Option<PathBuf>,
    /// Bits per channel, 8 or 16; png and ppm only
    #[arg(long, value_parser = clap::value_parser!(u8))]
    pub bits: Option<u8>,
    /// Write how opaque each pixel is, too: 1 where a ray ends on something, 0 where it sees nothing, and no
    /// `background` or `sky_sphere` that is opaque (for example `--alpha -o ball.png`); png, qoi, tga, bmp and exr only
    #[arg(long)]
    pub alpha: bool,
    /// Write further channels into an .exr, separated by commas: of the first surface on the ray through the centre of
    /// each pixel (for example `--channels depth,normal -o ball.exr`)
    #[arg(long, value_enum, value_name = "NAMES", value_delimiter = ',')]
    pub channels: Vec<ChannelArgument>,
    /// Choose settings that keep the error at or below E (for example 0.01, 1% or 2/255) and verify the
    /// error on pixels not used for that choice; exits with 5 if the bound cannot be verified
    #[arg(long, value_name = "E", value_parser = error, allow_negative_numbers = true)]
    #[arg(group = "promise")]
    #[arg(conflicts_with_all = ["antialias", "depth", "adc_bailout", "root_tolerance", "julia_iterations", "light_samples", "blur_samples", "time_budget"])]
    pub max_error: Option<f64>,
    /// Render the best picture possible within time T (500ms, 60s, 5m; a plain number is in seconds) and
    /// report its error; exits with 4 if one ray per pixel does not fit, and with 5 if no time is left to
    /// estimate the error
    #[arg(long, value_name = "T", value_parser = seconds, allow_hyphen_values = true)]
    #[arg(group = "promise")]
    #[arg(conflicts_with_all = ["antialias", "depth", "adc_bailout", "root_tolerance", "julia_iterations", "light_samples", "blur_samples"])]
    pub time_budget: Option<f64>,
    /// Error metric for `--max-error` and `--time-budget`
    #[arg(long, value_enum, default_value_t, value_name = "METRIC", requires = "promise")]
    pub metric: MetricArgument,
    /// Random seed for the pixels on which `--max-error` and `--time-budget` choose settings and audit the
    /// error
    #[arg(long, value_name = "N", default_value_t = 1, requires = "promise")]
    #[arg(value_parser = seed, allow_negative_numbers = true)]
    pub seed: u64,
    /// Number of threads [default: one per core]
    #[arg(long, value_name = "N", value_parser = threads, allow_negative_numbers = true)]
    pub threads: Option<u16>,
    /// Print times, memory use and ray counts, as a table or as JSON
    #[arg(long, value_name = "json", num_args = 0..=1, require_equals = true)]
    pub stats: Option<Option<StatsFormat>>,
    /// Overwrite OUT even if it is not a picture or is write-protected. Without this flag, only other
    /// pictures are overwritten. A file that the scene was read from is never overwritten
    #[arg(long)]
    pub force: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum StatsFormat {
    Json,
}

#[derive(Debug, Args)]
pub struct CompletionsArguments {
    /// Shell
    pub shell: clap_complete::Shell,
}

#[derive(Debug, Args)]
pub struct MergeArguments {
    /// Parts of one picture, in any order
    #[arg(required = true, value_name = "PART")]
    pub parts: Vec<PathBuf>,
    /// Output file, as of `render`
    #[arg(short, long, value_name = "OUT")]
    pub output: PathBuf,
    /// Bits per channel, 8 or 16; png and ppm only
    #[arg(long, value_parser = clap::value_parser!(u8))]
    pub bits: Option<u8>,
    /// Overwrite OUT even if it is not a picture or is write-protected
    #[arg(long)]
    pub force: bool,
}

#[derive(Debug, Args)]
pub struct CheckArguments {
    /// Scenes to check
    #[arg(required = true, value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// Only parse the files; do not read includes or evaluate anything
    #[arg(long)]
    pub syntax_only: bool,
    /// Also report outdated forms of the language, in the given files
    #[arg(long)]
    pub legacy: bool,
    /// Apply the suggested fixes to the given files, then check again
    #[arg(long)]
    pub fix: bool,
    /// Print the path of each file that the scene reads, or `built in` for embedded ones
    #[arg(long = "where")]
    pub places: bool,
    /// Print nothing for a file without errors or warnings
    #[arg(short, long)]
    pub quiet: bool,
    /// Width and height of the picture in pixels, for checks that depend on them
    #[arg(long, value_name = "WxH", value_parser = size, allow_hyphen_values = true)]
    size: Option<(u32, u32)>,
    #[command(flatten)]
    pub scene: SceneArguments,
}

/// Warnings about a scene as a unit; not reported for an include file that is checked alone.
const OF_WHOLE_SCENES: &[Code] = &[
    Code::NoCamera,
    Code::NoLight,
    Code::NoPigment,
    Code::EmptyScene,
    Code::NothingInView,
    Code::UnusedDeclaration,
    Code::NeverPlaced,
    Code::OldVersion,
];

#[derive(Debug, Args)]
pub struct FmtArguments {
    /// Scenes and include files to format; `-` formats standard input
    #[arg(required = true, value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// Do not write; list the files that would change, and exit with 1 if there are any
    #[arg(long)]
    pub check: bool,
    /// Do not write; print a diff of the changes
    #[arg(long)]
    pub diff: bool,
    /// Language of the files [default: chosen by the extension, `.pov` or `.scene`, otherwise by the text]
    #[arg(long, value_enum, value_name = "pov|scene")]
    pub language: Option<Language>,
    /// Output format for messages about files that cannot be read
    #[arg(long, value_enum, default_value_t, value_name = "FORMAT")]
    pub message_format: messages::Format,
}

#[derive(Debug, Args)]
pub struct ShowArguments {
    /// Scene to show
    pub file: PathBuf,
    /// Stage of compilation to print
    #[arg(long, value_enum, default_value = "scene")]
    pub stage: Stage,
    #[command(flatten)]
    pub picture: PictureArguments,
    #[command(flatten)]
    pub scene: SceneArguments,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Stage {
    /// Syntax tree, as parsed
    Ast,
    /// Evaluated scene: macros, loops, includes and names are resolved
    Scene,
    /// Canonical description of the objects, lights and camera
    World,
    /// Plan of what the tracer will simulate
    Plan,
}

#[derive(Debug, Args)]
pub struct PlanArguments {
    /// Scene to plan
    pub file: PathBuf,
    /// Print one JSON object that includes all source locations (see docs/effects.md)
    #[arg(long)]
    pub json: bool,
    #[command(flatten)]
    pub picture: PictureArguments,
    #[command(flatten)]
    pub scene: SceneArguments,
}

#[derive(Debug, Args)]
pub struct AccuracyArguments {
    /// Scene to measure
    pub file: PathBuf,
    /// Settings to vary, separated by commas [default: all that the scene can use]
    #[arg(long, value_name = "NAMES", value_delimiter = ',', value_parser = knob)]
    pub knobs: Vec<&'static str>,
    /// Time to spend, such as 60s or 5m (a plain number is in seconds); more time allows more runs and more
    /// expensive settings
    #[arg(long, value_name = "T", value_parser = seconds, default_value = "60s")]
    pub budget: f64,
    /// Error metric
    #[arg(long, value_enum, default_value_t, value_name = "METRIC")]
    pub metric: MetricArgument,
    /// Print one JSON object instead of the table
    #[arg(long)]
    pub json: bool,
    /// Print every column of the table: all times, box visits and root solves, and full verdicts
    #[arg(long, conflicts_with = "json")]
    pub wide: bool,
    /// Also write the work-precision diagram to this SVG file
    #[arg(long, value_name = "OUT.svg")]
    pub svg: Option<PathBuf>,
    /// Random seed for the audited pixels and the reference samples
    #[arg(long, value_name = "N", default_value_t = 1)]
    #[arg(value_parser = seed, allow_negative_numbers = true)]
    pub seed: u64,
    /// Number of threads [default: one per core]
    #[arg(long, value_name = "N", value_parser = threads, allow_negative_numbers = true)]
    pub threads: Option<u16>,
    #[command(flatten)]
    pub frame: FrameArguments,
    #[command(flatten)]
    pub scene: SceneArguments,
}

#[derive(Debug, Args)]
pub struct ExplainArguments {
    /// Diagnostic code as printed in a message, such as `unknown-word`
    pub code: Option<String>,
}

impl CheckArguments {
    /// Returns the compile options for a main file with this name and language.
    pub fn options(&self, file: &Path, dialect: Dialect) -> Options {
        let frame = self.size.map(|(width, height)| Frame::whole(width, height));
        let mut options = self.scene.options(dialect, frame);
        // An include file is part of an unknown scene, so warnings about complete scenes do not apply.
        if is_include(file) {
            OF_WHOLE_SCENES.iter().for_each(|code| options.levels.set_unnamed(*code, Level::Allow));
        }
        options.legacy = self.legacy;
        if self.legacy && options.levels.of(Code::LegacyForm) == Some(Level::Allow) {
            options.levels.set(Code::LegacyForm, Level::Warn);
        }
        options
    }
}

impl Command {
    /// Returns the arguments that compile a scene, or `None` for a command that compiles none.
    pub fn scene(&self) -> Option<&SceneArguments> {
        match self {
            Self::Render(arguments) => Some(&arguments.scene),
            Self::Check(arguments) => Some(&arguments.scene),
            Self::Show(arguments) => Some(&arguments.scene),
            Self::Plan(arguments) => Some(&arguments.scene),
            Self::Accuracy(arguments) => Some(&arguments.scene),
            Self::Fmt(_) | Self::Merge(_) | Self::Completions(_) | Self::Man | Self::Explain(_) => {
                None
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use lucarne::plan::PlanOptions;

    use super::*;

    #[test]
    fn the_description_of_the_arguments_is_consistent() {
        use clap::CommandFactory;
        Arguments::command().debug_assert();
    }

    #[test]
    fn every_command_shows_an_example_that_it_takes() {
        use clap::CommandFactory;
        for command in Arguments::command().get_subcommands() {
            let help = command.get_after_help().expect("an example").to_string();
            let examples: Vec<&str> = help.lines().skip(1).map(str::trim).collect();
            assert!(help.starts_with("Example") && !examples.is_empty(), "{help}");
            for example in examples {
                let words = example.split(" >").next().expect("words").split(' ');
                let mut words: Vec<&str> = words.collect();
                if words[1] != command.get_name() {
                    words.insert(1, "render");
                }
                assert_eq!(words[1], command.get_name());
                assert!(Arguments::try_parse_from(&words).is_ok(), "{example}");
            }
        }
    }

    #[test]
    fn every_knob_is_a_flag_that_makes_the_same_picture_and_is_no_promises() {
        use lucarne::accuracy::KNOBS;
        let frame = Frame::whole(640, 480);
        let asked = |flags: &str| {
            let words = format!("lucarne render a.scene {flags}");
            match Arguments::try_parse_from(words.split(' ')).map(|asked| asked.command) {
                Ok(Command::Render(render)) => Some(render.picture.options(frame)),
                _ => None,
            }
        };
        for knob in KNOBS {
            for &setting in knob.settings {
                let flag = (knob.flag)(setting);
                let mut options = PlanOptions::new(frame);
                (knob.set)(&mut options, setting);
                let asked_for = asked(&flag).expect(&flag);
                assert_eq!((knob.get)(&asked_for), (knob.get)(&options), "{flag}");
                for promise in ["--max-error 0.1", "--time-budget 3s"] {
                    assert!(asked(&format!("{flag} {promise}")).is_none(), "{flag} {promise}");
                }
            }
        }
    }
}
