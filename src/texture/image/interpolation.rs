//! The number at a place between pixels.
//!
//! **Source:** POV-Ray 3.7 manual, section "The interpolate Option"; formulas found by measuring on POV-Ray
//! 3.7, which rejects the types 0 and 1: a pixel's number is that of its centre; the three types are bilinear,
//! bicubic by Catmull-Rom splines, and weighted by inverse squares of distances to four pixels.

use super::projection::Place;

/// `interpolate`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Interpolation {
    /// No such word: the pixel's own number.
    #[default]
    None,
    /// 2.
    Bilinear,
    /// 3. Overshoots at edges.
    Bicubic,
    /// 4.
    NormalizedDistance,
}

impl Interpolation {
    /// Returns the interpolation of a number.
    pub fn of_number(number: u32) -> Option<Self> {
        match number {
            2 => Some(Self::Bilinear),
            3 => Some(Self::Bicubic),
            4 => Some(Self::NormalizedDistance),
            _ => None,
        }
    }
}

/// The pixels of a picture, neither zero wide nor high.
#[derive(Debug, Clone, Copy)]
pub struct Grid {
    pub width: usize,
    pub height: usize,
    /// Whether pixels beyond an edge are those at the opposite edge, rather than those at the same edge.
    pub repeats: bool,
}

/// A place to interpolate at.
#[derive(Debug, Clone, Copy)]
pub struct Blend<P> {
    pub grid: Grid,
    pub place: Place,
    /// The numbers of a pixel by column and row, from below.
    pub pixel: P,
}

/// A coordinate in pixels along one axis.
#[derive(Debug, Clone, Copy)]
struct Coordinate {
    /// The pixel that contains it or whose centre is left of it.
    whole: i64,
    /// From there on, 0 to less than 1.
    rest: f64,
}

impl Coordinate {
    /// Splits `place` · `count` − `shift`. A coordinate that its error and rounding cannot separate from an
    /// integer is that integer.
    fn new(place: f64, error: f64, count: usize, shift: f64) -> Self {
        let count = count as f64;
        let rounding = 4.0 * f64::EPSILON * place.abs().max(1.0);
        // Repeats are dropped first, so that far pixels have indices, too.
        let cell = if place.is_finite() { place.floor() } else { 0.0 };
        let coordinate = (place - cell) * count - shift;
        let nearest = coordinate.round();
        let error = (error + rounding) * count;
        let settled = if (coordinate - nearest).abs() <= error { nearest } else { coordinate };
        let whole = settled.floor();
        Self { whole: whole as i64, rest: settled - whole }
    }
}

impl<const N: usize, P: Fn(usize, usize) -> [f64; N]> Blend<P> {
    /// Returns the numbers at the place.
    pub fn at(&self, interpolation: Interpolation) -> [f64; N] {
        match interpolation {
            Interpolation::None => self.nearest(),
            Interpolation::Bilinear => self.weighted(0, |x, y| {
                let linear = |d: f64| 1.0 - d.abs();
                linear(x) * linear(y)
            }),
            Interpolation::Bicubic => self.weighted(1, |x, y| cubic(x) * cubic(y)),
            Interpolation::NormalizedDistance => {
                let (x, y) = self.between();
                let square = |x: f64, y: f64| x * x + y * y;
                let nearest = square(x.rest.min(1.0 - x.rest), y.rest.min(1.0 - y.rest));
                let weight = |x, y| match square(x, y) {
                    square if square <= nearest => 1.0,
                    square => nearest / square,
                };
                let corners =
                    [0.0, 1.0].map(|i| [0.0, 1.0].map(|j| weight(x.rest - i, y.rest - j)));
                let sum: f64 = corners.as_flattened().iter().sum();
                self.weighted(0, |x, y| weight(x, y) / sum)
            }
        }
    }

    fn nearest(&self) -> [f64; N] {
        let Place { u, v, u_error, v_error, ends_at_top } = self.place;
        let Grid { width, height, .. } = self.grid;
        let x = Coordinate::new(u, u_error, width, 0.0).whole;
        let y = match ends_at_top && v >= 1.0 {
            true => height as i64 - 1,
            false => Coordinate::new(v, v_error, height, 0.0).whole,
        };
        (self.pixel)(wrapped(x, width), wrapped(y, height))
    }

