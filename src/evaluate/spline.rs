//! Splines (`spline { natural_spline 0, <0, 0, 0>, 1, <2, 1, 0> }`) and their values over time.
//!
//! **Source:** manual, section 3.3.1.10 ("Splines"). Measured: the name of a spline comes before the kind,
//! and supplies kind and values; values of different size are promoted as in sums. For two values at one time
//! see `spline.rs`.

use std::sync::Arc;

use crate::diagnostic::{Code, Diagnostic, suggest};
use crate::source::{Site, Span};
use crate::spline::{Knot, Spline, SplineKind, replacing};
use crate::syntax::ast::{Argument, BinaryOperator, ExpressionKind};
use crate::vocabulary::Word;

use super::stream::{Token, TokenKind};
use super::value::{Components, Value};
use super::{Evaluator, Here, Outcome, Reported};

/// A spline and the number of components of its values.
#[derive(Debug, Clone, PartialEq)]
pub struct SplineValue {
    pub spline: Spline,
    components: usize,
}

impl SplineValue {
    pub fn components(&self) -> usize {
        self.components
    }

    /// Returns the value at a time: a vector of two to five components.
    pub fn at(&self, time: f64) -> Value {
        let values = self.spline.at(time);
        Components::new(&values[..self.components]).map_or(Value::Broken, Value::Vector)
    }
}

const KINDS: [Word; 4] =
    [Word::LinearSpline, Word::QuadraticSpline, Word::CubicSpline, Word::NaturalSpline];

fn kind_of(word: Word) -> Option<SplineKind> {
    match word {
        Word::LinearSpline => Some(SplineKind::Linear),
        Word::QuadraticSpline => Some(SplineKind::Quadratic),
        Word::CubicSpline => Some(SplineKind::Cubic),
        Word::NaturalSpline => Some(SplineKind::Natural),
        _ => None,
    }
}

