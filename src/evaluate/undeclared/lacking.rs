//! Undeclared names that a standard include, which was not read, declares.

use crate::diagnostic::{Code, Diagnostic, Fix, suggest};
use crate::source::{ExpansionKind, Span};
use crate::syntax::ast::{DirectiveKind, ExpressionKind, ItemKind};
use crate::vocabulary::{standard_include_of, standard_names};

use super::super::lint::version_end;
use super::super::{Evaluator, Here, Symbol};
use super::MAIN;

/// The include whose names are used and misspelt most.
const COLORS: &str = "colors.inc";

/// Maximum number of includes that are searched for a name.
const MOST_READ: usize = 16;

impl Evaluator<'_> {
    /// Returns the standard include that declares `name`, if it was not read.
    pub(in crate::evaluate) fn lacking_include(&self, name: &str) -> Option<String> {
        standard_include_of(name).filter(|include| {
            // A single-letter name is more likely the author's own.
            name.len() > 1 && !self.has_read(include)
        })
    }

    pub(super) fn has_read(&self, include: &str) -> bool {
        self.parsed.keys().any(|file| file.ends_with(include))
    }

    /// Returns the name in an unread standard include that a capitalized name most likely means.
    pub(in crate::evaluate) fn lacking_near(&self, name: &str) -> Option<(&'static str, String)> {
        if !name.starts_with(char::is_uppercase) {
            return self.lacking_in_small_letters(name);
        }
        if name.len() < 3 {
            return None;
        }
        // Too many names of the includes are close to a short one: only colours are searched.
        let near = suggest::closest(name, standard_names(COLORS))?;
        let begins = near.get(..name.len()).is_some_and(|begin| begin.eq_ignore_ascii_case(name));
        if name.len() < 4 && !begins {
            return None;
        }
        (!suggest::are_of_a_series(name, near) && !self.has_read(COLORS))
            .then(|| (near, COLORS.to_owned()))
    }

    /// Returns the colour there that differs only in case: `White` for `white`, `SkyBlue` for `skyblue`.
    pub(super) fn lacking_in_small_letters(&self, name: &str) -> Option<(&'static str, String)> {
        let near = standard_color(name)?;
        (!self.has_read(COLORS)).then(|| (near, COLORS.to_owned()))
    }

    /// Returns the include further down in the same file that declares `name`.
    pub(in crate::evaluate) fn included_below(
        &self,
        here: &Here,
        name: &str,
        span: Span,
    ) -> Option<Span> {
        let ast = &here.unit.ast;
        if span.file != ast.file {
            return None;
        }
        let standard = standard_include_of(name);
        let from = &self.sources.get(ast.file).name;
        let declares = |file: &str| {
            let is_standard = file.rsplit(['/', '\\']).next() == standard.as_deref();
            is_standard
                || self
                    .files
                    .read(file, from)
                    .is_ok_and(|found| declared_in(&String::from_utf8_lossy(&found.bytes), name))
        };
        let includes = ast.items(ast.root).iter().filter_map(|item| {
            let ItemKind::Directive(id) = item.kind else { return None };
            match ast.directive(id).kind {
                DirectiveKind::Include(file) => Some(ast.expression(file)),
                _ => None,
            }
        });
        let below = includes.filter(|file| file.span.start > span.end);
        let named = below.filter(|file| matches!(file.kind, ExpressionKind::String));
        named
            .map(|file| file.span)
            .take(MOST_READ)
            .find(|file| declares(self.sources.text(*file).trim_matches('"')))
    }

    /// Returns whether a missing `include` was already reported for another name. In the main file, a name is
    /// added as a label to the diagnostic for a missing colour.
    pub(super) fn is_told_to_lack(
        &mut self,
        include: &str,
        here: &Here,
        symbol: Symbol,
        span: Span,
    ) -> bool {
        if span.file != MAIN {
            return !self.lacking.insert(include.to_owned());
        }
        let name = self.scopes.name(symbol).to_owned();
        let is_own = self.scopes.declared(symbol).is_some()
            || here.unit.declaration_of(symbol).is_some()
            || self.scopes.visible().any(|other| other.eq_ignore_ascii_case(&name));
        let tells = |one: &Diagnostic| {
            let adds = |fix: &Fix| fix.span.file == MAIN && fix.text.contains(COLORS);
            one.code == Code::UndeclaredName && one.fixes.iter().any(adds)
        };
        let label = format!("nor is `{name}`");
        !is_own && include == COLORS && self.diagnostics.join(tells, span, label)
    }

    /// Adds the fix that inserts the include of colours at the top of the main file, for a name there.
    fn include_at_top(&self, here: &Here, told: Diagnostic, include: &str) -> Diagnostic {
        let ast = &here.unit.ast;
        let used = told.primary().map_or(0, |label| label.span.start);
        if ast.file != MAIN || include != COLORS {
            return told;
        }
        let line = format!("#include \"{include}\"");
        let text = &self.sources.get(MAIN).text;
        let (at, line) = match version_end(ast).filter(|end| *end <= used) {
            None => (0, format!("{line}\n")),
            Some(end) => {
                let rest = text.get(end as usize..).and_then(|rest| rest.lines().next());
                let ends_line = rest.is_none_or(|rest| rest.trim().is_empty());
                (end as usize, format!("\n{line}{}", if ends_line { "" } else { "\n" }))
            }
        };
        told.fix(Span::new(MAIN, at, at), line)
    }

    /// If a name is missing in a file that the main file includes, adds the fix that inserts the include
    /// before that one.
    pub(super) fn include_before(
        &self,
        here: &Here,
        diagnostic: Diagnostic,
        include: &str,
    ) -> Diagnostic {
        let expansions = &self.scene.expansions;
        let Some(outermost) = expansions
            .chain(here.expansion)
            .filter(|expansion| expansion.kind == ExpansionKind::Include)
            .last()
            .filter(|outermost| outermost.call.file == MAIN)
        else {
            return self.include_at_top(here, diagnostic, include);
        };
        let before = Span { end: outermost.call.start, ..outermost.call };
        diagnostic
            .help(format!(
                "write it before the include of `{}`, which takes it for granted",
                expansions.name(outermost)
            ))
            .fix(before, format!("#include \"{include}\"\n"))
    }
}

/// Returns the colour of the standard include that `name` spells differently: `skyblue`, `sky_blue`.
pub(in crate::evaluate) fn standard_color(name: &str) -> Option<&'static str> {
    let plain = name.replace(['_', ' '], "");
    standard_names(COLORS).find(|color| color.eq_ignore_ascii_case(&plain))
}

/// Returns whether a text has `#declare name` or `#macro name`.
fn declared_in(text: &str, name: &str) -> bool {
    text.match_indices('#').any(|(at, _)| {
        let line = text[..at].rsplit('\n').next().unwrap_or("");
        let mut words = text[at..].split(|c: char| !(c.is_ascii_alphanumeric() || c == '_'));
        let mut words = words.by_ref().filter(|word| !word.is_empty());
        !line.contains("//")
            && matches!(words.next(), Some("declare" | "macro"))
            && words.next() == Some(name)
    })
}
