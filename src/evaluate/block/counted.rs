//! Diagnostics for lists that begin with their length: a missing count, missing brackets around the entries,
//! or an entry with too many components.
//!
//! **Invariant:** there is one message for a list, however many of its entries have the mistake.

use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::syntax::ast::ExpressionKind;
use crate::vocabulary::Word;

use super::super::stream::{Token, TokenKind};
use super::super::value::Value;
use super::super::{Evaluator, Reported};
use super::Given;

/// Maximum number of entries without brackets that a message rewrites.
const MOST_WRITTEN: usize = 12;

impl Evaluator<'_> {
    /// Reports points without their count, which belongs right after `before`: `vertex_vectors { <0, 0, 0>,
    /// <1, 0, 0> }`, `lathe { linear_spline <0, 0>, <1, 0> }`.
    pub(super) fn uncounted(
        &mut self,
        before: &str,
        label: String,
        many: &str,
    ) -> Option<Reported> {
        let first = self.peek()?.clone();
        let TokenKind::Expression(id) = first.kind else { return None };
        if !matches!(
            first.here.unit.expression(id).kind,
            ExpressionKind::Vector(_) | ExpressionKind::Triple(_)
        ) {
            return None;
        }
        let message = format!("expected {many}, found a vector");
        let told = Diagnostic::new(Code::WrongType, message).at(first.span, label);
        let told = match self.entries_from(first.span) {
            Some(rest) => {
                let count = rest.matches('<').count();
                told.help(format!("write `{before}{count}, …`"))
                    .fix(Span { end: first.span.start, ..first.span }, format!("{count}, "))
            }
            None => told,
        };
        let reported = self.report(&first.here, told);
        self.skip_values();
        Some(reported)
    }

    /// Returns the announced number of entries, truncated and clamped to 32 bits. Warns of a fraction.
    pub(super) fn counted(&mut self, count: &Given<f64>) -> usize {
        self.lint_count(&count.here, count.span, count.value);
        count.value as u32 as usize
    }

    /// Returns the literal numbers and vectors from `first` on, up to a word or the end of their block.
    /// Returns `None` if they contain anything else, since the items that directives produce cannot be
    /// counted here.
    fn entries_from(&self, first: Span) -> Option<&str> {
        let block = self.within_block()?.span;
        if !block.contains(first) || first.end < first.start {
            return None;
        }
        let rest = self.sources.text(Span { start: first.start, ..block });
        let plain = |c: char| {
            c.is_ascii_digit() || c.is_whitespace() || ".,<>+-*eE".contains(c) || "xyz".contains(c)
        };
        let length = rest.find(|c| !plain(c)).unwrap_or(rest.len());
        // Up to the word that ends them.
        let entries = rest[..length].trim_end_matches(|c: char| c.is_ascii_alphabetic());
        let ended = rest[entries.len()..].chars().next().is_none_or(|c| c.is_ascii_lowercase());
        let parted = entries.len() == rest.len() || entries.ends_with([' ', '\t', '\r', '\n', '>']);
        (ended && parted).then_some(entries)
    }

    /// Handles bare numbers after `count` that are exactly enough for that many entries of `width`:
    /// `face_indices { 2, 0,1,2, 0,2,3 }`.
    pub(super) fn bare_entries(
        &mut self,
        entry: &str,
        width: usize,
        count: &Given<f64>,
    ) -> Option<Reported> {
        let wanted =
            (count.value as u32 as usize).checked_mul(width).filter(|wanted| *wanted > 0)?;
        // Most have their brackets, and may be megabytes long.
        let behind = self.sources.get(count.span.file).text.get(count.span.end as usize..)?;
        if behind.trim_start_matches(|c: char| c == ',' || c.is_whitespace()).starts_with('<') {
            return None;
        }
        let start = count.span.start;
        let rest = self.entries_from(Span { end: start, ..count.span })?;
        let numbers: Vec<(usize, &str)> = parted(rest).collect();
        // The heights of a prism precede its count, in one piece with it.
        let before = numbers.len().checked_sub(wanted + 1).filter(|before| *before < 3)?;
        let is_count = numbers[before].1.parse() == Ok(count.value);
        if !is_count || !numbers.iter().all(|(_, number)| number.parse::<f64>().is_ok()) {
            return None;
        }
        let numbers = &numbers[before + 1..];
        let (first, last) = (numbers.first()?, numbers.last()?);
        let whole = Span {
            start: start + first.0 as u32,
            end: start + (last.0 + last.1.len()) as u32,
            ..count.span
        };
        let numbers: Vec<&str> = numbers.iter().map(|(_, number)| *number).collect();
        let written = |entry: &[&str]| format!("<{}>", entry.join(", "));
        let message = format!("{entry} is {width} numbers in angle brackets");
        let told = Diagnostic::new(Code::WrongType, message)
            .at(whole, format!("did you mean `{}`?", written(&numbers[..width])));
        let told = match numbers.len() <= width * MOST_WRITTEN {
            true => {
                let all: Vec<String> = numbers.chunks(width).map(written).collect();
                told.fix(whole, all.join(", "))
            }
            false => told,
        };
        let reported = self.report(&count.here, told);
        self.skip_values();
        Some(reported)
    }

    /// For points written as literal numbers, one of which exceeds their count, returns the count's span and
    /// the actual number.
    pub(super) fn count_before(&self, extra: Span) -> Option<(Span, usize)> {
        let block = self.within_block()?.span;
        if !block.contains(extra) {
            return None;
        }
        let before = self.sources.text(Span { end: extra.start, ..block });
        let head = before.split('<').next()?;
        let plain = |c: char| c.is_ascii_digit() || c.is_whitespace() || ".,<>+-".contains(c);
        let (points, rest) =
            (&before[head.len()..], self.sources.text(Span { start: extra.start, ..block }));
        let more = rest.split(|c: char| !plain(c)).next()?;
        let digits = head.trim_end_matches(|c: char| c.is_whitespace() || c == ',');
        let stem = digits.trim_end_matches(|c: char| c.is_ascii_digit());
        let is_count =
            stem.len() < digits.len() && stem.ends_with([' ', '\t', '\n', '\r', ',', '{']);
        if !is_count || !points.chars().all(plain) {
            return None;
        }
        let start = block.start + stem.len() as u32;
        let count = Span { start, end: block.start + digits.len() as u32, ..block };
        Some((count, points.matches('<').count() + more.matches('<').count()))
    }

    /// Reports a vector with more components than the `width` of its list; `what` names an entry.
    pub(super) fn too_wide(
        &mut self,
        given: &Given<Value>,
        list: Word,
        what: &str,
        width: usize,
    ) -> Reported {
        let found = given.value.numbers().map_or(0, |numbers| numbers.as_slice().len());
        let has = if width == 2 { "two numbers" } else { "three numbers" };
        let message = format!("{what} has {has}, and this one has {found}");
        let told =
            Diagnostic::new(Code::WrongArity, message).at(given.span, format!("expected {has}"));
        let text = self.sources.text(given.span);
        let parts: Vec<&str> = text.trim_matches(['<', '>']).split(',').map(str::trim).collect();
        let told = match (list, parts.as_slice()) {
            (Word::FaceIndices, [a, b, c, d]) => told.help(format!(
                "write two triangles: `<{a}, {b}, {c}>, <{a}, {c}, {d}>`, and count both"
            )),
            (_, [a, b, _, _]) if width == 3 && is_whole(a) && is_whole(b) => {
                told.help(format!("a fraction is written with a point: `{a}.{b}`, not `{a},{b}`"))
            }
            _ => told,
        };
        let told = match width {
            2 => self.flattened(given.span, list).into_iter().fold(told, |told, (span, right)| {
                let told = match told.help.is_empty() {
                    true => told.help(format!("write `{right}`")),
                    false => told,
                };
                told.fix(span, right)
            }),
            _ => told,
        };
        self.report(&given.here, told)
    }

    /// For points of three components where two are expected, returns each one from `first` on without the
    /// component that is 0 in all of them.
    fn flattened(&self, first: Span, list: Word) -> Vec<(Span, String)> {
        let Some(rest) = self.entries_from(first) else { return Vec::new() };
        let mut points: Vec<(Span, Vec<&str>)> = Vec::new();
        let mut at = 0;
        while let Some(open) = rest[at..].find('<').map(|open| at + open) {
            let Some(close) = rest[open..].find('>').map(|close| open + close) else {
                return Vec::new();
            };
            let place = |offset: usize| first.start + offset as u32;
            let span = Span { start: place(open), end: place(close + 1), ..first };
            points.push((span, rest[open + 1..close].split(',').map(str::trim).collect()));
            at = close;
        }
        let is_zero = |part: &str| part.parse::<f64>() == Ok(0.0);
        let flat =
            |axis: usize| points.iter().all(|(_, parts)| parts.len() == 3 && is_zero(parts[axis]));
        // A prism is based on the xz plane; a lathe's profile is in the xy plane.
        let axis = match list {
            Word::Prism if flat(1) => 1,
            _ if flat(2) => 2,
            _ => return Vec::new(),
        };
        let without =
            |parts: &[&str]| format!("<{}, {}>", parts[0], parts[if axis == 1 { 2 } else { 1 }]);
        points.iter().map(|(span, parts)| (*span, without(parts))).collect()
    }

    /// Reports a spline kind that `shape` does not have, or that follows its `count`: `lathe { 4,
    /// linear_spline … }`, `sor { linear_spline 4, … }`, `lathe { b_spline … }`.
    pub(super) fn misplaced_spline(
        &mut self,
        shape: Word,
        count: Option<Span>,
    ) -> Option<Reported> {
        let behind = |count: Span| {
            let text = self.sources.get(count.file).text.get(count.end as usize..).unwrap_or("");
            text.strip_prefix(',')
                .unwrap_or("")
                .trim_start()
                .starts_with(|c: char| c.is_alphabetic())
        };
        if count.is_some_and(behind) {
            self.skip_comma();
        }
        let next = self.peek()?.clone();
        let TokenKind::Word(kind) = next.kind else { return None };
        let (name, of) = (kind.name(), shape.name());
        if !name.ends_with("_spline") {
            return None;
        }
        let told = match count {
            Some(count) if shape != Word::Sor => {
                let gap = Span { start: count.end, end: next.span.start, ..count };
                let told = Diagnostic::new(
                    Code::MisplacedBlock,
                    format!("`{name}` stands before the number of points"),
                )
                .at(next.span, "this stands too late")
                .also(count, "it belongs before this");
                let right = format!("{name} {}", self.sources.text(count));
                match gap.file == next.span.file && shape == Word::Lathe {
                    true => told
                        .help(format!("write `{right}, …`"))
                        .fix(count, right)
                        .fix(next.span, ""),
                    false => told,
                }
            }
            _ if shape == Word::Sor => Diagnostic::new(
                Code::ExtraPart,
                "a `sor` has one kind of curve, and no word for it",
            )
            .at(next.span, "leave this out")
            .help("a `lathe` has several")
            .fix(next.span, ""),
            _ => Diagnostic::new(Code::UnknownWord, format!("a `{of}` has no `{name}`"))
                .at(next.span, "another kind of curve")
                .help("`linear_spline`, `quadratic_spline`, `cubic_spline` or `bezier_spline`"),
        };
        let reported = self.report(&next.here, told);
        self.next();
        self.skip_values();
        Some(reported)
    }

    /// Reports a single height, with the count in the place of the other: `prism { 0, 5, <…>, … }`.
    pub(super) fn lone_height(&mut self, prism: &Token, count: Span) -> Option<Reported> {
        self.skip_commas();
        let next = self.peek().cloned()?;
        if !self.sources.text(next.span).starts_with('<') {
            return None;
        }
        let message = "expected two heights and a count before the points of a `prism`";
        let told = Diagnostic::new(Code::MissingPart, message)
            .at(next.span, "expected a number for how many points follow")
            .also(count, "read as the second height")
            .also(prism.span, "for this")
            .help("is a height missing? `prism { low, high, count, <points> }`");
        let reported = self.report(&next.here, told);
        self.skip_values();
        Some(reported)
    }
}

fn is_whole(part: &str) -> bool {
    !part.is_empty() && part.trim_start_matches('-').bytes().all(|b| b.is_ascii_digit())
}

/// Returns the description of an entry in a list of a `mesh2`.
pub(super) fn entry_of(list: Word) -> &'static str {
    match list {
        Word::VertexVectors => "a vertex",
        Word::NormalVectors => "a normal",
        Word::UvVectors => "a place in a texture",
        _ => "a face",
    }
}

/// Splits a text at commas and blanks; returns each part with its offset.
fn parted(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let parts = text.split([',', ' ', '\t', '\r', '\n']);
    let placed = parts.scan(0, |at, part| {
        let begin = *at;
        *at += part.len() + 1;
        Some((begin, part))
    });
    placed.filter(|(_, part)| !part.is_empty())
}
