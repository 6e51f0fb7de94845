//! Cylinders, cones, tori and quadrics, alone under a lamp: rows 3, 8, 22, 24, 25, 28 and 29.

use super::bodies::{Solid, View};
use super::scene::{Triple, ten};
use super::wide::{Wide, WideMap};

fn triple([x, y, z]: Triple) -> String {
    format!("<{x:e}, {y:e}, {z:e}>")
}

/// The text but for the last brace, and what it stands for.
type Told = (String, Solid);

fn cone(ends: [Triple; 2], radii: [f64; 2], open: bool) -> Told {
    let [a, b] = ends.map(triple);
    let open_word = if open { "open" } else { "" };
    let text = match radii {
        [base, cap] if base == cap => format!("cylinder {{ {a}, {b}, {base:e} {open_word}"),
        [base, cap] => format!("cone {{ {a}, {base:e}, {b}, {cap:e} {open_word}"),
    };
    (text, Solid::tapered(ends, radii, open))
}

fn torus(major: f64, minor: f64) -> Told {
    (format!("torus {{ {major:e}, {minor:e}"), Solid::torus(major, minor))
}

/// Turned by degrees about x and then about z.
fn turned((text, solid): Told, x: f64, z: f64) -> Told {
    let map = |axis, degrees| WideMap::rotation(axis, &Wide::of(degrees));
    (format!("{text} rotate <{x:e}, 0, {z:e}>"), solid.under(&map(2, z).after(&map(0, x))))
}

/// A cylinder, a cone and a torus of about a size.
fn kinds(size: f64) -> [Told; 3] {
    let at = |p: Triple| p.map(|c| c * size);
    let ends = [at([-0.75, -0.5, 0.25]), at([0.5, 1.0, -0.25])];
    [
        cone(ends, [0.625 * size; 2], false),
        cone(ends, [0.75 * size, 0.25 * size], false),
        turned(torus(size, 0.375 * size), 50.0, 20.0),
    ]
}

const ASLANT: Triple = [0.6, 0.5, 0.8];

#[test]
fn row_3_a_telephoto_lens_shows_cylinders_cones_and_tori() {
    for exponent in 3..=8 {
        let toward = if exponent % 2 == 0 { [0.0, 0.0, 1.0] } else { ASLANT };
        let view = View::of(toward, ten(exponent), 1.0);
        for (text, solid) in kinds(1.0) {
            view.hold(&format!("1e{exponent} away"), &text, &solid);
        }
    }
}

#[test]
fn row_8_a_camera_may_stand_inside_a_tube_or_a_bar() {
    for size in [1e-6, 1.0, 1e6] {
        let view = |location: Triple, direction: Triple| View {
            location: location.map(|c| c * size),
            direction,
            right: [-1.5 * direction[2], 0.0, 1.5 * direction[0]],
            up: [0.0, 1.0, 0.0],
            ..View::of(ASLANT, 1.0, size)
        };
        // Its lamp hangs in the tube, too.
        let lamp = [0.9, 0.1, -0.4].map(|c| c * size);
        let (text, solid) = torus(size, 0.4 * size);
        let inside = View { lamp, ..view([1.1, 0.0, 0.1], [0.0, 0.0, -1.0]) };
        inside.hold("inside a tube", &text, &solid);
        let ends = [[-3.0, 0.0, 0.0], [2.0, 0.0, 0.0]].map(|p: Triple| p.map(|c| c * size));
        for radii in [[size, size], [size, 0.3 * size]] {
            let (text, solid) = cone(ends, radii, false);
            let lamp = [0.5, 0.2, 0.1].map(|c| c * size);
            let inside = View { lamp, ..view([-2.5, 0.1, 0.2], [1.0, 0.0, 0.0]) };
            inside.hold("inside a bar", &text, &solid);
        }
    }
}

#[test]
fn row_22_cylinders_and_cones_are_seen_along_their_axes_and_through_their_tips() {
    let places = [(1.0, 1.5), (1.0, 3.5), (1.0, 1e3), (1.0, 1e6), (1e-6, 3.5), (1e6, 1.5)];
    for (size, far) in places {
        let ends = [[0.0, 0.0, -size], [0.0, 0.0, size]];
        // The middle ray goes along the axis.
        let view = || View::of([0.0, 0.0, 1.0], far * size, size);
        for radii in [[1.0, 1.0], [1.0, 0.5], [0.5, 1.0], [1.0, 0.0], [0.0, 1.0], [1.0, -0.5]] {
            // From afar, an open one is a ring without width.
            for open in [false, true].into_iter().take(if far < 10.0 { 2 } else { 1 }) {
                let (text, solid) = cone(ends, radii.map(|r| r * size), open);
                view().hold(&format!("{radii:?} along the axis, {far}"), &text, &solid);
            }
        }
        // Across, through the tip.
        let ends = [[0.0, 0.0, 0.0], [size, -size, 0.0]];
        for radii in [[0.0, 1.0], [0.5, -0.5]] {
            let (text, solid) = cone(ends, radii.map(|r| r * size), false);
            view().hold("through the tip", &text, &solid);
        }
    }
}

