//! What a name is given as other languages write it: `#declare F(x) = x*x;`, `function F(x) { x*x }`,
//! `#declare V = 1, 0, 0;`, `#declare A = 1, B = 2;`.

use super::Reader;
use crate::diagnostic::{Code, Diagnostic};
use crate::syntax::token::{Bracket, Head, Mark, Token, TokenKind};
use crate::vocabulary::{Role, Word};

/// One number fewer is a fraction with a comma: `0,5`.
const FEWEST_COMPONENTS: usize = 3;

/// A vector has no more of them.
const MOST_COMPONENTS: usize = 5;

/// How many tokens before a comma the `#declare` of its statement is looked for.
const LONGEST_VALUE: usize = 40;

impl Reader<'_> {
    /// Whether all between two tokens is what the formula of a function is made of.
    pub(super) fn is_formula(&self, from: usize, to: usize) -> bool {
        let is_part = |at: usize| match self.kind(at) {
            Some(TokenKind::Number | TokenKind::Name) => true,
            Some(TokenKind::Word(word)) => word.role() != Role::Statement,
            Some(TokenKind::Mark(mark)) => matches!(
                mark,
                Mark::Plus
                    | Mark::Minus
                    | Mark::Star
                    | Mark::Slash
                    | Mark::Comma
                    | Mark::Open(Bracket::Round)
                    | Mark::Close(Bracket::Round)
            ),
            _ => false,
        };
        from < to && (from..to).all(is_part)
    }

    /// Whether names, with commas, are all between two tokens.
    fn are_parameters(&self, from: usize, to: usize) -> bool {
        let is_part = |at: usize| match self.kind(at) {
            Some(TokenKind::Name) => true,
            Some(TokenKind::Word(word)) => word.role() == Role::Value,
            _ => self.is(at, Mark::Comma),
        };
        from < to && (from..to).all(is_part)
    }

    /// What stands between two tokens, without them.
    pub(super) fn text_between(&self, from: usize, to: usize) -> &str {
        let (start, end) = (self.span(from, from).end as usize, self.span(to, to).start as usize);
        self.text.get(start..end).unwrap_or("").trim()
    }

    /// `#declare F(x, y) = x*x + y;`: a function as mathematics has it.
    pub(super) fn function_of_mathematics(&mut self, meant: &mut Vec<Token>) -> bool {
        let named = self.kind(1) == Some(TokenKind::Name);
        let Some(close) = self.closed(2, Bracket::Round).filter(|_| named) else { return false };
        let sign = close + 1;
        if !self.is(sign, Mark::Equal) || !self.are_parameters(3, close) {
            return false;
        }
        let line = self.line_end(sign + 1);
        let Some(end) = (sign + 1..line).find(|&at| self.is(at, Mark::Semicolon)) else {
            return false;
        };
        if !self.is_formula(sign + 1, end) {
            return false;
        }
        let (name, parameters) = (self.slice(1).to_owned(), self.text_between(2, close));
        let right =
            format!("{name} = function({parameters}) {{ {} }}", self.text_between(sign, end));
        let called = self.span(1, close);
        let text = self.text.get(called.range()).unwrap_or("");
        self.diagnostics.push(
            Diagnostic::new(Code::ExpectedExpression, format!("expected a name, found `{text}`"))
                .at(called, "parameters stand behind `function`")
                .help(format!("write `#declare {right}`"))
                .fix(self.span(1, end - 1), right),
        );
        let [name, first, last] = [1, sign, end - 1].map(|ahead| self.tokens[self.at + ahead]);
        let behind = |kind, start| Token { kind, start, end: start };
        meant.extend([self.tokens[self.at], name]);
        meant.push(behind(TokenKind::Mark(Mark::Equal), name.end));
        meant.push(behind(TokenKind::Word(Word::Function), name.end));
        meant.extend(&self.tokens[self.at + 2..self.at + sign]);
        meant.push(behind(TokenKind::Mark(Mark::Open(Bracket::Brace)), first.start));
        meant.extend(&self.tokens[self.at + sign + 1..self.at + end]);
        meant.push(behind(TokenKind::Mark(Mark::Close(Bracket::Brace)), last.end));
        self.at += end;
        true
    }

    /// `function F(x, y) { x*x + y }`: a function without its `#declare`.
    pub(super) fn function_alone(&mut self, meant: &mut Vec<Token>) -> bool {
        let begins = self.inside.is_empty()
            && self.kind(1) == Some(TokenKind::Name)
            && meant.last().is_none_or(|last| last.kind != TokenKind::Mark(Mark::Equal));
        let Some(close) = self.closed(2, Bracket::Round).filter(|_| begins) else { return false };
        let Some(end) = self.closed(close + 1, Bracket::Brace) else { return false };
        // `{ return x*x; }`: that is a mistake of its own.
        let returns = self.slice_is(close + 2, "return") && self.is(end - 1, Mark::Semicolon);
        let last = if returns { end - 1 } else { end };
        if !self.are_parameters(3, close) || !self.is_formula(close + 2, last) {
            return false;
        }
        let (head, name) = (self.span(0, 1), self.slice(1));
        let right = format!("#declare {name} = function");
        let parameters = self.text_between(2, close);
        self.diagnostics.push(
            Diagnostic::new(Code::ForeignWord, "a function gets its name in a `#declare`")
                .at(self.span(0, 0), "expected `#declare` before it")
                .help(format!("write `{right}({parameters}) {{ … }}`"))
                .fix(head, right),
        );
        let [word, name] = [0, 1].map(|ahead| self.tokens[self.at + ahead]);
        let behind = |kind| Token { kind, start: name.end, end: name.end };
        meant.push(Token { kind: TokenKind::Directive(Head::Declare), ..word });
        meant.push(name);
        meant.push(behind(TokenKind::Mark(Mark::Equal)));
        meant.push(behind(TokenKind::Word(Word::Function)));
        self.at += 2;
        true
    }

    /// `#declare V = 1, 0, 0;`: the numbers of a vector without their brackets.
    pub(super) fn bare_vector(&mut self, meant: &mut Vec<Token>) -> bool {
        if self.kind(1) != Some(TokenKind::Name) || !self.is(2, Mark::Equal) {
            return false;
        }
        let (mut end, mut count) = (2, 0);
        while end == 2 || self.is(end, Mark::Comma) {
            end += 1;
            end += usize::from(self.is(end, Mark::Minus) || self.is(end, Mark::Plus));
            if self.kind(end) != Some(TokenKind::Number) {
                return false;
            }
            (end, count) = (end + 1, count + 1);
        }
        let counts = (FEWEST_COMPONENTS..=MOST_COMPONENTS).contains(&count);
        if !counts || !self.is(end, Mark::Semicolon) {
            return false;
        }
        let whole = self.span(3, end - 1);
        let right = format!("<{}>", self.text.get(whole.range()).unwrap_or(""));
        let message = "the numbers of a vector stand between `<` and `>`";
        self.diagnostics.push(
            Diagnostic::new(Code::UnexpectedCharacter, message)
                .at(whole, "expected a vector")
                .help(format!("write `{right}`"))
                .fix(whole, right),
        );
        let angle = |mark, place| Token { kind: TokenKind::Mark(mark), start: place, end: place };
        meant.extend(&self.tokens[self.at..self.at + 3]);
        meant.push(angle(Mark::Less, whole.start));
        meant.extend(&self.tokens[self.at + 3..self.at + end]);
        meant.push(angle(Mark::Greater, whole.end));
        self.at += end;
        true
    }

    /// `#declare A = B = 2;`, `#declare A, B = 2;`: two names with one value.
    pub(super) fn names_of_one(&mut self, meant: &mut Vec<Token>) -> bool {
        let sign = |at: usize| self.is(at, Mark::Equal) && !(self.is(at + 1, Mark::Equal));
        let named = [1, 3].iter().all(|&at| self.kind(at) == Some(TokenKind::Name))
            && (sign(2) || self.is(2, Mark::Comma))
            && sign(4);
        let line = self.line_end(5);
        let Some(end) = (5..line).find(|&at| self.is(at, Mark::Semicolon)).filter(|_| named) else {
            return false;
        };
        let [first, second] = [1, 3].map(|at| self.slice(at).to_owned());
        // `A = (B = 2)` is rather meant.
        if self.has_declared(&second) || self.declares_otherwise(&second) {
            return false;
        }
        let (word, value) = (self.slice(0).to_owned(), self.text_between(4, end));
        let right = format!("{word} {second} = {value}; {word} {first} = {second}");
        let message = "each name has a `#declare` of its own";
        self.diagnostics.push(
            Diagnostic::new(Code::UnexpectedCharacter, message)
                .at(self.span(3, 3), "a second name")
                .help(format!("write `{right};`"))
                .fix(self.span(0, end - 1), right),
        );
        let [head, name, other] = [0, 1, 3].map(|ahead| self.tokens[self.at + ahead]);
        let last = self.tokens[self.at + end];
        let mark = |mark| Token { kind: TokenKind::Mark(mark), start: last.start, end: last.start };
        meant.extend([head, other]);
        meant.extend(&self.tokens[self.at + 4..self.at + end]);
        meant.push(mark(Mark::Semicolon));
        // The places of the first name are before, and what it is given is behind.
        meant.extend([head, name, mark(Mark::Equal), other]);
        self.at += end;
        true
    }

    /// The comma of `#declare A = 1, B = 2;`: two names in one `#declare`.
    pub(super) fn second_name(&mut self, meant: &mut Vec<Token>) -> bool {
        let named = self.kind(1) == Some(TokenKind::Name) && self.is(2, Mark::Equal);
        if !named || (self.is(3, Mark::Equal) && self.touches(3)) {
            return false;
        }
        let near = &meant[meant.len().saturating_sub(LONGEST_VALUE)..];
        let begins = near.iter().rposition(|token| {
            matches!(token.kind, TokenKind::Directive(_) | TokenKind::Mark(Mark::Semicolon))
        });
        let Some([head, name, equal, value @ ..]) = begins.and_then(|at| near.get(at..)) else {
            return false;
        };
        let declares = matches!(head.kind, TokenKind::Directive(Head::Declare | Head::Local))
            && name.kind == TokenKind::Name
            && equal.kind == TokenKind::Mark(Mark::Equal);
        let depth: isize = value
            .iter()
            .map(|token| match token.kind {
                TokenKind::Mark(Mark::Open(_)) => 1,
                TokenKind::Mark(Mark::Close(_)) => -1,
                _ => 0,
            })
            .sum();
        if !declares || value.is_empty() || depth != 0 {
            return false;
        }
        let (comma, head) = (self.span(0, 0), *head);
        let word = self.text.get(head.start as usize..head.end as usize).unwrap_or("#declare");
        let message = "each name has a `#declare` of its own";
        let gap = if self.touches(1) { " " } else { "" };
        self.diagnostics.push(
            Diagnostic::new(Code::UnexpectedCharacter, message)
                .at(comma, "expected `;` here")
                .help(format!("write `; {word} {} = …`", self.slice(1)))
                .fix(comma, format!("; {word}{gap}")),
        );
        let behind = |kind| Token { kind, start: comma.end, end: comma.end };
        meant.push(Token { kind: TokenKind::Mark(Mark::Semicolon), ..self.tokens[self.at] });
        meant.push(behind(head.kind));
        self.at += 1;
        true
    }
}
