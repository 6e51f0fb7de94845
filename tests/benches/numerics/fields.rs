//! Bodies that a number at each place tells: as they are written, marched through as anybody would, and in 320
//! bits.
//!
//! **Invariant:** one formula serves all three: negative inside, positive outside.

use std::marker::PhantomData;
use std::ops::{Add, Div, Mul, Sub};
use std::sync::Arc;

use lucarne::function::{Binary, Builder, TooLong, Unary};
use lucarne::math::double::Double;
use lucarne::math::terms::exponents;
use lucarne::math::{Matrix, Vector};
use lucarne::shape::curve::{Outline, Piece, Point};
use lucarne::shape::isosurface::Container;
use lucarne::shape::julia_fractal::Algebra;
use lucarne::shape::{
    Algebraic, Blob, Body, Isosurface, JuliaFractal, Lathe, Memory, Ovus, Prism, Sor, SphereSweep,
    Superellipsoid, blob, sor, sphere_sweep,
};
use lucarne::texture::Closed;

use crate::bodies::Form;
use crate::naive::{V32, V64, double, single};
use crate::subjects::Answer;
use crate::wide::{Wide, WideVector};

/// `f32`, `f64`, or 320 bits.
pub trait Number:
    Clone
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
{
    fn of(value: f64) -> Self;
    fn sqrt(self) -> Self;

    fn square(self) -> Self {
        self.clone() * self
    }
    fn abs(self) -> Self {
        let minus = Self::of(0.0) - self.clone();
        if minus > self { minus } else { self }
    }
    fn max(self, other: Self) -> Self {
        if other > self { other } else { self }
    }
    fn min(self, other: Self) -> Self {
        if other < self { other } else { self }
    }
}

impl Number for f32 {
    fn of(value: f64) -> Self {
        value as f32
    }
    fn sqrt(self) -> Self {
        self.sqrt()
    }
}

impl Number for f64 {
    fn of(value: f64) -> Self {
        value
    }
    fn sqrt(self) -> Self {
        self.sqrt()
    }
}

impl Number for Wide {
    fn of(value: f64) -> Self {
        Self::of(value)
    }
    fn sqrt(self) -> Self {
        Self::sqrt(&self)
    }
}

fn minus<N: Number>(a: &[N; 3], b: [f64; 3]) -> [N; 3] {
    std::array::from_fn(|i| a[i].clone() - N::of(b[i]))
}

fn dot<N: Number>([a, b, c]: [N; 3], [x, y, z]: [N; 3]) -> N {
    a * x + b * y + c * z
}

fn length<N: Number>(a: N, b: N) -> N {
    (a.square() + b.square()).sqrt()
}

/// What a place's number says.
pub trait Field {
    /// No farther from the origin.
    const REACH: f64;
    fn body() -> Option<Body>;
    /// About the distance, near the surface.
    fn value<N: Number>(p: &[N; 3]) -> N;
}

/// The steps of a march through the ball that holds the body, and the halvings at its end.
const STEPS: usize = 64;
const HALVINGS: usize = 40;

macro_rules! march {
    ($name:ident, $real:ident, $module:ident) => {
        fn $name<F: Field>(f: [$real; 3], d: [$real; 3]) -> Option<$real> {
            use crate::naive::$module::{dot, quadratic};
            let reach = F::REACH as $real;
            let (first, last) = quadratic(dot(d, d), 2.0 * dot(f, d), dot(f, f) - reach * reach)?;
            let value = |t: $real| F::value(&[f[0] + t * d[0], f[1] + t * d[1], f[2] + t * d[2]]);
            let step = (last - first) / STEPS as $real;
            let inside = (1..STEPS).map(|i| first + step * i as $real).find(|t| value(*t) < 0.0)?;
            let (mut low, mut high) = (inside - step, inside);
            for _ in 0..HALVINGS {
                let middle = 0.5 * (low + high);
                if value(middle) < 0.0 {
                    high = middle;
                } else {
                    low = middle;
                }
            }
            Some(0.5 * (low + high))
        }
    };
}

march!(march_single, f32, single);
march!(march_double, f64, double);

/// A look at the line: so many places; where the number is below this without a change of sign, both
/// answers are right.
const LOOKS: usize = 4096;
const NEAR: f64 = 1e-3;

