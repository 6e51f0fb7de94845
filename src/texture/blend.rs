//! Blends: things of one kind over the values of a pattern.

use std::sync::Arc;

use super::density::Grid;
use super::function::Closed;
use super::image::ImageMap;
use super::pigment::Pigment;
use super::region::Region;
use super::slope::{self, Slope};
use super::space::{Place, Space, Surroundings};
use crate::math::Vector;
use crate::math::wide::{ROW, Rows};
use crate::pattern::{Kind, Measured, Sample, Setting, Wave, WaveKind};

/// A pattern with its parameters, and what follows its values.
#[derive(Debug, Clone, PartialEq)]
pub struct Pattern {
    pub source: Source,
    pub setting: Setting,
    pub wave: Wave,
}

/// Where the values of a pattern come from.
#[derive(Debug, Clone, PartialEq)]
pub enum Source {
    Kind(Kind),
    /// `function { … }` of the point.
    Function(Arc<Closed>),
    /// `pigment_pattern { … }`: the grey of a pigment.
    Pigment(Arc<Pigment>),
    /// `image_pattern { … }`: the values of a picture.
    Image(Arc<ImageMap>),
    /// `material_map { … }`: numbers of entries, by a picture.
    Material {
        image: Arc<ImageMap>,
        count: usize,
    },
    /// `density_file`.
    Density(Arc<Grid>),
    /// `object { … }`: whether a point is inside.
    Object(Region),
    /// `slope`: how the surface lies.
    Slope(Slope),
    /// `aoi`: how the surface is seen.
    Aoi,
}

impl Source {
    /// Returns the wave of its values, unless its block names another.
    pub fn wave(&self) -> Wave {
        match self {
            Self::Kind(kind) => Wave::new(kind.wave(), kind.frequency(), 0.0),
            Self::Image(_) | Self::Material { .. } | Self::Object(_) => {
                Wave::new(WaveKind::Ramp, 0.0, 0.0)
            }
            _ => Wave::default(),
        }
    }
}

impl Pattern {
    /// Returns the value at a point, with its error bound.
    #[inline]
    pub fn measured(&self, place: &Place) -> Measured {
        let raw = match &self.source {
            Source::Kind(kind) => {
                let error = match kind.has_seams() {
                    true => place.error(),
                    false => Vector::ZERO,
                };
                kind.measured(&Sample { point: place.point, error, setting: &self.setting })
            }
            Source::Function(function) => {
                let raw = function.at(&place.point.to_array());
                // As in POV-Ray 3.7 (measured).
                let value = if raw > 1.0 { raw % 1.0 } else { raw };
                Measured { value: if value.is_finite() { value } else { 0.0 }, error: 0.0 }
            }
            Source::Image(image) => {
                let error = if place.is_sharp() { Vector::ZERO } else { place.error() };
                Measured { value: image.value_within(place.point, error), error: 0.0 }
            }
            Source::Material { image, count } => {
                Measured { value: image.entry(place.point, *count), error: 0.0 }
            }
            Source::Density(grid) => Measured { value: grid.value(place.point), error: 0.0 },
            Source::Object(region) => Measured { value: region.value(place.point), error: 0.0 },
            Source::Slope(slope) => {
                let around = place.around;
                let value = |normal| slope.value(normal, place.point, around.in_world());
                Measured { value: around.normal().map_or(0.0, value), error: 0.0 }
            }
            Source::Aoi => {
                let value = |normal| slope::aoi(place.around.direction(), normal);
                Measured { value: place.around.normal().map_or(0.0, value), error: 0.0 }
            }
            Source::Pigment(pigment) => Measured {
                value: pigment.color(Some(place), place.around).rgb.brightness(),
                error: 0.0,
            },
        };
        self.waved(raw)
    }

    /// Returns the values at four points of the space of a place.
    pub fn values(&self, place: &Place, points: [Vector; 4]) -> [f64; 4] {
        match &self.source {
            Source::Kind(kind) if kind.is_exact(&self.setting) => self.values_of(kind, points),
            _ => points.map(|point| self.measured(&place.moved_to(point)).value),
        }
    }

    /// Returns the values of its kind, which is [exact](Kind::is_exact), at four points.
    pub(super) fn values_of(&self, kind: &Kind, points: [Vector; 4]) -> [f64; 4] {
        let (mut row, mut values) = (Rows::ZERO, [0.0; ROW]);
        for (number, point) in points.into_iter().enumerate() {
            row.set(number, point);
        }
        kind.values(&row, 0b1111, &self.setting, &mut values);
        [0, 1, 2, 3].map(|number: usize| self.wave.value(values[number]))
    }

    /// Returns the value if the point's error does not matter, with an upper bound of its error.
    #[inline]
    pub fn off_seams(&self, place: &Place) -> Option<Measured> {
        let Source::Kind(kind) = &self.source else { return None };
        let sample = Sample { point: place.point, error: Vector::ZERO, setting: &self.setting };
        Some(self.waved(kind.value_off_seams(&sample)?))
    }

    #[inline]
    fn waved(&self, raw: Measured) -> Measured {
        self.wave.measured(raw)
    }
}

/// Things over the values of a pattern.
#[derive(Debug, Clone, PartialEq)]
pub struct Blend<T> {
    pub space: Space,
    pub pattern: Pattern,
    /// Sorted by position; at least one.
    pub entries: Vec<(f64, T)>,
}

