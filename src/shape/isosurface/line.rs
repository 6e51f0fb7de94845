//! The function of an isosurface along one line: its bounds over all lines that may be intended, and its
//! roots.

use std::cell::{Cell, OnceCell, RefCell};

use super::cells::Piece;
use super::{Isosurface, Running, SURFACE};
use crate::function::Sloped;
use crate::math::interval::Interval;
use crate::math::roots::bracket::{Sample, root};
use crate::math::roots::isolate::{Bounds, Change, Search};
use crate::shape::U;
use crate::shape::local::{LocalRay, Met};

/// Number of steps after which another method is better.
const GUESSES: u32 = 24;

/// Width, in units of the `accuracy`, up to which a function without slopes is sampled: bounds take longer than that.
const SAMPLED: f64 = 8.0;

/// Evaluates the function along one line.
pub(super) struct Line<'a> {
    surface: &'a Isosurface,
    has_slopes: bool,
    ray: &'a LocalRay<'a>,
    run: OnceCell<RefCell<Running<'a, Sloped<1>>>>,
    values: OnceCell<RefCell<Running<'a, Interval>>>,
    plain: OnceCell<RefCell<Running<'a, f64>>>,
    /// How far [`Line::value`] may be from the exact value, where that is known.
    error: Cell<f64>,
}

impl<'a> Line<'a> {
    pub fn new(surface: &'a Isosurface, ray: &'a LocalRay<'a>) -> Self {
        let has_slopes = surface.function.has_slopes();
        let (run, values, plain) = (OnceCell::new(), OnceCell::new(), OnceCell::new());
        let error = Cell::new(f64::INFINITY);
        Self { surface, has_slopes, ray, run, values, plain, error }
    }

    /// Returns the range of the value less the threshold, and of its slope, over all lines that may be
    /// intended.
    pub fn bounds(&self, s: Interval) -> Bounds {
        if !self.has_slopes {
            match s.single() {
                Some(s) => return self.at(s),
                None if s.high - s.low <= SAMPLED * self.surface.accuracy => {
                    return Bounds { value: Interval::EVERYTHING, slope: Interval::EVERYTHING };
                }
                None => {}
            }
        }
        let far = s.low.abs().max(s.high.abs());
        let blur = self.ray.blur_at(far);
        let wide = |value: f64, by: f64| Interval { low: value - by, high: value + by };
        let Isosurface { centre, scale, .. } = *self.surface;
        let times_scale = |i: Interval| Interval { low: i.low * scale, high: i.high * scale };
        let coordinate = |axis: usize| {
            let (place, way) = (self.ray.nearest[axis], self.ray.direction[axis]);
            let local = wide(place, blur) + s * Interval::point(way);
            Sloped {
                value: Interval::point(centre[axis]) + times_scale(local),
                slopes: [times_scale(wide(way, self.ray.turn))],
            }
        };
        let place = [0, 1, 2].map(coordinate);
        let all = self.evaluate(place);
        let is_known = all.value.is_finite() && all.slope.is_finite();
        match s.single() {
            Some(s) if !is_known => {
                let here = self.at(s);
                if here.value.is_finite() { here } else { all }
            }
            _ if all.value.is_finite() => all,
            _ => match self.surface.function.is_undefined(&place.map(|along| along.value)) {
                true => Bounds::UNDEFINED,
                false => all,
            },
        }
    }

    /// Returns the value of [`Self::bounds`] at a position, sooner where its sign is certain.
    pub fn value_at(&self, s: f64) -> Interval {
        if self.error.get() < f64::INFINITY {
            let (value, error) = (self.value(s), self.error.get());
            if value.abs() > error {
                return Interval { low: value - error, high: value + error };
            }
        }
        let Isosurface { centre, scale, threshold, .. } = *self.surface;
        let blur = self.ray.blur_at(s);
        let coordinate = |axis: usize| {
            let (place, way) = (self.ray.nearest[axis], self.ray.direction[axis]);
            let along = Interval::point(s) * Interval::point(way);
            let local = Interval { low: place - blur, high: place + blur } + along;
            let scaled = Interval { low: local.low * scale, high: local.high * scale };
            Interval::point(centre[axis]) + scaled
        };
        if self.has_slopes {
            let run = self.values.get_or_init(|| RefCell::new(self.surface.run()));
            let all = run.borrow_mut().at([0, 1, 2].map(coordinate)) - Interval::point(threshold);
            if all.low > 0.0 || all.high < 0.0 {
                return all;
            }
        }
        self.bounds(Interval::point(s)).value
    }

    /// Returns the bounds for one point, taken as exact.
    fn at(&self, s: f64) -> Bounds {
        let Isosurface { centre, scale, .. } = *self.surface;
        let point = centre + self.ray.at(s) * scale;
        let coordinate = |axis: usize| Sloped {
            value: Interval::point(point[axis]),
            slopes: [Interval::point(self.ray.direction[axis] * scale)],
        };
        self.evaluate([0, 1, 2].map(coordinate))
    }

    fn evaluate(&self, point: [Sloped<1>; 3]) -> Bounds {
        let run = self.run.get_or_init(|| RefCell::new(self.surface.run()));
        let Sloped { value, slopes: [slope] } = run.borrow_mut().at(point);
        Bounds { value: value - Interval::point(self.surface.threshold), slope }
    }

    fn sample(&self, s: f64) -> Sample {
        let Bounds { value: Interval { low, high }, slope } = self.bounds(Interval::point(s));
        Sample {
            value: 0.5 * (low + high),
            slope: 0.5 * (slope.low + slope.high),
            error: 0.5 * (high - low),
        }
    }

