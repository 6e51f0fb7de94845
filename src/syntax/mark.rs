//! Parses operators and separators.

use super::ast::{Argument, Callee, Component, ExpressionKind, ItemKind, UnaryOperator};
use super::directive::Body;
use super::expression::{self, Operator, OperatorKind};
use super::nest::{Frame, FrameKind, Nest, State};
use super::token::{Bracket, Head, Mark, Token, TokenKind};
use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::vocabulary::{Dialect, Role};

/// The most tokens after a `;` that are searched for the end of its vector.
const LONGEST_VECTOR: usize = 40;

impl<'a> Nest<'a> {
    pub(super) fn mark(&mut self, mark: Mark, token: Token) {
        let span = self.span(token);
        let (state, full) = (self.top().state, self.top().full || self.top().of_color);
        let holding = matches!(state, State::Holding { .. });
        match mark {
            // `rgb 1 <0, 1, 0>` is two values, and `rgb A < 1 ? B : C` is one.
            Mark::Less if holding && self.top().of_color && !self.compares() => {
                self.open_vector(span);
            }
            // `#declare B = A > 3 ? 1 : 2;` is reported once, and parsed as in parentheses.
            Mark::Less | Mark::Greater
                if holding && !full && !self.in_vector() && self.compares() =>
            {
                self.comparison(mark, span);
            }
            Mark::Open(bracket) => self.open_bracket(bracket, span),
            Mark::Close(bracket) => {
                self.leave_vectors(span);
                self.finish_expression();
                self.close_bracket(bracket, span);
            }
            Mark::Comma => self.comma(span),
            Mark::Semicolon if self.in_vector() && self.top().declaring => {
                self.item(ItemKind::Semicolon, span);
                self.top().declaring = false;
            }
            Mark::Semicolon if self.in_vector() && self.semicolon_in_vector(span) => {}
            Mark::Semicolon => {
                self.leave_vectors(span);
                self.item(ItemKind::Semicolon, span);
            }
            Mark::Dot => self.component(span),
            Mark::Not => self.unary(UnaryOperator::Not, span),
            Mark::Plus | Mark::Minus if holding && self.parts_signed_numbers() => {
                self.finish_expression();
                self.mark(mark, token);
            }
            Mark::Plus if !holding => self.unary(UnaryOperator::Plus, span),
            Mark::Minus if !holding => self.unary(UnaryOperator::Minus, span),
            Mark::Less if !(holding && full) => self.open_vector(span),
            Mark::Greater if self.in_vector() => self.close_vector(span),
            Mark::GreaterOrEqual if self.in_vector() => {
                // `<1, 2>=V`: the vector ends before the comparison.
                self.close_vector(Span { end: span.start + 1, ..span });
                self.mark(Mark::Equal, Token { start: token.start + 1, ..token });
            }
            Mark::Greater if !full || self.top().of_color && !self.is_before_value() => {
                self.stray_greater(span);
            }
            Mark::Equal
                if holding && !full && span.end - span.start == 1 && self.declares(span) => {}
            Mark::Question | Mark::Colon => self.conditional(mark, span),
            Mark::Plus
            | Mark::Minus
            | Mark::Star
            | Mark::Slash
            | Mark::Less
            | Mark::LessOrEqual
            | Mark::Equal
            | Mark::NotEqual
            | Mark::GreaterOrEqual
            | Mark::Greater
            | Mark::And
            | Mark::Or => self.comparison(mark, span),
        }
    }

    fn stray_greater(&mut self, span: Span) {
        let diagnostic = Diagnostic::new(Code::StrayCloser, "this `>` closes nothing")
            .at(span, "no `<` is open here");
        let diagnostic = match self.is_before_value() {
            true => diagnostic.help("comparisons stand in parentheses: `(a > b)`"),
            false => diagnostic.help("leave it out").fix(span, ""),
        };
        self.report(diagnostic);
    }

