//! Prism: in local space, all (x, y, z) with (x, y) inside an outline, or (x/z, y/z) if it narrows to the
//! origin, and z between two heights. The even-odd rule applies.
//!
//! A wall is ruled by lines, one through each point of the outline. The side on which the ray passes such a
//! line is a polynomial of the degree of the outline, so the ray crosses the walls where the sign of that
//! polynomial changes along the outline.

mod ends;
mod isolated;
mod ruled;
mod wall;

use std::ops::Range;

use smallvec::SmallVec;

use super::U;
use super::curve::{Outline, Path, Point, walk};
use super::cylinder::{BASE, CAP, between};
use super::local::{Crossings, Height, Local, LocalRay, Met};
use crate::math::Vector;
use ends::{after, before, entered, high, low, reversed};
use ruled::{Ruled, WALLS, Wall, Walls, part_of};
use wall::{aside, beside, tip};

/// An outline swept along z, or narrowing to the origin, in local space.
#[derive(Debug, Clone, PartialEq)]
pub struct Prism {
    /// Closed runs, within 1 of the origin.
    pub outline: Outline,
    /// Whether it narrows to the origin and widens again beyond it.
    pub conic: bool,
    /// From low to high, within −1 … 1.
    pub heights: [f64; 2],
    /// Whether its ends are invisible; it is still solid.
    pub open: bool,
}

/// Sideways speed below which a line is first tested for missing all walls. Affects only the running time.
const STEEP: f64 = 1.0 / 1024.0;

/// Cosine below which the line's direction relative to a wall cannot be determined from the normal at one
/// point. Also limits how far a line in a wall is displaced, where the displacement moves it away from the
/// wall more slowly than this.
const GRAZING: f64 = 1e-6;

impl Prism {
    /// Returns the parts of the line between walls, in order, and, if it lies in a wall within rounding, its
    /// minimum displacement; and whether each part is certainly within its walls, between their bounds.
    /// Crossings that are certainly not in a range have wide bounds.
    fn spans(&self, ray: &LocalRay, range: (f64, f64)) -> (Spans, Option<f64>, bool) {
        let tilt = (ray.direction.x * ray.direction.x + ray.direction.y * ray.direction.y).sqrt();
        if !self.conic
            && tilt < STEEP
            && let Some((spans, in_wall)) = self.upright(ray, tilt)
        {
            return (spans, in_wall, false);
        }
        if self.conic && ray.nearest.length() <= tip(ray) {
            let (spans, in_wall) = self.through_apex(ray);
            return (spans, in_wall, false);
        }
        let ruled = Ruled::new(ray, self.conic);
        let isolated = self.isolated(&ruled, ray.tolerance, range);
        // Walls that a line only touches, within rounding, are not among those that are walked to.
        let is_told = isolated.is_some();
        let mut walls = isolated.unwrap_or_else(|| self.walked(&ruled, ray.tolerance));
        walls.sort_by(|a, b| a.s.total_cmp(&b.s));
        let mut spans = Spans::new();
        if !self.conic {
            pair(&walls, &mut spans);
            return (spans, ruled.beside.get(), is_told);
        }
        // The body is in two parts, one to each side of the origin's plane; in it nothing is.
        let speed = ray.direction.z;
        let (above, below): (Walls, Walls) = walls.into_iter().partition(|wall| wall.above);
        let mut parts = [(above, speed >= 0.0), (below, speed < 0.0)];
        if speed >= 0.0 {
            parts.reverse();
        }
        for (mut walls, begins_outside) in parts {
            if walls.len() % 2 == 1 {
                let far = if begins_outside { f64::INFINITY } else { f64::NEG_INFINITY };
                let at = if begins_outside { walls.len() } else { 0 };
                walls.insert(at, Wall::beyond(far));
            }
            pair(&walls, &mut spans);
        }
        (spans, ruled.beside.get(), is_told)
    }

    /// Returns the crossings with the walls.
    #[cold]
    fn walked(&self, ruled: &Ruled, tolerance: f64) -> Walls {
        // Straight walls are met where a step takes one; others are iterated.
        let tolerance = if self.is_iterated() { tolerance } else { 0.0 };
        let mut walls = Walls::new();
        for run in &self.outline.runs {
            let path = Path::whole(&self.outline, run, None);
            walk(path, ruled, tolerance, |change| walls.push(ruled.wall(&change)));
        }
        walls
    }

