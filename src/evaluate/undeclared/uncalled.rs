//! Undeclared names that a macro would declare that has not been called: `#macro Init() #declare R = 3;
//! #end`.

use std::rc::Rc;

use crate::diagnostic::Diagnostic;
use crate::evaluate::expand::Macro;
use crate::evaluate::{Evaluator, Symbol};
use crate::source::Span;
use crate::syntax::ast::{DirectiveKind, ItemKind};
use crate::vocabulary::is_standard_source;

impl Evaluator<'_> {
    /// Adds to the diagnostic which of the author's macros would declare a name.
    pub(super) fn by_uncalled_macro(&self, symbol: Symbol, told: Diagnostic) -> Diagnostic {
        let declares = |declared: &&Rc<Macro>| self.declared_in_body(declared, symbol).is_some();
        let Some(found) = self.macros.iter().rev().find(declares) else { return told };
        let Some(place) = self.declared_in_body(found, symbol) else { return told };
        if is_standard_source(&self.sources.get(found.defined.file).name) {
            return told;
        }
        let owner = self.sources.text(found.defined);
        told.also(place, format!("macro `{owner}` declares it, when it is called"))
            .help(format!("call it before: `{}`", self.form(found)))
    }

    /// Returns the span of a name's `#declare` in a macro's body.
    fn declared_in_body(&self, declared: &Macro, symbol: Symbol) -> Option<Span> {
        let (unit, body) = declared.parts()?;
        unit.ast.items(body).iter().find_map(|item| {
            let ItemKind::Directive(id) = item.kind else { return None };
            match &unit.ast.directive(id).kind {
                DirectiveKind::Declare { local: false, target }
                    if unit.symbols[target.name.0 as usize] == symbol
                        && target.indices.is_empty() =>
                {
                    Some(target.span)
                }
                _ => None,
            }
        })
    }
}
