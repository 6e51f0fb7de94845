//! Patterns whose values come from elsewhere: an object, how the surface lies, a file of a grid.

use std::collections::HashMap;
use std::rc::Rc;
use std::sync::Arc;

use super::OpenPattern;
use crate::diagnostic::{Code, Diagnostic};
use crate::evaluate::block::named::NamedFile;
use crate::evaluate::include::missing_file;
use crate::evaluate::stream::Token;
use crate::evaluate::value::Value;
use crate::evaluate::{Evaluator, Outcome, Reported};
use crate::math::Vector;
use crate::scene::Source;
use crate::texture::density::{Grid, Interpolation};
use crate::texture::slope::{Slope, Toward};
use crate::vocabulary::Word;

/// Grids that were read, by the names of their files.
pub(in crate::evaluate) type Grids = Rc<HashMap<String, Arc<Grid>>>;

impl Evaluator<'_> {
    /// Reads `object { sphere { … } … }` as a pattern: 0 outside of the object, and 1 inside. `list` reads
    /// what follows the object in the block.
    pub(in crate::evaluate::block) fn object_pattern<T>(
        &mut self,
        token: &Token,
        list: impl FnOnce(&mut Self, &Source) -> Outcome<T>,
    ) -> Outcome<(Source, T)> {
        self.block(token, Word::Object, |evaluator| {
            let Some(first) = evaluator.next() else {
                return Err(evaluator.expected("an object", None, (&token.here, token.span)));
            };
            let object = match evaluator.value_of(&first)? {
                Value::Object(object) => object,
                Value::Poison(poison) => {
                    evaluator.set_poison(poison);
                    return Err(Reported);
                }
                value => {
                    return Err(evaluator.wrong_type(&first.here, first.span, "an object", &value));
                }
            };
            let source = Source::Object(evaluator.region(&token.here, token.span, object)?);
            let list = list(evaluator, &source)?;
            evaluator.skip_commas();
            match evaluator.peek().cloned() {
                Some(rest) => {
                    let wanted = "the end of the block";
                    Err(evaluator.expected(wanted, Some(&rest), (&rest.here, rest.span)))
                }
                None => Ok((source, list)),
            }
        })
    }

    /// Reads `slope { <direction>, low, high altitude <up>, low, high }`, or `slope <direction>` alone.
    pub(super) fn slope(&mut self, token: &Token) -> Outcome<Source> {
        if !self.is_before_block() {
            let direction = self.vector_after(token, "a direction")?.value;
            return Ok(Source::Slope(of_direction(direction)));
        }
        self.block(token, Word::Slope, |evaluator| {
            let mut slope = match evaluator.take_word(Word::PointAt) {
                Some(word) => {
                    let point = evaluator.vector_after(&word, "a point")?.value;
                    Slope { toward: Toward::Point(point), ..of_direction(Vector::Y) }
                }
                None => of_direction(evaluator.vector_after(token, "a direction")?.value),
            };
            if evaluator.is_before_value() {
                slope.slopes = evaluator.range(token, "the lowest slope", "the highest slope")?;
            }
            if let Some(word) = evaluator.take_word(Word::Altitude) {
                slope.altitude = evaluator.vector_after(&word, "a direction")?.value;
                if evaluator.is_before_value() {
                    let (low, high) = ("the lowest altitude", "the highest altitude");
                    slope.altitudes = evaluator.range(&word, low, high)?;
                }
            }
            evaluator.skip_commas();
            match evaluator.peek().cloned() {
                Some(rest) => {
                    let wanted = "`altitude`, or the end of the block";
                    Err(evaluator.expected(wanted, Some(&rest), (&rest.here, rest.span)))
                }
                None => Ok(Source::Slope(slope)),
            }
        })
    }

    fn range(&mut self, token: &Token, low: &str, high: &str) -> Outcome<[f64; 2]> {
        let low = self.number_after(token, low)?.value;
        Ok([low, self.number_after(token, high)?.value])
    }

    /// Reads `density_file df3 "name" [interpolate n]`.
    pub(super) fn density_file(&mut self, token: &Token) -> Outcome<Source> {
        self.take_word(Word::Df3);
        let file = self.named_file(token, "the name of a grid's file")?;
        let NamedFile { name, here, span } = &file;
        let found = match self.read_named(&file, &[".df3"]) {
            Ok(found) => found,
            Err(error) => {
                let diagnostic = missing_file(name, *span, error, |_| false);
                self.report(here, diagnostic);
                return self.pass_interpolation();
            }
        };
        if let Some(known) = self.grids.get(&found.name) {
            return Ok(Source::Density(known.clone()));
        }
        let grid = match Grid::read(&found.bytes) {
            Ok(grid) => Arc::new(grid),
            Err(reason) => {
                let message = format!("`{name}` cannot be read as a grid: {reason}");
                let diagnostic = Diagnostic::new(Code::UnreadableFile, message)
                    .at(*span, "expected a df3: three sizes, and a value for each cell");
                self.report(here, diagnostic);
                return self.pass_interpolation();
            }
        };
        self.stored += 4 * found.bytes.len() as u64;
        Rc::make_mut(&mut self.grids).insert(found.name, grid.clone());
        Ok(Source::Density(grid))
    }

    /// Skips the `interpolate n` of a grid that could not be read.
    fn pass_interpolation(&mut self) -> Outcome<Source> {
        if let Some(word) = self.take_word(Word::Interpolate) {
            self.number_after(&word, "0, 1 or 2")?;
        }
        Err(Reported)
    }

    /// Reads `interpolate n` of a `density_file`; `None` where no such pattern was chosen.
    pub(super) fn interpolation(
        &mut self,
        token: &Token,
        open: &mut OpenPattern,
    ) -> Option<Outcome<()>> {
        let Some((Source::Density(grid), _)) = &mut open.chosen else { return None };
        Some(self.number_after(token, "0, 1 or 2").map(|given| {
            Arc::make_mut(grid).interpolation = Interpolation::of_number(given.value);
        }))
    }
}

fn of_direction(direction: Vector) -> Slope {
    Slope {
        toward: Toward::Direction(direction),
        slopes: [0.0, 1.0],
        altitude: Vector::ZERO,
        altitudes: [0.0, 1.0],
    }
}
