//! Where a line crosses a surface of u and v: where the point's two coordinates across the line are 0.
//!
//! Parts of the rectangle whose bounds leave no zero are left out, and a part with one is told by Newton's method
//! on intervals. The two coordinates are the heights over the plane that touches the part at its middle, as far
//! as that is seen from the side, and across that height: where the line touches the surface the first is small
//! of the second order, and is bounded as such. So of what the line passes by, a few parts are left at each
//! size; in coordinates that any two ways have, as many would be as lie along the touch, twice as many at each
//! second size.
//!
//! Cutting ends where the height over a part is told no better than at its middle. All that is left there and is not
//! told from one another along the line is one place. **Invariant:** a crossing lies where Newton's method has
//! proved one, or where all that is left of a place faces the same way: at a pole, where many u and v are one
//! point, or at a crease. Where some of it faces the line and some goes with it, that is a touch, which rounding does
//! not tell from a miss, and is missed.
//!
//! **Source:** D. Toth, "On ray tracing parametric surfaces", SIGGRAPH 1985, p. 171; R. E. Moore, R. B.
//! Kearfott, M. J. Cloud, *Introduction to Interval Analysis* (2009), chapter 8, for the method.

use std::collections::VecDeque;

use super::super::U;
use super::super::body::{LocalRay, Met};
use super::{DEPTH, Image, Parametric, Part, Surface, common, dot, halves, middle, quarters};
use crate::math::Vector;
use crate::math::interval::Interval;

/// No part is cut more often.
const DEEPEST: u32 = 120;

/// Of one of the finest boxes, so many parts are looked at before the rest is taken for as small as it gets.
const MOST: usize = 1024;

/// What is no more than so many times as wide as its middle is known is told as well as can be.
const TOLD: f64 = 2.0;
/// What is known to be one crossing need not be told as well.
const TOLD_ENOUGH: f64 = 8.0;

/// What is looked for along one line.
pub(super) struct Search<'a> {
    surface: Surface<'a>,
    ray: &'a LocalRay<'a>,
    /// Two ways across the line, of no part in particular.
    across: [Vector; 2],
    blur: f64,
    left: Vec<Left>,
    /// How many parts were looked at.
    pub looked: usize,
}

/// What is left of a part.
#[derive(Debug, Clone, Copy)]
struct Left {
    /// Where along the line it may be.
    along: Interval,
    /// It goes the way that the surface faces; `None` where that is not told.
    leaving: Option<bool>,
    /// It has one crossing.
    is_sure: bool,
    place: u32,
}

/// A part as it is seen along the line.
struct Seen {
    part: Part,
    whole: Image,
    at_middle: Image,
    /// Two ways across the line; where the part is seen from the side, out of it and along it.
    across: [Vector; 2],
    /// How far along each of them it is from the line, at its middle and all over.
    off_at_middle: [Interval; 2],
    off: [Interval; 2],
    /// How fast that changes along u and v.
    slopes: [[Interval; 2]; 2],
}

fn width(i: Interval) -> f64 {
    i.high - i.low
}

/// The greatest absolute value.
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
    /// Looks for all crossings of the line.
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

    /// Whether the line may meet a box within the container.
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

    /// The largest parts first, so that all that is left is as small.
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

    /// `None` where the line does not meet the part.
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

    /// Out of the surface and along it, where it is seen from the side; a third way goes along the line.
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

    /// What a step of Newton's leaves of a part: x = m − J⁻¹·g(m), with J the slopes over the part.
    fn newton(&self, seen: &Seen) -> Option<Part> {
        let Seen { part, slopes, off_at_middle: off, .. } = seen;
        let at = part.map(middle);
        let [[a, b], [c, d]] = *slopes;
        let determinant = determinant(slopes);
        let u = Interval::point(at[0]) - (d * off[0] - b * off[1]) / determinant;
        let v = Interval::point(at[1]) - (a * off[1] - c * off[0]) / determinant;
        Some([common(u, part[0])?, common(v, part[1])?])
    }

    /// Whether cutting an irregular part leads no further: the line goes along it, or it is all one point.
    fn is_end(&self, seen: &Seen) -> bool {
        seen.is_told(0, TOLD) && (seen.is_told(1, TOLD) || self.is_seen_from_side(seen))
    }

    /// Whether all of the part certainly faces out of its middle's plane.
    fn is_seen_from_side(&self, seen: &Seen) -> bool {
        let [along_u, along_v] = seen.whole.slopes.map(|slopes| dot(&slopes, self.ray.direction));
        let [aside_u, aside_v] = seen.slopes[1];
        !determinant(&[[aside_u, aside_v], [along_u, along_v]]).contains(0.0)
    }

    /// Whether the line goes the way that the surface faces at the middle, as far as its own error lets tell.
    fn leaving(&self, seen: &Seen) -> Option<bool> {
        let slopes = seen.at_middle.slopes;
        let [u, v] = slopes.map(|slopes| Vector::from_array(slopes.map(size)).length());
        let off = (self.ray.turn + 8.0 * U) * u * v;
        let Interval { low, high } = determinant(&slopes_along(&slopes, seen.across));
        (low > off || high < -off).then_some(low > off)
    }

    /// The way along which a part reaches farther across the line; of the rectangle, where that does not tell.
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

    /// In order; one for each place, and one for each way that is told at a place.
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
    /// The two as one, in the part of what is told better.
    fn with(&self, other: &Self) -> Self {
        let better = if width(other.along) < width(self.along) { other } else { self };
        Self { along: self.along.hull(other.along), ..*better }
    }
}

impl Seen {
    /// Whether it is known no better how far the middle is from the line than how far the whole part is.
    fn is_told(&self, way: usize, times: f64) -> bool {
        width(self.off[way]) <= times * width(self.off_at_middle[way])
    }
}

/// Adds the crossings at one place: what is sure of it, or all of it where it faces one way.
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