/// Where a line enters: looked for in `f64` along the line as it is nearest to the origin, found in 320 bits.
fn entered<F: Field>(f: &WideVector, d: &WideVector) -> Answer {
    let middle = (-&f.dot(d)) / &d.square();
    let speed = d.length();
    let (nearest, way) = (f.plus(&d.times(&middle)), d.unit());
    let narrow = |v: &WideVector| v.0.each_ref().map(Wide::to_f64);
    let (p, w) = (narrow(&nearest), narrow(&way));
    let value = |s: f64| F::value(&[p[0] + s * w[0], p[1] + s * w[1], p[2] + s * w[2]]);
    let step = 2.0 * F::REACH / LOOKS as f64;
    let place = |i: usize| i as f64 * step - F::REACH;
    let looks: Vec<f64> = (0..=LOOKS).map(|i| value(place(i))).collect();
    let inside = looks.iter().position(|look| *look < 0.0);
    let before = &looks[..inside.unwrap_or(looks.len())];
    let dips = |w: &[f64]| w[1] < NEAR && w[1] <= w[0] && w[1] <= w[2];
    if before.windows(3).any(dips) {
        return Answer::Either;
    }
    let Some(inside) = inside else { return Answer::Misses };
    let depth = looks[inside..].iter().take_while(|look| **look < 0.0).copied();
    if depth.fold(0.0, f64::min) > -NEAR {
        return Answer::Either;
    }
    let (mut low, mut high) = (place(inside) - step, place(inside));
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        *(if value(middle) < 0.0 { &mut high } else { &mut low }) = middle;
    }
    let exactly = |s: &Wide| F::value(&nearest.plus(&way.times(s)).0);
    // By secants: each has about as many digits more as the one before has.
    let (mut a, mut b) = (Wide::of(low - 1e-9), Wide::of(high + 1e-9));
    let (mut at_a, mut at_b) = (exactly(&a), exactly(&b));
    for _ in 0..8 {
        let slope = &at_b - &at_a;
        if slope.is_zero() {
            break;
        }
        let next = &b - &((&b - &a) * &at_b / &slope);
        (a, at_a) = (b, at_b);
        (b, at_b) = (next.clone(), exactly(&next));
    }
    Answer::Enters(middle + &(b / &speed))
}

/// A body as its field tells.
pub struct Marched<F>(PhantomData<F>);

impl<F: Field> Form for Marched<F> {
    const RAYS: usize = 2_000;
    const ROUNDS: usize = 21;

    fn body() -> Option<Body> {
        F::body()
    }
    fn single(f: V32, d: V32) -> Option<f32> {
        march_single::<F>(f, d)
    }
    fn double(f: V64, d: V64) -> Option<f64> {
        march_double::<F>(f, d)
    }
    fn exact(f: &WideVector, d: &WideVector) -> Answer {
        entered::<F>(f, d)
    }
}

/// (x² + 9/4·y² + z² − 1)³ = x²z³ + y²z³/8: G. Taubin's heart, nearly.
pub struct Heart;

impl Field for Heart {
    const REACH: f64 = 1.5;

    fn body() -> Option<Body> {
        let factorial = |n: usize| (1..=n).product::<usize>() as f64;
        let term = |[i, j, k]: [usize; 3]| match [i, j, k] {
            [2, 0, 3] => -1.0,
            [0, 2, 3] => -0.125,
            _ if i % 2 + j % 2 + k % 2 > 0 => 0.0,
            _ => {
                let rest = 3 - (i + j + k) / 2;
                let ways = [i / 2, j / 2, k / 2, rest].map(factorial).iter().product::<f64>();
                let sign = if rest % 2 == 0 { 1.0 } else { -1.0 };
                sign * 6.0 / ways * (0..j / 2).fold(1.0, |power, _| power * 2.25)
            }
        };
        Algebraic::new(6, exponents(6).map(term).collect()).map(Body::Algebraic)
    }
    fn value<N: Number>([x, y, z]: &[N; 3]) -> N {
        let [xx, yy, zz] = [x, y, z].map(|c| c.clone().square());
        let sum = xx.clone() + N::of(2.25) * yy.clone() + zz.clone() - N::of(1.0);
        sum.clone() * sum.clone() * sum - (xx + N::of(0.125) * yy) * zz * z.clone()
    }
}

/// Centre, thickness, strength, and half of the length in thicknesses.
const COMPONENTS: [([f64; 3], f64, f64, f64); 3] = [
    ([-0.375, 0.25, 0.0], 0.5, 2.0, 0.0),
    ([0.25, 0.0, 0.125], 0.25, 2.5, 2.0),
    ([-0.125, 0.0, 0.375], 0.5, -1.0, 0.0),
];

pub struct Metaballs;

impl Field for Metaballs {
    const REACH: f64 = 1.0;