    /// Returns the normal of a wall, given that of the outline.
    fn normal(&self, [x, y]: Point, [a, b]: Point) -> Vector {
        Vector::new(a, b, if self.conic { -(a * x + b * y) } else { 0.0 })
    }

    /// Returns the spans of a nearly vertical line, if all of it between the ends is on one side of the
    /// walls. A line that is vertical within rounding always has a result: what is uncertain counts as
    /// outside.
    fn upright(&self, ray: &LocalRay, tilt: f64) -> Option<(Spans, Option<f64>)> {
        let error = ray.blur_at(2.0) + 2.0 * tilt + 16.0 * U;
        let told = self.outline.is_inside([ray.nearest.x, ray.nearest.y], error);
        let inside = if tilt <= 2.0 * ray.turn { told.unwrap_or(false) } else { told? };
        let mut spans = Spans::new();
        if inside {
            pair(&[Wall::beyond(f64::NEG_INFINITY), Wall::beyond(f64::INFINITY)], &mut spans);
        }
        Some((spans, told.is_none().then_some(0.0)))
    }

    /// Returns the spans of a line through the origin, within rounding: it is inside both before and after
    /// the origin, or outside throughout.
    ///
    /// **Error:** at height z, the line is `off`/z from its point in the outline, which is less than the
    /// clearance of that point. If there is no such z in the body, the line lies in a wall.
    fn through_apex(&self, ray: &LocalRay) -> (Spans, Option<f64>) {
        let (n, d) = (ray.nearest, ray.direction);
        let mut spans = Spans::new();
        let place = [d.x / d.z, d.y / d.z];
        // No outline goes farther than 1.
        let is_near = place[0].abs().max(place[1].abs()) <= 2.0;
        if !is_near {
            return (spans, None);
        }
        let off = 3.0 * (n.length() + tip(ray) / 16.0);
        // No body is higher than 1.
        let Some(is_inside) = self.outline.is_inside(place, off) else {
            return (spans, Some(self.beside_walls(ray, place)));
        };
        if is_inside {
            let height = off / self.outline.clearance(place).max(off);
            let apex = Wall { error: height / d.z.abs(), ..Wall::beyond(-n.z / d.z) };
            pair(&[Wall::beyond(f64::NEG_INFINITY), apex], &mut spans);
            pair(&[apex, Wall::beyond(f64::INFINITY)], &mut spans);
        }
        (spans, None)
    }

    /// Returns how far a line through the origin must be displaced to be separable from the walls that it
    /// lies in, which are all those through `place` in the outline.
    #[cold]
    fn beside_walls(&self, ray: &LocalRay, place: Point) -> f64 {
        let aside = aside(ray);
        let [x, y] = [aside.x - place[0] * aside.z, aside.y - place[1] * aside.z];
        let far = 4.0 * tip(ray);
        let mut least = far;
        self.outline.near(place, far, |number| {
            let ([a, b], normal) = self.outline.pieces[number].nearest(place);
            if (a - place[0]).abs().max((b - place[1]).abs()) <= far {
                let steep = (x * normal[0] + y * normal[1]).abs();
                least = least.max(far / steep.max(GRAZING));
            }
        });
        least
    }
}

/// Parts of a line.
type Spans = SmallVec<[(Met, Met); 3]>;

/// Pairs the crossings: entries and exits alternate.
fn pair(walls: &[Wall], spans: &mut Spans) {
    for pair in walls.chunks_exact(2) {
        spans.push((pair[0].met(false), pair[1].met(true)));
    }
}

/// Returns where a line is within the walls of a part, also if rounding has swapped crossings.
fn surely_within(spans: &[(Met, Met)], number: usize) -> Range<f64> {
    let (enter, leave) = &spans[number];
    let before = spans[..number].iter().flat_map(|(enter, leave)| [high(enter), high(leave)]);
    let behind = spans[number + 1..].iter().flat_map(|(enter, leave)| [low(enter), low(leave)]);
    let from = before.fold(high(enter), f64::max);
    let to = behind.fold(low(leave), f64::min);
    from..to
}

impl Prism {
    /// Returns whether a point on the line lies within the walls; `None` if rounding decides.
    fn is_within(&self, ray: &LocalRay, s: f64) -> Option<bool> {
        let off = ray.blur_at(s) + 16.0 * U * (1.0 + s.abs());
        let (place, error) = self.seen_from_tip(ray.at(s), off)?;
        self.outline.is_inside(place, error)
    }

