//! Lathe: all points whose distance ρ from the z axis and whose z are inside of an outline, in its own space.
//! What the outline goes around an even number of times is outside.
//!
//! In the plane of ρ and z a line is one branch of a hyperbola, ρ² = m² + e²(s − sₘ)². A steep one parts the
//! outline as it is. Of a flat one the two arms lie close together: each parts the outline by itself, and where
//! an arm begins, at ρ = m, the outline is cut, so both see the same ends.

use smallvec::SmallVec;

use super::U;
use super::body::{Crossings, Height, Local, LocalRay, Met};
use super::curve::{Change, Outline, Path, Piece, Point, Run, Side, walk};
use crate::math::Vector;
use crate::math::roots::bracket::Sample;
use crate::math::roots::polynomial::turning_points;

/// A line is steep if it goes up at least so fast.
const STEEP: f64 = 0.125;

#[derive(Debug, Clone, PartialEq)]
pub struct Lathe {
    /// Its runs are closed, or begin and end on the axis; ρ is not negative.
    outline: Outline,
}

/// A line as the outline sees it.
struct Line {
    /// Across the axis.
    nearest: Point,
    direction: Point,
    /// z where s is 0, and its speed.
    start: f64,
    speed: f64,
    /// The speed across the axis.
    across: f64,
    /// How far rounding may move the line anywhere near the body, the outline's own rounding with it.
    off: f64,
}

impl Line {
    fn new(ray: &LocalRay) -> Self {
        let (n, d) = (ray.nearest, ray.direction);
        Self {
            nearest: [n.x, n.y],
            direction: [d.x, d.y],
            start: n.z,
            speed: d.z,
            across: (d.x * d.x + d.y * d.y).sqrt(),
            off: ray.blur_at(2.0) + 32.0 * U,
        }
    }

    /// dz times where the line is at the height z, across the axis.
    fn reached(&self, z: f64) -> Point {
        [0, 1].map(|i| self.direction[i] * (z - self.start) + self.nearest[i] * self.speed)
    }

    /// Where d²·(ρ² − x²) turns on a piece, with ρ the line's at the piece's height.
    fn turns(&self, piece: &Piece) -> SmallVec<[f64; 8]> {
        let (x, mut y) = (piece.powers(0), piece.powers(1));
        y[0] -= self.start;
        let ([n, m], [d, e]) = (self.nearest, self.direction);
        let linear = 2.0 * self.speed * (n * d + m * e);
        let mut values = [0.0; 7];
        for i in 0..4 {
            values[i] += linear * y[i];
            for j in 0..4 {
                values[i + j] +=
                    self.across * self.across * y[i] * y[j] - self.speed * self.speed * x[i] * x[j];
            }
        }
        turning_points(&values[..=2 * (piece.points().len() - 1)], 0.0, 1.0)
    }
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn length(a: Point) -> f64 {
    dot(a, a).sqrt()
}

/// A steep line: outside is what lies nearer to the axis.
struct Steep<'a>(&'a Line);

