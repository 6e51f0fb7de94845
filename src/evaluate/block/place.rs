//! What may stand where, and what to say of what may not.

use crate::diagnostic::{Code, Diagnostic, suggest};
use crate::source::Span;
use crate::syntax::ast::ExpressionKind;
use crate::vocabulary::{Family, Role, Word};

use super::super::Evaluator;
use super::super::stream::{Token, TokenKind};
use super::super::value::{Poison, Value};

/// A kind of block, and the families of words that may stand in it.
#[derive(Debug, Clone, Copy)]
pub(in crate::evaluate) struct Place {
    /// The word that opens it; `None` is the scene itself.
    pub word: Option<Word>,
    pub families: &'static [Family],
    /// Words of other families that may stand in it, too.
    pub others: &'static [Word],
}

impl Place {
    pub const SCENE: Self = Self {
        word: None,
        families: &[
            Family::Shape,
            Family::Csg,
            Family::Camera,
            Family::Light,
            Family::Atmosphere,
            Family::Setting,
            Family::Directive,
        ],
        others: &[],
    };
    pub const PIGMENT: Self = Self {
        word: Some(Word::Pigment),
        families: &[
            Family::Pattern,
            Family::PatternItem,
            Family::Color,
            Family::Transform,
            Family::Texture,
        ],
        others: &[Word::NoiseGenerator, Word::Interior, Word::Exponent, Word::Function, Word::Df3],
    };
    pub const COLOR_MAP: Self =
        Self { word: Some(Word::ColorMap), families: &[Family::Color], others: &[] };
    pub const FINISH: Self =
        Self { word: Some(Word::Finish), families: &[Family::FinishItem], others: &[] };
    pub const REFLECTION: Self = Self {
        word: Some(Word::Reflection),
        families: &[Family::FinishItem, Family::Color],
        others: &[],
    };
    pub const TEXTURE: Self = Self {
        word: Some(Word::Texture),
        families: &[Family::Texture, Family::Transform, Family::Pattern, Family::PatternItem],
        others: &[Word::NoiseGenerator, Word::Interior, Word::Exponent],
    };
    pub const DEFAULT: Self = Self {
        word: Some(Word::Default),
        families: &[Family::Texture, Family::Setting, Family::Camera],
        others: &[],
    };
    pub const TRANSFORM: Self =
        Self { word: Some(Word::TransformWord), families: &[Family::Transform], others: &[] };
    pub const CAMERA: Self = Self {
        word: Some(Word::Camera),
        families: &[Family::Camera, Family::Transform, Family::PatternItem, Family::Texture],
        others: &[Word::Cylinder],
    };
    pub const LIGHT: Self = Self {
        word: Some(Word::LightSource),
        families: &[Family::Light, Family::Transform, Family::Color, Family::Interior],
        others: &[Word::Falloff, Word::Orient, Word::NoImage, Word::NoShadow, Word::NoReflection],
    };
    pub const BACKGROUND: Self =
        Self { word: Some(Word::Background), families: &[Family::Color], others: &[] };
    pub const SKY_SPHERE: Self = Self {
        word: Some(Word::SkySphere),
        families: &[Family::Texture, Family::Transform, Family::FinishItem],
        others: &[],
    };
    pub const SETTINGS: Self = Self {
        word: Some(Word::GlobalSettings),
        families: &[Family::Setting, Family::Interior],
        others: &[Word::Subsurface, Word::NoiseGenerator],
    };

    /// The block of a shape.
    pub fn shape(word: Word) -> Self {
        const FAMILIES: &[Family] = &[
            Family::Modifier,
            Family::Transform,
            Family::Texture,
            Family::Interior,
            Family::ShapeItem,
        ];
        Self { word: Some(word), families: FAMILIES, others: &[] }
    }

    /// The block of a union and its kin: shapes and modifiers.
    pub fn csg(word: Word) -> Self {
        const FAMILIES: &[Family] = &[
            Family::Shape,
            Family::Csg,
            Family::Light,
            Family::Modifier,
            Family::Transform,
            Family::Texture,
            Family::Interior,
        ];
        Self { word: Some(word), families: FAMILIES, others: &[] }
    }

    fn name(self) -> String {
        match self.word {
            Some(word) => format!("in `{}`", word.name()),
            None => "in the scene itself".to_owned(),
        }
    }

    /// Whether a word fits: by its family, and by its block if it has one.
    fn holds(self, word: Word) -> bool {
        (self.families.contains(&word.family()) || self.others.contains(&word))
            && matches!(word.role(), Role::Statement)
            && word.block().is_none_or(|block| Some(block) == self.word)
    }

