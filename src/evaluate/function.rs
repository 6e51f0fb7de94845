//! Functions of the author's: `function (a, b) { … }`, defined and called.
//!
//! A body that is one formula becomes a tape (see `formula`); one that is a `spline` is asked as a
//! whole, and gives a vector. **Invariant:** what a formula asks outside of itself is one component
//! of another function, by [`outside_id`].
//!
//! **Source:** manual, section 3.3.1.8 ("User-Defined Functions").

use std::sync::Arc;

use crate::diagnostic::{Code, Diagnostic};
use crate::function::{Function, Outside, OutsideId};
use crate::source::Span;
use crate::syntax::ast::{Argument, ExpressionKind};
use crate::vocabulary::Word;

use super::report::count;
use super::scope::Symbol;
use super::spline::SplineValue;
use super::stream::{Token, TokenKind};
use super::value::{Poison, Value};
use super::{Evaluator, Here, Outcome, Reported};

/// A function as it was defined.
#[derive(Debug, Clone, PartialEq)]
pub enum AuthorFunction {
    /// Numbers to a number.
    Formula(Function),
    /// A time to a vector.
    Spline(Arc<SplineValue>),
}

/// Names one of the author's functions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FunctionId(pub u32);

/// What a parameter is called: by a name, or by an axis (`u` is `x`, `v` is `y`).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ParameterName {
    Name(Symbol),
    Axis(usize),
}

impl ParameterName {
    pub fn of_word(word: Word) -> Option<Self> {
        match word {
            Word::X | Word::U => Some(Self::Axis(0)),
            Word::Y | Word::V => Some(Self::Axis(1)),
            Word::Z => Some(Self::Axis(2)),
            _ => None,
        }
    }
}

/// A component of a function's value, as a tape names it.
pub(super) fn outside_id(function: FunctionId, component: usize) -> OutsideId {
    OutsideId(function.0 * 8 + component as u32)
}

/// The functions that tapes ask.
pub(super) struct Functions<'f>(pub &'f [AuthorFunction]);

impl Outside for Functions<'_> {
    fn value(&self, id: OutsideId, arguments: &[f64]) -> f64 {
        match self.0.get((id.0 / 8) as usize) {
            Some(AuthorFunction::Formula(function)) => function.run().at(arguments, self),
            Some(AuthorFunction::Spline(spline)) => {
                let values = spline.spline.at(arguments.first().copied().unwrap_or(0.0));
                values.get((id.0 % 8) as usize).copied().unwrap_or(f64::NAN)
            }
            None => f64::NAN,
        }
    }
}

