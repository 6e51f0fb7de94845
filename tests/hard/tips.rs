//! A camera where a surface has no tangent plane: at the tip of a cone, where two planes cross.
//!
//! Every ray touches the surface at its start, and goes on inside, or outside.

use super::held::rendered;

const BALL: &str =
    "sphere { <0.05, 2, 0.03>, 0.25 pigment { rgb <0, 1, 0> } finish { emission 1 } }";

/// What is seen of a ball, alone or in an intersection, by a camera at `place`.
fn seen(solid: &str, place: &str) -> lucarne::film::Film {
    let view = format!("location {place} right x up z direction <0.01, 2, 0.02>");
    rendered(&format!("camera {{ {view} }} background {{ rgb 0.2 }} {solid}"), (40, 30))
}

/// Asserts that of the ball all is seen in an intersection with `inside`, and nothing without it.
fn holds_the_ball(inside: &str) {
    for (moved, place) in [
        ("", "0"),
        ("translate <1, 2, 3>", "<1, 2, 3>"),
        ("translate 1e7", "1e7"),
        ("", "<0, 1e-300, 0>"),
    ] {
        let scene = |operation: &str| format!("{operation} {{ {BALL} {inside} {moved} }}");
        let (alone, nothing) = (seen(&scene("union").replace(inside, ""), place), seen("", place));
        assert!(alone != nothing);
        assert!(seen(&scene("intersection"), place) == alone, "{inside} {moved}");
        assert!(seen(&scene("difference"), place) == nothing, "all but {inside} {moved}");
    }
}

#[test]
fn a_camera_at_the_tip_of_a_cone_sees_what_is_in_it() {
    holds_the_ball("quadric { <1, -1, 1>, 0, 0, 0 }");
    holds_the_ball("quadric { <1, -1, 1>, 0, 0, 0 rotate 20*x }");
}

#[test]
fn a_camera_where_two_planes_cross_sees_what_is_between_them() {
    holds_the_ball("quadric { <1, -1, 0>, 0, 0, 0 }");
    holds_the_ball("quadric { <0, -1, 0>, 0, 0, 0 }");
}

#[test]
fn a_camera_at_the_tip_of_a_quartic_sees_what_is_in_it() {
    holds_the_ball("polynomial { 4, xyz(4, 0, 0): 1, xyz(0, 0, 4): 1, xyz(0, 4, 0): -1 }");
}

#[test]
fn a_cone_seen_along_its_axis_is_whole_also_where_its_side_would_be_met_twice_as_far_off() {
    for (cap, reach) in [("0.5", 14), ("0.75", 22)] {
        let film = rendered(
            &format!(
                "camera {{ orthographic location 5*y direction -y right 2.03125*x up 1.53125*z }}
                 background {{ rgb <0, 0, 1> }}
                 cone {{ 0, 1, y, {cap} pigment {{ rgb <1, 0, 0> }} finish {{ emission 1 }} }}"
            ),
            (65, 49),
        );
        let across = (32 - reach..=32 + reach).map(|x| film.radiance(film.index(x, 24)).red);
        assert!(across.into_iter().all(|red| red > 0.5), "{cap}");
    }
}

#[test]
fn the_tip_of_what_is_open_is_seen_along_its_axis() {
    for tip in [
        "sor { 4, <0.3, -1>, <0.7, -0.5>, <0, 0.5>, <0.2, 1> open",
        "sor { 4, <0.3, -1>, <0, -0.5>, <0.7, 0.5>, <0.2, 1> open",
        "sor { 4, <1e-6, -1>, <1, -0.5>, <0, -0.499>, <0.1, -0.25> open",
        "cone { 0, 0.7, y, 0 open",
        "prism { conic_sweep linear_spline 0, 1, 4, <-0.5, -0.5>, <0.6, -0.5>, <0.6, 0.5>, <-0.5, 0.5> open",
    ] {
        for way in ["y", "-y"] {
            let camera = format!(
                "camera {{ orthographic location -5*{way} direction {way} right 2.03125*x up 1.53125*z }}"
            );
            let red = "pigment { rgb <1, 0, 0> } finish { emission 1 }";
            let film = rendered(&format!("{camera} {tip} {red} }}"), (65, 49));
            for x in 30..=34 {
                assert!(film.radiance(film.index(x, 24)).red > 0.5, "{tip} {way} {x}");
            }
        }
    }
}

#[test]
fn a_quadric_with_a_tip_is_seen_around_it_however_far_from_the_origin_it_stands() {
    let tips = ["<0, 0, 0>", "<1.5, 0.25, -3>", "<0.3, 0.7, -0.9>", "<1000.3, 700.7, -300.1>"];
    for tip in tips {
        for width in ["1", "1e-4", "1e-6", "1e-8"] {
            let film = rendered(
                &format!(
                    "#declare Tip = {tip}; #declare A = Tip.x; #declare B = Tip.y; #declare C = Tip.z;
                     camera {{ orthographic location Tip - 5*z direction z right {width}*x up {width}*y }}
                     background {{ rgb <1, 0, 0> }}
                     quadric {{ <1, -1, 1>, 0, <-2*A, 2*B, -2*C>, A*A - B*B + C*C
                               pigment {{ rgb <0, 1, 0> }} finish {{ emission 1 }} }}"
                ),
                (31, 31),
            );
            for (x, y) in (0..31).flat_map(|x: i32| (0..31).map(move |y: i32| (x, y))) {
                let (aside, up) = ((x - 15).abs(), (y - 15).abs());
                if aside != up {
                    let red = film.radiance(film.index(x as u32, y as u32)).red;
                    assert_eq!(red < 0.5, aside < up, "{tip} {width} {x} {y}");
                }
            }
        }
    }
}
