//! The command line as it is typed: every flag, and the values it may have.

use std::path::{Path, PathBuf};

use clap::{Args, Parser, Subcommand, ValueEnum};
use lucarne::diagnostic::{Code, Level};
use lucarne::plan::{Antialias, Frame, PlanOptions, Precision, Region};
use lucarne::road::Options;
use lucarne::scene::Dialect;

use super::exit::Failure;
use super::language::Language;
use super::messages;
use super::scene::SceneArguments;
use super::text::is_include;
use super::values::{
    MetricArgument, antialias, depth, error, knob, region, seconds, seed, size, threads, tolerance,
    weight,
};

/// A compiler for a POV-Ray-like scene language, and the ray tracer behind it.
///
/// `lucarne FILE` renders FILE, as `lucarne render FILE` does.
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

const HINTS: &str = "\
The options of `lucarne FILE` are those of `lucarne render --help`. FILE may be `-`: standard input.

Exit codes: 0 done; 1 the scene has errors; 2 wrong usage; 3 a file cannot be read or written;
4 a limit stopped it; 5 a promise about accuracy or time was missed; 70 a bug; 130 interrupted.";

#[derive(Debug, Subcommand)]
pub enum Command {
    /// Compile a scene and trace its picture
    Render(RenderArguments),
    /// Print the messages about scenes and render nothing
    Check(CheckArguments),
    /// Lay scenes out: indents, blanks and lines; no word of them changes
    Fmt(FmtArguments),
    /// Print what a scene becomes on its way to the picture
    Show(ShowArguments),
    /// Print what the tracer will simulate, what called for it, and what it leaves out
    Plan(PlanArguments),
    /// Measure what each setting costs and what accuracy it buys, on this scene
    Accuracy(AccuracyArguments),
    /// Explain a message by its code; without a code, list them all
    Explain(ExplainArguments),
}

#[derive(Debug, Args)]
pub struct RenderArguments {
    /// The scene: `.scene`, or POV-Ray's `.pov`; `-` reads standard input
    pub file: PathBuf,
    /// Where to write; the extension chooses the format: png jpg ppm qoi hdr exr; `-` writes a PNG
    /// to standard output [default: the scene's name with .png, in the current folder]
    #[arg(short, long, value_name = "OUT")]
    pub output: Option<PathBuf>,
    #[command(flatten)]
    pub picture: PictureArguments,
    #[command(flatten)]
    pub scene: SceneArguments,
    /// Bits a channel: 8 or 16 (png and ppm)
    #[arg(long, value_parser = clap::value_parser!(u8))]
    pub bits: Option<u8>,
    /// Choose the settings so that the error is at most E (0.01, 1% or 2/255), prove it on pixels that
    /// had no part in the choice, and exit with 5 if it cannot be
    #[arg(long, value_name = "E", value_parser = error, allow_negative_numbers = true)]
    #[arg(group = "promise")]
    #[arg(conflicts_with_all = ["antialias", "depth", "adc_bailout", "precision", "root_tolerance", "julia_iterations", "time_budget"])]
    pub max_error: Option<f64>,
    /// Make the best picture there is time for (500ms, 60s, 5m; a number alone is seconds), and say how
    /// far off it is; exit with 4 if not even one ray a pixel fits, and with 5 if there is no time to
    /// find out how far off it is
    #[arg(long, value_name = "T", value_parser = seconds, allow_hyphen_values = true)]
    #[arg(group = "promise")]
    #[arg(conflicts_with_all = ["antialias", "depth", "adc_bailout", "precision", "root_tolerance", "julia_iterations"])]
    pub time_budget: Option<f64>,
    /// What `--max-error` and `--time-budget` call an error
    #[arg(long, value_enum, default_value_t, value_name = "METRIC", requires = "promise")]
    pub metric: MetricArgument,
    /// Of the pixels that `--max-error` and `--time-budget` choose and audit by
    #[arg(long, value_name = "N", default_value_t = 1, requires = "promise")]
    #[arg(value_parser = seed, allow_negative_numbers = true)]
    pub seed: u64,
    /// Threads to trace with [default: one a core]
    #[arg(long, value_name = "N", value_parser = threads, allow_negative_numbers = true)]
    pub threads: Option<u16>,
    /// Print times, memory, rays and what they took, as a table or as JSON
    #[arg(long, value_name = "json", num_args = 0..=1, require_equals = true)]
    pub stats: Option<Option<StatsFormat>>,
    /// Overwrite OUT even where it is not a picture, or is write-protected. (Any other picture is always
    /// overwritten; a file the scene was read from never is.)
    #[arg(long)]
    pub force: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum StatsFormat {
    Json,
}

#[derive(Debug, Args)]
pub struct CheckArguments {
    /// The scenes
    #[arg(required = true, value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// Only parse: read no includes, evaluate nothing
    #[arg(long)]
    pub syntax_only: bool,
    /// Tell old forms of the language too, in the whole of these files
    #[arg(long)]
    pub legacy: bool,
    /// Apply the fixes that messages offer to these files, then check again
    #[arg(long)]
    pub fix: bool,
    /// Say of each file that the scene reads which one answered: its path, or `built in`
    #[arg(long = "where")]
    pub places: bool,
    /// Say nothing of a file that there is nothing to say of
    #[arg(short, long)]
    pub quiet: bool,
    /// The picture's width and height in pixels, for what depends on them
    #[arg(long, value_name = "WxH", value_parser = size, allow_hyphen_values = true)]
    size: Option<(u32, u32)>,
    #[command(flatten)]
    pub scene: SceneArguments,
}

/// Warnings that say something of a scene, and nothing of a part of one.
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
    /// The scenes and their includes; `-` lays out standard input
    #[arg(required = true, value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// Write nothing; list the files that would change, and exit with 1 if there are any
    #[arg(long)]
    pub check: bool,
    /// Write nothing; print what would change
    #[arg(long)]
    pub diff: bool,
    /// The language of the files [default: by the end of the name, `.pov` or `.scene`, else by the text]
    #[arg(long, value_enum, value_name = "pov|scene")]
    pub language: Option<Language>,
    /// How messages about files that cannot be read are shown
    #[arg(long, value_enum, default_value_t, value_name = "FORMAT")]
    pub message_format: messages::Format,
}

