//! Finds the paths through a macro's body whose brackets pair on each path, but not as written: `#if (A)
//! #write (F, "mesh {", #else mesh { #end … #if (A) "}") #else } #end`.
//!
//! **In:** a text, and the span of the body. **Out:** the deciding conditions, and for given values of these
//! the body as it runs: each character in its position, and blanks for branches that are not run.
//! **Invariant:** the body assigns to no name in such a condition, so that its value is constant throughout.

use std::collections::HashSet;
use std::ops::Range;

use super::balance::{Opener, Turn, pairs, turn};
use super::comment;
use super::token::{Bracket, Head, Mark, Token, TokenKind, tokens};
use crate::diagnostic::Diagnostics;
use crate::source::Span;

/// The paths through a macro's body; see the module.
#[derive(Debug)]
pub struct Ways {
    body: Span,
    forks: Vec<Fork>,
}

/// An `#if` whose branches do not pair by themselves.
#[derive(Debug)]
struct Fork {
    /// Including its parentheses.
    condition: Range<usize>,
    /// `#if (…)`, `#else` and `#end`.
    marks: [Range<usize>; 3],
    /// The branch if the condition holds, and the other one.
    branches: [Range<usize>; 2],
}

impl Fork {
    fn is_left_out(&self, at: usize, holds: bool) -> bool {
        self.marks.iter().any(|mark| mark.contains(&at))
            || self.branches[usize::from(holds)].contains(&at)
    }
}

/// An open directive.
struct Begun {
    head: Head,
    at: usize,
    otherwise: Option<usize>,
    /// It has more than two branches.
    is_manifold: bool,
}

impl Ways {
    /// Returns the paths; `None` if the brackets pair on no path, or if the choice depends on more than
    /// `#if`s.
    pub fn of(text: &str, body: Span) -> Option<Self> {
        let quiet = comment::quiet(text, body.file, &mut Diagnostics::new(true));
        let all: Vec<Token> = tokens(&quiet.text)
            .into_iter()
            .filter(|token| body.start <= token.start && token.end <= body.end)
            .collect();
        let slice = |token: &Token| text.get(token.start as usize..token.end as usize);
        let mut ways = Self { body, forks: Vec::new() };
        let mut begun: Vec<Begun> = Vec::new();
        for (at, token) in all.iter().enumerate() {
            match (turn(token.kind), token.kind) {
                (Some(Turn::Open(Opener::Directive)), TokenKind::Directive(head)) => {
                    begun.push(Begun { head, at, otherwise: None, is_manifold: false });
                }
                (Some(Turn::Divide), TokenKind::Directive(head)) => {
                    let last = begun.last_mut()?;
                    last.is_manifold |= head != Head::Else || last.otherwise.is_some();
                    last.otherwise = Some(at);
                }
                (Some(Turn::Close(Opener::Directive)), _) => {
                    let last = begun.pop()?;
                    ways.judge(&all, &last, at)?;
                }
                _ => {}
            }
        }
        ways.forks.sort_by_key(|fork| fork.condition.start);
        let decides = |token: &Token| {
            let start = token.start as usize;
            ways.forks.iter().any(|fork| fork.condition.contains(&start))
        };
        let deciding: HashSet<_> = all.iter().filter(|token| decides(token)).map(slice).collect();
        let is_changed = all.windows(2).any(|pair| {
            let changes = matches!(
                pair[0].kind,
                TokenKind::Directive(Head::Declare | Head::Local | Head::Undef)
            );
            changes && deciding.contains(&slice(&pair[1]))
        });
        let whole = [true, false].iter().all(|way| pairs(&ways.along(&all, *way)));
        (begun.is_empty() && whole && !is_changed && !ways.forks.is_empty()).then_some(ways)
    }

    /// Records an `#if` that ends at `end` as a fork if its branches do not pair; `None` if anything else
    /// does not pair.
    fn judge(&mut self, all: &[Token], begun: &Begun, end: usize) -> Option<()> {
        let behind = begun.otherwise.map_or(end, |otherwise| otherwise);
        let condition = (begun.head == Head::If).then(|| closed(all, begun.at + 1)).flatten();
        let first = condition.map_or(begun.at, |close| close) + 1;
        let branches = [&all[first.min(behind)..behind], &all[(behind + 1).min(end)..end]];
        let pairs_so = |way: bool| branches.iter().all(|branch| pairs(&self.along(branch, way)));
        if pairs_so(true) && pairs_so(false) {
            return Some(());
        }
        let close = condition.filter(|_| !begun.is_manifold)?;
        let place = |at: usize| all[at].start as usize;
        let past = |at: usize| all[at].end as usize;
        let divide = match begun.otherwise {
            Some(at) => place(at)..past(at),
            None => place(end)..place(end),
        };
        self.forks.push(Fork {
            condition: place(begun.at + 1)..past(close),
            branches: [past(close)..divide.start, divide.end..place(end)],
            marks: [place(begun.at)..past(close), divide, place(end)..past(end)],
        });
        Some(())
    }

