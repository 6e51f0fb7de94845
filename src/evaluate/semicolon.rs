//! Semicolons: in a `.pov` file one ends the declaration of a number, and nothing else has one.
//!
//! **Source:** measured: POV-Ray refuses a declared number, vector or colour without its `;` from version 3.5
//! on, takes a second `;` there, and refuses every other one.

use crate::diagnostic::{Code, Diagnostic};
use crate::source::{Site, Span};
use crate::syntax::ast::ItemKind;
use crate::vocabulary::Dialect;

use super::Evaluator;
use super::block::Place;
use super::stream::{Token, TokenKind};
use super::value::Value;

impl Evaluator<'_> {
    /// Takes the `;` behind the value of a `#declare`, which a number has to have.
    pub(super) fn end_of_declaration(&mut self, head: Span, value: Option<&Value>) {
        // `#define A 1`, `int A = 1`: told as that.
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
        // What else stands behind the value is a mistake of its own.
        let ends = matches!(
            self.peek_on().map(|token| &token.kind),
            None | Some(TokenKind::Word(_) | TokenKind::Block(_))
        );
        let needed = self.options.dialect == Dialect::Pov && self.version >= SINCE;
        // The last word of a macro stands elsewhere.
        let is_here = |last: &Site| last.span.file == head.file && last.span.start >= head.start;
        let wanted = numeric && ends && needed;
        let Some(last) = last.filter(|last| wanted && is_here(last)) else { return };
        let place = last.span.after();
        let diagnostic = Diagnostic::new(Code::Semicolon, "a declared number ends with `;`")
            .at(place, "expected `;` here")
            .help("POV-Ray refuses it without")
            .fix(place, ";");
        // It may be told as an old form.
        let told = |one: &Diagnostic| {
            one.code == Code::LegacyForm && one.fixes.iter().any(|fix| fix.span == place)
        };
        if self.repeats(&diagnostic) || self.diagnostics.iter().any(told) {
            return;
        }
        self.report_in(last.expansion, diagnostic);
    }

    /// A `;` that ends no declaration.
    pub(super) fn warn_of_semicolon(&mut self, token: &Token, place: Place) {
        if self.options.dialect == Dialect::Scene {
            return;
        }
        // A row of them is one mistake; and one behind a directive is that of `#version`, or has another.
        let text = &self.sources.get(token.span.file).text;
        let before = text.get(..token.span.start as usize).unwrap_or("").trim_end();
        let statement = before.rsplit([';', '{', '}']).next().unwrap_or("");
        if before.ends_with(';') || statement.contains('#') {
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
        let of_statement = |span: Span| {
            span.file == token.span.file && (start..token.span.start).contains(&span.start)
        };
        if self.repeats(&diagnostic)
            || (self.diagnostics.iter())
                .any(|one| one.primary().is_some_and(|at| of_statement(at.span)))
        {
            return;
        }
        self.report(&token.here, diagnostic);
    }
}

/// The version of the language from which on a declared number needs its `;`.
const SINCE: f64 = 3.5;
