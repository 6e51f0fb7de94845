//! Truncates quotations of the author's text in messages to a readable length.
//!
//! **Invariant:** lucarne's own sentences are unchanged, and so is the output of `#debug` and its variants.

use std::borrow::Cow;

use super::{Code, Diagnostic};

/// Maximum number of characters in a quotation, or in text without blanks.
const LONGEST: usize = 120;
/// Number of characters kept from a longer one.
const BEGINNING: usize = 60;
const END: usize = 40;

impl Diagnostic {
    /// Truncates quotations in the sentences of the message; the text of a fix is unchanged.
    pub(super) fn shorten(&mut self) {
        if self.is_the_authors() {
            return;
        }
        let labels = self.labels.iter_mut().map(|label| &mut label.text);
        let steps = self.trace.iter_mut().map(|step| &mut step.text);
        let sentences = labels.chain(steps).chain(&mut self.help);
        for text in sentences.chain([&mut self.message]) {
            if text.len() > LONGEST {
                *text = shortened(text);
            }
        }
    }

    /// Returns the message as truncated by [`Self::shorten`].
    pub(super) fn short_message(&self) -> Cow<'_, str> {
        match self.message.len() > LONGEST && !self.is_the_authors() {
            true => Cow::Owned(shortened(&self.message)),
            false => Cow::Borrowed(&self.message),
        }
    }

    fn is_the_authors(&self) -> bool {
        matches!(self.code, Code::AuthorDebug | Code::AuthorWarning | Code::AuthorError)
    }
}

fn shortened(text: &str) -> String {
    // What stands between two backticks is quoted whole.
    let pieces: Vec<&str> = text.split('`').collect();
    let paired = pieces.len() % 2 == 1;
    let pieces = pieces.iter().enumerate().map(|(i, piece)| match paired && i % 2 == 1 {
        true => cut(piece),
        false => piece.split_inclusive(' ').map(cut).collect(),
    });
    pieces.collect::<Vec<_>>().join("`")
}

fn cut(piece: &str) -> String {
    let count = piece.chars().count();
    if count <= LONGEST {
        return piece.to_owned();
    }
    let beginning = piece.chars().take(BEGINNING);
    let end = piece.chars().skip(count - END);
    beginning.chain(['…']).chain(end).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_word_is_cut_wherever_it_is_quoted() {
        let word = "é".repeat(5000);
        let mut told =
            Diagnostic::new(Code::UnknownWord, format!("`{word}` is not a word of {word}, really"));
        told.help.push(format!("did you mean `{word}s`?"));
        told.shorten();
        let short = format!("{}…{}", "é".repeat(60), "é".repeat(40));
        let bare = format!("{}…{}, ", "é".repeat(60), "é".repeat(38));
        assert_eq!(told.message, format!("`{short}` is not a word of {bare}really"));
        assert!(told.help[0].chars().count() < 130);
    }

    #[test]
    fn sentences_and_what_the_author_says_stay_whole() {
        let sentence = "a sentence of many words says what it has to say ".repeat(9);
        for (code, text) in [(Code::UnknownWord, sentence), (Code::AuthorDebug, "x".repeat(999))] {
            let mut told = Diagnostic::new(code, text.clone());
            told.shorten();
            assert_eq!(told.message, text);
        }
    }
}
