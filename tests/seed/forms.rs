//! The page's objects, word for word: canonical forms, the three transformations on them, and the
//! three intersections.
//!
//! **In:** an untransformed object and its written steps. **Out:** the canonical form, and where a
//! ray hits it first. **Invariant:** nothing here comes from the tracer or from lowering; a
//! quantity has the page's own name (N, d, C_f, d_f, C_o, d_o, l, S, D, A, B).

use lucarne::math::Vector;
use lucarne::math::elementary::{cos, sin};
use lucarne::math::transform::Step;

/// R(t) = S + t·D, t ≥ 0, D of length 1.
#[derive(Debug, Clone, Copy)]
pub struct Ray {
    pub s: Vector,
    pub d: Vector,
}

#[derive(Debug, Clone, Copy)]
pub struct Hit {
    pub t: f64,
    pub point: Vector,
    /// N: of length 1, outward.
    pub normal: Vector,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sphere {
    pub c: Vector,
    pub r: f64,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane {
    pub n: Vector,
    /// Signed distance to the origin: positive when the origin is inside.
    pub d: f64,
}

/// One of the three pairs of opposite faces of a box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pair {
    pub n: Vector,
    pub c_f: Vector,
    pub d_f: f64,
    pub c_o: Vector,
    pub d_o: f64,
    pub l: f64,
}

impl Pair {
    /// The same two faces, the other one first.
    pub fn opposite(self) -> Self {
        let Self { n, c_f, d_f, c_o, d_o, l } = self;
        Self { n: -n, c_f: c_o, d_f: d_o, c_o: c_f, d_o: d_f, l }
    }
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Faces(pub [Pair; 3]);

#[derive(Debug, Clone, Copy, PartialEq)]
#[allow(clippy::large_enum_variant, reason = "plain values, and few of them")]
pub enum Form {
    Sphere(Sphere),
    Plane(Plane),
    Box(Faces),
}

impl Form {
    pub fn sphere(centre: Vector, radius: f64) -> Self {
        Self::Sphere(Sphere { c: centre, r: radius })
    }

    pub fn plane(normal: Vector, distance: f64) -> Self {
        Self::Plane(Plane { n: normal / normal.length(), d: distance })
    }

    pub fn cuboid(corners: [Vector; 2]) -> Self {
        let low = corners[0].min(corners[1]);
        let high = corners[0].max(corners[1]);
        let centre = (low + high) / 2.0;
        Self::Box(Faces([Vector::X, Vector::Y, Vector::Z].map(|n| {
            let l = (high - low).dot(n) / 2.0;
            let (c_f, c_o) = (centre + n * l, centre - n * l);
            Pair { n, c_f, d_f: n.dot(c_f), c_o, d_o: -n.dot(c_o), l }
        })))
    }

    /// The rule of the page for one step. A step the page does not know is a mistake of the test.
    pub fn after(self, step: &Step) -> Self {
        match *step {
            Step::Translate(v) => self.translated(v),
            Step::Scale(k) => {
                assert!(k.x == k.y && k.y == k.z, "the page scales uniformly only, not by {k}");
                self.scaled(k.x)
            }
            Step::Rotate(degrees) => self.rotated(degrees),
            Step::Matrix(_) | Step::Transform(_) | Step::InverseOf(_) => {
                panic!("not a step of the page: {step:?}")
            }
        }
    }

    /// Adds V to every point; distances become d + V·N.
    fn translated(self, v: Vector) -> Self {
        match self {
            Self::Sphere(s) => Self::Sphere(Sphere { c: s.c + v, ..s }),
            Self::Plane(p) => Self::Plane(Plane { d: p.d + v.dot(p.n), ..p }),
            Self::Box(Faces(pairs)) => Self::Box(Faces(pairs.map(|p| Pair {
                c_f: p.c_f + v,
                d_f: p.d_f + v.dot(p.n),
                c_o: p.c_o + v,
                d_o: p.d_o + v.dot(-p.n),
                ..p
            }))),
        }
    }

