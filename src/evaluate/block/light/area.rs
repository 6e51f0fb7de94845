//! `area_light` and the words that belong to it.

use crate::diagnostic::{Code, Diagnostic};
use crate::math::Vector;
use crate::scene::{Area, LightSource, Modifier};
use crate::vocabulary::Word;

use super::super::super::stream::{Token, TokenKind};
use super::super::super::{Evaluator, Outcome, Reported};
use super::super::Given;
use super::super::range::Range;
use super::{Written, transforms_of};

/// The numbers of lights along a side.
const NODES: Range = Range::new(|n| n >= 1.0, "1 or more");

/// The most lights of a grid: what comes from each of them to a place is kept.
const MOST_NODES: f64 = 1e6;

impl Evaluator<'_> {
    /// Reads a word of area lights, and what belongs to it.
    pub(super) fn area_word(
        &mut self,
        token: &Token,
        word: Word,
        light: Option<&mut LightSource>,
        modifiers: &[Modifier],
        written: &mut Written,
    ) -> Outcome<()> {
        let mut nowhere = Area::default();
        let area = light.map_or(&mut nowhere, |light| &mut light.area);
        match word {
            Word::AreaLight => {
                let Ok((sides, nodes)) = self.grid(token) else {
                    self.skip_values();
                    return Err(Reported);
                };
                (area.sides, area.nodes) = (sides, nodes);
                area.sides_after = transforms_of(modifiers);
                area.site = Some(self.whole(token));
            }
            Word::Adaptive => {
                // POV-Ray 3.7 takes a negative number for 0 (measured).
                let range = &Range::ZERO_IF_NEGATIVE;
                area.adaptive = Some(self.number_in(token, word, range)? as u32);
            }
            Word::AreaIllumination => area.illuminates = self.optional_flag(token)?,
            Word::Jitter => area.jitter = true,
            Word::Circular => {
                area.circular = true;
                written.round_area = Some(token.clone());
            }
            _ => {
                area.orient = true;
                written.round_area = Some(token.clone());
            }
        }
        Ok(())
    }

    /// Reads two sides, and the numbers of lights along them.
    fn grid(&mut self, token: &Token) -> Outcome<([Vector; 2], [u32; 2])> {
        let first = self.vector_after(token, "a vector for one side")?.value;
        let second = self.vector_after(token, "a vector for the other side")?.value;
        let (m, _) = self.nodes(token, "a number of lights along the first side")?;
        let (n, given) = self.nodes(token, "a number of lights along the second side")?;
        let all = f64::from(m) * f64::from(n);
        if all > MOST_NODES {
            let wanted = "a million lights or less, along both sides together";
            return Err(self.out_of_range(&given.with(all), Word::AreaLight, wanted));
        }
        Ok(([first, second], [m, n]))
    }

    fn nodes(&mut self, token: &Token, wanted: &str) -> Outcome<(u32, Given<f64>)> {
        let given = self.number_after(token, wanted)?;
        self.ranged(&given, Word::AreaLight, &NODES)?;
        Ok((self.counted(&given) as u32, given))
    }

    /// Checks the shape of an area light, after all of its words.
    ///
    /// **Source:** measured on POV-Ray 3.7: it refuses a `circular` light with one light along a side; an `orient`
    /// light has the length of its first side along both.
    pub(super) fn doubt_area(&mut self, light: &LightSource, written: &Written) -> Outcome<()> {
        let Some(token) = &written.round_area else { return Ok(()) };
        let area = &light.area;
        if area.site.is_none() {
            let name = self.describe(token);
            let message = format!("{name} does nothing without an `area_light`");
            let diagnostic = Diagnostic::new(Code::UnlikelyLight, message)
                .at(token.span, "expected an `area_light` beside it");
            self.report(&token.here, diagnostic);
            return Ok(());
        }
        if area.nodes.contains(&1) {
            if !area.circular {
                return Ok(());
            }
            let message = "a `circular` light needs more than one light along each side";
            let diagnostic = Diagnostic::new(Code::OutOfRange, message)
                .at(token.span, "expected numbers of 2 or more in its `area_light`");
            return Err(self.report(&token.here, diagnostic));
        }
        let [first, second] = area.sides.map(|side| side.length());
        if area.orient && (first - second).abs() > 1e-6 * first.max(second) {
            let message = "the sides of an `orient` light have the length of the first";
            let diagnostic = Diagnostic::new(Code::UnlikelyLight, message)
                .at(token.span, format!("the lengths of its sides are {first} and {second}"));
            self.report(&token.here, diagnostic);
        }
        Ok(())
    }
}

/// Returns the word if it belongs to area lights.
pub(super) fn word_of_area(token: &Token) -> Option<Word> {
    match token.kind {
        TokenKind::Word(
            word @ (Word::AreaLight
            | Word::Adaptive
            | Word::AreaIllumination
            | Word::Jitter
            | Word::Circular
            | Word::Orient),
        ) => Some(word),
        _ => None,
    }
}
