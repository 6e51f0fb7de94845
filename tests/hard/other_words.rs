//! One solid in the words of several shapes: what is left when one is taken from another is nothing, and
//! merged they are one.

use super::held::rendered;

const PIXELS: (u32, u32) = (32, 24);

/// Solids within 1.2 of the origin, each in words that mean the same, up to the last brace.
const SAME: [&[&str]; 5] = [
    &[
        "sphere { 0, 1",
        "quadric { 1, 0, 0, -1",
        "poly { 2, <1, 0, 0, 0, 1, 0, 0, 1, 0, -1>",
        "superellipsoid { <1, 1>",
        "sphere { 0, 1 scale <1, 3, 0.7> rotate 33*x rotate -33*x scale <1, 1/3, 1/0.7>",
        "sphere_sweep { linear_spline 2, 0, 1, 0.3*x, 0.4",
        "isosurface { function { x*x + y*y + z*z - 1 } contained_by { sphere { 0, 1.2 } } max_gradient 3",
        "isosurface { function { -1 } contained_by { sphere { 0, 1 } }",
        "torus { 0, 1",
        "julia_fractal { 0 quaternion sqr max_iteration 6",
    ],
    &[
        "box { <-0.8, -0.6, -1>, <0.3, 0.6, 0.1+0.2>",
        "prism { -0.6, 0.6, 5, <-0.8, -1>, <0.3, -1>, <0.3, 0.3>, <-0.8, 0.3>, <-0.8, -1>",
        "mesh { #local A = <-0.8, -0.6, -1>; #local B = <0.3, 0.6, 0.3>;
            #macro Side(P, Q, R, S) triangle { P, Q, R } triangle { P, R, S } #end
            Side(A, <B.x, A.y, A.z>, <B.x, B.y, A.z>, <A.x, B.y, A.z>)
            Side(<A.x, A.y, B.z>, <B.x, A.y, B.z>, B, <A.x, B.y, B.z>)
            Side(A, <A.x, B.y, A.z>, <A.x, B.y, B.z>, <A.x, A.y, B.z>)
            Side(<B.x, A.y, A.z>, <B.x, B.y, A.z>, B, <B.x, A.y, B.z>)
            Side(A, <B.x, A.y, A.z>, <B.x, A.y, B.z>, <A.x, A.y, B.z>)
            Side(<A.x, B.y, A.z>, <B.x, B.y, A.z>, B, <A.x, B.y, B.z>)
            inside_vector <0.1, 1, 0.2>",
        "intersection { plane { x, 0.3 } plane { -x, 0.8 } plane { y, 0.6 } plane { -y, 0.6 }
            plane { z, 3*0.1 } plane { -z, 1 }",
        "isosurface { function { -1 } contained_by { box { <-0.8, -0.6, -1>, <0.3, 0.6, 0.3> } }",
    ],
    &[
        "cylinder { -0.9*y, 0.7*y, 0.6",
        "cone { -0.9*y, 0.6, 0.7*y, 0.6",
        "lathe { linear_spline 4, <0, -0.9>, <0.6, -0.9>, <0.6, 0.7>, <0, 0.7>",
        "sor { 4, <0.6, -1>, <0.6, -0.9>, <0.6, 0.7>, <0.6, 0.8>",
        "intersection { quadric { <1, 0, 1>, 0, 0, -0.36 } plane { y, 0.7 } plane { -y, 0.9 }",
    ],
    &[
        "cone { -y, 0.9, 0.6*y, 0.1+0.2",
        "cone { 0.6*y, 0.3, -y, 0.9",
        "lathe { linear_spline 4, <0, -1>, <0.9, -1>, <0.3, 0.6>, <0, 0.6>",
        "difference { cone { -y, 0.9, 1.4*y, 0 } plane { -y, -0.6 }",
    ],
    &[
        "torus { 0.7, 0.3",
        "torus { 1.4, 0.6 scale 0.5",
        "quartic { <1, 0, 0, 0, 2, 0, 0, 2, 0, -1.16, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 2, 0, 0.8,
            0, 0, 0, 0, 1, 0, -1.16, 0, 0.16>",
    ],
];

const PAINT: &str = "pigment { rgb x transmit 0.5 } finish { ambient 1 diffuse 0 }";

/// The red that is seen of objects, as thousandths.
fn seen(objects: &str, exponent: i32, turn: f64) -> Vec<i32> {
    let text = format!(
        "global_settings {{ max_trace_level 20 adc_bailout 0 }}
        camera {{ location <1.7, 2.3, 4.1> look_at 0 angle 36 rotate {turn}*<1, 2, 3> scale 1e{exponent} }}
        union {{ {objects} rotate {turn}*<1, 2, 3> scale 1e{exponent} }}"
    );
    let film = rendered(&text, PIXELS);
    film.radiances().map(|color| (color.red * 1e3).round() as i32).collect()
}

#[test]
fn a_solid_without_itself_in_other_words_is_nothing_and_merged_it_is_one() {
    let mut told = String::new();
    for words in SAME {
        for (exponent, turn) in [(0, 0.0), (-9, 31.7), (9, 77.7)] {
            let one = seen(&format!("{} {PAINT} }}", words[0]), exponent, turn);
            assert!(one.iter().filter(|red| **red == 750).count() > 40, "{}", words[0]);
            for first in words {
                for other in words {
                    let two = |operation: &str, last: &str| {
                        format!("{operation} {{ {first} }} {other} }} {last} {PAINT} }}")
                    };
                    let cases = [
                        ("difference", two("difference", ""), vec![0; one.len()]),
                        ("merge", two("merge", ""), one.clone()),
                        ("intersection", two("intersection", ""), one.clone()),
                    ];
                    for (operation, objects, expected) in cases {
                        let found = seen(&objects, exponent, turn);
                        let wrong =
                            found.iter().zip(&expected).filter(|(found, is)| found != is).count();
                        if wrong > 0 {
                            told += &format!(
                                "{operation} of {first} and {other}, 1e{exponent}, {turn}: {wrong}\n"
                            );
                        }
                    }
                }
            }
        }
    }
    assert!(told.is_empty(), "{told}");
}