    fn body() -> Option<Body> {
        let component =
            |(centre, thick, strength, half): ([f64; 3], f64, f64, f64)| blob::Component {
                strength,
                centre: Vector::from_array(centre),
                half,
                blob_from_unit: Matrix::from_diagonal(Vector::splat(thick)),
                unit_from_blob: Matrix::from_diagonal(Vector::splat(1.0 / thick)),
            };
        Blob::new(COMPONENTS.map(component).to_vec()).map(Body::Blob)
    }
    fn value<N: Number>(p: &[N; 3]) -> N {
        let field = |(centre, thick, strength, half): ([f64; 3], f64, f64, f64)| {
            let [x, y, z] = minus(p, centre).map(|c| c / N::of(thick));
            let over = (z.abs() - N::of(half)).max(N::of(0.0));
            let inner = N::of(1.0) - x.square() - y.square() - over.square();
            N::of(strength) * inner.max(N::of(0.0)).square()
        };
        COMPONENTS.into_iter().map(field).fold(N::of(1.0), |rest, field| rest - field)
    }
}

/// Of radius `MAJOR`, and as thick as twice `MINOR`.
pub struct Tube;

const MAJOR: f64 = 0.75;
const MINOR: f64 = 0.25;

fn tube() -> Result<Closed, TooLong> {
    let mut f = Builder::new(3)?;
    let axes = [0, 1, 2].map(|axis| f.parameter(axis).ok_or(TooLong));
    let [x, y, z] = axes;
    let squares = [f.unary(Unary::Square, x?)?, f.unary(Unary::Square, y?)?];
    let sum = f.binary(Binary::Add, squares[0], squares[1])?;
    let (across, major) = (f.unary(Unary::Sqrt, sum)?, f.constant(MAJOR)?);
    let off = f.binary(Binary::Subtract, across, major)?;
    let squares = [f.unary(Unary::Square, off)?, f.unary(Unary::Square, z?)?];
    let sum = f.binary(Binary::Add, squares[0], squares[1])?;
    let (height, minor) = (f.unary(Unary::Sqrt, sum)?, f.constant(MINOR)?);
    let value = f.binary(Binary::Subtract, height, minor)?;
    Ok(Closed::new(f.finish(value), |_| None).expect("asks nothing"))
}

impl Field for Tube {
    const REACH: f64 = 1.25;

    fn body() -> Option<Body> {
        Some(Body::Isosurface(Isosurface {
            function: Arc::new(tube().ok()?),
            threshold: 0.0,
            container: Container::Box(Vector::splat(1.125)),
            centre: Vector::ZERO,
            scale: 1.0,
            accuracy: 1e-3,
            open: false,
            cells: Memory::default(),
        }))
    }
    fn value<N: Number>([x, y, z]: &[N; 3]) -> N {
        let off = length(x.clone(), y.clone()) - N::of(MAJOR);
        length(off, z.clone()) - N::of(MINOR)
    }
}

/// From the bottom to the top, and back along the axis.
const PROFILE: [Point; 3] = [[0.25, -1.0], [1.0, -0.25], [0.375, 1.0]];

pub struct Vase;

impl Field for Vase {
    const REACH: f64 = 1.25;

    fn body() -> Option<Body> {
        let [first, _, last] = PROFILE;
        let base = Piece::line([0.0, first[1]], first);
        let lid = Piece::line(last, [0.0, last[1]]);
        Lathe::new([vec![base, Piece::bezier(&PROFILE)?, lid]]).map(Body::Lathe)
    }
    fn value<N: Number>([x, y, z]: &[N; 3]) -> N {
        // The height is −1 + 1.5u + u²/2, the radius 0.25 + 1.5u − 1.375u².
        let height = z.clone() + N::of(1.0);
        let u = (N::of(2.25) + N::of(2.0) * height).max(N::of(0.0)).sqrt() - N::of(1.5);
        let radius = N::of(0.25) + N::of(1.5) * u.clone() - N::of(1.375) * u.square();
        let side = length(x.clone(), y.clone()) - radius;
        side.max(z.clone().abs() - N::of(1.0))
    }
}

/// The squares of a radius, by their Bézier points.
const SQUARES: [f64; 4] = [0.25, 1.0, 0.0, 0.375];

pub struct Spindle;

impl Field for Spindle {
    const REACH: f64 = 1.25;

