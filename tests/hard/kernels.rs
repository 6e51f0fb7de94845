//! The crossings of single shapes against exact arithmetic: rows 2, 4, 5, 6, 10 and 14.

use lucarne::math::placement::Placement;
use lucarne::math::{Matrix, UnitVector, Vector};
use lucarne::shape::{Box_, Chord, Crossing, Ellipsoid, Plane, Ray, Sphere, SurfacePoint};

use super::wide::{Wide, WideVector};
use crate::dice::{Dice, rays};

const EPS: f64 = f64::EPSILON;

/// Components of directions that have made others fail.
const SLOPES: [f64; 16] = [
    0.0, -0.0, 1.0, -1.0, 5e-324, -5e-324, 1e-310, -1e-310, 1e-160, -1e-160, 1e-17, -1e-17, 1e-9,
    -1e-9, 0.6, -0.8,
];

/// A slab that a ray would take 2¹²⁴ lengths to cross is one that it runs along.
const LEVEL: f64 = 4.0 * f32::MIN_POSITIVE as f64;

fn exactly(v: Vector) -> WideVector {
    WideVector::exactly(v.to_array())
}

/// A·t² + 2·B·t + C, whose roots are where a ray crosses a sphere.
struct Quadratic {
    a: Wide,
    b: Wide,
    c: Wide,
}

impl Quadratic {
    fn of(sphere: &Sphere, ray: &Ray) -> Self {
        let from_centre = exactly(ray.origin).minus(&exactly(sphere.centre));
        let direction = exactly(ray.direction);
        let radius = Wide::exactly(sphere.radius);
        Self {
            a: direction.square(),
            b: from_centre.dot(&direction),
            c: from_centre.square() - &(&radius * &radius),
        }
    }

    /// A quarter of the discriminant.
    fn discriminant(&self) -> Wide {
        &self.b * &self.b - &(&self.a * &self.c)
    }

    fn at(&self, t: f64) -> Wide {
        let t = Wide::exactly(t);
        let twice = Wide::exactly(2.0);
        (&(&(&self.a * &t) + &(&twice * &self.b)) * &t) + &self.c
    }
}

#[test]
fn row_2_a_sphere_of_any_size_is_hit_or_missed_rightly_from_any_distance() {
    let mut dice = Dice(2);
    let (mut hits, mut misses) = (0, 0);
    for _ in 0..rays() {
        let radius = dice.size(-150.0, 150.0);
        let far = dice.size(0.0, 8.0);
        let centre = dice.direction() * (radius * dice.size(-8.0, 8.0));
        let origin = centre + dice.direction() * (radius * far);
        let target = centre + dice.direction() * (radius * dice.one_of(&[0.3, 0.9, 1.0, 1.2]));
        let Some(direction) = UnitVector::from_direction(target - origin) else { continue };
        let sphere = Sphere { centre, radius };
        let ray = Ray { origin, direction: direction.get() };
        let quadratic = Quadratic::of(&sphere, &ray);
        let discriminant = quadratic.discriminant();
        // Squares of what is 1e-150 small are no f64.
        let unit = Wide::exactly(radius).rounded();
        let share = (discriminant.rounded() / &unit / &unit).to_f64();
        let distance = (origin - centre).length() / radius;
        let chord = sphere.chord(&ray);
        if share.abs() > 16.0 * EPS * distance {
            assert_eq!(chord.is_some(), share > 0.0, "h²/r² = {share:e}: {sphere:?} {ray:?}");
        }
        let Some(Chord { enter, leave }) = chord else {
            misses += 1;
            continue;
        };
        hits += 1;
        if share > 16.0 * EPS * distance {
            // Near a touch the root is steeper. Four of L would do but for one ray in millions: a
            // direction's length is 1 within two units in the last place, and t is in lengths.
            let bar = radius * (5.0 * EPS * distance + 8.0 * EPS) / share.sqrt().min(1.0);
            let inside = |t: f64| quadratic.at(t).is_negative();
            let told = |t: f64| (inside(t - bar), inside(t + bar));
            assert_eq!(told(enter.t), (false, true), "enters: {share:e} {sphere:?} {ray:?}");
            assert_eq!(told(leave.t), (true, false), "leaves: {share:e} {sphere:?} {ray:?}");
        }
    }
    assert!(hits > rays() / 4 && misses > rays() / 10, "{hits} hits, {misses} misses");
}

