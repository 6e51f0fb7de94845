//! Directives: their heads, read strictly, and their bodies up to `#end`.
//!
//! **Invariant:** a head is parsed as an ordinary expression first and read as what the directive
//! needs afterwards; a head that does not fit is reported once and leaves a whole tree.

use super::ast::{
    Argument, Body as MacroBody, Callee, Case, CaseKind, Directive, DirectiveId, DirectiveKind,
    ExpressionId, ExpressionKind, Item, ItemKind, Items, NameId, Parameter, Target, Test,
};
use super::nest::{Frame, FrameKind, Nest, State};
use super::token::{Bracket, Head, Mark, Token, TokenKind};
use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::vocabulary::{Role, Word};

/// A directive whose `#end` is still to come.
pub(super) enum Body {
    /// The branches before this one, and this one's test; `None` after `#else`.
    If {
        done: Vec<(Span, Test, Items)>,
        test: Option<(Span, Test)>,
    },
    While {
        condition: ExpressionId,
    },
    For {
        name: NameId,
        name_span: Span,
        from: ExpressionId,
        to: ExpressionId,
        step: Option<ExpressionId>,
    },
    Switch {
        value: ExpressionId,
        cases: Vec<Case>,
        open: Option<CaseKind>,
    },
    Macro {
        name: NameId,
        name_span: Span,
        parameters: Vec<Parameter>,
        raw: Option<Span>,
    },
}

impl<'a> Nest<'a> {
    /// A `#word` outside any unfinished head or vector.
    pub(super) fn directive(&mut self, head: Head, span: Span) {
        match head {
            Head::If | Head::While | Head::Switch | Head::Case | Head::Elseif => {
                self.parenthesis(head, span, |span| FrameKind::Condition(head, span), true);
            }
            Head::Ifdef | Head::Ifndef | Head::For | Head::Range | Head::Read | Head::Write => {
                self.parenthesis(head, span, |span| FrameKind::List(head, span), false);
            }
            Head::Declare
            | Head::Local
            | Head::Undef
            | Head::Macro
            | Head::Include
            | Head::Version
            | Head::Debug
            | Head::Warning
            | Head::Error
            | Head::Fopen
            | Head::Fclose
            | Head::Render
            | Head::Statistics => self.open(FrameKind::Head(head), span, false),
            Head::Default => {
                let brace = TokenKind::Mark(Mark::Open(Bracket::Brace));
                if self.tokens.get(self.at + 1).is_some_and(|next| next.kind == brace) {
                    self.at += 1;
                    self.open(FrameKind::Default(span), span, false);
                } else {
                    self.expected_in_head(
                        span,
                        "`#default` takes a block",
                        "expected `{` after it",
                    );
                    self.add_directive(DirectiveKind::Malformed, span, span);
                }
            }
            Head::Else => self.else_branch(span),
            Head::End => self.end_directive(span),
            Head::Break => self.add_directive(DirectiveKind::Break, span, span),
            Head::Unknown => self.unknown(span),
        }
    }

    fn unknown(&mut self, span: Span) {
        let word = self.slice(span).trim_start_matches(['#', ' ', '\t']);
        let mut diagnostic =
            Diagnostic::new(Code::UnknownDirective, format!("`#{word}` is not a directive"))
                .at(span, "unknown word after `#`");
        if let Some(near) = super::closest(word, Head::WORDS.iter().copied()) {
            let start = span.end - word.len() as u32;
            diagnostic = diagnostic
                .help(format!("did you mean `#{near}`?"))
                .fix(Span { start, ..span }, near);
        }
        self.report(diagnostic);
        self.add_directive(DirectiveKind::Malformed, span, span);
    }