    /// Projects a point into the outline; also returns its error there, given the error `off` of the point.
    /// `None` if it is too near to the tip.
    fn seen_from_tip(&self, point: Vector, off: f64) -> Option<(Point, f64)> {
        if !self.conic {
            return Some(([point.x, point.y], off));
        }
        let place = [point.x / point.z, point.y / point.z];
        let size = 1.0 + place[0].abs() + place[1].abs();
        let error = off * size / (point.z.abs() - off);
        (error > 0.0).then_some((place, error))
    }

    /// Clips the part of the line between two walls to the two ends; it is certainly within the walls where `told` says
    /// so. What rounding cannot separate from a miss is dropped.
    fn cut(
        &self,
        ray: &LocalRay,
        [first, last]: [Met; 2],
        (enter, leave): (Met, Met),
        told: Range<f64>,
    ) -> Option<[Met; 2]> {
        let is_within = |s: f64| self.is_within(ray, s);
        let limit = high(&leave).min(low(&last));
        let (mut enter_at, by_first) = entered(enter, first, &told, limit, is_within)?;
        let limit = high(&reversed(enter)).min(low(&reversed(first)));
        let is_within = |s: f64| self.is_within(ray, -s);
        let told = -told.end..-told.start;
        let (leave, last) = (reversed(leave), reversed(last));
        let (leave_at, by_last) = entered(leave, last, &told, limit, is_within)?;
        let mut leave_at = reversed(leave_at);
        // Where an end is passed, it is certainly inside.
        if by_first && high(&enter_at) < high(&leave_at) {
            leave_at = after(high(&enter_at), leave_at);
        }
        if by_last && low(&enter_at) < low(&leave_at) {
            enter_at = before(low(&leave_at), enter_at);
        }
        let is_told = high(&enter_at) < low(&leave_at);
        (is_told || (by_first || by_last) && enter_at.t < leave_at.t)
            .then_some([enter_at, leave_at])
    }
}

impl Prism {
    /// Returns whether the line, between two positions, may approach the bounding box of the outline.
    fn may_be_near(&self, ray: &LocalRay, from: f64, to: f64) -> bool {
        let (n, d) = (ray.nearest, ray.direction);
        let off = ray.blur_at(2.0) + 16.0 * U;
        let [low, high] = self.outline.hull();
        let beside = |place: f64, way: f64, low: f64, high: f64| {
            let (a, b) = (place + from * way, place + to * way);
            a.max(b) < low - off || a.min(b) > high + off
        };
        self.conic || !(beside(n.x, d.x, low[0], high[0]) || beside(n.y, d.y, low[1], high[1]))
    }
}

impl Local for Prism {
    fn crossings(&self, ray: &LocalRay, found: &mut Crossings) {
        self.first_crossings(ray, (f64::NEG_INFINITY, f64::INFINITY), found);
    }

    fn first_crossings(&self, ray: &LocalRay, (from, to): (f64, f64), found: &mut Crossings) {
        let Some((first, last)) = between(ray, self.heights) else { return };
        let (begin, end) = (from.max(low(&first)), to.min(high(&last)));
        if begin > end || !self.may_be_near(ray, begin, end) {
            return;
        }
        // An end of no width is the tip of the walls.
        let is_tip = |end: u32| self.conic && self.heights[usize::from(end == CAP)] == 0.0;
        let seen = |met: Met| match met.part {
            CAP | BASE if self.open && is_tip(met.part) => Met { part: part_of(0, true), ..met },
            CAP | BASE if self.open => Met { part: Met::UNSEEN, ..met },
            _ => met,
        };
        let mut before: Option<f64> = None;
        let (mut spans, in_wall, mut is_told) = self.spans(ray, (begin, end));
        let mut line = *ray;
        if let Some(least) = in_wall
            && ray.in_world.is_some()
        {
            // Of two that share the wall, the one on whose side the line is taken to be has it.
            line = beside(ray, self.conic, least);
            (spans, _, is_told) = self.spans(&line, (f64::NEG_INFINITY, f64::INFINITY));
        }
        let off = (line.nearest - ray.nearest).length();
        let moved = |met: Met| {
            if off == 0.0 || !met.t.is_finite() {
                return met;
            }
            let slope = self.height(met.part, ray.at(met.t)).gradient.dot(ray.direction).abs();
            Met { error: met.error + 2.0 * off / slope, ..met }
        };
        for (number, walls) in spans.iter().enumerate() {
            if off == 0.0 && (low(&walls.0) > end || high(&walls.1) < begin) {
                continue;
            }
            let told = if is_told { surely_within(&spans, number) } else { 0.0..0.0 };
            let cut = self.cut(&line, [first, last], *walls, told);
            let Some([enter, leave]) = cut else { continue };
            let [enter, leave] = [enter, leave].map(moved);
            // What is not told from a part before is one with it.
            if before.is_some_and(|end| enter.t <= end) {
                found.pop();
            } else {
                found.push(seen(enter));
            }
            found.push(seen(leave));
            before = Some(leave.t);
        }
    }