    /// Returns the pixels whose centres are left of the place and below it.
    fn between(&self) -> (Coordinate, Coordinate) {
        let x = Coordinate::new(self.place.u, 0.0, self.grid.width, 0.5);
        let y = Coordinate::new(self.place.v, 0.0, self.grid.height, 0.5);
        (x, y)
    }

    /// Sums the numbers of 2 + 2 · `margin` pixels along each axis, weighted by their distances.
    fn weighted(&self, margin: i64, weight: impl Fn(f64, f64) -> f64) -> [f64; N] {
        let (x, y) = self.between();
        let mut sum = [0.0; N];
        for j in -margin..=1 + margin {
            for i in -margin..=1 + margin {
                let weight = weight(x.rest - i as f64, y.rest - j as f64);
                let numbers = (self.pixel)(
                    self.index(x.whole + i, self.grid.width),
                    self.index(y.whole + j, self.grid.height),
                );
                for (sum, number) in sum.iter_mut().zip(numbers) {
                    *sum += weight * number;
                }
            }
        }
        sum
    }

    fn index(&self, pixel: i64, count: usize) -> usize {
        match self.grid.repeats {
            true => wrapped(pixel, count),
            false => pixel.clamp(0, count as i64 - 1) as usize,
        }
    }
}

fn wrapped(pixel: i64, count: usize) -> usize {
    pixel.rem_euclid((count as i64).max(1)) as usize
}

/// The Catmull-Rom spline that is 1 at 0 and 0 at the other integers.
fn cubic(distance: f64) -> f64 {
    let d = distance.abs();
    match d {
        ..1.0 => (1.5 * d - 2.5) * d * d + 1.0,
        ..2.0 => ((2.5 - 0.5 * d) * d - 4.0) * d + 2.0,
        _ => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::{Random, tries};

    const TYPES: [Interpolation; 3] =
        [Interpolation::Bilinear, Interpolation::Bicubic, Interpolation::NormalizedDistance];

    #[test]
    fn a_constant_picture_is_constant_and_a_centre_has_its_own_number() {
        let mut random = Random(3);
        for _ in 0..tries() {
            let (width, height) = (1 + random.below(5), 1 + random.below(5));
            let grid = Grid { width, height, repeats: random.below(2) == 0 };
            let place = Place::new(random.number(-0.5, 1.5), random.number(-0.5, 1.5));
            let (x, y) = (random.below(width), random.below(height));
            let center = |i: usize, n: usize| (i as f64 + 0.5) / n as f64;
            let own = Place::new(center(x, width), center(y, height));
            for interpolation in TYPES {
                let [found] = Blend { grid, place, pixel: |_, _| [0.7] }.at(interpolation);
                assert!((found - 0.7).abs() < 1e-14, "{interpolation:?} {place:?} {found}");
                let pixel = |x: usize, y: usize| [(10 * x + y) as f64];
                let [found] = Blend { grid, place: own, pixel }.at(interpolation);
                assert_eq!(found, (10 * x + y) as f64, "{interpolation:?} {own:?}");
            }
        }
    }

    #[test]
    fn any_place_has_a_pixel() {
        let pixel = |x: usize, y: usize| {
            assert!(x < 3 && y < 2);
            [1.0]
        };
        for place in [0.0, 1.0, -0.0, -1e-300, 1e15 + 0.5, -1e300, f64::MAX, f64::MIN_POSITIVE] {
            for repeats in [true, false] {
                for interpolation in [Interpolation::None].into_iter().chain(TYPES) {
                    let grid = Grid { width: 3, height: 2, repeats };
                    let [found] =
                        Blend { grid, place: Place::new(place, place), pixel }.at(interpolation);
                    assert!((found - 1.0).abs() < 1e-14, "{place} {interpolation:?}");
                }
            }
        }
    }
}
