//! `height_field`: a terrain from an image or a function.

use std::sync::Arc;

use crate::color::{Gamma, Rgb};
use crate::diagnostic::{Code, Diagnostic};
use crate::picture::heights::{self, Heights};
use crate::scene::Solid;
use crate::scene::height_field::HeightField;
use crate::source::Span;
use crate::vocabulary::Word;

use super::super::function::{Functions, ParameterName, outside_id};
use super::super::include::missing_file;
use super::super::stream::{Token, TokenKind};
use super::super::value::Value;
use super::super::{Evaluator, Outcome, Reported};
use super::named::{NamedFile, is_of_picture};
use crate::function::Outside;

/// Keywords for image types, and their file extensions.
const TYPES: [(Word, &[&str]); 13] = [
    (Word::Bmp, &[".bmp", ".BMP"]),
    (Word::Exr, &[".exr", ".EXR"]),
    (Word::Gif, &[".gif", ".GIF"]),
    (Word::Hdr, &[".hdr", ".HDR"]),
    (Word::Iff, &[".iff", ".IFF"]),
    (Word::Jpeg, &[".jpg", ".JPG", ".jpeg", ".JPEG"]),
    (Word::Pgm, &[".pgm", ".PGM"]),
    (Word::Png, &[".png", ".PNG"]),
    (Word::Pot, &[".pot", ".POT"]),
    (Word::Ppm, &[".ppm", ".PPM"]),
    (Word::Sys, &[".bmp", ".BMP"]),
    (Word::Tga, &[".tga", ".TGA"]),
    (Word::Tiff, &[".tif", ".TIF", ".tiff", ".TIFF"]),
];

/// Maximum number of samples of a function along a side.
const MOST: f64 = (1 << 15) as f64;

