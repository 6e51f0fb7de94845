//! `finish`: POV-Ray's keywords, or the seed's three; never both.

mod albedo;
mod irid;
mod reflection;
mod whole;

use crate::color::Rgb;
use crate::diagnostic::{Code, Diagnostic};
use crate::scene::{ClassicFinish, Finish, FinishId, FinishOrigin, Reflection};
use crate::source::Span;
use crate::syntax::ast::ExpressionKind;
use crate::vocabulary::{Dialect, Family, Word};

use super::super::stream::{Token, TokenKind};
use super::super::value::Value;
use super::super::{Evaluator, Outcome, Reported};
use super::parts::{Block, Part, Parts};
use super::range::Range;
use super::{Given, Place};
use whole::Written;

/// How POV-Ray treats a negative power.
const AS_A_POWER: &str = "light is taken to this negative power";

/// An exponent of a cosine: POV-Ray 3.7 accepts a negative one, too (measured).
const POWER: Range = Range::NOT_NEGATIVE.but(AS_A_POWER, |power| power);

/// A finish during reading.
pub(super) struct OpenFinish {
    opener: Token,
    finish: Finish,
    /// POV-Ray's words, which replace a seed finish that came from the default.
    classic: ClassicFinish,
    written: Written,
    failed: bool,
    /// Number of messages before it.
    told: usize,
}

fn classic_of(finish: &Finish) -> ClassicFinish {
    match finish {
        Finish::Classic(classic) => classic.clone(),
        Finish::Seed { .. } => ClassicFinish::default(),
    }
}

impl Block for OpenFinish {
    const PLACE: Place = Place::FINISH;
    const PARTS: Parts<Self> = &[
        Part::Ranged(Word::Kd, Range::NOT_NEGATIVE, |f, kd, _| f.written.kd = Some(kd)),
        Part::Ranged(Word::Ks, Range::NOT_NEGATIVE, |f, ks, _| f.written.ks = Some(ks)),
        Part::Ranged(Word::PhongExponent, Range::NOT_NEGATIVE, |f, exponent, _| {
            f.written.phong_exponent = Some(exponent);
        }),
        Part::Special(Word::Ambient, |evaluator, token, f| {
            let given = evaluator.intensity_after(token)?;
            f.classic.ambient = given.value;
            f.written.ambient = Some(given);
            Ok(())
        }),
        Part::Special(Word::Emission, |evaluator, token, f| {
            evaluator.intensity_after(token).map(|given| f.classic.emission = given.value)
        }),
        Part::Special(Word::Diffuse, |evaluator, token, f| {
            f.written.albedo.diffuse |= evaluator.skip_albedo();
            f.classic.diffuse = evaluator.strength_after(token, Word::Diffuse)?;
            f.classic.behind = evaluator.back_side(token)?.unwrap_or(0.0);
            Ok(())
        }),
        Part::Ranged(Word::Brilliance, POWER, |f, power, _| f.classic.brilliance = power),
        Part::Special(Word::Phong, |evaluator, token, f| {
            f.written.albedo.phong |= evaluator.skip_albedo();
            evaluator.strength_after(token, Word::Phong).map(|phong| f.classic.phong = phong)
        }),
        Part::Ranged(Word::PhongSize, POWER, |f, size, _| f.classic.phong_size = size),
        Part::Special(Word::Specular, |evaluator, token, f| {
            f.written.albedo.specular |= evaluator.skip_albedo();
            f.classic.specular = evaluator.strength_after(token, Word::Specular)?;
            Ok(())
        }),
        Part::Special(Word::Roughness, |evaluator, token, f| {
            evaluator.roughness(token).map(|roughness| f.classic.roughness = roughness)
        }),
        Part::Optional(Word::Metallic, |f, metallic, _| f.classic.metallic = metallic),
        Part::Special(Word::Reflection, |evaluator, token, f| {
            let before = f.classic.reflection.as_deref().cloned();
            f.classic.reflection = Some(Box::new(evaluator.reflection(token, before)?));
            Ok(())
        }),
        Part::Flag(Word::ConserveEnergy, |f, (), _| f.classic.conserve_energy = true),
        Part::Special(Word::Ior, |evaluator, token, f| {
            f.classic.ior = Some(evaluator.index_of_refraction(token)?);
            let help = "write `interior { ior … }` beside the texture";
            let message = "`ior` in a finish is an old form";
            evaluator.lint_legacy(&token.here, token.span, message, help);
            Ok(())
        }),
        Part::Number(Word::Crand, |f, crand, _| f.classic.crand = crand),
        Part::Special(Word::Irid, |evaluator, token, f| {
            let before = f.classic.irid.as_deref().copied();
            evaluator.irid(token, before).map(|irid| f.classic.irid = Some(Box::new(irid)))
        }),
        // Of old versions.
        Part::Special(Word::ReflectionExponent, |evaluator, token, f| {
            let exponent = evaluator.exponent(token)?;
            f.classic.reflection.get_or_insert_with(|| Box::new(Reflection::NONE)).exponent =
                exponent;
            Ok(())
        }),
        Part::Number(Word::Refraction, |f, refraction, _| f.classic.refraction = refraction),
        Part::Number(Word::Caustics, |f, caustics, _| f.classic.caustics = Some(caustics)),
    ];

