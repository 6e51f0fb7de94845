//! Isosurface: where a function of space is less than a threshold, inside of a box or a ball about the local
//! origin, which closes it. Outward is where the function rises.
//!
//! Crossings are found by bounds of the function and of its slope over whole pieces of the line, so none
//! escapes through a steepness that nobody declared. **Invariant:** a crossing lies between two places where the
//! function's bounds, over all lines that may have been meant, are of opposite signs; where a jump lies within
//! what is meant, its value on the line itself counts. `accuracy` says how finely places are looked at
//! where the bounds are infinite, as where the function may be undefined; and how wide a jump or a kink
//! may be told from a slope.

use std::cell::RefCell;
use std::sync::Arc;

use super::U;
use super::body::{Crossings, Height, Local, LocalRay, Met};
use crate::function::{Closed, Number, Run, Sloped};
use crate::math::Vector;
use crate::math::interval::Interval;
use crate::math::roots::bracket::{Sample, root};
use crate::math::roots::isolate::{Bounds, Change, Fineness, changes};

/// The part that is the function's own; the container's are those after it.
pub(super) const SURFACE: u32 = 0;

/// What an isosurface is looked for in.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Container {
    /// Its half widths.
    Box(Vector),
    /// Its radius.
    Sphere(f64),
}

/// A function at work.
struct Running<'a, N>(Run<'a, N>, &'a Closed);

impl<N: Number> Running<'_, N> {
    fn at(&mut self, point: [N; 3]) -> N {
        self.0.at(&point, self.1)
    }
}

#[derive(Debug, Clone, PartialEq)]
pub struct Isosurface {
    /// Of x, y and z, in a space of the author's.
    pub function: Arc<Closed>,
    pub threshold: f64,
    pub container: Container,
    /// A local point is there `centre + scale · point`; the scale is a power of two.
    pub centre: Vector,
    pub scale: f64,
    /// In local lengths.
    pub accuracy: f64,
    /// Where the container cuts it, there is nothing to be seen.
    pub open: bool,
}

/// The function at work along one line.
struct Line<'a> {
    surface: &'a Isosurface,
    ray: &'a LocalRay,
    run: RefCell<Running<'a, Sloped<1>>>,
}

impl Line<'_> {
    /// The value less the threshold, for all lines that may be meant, and its slope along them.
    fn bounds(&self, s: Interval) -> Bounds {
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
        let all = self.evaluate([0, 1, 2].map(coordinate));
        let is_known = all.value.is_finite() && all.slope.is_finite();
        match s.single() {
            Some(s) if !is_known => {
                let here = self.at(s);
                if here.value.is_finite() { here } else { all }
            }
            _ => all,
        }
    }

    /// The same at one point as it is given.
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
        let Sloped { value, slopes: [slope] } = self.run.borrow_mut().at(point);
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

    fn met(&self, change: &Change) -> Met {
        let (outside, inside) = match change.rising {
            true => (change.after, change.before),
            false => (change.before, change.after),
        };
        let found = root(|s| self.sample(s), (outside, inside), f64::NAN, self.ray.tolerance);
        Met { t: found.t, error: found.error, leaving: change.rising, part: SURFACE }
    }

    /// From an end of the line's part in the container inward: the first place whose sign is certain, or
    /// where none is near, the end itself.
    fn settle(&self, end: f64, error: f64, inward: f64, most: f64) -> f64 {
        let mut step = error.max(4.0 * U);
        let mut place = end;
        while step < most {
            let Interval { low, high } = self.bounds(Interval::point(place)).value;
            if low > 0.0 || high < 0.0 {
                return place;
            }
            place = end + inward * step;
            step *= 4.0;
        }
        end
    }
}

