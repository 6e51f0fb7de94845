//! Removes branches that a constant condition always skips, if they cannot be parsed.
//!
//! **In:** a text without comments. **Out:** the same text, with blanks in place of each branch that is never
//! run and cannot be parsed; it is then listed as a comment. **Invariant:** a branch that parses without
//! errors stays, and so does one that may be run. POV-Ray 3.7 skips such a branch word by word, whatever it
//! contains (measured).

use std::collections::{HashMap, HashSet};
use std::ops::Range;

use super::blank::blanked;
use super::comment::Quiet;
use super::spelling::is_near_a_directive;
use super::token::{Bracket, Head, Mark, Token, TokenKind, tokens};
use super::{ParseOptions, parse};
use crate::diagnostic::Diagnostics;
use crate::source::{FileId, Source, Span};
use crate::vocabulary::{Word, is_standard_include, standard_include_of};

/// Returns the tokens of the text, if it was searched and nothing in it was replaced.
pub(super) fn blank(quiet: &mut Quiet, file: FileId, options: &ParseOptions) -> Option<Vec<Token>> {
    if !may_skip(&quiet.text) {
        return None;
    }
    let tokens = tokens(&quiet.text);
    let branches = Reader { tokens: &tokens, text: &quiet.text, options }.branches();
    let unreadable = |branch: &Range<usize>| {
        let text = quiet.text.get(branch.clone()).unwrap_or("");
        // `#elif` probably starts a branch of its own.
        let unknown = |token: &Token| {
            let word = text.get(token.start as usize..token.end as usize).unwrap_or("");
            token.kind == TokenKind::Directive(Head::Unknown) && is_near_a_directive(word)
        };
        if super::token::tokens(text).iter().any(unknown) {
            return false;
        }
        let mut told = Diagnostics::new(true);
        // A branch that is skipped inside it would be skipped with it.
        parse(&Source::new("", text.to_owned()), file, &options.inside(), &mut told);
        !told.is_empty()
    };
    // If the other branch cannot be parsed either, brackets that both open may continue after them.
    let skips = |(branch, other): &(Range<usize>, Option<Range<usize>>)| {
        unreadable(branch) && !other.as_ref().is_some_and(&unreadable)
    };
    let branches: Vec<Range<usize>> =
        branches.into_iter().filter(skips).map(|(branch, _)| branch).collect();
    if branches.is_empty() {
        return Some(tokens);
    }
    for branch in &branches {
        quiet.comments.retain(|comment| !branch.contains(&(comment.start as usize)));
        let after = quiet.comments.partition_point(|c| (c.start as usize) < branch.start);
        quiet.comments.insert(after, Span::new(file, branch.start, branch.end));
    }
    quiet.text = blanked(std::mem::take(&mut quiet.text), branches);
    None
}

/// The known value of a name at a position.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Declared {
    Nothing,
    Truth(bool),
    Something,
}

/// The known values of a text's names; only declarations outside all directives count.
struct Known<'a> {
    names: HashMap<&'a str, Declared>,
    /// Names that a loop, a macro or a branch declares.
    moving: HashSet<&'a str>,
    depth: usize,
}

impl<'a> Known<'a> {
    fn of(reader: &Reader<'a>) -> Self {
        let mut known = Self { names: HashMap::new(), moving: HashSet::new(), depth: 0 };
        let includes = (0..reader.tokens.len()).any(|at| {
            reader.tokens[at].kind == TokenKind::Directive(Head::Include)
                && !is_standard_include(reader.slice(at + 1).trim_matches('"'))
        });
        if includes {
            // Another text may declare anything.
            known.depth = usize::MAX / 2;
            return known;
        }
        let mut moving = HashSet::new();
        for (at, token) in reader.tokens.iter().enumerate() {
            known.turn(token);
            let depth = known.depth;
            let target = match token.kind {
                TokenKind::Directive(Head::For) => Some(reader.slice(at + 2)),
                TokenKind::Directive(Head::Declare | Head::Local | Head::Undef | Head::Macro) => {
                    let plain = depth == 0 && token.kind != TokenKind::Directive(Head::Macro);
                    (!plain).then(|| reader.slice(at + 1))
                }
                // `#read (File, A, B)`, `M(A)`: these may assign to the names.
                TokenKind::Name => {
                    let before = at.checked_sub(1).map(|before| reader.tokens[before].kind);
                    let behind = reader.tokens.get(at + 1).map(|behind| behind.kind);
                    let comma = TokenKind::Mark(Mark::Comma);
                    (before == Some(comma) || behind == Some(comma)).then(|| reader.slice(at))
                }
                _ => None,
            };
            moving.extend(target);
        }
        Self { names: HashMap::new(), moving, depth: 0 }
    }

    fn turn(&mut self, token: &Token) {
        match token.kind {
            TokenKind::Directive(head) if head.opens() => self.depth += 1,
            TokenKind::Directive(Head::End) => self.depth = self.depth.saturating_sub(1),
            _ => {}
        }
    }

    /// Updates the known values after a token.
    fn pass(&mut self, reader: &Reader<'a>, at: usize) {
        let token = &reader.tokens[at];
        self.turn(token);
        if self.depth > 0 {
            return;
        }
        let name = reader.slice(at + 1);
        let declared = match token.kind {
            TokenKind::Directive(Head::Undef) => Declared::Nothing,
            TokenKind::Directive(Head::Declare | Head::Local) => {
                let text = reader.slice(at + 3);
                let constant = CONSTANTS.iter().find(|(word, _)| *word == text);
                let ends = reader.is(at + 2, Mark::Equal) && reader.is(at + 4, Mark::Semicolon);
                constant.filter(|_| ends).map_or(Declared::Something, |c| Declared::Truth(c.1))
            }
            _ => return,
        };
        self.names.insert(name, declared);
    }

