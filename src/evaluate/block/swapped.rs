//! Diagnostics for two parts, or two arguments of a call, that are swapped.

use crate::diagnostic::{Code, Diagnostic};
use crate::source::{Site, Span};

use super::super::{Evaluator, Reported};

impl Evaluator<'_> {
    /// Reports two swapped parts, or two swapped arguments of a call that are used elsewhere.
    pub(super) fn swapped(
        &mut self,
        a: Site,
        b: Site,
        first: &str,
        second: &str,
        used: Option<Span>,
    ) -> Reported {
        let message = format!("expected {first}, then {second}: the two are swapped");
        let text = |site: Site| self.sources.text(site.span).to_owned();
        let (text_a, text_b) = (text(a), text(b));
        let mut diagnostic = Diagnostic::new(Code::WrongType, message)
            .at(a.span, format!("expected {first}"))
            .also(b.span, format!("expected {second}"))
            .help(format!("write `{text_b}, {text_a}`"));
        if let Some(used) = used {
            diagnostic = diagnostic.also(used, "used here");
        }
        let in_order = a.span.file == b.span.file && a.span.end <= b.span.start;
        if a.expansion == b.expansion && in_order {
            let between =
                self.sources.text(Span { start: a.span.end, end: b.span.start, ..a.span });
            diagnostic = match between.trim() {
                "" | "," => diagnostic.fix(a.span.to(b.span), format!("{text_b}, {text_a}")),
                _ => diagnostic.fix(a.span, text_b).fix(b.span, text_a),
            };
        }
        self.report_in(a.expansion, diagnostic)
    }
}
