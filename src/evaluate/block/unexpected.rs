//! What to say of an item that its block has no use for.

use crate::diagnostic::{Code, Diagnostic, suggest};
use crate::source::{Site, Span};
use crate::syntax::ast::{Callee, ExpressionKind};
use crate::vocabulary::{Family, Role, Word};

use super::super::remembered::Asked;
use super::super::stream::{Token, TokenKind};
use super::super::undeclared::is_built;
use super::super::value::{Poison, Value};
use super::super::{Evaluator, Reported};
use super::Place;
use super::habit::told_comma;
use super::place::{home, is_at_top_level, stands_alone};
use super::unknown::{is_transform, told_directive};

impl Evaluator<'_> {
    /// An item that the block does not know: says so, and passes over what belongs to it.
    pub(in crate::evaluate) fn unexpected(&mut self, token: &Token, place: Place) {
        // What stands behind a word that is not built may belong to it.
        let of_poison = self.poison.is_some();
        match &token.kind {
            TokenKind::Comma => self.warn_of_comma(token, place),
            TokenKind::Semicolon => self.warn_of_semicolon(token, place),
            // What comes next is looked at for no name: it may declare it.
            TokenKind::Word(word) if of_poison && stands_alone(*word) && self.is_before_block() => {
                self.unexpected_word(token, *word, place);
            }
            TokenKind::Word(word) if of_poison => {
                let poison = Poison::new(*word, token.here.site(token.span));
                match place.holds(*word) {
                    true => self.pass_not_built(token, *word),
                    // No part of a light that is not built is one of a camera.
                    false
                        if place.word == Some(Word::LightSource)
                            && word.family() == Family::Camera =>
                    {
                        self.unexpected_word(token, *word, place);
                    }
                    false => self.skip_arguments(*word),
                }
                // What a pattern that is not built has goes with it.
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
                            Some(Value::Poison(poison)) => {
                                self.is_of_place(token, poison, place);
                                self.set_poison(poison);
                            }
                            Some(Value::Broken) => {}
                            Some(Value::Macro(_)) => {
                                self.macro_not_called(&token.here, symbol, token.span);
                                self.skip_values();
                                self.skip_block_of(token);
                            }
                            Some(value) => self.unexpected_value(token, &value, place),
                        }
                    }
                    ExpressionKind::Call(callee, arguments) => {
                        let unknown = match callee {
                            Callee::Name(name, span) => {
                                let symbol = token.here.symbol(name);
                                self.scopes.slot(symbol).is_none().then_some((symbol, span))
                            }
                            Callee::Word(..) => None,
                        };
                        match unknown {
                            Some((symbol, span)) => {
                                self.run_arguments(&token.here, arguments);
                                let text = self.sources.text(span).to_owned();
                                // `translate(…)`, as other languages write it, or a macro.
                                let words = place.words(self.options.dialect);
                                let near =
                                    self.near(span, Asked::Call, || suggest::closest(&text, words));
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
                let diagnostic = Diagnostic::new(
                    Code::ExtraPart,
                    format!("a block without a word before it has no meaning {}", place.name()),
                )
                .at(opener(token.span), "expected a word before this");
                self.report(&token.here, diagnostic);
                self.inside_block(&token.here, *contents, token.span, Self::run_items);
            }
            TokenKind::Entry(items) => {
                let diagnostic = Diagnostic::new(
                    Code::ExtraPart,
                    format!("an entry in brackets has no meaning {}", place.name()),
                )
                .at(opener(token.span), "entries stand in maps: `color_map { [0 …] [1 …] }`");
                self.report(&token.here, diagnostic);
                self.inside(&token.here, *items, Self::run_items);
            }
        }
    }

    fn unexpected_value(&mut self, token: &Token, value: &Value, place: Place) {
        if let Value::Poison(poison) = value {
            self.is_of_place(token, *poison, place);
            self.set_poison(*poison);
            return;
        }
        // `sphere { pigment { … } 0, 1 }`: that the parts come first was told where one was missing.
        let block = self.blocks.last().map(|block| block.span);
        let was_missing = |at: Site| {
            block.is_some_and(|block| {
                at.span.file == block.file
                    && block.start <= at.span.start
                    && at.span.end <= block.end
            })
        };
        if matches!(token.kind, TokenKind::Expression(_) | TokenKind::Literal(_))
            && self.missing_at.is_some_and(was_missing)
        {
            return self.skip_values();
        }
        // An argument of a macro that was told, or two that changed places.
        if let TokenKind::Expression(_) = token.kind
            && self.is_refused_again(&token.here, token.span, value)
        {
            return self.skip_values();
        }
        let kind = value.kind();
        let mut diagnostic = Diagnostic::new(
            Code::ExtraPart,
            format!("{kind} has no meaning here {}", place.name()),
        )
        .at(
            token.span,
            match place.word {
                Some(_) => "expected a word of this block, or its end",
                None => "expected an object, a light, a camera, or settings",
            },
        );
        let text = self.sources.text(token.span).to_owned();
        let of_object = place.families.contains(&Family::Modifier);
        let of_texture = of_object || matches!(place.word, Some(Word::Texture | Word::Default));
        let wrapper = match value {
            Value::Texture(_) if of_object => Some("texture"),
            Value::Pigment(_) if of_texture => Some("pigment"),
            Value::Finish(_) if of_texture => Some("finish"),
            Value::Interior(_) if of_object => Some("interior"),
            Value::Material(_) if of_object => Some("material"),
            Value::Transform(_) if place.families.contains(&Family::Transform) => Some("transform"),
            Value::Object(_) if place.families.contains(&Family::Shape) => Some("object"),
            Value::Camera(_) if place.word.is_none() => Some("camera"),
            Value::SkySphere(_) if place.word.is_none() => Some("sky_sphere"),
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
            diagnostic = diagnostic.help(format!("write `{text}`")).fix(token.span, text);
        } else if let Some(told) = self.angle_behind_axis(token, value) {
            diagnostic = told;
        } else if let Some((span, number)) = self.comma_before(token.span) {
            self.declare_with_point(span, &number);
            diagnostic = told_comma(self.sources.text(span), span, number);
        } else if let (Some(word), Value::Texture(_)) = (place.word, value)
            && matches!(word, Word::Pigment | Word::Finish)
        {
            let own = word.name();
            diagnostic =
                diagnostic.help(format!("write `texture {{ {text} }}` instead of this `{own}`"));
        } else if let (
            Some(
                word @ (Word::Lathe | Word::Polygon | Word::Prism | Word::Sor | Word::SphereSweep),
            ),
            Value::Vector(_),
        ) = (place.word, value)
        {
            let message = format!("`{}` has more points than its number of them says", word.name());
            diagnostic = Diagnostic::new(Code::WrongArity, message)
                .at(token.span, "this is one more")
                .help("the number before the points says how many follow");
        } else if let Some(word) = place.word {
            diagnostic = diagnostic.help(self.form_of(word));
        }
        self.report(&token.here, diagnostic);
        self.skip_values();
    }

    pub(super) fn unexpected_word(&mut self, token: &Token, word: Word, place: Place) {
        if let Some(today) = word.today() {
            self.old_word(token, word, today);
            return;
        }
        let is_part = match place.word {
            None => !is_at_top_level(word) && home(word).is_some_and(|home| home != word),
            // The map of a texture is one of textures.
            Some(Word::Texture) => matches!(home(word), Some(Word::Pigment | Word::Normal)),
            Some(_) => false,
        };
        if !is_part && place.holds(word) && (!word.is_built() || place.others.contains(&word)) {
            let poison = Poison::new(word, token.here.site(token.span));
            self.pass_not_built(token, word);
            self.set_poison(poison);
            return;
        }
        if self.missing_at == Some(token.here.site(token.span)) {
            // Told: a value should stand here.
            return self.skip_arguments(word);
        }
        let has_block = self.is_before_block();
        let (name, dialect) = (word.name(), self.options.dialect);
        let near =
            suggest::foreign(name).find(|near| place.words(dialect).any(|word| word == *near));
        if word.family() == Family::Directive {
            return self.directive_without_sign(token, word);
        }
        if matches!(word, Word::Degrees | Word::Radians)
            && let Some(diagnostic) = self.unit_of_angle(token, word)
        {
            self.report(&token.here, diagnostic);
            return;
        }
        let longer = || {
            let longer = |other: &&str| {
                let rest = other.strip_prefix(name);
                name.contains('_') && rest.is_some_and(|rest| rest.starts_with('_'))
            };
            let mut words = place.words(dialect).filter(longer);
            words.next().filter(|_| words.next().is_none()).and_then(Word::from_name)
        };
        let meant = place.meant(word, has_block).or_else(|| longer().filter(|_| !has_block));
        let diagnostic = if let Some(meant) = meant {
            let (meant, sentence) = (meant.name(), meant.sentence());
            let message = format!("`{name}` has no meaning {}", place.name());
            let diagnostic = Diagnostic::new(Code::UnknownWord, message)
                .at(token.span, format!("did you mean `{meant}`?"))
                .help(sentence.to_owned());
            // What stands in the block of a `sky` is rarely what a `sky_sphere` takes.
            if word == Word::Sky { diagnostic } else { diagnostic.fix(token.span, meant) }
        // Of a `julia_fractal` it is a function, and everywhere else what others call a box.
        } else if let (Some(near), false) = (near, word.is_built() && word != Word::Cube) {
            Diagnostic::new(Code::ForeignWord, format!("`{name}` is not a word {}", place.name()))
                .at(token.span, format!("did you mean `{near}`?"))
                .help(format!("replace it with `{near}`"))
                .fix(token.span, near)
        } else if has_block
            && place.holds(word)
            && (matches!(word.family(), Family::Shape | Family::Csg) || word == Word::LightSource)
        {
            let of = place.word.map_or("", Word::name);
            Diagnostic::new(
                Code::MisplacedBlock,
                format!("this `{name}` stands after the modifiers of `{of}`"),
            )
            .at(token.span, format!("the parts of `{of}` come first"))
        } else if has_block {
            let is_object =
                matches!(word.family(), Family::Shape | Family::Csg) || word == Word::Object;
            let label = match home(word).filter(|home| *home != word) {
                _ if is_object && place.word.is_some() => {
                    "objects are put together in a `union`".to_owned()
                }
                Some(home) if word == Word::Media => {
                    format!("it belongs in `{} {{ … }}`, or at the top level", home.name())
                }
                _ if is_at_top_level(word) => "it belongs at the top level".to_owned(),
                Some(home) => format!("it belongs in `{} {{ … }}`", home.name()),
                None if !matches!(word.role(), Role::Statement) => {
                    "it stands for a value, in expressions".to_owned()
                }
                None if place.word.is_none() => "it belongs in an object".to_owned(),
                None if word.family() == Family::Texture && place.word == Some(Word::Material) => {
                    "it belongs in the `texture { … }` of the `material`".to_owned()
                }
                None if word.family() == Family::Texture
                    && matches!(place.word, Some(Word::Pigment | Word::Finish)) =>
                {
                    let of = place.word.map_or("", Word::name);
                    format!("it stands beside `{of}`, not in it")
                }
                None => "it belongs elsewhere".to_owned(),
            };
            Diagnostic::new(Code::MisplacedBlock, format!("`{name}` cannot stand {}", place.name()))
                .at(token.span, label)
        } else {
            let mut diagnostic = Diagnostic::new(
                Code::UnknownWord,
                format!("`{name}` has no meaning {}", place.name()),
            )
            .at(token.span, word.sentence().to_owned());
            if let Some(home) = home(word).filter(|home| Some(*home) != place.word) {
                diagnostic = diagnostic.help(format!("it belongs in `{} {{ … }}`", home.name()));
            } else if let Some(home) = place.word {
                diagnostic = diagnostic.help(home.sentence().to_owned());
            } else if matches!(word.family(), Family::Transform | Family::Modifier) {
                diagnostic =
                    diagnostic.help(format!("it belongs in an object: `sphere {{ … {name} … }}`"));
            }
            diagnostic
        };
        let diagnostic = match self.openers.last().copied() {
            Some(span) if has_block => diagnostic.also(span, "inside this block"),
            _ => diagnostic,
        };
        match near {
            Some(near) if is_transform(near) => self.skip_values(),
            _ => self.skip_arguments(word),
        }
        let own = home(word).filter(|home| *home != word && Some(*home) != place.word);
        let beside = match own.filter(|_| near.is_none() && meant.is_none()) {
            Some(own) => self.skip_of_home(own, place),
            None => Vec::new(),
        };
        let diagnostic = match beside.as_slice() {
            [] => diagnostic,
            beside => {
                diagnostic.help(format!("so does what stands behind it: {}", beside.join(", ")))
            }
        };
        self.report(&token.here, diagnostic);
    }

    /// The braces that stand where a call has parentheses.
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

    /// `composite { … }`, `alpha 0.5`: the word of today is meant.
    pub(super) fn old_word(&mut self, token: &Token, word: Word, today: Word) -> Reported {
        let (name, meant) = (word.name(), today.name());
        let message = format!("`{name}` is a word of old versions");
        let diagnostic = Diagnostic::new(Code::UnknownWord, message)
            .at(token.span, format!("today it is `{meant}`"))
            .help(format!("write `{meant}`"))
            .fix(token.span, meant);
        let reported = self.report(&token.here, diagnostic);
        if !self.judge_block(token, today) {
            self.skip_values();
        }
        reported
    }

    /// `version 3.7;`, `debug "…"`: a directive's word that `syntax/habits` leaves as it is.
    fn directive_without_sign(&mut self, token: &Token, word: Word) {
        let name = word.name();
        let message = format!("`{name}` is written with a `#` before it");
        let diagnostic = Diagnostic::new(Code::UnknownWord, message)
            .at(token.span, format!("did you mean `#{name}`?"))
            .help(word.sentence().to_owned())
            .fix(token.span, format!("#{name}"));
        self.report(&token.here, diagnostic);
        self.skip_values();
    }
}

/// The first character of a bracketed span.
fn opener(span: Span) -> Span {
    Span { end: span.start + 1, ..span }
}
