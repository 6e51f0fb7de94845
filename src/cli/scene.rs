//! What every command takes that compiles a scene: folders, declarations, limits, levels of warnings.

use std::path::{Path, PathBuf};

use clap::Args;
use lucarne::diagnostic::{Level, Levels};
use lucarne::plan::Frame;
use lucarne::road::Options;
use lucarne::scene::Dialect;

use super::language::{self, Language};
use super::messages::{self, Messages};
use super::progress;
use super::values::{Limit, Warnings, declare, limit, now, warning};

/// The most pixels a picture has unless `--limit pixels=N` says otherwise.
///
/// They take about 8 GiB of memory.
const MOST_PIXELS: u64 = 1 << 27;

/// What a scene is compiled with, and how its messages are shown.
#[derive(Debug, Args)]
pub struct SceneArguments {
    /// The language of the scene [default: by the end of its name, `.pov` or `.scene`, else by its text]
    #[arg(long, value_enum, value_name = "pov|scene")]
    pub language: Option<Language>,
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
    /// Let the scene read only files in its own folder, in the `-I` folders and where POV-Ray's includes
    /// are installed
    #[arg(long)]
    pub sandbox: bool,
    /// Let the scene write files, below the current folder, once it has been read without errors.
    /// (`render` writes them; other commands say what it would write)
    #[arg(long)]
    pub allow_write: bool,
    /// Warn about all that is probably a mistake, in `.pov` files too
    #[arg(long)]
    lint: bool,
    /// Treat warnings as errors
    #[arg(long)]
    deny_warnings: bool,
    /// Drop a warning: its code, or `all`, or several with commas; may be given several times, as
    /// may the next two
    #[arg(long, value_name = "CODE", value_parser = warning, value_delimiter = ',')]
    allow: Vec<Warnings>,
    /// Tell a warning, whatever the dialect
    #[arg(long, value_name = "CODE", value_parser = warning, value_delimiter = ',')]
    warn: Vec<Warnings>,
    /// Make an error of a warning
    #[arg(long, value_name = "CODE", value_parser = warning, value_delimiter = ',')]
    deny: Vec<Warnings>,
    /// How messages are shown
    #[arg(long, value_enum, default_value_t, value_name = "FORMAT")]
    pub message_format: messages::Format,
}

impl SceneArguments {
    pub fn messages(&self) -> Messages {
        Messages::new(self.message_format, self.deny_warnings)
    }

    /// What becomes of each warning: a code goes before `all`, and of one named twice the strictest holds.
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

    /// Returns the language of a main file, and says so where only its text decided it.
    pub fn dialect(&self, file: &Path, text: &[u8]) -> Dialect {
        let (dialect, note) = language::of(self.language, file, text);
        messages::eprint(&note.unwrap_or_default());
        dialect
    }

    /// What the road takes, for a main file of this language.
    pub fn options(&self, dialect: Dialect, frame: Option<Frame>) -> Options {
        let mut options = Options::new(dialect);
        options.levels = self.levels(dialect);
        options.evaluate.now = now();
        options.evaluate.interrupt = progress::interrupt();
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

    /// The most pixels a picture may have.
    pub fn most_pixels(&self) -> u64 {
        let pixels = self.limits.iter().rev().find(|(limit, _)| *limit == Limit::Pixels);
        pixels.map_or(MOST_PIXELS, |&(_, n)| n)
    }
}
