//! Reports which brackets and `#end`s are missing or surplus, and corrects them.
//!
//! **In:** tokens that do not pair. **Out:** tokens that do. **Invariant:** one diagnostic for one mistake:
//! tokens that a repair makes surplus elsewhere are dropped silently. Takes at most time proportional to the
//! number of tokens times the nesting limit.

use std::collections::{HashMap, HashSet};

mod angle;
mod blame;
mod early_closer;
mod ends;
mod opener;
mod outside;
mod owed;

use self::early_closer::close_later;
use self::ends::match_directives;
use self::opener::{open_missing, open_objects};
use self::outside::Outside;
use super::balance::{Opener, Turn, turn};
use super::layout::Layout;
use super::token::{Bracket, Head, Mark, Token, TokenKind};
use crate::diagnostic::{Code, Diagnostic, Diagnostics};
use crate::source::FileId;

/// The most tokens of a vector of plain values.
const LONGEST_VECTOR: usize = 12;

/// Adds and drops closers until everything pairs.
pub(super) fn repair(
    tokens: Vec<Token>,
    text: &str,
    file: FileId,
    diagnostics: &mut Diagnostics,
) -> Vec<Token> {
    let braces = |tokens: &[Token]| surplus(tokens)[Bracket::Brace as usize];
    let tokens = match braces(&tokens) < 0 {
        true => {
            let tokens = open_objects(tokens, text, file, diagnostics);
            let tokens = close_later(tokens, text, file, diagnostics);
            open_missing(tokens, file, diagnostics)
        }
        false => tokens,
    };
    let layout = Layout::of(&tokens, text);
    let openers = match_directives(&tokens, &layout);
    let ended = openers.values().copied().collect();
    let repair = Repair {
        tokens: &tokens,
        text,
        file,
        layout,
        openers,
        ended,
        surplus: surplus(&tokens),
        owed: [0; 3],
        owed_since: [0; 3],
        open: Vec::new(),
        inserted: Vec::new(),
        dropped: vec![false; tokens.len()],
        told: 0,
        diagnostics,
    };
    repair.run()
}

/// Returns openers minus closers, for each bracket.
fn surplus(tokens: &[Token]) -> [i32; 3] {
    let mut surplus = [0; 3];
    for token in tokens {
        match turn(token.kind) {
            Some(Turn::Open(Opener::Bracket(bracket))) => surplus[bracket as usize] += 1,
            Some(Turn::Close(Opener::Bracket(bracket))) => surplus[bracket as usize] -= 1,
            Some(_) | None => {}
        }
    }
    surplus
}

struct Open {
    opener: Opener,
    token: usize,
    /// The indentation of its line, and of the first line inside.
    indent: u32,
    inner: Option<u32>,
    /// The position where it seems to have ended.
    outside: Option<Outside>,
    /// Its closer is in a branch; it is closed where the directive of that branch ends.
    closed_in_branch: bool,
    /// For a directive: it was reported that a branch does not pair.
    told: bool,
}

struct Repair<'a> {
    tokens: &'a [Token],
    text: &'a str,
    file: FileId,
    layout: Layout,
    /// The directive that each `#end` ends.
    openers: HashMap<usize, usize>,
    /// The directives that have an `#end`.
    ended: HashSet<usize>,
    /// Openers minus closers, for each bracket, as far as they are not explained yet.
    surplus: [i32; 3],
    /// Closers that were added although their own may still follow.
    owed: [u32; 3],
    /// The position where the last of them was added.
    owed_since: [usize; 3],
    open: Vec<Open>,
    /// Closers to insert before the token with this index.
    inserted: Vec<(usize, TokenKind)>,
    dropped: Vec<bool>,
    told: usize,
    diagnostics: &'a mut Diagnostics,
}