    /// Multiplies points, sizes and distances by k, and leaves normals alone.
    ///
    /// A negative k mirrors in the origin: sizes take |k|. Then what was outward points inward, so
    /// normals turn around, and signed distances, being d = N·P of a point of the face, take |k|.
    fn scaled(self, k: f64) -> Self {
        let (size, turn) = (k.abs(), k.signum());
        match self {
            Self::Sphere(s) => Self::Sphere(Sphere { c: s.c * k, r: s.r * size }),
            Self::Plane(p) => Self::Plane(Plane { n: p.n * turn, d: p.d * size }),
            Self::Box(Faces(pairs)) => Self::Box(Faces(pairs.map(|p| Pair {
                n: p.n * turn,
                c_f: p.c_f * k,
                d_f: p.d_f * size,
                c_o: p.c_o * k,
                d_o: p.d_o * size,
                l: p.l * size,
            }))),
        }
    }

    /// Rotates normals and centres; sizes and distances unchanged.
    fn rotated(self, degrees: Vector) -> Self {
        let turn = |v| rotate(degrees, v);
        match self {
            Self::Sphere(s) => Self::Sphere(Sphere { c: turn(s.c), ..s }),
            Self::Plane(p) => Self::Plane(Plane { n: turn(p.n), ..p }),
            Self::Box(Faces(pairs)) => Self::Box(Faces(pairs.map(|p| Pair {
                n: turn(p.n),
                c_f: turn(p.c_f),
                c_o: turn(p.c_o),
                ..p
            }))),
        }
    }

    pub fn hit(&self, ray: Ray) -> Option<Hit> {
        match self {
            Self::Sphere(sphere) => sphere.hit(ray),
            Self::Plane(plane) => plane.hit(ray),
            Self::Box(faces) => faces.hit(ray),
        }
    }
}

impl Sphere {
    fn hit(&self, ray: Ray) -> Option<Hit> {
        let sc = self.c - ray.s;
        let sa = sc.dot(ray.d);
        if sa <= 0.0 {
            return None; // moving away
        }
        // |AC|² is |SC|² − |SA|², but computed from the vector, as the errata ask.
        let ac = (sc - ray.d * sa).length();
        if ac >= self.r {
            return None;
        }
        let ab = (self.r * self.r - ac * ac).sqrt();
        let t = sa - ab;
        if t < 0.0 {
            return None; // S is inside, B behind it: t ≥ 0 on a ray
        }
        let b = ray.s + ray.d * t;
        Some(Hit { t, point: b, normal: (b - self.c) / self.r })
    }
}

impl Plane {
    fn hit(&self, ray: Ray) -> Option<Hit> {
        if self.n.dot(ray.s) <= self.d {
            return None; // S is on the inner side
        }
        if self.n.dot(ray.d) >= 0.0 {
            return None; // parallel, or moving away
        }
        let t = (self.d - self.n.dot(ray.s)) / self.n.dot(ray.d);
        Some(Hit { t, point: ray.s + ray.d * t, normal: self.n })
    }
}

impl Faces {
    fn hit(&self, ray: Ray) -> Option<Hit> {
        let pairs = &self.0;
        for i in 0..3 {
            let (p, second, third) = (pairs[i], pairs[(i + 1) % 3], pairs[(i + 2) % 3]);
            let slope = ray.d.dot(p.n);
            let (plane, centre) = if slope > 0.0 {
                (Plane { n: -p.n, d: p.d_o }, p.c_o)
            } else if slope < 0.0 {
                (Plane { n: p.n, d: p.d_f }, p.c_f)
            } else {
                continue; // parallel to both
            };
            let Some(hit) = plane.hit(ray) else { continue };
            let from_centre = hit.point - centre;
            if from_centre.dot(second.n).abs() <= second.l
                && from_centre.dot(third.n).abs() <= third.l
            {
                return Some(hit);
            }
        }
        None
    }
}

/// M_z(r_z)·M_y(r_y)·M_x(r_x)·v, angles in degrees, each matrix as the page prints it.
pub fn rotate(degrees: Vector, v: Vector) -> Vector {
    let angle = degrees * (std::f64::consts::PI / 180.0);
    let (s, c) = (sin(angle.x), cos(angle.x));
    let v = Vector::new(v.x, c * v.y - s * v.z, s * v.y + c * v.z);
    let (s, c) = (sin(angle.y), cos(angle.y));
    let v = Vector::new(c * v.x + s * v.z, v.y, -s * v.x + c * v.z);
    let (s, c) = (sin(angle.z), cos(angle.z));
    Vector::new(c * v.x - s * v.y, s * v.x + c * v.y, v.z)
}
