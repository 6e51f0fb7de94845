//! Lathe: in local space, all points whose distance ρ from the z axis and height z lie inside an outline, by
//! the even-odd rule.
//!
//! In the plane of ρ and z, a line is one branch of a hyperbola, ρ² = m² + e²(s − sₘ)². A steep line is
//! intersected with the outline as one branch. The two arms of a flat line are close together: each is
//! intersected separately. The outline is cut where the arms begin, at ρ = m, so that both have the same
//! ends.

mod isolated;
mod level;
mod line;

use smallvec::SmallVec;

use super::curve::{Change, Outline, Path, Piece, Point, walk};
use super::local::{Crossings, Height, Local, LocalRay, Met};
use super::{Memory, U};
use crate::math::Vector;
use isolated::Squares;
use level::{Beside, Passage, beside, moved};
use line::{Arm, Line, STEEP, Steep};

/// Cosine below which the line's direction relative to the surface cannot be determined from the normal at
/// one point.
const GRAZING: f64 = 1e-6;

/// The points whose distance from the z axis and height lie inside an outline, in local space.
#[derive(Debug, Clone, PartialEq)]
pub struct Lathe {
    /// Its runs are closed, or begin and end on the axis; ρ is not negative.
    outline: Outline,
    /// One for each piece.
    squares: Memory<Vec<Squares>>,
}

/// A crossing with a piece of the outline.
struct Wall {
    s: f64,
    error: f64,
    piece: usize,
    /// Whether the line goes in the direction of the piece's normal.
    along: bool,
    /// Direction of its arm, if the crossing may lie where the arms begin; else 0.
    begins: f64,
}

type Walls = SmallVec<[Wall; 6]>;

impl Wall {
    fn new(change: &Change, along: bool, (s, error): (f64, f64)) -> Self {
        Self { s, error, piece: change.piece, along, begins: 0.0 }
    }
}

impl Lathe {
    /// Builds a lathe from open or closed curves, in any order; a negative ρ counts as its absolute value.
    /// Open curves are closed by invisible pieces: horizontal at their ends, and vertical at the smallest ρ
    /// of all curves. `None` if nothing has any extent.
    ///
    /// **Source:** behaviour of POV-Ray 3.7, measured with `inside`.
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
        let squares = Memory(outline.pieces.iter().map(Squares::new).collect());
        (!outline.pieces.is_empty()).then_some(Self { outline, squares })
    }

    fn walls(&self, ray: &LocalRay, range: (f64, f64)) -> Walls {
        let line = Line::new(ray);
        let mut walls = self.isolated(&line, ray, range).unwrap_or_else(|| self.walked(line, ray));
        walls.sort_by(|a, b| a.s.total_cmp(&b.s));
        drop_touches(&mut walls);
        walls
    }

    /// Returns the crossings, in any order.
    #[cold]
    fn walked(&self, line: Line, ray: &LocalRay) -> Walls {
        let mut walls = Walls::new();
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
            match beside(line, &self.outline, ray) {
                Beside::Whole(line) => walls = self.walls_of_flat(&line, ray),
                Beside::Parted { before, passage, behind } => {
                    let is_before = |wall: &Wall| wall.s < passage.s;
                    let [first, then] = [before, behind].map(|line| self.walls_of_flat(&line, ray));
                    let (before, late): (Walls, Walls) = first.into_iter().partition(is_before);
                    let (early, behind): (Walls, Walls) = then.into_iter().partition(is_before);
                    if (before.len() + behind.len()) % 2 == 1 {
                        let end = self.end_at(&passage, ray);
                        // Where there is no end, the line goes through a wall, as high as the end.
                        let off = |wall: &Wall| (wall.s - passage.s).abs();
                        let others = late.into_iter().chain(early);
                        let nearest = others.min_by(|a, b| off(a).total_cmp(&off(b)));
                        walls.extend(end.or(nearest));
                    }
                    walls.extend(before.into_iter().chain(behind));
                }
            }
        }
        walls
    }

    fn walls_of_flat(&self, line: &Line, ray: &LocalRay) -> Walls {
        let mut walls = Walls::new();
        let arms = Arm::both(line);
        if arms.iter().all(|arm| arm.misses(&self.outline.hull())) {
            return walls;
        }
        for arm in arms {
            for run in &self.outline.runs {
                for path in arm.paths(&self.outline, run) {
                    walk(path, &arm, ray.tolerance, |change| {
                        // What is above is to the left of a line that goes away from the axis.
                        let along = change.rising != (arm.way > 0.0);
                        let begins = if arm.may_begin_at(&change) { arm.way } else { 0.0 };
                        walls.push(Wall { begins, ..Wall::new(&change, along, arm.wall(&change)) });
                    });
                }
            }
        }
        if line.raised != 0.0 {
            for wall in &mut walls {
                let height = self.height(part_of(wall.piece, true), ray.at(wall.s));
                wall.error += moved(line, height, ray.direction);
            }
        }
        walls
    }

    /// Returns the horizontal end that a line passes through.
    fn end_at(&self, passage: &Passage, ray: &LocalRay) -> Option<Wall> {
        let Passage { s, error, height, rises } = *passage;
        let point = ray.at(s);
        let out = Vector::new(point.x, point.y, 0.0).length();
        let room = 2.0 * error + 16.0 * U;
        let is_there = |piece: &Piece| {
            let [a, b] = [piece.first()[0], piece.last()[0]];
            a.min(b) - room <= out && out <= a.max(b) + room
        };
        let mut pieces = self.outline.pieces.iter();
        let piece = pieces.position(|one| one.level() == Some(height) && is_there(one))?;
        let (_, [_, up]) = self.outline.pieces[piece].nearest([out, height]);
        Some(Wall { s, error, piece, along: (up > 0.0) == rises, begins: 0.0 })
    }
}

