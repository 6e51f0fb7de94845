//! Solids in 320 bits, alone and made of others: where a line crosses them.
//!
//! **In:** an [`Object`] as it is written. **Out:** its crossings with any line, in order. **Invariant:** what
//! is made of others is decided between its places: a part's crossings divide the line, and right before and
//! right behind each place it is known what lies inside of what. Crossings that are one make one place.

use super::scene::{Object, Operation, Paint, Solid, Step, Triple};
use super::wide::{Wide, WideMap, WideVector};

/// A solid where it stands.
pub struct Thing<'a> {
    parts: Vec<Part<'a>>,
    tree: Node,
    /// How large the numbers are that its crossings come from, in the world.
    pub size: Wide,
}

/// A solid that is made of nothing else, and the way to the spaces in which it and its paint were written.
pub struct Part<'a> {
    pub object: &'a Object,
    form: Form,
    /// The origin of its form.
    origin: WideVector,
    solid_from_world: Option<WideMap>,
    pub paint_from_world: Option<WideMap>,
}

enum Form {
    /// What is inside of all.
    Limits(Vec<Limit>),
    /// About the y axis.
    Torus { major: Wide, minor: Wide },
}

/// Inside: where f ≤ 0, with p seen from the solid's origin.
#[expect(clippy::large_enum_variant, reason = "a handful in a test")]
enum Limit {
    /// f = n·p − d.
    Flat { normal: WideVector, distance: Wide },
    /// f = pᵀMp + l·p + c. Of two halves the one is meant where `side`·p + `start` > 0.
    Round { matrix: [WideVector; 3], line: WideVector, constant: Wide, side: (WideVector, Wide) },
}

enum Node {
    Leaf(usize),
    Made(Operation, Vec<Node>),
}

pub struct Ray {
    pub start: WideVector,
    pub direction: WideVector,
}

/// A crossing, and the normal there in the world, out of the whole.
#[derive(Clone)]
pub struct Crossing {
    pub t: Wide,
    pub normal: WideVector,
    pub part: usize,
}

/// Where a line is inside of something that is convex.
#[derive(Clone)]
struct Chord {
    /// `None`: it has been inside for ever.
    enter: Option<(Wide, WideVector)>,
    leave: Option<(Wide, WideVector)>,
}

/// What a node is at a place of the line.
struct State {
    before: bool,
    after: bool,
    shown: Option<usize>,
}

impl<'a> Thing<'a> {
    pub fn of(object: &'a Object) -> Self {
        let mut parts = Vec::new();
        let (tree, size) = node(object, None, &mut parts);
        Self { parts, tree, size }
    }

    pub fn part(&self, crossing: &Crossing) -> &Part<'a> {
        &self.parts[crossing.part]
    }

    /// In order, behind the start too. Two distances are one where they differ by less than `least`, or
    /// by less than `touch` of themselves.
    pub fn crossings(&self, ray: &Ray, touch: &Wide, least: &Wide) -> Vec<Crossing> {
        let (mut inside, mut all) = (Vec::new(), Vec::new());
        for (number, part) in self.parts.iter().enumerate() {
            let (starts_inside, crossings) = part.crossings(ray);
            inside.push(starts_inside);
            all.extend(crossings.into_iter().map(|(t, normal)| Crossing {
                t,
                normal,
                part: number,
            }));
        }
        if self.parts.len() == 1 {
            // A box without thickness is one sheet.
            all.dedup_by(|second, first| second.t == first.t);
            return all;
        }
        all.sort_by(|a, b| a.t.partial_cmp(&b.t).expect("ordered"));
        let mut kept = Vec::new();
        let mut rest = all.as_slice();
        while let Some(first) = rest.first() {
            let room = &(touch * &first.t.abs()) + least;
            let here = rest.iter().take_while(|other| &other.t - &first.t <= room).count();
            let (place, behind) = rest.split_at(here);
            let before = inside.clone();
            for crossing in place {
                inside[crossing.part] ^= true;
            }
            let state = self.tree.state(&before, &inside);
            if let Some(part) = state.shown {
                let crossing = place.iter().find(|one| one.part == part).expect("it is crossed");
                // Out of the whole.
                let turned = inside[part] != state.after;
                let toward = Wide::of(if turned { -1.0 } else { 1.0 });
                kept.push(Crossing { normal: crossing.normal.times(&toward), ..crossing.clone() });
            }
            rest = behind;
        }
        kept
    }
}