    /// Returns whether a value follows.
    fn is_before_value(&self) -> bool {
        match self.tokens.get(self.at + 1).map(|token| token.kind) {
            Some(TokenKind::Number | TokenKind::Name | TokenKind::String | TokenKind::Triple) => {
                true
            }
            Some(TokenKind::Word(word)) => word.role() != Role::Statement,
            Some(TokenKind::Mark(mark)) => matches!(
                mark,
                Mark::Minus | Mark::Plus | Mark::Not | Mark::Less | Mark::Open(Bracket::Round)
            ),
            _ => false,
        }
    }

    /// Returns whether a sign begins another number: in `<0 2 -6>` of a scene for POV-Ray 1.0, which has sums in
    /// parentheses only, and after a string of a `.pov`, as in `density_file df3 "smoke.df3" -0.4`.
    fn parts_signed_numbers(&mut self) -> bool {
        let kind =
            |at: Option<usize>| at.and_then(|at| self.tokens.get(at)).map(|token| token.kind);
        let is_after_string = self.dialect == Dialect::Pov
            && kind(self.at.checked_sub(1)) == Some(TokenKind::String)
            && kind(self.at.checked_add(1)) == Some(TokenKind::Number);
        (self.lacks_sums || is_after_string) && !self.top().full
    }

    /// Parses an operator of a sum or product, or one that is valid in parentheses only.
    fn comparison(&mut self, mark: Mark, span: Span) {
        let Some((operator, in_sums)) = expression::binary(mark) else { return };
        let full = self.top().full || self.top().of_color;
        self.before_operator(span);
        if !in_sums && !full {
            // `==` and `&&` were reported.
            let is_foreign = self.slice(span) != operator.symbol();
            self.top().level_told |= is_foreign;
            self.only_in_parentheses(span);
        }
        self.operator(OperatorKind::Binary(operator), span);
    }

    /// Returns whether a `?` follows before any token that cannot be in a comparison.
    fn compares(&self) -> bool {
        let ahead = self.tokens.iter().skip(self.at + 1).take(LONGEST_VECTOR);
        let mut ahead = ahead.map(|token| token.kind).skip_while(|kind| match kind {
            TokenKind::Number | TokenKind::Name => true,
            TokenKind::Word(word) => word.role() == Role::Value,
            TokenKind::Mark(mark) => {
                matches!(mark, Mark::Dot | Mark::Plus | Mark::Minus | Mark::Star | Mark::Slash)
            }
            _ => false,
        });
        ahead.next() == Some(TokenKind::Mark(Mark::Question))
    }

    /// Handles an operator that needs an operand before it.
    pub(super) fn before_operator(&mut self, span: Span) {
        if matches!(self.top().state, State::Holding { .. }) {
            return;
        }
        let before = Span { end: span.start, ..span };
        if self.goes_on_behind_a_directive() {
            return self.operand(ExpressionKind::Joint, before, false);
        }
        let text = self.slice(span);
        self.report(
            Diagnostic::new(Code::ExpectedExpression, format!("expected a value before `{text}`"))
                .at(span, "this operator stands between two values"),
        );
        self.operand(ExpressionKind::Missing, before, false);
    }

    /// `sphere { 0, 2 #if (A) * 3 #end }`: returns whether the operand is on the other side of a directive,
    /// inside a bracket, a block or a function's formula.
    fn goes_on_behind_a_directive(&mut self) -> bool {
        let top = self.top();
        let (state, items, operators) = (top.state, top.items, top.operators);
        if state != State::Idle || self.stacks.operators.len() != operators {
            return false;
        }
        let is_behind = match self.items.get(items..).and_then(<[_]>::last) {
            Some(last) => matches!(last.kind, ItemKind::Directive(_)),
            None => matches!(self.top().kind, FrameKind::Body(_)),
        };
        is_behind && !self.is_at_top_level()
    }

    /// `(2 * #if (A) 3 #else 4 #end)`: returns whether the directive reached supplies the operand.
    pub(super) fn goes_on_in_a_directive(&self) -> bool {
        let leaves = |head: Head| head.opens() && head != Head::Macro;
        let kind = self.tokens.get(self.at).map(|token| token.kind);
        matches!(kind, Some(TokenKind::Directive(head)) if leaves(head)) && !self.is_at_top_level()
    }