#[derive(Debug, Args)]
pub struct ShowArguments {
    /// The scene
    pub file: PathBuf,
    /// How far along it
    #[arg(long, value_enum, default_value = "scene")]
    pub stage: Stage,
    #[command(flatten)]
    pub picture: PictureArguments,
    #[command(flatten)]
    pub scene: SceneArguments,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Stage {
    /// What was typed
    Ast,
    /// What the author meant: no macro, loop, include or name is left
    Scene,
    /// What is there, in canonical form
    World,
    /// What will be done about it
    Plan,
}

#[derive(Debug, Args)]
pub struct PlanArguments {
    /// The scene
    pub file: PathBuf,
    /// Print one JSON object, with every place (docs/effects.md)
    #[arg(long)]
    pub json: bool,
    #[command(flatten)]
    pub picture: PictureArguments,
    #[command(flatten)]
    pub scene: SceneArguments,
}

#[derive(Debug, Args)]
pub struct AccuracyArguments {
    /// The scene
    pub file: PathBuf,
    /// The knobs to turn, separated by commas [default: all that the scene calls for]
    #[arg(long, value_name = "NAMES", value_delimiter = ',', value_parser = knob)]
    pub knobs: Vec<&'static str>,
    /// How long it may take, such as 60s or 5m (a number alone is seconds): more time, more runs and
    /// dearer settings
    #[arg(long, value_name = "T", value_parser = seconds, default_value = "60s")]
    pub budget: f64,
    /// What is called an error
    #[arg(long, value_enum, default_value_t, value_name = "METRIC")]
    pub metric: MetricArgument,
    /// Print one JSON object instead of the table
    #[arg(long)]
    pub json: bool,
    /// Print all columns of the table: every time, boxes and roots, and verdicts in full
    #[arg(long, conflicts_with = "json")]
    pub wide: bool,
    /// Also draw the work-precision diagram
    #[arg(long, value_name = "OUT.svg")]
    pub svg: Option<PathBuf>,
    /// Of the audited pixels and the reference's samples
    #[arg(long, value_name = "N", default_value_t = 1)]
    #[arg(value_parser = seed, allow_negative_numbers = true)]
    pub seed: u64,
    /// Threads to trace with [default: one a core]
    #[arg(long, value_name = "N", value_parser = threads, allow_negative_numbers = true)]
    pub threads: Option<u16>,
    #[command(flatten)]
    pub frame: FrameArguments,
    #[command(flatten)]
    pub scene: SceneArguments,
}

#[derive(Debug, Args)]
pub struct ExplainArguments {
    /// The word in front of a message, such as `unknown-word`
    pub code: Option<String>,
}

/// How large.
#[derive(Debug, Args)]
pub struct FrameArguments {
    /// The picture's width and height in pixels
    #[arg(long, value_name = "WxH", value_parser = size, allow_hyphen_values = true)]
    #[arg(default_value = "640x480")]
    size: (u32, u32),
    /// Trace only this part: left, top, width, height in pixels
    #[arg(long, value_name = "X,Y,W,H", value_parser = region, allow_hyphen_values = true)]
    region: Option<Region>,
}

/// How large and how fine.
#[derive(Debug, Args)]
pub struct PictureArguments {
    #[command(flatten)]
    frame: FrameArguments,
    /// `off`: one ray a pixel; N: N×N rays a pixel; `adaptive`: 4×4 where neighbours differ by more
    /// than 0.05, or N×N by more than T with `adaptive:T:N`
    #[arg(long, value_name = "off|N|adaptive", value_parser = antialias, default_value = "adaptive")]
    antialias: Antialias,
    /// How many surfaces deep a ray is followed, instead of the scene's max_trace_level
    #[arg(long, value_name = "N", value_parser = depth, allow_negative_numbers = true)]
    depth: Option<u32>,
    /// Follow no ray that counts less than this (0.01, 1/255), mirrored or let through, instead of the scene's adc_bailout
    #[arg(long, value_name = "W", value_parser = weight, allow_negative_numbers = true)]
    adc_bailout: Option<f64>,
    /// The arithmetic that rays and shapes meet in
    #[arg(long, value_enum, default_value_t, value_name = "single|double")]
    precision: PrecisionArgument,
    /// How near a crossing must be found where steps come nearer and nearer to it, as of a torus, of the
    /// solid's size; 0 asks for all digits
    #[arg(long, value_name = "T", value_parser = tolerance, default_value = "0")]
    #[arg(allow_negative_numbers = true)]
    root_tolerance: f64,
    /// How many iterations of a julia_fractal are looked at, where it has more
    #[arg(long, value_name = "N", value_parser = depth, allow_negative_numbers = true)]
    julia_iterations: Option<u32>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub enum PrecisionArgument {
    /// 32 bits
    Single,
    /// 64 bits
    #[default]
    Double,
}

impl CheckArguments {
    /// What the road takes, for a main file of this name and language.
    pub fn options(&self, file: &Path, dialect: Dialect) -> Options {
        let frame = self.size.map(|(width, height)| Frame::whole(width, height));
        let mut options = self.scene.options(dialect, frame);
        // Alone, an include is a part of a scene that is not known.
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
    /// What the scene is compiled with, where the command takes one.
    pub fn scene(&self) -> Option<&SceneArguments> {
        match self {
            Self::Render(arguments) => Some(&arguments.scene),
            Self::Check(arguments) => Some(&arguments.scene),
            Self::Show(arguments) => Some(&arguments.scene),
            Self::Plan(arguments) => Some(&arguments.scene),
            Self::Accuracy(arguments) => Some(&arguments.scene),
            Self::Fmt(_) | Self::Explain(_) => None,
        }
    }
}

impl PictureArguments {
    /// The picture and the part of it to trace; fails when the part is not inside.
    pub fn frame(&self, scene: &SceneArguments) -> Result<Frame, Failure> {
        self.frame.frame(scene)
    }

