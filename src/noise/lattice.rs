//! The cell of the integer lattice around a point, and the blend of what its corners have at the point.
//!
//! **In:** a point, and the data of the corners. **Out:** a number, or four side by side. **Invariant:** the same bits
//! for all instructions.
//!
//! The data of a corner are four numbers side by side, weighted and summed as such: along z, then y, then x.

use super::table::{CornerRow, Triple};
use crate::math::Vector;
use crate::math::wide::*;

/// Adding this moves an integer to the low bits: 1.5 · 2⁵².
pub(super) const TO_LOW_BITS: f64 = 6_755_399_441_055_744.0;

/// Below this, the sum with [`TO_LOW_BITS`] plus an origin is exact: 2⁵⁰.
pub(super) const FAR: f64 = 1_125_899_906_842_624.0;

/// The lattices repeat after as many units along each axis.
const PERIOD: f64 = 4096.0;

/// A point between its lattice neighbours.
pub(super) struct Cell<S: Simd> {
    simd: S,
    /// Indices of the lower neighbours along x, y and z; only the low 32 bits are those of the index.
    pub low: [usize; 3],
    /// Offsets from the lower and the upper neighbours to the point, −1 … 1, by axis.
    offset: [[f64; 4]; 2],
    /// Weights of the lower and the upper neighbours, 0 … 1, by axis.
    weight: [[f64; 4]; 2],
    /// Products of both.
    weighted: [[f64; 4]; 2],
}

impl<S: Simd> Cell<S> {
    /// Finds the cell of any point. `origin` is the number of the lattice plane at 0.
    #[inline(always)]
    pub fn new(simd: S, mut point: Vector, origin: f64) -> Self {
        if !is_near(point) {
            point = brought_near(point);
        }
        let point = Wide::simd_from(simd, [point.x, point.y, point.z, 0.0]);
        let low = point.floor();
        let index: [f64; 4] = (low + (TO_LOW_BITS + origin)).into();
        let t = point - low;
        let upper = smooth(simd, t);
        let (offset, weight) = ([t, t - 1.0], [all(simd, 1.0) - upper, upper]);
        Self {
            simd,
            low: [0, 1, 2].map(|axis| index[axis].to_bits() as usize),
            offset: [offset[0].into(), offset[1].into()],
            weight: [weight[0].into(), weight[1].into()],
            weighted: [(weight[0] * offset[0]).into(), (weight[1] * offset[1]).into()],
        }
    }

    /// Returns the blend of the linear functions of the corners, which `places` selects, by x, then y, then z.
    #[inline(always)]
    pub fn blend<const N: usize>(&self, table: &[CornerRow; N], places: [usize; 8]) -> f64 {
        let [x, y, z] = [self.weights(0), self.weights(1), self.weights(2)];
        let line = self.lines(table, places, z);
        let plane = [line[0] * y[0] + line[1] * y[1], line[2] * y[0] + line[3] * y[1]];
        sum(plane[0] * x[0] + plane[1] * x[1])
    }

    /// Returns [`Cell::blend`] and its slopes along x, y and z.
    #[inline(always)]
    pub fn blend_and_slopes<const N: usize>(
        &self,
        table: &[CornerRow; N],
        places: [usize; 8],
    ) -> (f64, [f64; 3]) {
        let [x, y, z] = [self.weights(0), self.weights(1), self.weights(2)];
        let [by_x, by_y, by_z] = [self.rises(0), self.rises(1), self.rises(2)];
        let line = self.lines(table, places, z);
        let plane = [line[0] * y[0] + line[1] * y[1], line[2] * y[0] + line[3] * y[1]];
        let along_y =
            [line[0] * by_y[0] + line[1] * by_y[1], line[2] * by_y[0] + line[3] * by_y[1]];
        let line = self.lines(table, places, by_z);
        let along_z = [line[0] * y[0] + line[1] * y[1], line[2] * y[0] + line[3] * y[1]];
        let value = sum(plane[0] * x[0] + plane[1] * x[1]);
        let slopes = [
            sum(plane[0] * by_x[0] + plane[1] * by_x[1]),
            sum(along_y[0] * x[0] + along_y[1] * x[1]),
            sum(along_z[0] * x[0] + along_z[1] * x[1]),
        ];
        (value, slopes)
    }

