//! Detection of loops that certainly never end.
//!
//! **In:** a loop's body and condition. **Out:** whether anything in them could end it. **Invariant:** a loop
//! is reported only when it is certain: a condition whose names are not assigned in the body never changes,
//! and only a `#break`, an `#error` or a macro that contains one leaves a loop early.

use std::collections::HashSet;
use std::rc::Rc;

use crate::diagnostic::{Code, Diagnostic, suggest};
use crate::source::{ExpansionId, Span};
use crate::syntax::ast::{
    Argument, Ast, Callee, DirectiveKind, ExpressionId, ExpressionKind, Item, ItemKind, Items,
    NameId,
};
use crate::vocabulary::Word;

use super::expand::Macro;
use super::scope::Symbol;
use super::value::Value;
use super::{Evaluator, Here, Reported};

impl Evaluator<'_> {
    /// Reports too deep a nesting of macro calls and halts the evaluation.
    pub(super) fn too_many_calls(
        &mut self,
        here: &Here,
        definition: &Macro,
        span: Span,
        message: String,
        help: &str,
    ) -> Reported {
        self.forget_echoes_of_calls(here.expansion);
        let name = self.scopes.name(definition.name);
        let diagnostic = Diagnostic::new(Code::MacroLimit, message)
            .at(span, format!("this call of `{name}` is one too many"))
            .also(definition.defined, "defined here")
            .help(help);
        self.halt(here.expansion, diagnostic)
    }

    /// Withdraws diagnostics about missing parts in macros whose calls never ended, which might have supplied
    /// them at their end.
    fn forget_echoes_of_calls(&mut self, innermost: ExpansionId) {
        let expansions = &self.scene.expansions;
        let names: HashSet<&str> =
            expansions.chain(innermost).map(|expansion| expansions.name(expansion)).collect();
        let called = |definition: &&Rc<Macro>| names.contains(self.scopes.name(definition.name));
        let bodies: Vec<Span> =
            self.macros.iter().filter(called).filter_map(|definition| definition.text()).collect();
        let sources = &self.sources;
        self.diagnostics.retain_after(0, |told| {
            let Some(place) = told.primary().map(|label| label.span) else { return true };
            let is_name =
                told.code == Code::UnknownWord && Word::from_name(sources.text(place)).is_none();
            let inside = bodies.iter().any(|body| {
                body.file == place.file && body.range().contains(&(place.start as usize))
            });
            !(inside && told.code.is_about_place() && !is_name)
        });
    }

    /// Returns whether nothing in a loop's condition can change in a turn, and nothing in its body leaves the
    /// loop.
    pub(super) fn never_changes(&self, here: &Here, condition: ExpressionId, body: Items) -> bool {
        let ast = &here.unit.ast;
        let ([first, .., last] | [first @ last]) = ast.items(body) else { return true };
        if may_leave(ast, body) {
            return false;
        }
        let inside = first.span.to(last.span);
        let is_inside = |span: Span| inside.start <= span.start && span.end <= inside.end;
        let is_macro = |name: NameId| {
            !matches!(
                self.scopes.look(here.symbol(name)),
                Some(Value::Function(_) | Value::Spline(_))
            )
        };
        let mut asked = Vec::new();
        if !self.asks_only(here, condition, &mut asked) {
            return false;
        }
        let calls_macro = ast.expressions.iter().any(|one| match one.kind {
            ExpressionKind::Call(Callee::Name(name, _), _) => is_inside(one.span) && is_macro(name),
            _ => false,
        });
        // A parameter is an alias of its argument.
        let is_asked = |name: NameId| {
            let symbol = here.symbol(name);
            let slot = self.scopes.slot(symbol);
            asked
                .iter()
                .any(|&other| other == symbol || slot.is_some() && slot == self.scopes.slot(other))
        };
        let changes = |kind: &DirectiveKind| match kind {
            DirectiveKind::Declare { target, .. } | DirectiveKind::Undef(target) => {
                is_asked(target.name)
            }
            DirectiveKind::For { name, .. } | DirectiveKind::Macro { name, .. } => is_asked(*name),
            DirectiveKind::Version(_)
            | DirectiveKind::Fopen { .. }
            | DirectiveKind::Fclose { .. }
            | DirectiveKind::Read { .. } => true,
            _ => false,
        };
        let mut directives = ast.directives.iter().filter(|one| is_inside(one.head));
        !calls_macro && !directives.any(|one| changes(&one.kind))
    }

    /// Collects the names that an expression reads. Returns `false` if it reads anything else that may change
    /// on its own.
    fn asks_only(&self, here: &Here, id: ExpressionId, asked: &mut Vec<Symbol>) -> bool {
        let ast = &here.unit.ast;
        let mut open = vec![id];
        while let Some(id) = open.pop() {
            let arguments = match ast.expression(id).kind {
                ExpressionKind::Number(_)
                | ExpressionKind::Triple(_)
                | ExpressionKind::String
                | ExpressionKind::Word(_) => continue,
                ExpressionKind::Name(name) => {
                    asked.push(here.symbol(name));
                    continue;
                }
                ExpressionKind::Unary(_, a)
                | ExpressionKind::Group(a)
                | ExpressionKind::Component(a, _) => {
                    open.push(a);
                    continue;
                }
                ExpressionKind::Binary(_, a, b) | ExpressionKind::Index(a, b) => {
                    open.extend([a, b]);
                    continue;
                }
                ExpressionKind::Conditional(a, b, c) => {
                    open.extend([a, b, c]);
                    continue;
                }
                ExpressionKind::Call(Callee::Word(Word::Rand | Word::FileExists, _), _) => {
                    return false;
                }
                ExpressionKind::Call(Callee::Name(name, _), arguments) => {
                    let symbol = here.symbol(name);
                    let known = self.scopes.look(symbol);
                    if !matches!(known, Some(Value::Function(_) | Value::Spline(_))) {
                        return false;
                    }
                    asked.push(symbol);
                    arguments
                }
                ExpressionKind::Call(Callee::Word(..), arguments)
                | ExpressionKind::Vector(arguments) => arguments,
                ExpressionKind::Call(Callee::Element(_), _)
                | ExpressionKind::GroupItems(_)
                | ExpressionKind::Joint
                | ExpressionKind::Missing => return false,
            };
            for argument in ast.arguments(arguments) {
                match *argument {
                    Argument::Expression(id) => open.push(id),
                    Argument::Items(_) => return false,
                }
            }
        }
        true
    }
}

