//! Parses, prints and formats texts of the scene language.
//!
//! **In:** a [`Source`]. **Out:** an [`Ast`], always, and diagnostics. **Invariant:** never fails, never
//! panics, and takes linear time; a grammar reads the tokens (`grammar/lucarne.pest`), Rust code pairs and
//! nests them on explicit stacks.

mod around;
// Variants and fields are the words of the language.
#[allow(missing_docs)]
pub mod ast;
mod balance;
mod blank;
mod bracket;
mod colon;
mod comment;
mod compact;
mod control;
mod directive;
mod dump;
mod entity;
mod expression;
mod foreign;
mod format;
mod habits;
mod head;
mod layout;
mod leftover;
mod legacy;
mod list;
mod listing;
mod literal;
mod loose;
mod mark;
mod nest;
mod numbers;
mod numeric;
mod old_words;
mod operand;
mod paths;
mod print;
mod prose;
mod repair;
mod skipped;
mod spelling;
mod stray;
mod tally;
mod target;
mod token;
mod unread;

pub use self::dump::dump;
pub use self::format::{Unformatted, format};
pub use self::legacy::legacy;
pub(crate) use self::paths::{Ways, alone};
pub use self::print::print;

use std::ops::Range;

use self::ast::Ast;
use crate::diagnostic::{Code, Diagnostic, Diagnostics};
use crate::source::{FileId, Source, Span};
use crate::vocabulary::Dialect;

/// Options of [`parse`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ParseOptions {
    /// Contextual keywords exist only in [`Dialect::Scene`].
    pub dialect: Dialect,
    /// The limit of nesting depth for brackets, vectors and directives together.
    pub nesting_limit: usize,
    /// No name comes from outside the text, except from its includes.
    pub alone: bool,
    /// Branches that are never run are ignored if they cannot be parsed.
    pub skips: bool,
    /// In a `.pov`, bodies that cannot be parsed stay text until they are run.
    pub defers: bool,
    /// Every brace without a partner in its own text is paired when it is run.
    pub loose: bool,
}

impl Default for ParseOptions {
    fn default() -> Self {
        Self {
            dialect: Dialect::Scene,
            nesting_limit: 1000,
            alone: false,
            skips: true,
            defers: true,
            loose: false,
        }
    }
}

impl ParseOptions {
    /// Returns the options for parsing a piece only to find its errors.
    fn inside(&self) -> Self {
        Self { skips: false, defers: false, ..*self }
    }
}

/// Parses one file's text. A part that cannot be parsed is reported once and becomes
/// [`Missing`](ast::ExpressionKind::Missing) or [`Malformed`](ast::DirectiveKind::Malformed).
///
/// ```
/// use lucarne::diagnostic::{Code, Diagnostics};
/// use lucarne::{source::{Source, Sources}, syntax::{ParseOptions, parse, print}};
///
/// let mut sources = Sources::default();
/// let file = sources.add(Source::new("a.scene", "sphere { 0, 1 // Never closed."));
/// let mut diagnostics = Diagnostics::default();
/// let ast = parse(sources.get(file), file, &ParseOptions::default(), &mut diagnostics);
/// assert_eq!(sources.text(ast.comments[0]), "// Never closed.");
/// assert_eq!(print(&ast, sources.get(file)), "sphere\n{\n  0,\n  1\n}");
/// assert_eq!(diagnostics.iter().next().unwrap().code, Code::UnclosedBlock);
/// ```
pub fn parse(
    source: &Source,
    file: FileId,
    options: &ParseOptions,
    diagnostics: &mut Diagnostics,
) -> Ast {
    if let Some(told) = foreign::foreign(&source.text, file) {
        diagnostics.push(told);
        // No error in it is independent.
        let mut nothing = Diagnostics::new(true);
        let quiet = comment::quiet("", file, &mut nothing);
        return nest::nest(&quiet, 0, file, &[], true, options, &mut nothing);
    }
    let (mut ast, mut found) = read(source, file, options, &[]);
    if found.has_errors() && unread::is_asked_for(options) {
        let quiet = comment::quiet(&source.text, file, &mut Diagnostics::new(true));
        let rest = |unread: &[Range<usize>]| read(source, file, options, unread).1;
        if let Some(unread) = unread::bodies_around_mistakes(&quiet.text, &found, rest) {
            (ast, found) = read(source, file, options, &unread);
        }
    }
    found.iter().for_each(|told| diagnostics.push(told.clone()));
    ast
}