impl Side for Steep<'_> {
    /// With a = dz·(the line's place at the piece's height), f = |a| − |dz|·x.
    ///
    /// **Error:** what is farther than B from the branch is certain. The outside of the branch lies beyond its
    /// tangent: there, f over the length of its gradient is less than the distance. Inside, all around for B
    /// must be.
    fn sample(&self, piece: &Piece, u: f64) -> Sample {
        let Line { direction, speed, across, off, .. } = *self.0;
        let ([x, y], [x_speed, y_speed]) = piece.at(u);
        let reached = self.0.reached(y);
        let (a, dz) = (length(reached), speed.abs());
        let along = dot(reached, direction);
        let slope = if a > 0.0 { along / a } else { across };
        let value = a - dz * x;
        let error = if value > 0.0 {
            off * (dz * dz + slope * slope).sqrt()
        } else {
            let more = across * off * (across * off) + 2.0 * off * along.abs();
            more / ((a * a + more).sqrt() + a).max(f64::MIN_POSITIVE) + dz * off
        };
        Sample { value, slope: slope * y_speed - dz * x_speed, error: error + 4.0 * U * a }
    }

    fn of_all(&self, piece: &Piece) -> Option<bool> {
        let Line { speed, off, .. } = *self.0;
        let [low, high] = piece.hull();
        let (first, last) = (self.0.reached(low[1]), self.0.reached(high[1]));
        let way = [last[0] - first[0], last[1] - first[1]];
        let (before, behind) = (length(first), length(last));
        let is_between = dot(first, way) < 0.0 && dot(last, way) > 0.0;
        let least = match is_between {
            true => (first[0] * way[1] - first[1] * way[0]).abs() / length(way),
            false => before.min(behind),
        };
        match () {
            () if least - speed.abs() * high[0] > 2.0 * off => Some(true),
            () if speed.abs() * low[0] - before.max(behind) > 2.0 * off => Some(false),
            () => None,
        }
    }

    fn turns(&self, piece: &Piece) -> SmallVec<[f64; 8]> {
        self.0.turns(piece)
    }
}

/// One arm of a flat line, for ρ ≥ m: outside is what lies above it.
struct Arm<'a> {
    line: &'a Line,
    /// How near the line comes to the axis, where, and how high it is there.
    miss: f64,
    middle: f64,
    height: f64,
    /// 1 after the middle, −1 before.
    way: f64,
}

impl<'a> Arm<'a> {
    fn both(line: &'a Line) -> [Self; 2] {
        let ([n, m], [d, e]) = (line.nearest, line.direction);
        let miss = (n * e - m * d).abs() / line.across;
        let middle = -dot(line.nearest, line.direction) / (line.across * line.across);
        let height = line.start + middle * line.speed;
        [-1.0, 1.0].map(|way| Self { line, miss, middle, height, way })
    }

    /// How far from the middle the line is x from the axis.
    fn reach(&self, x: f64) -> f64 {
        ((x - self.miss) * (x + self.miss)).max(0.0).sqrt() / self.line.across
    }

    /// How much it rises from the middle to there.
    fn rise(&self, x: f64) -> f64 {
        self.line.speed * self.way * self.reach(x)
    }

    /// The parts of a run beyond ρ = m.
    fn paths<'o>(&self, outline: &'o Outline, run: &Run) -> SmallVec<[Path<'o>; 4]> {
        let whole = Path::whole(outline, run, None);
        let pieces = &outline.pieces[run.from..run.to];
        let beyond = |point: Point| point[0] > self.miss;
        let mut cuts: SmallVec<[f64; 8]> = SmallVec::new();
        for (number, piece) in pieces.iter().enumerate() {
            if beyond(piece.first()) != beyond(piece.last()) {
                cuts.push(number as f64 + piece.meets(0, self.miss));
            }
        }
        let Some(&first) = cuts.first() else {
            // A run that begins on the axis, and is nowhere beyond, is not met.
            let is_beyond = run.closed && beyond(pieces[0].first());
            return if is_beyond { SmallVec::from_iter([whole]) } else { SmallVec::new() };
        };
        if beyond(pieces[0].first()) {
            cuts.remove(0);
            cuts.push(first + pieces.len() as f64);
        }
        let end = |v: f64| whole.at(v).0[1] >= self.height;
        let part = |pair: &[f64]| whole.part(pair[0], pair[1], [end(pair[0]), end(pair[1])]);
        cuts.chunks_exact(2).map(part).collect()
    }

    /// **Error:** the reach of what the change lies within, B farther out and in; where it begins at the
    /// middle, that of the other arm too.
    fn wall(&self, change: &Change) -> (f64, f64) {
        let Line { across, off, .. } = *self.line;
        let here = self.reach(change.point()[0]);
        let least = change.places().map(|p| p[0]).fold(f64::INFINITY, f64::min);
        let most = change.places().map(|p| p[0]).fold(0.0, f64::max);
        let (near, far) = (self.reach(least - off), self.reach(most + off));
        let inner = if change.is_at_end() { here + far } else { here - near };
        let error = inner.max(far - here) + (2.0 * off + 8.0 * U * here) / across;
        (self.middle + self.way * here, error)
    }
}

