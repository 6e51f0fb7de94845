//! Reports characters without meaning in their position.

use super::ast::ExpressionKind;
use super::nest::{Nest, State};
use super::token::{Bracket, Mark, Token, TokenKind};
use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;

/// Typographic quotes of word processors, which no programming language uses.
const QUOTES: [char; 10] = ['“', '”', '„', '‟', '«', '»', '‘', '’', '‚', '‛'];

impl Nest<'_> {
    pub(super) fn stray(&mut self, token: Token) {
        let span = self.span(token);
        let text = self.slice(span);
        let previous = self.at.checked_sub(1).and_then(|at| self.tokens.get(at));
        if previous.is_some_and(|p| p.kind == TokenKind::Stray && p.end == token.start) {
            return;
        }
        if text == "#" {
            return self.report(
                Diagnostic::new(Code::LegacyForm, "this `#` stands alone")
                    .at(span, "expected a directive's word after it; it is left out")
                    .fix(span, ""),
            );
        }
        if text.chars().all(|c| QUOTES.contains(&c))
            && let Some(rest) = self.text.get(span.end as usize..)
            && let Some(close) = rest.find(|c| c == '\n' || QUOTES.contains(&c))
            && let Some(quote) = rest[close..].chars().next().filter(|quote| *quote != '\n')
        {
            return self.curly_string(span, span.end as usize + close, quote);
        }
        let shown: String = text.chars().flat_map(char::escape_debug).collect();
        let diagnostic = Diagnostic::new(
            Code::UnexpectedCharacter,
            format!("the character `{shown}` has no meaning here"),
        )
        .at(span, "outside strings and comments only the language's own signs can stand");
        let diagnostic = match text {
            "'" | "‘" | "’" | "“" | "”" => {
                diagnostic.help("strings stand between `\"` and `\"`")
            }
            "\"" => diagnostic.help("a string begins here and does not end"),
            "^" => diagnostic.help("a power is written `pow(a, b)`"),
            "%" => diagnostic.help("a remainder is written `mod(a, b)`"),
            "\\" if let Some(sign) = self.escape_behind(token) => {
                self.at += 1;
                let whole = Span { end: span.end + 1, ..span };
                let diagnostic = diagnostic
                    .help(format!("signs such as a new line stand in a string: `\"\\{sign}\"`"))
                    .fix(whole, format!("\"\\{sign}\""));
                self.report(diagnostic);
                return self.operand(ExpressionKind::Missing, whole, false);
            }
            "\u{a0}" => diagnostic.help("it is a no-break space: write a plain one"),
            _ => diagnostic,
        };
        self.report(diagnostic);
        let goes_on = self.tokens.get(self.at + 1).is_some_and(|next| {
            let open = TokenKind::Mark(Mark::Open(Bracket::Round));
            matches!(next.kind, TokenKind::Number | TokenKind::Name) || next.kind == open
        });
        // Reported: the next token is not another value.
        if goes_on && matches!(text, "%" | "^") && matches!(self.top().state, State::Holding { .. })
        {
            self.mark(Mark::Star, token);
        }
    }

    /// Returns the `n` of a `\n` outside strings.
    fn escape_behind(&self, backslash: Token) -> Option<char> {
        let next = self.tokens.get(self.at + 1)?;
        let sign = self.slice(self.span(*next));
        let is_escape = next.start == backslash.end && matches!(sign, "n" | "t" | "r");
        is_escape.then(|| sign.chars().next()).flatten()
    }

    /// `“…”`, as word processors write it: reported once, and parsed as an unknown string.
    fn curly_string(&mut self, open: Span, close: usize, quote: char) {
        let close = Span::new(self.file, close, close + quote.len_utf8());
        let opening = self.slice(open);
        let inside = self.slice(Span { start: open.end, end: close.start, ..open });
        let label = format!("expected a straight quote instead of `{opening}`");
        self.report(
            Diagnostic::new(Code::UnexpectedCharacter, "curly quotes do not make a string")
                .at(open, label)
                .also(close, format!("and instead of `{quote}`"))
                .help("strings stand between straight quotes: `\"…\"`")
                .help(format!("write `\"{inside}\"`"))
                .fix(open, "\"")
                .fix(close, "\""),
        );
        while self.tokens.get(self.at).is_some_and(|token| token.end < close.end) {
            self.at += 1;
        }
        self.operand(ExpressionKind::Missing, open.to(close), false);
    }
}
