//! The cells of the integer lattice around a few points, side by side.
//!
//! **In:** `L` points as lanes: three arrays of coordinates. **Out:** per axis, the lattice planes on both sides
//! of each point, with the point's offset from each and the weight of each. **Invariant:** lanes do not affect
//! each other: each has the same bits as alone.
//!
//! Loops run over the lanes of one operation at a time, so that the compiler makes vector instructions of them.
//! They are written as loops because `map` of arrays is not always inlined (measured: it took half of the time).

#![expect(clippy::needless_range_loop, reason = "one form for all loops over lanes")]

/// `L` points: x, y and z of each.
pub(super) type Lanes<const L: usize> = [[f64; L]; 3];

/// Adding this rounds a number to an integer, and moves it to the low bits: 1.5 · 2⁵².
const ROUNDING: f64 = 6_755_399_441_055_744.0;

/// Below this, the sum with [`ROUNDING`] plus an origin is exact: 2⁵⁰.
const FAR: f64 = 1_125_899_906_842_624.0;

/// Coordinates of `L` points along one axis, between their lattice neighbours.
#[derive(Clone, Copy)]
pub(super) struct Axis<const L: usize> {
    /// Indices of the lower neighbours; only the low 32 bits are those of the index.
    pub low: [usize; L],
    /// Offsets from the lower and the upper neighbours to the points, −1 … 1.
    pub offset: [[f64; L]; 2],
    /// Weights of the lower and the upper neighbours, 0 … 1.
    pub weight: [[f64; L]; 2],
}

impl<const L: usize> Axis<L> {
    /// Splits coordinates that are [near](are_near). `origin` is the number of the lattice plane at 0.
    ///
    /// Avoids `floor`, which is a function call unless the target is known to support it.
    #[inline(always)]
    pub fn new(coordinates: [f64; L], origin: f64) -> Self {
        let mut low = [0.0; L];
        for l in 0..L {
            low[l] = (coordinates[l] + ROUNDING) - ROUNDING;
        }
        for l in 0..L {
            low[l] -= if low[l] > coordinates[l] { 1.0 } else { 0.0 };
        }
        let mut offset = [[0.0; L]; 2];
        for l in 0..L {
            offset[0][l] = coordinates[l] - low[l];
        }
        let mut weight = [[0.0; L]; 2];
        for l in 0..L {
            let t = offset[0][l];
            weight[1][l] = t * t * (3.0 - 2.0 * t);
        }
        for l in 0..L {
            weight[0][l] = 1.0 - weight[1][l];
        }
        for l in 0..L {
            offset[1][l] = offset[0][l] - 1.0;
        }
        let mut index = [0; L];
        for l in 0..L {
            index[l] = (low[l] + (ROUNDING + origin)).to_bits() as usize;
        }
        Self { low: index, offset, weight }
    }
}

/// Returns whether all coordinates are small enough for [`Axis::new`]; false if any is NaN.
#[inline(always)]
pub(super) fn are_near<const L: usize>(points: &Lanes<L>) -> bool {
    let mut near = true;
    for along in points {
        for c in along {
            near &= c.abs() < FAR;
        }
    }
    near
}
