//! What a condition skips whatever happens: where that cannot be read, it is a comment.
//!
//! **In:** a text without comments. **Out:** the same text, with blanks in place of each branch that is never
//! run and could not be, which is among the comments then.
//! **Invariant:** a branch that reads without mistakes stays, and so does one that may be run. POV-Ray 3.7
//! skips such a branch word by word, whatever stands there (measured).

use std::borrow::Cow;
use std::collections::HashSet;
use std::ops::Range;

use super::comment::Quiet;
use super::token::{Bracket, Head, Mark, Token, TokenKind, tokens};
use super::{ParseOptions, parse};
use crate::diagnostic::Diagnostics;
use crate::source::{FileId, Source, Span};
use crate::vocabulary::{is_standard_include, standard_include_of};

pub(super) fn blank(quiet: &mut Quiet, file: FileId, options: &ParseOptions) {
    if !may_skip(&quiet.text) {
        return;
    }
    let tokens = tokens(&quiet.text);
    let branches = Reader { tokens: &tokens, text: &quiet.text, options }.branches();
    let unreadable = |branch: &Range<usize>| {
        let text = quiet.text.get(branch.clone()).unwrap_or("");
        // `#elif` is rather a branch of its own.
        let unknown = |token: &Token| token.kind == TokenKind::Directive(Head::Unknown);
        if super::token::tokens(text).iter().any(unknown) {
            return false;
        }
        let mut told = Diagnostics::new(true);
        // What is skipped in it would be with it.
        parse(&Source::new("", text.to_owned()), file, &options.inside(), &mut told);
        !told.is_empty()
    };
    let branches: Vec<Range<usize>> = branches.into_iter().filter(unreadable).collect();
    if branches.is_empty() {
        return;
    }
    let mut bytes = std::mem::take(&mut quiet.text).into_owned().into_bytes();
    for branch in branches {
        quiet.comments.retain(|comment| !branch.contains(&(comment.start as usize)));
        let after = quiet.comments.partition_point(|c| (c.start as usize) < branch.start);
        quiet.comments.insert(after, Span::new(file, branch.start, branch.end));
        for byte in bytes[branch].iter_mut().filter(|byte| !matches!(**byte, b'\n' | b'\r')) {
            // Each byte of a character becomes one blank: still UTF-8.
            *byte = b' ';
        }
    }
    quiet.text = Cow::Owned(String::from_utf8(bytes).unwrap_or_default());
}

/// Whether a text may hold a condition that is plain.
fn may_skip(text: &str) -> bool {
    text.match_indices('#').any(|(at, _)| {
        let rest = text[at + 1..].trim_start();
        let Some(rest) = rest.strip_prefix("if") else { return false };
        let Some(open) = rest.find('(').filter(|open| *open < 12) else { return false };
        let inside = rest[open + 1..].trim_start();
        rest.starts_with("def") || CONSTANTS.iter().any(|(word, _)| inside.starts_with(word))
    })
}

const CONSTANTS: &[(&str, bool)] = &[
    ("0", false),
    ("false", false),
    ("no", false),
    ("off", false),
    ("1", true),
    ("true", true),
    ("yes", true),
    ("on", true),
];

struct Reader<'a> {
    tokens: &'a [Token],
    text: &'a str,
    options: &'a ParseOptions,
}

impl Reader<'_> {
    fn slice(&self, at: usize) -> &str {
        self.tokens
            .get(at)
            .and_then(|token| self.text.get(token.start as usize..token.end as usize))
            .unwrap_or("")
    }

    /// The branches that are never run, without those inside others, and without the blanks around them.
    fn branches(&self) -> Vec<Range<usize>> {
        let unknown = if self.options.alone { self.unknown_names() } else { HashSet::new() };
        let (mut found, mut at) = (Vec::new(), 0);
        while at < self.tokens.len() {
            let condition = match self.tokens[at].kind {
                TokenKind::Directive(Head::If) => {
                    CONSTANTS.iter().find(|(word, _)| *word == self.slice(at + 2)).map(|c| c.1)
                }
                TokenKind::Directive(Head::Ifdef) => {
                    unknown.contains(self.slice(at + 2)).then_some(false)
                }
                _ => None,
            };
            let is = |at: usize, mark| {
                self.tokens.get(at).is_some_and(|token| token.kind == TokenKind::Mark(mark))
            };
            let plain =
                is(at + 1, Mark::Open(Bracket::Round)) && is(at + 3, Mark::Close(Bracket::Round));
            at += 1;
            let (Some(condition), true) = (condition, plain) else { continue };
            let (first, Some(end)) = (at + 3, self.end_of_branch(at + 3)) else { continue };
            let branch = match (condition, self.tokens[end].kind) {
                (false, _) => Some((first, end)),
                (true, TokenKind::Directive(Head::Else)) => {
                    self.end_of_branch(end + 1).map(|last| (end + 1, last))
                }
                (true, _) => None,
            };
            if let Some((first, end)) = branch.filter(|(first, end)| first < end) {
                found.push(self.tokens[first].start as usize..self.tokens[end - 1].end as usize);
                at = end;
            }
        }
        found
    }

    /// The `#else`, `#elseif` or `#end` that a branch which begins at `at` ends with.
    fn end_of_branch(&self, at: usize) -> Option<usize> {
        let mut depth = 0_usize;
        let ends = |token: &Token| {
            let TokenKind::Directive(head) = token.kind else { return false };
            match head {
                _ if head.opens() => depth += 1,
                Head::End if depth > 0 => depth -= 1,
                Head::End | Head::Else | Head::Elseif => return depth == 0,
                _ => {}
            }
            false
        };
        self.tokens.get(at..)?.iter().position(ends).map(|behind| at + behind)
    }

    /// Names that this text only asks for, and that nothing it includes may declare.
    fn unknown_names(&self) -> HashSet<&str> {
        let (mut asked, mut used) = (HashSet::new(), HashSet::new());
        for (at, token) in self.tokens.iter().enumerate() {
            match token.kind {
                TokenKind::Directive(Head::Include) => {
                    let name = self.slice(at + 1).trim_matches('"');
                    if !is_standard_include(name) {
                        return HashSet::new();
                    }
                }
                TokenKind::Name => {
                    let asks = at.checked_sub(2).is_some_and(|head| {
                        matches!(
                            self.tokens[head].kind,
                            TokenKind::Directive(Head::Ifdef | Head::Ifndef)
                        )
                    });
                    let name = self.slice(at);
                    if asks {
                        asked.insert(name)
                    } else {
                        used.insert(name)
                    };
                }
                _ => {}
            }
        }
        asked.retain(|name| !used.contains(name) && standard_include_of(name).is_none());
        asked
    }
}
