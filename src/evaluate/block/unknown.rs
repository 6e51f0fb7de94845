//! Diagnostics for a name that is neither a keyword nor declared, where a keyword is expected.
//!
//! **Invariant:** it is a single error: what belongs to the name is skipped, and items that merely follow it
//! are not.

use std::rc::Rc;

use crate::diagnostic::{Code, Diagnostic, suggest};
use crate::source::Span;
use crate::vocabulary::{Dialect, Family, Role, Word};

use super::super::stream::{Token, TokenKind};
use super::super::undeclared::{is_built, is_likely, word_like};
use super::super::{Evaluator, Outcome, Symbol};
use super::foreign_keyword::{custom, has_no_word, has_other_parts};
use super::item_suggestion::{told_directive, with_number};
use super::place::home;
use super::{Place, opens_value};

impl Evaluator<'_> {
    /// Reports a name that is neither a keyword nor declared, where a keyword is expected.
    pub(super) fn unknown_word(&mut self, token: &Token, span: Span, place: Place) {
        let has_block = self.is_before_block();
        let at = (span, place.word, has_block);
        let unknown = match self.remembered.unknown.get(&at) {
            Some(unknown) => unknown.clone(),
            None => {
                let unknown = Rc::new(self.taken_for(token, span, place, has_block));
                self.remembered.unknown.insert(at, unknown.clone());
                unknown
            }
        };
        match &*unknown {
            Unknown::Written(told) => {
                self.report_again(&token.here, told);
                self.skip_values();
            }
            Unknown::Name(symbol) => drop(self.undeclared(&token.here, *symbol, span)),
            Unknown::Directive(told) => self.foreign_directive(token, told, span),
            Unknown::Included => self.skip_values(),
            Unknown::Word { told, near } => {
                self.report_again(&token.here, told);
                self.skip_unknown(token, *near, has_block, place);
            }
        }
    }

    /// Skips what belongs to an unknown word that was probably meant as `near`.
    fn skip_unknown(
        &mut self,
        token: &Token,
        near: Option<&'static str>,
        has_block: bool,
        place: Place,
    ) {
        let meant = near.filter(|_| has_block).and_then(Word::from_name);
        let meant = meant.filter(|word| !has_other_parts(self.sources.text(token.span), *word));
        // A blob's parts differ from those of shapes.
        if let Some(word) = meant.filter(|_| place.word != Some(Word::Blob))
            && self.judge_block(token, word)
        {
            return;
        }
        self.skip_values();
        self.skip_textures(near.filter(|_| place.word == Some(Word::Texture)));
        while place.word.is_none()
            && matches!(self.peek().map(|next| &next.kind), Some(TokenKind::Entry(_)))
        {
            self.next();
        }
        if !place.families.contains(&Family::Color) && !near.is_some_and(is_transform) {
            self.skip_color(token);
        }
        if self.is_before_block() {
            // The contents belong to an unknown word: run, but not checked.
            let before = self.told();
            if let Some(Token { kind: TokenKind::Block(contents), here, span }) = self.next() {
                self.inside_block(&here, contents, span, Self::run_items);
            }
            self.take_back(before);
        }
    }

    fn taken_for(&mut self, token: &Token, span: Span, place: Place, has_block: bool) -> Unknown {
        let name = self.sources.text(span).to_owned();
        if let Some(diagnostic) = self.alpha_color(&name, span) {
            return Unknown::Written(diagnostic);
        }
        if let Some(diagnostic) = self.of_another_writing(&name, span) {
            return Unknown::Written(diagnostic);
        }
        let dialect = self.options.dialect;
        let words = || place.words(dialect);
        if let Some((word, value)) = name.rsplit_once('_')
            && matches!(value, "on" | "off" | "yes" | "no" | "true" | "false")
            && words().any(|other| other == word)
        {
            let right = format!("{word} {value}");
            let told = Diagnostic::new(Code::UnknownWord, format!("`{name}` is two words"))
                .at(span, format!("did you mean `{right}`?"))
                .help(format!("replace it with `{right}`"))
                .fix(span, right);
            return Unknown::Word { told, near: None };
        }
        // A word that another tool has is meant as there, whatever it resembles; a name with a capital is
        // the author's.
        let is_own = !has_block && name.starts_with(char::is_uppercase);
        let foreign = || suggest::foreign(&name).filter(|_| !is_own);
        let is_known = foreign().any(is_built);
        let here = foreign()
            .find(|word| place.may_mean(word, dialect))
            .or_else(|| suggest::reworded(&name, words()))
            .or_else(|| suggest::closest(&name, words()).filter(|w| !is_known || is_built(w)))
            .or_else(|| suggest::abridged(&name, words()))
            .or_else(|| suggest::begun(&name, words()))
            .or_else(|| suggest::short_of(&name, words()));
        let symbol = self.scopes.symbol(&name).filter(|_| !has_block);
        if let Some(symbol) = symbol.filter(|_| name.contains([' ', '-'])) {
            return Unknown::Name(symbol);
        }
        if let Some(symbol) = symbol
            && self.is_rather_a_name(token, &name, symbol, here)
        {
            return Unknown::Name(symbol);
        }
        let elsewhere = |word: Word| {
            word.role() == Role::Statement
                && word.family() != Family::Directive
                && (dialect == Dialect::Scene || word.block().is_none())
        };
        let may_be_included =
            self.lacks_include && !has_block && name.starts_with(char::is_uppercase);
        let near = here
            .filter(|word| has_block || is_built(word) || is_likely(&name, word))
            .or_else(|| word_like(&name, elsewhere))
            .filter(|word| !may_be_included || word.eq_ignore_ascii_case(&name))
            .filter(|_| !has_no_word(&name, place))
            // `texture { Wood }` is a name: a pattern would need its textures.
            .filter(|near| {
                let pattern = || Word::from_name(near).map(Word::family) == Some(Family::Pattern);
                !(is_own && place.word == Some(Word::Texture) && pattern())
            });
        if let Some(name) = near.and_then(|near| self.color_meant(near)) {
            let theirs = self.sources.text(span);
            let message = format!("`{theirs}` is not a word {}", place.name());
            let told = Diagnostic::new(Code::UnknownWord, message)
                .at(span, format!("did you mean `{name}`?"))
                .help(format!("replace it with `{name}`"))
                .fix(span, name);
            return Unknown::Word { told, near: None };
        }
        if near.is_none()
            && let Some(diagnostic) = told_directive(&name, span, place)
        {
            return Unknown::Directive(diagnostic);
        }
        let custom = if near.is_none() { custom(&name, place) } else { None };
        if near.is_none() && custom.is_none() && self.lacks_include && !has_block {
            return Unknown::Included;
        }
        // Words of the language have no capitals.
        let is_name = place.word.is_some() && name.starts_with(char::is_uppercase);
        if let (None, None, Some(symbol), true) = (near, custom, symbol, is_name) {
            return Unknown::Name(symbol);
        }
        let is_foreign = near.is_some_and(|near| suggest::foreign(&name).any(|word| word == near))
            && suggest::closest(&name, near).is_none();
        let code =
            if is_foreign || custom.is_some() { Code::ForeignWord } else { Code::UnknownWord };
        let mut diagnostic =
            Diagnostic::new(code, format!("`{name}` is not a word {}", place.name()));
        diagnostic = match near {
            Some("transmit") if is_foreign => self.clear_word(diagnostic, &name, span, place),
            // It would be the next mistake here.
            Some(near) if here.is_none() && is_built(near) => {
                let diagnostic = diagnostic.at(span, format!("did you mean `{near}`?"));
                diagnostic.help(match Word::from_name(near).and_then(home) {
                    Some(home) => format!("`{near}` belongs in `{} {{ … }}`", home.name()),
                    None => format!("`{near}` belongs elsewhere"),
                })
            }
            Some(near) => match with_number(near).filter(|_| !self.has_value(has_block)) {
                Some(whole) => meant(diagnostic, span, whole),
                None => meant(diagnostic, span, near),
            },
            None => match (custom, contextual(&name)) {
                (Some(custom), _) => diagnostic.at(span, custom),
                (None, Some(_)) if dialect == Dialect::Pov => {
                    diagnostic.at(span, "it is a word only in `.scene` files")
                }
                (None, Some(block)) => {
                    diagnostic.at(span, format!("it is a word only in `{block}`"))
                }
                (None, None) => diagnostic.at(span, UNKNOWN),
            },
        };
        Unknown::Word { told: diagnostic, near }
    }

    /// Returns whether a value comes next, or a block instead of one.
    fn has_value(&mut self, has_block: bool) -> bool {
        has_block || self.is_before_value() || self.at_color_word()
    }

    /// Reads the block of a misspelt word as that of the intended word, to report the mistakes in it. Returns
    /// `false` if that word has no block and nothing was read.
    pub(super) fn judge_block(&mut self, token: &Token, word: Word) -> bool {
        let token = Token { kind: TokenKind::Word(word), ..token.clone() };
        let poison = self.poison.take();
        let judged = match word {
            Word::Background | Word::GlobalSettings => {
                let _: Outcome<()> = self.scene_item(&token);
                true
            }
            _ if opens_value(word) => {
                drop(self.word_block(&token, word));
                true
            }
            _ => false,
        };
        self.poison = poison;
        judged
    }

    /// Returns whether a name that resembles the word `here` is more likely a declared name.
    fn is_rather_a_name(
        &self,
        token: &Token,
        name: &str,
        symbol: Symbol,
        here: Option<&str>,
    ) -> bool {
        let close = suggest::closest(name, self.scopes.visible())
            .or_else(|| suggest::abridged(name, self.scopes.visible()))
            .or_else(|| self.one_alike(name).filter(|_| here.is_none()));
        if close.is_some_and(|close| close.eq_ignore_ascii_case(name)) {
            return true;
        }
        // But for a word of the language in capitals, that is no colour and needs no block.
        let is_word = |here: &str| {
            here.eq_ignore_ascii_case(name)
                && Word::from_name(here)
                    .is_some_and(|word| word.family() != Family::Color && !opens_value(word))
        };
        if here.is_some_and(is_word) {
            return false;
        }
        // A capitalized name is probably one of the author's.
        if here.is_some_and(is_built) && !name.starts_with(char::is_uppercase) {
            return false;
        }
        close.is_some()
            || self.lacking_include(name).is_some()
            || self.lacking_near(name).is_some()
            || token.here.unit.declaration_of(symbol).is_some()
            || self.included_below(&token.here, name, token.span).is_some()
            || (here.is_none() && self.scopes.declared(symbol).is_some())
    }

    /// Skips a directive of another language, to the end of its line or to its block: `use <a.scad>`, `import
    /// "a"`, `module A() { … }`.
    fn foreign_directive(&mut self, token: &Token, told: &Diagnostic, span: Span) {
        self.report_again(&token.here, told);
        let before = self.told();
        let line = |evaluator: &Self, span: Span| {
            evaluator.sources.get(span.file).position(span.start as usize).line
        };
        while let Some(next) = self.peek().cloned()
            && next.span.file == span.file
            && line(self, next.span) == line(self, span)
        {
            self.next();
            match next.kind {
                TokenKind::Block(contents) => {
                    self.inside_block(&next.here, contents, next.span, Self::run_items);
                    break;
                }
                TokenKind::Semicolon => break,
                TokenKind::Expression(id) => self.meet_names(&next.here, id),
                TokenKind::Word(_)
                | TokenKind::Entry(_)
                | TokenKind::Comma
                | TokenKind::Literal(_) => {}
            }
        }
        self.take_back(before);
    }
}

