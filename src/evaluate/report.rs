//! Diagnostics for mistakes that many parts of the evaluator can find.

use std::ops::RangeInclusive;

use crate::color::{rounded, srgb_decode};
use crate::diagnostic::{Code, Diagnostic};
use crate::source::{ExpansionId, Span};
use crate::syntax::ast::{DirectiveId, DirectiveKind};
use crate::vocabulary::{Dialect, Family, Word};

use super::block::color_of_string;
use super::stream::{Token, TokenKind};
use super::value::{Poison, Value};
use super::written::unquoted;
use super::{Evaluator, Here, Outcome, Reported, Symbol, endless};

impl Evaluator<'_> {
    #[cold]
    pub(super) fn report(&mut self, here: &Here, diagnostic: Diagnostic) -> Reported {
        self.report_in(here.expansion, diagnostic)
    }

    #[cold]
    pub(super) fn report_in(
        &mut self,
        expansion: ExpansionId,
        mut diagnostic: Diagnostic,
    ) -> Reported {
        // After a limit, parts are missing because nothing more is read.
        if self.repeats(&diagnostic) || self.may_be_undecided(diagnostic.code) {
            return Reported;
        }
        if let Some(span) = diagnostic.primary().map(|label| label.span) {
            let site = crate::source::Site { span, expansion };
            diagnostic = diagnostic.traced(site, &self.scene.expansions);
        }
        self.count(&diagnostic);
        if !self.diagnostics.turns_of(&diagnostic) {
            self.diagnostics.push(diagnostic);
        }
        Reported
    }

    /// Reports a construct that POV-Ray 3.7 renders nevertheless: an error in a `.scene`; in a `.pov` a
    /// warning, after which the caller goes on as POV-Ray does.
    #[cold]
    pub(super) fn opinion(&mut self, here: &Here, diagnostic: Diagnostic) -> Outcome<()> {
        match self.options.dialect {
            Dialect::Scene => Err(self.report(here, diagnostic)),
            Dialect::Pov => {
                self.report(here, diagnostic.as_warning());
                Ok(())
            }
        }
    }

    /// Reports that a limit is reached, and halts the evaluation.
    pub(super) fn halt(&mut self, expansion: ExpansionId, diagnostic: Diagnostic) -> Reported {
        let reported = self.report_in(expansion, diagnostic);
        self.halted = true;
        reported
    }

    pub(super) fn wrong_type(
        &mut self,
        here: &Here,
        span: Span,
        wanted: &str,
        found: &Value,
    ) -> Reported {
        self.wrong_type_with(here, span, wanted, found, None)
    }

    pub(super) fn wrong_type_with(
        &mut self,
        here: &Here,
        span: Span,
        wanted: &str,
        found: &Value,
        help: Option<String>,
    ) -> Reported {
        if self.is_refused_again(here, span, found) {
            return Reported;
        }
        let text = self.sources.text(span).to_owned();
        let name = self.scopes.symbol(&text);
        let subject = if name.is_some() { format!("`{text}`") } else { "this".to_owned() };
        let diagnostic = match found {
            Value::Broken => return Reported,
            Value::Poison(poison) => return self.not_supported(*poison, Some(span)),
            found => Diagnostic::new(
                Code::WrongType,
                format!("expected {wanted}, found {}", found.kind()),
            )
            .at(span, format!("{subject} is {}", found.kind())),
        };
        let mut diagnostic = help.into_iter().fold(diagnostic, Diagnostic::help);
        if let Value::Spline(_) = found {
            let help = format!("a spline has a value at a time: `{text}(0.5)`");
            let behind = self.sources.get(span.file).text.get(span.end as usize..).unwrap_or("");
            let index = behind.strip_prefix('[').and_then(|rest| rest.split_once(']'));
            diagnostic = match index.filter(|(index, _)| !index.contains(['[', '\n'])) {
                Some((index, _)) => {
                    let right = format!("{text}({index})");
                    let end = span.end + index.len() as u32 + 2;
                    let help = format!("a spline has a value at a time: write `{right}`");
                    diagnostic.help(help).fix(Span { end, ..span }, right)
                }
                None => diagnostic.help(help),
            };
        }
        let meant = match (found, wanted) {
            (Value::Array(_), "a vector or a colour before the dot") => Some(format!(
                "how many elements it has is `dimension_size({text}, 1)`; one of them is `{text}[0]`"
            )),
            (Value::Vector(_) | Value::Color(_), "an array before `[`") => {
                Some(format!("a component of it is written `{text}.x`"))
            }
            (Value::Spline(_), "an array before `[`") => {
                Some(format!("a spline is called: `{text}(0.5)`"))
            }
            (Value::Array(_), _) => Some(format!("an element of it has its place: `{text}[0]`")),
            (Value::Color(_), wanted) if wanted.starts_with("a number") && name.is_some() => {
                Some(format!("how bright it is: `{text}.gray`"))
            }
            (Value::Function(_), wanted) if wanted.starts_with("a number") => {
                Some(format!("a function has a value where it is called: `{text}(x, y, z)`"))
            }
            (Value::Vector(_), "a number for the height it ends at") => Some(
                "two heights and a count stand before the points: `prism { 0, 1, 4, …`".to_owned(),
            ),
            (Value::Vector(_), "a number for the major radius") => {
                Some("a torus lies around the origin; `translate` moves it".to_owned())
            }
            (Value::Object(_), "a vector or a colour before the dot") => Some(format!(
                "what moves or changes an object stands in its block: `object {{ {text} translate x }}`"
            )),
            (Value::Transform(_), "a vector") => {
                Some(format!("a declared transform is applied by `transform {{ {text} }}`"))
            }
            (Value::Vector(_), "a number for the radius") => {
                Some("what is not round is scaled: `sphere { 0, 1 scale <a, b, c> }`".to_owned())
            }
            (Value::Vector(_), "a string") => {
                Some(format!("write `vstr(3, {text}, \", \", 0, 3)` for it as a string"))
            }
            (Value::Vector(_), "a number as condition") => Some(
                "vectors are compared by a component, as `.x`, or by `vlength(A - B)`".to_owned(),
            ),
            (Value::String(_), "a number as condition") => {
                Some(format!("two strings are compared by `strcmp({text}, \"…\") = 0`"))
            }
            _ => None,
        };
        if let Some(meant) = meant {
            diagnostic = diagnostic.help(meant);
        }
        if let Value::String(found) = found
            && text.starts_with('"')
            && let Some(plain) = unquoted(found.trim(), wanted)
        {
            let what = if wanted.starts_with("a vector") { "a vector" } else { "a number" };
            let help = format!("{what} stands without quotes: `{plain}`");
            diagnostic = diagnostic.help(help).fix(span, plain);
        }
        if let Value::String(found) = found
            && wanted == "a colour"
            && text.starts_with('"')
            && found.starts_with(|c: char| c.is_ascii_uppercase())
            && found.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'_')
        {
            diagnostic =
                diagnostic.help(format!("a declared colour stands without quotes: `{found}`"));
        }
        if let Value::String(found) = found
            && let Some(shown) = color_of_string(found)
            && let Some(color) = match wanted {
                "a colour" => Some(format!("srgb {}", rounded(shown))),
                "display values" => Some(rounded(shown)),
                "a vector" => Some(rounded(shown.map(srgb_decode))),
                _ => None,
            }
        {
            diagnostic = diagnostic.help(format!("write `{color}`"));
            if name.is_none() {
                diagnostic = diagnostic.fix(span, color);
            }
        }
        let diagnostic = match name.and_then(|symbol| self.scopes.declared(symbol)) {
            Some(declared) if declared.site.span != span => {
                let site = declared.site;
                diagnostic.also(site.span, "declared here")
            }
            _ => diagnostic,
        };
        let diagnostic = self.given_by_call(here, span, found, diagnostic);
        self.report(here, diagnostic)
    }

    /// Records an unsupported word in the item being read. The first becomes the item's poison and carries
    /// the others with it.
    pub(super) fn set_poison(&mut self, poison: Poison) {
        let first = *self.poison.get_or_insert(poison);
        if first.word != poison.word {
            let beside = self.beside.entry(first.site.span).or_default();
            if beside.iter().all(|other| other.word != poison.word) {
                beside.push(poison);
            }
        }
    }

    /// Reports poison whose value is needed, for each unsupported word.
    pub(super) fn not_supported(&mut self, poison: Poison, used: Option<Span>) -> Reported {
        let (mut told, mut all) = (vec![poison.word], vec![poison]);
        let mut used = used;
        while let Some(poison) = all.pop() {
            self.not_built(poison, used.take());
            let beside = self.beside.get(&poison.site.span).cloned().unwrap_or_default();
            for other in beside {
                if !told.contains(&other.word) {
                    told.push(other.word);
                    all.push(other);
                }
            }
        }
        Reported
    }

    fn not_built(&mut self, poison: Poison, used: Option<Span>) -> Reported {
        let mut diagnostic = Diagnostic::new(
            Code::NotSupportedYet,
            format!("{} not supported yet", what_is_not_built(poison.word)),
        )
        .at(poison.site.span, "the language has it, this version does not build it");
        if self.repeats(&diagnostic) {
            return Reported;
        }
        let beside = match poison.word.is_built() || poison.word.family() == Family::Directive {
            true => Vec::new(),
            false => built_beside(poison.word),
        };
        diagnostic = match beside.as_slice() {
            [] => diagnostic.help("leave it out for now"),
            built => diagnostic.help(format!("built so far beside it: {}", built.join(", "))),
        };
        if let Some(used) = used.filter(|used| *used != poison.site.span) {
            diagnostic = diagnostic.also(used, "needed by this");
        }
        self.report_in(poison.site.expansion, diagnostic)
    }

    /// Reports a macro's name without its arguments.
    pub(super) fn macro_not_called(&mut self, here: &Here, symbol: Symbol, span: Span) -> Reported {
        let name = self.scopes.name(symbol).to_owned();
        let form = match self.scopes.read(symbol) {
            Some(&Value::Macro(id)) => self.form(&self.macros[id.0 as usize]),
            _ => format!("{name}()"),
        };
        let message = format!("`{name}` is a macro, and is called with parentheses");
        let behind = self.sources.get(span.file).text.get(span.end as usize..).unwrap_or("");
        let gap = behind.len() - behind.trim_start_matches([' ', '\t']).len();
        let brace = Span { start: span.end + gap as u32, end: span.end + gap as u32 + 1, ..span };
        let told = Diagnostic::new(Code::WrongType, message);
        let mut diagnostic = match behind[gap..].starts_with('{') {
            true => told.at(brace, "expected `(`").also(span, "the macro"),
            false => told.at(span, "expected `(` after this"),
        };
        if let Some(declared) = self.scopes.declared(symbol) {
            diagnostic = diagnostic.also(declared.site.span, "defined here");
        }
        diagnostic = diagnostic.help(format!("write `{form}`"));
        if form.ends_with("()") {
            diagnostic = diagnostic.fix(span, form);
        }
        self.report(here, diagnostic)
    }

    /// Reports a loop that never ends, or not soon enough, and halts the evaluation.
    pub(super) fn loop_limit(
        &mut self,
        here: &Here,
        directive: DirectiveId,
        message: String,
        label: &str,
    ) -> Outcome<()> {
        let ast = &here.unit.ast;
        let directive = ast.directive(directive);
        let diagnostic = Diagnostic::new(Code::LoopLimit, message);
        let diagnostic = match directive.kind {
            DirectiveKind::While { condition, body } => {
                match endless::nearly_set(ast, condition, body) {
                    Some((asked, set, span)) => {
                        let told = diagnostic
                            .at(span, format!("this sets `{set}`, the condition asks `{asked}`"))
                            .also(directive.head, label)
                            .help(format!("did you mean `{asked}`?"))
                            .fix(span, asked);
                        match set.eq_ignore_ascii_case(asked) {
                            true => told.help("names that differ in capitals are different names"),
                            false => told,
                        }
                    }
                    None => {
                        let told = diagnostic.at(directive.head, label).help(
                            "change in its body what its condition asks, or leave it with `#break`",
                        );
                        match endless::never_set(ast, condition, body) {
                            Some(name) => told.help(format!("its body never changes `{name}`")),
                            None => told,
                        }
                    }
                }
            }
            _ => diagnostic.at(directive.head, label),
        };
        // No limit helps a loop that never ends.
        let limited = diagnostic.message.contains("turn") && !self.options.interrupt.is_set();
        let diagnostic = match limited {
            true => diagnostic.help("`--limit loop-turns=N` raises the limit"),
            false => diagnostic,
        };
        Err(self.halt(here.expansion, diagnostic))
    }

    /// Reports an item that appears where a value is expected.
    pub(super) fn expected(
        &mut self,
        wanted: &str,
        found: Option<&Token>,
        otherwise: (&Here, Span),
    ) -> Reported {
        if let Some(reported) = self.blame_macro(wanted) {
            return reported;
        }
        match found {
            Some(token) => {
                let text = self.describe(token);
                let diagnostic = Diagnostic::new(
                    Code::ExpectedExpression,
                    format!("expected {wanted}, found {text}"),
                )
                .at(token.span, format!("expected {wanted}"));
                self.report(&token.here.clone(), diagnostic)
            }
            None => {
                let (here, span) = otherwise;
                let diagnostic =
                    Diagnostic::new(Code::MissingPart, format!("expected {wanted}, found nothing"))
                        .at(span, format!("{wanted} is missing here"));
                self.report(here, diagnostic)
            }
        }
    }

    /// Describes a token: its text if that is short.
    pub(super) fn describe(&self, token: &Token) -> String {
        match &token.kind {
            TokenKind::Block(_) => "a block".to_owned(),
            TokenKind::Entry(_) => "an entry in brackets".to_owned(),
            TokenKind::Comma => "a comma".to_owned(),
            TokenKind::Semicolon => "a semicolon".to_owned(),
            TokenKind::Literal(value) => value.kind().to_owned(),
            TokenKind::Word(word) => format!("`{}`", word.name()),
            TokenKind::Expression(_) => {
                let text = self.sources.text(token.span);
                if text.chars().count() > 24 || text.contains(['\n', '\r']) {
                    "an expression".to_owned()
                } else {
                    format!("`{text}`")
                }
            }
        }
    }
}

