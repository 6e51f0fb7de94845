//! `finish`: POV-Ray's keywords, or the seed's three; never both.

mod albedo;
mod irid;
mod old;
mod reflection;
mod whole;

use crate::color::Rgb;
use crate::diagnostic::{Code, Diagnostic};
use crate::scene::{ClassicFinish, Finish, FinishId, FinishOrigin};
use crate::source::Span;
use crate::vocabulary::{Dialect, Family, Word};

use super::super::stream::{Token, TokenKind};
use super::super::value::Value;
use super::super::{Evaluator, Outcome, Reported};
use super::{Given, Place};
use whole::Written;

/// How POV-Ray treats a negative power.
const AS_A_POWER: &str = "light is taken to this negative power";

/// A finish during reading.
pub(super) struct OpenFinish {
    opener: Token,
    finish: Finish,
    written: Written,
    failed: bool,
    /// Number of messages before it.
    told: usize,
}

impl Evaluator<'_> {
    /// Reads `finish { [Name] … }`, starting from the default texture's finish.
    pub(super) fn finish(&mut self, token: &Token) -> Outcome<FinishId> {
        let start = self.scene.textures[self.default_texture.index()].kind.first_finish();
        self.finish_from(token, start)
    }

    pub(super) fn finish_from(&mut self, token: &Token, start: FinishId) -> Outcome<FinishId> {
        self.block(token, Word::Finish, |evaluator| {
            let mut open = evaluator.open_finish(token, start);
            while let Some(token) = evaluator.next() {
                evaluator.item_of_finish(&token, &mut open);
            }
            evaluator.close_finish(open)
        })
    }

    /// Returns a finish, begun by `token`, into which items are read.
    pub(super) fn open_finish(&self, token: &Token, start: FinishId) -> OpenFinish {
        let origin = self.finish_origin(start);
        // The default's words yield to those of the other vocabulary.
        let origin =
            match start == self.scene.textures[self.default_texture.index()].kind.first_finish() {
                true => FinishOrigin { seed: None, classic: None, ..origin },
                false => origin,
            };
        OpenFinish {
            opener: token.clone(),
            finish: self.scene.finishes[start.index()].clone(),
            written: Written { origin, ..Written::default() },
            failed: false,
            told: self.diagnostics.len(),
        }
    }

    pub(super) fn item_of_finish(&mut self, token: &Token, open: &mut OpenFinish) {
        if self.finish_item(token, &mut open.finish, &mut open.written) == Err(Reported) {
            open.failed = true;
            self.skip_values();
        }
    }

    pub(super) fn close_finish(&mut self, open: OpenFinish) -> Outcome<FinishId> {
        let OpenFinish { opener, mut finish, written, failed, told } = open;
        // The missing word may be in the item that failed.
        if failed && written.classic.is_none() {
            return Err(Reported);
        }
        self.whole_finish(&opener, &mut finish, &written)?;
        if let Some(ambient) = &written.ambient {
            self.lint_ambient(ambient, &finish);
        }
        // An unknown word may be the missing one.
        if self.diagnostics.len() == told {
            self.lint_unlit_highlight(&finish, &written.highlights);
        }
        if let Finish::Classic(classic) = &mut finish {
            written.albedo.spend(classic);
        }
        if failed {
            return Err(Reported);
        }
        let here = |word: (Word, Span)| (word.0, opener.here.site(word.1));
        let mut origin = written.origin;
        // One vocabulary replaces the default's words of the other.
        let is_seed = matches!(finish, Finish::Seed { .. });
        origin.words.retain(|(word, _)| (*word == Word::Ks) == is_seed);
        origin.seed = origin.seed.or(written.seed.map(here));
        origin.classic = origin.classic.or(written.classic.map(here));
        let site = Some(opener.here.site(opener.span));
        let words = size_of_val(&origin.words[..]);
        self.scene.finish_origins.resize(self.scene.finishes.len(), FinishOrigin::default());
        self.scene.finish_origins.push(FinishOrigin { site, ..origin });
        self.stored += (size_of::<Finish>() + size_of::<FinishOrigin>() + words) as u64;
        self.scene.finishes.push(finish);
        Ok(FinishId(self.scene.finishes.len() as u32 - 1))
    }

    /// Clears the keywords recorded for the finishes from number `first` on. These are defaults, whose
    /// keywords yield to those of the other vocabulary.
    pub(super) fn forget_words_of_finishes(&mut self, first: usize) {
        for origin in self.scene.finish_origins.iter_mut().skip(first) {
            (origin.seed, origin.classic) = (None, None);
        }
    }

    fn finish_origin(&self, id: FinishId) -> FinishOrigin {
        self.scene.finish_origins.get(id.index()).cloned().unwrap_or_default()
    }

    fn finish_item(
        &mut self,
        token: &Token,
        finish: &mut Finish,
        written: &mut Written,
    ) -> Outcome<()> {
        if let Some(word) = self.contextual_word(token, Word::Finish) {
            let token = Token { kind: TokenKind::Word(word), ..token.clone() };
            return self.finish_item(&token, finish, written);
        }
        let word = match token.kind {
            TokenKind::Word(word) => word,
            TokenKind::Expression(id) => match self.declared(token, id) {
                Some(Value::Broken) => return Err(Reported),
                Some(Value::Finish(id)) => {
                    *finish = self.scene.finishes[id.index()].clone();
                    written.origin = self.finish_origin(id);
                    return Ok(());
                }
                Some(Value::Poison(poison)) => {
                    self.is_of_place(token, poison, Place::FINISH);
                    self.set_poison(poison);
                    return Ok(());
                }
                _ => {
                    if let Some(reported) = self.ends_of_reflection(token) {
                        return Err(reported);
                    }
                    self.unexpected(token, Place::FINISH);
                    return Err(Reported);
                }
            },
            _ => {
                self.unexpected(token, Place::FINISH);
                return Ok(());
            }
        };
        match word {
            Word::Kd | Word::Ks | Word::PhongExponent => {
                written.seed.get_or_insert((word, token.span));
                let number = self.at_least_zero(token, word)?;
                match word {
                    Word::Kd => written.kd = Some(number),
                    Word::Ks => {
                        written.ks = Some(number);
                        written.origin.set(word, self.whole(token));
                    }
                    _ => written.phong_exponent = Some(number),
                }
                return Ok(());
            }
            _ => {}
        }
        let mut classic = match finish {
            Finish::Classic(classic) => classic.clone(),
            // POV-Ray's words replace a seed finish that came from the default.
            Finish::Seed { .. } => ClassicFinish::default(),
        };
        let known = self.classic_item(token, word, &mut classic, written)?;
        if known {
            if matches!(word, Word::Roughness | Word::PhongSize | Word::Specular | Word::Phong) {
                written.highlights.push((word, self.whole(token)));
            }
            written.classic.get_or_insert((word, token.span));
            self.lint_word_twice(token, word, &mut written.said);
            if matches!(word, Word::Phong | Word::Specular | Word::Reflection | Word::Ior) {
                written.origin.set(word, self.whole(token));
            }
            if written.seed.is_none() {
                *finish = Finish::Classic(classic);
            }
        }
        Ok(())
    }

    /// Reads one item; returns `Ok(false)` if its word is not a supported one.
    fn classic_item(
        &mut self,
        token: &Token,
        word: Word,
        finish: &mut ClassicFinish,
        written: &mut Written,
    ) -> Outcome<bool> {
        let albedo = &mut written.albedo;
        match word {
            Word::Ambient => {
                let given = self.intensity_after(token)?;
                finish.ambient = given.value;
                written.ambient = Some(given);
            }
            Word::Emission => finish.emission = self.intensity_after(token)?.value,
            Word::Diffuse => {
                albedo.diffuse |= self.skip_albedo();
                finish.diffuse = self.strength_after(token, word)?;
                let behind = self.back_side(token)?;
                finish.behind = behind.unwrap_or(0.0);
                written.origin.set(word, self.whole(token));
            }
            Word::Brilliance => finish.brilliance = self.power_after(token, word)?,
            Word::Phong => {
                albedo.phong |= self.skip_albedo();
                finish.phong = self.strength_after(token, word)?;
            }
            Word::PhongSize => finish.phong_size = self.power_after(token, word)?,
            Word::Specular => {
                albedo.specular |= self.skip_albedo();
                finish.specular = self.strength_after(token, word)?;
            }
            Word::Roughness => finish.roughness = self.roughness(token)?,
            Word::Metallic => finish.metallic = self.optional_number(token, 1.0)?,
            Word::Reflection => {
                let before = finish.reflection.take();
                finish.reflection = Some(self.reflection(token, before)?);
            }
            Word::ConserveEnergy => finish.conserve_energy = true,
            Word::Ior => {
                finish.ior = Some(self.index_of_refraction(token)?);
                let help = "write `interior { ior … }` beside the texture";
                self.lint_legacy(&token.here, token.span, "`ior` in a finish is an old form", help);
            }
            Word::Crand => finish.crand = self.number_after(token, "a number")?.value,
            Word::Irid => finish.irid = Some(self.irid(token, finish.irid)?),
            Word::ReflectionExponent | Word::Refraction | Word::Caustics => {
                self.old_item(token, word, finish)?;
            }
            _ => {
                let poisoned = self.poison.is_some();
                self.unexpected(token, Place::FINISH);
                return if poisoned || self.poison.is_some() { Ok(false) } else { Err(Reported) };
            }
        }
        Ok(true)
    }

    /// Reads `roughness`: with 0, as in POV-Ray 3.7 (measured), a highlight has no edge, as if the exponent
    /// were unbounded.
    fn roughness(&mut self, token: &Token) -> Outcome<f64> {
        let given = self.number_after(token, "a number")?;
        if given.value == 0.0 {
            let read = "the highlight covers all of the lit side";
            self.out_of_range_but_read(&given, Word::Roughness, "more than 0", read)?;
            return Ok(f64::MAX);
        }
        if given.value < 0.0 {
            self.out_of_range_but_read(&given, Word::Roughness, "more than 0", AS_A_POWER)?;
        }
        self.lint_highlight(&given, Word::Roughness);
        Ok(given.value)
    }

    /// Reads the exponent of a cosine; POV-Ray 3.7 also accepts a negative one (measured).
    pub(super) fn power_after(&mut self, token: &Token, word: Word) -> Outcome<f64> {
        let given = self.number_after(token, "a number")?;
        if given.value < 0.0 {
            self.out_of_range_but_read(&given, word, "0 or more", AS_A_POWER)?;
        }
        self.lint_highlight(&given, word);
        Ok(given.value)
    }

    /// Reads a light colour, or a number for white light.
    fn intensity_after(&mut self, token: &Token) -> Outcome<Given<Rgb>> {
        let given = self.color_after(token, "a number or a colour")?;
        let light = given.value.rgb;
        if let TokenKind::Word(word) = token.kind {
            self.lint_strength(&given.here, given.span, word, light);
        }
        Ok(given.with(light))
    }

    /// Reads the second number of `diffuse front, behind`, for light from behind.
    /// POV-Ray 3.7 accepts it without the comma (measured).
    fn back_side(&mut self, token: &Token) -> Outcome<Option<f64>> {
        let is_comma = |next: &Token| matches!(next.kind, TokenKind::Comma);
        if self.options.dialect == Dialect::Scene && !self.peek().is_some_and(is_comma) {
            return Ok(None);
        }
        self.skip_commas();
        let is_value = matches!(
            self.peek().map(|token| &token.kind),
            Some(TokenKind::Expression(_) | TokenKind::Literal(_))
        );
        if !is_value {
            return Ok(None);
        }
        let behind = self.number_after(token, "a number")?;
        self.lint_strength(&behind.here, behind.span, Word::Diffuse, Rgb::gray(behind.value));
        Ok(Some(behind.value))
    }

    /// Reads how strongly a surface reflects light.
    fn strength_after(&mut self, token: &Token, word: Word) -> Outcome<f64> {
        if let Some(reported) = self.color_for_number(token, word) {
            return Err(reported);
        }
        let given = self.number_after(token, "a number")?;
        self.lint_strength(&given.here, given.span, word, Rgb::gray(given.value));
        Ok(given.value)
    }

    /// Reports a colour where one number applies to all colours of light: `diffuse rgb 0.6`, `specular <0.5,
    /// 0.5, 0.5>`.
    fn color_for_number(&mut self, token: &Token, word: Word) -> Option<Reported> {
        let first = self.peek()?.clone();
        let text = self.sources.text(first.span);
        let is_color = match first.kind {
            TokenKind::Word(word) => word.family() == Family::Color,
            _ => text.starts_with('<') && text.ends_with('>'),
        };
        if !is_color {
            return None;
        }
        let before = self.told();
        let color = self.color_after(token, "a number");
        self.take_back(before);
        let whole = self.whole(&first).span;
        let name = word.name();
        let message = format!("expected a number after `{name}`, found a colour");
        let told = Diagnostic::new(Code::WrongType, message).at(whole, "expected a number");
        let gray = color.ok().map(|given| given.value.rgb);
        let gray = gray.filter(|c| c.red == c.green && c.green == c.blue).map(|c| c.red);
        let told = match gray.filter(|_| whole.start == first.span.start) {
            Some(number) => {
                told.help(format!("write `{name} {number}`")).fix(whole, number.to_string())
            }
            None => told.help(format!("one number is for all colours of light: `{name} 0.5`")),
        };
        Some(self.report(&token.here, told))
    }
}
