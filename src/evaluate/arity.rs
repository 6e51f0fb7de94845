//! What to say of a call with too few or too many arguments.

use std::ops::RangeInclusive;

use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::vocabulary::Word;

use super::report::count;
use super::{Evaluator, Here, Reported};

impl Evaluator<'_> {
    /// The bracket that closes a call, a vector or an array, where what is missing belongs; all of it where it does not
    /// end with one.
    pub(super) fn end_of_call(&self, span: Span) -> Span {
        if self.sources.text(span).ends_with([')', '>', '}']) {
            return Span { start: span.end - 1, ..span };
        }
        // The name alone of what is called.
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

    /// The first argument of a call, or component of a vector, that is one too many; each up to its comma.
    pub(super) fn first_extra(&self, span: Span, most: usize) -> Option<Span> {
        let end = self.end_of_call(span);
        let whole = Span { end: end.end, ..span };
        let text = self.sources.text(whole);
        let is_vector = text.starts_with('<');
        let open = if is_vector { 0 } else { text.find('(')? };
        let inside = text.get(open + 1..text.len().checked_sub(1)?)?;
        let (mut depth, mut quoted, mut commas) = (0, false, 0);
        for (at, sign) in inside.char_indices() {
            match sign {
                '"' => quoted = !quoted,
                '(' | '[' | '<' if !quoted => depth += 1,
                ')' | ']' | '>' if !quoted => depth -= 1,
                ',' if !quoted && depth == 0 => commas += 1,
                _ if commas == most && !sign.is_whitespace() => {
                    let rest = &inside[at..];
                    let length = rest.find([',', ')', '>']).unwrap_or(rest.len());
                    let length = rest[..length].trim_end().len();
                    let start = whole.start + (open + 1 + at) as u32;
                    return Some(Span { start, end: start + length as u32, ..span });
                }
                _ => {}
            }
        }
        None
    }

    pub(super) fn wrong_arity(
        &mut self,
        here: &Here,
        word: Word,
        span: Span,
        arity: RangeInclusive<usize>,
        found: usize,
    ) -> Reported {
        let diagnostic = Diagnostic::new(
            Code::WrongArity,
            format!("`{}` takes {}, and is given {found}", word.name(), count(&arity, "argument")),
        )
        .at(
            match found < *arity.start() {
                true => self.end_of_call(span),
                false => self.first_extra(span, *arity.end()).unwrap_or(span),
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
