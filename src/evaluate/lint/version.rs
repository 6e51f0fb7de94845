//! What a `.pov` file says it is written for, and what it lacks.

use crate::diagnostic::{Code, Diagnostic};
use crate::evaluate::{Evaluator, Unit};
use crate::scene::Dialect;
use crate::source::Span;
use crate::syntax::ast::{Ast, DirectiveKind, ExpressionKind, ItemKind};
use crate::vocabulary::{Word, is_standard_source};

const VERSION: &str = "#version";

impl Evaluator<'_> {
    /// Whether a file is not there that may say more.
    pub(in crate::evaluate) fn lacks_file(&self) -> bool {
        self.diagnostics.iter().any(|one| {
            matches!(one.code, Code::MissingInclude | Code::ForbiddenFile | Code::ForeignFile)
        })
    }

    /// Whether a scene with mistakes has a version, and a gamma, in its text; `None` where that is not certain.
    pub(in crate::evaluate) fn certainly_says(&self) -> Option<(bool, bool)> {
        let main = &self.sources.iter().next()?.1.text;
        let is_scene =
            main.contains("camera") && (main.contains("global_settings") || main.contains(VERSION));
        if !is_scene || self.halted || self.lacks_file() {
            return None;
        }
        // A standard include's own version is not the scene's.
        let own = self.sources.iter().filter(|(_, source)| !is_standard_source(&source.name));
        let own: Vec<&str> = own.map(|(_, source)| source.text.as_str()).collect();
        let says = |part: &str| own.iter().any(|text| text.contains(part));
        // `assumed_gama` is told as that.
        let says_version = own.iter().any(|text| {
            let mut directives = text.split('#').skip(1);
            directives.any(|directive| directive.trim_start().starts_with("version"))
        });
        Some((says_version, says("gamma") || says("assumed")))
    }

    /// A `.pov` file that does not say what it is written for; POV-Ray would read it as an old one.
    pub(in crate::evaluate) fn warn_of_old_version(&mut self, main: &Unit, says: (bool, bool)) {
        let file = main.ast.file;
        let missing = match says {
            _ if self.options.dialect == Dialect::Scene => return,
            (true, true) => return,
            (false, true) => "`#version`",
            (true, false) => "`assumed_gamma`",
            (false, false) => "`#version` and no `assumed_gamma`",
        };
        let preamble = Preamble::of(&main.ast);
        let old = preamble.old.filter(|_| says.0);
        let message = match old {
            Some(old) => format!(
                "`#version {}` is read as 3.7, and with gamma 1: the file has no {missing}",
                self.sources.text(old)
            ),
            None if says.0 => format!("the file has no {missing}; it is read with gamma 1"),
            None => {
                format!("the file has no {missing}; it is read as version 3.7 with gamma 1")
            }
        };
        let (label, help) = match old.is_none() && says.0 {
            true => (
                "POV-Ray warns of this, and may refuse it in versions to come",
                "write `global_settings { assumed_gamma 1 }`",
            ),
            false => (
                "POV-Ray would read this as an old file",
                "write `#version 3.7;` first, and `global_settings { assumed_gamma 1 }`",
            ),
        };
        let text = &self.sources.get(file).text;
        let settings = Word::GlobalSettings.name();
        let place = match (says, text.find(settings)) {
            ((true, false), Some(at)) => Span::new(file, at, at + settings.len()),
            _ => Span::new(file, 0, 0),
        };
        let mut diagnostic = Diagnostic::new(Code::OldVersion, message).at(place, label).help(help);
        // What is included is not a scene, and says nothing for itself.
        if !self.sources.get(file).name.to_lowercase().ends_with(".inc") {
            diagnostic = old.into_iter().fold(diagnostic, |told, old| told.fix(old, "3.7"));
            for (at, text) in preamble.completed(says.0, says.1) {
                diagnostic = diagnostic.fix(Span::new(file, at, at), text);
            }
        }
        self.diagnostics.push(diagnostic);
    }
}

/// Where the main file says what it is written for, outside of all branches.
#[derive(Default)]
struct Preamble {
    /// Behind the first `#version …;`.
    version: Option<u32>,
    /// Its number, typed, where that is less than 3.7.
    old: Option<Span>,
    /// Behind the brace of the first `global_settings`.
    settings: Option<u32>,
}

impl Preamble {
    /// What has to be inserted, and where.
    fn completed(&self, says_version: bool, says_gamma: bool) -> Vec<(usize, &'static str)> {
        let gamma = match (self.settings, self.version) {
            _ if says_gamma => None,
            (Some(at), _) => Some((at as usize, " assumed_gamma 1")),
            (None, Some(at)) => Some((at as usize, "\nglobal_settings { assumed_gamma 1 }")),
            (None, None) => Some((0, "global_settings { assumed_gamma 1 }\n")),
        };
        let version = (!says_version).then_some((0, "#version 3.7;\n"));
        match gamma {
            // Two insertions at one place are one.
            Some((0, _)) if !says_version => {
                vec![(0, "#version 3.7; global_settings { assumed_gamma 1 }\n")]
            }
            gamma => version.into_iter().chain(gamma).collect(),
        }
    }

    fn of(ast: &Ast) -> Self {
        let mut preamble = Self::default();
        for two in ast.items(ast.root).windows(2) {
            match (two[0].kind, two[1].kind) {
                (ItemKind::Directive(id), next)
                    if matches!(ast.directive(id).kind, DirectiveKind::Version(_)) =>
                {
                    if preamble.version.is_none() {
                        preamble.old = old_number(ast, &ast.directive(id).kind);
                    }
                    let ends = next == ItemKind::Semicolon;
                    let last = if ends { two[1].span } else { two[0].span };
                    preamble.version.get_or_insert(last.end);
                }
                (ItemKind::Word(Word::GlobalSettings), ItemKind::Block(_)) => {
                    preamble.settings.get_or_insert(two[1].span.start + 1);
                }
                _ => {}
            }
        }
        preamble
    }
}

/// Where the first `#version …;` of a file ends.
pub(in crate::evaluate) fn version_end(ast: &Ast) -> Option<u32> {
    Preamble::of(ast).version
}

/// The number of a `#version` before 3.7, where it is typed.
fn old_number(ast: &Ast, kind: &DirectiveKind) -> Option<Span> {
    let DirectiveKind::Version(number) = *kind else { return None };
    let number = ast.expression(number);
    let is_old = matches!(number.kind, ExpressionKind::Number(version) if version < 3.7);
    is_old.then_some(number.span)
}
