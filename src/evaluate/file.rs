//! File directives (`#fopen`, `#read`, `#write` and `#fclose`), which read values from other files and write
//! them.
//!
//! **Invariant:** all access goes through [`Files`](crate::source::Files). A file that is closed, by
//! `#fclose`, at its end or by a fault in it, keeps its name for messages and is not `defined`.
//!
//! **Source:** POV-Ray 3.7 manual, section 3.3.2.3 "File I/O Directives"; formats as POV-Ray writes them
//! (measured).

mod bytes;
mod data;
mod held;
mod open;
mod read;
mod write;

use std::collections::BTreeSet;

use crate::diagnostic::{Code, Diagnostic, suggest};
use crate::source::{FileId, Site, Span};
use crate::syntax::ast::{Directive, DirectiveKind, NameId};

use super::scope::Symbol;
use super::value::Value;
use super::{Evaluator, Here, Outcome, Reported};

/// Index of a file that was opened.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FileHandle(u32);

/// An opened file and its state.
#[derive(Debug)]
pub(super) struct Opened {
    site: Site,
    state: State,
}

#[derive(Debug, Clone)]
enum State {
    /// Reading from this byte of its text.
    Reading {
        file: FileId,
        at: usize,
    },
    /// Appending to the file of this name.
    Writing {
        name: String,
    },
    Closed {
        by: Closed,
        site: Site,
    },
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Closed {
    Fclose,
    /// All its values have been read.
    End,
    /// It has a fault, which has been reported.
    Fault,
}

impl Evaluator<'_> {
    pub(super) fn is_open(&self, FileHandle(n): FileHandle) -> bool {
        !self.opened[n as usize].is_closed()
    }

    /// Runs `#fclose Name`. As in POV-Ray, the file need not be open.
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
                if suggest::closest(self.scopes.name(symbol), open).is_some() {
                    self.undeclared_among(here, symbol, span, |_| false);
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

    /// Returns the open file that a name denotes.
    fn opened(&mut self, here: &Here, (name, span): (NameId, Span)) -> Outcome<FileHandle> {
        let symbol = here.symbol(name);
        let handle = match self.scopes.read(symbol) {
            // No keyword is a file.
            None => return Err(self.unknown_file(here, symbol, span)),
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

    /// Reports a name that was never opened; suggests a similar one that the scene opens, or the only one.
    fn unknown_file(&mut self, here: &Here, symbol: Symbol, span: Span) -> Reported {
        let ast = &here.unit.ast;
        let opens = |directive: &Directive| match directive.kind {
            DirectiveKind::Fopen { name, .. } => Some(ast.name(name).to_owned()),
            _ => None,
        };
        let files: BTreeSet<String> = ast.directives.iter().filter_map(opens).collect();
        let text = self.sources.text(span).to_owned();
        let only = files.first().filter(|_| files.len() == 1).map(String::as_str);
        let near = suggest::closest(&text, files.iter().map(String::as_str));
        let Some(file) = near.or(only) else {
            if !files.is_empty() || self.scopes.declared(symbol).is_some() {
                return self.undeclared_among(here, symbol, span, |_| false);
            }
            let message = format!("`{text}` is not declared: no `#fopen` has opened it");
            let diagnostic = Diagnostic::new(Code::UndeclaredName, message)
                .at(span, "expected the name of an open file")
                .help(format!(
                    "`#fopen {text} \"file\" read` opens one; `write` and `append` for writing"
                ));
            self.scopes.assign(symbol, Value::Broken);
            return self.report(here, diagnostic);
        };
        let message = format!("`{text}` is not declared: no `#fopen` has opened it");
        let mut diagnostic = Diagnostic::new(Code::UndeclaredName, message)
            .at(span, "expected the name of an open file")
            .help(format!("did you mean `{file}`?"))
            .fix(span, file);
        let declared = self.scopes.symbol(file).and_then(|symbol| self.scopes.declared(symbol));
        if let Some(declared) = declared {
            diagnostic = diagnostic.also(declared.site.span, format!("`{file}` is opened here"));
        }
        // Declared from now on, so that it is reported once.
        self.scopes.assign(symbol, Value::Broken);
        self.report(here, diagnostic)
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

    fn other_way(
        &mut self,
        here: &Here,
        FileHandle(n): FileHandle,
        span: Span,
        is: &str,
        wanted: &str,
    ) -> Reported {
        let text = self.sources.text(span);
        let message = format!(
            "`{text}` is open to {is}, and cannot be {}",
            match wanted {
                "read" => "read",
                _ => "written to",
            }
        );
        let diagnostic = Diagnostic::new(Code::WrongType, message)
            .at(span, format!("expected a file that is open to {wanted}"))
            .also(self.opened[n as usize].site.span, format!("opened here to {is}"));
        self.report(here, diagnostic)
    }
}

impl Opened {
    fn is_closed(&self) -> bool {
        matches!(self.state, State::Closed { .. })
    }
}