    /// Opens the parenthesis that has to follow the word of a directive.
    fn parenthesis(
        &mut self,
        head: Head,
        span: Span,
        frame: impl FnOnce(Span) -> FrameKind,
        full: bool,
    ) {
        let next = self.tokens.get(self.at + 1).copied();
        match next {
            Some(next) if next.kind == TokenKind::Mark(Mark::Open(Bracket::Round)) => {
                self.at += 1;
                let open = self.span(next);
                self.open(frame(span), open, full);
            }
            _ => {
                let message = format!("`#{}` takes its arguments in parentheses", head.word());
                self.expected_in_head(span, &message, "expected `(` after it");
                let missing = self.add(ExpressionKind::Missing, span.after());
                self.conditioned(head, span, missing, span);
            }
        }
    }

    fn expected_in_head(&mut self, span: Span, message: &str, label: &str) {
        self.report(Diagnostic::new(Code::ExpectedExpression, message).at(span, label));
    }

    /// Adds a finished directive as an item that reaches from its `#` to the end of `last`.
    pub(super) fn add_directive(&mut self, kind: DirectiveKind, head: Span, last: Span) {
        let id = DirectiveId(self.ast.directives.len() as u32);
        self.ast.directives.push(Directive { kind, head });
        self.item(ItemKind::Directive(id), head.to(last));
    }

    // ── heads without parentheses ──

    /// Looks at a token while a head is open. True if the token was the head's own.
    pub(super) fn head_takes(&mut self, token: Token) -> bool {
        loop {
            let top = self.top();
            let FrameKind::Head(head) = top.kind else { return false };
            let first = self.items.len() == self.frames[self.frames.len() - 1].items;
            let (state, names) = (self.top().state, names_something(head));
            let span = self.span(token);
            match token.kind {
                TokenKind::Mark(Mark::Equal) if matches!(head, Head::Declare | Head::Local) => {
                    self.finish_expression();
                    self.close_head(Some(span));
                    return true;
                }
                TokenKind::Word(word)
                    if head == Head::Fopen && !(first && state == State::Idle) =>
                {
                    if let Word::Read | Word::Write | Word::Append = word {
                        self.item(ItemKind::Word(word), span);
                        self.close_head(None);
                        return true;
                    }
                }
                // A reserved word where a name is wanted: told when the head is read.
                TokenKind::Word(word)
                    if names && first && state == State::Idle && word.role() != Role::Value =>
                {
                    if self.next_opens_parenthesis() {
                        self.call(Callee::Word(word, span), span, false);
                    } else {
                        self.operand(ExpressionKind::Word(word), span, false);
                    }
                    return true;
                }
                _ => {}
            }
            let holding = matches!(state, State::Holding { .. });
            let ends = match token.kind {
                TokenKind::Number
                | TokenKind::String
                | TokenKind::Name
                | TokenKind::Numbers
                | TokenKind::Vectors => holding && !(head == Head::Fopen && first),
                TokenKind::Word(word) => match word.role() {
                    Role::Statement => true,
                    Role::Value | Role::Function { .. } => {
                        holding && !(head == Head::Fopen && first)
                    }
                },
                TokenKind::Mark(mark) => match mark {
                    Mark::Open(Bracket::Round) | Mark::Less | Mark::Not => holding,
                    Mark::Open(Bracket::Square) => state != State::Holding { indexable: true },
                    Mark::Plus | Mark::Minus => false,
                    Mark::Star | Mark::Slash | Mark::Dot => !holding && state != State::Wanting,
                    Mark::Open(Bracket::Brace)
                    | Mark::Close(_)
                    | Mark::Comma
                    | Mark::Semicolon
                    | Mark::LessOrEqual
                    | Mark::Equal
                    | Mark::NotEqual
                    | Mark::GreaterOrEqual
                    | Mark::Greater
                    | Mark::And
                    | Mark::Or
                    | Mark::Question
                    | Mark::Colon => true,
                },
                TokenKind::Directive(_) | TokenKind::Raw => true,
                TokenKind::Stray => false,
            };
            if !ends {
                return false;
            }
            self.complete_head();
        }
    }

