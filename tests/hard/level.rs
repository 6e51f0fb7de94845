//! Cameras that look level along a face: their rays lie in it, as far as rounding tells.

use super::held::rendered;
use crate::dice::Dice;

/// Solids on y = H, from above.
const ABOVE: [&str; 9] = [
    "box { <-2, H, -2>, <2, H + 0.5, 2> }",
    "cylinder { H*y, (H + 0.5)*y, 2 }",
    "cone { H*y, 2, (H + 0.5)*y, 1 }",
    "prism { H, H + 0.5, 4, <-2, -2>, <-2, 2>, <2, 2>, <2, -2> }",
    "sor { 4, <2, H - 0.5>, <2, H>, <2, H + 0.5>, <2, H + 1> }",
    "lathe { linear_spline 4, <0, H>, <2, H>, <2, H + 0.5>, <0, H + 0.5> }",
    "text { \"I\" 0.5, 0 scale <9, 3, 1> translate <-2, -1, -0.5> rotate 90*x translate H*y }",
    "mesh { Block(-2, H, -2, 2, H + 0.5, 2) inside_vector y }",
    "isosurface { function { -1 } contained_by { box { <-2, H, -2>, <2, H + 0.5, 2> } } }",
];

/// From below; the first has no end.
const BELOW: [&str; 9] = [
    "plane { y, H }",
    "box { <-3, H - 1, -3>, <3, H, 3> }",
    "cylinder { H*y, (H - 1)*y, 3 }",
    "cone { H*y, 2.5, (H - 1)*y, 2.9 }",
    "prism { H - 1, H, 4, <-3, -3>, <-3, 3>, <3, 3>, <3, -3> }",
    "sor { 4, <3, H - 2>, <3, H - 1>, <3, H>, <3, H + 1> }",
    "lathe { linear_spline 4, <0, H>, <3, H>, <3, H - 1>, <0, H - 1> }",
    "mesh { Block(-3, H - 1, -3, 3, H, 3) inside_vector y }",
    "isosurface { function { -1 } contained_by { box { <-3, H - 1, -3>, <3, H, 3> } } }",
];

/// A block as a mesh of twelve triangles.
const BLOCK: &str = "
    #macro Quad(A, B, C, D) triangle { A, B, C } triangle { A, C, D } #end
    #macro Block(A, B, C, D, E, F)
        Quad(<A, B, C>, <D, B, C>, <D, E, C>, <A, E, C>)
        Quad(<A, B, F>, <D, B, F>, <D, E, F>, <A, E, F>)
        Quad(<A, B, C>, <D, B, C>, <D, B, F>, <A, B, F>)
        Quad(<A, E, C>, <D, E, C>, <D, E, F>, <A, E, F>)
        Quad(<A, B, C>, <A, E, C>, <A, E, F>, <A, B, F>)
        Quad(<D, B, C>, <D, E, C>, <D, E, F>, <D, B, F>)
    #end";

/// Turns and sizes, where to, and H.
const MAPS: [[&str; 3]; 11] = [
    ["rotate 33*z rotate -20*z rotate -13*z", "translate <0, 3, 0>", "-1"],
    ["scale <1, 0.3, -1> rotate <10, 20, 30>", "translate <0.1, 0.2, 0.3>", "-1"],
    ["rotate 30*z", "", "-1"],
    ["rotate <90, 0, 37>", "", "-1"],
    ["rotate <45, 0, 90>", "translate <7, 7, 1/3>", "-1"],
    ["rotate <37, 61, 33> scale 3", "", "-1"],
    ["rotate <61.3, 0, 45> scale 3", "translate 3000", "-1"],
    ["rotate 30*x scale 1e-6", "", "-1"],
    ["rotate <37, 61, 33>", "translate <7, 7, 1/3>", "0.1"],
    ["rotate <12, -61, 3>", "", "100/3"],
    ["scale <1, 1e-5, 1> rotate 0.06*z", "", "1/3"],
];

