//! Opens and closes brackets: blocks, entries, groups, calls, indices, vectors.

use super::ast::{Argument, Callee, Expression, ExpressionId, ExpressionKind, Item, ItemKind};
use super::nest::{Frame, FrameKind, Nest, State};
use super::token::{Bracket, Head, Mark, TokenKind};
use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::vocabulary::Role;

/// The most tokens of a vector that are searched, from a directive in it on.
const LONGEST_VECTOR: usize = 64;

impl<'a> Nest<'a> {
    pub(super) fn open_bracket(&mut self, bracket: Bracket, span: Span) {
        match bracket {
            Bracket::Brace => {
                self.leave_vectors(span);
                self.finish_expression();
                let formula = std::mem::take(&mut self.top().function_ahead);
                let base = self.top().items;
                let block = match self.items[base..].last() {
                    Some(Item { kind: ItemKind::Word(word), .. }) => Some(*word),
                    _ => None,
                };
                self.open(FrameKind::Block, span, formula);
                let top = self.top();
                (top.block, top.formula) = (block, formula);
            }
            Bracket::Round => {
                if let Some(element) = self.element_before(span) {
                    self.stacks.operands.pop();
                    let whole = self.ast.expression(element).span;
                    return self.open(FrameKind::Call(Callee::Element(element)), whole, false);
                }
                self.before_operand();
                self.open(FrameKind::Group, span, true);
            }
            Bracket::Square => {
                if self.top().state == (State::Holding { indexable: true })
                    && let Some(of) = self.stacks.operands.pop()
                {
                    return self.open(FrameKind::Index(of), span, false);
                }
                self.leave_vectors(span);
                self.finish_expression();
                self.open(FrameKind::Entry, span, false);
            }
        }
    }

    /// Closes the innermost frame; `balance` has ensured that it matches.
    pub(super) fn close_bracket(&mut self, bracket: Bracket, span: Span) {
        let fits = match &self.top().kind {
            FrameKind::Block | FrameKind::Default(_) => bracket == Bracket::Brace,
            FrameKind::Entry | FrameKind::Index(_) => bracket == Bracket::Square,
            FrameKind::Group
            | FrameKind::Call(_)
            | FrameKind::Condition(..)
            | FrameKind::List(..) => bracket == Bracket::Round,
            FrameKind::File | FrameKind::Vector | FrameKind::Head(_) | FrameKind::Body(_) => false,
        };
        if !fits {
            return;
        }
        let Some(frame) = self.pop() else { return };
        let whole = frame.open.to(span);
        match frame.kind {
            FrameKind::Block => {
                let items = self.take_items(frame.items);
                self.items.push(Item { kind: ItemKind::Block(items), span: whole });
            }
            FrameKind::Entry => {
                let items = self.take_items(frame.items);
                self.items.push(Item { kind: ItemKind::Entry(items), span: whole });
            }
            FrameKind::Group => {
                let kind = match self.items[frame.items..] {
                    [Item { kind: ItemKind::Expression(inner), .. }] => {
                        self.items.truncate(frame.items);
                        ExpressionKind::Group(inner)
                    }
                    _ => ExpressionKind::GroupItems(self.take_items(frame.items)),
                };
                self.operand(kind, whole, false);
            }
            FrameKind::Index(of) if self.is_entry(frame.items) => {
                let entry = self.take_items(frame.items);
                self.stacks.operands.push(of);
                self.top().state = State::Holding { indexable: false };
                self.finish_expression();
                self.items.push(Item { kind: ItemKind::Entry(entry), span: whole });
            }
            FrameKind::Index(of) => {
                let index = self.one_expression(frame.items, span, "an index");
                let whole = self.ast.expression(of).span.to(span);
                // It replaces the operand before its `[`, for which an operator may be waiting.
                let id = self.add(ExpressionKind::Index(of, index), whole);
                self.stacks.operands.push(id);
                self.top().state = State::Holding { indexable: true };
            }
            FrameKind::Call(callee @ Callee::Element(_)) => {
                self.end_last_argument(&frame, span);
                let arguments = self.take_arguments(frame.arguments);
                // It replaces the element, as that replaced the array.
                let id = self.add(ExpressionKind::Call(callee, arguments), whole);
                self.stacks.operands.push(id);
                self.top().state = State::Holding { indexable: false };
            }
            FrameKind::Call(callee) => {
                self.end_last_argument(&frame, span);
                let arguments = self.take_arguments(frame.arguments);
                self.operand(ExpressionKind::Call(callee, arguments), whole, true);
            }
            FrameKind::Default(head) => self.default_directive(head, frame.items, span),
            FrameKind::Condition(head, place) => {
                let condition = self.one_expression(frame.items, span, "a condition");
                self.conditioned(head, place, condition, span);
            }
            FrameKind::List(head, place) => {
                self.end_last_argument(&frame, span);
                let arguments = self.arguments.split_off(frame.arguments);
                self.listed(head, place, arguments, span);
            }
            FrameKind::File | FrameKind::Vector | FrameKind::Head(_) | FrameKind::Body(_) => {}
        }
    }

