//! Macro arguments that the macro's body cannot use. Each is one mistake of the call, reported once, however
//! often the body uses the argument and whichever macros it is passed on to.
//!
//! **Invariant:** a diagnostic is suppressed as a repetition only if the earlier one was reported and not
//! withdrawn.

use crate::diagnostic::Diagnostic;
use crate::source::{Expansion, ExpansionId, ExpansionKind, Site, Span};
use crate::syntax::ast::{Argument, Callee, ExpressionKind};

use super::block::Given;
use super::value::Value;
use super::{Evaluator, Here, Symbol};

/// Longest argument that a message quotes, in characters.
const LONGEST: usize = 40;

/// An argument of a call that its macro could not use.
#[derive(Debug, Clone, Copy)]
pub(super) struct Refused {
    parameter: Symbol,
    kind: &'static str,
    /// Where the error was reported.
    told: Span,
}

/// The parameter that a value came from, and the call that supplied its argument.
#[derive(Debug, Clone, Copy)]
struct Origin {
    call: Span,
    /// The expansion that contains the call.
    within: ExpansionId,
    parameter: Symbol,
    /// The argument itself, if it can be located.
    argument: Option<Span>,
}

impl Evaluator<'_> {
    /// Returns whether the unusable value `found` at `span` comes from a parameter of the running macro and
    /// adds no news: this parameter has been reported, or another one of a different kind has, which suggests
    /// that the two arguments were swapped.
    pub(super) fn is_refused_again(&mut self, here: &Here, span: Span, found: &Value) -> bool {
        let Some(Origin { call, parameter, .. }) = self.origin(here, span, found) else {
            return false;
        };
        let refused = Refused { parameter, kind: found.kind(), told: span };
        let before = self.remembered.refused.get(&call).map_or(&[][..], Vec::as_slice);
        let repeats = before.iter().any(|first| {
            first.told != span
                && (first.parameter == parameter || first.kind != refused.kind)
                && self.tells_at(first.told)
        });
        if !repeats && before.iter().all(|first| first.told != span) {
            self.remembered.refused.entry(call).or_default().push(refused);
        }
        repeats
    }

    /// Adds a label for the argument that an unusable value came from.
    pub(super) fn given_by_call(
        &self,
        here: &Here,
        span: Span,
        found: &Value,
        diagnostic: Diagnostic,
    ) -> Diagnostic {
        let Some(Origin { parameter, argument: Some(argument), .. }) =
            self.origin(here, span, found)
        else {
            return diagnostic;
        };
        let (name, given) = (self.scopes.name(parameter), self.sources.text(argument));
        let plain = given.chars().count() <= LONGEST && !given.contains('\n');
        match plain && given != self.sources.text(span) {
            true => diagnostic.help(format!("`{name}` was given as `{given}`")),
            false => diagnostic,
        }
    }

    /// Returns the two arguments of one call that the two values came from.
    pub(super) fn arguments_behind(&self, values: [&Given<Value>; 2]) -> Option<[Site; 2]> {
        let [a, b] = values.map(|given| {
            let origin = self.origin(&given.here, given.span, &given.value)?;
            Some((Site { span: origin.argument?, expansion: origin.within }, origin.call))
        });
        let ((a, call), (b, other)) = (a?, b?);
        (call == other && a.span != b.span).then_some([a, b])
    }

    /// Returns where `found`, the value of `span`, entered the running macro, followed through calls that
    /// only pass it on.
    fn origin(&self, here: &Here, span: Span, found: &Value) -> Option<Origin> {
        let mut calls = self.scene.expansions.chain(here.expansion);
        let mut call = calls.find(|call| call.kind == ExpansionKind::Macro)?;
        let mut parameter = self.parameter_within(span, found)?;
        let mut argument = self.argument(call, parameter);
        while let Some(given) = argument
            && let Some(outer) = calls.find(|call| call.kind == ExpansionKind::Macro)
            && given.file == call.call.file
            && let Some(above) = self.parameter_within(given, found)
            && let Some(higher) = self.argument(outer, above)
        {
            (call, parameter, argument) = (outer, above, Some(higher));
        }
        Some(Origin { call: call.call, within: call.parent, parameter, argument })
    }

    /// Returns the parameter in a text that a value of this kind came from: its only name, or the only one of
    /// that kind.
    fn parameter_within(&self, span: Span, found: &Value) -> Option<Symbol> {
        let text = self.sources.text(span);
        let known =
            |name: &str| self.scopes.symbol(name).filter(|symbol| self.is_a_parameter(*symbol));
        if let (Some(parameter), true) = (known(text), words(text).next() == Some(text)) {
            return Some(parameter);
        }
        let of_kind = |symbol: &Symbol| {
            self.scopes.look(*symbol).is_some_and(|value| value.kind() == found.kind())
        };
        words(text).filter_map(known).find(of_kind).or_else(|| {
            // `#local Half = Size/2;`
            let made = words(text).filter_map(|name| self.scopes.symbol(name)).find(of_kind)?;
            let name = self.scopes.declared(made)?.site.span;
            let behind = self.sources.get(name.file).text.get(name.end as usize..)?;
            let value = behind.split([';', '\n']).next()?;
            words(value).filter_map(known).find(of_kind)
        })
    }

    /// Returns the argument that a call passes for a parameter.
    fn argument(&self, call: &Expansion, parameter: Symbol) -> Option<Span> {
        let units = self.frames.iter().rev().map(|frame| &frame.here.unit);
        let unit = units.into_iter().find(|unit| unit.ast.file == call.call.file)?;
        let found = unit.ast.expressions.iter().find(|expression| {
            expression.span == call.call && matches!(expression.kind, ExpressionKind::Call(..))
        })?;
        let ExpressionKind::Call(Callee::Name(name, _), list) = found.kind else { return None };
        let symbol = unit.symbols[name.0 as usize];
        let definition = self.macros.iter().rev().find(|one| one.name == symbol)?;
        let place = definition.parameters.iter().position(|&(name, _)| name == parameter)?;
        match *unit.ast.arguments(list).get(place)? {
            Argument::Expression(id) => Some(unit.expression(id).span),
            Argument::Items(_) => None,
        }
    }

    fn is_a_parameter(&self, symbol: Symbol) -> bool {
        self.macros.iter().any(|one| one.parameters.iter().any(|&(name, _)| name == symbol))
    }

    fn tells_at(&self, place: Span) -> bool {
        self.diagnostics.iter().any(|told| told.primary().is_some_and(|label| label.span == place))
    }
}

/// Returns the words of a text that have the form of a name.
fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_').filter(|word| !word.is_empty())
}
