//! Valid ranges for the numbers of unsupported items, and of patterns.
//!
//! **Source:** what POV-Ray 3.7 refuses, tested number by number; manual, 3.4.3.3 "Radiosity", 3.4.7.6
//! "Pattern Modifiers", 3.4.8.1 "Media".

use crate::diagnostic::{Code, Diagnostic};
use crate::vocabulary::{Dialect, Word};

use super::super::super::Evaluator;
use super::super::super::stream::Token;
use super::super::part::Given;

/// A valid range, and its description.
pub(super) struct Range {
    holds: fn(f64) -> bool,
    wanted: &'static str,
}

const POSITIVE: Range = Range { holds: |n| n > 0.0, wanted: "a positive number" };
const ONE_OR_MORE: Range = Range { holds: |n| n >= 1.0, wanted: "1 or more" };
const UP_TO_20: Range = Range { holds: |n| (1.0..=20.0).contains(&n), wanted: "from 1 to 20" };
const UP_TO_1: Range = Range { holds: |n| n > 0.0 && n <= 1.0, wanted: "above 0, and 1 or less" };
const NOT_NEGATIVE: Range = Range { holds: |n| n >= 0.0, wanted: "0 or more" };

/// Returns the range of the first number after an item of a block.
pub(super) fn of_item(item: Word, block: Word) -> Option<Range> {
    use Word as W;
    Some(match (block, item) {
        (W::Radiosity, W::RecursionLimit | W::NearestCount) => UP_TO_20,
        (W::Radiosity, W::PretraceStart | W::PretraceEnd) => UP_TO_1,
        (W::Radiosity, W::MinimumReuse) => NOT_NEGATIVE,
        (W::Radiosity, W::GrayThreshold) => {
            Range { holds: |n| (0.0..=1.0).contains(&n), wanted: "from 0 to 1" }
        }
        (
            W::Radiosity,
            W::Count
            | W::ErrorBound
            | W::Brightness
            | W::AdcBailout
            | W::MaximumReuse
            | W::LowErrorFactor,
        ) => POSITIVE,
        (W::Media, W::Intervals | W::Samples | W::AaLevel) => ONE_OR_MORE,
        (W::Media, W::AaThreshold) => POSITIVE,
        (W::Media, W::Method) => Range { holds: |n| (1.0..4.0).contains(&n), wanted: "1, 2 or 3" },
        (W::Media, W::Confidence) => {
            Range { holds: |n| (0.0..1.0).contains(&n), wanted: "0 or more, and less than 1" }
        }
        (W::Photons, W::Target | W::Media) => NOT_NEGATIVE,
        _ => return None,
    })
}

/// Returns the range of the number after a modifier of a pattern or of an interior.
fn of_modifier(word: Word) -> Option<Range> {
    Some(match word {
        Word::Tiling => {
            Range { holds: |n| (1.0..28.0).contains(&n), wanted: "a number from 1 to 27" }
        }
        Word::DispersionSamples => Range { holds: |n| n >= 2.0, wanted: "2 or more" },
        Word::NumberOfSides => {
            Range { holds: |n| [3.0, 4.0, 6.0].contains(&n), wanted: "3, 4 or 6" }
        }
        Word::NumberOfTiles => Range { holds: |n| (1.0..=6.0).contains(&n), wanted: "from 1 to 6" },
        _ => return None,
    })
}

/// Returns the range of the number by which a fractal pattern chooses a formula.
fn of_fractal(word: Word) -> Option<Range> {
    Some(match word {
        Word::Exterior => Range { holds: |n| n > -1.0 && n < 9.0, wanted: "a type from 0 to 8" },
        Word::Interior => Range { holds: |n| n > -1.0 && n < 7.0, wanted: "a type from 0 to 6" },
        Word::Magnet => Range { holds: |n| (1.0..3.0).contains(&n), wanted: "1 or 2" },
        _ => return None,
    })
}

impl Evaluator<'_> {
    /// Reports a number that is invalid after `word`, except the 0 of `0,04`, which is reported as such.
    pub(super) fn within(&mut self, given: &Given<f64>, word: Word, range: &Range) {
        let text = &self.sources.get(given.span.file).text;
        let mut behind = text.get(given.span.end as usize..).unwrap_or("").chars();
        let is_whole =
            behind.next() != Some(',') || !behind.next().is_some_and(|c| c.is_ascii_digit());
        // Those POV-Ray 3.7 warns of (measured).
        let is_rendered = self.options.dialect == Dialect::Pov && word == Word::Target;
        if is_whole && !is_rendered && !(range.holds)(given.value) {
            self.out_of_range(given, word, range.wanted);
        }
    }

    /// As [`Self::within`], for a modifier of a pattern or of an interior.
    pub(in crate::evaluate::block) fn within_bounds(&mut self, given: &Given<f64>, word: Word) {
        if word == Word::Tiling && (25.0..28.0).contains(&given.value) {
            let diagnostic = Diagnostic::new(
                Code::NotSupportedYet,
                "the Penrose tilings, 25 to 27, are not supported yet",
            );
            let told = diagnostic
                .at(given.span, "expected 24 or less")
                .help("the other tilings are 1 to 24");
            self.report(&given.here, told);
        } else if let Some(range) = of_modifier(word) {
            self.within(given, word, &range);
        }
    }

    /// Reports the number of a formula that a fractal pattern does not have.
    pub(in crate::evaluate::block) fn within_formulas(&mut self, given: &Given<f64>, word: Word) {
        if let Some(range) = of_fractal(word)
            && !(range.holds)(given.value)
        {
            self.out_of_range(given, word, range.wanted);
        }
    }

    /// Reads the number after an unsupported modifier; returns `false` if the modifier has no range.
    pub(super) fn modifier_not_built(&mut self, token: &Token, word: Word) -> bool {
        if of_modifier(word).is_none() || !self.is_before_value() {
            return false;
        }
        let outer = self.poison.take();
        if let Ok(given) = self.number_after(token, "a number") {
            self.within_bounds(&given, word);
        }
        self.poison = outer;
        true
    }
}