impl Side for Arm<'_> {
    /// **Error:** it rises all the way, or falls: what is certain at both of the corners of a square of twice B
    /// is certain.
    fn sample(&self, piece: &Piece, u: f64) -> Sample {
        let ([x, y], [x_speed, y_speed]) = piece.at(u);
        let Line { across, speed, off, .. } = *self.line;
        let rise = self.rise(x);
        let value = y - self.height - rise;
        let outer = (value > 0.0) == (speed * self.way > 0.0);
        let beside = if outer { self.rise(x + off) } else { self.rise((x - off).max(0.0)) };
        let steepness = speed * self.way * x / (self.reach(x) * across * across);
        Sample { value, slope: y_speed - steepness * x_speed, error: off + (beside - rise).abs() }
    }

    fn of_all(&self, piece: &Piece) -> Option<bool> {
        let off = self.line.off;
        let [low, high] = piece.hull();
        let most = self.rise(high[0] + off).abs() + 4.0 * off;
        match () {
            () if low[1] - self.height > most => Some(true),
            () if self.height - high[1] > most => Some(false),
            () => None,
        }
    }

    fn turns(&self, piece: &Piece) -> SmallVec<[f64; 8]> {
        self.line.turns(piece)
    }
}

/// A crossing.
struct Wall {
    s: f64,
    error: f64,
    piece: usize,
    /// The line goes the way of the piece's normal.
    along: bool,
}

impl Wall {
    fn new(change: &Change, along: bool, (s, error): (f64, f64)) -> Self {
        Self { s, error, piece: change.path.piece(change.v), along }
    }
}

impl Lathe {
    /// Curves that are open or closed, in any order; ρ may be negative, and counts as if it were not. What is
    /// open is closed unseen: level with its ends, and upright where it is nearest to the axis. `None` where
    /// there is nothing of any size.
    ///
    /// **Source:** POV-Ray 3.7's behaviour, asked by `inside`.
    pub fn new(curves: impl IntoIterator<Item = Vec<Piece>>) -> Option<Self> {
        let runs: Vec<Vec<Piece>> = curves.into_iter().flat_map(parts_off_axis).collect();
        let places = || runs.iter().flatten().flat_map(|piece| [piece.first(), piece.last()]);
        let nearest = places().map(|[x, _]| x).fold(f64::INFINITY, f64::min);
        let mut outline = Outline::default();
        for mut run in runs {
            let (Some(first), Some(last)) = (run.first(), run.last()) else { continue };
            let (first, last) = (first.first(), last.last());
            let unseen = |from, to| Piece::line(from, to).unseen();
            let (inner_first, inner_last) = ([nearest, first[1]], [nearest, last[1]]);
            if first == last && first[0] > 0.0 {
                outline.add(run);
                continue;
            }
            run.push(unseen(last, inner_last));
            if nearest > 0.0 {
                run.push(unseen(inner_last, inner_first));
                run.push(unseen(inner_first, first));
            } else {
                run.insert(0, unseen(inner_first, first));
            }
            outline.add(run);
        }
        (!outline.pieces.is_empty()).then_some(Self { outline })
    }

