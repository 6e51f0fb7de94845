//! `finish`: POV-Ray's words, or the seed's three; never both.

use crate::color::Rgb;
use crate::diagnostic::{Code, Diagnostic};
use crate::scene::{ClassicFinish, Finish, FinishId, FinishOrigin, Reflection};
use crate::source::{Site, Span};
use crate::vocabulary::Word;

use super::super::stream::{Token, TokenKind};
use super::super::value::Value;
use super::super::{Evaluator, Outcome, Reported};
use super::Place;

/// What was written in one block: the last number of each of the seed's words, and the first word of
/// POV-Ray's.
#[derive(Default)]
struct Written {
    kd: Option<f64>,
    ks: Option<f64>,
    phong_exponent: Option<f64>,
    seed: Option<(Word, Span)>,
    /// All of the seed's words, from the first to the last.
    seed_item: Option<Site>,
    classic: Option<(Word, Span)>,
    origin: FinishOrigin,
}

impl Written {
    /// An item set the weight of `word`.
    fn weigh(&mut self, word: Word, weightless: bool, item: Site) {
        let Self { origin, .. } = self;
        origin.zeros.retain(|(other, _)| *other != word);
        match word {
            Word::Ior => list_once(&mut origin.ior, item),
            _ if weightless => origin.zeros.push((word, item)),
            Word::Reflection => list_once(&mut origin.reflection, item),
            _ => list_once(&mut origin.highlights, item),
        }
    }
}

/// A loop may go through one place again and again.
pub(super) fn list_once(sites: &mut Vec<Site>, item: Site) {
    if sites.iter().all(|site| site.span != item.span) {
        sites.push(item);
    }
}