    /// Returns the array element, such as `A[1]`, directly before the parenthesis at `span`.
    fn element_before(&mut self, span: Span) -> Option<ExpressionId> {
        if self.top().state != (State::Holding { indexable: true }) {
            return None;
        }
        let &id = self.stacks.operands.last()?;
        let element = self.ast.expression(id);
        let touches = element.span.end == span.start;
        (touches && matches!(element.kind, ExpressionKind::Index(..))).then_some(id)
    }

    /// Returns whether the brackets after a name contain a map entry, as in `color_map { Tints [1 rgb 1] }`,
    /// and not an index: there is more than one pending item from `base` on, where entries are allowed.
    fn is_entry(&mut self, base: usize) -> bool {
        let in_map = self.top().block.is_some_and(|word| word.name().ends_with("_map"));
        let begins_value = |item: &Item| matches!(item.kind, ItemKind::Word(_));
        self.items.len() > base + 1
            && (in_map || self.items[base..].iter().any(begins_value))
            && self.lists_items()
    }

    /// Adds a brace that pairs only after expansion, as an item of its own.
    pub(super) fn loose(&mut self, kind: TokenKind, span: Span) {
        self.leave_vectors(span);
        self.finish_expression();
        self.top().function_ahead = false;
        let kind = match kind {
            TokenKind::LooseOpen => ItemKind::Open,
            _ => ItemKind::Close,
        };
        self.items.push(Item { kind, span });
    }

    /// Converts the pending items from `base` on to one expression.
    pub(super) fn one_expression(&mut self, base: usize, close: Span, what: &str) -> ExpressionId {
        match self.items[base..] {
            [Item { kind: ItemKind::Expression(id), .. }] => {
                self.items.truncate(base);
                id
            }
            // Its closer was added, which was reported.
            [] if close.start == close.end => self.add(ExpressionKind::Missing, close),
            [] => {
                let text = self.slice(close);
                let message = format!("expected {what} before `{text}`");
                self.report(
                    Diagnostic::new(Code::ExpectedExpression, message)
                        .at(close, "nothing stands before it"),
                );
                self.add(ExpressionKind::Missing, Span { end: close.start, ..close })
            }
            [first, .., last] | [first @ last] => {
                let span = first.span.to(last.span);
                let items = self.take_items(base);
                self.add(ExpressionKind::GroupItems(items), span)
            }
        }
    }

    /// Converts the items since the last comma to arguments.
    pub(super) fn end_argument(&mut self) {
        let base = self.top().items;
        self.arguments_from(base);
    }

    pub(super) fn end_last_argument(&mut self, frame: &Frame, close: Span) {
        let after_comma = self.items.len() == frame.items && self.arguments.len() > frame.arguments;
        let in_macro_head = matches!(self.top().kind, FrameKind::Head(Head::Macro));
        match frame.kind {
            FrameKind::Call(Callee::Word(..)) if after_comma => {
                let text = self.slice(close);
                self.report(
                    Diagnostic::new(Code::ExpectedExpression, "expected an argument after `,`")
                        .at(close, format!("`{text}` follows the comma")),
                );
            }
            // Whether it may be empty depends on the function called.
            FrameKind::Call(Callee::Name(..)) if after_comma && !in_macro_head => {
                let items = self.take_items(frame.items);
                self.arguments.push(Argument::Items(items));
            }
            // A directive's list may end with a comma.
            _ => self.arguments_from(frame.items),
        }
    }

