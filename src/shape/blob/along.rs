//! The field of a blob along a line. It is a polynomial of degree 4 between the points where the line enters
//! or leaves a component, or passes the end of a component's bar.
//!
//! **Invariant:** the field and its slope are continuous at these points. So a grazed component may be
//! omitted, and a point may be off by a rounding. As all pieces are searched in one pass, a crossing where
//! two of them meet is found exactly once.

use std::cell::Cell;

use smallvec::SmallVec;

use super::{Blob, Component};
use crate::math::Vector;
use crate::math::roots::bracket::{Root, Sample};
use crate::math::roots::monotone::Walk;
use crate::math::roots::polynomial::turning_points;
use crate::shape::U;
use crate::shape::local::{Crossings, LocalRay, Met};

/// A component that the line passes through.
struct Part<'a> {
    component: &'a Component,
    stretch: f64,
    /// The line's point nearest to the blob's origin, and its direction, in the component's space.
    place: Vector,
    step: Vector,
    /// Range in which the line is inside.
    ends: (f64, f64),
}

pub(super) struct Line<'a> {
    ray: &'a LocalRay<'a>,
    parts: SmallVec<[Part<'a>; 8]>,
}

/// Returns the two positions where the line is at distance 1 from the axis, or from a point of it.
fn chord(place: Vector, step: Vector) -> Option<(f64, f64)> {
    let speed2 = step.length_squared();
    let middle = -place.dot(step) / speed2;
    let room = 1.0 - (place + step * middle).length_squared();
    let half = (room / speed2).sqrt();
    // Also where the line does not move, and it is no number.
    (room > 0.0 && half.is_finite()).then_some((middle - half, middle + half))
}

impl<'a> Part<'a> {
    fn new(component: &'a Component, stretch: f64, ray: &LocalRay) -> Option<Self> {
        let place = component.unit_from_blob * (ray.nearest - component.centre);
        let step = component.unit_from_blob * ray.direction;
        let part = |ends| Self { component, stretch, place, step, ends };
        let ball = |end: f64| chord(place - Vector::Z * end, step);
        let half = component.half;
        if half == 0.0 {
            return ball(0.0).map(part);
        }
        // Two balls and the round between them.
        let across = |v: Vector| Vector::new(v.x, v.y, 0.0);
        let (a, b) = ((-half - place.z) / step.z, (half - place.z) / step.z);
        let (from, to) = if step.z == 0.0 {
            let is_beside = place.z.abs() <= half;
            if is_beside { (f64::NEG_INFINITY, f64::INFINITY) } else { (1.0, -1.0) }
        } else {
            (a.min(b), a.max(b))
        };
        let round = match chord(across(place), across(step)) {
            Some((enter, leave)) => (enter.max(from), leave.min(to)),
            None if across(place).length_squared() < 1.0 => (from, to),
            None => (1.0, -1.0),
        };
        let round =
            (round.0 < round.1 && round.0.is_finite() && round.1.is_finite()).then_some(round);
        let all = [ball(-half), round, ball(half)].into_iter().flatten();
        all.reduce(|(a, b), (c, d)| (a.min(c), b.max(d))).map(part)
    }

    /// Its start and end, and the positions where the line passes the ends of the bar.
    fn joints(&self) -> impl Iterator<Item = f64> {
        let (enter, leave) = self.ends;
        let half = self.component.half;
        let past = [-half, half].map(|end| (end - self.place.z) / self.step.z);
        let past = past.into_iter().filter(move |s| half > 0.0 && enter < *s && *s < leave);
        [enter, leave].into_iter().chain(past)
    }

    fn holds(&self, s: f64) -> bool {
        self.ends.0 <= s && s <= self.ends.1
    }

    /// Adds the field at middle + u·half as a polynomial in u, for a piece that is entirely on one side of
    /// each end of the bar.
    fn add(&self, middle: f64, half: f64, sum: &mut [f64; 5]) {
        let point = self.place + self.step * middle;
        let bar = self.component.half;
        let is_beside = bar > 0.0 && point.z.abs() <= bar;
        let (from, way) = match is_beside {
            true => {
                (Vector::new(point.x, point.y, 0.0), Vector::new(self.step.x, self.step.y, 0.0))
            }
            false => (point - Vector::Z * bar.copysign(point.z), self.step),
        };
        let way = way * half;
        let (a, b, c) = (1.0 - from.length_squared(), -2.0 * from.dot(way), -way.length_squared());
        let terms = [a * a, 2.0 * a * b, b * b + 2.0 * a * c, 2.0 * b * c, c * c];
        for (sum, term) in sum.iter_mut().zip(terms) {
            *sum += self.component.strength * term;
        }
    }
}

impl<'a> Line<'a> {
    pub fn new(blob: &'a Blob, ray: &'a LocalRay<'a>) -> Self {
        let mut parts = SmallVec::new();
        blob.tree.along(ray, ray.blur + 4.0 * U, |run| {
            let part = |i: usize| Part::new(&blob.components[i], blob.stretches[i], ray);
            parts.extend(run.filter_map(part));
        });
        Self { ray, parts }
    }

