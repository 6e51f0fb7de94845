//! Parts of a block: values after keywords, converted to the expected kind.

use crate::diagnostic::{Code, Diagnostic};
use crate::math::Vector;
use crate::scene::ObjectId;
use crate::source::{Site, Span};
use crate::syntax::ast::{ExpressionId, ItemKind};
use crate::vocabulary::Word;

use super::super::stream::{Token, TokenKind};
use super::super::value::Value;
use super::super::{Evaluator, Here, Outcome, Reported};

/// A value and its span.
#[derive(Debug, Clone)]
pub(in crate::evaluate) struct Given<T> {
    pub value: T,
    pub span: Span,
    pub here: Here,
    /// Its expression, if it is a single one.
    pub expression: Option<ExpressionId>,
}

impl<T> Given<T> {
    pub fn site(&self) -> Site {
        self.here.site(self.span)
    }

    pub fn with<U>(self, value: U) -> Given<U> {
        Given { value, span: self.span, here: self.here, expression: self.expression }
    }
}

impl Evaluator<'_> {
    /// Returns the span from the start of `opener` to the end of the item taken last. If a directive separates
    /// the two, it includes all items that contain both.
    pub(super) fn whole(&self, opener: &Token) -> Site {
        let opener = opener.here.site(opener.span);
        self.joined(opener, self.taken.unwrap_or(opener))
    }

    /// As [`Self::whole`], for two positions in one block.
    pub(super) fn joined(&self, a: Site, b: Site) -> Site {
        let [a, b] = self.scene.expansions.side_by_side(a, b);
        let between = Span { end: b.span.start, ..a.span };
        if a.span.file != b.span.file || self.sources.text(between).contains('#') {
            let all = a.span.to(b.span);
            // Lookahead may have left a macro; what is written in its file has not.
            let unit = self.frames.iter().rev().map(|frame| &frame.here.unit);
            let unit = unit.into_iter().find(|unit| unit.ast.file == all.file);
            return match unit.and_then(|unit| unit.ast.around(all)) {
                Some(span) if a.span.file == b.span.file => Site { span, ..a },
                _ => self.within_block().unwrap_or(a),
            };
        }
        Site { span: a.span.to(b.span), ..a }
    }

    /// Returns the span between the braces of the block being read; `None` if the block is never closed.
    pub(in crate::evaluate) fn within_block(&self) -> Option<Site> {
        let Site { span, expansion } = *self.blocks.last()?;
        let inside = self.sources.text(span).strip_prefix('{')?.strip_suffix('}')?;
        let start = span.start + 1;
        Some(Site { span: Span { start, end: start + inside.len() as u32, ..span }, expansion })
    }

    /// Records the site of a whole object in the scene or a union.
    pub(super) fn note_item(&mut self, object: ObjectId, token: &Token) {
        let whole = self.whole(token);
        self.scene.objects[object.index()].item = Some(whole);
    }

    /// Takes and returns the token of the value after `after` (a keyword of the block, or what opened it).
    fn value_token(&mut self, after: &Token, wanted: &str) -> Outcome<Token> {
        let passed = self.silent.is_none() && self.pass(ItemKind::Comma);
        // The most common form.
        if passed && self.peeks_value() {
            return self.next().ok_or(Reported);
        }
        let comma = matches!(self.peek(), Some(Token { kind: TokenKind::Comma, .. }));
        if comma && let Some(reported) = self.comma_for_value(after, wanted) {
            return Err(reported);
        }
        let silent = self.silent.filter(|_| !passed);
        // A macro that gave nothing may have stood before a comma; for the first part it must have.
        let lost = silent.is_some() && self.taken == self.blocks.last().copied();
        if comma && !lost {
            self.skip_commas();
        }
        // The first part of a block has no comma before it.
        if !passed && !comma && self.taken != self.blocks.last().copied() {
            self.semicolon_for_comma();
        }
        if !self.peeks_value() {
            self.silent = self.silent.or(silent);
            if let Some(reported) = self.blame_macro(wanted) {
                return Err(reported);
            }
            let next = self.peek().cloned();
            let place = next.as_ref().map_or(after.span, |next| next.span);
            let place = after.here.site(place);
            if self.missing_at.replace(place) == Some(place) {
                return Err(Reported);
            }
            if let Some(next) = &next {
                let told = self.value_in_braces(after, next, wanted);
                if let Some(reported) = told.or_else(|| self.late_parts(after, next, wanted)) {
                    return Err(reported);
                }
            }
            let diagnostic = self.missing(after, next.as_ref(), wanted);
            return Err(self.report(&after.here, diagnostic));
        }
        self.next().ok_or(Reported)
    }

    fn peeks_value(&mut self) -> bool {
        let next = self.peek().map(|token| &token.kind);
        matches!(next, Some(TokenKind::Expression(_) | TokenKind::Literal(_)))
    }

    /// Reads the value after `after`.
    pub(super) fn given(&mut self, after: &Token, wanted: &str) -> Outcome<Given<Value>> {
        let token = self.value_token(after, wanted)?;
        self.given_by(token)
    }

    fn given_by(&mut self, token: Token) -> Outcome<Given<Value>> {
        let (value, expression) = match &token.kind {
            TokenKind::Expression(id) => match self.misspelt_block(&token, *id) {
                // `sphere { 0 pigmant { … } }`
                Some(reported) => return Err(reported),
                None => match self.joined_value(&token) {
                    Ok(value) => (value, Some(*id)),
                    Err(reported) => {
                        self.tell_broken_object(&token, *id);
                        return Err(reported);
                    }
                },
            },
            TokenKind::Literal(_) => (self.joined_value(&token)?, None),
            _ => return Err(Reported),
        };
        match value {
            Value::Poison(poison) => {
                self.set_poison(poison);
                return Err(Reported);
            }
            Value::Broken => return Err(Reported),
            _ => {}
        }
        Ok(Given { value, span: token.span, here: token.here, expression })
    }

    pub(in crate::evaluate) fn number_after(
        &mut self,
        after: &Token,
        wanted: &str,
    ) -> Outcome<Given<f64>> {
        let token = self.value_token(after, wanted)?;
        if let TokenKind::Expression(id) = token.kind
            && !self.is_by_directive()
            && let Some(value) = self.plain_number(&token.here, id)
        {
            return Ok(Given { value, span: token.span, here: token.here, expression: Some(id) });
        }
        let given = self.given_by(token)?;
        match given.value.as_number() {
            Some(number) => Ok(given.with(number)),
            None => Err(self.no_number(after, &given, wanted)),
        }
    }

    pub(in crate::evaluate) fn as_number(
        &mut self,
        here: &Here,
        span: Span,
        value: &Value,
        wanted: &str,
    ) -> Outcome<f64> {
        match value.as_number() {
            Some(number) => Ok(number),
            None => Err(self.wrong_type(here, span, wanted, value)),
        }
    }

    pub(super) fn vector_after(&mut self, after: &Token, wanted: &str) -> Outcome<Given<Vector>> {
        if !self.takes_bare_numbers(after)
            && let Some(reported) = self.bare_points(1, 0)
        {
            self.skip_values();
            return Err(reported);
        }
        let token = self.value_token(after, wanted)?;
        match self.given_vector(token) {
            Ok(given) => {
                self.lint_two_numbers(after, &given);
                Ok(given)
            }
            Err(token) => self.given_by(token).and_then(|given| self.as_vector(given, wanted)),
        }
    }

    /// Returns the vector that a token denotes if it is a plain one, otherwise the token.
    fn given_vector(&mut self, token: Token) -> Result<Given<Vector>, Token> {
        if let TokenKind::Expression(id) = token.kind
            && let Some(Ok(value)) = self.vector_of_component(&token.here, id)
        {
            return Ok(Given { value, span: token.span, here: token.here, expression: Some(id) });
        }
        if let TokenKind::Expression(id) = token.kind
            && let Some(value) = self.plain_vector(&token.here, id)
        {
            if value.z == 0.0 {
                self.lint_short_vector(&token.here, id);
            }
            return Ok(Given { value, span: token.span, here: token.here, expression: Some(id) });
        }
        Err(token)
    }

    /// Reads a vector followed by a number.
    pub(super) fn vector_and_number(
        &mut self,
        after: &Token,
        (vector, number): (&str, &str),
    ) -> (Outcome<Given<Vector>>, Outcome<Given<f64>>) {
        if let Some(reported) = self.bare_points(1, 1) {
            return (Err(reported), Err(reported));
        }
        let first = match self.value_token(after, vector).map(|token| self.given_vector(token)) {
            Ok(Ok(first)) => {
                self.lint_two_numbers(after, &first);
                return (Ok(first), self.number_after(after, number));
            }
            Ok(Err(token)) => self.given_by(token),
            Err(Reported) => Err(Reported),
        };
        if let Ok(given) = &first
            && let Some(reported) = self.number_within(given, number)
        {
            return (Err(reported), Err(reported));
        }
        let second = self.given(after, number);
        if let (Ok(a), Ok(b)) = (&first, &second)
            && let (Value::Number(a_number), Value::Vector(_)) = (&a.value, &b.value)
            // A sphere of radius 0 is not intended.
            && (*a_number != 0.0 || after.kind != TokenKind::Word(Word::Sphere))
        {
            let reported = match self.arguments_behind([a, b]) {
                Some([x, y]) => self.swapped(x, y, vector, number, Some(a.span.to(b.span))),
                None => self.swapped(a.site(), b.site(), vector, number, None),
            };
            return (Err(reported), Err(reported));
        }
        let second = second.and_then(|given| match given.value.as_number() {
            Some(number) => Ok(given.with(number)),
            None => Err(self.no_number(after, &given, number)),
        });
        (first.and_then(|given| self.as_vector(given, vector)), second)
    }

    pub(super) fn as_vector(
        &mut self,
        given: Given<Value>,
        wanted: &str,
    ) -> Outcome<Given<Vector>> {
        match given.value.as_vector3() {
            Some(vector) => {
                if let (Value::Vector(components), Some(id)) = (&given.value, given.expression)
                    && components.len() == 2
                {
                    self.lint_short_vector(&given.here, id);
                }
                Ok(given.with(vector))
            }
            None => Err(self.wrong_vector(&given, wanted)),
        }
    }

    /// Reports a value that is not a vector of three where one is expected.
    fn wrong_vector(&mut self, given: &Given<Value>, wanted: &str) -> Reported {
        match &given.value {
            Value::Vector(components) => {
                let diagnostic = Diagnostic::new(
                    Code::WrongArity,
                    format!("expected {wanted} of three components, found {}", components.len()),
                )
                .at(given.span, "too many components");
                let diagnostic = match self.commas_within(given.span) {
                    Some(vector) => diagnostic
                        .help(format!("a fraction is written with a point: `{vector}`"))
                        .fix(given.span, vector),
                    None => diagnostic,
                };
                self.report(&given.here, diagnostic)
            }
            other => self.wrong_type(&given.here, given.span, wanted, other),
        }
    }

    /// Reads a direction: any vector but zero.
    pub(super) fn direction_after(&mut self, after: &Token, what: &str) -> Outcome<Given<Vector>> {
        let given = self.vector_after(after, &format!("a vector for {what}"))?;
        self.as_direction(given, what)
    }

    pub(super) fn as_direction(
        &mut self,
        given: Given<Vector>,
        what: &str,
    ) -> Outcome<Given<Vector>> {
        if given.value == Vector::ZERO {
            return Err(self.report(&given.here, points_nowhere(&given, what)));
        }
        Ok(given)
    }

    /// As [`Self::direction_after`], but also accepts the zero vector where POV-Ray renders the scene with
    /// it.
    pub(super) fn any_direction_after(
        &mut self,
        after: &Token,
        what: &str,
    ) -> Outcome<Given<Vector>> {
        let given = self.vector_after(after, &format!("a vector for {what}"))?;
        if given.value == Vector::ZERO {
            self.opinion(&given.here, points_nowhere(&given, what))?;
        }
        Ok(given)
    }

    /// Reads an optional number.
    pub(super) fn optional_number(&mut self, after: &Token, otherwise: f64) -> Outcome<f64> {
        // Probably the next word, misspelt.
        if self.peeks_unknown_name() {
            return Ok(otherwise);
        }
        match self.peeks_value() {
            true => Ok(self.number_after(after, "a number")?.value),
            false => Ok(otherwise),
        }
    }

    /// Returns whether an undeclared name comes next.
    pub(super) fn peeks_unknown_name(&mut self) -> bool {
        let Some(Token { kind: TokenKind::Expression(id), here, .. }) = self.peek() else {
            return false;
        };
        let (id, here) = (*id, here.clone());
        self.unknown_name(&here, id).is_some()
    }

    /// Reads an optional truth value; without one, true.
    pub(super) fn optional_flag(&mut self, after: &Token) -> Outcome<bool> {
        Ok(self.optional_number(after, 1.0)? != 0.0)
    }
}

fn points_nowhere(given: &Given<Vector>, what: &str) -> Diagnostic {
    Diagnostic::new(Code::ZeroVector, format!("{what} is the zero vector, and points nowhere"))
        .at(given.span, "expected a vector other than <0, 0, 0>")
        .help("a direction such as `y`, which points up")
}
