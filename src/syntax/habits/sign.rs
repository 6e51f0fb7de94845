//! Signs of other languages: `and`, `'strings'`, `# comments`.

use super::Reader;
use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::syntax::token::{Bracket, Head, Mark, Token, TokenKind};

impl Reader<'_> {
    /// `and`, `or`, `not` inside parentheses.
    pub(super) fn logic(&mut self, meant: &mut Vec<Token>) -> bool {
        // `#declare A = not B;`
        let after_equal =
            meant.last().is_some_and(|last| last.kind == TokenKind::Mark(Mark::Equal));
        let begins = after_equal && self.slice(0).eq_ignore_ascii_case("not");
        if !begins && !self.inside.last().is_some_and(|inside| inside.is(Bracket::Round)) {
            return false;
        }
        let (mark, sign) = match self.slice(0) {
            "and" | "AND" => (Mark::And, "&"),
            "or" | "OR" => (Mark::Or, "|"),
            "not" | "NOT" => (Mark::Not, "!"),
            _ => return false,
        };
        // A name of this spelling would be followed by an operator or the end.
        let ends = match self.kind(1) {
            Some(TokenKind::Mark(mark)) => {
                matches!(mark, Mark::Close(_) | Mark::Comma) || begins && !is_opener(mark)
            }
            Some(_) => false,
            None => true,
        };
        if ends {
            return false;
        }
        let name = self.slice(0).to_owned();
        let diagnostic =
            Diagnostic::new(Code::UnexpectedCharacter, format!("`{name}` is written `{sign}`"))
                .at(self.span(0, 0), "an operator of another language")
                .help(format!("replace it with `{sign}`"))
                .fix(self.span(0, 0), sign);
        self.diagnostics.push(diagnostic);
        meant.push(Token { kind: TokenKind::Mark(mark), ..self.tokens[self.at] });
        self.at += 1;
        true
    }

    /// `(N => 2)`, `(N <> 2)`: comparisons as other languages write them.
    pub(super) fn turned(&mut self, meant: &mut Vec<Token>) -> bool {
        if !self.inside.last().is_some_and(|inside| inside.is(Bracket::Round)) || !self.touches(1) {
            return false;
        }
        let (mark, sign) = match (self.kind(0), self.kind(1)) {
            (Some(TokenKind::Mark(Mark::Equal)), Some(TokenKind::Mark(Mark::Greater))) => {
                (Mark::GreaterOrEqual, ">=")
            }
            (Some(TokenKind::Mark(Mark::Less)), Some(TokenKind::Mark(Mark::Greater))) => {
                (Mark::NotEqual, "!=")
            }
            (Some(TokenKind::Mark(Mark::Equal)), Some(TokenKind::Mark(Mark::Less)))
                if !self.closes_vector(2) =>
            {
                (Mark::LessOrEqual, "<=")
            }
            _ => return false,
        };
        let span = self.span(0, 1);
        let text = self.text.get(span.range()).unwrap_or("").to_owned();
        let diagnostic =
            Diagnostic::new(Code::UnexpectedCharacter, format!("`{text}` is written `{sign}`"))
                .at(span, "an operator of another language")
                .help(format!("replace it with `{sign}`"))
                .fix(span, sign);
        self.diagnostics.push(diagnostic);
        meant.push(Token { kind: TokenKind::Mark(mark), end: span.end, ..self.tokens[self.at] });
        self.at += 2;
        true
    }

    /// `Path(0.5)->x`.
    pub(super) fn arrow(&mut self, meant: &mut Vec<Token>) -> bool {
        const PARTS: [&str; 10] = ["x", "y", "z", "u", "v", "t", "red", "green", "blue", "gray"];
        let named = self.is(1, Mark::Greater)
            && self.touches(1)
            && self.kind(2).is_some()
            && self.touches(2)
            && PARTS.contains(&self.slice(2));
        if !named {
            return false;
        }
        let span = self.span(0, 1);
        let diagnostic =
            Diagnostic::new(Code::UnexpectedCharacter, "a component is taken by `.`, not by `->`")
                .at(span, "expected `.`")
                .help("replace it with `.`")
                .fix(span, ".");
        self.diagnostics.push(diagnostic);
        meant.push(Token {
            kind: TokenKind::Mark(Mark::Dot),
            end: span.end,
            ..self.tokens[self.at]
        });
        self.at += 2;
        true
    }

    /// `/ the stick`: a line that begins with one stroke, behind a statement.
    pub(super) fn half_comment(&mut self, meant: &[Token]) -> bool {
        let ended = meant.last().is_none_or(|last| {
            matches!(last.kind, TokenKind::Mark(Mark::Close(Bracket::Brace) | Mark::Semicolon))
        });
        let span = self.span(0, 0);
        let before = self.text.get(..span.start as usize).unwrap_or("");
        let begins = before.trim_end_matches([' ', '\t']).ends_with(['\n', '\r']);
        let words = matches!(self.kind(1), Some(TokenKind::Name | TokenKind::Word(_)));
        if !ended || !begins || !words {
            return false;
        }
        let diagnostic = Diagnostic::new(Code::UnexpectedCharacter, "a comment begins with `//`")
            .at(span, "this is half of that")
            .help("replace it with `//`")
            .fix(span, "//");
        self.diagnostics.push(diagnostic);
        let rest = self.text.get(span.end as usize..).unwrap_or("");
        let end = span.end as usize + rest.find(['\n', '\r']).unwrap_or(rest.len());
        while self.tokens.get(self.at).is_some_and(|token| (token.start as usize) < end) {
            self.at += 1;
        }
        true
    }

    /// `Peg(H = 3, R = 0.2)`: arguments by their names.
    pub(super) fn named_argument(&mut self, meant: &mut Vec<Token>) -> bool {
        let [.., before, name] = meant[..] else { return false };
        let begins =
            matches!(before.kind, TokenKind::Mark(Mark::Comma | Mark::Open(Bracket::Round)));
        if name.kind != TokenKind::Name || !begins {
            return false;
        }
        let mut depth = 0;
        let open = meant.iter().rposition(|token| {
            match token.kind {
                TokenKind::Mark(Mark::Close(Bracket::Round)) => depth += 1,
                TokenKind::Mark(Mark::Open(Bracket::Round)) => depth -= 1,
                _ => {}
            }
            depth < 0
        });
        let Some(open) = open.filter(|open| *open > 0) else { return false };
        let called = meant[open - 1];
        let defined = open > 1 && meant[open - 2].kind == TokenKind::Directive(Head::Macro);
        if called.kind != TokenKind::Name || defined || called.end != meant[open].start {
            return false;
        }
        let span = Span { start: name.start, ..self.span(0, 0) };
        // The first of a call speaks for the others.
        if self.named.replace(meant[open].start) != Some(meant[open].start) {
            let text = |token: Token| {
                self.text.get(token.start as usize..token.end as usize).unwrap_or("").to_owned()
            };
            let message =
                format!("`{}` takes its arguments in order, and not by their names", text(called));
            let diagnostic = Diagnostic::new(Code::UnexpectedCharacter, message)
                .at(span, "expected a value alone")
                .help(format!("leave `{} =` out, and that of the others", text(name)));
            self.diagnostics.push(diagnostic);
        }
        meant.pop();
        self.at += 1;
        true
    }

    /// Whether a `>` stands before the parenthesis that closes next.
    fn closes_vector(&self, from: usize) -> bool {
        let rest = self.tokens.get(self.at + from..).unwrap_or_default();
        let mut ends = rest.iter().map(|token| token.kind).filter(|kind| {
            let close = TokenKind::Mark(Mark::Close(Bracket::Round));
            *kind == close || *kind == TokenKind::Mark(Mark::Greater)
        });
        ends.next() == Some(TokenKind::Mark(Mark::Greater))
    }

    /// `#macro Leaf(S; T)`: arguments, which commas part.
    pub(super) fn semicolon_in_list(&mut self, meant: &mut Vec<Token>) -> bool {
        if !self.inside.last().is_some_and(|inside| inside.is(Bracket::Round)) {
            return false;
        }
        // `(#local B = 3; B*2)`
        let open = TokenKind::Mark(Mark::Open(Bracket::Round));
        let mut since = meant.iter().rev().map(|token| token.kind).take_while(|kind| *kind != open);
        if since.any(|kind| matches!(kind, TokenKind::Directive(_))) {
            return false;
        }
        let span = self.span(0, 0);
        let rest = self.text.get(span.end as usize..).unwrap_or("");
        let list = rest.split(['#', '(', '{', '}', '\n', '\r']).next().unwrap_or("");
        if !list.contains(')') || list.trim_start().starts_with(')') {
            return false;
        }
        let diagnostic =
            Diagnostic::new(Code::UnexpectedCharacter, "commas part what stands in parentheses")
                .at(span, "expected `,`")
                .help("replace the `;` with `,`")
                .fix(span, ",");
        self.diagnostics.push(diagnostic);
        meant.push(Token { kind: TokenKind::Mark(Mark::Comma), ..self.tokens[self.at] });
        self.at += 1;
        true
    }

    /// `'colors.inc'`.
    pub(super) fn single_quotes(&mut self, meant: &mut Vec<Token>) -> bool {
        if self.slice(0) != "'" {
            return false;
        }
        let start = self.span(0, 0);
        let rest = self.text.get(start.end as usize..).unwrap_or("");
        let Some(length) =
            rest.find(['\'', '\n', '\r', '"']).filter(|&at| rest[at..].starts_with('\''))
        else {
            return false;
        };
        let end = start.end + length as u32;
        let close = Span { start: end, end: end + 1, ..start };
        let inside = &rest[..length];
        let diagnostic =
            Diagnostic::new(Code::UnexpectedCharacter, "a string stands between double quotes")
                .at(start.to(close), "expected `\"…\"`")
                .help(format!("write `\"{inside}\"`"))
                .fix(start, "\"")
                .fix(close, "\"");
        self.diagnostics.push(diagnostic);
        meant.push(Token { kind: TokenKind::String, end: close.end, ..self.tokens[self.at] });
        while self.tokens.get(self.at).is_some_and(|token| token.start < close.end) {
            self.at += 1;
        }
        true
    }

    /// `# a comment`.
    pub(super) fn hash_comment(&mut self) -> bool {
        let head = self.slice(0);
        if !head[1..].starts_with([' ', '\t']) {
            return false;
        }
        let token = self.tokens[self.at];
        let rest = self.text.get(token.end as usize..).unwrap_or("");
        let end = token.end + rest.find(['\n', '\r']).unwrap_or(rest.len()) as u32;
        let span = self.span(0, 0);
        let sign = Span { end: span.start + 1, ..span };
        let diagnostic = Diagnostic::new(Code::UnknownDirective, "a comment begins with `//`")
            .at(sign, "`#` begins a directive")
            .help("replace it with `//`")
            .fix(sign, "//");
        self.diagnostics.push(diagnostic);
        while self.tokens.get(self.at).is_some_and(|token| token.start < end) {
            self.at += 1;
        }
        true
    }
}

fn is_opener(mark: Mark) -> bool {
    matches!(mark, Mark::Open(_))
}
