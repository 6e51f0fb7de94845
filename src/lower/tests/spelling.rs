//! Two spellings of one thing give one World.

use super::build::*;
use crate::math::transform::Step;
use crate::scene::{ModifierKind, ObjectId, ObjectKind, Operation, Solid};
use crate::shape::csg::Node;
use crate::world::World;

/// Both spellings of one object, textured with a checker in the world.
fn assert_same(a: (ObjectKind, Vec<Step>), b: (ObjectKind, Vec<Step>)) {
    let spell = |(kind, steps)| -> World {
        let mut build = Build::new();
        let transform = ModifierKind::Transform(build.transform(steps));
        let object = build.object(kind, vec![transform, ModifierKind::Texture(CHECKER)]);
        build.root(object);
        build.world()
    };
    assert_eq!(spell(a), spell(b));
}

#[test]
fn turned_by_a_quarter_or_written_so() {
    let turn = || vec![rotate(0.0, 0.0, 90.0)];
    let box_a = box_(v(1.0, 2.0, 3.0), v(2.0, 5.0, 9.0));
    assert_same((box_a.clone(), turn()), (box_(v(-5.0, 1.0, 3.0), v(-2.0, 2.0, 9.0)), vec![]));
    assert_same((plane(1.0, 0.0, 0.0, 2.5), turn()), (plane(0.0, 3.0, 0.0, 2.5), vec![]));
    assert_same((sphere(1.0, 0.0, 0.5, 2.0), turn()), (sphere(0.0, 1.0, 0.5, 2.0), vec![]));
    let whole =
        || vec![rotate(0.0, 360.0, -720.0), rotate(90.0, 0.0, 0.0), rotate(-90.0, 0.0, 0.0)];
    assert_same((box_a.clone(), whole()), (box_a, vec![]));
}

#[test]
fn corners_in_any_order() {
    let straight = box_(v(-1.0, 0.5, 2.0), v(3.0, 4.0, 5.0));
    assert_same((straight, vec![]), (box_(v(3.0, 0.5, 5.0), v(-1.0, 4.0, 2.0)), vec![]));
}

#[test]
fn scaled_or_written_so() {
    let steps = || vec![scale(0.5, 0.5, 0.5), translate(0.25, 0.0, 8.0)];
    assert_same((sphere(2.0, 4.0, 6.0, 3.0), steps()), (sphere(1.25, 2.0, 11.0, -1.5), vec![]));
    assert_same((plane(0.0, -1.0, 0.0, 3.0), steps()), (plane(0.0, -2.0, 0.0, 1.5), vec![]));
    let unit = box_(v(-1.0, -1.0, -1.0), v(1.0, 1.0, 1.0));
    assert_same(
        (unit, vec![scale(1.0, -2.0, 3.0)]),
        (box_(v(-1.0, 2.0, -3.0), v(1.0, -2.0, 3.0)), vec![]),
    );
}

#[test]
fn an_ellipsoid_does_not_remember_how_its_sphere_was_turned() {
    let ball = || sphere(0.0, 0.0, 0.0, 1.0);
    let long = || scale(1.0, 2.0, 4.0);
    assert_same((ball(), vec![rotate(90.0, 0.0, 180.0), long()]), (ball(), vec![long()]));
    assert_same(
        (ball(), vec![long(), rotate(0.0, 0.0, 90.0)]),
        (ball(), vec![scale(2.0, 1.0, 4.0)]),
    );
    assert_same((sphere(0.0, 0.0, 0.0, 0.5), vec![scale(2.0, 4.0, -8.0)]), (ball(), vec![long()]));
    let turned = spend(ball(), vec![rotate(10.0, 20.0, 30.0), long()]).ellipsoids[0].placement;
    let straight = spend(ball(), vec![long()]).ellipsoids[0].placement;
    assert!(turned.world_from_local.abs_diff_eq(straight.world_from_local, 1e-15));
    assert!(turned.local_from_world.abs_diff_eq(straight.local_from_world, 1e-15));
}

#[test]
fn what_is_undone_was_never_done() {
    let there = || vec![scale(3.0, 7.0, 11.0), rotate(12.0, 34.0, 56.0), translate(0.1, 0.2, 0.3)];
    let ball = || sphere(1.0, 2.0, 3.0, 4.0);
    let under = |last: &dyn Fn(&mut Build) -> Vec<Step>| {
        let mut build = Build::new();
        let steps = last(&mut build);
        let object = build.moved(ball(), steps);
        build.root(object);
        build.world()
    };
    let ours = under(&|build| {
        let mut back = there();
        back.push(Step::InverseOf(build.transform(there())));
        back
    });
    assert_eq!(ours.spheres, spend(sphere(1.0, 2.0, 3.0, 4.0), vec![]).spheres);
    let twice = under(&|build| {
        let once = build.transform(there());
        let undone = build.transform(vec![Step::InverseOf(once)]);
        vec![Step::InverseOf(undone)]
    });
    let once = spend(sphere(1.0, 2.0, 3.0, 4.0), there());
    let (twice, once) = (twice.ellipsoids[0].placement, once.ellipsoids[0].placement);
    assert!(twice.world_from_local.abs_diff_eq(once.world_from_local, 1e-14));
    assert!(twice.centre.distance(once.centre) < 1e-14);
}

#[test]
fn a_matrix_or_the_steps_it_says() {
    let matrix =
        Step::Matrix([v(0.0, 2.0, 0.0), v(-2.0, 0.0, 0.0), v(0.0, 0.0, 2.0), v(1.0, 0.0, 3.0)]);
    let steps = vec![scale(2.0, 2.0, 2.0), rotate(0.0, 0.0, 90.0), translate(1.0, 0.0, 3.0)];
    assert_same((sphere(1.0, 2.0, 3.0, 1.0), vec![matrix]), (sphere(1.0, 2.0, 3.0, 1.0), steps));
}

