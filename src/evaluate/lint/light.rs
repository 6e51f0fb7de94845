//! Spotlight keywords that have no effect, or contradict each other.

use super::is_literal;
use crate::diagnostic::{Code, Diagnostic};
use crate::evaluate::Evaluator;
use crate::evaluate::block::Given;
use crate::evaluate::stream::Token;
use crate::scene::{Beam, LightKind, ObjectId, ObjectKind, Operation};
use crate::vocabulary::Word;

/// Literal `radius` or `falloff` of a beam in radians: from 6° to a right angle. Narrower beams in degrees
/// are searchlights.
const RADIANS: std::ops::Range<f64> = 0.1..1.6;
/// At least one angle of such a beam is this wide; a narrower beam in degrees may be intended.
const WIDE: f64 = 0.4;

/// The beam settings of a light, collected while it is read.
#[derive(Default)]
pub(in crate::evaluate) struct Cone {
    /// `point_at`, `radius`, `falloff` and `tightness`, as written.
    words: Vec<Token>,
    radius: Option<Given<f64>>,
    falloff: Option<Given<f64>>,
}

impl Cone {
    pub fn word(&mut self, token: &Token) {
        self.words.push(token.clone());
    }

    /// Records a keyword of the light and its number.
    pub fn say(&mut self, token: &Token, word: Word, given: &Given<f64>) {
        match word {
            Word::Radius => self.radius = Some(given.clone()),
            Word::Falloff => self.falloff = Some(given.clone()),
            Word::Tightness => {}
            _ => return,
        }
        self.word(token);
    }

    fn angles(&self) -> impl Iterator<Item = &Given<f64>> {
        self.radius.iter().chain(&self.falloff)
    }
}

