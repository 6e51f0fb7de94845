//! Pictures in textures: `image_map`, `image_pattern` and `bump_map` look up a pixel for a point.
//!
//! A map places the picture ([`MapType`]), picks pixels ([`Interpolation`]) and converts their numbers
//! ([`Conversion`]).
//!
//! **Source:** POV-Ray 3.7 manual, sections "Image Map", "Image Pattern" and "Bitmap Modifiers"; all of it
//! measured on POV-Ray 3.7, to its single precision.

mod bounds;
pub mod conversion;
mod interpolation;
mod projection;

pub use interpolation::Interpolation;
pub use projection::MapType;

use std::sync::Arc;

use super::picture::{Picture, Samples};
use crate::color::{Color, Gamma, Rgb};
use crate::math::Vector;
use crate::math::interval::Interval;
use conversion::{Conversion, Purpose};
use interpolation::{Blend, Grid};
use projection::Place;

/// What [`ImageMap::value`] returns.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Source {
    /// Brightness, 0 to 1. Alpha makes no difference.
    #[default]
    Color,
    /// `use_index` of a `bump_map`: the index in the palette, 0 to 255; brightness without a palette. Between
    /// pixels it is a whole number, too, without its fraction; `interpolate 3` goes beyond that range.
    Index,
    /// The number of a texture in a `material_map`: the index in the palette, or 255 times the red.
    Material,
    /// `use_alpha`: 0 where the picture is opaque, and 1 where it is clear. Without alpha or a palette, it is
    /// the first channel.
    Alpha,
}

/// A picture on a surface.
#[derive(Debug, Clone, PartialEq)]
pub struct ImageMap {
    picture: Arc<Picture>,
    pub map_type: MapType,
    /// Whether the picture is shown once, instead of repeatedly.
    pub once: bool,
    pub interpolation: Interpolation,
    pub source: Source,
    levels: Levels,
    /// The range of converted numbers.
    extent: Interval,
    /// The colours of the palette, with `filter` and `transmit`; empty if there is none.
    palette: Vec<Pixel>,
    /// `filter all` and `transmit all` of a picture without a palette.
    filter: f64,
    transmit: f64,
    /// Whether colours are divided by alpha.
    divides: bool,
}

/// Red, green, blue, `filter` and `transmit`.
type Pixel = [f64; 5];

/// Converted numbers, by the numbers of the file.
#[derive(Debug, Clone, PartialEq)]
enum Levels {
    Table(Arc<[f64]>),
    /// For floats, and palettes, whose colours are converted already.
    Direct(Conversion),
}

impl Levels {
    fn new(samples: &Samples, conversion: Conversion) -> Self {
        let table = |most: u32| {
            let level = |n: u32| conversion.convert(f64::from(n) / f64::from(most));
            Self::Table((0..=most).map(level).collect())
        };
        match samples {
            Samples::Eight(_) => table(255),
            Samples::Sixteen(_) => table(65_535),
            Samples::Float(_) | Samples::Indexed { .. } => Self::Direct(conversion),
        }
    }
}

impl Levels {
    /// Returns the range of the converted numbers of a picture; conversions do not fall.
    fn extent(&self, samples: &Samples) -> Interval {
        match (self, samples) {
            (Self::Table(levels), _) => {
                let ends = [levels.first(), levels.last()].map(|end| end.copied().unwrap_or(0.0));
                Interval::between(ends[0], ends[1])
            }
            (Self::Direct(conversion), Samples::Float(samples)) => {
                let numbers = samples.iter().filter(|number| !number.is_nan());
                let limited = numbers.map(|number| f64::from(number.clamp(f32::MIN, f32::MAX)));
                let range = |range: Interval, number| range.hull(Interval::point(number));
                let Interval { low, high } = limited.fold(Interval::point(0.0), range);
                Interval::between(conversion.convert(low), conversion.convert(high))
            }
            (Self::Direct(_), _) => Interval::UNDECIDED,
        }
    }
}

/// Which property of colours that let light through is set: [`ImageMap::set_clear`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Clear {
    Filter,
    Transmit,
}

/// Why `filter` or `transmit` of a palette index cannot be set.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NoIndex {
    /// The picture has no palette.
    NoPalette,
    /// Its palette has so many colours.
    Beyond(usize),
}

