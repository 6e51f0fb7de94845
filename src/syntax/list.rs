//! Parses heads of directives in parentheses: `#if (…)`, `#for (…)`, `#write (…)`.

use super::ast::{
    Argument, CaseKind, DirectiveKind, ExpressionId, ExpressionKind, Item, ItemKind, NameId,
    Target, Test,
};
use super::directive::Body;
use super::nest::{FrameKind, Nest, State};
use super::token::{Bracket, Head, Mark, TokenKind};
use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::vocabulary::Word;

/// The most tokens after an `=` that are searched for the end of its value.
const LONGEST_VALUE: usize = 40;

impl<'a> Nest<'a> {
    /// Handles `#if (…)` and the like, with their one expression.
    pub(super) fn conditioned(&mut self, head: Head, at: Span, value: ExpressionId, close: Span) {
        let body = match head {
            Head::If => Body::If { done: Vec::new(), test: Some((at, Test::Condition(value))) },
            Head::While => Body::While { condition: value },
            Head::Switch => Body::Switch {
                value,
                lead: self.take_items(self.items.len()),
                cases: Vec::new(),
                open: None,
            },
            Head::Elseif => return self.elseif(at, value),
            Head::Case => return self.case(at, CaseKind::Value(value)),
            Head::Range => return self.case(at, CaseKind::Range(value, value)),
            // Only without a parenthesis, which was reported.
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

    /// Returns whether an expression cannot be a file handle: `#write ("ball", 1)`.
    fn is_value(&self, id: ExpressionId) -> bool {
        matches!(
            self.ast.expression(id).kind,
            ExpressionKind::String
                | ExpressionKind::Number(_)
                | ExpressionKind::Vector(_)
                | ExpressionKind::Triple(_)
        )
    }

    fn handle_missing(&mut self, head: Head, first: Span) {
        let opened = self.ast.directives.iter().rev().find_map(|directive| match directive.kind {
            DirectiveKind::Fopen { name, .. } => Some(self.ast.name(name).to_owned()),
            _ => None,
        });
        let message = format!("`#{}` takes a file's handle first", head.word());
        let told = Diagnostic::new(Code::ExpectedExpression, message)
            .at(first, "expected the name that `#fopen` gave it");
        self.report(match opened {
            Some(name) => told
                .help(format!("write `{name}, ` before it"))
                .fix(Span { end: first.start, ..first }, format!("{name}, ")),
            None => told,
        });
    }

    /// Handles `#for (…)` and the like, with their arguments.
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
                // A keyword is not a declared name.
                let is_word = match first.filter(|_| arguments.len() == 1) {
                    Some(Argument::Items(items)) => {
                        matches!(self.ast.items(items), [Item { kind: ItemKind::Word(_), .. }])
                    }
                    Some(Argument::Expression(id)) => {
                        matches!(self.ast.expression(id).kind, ExpressionKind::Word(_))
                    }
                    None => false,
                };
                if is_word {
                    let answer = f64::from(head == Head::Ifndef);
                    let test = Test::Condition(self.add(ExpressionKind::Number(answer), at));
                    let body = Body::If { done: Vec::new(), test: Some((at, test)) };
                    return self.open(FrameKind::Body(body), at, false);
                }
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
                let place = match arguments.len() {
                    1 | 2 => close,
                    _ => at.to(close),
                };
                let message = "`#for` takes a name, a start and an end";
                self.report(
                    Diagnostic::new(Code::ExpectedExpression, message)
                        .at(place, "expected `(Name, from, to)` or `(Name, from, to, step)`")
                        .help(Word::For.sentence()),
                );
                let missing = self.add(ExpressionKind::Missing, at.after());
                let counter = values.as_deref().and_then(<[_]>::first);
                let named = counter.and_then(|counter| self.name_of(*counter));
                let (name, name_span) = named.unwrap_or_else(|| (self.name(""), at.after()));
                let body = Body::For { name, name_span, from: missing, to: missing, step: None };
                self.open(FrameKind::Body(body), at, false);
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
                    Some(Argument::Expression(id)) if self.is_value(id) => {
                        self.handle_missing(head, self.ast.expression(id).span);
                        None
                    }
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
                    Some((name, name_span)) if head == Head::Read => {
                        let targets = arguments[1..].iter().filter_map(|argument| match argument {
                            Argument::Expression(id) => self.target(*id),
                            Argument::Items(items) => self.name_of_items(*items).map(named),
                        });
                        DirectiveKind::Read { name, name_span, targets: targets.collect() }
                    }
                    Some((name, name_span)) => {
                        let base = self.arguments.len();
                        self.arguments.extend_from_slice(&arguments[1..]);
                        DirectiveKind::Write {
                            name,
                            name_span,
                            arguments: self.take_arguments(base),
                        }
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

    /// Handles `Name =` without `#declare` before it. Returns whether it was one.
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
        if self.inside_a_value() {
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
                .at(span.to(equals), "`=` has no meaning here")
                .help(format!("write `#declare {name} = …`"))
                .fix(Span { end: span.start, ..span }, "#declare "),
        );
        self.add_directive(DirectiveKind::Declare { local: false, target }, span, equals);
        true
    }
}

impl Nest<'_> {
    /// Returns whether the `=` is inside a value: `sphere { 0, Q = 2 }`, `#declare A = Q = 2;`.
    fn inside_a_value(&mut self) -> bool {
        let in_block = matches!(self.top().kind, FrameKind::Block);
        // An element has its own marks for indices: a single name is judged by its surroundings.
        let Some(before) = self.at.checked_sub(2).and_then(|at| self.tokens.get(at)).copied()
        else {
            return false;
        };
        match before.kind {
            TokenKind::Mark(Mark::Open(Bracket::Brace)) if in_block => {
                let ahead = self.tokens[self.at..].iter().take(LONGEST_VALUE);
                let end = ahead.map(|token| token.kind).find(|kind| {
                    matches!(
                        kind,
                        TokenKind::Mark(
                            Mark::Semicolon | Mark::Comma | Mark::Close(Bracket::Brace)
                        )
                    )
                });
                end != Some(TokenKind::Mark(Mark::Semicolon))
            }
            TokenKind::Mark(Mark::Comma | Mark::Equal) => true,
            TokenKind::Numbers | TokenKind::Vectors => {
                let span = self.span(before);
                self.slice(span).trim_end().ends_with(',')
            }
            _ => false,
        }
    }
}

fn named((name, span): (NameId, Span)) -> Target {
    Target { name, indices: Vec::new(), span }
}