    fn walls(&self, ray: &LocalRay) -> SmallVec<[Wall; 6]> {
        let line = Line::new(ray);
        let mut walls: SmallVec<[Wall; 6]> = SmallVec::new();
        if line.speed.abs() >= STEEP {
            for run in &self.outline.runs {
                let path = Path::whole(&self.outline, run, Some(true));
                walk(path, &Steep(&line), ray.tolerance, |change| {
                    let height = |point: Point| (point[1] - line.start) / line.speed;
                    let s = height(change.point());
                    let reach = change.places().map(|p| (height(p) - s).abs()).fold(0.0, f64::max);
                    let error = 1.25 * reach + 1.5 * line.off / line.speed.abs();
                    // The positive side is to the left of a line that goes up.
                    let along = change.rising != (line.speed > 0.0);
                    walls.push(Wall::new(&change, along, (s, error)));
                });
            }
        } else {
            for arm in Arm::both(&line) {
                for run in &self.outline.runs {
                    for path in arm.paths(&self.outline, run) {
                        walk(path, &arm, ray.tolerance, |change| {
                            // What is above is to the left of a line that goes away from the axis.
                            let along = change.rising != (arm.way > 0.0);
                            walls.push(Wall::new(&change, along, arm.wall(&change)));
                        });
                    }
                }
            }
        }
        walls.sort_by(|a, b| a.s.total_cmp(&b.s));
        walls
    }
}

/// A curve without what lies on the axis, turned to its positive side.
fn parts_off_axis(mut curve: Vec<Piece>) -> Vec<Vec<Piece>> {
    curve = curve.into_iter().flat_map(Piece::off_axis).collect();
    let is_closed = match (curve.first(), curve.last()) {
        (Some(first), Some(last)) => first.first() == last.last(),
        _ => false,
    };
    if is_closed && let Some(start) = curve.iter().position(|piece| piece.first()[0] == 0.0) {
        curve.rotate_left(start);
    }
    let mut runs = vec![Vec::new()];
    for piece in curve {
        let on_axis = piece.first()[0] == 0.0;
        match runs.last_mut() {
            Some(run) if !on_axis => run.push(piece),
            _ => runs.push(vec![piece]),
        }
        if piece.last()[0] == 0.0 {
            runs.push(Vec::new());
        }
    }
    runs.retain(|run| !run.is_empty());
    runs
}

impl Local for Lathe {
    fn crossings(&self, ray: &LocalRay, found: &mut Crossings) {
        for (number, wall) in self.walls(ray).into_iter().enumerate() {
            let leaving = number % 2 == 1;
            let piece = &self.outline.pieces[wall.piece];
            let part = match piece.seen {
                true => 2 * wall.piece as u32 + u32::from(wall.along != leaving),
                false => Met::UNSEEN,
            };
            found.push(Met { t: wall.s, error: wall.error, leaving, part });
        }
    }

    fn height(&self, part: u32, point: Vector) -> Height {
        let Some(piece) = self.outline.pieces.get(part as usize / 2) else {
            return Height { value: 0.0, gradient: Vector::Z, error: 0.0 };
        };
        let side = if part % 2 == 1 { -1.0 } else { 1.0 };
        let across = Vector::new(point.x, point.y, 0.0);
        let place = [across.length(), point.z];
        let (at, [a, b]) = piece.nearest(place);
        let off = a * (place[0] - at[0]) + b * (place[1] - at[1]);
        let gradient = across.normalize_or(Vector::ZERO) * a + Vector::Z * b;
        let gradient = if gradient == Vector::ZERO { Vector::Z } else { gradient };
        Height { value: side * off, gradient: gradient * side, error: 16.0 * U }
    }

    fn extent(&self, along: Vector) -> (f64, f64) {
        let across = Vector::new(along.x, along.y, 0.0).length();
        let greatest = |z: f64| self.outline.greatest([across, z]);
        (-greatest(-along.z), greatest(along.z))
    }

    fn is_iterated(&self) -> bool {
        true
    }

    fn price(&self) -> u64 {
        40 + 6 * self.outline.pieces.len() as u64
    }

    fn reach(&self) -> f64 {
        self.outline.reach()
    }

    fn numbers(&self) -> String {
        format!(" of {}", self.outline.pieces.iter().filter(|piece| piece.seen).count())
    }

    fn contains(&self, point: Vector) -> bool {
        let across = Vector::new(point.x, point.y, 0.0).length();
        self.outline.contains([across, point.z])
    }
}

#[cfg(test)]
impl Lathe {
    pub(super) fn outline(&self) -> &Outline {
        &self.outline
    }
}
