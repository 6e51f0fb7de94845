//! Words of the language that a text takes for names of its own: `#declare count = 0;`, `#if (count < 10)`.
//!
//! **Invariant:** where such a word has a meaning of its own it is left alone.

use super::Reader;
use crate::diagnostic::{Code, Diagnostic, Fix};
use crate::syntax::token::{Bracket, Head, Mark, Token, TokenKind};
use crate::vocabulary::{Role, Word};

impl Reader<'_> {
    /// `#declare count = 0;`, `#for (count, …)`: the words of the language that the text takes for names.
    pub(super) fn find_reserved(&mut self) {
        for at in 0..self.tokens.len() {
            self.at = at;
            let named = match self.kind(0) {
                Some(TokenKind::Directive(Head::Declare | Head::Local)) => {
                    Some(1).filter(|_| self.is(2, Mark::Equal))
                }
                Some(TokenKind::Directive(Head::For)) => Some(2)
                    .filter(|_| self.is(1, Mark::Open(Bracket::Round)) && self.is(3, Mark::Comma)),
                _ => None,
            };
            let Some(named) = named else { continue };
            let Some(TokenKind::Word(word)) = self.kind(named) else { continue };
            if !matches!(word.role(), Role::Statement) {
                continue;
            }
            let (span, name) = (self.span(named, named), word.name());
            let mut capital = name.to_owned();
            if let Some(first) = capital.get_mut(..1) {
                first.make_ascii_uppercase();
            }
            let told =
                Diagnostic::new(Code::ReservedName, format!("`{name}` is a word of the language"))
                    .at(span, "it cannot be declared")
                    .help(format!("names that start with a capital are always free: `{capital}`"));
            self.reserved.entry(name).or_insert((told, capital));
        }
        self.at = 0;
    }

    /// A word of the language that is declared as a name, where a name would stand; or one that is compared.
    pub(super) fn reserved(&mut self, word: Word, meant: &mut Vec<Token>) -> bool {
        if word.role() != Role::Statement || !self.stands_for_a_value(meant) {
            return false;
        }
        let span = self.span(0, 0);
        let capital = self.reserved.get(word.name()).map(|(_, capital)| capital.clone());
        match capital {
            Some(capital) if self.declares_anywhere(&capital) => {}
            Some(capital) => {
                if let Some((told, _)) = self.reserved.get_mut(word.name()) {
                    told.fixes.push(Fix { span, text: capital });
                }
            }
            None if self.is_compared(meant) => {}
            None => return false,
        }
        meant.push(Token { kind: TokenKind::Name, ..self.tokens[self.at] });
        self.at += 1;
        true
    }

    fn stands_for_a_value(&self, meant: &[Token]) -> bool {
        let in_parentheses = self.inside.last().is_some_and(|inside| inside.is(Bracket::Round));
        let Some(last) = meant.last().map(|last| last.kind) else { return false };
        if let TokenKind::Directive(Head::Declare | Head::Local) = last {
            return self.is(1, Mark::Equal);
        }
        let Some(TokenKind::Mark(next)) = self.kind(1) else { return false };
        let operates = |mark| {
            use Mark as M;
            matches!(mark, M::Plus | M::Star | M::Slash | M::Equal | M::NotEqual | M::And | M::Or)
        };
        let compares = |mark| {
            use Mark as M;
            matches!(mark, M::Less | M::LessOrEqual | M::Greater | M::GreaterOrEqual | M::Minus)
        };
        match last {
            TokenKind::Mark(Mark::Close(_) | Mark::Semicolon | Mark::Colon | Mark::Dot) => false,
            TokenKind::Mark(Mark::Open(Bracket::Brace)) => {
                operates(next) || next == Mark::Close(Bracket::Brace)
            }
            TokenKind::Mark(_) => {
                operates(next)
                    || in_parentheses && compares(next)
                    || next == Mark::Greater
                    || next == Mark::Comma
                    || next == Mark::Semicolon
                    || matches!(next, Mark::Close(_))
            }
            // `rotate count*y`
            TokenKind::Word(_) => operates(next) && next != Mark::Equal,
            _ => false,
        }
    }

    /// `(count < 10)`, or an end of `#for (I, 1, count)`.
    fn is_compared(&self, meant: &[Token]) -> bool {
        use Mark as M;
        let compares = |kind| {
            matches!(
                kind,
                Some(TokenKind::Mark(
                    M::Less
                        | M::LessOrEqual
                        | M::Greater
                        | M::GreaterOrEqual
                        | M::Equal
                        | M::NotEqual
                ))
            )
        };
        if !self.inside.last().is_some_and(|inside| inside.is(Bracket::Round)) {
            return false;
        }
        let opener =
            meant.iter().rposition(|token| token.kind == TokenKind::Mark(M::Open(Bracket::Round)));
        let head = opener.and_then(|at| at.checked_sub(1)).map(|at| meant[at].kind);
        let ends_a_loop = head == Some(TokenKind::Directive(Head::For))
            && matches!(self.kind(1), Some(TokenKind::Mark(M::Comma | M::Close(Bracket::Round))));
        ends_a_loop
            || matches!(
                head,
                Some(TokenKind::Directive(Head::If | Head::Elseif | Head::While | Head::Case))
            ) && (compares(self.kind(1)) || compares(meant.last().map(|last| last.kind)))
    }
}
