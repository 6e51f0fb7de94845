//! Array elements: `A[i][j]` read, assigned, undefined, tested and passed by reference.
//!
//! **Source:** measured: the indices of an assignment's target are evaluated before its value.

use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::syntax::ast::{Argument, DirectiveKind, ExpressionId, ExpressionKind, Target};
use crate::vocabulary::{Dialect, Word};

use super::array::{NoElement, element, element_place};
use super::report::count;
use super::scope::Slot;
use super::stream::FrameKind;
use super::value::Value;
use super::{Evaluator, Here, Outcome, Reported, Symbol};

impl Evaluator<'_> {
    /// Evaluates `a[i][j]`.
    pub(super) fn indexed(&mut self, here: &Here, id: ExpressionId) -> Outcome<Value> {
        let (base, indices) = chain(here, id);
        let span = here.unit.expression(base).span;
        let value = match self.expression(here, base) {
            Err(Reported) if matches!(here.unit.expression(base).kind, ExpressionKind::Name(_)) => {
                let broken = NoElement::NoArray(0, Value::Broken);
                return Err(self.no_element(here, broken, &indices, span));
            }
            value => value?,
        };
        let numbers = match self.indices(here, &indices, matches!(value, Value::Array(_)))? {
            Indices::Numbers(numbers) => numbers,
            Indices::Poison(poison) => return Ok(poison),
        };
        match (&value, element(&value, &numbers)) {
            (Value::Poison(_), _) => Ok(value),
            (_, Ok(Value::Broken)) => Err(Reported),
            (_, Ok(element)) => Ok(element.clone()),
            (_, Err(error)) => Err(self.no_element(here, error, &indices, span)),
        }
    }

    /// Returns what an argument `A[i]` refers to: the caller's variable and the indices. Returns `None` if it
    /// does not begin with a variable, or the element does not exist.
    pub(super) fn referred(
        &mut self,
        here: &Here,
        id: ExpressionId,
    ) -> Outcome<Option<(Slot, Box<[f64]>)>> {
        let (base, indices) = chain(here, id);
        let ExpressionKind::Name(name) = here.unit.expression(base).kind else { return Ok(None) };
        let symbol = here.symbol(name);
        let Some(slot) = self.scopes.slot(symbol) else { return Ok(None) };
        let Indices::Numbers(numbers) = self.indices(here, &indices, true)? else {
            return Ok(None);
        };
        let there = self.scopes.read(symbol).is_some_and(|value| element(value, &numbers).is_ok());
        Ok(there.then(|| (slot, numbers.into_boxed_slice())))
    }

    fn indices(
        &mut self,
        here: &Here,
        indices: &[ExpressionId],
        of_array: bool,
    ) -> Outcome<Indices> {
        let mut numbers = Vec::with_capacity(indices.len());
        let mut outcome = Ok(());
        let mut poison = None;
        for &index in indices {
            match self.expression(here, index) {
                Ok(found @ Value::Poison(_)) => poison = poison.or(Some(found)),
                Ok(value) => {
                    let span = here.unit.expression(index).span;
                    match self.as_number(here, span, &value, "a number as index") {
                        Ok(number) => {
                            if number.fract() != 0.0 && of_array {
                                self.lint_index(here, span, number);
                            }
                            numbers.push(number);
                        }
                        Err(reported) => outcome = Err(reported),
                    }
                }
                Err(reported) => outcome = Err(reported),
            }
        }
        outcome?;
        Ok(poison.map_or(Indices::Numbers(numbers), Indices::Poison))
    }

    /// Evaluates the indices of an assignment's target, before its value.
    pub(super) fn target_indices(&mut self, here: &Here, target: &Target) -> Outcome<Indices> {
        self.indices(here, &target.indices, true)
    }

    /// Runs `#declare A[i] = …`.
    pub(super) fn assign_element(
        &mut self,
        here: &Here,
        target: &Target,
        indices: Outcome<Indices>,
        value: Outcome<Value>,
    ) -> Outcome<()> {
        let place = (here.symbol(target.name), target.span);
        self.assign_at(here, place, (&target.indices, indices), value)
    }

    /// Assigns to the element that an expression `A[i]` denotes.
    pub(super) fn assign_indexed(
        &mut self,
        here: &Here,
        id: ExpressionId,
        value: Value,
    ) -> Outcome<()> {
        let (base, indices) = chain(here, id);
        let base = here.unit.expression(base);
        let ExpressionKind::Name(name) = base.kind else {
            return Err(self.wrong_type(here, base.span, "a declared array", &value));
        };
        let numbers = self.indices(here, &indices, true);
        self.assign_at(here, (here.symbol(name), base.span), (&indices, numbers), Ok(value))
    }

    fn assign_at(
        &mut self,
        here: &Here,
        (symbol, span): (Symbol, Span),
        (written, indices): (&[ExpressionId], Outcome<Indices>),
        value: Outcome<Value>,
    ) -> Outcome<()> {
        let numbers = match (indices?, self.scopes.read(symbol)) {
            (_, None) => return Err(self.array_missing(here, symbol, span)),
            // Assignments into an unsupported or reported value are dropped.
            (Indices::Poison(_), _) | (_, Some(Value::Poison(_) | Value::Broken)) => return Ok(()),
            (Indices::Numbers(numbers), Some(_)) => numbers,
        };
        let value = value.unwrap_or(Value::Broken);
        let mut held = self.scopes.take(symbol);
        let outcome = match element_place(&mut held, &numbers, 0) {
            Ok((array, at)) => Ok(array.set(at, value)),
            Err(error) => Err(error),
        };
        self.scopes.overwrite(symbol, held);
        match outcome {
            Ok(Ok(())) => Ok(()),
            Ok(Err(kinds)) => Err(self.other_kind(here, kinds, span)),
            Err(error) => Err(self.no_element(here, error, written, span)),
        }
    }

    /// Runs `#undef A[i]`.
    pub(super) fn forget_element(&mut self, here: &Here, target: &Target) -> Outcome<()> {
        let symbol = here.symbol(target.name);
        let Indices::Numbers(numbers) = self.target_indices(here, target)? else { return Ok(()) };
        let mut held = self.scopes.take(symbol);
        let outcome = match element_place(&mut held, &numbers, 0) {
            Ok((array, at)) => {
                array.forget(at);
                Ok(())
            }
            // There is nothing to remove.
            Err(NoElement::Unset | NoElement::NoArray(_, Value::Poison(_) | Value::Broken)) => {
                Ok(())
            }
            Err(error) => Err(error),
        };
        self.scopes.overwrite(symbol, held);
        outcome.map_err(|error| self.no_element(here, error, &target.indices, target.span))
    }

    /// Evaluates `#ifdef (A[i])`. Even here, an index outside the array is an error.
    pub(super) fn is_element_set(&mut self, here: &Here, target: &Target) -> bool {
        let Ok(Indices::Numbers(numbers)) = self.target_indices(here, target) else { return false };
        let Some(value) = self.scopes.read(here.symbol(target.name)) else { return false };
        match element(value, &numbers) {
            Ok(value) => *value != Value::Broken,
            // Whether an element of an unsupported value is set is unknown.
            Err(NoElement::NoArray(_, value)) => matches!(value, Value::Poison(_)),
            Err(NoElement::Unset) => false,
            Err(error) => {
                self.no_element(here, error, &target.indices, target.span);
                false
            }
        }
    }

    /// Evaluates `defined(A[1])`.
    pub(super) fn is_set(&mut self, here: &Here, id: ExpressionId) -> bool {
        let before = self.told();
        let value = self.expression(here, id);
        self.take_back(before);
        !matches!(value, Err(Reported) | Ok(Value::Broken))
    }

    /// Evaluates `dimensions(A)` and `dimension_size(A, 1)`.
    pub(super) fn dimensions(
        &mut self,
        here: &Here,
        word: Word,
        word_span: Span,
        list: &[Argument],
    ) -> Outcome<Value> {
        let (array, dimension) = match *list {
            [Argument::Expression(array)] if word == Word::Dimensions => (array, None),
            [Argument::Expression(array), Argument::Expression(n)]
                if word == Word::DimensionSize =>
            {
                (array, Some(n))
            }
            _ => {
                let wanted = if word == Word::Dimensions { 1..=1 } else { 2..=2 };
                return Err(self.wrong_arity(here, word, word_span, wanted, (list.len(), list)));
            }
        };
        let span = here.unit.expression(array).span;
        let array = match self.expression(here, array)? {
            Value::Array(array) => array,
            poison @ Value::Poison(_) => return Ok(poison),
            other => return Err(self.wrong_type(here, span, "an array", &other)),
        };
        let Some(dimension) = dimension else {
            return Ok(Value::Number(array.dimensions().len() as f64));
        };
        // The first dimension is 1.
        let number = self.number(here, dimension)?.trunc();
        let size = array.dimensions().iter().zip(1u8..).find(|(_, n)| f64::from(*n) == number);
        if let Some((size, _)) = size {
            return Ok(Value::Number(f64::from(*size)));
        }
        if self.options.dialect == Dialect::Pov {
            // POV-Ray 3.7's result (measured).
            return Ok(Value::Number(0.0));
        }
        let count = count(&(array.dimensions().len()..=array.dimensions().len()), "dimension");
        let diagnostic = Diagnostic::new(Code::OutOfRange, format!("the array has {count}"))
            .at(here.unit.expression(dimension).span, "no such dimension; the first is 1");
        Err(self.report(here, diagnostic))
    }

    fn no_element(
        &mut self,
        here: &Here,
        error: NoElement,
        indices: &[ExpressionId],
        base: Span,
    ) -> Reported {
        let index = |at: usize| indices.get(at).map_or(base, |id| here.unit.expression(*id).span);
        // The target of an assignment has the span of the whole expression.
        let name = self.sources.text(base).split('[').next().unwrap_or("").trim().to_owned();
        let diagnostic = match error {
            NoElement::NoArray(0, Value::Broken)
                if let Some((Word::Spline, _)) =
                    self.scopes.symbol(&name).and_then(|symbol| self.declared_as(symbol)) =>
            {
                let message = "expected an array before `[`, found a spline";
                Diagnostic::new(Code::WrongType, message)
                    .at(base, format!("`{name}` is a spline"))
                    .help(format!("a spline is called: `{name}(0.5)`"))
            }
            NoElement::NoArray(_, Value::Broken) => return Reported,
            NoElement::NoArray(0, value) => {
                return self.wrong_type(here, base, "an array before `[`", &value);
            }
            NoElement::NoArray(at, value) => {
                let message = format!("this element of the array is {}, no array", value.kind());
                Diagnostic::new(Code::WrongType, message).at(index(at), "one index too many")
            }
            NoElement::Outside(at, found, size) => {
                let message = format!(
                    "the array has no element {found}: its indices go from 0 to {}",
                    size - 1
                );
                let told = Diagnostic::new(Code::OutOfRange, message)
                    .at(index(at), "outside of the array");
                let counted = indices.get(at).and_then(|&index| self.counted_to(here, index));
                // The end of one loop is a single mistake, whatever its counter indexes.
                if let Some((end, _)) = counted {
                    if self.ends_told.contains(&(end, size)) {
                        return Reported;
                    }
                    self.ends_told.push((end, size));
                }
                let end = counted.filter(|(_, to)| *to == found).map(|(end, _)| end);
                let index = indices.get(at).copied();
                let told = self.one_too_far((here, index), end, (found, size), told);
                let is_past = told.help.is_empty() && indices.len() == 1 && found >= 0.0;
                match is_past {
                    true => told.help(format!("the last one is `{name}[{}]`", size - 1)),
                    false => told,
                }
            }
            NoElement::Count { wanted } => {
                let wanted = match wanted {
                    1 => "one index".to_owned(),
                    many => format!("{many} indices"),
                };
                let message = format!("`{name}` needs {wanted}, and is given {}", indices.len());
                let diagnostic = Diagnostic::new(Code::WrongArity, message)
                    .at(base, format!("expected {wanted}"));
                match indices.len() {
                    1 if wanted.starts_with('2') => {
                        let first = self.sources.text(index(0));
                        diagnostic.help(format!("one element is `{name}[{first}][0]`"))
                    }
                    _ => diagnostic,
                }
            }
            NoElement::Unset => {
                let span = indices
                    .first()
                    .map_or(base, |_| Span { end: index(indices.len() - 1).end, ..base });
                Diagnostic::new(Code::UndeclaredName, "this element of the array was never set")
                    .at(span, "nothing is there yet")
                    .help("`#ifdef (A[i])` asks whether an element is set")
            }
        };
        let diagnostic =
            match self.scopes.symbol(&name).and_then(|symbol| self.scopes.declared(symbol)) {
                Some(declared) => diagnostic.also(declared.site.span, "declared here"),
                None => diagnostic,
            };
        self.report(here, diagnostic)
    }
}

