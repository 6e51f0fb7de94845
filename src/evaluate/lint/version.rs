//! The version and gamma that a `.pov` file declares, or lacks.

use crate::color::{Clearness, Color, Gamma};
use crate::diagnostic::{Code, Diagnostic};
use crate::evaluate::{Evaluator, Unit};
use crate::noise::NoiseGenerator;
use crate::scene::{Camera, Dialect};
use crate::source::Span;
use crate::syntax::ast::{Ast, DirectiveKind, ExpressionKind, ItemKind};
use crate::vocabulary::{Word, is_standard_source};

const VERSION: &str = "#version";

/// The version since which noise is range-corrected (measured on POV-Ray 3.7).
const CORRECTED_SINCE: f64 = 3.5;

/// The version since which each layer of a texture tints the light behind.
///
/// **Source:** POV-Ray 3.7's behaviour, measured; its manual says 3.5.
const TINTED_SINCE: f64 = 3.11;

/// The version from which a scene without `assumed_gamma` has linear colours, and transparent colours work as
/// today.
const TODAY: f64 = 3.7;

/// The version assumed for a scene without `#version`.
const YESTERDAY: &str = "3.6";

impl Evaluator<'_> {
    /// Returns whether a file that may declare more is missing.
    pub(in crate::evaluate) fn lacks_file(&self) -> bool {
        self.diagnostics.iter().any(|one| {
            matches!(one.code, Code::MissingInclude | Code::ForbiddenFile | Code::ForeignFile)
        })
    }

    /// Returns whether a scene with mistakes has a version and a gamma in its text; `None` if uncertain.
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
        // `assumed_gama` is reported as such.
        let says_version = self.options.version.is_some()
            || own.iter().any(|text| {
                let mut directives = text.split('#').skip(1);
                directives.any(|directive| directive.trim_start().starts_with("version"))
            });
        Some((says_version, says("gamma") || says("assumed")))
    }

    /// Returns whether POV-Ray 3.7 treats the scene as one of an older version: the language version at the
    /// end of the text is below 3.7, or no file has a `#version` (measured).
    pub(in crate::evaluate) fn is_old(&self) -> bool {
        self.options.dialect == Dialect::Pov && (!self.has_version || self.is_before(TODAY))
    }

    /// Returns whether the language version is below this one, rounded to hundredths (measured).
    pub(in crate::evaluate) fn is_before(&self, version: f64) -> bool {
        (self.version * 100.0).round() < (version * 100.0).round()
    }

    /// Sets the noise generator of the language version, unless one is written. In POV-Ray 3.7 (measured) that of
    /// the version at the end applies; here each pattern has that of the version before it.
    pub(in crate::evaluate) fn default_noise(&mut self) {
        if self.options.dialect == Dialect::Pov && !self.says_noise {
            self.noise = match self.is_before(CORRECTED_SINCE) {
                true => NoiseGenerator::Plateaus,
                false => NoiseGenerator::default(),
            };
        }
    }

    /// Returns whether the scene uses what older versions parse or render differently, so that another
    /// `#version` changes the image.
    fn looks_old(&self) -> bool {
        let filters = |color: Color| color.filter != 0.0;
        self.scene.settings.clearness == Clearness::Old
            && (self.has_bare_textures
                || self.scene.background.as_ref().is_some_and(|back| back.color.transmit != 0.0)
                || self.scene.cameras.last().is_some_and(Camera::order_matters)
                || self.scene.pigments.iter().any(|pigment| pigment.kind.colors().any(filters)))
    }

    /// Applies an old version's rules to the scene: a `.pov` has its own kind of transparent colours, and
    /// without `assumed_gamma` the image is shown without gamma correction, as by POV-Ray 3.7: pixel for
    /// pixel `assumed_gamma srgb` (measured).
    pub(in crate::evaluate) fn note_old_version(&mut self) {
        if self.is_old() {
            self.scene.settings.clearness = Clearness::Old;
        }
        let is_pov = self.options.dialect == Dialect::Pov;
        self.scene.settings.untinted_layers = is_pov && self.is_before(TINTED_SINCE);
        // A colour in sRGB before `assumed_gamma`, which POV-Ray refuses, has been made linear.
        if self.is_old() && !self.says_gamma && self.srgb_before_gamma.is_none() {
            self.scene.settings.assumed_gamma = Gamma::Srgb;
        }
    }

    /// Warns of a `.pov` file that does not declare its version.
    pub(in crate::evaluate) fn warn_of_old_version(&mut self, main: &Unit, says: (bool, bool)) {
        let file = main.ast.file;
        let missing = match says {
            _ if self.options.dialect == Dialect::Scene => return,
            (true, true) => return,
            (false, true) => "`#version`",
            (true, false) => "`assumed_gamma`",
            (false, false) => "`#version` and no `assumed_gamma`",
        };
        let gamma = match self.is_old() {
            true => {
                AssumedGamma { value: "srgb", read: "`assumed_gamma srgb`, as POV-Ray reads it" }
            }
            false => AssumedGamma { value: "1", read: "`assumed_gamma 1`" },
        };
        let preamble = Preamble::of(&main.ast);
        let old = preamble.old.filter(|_| says.0);
        let looks_old = self.looks_old();
        let version = if looks_old { YESTERDAY } else { "3.7" };
        let read = gamma.read;
        let message = match old {
            Some(old) => format!(
                "`#version {}` is read as 3.7, and with {read}: the file has no {missing}",
                self.sources.text(old)
            ),
            None if says.0 => format!("the file has no {missing}; it is read with {read}"),
            None if says.1 => format!("the file has no {missing}; it is read as version 3.7"),
            None => format!("the file has no {missing}; it is read as version 3.7 with {read}"),
        };
        let help = match (old.is_none() && says.0, says.1) {
            (true, _) => format!("write `global_settings {{ {} }}`", gamma.written()),
            (false, true) => format!("write `#version {version};` first"),
            (false, false) => {
                let settings = format!("`global_settings {{ {} }}`", gamma.written());
                format!("write `#version {version};` first, and {settings}")
            }
        };
        let label = match self.is_old() {
            true => "POV-Ray takes this for an old file",
            false => "POV-Ray warns of this, and may refuse it in versions to come",
        };
        let text = &self.sources.get(file).text;
        let settings = Word::GlobalSettings.name();
        let place = match (says, text.find(settings)) {
            ((true, false), Some(at)) => Span::new(file, at, at + settings.len()),
            _ => Span::new(file, 0, 0),
        };
        let mut diagnostic = Diagnostic::new(Code::OldVersion, message).at(place, label).help(help);
        // An included file is not a scene, and needs no version of its own.
        if !self.sources.get(file).name.to_lowercase().ends_with(".inc") {
            let old = old.filter(|_| !looks_old);
            diagnostic = old.into_iter().fold(diagnostic, |told, old| told.fix(old, "3.7"));
            for (at, text) in preamble.completed(says, version, &gamma) {
                diagnostic = diagnostic.fix(Span::new(file, at, at), text);
            }
        }
        self.diagnostics.push(diagnostic);
    }
}

