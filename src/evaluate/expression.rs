//! Evaluation of expressions.

use crate::diagnostic::{Code, Diagnostic};
use crate::math::Vector;
use crate::source::Span;
use crate::syntax::ast::{ExpressionId, ExpressionKind};
use crate::vocabulary::{Dialect, Word};

use super::comparison::Comparison;
use super::lint::Side;
use super::stream::TokenKind;
use super::value::{self, Components, OperationError, Poison, Value};
use super::{Evaluator, Here, Outcome, Reported, builtin};

impl Evaluator<'_> {
    /// Returns the value of an expression; poison if part of it is unsupported.
    pub(super) fn expression(&mut self, here: &Here, id: ExpressionId) -> Outcome<Value> {
        match self.plain_number(here, id) {
            Some(number) => Ok(Value::Number(number)),
            None => self.any_value(here, id),
        }
    }

    /// As [`Self::expression`], for an expression that [`Self::plain_number`] does not handle.
    #[inline(never)]
    pub(super) fn any_value(&mut self, here: &Here, id: ExpressionId) -> Outcome<Value> {
        let expression = here.unit.expression(id);
        match expression.kind {
            ExpressionKind::Number(number) if number.is_finite() => Ok(Value::Number(number)),
            ExpressionKind::Triple(triple) => {
                let [x, y, z] = here.unit.ast.triple(triple);
                Ok(Value::Vector(Vector::new(x, y, z).into()))
            }
            ExpressionKind::Number(number) => {
                let message = "this number is too large: the largest is about 1.8e308";
                let diagnostic =
                    Diagnostic::new(Code::NotANumber, message).at(expression.span, "too large");
                self.opinion(here, diagnostic)?;
                Ok(Value::Number(number))
            }
            ExpressionKind::Name(name) => self.name_value(here, here.symbol(name), expression.span),
            ExpressionKind::Word(word) => self.word_value(here, word, expression.span),
            ExpressionKind::String => self.string_value(here, expression.span),
            ExpressionKind::Missing => Err(Reported),
            ExpressionKind::Joint => Err(self.nothing_joined(here, expression.span)),
            // Nested brackets.
            kind => {
                if let ExpressionKind::Vector(components) = kind
                    && let Some(vector) = self.plain_triple(here, components)
                {
                    return Ok(Value::Vector(vector.into()));
                }
                self.calculating += 1;
                let value = stacker::maybe_grow(64 * 1024, 1024 * 1024, || self.compound(here, id));
                self.calculating -= 1;
                value
            }
        }
    }

    fn compound(&mut self, here: &Here, id: ExpressionId) -> Outcome<Value> {
        let expression = here.unit.expression(id);
        match expression.kind {
            ExpressionKind::Unary(operator, operand) => {
                let value = self.operand(here, operand)?;
                self.lint_loose_sign(here, operator, operand);
                if let Value::Poison(_) = value {
                    return Ok(value);
                }
                value::unary(operator, &value, self.comparison()).map_err(|error| {
                    self.operation_error(
                        here,
                        error,
                        "this sign",
                        expression.span,
                        [operand; 2],
                        [&value; 2],
                    )
                })
            }
            ExpressionKind::Binary(..) => self.sum(here, id),
            ExpressionKind::Conditional(condition, then, otherwise) => {
                let condition = self.expression(here, condition);
                let comparison = self.comparison();
                let truth = condition.as_ref().ok().and_then(|value| value.as_truth(comparison));
                // Both arms are evaluated, as POV-Ray does, since both may draw from random streams;
                // what the arm not taken complains of is no mistake: `B = 0 ? 0 : A / B`.
                let then = self.arm(here, then, truth != Some(false));
                let otherwise = self.arm(here, otherwise, truth != Some(true));
                match (condition?, truth) {
                    (poison @ Value::Poison(_), _) => Ok(poison),
                    (_, Some(true)) => then,
                    (_, Some(false)) => otherwise,
                    (condition, None) => Err(self.wrong_type(
                        here,
                        expression.span,
                        "a number before `?`",
                        &condition,
                    )),
                }
            }
            ExpressionKind::Vector(components) => {
                self.vector_value(here, components, expression.span)
            }
            ExpressionKind::Call(callee, arguments) => {
                self.call(here, callee, arguments, expression.span)
            }
            ExpressionKind::Index(..) => self.indexed(here, id),
            ExpressionKind::Component(base, component) => {
                let value = self.operand(here, base);
                self.check_component(here, base, component)?;
                self.component_value(here, &value?, component, here.unit.expression(base).span)
            }
            ExpressionKind::Group(inner) => self.expression(here, inner),
            ExpressionKind::GroupItems(items) => {
                self.inside(here, items, |evaluator| evaluator.only_value(here, expression.span))
            }
            ExpressionKind::Number(_)
            | ExpressionKind::Triple(_)
            | ExpressionKind::String
            | ExpressionKind::Name(_)
            | ExpressionKind::Word(_)
            | ExpressionKind::Joint
            | ExpressionKind::Missing => self.expression(here, id),
        }
    }

    /// Evaluates a chain of operations iteratively from the leftmost operand: they nest to the left as deeply
    /// as they are long.
    fn sum(&mut self, here: &Here, id: ExpressionId) -> Outcome<Value> {
        if self.options.dialect == Dialect::Pov && self.holds_bare_operation(here, id) {
            return self.spliced_value(here, id);
        }
        let mut first = id;
        while let ExpressionKind::Binary(_, left, _) = here.unit.expression(first).kind {
            first = left;
        }
        self.sum_from(here, id, first)
    }

    /// As [`Self::expression`], with a given value for the leftmost operand.
    pub(super) fn sum_from(
        &mut self,
        here: &Here,
        id: ExpressionId,
        leftmost: ExpressionId,
    ) -> Outcome<Value> {
        let mut operations = Vec::new();
        let mut innermost = id;
        while let ExpressionKind::Binary(_, left, _) = here.unit.expression(innermost).kind
            && matches!(here.unit.expression(left).kind, ExpressionKind::Binary(..))
        {
            operations.push(innermost);
            innermost = left;
        }
        let value = self.operand(here, leftmost);
        let value = self.operation(here, innermost, value);
        operations.into_iter().rev().fold(value, |value, id| self.operation(here, id, value))
    }

    /// Applies one operation, whose left operand is `value`.
    fn operation(
        &mut self,
        here: &Here,
        id: ExpressionId,
        value: Outcome<Value>,
    ) -> Outcome<Value> {
        let expression = here.unit.expression(id);
        let ExpressionKind::Binary(operator, left, right) = expression.kind else { return value };
        // Both sides are evaluated before either fails: each may report, and both draw from streams.
        let operand = self.operand(here, right);
        self.lint_loose_operand(here, operator, Side::Left, left);
        self.lint_loose_operand(here, operator, Side::Right, right);
        match (value, operand) {
            (Err(Reported), _) | (_, Err(Reported)) => Err(Reported),
            (Ok(poison @ Value::Poison(_)), _) | (_, Ok(poison @ Value::Poison(_))) => Ok(poison),
            (Ok(a), Ok(b)) => value::binary(operator, &a, &b, self.comparison()).or_else(|error| {
                let places = (expression.span, [left, right]);
                self.no_plain_result(here, operator, error, places, [&a, &b])
            }),
        }
    }

    /// Returns the value of an operand. A name that holds a colour or five numbers is read back in single
    /// precision.
    pub(super) fn operand(&mut self, here: &Here, id: ExpressionId) -> Outcome<Value> {
        let value = self.expression(here, id)?;
        Ok(match here.unit.expression(id).kind {
            ExpressionKind::Name(_) | ExpressionKind::Index(..) => value.read_back(),
            _ => value,
        })
    }

    fn arm(&mut self, here: &Here, id: ExpressionId, taken: bool) -> Outcome<Value> {
        let (before, ends) = (self.diagnostics.len(), self.ends_told.len());
        let value = self.expression(here, id);
        // Only what a calculation complains of: `B = 0 ? 0 : A / B`. A name that is not declared is a
        // mistake in either arm, and what halts the scene has halted it.
        if !taken && !self.halted {
            self.diagnostics.retain_after(before, |said| !said.code.is_about_calculation());
            self.ends_told.truncate(ends);
        }
        value
    }

    fn name_value(&mut self, here: &Here, symbol: super::Symbol, span: Span) -> Outcome<Value> {
        match self.scopes.read(symbol) {
            Some(Value::Broken) => Err(Reported),
            Some(Value::Macro(_)) => Err(self.macro_not_called(here, symbol, span)),
            Some(value) => Ok(value.clone()),
            None => Err(self.undeclared(here, symbol, span)),
        }
    }

    fn word_value(&mut self, here: &Here, word: Word, span: Span) -> Outcome<Value> {
        let axis = |v| Ok(Value::vector3(v));
        let axis_of = |v| Ok(Components::new(v).map_or(Value::Broken, Value::Vector));
        let number = |n| Ok(Value::Number(n));
        match word {
            Word::X => axis(Vector::X),
            Word::Y => axis(Vector::Y),
            Word::Z => axis(Vector::Z),
            Word::U => axis_of(&[1.0, 0.0]),
            Word::V => axis_of(&[0.0, 1.0]),
            Word::T => axis_of(&[0.0, 0.0, 0.0, 1.0]),
            Word::Pi => number(std::f64::consts::PI),
            Word::True | Word::On | Word::Yes => number(1.0),
            Word::False | Word::Off | Word::No => number(0.0),
            Word::Clock => number(self.options.clock),
            Word::ClockOn => {
                let options = &self.options;
                number(f64::from(options.animation.is_some() || options.clock != 0.0))
            }
            Word::Now => number(self.options.now),
            Word::Version => number(self.version),
            _ => Ok(Value::Poison(Poison::new(word, here.site(span)))),
        }
    }

    fn string_value(&mut self, here: &Here, span: Span) -> Outcome<Value> {
        match builtin::escape::decode_escapes(self.quoted(span)) {
            Ok(_) if self.is_ascii && !self.quoted(span).is_ascii() => {
                self.string_of_bytes(here, span)
            }
            Ok(text) => Ok(Value::string(text)),
            Err((offset, message)) => {
                let start = span.start as usize + 1 + offset;
                let span = Span::new(span.file, start, start + 1);
                let diagnostic = Diagnostic::new(Code::OutOfRange, message).at(span, "this escape");
                Err(self.report(here, diagnostic))
            }
        }
    }

    /// Evaluates a string with bytes beyond ASCII: without `charset utf8`, POV-Ray 3.7 reads each such byte
    /// as a blank (measured).
    fn string_of_bytes(&mut self, here: &Here, span: Span) -> Outcome<Value> {
        let is_latin = self.sources.get(span.file).is_latin;
        let mut bytes = String::new();
        for character in self.quoted(span).chars() {
            match character.len_utf8() {
                1 => bytes.push(character),
                _ if is_latin => bytes.push(' '),
                count => bytes.extend(std::iter::repeat_n(' ', count)),
            }
        }
        let message = "this string holds characters beyond ASCII, which are blanks in POV-Ray";
        let diagnostic = Diagnostic::new(Code::OutOfRange, message)
            .at(span, "a blank for each byte of them")
            .help("write `global_settings { charset utf8 }` before it, in a file of UTF-8");
        self.opinion(here, diagnostic)?;
        let text = builtin::escape::decode_escapes(&bytes);
        Ok(text.map_or(Value::Broken, Value::string))
    }

    /// As [`Self::raw_string`]; `None` if the string was never closed, which has been reported.
    pub(super) fn whole_string(&self, span: Span) -> Option<String> {
        let text = self.sources.text(span);
        (text.len() >= 2 && text.ends_with('"')).then(|| self.raw_string(span))
    }

    /// Returns a string's text between its quotes, with escapes as written.
    pub(super) fn raw_string(&self, span: Span) -> String {
        self.quoted(span).to_owned()
    }

    fn quoted(&self, span: Span) -> &str {
        let text = self.sources.text(span);
        let text = text.strip_prefix('"').unwrap_or(text);
        text.strip_suffix('"').unwrap_or(text)
    }

    /// Returns the CSG solid that `A - B` or `A + B` of two declared objects probably means.
    fn objects_of(&self, what: &str, values: [&Value; 2], spans: [Span; 2]) -> Option<String> {
        let word = match what {
            "`-`" => Word::Difference,
            "`+`" => Word::Union,
            _ => return None,
        };
        let names = spans.map(|span| self.sources.text(span));
        let is_object = values.iter().all(|value| matches!(value, Value::Object(_)));
        let is_name = |name: &&str| self.scopes.symbol(name).is_some();
        let [a, b] = names;
        (is_object && names.iter().all(is_name))
            .then(|| format!("{} {{ object {{ {a} }} object {{ {b} }} }}", word.name()))
    }

    pub(super) fn operation_error(
        &mut self,
        here: &Here,
        error: OperationError,
        what: &str,
        span: Span,
        operands: [ExpressionId; 2],
        values: [&Value; 2],
    ) -> Reported {
        let spans = operands.map(|id| here.unit.expression(id).span);
        let diagnostic = match error {
            OperationError::NotNumeric(index)
                if self.is_refused_again(here, spans[index], values[index]) =>
            {
                return Reported;
            }
            OperationError::NotNumeric(index) => {
                let kind = values[index].kind();
                // `strlen(S) + "1"`: a number in quotes is meant as a number.
                let is_sum = matches!(values[1 - index], Value::Number(_));
                if let Value::String(found) = values[index]
                    && what == "`+`"
                    && !(is_sum && found.trim().parse::<f64>().is_ok())
                    && let Some(joined) = self.joined_strings(here, span, spans)
                {
                    return self.report(here, joined);
                }
                let diagnostic = Diagnostic::new(
                    Code::WrongType,
                    format!("{what} works on numbers, vectors and colours, not on {kind}"),
                )
                .at(spans[index], format!("this is {kind}"));
                let diagnostic = self.given_by_call(here, spans[index], values[index], diagnostic);
                let text = self.sources.text(spans[index]);
                match values[index] {
                    Value::String(found) if found.trim().parse::<f64>().is_ok() => {
                        let meant = match text.starts_with('"') {
                            true => found.trim().to_owned(),
                            false => format!("val({text})"),
                        };
                        diagnostic
                            .help(format!("write `{meant}` for the number in it"))
                            .fix(spans[index], meant)
                    }
                    Value::Array(_) => diagnostic
                        .help(format!("how many elements it has is `dimension_size({text}, 1)`")),
                    Value::Object(_) if what == "`*`" => diagnostic.help(format!(
                        "an object is scaled in its block: `object {{ {text} scale … }}`"
                    )),
                    Value::Object(_) if let Some(whole) = self.objects_of(what, values, spans) => {
                        diagnostic.help(format!("write `{whole}`")).fix(span, whole)
                    }
                    Value::Object(_) if what == "`-`" => diagnostic.help(
                        "objects are taken from others in a `difference`, and moved by `translate`",
                    ),
                    Value::Object(_) if what == "`+`" => diagnostic
                        .help("objects are put together in a `union`, and moved by `translate`"),
                    _ => diagnostic,
                }
            }
            OperationError::DivisionByZero | OperationError::NotFinite => {
                self.no_finite_result(here, error, span, operands[1])
            }
        };
        self.report(here, diagnostic)
    }

    // What a place needs.

    pub(super) fn number(&mut self, here: &Here, id: ExpressionId) -> Outcome<f64> {
        if let Some(number) = self.plain_number(here, id) {
            return Ok(number);
        }
        let value = self.any_value(here, id)?;
        self.as_number(here, here.unit.expression(id).span, &value, "a number")
    }

    pub(super) fn string(&mut self, here: &Here, id: ExpressionId) -> Outcome<String> {
        if let Some(reported) = self.lacks_quotes(here, id) {
            return Err(reported);
        }
        match self.expression(here, id)? {
            Value::String(text) => Ok(text.to_string()),
            other => Err(self.wrong_type(here, here.unit.expression(id).span, "a string", &other)),
        }
    }

    pub(super) fn comparison(&self) -> Comparison {
        Comparison::of(self.options.dialect)
    }

    /// Evaluates a condition, which must have a known value: poison is an error here.
    pub(super) fn condition(&mut self, here: &Here, id: ExpressionId) -> Outcome<bool> {
        if let Some(number) = self.plain_number(here, id) {
            return Ok(self.comparison().is_true(number));
        }
        let value = self.any_value(here, id)?;
        let span = here.unit.expression(id).span;
        match value.as_truth(self.comparison()) {
            Some(truth) => Ok(truth),
            None => Err(self.wrong_type(here, span, "a number as condition", &value)),
        }
    }

    /// Returns the only value that the current items leave.
    pub(super) fn only_value(&mut self, here: &Here, span: Span) -> Outcome<Value> {
        let value = self.value_or(here, span)?;
        while matches!(self.peek().map(|token| &token.kind), Some(TokenKind::Semicolon)) {
            self.next();
        }
        match self.next() {
            Some(extra) => Err(self.more_than_one(&extra)),
            None => Ok(value),
        }
    }
}
