//! Diagnostics for words that are not valid in their block.

use crate::diagnostic::{Code, Diagnostic, suggest};
use crate::source::Span;
use crate::vocabulary::{Family, Role, Word};

use super::super::stream::{Token, TokenKind};
use super::super::value::Poison;
use super::super::{Evaluator, Reported};
use super::Place;
use super::foreign_keyword::custom;
use super::place::{home, is_at_top_level};
use super::unknown::is_transform;

impl Evaluator<'_> {
    /// Reports transparency in a finish, as in other tools: `finish { alpha 0.5 }`.
    fn clear_finish(&mut self, token: &Token, place: Place) {
        let message = format!("`alpha` is not a word {}", place.name());
        let diagnostic = Diagnostic::new(Code::ForeignWord, message)
            .at(token.span, "how clear a surface is stands in the colour of its pigment")
            .help("write `pigment { rgbt <r, g, b, 0.5> }`, or `… transmit 0.5` behind a colour");
        self.report(&token.here, diagnostic);
        self.skip_values();
    }

    /// Returns the equivalent of another tool's word in the surrounding block, supported or not.
    pub(in crate::evaluate) fn word_of_block(&self, name: &str) -> Option<&'static str> {
        let opener = self.openers.last().map(|opener| self.sources.text(*opener))?;
        let block = Word::from_name(opener)?;
        let of_block =
            |ours: &&str| Word::from_name(ours).is_some_and(|word| home(word) == Some(block));
        suggest::foreign(name).find(of_block)
    }

    /// Reports `type` before a kind: `camera { type perspective }`, `light_source { … type spotlight }`.
    fn type_of(&mut self, token: &Token, of: Word) {
        let next = self.peek().cloned();
        let what = if of == Word::Camera { "camera" } else { "light" };
        let message = format!("the kind of a {what} stands by itself, without `type`");
        let told = Diagnostic::new(Code::UnknownWord, message).at(token.span, "leave this out");
        let told = match &next {
            Some(next @ Token { kind: TokenKind::Word(word), .. }) => {
                let whole = Span { end: next.span.start, ..token.span };
                told.help(format!("write `{}` alone", word.name())).fix(whole, "")
            }
            Some(next) if of == Word::LightSource && self.is_all_around(next) => {
                self.next();
                told.help("without a word a light shines all around")
                    .fix(token.span.to(next.span), "")
            }
            _ if of == Word::Camera => told.help("as in `perspective` or `orthographic`"),
            _ => told.help("as in `spotlight` or `parallel`"),
        };
        self.report(&token.here, told);
        if !matches!(self.peek(), Some(Token { kind: TokenKind::Word(_), .. })) {
            self.skip_values();
        }
    }

    /// Returns whether a block is a comment of the oldest versions, `{ drawn by my father }`: words, none of
    /// which is a keyword.
    pub(super) fn is_prose(&self, block: Span) -> bool {
        let text = self.sources.text(block);
        let signs = |c: char| c.is_alphanumeric() || c.is_whitespace() || "_.,:;-!?'{}".contains(c);
        let mut words = text.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty());
        let is_ours = |word: &str| {
            Word::from_name(word).is_some()
                || self.scopes.symbol(word).is_some_and(|symbol| self.scopes.slot(symbol).is_some())
        };
        text.chars().all(signs) && words.clone().count() > 1 && !words.any(is_ours)
    }

    /// Reports and skips an item among the parts of a blob or a mesh that is not one: an undeclared name, or
    /// another shape. Returns whether there was one.
    pub(super) fn passes_no_part(&mut self, place: Place, parts: &[Word]) -> bool {
        let is_other = match self.peek().map(|next| &next.kind) {
            Some(TokenKind::Word(word)) => word.family() == Family::Shape && !parts.contains(word),
            _ => self.peeks_unknown_name(),
        };
        if !is_other {
            return false;
        }
        if let Some(token) = self.next() {
            self.unexpected(&token, place);
        }
        true
    }

    pub(super) fn unexpected_word(&mut self, token: &Token, word: Word, place: Place) {
        if word == Word::Alpha && !place.holds(Word::Filter) {
            return self.clear_finish(token, place);
        }
        if place.word.is_none() && self.closed_too_early(token, word) {
            return;
        }
        if let Some(help) = custom(word.name(), place) {
            let message = format!("`{}` has no meaning {}", word.name(), place.name());
            let told = Diagnostic::new(Code::UnknownWord, message)
                .at(token.span, "expected a word of this block")
                .help(help);
            self.report(&token.here, told);
            return self.skip_values();
        }
        if let (Word::Type, Some(of @ (Word::Camera | Word::LightSource))) = (word, place.word) {
            return self.type_of(token, of);
        }
        if let Some(today) = word.today() {
            self.old_word(token, word, today);
            return;
        }
        let is_part = match place.word {
            None => !is_at_top_level(word) && home(word).is_some_and(|home| home != word),
            // The map of a texture consists of textures.
            Some(Word::Texture) => matches!(home(word), Some(Word::Pigment | Word::Normal)),
            Some(_) => false,
        };
        // `pigment { … normal { … } }`.
        let is_part = is_part
            || place.word == Some(Word::Pigment)
                && matches!(
                    word,
                    Word::Normal | Word::NormalMap | Word::TextureMap | Word::InteriorTexture
                );
        if !is_part && place.holds(word) && (!word.is_built() || place.others.contains(&word)) {
            let poison = Poison::new(word, token.here.site(token.span));
            self.pass_not_built(token, word);
            self.set_poison(poison);
            return;
        }
        if self.missing_at == Some(token.here.site(token.span)) {
            // Reported: a value is missing here.
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
                let is_whole = name.contains('_') || place.word == Some(Word::GlobalSettings);
                let begins = is_whole && rest.is_some_and(|rest| rest.starts_with('_'));
                let ends = || other.strip_suffix(name).is_some_and(|rest| rest.ends_with('_'));
                begins || (home(word).is_none() && ends())
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
            // The contents of a `sky` block are rarely valid in a `sky_sphere`.
            if word == Word::Sky { diagnostic } else { diagnostic.fix(token.span, meant) }
        // `cube` is a function in a `julia_fractal`, and `size` a word of `facets`; elsewhere they are words
        // of other tools.
        } else if let (Some(near), false) =
            (near, word.is_built() && !matches!(word, Word::Cube | Word::Size))
        {
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
                _ if is_object && place.word == Some(Word::Blob) => {
                    "a blob is made of `sphere` and `cylinder` only".to_owned()
                }
                _ if is_object && place.word == Some(Word::Mesh) => {
                    "a mesh is made of `triangle` and `smooth_triangle` only".to_owned()
                }
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
                None if word.family() == Family::Texture && place.word == Some(Word::Interior) => {
                    "it stands in the object, beside its `interior`".to_owned()
                }
                None if word == Word::Interior && place.word.is_some() => {
                    "it stands in the object, beside its `texture`".to_owned()
                }
                None if word.family() == Family::Texture && place.word == Some(Word::SkySphere) => {
                    "a sky has no surface: it takes `pigment { … }`".to_owned()
                }
                None if word == Word::Pigment && place.word == Some(Word::Fog) => {
                    "its colour stands in it by itself: `color rgb …`".to_owned()
                }
                None => "it belongs elsewhere".to_owned(),
            };
            let message = format!("`{name}` cannot stand {}", place.name());
            let diagnostic = Diagnostic::new(Code::MisplacedBlock, message).at(token.span, label);
            match self.runs_on_into(token).filter(|_| is_object) {
                Some(case) => diagnostic
                    .also(case, "the case above runs on into this one")
                    .help("write `#break` at the end of the case above")
                    .fix(Span { end: case.start, ..case }, "#break\n"),
                None => diagnostic,
            }
        } else {
            let own = home(word).filter(|home| Some(*home) != place.word);
            let is_outside = word.family() == Family::Modifier
                && own.is_none()
                && matches!(
                    place.word,
                    Some(Word::Texture | Word::Pigment | Word::Finish | Word::Interior)
                );
            let label = match (own, place.word) {
                (Some(own), _) => format!("it belongs in `{} {{ … }}`", own.name()),
                (None, Some(of)) if is_outside => {
                    format!("it belongs in the object, outside of `{}`", of.name())
                }
                (None, Some(_)) => "expected a word of this block, or its end".to_owned(),
                (None, None) => "expected an object, a light, a camera, or settings".to_owned(),
            };
            let message = format!("`{name}` has no meaning {}", place.name());
            let diagnostic = Diagnostic::new(Code::UnknownWord, message)
                .at(token.span, label)
                .help(format!("`{name}`: {}", word.sentence()));
            match (own, place.word) {
                (Some(_), _) => diagnostic,
                (None, Some(_)) if is_outside => diagnostic,
                (None, Some(home)) => diagnostic.help(home.sentence().to_owned()),
                (None, None) if matches!(word.family(), Family::Transform | Family::Modifier) => {
                    diagnostic.help(format!("it belongs in an object: `sphere {{ … {name} … }}`"))
                }
                (None, None) => diagnostic,
            }
        };
        let diagnostic = match self.openers.last().copied() {
            Some(span) if has_block => diagnostic.also(span, "inside this block"),
            _ => diagnostic,
        };
        match near {
            Some(near) if is_transform(near) => self.skip_values(),
            _ if has_block && Self::knows_items(word) => self.pass_not_built(token, word),
            _ => self.skip_arguments(word),
        }
        let diagnostic = match place.word {
            Some(Word::Interior) if has_block && word.family() == Family::Texture => {
                self.before_its_block(token, diagnostic)
            }
            _ => diagnostic,
        };
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
        let diagnostic = match own {
            Some(own @ (Word::Pigment | Word::Finish | Word::Interior))
                if place.word == Some(Word::Texture) && own != Word::Interior
                    || place.families.contains(&Family::Modifier)
                        && !place.families.contains(&Family::Shape) =>
            {
                self.in_block_of_its_own(token, own, diagnostic)
            }
            _ => diagnostic,
        };
        self.report(&token.here, diagnostic);
        // `material { pigment { … } finish { … } }`: one `texture` is missing around all of them.
        let is_of_texture = |word: Word| word.family() == Family::Texture && word != Word::Texture;
        if place.word == Some(Word::Material) && is_of_texture(word) {
            while let Some(TokenKind::Word(word)) = self.peek().map(|next| next.kind.clone())
                && is_of_texture(word)
            {
                self.next();
                self.skip_arguments(word);
            }
        }
    }

    /// Completes the diagnostic for items from `token` to the one taken last that belong before the block that
    /// they are in: `interior { ior 1.5 texture { … } }`.
    fn before_its_block(&self, token: &Token, told: Diagnostic) -> Diagnostic {
        let whole = self.whole(token).span;
        let text = self.sources.text(whole);
        match self.openers.last() {
            Some(opener) if opener.file == whole.file && whole.start == token.span.start => told
                .help(format!("move it before `{}`", self.sources.text(*opener)))
                .fix(Span { end: opener.start, ..*opener }, format!("{text} "))
                .fix(whole, ""),
            _ => told,
        }
    }

    /// Completes the diagnostic for items from `token` to the one taken last that belong in a block of their
    /// own: `texture { color Red phong 1 }`.
    fn in_block_of_its_own(&self, token: &Token, own: Word, told: Diagnostic) -> Diagnostic {
        let whole = self.whole(token);
        let text = self.sources.text(whole.span);
        let is_plain = whole.span.start == token.span.start && !text.contains(['#', '/', '{']);
        if !is_plain || !told.fixes.is_empty() {
            return told;
        }
        let right = format!("{} {{ {text} }}", own.name());
        told.help(format!("write `{right}`")).fix(whole.span, right)
    }

    /// Returns the span of the `#case` right before `token`, if a block and no `#break` precedes it.
    fn runs_on_into(&self, token: &Token) -> Option<Span> {
        let before = self.sources.get(token.span.file).text.get(..token.span.start as usize)?;
        let start = before.rfind('#')?;
        let head = &before[start..];
        let is_case = head.starts_with("#case") || head.starts_with("#range");
        let runs_on =
            is_case && head.trim_end().ends_with(')') && before[..start].trim_end().ends_with('}');
        let word = head.find('(')?;
        runs_on.then(|| Span::new(token.span.file, start, start + head[..word].trim_end().len()))
    }

    /// Reports an obsolete keyword such as `composite { … }` or `alpha 0.5`, and suggests its replacement.
    pub(super) fn old_word(&mut self, token: &Token, word: Word, today: Word) -> Reported {
        let (name, meant) = (word.name(), today.name());
        let message = format!("`{name}` is a word of old versions");
        let diagnostic = Diagnostic::new(Code::UnknownWord, message);
        let diagnostic = match self.opacity(token, word) {
            Some((span, right)) => diagnostic
                .at(token.span, "how clear a colour is, is `transmit`: 1 less the opacity")
                .help(format!("write `{right}`; in old files it was `{meant}`"))
                .fix(span, right),
            None => diagnostic
                .at(token.span, format!("today it is `{meant}`"))
                .help(format!("write `{meant}`"))
                .fix(token.span, meant),
        };
        let reported = self.report(&token.here, diagnostic);
        if !self.judge_block(token, today) {
            self.skip_values();
        }
        reported
    }

    /// Returns the number after `alpha 0.2` if it is meant as an opacity, as in all other current programs.
    fn opacity(&self, token: &Token, word: Word) -> Option<(Span, String)> {
        /// The version from which `alpha` is no longer a keyword.
        const TODAY: f64 = 3.0;
        let text = self.sources.get(token.span.file).text.get(token.span.end as usize..)?;
        let blanks = text.len() - text.trim_start().len();
        let rest = &text[blanks..];
        let end = rest.find(|c: char| !(c.is_ascii_digit() || c == '.')).unwrap_or(rest.len());
        let number = rest[..end].parse::<f64>().ok().filter(|n| (0.0..=1.0).contains(n))?;
        let end = token.span.end + (blanks + end) as u32;
        // With as many digits as it has.
        let digits = rest[..(end - token.span.end) as usize - blanks].split_once('.');
        let digits = digits.map_or(0, |(_, digits)| digits.len());
        (word == Word::Alpha && self.version >= TODAY)
            .then(|| (Span { end, ..token.span }, format!("transmit {:.digits$}", 1.0 - number)))
    }

    /// Reports a directive's keyword without its `#` that `syntax/habits` does not repair: `version 3.7;`,
    /// `debug "…"`.
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
