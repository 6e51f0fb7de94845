//! Branches as other languages ask for them: `#else (A = 1)`, `#else #if (A = 1)` with one `#end`,
//! `#ifdef (A = 2)`, `function(x) { #if (x > 1) x #else 0 #end }`.

use super::Reader;
use super::case::innermost;
use super::formula::selected;
use crate::diagnostic::{Code, Diagnostic};
use crate::syntax::token::{Bracket, Head, Mark, Token, TokenKind};
use crate::vocabulary::{Role, Word};

/// How many tokens the head of a function is long at most.
const LONGEST_HEAD: usize = 24;

impl Reader<'_> {
    /// `else if (…)`.
    pub(super) fn else_if(&mut self, meant: &mut Vec<Token>) -> bool {
        let span = self.span(0, 1);
        let diagnostic = Diagnostic::new(Code::UnknownDirective, "`else if` is written `#elseif`")
            .at(span, "a directive of another language")
            .help("write `#elseif (…)`")
            .fix(span, "#elseif");
        let diagnostic = match self.closed(2, Bracket::Round) {
            Some(close) => self.braces(close + 1, diagnostic).0,
            None => diagnostic,
        };
        self.diagnostics.push(diagnostic);
        meant.push(Token { kind: TokenKind::Directive(Head::Elseif), ..self.tokens[self.at] });
        self.at += 2;
        true
    }

    pub(super) fn compares(&self, ahead: usize) -> bool {
        matches!(
            self.kind(ahead),
            Some(TokenKind::Mark(
                Mark::Equal
                    | Mark::NotEqual
                    | Mark::Less
                    | Mark::LessOrEqual
                    | Mark::Greater
                    | Mark::GreaterOrEqual
            ))
        )
    }

    /// `#else (A = 1) box { … }`: a condition, which `#elseif` takes. A value may stand there, too.
    pub(super) fn else_with_condition(&mut self, meant: &mut Vec<Token>) -> bool {
        let Some(close) = self.closed(1, Bracket::Round) else { return false };
        let opens = match self.kind(close + 1) {
            Some(TokenKind::Word(word)) => {
                word.role() == Role::Statement && self.is(close + 2, Mark::Open(Bracket::Brace))
            }
            Some(TokenKind::Directive(head)) => head != Head::End && !head.divides(),
            _ => false,
        };
        let asks = opens && (2..close).any(|at| self.compares(at));
        // `sphere { 0, #if (C) 1 #else (A = 1) pigment { … } #end }`: a value of the block.
        let of_if = self.inside.is_empty()
            && matches!(innermost(meant), Some(Head::If | Head::Ifdef | Head::Ifndef));
        if !asks || !of_if {
            return false;
        }
        let (head, condition) = (self.span(0, 0), self.span(1, close));
        let text = self.text.get(condition.range()).unwrap_or("(…)");
        self.diagnostics.push(
            Diagnostic::new(Code::UnknownDirective, "`#else` takes no condition")
                .at(head, "it stands for all that is left")
                .help(format!("write `#elseif {text}`"))
                .fix(head, "#elseif"),
        );
        meant.push(Token { kind: TokenKind::Directive(Head::Elseif), ..self.tokens[self.at] });
        self.at += 1;
        true
    }

    /// `#else #if (A = 1) … #end`, with one `#end` for both, as often as that is lacking.
    pub(super) fn else_then_if(&mut self, meant: &mut Vec<Token>) -> bool {
        let [missing, pairs] = self.ends();
        let is_pair =
            self.kind(1) == Some(TokenKind::Directive(Head::If)) && !self.breaks_before(1);
        if !is_pair || missing != pairs {
            return false;
        }
        let span = self.span(0, 1);
        let message = "an `#if` after `#else` has an `#end` of its own";
        self.diagnostics.push(
            Diagnostic::new(Code::UnknownDirective, message)
                .at(span, "one `#end` is too few for both")
                .help("write `#elseif (…)`, which needs none")
                .fix(span, "#elseif"),
        );
        meant.push(Token { kind: TokenKind::Directive(Head::Elseif), ..self.tokens[self.at] });
        self.at += 2;
        true
    }

    /// How many directives lack their `#end`, and how often `#else #if` stands on one line.
    pub(super) fn ends(&self) -> [isize; 2] {
        *self.missing_ends.get_or_init(|| {
            let (mut missing, mut pairs) = (0, 0);
            let mut before: Option<Token> = None;
            for token in self.tokens {
                missing += match token.kind {
                    TokenKind::Directive(Head::End) | TokenKind::Word(Word::End) => -1,
                    TokenKind::Directive(head) => isize::from(head.opens()),
                    _ => 0,
                };
                let is_else = |before: &Token| before.kind == TokenKind::Directive(Head::Else);
                if token.kind == TokenKind::Directive(Head::If)
                    && let Some(before) = before.filter(is_else)
                {
                    let gap = self.text.get(before.end as usize..token.start as usize);
                    pairs += isize::from(gap.is_some_and(|gap| !gap.contains(['\n', '\r'])));
                }
                before = Some(*token);
            }
            [missing, pairs]
        })
    }

    /// `#ifdef (A = 2)`, `#ifdef (!A)`, `#ifdef (A & B)`, `#ifdef ("A")`: more than the name that it takes.
    pub(super) fn more_than_a_name(&mut self, head: Head, meant: &mut Vec<Token>) -> bool {
        let other = match head {
            Head::Ifdef => Head::Ifndef,
            Head::Ifndef => Head::Ifdef,
            _ => return false,
        };
        let Some(close) = self.closed(1, Bracket::Round) else { return false };
        self.quoted_name(close, meant)
            || self.turned_name((head, other), close, meant)
            || (head == Head::Ifdef && self.names_together(close, meant))
            || (head == Head::Ifdef && self.compared_name(close, meant))
    }

    /// `#ifdef ("A")`
    fn quoted_name(&mut self, close: usize, meant: &mut Vec<Token>) -> bool {
        let text = self.tokens.get(self.at + 2).map_or("", |_| self.slice(2));
        let name = text.trim_matches('"').to_owned();
        let is_name = name.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
            && name.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'_')
            && Word::from_name(&name).is_none();
        let quoted = close == 3
            && self.kind(2) == Some(TokenKind::String)
            && text.len() == name.len() + "\"\"".len();
        if !quoted || !is_name {
            return false;
        }
        let span = self.span(2, 2);
        self.diagnostics.push(
            Diagnostic::new(Code::ExpectedExpression, "a name stands without quotes")
                .at(span, "expected a name, found a string")
                .help(format!("write `({name})`"))
                .fix(span, name),
        );
        let (start, end) = (span.start + 1, span.end - 1);
        meant.extend(&self.tokens[self.at..self.at + 2]);
        meant.push(Token { kind: TokenKind::Name, start, end });
        meant.push(self.tokens[self.at + close]);
        self.at += close + 1;
        true
    }

    /// `#ifdef (!A)`
    fn turned_name(
        &mut self,
        (head, other): (Head, Head),
        close: usize,
        meant: &mut Vec<Token>,
    ) -> bool {
        if close != 4 || !self.is(2, Mark::Not) || self.kind(3) != Some(TokenKind::Name) {
            return false;
        }
        let (word, name) = (self.span(0, 0), self.slice(3).to_owned());
        let right = format!("#{} ({name})", other.word());
        self.diagnostics.push(
            Diagnostic::new(
                Code::ExpectedExpression,
                format!("`#{}` takes a name, and no `!`", head.word()),
            )
            .at(self.span(2, 2), "expected a name")
            .help(format!("write `{right}`"))
            .fix(word.to(self.span(close, close)), right),
        );
        meant.push(Token { kind: TokenKind::Directive(other), ..self.tokens[self.at] });
        meant.extend([1, 3, close].map(|ahead| self.tokens[self.at + ahead]));
        self.at += close + 1;
        true
    }

    /// `#ifdef (A & B)`
    fn names_together(&mut self, close: usize, meant: &mut Vec<Token>) -> bool {
        let is_one = |at: usize| match at.is_multiple_of(2) {
            true => self.kind(at) == Some(TokenKind::Name),
            false => self.is(at, Mark::And) || self.is(at, Mark::Or),
        };
        if close < 5 || close.is_multiple_of(2) || !(2..close).all(is_one) {
            return false;
        }
        let asked: Vec<String> = (2..close)
            .map(|at| match at % 2 == 0 {
                true => format!("defined({})", self.slice(at)),
                false => self.slice(at).to_owned(),
            })
            .collect();
        let right = format!("#if ({})", asked.join(" "));
        self.diagnostics.push(
            Diagnostic::new(Code::ExpectedExpression, "`#ifdef` takes one name")
                .at(self.span(3, 3), "expected `)` before this")
                .help(format!("write `{right}`"))
                .fix(self.span(0, close), right),
        );
        let round = |mark: fn(Bracket) -> Mark, place: u32| Token {
            kind: TokenKind::Mark(mark(Bracket::Round)),
            start: place,
            end: place,
        };
        meant.push(Token { kind: TokenKind::Directive(Head::If), ..self.tokens[self.at] });
        meant.push(self.tokens[self.at + 1]);
        for at in 2..close {
            let token = self.tokens[self.at + at];
            if at % 2 == 0 {
                let word = TokenKind::Word(Word::Defined);
                meant.push(Token { kind: word, start: token.start, end: token.start });
                meant.extend([
                    round(Mark::Open, token.start),
                    token,
                    round(Mark::Close, token.end),
                ]);
            } else {
                meant.push(token);
            }
        }
        meant.push(self.tokens[self.at + close]);
        self.at += close + 1;
        true
    }

    /// `#ifdef (A = 2)`
    fn compared_name(&mut self, close: usize, meant: &mut Vec<Token>) -> bool {
        if !(2..close).any(|at| self.compares(at)) {
            return false;
        }
        let (head, condition) = (self.span(0, 0), self.span(1, close));
        let text = self.text.get(condition.range()).unwrap_or("(…)");
        self.diagnostics.push(
            Diagnostic::new(
                Code::ExpectedExpression,
                "`#ifdef` only asks whether a name is declared",
            )
            .at(head, "a condition stands behind it")
            .help(format!("write `#if {text}`"))
            .fix(head, "#if"),
        );
        meant.push(Token { kind: TokenKind::Directive(Head::If), ..self.tokens[self.at] });
        self.at += 1;
        true
    }

    /// `function(x) { #if (x > 1) x #else 0 #end }`: decided once, when nothing is known of `x`.
    pub(super) fn choice_by_parameter(&mut self, meant: &mut Vec<Token>) -> bool {
        let Some(parameters) = self.parameters_of_formula(meant) else { return false };
        let Some(close) = self.closed(1, Bracket::Round) else { return false };
        let is_own = |at: &usize| {
            let name = self.slice(*at);
            match parameters.is_empty() {
                true => matches!(name, "x" | "y" | "z" | "u" | "v"),
                false => parameters.contains(&name),
            }
        };
        // `V.x` is no parameter, nor is the axis of a vector that is asked: `vdot(V, x)`.
        let is_value = |at: &usize| {
            let called = (2..*at).any(|at| self.is(at, Mark::Open(Bracket::Round)));
            let is_axis = matches!(self.slice(*at), "x" | "y" | "z" | "u" | "v" | "t");
            !(self.is(*at - 1, Mark::Dot) || is_axis && called)
        };
        let is_declared = |at: &usize| !self.declares_as_value(self.slice(*at));
        let mut own = (2..close).filter(is_own).filter(is_value);
        let Some(asked) = own.find(is_declared) else { return false };
        let next = |from: usize| {
            let rest = self.tokens.get(self.at + from..)?;
            let is_directive = |token: &Token| matches!(token.kind, TokenKind::Directive(_));
            rest.iter().position(is_directive).map(|at| from + at)
        };
        let Some(otherwise) = next(close + 1) else { return false };
        let Some(end) = next(otherwise + 1) else { return false };
        let whole = self.kind(otherwise) == Some(TokenKind::Directive(Head::Else))
            && self.kind(end) == Some(TokenKind::Directive(Head::End))
            && self.is_formula(close + 1, otherwise)
            && self.is_formula(otherwise + 1, end);
        if !whole {
            return false;
        }
        let (condition, then) = (self.text_between(1, close), self.text_between(close, otherwise));
        let other = self.text_between(otherwise, end);
        let compares = (2..close).any(|at| self.compares(at));
        let right = selected(condition, compares, then, other);
        let name = self.slice(asked).to_owned();
        self.diagnostics.push(
            Diagnostic::new(Code::WrongType, "`#if` is decided once, when the function is defined")
                .at(self.span(asked, asked), format!("`{name}` has no value then"))
                .help(format!("write `{right}`"))
                .fix(self.span(0, end), right),
        );
        let mark = |mark, ahead: usize| Token {
            kind: TokenKind::Mark(mark),
            ..self.tokens[self.at + ahead]
        };
        // Below 0 where the condition holds.
        let round = Mark::Open(Bracket::Round);
        meant.push(Token { kind: TokenKind::Word(Word::Select), ..self.tokens[self.at] });
        meant.extend([mark(round, 0), mark(Mark::Minus, 0)]);
        meant.extend(&self.tokens[self.at + 1..=self.at + close]);
        meant.push(mark(Mark::Comma, close));
        meant.extend(&self.tokens[self.at + close + 1..self.at + otherwise]);
        meant.push(mark(Mark::Comma, otherwise));
        meant.extend(&self.tokens[self.at + otherwise + 1..self.at + end]);
        meant.push(mark(Mark::Close(Bracket::Round), end));
        self.at += end + 1;
        true
    }

    /// The parameters of the function whose brace was opened last; none are written where it has its own.
    fn parameters_of_formula(&self, meant: &[Token]) -> Option<Vec<&str>> {
        let (brace, head) = meant.split_last()?;
        if brace.kind != TokenKind::Mark(Mark::Open(Bracket::Brace)) {
            return None;
        }
        let near = &head[head.len().saturating_sub(LONGEST_HEAD)..];
        let word = near.iter().rposition(|token| token.kind == TokenKind::Word(Word::Function))?;
        let written = &near[word + 1..];
        let is_part = |token: &Token| match token.kind {
            TokenKind::Name | TokenKind::Word(_) => true,
            TokenKind::Mark(mark) => matches!(
                mark,
                Mark::Comma | Mark::Open(Bracket::Round) | Mark::Close(Bracket::Round)
            ),
            _ => false,
        };
        let is_name = |token: &&Token| !matches!(token.kind, TokenKind::Mark(_));
        let text = |token: &Token| self.text.get(token.start as usize..token.end as usize);
        written
            .iter()
            .all(is_part)
            .then(|| written.iter().filter(is_name).filter_map(text).collect())
    }
}
