//! Reports a `:` without a `?`: after a type or an argument's name, beside a comma or in its place.
//!
//! **Invariant:** one diagnostic for each sign, with its probable meaning.

use super::ast::{BinaryOperator, Callee, DirectiveKind, ExpressionKind, Item, ItemKind};
use super::expression::OperatorKind;
use super::nest::{FrameKind, Nest, State};
use super::token::{Bracket, Mark, TokenKind};
use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::vocabulary::Word;

/// Names of parameter types in other languages.
const TYPES: &[&str] = &[
    "array", "bool", "boolean", "color", "colour", "double", "f32", "f64", "float", "float3",
    "int", "integer", "list", "num", "number", "object", "real", "scalar", "str", "string", "vec2",
    "vec3", "vector", "vector3",
];

impl<'a> Nest<'a> {
    pub(super) fn lone_colon(&mut self, span: Span) {
        let (state, base) = (self.top().state, self.top().operators);
        let alone = matches!(state, State::Holding { .. }) && self.stacks.operators.len() == base;
        let held = self.stacks.operands.last().map(|held| *self.ast.expression(*held));
        let kind = held.map(|held| held.kind);
        // `xyz(2, 0, 1): 3` in a `polynomial`.
        if let Some(ExpressionKind::Call(Callee::Word(Word::Xyz, _), _)) = kind
            && alone
        {
            return self.finish_expression();
        }
        if self.is_in_unknown_block() {
            return;
        }
        let told = Diagnostic::new(Code::UnexpectedCharacter, "this `:` belongs to no `?`");
        if self.parts_nothing() {
            return self.report(told.at(span, "it parts nothing: leave it out").fix(span, ""));
        }
        if self.lists_parameters() {
            return self.colon_of_parameter(span);
        }
        let first = self.items.len() == self.top().items;
        let called = matches!(self.top().kind, FrameKind::Call(Callee::Name(..)));
        if let (Some(ExpressionKind::Name(_)), Some(held)) = (kind, held)
            && alone
            && first
            && called
        {
            return self.named_argument(held.span.to(span));
        }
        if alone && self.ends_a_declaration() {
            self.report(
                Diagnostic::new(Code::Semicolon, "a declaration ends with `;`, and not with `:`")
                    .at(span, "expected `;` here")
                    .fix(span, ";"),
            );
            self.finish_expression();
            return self.item(ItemKind::Semicolon, span);
        }
        let told = told.at(span, "expected `condition ? one : other`");
        let told = match kind {
            // `translate y: 2`: a direction, and a distance.
            Some(ExpressionKind::Word(word @ (Word::X | Word::Y | Word::Z))) => {
                self.times(told, word, span)
            }
            // `right 16:9*x`: an aspect ratio.
            Some(ExpressionKind::Number(wide)) if self.is_ratio(wide) => {
                let told = told.help("a ratio is a quotient: write `/`").fix(span, "/");
                self.report(told);
                return self.operator(OperatorKind::Binary(BinaryOperator::Divide), span);
            }
            // `spline { 0: x, 1: y }`.
            Some(ExpressionKind::Number(_)) => {
                told.help("values are parted by commas").fix(span, ",")
            }
            _ => told,
        };
        self.report(told);
    }

    /// Returns whether the number and the one after the colon form an aspect ratio such as `16:9`.
    fn is_ratio(&self, wide: f64) -> bool {
        let next = self.tokens.get(self.at + 1).map(|next| self.span(*next));
        let high = next.and_then(|next| self.slice(next).parse::<f64>().ok());
        let ratios = [(4.0, 3.0), (5.0, 4.0), (3.0, 2.0), (16.0, 9.0), (16.0, 10.0), (21.0, 9.0)];
        high.is_some_and(|high| ratios.contains(&(wide, high)))
    }

    /// Returns whether the colon ends a line such as `#declare A = 3:`.
    fn ends_a_declaration(&self) -> bool {
        let Some(Item { kind: ItemKind::Directive(id), .. }) = self.items.last() else {
            return false;
        };
        let next = self.tokens.get(self.at + 1).map_or(self.end, |next| next.start as usize);
        let here = self.span(self.tokens[self.at]);
        matches!(self.ast.directive(*id).kind, DirectiveKind::Declare { .. })
            && self.text.get(here.end as usize..next).is_none_or(|gap| gap.contains('\n'))
    }