    /// Returns the remaining tokens if all deciding conditions hold (`way`), or none does.
    fn along(&self, tokens: &[Token], way: bool) -> Vec<Token> {
        let is_run = |token: &&Token| {
            !self.forks.iter().any(|fork| fork.is_left_out(token.start as usize, way))
        };
        tokens.iter().filter(is_run).copied().collect()
    }

    /// Returns the conditions with their parentheses, in the order in which `text_where` takes their values.
    pub fn conditions(&self) -> impl Iterator<Item = Span> {
        self.forks
            .iter()
            .map(|fork| Span::new(self.body.file, fork.condition.start, fork.condition.end))
    }

    /// Returns whether the position `at` is run, given the values of the first conditions.
    pub fn reaches(&self, at: usize, holds: &[bool]) -> bool {
        !self.forks.iter().zip(holds).any(|(fork, holds)| fork.is_left_out(at, *holds))
    }

    /// Returns the body alone, on the path given by the conditions' values.
    pub fn text_where(&self, text: &str, holds: &[bool]) -> String {
        blanked(text, |at| self.body.range().contains(&at) && self.reaches(at, holds))
    }
}

/// Returns a text in which everything but `part` is blank.
pub fn alone(text: &str, part: Span) -> String {
    blanked(text, |at| part.range().contains(&at))
}

/// Returns a text with blanks for the bytes that are not kept; its line breaks stay.
fn blanked(text: &str, is_kept: impl Fn(usize) -> bool) -> String {
    let bytes = text.bytes().enumerate();
    let kept = bytes.map(|(at, byte)| if byte == b'\n' || is_kept(at) { byte } else { b' ' });
    String::from_utf8_lossy(&kept.collect::<Vec<_>>()).into_owned()
}

/// Returns the `)` of a `(`.
fn closed(tokens: &[Token], open: usize) -> Option<usize> {
    let mut depth = 0_usize;
    for (at, token) in tokens.iter().enumerate().skip(open) {
        match token.kind {
            TokenKind::Mark(Mark::Open(Bracket::Round)) => depth += 1,
            TokenKind::Mark(Mark::Close(Bracket::Round)) => {
                depth = depth.checked_sub(1)?;
                if depth == 0 {
                    return Some(at);
                }
            }
            _ if depth == 0 => return None,
            _ => {}
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::FileId;

    fn ways(text: &str) -> Option<Ways> {
        Ways::of(text, Span::new(FileId(0), 0, text.len()))
    }

    fn along(text: &str, holds: &[bool]) -> String {
        let words = ways(text).expect("ways").text_where(text, holds);
        words.split_whitespace().collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn a_way_has_what_is_run_on_it_in_its_place() {
        let text = "#if (A) f(1, #else g { #end #while (B) 2, #end #if (A) 3) #else } #end";
        assert_eq!(along(text, &[true, true]), "f(1, #while (B) 2, #end 3)");
        assert_eq!(along(text, &[false, false]), "g { #while (B) 2, #end }");
        let whole = ways(text).expect("ways").text_where(text, &[true, true]);
        assert_eq!(whole.find("3)"), text.find("3)"));
    }

    #[test]
    fn a_fork_may_stand_in_what_is_run_or_not() {
        let text = "#if (S) #if (A) f( #else g { #end 1 #if (A) ) #else } #end #end";
        assert_eq!(along(text, &[true, true]), "#if (S) f( 1 ) #end");
        assert_eq!(along(text, &[false, false]), "#if (S) g { 1 } #end");
    }

    #[test]
    fn what_pairs_on_no_way_or_is_decided_meanwhile_has_none() {
        for text in [
            "f(1",
            "#if (A) f(1 #end",
            "#if (A) (1 #elseif (B) (2 #else (3 #end )",
            "#while (A) ( #end",
            "#if (A) (1 #else (2 #end #local A = 0; )",
            "#ifdef (A) (1 #else (2 #end )",
        ] {
            assert!(ways(text).is_none(), "{text}");
        }
        assert_eq!(along("#if (A) (1 #else (2 #end + 3)", &[false]), "(2 + 3)");
    }
}
