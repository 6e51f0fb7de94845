//! Exit codes and failures of the program.

use std::fmt::Display;
use std::process::ExitCode;

/// Reason for exiting; its value is the exit code.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Exit {
    Done = 0,
    /// The scene has errors.
    Scene = 1,
    /// The command line is invalid.
    Usage = 2,
    /// A file cannot be read or written.
    File = 3,
    /// A limit was exceeded.
    Limit = 4,
    /// A promise about accuracy or time was not kept.
    Promise = 5,
    /// Internal error.
    Panic = 70,
    /// The same may succeed another time: a part is missing, or its render was interrupted.
    Again = 75,
    Interrupted = 130,
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(exit as u8)
    }
}

/// Failure that ends the program, with the sentence that explains it.
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

    /// A failure of what may succeed another time.
    pub fn again(self) -> Self {
        Self { exit: Exit::Again, ..self }
    }

    pub fn help(mut self, help: impl Display) -> Self {
        self.help = Some(help.to_string());
        self
    }
}

/// Result of a command.
pub type Outcome = Result<Exit, Failure>;