/// Parses a text without the bodies that stay text.
fn read(
    source: &Source,
    file: FileId,
    options: &ParseOptions,
    unread: &[Range<usize>],
) -> (Ast, Diagnostics) {
    let mut found = Diagnostics::new(true);
    let mut quiet = comment::quiet(&source.text, file, &mut found);
    let known = match options.skips {
        true => skipped::blank(&mut quiet, file, options),
        false => None,
    };
    let told = found.len();
    unread::leave_out(&mut quiet, unread);
    quiet.text = control::blank(quiet.text, file, &mut found);
    quiet.text = entity::translate(quiet.text, file, &mut found);
    quiet.text = leftover::blank(quiet.text, file, &mut found);
    quiet.text = listing::blank(quiet.text, file, &mut found);
    quiet.text = prose::blank(quiet.text, file, &mut found);
    // What was replaced since was reported.
    let known = known.filter(|_| found.len() == told);
    let joined = match unread {
        [] => {
            let tokens = known.unwrap_or_else(|| token::tokens(&quiet.text));
            compact::parse(tokens, &quiet, &source.text, file, options)
        }
        _ => None,
    };
    let ast = joined
        .unwrap_or_else(|| token_by_token(&quiet, &source.text, file, options, unread, &mut found));
    // Each pass found its own errors; they are reported in source order.
    let mut found: Vec<_> = found.iter().cloned().collect();
    found.sort_by_key(|diagnostic| diagnostic.primary().map(|label| label.span.start));
    comment::drop_swallowed(&mut found, &source.text);
    let found = tally::tally(found, &source.text);
    // A quote added after the end is not a position in the author's text.
    let end = source.text.len() as u32;
    let mut diagnostics = Diagnostics::new(true);
    let within = |span: Span| Span { start: span.start.min(end), end: span.end.min(end), ..span };
    for mut diagnostic in found {
        diagnostic.labels.iter_mut().for_each(|label| label.span = within(label.span));
        diagnostic.fixes.iter_mut().for_each(|fix| fix.span = within(fix.span));
        diagnostics.push(diagnostic);
    }
    (ast, diagnostics)
}

/// Returns the tree of the tokens that the grammar finds.
fn token_by_token(
    quiet: &comment::Quiet,
    source: &str,
    file: FileId,
    options: &ParseOptions,
    unread: &[Range<usize>],
    found: &mut Diagnostics,
) -> Ast {
    let mut tokens = token::tokens(&quiet.text);
    unread::stand_in(&mut tokens, unread);
    old_words::replace(&mut tokens, file, options.dialect, found);
    spelling::correct_heads(&mut tokens, &quiet.text, file, options.dialect, found);
    let tokens = habits::translate(tokens, &quiet.text, file, options.dialect, found);
    let (tokens, cut) = balance::balance(tokens, source, file, options, found);
    nest::nest(quiet, source.len(), file, &tokens, cut, options, found)
}

/// Returns a diagnostic; `what` is nested: "brackets", "directives", "signs".
fn nesting_limit(span: Span, what: &str, limit: usize) -> Diagnostic {
    let message = format!("{what} are nested more than {limit} deep");
    Diagnostic::new(Code::NestingLimit, message)
        .at(span, "reading stops here")
        .help("`--limit nesting=N` raises the limit")
}

#[cfg(test)]
mod tests;