#[test]
fn row_2_normals_of_spheres_are_right() {
    let mut dice = Dice(22);
    for _ in 0..rays() {
        let radius = dice.size(-150.0, 150.0);
        let far = dice.size(0.0, 8.0);
        let centre = dice.direction() * (radius * dice.size(-8.0, 8.0));
        let origin = centre + dice.direction() * (radius * far);
        let target = centre + dice.direction() * (radius * 0.9);
        let Some(direction) = UnitVector::from_direction(target - origin) else { continue };
        let sphere = Sphere { centre, radius };
        let ray = Ray { origin, direction: direction.get() };
        let Some(chord) = sphere.chord(&ray) else { continue };
        let wide = |v: Vector| WideVector::of(v.to_array());
        let from_centre = wide(origin).minus(&wide(centre));
        let (a, b) = (wide(ray.direction).square(), from_centre.dot(&wide(ray.direction)));
        let c = from_centre.square() - &(Wide::of(radius) * Wide::of(radius));
        let discriminant = b.clone() * &b - &(a.clone() * &c);
        let t = -&(b + &discriminant.sqrt()) / &a;
        let normal = from_centre.plus(&wide(ray.direction).times(&t)).unit();
        let off = normal.minus(&wide(sphere.surface(&ray, chord.enter.t).normal)).length().to_f64();
        let distance = (origin - centre).length() / radius;
        let share = (discriminant.sqrt() / &Wide::of(radius)).to_f64();
        let bar = (4.0 * EPS * distance + 8.0 * EPS) / share.min(1.0);
        assert!(off <= bar, "{off:e} {bar:e}: {sphere:?} {ray:?}");
    }
}

/// Whole a² + b² + c² = d².
const QUADRUPLES: [[f64; 4]; 8] = [
    [3.0, 4.0, 0.0, 5.0],
    [1.0, 2.0, 2.0, 3.0],
    [2.0, 3.0, 6.0, 7.0],
    [4.0, 4.0, 7.0, 9.0],
    [1.0, 4.0, 8.0, 9.0],
    [2.0, 6.0, 9.0, 11.0],
    [0.0, 0.0, 1.0, 1.0],
    [5.0, 12.0, 0.0, 13.0],
];

/// A sphere of whole numbers times a power of two, and a point exactly on it.
fn sphere_and_point(dice: &mut Dice) -> (Sphere, Vector) {
    let [a, b, c, d] = dice.one_of(&QUADRUPLES);
    let k = dice.power_of_two(-60, 60);
    let mut place = [a, b, c].map(|n| n * dice.one_of(&[1.0, -1.0]) * k);
    place.rotate_left(dice.below(3));
    let reach = dice.one_of(&[0usize, 10, 1_000_000]);
    let centre =
        Vector::from_array([0; 3].map(|_| (dice.below(2 * reach + 1) as f64 - reach as f64) * k));
    (Sphere { centre, radius: d * k }, centre + Vector::from_array(place))
}