impl Evaluator<'_> {
    /// `function [(a, b)] { … }`, after its word.
    pub(super) fn function(&mut self, token: &Token) -> Outcome<Value> {
        let Some(parameters) = self.parameters(token)? else {
            // `function 500, 500 { pigment { … } }`: a picture.
            self.skip_function();
            let site = token.here.site(token.span);
            return Ok(Value::Poison(Poison { word: Word::Function, site }));
        };
        self.block(token, Word::Function, |evaluator| {
            let Some(first) = evaluator.next() else {
                return Err(evaluator.expected("a formula", None, (&token.here, token.span)));
            };
            let value = match first.kind {
                TokenKind::Expression(id) => evaluator
                    .formula(&first.here, id, &parameters)
                    .map(|value| value.map(AuthorFunction::Formula)),
                TokenKind::Word(Word::Spline) => match evaluator.spline(&first)? {
                    Value::Spline(spline) => Ok(Ok(AuthorFunction::Spline(spline))),
                    Value::Poison(poison) => Ok(Err(poison)),
                    _ => Err(Reported),
                },
                TokenKind::Word(word) => {
                    let site = first.here.site(first.span);
                    evaluator.run_items();
                    return Ok(Value::Poison(Poison { word, site }));
                }
                _ => {
                    return Err(evaluator.expected(
                        "a formula",
                        Some(&first),
                        (&token.here, token.span),
                    ));
                }
            };
            if let Some(extra) = evaluator.next() {
                let message = "a function is one formula, and there is more";
                let diagnostic = Diagnostic::new(Code::ExtraPart, message)
                    .at(extra.span, "this is more than one formula");
                return Err(evaluator.report(&extra.here, diagnostic));
            }
            match value? {
                Ok(function) => {
                    evaluator.functions.push(function);
                    Ok(Value::Function(FunctionId(evaluator.functions.len() as u32 - 1)))
                }
                Err(poison) => Ok(Value::Poison(poison)),
            }
        })
    }

    /// The names between the parentheses; without any, `x`, `y` and `z`. `None` before a number.
    fn parameters(&mut self, token: &Token) -> Outcome<Option<Vec<ParameterName>>> {
        let Some(Token { kind: TokenKind::Expression(id), here, span }) =
            self.next_if(|kind| matches!(kind, TokenKind::Expression(_)))
        else {
            return Ok(Some([0, 1, 2].map(ParameterName::Axis).to_vec()));
        };
        let list = match here.unit.expression(id).kind {
            ExpressionKind::Group(inner) => vec![here.unit.expression(inner)],
            ExpressionKind::GroupItems(items) => here
                .unit
                .ast
                .items(items)
                .iter()
                .filter_map(|item| match item.kind {
                    crate::syntax::ast::ItemKind::Expression(id) => Some(here.unit.expression(id)),
                    _ => None,
                })
                .collect(),
            _ => return Ok(None),
        };
        let mut names = Vec::with_capacity(list.len());
        for parameter in list {
            let name = match parameter.kind {
                ExpressionKind::Name(name) => Some(ParameterName::Name(here.symbol(name))),
                ExpressionKind::Word(word) => ParameterName::of_word(word),
                _ => None,
            };
            let diagnostic = match name {
                Some(name) if !names.contains(&name) => {
                    names.push(name);
                    continue;
                }
                Some(_) => Diagnostic::new(
                    Code::OutOfRange,
                    "two parameters of this function have one name",
                )
                .at(parameter.span, "the second of them")
                .help("`u` and `x` are one parameter, and so are `v` and `y`"),
                None => {
                    let message = match parameter.kind {
                        ExpressionKind::Word(word) => {
                            format!("`{}` is a word of the language, and no name", word.name())
                        }
                        _ => "a parameter of a function is a name".to_owned(),
                    };
                    Diagnostic::new(Code::ExpectedExpression, message)
                        .at(parameter.span, "expected a name, or `x`, `y`, `z`, `u`, `v`")
                }
            };
            self.report(&here, diagnostic);
            self.skip_function();
            return Err(Reported);
        }
        if names.is_empty() {
            let diagnostic = Diagnostic::new(Code::WrongArity, "a function needs a parameter")
                .at(span, "expected a name")
                .also(token.span, "for this function");
            self.report(&here, diagnostic);
            self.skip_function();
            return Err(Reported);
        }
        Ok(Some(names))
    }

    /// How many arguments a function takes, and how many numbers it gives.
    pub(super) fn signature(&self, id: FunctionId) -> (usize, usize) {
        match &self.functions[id.0 as usize] {
            AuthorFunction::Formula(function) => (function.parameters(), 1),
            AuthorFunction::Spline(spline) => (1, spline.components()),
        }
    }

    /// `F(1, 2)` as a value.
    pub(super) fn function_value(
        &mut self,
        here: &Here,
        id: FunctionId,
        list: &[Argument],
        span: Span,
    ) -> Outcome<Value> {
        let (wanted, _) = self.signature(id);
        let mut arguments = Vec::with_capacity(list.len());
        let mut outcome = Ok(());
        for argument in list {
            let value = match *argument {
                Argument::Expression(id) => self.number(here, id),
                Argument::Items(items) => self
                    .inside(here, items, |evaluator| evaluator.only_value(here, span))
                    .and_then(|value| self.as_number(here, span, &value, "a number")),
            };
            match value {
                Ok(number) => arguments.push(number),
                Err(reported) => outcome = Err(reported),
            }
        }
        outcome?;
        self.check_count(here, wanted, list.len(), span)?;
        let value = match &self.functions[id.0 as usize] {
            AuthorFunction::Spline(spline) => return Ok(spline.at(arguments[0])),
            AuthorFunction::Formula(function) => {
                function.run().at(&arguments, &Functions(&self.functions))
            }
        };
        if value.is_finite() {
            return Ok(Value::Number(value));
        }
        let message = "this function has no finite value here";
        let diagnostic = Diagnostic::new(Code::NotANumber, message)
            .at(
                span,
                format!(
                    "the formula gives {}",
                    if value.is_nan() { "no number" } else { "infinity" }
                ),
            )
            .help("it divides by zero, or takes a root or a logarithm of what has none");
        Err(self.report(here, diagnostic))
    }

    pub(super) fn check_count(
        &mut self,
        here: &Here,
        wanted: usize,
        found: usize,
        span: Span,
    ) -> Outcome<()> {
        if wanted == found {
            return Ok(());
        }
        let wanted = count(&(wanted..=wanted), "argument");
        let message = format!("this function takes {wanted}, and is given {found}");
        let diagnostic =
            Diagnostic::new(Code::WrongArity, message).at(span, format!("expected {wanted}"));
        Err(self.report(here, diagnostic))
    }
}