    fn next_opens_parenthesis(&self) -> bool {
        let round = TokenKind::Mark(Mark::Open(Bracket::Round));
        self.tokens.get(self.at + 1).is_some_and(|next| next.kind == round)
    }

    /// Ends the head under way, if the innermost frame is one.
    pub(super) fn complete_head(&mut self) -> bool {
        if !matches!(self.top().kind, FrameKind::Head(_)) {
            return false;
        }
        self.finish_expression();
        self.close_head(None);
        true
    }

    fn close_head(&mut self, equals: Option<Span>) {
        let Some(Frame { kind: FrameKind::Head(head), open, items: base, .. }) = self.pop() else {
            return;
        };
        let parts = self.items.split_off(base);
        let last = equals.or(parts.last().map(|item| item.span)).unwrap_or(open);
        let first = parts.first().and_then(|item| match item.kind {
            ItemKind::Expression(id) => Some(id),
            _ => None,
        });
        let Some(first) = first else {
            let what = if names_something(head) { "a name" } else { "a value" };
            let message = format!("`#{}` takes {what}", head.word());
            self.expected_in_head(open, &message, &format!("expected {what} after it"));
            return self.add_directive(DirectiveKind::Malformed, open, open);
        };
        let kind = match head {
            Head::Declare | Head::Local => {
                if equals.is_none() {
                    let span = self.ast.expression(first).span;
                    let message = format!("`#{}` gives a name a value", head.word());
                    let label = "expected `=` and a value after this";
                    self.expected_in_head(span, &message, label);
                    None
                } else {
                    let local = head == Head::Local;
                    self.target(first).map(|target| DirectiveKind::Declare { local, target })
                }
            }
            Head::Undef => self.target(first).map(DirectiveKind::Undef),
            Head::Include => Some(DirectiveKind::Include(first)),
            Head::Version => Some(DirectiveKind::Version(first)),
            Head::Debug => Some(DirectiveKind::Debug(first)),
            Head::Warning => Some(DirectiveKind::Warning(first)),
            Head::Error => Some(DirectiveKind::Error(first)),
            Head::Render | Head::Statistics => Some(DirectiveKind::Ignored(first)),
            Head::Fclose => self.name_of(first).map(|(name, _)| DirectiveKind::Fclose(name)),
            Head::Fopen => self.fopen(first, &parts, open),
            Head::Macro => return self.open_macro(first, open),
            Head::If
            | Head::Ifdef
            | Head::Ifndef
            | Head::Else
            | Head::Elseif
            | Head::End
            | Head::While
            | Head::For
            | Head::Switch
            | Head::Case
            | Head::Range
            | Head::Break
            | Head::Default
            | Head::Read
            | Head::Write
            | Head::Unknown => None,
        };
        self.add_directive(kind.unwrap_or(DirectiveKind::Malformed), open, last);
    }

    fn fopen(&mut self, first: ExpressionId, parts: &[Item], open: Span) -> Option<DirectiveKind> {
        let (name, _) = self.name_of(first)?;
        match parts {
            [
                _,
                Item { kind: ItemKind::Expression(file), .. },
                Item { kind: ItemKind::Word(mode), .. },
            ] => Some(DirectiveKind::Fopen { name, file: *file, mode: *mode }),
            _ => {
                let message = "`#fopen` takes a handle, a file name and a mode";
                self.expected_in_head(
                    open,
                    message,
                    "expected `read`, `write` or `append` at its end",
                );
                None
            }
        }
    }

