//! Vectors: construction from components, and component access.

use crate::color::{Color, Rgb};
use crate::diagnostic::{Code, Diagnostic};
use crate::math::terms::count_of_terms;
use crate::source::Span;
use crate::syntax::ast::{Argument, Arguments, Component, ExpressionId, ExpressionKind};
use crate::vocabulary::Word;

use super::arity::surplus;
use super::stream::TokenKind;
use super::value::{Components, Poison, Value};
use super::{Evaluator, Here, Outcome, Reported, Unit};

/// Names of the components of vectors and colours.
const COMPONENTS: [&str; 12] =
    ["x", "y", "z", "t", "u", "v", "red", "green", "blue", "filter", "transmit", "gray"];

const MOST_COMPONENTS: usize = 5;

/// The components of a vector read so far.
#[derive(Default)]
struct Gathered {
    numbers: [f64; MOST_COMPONENTS],
    /// Their number; components beyond five are counted but not stored.
    count: usize,
    poison: Option<Poison>,
    failed: bool,
}

impl Gathered {
    fn push(&mut self, number: f64) {
        if let Some(slot) = self.numbers.get_mut(self.count) {
            *slot = number;
        }
        self.count += 1;
    }
}

impl Unit {
    /// Returns the span of a vector's component; `None` if the components are not written one by one.
    pub(super) fn component_span(&self, vector: ExpressionId, place: usize) -> Option<Span> {
        let vector = self.expression(vector);
        let components = match vector.kind {
            ExpressionKind::Vector(components) => components,
            ExpressionKind::Triple(triple) => {
                return triple.spans(vector.span).get(place).copied();
            }
            _ => return None,
        };
        let components = self.ast.arguments(components);
        let one_each = components.iter().all(|one| matches!(one, Argument::Expression(_)));
        match components.get(place) {
            Some(&Argument::Expression(id)) if one_each => Some(self.expression(id).span),
            _ => None,
        }
    }
}

/// Returns a vector without commas, as in POV-Ray before version 3 (`-1 -1 -1`), with commas inserted.
fn with_commas(inside: &str) -> Option<String> {
    let parts: Vec<&str> = inside.split_whitespace().collect();
    let is_signed = |part: &&str| {
        part.strip_prefix(['-', '+'])
            .is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_alphanumeric() || c == '.'))
    };
    let all = (2..=5).contains(&parts.len()) && parts[1..].iter().all(is_signed);
    all.then(|| format!("<{}>", parts.join(", ")))
}

