use super::ParseOptions;
use super::token::Token;
use crate::diagnostic::Diagnostics;
use crate::source::{FileId, Source};
pub(super) fn balance(
    tokens: Vec<Token>,
    _: &str,
    _: &Source,
    _: FileId,
    _: &ParseOptions,
    _: &mut Diagnostics,
) -> Vec<Token> {
    tokens
}