#[test]
fn row_4_a_ray_that_only_touches_is_answered_the_same_way_by_all() {
    let mut dice = Dice(4);
    let (mut exact, mut hits) = (0, 0);
    for _ in 0..rays() {
        // Along an axis, as far off it as the sphere is large: 3, 4, 5 and its kin.
        let k = dice.power_of_two(-60, 60);
        let [a, b, d] = dice.one_of(&[[3.0, 4.0, 5.0], [5.0, 12.0, 13.0], [0.0, 1.0, 1.0]]);
        let zero = dice.one_of(&[0.0, -0.0]);
        let (mut offset, mut ahead) = ([a * k, -b * k, zero], [zero, zero, 1.0]);
        let turn = dice.below(3);
        offset.rotate_left(turn);
        ahead.rotate_left(turn);
        let ahead = Vector::from_array(ahead) * dice.one_of(&[1.0, -1.0]);
        let centre = Vector::from_array([0; 3].map(|_| (dice.below(17) as f64 - 8.0) * k));
        let sphere = Sphere { centre, radius: d * k };
        let far = dice.between(0.0, 100.0).floor() * k;
        let origin = centre + Vector::from_array(offset) - ahead * far;
        let mut ray: Ray = Ray { origin, direction: ahead };
        // Exactly, or a last digit beside.
        if dice.below(2) == 0 {
            let axis = dice.below(3);
            ray.origin[axis] = ray.origin[axis].next_up();
        } else {
            exact += 1;
            assert!(Quadratic::of(&sphere, &ray).discriminant().is_zero());
        }
        let answer = sphere.chord(&ray);
        hits += usize::from(answer.is_some());
        for axis in 0..3 {
            let mirror = |mut v: Vector| {
                v[axis] = -v[axis];
                v
            };
            let there = Sphere { centre: mirror(centre), ..sphere };
            let ray = Ray { origin: mirror(ray.origin), direction: mirror(ray.direction) };
            assert_eq!(there.chord(&ray), answer, "{sphere:?} {ray:?}");
        }
        super::trees::assert_all_agree(&sphere, &ray, answer.as_ref());
    }
    assert!(exact > rays() / 3 && hits > rays() / 10, "{exact} exact, {hits} hits");
}

#[test]
fn row_5_a_ray_that_starts_on_a_sphere_meets_its_far_side_or_nothing() {
    let mut dice = Dice(5);
    let mut met = 0;
    for _ in 0..rays() {
        let (sphere, origin) = sphere_and_point(&mut dice);
        let direction =
            if dice.below(2) == 0 { dice.direction() } else { dice.structured(&SLOPES) };
        let ray = Ray { origin, direction };
        let quadratic = Quadratic::of(&sphere, &ray);
        assert!(quadratic.c.is_zero(), "{sphere:?} {origin}");
        // The roots are 0 and −2·B/A.
        let far = (-&(Wide::exactly(2.0) * &quadratic.b)).rounded() / &quadratic.a.rounded();
        let far = far.to_f64();
        let Some(Chord { enter, leave }) = sphere.chord(&ray) else {
            assert!(far.abs() <= 1e-6 * sphere.radius, "{far:e}: {sphere:?} {ray:?}");
            continue;
        };
        assert!(!enter.is_ahead(), "{enter:?} {sphere:?} {ray:?}");
        if far > 0.0 {
            assert!((leave.t - far).abs() <= leave.error, "{leave:?} {far:e} {sphere:?} {ray:?}");
            if far > 2.0 * leave.error {
                met += 1;
                assert!(leave.is_ahead(), "{leave:?} {far:e} {sphere:?} {ray:?}");
            }
        } else {
            assert!(!leave.is_ahead(), "{leave:?} {sphere:?} {ray:?}");
        }
    }
    assert!(met > rays() / 4, "{met}");
}