/// The gamma assumed without a declaration: the word of the language, and its description in a message.
struct AssumedGamma {
    value: &'static str,
    read: &'static str,
}

impl AssumedGamma {
    fn written(&self) -> String {
        format!("{} {}", Word::AssumedGamma.name(), self.value)
    }
}

/// Where the main file declares its version and gamma, outside all branches.
#[derive(Default)]
struct Preamble {
    /// Position after the first `#version …;`.
    version: Option<u32>,
    /// Span of its number, if that is a literal below 3.7.
    old: Option<Span>,
    /// Position after the brace of the first `global_settings`.
    settings: Option<u32>,
}

impl Preamble {
    /// Adds the fixes that insert the missing declarations.
    fn completed(
        &self,
        (says_version, says_gamma): (bool, bool),
        version: &str,
        gamma: &AssumedGamma,
    ) -> Vec<(usize, String)> {
        let written = gamma.written();
        let block = format!("global_settings {{ {written} }}");
        let gamma = match (self.settings, self.version) {
            _ if says_gamma => None,
            (Some(at), _) => Some((at as usize, format!(" {written}"))),
            (None, Some(at)) => Some((at as usize, format!("\n{block}"))),
            (None, None) => Some((0, format!("{block}\n"))),
        };
        let directive = (!says_version).then(|| (0, format!("#version {version};\n")));
        match gamma {
            // Two insertions at one position are merged.
            Some((0, _)) if !says_version => vec![(0, format!("#version {version}; {block}\n"))],
            gamma => directive.into_iter().chain(gamma).collect(),
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

/// Returns where the first `#version …;` of a file ends.
pub(in crate::evaluate) fn version_end(ast: &Ast) -> Option<u32> {
    Preamble::of(ast).version
}

/// Returns the span of a literal `#version` number below 3.7.
fn old_number(ast: &Ast, kind: &DirectiveKind) -> Option<Span> {
    let DirectiveKind::Version(number) = *kind else { return None };
    let number = ast.expression(number);
    let is_old = matches!(number.kind, ExpressionKind::Number(version) if version < 3.7);
    is_old.then_some(number.span)
}