impl Evaluator<'_> {
    /// Reads `height_field { [png] "file" | function W, H { … } [smooth] [water_level n] }`.
    ///
    /// **Source:** POV-Ray 3.7 manual, 3.4.5.1.5 "Height Field". The top row of an image is at z = 1; a
    /// function is evaluated at x and 1 − z, and only the fractional part of its value counts; the value of a
    /// pigment is its brightness (measured).
    pub(super) fn height_field(&mut self, token: &Token) -> Outcome<Solid> {
        let function = self.take_word(Word::Function);
        let read = match &function {
            Some(function) => self.heights_of_function(function),
            None => self.heights_of_picture(token),
        };
        // The following items are read for their own mistakes.
        let (mut smooth, mut water) = (false, None);
        while let Some((item, word)) = self.next_item(&[Word::Smooth, Word::WaterLevel]) {
            match word {
                Word::Smooth => smooth = self.optional_flag(&item)?,
                _ => {
                    water = Some(self.number_after(&item, "a number for the height of the water")?);
                }
            }
        }
        let (from, Heights { width, heights: upper_first }) = read?;
        let mut heights = Vec::with_capacity(upper_first.len());
        upper_first.chunks_exact(width).rev().for_each(|row| heights.extend_from_slice(row));
        self.stored += size_of_val(&heights[..]) as u64;
        let level = water.as_ref().map_or(0.0, |level| level.value);
        let field = HeightField { from, heights, width, water: level, smooth };
        if let Some(level) = water.filter(|_| field.is_nothing()) {
            let message = "nothing of this landscape is above the water";
            let diagnostic = Diagnostic::new(self.sizeless(), message)
                .at(level.span, "expected less than its greatest height, which is 1 or less");
            self.nothing(token, &level.here, diagnostic)?;
        }
        Ok(Solid::HeightField { field: Arc::new(field) })
    }

    /// Returns the next item after the heights; a misspelt one is reported.
    fn next_item(&mut self, words: &[Word]) -> Option<(Token, Word)> {
        self.skip_commas();
        let next = self.peek()?.clone();
        if let Some(word) = self.misspelt_part(Word::HeightField, words) {
            return Some((Token { kind: TokenKind::Word(word), ..next }, word));
        }
        words.iter().find_map(|word| self.take_word(*word).map(|token| (token, *word)))
    }

    fn heights_of_picture(&mut self, token: &Token) -> Outcome<(String, Heights)> {
        let said = self.next_part(Word::HeightField, &TYPES.map(|(word, _)| word));
        let kind =
            TYPES.into_iter().find(|(word, _)| said.as_ref().is_some_and(|(_, said)| said == word));
        let file = self.named_file(token, "the name of a picture's file, or a function")?;
        let mut gamma = Gamma::LINEAR;
        if let Some(word) = self.take_word(Word::GammaWord) {
            gamma = self.gamma_after(&word, Word::GammaWord)?;
        }
        if let Some(word) = self.take_word(Word::Premultiplied) {
            self.optional_flag(&word)?;
        }
        let endings = kind.map_or(&[][..], |(_, endings)| endings);
        let NamedFile { name, here, span } = &file;
        let found = match self.read_named(&file, endings) {
            Ok(found) => found,
            Err(error) => {
                let diagnostic = missing_file(name, *span, error, is_of_picture);
                return Err(self.report(here, diagnostic));
            }
        };
        let mut is_tga = matches!(kind, Some((Word::Tga, _)));
        match (heights::kind_told(&found.bytes), &said) {
            (Some(told), Some((word, _))) if is_tga => {
                return Err(self.is_no_tga(&file, word, told));
            }
            // By its name alone.
            (None, None) => is_tga = name.to_ascii_lowercase().ends_with(".tga"),
            _ => {}
        }
        let read = match kind {
            Some((Word::Pot, _)) => heights::read_potential(&found.bytes),
            _ => heights::read(&found.bytes, is_tga, gamma),
        };
        match read {
            Ok(heights) => Ok((file.name, heights)),
            Err(reason) => {
                let message = format!("`{name}` cannot be read as a picture: {reason}");
                let diagnostic = Diagnostic::new(Code::UnreadableFile, message)
                    .at(*span, "expected a PNG, GIF, JPEG, TGA, TIFF, PPM, PGM, BMP, HDR or EXR");
                Err(self.report(here, diagnostic))
            }
        }
    }

    /// Reports a file named as TGA whose first bytes are those of another type: `tga "hills.png"`.
    fn is_no_tga(&mut self, file: &NamedFile, tga: &Token, told: (&str, &str)) -> Reported {
        let ((kind, word), NamedFile { name, here, span }) = (told, file);
        let message = format!("`{name}` is no TGA: by its first bytes it is a {kind}");
        let told = Diagnostic::new(Code::UnreadableFile, message)
            .at(*span, "this file")
            .also(tga.span, "read as this")
            .help(format!("write `{word}` instead of `tga`"))
            .fix(tga.span, word);
        self.report(here, told)
    }

    /// Reports missing sample counts, after those in `before`: `function { x*y }`, `function 100 { x*y }`.
    fn lacks_sizes(&mut self, before: Option<Span>) -> Option<Reported> {
        let next = self.peek()?.clone();
        let TokenKind::Block(_) = next.kind else { return None };
        let opener = next.span_head();
        let message = "the `function` of a landscape begins with how many heights it has";
        let told = Diagnostic::new(Code::MissingPart, message);
        let told = match before {
            Some(first) => {
                let first_text = self.sources.text(first);
                let right = format!("{first_text}, {first_text}");
                told.at(opener, "expected how many along z")
                    .help(format!("write `function {right} {{ … }}`"))
                    .fix(first, right)
            }
            None => told
                .at(opener, "expected two numbers: how many along x, and along z")
                .help("write `function 300, 300 { … }`")
                .fix(Span { end: next.span.start, ..next.span }, "300, 300 "),
        };
        let reported = self.report(&next.here, told);
        self.skip_arguments(Word::Union);
        Some(reported)
    }

    /// Reads `function W, H { … }`, after its keyword.
    fn heights_of_function(&mut self, word: &Token) -> Outcome<(String, Heights)> {
        let mut before = None;
        let mut size = |name: &str| -> Outcome<usize> {
            if let Some(reported) = self.lacks_sizes(before) {
                return Err(reported);
            }
            let given = self.number_after(word, &format!("how many heights {name}"))?;
            self.lint_count(&given.here, given.span, given.value);
            let count = given.value.trunc();
            before = Some(given.span);
            if (2.0..=MOST).contains(&count) {
                return Ok(count as usize);
            }
            let message = format!("a landscape of {count} heights {name}");
            let diagnostic = Diagnostic::new(Code::OutOfRange, message)
                .at(given.span, format!("expected 2 to {MOST}"));
            if !(0.0..2.0).contains(&count) {
                return Err(self.report(&given.here, diagnostic));
            }
            // POV-Ray 3.7 then draws nothing (measured).
            self.opinion(&given.here, diagnostic)?;
            Ok(count as usize)
        };
        let (width, rows) = (size("along x")?, size("along z")?);
        if !self.has_memory(2 * (width * rows * size_of::<f32>()) as u64) {
            return Err(self.too_much_memory(&word.here, word.span));
        }
        let parameters = [0, 1, 2].map(ParameterName::Axis);
        let id = match self.function_of(word, &parameters)? {
            Value::Function(id) => id,
            Value::Poison(poison) => {
                self.set_poison(poison);
                return Err(Reported);
            }
            _ => return Err(Reported),
        };
        let function = &self.functions[id.0 as usize];
        if function.compound() == Some("a vector") {
            let message = "the value of this function is a vector, and no height";
            let diagnostic = Diagnostic::new(Code::WrongType, message)
                .at(word.span, "expected a formula, a pattern or a pigment");
            return Err(self.report(&word.here, diagnostic));
        }
        let is_color = function.compound() == Some("a colour");
        let components = [0, 1, 2].map(|component| outside_id(id, component));
        if width.min(rows) < 2 {
            return Ok(("a function".to_owned(), Heights { width: 2, heights: Vec::new() }));
        }
        let functions = Functions { all: &self.functions, noise: self.noise };
        let place = |i: usize, count: usize| i as f64 / (count - 1) as f64;
        let mut heights = Vec::with_capacity(width * rows);
        let mut stray = None;
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for row in 0..rows {
            for column in 0..width {
                let (x, y) = (place(column, width), place(row, rows));
                let component = |id| functions.value(id, &[x, y, 0.0]);
                let mut value = if is_color {
                    let [red, green, blue] = components.map(component);
                    Rgb { red, green, blue }.brightness()
                } else {
                    component(components[0])
                };
                if !value.is_finite() {
                    stray.get_or_insert((x, y));
                    value = 0.0;
                }
                (low, high) = (low.min(value), high.max(value));
                heights.push(heights::height(wrapped(value)));
            }
        }
        if let Some((x, y)) = stray {
            let message = format!("this function has no finite value at x = {x}, y = {y}");
            let diagnostic =
                Diagnostic::new(Code::NotANumber, message).at(word.span, "of this landscape");
            self.opinion(&word.here, diagnostic)?;
        }
        if low < 0.0 || high > 1.0 {
            // As short as they remain distinct.
            let (low, high) = (low as f32, high as f32);
            let message =
                format!("the heights of this function go from {low} to {high}, not from 0 to 1");
            let diagnostic = Diagnostic::new(Code::HeightRange, message)
                .at(word.span, "above 1 they begin anew at 0, and below 0 at 1")
                .help("bring them between 0 and 1, and make the landscape higher by `scale`");
            self.report(&word.here, diagnostic);
        }
        Ok(("a function".to_owned(), Heights { width, heights }))
    }
}

/// Returns the fractional part of a height beyond 0 … 1, above the greatest integer below it.
///
/// **Source:** measured in POV-Ray 3.7: 2 and 3 become 1, −1 and −2 become 0.
fn wrapped(height: f64) -> f64 {
    match height {
        0.0..=1.0 => height,
        _ if height > 1.0 => height - height.ceil() + 1.0,
        _ => height - height.floor(),
    }
}
