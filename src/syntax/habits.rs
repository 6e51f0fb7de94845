//! Habits of other languages: a directive without its `#`, `let A = 1`, `A += 1`, `==`, `&&`.
//!
//! **In:** the tokens. **Out:** the tokens that were meant, and one message for each habit.
//! **Invariant:** a text without mistakes passes unchanged: nothing here is a form of the language.

use super::token::{Bracket, Head, Mark, Token, TokenKind};
use crate::diagnostic::{Code, Diagnostic, Diagnostics};
use crate::source::{FileId, Span};
use crate::vocabulary::Word;

/// What declares a name elsewhere.
const DECLARERS: &[&str] = &[
    "let", "var", "const", "def", "define", "set", "float", "double", "int", "vector", "vec3",
    "color3",
];

pub(super) fn translate(
    tokens: Vec<Token>,
    text: &str,
    file: FileId,
    diagnostics: &mut Diagnostics,
) -> Vec<Token> {
    let mut reader = Reader { tokens: &tokens, at: 0, text, file, diagnostics };
    let mut meant = Vec::with_capacity(tokens.len());
    while reader.at < tokens.len() {
        if !reader.habit(&mut meant) {
            meant.push(tokens[reader.at]);
            reader.at += 1;
        }
    }
    meant
}

struct Reader<'a> {
    tokens: &'a [Token],
    at: usize,
    text: &'a str,
    file: FileId,
    diagnostics: &'a mut Diagnostics,
}

