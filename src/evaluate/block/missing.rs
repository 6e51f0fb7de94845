//! Diagnostics for missing parts, with the position where they belong.

use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::syntax::ast::{Item, ItemKind};
use crate::vocabulary::{Family, Role, Word};

use super::super::stream::{Token, TokenKind};
use super::super::{Evaluator, Reported};
use super::opens_object;

impl Evaluator<'_> {
    /// Reports missing parentheses: `seed 99`.
    pub(super) fn lacks_parentheses(&mut self, token: &Token, word: Word) -> Reported {
        let name = word.name();
        let message = format!("`{name}` takes its arguments in parentheses");
        let diagnostic = Diagnostic::new(Code::ExpectedExpression, message)
            .at(token.span, format!("expected `(` after `{name}`"));
        let value = match self.peek() {
            Some(&Token { kind: TokenKind::Expression(_), span, .. }) => Some(span),
            _ => None,
        };
        let diagnostic = match value {
            Some(value) => {
                let right = format!("{name}({})", self.sources.text(value));
                diagnostic.help(format!("write `{right}`")).fix(token.span.to(value), right)
            }
            None => diagnostic.help(word.sentence()),
        };
        let reported = self.report(&token.here, diagnostic);
        self.skip_arguments(word);
        reported
    }

    /// Reports that `next` appears where `wanted`, which belongs to `after`, is expected.
    pub(super) fn missing(
        &mut self,
        after: &Token,
        next: Option<&Token>,
        wanted: &str,
    ) -> Diagnostic {
        let message = format!("expected {wanted} after {}", self.describe(after));
        let (code, place) = (Code::MissingPart, self.end_of_parts(after));
        let lost = place.and_then(|end| self.lost_comma(Span { start: after.span.end, ..end }));
        let diagnostic = match (next, place, &lost) {
            (Some(found), _, Some((value, _))) => {
                let text = self.sources.text(*value);
                let sign = text.find(" -").or(text.find(".-")).map_or(0, |at| at as u32 + 1);
                let sign = Span { start: value.start + sign, ..*value };
                Diagnostic::new(code, format!("{message}, found {}", self.describe(found)))
                    .at(Span { end: sign.start + 1, ..sign }, "is a comma missing before this?")
                    .also(found.span_head(), format!("expected {wanted}"))
                    .also(after.span, "for this")
            }
            // The missing part belongs at the end of the line before.
            (Some(found), Some(end), None) if self.is_on_a_later_line(found, end) => {
                Diagnostic::new(code, format!("{message}, found {}", self.describe(found)))
                    .at(self.sources.sign_before(end), format!("expected {wanted} after this"))
                    .also(after.span, "for this")
            }
            (Some(found), _, None) => {
                Diagnostic::new(code, format!("{message}, found {}", self.describe(found)))
                    .at(found.span_head(), format!("expected {wanted}"))
                    .also(after.span, "for this")
            }
            (None, Some(end), _) => Diagnostic::new(code, message)
                .at(self.sources.sign_before(end), format!("expected {wanted} after this"))
                .also(after.span, "for this"),
            (None, None, _) => Diagnostic::new(code, message)
                .at(after.span, format!("{wanted} is missing after this")),
        };
        let diagnostic = match after.kind {
            TokenKind::Word(word) => diagnostic.help(self.form_of(word)),
            _ => diagnostic,
        };
        let diagnostic = match self.announced.take() {
            Some((count, found)) if found > 0 && count.file == after.span.file => {
                let text = self.sources.text(count).to_owned();
                let help = format!("if these are all, write `{found}` instead of `{text}`");
                let follow = if found == 1 { "follows" } else { "follow" };
                diagnostic
                    .also(count, format!("{text} are announced, and {found} {follow}"))
                    .help(help)
            }
            _ => diagnostic,
        };
        // `cylinder { <0, 1, 0>, 0.5 }`: the number was read as a point.
        let number = self.taken.map(|taken| self.sources.text(taken.span));
        let number = number.filter(|text| text.parse::<f64>().is_ok());
        let diagnostic = match number {
            Some(number)
                if after.kind == TokenKind::Word(Word::Cylinder)
                    && place.is_some()
                    && wanted.contains("radius") =>
            {
                diagnostic.help(format!(
                    "`{number}` was read as the middle of the cap: is a point missing before it?"
                ))
            }
            Some(number) if after.kind == TokenKind::Word(Word::Disc) && place.is_some() => {
                diagnostic.help(format!(
                    "`{number}` was read as the normal: is a vector missing before it?"
                ))
            }
            Some(number) if after.kind == TokenKind::Word(Word::Quadric) && place.is_some() => {
                diagnostic
                    .help(format!("`{number}` was read as a vector: is one missing before it?"))
            }
            _ => diagnostic,
        };
        let diagnostic = match lost {
            Some((value, parted)) => diagnostic.help(format!(
                "`{}` is one value, and `{parted}` are two: is a comma missing?",
                self.sources.text(value)
            )),
            None => diagnostic,
        };
        self.meant_by_word(diagnostic, next, wanted)
    }

    /// Reports a modifier at `next` before the parts of `after`, one of which is `wanted`: `sphere { pigment
    /// { rgb 1 } 0, 1 }`.
    pub(super) fn late_parts(
        &mut self,
        after: &Token,
        next: &Token,
        wanted: &str,
    ) -> Option<Reported> {
        let (TokenKind::Word(solid), TokenKind::Word(modifier)) = (&after.kind, &next.kind) else {
            return None;
        };
        let is_modifier = matches!(modifier.family(), Family::Texture | Family::Modifier)
            || matches!(modifier, Word::Interior | Word::Material);
        if !is_modifier || !opens_object(*solid) {
            return None;
        }
        let parts = self.values_behind_block().filter(|parts| parts.file == next.span.file)?;
        let (name, word) = (solid.name(), modifier.name());
        let message = format!("the parts of `{name}` stand before its `{word}`");
        let right = self.sources.text(parts).to_owned();
        let diagnostic = Diagnostic::new(Code::MisplacedBlock, message)
            .at(next.span, format!("expected {wanted}"))
            .also(parts, "this stands too late")
            .help(format!("move `{right}` before `{word}`"))
            .fix(Span { end: next.span.start, ..next.span }, format!("{right} "))
            .fix(parts, "");
        let reported = self.report(&next.here, diagnostic);
        // A part that comes too late is reported.
        self.missing_at = Some(after.here.site(next.span));
        Some(reported)
    }

    /// Returns whether a part of the block being read was reported missing.
    pub(super) fn lacks_part(&self) -> bool {
        let Some(block) = self.blocks.last().map(|block| block.span) else { return false };
        self.missing_at.is_some_and(|at| {
            at.span.file == block.file && block.start <= at.span.start && at.span.end <= block.end
        })
    }

    /// Returns the span of the values right after a block among the following items.
    fn values_behind_block(&self) -> Option<Span> {
        let frame = self.frames.last()?;
        let ast = &frame.here.unit.ast;
        let items = ast.items.get(frame.at as usize..frame.end as usize)?;
        let is_value = |item: &&Item| matches!(item.kind, ItemKind::Expression(_));
        let is_comma = |item: &&Item| matches!(item.kind, ItemKind::Comma);
        let blocks =
            items.iter().zip(1..).filter(|(item, _)| matches!(item.kind, ItemKind::Block(_)));
        let (first, behind) = blocks.into_iter().find_map(|(_, next)| {
            let behind = items.get(next..)?;
            let first = behind.iter().find(|item| !is_comma(item)).filter(is_value)?;
            Some((first, behind))
        })?;
        let count = behind.iter().take_while(|item| is_value(item) || is_comma(item)).count();
        let (parts, rest) = behind.split_at_checked(count)?;
        // `fnish { … }` is a misspelt word.
        if matches!(rest.first(), Some(Item { kind: ItemKind::Block(_), .. })) {
            return None;
        }
        let last = parts.iter().rfind(is_value)?;
        Some(first.span.to(last.span))
    }

    /// Reports a comma right after the word whose value is missing: `green ,5`.
    pub(super) fn comma_for_value(&mut self, after: &Token, wanted: &str) -> Option<Reported> {
        let comma = self.peek()?.clone();
        let behind = Span { start: after.span.end, end: comma.span.start, ..after.span };
        let is_beside = matches!(after.kind, TokenKind::Word(_))
            && comma.span.file == after.span.file
            && after.span.end <= comma.span.start
            && self.sources.text(behind).trim().is_empty();
        if !is_beside {
            return None;
        }
        let message = format!("expected {wanted} after {}, found `,`", self.describe(after));
        let mut diagnostic = Diagnostic::new(Code::MissingPart, message)
            .at(comma.span, format!("expected {wanted}"))
            .also(after.span, "for this");
        let text = &self.sources.get(comma.span.file).text;
        let rest = text.get(comma.span.end as usize..).unwrap_or("");
        if rest.starts_with(|c: char| c.is_ascii_digit()) {
            diagnostic =
                diagnostic.help("a fraction is written with a point: `.5`").fix(comma.span, "0.");
        }
        let reported = self.report(&after.here, diagnostic);
        self.skip_values();
        Some(reported)
    }

    /// Splits parts such as `Base() -x`, where a sign without a blank after it probably begins a new value;
    /// returns the span and the text with a comma.
    pub(in crate::evaluate) fn lost_comma(&self, parts: Span) -> Option<(Span, String)> {
        let text = self.sources.text(parts);
        let of_name = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '.');
        let signs = text.match_indices(" -").chain(text.match_indices(".-"));
        signs.into_iter().find_map(|(at, sign)| {
            let (before, behind) = (text[..at].trim_end(), &text[at + 2..]);
            // `1.-5`, for `1,-5`: digits around it, and no other point.
            let is_digit = |c: char| c.is_ascii_digit();
            let number = before.trim_end_matches(is_digit);
            let is_point = number.len() < before.len()
                && !number.ends_with(|c: char| of_name(c))
                && behind.starts_with(is_digit);
            if sign == ".-" && !is_point {
                return None;
            }
            // A word with a block is not a value.
            let last = before.trim_end_matches(of_name).len();
            let is_value =
                Word::from_name(&before[last..]).is_none_or(|word| word.role() != Role::Statement);
            let ends = before.ends_with(|c: char| of_name(c) || matches!(c, ')' | '>'));
            let begins = behind.starts_with(|c: char| of_name(c) || matches!(c, '(' | '<'));
            // Of `Base()` and `<1, 2>` the whole.
            let opener = match before.chars().last() {
                Some(')') => before.rfind('('),
                Some('>') => before.rfind('<'),
                _ => None,
            };
            let start = before[..opener.unwrap_or(before.len())].trim_end_matches(of_name).len();
            let closer = match behind.chars().next() {
                Some('(') => behind.find(')').map(|at| at + 1),
                Some('<') => behind.find('>').map(|at| at + 1),
                _ => behind.find(|c: char| !of_name(c)),
            };
            let length = closer.unwrap_or(behind.len());
            let place = Span {
                start: parts.start + start as u32,
                end: parts.start + (at + 2 + length) as u32,
                ..parts
            };
            (ends && begins && is_value)
                .then(|| (place, format!("{}, -{}", &before[start..], &behind[..length])))
        })
    }

    /// Returns the end of the last part taken for `after` in its block; `None` before the first, and in an
    /// unclosed block.
    fn end_of_parts(&self, after: &Token) -> Option<Span> {
        let (taken, after) = (self.taken?, after.here.site(after.span));
        self.within_block()?;
        let is_part = taken.expansion == after.expansion
            && taken.span.file == after.span.file
            && taken.span.start >= after.span.end
            && self.taken != self.blocks.last().copied();
        is_part.then(|| taken.span.after())
    }

    /// Returns whether a line break separates a position from the item found after it.
    fn is_on_a_later_line(&self, found: &Token, place: Span) -> bool {
        let between = Span { start: place.start, end: found.span.start, ..place };
        found.span.file == place.file
            && between.start < between.end
            && self.sources.text(between).contains('\n')
    }

    /// Returns the syntax of what `word` begins, in the current block: the parts of a blob have a strength.
    pub(in crate::evaluate) fn form_of(&self, word: Word) -> &'static str {
        let blob = |opener: &Span| self.sources.text(*opener) == Word::Blob.name();
        let in_blob = self.openers.iter().rev().take(2).any(blob);
        match word {
            Word::Sphere if in_blob => "`sphere { <centre>, radius, strength }`: a ball of a blob",
            Word::Cylinder if in_blob => {
                "`cylinder { <end>, <end>, radius, strength }`: a bar of a blob"
            }
            _ => word.sentence(),
        }
    }
}
