//! A slow tracer in 320 bits: the picture that a scene's own numbers stand for.
//!
//! **In:** a [`Scene`]. **Out:** the radiance at any point of its screen. **Invariant:** nothing
//! here comes from lucarne; no direction has length 1, so that geometry takes a square root only
//! where a sphere does; light is summed in `f64`, once it is known what is hit and what is hidden.
//!
//! Two distances are one when they differ by less than 2⁻¹⁵⁰ of the sizes they come from: far
//! below what the numbers of a scene can say, far above what 320 bits leave over.

use crate::scene::{Camera, Light, Object, Paint, Scene, Solid, Step, Triple};
use crate::wide::{Wide, WideMap, WideVector};

pub struct Exact<'a> {
    scene: &'a Scene,
    lens: Lens,
    things: Vec<Thing>,
    lights: Vec<(WideVector, Triple)>,
    /// 2⁻¹⁵⁰.
    touch: Wide,
}

struct Lens {
    parallel: bool,
    location: WideVector,
    direction: WideVector,
    right: WideVector,
    up: WideVector,
}

/// An object, and the way to the spaces in which its solid and its paint were written.
struct Thing {
    solid: WideSolid,
    solid_from_world: Option<WideMap>,
    paint_from_world: Option<WideMap>,
    /// How large the numbers are that its crossings come from, in the world.
    size: Wide,
}

enum WideSolid {
    Sphere { centre: WideVector, square: Wide },
    Plane { normal: WideVector, distance: Wide },
    Box { low: WideVector, high: WideVector },
}

struct Ray {
    start: WideVector,
    direction: WideVector,
}

/// A crossing, and the solid's normal there in its own space.
struct Crossing {
    t: Wide,
    normal: WideVector,
}

struct Hit<'a> {
    object: &'a Object,
    thing: &'a Thing,
    point: WideVector,
    /// Toward where the ray came from.
    normal: WideVector,
    /// The ray goes out of the solid here.
    leaving: bool,
}

impl<'a> Exact<'a> {
    pub fn new(scene: &'a Scene) -> Self {
        let wide = |light: &Light| (WideVector::of(light.position), light.color);
        Self {
            scene,
            lens: Lens::of(&scene.camera),
            things: scene.objects.iter().map(Thing::of).collect(),
            lights: scene.lights.iter().map(wide).collect(),
            touch: Wide::of(1.0 / 2f64.powi(150)),
        }
    }

    /// The radiance at a place of the screen: `x` and `y` in pixels from the top left corner.
    pub fn at(&self, x: f64, y: f64, width: u32, height: u32) -> Triple {
        let half = Wide::of(0.5);
        let u = Wide::of(x) / Wide::of(width.into()) - half.clone();
        let v = half - Wide::of(y) / Wide::of(height.into());
        self.radiance(&self.lens.ray(&u, &v), 1)
    }

    /// `level` is 1 for rays from the camera.
    fn radiance(&self, ray: &Ray, level: u32) -> Triple {
        let Some(hit) = self.nearest(ray) else { return self.scene.background };
        let object = hit.object;
        let mut seen = self.local(&hit);
        if level >= self.scene.depth {
            return seen;
        }
        let twice = Wide::of(2.0) * &ray.direction.dot(&hit.normal) / &hit.normal.square();
        let mirrored = ray.direction.minus(&hit.normal.times(&twice));
        let mut follow = |direction: WideVector, level: u32, factor: Triple| {
            let there = self.radiance(&Ray { start: hit.point.clone(), direction }, level);
            seen = std::array::from_fn(|c| seen[c] + product(factor[c], there[c]));
        };
        if object.reflection != 0.0 {
            follow(mirrored.clone(), level + 1, [object.reflection; 3]);
        }
        let through = object.transmittance();
        if through != [0.0; 3] {
            match self.bent(ray, &hit) {
                // What cannot leave is mirrored whole.
                None => follow(mirrored, level + 1, [1.0; 3]),
                Some(direction) => follow(direction, level + u32::from(object.ior != 1.0), through),
            }
        }
        seen
    }

