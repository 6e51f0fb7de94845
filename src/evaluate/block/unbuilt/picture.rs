//! The block of `image_map` and the like, which are unsupported.

use crate::diagnostic::{Code, Diagnostic, suggest};
use crate::source::FileError;
use crate::syntax::ast::ExpressionId;
use crate::vocabulary::{Family, Word};

use super::super::super::Evaluator;
use super::super::super::include::missing_file;
use super::super::super::stream::{Token, TokenKind};
use super::super::named::is_of_picture;

/// Extensions that an image's name may omit.
const ENDINGS: &[&str] =
    &[".png", ".jpg", ".jpeg", ".gif", ".tga", ".ppm", ".pgm", ".tiff", ".hdr"];

impl Evaluator<'_> {
    /// Checks that the file in `image_map { png "file" … }` exists.
    pub(super) fn picture_not_built(&mut self) {
        while let Some(token) = self.next() {
            match token.kind {
                TokenKind::Word(word) if word.family() == Family::FileKind => {
                    self.picture_of(&token);
                }
                TokenKind::Expression(id) => {
                    if !self.misspelt_kind(&token, id)
                        && !self.misspelt_item(&token, id, Word::ImageMap)
                    {
                        self.run_expression(&token.here, id);
                    }
                }
                TokenKind::Word(word) if self.modifier_not_built(&token, word) => {}
                TokenKind::Word(word) => self.skip_arguments(word),
                TokenKind::Block(contents) => {
                    self.inside_block(&token.here, contents, token.span, Self::run_items);
                }
                TokenKind::Entry(items) => self.inside(&token.here, items, Self::run_items),
                TokenKind::Comma | TokenKind::Semicolon | TokenKind::Literal(_) => {}
            }
        }
    }

    /// Reports another tool's name for an image type: `jpg "file"`.
    fn misspelt_kind(&mut self, token: &Token, id: ExpressionId) -> bool {
        if self.unknown_name(&token.here, id).is_none() {
            return false;
        }
        let name = self.sources.text(token.span).to_owned();
        let kinds = || {
            let kinds = Word::ALL.iter().filter(|word| word.family() == Family::FileKind);
            kinds.map(|word| word.name())
        };
        let near = suggest::foreign(&name)
            .find(|ours| kinds().any(|kind| kind == *ours))
            .or_else(|| suggest::closest(&name, kinds()));
        let Some(near) = near else { return false };
        let message = format!("`{name}` is not a kind of picture");
        let diagnostic = Diagnostic::new(Code::UnknownWord, message)
            .at(token.span, format!("did you mean `{near}`?"))
            .help(format!("replace it with `{near}`"))
            .fix(token.span, near);
        self.report(&token.here, diagnostic);
        self.skip_values();
        true
    }

    fn picture_of(&mut self, token: &Token) {
        if !matches!(self.peek().map(|next| &next.kind), Some(TokenKind::Expression(_))) {
            return;
        }
        let Ok(file) = self.named_file(token, "the name of a picture's file") else { return };
        if let Err(error @ FileError::NotFound { .. }) = self.read_named(&file, ENDINGS) {
            let diagnostic = missing_file(&file.name, file.span, error, is_of_picture);
            self.report(&file.here, diagnostic);
        }
    }
}