    fn inherit(&mut self, evaluator: &Evaluator, value: &Value) -> bool {
        let Value::Finish(id) = value else { return false };
        self.finish.clone_from(&evaluator.scene.finishes[id.index()]);
        self.classic = classic_of(&self.finish);
        self.written.origin = evaluator.finish_origin(*id);
        true
    }

    fn other(&mut self, evaluator: &mut Evaluator, token: &Token) -> Option<Outcome<()>> {
        evaluator.ends_of_reflection(token).map(Err)
    }

    fn after(&mut self, evaluator: &mut Evaluator, token: &Token, word: Word) {
        let Written { seed, classic, said, highlights, origin, .. } = &mut self.written;
        let site = evaluator.whole(token);
        if matches!(word, Word::Kd | Word::Ks | Word::PhongExponent) {
            seed.get_or_insert((word, token.span));
        } else {
            classic.get_or_insert((word, token.span));
            evaluator.lint_word_twice(token, word, said);
        }
        if matches!(word, Word::Roughness | Word::PhongSize | Word::Specular | Word::Phong) {
            highlights.push((word, site));
        }
        use Word as W;
        if matches!(word, W::Ks | W::Diffuse | W::Phong | W::Specular | W::Reflection | W::Ior) {
            origin.set(word, site);
        }
    }
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
            open.failed = evaluator.parts(&mut open).is_err();
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
        let finish = self.scene.finishes[start.index()].clone();
        let written = Written { origin, ..Written::default() };
        let (opener, told) = (token.clone(), self.diagnostics.len());
        OpenFinish { opener, classic: classic_of(&finish), finish, written, failed: false, told }
    }

    pub(super) fn item_of_finish(&mut self, token: &Token, open: &mut OpenFinish) {
        open.failed |= self.part(token, open).is_err();
    }

    /// Reads a literal number that is `crand`, in a texture of the oldest versions.
    pub(super) fn bare_crand(&mut self, token: &Token, open: &mut OpenFinish) {
        let TokenKind::Expression(id) = token.kind else { return };
        let ExpressionKind::Number(number) = token.here.unit.expression(id).kind else { return };
        open.classic.crand = number;
        open.written.classic.get_or_insert((Word::Crand, token.span));
    }

    pub(super) fn close_finish(&mut self, open: OpenFinish) -> Outcome<FinishId> {
        let OpenFinish { opener, mut finish, classic, written, failed, told } = open;
        if written.seed.is_none() && written.classic.is_some() {
            finish = Finish::Classic(classic);
        }
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
