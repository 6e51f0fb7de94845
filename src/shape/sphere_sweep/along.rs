//! The pieces of a line that lie in one segment of a sphere sweep.
//!
//! Let a(u) be the position along the line nearest to the centre of the sphere at u, and D(u) the square of
//! its radius less that of its distance from the line. The line enters the sphere at a − √D and leaves it at
//! a + √D. These are extremal where 4a′²D = D′², a polynomial of degree 10, or at the first or last sphere.
//!
//! **Invariant:** each position found belongs to some sphere, so the piece is at least that long; the choice
//! of the sphere that maximizes it matters only to second order.

use smallvec::SmallVec;

use super::Segment;
use crate::math::Vector;
use crate::math::roots::polynomial::{root_between_ends, turning_points};
use crate::shape::U;
use crate::shape::local::LocalRay;

/// Where the line enters or leaves a sphere.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    pub s: f64,
    pub error: f64,
    /// The sphere's parameter.
    pub u: f64,
}

/// Ranges of u.
type Stretches = SmallVec<[(f64, f64); 4]>;

/// Minimum length of a stretch, as a fraction of a segment.
const SHORTEST: f64 = 1.0 / 32.0;

/// Polynomials in u, in ascending order of degree.
struct Along {
    /// a(u).
    place: [f64; 4],
    /// Vector from the line to the centre, across the line.
    across: [Vector; 4],
    radius: [f64; 4],
    /// D(u).
    room: [f64; 7],
    /// 4a′²D − D′².
    turns: [f64; 11],
    rounding: f64,
}

fn value(polynomial: &[f64], u: f64) -> f64 {
    polynomial.iter().rev().fold(0.0, |sum, c| sum * u + c)
}

fn add_product(sum: &mut [f64], a: &[f64], b: &[f64], factor: f64) {
    for (i, a) in a.iter().enumerate() {
        for (j, b) in b.iter().enumerate() {
            if let Some(sum) = sum.get_mut(i + j) {
                *sum += factor * a * b;
            }
        }
    }
}

fn derivative<const N: usize>(polynomial: &[f64]) -> [f64; N] {
    std::array::from_fn(|k| polynomial.get(k + 1).map_or(0.0, |c| c * (k + 1) as f64))
}

/// Removes terms of the highest degrees that are 0.
fn trimmed(polynomial: &[f64]) -> &[f64] {
    let degree = polynomial.iter().rposition(|c| *c != 0.0).unwrap_or(0);
    &polynomial[..=degree]
}

/// A sphere relative to the line.
struct Ball {
    place: f64,
    /// D.
    room: f64,
    /// Error of D.
    room_error: f64,
    /// Error of the sphere.
    off: f64,
}

impl Along {
    fn new(segment: &Segment, ray: &LocalRay) -> Self {
        let mut from = segment.centre;
        from[0] -= ray.nearest;
        let place = from.map(|v| v.dot(ray.direction));
        let across = std::array::from_fn(|k| from[k] - ray.direction * place[k]);
        let radius = segment.radius;
        let mut room = [0.0; 7];
        add_product(&mut room, &radius, &radius, 1.0);
        for axis in 0..3 {
            let part = across.map(|v: Vector| v[axis]);
            add_product(&mut room, &part, &part, -1.0);
        }
        Self { place, across, radius, room, turns: [0.0; 11], rounding: segment.rounding() }
    }

    /// Returns ranges of u outside of which the line certainly misses all spheres: there, all Bernstein
    /// coefficients of D are negative.
    fn stretches(&self) -> Stretches {
        let slack = 256.0 * U * self.room.iter().map(|c| c.abs()).sum::<f64>();
        let all: [f64; 7] = std::array::from_fn(|i| {
            let (mut sum, mut share) = (0.0, 1.0);
            for k in 0..=i {
                sum += share * self.room[k];
                share *= (i - k) as f64 / (6.0 - k as f64).max(1.0);
            }
            sum
        });
        let mut found = Stretches::new();
        let mut open: SmallVec<[([f64; 7], f64, f64); 8]> = SmallVec::new();
        open.push((all, 0.0, 1.0));
        while let Some((upper, from, to)) = open.pop() {
            if upper.iter().all(|c| *c < -slack) {
                continue;
            }
            if to - from <= SHORTEST {
                match found.last_mut() {
                    Some((_, last)) if *last == from => *last = to,
                    _ => found.push((from, to)),
                }
                continue;
            }
            // Two halves, as P. de Casteljau finds them.
            let (mut lower, mut upper) = (upper, upper);
            for (level, end) in lower.iter_mut().enumerate().skip(1) {
                for i in 0..7 - level {
                    upper[i] = 0.5 * (upper[i] + upper[i + 1]);
                }
                *end = upper[0];
            }
            let middle = 0.5 * (from + to);
            open.push((upper, middle, to));
            open.push((lower, from, middle));
        }
        found
    }

    fn ball(&self, ray: &LocalRay, u: f64) -> Ball {
        let [a, b, c, d] = self.across;
        let miss = (((d * u + c) * u + b) * u + a).length();
        let radius = value(&self.radius, u).abs();
        let place = value(&self.place, u);
        let off =
            ray.blur_at(place.abs() + radius) + self.rounding + 8.0 * U * ray.nearest.length();
        let room = (radius - miss) * (radius + miss);
        Ball { place, room, room_error: 2.0 * off * (radius + miss + off), off }
    }

