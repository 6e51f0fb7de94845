//! Files that a block names: fonts and pictures.

use super::super::stream::{Token, TokenKind};
use super::super::value::Value;
use super::super::{Evaluator, Here, Outcome};
use crate::source::{FileError, Found, Source, Span};

/// The name of a file, and where it is written.
pub(super) struct NamedFile {
    pub name: String,
    pub here: Here,
    pub span: Span,
}

impl Evaluator<'_> {
    /// The name that comes next; `wanted` says of what.
    pub(super) fn named_file(&mut self, token: &Token, wanted: &str) -> Outcome<NamedFile> {
        self.skip_commas();
        if let Some(Token { kind: TokenKind::Expression(id), here, span }) = self.peek().cloned() {
            self.next();
            let name = self.path(&here, id)?;
            return Ok(NamedFile { name, here, span });
        }
        let given = self.given(token, wanted)?;
        let Value::String(name) = &given.value else {
            return Err(self.wrong_type(&given.here, given.span, wanted, &given.value));
        };
        Ok(NamedFile { name: name.to_string(), here: given.here, span: given.span })
    }

    /// The file of this name; if there is none and the name has no ending, of the name with one of these, as
    /// POV-Ray looks for it.
    pub(super) fn read_named(
        &mut self,
        file: &NamedFile,
        endings: &[&str],
    ) -> Result<Found, FileError> {
        let found = self.found_named(file, endings)?;
        // It is no text, and has its name among what was read alone.
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
