//! The command line as it is typed: every flag, and the values it may have.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};
use lucarne::diagnostic::{Level, Levels};
use lucarne::plan::{Antialias, Frame, PlanOptions, Precision, Region};
use lucarne::road::{Options, dialect};
use lucarne::scene::Dialect;

use super::exit::Failure;
use super::messages::{self, Messages};
use super::values::{
    Limit, MetricArgument, Warnings, antialias, declare, error, knob, limit, now, region, seconds,
    size, warning, weight,
};

/// The most pixels a picture has unless `--limit pixels=N` says otherwise.
///
/// They take about 8 GiB of memory.
const MOST_PIXELS: u64 = 1 << 27;

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
    /// The scene: `.scene`, or POV-Ray's `.pov`; `-` reads a `.scene` from standard input
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
    /// Choose the settings so that the error is at most E, prove it on pixels that had no part in
    /// the choice, and exit with 5 if it cannot be
    #[arg(long, value_name = "E", value_parser = error, allow_negative_numbers = true)]
    #[arg(conflicts_with_all = ["antialias", "depth", "adc_bailout", "precision", "time_budget"])]
    pub max_error: Option<f64>,
    /// Make the best picture there is time for, and say how far off it is; exit with 4 if not even
    /// one ray a pixel fits
    #[arg(long, value_name = "T", value_parser = seconds, allow_hyphen_values = true)]
    #[arg(conflicts_with_all = ["antialias", "depth", "adc_bailout", "precision"])]
    pub time_budget: Option<f64>,
    /// What `--max-error` and `--time-budget` call an error
    #[arg(long, value_enum, default_value_t, value_name = "METRIC")]
    pub metric: MetricArgument,
    /// Threads to trace with [default: one a core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    #[arg(allow_negative_numbers = true)]
    pub threads: Option<u16>,
    /// Print times, memory, rays and what they took, as a table or as JSON
    #[arg(long, value_name = "json", num_args = 0..=1, require_equals = true)]
    pub stats: Option<Option<StatsFormat>>,
    /// Overwrite OUT even where it is not a picture. (A picture is always overwritten; a file the scene
    /// was read from never is.)
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
    /// Apply the fixes that messages offer to these files, then check again
    #[arg(long)]
    pub fix: bool,
    /// Say of each file that the scene reads which one answered: its path, or `embedded`
    #[arg(long = "where")]
    pub places: bool,
    /// The picture's width and height in pixels, for what depends on them
    #[arg(long, value_name = "WxH", value_parser = size, allow_hyphen_values = true)]
    size: Option<(u32, u32)>,
    #[command(flatten)]
    pub scene: SceneArguments,
}

#[derive(Debug, Args)]
pub struct ShowArguments {
    /// The scene
    pub file: PathBuf,
    #[arg(long, value_enum)]
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
    /// About how long it may take, such as 60s or 5m: more time, more runs and dearer settings
    #[arg(long, value_name = "T", value_parser = seconds, default_value = "60s")]
    pub budget: f64,
    /// What is called an error
    #[arg(long, value_enum, default_value_t, value_name = "METRIC")]
    pub metric: MetricArgument,
    /// Print one JSON object instead of the table
    #[arg(long)]
    pub json: bool,
    /// Also draw the work-precision diagram
    #[arg(long, value_name = "OUT.svg")]
    pub svg: Option<PathBuf>,
    /// Of the audited pixels and the reference's samples
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub seed: u64,
    /// Threads to trace with [default: one a core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    #[arg(allow_negative_numbers = true)]
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
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    #[arg(allow_negative_numbers = true)]
    depth: Option<u32>,
    /// Follow no reflection of less weight than this, instead of the scene's adc_bailout
    #[arg(long, value_name = "W", value_parser = weight, allow_negative_numbers = true)]
    adc_bailout: Option<f64>,
    /// The arithmetic that rays and shapes meet in
    #[arg(long, value_enum, default_value_t, value_name = "single|double")]
    precision: PrecisionArgument,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub enum PrecisionArgument {
    /// 32 bits
    Single,
    /// 64 bits
    #[default]
    Double,
}

/// What a scene is compiled with, and how its messages are shown.
#[derive(Debug, Args)]
pub struct SceneArguments {
    /// Search this folder for includes too; may be given several times
    #[arg(short = 'I', long = "include", value_name = "DIR")]
    pub include: Vec<PathBuf>,
    /// Declare a number before the scene starts; may be given several times
    #[arg(short = 'D', long = "declare", value_name = "NAME=VALUE", value_parser = declare)]
    declares: Vec<(String, f64)>,
    /// Raise or lower a limit: loop-turns, macro-depth, include-depth, nesting, objects, memory
    /// and string (in MiB), pixels
    #[arg(long = "limit", value_name = "NAME=N", value_parser = limit)]
    limits: Vec<(Limit, u64)>,
    /// Let the scene write files, below the current folder, once it has been read without errors
    #[arg(long)]
    pub allow_write: bool,
    /// Warn about what is probably a mistake, in `.pov` files too
    #[arg(long)]
    lint: bool,
    /// Treat warnings as errors
    #[arg(long)]
    deny_warnings: bool,
    /// Drop a warning: its code, or `all`; may be given several times, as may the next two
    #[arg(long, value_name = "CODE", value_parser = warning)]
    allow: Vec<Warnings>,
    /// Tell a warning, whatever the dialect
    #[arg(long, value_name = "CODE", value_parser = warning)]
    warn: Vec<Warnings>,
    /// Make an error of a warning
    #[arg(long, value_name = "CODE", value_parser = warning)]
    deny: Vec<Warnings>,
    /// How messages are shown
    #[arg(long, value_enum, default_value_t, value_name = "FORMAT")]
    pub message_format: messages::Format,
}

impl CheckArguments {
    /// The picture the scene is checked for, where one was named.
    pub fn frame(&self) -> Option<Frame> {
        self.size.map(|(width, height)| Frame::whole(width, height))
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
            Self::Explain(_) => None,
        }
    }
}