    /// Snell's law; solids are not in each other. `None`: nothing goes through.
    fn bent(&self, ray: &Ray, hit: &Hit) -> Option<WideVector> {
        let direction = &ray.direction;
        if hit.object.ior == 1.0 {
            return Some(direction.clone());
        }
        let index = Wide::of(hit.object.ior);
        let ratio = if hit.leaving { index } else { Wide::one() / index };
        let normal = hit.normal.unit();
        let cosine = -&direction.dot(&normal);
        let along = direction.plus(&normal.times(&cosine)).times(&ratio);
        let rest = direction.square() - &along.square();
        rest.is_positive().then(|| along.minus(&normal.times(&rest.sqrt())))
    }

    /// The first surface; of those that are one, the first declared.
    fn nearest(&self, ray: &Ray) -> Option<Hit<'_>> {
        let mut best: Option<(Crossing, usize)> = None;
        for (index, thing) in self.things.iter().enumerate() {
            let least = self.touch.clone() * &self.sizes(thing, ray) / &ray.direction.largest();
            let first = thing.crossings(ray).into_iter().find(|crossing| crossing.t > least);
            let Some(crossing) = first else { continue };
            let nearer =
                |best: &Crossing| crossing.t < &best.t - &(&(&self.touch * &best.t) + &least);
            if best.as_ref().is_none_or(|(best, _)| nearer(best)) {
                best = Some((crossing, index));
            }
        }
        let (Crossing { t, normal }, index) = best?;
        let thing = &self.things[index];
        let normal = thing.world_normal(normal);
        let leaving = ray.direction.dot(&normal).is_positive();
        let toward = if leaving { -1.0 } else { 1.0 };
        Some(Hit {
            object: &self.scene.objects[index],
            thing,
            point: ray.start.plus(&ray.direction.times(&t)),
            normal: normal.times(&Wide::of(toward)),
            leaving,
        })
    }

    /// How large the numbers are from which the ray's crossings with a thing come.
    fn sizes(&self, thing: &Thing, ray: &Ray) -> Wide {
        &ray.start.largest() + &thing.size
    }

    /// What comes through of the light at the end of the ray's direction: straight on, by each
    /// surface's part.
    fn lit(&self, ray: &Ray) -> Triple {
        let mut light = [1.0; 3];
        for (object, thing) in self.scene.objects.iter().zip(&self.things) {
            let least = self.touch.clone() * &self.sizes(thing, ray) / &ray.direction.largest();
            let most = Wide::one() - least.clone();
            let through = object.transmittance();
            for crossing in thing.crossings(ray) {
                if crossing.t > least && crossing.t < most {
                    light = std::array::from_fn(|c| light[c] * through[c]);
                }
            }
            if light == [0.0; 3] {
                break;
            }
        }
        light
    }

    fn local(&self, hit: &Hit) -> Triple {
        let body = 1.0 - hit.object.filter - hit.object.transmit;
        let color = self.color(hit).map(|c| c * body);
        let mut sum = color.map(|c| product(c, hit.object.ambient));
        for (position, intensity) in &self.lights {
            let way = position.minus(&hit.point);
            let along = way.dot(&hit.normal);
            if !along.is_positive() || hit.object.diffuse == 0.0 {
                continue;
            }
            let ray = Ray { start: hit.point.clone(), direction: way };
            let light = self.lit(&ray);
            if light == [0.0; 3] {
                continue;
            }
            let square = along.clone() * &along / &(ray.direction.square() * hit.normal.square());
            let strength = hit.object.diffuse * square.to_f64().sqrt();
            for c in 0..3 {
                sum[c] += product(intensity[c], light[c] * color[c] * strength);
            }
        }
        sum
    }

    fn color(&self, hit: &Hit) -> Triple {
        match &hit.object.paint {
            Paint::Plain(color) => *color,
            Paint::Checker { even, odd, .. } => {
                let place = match &hit.thing.paint_from_world {
                    Some(map) => map.point(&hit.point),
                    None => hit.point.clone(),
                };
                let parity = place.0.iter().filter(|c| self.cell(c).is_odd()).count();
                if parity % 2 == 0 { *even } else { *odd }
            }
        }
    }

    /// The number of the cell; what is on a border belongs to the upper one.
    fn cell(&self, coordinate: &Wide) -> Wide {
        let nearest = (coordinate + &Wide::of(0.5)).floor();
        let off = (coordinate - &nearest).abs();
        if off < &self.touch * &(&coordinate.abs() + &Wide::one()) {
            nearest
        } else {
            coordinate.floor()
        }
    }
}

