//! What the words of a light say, and the light that they make.
//!
//! **Invariant:** of words of one kind the last counts, in whatever order they stand.

use crate::math::Vector;
use crate::scene::{Beam, Dialect, Fade, LightKind, LightSource, TransformId};
use crate::source::Site;
use crate::vocabulary::Word;

use super::super::super::stream::Token;
use super::super::finish::list_once;
use super::super::part::Given;

/// What a light's words say, in whatever order.
pub(super) struct Written {
    /// `parallel`, `spotlight`, `cylinder`. The last counts; but what is `parallel` is no spotlight.
    pub shapes: Vec<Word>,
    /// A second kind of beam.
    pub second: Option<Token>,
    /// The last word that says where its axis lies.
    pub last: Option<Token>,
    pub point_at: Vector,
    /// The transforms before it.
    pub aimed_after: Vec<TransformId>,
    pub radius: Option<f64>,
    pub falloff: Option<f64>,
    pub tightness: f64,
    /// Of distance or power 0 or less: none.
    pub fade: Fade,
    /// Each `fade_distance`, and all of it as a piece of the text.
    pub distances: Vec<(f64, Site)>,
    /// The numbers as they stand in the text.
    pub numbers: Vec<(Word, Given<f64>)>,
    /// Words that a light without a place has no use for.
    pub of_a_place: Vec<Token>,
}

impl Written {
    /// What a light was before; nothing where there is none.
    ///
    /// **Source:** POV-Ray 3.7's behaviour, measured: its default `point_at` is <0, 0, 1>, where its
    /// manual says <0, 0, 0>; `tightness` is 0, and a `fade_distance` or `fade_power` alone is nothing.
    pub fn of(light: Option<&LightSource>, dialect: Dialect) -> Self {
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
    pub fn say(&mut self, word: Word, given: Given<f64>) {
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
    pub fn said(&self, word: Word) -> Option<&Given<f64>> {
        self.numbers.iter().rev().find(|(other, _)| *other == word).map(|(_, given)| given)
    }

    /// The kind of beam it is, as [`Self::spend`] makes it: `spotlight`, `cylinder`, or none.
    pub fn round(&self, light: &LightSource) -> Option<Word> {
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
    pub fn spend(self, light: &mut LightSource) -> Option<Token> {
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
