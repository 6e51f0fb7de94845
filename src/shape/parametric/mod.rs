//! Parametric surface: the points that three functions of u and v yield over a rectangle, clipped to a
//! container. It is a sheet that faces along ∂u × ∂v.
//!
//! A ray crosses it where both coordinates of the point across the ray are 0; `search.rs` finds these points.
//!
//! **Invariant:** a tree of boxes contains the entire surface.

mod search;

use std::cell::RefCell;
use std::sync::Arc;

use smallvec::SmallVec;

use super::U;
use super::isosurface::Container;
use super::local::{Crossings, Height, Local, LocalRay};
use crate::function::{Run, Sloped};
use crate::math::Vector;
use crate::math::interval::Interval;
use crate::texture::Closed;
use search::Search;

/// The rectangle is divided into 2^DEPTH parts along each parameter in advance.
const DEPTH: u32 = 5;

/// A part of the rectangle.
type Part = [Interval; 2];

/// The sheet that three functions of u and v yield over a rectangle.
#[derive(Debug, Clone, PartialEq)]
pub struct Parametric {
    functions: [Arc<Closed>; 3],
    rectangle: Part,
    container: Container,
    /// A local point is `centre + scale · point` in the coordinates of the functions; the scale is a power of
    /// two.
    centre: Vector,
    scale: f64,
    /// The boxes of the parts, by level; four below each.
    boxes: Vec<[Interval; 3]>,
}

/// Evaluates the functions.
struct Surface<'a> {
    body: &'a Parametric,
    runs: [RefCell<Run<'a, Sloped<2>>>; 3],
}

/// The image of a part under the functions.
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

    /// Returns the middle of the image of a point, and of its slopes along u and v.
    fn middle(&self, [u, v]: [f64; 2]) -> (Vector, Vector, Vector) {
        let image = self.evaluate([Interval::point(u), Interval::point(v)]);
        let mid = |all: [Interval; 3]| Vector::from_array(all.map(middle));
        (mid(image.point), mid(image.slopes[0]), mid(image.slopes[1]))
    }

    /// Like [`Self::evaluate`], with the points limited by the slopes from the middle's; also returns the
    /// image of the middle.
    fn images(&self, part: Part) -> [Image; 2] {
        let mut image = self.evaluate(part);
        let at = part.map(|i| Interval::point(middle(i)));
        let there = self.evaluate(at);
        let slopes = image.slopes;
        for (axis, point) in image.point.iter_mut().enumerate() {
            let step = |way: usize| slopes[way][axis] * (part[way] - at[way]);
            let near = there.point[axis] + step(0) + step(1);
            *point = common(*point, near).unwrap_or(*point);
        }
        [image, there]
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
    /// Builds the surface over the rectangle between two corners.
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
            boxes.extend(level.iter().map(|part| surface.images(*part)[0].point));
            if depth < DEPTH {
                level = level.into_iter().flat_map(quarters).collect();
            }
        }
        body.boxes = boxes;
        body
    }

    /// Returns whether the surface certainly lies outside of its container.
    pub fn is_outside(&self) -> bool {
        let finest = self.boxes.len().saturating_sub(1 << (2 * DEPTH));
        self.boxes[finest..].iter().all(|part| self.container.misses(part))
    }

    fn surface(&self) -> Surface<'_> {
        let runs = self.functions.each_ref().map(|f| RefCell::new(f.function().run()));
        Surface { body: self, runs }
    }

    /// Returns the part at an index of the finest level.
    fn part(&self, mut place: u32) -> Part {
        let mut ways: SmallVec<[u32; 8]> = SmallVec::new();
        for _ in 0..DEPTH {
            ways.push(place % 4);
            place /= 4;
        }
        ways.into_iter().rev().fold(self.rectangle, |part, way| quarters(part)[way as usize])
    }

    /// Returns the number of parts visited to intersect a line.
    #[cfg(test)]
    pub(super) fn parts_looked_at(&self, ray: &LocalRay) -> usize {
        Search::along(self, ray).looked
    }

    /// Returns u and v of the surface point nearest to `point`, searched within a part.
    pub fn uv(&self, part: u32, point: Vector) -> [f64; 2] {
        let part = self.part(part);
        let surface = self.surface();
        let at = |place| surface.middle(place);
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
        place
    }

    fn held(&self) -> Vector {
        match self.container {
            Container::Box(half) => half,
            Container::Sphere(radius) => Vector::splat(radius),
        }
    }
}

impl Local for Parametric {
    fn crossings(&self, ray: &LocalRay, found: &mut Crossings) {
        found.extend(Search::along(self, ray).crossings());
    }

    /// Measured from the tangent plane at the surface point nearest to `point`, searched within the part.
    fn height(&self, part: u32, point: Vector) -> Height {
        let place = self.uv(part, point);
        let part = self.part(part);
        let surface = self.surface();
        let at = |place| surface.middle(place);
        let (there, along_u, along_v) = at(place);
        let mut normal = along_u.cross(along_v);
        if normal == Vector::ZERO {
            // At a pole it faces as it does right beside.
            let beside =
                |way: usize| place[way] + f64::EPSILON.sqrt() * (middle(part[way]) - place[way]);
            let (_, along_u, along_v) = at([beside(0), beside(1)]);
            normal = along_u.cross(along_v);
        }
        let normal = normal.normalize_or(Vector::Y);
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
