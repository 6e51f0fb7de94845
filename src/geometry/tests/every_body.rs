//! Every kind of body, alone and in wholes: found with and without trees.

use std::collections::BTreeSet;

use super::*;
use crate::road::{Options, Road};
use crate::scene::Dialect;
use crate::shape::Body;
use crate::source::NoFiles;

/// Of size about 1, around the origin; the last brace is missing.
const SIMPLE: [&str; 3] =
    ["sphere { 0, 1", "sphere { 0, 1 scale <1, 0.5, 0.7>", "box { -1, <0.5, 1, 0.7>"];
const BODIES: &str = include_str!("../../../tests/bodies.txt");

fn number(random: &mut Random, size: f64) -> String {
    format!(
        "<{:e}, {:e}, {:e}>",
        random.number(-size, size),
        random.number(-size, size),
        random.number(-size, size)
    )
}

/// One of the solids, or several as one, in any place and size.
fn solid(random: &mut Random, reach: f64, depth: usize) -> String {
    let size = reach * random.size(-1.5, -0.5);
    let place = format!(
        "rotate {} scale {size:e} translate {} }}\n",
        number(random, 180.0),
        number(random, reach)
    );
    if depth == 0 || random.below(3) > 0 {
        let stretch = if random.below(3) == 0 { "scale <1, 0.6, 1.7>" } else { "" };
        let solids: Vec<&str> = SIMPLE.into_iter().chain(BODIES.lines()).collect();
        return format!("{} {stretch} {place}", solids[random.below(solids.len())]);
    }
    let operation = ["union", "merge", "intersection", "difference"][random.below(4)];
    let parts: String = (0..random.below(3) + 2).map(|_| solid(random, 1.0, depth - 1)).collect();
    // Crowded around the origin, so that they meet.
    let crowd = parts.replace(" translate <", " scale 3 translate 0.3*<");
    let clip = if random.below(4) == 0 { "clipped_by { sphere { 0.3*x, 0.8 } }" } else { "" };
    format!("{operation} {{ {crowd} {clip} {place}")
}

/// Solids of every kind, some of them as one.
pub(super) fn crowd(random: &mut Random, reach: f64, count: usize) -> World {
    let text: String = (0..count).map(|_| solid(random, reach, 2)).collect();
    let mut road = Road::new(&NoFiles, Options::new(Dialect::Pov));
    let (world, _) = road.compile("bodies.pov", text.clone().into_bytes());
    assert!(!road.diagnostics.has_errors(), "{text}\n{:#?}", road.diagnostics);
    world
}

#[test]
fn trees_find_of_every_kind_of_body_what_trying_each_finds() {
    let mut random = Random(65);
    let (mut kinds, mut hits, mut trees) = (BTreeSet::new(), 0, 0);
    for scene in 0..200 {
        let reach = random.size(-4.0, 4.0);
        let count = [9, 20, 40][scene % 3];
        let world = crowd(&mut random, reach, count);
        kinds.extend(world.placed.iter().map(|placed| placed.body.word()));
        assert_tree_agrees(&world, &mut random, reach, tries_in(2000));
        let geometry = Geometry::build(&world);
        trees += usize::from(geometry.tree.is_some());
        let ray = random_ray(&mut random, &world, reach);
        hits += usize::from(geometry.nearest(&ray).is_some());
    }
    let missing: Vec<_> = Body::WORDS.iter().filter(|word| !kinds.contains(*word)).collect();
    assert!(missing.is_empty(), "never there: {missing:?}");
    assert!(hits > 20 && trees > 150, "{hits} hits, {trees} trees");
}
