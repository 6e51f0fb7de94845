//! Perlin's gradient noise: the value at every lattice point is zero, with a random gradient.
//!
//! **Source:** Perlin, "An Image Synthesizer", 1985; gradients, scale and offset found by experiment on
//! POV-Ray 3.7: its values at lattice points are all 0.4925, and its gradients there are 2048 vectors of
//! length 0.795, each in a ratio of three integers.

use std::sync::LazyLock;

use super::lattice::Cell;
use super::range::Linear;
use super::table::{CornerRow, Stream};
use crate::math::Vector;
use crate::math::interval::Interval;
use crate::math::wide::Simd;

const SIZE: usize = 2048;

/// POV-Ray adds this to each coordinate in `f64`, which rounds coordinates to multiples of 2⁻²⁹.
const ORIGIN: f64 = 10_000_000.023_157_213;

/// Noise around 0.4925.
#[inline(always)]
pub(super) fn noise<S: Simd>(simd: S, point: Vector) -> f64 {
    let lattice = &*LATTICE;
    let cell = Cell::new(simd, point + Vector::splat(ORIGIN), 0.0);
    0.4925 + 0.795 * cell.blend(&lattice.gradients, lattice.places(cell.low))
}

/// Returns [`noise`] and its slopes along x, y and z.
#[inline(always)]
pub(super) fn noise_and_slopes<S: Simd>(simd: S, point: Vector) -> (f64, [f64; 3]) {
    let lattice = &*LATTICE;
    let cell = Cell::new(simd, point + Vector::splat(ORIGIN), 0.0);
    let (value, [x, y, z]) = cell.blend_and_slopes(&lattice.gradients, lattice.places(cell.low));
    (0.4925 + 0.795 * value, [0.795 * x, 0.795 * y, 0.795 * z])
}

/// Converts coordinates to those of the lattice.
pub(super) fn shifted(i: Interval) -> Interval {
    Interval { low: i.low + ORIGIN, high: i.high + ORIGIN }
}

/// The data of the corners of a cell, by x, then y, then z.
#[inline(always)]
pub(super) fn corners(low: [usize; 3]) -> [Linear; 8] {
    let lattice = &*LATTICE;
    lattice.places(low).map(|place| lattice.gradients[place % SIZE].0)
}

struct Lattice {
    steps: [u16; SIZE],
    /// Unit vectors, each after the value 0.
    gradients: [CornerRow; SIZE],
}

static LATTICE: LazyLock<Lattice> = LazyLock::new(Lattice::draw);

impl Lattice {
    fn draw() -> Self {
        let mut stream = Stream::open(1);
        let gradients = [(); SIZE].map(|()| {
            let Vector { x, y, z } = direction(&mut stream);
            CornerRow([0.0, x, y, z])
        });
        Self { steps: half_shuffled(&mut stream), gradients }
    }

    #[inline(always)]
    fn step(&self, index: usize) -> usize {
        usize::from(self.steps[index % SIZE])
    }

    /// Returns the places of the corners of a cell, by x, then y, then z.
    #[inline(always)]
    fn places(&self, [x, y, z]: [usize; 3]) -> [usize; 8] {
        let mut places = [0; 8];
        for i in 0..2 {
            let row = self.step(x.wrapping_add(i));
            for j in 0..2 {
                let column = self.step(row.wrapping_add(y.wrapping_add(j)));
                for k in 0..2 {
                    places[i << 2 | j << 1 | k] = column.wrapping_add(z.wrapping_add(k));
                }
            }
        }
        places
    }
}

/// Uniformly distributed: points of the cube outside of the ball are rejected.
fn direction(stream: &mut Stream) -> Vector {
    loop {
        let v = Vector::from_array([(); 3].map(|()| stream.below(4096) as f64 - 2048.0));
        let squared = v.length_squared();
        if (1.0..=2048.0 * 2048.0).contains(&squared) {
            return v / squared.sqrt();
        }
    }
}

/// Swaps only every other number, starting one past the end: so the table contains 0 twice, and 1017 not at
/// all.
fn half_shuffled(stream: &mut Stream) -> [u16; SIZE] {
    let mut steps = [0; SIZE + 1];
    for (i, step) in steps[..SIZE].iter_mut().enumerate() {
        *step = i as u16;
    }
    for i in (2..=SIZE).rev().step_by(2) {
        steps.swap(i, stream.below(SIZE as u32));
    }
    let mut kept = [0; SIZE];
    kept.copy_from_slice(&steps[..SIZE]);
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::wide::{Instructions, dispatch};

    #[test]
    fn every_lattice_point_has_the_mean_value() {
        for x in -40..40 {
            let lattice = Vector::new(f64::from(x), 7.0, -3.0) - Vector::splat(ORIGIN.fract());
            let value = dispatch!(Instructions::best().level(), simd => noise(simd, lattice));
            assert!((value - 0.4925).abs() < 1e-8);
        }
    }

    #[test]
    fn one_number_is_doubled_and_one_is_missing() {
        let mut steps = LATTICE.steps;
        steps.sort_unstable();
        assert_eq!(steps[..3], [0, 0, 1]);
        assert!(!steps.contains(&1017));
        assert!(steps[1..].windows(2).all(|pair| pair[0] < pair[1]));
    }
}