impl Evaluator<'_> {
    /// Checks a light after it has been read.
    pub(in crate::evaluate) fn lint_light(&mut self, cone: &Cone, light: &LightKind) {
        match light {
            LightKind::Point { .. } => self.lint_no_beam(cone),
            LightKind::Spotlight { beam, .. } => {
                let mut told = false;
                for given in cone.angles() {
                    told |= self.lint_angle_in_radians(given);
                }
                if !told && !self.lint_beam_in_radians(cone) {
                    self.lint_inside_out(cone, beam, "degrees");
                }
            }
            LightKind::Cylinder { beam, .. } => self.lint_inside_out(cone, beam, "wide"),
            LightKind::Parallel { .. } | LightKind::Direction { .. } => {}
        }
    }

    /// Warns of a light in a `difference` or an `intersection`: it has no inside to clip.
    pub(in crate::evaluate) fn lint_light_of_csg(
        &mut self,
        word: Word,
        operation: Operation,
        children: &[ObjectId],
    ) {
        if operation == Operation::Merge {
            return;
        }
        for &child in children {
            let object = &self.scene.objects[child.index()];
            if !matches!(object.kind, ObjectKind::LightSource(_)) {
                continue;
            }
            let site = object.site;
            let name = word.name();
            let message = format!("a `light_source` has no inside that a `{name}` could cut");
            let diagnostic = Diagnostic::new(Code::UnlikelyLight, message)
                .at(site.span, "it shines as if it stood beside the solid")
                .help(format!("write it outside of this `{name}`, or in a `union` with it"));
            self.report_in(site.expansion, diagnostic);
        }
    }

    /// Warns of beam keywords on an omnidirectional light.
    fn lint_no_beam(&mut self, cone: &Cone) {
        let Some(first) = cone.words.first() else { return };
        // The keyword that makes it a beam may be in a branch that was not run.
        let text = self.within_block().map(|site| self.sources.text(site.span));
        let may_be_one = text.is_none_or(|text| {
            ["#", "spotlight", "cylinder", "parallel"].iter().any(|word| text.contains(word))
        });
        if may_be_one {
            return;
        }
        let mut names: Vec<String> = Vec::new();
        for word in &cone.words {
            let name = format!("`{}`", self.sources.text(word.span));
            if !names.contains(&name) {
                names.push(name);
            }
        }
        let (last, before) = names.split_last().map_or(("", &[][..]), |(l, b)| (l.as_str(), b));
        let (names, have) = match before {
            [] => (last.to_owned(), "has"),
            _ => (format!("{} and {last}", before.join(", ")), "have"),
        };
        let message = format!("{names} {have} no effect: this light shines all around");
        let is_cone = cone.angles().any(|given| given.value > 2.0);
        let mut diagnostic =
            Diagnostic::new(Code::UnlikelyLight, message).at(first.span, "a word of a beam");
        diagnostic = match cone.angles().next() {
            _ if is_cone => diagnostic
                .help("write `spotlight` before it")
                .fix(crate::source::Span { end: first.span.start, ..first.span }, "spotlight "),
            Some(_) => diagnostic.help("write `spotlight` (degrees) or `cylinder` (lengths)"),
            None => diagnostic.help("write `spotlight`, `cylinder` or `parallel` before it"),
        };
        let here = first.here.clone();
        self.report(&here, diagnostic);
    }

    /// Warns of literal angles that may be radians: all are small and have fractions. Returns whether it did.
    fn lint_beam_in_radians(&mut self, cone: &Cone) -> bool {
        let typed = cone.angles().all(|given| {
            let literal = is_literal(self.sources.text(given.span));
            literal && given.value.fract() != 0.0 && RADIANS.contains(&given.value)
        });
        let Some(given) = cone.angles().next().filter(|_| typed) else { return false };
        let (radius, falloff) =
            (&cone.radius.as_ref().map(|g| g.value), &cone.falloff.as_ref().map(|g| g.value));
        let inside_out = radius.zip(*falloff).is_some_and(|(radius, falloff)| falloff < radius);
        if !inside_out && cone.angles().all(|given| given.value < WIDE) {
            return false;
        }
        let message = "this angle looks like radians, and is taken as degrees";
        let diagnostic = Diagnostic::new(Code::SuspiciousUnit, message)
            .at(given.span, format!("{} degrees: a beam as thin as a thread", given.value));
        let text = self.sources.text(given.span);
        let meant = given.value.to_degrees();
        let help = format!("write degrees, or `degrees({text})`, which is {meant:.1}");
        let mut diagnostic = diagnostic.help(help);
        for other in cone.angles().skip(1) {
            diagnostic = diagnostic.also(other.span, "and this");
        }
        let here = given.here.clone();
        self.report(&here, diagnostic);
        true
    }

    /// Warns of a beam that ends before it begins to fade.
    fn lint_inside_out(&mut self, cone: &Cone, beam: &Beam, unit: &str) {
        let Beam { radius, falloff, .. } = *beam;
        let Some(given) = cone.falloff.as_ref().or(cone.radius.as_ref()) else { return };
        if falloff >= radius || falloff < 0.0 {
            return;
        }
        let message = format!(
            "the `falloff`, {falloff}, lies inside the `radius`, {radius}: the light has a hard edge"
        );
        let diagnostic = Diagnostic::new(Code::UnlikelyLight, message);
        let diagnostic = match (&cone.radius, &cone.falloff) {
            (Some(radius), Some(falloff)) => diagnostic
                .at(falloff.span, "here it ends")
                .also(radius.span, "here it begins to fade"),
            (Some(_), None) => diagnostic
                .at(given.span, format!("more than the `falloff` of {falloff} that it has"))
                .help("write `falloff` too"),
            _ => diagnostic
                .at(given.span, format!("less than the `radius` of {radius} that it has"))
                .help("write `radius` too"),
        };
        let diagnostic = diagnostic.help(format!(
            "the light is full within `radius` and gone at `falloff`; both in {unit}"
        ));
        let here = given.here.clone();
        self.report(&here, diagnostic);
    }
}
