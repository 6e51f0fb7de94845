//! The tiles of each tiling.
//!
//! **Source:** measured on POV-Ray 3.7, which raises the values of some kinds by 10⁻⁶ or less (`floor`,
//! `lift`), so that none is rounded to a value of the kind before.

use std::f64::consts::SQRT_2;
use std::sync::LazyLock;

use super::super::tile::{Flat, Lattice, Place, Tile};

/// The number of tilings.
pub(super) const COUNT: usize = 24;

/// A tiling.
#[derive(Debug)]
pub(super) struct Plan {
    pub lattice: Lattice,
    /// The number of kinds.
    kinds: u8,
    /// The width of the bevel.
    pub width: f64,
    /// The least bevel of some kinds.
    floor: &'static [(u8, f64)],
    /// What is added to the bevel of some kinds.
    lift: &'static [(u8, f64)],
}

impl Plan {
    pub fn value(&self, place: Place) -> f64 {
        let of = |table: &[(u8, f64)]| {
            table.iter().find(|(kind, _)| *kind == place.kind).map_or(0.0, |(_, value)| *value)
        };
        let bevel = (1.0 - place.depth / self.width).max(of(self.floor)) + of(self.lift);
        ((f64::from(place.kind) + bevel) / f64::from(self.kinds)).min(1.0)
    }

    /// By how much the value changes in a unit of distance at most.
    pub fn slope(&self) -> f64 {
        1.0 / (self.width * f64::from(self.kinds))
    }
}

/// Returns a tiling by its number, 1 … [`COUNT`].
pub(super) fn plan(number: usize) -> &'static Plan {
    static PLANS: LazyLock<Vec<Plan>> = LazyLock::new(|| (1..=COUNT).map(build).collect());
    &PLANS[number.clamp(1, COUNT) - 1]
}

/// √3.
const ROOT_3: f64 = 1.732_050_807_568_877_2;
/// Half the height of a hexagon of side 1, the height of a triangle.
const H: f64 = ROOT_3 / 2.0;
/// The radius of the circle inside a triangle of side 1.
const R: f64 = ROOT_3 / 6.0;
/// A quarter of the diagonal of a square of side 2.
const Q: f64 = SQRT_2 / 2.0;
/// Distance between opposite sides of a dodecagon of side 1, less 1.
const A: f64 = 1.0 + ROOT_3;

// Regular tiles by their centre; triangles by the direction in which they point.
fn up(kind: u8, centre: Flat) -> Tile {
    Tile::regular(kind, 3, centre, 270.0)
}

fn down(kind: u8, centre: Flat) -> Tile {
    Tile::regular(kind, 3, centre, 90.0)
}

fn left(kind: u8, centre: Flat) -> Tile {
    Tile::regular(kind, 3, centre, 0.0)
}

fn right(kind: u8, centre: Flat) -> Tile {
    Tile::regular(kind, 3, centre, 180.0)
}

fn square(kind: u8, centre: Flat, degrees: f64) -> Tile {
    Tile::regular(kind, 4, centre, degrees)
}

fn hexagon(kind: u8, centre: Flat) -> Tile {
    Tile::regular(kind, 6, centre, 30.0)
}

fn dodecagon(kind: u8, centre: Flat) -> Tile {
    Tile::regular(kind, 12, centre, 0.0)
}

fn lying(kind: u8, centre: Flat) -> Tile {
    Tile::rectangle(kind, centre, [2.0, 1.0])
}

fn standing(kind: u8, centre: Flat) -> Tile {
    Tile::rectangle(kind, centre, [1.0, 2.0])
}