    fn value(&self, name: &str) -> Option<Declared> {
        self.names.get(name).copied().filter(|_| !self.moving.contains(name))
    }
}

/// Returns whether a text may contain a constant condition.
fn may_skip(text: &str) -> bool {
    text.match_indices('#').any(|(at, _)| {
        let rest = text[at + 1..].trim_start();
        let Some(rest) = rest.strip_prefix("if") else { return false };
        let Some(open) = rest.find('(').filter(|open| *open < 12) else { return false };
        let inside = rest[open + 1..].trim_start().trim_start_matches('!').trim_start();
        let name = inside.trim_start_matches(|c: char| c.is_ascii_alphanumeric() || c == '_');
        rest.starts_with("def")
            || inside.starts_with("defined")
            || name.trim_start().starts_with(')')
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

impl<'a> Reader<'a> {
    fn slice(&self, at: usize) -> &'a str {
        self.tokens
            .get(at)
            .and_then(|token| self.text.get(token.start as usize..token.end as usize))
            .unwrap_or("")
    }

    /// Returns the branches that are never run, each with the one that is run instead; without nested ones,
    /// and without the blanks around them.
    fn branches(&self) -> Vec<(Range<usize>, Option<Range<usize>>)> {
        let unknown = if self.options.alone { self.unknown_names() } else { HashSet::new() };
        let mut known = Known::of(self);
        let ends = self.ends_of_branches();
        let (mut found, mut at) = (Vec::new(), 0);
        while at < self.tokens.len() {
            known.pass(self, at);
            let condition = self.condition(at, &unknown, &known);
            at += 1;
            let Some((condition, first)) = condition else { continue };
            let Some(&end) = ends.get(&(at - 1)) else { continue };
            let is_else = self.tokens[end].kind == TokenKind::Directive(Head::Else);
            let last = if is_else { ends.get(&end).copied() } else { None };
            let (own, other) = ((first, end), last.map(|last| (end + 1, last)));
            let branches = if condition { (other, Some(own)) } else { (Some(own), other) };
            let text = |&(first, end): &(usize, usize)| {
                self.tokens[first].start as usize..self.tokens[end - 1].end as usize
            };
            let whole = |branch: Option<(usize, usize)>| branch.filter(|(first, end)| first < end);
            if let (Some(branch), other) = (whole(branches.0), whole(branches.1)) {
                let end = branch.1;
                found.push((text(&branch), other.as_ref().map(text)));
                // Declarations in between still count.
                (at..end).for_each(|at| known.pass(self, at));
                at = end;
            }
        }
        found
    }

    fn is(&self, at: usize, mark: Mark) -> bool {
        self.tokens.get(at).is_some_and(|token| token.kind == TokenKind::Mark(mark))
    }

    /// Returns whether the condition that begins at `at` holds, if it is constant, and where its branch
    /// begins.
    fn condition(
        &self,
        at: usize,
        unknown: &HashSet<&str>,
        known: &Known,
    ) -> Option<(bool, usize)> {
        let TokenKind::Directive(head) = self.tokens[at].kind else { return None };
        let [open, close] = [Mark::Open(Bracket::Round), Mark::Close(Bracket::Round)];
        let is_known = |name: &str| match known.value(name) {
            Some(value) => Some(value != Declared::Nothing),
            None => unknown.contains(name).then_some(false),
        };
        let (value, end) = match head {
            Head::Ifdef | Head::Ifndef => {
                (is_known(self.slice(at + 2))? == (head == Head::Ifdef), at + 3)
            }
            Head::If => {
                let not = self.is(at + 2, Mark::Not);
                let first = if not { at + 3 } else { at + 2 };
                let constant = || CONSTANTS.iter().find(|(word, _)| *word == self.slice(first));
                let (value, end) = match self.tokens.get(first)?.kind {
                    TokenKind::Word(Word::Defined)
                        if self.is(first + 1, open) && self.is(first + 3, close) =>
                    {
                        (is_known(self.slice(first + 2))?, first + 4)
                    }
                    TokenKind::Name => match known.value(self.slice(first))? {
                        Declared::Truth(truth) => (truth, first + 1),
                        Declared::Nothing | Declared::Something => return None,
                    },
                    _ => (constant()?.1, first + 1),
                };
                (value != not, end)
            }
            _ => return None,
        };
        (self.is(at + 1, open) && self.is(end, close)).then_some((value, end + 1))
    }

    /// Returns the `#else`, `#elseif` or `#end` that ends the first branch of each directive.
    fn ends_of_branches(&self) -> HashMap<usize, usize> {
        let (mut open, mut ends) = (Vec::new(), HashMap::new());
        for (at, token) in self.tokens.iter().enumerate() {
            let TokenKind::Directive(head) = token.kind else { continue };
            match head {
                _ if head.opens() => open.push(at),
                Head::End | Head::Else | Head::Elseif => {
                    if let Some(begun) = open.pop() {
                        ends.insert(begun, at);
                        open.extend((head != Head::End).then_some(at));
                    }
                }
                _ => {}
            }
        }
        ends
    }

    /// Returns names that this text only tests, and that no include may declare.
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