    /// Returns 1 less the field.
    fn height(&self, s: f64) -> Sample {
        let mut sample = Sample { value: 1.0, slope: 0.0, error: 2.0 * U };
        let blur = self.ray.blur_at(s) + 8.0 * U * (1.0 + s.abs());
        for part in self.parts.iter().filter(|part| part.holds(s)) {
            let seen = part.component.seen(part.place + part.step * s);
            let inner = seen.inner.max(0.0);
            let field = part.component.strength * inner * inner;
            sample.value -= field;
            sample.slope += 4.0 * part.component.strength * inner * seen.from_bar.dot(part.step);
            let error = part.component.error(&seen, part.stretch * blur);
            sample.error += error + U * (field.abs() + sample.value.abs());
        }
        sample
    }

    /// Adds the crossings in a range, and possibly more; if `first` is set, stops at one that is certainly
    /// behind the start of the range.
    pub fn crossings(&mut self, (start, end): (f64, f64), first: bool, found: &mut Crossings) {
        let mut joints: SmallVec<[f64; 32]> = self.parts.iter().flat_map(Part::joints).collect();
        joints.sort_unstable_by(f64::total_cmp);
        self.parts.sort_unstable_by(|a, b| a.ends.0.total_cmp(&b.ends.0));
        let mut walk = Walk::new(|s| self.height(s), self.ray.tolerance);
        let (is_enough, ahead) = (Cell::new(false), self.ray.ahead_of(start));
        let mut note = |Root { t, error }: Root, leaving: bool| {
            found.push(Met { t, error, leaving, part: 0 });
            is_enough.set(is_enough.get() || first && t - error > ahead);
        };
        // The parts that the line is in, and how many it has met.
        let (mut open, mut met): (SmallVec<[usize; 16]>, _) = (SmallVec::new(), 0);
        for pair in joints.windows(2) {
            let (from, to) = (pair[0], pair[1]);
            while met < self.parts.len() && self.parts[met].ends.0 <= from {
                open.push(met);
                met += 1;
            }
            open.retain(|i| self.parts[*i].ends.1 > from);
            if to < start {
                continue;
            }
            if is_enough.get() {
                return;
            }
            if from > end {
                return walk.advance(from, &mut note);
            }
            let most: f64 = open.iter().map(|&i| self.parts[i].component.strength.max(0.0)).sum();
            if from == to || most < 1.0 {
                walk.advance(from, &mut note);
                continue;
            }
            let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
            let mut field = [-1.0, 0.0, 0.0, 0.0, 0.0];
            for &i in &open {
                self.parts[i].add(middle, half, &mut field);
            }
            walk.advance(from, &mut note);
            let far = from.abs().max(to.abs());
            let blur = self.ray.blur_at(far) + 8.0 * U * (1.0 + far);
            let errors = open.iter().map(|&i| {
                let Part { component, stretch, .. } = self.parts[i];
                component.greatest_error(stretch * blur)
            });
            let rounding = 64.0 * U * field.iter().map(|term| term.abs()).sum::<f64>();
            let piece = Piece { field: &field, slack: rounding + 2.0 * errors.sum::<f64>() };
            let mut marks = Marks::new();
            piece.mark(bernstein(&field), (-1.0, 1.0), HALVED, &mut marks);
            for mark in marks {
                walk.advance(middle + mark * half, &mut note);
            }
        }
        if let Some(&last) = joints.last().filter(|_| !is_enough.get()) {
            walk.advance(last, &mut note);
        }
    }
}

/// Positions in a piece.
type Marks = SmallVec<[f64; 16]>;

/// Number of times that a piece is halved before its extrema are computed.
const HALVED: u32 = 3;

/// A field less 1, as a polynomial over a piece.
struct Piece<'a> {
    field: &'a [f64; 5],
    /// Bound on the error of its Bernstein coefficients, and of the field at any position in the piece.
    slack: f64,
}

impl Piece<'_> {
    /// Adds positions in a part of the piece, in order, such that at most one root lies between any two of
    /// them and the ends; `form` are the Bernstein coefficients over the part.
    fn mark(&self, form: [f64; 5], (low, high): (f64, f64), halved: u32, marks: &mut Marks) {
        let is_told = form.iter().all(|c| c.abs() > self.slack);
        let changes = form.windows(2).filter(|pair| (pair[0] > 0.0) != (pair[1] > 0.0));
        if is_told && changes.count() <= 1 {
            return;
        }
        if halved == 0 {
            return marks.extend(turning_points(self.field, low, high));
        }
        let middle = 0.5 * (low + high);
        let [first, second] = halves(form);
        self.mark(first, (low, middle), halved - 1, marks);
        marks.push(middle);
        self.mark(second, (middle, high), halved - 1, marks);
    }
}

/// Returns the Bernstein coefficients of a polynomial of degree 4 from −1 to 1.
fn bernstein(&[a, b, c, d, e]: &[f64; 5]) -> [f64; 5] {
    let (even, odd) = (a + c + e, b + d);
    let (half_even, half_odd) = (a - e, 0.5 * (b - d));
    [even - odd, half_even - half_odd, a - c / 3.0 + e, half_even + half_odd, even + odd]
}

/// Returns the Bernstein coefficients over both halves.
fn halves(form: [f64; 5]) -> [[f64; 5]; 2] {
    let (mut first, mut second) = (form, form);
    for (row, first) in first.iter_mut().enumerate().skip(1) {
        for i in 0..5 - row {
            second[i] = 0.5 * (second[i] + second[i + 1]);
        }
        *first = second[0];
    }
    [first, second]
}
