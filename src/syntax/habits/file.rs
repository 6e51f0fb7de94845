//! The directives of files as other languages call theirs: `#fopen F, "a.txt", write`, `#read F, A, B`,
//! `#fclose "a.txt"`, `import "colors.inc"`.

use super::Reader;
use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::syntax::token::{Bracket, Head, Mark, Token, TokenKind};
use crate::vocabulary::Word;

/// What includes a file elsewhere.
const INCLUDERS: &[&str] = &["import", "require", "load", "use", "using"];

/// How the names of scenes and their includes end.
const SCENES: &[&str] = &[".inc\"", ".pov\"", ".scene\""];

impl Reader<'_> {
    /// `import "colors.inc"`
    pub(super) fn include_of_others(&mut self, meant: &mut Vec<Token>) -> bool {
        let fits = self.inside.is_empty()
            && INCLUDERS.contains(&self.slice(0))
            && self.kind(1) == Some(TokenKind::String)
            && SCENES.iter().any(|end| self.slice(1).ends_with(end));
        if !fits {
            return false;
        }
        let (word, span) = (self.slice(0).to_owned(), self.span(0, 0));
        let message = format!("`{word}` is not a word at the top level");
        let mut told = Diagnostic::new(Code::ForeignWord, message)
            .at(span, "did you mean `#include`?")
            .help(Word::Include.sentence())
            .fix(span, "#include");
        if self.is(2, Mark::Semicolon) {
            told = told.fix(self.span(2, 2), "");
            self.dropped.insert(self.at + 2, false);
        }
        self.diagnostics.push(told);
        meant.push(Token { kind: TokenKind::Directive(Head::Include), ..self.tokens[self.at] });
        self.at += 1;
        true
    }

    pub(super) fn file_directive(&mut self, head: Head, meant: &mut Vec<Token>) -> bool {
        match head {
            Head::Fopen => self.name_before_handle(meant) || self.parted_by_commas(meant),
            Head::Read | Head::Write => self.without_parentheses(head, meant),
            Head::Fclose => self.closed_by_file_name() || self.name_in_parentheses(head, meant),
            _ => false,
        }
    }

    /// `#fclose (F)`, `#undef (A)`: the one name of a directive, in parentheses.
    pub(super) fn name_in_parentheses(&mut self, head: Head, meant: &mut Vec<Token>) -> bool {
        let one =
            self.closed(1, Bracket::Round) == Some(3) && self.kind(2) == Some(TokenKind::Name);
        if !one {
            return false;
        }
        let (word, name) = (head.word(), self.slice(2).to_owned());
        let whole = self.span(1, 3);
        let message = format!("`#{word}` takes its name without parentheses");
        let gap = if self.touches(1) { " " } else { "" };
        self.diagnostics.push(
            Diagnostic::new(Code::ExpectedExpression, message)
                .at(whole, "expected the name alone")
                .help(format!("write `#{word} {name}`"))
                .fix(whole, format!("{gap}{name}")),
        );
        meant.extend([self.tokens[self.at], self.tokens[self.at + 2]]);
        self.at += 4;
        true
    }

    /// `#declare X = read(F);`: a directive gives the name its value.
    pub(super) fn read_as_function(&mut self, meant: &mut Vec<Token>) -> bool {
        let reads = self.kind(1) == Some(TokenKind::Name)
            && self.is(2, Mark::Equal)
            && self.kind(3) == Some(TokenKind::Word(Word::Read))
            && self.closed(4, Bracket::Round) == Some(6)
            && self.kind(5) == Some(TokenKind::Name);
        if !reads {
            return false;
        }
        let last = 6 + usize::from(self.is(7, Mark::Semicolon));
        let right = format!("#read ({}, {})", self.slice(5), self.slice(1));
        self.diagnostics.push(
            Diagnostic::new(Code::ForeignWord, "a file is read by a directive")
                .at(self.span(3, 6), "`read` gives no value")
                .help(format!("write `{right}`"))
                .fix(self.span(0, last), right),
        );
        let [head, name, open, file, close] =
            [0, 1, 4, 5, 6].map(|ahead| self.tokens[self.at + ahead]);
        let comma = Token { kind: TokenKind::Mark(Mark::Comma), start: file.end, end: file.end };
        let read = Token { kind: TokenKind::Directive(Head::Read), ..head };
        meant.extend([read, open, file, comma, name, close]);
        self.at += last + 1;
        true
    }

    /// `#fopen "a.txt" F read`.
    fn name_before_handle(&mut self, meant: &mut Vec<Token>) -> bool {
        if self.kind(1) != Some(TokenKind::String) || self.kind(2) != Some(TokenKind::Name) {
            return false;
        }
        let (file, handle) = (self.span(1, 1), self.span(2, 2));
        let [file_text, handle_text] = [1, 2].map(|ahead| self.slice(ahead).to_owned());
        let message = "`#fopen` takes the handle first, and then the name of the file";
        self.diagnostics.push(
            Diagnostic::new(Code::ExpectedExpression, message)
                .at(file, "expected the handle")
                .also(handle, "and this after it")
                .help(format!("write `#fopen {handle_text} {file_text} …`"))
                .fix(file, handle_text)
                .fix(handle, file_text),
        );
        meant.extend([0, 2, 1].map(|ahead| self.tokens[self.at + ahead]));
        self.at += 3;
        true
    }

    /// `#fopen F, "a.txt", write`, `#fopen (F, "a.txt", write)`.
    fn parted_by_commas(&mut self, meant: &mut Vec<Token>) -> bool {
        let close = match self.is(1, Mark::Open(Bracket::Round)) {
            true => match self.closed(1, Bracket::Round) {
                Some(close) => Some(close),
                None => return false,
            },
            false => None,
        };
        // The handle, and behind the last part.
        let (first, end) = close.map_or((1, self.line_end(1)), |close| (2, close));
        let commas: Vec<usize> = (first..end).filter(|&at| self.is(at, Mark::Comma)).collect();
        let begins = self.kind(first) == Some(TokenKind::Name)
            && [1, 2].iter().any(|behind| self.kind(first + behind) == Some(TokenKind::String));
        let place = match (close, commas.first()) {
            (Some(close), _) => self.span(1, close),
            (None, Some(&comma)) => self.span(comma, comma),
            (None, None) => return false,
        };
        if !begins {
            return false;
        }
        let message = "the parts of `#fopen` stand side by side, without parentheses or commas";
        let mut told = Diagnostic::new(Code::ExtraPart, message)
            .at(place, "signs of another language")
            .help("`#fopen Handle \"name\" read|write|append` opens a file");
        if let Some(close) = close {
            told = told.fix(self.span(1, 1), " ").fix(self.span(close, close), "");
        }
        for &comma in &commas {
            told = told.fix(self.span(comma, comma), " ");
        }
        self.diagnostics.push(told);
        meant.push(self.tokens[self.at]);
        let parts = (first..end).filter(|at| !commas.contains(at));
        meant.extend(parts.map(|at| self.tokens[self.at + at]));
        self.at += close.map_or(end, |close| close + 1);
        true
    }

    /// `#read F, A, B`.
    fn without_parentheses(&mut self, head: Head, meant: &mut Vec<Token>) -> bool {
        let end = self.line_end(1);
        let names_file = end > 1
            && self.kind(1) == Some(TokenKind::Name)
            && (end == 2 || self.is(2, Mark::Comma));
        if !names_file {
            return false;
        }
        let word = head.word();
        let arguments = self.span(1, end - 1);
        let message = format!("`#{word}` takes its arguments in parentheses");
        let before = Span { end: arguments.start, ..arguments };
        self.diagnostics.push(
            Diagnostic::new(Code::ExpectedExpression, message)
                .at(self.span(0, 0), "expected `(` after it")
                .also(arguments, "and `)` after these")
                .fix(before, "(")
                .fix(arguments.after(), ")"),
        );
        let sign = |mark, place: usize| Token { kind: TokenKind::Mark(mark), ..self.tokens[place] };
        meant.push(self.tokens[self.at]);
        meant.push(sign(Mark::Open(Bracket::Round), self.at + 1));
        meant.extend(&self.tokens[self.at + 1..self.at + end]);
        meant.push(sign(Mark::Close(Bracket::Round), self.at + end - 1));
        self.at += end;
        true
    }

    /// `#fclose "a.txt"`.
    fn closed_by_file_name(&mut self) -> bool {
        if self.kind(1) != Some(TokenKind::String) {
            return false;
        }
        let file = self.slice(1).to_owned();
        let told = Diagnostic::new(
            Code::ExpectedExpression,
            "`#fclose` takes the handle of a file, not its name",
        )
        .at(self.span(1, 1), "expected the name that `#fopen` gave it");
        let opened = (1..=self.at).rev().map(|back| self.at - back).find(|&at| {
            let kind = |ahead: usize| self.tokens.get(at + ahead).map(|token| token.kind);
            let text = |token: &Token| self.text.get(token.start as usize..token.end as usize);
            let comma = usize::from(kind(2) == Some(TokenKind::Mark(Mark::Comma)));
            kind(0) == Some(TokenKind::Directive(Head::Fopen))
                && kind(1) == Some(TokenKind::Name)
                && self.tokens.get(at + 2 + comma).and_then(text) == Some(file.as_str())
        });
        let handle = opened.and_then(|at| {
            let name = self.tokens[at + 1];
            self.text.get(name.start as usize..name.end as usize)
        });
        self.diagnostics.push(match handle {
            Some(handle) => {
                told.help(format!("write `#fclose {handle}`")).fix(self.span(1, 1), handle)
            }
            None => told,
        });
        self.at += 2;
        true
    }
}
