//! Parametric surface: the points that three functions of u and v give over a rectangle, within a container. A
//! sheet; it faces along ∂u × ∂v.
//!
//! A ray crosses it where the point's two coordinates across the ray are 0: parts of the rectangle whose bounds
//! leave no zero are left out, and a part with one is told by Newton's method on intervals. **Invariant:** a
//! crossing lies where that method has proved one, or where a part became as small as rounding tells.
//!
//! **Source:** D. Toth, "On ray tracing parametric surfaces", SIGGRAPH 1985, p. 171; R. E. Moore, R. B.
//! Kearfott, M. J. Cloud, *Introduction to Interval Analysis* (2009), chapter 8, for the method.

use std::cell::RefCell;
use std::sync::Arc;

use smallvec::SmallVec;

use super::U;
use super::body::{Crossings, Height, Local, LocalRay, Met};
use super::isosurface::Container;
use crate::function::{Closed, Run, Sloped};
use crate::math::Vector;
use crate::math::interval::Interval;

/// The rectangle is cut into 2^DEPTH parts along each way beforehand.
const DEPTH: u32 = 5;

/// No part is cut more often.
const DEEPEST: u32 = 60;

/// A part of the rectangle.
type Part = [Interval; 2];

#[derive(Debug, Clone, PartialEq)]
pub struct Parametric {
    functions: [Arc<Closed>; 3],
    rectangle: Part,
    container: Container,
    /// A local point is the functions' `centre + scale · point`; the scale is a power of two.
    centre: Vector,
    scale: f64,
    /// The boxes of the parts, by level; four below each.
    boxes: Vec<[Interval; 3]>,
}

/// The functions at work.
struct Surface<'a> {
    body: &'a Parametric,
    runs: [RefCell<Run<'a, Sloped<2>>>; 3],
}

/// Where the functions go over a part.
struct Image {
    point: [Interval; 3],
    /// Along u, and along v.
    slopes: [[Interval; 3]; 2],
}

fn middle(i: Interval) -> f64 {
    i.low + 0.5 * (i.high - i.low)
}

fn common(a: Interval, b: Interval) -> Option<Interval> {
    let both = Interval { low: a.low.max(b.low), high: a.high.min(b.high) };
    (both.low <= both.high).then_some(both)
}

fn dot(a: &[Interval; 3], b: Vector) -> Interval {
    let term = |axis: usize| a[axis] * Interval::point(b[axis]);
    term(0) + term(1) + term(2)
}

impl Surface<'_> {
    fn evaluate(&self, [u, v]: Part) -> Image {
        let (zero, one) = (Interval::point(0.0), Interval::point(1.0));
        let point = [
            Sloped { value: u, slopes: [one, zero] },
            Sloped { value: v, slopes: [zero, one] },
            Sloped { value: zero, slopes: [zero, zero] },
        ];
        let Parametric { functions, centre, scale, .. } = self.body;
        let over = |i: Interval| Interval { low: i.low / scale, high: i.high / scale };
        let all: [Sloped<2>; 3] = std::array::from_fn(|axis| {
            let function = &functions[axis];
            let count = function.function().parameters().min(3);
            self.runs[axis].borrow_mut().at(&point[..count], &**function)
        });
        Image {
            point: std::array::from_fn(|i| over(all[i].value - Interval::point(centre[i]))),
            slopes: [0, 1].map(|way| std::array::from_fn(|i| over(all[i].slopes[way]))),
        }
    }

    /// The same, with the points no farther from the middle's than the slopes allow.
    fn image(&self, part: Part) -> Image {
        let mut image = self.evaluate(part);
        let middle = part.map(|i| Interval::point(middle(i)));
        let there = self.evaluate(middle).point;
        let slopes = image.slopes;
        for (axis, point) in image.point.iter_mut().enumerate() {
            let step = |way: usize| slopes[way][axis] * (part[way] - middle[way]);
            let near = there[axis] + step(0) + step(1);
            *point = common(*point, near).unwrap_or(*point);
        }
        image
    }
}

fn halves(i: Interval) -> [Interval; 2] {
    let cut = middle(i);
    [Interval { low: i.low, high: cut }, Interval { low: cut, high: i.high }]
}

fn quarters([u, v]: Part) -> [Part; 4] {
    let ([a, b], [c, d]) = (halves(u), halves(v));
    [[a, c], [b, c], [a, d], [b, d]]
}