#[test]
fn an_inverse_plane_is_the_plane_turned_round() {
    let mut build = Build::new();
    let object = build.object(plane(0.0, 1.0, 0.0, 2.0), vec![ModifierKind::Inverse]);
    build.root(object);
    assert_eq!(build.world(), spend(plane(0.0, -1.0, 0.0, -2.0), vec![]));
}

#[test]
fn unions_and_uses_leave_no_trace() {
    let mut build = Build::new();
    let ball = build.moved(sphere(0.0, 0.0, 0.0, 1.0), vec![translate(1.0, 0.0, 0.0)]);
    let used = build.moved(ObjectKind::Use(ball), vec![scale(2.0, 2.0, 2.0)]);
    let turned = build.object(ObjectKind::Use(ball), vec![ModifierKind::Inverse]);
    let inner = build.object(ObjectKind::Union(vec![used, turned]), vec![]);
    let outer = build.moved(ObjectKind::Union(vec![inner, ball]), vec![translate(0.0, 5.0, 0.0)]);
    let again = build.object(ObjectKind::Use(outer), vec![]);
    build.root(again);
    let mut plain = Build::new();
    for (centre, radius, inverse) in [
        (v(2.0, 5.0, 0.0), 2.0, false),
        (v(1.0, 5.0, 0.0), 1.0, true),
        (v(1.0, 5.0, 0.0), 1.0, false),
    ] {
        let modifiers = if inverse { vec![ModifierKind::Inverse] } else { vec![] };
        let ball = plain.object(ObjectKind::Solid(Solid::Sphere { centre, radius }), modifiers);
        plain.root(ball);
    }
    assert_eq!(build.world(), plain.world());
}

/// De Morgan: what is outside of all is what the outsides share.
#[test]
fn an_inverse_goes_down_to_the_leaves() {
    let spell = |kind: &dyn Fn(Vec<ObjectId>) -> ObjectKind, inner: bool| {
        let mut build = Build::new();
        let inverse = |on: bool| if on { vec![ModifierKind::Inverse] } else { vec![] };
        let ball = build.object(sphere(0.0, 0.0, 0.0, 1.0), inverse(inner));
        let block = build.object(box_(v(0.0, 0.0, 0.0), v(1.0, 2.0, 3.0)), inverse(inner));
        let whole = build.object(kind(vec![ball, block]), inverse(!inner));
        build.root(whole);
        build.world()
    };
    let csg = |operation, children| ObjectKind::Csg { operation, children };
    let union = spell(&ObjectKind::Union, false);
    assert_eq!(union, spell(&|all| csg(Operation::Intersection, all), true));
    assert_eq!(union.csg_solids.len(), 1);
    let shared = spell(&|all| csg(Operation::Intersection, all), false);
    assert_eq!(shared, spell(&|all| csg(Operation::Merge, all), true));
}

#[test]
fn a_difference_is_what_the_first_and_the_outsides_of_the_others_share() {
    let spell = |operation, inverse: Vec<ModifierKind>| {
        let mut build = Build::new();
        let ball = build.object(sphere(0.0, 0.0, 0.0, 1.0), vec![]);
        let block = build.object(box_(v(0.0, 0.0, 0.0), v(1.0, 2.0, 3.0)), inverse);
        build.root(ball);
        let children = vec![ball, block];
        let whole = build.object(ObjectKind::Csg { operation, children }, vec![]);
        build.root(whole);
        build.world()
    };
    let world = spell(Operation::Difference, vec![]);
    assert_eq!(world, spell(Operation::Intersection, vec![ModifierKind::Inverse]));
    let nodes = &world.csg_solids[0].nodes;
    let [solid, hole] = [false, true].map(|inverse| Node::Leaf { inverse });
    assert_eq!(nodes.as_slice(), [solid, hole, Node::Intersection(2)]);
}

/// An operation on one part is that part.
#[test]
fn a_whole_of_one_leaf_is_no_whole() {
    let mut build = Build::new();
    let ball = build.object(sphere(0.0, 0.0, 0.0, 1.0), vec![]);
    let children = vec![ball];
    let inner = ObjectKind::Csg { operation: Operation::Intersection, children };
    let inner = build.object(inner, vec![]);
    let outer = ObjectKind::Csg { operation: Operation::Difference, children: vec![inner] };
    let outer = build.moved(outer, vec![translate(1.0, 0.0, 0.0)]);
    build.root(outer);
    assert_eq!(build.world(), spend(sphere(1.0, 0.0, 0.0, 1.0), vec![]));
}

#[test]
fn a_pigment_scaled_with_its_object_or_by_itself() {
    let spell = |radius: f64, grow_pigment: bool| {
        let mut build = Build::new();
        let grow = || vec![scale(2.0, 2.0, 2.0)];
        let steps = if grow_pigment { grow() } else { vec![] };
        let pigment = build.pigment(checker(), steps);
        let texture = ModifierKind::Texture(build.texture(pigment, vec![]));
        let moved = build.transform(if grow_pigment { vec![] } else { grow() });
        let modifiers = vec![texture, ModifierKind::Transform(moved)];
        let object = build.object(sphere(0.0, 0.0, 0.0, radius), modifiers);
        build.root(object);
        build.world()
    };
    assert_eq!(spell(1.0, false), spell(2.0, true));
}