    /// Returns the blends along z.
    #[inline(always)]
    fn lines<const N: usize>(
        &self,
        table: &[CornerRow; N],
        places: [usize; 8],
        z: [Wide<S>; 2],
    ) -> [Wide<S>; 4] {
        [
            self.row(table, places[0]) * z[0] + self.row(table, places[1]) * z[1],
            self.row(table, places[2]) * z[0] + self.row(table, places[3]) * z[1],
            self.row(table, places[4]) * z[0] + self.row(table, places[5]) * z[1],
            self.row(table, places[6]) * z[0] + self.row(table, places[7]) * z[1],
        ]
    }

    #[inline(always)]
    fn row<const N: usize>(&self, table: &[CornerRow; N], place: usize) -> Wide<S> {
        let CornerRow(row) = table[place % N];
        Wide::simd_from(self.simd, row)
    }

    /// Returns what the corners on both sides along an axis are multiplied by: all by the weight, and the component of
    /// the gradient by the offset, too.
    #[inline(always)]
    fn weights(&self, axis: usize) -> [Wide<S>; 2] {
        let mut weights = [[self.weight[0][axis]; 4], [self.weight[1][axis]; 4]];
        weights[0][1 + axis] = self.weighted[0][axis];
        weights[1][1 + axis] = self.weighted[1][axis];
        [Wide::simd_from(self.simd, weights[0]), Wide::simd_from(self.simd, weights[1])]
    }

    /// Returns the slopes of [`Cell::weights`] along their axis.
    #[inline(always)]
    fn rises(&self, axis: usize) -> [Wide<S>; 2] {
        let [near, far] = [self.offset[0][axis], self.offset[1][axis]];
        let rise = -6.0 * near * far;
        let mut rises = [[-rise; 4], [rise; 4]];
        rises[0][1 + axis] = self.weight[0][axis] - rise * near;
        rises[1][1 + axis] = self.weight[1][axis] + rise * far;
        [Wide::simd_from(self.simd, rises[0]), Wide::simd_from(self.simd, rises[1])]
    }

    /// Returns the blend of three linear functions of each of the corners; a fourth is 0.
    #[inline(always)]
    pub fn blend_triples(&self, table: &[Triple; 256], places: [usize; 8]) -> Wide<S> {
        let [x, y] =
            [[self.weight[0][0], self.weight[1][0]], [self.weight[0][1], self.weight[1][1]]];
        let plane = [
            self.line(table, &places, 0) * y[0] + self.line(table, &places, 1) * y[1],
            self.line(table, &places, 2) * y[0] + self.line(table, &places, 3) * y[1],
        ];
        plane[0] * x[0] + plane[1] * x[1]
    }

    /// Returns the blend along z, where the bits of `column` are the sides of x and of y.
    #[inline(always)]
    fn line(&self, table: &[Triple; 256], places: &[usize; 8], column: usize) -> Wide<S> {
        let [x, y] = [self.offset[column >> 1][0], self.offset[column & 1][1]];
        let [near, far] = [&table[places[2 * column] % 256], &table[places[2 * column + 1] % 256]];
        self.there(near, [x, y, self.offset[0][2]]) * self.weight[0][2]
            + self.there(far, [x, y, self.offset[1][2]]) * self.weight[1][2]
    }

    /// Returns the three linear functions of a corner at this offset.
    #[inline(always)]
    fn there(&self, Triple([value, by_x, by_y, by_z]): &Triple, [x, y, z]: [f64; 3]) -> Wide<S> {
        let [by_x, by_y] = [Wide::simd_from(self.simd, *by_x), Wide::simd_from(self.simd, *by_y)];
        let [value, by_z] = [Wide::simd_from(self.simd, *value), Wide::simd_from(self.simd, *by_z)];
        (value + by_x * x) + (by_y * y + by_z * z)
    }
}

/// Returns the sum of the lanes.
#[inline(always)]
fn sum<S: Simd>(lanes: Wide<S>) -> f64 {
    let [a, b, c, d] = lanes.into();
    (a + b) + (c + d)
}

/// Returns 3t² − 2t³.
#[inline(always)]
pub(super) fn smooth<S: Simd>(simd: S, t: Wide<S>) -> Wide<S> {
    t * t * (all(simd, 3.0) - t * 2.0)
}

/// Returns whether the number of each coordinate is exact; false if one is NaN.
#[inline(always)]
fn is_near(point: Vector) -> bool {
    point.x.abs() < FAR && point.y.abs() < FAR && point.z.abs() < FAR
}

/// Returns the point of the same noise near the origin. What is not finite counts as 0.
#[cold]
#[inline(never)]
fn brought_near(point: Vector) -> Vector {
    let near = |coordinate: f64| if coordinate.is_finite() { coordinate % PERIOD } else { 0.0 };
    Vector::from_array(point.to_array().map(near))
}
