//! Parses heads of directives without parentheses: `#declare A =`, `#include "name"`, `#macro M(a, b)`.

use std::collections::BTreeMap;

use super::ast::{
    Argument, Callee, DirectiveKind, ExpressionId, ExpressionKind, Item, ItemKind, NameId,
    Parameter, Target,
};
use super::directive::Body;
use super::nest::{Frame, FrameKind, Nest, State};
use super::token::{Bracket, Head, Mark, Token, TokenKind};
use crate::diagnostic::{Code, Diagnostic, suggest};
use crate::source::Span;
use crate::vocabulary::{Role, Word};

/// Names of parameter types in other languages.
const TYPES: &[&str] = &[
    "float", "double", "int", "integer", "number", "num", "vector", "vec2", "vec3", "vec4",
    "string", "str", "bool", "boolean", "char", "list", "object", "var", "let", "const", "auto",
];

impl<'a> Nest<'a> {
    /// Handles a token while a head is open. Returns whether the token belonged to the head.
    pub(super) fn head_takes(&mut self, token: Token) -> bool {
        loop {
            let top = self.top();
            let FrameKind::Head(head) = top.kind else { return false };
            let first = self.items.len() == self.frames[self.frames.len() - 1].items;
            let (state, full) = (self.top().state, self.top().full);
            let names = names_something(head);
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
                TokenKind::Word(Word::Deprecated)
                    if matches!(head, Head::Declare | Head::Local) && first =>
                {
                    self.skip_deprecation();
                    return true;
                }
                TokenKind::Name
                    if head == Head::Version
                        && first
                        && state == State::Idle
                        && self.slice(span) == "unofficial" =>
                {
                    self.unofficial(span);
                    return true;
                }
                // A reserved word in place of a name: reported when the head is complete.
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
                | TokenKind::Vectors
                | TokenKind::Triple => holding && !(head == Head::Fopen && first),
                TokenKind::Word(word) => match word.role() {
                    Role::Statement => true,
                    Role::Value | Role::Function { .. } => {
                        holding && !(head == Head::Fopen && first)
                    }
                },
                TokenKind::Mark(mark) => match mark {
                    Mark::Open(Bracket::Round) | Mark::Not => holding,
                    Mark::Less => holding && !full,
                    Mark::Open(Bracket::Square) => {
                        head == Head::Macro || state != State::Holding { indexable: true }
                    }
                    // The tokens after a macro's parameters are its body.
                    _ if head == Head::Macro && holding => true,
                    Mark::Plus | Mark::Minus => false,
                    Mark::Star | Mark::Slash | Mark::Dot => !holding && state != State::Wanting,
                    Mark::Open(Bracket::Brace) | Mark::Close(_) | Mark::Comma | Mark::Semicolon => {
                        true
                    }
                    Mark::LessOrEqual
                    | Mark::Equal
                    | Mark::NotEqual
                    | Mark::GreaterOrEqual
                    | Mark::Greater
                    | Mark::And
                    | Mark::Or
                    | Mark::Question
                    | Mark::Colon => !full,
                },
                TokenKind::Directive(_)
                | TokenKind::Raw
                | TokenKind::Unread
                | TokenKind::LooseOpen
                | TokenKind::LooseClose => true,
                TokenKind::Stray => false,
            };
            if !ends {
                return false;
            }
            self.complete_head();
        }
    }

    /// Skips `deprecated once "why"` before the name: a note to readers, without effect here.
    pub(super) fn skip_deprecation(&mut self) {
        for kind in [TokenKind::Word(Word::Once), TokenKind::String] {
            if self.tokens.get(self.at + 1).is_some_and(|next| next.kind == kind) {
                self.at += 1;
            }
        }
    }

    /// Handles `#version unofficial`: `#version unofficial 3.7;` is version 3.7, as in POV-Ray; `#version
    /// unofficial megapov 1.21;` is that of a patch, which POV-Ray rejects, and is parsed as the language
    /// here.
    fn unofficial(&mut self, word: Span) {
        let ahead = |n: usize| self.tokens.get(self.at + n).copied();
        let is_patch = |token: &Token| matches!(token.kind, TokenKind::Name | TokenKind::String);
        let (Some(patch), number) = (ahead(1).filter(is_patch), ahead(2)) else { return };
        let number = number.filter(|token| token.kind == TokenKind::Number);
        let name = self.span(patch);
        let whole = word.to(number.map_or(name, |number| self.span(number)));
        self.at += 1 + usize::from(number.is_some());
        let message =
            format!("`{}` is a patch of POV-Ray, which is not known here", self.slice(name));
        self.report(
            Diagnostic::new(Code::OldVersion, message)
                .at(whole, "read as version 3.7, without what the patch adds")
                .help("write `#version 3.7;`")
                .fix(whole, "3.7"),
        );
        self.operand(ExpressionKind::Number(3.7), whole, false);
    }

    pub(super) fn next_opens_parenthesis(&self) -> bool {
        let round = TokenKind::Mark(Mark::Open(Bracket::Round));
        self.tokens.get(self.at + 1).is_some_and(|next| next.kind == round)
    }

    /// Completes the open head, if the innermost frame is one.
    pub(super) fn complete_head(&mut self) -> bool {
        if !matches!(self.top().kind, FrameKind::Head(_)) {
            return false;
        }
        self.finish_expression();
        self.close_head(None);
        true
    }

    pub(super) fn close_head(&mut self, equals: Option<Span>) {
        let Some(Frame { kind: FrameKind::Head(head), open, items: base, full, .. }) = self.pop()
        else {
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
            if full {
                // That its parentheses are missing too was reported.
                let missing = self.add(ExpressionKind::Missing, open.after());
                return self.conditioned(head, open, missing, open);
            }
            let message = format!("`#{}` takes {what}", head.word());
            self.expected_in_head(open, &message, &format!("expected {what} after it"));
            return self.add_directive(DirectiveKind::Malformed, open, open);
        };
        let kind = match head {
            Head::Declare | Head::Local => {
                let span = self.ast.expression(first).span;
                let told = self.target(first);
                // `#define A 1` is reported at its first word.
                let foreign = !self.slice(open).ends_with(head.word());
                if equals.is_none() && told.is_some() && !foreign {
                    let message = format!("`#{}` gives a name a value", head.word());
                    let label = "expected `=` and a value after this";
                    self.expected_in_head(span, &message, label);
                }
                // Whatever was meant, the following items are its value.
                let nameless = Target { name: self.name(""), indices: Vec::new(), span };
                let target = told.unwrap_or(nameless);
                Some(DirectiveKind::Declare { local: head == Head::Local, target })
            }
            Head::Undef => self.target(first).map(DirectiveKind::Undef),
            Head::Include => Some(DirectiveKind::Include(first)),
            Head::Version => Some(DirectiveKind::Version(first)),
            Head::Debug => Some(DirectiveKind::Debug(first)),
            Head::Warning => Some(DirectiveKind::Warning(first)),
            Head::Error => Some(DirectiveKind::Error(first)),
            Head::Render | Head::Statistics => Some(DirectiveKind::OldStream(first)),
            Head::Fclose => self
                .name_of(first)
                .map(|(name, name_span)| DirectiveKind::Fclose { name, name_span }),
            Head::Fopen => self.fopen(first, &parts, open),
            Head::Macro => return self.open_macro(first, open),
            Head::If | Head::Elseif | Head::While | Head::Switch | Head::Case => {
                return self.conditioned(head, open, first, last);
            }
            Head::Ifdef
            | Head::Ifndef
            | Head::Else
            | Head::End
            | Head::For
            | Head::Range
            | Head::Break
            | Head::Default
            | Head::Read
            | Head::Write
            | Head::Unknown => None,
        };
        self.add_directive(kind.unwrap_or(DirectiveKind::Malformed), open, last);
        self.top().declaring |= matches!(head, Head::Declare | Head::Local);
    }

    pub(super) fn fopen(
        &mut self,
        first: ExpressionId,
        parts: &[Item],
        open: Span,
    ) -> Option<DirectiveKind> {
        let (name, name_span) = self.name_of(first)?;
        match parts {
            [
                _,
                Item { kind: ItemKind::Expression(file), .. },
                Item { kind: ItemKind::Word(mode), .. },
            ] => Some(DirectiveKind::Fopen { name, name_span, file: *file, mode: Some(*mode) }),
            [_, Item { kind: ItemKind::Expression(file), .. }, mode] => {
                let message = "`#fopen` takes a handle, a file name and a mode";
                self.expected_in_head(mode.span, message, "expected `read`, `write` or `append`");
                Some(DirectiveKind::Fopen { name, name_span, file: *file, mode: None })
            }
            [_, Item { kind: ItemKind::Expression(file), span }, ..] => {
                self.no_mode(*span);
                Some(DirectiveKind::Fopen { name, name_span, file: *file, mode: None })
            }
            _ => {
                let message = "`#fopen` takes a handle, a file name and a mode";
                self.expected_in_head(
                    open,
                    message,
                    "expected such as `\"values.txt\" read` after the handle",
                );
                None
            }
        }
    }

    /// `#fopen F "a.txt" w`: reports that the word after the file name is not a mode.
    fn no_mode(&mut self, file: Span) {
        let message = "`#fopen` takes a handle, a file name and a mode";
        let behind = self.tokens.get(self.at).map(|next| self.span(*next)).filter(|next| {
            let gap = self.slice(Span { start: file.end, end: next.start, ..file });
            let starts = |c: char| c.is_ascii_alphabetic() || c == '"';
            !gap.contains(['\n', '\r']) && self.slice(*next).starts_with(starts)
        });
        let Some(behind) = behind else {
            let label = "expected `read`, `write` or `append` after this";
            return self.expected_in_head(file, message, label);
        };
        let mut diagnostic = Diagnostic::new(Code::ExpectedExpression, message)
            .at(behind, "expected `read`, `write` or `append`");
        let theirs = self.slice(behind).trim_matches('"').to_lowercase();
        let meant = match theirs.as_str() {
            "input" | "in" | "load" => Some("read"),
            "output" | "out" | "save" | "create" => Some("write"),
            theirs => {
                let modes = ["read", "write", "append"];
                let first = modes.into_iter().find(|mode| mode.starts_with(theirs));
                first.or_else(|| suggest::closest(theirs, modes))
            }
        };
        if let Some(meant) = meant {
            diagnostic = diagnostic.help(format!("replace it with `{meant}`")).fix(behind, meant);
        }
        self.report(diagnostic);
    }

    pub(super) fn open_macro(&mut self, head: ExpressionId, open: Span) {
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
            Callee::Element(_) => (self.name(""), span),
        };
        let parameters = self.parameters(arguments);
        let body = Body::Macro { name, name_span, parameters, raw: None };
        self.open(FrameKind::Body(body), open, false);
    }

    pub(super) fn parameters(&mut self, arguments: Vec<Argument>) -> Vec<Parameter> {
        let mut parameters: Vec<Parameter> = Vec::new();
        let mut optional: Option<Span> = None;
        for argument in arguments {
            let named = match argument {
                Argument::Expression(id) => self.name_of(id),
                Argument::Items(items) => self.name_of_items(items),
            };
            let Some((name, span)) = named else { continue };
            // `optional b` is read as two adjacent names.
            let between = optional.map(|word| &self.text[word.end as usize..span.start as usize]);
            match between {
                Some(between) if !between.contains(',') => {
                    if let Some(last) = parameters.last_mut() {
                        *last = Parameter { name, span, optional: true };
                    }
                    optional = None;
                }
                _ if self.is_type(parameters.last(), span) => {
                    if let Some(last) = parameters.last_mut() {
                        *last = Parameter { name, span, optional: false };
                    }
                }
                _ => {
                    optional = (self.slice(span) == "optional").then_some(span);
                    parameters.push(Parameter { name, span, optional: false });
                }
            }
        }
        self.lint_repeated(&parameters);
        parameters
    }

    /// Reports `float N`, where nothing separates the previous parameter from this one: it is not a type.
    fn is_type(&mut self, before: Option<&Parameter>, span: Span) -> bool {
        let Some(before) = before.map(|before| before.span) else { return false };
        let gap = Span { start: before.end, end: span.start, ..span };
        if before.end > span.start || !self.slice(gap).trim().is_empty() {
            return false;
        }
        // The commas between parameters are optional.
        let (theirs, name) = (self.slice(before), self.slice(span));
        if !TYPES.contains(&theirs) {
            return false;
        }
        let message = format!("`{theirs}` is no parameter of its own: parameters have no types");
        let diagnostic = Diagnostic::new(Code::ExtraPart, message)
            .at(before, "a type, as in other languages")
            .also(span, format!("taken as the parameter `{name}`"))
            .help(format!("write `{name}` alone; or a comma between, if both are parameters"))
            .fix(before.to(gap), "");
        self.report(diagnostic);
        true
    }

    /// Lints repeated parameters: as in POV-Ray (measured), the last one of a name is used.
    fn lint_repeated(&mut self, parameters: &[Parameter]) {
        let mut seen: BTreeMap<NameId, Span> = BTreeMap::new();
        for parameter in parameters {
            if let Some(before) = seen.insert(parameter.name, parameter.span) {
                let name = self.slice(parameter.span);
                let message = format!("two parameters of this macro are called `{name}`");
                self.report(
                    Diagnostic::new(Code::RepeatedParameter, message)
                        .at(parameter.span, "only this one is seen inside")
                        .also(before, "this one cannot be reached"),
                );
            }
        }
    }
}

/// Returns whether the directive's head starts with a name.
fn names_something(head: Head) -> bool {
    matches!(
        head,
        Head::Declare | Head::Local | Head::Undef | Head::Macro | Head::Fopen | Head::Fclose
    )
}
