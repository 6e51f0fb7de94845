//! Diagnostics for items that a block does not accept.

use crate::diagnostic::{Code, Diagnostic, suggest};
use crate::source::Span;
use crate::syntax::ast::{Callee, ExpressionKind};
use crate::vocabulary::{Family, Word};

use super::super::Evaluator;
use super::super::analysis_cache::Asked;
use super::super::stream::{Token, TokenKind};
use super::super::undeclared::is_built;
use super::super::value::{Poison, Value};
use super::Place;
use super::foreign_value::told_comma;
use super::item_suggestion::{block_for, told_directive};
use super::place::{is_of_no_part, stands_alone};

impl Evaluator<'_> {
    /// Reports an item that the block does not accept, and skips what belongs to it.
    pub(in crate::evaluate) fn unexpected(&mut self, token: &Token, place: Place) {
        // Items after an unsupported word may belong to it.
        let of_poison = self.poison.is_some();
        match &token.kind {
            TokenKind::Comma => self.warn_of_comma(token, place),
            TokenKind::Semicolon => self.warn_of_semicolon(token, place),
            // The next item is not checked for a name: it may declare it.
            TokenKind::Word(word) if of_poison && stands_alone(*word) && self.is_before_block() => {
                self.unexpected_word(token, *word, place);
            }
            TokenKind::Word(word) if of_poison => {
                let poison = Poison::new(*word, token.here.site(token.span));
                match place.holds(*word) {
                    // No part of a light that is not built is one of a camera, nor of a texture one of a finish.
                    _ if is_of_no_part(*word, place) => {
                        self.unexpected_word(token, *word, place);
                    }
                    true => self.pass_not_built(token, *word),
                    false => self.skip_arguments(*word),
                }
                // Items of an unsupported pattern belong to it.
                if place.holds(*word) && !word.is_built() && word.family() != Family::PatternItem {
                    self.set_poison(poison);
                }
            }
            TokenKind::Literal(_) if of_poison => {}
            TokenKind::Block(contents) if of_poison => {
                self.inside_block(&token.here, *contents, token.span, Self::run_items);
            }
            TokenKind::Entry(items) if of_poison => {
                self.inside(&token.here, *items, Self::run_items);
            }
            TokenKind::Word(word) => self.unexpected_word(token, *word, place),
            TokenKind::Expression(id) => {
                let id = *id;
                match token.here.unit.expression(id).kind {
                    ExpressionKind::Name(name) => {
                        let symbol = token.here.symbol(name);
                        match self.scopes.read(symbol).cloned() {
                            None => self.unknown_word(token, token.span, place),
                            Some(Value::Poison(_) | Value::Broken)
                                if self.named_block(token, place) => {}
                            Some(Value::Poison(poison)) => {
                                self.is_of_place(token, poison, place);
                                self.set_poison(poison);
                            }
                            Some(Value::Broken) => self.broken_of_place(token, id, place),
                            Some(Value::Macro(_)) => {
                                self.macro_not_called(&token.here, symbol, token.span);
                                self.skip_values();
                                self.skip_block_of(token);
                            }
                            Some(value) => {
                                // `fov fov`, where a number has the name that another tool's word has.
                                let name = self.sources.text(token.span).to_owned();
                                let dialect = self.options.dialect;
                                let is_word = suggest::foreign(&name)
                                    .any(|ours| place.words(dialect).any(|word| word == ours));
                                if is_word && self.is_before_value() {
                                    return self.unknown_word(token, token.span, place);
                                }
                                self.unexpected_value(token, &value, place);
                            }
                        }
                    }
                    ExpressionKind::Call(callee, arguments) => {
                        let unknown = match callee {
                            Callee::Name(name, span) => {
                                let symbol = token.here.symbol(name);
                                self.scopes.slot(symbol).is_none().then_some((symbol, span))
                            }
                            Callee::Word(..) | Callee::Element(_) => None,
                        };
                        match unknown {
                            Some((symbol, span)) => {
                                self.run_arguments(&token.here, arguments);
                                let text = self.sources.text(span).to_owned();
                                // `translate(…)`, as other languages write it, or a macro.
                                let dialect = self.options.dialect;
                                let words = || place.words(dialect);
                                let near = self.near(span, Asked::Call, || {
                                    // A word without a block.
                                    let moves = |word: Word| word.family() == Family::Transform;
                                    let ours = |word: &&str| {
                                        Word::from_name(word).is_some_and(moves)
                                            && words().any(|own| own == *word)
                                    };
                                    suggest::foreign(&text)
                                        .find(ours)
                                        .or_else(|| suggest::closest(&text, words()))
                                });
                                match near.filter(|near| is_built(near)) {
                                    Some(_) => self.unknown_word(token, span, place),
                                    None => match told_directive(&text, span, place) {
                                        Some(told) => drop(self.report(&token.here, told)),
                                        None => drop(self.undeclared(&token.here, symbol, span)),
                                    },
                                }
                            }
                            None => {
                                if let Ok(value) = self.expression(&token.here, id) {
                                    self.unexpected_value(token, &value, place);
                                }
                            }
                        }
                    }
                    _ => {
                        if let Ok(value) = self.expression(&token.here, id) {
                            self.unexpected_value(token, &value, place);
                        }
                    }
                }
            }
            TokenKind::Literal(value) => {
                let value = value.as_ref().clone();
                self.unexpected_value(token, &value, place);
            }
            TokenKind::Block(contents) => {
                let doubled = || self.doubled_braces(token.span);
                let braced = self.braced_macro(token.span).or_else(doubled);
                let diagnostic = match braced.or_else(|| self.braced_modifiers(token.span, place)) {
                    Some(told) => told,
                    None => {
                        let message = format!(
                            "a block without a word before it has no meaning {}",
                            place.name()
                        );
                        let told = Diagnostic::new(Code::ExtraPart, message)
                            .at(opener(token.span), "expected a word before this");
                        self.braced_colors(token.span, place, told)
                    }
                };
                if place.word.is_none() && self.is_prose(token.span) {
                    let diagnostic =
                        diagnostic.help("a comment stands behind `//`, or between `/*` and `*/`");
                    self.report(&token.here, diagnostic);
                    return;
                }
                self.report(&token.here, diagnostic);
                self.inside_block(&token.here, *contents, token.span, Self::run_items);
            }
            TokenKind::Entry(items) => {
                self.inside(&token.here, *items, Self::run_items);
                self.loose_entries(token, place);
            }
        }
    }

    /// Handles `Column { translate x }` where objects are expected, for a name that was reported or is
    /// unsupported.
    fn named_block(&mut self, token: &Token, place: Place) -> bool {
        let Some(Token { kind: TokenKind::Block(contents), here, span }) = self.peek().cloned()
        else {
            return false;
        };
        if !place.families.contains(&Family::Shape) {
            return false;
        }
        self.next();
        let name = self.sources.text(token.span).to_owned();
        let text = format!("object {{ {name}");
        let message = format!("`{name}` is a declared name, and no word that opens a block");
        let diagnostic = Diagnostic::new(Code::ExtraPart, message)
            .at(token.span, "expected a word before it")
            .help(format!("write `{text} … }}`"))
            .fix(token.span.to(opener(span)), text);
        self.report(&token.here, diagnostic);
        let before = self.told();
        self.inside_block(&here, contents, span, Self::run_items);
        self.take_back(before);
        true
    }

    fn unexpected_value(&mut self, token: &Token, value: &Value, place: Place) {
        if let Value::Poison(poison) = value {
            self.is_of_place(token, *poison, place);
            self.set_poison(*poison);
            return;
        }
        // `sphere { pigment { … } 0, 1 }`: that the parts come first was told where one was missing.
        if matches!(token.kind, TokenKind::Expression(_) | TokenKind::Literal(_))
            && self.lacks_part()
        {
            return self.skip_values();
        }
        // An argument of a macro that was reported, or two that were swapped.
        if let TokenKind::Expression(_) = token.kind
            && self.is_refused_again(&token.here, token.span, value)
        {
            return self.skip_values();
        }
        let told = match (place.word, value) {
            (Some(Word::Object), Value::Object(_)) => self.second_of_object(token.span),
            // A decimal comma is reported as such.
            (Some(solid), Value::Number(_) | Value::Vector(_))
                if self.comma_before(token.span).is_none() =>
            {
                self.mistaken_parts(solid, token.span)
            }
            _ => None,
        };
        if let Some(told) = told.or_else(|| self.needless_value(token, value, place)) {
            self.report(&token.here, told);
            return self.skip_values();
        }
        let kind = value.kind();
        let named = self.sources.text(token.span);
        let message = match place.word {
            Some(of) if self.scopes.symbol(named).is_some() => {
                format!("`{named}` is {kind}, and stands in `{}`", of.name())
            }
            _ => format!("{kind} has no meaning here {}", place.name()),
        };
        let mut diagnostic = Diagnostic::new(Code::ExtraPart, message).at(
            token.span,
            match place.word {
                Some(_) => "expected a word of this block, or its end",
                None => "expected an object, a light, a camera, or settings",
            },
        );
        let text = self.sources.text(token.span).to_owned();
        let of_object = place.families.contains(&Family::Modifier);
        let of_texture = of_object || matches!(place.word, Some(Word::Texture | Word::Default));
        let of_material = place.word == Some(Word::Material);
        let wrapper = match value {
            Value::Texture(_) if of_object || of_material => Some("texture"),
            Value::Interior(_) if of_material => Some("interior"),
            Value::Pigment(_) if of_texture => Some("pigment"),
            Value::Finish(_) if of_texture => Some("finish"),
            Value::Interior(_) if of_object => Some("interior"),
            Value::Material(_) if of_object => Some("material"),
            Value::Transform(_) if place.families.contains(&Family::Transform) => Some("transform"),
            Value::Object(_) if place.families.contains(&Family::Shape) => Some("object"),
            Value::Camera(_) if place.word.is_none() => Some("camera"),
            Value::SkySphere(_) if place.word.is_none() => Some("sky_sphere"),
            Value::Fog(_) if place.word.is_none() => Some("fog"),
            Value::Rainbow(_) if place.word.is_none() => Some("rainbow"),
            Value::Color(_) if of_texture => Some("pigment"),
            _ => None,
        };
        if let Some(wrapper) = wrapper
            && let TokenKind::Expression(_) = token.kind
        {
            let text = format!("{wrapper} {{ {text} }}");
            // `Ball { translate x }`
            if let Some(Token { kind: TokenKind::Block(contents), here, span: block }) =
                self.peek().cloned()
            {
                self.next();
                let name = self.sources.text(token.span);
                let text = format!("{wrapper} {{ {name}");
                let diagnostic = diagnostic
                    .help(format!("write `{text} … }}`"))
                    .fix(token.span.to(opener(block)), text);
                self.report(&token.here, diagnostic);
                let before = self.told();
                self.inside_block(&here, contents, block, Self::run_items);
                self.take_back(before);
                return;
            }
            let (whole, text) = match (value, place.word) {
                // `Part translate x`
                (Value::Object(_), None) => {
                    let name = self.sources.text(token.span);
                    diagnostic.message = format!("`{name}` is an object, and placed by `object`");
                    let whole = self.line_of_modifiers(token.span);
                    (whole, format!("{wrapper} {{ {} }}", self.sources.text(whole)))
                }
                _ => (token.span, text),
            };
            diagnostic = diagnostic.help(format!("write `{text}`")).fix(whole, text);
        } else if let Some(told) = self.quoted_color(token, value).filter(|_| {
            matches!(place.word, Some(Word::Pigment | Word::Texture | Word::Background))
        }) {
            diagnostic = told;
        } else if let Some(told) = self.angle_behind_axis(token, value) {
            diagnostic = told;
        } else if let Some((span, number)) = self.comma_before(token.span) {
            self.declare_with_point(span, &number);
            diagnostic = told_comma(self.sources.text(span), span, number);
        } else if let Some(help) = place.word.and_then(|word| block_for(value, word, &text)) {
            diagnostic = diagnostic.help(help);
        } else if let (
            Some(
                word @ (Word::Lathe | Word::Polygon | Word::Prism | Word::Sor | Word::SphereSweep),
            ),
            Value::Vector(_),
        ) = (place.word, value)
        {
            let message = format!("`{}` has more points than its number of them says", word.name());
            diagnostic =
                Diagnostic::new(Code::WrongArity, message).at(token.span, "this is one more");
            diagnostic = match self.count_before(token.span) {
                Some((count, found)) => {
                    let text = self.sources.text(count);
                    let help =
                        format!("if these are all right, write `{found}` instead of `{text}`");
                    diagnostic
                        .also(count, "so many were announced")
                        .help(help)
                        .fix(count, found.to_string())
                }
                None => diagnostic.help("the number before the points says how many follow"),
            };
        } else if let Some(word) = place.word {
            diagnostic = diagnostic.help(self.form_of(word));
        }
        self.report(&token.here, diagnostic);
        self.skip_values();
    }

    /// Skips the modifiers after an object's name that are outside its block; returns the span up to the last
    /// one on its line.
    pub(super) fn line_of_modifiers(&mut self, name: Span) -> Span {
        let changes = |kind: &TokenKind| match kind {
            TokenKind::Word(word) => {
                word.family() == Family::Transform
                    || matches!(word, Word::Pigment | Word::Texture | Word::Finish | Word::Material)
            }
            _ => false,
        };
        let mut whole = name;
        while let Some(word) = self.next_if(changes) {
            let text = self.sources.get(name.file).text.get(name.start as usize..).unwrap_or("");
            let line = text.lines().next().unwrap_or("");
            let line = line.split("//").next().unwrap_or("").trim_end_matches([' ', '\t', ';']);
            if word.span.file == name.file && word.span.start < name.start + line.len() as u32 {
                whole.end = name.start + line.len() as u32;
            }
            self.skip_values();
            if let Some(Token { kind: TokenKind::Block(contents), here, span }) =
                self.next_if(|kind| matches!(kind, TokenKind::Block(_)))
            {
                self.inside_block(&here, contents, span, Self::run_items);
            }
        }
        whole
    }

    /// Skips the braces in the place of a call's parentheses.
    fn skip_block_of(&mut self, token: &Token) {
        let Some(Token { kind: TokenKind::Block(contents), here, span }) = self.peek().cloned()
        else {
            return;
        };
        let text = &self.sources.get(token.span.file).text;
        let between = text.get(token.span.end as usize..span.start as usize);
        if span.file != token.span.file || !between.is_some_and(|text| text.trim().is_empty()) {
            return;
        }
        self.next();
        let before = self.told();
        self.inside_block(&here, contents, span, Self::run_items);
        self.take_back(before);
    }
}

/// Returns the first character of a bracketed span.
pub(super) fn opener(span: Span) -> Span {
    Span { end: span.start + 1, ..span }
}
