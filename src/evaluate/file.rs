//! `#fopen`, `#read`, `#write` and `#fclose`: values out of other files, and into them.
//!
//! **Invariant:** nothing is read or written but through [`Files`](crate::source::Files). A file that
//! is closed, by `#fclose`, at its end or by a fault in it, keeps its name for messages, and is not
//! `defined`.
//!
//! **Source:** POV-Ray 3.7 manual, section 3.3.2.3 "File I/O Directives"; formats as the program writes
//! them (measured).

mod data;
mod write;

use crate::diagnostic::{Code, Diagnostic, suggest};
use crate::source::{FileId, Site, Source, Span, WriteError, decode};
use crate::syntax::ast::{
    Argument, Arguments, ExpressionId, ExpressionKind, NameId, Target,
};
use crate::vocabulary::Word;

use super::include::missing_file;
use super::scope::{Owner, Symbol};
use super::stream::TokenKind;
use super::value::Value;
use super::{Evaluator, Here, Outcome, Reported};
use data::{Datum, Fault, datum};
use write::{WordType, append};

/// Names one file that was opened.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FileHandle(u32);

/// A file that was opened, and how far it is.
#[derive(Debug)]
pub(super) struct Opened {
    site: Site,
    state: State,
}

#[derive(Debug, Clone)]
enum State {
    /// From this byte of its text.
    Reading { file: FileId, at: usize },
    /// To the end of the file of this name.
    Writing { name: String },
    Closed { by: Closed, site: Site },
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Closed {
    Fclose,
    /// Its last value was read.
    End,
    /// It has a fault, which was told.
    Fault,
}

impl Evaluator<'_> {
    pub(super) fn is_open(&self, FileHandle(n): FileHandle) -> bool {
        !self.opened[n as usize].is_closed()
    }

