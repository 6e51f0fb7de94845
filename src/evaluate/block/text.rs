//! `text`: a font, a string, how thick the letters are, and how far apart.

use std::collections::HashMap;
use std::sync::Arc;

use crate::diagnostic::{Code, Diagnostic};
use crate::font::{BUILT_IN, Font, POV_RAYS};
use crate::scene::Solid;
use crate::scene::text::Text;
use crate::source::{FileError, FileId, Span};
use crate::vocabulary::Word;

use super::super::include::missing_file;
use super::super::stream::{Token, TokenKind};
use super::super::value::Value;
use super::super::{Evaluator, Here, Outcome};

/// Fonts that were read, by their names and the files that named them.
pub(in crate::evaluate) type Fonts = HashMap<(String, FileId), Arc<[u8]>>;

impl Evaluator<'_> {
    /// `text { ttf "file" "string" thickness, offset }`, or `internal n` instead of the file, or neither.
    ///
    /// **Source:** POV-Ray 3.7 manual, 3.4.5.1.16 "Text"; the numbers of its fonts and what an offset along z
    /// does, nothing, were measured.
    pub(super) fn text(&mut self, token: &Token) -> Outcome<Solid> {
        let font = self.font()?;
        let wanted = "a string: what is written";
        let given = self.given(token, wanted)?;
        let Value::String(string) = &given.value else {
            return Err(self.wrong_type(&given.here, given.span, wanted, &given.value));
        };
        let string = string.to_string();
        let thickness = self.number_after(token, "a number for the thickness")?;
        let wanted = "a vector for the offset of each letter";
        let offset = self.given(token, wanted)?;
        let offset = self.as_vector(offset, wanted)?.value;
        let fits = |bytes: u64| self.has_memory(bytes + string.len() as u64);
        let letters = match Font::parse(&font) {
            Ok(font) => font.set(&string, [offset.x, offset.y], fits),
            // It was when it was read.
            Err(_) => Some(Vec::new()),
        };
        let Some(letters) = letters else {
            return Err(self.too_much_memory(&token.here, token.span));
        };
        let text = Text { string, letters, thickness: thickness.value };
        self.stored += text.letters.iter().map(|letter| letter.bytes()).sum::<u64>();
        if text.thickness == 0.0 {
            let diagnostic = Diagnostic::new(self.sizeless(), "a text of thickness 0 is nothing")
                .at(thickness.span, "expected a number other than 0");
            self.nothing(token, &thickness.here, diagnostic)?;
        } else if text.letters.is_empty() && text.string.is_empty() {
            let diagnostic = Diagnostic::new(self.sizeless(), "a text of no letters is nothing")
                .at(given.span, "expected what is to be written");
            self.nothing(token, &given.here, diagnostic)?;
        }
        Ok(Solid::Text { text: Arc::new(text) })
    }

    /// The bytes of the font that a text is written in: of one that can be parsed.
    fn font(&mut self) -> Outcome<Arc<[u8]>> {
        if let Some(internal) = self.take_word(Word::Internal) {
            return self.internal_font(&internal);
        }
        let Some(ttf) = self.take_word(Word::Ttf) else { return Ok(BUILT_IN.into()) };
        self.skip_commas();
        let (name, here, span) = match self.peek().cloned() {
            Some(Token { kind: TokenKind::Expression(id), here, span }) => {
                self.next();
                (self.path(&here, id)?, here, span)
            }
            _ => {
                let wanted = "the name of a font's file";
                let given = self.given(&ttf, wanted)?;
                let Value::String(name) = &given.value else {
                    return Err(self.wrong_type(&given.here, given.span, wanted, &given.value));
                };
                (name.to_string(), given.here.clone(), given.span)
            }
        };
        self.font_of(&name, &here, span)
    }

    fn internal_font(&mut self, internal: &Token) -> Outcome<Arc<[u8]>> {
        let number = self.number_after(internal, "the number of a font, 0 to 3")?;
        let name = POV_RAYS.get(number.value as usize).filter(|_| number.value >= 0.0);
        match name {
            Some(name) => self.font_of(name, &number.here, number.span),
            None => {
                let message =
                    format!("there is no font {}: the built-in one is used", number.value);
                let diagnostic = Diagnostic::new(Code::StandInFont, message)
                    .at(number.span, "expected 0 to 3")
                    .help("0 is povlogo.ttf, 1 timrom.ttf, 2 cyrvetic.ttf, 3 crystal.ttf");
                self.report(&number.here, diagnostic);
                Ok(BUILT_IN.into())
            }
        }
    }

    fn font_of(&mut self, name: &str, here: &Here, span: Span) -> Outcome<Arc<[u8]>> {
        let key = (name.to_owned(), span.file);
        if let Some(known) = self.fonts.get(&key) {
            return Ok(known.clone());
        }
        let from = self.sources.get(span.file).name.clone();
        let bytes: Arc<[u8]> = match self.files.read(name, &from) {
            Ok(found) => found.bytes.into(),
            Err(FileError::NotFound { .. }) if POV_RAYS.contains(&name) => {
                let message = format!("`{name}` is not found: the built-in font is used");
                let diagnostic = Diagnostic::new(Code::StandInFont, message)
                    .at(span, "its letters are not as wide")
                    .help("it comes with POV-Ray (Debian: povray-includes); `-I FOLDER` adds a folder to search");
                self.report(here, diagnostic);
                BUILT_IN.into()
            }
            Err(error) => {
                let diagnostic = missing_file(name, span, error);
                return Err(self.report(here, diagnostic));
            }
        };
        if let Err(reason) = Font::parse(&bytes) {
            let message = format!("`{name}` is no font that can be read: {reason}");
            let diagnostic = Diagnostic::new(Code::UnreadableFile, message)
                .at(span, "expected a TrueType or OpenType font");
            return Err(self.report(here, diagnostic));
        }
        self.stored += bytes.len() as u64;
        self.fonts.insert(key, bytes.clone());
        Ok(bytes)
    }
}
