//! Bodies in a space of their own: each with its kernel, the textbook's, and where a line enters it in 320
//! bits.

use std::sync::Arc;

use lucarne::function::{Binary, Builder, TooLong, Unary};
use lucarne::math::{UnitVector, Vector};
use lucarne::shape::isosurface::Container;
use lucarne::shape::mesh::Face;
use lucarne::shape::{
    Algebraic, Body, Cone, Crossing, Cylinder, Disc, Mesh, Parametric, Placed, Ray, Torus,
};
use lucarne::texture::Closed;

use crate::dice::Dice;
use crate::naive::{V32, V64, double, single};
use crate::sturm::roots;
use crate::subjects::{Answer, Rounded, Subject, local, root, somewhere, v64};
use crate::wide::{Wide, WideVector};

/// What a body is in its own space.
pub trait Form {
    /// See [`Subject`].
    const RAYS: usize = 20_000;
    /// See [`Subject`].
    const ROUNDS: usize = 101;

    fn body() -> Option<Body>;
    fn single(f: V32, d: V32) -> Option<f32>;
    fn double(f: V64, d: V64) -> Option<f64>;
    fn exact(f: &WideVector, d: &WideVector) -> Answer;
}

/// A body under some map that turns and stretches.
pub struct Stands<F> {
    placed: Placed,
    rows: [[f64; 4]; 3],
    form: std::marker::PhantomData<F>,
}

impl<F: Form> Subject for Stands<F> {
    const RAYS: usize = F::RAYS;
    const ROUNDS: usize = F::ROUNDS;

    fn new(dice: &mut Dice, _: f64) -> Self {
        let (placement, rows) = somewhere(dice, Vector::new(1.0, 0.8, 0.6));
        let body = Arc::new(F::body().expect("a body"));
        let placed = Placed { body, placement, root_tolerance: 0.0, exact: None };
        Self { placed, rows, form: std::marker::PhantomData }
    }
    fn centre(&self) -> Vector {
        self.placed.placement.centre
    }
    fn target(&self, dice: &mut Dice) -> Vector {
        let reach = dice.one_of(&[0.3, 0.7, 1.1]);
        self.placed.placement.world_point(dice.direction() * reach)
    }
    fn ours(&self, ray: &Ray) -> Option<Crossing> {
        let crossings = self.placed.crossings(ray);
        crossings.iter().find(|met| met.is_seen()).map(|met| met.crossing())
    }
    fn single(&self, ray: &Rounded) -> Option<f32> {
        let rows = self.rows.map(|row| row.map(|c| c as f32));
        let (f, d) = single::local(ray.origin, ray.direction, &rows);
        F::single(f, d)
    }
    fn double(&self, ray: &Ray) -> Option<f64> {
        let (f, d) = double::local(v64(ray.origin), v64(ray.direction), &self.rows);
        F::double(f, d)
    }
    fn exact(&self, ray: &Ray) -> Answer {
        let (f, d) = local(&self.placed.placement, ray);
        F::exact(&f, &d)
    }
}

/// So near to a decision, of lengths of about 1, that either is right.
pub const NEAR: f64 = 1e-6;

pub struct Bar;

impl Form for Bar {
    fn body() -> Option<Body> {
        Some(Body::Cylinder(Cylinder { open: false }))
    }
    fn single(f: V32, d: V32) -> Option<f32> {
        single::cylinder(f, d)
    }
    fn double(f: V64, d: V64) -> Option<f64> {
        double::cylinder(f, d)
    }
    fn exact(f: &WideVector, d: &WideVector) -> Answer {
        tapered(f, d, &Wide::one())
    }
}

/// The width of a [`Stump`]'s narrow end.
const CAP: f64 = 0.25;

pub struct Stump;

impl Form for Stump {
    fn body() -> Option<Body> {
        Some(Body::Cone(Cone { cap: CAP, open: false }))
    }
    fn single(f: V32, d: V32) -> Option<f32> {
        single::cone(f, d, CAP as f32)
    }
    fn double(f: V64, d: V64) -> Option<f64> {
        double::cone(f, d, CAP)
    }
    fn exact(f: &WideVector, d: &WideVector) -> Answer {
        tapered(f, d, &Wide::of(CAP))
    }
}

