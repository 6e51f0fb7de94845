//! Patterns whose values jump: faces that lie in the jumps show one cell each, at any size and place.

use super::held::rendered;

/// Patterns with a seam in the plane y = 0, as they repeat.
const SEAMS: &[&str] = &[
    "checker rgb 0.1, rgb 0.9",
    "brick rgb 0.1, rgb 0.9 mortar 0.25 translate 0.25*y",
    "cells color_map { [0 rgb 0] [1 rgb 1] }",
    "cubic rgb 0, rgb 0.2, rgb 0.4, rgb 0.6, rgb 0.8, rgb 1 rotate 45*x",
    "square rgb 0.1, rgb 0.4, rgb 0.7, rgb 0.9 rotate 90*z",
    "hexagon rgb 0.1, rgb 0.5, rgb 0.9 rotate 90*x translate sqrt(3)/2*y",
    "triangular rgb 0, rgb 0.2, rgb 0.4, rgb 0.6, rgb 0.8, rgb 1 rotate 90*x",
    "gradient y color_map { [0 rgb 0.2] [1 rgb 0.8] }",
    "object { box { <-9, -9, -9>, <9, 0, 9> } rgb 0.2, rgb 0.8 }",
    "leopard warp { repeat y } color_map { [0 rgb 0] [1 rgb 1] }",
    "gradient y triangle_wave color_map { [0.5 rgb 0.2] [0.5 rgb 0.8] } translate 0.25*y",
];

/// What a grid of rays sees from above of a square of 0.9 about `<0.05, 0, 0.05>`, which lies in a seam.
fn seen(pigment: &str, size: f64, away: f64, turn: f64, face: &str) -> Vec<f64> {
    let text = format!(
        "camera {{ orthographic location <0.4, 3, 0.4> look_at <0.4, 0, 0.4> sky z
           right 0.7*x up 0.7*y scale {size} rotate <0, {turn}, {turn}> translate {away}*<1, -2, 0.5> }}
         {face}
           pigment {{ {pigment} }} finish {{ ambient 1 diffuse 0 }}
           scale {size} rotate <0, {turn}, {turn}> translate {away}*<1, -2, 0.5>
         }}"
    );
    rendered(&text, (24, 24)).radiances().map(|color| color.red).collect()
}

/// How many neighbours differ in a picture that may have straight edges, but no speckles: a cell has a few.
fn steps(seen: &[f64]) -> usize {
    let apart = |a: f64, b: f64| (a - b).abs() > 1e-3;
    let rows =
        seen.chunks(24).map(|row| row.windows(2).filter(|two| apart(two[0], two[1])).count());
    rows.sum()
}

#[test]
fn a_face_in_a_seam_of_a_pattern_shows_one_side_of_it() {
    for pigment in SEAMS {
        // Just above the seam, where each pattern shows what a point on the seam belongs to, or below.
        let near = |height: f64| {
            let face = format!("box {{ <-1, -1, -1>, <2, {height}, 2>");
            seen(pigment, 1.0, 0.0, 0.0, &face)
        };
        let [above, below] = [near(1e-7), near(-1e-7)];
        assert_ne!(above, below, "{pigment} has no seam there");
        for face in
            ["box { <-1, -1, -1>, <2, 0, 2>", "plane { y, 0", "box { <-1, 0, -1>, <2, -1, 2>"]
        {
            for (size, away, turn) in [
                (1.0, 0.0, 0.0),
                (1.0, 0.0, 33.0),
                (1e-5, 0.0, 33.0),
                (1e9, 0.0, 33.0),
                (1.0, 1e5, 0.0),
                (1.0, 1e5, 33.0),
            ] {
                let on = seen(pigment, size, away, turn, face);
                let of = |side: &[f64]| {
                    let off = on.iter().zip(side).filter(|(a, b)| (*a - *b).abs() > 1e-3);
                    off.count()
                };
                let wrong = of(&above).min(of(&below));
                // Rays may pass beside an edge of a cell by rounding.
                assert!(
                    wrong <= 4,
                    "{pigment}, {face}, {size:e}, {away:e}, {turn}: {wrong} pixels"
                );
            }
        }
    }
}

#[test]
fn patterns_keep_their_values_at_10_9_units_as_far_as_coordinates_do() {
    // A unit there has 23 bits behind the point.
    for pigment in [
        "bozo color_map { [0 rgb 0] [1 rgb 1] }",
        "granite scale 5 color_map { [0 rgb 0] [1 rgb 1] }",
        "wood turbulence 0.2 color_map { [0 rgb 0] [1 rgb 1] }",
        "crackle color_map { [0 rgb 0] [1 rgb 1] }",
        "brick rgb 0, rgb 1 brick_size 0.3 mortar 0.05",
        "spiral1 3",
    ] {
        let face = "plane { y, 0";
        let [near, far] = [0.0, 1e9].map(|away| seen(pigment, 1.0, away, 0.0, face));
        let sum: f64 = near.iter().zip(&far).map(|(a, b)| (a - b).abs()).sum();
        let mean = sum / near.len() as f64;
        assert!(mean < 1e-3, "{pigment}: {mean:e}");
        assert!(steps(&far) > 10, "{pigment} shows something");
    }
}
