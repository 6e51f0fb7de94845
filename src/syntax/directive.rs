//! Parses directives: their heads, strictly, and their bodies up to `#end`.
//!
//! **Invariant:** a head is parsed as an ordinary expression first and then converted to what the directive
//! needs; a head that does not fit is reported once and leaves a complete tree.

use super::ast::{
    Body as MacroBody, Case, CaseKind, Directive, DirectiveId, DirectiveKind, ExpressionId,
    ExpressionKind, ItemKind, Items, NameId, Parameter, Test,
};
use super::nest::{Frame, FrameKind, Nest};
use super::token::{Bracket, Head, Mark, TokenKind, directive_word};
use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::vocabulary::{Family, Word};

/// A directive whose `#end` has not been reached.
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
        lead: Items,
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
    /// Handles a `#word` outside any unfinished head or vector.
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
                    self.default_without_block(span);
                    self.add_directive(DirectiveKind::Malformed, span, span);
                }
            }
            Head::Else => self.else_branch(span),
            Head::End => self.end_directive(span),
            Head::Break => self.add_directive(DirectiveKind::Break, span, span),
            // Reported already.
            Head::Unknown => self.add_directive(DirectiveKind::Malformed, span, span),
        }
    }

    /// Opens the parenthesis that has to follow the keyword of a directive.
    pub(super) fn parenthesis(
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
            _ if full => {
                let message = format!("`#{}` takes its condition in parentheses", head.word());
                self.expected_in_head(span, &message, "expected `(` after it");
                self.open(FrameKind::Head(head), span, true);
            }
            _ => {
                let message = format!("`#{}` takes its arguments in parentheses", head.word());
                self.expected_in_head(span, &message, "expected `(` after it");
                let missing = self.add(ExpressionKind::Missing, span.after());
                self.conditioned(head, span, missing, span);
            }
        }
    }

    /// Reports `#default pigment { … }`: its settings are not in a block.
    fn default_without_block(&mut self, span: Span) {
        let message = "`#default` takes a block";
        let next = self.tokens.get(self.at + 1).copied();
        let sets =
            |word| matches!(word, Word::Texture | Word::Pigment | Word::Finish | Word::Normal);
        let Some(next) =
            next.filter(|next| matches!(next.kind, TokenKind::Word(word) if sets(word)))
        else {
            return self.expected_in_head(span, message, "expected `{` after it");
        };
        let word = self.span(next);
        let name = self.slice(word);
        self.report(
            Diagnostic::new(Code::ExpectedExpression, message)
                .at(word, "expected `{` before this")
                .also(span, "for this")
                .help(format!("write `#default {{ {name} {{ … }} }}`")),
        );
    }

    pub(super) fn expected_in_head(&mut self, span: Span, message: &str, label: &str) {
        let told = Diagnostic::new(Code::ExpectedExpression, message).at(span, label);
        let head = directive_word(self.slice(span));
        let word = head.split(|c: char| !c.is_ascii_alphabetic()).next().and_then(Word::from_name);
        self.report(match word.filter(|word| word.family() == Family::Directive) {
            Some(word) => told.help(word.sentence()),
            None => told,
        });
    }

    /// Adds a finished directive as an item from its `#` to the end of `last`.
    pub(super) fn add_directive(&mut self, kind: DirectiveKind, head: Span, last: Span) {
        let id = DirectiveId(self.ast.directives.len() as u32);
        self.ast.directives.push(Directive { kind, head });
        self.item(ItemKind::Directive(id), head.to(last));
    }

    /// Returns the innermost open directive, if nothing else is open inside it.
    pub(super) fn body(&mut self) -> Option<&mut Body> {
        match &mut self.top().kind {
            FrameKind::Body(body) => Some(body),
            _ => None,
        }
    }

    pub(super) fn stray_directive(&mut self, span: Span, expected: &str) {
        let word = directive_word(self.slice(span));
        // A misspelt keyword was reported.
        if Head::from_word(word) == Head::Unknown {
            return;
        }
        let diagnostic =
            Diagnostic::new(Code::StrayDirective, format!("this `#{word}` belongs to nothing"))
                .at(span, format!("expected {expected} before it"));
        // `# end of frame`, a comment in other languages.
        let is_remark = self.slice(span).starts_with("# ");
        let sign = Span { end: span.start + 1, ..span };
        self.report(match is_remark {
            true => diagnostic.help("if it is a comment, that begins with `//`").fix(sign, "//"),
            false if word == "end" => diagnostic.help("leave it out, unless one is missing"),
            false => diagnostic,
        });
    }

    pub(super) fn else_branch(&mut self, span: Span) {
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
            // As in POV-Ray, a case has to come first.
            Some(Body::Switch { open: None, .. }) => self.stray_directive(span, "a `#case`"),
            Some(Body::Switch { .. }) => self.case(span, CaseKind::Otherwise),
            Some(Body::If { .. }) => {
                self.stray_directive(span, "only one `#else` in an `#if`, and none")
            }
            _ => self.stray_directive(span, "an `#if` or `#switch`"),
        }
    }

    pub(super) fn elseif(&mut self, at: Span, condition: ExpressionId) {
        let base = self.top().items;
        if let Some(Body::If { test: Some(_), .. }) = self.body() {
            let then = self.take_items(base);
            if let Some(Body::If { done, test }) = self.body()
                && let Some((place, old)) = test.replace((at, Test::Condition(condition)))
            {
                done.push((place, old, then));
            }
        } else if self.slice(at) != "#else" {
            // `#else if` was reported, and is not one of them.
            self.stray_directive(at, "an `#if` without `#else`");
        }
    }

    pub(super) fn case(&mut self, at: Span, kind: CaseKind) {
        let base = self.top().items;
        if let Some(Body::Switch { .. }) = self.body() {
            self.close_case(base);
            if let Some(Body::Switch { open, .. }) = self.body() {
                *open = Some(kind);
            }
        } else {
            self.orphaned |= self.body().is_none();
            self.stray_directive(at, "a `#switch`");
        }
    }

    pub(super) fn close_case(&mut self, base: usize) {
        let items = self.take_items(base);
        if let Some(Body::Switch { lead, open, cases, .. }) = self.body() {
            match open.take() {
                Some(kind) => cases.push(Case { kind, body: items }),
                None => *lead = items,
            }
        }
    }

    /// Keeps the body of a macro as text.
    pub(super) fn raw(&mut self, span: Span) {
        if let Some(Body::Macro { raw, .. }) = self.body() {
            *raw = Some(span);
        }
    }

    /// Handles `#end`.
    pub(super) fn end_directive(&mut self, end: Span) {
        let base = self.top().items;
        if self.body().is_none() {
            if std::mem::take(&mut self.orphaned) {
                return;
            }
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
            Body::Switch { value, lead, cases, .. } => DirectiveKind::Switch { value, lead, cases },
            Body::Macro { name, name_span, parameters, raw } => {
                let items = self.take_items(base);
                let body = raw.map_or(MacroBody::Items(items), MacroBody::Raw);
                DirectiveKind::Macro { name, name_span, parameters, body }
            }
        };
        self.add_directive(kind, head, end);
    }

    pub(super) fn close_case_of_switch(&mut self, base: usize) {
        if let Some(Body::Switch { .. }) = self.body() {
            self.close_case(base);
        }
    }

    /// Builds the branches from the last to the first, each alone in the `otherwise` of the one before.
    pub(super) fn end_if(
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
