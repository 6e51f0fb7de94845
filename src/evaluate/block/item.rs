//! Parts of a shape that appear in any order, each after its keyword.

use crate::diagnostic::{Code, Diagnostic, suggest};
use crate::vocabulary::Word;

use super::super::Evaluator;
use super::super::stream::{Token, TokenKind};
use super::Place;

impl Evaluator<'_> {
    /// Takes and reports an undeclared name where one of `words` was meant.
    pub(super) fn misspelt_part(&mut self, shape: Word, words: &[Word]) -> Option<Word> {
        let token = self.peek()?.clone();
        let TokenKind::Expression(id) = token.kind else { return None };
        self.unknown_name(&token.here, id)?;
        let name = self.sources.text(token.span).to_owned();
        let near = near(&name, words)?;
        self.next();
        let message = format!("`{name}` is not a word in `{}`", shape.name());
        let diagnostic = Diagnostic::new(Code::UnknownWord, message)
            .at(token.span, format!("did you mean `{}`?", near.name()))
            .help(format!("replace it with `{}`", near.name()))
            .fix(token.span, near.name());
        self.report(&token.here, diagnostic);
        Some(near)
    }

    /// Returns the next part of `shape`: one of `words`, or an undeclared name where one of these was meant,
    /// which is reported.
    pub(super) fn next_part(&mut self, shape: Word, words: &[Word]) -> Option<(Token, Word)> {
        loop {
            self.skip_commas();
            match self.peek()?.kind {
                TokenKind::Word(word) if words.contains(&word) => {
                    return Some((self.next()?, word));
                }
                TokenKind::Expression(id) => {
                    let token = self.peek()?.clone();
                    self.unknown_name(&token.here, id)?;
                    if let Some(word) = self.misspelt_part(shape, words) {
                        return Some((Token { kind: TokenKind::Word(word), ..token }, word));
                    }
                    // The following items are read as its parts.
                    self.next();
                    self.unexpected(&token, Place::shape(shape));
                }
                _ => return None,
            }
        }
    }
}

/// Returns the one of `words` that a name resembles.
fn near(name: &str, words: &[Word]) -> Option<Word> {
    let names = || words.iter().map(|word| word.name());
    let foreign = || suggest::foreign(name).find(|ours| names().any(|name| name == *ours));
    suggest::closest(name, names()).or_else(foreign).and_then(Word::from_name)
}
