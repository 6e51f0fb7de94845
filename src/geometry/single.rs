//! The kernels of `shape/` in single precision: what they cost and how far off they are can be seen,
//! and bought.
//!
//! **Invariant:** what is large is taken off first, in double precision: the start of a ray is
//! rounded as seen from the shape's centre, so a crossing is off by what the shape's own size and
//! the ray's way to it say, however far both are from the origin. A shape without a kernel of single
//! precision is met in double precision.

use super::search::Each;
use super::work::Tally;
use super::{ANY, Entry, Geometry, Hit, Occluder, Sides, Solid, TIGHT};
use crate::math::{Real, UnitVector, Vector, Vector3};
use crate::shape::local::Met;
use crate::shape::{Chord, Crossing, Ray, box_, plane, sphere};

type Narrow = <f32 as Real>::Vector;

/// Rounding the start and the direction of a ray, and the shape, adds to an error bound less than
/// there is: each of its terms has room for four more roundings of what was rounded.
const ROUNDED: f64 = 2.0;

/// A ray and its direction, rounded once.
struct Rounded<'a> {
    ray: &'a Ray,
    direction: Narrow,
}

impl<'a> Rounded<'a> {
    fn new(ray: &'a Ray) -> Self {
        Self { ray, direction: Narrow::from_vector(ray.direction) }
    }

    /// As seen from `centre`.
    fn from(&self, centre: Vector) -> Ray<f32> {
        let origin = Narrow::from_vector(self.ray.origin - centre);
        Ray { origin, direction: self.direction }
    }
}

impl Geometry {
    /// As [`Geometry::nearest`].
    #[cold]
    #[inline(never)]
    pub(super) fn nearest_in_single<T: Tally>(&self, ray: &Ray, mut tally: T) -> Option<Hit> {
        let rounded = Rounded::new(ray);
        let (mut best, mut best_t, mut rival_t) = (None, f64::INFINITY, f64::INFINITY);
        let mut limit = f64::INFINITY;
        let look = |place: usize, tally: &mut &mut T| {
            let entry = &self.entries[place];
            tally.root_solve(|| self.price(entry));
            if let Some(hit) = self.met(entry, &rounded, limit) {
                limit = limit.min(hit.t + 2.0 * hit.error);
                if hit.t < best_t {
                    rival_t = best_t;
                    best_t = hit.t;
                    best = Some(hit);
                } else {
                    rival_t = rival_t.min(hit.t);
                }
            }
            limit
        };
        self.search(ray, f64::INFINITY, &mut Each(&mut tally, look));
        if rival_t > limit {
            return best.map(|hit| Hit { error: f64::INFINITY, ..hit });
        }
        self.first_declared(ray, limit, tally, |entry| {
            let hit = self.met(entry, &rounded, limit)?;
            Some(Hit { error: f64::INFINITY, ..hit })
        })
    }

    /// As [`Geometry::occluder`].
    #[cold]
    #[inline(never)]
    pub(super) fn occluder_in_single<T: Tally>(
        &self,
        ray: &Ray,
        distance: f64,
        guess: Occluder,
        mut tally: T,
    ) -> Occluder {
        let rounded = Rounded::new(ray);
        let shadows = |entry: &Entry, tally: &mut T| {
            if !entry.blocks {
                return false;
            }
            tally.root_solve(|| self.price(entry));
            if let Solid::Whole(whole) = entry.solid {
                return self.whole_shadows(whole, ray, distance);
            }
            self.met(entry, &rounded, distance)
                .is_some_and(|Hit { t, error, .. }| t + error < distance)
        };
        if self.entries.get(guess.0).is_some_and(|entry| shadows(entry, &mut tally)) {
            return guess;
        }
        let mut found = Occluder::NONE;
        let look = |place: usize, tally: &mut T| {
            if shadows(&self.entries[place], tally) {
                found = Occluder(place);
                return f64::NEG_INFINITY;
            }
            distance
        };
        self.search(ray, distance, &mut Each(tally, look));
        found
    }

    /// Where the ray first meets a side of the object that is seen, at `limit` or before.
    #[inline(always)]
    fn met(&self, entry: &Entry, rounded: &Rounded, limit: f64) -> Option<Hit> {
        let zero = Narrow::from_vector(Vector::ZERO);
        let chord = match &entry.solid {
            Solid::Sphere(ball) => {
                sphere::chord(zero, ball.radius as f32, &rounded.from(ball.centre))?
            }
            Solid::Plane(flat) => {
                // As seen from the ray's own start.
                let normal = flat.normal.get();
                let inside = flat.distance - normal.dot(rounded.ray.origin);
                let ray = Ray { origin: zero, direction: rounded.direction };
                plane::chord(Narrow::from_vector(normal), inside as f32, &ray)?
            }
            Solid::Box(i) => {
                let (solid, reach_squared) = &self.boxes[*i as usize];
                if solid.is_out_of_reach(*reach_squared, rounded.ray) {
                    return None;
                }
                let normals = solid.normals.map(UnitVector::get).map(Narrow::from_vector);
                let half_widths = solid.half_widths.map(|half| half as f32);
                let slabs = box_::slabs(zero, normals, half_widths, &rounded.from(solid.centre))?;
                Chord { enter: slabs.enter, leave: slabs.leave }
            }
            Solid::Ellipsoid(_) | Solid::Placed(_) | Solid::Whole(_) => {
                return self.first_crossing::<TIGHT, ANY>(entry, rounded.ray, limit);
            }
        };
        let first = first_seen(entry.sides, chord).filter(|met| met.t <= limit);
        first.map(|met| entry.hit(met))
    }
}

