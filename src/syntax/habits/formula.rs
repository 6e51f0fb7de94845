//! The formulas of functions as other languages write them: with an `if`, behind `=`, with a name.

use super::Reader;
use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::syntax::token::{Bracket, Mark, Token, TokenKind};
use crate::vocabulary::Word;

impl Reader<'_> {
    /// `function(x) { if (x > 0) { x } else { 0 } }`: all of it is one mistake.
    pub(super) fn choice_in_formula(&mut self, meant: &mut Vec<Token>) -> bool {
        let brace = TokenKind::Mark(Mark::Open(Bracket::Brace));
        let Some(open) = meant.last().filter(|last| last.kind == brace).copied() else {
            return false;
        };
        let names = meant.iter().rev().skip(1).skip_while(|token| {
            matches!(
                token.kind,
                TokenKind::Name | TokenKind::Mark(_) | TokenKind::Word(Word::X | Word::Y | Word::Z)
            ) && token.kind != brace
        });
        if !names.clone().next().is_some_and(|word| word.kind == TokenKind::Word(Word::Function)) {
            return false;
        }
        let place = self.tokens.partition_point(|token| token.start < open.start);
        let Some(close) = self.closer(place) else { return false };
        let diagnostic = Diagnostic::new(
            Code::UnexpectedCharacter,
            "a function is one formula, and has no `if`",
        )
        .at(self.span(0, 0), "expected a value");
        let whole = Span { end: self.tokens[close].start, ..self.span(0, 0) };
        let diagnostic = match self.choice_written(close - self.at) {
            Some(right) => {
                let end = whole.start
                    + self.text.get(whole.range()).unwrap_or("").trim_end().len() as u32;
                diagnostic.help(format!("write `{right}`")).fix(Span { end, ..whole }, right)
            }
            None => diagnostic.help("one of two values: `(x > 0 ? x : 0)`, or `select(x, 0, x)`"),
        };
        self.diagnostics.push(diagnostic);
        // Some value stands for the formula: of a surface, one that it can have.
        let of_place = meant
            .iter()
            .rev()
            .nth(1)
            .is_some_and(|word| word.kind == TokenKind::Word(Word::Function));
        let stand_in = if of_place { Word::X } else { Word::Pi };
        meant.push(Token { kind: TokenKind::Word(stand_in), ..self.tokens[self.at] });
        self.at = close;
        true
    }

    /// `if (x > 0) y else -y`, up to `close`, as one formula.
    fn choice_written(&self, close: usize) -> Option<String> {
        let condition = self.closed(1, Bracket::Round)?;
        let otherwise =
            (condition..close).find(|&at| self.kind(at) == Some(TokenKind::Word(Word::Else)))?;
        let text = |from: usize, to: usize| {
            let all = self.text.get(self.span(from, to).range())?;
            let plain = all.trim().trim_start_matches('{').trim_end_matches(['}', ';', ' ']).trim();
            (!plain.is_empty() && !plain.contains(['{', '}', ';', '\n'])).then_some(plain)
        };
        // No other choice, and no `return`.
        let mut others = (condition + 1..close).filter(|&at| at != otherwise);
        let is_plain = |kind: Option<TokenKind>| {
            !matches!(
                kind,
                Some(
                    TokenKind::Word(Word::If | Word::Else)
                        | TokenKind::Stray
                        | TokenKind::Mark(Mark::Equal)
                )
            )
        };
        if !others.all(|at| is_plain(self.kind(at)) && self.slice(at) != "return") {
            return None;
        }
        let asked = self.text.get(self.span(2, condition - 1).range())?;
        let then = text(condition + 1, otherwise - 1)?;
        let otherwise = text(otherwise + 1, close - 1)?;
        let compares = (2..condition).any(|at| self.compares(at));
        Some(selected(asked, compares, then, otherwise))
    }

    /// `#declare F = function(x) = sin(x)*2;`: a formula without its braces.
    pub(super) fn formula_behind_sign(&mut self, meant: &mut Vec<Token>) -> bool {
        let round = |bracket: fn(Bracket) -> Mark| TokenKind::Mark(bracket(Bracket::Round));
        let closed = meant.last().is_some_and(|last| last.kind == round(Mark::Close));
        let names = meant.iter().rev().skip(1).take_while(|token| {
            matches!(
                token.kind,
                TokenKind::Name | TokenKind::Word(_) | TokenKind::Mark(Mark::Comma)
            )
        });
        let Some(open) = meant.len().checked_sub(names.count() + 2).filter(|_| closed) else {
            return false;
        };
        let of_function = meant[open].kind == round(Mark::Open)
            && open > 0
            && meant[open - 1].kind == TokenKind::Word(Word::Function);
        if !of_function && self.named_formula(open, meant) {
            return true;
        }
        let end = self.line_end(1);
        let semicolon = (1..end).find(|&at| self.is(at, Mark::Semicolon));
        let Some(end) = semicolon.filter(|&end| of_function && end > 1) else { return false };
        let (sign, last) = (self.span(0, 0), self.span(end - 1, end - 1));
        let message = "the formula of a function stands between `{` and `}`";
        self.diagnostics.push(
            Diagnostic::new(Code::UnexpectedCharacter, message)
                .at(sign, "expected `{`")
                .help("write `function(x) { … }`")
                .fix(sign, "{")
                .fix(last.after(), " }"),
        );
        let brace = |bracket: fn(Bracket) -> Mark, at: usize| Token {
            kind: TokenKind::Mark(bracket(Bracket::Brace)),
            ..self.tokens[self.at + at]
        };
        meant.push(brace(Mark::Open, 0));
        meant.extend(&self.tokens[self.at + 1..self.at + end]);
        meant.push(brace(Mark::Close, end));
        self.at += end;
        true
    }

    /// `isosurface { function f(x, y, z) = x*x + y*y - 1 … }`: a name, and parameters that it has without them, which
    /// begin at `open`; all of its line is the formula.
    fn named_formula(&mut self, open: usize, meant: &mut Vec<Token>) -> bool {
        let axes = [Word::X, Word::Y, Word::Z].map(TokenKind::Word);
        let kinds: Vec<TokenKind> = meant[open..].iter().map(|token| token.kind).collect();
        let named = open > 1
            && meant[open - 1].kind == TokenKind::Name
            && meant[open - 2].kind == TokenKind::Word(Word::Function);
        let of_place = matches!(kinds[..], [_, x, _, y, _, z, _] if [x, y, z] == axes);
        let end = self.line_end(1);
        let signs = [Mark::Semicolon, Mark::Open(Bracket::Brace), Mark::Close(Bracket::Brace)];
        let is_plain = (1..end).all(|at| !signs.iter().any(|sign| self.is(at, *sign)));
        if !named || !of_place || end < 2 || !is_plain {
            return false;
        }
        let (sign, last) = (self.span(0, 0), self.span(end - 1, end - 1));
        let name = Span { start: meant[open - 1].start, ..sign };
        let formula = self.text.get(self.span(1, end - 1).range()).unwrap_or("");
        let message = "a function has no name, and its formula stands between `{` and `}`";
        self.diagnostics.push(
            Diagnostic::new(Code::UnexpectedCharacter, message)
                .at(name, "expected `{` instead of this")
                .help(format!("write `function {{ {formula} }}`"))
                .fix(name, "{")
                .fix(last.after(), " }"),
        );
        meant.truncate(open - 1);
        let brace = |bracket: fn(Bracket) -> Mark, place: Span| Token {
            kind: TokenKind::Mark(bracket(Bracket::Brace)),
            start: place.start,
            end: place.end,
        };
        meant.push(brace(Mark::Open, sign));
        meant.extend(&self.tokens[self.at + 1..self.at + end]);
        meant.push(brace(Mark::Close, last.after()));
        self.at += end;
        true
    }
}

/// One of two values by a condition, as functions have it, those of POV-Ray, too.
pub(super) fn selected(condition: &str, compares: bool, then: &str, otherwise: &str) -> String {
    match compares {
        true => format!("select(-({condition}), {then}, {otherwise})"),
        // Any number but 0 is true.
        false => format!("select({condition}, {then}, {otherwise}, {then})"),
    }
}
