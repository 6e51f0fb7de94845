//! Sets the level of each warning: dropped, reported, or treated as an error.
//!
//! **Invariant:** only codes that may warn have a level; an error cannot be allowed.

use std::collections::BTreeMap;

use super::{Code, Severity};

/// What becomes of a warning.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// Not reported.
    Allow,
    /// Reported as a warning; the picture is still rendered.
    Warn,
    /// Reported as an error; no picture is rendered.
    Deny,
}

/// The level of every code that may warn.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Levels {
    /// Whether all lints except the quiet ones are reported; otherwise, only the sure ones are.
    lints: bool,
    /// Whether the main file is a complete scene, for which an empty picture is always reported.
    whole: bool,
    /// Level of all codes that are not named; by default, warnings other than lints are reported.
    all: Option<Level>,
    named: BTreeMap<Code, Level>,
}

impl Levels {
    /// With `lints`, reports all lints except the quiet ones; otherwise, only the sure ones.
    pub fn new(lints: bool) -> Self {
        Self { lints, ..Self::default() }
    }

    /// Marks the main file as a complete scene rather than an include file.
    pub(crate) fn of_whole_scene(&mut self) {
        self.whole = true;
    }

    /// Sets the level of every code that is not named.
    pub fn set_all(&mut self, level: Level) {
        self.all = Some(level);
    }

    /// Sets the level of a code.
    pub fn set(&mut self, code: Code, level: Level) {
        self.named.insert(code, level);
    }

    /// Sets the level of a code unless it is already named.
    pub fn set_unnamed(&mut self, code: Code, level: Level) {
        self.named.entry(code).or_insert(level);
    }

    /// Returns the level of a code that may warn; `None` for errors and notes.
    pub fn of(&self, code: Code) -> Option<Level> {
        let of_whole = matches!(code, Code::NoLight | Code::EmptyScene);
        let is_told = !code.is_lint()
            || code.is_sure()
            || self.lints && !code.is_quiet()
            || self.whole && of_whole;
        let unnamed = self.all.unwrap_or(if is_told { Level::Warn } else { Level::Allow });
        code.may_warn().then(|| self.named.get(&code).copied().unwrap_or(unnamed))
    }
}

impl Level {
    /// Returns the severity at which a lint of this level is reported, if any.
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
        assert_eq!(levels.of(Code::UnusedDeclaration), Some(Level::Allow));
        levels.set(Code::UnusedDeclaration, Level::Deny);
        levels.set_all(Level::Warn);
        assert_eq!(levels.of(Code::UnusedDeclaration), Some(Level::Deny));
        assert_eq!(levels.of(Code::NoLight), Some(Level::Warn));
        assert_eq!(levels.of(Code::UnclosedBlock), None);
        assert_eq!(Levels::new(false).of(Code::AuthorWarning), Some(Level::Warn));
    }

    #[test]
    fn a_sure_lint_is_told_of_all_and_can_be_silenced() {
        let mut levels = Levels::new(false);
        assert_eq!(levels.of(Code::SuspiciousUnit), Some(Level::Warn));
        levels.set_all(Level::Allow);
        assert_eq!(levels.of(Code::SuspiciousUnit), Some(Level::Allow));
    }

    #[test]
    fn a_quiet_lint_is_told_where_it_or_all_are_asked_for() {
        let mut levels = Levels::new(true);
        assert_eq!(levels.of(Code::CoincidingFaces), Some(Level::Allow));
        levels.set(Code::CoincidingFaces, Level::Warn);
        assert_eq!(levels.of(Code::CoincidingFaces), Some(Level::Warn));
        let mut levels = Levels::new(false);
        levels.set_all(Level::Deny);
        assert_eq!(levels.of(Code::CoincidingFaces), Some(Level::Deny));
    }
}
