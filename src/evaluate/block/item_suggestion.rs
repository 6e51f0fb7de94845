//! Suggestions for items that a block does not accept, or that precede one: a camera's position without its
//! keyword, `on` after a word that takes no value, a name before the braces.

use crate::diagnostic::{Code, Diagnostic, suggest};
use crate::source::Span;
use crate::syntax::ast::ExpressionKind;
use crate::vocabulary::{Family, Role, Word};

use super::super::stream::{Token, TokenKind};
use super::super::value::Value;
use super::super::{Evaluator, Reported};
use super::Place;
use super::place::home;

impl Evaluator<'_> {
    /// Returns the diagnostic for a literal value where the block takes none.
    pub(super) fn needless_value(
        &self,
        token: &Token,
        value: &Value,
        place: Place,
    ) -> Option<Diagnostic> {
        self.needless_flag(token).or_else(|| self.place_without_word(token, value, place))
    }

    /// Returns the diagnostic for the argument of a flag: `shadowless on`, `conserve_energy on`.
    fn needless_flag(&self, token: &Token) -> Option<Diagnostic> {
        let is_on = match self.sources.text(token.span) {
            "on" | "yes" | "true" => true,
            "off" | "no" | "false" => false,
            _ => return None,
        };
        let text = &self.sources.get(token.span.file).text;
        let before = text.get(..token.span.start as usize)?.trim_end();
        let of_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
        let start = before.trim_end_matches(of_word).len();
        let name = &before[start..];
        Word::from_name(name).filter(|word| word.role() == Role::Statement)?;
        let (start, label) = match is_on {
            true => (before.len(), "leave this out"),
            false => (start, "leave both out: it is so only where the word stands"),
        };
        let whole = Span { start: start as u32, ..token.span };
        let message = format!("`{name}` takes no value");
        Some(Diagnostic::new(Code::ExtraPart, message).at(token.span, label).fix(whole, ""))
    }

    /// Returns the diagnostic for a position without its keyword, as in a light: `camera { <0, 1, -5> look_at
    /// 0 }`.
    fn place_without_word(&self, token: &Token, value: &Value, place: Place) -> Option<Diagnostic> {
        let text = self.sources.text(token.span);
        let is_point = matches!(value, Value::Vector(_)) && text.starts_with('<');
        let block = self.sources.text(self.within_block()?.span);
        let name = Word::Location.name();
        if place.word != Some(Word::Camera) || !is_point || block.contains(name) {
            return None;
        }
        let message = "a point of a `camera` has a word before it";
        let told = Diagnostic::new(Code::ExtraPart, message)
            .at(token.span, "expected a word of this block")
            .help(format!("where the camera stands: write `{name} {text}`"));
        let behind = self.sources.get(token.span.file).text.get(token.span.end as usize..);
        let goes_on = behind.is_some_and(|rest| rest.trim_start().starts_with([',', '<']));
        Some(match goes_on {
            true => told.help("where it looks: `look_at <…>`"),
            false => told.fix(Span { end: token.span.start, ..token.span }, format!("{name} ")),
        })
    }

    /// Reports an item between a keyword and its braces, and skips both: `camera perspective { … }`, `camera
    /// Cam { … }`.
    pub(super) fn before_braces(&mut self, word: Word) -> Option<Reported> {
        let next = self.peek()?.clone();
        let text = &self.sources.get(next.span.file).text;
        let behind = text.get(next.span.end as usize..)?;
        let gap = behind.len() - behind.trim_start().len();
        if !behind[gap..].starts_with('{') {
            return None;
        }
        let brace =
            Span::new(next.span.file, next.span.range().end + gap, next.span.range().end + gap + 1);
        let (of, name) = (word.name(), self.sources.text(next.span).to_owned());
        let lone = text.matches(name.as_str()).count() == 1;
        let told = |message: String| {
            Diagnostic::new(Code::MissingPart, message).at(next.span, "expected `{` before this")
        };
        let without = Span { end: brace.start, ..next.span };
        // It belongs first in the braces.
        let moved = |told: Diagnostic| {
            told.help(format!("write `{of} {{ {name} … }}`"))
                .fix(without, "")
                .fix(brace.after(), format!(" {name}"))
        };
        let told = match next.kind {
            TokenKind::Word(kind) if word == Word::Camera && home(kind) == Some(word) => {
                moved(told("the kind of a camera stands inside its braces".to_owned()))
            }
            TokenKind::Word(kind) if word == Word::LightSource && home(kind) == Some(word) => {
                told(format!("`{name}` stands inside the braces of a `{of}`"))
                    .help(format!("write `{of} {{ <place>, rgb 1 {name} … }}`"))
            }
            TokenKind::Expression(id)
                if matches!(next.here.unit.expression(id).kind, ExpressionKind::Name(_)) =>
            {
                let told = told(format!("`{name}` stands before the braces of `{of}`"));
                let help = format!("a name is given by `#declare {name} = {of} {{ … }}`");
                match self.unknown_name(&next.here, id) {
                    None if begins_with_name(word) => moved(told),
                    None => told.help(self.form_of(word)),
                    Some(_) if lone => told.help(help).fix(without, ""),
                    Some(_) => told.help(help),
                }
            }
            _ => return None,
        };
        let reported = self.report(&next.here, told);
        self.next();
        let before = self.told();
        self.skip_arguments(word);
        self.take_back(before);
        Some(reported)
    }

    /// Returns whether an item is another tool's keyword for an omnidirectional light: `light_source { point
    /// <1, 2, 3> … }`.
    pub(super) fn is_all_around(&self, token: &Token) -> bool {
        let TokenKind::Expression(id) = token.kind else { return false };
        let name = self.sources.text(token.span).to_lowercase();
        self.unknown_name(&token.here, id).is_some()
            && matches!(
                name.as_str(),
                "point" | "point_light" | "pointlight" | "omni" | "omni_light"
            )
    }
}

