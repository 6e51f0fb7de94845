//! User-defined functions, `function (a, b) { … }`: definition and calls.
//!
//! A body that is one formula becomes a tape (see `formula`), as does `internal(n)`. A body that is a block
//! (`spline`, `pattern`, `pigment` or `transform`) is evaluated as a whole, at a time or at a point.
//!
//! **Source:** manual, section 3.3.1.8 ("User-Defined Functions").

use std::sync::Arc;

use crate::diagnostic::{Code, Diagnostic};
use crate::function::{Binary, Builder, Function, Outside, TooLong};
use crate::lower::alone;
use crate::scene::TransformId;
use crate::source::{Site, Span};
use crate::syntax::ast::{Argument, Callee, ExpressionKind};
use crate::vocabulary::{Dialect, Word};

use super::arity::surplus;
use super::report::count;
use super::scope::Symbol;
use super::stream::{Token, TokenKind};
use super::value::{Poison, Value};
use super::{Evaluator, Here, Outcome, Reported};

mod closed;
mod internal;
mod tape_call;
mod unreadable_body;

pub use tape_call::{AuthorFunction, FunctionId};
pub(super) use tape_call::{Functions, outside_id};

/// Name of a parameter: an identifier or an axis (`u` is `x`, `v` is `y`).
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

