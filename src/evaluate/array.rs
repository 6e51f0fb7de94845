//! Arrays: `array[2][3] { {1, 2, 3}, {4, 5, 6} }`, their elements read, set and forgotten.
//!
//! **Invariant:** an array is copied when it is assigned, and only when one of the two changes; a
//! parameter refers to its caller's. Its elements are of one kind, that of the first one set.
//!
//! **Source:** manual, section 3.3.1.11 ("Array Identifiers"); measured: an index is cut off to a
//! whole number, 0.9999999999 counts as 1, and an initialiser has a value for each element.

use std::sync::Arc;

use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::syntax::ast::{Argument, ExpressionId, ExpressionKind, Target};
use crate::vocabulary::Word;

use super::report::count;
use super::scope::Slot;
use super::stream::{Token, TokenKind};
use super::value::Value;
use super::{Evaluator, Here, Outcome, Reported};

/// An array has no more dimensions.
const MOST_DIMENSIONS: usize = 5;

/// Values by whole numbers, in one to five dimensions.
#[derive(Debug, Clone, PartialEq)]
pub struct Array {
    dimensions: Vec<u32>,
    /// The last index runs fastest; `None` where nothing was set.
    elements: Vec<Option<Value>>,
    /// Of the first element that was set.
    kind: Option<&'static str>,
}

impl Array {
    pub fn dimensions(&self) -> &[u32] {
        &self.dimensions
    }

    pub fn elements(&self) -> &[Option<Value>] {
        &self.elements
    }

    /// Sets an element. What is of another kind than those before is not taken; the two kinds are
    /// returned.
    fn set(&mut self, at: usize, value: Value) -> Result<(), [&'static str; 2]> {
        let kind = value.kind();
        if !matches!(value, Value::Poison(_) | Value::Broken)
            && *self.kind.get_or_insert(kind) != kind
        {
            return Err([self.kind.unwrap_or(kind), kind]);
        }
        self.elements[at] = Some(value);
        Ok(())
    }
}

/// Why an element is not there.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum NoElement {
    /// The index at this place of the list is outside of its dimension, which has so many entries.
    Outside(usize, u32),
    /// There are fewer indices than dimensions, or more.
    Count { wanted: usize },
    /// Nothing was set.
    Unset,
    /// Before the index of this place stands no array but this.
    NoArray(usize, Value),
}

/// Where in an array some indices lead; those left over belong to the element.
fn place(array: &Array, indices: &[f64], from: usize) -> Result<usize, NoElement> {
    if indices.len() < array.dimensions.len() {
        return Err(NoElement::Count { wanted: array.dimensions.len() });
    }
    let mut place = 0;
    for (at, (index, size)) in indices.iter().zip(&array.dimensions).enumerate() {
        // What a calculation leaves over is no reason to miss by one.
        let index = (index + 1e-10).floor();
        if !(0.0..f64::from(*size)).contains(&index) {
            return Err(NoElement::Outside(from + at, *size));
        }
        place = place * *size as usize + index as usize;
    }
    Ok(place)
}

/// The element that indices lead to, through arrays of arrays.
pub(super) fn element<'v>(mut value: &'v Value, indices: &[f64]) -> Result<&'v Value, NoElement> {
    let mut from = 0;
    while from < indices.len() {
        let Value::Array(array) = value else {
            return Err(NoElement::NoArray(from, value.clone()));
        };
        let at = place(array, &indices[from..], from)?;
        value = array.elements[at].as_ref().ok_or(NoElement::Unset)?;
        from += array.dimensions.len();
    }
    Ok(value)
}

/// The place of an element, to be set; arrays on the way are copied if they are shared.
fn element_place<'v>(
    value: &'v mut Value,
    indices: &[f64],
    from: usize,
) -> Result<(&'v mut Array, usize), NoElement> {
    let Value::Array(array) = value else {
        return Err(NoElement::NoArray(from, value.clone()));
    };
    let array = Arc::make_mut(array);
    let at = place(array, &indices[from..], from)?;
    let next = from + array.dimensions.len();
    if next >= indices.len() {
        return Ok((array, at));
    }
    element_place(array.elements[at].as_mut().ok_or(NoElement::Unset)?, indices, next)
}

