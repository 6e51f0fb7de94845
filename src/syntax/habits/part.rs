//! The parts of a block by name, as other languages write them: `sphere { center: 0, radius = 1 }`.

use super::Reader;
use crate::diagnostic::{Code, Diagnostic, suggest};
use crate::source::Span;
use crate::syntax::token::{Bracket, Head, Mark, Token, TokenKind};
use crate::vocabulary::{Family, Role, Word};

/// A bracket around the place reached.
pub(super) struct Inside {
    bracket: Bracket,
    /// The word before a brace.
    word: Option<Word>,
    /// How many parts have been named.
    parts: usize,
    /// What is said of all of them together.
    pub(super) told: Option<Diagnostic>,
}

impl Inside {
    /// The brace after a word.
    pub(super) fn opens(&self, word: Word) -> bool {
        self.bracket == Bracket::Brace && self.word == Some(word)
    }

    /// The brace of a map, in which brackets are entries.
    pub(super) fn is_map(&self) -> bool {
        self.word.is_some_and(|word| word.name().ends_with("_map"))
    }

    /// The brace of any word but one of values side by side.
    pub(super) fn has_word(&self) -> bool {
        self.bracket == Bracket::Brace && self.word.is_some_and(|word| word != Word::Array)
    }

    /// The brace of a word that holds objects, or of no word.
    pub(super) fn holds_objects(&self) -> bool {
        self.is(Bracket::Brace)
            && self.word.is_none_or(|word| word.family() == Family::Csg || word == Word::Object)
    }

    /// The brace of a list of points of two numbers each.
    pub(super) fn holds_flat_points(&self) -> bool {
        let lists = [Word::Polygon, Word::Prism, Word::Lathe, Word::Sor];
        self.bracket == Bracket::Brace && self.word.is_some_and(|word| lists.contains(&word))
    }

    /// The brace of a shape.
    pub(super) fn opens_shape(&self) -> bool {
        self.bracket == Bracket::Brace
            && self.word.is_some_and(|word| word.family() == Family::Shape)
    }

    pub(super) fn is(&self, bracket: Bracket) -> bool {
        self.bracket == bracket
    }
}

/// What other tools call the parts of a block that ours gives in an order: the parts in words, and their
/// names in that order.
fn parts(word: Word) -> Option<(&'static str, &'static [&'static [&'static str]])> {
    const CENTER: &[&str] = &["center", "centre", "location", "position", "pos", "origin", "c"];
    const RADIUS: &[&str] = &["radius", "r"];
    const BASE: &[&str] = &["base", "base_point", "from", "start", "bottom", "p1"];
    const CAP: &[&str] = &["cap", "cap_point", "to", "end", "top", "p2"];
    Some(match word {
        Word::Sphere => ("<center>, radius", &[CENTER, RADIUS]),
        Word::Box => (
            "<corner>, <corner>",
            &[
                &["corner1", "corner_1", "min", "minimum", "lower", "from", "start", "p1"],
                &["corner2", "corner_2", "max", "maximum", "upper", "to", "end", "p2"],
            ],
        ),
        Word::Plane => {
            ("<normal>, distance", &[&["normal", "n"], &["distance", "dist", "d", "offset"]])
        }
        Word::Cylinder => ("<base>, <cap>, radius", &[BASE, CAP, RADIUS]),
        Word::Cone => (
            "<base>, radius, <cap>, radius",
            &[BASE, &["base_radius", "radius1", "r1"], CAP, &["cap_radius", "radius2", "r2"]],
        ),
        Word::Torus => (
            "major radius, minor radius",
            &[
                &["major", "major_radius", "radius", "r1"],
                &["minor", "minor_radius", "tube_radius", "r2"],
            ],
        ),
        Word::LightSource => ("<location> color", &[&["location", "position", "pos", "origin"]]),
        _ => return None,
    })
}

/// Words whose one value stands in a block.
fn takes_block(word: Word) -> bool {
    matches!(
        word,
        Word::Pigment
            | Word::Texture
            | Word::Finish
            | Word::Normal
            | Word::Interior
            | Word::Background
    )
}

/// Words that say all by being there.
fn is_flag(word: Word) -> bool {
    matches!(
        word,
        Word::Shadowless
            | Word::NoShadow
            | Word::NoImage
            | Word::NoReflection
            | Word::Hollow
            | Word::Inverse
            | Word::Smooth
            | Word::DoubleIlluminate
            | Word::Open
            | Word::Sturm
            | Word::Jitter
            | Word::Spotlight
            | Word::Orthographic
            | Word::Perspective
    )
}