    fn words(self) -> impl Iterator<Item = &'static str> {
        Word::ALL.iter().filter(move |word| self.holds(**word)).map(|word| word.name())
    }
}

impl Evaluator<'_> {
    /// An item that the block does not know: says so, and passes over what belongs to it.
    pub(in crate::evaluate) fn unexpected(&mut self, token: &Token, place: Place) {
        // Behind a word that is not built, what stands here may belong to it.
        let of_poison = self.poison.is_some();
        match &token.kind {
            TokenKind::Comma | TokenKind::Semicolon => {}
            TokenKind::Word(word) if of_poison => self.skip_arguments(*word),
            TokenKind::Literal(_) if of_poison => {}
            TokenKind::Block(items) | TokenKind::Entry(items) if of_poison => {
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
                            Some(Value::Poison(poison)) => self.set_poison(poison),
                            Some(Value::Broken) => {}
                            Some(value) => self.unexpected_value(token, &value, place),
                        }
                    }
                    ExpressionKind::Call(callee, arguments) => {
                        let callee_span = match callee {
                            crate::syntax::ast::Callee::Name(name, span) => {
                                let symbol = token.here.symbol(name);
                                self.scopes.slot(symbol).is_none().then_some(span)
                            }
                            crate::syntax::ast::Callee::Word(..) => None,
                        };
                        match callee_span {
                            Some(span) => {
                                self.run_arguments(&token.here, arguments);
                                self.unknown_word(token, span, place);
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
                let value = value.clone();
                self.unexpected_value(token, &value, place);
            }
            TokenKind::Block(items) => {
                let diagnostic = Diagnostic::new(
                    Code::ExtraPart,
                    format!("a block without a word before it has no meaning {}", place.name()),
                )
                .at(opener(token.span), "expected a word before this");
                self.report(&token.here, diagnostic);
                self.inside(&token.here, *items, Self::run_items);
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

    pub(in crate::evaluate) fn set_poison(&mut self, poison: Poison) {
        self.poison.get_or_insert(poison);
    }

    fn unexpected_value(&mut self, token: &Token, value: &Value, place: Place) {
        if let Value::Poison(poison) = value {
            self.set_poison(*poison);
            return;
        }
        let kind = value.kind();
        let mut diagnostic = Diagnostic::new(
            Code::ExtraPart,
            format!("{kind} has no meaning here {}", place.name()),
        )
        .at(token.span, "expected a word of this block, or its end");
        let text = self.sources.text(token.span).to_owned();
        let wrapper = match value {
            Value::Texture(_) => Some("texture"),
            Value::Pigment(_) => Some("pigment"),
            Value::Finish(_) => Some("finish"),
            Value::Transform(_) => Some("transform"),
            Value::Object(_) => Some("object"),
            Value::Camera(_) => Some("camera"),
            Value::Color(_) if place.families.contains(&Family::Texture) => Some("pigment"),
            _ => None,
        };
        if let Some(wrapper) = wrapper
            && let TokenKind::Expression(_) = token.kind
        {
            let text = format!("{wrapper} {{ {text} }}");
            diagnostic = diagnostic.help(format!("write `{text}`")).fix(token.span, text);
        } else if let Some(word) = place.word {
            diagnostic = diagnostic.help(word.sentence().to_owned());
        }
        self.report(&token.here, diagnostic);
        self.skip_values();
    }

    fn unexpected_word(&mut self, token: &Token, word: Word, place: Place) {
        if place.holds(word) && (!word.is_built() || place.others.contains(&word)) {
            let poison = Poison { word, site: token.here.site(token.span) };
            self.skip_arguments(word);
            self.set_poison(poison);
            return;
        }
        let has_block = matches!(self.peek().map(|next| &next.kind), Some(TokenKind::Block(_)));
        let name = word.name();
        let near = suggest::foreign(name).filter(|near| place.words().any(|word| word == *near));
        let diagnostic = if let (Some(near), false) = (near, word.is_built()) {
            Diagnostic::new(Code::ForeignWord, format!("`{name}` is not a word {}", place.name()))
                .at(token.span, format!("did you mean `{near}`?"))
                .help(format!("replace it with `{near}`"))
                .fix(token.span, near)
        } else if has_block {
            let home = if Place::SCENE.holds(word) {
                "it belongs to the scene itself"
            } else {
                "it belongs elsewhere"
            };
            Diagnostic::new(Code::MisplacedBlock, format!("`{name}` cannot stand {}", place.name()))
                .at(token.span, home)
        } else {
            let mut diagnostic = Diagnostic::new(
                Code::UnknownWord,
                format!("`{name}` has no meaning {}", place.name()),
            )
            .at(token.span, format!("not a word of this block: {}", word.sentence()));
            if let Some(home) = place.word {
                diagnostic = diagnostic.help(home.sentence().to_owned());
            }
            diagnostic
        };
        let diagnostic = match self.openers.last().copied() {
            Some(span) if has_block => diagnostic.also(span, "inside this block"),
            _ => diagnostic,
        };
        self.report(&token.here, diagnostic);
        self.skip_arguments(word);
    }

    /// A name that is no word of the language and was never declared, where a word should stand.
    fn unknown_word(&mut self, token: &Token, span: Span, place: Place) {
        let name = self.sources.text(span).to_owned();
        let has_block = matches!(self.peek().map(|next| &next.kind), Some(TokenKind::Block(_)));
        let here = suggest::closest(&name, place.words()).or_else(|| {
            suggest::foreign(&name).filter(|word| place.words().any(|other| other == *word))
        });
        let declared = || self.scopes.visible().collect::<Vec<_>>();
        let near = match here {
            Some(word) => Some(word.to_owned()),
            None if has_block => {
                super::super::report::word_like(&name, |_| true).map(str::to_owned)
            }
            None => suggest::closest(&name, declared())
                .map(str::to_owned)
                .or_else(|| super::super::report::word_like(&name, |_| true).map(str::to_owned)),
        };
        let is_foreign = near.as_deref().is_some_and(|near| suggest::foreign(&name) == Some(near))
            && suggest::closest(&name, near.as_deref()).is_none();
        let code = if is_foreign { Code::ForeignWord } else { Code::UnknownWord };
        let mut diagnostic =
            Diagnostic::new(code, format!("`{name}` is not a word {}", place.name()));
        diagnostic = match near {
            Some(near) => diagnostic
                .at(span, format!("did you mean `{near}`?"))
                .help(format!("replace it with `{near}`"))
                .fix(span, near),
            None => diagnostic.at(span, "neither a word of the language nor a declared name"),
        };
        self.report(&token.here, diagnostic);
        self.skip_values();
        if matches!(self.peek().map(|next| &next.kind), Some(TokenKind::Block(_))) {
            // What is inside belongs to a word that is not known: run, but not judged.
            let before = self.diagnostics.len();
            if let Some(Token { kind: TokenKind::Block(items), here, .. }) = self.next() {
                self.inside(&here, items, Self::run_items);
            }
            self.diagnostics.forget_after(before);
        }
    }

    /// Passes over the values after a word, running what is in them.
    pub(in crate::evaluate) fn skip_values(&mut self) {
        loop {
            match self.peek().map(|token| (&token.kind, &token.here)) {
                Some((TokenKind::Comma | TokenKind::Literal(_), _)) => drop(self.next()),
                Some((TokenKind::Expression(id), here)) => {
                    let id = *id;
                    // A name that is not declared is the next mistake, not a part of this one.
                    if let ExpressionKind::Name(name) = here.unit.expression(id).kind {
                        let symbol = here.symbol(name);
                        if self.scopes.slot(symbol).is_none() {
                            return;
                        }
                    }
                    if let Some(token) = self.next() {
                        let before = self.diagnostics.len();
                        let _ = self.expression(&token.here, id);
                        self.diagnostics.forget_after(before);
                    }
                }
                _ => return,
            }
        }
    }

    /// Passes over the values and the block that belong to a word, running what is in them.
    pub(in crate::evaluate) fn skip_arguments(&mut self, word: Word) {
        if word == Word::Function {
            return self.skip_function();
        }
        loop {
            match self.peek().map(|token| &token.kind) {
                Some(TokenKind::Comma | TokenKind::Literal(_)) => drop(self.next()),
                Some(TokenKind::Expression(_)) => {
                    if let Some(Token { kind: TokenKind::Expression(id), here, .. }) = self.next() {
                        self.run_expression(&here, id);
                    }
                }
                Some(TokenKind::Entry(_)) => {
                    if let Some(Token { kind: TokenKind::Entry(items), here, .. }) = self.next() {
                        self.inside(&here, items, Self::run_items);
                    }
                }
                Some(TokenKind::Block(_)) => {
                    if let Some(Token { kind: TokenKind::Block(items), here, .. }) = self.next() {
                        self.inside(&here, items, Self::run_items);
                    }
                    return;
                }
                Some(TokenKind::Word(next))
                    if next.family() == Family::Color && word.family() != Family::Color =>
                {
                    drop(self.next());
                }
                Some(TokenKind::Word(_) | TokenKind::Semicolon) | None => return,
            }
        }
    }
}

/// The first character of a bracketed span.
fn opener(span: Span) -> Span {
    Span { end: span.start + 1, ..span }
}