    /// Known at an end certainly within the walls, or certainly apart from both ends on a single wall.
    fn part_at(&self, ray: &LocalRay, s: f64, leaving: bool) -> Option<u32> {
        let point = ray.at(s);
        let off = 64.0 * (ray.blur_at(s) + U * (1.0 + s.abs())) + 2.0 * ray.tolerance;
        let (place, error) = self.seen_from_tip(point, off)?;
        let up = ray.direction.z > 0.0;
        match self.heights.map(|end| (point.z - end).abs() <= off) {
            [false, false] => {
                let piece = self.outline.piece_at(place, error)?;
                let (at, normal) = self.outline.pieces[piece].nearest(place);
                let slope = self.normal(at, normal).dot(ray.direction);
                let gap = [place[0] - at[0], place[1] - at[1]];
                // A line in a wall is crossed where it is taken to be.
                let is_there = gap[0] * gap[0] + gap[1] * gap[1] <= 4.0 * error * error;
                // As the place, so the normal may be off: the more, the sharper the bend.
                (is_there && slope.abs() > 2.0 * GRAZING.max(error.sqrt()))
                    .then(|| part_of(piece, (slope > 0.0) == leaving))
            }
            [true, true] => None,
            [is_base, _] => {
                let is_fit = !self.open && leaving == (up != is_base);
                let part = if is_base { BASE } else { CAP };
                (is_fit && self.outline.is_inside(place, error)?).then_some(part)
            }
        }
    }

    fn height(&self, part: u32, point: Vector) -> Height {
        let [low, high] = self.heights;
        match part {
            CAP => Height { value: point.z - high, gradient: Vector::Z, error: U },
            BASE => Height { value: low - point.z, gradient: -Vector::Z, error: U },
            _ => {
                let number = part.saturating_sub(WALLS);
                let Some(piece) = self.outline.pieces.get(number as usize / 2) else {
                    return Height { value: 0.0, gradient: Vector::Z, error: 0.0 };
                };
                let side = if number % 2 == 1 { -1.0 } else { 1.0 };
                let scale = if self.conic { point.z } else { 1.0 };
                if scale == 0.0 {
                    // The tip faces any way.
                    let error = point.length() + U;
                    return Height { value: 0.0, gradient: Vector::Z, error };
                }
                let place = [point.x / scale, point.y / scale];
                let (at, normal) = piece.nearest(place);
                let off = normal[0] * (place[0] - at[0]) + normal[1] * (place[1] - at[1]);
                Height {
                    value: side * scale * off,
                    gradient: self.normal(at, normal) * side,
                    error: 16.0 * U,
                }
            }
        }
    }

    fn extent(&self, along: Vector) -> (f64, f64) {
        let greatest = |along: Vector| {
            let at = |height: f64| {
                let scale = if self.conic { height } else { 1.0 };
                self.outline.greatest([scale * along.x, scale * along.y]) + height * along.z
            };
            at(self.heights[0]).max(at(self.heights[1]))
        };
        (-greatest(-along), greatest(along))
    }

    fn is_iterated(&self) -> bool {
        self.outline.pieces.iter().any(|piece| !piece.is_straight())
    }

    fn price(&self) -> u64 {
        30 + 4 * self.outline.pieces.len() as u64
    }

    fn reach(&self) -> f64 {
        let height = self.heights[0].abs().max(self.heights[1].abs());
        let width = self.outline.reach() * if self.conic { height } else { 1.0 };
        (width * width + height * height).sqrt() * (1.0 + 4.0 * U)
    }

    fn numbers(&self) -> String {
        let [low, high] = self.heights;
        let conic = if self.conic { " conic" } else { "" };
        let open = if self.open { " open" } else { "" };
        format!(" of {} from {low} to {high}{conic}{open}", self.outline.pieces.len())
    }

    fn contains(&self, point: Vector) -> bool {
        let scale = if self.conic { point.z } else { 1.0 };
        let [low, high] = self.heights;
        low < point.z
            && point.z < high
            && scale != 0.0
            && self.outline.contains([point.x / scale, point.y / scale])
    }
}
