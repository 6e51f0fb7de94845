//! Bodies in 320 bits: where a line crosses one, and how it looks alone under a lamp.
//!
//! **Invariant:** a surface is where a polynomial of the place is 0. Along a line it is one of the distance;
//! along an axis its slope is the normal. Nothing here comes from lucarne.

use super::held::{apart, rendered};
use super::scene::Triple;
use super::sturm::roots;
use super::wide::{Wide, WideMap, WideVector};

/// A polynomial in t; the coefficient of 1 comes first.
#[derive(Clone)]
pub struct Powers(Vec<Wide>);

impl Powers {
    pub fn constant(c: &Wide) -> Self {
        Self(vec![c.clone()])
    }

    fn linear(at: &Wide, slope: &Wide) -> Self {
        Self(vec![at.clone(), slope.clone()])
    }

    pub fn plus(&self, other: &Self) -> Self {
        let none = Wide::zero();
        let term = |powers: &Self, k: usize| powers.0.get(k).unwrap_or(&none).clone();
        let count = self.0.len().max(other.0.len());
        Self((0..count).map(|k| term(self, k) + &term(other, k)).collect())
    }

    pub fn times(&self, other: &Self) -> Self {
        let mut product = vec![Wide::zero(); self.0.len() + other.0.len() - 1];
        for (i, a) in self.0.iter().enumerate() {
            for (j, b) in other.0.iter().enumerate() {
                product[i + j] = &product[i + j] + &(a * b);
            }
        }
        Self(product)
    }

    pub fn by(&self, factor: f64) -> Self {
        self.times(&Self::constant(&Wide::of(factor)))
    }

    pub fn less(&self, c: f64) -> Self {
        self.plus(&Self::constant(&Wide::of(-c)))
    }

    pub fn square(&self) -> Self {
        self.times(self)
    }

    /// Where it is 0: of degree 2 or less everywhere, else within a range.
    fn zeros(&self, range: &(Wide, Wide)) -> Vec<Wide> {
        let none = Wide::zero();
        let [c, b, a] = [0, 1, 2].map(|k| self.0.get(k).unwrap_or(&none));
        if self.0.iter().skip(3).any(|c| !c.is_zero()) {
            return roots(&self.0, range);
        }
        if a.is_zero() {
            return if b.is_zero() { Vec::new() } else { vec![(-c) / b] };
        }
        let half = b * &Wide::of(0.5);
        let discriminant = half.clone() * &half - &(a * c);
        if !discriminant.is_positive() {
            return Vec::new();
        }
        let root = discriminant.sqrt();
        let q = if half.is_negative() { root - &half } else { -&(root + &half) };
        let mut both = vec![q.clone() / a, c.clone() / &q];
        both.sort_by(|a, b| a.partial_cmp(b).expect("ordered"));
        both
    }
}

/// A polynomial of a place, by its coordinates.
type Form = Box<dyn Fn(&[Powers; 3]) -> Powers>;
/// Whether a place of a surface is there to be seen.
type Shown = Box<dyn Fn(&WideVector) -> bool>;

pub struct Solid {
    surfaces: Vec<(Form, Shown)>,
    /// How far it reaches from its own origin, where surfaces are of a degree above 2.
    reach: f64,
    own_from_world: Option<WideMap>,
}

impl Solid {
    fn everywhere(form: Form, reach: f64) -> Self {
        Self { surfaces: vec![(form, Box::new(|_| true))], reach, own_from_world: None }
    }

    /// A cylinder, or a cone with one tip or two.
    pub fn tapered(ends: [Triple; 2], radii: [f64; 2], open: bool) -> Self {
        let [a, b] = ends.map(WideVector::of);
        let axis = b.minus(&a);
        let square = axis.square();
        let [base, cap] = radii.map(Wide::of);
        let slope = &cap - &base;
        // D times how far along the axis.
        let along = {
            let (a, axis) = (a.clone(), axis.clone());
            move |p: &[Powers; 3]| {
                let parts = (0..3).map(|i| {
                    p[i].plus(&Powers::constant(&-&a.0[i])).times(&Powers::constant(&axis.0[i]))
                });
                parts.reduce(|sum, part| sum.plus(&part)).expect("three")
            }
        };
        // D²·|f|² − D·(f·w)² − (D·r + (r′ − r)·f·w)²
        let mantle: Form = {
            let (a, along, square) = (a.clone(), along.clone(), square.clone());
            let (base, slope) = (base.clone(), slope.clone());
            Box::new(move |p| {
                let constant = |c: &Wide| Powers::constant(c);
                let parts = (0..3).map(|i| p[i].plus(&constant(&-&a.0[i])).square());
                let distance = parts.reduce(|sum, part| sum.plus(&part)).expect("three");
                let along = along(p);
                let width = along.times(&constant(&slope)).plus(&constant(&(&square * &base)));
                let distance = distance.times(&constant(&(&square * &square)));
                let taken = along.square().times(&constant(&square)).plus(&width.square());
                distance.plus(&taken.by(-1.0))
            })
        };
        let between: Shown = {
            let (a, axis, square) = (a.clone(), axis.clone(), square.clone());
            Box::new(move |p| {
                let along = p.minus(&a).dot(&axis);
                !along.is_negative() && along <= square
            })
        };
        let mut surfaces = vec![(mantle, between)];
        if !open {
            for (end, at, radius) in [(a, Wide::zero(), base), (b, square, cap)] {
                let along = along.clone();
                let flat: Form = Box::new(move |p| along(p).plus(&Powers::constant(&-&at)));
                let within = move |p: &WideVector| p.minus(&end).square() <= &radius * &radius;
                surfaces.push((flat, Box::new(within)));
            }
        }
        Self { surfaces, reach: 0.0, own_from_world: None }
    }