impl Parametric {
    /// Over the rectangle between two corners.
    pub fn new(
        functions: [Arc<Closed>; 3],
        corners: [[f64; 2]; 2],
        container: Container,
        centre: Vector,
        scale: f64,
    ) -> Self {
        let rectangle = [0, 1].map(|way| Interval::between(corners[0][way], corners[1][way]));
        let mut body = Self { functions, rectangle, container, centre, scale, boxes: Vec::new() };
        let mut boxes = Vec::new();
        let surface = body.surface();
        let mut level = vec![rectangle];
        for depth in 0..=DEPTH {
            boxes.extend(level.iter().map(|part| surface.image(*part).point));
            if depth < DEPTH {
                level = level.into_iter().flat_map(quarters).collect();
            }
        }
        body.boxes = boxes;
        body
    }

    fn surface(&self) -> Surface<'_> {
        let runs = self.functions.each_ref().map(|f| RefCell::new(f.function().run()));
        Surface { body: self, runs }
    }

    /// The part of a place among those of the finest level.
    fn part(&self, mut place: u32) -> Part {
        let mut ways: SmallVec<[u32; 8]> = SmallVec::new();
        for _ in 0..DEPTH {
            ways.push(place % 4);
            place /= 4;
        }
        ways.into_iter().rev().fold(self.rectangle, |part, way| quarters(part)[way as usize])
    }

    fn held(&self) -> Vector {
        match self.container {
            Container::Box(half) => half,
            Container::Sphere(radius) => Vector::splat(radius),
        }
    }
}

/// What is looked for along one line.
struct Search<'a> {
    surface: Surface<'a>,
    ray: &'a LocalRay<'a>,
    /// Two ways across the line.
    across: [Vector; 2],
    blur: f64,
    found: Vec<(Met, Part)>,
}

impl Search<'_> {
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

    fn look(&mut self, part: Part, place: u32) {
        let mut stack: Vec<(Part, u32)> = vec![(part, 0)];
        while let Some((part, depth)) = stack.pop() {
            let image = self.surface.image(part);
            let from_line: [Interval; 3] = std::array::from_fn(|axis| {
                image.point[axis] - Interval::point(self.ray.nearest[axis])
            });
            let wide = Interval { low: -self.blur, high: self.blur };
            let off = self.across.map(|way| dot(&from_line, way) + wide);
            if off.iter().any(|off| !off.contains(0.0)) || !self.may_meet(&image.point) {
                continue;
            }
            let slopes = [0, 1].map(|i| [0, 1].map(|way| dot(&image.slopes[way], self.across[i])));
            let determinant = slopes[0][0] * slopes[1][1] - slopes[0][1] * slopes[1][0];
            let width = part.map(|i| i.high - i.low);
            let size = (part[0].low.abs() + part[1].low.abs()).max(f64::MIN_POSITIVE);
            let is_least = depth > DEEPEST || width[0].max(width[1]) <= 16.0 * U * size;
            let is_regular = determinant.is_finite() && !determinant.contains(0.0);
            let newton = if is_regular { self.newton(part, &slopes) } else { Some(part) };
            let Some(next) = newton else { continue };
            let left = [0, 1].map(|way| next[way].high - next[way].low);
            let shrinks = (0..2).all(|way| left[way] <= 0.5 * width[way] || width[way] == 0.0);
            if is_regular && (is_least || !shrinks && self.is_small(&image)) {
                self.keep(next, place);
            } else if is_least {
                // A touch: rounding does not tell it from a miss.
            } else if is_regular && shrinks {
                stack.push((next, depth + 1));
            } else {
                let whole = self.surface.body.rectangle;
                let share = |way: usize| left[way] / (whole[way].high - whole[way].low);
                let way = usize::from(share(1) > share(0));
                for half in halves(next[way]) {
                    let mut part = next;
                    part[way] = half;
                    stack.push((part, depth + 1));
                }
            }
        }
    }

    /// No larger than what the line is off by: cutting leads no further.
    fn is_small(&self, image: &Image) -> bool {
        image.point.iter().all(|i| i.high - i.low <= 64.0 * (self.blur + U))
    }

    /// What a step of Newton's leaves of a part: x = m − J⁻¹·g(m), with J the slopes over the part.
    fn newton(&self, part: Part, slopes: &[[Interval; 2]; 2]) -> Option<Part> {
        let at = part.map(middle);
        let there = self.surface.evaluate(at.map(Interval::point)).point;
        let from_line: [Interval; 3] =
            std::array::from_fn(|axis| there[axis] - Interval::point(self.ray.nearest[axis]));
        let wide = Interval { low: -self.blur, high: self.blur };
        let off = self.across.map(|way| dot(&from_line, way) + wide);
        let [[a, b], [c, d]] = *slopes;
        let determinant = a * d - b * c;
        let u = Interval::point(at[0]) - (d * off[0] - b * off[1]) / determinant;
        let v = Interval::point(at[1]) - (a * off[1] - c * off[0]) / determinant;
        Some([common(u, part[0])?, common(v, part[1])?])
    }

    fn keep(&mut self, part: Part, place: u32) {
        let image = self.surface.image(part);
        let from_line: [Interval; 3] =
            std::array::from_fn(|axis| image.point[axis] - Interval::point(self.ray.nearest[axis]));
        let along = dot(&from_line, self.ray.direction);
        let t = middle(along);
        let error = 0.5 * (along.high - along.low) + self.blur;
        let point = self.ray.at(t);
        if !self.surface.body.container.contains(point) {
            return;
        }
        let way = |way: usize| Vector::from_array(image.slopes[way].map(middle));
        let leaving = way(0).cross(way(1)).dot(self.ray.direction) > 0.0;
        let met = Met { t, error, leaving, part: place };
        // Parts that share an edge have each found it.
        let again = self.found.iter().any(|(other, there)| {
            let touch = |i: usize| there[i].low <= part[i].high && part[i].low <= there[i].high;
            other.leaving == leaving
                && (other.t - t).abs() <= other.error + error
                && touch(0)
                && touch(1)
        });
        if !again {
            self.found.push((met, part));
        }
    }
}

