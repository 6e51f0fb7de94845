//! `light_source`: a point, a beam, parallel rays, or the seed's direction.

mod doubt;
mod form;
mod order;

use crate::color::Rgb;
use crate::diagnostic::{Code, Diagnostic};
use crate::math::Vector;
use crate::scene::{
    Beam, Dialect, Fade, LightKind, LightSource, Modifier, ModifierKind, Object, ObjectId,
    ObjectKind, TransformId,
};
use crate::source::Site;
use crate::vocabulary::{Family, Word};

use super::super::lint::Cone;
use super::super::stream::{Token, TokenKind};
use super::super::value::Value;
use super::super::{Evaluator, Outcome, Reported};
use super::Place;
use super::finish::list_once;
use super::part::Given;
use order::Late;

impl Evaluator<'_> {
    pub(super) fn light_source(&mut self, token: &Token) -> Outcome<ObjectId> {
        let site = token.here.site(token.span);
        let opener = token.clone();
        let mut closed_early = None;
        let outcome = self.block(token, Word::LightSource, |evaluator| {
            let mut modifiers = Vec::new();
            if let Some(declared) = evaluator.declared_light() {
                let name = evaluator.next();
                if let Some(name) = name
                    && let Some(reported) = evaluator.wrong_kind(&name, Word::LightSource, declared)
                {
                    let _: Outcome<()> = evaluator.light_modifiers(&mut modifiers, None, None);
                    return Err(reported);
                }
                // A light of its own from here on: its words can change it.
                let (mut light, mut modifiers) = evaluator.light_of(declared);
                let outcome = evaluator.light_modifiers(&mut modifiers, light.as_mut(), None);
                let kind = light.map_or(ObjectKind::Use(declared), |light| {
                    ObjectKind::LightSource(Box::new(light))
                });
                return outcome.map(|()| (kind, modifiers));
            }
            if evaluator.takes_poison() {
                let _: Outcome<()> = evaluator.light_modifiers(&mut modifiers, None, None);
                return Err(Reported);
            }
            let (mut light, late) = evaluator.light_parts(&opener);
            if late.as_ref().is_some_and(Late::ends_block) {
                closed_early = evaluator.closer_before_color();
            }
            let outcome = evaluator.light_modifiers(&mut modifiers, light.as_mut().ok(), late);
            let light = light?;
            outcome?;
            Ok((ObjectKind::LightSource(Box::new(light)), modifiers))
        });
        if let (Err(Reported), Some(closer)) = (&outcome, closed_early) {
            return Err(self.color_behind_light(token, closer));
        }
        let (kind, modifiers) = outcome?;
        self.add_object(Object { kind, modifiers, site, item: None })
    }

    /// A declared light's own parts, and every modifier it has got, in order.
    fn light_of(&self, mut object: ObjectId) -> (Option<LightSource>, Vec<Modifier>) {
        let mut layers = Vec::new();
        loop {
            let Object { kind, modifiers, .. } = &self.scene.objects[object.index()];
            layers.push(modifiers);
            match kind {
                ObjectKind::Use(inner) => object = *inner,
                ObjectKind::LightSource(light) => {
                    return (
                        Some(light.as_ref().clone()),
                        layers.into_iter().rev().flatten().cloned().collect(),
                    );
                }
                ObjectKind::Solid(_) | ObjectKind::Union(_) | ObjectKind::Csg { .. } => {
                    return (None, Vec::new());
                }
            }
        }
    }

    fn declared_light(&mut self) -> Option<ObjectId> {
        match *self.peek_declared()? {
            Value::Object(object) => Some(object),
            _ => None,
        }
    }

    /// The place and the colour; or, in a `.scene`, `direction` and the colour. Where another word of the
    /// light stands instead of the colour, that may come late.
    fn light_parts(&mut self, opener: &Token) -> (Outcome<LightSource>, Option<Late>) {
        if self.at_color_word() {
            return (self.color_before_place(opener), None);
        }
        if let Some(parts) = self.light_by_kind(opener) {
            return parts;
        }
        let kind = self.light_place(opener);
        self.semicolon_for_comma();
        let late = self.late_color(opener);
        let color = match late {
            // It is told where it comes, or that it never does.
            Some(_) => Ok((Rgb::BLACK, None, None)),
            None => self.written_color_after(opener, "a colour for the light").map(|given| {
                let black = given.value.without(|color| color.rgb.is_black());
                let first = given.site();
                let all = self.joined(first, self.taken.unwrap_or(first));
                (given.value.color().rgb, Some(all), black)
            }),
        };
        let light = kind.and_then(|kind| {
            let (color, color_site, black) = color?;
            Ok(LightSource {
                color_site,
                color_sites: black.unwrap_or_default(),
                ..LightSource::new(kind, color)
            })
        });
        (light, late)
    }

    fn light_place(&mut self, opener: &Token) -> Outcome<LightKind> {
        let ours = self.options.dialect == Dialect::Scene;
        match self.peek().map(|token| &token.kind) {
            Some(TokenKind::Word(Word::Direction)) if ours => self.seed_direction(),
            _ => self
                .vector_after(opener, "a vector for the light's place")
                .map(|given| LightKind::Point { location: given.value }),
        }
    }

    fn seed_direction(&mut self) -> Outcome<LightKind> {
        let Some(token) = self.next() else { return Err(Reported) };
        let to_light = self.direction_after(&token, "the direction to the light")?.value;
        Ok(LightKind::Direction { to_light })
    }

    /// The words after the place and the colour. `light` is `None` where there is none to change.
    fn light_modifiers(
        &mut self,
        modifiers: &mut Vec<Modifier>,
        mut light: Option<&mut LightSource>,
        mut late: Option<Late>,
    ) -> Outcome<()> {
        let mut failed = false;
        let mut written = Written::of(light.as_deref(), self.options.dialect);
        let mut cone = Cone::default();
        let ours = self.options.dialect == Dialect::Scene;
        while let Some(token) = self.next() {
            if is_of_a_place(&token) {
                written.of_a_place.push(token.clone());
            }
            let outcome = match token.kind {
                TokenKind::Word(word) if word.family() == Family::Color => {
                    self.take_late_color(&token, late.take(), light.as_deref_mut())
                }
                TokenKind::Word(Word::Direction) if ours => {
                    self.second_direction(&token, light.as_deref())
                }
                TokenKind::Word(word @ (Word::Parallel | Word::Spotlight | Word::Cylinder)) => {
                    if word != Word::Parallel
                        && written.shapes.iter().any(|of| ![word, Word::Parallel].contains(of))
                    {
                        written.second = Some(token.clone());
                    }
                    written.shapes.push(word);
                    written.last = Some(token.clone());
                    if let Some(light) = &mut light
                        && word != Word::Parallel
                    {
                        let piece = self.whole(&token);
                        if light.beam_sites.iter().all(|(_, site)| site.span != piece.span) {
                            light.beam_sites.push((word, piece));
                        }
                    }
                    self.kind_without_braces(&token)
                }
                TokenKind::Word(Word::PointAt) => {
                    written.last = Some(token.clone());
                    cone.word(&token);
                    written.aimed_after = transforms_of(modifiers);
                    self.vector_after(&token, "a point").map(|given| written.point_at = given.value)
                }
                TokenKind::Word(
                    word @ (Word::Radius
                    | Word::Falloff
                    | Word::Tightness
                    | Word::FadeDistance
                    | Word::FadePower),
                ) => self.number_after(&token, "a number").map(|given| {
                    cone.say(&token, word, &given);
                    written.say(word, given);
                    if word == Word::FadeDistance {
                        written.distances.push((written.fade.distance, self.whole(&token)));
                        self.power_behind_distance(&token);
                    }
                }),
                TokenKind::Word(Word::Shadowless) => {
                    if let Some(light) = &mut light {
                        light.shadowless = true;
                    }
                    Ok(())
                }
                _ => match self.transform_from(&token) {
                    Some(transform) => transform.map(|id| {
                        modifiers.push(Modifier {
                            kind: ModifierKind::Transform(id),
                            site: token.here.site(token.span),
                        });
                    }),
                    None => self.other_light_word(&token),
                },
            };
            failed |= outcome.is_err();
        }
        if let Some(late) = late {
            failed |= self.no_color(&late).is_err();
        }
        if let Some(light) = light.as_deref()
            && !failed
        {
            failed = self.doubt_light(light, &written).is_err();
        }
        if let Some(light) = light.as_deref_mut()
            && let Some(token) = written.spend(light)
        {
            let diagnostic =
                Diagnostic::new(Code::ZeroVector, "this light points at its own place")
                    .at(token.span, "expected a `point_at` other than the light's place");
            // It gives no light, as in POV-Ray 3.7 (measured).
            failed = self.opinion(&token.here, diagnostic).is_err();
            light.color = Rgb::BLACK;
        }
        // What failed may be the word that is missing.
        if let Some(light) = light
            && !failed
        {
            self.lint_light(&cone, &light.kind);
        }
        if failed { Err(Reported) } else { Ok(()) }
    }

    fn other_light_word(&mut self, token: &Token) -> Outcome<()> {
        if let Some(outcome) = self.inert(token, Place::LIGHT) {
            return outcome;
        }
        self.unexpected(token, Place::LIGHT);
        let harmless = matches!(token.kind, TokenKind::Comma | TokenKind::Semicolon);
        if harmless || self.poison.is_some() { Ok(()) } else { Err(Reported) }
    }
}

