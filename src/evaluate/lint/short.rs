//! Vectors with fewer components than expected.

use super::is_literal;
use crate::diagnostic::{Code, Diagnostic};
use crate::evaluate::block::Given;
use crate::evaluate::stream::{Token, TokenKind};
use crate::evaluate::value::Value;
use crate::evaluate::{Evaluator, Here};
use crate::math::Vector;
use crate::source::Span;
use crate::syntax::ast::{Argument, Arguments, BinaryOperator, ExpressionId, ExpressionKind};
use crate::vocabulary::{Family, Word};

impl Evaluator<'_> {
    /// Warns of a lost comma: `<1, 2 -3>`. Two components written as two may be intended.
    pub(in crate::evaluate) fn lint_short_vector(&mut self, here: &Here, id: ExpressionId) {
        let expression = here.unit.expression(id);
        let ExpressionKind::Vector(components) = expression.kind else { return };
        if here.unit.ast.arguments(components).len() == 2 {
            self.tell_lost_comma(here, expression.span);
        }
    }

    /// Warns of a comma that became a decimal point, `<-2.1, 0>`, in the position of a shape, a light or the
    /// camera. Translations and factors may have two components.
    pub(in crate::evaluate) fn lint_two_numbers(&mut self, after: &Token, given: &Given<Vector>) {
        let TokenKind::Word(word) = after.kind else { return };
        let Some(id) = given.expression.filter(|_| given.value.z == 0.0) else { return };
        if !matches!(word.family(), Family::Shape | Family::Camera | Family::Light) {
            return;
        }
        self.tell_two_numbers(&given.here, id);
    }

    /// As [`Self::lint_two_numbers`], in a list of points.
    pub(in crate::evaluate) fn tell_two_numbers(&mut self, here: &Here, id: ExpressionId) {
        let expression = here.unit.expression(id);
        let ExpressionKind::Vector(components) = expression.kind else { return };
        let arguments = here.unit.ast.arguments(components);
        if arguments.len() != 2 || self.lost_comma(expression.span).is_some() {
            return;
        }
        let typed = |argument: &Argument| match *argument {
            Argument::Expression(id) => {
                is_literal(self.sources.text(here.unit.expression(id).span))
            }
            Argument::Items(_) => false,
        };
        if !arguments.iter().all(typed) {
            return;
        }
        let (span, text) = (expression.span, self.sources.text(expression.span));
        // An unclosed vector was reported.
        if !text.ends_with('>') {
            return;
        }
        let inside = text.trim_matches(['<', '>']).trim();
        let points: Vec<usize> = text.match_indices('.').map(|(at, _)| at).collect();
        let diagnostic =
            Diagnostic::new(Code::ShortVector, "this vector has two components: its z is 0")
                .at(span, "expected three numbers");
        let diagnostic = match *points.as_slice() {
            [point] => {
                let right = format!("{}, {}", &text[..point], &text[point + 1..]);
                let place = Span { start: span.start + point as u32, ..span };
                diagnostic
                    .help(format!("does a point stand for a comma? write `{right}`"))
                    .fix(Span { end: place.start + 1, ..place }, ", ")
            }
            _ => diagnostic,
        };
        let diagnostic = diagnostic.help(format!("with all three it is `<{inside}, 0>`"));
        self.report(here, diagnostic);
    }

    /// Warns of a difference whose sign touches the second number, which is unlikely: `#declare P = <0, 0.8
    /// -0.5>`.
    pub(in crate::evaluate) fn lint_typed_difference(
        &mut self,
        here: &Here,
        components: Arguments,
        span: Span,
    ) {
        let number = |id| matches!(here.unit.expression(id).kind, ExpressionKind::Number(_));
        let is_typed = |argument: &Argument| match *argument {
            Argument::Expression(id) => match here.unit.expression(id).kind {
                ExpressionKind::Binary(BinaryOperator::Subtract, a, b) => number(a) && number(b),
                _ => false,
            },
            Argument::Items(_) => false,
        };
        if here.unit.ast.arguments(components).iter().any(is_typed) {
            self.tell_lost_comma(here, span);
        }
    }

    fn tell_lost_comma(&mut self, here: &Here, span: Span) {
        let Some((value, parted)) = self.lost_comma(span) else { return };
        let before = self.sources.text(Span { end: value.start, ..span });
        let behind = self.sources.text(Span { start: value.end, ..span });
        let right = format!("{before}{parted}{behind}");
        let message = "this vector has two components: its z is 0";
        let diagnostic = Diagnostic::new(Code::LostComma, message)
            .at(span, format!("`{}` is one number", self.sources.text(value)))
            .help(format!("is a comma missing? write `{right}`"))
            .fix(value, parted);
        self.report(here, diagnostic);
    }

    /// Warns of a difference of an axis and a number whose sign touches it, which subtracts from all three
    /// components: `rotate y -20`.
    pub(in crate::evaluate) fn lint_axis_and_number(
        &mut self,
        token: &Token,
        given: &Given<Vector>,
    ) {
        let Some(id) = given.expression else { return };
        let ExpressionKind::Binary(BinaryOperator::Subtract, axis, number) =
            given.here.unit.expression(id).kind
        else {
            return;
        };
        let kind = |id| given.here.unit.expression(id).kind;
        let is_axis = matches!(kind(axis), ExpressionKind::Word(Word::X | Word::Y | Word::Z));
        if !is_axis || !matches!(kind(number), ExpressionKind::Number(_)) {
            return;
        }
        let text = self.sources.text(given.span);
        let Some((axis, number)) = text
            .split_once(" -")
            .filter(|(_, number)| number.starts_with(|c: char| c.is_ascii_digit() || c == '.'))
        else {
            return;
        };
        let right = format!("-{number}*{}", axis.trim_end());
        let [x, y, z] = given.value.to_array();
        let message = "a number is taken from all three components of this vector";
        let diagnostic = Diagnostic::new(Code::ShortVector, message)
            .at(given.span, format!("this is <{x}, {y}, {z}>"))
            .help(format!("is a `*` missing? write `{} {right}`", self.sources.text(token.span)))
            .fix(given.span, right);
        self.report(&given.here, diagnostic);
    }

    /// Warns of a literal height where the other end is expected: `cylinder { <0, 0, 0>, 2, 0.5 }`.
    pub(in crate::evaluate) fn lint_lone_height(
        &mut self,
        name: &str,
        base: &Given<Vector>,
        cap: &Given<Vector>,
    ) {
        let text = self.sources.text(cap.span);
        // `-1, 1` is a diagonal.
        let is_diagonal = is_literal(self.sources.text(base.span)) && base.value != Vector::ZERO;
        if !is_literal(text) || is_diagonal || cap.value == Vector::ZERO {
            return;
        }
        let ([x, y, z], height) = (base.value.to_array(), cap.value.y);
        let right = format!("<{x}, {}, {z}>", y + height);
        let message =
            format!("the other end of a {name} is a place, and a number is on all three axes");
        let diagnostic = Diagnostic::new(Code::ShortVector, message)
            .at(cap.span, format!("this is <{height}, {height}, {height}>"))
            .help(format!("for a height of {text} write `{right}`"))
            .fix(cap.span, right);
        self.report(&cap.here, diagnostic);
    }

    /// Warns of a literal number where the image's side vector is expected: `right 16/9`.
    pub(in crate::evaluate) fn lint_lone_side(
        &mut self,
        given: &Given<Vector>,
        word: Word,
        axis: char,
    ) {
        let text = self.sources.text(given.span);
        let is_typed = text.chars().all(|c| c.is_ascii_digit() || " ./*()".contains(c));
        if !is_typed {
            return;
        }
        let (name, right) = (word.name(), format!("{text}*{axis}"));
        let message = format!("`{name}` is a vector, and a number goes along all three axes");
        let diagnostic = Diagnostic::new(Code::ShortVector, message)
            .at(given.span, format!("this is <{text}, {text}, {text}>"))
            .help(format!("write `{name} {right}`"))
            .fix(given.span, right);
        self.report(&given.here, diagnostic);
    }

    /// Warns of a vector with fewer components than its keyword takes: `rgbt <1, 1, 1>`.
    pub(in crate::evaluate) fn lint_short_color(
        &mut self,
        given: &Given<Value>,
        word: Word,
        lacking: &str,
    ) {
        let name = word.name();
        let opaque = name.trim_end_matches(['f', 't']);
        let text = self.sources.text(given.span);
        // `rgbt <1, 0, 0>, 0.5` is reported as such.
        let rest = self.sources.get(given.span.file).text.get(given.span.end as usize..);
        let number = rest.and_then(|rest| rest.trim_start().strip_prefix(',')).map(str::trim_start);
        let goes_on =
            number.is_some_and(|text| text.starts_with(|c: char| c.is_ascii_digit() || c == '.'));
        if goes_on || !text.starts_with('<') {
            return;
        }
        let message = format!("this `{name}` is given red, green and blue alone");
        let diagnostic = Diagnostic::new(Code::ShortVector, message)
            .at(given.span, format!("its `{lacking}` is 0"))
            .help(format!("add the number, or write `{opaque} {text}`"));
        self.report(&given.here, diagnostic);
    }
}
