//! Code that could not be run because a condition's value or a directive is unknown: declares its names.
//!
//! **Invariant:** each of these names is declared with an unknown value, and no later mistake is reported
//! because of that.

use crate::diagnostic::Code;
use crate::source::Span;
use crate::syntax::ast::{
    Argument, Callee, DirectiveKind, ExpressionId, ExpressionKind, Item, ItemKind, Items,
};

use super::value::Value;
use super::{Evaluator, Here, Symbol};

impl Evaluator<'_> {
    /// Handles a condition of unknown value: the names that either branch declares get unknown values, and
    /// what the first branch contributes to a block is read, since the block may need it.
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

    /// Returns whether a message may only be due to the other branch of a condition, which was not run: a
    /// list may lack entries, or have too many.
    pub(super) fn may_be_undecided(&self, code: Code) -> bool {
        let is_about_parts = matches!(
            code,
            Code::MissingPart | Code::ExtraPart | Code::OpenOutline | Code::ZeroSize
        );
        self.undecided && is_about_parts && !self.blocks.is_empty()
    }

    /// Declares the names that these items declare or change, with unknown values.
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

    /// Declares the names in a construct such as `module Post(H)`, with unknown values.
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

    /// Returns whether a reported `#macro Post` has unknown parameters.
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
