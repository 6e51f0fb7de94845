//! `irid { amount thickness … turbulence … }` in a finish: a thin film.

use crate::evaluate::block::parts::{Block, Part, Parts};
use crate::evaluate::block::range::Range;
use crate::evaluate::block::{Given, Place};
use crate::evaluate::stream::Token;
use crate::evaluate::{Evaluator, Outcome};
use crate::scene::Irid;
use crate::vocabulary::Word;

impl Block for Irid {
    const PLACE: Place = Place::IRID;
    const PARTS: Parts<Self> = &[
        Part::Number(Word::Thickness, |irid, thickness, _| irid.thickness = thickness),
        Part::Special(Word::Turbulence, |evaluator, token, irid| {
            let given = evaluator.given(token, "a number")?;
            let numbers = given.value.numbers();
            let Some(&[first, ..]) = numbers.as_ref().map(|numbers| numbers.as_slice()) else {
                let Given { here, span, value, .. } = &given;
                return Err(evaluator.wrong_type(here, *span, "a number", value));
            };
            irid.turbulence = first;
            Ok(())
        }),
    ];
}

impl Evaluator<'_> {
    /// Reads `irid`. What is not specified keeps its value from `before`, a negative amount has no effect, and
    /// of a vector of `turbulence` the x counts alone, as in POV-Ray 3.7 (measured).
    pub(super) fn irid(&mut self, token: &Token, before: Option<Irid>) -> Outcome<Irid> {
        let generator = self.noise;
        let opener = token.clone();
        self.block(token, Word::Irid, |evaluator| {
            let range = Range::NOT_NEGATIVE.but("it has no effect", |amount| amount);
            let amount = evaluator.number_in(&opener, Word::Irid, &range)?;
            let (thickness, turbulence) =
                before.map_or((0.0, 0.0), |irid| (irid.thickness, irid.turbulence));
            let mut irid = Irid { amount, thickness, turbulence, generator };
            evaluator.parts(&mut irid)?;
            Ok(irid)
        })
    }
}
