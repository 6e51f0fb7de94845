//! `#include`: runs another file's items at the directive's position.
//!
//! **Invariant:** a file is parsed once, however often it is included, and located once for each file that
//! includes it. Files do not change while a scene is read, except those that it writes.

use std::rc::Rc;

use crate::diagnostic::suggest::closest;
use crate::diagnostic::{Code, Diagnostic, Diagnostics};
use crate::mesh_file;
use crate::source::{ExpansionKind, FileError, Found, Source, Span, decode, file_name};
use crate::standard;
use crate::syntax::ast::{Ast, ExpressionId, ExpressionKind};
use crate::syntax::{self, ParseOptions};
use crate::vocabulary::{is_standard_include, standard_includes};

use super::{Evaluator, Here, Outcome, Reported, Unit};

impl Evaluator<'_> {
    /// Returns the unit for a parsed text, with its names interned.
    pub(super) fn unit(&mut self, ast: Ast) -> Rc<Unit> {
        let symbols = ast.names.iter().map(|name| self.scopes.intern(name)).collect();
        Rc::new(Unit { ast, symbols })
    }

    pub(super) fn include(&mut self, here: &Here, file: ExpressionId, head: Span) -> Outcome<()> {
        let span = here.unit.expression(file).span;
        let name = match here.unit.expression(file).kind {
            // Paths keep their backslashes.
            ExpressionKind::String => match self.whole_string(span) {
                Some(name) => name,
                None => {
                    self.lacks_include = true;
                    let name = self.sources.text(span).lines().next().unwrap_or("");
                    self.unread.insert(name.trim_matches(['"', ' ']).to_owned());
                    return Err(Reported);
                }
            },
            _ => match self.bare_path(span) {
                Some(path) => {
                    self.lacks_include = true;
                    self.unread.insert(path.clone());
                    let quoted = format!("\"{path}\"");
                    let diagnostic =
                        Diagnostic::new(Code::WrongType, "the name of a file stands in quotes")
                            .at(span, "expected a string")
                            .help(format!("write `#include {quoted}`"))
                            .fix(span, quoted);
                    return Err(self.report(here, diagnostic));
                }
                None => {
                    let name = self.string(here, file);
                    if name.is_err() {
                        self.lacks_include = true;
                        self.unread.insert(self.name_behind(head));
                    }
                    name?
                }
            },
        };
        if self.including.len() as u32 > self.options.limits.include_depth {
            return Err(self.include_limit(here, &name, span));
        }
        let from = self.sources.get(head.file).name.clone();
        let known = self.found.get(&(name.clone(), head.file));
        let (path, unit) = match known.and_then(|path| self.parsed.get_key_value(path)) {
            Some((path, unit)) => (path.clone(), unit.clone()),
            None => {
                if let Some((missing, told)) = self.remembered.missing.get(&span)
                    && *missing == name
                {
                    let told = told.clone();
                    return Err(self.report_again(here, &told));
                }
                let found = match self.found(&name, &from) {
                    Ok(found) => found,
                    Err(_) if self.unwritten.contains(&name) => {
                        self.lacks_include = true;
                        return Err(Reported);
                    }
                    Err(error) => {
                        let diagnostic = self.missing_include(&name, &from, span, error);
                        let meant = match &diagnostic.fixes[..] {
                            [fix] => fix.text.trim_matches('"').to_owned(),
                            _ => String::new(),
                        };
                        let told = Rc::new(diagnostic);
                        self.remembered.missing.insert(span, (name.clone(), told.clone()));
                        let reported = self.report_again(here, &told);
                        // With the intended file, nothing after it is missing.
                        let found = (!meant.is_empty()).then(|| self.found(&meant, &from));
                        match found {
                            Some(Ok(found)) => found,
                            _ => {
                                self.lacks_include = true;
                                self.unread.insert(name);
                                return Err(reported);
                            }
                        }
                    }
                };
                if !self.remembered.missing.contains_key(&span) {
                    self.found.insert((name.clone(), head.file), found.name.clone());
                }
                let unit = match self.parsed.get(&found.name) {
                    Some(unit) => unit.clone(),
                    None => self.read_unit(here, [head, span], &found.name, found.bytes),
                };
                (found.name, unit)
            }
        };
        let call = head.to(span);
        let name = self.scene.expansions.named(&name);
        let expansion =
            self.scene.expansions.add(here.expansion, call, ExpansionKind::Include, name);
        self.push_include(&unit, expansion, path);
        Ok(())
    }

    /// Locates a file, also if its name lacks the `.inc`.
    fn found(&self, name: &str, from: &str) -> Result<Found, FileError> {
        let as_named = self.read_file(name, from).or_else(embedded(name));
        match as_named {
            Err(FileError::NotFound { .. }) if !file_name(name).contains('.') => {
                let whole = format!("{name}.inc");
                self.read_file(&whole, from).or_else(embedded(&whole)).or(as_named)
            }
            found => found,
        }
    }

    /// Returns the diagnostic for an include that cannot be read, with a suggestion if its `\` should be `/`.
    fn missing_include(&self, name: &str, from: &str, span: Span, error: FileError) -> Diagnostic {
        let slashed = name.replace('\\', "/");
        let is_there = slashed != name && self.read_file(&slashed, from).is_ok();
        let diagnostic = missing_file(name, span, error, |_| !is_there);
        if is_there {
            let quoted = format!("\"{slashed}\"");
            let help = format!("folders are parted by `/`: write `{quoted}`");
            diagnostic.help(help).fix(span, quoted)
        } else if slashed != name && !is_absolute(name) {
            diagnostic.help(format!("folders are parted by `/`: `{slashed}`"))
        } else {
            diagnostic
        }
    }

    /// Returns the text on the line after `#include`, without surrounding quotes or signs: `“colors.inc”`.
    fn name_behind(&self, head: Span) -> String {
        let rest = self.sources.get(head.file).text.get(head.end as usize..).unwrap_or("");
        let line = rest.lines().next().unwrap_or("");
        line.trim_matches(|c: char| !c.is_alphanumeric()).to_owned()
    }

    /// Returns a path written without quotes: `colors.inc` or `<colors.inc>`.
    fn bare_path(&self, span: Span) -> Option<String> {
        let text = self.sources.text(span).trim_start_matches('<').trim_end_matches('>').trim();
        let (name, extension) = text.rsplit_once('.')?;
        let is_path =
            |text: &str| text.chars().all(|c| c.is_alphanumeric() || "_-./\\".contains(c));
        let known = ["inc", "pov", "scene", "map", "mcr"].contains(&extension);
        (known && is_path(name)).then(|| text.to_owned())
    }

    fn read_unit(
        &mut self,
        here: &Here,
        [head, span]: [Span; 2],
        name: &str,
        bytes: Vec<u8>,
    ) -> Rc<Unit> {
        let source = Source::decoded(name, decode(bytes));
        let foreign = source.is_latin;
        let id = self.sources.add(source);
        let options = ParseOptions {
            dialect: self.options.dialect,
            nesting_limit: self.options.limits.nesting as usize,
            loose: self.options.loose,
            ..ParseOptions::default()
        };
        let mut told = Diagnostics::new(true);
        let ast = syntax::parse(self.sources.get(id), id, &options, &mut told);
        let is_scene = self.options.dialect == crate::scene::Dialect::Scene;
        let text = &self.sources.get(id).text;
        let is_other = told.iter().any(|told| told.code == Code::ForeignFile);
        if foreign && is_scene && !is_other && !ast.is_ascii_but_for_comments(text) {
            let diagnostic = Diagnostic::new(
                Code::BadEncoding,
                format!("`{name}` is not UTF-8, and was read as Latin-1"),
            )
            .at(span, "included here");
            self.report(here, diagnostic);
        }
        // The chain of includes from the main file on.
        if !told.is_empty() {
            let (expansions, kind) = (&mut self.scene.expansions, ExpansionKind::Include);
            let named = expansions.named(name);
            let included = expansions.add(here.expansion, head.to(span), kind, named);
            let whole = head.to(span);
            let mesh = format!("mesh {{ file {} }}", self.sources.text(span));
            // Where objects are expected, it can be placed.
            let is_mesh = is_scene && self.blocks.is_empty() && mesh_file::is_named(name);
            for told in told.iter().cloned() {
                self.lacks_include |= told.code == Code::ForeignFile;
                let meant = is_mesh && told.code == Code::ForeignFile;
                self.report_in(included, if meant { told.fix(whole, mesh.clone()) } else { told });
            }
        }
        let unit = self.unit(ast);
        self.parsed.insert(name.to_owned(), unit.clone());
        unit
    }

    fn include_limit(&mut self, here: &Here, name: &str, span: Span) -> Reported {
        let innermost = self.including.last().cloned().unwrap_or_default();
        // The files between this one and the last time it was included.
        let since = |file: &&String| file.as_str() != name && **file != innermost;
        let between: Vec<&String> = self.including.iter().rev().skip(1).take_while(since).collect();
        let again = self.including.iter().filter(|file| **file == innermost).count() > 1;
        let diagnostic = if again {
            let message = match (innermost == name, between.as_slice()) {
                (true, _) => format!("`{name}` includes itself, and never ends"),
                (false, []) => {
                    format!("`{name}` and `{innermost}` include each other, and never end")
                }
                (false, [..]) => {
                    format!("`{name}` includes itself by way of `{innermost}`, and never ends")
                }
            };
            Diagnostic::new(Code::CircularInclude, message).at(span, "included again here").help(
                "guard the file: `#ifndef (Name_Included) #declare Name_Included = 1; … #end`",
            )
        } else {
            let limit = self.options.limits.include_depth;
            Diagnostic::new(
                Code::IncludeLimit,
                format!("files include each other more than {limit} deep"),
            )
            .at(span, "this include is one too many")
            .help("raise the limit with `--limit include-depth=N`")
        };
        self.halt(here.expansion, diagnostic)
    }
}