    pub(super) fn arguments_from(&mut self, base: usize) {
        let plain = |item: &Item| matches!(item.kind, ItemKind::Expression(_));
        if self.items[base..].iter().all(plain) {
            for item in self.items.drain(base..) {
                if let ItemKind::Expression(id) = item.kind {
                    self.arguments.push(Argument::Expression(id));
                }
            }
        } else {
            let items = self.take_items(base);
            self.arguments.push(Argument::Items(items));
        }
    }

    pub(super) fn in_vector(&mut self) -> bool {
        matches!(self.top().kind, FrameKind::Vector)
    }

    pub(super) fn open_vector(&mut self, span: Span) {
        self.before_operand();
        if self.frames.len() > self.nesting_limit {
            return self.too_deep(span, "brackets");
        }
        if !self.add_literal_vector(span) {
            self.open(FrameKind::Vector, span, false);
        }
    }

    pub(super) fn too_deep(&mut self, span: Span, what: &str) {
        if !self.ends_early {
            self.report(super::nesting_limit(span, what, self.nesting_limit));
        }
        // Nothing after it can be parsed: the text ends here.
        self.at = self.tokens.len();
        self.cut = true;
    }

    /// Returns whether the directive reached is among the components of a vector that continues after its
    /// end: `<#if (A) 1 #else 2 #end, 0, 0>`, `<#local B = 3; B, 2, 1>`.
    pub(super) fn is_within_vector(&mut self) -> bool {
        if !self.in_vector() {
            return false;
        }
        let (mut directives, mut parentheses, mut declares) = (0_usize, 0_usize, false);
        let mut vectors = 0_usize;
        for token in self.tokens[self.at..].iter().take(LONGEST_VECTOR) {
            match token.kind {
                TokenKind::Directive(Head::End) if directives == 0 => return false,
                TokenKind::Directive(Head::End) => directives -= 1,
                TokenKind::Directive(head) if head.opens() => directives += 1,
                TokenKind::Directive(head) if head.divides() && directives > 0 => {}
                TokenKind::Directive(Head::Break) if directives > 0 => {}
                TokenKind::Directive(Head::Declare | Head::Local) => declares = true,
                TokenKind::Directive(Head::Debug | Head::Warning | Head::Undef | Head::Include) => {
                }
                TokenKind::Mark(Mark::Semicolon) if std::mem::take(&mut declares) => {}
                TokenKind::Mark(Mark::Open(Bracket::Round)) => parentheses += 1,
                TokenKind::Mark(Mark::Close(Bracket::Round)) => {
                    parentheses = parentheses.saturating_sub(1);
                }
                TokenKind::Mark(Mark::Less) if parentheses == 0 => vectors += 1,
                TokenKind::Mark(Mark::Greater) if parentheses == 0 && vectors > 0 => vectors -= 1,
                TokenKind::Mark(Mark::Greater) if directives + parentheses == 0 => {
                    return !declares;
                }
                TokenKind::Mark(
                    Mark::Semicolon | Mark::Open(Bracket::Brace) | Mark::Close(Bracket::Brace),
                ) => return false,
                TokenKind::Word(word) if word.role() == Role::Statement => return false,
                TokenKind::Mark(_)
                | TokenKind::Word(_)
                | TokenKind::Name
                | TokenKind::Number
                | TokenKind::Numbers
                | TokenKind::Vectors
                | TokenKind::Triple
                | TokenKind::String => {}
                _ => return false,
            }
        }
        false
    }

    /// Keeps the items that directives leave among the components of a vector, to be evaluated when they run.
    pub(super) fn end_directives_in_vector(&mut self) {
        let base = self.top().items;
        if self.items.len() > base {
            let items = self.take_items(base);
            self.arguments.push(Argument::Items(items));
        }
    }