    pub fn met(&self, change: &Change) -> Met {
        let (outside, inside) = match change.rising {
            true => (change.after, change.before),
            false => (change.before, change.after),
        };
        let guess = self.guess(outside, inside);
        // About the guess the slope is that at the guess.
        let slope = Cell::new(None);
        let sample = |s: f64| match slope.get() {
            Some(slope) => {
                let Interval { low, high } = self.value_at(s);
                Sample { value: 0.5 * (low + high), slope, error: 0.5 * (high - low) }
            }
            None => {
                let sample = self.sample(s);
                slope.set((s == guess).then_some(sample.slope));
                sample
            }
        };
        let found = root(sample, (outside, inside), guess, self.ray.tolerance);
        Met { t: found.t, error: found.error, leaving: change.rising, part: SURFACE }
    }

    /// The rounded value on the line itself.
    fn value(&self, s: f64) -> f64 {
        let point = self.surface.world(self.ray.at(s)).to_array();
        let run = self.plain.get_or_init(|| RefCell::new(self.surface.run()));
        run.borrow_mut().at(point) - self.surface.threshold
    }

    /// Returns an approximate root between two positions, from values alone; NaN if these are inconclusive.
    ///
    /// **Source:** M. Dowell, P. Jarratt, "A modified regula falsi method", BIT 11 (1971): Illinois.
    fn guess(&self, outside: f64, inside: f64) -> f64 {
        let (mut above, mut below) = (outside, inside);
        let (mut high, mut low) = (self.value(above), self.value(below));
        // Which end was moved last.
        let mut side = 0.0;
        for _ in 0..GUESSES {
            if !(high > 0.0 && low < 0.0) {
                break;
            }
            let next = below - low * ((above - below) / (high - low));
            let here = self.value(next);
            let step = (next - below).abs().min((next - above).abs());
            if here == 0.0 || step <= 4.0 * U * next.abs() + 0.5 * self.ray.tolerance {
                return next;
            }
            if here > 0.0 {
                low *= if side > 0.0 { 0.5 } else { 1.0 };
                (above, high, side) = (next, here, 1.0);
            } else {
                high *= if side < 0.0 { 0.5 } else { 1.0 };
                (below, low, side) = (next, here, -1.0);
            }
        }
        f64::NAN
    }

    /// Returns the first position with a certain sign, from an end of the line's part in the container
    /// inward; the end itself if there is none nearby.
    pub fn settle(&self, end: f64, error: f64, inward: f64, most: f64) -> f64 {
        let mut step = error.max(4.0 * U);
        let mut place = end;
        while step < most {
            let Interval { low, high } = self.value_at(place);
            if low > 0.0 || high < 0.0 {
                return place;
            }
            place = end + inward * step;
            step *= 4.0;
        }
        end
    }
}

/// Searches for roots in a piece of the line, using the bounds of its cell, until one is certainly beyond `enough`;
/// returns whether the piece was searched to its end.
pub(super) fn look<F: Fn(Interval) -> Bounds>(
    search: &mut Search<F>,
    line: &Line,
    piece: &Piece,
    (from, to): (f64, f64),
    enough: f64,
) -> bool {
    let ray = line.ray;
    let blur = ray.blur_at(from.abs().max(to.abs())) + 4.0 * U * (1.0 + from.abs().max(to.abs()));
    let at = |s: f64| piece.known.at(ray.at(s) - piece.middle, blur);
    let Isosurface { centre, scale, .. } = *line.surface;
    line.error.set(piece.known.error(blur + 4.0 * U * (1.0 + centre.abs().max_element() / scale)));
    let whole = look_closer(search, line, piece, (from, to), enough, at);
    line.error.set(f64::INFINITY);
    whole
}

/// Does what [`look`] does; `at` bounds the function at a position, by its slopes from the middle of the cell.
fn look_closer<F: Fn(Interval) -> Bounds>(
    search: &mut Search<F>,
    line: &Line,
    piece: &Piece,
    (from, to): (f64, f64),
    enough: f64,
    at: impl Fn(f64) -> Interval,
) -> bool {
    let ray = line.ray;
    let sign = |value: Interval| match (value.low > 0.0, value.high < 0.0) {
        (true, _) => Some(false),
        (_, true) => Some(true),
        _ => None,
    };
    let along = piece.known.along(ray.direction, ray.turn);
    let half = 0.5 * (to - from);
    let whole = at(from + half) + along * Interval { low: -half, high: half };
    if let Some(negative) = sign(whole) {
        search.certain(from, to, negative);
        return true;
    }
    if !(along.low > 0.0 || along.high < 0.0) {
        search.begin(from, to, along);
        while search.goes_on() {
            let is_beyond =
                |change: &Change| change.before - 4.0 * U * change.before.abs() > enough;
            if search.found().all.last().is_some_and(is_beyond) {
                return false;
            }
        }
        return true;
    }
    // Which sign at the first end lasts to the last, and the other way round.
    let falls = along.high < 0.0;
    let first = sign(at(from)).or_else(|| search.sign_at(from));
    if first == Some(falls) {
        search.certain(from, to, falls);
        return true;
    }
    let last = sign(at(to)).or_else(|| search.sign_at(to));
    match (first, last) {
        (_, Some(last)) if last != falls => search.certain(from, to, last),
        (Some(first), Some(last)) => {
            search.certain(from, from, first);
            search.certain(to, to, last);
        }
        _ => search.through_slope(from, to),
    }
    true
}
