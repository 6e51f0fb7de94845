//! Coinciding faces of wholes: what is seen is known without tracing.
//!
//! **In:** a scene of size 1, shown from above by parallel rays, at any size and turned by any angle.
//! **Out:** no pixel but the one that is expected.

use super::held::rendered;

const PIXELS: u32 = 40;
const SIZES: [i32; 5] = [-9, -3, 0, 4, 9];
const TURNS: [f64; 4] = [0.0, 1e-5, 30.0, 77.7];

/// What is seen at a place of the screen, −2 … 2 to the right and upward: 1 the first paint, 2 the
/// second, 0 the background.
type Expected = fn(f64, f64) -> usize;

/// `objects` uses `P1` and `P2`, and looks as `expected` says from +z.
#[track_caller]
fn looks(name: &str, objects: &str, expected: Expected) {
    for exponent in SIZES {
        for turn in TURNS {
            let text = format!(
                "global_settings {{ max_trace_level 20 adc_bailout 0 }}
                #declare K = 1e{exponent};
                #declare T = transform {{ rotate <{turn}, 2*{turn}, -{turn}/3> scale K }}
                camera {{ orthographic location 9*z direction -z right 4*x up 4*y transform {{ T }} }}
                #declare P1 = texture {{ pigment {{ rgb x }} finish {{ ambient 1 diffuse 0 }} }}
                #declare P2 = texture {{ pigment {{ rgb y }} finish {{ ambient 1 diffuse 0 }} }}
                union {{ {objects} transform {{ T }} }}"
            );
            let film = rendered(&text, (PIXELS, PIXELS));
            let mut wrong = 0;
            for y in 0..PIXELS {
                for x in 0..PIXELS {
                    let at = |i: u32| (f64::from(i) + 0.5) * 4.0 / f64::from(PIXELS) - 2.0;
                    let seen = film.radiance(film.index(x, y));
                    let is = usize::from(seen.red > 0.5) + 2 * usize::from(seen.green > 0.5);
                    wrong += usize::from(is != expected(at(x), -at(y)));
                }
            }
            assert_eq!(wrong, 0, "{name}, size 1e{exponent}, turned by {turn}");
        }
    }
}

fn in_square(x: f64, y: f64, half: f64) -> bool {
    x.abs() < half && y.abs() < half
}

#[test]
fn a_hole_whose_ends_lie_in_the_faces_is_open() {
    looks(
        "a round hole",
        "difference { box { -1, 1 texture { P1 } } cylinder { -z, z, 0.52 texture { P2 } } }",
        |x, y| usize::from(in_square(x, y, 1.0) && x.hypot(y) > 0.52),
    );
    looks(
        "a square hole through a round bar",
        "difference { cylinder { -z, z, 1.03 texture { P1 } } box { <-0.5, -0.5, -1>, <0.5, 0.5, 1> texture { P2 } } }",
        |x, y| usize::from(x.hypot(y) < 1.03 && !in_square(x, y, 0.5)),
    );
    looks(
        "two holes that meet in a face",
        "difference { box { -1, 1 texture { P1 } } box { <-0.5, -0.5, 0>, <0.5, 0.5, 1> }
            cylinder { -z, 0, 0.52 } texture { P2 } }",
        |x, y| match () {
            _ if !in_square(x, y, 1.0) || x.hypot(y) < 0.52 && in_square(x, y, 0.5) => 0,
            _ if in_square(x, y, 0.5) => 2,
            _ => 1,
        },
    );
}

#[test]
fn a_solid_without_itself_is_nothing() {
    for solid in ["box { -1, 1 }", "cylinder { -z, z, 1.03 }", "sphere { 0, 1.03 }"] {
        let objects = format!("difference {{ {solid} {solid} texture {{ P1 }} }}");
        looks("A - A", &objects, |_, _| 0);
    }
    looks(
        "a box in two spellings",
        "difference { box { -1, 1 } box { -0.5, 0.5 scale 2 rotate 90*y } texture { P1 } }",
        |_, _| 0,
    );
    looks(
        "parts that fill it",
        "difference { box { -1, 1 } box { -1, <0.1, 1, 1> } box { <0.1, -1, -1>, 1 } texture { P1 } }",
        |_, _| 0,
    );
}

#[test]
fn what_touches_shares_nothing_and_merges_without_a_wall() {
    looks(
        "an intersection",
        "intersection { box { -1, <1, 1, 0> } box { <-1, -1, 0>, 1 } texture { P1 } }",
        |_, _| 0,
    );
    looks(
        "a merge of glass",
        "merge { box { <-1, -1, -1>, <1, 1, 0> } box { <-1, -1, 0>, 1 }
            texture { pigment { rgb x transmit 0.6 } finish { ambient 1 diffuse 0 } } }
         box { <-1.5, -1.5, -3>, <1.5, 1.5, -2> texture { P2 } }",
        // 0.4 + 0.6·0.4 of red, 0.36 of what is behind: a wall would let less through.
        |x, y| match () {
            _ if in_square(x, y, 1.0) => 1,
            _ if in_square(x, y, 1.5) => 2,
            _ => 0,
        },
    );
    looks(
        "a bar of two",
        "merge { box { -1, <0.1, 1, 1> } box { <0.1, -1, -1>, 1 } texture { P1 } }",
        |x, y| usize::from(in_square(x, y, 1.0)),
    );
}

#[test]
fn what_both_begin_with_is_of_the_first() {
    looks(
        "a common face",
        "intersection { box { -1, 1 texture { P1 } } cylinder { -z, z, 0.52 texture { P2 } } }",
        |x, y| usize::from(x.hypot(y) < 0.52),
    );
    looks(
        "a lid in a face",
        "merge { box { -1, 1 texture { P1 } } cylinder { 0, z, 0.52 texture { P2 } } }",
        |x, y| usize::from(in_square(x, y, 1.0)),
    );
}

#[test]
fn an_isosurface_in_a_whole_loses_nothing_from_afar_where_a_line_goes_along_it_and_then_in() {
    for function in ["z - max(0, y)", "z - max(0, y - 0.3)/2"] {
        for (whole, with) in [
            ("intersection", "sphere { 0, 5 }"),
            ("difference", "sphere { 9*x, 1 }"),
            ("object", "clipped_by { box { -4, 4 } }"),
        ] {
            let seen = |from: f64| {
                let scene = format!(
                    "camera {{ orthographic location <0.013, -{from}, 0.017> direction y
                     right 3.45*x up 2.6*z }} background {{ rgb 0 }}
                     {whole} {{ isosurface {{ function {{ {function} }} contained_by {{ box {{ -1, 1 }} }} }}
                     {with} pigment {{ gradient y color_map {{ [0 rgb 0.25] [1 rgb 0.75] }} scale 8
                     translate -4*y }} finish {{ ambient 1 diffuse 0 }} }}"
                );
                rendered(&scene, (18, 13)).radiances().map(|seen| seen.red).collect::<Vec<_>>()
            };
            let (near, far) = (seen(6.0), seen(1e5));
            assert!(near.iter().filter(|red| **red > 0.0).count() > 50, "{whole} {function}");
            let apart = near.iter().zip(&far).filter(|(a, b)| (*a - *b).abs() > 1e-4).count();
            assert_eq!(apart, 0, "{whole} {function}");
        }
    }
}
