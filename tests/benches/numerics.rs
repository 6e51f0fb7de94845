//! What accuracy costs: each shape's kernel beside the formulas of a textbook, in `f32` and `f64`,
//! against crossings in 320 bits.
//!
//! `cargo bench --bench numerics` prints the table of `docs/numerics.md`. The naive kernels live
//! here only: the quadratic formula with the origin where it is, planes and slabs without bounds.

#[path = "../dice/mod.rs"]
#[allow(dead_code, reason = "more is drawn by the tests")]
mod dice;
#[path = "numerics/naive.rs"]
mod naive;
#[path = "../hard/wide.rs"]
#[allow(dead_code, reason = "more is computed by the tests")]
mod wide;

use std::hint::black_box;
use std::time::Instant;

use lucarne::math::placement::Placement;
use lucarne::math::{Matrix, UnitVector, Vector};
use lucarne::shape::{Box_, Chord, Crossing, Ellipsoid, Plane, Ray, Sphere};

use dice::Dice;
use naive::{V32, V64, double, single};
use wide::{Wide, WideVector};

/// Rays a row; a tenth of them are held against 320 bits.
const RAYS: usize = 20_000;
const TIMINGS: usize = 9;

fn v32(v: Vector) -> V32 {
    v.as_vec3().to_array()
}

fn v64(v: Vector) -> V64 {
    v.to_array()
}

/// A shape of size 1, about a place, and where a line enters it in 320 bits; none where it misses
/// or nearly touches.
trait Subject {
    const NAME: &str;
    fn new(dice: &mut Dice) -> Self;
    fn ours(&self, ray: &Ray) -> Option<Crossing>;
    fn single(&self, ray: &Rounded) -> Option<f32>;
    fn double(&self, ray: &Ray) -> Option<f64>;
    fn exact(&self, ray: &Ray) -> Answer;
    fn centre(&self) -> Vector;
    /// Of its surface, or near it.
    fn target(&self, dice: &mut Dice) -> Vector;
}

enum Answer {
    Enters(Wide),
    Misses,
    /// So near a touch that both answers are right.
    Either,
}

/// The same ray in `f32`.
struct Rounded {
    origin: V32,
    direction: V32,
}

fn wide(v: Vector) -> WideVector {
    WideVector::of(v.to_array())
}

/// Of the roots of a·t² + 2·b·t + c the first.
fn root(a: &Wide, b: &Wide, c: &Wide) -> Answer {
    let discriminant = b * b - &(a * c);
    let share = (discriminant.clone() / a).to_f64();
    if share.abs() < 1e-12 {
        Answer::Either
    } else if share < 0.0 {
        Answer::Misses
    } else {
        Answer::Enters((-&(discriminant.sqrt() + b)) / a)
    }
}

struct Ball(Sphere);

impl Subject for Ball {
    const NAME: &str = "sphere";
    fn new(dice: &mut Dice) -> Self {
        Self(Sphere { centre: dice.point(3.0), radius: 1.0 })
    }
    fn ours(&self, ray: &Ray) -> Option<Crossing> {
        self.0.chord(ray).map(|chord| chord.enter)
    }
    fn single(&self, ray: &Rounded) -> Option<f32> {
        let (centre, radius) = (v32(self.0.centre), self.0.radius as f32);
        single::sphere(ray.origin, ray.direction, centre, radius).map(|(t, _)| t)
    }
    fn double(&self, ray: &Ray) -> Option<f64> {
        let (s, d, c) = (v64(ray.origin), v64(ray.direction), v64(self.0.centre));
        double::sphere(s, d, c, self.0.radius).map(|(t, _)| t)
    }
    fn exact(&self, ray: &Ray) -> Answer {
        let f = wide(ray.origin).minus(&wide(self.0.centre));
        let d = wide(ray.direction);
        root(&d.square(), &f.dot(&d), &(f.square() - &Wide::one()))
    }
    fn centre(&self) -> Vector {
        self.0.centre
    }
    fn target(&self, dice: &mut Dice) -> Vector {
        self.0.centre + dice.direction() * dice.one_of(&[0.5, 1.0, 1.2])
    }
}

struct Floor(Plane, Vector);

impl Subject for Floor {
    const NAME: &str = "plane";
    fn new(dice: &mut Dice) -> Self {
        let (normal, centre) = (dice.direction(), dice.point(3.0));
        let normal = UnitVector::from_unit(normal);
        Self(Plane { normal, distance: normal.get().dot(centre) }, centre)
    }
    fn ours(&self, ray: &Ray) -> Option<Crossing> {
        let Chord { enter, leave } = self.0.chord(ray)?;
        Some(if enter.t.is_finite() { enter } else { leave })
    }
    fn single(&self, ray: &Rounded) -> Option<f32> {
        let normal = v32(self.0.normal.get());
        single::plane(ray.origin, ray.direction, normal, self.0.distance as f32)
    }
    fn double(&self, ray: &Ray) -> Option<f64> {
        let normal = v64(self.0.normal.get());
        double::plane(v64(ray.origin), v64(ray.direction), normal, self.0.distance)
    }
    fn exact(&self, ray: &Ray) -> Answer {
        let normal = wide(self.0.normal.get());
        let speed = normal.dot(&wide(ray.direction));
        if speed.to_f64().abs() < 1e-3 {
            return Answer::Either;
        }
        let inside = Wide::of(self.0.distance) - &normal.dot(&wide(ray.origin));
        Answer::Enters(inside / &speed)
    }
    fn centre(&self) -> Vector {
        self.1
    }
    fn target(&self, dice: &mut Dice) -> Vector {
        self.1 + dice.point(1.0)
    }
}