    fn open_macro(&mut self, head: ExpressionId, open: Span) {
        let span = self.ast.expression(head).span;
        let (callee, arguments) = match self.ast.expression(head).kind {
            ExpressionKind::Call(callee, arguments) => {
                (callee, self.ast.arguments(arguments).to_vec())
            }
            kind => {
                let message = "`#macro` takes a name and its parameters in parentheses";
                self.expected_in_head(span, message, "expected `(` after the name");
                let callee = match kind {
                    ExpressionKind::Word(word) => Callee::Word(word, span),
                    ExpressionKind::Name(name) => Callee::Name(name, span),
                    _ => Callee::Name(self.name(""), span),
                };
                (callee, Vec::new())
            }
        };
        let (name, name_span) = match callee {
            Callee::Name(name, span) => (name, span),
            Callee::Word(_, span) => (self.reserved(span), span),
        };
        let parameters = self.parameters(arguments);
        let body = Body::Macro { name, name_span, parameters, raw: None };
        self.open(FrameKind::Body(body), open, false);
    }

    fn parameters(&mut self, arguments: Vec<Argument>) -> Vec<Parameter> {
        let mut parameters: Vec<Parameter> = Vec::new();
        let mut optional: Option<Span> = None;
        for argument in arguments {
            let named = match argument {
                Argument::Expression(id) => self.name_of(id),
                Argument::Items(items) => self.name_of_items(items),
            };
            let Some((name, span)) = named else { continue };
            // `optional b` comes as two names side by side.
            let between = optional.map(|word| &self.text[word.end as usize..span.start as usize]);
            match between {
                Some(between) if !between.contains(',') => {
                    if let Some(last) = parameters.last_mut() {
                        *last = Parameter { name, span, optional: true };
                    }
                    optional = None;
                }
                _ => {
                    optional = (self.slice(span) == "optional").then_some(span);
                    parameters.push(Parameter { name, span, optional: false });
                }
            }
        }
        parameters
    }

    // ── heads in parentheses ──

    /// `#if (…)` and its like, with their one expression.
    pub(super) fn conditioned(&mut self, head: Head, at: Span, value: ExpressionId, close: Span) {
        let body = match head {
            Head::If => Body::If { done: Vec::new(), test: Some((at, Test::Condition(value))) },
            Head::While => Body::While { condition: value },
            Head::Switch => Body::Switch { value, cases: Vec::new(), open: None },
            Head::Elseif => return self.elseif(at, value),
            Head::Case => return self.case(at, CaseKind::Value(value)),
            Head::Range => return self.case(at, CaseKind::Range(value, value)),
            // Only without its parenthesis, which has been told.
            Head::Ifdef | Head::Ifndef => {
                Body::If { done: Vec::new(), test: Some((at, Test::Condition(value))) }
            }
            Head::For => {
                let name = self.name("");
                Body::For { name, name_span: at.after(), from: value, to: value, step: None }
            }
            Head::Read
            | Head::Write
            | Head::Declare
            | Head::Local
            | Head::Undef
            | Head::Else
            | Head::End
            | Head::Break
            | Head::Macro
            | Head::Include
            | Head::Default
            | Head::Version
            | Head::Debug
            | Head::Warning
            | Head::Error
            | Head::Fopen
            | Head::Fclose
            | Head::Render
            | Head::Statistics
            | Head::Unknown => return self.add_directive(DirectiveKind::Malformed, at, close),
        };
        self.open(FrameKind::Body(body), at, false);
    }

