//! Lints: what a right scene might contain, and probably does not.

mod angle;
mod color;
mod condition;
mod equation;
mod finish;
mod light;
mod local;
mod lone;
mod loose;
mod map;
mod range;
mod short;
mod switch;
mod unit;
mod version;

use std::collections::{BTreeMap, BTreeSet};

use crate::diagnostic::suggest::closest;
use crate::diagnostic::{Code, Diagnostic};
use crate::scene::{ObjectId, ObjectKind, Unused};
use crate::source::{FileId, Site, Span};
use crate::syntax::ast::{DirectiveKind, ExpressionKind, ItemKind, Items, NameId, Target};
use crate::vocabulary::{PREDECLARED, Word, is_standard_source};

use super::scope::Owner;
pub(in crate::evaluate) use equation::Compared;
pub(in crate::evaluate) use light::Cone;
pub(in crate::evaluate) use loose::Side;
pub(in crate::evaluate) use map::Rise;
pub(in crate::evaluate) use version::version_end;

use super::stream::Token;
use super::value::Value;
use super::{Evaluator, Here, Unit};

/// How many names are looked at that are declared again.
const MOST_LOOKS: usize = 100;

impl Evaluator<'_> {
    /// Names that were declared in the main file and never used: the scene knows them, and there is
    /// a lint for each.
    pub(super) fn lint_declarations(&mut self, main: &Unit) {
        self.tell_unused(main, |_| true);
        self.lint_redeclared(main);
    }

    /// As [`Self::lint_declarations`], of a scene with mistakes: names that nothing but their declaration has, nor
    /// any message.
    pub(super) fn lint_lone_names(&mut self, main: &Unit) {
        let own = self.sources.iter().filter(|(_, source)| !is_standard_source(&source.name));
        let mut own: Vec<String> = own.skip(1).map(|(_, source)| source.text.clone()).collect();
        for one in self.diagnostics.iter() {
            own.push(one.message.clone());
            own.extend(one.help.iter().chain(one.labels.iter().map(|label| &label.text)).cloned());
        }
        let has = |name: &str| {
            let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
            own.iter().any(|text| text.split(|c| !is_part(c)).any(|word| word == name))
        };
        // It may be meant by what is not declared.
        let lacking = self.diagnostics.iter().filter(|one| one.code == Code::UndeclaredName);
        let lacking = lacking.filter_map(|one| Some(self.sources.text(one.primary()?.span)));
        let lacking: Vec<String> = lacking.map(str::to_owned).collect();
        let is_near = |name: &str| closest(name, lacking.iter().map(String::as_str)).is_some();
        self.tell_unused(main, |name| !has(name) && !is_near(name));
    }

    fn tell_unused(&mut self, main: &Unit, is_meant: impl Fn(&str) -> bool) {
        let has_errors = self.diagnostics.has_errors();
        let is_error = |told: &&Diagnostic| told.is_error();
        let faults = self.diagnostics.iter().filter(is_error);
        let faulty = faults.flat_map(|told| told.labels.iter().map(|label| label.span));
        let faulty: BTreeSet<(FileId, usize)> = faulty.map(|span| self.line_of(span)).collect();
        let mut unused: Vec<(Unused, Diagnostic)> = Vec::new();
        for (name, declared, value) in self.scopes.declarations() {
            if declared.used {
                continue;
            }
            let theirs = match declared.of {
                Owner::Main => true,
                // A branch that was not run may use it, or a macro that this one calls.
                Owner::Macro => self.is_only_declared(name, main),
                Owner::Other => false,
            };
            if !theirs || name.starts_with('_') || !is_meant(name) {
                continue;
            }
            let is_light = matches!(value, Some(&Value::Object(object)) if self.is_light(object));
            if has_errors && !self.is_only_declared(name, main) {
                continue;
            }
            // What is wrong on its line comes first.
            let is_object = matches!(value, Some(Value::Object(_)));
            if !is_object && faulty.contains(&self.line_of(declared.site.span)) {
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
                Some(Value::Object(_)) => {
                    let (word, label) = match is_light {
                        true => (Word::LightSource, "this light does not shine"),
                        false => (Word::Object, "this object is not seen"),
                    };
                    let message = format!("`{name}` is declared and never placed in the scene");
                    Diagnostic::new(Code::NeverPlaced, message)
                        .at(site.span, label)
                        .help(format!("place it with `{} {{ {name} }}`", word.name()))
                }
                Some(Value::Camera(_)) => Diagnostic::new(
                    Code::UnusedDeclaration,
                    format!("`{name}` is a camera that is declared and never used"),
                )
                .at(site.span, "the scene is not seen by it")
                .help(format!("use it with `camera {{ {name} }}`")),
                Some(_) => Diagnostic::new(
                    Code::UnusedDeclaration,
                    format!("`{name}` is declared and never used"),
                )
                .at(site.span, "declared here"),
            };
            let text = &self.sources.get(site.span.file).text;
            let before = text[..site.span.start as usize].trim_end();
            let directive = ["macro", "local"].into_iter().find(|word| before.ends_with(word));
            let directive = directive.unwrap_or("declare");
            let name = name.to_owned();
            let is_camera = matches!(value, Some(Value::Camera(_)));
            unused.push((Unused { directive, name, site, is_light, is_camera }, diagnostic));
        }
        unused.sort_by_key(|(one, _)| one.site.span);
        for (one, diagnostic) in unused {
            self.scene.unused.push(one);
            self.diagnostics.push(diagnostic);
        }
    }

    fn line_of(&self, span: Span) -> (FileId, usize) {
        (span.file, self.sources.get(span.file).position(span.start as usize).line)
    }

    fn is_light(&self, mut object: ObjectId) -> bool {
        loop {
            match self.scene.objects[object.index()].kind {
                ObjectKind::Use(used) => object = used,
                ObjectKind::LightSource(_) => return true,
                ObjectKind::Solid(_) | ObjectKind::Union(_) | ObjectKind::Csg { .. } => {
                    return false;
                }
            }
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

    /// `#declare N = 3;` where `-D N=5` was given, and nothing has asked for that.
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

    /// `A[0.5]`, typed; what is computed may be meant.
    pub(super) fn lint_index(&mut self, here: &Here, span: Span, number: f64) {
        if is_literal(self.sources.text(span)) {
            let message = format!("the index {number} is not whole: its fraction is dropped");
            let diagnostic = Diagnostic::new(Code::FractionalIndex, message)
                .at(span, format!("this is the element {}", number.trunc()));
            self.report(here, diagnostic);
        }
    }

    /// How many there are, typed with a fraction.
    pub(super) fn lint_count(&mut self, here: &Here, span: Span, count: f64) {
        let text = self.sources.text(span).trim_matches(['[', ']']);
        if count.fract() != 0.0 && is_literal(text) {
            let message = format!("the number {count} is not whole: its fraction is dropped");
            let diagnostic = Diagnostic::new(Code::FractionalIndex, message)
                .at(span, format!("this is taken for {}", count.trunc()));
            self.report(here, diagnostic);
        }
    }

    /// A second pigment in the block of an object, or of a texture.
    pub(super) fn lint_replaced(&mut self, token: &Token, first: Site, of: &str) {
        // A loop whose `#end` is missing runs over what stands behind it.
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

    /// Names of the main file that get another value before the first one was used. A word that may be
    /// the name, an include or a call in between: better silent than wrong.
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
            // The second declaration only; each look goes through the text.
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

    /// `#for (I, 10, 1)`: a loop between numbers as they are typed that has no turn. Of what is computed
    /// it may be meant.
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

    /// `#range (5, 1)`.
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

    /// `#for (I, 0, 9) … #declare I = I + 1; #end`: what stands in a branch may be meant.
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

    /// Whether what is read now is the colour of a surface.
    pub(super) fn in_pigment(&self) -> bool {
        let word = |span: &Span| self.sources.text(*span);
        self.openers
            .last()
            .is_some_and(|span| matches!(word(span), "pigment" | "color_map" | "colour_map"))
    }

    /// A `checker` with one of its two colours.
    pub(super) fn lint_missing_color(&mut self, token: &Token, other: &str) {
        let message = format!("this `checker` has one colour; the other is {other} by default");
        let diagnostic = Diagnostic::new(Code::MissingColor, message)
            .at(token.span, "expected two colours after it")
            .help("write both: `checker rgb 1, rgb 0`");
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

/// Whether a piece of text is one number as it is typed: what is computed may be meant.
pub(in crate::evaluate) fn is_literal(text: &str) -> bool {
    let text = text.trim_start_matches(['-', '+']).trim();
    text.starts_with(|c: char| c.is_ascii_digit() || c == '.') && text.parse::<f64>().is_ok()
}