    /// `<1 #if (A) + 2 #end, 0, 0>`: the operand before the directive, without a comma, is evaluated with it.
    pub(super) fn directive_goes_on(&mut self) {
        let before = self.at.checked_sub(1).and_then(|at| self.tokens.get(at));
        let is_parted = before.is_none_or(|before| {
            matches!(before.kind, TokenKind::Mark(Mark::Comma | Mark::Open(_) | Mark::Less))
        });
        let (base, items) = (self.top().arguments, self.top().items);
        if is_parted
            || !self.in_vector()
            || self.items.len() > items
            || self.arguments.len() <= base
        {
            return;
        }
        if let Some(&Argument::Expression(id)) = self.arguments.last() {
            self.arguments.pop();
            let span = self.ast.expression(id).span;
            self.items.push(Item { kind: ItemKind::Expression(id), span });
        }
    }

    pub(super) fn close_vector(&mut self, span: Span) {
        let base = self.top().arguments;
        self.end_directives_in_vector();
        // A comma may precede the `>`.
        if self.top().state == State::Idle && self.arguments.len() == base {
            self.missing_before(span, "a component");
        }
        self.finish_expression();
        let Some(frame) = self.pop() else { return };
        let components = self.take_arguments(frame.arguments);
        self.operand(ExpressionKind::Vector(components), frame.open.to(span), false);
    }

    /// Removes and returns the vectors at the end of the arguments from `base` on, except the first argument.
    fn vectors_behind(&mut self, base: usize) -> Vec<Expression> {
        let mut behind = Vec::new();
        while self.arguments.len() > base + 1
            && let Some(&Argument::Expression(id)) = self.arguments.last()
            && let vector = *self.ast.expression(id)
            && matches!(vector.kind, ExpressionKind::Vector(_) | ExpressionKind::Triple(_))
        {
            self.arguments.pop();
            behind.push(vector);
        }
        behind.reverse();
        behind
    }

    /// Reports, once, that open vectors are not closed before a token that no vector can contain.
    pub(super) fn leave_vectors(&mut self, before: Span) {
        let mut told = false;
        while self.in_vector() {
            if self.top().state == State::Wanting {
                self.operand(ExpressionKind::Missing, Span { end: before.start, ..before }, false);
            }
            self.finish_expression();
            self.end_directives_in_vector();
            let Some(frame) = self.pop() else { return };
            // `<-1, 0, -1, <1, 2, 1>`: the later vectors are not components of the first.
            let behind = match self.in_vector() {
                true => Vec::new(),
                false => self.vectors_behind(frame.arguments),
            };
            let before = behind
                .first()
                .map_or(before, |second| Span { end: second.span.start + 1, ..second.span });
            let radius = self.radius_within(frame.open, frame.arguments);
            let before = radius.as_ref().map_or(before, |radius| radius.span);
            if !told {
                told = true;
                let last = self.arguments[frame.arguments..].last();
                let end = match last {
                    Some(&Argument::Expression(id)) => self.ast.expression(id).span.after(),
                    _ => frame.open.after(),
                };
                let text = self.slice(before);
                let found = match text {
                    "" => "the file ends first".to_owned(),
                    text => format!("expected `>` before `{text}`"),
                };
                let diagnostic = Diagnostic::new(Code::UnclosedBlock, "this `<` is never closed")
                    .at(frame.open, "the vector opened here")
                    .also(before, found)
                    .fix(Span { end: end.start, ..end }, ">");
                // In a text that was abandoned, open brackets are not the author's error.
                if !(self.cut || self.ends_early) {
                    self.report(diagnostic);
                }
            }
            let components = self.take_arguments(frame.arguments);
            let whole = Span { end: before.start.max(frame.open.end), ..frame.open };
            self.operand(ExpressionKind::Vector(components), whole, false);
            for value in behind.into_iter().chain(radius) {
                self.finish_expression();
                self.operand(value.kind, value.span, false);
            }
        }
    }

    /// `sphere { <0, 1, 0, 1 …`, `plane { <0, 1, 0, -1 …`: returns the fourth number, which is not a
    /// component of the first vector.
    fn radius_within(&mut self, open: Span, first: usize) -> Option<Expression> {
        const POINT: usize = 3;
        let before = self.text.get(..open.start as usize)?.trim_end().strip_suffix('{')?.trim_end();
        let is_first = before.ends_with("sphere") || before.ends_with("plane");
        if !is_first || self.arguments.len() != first + POINT + 1 {
            return None;
        }
        match self.arguments.pop()? {
            Argument::Expression(id) => Some(*self.ast.expression(id)),
            other => {
                self.arguments.push(other);
                None
            }
        }
    }
}
