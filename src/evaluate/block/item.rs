//! The parts of a shape that stand in any order, each behind its word.

use crate::diagnostic::{Code, Diagnostic, suggest};
use crate::vocabulary::Word;

use super::super::Evaluator;
use super::super::stream::{Token, TokenKind};
use super::Place;

impl Evaluator<'_> {
    /// The next part of `shape`: one of `words`, or a name that is none, where one of these was meant; that is told.
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
                    let name = self.sources.text(token.span).to_owned();
                    let names = || words.iter().map(|word| word.name());
                    let near = suggest::closest(&name, names()).or_else(|| {
                        suggest::foreign(&name).find(|ours| names().any(|name| name == *ours))
                    });
                    self.next();
                    let Some(near) = near else {
                        // What follows are its parts as before.
                        self.unexpected(&token, Place::shape(shape));
                        continue;
                    };
                    let word = Word::from_name(near)?;
                    let message = format!("`{name}` is not a word in `{}`", shape.name());
                    let diagnostic = Diagnostic::new(Code::UnknownWord, message)
                        .at(token.span, format!("did you mean `{near}`?"))
                        .help(format!("replace it with `{near}`"))
                        .fix(token.span, near);
                    self.report(&token.here, diagnostic);
                    return Some((Token { kind: TokenKind::Word(word), ..token }, word));
                }
                _ => return None,
            }
        }
    }
}