    /// `dictionary { ["sky"]: 1 }`: returns whether the error is the block's keyword, which is reported.
    fn is_in_unknown_block(&self) -> bool {
        let mut depth = 0;
        for at in (0..self.at).rev() {
            match self.tokens[at].kind {
                TokenKind::Mark(Mark::Close(Bracket::Brace)) => depth += 1,
                TokenKind::Mark(Mark::Open(Bracket::Brace)) if depth > 0 => depth -= 1,
                TokenKind::Mark(Mark::Open(Bracket::Brace)) => {
                    let before = at.checked_sub(1).map(|before| self.tokens[before].kind);
                    return before == Some(TokenKind::Name);
                }
                TokenKind::Directive(_) => return false,
                _ => {}
            }
        }
        false
    }

    fn times(&self, told: Diagnostic, direction: Word, span: Span) -> Diagnostic {
        let number = self.tokens.get(self.at + 1).map(|token| self.span(*token));
        let number = number.filter(|number| {
            self.slice(*number).starts_with(|c: char| c.is_ascii_digit() || c == '.')
        });
        let Some(number) = number else { return told };
        told.help(format!("write `{}*{}`", direction.name(), self.slice(number)))
            .fix(Span { end: number.start, ..span }, "*")
    }

    /// `f(a:, b)`, `<1, :2>`: returns whether the colon is beside a comma, or a bracket.
    fn parts_nothing(&self) -> bool {
        let before = self.at.checked_sub(1).and_then(|at| self.tokens.get(at));
        let behind = self.tokens.get(self.at + 1);
        let begins = |kind| matches!(kind, TokenKind::Mark(Mark::Comma | Mark::Open(_)));
        let ends = |kind| matches!(kind, TokenKind::Mark(Mark::Comma | Mark::Close(_)));
        before.is_some_and(|before| begins(before.kind))
            || behind.is_some_and(|behind| ends(behind.kind))
    }

    /// Returns whether the colon is among the parameters of a `#macro`, or of a `function`.
    fn lists_parameters(&mut self) -> bool {
        let base = self.top().items;
        let before = base.checked_sub(1).and_then(|at| self.items.get(at)).map(|item| item.kind);
        self.in_macro_head()
            || matches!(self.top().kind, FrameKind::Group)
                && matches!(before, Some(ItemKind::Word(Word::Function)))
    }

    /// Reports `function(x: float)`, `function(x: y)`.
    fn colon_of_parameter(&mut self, span: Span) {
        let next = self.tokens.get(self.at + 1).map(|next| self.span(*next));
        let kind = next.filter(|next| {
            let text = self.slice(*next).to_ascii_lowercase();
            TYPES.contains(&text.as_str())
        });
        if let Some(kind) = kind {
            let message = format!("parameters have no types, and `{}` is one", self.slice(kind));
            let whole = span.to(kind);
            self.report(
                Diagnostic::new(Code::UnexpectedCharacter, message)
                    .at(whole, "leave this out: a parameter is whatever a call gives")
                    .fix(whole, ""),
            );
            self.at += 1;
            return;
        }
        self.report(
            Diagnostic::new(Code::UnexpectedCharacter, "parameters are parted by commas")
                .at(span, "expected `,` instead of `:`")
                .fix(span, ","),
        );
        self.comma(span);
    }

    /// Reports `Ball(Radius: 2)`.
    fn named_argument(&mut self, name: Span) {
        self.stacks.operands.pop();
        self.top().state = State::Idle;
        let behind = self.tokens.get(self.at + 1).map_or(name.end, |next| next.start);
        let message = "arguments have no names: which is which, their order tells";
        self.report(
            Diagnostic::new(Code::UnexpectedCharacter, message)
                .at(name, "leave this out")
                .fix(Span { end: behind, ..name }, ""),
        );
    }
}