impl Evaluator<'_> {
    pub(super) fn vector_value(
        &mut self,
        here: &Here,
        components: Arguments,
        span: Span,
    ) -> Outcome<Value> {
        let arguments = here.unit.ast.arguments(components);
        let mut gathered = Gathered::default();
        for argument in arguments {
            let found = match *argument {
                Argument::Items(items) => self
                    .inside(here, items, |evaluator| {
                        evaluator.components(here, span, MOST_COMPONENTS)
                    })
                    .map(|numbers| numbers.into_iter().for_each(|number| gathered.push(number))),
                Argument::Expression(id) => match self.plain_number(here, id) {
                    Some(number) => {
                        gathered.push(number);
                        Ok(())
                    }
                    None => match self.left_by_macro(here, id) {
                        None if self.value_before_group(here, id).is_some() => {
                            self.values_of_call(here, id).and_then(|values| {
                                values.into_iter().try_for_each(|value| {
                                    self.gather(here, id, value, &mut gathered)
                                })
                            })
                        }
                        None => self
                            .any_value(here, id)
                            .and_then(|value| self.gather(here, id, value, &mut gathered)),
                        Some(left) => left.and_then(|values| {
                            values
                                .into_iter()
                                .try_for_each(|value| self.gather(here, id, value, &mut gathered))
                        }),
                    },
                },
            };
            gathered.failed |= found.is_err();
        }
        let Gathered { numbers, count, poison, failed } = gathered;
        if failed {
            return Err(Reported);
        }
        if let Some(poison) = poison {
            return Ok(Value::Poison(poison));
        }
        match (Components::first(count, numbers), numbers.get(..count)) {
            (Some(vector), _) => {
                if count == 2 {
                    self.lint_typed_difference(here, components, span);
                }
                Ok(Value::Vector(vector))
            }
            (None, Some([_])) => {
                let inside = self.sources.text(span).trim_matches(['<', '>', ',', ' ']).to_owned();
                let message = "a vector has two to five components, this one has 1";
                let diagnostic = Diagnostic::new(Code::WrongArity, message)
                    .at(span, "one number between `<` and `>`");
                let diagnostic = match with_commas(&inside) {
                    Some(vector) => diagnostic
                        .help(format!("without commas it is a difference: write `{vector}`"))
                        .fix(span, vector),
                    None => diagnostic.help(format!(
                        "a place along the y axis is `<0, {inside}, 0>`; a number stands alone: `{inside}`"
                    )),
                };
                Err(self.report(here, diagnostic))
            }
            (None, Some([])) => {
                let diagnostic = Diagnostic::new(Code::WrongArity, "this vector has no components")
                    .at(span, "expected two to five numbers");
                Err(self.report(here, diagnostic))
            }
            (None, _) => {
                let message = format!("a vector has two to five components, this one has {count}");
                let diagnostic = Diagnostic::new(Code::WrongArity, message);
                let diagnostic = match arguments.get(5..).and_then(|more| surplus(here, more)) {
                    Some(sixth) => {
                        diagnostic.at(sixth, "too many components").also(span, "in this vector")
                    }
                    None => diagnostic.at(span, "too many components"),
                };
                let diagnostic = match self.commas_within(span) {
                    Some(vector) => diagnostic
                        .help(format!("a fraction is written with a point: `{vector}`"))
                        .fix(span, vector),
                    None => diagnostic.help("a position has three; a colour up to five: red, green, blue, filter and transmit"),
                };
                Err(self.report(here, diagnostic))
            }
        }
    }

    /// Returns the equivalent of a method call on a string, as in other languages: `Name.upper()`.
    fn method_of_string(&self, base: Span, component: Component) -> Option<String> {
        let Component::Name(_, span) = component else { return None };
        let function = match self.sources.text(span).to_ascii_lowercase().as_str() {
            "upper" | "toupper" | "touppercase" | "upcase" => "strupr",
            "lower" | "tolower" | "tolowercase" | "downcase" => "strlwr",
            "length" | "len" | "size" => "strlen",
            _ => return None,
        };
        Some(format!("write `{function}({})`", self.sources.text(base)))
    }

    /// Reports a name that is not a component of any value.
    pub(super) fn check_component(
        &mut self,
        here: &Here,
        base: ExpressionId,
        component: Component,
    ) -> Outcome<()> {
        let Component::Name(_, span) = component else { return Ok(()) };
        let ours = match self.sources.text(span) {
            "r" | "R" => "red",
            "g" | "G" => "green",
            "b" | "B" => "blue",
            "w" | "a" => "t",
            "grey" => "gray",
            // `.X`, `.Red`
            other => match COMPONENTS.iter().find(|one| one.eq_ignore_ascii_case(other)) {
                Some(ours) => ours,
                None => return Ok(()),
            },
        };
        let before = self.sources.text(here.unit.expression(base).span);
        let message = format!("`.{}` is no component", self.sources.text(span));
        let diagnostic = Diagnostic::new(Code::WrongArity, message)
            .at(span, "no such component")
            .help(format!("did you mean `{before}.{ours}`?"))
            .help("vectors have `.x .y .z .t`, or `.u .v`; colours have `.red .green .blue .filter .transmit .gray`")
            .fix(span, ours);
        Err(self.report(here, diagnostic))
    }

    /// Adds the value of an expression to the components of a vector.
    fn gather(
        &mut self,
        here: &Here,
        id: ExpressionId,
        value: Value,
        gathered: &mut Gathered,
    ) -> Outcome<()> {
        let other = match value {
            Value::Number(number) => {
                gathered.push(number);
                return Ok(());
            }
            Value::Poison(found) => {
                gathered.poison = gathered.poison.or(Some(found));
                return Ok(());
            }
            other => other,
        };
        let span = here.unit.expression(id).span;
        if self.is_refused_again(here, span, &other) {
            return Err(Reported);
        }
        let diagnostic = Diagnostic::new(
            Code::WrongType,
            format!("a component of a vector is a number, this is {}", other.kind()),
        )
        .at(span, "expected a number");
        let text = self.sources.text(span);
        let diagnostic = match (&other, here.unit.expression(id).kind) {
            (Value::Vector(_), ExpressionKind::Name(_)) => {
                diagnostic.help(format!("write its components: `{text}.x, {text}.y, {text}.z`"))
            }
            (Value::Array(_), ExpressionKind::Name(_)) => {
                diagnostic.help(format!("an element of it has its place: `{text}[0]`"))
            }
            _ => diagnostic,
        };
        let diagnostic = self.given_by_call(here, span, &other, diagnostic);
        Err(self.report(here, diagnostic))
    }

    /// Returns the numbers in brackets, which may be more than a vector has: those of a matrix or the
    /// coefficients of a polynomial. Directives and macros may contribute some of them.
    pub(super) fn numbers_of(
        &mut self,
        here: &Here,
        list: Arguments,
        span: Span,
    ) -> Outcome<Vec<f64>> {
        // No list has more than the coefficients of a polynomial of the highest order.
        let most = count_of_terms(15);
        let mut numbers = Ok(Vec::new());
        for argument in here.unit.ast.arguments(list) {
            let found = match *argument {
                Argument::Items(items) => {
                    self.inside(here, items, |evaluator| evaluator.components(here, span, most))
                }
                Argument::Expression(id) => match self.left_by_macro(here, id) {
                    None if self.value_before_group(here, id).is_some() => {
                        self.values_of_call(here, id).and_then(|values| {
                            let at = here.unit.expression(id).span;
                            let number = |value| self.as_number(here, at, value, "a number");
                            values.iter().map(number).collect()
                        })
                    }
                    None => self.number(here, id).map(|number| vec![number]),
                    Some(left) => left.and_then(|values| {
                        let at = here.unit.expression(id).span;
                        let number = |value| self.as_number(here, at, value, "a number");
                        values.iter().map(number).collect()
                    }),
                },
            };
            match (&mut numbers, found) {
                (Ok(numbers), Ok(found)) => numbers.extend(found),
                (numbers, Err(reported)) => *numbers = Err(reported),
                (Err(_), Ok(_)) => {}
            }
        }
        numbers
    }

    /// Returns the numbers that directives in a vector leave, up to one beyond the maximum.
    fn components(&mut self, here: &Here, span: Span, most: usize) -> Outcome<Vec<f64>> {
        let mut numbers = Vec::new();
        loop {
            match self.peek().map(|next| (next.kind.clone(), next.here.clone(), next.span)) {
                None => return Ok(numbers),
                Some((TokenKind::Comma, ..)) => drop(self.next()),
                Some((_, here_of_it, place)) => {
                    let value = self.value_or(here, span)?;
                    numbers.push(self.as_number(&here_of_it, place, &value, "a number")?);
                }
            }
            if numbers.len() > most {
                return Ok(numbers);
            }
        }
    }

    pub(super) fn component_value(
        &mut self,
        here: &Here,
        value: &Value,
        component: Component,
        base: Span,
    ) -> Outcome<Value> {
        if let Value::Poison(_) = value {
            return Ok(value.clone());
        }
        let (index, span) = match component {
            // A number is its own first component, and has no others (measured).
            Component::Word(Word::Gray, _) if let Value::Number(red) = *value => {
                return Ok(Value::Number(gray(Color::opaque(Rgb::new(red, 0.0, 0.0)))));
            }
            Component::Word(Word::X | Word::Red | Word::U, _) if let Value::Number(_) = value => {
                return Ok(value.clone());
            }
            Component::Word(Word::Gray, _) => {
                let Some(color) = value.as_color() else {
                    return Err(self.wrong_type(here, base, "a colour before `.gray`", value));
                };
                return Ok(Value::Number(gray(color)));
            }
            Component::Word(word, span) => (component_index(word), span),
            Component::Name(_, span) => (None, span),
        };
        let numbers = match value {
            Value::Vector(_) | Value::Color(_) => value.numbers(),
            _ => None,
        };
        let Some(numbers) = numbers else {
            let method = match value {
                Value::String(_) => self.method_of_string(base, component),
                _ => None,
            };
            let wanted = "a vector or a colour before the dot";
            return Err(self.wrong_type_with(here, base, wanted, value, method));
        };
        match index.and_then(|index| numbers.as_slice().get(index)) {
            Some(number) => Ok(Value::Number(*number)),
            None => {
                let text = self.sources.text(span).to_owned();
                let diagnostic = Diagnostic::new(
                    Code::WrongArity,
                    format!(
                        "`.{text}` is no component of {} with {} components",
                        value.kind(),
                        numbers.len()
                    ),
                )
                .at(span, "no such component");
                let base = self.sources.text(base);
                let diagnostic = match text.to_lowercase().as_str() {
                    "length" | "len" | "magnitude" => {
                        diagnostic.help(format!("how long a vector is: `vlength({base})`"))
                    }
                    "normalized" | "unit" => {
                        diagnostic.help(format!("of length 1: `vnormalize({base})`"))
                    }
                    _ => diagnostic,
                };
                let diagnostic = diagnostic
                .help("vectors have `.x .y .z .t`, or `.u .v`; colours have `.red .green .blue .filter .transmit .gray`");
                Err(self.report(here, diagnostic))
            }
        }
    }
}

/// Returns the brightness of a colour: `.gray`.
pub(super) fn gray(color: Color) -> f64 {
    0.297 * color.rgb.red + 0.589 * color.rgb.green + 0.114 * color.rgb.blue
}

/// Returns the index of the component that a word after a dot denotes.
pub(super) fn component_index(word: Word) -> Option<usize> {
    match word {
        Word::X | Word::U | Word::Red => Some(0),
        Word::Y | Word::V | Word::Green => Some(1),
        Word::Z | Word::Blue => Some(2),
        Word::T | Word::Filter => Some(3),
        Word::Transmit => Some(4),
        _ => None,
    }
}
