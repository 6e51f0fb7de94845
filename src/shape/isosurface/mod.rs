//! Isosurface: the set where a function of space is below a threshold, inside a box or a sphere around the
//! local origin, which closes it. The function increases outward.
//!
//! Crossings are found from bounds of the function and its slope over entire pieces of the line, so a
//! crossing cannot be missed because of an undeclared gradient. **Invariant:** a crossing lies between two
//! positions where the function's bounds, over all lines that may be intended, have opposite signs; where a
//! jump lies within that uncertainty, the value on the line itself counts. `accuracy` determines how finely
//! the search subdivides where the bounds are infinite, for example where the function may be undefined, or
//! where it asks a pigment, whose slopes are not known; and how wide a jump or a kink may be and still be
//! distinguished from a slope.

mod cells;
mod container;
mod line;
mod nowhere;

use std::sync::Arc;

use super::local::{Crossings, Height, Local, LocalRay, Met};
use super::{Memory, U, multiple};
use crate::function::{Binary, Number, Rounded, Run, Sloped};
use crate::math::Vector;
use crate::math::interval::Interval;
use crate::math::roots::isolate::{Bounds, Changes, Fineness, Search};
use crate::texture::Closed;
pub use cells::Cells;
pub use container::Container;
use line::{Line, look};
pub use nowhere::Nowhere;

/// Part number of the function's surface; those of the container follow.
pub(super) const SURFACE: u32 = 0;

/// An evaluation of the function.
struct Running<'a, N>(Run<'a, N>, &'a Closed);

impl<N: Number> Running<'_, N> {
    fn at(&mut self, point: [N; 3]) -> N {
        self.0.at(&point, self.1)
    }
}

/// Where a function is below a threshold, inside a container.
#[derive(Debug, Clone, PartialEq)]
pub struct Isosurface {
    /// A function of x, y and z, in the author's coordinates.
    pub function: Arc<Closed>,
    pub threshold: f64,
    pub container: Container,
    /// A local point is `centre + scale · point` in those coordinates; the scale is a power of two.
    pub centre: Vector,
    pub scale: f64,
    /// In local lengths.
    pub accuracy: f64,
    /// Whether the surface of the container is invisible.
    pub open: bool,
    /// Cached bounds of the function.
    pub cells: Memory<Cells>,
}

/// Which crossings are requested.
#[derive(Clone, Copy, PartialEq)]
enum Wanted {
    All,
    /// Those in a range, up to the first that is certainly behind its start.
    First(f64, f64),
}

/// Slope, relative to the size of the container, from which on a function may have a pole.
const STEEPEST: f64 = 1e9;

/// Where the gradient is 0 because of a multiple root, its surroundings are this many times as steep.
const TIMES_STEEPER: f64 = 8.0;

impl Isosurface {
    fn world(&self, point: Vector) -> Vector {
        self.centre + point * self.scale
    }

