//! What stands beside a directive and is none of it: `#end if`, `#version = 3.7`, `#debug "N is ", N`.

use super::Reader;
use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::syntax::token::{Bracket, Head, Mark, Token, TokenKind};
use crate::vocabulary::{Dialect, Role, Word};

/// What other languages write before a name that gets its value.
const TYPES: &[&str] = &[
    "float", "double", "int", "integer", "number", "num", "real", "vector", "vec3", "vector3",
    "color", "colour", "string", "str", "bool", "boolean", "var", "let", "const", "auto",
    "constant",
];

impl Reader<'_> {
    /// `#end if`, as Basic and Fortran have it.
    pub(super) fn end_of_what(&mut self, meant: &mut Vec<Token>) -> bool {
        use Word as W;
        let Some(TokenKind::Word(word)) = self.kind(1) else { return false };
        let ends = matches!(word, W::If | W::For | W::While | W::Switch | W::Macro | W::Function);
        let begins =
            self.is(2, Mark::Open(Bracket::Round)) || self.is(2, Mark::Open(Bracket::Brace));
        if !ends || begins || self.breaks_before(1) {
            return false;
        }
        let (name, span) = (word.name(), self.span(1, 1));
        self.diagnostics.push(
            Diagnostic::new(Code::ExtraPart, format!("`#end` stands alone, without `{name}`"))
                .at(span, "expected nothing behind `#end`")
                .help("leave it out")
                .fix(Span { start: self.span(0, 0).end, ..span }, ""),
        );
        meant.push(self.tokens[self.at]);
        self.at += 2;
        true
    }

    /// `#version = 3.7;`, `#default = { … }`.
    pub(super) fn sign_behind_head(&mut self, meant: &mut Vec<Token>) -> bool {
        if !self.is(1, Mark::Equal) || self.kind(2).is_none() {
            return false;
        }
        let (head, sign) = (self.slice(0).to_owned(), self.span(1, 1));
        let gap = Span { end: self.span(2, 2).start, ..sign };
        self.diagnostics.push(
            Diagnostic::new(Code::UnexpectedCharacter, format!("`{head}` has no `=` behind it"))
                .at(sign, "expected its value")
                .help(format!("write `{head} {}`", self.slice(2)))
                .fix(gap, ""),
        );
        meant.push(self.tokens[self.at]);
        self.at += 2;
        true
    }

    /// What is reported of a directive's word without its `#`: a warning where POV-Ray 3.7 takes it for the directive
    /// all the same (measured).
    pub(super) fn without_hash(&self, word: Word, told: Diagnostic) -> Diagnostic {
        let is_read = self.dialect == Dialect::Pov
            && self.inside.is_empty()
            && matches!(word, Word::Declare | Word::Include | Word::Version);
        if is_read { told.as_warning() } else { told }
    }

    /// `version 3.7;` where an item stands.
    pub(super) fn version_without_hash(&mut self, meant: &mut Vec<Token>) -> bool {
        let begins = meant.last().is_none_or(|last| {
            matches!(
                last.kind,
                TokenKind::Mark(Mark::Semicolon | Mark::Close(Bracket::Brace)) | TokenKind::String
            )
        });
        if !begins || !self.inside.is_empty() || self.kind(1) != Some(TokenKind::Number) {
            return false;
        }
        let span = self.span(0, 0);
        let told = Diagnostic::new(Code::UnknownDirective, "`version` needs a `#` before it")
            .at(span, "a directive without its `#`")
            .help("write `#version`")
            .fix(Span { end: span.start, ..span }, "#");
        let told = self.without_hash(Word::Version, told);
        self.diagnostics.push(told);
        meant.push(Token { kind: TokenKind::Directive(Head::Version), ..self.tokens[self.at] });
        self.at += 1;
        true
    }

    /// `#declare float R = 2;`.
    pub(super) fn type_before_name(&mut self, meant: &mut Vec<Token>) -> bool {
        let named = self.kind(2) == Some(TokenKind::Name) && self.is(3, Mark::Equal);
        if !named || !self.is_type(1) {
            return false;
        }
        let (theirs, name) = (self.slice(1).to_owned(), self.slice(2).to_owned());
        let span = self.span(1, 1);
        self.diagnostics.push(
            Diagnostic::new(Code::ExtraPart, "a name has no type")
                .at(span, format!("a name is `{name}` alone, without `{theirs}`"))
                .help(format!("write `{} {name} = …`", self.slice(0)))
                .fix(Span { end: self.span(2, 2).start, ..span }, ""),
        );
        meant.push(self.tokens[self.at]);
        self.at += 2;
        true
    }

    pub(super) fn is_type(&self, ahead: usize) -> bool {
        TYPES.contains(&self.slice(ahead))
    }

    /// `#include "colors.inc" "textures.inc"`, with a comma or without.
    pub(super) fn several_includes(&mut self, meant: &mut Vec<Token>) -> bool {
        let second = if self.is(2, Mark::Comma) { 3 } else { 2 };
        let strings = [1, second].iter().all(|&at| self.kind(at) == Some(TokenKind::String));
        if !strings || self.breaks_before(second) {
            return false;
        }
        let (first, span) = (self.span(1, 1), self.span(second, second));
        let gap = Span { start: first.end, end: span.start, ..span };
        self.diagnostics.push(
            Diagnostic::new(Code::ExtraPart, "each file has an `#include` of its own")
                .at(span, "expected `#include` before this")
                .help(format!("write `#include {}` on a line of its own", self.slice(second)))
                .fix(gap, "\n#include "),
        );
        let head = self.tokens[self.at];
        meant.extend([head, self.tokens[self.at + 1]]);
        self.at += second;
        // The next one, which may have a third behind it.
        let string = self.tokens[self.at];
        let include = Token { end: string.start, start: string.start, ..head };
        if self.kind(1) == Some(TokenKind::String) || self.is(1, Mark::Comma) {
            self.pass_strings();
            return true;
        }
        meant.extend([include, string]);
        self.at += 1;
        true
    }

    /// Passes over the strings of a line, and the commas between.
    fn pass_strings(&mut self) {
        while matches!(self.kind(0), Some(TokenKind::String | TokenKind::Mark(Mark::Comma))) {
            self.at += 1;
        }
    }

    /// `#debug "N is ", N, "\n"`, as a `print` of another language has its parts.
    pub(super) fn printed_parts(&mut self, meant: &mut Vec<Token>) -> bool {
        if self.kind(1) != Some(TokenKind::String) {
            return false;
        }
        let comma = self.is(2, Mark::Comma);
        // `text { ttf #debug "loading" "crystal.ttf" … }`
        let joins = self.inside.is_empty() && matches!(self.kind(2), Some(TokenKind::String))
            || matches!(self.kind(2), Some(TokenKind::Word(word)) if gives_text(word));
        let end = self.line_end(1);
        let end = (2..end).find(|&at| self.is(at, Mark::Semicolon)).unwrap_or(end);
        if !(comma || joins) || end <= 2 || self.breaks_before(2) {
            return false;
        }
        let head = self.slice(0).to_owned();
        let (whole, extra) = (self.span(1, end - 1), self.span(2, 2));
        let message = format!("`{head}` takes one text");
        let told =
            Diagnostic::new(Code::ExtraPart, message).at(extra, "this is more than one text");
        let told = match self.joined(end) {
            Some((text, sure)) => {
                let told = told.help(format!("write `{head} {text}`"));
                if sure { told.fix(whole, text) } else { told }
            }
            None => told.help(format!("write `{head} concat(\"…\", str(A, 0, -1))`")),
        };
        self.diagnostics.push(told);
        meant.extend([self.tokens[self.at], self.tokens[self.at + 1]]);
        self.at += end;
        true
    }

    /// What stands up to `end`, joined by `concat`; and whether each part is known to be a text or a number.
    fn joined(&self, end: usize) -> Option<(String, bool)> {
        let (mut parts, mut sure, mut at) = (Vec::new(), true, 1);
        while at < end {
            if self.is(at, Mark::Comma) {
                at += 1;
                continue;
            }
            let from = at;
            let (is_text, is_known) = match self.kind(at)? {
                TokenKind::String => (true, true),
                TokenKind::Word(word) if gives_text(word) => (true, true),
                TokenKind::Number => (false, true),
                TokenKind::Name => (false, false),
                _ => return None,
            };
            at += 1;
            if self.is(at, Mark::Open(Bracket::Round)) {
                at = self.closed(at, Bracket::Round)? + 1;
            } else if !matches!(self.kind(from), Some(TokenKind::String)) {
                // As far as the next comma: `N*2`.
                while at < end && !self.is(at, Mark::Comma) {
                    at += 1;
                }
            }
            if at > end {
                return None;
            }
            let text = self.text.get(self.span(from, at - 1).range())?;
            sure &= is_known;
            parts.push(if is_text { text.to_owned() } else { format!("str({text}, 0, -1)") });
        }
        Some((format!("concat({})", parts.join(", ")), sure))
    }

    /// Whether a line ends before the token at `ahead`.
    pub(super) fn breaks_before(&self, ahead: usize) -> bool {
        let (before, next) = (self.span(ahead - 1, ahead - 1), self.span(ahead, ahead));
        let gap = self.text.get(before.end as usize..next.start as usize).unwrap_or("");
        gap.contains(['\n', '\r'])
    }
}

/// Whether a function gives a string.
fn gives_text(word: Word) -> bool {
    use Word as W;
    matches!(word.role(), Role::Function { .. })
        && matches!(word, W::Str | W::Concat | W::Vstr | W::Chr | W::Substr | W::Strlwr | W::Strupr)
}
