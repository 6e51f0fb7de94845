//! Numbers restricted to a range, and the diagnostics for those outside it.

use crate::color::Gamma;
use crate::diagnostic::{Code, Diagnostic};
use crate::vocabulary::{Dialect, Word};

use super::super::stream::Token;
use super::super::{Evaluator, Outcome, Reported};
use super::Given;

/// The numbers that a word accepts.
pub(super) struct Range {
    holds: fn(f64) -> bool,
    /// Describes them.
    wanted: &'static str,
    /// How POV-Ray reads other numbers; `None` if they are errors.
    read: Option<&'static str>,
    /// What they become.
    replaced: fn(f64) -> f64,
}

impl Range {
    pub const POSITIVE: Self = Self::new(|n| n > 0.0, "more than 0");
    pub const NOT_NEGATIVE: Self = Self::new(|n| n >= 0.0, "0 or more");
    pub const ZERO_IF_NEGATIVE: Self = Self::NOT_NEGATIVE.but("it is 0", |_| 0.0);

    /// Returns a range beyond which all numbers are errors.
    pub const fn new(holds: fn(f64) -> bool, wanted: &'static str) -> Self {
        Self { holds, wanted, read: None, replaced: |n| n }
    }

    /// Returns this range for a word whose other numbers POV-Ray accepts, `read` so.
    pub const fn but(self, read: &'static str, replaced: fn(f64) -> f64) -> Self {
        Self { read: Some(read), replaced, ..self }
    }
}

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

    /// Reads a number in a range.
    pub(super) fn number_in(&mut self, after: &Token, word: Word, range: &Range) -> Outcome<f64> {
        let given = self.number_after(after, "a number")?;
        let number = self.ranged(&given, word, range)?;
        self.lint_highlight(&given, word);
        Ok(number)
    }

    /// Returns the number, or what it becomes if it is not in its range.
    pub(super) fn ranged(&mut self, given: &Given<f64>, word: Word, range: &Range) -> Outcome<f64> {
        if (range.holds)(given.value) {
            return Ok(given.value);
        }
        let Some(read) = range.read else {
            return Err(self.out_of_range(given, word, range.wanted));
        };
        self.out_of_range_but_read(given, word, range.wanted, read)?;
        Ok((range.replaced)(given.value))
    }

    /// Reads `srgb`, or an exponent.
    pub(super) fn gamma_after(&mut self, after: &Token, word: Word) -> Outcome<Gamma> {
        match self.take_word(Word::Srgb) {
            Some(_) => Ok(Gamma::Srgb),
            None => self.number_in(after, word, &Range::POSITIVE).map(Gamma::Power),
        }
    }
}