/// From how far it is looked, how much above y = H, and how much that rises on the way to x = 0.
type Look = [&'static str; 3];

/// The row of a picture that looks along y = H, between the two beside it: where there is something.
fn rows(
    camera: &str,
    things: &str,
    [far, up, rise]: Look,
    [turn, moved, height]: [&str; 3],
) -> [Vec<bool>; 3] {
    let block = if things.contains("Block(") { BLOCK } else { "" };
    let film = rendered(
        &format!(
            "{block}
             #declare H = {height};
             #declare Way = function {{ transform {{ {turn} {moved} }} }}
             #declare Turn = function {{ transform {{ {turn} }} }}
             camera {{ {camera} location Way({far}, H + {up}, 0) direction Turn(-{far}, {rise}, 0)
                      right Turn(0, 0, -8.1) up Turn(0, 0.75, 0) }}
             background {{ rgb <1, 0, 0> }}
             {things} pigment {{ rgb <0, 1, 0> }} finish {{ emission 1 }} {turn} {moved} }}"
        ),
        (33, 3),
    );
    [0, 1, 2].map(|y| (0..33).map(|x| film.radiance(film.index(x, y)).green > 0.5).collect())
}

/// What is wrong with two solids that touch in the plane that the camera looks along.
fn faults(camera: &str, [above, below]: [&str; 2], look: Look, map: [&str; 3]) -> Vec<String> {
    let mut faults = Vec::new();
    let both = format!("intersection {{ {above} {below}");
    let [_, row, _] = rows(camera, &both, look, map);
    if row.contains(&true) {
        faults.push(format!("{camera} {both} {look:?} {map:?}\n{}", line(&row)));
    }
    let all = ["difference { box { <-3, H - 3, -3>, <3, H + 3, 3> }", "union {"];
    let is_endless = below == BELOW[0];
    for all in all.into_iter().take(if is_endless { 1 } else { 2 }) {
        let all = format!("{all} {above} {below}");
        let [before, row, next] = rows(camera, &all, look, map);
        assert!(before.contains(&true) || next.contains(&true), "{all} {map:?}");
        // A cone's wall is slanted: its row may be wider than the one above and narrower than the one below.
        let is_between = all.contains("cone")
            && steps(&row) <= steps(&before).max(steps(&next))
            && (0..33).all(|x| row[x] == before[x] || row[x] == next[x]);
        if row != before && row != next && !is_between {
            let [before, row, next] = [before, row, next].map(|row| line(&row));
            faults.push(format!("{camera} {all} {look:?} {map:?}\n{before}\n{row}\n{next}"));
        }
    }
    faults
}

/// How often a row goes over from something to nothing or back.
fn steps(row: &[bool]) -> usize {
    row.windows(2).filter(|pair| pair[0] != pair[1]).count()
}

fn line(row: &[bool]) -> String {
    row.iter().map(|seen| if *seen { '#' } else { '.' }).collect()
}

#[test]
fn a_camera_that_looks_along_the_face_of_two_solids_sees_nothing_of_both_and_no_gap() {
    let mut dice = Dice(1);
    let turns = std::env::var("LUCARNE_LONG").map_or(3, |times| 100 * times.parse().unwrap_or(1));
    let drawn = (0..turns).map(|_| {
        let [x, y, z] = [0; 3].map(|_| dice.between(-180.0, 180.0));
        let size = dice.one_of(&["", "scale 3", "scale 1e-6", "scale <1.1, 0.3, 2>", "scale 1e5"]);
        let moved = dice.one_of(&["", "translate <7, 7, 1/3>", "translate 3000", "translate 1e-5"]);
        let height = dice.one_of(&["-1", "0.1", "1/3", "-7.7", "33", "0"]);
        (format!("{size} rotate <{x}, {y}, {z}>"), moved, height)
    });
    let drawn: Vec<_> = drawn.collect();
    let drawn = drawn.iter().map(|(turn, moved, height)| [turn.as_str(), moved, height]);
    let mut found = Vec::new();
    let mut pairs = 0;
    for map in MAPS.into_iter().chain(drawn) {
        for pair in ABOVE.iter().flat_map(|above| BELOW.map(|below| [*above, below])) {
            for camera in ["orthographic", ""] {
                found.extend(faults(camera, pair, ["8", "0", "0"], map));
                pairs += 1;
            }
        }
    }
    assert!(found.is_empty(), "{} of {pairs}\n{}", found.len(), found.join("\n"));
}

/// The steepest look through the plane.
const STEEPEST: Look = ["1e3", "6e-10", "-6e-10"];

/// Whether what rounds a face is more than the camera is off it, or than a ray rises that goes through: a box, and a
/// container, hold their middle and their widths, and letters are drawn to a size.
fn is_rounded([above, below]: [&str; 2], [tall, height]: [&str; 2], look: Option<Look>) -> bool {
    let is_third = height == "1/3";
    let of_above =
        is_third && look.is_some() && (above.contains("box") || above.starts_with("text"));
    let of_below = tall == "H - 1e3"
        && (below.starts_with("isosurface")
            || below.starts_with("box") && (is_third || look == Some(STEEPEST)));
    of_above || of_below
}