impl Container {
    /// Where a line is within.
    fn chord(&self, ray: &LocalRay) -> Option<(Met, Met)> {
        match *self {
            Self::Sphere(radius) => ball(ray, radius),
            Self::Box(half) => {
                let endless = |t, leaving| Met { t, error: 0.0, leaving, part: 1 };
                let whole = (endless(f64::NEG_INFINITY, false), endless(f64::INFINITY, true));
                let reach = half.length();
                (0..3).try_fold(whole, |(enter, leave), axis| {
                    let (first, last) = slab(ray, axis, half[axis], reach)?;
                    Some((enter.later(first), leave.earlier(last)))
                })
            }
        }
    }

    /// The most of `along`·P.
    pub(super) fn extent(&self, along: Vector) -> f64 {
        match self {
            Self::Box(half) => along.abs().dot(*half),
            Self::Sphere(radius) => along.length() * radius,
        }
    }

    pub(super) fn reach(&self) -> f64 {
        match self {
            Self::Box(half) => half.length(),
            Self::Sphere(radius) => *radius,
        }
    }

    pub(super) fn contains(&self, point: Vector) -> bool {
        match self {
            Self::Box(half) => point.abs().cmplt(*half).all(),
            Self::Sphere(radius) => point.length() < *radius,
        }
    }
}

/// As the round of a cylinder. **Error** of s: with m the distance of the line, h half of the chord and δ
/// how far off they are, δ·m/h or √(2δ·m + δ²), and δ.
fn ball(ray: &LocalRay, radius: f64) -> Option<(Met, Met)> {
    let miss = ray.nearest.length();
    let half = ((radius - miss) * (radius + miss)).sqrt();
    if !half.gt(&0.0) {
        return None;
    }
    let off = ray.blur_at(half) + 8.0 * U * radius;
    let error = (off * miss / half).min((2.0 * off * miss + off * off).sqrt()) + off;
    let met = |t, leaving| Met { t, error, leaving, part: SURFACE + 1 };
    Some((met(-half, false), met(half, true)))
}

/// Between two faces across an axis. What is certainly met beyond all of the body is met nowhere.
fn slab(ray: &LocalRay, axis: usize, half: f64, reach: f64) -> Option<(Met, Met)> {
    let (place, speed) = (ray.nearest[axis], ray.direction[axis]);
    let met = |end: f64, leaving| {
        let part = SURFACE + 1 + 2 * axis as u32 + u32::from(end > 0.0);
        let t = (end - place) / speed;
        let flat = ray.blur_at(2.0 * reach) + 2.0 * U * (half + place.abs());
        if (t.abs() - 2.0 * reach) * speed.abs() > flat {
            return Met { t: t * f64::INFINITY, error: 0.0, leaving, part };
        }
        let off = ray.blur_at(t) + 2.0 * U * (half + place.abs());
        Met { t, error: off / speed.abs() + 2.0 * U * t.abs(), leaving, part }
    };
    if speed == 0.0 {
        let endless = |t, leaving| Met { t, error: 0.0, leaving, part: SURFACE + 1 };
        return (place.abs() < half)
            .then_some((endless(f64::NEG_INFINITY, false), endless(f64::INFINITY, true)));
    }
    let near = if speed > 0.0 { -half } else { half };
    Some((met(near, false), met(-near, true)))
}

impl Isosurface {
    fn line<'a>(&'a self, ray: &'a LocalRay) -> Line<'a> {
        Line { surface: self, ray, run: RefCell::new(self.run()) }
    }

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

    /// The value and its gradient, in local lengths.
    fn bounds(&self, point: Vector) -> Sloped<3> {
        let along = |axis: usize| {
            let mut slopes = [Interval::point(0.0); 3];
            slopes[axis] = Interval::point(self.scale);
            let place = Interval::point(point[axis] * self.scale);
            Sloped { value: Interval::point(self.centre[axis]) + place, slopes }
        };
        let mut all = self.run::<Sloped<3>>().at([0, 1, 2].map(along));
        all.value = all.value - Interval::point(self.threshold);
        all
    }

