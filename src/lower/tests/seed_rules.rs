//! Spending one affine map equals applying the seed's rules for each canonical form in sequence.
//!
//! The rules are written here as its page has them, literally, in `f64`.

use super::build::*;
use crate::math::Vector;
use crate::math::transform::Step;
use crate::shape::Box_;

/// One of the seed's transformations.
#[derive(Debug, Clone, Copy)]
enum Rule {
    Translation(Vector),
    Homothety(f64),
    Rotation(Vector),
}

impl Rule {
    fn step(self) -> Step {
        match self {
            Rule::Translation(by) => Step::Translate(by),
            Rule::Homothety(k) => Step::Scale(v(k, k, k)),
            Rule::Rotation(degrees) => Step::Rotate(degrees),
        }
    }

    fn point(self, p: Vector) -> Vector {
        match self {
            Rule::Translation(by) => p + by,
            Rule::Homothety(k) => p * k,
            Rule::Rotation(degrees) => rotated(p, degrees),
        }
    }

    /// A negative factor mirrors: the outward normal turns with it.
    fn normal(self, n: Vector) -> Vector {
        match self {
            Rule::Translation(_) => n,
            Rule::Homothety(k) => n * k.signum(),
            Rule::Rotation(degrees) => rotated(n, degrees),
        }
    }

    fn size(self, size: f64) -> f64 {
        match self {
            Rule::Homothety(k) => size * k.abs(),
            Rule::Translation(_) | Rule::Rotation(_) => size,
        }
    }

    /// The signed distance of a plane with (new) normal `n`.
    fn distance(self, d: f64, n: Vector) -> f64 {
        match self {
            Rule::Translation(by) => d + by.dot(n),
            Rule::Homothety(k) => d * k.abs(),
            Rule::Rotation(_) => d,
        }
    }
}

/// M_z(rz)·M_y(ry)·M_x(rx)·p.
fn rotated(p: Vector, degrees: Vector) -> Vector {
    let angle = |d: f64| crate::math::elementary::sin_cos_degrees(d);
    let (s, c) = angle(degrees.x);
    let p = v(p.x, c * p.y - s * p.z, s * p.y + c * p.z);
    let (s, c) = angle(degrees.y);
    let p = v(c * p.x + s * p.z, p.y, -s * p.x + c * p.z);
    let (s, c) = angle(degrees.z);
    v(c * p.x - s * p.y, s * p.x + c * p.y, p.z)
}

/// Numbers that are the same in every run.
pub struct Numbers(u64);

impl Numbers {
    pub fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1)
    }

    pub fn below(&mut self, n: u64) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 16) % n
    }

    /// From −size to size.
    pub fn within(&mut self, size: f64) -> f64 {
        (self.below(2_000_001) as f64 / 1_000_000.0 - 1.0) * size
    }

    pub fn vector(&mut self, size: f64) -> Vector {
        v(self.within(size), self.within(size), self.within(size))
    }

    /// Whole eighths from −8 to 8, never zero.
    fn dyadic(&mut self) -> f64 {
        let eighths = self.below(128) as f64 - 64.0;
        (if eighths >= 0.0 { eighths + 1.0 } else { eighths }) / 8.0
    }

    fn dyadic_vector(&mut self) -> Vector {
        v(self.dyadic(), self.dyadic(), self.dyadic())
    }

    fn rule(&mut self, exact: bool) -> Rule {
        match (self.below(3), exact) {
            (0, true) => Rule::Translation(self.dyadic_vector()),
            (0, false) => Rule::Translation(self.vector(5.0)),
            (1, true) => Rule::Homothety([0.5, 2.0, -1.0, -4.0, 0.25][self.below(5) as usize]),
            (1, false) => Rule::Homothety(self.within(2.0) + 0.013),
            (_, true) => {
                let quarter = |n: &mut Self| (n.below(9) as f64 - 4.0) * 90.0;
                Rule::Rotation(v(quarter(self), quarter(self), quarter(self)))
            }
            (_, false) => Rule::Rotation(self.vector(400.0)),
        }
    }
}

struct Case {
    numbers: Numbers,
    rules: Vec<Rule>,
    exact: bool,
    /// What relative errors are allowed.
    tolerance: f64,
}

