//! Stand-in: every shape asked in turn.
use crate::math::{UnitVector, Vector};
use crate::shape::{Crossing, Ray, Shape, SurfacePoint};
use crate::world::World;

pub struct Geometry<'a> {
    world: &'a World,
}

#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Counts {
    pub box_visits: u64,
    pub shape_tests: u64,
}

#[derive(Debug, Clone, Copy)]
pub struct Hit {
    pub object: u32,
    pub crossing: Crossing,
    pub leaving: bool,
}

impl<'a> Geometry<'a> {
    pub fn build(world: &'a World) -> Self {
        Self { world }
    }

    fn chord(&self, shape: Shape, ray: &Ray) -> Option<(f64, f64)> {
        let (o, d) = (ray.origin, ray.direction);
        match shape {
            Shape::Sphere(i) => {
                let s = self.world.spheres[i as usize];
                let oc = s.centre - o;
                let b = oc.dot(d);
                let q = oc - d * b;
                let h = s.radius * s.radius - q.length_squared();
                (h > 0.0).then(|| (b - h.sqrt(), b + h.sqrt()))
            }
            Shape::Plane(i) => {
                let p = self.world.planes[i as usize];
                let n = p.normal.get();
                let (h, nd) = (p.distance - n.dot(o), n.dot(d));
                if nd == 0.0 {
                    (h > 0.0).then_some((f64::NEG_INFINITY, f64::INFINITY))
                } else if nd < 0.0 {
                    Some((h / nd, f64::INFINITY))
                } else {
                    Some((f64::NEG_INFINITY, h / nd))
                }
            }
            Shape::Box(i) => {
                let b = self.world.boxes[i as usize];
                let (mut near, mut far) = (f64::NEG_INFINITY, f64::INFINITY);
                for (n, l) in b.normals.iter().zip(b.half_widths) {
                    let (h, nd) = (n.get().dot(b.centre - o), n.get().dot(d));
                    if nd == 0.0 {
                        if h.abs() > l {
                            return None;
                        }
                        continue;
                    }
                    let (t0, t1) = ((h - l) / nd, (h + l) / nd);
                    near = near.max(t0.min(t1));
                    far = far.min(t0.max(t1));
                }
                (near < far).then_some((near, far))
            }
            Shape::Ellipsoid(_) => None,
        }
    }

    fn first(&self, object: u32, ray: &Ray) -> Option<Hit> {
        let o = &self.world.objects[object as usize];
        let seed = self.world.materials[o.material as usize].finish.seed;
        let (a, b) = self.chord(o.shape, ray)?;
        let hit = |t: f64, leaving: bool| {
            (t > 0.0 && t.is_finite() && !(seed && leaving)).then_some(Hit {
                object,
                crossing: Crossing { t, error: 1e-15 * t },
                leaving,
            })
        };
        hit(a, o.inverse).or_else(|| hit(b, !o.inverse))
    }

    pub fn nearest(&self, ray: &Ray, counts: &mut Counts) -> Option<Hit> {
        let mut best: Option<Hit> = None;
        for object in 0..self.world.objects.len() as u32 {
            counts.shape_tests += 1;
            if let Some(hit) = self.first(object, ray) {
                if best.is_none_or(|b| hit.crossing.t < b.crossing.t) {
                    best = Some(hit);
                }
            }
        }
        best
    }

    pub fn occluded(&self, ray: &Ray, distance: f64, counts: &mut Counts) -> bool {
        (0..self.world.objects.len() as u32).any(|object| {
            counts.shape_tests += 1;
            self.world.objects[object as usize].casts_shadow
                && self.first(object, ray).is_some_and(|hit| hit.crossing.t < distance)
        })
    }

    pub fn surface(&self, ray: &Ray, hit: &Hit) -> SurfacePoint {
        let o = &self.world.objects[hit.object as usize];
        let p = ray.origin + ray.direction * hit.crossing.t;
        let error = 1e-14 * (p.abs().max_element() + hit.crossing.t);
        let (point, normal, face): (Vector, UnitVector, u32) = match o.shape {
            Shape::Sphere(i) => {
                let s = self.world.spheres[i as usize];
                (p, UnitVector::from_unit((p - s.centre).normalize()), 0)
            }
            Shape::Plane(i) => (p, self.world.planes[i as usize].normal, 0),
            Shape::Box(i) => {
                let b = self.world.boxes[i as usize];
                let mut best = (f64::NEG_INFINITY, UnitVector::X, 0);
                for k in 0..3 {
                    let h = b.normals[k].get().dot(p - b.centre);
                    let d = h.abs() - b.half_widths[k];
                    if d > best.0 {
                        let n = if h > 0.0 { b.normals[k] } else { -b.normals[k] };
                        best = (d, n, 2 * k as u32 + u32::from(h < 0.0));
                    }
                }
                (p, best.1, best.2)
            }
            Shape::Ellipsoid(_) => (p, UnitVector::X, 0),
        };
        let normal = if o.inverse { -normal.get() } else { normal.get() };
        SurfacePoint { point, normal, error, face }
    }
}

pub fn spawn(surface: &SurfacePoint, side: Vector) -> Vector {
    surface.point + side * surface.error
}