impl Node {
    fn state(&self, before: &[bool], after: &[bool]) -> State {
        let (operation, nodes) = match self {
            Self::Leaf(part) => {
                let (before, after) = (before[*part], after[*part]);
                return State { before, after, shown: (before != after).then_some(*part) };
            }
            Self::Made(operation, nodes) => (*operation, nodes),
        };
        let inverse = |place: usize| operation == Operation::Difference && place > 0;
        let parts: Vec<State> = nodes.iter().map(|node| node.state(before, after)).collect();
        let holds = |inside: &dyn Fn(&State) -> bool| {
            let mut parts = parts.iter().enumerate().map(|(i, part)| inside(part) != inverse(i));
            match operation {
                Operation::Merge => parts.any(|inside| inside),
                Operation::Intersection | Operation::Difference => parts.all(|inside| inside),
            }
        };
        let (before, after) = (holds(&|part| part.before), holds(&|part| part.after));
        // Of several the first.
        let shown = parts.iter().filter_map(|part| part.shown).min();
        State { before, after, shown: shown.filter(|_| before != after) }
    }
}

/// What an object is, moved by what is around it; and how large its numbers are.
fn node<'a>(
    object: &'a Object,
    outer: Option<&WideMap>,
    parts: &mut Vec<Part<'a>>,
) -> (Node, Wide) {
    let map = joined(outer, spent(&object.steps));
    if let Solid::Whole { operation, parts: held } = &object.solid {
        let nodes: Vec<_> = held.iter().map(|part| node(part, map.as_ref(), parts)).collect();
        let size = nodes.iter().fold(Wide::zero(), |size, (_, more)| size + more);
        let nodes = nodes.into_iter().map(|(node, _)| node).collect();
        return (Node::Made(*operation, nodes), size);
    }
    let (origin, form, reach) = form(&object.solid);
    let size = match &map {
        Some(map) => {
            map.rows.iter().fold(map.offset.largest(), |size, row| size + &(row.largest() * &reach))
        }
        None => reach,
    };
    let world_from_paint = match &object.paint {
        Paint::Plain(_) => None,
        Paint::Checker { steps, .. } => joined(map.as_ref(), spent(steps)),
    };
    parts.push(Part {
        object,
        form,
        origin,
        solid_from_world: map.as_ref().map(WideMap::inverse),
        paint_from_world: world_from_paint.as_ref().map(WideMap::inverse),
    });
    (Node::Leaf(parts.len() - 1), size)
}

/// First the inner map, then the outer one.
fn joined(outer: Option<&WideMap>, inner: Option<WideMap>) -> Option<WideMap> {
    match (outer, inner) {
        (Some(outer), Some(inner)) => Some(outer.after(&inner)),
        (outer, None) => outer.cloned(),
        (None, inner) => inner,
    }
}

/// The origin, the form as seen from there, and the reach of a solid of no parts.
fn form(solid: &Solid) -> (WideVector, Form, Wide) {
    match solid {
        Solid::Sphere { centre, radius } => {
            let origin = WideVector::of(*centre);
            let radius = Wide::of(*radius);
            let reach = &origin.largest() + &radius;
            let constant = -&(radius.clone() * &radius);
            let matrix = WideMap::identity().rows;
            (origin, Form::Limits(vec![round(matrix, zero(), constant)]), reach)
        }
        Solid::Plane { normal, distance } => {
            let normal = WideVector::of(*normal);
            let distance = Wide::of(*distance) * normal.length();
            let reach = distance.abs();
            (zero(), Form::Limits(vec![Limit::Flat { normal, distance }]), reach)
        }
        Solid::Box { corners: [a, b] } => {
            let side = |pick: fn(f64, f64) -> f64| {
                WideVector::of(std::array::from_fn(|i| pick(a[i], b[i])))
            };
            let (low, high) = (side(f64::min), side(f64::max));
            let reach = &low.largest() + &high.largest();
            let face = |axis: usize, sign: f64, distance: Wide| {
                let mut normal = [0.0; 3];
                normal[axis] = sign;
                Limit::Flat { normal: WideVector::of(normal), distance }
            };
            let pair = |axis: usize| {
                [face(axis, -1.0, -&low.0[axis]), face(axis, 1.0, high.0[axis].clone())]
            };
            (zero(), Form::Limits((0..3).flat_map(pair).collect()), reach)
        }
        // With s = w·d/D along the axis, D = d²: |w|²·D − (w·d)² ≤ (r + (r′ − r)·s)²·D.
        Solid::Cone { ends: [a, b], radii: [base, cap] } => {
            let origin = WideVector::of(*a);
            let axis = WideVector::of(*b).minus(&origin);
            let square = axis.square();
            let base = Wide::of(*base);
            let slope = (Wide::of(*cap) - &base) / &square;
            let narrowed = Wide::one() + &(slope.clone() * &slope * &square);
            let row = |i: usize| {
                let mut row = axis.times(&(-&(axis.0[i].clone() * &narrowed)));
                row.0[i] = &row.0[i] + &square;
                row
            };
            let line = axis.times(&(Wide::of(-2.0) * &base * &slope * &square));
            let constant = -&(base.clone() * &base * &square);
            let side = (axis.times(&slope), base.clone());
            let mantle = Limit::Round { matrix: [row(0), row(1), row(2)], line, constant, side };
            let ends = [
                Limit::Flat { normal: axis.times(&Wide::of(-1.0)), distance: Wide::zero() },
                Limit::Flat { normal: axis.clone(), distance: square },
            ];
            let widest = if base > Wide::of(*cap) { base } else { Wide::of(*cap) };
            let reach = origin.largest() + &axis.largest() + &widest;
            let [first, last] = ends;
            (origin, Form::Limits(vec![mantle, first, last]), reach)
        }
        Solid::Torus { major, minor } => {
            let (major, minor) = (Wide::of(*major), Wide::of(*minor));
            let reach = &major + &minor;
            (zero(), Form::Torus { major, minor }, reach)
        }
        Solid::Whole { .. } => unreachable!("it has parts"),
    }
}