impl ImageMap {
    /// Returns the planar map that repeats the picture without interpolation.
    ///
    /// `gamma` and `premultiplied` are what the block says, if anything.
    pub fn new(
        picture: Arc<Picture>,
        purpose: Purpose,
        gamma: Option<Gamma>,
        premultiplied: Option<bool>,
    ) -> Self {
        let conversion = Conversion::new(picture.encoding, gamma, purpose);
        let levels = Levels::new(&picture.samples, conversion);
        let extent = levels.extent(&picture.samples);
        let divides = purpose != Purpose::Values
            && matches!(picture.channels, 2 | 4)
            && premultiplied.unwrap_or(picture.is_multiplied);
        let palette = match &picture.samples {
            Samples::Indexed { palette, .. } => {
                let color = |&[r, g, b, alpha]: &[u8; 4]| {
                    let [r, g, b] = [r, g, b].map(|c| conversion.convert(f64::from(c) / 255.0));
                    [r, g, b, 0.0, 1.0 - f64::from(alpha) / 255.0]
                };
                palette.iter().map(color).collect()
            }
            _ => Vec::new(),
        };
        Self {
            picture,
            map_type: MapType::Planar,
            once: false,
            interpolation: Interpolation::None,
            source: Source::Color,
            levels,
            extent,
            palette,
            filter: 0.0,
            transmit: 0.0,
            divides,
        }
    }

    /// Sets `filter` or `transmit` of one colour of the palette, or of `all` colours.
    ///
    /// A palette's own transparency is replaced; `transmit all` adds to that of an alpha channel.
    pub fn set_clear(
        &mut self,
        which: Clear,
        index: Option<u8>,
        amount: f64,
    ) -> Result<(), NoIndex> {
        let channel = match which {
            Clear::Filter => 3,
            Clear::Transmit => 4,
        };
        let has_palette = matches!(self.picture.samples, Samples::Indexed { .. });
        let count = self.palette.len();
        match index {
            Some(_) if !has_palette => return Err(NoIndex::NoPalette),
            Some(index) => {
                let color = self.palette.get_mut(usize::from(index));
                color.ok_or(NoIndex::Beyond(count))?[channel] = amount;
            }
            None if has_palette => self.palette.iter_mut().for_each(|c| c[channel] = amount),
            None if which == Clear::Filter => self.filter = amount,
            None => self.transmit = amount,
        }
        Ok(())
    }

    /// Calls `visit` for the colours of the palette, or for one as bright as its brightest number; then for a clear
    /// one, if it may have such.
    pub fn for_each_color(&self, visit: &mut dyn FnMut(Color)) {
        let has_alpha = matches!(self.picture.channels, 2 | 4);
        let is_clear = self.once
            || has_alpha
            || self.filter != 0.0
            || self.transmit != 0.0
            || self.palette.iter().any(|color| color[3] != 0.0 || color[4] != 0.0);
        self.palette.iter().for_each(|pixel| visit(color(*pixel)));
        if self.palette.is_empty() {
            let rgb = Rgb::WHITE * self.extent.high;
            visit(Color { rgb, filter: self.filter, transmit: 0.0 });
        }
        if is_clear && self.filter == 0.0 {
            visit(Color { transmit: 1.0, ..Color::WHITE });
        }
    }

    /// Returns a function of the heights around a point, by pixels to the right and up; `None` where the map
    /// shows nothing. Neighbours wrap, also in a picture that is shown once; but what is interpolated there
    /// ends at its edges.
    ///
    /// **Source:** POV-Ray 3.7's behaviour, measured.
    pub fn heights(&self, point: Vector) -> Option<impl Fn(f64, f64) -> f64> {
        let place = self.map_type.place(point, Vector::ZERO)?;
        let place = if self.once { place.inside()? } else { place };
        let Picture { width, height, .. } = *self.picture;
        Some(move |right: f64, up: f64| {
            let (u, v) = (place.u + right / width as f64, place.v + up / height as f64);
            let place = match self.once {
                true => Place::new(fraction(u), fraction(v)),
                false => Place::new(u, v),
            };
            self.value_at(place, self.once)
        })
    }

    pub fn picture(&self) -> &Picture {
        &self.picture
    }

    /// Returns the colour at a point; `None` where the map shows nothing, which is fully transparent (POV-Ray
    /// has white with `transmit` 1 there).
    #[inline]
    pub fn color(&self, point: Vector) -> Option<Color> {
        self.color_within(point, Vector::ZERO)
    }

    /// Returns the colour at a point that may be off by `error` along each axis. A point that may be on a seam
    /// between pixels of a planar map is on it: it belongs to the pixel right of it, or above it.
    pub fn color_within(&self, point: Vector, error: Vector) -> Option<Color> {
        let place = self.map_type.place(point, error)?;
        Some(color(self.blend(place, self.once, |x, y| self.pixel(x, y))?))
    }

    /// Returns the colour at a position in the picture: 0, 0 is its lower left corner, 1, 1 its upper right one.
    pub fn at_uv(&self, u: f64, v: f64) -> Option<Color> {
        Some(color(self.blend(Place::new(u, v), self.once, |x, y| self.pixel(x, y))?))
    }

    /// Returns the value at a point: 0 where the map shows nothing.
    #[inline]
    pub fn value(&self, point: Vector) -> f64 {
        self.value_within(point, Vector::ZERO)
    }

    /// Returns the value at a point that may be off by `error`; see [`ImageMap::color_within`].
    pub fn value_within(&self, point: Vector, error: Vector) -> f64 {
        let place = self.map_type.place(point, error);
        place.map_or(0.0, |place| self.value_at(place, self.once))
    }

