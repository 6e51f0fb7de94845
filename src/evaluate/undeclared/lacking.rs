//! Names that a standard include declares, which was not read.

use crate::diagnostic::{Diagnostic, suggest};
use crate::source::{ExpansionKind, Span};
use crate::vocabulary::{standard_include_of, standard_names};

use super::super::{Evaluator, Here};
use super::MAIN;

/// The include whose names are used most, and misspelt.
const COLORS: &str = "colors.inc";

impl Evaluator<'_> {
    /// The standard include that declares `name`, where it was not read.
    pub(in crate::evaluate) fn lacking_include(&self, name: &str) -> Option<String> {
        standard_include_of(name).filter(|include| {
            // An author's own name of one letter is likelier.
            name.len() > 1 && !self.has_read(include)
        })
    }

    pub(super) fn has_read(&self, include: &str) -> bool {
        self.parsed.keys().any(|file| file.ends_with(include))
    }

    /// The name in a standard include which was not read that one with a capital is most likely meant as.
    pub(in crate::evaluate) fn lacking_near(&self, name: &str) -> Option<(&'static str, String)> {
        if !name.starts_with(char::is_uppercase) || name.len() < 3 {
            return None;
        }
        // Of all names of the includes too many are close to a short one: only those of colours are.
        let near = suggest::closest(name, standard_names(COLORS))?;
        (!suggest::are_of_a_series(name, near) && !self.has_read(COLORS))
            .then(|| (near, COLORS.to_owned()))
    }

    /// Where a name is missing in a file that the main file includes, the include belongs before that.
    pub(super) fn include_before(
        &self,
        here: &Here,
        diagnostic: Diagnostic,
        include: &str,
    ) -> Diagnostic {
        let expansions = &self.scene.expansions;
        let Some(outermost) = expansions
            .chain(here.expansion)
            .filter(|expansion| expansion.kind == ExpansionKind::Include)
            .last()
            .filter(|outermost| outermost.call.file == MAIN)
        else {
            return diagnostic;
        };
        let before = Span { end: outermost.call.start, ..outermost.call };
        diagnostic
            .help(format!(
                "write it before the include of `{}`, which takes it for granted",
                expansions.name(outermost)
            ))
            .fix(before, format!("#include \"{include}\"\n"))
    }
}