    /// Returns whether only statements are allowed: neither in a block nor in a macro.
    fn is_at_top_level(&self) -> bool {
        let is_branch = |frame: &&Frame| match frame.kind {
            FrameKind::Body(ref body) => !matches!(body, Body::Macro { .. }),
            _ => false,
        };
        let around = self.frames.iter().rev().find(|frame| !is_branch(frame));
        around.is_none_or(|frame| matches!(frame.kind, FrameKind::File))
    }

    /// Reports an operator outside parentheses, once for each expression.
    pub(super) fn only_in_parentheses(&mut self, span: Span) {
        if std::mem::replace(&mut self.top().level_told, true) {
            return;
        }
        let text = self.slice(span);
        // A call's parentheses do not count.
        let is_argument = matches!(self.top().kind, FrameKind::Call(_));
        let own = if is_argument { " of its own" } else { "" };
        let message = format!("`{text}` stands only inside parentheses{own}");
        let help = match text {
            "=" if is_argument => "put the whole comparison in parentheses: `(a = b)`",
            "=" => {
                "each name has a `#declare` of its own; a comparison stands in parentheses: `(a = b)`"
            }
            _ => "put the whole comparison in parentheses: `(a < b)`",
        };
        self.report(
            Diagnostic::new(Code::UnexpectedCharacter, message)
                .at(span, "outside, a `<` or `>` would be a vector's")
                .help(help),
        );
    }

    pub(super) fn operator(&mut self, kind: OperatorKind, span: Span) {
        let base = self.top().operators;
        self.stacks.operator(base, &mut self.ast.expressions, Operator { kind, span });
        self.top().state = State::Wanting;
    }

    pub(super) fn unary(&mut self, operator: UnaryOperator, span: Span) {
        self.before_operand();
        let base = self.top().operators;
        if self.stacks.operators.len() - base > self.nesting_limit {
            return self.too_deep(span, "signs");
        }
        self.stacks.operators.push(Operator { kind: OperatorKind::Unary(operator), span });
        self.top().state = State::Wanting;
    }

    pub(super) fn conditional(&mut self, mark: Mark, span: Span) {
        let (base, full) = (self.top().operators, self.top().full || self.top().of_color);
        if mark == Mark::Question {
            if self.stacks.operators.len() - base > self.nesting_limit {
                return self.too_deep(span, "conditions");
            }
            self.before_operator(span);
            if !full {
                self.only_in_parentheses(span);
            }
            if self.dialect == Dialect::Pov && self.frames.iter().any(|frame| frame.formula) {
                self.choice_in_function(span);
            }
            return self.operator(OperatorKind::Question, span);
        }
        if self.stacks.open_question(base).is_none() {
            return self.lone_colon(span);
        }
        self.before_operator(span);
        self.stacks.colon(base, &mut self.ast.expressions);
        self.top().state = State::Wanting;
    }

    /// Reports `function { x > 0 ? 1 : 2 }`, which POV-Ray rejects.
    fn choice_in_function(&mut self, span: Span) {
        let message = "a function has no `?` and `:` in POV-Ray";
        self.report(
            Diagnostic::new(Code::UnexpectedCharacter, message)
                .at(span, "expected an operator of numbers")
                .help("one of two values: `select(A, B, C)` is B where A is negative, else C"),
        );
    }

    pub(super) fn component(&mut self, dot: Span) {
        let next = self.tokens.get(self.at + 1).copied();
        let component = next.and_then(|next| {
            let span = self.span(next);
            match next.kind {
                TokenKind::Word(word) => Some((Component::Word(word, span), span)),
                TokenKind::Name => {
                    let name = self.name(self.slice(span));
                    Some((Component::Name(name, span), span))
                }
                _ => None,
            }
        });
        let holding = matches!(self.top().state, State::Holding { .. });
        let (Some((component, span)), true) = (component, holding) else {
            return self.report(
                Diagnostic::new(Code::UnexpectedCharacter, "this `.` has no meaning here")
                    .at(dot, "expected a value before it and a component's name after it"),
            );
        };
        self.at += 1;
        if let Some(of) = self.stacks.operands.pop() {
            let whole = self.ast.expression(of).span.to(span);
            let id = self.add(ExpressionKind::Component(of, component), whole);
            self.stacks.operands.push(id);
            self.top().state = State::Holding { indexable: false };
        }
    }

