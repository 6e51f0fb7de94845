//! From text to tree.
//!
//! **In:** a [`Source`]. **Out:** an [`Ast`], always, and what is wrong with the text.
//! **Invariant:** never fails, never panics, and takes time in proportion to the text; a grammar reads
//! the tokens (`grammar/lucarne.pest`), Rust pairs and nests them on explicit stacks.

pub mod ast;
mod balance;
mod comment;
mod directive;
mod expression;
mod nest;
mod numbers;
mod token;

use self::ast::Ast;
use crate::diagnostic::{Code, Diagnostic, Diagnostics};
use crate::scene::Dialect;
use crate::source::{FileId, Source, Span};

/// How a text is read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ParseOptions {
    /// Contextual words exist only in [`Dialect::Scene`].
    pub dialect: Dialect,
    /// How deep brackets, vectors and directives may nest, together.
    pub nesting_limit: usize,
}

impl Default for ParseOptions {
    fn default() -> Self {
        Self { dialect: Dialect::Scene, nesting_limit: 1000 }
    }
}

/// Reads one file's text. What cannot be understood is reported once and stays as
/// [`Missing`](ast::ExpressionKind::Missing) or [`Malformed`](ast::DirectiveKind::Malformed).
pub fn parse(
    source: &Source,
    file: FileId,
    options: &ParseOptions,
    diagnostics: &mut Diagnostics,
) -> Ast {
    let quiet = comment::quiet(&source.text, file, diagnostics);
    let tokens = token::tokens(&quiet.text);
    let tokens = balance::balance(tokens, &quiet.text, source, file, options, diagnostics);
    nest::nest(&source.text, file, &tokens, quiet.comments, options, diagnostics)
}

fn nesting_limit(span: Span, limit: usize) -> Diagnostic {
    let message = format!("brackets are nested more than {limit} deep");
    Diagnostic::new(Code::NestingLimit, message)
        .at(span, "reading stops here")
        .help("`--nesting-limit` raises the limit")
}

/// The candidate nearest to a mistyped word, if one is near.
fn closest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let near = |candidate: &&str| strsim::osa_distance(&word.to_lowercase(), candidate);
    let best = candidates.into_iter().min_by_key(near)?;
    (near(&best) <= 1 + word.len() / 5).then_some(best)
}
pub mod print { pub fn dump(a: &super::ast::Ast, _: &crate::source::Source) -> String { format!("{a:#?}") } }
