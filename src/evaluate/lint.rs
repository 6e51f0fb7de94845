//! Lints: constructs that a correct scene may contain, but probably does not.

mod angle;
mod color;
mod condition;
mod equation;
mod finish;
mod light;
mod local;
mod loose;
mod map;
mod range;
mod short;
mod switch;
mod unit;
mod unlikely_shape;
mod unused;
mod version;

use std::collections::BTreeMap;

use crate::diagnostic::suggest::closest;
use crate::diagnostic::{Code, Diagnostic};
use crate::source::{Site, Span};
use crate::syntax::ast::{DirectiveKind, ExpressionKind, ItemKind, Items, NameId, Target};
use crate::vocabulary::{PREDECLARED, Word};

pub(in crate::evaluate) use equation::Compared;
pub(in crate::evaluate) use light::Cone;
pub(in crate::evaluate) use loose::Side;
pub(in crate::evaluate) use map::Rise;
pub(in crate::evaluate) use version::version_end;

use super::stream::Token;
use super::{Evaluator, Here, Unit};

/// Maximum number of redeclared names that are examined.
const MOST_LOOKS: usize = 100;

impl Evaluator<'_> {
    /// Reports names given from outside that occur in no file of the scene.
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

    /// Reports `#declare N = 3;` if `-D N=5` was given and never read.
    pub(super) fn lint_replaced_option(&mut self, here: &Here, target: &Target) {
        let name = self.sources.text(target.span).to_owned();
        let message = format!("`-D {name}` does nothing: the scene declares `{name}` itself");
        let help =
            format!("where the given value shall win: `#ifndef ({name}) … #end` around this");
        let diagnostic = Diagnostic::new(Code::UnusedDeclaration, message)
            .at(target.span, "replaced here, before anything asked for it")
            .help(help);
        self.report(here, diagnostic);
    }

    /// Reports a literal fractional index, `A[0.5]`; a computed one may be intended.
    pub(super) fn lint_index(&mut self, here: &Here, span: Span, number: f64) {
        if is_literal(self.sources.text(span)) {
            let message = format!("the index {number} is not whole: its fraction is dropped");
            let diagnostic = Diagnostic::new(Code::FractionalIndex, message)
                .at(span, format!("this is the element {}", number.trunc()));
            self.report(here, diagnostic);
        }
    }

    /// Reports a count that is a literal with a fraction.
    pub(super) fn lint_count(&mut self, here: &Here, span: Span, count: f64) {
        let text = self.sources.text(span).trim_matches(['[', ']']);
        if count.fract() != 0.0 && is_literal(text) {
            let message = format!("the number {count} is not whole: its fraction is dropped");
            let diagnostic = Diagnostic::new(Code::FractionalIndex, message)
                .at(span, format!("this is taken for {}", count.trunc()));
            self.report(here, diagnostic);
        }
    }

    /// Reports a second pigment in the block of an object or a texture.
    pub(super) fn lint_replaced(&mut self, token: &Token, first: Site, of: &str) {
        // A loop without its `#end` includes the items after it.
        let is_lost = |one: &Diagnostic| one.code == Code::MissingEnd;
        if first.span == token.span && self.diagnostics.iter().any(is_lost) {
            return;
        }
        let message = format!("this {of} has two pigments; the last one is used");
        let diagnostic = Diagnostic::new(Code::ReplacedPigment, message)
            .at(token.span, "this one is used")
            .also(first.span, "this one does nothing");
        self.report(&token.here, diagnostic);
    }

    /// Reports names of the main file that are assigned again before their first value was used. A word that
    /// may be the name, an include or a call in between suppresses the lint.
    fn lint_redeclared(&mut self, main: &Unit) {
        let text = &self.sources.get(main.ast.file).text;
        let declared = main.ast.items(main.ast.root).iter().filter_map(|item| {
            let ItemKind::Directive(id) = item.kind else { return None };
            match &main.ast.directive(id).kind {
                DirectiveKind::Declare { target, .. } if target.indices.is_empty() => {
                    Some((target.name, target.span))
                }
                _ => None,
            }
        });
        let mut first: BTreeMap<NameId, Option<Span>> = BTreeMap::new();
        let (mut told, mut looked) = (Vec::new(), 0);
        for (name, span) in declared {
            let before = match first.get_mut(&name) {
                None => {
                    first.insert(name, Some(span));
                    continue;
                }
                Some(before) => before.take(),
            };
            // Only the second declaration; each search goes through the text.
            let Some(before) = before.filter(|_| looked < MOST_LOOKS) else { continue };
            looked += 1;
            let (known, rest) = text.split_at(span.range().start);
            let value = rest.get(span.range().len()..).unwrap_or("");
            let value = value.split([';', '\n', '#']).next().unwrap_or("");
            let name = main.ast.name(name);
            let used = self.scopes.symbol(name).and_then(|symbol| self.scopes.declared(symbol));
            let used = used.is_some_and(|declared| declared.used);
            let has = |text: &str| {
                let words = text.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_'));
                words.filter(|word| *word == name).count()
            };
            let between = &known[before.range().end..];
            // A call may use it, by a macro of an include.
            let calls = between.contains("include") || between.contains('(');
            if used && !calls && has(known) == 1 && has(value) == 0 {
                let message = format!("`{name}` gets another value before its first one is used");
                told.push(
                    Diagnostic::new(Code::UnusedDeclaration, message)
                        .at(before, "this value is never used")
                        .also(span, "declared again here"),
                );
            }
        }
        told.into_iter().for_each(|one| self.diagnostics.push(one));
    }

    /// Reports a loop between literal numbers that has no turn: `#for (I, 10, 1)`. Computed bounds may be
    /// intended.
    pub(super) fn lint_never_runs(
        &mut self,
        here: &Here,
        head: Span,
        [from, to]: [Span; 2],
        step: Option<Span>,
    ) {
        let typed = |span: Span| is_literal(self.sources.text(span));
        if ![from, to].into_iter().chain(step).all(typed) {
            return;
        }
        let [first, last] = [from, to].map(|span| self.sources.text(span).trim().to_owned());
        let by = step.map_or("1", |step| self.sources.text(step).trim());
        let diagnostic =
            Diagnostic::new(Code::NeverRuns, "this loop has no turn").at(head, "this loop").also(
                from.to(step.unwrap_or(to)),
                format!("from {first} by steps of {by} it never comes to {last}"),
            );
        let diagnostic = match step {
            None => diagnostic
                .help(format!("a step of -1 counts down: `({first}, {last}, -1)`"))
                .fix(to.after(), ", -1"),
            Some(step) => {
                let text = self.sources.text(step).trim();
                let turned = match text.strip_prefix('-') {
                    Some(up) => up.trim_start().to_owned(),
                    None => format!("-{}", text.trim_start_matches('+')),
                };
                diagnostic
                    .help(format!("a step of {text} leads away from {last}: write `{turned}`"))
                    .fix(step, turned)
            }
        };
        self.report(here, diagnostic);
    }

    /// Reports an empty range: `#range (5, 1)`.
    pub(super) fn lint_empty_range(&mut self, here: &Here, span: Span, low: f64, high: f64) {
        if low <= high {
            return;
        }
        let diagnostic = Diagnostic::new(Code::NeverRuns, "no number lies in this `#range`")
            .at(span, format!("{low} is more than {high}"))
            .help("the lower end comes first");
        if !self.repeats(&diagnostic) {
            self.report(here, diagnostic);
        }
    }

    /// Reports a loop that also counts by itself: `#for (I, 0, 9) … #declare I = I + 1; #end`. An assignment
    /// in a branch may be intended.
    pub(super) fn lint_counted_twice(&mut self, here: &Here, counter: NameId, body: Items) {
        let unit = here.unit.clone();
        let mut items = unit.ast.items(body).iter();
        while let Some(item) = items.next() {
            let ItemKind::Directive(id) = item.kind else { continue };
            let DirectiveKind::Declare { target, .. } = &unit.ast.directive(id).kind else {
                continue;
            };
            if target.name != counter || !target.indices.is_empty() {
                continue;
            }
            let Some(ItemKind::Expression(value)) = items.next().map(|item| item.kind) else {
                continue;
            };
            let ExpressionKind::Binary(_, left, _) = unit.expression(value).kind else { continue };
            if unit.expression(left).kind != ExpressionKind::Name(counter) {
                continue;
            }
            let name = self.sources.text(target.span).to_owned();
            let head = unit.ast.directive(id).head;
            let diagnostic =
                Diagnostic::new(Code::CountedTwice, format!("`#for` counts `{name}` by itself"))
                    .at(target.span, "and it is counted on here")
                    .help("leave this out; another step is the last number of the `#for`");
            let end = self.sources.get(head.file).text.get(target.span.end as usize..);
            let length = end.and_then(|rest| rest.find([';', '\n']));
            let diagnostic = match length {
                Some(length) => {
                    let end = target.span.end + length as u32 + 1;
                    diagnostic.fix(Span { end, ..head }, "")
                }
                None => diagnostic,
            };
            self.report(here, diagnostic);
            return;
        }
    }

    /// Returns whether the colour of a surface is being read.
    pub(super) fn in_pigment(&self) -> bool {
        let word = |span: &Span| self.sources.text(*span);
        self.openers
            .last()
            .is_some_and(|span| matches!(word(span), "pigment" | "color_map" | "colour_map"))
    }

    /// Reports a pattern with `given` of its `count` colours. The others are its own, or in a list with pigments
    /// the default pigment.
    pub(super) fn lint_missing_color(
        &mut self,
        token: &Token,
        pattern: &str,
        (given, count): (usize, usize),
        has_pigments: bool,
    ) {
        let missing = match count - given {
            1 => "the other is",
            _ => "the others are",
        };
        let default = match pattern {
            _ if has_pigments => "black",
            "checker" => "green",
            _ => "the pattern's own",
        };
        let has = if given == 1 { "one colour".to_owned() } else { format!("{given} colours") };
        let wanted = if count == 2 { "two".to_owned() } else { count.to_string() };
        let message = format!("this `{pattern}` has {has}; {missing} {default} by default");
        let help = match pattern {
            "checker" => "write both: `checker rgb 1, rgb 0`".to_owned(),
            _ => format!("`{pattern}` takes {count} colours, with commas between them"),
        };
        let diagnostic = Diagnostic::new(Code::MissingColor, message)
            .at(token.span, format!("expected {wanted} colours after it"))
            .help(help);
        self.report(&token.here, diagnostic);
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

/// Returns whether a piece of text is one literal number; a computed one may be intended.
pub(in crate::evaluate) fn is_literal(text: &str) -> bool {
    let text = text.trim_start_matches(['-', '+']).trim();
    text.starts_with(|c: char| c.is_ascii_digit() || c == '.') && text.parse::<f64>().is_ok()
}
