//! The cases of other languages: `case 0:`, `default:`, `break;` in a `#switch`.

use super::Reader;
use crate::diagnostic::{Code, Diagnostic};
use crate::syntax::token::{Bracket, Head, Mark, Token, TokenKind};
use crate::vocabulary::Word;

/// The directive that is open at the end of `meant`.
pub(super) fn innermost(meant: &[Token]) -> Option<Head> {
    let mut ended = 0;
    meant.iter().rev().find_map(|token| match token.kind {
        TokenKind::Directive(Head::End) => {
            ended += 1;
            None
        }
        TokenKind::Directive(head) if head.opens() && ended > 0 => {
            ended -= 1;
            None
        }
        TokenKind::Directive(head) if head.opens() => Some(head),
        _ => None,
    })
}

impl Reader<'_> {
    /// `case (0):`, `default:` and `break;`, each without its `#`.
    pub(super) fn case(&mut self, word: Word, meant: &mut Vec<Token>) -> bool {
        let open = match word {
            Word::Case | Word::Break | Word::Default => innermost(meant),
            _ => return false,
        };
        let (head, name) = match (word, open) {
            (Word::Case, Some(Head::Switch)) => (Head::Case, "#case"),
            (Word::Default, Some(Head::Switch)) if self.is(1, Mark::Colon) => (Head::Else, "#else"),
            (Word::Break, Some(Head::Switch | Head::While | Head::For)) => (Head::Break, "#break"),
            _ => return false,
        };
        let span = self.span(0, 0);
        let message = match head {
            Head::Else => "in a `#switch` it is `#else` that takes the rest".to_owned(),
            _ => format!("`{}` needs a `#` before it", word.name()),
        };
        let mut diagnostic = Diagnostic::new(Code::UnknownDirective, message)
            .at(span, "a directive without its `#`")
            .fix(span, name);
        let mut end = 1;
        if head == Head::Case {
            end = match self.closed(1, Bracket::Round) {
                Some(close) => close + 1,
                // `case 0:`
                None if self.is(2, Mark::Colon) => 2,
                None => return false,
            };
        }
        let value = if head == Head::Case { " (…)" } else { "" };
        diagnostic = diagnostic.help(format!("write `{name}{value}`"));
        meant.push(Token { kind: TokenKind::Directive(head), ..self.tokens[self.at] });
        let bare = head == Head::Case && !self.is(1, Mark::Open(Bracket::Round));
        let arguments = &self.tokens[self.at + 1..self.at + end];
        if bare && let [value] = arguments {
            let parenthesis = |mark, at| Token { kind: TokenKind::Mark(mark), start: at, end: at };
            meant.push(parenthesis(Mark::Open(Bracket::Round), value.start));
            meant.push(*value);
            meant.push(parenthesis(Mark::Close(Bracket::Round), value.end));
            let place = self.span(1, 1);
            let text = self.text.get(place.range()).unwrap_or("").to_owned();
            diagnostic = diagnostic.fix(place, format!("({text})"));
        } else {
            meant.extend(arguments);
        }
        // Its colon, or its semicolon.
        let sign = if head == Head::Break { Mark::Semicolon } else { Mark::Colon };
        if self.is(end, sign) {
            diagnostic = diagnostic.fix(self.span(end, end), "");
            end += 1;
        }
        self.diagnostics.push(diagnostic);
        self.at += end;
        true
    }
}
