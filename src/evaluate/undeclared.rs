//! What to say of a name that was never declared, and what it was most likely meant to be.
//!
//! **Invariant:** a name that differs only in case is the likeliest; then one that a standard include
//! declares under just this name, then a close one of the author's, then a word of the language.

use crate::diagnostic::{Code, Diagnostic, suggest};
use crate::source::Span;
use crate::vocabulary::{Role, Word, standard_include_of};

use super::value::Value;
use super::{Evaluator, Here, Reported, Symbol};

impl Evaluator<'_> {
    /// A name that was never declared, where a value should stand: said once for each name.
    pub(super) fn undeclared(&mut self, here: &Here, symbol: Symbol, span: Span) -> Reported {
        self.undeclared_among(here, symbol, span, |word| word.role() != Role::Statement)
    }

    /// As [`Self::undeclared`], where the words that `fits` says yes to could stand.
    pub(super) fn undeclared_among(
        &mut self,
        here: &Here,
        symbol: Symbol,
        span: Span,
        fits: impl Fn(Word) -> bool,
    ) -> Reported {
        let name = self.scopes.name(symbol).to_owned();
        let mut diagnostic =
            Diagnostic::new(Code::UndeclaredName, format!("`{name}` is not declared"));
        let standard = self.lacking_include(&name);
        let close = suggest::closest(&name, self.scopes.visible())
            .filter(|close| standard.is_none() || close.eq_ignore_ascii_case(&name))
            .map(str::to_owned);
        let later = here.unit.declaration_of(symbol);
        let was = self.scopes.declared(symbol).copied();
        if let Some(was) = was {
            diagnostic = diagnostic.at(span, "not declared any more");
            diagnostic = match was.undone {
                Some(undone) => diagnostic.also(undone.span, "forgotten here, by `#undef`"),
                None => diagnostic
                    .also(was.site.span, "declared here")
                    .help("a `#local` name ends with the macro or the include that it stands in"),
            };
        } else if let Some(later) = later.filter(|later| later.start > span.start) {
            diagnostic = diagnostic
                .at(span, "not declared up to here")
                .also(later, "declared only here: move it up");
        } else if let Some(close) = close {
            diagnostic = diagnostic
                .at(span, "not declared up to here")
                .help(format!("did you mean `{close}`?"))
                .fix(span, close.clone());
            if let Some(declared) = self.scopes.symbol(&close).and_then(|s| self.scopes.declared(s))
            {
                let declared = declared.site.span;
                diagnostic = diagnostic.also(declared, format!("`{close}` is declared here"));
            }
        } else if let Some(include) = standard {
            diagnostic = diagnostic
                .at(span, "not declared up to here")
                .help(format!("`{name}` comes with `#include \"{include}\"`"));
        } else if let Some((close, later)) = here.unit.similar_declaration(&name) {
            diagnostic = diagnostic
                .at(span, "not declared up to here")
                .also(later, format!("`{close}` is declared here"))
                .help(format!("did you mean `{close}`, declared before its use?"));
        } else if let Some(word) = word_like(&name, fits) {
            diagnostic = diagnostic
                .at(span, "not declared, and not a word of the language")
                .help(format!("did you mean `{word}`?"))
                .fix(span, word);
        } else if self.lacks_include {
            // It may stand in the include that was not found.
            self.scopes.assign(symbol, Value::Broken);
            return Reported;
        } else {
            diagnostic = diagnostic.at(span, "not declared up to here");
        }
        let reported = self.report(here, diagnostic);
        // Known from now on, so that it is said once.
        self.scopes.assign(symbol, Value::Broken);
        reported
    }

    /// The standard include that declares `name`, where it was not read.
    pub(super) fn lacking_include(&self, name: &str) -> Option<String> {
        standard_include_of(name).filter(|include| {
            // An author's own name of one letter is likelier.
            name.len() > 1 && !self.parsed.keys().any(|file| file.ends_with(include))
        })
    }
}

/// The word of the language that an author who wrote `name` most likely meant.
pub(super) fn word_like(name: &str, fits: impl Fn(Word) -> bool) -> Option<&'static str> {
    let words = || Word::ALL.iter().filter(|word| fits(**word)).map(|word| word.name());
    suggest::closest(name, words().filter(|word| is_likely(name, word)))
        .or_else(|| suggest::foreign(name).find(|foreign| words().any(|word| word == *foreign)))
}

/// Whether `word`, which is close to `name`, is rather meant than nothing: a name with a capital is one of
/// the author's, and a short word that is not built is close to too many.
pub(super) fn is_likely(name: &str, word: &str) -> bool {
    let capital = name.starts_with(char::is_uppercase);
    let short = name.len().min(word.len()) < 4;
    name.eq_ignore_ascii_case(word) || !(capital || short && !is_built(word))
}

pub(super) fn is_built(name: &str) -> bool {
    Word::ALL.iter().any(|word| word.name() == name && word.is_built())
}
