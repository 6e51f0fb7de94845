//! Bounds of a surface of any degree: a box and a sphere that contain it, if it is bounded.
//!
//! **In:** the terms. **Out:** [`Ends`]; `None` if the surface is unbounded, or if the search takes too long.
//! **Invariant:** the polynomial is proven to have no zero outside of the bounds.
//!
//! For degree n, tⁿ·f at (1, v, w) / t is a polynomial in v, w and t, and likewise for the other axes; its
//! terms without t are those of the highest degree. If it has no zero for |v|, |w| ≤ 1 and |t| ≤ T, f has
//! none outside of a cube of half width 1 / T. The sides of that cube are then moved inward, past parts where
//! f has no zero.
//!
//! **Source:** A. Neumaier, "Complete search in continuous global optimization and constraint satisfaction",
//! Acta Numerica 13 (2004), section 11 (branch and bound).

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use super::super::U;
use super::net::{Net, Sides, Term};
use crate::math::Vector;
use crate::math::terms::exponents;

/// Budget of the entire search in additions, plus a number of halvings for polynomials with many terms; each
/// partial search may use a fraction of the rest.
const SUMS: u64 = 2_000_000;
const HALVINGS: u64 = 400;
const PART: u64 = 8;
/// Relative to λ, the scale at which no term outweighs those of the highest degree: half width of the cube in
/// which smaller surfaces are searched.
const NEAR: f64 = 2.0;
/// Maximum number of times that the cube shrinks before its final sides are computed.
const ROUNDS: usize = 8;
/// Tolerance of the box's sides, relative to its half widths: while it shrinks, and for the final sides.
const COARSE: f64 = 0.25;
const FINE: f64 = 1.0 / 64.0;
/// Tolerance of the sphere's radius, relative to the distance of the box's corners.
const ROUND: f64 = 1.0 / 16.0;
/// Maximum number of roundings of a bound, relative to the size of its terms.
const ROUNDINGS: f64 = 64.0;

/// Bounds of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ends {
    centre: Vector,
    half: Vector,
    /// Radius of a sphere around the centre.
    radius: f64,
    /// Whether the inside is bounded, rather than the outside.
    pub is_solid: bool,
}

impl Ends {
    pub fn of(degree: usize, terms: &[f64]) -> Option<Self> {
        let all = terms.iter().copied().zip(exponents(degree));
        let terms: Vec<Term> = all.filter(|(term, _)| *term != 0.0).collect();
        let degree = terms.iter().map(|(_, powers)| powers.iter().sum()).max().unwrap_or(0);
        // What is of odd degree has both signs far out.
        if degree == 0 || degree % 2 == 1 {
            return None;
        }
        let highest = terms.iter().find(|(_, powers)| powers[0] == degree)?;
        let is_solid = highest.0 > 0.0;
        let mut sums = SUMS;
        let mut far = NEAR;
        for axis in 0..3 {
            far = far.max(reach_of_faces(degree, &terms, axis, &mut sums)?);
        }
        let mut sides = [0, 1, 2].map(|axis| one_or_both(&terms, axis, far));
        let nowhere = Self { centre: Vector::ZERO, half: Vector::ZERO, radius: 0.0, is_solid };
        for _ in 0..ROUNDS {
            let Some(drawn) = drawn_in(&terms, sides, COARSE, &mut sums) else {
                return Some(nowhere);
            };
            let is_done = drawn.iter().zip(sides).all(|(new, old)| width(*new) > 0.5 * width(old));
            sides = drawn;
            if is_done {
                break;
            }
        }
        let Some(sides) = drawn_in(&terms, sides, FINE, &mut sums) else { return Some(nowhere) };
        let all: Sides = std::array::from_fn(|axis| match sides[axis] {
            (_, high) if is_even(&terms, axis) => (-high, high),
            both => both,
        });
        let centre = Vector::from_array(all.map(|(low, high)| 0.5 * (low + high)));
        let half = Vector::from_array(all.map(|side| 0.5 * width(side)));
        let radius = radius(&terms, sides, centre, half.length(), &mut sums);
        // The centre was rounded, and so were places of parts.
        let room = ROUNDINGS * U * (centre.abs() + half);
        let (half, radius) = (half + room, radius + room.length());
        (half.is_finite() && centre.is_finite()).then_some(Self { centre, half, radius, is_solid })
    }

    /// Returns bounds on the minimum and maximum of `along`·P.
    pub fn extent(&self, along: Vector) -> (f64, f64) {
        let half = along.abs().dot(self.half).min(self.radius * along.length());
        let slack = ROUNDINGS * U * (along.abs().dot(self.centre.abs()) + half);
        self.around(along, half + slack)
    }

    /// Returns the best estimate of [`Self::extent`].
    pub fn nearest_extent(&self, along: Vector) -> (f64, f64) {
        self.around(along, along.abs().dot(self.half).min(self.radius * along.length()))
    }

    fn around(&self, along: Vector, half: f64) -> (f64, f64) {
        let middle = along.dot(self.centre);
        (middle - half, middle + half)
    }

    /// Returns the maximum length of a line inside the sphere around the origin that contains the surface,
    /// measured from the line's closest approach to the origin, whose distance is at least `nearest`.
    pub fn half_chord(&self, nearest: f64) -> f64 {
        let reach = self.reach();
        ((reach - nearest) * (reach + nearest)).max(0.0).sqrt() * (1.0 + ROUNDINGS * U)
    }

    /// Returns the radius of a sphere around the origin that contains it.
    pub fn reach(&self) -> f64 {
        let farthest = (self.centre.abs() + self.half).length();
        let reach = farthest.min(self.centre.length() + self.radius);
        reach * (1.0 + ROUNDINGS * U)
    }
}

