//! Normals: how `normal { … }` perturbs the normal of a surface, so that it looks bumpy.
//!
//! **In:** a smooth normal, turned toward the viewer. **Out:** the perturbed normal, of length 1, finite for
//! every point and parameter. **Invariant:** a perturbed normal is the sum of the normal and a vector, in the
//! space of the pattern (see `Frame`). That vector is the amount times the displacement that a pattern has:
//! its own, or that of `bump`.

pub(crate) mod blend;
pub(crate) mod bump;
pub(crate) mod bump_map;
pub(super) mod frame;
pub mod slope_map;

use std::sync::Arc;

pub(crate) use frame::Frame;

use super::blend::{Blend, Mix, Pattern, Source};
use super::image::ImageMap;
use super::space::{Place, Space, Surroundings, Turn};
use super::walk::Node;
use crate::math::Vector;
use crate::pattern::Sample;

/// The normals of a surface.
#[derive(Debug, Clone, PartialEq)]
pub enum Normal {
    /// Bumps of a pattern.
    Bumps(Bumps),
    /// Bumps of a picture.
    Image { space: Space, image: Arc<ImageMap>, amount: f64, keeps_depth: bool },
    /// Normals over a pattern.
    Blend { blend: Blend<Arc<Normal>>, keeps_depth: bool },
    /// The mean of normals by their weights.
    Average { space: Space, entries: Vec<(f64, Arc<Normal>)>, keeps_depth: bool },
}

/// Bumps whose height is the value of a pattern.
#[derive(Debug, Clone, PartialEq)]
pub struct Bumps {
    pub space: Space,
    pub pattern: Pattern,
    /// How steep they are; may be negative.
    pub amount: f64,
    /// The distance at which the pattern is sampled for its slope.
    pub accuracy: f64,
    /// Heights over the pattern's value; empty for the value itself.
    pub slopes: Vec<slope_map::Entry>,
    /// `no_bump_scale`.
    pub keeps_depth: bool,
}

impl Normal {
    /// Returns the perturbed normal of a surface. `normal` has length 1 and points toward the viewer.
    pub fn perturbed(
        &self,
        normal: Vector,
        outer: Option<&Place>,
        around: &dyn Surroundings,
    ) -> Vector {
        frame::unit(self.entry(normal, (outer, None), false, around), normal)
    }

    /// As [`Self::perturbed`], not of length 1 where bumps keep their depth. `within` is the point in the space
    /// of the normal around it, which has turned `normal`; a texture around it has not. `keeps` is whether that normal
    /// keeps its depth.
    fn entry(
        &self,
        normal: Vector,
        (outer, within): (Option<&Place>, Option<&Place>),
        keeps: bool,
        around: &dyn Surroundings,
    ) -> Vector {
        let keeps = keeps || self.keeps_depth();
        match self {
            Self::Bumps(bumps) => bumps.entry(normal, (outer, within), keeps, around),
            Self::Image { space, image, amount, .. } => {
                let place = Place::new(space, outer, around);
                let frame = Frame::new(turned(&place, within), keeps);
                frame.entry(normal, |normal| match image.heights(place.point) {
                    Some(heights) => {
                        let direction = frame::unit(normal, Vector::Y);
                        bump_map::displacement(direction, heights) * *amount
                    }
                    None => Vector::ZERO,
                })
            }
            Self::Blend { blend, .. } => {
                let (place, mix) = blend.at(outer, around);
                let frame = Frame::new(turned(&place, within), keeps);
                frame.entry(normal, |normal| {
                    let within = (Some(&place), Some(&place));
                    let inside = |inner: &Normal| inner.entry(normal, within, keeps, around);
                    match mix {
                        None => Vector::ZERO,
                        Some(Mix::One(one)) => inside(one) - normal,
                        Some(Mix::Two(low, high, weight)) => {
                            blend::between(inside(low), inside(high), weight, normal) - normal
                        }
                    }
                })
            }
            Self::Average { space, entries, .. } => {
                let place = Place::new(space, outer, around);
                let frame = Frame::new(turned(&place, within), keeps);
                frame.entry(normal, |normal| {
                    let within = (Some(&place), Some(&place));
                    let entries = entries.iter().map(|(weight, inner)| {
                        (*weight, inner.entry(normal, within, keeps, around))
                    });
                    blend::average(entries, normal) - normal
                })
            }
        }
    }

    /// Returns whether it says `no_bump_scale`, which holds for its entries, too.
    fn keeps_depth(&self) -> bool {
        match self {
            Self::Bumps(Bumps { keeps_depth, .. })
            | Self::Image { keeps_depth, .. }
            | Self::Blend { keeps_depth, .. }
            | Self::Average { keeps_depth, .. } => *keeps_depth,
        }
    }

    /// Calls `visit` for the space of each of its nodes, with the pattern that is evaluated in it; of a shared one
    /// once.
    pub fn for_each_space<'a>(&'a self, visit: &mut dyn FnMut(&'a Space, Option<&'a Pattern>)) {
        for node in self.nodes() {
            match node {
                Self::Bumps(bumps) => visit(&bumps.space, Some(&bumps.pattern)),
                Self::Blend { blend, .. } => visit(&blend.space, Some(&blend.pattern)),
                Self::Image { space, .. } | Self::Average { space, .. } => visit(space, None),
            }
        }
    }
}

/// Returns the map from the space around a node to its own.
fn turned(place: &Place, outer: Option<&Place>) -> Turn {
    match outer {
        // Both are relative to the world.
        Some(outer) => place.turn().after(outer.turn().inverse()),
        None => place.turn(),
    }
}

impl Bumps {
    fn entry(
        &self,
        normal: Vector,
        (outer, within): (Option<&Place>, Option<&Place>),
        keeps: bool,
        around: &dyn Surroundings,
    ) -> Vector {
        let place = Place::new(&self.space, outer, around);
        let frame = Frame::new(turned(&place, within), keeps);
        frame.entry(normal, |normal| self.displacement(normal, &place))
    }

    fn displacement(&self, normal: Vector, place: &Place) -> Vector {
        if let Source::Kind(kind) = &self.pattern.source {
            let setting = &self.pattern.setting;
            let sample = Sample { point: place.point, error: Vector::ZERO, setting };
            if let Some(own) = kind.displacement(normal, &sample) {
                let amount = if kind.scales_by_amount() { self.amount } else { 1.0 };
                return own * amount;
            }
        }
        self.leaning(place.point, |points| self.pattern.values(place, points))
    }

    /// Returns the displacement that follows from the values of the pattern around a point.
    pub(super) fn leaning(
        &self,
        point: Vector,
        values: impl FnOnce([Vector; 4]) -> [f64; 4],
    ) -> Vector {
        let height = |value| match self.slopes.is_empty() {
            true => value,
            false => slope_map::height(&self.slopes, value),
        };
        bump::displacement(point, self.accuracy, |points| values(points).map(height)) * self.amount
    }
}

#[cfg(test)]
mod tests;
