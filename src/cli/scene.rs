//! Defines the arguments shared by all commands that compile a scene: include folders, declarations, limits
//! and warning levels.

use std::path::{Path, PathBuf};

use clap::Args;
use lucarne::diagnostic::{Level, Levels};
use lucarne::plan::Frame;
use lucarne::road::Options;
use lucarne::scene::Dialect;

use super::language::{self, Language};
use super::messages::{self, Messages};
use super::stop;
use super::values::{Limit, Warnings, declare, limit, now, warning};

/// Default limit on the number of pixels, raised or lowered by `--limit pixels=N`.
///
/// A picture of this size takes about 2 GiB of memory.
const MOST_PIXELS: u64 = 1 << 27;

/// Arguments that control how a scene is compiled and how its messages are printed.
#[derive(Debug, Args)]
pub struct SceneArguments {
    /// Language of the scene [default: chosen by the extension, `.pov` or `.scene`, otherwise by the text]
    #[arg(long, value_enum, value_name = "pov|scene")]
    pub language: Option<Language>,
    /// Add a folder to search for include files; may be repeated
    #[arg(short = 'I', long = "include", value_name = "DIR")]
    pub include: Vec<PathBuf>,
    /// Declare a numeric identifier before the scene is evaluated; may be repeated
    #[arg(short = 'D', long = "declare", value_name = "NAME=VALUE", value_parser = declare)]
    declares: Vec<(String, f64)>,
    /// Set a limit: loop-turns, macro-depth, include-depth, nesting, objects, memory (in MiB), string (in
    /// MiB) or pixels; may be repeated
    #[arg(long = "limit", value_name = "NAME=N", value_parser = limit)]
    limits: Vec<(Limit, u64)>,
    /// Only let the scene read files in its own folder, the `-I` folders and the folders where the POV-Ray
    /// includes are installed
    #[arg(long)]
    pub sandbox: bool,
    /// Allow the scene to write files below the current directory, if it has no errors. Only `render`
    /// writes them; other commands list what would be written
    #[arg(long)]
    pub allow_write: bool,
    /// Enable all lints, also for `.pov` files
    #[arg(long)]
    lint: bool,
    /// Treat warnings as errors
    #[arg(long)]
    deny_warnings: bool,
    /// Disable a warning, given by its code; `all` disables all warnings; accepts several codes separated
    /// by commas, and may be repeated (as may `--warn` and `--deny`)
    #[arg(long, value_name = "CODE", value_parser = warning, value_delimiter = ',')]
    allow: Vec<Warnings>,
    /// Enable a warning in every dialect
    #[arg(long, value_name = "CODE", value_parser = warning, value_delimiter = ',')]
    warn: Vec<Warnings>,
    /// Report a warning as an error
    #[arg(long, value_name = "CODE", value_parser = warning, value_delimiter = ',')]
    deny: Vec<Warnings>,
    /// Output format for diagnostics
    #[arg(long, value_enum, default_value_t, value_name = "FORMAT")]
    pub message_format: messages::Format,
}

impl SceneArguments {
    pub fn messages(&self) -> Messages {
        let by_name = |warnings: &Warnings| match warnings {
            Warnings::Of(code) if !self.deny.contains(warnings) => Some(*code),
            Warnings::Of(_) | Warnings::All => None,
        };
        let allowed = self.allow.iter().filter_map(by_name).collect();
        Messages::new(self.message_format, self.deny_warnings).allowing(allowed)
    }

    /// Returns the level of each warning. A code takes precedence over `all`; if one code is given several
    /// levels, the strictest applies.
    fn levels(&self, dialect: Dialect) -> Levels {
        let mut levels = Levels::new(dialect == Dialect::Scene);
        if self.lint {
            levels.set_all(Level::Warn);
        }
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

    /// Returns the language of a main file, and prints a note if it was detected from the text.
    pub fn dialect(&self, file: &Path, text: &[u8]) -> Dialect {
        let (dialect, note) = language::of(self.language, file, text);
        messages::eprint(&note.unwrap_or_default());
        dialect
    }

    /// Returns the compile options for a main file in this language.
    pub fn options(&self, dialect: Dialect, frame: Option<Frame>) -> Options {
        let mut options = Options::new(dialect).declaring(self.declares.clone());
        if let Some(frame) = frame {
            options = options.for_picture((frame.width, frame.height));
        }
        options.levels = self.levels(dialect);
        options.evaluate.now = now();
        options.evaluate.interrupt = stop::interrupt();
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

    /// Returns the maximum number of pixels to trace.
    pub fn most_pixels(&self) -> u64 {
        let pixels = self.limits.iter().rev().find(|(limit, _)| *limit == Limit::Pixels);
        pixels.map_or(MOST_PIXELS, |&(_, n)| n)
    }
}
