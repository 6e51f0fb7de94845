//! Nests the flat tokens into a tree, with an explicit stack of open brackets and directives.
//!
//! **In:** tokens whose brackets and directives pair (see `balance`). **Out:** an [`Ast`].
//! **Invariant:** one pass, no recursion; each open bracket knows the level of its expressions: a
//! *sum* where values stand side by side, *full* where comparisons cannot be mistaken for vectors.

use std::collections::HashMap;

use super::ParseOptions;
use super::ast::{
    Argument, Arguments, Ast, Callee, Component, Expression, ExpressionId, ExpressionKind, Item,
    ItemKind, Items, NameId, UnaryOperator,
};
use super::directive::Body;
use super::expression::{self, Operator, OperatorKind, Stacks};
use super::numbers::{self, Piece, Pieces};
use super::token::{Bracket, Head, Mark, Token, TokenKind};
use crate::diagnostic::{Code, Diagnostic, Diagnostics};
use crate::scene::Dialect;
use crate::source::{FileId, Span};
use crate::vocabulary::{Role, Word};

/// An open bracket or directive.
pub(super) struct Frame {
    pub kind: FrameKind,
    pub open: Span,
    /// Where this frame's part of each pending list starts.
    pub items: usize,
    pub arguments: usize,
    operators: usize,
    /// Comparisons, logic and `?:` are allowed.
    full: bool,
    /// Inside the body of a `function`, where calls and indices are full too.
    formula: bool,
    pub state: State,
    /// The word whose block this is directly in, through directives.
    pub block: Option<Word>,
    /// The next block is the body of a function.
    function_ahead: bool,
    after_contextual: bool,
}

pub(super) enum FrameKind {
    File,
    Block,
    /// `[ … ]` as an item.
    Entry,
    /// `( … )` as an operand.
    Group,
    Vector,
    Call(Callee),
    Index(ExpressionId),
    /// The part of a directive's head that is not in parentheses.
    Head(Head),
    /// `( … )` of a directive's head, one full expression.
    Condition(Head, Span),
    /// `( … )` of a directive's head, several expressions.
    List(Head, Span),
    /// The block of `#default`.
    Default(Span),
    /// The body of a directive that ends with `#end`.
    Body(Body),
}

/// How far the expression of a frame is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum State {
    /// None has begun.
    Idle,
    /// An operator waits for its operand.
    Wanting,
    /// It could end here. A name, a call or an element can be indexed.
    Holding { indexable: bool },
}

pub(super) struct Nest<'a> {
    pub text: &'a str,
    file: FileId,
    dialect: Dialect,
    nesting_limit: usize,
    pub tokens: &'a [Token],
    pub at: usize,
    pub diagnostics: &'a mut Diagnostics,
    pub ast: Ast,
    names: HashMap<&'a str, NameId>,
    pub frames: Vec<Frame>,
    /// Items and arguments of open frames; moved to the tree when a frame closes.
    pub items: Vec<Item>,
    pub arguments: Vec<Argument>,
    stacks: Stacks,
}

/// Builds the tree of `tokens`, which lie in `text`.
pub(super) fn nest<'a>(
    text: &'a str,
    file: FileId,
    tokens: &'a [Token],
    comments: Vec<Span>,
    options: &ParseOptions,
    diagnostics: &'a mut Diagnostics,
) -> Ast {
    let mut nest = Nest {
        text,
        file,
        dialect: options.dialect,
        nesting_limit: options.nesting_limit,
        tokens,
        at: 0,
        diagnostics,
        ast: Ast {
            file,
            items: Vec::new(),
            expressions: Vec::with_capacity(tokens.len() / 2),
            directives: Vec::new(),
            names: Vec::new(),
            arguments: Vec::new(),
            numbers: Vec::new(),
            comments,
            root: Items::default(),
        },
        names: HashMap::new(),
        frames: Vec::new(),
        items: Vec::new(),
        arguments: Vec::new(),
        stacks: Stacks::default(),
    };
    nest.open(FrameKind::File, Span::new(file, 0, 0), false);
    while let Some(&token) = tokens.get(nest.at) {
        nest.token(token);
        nest.at += 1;
    }
    nest.end_of_file();
    nest.ast
}

