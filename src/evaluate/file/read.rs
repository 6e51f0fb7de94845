//! `#read`: reads values from an open file into names and array elements.

use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::syntax::ast::{NameId, Target};
use crate::vocabulary::Dialect;

use super::super::scope::Owner;
use super::super::value::Value;
use super::super::{Evaluator, Here, Outcome};
use super::data::{Datum, Fault, datum};
use super::{Closed, State};

impl Evaluator<'_> {
    /// Runs `#read (Name, a, b[1], …)`. Past the end of the file nothing is assigned.
    pub(in crate::evaluate) fn read_values(
        &mut self,
        here: &Here,
        name: (NameId, Span),
        targets: &[Target],
    ) -> Outcome<()> {
        let outcome = self.read_each(here, name, targets);
        if outcome.is_err() {
            for target in targets.iter().filter(|target| target.indices.is_empty()) {
                let symbol = here.symbol(target.name);
                if self.scopes.read(symbol).is_none() {
                    self.scopes.assign(symbol, Value::Broken);
                }
            }
        }
        outcome
    }

    fn read_each(&mut self, here: &Here, name: (NameId, Span), targets: &[Target]) -> Outcome<()> {
        let handle = self.opened(here, name)?;
        for (n, target) in targets.iter().enumerate() {
            let (file, at) = match &self.opened[handle.0 as usize].state {
                State::Reading { file, at } => (*file, *at),
                State::Closed { .. } => {
                    self.lint_short_file(here, name.1, target.span);
                    return Ok(());
                }
                State::Writing { .. } => {
                    return Err(self.other_way(here, handle, name.1, "write", "read"));
                }
            };
            // POV-Ray 3.7 ignores any sign after a value (measured).
            let commas = match self.options.dialect {
                Dialect::Scene => &[','][..],
                Dialect::Pov => &[',', ';'],
            };
            let read = datum(&self.sources.get(file).text, at, commas);
            let Datum { value, next, ends } = match read {
                Ok(Some(datum)) => datum,
                Ok(None) => {
                    self.end_file(handle, Closed::End, here.site(name.1));
                    if n > 0 {
                        self.lint_short_file(here, name.1, target.span);
                    }
                    return Ok(());
                }
                Err(Fault { code, at, message, label }) => {
                    self.end_file(handle, Closed::Fault, here.site(name.1));
                    let diagnostic = Diagnostic::new(code, message)
                        .at(Span::new(file, at.start, at.end), label)
                        .also(target.span, "to be read into this");
                    return Err(self.report(here, diagnostic));
                }
            };
            self.opened[handle.0 as usize].state = State::Reading { file, at: next };
            if ends {
                self.end_file(handle, Closed::End, here.site(target.span));
            }
            self.set_target(here, target, value)?;
        }
        Ok(())
    }

    /// Warns if the file ends in the middle of values that are read together.
    fn lint_short_file(&mut self, here: &Here, name: Span, target: Span) {
        let [name, text] = [name, target].map(|span| self.sources.text(span).to_owned());
        let message = format!("`{name}` ends before there is a value for `{text}`");
        let diagnostic = Diagnostic::new(Code::ShortFile, message)
            .at(target, "nothing is read into this, nor into what follows")
            .help("the number of values in the file is no multiple of those read together");
        self.report(here, diagnostic);
    }

    fn set_target(&mut self, here: &Here, target: &Target, value: Value) -> Outcome<()> {
        if !target.indices.is_empty() {
            let indices = self.target_indices(here, target);
            return self.assign_element(here, target, indices, Ok(value));
        }
        let symbol = here.symbol(target.name);
        match self.scopes.read(symbol) {
            None
            | Some(
                Value::Number(_)
                | Value::Vector(_)
                | Value::Color(_)
                | Value::String(_)
                | Value::Poison(_)
                | Value::Broken,
            ) => {}
            Some(other) => {
                let message = format!(
                    "`{}` is {}, and cannot be read into",
                    self.sources.text(target.span),
                    other.kind()
                );
                let label = "expected a new name, or that of a number, vector or string";
                let mut diagnostic =
                    Diagnostic::new(Code::WrongType, message).at(target.span, label);
                if let Some(declared) = self.scopes.declared(symbol) {
                    diagnostic = diagnostic.also(declared.site.span, "declared here");
                }
                return Err(self.report(here, diagnostic));
            }
        }
        // Values that a scene does not need must be read, too.
        self.scopes.note_declaration(symbol, here.site(target.span), Owner::Other);
        self.scopes.assign(symbol, value);
        Ok(())
    }
}
