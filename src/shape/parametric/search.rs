//! Intersects a line with a surface of u and v: searches for points where both coordinates across the line
//! are 0.
//!
//! Parts of the rectangle whose bounds exclude a zero are dropped, and interval Newton isolates a part with
//! one zero. The two coordinates are the height over the tangent plane at the middle of the part, as far as
//! it is seen from the side, and the coordinate perpendicular to it. Where the line touches the surface, the
//! height is small of second order, and is bounded as such. So near a tangent line only a few parts are left
//! at each size; with arbitrary coordinates, as many would be left as lie along the tangency, twice as many
//! at every second size.
//!
//! Subdivision ends where the height over a part is known no better than at its middle. Remaining parts that
//! overlap along the line count as one position. **Invariant:** a crossing lies where interval Newton proved
//! one, or where all remaining parts at a position face the same direction: at a pole, where many u and v map
//! to one point, or at a crease. If some face along the line and some against it, the line is tangent, which
//! rounding cannot separate from a miss, and counts as a miss.
//!
//! **Source:** D. Toth, "On ray tracing parametric surfaces", SIGGRAPH 1985, p. 171; R. E. Moore, R. B.
//! Kearfott, M. J. Cloud, *Introduction to Interval Analysis* (2009), chapter 8, for the method.

use std::collections::VecDeque;

use super::super::U;
use super::super::local::{LocalRay, Met};
use super::{DEPTH, Image, Parametric, Part, Surface, common, dot, halves, middle, quarters};
use crate::math::Vector;
use crate::math::interval::Interval;

/// Maximum number of subdivisions of a part.
const DEEPEST: u32 = 120;

/// Maximum number of parts visited in one of the finest boxes, before the remaining ones count as
/// indivisible.
const MOST: usize = 1024;

/// A part is resolved if it is at most this many times as wide as the uncertainty at its middle.
const TOLD: f64 = 2.0;
/// Like `TOLD`, for a part that is known to have one crossing.
const TOLD_ENOUGH: f64 = 8.0;

/// The search along one line.
pub(super) struct Search<'a> {
    surface: Surface<'a>,
    ray: &'a LocalRay<'a>,
    /// Two default directions across the line.
    across: [Vector; 2],
    blur: f64,
    left: Vec<Left>,
    /// Number of visited parts.
    pub looked: usize,
}

/// A part that remains after subdivision.
#[derive(Debug, Clone, Copy)]
struct Left {
    /// Its range along the line.
    along: Interval,
    /// Whether the line goes in the direction that the surface faces; `None` if that is uncertain.
    leaving: Option<bool>,
    /// Whether it certainly has one crossing.
    is_sure: bool,
    place: u32,
}

/// A part relative to the line.
struct Seen {
    part: Part,
    whole: Image,
    at_middle: Image,
    /// Two directions across the line; if the part is seen from the side, out of the surface and along it.
    across: [Vector; 2],
    /// Distance from the line along each of them: at the middle, and over the entire part.
    off_at_middle: [Interval; 2],
    off: [Interval; 2],
    /// Derivatives of that along u and v.
    slopes: [[Interval; 2]; 2],
}

fn width(i: Interval) -> f64 {
    i.high - i.low
}

/// The maximum absolute value.
fn size(i: Interval) -> f64 {
    i.low.abs().max(i.high.abs())
}

fn determinant([[a, b], [c, d]]: &[[Interval; 2]; 2]) -> Interval {
    *a * *d - *b * *c
}

fn slopes_along(slopes: &[[Interval; 3]; 2], across: [Vector; 2]) -> [[Interval; 2]; 2] {
    across.map(|axis| [0, 1].map(|way| dot(&slopes[way], axis)))
}

impl<'a> Search<'a> {
    /// Searches for all crossings of the line.
    pub fn along(body: &'a Parametric, ray: &'a LocalRay<'a>) -> Self {
        let reach = body.container.reach();
        let away = [Vector::X, Vector::Y, Vector::Z]
            .into_iter()
            .min_by(|a, b| a.dot(ray.direction).abs().total_cmp(&b.dot(ray.direction).abs()));
        let first = ray.direction.cross(away.unwrap_or(Vector::X)).normalize();
        let across = [first, ray.direction.cross(first)];
        let blur = ray.blur_at(reach) + 16.0 * U * reach;
        let surface = body.surface();
        let mut search = Self { surface, ray, across, blur, left: Vec::new(), looked: 0 };
        search.descend(0, 0, 0, body.rectangle);
        search
    }

