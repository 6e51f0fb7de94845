//! Wholes: found with and without their trees, their surface where membership changes.

use super::*;
use crate::geometry::whole::EVERYWHERE;
use crate::geometry::whole::together::Line;
use crate::shape::body::Body;
use crate::shape::csg::{Event, Events, Node};
use crate::shape::local::Met;
use crate::shape::{Cylinder, Placed};

impl Whole {
    /// Each leaf is tried.
    pub fn without_tree(&self) -> Self {
        let all = Balls::new(&[Ball::EVERYWHERE; balls::LANES]);
        let always = (0..self.leaves.len() as u32).collect();
        Self { always, tree: None, balls: self.balls.map(|_| all), inside: 0, ..self.clone() }
    }
}

fn add_cylinder(world: &mut World, centre: Vector, world_from_local: Matrix) {
    let local_from_world = world_from_local.inverse();
    let placement = Placement { centre, world_from_local, local_from_world };
    let body = std::sync::Arc::new(Body::Cylinder(Cylinder { open: false }));
    world.placed.push(Placed { body, placement, root_tolerance: 0.0, exact: None });
    let shape = Shape::Placed(world.placed.len() as u32 - 1);
    add(world, shape);
}

/// A tree of operations of at most so many levels over new objects that crowd around a place.
fn add_parts(
    world: &mut World,
    random: &mut Random,
    (centre, size): (Vector, f64),
    depth: usize,
    walls: bool,
    nodes: &mut Vec<Node>,
) {
    if depth == 0 || random.below(5) == 0 {
        let place = centre + random.point(size);
        let part = size * random.number(0.2, 1.5);
        match random.below(6) {
            0 | 1 => add_sphere(world, place, part),
            2 => {
                let normal = random.direction();
                add_plane(world, normal, normal.get().dot(place));
            }
            3 => add_box(world, aligned_box(place, [part, part * 0.7, part * 0.4])),
            4 => add_ellipsoid(world, place, random.matrix() * part),
            _ => add_cylinder(world, place, random.matrix() * part),
        }
        let inverse = random.below(3) == 0;
        nodes.push(Node::Leaf { inverse });
        if let Some(object) = world.objects.last_mut() {
            object.inverse = inverse;
            object.csg_solid = Some(world.csg_solids.len() as u32);
            object.casts_shadow = true;
        }
        return;
    }
    let kind = random.below(if walls { 4 } else { 2 });
    let parts = if kind == 3 { 2 } else { random.below(3) + 2 };
    for _ in 0..parts {
        add_parts(world, random, (centre, size), depth - 1, walls, nodes);
    }
    nodes.push(match kind {
        0 => Node::Merge(parts as u32),
        1 => Node::Intersection(parts as u32),
        2 => Node::Union(parts as u32),
        _ => Node::Clip { inverse: random.below(2) == 0 },
    });
}

fn add_whole(
    world: &mut World,
    random: &mut Random,
    place: (Vector, f64),
    depth: usize,
    walls: bool,
) {
    let (first, mut nodes) = (world.objects.len() as u32, Vec::new());
    while nodes.len() < 2 {
        nodes.clear();
        world.objects.truncate(first as usize);
        add_parts(world, random, place, depth, walls, &mut nodes);
    }
    let count = world.objects.len() as u32 - first;
    world.csg_solids.push(crate::world::CsgSolid { nodes, first, count, cutaway: Vec::new() });
}

#[test]
fn trees_find_of_wholes_among_others_what_trying_every_part_finds() {
    let mut random = Random(21);
    let (mut trees, mut met) = (0, 0);
    for scene in 0..200 {
        let reach = random.size(-8.0, 8.0);
        let mut world = random_world(&mut random, [3, 10, 50][scene % 3], reach);
        for _ in 0..random.below(5) + 1 {
            let place = (random.point(reach), reach * random.size(-1.5, -0.3));
            add_whole(&mut world, &mut random, place, 1 + scene % 4, true);
        }
        let geometry = Geometry::build(&world);
        trees += geometry.wholes.iter().filter(|whole| whole.tree.is_some()).count();
        assert_tree_agrees(&world, &mut random, reach, tries_in(1000));
        let ray = random_ray(&mut random, &world, reach);
        let hit = geometry.nearest(&ray);
        met += usize::from(
            hit.is_some_and(|hit| world.objects[hit.object as usize].csg_solid.is_some()),
        );
    }
    assert!(trees > 20 && met > 10, "{trees} trees, {met} met");
}