impl Object {
    /// The part of what lies behind that is seen.
    fn transmittance(&self) -> Triple {
        match self.paint {
            Paint::Plain(color) => color.map(|c| c * self.filter + self.transmit),
            Paint::Checker { .. } => [0.0; 3],
        }
    }
}

/// Nothing of anything, however much it is, is nothing.
fn product(a: f64, b: f64) -> f64 {
    if a == 0.0 || b == 0.0 { 0.0 } else { a * b }
}

impl Lens {
    fn of(camera: &Camera) -> Self {
        let frame = |parallel, location, direction, right, up| {
            let [location, direction, right, up] =
                [location, direction, right, up].map(WideVector::of);
            Self { parallel, location, direction, right, up }
        };
        match *camera {
            Camera::Perspective { location, direction, right, up } => {
                frame(false, location, direction, right, up)
            }
            Camera::Orthographic { location, direction, right, up } => {
                frame(true, location, direction, right, up)
            }
            Camera::LookAt { location, look_at, angle } => {
                let location = WideVector::of(location);
                let forward = WideVector::of(look_at).minus(&location).unit();
                let across = forward.cross(&WideVector::of([0.0, 1.0, 0.0])).unit();
                let up = across.cross(&forward);
                let width = Wide::of(4.0 / 3.0);
                let (sine, cosine) = (Wide::of(angle) * Wide::of(0.5)).sin_cos();
                let length = width.clone() * Wide::of(0.5) * cosine / sine;
                let (direction, right) = (forward.times(&length), across.times(&width));
                Self { parallel: false, location, direction, right, up }
            }
        }
    }

    fn ray(&self, u: &Wide, v: &Wide) -> Ray {
        let on_screen = self.right.times(u).plus(&self.up.times(v));
        if self.parallel {
            Ray { start: self.location.plus(&on_screen), direction: self.direction.clone() }
        } else {
            Ray { start: self.location.clone(), direction: self.direction.plus(&on_screen) }
        }
    }
}

impl Thing {
    fn of(object: &Object) -> Self {
        let world_from_solid = spent(&object.steps);
        let (solid, reach) = match object.solid {
            Solid::Sphere { centre, radius } => {
                let centre = WideVector::of(centre);
                let reach = &centre.largest() + &Wide::of(radius);
                let square = Wide::of(radius) * Wide::of(radius);
                (WideSolid::Sphere { centre, square }, reach)
            }
            Solid::Plane { normal, distance } => {
                let normal = WideVector::of(normal);
                let distance = Wide::of(distance) * normal.length();
                let reach = distance.abs();
                (WideSolid::Plane { normal, distance }, reach)
            }
            Solid::Box { corners: [a, b] } => {
                let side = |pick: fn(f64, f64) -> f64| {
                    WideVector::of(std::array::from_fn(|i| pick(a[i], b[i])))
                };
                let (low, high) = (side(f64::min), side(f64::max));
                let reach = &low.largest() + &high.largest();
                (WideSolid::Box { low, high }, reach)
            }
        };
        let size = match &world_from_solid {
            Some(map) => map
                .rows
                .iter()
                .fold(map.offset.largest(), |size, row| size + &(row.largest() * &reach)),
            None => reach,
        };
        let world_from_paint = match &object.paint {
            Paint::Plain(_) => None,
            Paint::Checker { steps, .. } => match (spent(steps), &world_from_solid) {
                (Some(inner), Some(outer)) => Some(outer.after(&inner)),
                (Some(one), None) => Some(one),
                (None, outer) => outer.clone(),
            },
        };
        Self {
            solid,
            solid_from_world: world_from_solid.as_ref().map(WideMap::inverse),
            paint_from_world: world_from_paint.as_ref().map(WideMap::inverse),
            size,
        }
    }