    fn body() -> Option<Body> {
        let segment = sor::Segment { low: -1.0, high: 1.0, squares: SQUARES };
        Sor::new(vec![segment], false).map(Body::Sor)
    }
    fn value<N: Number>([x, y, z]: &[N; 3]) -> N {
        let t = (z.clone() + N::of(1.0)) * N::of(0.5);
        let mut points = SQUARES.map(N::of).to_vec();
        while points.len() > 1 {
            let mix = |pair: &[N]| {
                (N::of(1.0) - t.clone()) * pair[0].clone() + t.clone() * pair[1].clone()
            };
            points = points.windows(2).map(mix).collect();
        }
        let side = x.clone().square() + y.clone().square() - points.remove(0);
        side.max(z.clone().abs() - N::of(1.0))
    }
}

/// The radii of the balls; the arc's is 3/2, its centre at z = −1/6 and √(5/4)/(3/2) beyond the axis.
const BALLS: [f64; 2] = [0.75, 0.5];

pub struct Oval;

impl Field for Oval {
    const REACH: f64 = 1.0;

    fn body() -> Option<Body> {
        let [bottom, top] = BALLS.map(Double::from);
        Some(Body::Ovus(Ovus::new(bottom, top)))
    }
    fn value<N: Number>([x, y, z]: &[N; 3]) -> N {
        let [bottom, top] = BALLS;
        let across = length(x.clone(), y.clone());
        let (beyond, centre) = (N::of(1.25).sqrt() / N::of(1.5), N::of(-1.0) / N::of(6.0));
        let (out, up) = (across.clone() + beyond.clone(), z.clone() - centre.clone());
        let ball = |middle: f64, radius: f64| {
            length(across.clone(), z.clone() - N::of(middle)) - N::of(radius)
        };
        // From the arc's centre, the balls' middles lie in these directions.
        let slope = |middle: f64| (N::of(middle) - centre.clone()) / beyond.clone();
        let (low, high) = (bottom - 1.0, 1.0 - top);
        if up < slope(low) * out.clone() {
            ball(low, bottom)
        } else if up > slope(high) * out.clone() {
            ball(high, top)
        } else {
            length(out, up) - N::of(1.5)
        }
    }
}

/// An outline of straight pieces, dented.
const CORNERS: [Point; 5] =
    [[-0.75, -0.5], [0.75, -0.625], [0.25, 0.0], [0.625, 0.75], [-0.5, 0.625]];
const HEIGHTS: [f64; 2] = [-0.5, 0.75];

struct Slab;

impl Field for Slab {
    const REACH: f64 = 1.5;

    fn body() -> Option<Body> {
        let mut outline = Outline::default();
        outline.add((0..5).map(|i| Piece::line(CORNERS[i], CORNERS[(i + 1) % 5])));
        Some(Body::Prism(Prism { outline, conic: false, heights: HEIGHTS, open: false }))
    }
    fn value<N: Number>([x, y, z]: &[N; 3]) -> N {
        let mut nearest: Option<N> = None;
        let mut inside = false;
        for i in 0..5 {
            let [a, b] = [CORNERS[i], CORNERS[(i + 1) % 5]];
            let [e, f] = [N::of(b[0] - a[0]), N::of(b[1] - a[1])];
            let [p, q] = [x.clone() - N::of(a[0]), y.clone() - N::of(a[1])];
            let along = (p.clone() * e.clone() + q.clone() * f.clone())
                / (e.clone().square() + f.clone().square());
            let along = along.max(N::of(0.0)).min(N::of(1.0));
            let off = (p.clone() - e.clone() * along.clone()).square()
                + (q.clone() - f.clone() * along).square();
            nearest = Some(nearest.map_or(off.clone(), |nearest| nearest.min(off)));
            let above = |end: f64| N::of(end) > *y;
            if above(a[1]) != above(b[1]) {
                let beside = p * f.clone() - q * e < N::of(0.0);
                inside ^= beside == (f > N::of(0.0));
            }
        }
        let distance = nearest.expect("five").sqrt();
        let side = if inside { N::of(0.0) - distance } else { distance };
        let [low, high] = HEIGHTS;
        side.max(z.clone() - N::of(high)).max(N::of(low) - z.clone())
    }
}

/// A [`Slab`] by the formula of a textbook.
pub struct Straight;

impl Form for Straight {
    const RAYS: usize = 5_000;

    fn body() -> Option<Body> {
        Slab::body()
    }
    fn single(f: V32, d: V32) -> Option<f32> {
        single::prism(f, d, &CORNERS, HEIGHTS)
    }
    fn double(f: V64, d: V64) -> Option<f64> {
        double::prism(f, d, &CORNERS, HEIGHTS)
    }
    fn exact(f: &WideVector, d: &WideVector) -> Answer {
        entered::<Slab>(f, d)
    }
}