impl Local for Parametric {
    fn crossings(&self, ray: &LocalRay, found: &mut Crossings) {
        let reach = self.reach();
        let away = [Vector::X, Vector::Y, Vector::Z]
            .into_iter()
            .min_by(|a, b| a.dot(ray.direction).abs().total_cmp(&b.dot(ray.direction).abs()));
        let first = ray.direction.cross(away.unwrap_or(Vector::X)).normalize();
        let across = [first, ray.direction.cross(first)];
        let blur = ray.blur_at(reach) + 8.0 * U * reach;
        let mut search = Search { surface: self.surface(), ray, across, blur, found: Vec::new() };
        search.descend(0, 0, 0, self.rectangle);
        search.found.sort_by(|(a, _), (b, _)| a.t.total_cmp(&b.t));
        found.extend(search.found.into_iter().map(|(met, _)| met));
    }

    /// Over the plane that touches the surface where it is nearest to the point, sought within the part.
    fn height(&self, part: u32, point: Vector) -> Height {
        let part = self.part(part);
        let surface = self.surface();
        let at = |[u, v]: [f64; 2]| {
            let image = surface.evaluate([Interval::point(u), Interval::point(v)]);
            let mid = |all: [Interval; 3]| Vector::from_array(all.map(middle));
            (mid(image.point), mid(image.slopes[0]), mid(image.slopes[1]))
        };
        let shares = [0.125, 0.375, 0.625, 0.875];
        let place =
            |way: usize, share: f64| part[way].low + share * (part[way].high - part[way].low);
        let starts = shares.iter().flat_map(|a| shares.map(|b| [place(0, *a), place(1, b)]));
        let far = |start: &[f64; 2]| (at(*start).0 - point).length_squared();
        let start = starts.min_by(|a, b| far(a).total_cmp(&far(b)));
        let mut place = start.unwrap_or(part.map(middle));
        for _ in 0..12 {
            let (there, along_u, along_v) = at(place);
            let off = point - there;
            let (uu, uv, vv) = (along_u.dot(along_u), along_u.dot(along_v), along_v.dot(along_v));
            let (u, v) = (along_u.dot(off), along_v.dot(off));
            let determinant = uu * vv - uv * uv;
            let step = [(vv * u - uv * v) / determinant, (uu * v - uv * u) / determinant];
            if !(step[0].is_finite() && step[1].is_finite()) {
                break;
            }
            place = std::array::from_fn(|way| {
                (place[way] + step[way]).clamp(part[way].low, part[way].high)
            });
        }
        let (there, along_u, along_v) = at(place);
        let normal = along_u.cross(along_v).normalize_or(Vector::Y);
        Height {
            value: (point - there).dot(normal),
            gradient: normal,
            error: 64.0 * U * self.reach(),
        }
    }

    fn extent(&self, along: Vector) -> (f64, f64) {
        let half = self.container.extent(along);
        let whole = self.boxes.first().map_or(Interval::EVERYTHING, |all| dot(all, along));
        (whole.low.max(-half), whole.high.min(half))
    }

    fn price(&self) -> u64 {
        let operations = |function: &Arc<Closed>| function.operations() as u64;
        150 * self.functions.iter().map(operations).sum::<u64>()
    }

    fn reach(&self) -> f64 {
        self.container.reach()
    }

    fn contains(&self, _: Vector) -> bool {
        false
    }

    fn numbers(&self) -> String {
        let Self { rectangle: [u, v], container, centre, scale, functions, .. } = self;
        let count: usize = functions.iter().map(|f| f.function().operations()).sum();
        format!(
            " of {count} operations, u {} … {}, v {} … {}, within {container:?} at {centre} × {scale}",
            u.low, u.high, v.low, v.high
        )
    }

    fn is_sheet(&self) -> bool {
        true
    }
}
