//! What could not be run, for want of a condition that is known or of a directive: the names that it declares.
//!
//! **Invariant:** each of them is there, and stands for nothing known: no later mistake is told for want of it.

use crate::diagnostic::Code;
use crate::source::Span;
use crate::syntax::ast::{
    Argument, Callee, DirectiveKind, ExpressionId, ExpressionKind, Item, ItemKind, Items,
};

use super::value::Value;
use super::{Evaluator, Here, Symbol};

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

    /// Whether a message may only be right since the other branch of a condition was not run: a list may lack
    /// entries, or have too many.
    pub(super) fn may_be_undecided(&self, code: Code) -> bool {
        let is_about_parts = matches!(
            code,
            Code::MissingPart | Code::ExtraPart | Code::OpenOutline | Code::ZeroSize
        );
        self.undecided && is_about_parts && !self.blocks.is_empty()
    }

    /// What these items declare, or change, is there and not known.
    pub(super) fn declare_broken(&mut self, here: &Here, items: Items) {
        self.undecided = true;
        for item in here.unit.ast.items(items) {
            let ItemKind::Directive(id) = item.kind else { continue };
            let (name, local) = match &here.unit.ast.directive(id).kind {
                DirectiveKind::Declare { local, target } => (target.name, *local),
                DirectiveKind::Macro { name, .. } => (*name, false),
                DirectiveKind::If { then, otherwise, .. } => {
                    self.declare_broken(here, *then);
                    self.declare_broken(here, *otherwise);
                    continue;
                }
                DirectiveKind::While { body, .. } | DirectiveKind::For { body, .. } => {
                    self.declare_broken(here, *body);
                    continue;
                }
                DirectiveKind::Switch { lead, cases, .. } => {
                    let bodies = cases.iter().map(|case| case.body);
                    std::iter::once(*lead).chain(bodies).for_each(|b| self.declare_broken(here, b));
                    continue;
                }
                _ => continue,
            };
            self.break_name(here.symbol(name), local);
        }
    }

    /// `module Post(H)`: the names are there, and stand for nothing known.
    pub(super) fn meet_names(&mut self, here: &Here, id: ExpressionId) {
        if let ExpressionKind::Call(Callee::Name(name, _), arguments) =
            here.unit.expression(id).kind
        {
            let arguments = here.unit.ast.arguments(arguments).iter();
            let names = arguments.filter_map(|argument| match argument {
                Argument::Expression(id) => match here.unit.expression(*id).kind {
                    ExpressionKind::Name(name) => Some(name),
                    _ => None,
                },
                Argument::Items(_) => None,
            });
            for name in names.chain([name]) {
                self.break_name(here.symbol(name), false);
            }
        }
    }

    /// `#macro Post`, as has been told: which parameters it has is not known.
    pub(super) fn lacks_parameters(&self, name: Span) -> bool {
        let behind = self.sources.get(name.file).text.get(name.end as usize..);
        !behind.is_some_and(|text| text.trim_start().starts_with(['(', '/']))
    }

    fn break_name(&mut self, symbol: Symbol, local: bool) {
        if !matches!(self.scopes.look(symbol), Some(Value::Macro(_))) {
            let home = self.scopes.home(symbol, local);
            self.scopes.assign_in(home, symbol, Value::Broken);
        }
    }
}