impl Reader<'_> {
    fn kind(&self, ahead: usize) -> Option<TokenKind> {
        self.tokens.get(self.at + ahead).map(|token| token.kind)
    }

    fn is(&self, ahead: usize, mark: Mark) -> bool {
        self.kind(ahead) == Some(TokenKind::Mark(mark))
    }

    /// Whether nothing stands between the token at `ahead` and the one before it.
    fn touches(&self, ahead: usize) -> bool {
        match (self.tokens.get(self.at + ahead - 1), self.tokens.get(self.at + ahead)) {
            (Some(before), Some(after)) => before.end == after.start,
            _ => false,
        }
    }

    fn span(&self, from: usize, to: usize) -> Span {
        let (from, to) = (self.tokens[self.at + from], self.tokens[self.at + to]);
        Span::new(self.file, from.start as usize, to.end as usize)
    }

    fn slice(&self, ahead: usize) -> &str {
        let token = self.tokens[self.at + ahead];
        self.text.get(token.start as usize..token.end as usize).unwrap_or("")
    }

    /// Takes a habit that starts here, if one does.
    fn habit(&mut self, meant: &mut Vec<Token>) -> bool {
        match self.tokens[self.at].kind {
            TokenKind::Word(word) => self.head_without_hash(word, meant),
            TokenKind::Name => self.declarer(meant) || self.changes(meant),
            TokenKind::Mark(mark @ (Mark::Equal | Mark::And | Mark::Or | Mark::Star)) => {
                self.doubled(mark, meant)
            }
            _ => false,
        }
    }

    /// `if (…)`, `declare A = …`: the word of a directive where only its `#` makes sense.
    fn head_without_hash(&mut self, word: Word, meant: &mut Vec<Token>) -> bool {
        let after_paren = self.is(1, Mark::Open(Bracket::Round));
        let names = matches!(self.kind(1), Some(TokenKind::Name));
        let fits = match word {
            Word::If
            | Word::While
            | Word::For
            | Word::Switch
            | Word::Elseif
            | Word::Ifdef
            | Word::Ifndef => after_paren,
            Word::Declare | Word::Local | Word::Macro | Word::Undef => names,
            Word::Include => self.kind(1) == Some(TokenKind::String),
            Word::Else | Word::End => true,
            _ => return false,
        };
        if !fits {
            return false;
        }
        let name = word.name();
        let span = self.span(0, 0);
        if word == Word::For
            && let Some(end) = self.foreign_loop()
        {
            let diagnostic = Diagnostic::new(Code::UnknownDirective, "a loop of another language")
                .at(span, "`for` is a directive here, and counts by itself")
                .help("write `#for (I, 0, 9) … #end`: from 0 to 9, both included");
            self.diagnostics.push(diagnostic);
            self.at += end;
            return true;
        }
        let diagnostic =
            Diagnostic::new(Code::UnknownDirective, format!("`{name}` needs a `#` before it"))
                .at(span, "a directive without its `#`")
                .help(format!("write `#{name}`"))
                .fix(Span { end: span.start, ..span }, "#");
        self.diagnostics.push(diagnostic);
        meant.push(Token {
            kind: TokenKind::Directive(Head::from_word(name)),
            ..self.tokens[self.at]
        });
        self.at += 1;
        true
    }

    /// `for (…;…;…) { … }`: how many tokens it is.
    fn foreign_loop(&self) -> Option<usize> {
        let head = self.closed(1, Bracket::Round)?;
        let semicolons = (1..head).filter(|ahead| self.is(*ahead, Mark::Semicolon)).count();
        if semicolons == 0 {
            return None;
        }
        match self.is(head + 1, Mark::Open(Bracket::Brace)) {
            true => Some(self.closed(head + 1, Bracket::Brace)? + 1),
            false => Some(head + 1),
        }
    }

    /// Where the bracket that opens at `ahead` closes.
    fn closed(&self, ahead: usize, bracket: Bracket) -> Option<usize> {
        let mut depth = 0usize;
        for ahead in ahead..self.tokens.len() - self.at {
            if self.is(ahead, Mark::Open(bracket)) {
                depth += 1;
            } else if self.is(ahead, Mark::Close(bracket)) {
                depth -= 1;
                if depth == 0 {
                    return Some(ahead);
                }
            }
        }
        None
    }

    /// `let A = 1`.
    fn declarer(&mut self, meant: &mut Vec<Token>) -> bool {
        let fits = DECLARERS.contains(&self.slice(0))
            && self.kind(1) == Some(TokenKind::Name)
            && self.is(2, Mark::Equal);
        if fits {
            let word = self.slice(0).to_owned();
            let span = self.span(0, 0);
            let diagnostic = Diagnostic::new(
                Code::UnknownWord,
                format!("a name is declared by `#declare`, not by `{word}`"),
            )
            .at(span, "not a word of the language")
            .help("replace it with `#declare`")
            .fix(span, "#declare");
            self.diagnostics.push(diagnostic);
            meant.push(Token { kind: TokenKind::Directive(Head::Declare), ..self.tokens[self.at] });
            self.at += 1;
        }
        fits
    }

    /// `A += 1`, `A++`.
    fn changes(&mut self, meant: &mut Vec<Token>) -> bool {
        let operator = match self.kind(1) {
            Some(TokenKind::Mark(Mark::Plus)) => "+",
            Some(TokenKind::Mark(Mark::Minus)) => "-",
            Some(TokenKind::Mark(Mark::Star)) => "*",
            Some(TokenKind::Mark(Mark::Slash)) => "/",
            _ => return false,
        };
        let assigns = self.is(2, Mark::Equal) && self.touches(2);
        let same = self.kind(1) == self.kind(2) && self.touches(2) && matches!(operator, "+" | "-");
        let steps = same
            && matches!(
                self.kind(3),
                None | Some(
                    TokenKind::Mark(Mark::Semicolon | Mark::Close(_)) | TokenKind::Directive(_)
                )
            );
        if !assigns && !steps {
            return false;
        }
        let name = self.slice(0).to_owned();
        let sign = format!("{operator}{}", if assigns { "=" } else { operator });
        let change = if assigns { "…" } else { "1" };
        let diagnostic = Diagnostic::new(
            Code::UnexpectedCharacter,
            format!("`{sign}` is not an operator of the language"),
        )
        .at(self.span(1, 2), "no value is changed in place")
        .help(format!("write `#declare {name} = {name} {operator} {change};`"));
        self.diagnostics.push(diagnostic);
        // Read as `#declare A = A + …`, with the `#declare` that may stand before it.
        let token = |kind| Token { kind, ..self.tokens[self.at] };
        if !matches!(
            meant.last().map(|token| token.kind),
            Some(TokenKind::Directive(Head::Declare | Head::Local))
        ) {
            meant.push(token(TokenKind::Directive(Head::Declare)));
        }
        meant.extend([
            token(TokenKind::Name),
            token(TokenKind::Mark(Mark::Equal)),
            token(TokenKind::Name),
        ]);
        if assigns {
            meant.push(self.tokens[self.at + 1]);
        }
        self.at += 3;
        true
    }

    /// `==`, `&&`, `||`, `**`.
    fn doubled(&mut self, mark: Mark, meant: &mut Vec<Token>) -> bool {
        if !(self.is(1, mark) && self.touches(1)) {
            return false;
        }
        let span = self.span(0, 1);
        let (message, help, fix) = match mark {
            Mark::Equal => ("equality is written `=`", "replace it with `=`", Some("=")),
            Mark::And => ("`and` is written `&`", "replace it with `&`", Some("&")),
            Mark::Or => ("`or` is written `|`", "replace it with `|`", Some("|")),
            _ => {
                ("`**` is not an operator of the language", "a power is written `pow(a, b)`", None)
            }
        };
        let mut diagnostic = Diagnostic::new(Code::UnexpectedCharacter, message)
            .at(span, "an operator of another language")
            .help(help);
        if let Some(fix) = fix {
            diagnostic = diagnostic.fix(span, fix);
        }
        self.diagnostics.push(diagnostic);
        meant.push(self.tokens[self.at]);
        self.at += 2;
        true
    }
}
