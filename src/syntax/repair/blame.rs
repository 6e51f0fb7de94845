//! Reports brackets and directives without a partner.

use super::{Open, Repair};
use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::syntax::balance::{Opener, Turn, turn};
use crate::syntax::token::{Bracket, Head, Mark, TokenKind};
use crate::vocabulary::{Family, Role, Word};

impl Repair<'_> {
    pub(super) fn are_on_a_line(&self, opener: usize, closer: usize) -> bool {
        let [from, to] = [opener, closer].map(|at| self.tokens[at].start as usize);
        self.text.get(from..to).is_some_and(|between| !between.contains(['\n', '\r']))
    }

    /// Reports that `open` has no closer, which is certain before token `at`, and adds one.
    pub(super) fn never_closed(&mut self, open: Open, at: usize) {
        if self.closed_by_sign(&open, at) {
            return;
        }
        self.insert_closer(&open, at);
        let outside = open.outside.filter(|outside| outside.certain);
        let place =
            self.span(self.before_angle(&open, outside.map_or(at, |outside| outside.token)));
        let shown = self.shown(open.token);
        let found = match self.text.get(place.range()).and_then(|text| text.lines().next()) {
            None | Some("") => "the end of the file".to_owned(),
            Some(text) => text.to_owned(),
        };
        let ends_file = at == self.tokens.len() && outside.is_none();
        let (code, message, expected) = match open.opener {
            Opener::Bracket(bracket) => {
                let surplus = &mut self.surplus[bracket as usize];
                if open.closed_in_branch
                    || (at == self.tokens.len() && *surplus <= 0 && self.told > 0)
                {
                    return;
                }
                *surplus -= 1;
                let closer = bracket.closer();
                (Code::UnclosedBlock, format!("{shown} is never closed"), format!("`{closer}`"))
            }
            Opener::Directive => {
                (Code::MissingEnd, format!("{shown} has no `#end`"), "`#end`".to_owned())
            }
        };
        let label = match self.closed_by(at).filter(|_| outside.is_none()) {
            _ if ends_file => format!("the file ends first, without {expected}"),
            // "expected `}` before `}`" would not say to which block it belongs.
            Some(outer) if expected == format!("`{found}`") => {
                format!("this closes {}: a {expected} is missing before it", self.shown(outer))
            }
            Some(_) | None => format!("expected {expected} before `{found}`"),
        };
        let diagnostic = Diagnostic::new(code, message)
            .at(self.span(open.token), "opened here")
            .also(place, label);
        let beside = outside.filter(|outside| self.stands_beside(open.token, outside.token));
        let line = outside.filter(|outside| {
            let is_block = open.opener == Opener::Bracket(Bracket::Brace);
            is_block
                && outside.token > open.token + 1
                && self.are_on_a_line(open.token, outside.token - 1)
        });
        // An opener on a single line is closed at its end.
        let diagnostic = match line.filter(|_| beside.is_none()) {
            Some(outside) => diagnostic
                .help("is a `}` missing at the end of its line?")
                .fix(self.span(outside.token - 1).after(), " }"),
            None => diagnostic,
        };
        let diagnostic = match self.closer_at_end(&open).filter(|_| ends_file) {
            Some((end, closer)) => {
                diagnostic.help("write the `}` at the end of the file").fix(end, closer)
            }
            None => diagnostic,
        };
        let of_head = outside.and_then(|outside| self.end_of_condition(&open, outside.token));
        self.tell(match beside.map(|outside| self.span(outside.token - 1).after()) {
            Some(end) => diagnostic
                .help(format!("`{found}` stands beside this block, not in it"))
                .fix(end, " }"),
            None => match of_head {
                Some(end) => diagnostic.help("write `)` before it").fix(end, ")"),
                None => diagnostic,
            },
        });
    }

    /// Returns the position and the text of the `}` of a block that is still open at the end of the file, if
    /// all that follows its `{` certainly belongs to it: it is indented more than the line of the `{`, or on
    /// that line and no object.
    fn closer_at_end(&self, open: &Open) -> Option<(Span, String)> {
        let last = self.tokens.len().checked_sub(1)?;
        // `sphere { 0, 1 pig`: a file may be cut off in the middle of a word.
        let is_end = match self.tokens[last].kind {
            TokenKind::Number | TokenKind::String => true,
            TokenKind::Word(word) => word.role() == Role::Value,
            TokenKind::Mark(mark) => matches!(mark, Mark::Close(_) | Mark::Greater),
            _ => false,
        };
        let is_block = open.opener == Opener::Bracket(Bracket::Brace) && !open.closed_in_branch;
        // Another mistake may have moved the end of the block.
        if !(is_block && is_end && last > open.token) || self.told > 0 {
            return None;
        }
        let end = self.span(last).after();
        let mut inside = open.token + 1..=last;
        if self.are_on_a_line(open.token, last) {
            let is_certain = inside.all(|at| !self.begins_object(at) && !self.is_call(at));
            return is_certain.then(|| (end, " }".to_owned()));
        }
        let is_certain = inside.all(|at| {
            let place = self.layout.place(at);
            !place.first || place.indent > open.indent
        });
        let before = self.text.get(..self.tokens[open.token].start as usize)?;
        let line = before.rsplit(['\n', '\r']).next().unwrap_or(before);
        let indent: String = line.chars().take_while(|c| matches!(c, ' ' | '\t')).collect();
        is_certain.then(|| (end, format!("\n{indent}}}")))
    }

    /// Returns whether an object that could be beside a block begins at `at`.
    fn begins_object(&self, at: usize) -> bool {
        let TokenKind::Word(word) = self.tokens[at].kind else { return false };
        matches!(word.family(), Family::Shape | Family::Csg | Family::Light)
            && self.begins_statement(at)
    }

    /// `#if (A < 2 sphere {`: returns the end of the condition, if it is a value.
    fn end_of_condition(&self, open: &Open, outside: usize) -> Option<Span> {
        let kind = |at: usize| self.tokens.get(at).map(|token| token.kind);
        let head = open.token.checked_sub(1).and_then(kind);
        let is_head = matches!(
            head,
            Some(TokenKind::Directive(Head::If | Head::Elseif | Head::While | Head::Switch))
        );
        let last = outside.checked_sub(1)?;
        let is_value = match kind(last)? {
            TokenKind::Number | TokenKind::Name => true,
            TokenKind::Word(word) => word.role() == Role::Value,
            TokenKind::Mark(mark) => matches!(mark, Mark::Close(_)),
            _ => false,
        };
        let of_parenthesis = open.opener == Opener::Bracket(Bracket::Round);
        (of_parenthesis && is_head && is_value).then(|| self.span(last).after())
    }

    /// `function(x, y; { … }`: handles another sign in place of the closer.
    fn closed_by_sign(&mut self, open: &Open, at: usize) -> bool {
        let at = open.outside.map_or(at, |outside| outside.token);
        let kind = |at: usize| self.tokens.get(at).map(|token| token.kind);
        let of_function = open.opener == Opener::Bracket(Bracket::Round)
            && open.token.checked_sub(1).and_then(kind) == Some(TokenKind::Word(Word::Function));
        let before_block = kind(at) == Some(TokenKind::Mark(Mark::Semicolon))
            && kind(at + 1) == Some(TokenKind::Mark(Mark::Open(Bracket::Brace)));
        if !(of_function && before_block) {
            return false;
        }
        self.surplus[Bracket::Round as usize] -= 1;
        self.inserted.push((at, TokenKind::Mark(Mark::Close(Bracket::Round))));
        self.dropped[at] = true;
        let message = format!("{} is closed by `;`", self.shown(open.token));
        let diagnostic = Diagnostic::new(Code::UnclosedBlock, message)
            .at(self.span(at), "expected `)` here")
            .also(self.span(open.token), "opened here")
            .help("replace it with `)`")
            .fix(self.span(at), ")");
        self.tell(diagnostic);
        true
    }

    /// Reports a text that ends inside a vector or parentheses, within blocks: the text was cut off, which is
    /// one mistake.
    pub(super) fn cut_off(&mut self, end: usize) {
        let vector = self.vector_before(end);
        let inside = self.open.last().is_some_and(|open| {
            matches!(open.opener, Opener::Bracket(Bracket::Round | Bracket::Square))
        });
        let blocks = self.open.len() - usize::from(inside && vector.is_none());
        // An item that seems to have ended, or should have been closed before, is a separate mistake.
        let inside_blocks = self.open[..blocks]
            .iter()
            .all(|open| !matches!(open.opener, Opener::Bracket(Bracket::Round | Bracket::Square)));
        let ended = self.open.iter().any(|open| open.outside.is_some_and(|o| o.certain));
        if !inside_blocks || ended {
            return;
        }
        let innermost = vector.or(self.open.last().map(|open| open.token));
        let (Some(innermost), true) = (innermost, blocks > 0 && (inside || vector.is_some()))
        else {
            return;
        };
        if vector.is_some() {
            self.inserted.push((end, TokenKind::Mark(Mark::Greater)));
        }
        let message = format!("the file ends in the middle of {}", self.shown(innermost));
        let mut diagnostic = Diagnostic::new(Code::UnclosedBlock, message)
            .at(self.span(innermost), "opened here, and never closed")
            .help("it seems to have been cut off: is it whole?");
        while let Some(open) = self.open.pop() {
            if open.token != innermost && diagnostic.labels.len() < 4 {
                let text = format!("{} is never closed either", self.shown(open.token));
                diagnostic = diagnostic.also(self.span(open.token), text);
            }
            self.insert_closer(&Open { outside: None, ..open }, end);
        }
        self.tell(diagnostic);
    }

    /// Returns the open item that the closer at `at` closes.
    fn closed_by(&self, at: usize) -> Option<usize> {
        let innermost = |wanted: Opener| {
            self.open.iter().rev().find(|open| open.opener == wanted).map(|open| open.token)
        };
        match turn(self.tokens.get(at)?.kind)? {
            Turn::Close(Opener::Directive) => self.openers.get(&at).copied(),
            Turn::Close(bracket @ Opener::Bracket(_)) => innermost(bracket),
            Turn::Open(_) | Turn::Divide => None,
        }
    }

    pub(super) fn tell(&mut self, diagnostic: Diagnostic) {
        self.told += 1;
        self.diagnostics.push(diagnostic);
    }

    pub(super) fn span(&self, at: usize) -> Span {
        let end = self.text.len();
        let (start, end) = self
            .tokens
            .get(at)
            .map_or((end, end), |token| (token.start as usize, (token.end as usize).min(end)));
        Span::new(self.file, start.min(end), end)
    }

    /// Returns an opener with the word before it: "`sphere {`".
    pub(super) fn shown(&self, at: usize) -> String {
        let text = |at: usize| self.text.get(self.span(at).range()).unwrap_or("");
        let named = |at: &usize| {
            matches!(self.tokens[*at].kind, TokenKind::Word(_) | TokenKind::Name)
                && self.tokens[*at].kind != TokenKind::Word(Word::Array)
        };
        let opener = text(at);
        match (at.checked_sub(1).filter(named), opener) {
            (Some(word), "{") => format!("`{} {{`", text(word)),
            (Some(word), "(") => format!("`{}(`", text(word)),
            (_, "{" | "(" | "[") => format!("this `{opener}`"),
            (_, directive) => format!("`{directive}`"),
        }
    }
}
