//! Every kind of body, alone and in wholes: found with and without trees.

use std::collections::BTreeSet;

use super::*;
use crate::road::{Options, Road};
use crate::scene::Dialect;
use crate::shape::Body;
use crate::source::NoFiles;

/// Of size about 1, around the origin.
const SOLIDS: [&str; 32] = [
    "sphere { 0, 1",
    "sphere { 0, 1 scale <1, 0.5, 0.7>",
    "box { -1, <0.5, 1, 0.7>",
    "cylinder { -y, y, 0.6",
    "cylinder { -y, y, 0.6 open",
    "cone { -y, 0.9, y, 0.2",
    "cone { -y, 0.9, y, 0 open",
    "torus { 0.8, 0.25",
    "torus { 0.4, 0.6",
    "disc { 0, y, 1, 0.3",
    "mesh { triangle { x, y, z } triangle { x, y, -x-z } triangle { x, z, -x-z } triangle { y, z, -x-z } inside_vector y",
    "mesh { triangle { -x, x, y } triangle { -x, x, z }",
    "triangle { -x, x, y",
    "prism { -0.5, 0.7, 6, <-1, -1>, <1, -1>, <0.2, 0>, <1, 1>, <-1, 1>, <-1, -1>",
    "prism { conic_sweep cubic_spline 0.2, 1, 7, <-1, -1>, <1, -1>, <1, 1>, <-1, 1>, <-1, -1>, <1, -1>, <1, 1>",
    "lathe { linear_spline 4, <0, -1>, <0.8, -0.6>, <0.3, 0.4>, <0, 1>",
    "lathe { bezier_spline 4, <0.5, -1>, <1.2, -0.5>, <0.2, 0.5>, <0.6, 1>",
    "sor { 5, <0.3, -1.4>, <0.5, -1>, <0.8, 0>, <0.3, 0.8>, <0.2, 1>",
    "sphere_sweep { linear_spline 3, -x, 0.3, y, 0.2, x, 0.4",
    "sphere_sweep { cubic_spline 4, -x-y, 0.3, -x, 0.3, x, 0.2, x+y, 0.3",
    "blob { threshold 0.5 sphere { -0.4*x, 0.9, 1 } cylinder { 0, y, 0.6, 0.8 } sphere { 0.4*z, 0.7, -0.6 }",
    "superellipsoid { <0.4, 1.5>",
    "ovus { 0.6, 0.4",
    "quadric { <1, 2, -1>, <0.2, 0, 0>, 0, -0.4",
    "poly { 4, <1, 0, 0, 0, 2, 0, 0, 2, 0, -1.7, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 2, 0, 1.2, 0, 0, 0, 0, 1, 0, -1.7, 0, 0.3>",
    "isosurface { function { x*x + y*y*(1 + 0.5*sin(5*z)) + z*z - 0.6 } contained_by { sphere { 0, 1 } } max_gradient 9",
    "parametric { function { cos(u)*(0.8 + 0.2*v) } function { sin(u) } function { v } <0, -0.5>, <5, 0.5> contained_by { box { -1.1, 1.1 } }",
    "polygon { 5, <-1, -1>, <1, -1>, <0.7, 1>, <-0.4, 0.6>, <-1, -1>",
    "bicubic_patch { #for (I, 0, 15) <mod(I, 4)/2 - 0.75, mod(I*I, 5)/6, div(I, 4)/2 - 0.75>, #end",
    "height_field { function 7, 6 { 0.5 + 0.4*sin(9*x)*cos(7*y) } translate -0.5",
    "text { \"&\" 0.4, 0 translate -0.3",
    "text { \"o\" 0, 0 translate -0.3",
];

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
        return format!("{} {stretch} {place}", SOLIDS[random.below(SOLIDS.len())]);
    }
    let operation = ["union", "merge", "intersection", "difference"][random.below(4)];
    let parts: String = (0..random.below(3) + 2).map(|_| solid(random, 1.0, depth - 1)).collect();
    // Crowded around the origin, so that they meet.
    let crowd = parts.replace(" translate <", " scale 3 translate 0.3*<");
    let clip = if random.below(4) == 0 { "clipped_by { sphere { 0.3*x, 0.8 } }" } else { "" };
    format!("{operation} {{ {crowd} {clip} {place}")
}

#[test]
fn trees_find_of_every_kind_of_body_what_trying_each_finds() {
    let mut random = Random(65);
    let (mut kinds, mut hits, mut trees) = (BTreeSet::new(), 0, 0);
    for scene in 0..200 {
        let reach = random.size(-4.0, 4.0);
        let count = [9, 20, 40][scene % 3];
        let text: String = (0..count).map(|_| solid(&mut random, reach, 2)).collect();
        let mut road = Road::new(&NoFiles, Options::new(Dialect::Pov));
        let (world, _) = road.compile("bodies.pov", text.clone().into_bytes());
        assert!(!road.diagnostics.has_errors(), "{text}\n{:#?}", road.diagnostics);
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
