//! Solids that touch in a plane in which the camera looks: one of the two has the ray, and not both.

use super::held::rendered;

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
        "prism { -1, 1, 4, <-1, -1>, <1, -1>, <1, 0>, <-1, 0> rotate -90*x",
        "prism { -1, 1, 4, <-1, 0>, <1, 0>, <1, 1>, <-1, 1> rotate -90*x",
    ],
    [
        "prism { -1, 1, 4, <-1, -1>, <1, -1>, <1, 0>, <-1, 0> rotate -90*x",
        "prism { -1, 1, 4, <-1, -1>, <1, -1>, <1, 0>, <-1, 0> rotate 90*x",
    ],
    [
        "prism { -1, 1, 4, <-1, -1>, <1, -1>, <1, 0>, <-1, 0> rotate -90*x",
        "prism { -1, 1, 5, <-1, 0>, <1, 0>, <1, 1>, <0, 0.5>, <-1, 1> rotate -90*x",
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
    [
        "lathe { linear_spline 4, <0, -1>, <1, -1>, <1, 0>, <0, 0>",
        "lathe { linear_spline 5, <0.2, 0>, <1, 0>, <1, 1>, <0.2, 1>, <0.2, 0>",
    ],
    ["cylinder { -y, 0, 1", "lathe { linear_spline 4, <0, 0>, <1, 0>, <1, 1>, <0, 1>"],
    ["lathe { linear_spline 3, <0, -1>, <0.8, -0.5>, <1, 0>", "cone { 0, 1, y, 0.5"],
];

/// A closed mesh from y = −1 to 0.
const MESH: &str = "mesh2 { vertex_vectors { 8, <-1, -1, -1>, <1, -1, -1>, <-1, 0, -1>, <1, 0, -1>,
     <-1, -1, 1>, <1, -1, 1>, <-1, 0, 1>, <1, 0, 1> }
     face_indices { 12, <0, 1, 2>, <1, 2, 3>, <4, 5, 6>, <5, 6, 7>, <0, 1, 4>, <1, 4, 5>,
     <2, 3, 6>, <3, 6, 7>, <0, 2, 4>, <2, 4, 6>, <1, 3, 5>, <3, 5, 7> } inside_vector <0.1, 0.9, 0.3> }";

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
    [30, 31].map(|y| (0..81).map(|x| film.radiance(film.index(x, y)).red < 0.5).collect())
}

const PAINT: &str = "pigment { rgb <0, 1, 0> } finish { emission 1 }";

#[test]
fn no_ray_slips_through_between_two_solids_that_touch() {
    for [below, above] in PAIRS {
        for map in MAPS {
            for group in ["union", "merge"] {
                let things = format!("{group} {{ {below} }} {above} }} {PAINT} {map} }}");
                let [middle, next] = rows(&things, map);
                assert!(middle == next, "{things}\n{middle:?}\n{next:?}");
            }
            let things = format!("{below} {PAINT} {map} }} {above} {PAINT} {map} }}");
            let [middle, next] = rows(&things, map);
            assert!(middle == next, "{things}");
        }
    }
}

#[test]
fn nothing_is_in_two_solids_that_touch() {
    for [below, above] in PAIRS {
        for map in MAPS {
            // Another part, in which both lie, for no short cut to be taken.
            let others = ["", "union { sphere { 0, 3 } sphere { x, 3 } }"];
            for beside in others.into_iter().take(if *map == MAPS[0] { 2 } else { 1 }) {
                let both = format!("{below} }} {above} }} {beside}");
                let both = format!("intersection {{ {both} {PAINT} {map} }}");
                let [middle, next] = rows(&both, map);
                assert!(!middle.contains(&true) && !next.contains(&true), "{both}");
            }
        }
    }
}

