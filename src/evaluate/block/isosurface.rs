//! `isosurface` and `parametric`: surfaces of functions, with their container.

use std::sync::Arc;

use crate::diagnostic::{Code, Diagnostic};
use crate::math::Vector;
use crate::scene::{Container, Dialect, Solid};
use crate::texture::Closed;
use crate::vocabulary::Word;

use super::super::lint::Compared;
use super::super::stream::{Token, TokenKind};
use super::super::value::Value;
use super::super::{Evaluator, Outcome, Reported};
use super::range::Range;
use super::{Given, Place};

/// POV-Ray's value if `accuracy` or `max_gradient` is missing, or not positive.
const ACCURACY: f64 = 0.001;
const MAX_GRADIENT: f64 = 1.1;

/// Items after the function of an `isosurface`.
const OF_ISOSURFACE: &[Word] = &[
    // One too many.
    Word::Function,
    Word::Threshold,
    Word::Accuracy,
    Word::ContainedBy,
    Word::Open,
    Word::MaxGradient,
    Word::Evaluate,
    Word::MaxTrace,
    Word::AllIntersections,
];

/// Items after the corners of a `parametric`.
const OF_PARAMETRIC: &[Word] =
    &[Word::Accuracy, Word::ContainedBy, Word::MaxGradient, Word::Precompute];

