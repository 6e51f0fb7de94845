//! Files that a block names: fonts, images and meshes.

use super::super::stream::{Token, TokenKind};
use super::super::value::Value;
use super::super::{Evaluator, Here, Outcome, Reported};
use crate::diagnostic::{Code, Diagnostic};
use crate::mesh_file;
use crate::source::{FileError, Found, Source, Span};
use crate::syntax::ast::{ExpressionId, ExpressionKind};

const FONTS: [&str; 3] = ["ttf", "otf", "ttc"];
const PICTURES: [&str; 16] = [
    "png", "gif", "jpg", "jpeg", "tga", "tif", "tiff", "bmp", "ppm", "pgm", "hdr", "exr", "iff",
    "pot", "sys", "qoi",
];

fn ends_with(name: &str, endings: &[&str]) -> bool {
    let ending = name.rsplit_once('.').map(|(_, ending)| ending.to_ascii_lowercase());
    ending.is_some_and(|ending| endings.contains(&ending.as_str()))
}

/// Returns whether a file name has a font's extension.
pub(super) fn is_of_font(name: &str) -> bool {
    ends_with(name, &FONTS)
}

/// Returns whether a file name has an image's extension.
pub(super) fn is_of_picture(name: &str) -> bool {
    ends_with(name, &PICTURES)
}

/// A file name and its span.
pub(super) struct NamedFile {
    pub name: String,
    pub here: Here,
    pub span: Span,
}

impl Evaluator<'_> {
    /// Reads the file name that comes next; `wanted` describes the file.
    pub(super) fn named_file(&mut self, token: &Token, wanted: &str) -> Outcome<NamedFile> {
        self.skip_commas();
        if let Some(Token { kind: TokenKind::Expression(id), here, span }) = self.peek().cloned() {
            self.next();
            if let Some(reported) = self.unquoted(&here, id) {
                return Err(reported);
            }
            let name = self.path(&here, id)?;
            return Ok(NamedFile { name, here, span });
        }
        let given = self.given(token, wanted)?;
        let Value::String(name) = &given.value else {
            return Err(self.wrong_type(&given.here, given.span, wanted, &given.value));
        };
        Ok(NamedFile { name: name.to_string(), here: given.here, span: given.span })
    }

    /// Reports a file name without quotes, which parses as a component or a quotient: `t.ply`,
    /// `models/tree.ply`.
    pub(super) fn unquoted(&mut self, here: &Here, id: ExpressionId) -> Option<Reported> {
        let expression = here.unit.expression(id);
        if expression.kind == ExpressionKind::String {
            return None;
        }
        let start = expression.span;
        if let Some(reported) = self.lacks_quotes(here, id) {
            return Some(reported);
        }
        let text = self.sources.get(start.file).text.get(start.start as usize..)?;
        let is_of_path = |c: char| c.is_alphanumeric() || "_-./\\".contains(c);
        let path = &text[..text.find(|c| !is_of_path(c)).unwrap_or(text.len())];
        if !(is_of_font(path) || is_of_picture(path) || mesh_file::is_named(path)) {
            return None;
        }
        let (span, right) =
            (Span { end: start.start + path.len() as u32, ..start }, format!("\"{path}\""));
        let told = Diagnostic::new(Code::WrongType, "the name of a file stands in quotes")
            .at(span, "expected a string")
            .help(format!("write `{right}`"))
            .fix(span, right);
        Some(self.report(here, told))
    }

    /// Reads the file of this name; if there is none and the name has no extension, tries these extensions in
    /// order, as POV-Ray does.
    pub(super) fn read_named(
        &mut self,
        file: &NamedFile,
        endings: &[&str],
    ) -> Result<Found, FileError> {
        let found = self.found_named(file, endings)?;
        // It is not scene text, so the sources hold only its name.
        if self.sources.iter().all(|(_, source)| source.name != found.name) {
            self.sources.add(Source::new(found.name.clone(), ""));
        }
        Ok(found)
    }

    fn found_named(
        &self,
        NamedFile { name, span, .. }: &NamedFile,
        endings: &[&str],
    ) -> Result<Found, FileError> {
        let from = &self.sources.get(span.file).name;
        let found = self.files.read(name, from);
        let last = name.rsplit(['/', '\\']).next().unwrap_or(name);
        if !matches!(found, Err(FileError::NotFound { .. })) || last.contains('.') {
            return found;
        }
        let ended = endings.iter().map(|ending| self.files.read(&format!("{name}{ending}"), from));
        let mut ended = ended.filter(|found| !matches!(found, Err(FileError::NotFound { .. })));
        ended.next().unwrap_or(found)
    }
}
