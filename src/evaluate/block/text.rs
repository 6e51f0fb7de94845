//! `text`: a font, a string, the thickness of the letters, and their spacing.

use std::collections::HashMap;
use std::sync::Arc;

use crate::diagnostic::{Code, Diagnostic};
use crate::font::{BUILT_IN, Font, POV_RAYS};
use crate::scene::Solid;
use crate::scene::text::Text;
use crate::source::{FileError, FileId, Span};
use crate::syntax::ast::{BinaryOperator, ExpressionKind};
use crate::vocabulary::Word;

use super::super::include::missing_file;
use super::super::stream::{Token, TokenKind};
use super::super::value::Value;
use super::super::{Evaluator, Outcome};
use super::Given;
use super::named::{NamedFile, is_of_font};

/// Fonts that were read, by their names and the files that named them.
pub(in crate::evaluate) type Fonts = HashMap<(String, FileId), Arc<[u8]>>;

impl Evaluator<'_> {
    /// Reads `text { ttf "file" "string" thickness, offset }`, or with `internal n` instead of the file, or
    /// neither.
    ///
    /// **Source:** POV-Ray 3.7 manual, 3.4.5.1.16 "Text". Measured: the numbers of its fonts, and that an
    /// offset along z has no effect.
    pub(super) fn text(&mut self, token: &Token) -> Outcome<Solid> {
        let font = self.font()?;
        let wanted = "a string: what is written";
        self.skip_commas();
        if let Some(Token { kind: TokenKind::Expression(id), here, .. }) = self.peek().cloned()
            && let Some(reported) = self.lacks_quotes(&here, id)
        {
            self.next();
            return Err(reported);
        }
        let is_written = self.is_before_value();
        let (given, thickness) = match self.string_and_number()? {
            Some((string, number)) => (Ok(string), Some(number)),
            None => (self.given(token, wanted), None),
        };
        if given.is_err() && is_written && !self.is_before_value() {
            // A mistake in the string does not hide those after it.
            self.number_after(token, "a number for the thickness")?;
        }
        let given = given?;
        let Value::String(string) = &given.value else {
            let text = self.sources.text(given.span);
            let all = &self.sources.get(given.span.file).text;
            let behind = all.get(given.span.end as usize..).and_then(|rest| rest.split('}').next());
            let is_behind = behind.is_some_and(|rest| rest.contains('"'));
            let help = matches!(given.value, Value::Number(_)).then(|| match text.parse::<f64>() {
                Ok(_) if is_behind => "the string comes before its numbers: \
                    `text { \"…\" thickness, offset }`"
                    .to_owned(),
                Ok(_) => format!("write `\"{text}\"`"),
                Err(_) => format!("a number becomes a string by `str({text}, 0, -1)`"),
            });
            let Given { here, span, value, .. } = &given;
            return Err(self.wrong_type_with(here, *span, wanted, value, help));
        };
        let string = string.to_string();
        self.names_font(&given, &string)?;
        let thickness = match thickness {
            Some(given) => given,
            None => self.number_after(token, "a number for the thickness")?,
        };
        let wanted = "a vector for the offset of each letter";
        let offset = self.given(token, wanted)?;
        let offset = self.as_vector(offset, wanted)?.value;
        let fits = |bytes: u64| self.has_memory(bytes + string.len() as u64);
        let (letters, missing) = match Font::parse(&font) {
            Ok(font) => {
                (font.set(&string, [offset.x, offset.y], fits), font.first_missing(&string))
            }
            // It was valid when it was read.
            Err(_) => (Some(Vec::new()), None),
        };
        let Some(letters) = letters else {
            return Err(self.too_much_memory(&token.here, token.span));
        };
        if let Some(letter) = missing {
            let message = format!("the font has no {letter:?}, and shows a box or nothing for it");
            let diagnostic = Diagnostic::new(Code::MissingLetter, message)
                .at(given.span, "not all of this is in the font")
                .help("`text { ttf \"file.ttf\" … }` names another font");
            self.report(&given.here, diagnostic);
        }
        let text = Text { string, letters, thickness: thickness.value };
        self.stored += text.letters.iter().map(|letter| letter.bytes()).sum::<u64>();
        if text.string.is_empty() {
            let diagnostic = Diagnostic::new(self.sizeless(), "a text of no letters is nothing")
                .at(given.span, "expected what is to be written");
            self.nothing(token, &given.here, diagnostic)?;
        } else if text.is_nothing() {
            // A blank need not be reported: loops may write letter by letter.
            self.scene.sizeless.push((Word::Text.name(), token.here.site(token.span)));
        }
        Ok(Solid::Text { text: Arc::new(text) })
    }

    /// Reads a string and a signed number without a comma between them, `"Pov" -0.5`, which parse as a
    /// difference.
    fn string_and_number(&mut self) -> Outcome<Option<(Given<Value>, Given<f64>)>> {
        let Some(Token { kind: TokenKind::Expression(id), here, span }) = self.peek().cloned()
        else {
            return Ok(None);
        };
        let mut first = id;
        let mut terms = Vec::new();
        while let ExpressionKind::Binary(sign, left, right) = here.unit.expression(first).kind {
            match sign {
                BinaryOperator::Subtract => terms.push((-1.0, right)),
                BinaryOperator::Add => terms.push((1.0, right)),
                _ => return Ok(None),
            }
            first = left;
        }
        // An operand after `+` is meant as part of the string.
        let is_number = terms.last().is_some_and(|(sign, _)| *sign < 0.0);
        let value = match here.unit.expression(first).kind {
            ExpressionKind::String if is_number => self.expression(&here, first)?,
            ExpressionKind::Name(_) if is_number => match self.named(&here, first) {
                Some(value @ Value::String(_)) => value,
                _ => return Ok(None),
            },
            _ => return Ok(None),
        };
        self.next();
        let written = here.unit.expression(first).span;
        let string = Given { value, span: written, here: here.clone(), expression: Some(first) };
        let span = Span { start: written.end, ..span };
        let mut number = 0.0;
        for (sign, term) in terms.into_iter().rev() {
            let value = self.expression(&here, term)?;
            let wanted = "a number for the thickness";
            number +=
                sign * self.as_number(&here, here.unit.expression(term).span, &value, wanted)?;
        }
        Ok(Some((string, Given { value: number, span, here, expression: None })))
    }

    /// Reports a font file without `ttf` before it: `text { "timrom.ttf" "string" … }`.
    fn names_font(&mut self, given: &Given<Value>, string: &str) -> Outcome<()> {
        let ending = string.rsplit('.').next().unwrap_or("").to_ascii_lowercase();
        let is_string = match self.peek().cloned() {
            Some(Token { kind: TokenKind::Expression(id), here, span }) => {
                self.sources.text(span).starts_with('"')
                    || matches!(self.named(&here, id), Some(Value::String(_)))
            }
            Some(Token { kind: TokenKind::Literal(value), .. }) => {
                matches!(*value, Value::String(_))
            }
            _ => false,
        };
        if !matches!(ending.as_str(), "ttf" | "otf" | "ttc") || !is_string {
            return Ok(());
        }
        let text = self.sources.text(given.span).to_owned();
        let diagnostic = Diagnostic::new(Code::MissingPart, "the kind of this font is not said")
            .at(given.span, "expected `ttf` before the name of a font's file")
            .help(format!("write `ttf {text}`"))
            .fix(Span { end: given.span.start, ..given.span }, "ttf ");
        Err(self.report(&given.here, diagnostic))
    }

    /// Returns the bytes of a text's font, which have been checked to parse.
    fn font(&mut self) -> Outcome<Arc<[u8]>> {
        if let Some(internal) = self.take_word(Word::Internal) {
            return self.internal_font(&internal);
        }
        let next = self.peek().cloned();
        let is_meant = self.misspelt_part(Word::Text, &[Word::Ttf]).is_some();
        let ttf = if is_meant { next } else { self.take_word(Word::Ttf) };
        let Some(ttf) = ttf else { return Ok(BUILT_IN.into()) };
        let file = self.named_file(&ttf, "the name of a font's file")?;
        self.font_of(&file)
    }

    fn internal_font(&mut self, internal: &Token) -> Outcome<Arc<[u8]>> {
        let number = self.number_after(internal, "the number of a font, 0 to 3")?;
        let font = POV_RAYS.get(number.value as usize).filter(|_| number.value >= 0.0);
        if font.is_none() {
            let message = format!("there is no font {}: font 0 is used", number.value);
            let diagnostic = Diagnostic::new(Code::StandInFont, message)
                .at(number.span, "expected 0 to 3")
                .help("0 is povlogo.ttf, 1 timrom.ttf, 2 cyrvetic.ttf, 3 crystal.ttf");
            self.report(&number.here, diagnostic);
        }
        let name = (*font.unwrap_or(&POV_RAYS[0])).to_owned();
        self.font_of(&NamedFile { name, here: number.here, span: number.span })
    }

    fn font_of(&mut self, file: &NamedFile) -> Outcome<Arc<[u8]>> {
        let NamedFile { name, here, span } = file;
        let key = (name.clone(), span.file);
        if let Some(known) = self.fonts.get(&key) {
            return Ok(known.clone());
        }
        let bytes: Arc<[u8]> = match self.read_named(file, &[".ttf", ".TTF"]) {
            Ok(found) => found.bytes.into(),
            Err(FileError::NotFound { .. })
                if POV_RAYS.iter().any(|font| font.strip_suffix(".ttf") == Some(stem(name))) =>
            {
                let message = format!("`{name}` is not found: the built-in font is used");
                let diagnostic = Diagnostic::new(Code::StandInFont, message)
                    .at(*span, "its letters are not as wide")
                    .help("it comes with POV-Ray (Debian: povray-includes); `-I FOLDER` adds a folder to search");
                self.report(here, diagnostic);
                BUILT_IN.into()
            }
            Err(error) => {
                let fonts: Vec<String> = POV_RAYS.iter().map(|font| format!("`{font}`")).collect();
                let diagnostic = missing_file(name, *span, error, is_of_font).help(format!(
                    "with POV-Ray come {}; without `ttf \"…\"` it is the font that is built in",
                    fonts.join(", ")
                ));
                return Err(self.report(here, diagnostic));
            }
        };
        if let Err(reason) = Font::parse(&bytes) {
            let message = format!("`{name}` is no font that can be read: {reason}");
            let diagnostic = Diagnostic::new(Code::UnreadableFile, message)
                .at(*span, "expected a TrueType or OpenType font");
            return Err(self.report(here, diagnostic));
        }
        self.stored += bytes.len() as u64;
        self.fonts.insert(key, bytes.clone());
        Ok(bytes)
    }
}

/// Returns a font's name without its extension.
fn stem(name: &str) -> &str {
    name.strip_suffix(".ttf").unwrap_or(name)
}
