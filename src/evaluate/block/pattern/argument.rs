//! The values after the word of a pattern or a warp, by the table of parameters that it declares.

use crate::diagnostic::{Code, Diagnostic};
use crate::evaluate::block::{Given, Place};
use crate::evaluate::stream::{Token, TokenKind};
use crate::evaluate::{Evaluator, Outcome, Reported};
use crate::math::Vector;
use crate::pattern::{Argument, Kind, Parameter, Warp};
use crate::scene::Source;
use crate::vocabulary::Word;

use super::OpenPattern;

impl Evaluator<'_> {
    /// Reads `warp { … }`: the word of a warp, the values after it, and its items.
    pub(super) fn warp(&mut self, token: &Token) -> Outcome<Warp> {
        let opener = token.clone();
        self.block(token, Word::Warp, |evaluator| {
            let mut warp: Option<Warp> = None;
            while let Some(token) = evaluator.next() {
                if matches!(token.kind, TokenKind::Comma) {
                    evaluator.unexpected(&token, Place::WARP);
                    continue;
                }
                let TokenKind::Word(word) = token.kind else {
                    evaluator.unexpected(&token, Place::WARP);
                    return Err(Reported);
                };
                let parameters = warp.as_ref().map_or(&[][..], |warp| warp.parameters());
                let place = parameters.iter().position(|one| one.word == Some(word.name()));
                if let (Some(place), Some(warp)) = (place, &mut warp) {
                    let Parameter { what, default, .. } = parameters[place];
                    let argument = match default {
                        Argument::Switch(_) => Argument::Switch(true),
                        _ => evaluator.pattern_argument(&token, what, default)?,
                    };
                    warp.set(place, argument);
                    continue;
                }
                let Some(mut chosen) = Warp::of_word(word.name()).filter(|_| warp.is_none()) else {
                    evaluator.unexpected(&token, Place::WARP);
                    return Err(Reported);
                };
                for (place, parameter) in chosen.parameters().iter().enumerate() {
                    if parameter.word.is_none() {
                        let Parameter { what, default, .. } = *parameter;
                        let is_optional = matches!(word, Word::Planar);
                        if is_optional && !evaluator.is_before_value() {
                            break;
                        }
                        let argument = evaluator.pattern_argument(&token, what, default)?;
                        chosen.set(place, argument);
                        if let (Word::Repeat, Argument::Vector(step)) = (word, argument) {
                            evaluator.one_axis(&token, step)?;
                        }
                    }
                }
                warp = Some(chosen);
            }
            let Some(warp) = warp else {
                let diagnostic = Diagnostic::new(Code::MissingPart, "this `warp` names none")
                    .at(opener.span, "expected its kind, such as `turbulence 0.5`");
                return Err(evaluator.report(&opener.here, diagnostic));
            };
            Ok(warp)
        })
    }

    /// Reports a `warp { repeat … }` along no axis or several.
    fn one_axis(&mut self, token: &Token, step: Vector) -> Outcome<()> {
        let axes = step.to_array().into_iter().filter(|width| *width != 0.0).count();
        if axes == 1 {
            return Ok(());
        }
        let found = if axes == 0 { "names none" } else { "names several" };
        let diagnostic =
            Diagnostic::new(Code::OutOfRange, format!("`repeat` takes one axis, and this {found}"))
                .at(self.whole(token).span, "expected a multiple of `x`, `y` or `z`")
                .help("for several axes write several: `warp { repeat x } warp { repeat y }`");
        Err(self.report(&token.here, diagnostic))
    }

    /// Reads a parameter of the chosen pattern, by the word before it.
    pub(super) fn pattern_parameter(
        &mut self,
        token: &Token,
        word: Word,
        open: &mut OpenPattern,
    ) -> Option<Outcome<()>> {
        let kind = open.kind()?;
        let parameters = kind.parameters();
        let place = parameters.iter().position(|parameter| parameter.word == Some(word.name()))?;
        let parameter = parameters[place];
        let argument = self.pattern_argument(token, parameter.what, parameter.default);
        Some(argument.map(|argument| kind.set(place, argument)))
    }

    fn pattern_argument(
        &mut self,
        token: &Token,
        what: &str,
        default: Argument,
    ) -> Outcome<Argument> {
        Ok(match default {
            Argument::Number(_) => {
                let given = self.number_after(token, what)?;
                if let TokenKind::Word(word) = token.kind {
                    self.within_bounds(&given, word);
                    self.exponent_in_bounds(&given, word)?;
                }
                Argument::Number(given.value)
            }
            Argument::Vector(_) => Argument::Vector(self.vector_after(token, what)?.value),
            Argument::Numbers(_) => {
                let first = self.number_after(token, what)?;
                if let TokenKind::Word(word) = token.kind {
                    self.within_formulas(&first, word);
                }
                Argument::Numbers([first.value, self.number_after(token, what)?.value])
            }
            Argument::Switch(_) => Argument::Switch(match self.peek().map(|next| &next.kind) {
                Some(TokenKind::Expression(_) | TokenKind::Literal(_)) => {
                    self.number_after(token, what)?.value != 0.0
                }
                _ => true,
            }),
        })
    }

    /// Reports an exponent of `mandel` or `julia` for which POV-Ray takes the default.
    fn exponent_in_bounds(&mut self, given: &Given<f64>, word: Word) -> Outcome<()> {
        if word != Word::Exponent || (2.0..34.0).contains(&given.value) {
            return Ok(());
        }
        self.out_of_range_but_read(given, word, "from 2 to 33", "this is read as 2")
    }

    /// Reads `magnet 1 mandel 50` and the like, after its first word.
    pub(super) fn magnet(&mut self, token: &Token) -> Outcome<Source> {
        let given = self.number_after(token, "1 or 2")?;
        self.within_formulas(&given, Word::Magnet);
        let next = self.peek().cloned();
        let kind = match next.as_ref().map(|next| &next.kind) {
            Some(TokenKind::Word(Word::Mandel)) => Kind::of_word("magnet_mandel"),
            Some(TokenKind::Word(Word::Julia)) => Kind::of_word("magnet_julia"),
            _ => {
                let at = (&token.here, given.span.after());
                return Err(self.expected("`mandel` or `julia`", next.as_ref(), at));
            }
        };
        let (Some(mut kind), Some(next)) = (kind, self.next()) else { return Err(Reported) };
        kind.set(0, Argument::Number(given.value));
        self.values_after(&next, kind, 1).map(Source::Kind)
    }

    /// Reads the values that follow the word of a pattern.
    pub(super) fn kind_after(&mut self, token: &Token, kind: Kind) -> Outcome<Kind> {
        self.values_after(token, kind, 0)
    }

    /// Reads the values that follow the word of a pattern, from one parameter on.
    fn values_after(&mut self, token: &Token, mut kind: Kind, first: usize) -> Outcome<Kind> {
        for (place, parameter) in kind.parameters().iter().enumerate().skip(first) {
            if parameter.word.is_some() {
                continue;
            }
            let argument = match parameter.default {
                Argument::Vector(_) if matches!(kind, Kind::Gradient(_)) => {
                    Argument::Vector(self.any_direction_after(token, parameter.what)?.value)
                }
                default => self.pattern_argument(token, parameter.what, default)?,
            };
            kind.set(place, argument);
        }
        Ok(kind)
    }
}