    /// Returns where the line enters (`way` −1) or leaves (`way` 1) the sphere at u; `None` if it misses.
    fn end(&self, ray: &LocalRay, u: f64, way: f64) -> Option<f64> {
        let Ball { place, room, .. } = self.ball(ray, u);
        (room >= 0.0).then(|| place + way * room.sqrt())
    }

    /// Returns the first and second derivative of [`Self::end`] by u.
    fn slopes(&self, u: f64, room: f64, way: f64) -> (f64, f64) {
        let (place, room_slope): ([f64; 3], [f64; 6]) =
            (derivative(&self.place), derivative(&self.room));
        let (place_bend, room_bend): ([f64; 2], [f64; 5]) =
            (derivative(&place), derivative(&room_slope));
        let (d, bend) = (value(&room_slope, u), value(&room_bend, u));
        let root = room.sqrt();
        let slope = value(&place, u) + way * d / (2.0 * root);
        let bend =
            value(&place_bend, u) + way * (bend / (2.0 * root) - d * d / (4.0 * root * room));
        (slope, bend)
    }

    /// Computes the polynomial whose roots are the spheres that the line enters first or leaves last.
    fn turn(&mut self) {
        let place: [f64; 3] = derivative(&self.place);
        let room: [f64; 6] = derivative(&self.room);
        let mut square = [0.0; 5];
        add_product(&mut square, &place, &place, 4.0);
        self.turns = [0.0; 11];
        add_product(&mut self.turns, &square, &self.room, 1.0);
        add_product(&mut self.turns, &room, &room, -1.0);
    }

    /// Returns parameters, in order, that include those of the spheres in a stretch that the line enters
    /// first and leaves last.
    fn candidates(&self, (from, to): (f64, f64)) -> SmallVec<[f64; 32]> {
        let mut all: SmallVec<[f64; 32]> = SmallVec::new();
        let turns = trimmed(&self.turns);
        all.extend(turning_points(turns, from, to));
        all.extend([from, to]);
        all.sort_unstable_by(f64::total_cmp);
        let mut roots: SmallVec<[f64; 12]> = SmallVec::new();
        for pair in all.windows(2) {
            roots.extend(root_between_ends(turns, (pair[0], pair[1])));
        }
        all.extend(roots);
        all.extend(turning_points(trimmed(&self.room), from, to));
        all.extend(turning_points(trimmed(&self.place), from, to));
        all.sort_unstable_by(f64::total_cmp);
        all.dedup();
        all
    }

    /// Refines a parameter near that of the sphere that the line enters first, or leaves last.
    ///
    /// **Error**, with r the radius and B the error of the line or the sphere: B, plus its effect on √D,
    /// which is about 4B·r/√D, or √(4B·r + 2B²) if that is smaller; doubled, as an adjacent sphere may be the
    /// intended one. The remaining slope adds the length of one more Newton step.
    fn polish(&self, ray: &LocalRay, start: Place, way: f64) -> Place {
        let Place { mut s, mut u, .. } = start;
        let mut rest = 0.0;
        for _ in 0..12 {
            let Ball { room, .. } = self.ball(ray, u);
            let (slope, bend) = self.slopes(u, room, way);
            let step = if bend * way < 0.0 { slope / bend } else { 0.0 };
            let next = (u - step).clamp(0.0, 1.0);
            rest = (slope * (next - u)).abs();
            match self.end(ray, next, way) {
                Some(further) if (further - s) * way > 0.0 && next != u => (s, u) = (further, next),
                _ => break,
            }
        }
        let Ball { room, room_error, off, place } = self.ball(ray, u);
        let half = room.max(0.0).sqrt();
        let half_error = (room_error / half).min((2.0 * room_error).sqrt());
        let rest = if rest.is_finite() { rest } else { 0.0 };
        let error = 2.0 * (half_error + off) + rest + 8.0 * U * (s.abs() + place.abs());
        Place { s, error, u }
    }
}

/// Calls `found` with every piece of the line that lies in the segment. Pieces may touch.
pub(super) fn pieces(segment: &Segment, ray: &LocalRay, mut found: impl FnMut([Place; 2])) {
    let mut along = Along::new(segment, ray);
    let stretches = along.stretches();
    if stretches.is_empty() {
        return;
    }
    along.turn();
    let mut piece: Option<([Place; 2], bool)> = None;
    let mut end = |along: &Along, piece: Option<([Place; 2], bool)>| {
        if let Some(([enter, leave], true)) = piece {
            found([along.polish(ray, enter, -1.0), along.polish(ray, leave, 1.0)]);
        }
    };
    for stretch in stretches {
        for u in along.candidates(stretch) {
            let Ball { place, room, room_error, .. } = along.ball(ray, u);
            // A ball that may as well be touched does not part two pieces.
            if room < -room_error || room.is_nan() {
                end(&along, piece.take());
                continue;
            }
            let half = room.max(0.0).sqrt();
            let [enter, leave] = [-half, half].map(|half| Place { s: place + half, error: 0.0, u });
            let is_certain = room > room_error;
            piece = Some(match piece {
                None => ([enter, leave], is_certain),
                Some(([first, last], was_certain)) => {
                    let first = if enter.s < first.s { enter } else { first };
                    let last = if leave.s > last.s { leave } else { last };
                    ([first, last], was_certain || is_certain)
                }
            });
        }
        end(&along, piece.take());
    }
}
