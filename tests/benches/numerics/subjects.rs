//! What is measured: each shape with its kernel, the textbook's, and where a line enters it in 320
//! bits.

use lucarne::geometry::Geometry;
use lucarne::math::placement::Placement;
use lucarne::math::{Matrix, UnitVector, Vector};
use lucarne::road::{Options, Road};
use lucarne::scene::Dialect;
use lucarne::shape::{Box_, Chord, Crossing, Ellipsoid, Plane, Ray, Sphere};
use lucarne::source::NoFiles;

use crate::dice::Dice;
use crate::naive::{V32, V64, double, single};
use crate::wide::{Wide, WideVector};

pub fn v32(v: Vector) -> V32 {
    v.as_vec3().to_array()
}

pub fn v64(v: Vector) -> V64 {
    v.to_array()
}

pub fn wide(v: Vector) -> WideVector {
    WideVector::of(v.to_array())
}

/// The same ray in `f32`.
pub struct Rounded {
    pub origin: V32,
    pub direction: V32,
}

impl Rounded {
    pub fn of(ray: &Ray) -> Self {
        Self { origin: v32(ray.origin), direction: v32(ray.direction) }
    }
}

pub enum Answer {
    Enters(Wide),
    Misses,
    /// So near a touch that both answers are right.
    Either,
}

/// A shape of size 1, about a place.
pub trait Subject {
    /// Rays a row, all of them held against 320 bits.
    const RAYS: usize = 20_000;
    /// Rounds in which the three kernels take turns.
    const ROUNDS: usize = 101;

    fn new(dice: &mut Dice, far: f64) -> Self;
    fn centre(&self) -> Vector;
    /// Of its surface, or near it.
    fn target(&self, dice: &mut Dice) -> Vector;
    fn ours(&self, ray: &Ray) -> Option<Crossing>;
    fn single(&self, ray: &Rounded) -> Option<f32>;
    fn double(&self, ray: &Ray) -> Option<f64>;
    fn exact(&self, ray: &Ray) -> Answer;

    /// From so many sizes away.
    fn ray(&self, dice: &mut Dice, far: f64) -> Option<Ray> {
        let origin = self.centre() + dice.direction() * far;
        let direction = UnitVector::from_direction(self.target(dice) - origin)?;
        Some(Ray { origin, direction: direction.get() })
    }
}

