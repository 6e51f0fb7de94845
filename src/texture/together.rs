//! Colours of one pigment at points side by side.
//!
//! **In:** points in the space where the pigment starts. **Out:** a colour each. **Invariant:** each is that of its
//! point alone, to the bit.
//!
//! This is for the pigments that most textures are made of: colours over a pattern whose values do not depend on how
//! well the points are known.

use super::blend::{Blend, Mix, Source, look_up};
use super::pigment::Pigment;
use super::space::{Start, Step};
use crate::color::Color;
use crate::math::wide::{ROW, Rows, numbers};
use crate::pattern::{Kind, Measured};

/// A pigment whose colours are found together.
pub struct Together<'a> {
    ramp: &'a Blend<Color>,
    kind: &'a Kind,
    /// The slot in whose space the points are.
    pub slot: u32,
}

impl Pigment {
    /// Returns how its colours are found together; `None` if they are found point by point.
    pub fn together(&self) -> Option<Together<'_>> {
        let Self::Ramp(ramp) = self else { return None };
        let slot = match ramp.space.start {
            Start::Slot(slot) => slot,
            Start::Outer => 0,
            Start::Uv | Start::UvTurned(_) => return None,
        };
        match &ramp.pattern.source {
            Source::Kind(kind) if kind.is_exact(&ramp.pattern.setting) => {
                Some(Together { ramp, kind, slot })
            }
            _ => None,
        }
    }
}

impl Together<'_> {
    /// Replaces each of the colours that the mask has a bit for by that at its point. Moves the points.
    pub fn colors(&self, points: &mut Rows, mask: u32, colors: &mut [Color; ROW]) {
        let Blend { space, pattern, entries } = self.ramp;
        for step in &space.steps {
            match step {
                Step::Map(map) => {
                    for number in numbers(mask) {
                        points.set(number, map.point(points.at(number)));
                    }
                }
                Step::Warp(warp) => warp.points(points, mask),
            }
        }
        let mut values = [0.0; ROW];
        self.kind.values(points, mask, &pattern.setting, &mut values);
        for number in numbers(mask) {
            let value = pattern.wave.value(values[number]);
            colors[number] = match look_up(entries, Measured { value, error: 0.0 }) {
                Some(Mix::One(color)) => *color,
                Some(Mix::Two(low, high, weight)) => low.lerp(*high, weight),
                None => Color::BLACK,
            };
        }
    }
}