    pub(super) fn comma(&mut self, span: Span) {
        let idle = self.top().state == State::Idle;
        match self.top().kind {
            FrameKind::Vector => {
                let base = self.top().items;
                if idle && self.items.len() == base {
                    self.missing_before(span, "a component");
                }
                self.finish_expression();
                self.end_directives_in_vector();
            }
            FrameKind::Call(_) | FrameKind::List(..) => {
                let empty = self.items.len() == self.frames[self.frames.len() - 1].items;
                if idle && empty {
                    let in_macro_head = self.in_macro_head();
                    match self.top().kind {
                        // A macro's optional parameter may be empty.
                        FrameKind::Call(Callee::Name(..)) if !in_macro_head => {
                            let items = self.take_items(self.items.len());
                            return self.arguments.push(Argument::Items(items));
                        }
                        FrameKind::Call(_) => {
                            self.missing_before(span, "an argument");
                        }
                        _ => {}
                    }
                }
                self.finish_expression();
                self.end_argument();
            }
            FrameKind::File
            | FrameKind::Block
            | FrameKind::Entry
            | FrameKind::Group
            | FrameKind::Index(_)
            | FrameKind::Head(_)
            | FrameKind::Condition(..)
            | FrameKind::Default(_)
            | FrameKind::Body(_) => self.item(ItemKind::Comma, span),
        }
    }

    /// Reports `<1; 0; 0>`: semicolons in place of commas. Returns `false` if the vector is not closed at
    /// all.
    fn semicolon_in_vector(&mut self, span: Span) -> bool {
        let open = self.top().open;
        let ahead = self.tokens[self.at..].iter().take(LONGEST_VECTOR);
        let mut ahead = ahead.skip_while(|token| match token.kind {
            TokenKind::Number | TokenKind::Numbers | TokenKind::Name => true,
            TokenKind::Word(word) => word.role() == Role::Value,
            TokenKind::Mark(mark) => matches!(
                mark,
                Mark::Comma
                    | Mark::Semicolon
                    | Mark::Dot
                    | Mark::Plus
                    | Mark::Minus
                    | Mark::Star
                    | Mark::Slash
            ),
            _ => false,
        });
        let close = match ahead.next() {
            Some(&token) if token.kind == TokenKind::Mark(Mark::Greater) => self.span(token),
            _ => return false,
        };
        let before = self.slice(Span { start: open.end, end: span.start, ..span });
        if !before.contains(';') {
            let whole = open.to(close);
            let text = self.slice(whole);
            let diagnostic = Diagnostic::new(
                Code::UnexpectedCharacter,
                "the components of a vector are told apart by commas",
            )
            .at(span, "expected `,` instead of `;`");
            if text.contains(',') {
                // Only the author knows which of them are decimal commas.
                self.report(diagnostic.help("decimals have a point: `1.5`"));
                let base = self.top().arguments;
                self.finish_expression();
                self.arguments.truncate(base);
                self.operand(ExpressionKind::Missing, span, false);
                while self.tokens.get(self.at + 1).is_some_and(|next| next.start < close.start) {
                    self.at += 1;
                }
                return true;
            }
            let parts: Vec<&str> = text.split(';').map(str::trim).collect();
            let meant = parts.join(", ");
            self.report(diagnostic.help(format!("write `{meant}`")).fix(whole, meant));
        }
        self.comma(span);
        true
    }

    /// Returns whether the innermost frame lists the parameters of a `#macro`.
    pub(super) fn in_macro_head(&self) -> bool {
        let outer = self.frames.len().checked_sub(2).map(|outer| &self.frames[outer].kind);
        matches!(outer, Some(FrameKind::Head(Head::Macro)))
    }

    pub(super) fn missing_before(&mut self, span: Span, what: &str) {
        let text = self.slice(span);
        self.report(
            Diagnostic::new(Code::ExpectedExpression, format!("expected {what} before `{text}`"))
                .at(span, "nothing stands before it"),
        );
        self.operand(ExpressionKind::Missing, Span { end: span.start, ..span }, false);
    }
}
