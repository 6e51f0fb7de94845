//! Names that are declared but never used.

use std::cell::OnceCell;
use std::collections::{BTreeSet, HashMap, HashSet};

use super::MOST_LOOKS;
use crate::diagnostic::suggest::closest;
use crate::diagnostic::{Code, Diagnostic};
use crate::evaluate::scope::Owner;
use crate::evaluate::value::Value;
use crate::evaluate::{Evaluator, Unit};
use crate::scene::{ObjectId, ObjectKind, Unused};
use crate::source::{FileId, Span};
use crate::vocabulary::{Word, is_standard_source};

impl Evaluator<'_> {
    /// Reports the names declared in the main file and never used: records them in the scene, with a lint for
    /// each.
    pub(in crate::evaluate) fn lint_declarations(&mut self, main: &Unit) {
        self.tell_unused(main, |_| true);
        self.lint_redeclared(main);
    }

    /// As [`Self::lint_declarations`], for a scene with mistakes: names that occur only in their declaration,
    /// and in no message.
    pub(in crate::evaluate) fn lint_lone_names(&mut self, main: &Unit) {
        let own = self.sources.iter().filter(|(_, source)| !is_standard_source(&source.name));
        let mut own: Vec<String> = own.skip(1).map(|(_, source)| source.text.clone()).collect();
        for one in self.diagnostics.iter() {
            own.push(one.message.clone());
            own.extend(one.help.iter().chain(one.labels.iter().map(|label| &label.text)).cloned());
        }
        let known: HashSet<&str> = own.iter().flat_map(|text| words(text)).collect();
        // An undeclared name may be a misspelling of it.
        let lacking = self.diagnostics.iter().filter(|one| one.code == Code::UndeclaredName);
        let lacking = lacking.filter_map(|one| Some(self.sources.text(one.primary()?.span)));
        let lacking: Vec<String> = lacking.map(str::to_owned).collect();
        let is_near = |name: &str| {
            lacking.len() > MOST_LOOKS
                || closest(name, lacking.iter().map(String::as_str)).is_some()
        };
        self.tell_unused(main, |name| !known.contains(name) && !is_near(name));
    }

    fn tell_unused(&mut self, main: &Unit, is_meant: impl Fn(&str) -> bool) {
        let has_errors = self.diagnostics.has_errors();
        let is_error = |told: &&Diagnostic| told.is_error();
        let faults = self.diagnostics.iter().filter(is_error);
        let faulty = faults.flat_map(|told| told.labels.iter().map(|label| label.span));
        let faulty: BTreeSet<(FileId, usize)> = faulty.map(|span| self.line_of(span)).collect();
        // All of the text is searched for these: only if there are any candidates.
        let known = OnceCell::new();
        let is_only_declared =
            |name: &str| known.get_or_init(|| self.only_declared(main)).contains(name);
        let mut unused: Vec<(Unused, Diagnostic)> = Vec::new();
        for (name, declared, value) in self.scopes.declarations() {
            if declared.used {
                continue;
            }
            let theirs = match declared.of {
                Owner::Main => true,
                // A branch that was not run may use it, or a macro that this one calls.
                Owner::Macro => is_only_declared(name),
                Owner::Other => false,
            };
            if !theirs || name.starts_with('_') || !is_meant(name) {
                continue;
            }
            let is_light = matches!(value, Some(&Value::Object(object)) if self.is_light(object));
            if has_errors && !is_only_declared(name) {
                continue;
            }
            // Another mistake on its line has priority.
            let is_object = matches!(value, Some(Value::Object(_)));
            if !is_object && faulty.contains(&self.line_of(declared.site.span)) {
                continue;
            }
            // A keyword cannot be declared, which has been reported.
            if Word::from_name(name).is_some() {
                continue;
            }
            let site = declared.site;
            let diagnostic = match value {
                None if declared.of == Owner::Macro => Diagnostic::new(
                    Code::UnusedDeclaration,
                    format!("`{name}` is declared in a macro, and never used"),
                )
                .at(site.span, "declared here"),
                Some(Value::Broken) | None => continue,
                Some(Value::Object(_)) => {
                    let (word, label) = match is_light {
                        true => (Word::LightSource, "this light does not shine"),
                        false => (Word::Object, "this object is not seen"),
                    };
                    let message = format!("`{name}` is declared and never placed in the scene");
                    Diagnostic::new(Code::NeverPlaced, message)
                        .at(site.span, label)
                        .help(format!("place it with `{} {{ {name} }}`", word.name()))
                }
                Some(Value::Camera(_)) => Diagnostic::new(
                    Code::UnusedDeclaration,
                    format!("`{name}` is a camera that is declared and never used"),
                )
                .at(site.span, "the scene is not seen by it")
                .help(format!("use it with `camera {{ {name} }}`")),
                Some(_) => Diagnostic::new(
                    Code::UnusedDeclaration,
                    format!("`{name}` is declared and never used"),
                )
                .at(site.span, "declared here"),
            };
            let text = &self.sources.get(site.span.file).text;
            let before = text[..site.span.start as usize].trim_end();
            let directive = ["macro", "local"].into_iter().find(|word| before.ends_with(word));
            let directive = directive.unwrap_or("declare");
            let name = name.to_owned();
            let is_camera = matches!(value, Some(Value::Camera(_)));
            unused.push((Unused { directive, name, site, is_light, is_camera }, diagnostic));
        }
        unused.sort_by_key(|(one, _)| one.site.span);
        for (one, diagnostic) in unused {
            self.scene.unused.push(one);
            self.diagnostics.push(diagnostic);
        }
    }

    fn line_of(&self, span: Span) -> (FileId, usize) {
        (span.file, self.sources.get(span.file).position(span.start as usize).line)
    }

    fn is_light(&self, mut object: ObjectId) -> bool {
        loop {
            match self.scene.objects[object.index()].kind {
                ObjectKind::Use(used) => object = used,
                ObjectKind::LightSource(_) => return true,
                ObjectKind::Solid(_) | ObjectKind::Union(_) | ObjectKind::Csg { .. } => {
                    return false;
                }
            }
        }
    }

    /// Returns the names that occur in the main file only where they are declared. An occurrence in a comment
    /// counts as a use, to avoid false warnings.
    fn only_declared(&self, main: &Unit) -> HashSet<String> {
        let mut uses: HashMap<&str, isize> = HashMap::new();
        for (name, _) in main.declarations() {
            *uses.entry(main.ast.name(name)).or_default() -= 1;
        }
        if uses.is_empty() {
            return HashSet::new();
        }
        let text = &self.sources.get(main.ast.file).text;
        // Most words of a large text are numbers, which no name begins with.
        for word in words(text).filter(|word| !word.starts_with(|c: char| c.is_ascii_digit())) {
            uses.entry(word).and_modify(|uses| *uses += 1);
        }
        uses.into_iter().filter(|(_, uses)| *uses == 0).map(|(name, _)| name.to_owned()).collect()
    }
}

/// Returns the words of a text that may be names.
fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_'))
}
