//! What accuracy costs: each kernel beside the formulas of a textbook, in `f32` and `f64`, against
//! 320 bits.
//!
//! `cargo bench --bench numerics` prints the table of `docs/numerics.md`, as it stands there; with names of
//! rows behind `--`, those alone. The
//! naive kernels live here only: the quadratic formula with the origin where it is, planes and slabs
//! without bounds, sines of degrees times π/180.

#[path = "numerics/bodies.rs"]
mod bodies;
#[path = "../dice/mod.rs"]
#[allow(dead_code, reason = "more is drawn by the tests")]
mod dice;
#[path = "numerics/fields.rs"]
mod fields;
#[path = "numerics/naive.rs"]
mod naive;
#[path = "numerics/points.rs"]
mod points;
#[path = "numerics/rows.rs"]
mod rows;
#[path = "numerics/sturm.rs"]
mod sturm;
#[path = "numerics/subjects.rs"]
mod subjects;
#[path = "../hard/wide.rs"]
#[allow(dead_code, reason = "more is computed by the tests")]
mod wide;

use std::f64::consts::PI;
use std::hint::black_box;
use std::time::Instant;

use lucarne::math::elementary::sin_cos_degrees;
use lucarne::shape::{Crossing, Ray};

use bodies::{Bar, Globe, Quadric, Ring, Stands, Stump, Triangle, Washer};
use dice::Dice;
use fields::{
    Bone, Heart, Marched, Metaballs, Oval, Pillow, Rabbit, Spindle, Straight, Tube, Vase,
};
use points::{Hill, Landscape, Letter, Star};
use subjects::{Answer, Ball, Block, Carved, Egg, Floor, Planet, Rounded, Subject};
use wide::Wide;

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

    /// What is wrong, and the greatest error of what is not.
    fn cells(&self) -> String {
        let percent = 100.0 * self.wrong as f64 / self.judged as f64;
        let wrong = if self.wrong == 0 { "0".to_owned() } else { format!("{percent:.2} %") };
        format!("{wrong} | {:.0e}", self.worst)
    }
}

/// Where a kernel puts the crossing of a ray, given by its number, or the sine of an angle.
struct Kernels<Narrow, Double, Ours> {
    single: Narrow,
    double: Double,
    ours: Ours,
}

impl<Narrow, Double, Ours> Kernels<Narrow, Double, Ours>
where
    Narrow: Fn(usize) -> Option<f32>,
    Double: Fn(usize) -> Option<f64>,
    Ours: Fn(usize) -> Option<Crossing>,
{
    /// Prints a row.
    fn measure(
        &self,
        (name, far): (&str, f64),
        (count, rounds): (usize, usize),
        exact: impl Fn(usize) -> Answer,
    ) {
        let (mut single, mut double, mut ours) =
            (Tally::default(), Tally::default(), Tally::default());
        let (mut bound, mut share) = (0.0f64, 0.0f64);
        for ray in 0..count {
            let answer = exact(ray);
            single.add(&answer, (self.single)(ray).map(f64::from));
            double.add(&answer, (self.double)(ray));
            let found = (self.ours)(ray);
            ours.add(&answer, found.map(|crossing| crossing.t));
            if let (Answer::Enters(exact), Some(crossing)) = (&answer, found) {
                let off = (exact - &Wide::of(crossing.t)).abs().to_f64();
                bound = bound.max(crossing.error);
                share = share.max(off / crossing.error);
            }
        }
        let [one, two, three] = self.timed(count, rounds);
        println!(
            "| {name} | {far:.0e} | {} | {one:.1} | {} | {two:.1} | {} | {bound:.0e} | {share:.2} | {three:.1} | {:.1} |",
            single.cells(),
            double.cells(),
            ours.cells(),
            three / two,
        );
    }

    /// The least time a call, of all rounds.
    fn timed(&self, count: usize, rounds: usize) -> [f64; 3] {
        let mut best = [f64::INFINITY; 3];
        let rays = || 0..black_box(count);
        let sums: [&dyn Fn() -> f64; 3] = [
            &|| rays().filter_map(&self.single).map(f64::from).sum(),
            &|| rays().filter_map(&self.double).sum(),
            &|| rays().filter_map(&self.ours).map(|crossing| crossing.t + crossing.error).sum(),
        ];
        for _ in 0..rounds {
            for (sum, best) in sums.iter().zip(&mut best) {
                let start = Instant::now();
                black_box(sum());
                *best = best.min(start.elapsed().as_secs_f64() * 1e9 / count as f64);
            }
        }
        best
    }
}

