//! Matches each `#end` with the directive that it ends.

use std::collections::HashMap;

use crate::syntax::balance::{Opener, Turn, turn};
use crate::syntax::layout::Layout;
use crate::syntax::token::Token;

/// Returns the directive that each `#end` ends. If `#end`s are missing, indentation decides.
pub(super) fn match_directives(tokens: &[Token], layout: &Layout) -> HashMap<usize, usize> {
    let count = |wanted: Turn| tokens.iter().filter(|t| turn(t.kind) == Some(wanted)).count();
    let (opens, ends) =
        (count(Turn::Open(Opener::Directive)), count(Turn::Close(Opener::Directive)));
    let mut missing = opens.saturating_sub(ends);
    let mut open: Vec<usize> = Vec::new();
    let mut openers = HashMap::new();
    for (at, token) in tokens.iter().enumerate() {
        match turn(token.kind) {
            Some(Turn::Open(Opener::Directive)) => open.push(at),
            Some(Turn::Close(Opener::Directive)) => {
                let place = layout.place(at);
                let fits = |&opener: &usize| layout.place(opener).indent == place.indent;
                if place.first && missing > 0 && open.last().is_some_and(|last| !fits(last)) {
                    let skipped = open.iter().rev().position(fits);
                    if let Some(skipped) = skipped.filter(|&skipped| skipped <= missing) {
                        open.truncate(open.len() - skipped);
                        missing -= skipped;
                    }
                }
                if let Some(opener) = open.pop() {
                    openers.insert(at, opener);
                }
            }
            Some(_) | None => {}
        }
    }
    openers
}
