//! Boxes against exact arithmetic, at their edges and side by side.

use super::*;

pub(super) fn random_box(random: &mut Random) -> Box_ {
    let size = random.size(-8.0, 8.0);
    let normals = loop {
        let normals = match random.below(3) {
            0 => [UnitVector::X, -UnitVector::Y, UnitVector::Z],
            1 => {
                let a = random.direction().get();
                let b = a.cross(random.direction().get());
                let Some(b) = UnitVector::from_direction(b) else { continue };
                let Some(c) = UnitVector::from_direction(a.cross(b.get())) else { continue };
                [UnitVector::from_unit(a), b, c]
            }
            _ => [random.direction(), random.direction(), random.direction()],
        };
        let [a, b, c] = normals.map(UnitVector::get);
        if a.dot(b.cross(c)).abs() > 1e-3 {
            break normals;
        }
    };
    let half_widths =
        [0; 3].map(|_| if random.below(20) == 0 { 0.0 } else { size * random.size(-3.0, 0.0) });
    let centre = random.direction().get() * (size * random.size(-8.0, 4.0));
    Box_ { centre, normals, half_widths }
}

/// A point in or on the box: each coordinate inside, on a face, or in the middle.
pub(super) fn point_of(random: &mut Random, box_: &Box_) -> Vector {
    let edges = [0, 1, 2].map(|axis| box_.face(axis).centre - box_.centre);
    edges.into_iter().fold(box_.centre, |sum, edge| {
        sum + edge * [-1.0, 0.0, 1.0, random.number(-1.1, 1.1)][random.below(4)]
    })
}

#[test]
fn a_box_is_crossed_where_exact_arithmetic_crosses_it() {
    let mut random = Random(3);
    let (mut hits, mut misses) = (0, 0);
    for _ in 0..tries() {
        let box_ = random_box(&mut random);
        let size = box_.half_widths.iter().copied().fold(0.0, f64::max);
        let target = point_of(&mut random, &box_);
        let origin = target + random.direction().get() * (size * random.size(-1.0, 9.0));
        let Some(direction) = UnitVector::from_direction(target - origin) else { continue };
        let ray = Ray { origin, direction: direction.get() };
        let [enter, leave] = exact::slabs(&box_, &ray);
        match box_.chord(&ray) {
            Some(chord) => {
                hits += 1;
                let slack = chord.enter.error + chord.leave.error;
                assert!((leave - enter).0 >= -slack, "a false hit of {box_:?} {ray:?}");
                if chord.enter.t < chord.leave.t {
                    assert_within(chord.enter, enter, (box_, ray));
                    assert_within(chord.leave, leave, (box_, ray));
                }
            }
            None => {
                misses += 1;
                assert!((leave - enter).0 <= 0.0, "a hole in {box_:?} {ray:?}");
            }
        }
    }
    assert!(hits > tries() / 3 && misses > tries() / 50, "{hits} hits, {misses} misses");
}

#[test]
fn a_box_answers_structured_rays_without_a_nan() {
    let cube = Box_ {
        centre: Vector::ZERO,
        normals: [UnitVector::X, UnitVector::Y, UnitVector::Z],
        half_widths: [1.0; 3],
    };
    let places = [-2.0, -1.0, -0.0, 0.0, 0.5, 1.0, 2.0];
    let slopes = [-1.0, -1e-310, -1e-160, -0.0, 0.0, 1e-300, 1e-17, 1.0];
    let mut random = Random(4);
    for _ in 0..tries() {
        let origin = Vector::from_array([0; 3].map(|_| places[random.below(7)]));
        let v = Vector::from_array([0; 3].map(|_| slopes[random.below(8)]));
        let Some(direction) = UnitVector::from_direction(v) else { continue };
        let ray = Ray { origin, direction: direction.get() };
        let Some(chord) = cube.chord(&ray) else { continue };
        assert!(!chord.enter.t.is_nan() && !chord.leave.t.is_nan(), "{ray:?} {chord:?}");
        assert!(!chord.enter.error.is_nan() && !chord.leave.error.is_nan(), "{ray:?} {chord:?}");
        assert!(chord.enter.t <= chord.leave.t, "{ray:?} {chord:?}");
        for (crossing, leaving) in [(chord.enter, false), (chord.leave, true)] {
            if crossing.t.abs() < 1e10 {
                let surface = cube.surface(&ray, crossing.t, leaving);
                let above = exact::above_face(&cube, surface.face, surface.point);
                assert!(above.abs() <= surface.error && surface.point.is_finite(), "{ray:?}");
            }
        }
    }
}

#[test]
fn a_wall_of_boxes_has_no_holes_where_they_touch() {
    let mut random = Random(5);
    for _ in 0..tries() {
        let [a, b, c] = [0; 3].map(|_| random.direction());
        let size = random.size(-4.0, 4.0);
        let half_widths = [size; 3];
        let left = Box_ { centre: random.point(1e3), normals: [a, b, c], half_widths };
        let seam = left.face(0).centre;
        let right = Box_ { centre: seam + (seam - left.centre), ..left };
        let target =
            seam + b.get().cross(c.get()).cross(a.get()) * (size * random.number(-0.3, 0.3));
        let origin = target + random.direction().get() * (size * 20.0);
        let Some(direction) = UnitVector::from_direction(target - origin) else { continue };
        let ray = Ray { origin, direction: direction.get() };
        // The right box's centre was rounded: as far as that opens a gap it is a gap.
        let gap =
            exact::above_face(&right, 1, seam).abs() + exact::above_face(&left, 0, seam).abs();
        if gap < 1e-13 * size {
            assert!(left.chord(&ray).is_some() || right.chord(&ray).is_some(), "{left:?} {ray:?}");
        }
    }
}

#[test]
fn a_face_is_told_in_the_seeds_terms() {
    let box_ = Box_ {
        centre: Vector::new(1.0, 2.0, 3.0),
        normals: [UnitVector::X, UnitVector::Y, UnitVector::Z],
        half_widths: [0.5, 1.0, 2.0],
    };
    let face = box_.face(1);
    assert_eq!(face.normal, UnitVector::Y);
    assert_eq!((face.centre, face.distance), (Vector::new(1.0, 3.0, 3.0), 3.0));
    assert_eq!((face.opposite_centre, face.opposite_distance), (Vector::new(1.0, 1.0, 3.0), -1.0));
    assert_eq!(face.half_width, 1.0);
    let low = box_.corners().into_iter().fold(Vector::INFINITY, Vector::min);
    assert_eq!(low, Vector::new(0.5, 1.0, 1.0));
    assert_eq!(box_.signed_distance(Vector::new(1.25, 2.0, 3.0)), 0.25);
    assert_eq!(box_.signed_distance(Vector::new(3.0, 2.0, 3.0)), -1.5);
    assert!(box_.contains(box_.centre) && !box_.contains(box_.face(2).centre));
}
