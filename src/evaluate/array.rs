//! Arrays (`array[2][3] { {1, 2, 3}, {4, 5, 6} }`) and indexing into them.
//!
//! **Invariant:** an array is copied on write: assignment shares it until one of the two changes. A parameter
//! refers to the caller's array. All elements have the kind of the first one set.
//!
//! **Source:** manual, section 3.3.1.11 ("Array Identifiers"). Measured: an index is truncated to a whole
//! number, 0.9999999999 counts as 1, and an initializer has a value for each element.

use std::sync::Arc;

use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::syntax::ast::{Callee, ExpressionKind, ItemKind};

use super::report::count;
use super::stream::{Token, TokenKind};
use super::value::Value;
use super::{Evaluator, Here, Outcome, Reported};

/// Maximum number of dimensions of an array.
const MOST_DIMENSIONS: usize = 5;

/// An array of one to five dimensions.
#[derive(Debug, Clone, PartialEq)]
pub struct Array {
    dimensions: Vec<u32>,
    /// In row-major order (the last index varies fastest); `None` for an element that was never set.
    elements: Vec<Option<Value>>,
    /// Kind of the first element that was set.
    kind: Option<&'static str>,
}

impl Array {
    /// Returns whether the array holds objects (and so nothing else).
    pub(super) fn holds_objects(&self) -> bool {
        self.elements.iter().flatten().next().is_some_and(|one| matches!(one, Value::Object(_)))
    }

    pub fn dimensions(&self) -> &[u32] {
        &self.dimensions
    }

    pub fn elements(&self) -> &[Option<Value>] {
        &self.elements
    }

    /// Sets an element.
    ///
    /// # Errors
    ///
    /// If the value is of another kind than the elements before, it is rejected and the two kinds are
    /// returned.
    pub(super) fn set(&mut self, at: usize, value: Value) -> Result<(), [&'static str; 2]> {
        let kind = value.kind();
        if !matches!(value, Value::Poison(_) | Value::Broken)
            && *self.kind.get_or_insert(kind) != kind
        {
            return Err([self.kind.unwrap_or(kind), kind]);
        }
        self.elements[at] = Some(value);
        Ok(())
    }

    pub(super) fn forget(&mut self, at: usize) {
        self.elements[at] = None;
    }
}

/// Drops nested arrays iteratively; recursion would overflow the stack.
impl Drop for Array {
    fn drop(&mut self) {
        let mut left = std::mem::take(&mut self.elements);
        while let Some(element) = left.pop() {
            if let Some(Value::Array(array)) = element
                && let Some(mut last) = Arc::into_inner(array)
            {
                left.append(&mut last.elements);
            }
        }
    }
}

/// Why an element does not exist.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum NoElement {
    /// The index at this position in the list, with this value, is outside its dimension, which has this
    /// size.
    Outside(usize, f64, u32),
    /// The number of indices differs from the number of dimensions.
    Count { wanted: usize },
    /// The element was never set.
    Unset,
    /// The value before the index at this position is not an array, but this.
    NoArray(usize, Value),
}

/// Returns the offset of the element that some indices select; surplus indices apply to the element itself.
fn place(array: &Array, indices: &[f64], from: usize) -> Result<usize, NoElement> {
    if indices.len() < array.dimensions.len() {
        return Err(NoElement::Count { wanted: array.dimensions.len() });
    }
    let mut place = 0;
    for (at, (index, size)) in indices.iter().zip(&array.dimensions).enumerate() {
        // The rounding error of a calculation must not miss an element by one.
        let index = (index + 1e-10).floor();
        if !(0.0..f64::from(*size)).contains(&index) {
            return Err(NoElement::Outside(from + at, index, *size));
        }
        place = place * *size as usize + index as usize;
    }
    Ok(place)
}

/// Returns the element that the indices select, through arrays of arrays.
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

/// Returns the slot of an element for assignment, copying shared arrays on the path to it.
pub(super) fn element_place<'v>(
    mut value: &'v mut Value,
    indices: &[f64],
    mut from: usize,
) -> Result<(&'v mut Array, usize), NoElement> {
    loop {
        let array = match value {
            Value::Array(array) => Arc::make_mut(array),
            other => return Err(NoElement::NoArray(from, other.clone())),
        };
        let at = place(array, &indices[from..], from)?;
        from += array.dimensions.len();
        if from >= indices.len() {
            return Ok((array, at));
        }
        value = array.elements[at].as_mut().ok_or(NoElement::Unset)?;
    }
}

