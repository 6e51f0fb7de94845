//! What stands bare as elsewhere: a string without its quotes, `Line(The End, 2)`, quotes within one, comments, `-- how many` and
//! `<!-- snow -->`, a length between bars, `|A|`.

use super::Reader;
use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::syntax::token::{Bracket, Head, Mark, Token, TokenKind};
use crate::vocabulary::{Role, Word, standard_include_of};

/// How many tokens back the parenthesis of a call is looked for.
const MOST_ARGUMENTS: usize = 256;

/// How many tokens stand between two bars at most.
const MOST_BETWEEN_BARS: usize = 12;

impl Reader<'_> {
    /// Two names or more side by side, of which none is declared, as an argument of a call.
    pub(super) fn bare_string(&mut self, meant: &mut Vec<Token>) -> bool {
        let names = |kind| matches!(kind, Some(TokenKind::Name));
        let begins = matches!(
            meant.last().map(|last| last.kind),
            Some(TokenKind::Mark(Mark::Open(Bracket::Round) | Mark::Comma))
        );
        if !begins
            || !names(self.kind(1))
            || !self.inside.last().is_some_and(|inside| inside.is(Bracket::Round))
        {
            return false;
        }
        let count = (0..).take_while(|&ahead| names(self.kind(ahead))).count();
        let ends = self.is(count, Mark::Comma) || self.is(count, Mark::Close(Bracket::Round));
        let known = |ahead: usize| {
            let name = self.slice(ahead);
            self.declares_anywhere(name) || standard_include_of(name).is_some()
        };
        if !ends || !self.is_called(meant) || (0..count).any(known) {
            return false;
        }
        let span = self.span(0, count - 1);
        let text = self.text.get(span.range()).unwrap_or("");
        self.diagnostics.push(
            Diagnostic::new(Code::UndeclaredName, format!("`{text}` is no declared name"))
                .at(span, "a string stands in quotes")
                .help(format!("write `\"{text}\"`"))
                .fix(span, format!("\"{text}\"")),
        );
        meant.push(Token { kind: TokenKind::String, start: span.start, end: span.end });
        self.at += count;
        true
    }

    /// `f"N = {N}"`: a string with values in it.
    pub(super) fn formatted_string(&mut self, meant: &mut Vec<Token>) -> bool {
        let is_one = matches!(self.slice(0), "f" | "F")
            && self.kind(1) == Some(TokenKind::String)
            && self.touches(1);
        let inside = self.tokens.get(self.at + 1).map_or("", |_| self.slice(1));
        let Some(inside) = inside.strip_prefix('"').and_then(|text| text.strip_suffix('"')) else {
            return false;
        };
        if !is_one {
            return false;
        }
        let mut pieces = Vec::new();
        for (at, piece) in inside.split('{').enumerate() {
            let (value, text) = match piece.split_once('}') {
                Some((value, text)) if at > 0 => (value, text),
                None if at == 0 => ("", piece),
                _ => return false,
            };
            // `{N:.2f}`
            let (name, digits) = value.split_once(':').unwrap_or((value, ""));
            let digits = digits.trim_start_matches('.').trim_end_matches('f');
            let digits = digits.parse::<u32>().map_or("-1".to_owned(), |digits| digits.to_string());
            if at > 0 {
                pieces.push(format!("str({}, 0, {digits})", name.trim()));
            }
            if !text.is_empty() {
                pieces.push(format!("\"{text}\""));
            }
        }
        let right = match &pieces[..] {
            [] => "\"\"".to_owned(),
            [one] => one.clone(),
            pieces => format!("concat({})", pieces.join(", ")),
        };
        let whole = self.span(0, 1);
        self.diagnostics.push(
            Diagnostic::new(Code::UnexpectedCharacter, "no string has values in it")
                .at(self.span(0, 0), "a string of another language")
                .help(format!("write `{right}`"))
                .fix(whole, right),
        );
        meant.push(Token { start: whole.start + 1, ..self.tokens[self.at + 1] });
        self.at += 2;
        true
    }

    /// `"say "hello" now"`: quotes within a string.
    pub(super) fn quotes_within(&mut self, meant: &mut Vec<Token>) -> bool {
        let is_word =
            |kind| matches!(kind, Some(TokenKind::Name | TokenKind::Word(_) | TokenKind::Number));
        let end = (1..).find(|&ahead| !is_word(self.kind(ahead))).unwrap_or(1);
        let touching = end > 1
            && self.kind(end) == Some(TokenKind::String)
            && self.touches(1)
            && self.touches(end);
        if !touching {
            return false;
        }
        // `#write (F, "x"A"y")`
        let round = TokenKind::Mark(Mark::Open(Bracket::Round));
        let opener = meant.iter().rposition(|token| token.kind == round);
        let is_written = opener
            .and_then(|at| at.checked_sub(1))
            .is_some_and(|at| meant[at].kind == TokenKind::Directive(Head::Write));
        if is_written || (1..end).any(|at| self.declares_anywhere(self.slice(at))) {
            return false;
        }
        let (first, last) = (self.span(0, 0), self.span(end, end));
        let between = Span { start: first.end, end: last.start, ..first };
        let inside = self.text.get(between.range()).unwrap_or("");
        if inside.contains(['\n', '\r']) {
            return false;
        }
        let closing = Span { start: first.end - 1, ..first };
        let opening = Span { end: last.start + 1, ..last };
        self.diagnostics.push(
            Diagnostic::new(Code::UnexpectedCharacter, "this quote ends the string")
                .at(closing, format!("`{inside}` stands outside of it"))
                .help("a quote within a string is written `\\\"`")
                .fix(closing, "\\\"")
                .fix(opening, "\\\""),
        );
        meant.push(Token { kind: TokenKind::String, start: first.start, end: last.end });
        self.at += end + 1;
        true
    }

    /// Whether the innermost parenthesis opens behind a name that is called there, and not that of a macro's
    /// definition.
    fn is_called(&self, meant: &[Token]) -> bool {
        let near = &meant[meant.len().saturating_sub(MOST_ARGUMENTS)..];
        let mut depth = 0;
        let open = near.iter().rposition(|token| {
            depth += match token.kind {
                TokenKind::Mark(Mark::Close(_)) => 1,
                TokenKind::Mark(Mark::Open(_)) => -1,
                _ => 0,
            };
            depth < 0
        });
        match near[..open.unwrap_or(0)] {
            [.., head, name] => {
                name.kind == TokenKind::Name && head.kind != TokenKind::Directive(Head::Macro)
            }
            [name] => name.kind == TokenKind::Name,
            [] => false,
        }
    }

    /// `<!-- snow -->`: to its end.
    pub(super) fn comment_of_html(&mut self) -> bool {
        let start = self.tokens[self.at].start as usize;
        let rest = self.text.get(start..).unwrap_or("");
        if !rest.starts_with("<!--") {
            return false;
        }
        let end = start + rest.find("-->").map_or(rest.len(), |at| at + 3);
        let closed = rest.contains("-->");
        let span = Span::new(self.file, start, start + 4);
        let told = Diagnostic::new(
            Code::UnexpectedCharacter,
            "a comment stands behind `//`, or between `/*` and `*/`",
        )
        .at(span, "as a page of the web begins one");
        self.diagnostics.push(match closed {
            true => told.fix(span, "/*").fix(Span::new(self.file, end - 3, end), "*/"),
            false => told.fix(span, "/*"),
        });
        while self.tokens.get(self.at).is_some_and(|token| (token.start as usize) < end) {
            self.at += 1;
        }
        true
    }

    /// `...` for what was left out.
    pub(super) fn dots(&mut self) -> bool {
        let dot = |ahead: usize| self.is(ahead, Mark::Dot);
        if !(dot(1) && dot(2) && self.touches(1) && self.touches(2)) {
            return false;
        }
        let span = self.span(0, 2);
        self.diagnostics.push(
            Diagnostic::new(Code::UnexpectedCharacter, "`...` has no meaning here")
                .at(span, "it stands for what was left out")
                .help("write what it stands for, or leave it out"),
        );
        self.at += 3;
        true
    }

    /// `sphere: { … }`.
    pub(super) fn colon_before_block(&mut self, meant: &[Token]) -> bool {
        let word = match meant.last().map(|last| last.kind) {
            Some(TokenKind::Word(word)) if word.role() == Role::Statement => word,
            _ => return false,
        };
        if !self.is(1, Mark::Open(Bracket::Brace)) {
            return false;
        }
        let (name, span) = (word.name(), self.span(0, 0));
        let message = format!("`{name}` has its block right behind it, without `:`");
        self.diagnostics.push(
            Diagnostic::new(Code::UnexpectedCharacter, message)
                .at(span, "a sign of another language")
                .help(format!("write `{name} {{ … }}`"))
                .fix(span, ""),
        );
        self.at += 1;
        true
    }

    /// A number behind a bracket, and more: no index of an array.
    fn begins_entry(&self) -> bool {
        let closed = TokenKind::Mark(Mark::Close(Bracket::Square));
        self.kind(1) == Some(TokenKind::Number) && self.kind(2).is_some_and(|kind| kind != closed)
    }

    /// `[0 Red [1 Blue]` in a map: the first entry is not closed.
    pub(super) fn entry_in_entry(&mut self, meant: &mut Vec<Token>) -> bool {
        let [.., map, entry] = self.inside.as_slice() else { return false };
        // `[0 C[2*K]]`: an index touches what it belongs to, and what is open is closed.
        let is_index = self.at > 0
            && self.touches(0)
            && matches!(
                meant.last().map(|last| last.kind),
                Some(TokenKind::Name | TokenKind::Mark(Mark::Close(Bracket::Square)))
            );
        let is_one = map.is_map() && entry.is(Bracket::Square) && self.begins_entry();
        if !is_one || is_index {
            return false;
        }
        let square = TokenKind::Mark(Mark::Open(Bracket::Square));
        let Some(opener) = meant.iter().rfind(|token| token.kind == square) else { return false };
        let (opener, last) = (*opener, meant.last().map_or(opener.end, |last| last.end));
        let span = |start: u32, end: u32| Span::new(self.file, start as usize, end as usize);
        self.diagnostics.push(
            Diagnostic::new(Code::UnclosedBlock, "this `[` is never closed")
                .at(span(opener.start, opener.end), "opened here")
                .also(self.span(0, 0), "expected `]` before this")
                .fix(span(last, last), "]"),
        );
        let kind = TokenKind::Mark(Mark::Close(Bracket::Square));
        meant.push(Token { kind, start: last, end: last });
        if let Some(inside) = self.inside.pop() {
            self.leave(inside);
        }
        self.take(meant);
        true
    }

    /// `|A|`: how long a vector is, as mathematics has it.
    pub(super) fn length_between_bars(&mut self, meant: &mut Vec<Token>) -> bool {
        let wanted = matches!(
            meant.last().map(|last| last.kind),
            Some(TokenKind::Mark(
                Mark::Equal
                    | Mark::Comma
                    | Mark::Open(_)
                    | Mark::Star
                    | Mark::Slash
                    | Mark::Plus
                    | Mark::Minus
                    | Mark::Less
                    | Mark::Greater
            ))
        );
        let near = (1..MOST_BETWEEN_BARS).find(|&ahead| {
            matches!(
                self.kind(ahead),
                None | Some(
                    TokenKind::Mark(Mark::Or | Mark::Semicolon | Mark::Open(Bracket::Brace))
                        | TokenKind::Directive(_)
                )
            )
        });
        let Some(close) = near.filter(|&close| wanted && close > 1 && self.is(close, Mark::Or))
        else {
            return false;
        };
        let (whole, inside) = (self.span(0, close), self.span(1, close - 1));
        let text = self.text.get(inside.range()).unwrap_or("");
        let told = Diagnostic::new(Code::UnexpectedCharacter, "`|` is the operator *or*");
        let in_formula = is_in_formula(meant);
        let (word, told) = match in_formula {
            true => {
                let right = format!("abs({text})");
                let told = told.at(whole, "no sign for an absolute value");
                (Word::Abs, told.help(format!("write `{right}`")).fix(whole, right))
            }
            false => {
                let told = told.at(whole, "not a sign for length");
                let help =
                    format!("how long a vector is: `vlength({text})`; of a number: `abs({text})`");
                (Word::Vlength, told.help(help))
            }
        };
        self.diagnostics.push(told);
        let (first, last) = (self.tokens[self.at], self.tokens[self.at + close]);
        let sign = |mark, place: Token| Token { kind: TokenKind::Mark(mark), ..place };
        meant.push(Token { kind: TokenKind::Word(word), end: first.start, ..first });
        meant.push(sign(Mark::Open(Bracket::Round), first));
        meant.extend(&self.tokens[self.at + 1..self.at + close]);
        meant.push(sign(Mark::Close(Bracket::Round), last));
        self.at += close + 1;
        true
    }

    /// `#declare N = 6; -- how many`: to the end of the line.
    pub(super) fn comment_of_dashes(&mut self, meant: &[Token]) -> bool {
        let begins = match meant.last() {
            None => true,
            Some(last) => {
                let start = self.tokens[self.at].start as usize;
                let gap = self.text.get(last.end as usize..start).unwrap_or("");
                let ended = matches!(
                    last.kind,
                    TokenKind::Mark(Mark::Semicolon | Mark::Close(Bracket::Brace))
                );
                ended || gap.contains('\n')
            }
        };
        let prose = |kind| matches!(kind, Some(TokenKind::Name | TokenKind::Word(_)));
        let dashes = self.is(1, Mark::Minus) && self.touches(1) && !self.touches(2);
        if !begins || !dashes || !prose(self.kind(2)) || !prose(self.kind(3)) {
            return false;
        }
        let span = self.span(0, 1);
        let rest = self.text.get(span.start as usize..).unwrap_or("");
        let end = span.start as usize + rest.find(['\n', '\r']).unwrap_or(rest.len());
        self.diagnostics.push(
            Diagnostic::new(Code::UnexpectedCharacter, "a comment begins with `//`")
                .at(span, "as other languages begin theirs")
                .help("replace it with `//`")
                .fix(span, "//"),
        );
        while self.tokens.get(self.at).is_some_and(|token| (token.start as usize) < end) {
            self.at += 1;
        }
        true
    }
}

/// Whether what comes next stands in the braces of a `function`, where all values are numbers.
fn is_in_formula(meant: &[Token]) -> bool {
    let mut depth = 0;
    let opener = meant.iter().rposition(|token| {
        match token.kind {
            TokenKind::Mark(Mark::Close(Bracket::Brace)) => depth += 1,
            TokenKind::Mark(Mark::Open(Bracket::Brace)) => depth -= 1,
            _ => {}
        }
        depth < 0
    });
    let before = meant.get(..opener.unwrap_or(0)).unwrap_or(&[]);
    // Its parameters.
    let names = |token: &&Token| {
        matches!(
            token.kind,
            TokenKind::Name
                | TokenKind::Word(Word::X | Word::Y | Word::Z | Word::U | Word::V)
                | TokenKind::Mark(
                    Mark::Comma | Mark::Open(Bracket::Round) | Mark::Close(Bracket::Round)
                )
        )
    };
    let word = before.iter().rev().find(|token| !names(token));
    word.is_some_and(|token| token.kind == TokenKind::Word(Word::Function))
}
