//! Noise at four points. Often these are neighbours in one cell of the lattice: then its corners are looked up once.
//!
//! **In:** points as lanes, and a bit for each that counts. **Out:** lanes; those that do not count have any value.
//! **Invariant:** each point has the bits that it has alone.

#![expect(
    clippy::needless_range_loop,
    reason = "closures would not be inlined where the instructions are"
)]

use super::lattice::{FAR, TO_LOW_BITS, smooth};
use super::table::{CornerRow, ROWS, TRIPLES, Triple};
use super::{LATTICE_ORIGIN, NoiseGenerator, SCALE, SHIFT, hashes, noise_by, triple};
use crate::math::Vector;
use crate::math::wide::*;

/// Returns [`super::noise`] at four points.
#[inline(always)]
pub(crate) fn noise_of_four<S: Simd>(
    simd: S,
    generator: NoiseGenerator,
    points: WideVector<S>,
    lanes: u32,
) -> Wide<S> {
    if generator != NoiseGenerator::Perlin {
        let cells = Cells::new(simd, points);
        if let Some(low) = cells.shared(points, lanes) {
            let plain = cells.blend(&ROWS, hashes(low));
            let noise = match generator {
                NoiseGenerator::RangeCorrected => (plain + 0.5 + SHIFT) * SCALE,
                _ => plain + 0.5,
            };
            return noise.max(all(simd, 0.0)).min(all(simd, 1.0));
        }
    }
    let points = arrays(points);
    let mut noise = [0.0; LANES];
    for lane in 0..LANES {
        if lanes >> lane & 1 == 1 {
            noise[lane] = noise_by(simd, generator, at(&points, lane));
        }
    }
    Wide::simd_from(simd, noise)
}

/// Returns [`super::vector_noise`] at four points.
#[inline(always)]
pub(super) fn triples_of_four<S: Simd>(
    simd: S,
    points: WideVector<S>,
    lanes: u32,
) -> WideVector<S> {
    let cells = Cells::new(simd, points);
    if let Some(low) = cells.shared(points, lanes) {
        return cells.blend_triples(&TRIPLES, hashes(low));
    }
    let points = arrays(points);
    let mut noise = [[0.0; LANES]; 3];
    for lane in 0..LANES {
        if lanes >> lane & 1 == 1 {
            let triple: [f64; 4] = triple(simd, at(&points, lane)).into();
            (noise[0][lane], noise[1][lane], noise[2][lane]) = (triple[0], triple[1], triple[2]);
        }
    }
    let [x, y, z] = noise;
    WideVector([Wide::simd_from(simd, x), Wide::simd_from(simd, y), Wide::simd_from(simd, z)])
}

#[inline(always)]
fn arrays<S: Simd>(WideVector([x, y, z]): WideVector<S>) -> [[f64; LANES]; 3] {
    [x.into(), y.into(), z.into()]
}

#[inline(always)]
fn at([x, y, z]: &[[f64; LANES]; 3], lane: usize) -> Vector {
    Vector::new(x[lane], y[lane], z[lane])
}

/// Four points between their lattice neighbours; see [`super::lattice::Cell`].
struct Cells<S: Simd> {
    simd: S,
    low: WideVector<S>,
    offset: [WideVector<S>; 2],
    weight: [WideVector<S>; 2],
}

impl<S: Simd> Cells<S> {
    #[inline(always)]
    fn new(simd: S, points: WideVector<S>) -> Self {
        let WideVector([x, y, z]) = points;
        let low = WideVector([x.floor(), y.floor(), z.floor()]);
        let one = WideVector::splat(simd, Vector::ONE);
        let t = points - low;
        let WideVector([x, y, z]) = t;
        let upper = WideVector([smooth(simd, x), smooth(simd, y), smooth(simd, z)]);
        Self { simd, low, offset: [t, t - one], weight: [one - upper, upper] }
    }