/// Returns the element that the indices select, mutably.
pub(super) fn element_mut<'v>(value: &'v mut Value, indices: &[f64]) -> Option<&'v mut Value> {
    let (array, at) = element_place(value, indices, 0).ok()?;
    array.elements[at].as_mut()
}

impl Evaluator<'_> {
    /// Reports `array[] { 1, 2, 3 }`, an array without a size, and consumes its values.
    fn no_size(&mut self, here: &Here, brackets: Span) -> Reported {
        let values = self.next_if(|kind| matches!(kind, TokenKind::Block(_)));
        let told = Diagnostic::new(Code::MissingPart, "an array says how many elements it has")
            .at(brackets, "expected a number between `[` and `]`");
        let count = values.and_then(|values| count_values(self.sources.text(values.span)));
        let told = match count {
            Some(count) => {
                let right = format!("[{count}]");
                told.help(format!("write `array{right}`")).fix(brackets, right)
            }
            None => told.help("as in `array[3]`"),
        };
        self.report(here, told)
    }

    /// Reads `array[n] … { … }`, after its keyword.
    pub(super) fn array(&mut self, token: &Token) -> Outcome<Value> {
        let mut dimensions = Vec::new();
        while let Some(Token { kind: TokenKind::Entry(items), here, span }) =
            self.next_of_array(|kind| matches!(kind, TokenKind::Entry(_)))
        {
            if here.unit.ast.items(items).is_empty() {
                return Err(self.no_size(&here, span));
            }
            let size = self.inside(&here, items, |evaluator| evaluator.only_value(&here, span))?;
            if let Value::Poison(_) = size {
                return Ok(size);
            }
            let size = self.as_number(&here, span, &size, "the size of the array")?;
            self.lint_count(&here, span, size);
            let size = size.trunc();
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
            self.next_of_array(|kind| matches!(kind, TokenKind::Block(_)))
        {
            let mut at = 0;
            let filled = self.inside_block(&here, contents, span, |evaluator| {
                evaluator.fill(&mut array, 0, &mut at, (&here, span))
            });
            match filled {
                Ok(Some(poison)) => return Ok(poison),
                Ok(None) => {}
                // It has its size nevertheless, and what is missing was reported.
                Err(Reported) => {
                    for element in array.elements.iter_mut().filter(|element| element.is_none()) {
                        *element = Some(Value::Broken);
                    }
                }
            }
        }
        Ok(Value::Array(Arc::new(array)))
    }

    /// As [`Self::next_if`], at a point where the array may have ended: the text after it may already use the
    /// array.
    fn next_of_array(&mut self, suits: impl FnOnce(&TokenKind) -> bool) -> Option<Token> {
        let follows = match self.calls_for_block() {
            true => self.peek(),
            false => self.peek_on(),
        };
        if follows.is_some_and(|token| suits(&token.kind)) { self.next() } else { None }
    }

    /// Returns whether the initializer is a macro call that leaves a block, as in `array[2] Values()` where
    /// the macro leaves `{ 1, 2 }`.
    fn calls_for_block(&self) -> bool {
        let Some(frame) = self.frames.last().filter(|frame| frame.at < frame.end) else {
            return false;
        };
        let ItemKind::Expression(id) = frame.here.unit.ast.items[frame.at as usize].kind else {
            return false;
        };
        let ExpressionKind::Call(Callee::Name(name, _), _) = frame.here.unit.expression(id).kind
        else {
            return false;
        };
        let Some(Value::Macro(called)) = self.scopes.look(frame.here.symbol(name)) else {
            return false;
        };
        let first = self.macros[called.0 as usize]
            .parts()
            .and_then(|(unit, body)| unit.ast.items(body).first().map(|first| first.kind));
        matches!(first, Some(ItemKind::Block(_)))
    }

    fn array_size(&mut self, token: &Token, dimensions: &[u32]) -> Outcome<Option<usize>> {
        if dimensions.is_empty() {
            let round = self.next_if(|kind| matches!(kind, TokenKind::Expression(_)));
            // `array { 1, 2, 3 }`: its values cause no second error.
            if let Some(Token { kind: TokenKind::Block(contents), here, span }) =
                self.next_if(|kind| matches!(kind, TokenKind::Block(_)))
            {
                let before = self.told();
                self.inside_block(&here, contents, span, Self::run_items);
                self.take_back(before);
            }
            let size = round.as_ref().map(|round| self.sources.text(round.span));
            let size = size.and_then(|text| text.strip_prefix('(')?.strip_suffix(')'));
            let diagnostic = Diagnostic::new(Code::MissingPart, "this array has no size");
            let diagnostic = match (size, &round) {
                (Some(size), Some(round)) => diagnostic
                    .at(round.span, "its size stands in square brackets")
                    .help(format!("write `array[{size}]`"))
                    .fix(round.span, format!("[{size}]")),
                _ => diagnostic
                    .at(token.span, "expected its size in brackets")
                    .help("`array[3]` has three elements, `array[2][3]` two rows of three"),
            };
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

    /// Reads the values of one dimension; further dimensions are in nested braces. One unsupported value
    /// makes the whole array unsupported.
    fn fill(
        &mut self,
        array: &mut Array,
        dimension: usize,
        at: &mut usize,
        (here, span): (&Here, Span),
    ) -> Outcome<Option<Value>> {
        let size = array.dimensions[dimension] as usize;
        let last = dimension + 1 == array.dimensions.len();
        let (mut found, mut poison, mut surplus, mut missing) = (0, None, None, None);
        loop {
            if found > 0 {
                self.skip_comma();
            }
            while let Some(told) = self.value_missing_here(found > 0) {
                missing = Some(told);
                found += 1;
                *at += usize::from(found <= size && last);
            }
            let Some(token) = self.next() else { break };
            found += 1;
            if found > size {
                surplus = surplus.or(Some(token.span));
                // The start of a value is not another value.
                let _ = last.then(|| self.value_of(&token));
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
        if let Some(told) = missing {
            return Err(told);
        }
        if found == size {
            return Ok(poison);
        }
        if self.undecided {
            return Err(Reported);
        }
        // The values written exist, so that reading them causes no second error.
        if array.dimensions.len() == 1 && found > size {
            array.elements.resize(found, Some(Value::Broken));
            array.dimensions[0] = found as u32;
        }
        let what = if last { "value" } else { "row" };
        let (wanted, given) = (count(&(size..=size), what), count(&(found..=found), what));
        let message = format!("the array has {wanted} here, and is given {given}");
        let text: String = self.sources.text(span).split_whitespace().collect();
        let layered = text.contains("}texture{");
        let diagnostic = Diagnostic::new(Code::WrongArity, message)
            .at(surplus.unwrap_or_else(|| self.end_of_call(span)), format!("expected {wanted}"))
            .help(match surplus {
                Some(_) if array.dimensions.len() == 1 => {
                    format!("write `array[{found}]`, or leave out what is too many")
                }
                Some(_) => "leave out what is too many".to_owned(),
                None if layered => {
                    "textures without a comma between them are layers of one: write \
                     `texture { … }, texture { … }`"
                        .to_owned()
                }
                None => "without braces the elements may be set one by one".to_owned(),
            });
        Err(self.report(here, diagnostic))
    }

    /// Reports a missing value, as in `{ 1, , 3 }`.
    fn value_missing_here(&mut self, behind_comma: bool) -> Option<Reported> {
        let Some(Token { kind: TokenKind::Comma, .. }) = self.peek() else { return None };
        let comma = self.next()?;
        let between = if behind_comma { "between two commas" } else { "before the first comma" };
        let diagnostic =
            Diagnostic::new(Code::ExpectedExpression, format!("a value is missing {between}"))
                .at(comma.span, "expected a value before it")
                .help("put the value there, or leave the comma out");
        Some(self.report(&comma.here, diagnostic))
    }

    pub(super) fn other_kind(
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
}

/// Counts the values in braces, if commas separate them and no directive adds any.
fn count_values(block: &str) -> Option<usize> {
    let inside = block.strip_prefix('{')?.strip_suffix('}')?.trim().trim_end_matches(',');
    let (mut depth, mut commas) = (0, 0);
    for sign in inside.chars() {
        match sign {
            '<' | '(' | '[' | '{' => depth += 1,
            '>' | ')' | ']' | '}' => depth -= 1,
            ',' if depth == 0 => commas += 1,
            _ => {}
        }
    }
    (!inside.is_empty() && !inside.contains(['#', '"', '/'])).then_some(commas + 1)
}
