//! The names that a text declares anywhere.
//!
//! **Invariant:** found once, when a name is first asked for.

use std::collections::HashSet;

use super::Reader;
use crate::syntax::token::{Bracket, Head, Mark, TokenKind};

/// The names of a text by what declares them.
#[derive(Default)]
pub(super) struct Known<'a> {
    /// `#declare A = …`
    values: HashSet<&'a str>,
    /// Parameters, files, and what loops count by.
    others: HashSet<&'a str>,
}

impl<'a> Reader<'a> {
    /// Whether the text declares a name: as a value, a parameter, a file or what a loop counts by.
    pub(super) fn declares_anywhere(&self, name: &str) -> bool {
        let known = self.known();
        known.values.contains(name) || known.others.contains(name)
    }

    /// Whether the text has `#declare name =`, or `#local name =`.
    pub(super) fn declares_as_value(&self, name: &str) -> bool {
        self.known().values.contains(name)
    }

    /// Whether a name is a parameter, a file or what a loop counts by.
    pub(super) fn declares_otherwise(&self, name: &str) -> bool {
        self.known().others.contains(name)
    }

    fn known(&self) -> &Known<'a> {
        self.known.get_or_init(|| {
            let mut known = Known::default();
            let mut head = None;
            for token in self.tokens {
                head = match token.kind {
                    TokenKind::Directive(
                        of @ (Head::Declare
                        | Head::Local
                        | Head::Macro
                        | Head::For
                        | Head::Fopen
                        | Head::Read),
                    ) => Some(of),
                    TokenKind::Name | TokenKind::Word(_) => head,
                    TokenKind::Mark(Mark::Comma | Mark::Open(Bracket::Round)) => head,
                    _ => None,
                };
                let names = match head {
                    Some(Head::Declare | Head::Local) => &mut known.values,
                    Some(_) => &mut known.others,
                    None => continue,
                };
                if token.kind == TokenKind::Name {
                    names.extend(self.text.get(token.start as usize..token.end as usize));
                }
            }
            known
        })
    }
}