    /// Returns whether the line may intersect a box within the container.
    fn may_meet(&self, point: &[Interval; 3]) -> bool {
        let held = self.surface.body.held();
        let (mut enter, mut leave) = (f64::NEG_INFINITY, f64::INFINITY);
        for axis in 0..3 {
            let (place, way) = (self.ray.nearest[axis], self.ray.direction[axis]);
            let slack = self.blur;
            let low = point[axis].low.max(-held[axis]) - slack;
            let high = point[axis].high.min(held[axis]) + slack;
            if way == 0.0 {
                if !(low <= place && place <= high) {
                    return false;
                }
                continue;
            }
            let (a, b) = ((low - place) / way, (high - place) / way);
            enter = enter.max(a.min(b));
            leave = leave.min(a.max(b));
        }
        enter <= leave || enter - leave <= 8.0 * U * (1.0 + enter.abs())
    }

    fn descend(&mut self, level: u32, first: usize, place: usize, part: Part) {
        if !self.may_meet(&self.surface.body.boxes[first + place]) {
            return;
        }
        if level == DEPTH {
            return self.look(part, place as u32);
        }
        let below = first + (1usize << (2 * level));
        for (way, quarter) in quarters(part).into_iter().enumerate() {
            self.descend(level + 1, below, 4 * place + way, quarter);
        }
    }

    /// Visits the largest parts first, so that all remaining parts are equally small.
    fn look(&mut self, part: Part, place: u32) {
        let mut parts = VecDeque::from([(part, 0, false)]);
        let before = self.looked;
        while let Some((part, depth, is_sure)) = parts.pop_front() {
            self.looked += 1;
            let Some(seen) = self.see(part) else { continue };
            let determinant = determinant(&seen.slopes);
            let is_regular = determinant.is_finite() && !determinant.contains(0.0);
            let next = if is_regular { self.newton(&seen) } else { Some(part) };
            let Some(next) = next else { continue };
            let is_inside =
                |way: usize| part[way].low < next[way].low && next[way].high < part[way].high;
            let is_sure = is_sure || is_inside(0) && is_inside(1);
            let told = if is_sure { TOLD_ENOUGH } else { TOLD };
            let shrinks = (0..2).all(|way| {
                let before = width(part[way]);
                width(next[way]) <= 0.5 * before || before == 0.0
            });
            let size = (part[0].low.abs() + part[1].low.abs()).max(f64::MIN_POSITIVE);
            let is_least = depth > DEEPEST
                || width(part[0]).max(width(part[1])) <= 16.0 * U * size
                || self.looked - before > MOST;
            if is_regular && shrinks && !is_least {
                parts.push_back((next, depth + 1, is_sure));
            } else if is_regular && (is_least || seen.is_told(0, told)) {
                self.keep(next, is_sure, Some(determinant.low > 0.0), place);
            } else if is_least || self.is_end(&seen) {
                self.keep(part, false, self.leaving(&seen), place);
            } else {
                let way = self.longer(&seen, next);
                for half in halves(next[way]) {
                    let mut part = next;
                    part[way] = half;
                    parts.push_back((part, depth + 1, false));
                }
            }
        }
    }

    /// Returns the part relative to the line; `None` if the line misses it.
    fn see(&self, part: Part) -> Option<Seen> {
        let [whole, at_middle] = self.surface.images(part);
        if !self.may_meet(&whole.point) {
            return None;
        }
        let across = self.across(&at_middle);
        let off_at_middle = self.off(&at_middle, across);
        let slopes = slopes_along(&whole.slopes, across);
        let mut off = self.off(&whole, across);
        for (off, (there, slopes)) in off.iter_mut().zip(off_at_middle.iter().zip(&slopes)) {
            let step = |way: usize| slopes[way] * (part[way] - Interval::point(middle(part[way])));
            *off = common(*off, *there + step(0) + step(1)).unwrap_or(*off);
        }
        let meets = off.iter().all(|off| off.contains(0.0));
        meets.then_some(Seen { part, whole, at_middle, across, off_at_middle, off, slopes })
    }

    /// Returns the directions out of the surface and along it, both across the line, if it is seen from the
    /// side.
    fn across(&self, at: &Image) -> [Vector; 2] {
        let [u, v] = at.slopes.map(|slopes| Vector::from_array(slopes.map(middle)));
        let normal = u.cross(v);
        let aside = self.ray.direction.cross(normal);
        if aside.length_squared() > 0.25 * normal.length_squared() {
            let aside = aside.normalize();
            [aside.cross(self.ray.direction), aside]
        } else {
            self.across
        }
    }

    fn off(&self, image: &Image, across: [Vector; 2]) -> [Interval; 2] {
        let off_line = self.off_line(image);
        let wide = Interval { low: -self.blur, high: self.blur };
        across.map(|way| dot(&off_line, way) + wide)
    }

    fn off_line(&self, image: &Image) -> [Interval; 3] {
        std::array::from_fn(|axis| image.point[axis] - Interval::point(self.ray.nearest[axis]))
    }