/// Some hundred sequences of rules; every other one exact in `f64`.
fn cases() -> impl Iterator<Item = Case> {
    (0..300).map(|seed| {
        let mut numbers = Numbers::new(seed);
        let exact = seed % 2 == 0;
        let rules = (0..1 + numbers.below(6)).map(|_| numbers.rule(exact)).collect();
        Case { numbers, rules, exact, tolerance: if exact { 0.0 } else { 1e-12 } }
    })
}

impl Case {
    fn steps(&self) -> Vec<Step> {
        self.rules.iter().map(|rule| rule.step()).collect()
    }

    fn vector(&mut self) -> Vector {
        if self.exact { self.numbers.dyadic_vector() } else { self.numbers.vector(3.0) }
    }

    /// The size of everything on the way, to which rounding errors are relative.
    fn extent(&self, start: Vector) -> f64 {
        let grown = self.rules.iter().scan((start, 1.0f64), |(p, size), rule| {
            *p = rule.point(*p);
            *size = rule.size(*size);
            Some(p.length() + *size)
        });
        grown.fold(1.0 + start.length(), f64::max)
    }

    fn close(&self, a: f64, b: f64, extent: f64) -> bool {
        (a - b).abs() <= self.tolerance * extent
    }
}

#[test]
fn a_sphere_follows_the_rules() {
    for mut case in cases() {
        let (mut centre, mut radius) = (case.vector(), 1.5);
        let extent = case.extent(centre);
        let world = spend(sphere(centre.x, centre.y, centre.z, radius), case.steps());
        for rule in &case.rules {
            (centre, radius) = (rule.point(centre), rule.size(radius));
        }
        let sphere = world.spheres[0];
        assert!(case.close(sphere.centre.distance(centre), 0.0, extent), "{:?}", case.rules);
        assert!(case.close(sphere.radius, radius, radius), "{:?}", case.rules);
    }
}

#[test]
fn a_plane_follows_the_rules() {
    for mut case in cases() {
        let axes = [Vector::X, -Vector::Y, Vector::Z];
        let mut normal = match case.exact {
            true => axes[case.numbers.below(3) as usize],
            false => case.numbers.vector(1.0).normalize(),
        };
        let mut distance = case.vector().x;
        let extent = case.extent(normal * distance);
        let world = spend(plane(normal.x, normal.y, normal.z, distance), case.steps());
        for rule in &case.rules {
            normal = rule.normal(normal);
            distance = rule.distance(distance, normal);
        }
        let plane = world.planes[0];
        assert!(case.close(plane.normal.get().distance(normal), 0.0, 1.0), "{:?}", case.rules);
        assert!(case.close(plane.distance, distance, extent), "{:?}", case.rules);
    }
}

#[test]
fn a_box_follows_the_rules() {
    for mut case in cases() {
        let (a, b) = (case.vector(), case.vector() + v(20.0, 20.0, 20.0));
        let mut centre = (a + b) * 0.5;
        let extent = case.extent(centre);
        let mut sides = [Vector::X, Vector::Y, Vector::Z].map(|n| (n, (b - a).dot(n) * 0.5));
        let world = spend(box_(a, b), case.steps());
        for rule in &case.rules {
            centre = rule.point(centre);
            sides = sides.map(|(normal, size)| (rule.normal(normal), rule.size(size)));
        }
        let Box_ { centre: ours, normals, half_widths } = world.boxes[0];
        assert!(case.close(ours.distance(centre), 0.0, extent), "{:?}", case.rules);
        // Which of the three is the first, and which of a pair is the face and which its opposite,
        // is not the box's own.
        for (normal, size) in sides {
            let same = |n: Vector| {
                case.close(n.distance(normal), 0.0, 1.0)
                    || case.close(n.distance(-normal), 0.0, 1.0)
            };
            let found = (0..3).find(|&i| same(normals[i].get()));
            let i = found.unwrap_or_else(|| panic!("no {normal} in {normals:?}: {:?}", case.rules));
            assert!(case.close(half_widths[i], size, size), "{:?}", case.rules);
        }
    }
}
