//! The bodies of macros whose brackets pair only on the way that is taken: each way is read as a body of its own.

use std::collections::HashMap;
use std::rc::Rc;

use crate::diagnostic::Diagnostics;
use crate::source::{ExpansionId, Source, Span};
use crate::syntax::ast::{ExpressionId, ItemKind, Items};
use crate::syntax::{self, ParseOptions, Ways, alone};

use super::expand::{Macro, MacroBody};
use super::stream::Frame;
use super::{Evaluator, Here, Outcome, Unit};

/// What has been read of such bodies, by where they stand.
#[derive(Debug, Default)]
pub(super) struct Read {
    /// `None` of one that has no way.
    ways: HashMap<Span, Option<Rc<Forked>>>,
    /// By what the conditions came to.
    bodies: HashMap<(Span, Vec<bool>), (Rc<Unit>, Items)>,
}

/// A body that has ways, and the conditions that decide among them.
#[derive(Debug)]
struct Forked {
    ways: Ways,
    conditions: Vec<(Rc<Unit>, ExpressionId)>,
}

impl Evaluator<'_> {
    /// Whether the body of a macro can be run.
    pub(super) fn has_a_way(&mut self, definition: &Macro) -> bool {
        match definition.body {
            MacroBody::Items(_) => true,
            MacroBody::Raw(span) => self.forked(span).is_some(),
        }
    }

    /// The body of a macro, as it is to be run now that its parameters are bound.
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
            // What is not run on this way is not asked for.
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

    /// Whether a frame walks such a body.
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

    /// Reads what is left of a file, and tells its mistakes where it is called.
    fn read_part(&mut self, text: String, span: Span, told_in: Option<ExpansionId>) -> Rc<Unit> {
        let name = self.sources.get(span.file).name.clone();
        let options = ParseOptions {
            dialect: self.options.dialect,
            nesting_limit: self.options.limits.nesting as usize,
            ..ParseOptions::default()
        };
        let mut told = Diagnostics::new(true);
        let ast = syntax::parse(&Source::new(name, text), span.file, &options, &mut told);
        if let Some(expansion) = told_in {
            for one in told.iter() {
                self.report_in(expansion, one.clone());
            }
        }
        self.unit(ast)
    }
}