/// The element that indices lead to, to be changed.
pub(super) fn element_mut<'v>(value: &'v mut Value, indices: &[f64]) -> Option<&'v mut Value> {
    let (array, at) = element_place(value, indices, 0).ok()?;
    array.elements[at].as_mut()
}

impl Evaluator<'_> {
    /// `array[n] … { … }`, after its word.
    pub(super) fn array(&mut self, token: &Token) -> Outcome<Value> {
        let mut dimensions = Vec::new();
        while let Some(Token { kind: TokenKind::Entry(items), here, span }) =
            self.next_if(|kind| matches!(kind, TokenKind::Entry(_)))
        {
            let size = self.inside(&here, items, |evaluator| evaluator.only_value(&here, span))?;
            if let Value::Poison(_) = size {
                return Ok(size);
            }
            let size = self.as_number(&here, span, &size, "the size of the array")?.trunc();
            if !(1.0..=f64::from(u32::MAX)).contains(&size) {
                let message = format!("an array cannot have {size} elements");
                let diagnostic = Diagnostic::new(Code::OutOfRange, message)
                    .at(span, "expected a whole number from 1 on");
                return Err(self.report(&here, diagnostic));
            }
            dimensions.push(size as u32);
        }
        let Some(count) = self.array_size(token, &dimensions)? else { return Err(Reported) };
        let mut array = Array { dimensions, elements: vec![None; count], kind: None };
        if let Some(Token { kind: TokenKind::Block(contents), here, span }) =
            self.next_if(|kind| matches!(kind, TokenKind::Block(_)))
        {
            let mut at = 0;
            let filled = self.inside_block(&here, contents, span, |evaluator| {
                evaluator.fill(&mut array, 0, &mut at, (&here, span))
            });
            if let Some(poison) = filled? {
                return Ok(poison);
            }
        }
        Ok(Value::Array(Arc::new(array)))
    }

    fn array_size(&mut self, token: &Token, dimensions: &[u32]) -> Outcome<Option<usize>> {
        if dimensions.is_empty() {
            let diagnostic = Diagnostic::new(Code::MissingPart, "this array has no size")
                .at(token.span, "expected its size in brackets")
                .help("`array[3]` has three elements, `array[2][3]` two rows of three");
            return Err(self.report(&token.here, diagnostic));
        }
        if dimensions.len() > MOST_DIMENSIONS {
            let message = format!("this array has {} dimensions", dimensions.len());
            let diagnostic = Diagnostic::new(Code::WrongArity, message)
                .at(token.span, format!("expected one to {MOST_DIMENSIONS}"));
            return Err(self.report(&token.here, diagnostic));
        }
        let count = dimensions.iter().try_fold(1u64, |n, size| n.checked_mul(u64::from(*size)));
        let bytes = count.and_then(|count| count.checked_mul(size_of::<Option<Value>>() as u64));
        match bytes {
            Some(bytes) if self.has_memory(bytes) => Ok(count.map(|count| count as usize)),
            _ => Err(self.too_much_memory(&token.here, token.span)),
        }
    }

    /// Reads the values of one dimension, those after it in braces of their own. Something that is
    /// not built yet makes the whole array so.
    fn fill(
        &mut self,
        array: &mut Array,
        dimension: usize,
        at: &mut usize,
        (here, span): (&Here, Span),
    ) -> Outcome<Option<Value>> {
        let size = array.dimensions[dimension] as usize;
        let last = dimension + 1 == array.dimensions.len();
        let (mut found, mut poison) = (0, None);
        loop {
            self.skip_commas();
            let Some(token) = self.next() else { break };
            found += 1;
            if found > size {
                continue;
            }
            match token.kind {
                TokenKind::Block(contents) if !last => {
                    let inner = self.inside_block(&token.here, contents, token.span, |evaluator| {
                        evaluator.fill(array, dimension + 1, at, (&token.here, token.span))
                    });
                    poison = poison.or(inner?);
                }
                _ if !last => {
                    let wanted = format!("`{{` and {} values", array.dimensions[dimension + 1]);
                    return Err(self.expected(&wanted, Some(&token), (here, span)));
                }
                _ => {
                    let value = self.value_of(&token)?;
                    if let Value::Poison(_) = value {
                        poison = poison.or(Some(value.clone()));
                    }
                    if let Err(kinds) = array.set(*at, value) {
                        return Err(self.other_kind(&token.here, kinds, token.span));
                    }
                    *at += 1;
                }
            }
        }
        if found == size {
            return Ok(poison);
        }
        let what = if last { "value" } else { "row" };
        let (wanted, found) = (count(&(size..=size), what), count(&(found..=found), what));
        let message = format!("the array has {wanted} here, and is given {found}");
        let diagnostic = Diagnostic::new(Code::WrongArity, message)
            .at(span, format!("expected {wanted}"))
            .help("without braces the elements may be set one by one");
        Err(self.report(here, diagnostic))
    }

    /// `a[i][j]` as a value.
    pub(super) fn indexed(&mut self, here: &Here, id: ExpressionId) -> Outcome<Value> {
        let (base, indices) = chain(here, id);
        let value = self.expression(here, base)?;
        let numbers = match self.indices(here, &indices)? {
            Indices::Numbers(numbers) => numbers,
            Indices::Poison(poison) => return Ok(poison),
        };
        let span = here.unit.expression(base).span;
        match (&value, element(&value, &numbers)) {
            (Value::Poison(_), _) => Ok(value),
            (_, Ok(Value::Broken)) => Err(Reported),
            (_, Ok(element)) => Ok(element.clone()),
            (_, Err(error)) => Err(self.no_element(here, error, &indices, span)),
        }
    }

    /// What an argument `A[i]` refers to: the caller's variable, and the indices. `None` when it does
    /// not begin with one, or is not there.
    pub(super) fn referred(
        &mut self,
        here: &Here,
        id: ExpressionId,
    ) -> Outcome<Option<(Slot, Box<[f64]>)>> {
        let (base, indices) = chain(here, id);
        let ExpressionKind::Name(name) = here.unit.expression(base).kind else { return Ok(None) };
        let symbol = here.symbol(name);
        let Some(slot) = self.scopes.slot(symbol) else { return Ok(None) };
        let Indices::Numbers(numbers) = self.indices(here, &indices)? else { return Ok(None) };
        let there = self.scopes.read(symbol).is_some_and(|value| element(value, &numbers).is_ok());
        Ok(there.then(|| (slot, numbers.into_boxed_slice())))
    }

    fn indices(&mut self, here: &Here, indices: &[ExpressionId]) -> Outcome<Indices> {
        let mut numbers = Vec::with_capacity(indices.len());
        let mut outcome = Ok(());
        let mut poison = None;
        for &index in indices {
            match self.expression(here, index) {
                Ok(found @ Value::Poison(_)) => poison = poison.or(Some(found)),
                Ok(value) => {
                    let span = here.unit.expression(index).span;
                    match self.as_number(here, span, &value, "a number as index") {
                        Ok(number) => numbers.push(number),
                        Err(reported) => outcome = Err(reported),
                    }
                }
                Err(reported) => outcome = Err(reported),
            }
        }
        outcome?;
        Ok(poison.map_or(Indices::Numbers(numbers), Indices::Poison))
    }

    /// The indices of what is assigned, read before the value is.
    pub(super) fn target_indices(&mut self, here: &Here, target: &Target) -> Outcome<Indices> {
        self.indices(here, &target.indices)
    }

    /// `#declare A[i] = …`.
    pub(super) fn assign_element(
        &mut self,
        here: &Here,
        target: &Target,
        indices: Outcome<Indices>,
        value: Outcome<Value>,
    ) -> Outcome<()> {
        let symbol = here.symbol(target.name);
        let numbers = match (indices?, self.scopes.read(symbol)) {
            (_, None) => return Err(self.undeclared(here, symbol, target.span)),
            // What is set in something that is not built, or that was reported, is lost.
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
            Ok(Err(kinds)) => Err(self.other_kind(here, kinds, target.span)),
            Err(error) => Err(self.no_element(here, error, &target.indices, target.span)),
        }
    }

    /// `#undef A[i]`.
    pub(super) fn forget_element(&mut self, here: &Here, target: &Target) -> Outcome<()> {
        let symbol = here.symbol(target.name);
        let Indices::Numbers(numbers) = self.target_indices(here, target)? else { return Ok(()) };
        let mut held = self.scopes.take(symbol);
        let outcome = match element_place(&mut held, &numbers, 0) {
            Ok((array, at)) => {
                array.elements[at] = None;
                Ok(())
            }
            // There is nothing to forget.
            Err(NoElement::Unset | NoElement::NoArray(_, Value::Poison(_) | Value::Broken)) => {
                Ok(())
            }
            Err(error) => Err(error),
        };
        self.scopes.overwrite(symbol, held);
        outcome.map_err(|error| self.no_element(here, error, &target.indices, target.span))
    }

    /// `#ifdef (A[i])`; an index outside of the array is a mistake here too.
    pub(super) fn is_element_set(&mut self, here: &Here, target: &Target) -> bool {
        let Ok(Indices::Numbers(numbers)) = self.target_indices(here, target) else { return false };
        let Some(value) = self.scopes.read(here.symbol(target.name)) else { return false };
        match element(value, &numbers) {
            Ok(value) => *value != Value::Broken,
            // Whether an element of something not built is set cannot be known.
            Err(NoElement::NoArray(_, value)) => matches!(value, Value::Poison(_)),
            Err(NoElement::Unset) => false,
            Err(error) => {
                self.no_element(here, error, &target.indices, target.span);
                false
            }
        }
    }

    /// `dimensions(A)` and `dimension_size(A, 1)`.
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
                return Err(self.wrong_arity(here, word, word_span, wanted, list.len()));
            }
        };
        let span = here.unit.expression(array).span;
        let array = match self.expression(here, array)? {
            Value::Array(array) => array,
            poison @ Value::Poison(_) => return Ok(poison),
            other => return Err(self.wrong_type(here, span, "an array", &other)),
        };
        let Some(dimension) = dimension else {
            return Ok(Value::Number(array.dimensions.len() as f64));
        };
        // The first dimension is 1.
        let number = self.number(here, dimension)?.trunc();
        let size = array.dimensions.iter().zip(1u8..).find(|(_, n)| f64::from(*n) == number);
        if let Some((size, _)) = size {
            return Ok(Value::Number(f64::from(*size)));
        }
        let count = count(&(array.dimensions.len()..=array.dimensions.len()), "dimension");
        let diagnostic = Diagnostic::new(Code::OutOfRange, format!("the array has {count}"))
            .at(here.unit.expression(dimension).span, "no such dimension; the first is 1");
        Err(self.report(here, diagnostic))
    }

    fn other_kind(
        &mut self,
        here: &Here,
        [first, kind]: [&'static str; 2],
        span: Span,
    ) -> Reported {
        let message = format!("an array holds values of one kind: so far {first}, here {kind}");
        let diagnostic =
            Diagnostic::new(Code::WrongType, message).at(span, format!("expected {first}"));
        self.report(here, diagnostic)
    }

    fn no_element(
        &mut self,
        here: &Here,
        error: NoElement,
        indices: &[ExpressionId],
        base: Span,
    ) -> Reported {
        let index = |at: usize| indices.get(at).map_or(base, |id| here.unit.expression(*id).span);
        let name = self.sources.text(base).to_owned();
        let diagnostic = match error {
            NoElement::NoArray(_, Value::Broken) => return Reported,
            NoElement::NoArray(0, value) => {
                return self.wrong_type(here, base, "an array before `[`", &value);
            }
            NoElement::NoArray(at, value) => {
                let message = format!("this element of the array is {}, no array", value.kind());
                Diagnostic::new(Code::WrongType, message).at(index(at), "one index too many")
            }
            NoElement::Outside(at, size) => {
                let message =
                    format!("the array has no such element: its indices go from 0 to {}", size - 1);
                Diagnostic::new(Code::OutOfRange, message).at(index(at), "outside of the array")
            }
            NoElement::Count { wanted } => {
                let wanted = match wanted {
                    1 => "one index".to_owned(),
                    many => format!("{many} indices"),
                };
                let message = format!("`{name}` needs {wanted}, and is given {}", indices.len());
                Diagnostic::new(Code::WrongArity, message).at(base, format!("expected {wanted}"))
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

/// What is in front of all brackets, and what is in them, in written order.
fn chain(here: &Here, id: ExpressionId) -> (ExpressionId, Vec<ExpressionId>) {
    let (mut base, mut indices) = (id, Vec::new());
    while let ExpressionKind::Index(inner, index) = here.unit.expression(base).kind {
        indices.push(index);
        base = inner;
    }
    indices.reverse();
    (base, indices)
}

/// The numbers in brackets, unless one is not built yet.
pub(super) enum Indices {
    Numbers(Vec<f64>),
    Poison(Value),
}