#[test]
fn of_two_solids_however_tall_one_has_a_ray_that_is_off_their_plane_by_the_least_or_goes_through_it_so()
 {
    let looks = [
        ["10", "-1.5e-16", "0"],
        ["10", "1.2e-15", "0"],
        ["10", "-1.2e-15", "0"],
        ["10", "-5e-14", "0"],
        ["10", "1e-32", "0"],
        ["1e3", "1e-14", "-1e-14"],
        ["1e9", "1e-8", "-1e-8"],
        ["1e9", "-1e-8", "1e-8"],
    ];
    // By more than rounding, and less than an outline tells.
    let through = [
        ["1e9", "2e-6", "-2e-6"],
        ["1e9", "2e-6", "-2.0000000000001e-6"],
        ["1e3", "1e-11", "-1e-11"],
        ["1e3", "1e-10", "-1e-10"],
        STEEPEST,
    ];
    let maps =
        [["", "", "0"], ["rotate 1e-15*z", "", "0"], ["", "", "1/3"], ["", "translate 1*x", "0"]];
    let is_long = std::env::var("LUCARNE_LONG").is_ok();
    let (maps, heights) = match is_long {
        true => (&maps[..], &["H - 1", "H - 20", "H - 1e3"][..]),
        false => (&maps[..3], &["H - 20"][..]),
    };
    let pairs: Vec<_> = ABOVE.iter().flat_map(|above| BELOW.map(|below| (*above, below))).collect();
    let mut found = Vec::new();
    for look in looks.into_iter().chain(through) {
        for &map in maps {
            for &tall in heights {
                for &(above, below) in &pairs {
                    let passing = through.contains(&look).then_some(look);
                    if is_rounded([above, below], [tall, map[2]], passing) {
                        continue;
                    }
                    // A sor's outermost points lie beyond its ends.
                    let below = below.replace("H - 2", "H - 2e3").replace("H - 1", tall);
                    for camera in ["orthographic", ""] {
                        found.extend(faults(camera, [above, &below], look, map));
                    }
                }
            }
        }
    }
    assert!(found.is_empty(), "{}\n{}", found.len(), found.join("\n"));
}

/// The middle plane, z = 0, is a face of what is taken away.
#[test]
fn a_face_that_a_ray_goes_along_by_the_least_slope_takes_no_other_face_away() {
    for slope in ["0", "1e-16", "-1e-16", "1e-17", "-1e-17", "-3e-19", "1e-30", "-1e-30"] {
        for hole in ["<1.5, 1.5, 0>", "<1.5, 1.5, 1e-18>"] {
            let film = rendered(
                &format!(
                    "camera {{ orthographic location <8, 0, 0> direction <-1, 0, {slope}>
                              right -4.125*z up 3.125*y }}
                     difference {{ box {{ <-2, -1, -2>, <2, 0.5, 2> }}
                                  box {{ <-1.5, -0.5, -1.5>, {hole} }}
                                  pigment {{ gradient x scale 8 translate -4*x }}
                                  finish {{ ambient 0 emission 1 }} }}"
                ),
                (33, 25),
            );
            // Where the box is whole on either side of the plane, its near face is at x = 2.
            let near = film.radiance(film.index(16, 12)).red;
            assert!((near - 0.75).abs() < 1e-6, "{slope} {hole}: {near}");
        }
    }
}

#[test]
fn a_slope_is_a_slope_to_a_camera_at_0_in_a_plane_of_a_solid() {
    for (plane, above) in [("plane { y, 0 }", false), ("plane { -y, 0 }", true)] {
        let film = rendered(
            &format!(
                "camera {{ location 0 direction z right 2e-6*x up 1.8e-6*y }} background {{ rgb 0 }}
                 intersection {{ {plane} box {{ <-1, -1, 1>, <1, 1, 2> }}
                                pigment {{ rgb <0, 1, 0> }} finish {{ emission 1 }} }}"
            ),
            (3, 9),
        );
        // The slopes go from 8e-7 to −8e-7.
        let rows = (0..9).map(|y| film.radiance(film.index(1, y)).green > 0.5);
        let seen: Vec<bool> = rows.collect();
        assert!(seen[..4].iter().all(|seen| *seen == above), "{plane}: {seen:?}");
        assert!(seen[5..].iter().all(|seen| *seen != above), "{plane}: {seen:?}");
    }
}
