//! Lines that are no part of a scene: options of the command line, `+W800 +H600`, and a text quoted in a mail.

use super::Reader;
use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::syntax::token::{Bracket, Mark, Token, TokenKind};

/// Letters that an option of POV-Ray's command line begins with, before a number.
const OPTIONS: &str = "WHAQRJFKSENP";

impl Reader<'_> {
    /// `+W800 +H600 +A0.3`, where items stand.
    pub(super) fn options_of_command_line(&mut self, meant: &[Token]) -> bool {
        let begins = self.inside.is_empty() && self.begins_line() && !goes_on(meant);
        let is_option = self.kind(1) == Some(TokenKind::Name) && self.touches(1) && {
            let name = self.slice(1);
            let digit =
                name.get(1..).is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit()));
            digit
                && name.get(..1).is_some_and(|first| OPTIONS.contains(&first.to_ascii_uppercase()))
        };
        if !begins || !is_option || self.declares_anywhere(self.slice(1)) {
            return false;
        }
        let start = self.tokens[self.at].start as usize;
        let rest = self.text.get(start..).unwrap_or("");
        let line = rest.lines().next().unwrap_or("").trim_end();
        let whole = Span::new(self.file, start, start + line.len());
        self.diagnostics.push(
            Diagnostic::new(Code::UnexpectedCharacter, "these are options of a command line")
                .at(whole, "no part of a scene")
                .help("give them where the scene is rendered: `lucarne a.scene --size 800x600 --antialias 3`")
                .fix(whole, ""),
        );
        while self
            .tokens
            .get(self.at)
            .is_some_and(|token| (token.start as usize) < start + line.len())
        {
            self.at += 1;
        }
        true
    }

    /// `> camera { … }` on each line, as a mail quotes it.
    pub(super) fn quoted_lines(&mut self, meant: &[Token]) -> bool {
        let is_quote = |at: usize| {
            self.tokens[at].kind == TokenKind::Mark(Mark::Greater) && self.line_begins_at(at)
        };
        if !is_quote(self.at) || goes_on(meant) || !self.inside.is_empty() || !self.quotes_on() {
            return false;
        }
        let quotes: Vec<usize> = (self.at..self.tokens.len()).filter(|&at| is_quote(at)).collect();
        if quotes.len() < 2 {
            return false;
        }
        let sign = |at: usize| {
            let token = self.tokens[at];
            Span::new(self.file, token.start as usize, token.end as usize)
        };
        let told = Diagnostic::new(Code::UnexpectedCharacter, "this text is quoted, as in a mail")
            .at(sign(self.at), "lines begin with `>`")
            .help("take the `>` away at the beginning of each line");
        let told = quotes.iter().fold(told, |told, &at| told.fix(sign(at), ""));
        self.diagnostics.push(told);
        self.dropped.extend(quotes.into_iter().skip(1).map(|at| (at, false)));
        self.at += 1;
        true
    }

    /// Whether the next line of words begins with `>`, too.
    fn quotes_on(&self) -> bool {
        let start = self.tokens[self.at].start as usize;
        let mut lines = self.text.get(start..).unwrap_or("").lines().skip(1);
        lines
            .find(|line| !line.trim().is_empty())
            .is_some_and(|line| line.trim_start().starts_with('>'))
    }

    fn begins_line(&self) -> bool {
        self.line_begins_at(self.at)
    }

    pub(super) fn line_begins_at(&self, at: usize) -> bool {
        let before = self.text.get(..self.tokens[at].start as usize).unwrap_or("");
        before
            .trim_end_matches([' ', '\t'])
            .chars()
            .next_back()
            .is_none_or(|c| matches!(c, '\n' | '\r'))
    }
}

/// Whether what is read goes on behind its last token: `#declare A = B` and a sum on the next line.
fn goes_on(meant: &[Token]) -> bool {
    meant.last().is_some_and(|last| {
        !matches!(last.kind, TokenKind::Mark(Mark::Semicolon | Mark::Close(Bracket::Brace)))
    })
}