    /// Returns the number of the texture, of `count`, that a `material_map` chooses at a point. Numbers start again
    /// after the last texture, but that of the count itself has the last one, too (measured on POV-Ray 3.7).
    pub fn entry(&self, point: Vector, count: usize) -> f64 {
        entry_of(self.value(point).max(0.0).trunc(), count.max(1) as f64)
    }

    /// Returns the value at a position in the picture; see [`ImageMap::at_uv`].
    pub fn value_at_uv(&self, u: f64, v: f64) -> f64 {
        self.value_at(Place::new(u, v), self.once)
    }

    fn value_at(&self, place: Place, once: bool) -> f64 {
        let most = match (self.source, &self.picture.samples) {
            (Source::Index, Samples::Indexed { .. }) | (Source::Material, _) => 255.0,
            _ => 1.0,
        };
        let Some([value]) = self.blend(place, once, |x, y| [self.number(x, y)]) else { return 0.0 };
        match (self.source, most == 1.0) {
            (Source::Index | Source::Material, false) => whole(value),
            _ => value.clamp(0.0, most),
        }
    }

    fn blend<const N: usize>(
        &self,
        place: Place,
        once: bool,
        pixel: impl Fn(usize, usize) -> [f64; N],
    ) -> Option<[f64; N]> {
        let Picture { width, height, .. } = *self.picture;
        let grid = Grid { width, height, repeats: !once };
        let place = match once {
            true => place.inside()?,
            false => place,
        };
        // Rows are counted from below.
        let pixel = |x: usize, y: usize| pixel(x, height - 1 - y);
        Some(Blend { grid, place, pixel }.at(self.interpolation))
    }

    /// Returns the colour of a pixel; rows are counted from above.
    fn pixel(&self, x: usize, y: usize) -> Pixel {
        let at = y * self.picture.width + x;
        if let Samples::Indexed { indices, .. } = &self.picture.samples {
            let color = indices.get(at).and_then(|&index| self.palette.get(usize::from(index)));
            return color.copied().unwrap_or_default();
        }
        let channels = self.picture.channels;
        let first = at * channels;
        let alpha = match channels {
            2 | 4 => self.picture.share(first + channels - 1),
            _ => 1.0,
        };
        let color = match channels {
            1 | 2 => [self.level(first); 3],
            _ => [self.level(first), self.level(first + 1), self.level(first + 2)],
        };
        let [r, g, b] = match self.divides && alpha > 0.0 {
            true => color.map(|c| c / alpha),
            false => color,
        };
        [r, g, b, self.filter, 1.0 - alpha + self.transmit]
    }

    /// Returns the value of a pixel; rows are counted from above.
    fn number(&self, x: usize, y: usize) -> f64 {
        let at = y * self.picture.width + x;
        match (self.source, &self.picture.samples) {
            (Source::Index | Source::Material, Samples::Indexed { indices, .. }) => {
                indices.get(at).copied().unwrap_or(0).into()
            }
            (Source::Material, _) => 255.0 * self.picture.share(at * self.picture.channels),
            (Source::Alpha, Samples::Indexed { .. }) => self.pixel(x, y)[4],
            (Source::Alpha, _) => match self.picture.channels {
                2 | 4 => self.pixel(x, y)[4],
                channels => self.level(at * channels),
            },
            (Source::Color | Source::Index, _) => color(self.pixel(x, y)).rgb.brightness(),
        }
    }

    /// Returns the converted number of a sample.
    #[inline]
    fn level(&self, sample: usize) -> f64 {
        let whole = |levels: &[f64], number: usize| levels.get(number).copied().unwrap_or(0.0);
        match (&self.levels, &self.picture.samples) {
            (Levels::Table(levels), Samples::Eight(s)) => {
                whole(levels, s.get(sample).copied().unwrap_or(0).into())
            }
            (Levels::Table(levels), Samples::Sixteen(s)) => {
                whole(levels, s.get(sample).copied().unwrap_or(0).into())
            }
            (Levels::Direct(conversion), _) => conversion.convert(self.picture.share(sample)),
            (Levels::Table(_), _) => 0.0,
        }
    }
}

/// Returns a number without its fraction; one that rounding may have moved off an integer is that integer.
fn whole(number: f64) -> f64 {
    let nearest = number.round();
    let rounding = 16.0 * f64::EPSILON * nearest.abs();
    if (number - nearest).abs() <= rounding { nearest } else { number.trunc() }
}

/// Returns the distance above the next lower integer, less than 1.
fn fraction(number: f64) -> f64 {
    let fraction = number - number.floor();
    if fraction < 1.0 { fraction } else { 0.0 }
}

fn color([r, g, b, filter, transmit]: Pixel) -> Color {
    Color { rgb: Rgb::new(r, g, b), filter, transmit }
}

fn entry_of(index: f64, count: f64) -> f64 {
    if index == count { count - 1.0 } else { index % count }
}

#[cfg(test)]
mod tests;