fn shape<S: Subject>(name: &str, far: f64) {
    let mut dice = Dice(1);
    let subject = S::new(&mut dice, far);
    let rays: Vec<Ray> = (0..S::RAYS).filter_map(|_| subject.ray(&mut dice, far)).collect();
    let narrow: Vec<Rounded> = rays.iter().map(Rounded::of).collect();
    let kernels = Kernels {
        single: |ray: usize| subject.single(&narrow[ray]),
        double: |ray: usize| subject.double(&rays[ray]),
        ours: |ray: usize| subject.ours(&rays[ray]),
    };
    kernels.measure((name, far), (rays.len(), S::ROUNDS), |ray| subject.exact(&rays[ray]));
}

/// Of up to `far` degrees.
fn sine(name: &str, far: f64) {
    const RAYS: usize = 20_000;
    let mut dice = Dice(1);
    let degrees: Vec<f64> = (0..RAYS).map(|_| dice.between(-far, far)).collect();
    let narrow: Vec<f32> = degrees.iter().map(|&degrees| degrees as f32).collect();
    // One unit in the last place, and the angle's rounding: below 1 both.
    let error = 1.5 * f64::EPSILON;
    let kernels = Kernels {
        single: |i: usize| Some((narrow[i] * (PI as f32 / 180.0)).sin()),
        double: |i: usize| Some((degrees[i] * (PI / 180.0)).sin()),
        ours: |i: usize| Some(Crossing { t: sin_cos_degrees(degrees[i]).0, error }),
    };
    let exact = |i: usize| Answer::Enters(Wide::of(degrees[i]).sin_cos().0);
    kernels.measure((name, far), (RAYS, 101), exact);
}

fn main() {
    println!("{}", rows::HEADER);
    println!("|{}", "---|".repeat(rows::HEADER.matches('|').count() - 1));
    let asked: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with('-')).collect();
    let is_asked = |name: &str| asked.is_empty() || asked.iter().any(|one| one == name);
    for (name, distances) in rows::ROWS.into_iter().filter(|(name, _)| is_asked(name)) {
        for &far in distances {
            match name {
                rows::SPHERE => shape::<Ball>(name, far),
                rows::PLANET => shape::<Planet>(name, far),
                rows::PLANE => shape::<Floor>(name, far),
                rows::BOX => shape::<Block>(name, far),
                rows::ELLIPSOID => shape::<Egg>(name, far),
                rows::CYLINDER => shape::<Stands<Bar>>(name, far),
                rows::CONE => shape::<Stands<Stump>>(name, far),
                rows::TORUS => shape::<Stands<Ring>>(name, far),
                rows::QUADRIC => shape::<Stands<Quadric>>(name, far),
                rows::POLYNOMIAL => shape::<Stands<Marched<Heart>>>(name, far),
                rows::MESH => shape::<Stands<Triangle>>(name, far),
                rows::POLYGON => shape::<Stands<Star>>(name, far),
                rows::BICUBIC_PATCH => shape::<Stands<Hill>>(name, far),
                rows::HEIGHT_FIELD => shape::<Stands<Landscape>>(name, far),
                rows::TEXT => shape::<Stands<Letter>>(name, far),
                rows::DISC => shape::<Stands<Washer>>(name, far),
                rows::PRISM => shape::<Stands<Straight>>(name, far),
                rows::LATHE => shape::<Stands<Marched<Vase>>>(name, far),
                rows::SOR => shape::<Stands<Marched<Spindle>>>(name, far),
                rows::OVUS => shape::<Stands<Marched<Oval>>>(name, far),
                rows::BLOB => shape::<Stands<Marched<Metaballs>>>(name, far),
                rows::SPHERE_SWEEP => shape::<Stands<Marched<Bone>>>(name, far),
                rows::SUPERELLIPSOID => shape::<Stands<Marched<Pillow>>>(name, far),
                rows::ISOSURFACE => shape::<Stands<Marched<Tube>>>(name, far),
                rows::JULIA_FRACTAL => shape::<Stands<Marched<Rabbit>>>(name, far),
                rows::PARAMETRIC => shape::<Stands<Globe>>(name, far),
                rows::WHOLE => shape::<Carved>(name, far),
                rows::SINE => sine(name, far),
                other => unreachable!("no such row: {other}"),
            }
        }
    }
}