    /// What the function rises by within `step` to both sides.
    fn differences(&self, point: Vector, step: f64) -> Vector {
        let along = |axis: Vector| {
            (self.value(point + axis * step) - self.value(point - axis * step)) / (2.0 * step)
        };
        Vector::new(along(Vector::X), along(Vector::Y), along(Vector::Z))
    }

    /// The gradient where bounds tell no good one: at kinks and jumps, that of a wider and wider
    /// neighbourhood; `None` where the function stays the same.
    fn gradient_around(&self, point: Vector) -> Option<Vector> {
        let steps = [1e-6, 0.1 * self.accuracy, self.accuracy, 4.0 * self.accuracy];
        let gradients = steps.into_iter().map(|step| self.differences(point, step));
        gradients.into_iter().find(|gradient| gradient.is_finite() && *gradient != Vector::ZERO)
    }
}

impl Local for Isosurface {
    fn crossings(&self, ray: &LocalRay, found: &mut Crossings) {
        let Some((enter, leave)) = self.container.chord(ray) else { return };
        let width = leave.t - enter.t;
        if !width.gt(&0.0) {
            return;
        }
        let line = self.line(ray);
        let from = line.settle(enter.t, enter.error, 1.0, 0.1 * width);
        let to = line.settle(leave.t, leave.error, -1.0, 0.1 * width);
        let least =
            8.0 * (ray.blur_at(enter.t.abs().max(leave.t.abs())) + U * self.container.reach());
        let fineness = Fineness { resolution: self.accuracy, least };
        let signs = changes(&|s| line.bounds(s), from, to, fineness);
        let cap = |end: Met, place: f64| {
            let error = end.error.max((place - end.t).abs());
            let part = if self.open { Met::UNSEEN } else { end.part };
            Met { error, part, ..end }
        };
        if let Some((place, true)) = signs.first {
            found.push(cap(enter, place));
        }
        found.extend(signs.all.iter().map(|change| line.met(change)));
        if let Some((place, true)) = signs.last {
            found.push(cap(leave, place));
        }
    }

    fn height(&self, part: u32, point: Vector) -> Height {
        if part != SURFACE {
            return self.container.height(part, point);
        }
        let Sloped { value: Interval { low, high }, slopes } = self.bounds(point);
        let value = 0.5 * (low + high);
        let gradient = Vector::from_array(slopes.map(|slope| 0.5 * (slope.low + slope.high)));
        let width = Vector::from_array(slopes.map(|slope| slope.high - slope.low)).length();
        let steepness = gradient.length();
        let is_known = value.is_finite() && width <= 1e-3 * steepness;
        if is_known && value.abs() <= self.accuracy * steepness {
            return Height { value, gradient, error: 0.5 * (high - low) };
        }
        let gradient = self.gradient_around(point).unwrap_or(Vector::Y);
        let (value, steepness) = (self.value(point), gradient.length());
        if value.abs() <= self.accuracy * steepness {
            let place = 1.0 + self.centre.length() / self.scale;
            let error = 8.0 * U * (value.abs() + self.threshold.abs() + place * steepness);
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
        100 * self.function.operations() as u64
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

    fn contains(&self, point: Vector) -> bool {
        self.container.contains(point) && self.value(point) < 0.0
    }
}

impl Container {
    fn height(&self, part: u32, point: Vector) -> Height {
        match self {
            Self::Sphere(radius) => {
                let distance = point.length();
                let gradient = (point / distance).normalize_or(Vector::Y);
                Height { value: distance - radius, gradient, error: 8.0 * U * radius }
            }
            Self::Box(half) => {
                let side = part.saturating_sub(SURFACE + 1);
                let axis = (side / 2).min(2) as usize;
                let way = if side % 2 == 1 { 1.0 } else { -1.0 };
                let gradient = [Vector::X, Vector::Y, Vector::Z][axis] * way;
                Height {
                    value: point.dot(gradient) - half[axis],
                    gradient,
                    error: 2.0 * U * half[axis],
                }
            }
        }
    }
}