/// One or two things at a value: the second with its weight, the rest of 1 is the first's.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Mix<'a, T> {
    One(&'a T),
    Two(&'a T, &'a T, f64),
}

impl<T> Blend<T> {
    /// Returns what lies at a point, and the point in the pattern's space; `None` for a value that is NaN.
    #[inline]
    pub fn at<'t, 'p>(
        &'t self,
        outer: Option<&'p Place<'p>>,
        around: &'p dyn Surroundings,
    ) -> (Place<'p>, Option<Mix<'t, T>>)
    where
        't: 'p,
    {
        let place = Place::new(&self.space, outer, around);
        let off_seams = if place.is_sharp() { self.pattern.off_seams(&place) } else { None };
        if let Some(mix) = off_seams.and_then(|measured| look_up(&self.entries, measured)) {
            return (place, Some(mix));
        }
        let Measured { value, error } = self.pattern.measured(&place);
        let value = match error == 0.0 {
            true => value,
            false => entry_at(&self.entries, value, error).unwrap_or(value),
        };
        (place, look_up(&self.entries, Measured { value, error: 0.0 }))
    }
}

/// Returns the position of the first entry that is within the error of `value`.
fn entry_at<T>(entries: &[(f64, T)], value: f64, error: f64) -> Option<f64> {
    let near = entries.partition_point(|entry| entry.0 < value - error);
    entries.get(near).map(|entry| entry.0).filter(|&entry| entry <= value + error)
}

/// Returns what lies at a value: between two entries both, beyond the first and the last that one. Of several
/// entries with exactly this value the first counts, but at the end the last. `None` if an entry lies within
/// the value's error, or the value is NaN.
///
/// **Source:** POV-Ray 3.7's behaviour, measured on planes of constant gradient.
#[inline(always)]
pub fn look_up<T>(entries: &[(f64, T)], Measured { value, error }: Measured) -> Option<Mix<'_, T>> {
    let (first, last) = (entries.first()?, entries.last()?);
    if value - error >= last.0 {
        return Some(Mix::One(&last.1));
    }
    if value + error <= first.0 {
        return Some(Mix::One(&first.1));
    }
    let above = entries.partition_point(|entry| entry.0 < value);
    let [low, high] = entries.get(above.wrapping_sub(1)..=above)? else { return None };
    let is_told = error == 0.0 || (value - error > low.0 && value + error < high.0);
    is_told.then(|| Mix::Two(&low.1, &high.1, (value - low.0) / (high.0 - low.0)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn number(mix: Mix<f64>) -> f64 {
        match mix {
            Mix::One(one) => *one,
            Mix::Two(low, high, weight) => low + (high - low) * weight,
        }
    }

    fn look_up(map: &[(f64, f64)], value: f64) -> Option<f64> {
        super::look_up(map, Measured { value, error: 0.0 }).map(number)
    }

    #[test]
    fn a_map_is_linear_between_entries_and_constant_outside() {
        let map = [(0.2, 1.0), (0.6, 3.0)];
        let seen = [0.0, 0.2, 0.4, 0.6, 1.0].map(|value| look_up(&map, value));
        assert_eq!(seen, [1.0, 1.0, 2.0, 3.0, 3.0].map(Some));
    }

    #[test]
    fn two_entries_of_one_value_make_a_jump() {
        let map = [(0.0, 0.0), (0.5, 1.0), (0.5, 5.0), (1.0, 6.0)];
        assert_eq!(look_up(&map, 0.5), Some(1.0));
        assert!(look_up(&map, 0.5000001).is_some_and(|number| number >= 5.0));
        assert_eq!(look_up(&map[..3], 0.5), Some(5.0));
    }

    #[test]
    fn a_value_that_may_be_at_a_jump_is_at_it() {
        let map = [(0.0, 0.0), (0.5, 1.0), (0.5, 5.0), (1.0, 6.0)];
        for off in [-9e-13, 0.0, 9e-13] {
            assert_eq!(entry_at(&map, 0.5 + off, 1e-12), Some(0.5), "{off}");
        }
        assert_eq!(entry_at(&map, 0.5 + 2e-12, 1e-12), None);
    }

    #[test]
    fn a_value_that_may_be_at_an_entry_has_nothing_before_that_is_known() {
        let map = [(0.2, 0.0), (0.5, 1.0), (0.5, 5.0), (0.8, 6.0)];
        for value in [0.0, 0.15, 0.19, 0.21, 0.3, 0.49, 0.51, 0.6, 0.79, 0.81, 0.9] {
            let told = super::look_up(&map, Measured { value, error: 0.02 }).map(number);
            let is_near = map.iter().any(|entry| (entry.0 - value).abs() < 0.02);
            assert_eq!(told, look_up(&map, value).filter(|_| !is_near), "{value}");
        }
    }

    #[test]
    fn a_map_of_one_entry_is_that_and_nothing_breaks_on_no_number() {
        assert_eq!(look_up(&[(0.3, 2.0)], 0.9), Some(2.0));
        assert_eq!(look_up(&[(0.3, 2.0), (0.4, 3.0)], f64::NAN), None);
        assert_eq!(look_up(&[], 0.5), None);
    }
}