    fn run<N: Number>(&self) -> Running<'_, N> {
        Running(self.function.function().run(), &self.function)
    }

    fn value(&self, point: Vector) -> f64 {
        let point = self.world(point).to_array();
        self.run().at(point) - self.threshold
    }

    /// Returns the range of the value and the gradient over a box, in local lengths; `None` if the function
    /// is certainly undefined throughout it.
    fn bounds(&self, point: [Interval; 3]) -> Option<Sloped<3>> {
        let along = |axis: usize| {
            let mut slopes = [Interval { low: 0.0, high: 0.0 }; 3];
            slopes[axis] = Interval::point(self.scale);
            let Interval { low, high } = point[axis];
            let place = Interval { low: low * self.scale, high: high * self.scale };
            Sloped { value: Interval::point(self.centre[axis]) + place, slopes }
        };
        let place = [0, 1, 2].map(along);
        let mut all = self.run::<Sloped<3>>().at(place);
        if !all.value.is_finite() && self.function.is_undefined(&place.map(|along| along.value)) {
            return None;
        }
        all.value = all.value - Interval::point(self.threshold);
        Some(all)
    }

    /// Returns the range of the value over a box, in local lengths; everything where it is undefined.
    fn value_bounds(&self, point: [Interval; 3]) -> Interval {
        let along = |axis: usize| {
            let Interval { low, high } = point[axis];
            let place = Interval { low: low * self.scale, high: high * self.scale };
            Interval::point(self.centre[axis]) + place
        };
        self.run::<Interval>().at([0, 1, 2].map(along)) - Interval::point(self.threshold)
    }

    /// Returns how far a number computed for a point of a box may be from the exact one.
    fn rounding(&self, point: [Interval; 3]) -> f64 {
        let along = |axis: usize| {
            let Interval { low, high } = point[axis];
            let place = Interval { low: low * self.scale, high: high * self.scale };
            Rounded { value: Interval::point(self.centre[axis]) + place, error: 0.0 }
        };
        let all = self.run::<Rounded>().at([0, 1, 2].map(along));
        Rounded::binary(Binary::Subtract, all, Rounded::constant(self.threshold)).error
    }

    /// Central differences of the function with the given step.
    fn differences(&self, point: Vector, step: f64) -> Vector {
        let along = |axis: Vector| {
            let rise = self.value(point + axis * step) - self.value(point - axis * step);
            // Within a jump's plane there may be no values.
            if rise.is_nan() { 0.0 } else { rise / (2.0 * step) }
        };
        Vector::new(along(Vector::X), along(Vector::Y), along(Vector::Z))
    }

    /// Height from the value and the gradient at the point itself, which may be 0 or NaN.
    fn simple_height(&self, point: Vector) -> multiple::Told {
        let anyhow = || Sloped::anyhow(Interval::EVERYTHING, false);
        let Sloped { value: Interval { low, high }, slopes } =
            self.bounds(point.to_array().map(Interval::point)).unwrap_or_else(anyhow);
        let gradient = Vector::from_array(slopes.map(|slope| 0.5 * (slope.low + slope.high)));
        let width = Vector::from_array(slopes.map(|slope| slope.high - slope.low)).length();
        (Height { value: 0.5 * (low + high), gradient, error: 0.5 * (high - low) }, width)
    }

    /// Height from the surrounding gradients, for a function whose own gradient is 0.
    fn height_around(&self, point: Vector) -> Option<Height> {
        let is_told = |(height, width): &multiple::Told| {
            height.gradient.is_finite() && height.error.is_finite() && width.is_finite()
        };
        let sample = |place| Some(self.simple_height(place)).filter(is_told);
        multiple::height(point, multiple::NEAREST * self.reach(), sample)
    }

    /// Returns the gradient where bounds are inconclusive, as at kinks and jumps: that of wider and wider
    /// neighbourhoods, and their size; `None` if the function is constant.
    fn gradient_around(&self, point: Vector) -> Option<(Vector, f64)> {
        let steps = [1e-6, 0.1 * self.accuracy, self.accuracy, 4.0 * self.accuracy];
        // Over less, a pigment's colours are steps of single precision.
        let first = usize::from(!self.function.has_slopes());
        let gradients = steps.into_iter().map(|step| (self.differences(point, step), step));
        gradients
            .skip(first)
            .find(|(gradient, _)| gradient.is_finite() && *gradient != Vector::ZERO)
    }
}

/// Results of a search that were already reported.
struct Told {
    changes: usize,
    /// Whether the start of the line is handled, or not requested.
    start: bool,
    /// Changes before this position are not requested.
    from: f64,
}

impl Isosurface {
    fn search(&self, ray: &LocalRay, wanted: Wanted, found: &mut Crossings) {
        let Some((enter, leave)) = self.container.chord(ray) else { return };
        let (ends, width) = ((enter.t, leave.t), leave.t - enter.t);
        if !width.gt(&0.0) {
            return;
        }
        let line = Line::new(self, ray);
        let blur = ray.blur_at(enter.t.abs().max(leave.t.abs()));
        let rounded = blur + U * self.container.reach();
        let fineness = Fineness { resolution: self.accuracy, least: 8.0 * rounded };
        // At a position, only the value is used.
        let bounds = |s: Interval| match s.single() {
            Some(s) => Bounds { value: line.value_at(s), slope: Interval::EVERYTHING },
            None => line.bounds(s),
        };
        let mut search = Search::new(bounds, fineness);
        let first = || line.settle(enter.t, enter.error, 1.0, 0.1 * width);
        let last = || line.settle(leave.t, leave.error, -1.0, 0.1 * width);
        let (from, to) = match wanted {
            Wanted::All => (f64::NEG_INFINITY, f64::INFINITY),
            Wanted::First(from, to) => (from, to),
        };
        let half = self.container.half();
        let mut told = Told { changes: 0, start: false, from };
        // Whether the search has come to the line's end.
        let mut is_whole = false;
        if 16.0 * rounded > cells::MARGIN * half.max_element() {
            // Too uncertain to be followed through cells.
            search.through(first(), last());
            is_whole = true;
        } else {
            let ahead = ray.ahead_of(from);
            let evaluate = cells::Evaluate {
                bounds: |point| self.bounds(point),
                value: |point| self.value_bounds(point),
                error: |point| self.rounding(point),
            };
            let enough = if wanted == Wanted::All { f64::INFINITY } else { ahead };
            self.cells.along(ray, half, ends, &evaluate, |piece| {
                is_whole = piece.to == ends.1;
                if piece.to < from {
                    told.start = true;
                    return true;
                }
                if piece.from > to {
                    return false;
                }
                match piece.known.negative {
                    Some(negative) => search.certain(piece.from, piece.to, negative),
                    None if piece.known.undefined => {}
                    None => {
                        // A ray that leaves the surface is not searched behind its start.
                        let starts = piece.from < from && ahead < piece.to;
                        let skips = starts && search.sign_at(ahead).is_some();
                        told.start |= skips;
                        let from = match piece.from == ends.0 {
                            _ if skips => ahead,
                            true => first(),
                            false => piece.from,
                        };
                        let to = if is_whole { last() } else { piece.to };
                        if from < to {
                            is_whole &= look(&mut search, &line, &piece, (from, to), enough);
                        }
                    }
                }
                self.tell(&line, search.found(), &mut told, enter, found);
                let is_enough = |met: &Met| met.is_seen() && met.t - met.error > ahead;
                wanted == Wanted::All || !found.iter().any(is_enough)
            });
        }
        self.tell(&line, search.found(), &mut told, enter, found);
        if let Some((place, true)) = search.found().last
            && is_whole
        {
            found.push(self.cap(leave, place));
        }
    }

