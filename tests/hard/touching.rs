//! Solids that touch in a plane in which the camera looks: one of the two has the ray, and not both.

use crate::held::rendered;

/// Solids below and above of y = 0, of the same width there.
const PAIRS: &[[&str; 2]] = &[
    ["box { <-1, -1, -1>, <1, 0, 1>", "box { <-1, 0, -1>, <1, 1, 1>"],
    ["cylinder { -y, 0, 1", "cylinder { 0, y, 1"],
    ["cylinder { -y, 0, 1 open", "cylinder { 0, y, 1 open"],
    ["cone { -y, 0.5, 0, 1", "cone { 0, 1, y, 0.5"],
    [
        "prism { -1, 0, 4, <-1, -1>, <1, -1>, <1, 1>, <-1, 1>",
        "prism { 0, 1, 4, <-1, -1>, <1, -1>, <1, 1>, <-1, 1>",
    ],
    [
        "sor { 4, <0.5, -2>, <0.8, -1>, <1, 0>, <0.9, 1>",
        "sor { 4, <0.8, -1>, <1, 0>, <0.9, 1>, <0.5, 2>",
    ],
    [
        "isosurface { function { -1 } contained_by { box { <-1, -1, -1>, <1, 0, 1> } }",
        "isosurface { function { -1 } contained_by { box { <-1, 0, -1>, <1, 1, 1> } }",
    ],
    [
        "intersection { sphere { 0, 1 } plane { y, 0 }",
        "intersection { sphere { 0, 1 } plane { -y, 0 }",
    ],
    ["difference { sphere { 0, 1 } plane { -y, 0 }", "difference { sphere { 0, 1 } plane { y, 0 }"],
    [
        "difference { box { -1, 1 } cylinder { 0, 2*y, 3 }",
        "difference { box { -1, 1 } cylinder { -2*y, 0, 3 }",
    ],
    ["box { <-1, -1, -1>, <1, 0, 1>", "cylinder { 0, y, 1"],
];

const MAPS: &[&str] = &[
    "translate 0",
    "translate <0.1, 0.3, 0.7>",
    "rotate <13, 0, 31>",
    "scale <1.3, 0.7, -0.9>",
    "rotate <3, 7, 31> scale <1.1, 0.3, 2> rotate 40*y translate <0.1, 0.3, 0.7>",
    "scale 1e-5 translate <1, 2, 3>*1e-4",
];

/// The middle row of a picture, and the one below: where something is seen.
fn rows(things: &str, map: &str) -> [Vec<bool>; 2] {
    let film = rendered(
        &format!(
            "#declare Way = function {{ transform {{ {map} }} }}
             #declare Middle = Way(0, 0, 0);
             #declare From = Way(0.0123, 0, -5);
             camera {{ location From direction Middle - From
                      right 0.8*(Way(1, 0, 0) - Middle) up 0.6*(Way(0, 1, 0) - Middle) }}
             background {{ rgb <1, 0, 0> }} {things}"
        ),
        (81, 61),
    );
    [30, 31].map(|y| (0..81).map(|x| film.radiance[film.index(x, y)].red < 0.5).collect())
}

const PAINT: &str = "pigment { rgb <0, 1, 0> } finish { emission 1 }";

#[test]
fn no_ray_slips_through_between_two_solids_that_touch() {
    for [below, above] in PAIRS {
        for map in MAPS {
            for group in ["union", "merge"] {
                let things = format!("{group} {{ {below} }} {above} }} {PAINT} {map} }}");
                let [middle, next] = rows(&things, map);
                assert!(middle == next, "{things}");
            }
            let things = format!("{below} {PAINT} {map} }} {above} {PAINT} {map} }}");
            let [middle, next] = rows(&things, map);
            assert!(middle == next, "{things}");
        }
    }
}

#[test]
fn nothing_is_in_two_solids_that_touch() {
    // A box has its faces.
    let without_box = PAIRS.iter().filter(|[below, _]| !below.starts_with("box"));
    for [below, above] in without_box {
        for map in MAPS {
            let both = format!("intersection {{ {below} }} {above} }} {PAINT} {map} }}");
            let [middle, next] = rows(&both, map);
            assert!(!middle.contains(&true) && !next.contains(&true), "{both}");
        }
    }
}