fn zero() -> WideVector {
    WideVector::of([0.0; 3])
}

/// With one half only.
fn round(matrix: [WideVector; 3], line: WideVector, constant: Wide) -> Limit {
    Limit::Round { matrix, line, constant, side: (zero(), Wide::one()) }
}

impl Part<'_> {
    /// Whether the line comes from inside, and where it passes the surface, in order.
    fn crossings(&self, ray: &Ray) -> (bool, Vec<(Wide, WideVector)>) {
        let (start, direction) = match &self.solid_from_world {
            Some(map) => (map.point(&ray.start), map.direction(&ray.direction)),
            None => (ray.start.clone(), ray.direction.clone()),
        };
        let start = start.minus(&self.origin);
        let in_world = |(t, normal)| (t, self.world_normal(normal));
        match &self.form {
            Form::Limits(limits) => match chord(limits, &start, &direction) {
                None => (false, Vec::new()),
                Some(Chord { enter, leave }) => {
                    let starts_inside = enter.is_none();
                    let ends = [enter, leave].into_iter().flatten();
                    (starts_inside, ends.map(in_world).collect())
                }
            },
            Form::Torus { major, minor } => {
                (false, torus(major, minor, &start, &direction).map(in_world).collect())
            }
        }
    }

    /// By the inverse transpose.
    fn world_normal(&self, normal: WideVector) -> WideVector {
        match &self.solid_from_world {
            Some(map) => map.normal_before(&normal),
            None => normal,
        }
    }
}

/// Inside of all limits.
fn chord(limits: &[Limit], start: &WideVector, direction: &WideVector) -> Option<Chord> {
    let mut chord = Chord { enter: None, leave: None };
    for limit in limits {
        chord = chord.within(limit.chord(start, direction)?);
    }
    match &chord {
        Chord { enter: Some((enter, _)), leave: Some((leave, _)) } if enter > leave => None,
        _ => Some(chord),
    }
}

/// With k = R² − r²: (p² + k)² = 4R²·(x² + z²).
fn torus(
    major: &Wide,
    minor: &Wide,
    start: &WideVector,
    direction: &WideVector,
) -> impl Iterator<Item = (Wide, WideVector)> {
    let (four, two) = (Wide::of(4.0), Wide::of(2.0));
    let ring = four * &(major.clone() * major);
    let k = major.clone() * major - &(minor.clone() * minor);
    let level = |v: &WideVector| WideVector([v.0[0].clone(), Wide::zero(), v.0[2].clone()]);
    let across = (level(start), level(direction));
    // p² + k and x² + z² as polynomials of t.
    let (a, b) = (direction.square(), two.clone() * &start.dot(direction));
    let c = start.square() + &k;
    let [d, e, f] = [
        across.1.square() * &ring,
        two.clone() * &across.0.dot(&across.1) * &ring,
        across.0.square() * &ring,
    ];
    let quartic = vec![
        c.clone() * &c - &f,
        two.clone() * &b * &c - &e,
        b.clone() * &b + &(two.clone() * &a * &c) - &d,
        two.clone() * &a * &b,
        a.clone() * &a,
    ];
    let middle = -&(start.dot(direction) / &a);
    let half = (major + minor) / &a.sqrt();
    let half = half.clone() + &(half * &Wide::of(0.001));
    let roots = roots(&quartic, &(&middle - &half), &(&middle + &half));
    let (start, direction) = (start.clone(), direction.clone());
    roots.into_iter().map(move |t| {
        let place = start.plus(&direction.times(&t));
        let all = place.square() + &k;
        let normal = place.times(&all).minus(&level(&place).times(&(ring.clone() / &two)));
        (t, normal)
    })
}