/// Returns a phrase such as "one argument", "2 or 3 arguments" or "at least 2 arguments".
pub(super) fn count(range: &RangeInclusive<usize>, what: &str) -> String {
    let plural = |n: usize| if n == 1 { "" } else { "s" };
    match (*range.start(), *range.end()) {
        (0, 0) => format!("no {what}s"),
        (low, usize::MAX) => format!("at least {low} {what}{}", plural(low)),
        (1, 1) => format!("one {what}"),
        (low, high) if low == high => format!("{low} {what}s"),
        (low, high) if low + 1 == high => format!("{low} or {high} {what}s"),
        (low, high) => format!("{low} to {high} {what}s"),
    }
}

/// Returns the name of an unsupported feature, with its verb. A word that is supported elsewhere is described
/// by its unsupported use.
fn what_is_not_built(word: Word) -> String {
    let name = word.name();
    match word {
        Word::Macro => "a macro whose parentheses do not pair is".to_owned(),
        _ => format!("`{name}` is"),
    }
}

/// Returns the supported words of a word's family that may replace it.
fn built_beside(word: Word) -> Vec<String> {
    let beside = |other: Word| match other {
        Word::FadeDistance | Word::FadePower => {
            matches!(word.family(), Family::Light | Family::Interior)
        }
        // What the parts of a light stand in, and no part.
        Word::LightSource if word != Word::LightGroup => false,
        Word::Difference | Word::Intersection | Word::Merge | Word::Union => {
            matches!(word.family(), Family::Shape | Family::Csg)
        }
        _ => other.family() == word.family() && other.block() == word.block(),
    };
    let fits = |other: &&Word| {
        other.is_built()
            && !other.is_inert()
            && beside(**other)
            && std::mem::discriminant(&other.role()) == std::mem::discriminant(&word.role())
    };
    Word::ALL.iter().filter(fits).map(|word| format!("`{}`", word.name())).collect()
}