/// The transforms among the modifiers of a light.
fn transforms_of(modifiers: &[Modifier]) -> Vec<TransformId> {
    let transform = |modifier: &Modifier| match modifier.kind {
        ModifierKind::Transform(id) => Some(id),
        _ => None,
    };
    modifiers.iter().filter_map(transform).collect()
}

/// A word that says how light leaves a place, or loses strength with the distance from it.
fn is_of_a_place(token: &Token) -> bool {
    matches!(
        token.kind,
        TokenKind::Word(
            Word::Parallel
                | Word::Spotlight
                | Word::Cylinder
                | Word::PointAt
                | Word::Radius
                | Word::Falloff
                | Word::Tightness
                | Word::FadeDistance
                | Word::FadePower
        )
    )
}

/// What a light's words say, in whatever order.
struct Written {
    /// `parallel`, `spotlight`, `cylinder`. The last counts; but what is `parallel` is no spotlight.
    shapes: Vec<Word>,
    /// A second kind of beam.
    second: Option<Token>,
    /// The last word that says where its axis lies.
    last: Option<Token>,
    point_at: Vector,
    /// The transforms before it.
    aimed_after: Vec<TransformId>,
    radius: Option<f64>,
    falloff: Option<f64>,
    tightness: f64,
    /// Of distance or power 0 or less: none.
    fade: Fade,
    /// Each `fade_distance`, and all of it as a piece of the text.
    distances: Vec<(f64, Site)>,
    /// The numbers as they stand in the text.
    numbers: Vec<(Word, Given<f64>)>,
    /// Words that a light without a place has no use for.
    of_a_place: Vec<Token>,
}

