//! Macro calls that leave several values in a list: `<Pair(), 3>`, `max(Pair())`, `Box(Pair())`.
//!
//! **Invariant:** as in POV-Ray, where a macro's text replaces its call, a call contributes as many entries
//! to the list as the macro leaves values between commas.

use std::ops::RangeInclusive;

use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::syntax::ast::{Argument, BinaryOperator, Callee, ExpressionId, ExpressionKind};
use crate::vocabulary::Dialect;

use super::stream::{Token, TokenKind};
use super::value::{Components, Value};
use super::{Evaluator, Here, Outcome, Reported};

/// List entries that are not exactly one value: their indices and values.
pub(super) type Spread = Vec<(usize, Vec<Value>)>;

impl Evaluator<'_> {
    /// Returns what the macro called by an entry leaves; `None` if the entry is anything else.
    pub(super) fn left_by_macro(
        &mut self,
        here: &Here,
        id: ExpressionId,
    ) -> Option<Outcome<Vec<Value>>> {
        let expression = here.unit.expression(id);
        let ExpressionKind::Call(Callee::Name(name, _), arguments) = expression.kind else {
            return None;
        };
        let Some(Value::Macro(called)) = self.scopes.read(here.symbol(name)) else { return None };
        let (called, span) = (*called, expression.span);
        self.read_macro(here, called, arguments, span, |evaluator| evaluator.values(here, span))
    }

    /// Returns the values that the current items leave, separated by commas.
    pub(super) fn values(&mut self, here: &Here, span: Span) -> Outcome<Vec<Value>> {
        if self.options.dialect == Dialect::Pov && self.peek().is_some() {
            return self.values_side_by_side(here, span);
        }
        let mut values = vec![self.value_or(here, span)?];
        loop {
            match self.next() {
                None => return Ok(values),
                Some(token) => match token.kind {
                    TokenKind::Semicolon => {}
                    TokenKind::Comma => values.push(self.value_or(here, span)?),
                    _ => return Err(self.more_than_one(&token)),
                },
            }
        }
    }

    /// Returns the values that the current items leave, with or without commas between them: POV-Ray accepts
    /// `Dot(0, 1 color rgb <1, 0.5, 0>)`.
    fn values_side_by_side(&mut self, here: &Here, span: Span) -> Outcome<Vec<Value>> {
        let mut values = Vec::new();
        while self.peek().is_some() {
            values.push(self.value_or(here, span)?);
            let is_between =
                |kind: &TokenKind| matches!(kind, TokenKind::Comma | TokenKind::Semicolon);
            while self.next_if(is_between).is_some() {}
        }
        Ok(values)
    }

    /// Returns the arguments of a call with too few of them, if some are more than one value each and all
    /// together are as many as `wanted`; otherwise empty.
    pub(super) fn spread(
        &mut self,
        here: &Here,
        list: &[Argument],
        wanted: RangeInclusive<usize>,
        span: Span,
    ) -> Outcome<Spread> {
        let (mut spread, mut count) = (Spread::new(), list.len());
        for (place, argument) in list.iter().enumerate() {
            let values = match *argument {
                Argument::Items(items)
                    if items.is_empty() || self.options.dialect == Dialect::Scene =>
                {
                    continue;
                }
                Argument::Items(items) => {
                    self.inside(here, items, |evaluator| evaluator.values_side_by_side(here, span))?
                }
                Argument::Expression(id) => match self.left_by_macro(here, id) {
                    Some(values) => values?,
                    None if self.value_before_group(here, id).is_some() => {
                        self.values_of_call(here, id)?
                    }
                    None => match self.object_and_value(here, id)? {
                        Some(both) => both.into(),
                        None => continue,
                    },
                },
            };
            if values.is_empty() {
                continue;
            }
            count += values.len() - 1;
            spread.push((place, values));
        }
        if !wanted.contains(&count) {
            spread.clear();
        }
        Ok(spread)
    }

    /// Reads an object and a signed value without a comma between them: POV-Ray accepts `Align(Ball() -y,
    /// 0)`.
    fn object_and_value(&mut self, here: &Here, id: ExpressionId) -> Outcome<Option<[Value; 2]>> {
        let ExpressionKind::Binary(
            sign @ (BinaryOperator::Add | BinaryOperator::Subtract),
            first,
            second,
        ) = here.unit.expression(id).kind
        else {
            return Ok(None);
        };
        let is_object = match here.unit.expression(first).kind {
            ExpressionKind::Call(Callee::Name(..), _) => true,
            ExpressionKind::Name(name) => {
                matches!(self.scopes.look(here.symbol(name)), Some(Value::Object(_)))
            }
            _ => false,
        };
        if !is_object {
            return Ok(None);
        }
        let first = self.expression(here, first)?;
        let (Value::Object(_) | Value::Poison(_)) = first else { return Ok(None) };
        let second = self.expression(here, second)?;
        let second = match (sign, &second) {
            (BinaryOperator::Subtract, Value::Number(number)) => Value::Number(-number),
            (BinaryOperator::Subtract, Value::Vector(vector)) => {
                let negated: Vec<f64> = vector.as_slice().iter().map(|c| -c).collect();
                Components::new(&negated).map_or(Value::Broken, Value::Vector)
            }
            _ => second,
        };
        Ok(Some([first, second]))
    }

    /// Reports an item after the single value that was expected.
    pub(super) fn more_than_one(&mut self, extra: &Token) -> Reported {
        let diagnostic =
            Diagnostic::new(Code::ExtraPart, "one value was expected here, and there are more")
                .at(extra.span, "this is more than one value");
        let diagnostic = match self.is_index(extra.span) {
            true => diagnostic.help("each index has brackets of its own: `A[I][J]`"),
            false if self.is_in_case(extra.span) => {
                diagnostic.help("all between two numbers, both included: `#range (low, high)`")
            }
            false => diagnostic,
        };
        self.report(&extra.here, diagnostic)
    }

    /// Returns whether a comma is in the parentheses of a case: `#case (1, 2)`.
    fn is_in_case(&self, comma: Span) -> bool {
        let before = self.sources.get(comma.file).text.get(..comma.start as usize).unwrap_or("");
        let line = before.rsplit(['\n', '\r']).next().unwrap_or("");
        line.rsplit('#').next().is_some_and(|head| head.starts_with("case"))
    }

    /// Returns whether a comma is in the brackets of an index: `A[I, J]`.
    fn is_index(&self, comma: Span) -> bool {
        let text = &self.sources.get(comma.file).text;
        let before = text.get(..comma.start as usize).unwrap_or("");
        let opener = before.rfind(['[', ']', ';', '{', '}']);
        let named = |at: usize| {
            before[..at].ends_with(|c: char| c.is_ascii_alphanumeric() || c == '_' || c == ']')
        };
        self.sources.text(comma) == ","
            && opener.is_some_and(|at| before[at..].starts_with('[') && named(at))
    }
}
