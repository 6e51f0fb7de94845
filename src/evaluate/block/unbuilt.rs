//! Unsupported blocks: their parts and modifiers are read nevertheless, to report the mistakes in them.
//!
//! **Invariant:** the result is poison, whatever is found in the block.

mod items;
mod left_out;
mod ranges;

use crate::diagnostic::{Code, Diagnostic};
use crate::source::{Site, Span};
use crate::syntax::ast::{ExpressionId, ExpressionKind};
use crate::vocabulary::{Family, Word};

use super::super::stream::{Token, TokenKind};
use super::super::value::{Poison, Value};
use super::super::{Evaluator, Outcome, Reported, Symbol};
use super::Place;

impl Evaluator<'_> {
    /// Skips what belongs to an unsupported word, reporting the mistakes in it.
    pub(super) fn pass_not_built(&mut self, token: &Token, word: Word) {
        if Self::knows_items(word)
            && let Some(Token { kind: TokenKind::Block(contents), here, span }) =
                self.peek().cloned()
        {
            self.next();
            self.openers.push(token.span);
            self.inside_block(&here, contents, span, |evaluator| {
                evaluator.items_not_built(token, word);
            });
            self.openers.pop();
            return;
        }
        // `density_file df3 "smoke.df3" interpolate 1`: any number is valid there.
        if word != Word::Interpolate && self.modifier_not_built(token, word) {
            return;
        }
        self.block_is_missing(token, word);
        // An object, which may have mistakes like any other.
        if word == Word::ProjectedThrough
            && self.is_before_block()
            && self.judge_block(token, Word::Union)
        {
            return;
        }
        self.skip_arguments(word);
    }

    /// Reports an unsupported word without its block: `looks_like sphere { … }`, `radiosity` alone.
    pub(super) fn block_is_missing(&mut self, token: &Token, word: Word) {
        let has_block = matches!(
            word,
            Word::LooksLike
                | Word::ProjectedThrough
                | Word::Radiosity
                | Word::Photons
                | Word::Scattering
                | Word::Warp
        );
        if !has_block || self.is_before_block() {
            return;
        }
        let name = word.name();
        let message = format!("expected `{{` after `{name}`");
        let diagnostic =
            Diagnostic::new(Code::MissingPart, message).at(token.span, "its block is missing");
        let wrapped = self.peek_on().cloned().filter(|next| {
            matches!(next.kind, TokenKind::Word(of) if matches!(of.family(), Family::Shape | Family::Csg)
                || of == Word::Object)
        });
        let diagnostic = match wrapped {
            Some(object) => {
                let before = self.told();
                self.next();
                if let TokenKind::Word(of) = object.kind {
                    self.skip_arguments(of);
                }
                self.take_back(before);
                let whole = self.whole(&object);
                let text = self.sources.text(whole.span).lines().next().unwrap_or("").to_owned();
                let (start, end) = (Span { end: whole.span.start, ..whole.span }, whole.span.after());
                diagnostic
                    .help(format!("write `{name} {{ {text} }}`"))
                    .fix(start, "{ ")
                    .fix(end, " }")
            }
            None if word == Word::Radiosity => diagnostic
                .help("`radiosity { … }` belongs in `global_settings`; `no_radiosity` leaves an object out of it"),
            None => diagnostic.help(format!("write `{name} {{ … }}`")),
        };
        self.report(&token.here, diagnostic);
    }

    pub(super) fn unbuilt_word(&mut self, token: &Token, word: Word) -> Reported {
        self.set_poison(Poison::new(word, token.here.site(token.span)));
        self.skip_arguments(word);
        Reported
    }

    fn unbuilt_part(&mut self, token: &Token, wanted: &str) -> Outcome<()> {
        if wanted.starts_with("a vector")
            && let Some(reported) = self.bare_points(1, 0)
        {
            return Err(reported);
        }
        let given = self.given(token, wanted)?;
        match &given.value {
            Value::Poison(_) | Value::Broken => Ok(()),
            value if wanted.starts_with("a number") && value.as_number().is_none() => {
                Err(self.wrong_type(&given.here, given.span, wanted, value))
            }
            value if value.numbers().is_some() => Ok(()),
            value => Err(self.wrong_type(&given.here, given.span, wanted, value)),
        }
    }

    /// As [`Self::is_of_place`], for a name whose declaration was reported: the word after its `=` shows what
    /// was intended.
    pub(super) fn broken_of_place(&mut self, token: &Token, id: ExpressionId, place: Place) {
        let ExpressionKind::Name(name) = token.here.unit.expression(id).kind else { return };
        if let Some((word, site)) = self.declared_as(token.here.symbol(name)) {
            self.is_of_place(token, Poison::new(word, site), place);
        }
    }

    /// Reports a name whose own mistake was reported where its object is used as a part: `sphere { Chair, 1
    /// }`.
    pub(super) fn tell_broken_object(&mut self, token: &Token, id: ExpressionId) {
        let ExpressionKind::Name(name) = token.here.unit.expression(id).kind else { return };
        let Some((word, site)) = self.declared_as(token.here.symbol(name)) else { return };
        if matches!(word.family(), Family::Shape | Family::Csg) {
            let text = self.sources.text(token.span).to_owned();
            let message = format!("`{text}` is an object, and no value");
            let told = Diagnostic::new(Code::WrongType, message)
                .at(token.span, "expected a number or a vector")
                .also(site.span, "declared here");
            self.report(&token.here, told);
        }
    }

    /// Returns the word after the `=` of a declaration, and the site of the name.
    pub(in crate::evaluate) fn declared_as(&self, name: Symbol) -> Option<(Word, Site)> {
        let site = self.scopes.declared(name)?.site;
        let text = &self.sources.get(site.span.file).text;
        let behind = text.get(site.span.end as usize..)?.trim_start();
        let value = behind.strip_prefix('=')?.trim_start();
        let end = value.find(|c: char| !c.is_ascii_alphanumeric() && c != '_');
        Word::from_name(&value[..end.unwrap_or(value.len())]).map(|word| (word, site))
    }

    /// Reports a name of an unsupported value in a block that does not accept that kind.
    pub(super) fn is_of_place(&mut self, token: &Token, poison: Poison, place: Place) {
        let Some(of) = place.word.filter(|_| matches!(token.kind, TokenKind::Expression(_))) else {
            return;
        };
        let word = poison.of.unwrap_or(poison.word);
        let of_object = place.families.contains(&Family::Modifier);
        let is_layer = matches!(word, Word::Texture | Word::Pigment | Word::Finish | Word::Normal);
        let is_other = matches!(
            word,
            Word::Fog | Word::Rainbow | Word::Camera | Word::Interior | Word::Material
        );
        let is_wrong = match of {
            Word::Pigment => is_other || (is_layer && word != Word::Pigment),
            Word::Texture => is_other,
            Word::Finish => (is_layer || is_other) && word != Word::Finish,
            Word::Material => (is_layer || is_other) && word != Word::Material,
            _ => of_object && (is_layer || is_other || word == Word::TransformWord),
        };
        if !is_wrong {
            return;
        }
        let text = self.sources.text(token.span).to_owned();
        let (name, block) = (word.name(), of.name());
        let message = format!("`{text}` is a `{name}`, and stands in a `{block}`");
        let diagnostic =
            Diagnostic::new(Code::WrongType, message).at(token.span, format!("this is a `{name}`"));
        let whole = format!("{name} {{ {text} }}");
        let diagnostic = match of {
            _ if of_object && !matches!(word, Word::Fog | Word::Rainbow | Word::Camera) => {
                diagnostic.help(format!("write `{whole}`")).fix(token.span, whole)
            }
            Word::Material if matches!(word, Word::Texture | Word::Interior) => {
                diagnostic.help(format!("write `{whole}`")).fix(token.span, whole)
            }
            Word::Pigment if word == Word::Texture => {
                diagnostic.help(format!("write `{whole}` instead of this `{block}`"))
            }
            _ => diagnostic.help(of.sentence().to_owned()),
        };
        self.report(&token.here, diagnostic);
    }
}