#[test]
fn row_24_cylinders_and_cones_may_have_any_size_and_be_far_away() {
    for (exponent, far) in
        [(-12, 3.0), (-6, 3.0), (-3, 3.0), (3, 3.0), (6, 3.0), (12, 3.0), (0, 9e6)]
    {
        let size = ten(exponent);
        let view = View::of(ASLANT, far * size, size);
        for (text, solid) in kinds(size).into_iter().take(2) {
            view.hold(&format!("of size 1e{exponent}, {far:e} away"), &text, &solid);
        }
    }
}

#[test]
fn row_25_tori_may_be_far_away_thin_horned_squashed_and_of_any_size() {
    let view = |far: f64| View::of(ASLANT, far, 1.0);
    for far in [10.0, 1e3, 1e5, 5e6] {
        let (text, solid) = turned(torus(1.25, 0.5), 50.0, 20.0);
        view(far).hold(&format!("{far:e} away"), &text, &solid);
        view(far).unlit().hold(&format!("{far:e} away, unlit"), &text, &solid);
    }
    // So thin that it is seen of one pixel's width, from near.
    for minor in [1e-2, 3e-3, 3e-4] {
        let view = View {
            right: [4.0 * minor, 0.0, 0.0],
            up: [0.0, 3.0 * minor, 0.0],
            direction: [0.0, 0.0, -30.0 * minor],
            location: [0.0, 0.0, 1.0 + 30.0 * minor],
            ..view(1.0)
        };
        let (text, solid) = torus(1.0, minor);
        view.hold(&format!("a ring {minor:e} thin"), &text, &solid);
    }
    for exponent in [-12, -4, 6, 12] {
        let size = ten(exponent);
        let (text, solid) = turned(torus(1.25 * size, 0.5 * size), 50.0, 20.0);
        View::of(ASLANT, 5.0 * size, size).hold(&format!("of size 1e{exponent}"), &text, &solid);
    }
    let (text, solid) = torus(0.75, 0.75);
    view(5.0).hold("horned", &text, &solid);
    for toward in [ASLANT, [0.6, 2.0, 0.8]] {
        let mut map = WideMap::identity();
        map.rows[1].0[1] = Wide::of(1e-3);
        let solid = Solid::torus(1.25, 0.5).under(&map);
        View::of(toward, 5.0, 1.0).hold("squashed", "torus { 1.25, 0.5 scale <1, 1e-3, 1>", &solid);
    }
}

#[test]
fn row_28_quadrics_may_be_spheres_of_any_size_paraboloids_and_planes() {
    let quadric = |squares: Triple, mixed: Triple, linear: Triple, one: f64| {
        let [a, b, c] = [squares, mixed, linear].map(triple);
        let text = format!("quadric {{ {a}, {b}, {c}, {one:e}");
        (text, Solid::quadric(squares, mixed, linear, one))
    };
    const NONE: Triple = [0.0; 3];
    for exponent in (-6..=6).step_by(3) {
        let size = ten(exponent);
        let (text, solid) = quadric([1.0; 3], NONE, NONE, -(size * size));
        for far in [3.0, 1e6] {
            let view = View::of(ASLANT, far * size, size);
            view.hold(&format!("a ball of 1e{exponent}, {far:e} away"), &text, &solid);
        }
    }
    for far in [2.0, 1e3, 1e6] {
        // Along the axis, from within and from behind; and across.
        let (text, solid) = quadric([1.0, 1.0, 0.0], NONE, [0.0, 0.0, 1.0], 0.0);
        for toward in [[0.0, 0.0, 1.0], [0.0, 0.0, -1.0], ASLANT] {
            let view = View::of(toward, far, 1.0);
            view.hold(&format!("a paraboloid from {toward:?}, {far:e} away"), &text, &solid);
        }
        // A ray along both of two planes, to a rounding, meets neither: none goes so.
        let view = View::of([0.6, 0.45, 0.8], far, 1.0);
        let (text, solid) = quadric(NONE, NONE, [0.0, 1.0, 0.0], 0.5);
        view.hold("a plane", &text, &solid);
        let (text, solid) = quadric([0.0, 1.0, 0.0], NONE, NONE, -1.0);
        view.hold("two planes", &text, &solid);
        let (text, solid) = quadric(NONE, [1.0, 0.0, 0.0], NONE, 0.0);
        view.hold("two planes that cross", &text, &solid);
    }
}

#[test]
fn row_29_a_quartic_that_is_a_torus_is_seen_as_one() {
    // R² = 1, r² = ¼: R² + r² = 1.25, R² − r² = 0.75.
    let quartic = "quartic { <1, 0, 0, 0, 2, 0, 0, 2, 0, -2.5, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 2, 0, 1.5, 0, 0, 0, 0, 1, 0, -2.5, 0, 0.5625>";
    for far in [4.0, 1e3, 5e6] {
        for toward in [ASLANT, [0.1, 1.0, 0.1]] {
            let view = View::of(toward, far, 1.0);
            let name = format!("from {toward:?}, {far:e} away");
            view.hold(&name, quartic, &Solid::torus(1.0, 0.5));
        }
    }
}