#[test]
fn row_5_a_ray_that_starts_on_a_plane_or_a_box_does_not_meet_it_there() {
    let mut dice = Dice(55);
    for _ in 0..rays() {
        let k = dice.power_of_two(-60, 60);
        let whole = |dice: &mut Dice| (dice.below(33) as f64 - 16.0) * k;
        let direction =
            if dice.below(2) == 0 { dice.direction() } else { dice.structured(&SLOPES) };
        let axis = dice.below(3);
        let mut origin = Vector::from_array([0; 3].map(|_| whole(&mut dice)));
        let normal = [UnitVector::X, UnitVector::Y, UnitVector::Z][axis];
        let plane = Plane { normal, distance: origin[axis] };
        let ray = Ray { origin, direction };
        let ahead = plane.chord(&ray).is_some_and(|c| c.enter.is_ahead() || c.leave.is_ahead());
        assert!(!ahead, "{plane:?} {ray:?}");

        let half_widths = [0; 3].map(|_| (dice.below(9) + 1) as f64 * k);
        let centre = Vector::from_array([0; 3].map(|_| whole(&mut dice)));
        let normals = [UnitVector::X, UnitVector::Y, UnitVector::Z];
        let box_ = Box_ { centre, normals, half_widths };
        // On a face, an edge or a corner.
        for i in 0..3 {
            let places = [-1.0, -0.5, 0.0, 0.25, 1.0];
            origin[i] = centre[i] + half_widths[i] * dice.one_of(&places);
        }
        origin[axis] = centre[axis] + half_widths[axis];
        let ray = Ray { origin, direction };
        let on = |i: usize, v: f64| {
            (origin[i] - centre[i] == half_widths[i] && v > LEVEL)
                || (origin[i] - centre[i] == -half_widths[i] && v < -LEVEL)
        };
        let outward = (0..3).any(|i| on(i, direction[i]));
        let Some(Chord { enter, leave }) = box_.chord(&ray) else { continue };
        assert!(!enter.is_ahead(), "{enter:?} {box_:?} {ray:?}");
        assert!(!(outward && leave.is_ahead()), "{leave:?} {box_:?} {ray:?}");
        if !outward && direction[axis] < -LEVEL {
            let exact = (0..3)
                .filter(|&i| direction[i].abs() > LEVEL)
                .map(|i| {
                    let side = half_widths[i].copysign(direction[i]);
                    (side - (origin[i] - centre[i])) / direction[i]
                })
                .fold(f64::INFINITY, f64::min);
            assert!((leave.t - exact).abs() <= leave.error, "{leave:?} {exact:e} {box_:?} {ray:?}");
            assert!(exact <= 2.0 * leave.error || leave.is_ahead(), "{leave:?} {box_:?} {ray:?}");
        }
    }
}

/// Any rotation.
fn turn(dice: &mut Dice) -> Matrix {
    loop {
        let a = dice.direction();
        if let Some(b) = UnitVector::from_direction(a.cross(dice.direction())) {
            return Matrix::from_cols(a, b.get(), a.cross(b.get()));
        }
    }
}

/// A shape, where a ray hit it.
fn any_surface(dice: &mut Dice) -> SurfacePoint {
    let size = dice.size(-6.0, 6.0);
    let middle = dice.direction() * (size * dice.one_of(&[0.0, 1.0, 1e3, 1e6]));
    loop {
        let origin = middle + dice.direction() * (size * dice.size(0.0, 2.0));
        let target = middle + dice.point(size);
        let Some(direction) = UnitVector::from_direction(target - origin) else { continue };
        let ray = Ray { origin, direction: direction.get() };
        let found = match dice.below(4) {
            0 => {
                let sphere = Sphere { centre: middle, radius: size };
                sphere.chord(&ray).map(|chord| sphere.surface(&ray, chord.enter.t))
            }
            1 => {
                let normal = UnitVector::from_unit(dice.direction());
                let plane = Plane { normal, distance: normal.get().dot(middle) };
                plane
                    .chord(&ray)
                    .filter(|c| c.enter.is_ahead())
                    .map(|c| plane.surface(&ray, c.enter.t))
            }
            2 => {
                let stretch = [0; 3].map(|_| size * dice.size(-2.0, 0.0));
                let turn = turn(dice);
                let world_from_local = turn * Matrix::from_diagonal(Vector::from_array(stretch));
                let local_from_world = world_from_local.inverse();
                let placement = Placement { centre: middle, world_from_local, local_from_world };
                let ellipsoid = Ellipsoid { placement };
                ellipsoid.chord(&ray).map(|chord| ellipsoid.surface(&ray, chord.enter.t))
            }
            _ => {
                let normals = [UnitVector::X, UnitVector::Y, UnitVector::Z];
                let box_ = Box_ { centre: middle, normals, half_widths: [0.6 * size; 3] };
                box_.chord(&ray).map(|chord| box_.surface(&ray, chord.enter.t, false))
            }
        };
        if let Some(surface) = found {
            return surface;
        }
    }
}

