//! `julia_fractal`: its parameter, algebra, function and slice.

use crate::diagnostic::{Code, Diagnostic};
use crate::scene::{Julia, Solid};
use crate::syntax::ast::{Callee, ExpressionKind};
use crate::vocabulary::Word;

use super::super::stream::{Token, TokenKind};
use super::super::{Evaluator, Outcome, Reported};
use super::part::Given;

/// The functions that are words alone; `pwr(x, y)` is a call.
const FUNCTIONS: [Word; 17] = [
    Word::Sqr,
    Word::Cube,
    Word::Exp,
    Word::Reciprocal,
    Word::Sin,
    Word::Asin,
    Word::Sinh,
    Word::Asinh,
    Word::Cos,
    Word::Acos,
    Word::Cosh,
    Word::Acosh,
    Word::Tan,
    Word::Atan,
    Word::Tanh,
    Word::Atanh,
    Word::Ln,
];

impl Evaluator<'_> {
    pub(super) fn julia_fractal(&mut self, token: &Token) -> Outcome<Solid> {
        let parameter = self.four_numbers(token, "a vector of four numbers for the parameter")?;
        let mut julia = Julia { parameter: parameter.value, ..Julia::default() };
        // Where a function stands that only hypercomplex numbers have.
        let mut function = token.clone();
        let mut failed = false;
        loop {
            self.skip_commas();
            let Some(item) = self.peek().cloned() else { break };
            let outcome = match item.kind {
                TokenKind::Word(word) => {
                    let own = [
                        Word::Quaternion,
                        Word::Hypercomplex,
                        Word::MaxIteration,
                        Word::Precision,
                        Word::Slice,
                    ];
                    if !own.contains(&word) && !FUNCTIONS.contains(&word) {
                        break;
                    }
                    self.next();
                    if FUNCTIONS.contains(&word) {
                        function = item.clone();
                    }
                    self.julia_item(&item, word, &mut julia)
                }
                TokenKind::Expression(id) => {
                    let kind = item.here.unit.expression(id).kind;
                    let ExpressionKind::Call(Callee::Word(Word::Pwr, _), list) = kind else {
                        break;
                    };
                    self.next();
                    function = item.clone();
                    let given = self.numbers_of(&item.here, list);
                    given.and_then(|given| match given[..] {
                        [re, im] => {
                            julia.function = Word::Pwr;
                            julia.power = [re, im];
                            Ok(())
                        }
                        _ => Err(self.wrong_arity(
                            &item.here,
                            Word::Pwr,
                            item.span,
                            2..=2,
                            given.len(),
                        )),
                    })
                }
                _ => break,
            };
            failed |= outcome.is_err();
        }
        if failed {
            return Err(Reported);
        }
        if !julia.hypercomplex && !matches!(julia.function, Word::Sqr | Word::Cube) {
            let name = julia.function.name();
            let message = format!("`{name}` is a function of hypercomplex numbers");
            let diagnostic = Diagnostic::new(Code::WrongType, message)
                .at(function.span, "quaternions have `sqr` and `cube`")
                .help("write `hypercomplex` before it");
            return Err(self.report(&function.here, diagnostic));
        }
        Ok(Solid::JuliaFractal(julia))
    }

    fn julia_item(&mut self, item: &Token, word: Word, julia: &mut Julia) -> Outcome<()> {
        match word {
            Word::Quaternion => julia.hypercomplex = false,
            Word::Hypercomplex => julia.hypercomplex = true,
            Word::MaxIteration => {
                let given = self.number_after(item, "a number of iterations")?;
                if !(1.0..=1e6).contains(&given.value) {
                    let message = "`max_iteration` counts how often the formula is used";
                    let diagnostic = Diagnostic::new(Code::OutOfRange, message)
                        .at(given.span, "expected a whole number from 1 to a million");
                    return Err(self.report(&given.here, diagnostic));
                }
                julia.iterations = given.value as u32;
            }
            Word::Precision => {
                julia.precision = self.number_after(item, "a number")?.value.max(1.0);
            }
            Word::Slice => {
                let normal =
                    self.four_numbers(item, "a vector of four numbers across the slice")?;
                let distance = self.number_after(item, "a number for the slice's distance")?;
                if normal.value[3] == 0.0 {
                    let message = "a slice along the fourth coordinate has three no more";
                    let diagnostic = Diagnostic::new(Code::OutOfRange, message)
                        .at(normal.span, "expected a fourth component that is not 0");
                    return Err(self.report(&normal.here, diagnostic));
                }
                julia.slice = normal.value;
                julia.distance = distance.value;
            }
            _ => julia.function = word,
        }
        Ok(())
    }

    /// Of a shorter vector the last are 0; a number is four of itself.
    fn four_numbers(&mut self, after: &Token, wanted: &str) -> Outcome<Given<[f64; 4]>> {
        let given = self.given(after, wanted)?;
        let numbers = given.value.numbers().map(|numbers| numbers.as_slice().to_vec());
        match numbers.as_deref() {
            Some([one]) => Ok(given.with([*one; 4])),
            Some(some) if some.len() <= 4 => {
                let all = std::array::from_fn(|at| some.get(at).copied().unwrap_or(0.0));
                Ok(given.with(all))
            }
            _ => Err(self.wrong_type(&given.here, given.span, wanted, &given.value)),
        }
    }
}