    /// About the y axis: (|p|² + R² − r²)² = 4R²·(x² + z²).
    pub fn torus(major: f64, minor: f64) -> Self {
        let [large, small] = [major, minor].map(|r| Wide::of(r) * Wide::of(r));
        let form = move |[x, y, z]: &[Powers; 3]| {
            let across = x.square().plus(&z.square());
            let rest = Powers::constant(&(&large - &small));
            let sum = across.plus(&y.square()).plus(&rest);
            sum.square().plus(&across.times(&Powers::constant(&large)).by(-4.0))
        };
        Self::everywhere(Box::new(form), 2.0 * (major + minor))
    }

    /// As `quadric` has them: of squares, of mixed products, of coordinates, and 1.
    pub fn quadric(squares: Triple, mixed: Triple, linear: Triple, one: f64) -> Self {
        let form = move |p: &[Powers; 3]| {
            let [x, y, z] = p;
            let pairs = [x.times(y), x.times(z), y.times(z)];
            let sum = (0..3).map(|i| {
                let parts =
                    [p[i].square().by(squares[i]), pairs[i].by(mixed[i]), p[i].by(linear[i])];
                parts.into_iter().reduce(|sum, part| sum.plus(&part)).expect("three")
            });
            sum.reduce(|sum, part| sum.plus(&part)).expect("three").less(-one)
        };
        Self::everywhere(Box::new(form), 0.0)
    }

    /// Under a map from its own space to the world.
    pub fn under(self, world_from_own: &WideMap) -> Self {
        Self { own_from_world: Some(world_from_own.inverse()), ..self }
    }

    /// Where a line crosses it, and which surface.
    fn crossings(&self, start: &WideVector, direction: &WideVector) -> Vec<(Wide, usize)> {
        let (start, direction) = match &self.own_from_world {
            Some(map) => (&map.point(start), &map.direction(direction)),
            None => (start, direction),
        };
        let place: [Powers; 3] =
            std::array::from_fn(|i| Powers::linear(&start.0[i], &direction.0[i]));
        let middle = (-&start.dot(direction)) / &direction.square();
        let reach = Wide::of(self.reach) / &direction.length();
        let range = (&middle - &reach, &middle + &reach);
        let is_near = || {
            let nearest = start.plus(&direction.times(&middle));
            self.reach == 0.0 || nearest.square() < Wide::of(self.reach) * Wide::of(self.reach)
        };
        let mut found = Vec::new();
        for (number, (form, shown)) in self.surfaces.iter().enumerate() {
            let zeros = if is_near() { form(&place).zeros(&range) } else { Vec::new() };
            let seen = zeros.into_iter().filter(|t| shown(&start.plus(&direction.times(t))));
            found.extend(seen.map(|t| (t, number)));
        }
        found.sort_by(|a, b| a.0.partial_cmp(&b.0).expect("ordered"));
        found
    }

    /// Of a surface at a point of it, in the world, of any length and on either side.
    fn normal(&self, surface: usize, point: &WideVector) -> WideVector {
        let own = match &self.own_from_world {
            Some(map) => map.point(point),
            None => point.clone(),
        };
        let (zero, one) = (Wide::zero(), Wide::one());
        let slope = |axis: usize| {
            let place: [Powers; 3] = std::array::from_fn(|i| {
                Powers::linear(&own.0[i], if i == axis { &one } else { &zero })
            });
            self.surfaces[surface].0(&place).0[1].clone()
        };
        let normal = WideVector(std::array::from_fn(slope));
        match &self.own_from_world {
            Some(map) => map.normal_before(&normal),
            None => normal,
        }
    }
}

/// A camera by its vectors, and a lamp; parallel rays where there is no `right` but in the location.
pub struct View {
    pub location: Triple,
    pub direction: Triple,
    pub right: Triple,
    pub up: Triple,
    pub lamp: Triple,
    /// `ambient` and `diffuse`.
    pub finish: [f64; 2],
}

const BACKGROUND: Triple = [0.2, 0.3, 0.5];
const CLAY: Triple = [0.9, 0.5, 0.2];
/// Odd: a ray goes through the very middle.
const SIZE: (u32, u32) = (29, 21);
/// A pixel is off when a channel is farther than this from the exact one.
const OFF: f64 = 0.03;
/// A pixel whose exact colour changes by more than that so near its centre, in pixels, is not judged.
const NEAR: f64 = 1e-3;

