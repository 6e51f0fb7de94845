//! Solids so thin that they are plates, and walls where a function jumps: as whole as what is plainly flat.

use lucarne::color::Rgb;

use super::held::rendered;

const CAMERA: &str = "#version 3.7; camera { location <2, 3, -6> look_at 0 angle 35 right x*4/3 }";

fn radiance(things: &str) -> Vec<Rgb> {
    rendered(&format!("{CAMERA} {things}"), (80, 60)).radiances().collect()
}

#[test]
fn plates_too_thin_to_be_told_from_their_plane_are_seen_as_wide_as_they_are() {
    const SQUARE: &str = "box { <-1, -1, 0>, <1, 1, 0>";
    const DISC: &str = "disc { 0, z, 1";
    for (plate, flat) in [
        ("quadric { <0, 0, 1>, 0, 0, -1e-14 clipped_by { box { -1, 1 } }", SQUARE),
        ("quadric { <0, 0, 1>, 0, 0, -1e-18 clipped_by { box { -1, 1 } }", SQUARE),
        ("poly { 2, <0, 0, 0, 0, 0, 0, 0, 1, 0, -1e-14> clipped_by { box { -1, 1 } }", SQUARE),
        ("quadric { <1, 1, 1e12>, 0, 0, -1", DISC),
        ("quadric { <1, 1, 1e16>, 0, 0, -1", DISC),
        ("superellipsoid { <1, 20>", DISC),
        ("superellipsoid { <1, 40>", DISC),
        ("superellipsoid { <1, 90>", DISC),
    ] {
        let seen = |solid: &str| -> Vec<bool> {
            let paint = "pigment { rgb 1 } finish { emission 1 } rotate <20, 30, 0> }";
            radiance(&format!("{solid} {paint}")).iter().map(|seen| seen.red > 0.5).collect()
        };
        let apart = seen(plate).iter().zip(seen(flat)).filter(|(a, b)| **a != *b).count();
        assert_eq!(apart, 0, "{plate}");
    }
}

#[test]
fn a_wall_where_a_function_jumps_or_has_a_pole_is_lit_as_a_wall() {
    let wall = |function: &str| {
        radiance(&format!(
            "light_source {{ <8, 1, -6>, rgb 1 }} isosurface {{ function {{ {function} }}
             contained_by {{ box {{ -1, 1 }} }} pigment {{ rgb 1 }} rotate -60*y }}"
        ))
    };
    for (plain, functions) in [
        ("x", &["x/abs(x)", "select(x, -1, 0, 1)", "x/sqrt(x*x)", "1/x", "1/(x*x*x)"][..]),
        ("x - 0.25", &["1/(x - 0.25)"]),
        ("x - 0.3", &["1/(x - 0.3)", "floor(x - 0.3) + 0.5", "abs(x - 0.3)/(x - 0.3)"]),
    ] {
        let right = wall(plain);
        assert!(right.iter().filter(|radiance| radiance.red > 0.1).count() > 500);
        for function in functions {
            let found = wall(function);
            let is_off = |(a, b): &(&Rgb, &Rgb)| (a.red - b.red).abs() > 0.03;
            assert_eq!(found.iter().zip(&right).filter(is_off).count(), 0, "{function}");
        }
    }
}