struct Block(Box_);

impl Subject for Block {
    const NAME: &str = "box";
    fn new(dice: &mut Dice) -> Self {
        let a = dice.direction();
        let b = UnitVector::from_direction(a.cross(dice.direction())).unwrap_or(UnitVector::Y);
        let c = UnitVector::from_unit(a.cross(b.get()).normalize());
        let normals = [UnitVector::from_unit(a), b, c];
        Self(Box_ { centre: dice.point(3.0), normals, half_widths: [1.0, 0.7, 0.4] })
    }
    fn ours(&self, ray: &Ray) -> Option<Crossing> {
        self.0.chord(ray).map(|chord| chord.enter)
    }
    fn single(&self, ray: &Rounded) -> Option<f32> {
        let normals = self.0.normals.map(|n| v32(n.get()));
        let half = self.0.half_widths.map(|l| l as f32);
        let centre = v32(self.0.centre);
        single::slabs(ray.origin, ray.direction, centre, &normals, half).map(|(t, _)| t)
    }
    fn double(&self, ray: &Ray) -> Option<f64> {
        let normals = self.0.normals.map(|n| v64(n.get()));
        let (s, d, c) = (v64(ray.origin), v64(ray.direction), v64(self.0.centre));
        double::slabs(s, d, c, &normals, self.0.half_widths).map(|(t, _)| t)
    }
    fn exact(&self, ray: &Ray) -> Answer {
        let f = wide(ray.origin).minus(&wide(self.0.centre));
        let mut ends: [Option<Wide>; 2] = [None, None];
        for (normal, half) in self.0.normals.iter().zip(self.0.half_widths) {
            let normal = wide(normal.get());
            let (place, speed) = (normal.dot(&f), normal.dot(&wide(ray.direction)));
            if speed.to_f64().abs() < 1e-6 {
                return Answer::Either;
            }
            let side = Wide::of(half.copysign(speed.to_f64()));
            let near = (-&(&side + &place)) / &speed;
            let far = (side - &place) / &speed;
            let [enter, leave] = &mut ends;
            if enter.as_ref().is_none_or(|enter| near > *enter) {
                *enter = Some(near);
            }
            if leave.as_ref().is_none_or(|leave| far < *leave) {
                *leave = Some(far);
            }
        }
        let [Some(enter), Some(leave)] = ends else { return Answer::Either };
        let chord = (leave - &enter).to_f64();
        if chord.abs() < 1e-6 {
            Answer::Either
        } else if chord < 0.0 {
            Answer::Misses
        } else {
            Answer::Enters(enter)
        }
    }
    fn centre(&self) -> Vector {
        self.0.centre
    }
    fn target(&self, dice: &mut Dice) -> Vector {
        self.0.centre + dice.direction() * dice.one_of(&[0.3, 0.7, 1.1])
    }
}

struct Egg(Ellipsoid, [[f64; 4]; 3]);

impl Subject for Egg {
    const NAME: &str = "ellipsoid";
    fn new(dice: &mut Dice) -> Self {
        let a = dice.direction();
        let b =
            UnitVector::from_direction(a.cross(dice.direction())).unwrap_or(UnitVector::Y).get();
        let turn = Matrix::from_cols(a, b, a.cross(b).normalize());
        let world_from_local = turn * Matrix::from_diagonal(Vector::new(1.0, 0.3, 0.1));
        let (centre, local_from_world) = (dice.point(3.0), world_from_local.inverse());
        let rows = local_from_world.transpose();
        let offset = local_from_world * -centre;
        let rows = [(rows.x_axis, offset.x), (rows.y_axis, offset.y), (rows.z_axis, offset.z)]
            .map(|(row, offset)| [row.x, row.y, row.z, offset]);
        Self(
            Ellipsoid { placement: Placement { centre, world_from_local, local_from_world } },
            rows,
        )
    }
    fn ours(&self, ray: &Ray) -> Option<Crossing> {
        self.0.chord(ray).map(|chord| chord.enter)
    }
    fn single(&self, ray: &Rounded) -> Option<f32> {
        let rows = self.1.map(|row| row.map(|c| c as f32));
        single::ellipsoid(ray.origin, ray.direction, &rows).map(|(t, _)| t)
    }
    fn double(&self, ray: &Ray) -> Option<f64> {
        double::ellipsoid(v64(ray.origin), v64(ray.direction), &self.1).map(|(t, _)| t)
    }
    fn exact(&self, ray: &Ray) -> Answer {
        let rows = self.0.placement.local_from_world.transpose();
        let rows = [rows.x_axis, rows.y_axis, rows.z_axis].map(wide);
        let local = |v: &WideVector| WideVector(rows.each_ref().map(|row| row.dot(v)));
        let f = local(&wide(ray.origin).minus(&wide(self.0.placement.centre)));
        let d = local(&wide(ray.direction));
        root(&d.square(), &f.dot(&d), &(f.square() - &Wide::one()))
    }
    fn centre(&self) -> Vector {
        self.0.placement.centre
    }
    fn target(&self, dice: &mut Dice) -> Vector {
        let reach = dice.one_of(&[0.5, 1.0, 1.2]);
        self.0.placement.centre + self.0.placement.world_from_local * (dice.direction() * reach)
    }
}