impl Written {
    /// What a light was before; nothing where there is none.
    ///
    /// **Source:** POV-Ray 3.7's behaviour, measured: its default `point_at` is <0, 0, 1>, where its
    /// manual says <0, 0, 0>; `tightness` is 0, and a `fade_distance` or `fade_power` alone is nothing.
    fn of(light: Option<&LightSource>, dialect: Dialect) -> Self {
        let point_at = match dialect {
            Dialect::Scene => Vector::ZERO,
            Dialect::Pov => Vector::Z,
        };
        let mut written = Self {
            shapes: Vec::new(),
            second: None,
            last: None,
            point_at,
            aimed_after: light.map_or_else(Vec::new, |light| light.aimed_after.clone()),
            radius: None,
            falloff: None,
            tightness: 0.0,
            fade: light.and_then(|light| light.fade).unwrap_or(Fade { distance: 0.0, power: 0.0 }),
            distances: Vec::new(),
            numbers: Vec::new(),
            of_a_place: Vec::new(),
        };
        match light.map(|light| &light.kind) {
            Some(LightKind::Parallel { point_at, .. }) => written.point_at = *point_at,
            Some(
                LightKind::Spotlight { point_at, beam, .. }
                | LightKind::Cylinder { point_at, beam, .. },
            ) => {
                written.point_at = *point_at;
                (written.radius, written.falloff) = (Some(beam.radius), Some(beam.falloff));
                written.tightness = beam.tightness;
            }
            Some(LightKind::Point { .. } | LightKind::Direction { .. }) | None => {}
        }
        written
    }

