//! Lints: what a right scene might contain, and probably does not.

use crate::color::Rgb;
use crate::diagnostic::suggest::closest;
use crate::diagnostic::{Code, Diagnostic};
use crate::scene::Dialect;
use crate::source::{FileId, Site, Span};
use crate::vocabulary::{PREDECLARED, Word};

use super::scope::Owner;
use super::stream::Token;
use super::value::Value;
use super::{Evaluator, Here, Unit};

/// Angles that people write in radians: fractions of π with at least two digits after the point.
const RADIANS: [f64; 8] = [
    std::f64::consts::FRAC_PI_6,
    std::f64::consts::FRAC_PI_4,
    std::f64::consts::FRAC_PI_3,
    std::f64::consts::FRAC_PI_2,
    std::f64::consts::PI * 2.0 / 3.0,
    std::f64::consts::PI * 3.0 / 4.0,
    std::f64::consts::PI,
    std::f64::consts::TAU,
];

impl Evaluator<'_> {
    /// Names that were declared in the main file and never used: the scene knows them, and there is
    /// a lint for each.
    pub(super) fn lint_declarations(&mut self, main: &Unit) {
        let mut unused: Vec<(String, Site, Diagnostic)> = Vec::new();
        for (name, declared, value) in self.scopes.declarations() {
            let theirs = match declared.of {
                Owner::Main => true,
                // A branch that was not run may use it, or a macro that this one calls.
                Owner::Macro => self.is_only_declared(name, main),
                Owner::Other => false,
            };
            if declared.used || !theirs || name.starts_with('_') {
                continue;
            }
            // A word of the language cannot be declared; that has been told.
            if Word::from_name(name).is_some() {
                continue;
            }
            let site = declared.site;
            let diagnostic = match value {
                None if declared.of == Owner::Macro => Diagnostic::new(
                    Code::UnusedDeclaration,
                    format!("`{name}` is declared in a macro, and never used"),
                )
                .at(site.span, "declared here"),
                Some(Value::Broken) | None => continue,
                Some(Value::Object(_)) => Diagnostic::new(
                    Code::NeverPlaced,
                    format!("`{name}` is declared and never placed in the scene"),
                )
                .at(site.span, "this object is not seen")
                .help(format!("place it with `object {{ {name} }}`")),
                Some(_) => Diagnostic::new(
                    Code::UnusedDeclaration,
                    format!("`{name}` is declared and never used"),
                )
                .at(site.span, "declared here"),
            };
            unused.push((name.to_owned(), site, diagnostic));
        }
        unused.sort_by_key(|(_, site, _)| site.span);
        for (name, site, diagnostic) in unused {
            self.scene.unused.push((name, site));
            self.diagnostics.push(diagnostic);
        }
    }

    /// Whether the main file has this name only where it declares it. A comment that has it counts for
    /// a use: better silent than wrong.
    fn is_only_declared(&self, name: &str, main: &Unit) -> bool {
        let declared = main.declarations().filter(|(other, _)| main.ast.name(*other) == name);
        let text = &self.sources.get(main.ast.file).text;
        let words = text.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_'));
        words.filter(|word| *word == name).count() == declared.count()
    }

    /// Names given from outside that no file of the scene has.
    pub(super) fn lint_options(&mut self, main: &Unit) {
        let options = self.options;
        for (name, _) in &options.declares {
            // `clock` and the like have a value without being declared.
            if Word::from_name(name).is_some() || PREDECLARED.iter().any(|(known, _)| known == name)
            {
                continue;
            }
            let has = |unit: &Unit| unit.ast.names.iter().any(|known| known == name);
            if has(main) || self.parsed.values().any(|unit| has(unit)) {
                continue;
            }
            let message = format!("`-D {name}` declares a name that the scene never uses");
            let mut diagnostic = Diagnostic::new(Code::UnusedDeclaration, message);
            let used = main.ast.names.iter().map(String::as_str);
            if let Some(near) = closest(name, used) {
                diagnostic = diagnostic.help(format!("did you mean `-D {near}=…`?"));
            }
            self.diagnostics.push(diagnostic);
        }
    }

    /// A `.pov` file that does not say what it is written for; POV-Ray would read it as an old one.
    pub(super) fn warn_of_old_version(&mut self, main: FileId) {
        let missing = match (self.says_version, self.says_gamma) {
            _ if self.options.dialect == Dialect::Scene => return,
            (true, true) => return,
            (false, true) => "`#version`",
            (true, false) => "`assumed_gamma`",
            (false, false) => "`#version` and no `assumed_gamma`",
        };
        let message = format!("the file has no {missing}; it is read as version 3.7 with gamma 1");
        let diagnostic = Diagnostic::new(Code::OldVersion, message)
            .at(Span::new(main, 0, 0), "POV-Ray would read this as an old file")
            .help("write `#version 3.7;` first, and `global_settings { assumed_gamma 1 }`");
        self.diagnostics.push(diagnostic);
    }

    /// Degrees are wanted; these look like radians.
    pub(super) fn lint_degrees(&mut self, here: &Here, span: Span, degrees: &[f64]) {
        let text = self.sources.text(span);
        let mentions_pi =
            text.split(|c: char| !c.is_alphanumeric() && c != '_').any(|word| word == "pi")
                && !text.contains("degrees")
                && !text.contains("180");
        let is_radians =
            |value: f64| RADIANS.iter().any(|angle| (value.abs() - angle).abs() < 0.0011);
        let literal = text.chars().all(|c| !c.is_alphabetic() || "xyz".contains(c));
        let largest = degrees.iter().fold(0.0f64, |most, value| most.max(value.abs()));
        if largest == 0.0 || largest > 6.5 {
            return;
        }
        let looks = degrees.iter().any(|value| is_radians(*value));
        if mentions_pi || (literal && looks) {
            let diagnostic = Diagnostic::new(
                Code::SuspiciousUnit,
                "this angle looks like radians, and is taken as degrees",
            )
            .at(span, format!("{largest:.4} degrees"))
            .help("write degrees, or `degrees(…)` around it");
            self.report(here, diagnostic);
        }
    }

    /// A camera's angle in degrees. Of less than π, and with a fraction, it is rather one in radians than
    /// that of a telescope.
    pub(super) fn lint_camera_angle(&mut self, here: &Here, span: Span, degrees: f64) {
        let text = self.sources.text(span);
        let literal = text.chars().all(|c| c.is_ascii_digit() || c == '.');
        if !(literal && degrees.fract() != 0.0 && (0.2..3.2).contains(&degrees)) {
            return self.lint_degrees(here, span, &[degrees]);
        }
        let meant = degrees.to_degrees();
        let diagnostic = Diagnostic::new(
            Code::SuspiciousUnit,
            "this angle looks like radians, and is taken as degrees",
        )
        .at(span, format!("{degrees} degrees: the view of a telescope"))
        .help(format!("write degrees, or `degrees({text})`, which is {meant:.1}"));
        self.report(here, diagnostic);
    }

    /// A colour is 0 to 1; this one looks like 0 to 255.
    pub(super) fn lint_color_range(&mut self, here: &Here, span: Span, rgb: [f64; 3]) {
        let whole = rgb.iter().all(|c| c.fract() == 0.0 && (0.0..=255.0).contains(c));
        let largest = rgb.iter().fold(0.0f64, |most, c| most.max(*c));
        // Lights may be brighter than 1, and a grey of whole numbers may be meant so; not on a surface.
        let gray = rgb[0] == rgb[1] && rgb[1] == rgb[2];
        if !(whole && largest >= 16.0) || gray && largest != 255.0 && !self.in_pigment() {
            return;
        }
        let text = self.sources.text(span);
        let literal = |c: char| c.is_ascii_digit() || c == '.';
        let vector = text.starts_with('<') && text.ends_with('>');
        let written = match vector || text.chars().all(literal) {
            true => text.to_owned(),
            false => format!("<{}, {}, {}>", rgb[0], rgb[1], rgb[2]),
        };
        let divided = format!("{written}/255");
        let mut diagnostic = Diagnostic::new(
            Code::ColorRange,
            "this colour looks as if written as 0 to 255; colours are 0 to 1",
        )
        .at(span, "far brighter than white")
        .help(format!("write `{divided}`"));
        if written == text {
            diagnostic = diagnostic.fix(span, divided);
        }
        self.report(here, diagnostic);
    }

    /// Whether what is read now is the colour of a surface.
    pub(super) fn in_pigment(&self) -> bool {
        let word = |span: &Span| self.sources.text(*span);
        self.openers
            .last()
            .is_some_and(|span| matches!(word(span), "pigment" | "color_map" | "colour_map"))
    }

    /// A `checker` with one of its two colours.
    pub(super) fn lint_missing_color(&mut self, token: &Token) {
        let diagnostic = Diagnostic::new(
            Code::MissingColor,
            "this `checker` has one colour; the other is green by default",
        )
        .at(token.span, "expected two colours after it")
        .help("write both: `checker rgb 1, rgb 0`");
        self.report(&token.here, diagnostic);
    }

    /// A surface that takes light away, or mirrors more than it gets.
    pub(super) fn lint_strength(&mut self, here: &Here, span: Span, word: Word, light: Rgb) {
        let name = word.name();
        let (message, label) = if light.red.min(light.green).min(light.blue) < 0.0 {
            (format!("a negative `{name}` takes light away"), "expected 0 or more")
        } else if word == Word::Reflection && light.largest() > 1.0 {
            (format!("this `{name}` gives back more light than arrives"), "expected 0 to 1")
        } else {
            return;
        };
        self.report(here, Diagnostic::new(Code::UnlikelyFinish, message).at(span, label));
    }

    pub(super) fn lint_negative_radius(&mut self, here: &Here, span: Span, radius: f64) {
        let diagnostic = Diagnostic::new(
            Code::NegativeSize,
            format!("the radius is {radius}; {} is used", -radius),
        )
        .at(span, "a negative size");
        self.report(here, diagnostic);
    }

    pub(super) fn lint_legacy(&mut self, here: &Here, span: Span, message: &str, help: &str) {
        let diagnostic =
            Diagnostic::new(Code::LegacyForm, message).at(span, "an old form").help(help);
        self.report(here, diagnostic);
    }
}