impl Evaluator<'_> {
    /// Skips the parameters and the body of a `function`, whose names are local to it.
    pub(super) fn skip_function(&mut self) {
        while let Some(token) = self.peek() {
            match token.kind {
                TokenKind::Expression(_) | TokenKind::Comma | TokenKind::Literal(_) => {
                    drop(self.next())
                }
                TokenKind::Block(_) => {
                    if let Some(Token { kind: TokenKind::Block(contents), here, span }) =
                        self.next()
                    {
                        self.inside_block(&here, contents, span, |_| {});
                    }
                    return;
                }
                TokenKind::Word(_) | TokenKind::Entry(_) | TokenKind::Semicolon => return,
            }
        }
    }
    /// Reads `function [(a, b)] { … }`, after its keyword.
    pub(super) fn function(&mut self, token: &Token) -> Outcome<Value> {
        let Some(parameters) = self.parameters(token)? else {
            // `function 500, 500 { pigment { … } }`: an image.
            self.skip_function();
            let site = token.here.site(token.span);
            return Ok(Value::Poison(Poison::new(Word::Function, site)));
        };
        self.function_of(token, &parameters)
    }

    /// Reads the block of a function with these parameters.
    pub(super) fn function_of(
        &mut self,
        token: &Token,
        parameters: &[ParameterName],
    ) -> Outcome<Value> {
        let value = self.function_block(token, parameters);
        if value.is_err() {
            self.broken_function = Some(parameters.len());
        }
        value
    }

    fn function_block(&mut self, token: &Token, parameters: &[ParameterName]) -> Outcome<Value> {
        self.block(token, Word::Function, |evaluator| {
            let Some(first) = evaluator.next() else {
                return Err(evaluator.expected("a formula", None, (&token.here, token.span)));
            };
            let value = evaluator.function_body(token, &first, parameters);
            if let Some(extra) = evaluator.next() {
                if let TokenKind::Semicolon = extra.kind {
                    let message = "no `;` stands in a function";
                    let told = Diagnostic::new(Code::ExtraPart, message)
                        .at(extra.span, "expected `}`")
                        .help("leave it out: a function is one formula")
                        .fix(extra.span, "");
                    return Err(evaluator.report(&extra.here, told));
                }
                let message = "a function is one formula, and there is more";
                let diagnostic = Diagnostic::new(Code::ExtraPart, message)
                    .at(extra.span, "this is more than one formula");
                let text = evaluator.sources.text(first.span);
                let names = text.strip_prefix('(').and_then(|text| text.strip_suffix(')'));
                let is_name = |name: &str| {
                    !name.trim().is_empty()
                        && name.trim().chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
                };
                let diagnostic = match names.filter(|names| names.split(',').all(is_name)) {
                    Some(_) => diagnostic.help(format!(
                        "the parameters stand before the brace: `function{text} {{ … }}`"
                    )),
                    None if matches!(extra.kind, TokenKind::Expression(_)) => {
                        let text = evaluator.sources.text(extra.span).to_owned();
                        diagnostic
                            .help(format!("is an operator missing before `{text}`, such as `*`?"))
                    }
                    None => diagnostic,
                };
                return Err(evaluator.report(&extra.here, diagnostic));
            }
            value
        })
    }

    /// Reads the formula, or the block that gives a value at every point.
    fn function_body(
        &mut self,
        token: &Token,
        first: &Token,
        parameters: &[ParameterName],
    ) -> Outcome<Value> {
        let function = match first.kind {
            TokenKind::Expression(id) => {
                let kind = first.here.unit.expression(id).kind;
                if let ExpressionKind::Call(Callee::Word(Word::Internal, _), list) = kind {
                    return self.internal(&first.here, list, first.span).map(Value::Function);
                }
                match self.formula(&first.here, id, parameters)? {
                    Ok(function) => AuthorFunction::Formula(function),
                    Err(poison) => {
                        self.broken_function = Some(parameters.len());
                        return Ok(Value::Poison(poison));
                    }
                }
            }
            TokenKind::Word(Word::Spline | Word::Pattern | Word::Pigment | Word::TransformWord) => {
                match self.block_function(first)? {
                    Ok(function) => function,
                    Err(poison) => return Ok(Value::Poison(poison)),
                }
            }
            TokenKind::Word(word) => {
                let site = first.here.site(first.span);
                self.run_items();
                return Ok(Value::Poison(Poison::new(word, site)));
            }
            _ => {
                let at = (&token.here, token.span);
                return Err(self.expected("a formula", Some(first), at));
            }
        };
        self.functions.push(function);
        Ok(Value::Function(FunctionId(self.functions.len() as u32 - 1)))
    }

    /// Reads `spline { … }` and the like; poison if part of it is unsupported.
    fn block_function(&mut self, first: &Token) -> Outcome<Result<AuthorFunction, Poison>> {
        if first.kind == TokenKind::Word(Word::Pattern) {
            let outer = self.poison.take();
            let pattern = self.pattern_block(first);
            let poison = std::mem::replace(&mut self.poison, outer);
            let id = match (pattern, poison) {
                (_, Some(poison)) => return Ok(Err(poison)),
                (pattern, None) => pattern?,
            };
            let pattern = alone::pigment(&self.scene, id, self.diagnostics).ok_or(Reported)?;
            return Ok(Ok(AuthorFunction::Pattern(Arc::new(pattern))));
        }
        Ok(Ok(match self.value_of(first)? {
            Value::Spline(spline) => AuthorFunction::Spline(spline),
            Value::Pigment(id) => {
                let pigment = alone::pigment(&self.scene, id, self.diagnostics).ok_or(Reported)?;
                AuthorFunction::Pigment(Arc::new(pigment))
            }
            Value::Transform(id) => {
                let functions = self.transform_functions(id, first.here.site(first.span))?;
                AuthorFunction::Transform(Box::new(functions))
            }
            Value::Poison(poison) => return Ok(Err(poison)),
            _ => return Err(Reported),
        }))
    }

    /// Returns the functions that give each coordinate of a transformed point.
    fn transform_functions(&mut self, id: TransformId, site: Site) -> Outcome<[Function; 3]> {
        let rows = alone::rows(&self.scene, id, site, self.diagnostics);
        let (rows, offset) = rows.ok_or(Reported)?;
        let coordinate = |axis: usize| -> Result<Function, TooLong> {
            let mut builder = Builder::new(3)?;
            let mut sum = builder.constant(offset[axis])?;
            for (from, factor) in rows[axis].to_array().into_iter().enumerate() {
                let Some(parameter) = builder.parameter(from) else { continue };
                if factor != 0.0 {
                    let factor = builder.constant(factor)?;
                    let part = builder.binary(Binary::Multiply, parameter, factor)?;
                    sum = builder.binary(Binary::Add, part, sum)?;
                }
            }
            Ok(builder.finish(sum))
        };
        match [0, 1, 2].map(coordinate) {
            [Ok(x), Ok(y), Ok(z)] => Ok([x, y, z]),
            // Seven operations never exceed the limit.
            _ => Err(Reported),
        }
    }

    /// Reads the names between the parentheses; without parentheses they are `x`, `y` and `z`. Returns `None`
    /// before a number.
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
            ExpressionKind::Call(..) | ExpressionKind::Binary(..) if !self.is_before_block() => {
                let text = self.sources.text(span).to_owned();
                let right = format!("{{ {text} }}");
                let diagnostic =
                    Diagnostic::new(Code::MissingPart, "a function's formula stands in braces")
                        .at(span, "expected `{` before it, and `}` behind")
                        .help(format!("write `function {right}`"))
                        .fix(span, right);
                return Err(self.report(&here, diagnostic));
            }
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
                Some(name) => {
                    let message = "two parameters of this function have one name";
                    let told = Diagnostic::new(Code::OutOfRange, message)
                        .at(parameter.span, "the second of them")
                        .help("`u` and `x` are one parameter, and so are `v` and `y`");
                    if self.options.dialect == Dialect::Pov {
                        // POV-Ray 3.7 accepts both.
                        self.report(&here, told.as_warning());
                        names.push(name);
                        continue;
                    }
                    told
                }
                None => {
                    let message = match parameter.kind {
                        ExpressionKind::Word(word) => {
                            format!(
                                "`{}` is a word of the language, and no name of a parameter",
                                word.name()
                            )
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

    /// Evaluates a call `F(1, 2)`.
    pub(super) fn function_value(
        &mut self,
        here: &Here,
        id: FunctionId,
        list: &[Argument],
        span: Span,
    ) -> Outcome<Value> {
        let wanted = self.functions[id.0 as usize].parameters();
        let mut arguments = Vec::with_capacity(list.len());
        let mut outcome = Ok(());
        for argument in list {
            let (left, place) = match *argument {
                Argument::Expression(id) => match self.left_by_macro(here, id) {
                    Some(left) => (left, here.unit.expression(id).span),
                    None => {
                        match self.number(here, id) {
                            Ok(number) => arguments.push(number),
                            Err(reported) => outcome = Err(reported),
                        }
                        continue;
                    }
                },
                Argument::Items(items) => {
                    (self.inside(here, items, |evaluator| evaluator.values(here, span)), span)
                }
            };
            for value in left.unwrap_or_else(|reported| {
                outcome = Err(reported);
                Vec::new()
            }) {
                match self.as_number(here, place, &value, "a number") {
                    Ok(number) => arguments.push(number),
                    Err(reported) => outcome = Err(reported),
                }
            }
        }
        outcome?;
        self.check_count(here, wanted, (arguments.len(), list), span)?;
        let functions = Functions { all: &self.functions, noise: self.noise };
        let value = match &self.functions[id.0 as usize] {
            AuthorFunction::Spline(spline) => return Ok(spline.at(arguments[0])),
            AuthorFunction::Pigment(pigment) => {
                return Ok(Value::Color(tape_call::color(pigment, &arguments).single()));
            }
            AuthorFunction::Transform(rows) => {
                let coordinate = |axis: usize| rows[axis].run().at(&arguments, &functions);
                return Ok(Value::vector3([0, 1, 2].map(coordinate).into()));
            }
            AuthorFunction::Formula(function) => function.run().at(&arguments, &functions),
            AuthorFunction::Noise(_) | AuthorFunction::Pattern(_) => {
                functions.value(outside_id(id, 0), &arguments)
            }
        };
        match value.is_finite() {
            true => Ok(Value::Number(value)),
            false => self.no_finite_value(here, span, value),
        }
    }

    pub(super) fn check_count(
        &mut self,
        here: &Here,
        wanted: usize,
        (found, list): (usize, &[Argument]),
        span: Span,
    ) -> Outcome<()> {
        if wanted == found {
            return Ok(());
        }
        let (least, wanted) = (wanted, count(&(wanted..=wanted), "argument"));
        let call = self.sources.text(span);
        let name = match call.split_once('(') {
            Some((name, _)) => format!("`{}`", name.trim()),
            None => "this function".to_owned(),
        };
        let message = format!("{name} takes {wanted}, and is given {found}");
        let at = match list.get(least..).and_then(|more| surplus(here, more)) {
            Some(more) => more,
            None if found < least => self.end_of_call(span),
            None => span,
        };
        let diagnostic =
            Diagnostic::new(Code::WrongArity, message).at(at, format!("expected {wanted}"));
        // `F(x, y)` for a function of a point.
        let place: String = call.split_whitespace().collect();
        let diagnostic = match place.strip_suffix("(x,y)") {
            Some(name) if least == 3 => {
                let right = format!("{name}(x, y, z)");
                diagnostic.help(format!("write `{right}`")).fix(span, right)
            }
            _ => diagnostic,
        };
        Err(self.report(here, diagnostic))
    }
}
