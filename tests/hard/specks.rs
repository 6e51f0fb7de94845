//! Solids that touch in a point at which a ray is aimed: what is seen there is what is seen around.

use crate::held::rendered;

/// A first solid, and a second that touches it at the middle of the picture and is nearer all around.
const PAIRS: &[[&str; 2]] = &[
    ["sphere { 0, 1", "plane { z, 1 inverse"],
    ["sphere { 0, 1", "box { -1, 1"],
    ["sphere { 0.5*z, 0.5", "sphere { 0, 1"],
    ["sphere { 0, 1 scale <0.5, 0.7, 1>", "sphere { 0, 1"],
    ["sphere { 0, 1", "cylinder { -2*y, 2*y, 1"],
    ["sphere { 0, 1", "quadric { <1, 0, 1>, 0, 0, -1"],
    ["sphere { 0.5*z, 0.5", "quadric { <1, 1, 0>, 0, z, -1"],
    ["cylinder { -y, y, 1", "box { -1, 1"],
    ["superellipsoid { <0.3, 0.3>", "box { -1, 1"],
    ["torus { 0.75, 0.25", "cylinder { -y, y, 1"],
    ["cone { -y, 1.5, y, 0.5 scale 0.894427190999916", "sphere { 0, 2"],
];

const MAPS: &[&str] = &[
    "translate 0",
    "rotate <13, 0, 31>",
    "rotate <3, 7, 31> scale 1e-9",
    "rotate 77*y scale 1e6 translate <3, 7, 5>*1e6",
];

/// Of red and green, what is seen in the middle of the picture, and around.
#[track_caller]
fn assert_no_speck(things: &str, map: &str) {
    let text = format!(
        "#declare Way = function {{ transform {{ {map} }} }}
         #declare Middle = Way(0, 0, 0);
         camera {{ location Way(0, 0, 5) direction Middle - Way(0, 0, 5)
                  right Way(1, 0, 0) - Middle up Way(0, 1, 0) - Middle }}
         {things}"
    );
    let film = rendered(&text, (21, 21));
    let green = |x, y| film.radiance[film.index(x, y)].green > 0.5;
    let all = (9..=11).all(|y| (9..=11).all(|x| green(x, y)));
    assert!(all, "{text}");
}

const RED: &str = "pigment { rgb <1, 0, 0> } finish { ambient 1 diffuse 0 } }";
const GREEN: &str = "pigment { rgb <0, 1, 0> } finish { ambient 1 diffuse 0 } }";

#[test]
fn where_two_solids_touch_the_one_that_is_nearer_around_is_seen() {
    for [first, second] in PAIRS {
        for map in MAPS {
            let (first, second) = (format!("{first} {RED}"), format!("{second} {GREEN}"));
            // Who stands in one of two that are merged sees on, through the point.
            let is_within = second.starts_with("plane");
            for group in ["union", "merge"].into_iter().take(if is_within { 1 } else { 2 }) {
                assert_no_speck(&format!("{group} {{ {first} {second} {map} }}"), map);
            }
        }
    }
}

#[test]
fn where_two_surfaces_of_one_solid_touch_the_one_that_is_nearer_around_is_seen() {
    for map in MAPS {
        let both = format!("box {{ -1, 1 {RED} sphere {{ 0, 1 {GREEN}");
        assert_no_speck(&format!("intersection {{ {both} {map} }}"), map);
        let cut = format!("sphere {{ 0, 1 {RED} box {{ -1, 1 {GREEN}");
        let part = format!("difference {{ union {{ {cut} }} box {{ <0.5, 0.5, -2>, 2 {RED}");
        assert_no_speck(&format!("{part} {map} }}"), map);
    }
}

#[test]
fn surfaces_that_coincide_keep_their_order() {
    for map in MAPS {
        let things = format!(
            "sphere {{ 0, 1 {GREEN} superellipsoid {{ <1, 1> {RED}
             intersection {{ sphere {{ 0, 0.5 {RED} box {{ -1, 1 {RED} }}"
        );
        assert_no_speck(&format!("union {{ {things} {map} }}"), map);
    }
}