    /// `#for (…)` and its like, with their arguments.
    pub(super) fn listed(&mut self, head: Head, at: Span, arguments: Vec<Argument>, close: Span) {
        let values: Option<Vec<ExpressionId>> = arguments
            .iter()
            .map(|argument| match argument {
                Argument::Expression(id) => Some(*id),
                Argument::Items(_) => None,
            })
            .collect();
        let first = arguments.first().copied();
        match (head, values.as_deref()) {
            (Head::Ifdef | Head::Ifndef, _) => {
                let target = match (first, arguments.len()) {
                    (Some(Argument::Expression(id)), 1) => self.target(id),
                    (Some(Argument::Items(items)), 1) => self.name_of_items(items).map(named),
                    _ => {
                        let message = format!("`#{}` takes one name", head.word());
                        self.expected_in_head(
                            at.to(close),
                            &message,
                            "expected one name in parentheses",
                        );
                        None
                    }
                };
                let missing = at.after();
                let test = match target {
                    Some(target) if head == Head::Ifdef => Test::Defined(target),
                    Some(target) => Test::NotDefined(target),
                    None => Test::Condition(self.add(ExpressionKind::Missing, missing)),
                };
                let body = Body::If { done: Vec::new(), test: Some((at, test)) };
                self.open(FrameKind::Body(body), at, false);
            }
            (Head::For, Some([counter, from, to, step @ ..])) if step.len() < 2 => {
                let (name, name_span) =
                    self.name_of(*counter).unwrap_or_else(|| (self.name(""), at.after()));
                let step = step.first().copied();
                let body = Body::For { name, name_span, from: *from, to: *to, step };
                self.open(FrameKind::Body(body), at, false);
            }
            (Head::For, _) => {
                self.expected_in_head(
                    at.to(close),
                    "`#for` takes a name, a start and an end",
                    "expected `(Name, from, to)` or `(Name, from, to, step)`",
                );
                let missing = self.add(ExpressionKind::Missing, at.after());
                self.conditioned(head, at, missing, close);
            }
            (Head::Range, Some([from, to])) => self.case(at, CaseKind::Range(*from, *to)),
            (Head::Range, _) => {
                let message = "`#range` takes two numbers";
                self.expected_in_head(at.to(close), message, "expected `(low, high)`");
                let missing = self.add(ExpressionKind::Missing, at.after());
                self.case(at, CaseKind::Range(missing, missing));
            }
            (_, _) => {
                let handle = match first {
                    Some(Argument::Expression(id)) => self.name_of(id),
                    Some(Argument::Items(items)) => self.name_of_items(items),
                    None => {
                        let message = format!("`#{}` takes a file's handle first", head.word());
                        self.expected_in_head(at.to(close), &message, "expected a name");
                        None
                    }
                };
                let kind = match handle {
                    None => DirectiveKind::Malformed,
                    Some((name, _)) if head == Head::Read => {
                        let targets = arguments[1..].iter().filter_map(|argument| match argument {
                            Argument::Expression(id) => self.target(*id),
                            Argument::Items(items) => self.name_of_items(*items).map(named),
                        });
                        DirectiveKind::Read { name, targets: targets.collect() }
                    }
                    Some((name, _)) => {
                        let base = self.arguments.len();
                        self.arguments.extend_from_slice(&arguments[1..]);
                        DirectiveKind::Write { name, arguments: self.take_arguments(base) }
                    }
                };
                self.add_directive(kind, at, close);
            }
        }
    }

    pub(super) fn default_directive(&mut self, head: Span, base: usize, close: Span) {
        let items = self.take_items(base);
        self.add_directive(DirectiveKind::Default(items), head, close);
    }

    /// `Name =` without `#declare` before it. True if that is what stands here.
    pub(super) fn declares(&mut self, equals: Span) -> bool {
        let list = match &self.top().kind {
            FrameKind::File | FrameKind::Block | FrameKind::Body(_) => true,
            FrameKind::Entry
            | FrameKind::Group
            | FrameKind::Vector
            | FrameKind::Call(_)
            | FrameKind::Index(_)
            | FrameKind::Head(_)
            | FrameKind::Condition(..)
            | FrameKind::List(..)
            | FrameKind::Default(_) => false,
        };
        if !list || self.top().state != (State::Holding { indexable: true }) {
            return false;
        }
        self.finish_expression();
        let Some(&Item { kind: ItemKind::Expression(id), span }) = self.items.last() else {
            return true;
        };
        let Some(target) = self.target_if_any(id) else {
            self.report(
                Diagnostic::new(Code::UnexpectedCharacter, "`=` stands only inside parentheses")
                    .at(equals, "a value was already complete before it"),
            );
            return true;
        };
        self.items.pop();
        let name = self.slice(target.span);
        self.report(
            Diagnostic::new(Code::UnexpectedCharacter, "a name gets its value in a `#declare`")
                .at(equals, "`=` has no meaning here")
                .help(format!("write `#declare {name} = …`"))
                .fix(Span { end: span.start, ..span }, "#declare "),
        );
        self.add_directive(DirectiveKind::Declare { local: false, target }, span, equals);
        true
    }

