//! `#fopen`: checks the name, and opens its file.

use std::rc::Rc;

use crate::diagnostic::{Code, Diagnostic};
use crate::source::{FileId, Source, Span, WriteError, decode};
use crate::syntax::ast::{ExpressionId, ExpressionKind, NameId};
use crate::vocabulary::{Dialect, Word};

use super::super::include::missing_file;
use super::super::scope::Symbol;
use super::super::value::Value;
use super::super::{Evaluator, Here, Outcome, Reported};
use super::{FileHandle, Opened, State};

impl Evaluator<'_> {
    /// Runs `#fopen Name "file" read|write|append`.
    pub(in crate::evaluate) fn open_file(
        &mut self,
        here: &Here,
        (name, span): (NameId, Span),
        file: ExpressionId,
        mode: Option<Word>,
    ) -> Outcome<()> {
        let symbol = here.symbol(name);
        let free = self.may_name_a_file(here, symbol, span);
        let state = free.and_then(|()| {
            let path = self.path(here, file)?;
            let at = here.unit.expression(file).span;
            match mode {
                None => {
                    self.unwritten.insert(path);
                    Err(Reported)
                }
                Some(Word::Read) => self.state_to_read(here, &path, at),
                _ => self.state_to_write(here, &path, at, mode == Some(Word::Append)),
            }
        });
        let value = match &state {
            Ok(_) => Value::File(FileHandle(self.opened.len() as u32)),
            // Uses of a file that could not be opened report nothing more.
            Err(Reported) => Value::Broken,
        };
        if free.is_ok() {
            self.scopes.assign(symbol, value);
        }
        self.opened.push(Opened { site: here.site(span), state: state? });
        Ok(())
    }

    fn may_name_a_file(&mut self, here: &Here, symbol: Symbol, span: Span) -> Outcome<()> {
        let (value, declared) = match self.scopes.read(symbol) {
            None | Some(Value::Broken | Value::Poison(_)) => return Ok(()),
            Some(Value::File(FileHandle(n))) => {
                let opened = &self.opened[*n as usize];
                if opened.is_closed() {
                    return Ok(());
                }
                ("an open file", Some(opened.site.span))
            }
            Some(other) => {
                let kind = other.kind();
                (kind, self.scopes.declared(symbol).map(|declared| declared.site.span))
            }
        };
        let text = self.sources.text(span).to_owned();
        let mut diagnostic =
            Diagnostic::new(Code::WrongType, format!("`{text}` is {value} already"))
                .at(span, "expected a name that is not declared");
        if let Some(declared) = declared {
            diagnostic = diagnostic.also(declared, "since here");
        }
        if value == "an open file" {
            diagnostic = diagnostic.help(format!("close it first: `#fclose {text}`"));
        }
        Err(self.report(here, diagnostic))
    }

    /// Evaluates the name of a file. As in POV-Ray, backslashes of a literal are kept.
    pub(in crate::evaluate) fn path(&mut self, here: &Here, file: ExpressionId) -> Outcome<String> {
        match here.unit.expression(file).kind {
            ExpressionKind::String => {
                self.whole_string(here.unit.expression(file).span).ok_or(Reported)
            }
            _ => self.string(here, file),
        }
    }

    fn state_to_read(&mut self, here: &Here, path: &str, span: Span) -> Outcome<State> {
        if let Some((missing, told)) = self.remembered.missing.get(&span)
            && missing == path
        {
            let told = told.clone();
            return Err(self.report_again(here, &told));
        }
        let from = self.sources.get(span.file).name.clone();
        let found = match self.read_file(path, &from) {
            Ok(found) => found,
            Err(_) if self.unwritten.contains(path) => return Err(Reported),
            Err(error) => {
                let told = Rc::new(missing_file(path, span, error, |_| true));
                self.remembered.missing.insert(span, (path.to_owned(), told.clone()));
                return Err(self.report_again(here, &told));
            }
        };
        let (text, _) = decode(found.bytes);
        let known = self.sources.iter().find(|(_, s)| s.name == found.name && s.text == text);
        let file = match known.map(|(file, _)| file) {
            Some(file) => file,
            None => {
                self.stored += text.len() as u64;
                self.sources.add(Source::new(found.name, text))
            }
        };
        Ok(State::Reading { file, at: 0 })
    }

    fn state_to_write(
        &mut self,
        here: &Here,
        path: &str,
        span: Span,
        append: bool,
    ) -> Outcome<State> {
        let name = match self.files.start(path, append) {
            Ok(name) => name,
            Err(WriteError::NotAllowed) if self.options.dialect == Dialect::Pov => {
                // One message for all of them.
                if self.held_files.is_empty() {
                    let message =
                        format!("`{path}` is not written; the scene reads it from memory");
                    let diagnostic = Diagnostic::new(Code::ForbiddenFile, message)
                        .at(span, "writing is allowed by `--allow-write` only");
                    self.report(here, diagnostic.as_warning());
                }
                let from = self.sources.get(span.file).name.clone();
                self.hold_file(path, &from, append);
                path.to_owned()
            }
            Err(error) => {
                // The option that allows one allows all.
                let told = error == WriteError::NotAllowed && !self.unwritten.is_empty();
                self.unwritten.insert(path.to_owned());
                if told {
                    return Err(Reported);
                }
                let diagnostic = unwritable(path, span, error);
                return Err(self.report(here, diagnostic));
            }
        };
        if name == self.sources.get(FileId(0)).name {
            let diagnostic =
                Diagnostic::new(Code::ForbiddenFile, format!("`{path}` is this scene itself"))
                    .at(span, "it would be lost");
            return Err(self.report(here, diagnostic));
        }
        if self.parsed.contains_key(&name) && !self.authored.contains(&name) {
            let message = format!("`{path}` is a part of this scene");
            let diagnostic = Diagnostic::new(Code::ForbiddenFile, message)
                .at(span, "it was included, and would be lost");
            return Err(self.report(here, diagnostic));
        }
        self.authored.insert(name.clone());
        // The cached contents under this name are outdated from now on.
        self.parsed.remove(&name);
        self.found.retain(|(other, _), _| other != path);
        self.remembered.missing.clear();
        Ok(State::Writing { name })
    }
}

fn unwritable(path: &str, span: Span, error: WriteError) -> Diagnostic {
    match error {
        WriteError::NotAllowed => {
            let message = format!("this scene may not write `{path}`");
            Diagnostic::new(Code::ForbiddenFile, message)
                .at(span, "writing is allowed by `--allow-write` only")
                .help("`--allow-write` allows it, below the current folder")
        }
        WriteError::Outside => {
            let message = format!("`{path}` lies outside of the current folder");
            Diagnostic::new(Code::ForbiddenFile, message)
                .at(span, "`--allow-write` allows writing below the current folder only")
        }
        WriteError::Impossible(reason) => {
            Diagnostic::new(Code::UnreadableFile, format!("`{path}` cannot be written: {reason}"))
                .at(span, "this file")
        }
    }
}