/// What one kernel did on one row.
#[derive(Default)]
struct Tally {
    wrong: usize,
    judged: usize,
    worst: f64,
}

impl Tally {
    fn add(&mut self, answer: &Answer, t: Option<f64>) {
        match (answer, t) {
            (Answer::Either, _) | (Answer::Misses, None) => {}
            (Answer::Enters(exact), Some(t)) if t.is_finite() => {
                self.worst = self.worst.max((exact - &Wide::of(t)).abs().to_f64());
            }
            (Answer::Enters(_), _) | (Answer::Misses, Some(_)) => self.wrong += 1,
        }
        self.judged += usize::from(!matches!(answer, Answer::Either));
    }

    fn cells(&self, nanoseconds: f64) -> String {
        let percent = 100.0 * self.wrong as f64 / self.judged as f64;
        let wrong = if self.wrong == 0 { "0".to_owned() } else { format!("{percent:.2} %") };
        format!("{wrong} | {:.0e} | {nanoseconds:.0}", self.worst)
    }
}

/// The least time a call, of several rounds in which all three take turns.
fn timed(rays: usize, kernels: &mut [&mut dyn FnMut() -> f64; 3]) -> [f64; 3] {
    let mut best = [f64::INFINITY; 3];
    for _ in 0..TIMINGS {
        for (kernel, best) in kernels.iter_mut().zip(&mut best) {
            let start = Instant::now();
            black_box(kernel());
            *best = best.min(start.elapsed().as_secs_f64() * 1e9 / rays as f64);
        }
    }
    best
}

fn row<S: Subject>(far: f64) {
    let mut dice = Dice(1);
    let subject = S::new(&mut dice);
    let rays: Vec<Ray> = (0..RAYS)
        .filter_map(|_| {
            let origin = subject.centre() + dice.direction() * far;
            let direction = UnitVector::from_direction(subject.target(&mut dice) - origin)?;
            Some(Ray { origin, direction: direction.get() })
        })
        .collect();
    let narrow: Vec<Rounded> = rays
        .iter()
        .map(|ray| Rounded { origin: v32(ray.origin), direction: v32(ray.direction) })
        .collect();
    let (mut single, mut double, mut ours) = (Tally::default(), Tally::default(), Tally::default());
    let (mut bound, mut share) = (0.0f64, 0.0f64);
    for (ray, narrow) in rays.iter().zip(&narrow).step_by(10) {
        let answer = subject.exact(ray);
        single.add(&answer, subject.single(narrow).map(f64::from));
        double.add(&answer, subject.double(ray));
        let found = subject.ours(ray);
        ours.add(&answer, found.map(|crossing| crossing.t));
        if let (Answer::Enters(exact), Some(crossing)) = (&answer, found) {
            let off = (exact - &Wide::of(crossing.t)).abs().to_f64();
            bound = bound.max(crossing.error);
            share = share.max(off / crossing.error);
        }
    }
    let times = timed(
        rays.len(),
        &mut [
            &mut || narrow.iter().filter_map(|ray| subject.single(ray)).map(f64::from).sum(),
            &mut || rays.iter().filter_map(|ray| subject.double(ray)).sum(),
            &mut || rays.iter().filter_map(|ray| subject.ours(ray)).map(|c| c.t + c.error).sum(),
        ],
    );
    println!(
        "| {} | {far:.0e} | {} | {} | {} | {bound:.0e} | {share:.2} |",
        S::NAME,
        single.cells(times[0]),
        double.cells(times[1]),
        ours.cells(times[2]),
    );
}

fn main() {
    println!(
        "| shape | sizes away | f32: wrong | error | ns | f64: wrong | error | ns | ours: wrong | error | ns | bound | greatest share of it |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|---|---|---|");
    const DISTANCES: [f64; 5] = [1e1, 1e3, 1e5, 1e6, 1e8];
    DISTANCES.iter().for_each(|&far| row::<Ball>(far));
    DISTANCES.iter().for_each(|&far| row::<Floor>(far));
    DISTANCES.iter().for_each(|&far| row::<Block>(far));
    DISTANCES.iter().for_each(|&far| row::<Egg>(far));
}