/// Parts without end, rays from far away and from the midst.
#[test]
fn a_whole_is_entered_and_left_where_membership_changes() {
    let mut random = Random(22);
    let mut ends = 0;
    for scene in 0..100 {
        let size = random.size(-6.0, 6.0);
        let mut world = empty();
        let centre = random.point(size);
        add_whole(&mut world, &mut random, (centre, size), 1 + scene % 5, false);
        let geometry = Geometry::build(&world);
        let Some(whole) = geometry.wholes.first() else { continue };
        for _ in 0..tries_in(500) {
            let ray = random_ray(&mut random, &world, size * 2.0);
            let kept: Vec<f64> =
                geometry.events(whole, &ray).iter().map(|event| event.met.t).collect();
            let leaves = whole.leaves.iter();
            let all = leaves.flat_map(|leaf| geometry.crossings(&leaf.solid, &ray));
            let mut all: Vec<Met> = all.filter(|met| met.t.is_finite()).collect();
            all.sort_by(|a, b| a.t.total_cmp(&b.t));
            for three in all.windows(3) {
                let [last, here, next] = [three[0], three[1], three[2]];
                // What is told apart by far: points are rounded, too.
                let room = 1e3 * (last.error + here.error + next.error)
                    + 1e-12 * (ray.origin.length() + here.t.abs());
                if here.t - last.t < room || next.t - here.t < room {
                    continue;
                }
                let at =
                    |a: f64, b: f64| world.csg_contains(&world.objects[0], ray.at(0.5 * (a + b)));
                let changes = at(last.t, here.t) != at(here.t, next.t);
                assert_eq!(
                    kept.contains(&here.t),
                    changes,
                    "{here:?} {ray:?} {:?}",
                    world.csg_solids
                );
                ends += usize::from(changes);
            }
        }
    }
    assert!(ends > tries() / 200, "{ends}");
}

/// Some parts are outside, and some are flush with one another.
#[test]
fn intersections_are_crossed_where_the_algebra_says() {
    let mut random = Random(27);
    let (mut told, mut cut) = (0, 0);
    for scene in 0..200 {
        let size = random.size(-6.0, 6.0);
        let (mut world, mut nodes) = (empty(), Vec::new());
        let centre = Vector::splat(size) * random.below(3) as f64;
        for _ in 0..2 + random.below(5) {
            add_parts(&mut world, &mut random, (centre, size), 0, false, &mut nodes);
            if let Some(last) = world.boxes.last_mut()
                && scene % 2 == 0
            {
                let steps = [(); 3].map(|()| size * 0.25 * random.below(4) as f64);
                *last = aligned_box(centre + Vector::from_array(steps), [size * 0.5; 3]);
            }
        }
        let count = nodes.len() as u32;
        nodes.push(Node::Intersection(count));
        world.csg_solids.push(crate::world::CsgSolid {
            nodes,
            first: 0,
            count,
            cutaway: Vec::new(),
        });
        let geometry = Geometry::build(&world);
        let Some(whole) = geometry.wholes.first() else { continue };
        let by_algebra = Whole { is_intersection: false, ..whole.clone() };
        for _ in 0..tries_in(300) {
            let ray = random_ray(&mut random, &world, size * 2.0);
            let [events, expected] = [whole, &by_algebra].map(|whole| {
                let events = geometry.events(whole, &ray).into_iter();
                let events = events.map(|event| Event { last: None, ..event });
                events.filter(|event| event.met.is_seen()).collect::<Vec<_>>()
            });
            assert_eq!(events, expected, "{ray:?} {world:?}");
            let (line, mut alone) = (Line::alone(&ray), Events::new());
            let near = line.near(whole);
            if whole.is_intersection
                && geometry.gather_intersection(whole, &line, near, EVERYWHERE, &mut alone)
            {
                told += usize::from(!alone.is_empty());
                cut += usize::from(alone.len() > 2);
            }
        }
    }
    assert!(told > tries() / 50 && cut > tries() / 500, "{told} told, {cut} cut");
}

/// Stands most planes across an axis: of such bounds are made.
fn straighten(world: &mut World, random: &mut Random) {
    for plane in &mut world.planes {
        let axis = [UnitVector::X, UnitVector::Y, UnitVector::Z][random.below(3)];
        let normal = if random.below(2) == 0 { axis } else { -axis };
        if random.below(4) > 0 {
            let distance = normal.get().dot(plane.normal.get() * plane.distance);
            *plane = Plane { normal, distance };
        }
    }
}

/// Beside its sides, too.
#[test]
fn what_is_inside_of_a_whole_lies_within_its_bounds() {
    let mut random = Random(25);
    let (mut inside, mut cut) = (0, 0);
    for scene in 0..400 {
        let size = random.size(-6.0, 6.0);
        let mut world = empty();
        let centre = random.point(size);
        add_whole(&mut world, &mut random, (centre, size), 1 + scene % 4, true);
        straighten(&mut world, &mut random);
        let Extent(bounds) = Extent::of(&world, 0, Rounding::Outward);
        let Extent(nearest) = Extent::of(&world, 0, Rounding::Nearest);
        let is_within = bounds.low.cmple(nearest.low) & nearest.high.cmple(bounds.high);
        assert!(is_within.all(), "{nearest:?} {bounds:?} {world:?}");
        for _ in 0..tries_in(400) {
            let mut point = centre + random.point(size * 2.0);
            let axis = random.below(3);
            let beside = [bounds.low[axis].next_down(), bounds.high[axis].next_up(), point[axis]];
            let place = beside[random.below(3)];
            if place.is_finite() {
                cut += usize::from(place != point[axis]);
                point[axis] = place;
            }
            if world.csg_contains(&world.objects[0], point) {
                assert!(bounds.contains(point), "{point} {bounds:?} {world:?}");
                inside += 1;
            }
        }
    }
    assert!(inside > tries() / 50 && cut > tries() / 50, "{inside} inside, {cut} beside");
}