/// Returns whether the block of a word may begin with a declared name.
fn begins_with_name(word: Word) -> bool {
    use Word as W;
    matches!(
        word,
        W::Object
            | W::Camera
            | W::LightSource
            | W::Texture
            | W::Pigment
            | W::Finish
            | W::Interior
            | W::Material
            | W::SkySphere
            | W::Fog
            | W::Rainbow
            | W::ColorMap
    )
}

/// Returns the block for the value that `text` names: `texture { M }` with a material, `pigment { F }` with a
/// finish.
pub(super) fn block_for(value: &Value, of: Word, text: &str) -> Option<String> {
    let of_surface = matches!(of, Word::Pigment | Word::Finish);
    let (own, instead) = match value {
        Value::Texture(_) if of_surface => (Word::Texture, true),
        Value::Material(_) if of_surface || of == Word::Texture => (Word::Material, true),
        Value::Finish(_) if of == Word::Pigment => (Word::Finish, false),
        Value::Pigment(_) if of == Word::Finish => (Word::Pigment, false),
        Value::Interior(_) if of_surface || of == Word::Texture => (Word::Interior, false),
        _ => return None,
    };
    let where_to = if instead { "instead of" } else { "beside" };
    Some(format!("write `{} {{ {text} }}` {where_to} this `{}`", own.name(), of.name()))
}

/// Returns a finish keyword with a typical number, for a misspelling without one: `finish { shiny }`.
pub(super) fn with_number(near: &str) -> Option<&'static str> {
    Some(match Word::from_name(near)? {
        Word::Specular => "specular 0.5",
        Word::Phong => "phong 0.5",
        Word::Reflection => "reflection 0.5",
        Word::Diffuse => "diffuse 0.6",
        Word::Ambient => "ambient 0.1",
        Word::Emission => "emission 0.5",
        _ => return None,
    })
}

/// Returns the diagnostic for a directive written as in another language.
pub(super) fn told_directive(name: &str, span: Span, place: Place) -> Option<Diagnostic> {
    let is_directive =
        |ours: &&str| Word::from_name(ours).is_some_and(|word| word.family() == Family::Directive);
    let ours = suggest::foreign(name).find(is_directive)?;
    let message = format!("`{name}` is not a word {}", place.name());
    let diagnostic = Diagnostic::new(Code::ForeignWord, message)
        .at(span, format!("did you mean `#{ours}`?"))
        .help(Word::from_name(ours).map_or("", Word::sentence));
    Some(diagnostic)
}