fn first_seen(sides: Sides, chord: Chord<f32>) -> Option<Met> {
    let wide = |Crossing { t, error }: Crossing<f32>| Crossing {
        t: f64::from(t),
        error: ROUNDED * f64::from(error),
    };
    sides.first_seen(&Chord { enter: wide(chord.enter), leave: wide(chord.leave) })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::{Random, tries};
    use crate::shape::{Box_, Plane, Shape, Sphere};
    use crate::world::{Finish, Object, Pigment, Plain, Texture, World};

    /// One shape of each kind, far from the origin.
    fn world(random: &mut Random, far: f64) -> World {
        let finish = Finish {
            conserve_energy: false,
            emission: crate::color::Rgb::BLACK,
            diffuse: 1.0,
            brilliance: 1.0,
            lobes: Vec::new(),
            reflection: None,
            seed: false,
            extras: None,
        };
        let pigment = Pigment::Color(crate::color::Color::WHITE);
        let texture = Texture::Plain(Plain { pigment, normal: None, finish });
        let mut world = World { textures: vec![texture], ..World::default() };
        let centre = random.point(far);
        world.spheres.push(Sphere { centre, radius: random.number(0.1, 2.0) });
        let normal = random.direction();
        world.planes.push(Plane { normal, distance: normal.get().dot(centre) - 3.0 });
        world.boxes.push(Box_ {
            centre: centre + random.point(4.0),
            normals: [UnitVector::X, UnitVector::Y, UnitVector::Z],
            half_widths: [0.5, 1.0, 0.3],
        });
        let object = |shape| Object::plain(shape);
        world.objects = [Shape::Sphere(0), Shape::Plane(0), Shape::Box(0)].map(object).to_vec();
        world
    }

    /// Of rays in all directions, near and onto the shapes.
    #[test]
    fn a_crossing_in_single_precision_is_as_far_off_as_its_bound_says() {
        let mut random = Random(41);
        let mut crossings = 0;
        for _ in 0..tries() {
            let far = random.size(0.0, 6.0);
            let world = world(&mut random, far);
            let geometry = Geometry::build(&world);
            let origin = world.spheres[0].centre + random.point(6.0);
            let ray = Ray { origin, direction: random.direction().get() };
            let rounded = Rounded::new(&ray);
            for entry in &geometry.entries {
                let exact = geometry.first_crossing::<TIGHT, ANY>(entry, &ray, f64::INFINITY);
                let rough = geometry.met(entry, &rounded, f64::INFINITY);
                if let (Some(exact), Some(rough)) = (exact, rough)
                    && exact.leaving == rough.leaving
                {
                    crossings += 1;
                    let off = (exact.t - rough.t).abs();
                    assert!(off <= rough.error + exact.error, "{entry:?} {ray:?} {off} {rough:?}");
                    // Along a plane the direction's own rounding is what is told.
                    let slope = match &entry.solid {
                        Solid::Plane(plane) => ray.direction.dot(plane.normal.get()).abs(),
                        Solid::Sphere(_)
                        | Solid::Box(_)
                        | Solid::Ellipsoid(_)
                        | Solid::Placed(_)
                        | Solid::Whole(_) => 1.0,
                    };
                    let share = if slope < 1e-4 { 1e-6 / slope } else { 1e-2 };
                    assert!(rough.error < share * rough.t.max(1e-3), "{slope:e} {rough:?}");
                }
            }
        }
        assert!(crossings > tries() / 2, "{crossings}");
    }

    #[test]
    fn a_ray_that_starts_on_a_surface_does_not_meet_it_there() {
        let mut random = Random(42);
        for _ in 0..tries() {
            let far = random.size(0.0, 6.0);
            let world = world(&mut random, far);
            let geometry = Geometry::build(&world).in_single_precision();
            let origin = world.spheres[0].centre + random.point(6.0);
            let ray = Ray { origin, direction: random.direction().get() };
            let Some(hit) = geometry.nearest(&ray) else { continue };
            let surface = super::super::surface::<ANY>(&world, &ray, &hit);
            let normal = if hit.leaving { -surface.normal } else { surface.normal };
            let onward = random.direction().get();
            let onward = if onward.dot(normal) < 0.0 { -onward } else { onward };
            let next = Ray { origin: surface.spawn(normal), direction: onward };
            if let Some(again) = geometry.nearest(&next).filter(|again| again.object == hit.object)
            {
                // From inside of a ball or a box only, and at the other side.
                assert!(hit.leaving && again.t > 1e-7, "{hit:?} {again:?}");
            }
        }
    }
}