/// Where the middle row of a picture, and those above and below, show the front of a thing, its back, or nothing.
fn three_rows(thing: &str, map: &str, away: f64) -> [Vec<char>; 3] {
    let film = rendered(
        &format!(
            "#declare Way = function {{ transform {{ {map} }} }}
             #declare Middle = Way(0, 0, 0);
             #declare From = Way(0.0123, 0, -{away});
             camera {{ location From direction Middle - From
                      right {away}*0.55*(Way(1, 0, 0) - Middle) up {away}*0.4*(Way(0, 1, 0) - Middle) }}
             background {{ rgb <1, 0, 0> }}
             {thing} pigment {{ gradient z scale 4 translate -2*z
                                color_map {{ [0.5 rgb <0, 1, 0>] [0.5 rgb <0, 0, 1>] }} }}
             finish {{ emission 1 }} {map} }}"
        ),
        (81, 61),
    );
    [29, 30, 31].map(|y| {
        let told = |x| {
            let colour = film.radiance(film.index(x, y));
            if colour.red > 0.5 {
                ' '
            } else if colour.green > 0.5 {
                'f'
            } else {
                'b'
            }
        };
        (0..81).map(told).collect()
    })
}

#[test]
fn a_camera_in_the_plane_of_a_face_of_a_mesh_sees_what_is_seen_from_beside_it() {
    for parts in [
        "union { MESH",
        "difference { MESH cylinder { <0.1, -0.3, -2>, <0.1, -0.3, 2>, 0.45 }",
        "intersection { MESH box { <-0.6, -2, -0.7>, <0.7, 2, 0.6> }",
        "difference { MESH sphere { <0, 0, -1>, 0.5 }",
    ] {
        let thing = parts.replace("MESH", MESH);
        for map in MAPS {
            for away in [1.3, 5.0] {
                let [above, middle, below] = three_rows(&thing, map, away);
                assert!(middle == above || middle == below, "{parts} {map} {away}\n{middle:?}");
            }
        }
    }
}

#[test]
fn no_ray_slips_through_between_a_mesh_and_another_solid_that_touch() {
    let prism = "prism { 0, 1, 4, <-1, -1>, <1, -1>, <1, 1>, <-1, 1>";
    for above in ["box { <-1, 0, -1>, <1, 1, 1>", prism] {
        for map in MAPS {
            let things = format!("union {{ {MESH} {above} }} {PAINT} {map} }}");
            let [middle, next] = rows(&things, map);
            assert!(middle == next, "{things}");
        }
    }
}

#[test]
fn rays_through_an_edge_see_nothing_of_what_is_taken_away_there_or_only_touches() {
    const CUBE: &str = "mesh2 { vertex_vectors { 8, <0, 0, 0>, <1, 0, 0>, <0, 1, 0>, <1, 1, 0>, \
         <0, 0, 1>, <1, 0, 1>, <0, 1, 1>, <1, 1, 1> } face_indices { 12, <0, 1, 2>, <1, 2, 3>, \
         <4, 5, 6>, <5, 6, 7>, <0, 1, 4>, <1, 4, 5>, <2, 3, 6>, <3, 6, 7>, <0, 2, 4>, <2, 4, 6>, \
         <1, 3, 5>, <3, 5, 7> } inside_vector <0.1, 0.9, 0.3> }";
    const CAMERA: &str = "camera { location <2, 3, -6> look_at 0 angle 35 right x*4/3 }";
    for thing in [
        "difference { box { 0, 1 } box { 0, 1 }",
        "difference { box { 0, 0.3 } box { 0, 0.1 + 0.2 }",
        "difference { box { 0, 0.3 } box { 0, 0.4 }",
        "difference { box { 0, 0.3 } prism { 0, 0.3, 4, <0, 0>, <0.3, 0>, <0.3, 0.3>, <0, 0.3> }",
        "difference { box { 0, 0.3 } plane { -z, 0 }",
        "intersection { box { 0, 0.3 } box { -1, <1, 1, 0> }",
        "intersection { box { 0, 1 } box { <0, -1, -1>, <1, 0, 0> }",
        "difference { CUBE box { 0, 1 }",
        "difference { box { 0, 1 } CUBE",
        "difference { box { 0, 1 } lathe { linear_spline 4, <0, 0>, <2, 0>, <2, 1>, <0, 1> }",
        "difference { prism { 0, 1, 4, <0, 0>, <1, 0>, <1, 1>, <0, 1> } box { 0, 1 }",
    ] {
        let thing = thing.replace("CUBE", CUBE);
        let film = rendered(
            &format!(
                "#version 3.7; {CAMERA} {thing} pigment {{ rgb 1 }} finish {{ emission 1 }} }}"
            ),
            (320, 240),
        );
        let lit = film.radiances().filter(|radiance| radiance.red > 0.0).count();
        assert_eq!(lit, 0, "{thing}");
    }
}
