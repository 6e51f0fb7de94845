//! Diagnostics for missing braces around the argument of a keyword, and for braces after a name: `clipped_by
//! plane { y, 0 }`, `object Tree { translate x }`.
//!
//! **Invariant:** the contents of the braces cause no second error.

use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::vocabulary::{Family, Word};

use super::super::stream::{Token, TokenKind};
use super::super::value::Value;
use super::super::{Evaluator, Outcome, Reported};
use super::{Place, opens_object};

impl Evaluator<'_> {
    /// Handles a shape that `fits` without the braces of its container: `contained_by sphere { 0, 1 }`,
    /// `clipped_by plane { y, 0 }`.
    pub(super) fn unbraced(
        &mut self,
        token: &Token,
        holder: Word,
        fits: impl Fn(Word) -> bool,
    ) -> Option<Reported> {
        let inner = self.peek()?.clone();
        let TokenKind::Word(word) = inner.kind else { return None };
        if !fits(word) {
            return None;
        }
        self.next();
        self.skip_arguments(word);
        let whole = self.whole(&inner).span;
        let text = self.sources.text(whole).lines().next().unwrap_or("").to_owned();
        let name = holder.name();
        let message = format!("expected `{{` after `{name}`");
        let diagnostic = Diagnostic::new(Code::MissingPart, message)
            .at(token.span, "its block is missing")
            .also(inner.span, "this stands in it")
            .help(format!("write `{name} {{ {text} }}`"))
            .fix(Span { end: whole.start, ..whole }, "{ ")
            .fix(whole.after(), " }");
        Some(self.report(&token.here, diagnostic))
    }

    /// Returns whether `span` is the name of a file, as the block of `word` has it.
    pub(super) fn is_picture(&self, word: Word, span: Span) -> bool {
        matches!(word, Word::ImageMap | Word::BumpMap | Word::ImagePattern)
            && self.whole_string(span).is_some()
    }

    /// Completes the diagnostic for a file without the braces of `word`: `bump_map "a.png"`.
    pub(super) fn braces_around_file(
        &self,
        word: Word,
        file: Span,
        told: Diagnostic,
    ) -> Diagnostic {
        let name = self.whole_string(file).unwrap_or_default().to_ascii_lowercase();
        let kind = match name.rsplit_once('.').map_or("", |(_, extension)| extension) {
            "jpg" => "jpeg",
            "tif" => "tiff",
            extension => extension,
        };
        let kind = Word::from_name(kind).filter(|kind| kind.family() == Family::FileKind);
        let kind = kind.map_or(String::new(), |kind| format!("{} ", kind.name()));
        let text = self.sources.text(file);
        told.help(format!("write `{} {{ {kind}{text} }}`", word.name()))
            .fix(Span { end: file.start, ..file }, format!("{{ {kind}"))
            .fix(file.after(), " }")
    }

    /// Handles a name and its modifiers that belong in the braces of `word`: `object Tree { translate x }`,
    /// `object Tree translate x`. Returns the span to replace, and its replacement.
    pub(super) fn named_outside(&mut self, word: Word, name: Span) -> (Span, String) {
        let text = &self.sources.get(name.file).text;
        let behind = text.get(name.end as usize..).unwrap_or("");
        let gap = behind.len() - behind.trim_start().len();
        if behind[gap..].starts_with('{') {
            let end = name.end + gap as u32 + 1;
            return (Span { end, ..name }, format!("{{ {}", self.sources.text(name)));
        }
        let whole = match word {
            Word::Object => {
                self.next();
                self.line_of_modifiers(name)
            }
            _ => name,
        };
        (whole, format!("{{ {} }}", self.sources.text(whole)))
    }

    /// Reports a modified copy without its block's keyword; the block comes next: `#declare Leg2 = Leg {
    /// translate x };`.
    pub(super) fn copy_without_word(&mut self, name: &Token, value: &Value) -> Option<Reported> {
        let word = match value {
            Value::Object(_) => Word::Object,
            Value::Texture(_) => Word::Texture,
            Value::Pigment(_) => Word::Pigment,
            Value::Normal(_) => Word::Normal,
            Value::Finish(_) => Word::Finish,
            _ => return None,
        };
        let Some(Token { kind: TokenKind::Block(contents), here, span }) = self.peek_on().cloned()
        else {
            return None;
        };
        if !self.sources.between(name.span, span)?.trim().is_empty() {
            return None;
        }
        self.next();
        let right = format!("{} {{ {}", word.name(), self.sources.text(name.span));
        let message = format!("a changed copy stands in `{} {{ … }}`", word.name());
        let diagnostic = Diagnostic::new(Code::ExtraPart, message)
            .at(name.span, format!("expected `{}` before this", word.name()))
            .help(format!("write `{right} … }}`"))
            .fix(name.span.to(Span { end: span.start + 1, ..span }), right);
        let reported = self.report(&name.here, diagnostic);
        let before = self.told();
        self.inside_block(&here, contents, span, Self::run_items);
        self.take_back(before);
        Some(reported)
    }

    /// Reports transforms without a `transform` block: `#declare T = rotate 45*y;`.
    pub(super) fn bare_transform(&mut self, first: &Token, word: Word) -> Reported {
        let before = self.told();
        loop {
            self.skip_values();
            let Some(next) = self.peek_on() else { break };
            if !matches!(next.kind, TokenKind::Word(next) if next.family() == Family::Transform) {
                break;
            }
            self.next();
        }
        self.take_back(before);
        let whole = self.whole(first).span;
        let text = self.sources.text(whole);
        let told = Diagnostic::new(Code::ExpectedExpression, "transforms are declared in a block")
            .at(first.span, format!("`{}` begins no value", word.name()));
        let told = match text.contains(['#', '{', '/']) {
            true => told.help("write `transform { … }`"),
            false => {
                let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
                let right = format!("transform {{ {text} }}");
                told.help(format!("write `{right}`")).fix(whole, right)
            }
        };
        self.report(&first.here, told)
    }

    /// Returns whether a block without a keyword contains objects: `#declare A = { sphere { 0, 1 } box { 0, 1
    /// } };`.
    pub(super) fn objects_meant(&self, block: &Token) -> bool {
        let inside = self.sources.text(block.span).trim_start_matches('{').trim_start();
        let of_name = |c: char| c.is_ascii_alphanumeric() || c == '_';
        let first = &inside[..inside.len() - inside.trim_start_matches(of_name).len()];
        Word::from_name(first).is_some_and(opens_object)
    }

    /// Reports such a block; see [`Self::objects_meant`].
    pub(super) fn unjoined(&mut self, block: &Token) -> Reported {
        let opener = block.span_head();
        let told =
            Diagnostic::new(Code::ExpectedExpression, "objects are put together in a `union`")
                .at(opener, "expected `union` before this")
                .help("write `union { … }`")
                .fix(Span { end: opener.start, ..opener }, "union ");
        let reported = self.report(&block.here, told);
        if let TokenKind::Block(contents) = block.kind {
            // Each may have mistakes of its own.
            let _: Outcome<()> =
                self.inside_block(&block.here, contents, block.span, |evaluator| {
                    evaluator.children();
                    evaluator.run_items();
                    Ok(())
                });
        }
        reported
    }

    /// Returns the diagnostic for modifiers in braces after a name, which belong beside it: `object { Ball {
    /// translate x } }`.
    pub(super) fn braced_modifiers(&self, block: Span, place: Place) -> Option<Diagnostic> {
        let before = self.sources.get(block.file).text.get(..block.start as usize)?.trim_end();
        let of_name = |c: char| c.is_ascii_alphanumeric() || c == '_';
        let name = &before[before.trim_end_matches(of_name).len()..];
        let value = self.scopes.look(self.scopes.symbol(name)?)?;
        let is_copy = match value {
            Value::Object(_) => place.word == Some(Word::Object),
            Value::Texture(_) => place.word == Some(Word::Texture),
            Value::Pigment(_) => place.word == Some(Word::Pigment),
            _ => false,
        };
        let text = self.sources.text(block);
        if !is_copy || !text.ends_with('}') {
            return None;
        }
        let closer = Span { start: block.end - 1, ..block };
        let opener = Span { end: block.start + 1, ..block };
        let message = format!("what changes `{name}` stands beside it without braces");
        Some(
            Diagnostic::new(Code::ExtraPart, message)
                .at(opener, "leave these braces out")
                .fix(opener, "")
                .fix(closer, ""),
        )
    }

    /// Returns the diagnostic for two objects where one is expected: `object { A B }`.
    pub(super) fn second_of_object(&self, second: Span) -> Option<Diagnostic> {
        let opener = *self.openers.last()?;
        let block = self.within_block()?.span;
        if !block.contains(second) {
            return None;
        }
        let before = self.sources.text(Span { end: second.start, ..block });
        let first = before.trim();
        let is_object = |name: &str| {
            let value = self.scopes.symbol(name).and_then(|symbol| self.scopes.look(symbol));
            matches!(value, Some(Value::Object(_)))
        };
        if self.sources.text(opener) != Word::Object.name() || !is_object(first) {
            return None;
        }
        let start = block.start + (before.len() - before.trim_start().len()) as u32;
        let [a, b] = [first, self.sources.text(second)].map(|name| format!("object {{ {name} }}"));
        let message = "an `object` is one: several are put together in a `union`";
        Some(
            Diagnostic::new(Code::ExtraPart, message)
                .at(second, "one too many")
                .help(format!("write `union {{ {a} {b} … }}`"))
                .fix(opener, Word::Union.name())
                .fix(Span { start, end: start + first.len() as u32, ..block }, a)
                .fix(second, b),
        )
    }
}