/// Returns whether an expression has the same value at every evaluation.
pub(super) fn is_constant(ast: &Ast, id: ExpressionId) -> bool {
    let mut open = vec![id];
    while let Some(id) = open.pop() {
        match ast.expression(id).kind {
            ExpressionKind::Number(_) => {}
            ExpressionKind::Word(word) => {
                let constants =
                    [Word::True, Word::Yes, Word::On, Word::False, Word::No, Word::Off, Word::Pi];
                if !constants.contains(&word) {
                    return false;
                }
            }
            ExpressionKind::Unary(_, a) | ExpressionKind::Group(a) => open.push(a),
            ExpressionKind::Binary(_, a, b) => open.extend([a, b]),
            ExpressionKind::Conditional(a, b, c) => open.extend([a, b, c]),
            ExpressionKind::String
            | ExpressionKind::Name(_)
            | ExpressionKind::Vector(_)
            | ExpressionKind::Triple(_)
            | ExpressionKind::Call(..)
            | ExpressionKind::Index(..)
            | ExpressionKind::Component(..)
            | ExpressionKind::GroupItems(_)
            | ExpressionKind::Joint
            | ExpressionKind::Missing => return false,
        }
    }
    true
}

/// For a condition with a name that the body never sets while it sets one that differs only in case or by a
/// typo, returns the two names and where the second is set.
pub(super) fn nearly_set(
    ast: &Ast,
    condition: ExpressionId,
    body: Items,
) -> Option<(&str, &str, Span)> {
    let (asked, set) = (names(ast, condition), declared(ast, body));
    asked.into_iter().find_map(|asked| {
        let alike = |(name, _): &&(&str, Span)| {
            let is_slip = || {
                suggest::closest(name, [asked]).is_some() && !suggest::are_of_a_series(name, asked)
            };
            name.eq_ignore_ascii_case(asked) || is_slip()
        };
        let sets = |(name, _): &(&str, Span)| *name == asked;
        let &(name, span) = set.iter().find(alike).filter(|_| !set.iter().any(sets))?;
        Some((asked, name, span))
    })
}

