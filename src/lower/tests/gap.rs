//! Solids that lie to two sides of a plane, turned any way: that they do not meet is told, and nothing else.

use super::build::*;
use crate::diagnostic::Code;
use crate::math::Vector;
use crate::math::random::{Random, tries};
use crate::scene::{ModifierKind, ObjectKind, Operation, Solid};

/// A solid that ends at `x` = `end` and lies to the side of `side` there, its other measures drawn at random.
fn beside(random: &mut Random, end: f64, side: f64) -> ObjectKind {
    let far = end + side * random.number(0.5, 3.0);
    let at = |x: f64, y: f64| v(x, y, 0.0);
    match random.below(4) {
        0 => plane(-side, 0.0, 0.0, -side * end),
        1 => box_(v(end, -1.0, -2.0), v(far, 1.5, 0.5)),
        2 => {
            let ends = [at(end, 0.25), at(far, 0.25)];
            ObjectKind::Solid(Solid::Cylinder { ends, radius: 0.75, open: false })
        }
        _ => {
            let ends = [at(end, 0.5), at(far, 0.5)];
            ObjectKind::Solid(Solid::Cone { ends, radii: [0.5, 0.25], open: false })
        }
    }
}

/// What is told of two solids under one turn, of which the second begins `gap` behind the end of the first.
fn told(random: &mut Random, gap: f64, complement: bool) -> bool {
    let mut build = Build::new();
    let [turn, shift] = [random.point(180.0), random.point(3.0)];
    let steps = vec![rotate(turn.x, turn.y, turn.z), translate(shift.x, shift.y, shift.z)];
    let end = random.number(-1.0, 1.0);
    let solids = [beside(random, end, -1.0), beside(random, end + gap, 1.0)];
    let [first, second] = solids.map(|solid| build.moved(solid, steps.clone()));
    let second = match complement {
        true => {
            let inverse = vec![ModifierKind::Inverse];
            build.object(ObjectKind::Use(second), inverse)
        }
        false => second,
    };
    let operation = if complement { Operation::Difference } else { Operation::Intersection };
    let whole = build.object(ObjectKind::Csg { operation, children: vec![first, second] }, vec![]);
    build.root(whole);
    build.codes().contains(&Code::NothingLeft)
}

#[test]
fn what_touches_in_a_slanted_face_has_nothing_in_common() {
    let mut random = Random(1);
    for i in 0..tries() / 8 {
        assert!(told(&mut random, 0.0, i % 2 == 0), "{i}");
    }
}

#[test]
fn a_gap_across_slanted_faces_is_told() {
    let mut random = Random(2);
    for i in 0..tries() / 8 {
        let gap = random.size(-9.0, 1.0);
        assert!(told(&mut random, gap, i % 2 == 0), "{i}: {gap}");
    }
}

#[test]
fn what_overlaps_a_little_across_slanted_faces_is_not_told() {
    let mut random = Random(3);
    for i in 0..tries() / 8 {
        let overlap = random.size(-9.0, -0.5);
        assert!(!told(&mut random, -overlap, i % 2 == 0), "{i}: {overlap}");
    }
}

#[test]
fn balls_that_touch_in_a_point_have_nothing_in_common_and_deeper_ones_have() {
    let mut random = Random(4);
    for _ in 0..tries() / 8 {
        let (centre, way) = (random.point(2.0), random.direction().get());
        let [a, b] = [random.number(0.1, 2.0), random.number(0.1, 2.0)];
        for (gap, is_told) in [(0.0, true), (1e-9, true), (-1e-9, false)] {
            let mut build = Build::new();
            let other: Vector = centre + way * (a + b + gap);
            let balls = [(centre, a), (other, b)]
                .map(|(centre, radius)| ObjectKind::Solid(Solid::Sphere { centre, radius }));
            let children = balls.map(|ball| build.object(ball, vec![])).to_vec();
            let operation = Operation::Intersection;
            let whole = build.object(ObjectKind::Csg { operation, children }, vec![]);
            build.root(whole);
            assert_eq!(build.codes().contains(&Code::NothingLeft), is_told, "{gap}");
        }
    }
}