#[test]
fn trees_find_of_wholes_that_planes_across_axes_cut_what_trying_every_part_finds() {
    let mut random = Random(26);
    for scene in 0..100 {
        let reach = random.size(-8.0, 8.0);
        let mut world = random_world(&mut random, [3, 10, 50][scene % 3], reach);
        for _ in 0..random.below(5) + 1 {
            let place = (random.point(reach), reach * random.size(-1.5, -0.3));
            add_whole(&mut world, &mut random, place, 1 + scene % 4, true);
        }
        straighten(&mut world, &mut random);
        assert_tree_agrees(&world, &mut random, reach, tries_in(1000));
    }
}

/// A block with many balls taken out: a ray asks for those only that it may meet.
#[test]
fn a_block_with_ten_thousand_balls_taken_out_asks_few_of_them() {
    let mut world = empty();
    let mut random = Random(23);
    add_box(&mut world, aligned_box(Vector::ZERO, [50.0, 50.0, 1.0]));
    let mut nodes = vec![Node::Leaf { inverse: false }];
    for i in 0..10_000 {
        let place = Vector::new(f64::from(i % 100) - 49.5, f64::from(i / 100) - 49.5, 1.0);
        add_sphere(&mut world, place, 0.4);
        nodes.push(Node::Leaf { inverse: true });
    }
    nodes.push(Node::Intersection(10_001));
    for object in &mut world.objects {
        object.csg_solid = Some(0);
        object.inverse = object.shape != Shape::Box(0);
    }
    world.csg_solids.push(crate::world::CsgSolid {
        nodes,
        first: 0,
        count: 10_001,
        cutaway: Vec::new(),
    });
    let geometry = Geometry::build(&world);
    let list = without_tree(&geometry);
    let (mut asked, mut balls) = (0, 0);
    let rays = 100;
    for _ in 0..rays {
        let target = Vector::new(random.number(-50.0, 50.0), random.number(-50.0, 50.0), 1.0);
        let origin = target + Vector::new(random.number(-9.0, 9.0), 3.0, 20.0);
        let Some(direction) = UnitVector::from_direction(target - origin) else { continue };
        let ray = Ray { origin, direction: direction.get() };
        geometry.wholes[0].search_within(&ray, (f64::NEG_INFINITY, f64::INFINITY), |_| asked += 1);
        let hit = geometry.nearest(&ray);
        assert_eq!(hit, list.nearest(&ray), "{ray:?}");
        balls += usize::from(hit.is_some_and(|hit| hit.object != 0));
    }
    assert!(asked < 40 * rays && balls > rays / 5, "{asked} asked, {balls} balls");
}

/// A ray from a corner that parts share: it enters and leaves them at 0, one of them at −0.
#[test]
fn a_ray_that_starts_where_parts_begin_and_end_enters_before_it_leaves() {
    for (first, second) in [(2.0, 1.0), (1.0, -2.0), (-1.0, -1.0), (-0.0, 1.0)] {
        for node in [Node::Merge(2), Node::Intersection(2)] {
            let mut world = empty();
            for size in [first, second] {
                let half = 0.5 * size;
                add_box(&mut world, aligned_box(Vector::splat(half), [half.abs(); 3]));
            }
            world.objects.iter_mut().for_each(|object| object.csg_solid = Some(0));
            let leaf = Node::Leaf { inverse: false };
            let nodes = vec![leaf, leaf, node];
            world.csg_solids.push(crate::world::CsgSolid {
                nodes,
                first: 0,
                count: 2,
                cutaway: Vec::new(),
            });
            let geometry = Geometry::build(&world);
            let Some(whole) = geometry.wholes.first() else { continue };
            let mut random = Random(24);
            for _ in 0..tries_in(100) {
                let direction = random.structured_direction().get();
                for origin in [Vector::ZERO, -Vector::ZERO] {
                    let events = geometry.events(whole, &Ray { origin, direction });
                    let ways: Vec<bool> = events.iter().map(|event| event.met.leaving).collect();
                    assert!(ways.iter().step_by(2).all(|leaving| !leaving), "{events:?}");
                }
            }
        }
    }
}
