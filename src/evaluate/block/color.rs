//! Colours: `rgb <…>`, `color Red filter 0.5`, `color red 1 green 0.5`.
//!
//! **Source:** POV-Ray manual, section 3.3.1.3 "Specifying Colors".

use crate::color::{Color, Rgb};
use crate::diagnostic::{Code, Diagnostic};
use crate::vocabulary::{Family, Word};

use super::super::stream::{Token, TokenKind};
use super::super::value::Value;
use super::super::{Evaluator, Outcome};
use super::Given;

impl Evaluator<'_> {
    /// The colour that starts with `token`, a word of the colour family.
    pub(super) fn color_from(&mut self, token: &Token) -> Outcome<Color> {
        let TokenKind::Word(word) = token.kind else {
            return self.color_after(token, "a colour").map(|given| given.value);
        };
        let color = match word {
            Word::Color => match self.peek().map(|next| &next.kind) {
                Some(TokenKind::Word(Word::Rgb | Word::Rgbf | Word::Rgbt | Word::Rgbft)) => {
                    match self.next() {
                        Some(next) => return self.color_from(&next),
                        None => Color::BLACK,
                    }
                }
                Some(TokenKind::Word(next)) if is_component(*next) => {
                    let first = self.peek().cloned();
                    let first = first.as_ref().unwrap_or(token);
                    return self.color_of_components(first, Color::BLACK);
                }
                _ => {
                    let given = self.given(token, "a colour")?;
                    self.plain_color(&given, "a colour")?
                }
            },
            Word::Rgb | Word::Rgbf | Word::Rgbt | Word::Rgbft => self.color_vector(token, word)?,
            component if is_component(component) => {
                let mut color = Color::BLACK;
                self.color_component(token, component, &mut color)?;
                return self.color_of_components(token, color);
            }
            _ => {
                let outcome = self.word_not_built(token, word);
                return Err(outcome);
            }
        };
        self.color_components(color)
    }

    /// A value that stands for a colour without a word before it.
    pub(super) fn plain_color(&mut self, given: &Given<Value>, wanted: &str) -> Outcome<Color> {
        let Some(color) = given.value.as_color() else {
            return Err(self.wrong_type(&given.here, given.span, wanted, &given.value));
        };
        self.lint_color(given, color.rgb);
        Ok(color)
    }

    /// `rgb`, `rgbf`, `rgbt` or `rgbft` and its numbers.
    fn color_vector(&mut self, token: &Token, word: Word) -> Outcome<Color> {
        let given = self.given(token, "a vector")?;
        // A colour passes through whole: `rgb Red`.
        if let Value::Color(color) = given.value {
            return Ok(color);
        }
        let Some(numbers) = given.value.numbers() else {
            return Err(self.wrong_type(&given.here, given.span, "a vector", &given.value));
        };
        let wanted = match word {
            Word::Rgbf | Word::Rgbt => 4,
            Word::Rgbft => 5,
            _ => 3,
        };
        let given_numbers = numbers.as_slice();
        if given_numbers.len() > wanted {
            let diagnostic = Diagnostic::new(
                Code::WrongArity,
                format!(
                    "`{}` takes {wanted} components, and is given {}",
                    word.name(),
                    given_numbers.len()
                ),
            )
            .at(given.span, format!("expected {wanted} components"));
            let diagnostic = match given_numbers.len() {
                4 => diagnostic.help("`rgbf` takes red, green, blue and filter; `rgbt` red, green, blue and transmit"),
                _ => diagnostic.help("`rgbft` takes red, green, blue, filter and transmit"),
            };
            return Err(self.report(&given.here, diagnostic));
        }
        let mut all = match *given_numbers {
            [gray] => [gray; 5],
            _ => {
                let mut all = [0.0; 5];
                all[..given_numbers.len()].copy_from_slice(given_numbers);
                all
            }
        };
        all[wanted..].fill(0.0);
        if word == Word::Rgbt {
            all.swap(3, 4);
        }
        let [red, green, blue, filter, transmit] = all;
        let rgb = Rgb::new(red, green, blue);
        self.lint_color(&given, rgb);
        Ok(Color { rgb, filter, transmit })
    }

    /// What may follow a colour: `red 1`, `filter 0.5` …, each replacing one component.
    pub(super) fn color_components(&mut self, mut color: Color) -> Outcome<Color> {
        while let Some(Token { kind: TokenKind::Word(word), .. }) = self.peek_on() {
            let word = *word;
            if !is_component(word) {
                break;
            }
            if let Some(token) = self.next() {
                self.color_component(&token, word, &mut color)?;
            }
        }
        Ok(color)
    }

    /// A colour that is written by its components alone.
    fn color_of_components(&mut self, first: &Token, color: Color) -> Outcome<Color> {
        let color = self.color_components(color)?;
        self.lint_color_range(&first.here, first.span, color.rgb);
        Ok(color)
    }

    fn color_component(&mut self, token: &Token, word: Word, color: &mut Color) -> Outcome<()> {
        if matches!(word, Word::Red | Word::Green | Word::Blue) && self.peek().is_none() {
            let name = word.name();
            let diagnostic =
                Diagnostic::new(Code::MissingPart, format!("`{name}` is a part of a colour"))
                    .at(token.span, "its number is missing")
                    .help(format!("write `{name} 1`, or all three as in `rgb <1, 0, 0>`"));
            return Err(self.report(&token.here, diagnostic));
        }
        let number = self.number_after(token, "a number")?.value;
        match word {
            Word::Red => color.rgb.red = number,
            Word::Green => color.rgb.green = number,
            Word::Blue => color.rgb.blue = number,
            Word::Filter => color.filter = number,
            _ => color.transmit = number,
        }
        Ok(())
    }

    /// A word of the right family that is not built: poison for the object being read.
    fn word_not_built(&mut self, token: &Token, word: Word) -> super::super::Reported {
        let poison = super::super::value::Poison { word, site: token.here.site(token.span) };
        self.skip_arguments(word);
        self.set_poison(poison);
        super::super::Reported
    }

    /// True when the next item begins a colour.
    pub(super) fn at_color(&mut self) -> bool {
        match self.peek().map(|token| &token.kind) {
            Some(TokenKind::Word(word)) => word.family() == Family::Color,
            Some(TokenKind::Expression(_) | TokenKind::Literal(_)) => true,
            _ => false,
        }
    }
}

fn is_component(word: Word) -> bool {
    matches!(word, Word::Red | Word::Green | Word::Blue | Word::Filter | Word::Transmit)
}