    /// Returns the indices of the lower neighbours if all points that count have the same.
    #[inline(always)]
    fn shared(&self, points: WideVector<S>, lanes: u32) -> Option<[usize; 3]> {
        let Self { simd, low: WideVector([x, y, z]), .. } = *self;
        let first = lanes.trailing_zeros() as usize % LANES;
        let [a, b, c] = [x, y, z].map(|low| <[f64; LANES]>::from(low)[first]);
        let same = x.simd_eq(all(simd, a)) & y.simd_eq(all(simd, b)) & z.simd_eq(all(simd, c));
        let (far, WideVector([x, y, z])) = (all(simd, FAR), points.abs());
        let near = x.simd_lt(far) & y.simd_lt(far) & z.simd_lt(far);
        let index = |low: f64| (low + (TO_LOW_BITS + LATTICE_ORIGIN as f64)).to_bits() as usize;
        let shared = (same & near).to_bitmask() as u32;
        (shared & lanes == lanes).then(|| [index(a), index(b), index(c)])
    }

    #[inline(always)]
    fn blend<const N: usize>(&self, table: &[CornerRow; N], places: [usize; 8]) -> Wide<S> {
        let [x, y, z] = [self.weights(0), self.weights(1), self.weights(2)];
        let value = self.component(table, &places, 0, [x, y, z]);
        let by_x = self.component(table, &places, 1, [self.weighted(0), y, z]);
        let by_y = self.component(table, &places, 2, [x, self.weighted(1), z]);
        let by_z = self.component(table, &places, 3, [x, y, self.weighted(2)]);
        (value + by_x) + (by_y + by_z)
    }

    #[inline(always)]
    fn weights(&self, axis: usize) -> [Wide<S>; 2] {
        [self.weight[0].0[axis], self.weight[1].0[axis]]
    }

    #[inline(always)]
    fn weighted(&self, axis: usize) -> [Wide<S>; 2] {
        let [near, far] = self.weights(axis);
        [near * self.offset[0].0[axis], far * self.offset[1].0[axis]]
    }

    /// Returns the blend of one of the numbers of the corners.
    #[inline(always)]
    fn component<const N: usize>(
        &self,
        table: &[CornerRow; N],
        places: &[usize; 8],
        component: usize,
        [x, y, z]: [[Wide<S>; 2]; 3],
    ) -> Wide<S> {
        let mut lines = [all(self.simd, 0.0); 4];
        for column in 0..4 {
            let CornerRow(near) = &table[places[2 * column] % N];
            let CornerRow(far) = &table[places[2 * column + 1] % N];
            lines[column] =
                all(self.simd, near[component]) * z[0] + all(self.simd, far[component]) * z[1];
        }
        let planes = [lines[0] * y[0] + lines[1] * y[1], lines[2] * y[0] + lines[3] * y[1]];
        planes[0] * x[0] + planes[1] * x[1]
    }

    #[inline(always)]
    fn blend_triples(&self, table: &[Triple; 256], places: [usize; 8]) -> WideVector<S> {
        let [x, y, z] = [self.weights(0), self.weights(1), self.weights(2)];
        let mut blend = [all(self.simd, 0.0); 3];
        for component in 0..3 {
            let mut lines = [all(self.simd, 0.0); 4];
            for column in 0..4 {
                let at = [self.offset[column >> 1].0[0], self.offset[column & 1].0[1]];
                let [near, far] = [places[2 * column] % 256, places[2 * column + 1] % 256];
                lines[column] = self.there(&table[near], component, at, self.offset[0].0[2]) * z[0]
                    + self.there(&table[far], component, at, self.offset[1].0[2]) * z[1];
            }
            let planes = [lines[0] * y[0] + lines[1] * y[1], lines[2] * y[0] + lines[3] * y[1]];
            blend[component] = planes[0] * x[0] + planes[1] * x[1];
        }
        WideVector(blend)
    }

    #[inline(always)]
    fn there(
        &self,
        Triple([value, by_x, by_y, by_z]): &Triple,
        component: usize,
        [x, y]: [Wide<S>; 2],
        z: Wide<S>,
    ) -> Wide<S> {
        (all(self.simd, value[component]) + all(self.simd, by_x[component]) * x)
            + (all(self.simd, by_y[component]) * y + all(self.simd, by_z[component]) * z)
    }
}
