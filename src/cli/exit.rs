//! What the program tells the system when it ends.

use std::fmt::Display;
use std::process::ExitCode;

/// Why the program ends; its number is the exit code.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Exit {
    Done = 0,
    /// The scene has errors.
    Scene = 1,
    /// The command line makes no sense.
    Usage = 2,
    /// A file cannot be read or written.
    File = 3,
    /// A limit stopped it.
    Limit = 4,
    /// A promise about accuracy or time was missed.
    Promise = 5,
    /// A bug of ours.
    Panic = 70,
    Interrupted = 130,
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(exit as u8)
    }
}

/// Something that ends the program, and the sentence that says why.
#[derive(Debug)]
pub struct Failure {
    pub exit: Exit,
    pub sentence: String,
    pub help: Option<String>,
}

impl Failure {
    pub fn usage(sentence: impl Display) -> Self {
        Self { exit: Exit::Usage, sentence: sentence.to_string(), help: None }
    }

    pub fn file(sentence: impl Display) -> Self {
        Self { exit: Exit::File, sentence: sentence.to_string(), help: None }
    }

    pub fn limit(sentence: impl Display) -> Self {
        Self { exit: Exit::Limit, sentence: sentence.to_string(), help: None }
    }

    pub fn help(mut self, help: impl Display) -> Self {
        self.help = Some(help.to_string());
        self
    }
}

/// What a subcommand ends with.
pub type Outcome = Result<Exit, Failure>;

/// The system's reason as a clause: `permission denied`, without its number.
pub fn reason(error: &std::io::Error) -> String {
    let text = error.to_string();
    let text = text.split(" (os error").next().unwrap_or(&text);
    let mut chars = text.chars();
    let first = chars.next().map(|c| c.to_lowercase().to_string()).unwrap_or_default();
    first + chars.as_str()
}
