//! Semicolons and commas: in a `.pov` file a `;` ends the declaration of a number and a comma separates
//! values; neither may appear anywhere else.
//!
//! **Source:** measured: from version 3.5 on, POV-Ray refuses a declared number, vector or colour without its
//! `;`. It accepts a second `;` there and refuses every other one; it refuses a comma after the last part of
//! a block, between the words of a block, and between objects.

use crate::diagnostic::{Code, Diagnostic};
use crate::source::{Site, Span};
use crate::syntax::ast::{ExpressionId, ExpressionKind, ItemKind};
use crate::vocabulary::{Dialect, Family, Role, Word};

use super::block::Place;
use super::stream::{Token, TokenKind};
use super::value::Value;
use super::{Evaluator, Here};

impl Evaluator<'_> {
    /// Consumes the `;` after the value of a `#declare`, which is mandatory for a number.
    pub(super) fn end_of_declaration(&mut self, head: Span, value: Option<&Value>) {
        // `#define A 1`, `int A = 1`: reported as such.
        let opening = self.sources.text(head);
        let named = opening.starts_with('#')
            && (opening.ends_with("declare") || opening.ends_with("local"));
        let numeric =
            named && matches!(value, Some(Value::Number(_) | Value::Vector(_) | Value::Color(_)));
        let last = self.taken;
        let is_semicolon = |token: Option<&Token>| {
            matches!(token.map(|token| &token.kind), Some(TokenKind::Semicolon))
        };
        let passed = self.pass(ItemKind::Semicolon);
        if passed || is_semicolon(self.peek_on()) {
            if !passed {
                self.next();
            }
            if numeric && is_semicolon(self.peek_on()) {
                self.next();
            }
            return;
        }
        if numeric && self.two_values(head) {
            return;
        }
        // Anything else after the value is a mistake of its own.
        let ends = matches!(
            self.peek_on().map(|token| &token.kind),
            None | Some(TokenKind::Word(_) | TokenKind::Block(_))
        );
        let needed = self.options.dialect == Dialect::Pov && !self.is_before(SINCE);
        // The last word of a macro stands elsewhere.
        let is_here = |last: &Site| last.span.file == head.file && last.span.start >= head.start;
        let wanted = numeric && ends && needed;
        let Some(last) = last.filter(|last| wanted && is_here(last)) else { return };
        let place = last.span.after();
        let diagnostic = Diagnostic::new(Code::Semicolon, "a declared number ends with `;`")
            .at(self.sources.sign_before(place), "expected `;` after this")
            .help("POV-Ray refuses it without")
            .fix(place, ";");
        // It may be reported as an old form.
        let old_forms = self.remembered.old_forms.get_or_insert_with(|| {
            let told = self.diagnostics.iter().filter(|one| one.code == Code::LegacyForm);
            told.flat_map(|one| one.fixes.iter().map(|fix| fix.span)).collect()
        });
        if old_forms.contains(&place) || self.repeats(&diagnostic) {
            return;
        }
        self.report_in(last.expansion, diagnostic);
    }

    /// Handles two values on one line without an operator, `#declare Area = 2 pi*R;`: consumes the second and
    /// its `;`.
    fn two_values(&mut self, head: Span) -> bool {
        let Some(Token { kind: TokenKind::Expression(id), here, span }) = self.peek_on().cloned()
        else {
            return false;
        };
        let Some(last) = self.taken.map(|last| last.span) else { return false };
        let is_behind = last.file == span.file && last.start >= head.start && last.end < span.start;
        let between = Span { start: last.end, end: span.start, ..span };
        let is_object = match here.unit.expression(id).kind {
            ExpressionKind::Name(name) => {
                matches!(self.scopes.read(here.symbol(name)), Some(Value::Object(_)))
            }
            _ => false,
        };
        if !is_behind || is_object || self.sources.text(between).contains(|c| c != ' ' && c != '\t')
        {
            return false;
        }
        self.next();
        // `2 x 3`
        while let Some(Token { kind: TokenKind::Expression(_), span: more, .. }) = self.peek_on() {
            let gap = Span { start: span.end, end: more.start, ..span };
            let on_line = more.file == span.file
                && span.end < more.start
                && !self.sources.text(gap).contains(['\n', '\r']);
            if !on_line {
                break;
            }
            self.next();
        }
        self.pass(ItemKind::Semicolon);
        let [one, other] = [last, span].map(|span| self.sources.text(span).to_owned());
        let diagnostic = Diagnostic::new(Code::ExtraPart, "no sign stands between two values")
            .at(span, format!("expected an operator before `{other}`"))
            .help(format!("a product is written with `*`: `{one}*{other}`"))
            .fix(between, "*");
        self.report(&here, diagnostic);
        true
    }

    /// Checks the end of `#version 3.7`, where POV-Ray only warns of a possible mistake.
    pub(super) fn end_of_version(&mut self, here: &Here, version: ExpressionId) {
        let span = here.unit.expression(version).span;
        let behind = self.sources.get(span.file).text.get(span.end as usize..).unwrap_or("");
        let ends = behind.trim_start_matches([' ', '\t']).starts_with(['\n', '\r']);
        if !ends || self.is_before(SINCE) || !self.in_main() || self.options.dialect != Dialect::Pov
        {
            return;
        }
        let place = span.after();
        let diagnostic = Diagnostic::new(Code::Semicolon, "`#version` ends with `;`")
            .at(self.sources.sign_before(place), "expected `;` after this")
            .help("POV-Ray warns of it")
            .fix(place, ";");
        self.report(here, diagnostic);
    }

    /// Consumes a `;` where a comma is meant, before a value or a function: `sphere { <0, 0, 0>; 1 }`.
    pub(super) fn semicolon_for_comma(&mut self) {
        let Some(Token { kind: TokenKind::Semicolon, here, span }) = self.peek().cloned() else {
            return;
        };
        let text = &self.sources.get(span.file).text;
        let behind = text.get(span.end as usize..).unwrap_or("").trim_start();
        let end = behind.find(|c: char| !c.is_ascii_alphanumeric() && c != '_');
        let is_part = match &behind[..end.unwrap_or(behind.len())] {
            "" => behind.starts_with(['<', '-', '+', '.', '(']),
            "rgb" | "srgb" | "rgbf" | "rgbt" | "rgbft" | "color" | "colour" => true,
            name => Word::from_name(name)
                .is_none_or(|word| word.role() != Role::Statement || word == Word::Function),
        };
        if !is_part {
            return;
        }
        self.next();
        let diagnostic =
            Diagnostic::new(Code::UnexpectedCharacter, "commas part the values of a block")
                .at(span, "expected `,`")
                .help("replace the `;` with `,`")
                .fix(span, ",");
        self.report(&here, diagnostic);
    }

    /// Reports a `;` that ends no declaration.
    pub(super) fn warn_of_semicolon(&mut self, token: &Token, place: Place) {
        if self.options.dialect == Dialect::Scene {
            return;
        }
        // A row of them is one mistake; and one behind a declaration is its own, or that has another.
        let text = &self.sources.get(token.span.file).text;
        let before = text.get(..token.span.start as usize).unwrap_or("").trim_end();
        let statement = before.rsplit([';', '{', '}']).next().unwrap_or("");
        if before.ends_with(';') || ends_with_one(statement) {
            return;
        }
        let behind = text.get(token.span.end as usize..).unwrap_or("");
        let more = behind.len() - behind.trim_start_matches(';').len();
        let row = Span { end: token.span.end + more as u32, ..token.span };
        let diagnostic =
            Diagnostic::new(Code::Semicolon, format!("`;` has no meaning {}", place.name()))
                .at(token.span, "only a declaration ends with one")
                .help("leave it out: POV-Ray refuses it")
                .fix(row, "");
        // What was told of the statement itself is told: it may be another language's.
        let start = (before.len() - statement.len()) as u32;
        self.warn_in_statement(token, start, diagnostic);
    }

    /// Reports a comma that separates no values.
    pub(super) fn warn_of_comma(&mut self, token: &Token, place: Place) {
        if self.options.dialect == Dialect::Scene || self.poison.is_some() {
            return;
        }
        let text = &self.sources.get(token.span.file).text;
        let before = text.get(..token.span.start as usize).unwrap_or("").trim_end();
        let meant_as_comma = self.sources.text(token.span) != ",";
        if meant_as_comma || before.ends_with([',', ';', '{']) {
            return;
        }
        let diagnostic =
            Diagnostic::new(Code::Comma, format!("this `,` has no meaning {}", place.name()))
                .at(token.span, "commas part values, not words or objects")
                .help("leave it out: POV-Ray refuses it")
                .fix(token.span, "");
        let statement = before.rsplit(['\n', '{']).next().unwrap_or("");
        let start = (before.len() - statement.len()) as u32;
        // A value after it is a mistake of its own.
        let value =
            |next: &Token| matches!(next.kind, TokenKind::Expression(_) | TokenKind::Literal(_));
        if !self.peek_on().is_some_and(value) {
            self.warn_in_statement(token, start, diagnostic);
        }
    }

    /// Reports the diagnostic, unless one was reported in the statement that begins at `start`.
    fn warn_in_statement(&mut self, token: &Token, start: u32, diagnostic: Diagnostic) {
        let of_statement = |span: Span| {
            span.file == token.span.file && (start..token.span.start).contains(&span.start)
        };
        let told = |one: &Diagnostic| {
            one.code != diagnostic.code
                && one.primary().is_some_and(|primary| of_statement(primary.span))
        };
        if !self.repeats(&diagnostic) && !self.diagnostics.iter().any(told) {
            self.report(&token.here, diagnostic);
        }
    }
}

/// Returns whether a statement's own directive ends with a `;`, or is none of the language's.
fn ends_with_one(statement: &str) -> bool {
    let Some((_, directive)) = statement.rsplit_once('#') else { return false };
    let word = directive.trim_start().split(|c: char| !c.is_ascii_alphabetic()).next();
    let known = word.and_then(Word::from_name).filter(|word| word.family() == Family::Directive);
    !known.is_some_and(|word| !matches!(word, Word::Declare | Word::Local))
}

/// The language version from which a declared number needs its `;`.
const SINCE: f64 = 3.5;
