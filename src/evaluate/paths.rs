//! Macro bodies that are parsed when they run: those whose brackets pair only along the branches taken, with
//! one parsed body for each combination of branches, and, in a `.pov`, those that cannot be parsed.

use std::collections::{HashMap, HashSet};
use std::rc::Rc;

use crate::diagnostic::{Code, Diagnostic, Diagnostics};
use crate::source::{ExpansionId, FileId, Source, Span};
use crate::syntax::ast::{Ast, DirectiveKind, ExpressionId, ItemKind, Items};
use crate::syntax::{self, ParseOptions, Ways, alone};

use super::expand::{Macro, MacroBody};
use super::stream::Frame;
use super::{Evaluator, Here, Outcome, Unit};

/// Cache of such bodies, by span.
#[derive(Debug, Default)]
pub(super) struct Read {
    /// `None` for a body that cannot be parsed on any path.
    ways: HashMap<Span, Option<Rc<Forked>>>,
    /// The diagnostics of files parsed as a whole, including code that is not run.
    wholes: HashMap<FileId, Vec<Diagnostic>>,
    /// Spans of bodies that have mistakes.
    broken: HashSet<Span>,
    /// Parsed bodies, by the results of their conditions.
    bodies: HashMap<(Span, Vec<bool>), (Rc<Unit>, Items)>,
}

/// A body with several paths, and the conditions that decide between them.
#[derive(Debug)]
struct Forked {
    ways: Ways,
    conditions: Vec<(Rc<Unit>, ExpressionId)>,
}