    // ── names ──

    /// `Name` or `Name[i][j]`, without a message if it is neither.
    fn target_if_any(&mut self, id: ExpressionId) -> Option<Target> {
        let span = self.ast.expression(id).span;
        let (mut of, mut indices) = (id, Vec::new());
        while let ExpressionKind::Index(inner, index) = self.ast.expression(of).kind {
            indices.push(index);
            of = inner;
        }
        indices.reverse();
        let name = match self.ast.expression(of).kind {
            ExpressionKind::Name(name) => name,
            ExpressionKind::Word(_) => self.reserved(self.ast.expression(of).span),
            _ => return None,
        };
        Some(Target { name, indices, span })
    }

    fn target(&mut self, id: ExpressionId) -> Option<Target> {
        let target = self.target_if_any(id);
        if target.is_none() {
            self.expected_name(self.ast.expression(id).span);
        }
        target
    }

    fn name_of(&mut self, id: ExpressionId) -> Option<(NameId, Span)> {
        let target = self.target(id)?;
        if target.indices.is_empty() {
            return Some((target.name, target.span));
        }
        self.expected_name(target.span);
        None
    }

    /// A reserved word that is no value comes as an item, not as an expression.
    fn name_of_items(&mut self, items: Items) -> Option<(NameId, Span)> {
        let first = *self.ast.items(items).first()?;
        if let ItemKind::Word(_) = first.kind {
            return Some((self.reserved(first.span), first.span));
        }
        self.expected_name(first.span);
        None
    }

    fn expected_name(&mut self, span: Span) {
        if self.slice(span).is_empty() {
            return;
        }
        let text = self.slice(span).lines().next().unwrap_or("");
        self.report(
            Diagnostic::new(Code::ExpectedExpression, format!("expected a name, found `{text}`"))
                .at(span, "a name starts with a letter or `_`"),
        );
    }

    /// Reports a word of the language where a new name was wanted, and takes it for a name.
    fn reserved(&mut self, span: Span) -> NameId {
        let text = self.slice(span);
        let mut capital = text.to_owned();
        if let Some(first) = capital.get_mut(..1) {
            first.make_ascii_uppercase();
        }
        self.report(
            Diagnostic::new(Code::ReservedName, format!("`{text}` is a word of the language"))
                .at(span, "it cannot be declared")
                .help(format!("names that start with a capital are always free: `{capital}`")),
        );
        self.name(text)
    }

    // ── bodies ──

    /// The innermost open directive, if nothing else is open inside it.
    fn body(&mut self) -> Option<&mut Body> {
        match &mut self.top().kind {
            FrameKind::Body(body) => Some(body),
            _ => None,
        }
    }

    fn stray_directive(&mut self, span: Span, expected: &str) {
        let text = self.slice(span);
        self.report(
            Diagnostic::new(Code::StrayDirective, format!("this `{text}` belongs to nothing"))
                .at(span, format!("expected {expected} before it")),
        );
    }

    fn else_branch(&mut self, span: Span) {
        let base = self.top().items;
        match self.body() {
            Some(Body::If { test: Some(_), .. }) => {
                let then = self.take_items(base);
                if let Some(Body::If { done, test }) = self.body()
                    && let Some((at, test)) = test.take()
                {
                    done.push((at, test, then));
                }
            }
            Some(Body::Switch { .. }) => self.case(span, CaseKind::Otherwise),
            Some(Body::If { .. }) => {
                self.stray_directive(span, "only one `#else` in an `#if`, and none")
            }
            _ => self.stray_directive(span, "an `#if` or `#switch`"),
        }
    }