impl<'a> Nest<'a> {
    pub fn span(&self, token: Token) -> Span {
        // A quote that was put in to close a string may lie behind the end.
        let end = self.text.len();
        Span::new(self.file, (token.start as usize).min(end), (token.end as usize).min(end))
    }

    pub fn slice(&self, span: Span) -> &'a str {
        self.text.get(span.range()).unwrap_or("")
    }

    pub fn report(&mut self, diagnostic: Diagnostic) {
        self.diagnostics.push(diagnostic);
    }

    pub fn name(&mut self, name: &'a str) -> NameId {
        let names = &mut self.ast.names;
        *self.names.entry(name).or_insert_with(|| {
            names.push(name.to_owned());
            NameId(names.len() as u32 - 1)
        })
    }

    pub fn add(&mut self, kind: ExpressionKind, span: Span) -> ExpressionId {
        self.ast.expressions.push(Expression { kind, span });
        ExpressionId(self.ast.expressions.len() as u32 - 1)
    }

    /// The innermost frame. There always is the file's own.
    pub fn top(&mut self) -> &mut Frame {
        let last = self.frames.len() - 1;
        &mut self.frames[last]
    }

    fn next_is(&self, kind: TokenKind) -> bool {
        self.tokens.get(self.at + 1).is_some_and(|token| token.kind == kind)
    }

    pub fn open(&mut self, kind: FrameKind, open: Span, full: bool) {
        let outer = self.frames.last();
        let (block, formula) = match kind {
            FrameKind::Body(_) => (outer.and_then(|f| f.block), false),
            FrameKind::Group | FrameKind::Call(_) | FrameKind::Index(_) => {
                (None, outer.is_some_and(|f| f.formula))
            }
            _ => (None, false),
        };
        self.frames.push(Frame {
            kind,
            open,
            items: self.items.len(),
            arguments: self.arguments.len(),
            operators: self.stacks.operators.len(),
            full: full || formula,
            formula,
            state: State::Idle,
            block,
            function_ahead: false,
            after_contextual: false,
        });
    }

    /// Takes the innermost frame off. The file's own stays.
    pub fn pop(&mut self) -> Option<Frame> {
        if self.frames.len() > 1 { self.frames.pop() } else { None }
    }

    /// Moves the pending items from `base` on into the tree.
    pub fn take_items(&mut self, base: usize) -> Items {
        let start = self.ast.items.len() as u32;
        self.ast.items.extend(self.items.drain(base..));
        Items { start, end: self.ast.items.len() as u32 }
    }

    pub fn take_arguments(&mut self, base: usize) -> Arguments {
        let start = self.ast.arguments.len() as u32;
        self.ast.arguments.extend(self.arguments.drain(base..));
        Arguments { start, end: self.ast.arguments.len() as u32 }
    }

    pub fn item(&mut self, kind: ItemKind, span: Span) {
        self.finish_expression();
        self.items.push(Item { kind, span });
    }

    fn token(&mut self, token: Token) {
        if self.head_takes(token) {
            return;
        }
        let contextual = std::mem::take(&mut self.top().after_contextual);
        let span = self.span(token);
        match token.kind {
            TokenKind::Number => self.number(token),
            TokenKind::String => self.operand(ExpressionKind::String, span, false),
            TokenKind::Name => self.named(span, contextual),
            TokenKind::Word(word) => self.word(word, span),
            TokenKind::Numbers | TokenKind::Vectors => self.run(token),
            TokenKind::Mark(mark) => self.mark(mark, token),
            TokenKind::Directive(head) => {
                self.leave_vectors(span);
                self.finish_expression();
                self.directive(head, span);
            }
            TokenKind::Raw => self.raw(span),
            TokenKind::Stray => self.stray(token),
        }
    }

    // ── operands ──

    /// An operand begins: whatever was complete before it is a value of its own.
    fn before_operand(&mut self) {
        if let State::Holding { .. } = self.top().state {
            self.finish_expression();
        }
    }

    pub fn operand(&mut self, kind: ExpressionKind, span: Span, indexable: bool) {
        self.before_operand();
        let id = self.add(kind, span);
        self.stacks.operands.push(id);
        self.top().state = State::Holding { indexable };
    }

    fn named(&mut self, span: Span, after_contextual: bool) {
        let text = self.slice(span);
        let top = self.top();
        if let Some(block) = top.block
            && top.state != State::Wanting
            && !after_contextual
            && self.dialect == Dialect::Scene
            && let Some(word) = Word::contextual(text, block)
        {
            self.item(ItemKind::Word(word), span);
            self.top().after_contextual = true;
            return;
        }
        let name = self.name(text);
        if self.next_is(TokenKind::Mark(Mark::Open(Bracket::Round))) {
            self.call(Callee::Name(name, span), span, false);
        } else {
            self.operand(ExpressionKind::Name(name), span, true);
        }
    }

    /// A name or function and the parenthesis after it.
    pub fn call(&mut self, callee: Callee, span: Span, full: bool) {
        self.before_operand();
        self.at += 1;
        self.open(FrameKind::Call(callee), span, full);
    }

    fn word(&mut self, word: Word, span: Span) {
        match word.role() {
            Role::Value => self.operand(ExpressionKind::Word(word), span, false),
            Role::Function { one_argument } => {
                if self.next_is(TokenKind::Mark(Mark::Open(Bracket::Round))) {
                    return self.call(Callee::Word(word, span), span, one_argument);
                }
                let name = word.name();
                self.report(
                    Diagnostic::new(
                        Code::ExpectedExpression,
                        format!("`{name}` takes its arguments in parentheses"),
                    )
                    .at(span, format!("expected `(` after `{name}`"))
                    .help(word.sentence()),
                );
                self.operand(ExpressionKind::Missing, span, false);
            }
            Role::Statement => {
                self.leave_vectors(span);
                self.item(ItemKind::Word(word), span);
                if word == Word::Function {
                    self.top().function_ahead = true;
                }
            }
        }
    }

    fn number(&mut self, token: Token) {
        let mut span = self.span(token);
        // `1.2.3` and `1e+` come as two tokens that touch.
        while let Some(&next) = self.tokens.get(self.at + 1) {
            let text = self.slice(self.span(next));
            let continues = match next.kind {
                TokenKind::Number => text.starts_with('.'),
                TokenKind::Name => text == "e" || text == "E",
                _ => false,
            };
            if next.start != span.end || !continues {
                break;
            }
            span.end = next.end;
            self.at += 1;
        }
        let text = self.slice(span);
        match text.parse::<f64>() {
            Ok(number) if number.is_finite() => {
                self.operand(ExpressionKind::Number(number), span, false);
            }
            parsed => {
                let why = match parsed {
                    Ok(_) => "larger than any number that can be stored",
                    Err(_) if text.ends_with(['e', 'E']) => "expected digits after the exponent",
                    Err(_) => "expected one decimal point at most",
                };
                let message = format!("`{text}` is not a number");
                self.report(Diagnostic::new(Code::MalformedNumber, message).at(span, why));
                self.operand(ExpressionKind::Missing, span, false);
            }
        }
    }

    /// Literals with their commas: one item where values stand side by side, else token by token.
    fn run(&mut self, token: Token) {
        let mut span = self.span(token);
        loop {
            let top = self.top();
            let list = match &top.kind {
                FrameKind::File | FrameKind::Entry | FrameKind::Default(_) | FrameKind::Body(_) => {
                    true
                }
                FrameKind::Block => !top.formula,
                FrameKind::Group
                | FrameKind::Vector
                | FrameKind::Call(_)
                | FrameKind::Index(_)
                | FrameKind::Head(_)
                | FrameKind::Condition(..)
                | FrameKind::List(..) => false,
            };
            if list && top.state != State::Wanting {
                break;
            }
            span.start += self.first_of_run(span) as u32;
            if span.start >= span.end {
                return;
            }
        }
        self.finish_expression();
        let start = self.ast.numbers.len() as u32;
        let mut next = start;
        for row in numbers::decode(self.slice(span), &mut self.ast.numbers) {
            let kind = ItemKind::Numbers { start: next, count: row.count, width: row.width };
            next += row.count * row.width;
            let place = Span {
                start: span.start + row.start as u32,
                end: span.start + row.end as u32,
                ..span
            };
            self.items.push(Item { kind, span: place });
        }
    }

    /// Takes the first element of a run and its comma as tokens. Returns their length.
    fn first_of_run(&mut self, run: Span) -> usize {
        let text = self.slice(run);
        let part = |from: usize, to: usize| (run.start + from as u32, run.start + to as u32);
        let mut inside = false;
        for (at, piece) in Pieces::of(text) {
            let (kind, (start, end)) = match piece {
                Piece::Open => (TokenKind::Mark(Mark::Less), part(at, at + 1)),
                Piece::Close => (TokenKind::Mark(Mark::Greater), part(at, at + 1)),
                Piece::Comma => (TokenKind::Mark(Mark::Comma), part(at, at + 1)),
                Piece::Number { mut start, end } => {
                    let sign = match text.as_bytes()[start] {
                        b'-' => Some(Mark::Minus),
                        b'+' => Some(Mark::Plus),
                        _ => None,
                    };
                    if let Some(sign) = sign {
                        let (from, to) = part(start, start + 1);
                        self.token(Token { kind: TokenKind::Mark(sign), start: from, end: to });
                        start += 1;
                    }
                    (TokenKind::Number, part(start, end))
                }
            };
            match piece {
                Piece::Open => inside = true,
                Piece::Close => inside = false,
                Piece::Comma | Piece::Number { .. } => {}
            }
            self.token(Token { kind, start, end });
            if piece == Piece::Comma && !inside {
                return (end - run.start) as usize;
            }
        }
        text.len()
    }

    // ── marks ──

    fn mark(&mut self, mark: Mark, token: Token) {
        let span = self.span(token);
        let (state, full) = (self.top().state, self.top().full);
        let holding = matches!(state, State::Holding { .. });
        match mark {
            Mark::Open(bracket) => self.open_bracket(bracket, span),
            Mark::Close(bracket) => {
                self.leave_vectors(span);
                self.finish_expression();
                self.close_bracket(bracket, span);
            }
            Mark::Comma => self.comma(span),
            Mark::Semicolon => {
                self.leave_vectors(span);
                self.item(ItemKind::Semicolon, span);
            }
            Mark::Dot => self.component(span),
            Mark::Not => self.unary(UnaryOperator::Not, span),
            Mark::Plus if !holding => self.unary(UnaryOperator::Plus, span),
            Mark::Minus if !holding => self.unary(UnaryOperator::Minus, span),
            Mark::Less if !(holding && full) => self.open_vector(span),
            Mark::Greater if self.in_vector() => self.close_vector(span),
            Mark::GreaterOrEqual if self.in_vector() => {
                // `<1, 2>=V`: the vector ends before the comparison.
                self.close_vector(Span { end: span.start + 1, ..span });
                self.mark(Mark::Equal, Token { start: token.start + 1, ..token });
            }
            Mark::Greater if !full => self.report(
                Diagnostic::new(Code::StrayCloser, "this `>` closes nothing")
                    .at(span, "no `<` is open here")
                    .help("comparisons stand in parentheses: `(a > b)`"),
            ),
            Mark::Equal if holding && !full && self.declares(span) => {}
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
            | Mark::Or => {
                let Some((operator, in_sums)) = expression::binary(mark) else { return };
                self.before_operator(span);
                if !in_sums && !full {
                    self.only_in_parentheses(span);
                }
                self.operator(OperatorKind::Binary(operator), span);
            }
        }
    }

    /// An operator that needs an operand before it.
    fn before_operator(&mut self, span: Span) {
        if matches!(self.top().state, State::Holding { .. }) {
            return;
        }
        let text = self.slice(span);
        self.report(
            Diagnostic::new(Code::ExpectedExpression, format!("expected a value before `{text}`"))
                .at(span, "this operator stands between two values"),
        );
        self.operand(ExpressionKind::Missing, Span { end: span.start, ..span }, false);
    }

    fn only_in_parentheses(&mut self, span: Span) {
        let text = self.slice(span);
        let message = format!("`{text}` stands only inside parentheses");
        self.report(
            Diagnostic::new(Code::UnexpectedCharacter, message)
                .at(span, "outside, a `<` or `>` would be a vector's")
                .help("put the whole comparison in parentheses: `(a < b)`"),
        );
    }

    fn operator(&mut self, kind: OperatorKind, span: Span) {
        let base = self.top().operators;
        self.stacks.operator(base, &mut self.ast.expressions, Operator { kind, span });
        self.top().state = State::Wanting;
    }

    fn unary(&mut self, operator: UnaryOperator, span: Span) {
        self.before_operand();
        let base = self.top().operators;
        if self.stacks.operators.len() - base > self.nesting_limit {
            return self.too_deep(span);
        }
        self.stacks.operators.push(Operator { kind: OperatorKind::Unary(operator), span });
        self.top().state = State::Wanting;
    }

    fn conditional(&mut self, mark: Mark, span: Span) {
        let (base, full) = (self.top().operators, self.top().full);
        if mark == Mark::Question {
            if self.stacks.operators.len() - base > self.nesting_limit {
                return self.too_deep(span);
            }
            self.before_operator(span);
            if !full {
                self.only_in_parentheses(span);
            }
            return self.operator(OperatorKind::Question, span);
        }
        if self.stacks.open_question(base).is_none() {
            return self.report(
                Diagnostic::new(Code::UnexpectedCharacter, "this `:` belongs to no `?`")
                    .at(span, "expected `condition ? one : other`"),
            );
        }
        self.before_operator(span);
        self.stacks.colon(base, &mut self.ast.expressions);
        self.top().state = State::Wanting;
    }

    fn component(&mut self, dot: Span) {
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

    fn comma(&mut self, span: Span) {
        let idle = self.top().state == State::Idle;
        match self.top().kind {
            FrameKind::Vector => {
                if idle {
                    self.missing_before(span, "a component");
                }
                self.finish_expression();
            }
            FrameKind::Call(_) | FrameKind::List(..) => {
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

    fn missing_before(&mut self, span: Span, what: &str) {
        let text = self.slice(span);
        self.report(
            Diagnostic::new(Code::ExpectedExpression, format!("expected {what} before `{text}`"))
                .at(span, "nothing stands before it"),
        );
        self.operand(ExpressionKind::Missing, Span { end: span.start, ..span }, false);
    }

    // ── brackets ──

    fn open_bracket(&mut self, bracket: Bracket, span: Span) {
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

    /// Closes the innermost frame, which `balance` has made sure fits.
    fn close_bracket(&mut self, bracket: Bracket, span: Span) {
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
            FrameKind::Index(of) => {
                let index = self.one_expression(frame.items, span, "an index");
                let whole = self.ast.expression(of).span.to(span);
                self.operand(ExpressionKind::Index(of, index), whole, true);
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

    /// The pending items from `base` on as one expression.
    pub fn one_expression(&mut self, base: usize, close: Span, what: &str) -> ExpressionId {
        match self.items[base..] {
            [Item { kind: ItemKind::Expression(id), .. }] => {
                self.items.truncate(base);
                id
            }
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

    /// Makes arguments of the items since the last comma.
    fn end_argument(&mut self) {
        let base = self.top().items;
        self.arguments_from(base);
    }

    fn end_last_argument(&mut self, frame: &Frame, close: Span) {
        let empty = self.items.len() == frame.items;
        if empty && self.arguments.len() > frame.arguments {
            // `f(a, )`: told, but not for `#write`, whose parts may come from branches.
            if !matches!(frame.kind, FrameKind::List(..)) {
                let text = self.slice(close);
                self.report(
                    Diagnostic::new(Code::ExpectedExpression, "expected an argument after `,`")
                        .at(close, format!("`{text}` follows the comma")),
                );
            }
        }
        self.arguments_from(frame.items);
    }

    fn arguments_from(&mut self, base: usize) {
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

    // ── vectors ──

    fn in_vector(&mut self) -> bool {
        matches!(self.top().kind, FrameKind::Vector)
    }

    fn open_vector(&mut self, span: Span) {
        self.before_operand();
        if self.frames.len() > self.nesting_limit {
            return self.too_deep(span);
        }
        self.open(FrameKind::Vector, span, false);
    }

    fn close_vector(&mut self, span: Span) {
        if self.top().state == State::Idle {
            self.missing_before(span, "a component");
        }
        self.finish_expression();
        let Some(frame) = self.pop() else { return };
        let components = self.take_arguments(frame.arguments);
        self.operand(ExpressionKind::Vector(components), frame.open.to(span), false);
    }

    /// Something that no vector can hold: the open ones are not closed. One message for all.
    pub fn leave_vectors(&mut self, before: Span) {
        let mut told = false;
        while self.in_vector() {
            if self.top().state == State::Wanting {
                self.operand(ExpressionKind::Missing, Span { end: before.start, ..before }, false);
            }
            self.finish_expression();
            let Some(frame) = self.pop() else { return };
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
                self.report(diagnostic);
            }
            let components = self.take_arguments(frame.arguments);
            let whole = Span { end: before.start.max(frame.open.end), ..frame.open };
            self.operand(ExpressionKind::Vector(components), whole, false);
        }
    }

    // ── ends ──

    /// Ends the expression under way, if there is one, and hands it to its frame.
    pub fn finish_expression(&mut self) {
        let (state, base) = (self.top().state, self.top().operators);
        match state {
            State::Idle => return,
            State::Holding { .. } => {}
            State::Wanting => {
                if let Some(&operator) = self.stacks.operators.last() {
                    let text = self.slice(operator.span);
                    let message = format!("expected a value after `{text}`");
                    self.report(
                        Diagnostic::new(Code::ExpectedExpression, message)
                            .at(operator.span, "nothing it could be applied to follows"),
                    );
                    self.operand(ExpressionKind::Missing, operator.span.after(), false);
                }
            }
        }
        if let Some(question) = self.stacks.open_question(base) {
            self.report(
                Diagnostic::new(Code::ExpectedExpression, "this `?` has no `:`")
                    .at(question, "expected `condition ? one : other`"),
            );
            while self.stacks.open_question(base).is_some() {
                self.stacks.colon(base, &mut self.ast.expressions);
                let id = self.add(ExpressionKind::Missing, question.after());
                self.stacks.operands.push(id);
            }
        }
        self.top().state = State::Idle;
        let Some(id) = self.stacks.finish(base, &mut self.ast.expressions) else { return };
        if self.in_vector() {
            self.arguments.push(Argument::Expression(id));
        } else {
            let span = self.ast.expression(id).span;
            self.items.push(Item { kind: ItemKind::Expression(id), span });
        }
    }

    fn too_deep(&mut self, span: Span) {
        self.report(super::nesting_limit(span, self.nesting_limit));
        // Nothing behind it can be understood: the text ends here.
        self.at = self.tokens.len();
    }

    fn stray(&mut self, token: Token) {
        let span = self.span(token);
        let text = self.slice(span);
        let previous = self.at.checked_sub(1).and_then(|at| self.tokens.get(at));
        if previous.is_some_and(|p| p.kind == TokenKind::Stray && p.end == token.start) {
            return;
        }
        if text == "#" {
            return self.report(
                Diagnostic::new(Code::LegacyForm, "this `#` stands alone")
                    .at(span, "expected a directive's word after it; it is left out"),
            );
        }
        let shown: String = text.chars().flat_map(char::escape_debug).collect();
        let diagnostic = Diagnostic::new(
            Code::UnexpectedCharacter,
            format!("the character `{shown}` has no meaning here"),
        )
        .at(span, "outside strings and comments only the language's own signs can stand");
        let diagnostic = match text {
            "'" | "‘" | "’" | "“" | "”" => {
                diagnostic.help("strings stand between `\"` and `\"`")
            }
            "\"" => diagnostic.help("a string begins here and does not end"),
            "^" => diagnostic.help("a power is written `pow(a, b)`"),
            "%" => diagnostic.help("a remainder is written `mod(a, b)`"),
            "\u{a0}" => diagnostic.help("it is a no-break space: write a plain one"),
            _ => diagnostic,
        };
        self.report(diagnostic);
    }

    fn end_of_file(&mut self) {
        let end = Span::new(self.file, self.text.len(), self.text.len());
        loop {
            self.leave_vectors(end);
            self.finish_expression();
            if self.complete_head() {
                continue;
            }
            let bracket = match &self.top().kind {
                FrameKind::File => break,
                FrameKind::Block | FrameKind::Default(_) => Bracket::Brace,
                FrameKind::Entry | FrameKind::Index(_) => Bracket::Square,
                FrameKind::Body(_) => {
                    self.end_directive(end);
                    continue;
                }
                FrameKind::Group
                | FrameKind::Call(_)
                | FrameKind::Condition(..)
                | FrameKind::List(..)
                | FrameKind::Vector
                | FrameKind::Head(_) => Bracket::Round,
            };
            self.close_bracket(bracket, end);
        }
        self.ast.root = self.take_items(0);
    }
}
