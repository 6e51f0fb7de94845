//! Diagnostics for a misspelt word where a colour or a value is expected.

use crate::diagnostic::{Code, Diagnostic};
use crate::syntax::ast::ExpressionId;
use crate::vocabulary::{Family, Role, Word};

use super::super::analysis_cache::Asked;
use super::super::stream::{Token, TokenKind};
use super::super::undeclared::word_like;
use super::super::{Evaluator, Reported};
use super::Place;
use super::foreign_keyword::custom;
use super::unknown::{UNKNOWN, meant};

/// The words other than shapes and textures whose block is a value.
const OPENERS: &[Word] = &[
    Word::Camera,
    Word::LightSource,
    Word::Object,
    Word::TransformWord,
    Word::Interior,
    Word::ColorMap,
    Word::SkySphere,
    Word::Fog,
    Word::Rainbow,
    Word::Media,
    Word::Function,
];

impl Evaluator<'_> {
    /// Reports `colr rgb 1` where a colour is expected, or `intensity 2`.
    pub(super) fn misspelt_color(&mut self, after: &Token) -> Option<Reported> {
        let token = self.peek()?.clone();
        let TokenKind::Expression(id) = token.kind else { return None };
        self.unknown_name(&token.here, id)?;
        let name = self.sources.text(token.span).to_owned();
        if let Some(diagnostic) = self.alpha_color(&name, token.span) {
            let reported = self.report(&token.here, diagnostic);
            self.next();
            self.skip_values();
            return Some(reported);
        }
        if after.kind == TokenKind::Word(Word::LightSource)
            && let Some(custom) = custom(&name, Place::LIGHT)
        {
            let message = format!("`{name}` is not a word {}", Place::LIGHT.name());
            let diagnostic = Diagnostic::new(Code::ForeignWord, message).at(token.span, custom);
            let reported = self.report(&token.here, diagnostic);
            self.next();
            self.skip_values();
            return Some(reported);
        }
        let near = self.near(token.span, Asked::Color, || {
            word_like(&name, |word| word.family() == Family::Color)
        })?;
        // Without a value after it, it is more likely the name of a colour.
        let rest = self.sources.get(token.span.file).text.get(token.span.end as usize..)?;
        let has_value =
            rest.trim_start().starts_with(|c: char| c == '<' || c == '.' || c.is_alphanumeric());
        if !has_value {
            return None;
        }
        let message = format!("`{name}` is not a word that begins a colour");
        let diagnostic = meant(Diagnostic::new(Code::UnknownWord, message), token.span, near);
        let reported = self.report(&token.here, diagnostic);
        self.next();
        drop(self.color_after(&token, "a colour"));
        Some(reported)
    }

    /// Reports an undeclared name with a value where a colour is expected: `color power 100`.
    pub(super) fn unknown_part_of_color(&mut self) -> Option<Reported> {
        let token = self.peek()?.clone();
        let TokenKind::Expression(id) = token.kind else { return None };
        let symbol = self.unknown_name(&token.here, id)?;
        let rest = self.sources.get(token.span.file).text.get(token.span.end as usize..)?;
        if !rest.trim_start().starts_with(|c: char| c == '<' || c == '.' || c.is_ascii_digit()) {
            return None;
        }
        let name = self.sources.text(token.span).to_owned();
        let of_light = self
            .openers
            .last()
            .is_some_and(|opener| self.sources.text(*opener) == Word::LightSource.name());
        self.next();
        let reported = match custom(&name, Place::LIGHT).filter(|_| of_light) {
            Some(custom) => {
                let message = format!("`{name}` is not a word {}", Place::LIGHT.name());
                let told = Diagnostic::new(Code::ForeignWord, message).at(token.span, custom);
                self.report(&token.here, told)
            }
            None => self.undeclared(&token.here, symbol, token.span),
        };
        self.skip_behind(token.span);
        Some(reported)
    }

    /// Reports `camra { … }` where a value is expected.
    pub(in crate::evaluate) fn misspelt_block(
        &mut self,
        token: &Token,
        id: ExpressionId,
    ) -> Option<Reported> {
        self.unknown_name(&token.here, id)?;
        let Some(Token { kind: TokenKind::Block(contents), here, span: block }) =
            self.peek_on().cloned()
        else {
            return None;
        };
        let name = self.sources.text(token.span).to_owned();
        let opens = |word: Word| {
            word.role() == Role::Statement
                && (matches!(word.family(), Family::Shape | Family::Csg | Family::Texture)
                    || OPENERS.contains(&word))
        };
        let message = format!("`{name}` is not a word that begins a value");
        let diagnostic = Diagnostic::new(Code::UnknownWord, message);
        // Before a block, a capital does not make it one of the author's names.
        let near = self.near(token.span, Asked::Block, || {
            let in_case = || Word::from_name(&name.to_lowercase()).filter(|word| opens(*word));
            in_case().map(Word::name).or_else(|| word_like(&name.to_lowercase(), opens))
        });
        let diagnostic = match near {
            Some(near) => meant(diagnostic, token.span, near),
            None => diagnostic.at(token.span, UNKNOWN),
        };
        let reported = self.report(&token.here, diagnostic);
        if let Some(word) = near.and_then(Word::from_name)
            && self.judge_block(token, word)
        {
            return Some(reported);
        }
        self.next();
        // The contents belong to an unknown word: run, but not checked.
        let before = self.told();
        self.inside_block(&here, contents, block, Self::run_items);
        self.take_back(before);
        Some(reported)
    }
}
