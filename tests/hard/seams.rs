//! What stands side by side: triangles and height fields, each alone, that share an edge in the world.
//!
//! The rays of the picture's middle column lie, but for rounding, in one plane with the edges.

use super::held::rendered;
use crate::dice::Dice;

/// Triangles on both sides of edges that end on a line that the camera sees as its middle, near or far.
fn strip(dice: &mut Dice, written: &str, moved: [f64; 3]) -> String {
    let point = |at: [f64; 3]| {
        let [x, y, z] = [0, 1, 2].map(|axis| at[axis] + moved[axis]);
        format!("<{x:.6}, {y:.6}, {z:.6}>")
    };
    let corners: Vec<[f64; 3]> = (0..32)
        .map(|number| {
            let far = dice.one_of(&[0.9, 1.0, 1.1, 1.2, 1.3]);
            [0.1 + 0.3 * far, -1.9 + f64::from(number) * 0.13, -3.0 + 3.0 * far]
        })
        .collect();
    let mut text = String::new();
    for pair in corners.windows(2) {
        let [a, b] = [pair[0], pair[1]];
        for side in [-1.0, 1.0] {
            let away = [
                a[0] + side * dice.between(2.0, 5.0),
                a[1] + dice.between(0.03, 0.1),
                a[2] + dice.between(-0.5, 0.5),
            ];
            text += &written.replace("ABC", &[a, b, away].map(point).join(", "));
        }
    }
    text
}

/// How many pixels of the middle column show what is behind.
fn holes(camera: &str, things: &str) -> usize {
    let text = format!(
        "camera {{ {camera} right 1.333*x angle 50 }} background {{ rgb <1, 0, 0> }} {things}"
    );
    let film = rendered(&text, (3, 2401));
    (0..2401).filter(|&y| film.radiance(film.index(1, y)).red > 0.5).count()
}

const LOOK: &str = "location <0.1, 0.2, -3> look_at <0.4, 0.3, 0>";
const PAINT: &str = "pigment { rgb <0, 1, 0> } finish { emission 1 }";

#[test]
fn triangles_that_share_an_edge_have_no_hole_there_each_alone() {
    let mut dice = Dice(7);
    for (camera, written, moved, map) in [
        ("", "triangle { ABC }", [0.0; 3], ""),
        ("", "mesh { triangle { ABC } }", [0.0; 3], ""),
        ("translate <1e5 + 0.1, -3e4, 7e4>", "triangle { ABC }", [1e5 + 0.1, -3e4, 7e4], ""),
        (
            "translate <10.1, 20.3, 30.7>",
            "triangle { ABC }",
            [0.0; 3],
            "translate <10.1, 20.3, 30.7>",
        ),
        ("rotate <3, 7, 31>", "triangle { ABC }", [0.0; 3], "rotate <3, 7, 31>"),
        ("scale <1.1, 0.9, -1.3>", "mesh { triangle { ABC } }", [0.0; 3], "scale <1.1, 0.9, -1.3>"),
    ] {
        let things = format!("union {{ {} {PAINT} {map} }}", strip(&mut dice, written, moved));
        let holes = holes(&format!("{LOOK} {camera}"), &things);
        assert_eq!(holes, 0, "{written} {map} {moved:?}");
    }
}

#[test]
fn height_fields_side_by_side_have_no_hole_between_them() {
    let field = "height_field { function 9, 9 { 0.3 + 0.1*sin(x*2*pi)*cos(y*2*pi) }";
    let mut things = String::new();
    for (i, j) in (-4..=4).flat_map(|i| (-6..=8).map(move |j| (i, j))) {
        let place = format!("<{i}*0.37 + 0.1, 0, {j}*0.53 + 0.07>");
        things += &format!("{field} scale <0.37, 1, 0.53> translate {place} {PAINT} }}\n");
    }
    assert_eq!(holes("location <0.1, 3, -2> look_at <0.1, 0, 0.3>", &things), 0);
}

#[test]
fn a_polygon_and_a_triangle_that_share_an_edge_far_off_leave_nothing_between_them() {
    let map =
        "rotate <166.37, -98.733, -133> scale 3 translate <-466993.556792, -0.19609, 2307.463616>";
    for edge in [
        "triangle { 0, x, -y } polygon { 4, <0, 0>, <-1, 0>, <0, -1>, <0, 0> }",
        "polygon { 4, <0, 0>, <1, 0>, <0, -1>, <0, 0> } triangle { 0, -x, -y }",
        "triangle { -x, x, -y } polygon { 4, <0, 0>, <-1, 0>, <0, -1>, <0, 0> }",
    ] {
        let camera = "location Way(0, -0.5, 5) direction Way(0, 0, -1) - Middle
                      right 0.01*(Way(1, 0, 0) - Middle) up 0.15*(Way(0, 1, 0) - Middle)";
        let text = format!(
            "#declare Way = function {{ transform {{ {map} }} }}
             #declare Middle = Way(0, 0, 0);
             camera {{ {camera} }} background {{ rgb <1, 0, 0> }}
             union {{ {edge} pigment {{ rgb 0 }} {map} }}"
        );
        let film = rendered(&text, (3, 401));
        let holes = (0..401).filter(|y| film.radiance(film.index(1, *y)).red > 0.5).count();
        assert_eq!(holes, 0, "{edge}");
    }
}

#[test]
fn a_ring_is_whole_at_the_height_where_its_curve_begins() {
    // One curve, begun at two of its points.
    for curves in [
        [
            "cubic_spline 7, <0.7, 0.3>, <0.5, 0.5>, <0.5, 0.7>, <0.9, 0.6>, <0.7, 0.3>, <0.5, 0.5>, <0.5, 0.7>",
            "cubic_spline 7, <0.9, 0.6>, <0.7, 0.3>, <0.5, 0.5>, <0.5, 0.7>, <0.9, 0.6>, <0.7, 0.3>, <0.5, 0.5>",
        ],
        [
            "linear_spline 5, <0.5, 0.5>, <0.6, 0.7>, <0.9, 0.6>, <0.7, 0.3>, <0.5, 0.5>",
            "linear_spline 5, <0.9, 0.6>, <0.7, 0.3>, <0.5, 0.5>, <0.6, 0.7>, <0.9, 0.6>",
        ],
        [
            "bezier_spline 8, <0.5, 0.5>, <0.5, 0.8>, <0.9, 0.8>, <0.9, 0.6>, <0.9, 0.6>, <0.9, 0.4>, <0.6, 0.2>, <0.5, 0.5>",
            "bezier_spline 8, <0.9, 0.6>, <0.9, 0.4>, <0.6, 0.2>, <0.5, 0.5>, <0.5, 0.5>, <0.5, 0.8>, <0.9, 0.8>, <0.9, 0.6>",
        ],
    ] {
        for around in [
            "difference { RING sphere { <50, 60, 70>, 1 }",
            "merge { RING sphere { <50, 60, 70>, 1 }",
        ] {
            let pictures = curves.map(|curve| {
                let thing = around.replace("RING", &format!("lathe {{ {curve} }}"));
                let text = format!(
                    "camera {{ orthographic location <8, 0, 0> direction -x right -4.1*z up 3.1*y }}
                     background {{ rgb <1, 0, 0> }} {thing} {PAINT} }}"
                );
                let film = rendered(&text, (41, 31));
                film.radiances().map(|radiance| radiance.red > 0.5).collect::<Vec<_>>()
            });
            assert!(
                pictures[0].contains(&false) && pictures[0] == pictures[1],
                "{around} {curves:?}"
            );
        }
    }
}
