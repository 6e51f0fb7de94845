//! Assignments to what does not exist yet: an element of an array, `#declare Points[0] = <0, 0, 0>;`, or the
//! normal of `trace(Object, A, B, Normal)`.

use crate::diagnostic::{Code, Diagnostic, suggest};
use crate::evaluate::value::Value;
use crate::evaluate::{Evaluator, Here, Reported, Symbol};
use crate::source::Span;
use crate::syntax::ast::DirectiveKind;

impl Evaluator<'_> {
    /// Reports an assignment to an element of an array that does not exist, with no similar name either.
    pub(in crate::evaluate) fn array_missing(
        &mut self,
        here: &Here,
        symbol: Symbol,
        target: Span,
    ) -> Reported {
        let name = self.scopes.name(symbol).to_owned();
        let ast = &here.unit.ast;
        let declares = |kind: &DirectiveKind| match kind {
            DirectiveKind::Declare { target, .. } => {
                here.symbol(target.name) == symbol && target.indices.is_empty()
            }
            _ => false,
        };
        let is_near = suggest::closest(&name, self.scopes.visible()).is_some();
        let is_known = self.scopes.declared(symbol).is_some()
            || ast.directives.iter().any(|directive| declares(&directive.kind));
        if is_near || is_known {
            let end = target.start + name.len() as u32;
            return self.undeclared(here, symbol, Span { end, ..target });
        }
        let size = self.size_of_elements(&name, target);
        let array = match size {
            Some(size) => format!("#declare {name} = array[{size}];"),
            None => format!("#declare {name} = array[10];"),
        };
        let told = Diagnostic::new(Code::UndeclaredName, format!("`{name}` is not declared"))
            .at(target, "an array is declared before its elements are set")
            .help(match size {
                Some(_) => format!("write `{array}` before it"),
                None => format!("write such as `{array}` before it"),
            });
        // In a loop or a macro it would be made again each time.
        let once = self.in_main() && self.frames.len() == 1;
        let told = match self.before_line(target).filter(|_| once && size.is_some()) {
            Some((place, blanks)) => told.fix(place, format!("{array}\n{blanks}")),
            None => told,
        };
        let reported = self.report(here, told);
        self.scopes.assign(symbol, Value::Broken);
        self.assumed.push(symbol);
        reported
    }

    /// Returns the size that an array needs, if all its indices in this file are literal.
    fn size_of_elements(&self, name: &str, target: Span) -> Option<u32> {
        let text = &self.sources.get(target.file).text;
        let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
        let mut size = 0;
        for (at, _) in text.match_indices(name) {
            let rest = text[at + name.len()..].trim_start();
            let Some(index) = rest.strip_prefix('[').filter(|_| !text[..at].ends_with(is_part))
            else {
                continue;
            };
            let (index, behind) = index.split_once(']')?;
            if behind.starts_with('[') {
                return None;
            }
            size = size.max(index.trim().parse::<u32>().ok()?.checked_add(1)?);
        }
        Some(size)
    }

    /// Reports the undeclared normal of `trace(Object, A, B, Normal)`.
    pub(in crate::evaluate) fn normal_missing(&mut self, here: &Here, symbol: Symbol, span: Span) {
        let name = self.scopes.name(symbol).to_owned();
        if suggest::closest(&name, self.scopes.visible()).is_some() {
            self.undeclared(here, symbol, span);
            return;
        }
        let right = format!("#declare {name} = <0, 0, 0>;");
        let told = Diagnostic::new(Code::UndeclaredName, format!("`{name}` is not declared"))
            .at(span, "what receives the normal is declared before")
            .help(format!("write `{right}` before it"));
        let told = match self.before_line(span) {
            Some((place, blanks)) => told.fix(place, format!("{right}\n{blanks}")),
            None => told,
        };
        self.report(here, told);
    }

    /// Returns the start of the line of a position, and its indentation, if the line begins with a directive.
    fn before_line(&self, place: Span) -> Option<(Span, String)> {
        let before = self.sources.get(place.file).text.get(..place.start as usize)?;
        let start = before.rfind(['\n', '\r']).map_or(0, |at| at + 1);
        let line = &before[start..];
        let blanks = &line[..line.len() - line.trim_start().len()];
        let at = start + blanks.len();
        let begins = line.trim_start().starts_with('#');
        begins.then(|| (Span::new(place.file, at, at), blanks.to_owned()))
    }
}
