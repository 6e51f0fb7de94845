//! Map entries in descending order, or outside the range of a pattern's values.

use super::is_literal;
use crate::diagnostic::{Code, Diagnostic};
use crate::evaluate::Evaluator;
use crate::evaluate::block::Given;
use crate::source::{Site, Sources};
use crate::vocabulary::Word;

/// Distance outside 0 to 1 at which an entry only closes the map: `[1.001 …]` is an old habit.
const BEYOND: f64 = 0.05;
/// Maximum number of literal values that are kept, to suggest dividing them by a hundred.
const MOST_PERCENTAGES: usize = 64;

/// The values of a map's entries, collected while they are read.
#[derive(Default)]
pub(in crate::evaluate) struct Rise {
    last: Option<f64>,
    /// The first value that is below the one before it, and that one.
    fall: Option<(f64, f64, Site)>,
    /// The literal values, up to `MOST_PERCENTAGES`.
    literal: Vec<Given<f64>>,
    computed: bool,
}

impl Rise {
    pub fn entry(&mut self, given: Given<f64>, sources: &Sources) {
        self.value(given.value, given.site());
        match is_literal(sources.text(given.span)) && self.literal.len() < MOST_PERCENTAGES {
            true => self.literal.push(given),
            false => self.computed = true,
        }
    }

    /// Records all entries of a declared map.
    pub fn named(&mut self, values: impl Iterator<Item = f64>, site: Site) {
        self.computed = true;
        values.for_each(|value| self.value(value, site));
    }

    fn value(&mut self, value: f64, site: Site) {
        if let Some(last) = self.last.replace(value)
            && value < last
        {
            self.fall.get_or_insert((last, value, site));
        }
    }
}

impl Evaluator<'_> {
    pub(in crate::evaluate) fn lint_map(&mut self, rise: Rise, map: Word) {
        let within = -BEYOND..=1.0 + BEYOND;
        let outside = rise.literal.iter().find(|given| !within.contains(&given.value));
        // A descent from beyond 1 is reported as out of range first.
        let is_high = |before: f64| outside.is_some_and(|given| given.value == before);
        let (fall, code) = match rise.fall {
            Some((before, ..)) if before > 1.0 && is_high(before) => (None, Code::UnsortedMap),
            fall => (fall, Code::MapRange),
        };
        if let Some((before, after, site)) = fall {
            let message =
                format!("the entries of this `{}` go down from {before} to {after}", map.name());
            let diagnostic = Diagnostic::new(Code::UnsortedMap, message)
                .at(site.span, "expected values that rise from entry to entry")
                .help("POV-Ray reads such a map otherwise than it is written: put the entries in order");
            self.report_in(site.expansion, diagnostic);
        }
        let Some(outside) = outside else { return };
        let message = format!("an entry at {} lies where the pattern has no values", outside.value);
        let mut diagnostic = Diagnostic::new(code, message).at(outside.span, "expected 0 to 1");
        let whole = |given: &Given<f64>| given.value.fract() == 0.0 && given.value >= 0.0;
        let largest = rise.literal.iter().fold(0.0, |most, given| given.value.max(most));
        diagnostic = match largest == 100.0 && !rise.computed && rise.literal.iter().all(whole) {
            true => rise
                .literal
                .iter()
                .filter(|given| given.value > 0.0)
                .fold(diagnostic.help("write parts of 1, not of 100"), |diagnostic, given| {
                    diagnostic.fix(given.span, format!("{}", given.value / 100.0))
                }),
            false => diagnostic.help("a pattern goes from 0 to 1; beyond it colours are cut off"),
        };
        // `[0.4 …] [5 …] [1 …]`: a decimal point was lost.
        let at = rise.literal.iter().position(|given| std::ptr::eq(given, outside)).unwrap_or(0);
        let before = at.checked_sub(1).map_or(0.0, |at| rise.literal[at].value);
        let behind = rise.literal.get(at + 1).map_or(1.0, |given| given.value);
        let text = self.sources.text(outside.span);
        let meant = [10.0, 100.0].into_iter().map(|tenth| outside.value / tenth).find(|meant| {
            before < *meant && *meant < behind && text.bytes().all(|b| b.is_ascii_digit())
        });
        if let Some(meant) = meant.filter(|_| !rise.computed && largest != 100.0) {
            diagnostic = diagnostic.help(format!("did you mean `{meant}`?"));
        }
        let here = outside.here.clone();
        self.report(&here, diagnostic);
    }
}