impl Repair<'_> {
    fn run(mut self) -> Vec<Token> {
        for at in 0..self.tokens.len() {
            self.look_for_outside(at);
            match turn(self.tokens[at].kind) {
                None => {}
                Some(Turn::Open(opener)) => self.open.push(Open {
                    opener,
                    token: at,
                    indent: self.layout.place(at).indent,
                    inner: None,
                    outside: None,
                    closed_in_branch: false,
                    told: false,
                }),
                Some(Turn::Close(Opener::Bracket(bracket))) => self.close(bracket, at),
                Some(Turn::Close(Opener::Directive)) => self.end(at),
                Some(Turn::Divide) => self.divide(at),
            }
        }
        let end = self.tokens.len();
        self.cut_off(end);
        while let Some(open) = self.open.pop() {
            self.never_closed(open, end);
        }
        self.finish()
    }

    fn finish(mut self) -> Vec<Token> {
        self.inserted.sort_by_key(|&(at, _)| at);
        let mut inserted = self.inserted.into_iter().peekable();
        let mut result = Vec::with_capacity(self.tokens.len());
        for at in 0..=self.tokens.len() {
            let start = self.tokens.get(at).map_or(self.text.len() as u32, |token| token.start);
            while let Some((_, kind)) = inserted.next_if(|&(before, _)| before == at) {
                result.push(Token { kind, start, end: start });
            }
            if let Some(&token) = self.tokens.get(at)
                && !self.dropped[at]
            {
                result.push(token);
            }
        }
        result
    }

    fn close(&mut self, bracket: Bracket, at: usize) {
        if self.ends_directive(bracket, at) {
            return;
        }
        loop {
            let Some(top) = self.open.last() else { return self.stray(bracket, at) };
            let surplus = |bracket: Bracket| self.surplus[bracket as usize];
            let unclosed = match top.opener {
                Opener::Bracket(same) if same == bracket => {
                    self.closes_an_outer_block(top, bracket, at) || self.is_of_another(top)
                }
                Opener::Bracket(other) => {
                    let outer = self.open_in_branch(bracket).is_some();
                    // `[0.6 rgb 1}`: on one line, one closer was written for the other.
                    let swapped = surplus(other) <= 0 || self.are_on_a_line(top.token, at);
                    if !outer || (swapped && surplus(bracket) < 0) {
                        return self.stray(bracket, at);
                    }
                    if surplus(other) <= 0 {
                        self.owe(other, at);
                    }
                    true
                }
                Opener::Directive if !self.ended.contains(&top.token) => true,
                Opener::Directive => return self.close_in_branch(bracket, at),
            };
            let Some(top) = self.open.pop() else { return };
            if !unclosed {
                return self.forget_outsides_since(&top);
            }
            self.never_closed(top, at);
        }
    }

    /// Returns whether this brace, if braces are missing, ends the block around `top`, judged by its
    /// indentation or by what `top` cannot contain.
    fn closes_an_outer_block(&self, top: &Open, bracket: Bracket, at: usize) -> bool {
        let place = self.layout.place(at);
        let outer = self.open.len().checked_sub(2).map(|below| &self.open[below]);
        let by_indent = |outer: &Open| {
            place.first && place.indent != top.indent && outer.indent == place.indent
        };
        let ended = || top.outside.is_some_and(|outside| !self.may_hold(top.token, outside.token));
        self.surplus[bracket as usize] > 0
            && bracket == Bracket::Brace
            && outer
                .is_some_and(|outer| outer.opener == top.opener && (by_indent(outer) || ended()))
    }

    /// Returns the innermost open `bracket`, if no directive was opened after it.
    fn open_in_branch(&self, bracket: Bracket) -> Option<usize> {
        let last = self.open.iter().rposition(|open| {
            open.opener == Opener::Directive || open.opener == Opener::Bracket(bracket)
        })?;
        (self.open[last].opener == Opener::Bracket(bracket)).then_some(last)
    }

    /// Handles a closer in a branch, for an opener before the directive.
    fn close_in_branch(&mut self, bracket: Bracket, at: usize) {
        let wanted = Opener::Bracket(bracket);
        let Some(outer) = self.open.iter().rposition(|open| open.opener == wanted) else {
            return self.stray(bracket, at);
        };
        if self.open[outer + 1].opener != Opener::Directive {
            return self.stray(bracket, at);
        }
        self.dropped[at] = true;
        if std::mem::replace(&mut self.open[outer].closed_in_branch, true) {
            return;
        }
        let (opener, directive) = (self.open[outer].token, self.open[outer + 1].token);
        let closer = bracket.closer();
        let diagnostic = Diagnostic::new(
            Code::UnclosedBlock,
            format!("{} is closed only in a branch", self.shown(opener)),
        )
        .at(self.span(opener), "opened here, outside")
        .also(self.span(at), format!("this `{closer}` is read only if this branch is"))
        .also(self.span(directive), "the branch begins here")
        .help("a branch closes what it opens, and nothing else");
        self.tell(diagnostic);
    }

    fn stray(&mut self, bracket: Bracket, at: usize) {
        self.dropped[at] = true;
        let index = bracket as usize;
        let beside = self.open.last().is_some_and(|top| match top.opener {
            Opener::Bracket(open) => {
                open != bracket
                    && self.surplus[open as usize] > 0
                    && self.are_on_a_line(top.token, at)
            }
            Opener::Directive => false,
        });
        if self.is_owed(bracket, at) && !beside {
            self.owed[index] -= 1;
            return;
        }
        self.surplus[index] += 1;
        let closer = bracket.closer();
        // Surplus openers of one kind and surplus closers of another are meant for each other.
        let meant = match self.open.last().map(|top| top.opener) {
            Some(Opener::Bracket(open)) => Some(open),
            Some(Opener::Directive) | None => None,
        };
        if let Some(meant) = meant.filter(|&open| {
            let lacks = self.surplus[index] <= 0 || beside && self.owed[index] > 0;
            open != bracket && lacks && self.surplus[open as usize] > 0
        }) && let Some(top) = self.open.pop()
        {
            self.surplus[meant as usize] -= 1;
            self.insert_closer(&Open { outside: None, ..top }, at);
            let (message, right) =
                (format!("{} is closed by `{closer}`", self.shown(top.token)), meant.closer());
            let diagnostic = Diagnostic::new(Code::StrayCloser, message)
                .at(self.span(at), format!("expected `{right}` here"))
                .also(self.span(top.token), "opened here")
                .help(format!("replace it with `{right}`"))
                .fix(self.span(at), right);
            return self.tell(diagnostic);
        }
        // `<1, 0, 0)>`: its own closer is next.
        let is_closed =
            self.tokens.get(at + 1).map(|next| next.kind) == Some(TokenKind::Mark(Mark::Greater));
        if let Some(open) =
            self.vector_before(at).filter(|_| bracket != Bracket::Brace && !is_closed)
        {
            self.inserted.push((at, TokenKind::Mark(Mark::Greater)));
            let message = format!("this `<` is closed by `{closer}`");
            let diagnostic = Diagnostic::new(Code::StrayCloser, message)
                .at(self.span(at), "expected `>` here")
                .also(self.span(open), "the vector opened here")
                .help("replace it with `>`")
                .fix(self.span(at), ">");
            return self.tell(diagnostic);
        }
        let mut diagnostic =
            Diagnostic::new(Code::StrayCloser, format!("this `{closer}` closes nothing"))
                .at(self.span(at), format!("no `{}` is open here", bracket.opener()));
        if let Some(top) = self.open.last() {
            diagnostic = diagnostic.also(self.span(top.token), "this is open instead");
        }
        self.tell(diagnostic.help("leave it out").fix(self.span(at), ""));
    }

    /// Handles `#end`.
    fn end(&mut self, at: usize) {
        let Some(&opener) = self.openers.get(&at) else { return };
        self.close_since_directive(at);
        while let Some(top) = self.open.pop_if(|top| top.token != opener) {
            self.never_closed(top, at);
            self.close_since_directive(at);
        }
        if let Some(directive) = self.open.pop() {
            self.forget_outsides_since(&directive);
        }
        if let Some(top) = self.open.pop_if(|top| top.closed_in_branch)
            && let Opener::Bracket(bracket) = top.opener
        {
            self.inserted.push((at + 1, TokenKind::Mark(Mark::Close(bracket))));
        }
    }

    /// Handles `#else` and the like: the directive had not ended before.
    fn divide(&mut self, at: usize) {
        self.close_since_directive(at);
        let directive = self.open.pop_if(|top| top.opener == Opener::Directive);
        if let Some(mut directive) = directive {
            self.forget_outsides_since(&directive);
            directive.outside = None;
            self.open.push(directive);
        }
    }

    /// Closes the brackets that were opened since the innermost directive.
    fn close_since_directive(&mut self, at: usize) {
        let last = self.open.iter().rposition(|open| open.opener == Opener::Directive);
        let Some(directive) = last else { return };
        while self.open.len() > directive + 1
            && let Some(top) = self.open.pop()
        {
            let Opener::Bracket(bracket) = top.opener else { continue };
            // The other branch usually has the same mistake.
            if std::mem::replace(&mut self.open[directive].told, true) {
                self.insert_closer(&top, at);
                self.surplus[bracket as usize] -= 1;
            } else {
                self.never_closed(top, at);
            }
            if self.surplus[bracket as usize] < 0 {
                self.owe(bracket, at);
            }
        }
    }

    fn insert_closer(&mut self, open: &Open, at: usize) {
        let kind = match open.opener {
            Opener::Bracket(bracket) => TokenKind::Mark(Mark::Close(bracket)),
            Opener::Directive => TokenKind::Directive(Head::End),
        };
        // A closer is a certain end, without a guess.
        let ends_file = at == self.tokens.len();
        let outside = open.outside.filter(|outside| outside.certain || ends_file);
        let place = outside.map_or(at, |outside| outside.token);
        self.inserted.push((self.before_angle(open, place), kind));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::syntax::balance::pairs;
    use crate::syntax::token::tokens;

    #[test]
    fn whatever_is_missing_or_too_many_what_comes_back_pairs() {
        const PARTS: [&str; 16] = [
            "sphere {",
            "union {",
            "finish {",
            "}",
            "(",
            ")",
            "[",
            "]",
            "#if (1)",
            "#else",
            "#end",
            "\n",
            "\n  ",
            "\n",
            "; ",
            "#declare A = 1;",
        ];
        let mut state = 7_u64;
        let mut random = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 33) as usize
        };
        for _ in 0..3000 {
            let length = random() % 30;
            let text: Vec<&str> = (0..length).map(|_| PARTS[random() % PARTS.len()]).collect();
            let text = text.join(" ");
            let mut told = Diagnostics::new(true);
            let repaired = repair(tokens(&text), &text, FileId(0), &mut told);
            let stray = |token: &Token| {
                matches!(turn(token.kind), Some(Turn::Divide | Turn::Close(Opener::Directive)))
            };
            // An unmatched `#end` or `#else` is reported when the tree is built.
            if !text.contains("#end") && !text.contains("#else") {
                assert!(pairs(&repaired), "{text}");
            }
            let brackets: Vec<Token> = repaired.into_iter().filter(|t| !stray(t)).collect();
            let opens = brackets
                .iter()
                .filter(|t| matches!(turn(t.kind), Some(Turn::Open(Opener::Bracket(_)))));
            let closes = brackets
                .iter()
                .filter(|t| matches!(turn(t.kind), Some(Turn::Close(Opener::Bracket(_)))));
            assert_eq!(opens.count(), closes.count(), "{text}");
        }
    }
}
