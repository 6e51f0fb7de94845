//! Numbers restricted to a range, and the diagnostics for those outside it.

use crate::diagnostic::{Code, Diagnostic};
use crate::vocabulary::{Dialect, Word};

use super::super::stream::Token;
use super::super::{Evaluator, Outcome, Reported};
use super::Given;

impl Evaluator<'_> {
    /// Reports a number outside its valid range.
    pub(in crate::evaluate) fn out_of_range(
        &mut self,
        given: &Given<f64>,
        word: Word,
        wanted: &str,
    ) -> Reported {
        let diagnostic = self.outside(given, word, wanted);
        self.report(&given.here, diagnostic)
    }

    /// Reports a number outside its valid range that POV-Ray accepts; `read` describes the value it uses.
    pub(in crate::evaluate) fn out_of_range_but_read(
        &mut self,
        given: &Given<f64>,
        word: Word,
        wanted: &str,
        read: &str,
    ) -> Outcome<()> {
        let diagnostic = self.outside(given, word, wanted);
        let diagnostic = match self.options.dialect {
            Dialect::Scene => diagnostic,
            Dialect::Pov => diagnostic.help(format!("as in POV-Ray, {read}")),
        };
        self.opinion(&given.here, diagnostic)
    }

    pub(super) fn outside(&self, given: &Given<f64>, word: Word, wanted: &str) -> Diagnostic {
        let diagnostic = Diagnostic::new(
            Code::OutOfRange,
            format!("`{}` is {}, and must be {wanted}", word.name(), given.value),
        )
        .at(given.span, format!("expected {wanted}"));
        let typed = self.sources.text(given.span).strip_prefix('-').map(str::trim);
        match typed.filter(|typed| typed.parse() == Ok(-given.value)) {
            Some(right) if wanted.ends_with("0 or more") || wanted == "more than 0" => {
                diagnostic.help(format!("is `{right}` meant?"))
            }
            _ => diagnostic,
        }
    }

    pub(super) fn at_least_zero(&mut self, after: &Token, word: Word) -> Outcome<f64> {
        let given = self.number_after(after, "a number")?;
        if given.value < 0.0 {
            return Err(self.out_of_range(&given, word, "0 or more"));
        }
        self.lint_highlight(&given, word);
        Ok(given.value)
    }

    pub(super) fn more_than_zero(&mut self, after: &Token, word: Word) -> Outcome<f64> {
        let given = self.number_of(after, word)?;
        self.lint_highlight(&given, word);
        Ok(given.value)
    }

    /// Reads a number above zero.
    pub(in crate::evaluate) fn number_of(
        &mut self,
        after: &Token,
        word: Word,
    ) -> Outcome<Given<f64>> {
        let given = self.number_after(after, "a number")?;
        if given.value <= 0.0 {
            return Err(self.out_of_range(&given, word, "more than 0"));
        }
        Ok(given)
    }
}
