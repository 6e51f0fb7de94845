//! Settings of a light as written, and the light that results from them.
//!
//! **Invariant:** the last keyword of each kind counts, in whatever order they appear.

use crate::math::Vector;
use crate::scene::{Beam, Dialect, Fade, LightKind, LightSource, TransformId};
use crate::vocabulary::Word;

use super::super::super::stream::Token;
use super::super::part::Given;

/// Settings of a light.
pub(super) struct Written {
    /// `parallel`, `spotlight` and `cylinder`, in source order. The last counts; it may be `parallel`, too. In a `.pov`, `shadowless` is a kind of light, too.
    pub shapes: Vec<Word>,
    /// A second kind, and the one that it replaces.
    pub second: Option<(Token, Word)>,
    dialect: Dialect,
    /// The last keyword that sets its axis.
    pub last: Option<Token>,
    pub point_at: Vector,
    /// The transforms before `point_at`.
    pub aimed_after: Vec<TransformId>,
    pub radius: Option<f64>,
    pub falloff: Option<f64>,
    pub tightness: f64,
    /// No fading if the distance or the power is 0 or less.
    pub fade: Fade,
    /// The numbers as written.
    pub numbers: Vec<(Word, Given<f64>)>,
    /// The last `circular` or `orient`.
    pub round_area: Option<Token>,
    /// Keywords that are invalid for a light without a position.
    pub of_a_place: Vec<Token>,
}

impl Written {
    /// Returns the settings of an existing light; the defaults if there is none.
    ///
    /// **Source:** measured in POV-Ray 3.7: the default `point_at` is <0, 0, 1>, although its manual says <0,
    /// 0, 0>; `tightness` is 0, and a `fade_distance` or `fade_power` alone has no effect.
    pub fn of(light: Option<&LightSource>, dialect: Dialect) -> Self {
        let point_at = match dialect {
            Dialect::Scene => Vector::ZERO,
            Dialect::Pov => Vector::Z,
        };
        let mut written = Self {
            shapes: Vec::new(),
            second: None,
            dialect,
            last: None,
            point_at,
            aimed_after: light.map_or_else(Vec::new, |light| light.aimed_after.clone()),
            radius: None,
            falloff: None,
            tightness: 0.0,
            fade: light.and_then(|light| light.fade).unwrap_or(Fade { distance: 0.0, power: 0.0 }),
            numbers: Vec::new(),
            round_area: None,
            of_a_place: Vec::new(),
        };
        match light.map(|light| &light.kind) {
            Some(LightKind::Parallel { point_at, beam: None, .. }) => written.point_at = *point_at,
            Some(
                LightKind::Parallel { point_at, beam: Some(beam), .. }
                | LightKind::Spotlight { point_at, beam, .. }
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

    /// Records a kind of light.
    ///
    /// In a `.pov`, `spotlight`, `cylinder` and `shadowless` exclude each other, and the last counts, with the
    /// numbers after it: a `spotlight` that is `shadowless` shines all around, and a `shadowless` light that is
    /// a `spotlight` casts shadows. (Measured on POV-Ray 3.7.)
    pub fn shape(&mut self, word: Word, token: &Token) {
        let other = self.shapes.iter().rev().find(|of| ![word, Word::Parallel].contains(of));
        if let Some(other) = other.filter(|_| word != Word::Parallel) {
            self.second = Some((token.clone(), *other));
        }
        let is_first = self.shapes.iter().all(|of| *of == Word::Parallel);
        if self.dialect == Dialect::Pov && word != Word::Parallel && !is_first {
            (self.radius, self.falloff, self.tightness) = (None, None, 0.0);
        }
        self.shapes.push(word);
    }

    /// Records the number of a keyword.
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

    /// Returns the last number of a keyword that is written here.
    pub fn said(&self, word: Word) -> Option<&Given<f64>> {
        self.numbers.iter().rev().find(|(other, _)| *other == word).map(|(_, given)| given)
    }

    /// Returns the kind of beam that [`Self::spend`] creates: `spotlight`, `cylinder`, or none.
    pub fn round(&self, light: &LightSource) -> Option<Word> {
        let before = match light.kind {
            LightKind::Spotlight { .. } | LightKind::Parallel { beam: Some(_), .. } => {
                Some(Word::Spotlight)
            }
            LightKind::Cylinder { .. } => Some(Word::Cylinder),
            LightKind::Parallel { beam: None, .. } => Some(Word::Parallel),
            LightKind::Point { .. } | LightKind::Direction { .. } => None,
        };
        let mut round = self.shapes.iter().rev().copied().chain(before);
        let round = round.find(|word| *word != Word::Parallel)?;
        (round != Word::Shadowless).then_some(round)
    }

    /// Returns whether rays are parallel. In a `.pov`, they still are if a kind after `cylinder` replaces it
    /// (measured on POV-Ray 3.7).
    fn is_parallel(&self, light: &LightSource) -> bool {
        let stays = |word| self.dialect == Dialect::Pov && word == Word::Cylinder;
        let before = match light.kind {
            LightKind::Parallel { .. } => true,
            LightKind::Cylinder { .. } => stays(Word::Cylinder),
            _ => false,
        };
        before || self.shapes.iter().any(|&word| word == Word::Parallel || stays(word))
    }

    /// Applies the settings to the light; returns the keyword that needs another `point_at`.
    pub fn spend(self, light: &mut LightSource) -> Option<Token> {
        let (round, is_parallel) = (self.round(light), self.is_parallel(light));
        let Self { shapes, last, point_at, radius, falloff, tightness, fade, .. } = self;
        light.aimed_after = self.aimed_after;
        light.fade = (fade.distance > 0.0 && fade.power > 0.0).then_some(fade);
        let (location, shaped) = match light.kind {
            LightKind::Point { location } => (location, !shapes.is_empty()),
            LightKind::Parallel { location, .. }
            | LightKind::Spotlight { location, .. }
            | LightKind::Cylinder { location, .. } => (location, true),
            // A light at infinity has neither a distance nor an axis.
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
            Some(_) if is_parallel => {
                LightKind::Parallel { location, point_at, beam: Some(beam(30.0, 45.0)) }
            }
            Some(_) => LightKind::Spotlight { location, point_at, beam: beam(30.0, 45.0) },
            None if is_parallel => LightKind::Parallel { location, point_at, beam: None },
            None => {
                light.kind = LightKind::Point { location };
                return None;
            }
        };
        last.filter(|_| location == point_at && light.aimed_after.is_empty())
    }
}