/// Of the roots of a·t² + 2·b·t + c the first.
pub fn root(a: &Wide, b: &Wide, c: &Wide) -> Answer {
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

pub struct Ball(Sphere);

impl Subject for Ball {
    fn new(dice: &mut Dice, _: f64) -> Self {
        Self(Sphere { centre: dice.point(3.0), radius: 1.0 })
    }
    fn centre(&self) -> Vector {
        self.0.centre
    }
    fn target(&self, dice: &mut Dice) -> Vector {
        self.0.centre + dice.direction() * dice.one_of(&[0.5, 1.0, 1.2])
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
        let r = Wide::of(self.0.radius);
        root(&d.square(), &f.dot(&d), &(f.square() - &(&r * &r)))
    }
}

/// A sphere whose ground is 1 below the ray's start, and whose radius is what is far.
pub struct Planet(Ball);

impl Subject for Planet {
    fn new(_: &mut Dice, far: f64) -> Self {
        Self(Ball(Sphere { centre: Vector::Y * -far, radius: far }))
    }
    fn centre(&self) -> Vector {
        self.0.centre()
    }
    fn target(&self, dice: &mut Dice) -> Vector {
        self.0.target(dice)
    }
    fn ray(&self, dice: &mut Dice, _: f64) -> Option<Ray> {
        let direction = dice.direction();
        let direction = if direction.y < 0.0 { direction } else { -direction };
        (direction.y < -0.1).then_some(Ray { origin: Vector::Y, direction })
    }
    fn ours(&self, ray: &Ray) -> Option<Crossing> {
        self.0.ours(ray)
    }
    fn single(&self, ray: &Rounded) -> Option<f32> {
        self.0.single(ray)
    }
    fn double(&self, ray: &Ray) -> Option<f64> {
        self.0.double(ray)
    }
    fn exact(&self, ray: &Ray) -> Answer {
        self.0.exact(ray)
    }
}

pub struct Floor(Plane, Vector);

impl Subject for Floor {
    fn new(dice: &mut Dice, _: f64) -> Self {
        let (normal, centre) = (dice.direction(), dice.point(3.0));
        let normal = UnitVector::from_unit(normal);
        Self(Plane { normal, distance: normal.get().dot(centre) }, centre)
    }
    fn centre(&self) -> Vector {
        self.1
    }
    fn target(&self, dice: &mut Dice) -> Vector {
        self.1 + dice.point(1.0)
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
}

pub struct Block(Box_);

impl Subject for Block {
    fn new(dice: &mut Dice, _: f64) -> Self {
        let a = dice.direction();
        let b = UnitVector::from_direction(a.cross(dice.direction())).unwrap_or(UnitVector::Y);
        let c = UnitVector::from_unit(a.cross(b.get()).normalize());
        let normals = [UnitVector::from_unit(a), b, c];
        Self(Box_ { centre: dice.point(3.0), normals, half_widths: [1.0, 0.7, 0.4] })
    }
    fn centre(&self) -> Vector {
        self.0.centre
    }
    fn target(&self, dice: &mut Dice) -> Vector {
        self.0.centre + dice.direction() * dice.one_of(&[0.3, 0.7, 1.1])
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
}

/// Some map that turns and stretches, and its rows with their offsets.
pub fn somewhere(dice: &mut Dice, sizes: Vector) -> (Placement, [[f64; 4]; 3]) {
    let a = dice.direction();
    let b = UnitVector::from_direction(a.cross(dice.direction())).unwrap_or(UnitVector::Y).get();
    let turn = Matrix::from_cols(a, b, a.cross(b).normalize());
    let world_from_local = turn * Matrix::from_diagonal(sizes);
    let (centre, local_from_world) = (dice.point(3.0), world_from_local.inverse());
    let rows = local_from_world.transpose();
    let offset = local_from_world * -centre;
    let rows = [(rows.x_axis, offset.x), (rows.y_axis, offset.y), (rows.z_axis, offset.z)]
        .map(|(row, offset)| [row.x, row.y, row.z, offset]);
    (Placement { centre, world_from_local, local_from_world }, rows)
}

/// A ray in a local space, exactly.
pub fn local(placement: &Placement, ray: &Ray) -> (WideVector, WideVector) {
    let rows = placement.local_from_world.transpose();
    let rows = [rows.x_axis, rows.y_axis, rows.z_axis].map(wide);
    let local = |v: &WideVector| WideVector(rows.each_ref().map(|row| row.dot(v)));
    (local(&wide(ray.origin).minus(&wide(placement.centre))), local(&wide(ray.direction)))
}

pub struct Egg(Ellipsoid, [[f64; 4]; 3]);

impl Subject for Egg {
    fn new(dice: &mut Dice, _: f64) -> Self {
        let (placement, rows) = somewhere(dice, Vector::new(1.0, 0.3, 0.1));
        Self(Ellipsoid { placement }, rows)
    }
    fn centre(&self) -> Vector {
        self.0.placement.centre
    }
    fn target(&self, dice: &mut Dice) -> Vector {
        let reach = dice.one_of(&[0.5, 1.0, 1.2]);
        self.0.placement.centre + self.0.placement.world_from_local * (dice.direction() * reach)
    }
    fn ours(&self, ray: &Ray) -> Option<Crossing> {
        self.0.chord(ray).map(|chord| chord.enter)
    }
    fn single(&self, ray: &Rounded) -> Option<f32> {
        let (f, d) =
            single::local(ray.origin, ray.direction, &self.1.map(|row| row.map(|c| c as f32)));
        single::ellipsoid(f, d).map(|(t, _)| t)
    }
    fn double(&self, ray: &Ray) -> Option<f64> {
        let (f, d) = double::local(v64(ray.origin), v64(ray.direction), &self.1);
        double::ellipsoid(f, d).map(|(t, _)| t)
    }
    fn exact(&self, ray: &Ray) -> Answer {
        let (f, d) = local(&self.0.placement, ray);
        root(&d.square(), &f.dot(&d), &(f.square() - &Wide::one()))
    }
}

/// A ball without a box, whose numbers have few digits.
pub struct Carved {
    geometry: Geometry,
    centre: Vector,
}

/// The box, as seen from the ball's centre.
const CORNERS: [[f64; 3]; 2] = [[0.25, -0.25, -0.5], [1.25, 1.5, 0.75]];

impl Carved {
    fn middle(&self) -> (Vector, Vector) {
        let [low, high] = CORNERS.map(Vector::from_array);
        (self.centre + (low + high) * 0.5, (high - low) * 0.5)
    }
}

impl Subject for Carved {
    fn new(dice: &mut Dice, _: f64) -> Self {
        let centre = (dice.point(3.0) * 64.0).round() / 64.0;
        let text = |v: Vector| format!("<{:e}, {:e}, {:e}>", v.x, v.y, v.z);
        let [low, high] = CORNERS.map(|corner| text(centre + Vector::from_array(corner)));
        let solid =
            format!("difference {{ sphere {{ {}, 1 }} box {{ {low}, {high} }} }}", text(centre));
        let mut road = Road::new(&NoFiles, Options::new(Dialect::Scene));
        let (world, _) = road.compile("whole.scene", solid.into_bytes());
        assert!(!road.diagnostics.has_errors(), "{:#?}", road.diagnostics);
        Self { geometry: Geometry::build(&world), centre }
    }
    fn centre(&self) -> Vector {
        self.centre
    }
    fn target(&self, dice: &mut Dice) -> Vector {
        self.centre + dice.direction() * dice.one_of(&[0.5, 1.0, 1.2])
    }
    fn ours(&self, ray: &Ray) -> Option<Crossing> {
        self.geometry.nearest(ray).map(|hit| Crossing { t: hit.t, error: hit.error })
    }
    fn single(&self, ray: &Rounded) -> Option<f32> {
        let (middle, half) = self.middle();
        let (ball, block) = ((v32(self.centre), 1.0), (v32(middle), v32(half)));
        single::difference(ray.origin, ray.direction, ball, block)
    }
    fn double(&self, ray: &Ray) -> Option<f64> {
        let (middle, half) = self.middle();
        let (ball, block) = ((v64(self.centre), 1.0), (v64(middle), v64(half)));
        double::difference(v64(ray.origin), v64(ray.direction), ball, block)
    }
    fn exact(&self, ray: &Ray) -> Answer {
        const NEAR: f64 = 1e-6;
        let (f, d) = (wide(ray.origin).minus(&wide(self.centre)), wide(ray.direction));
        let (a, b, c) = (d.square(), f.dot(&d), f.square() - &Wide::one());
        let Answer::Enters(enter) = root(&a, &b, &c) else { return root(&a, &b, &c) };
        let leave = -&(Wide::of(2.0) * &b / &a + &enter);
        let [low, high] = CORNERS.map(WideVector::of);
        let mut chord: Option<[Wide; 2]> = None;
        for axis in 0..3 {
            if d.0[axis].to_f64().abs() < NEAR {
                return Answer::Either;
            }
            let mut ends = [&low, &high].map(|corner| (&corner.0[axis] - &f.0[axis]) / &d.0[axis]);
            if ends[0] > ends[1] {
                ends.swap(0, 1);
            }
            let [first, last] = ends;
            chord = Some(match chord {
                None => [first, last],
                Some([low, high]) => {
                    [if first > low { first } else { low }, if last < high { last } else { high }]
                }
            });
        }
        let [first, last] = chord.expect("three slabs");
        let over = |a: &Wide, b: &Wide| (a - b).to_f64();
        let told =
            [over(&last, &first), over(&enter, &first), over(&enter, &last), over(&last, &leave)];
        if told.iter().any(|off| off.abs() < NEAR) {
            return Answer::Either;
        }
        match told {
            [room, begins, ends, _] if room < 0.0 || begins < 0.0 || ends > 0.0 => {
                Answer::Enters(enter)
            }
            [_, _, _, beyond] if beyond < 0.0 => Answer::Enters(last),
            _ => Answer::Misses,
        }
    }
}
