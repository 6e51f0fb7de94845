//! Bounds of an unbounded quadric that is clipped by planes, such as a bar, a bowl or a cooling tower.
//!
//! Inside it, q ≤ 0, and on the inner sides of two planes, a ≤ 0 and b ≤ 0. So q − ν·a·b ≤ 0 in the
//! intersection of the three for any ν ≥ 0, and for some ν this is an ellipsoid.
//!
//! **Invariant:** the bounds contain everything inside the quadric and on the inner sides of the planes.
//!
//! **Source:** S. Boyd, L. Vandenberghe, *Convex Optimization* (2004), B.2 (the S-procedure).

use smallvec::SmallVec;

use super::closed::Closed;
use super::{Algebraic, U};
use crate::math::Vector;
use crate::math::double::power_of_two;

/// Maximum number of planes of which pairs are tried, and the number of multipliers tried with each pair on
/// either side of the likeliest.
const MOST_PLANES: usize = 6;
const MULTIPLIERS: i32 = 3;
/// Maximum number of roundings of a coefficient, relative to the size of its terms.
const ROUNDINGS: f64 = 64.0;

/// The half-space normal · P ≤ offset.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HalfSpace {
    pub normal: Vector,
    pub offset: f64,
    /// Size of the numbers that the offset is computed from, which determines its rounding.
    pub size: f64,
}

