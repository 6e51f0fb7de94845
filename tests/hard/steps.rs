//! Isosurfaces of functions that count, go by steps, or ask a spline or a pattern: each is the solid that is written
//! out beside it.

use super::held::rendered;

const BLOCKS: &str = "union {
    box { <-1.2, -1.2, -1.2>, <-1, 0, 1.2> } box { <-1, -1.2, -1.2>, <0, 0.5, 1.2> }
    box { <0, -1.2, -1.2>, <1, 0, 1.2> } box { <1, -1.2, -1.2>, <1.2, 0.5, 1.2> }";

const SLOPE: &str = "intersection { box { -1.2, 1.2 } plane { y - x, 0 }";

const LEVEL: &str = "box { -1.2, <1.2, 0.3, 1.2>";

/// What is declared, the function, and the solid of which it is the surface.
const PAIRS: &[[&str; 3]] = &[
    ["", "y - sum(i, 1, 2, 0.5*x)", SLOPE],
    ["", "y - prod(i, 1, 1, x)", SLOPE],
    ["function { spline { linear_spline -2, -2*y 0, 0*y 2, 2*y } }", "y - F(x).y", SLOPE],
    ["", "y - 0.5*mod(floor(x) + 4, 2)", BLOCKS],
    ["function { pattern { checker } }", "y - 0.5*F(x, 0.5, 0.5)", BLOCKS],
    ["function { pigment { checker rgb 0 rgb 1 } }", "y - 0.5*F(x, 0.5, 0.5).red", BLOCKS],
    ["function { pattern { gradient x scale 4 translate -2*x } }", "y + 2 - 4*F(x, y, z)", SLOPE],
    [
        "function { pattern { gradient x turbulence 1e-9 scale 4 translate -2*x } }",
        "y + 2 - 4*F(x, y, z)",
        SLOPE,
    ],
    [
        "function { pattern { marble ramp_wave turbulence 1e-9 scale 4 translate -2*x } }",
        "y + 2 - 4*F(x, y, z)",
        SLOPE,
    ],
    ["function { pattern { function { 0.3 + 0*x } } }", "y - F(x, y, z)", LEVEL],
    [
        "function { pigment { gradient x pigment_map { [0 function { 0.3 }] [1 rgb 0.3] } } }",
        "y - F(x, y, z).red",
        LEVEL,
    ],
];

#[test]
fn an_isosurface_that_counts_or_asks_is_the_solid_that_is_written_out() {
    for [declared, function, solid] in PAIRS {
        let declared = match declared.is_empty() {
            true => String::new(),
            false => format!("#declare F = {declared};"),
        };
        let surface = format!(
            "isosurface {{ function {{ {function} }} contained_by {{ box {{ -1.2, 1.2 }} }} max_gradient 3"
        );
        let films = [surface.as_str(), solid].map(|object| {
            let text = format!(
                "{declared} camera {{ location <3, 4, 6> look_at 0 angle 35 }}
                 light_source {{ <5, 9, 7>, 1 }}
                 {object} pigment {{ rgb 1 }} }}"
            );
            rendered(&text, (32, 24))
        });
        let off = (0..24).flat_map(|y| (0..32).map(move |x| (x, y))).filter(|&(x, y)| {
            let [one, other] =
                [&films[0], &films[1]].map(|film| film.radiance(film.index(x, y)).red);
            (one - other).abs() > 0.03
        });
        // At an edge rounding decides.
        assert!(off.count() <= 3, "{function}");
    }
}
