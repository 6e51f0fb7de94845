//! Branches of conditions: which were never run, so that a mistake of form in one is none of the picture; and
//! which open a block that only their own end closes.
//!
//! **Invariant:** a branch that was not run is noted only of the main file, and where its text has mistakes; one
//! in a macro that was not called, or in a loop that had no turn, is not among them.

use crate::source::{FileId, Span};
use crate::syntax::ast::{
    Ast, Callee, DirectiveId, DirectiveKind, ExpressionKind, Item, ItemKind, Items, Test,
};

use super::value::Value;
use super::{Evaluator, Here};

/// Whether a branch opens or closes what pairs only after it has run.
pub(super) fn is_bracket(here: &Here, branch: Items) -> bool {
    let items = here.unit.ast.items(branch);
    items.iter().any(|item| matches!(item.kind, ItemKind::Open | ItemKind::Close))
}

impl Evaluator<'_> {
    /// Which branch is meant is not known: what either declares is there and not known, and what the first gives
    /// to a block is read, since the block may need it.
    pub(super) fn run_neither(&mut self, here: &Here, then: Items, otherwise: Items) {
        self.declare_broken(here, then);
        self.declare_broken(here, otherwise);
        let plain = |item: &Item| match item.kind {
            ItemKind::Directive(_) | ItemKind::Open | ItemKind::Close => false,
            ItemKind::Expression(id) => {
                !matches!(here.unit.expression(id).kind, ExpressionKind::Call(Callee::Name(..), _))
            }
            _ => true,
        };
        if !self.blocks.is_empty() && here.unit.ast.items(then).iter().all(plain) {
            self.push_branch(here, then);
        }
    }

    fn declare_broken(&mut self, here: &Here, items: Items) {
        for item in here.unit.ast.items(items) {
            let ItemKind::Directive(id) = item.kind else { continue };
            let (name, local) = match &here.unit.ast.directive(id).kind {
                DirectiveKind::Declare { local, target } if target.indices.is_empty() => {
                    (target.name, *local)
                }
                DirectiveKind::Macro { name, .. } => (*name, false),
                DirectiveKind::If { then, otherwise, .. } => {
                    self.declare_broken(here, *then);
                    self.declare_broken(here, *otherwise);
                    continue;
                }
                _ => continue,
            };
            let symbol = here.symbol(name);
            if self.scopes.slot(symbol).is_none() {
                let home = self.scopes.home(symbol, local);
                self.scopes.assign_in(home, symbol, Value::Broken);
            }
        }
    }

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
            let DirectiveKind::If { test, then, otherwise } = &ast.directive(id).kind else {
                continue;
            };
            let head = match test {
                Test::Condition(condition) => ast.expression(*condition).span,
                Test::Defined(target) | Test::NotDefined(target) => target.span,
            };
            let end = item.span.end;
            let ends =
                |items: Items| ast.items(items).last().map_or(head.end, |last| last.span.end);
            let branch = match self.asked.get(&id) {
                Some([false, true]) if otherwise.is_empty() => Some((head.end, end)),
                Some([false, true]) => Some((head.end, ends(*then))),
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