impl View {
    /// From so far away along a direction, four sizes wide where it looks.
    pub fn of(toward: Triple, far: f64, size: f64) -> Self {
        let length = toward.iter().map(|c| c * c).sum::<f64>().sqrt();
        let location = toward.map(|c| c / length * far);
        let side = (toward[0] * toward[0] + toward[2] * toward[2]).sqrt();
        let right = [toward[2] / side, 0.0, -toward[0] / side];
        let up: Triple = std::array::from_fn(|i| {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            (toward[j] * right[k] - toward[k] * right[j]) / length
        });
        Self {
            location,
            direction: location.map(|c| -c),
            right: right.map(|c| c * 4.0 * size),
            up: up.map(|c| c * 3.0 * size),
            lamp: [3.0, 5.0, 4.0].map(|c| c * size),
            finish: [0.1, 0.7],
        }
    }

    pub fn unlit(self) -> Self {
        Self { finish: [1.0, 0.0], ..self }
    }

    /// `solid` is a text without its last brace.
    pub fn text(&self, solid: &str) -> String {
        let [location, direction, right, up, lamp, clay, background] =
            [self.location, self.direction, self.right, self.up, self.lamp, CLAY, BACKGROUND]
                .map(|[x, y, z]| format!("<{x:e}, {y:e}, {z:e}>"));
        let [ambient, diffuse] = self.finish;
        format!(
            "camera {{ location {location} direction {direction} right {right} up {up} }}
             background {{ rgb {background} }} light_source {{ {lamp}, rgb 1 }}
             {solid} pigment {{ rgb {clay} }} finish {{ ambient {ambient:e} diffuse {diffuse:e} }} }}"
        )
    }

    fn exact(&self, solid: &Solid, x: f64, y: f64) -> Triple {
        let (width, height) = SIZE;
        let half = Wide::of(0.5);
        let u = Wide::of(x) / Wide::of(width.into()) - half.clone();
        let v = half - Wide::of(y) / Wide::of(height.into());
        let [right, up] = [&self.right, &self.up].map(|v| WideVector::of(*v));
        let start = WideVector::of(self.location);
        let direction = WideVector::of(self.direction).plus(&right.times(&u)).plus(&up.times(&v));
        let all = solid.crossings(&start, &direction);
        let Some((t, surface)) = all.into_iter().find(|(t, _)| t.is_positive()) else {
            return BACKGROUND;
        };
        let point = start.plus(&direction.times(&t));
        let normal = solid.normal(surface, &point);
        let way = WideVector::of(self.lamp).minus(&point);
        let (seen, lit) = (direction.dot(&normal), way.dot(&normal));
        let [ambient, diffuse] = self.finish;
        let touch = Wide::of(1.0 / 2f64.powi(100));
        let is_hidden = || {
            let between = |(t, _): &(Wide, usize)| *t > touch && *t < Wide::one();
            solid.crossings(&point, &way).iter().any(between)
        };
        let mut strength = ambient;
        if diffuse > 0.0 && seen.is_negative() != lit.is_negative() && !is_hidden() {
            strength += diffuse * (lit.abs() / &(way.length() * normal.length())).to_f64();
        }
        CLAY.map(|c| c * strength)
    }

    /// Asserts that no pixel of the picture is bad.
    #[track_caller]
    pub fn hold(&self, name: &str, solid: &str, exact: &Solid) {
        let text = self.text(solid);
        let film = rendered(&text, SIZE);
        let (mut bad, mut unjudged, mut shown) = (Vec::new(), 0, 0);
        for (x, y) in (0..SIZE.1).flat_map(|y| (0..SIZE.0).map(move |x| (x, y))) {
            let at = |dx: f64, dy: f64| {
                self.exact(exact, f64::from(x) + 0.5 + dx, f64::from(y) + 0.5 + dy)
            };
            let expected = at(0.0, 0.0);
            shown += usize::from(apart(expected, BACKGROUND) > OFF);
            let seen = film.radiance(film.index(x, y)).components();
            if apart(seen, expected) <= OFF {
                continue;
            }
            let around = (0..8).map(|eighth| {
                let angle = 45.0 * f64::from(eighth);
                lucarne::math::elementary::sin_cos_degrees(angle)
            });
            let changes = |(s, c): (f64, f64)| apart(at(NEAR * c, NEAR * s), expected) > OFF;
            if around.into_iter().any(changes) {
                unjudged += 1;
            } else {
                bad.push((x, y, seen, expected));
            }
        }
        let count = bad.len();
        bad.truncate(4);
        assert!(count == 0, "{name}: {count} bad, {unjudged} not judged: {bad:?}\n{text}");
        assert!(
            shown > 8 && 8 * unjudged <= shown,
            "{name}: {shown}, {unjudged} not judged\n{text}"
        );
    }
}