/// Centres and radii.
const JOINTS: [([f64; 3], f64); 3] =
    [([-0.5, -0.25, 0.0], 0.25), ([0.0, 0.5, 0.125], 0.125), ([0.5, -0.125, -0.25], 0.375)];

pub struct Bone;

impl Field for Bone {
    const REACH: f64 = 1.0;

    fn body() -> Option<Body> {
        let segment = |pair: &[([f64; 3], f64)]| {
            let [(a, r), (b, s)] = [pair[0], pair[1]];
            let [a, b] = [a, b].map(Vector::from_array);
            let zero = Vector::ZERO;
            sphere_sweep::Segment { centre: [a, b - a, zero, zero], radius: [r, s - r, 0.0, 0.0] }
        };
        SphereSweep::new(JOINTS.windows(2).map(segment).collect()).map(Body::SphereSweep)
    }
    /// **Source:** I. Quilez, "Distance functions" (round cone).
    fn value<N: Number>(p: &[N; 3]) -> N {
        let bar = |pair: &[([f64; 3], f64)]| {
            let [(a, r), (b, s)] = [pair[0], pair[1]];
            let axis: [N; 3] = std::array::from_fn(|i| N::of(b[i]) - N::of(a[i]));
            let from = minus(p, a);
            let square = dot(axis.clone(), axis.clone());
            let narrower = r - s;
            let slant = square.clone() - N::of(narrower * narrower);
            let y = dot(from.clone(), axis.clone());
            let z = y.clone() - square.clone();
            let aside: [N; 3] = std::array::from_fn(|i| {
                from[i].clone() * square.clone() - axis[i].clone() * y.clone()
            });
            let xx = dot(aside.clone(), aside);
            let [yy, zz] = [&y, &z].map(|c| c.clone().square() * square.clone());
            let zero = || N::of(0.0);
            let signed = |c: &N, square: &N| match *c < zero() {
                true => zero() - slant.clone() * square.clone(),
                false => slant.clone() * square.clone(),
            };
            let edge = N::of(narrower.signum() * narrower * narrower) * xx.clone();
            if signed(&z, &zz) > edge {
                (xx + zz).sqrt() / square - N::of(s)
            } else if signed(&y, &yy) < edge {
                (xx + yy).sqrt() / square - N::of(r)
            } else {
                let over = (xx * slant / square.clone()).sqrt() + y * N::of(narrower);
                over / square - N::of(r)
            }
        };
        bar(&JOINTS[..2]).min(bar(&JOINTS[1..]))
    }
}

/// Three steps of h² + p among quaternions.
pub struct Rabbit;

impl Rabbit {
    const PARAMETER: [f64; 4] = [-0.2, 0.4, 0.1, 0.0];
    const STEPS: u32 = 3;
}

impl Field for Rabbit {
    const REACH: f64 = 1.5;

    fn body() -> Option<Body> {
        Some(Body::JuliaFractal(JuliaFractal {
            parameter: Self::PARAMETER,
            algebra: Algebra::Quaternion { is_cube: false },
            iterations: Self::STEPS,
            normal: [0.0, 0.0, 0.0, 1.0],
            distance: 0.0,
        }))
    }
    fn value<N: Number>([x, y, z]: &[N; 3]) -> N {
        let mut h = [x.clone(), y.clone(), z.clone(), N::of(0.0)];
        let squared = |h: &[N; 4]| {
            let [a, b, c, d] = h.clone().map(N::square);
            a + b + c + d
        };
        let p = Self::PARAMETER;
        let radius = N::of(1.0) + squared(&p.map(N::of)).sqrt();
        let beyond = |h: &[N; 4]| squared(h) - radius.clone().square();
        let mut farthest = beyond(&h);
        for _ in 1..Self::STEPS {
            let [a, b, c, d] = h.clone();
            let real =
                a.clone().square() - b.clone().square() - c.clone().square() - d.clone().square();
            let twice = N::of(2.0) * a;
            h = [real, twice.clone() * b, twice.clone() * c, twice * d];
            h = std::array::from_fn(|i| h[i].clone() + N::of(p[i]));
            farthest = farthest.max(beyond(&h));
        }
        farthest
    }
}

/// East ½, north ¼: (x⁴ + y⁴)² + z⁸ = 1.
pub struct Pillow;

impl Field for Pillow {
    const REACH: f64 = 1.75;

    fn body() -> Option<Body> {
        Some(Body::Superellipsoid(Superellipsoid::new(0.5, 0.25)))
    }
    fn value<N: Number>(p: &[N; 3]) -> N {
        let [x, y, z] = p.each_ref().map(|c| c.clone().square().square());
        (x + y).square() + z.square() - N::of(1.0)
    }
}