    /// Notes the number of a word.
    fn say(&mut self, word: Word, given: Given<f64>) {
        match word {
            Word::Radius => self.radius = Some(given.value),
            Word::Falloff => self.falloff = Some(given.value),
            Word::Tightness => self.tightness = given.value,
            Word::FadeDistance => self.fade.distance = given.value.abs(),
            _ => self.fade.power = given.value,
        }
        self.numbers.push((word, given));
    }

    /// The last number of a word, where one is written here.
    fn said(&self, word: Word) -> Option<&Given<f64>> {
        self.numbers.iter().rev().find(|(other, _)| *other == word).map(|(_, given)| given)
    }

    /// The kind of beam it is, as [`Self::spend`] makes it: `spotlight`, `cylinder`, or none.
    fn round(&self, light: &LightSource) -> Option<Word> {
        let before = match light.kind {
            LightKind::Spotlight { .. } => Some(Word::Spotlight),
            LightKind::Cylinder { .. } => Some(Word::Cylinder),
            LightKind::Parallel { .. } => Some(Word::Parallel),
            LightKind::Point { .. } | LightKind::Direction { .. } => None,
        };
        let parallel = before == Some(Word::Parallel) || self.shapes.contains(&Word::Parallel);
        let mut round = self.shapes.iter().rev().copied().chain(before);
        let round = round.find(|word| *word != Word::Parallel)?;
        (round == Word::Cylinder || !parallel).then_some(round)
    }

    /// What has to be taken out for the light not to fade: it takes a distance and a power, and half of a
    /// fade does not outlast its block (measured on POV-Ray 3.7).
    fn note_fade(&self, light: &mut LightSource) {
        let zero = self.distances.iter().rposition(|(distance, _)| *distance == 0.0);
        let since = self.distances.iter().skip(zero.map_or(0, |zero| zero + 1));
        if zero.is_some() || light.fade.is_none() {
            // What was before is hidden, or nothing.
            light.fade_sites.clear();
        } else if self.said(Word::FadePower).is_none() {
            // It goes with the power that was before.
            return;
        }
        since.for_each(|(_, piece)| list_once(&mut light.fade_sites, *piece));
    }

    /// Makes the light what is written; returns the word that needs another `point_at`.
    fn spend(self, light: &mut LightSource) -> Option<Token> {
        let round = self.round(light);
        let parallel = matches!(light.kind, LightKind::Parallel { .. });
        if parallel || self.shapes.contains(&Word::Parallel) {
            // What is parallel is no spotlight.
            light.beam_sites.retain(|(word, _)| *word == Word::Cylinder);
        }
        self.note_fade(light);
        let Self { shapes, last, point_at, radius, falloff, tightness, fade, .. } = self;
        light.aimed_after = self.aimed_after;
        light.fade = (fade.distance > 0.0 && fade.power > 0.0).then_some(fade);
        let (location, shaped) = match light.kind {
            LightKind::Point { location } => (location, !shapes.is_empty()),
            LightKind::Parallel { location, .. }
            | LightKind::Spotlight { location, .. }
            | LightKind::Cylinder { location, .. } => (location, true),
            // Light from infinitely far has neither a distance nor an axis.
            LightKind::Direction { .. } => {
                light.fade = None;
                return None;
            }
        };
        if !shaped {
            return None;
        }
        let beam = |least: f64, most: f64| Beam {
            radius: radius.unwrap_or(least),
            falloff: falloff.unwrap_or(most),
            tightness,
        };
        light.kind = match round {
            Some(Word::Cylinder) => {
                LightKind::Cylinder { location, point_at, beam: beam(0.75, 1.0) }
            }
            Some(_) => LightKind::Spotlight { location, point_at, beam: beam(30.0, 45.0) },
            None => LightKind::Parallel { location, point_at },
        };
        last.filter(|_| location == point_at && light.aimed_after.is_empty())
    }
}
