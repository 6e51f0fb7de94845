//! Source positions of running items: a parsed file, and the expansion that runs it.

use std::rc::Rc;

use crate::diagnostic::suggest;
use crate::source::{ExpansionId, Site, Span};
use crate::syntax::ast::{Ast, DirectiveKind, Expression, ExpressionId, NameId};

use super::scope::Symbol;

/// A parsed file with its names interned.
#[derive(Debug)]
pub(super) struct Unit {
    pub ast: Ast,
    pub symbols: Vec<Symbol>,
}

impl Unit {
    pub fn expression(&self, id: ExpressionId) -> &Expression {
        self.ast.expression(id)
    }

    /// Returns all declarations in this file, with their spans.
    pub fn declarations(&self) -> impl Iterator<Item = (NameId, Span)> {
        self.ast.directives.iter().filter_map(|directive| match &directive.kind {
            DirectiveKind::Declare { target, .. } => Some((target.name, target.span)),
            DirectiveKind::Macro { name, name_span, .. } => Some((*name, *name_span)),
            _ => None,
        })
    }

    /// Returns where this file declares a name, whether or not that is run.
    pub fn declaration_of(&self, symbol: Symbol) -> Option<Span> {
        self.declarations()
            .find(|(name, _)| self.symbols[name.0 as usize] == symbol)
            .map(|(_, span)| span)
    }

    /// Returns a name declared in this file that closely resembles `name`.
    pub fn similar_declaration(&self, name: &str) -> Option<(String, Span)> {
        let names = self.declarations().map(|(name, _)| self.ast.name(name));
        let close = suggest::closest(name, names)?;
        let span = self.declarations().find(|(name, _)| self.ast.name(*name) == close)?.1;
        Some((close.to_owned(), span))
    }
}

/// A source position: a file, and the expansion that runs it.
#[derive(Debug, Clone)]
pub(super) struct Here {
    pub unit: Rc<Unit>,
    pub expansion: ExpansionId,
}

impl Here {
    pub fn site(&self, span: Span) -> Site {
        Site { span, expansion: self.expansion }
    }

    pub fn symbol(&self, name: NameId) -> Symbol {
        self.unit.symbols[name.0 as usize]
    }
}
