//! Branches of conditions: those that were never run, whose syntax errors do not affect the image, and those
//! that open a block that only their own end closes.
//!
//! **Invariant:** a branch that was not run is recorded only for the main file, and only if its text has
//! mistakes. Branches in a macro that was not called, or in a loop that had no turn, are not recorded.

use crate::source::{FileId, Span};
use crate::syntax::ast::{Ast, DirectiveId, DirectiveKind, ItemKind, Items, Test};

use super::{Evaluator, Here};

/// Returns whether a branch opens or closes brackets that pair only after it has run.
pub(super) fn is_bracket(here: &Here, branch: Items) -> bool {
    let items = here.unit.ast.items(branch);
    items.iter().any(|item| matches!(item.kind, ItemKind::Open | ItemKind::Close))
}

impl Evaluator<'_> {
    pub(super) fn note_asked(&mut self, here: &Here, id: DirectiveId, held: bool) {
        if self.misread && here.unit.ast.file == FileId(0) {
            self.asked.entry(id).or_default()[usize::from(!held)] = true;
        }
    }

    pub(super) fn skipped(&self, ast: &Ast) -> Vec<Span> {
        if self.asked.is_empty() {
            return Vec::new();
        }
        let mut skipped = Vec::new();
        for item in &ast.items {
            let ItemKind::Directive(id) = item.kind else { continue };
            let DirectiveKind::If { test, otherwise, .. } = &ast.directive(id).kind else {
                continue;
            };
            let head = match test {
                Test::Condition(condition) => ast.expression(*condition).span,
                Test::Defined(target) | Test::NotDefined(target) => target.span,
            };
            let end = item.span.end;
            let branch = match self.asked.get(&id) {
                Some([false, true]) if otherwise.is_empty() => Some((head.end, end)),
                // Up to its `#else`: the text that could not be read may be at its end.
                Some([false, true]) => {
                    ast.items(*otherwise).first().map(|first| (head.end, first.span.start))
                }
                Some([true, false]) => {
                    ast.items(*otherwise).first().map(|first| (first.span.start, end))
                }
                _ => None,
            };
            skipped.extend(branch.map(|(start, end)| Span { start, end, ..item.span }));
        }
        skipped
    }
}
