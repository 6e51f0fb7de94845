//! `#write`: writes values to an open file.

use crate::source::Span;
use crate::syntax::ast::{
    Argument, Arguments, BinaryOperator, ExpressionId, ExpressionKind, NameId,
};

use super::super::stream::TokenKind;
use super::super::value::Value;
use super::super::{Evaluator, Here, Outcome};
use super::State;
use super::bytes::{WordType, append};

/// Splits two values without a comma between them: `"a" -1`.
fn string_and_number(here: &Here, id: ExpressionId) -> Option<(ExpressionId, ExpressionId)> {
    let kind = |id: ExpressionId| here.unit.expression(id).kind;
    match kind(id) {
        ExpressionKind::Binary(BinaryOperator::Subtract, string, number) => {
            matches!(kind(string), ExpressionKind::String).then_some((string, number))
        }
        _ => None,
    }
}

impl Evaluator<'_> {
    /// Runs `#write (Name, value, …)`, which writes all of its values or none.
    pub(in crate::evaluate) fn write_values(
        &mut self,
        here: &Here,
        name: (NameId, Span),
        arguments: Arguments,
    ) -> Outcome<()> {
        let handle = match self.opened(here, name) {
            Ok(handle) => handle,
            Err(reported) => {
                self.run_arguments(here, arguments);
                return Err(reported);
            }
        };
        let file = match &self.opened[handle.0 as usize].state {
            State::Writing { name } => name.clone(),
            State::Reading { .. } | State::Closed { .. } => {
                return Err(self.other_way(here, handle, name.1, "read", "write"));
            }
        };
        let unit = here.unit.clone();
        let (mut bytes, mut outcome) = (Vec::new(), Ok(()));
        for argument in unit.ast.arguments(arguments) {
            let done = match *argument {
                Argument::Expression(id) => match string_and_number(here, id) {
                    // A string has no difference.
                    Some((string, number)) => self.expression(here, string).and_then(|value| {
                        self.write(here, unit.expression(string).span, &value, None, &mut bytes)?;
                        let number = Value::Number(-self.number(here, number)?);
                        self.write(here, unit.expression(id).span, &number, None, &mut bytes)
                    }),
                    None => self.expression(here, id).and_then(|value| {
                        self.write(here, unit.expression(id).span, &value, None, &mut bytes)
                    }),
                },
                Argument::Items(items) => {
                    self.inside(here, items, |evaluator| evaluator.write_items(&mut bytes))
                }
            };
            outcome = outcome.and(done);
        }
        outcome?;
        self.stored += bytes.len() as u64;
        self.add_to_file(&file, &bytes);
        self.parsed.remove(&file);
        Ok(())
    }

    /// Writes adjacent values, after the word for their format, if any.
    fn write_items(&mut self, bytes: &mut Vec<u8>) -> Outcome<()> {
        let (mut form, mut outcome) = (None, Ok(()));
        while let Some(token) = self.next() {
            let done = match token.kind {
                TokenKind::Comma => {
                    form = None;
                    Ok(())
                }
                TokenKind::Word(word) if WordType::of(word).is_some() => {
                    form = WordType::of(word);
                    Ok(())
                }
                _ => self
                    .value_of(&token)
                    .and_then(|value| self.write(&token.here, token.span, &value, form, bytes)),
            };
            outcome = outcome.and(done);
        }
        outcome
    }

    fn write(
        &mut self,
        here: &Here,
        span: Span,
        value: &Value,
        form: Option<WordType>,
        bytes: &mut Vec<u8>,
    ) -> Outcome<()> {
        if let Value::Poison(poison) = value {
            return Err(self.not_supported(*poison, Some(span)));
        }
        if append(value, form, bytes) {
            return Ok(());
        }
        let wanted = match form {
            Some(_) => "a number or a vector, as whole numbers are written of",
            None => "a number, a vector or a string",
        };
        let help = matches!(value, Value::Color(_)).then(|| {
            let text = self.sources.text(span);
            match text.chars().all(|c| c.is_ascii_alphanumeric() || c == '_') && text != "rgb" {
                true => format!("write its parts: `<{text}.red, {text}.green, {text}.blue>`"),
                false => "a vector of its parts has no `rgb` before it".to_owned(),
            }
        });
        Err(self.wrong_type_with(here, span, wanted, value, help))
    }
}