fn width((low, high): (f64, f64)) -> f64 {
    high - low
}

/// Returns whether the polynomial is even in the coordinate.
fn is_even(terms: &[Term], axis: usize) -> bool {
    terms.iter().all(|(_, powers)| powers[axis] % 2 == 0)
}

/// Returns a range on both sides of 0, or on one side if the polynomial is even.
fn one_or_both(terms: &[Term], axis: usize, far: f64) -> (f64, f64) {
    (if is_even(terms, axis) { 0.0 } else { -far }, far)
}

/// Minimum and maximum distance of a range from a value.
fn distances((low, high): (f64, f64), from: f64) -> [f64; 2] {
    let (low, high) = (low - from, high - from);
    let least = if low * high <= 0.0 { 0.0 } else { low.abs().min(high.abs()) };
    [least, low.abs().max(high.abs())]
}

/// Returns the coordinate along an axis beyond which there is no surface, where no other coordinate is
/// larger.
fn reach_of_faces(degree: usize, terms: &[Term], axis: usize, sums: &mut u64) -> Option<f64> {
    let others = [(axis + 1) % 3, (axis + 2) % 3];
    let around = terms.iter().map(|(term, powers)| {
        let sum: usize = powers.iter().sum();
        (*term, [powers[others[0]], powers[others[1]], degree - sum])
    });
    let around: Vec<Term> = around.collect();
    let most = [1.0, 1.0, 1.0 / NEAR];
    let net = Net::new(&around, [0, 1, 2].map(|axis| one_or_both(&around, axis, most[axis])));
    // −|t|
    let reach = |sides: &Sides| {
        let [least, most] = distances(sides[2], 0.0);
        [-most, -least]
    };
    let tolerance = |reached: f64| if reached.is_finite() { 0.25 * -reached } else { 0.0 };
    let nearest = farthest(net, reach, tolerance, sums).map_or(most[2], |reach| -reach);
    (nearest > 0.0).then(|| (1.0 + ROUNDINGS * U) / nearest)
}

/// Moves the sides of a box inward, up to this fraction of its half widths from the surface; `None` if the
/// box contains no surface.
fn drawn_in(terms: &[Term], sides: Sides, share: f64, sums: &mut u64) -> Option<Sides> {
    let net = Net::new(terms, sides);
    let mut drawn = sides;
    for (axis, drawn) in drawn.iter_mut().enumerate() {
        let tolerance = 0.5 * share * width(*drawn);
        let room = ROUNDINGS * U * drawn.0.abs().max(drawn.1.abs());
        let upper = |sides: &Sides| [sides[axis].0, sides[axis].1];
        let high = farthest(net.clone(), upper, |_| tolerance, sums)?;
        drawn.1 = drawn.1.min(high + room);
        if !is_even(terms, axis) {
            let lower = |sides: &Sides| [-sides[axis].1, -sides[axis].0];
            let low = -farthest(net.clone(), lower, |_| tolerance, sums)?;
            drawn.0 = drawn.0.max(low - room);
        }
    }
    Some(drawn)
}

/// Returns the radius of a sphere around a box's centre that contains the surface in it; at most `corner`,
/// the distance to the corners.
fn radius(terms: &[Term], sides: Sides, centre: Vector, corner: f64, sums: &mut u64) -> f64 {
    let reach = |sides: &Sides| {
        let away = [0, 1, 2].map(|axis| distances(sides[axis], centre[axis]));
        [0, 1].map(|end| Vector::from_array(away.map(|away| away[end])).length())
    };
    let tolerance = |_| corner * ROUND;
    farthest(Net::new(terms, sides), reach, tolerance, sums).map_or(corner, |far| far.min(corner))
}

/// A part where the polynomial may be 0.
struct Open {
    /// Minimum and maximum of the bounded quantity in it.
    reach: [f64; 2],
    net: Net,
}

impl PartialEq for Open {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Open {}

impl PartialOrd for Open {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Open {
    fn cmp(&self, other: &Self) -> Ordering {
        self.reach[1].total_cmp(&other.reach[1])
    }
}

/// Returns an upper bound on how far the surface extends in a net, where `reach` returns the minimum and
/// maximum of a part. The bound is too large by at most the tolerance, which may depend on a lower bound of
/// the result; by more if the search exceeds its budget. `None` if there is no surface.
fn farthest(
    net: Net,
    reach: impl Fn(&Sides) -> [f64; 2],
    tolerance: impl Fn(f64) -> f64,
    sums: &mut u64,
) -> Option<f64> {
    let price = net.price();
    let most = *sums / PART + HALVINGS / PART * price;
    let mut taken = 0;
    let mut reached = f64::NEG_INFINITY;
    let mut open = BinaryHeap::new();
    let look = |net: Net, reached: &mut f64, open: &mut BinaryHeap<Open>| {
        if net.sign().is_some() {
            return;
        }
        let reach = reach(&net.sides());
        if net.is_crossed() {
            *reached = reached.max(reach[0]);
        }
        open.push(Open { reach, net });
    };
    look(net, &mut reached, &mut open);
    let mut found = None;
    while let Some(Open { reach: [least, most_far], net }) = open.pop() {
        let enough = tolerance(reached);
        let is_near = most_far - reached <= enough || most_far - least <= enough / 16.0;
        let axis = net.steepest().filter(|_| !is_near && taken < most);
        let Some(axis) = axis else {
            found = Some(most_far);
            break;
        };
        taken += price;
        for half in net.halves(axis) {
            look(half, &mut reached, &mut open);
        }
    }
    *sums = sums.saturating_sub(taken);
    found
}