/// Returns the embedded standard include of this name, as a fallback for when no file has it.
pub(super) fn embedded(name: &str) -> impl FnOnce(FileError) -> Result<Found, FileError> {
    move |error| match (&error, standard::include(name)) {
        (FileError::NotFound { .. }, Some((name, text))) => Ok(Found { name, bytes: text.into() }),
        _ => Err(error),
    }
}

/// Returns whether a path begins at the root or with a Windows drive; such a path is not searched for in
/// folders.
fn is_absolute(name: &str) -> bool {
    name.starts_with(['/', '\\']) || name.get(1..2) == Some(":")
}

/// Returns whether a file named `like` certainly is a misspelling of `name`: `tree1` is not `tree2`, and
/// short names resemble too many others.
fn is_the_same_but_misspelt(name: &str, like: &str) -> bool {
    let (name, like) = (file_name(name), file_name(like));
    let digits = |name: &str| name.chars().filter(char::is_ascii_digit).collect::<String>();
    let stem = name.rsplit_once('.').map_or(name, |(stem, _)| stem);
    let letters = stem.chars().filter(|c| c.is_alphabetic()).count();
    let ending = like.strip_prefix(name).unwrap_or("");
    let is_ended =
        name == like || ending == ".inc" || ending.starts_with('.') && mesh_file::is_named(ending);
    is_ended || (digits(name) == digits(like) && letters >= 4)
}

