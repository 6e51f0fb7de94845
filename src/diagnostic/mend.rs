//! Applies the fixes suggested by messages, if they improve the text.
//!
//! **In:** a text, and a function that returns its messages. **Out:** the fixed text, and how many messages
//! that resolved. **Invariant:** a fix is kept only if it reduces the number of errors, or that of errors and
//! warnings together, so that one mistake is not replaced by another. Two mistakes hide others, and their
//! fixes only have to resolve their own messages: after a bracket, string, comment or directive that is not
//! closed, or a surplus closer, any messages may appear; after a misspelt word, as many errors as before, and
//! new messages only behind it. Applying the function again changes nothing, unless the limit of rounds was
//! reached.

use std::collections::BTreeMap;

use super::{Code, Diagnostic, Fix, Severity};
use crate::source::FileId;

/// Maximum number of rounds; one fix may reveal another.
const MOST_ROUNDS: usize = 8;

/// Maximum number of single fixes tried in a round whose fixes do not all work together.
const MOST_TRIALS: usize = 200;

/// Fixes `text`, the main file, as suggested by the messages that `messages` returns for it.
pub fn mend(
    text: &str,
    mut messages: impl FnMut(&str) -> Vec<Diagnostic>,
) -> Option<(String, usize)> {
    let mut text = text.to_owned();
    let mut mended = 0;
    let mut found = messages(&text);
    for _ in 0..MOST_ROUNDS {
        let all = apply(&text, found.iter());
        if all.1.is_empty() {
            break;
        }
        let after = messages(&all.0);
        // Applies all fixes together if each resolves its own message.
        let (count, of_errors) = (all.1.len(), errors(all.1.iter().copied()));
        let enough = match of_errors {
            0 => weight(&after) + count <= weight(&found),
            _ => errors(&after) + of_errors <= errors(&found),
        };
        if enough {
            (text, found) = (all.0, after);
            mended += count;
            continue;
        }
        let before = mended;
        for at in (0..found.len()).rev().take(MOST_TRIALS) {
            let Some(diagnostic) = found.get(at) else { continue };
            let (trial, used) = apply(&text, std::iter::once(diagnostic));
            if used.is_empty() {
                continue;
            }
            let after = messages(&trial);
            if is_better(&found, &after, diagnostic) {
                (text, found) = (trial, after);
                mended += 1;
            }
        }
        if mended == before {
            break;
        }
    }
    (mended > 0).then_some((text, mended))
}

/// Whether a fix helped: fewer errors, as many errors and fewer messages, or errors revealed that the fixed
/// mistake had hidden.
fn is_better(before: &[Diagnostic], after: &[Diagnostic], fixed: &Diagnostic) -> bool {
    let (old, new) = (errors(before), errors(after));
    // Errors that a missing closing bracket had hidden are not new mistakes.
    let uncovers = fixed.code.shifts_what_follows()
        && !after.iter().any(|other| other.code == fixed.code && other.message == fixed.message);
    // Neither are those that a misspelt word had hidden, if all new messages are after it.
    let end = fixed.fixes.iter().map(|fix| fix.span.end).max();
    let behind = |other: &Diagnostic| {
        before.iter().any(|old| old.message == other.message)
            || other.primary().map(|label| label.span.start) >= end
    };
    let uncovers = uncovers
        || (matches!(fixed.code, Code::UnknownWord | Code::ForeignWord)
            && new == old
            && after.iter().all(|other| other.message != fixed.message && behind(other)));
    new < old || (new == old && weight(after) < weight(before)) || uncovers
}

fn errors<'a>(list: impl IntoIterator<Item = &'a Diagnostic>) -> usize {
    list.into_iter().filter(|one| one.severity == Severity::Error).count()
}

/// Returns the number of errors and warnings.
fn weight(list: &[Diagnostic]) -> usize {
    list.iter().filter(|one| one.severity != Severity::Note).count()
}