impl Evaluator<'_> {
    /// Explains why an index is outside the array, for `A[I]` in `#for (I, 0, dimension_size(A, 1))` and for
    /// `A[frame_number - 1]` in a still image.
    fn one_too_far(
        &self,
        (here, index): (&Here, Option<ExpressionId>),
        end: Option<Span>,
        (found, size): (f64, u32),
        told: Diagnostic,
    ) -> Diagnostic {
        let Some(index) = index.map(|index| here.unit.expression(index)) else { return told };
        let mentions = |name: &str| {
            let words =
                self.sources.text(index.span).split(|c: char| !(c.is_alphanumeric() || c == '_'));
            words.into_iter().any(|word| word == name)
        };
        let frame = self.scopes.symbol("frame_number").and_then(|frame| self.scopes.look(frame));
        let is_still = frame.and_then(Value::as_number) == Some(0.0);
        if found < 0.0 && is_still && mentions("frame_number") {
            return told.help(
                "`frame_number` is 0 in a still: `-D frame_number=1` gives it another value",
            );
        }
        let Some(end) = end.filter(|_| found == f64::from(size)) else { return told };
        let text = self.sources.text(end);
        let told = told.help(format!("`#for` includes its end: write `{text} - 1` there"));
        match text.starts_with(Word::DimensionSize.name()) && text.ends_with(')') {
            true => told.fix(end.after(), " - 1"),
            false => told,
        }
    }

    /// Returns the end value, and its span, of the `#for` whose counter is this index.
    fn counted_to(&self, here: &Here, index: ExpressionId) -> Option<(Span, f64)> {
        let ExpressionKind::Name(name) = here.unit.expression(index).kind else { return None };
        let symbol = here.symbol(name);
        let ends = self.frames.iter().rev().take(MOST_LOOPS).find_map(|frame| match frame.kind {
            FrameKind::For { symbol: counter, directive, to, .. } if counter == symbol => {
                Some((&frame.here, directive, to))
            }
            _ => None,
        });
        let (there, directive, end) = ends?;
        let DirectiveKind::For { to, .. } = there.unit.ast.directive(directive).kind else {
            return None;
        };
        Some((there.unit.expression(to).span, end))
    }
}

/// Maximum number of loops that are examined.
const MOST_LOOPS: usize = 64;

/// Splits an indexing chain into its base and the expressions in brackets, in source order.
fn chain(here: &Here, id: ExpressionId) -> (ExpressionId, Vec<ExpressionId>) {
    let (mut base, mut indices) = (id, Vec::new());
    while let ExpressionKind::Index(inner, index) = here.unit.expression(base).kind {
        indices.push(index);
        base = inner;
    }
    indices.reverse();
    (base, indices)
}

/// Evaluated indices, unless one is unsupported.
pub(super) enum Indices {
    Numbers(Vec<f64>),
    Poison(Value),
}
