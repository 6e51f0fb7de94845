//! Formats a text in canonical layout: changes blanks and indentation, and keeps tokens and comments.
//!
//! **In:** a text. **Out:** the same tokens and comments in canonical layout, or the reason why not.
//! **Invariant:** no token or comment is added, dropped or reordered: the result is always compared with the
//! text. Formatting is idempotent.

mod atom;
mod flow;
mod group;
mod rows;
mod space;

use self::atom::Atom;
use super::{ParseOptions, balance, comment, control, parse, skipped, token};
use crate::diagnostic::{Code, Diagnostic, Diagnostics};
use crate::source::{FileId, Source};
use crate::syntax::comment::Quiet;
use crate::syntax::token::{Token, TokenKind};

/// The reason why a text cannot be formatted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unformatted {
    /// It has errors, which were reported.
    Broken,
    /// Its tokens would have changed: a bug.
    Unsafe,
}

/// Returns the text in canonical layout. Its line ends are those of the author's first line.
///
/// ```
/// use lucarne::{diagnostic::Diagnostics, source::{Source, Sources}, syntax::format};
///
/// let mut sources = Sources::default();
/// let file = sources.add(Source::new("a.scene", "sphere{0,1 scale<1,2,1>} // An egg.\n"));
/// let text = format(sources.get(file), file, &Default::default(), &mut Diagnostics::default());
/// assert_eq!(text.unwrap(), "sphere { 0, 1 scale <1, 2, 1> }  // An egg.\n");
/// ```
///
/// # Errors
///
/// See [`Unformatted`].
pub fn format(
    source: &Source,
    file: FileId,
    options: &ParseOptions,
    diagnostics: &mut Diagnostics,
) -> Result<String, Unformatted> {
    let mut found = Diagnostics::new(false);
    // A part that cannot be parsed has no layout, run or not.
    let all = ParseOptions { defers: false, ..*options };
    let ast = parse(source, file, &all, &mut found);
    // Keywords that a `.pov` may write with or without their `#` are parsed differently from how they are
    // written.
    let reads_otherwise =
        |one: &Diagnostic| matches!(one.code, Code::UnknownDirective | Code::UnknownWord);
    let broken = found.has_errors() || found.iter().any(reads_otherwise);
    found.iter().for_each(|diagnostic| diagnostics.push(diagnostic.clone()));
    if broken {
        return Err(Unformatted::Broken);
    }
    let (quiet, tokens) = tokens(&source.text, file, options);
    let quiet = &quiet.text;
    let (tokens, _) = balance::balance(tokens, &source.text, file, options, &mut found);
    let mut atoms = atom::atoms(source, quiet, &tokens, &ast);
    let groups = group::Groups::of(&mut atoms);
    let end = end_of_line(&source.text, &atoms);
    let formatted = rows::write(&flow::rows(&atoms, &groups, end), end);
    match same_but_blanks(&source.text, &formatted, options) {
        true => Ok(formatted),
        false => Err(Unformatted::Unsafe),
    }
}

fn tokens<'a>(text: &'a str, file: FileId, options: &ParseOptions) -> (Quiet<'a>, Vec<Token>) {
    let mut unheard = Diagnostics::new(false);
    let mut quiet = comment::quiet(text, file, &mut unheard);
    skipped::blank(&mut quiet, file, options);
    quiet.text = control::blank(quiet.text, file, &mut unheard);
    let tokens = token::tokens(&quiet.text);
    (quiet, tokens)
}

/// Returns the first line end; those in strings and comments do not count.
fn end_of_line(text: &str, atoms: &[Atom]) -> &'static str {
    let behind = &text[text.trim_end().len()..];
    let first = atoms.iter().find(|atom| atom.lines > 0);
    match first.map_or(behind.contains("\r\n"), |atom| atom.wide) {
        true => "\r\n",
        false => "\n",
    }
}

/// Returns whether two texts have the same tokens and comments in the same order.
fn same_but_blanks(one: &str, other: &str, options: &ParseOptions) -> bool {
    pieces(one, options) == pieces(other, options)
}

/// Returns each token and each comment of a text.
fn pieces(text: &str, options: &ParseOptions) -> Vec<String> {
    let (quiet, tokens) = tokens(text, FileId(0), options);
    let mut pieces = Vec::with_capacity(tokens.len());
    let mut comments = quiet.comments.iter().peekable();
    let mut comment = |pieces: &mut Vec<String>, up_to: u32| {
        while let Some(comment) = comments.next_if(|comment| comment.start < up_to) {
            let text = text.get(comment.range()).unwrap_or("");
            // Its lines may be moved.
            let lines = text.split(['\n', '\r']).map(str::trim).filter(|line| !line.is_empty());
            pieces.push(lines.collect::<Vec<_>>().join("\n"));
        }
    };
    for token in tokens.into_iter().flat_map(|token| atom::parts(token, &quiet.text)) {
        comment(&mut pieces, token.start);
        let text = quiet.text.get(token.start as usize..token.end as usize).unwrap_or("");
        pieces.push(match token.kind {
            // Blanks may follow its `#`.
            TokenKind::Directive(head) => format!("#{}", head.word()),
            _ => text.to_owned(),
        });
    }
    comment(&mut pieces, u32::MAX);
    pieces
}

#[cfg(test)]
mod tests;