/// The first of the crossings with the round side and with both ends of what is 1 wide at z = −1 and `cap` at
/// z = 1.
fn tapered(f: &WideVector, d: &WideVector, cap: &Wide) -> Answer {
    let (one, half) = (Wide::one(), Wide::of(0.5));
    let slope = (&one - cap) * &half;
    let ([fx, fy, fz], [dx, dy, dz]) = (&f.0, &d.0);
    let (width, growth) = (cap + &(&slope * &(&one - fz)), -&(&slope * dz));
    let a = dx * dx + dy * dy - &growth * &growth;
    let b = fx * dx + fy * dy - &width * &growth;
    let c = fx * fx + fy * fy - &width * &width;
    let discriminant = &b * &b - &(&a * &c);
    let speed = d.length();
    if (discriminant.clone() / &(&a * &d.square())).to_f64().abs() < NEAR * NEAR {
        return Answer::Either;
    }
    let mut found: Vec<Wide> = Vec::new();
    if discriminant.is_positive() {
        let root = discriminant.sqrt();
        for t in [(-&(&root + &b)) / &a, (root - &b) / &a] {
            let z = fz + &(&t * dz);
            let beyond = z.abs() - &one;
            if beyond.to_f64().abs() < NEAR {
                return Answer::Either;
            }
            if beyond.is_negative() {
                found.push(t);
            }
        }
    }
    for (end, radius) in [(-&one, &one), (one.clone(), cap)] {
        let t = (end - fz) / dz;
        let (x, y) = (fx + &(&t * dx), fy + &(&t * dy));
        let beyond = (&x * &x + &y * &y).sqrt() - radius;
        if beyond.to_f64().abs() < NEAR {
            return Answer::Either;
        }
        if beyond.is_negative() {
            found.push(t);
        }
    }
    found.sort_by(|a, b| a.partial_cmp(b).expect("ordered"));
    match found.as_slice() {
        [first, second, ..] if ((second - first) * &speed).to_f64() < NEAR => Answer::Either,
        [first, ..] => Answer::Enters(first.clone()),
        [] => Answer::Misses,
    }
}

/// A [`Ring`]'s two radii.
const MAJOR: f64 = 0.75;
const MINOR: f64 = 0.25;

pub struct Ring;

impl Form for Ring {
    fn body() -> Option<Body> {
        Some(Body::Torus(Torus { major: MAJOR, minor: MINOR }))
    }
    fn single(f: V32, d: V32) -> Option<f32> {
        single::torus(f, d, MAJOR as f32, MINOR as f32)
    }
    fn double(f: V64, d: V64) -> Option<f64> {
        double::torus(f, d, MAJOR, MINOR)
    }
    fn exact(f: &WideVector, d: &WideVector) -> Answer {
        let polynomial = |minor: f64| {
            let (major, minor) = (Wide::of(MAJOR), Wide::of(minor));
            let (dd, fd) = (d.square(), f.dot(d));
            let (two, four) = (Wide::of(2.0), Wide::of(4.0));
            let k = f.square() + &major * &major - &minor * &minor;
            let m = &four * &(&major * &major);
            let flat = |a: &WideVector, b: &WideVector| &a.0[0] * &b.0[0] + &a.0[1] * &b.0[1];
            vec![
                &k * &k - &m * &flat(f, f),
                &four * &(&k * &fd) - &two * &(&m * &flat(f, d)),
                &two * &(&dd * &k) + &four * &(&fd * &fd) - &m * &flat(d, d),
                &four * &(&dd * &fd),
                &dd * &dd,
            ]
        };
        // What rings a little thinner and thicker do not agree on is too near to tell.
        let middle = (-&f.dot(d)) / &d.square();
        let reach = Wide::of(2.0) / &d.length();
        let between = (&middle - &reach, middle + &reach);
        let [thin, meant, thick] = [MINOR * (1.0 - NEAR), MINOR, MINOR * (1.0 + NEAR)]
            .map(|minor| roots(&polynomial(minor), &between));
        match (thin.len(), meant.as_slice(), thick.len()) {
            (0, _, 0) => Answer::Misses,
            (thin, [first, ..], thick) if thin == meant.len() && meant.len() == thick => {
                Answer::Enters(first.clone())
            }
            _ => Answer::Either,
        }
    }
}

/// A quadric's terms: an egg that lies askew.
const EGG: [f64; 10] = [2.0, 0.5, 0.25, 0.125, 3.0, 0.5, -0.25, 2.5, 0.125, -1.0];

pub struct Quadric;

impl Form for Quadric {
    fn body() -> Option<Body> {
        Algebraic::new(2, EGG.to_vec()).map(Body::Algebraic)
    }
    fn single(f: V32, d: V32) -> Option<f32> {
        single::quadric(f, d, &EGG).map(|(t, _)| t)
    }
    fn double(f: V64, d: V64) -> Option<f64> {
        double::quadric(f, d, &EGG).map(|(t, _)| t)
    }
    fn exact(f: &WideVector, d: &WideVector) -> Answer {
        let [xx, xy, xz, x, yy, yz, y, zz, z, one] = EGG.map(Wide::of);
        let half = Wide::of(0.5);
        let form = |a: &WideVector, b: &WideVector| {
            let term = |i: usize, j: usize| &a.0[i] * &b.0[j];
            let mixed = |i: usize, j: usize| (term(i, j) + term(j, i)) * &half;
            &xx * &term(0, 0)
                + &yy * &term(1, 1)
                + &zz * &term(2, 2)
                + &xy * &mixed(0, 1)
                + &xz * &mixed(0, 2)
                + &yz * &mixed(1, 2)
        };
        let line = WideVector([x, y, z]);
        let b = form(f, d) + line.dot(d) * &half;
        root(&form(d, d), &b, &(form(f, f) + line.dot(f) + &one))
    }
}

