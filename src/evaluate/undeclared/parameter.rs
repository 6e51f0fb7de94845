//! Suggestions of parameters for an undeclared name: those of the enclosing function, or of a macro
//! elsewhere.

use std::rc::Rc;

use crate::evaluate::expand::Macro;
use crate::evaluate::{Evaluator, Symbol};
use crate::source::Span;
use crate::vocabulary::{Word, is_standard_source};

impl Evaluator<'_> {
    /// Returns the parameters of the enclosing function as written; without any, its implicit ones.
    pub(super) fn parameters_around(&self, place: Span) -> Option<String> {
        let before = self.sources.get(place.file).text.get(..place.start as usize)?;
        let head = before.rfind("function")?;
        let behind = before[head + "function".len()..].trim_start();
        let (written, formula) = match behind.strip_prefix('(') {
            Some(rest) => rest.split_once(')').map(|(names, rest)| (Some(names), rest))?,
            None => (None, behind),
        };
        let depth = formula.matches('{').count().checked_sub(formula.matches('}').count())?;
        if depth != 1 || !formula.trim_start().starts_with('{') {
            return None;
        }
        let own = match written {
            Some(names) => names.to_owned(),
            None if self.is_opened_by(Word::Parametric) => "u, v".to_owned(),
            None => "x, y, z".to_owned(),
        };
        let names: Vec<String> = own.split(',').map(|name| format!("`{}`", name.trim())).collect();
        Some(names.join(", "))
    }

    /// Returns a macro with a parameter of this name, and the parameter's span.
    pub(super) fn macro_with_parameter(&self, symbol: Symbol) -> Option<(String, Span)> {
        let has =
            |declared: &&Rc<Macro>| declared.parameters.iter().any(|&(name, _)| name == symbol);
        let found = self.macros.iter().rev().find(has)?;
        if is_standard_source(&self.sources.get(found.defined.file).name) {
            return None;
        }
        let owner = self.sources.text(found.defined).to_owned();
        Some((owner, found.defined))
    }

    fn is_opened_by(&self, word: Word) -> bool {
        self.openers.iter().rev().any(|opener| self.sources.text(*opener) == word.name())
    }
}
