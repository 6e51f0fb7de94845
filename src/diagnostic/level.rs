//! What becomes of each warning: dropped, told, or as bad as an error.
//!
//! **Invariant:** only codes that warn have a level; an error cannot be allowed.

use std::collections::BTreeMap;

use super::{Code, Severity};

#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// Dropped.
    Allow,
    /// Told; the picture is made all the same.
    Warn,
    /// Told as an error; no picture is made.
    Deny,
}

/// The level of every code that warns.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Levels {
    /// Of all that were not named; where it is not said, lints are dropped and other warnings told.
    lints: Option<Level>,
    named: BTreeMap<Code, Level>,
}

impl Levels {
    /// All lints told, or none.
    pub fn new(lints: bool) -> Self {
        Self { lints: lints.then_some(Level::Warn), named: BTreeMap::new() }
    }

    /// Sets every code that is not named.
    pub fn set_all(&mut self, level: Level) {
        self.lints = Some(level);
    }

    pub fn set(&mut self, code: Code, level: Level) {
        self.named.insert(code, level);
    }

    /// Sets a code that is not named.
    pub fn set_unnamed(&mut self, code: Code, level: Level) {
        self.named.entry(code).or_insert(level);
    }

    /// Of a code that warns; of an error and of a note, none.
    pub fn of(&self, code: Code) -> Option<Level> {
        let unnamed = match code.is_lint() {
            true => self.lints.unwrap_or(Level::Allow),
            false => self.lints.unwrap_or(Level::Warn),
        };
        code.warns().then(|| self.named.get(&code).copied().unwrap_or(unnamed))
    }
}

impl Level {
    /// As what a lint of this level is told.
    pub fn severity(self) -> Option<Severity> {
        match self {
            Self::Allow => None,
            Self::Warn => Some(Severity::Warning),
            Self::Deny => Some(Severity::Error),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_named_warning_has_its_own_level_and_an_error_none() {
        let mut levels = Levels::new(false);
        assert_eq!(levels.of(Code::ColorRange), Some(Level::Allow));
        levels.set(Code::ColorRange, Level::Deny);
        levels.set_all(Level::Warn);
        assert_eq!(levels.of(Code::ColorRange), Some(Level::Deny));
        assert_eq!(levels.of(Code::NoLight), Some(Level::Warn));
        assert_eq!(levels.of(Code::UnknownWord), None);
        assert_eq!(Levels::new(false).of(Code::AuthorWarning), Some(Level::Warn));
    }
}
