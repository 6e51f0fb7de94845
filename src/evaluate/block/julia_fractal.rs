//! `julia_fractal`: its parameter, the algebra and the iterated function, and the slice.

use crate::diagnostic::{Code, Diagnostic};
use crate::scene::{JuliaFractal, Solid};
use crate::syntax::ast::{Callee, ExpressionKind};
use crate::vocabulary::{Role, Word};

use super::super::stream::{Token, TokenKind};
use super::super::{Evaluator, Outcome, Reported};
use super::Given;
use super::range::Range;

/// Items after the parameter, besides the functions.
const ITEMS: &[Word] =
    &[Word::Quaternion, Word::Hypercomplex, Word::MaxIteration, Word::Precision, Word::Slice];

fn is_item(word: Word) -> bool {
    is_function(word) || ITEMS.contains(&word)
}

impl Evaluator<'_> {
    /// Reads a `julia_fractal`: `<x, y, z, w>` first, then the other items in any order.
    pub(super) fn julia_fractal(&mut self, token: &Token) -> Outcome<Solid> {
        // The following items are read for their own mistakes.
        let parameter = self.four_after(token, "a vector of four for the parameter");
        let mut fractal = JuliaFractal::default();
        // The function as written: quaternions support two.
        let mut function = None;
        let mut failed = false;
        loop {
            self.skip_commas();
            let Some(next) = self.peek().cloned() else { break };
            let (item, word) = match &next.kind {
                TokenKind::Word(word) if is_item(*word) => {
                    let word = *word;
                    self.next();
                    (next, word)
                }
                TokenKind::Expression(id) => match next.here.unit.expression(*id).kind {
                    ExpressionKind::Call(Callee::Word(Word::Pwr, _), list) => {
                        self.next();
                        let powers = self.numbers_of(&next.here, list, next.span);
                        failed |= powers.is_err();
                        if let Ok(powers) = powers {
                            failed |= self.power(&next, &powers, &mut fractal).is_err();
                        }
                        function = Some((Word::Pwr, next));
                        continue;
                    }
                    // A misspelt item.
                    _ => match self.next_part(Word::JuliaFractal, ITEMS) {
                        Some(part) => part,
                        None => break,
                    },
                },
                // `sqrt` for `sqr`: another function of the language.
                TokenKind::Word(word) if matches!(word.role(), Role::Function { .. }) => {
                    self.next();
                    let message = format!("`{}` is no function of a `julia_fractal`", word.name());
                    let told = Diagnostic::new(Code::UnknownWord, message)
                        .at(next.span, "expected one such as `sqr` or `cube`");
                    let told = match word {
                        Word::Sqrt => {
                            told.help("did you mean `sqr`, the square?").fix(next.span, "sqr")
                        }
                        _ => told,
                    };
                    self.report(&next.here, told);
                    failed = true;
                    continue;
                }
                _ => break,
            };
            let outcome = match word {
                Word::Quaternion | Word::Hypercomplex => {
                    fractal.hypercomplex = word == Word::Hypercomplex;
                    Ok(())
                }
                Word::MaxIteration => {
                    self.iterations(&item).map(|iterations| fractal.iterations = iterations)
                }
                // Every intersection is found as exactly as rounding allows.
                Word::Precision => self.precision(&item),
                Word::Slice => self.slice(&item, &mut fractal),
                _ => {
                    fractal.function = word;
                    function = Some((word, item));
                    Ok(())
                }
            };
            failed |= outcome.is_err();
        }
        if failed {
            return Err(Reported);
        }
        if let Some((word, item)) = function
            && !fractal.hypercomplex
            && !matches!(word, Word::Sqr | Word::Cube)
        {
            let message = format!("quaternions have no `{}` here", word.name());
            let diagnostic = Diagnostic::new(Code::OutOfRange, message)
                .at(item.span, "expected `sqr` or `cube`")
                .help("write `hypercomplex` beside it: those numbers have this function");
            return Err(self.report(&item.here, diagnostic));
        }
        fractal.parameter = parameter?.value;
        Ok(Solid::JuliaFractal(Box::new(fractal)))
    }

    /// Reads `pwr(x, y)`: the power with exponent x + y·i.
    fn power(&mut self, token: &Token, powers: &[f64], fractal: &mut JuliaFractal) -> Outcome<()> {
        let &[x, y] = powers else {
            let message = format!("`pwr` takes 2 numbers, not {}", powers.len());
            let diagnostic = Diagnostic::new(Code::WrongArity, message)
                .at(token.span, "expected `pwr(x, y)`")
                .help("the power is x + y·i");
            return Err(self.report(&token.here, diagnostic));
        };
        (fractal.function, fractal.power) = (Word::Pwr, [x, y]);
        Ok(())
    }

    fn iterations(&mut self, item: &Token) -> Outcome<u32> {
        const MOST: f64 = u32::MAX as f64;
        let given = self.number_after(item, "a whole number")?;
        self.lint_count(&given.here, given.span, given.value);
        match given.value.trunc() {
            count if (1.0..=MOST).contains(&count) => Ok(count as u32),
            _ => {
                let read = "it is 1";
                self.out_of_range_but_read(&given, Word::MaxIteration, "1 or more", read)?;
                Ok(1)
            }
        }
    }

    fn precision(&mut self, item: &Token) -> Outcome<()> {
        let range = Range::POSITIVE.but("it is 1", |_| 1.0);
        self.number_in(item, Word::Precision, &range).map(drop)
    }

    /// Reads the normal of the three-dimensional slice, and its distance from the origin along it.
    fn slice(&mut self, item: &Token, fractal: &mut JuliaFractal) -> Outcome<()> {
        let normal = self.four_after(item, "a vector of four for the normal")?;
        let distance = self.number_after(item, "a number for the distance")?;
        if normal.value[3] == 0.0 {
            let message = "the normal of this slice has no fourth component";
            let diagnostic = Diagnostic::new(Code::OutOfRange, message)
                .at(normal.span, "expected a last component other than 0")
                .help("x, y and z of the scene are the first three; the slice gives the fourth");
            return Err(self.report(&normal.here, diagnostic));
        }
        (fractal.normal, fractal.distance) = (normal.value, distance.value);
        Ok(())
    }

    /// Reads four numbers. A shorter vector is padded with zeros; a number fills all four.
    fn four_after(&mut self, after: &Token, wanted: &str) -> Outcome<Given<[f64; 4]>> {
        let given = self.given(after, wanted)?;
        let numbers = given.value.numbers().map(|numbers| numbers.as_slice().to_vec());
        match numbers.as_deref() {
            Some([number]) => Ok(given.with([*number; 4])),
            Some(some) if some.len() <= 4 => {
                let four = std::array::from_fn(|i| some.get(i).copied().unwrap_or(0.0));
                Ok(given.with(four))
            }
            Some(some) => {
                let message = format!("expected {wanted}, found one of {}", some.len());
                let diagnostic = Diagnostic::new(Code::WrongArity, message)
                    .at(given.span, "expected `<x, y, z, w>`");
                Err(self.report(&given.here, diagnostic))
            }
            None => Err(self.wrong_type(&given.here, given.span, wanted, &given.value)),
        }
    }
}

/// Returns whether a word is a function that can be iterated.
fn is_function(word: Word) -> bool {
    use Word as W;
    matches!(
        word,
        W::Sqr
            | W::Cube
            | W::Exp
            | W::Reciprocal
            | W::Sin
            | W::Asin
            | W::Sinh
            | W::Asinh
            | W::Cos
            | W::Acos
            | W::Cosh
            | W::Acosh
            | W::Tan
            | W::Atan
            | W::Tanh
            | W::Atanh
            | W::Ln
    )
}