/// The interpretation of an unknown word.
#[derive(Debug)]
pub(in crate::evaluate) enum Unknown {
    /// A colour of another tool.
    Written(Diagnostic),
    /// An undeclared name.
    Name(Symbol),
    /// A directive of another language.
    Directive(Diagnostic),
    /// A name that may be declared in the include that was not found, which was reported.
    Included,
    Word {
        told: Diagnostic,
        near: Option<&'static str>,
    },
}

pub(super) const UNKNOWN: &str = "neither a word of the language nor a declared name";

pub(super) fn meant(diagnostic: Diagnostic, span: Span, near: &str) -> Diagnostic {
    let diagnostic = diagnostic.at(span, format!("did you mean `{near}`?"));
    match near.contains(' ') || is_built(near) {
        true => diagnostic.help(format!("replace it with `{near}`")).fix(span, near),
        // The right word would be the next error: no fix.
        false => diagnostic.help(format!("`{near}` is not supported yet")),
    }
}

/// Returns whether a word takes a vector or a number, and not a colour.
pub(super) fn is_transform(name: &str) -> bool {
    Word::from_name(name).is_some_and(|word| word.family() == Family::Transform)
}

/// Returns the block in which a name is a keyword.
fn contextual(name: &str) -> Option<&'static str> {
    let word = Word::ALL.iter().find(|word| word.block().is_some() && word.name() == name)?;
    word.block().map(Word::name)
}