impl Reader<'_> {
    /// Returns whether a word opens a block, as in `sphere {`: most words do, and few habits begin so.
    pub(super) fn opens_block(&self, word: Word) -> bool {
        self.is(1, Mark::Open(Bracket::Brace))
            && word.role() == Role::Statement
            && matches!(word.family(), Family::Shape | Family::Csg | Family::Texture)
    }

    pub(super) fn enter(&mut self, bracket: Bracket, before: Option<&Token>) {
        let word = match before.map(|token| token.kind) {
            Some(TokenKind::Word(word)) if bracket == Bracket::Brace => Some(word),
            // `light { position: … }`: as what it is meant.
            Some(TokenKind::Name) if bracket == Bracket::Brace => before
                .and_then(|name| self.text.get(name.start as usize..name.end as usize))
                .and_then(|name| suggest::foreign(name).next())
                .and_then(Word::from_name)
                .filter(|word| parts(*word).is_some()),
            _ => None,
        };
        self.inside.push(Inside { bracket, word, parts: 0, told: None });
    }

    pub(super) fn leave(&mut self, inside: Inside) {
        if let Some(told) = inside.told {
            self.diagnostics.push(told);
        }
    }

    /// `radius = 1`, `radius: 1`, `center <0, 0, 0>`, `pigment: rgb 1`.
    pub(super) fn part(&mut self, meant: &mut Vec<Token>) -> bool {
        let Some(Inside { bracket: Bracket::Brace, word: Some(opener), parts: named, .. }) =
            self.inside.last()
        else {
            return false;
        };
        let (opener, named) = (*opener, *named);
        let before = meant.last().map(|token| token.kind);
        let declared = matches!(
            before,
            Some(
                TokenKind::Directive(Head::Declare | Head::Local)
                    | TokenKind::Word(Word::Deprecated | Word::Once)
                    | TokenKind::Mark(Mark::Dot)
            )
        );
        if declared || opener == Word::Function {
            return false;
        }
        let equals = self.is(1, Mark::Equal) && !(self.is(2, Mark::Equal) && self.touches(2));
        let signed = equals || self.is(1, Mark::Colon);
        // A name and a value side by side; nothing that a declared name could be.
        let first = matches!(before, Some(TokenKind::Mark(Mark::Open(_) | Mark::Comma)));
        let bare = (first || named > 0)
            && matches!(
                self.kind(1),
                Some(TokenKind::Number | TokenKind::Triple | TokenKind::Mark(Mark::Less))
            );
        if !signed && (!bare || parts(opener).is_none()) {
            return false;
        }
        let quoted = self.kind(0) == Some(TokenKind::String);
        let name = self.slice(0).trim_matches('"').to_owned();
        // `"radius": 1`, as in JSON.
        if quoted && !(signed && self.is(1, Mark::Colon)) {
            return false;
        }
        let lower = name.to_lowercase();
        let position = parts(opener)
            .and_then(|(_, parts)| parts.iter().position(|part| part.contains(&lower.as_str())))
            .filter(|_| signed || !self.declares_anywhere(&name));
        match position {
            Some(position) => self.named_part(opener, position, signed),
            None if signed && self.means_word(&name) => self.sign_after_word(meant, &name),
            _ => false,
        }
    }

    /// Whether a name stands for a word of some block.
    fn means_word(&self, name: &str) -> bool {
        match self.kind(0) {
            Some(TokenKind::Word(word)) => word.role() == Role::Statement,
            Some(TokenKind::String) => Word::from_name(name).is_some(),
            _ => {
                suggest::foreign(name).next().is_some()
                    || Word::from_name(&name.to_lowercase()).is_some()
                    || Word::ALL.iter().any(|word| word.block().is_some() && word.name() == name)
            }
        }
    }

    /// The name goes; its value stands in its place.
    fn named_part(&mut self, opener: Word, position: usize, signed: bool) -> bool {
        let used = 1 + usize::from(signed);
        let span = self.span(0, used - 1);
        let Some(next) = self.tokens.get(self.at + used) else { return false };
        let whole = Span { end: next.start, ..span };
        let block = opener.name();
        let order = parts(opener).map_or("", |(order, _)| order);
        let Some(inside) = self.inside.last_mut() else { return false };
        let in_order = inside.parts == position;
        inside.parts += 1;
        match &mut inside.told {
            Some(told) => {
                // Names in another order than the parts: removing them would not do.
                match in_order && !told.fixes.is_empty() {
                    true => {
                        told.fixes.push(crate::diagnostic::Fix { span: whole, text: String::new() })
                    }
                    false => told.fixes.clear(),
                }
            }
            told @ None => {
                let message =
                    format!("the parts of `{block}` are told by their order, not by names");
                let diagnostic = Diagnostic::new(Code::ExtraPart, message)
                    .at(span, "expected the value alone")
                    .help(format!("write `{block} {{ {order} … }}`"));
                // The first part may stand without a name.
                *told = Some(match in_order || inside.parts <= position {
                    true => diagnostic.fix(whole, ""),
                    false => diagnostic,
                });
                inside.parts = position + 1;
            }
        }
        self.at += used;
        true
    }

    /// `pigment: rgb 1`: the word stays.
    fn sign_after_word(&mut self, meant: &mut Vec<Token>, name: &str) -> bool {
        let (sign, word) = (self.span(1, 1), self.span(0, 0));
        let text = self.slice(1);
        let Some(next) = self.tokens.get(self.at + 2) else { return false };
        let word_end = word.end;
        let gap = Span { start: word_end, end: next.start, ..sign };
        let value = match next.kind {
            TokenKind::Number | TokenKind::Name => self.slice(2),
            _ => "…",
        };
        let token = self.tokens[self.at];
        let word = match token.kind {
            TokenKind::Word(word) => Some(word),
            _ => Word::from_name(name),
        };
        // `pigment = White`: the one value there is stands in a block.
        let single = matches!(next.kind, TokenKind::Number | TokenKind::Name)
            && matches!(
                self.kind(3),
                None | Some(
                    TokenKind::Mark(Mark::Close(_) | Mark::Semicolon)
                        | TokenKind::Word(_)
                        | TokenKind::Directive(_)
                )
            )
            && word.is_some_and(takes_block);
        if single {
            let semicolon = usize::from(self.is(3, Mark::Semicolon));
            let end = match semicolon {
                0 => self.span(2, 2).after(),
                _ => self.span(3, 3),
            };
            let message = format!("`{name}` takes its value in braces, without `{text}`");
            self.diagnostics.push(
                Diagnostic::new(Code::UnexpectedCharacter, message)
                    .at(sign, "expected `{`")
                    .help(format!("write `{name} {{ {value} }}`"))
                    .fix(gap, " { ")
                    .fix(end, " }"),
            );
            let brace = |mark, place: usize| Token {
                kind: TokenKind::Mark(mark),
                ..self.tokens[self.at + place]
            };
            meant.extend([
                token,
                brace(Mark::Open(Bracket::Brace), 1),
                self.tokens[self.at + 2],
                brace(Mark::Close(Bracket::Brace), 2),
            ]);
            self.at += 3 + semicolon;
            return true;
        }
        // `shadowless = True`: the word alone says so.
        let truth = matches!(self.slice(2).to_ascii_lowercase().as_str(), "true" | "on" | "yes");
        if truth && word.is_some_and(is_flag) {
            let whole = Span { start: word_end, ..self.span(1, 2) };
            let message = format!("`{name}` takes no value: the word alone says so");
            self.diagnostics.push(
                Diagnostic::new(Code::UnexpectedCharacter, message)
                    .at(sign, "expected nothing here")
                    .help(format!("write `{name}`"))
                    .fix(whole, ""),
            );
            meant.push(token);
            self.at += 3;
            return true;
        }
        let message = format!("`{name}` takes its value without `{text}`");
        let diagnostic = Diagnostic::new(Code::UnexpectedCharacter, message)
            .at(sign, "expected the value right here")
            .help(format!("write `{name} {value}`"))
            .fix(gap, " ");
        match self.inside.last_mut() {
            // Half a fix is none.
            Some(Inside { told: Some(told), .. }) if told.fixes.is_empty() => {}
            Some(Inside { told: Some(told), .. }) => told.fixes.extend(diagnostic.fixes),
            Some(inside) => inside.told = Some(diagnostic),
            None => {}
        }
        meant.push(match (token.kind, Word::from_name(name)) {
            (TokenKind::String, Some(word)) => Token { kind: TokenKind::Word(word), ..token },
            _ => token,
        });
        self.at += 2;
        true
    }
}