impl Evaluator<'_> {
    /// Reads an `isosurface`: `function { … }` first, then the other items in any order.
    pub(super) fn isosurface(&mut self, token: &Token) -> Outcome<Solid> {
        // The following items are read for their own mistakes.
        let word = self.function_word(token);
        let compared = word.as_ref().ok().and_then(|_| self.compared_surface());
        let function = word.and_then(|word| self.closed_function(&word));
        let mut container = None;
        let (mut threshold, mut accuracy, mut open) = (0.0, ACCURACY, false);
        let mut failed = false;
        while let Some((item, word)) = self.next_part(Word::Isosurface, OF_ISOSURFACE) {
            let outcome = match word {
                Word::Threshold => {
                    self.number_after(&item, "a number").map(|given| threshold = given.value)
                }
                Word::Accuracy => {
                    self.positive_after(&item, word, accuracy).map(|value| accuracy = value)
                }
                Word::ContainedBy => self
                    .contained_by(&item, container.unwrap_or(Container::DEFAULT))
                    .map(|held| container = Some(held)),
                Word::MaxGradient => self.positive_after(&item, word, MAX_GRADIENT).map(drop),
                Word::Open => {
                    open = true;
                    Ok(())
                }
                Word::Function => Err(self.second_function(&item)),
                _ => self.inert(&item, Place::shape(Word::Isosurface)).unwrap_or(Ok(())),
            };
            failed |= outcome.is_err();
        }
        // A threshold between 0 and 1 separates where an inequality holds from where it does not.
        if let Some(Compared { here, diagnostic, is_equation }) = compared
            && (is_equation || threshold == 0.0)
        {
            self.report(&here, diagnostic);
        }
        if failed {
            return Err(Reported);
        }
        let function = function?;
        let container = Box::new(container.unwrap_or(Container::DEFAULT));
        Ok(Solid::Isosurface { function, container, threshold, accuracy, open })
    }

    /// Reports a second function: `isosurface { function { … } function { … } }`.
    fn second_function(&mut self, item: &Token) -> Reported {
        let told = Diagnostic::new(Code::ExtraPart, "an isosurface has one function")
            .at(item.span, "one too many")
            .help("`min(f, g)` in one is the union of the two, `max(f, g)` what they share");
        let reported = self.report(&item.here, told);
        self.skip_function();
        reported
    }

    /// Reads a function that returns a number, with all functions that it uses.
    pub(super) fn function_part(&mut self, token: &Token) -> Outcome<Arc<Closed>> {
        let word = self.function_word(token)?;
        self.closed_function(&word)
    }

    /// Reads the keyword `function`, whose block comes next.
    fn function_word(&mut self, token: &Token) -> Outcome<Token> {
        self.skip_commas();
        self.semicolon_for_comma();
        let Some(word) = self.take_function() else {
            let next = self.peek().cloned();
            if let Some(next) = &next
                && let Some(reported) = self.bare_function(next)
            {
                return Err(reported);
            }
            let wanted = "`function { … }`";
            return Err(self.expected(wanted, next.as_ref(), (&token.here, token.span)));
        };
        Ok(word)
    }

    fn closed_function(&mut self, word: &Token) -> Outcome<Arc<Closed>> {
        match self.function(word)? {
            Value::Function(id) => match self.closed(id) {
                Some(closed) => Ok(Arc::new(closed)),
                None => {
                    let message = "a surface needs a function that gives a number";
                    let diagnostic = Diagnostic::new(Code::WrongType, message)
                        .at(word.span, "this gives more than one")
                        .help("write one of its components, as `F(x, y, z).x`");
                    Err(self.report(&word.here, diagnostic))
                }
            },
            Value::Poison(poison) => {
                self.set_poison(poison);
                Err(Reported)
            }
            _ => Err(Reported),
        }
    }

    /// Takes the keyword `function`, or a misspelling of it, which is reported.
    fn take_function(&mut self) -> Option<Token> {
        let next = self.peek()?.clone();
        let word = Word::Function;
        let is_meant = self.misspelt_part(Word::Isosurface, &[word]).is_some();
        match is_meant {
            true => Some(Token { kind: TokenKind::Word(word), ..next }),
            false => self.take_word(word),
        }
    }

    /// Reports the bare name of a declared function: `isosurface { F … }`.
    fn bare_function(&mut self, next: &Token) -> Option<Reported> {
        let TokenKind::Expression(id) = next.kind else { return None };
        if let Some(symbol) = self.unknown_name(&next.here, id) {
            self.next();
            return Some(self.undeclared_among(&next.here, symbol, next.span, |_| false));
        }
        let Some(Value::Function(_)) = self.named(&next.here, id) else { return None };
        self.next();
        let name = self.sources.text(next.span).to_owned();
        let right = format!("function {{ {name}(x, y, z) }}");
        let message = format!("expected `function {{ … }}`, found `{name}`, which is a function");
        let diagnostic = Diagnostic::new(Code::ExpectedExpression, message)
            .at(next.span, "it is called in a function of its own")
            .help(format!("write `{right}`"))
            .fix(next.span, right);
        Some(self.report(&next.here, diagnostic))
    }

    /// Reads a `parametric`: three functions of u and v, and the two corners of their range.
    pub(super) fn parametric(&mut self, token: &Token) -> Outcome<Solid> {
        // The following items are read for their own mistakes.
        let functions = [(); 3].map(|()| self.function_part(token));
        let first = self.corner(token, "a vector <u, v> for a corner")?;
        let second = self.corner(token, "a vector <u, v> for the opposite corner")?;
        self.lint_range(token, [&first, &second]);
        let mut container = Container::DEFAULT;
        let mut failed = false;
        while let Some((item, word)) = self.next_part(Word::Parametric, OF_PARAMETRIC) {
            let outcome = match word {
                Word::ContainedBy => {
                    self.contained_by(&item, container).map(|held| container = held)
                }
                // Every intersection is found as exactly as rounding allows.
                Word::Accuracy => self.positive_after(&item, word, ACCURACY).map(drop),
                _ => self.inert(&item, Place::shape(Word::Parametric)).unwrap_or(Ok(())),
            };
            failed |= outcome.is_err();
        }
        let [Ok(x), Ok(y), Ok(z)] = functions else { return Err(Reported) };
        let functions = [x, y, z];
        if failed {
            return Err(Reported);
        }
        if first.value[0] == second.value[0] || first.value[1] == second.value[1] {
            let which = if first.value[0] == second.value[0] { "u" } else { "v" };
            let message = format!("a parametric surface of one {which} is a line, and is nothing");
            let diagnostic = Diagnostic::new(self.sizeless(), message)
                .at(second.span, format!("expected another {which}"))
                .also(first.span, "the first corner");
            self.nothing(token, &second.here, diagnostic)?;
        }
        let corners = [first.value, second.value];
        Ok(Solid::Parametric { functions, corners, container: Box::new(container) })
    }

    fn corner(&mut self, token: &Token, wanted: &str) -> Outcome<Given<[f64; 2]>> {
        let given = self.given(token, wanted)?;
        match given.value.numbers().map(|numbers| numbers.as_slice().to_vec()).as_deref() {
            Some([u, v]) => Ok(given.with([*u, *v])),
            // POV-Ray 3.7 uses it for both (measured).
            Some(&[both]) if self.options.dialect == Dialect::Pov => Ok(given.with([both; 2])),
            Some([_, _, ..]) => {
                Err(self.too_wide(&given, Word::Parametric, "a corner of u and v", 2))
            }
            _ => Err(self.wrong_type(&given.here, given.span, wanted, &given.value)),
        }
    }

    /// Reads a number above 0; any other is replaced by `otherwise`, as in POV-Ray 3.7 (measured).
    fn positive_after(&mut self, item: &Token, word: Word, otherwise: f64) -> Outcome<f64> {
        let range = Range::POSITIVE.but("it has no effect", |_| 0.0);
        let number = self.number_in(item, word, &range)?;
        Ok(if number > 0.0 { number } else { otherwise })
    }

    /// Reads `contained_by { sphere { … } }` or `contained_by { box { … } }`. If it is empty, POV-Ray 3.7
    /// keeps the container from `before` (measured).
    pub(super) fn contained_by(&mut self, token: &Token, before: Container) -> Outcome<Container> {
        let fits = |word| matches!(word, Word::Sphere | Word::Box);
        if let Some(reported) = self.unbraced(token, Word::ContainedBy, fits) {
            return Err(reported);
        }
        self.block(token, Word::ContainedBy, |evaluator| {
            let shapes = [Word::Sphere, Word::Box];
            let Some((inner, word)) = evaluator.next_part(Word::ContainedBy, &shapes) else {
                let (other, at) = (evaluator.next(), (&token.here, token.span));
                let wanted = "`sphere { … }` or `box { … }`";
                if other.is_none() && evaluator.options.dialect == Dialect::Pov {
                    let message = format!("expected {wanted}, found nothing");
                    let diagnostic = Diagnostic::new(Code::MissingPart, message)
                        .at(token.span, "it changes nothing");
                    evaluator.opinion(&token.here, diagnostic)?;
                    return Ok(before);
                }
                return Err(evaluator.expected(wanted, other.as_ref(), at));
            };
            let solid = evaluator.block(&inner, word, |evaluator| match word {
                Word::Sphere => evaluator.sphere(&inner),
                _ => evaluator.box_(&inner),
            })?;
            match solid {
                Solid::Sphere { centre, radius } => Ok(Container::Sphere { centre, radius }),
                Solid::Box { corners } => evaluator.container(&inner, corners),
                _ => Err(Reported),
            }
        })
    }
}

impl Evaluator<'_> {
    /// Checks that a box has a size along each axis: a flat one contains nothing. A box with a size along
    /// fewer than two axes has been reported.
    fn container(&mut self, box_: &Token, corners: [Vector; 2]) -> Outcome<Container> {
        let sides = (corners[1] - corners[0]).to_array();
        if sides.iter().filter(|side| **side == 0.0).count() == 1 {
            let diagnostic = Diagnostic::new(self.sizeless(), "a flat container holds nothing")
                .at(box_.span, "its corners are equal along one axis");
            self.nothing(box_, &box_.here, diagnostic)?;
        }
        Ok(Container::Box { corners })
    }
}

impl Container {
    /// The container of a surface that specifies none.
    pub(super) const DEFAULT: Self = Self::Box { corners: [Vector::NEG_ONE, Vector::ONE] };
}