impl SceneArguments {
    pub fn messages(&self) -> Messages {
        Messages::new(self.message_format, self.deny_warnings)
    }

    /// What becomes of each warning: a code goes before `all`, and of one named twice the strictest holds.
    fn levels(&self, dialect: Dialect) -> Levels {
        let mut levels = Levels::new(self.lint || dialect == Dialect::Scene);
        let named =
            [(&self.allow, Level::Allow), (&self.warn, Level::Warn), (&self.deny, Level::Deny)];
        for (warnings, level) in named {
            for &warnings in warnings {
                match warnings {
                    Warnings::All => levels.set_all(level),
                    Warnings::Of(code) => levels.set(code, level),
                }
            }
        }
        levels
    }

    /// What the road takes, for a main file of this name.
    pub fn options(&self, file: &std::path::Path, frame: Option<Frame>) -> Options {
        let dialect = dialect(&file.to_string_lossy());
        let mut options = Options::new(dialect);
        options.levels = self.levels(dialect);
        options.evaluate.now = now();
        options.evaluate.declares = self.declares.clone();
        // `clock` is a word of the language, not a name.
        if let Some((_, clock)) = self.declares.iter().rfind(|(name, _)| name == "clock") {
            options.evaluate.clock = *clock;
        }
        if let Some(frame) = frame {
            (options.evaluate.width, options.evaluate.height) = (frame.width, frame.height);
            options.picture = Some((frame.width, frame.height));
        }
        for &(limit, n) in &self.limits {
            let small = u32::try_from(n).unwrap_or(u32::MAX);
            match limit {
                Limit::LoopTurns => options.evaluate.limits.loop_turns = n,
                Limit::MacroDepth => options.evaluate.limits.macro_depth = small,
                Limit::IncludeDepth => options.evaluate.limits.include_depth = small,
                Limit::Nesting => options.evaluate.limits.nesting = small,
                Limit::Objects => options.evaluate.limits.objects = n,
                Limit::Memory => options.evaluate.limits.memory = n,
                Limit::String => options.evaluate.limits.string = n,
                Limit::Pixels => {}
            }
        }
        options
    }

    fn most_pixels(&self) -> u64 {
        let pixels = self.limits.iter().rev().find(|(limit, _)| *limit == Limit::Pixels);
        pixels.map_or(MOST_PIXELS, |&(_, n)| n)
    }
}

impl PictureArguments {
    /// The picture and the part of it to trace; fails when the part is not inside.
    pub fn frame(&self, scene: &SceneArguments) -> Result<Frame, Failure> {
        self.frame.frame(scene)
    }

    /// What is asked of the plan.
    pub fn options(&self, frame: Frame) -> PlanOptions {
        let Self { antialias, depth, adc_bailout, precision, .. } = *self;
        let precision = match precision {
            PrecisionArgument::Single => Precision::Single,
            PrecisionArgument::Double => Precision::Double,
        };
        PlanOptions { frame, antialias, depth, adc_bailout, precision }
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
}