    /// `#fopen Name "file" read|write|append`.
    pub(super) fn open_file(
        &mut self,
        here: &Here,
        (name, span): (NameId, Span),
        file: ExpressionId,
        mode: Word,
    ) -> Outcome<()> {
        let symbol = here.symbol(name);
        let free = self.may_name_a_file(here, symbol, span);
        let state = free.and_then(|()| {
            let path = self.path(here, file)?;
            let at = here.unit.expression(file).span;
            match mode {
                Word::Read => self.state_to_read(here, &path, at),
                _ => self.state_to_write(here, &path, at, mode == Word::Append),
            }
        });
        let value = match &state {
            Ok(_) => Value::File(FileHandle(self.opened.len() as u32)),
            // What is done with a file that could not be had says nothing more.
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

    /// The name of a file. As in POV-Ray, backslashes of a literal stay as they are.
    fn path(&mut self, here: &Here, file: ExpressionId) -> Outcome<String> {
        match here.unit.expression(file).kind {
            ExpressionKind::String => {
                self.whole_string(here.unit.expression(file).span).ok_or(Reported)
            }
            _ => self.string(here, file),
        }
    }

    fn state_to_read(&mut self, here: &Here, path: &str, span: Span) -> Outcome<State> {
        let from = self.sources.get(span.file).name.clone();
        let found = match self.files.read(path, &from) {
            Ok(found) => found,
            Err(error) => {
                let diagnostic = missing_file(path, span, error);
                return Err(self.report(here, diagnostic));
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
            Err(error) => {
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
        // What was read under this name is not what it holds from now on.
        self.parsed.remove(&name);
        Ok(State::Writing { name })
    }

    /// `#fclose Name`. What is not open need not be closed, as in POV-Ray.
    pub(super) fn close_file(&mut self, here: &Here, (name, span): (NameId, Span)) {
        let symbol = here.symbol(name);
        match self.scopes.read(symbol) {
            Some(Value::File(handle)) => {
                let handle = *handle;
                self.end_file(handle, Closed::Fclose, here.site(span));
            }
            Some(Value::Broken | Value::Poison(_)) => {}
            Some(other) => {
                let other = other.clone();
                self.no_file(here, symbol, span, &other);
            }
            None => {
                let open = self.opened.iter().filter(|opened| !opened.is_closed());
                let open: Vec<&str> =
                    open.map(|opened| self.sources.text(opened.site.span)).collect();
                if suggest::closest(self.scopes.name(symbol), open.into_iter()).is_some() {
                    self.undeclared(here, symbol, span);
                }
            }
        }
    }

    fn end_file(&mut self, FileHandle(n): FileHandle, by: Closed, site: Site) {
        let opened = &mut self.opened[n as usize];
        if !opened.is_closed() {
            opened.state = State::Closed { by, site };
        }
    }

    /// The open file that a name stands for.
    fn opened(&mut self, here: &Here, (name, span): (NameId, Span)) -> Outcome<FileHandle> {
        let symbol = here.symbol(name);
        let handle = match self.scopes.read(symbol) {
            None => return Err(self.undeclared(here, symbol, span)),
            Some(Value::Broken | Value::Poison(_)) => return Err(Reported),
            Some(Value::File(handle)) => *handle,
            Some(other) => {
                let other = other.clone();
                return Err(self.no_file(here, symbol, span, &other));
            }
        };
        let State::Closed { by, site } = self.opened[handle.0 as usize].state else {
            return Ok(handle);
        };
        let text = self.sources.text(span).to_owned();
        let diagnostic = match by {
            Closed::Fault => return Err(Reported),
            Closed::Fclose => Diagnostic::new(Code::WrongType, format!("`{text}` is closed"))
                .at(span, "expected an open file")
                .also(site.span, "closed here"),
            Closed::End => {
                let message = format!("`{text}` has been read to its end, and is closed");
                Diagnostic::new(Code::WrongType, message)
                    .at(span, "there is no more to read")
                    .also(site.span, "the last value was read here")
                    .help(format!("`#while (defined({text}))` reads while there is more"))
            }
        };
        Err(self.report(here, diagnostic))
    }

    fn no_file(&mut self, here: &Here, symbol: Symbol, span: Span, value: &Value) -> Reported {
        let text = self.scopes.name(symbol);
        let message = format!("`{text}` is {}, not an open file", value.kind());
        let mut diagnostic = Diagnostic::new(Code::WrongType, message)
            .at(span, "expected a name that `#fopen` has opened");
        if let Some(declared) = self.scopes.declared(symbol) {
            diagnostic = diagnostic.also(declared.site.span, "declared here");
        }
        self.report(here, diagnostic)
    }

    /// `#read (Name, a, b[1], …)`. Past the end of the file nothing is set.
    pub(super) fn read_values(
        &mut self,
        here: &Here,
        name: (NameId, Span),
        targets: &[Target],
    ) -> Outcome<()> {
        let outcome = self.read_each(here, name, targets);
        if outcome.is_err() {
            for target in targets.iter().filter(|target| target.indices.is_empty()) {
                let symbol = here.symbol(target.name);
                if self.scopes.read(symbol).is_none() {
                    self.scopes.assign(symbol, Value::Broken);
                }
            }
        }
        outcome
    }

    fn read_each(
        &mut self,
        here: &Here,
        name: (NameId, Span),
        targets: &[Target],
    ) -> Outcome<()> {
        let handle = self.opened(here, name)?;
        for target in targets {
            let (file, at) = match &self.opened[handle.0 as usize].state {
                State::Reading { file, at } => (*file, *at),
                State::Closed { .. } => return Ok(()),
                State::Writing { .. } => {
                    return Err(self.other_way(here, handle, name.1, "write", "read"));
                }
            };
            let read = datum(&self.sources.get(file).text, at);
            let Datum { value, next, ends } = match read {
                Ok(Some(datum)) => datum,
                Ok(None) => {
                    self.end_file(handle, Closed::End, here.site(name.1));
                    return Ok(());
                }
                Err(Fault { code, at, message, label }) => {
                    self.end_file(handle, Closed::Fault, here.site(name.1));
                    let diagnostic = Diagnostic::new(code, message)
                        .at(Span::new(file, at.start, at.end), label)
                        .also(target.span, "to be read into this");
                    return Err(self.report(here, diagnostic));
                }
            };
            self.opened[handle.0 as usize].state = State::Reading { file, at: next };
            if ends {
                self.end_file(handle, Closed::End, here.site(target.span));
            }
            self.set_target(here, target, value)?;
        }
        Ok(())
    }

    fn set_target(&mut self, here: &Here, target: &Target, value: Value) -> Outcome<()> {
        if !target.indices.is_empty() {
            let indices = self.target_indices(here, target);
            return self.assign_element(here, target, indices, Ok(value));
        }
        let symbol = here.symbol(target.name);
        match self.scopes.read(symbol) {
            None
            | Some(
                Value::Number(_)
                | Value::Vector(_)
                | Value::Color(_)
                | Value::String(_)
                | Value::Poison(_)
                | Value::Broken,
            ) => {}
            Some(other) => {
                let message =
                    format!("`{}` is {}, and cannot be read into", self.sources.text(target.span), other.kind());
                let label = "expected a new name, or that of a number, vector or string";
                let mut diagnostic =
                    Diagnostic::new(Code::WrongType, message).at(target.span, label);
                if let Some(declared) = self.scopes.declared(symbol) {
                    diagnostic = diagnostic.also(declared.site.span, "declared here");
                }
                return Err(self.report(here, diagnostic));
            }
        }
        // What a file holds beside what a scene needs has to be read, too.
        self.scopes.note_declaration(symbol, here.site(target.span), Owner::Other);
        self.scopes.assign(symbol, value);
        Ok(())
    }

    fn other_way(
        &mut self,
        here: &Here,
        FileHandle(n): FileHandle,
        span: Span,
        is: &str,
        wanted: &str,
    ) -> Reported {
        let text = self.sources.text(span);
        let message = format!("`{text}` is open to {is}, and cannot be {}", match wanted {
            "read" => "read",
            _ => "written to",
        });
        let diagnostic = Diagnostic::new(Code::WrongType, message)
            .at(span, format!("expected a file that is open to {wanted}"))
            .also(self.opened[n as usize].site.span, format!("opened here to {is}"));
        self.report(here, diagnostic)
    }

    /// `#write (Name, value, …)`: all of its values, or nothing of them.
    pub(super) fn write_values(
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
                Argument::Expression(id) => self
                    .expression(here, id)
                    .and_then(|value| self.write(here, unit.expression(id).span, &value, None, &mut bytes)),
                Argument::Items(items) => {
                    self.inside(here, items, |evaluator| evaluator.write_items(&mut bytes))
                }
            };
            outcome = outcome.and(done);
        }
        outcome?;
        self.stored += bytes.len() as u64;
        self.files.add(&file, &bytes);
        Ok(())
    }

    /// Values side by side, after the word for their form if there is one.
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
            format!("write its parts: `<{text}.red, {text}.green, {text}.blue>`")
        });
        Err(self.wrong_type_with(here, span, wanted, value, help))
    }
}

impl Opened {
    fn is_closed(&self) -> bool {
        matches!(self.state, State::Closed { .. })
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
