//! Pigments: the colour of every point of a surface.

use std::sync::Arc;

use super::blend::{Blend, Mix, Pattern};
use super::image::ImageMap;
use super::space::{Nowhere, Place, Space, Surroundings};
use super::walk::Node;
use crate::color::Color;
use crate::math::Vector;

/// The colour beside a picture that is shown once, as in POV-Ray 3.7 (measured).
const NOTHING: Color = Color { transmit: 1.0, ..Color::WHITE };

/// The colours of a surface. Most are of one colour, so what patterns need is boxed.
#[derive(Debug, Clone, PartialEq)]
pub enum Pigment {
    Color(Color),
    /// Colours over a pattern.
    Ramp(Box<Blend<Color>>),
    /// Pigments over a pattern.
    Blend(Box<Blend<Arc<Pigment>>>),
    /// The mean of pigments by their weights, which sum to 1.
    Average {
        space: Space,
        entries: Vec<(f64, Arc<Pigment>)>,
    },
    /// The colours of a picture: `image_map`.
    Image {
        space: Space,
        image: Arc<ImageMap>,
    },
    /// The colours of a mesh's faces, by corner: `shape::mesh::Skin::paint`. At least two.
    Faces(Arc<[Color]>),
}

impl Pigment {
    /// Returns its colour at a point of a surface. `outer` is the point in the space of the node around it.
    #[inline]
    pub fn color(&self, outer: Option<&Place>, around: &dyn Surroundings) -> Color {
        match self {
            Self::Color(color) => *color,
            Self::Ramp(blend) => match blend.at(outer, around).1 {
                Some(Mix::One(color)) => *color,
                Some(Mix::Two(low, high, weight)) => low.lerp(*high, weight),
                None => Color::BLACK,
            },
            Self::Blend(blend) => {
                let (place, mix) = blend.at(outer, around);
                match mix {
                    Some(Mix::One(pigment)) => pigment.color(Some(&place), around),
                    Some(Mix::Two(low, high, weight)) => {
                        let low = low.color(Some(&place), around);
                        low.lerp(high.color(Some(&place), around), weight)
                    }
                    None => Color::BLACK,
                }
            }
            Self::Average { space, entries } => {
                let place = Place::new(space, outer, around);
                entries.iter().fold(Color::default(), |sum, (weight, pigment)| {
                    sum.plus(pigment.color(Some(&place), around), *weight)
                })
            }
            Self::Image { space, image } => {
                let place = Place::new(space, outer, around);
                let error = if place.is_sharp() { Vector::ZERO } else { place.error() };
                image.color_within(place.point, error).unwrap_or(NOTHING)
            }
            Self::Faces(colors) => {
                let Some(paint) = around.paint() else {
                    // A point alone does not identify the face.
                    return colors.first().copied().unwrap_or(Color::BLACK);
                };
                paint.into_iter().fold(Color::default(), |sum, (index, weight)| {
                    match colors.get(index as usize).filter(|_| weight > 0.0) {
                        Some(color) => sum.plus(*color, weight),
                        None => sum,
                    }
                })
            }
        }
    }

    /// Returns its colour at an exact point of space.
    pub fn color_at(&self, point: Vector) -> Color {
        self.color(None, &Nowhere::exact(point))
    }

    /// Calls `visit` for each of its colours, without positions in maps; for those of a shared pigment once.
    pub fn for_each_color(&self, visit: &mut dyn FnMut(Color)) {
        if let Self::Color(color) = self {
            return visit(*color);
        }
        for node in self.nodes() {
            match node {
                Self::Color(color) => visit(*color),
                Self::Ramp(blend) => blend.entries.iter().for_each(|(_, color)| visit(*color)),
                Self::Blend(_) | Self::Average { .. } => {}
                Self::Image { image, .. } => image.for_each_color(visit),
                Self::Faces(colors) => colors.iter().for_each(|color| visit(*color)),
            }
        }
    }

    /// Returns its colours, without positions in maps.
    pub fn colors(&self) -> Vec<Color> {
        let mut colors = Vec::new();
        self.for_each_color(&mut |color| colors.push(color));
        colors
    }

    /// Returns whether light passes through it anywhere.
    pub fn is_clear(&self) -> bool {
        if let Self::Color(color) = self {
            return color.is_clear();
        }
        let mut clear = false;
        self.for_each_color(&mut |color| clear |= color.is_clear());
        clear
    }

    /// Returns whether its colour depends on the point.
    pub fn is_patterned(&self) -> bool {
        !matches!(self, Self::Color(_) | Self::Faces(_))
    }

    /// Calls `visit` for the space of each of its nodes, with the pattern that is evaluated in it; of a shared one
    /// once.
    pub fn for_each_space<'a>(&'a self, visit: &mut dyn FnMut(&'a Space, Option<&'a Pattern>)) {
        for node in self.nodes() {
            match node {
                Self::Color(_) | Self::Faces(_) => {}
                Self::Ramp(blend) => visit(&blend.space, Some(&blend.pattern)),
                Self::Blend(blend) => visit(&blend.space, Some(&blend.pattern)),
                Self::Image { space, .. } | Self::Average { space, .. } => visit(space, None),
            }
        }
    }
}
