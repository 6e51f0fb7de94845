//! Solids that touch in a point at which a ray is aimed: what is seen there is what is seen around.

use super::held::rendered;

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
    let green = |x, y| film.radiance(film.index(x, y)).green > 0.5;
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

#[test]
fn the_first_of_two_coinciding_faces_is_seen_up_to_its_corner() {
    let prism = "prism { -0.7, 1, 4, <-0.7, 0.3>, <0.3, 0.3>, <0.3, 0.5>, <-0.7, 0.5>";
    let narrow = "prism { -0.7, 1, 4, <-0.7, 0.49>, <0.3, 0.49>, <0.3, 0.5>, <-0.7, 0.5>";
    let block = "box { <-0.7, -0.7, 0.3>, <0.3, 1, 0.5>";
    let wide = "box { <-0.7, 0.5, 0.3>, <0.7, 1, 0.7>";
    let other = "prism { 0.5, 1, 4, <-0.7, 0.3>, <0.7, 0.3>, <0.7, 0.7>, <-0.7, 0.7>";
    for (first, second, depth) in [
        (prism, wide, 0.2),
        (prism, other, 0.2),
        (block, other, 0.2),
        (narrow, wide, 0.01),
        (
            block,
            "superellipsoid { <0.001, 0.001> scale <0.7, 0.5, 0.2> translate <0, 0.5, 0.5>",
            0.2,
        ),
    ] {
        for group in ["union", "merge"] {
            let text = format!(
                "camera {{ orthographic location <0.301, 4, 0.501> direction -y right 0.12*x up -0.09*z }}
                 {group} {{ {first} {GREEN} {second} {RED} }}"
            );
            let film = rendered(&text, (41, 31));
            for (x, y) in (0..31).flat_map(|y| (0..41).map(move |x| (x, y))) {
                let place = |cells: f64, at: usize, middle: f64, size: f64| {
                    middle + size * ((at as f64 + 0.5) / cells - 0.5)
                };
                let (a, b) = (place(41.0, x, 0.301, 0.12), place(31.0, y, 0.501, 0.09));
                let is_first = a < 0.3 && b < 0.5 && b > 0.5 - depth;
                let green = film.radiance(film.index(x as u32, y as u32)).green > 0.5;
                assert_eq!(green, is_first, "{text} {x} {y}");
            }
        }
    }
}

#[test]
fn the_first_of_two_coinciding_faces_is_seen_up_to_its_corner_by_who_looks_aslant() {
    let first = "prism { -1, 0.5, 4, <-1, -0.5>, <0, -0.5>, <0, 0>, <-1, 0>";
    let text = format!(
        "camera {{ location <0.5, 5.5, 0.5> direction <-0.101, -1, -0.101> right -0.0126*x up 0.0096*z }}
         {first} {GREEN} box {{ <-1, 0, -0.5>, <0.5, 0.5, 0.5> {RED}"
    );
    let film = rendered(&text, (33, 25));
    for (x, y) in (0..25).flat_map(|y| (0..33).map(move |x| (x, y))) {
        // The face is 5 from the camera.
        let a = 0.5 - 5.0 * (0.101 + 0.0126 * ((f64::from(x) + 0.5) / 33.0 - 0.5));
        let b = 0.5 - 5.0 * (0.101 + 0.0096 * ((f64::from(y) + 0.5) / 25.0 - 0.5));
        let green = film.radiance(film.index(x, y)).green > 0.5;
        assert_eq!(green, a < 0.0 && b < 0.0, "{x} {y}");
    }
}

#[test]
fn the_first_of_two_coinciding_faces_is_seen_a_thousand_sizes_from_the_origin() {
    let solids = [
        "prism { -0.5, 0.5, 4, <-1, -1>, <1, -1>, <1, 0.7>, <-1, 0.7>",
        "box { <-1, -0.3, -1>, <1, 0.5, 0.7>",
        "mesh { triangle { <-1, 0.5, -1>, <1, 0.5, -1>, <1, 0.5, 0.7> }
                triangle { <-1, 0.5, -1>, <1, 0.5, 0.7>, <-1, 0.5, 0.7> }",
        "cylinder { -0.7*y, 0.5*y, 1",
        "sor { 4, <0.5, -2>, <0.8, -1>, <1, 0.5>, <0.9, 1>",
    ];
    for map in [
        "rotate <30, 45, 30> scale 1e-6 translate <0, 1e-3, 1e-3>",
        "rotate <45, 0, 37> scale 1e-6 translate <0, 1e-6/3, 1e-3>",
        "rotate <0, 90, 61.3> scale 1e6 translate <1e9, 1e6/3, 7e6>",
    ] {
        for (first, second) in solids.iter().flat_map(|a| solids.map(|b| (a, b))) {
            let film = rendered(
                &format!(
                    "#declare Way = function {{ transform {{ {map} }} }}
                     #declare From = Way(0.1, 3, 0.3);
                     camera {{ location From direction Way(0, 0.5, 0) - From
                              right Way(1, 3, 0.3) - Way(0, 3, 0.3) up Way(0, 3, 1.3) - Way(0, 3, 0.3) }}
                     {first} {map} {GREEN} {second} {map} {RED}"
                ),
                (9, 9),
            );
            let is_first = film.radiances().all(|color| color.green > 0.5);
            assert!(is_first, "{first} {second} {map}");
        }
    }
}