#[test]
fn row_6_a_ray_that_leaves_a_surface_meets_what_lies_four_errors_off_it() {
    let mut dice = Dice(6);
    for _ in 0..rays() {
        let surface = any_surface(&mut dice);
        let normal = surface.normal * dice.one_of(&[1.0, -1.0]);
        let across = normal.cross(dice.direction());
        let Some(direction) = UnitVector::from_direction(normal + across) else { continue };
        let direction = direction.get();
        let origin = surface.spawn(direction);
        let ray = Ray { origin, direction };
        // What the neighbour says of itself there is its part of the errors.
        let unit = UnitVector::from_unit(normal);
        let at = |distance: f64| Plane { normal: unit, distance };
        let height = normal.dot(surface.point);
        let own = at(height).surface(&Ray { origin, direction: normal }, 0.0).error;
        let gap = 4.0 * (surface.error + own);
        let plane = at(height + gap);
        let ahead = |crossing: Crossing| crossing.is_ahead();
        let met = plane.chord(&ray).is_some_and(|c| ahead(c.enter) || ahead(c.leave));
        assert!(met, "a leak through {plane:?}, {gap:e} off: {surface:?} {ray:?}");
        let size = 1e3 * gap;
        let point = surface.point + normal * (gap + size);
        let own = Sphere { centre: point, radius: size };
        let own = own.surface(&Ray { origin: point, direction: normal }, size).error;
        let gap = gap + 4.0 * own;
        let sphere = Sphere { centre: surface.point + normal * (gap + size), radius: size };
        let Some(chord) = sphere.chord(&Ray { origin, direction: normal }) else {
            panic!("a leak beside {sphere:?}, {gap:e} off: {surface:?}")
        };
        assert!(
            ahead(chord.enter),
            "a leak through {sphere:?}, {gap:e} off: {surface:?} {chord:?}"
        );
    }
}

#[test]
fn row_10_a_ray_along_a_plane_is_inside_or_misses_and_a_slope_is_a_slope() {
    let mut dice = Dice(10);
    let (mut along, mut sloping) = (0, 0);
    for _ in 0..rays() {
        let k = dice.power_of_two(-60, 60);
        // The last two are at right angles, to the last digit.
        let normals = [Vector::X, Vector::Y, -Vector::Z, Vector::new(0.6, 0.8, 0.0)];
        let normal = dice.one_of(&normals);
        let mut direction = dice.structured(&SLOPES);
        if dice.below(2) == 0 {
            let zero = dice.one_of(&[0.0, -0.0, 5e-324, -1e-320]);
            direction = Vector::new(-0.8, 0.6, zero) * dice.one_of(&[1.0, -1.0]);
        }
        let origin = Vector::from_array([0; 3].map(|_| (dice.below(9) as f64 - 4.0) * k));
        let height = normal.dot(origin);
        let beside = if height == 0.0 { EPS * k } else { height.next_up() };
        let distance = dice.one_of(&[height, beside, -0.0, k, -3.0 * k]);
        let plane = Plane { normal: UnitVector::from_unit(normal), distance };
        let ray = Ray { origin, direction };
        let chord = plane.chord(&ray);
        let speed = exactly(normal).dot(&exactly(direction));
        let inside = Wide::exactly(distance) - &exactly(normal).dot(&exactly(origin));
        if let Some(Chord { enter, leave }) = chord {
            assert!(![enter.t, enter.error, leave.t, leave.error].iter().any(|x| x.is_nan()));
        }
        let lone = normal.abs().element_sum() == 1.0;
        let t = if speed.is_zero() { 0.0 } else { (inside.rounded() / &speed.rounded()).to_f64() };
        if speed.is_zero() || (lone && t.abs() >= f64::MAX) {
            along += 1;
            // The place of a slanted plane is only known to within rounding.
            let through = Chord { enter: Crossing::BEFORE_ALL, leave: Crossing::BEYOND_ALL };
            if height == distance {
                // In the plane it meets nothing, and is inside of one of the two half spaces.
                let other = Plane { normal: UnitVector::from_unit(-normal), distance: -distance };
                let both = [chord, other.chord(&ray)];
                assert!(both.contains(&None) && both.contains(&Some(through)), "{plane:?} {ray:?}");
            } else if lone {
                assert_eq!(chord, inside.is_positive().then_some(through), "{plane:?} {ray:?}");
            }
        } else if lone {
            sloping += 1;
            let Some(Chord { enter, leave }) = chord else {
                panic!("a slope of {:e} is missed: {plane:?} {ray:?}", speed.to_f64())
            };
            let crossing = if speed.is_negative() { enter } else { leave };
            assert!(
                crossing.t == t || (crossing.t - t).abs() <= crossing.error,
                "{crossing:?} {t:e} {plane:?} {ray:?}"
            );
        }
    }
    assert!(along > rays() / 10 && sloping > rays() / 10, "{along} along, {sloping} sloping");
}