/// The roots between two places at which a polynomial, its lowest coefficient first, changes its sign: one
/// between each two neighbours of its derivative's.
fn roots(polynomial: &[Wide], low: &Wide, high: &Wide) -> Vec<Wide> {
    if polynomial.len() < 2 {
        return Vec::new();
    }
    let slope: Vec<Wide> = polynomial
        .iter()
        .zip(0..)
        .skip(1)
        .map(|(coefficient, power)| coefficient.clone() * &Wide::of(f64::from(power)))
        .collect();
    let mut ends = vec![low.clone()];
    ends.extend(roots(&slope, low, high));
    ends.push(high.clone());
    let at = |of: &[Wide], t: &Wide| {
        of.iter().rev().fold(Wide::zero(), |sum, coefficient| sum * t + coefficient)
    };
    let least = (high - low) * &Wide::of(1.0 / 2f64.powi(200));
    let mut found = Vec::new();
    for pair in ends.windows(2) {
        let [mut before, mut behind] = [pair[0].clone(), pair[1].clone()];
        let rises = at(polynomial, &behind).is_positive();
        if at(polynomial, &before).is_positive() == rises {
            continue;
        }
        let mut place = (&before + &behind) * &Wide::of(0.5);
        // Newton's step where it stays between, else half.
        while &behind - &before > least {
            let value = at(polynomial, &place);
            if value.is_positive() == rises {
                behind = place.clone()
            } else {
                before = place.clone()
            }
            let speed = at(&slope, &place);
            let step = if speed.is_zero() { high - low } else { value / &speed };
            let next = &place - &step;
            if step.abs() < least {
                break;
            }
            let is_between = next > before && next < behind;
            place = if is_between { next } else { (&before + &behind) * &Wide::of(0.5) };
        }
        found.push(place);
    }
    found
}

impl Chord {
    fn within(self, other: Self) -> Self {
        let last =
            |a: Option<(Wide, WideVector)>, b: Option<(Wide, WideVector)>, less: bool| match (a, b)
            {
                (Some(a), Some(b)) => Some(if (b.0 < a.0) == less && b.0 != a.0 { b } else { a }),
                (a, b) => a.or(b),
            };
        Self {
            enter: last(self.enter, other.enter, false),
            leave: last(self.leave, other.leave, true),
        }
    }
}

impl Limit {
    /// `None` where the line is never inside. Along a face it is.
    fn chord(&self, start: &WideVector, direction: &WideVector) -> Option<Chord> {
        match self {
            Self::Flat { normal, distance } => {
                let speed = normal.dot(direction);
                let ahead = distance - &normal.dot(start);
                if speed.is_zero() {
                    let is_inside = !ahead.is_negative();
                    return is_inside.then_some(Chord { enter: None, leave: None });
                }
                let crossing = Some((ahead / &speed, normal.clone()));
                Some(match speed.is_positive() {
                    true => Chord { enter: None, leave: crossing },
                    false => Chord { enter: crossing, leave: None },
                })
            }
            Self::Round { matrix, line, constant, side } => {
                let by_matrix =
                    |p: &WideVector| WideVector(matrix.each_ref().map(|row| row.dot(p)));
                let half = Wide::of(0.5);
                let along = by_matrix(direction);
                let a = along.dot(direction);
                let b = along.dot(start) + &(line.dot(direction) * &half);
                let c = by_matrix(start).dot(start) + &line.dot(start) + constant;
                let crossing = |t: Wide| {
                    let place = start.plus(&direction.times(&t));
                    let normal = by_matrix(&place).times(&Wide::of(2.0)).plus(line);
                    Some((t, normal))
                };
                // The half that is meant lies ahead.
                let rises = side.0.dot(direction).is_positive();
                if a.is_zero() {
                    if b.is_zero() {
                        let inside = !c.is_positive();
                        return inside.then_some(Chord { enter: None, leave: None });
                    }
                    let t = -&(c / &(Wide::of(2.0) * &b));
                    return Some(match b.is_positive() {
                        true => Chord { enter: None, leave: crossing(t) },
                        false => Chord { enter: crossing(t), leave: None },
                    });
                }
                let discriminant = b.clone() * &b - &(a.clone() * &c);
                if !discriminant.is_positive() {
                    // Of a cone's two halves a line meets one or both.
                    return a.is_negative().then_some(Chord { enter: None, leave: None });
                }
                let root = discriminant.sqrt();
                let q = if b.is_negative() { root - &b } else { -&(root + &b) };
                let mut roots = [q.clone() / &a, c / &q];
                if roots[1] < roots[0] {
                    roots.swap(0, 1);
                }
                let [first, last] = roots;
                Some(match (a.is_positive(), rises) {
                    (true, _) => Chord { enter: crossing(first), leave: crossing(last) },
                    (false, true) => Chord { enter: crossing(last), leave: None },
                    (false, false) => Chord { enter: None, leave: crossing(first) },
                })
            }
        }
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
