//! Diagnostics for calls with too few or too many arguments.

use std::ops::RangeInclusive;

use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::syntax::ast::Argument;
use crate::vocabulary::Word;

use super::report::count;
use super::{Evaluator, Here, Reported};

/// Returns the span of the surplus arguments.
pub(super) fn surplus(here: &Here, more: &[Argument]) -> Option<Span> {
    let place = |argument: &Argument| match argument {
        Argument::Expression(id) => Some(here.unit.expression(*id).span),
        Argument::Items(items) => {
            let items = here.unit.ast.items(*items);
            Some(items.first()?.span.to(items.last()?.span))
        }
    };
    Some(place(more.first()?)?.to(place(more.last()?)?))
}

impl Evaluator<'_> {
    /// Returns the closing bracket of a call, a vector or an array, where a missing argument belongs, or the
    /// whole span if it does not end with a bracket.
    pub(super) fn end_of_call(&self, span: Span) -> Span {
        if self.sources.text(span).ends_with([')', '>', '}']) {
            return Span { start: span.end - 1, ..span };
        }
        // Only the name of the called function.
        let text = &self.sources.get(span.file).text;
        let behind = text.get(span.end as usize..).unwrap_or("");
        let (mut depth, mut quoted) = (0, false);
        for (at, sign) in behind.char_indices() {
            match sign {
                '"' => quoted = !quoted,
                '(' if !quoted => depth += 1,
                ')' if !quoted && depth == 1 => {
                    let start = span.end + at as u32;
                    return Span { start, end: start + 1, ..span };
                }
                ')' if !quoted => depth -= 1,
                _ if depth == 0 && !sign.is_whitespace() => break,
                _ => {}
            }
        }
        span
    }

    /// Returns where an empty argument belongs: the comma or bracket before which it is missing.
    pub(super) fn empty_argument(
        &self,
        here: &Here,
        list: &[Argument],
        empty: usize,
        call: Span,
    ) -> Span {
        if empty + 1 == list.len() {
            return self.end_of_call(call);
        }
        let before = empty.checked_sub(1).map(|before| surplus(here, &list[before..empty]));
        let text = self.sources.text(call);
        let from = match before {
            Some(Some(before)) if before.start >= call.start => (before.end - call.start) as usize,
            Some(_) => return call,
            None => text.find('(').unwrap_or(0),
        };
        // The comma of this argument, after the one that ends the argument before it.
        let mut commas = text.get(from..).unwrap_or("").match_indices(',');
        match commas.nth(usize::from(before.is_some())) {
            Some((at, _)) => {
                let start = call.start + (from + at) as u32;
                Span { start, end: start + 1, ..call }
            }
            None => call,
        }
    }

    /// Returns whether the macro whose name is defined here gives a parameter a default value, as other
    /// languages do.
    pub(super) fn has_default(&self, name: Span) -> bool {
        let behind = self.sources.get(name.file).text.get(name.end as usize..).unwrap_or("");
        let parameters = behind.split(')').next().unwrap_or("");
        parameters.trim_start().starts_with('(') && parameters.contains('=')
    }

    pub(super) fn wrong_arity(
        &mut self,
        here: &Here,
        word: Word,
        span: Span,
        arity: RangeInclusive<usize>,
        (found, list): (usize, &[Argument]),
    ) -> Reported {
        let diagnostic = Diagnostic::new(
            Code::WrongArity,
            format!("`{}` takes {}, and is given {found}", word.name(), count(&arity, "argument")),
        )
        .at(
            match list.get(*arity.end()..).and_then(|more| surplus(here, more)) {
                Some(more) => more,
                None if found < *arity.start() => self.end_of_call(span),
                None => span,
            },
            format!("expected {}", count(&arity, "argument")),
        );
        let diagnostic = match word {
            Word::Rand => diagnostic
                .help("it takes a stream: `#declare R = seed(1);` once, and then `rand(R)`"),
            Word::DimensionSize if found == 1 => diagnostic
                .help("which dimension comes second: `dimension_size(A, 1)` is how many elements"),
            Word::Str if found == 1 => {
                let inside = Span { start: span.start, end: self.end_of_call(span).start, ..span };
                let asked = self.sources.text(inside).split_once('(').map(|(_, rest)| rest.trim());
                let asked = asked.filter(|asked| !asked.contains('\n'));
                diagnostic.help(format!(
                    "how wide and how many digits: `str({}, 0, 3)` has three behind the point",
                    asked.unwrap_or("A")
                ))
            }
            Word::Vlength if found == 2 => diagnostic
                .help("how far two points are apart: `vlength(A - B)`")
                .help(word.sentence()),
            // `vlength(1, 2, 3)`
            _ if *arity.end() == 1 && found == 3 && word.sentence().contains("(v)") => diagnostic
                .help(format!("a vector has angles: `{}(<1, 2, 3>)`", word.name()))
                .help(word.sentence()),
            _ => diagnostic.help(word.sentence()),
        };
        self.report(here, diagnostic)
    }
}