/// Returns the diagnostic for a file that cannot be read; `fits` decides by name which files to suggest.
pub(super) fn missing_file(
    name: &str,
    span: Span,
    error: FileError,
    fits: impl Fn(&str) -> bool,
) -> Diagnostic {
    match error {
        FileError::NotFound { searched, similar } => {
            let mut diagnostic =
                Diagnostic::new(Code::MissingInclude, format!("`{name}` is not found"))
                    .at(span, "no file of this name");
            // An embedded file is in no folder.
            let last = file_name(name);
            let stem = last.strip_suffix(".inc").unwrap_or(last);
            let same = || standard_includes().find(|include| *include == stem);
            let standard = || same().or_else(|| closest(stem, standard_includes()));
            let standard = || standard().map(|near| format!("{near}.inc"));
            if let Some(similar) = similar.into_iter().chain(standard()).find(|name| fits(name)) {
                diagnostic = diagnostic.help(format!("did you mean `{similar}`?"));
                if is_the_same_but_misspelt(name, &similar) {
                    diagnostic = diagnostic.fix(span, format!("\"{similar}\""));
                }
            }
            if !searched.is_empty() {
                diagnostic = diagnostic.help(format!("searched in {}", searched.join(", ")));
            }
            match is_standard_include(name) {
                true => diagnostic.help(
                    "it comes with POV-Ray: install its includes (Debian: povray-includes), or give \
                     their folder with `-I FOLDER`",
                ),
                false if is_absolute(name) => diagnostic,
                false => diagnostic.help("`-I FOLDER` adds a folder to search"),
            }
        }
        FileError::Forbidden => Diagnostic::new(
            Code::ForbiddenFile,
            format!("`{name}` lies outside the folders that `--sandbox` lets a scene read"),
        )
        .at(span, "outside the scene's folder and the `-I` folders")
        .help("without `--sandbox` any file is read; `-I FOLDER` adds a folder to those that it lets a scene read"),
        FileError::Unreadable(reason) => {
            Diagnostic::new(Code::UnreadableFile, format!("`{name}` cannot be read: {reason}"))
                .at(span, "this file")
        }
    }
}