/// Returns the first name in a condition, if the body sets none of its names.
pub(super) fn never_set(ast: &Ast, condition: ExpressionId, body: Items) -> Option<&str> {
    let (asked, set) = (names(ast, condition), declared(ast, body));
    let sets = |asked: &&str| set.iter().any(|(name, _)| name == asked);
    asked.first().copied().filter(|_| !asked.iter().any(sets))
}

/// Returns the names in an expression of operators and parentheses.
fn names(ast: &Ast, id: ExpressionId) -> Vec<&str> {
    let (mut open, mut names) = (vec![id], Vec::new());
    while let Some(id) = open.pop() {
        match ast.expression(id).kind {
            ExpressionKind::Name(name) => names.push(ast.name(name)),
            ExpressionKind::Unary(_, a) | ExpressionKind::Group(a) => open.push(a),
            ExpressionKind::Binary(_, a, b) => open.extend([a, b]),
            ExpressionKind::Conditional(a, b, c) => open.extend([a, b, c]),
            ExpressionKind::Number(_)
            | ExpressionKind::Word(_)
            | ExpressionKind::String
            | ExpressionKind::Vector(_)
            | ExpressionKind::Triple(_)
            | ExpressionKind::Call(..)
            | ExpressionKind::Index(..)
            | ExpressionKind::Component(..)
            | ExpressionKind::GroupItems(_)
            | ExpressionKind::Joint
            | ExpressionKind::Missing => {}
        }
    }
    names
}

/// Returns what a loop's body declares at its own level.
fn declared(ast: &Ast, body: Items) -> Vec<(&str, Span)> {
    let declares = |item: &Item| match item.kind {
        ItemKind::Directive(id) => match &ast.directive(id).kind {
            DirectiveKind::Declare { target, .. } => Some((ast.name(target.name), target.span)),
            _ => None,
        },
        _ => None,
    };
    ast.items(body).iter().filter_map(declares).collect()
}

/// Returns whether anything in a loop's body may leave the loop.
pub(super) fn may_leave(ast: &Ast, body: Items) -> bool {
    let mut open = vec![body];
    while let Some(items) = open.pop() {
        for item in ast.items(items) {
            match item.kind {
                ItemKind::Block(inner) | ItemKind::Entry(inner) => open.push(inner),
                ItemKind::Expression(id) => {
                    if let ExpressionKind::Call(Callee::Name(..), _) = ast.expression(id).kind {
                        return true;
                    }
                }
                ItemKind::Directive(id) => match &ast.directive(id).kind {
                    DirectiveKind::Break
                    | DirectiveKind::Error(_)
                    | DirectiveKind::Include(_)
                    | DirectiveKind::Unread
                    | DirectiveKind::Malformed => return true,
                    DirectiveKind::If { then, otherwise, .. } => open.extend([*then, *otherwise]),
                    DirectiveKind::While { body, .. } | DirectiveKind::For { body, .. } => {
                        open.push(*body);
                    }
                    DirectiveKind::Switch { lead, cases, .. } => {
                        open.push(*lead);
                        open.extend(cases.iter().map(|case| case.body));
                    }
                    DirectiveKind::Default(inner) => open.push(*inner),
                    DirectiveKind::Declare { .. }
                    | DirectiveKind::Undef(_)
                    | DirectiveKind::Macro { .. }
                    | DirectiveKind::Version(_)
                    | DirectiveKind::Debug(_)
                    | DirectiveKind::Warning(_)
                    | DirectiveKind::Fopen { .. }
                    | DirectiveKind::Fclose { .. }
                    | DirectiveKind::Read { .. }
                    | DirectiveKind::Write { .. }
                    | DirectiveKind::OldStream(_) => {}
                },
                ItemKind::Word(_)
                | ItemKind::Open
                | ItemKind::Close
                | ItemKind::Comma
                | ItemKind::Semicolon
                | ItemKind::Numbers { .. } => {}
            }
        }
    }
    false
}