impl Evaluator<'_> {
    /// Returns whether the body of a macro can be run.
    pub(super) fn has_a_way(&mut self, definition: &Macro) -> bool {
        match definition.body {
            MacroBody::Items(_) => true,
            MacroBody::Raw(span) => self.forked(span).is_some(),
        }
    }

    /// Returns the body of a macro to run, now that its parameters are bound.
    pub(super) fn body_of(
        &mut self,
        definition: &Macro,
        expansion: ExpansionId,
    ) -> Outcome<(Rc<Unit>, Items)> {
        let span = match definition.body {
            MacroBody::Items(body) => return Ok((definition.unit.clone(), body)),
            MacroBody::Raw(span) => span,
        };
        let Some(forked) = self.forked(span) else { return Err(super::Reported) };
        let mut holds = Vec::with_capacity(forked.conditions.len());
        for (unit, condition) in &forked.conditions {
            let place = unit.expression(*condition).span.start as usize;
            // Conditions that are not reached on this path are not evaluated.
            let is_asked = forked.ways.reaches(place, &holds);
            let here = Here { unit: unit.clone(), expansion };
            holds.push(is_asked && self.condition(&here, *condition)?);
        }
        let key = (span, holds);
        if let Some(known) = self.read.bodies.get(&key) {
            return Ok(known.clone());
        }
        let text = forked.ways.text_where(&self.sources.get(span.file).text, &key.1);
        let unit = self.read_part(text, span, Some(expansion));
        let body = (unit.clone(), unit.ast.root);
        self.read.bodies.insert(key, body.clone());
        Ok(body)
    }

    /// Returns whether a frame runs such a body.
    pub(super) fn is_body_on_a_way(&self, frame: &Frame) -> bool {
        self.read
            .bodies
            .values()
            .any(|(unit, body)| body.end == frame.end && Rc::ptr_eq(unit, &frame.here.unit))
    }

    fn forked(&mut self, span: Span) -> Option<Rc<Forked>> {
        if let Some(known) = self.read.ways.get(&span) {
            return known.clone();
        }
        let forked = self.read_forked(span).map(Rc::new);
        self.read.ways.insert(span, forked.clone());
        forked
    }

    fn read_forked(&mut self, span: Span) -> Option<Forked> {
        let ways = Ways::of(&self.sources.get(span.file).text, span)?;
        let mut conditions = Vec::new();
        for place in ways.conditions() {
            let text = alone(&self.sources.get(span.file).text, place);
            let unit = self.read_part(text, place, None);
            let [item] = unit.ast.items(unit.ast.root) else { return None };
            let ItemKind::Expression(condition) = item.kind else { return None };
            conditions.push((unit, condition));
        }
        Some(Forked { ways, conditions })
    }

    /// Runs a body that could not be parsed: reports its mistakes as those of the whole file, where more
    /// context is available, and declares its names with unknown values.
    pub(super) fn run_unread(&mut self, here: &Here, span: Span) {
        let key = (span, Vec::new());
        if let Some((unit, body)) = self.read.bodies.get(&key).cloned() {
            let here = Here { unit, expansion: here.expansion };
            return match self.read.broken.contains(&span) {
                true => self.declare_broken(&here, body),
                false => self.push_branch(&here, body),
            };
        }
        let text = alone(&self.sources.get(span.file).text, span);
        let (mut ast, mut of_part) = self.mistakes_of(text.clone(), span, true);
        // `#macro IsEven(N) mod(N, 2) = 0 #end`: a comparison is read where it is called, in parentheses.
        if of_part.iter().any(Diagnostic::is_error)
            && let Some(grouped) = in_parentheses(&text, span)
        {
            let (group, of_group) = self.mistakes_of(grouped, span, true);
            if !of_group.iter().any(Diagnostic::is_error) {
                (ast, of_part) = (group, of_group);
            }
        }
        let unit = self.unit(ast);
        let body = (unit.clone(), unit.ast.root);
        self.read.bodies.insert(key, body.clone());
        let here = Here { unit, expansion: here.expansion };
        if !of_part.iter().any(Diagnostic::is_error) {
            for one in of_part {
                self.report_in(here.expansion, one);
            }
            return self.push_branch(&here, body.1);
        }
        let of_whole = self.whole_mistakes_in(span);
        let told = if of_whole.iter().any(Diagnostic::is_error) { of_whole } else { of_part };
        for one in told {
            self.report_in(here.expansion, one);
        }
        self.read.broken.insert(span);
        self.declare_broken(&here, body.1);
    }

    /// Returns the diagnostics for a span if all of its file were run.
    fn whole_mistakes_in(&mut self, span: Span) -> Vec<Diagnostic> {
        if !self.read.wholes.contains_key(&span.file) {
            let text = self.sources.get(span.file).text.to_string();
            let mut mistakes = self.mistakes_of(text, span, false).1;
            mistakes.retain(|one| one.primary().is_some());
            mistakes.sort_by_key(start_of);
            self.read.wholes.insert(span.file, mistakes);
        }
        let mistakes = &self.read.wholes[&span.file];
        let first = mistakes.partition_point(|one| start_of(one) < span.start);
        let is_before_end = |one: &&Diagnostic| start_of(one) < span.end;
        let is_inside = |one: &&Diagnostic| one.primary().is_some_and(|l| l.span.end <= span.end);
        mistakes[first..].iter().take_while(is_before_end).filter(is_inside).cloned().collect()
    }

    /// Warns of the bodies of a unit that could not be parsed and were not run.
    pub(super) fn warn_of_unread(&mut self, unit: &Unit) {
        for directive in &unit.ast.directives {
            let span = directive.head;
            let is_unread = matches!(directive.kind, DirectiveKind::Unread);
            if !is_unread || self.read.bodies.contains_key(&(span, Vec::new())) {
                continue;
            }
            let first = self.whole_mistakes_in(span).into_iter().find(Diagnostic::is_error);
            let warning = match first {
                Some(Diagnostic { message, labels, help, fixes, .. }) => {
                    let message = format!("code that is not run cannot be read: {message}");
                    let warning = Diagnostic::new(Code::UnreadBranch, message);
                    Diagnostic { labels, help, fixes, ..warning }
                }
                None => Diagnostic::new(Code::UnreadBranch, "code that is not run cannot be read")
                    .at(span, "this is passed over"),
            };
            self.diagnostics.push(warning);
        }
    }

    /// Parses part of a file, and reports its mistakes at the call.
    fn read_part(&mut self, text: String, span: Span, told_in: Option<ExpansionId>) -> Rc<Unit> {
        let (ast, told) = self.mistakes_of(text, span, true);
        if let Some(expansion) = told_in {
            for one in told {
                self.report_in(expansion, one);
            }
        }
        self.unit(ast)
    }

    /// Parses a text and returns its diagnostics. With `defers`, bodies that cannot be parsed remain text.
    fn mistakes_of(&self, text: String, span: Span, defers: bool) -> (Ast, Vec<Diagnostic>) {
        let name = self.sources.get(span.file).name.clone();
        let options = ParseOptions {
            dialect: self.options.dialect,
            nesting_limit: self.options.limits.nesting as usize,
            loose: self.options.loose,
            defers,
            ..ParseOptions::default()
        };
        let mut told = Diagnostics::new(true);
        let ast = syntax::parse(&Source::new(name, text), span.file, &options, &mut told);
        (ast, told.iter().cloned().collect())
    }
}

/// Returns where the first label of a message begins in its file.
fn start_of(one: &Diagnostic) -> u32 {
    one.primary().map_or(0, |label| label.span.start)
}

/// Returns a text with parentheses around `span`, in place of the blanks on both sides; `None` without blanks
/// there.
fn in_parentheses(text: &str, span: Span) -> Option<String> {
    let (open, close) = ((span.start as usize).checked_sub(1)?, span.end as usize);
    let mut text = text.to_owned();
    for (at, sign) in [(open, "("), (close, ")")] {
        text.get(at..=at).filter(|place| matches!(*place, " " | "\n"))?;
        text.replace_range(at..=at, sign);
    }
    Some(text)
}