    /// In order, behind the start too.
    fn crossings(&self, ray: &Ray) -> Vec<Crossing> {
        let (start, direction) = match &self.solid_from_world {
            Some(map) => (&map.point(&ray.start), &map.direction(&ray.direction)),
            None => (&ray.start, &ray.direction),
        };
        match &self.solid {
            WideSolid::Sphere { centre, square } => {
                let from_centre = start.minus(centre);
                let a = direction.square();
                let b = from_centre.dot(direction);
                let c = from_centre.square() - square;
                let discriminant = b.clone() * &b - &(a.clone() * &c);
                if !discriminant.is_positive() {
                    return Vec::new();
                }
                let root = discriminant.sqrt();
                let q = if b.is_negative() { root - &b } else { -&(root + &b) };
                let mut roots = [q.clone() / &a, c / &q];
                if roots[1] < roots[0] {
                    roots.swap(0, 1);
                }
                let at = |t: Wide| {
                    let normal = from_centre.plus(&direction.times(&t));
                    Crossing { t, normal }
                };
                roots.map(at).into()
            }
            WideSolid::Plane { normal, distance } => {
                let speed = normal.dot(direction);
                if speed.is_zero() {
                    return Vec::new();
                }
                let t = (distance - &normal.dot(start)) / &speed;
                vec![Crossing { t, normal: normal.clone() }]
            }
            WideSolid::Box { low, high } => slabs(low, high, start, direction),
        }
    }

    /// By the inverse transpose.
    fn world_normal(&self, normal: WideVector) -> WideVector {
        match &self.solid_from_world {
            Some(map) => map
                .rows
                .iter()
                .zip(&normal.0)
                .map(|(row, n)| row.times(n))
                .reduce(|sum, row| sum.plus(&row))
                .expect("three rows"),
            None => normal,
        }
    }
}

/// Where a line enters the last slab and leaves the first; along a face it is inside.
fn slabs(
    low: &WideVector,
    high: &WideVector,
    start: &WideVector,
    direction: &WideVector,
) -> Vec<Crossing> {
    let (mut enter, mut leave): (Option<Crossing>, Option<Crossing>) = (None, None);
    for axis in 0..3 {
        let (low, high) = (&low.0[axis], &high.0[axis]);
        let (place, speed) = (&start.0[axis], &direction.0[axis]);
        if speed.is_zero() {
            if place < low || place > high {
                return Vec::new();
            }
            continue;
        }
        let normal = |sign: f64| {
            let mut normal = WideVector::of([0.0; 3]);
            normal.0[axis] = Wide::of(sign);
            normal
        };
        let crossing =
            |face: &Wide, sign| Crossing { t: (face - place) / speed, normal: normal(sign) };
        let (low, high) = (crossing(low, -1.0), crossing(high, 1.0));
        let (near, far) = if speed.is_positive() { (low, high) } else { (high, low) };
        if enter.as_ref().is_none_or(|enter| near.t > enter.t) {
            enter = Some(near);
        }
        if leave.as_ref().is_none_or(|leave| far.t < leave.t) {
            leave = Some(far);
        }
    }
    match (enter, leave) {
        (Some(enter), Some(leave)) if enter.t <= leave.t => vec![enter, leave],
        _ => Vec::new(),
    }
}

/// The map of all steps; `None` where there are none.
fn spent(steps: &[Step]) -> Option<WideMap> {
    let scaled = |v: Triple| {
        let mut map = WideMap::identity();
        for (axis, factor) in v.into_iter().enumerate() {
            map.rows[axis].0[axis] = Wide::of(factor);
        }
        map
    };
    let turned = |v: Triple| {
        let [x, y, z]: [WideMap; 3] =
            std::array::from_fn(|axis| WideMap::rotation(axis, &Wide::of(v[axis])));
        z.after(&y).after(&x)
    };
    let map = |step: &Step| match *step {
        Step::Translate(v) => WideMap { offset: WideVector::of(v), ..WideMap::identity() },
        Step::Scale(v) => scaled(v),
        Step::Rotate(v) => turned(v),
        Step::Spin { axis, degrees, times } => {
            WideMap::rotation(axis, &(Wide::of(degrees) * Wide::of(times.into())))
        }
        Step::Matrix([x, y, z, offset]) => {
            let row = |i: usize| WideVector::of([x[i], y[i], z[i]]);
            WideMap { rows: [row(0), row(1), row(2)], offset: WideVector::of(offset) }
        }
    };
    steps.iter().map(map).reduce(|before, step| step.after(&before))
}
