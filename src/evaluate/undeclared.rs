//! Diagnostics for undeclared names, with the most likely intended name.
//!
//! **Invariant:** suggestions are tried in this order: a name that differs only in case, the equivalent of
//! another language's name, a name that a standard include declares exactly, a similar name of the author's,
//! a word of the language.

mod elsewhere;
mod lacking;
mod parameter;
mod uncalled;
mod unmade;

pub(super) use self::lacking::standard_color;

use std::collections::HashSet;
use std::rc::Rc;
use std::sync::LazyLock;

use crate::diagnostic::{Code, Diagnostic, suggest};
use crate::source::{FileId, Span};
use crate::syntax::ast::{ExpressionId, ExpressionKind};
use crate::vocabulary::{Family, PREDECLARED, Role, Word, standard_include_of};

use super::value::Value;
use super::written::number_as_a_name;
use super::{Evaluator, Here, Reported, Symbol};

/// Maximum number of undeclared names for which a suggestion is searched; each search goes through all names.
const MOST_LOOKS: usize = 200;

impl Evaluator<'_> {
    /// Reports an undeclared name where a value is expected, once for each name.
    pub(super) fn undeclared(&mut self, here: &Here, symbol: Symbol, span: Span) -> Reported {
        self.undeclared_among(here, symbol, span, |word| word.role() != Role::Statement)
    }

    /// As [`Self::undeclared`], at a position where the words that `fits` accepts could appear.
    pub(super) fn undeclared_among(
        &mut self,
        here: &Here,
        symbol: Symbol,
        span: Span,
        fits: impl Fn(Word) -> bool,
    ) -> Reported {
        let name = self.scopes.name(symbol).to_owned();
        // `Arm_001`, where `Arm.001` is declared: that has been reported.
        let is_dotted =
            |other: &str| other.contains(['.', '-']) && other.replace(['.', '-'], "_") == name;
        let is_looked_for = self.remembered.undeclared.len() < MOST_LOOKS;
        if is_looked_for && name.contains('_') && self.scopes.visible().any(is_dotted) {
            return Reported;
        }
        // `T_Stone 21`: reported when it was parsed.
        if name.contains([' ', '-']) {
            self.scopes.assign(symbol, Value::Broken);
            return Reported;
        }
        if let Some(diagnostic) = self.of_another_writing(&name, span) {
            let reported = self.report(here, diagnostic);
            self.skip_behind(span);
            return reported;
        }
        if let Some(diagnostic) = self.alpha_color(&name, span) {
            let reported = self.report(here, diagnostic);
            self.skip_behind(span);
            return reported;
        }
        let told = match self.remembered.undeclared.get(&(span, symbol)) {
            Some(told) => told.clone(),
            None => {
                let told = self.not_declared(here, symbol, &name, span, fits).map(Rc::new);
                self.remembered.undeclared.insert((span, symbol), told.clone());
                told
            }
        };
        if let Some(told) = told {
            self.report_again(here, &told);
        }
        // Declared from now on, so that it is reported once.
        self.scopes.assign(symbol, Value::Broken);
        self.assumed.push(symbol);
        Reported
    }

    /// Returns the only one of the author's names that a capitalized name resembles.
    pub(super) fn one_alike(&self, name: &str) -> Option<&str> {
        let own = self.scopes.visible().filter(|other| {
            let is_standard = || standard_include_of(other).is_some();
            other.starts_with(char::is_uppercase) && !is_standard()
        });
        name.starts_with(char::is_uppercase).then(|| suggest::alike(name, own))?
    }

    /// Returns the diagnostic; `None` if the cause may be a missing include, which was reported.
    fn not_declared(
        &mut self,
        here: &Here,
        symbol: Symbol,
        name: &str,
        span: Span,
        fits: impl Fn(Word) -> bool,
    ) -> Option<Diagnostic> {
        // Its own declaration extends to here because of a missing brace.
        if self.misread && self.declared_now.contains(&symbol) {
            return None;
        }
        let mut diagnostic =
            Diagnostic::new(Code::UndeclaredName, format!("`{name}` is not declared"));
        let rest = self.sources.get(span.file).text.get(span.end as usize..).unwrap_or("");
        let is_called = rest.trim_start().starts_with('(');
        let names_a_value = rest.starts_with([' ', '\t'])
            && rest.trim_start().starts_with(|c: char| c.is_ascii_digit() || c == '<');
        let text = &self.sources.get(span.file).text[..span.start as usize];
        let line = text.rsplit(['\n', '\r']).next().unwrap_or("").trim_start();
        let begins = text.trim_end().ends_with('{');
        let counts_a_loop = line.strip_prefix("#while").is_some_and(|rest| !rest.contains(')'));
        let is_own = name.starts_with(char::is_uppercase);
        let standard = self.lacking_include(name);
        // What the files that the main file includes lack of another one is one mistake.
        if let Some(include) = &standard
            && self.is_told_to_lack(include, here, symbol, span)
        {
            return None;
        }
        if self.remembered.undeclared.len() >= MOST_LOOKS {
            let is_whole = !self.lacks_include && self.unread.is_empty();
            return is_whole.then(|| diagnostic.at(span, "not declared up to here"));
        }
        let of_others = is_called && suggest::foreign(name).next().is_some();
        let close = suggest::closest(name, self.scopes.visible())
            .or_else(|| suggest::abridged(name, self.scopes.visible()))
            .or_else(|| suggest::contracted(name, self.scopes.visible()))
            .or_else(|| self.one_alike(name))
            .filter(|close| standard.is_none() || close.eq_ignore_ascii_case(name))
            // `arctan(b, a)` is more likely another language's function than a colour.
            .filter(|close| {
                let value = self.scopes.symbol(close).and_then(|symbol| self.scopes.look(symbol));
                !of_others
                    || matches!(
                        value,
                        Some(Value::Macro(_) | Value::Function(_) | Value::Spline(_))
                    )
            })
            .map(str::to_owned);
        if let Some(include) = standard.as_deref()
            && self
                .unread
                .iter()
                .any(|unread| unread == include || suggest::closest(unread, [include]).is_some())
        {
            // The include that was not read would have declared it.
            return None;
        }
        let later = here.unit.declaration_of(symbol);
        let was = self.scopes.declared(symbol).copied();
        if let Some(was) = was {
            diagnostic = diagnostic.at(span, "not declared any more");
            diagnostic = match was.undone {
                Some(undone) => diagnostic.also(undone.span, "forgotten here, by `#undef`"),
                None => diagnostic.also(was.site.span, "declared here").help(
                    "a `#local` name ends with the macro or the include that it stands in; one of \
                         `#declare` stays",
                ),
            };
        } else if let Some(later) = later.filter(|later| later.start > span.start) {
            diagnostic = diagnostic
                .at(span, "not declared up to here")
                .also(later, "declared only here: move it up");
        } else if let Some(include) = self.included_below(here, name, span) {
            diagnostic = diagnostic
                .at(span, "not declared up to here")
                .also(include, "it comes with this include: move it up");
        } else if let Some(call) = self.call_elsewhere(name, span, close.as_deref()) {
            diagnostic =
                diagnostic.at(span, "not declared, and not a word of the language").help(call.help);
            diagnostic = call.fixes.into_iter().fold(diagnostic, |told, (at, by)| told.fix(at, by));
            if let Some(close) =
                close.filter(|close| suggest::closest(name, [close.as_str()]).is_some())
            {
                diagnostic =
                    diagnostic.help(format!("or did you mean `{close}`, which is declared?"));
            }
        } else if let Some(close) = close {
            diagnostic = diagnostic
                .at(span, "not declared up to here")
                .help(format!("did you mean `{close}`?"));
            if !suggest::are_of_a_series(name, &close) {
                diagnostic = diagnostic.fix(span, close.clone());
            }
            if let Some(declared) = self.scopes.symbol(&close).and_then(|s| self.scopes.declared(s))
            {
                let declared = declared.site.span;
                diagnostic = diagnostic.also(declared, format!("`{close}` is declared here"));
            }
        } else if let Some(include) = standard {
            diagnostic = diagnostic
                .at(span, "not declared up to here")
                .help(format!("`{name}` comes with `#include \"{include}\"`"));
            if let Some(own) = suggest::closest(name, self.scopes.visible()) {
                diagnostic =
                    diagnostic.help(format!("or did you mean `{own}`, which is declared?"));
            }
            diagnostic = self.include_before(here, diagnostic, &include);
        } else if let Some(word) = self
            .word_of_block(name)
            .filter(|_| !is_own)
            .or_else(|| self.item_like(name, span))
            .filter(|_| self.lacking_in_small_letters(name).is_none())
        {
            diagnostic = diagnostic
                .at(span, "not declared, and not a word of the language")
                .help(format!("did you mean `{word}`?"))
                .fix(span, word);
        } else if let Some((close, later)) =
            here.unit.similar_declaration(name).filter(|_| !of_others)
        {
            diagnostic = diagnostic
                .at(span, "not declared up to here")
                .also(later, format!("`{close}` is declared here"))
                .help(format!("did you mean `{close}`, declared before its use?"));
        } else if let Some((owner, parameter)) = self.macro_with_parameter(symbol) {
            diagnostic = diagnostic
                .at(span, "not declared here")
                .also(parameter, format!("a parameter of macro `{owner}`"))
                .help("a parameter is known in the body of its macro only");
        } else if let Some(told) = number_as_a_name(name, span).filter(|_| !is_called) {
            diagnostic = told;
        } else if let Some((close, include)) =
            // A colour is one only where any value is allowed.
            self.lacking_near(name).filter(|_| fits(Word::X))
        {
            diagnostic = diagnostic
                .at(span, "not declared up to here")
                .help(format!("did you mean `{close}`? It comes with `#include \"{include}\"`"));
        } else if let Some(word) = word_like(name, |word| {
            // A function without its arguments is rarely meant.
            fits(word) && (is_called || !matches!(word.role(), Role::Function { .. }))
        }) {
            diagnostic = diagnostic
                .at(span, "not declared, and not a word of the language")
                .help(format!("did you mean `{word}`?"))
                .fix(span, word);
        } else if self.lacks_include {
            // It may stand in the include that was not found.
            return None;
        } else {
            diagnostic = diagnostic.at(span, "not declared up to here");
            diagnostic = self.by_uncalled_macro(symbol, diagnostic);
            // `spline { catmull_rom_spline … }`: the first item of a block is probably a word.
            let theirs = suggest::foreign(name).filter(|_| !is_own).find(|ours| {
                PREDECLARED.iter().any(|(known, _)| known == ours)
                    || Word::from_name(ours).is_some_and(|word| match word.role() {
                        Role::Statement => begins,
                        Role::Value => !is_called,
                        Role::Function { .. } => is_called,
                    })
            });
            if let Some(ours) = theirs {
                let meant = format!("did you mean `{ours}`?");
                return Some(diagnostic.help(meant).fix(span, ours));
            }
            // `box { center 0 size 2 }`: the word meant in this block.
            let opener = self.openers.last().map(|opener| self.sources.text(*opener));
            if let Some(word) = opener.and_then(Word::from_name).filter(|_| names_a_value) {
                diagnostic = diagnostic.help(self.form_of(word));
            } else if let Some(parameters) = self.parameters_around(span) {
                diagnostic =
                    diagnostic.help(format!("the parameters of this function: {parameters}"));
            }
        }
        if counts_a_loop && diagnostic.help.is_empty() {
            diagnostic = diagnostic
                .help(format!("a loop's counter begins before it: `#declare {name} = 0;`"));
        }
        Some(diagnostic)
    }

    /// Returns the keyword that begins an item with a value after it and that `name` resembles: `rotae
    /// -z*30`.
    fn item_like(&self, name: &str, span: Span) -> Option<&'static str> {
        let text = &self.sources.get(span.file).text;
        let (before, after) = (text.get(..span.start as usize)?, text.get(span.end as usize..)?);
        let begins = |c: char| c.is_alphanumeric() || "{}>)\"_,".contains(c);
        let has_value = |c: char| c.is_ascii_digit() || "<-.xyz".contains(c);
        let stands_alone = name.starts_with(char::is_lowercase)
            && before.trim_end().ends_with(begins)
            && after.starts_with([' ', '\t'])
            && after.trim_start().starts_with(has_value);
        let fits =
            |word: Word| word.role() == Role::Statement && word.family() != Family::Directive;
        word_like(name, fits).filter(|_| stands_alone)
    }

    /// Reports missing quotes: `Hello` or `grass.png` where a string is expected.
    pub(super) fn lacks_quotes(&mut self, here: &Here, id: ExpressionId) -> Option<Reported> {
        let mut named = id;
        if let ExpressionKind::Component(base, _) = here.unit.expression(named).kind {
            named = base;
        }
        let symbol = self.unknown_name(here, named)?;
        // A name close to one of the author's means that one.
        let name = self.scopes.name(symbol).to_owned();
        if suggest::closest(&name, self.scopes.visible()).is_some()
            || here.unit.declaration_of(symbol).is_some()
        {
            return None;
        }
        let span = here.unit.expression(id).span;
        let text = self.sources.text(span);
        let diagnostic = Diagnostic::new(
            Code::UndeclaredName,
            format!("expected a string, found `{text}`, which is not declared"),
        )
        .at(span, "a string stands in quotes")
        .help(format!("write `\"{text}\"`"))
        .fix(span, format!("\"{text}\""));
        Some(self.report(here, diagnostic))
    }
}

