//! Reduces syntax errors in branches that were not run to one warning for each branch.
//!
//! **In:** the branches, and the diagnostics about the text. **Out:** the same without the errors in the
//! branches, which POV-Ray 3.7 skips word by word (measured). **Invariant:** an error that may reach beyond
//! its branch, such as an unclosed directive or quote, stays an error.

use crate::diagnostic::{Code, Diagnostic, Diagnostics};
use crate::source::Span;

/// Replaces the errors in `branches` among the first `parsed` diagnostics; returns how many of those are
/// left.
pub(super) fn tell_unread(
    branches: &[Span],
    parsed: usize,
    diagnostics: &mut Diagnostics,
) -> usize {
    let around = |place: Span| {
        let holds = |branch: &&Span| {
            branch.file == place.file && branch.start <= place.start && place.end <= branch.end
        };
        branches.iter().filter(holds).max_by_key(|branch| branch.end - branch.start).copied()
    };
    let mut unread: Vec<(Span, Diagnostic)> = Vec::new();
    let mut counted = 0;
    for told in diagnostics.iter().take(parsed).filter(|told| stays_inside(told)) {
        let Some(place) = told.primary().map(|label| label.span) else { continue };
        let Some(branch) = around(place) else { continue };
        counted += 1;
        let is_first = !unread.iter().any(|(other, _)| *other == branch);
        unread.extend(is_first.then(|| (branch, told.clone())));
    }
    if unread.is_empty() {
        return parsed;
    }
    diagnostics.retain_after(0, |told| {
        let place = told.primary().map(|label| label.span);
        !(stays_inside(told) && place.is_some_and(|place| around(place).is_some()))
    });
    for (_, first) in unread {
        let message = format!("a branch that is not run cannot be read: {}", first.message);
        let mut told = Diagnostic::new(Code::UnreadBranch, message);
        (told.labels, told.help, told.fixes) = (first.labels, first.help, first.fixes);
        diagnostics.push(told);
    }
    parsed - counted
}

fn stays_inside(told: &Diagnostic) -> bool {
    let is_of_form = match told.code {
        Code::UnexpectedCharacter
        | Code::StrayCloser
        | Code::UnclosedBlock
        | Code::MalformedNumber
        | Code::ExpectedExpression => true,
        // `#elif` probably starts the next branch.
        Code::UnknownDirective => {
            told.help.is_empty() || told.message.starts_with("a comment begins")
        }
        _ => false,
    };
    is_of_form && told.is_error()
}