/// Drops pairs of crossings of both arms right where the arms begin, within rounding: the line may only touch
/// the surface, as at a tip or beside a vertical wall.
fn drop_touches(walls: &mut Walls) {
    let mut at = 0;
    while let Some([one, other]) = walls.get(at..at + 2) {
        if one.begins * other.begins < 0.0 && other.s - one.s <= one.error + other.error {
            walls.drain(at..at + 2);
            at = at.saturating_sub(1);
        } else {
            at += 1;
        }
    }
}

/// Returns the runs of a curve that are off the axis, mirrored to positive ρ.
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

/// Part number of a piece's outside, or of the same surface seen from within.
fn part_of(piece: usize, is_outside: bool) -> u32 {
    2 * piece as u32 + u32::from(!is_outside)
}

impl Local for Lathe {
    fn crossings(&self, ray: &LocalRay, found: &mut Crossings) {
        self.first_crossings(ray, (f64::NEG_INFINITY, f64::INFINITY), found);
    }

    fn first_crossings(&self, ray: &LocalRay, range: (f64, f64), found: &mut Crossings) {
        for (number, wall) in self.walls(ray, range).into_iter().enumerate() {
            let leaving = number % 2 == 1;
            let piece = &self.outline.pieces[wall.piece];
            let part = match piece.seen {
                true => part_of(wall.piece, wall.along == leaving),
                false => Met::UNSEEN,
            };
            found.push(Met { t: wall.s, error: wall.error, leaving, part });
        }
    }

    /// Known where the point is certainly on a single piece.
    fn part_at(&self, ray: &LocalRay, s: f64, leaving: bool) -> Option<u32> {
        let point = ray.at(s);
        let off = 64.0 * (ray.blur_at(s) + U * (1.0 + s.abs())) + 2.0 * ray.tolerance;
        let across = Vector::new(point.x, point.y, 0.0);
        let place = [across.length(), point.z];
        let piece = self.outline.piece_at(place, off)?;
        let (_, [a, b]) = self.outline.pieces[piece].nearest(place);
        let slope = (across * (a / place[0]) + Vector::Z * b).dot(ray.direction);
        // As the place, so the normal may be off: the more, the nearer the axis and the sharper the bend.
        let doubt = GRAZING.max(off.sqrt());
        let is_told = place[0] > doubt && slope.abs() > 2.0 * doubt;
        (is_told && self.outline.pieces[piece].seen)
            .then(|| part_of(piece, (slope > 0.0) == leaving))
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
