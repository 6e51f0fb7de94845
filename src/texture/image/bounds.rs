//! Bounds of pictures: intervals that contain their colours and values over a box of points.
//!
//! A box within a few pixels of a planar map has the range of these; any other box has that of all.

use super::{ImageMap, Interpolation, MapType, Place, Source, color};
use crate::color::Color;
use crate::math::Vector;
use crate::math::interval::Interval;
use crate::texture::bounds::{Colors, exactly, hull};
use crate::texture::picture::Samples;

/// The greatest number of pixels along an axis that are looked at.
const MOST: f64 = 6.0;

impl Interpolation {
    /// Returns the number of pixels beyond those around a place that count, by how much of the spread of pixels the
    /// result may be beyond them, and how many spreads it may change over a pixel.
    ///
    /// Along one axis, the absolute weights of a cubic sum to at most 5/4, those of its slope to at most 3; a slope
    /// takes half of its weights' sum, as they cancel. Slopes of distances are not known.
    fn bounds(self) -> (f64, f64, f64) {
        match self {
            Self::None => (0.0, 0.0, f64::INFINITY),
            Self::Bilinear => (0.0, 0.0, 1.0),
            Self::Bicubic => (1.0, 0.5 * (1.25 * 1.25 - 1.0), 1.5 * 1.25),
            Self::NormalizedDistance => (0.0, 0.0, f64::INFINITY),
        }
    }
}

impl ImageMap {
    /// Returns intervals that contain the numbers of the colour at each point within `reach` of `point`.
    pub fn colors_in(&self, point: Vector, reach: Vector) -> Colors {
        self.local(point, reach, |x, y| self.pixel(x, y)).unwrap_or_else(|| {
            let all = self.range().map(|range| beyond(range, self.interpolation.bounds().1));
            match self.map_type == MapType::Planar && !self.once {
                true => all,
                // Where the map shows nothing.
                false => hull(all, exactly(Color { transmit: 1.0, ..Color::WHITE })),
            }
        })
    }

    /// Returns an interval that contains the value at each point within `reach` of `point`.
    pub fn values_in(&self, point: Vector, reach: Vector) -> Interval {
        let most = match (self.source, &self.picture.samples) {
            // Whole numbers, which cubics exceed.
            (Source::Index, Samples::Indexed { .. }) => {
                return Interval { low: -255.0, high: 510.0 };
            }
            (Source::Material, _) => 255.0,
            _ => 1.0,
        };
        let range = Interval { low: 0.0, high: most };
        let local = self.local(point, reach, |x, y| [self.number(x, y)]);
        local.map_or(range, |[value]| value.max(Interval::point(0.0)).min(Interval::point(most)))
    }

    /// Returns the ranges of numbers of pixels; `None` if the box is in too many of them.
    fn local<const N: usize>(
        &self,
        point: Vector,
        reach: Vector,
        pixel: impl Fn(usize, usize) -> [f64; N],
    ) -> Option<[Interval; N]> {
        let (margin, over, speed) = self.interpolation.bounds();
        let counts = [self.picture.width, self.picture.height];
        let shift = if self.interpolation == Interpolation::None { 0.0 } else { 0.5 };
        let mut spans = [(0.0, 0.0); 2];
        let mut step = 0.0;
        for axis in 0..2 {
            let count = counts[axis] as f64;
            // More than rounding.
            let far = reach[axis] + 16.0 * f64::EPSILON * (1.0 + point[axis].abs());
            let (low, high) = (point[axis] - far, point[axis] + far);
            if self.once && (low < 0.0 || high >= 1.0) {
                return None;
            }
            let first = (low * count - shift).floor() - margin;
            let last = (high * count - shift).floor() + margin + 2.0 * shift;
            spans[axis] = (first, last);
            step += far * count;
        }
        let is_short = |(first, last): &(f64, f64)| last - first < MOST && first.abs() < 1e15;
        if self.map_type != MapType::Planar || !spans.iter().all(is_short) {
            return None;
        }
        let index = |at: f64, count: usize| match self.once {
            true => at.clamp(0.0, count as f64 - 1.0) as usize,
            false => (at as i64).rem_euclid(count as i64) as usize,
        };
        let all = |(first, last): (f64, f64)| {
            (0..MOST as u32).map(move |i| first + f64::from(i)).take_while(move |at| *at <= last)
        };
        let mut found: Option<[Interval; N]> = None;
        for y in all(spans[1]) {
            for x in all(spans[0]) {
                let row = counts[1] - 1 - index(y, counts[1]);
                let one = pixel(index(x, counts[0]), row).map(Interval::point);
                found = Some(found.map_or(one, |found| hull(found, one)));
            }
        }
        let found = found?;
        let middle = match speed.is_finite() {
            true => self.blend(Place::new(point.x, point.y), self.once, &pixel),
            false => None,
        };
        Some(std::array::from_fn(|i| {
            let Interval { low, high } = beyond(found[i], over);
            let Some(middle) = middle.map(|middle| middle[i]) else {
                return Interval { low, high };
            };
            let change = (found[i].high - found[i].low) * (step * speed + 1e-14)
                + 1e-14 * low.abs().max(high.abs());
            Interval {
                low: low.max(middle - change).min(middle),
                high: high.min(middle + change).max(middle),
            }
        }))
    }

    /// Returns the ranges of the numbers of all pixels.
    pub(super) fn range(&self) -> Colors {
        let palette = self.palette.iter().map(|pixel| exactly(color(*pixel)));
        if let Some(all) = palette.reduce(hull) {
            // An index beyond the palette has zeros.
            return hull(all, [Interval::point(0.0); 5]);
        }
        let level = match self.divides {
            false => self.extent,
            // The least alpha that is not 0.
            true => {
                let least = match &self.picture.samples {
                    Samples::Eight(_) => 1.0 / 255.0,
                    Samples::Sixteen(_) => 1.0 / 65_535.0,
                    _ => f64::MIN_POSITIVE,
                };
                self.extent.hull(self.extent / Interval::point(least))
            }
        };
        let alpha = match (self.picture.channels, &self.picture.samples) {
            (2 | 4, Samples::Float(_)) => Interval::EVERYTHING,
            (2 | 4, _) => Interval::UNDECIDED,
            _ => Interval::point(1.0),
        };
        let transmit = Interval::point(1.0) - alpha + Interval::point(self.transmit);
        [level, level, level, Interval::point(self.filter), transmit]
    }
}

/// Widens a range by a part of its width, and by rounding.
fn beyond(Interval { low, high }: Interval, part: f64) -> Interval {
    let off = (high - low) * part + 1e-14 * low.abs().max(high.abs());
    match off.is_nan() {
        true => Interval::EVERYTHING,
        false => Interval { low: low - off, high: high + off },
    }
}