/// The replacement for a call of another language.
struct Call {
    help: String,
    fixes: Vec<(Span, String)>,
}

impl Call {
    fn renamed(span: Span, ours: &str) -> Self {
        Self { help: format!("did you mean `{ours}`?"), fixes: vec![(span, ours.to_owned())] }
    }
}

/// The main file.
const MAIN: FileId = FileId(0);

/// Returns the word of the language that an author who wrote `name` most likely meant.
pub(super) fn word_like(name: &str, fits: impl Fn(Word) -> bool) -> Option<&'static str> {
    let words = || Word::ALL.iter().filter(|word| fits(**word)).map(|word| word.name());
    suggest::foreign(name)
        .find(|foreign| words().any(|word| word == *foreign))
        .or_else(|| suggest::reworded(name, words()))
        .or_else(|| suggest::closest(name, words().filter(|word| is_likely(name, word))))
        .or_else(|| suggest::abridged(name, words()))
        .or_else(|| suggest::short_of(name, words()))
}

/// Returns whether `word`, which is close to `name`, is a plausible suggestion: a capitalized name is one of
/// the author's, and a short unsupported word is close to too many.
pub(super) fn is_likely(name: &str, word: &str) -> bool {
    let capital = name.starts_with(char::is_uppercase);
    let short = name.len().min(word.len()) < 4;
    name.eq_ignore_ascii_case(word) || !(capital || short && !is_built(word))
}

pub(super) fn is_built(name: &str) -> bool {
    static BUILT: LazyLock<HashSet<&str>> = LazyLock::new(|| {
        Word::ALL.iter().filter(|word| word.is_built()).map(|word| word.name()).collect()
    });
    BUILT.contains(name)
}
