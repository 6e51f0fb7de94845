//! Colours of one pigment, and normals of one kind of bumps, at points side by side.
//!
//! **In:** points in the space where the texture starts. **Out:** a colour or a normal each. **Invariant:** each is that
//! of its point alone, to the bit.
//!
//! This is for what most textures are made of: one pattern whose values do not depend on how well the points are known.

use super::blend::{Blend, Mix, Pattern, Source, look_up};
use super::normal::frame::{self, Frame};
use super::normal::{Bumps, Normal};
use super::pigment::Pigment;
use super::space::{Space, Start, Step, Turn};
use crate::color::Color;
use crate::math::wide::{ROW, Rows, numbers};
use crate::pattern::{Kind, Measured};

/// Something over one pattern that is evaluated at points side by side.
pub struct Together<'a, T> {
    node: &'a T,
    kind: &'a Kind,
    /// The slot in whose space the points are.
    pub slot: u32,
}

impl<'a, T> Together<'a, T> {
    fn new(node: &'a T, space: &Space, pattern: &'a Pattern) -> Option<Self> {
        let slot = match space.start {
            Start::Slot(slot) => slot,
            Start::Outer => 0,
            Start::Uv | Start::UvTurned(_) => return None,
        };
        match &pattern.source {
            Source::Kind(kind) if kind.is_exact(&pattern.setting) => {
                Some(Self { node, kind, slot })
            }
            _ => None,
        }
    }
}

impl Pigment {
    /// Returns how its colours are found together; `None` if they are found point by point.
    pub fn together(&self) -> Option<Together<'_, Blend<Color>>> {
        let Self::Ramp(ramp) = self else { return None };
        Together::new(ramp, &ramp.space, &ramp.pattern)
    }
}

impl Normal {
    /// Returns how normals are perturbed together; `None` if they are so one by one.
    pub fn together(&self) -> Option<Together<'_, Bumps>> {
        let Self::Bumps(bumps) = self else { return None };
        Together::new(bumps, &bumps.space, &bumps.pattern)
    }
}

impl Together<'_, Blend<Color>> {
    /// Replaces each of the colours that the mask has a bit for by that at its point. Moves the points.
    pub fn colors(&self, points: &mut Rows, mask: u32, colors: &mut [Color; ROW]) {
        let Blend { space, pattern, entries } = self.node;
        space.enter(points, mask);
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

impl Together<'_, Bumps> {
    /// Perturbs each of the normals that the mask has a bit for; see [`Normal::perturbed`]. Moves the points. `turn` is
    /// the map from the world to the space where they are.
    pub fn perturb(&self, turn: Turn, points: &mut Rows, mask: u32, normals: &mut Rows) {
        let Self { node: bumps, kind, .. } = self;
        let Bumps { space, pattern, amount, keeps_depth, .. } = bumps;
        space.enter(points, mask);
        let start = if space.start == Start::Outer { Turn::NONE } else { turn };
        let frame = Frame::new(space.turn(start), *keeps_depth);
        let [mut inner, mut vectors] = [Rows::ZERO; 2];
        for number in numbers(mask) {
            inner.set(number, frame.inner(normals.at(number)));
        }
        let setting = &pattern.setting;
        let scale = if kind.scales_by_amount() { *amount } else { 1.0 };
        let is_own = kind.displacements(&inner, points, mask, setting, &mut vectors);
        for number in numbers(mask) {
            let displacement = match is_own {
                true => vectors.at(number) * scale,
                false => {
                    let values = |points| pattern.values_of(kind, points);
                    bumps.leaning(points.at(number), values)
                }
            };
            let normal = normals.at(number);
            let sum = inner.at(number) + displacement;
            normals.set(number, frame::unit(frame.outer(sum, normal), normal));
        }
    }
}

impl Space {
    /// Moves each of the points that the mask has a bit for from where the node starts to its space.
    fn enter(&self, points: &mut Rows, mask: u32) {
        for step in &self.steps {
            match step {
                Step::Map(map) => {
                    for number in numbers(mask) {
                        points.set(number, map.point(points.at(number)));
                    }
                }
                Step::Warp(warp) => warp.points(points, mask),
            }
        }
    }
}