    /// Returns what an interval Newton step leaves of a part: x = m − J⁻¹·g(m), with J the slopes over the
    /// part.
    fn newton(&self, seen: &Seen) -> Option<Part> {
        let Seen { part, slopes, off_at_middle: off, .. } = seen;
        let at = part.map(middle);
        let [[a, b], [c, d]] = *slopes;
        let determinant = determinant(slopes);
        let u = Interval::point(at[0]) - (d * off[0] - b * off[1]) / determinant;
        let v = Interval::point(at[1]) - (a * off[1] - c * off[0]) / determinant;
        Some([common(u, part[0])?, common(v, part[1])?])
    }

    /// Returns whether subdividing an irregular part is useless: the line is tangent to it, or it is a single
    /// point.
    fn is_end(&self, seen: &Seen) -> bool {
        seen.is_told(0, TOLD) && (seen.is_told(1, TOLD) || self.is_seen_from_side(seen))
    }

    /// Returns whether the part, seen from the side, is certainly regular throughout.
    fn is_seen_from_side(&self, seen: &Seen) -> bool {
        let [along_u, along_v] = seen.whole.slopes.map(|slopes| dot(&slopes, self.ray.direction));
        let [aside_u, aside_v] = seen.slopes[1];
        !determinant(&[[aside_u, aside_v], [along_u, along_v]]).contains(0.0)
    }

    /// Returns whether the line goes in the direction that the surface faces at the middle; `None` within its
    /// error.
    fn leaving(&self, seen: &Seen) -> Option<bool> {
        let slopes = seen.at_middle.slopes;
        let [u, v] = slopes.map(|slopes| Vector::from_array(slopes.map(size)).length());
        let off = (self.ray.turn + 8.0 * U) * u * v;
        let Interval { low, high } = determinant(&slopes_along(&slopes, seen.across));
        (low > off || high < -off).then_some(low > off)
    }

    /// Returns the parameter along which a part extends farther across the line; if that is unknown, farther
    /// in the rectangle.
    fn longer(&self, seen: &Seen, part: Part) -> usize {
        let reach = |way: usize| {
            let slope = size(seen.slopes[0][way]).max(size(seen.slopes[1][way]));
            slope * width(part[way])
        };
        let whole = self.surface.body.rectangle;
        let share = |way: usize| width(part[way]) / width(whole[way]);
        let (first, second) = (reach(0), reach(1));
        let is_told = first + second > 0.0 && (first + second).is_finite();
        usize::from(if is_told { second > first } else { share(1) > share(0) })
    }

    fn keep(&mut self, part: Part, is_sure: bool, leaving: Option<bool>, place: u32) {
        let [image, _] = self.surface.images(part);
        let along = dot(&self.off_line(&image), self.ray.direction);
        let along = Interval { low: along.low - self.blur, high: along.high + self.blur };
        if self.surface.body.container.contains(self.ray.at(middle(along))) {
            self.left.push(Left { along, leaving, is_sure, place });
        }
    }

    /// Returns the crossings in order; one for each position, and one for each known direction at a position.
    pub fn crossings(mut self) -> Vec<Met> {
        self.left.sort_by(|a, b| a.along.low.total_cmp(&b.along.low));
        let mut found = Vec::new();
        let mut first = 0;
        while let Some(start) = self.left.get(first) {
            let (mut end, mut high) = (first, start.along.high);
            while let Some(next) = self.left.get(end).filter(|next| next.along.low <= high) {
                high = high.max(next.along.high);
                end += 1;
            }
            tell(&self.left[first..end], &mut found);
            first = end;
        }
        found.sort_by(|a: &Met, b| a.t.total_cmp(&b.t));
        found
    }
}

impl Left {
    /// Merges two parts, keeping the part number of the better known one.
    fn with(&self, other: &Self) -> Self {
        let better = if width(other.along) < width(self.along) { other } else { self };
        Self { along: self.along.hull(other.along), ..*better }
    }
}

impl Seen {
    /// Returns whether the distance from the line is known at the middle hardly better than over the entire
    /// part.
    fn is_told(&self, way: usize, times: f64) -> bool {
        width(self.off[way]) <= times * width(self.off_at_middle[way])
    }
}

/// Adds the crossings at one position: those that are certain, or all parts if they face the same direction.
fn tell(all: &[Left], found: &mut Vec<Met>) {
    for leaving in [false, true] {
        let is_alone = all.iter().all(|left| left.leaving == Some(leaving));
        let counts = |left: &&Left| left.leaving == Some(leaving) && (left.is_sure || is_alone);
        let mut same: Vec<Left> = Vec::new();
        // In their order, so that what is apart lies behind all before.
        for left in all.iter().filter(counts) {
            match same.last_mut() {
                Some(last) if left.along.low <= last.along.high => *last = last.with(left),
                _ => same.push(*left),
            }
        }
        found.extend(same.into_iter().map(|Left { along, place, .. }| Met {
            t: middle(along),
            error: 0.5 * width(along) + 2.0 * U * size(along),
            leaving,
            part: place,
        }));
    }
}