    fn tell(
        &self,
        line: &Line,
        signs: &Changes,
        told: &mut Told,
        enter: Met,
        found: &mut Crossings,
    ) {
        if !told.start
            && let Some((place, negative)) = signs.first
        {
            told.start = true;
            if negative {
                found.push(self.cap(enter, place));
            }
        }
        let changes = signs.all[told.changes..].iter().filter(|change| change.after >= told.from);
        found.extend(changes.map(|change| line.met(change)));
        told.changes = signs.all.len();
    }

    /// Returns a crossing with the container, where the function's sign is certain from `place` on.
    fn cap(&self, end: Met, place: f64) -> Met {
        let error = end.error.max((place - end.t).abs());
        let part = if self.open { Met::UNSEEN } else { end.part };
        Met { error, part, ..end }
    }
}

impl Local for Isosurface {
    fn crossings(&self, ray: &LocalRay, found: &mut Crossings) {
        self.search(ray, Wanted::All, found);
    }

    fn first_crossings(&self, ray: &LocalRay, (from, to): (f64, f64), found: &mut Crossings) {
        self.search(ray, Wanted::First(from, to), found);
    }

    fn height(&self, part: u32, point: Vector) -> Height {
        if part != SURFACE {
            return self.container.height(part, point);
        }
        let (here, width) = self.simple_height(point);
        let Height { value, gradient, error } = here;
        let steepness = gradient.length();
        let is_known = value.is_finite() && width <= 1e-3 * steepness && steepness > 0.0;
        // Beside a pole it falls, and rises across.
        let is_pole = || {
            let across = self.differences(point, 1e-6);
            across.is_finite() && across.dot(gradient) < 0.0
        };
        let is_known = is_known && !(steepness > STEEPEST && is_pole());
        if is_known && value.abs() <= self.accuracy * steepness {
            let sample = |place| Some(self.simple_height(place));
            if error <= multiple::MOVED * self.reach() * steepness
                || multiple::is_steady(point, &here, sample)
            {
                return here;
            }
            return self.height_around(point).unwrap_or(here);
        }
        // At a jump, which has a slope beside it, the differences are the steeper the nearer.
        let is_steeper_around = || {
            let [near, far] = [1e-6, 1e-5].map(|step| self.differences(point, step).length());
            TIMES_STEEPER * (steepness + width) <= near && near <= far
        };
        if width.is_finite()
            && is_steeper_around()
            && let Some(height) = self.height_around(point)
        {
            return height;
        }
        let (gradient, step) = self.gradient_around(point).unwrap_or((Vector::Y, 0.0));
        let (value, steepness) = (self.value(point), gradient.length());
        // A value that is as large as the rise nearby is what a jump is from, and no distance.
        if value.abs() <= 0.1 * step * steepness {
            let place = 1.0 + self.centre.length() / self.scale;
            let rounded = 8.0 * U * (value.abs() + self.threshold.abs() + place * steepness);
            let error = if error.is_finite() { error.max(rounded) } else { rounded };
            return Height { value, gradient, error };
        }
        // A jump: the point is as near to it as its crossing was found.
        Height { value: 0.0, gradient, error: 1e-9 * steepness }
    }

    fn extent(&self, along: Vector) -> (f64, f64) {
        let half = self.container.extent(along);
        (-half, half)
    }

    fn price(&self) -> u64 {
        100 * self.function.function().operations() as u64
    }

    fn reach(&self) -> f64 {
        self.container.reach()
    }

    fn numbers(&self) -> String {
        let Self { function, threshold, container, centre, scale, open, .. } = self;
        let operations = function.function().operations();
        let open = if *open { " open" } else { "" };
        format!(
            " of {operations} operations, less than {threshold}, within {container:?} at {centre} × {scale}{open}"
        )
    }

    fn is_iterated(&self) -> bool {
        true
    }

    fn part_at(&self, ray: &LocalRay, s: f64, _: bool) -> Option<u32> {
        let (enter, leave) = self.container.chord(ray)?;
        let is_apart = |end: Met| (s - end.t).abs() > 2.0 * end.error + 64.0 * U * (1.0 + s.abs());
        (is_apart(enter) && is_apart(leave)).then_some(SURFACE)
    }

    fn contains(&self, point: Vector) -> bool {
        self.container.contains(point) && self.value(point) < 0.0
    }
}