#[test]
fn row_14_a_box_answers_structured_rays_as_rational_slabs_do() {
    let mut dice = Dice(14);
    let (mut hits, mut misses) = (0, 0);
    for _ in 0..rays() {
        let k = dice.power_of_two(-60, 60);
        let whole = |dice: &mut Dice| (dice.below(17) as f64 - 8.0) * k;
        let centre = Vector::from_array([0; 3].map(|_| whole(&mut dice)));
        // One in eight is flat.
        let half_widths = [0; 3].map(|_| dice.below(8) as f64 * k);
        let normals = [UnitVector::X, UnitVector::Y, UnitVector::Z];
        let box_ = Box_ { centre, normals, half_widths };
        let places = [-2.0, -1.0, -0.5, -0.0, 0.5, 1.0, 3.0];
        let place = [0, 1, 2].map(|i| centre[i] + half_widths[i] * dice.one_of(&places));
        let parts: &[f64] =
            dice.one_of(&[&[-1.0, -0.0, 0.0, 1.0][..], &SLOPES[..], &[1.0, -1.0, 0.5, -0.25, 0.0]]);
        let ray = Ray { origin: Vector::from_array(place), direction: dice.structured(parts) };
        let [enter, leave] = exact_slabs(&box_, &ray);
        let chord = box_.chord(&ray);
        let met = match (&enter, &leave) {
            (Some(enter), Some(leave)) => enter <= leave,
            _ => false,
        };
        let Some(chord) = chord else {
            misses += 1;
            assert!(!met, "a hole: {box_:?} {ray:?}");
            continue;
        };
        hits += 1;
        let Chord { enter: near, leave: far } = chord;
        assert!(![near.t, near.error, far.t, far.error].iter().any(|x| x.is_nan()));
        let (Some(enter), Some(leave)) = (enter, leave) else {
            panic!("a false hit: {box_:?} {ray:?}")
        };
        let within = |crossing: Crossing, exact: &Wide| {
            let off = (exact - &Wide::of(crossing.t)).abs();
            off <= Wide::of(crossing.error)
        };
        if met {
            assert!(within(near, &enter) && within(far, &leave), "{chord:?} {box_:?} {ray:?}");
        } else {
            let gap = (enter - &leave).to_f64();
            assert!(gap <= near.error + far.error, "{gap:e}: {chord:?} {box_:?} {ray:?}");
        }
    }
    assert!(hits > rays() / 20 && misses > rays() / 20, "{hits} hits, {misses} misses");
}

/// Where the line enters the last slab and leaves the first; none where it is outside of one.
fn exact_slabs(box_: &Box_, ray: &Ray) -> [Option<Wide>; 2] {
    let (mut enter, mut leave): (Option<Wide>, Option<Wide>) = (None, None);
    for axis in 0..3 {
        let place = Wide::of(ray.origin[axis]) - Wide::of(box_.centre[axis]);
        let half = Wide::of(box_.half_widths[axis]);
        let speed = Wide::of(ray.direction[axis]);
        if ray.direction[axis].abs() <= LEVEL {
            if place.abs() > half {
                return [None, None];
            }
            continue;
        }
        let side = if speed.is_negative() { -&half } else { half };
        let (near, far) = ((-&side - &place) / &speed, (side - &place) / &speed);
        if enter.as_ref().is_none_or(|enter| near > *enter) {
            enter = Some(near);
        }
        if leave.as_ref().is_none_or(|leave| far < *leave) {
            leave = Some(far);
        }
    }
    [enter, leave]
}