/// Applies all fixes that do not overlap an earlier one; returns the text and the messages they belong to.
/// The fixes of one message are applied together or not at all.
pub fn apply<'a>(
    text: &str,
    diagnostics: impl Iterator<Item = &'a Diagnostic>,
) -> (String, Vec<&'a Diagnostic>) {
    // By where they start: of these, which are apart, only neighbours can touch another.
    let mut chosen: BTreeMap<(u32, usize), &Fix> = BTreeMap::new();
    let mut mended = Vec::new();
    for diagnostic in diagnostics {
        let fixes = &diagnostic.fixes;
        let free = |fix: &Fix| {
            let (start, end) = (fix.span.start, fix.span.end);
            let before = chosen.range(..(start, 0)).next_back();
            // Two insertions at one place have no order: the second waits too.
            let behind = chosen.range((start, 0)..).next();
            fix.span.file == FileId(0)
                && before.is_none_or(|(_, other)| other.span.end <= start)
                && behind.is_none_or(|((other, _), _)| end <= *other && start < *other)
        };
        if !fixes.is_empty() && fixes.iter().all(free) {
            let count = chosen.len();
            let keyed = fixes.iter().enumerate();
            chosen.extend(keyed.map(|(at, fix)| ((fix.span.start, count + at), fix)));
            mended.push(diagnostic);
        }
    }
    let (mut out, mut at) = (String::with_capacity(text.len()), 0);
    for fix in chosen.into_values() {
        out.push_str(text.get(at..fix.span.start as usize).unwrap_or(""));
        out.push_str(&fix.text);
        at = fix.span.end as usize;
    }
    out.push_str(text.get(at..).unwrap_or(""));
    (out, mended)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::Span;

    fn wrong(fixes: &[(usize, usize, &str)]) -> Diagnostic {
        let start = Diagnostic::new(Code::UnknownWord, "wrong");
        fixes.iter().fold(start, |diagnostic, &(start, end, text)| {
            diagnostic.fix(Span::new(FileId(0), start, end), text)
        })
    }

    fn applied(text: &str, list: &[Diagnostic]) -> (String, usize) {
        let (text, used) = apply(text, list.iter());
        (text, used.len())
    }

    #[test]
    fn fixes_are_applied_in_any_order() {
        let list = [wrong(&[(4, 7, "two")]), wrong(&[(0, 3, "one"), (7, 7, "!")]), wrong(&[])];
        assert_eq!(applied("eno owt", &list), ("one two!".to_owned(), 2));
    }

    #[test]
    fn fixes_that_overlap_wait_for_the_next_round() {
        let list = [wrong(&[(0, 3, "a")]), wrong(&[(2, 5, "b")]), wrong(&[(0, 0, "c")])];
        assert_eq!(applied("123456", &list), ("a456".to_owned(), 1));
    }

    #[test]
    fn a_fix_in_another_file_is_left_alone() {
        let other =
            Diagnostic::new(Code::UnknownWord, "wrong").fix(Span::new(FileId(1), 0, 1), "a");
        assert_eq!(applied("1", &[other]), ("1".to_owned(), 0));
    }

    /// An error at each of the given letters, with a fix to the letter after it.
    fn errors_at(text: &str, letters: &str) -> Vec<Diagnostic> {
        let found = text.char_indices().filter(|(_, c)| letters.contains(*c));
        let next = |c: char| char::from(c as u8 + 1).to_string();
        found.map(|(at, c)| wrong(&[(at, at + 1, &next(c))])).collect()
    }

    #[test]
    fn a_fix_that_turns_one_error_into_another_is_not_applied() {
        assert_eq!(mend("ab", |text| errors_at(text, "ab")), Some(("ac".to_owned(), 1)));
        assert_eq!(mend("a", |text| errors_at(text, "ab")), None);
    }

    #[test]
    fn all_fixes_are_applied_where_each_mends_its_own() {
        assert_eq!(mend("a.a.a", |text| errors_at(text, "a")), Some(("b.b.b".to_owned(), 3)));
    }
}
