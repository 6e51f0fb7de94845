//! Diagnostics for blocks and entries without a keyword before them, and for colours in quotes.

use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::vocabulary::{Family, Word};

use super::super::Evaluator;
use super::super::stream::{Token, TokenKind};
use super::super::undeclared::standard_color;
use super::super::value::Value;
use super::Place;
use super::unexpected::opener;

impl Evaluator<'_> {
    /// Handles map entries without a map around them: `gradient y [0 Red] [1 Blue]`.
    pub(super) fn loose_entries(&mut self, first: &Token, place: Place) {
        let mut last = first.span;
        loop {
            self.skip_commas();
            let next = self.next_if(|kind| matches!(kind, TokenKind::Entry(_)));
            let Some(Token { kind: TokenKind::Entry(items), here, span }) = next else { break };
            last = span;
            self.inside(&here, items, Self::run_items);
        }
        let message = format!("an entry in brackets has no meaning {}", place.name());
        let told = Diagnostic::new(Code::ExtraPart, message)
            .at(opener(first.span), "entries stand in maps: `color_map { [0 …] [1 …] }`");
        let told = match place.word {
            Some(Word::Pigment) if last.file == first.span.file && last.end > first.span.end => {
                told.help("write `color_map {` before the first and `}` behind the last")
                    .fix(Span { end: first.span.start, ..first.span }, "color_map { ")
                    .fix(last.after(), " }")
            }
            _ => told,
        };
        self.report(&first.here, told);
    }

    /// Returns the diagnostic for a colour name in quotes: `pigment { "red" }`.
    pub(super) fn quoted_color(&self, token: &Token, value: &Value) -> Option<Diagnostic> {
        let Value::String(text) = value else { return None };
        let is_color = |name: &&str| {
            let value = self.scopes.symbol(name).and_then(|symbol| self.scopes.look(symbol));
            matches!(value, Some(Value::Color(_)))
        };
        let declared = self.scopes.visible().find(|name| name.eq_ignore_ascii_case(text));
        let told = Diagnostic::new(Code::WrongType, "a colour stands without quotes")
            .at(token.span, "this is a text");
        match declared.filter(is_color) {
            Some(name) => {
                let name = name.to_owned();
                Some(told.help(format!("did you mean `{name}`?")).fix(token.span, name))
            }
            None => {
                let near = standard_color(text)?;
                Some(told.help(format!(
                    "did you mean `{near}`? It comes with `#include \"colors.inc\"`"
                )))
            }
        }
    }

    /// Returns the diagnostic for a macro body in braces: `#macro M(A) { … }`.
    pub(super) fn braced_macro(&self, block: Span) -> Option<Diagnostic> {
        let before = self.sources.get(block.file).text.get(..block.start as usize).unwrap_or("");
        let before = before.trim_end();
        let line = before.rsplit(['\n', '\r']).next().unwrap_or("").trim_start();
        let is_meant = line.starts_with("#macro")
            && before.ends_with(')')
            && self.sources.text(block).ends_with('}');
        let message = "the body of `#macro` stands without braces, and ends with `#end`";
        let closer = Span { start: block.end - 1, ..block };
        is_meant.then(|| {
            Diagnostic::new(Code::ExtraPart, message)
                .at(opener(block), "the braces of another language")
                .help("leave them out")
                .fix(opener(block), "")
                .fix(closer, "")
        })
    }

    /// Returns the diagnostic for doubled braces: `pigment {{ rgb 1 }}`.
    pub(super) fn doubled_braces(&self, block: Span) -> Option<Diagnostic> {
        let text = &self.sources.get(block.file).text;
        let before = text.get(..block.start as usize)?.trim_end().strip_suffix('{')?.len();
        let behind = text.get(block.end as usize..)?;
        let end = block.end as usize + (behind.len() - behind.trim_start().len());
        let is_doubled = behind.trim_start().starts_with('}') && before < block.start as usize;
        let closer = Span { start: block.end - 1, ..block };
        is_doubled.then(|| {
            Diagnostic::new(Code::ExtraPart, "a second `{` right behind the first has no meaning")
                .at(opener(block), "one brace is too many")
                .also(Span { start: end as u32, end: end as u32 + 1, ..block }, "and here, too")
                .help("leave one pair of the braces out")
                .fix(opener(block), "")
                .fix(closer, "")
        })
    }

    /// Completes the diagnostic for a pattern's colours in braces: `checker { rgb 1 rgb 0 }`, `gradient y {
    /// [0 rgb 1] [1 rgb 0] }`.
    pub(super) fn braced_colors(&self, block: Span, place: Place, told: Diagnostic) -> Diagnostic {
        let text = self.sources.text(block);
        let before = self.sources.get(block.file).text.get(..block.start as usize).unwrap_or("");
        let mut words = before.trim_end().rsplit(|c: char| !c.is_ascii_alphanumeric() && c != '_');
        let is_pattern = |word: Option<&str>| {
            let word = word.and_then(Word::from_name);
            word.is_some_and(|word| word.family() == Family::Pattern)
        };
        let last = words.next();
        let lists = matches!(last, Some("checker" | "hexagon" | "brick" | "square" | "triangular"));
        if lists && !text.contains('[') && text.ends_with('}') {
            let closer = Span { start: block.end - 1, ..block };
            return told
                .help(format!("the colours of `{}` stand without braces", last.unwrap_or("")))
                .fix(opener(block), "")
                .fix(closer, "");
        }
        if text.contains('[') && (is_pattern(last) || is_pattern(words.next())) {
            let (entries, map) = match place.word {
                Some(Word::Normal) => ("normals", Word::NormalMap),
                Some(Word::Texture) => ("textures", Word::TextureMap),
                _ if last == Some("average") => ("pigments", Word::PigmentMap),
                _ => ("colours", Word::ColorMap),
            };
            return told
                .help(format!("entries of {entries} stand in a `{} {{ … }}`", map.name()))
                .fix(Span { end: block.start, ..block }, format!("{} ", map.name()));
        }
        told
    }
}