const CORNERS: [[f64; 3]; 3] = [[-0.75, -0.5, 0.25], [0.875, -0.375, -0.125], [0.0, 0.75, 0.0]];

pub struct Triangle;

impl Form for Triangle {
    fn body() -> Option<Body> {
        let corners = CORNERS.map(Vector::from_array).to_vec();
        let faces = vec![Face { corners: [0, 1, 2], normals: None }];
        Mesh::new(corners, Vec::new(), faces, None::<UnitVector>).map(Body::Mesh)
    }
    fn single(f: V32, d: V32) -> Option<f32> {
        single::triangle(f, d, &CORNERS)
    }
    fn double(f: V64, d: V64) -> Option<f64> {
        double::triangle(f, d, &CORNERS)
    }
    fn exact(f: &WideVector, d: &WideVector) -> Answer {
        pierced(f, d, &CORNERS)
    }
}

pub fn pierced(f: &WideVector, d: &WideVector, corners: &[[f64; 3]; 3]) -> Answer {
    let corners = corners.map(|corner| WideVector::of(corner).minus(f));
    let [a, b, c] = &corners;
    let way = d.unit();
    let sides = [(a, b), (b, c), (c, a)]
        .map(|(from, to)| (way.dot(&from.cross(to)) / &to.minus(from).length()).to_f64());
    let normal = b.minus(a).cross(&c.minus(a));
    let slope = normal.unit().dot(&way).to_f64();
    let outside =
        sides.iter().fold(f64::INFINITY, |least, side| side.copysign(side * slope).min(least));
    if outside.abs() < NEAR || slope.abs() < 1e-3 {
        Answer::Either
    } else if outside < 0.0 {
        Answer::Misses
    } else {
        Answer::Enters(normal.dot(a) / &normal.dot(d))
    }
}

/// A [`Washer`]'s hole.
const HOLE: f64 = 0.25;

pub struct Washer;

impl Form for Washer {
    fn body() -> Option<Body> {
        Some(Body::Disc(Disc { hole: HOLE }))
    }
    fn single(f: V32, d: V32) -> Option<f32> {
        single::disc(f, d, HOLE as f32)
    }
    fn double(f: V64, d: V64) -> Option<f64> {
        double::disc(f, d, HOLE)
    }
    fn exact(f: &WideVector, d: &WideVector) -> Answer {
        let ([fx, fy, fz], [dx, dy, dz]) = (&f.0, &d.0);
        if (dz.clone() / &d.length()).to_f64().abs() < 1e-3 {
            return Answer::Either;
        }
        let t = (-fz) / dz;
        let (x, y) = (fx + &(&t * dx), fy + &(&t * dy));
        let distance = (&x * &x + &y * &y).sqrt().to_f64();
        match () {
            () if (distance - 1.0).abs() < NEAR || (distance - HOLE).abs() < NEAR => Answer::Either,
            () if HOLE < distance && distance < 1.0 => Answer::Enters(t),
            () => Answer::Misses,
        }
    }
}

/// cos u·sin v, sin u·sin v, cos v.
fn longitudes() -> Result<[Arc<Closed>; 3], TooLong> {
    let closed = |operations: [(usize, Unary); 2], count: usize| {
        let mut f = Builder::new(3)?;
        let mut product = None;
        for (axis, operation) in operations.into_iter().take(count) {
            let angle = f.parameter(axis).ok_or(TooLong)?;
            let part = f.unary(operation, angle)?;
            product = Some(match product {
                Some(other) => f.binary(Binary::Multiply, other, part)?,
                None => part,
            });
        }
        let function = f.finish(product.ok_or(TooLong)?);
        Ok(Arc::new(Closed::new(function, |_| None).expect("asks nothing")))
    };
    Ok([
        closed([(1, Unary::Sin), (0, Unary::Cos)], 2)?,
        closed([(1, Unary::Sin), (0, Unary::Sin)], 2)?,
        closed([(1, Unary::Cos), (0, Unary::Sin)], 1)?,
    ])
}

pub struct Globe;

impl Form for Globe {
    const RAYS: usize = 500;
    const ROUNDS: usize = 11;

    fn body() -> Option<Body> {
        use std::f64::consts::PI;
        let container = Container::Box(Vector::splat(1.125));
        let corners = [[0.0, 0.0], [2.0 * PI, PI]];
        let functions = longitudes().ok()?;
        Some(Body::Parametric(Parametric::new(functions, corners, container, Vector::ZERO, 1.0)))
    }
    fn single(f: V32, d: V32) -> Option<f32> {
        single::longitudes(f, d)
    }
    fn double(f: V64, d: V64) -> Option<f64> {
        double::longitudes(f, d)
    }
    fn exact(f: &WideVector, d: &WideVector) -> Answer {
        root(&d.square(), &f.dot(d), &(f.square() - &Wide::one()))
    }
}