impl Evaluator<'_> {
    /// Reads `spline { … }`, after its keyword.
    pub(super) fn spline(&mut self, token: &Token) -> Outcome<Value> {
        self.block(token, Word::Spline, |evaluator| evaluator.spline_items(token))
    }

    fn spline_items(&mut self, opener: &Token) -> Outcome<Value> {
        let (mut kind, mut knots, mut components) = (SplineKind::Linear, Vec::new(), 2);
        let (mut poison, mut written) = (None, Vec::new());
        loop {
            self.skip_commas();
            let Some(token) = self.next() else { break };
            if let TokenKind::Word(word) = token.kind
                && let Some(named) = kind_of(word)
            {
                kind = named;
                continue;
            }
            if let Some(named) = self.short_kind(&token) {
                kind = named;
                continue;
            }
            if let Some(reported) = self.kind_less_time(&token) {
                return Err(reported);
            }
            match self.value_of(&token)? {
                Value::Spline(other) if knots.is_empty() => {
                    kind = other.spline.kind();
                    knots.extend_from_slice(other.spline.knots());
                    components = other.components;
                }
                Value::Number(time) => {
                    self.skip_commas();
                    let place = self.peek().map_or(token.span, |next| next.span);
                    let value = self.value_or(&token.here, token.span)?;
                    if let Value::Poison(_) = value {
                        poison = poison.or(Some(value));
                        continue;
                    }
                    let Some(numbers) = value.numbers() else {
                        let wanted = "a vector after its time";
                        return Err(self.wrong_type(&token.here, place, wanted, &value));
                    };
                    components = components.max(numbers.len());
                    let mut values = [0.0; 5];
                    values[..numbers.len()].copy_from_slice(numbers.as_slice());
                    if let Value::Number(number) = value {
                        values = [number; 5];
                    }
                    knots.push(Knot { time, value: values });
                    written.push((time, token.here.site(token.span)));
                }
                found @ Value::Poison(_) => poison = poison.or(Some(found)),
                other => {
                    if let ([(count, first)], [_]) = (&written[..], &knots[..])
                        && let Some(reported) = self.counted_spline(&token, *count, *first)
                    {
                        return Err(reported);
                    }
                    let wanted = "a time, the number before each value";
                    return Err(self.wrong_type(&token.here, token.span, wanted, &other));
                }
            }
        }
        if let Some(poison) = poison {
            return Ok(poison);
        }
        self.tell_same_time(&written);
        match Spline::new(kind, knots) {
            Some(spline) => Ok(Value::Spline(Arc::new(SplineValue { spline, components }))),
            None => {
                let diagnostic = Diagnostic::new(Code::MissingPart, "this spline has no values")
                    .at(opener.span, "expected a time and a value")
                    .help("`spline { linear_spline 0, <0, 0, 0>, 1, <5, 0, 0> }`");
                Err(self.report(&opener.here, diagnostic))
            }
        }
    }

    /// Reports a count of values, which a lathe has but a spline does not: `spline { linear_spline 2,
    /// <0,0,0>, <1,1,1> }`.
    fn counted_spline(&mut self, token: &Token, count: f64, first: Site) -> Option<Reported> {
        let block = self.blocks.last().map(|block| block.span)?;
        if block.file != first.span.file || !block.contains(first.span) || count < 2.0 {
            return None;
        }
        let list = Span { start: first.span.end, ..block };
        let list = self.sources.text(list).strip_suffix('}')?;
        let values: Vec<&str> = list
            .split_inclusive('>')
            .map(|value| value.trim_matches(|c: char| c == ',' || c.is_whitespace()))
            .filter(|value| !value.is_empty())
            .collect();
        let is_vector = |value: &&str| value.starts_with('<') && value.ends_with('>');
        if !values.iter().all(is_vector) || values.len() as f64 != count {
            return None;
        }
        let timed: Vec<String> =
            values.iter().enumerate().map(|(time, value)| format!("{time}, {value}")).collect();
        let right = timed.join(", ");
        let end = first.span.end + list.rfind('>').map_or(0, |at| at as u32 + 1);
        while self.next().is_some() {}
        let told = Diagnostic::new(Code::ExtraPart, "a spline does not say how many values it has")
            .at(first.span, "a time stands before each value")
            .help(format!("write `{right}`, at times such as these"))
            .fix(Span { end, ..first.span }, right);
        Some(self.report(&token.here, told))
    }

    /// Reports two values at one time that are not a jump: one of them has no effect.
    fn tell_same_time(&mut self, written: &[(f64, Site)]) {
        let mut at: Vec<usize> = (0..written.len()).collect();
        at.sort_by(|&a, &b| written[a].0.total_cmp(&written[b].0));
        let same = |pair: &&[usize]| written[pair[0]].0 == written[pair[1]].0;
        let Some(&[first, second]) = at.windows(2).find(same) else { return };
        let (time, before) = written[first];
        let later = written[second].1;
        let replaces = replacing(written.iter().map(|(time, _)| *time)).nth(second);
        let (what, label) = match replaces {
            Some(false) => ("second is dropped", "this one has no effect"),
            _ => ("first is replaced", "this one counts"),
        };
        let message = format!("this spline has two values for the time {time}: the {what}");
        let mut diagnostic = Diagnostic::new(Code::RepeatedTime, message)
            .at(later.span, label)
            .help("a jump lies between two times that differ by a little");
        // In a loop, both have the same span.
        if before.span != later.span {
            diagnostic = diagnostic.also(before.span, "the first is here");
        }
        self.report_in(later.expansion, diagnostic);
    }

    /// Reports a misspelt kind that reads as the left operand of a difference with the first time:
    /// `cubic_spine -1, x …`.
    fn kind_less_time(&mut self, token: &Token) -> Option<Reported> {
        let TokenKind::Expression(id) = token.kind else { return None };
        let ExpressionKind::Binary(BinaryOperator::Subtract, first, _) =
            token.here.unit.expression(id).kind
        else {
            return None;
        };
        self.unknown_name(&token.here, first)?;
        let span = token.here.unit.expression(first).span;
        let kind = Token { kind: TokenKind::Expression(first), here: token.here.clone(), span };
        self.short_kind(&kind)?;
        while self.next().is_some() {}
        Some(Reported)
    }

    /// Recognizes `cubic` for `cubic_spline`.
    fn short_kind(&mut self, token: &Token) -> Option<SplineKind> {
        let is_name = match token.kind {
            TokenKind::Word(_) => true,
            TokenKind::Expression(id) => self.unknown_name(&token.here, id).is_some(),
            _ => false,
        };
        let text = self.sources.text(token.span).to_owned();
        let kinds = || KINDS.into_iter().map(Word::name);
        let short = Word::from_name(&format!("{text}_spline")).filter(|_| is_name);
        let theirs = || suggest::foreign(&text).find(|ours| kinds().any(|kind| kind == *ours));
        // Of a shape, and none of these.
        let of_shape =
            || matches!(text.as_str(), "bezier_spline" | "b_spline").then_some("cubic_spline");
        let near = || {
            let near = suggest::closest(&text, kinds()).filter(|_| of_shape().is_none());
            near.or_else(theirs).or_else(of_shape).and_then(Word::from_name)
        };
        let word = short.or_else(|| near().filter(|_| is_name))?;
        let kind = kind_of(word)?;
        let meant = word.name();
        let diagnostic =
            Diagnostic::new(Code::UnknownWord, format!("`{text}` is not a kind of spline"))
                .at(token.span, format!("did you mean `{meant}`?"))
                .help(format!("replace it with `{meant}`"))
                .fix(token.span, meant);
        self.report(&token.here, diagnostic);
        Some(kind)
    }

    /// Evaluates `S(time)` or `S(time, natural_spline)`.
    pub(super) fn spline_value(
        &mut self,
        here: &Here,
        spline: &SplineValue,
        list: &[Argument],
        span: Span,
    ) -> Outcome<Value> {
        let (time, kind) = match list {
            [Argument::Expression(time)] => (*time, None),
            [Argument::Expression(time), Argument::Items(items)] => {
                let kind = self.inside(here, *items, |evaluator| match evaluator.next() {
                    Some(Token { kind: TokenKind::Word(word), .. }) => kind_of(word),
                    _ => None,
                });
                let Some(kind) = kind else {
                    let diagnostic =
                        Diagnostic::new(Code::WrongType, "a spline is asked for a time and a kind")
                            .at(span, "expected a kind of spline after the time")
                            .help("the kinds are `linear_spline`, `quadratic_spline`, `cubic_spline` and `natural_spline`");
                    return Err(self.report(here, diagnostic));
                };
                (*time, Some(kind))
            }
            _ => {
                let message =
                    format!("a spline is asked for one time, and is given {} values", list.len());
                let diagnostic =
                    Diagnostic::new(Code::WrongArity, message).at(span, "expected one number");
                return Err(self.report(here, diagnostic));
            }
        };
        let time = self.number(here, time)?;
        match kind.and_then(|kind| Spline::new(kind, spline.spline.knots().to_vec())) {
            Some(other) => Ok(SplineValue { spline: other, ..*spline }.at(time)),
            None => Ok(spline.at(time)),
        }
    }
}