    fn elseif(&mut self, at: Span, condition: ExpressionId) {
        let base = self.top().items;
        if let Some(Body::If { test: Some(_), .. }) = self.body() {
            let then = self.take_items(base);
            if let Some(Body::If { done, test }) = self.body()
                && let Some((place, old)) = test.replace((at, Test::Condition(condition)))
            {
                done.push((place, old, then));
            }
        } else {
            self.stray_directive(at, "an `#if` without `#else`");
        }
    }

    fn case(&mut self, at: Span, kind: CaseKind) {
        let base = self.top().items;
        if let Some(Body::Switch { .. }) = self.body() {
            self.close_case(base);
            if let Some(Body::Switch { open, .. }) = self.body() {
                *open = Some(kind);
            }
        } else {
            self.stray_directive(at, "a `#switch`");
        }
    }

    fn close_case(&mut self, base: usize) {
        let items = self.take_items(base);
        if let Some(Body::Switch { open, cases, .. }) = self.body()
            && let Some(kind) = open.take()
        {
            cases.push(Case { kind, body: items });
        }
    }

    /// The body of a macro that is kept as text.
    pub(super) fn raw(&mut self, span: Span) {
        if let Some(Body::Macro { raw, .. }) = self.body() {
            *raw = Some(span);
        }
    }

    /// `#end`.
    pub(super) fn end_directive(&mut self, end: Span) {
        let base = self.top().items;
        if self.body().is_none() {
            return self.stray_directive(end, "a directive that it could end");
        }
        self.close_case_of_switch(base);
        let Some(Frame { kind: FrameKind::Body(body), open: head, .. }) = self.pop() else {
            return;
        };
        let kind = match body {
            Body::If { done, test } => return self.end_if(done, test, base, head, end),
            Body::While { condition } => {
                DirectiveKind::While { condition, body: self.take_items(base) }
            }
            Body::For { name, name_span, from, to, step } => {
                DirectiveKind::For { name, name_span, from, to, step, body: self.take_items(base) }
            }
            Body::Switch { value, cases, .. } => DirectiveKind::Switch { value, cases },
            Body::Macro { name, name_span, parameters, raw } => {
                let items = self.take_items(base);
                let body = raw.map_or(MacroBody::Items(items), MacroBody::Raw);
                DirectiveKind::Macro { name, name_span, parameters, body }
            }
        };
        self.add_directive(kind, head, end);
    }

    fn close_case_of_switch(&mut self, base: usize) {
        if let Some(Body::Switch { .. }) = self.body() {
            self.close_case(base);
        }
    }

    /// Builds the branches from the last to the first, each alone in the `otherwise` of the one before.
    fn end_if(
        &mut self,
        done: Vec<(Span, Test, Items)>,
        open: Option<(Span, Test)>,
        base: usize,
        head: Span,
        end: Span,
    ) {
        let last = self.take_items(base);
        let mut branches = done;
        let mut otherwise = last;
        if let Some((at, test)) = open {
            branches.push((at, test, last));
            otherwise = Items { start: last.end, end: last.end };
        }
        let first = branches.len().min(1);
        for (at, test, then) in branches.drain(first..).rev() {
            self.add_directive(DirectiveKind::If { test, then, otherwise }, at, end);
            let base = self.items.len() - 1;
            otherwise = self.take_items(base);
        }
        if let Some((_, test, then)) = branches.pop() {
            self.add_directive(DirectiveKind::If { test, then, otherwise }, head, end);
        }
    }
}

/// True for a directive whose head starts with a name.
fn names_something(head: Head) -> bool {
    matches!(
        head,
        Head::Declare | Head::Local | Head::Undef | Head::Macro | Head::Fopen | Head::Fclose
    )
}

fn named((name, span): (NameId, Span)) -> Target {
    Target { name, indices: Vec::new(), span }
}
