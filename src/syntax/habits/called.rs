//! What other languages define and call: `module leg(h) { … }`, `def ball(r):`, `Math.PI`.

use super::Reader;
use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::syntax::token::{Bracket, Head, Mark, Token, TokenKind};
use crate::vocabulary::{Role, Word};

/// What defines a macro elsewhere.
const DEFINERS: &[&str] = &["module", "def", "func", "fn", "proc", "sub", "function"];

/// Where other languages keep their functions and constants.
const LIBRARIES: &[&str] = &["Math", "math", "np", "numpy", "glm", "cmath", "std"];

impl Reader<'_> {
    /// `module leg(h) { … }`, `def ball(r):` up to a blank line, or as far as it is indented.
    pub(super) fn definer(&mut self, meant: &mut Vec<Token>) -> bool {
        let named = DEFINERS.contains(&self.slice(0))
            && self.inside.is_empty()
            && self.kind(1) == Some(TokenKind::Name)
            && self.is(2, Mark::Open(Bracket::Round));
        let Some(close) = self.closed(2, Bracket::Round).filter(|_| named) else { return false };
        let is_parameter = |at: usize| {
            matches!(self.kind(at), Some(TokenKind::Name | TokenKind::Word(_)))
                || self.is(at, Mark::Comma)
        };
        let (colon, brace) =
            (self.is(close + 1, Mark::Colon), self.is(close + 1, Mark::Open(Bracket::Brace)));
        // Its `#end` is there already.
        let ended = !(colon || brace) && self.surplus_ends();
        if !(3..close).all(is_parameter) || !(colon || brace || ended) {
            return false;
        }
        let (word, span) = (self.slice(0).to_owned(), self.span(0, 0));
        let message = format!("`{word}` is not a word at the top level");
        let mut diagnostic = Diagnostic::new(Code::ForeignWord, message)
            .at(span, "did you mean `#macro`?")
            .help(Word::Macro.sentence())
            .fix(span, "#macro");
        if brace {
            diagnostic = self.braces(close + 1, diagnostic).0;
        } else if colon {
            let end = self.body_end(close + 2);
            let last = self.span(end - 1, end - 1);
            diagnostic =
                diagnostic.fix(self.span(close + 1, close + 1), "").fix(last.after(), "\n#end");
            self.dropped.insert(self.at + close + 1, false);
            self.ends_before.insert(self.at + end);
        }
        self.diagnostics.push(diagnostic);
        meant.push(Token { kind: TokenKind::Directive(Head::Macro), ..self.tokens[self.at] });
        self.at += 1;
        true
    }

    /// `#macro Column Height, Rad)`: the parenthesis that opens is missing.
    pub(super) fn parameters_unopened(&mut self, meant: &mut Vec<Token>) -> bool {
        if self.kind(1) != Some(TokenKind::Name) || self.kind(2) != Some(TokenKind::Name) {
            return false;
        }
        let end = self.line_end(1);
        let is_parameter =
            |at: usize| matches!(self.kind(at), Some(TokenKind::Name)) || self.is(at, Mark::Comma);
        let Some(close) = (3..end).find(|at| !is_parameter(*at)) else { return false };
        if !self.is(close, Mark::Close(Bracket::Round)) {
            return false;
        }
        let (name, first) = (self.span(1, 1), self.span(2, 2));
        let message = "`#macro` takes a name and its parameters in parentheses";
        self.diagnostics.push(
            Diagnostic::new(Code::ExpectedExpression, message)
                .at(first, "expected `(` before this")
                .help(format!("write `#macro {}(`", self.slice(1)))
                .fix(Span { start: name.end, end: first.start, ..first }, "("),
        );
        let open =
            Token { kind: TokenKind::Mark(Mark::Open(Bracket::Round)), ..self.tokens[self.at + 2] };
        meant.extend([
            self.tokens[self.at],
            self.tokens[self.at + 1],
            Token { end: open.start, ..open },
        ]);
        self.enter(Bracket::Round, None);
        self.at += 2;
        true
    }

    /// `#macro Post{P, H)`: the parameters in other brackets.
    pub(super) fn braced_parameters(&mut self, meant: &mut Vec<Token>) -> bool {
        let opens =
            self.is(2, Mark::Open(Bracket::Brace)) || self.is(2, Mark::Open(Bracket::Square));
        if self.kind(1) != Some(TokenKind::Name) || !opens {
            return false;
        }
        let is_parameter =
            |at: usize| self.kind(at) == Some(TokenKind::Name) || self.is(at, Mark::Comma);
        let close = (3..).find(|&at| !is_parameter(at)).unwrap_or(3);
        if close == 3 || !matches!(self.kind(close), Some(TokenKind::Mark(Mark::Close(_)))) {
            return false;
        }
        let (first, last) = (self.span(2, 2), self.span(close, close));
        let message = "the parameters of a macro stand in parentheses";
        self.diagnostics.push(
            Diagnostic::new(Code::UnexpectedCharacter, message)
                .at(first, "expected `(`")
                .also(last, "and `)`")
                .help("write `#macro Name(A, B)`")
                .fix(first, "(")
                .fix(last, ")"),
        );
        let mark = |mark, ahead: usize| Token {
            kind: TokenKind::Mark(mark),
            ..self.tokens[self.at + ahead]
        };
        meant.extend(&self.tokens[self.at..self.at + 2]);
        meant.push(mark(Mark::Open(Bracket::Round), 2));
        meant.extend(&self.tokens[self.at + 3..self.at + close]);
        meant.push(mark(Mark::Close(Bracket::Round), close));
        self.at += close + 1;
        true
    }

    /// The first token at or behind `from` that no longer belongs to a body without a mark at its end.
    fn body_end(&self, from: usize) -> usize {
        let indent = |ahead: usize| {
            let before = self.text.get(..self.tokens[self.at + ahead].start as usize)?;
            let line = &before[before.rfind('\n').map_or(0, |at| at + 1)..];
            line.chars().all(char::is_whitespace).then_some(line.len())
        };
        let mut indented = false;
        let mut ahead = from;
        while let Some(token) = self.tokens.get(self.at + ahead) {
            let before = self.tokens[self.at + ahead - 1].end as usize;
            let gap = self.text.get(before..token.start as usize).unwrap_or("");
            let ends = match indent(ahead) {
                Some(0) => indented || ahead > from && gap.matches('\n').count() > 1,
                Some(_) => {
                    indented = true;
                    false
                }
                None => false,
            };
            if ends {
                break;
            }
            ahead += 1;
        }
        ahead
    }

    /// `console.log("done");`
    pub(super) fn console(&mut self, meant: &mut Vec<Token>) -> bool {
        let called = self.slice(0) == "console"
            && self.is(1, Mark::Dot)
            && self.is(3, Mark::Open(Bracket::Round));
        let Some(close) = self.closed(3, Bracket::Round).filter(|_| called) else { return false };
        let span = self.span(0, 2);
        let text = self.text.get(span.range()).unwrap_or("");
        let mut diagnostic =
            Diagnostic::new(Code::ForeignWord, format!("`{text}` is written `#debug`"))
                .at(span, "did you mean `#debug`?")
                .help(Word::Debug.sentence())
                .fix(span, "#debug");
        if self.is(close + 1, Mark::Semicolon) {
            diagnostic = diagnostic.fix(self.span(close + 1, close + 1), "");
            self.dropped.insert(self.at + close + 1, false);
        }
        self.diagnostics.push(diagnostic);
        let Span { start, end, .. } = span;
        meant.push(Token { kind: TokenKind::Directive(Head::Debug), start, end });
        self.at += 3;
        true
    }

    /// `Math.PI`, `math.sqrt(2)`: what the language has by itself.
    pub(super) fn library(&mut self, meant: &mut Vec<Token>) -> bool {
        let called = LIBRARIES.contains(&self.slice(0))
            && self.is(1, Mark::Dot)
            && matches!(self.kind(2), Some(TokenKind::Name | TokenKind::Word(_)))
            && self.touches(1)
            && self.touches(2);
        if !called {
            return false;
        }
        let theirs = self.slice(2).to_ascii_lowercase();
        let ours = match theirs.as_str() {
            "cross" => "vcross",
            "dot" => "vdot",
            "norm" | "length" => "vlength",
            "normalize" => "vnormalize",
            "power" => "pow",
            "fabs" => "abs",
            "arcsin" => "asin",
            "arccos" => "acos",
            "arctan" => "atan",
            "arctan2" => "atan2",
            _ => &theirs,
        }
        .to_owned();
        let Some(word) = Word::from_name(&ours).filter(|word| word.role() != Role::Statement)
        else {
            return false;
        };
        let span = self.span(0, 2);
        let text = self.text.get(span.range()).unwrap_or("");
        let message = format!("`{text}` is written `{ours}`");
        let diagnostic = Diagnostic::new(Code::ForeignWord, message)
            .at(span, "the language has it without a library")
            .help(format!("replace it with `{ours}`"))
            .fix(span, ours);
        self.diagnostics.push(diagnostic);
        let Span { start, end, .. } = span;
        meant.push(Token { kind: TokenKind::Word(word), start, end });
        self.at += 3;
        true
    }
}