impl Evaluator<'_> {
    /// `finish { [Name] … }`, starting from the default texture's finish.
    pub(super) fn finish(&mut self, token: &Token) -> Outcome<FinishId> {
        let start = self.scene.textures[self.default_texture.index()].finish;
        self.finish_from(token, start)
    }

    pub(super) fn finish_from(&mut self, token: &Token, start: FinishId) -> Outcome<FinishId> {
        let mut finish = self.scene.finishes[start.index()].clone();
        let opener = token.clone();
        let origin = self.finish_origin(start);
        let (finish, origin) = self.block(token, Word::Finish, |evaluator| {
            let mut written = Written { origin, ..Written::default() };
            let mut failed = false;
            while let Some(token) = evaluator.next() {
                if evaluator.finish_item(&token, &mut finish, &mut written) == Err(Reported) {
                    failed = true;
                    evaluator.skip_values();
                }
            }
            // What failed may be what is missing.
            if failed && written.classic.is_none() {
                return Err(Reported);
            }
            evaluator.whole_finish(&opener, &mut finish, &written)?;
            if let (Finish::Seed { ks, .. }, Some(item)) = (&finish, written.seed_item) {
                written.origin.zeros.clear();
                match *ks == 0.0 {
                    true => written.origin.zeros.push((Word::Ks, item)),
                    false => {
                        list_once(&mut written.origin.highlights, item);
                        list_once(&mut written.origin.reflection, item);
                    }
                }
            }
            if failed { Err(Reported) } else { Ok((finish, written.origin)) }
        })?;
        let site = Some(opener.here.site(opener.span));
        let sites = (origin.highlights.len() + origin.reflection.len()) * size_of::<Site>();
        self.scene.finish_origins.resize(self.scene.finishes.len(), FinishOrigin::default());
        self.scene.finish_origins.push(FinishOrigin { site, ..origin });
        self.stored += (size_of::<Finish>() + size_of::<FinishOrigin>() + sites) as u64;
        self.scene.finishes.push(finish);
        Ok(FinishId(self.scene.finishes.len() as u32 - 1))
    }

    fn finish_origin(&self, id: FinishId) -> FinishOrigin {
        self.scene.finish_origins.get(id.index()).cloned().unwrap_or_default()
    }

    /// The seed's words come together, and with none of POV-Ray's.
    fn whole_finish(
        &mut self,
        opener: &Token,
        finish: &mut Finish,
        written: &Written,
    ) -> Outcome<()> {
        let Some((seed, seed_span)) = written.seed else { return Ok(()) };
        if let Some((classic, classic_span)) = written.classic {
            let diagnostic = Diagnostic::new(
                Code::MixedFinish,
                format!("a finish mixes `{}` with `{}`", seed.name(), classic.name()),
            )
            .at(classic_span, "a word of POV-Ray's finish")
            .also(seed_span, "a word of the seed's")
            .help("`kd`, `ks` and `phong_exponent` stand alone; else use `diffuse`, `specular`, `reflection` and their kin");
            return Err(self.report(&opener.here, diagnostic));
        }
        let (old_kd, old_ks, old_exponent) = match finish {
            Finish::Seed { kd, ks, phong_exponent } => {
                (Some(*kd), Some(*ks), Some(*phong_exponent))
            }
            Finish::Classic(_) => (None, None, None),
        };
        let kd = written.kd.or(old_kd);
        let ks = written.ks.or(old_ks);
        let exponent = written.phong_exponent.or(old_exponent);
        if let (Some(kd), Some(ks), Some(phong_exponent)) = (kd, ks, exponent) {
            *finish = Finish::Seed { kd, ks, phong_exponent };
            return Ok(());
        }
        let missing: Vec<&str> = [("`kd`", kd), ("`ks`", ks), ("`phong_exponent`", exponent)]
            .iter()
            .filter(|(_, value)| value.is_none())
            .map(|(name, _)| *name)
            .collect();
        let diagnostic = Diagnostic::new(
            Code::IncompleteFinish,
            format!("this finish lacks {}", missing.join(" and ")),
        )
        .at(seed_span, "the seed's three words come together")
        .also(opener.span, "in this finish");
        Err(self.report(&opener.here, diagnostic))
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
            TokenKind::Expression(id) => match self.named(token, id) {
                Some(Value::Finish(id)) => {
                    *finish = self.scene.finishes[id.index()].clone();
                    written.origin = self.finish_origin(id);
                    return Ok(());
                }
                Some(Value::Poison(poison)) => {
                    self.set_poison(poison);
                    return Ok(());
                }
                _ => {
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
                let number = Some(self.at_least_zero(token, word)?);
                match word {
                    Word::Kd => written.kd = number,
                    Word::Ks => written.ks = number,
                    _ => written.phong_exponent = number,
                }
                let item = self.whole(token);
                written.seed_item =
                    Some(written.seed_item.map_or(item, |first| self.joined(first, item)));
                return Ok(());
            }
            _ => {}
        }
        let mut classic = match finish {
            Finish::Classic(classic) => classic.clone(),
            // POV-Ray's words replace a seed's finish that came by default or by name.
            Finish::Seed { .. } => ClassicFinish::default(),
        };
        let known = self.classic_item(token, word, &mut classic)?;
        if known {
            written.classic.get_or_insert((word, token.span));
            let weightless = match word {
                Word::Phong => Some(classic.phong == 0.0),
                Word::Specular => Some(classic.specular == 0.0),
                Word::Reflection => classic
                    .reflection
                    .as_ref()
                    .map(|r| r.minimum.is_black() && r.maximum.is_black()),
                Word::Ior => Some(false),
                _ => None,
            };
            if let Some(weightless) = weightless {
                written.weigh(word, weightless, self.whole(token));
            }
            if written.seed.is_none() {
                *finish = Finish::Classic(classic);
            }
        }
        Ok(())
    }

    /// `Ok(false)` when the word is none of the built ones.
    fn classic_item(
        &mut self,
        token: &Token,
        word: Word,
        finish: &mut ClassicFinish,
    ) -> Outcome<bool> {
        match word {
            Word::Ambient => finish.ambient = self.intensity_after(token)?,
            Word::Emission => finish.emission = self.intensity_after(token)?,
            Word::Diffuse => finish.diffuse = self.strength_after(token, word)?,
            Word::Brilliance => finish.brilliance = self.at_least_zero(token, word)?,
            Word::Phong => finish.phong = self.strength_after(token, word)?,
            Word::PhongSize => finish.phong_size = self.at_least_zero(token, word)?,
            Word::Specular => finish.specular = self.strength_after(token, word)?,
            Word::Roughness => finish.roughness = self.more_than_zero(token, word)?,
            Word::Metallic => finish.metallic = self.optional_number(token, 1.0)?,
            Word::Reflection => {
                let before = finish.reflection.take();
                finish.reflection = Some(self.reflection(token, before)?);
            }
            Word::ConserveEnergy => finish.conserve_energy = true,
            Word::Ior => {
                finish.ior = Some(self.more_than_zero(token, word)?);
                let help = "write `interior { ior … }` beside the texture";
                self.lint_legacy(&token.here, token.span, "`ior` in a finish is an old form", help);
            }
            _ => {
                let poisoned = self.poison.is_some();
                self.unexpected(token, Place::FINISH);
                return if poisoned || self.poison.is_some() { Ok(false) } else { Err(Reported) };
            }
        }
        Ok(true)
    }

    /// A colour of light, or a number for white light.
    fn intensity_after(&mut self, token: &Token) -> Outcome<Rgb> {
        let given = self.color_after(token, "a number or a colour")?;
        if let TokenKind::Word(word) = token.kind {
            self.lint_strength(&given.here, given.span, word, given.value.rgb);
        }
        Ok(given.value.rgb)
    }

    /// How strongly a surface answers light.
    fn strength_after(&mut self, token: &Token, word: Word) -> Outcome<f64> {
        let given = self.number_after(token, "a number")?;
        self.lint_strength(&given.here, given.span, word, Rgb::gray(given.value));
        Ok(given.value)
    }

    /// `reflection 0.5`, `reflection rgb <…>` or `reflection { [min,] max … }`. What a finish had
    /// `before` says how its reflection behaves until it is said again, as in POV-Ray.
    fn reflection(&mut self, token: &Token, before: Option<Reflection>) -> Outcome<Reflection> {
        let plain = |color: Rgb| {
            let (falloff, exponent, metallic) =
                before.as_ref().map_or((1.0, 1.0, 0.0), |r| (r.falloff, r.exponent, r.metallic));
            let fresnel = before.as_ref().is_some_and(|r| r.fresnel);
            Reflection { minimum: color, maximum: color, falloff, fresnel, exponent, metallic }
        };
        if !matches!(self.peek(), Some(Token { kind: TokenKind::Block(_), .. })) {
            return Ok(plain(self.intensity_after(token)?));
        }
        let opener = token.clone();
        self.block(token, Word::Reflection, |evaluator| {
            let mut reflection = plain(evaluator.intensity_after(&opener)?);
            evaluator.skip_commas();
            let both = evaluator.at_color();
            if both {
                reflection.maximum = evaluator.intensity_after(&opener)?;
            }
            while let Some(token) = evaluator.next() {
                match token.kind {
                    TokenKind::Word(Word::Falloff) => {
                        reflection.falloff = evaluator.at_least_zero(&token, Word::Falloff)?;
                    }
                    TokenKind::Word(Word::Exponent) => {
                        reflection.exponent = evaluator.more_than_zero(&token, Word::Exponent)?;
                    }
                    TokenKind::Word(Word::Metallic) => {
                        reflection.metallic = evaluator.optional_number(&token, 1.0)?;
                    }
                    TokenKind::Word(Word::Fresnel) => {
                        reflection.fresnel = evaluator.optional_flag(&token)?;
                    }
                    _ => evaluator.unexpected(&token, Place::REFLECTION),
                }
            }
            // With one colour only, nothing is the least (measured on POV-Ray 3.7).
            if reflection.fresnel && !both {
                reflection.minimum = Rgb::BLACK;
            }
            Ok(reflection)
        })
    }
}
