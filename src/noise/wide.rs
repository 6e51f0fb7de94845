//! The first component of the vector noise at four points at once.
//!
//! **Invariant:** each has the bits of the noise at one point.

use super::table::ROWS;
use super::{LATTICE_ORIGIN, lattice, step};
use crate::math::wide::*;

/// Coordinates of four points along one axis, between their lattice neighbours: as [`lattice::Axis`].
struct Axis<S: Simd> {
    low: [usize; LANES],
    offset: [Wide<S>; 2],
    weight: [Wide<S>; 2],
}

impl<S: Simd> Axis<S> {
    #[inline(always)]
    fn new(simd: S, coordinates: &[f64; LANES]) -> Self {
        let coordinates = Wide::from_slice(simd, coordinates);
        let (rounding, one) = (all(simd, lattice::ROUNDING), all(simd, 1.0));
        let low = (coordinates + rounding) - rounding;
        let low = low - low.simd_gt(coordinates).select(one, all(simd, 0.0));
        let t = coordinates - low;
        let upper = t * t * (all(simd, 3.0) - all(simd, 2.0) * t);
        let numbered = low + all(simd, lattice::ROUNDING + LATTICE_ORIGIN as f64);
        let mut index = [0.0; LANES];
        numbered.store_slice(&mut index);
        let mut low = [0; LANES];
        for l in 0..LANES {
            low[l] = index[l].to_bits() as usize;
        }
        Self { low, offset: [t, t - one], weight: [one - upper, upper] }
    }
}

/// Returns the noise at points whose coordinates are [near](lattice::are_near).
#[inline(always)]
pub(super) fn first<S: Simd>(simd: S, points: &[[f64; LANES]; 3]) -> [f64; LANES] {
    let x = Axis::new(simd, &points[0]);
    let y = Axis::new(simd, &points[1]);
    let z = Axis::new(simd, &points[2]);
    let mut places = [[0; LANES]; 8];
    for l in 0..LANES {
        for i in 0..2 {
            let row = step(x.low[l].wrapping_add(i));
            for j in 0..2 {
                let column = step(row ^ y.low[l].wrapping_add(j));
                for k in 0..2 {
                    places[i << 2 | j << 1 | k][l] = step(column ^ z.low[l].wrapping_add(k)) % 256;
                }
            }
        }
    }
    let mut sum = all(simd, 0.0);
    for i in 0..2 {
        for j in 0..2 {
            let column = x.weight[i] * y.weight[j];
            for k in 0..2 {
                let rows = corner(simd, &places[i << 2 | j << 1 | k]);
                let value = rows[0] + rows[1] * x.offset[i];
                let value = value + rows[2] * y.offset[j];
                let value = value + rows[3] * z.offset[k];
                sum += column * z.weight[k] * value;
            }
        }
    }
    let mut values = [0.0; LANES];
    sum.store_slice(&mut values);
    values
}

/// Returns the values at four lattice points, and the gradients along each axis.
#[inline(always)]
fn corner<S: Simd>(simd: S, places: &[usize; LANES]) -> [Wide<S>; 4] {
    let [a, b, c, d] = places;
    let (a, b, c, d) = (&ROWS[*a].0, &ROWS[*b].0, &ROWS[*c].0, &ROWS[*d].0);
    [
        Wide::simd_from(simd, [a[0], b[0], c[0], d[0]]),
        Wide::simd_from(simd, [a[1], b[1], c[1], d[1]]),
        Wide::simd_from(simd, [a[2], b[2], c[2], d[2]]),
        Wide::simd_from(simd, [a[3], b[3], c[3], d[3]]),
    ]
}
