//! Planes against exact arithmetic, also for lines nearly along them.

use super::*;

pub(super) fn random_plane(random: &mut Random) -> (UnitVector, f64) {
    let normal = match random.below(3) {
        0 => [UnitVector::X, UnitVector::Y, -UnitVector::Z][random.below(3)],
        _ => random.direction(),
    };
    (normal, random.number(-1.0, 1.0) * random.size(-8.0, 8.0))
}

#[test]
fn a_plane_is_crossed_where_exact_arithmetic_crosses_it() {
    let mut random = Random(2);
    let mut told = 0;
    for _ in 0..tries() {
        let (normal, distance) = random_plane(&mut random);
        let reach = random.size(-8.0, 8.0);
        let mut direction = random.direction().get();
        if random.below(2) == 0 {
            // Nearly along the plane.
            let off =
                normal.get() * (direction.dot(normal.get()) * (1.0 - random.size(-16.0, 0.0)));
            direction = UnitVector::from_direction(direction - off).unwrap_or(normal).get();
        }
        let ray = Ray { origin: random.point(reach), direction };
        let exact = exact::plane(normal.get(), distance, &ray);
        let chord = Plane { normal, distance }.chord(&ray);
        let Some(Chord { enter, leave }) = chord else { continue };
        let crossing = if enter.t.is_finite() { enter } else { leave };
        if crossing.t.is_finite() && crossing.error < crossing.t.abs() {
            told += 1;
            assert_within(crossing, exact, (normal, distance, ray));
        }
    }
    assert!(told > 4 * tries() / 5, "{told} crossings told from the start");
}

#[test]
fn a_ray_along_a_plane_is_inside_or_misses() {
    let plane = Plane { normal: UnitVector::Y, distance: 1.0 };
    for zero in [0.0, -0.0] {
        let chord = |y| {
            let direction = Vector::new(1.0, zero, 0.0);
            plane.chord(&Ray { origin: Vector::new(0.0, y, 0.0), direction })
        };
        assert_eq!(chord(1.0), None);
        assert_eq!(chord(2.0), None);
        let through = Chord { enter: Crossing::BEFORE_ALL, leave: Crossing::BEYOND_ALL };
        assert_eq!(chord(0.5), Some(through));
    }
    // A slope of 1e-320 is a slope.
    let ray = Ray { origin: Vector::Y * 1.5, direction: Vector::new(1.0, -1e-300, 0.0) };
    let enter = plane.chord(&ray).map(|chord| chord.enter);
    assert!(enter.is_some_and(|enter| enter.is_ahead() && enter.t > 1e299), "{enter:?}");
}

#[test]
fn a_planes_easy_bound_is_no_less_than_its_bound() {
    let mut random = Random(78);
    let mut count = 0;
    for _ in 0..tries() {
        let size = random.size(-100.0, 100.0);
        let plane = Plane { normal: random.direction(), distance: size * random.number(-1.0, 1.0) };
        let far = random.size(-3.0, 9.0);
        let ray = ray_at(&mut random, Vector::ZERO, size, far);
        let Some((speed, t)) = plane.pass(&ray) else { continue };
        let Some(easy) = plane.roughly(&ray, speed, t) else { continue };
        let Some(chord) = plane.chord(&ray) else { panic!("{plane:?} {ray:?}") };
        let tight = if speed > 0.0 { chord.leave } else { chord.enter };
        assert_eq!(easy.t, tight.t);
        assert!(easy.error >= tight.error && tight.is_ahead(), "{plane:?} {ray:?}");
        count += 1;
    }
    assert!(count > tries() / 4, "{count}");
}