fn build(number: usize) -> Plan {
    let all = |kinds, width, steps, tiles: &[Tile]| Plan {
        lattice: Lattice::new(steps, tiles),
        kinds,
        width,
        floor: &[],
        lift: &[],
    };
    let slanted = Tile::new(0, vec![[0.0, 0.0], [1.0, 0.0], [1.5, H], [0.5, H]]);
    match number {
        1 => all(1, 0.5, [[1.0, 0.0], [0.0, 1.0]], &[square(0, [0.5, 0.5], 0.0)]),
        2 => all(1, H, [[1.5, H], [0.0, 2.0 * H]], &[hexagon(0, [-1.0, 0.0])]),
        3 => all(2, R, [[1.0, 0.0], [0.5, H]], &[up(0, [-0.5, R]), down(1, [-0.5, -R])]),
        4 => all(1, H / 2.0, [[1.0, 0.0], [0.5, H]], &[slanted]),
        5 => {
            let upright = Tile::new(1, vec![[0.0, 0.0], [0.5, H], [0.0, 2.0 * H], [-0.5, H]]);
            let back = Tile::new(2, vec![[0.0, 0.0], [0.5, -H], [1.5, -H], [1.0, 0.0]]);
            all(3, H / 2.0, [[1.5, H], [0.0, 2.0 * H]], &[slanted, upright, back])
        }
        6 => {
            let tiles = [lying(0, [1.0, -0.5]), standing(1, [-0.5, 0.0])];
            all(2, 0.5, [[1.0, 1.0], [-1.0, 3.0]], &tiles)
        }
        7 => {
            let half = 0.5 + Q;
            let tiles = [square(0, [half, half], 45.0), Tile::regular(1, 8, [0.0, 0.0], 0.0)];
            all(2, 0.5, [[2.0 * half, 0.0], [0.0, 2.0 * half]], &tiles)
        }
        8 => {
            let tiles = [up(0, [0.0, -2.0 * R]), down(1, [-0.5, -R]), square(2, [0.5, 0.5], 0.0)];
            Plan { lift: &[(2, 1e-7)], ..all(3, R, [[1.0, 0.0], [0.5, 1.0 + H]], &tiles) }
        }
        9 => {
            let tiles = [up(0, [-0.5, R]), down(1, [0.5, -R]), hexagon(2, [0.5, H])];
            Plan { floor: &[(2, 1e-7)], ..all(3, R, [[2.0, 0.0], [1.0, 2.0 * H]], &tiles) }
        }
        10 => all(1, 0.5, [[1.0, 0.0], [0.5, 1.0]], &[square(0, [0.5, 0.5], 0.0)]),
        11 => {
            let mut tiles = vec![square(0, [1.5, 1.5], 0.0)];
            for s in [-1.0, 1.0] {
                tiles.extend([lying(1, [s, -0.5 * s]), standing(2, [0.5 * s, s])]);
            }
            all(3, 0.5, [[3.0, 0.0], [0.0, 3.0]], &tiles)
        }
        12 => {
            let mut tiles = vec![square(0, [1.5, 1.5], 0.0), square(0, [1.5, -1.5], 0.0)];
            for [x, z] in [[-1.0, -1.0], [-1.0, 1.0], [1.0, -1.0], [1.0, 1.0]] {
                tiles.extend([lying(1, [2.0 * x, 0.5 * z]), standing(2, [0.5 * x, z])]);
            }
            all(3, 0.5, [[3.0, 3.0], [3.0, -3.0]], &tiles)
        }
        13 => framed([2, 2, 1, 1, 0], 3),
        14 => Plan { lift: &[(4, 1e-6)], ..framed([0, 1, 2, 3, 4], 5) },
        15 => {
            let large = Tile::rectangle(1, [0.0, -1.0], [2.0, 2.0]);
            let tiles = [square(0, [0.5, 0.5], 0.0), large];
            Plan { lift: &[(1, 2e-8)], ..all(2, 0.5, [[1.0, -2.0], [2.0, 1.0]], &tiles) }
        }
        16 => Plan { floor: &[(2, 1e-7)], ..ringed([0, 0, 0, 1, 1, 2], 3) },
        17 => Plan {
            floor: &[(5, 1e-6)],
            lift: &[(1, 1e-6), (2, 1e-6)],
            ..ringed([0, 1, 2, 3, 4, 5], 6)
        },
        18 => {
            let mut tiles = vec![lying(0, [-1.0, 0.5]), lying(0, [-1.0, 1.5])];
            tiles.extend([standing(1, [0.5, 1.0]), standing(1, [1.5, 1.0])]);
            all(2, 0.5, [[2.0, 2.0], [2.0, -2.0]], &tiles)
        }
        19 => snub(true),
        20 => snub(false),
        21 => {
            let s = A / 4.0;
            let mut tiles = vec![right(0, [R, 0.0]), down(1, [0.0, 0.5 + 2.0 * R])];
            tiles.extend([left(2, [-R, 0.0]), up(3, [0.0, -0.5 - 2.0 * R])]);
            tiles.extend([square(4, [s, s], 60.0), square(5, [-s, s], 30.0)]);
            let steps = [[2.0 * s, 2.0 * s], [2.0 * s, -2.0 * s]];
            Plan { floor: &[(4, 1e-6), (5, 1e-6)], ..all(6, R, steps, &tiles) }
        }
        22 => {
            let d = 1.0 + A;
            // POV-Ray 3.7 takes the distances from three of the twelve sides too short.
            let large = dodecagon(2, [0.0, -A / 2.0]);
            let large = large.with_shortened(&[(0.0, H), (180.0, H), (270.0, H)]);
            let tiles = [up(0, [0.0, 0.5 + R]), down(1, [d / 2.0, -R]), large];
            Plan { lift: &[(2, 1e-7)], ..all(3, R, [[d, 0.0], [d / 2.0, d * H]], &tiles) }
        }
        23 => Plan { lift: &[(2, 1e-6)], ..twelve([1, 1, 1, 2], 3) },
        _ => Plan { lift: &[(4, 1e-6)], ..twelve([1, 2, 3, 4], 5) },
    }
}