impl Algebraic {
    /// Returns the minimum and maximum of each direction · P over the part of the inside that lies in all
    /// half-spaces, or over a superset of it; infinite where it is unbounded.
    pub fn clipped(&self, spaces: &[HalfSpace], directions: [Vector; 3]) -> [(f64, f64); 3] {
        let mut extents = [(f64::NEG_INFINITY, f64::INFINITY); 3];
        let Ok(terms) = <&[f64; 10]>::try_from(self.terms.as_slice()) else { return extents };
        let mut spaces: SmallVec<[HalfSpace; 8]> =
            spaces.iter().copied().take(MOST_PLANES).collect();
        spaces.extend(own_half_space(terms));
        let pairs = (0..spaces.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
        for (i, j) in pairs {
            let (a, b) = (spaces[i], spaces[j]);
            let likely = largest(&terms[..9]) / (a.normal.length() * b.normal.length());
            for power in -MULTIPLIERS..=MULTIPLIERS {
                let multiplier = likely * power_of_two(2 * power);
                let Some(closed) = Closed::of(&less_product(terms, multiplier, a, b)) else {
                    continue;
                };
                for (extent, direction) in extents.iter_mut().zip(directions) {
                    let (low, high) = closed.extent(direction);
                    *extent = (extent.0.max(low), extent.1.min(high));
                }
            }
        }
        extents
    }
}

fn largest(terms: &[f64]) -> f64 {
    terms.iter().fold(0.0, |most: f64, term| most.max(term.abs()))
}

/// The terms of q − ν·a·b, less the maximum that rounding may have added.
fn less_product(terms: &[f64; 10], multiplier: f64, a: HalfSpace, b: HalfSpace) -> [f64; 10] {
    let (m, n) = (a.normal, b.normal);
    let mixed = |i: usize, j: usize| m[i] * n[j] + m[j] * n[i];
    let linear = |i: usize| -(m[i] * b.offset + n[i] * a.offset);
    let product = [
        m.x * n.x,
        mixed(0, 1),
        mixed(0, 2),
        linear(0),
        m.y * n.y,
        mixed(1, 2),
        linear(1),
        m.z * n.z,
        linear(2),
        a.offset * b.offset,
    ];
    let mut all = [0.0; 10];
    for ((all, term), product) in all.iter_mut().zip(terms).zip(product) {
        *all = term - multiplier * product;
    }
    let size = |space: HalfSpace| space.normal.length() + space.size;
    let room = ROUNDINGS * U * (largest(terms) + multiplier * size(a) * size(b));
    // An error of each coefficient is no more than one of x², y², z² and 1 that is a few times as large.
    for square in [0, 4, 7, 9] {
        all[square] -= room;
    }
    all
}

/// Returns the half-space that contains a paraboloid along a local axis, or a bar; such quadrics have no
/// square term of that axis.
fn own_half_space(terms: &[f64; 10]) -> Option<HalfSpace> {
    let &[xx, xy, xz, x, yy, yz, y, zz, z, constant] = terms;
    // Of each axis: what must be 0, its own term, and the form and the terms of the two others.
    let axes = [
        ([xx, xy, xz], x, [yy, zz, yz], [y, z]),
        ([yy, xy, yz], y, [xx, zz, xz], [x, z]),
        ([zz, xz, yz], z, [xx, yy, xy], [x, y]),
    ];
    axes.into_iter().enumerate().find_map(|(axis, (zeros, own, [a, c, b], [d, e]))| {
        let determinant = a * c - 0.25 * b * b;
        let rises = a > 0.0 && c > 0.0 && determinant > 0.25 * a * c;
        if zeros != [0.0; 3] || own == 0.0 || !rises {
            return None;
        }
        // The least of the form and the terms of the two others: −(c·d² − b·d·e + a·e²) / 4·determinant.
        let depth = (c * d * d - b * d * e + a * e * e) / (4.0 * determinant);
        let size = (c * d * d + (b * d * e).abs() + a * e * e) / determinant + constant.abs();
        let mut normal = Vector::ZERO;
        normal[axis] = own;
        let offset = depth - constant + ROUNDINGS * U * size;
        Some(HalfSpace { normal, offset, size })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::{Random, tries};

    const AXES: [Vector; 3] = [Vector::X, Vector::Y, Vector::Z];

    fn below(axis: usize, offset: f64, way: f64) -> HalfSpace {
        HalfSpace { normal: AXES[axis] * way, offset: offset * way, size: offset.abs() }
    }

    fn clipped(terms: [f64; 10], spaces: &[HalfSpace]) -> [(f64, f64); 3] {
        let quadric = Algebraic::new(2, terms.to_vec()).expect("a quadric");
        quadric.clipped(spaces, AXES)
    }

    #[test]
    fn a_bar_a_bowl_a_cone_and_a_cooling_tower_end_between_planes() {
        let slab = [below(1, -2.0, -1.0), below(1, 3.0, 1.0)];
        let bar = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, -4.0];
        let tower = [1.0, 0.0, 0.0, 0.0, -0.5, 0.0, 0.0, 1.0, 0.0, -0.4];
        let cone = [1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 1.0, 0.0, 0.0];
        for (terms, widest) in [(bar, 2.0), (tower, 4.9_f64.sqrt()), (cone, 3.0)] {
            let [(x, _), (low, high), (_, z)] = clipped(terms, &slab);
            assert!((-2.0 * widest..=-widest).contains(&x), "{x} {terms:?}");
            assert!((widest..=2.0 * widest).contains(&z), "{z} {terms:?}");
            assert!((-5.0..=-2.0).contains(&low) && (3.0..=6.0).contains(&high), "{low} {high}");
        }
        // x² + z² − y ≤ 0 needs one plane.
        let bowl = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, -1.0, 1.0, 0.0, 0.0];
        let [(x, _), (low, high), _] = clipped(bowl, &[below(1, 1.5, 1.0)]);
        assert!((-2.0..=-1.5_f64.sqrt()).contains(&x), "{x}");
        assert!((-1.0..=0.0).contains(&low) && (1.5..=2.5).contains(&high), "{low} {high}");
        assert_eq!(clipped(bowl, &[below(1, 1.5, -1.0)])[0], (f64::NEG_INFINITY, f64::INFINITY));
        assert_eq!(clipped(bar, &slab[..1])[1], (f64::NEG_INFINITY, f64::INFINITY));
    }

    #[test]
    fn what_is_inside_and_between_lies_within() {
        let mut random = Random(51);
        let mut found = 0;
        for _ in 0..tries() / 10 {
            let terms: [f64; 10] = std::array::from_fn(|_| match random.below(3) {
                0 => 0.0,
                _ => random.number(-1.0, 1.0),
            });
            let spaces: Vec<HalfSpace> = (0..1 + random.below(3))
                .map(|_| {
                    let [x, y, z] = std::array::from_fn(|_| random.number(-1.0, 1.0));
                    let offset = random.number(-2.0, 2.0);
                    HalfSpace { normal: Vector::new(x, y, z), offset, size: offset.abs() }
                })
                .collect();
            let extents = clipped(terms, &spaces);
            let quadric = Algebraic::new(2, terms.to_vec()).expect("a quadric");
            for _ in 0..100 {
                let far = random.size(-1.0, 2.0);
                let [x, y, z] = std::array::from_fn(|_| far * random.number(-1.0, 1.0));
                let point = Vector::new(x, y, z);
                let held = spaces.iter().all(|s| s.normal.dot(point) <= s.offset);
                if !(held && quadric.at(&quadric.terms, point).0 <= 0.0) {
                    continue;
                }
                for (axis, (low, high)) in extents.into_iter().enumerate() {
                    found += usize::from(low.is_finite());
                    assert!(low <= point[axis] && point[axis] <= high, "{point} {extents:?}");
                }
            }
        }
        assert!(found > tries() / 100, "{found}");
    }
}
