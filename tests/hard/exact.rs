//! A slow tracer in 320 bits: the picture that a scene's own numbers stand for.
//!
//! **In:** a [`Scene`]. **Out:** the radiance at any point of its screen. **Invariant:** nothing
//! here comes from lucarne; no direction has length 1, so that geometry takes a square root only
//! where a sphere does; light is summed in `f64`, once it is known what is hit and what is hidden.
//!
//! Two distances are one when they differ by less than 2⁻¹⁵⁰ of the sizes they come from: far
//! below what the numbers of a scene can say, far above what 320 bits leave over.

use super::scene::{Camera, Light, Object, Paint, Scene, Triple};
use super::solids::{Crossing, Part, Ray, Thing};
use super::wide::{Wide, WideVector};

pub struct Exact<'a> {
    scene: &'a Scene,
    lens: Lens,
    things: Vec<Thing<'a>>,
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

struct Hit<'a> {
    part: &'a Part<'a>,
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
        let object = hit.part.object;
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
        if hit.part.object.ior == 1.0 {
            return Some(direction.clone());
        }
        let index = Wide::of(hit.part.object.ior);
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
            let all = thing.crossings(ray, &self.touch, &least);
            let first = all.into_iter().find(|crossing| crossing.t > least);
            let Some(crossing) = first else { continue };
            let nearer =
                |best: &Crossing| crossing.t < &best.t - &(&(&self.touch * &best.t) + &least);
            if best.as_ref().is_none_or(|(best, _)| nearer(best)) {
                best = Some((crossing, index));
            }
        }
        let (crossing, index) = best?;
        let part = self.things[index].part(&crossing);
        let Crossing { t, normal, .. } = crossing;
        let leaving = ray.direction.dot(&normal).is_positive();
        let toward = if leaving { -1.0 } else { 1.0 };
        Some(Hit {
            part,
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
        for thing in &self.things {
            let least = self.touch.clone() * &self.sizes(thing, ray) / &ray.direction.largest();
            let most = Wide::one() - least.clone();
            for crossing in thing.crossings(ray, &self.touch, &least) {
                if crossing.t > least && crossing.t < most {
                    let through = thing.part(&crossing).object.transmittance();
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
        let body = 1.0 - hit.part.object.filter - hit.part.object.transmit;
        let color = self.color(hit).map(|c| c * body);
        let mut sum = color.map(|c| product(c, hit.part.object.ambient));
        for (position, intensity) in &self.lights {
            let way = position.minus(&hit.point);
            let along = way.dot(&hit.normal);
            if !along.is_positive() || hit.part.object.diffuse == 0.0 {
                continue;
            }
            let ray = Ray { start: hit.point.clone(), direction: way };
            let light = self.lit(&ray);
            if light == [0.0; 3] {
                continue;
            }
            let square = along.clone() * &along / &(ray.direction.square() * hit.normal.square());
            let strength = hit.part.object.diffuse * square.to_f64().sqrt();
            for c in 0..3 {
                sum[c] += product(intensity[c], light[c] * color[c] * strength);
            }
        }
        sum
    }

    fn color(&self, hit: &Hit) -> Triple {
        match &hit.part.object.paint {
            Paint::Plain(color) => *color,
            Paint::Checker { even, odd, .. } => {
                let place = match &hit.part.paint_from_world {
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