    /// What is asked of the plan.
    pub fn options(&self, frame: Frame) -> PlanOptions {
        let Self { antialias, depth, adc_bailout, root_tolerance, julia_iterations, .. } = *self;
        let precision = match self.precision {
            PrecisionArgument::Single => Precision::Single,
            PrecisionArgument::Double => Precision::Double,
        };
        PlanOptions {
            frame,
            antialias,
            depth,
            adc_bailout,
            precision,
            root_tolerance,
            julia_iterations,
        }
    }
}

impl FrameArguments {
    /// The picture and the part of it to trace; fails when the part is not inside.
    pub fn frame(&self, scene: &SceneArguments) -> Result<Frame, Failure> {
        let (width, height) = self.size;
        let mut frame = Frame::whole(width, height);
        if let Some(region) = self.region {
            let right = u64::from(region.x) + u64::from(region.width);
            let bottom = u64::from(region.y) + u64::from(region.height);
            if right > width.into() || bottom > height.into() {
                let sentence = format!(
                    "the region ends at {right},{bottom}, outside of the {width}×{height} picture"
                );
                return Err(Failure::usage(sentence));
            }
            frame.region = region;
        }
        let (pixels, most) =
            (u64::from(frame.region.width) * u64::from(frame.region.height), scene.most_pixels());
        if pixels > most {
            return Err(Failure::limit(format!(
                "the picture has {pixels} pixels, and the limit is {most}"
            ))
            .help(format!("`--limit pixels={pixels}` raises it; `--region` renders a part")));
        }
        Ok(frame)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_description_of_the_arguments_is_consistent() {
        use clap::CommandFactory;
        Arguments::command().debug_assert();
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