/// 13 and 14: squares framed by trapezoids on the left, right, above and below; their kinds in this order,
/// and the square's.
fn framed([left, right, above, below, square]: [u8; 5], kinds: u8) -> Plan {
    let q = |x: f64, z: f64| [Q * x, Q * z];
    let tiles = [
        Tile::new(left, vec![q(0.0, 0.0), q(0.0, 4.0), q(-1.0, 3.0), q(-1.0, 1.0)]),
        Tile::new(right, vec![q(0.0, 0.0), q(1.0, 1.0), q(1.0, 3.0), q(0.0, 4.0)]),
        Tile::new(above, vec![q(0.0, 0.0), q(4.0, 0.0), q(3.0, 1.0), q(1.0, 1.0)]),
        Tile::new(below, vec![q(0.0, 0.0), q(1.0, -1.0), q(3.0, -1.0), q(4.0, 0.0)]),
        Tile::rectangle(square, q(2.0, 2.0), q(2.0, 2.0)),
    ];
    let lattice = Lattice::new([q(4.0, 0.0), q(0.0, 4.0)], &tiles);
    Plan { lattice, kinds, width: Q / 2.0, floor: &[], lift: &[] }
}

/// 16 and 17: hexagons ringed by squares and triangles; kinds of the squares above, to the upper and to the
/// lower right, of the triangles to the left and right, and of the hexagon.
fn ringed([a, b, c, d, e, f]: [u8; 6], kinds: u8) -> Plan {
    let x = -1.0 + H * A / 2.0;
    let tiles = [
        square(a, [A / 2.0, 0.0], 0.0),
        square(b, [x, A / 4.0], 30.0),
        square(c, [x, -A / 4.0], 60.0),
        right(d, [A - 2.0 * R, 0.0]),
        left(e, [2.0 * R, 0.0]),
        hexagon(f, [-1.0, 0.0]),
    ];
    let lattice = Lattice::new([[H * A, A / 2.0], [0.0, A]], &tiles);
    Plan { lattice, kinds, width: R, floor: &[], lift: &[] }
}

/// 19 and 20: each hexagon with eight triangles; the steps are mirror images.
fn snub(is_left: bool) -> Plan {
    let (steps, ups, downs, centre) = if is_left {
        ([[2.5, -H], [2.0, 2.0 * H]], [-1.5, -0.5, 0.5, 2.5], [-4.0, -2.0, -1.0, 0.0], [-1.0, 0.0])
    } else {
        (
            [[0.5, 3.0 * H], [-2.0, 2.0 * H]],
            [-3.5, -0.5, 1.5, 2.5],
            [-4.0, -3.0, -1.0, 2.0],
            [0.5, -H],
        )
    };
    let mut tiles = vec![hexagon(2, centre)];
    tiles.extend(ups.map(|x| up(0, [x, -5.0 * R])));
    tiles.extend(downs.map(|x| down(1, [x, -4.0 * R])));
    let lattice = Lattice::new(steps, &tiles);
    Plan { lattice, kinds: 3, width: R, floor: &[(2, 1e-6)], lift: &[] }
}

/// 23 and 24: dodecagons with hexagons, of kind 0, and squares between them; kinds of the squares above, to
/// the upper right and to the upper left, and of the dodecagon.
fn twelve([a, b, c, d]: [u8; 4], kinds: u8) -> Plan {
    let x = 1.5 + H;
    let tiles = [
        hexagon(0, [0.0, A / 2.0]),
        hexagon(0, [x, 0.0]),
        square(a, [0.0, A], 0.0),
        square(b, [x / 2.0, A / 4.0], 60.0),
        square(c, [-x / 2.0, A / 4.0], 30.0),
        dodecagon(d, [0.0, -A / 2.0]),
    ];
    let lattice = Lattice::new([[2.0 * x, 0.0], [x, x * ROOT_3]], &tiles);
    Plan { lattice, kinds, width: 0.5, floor: &[], lift: &[] }
}
