//! Perlin's gradient noise: the value at every lattice point is zero, with a random gradient.
//!
//! **Source:** Perlin, "An Image Synthesizer", 1985; gradients, scale and offset found by experiment on
//! POV-Ray 3.7: its values at lattice points are all 0.4925, and its gradients there are 2048 vectors of
//! length 0.795, each in a ratio of three integers.

#![expect(clippy::needless_range_loop, reason = "one form for all loops over lanes")]

use std::sync::LazyLock;

use super::cells;
use super::lattice::{Axis, Lanes, are_near};
use super::range::Linear;
use super::table::Stream;
use crate::math::Vector;
use crate::math::interval::Interval;

const SIZE: usize = 2048;

/// POV-Ray adds this to each coordinate in `f64`, which rounds coordinates to multiples of 2⁻²⁹.
const ORIGIN: f64 = 10_000_000.023_157_213;

/// Noise around 0.4925.
#[inline(never)]
pub(super) fn noise<const L: usize>(points: Lanes<L>) -> [f64; L] {
    let mut shifted = points;
    for along in &mut shifted {
        for c in along {
            *c += ORIGIN;
        }
    }
    if !are_near(&shifted) {
        return far(shifted);
    }
    let lattice = &*LATTICE;
    let [x, y, z] = shifted;
    let (x, y, z) = (Axis::new(x, 0.0), Axis::new(y, 0.0), Axis::new(z, 0.0));
    let mut sum = [0.0; L];
    for i in 0..2 {
        for j in 0..2 {
            for k in 0..2 {
                for l in 0..L {
                    let row = lattice.step(x.low[l].wrapping_add(i));
                    let column = lattice.step(row.wrapping_add(y.low[l].wrapping_add(j)));
                    let place = column.wrapping_add(z.low[l].wrapping_add(k)) % SIZE;
                    let offset = Vector::new(x.offset[i][l], y.offset[j][l], z.offset[k][l]);
                    let weight = x.weight[i][l] * y.weight[j][l] * z.weight[k][l];
                    sum[l] += weight * lattice.gradients[place].dot(offset);
                }
            }
        }
    }
    for sum in &mut sum {
        *sum = 0.4925 + 0.795 * *sum;
    }
    sum
}

/// [`noise`], for coordinates of any size, already shifted.
#[cold]
#[inline(never)]
fn far<const L: usize>([x, y, z]: Lanes<L>) -> [f64; L] {
    std::array::from_fn(|l| noise_far(Vector::new(x[l], y[l], z[l])))
}

fn noise_far(shifted: Vector) -> f64 {
    let lattice = &*LATTICE;
    let [x, y, z] = cells(shifted, 0);
    let mut sum = 0.0;
    for (i, x) in x.corners() {
        let row = lattice.step(i);
        for (j, y) in y.corners() {
            let column = lattice.step(row.wrapping_add(j));
            let weight = x.weight * y.weight;
            for (k, z) in z.corners() {
                let gradient = lattice.gradients[column.wrapping_add(k) % SIZE];
                let offset = Vector::new(x.offset, y.offset, z.offset);
                sum += weight * z.weight * gradient.dot(offset);
            }
        }
    }
    0.4925 + 0.795 * sum
}

/// Converts coordinates to those of the lattice.
pub(super) fn shifted(i: Interval) -> Interval {
    Interval { low: i.low + ORIGIN, high: i.high + ORIGIN }
}

/// The data of a lattice point.
pub(super) fn corner([i, j, k]: [usize; 3]) -> Linear {
    let lattice = &*LATTICE;
    let column = lattice.step(lattice.step(i).wrapping_add(j));
    let Vector { x, y, z } = lattice.gradients[column.wrapping_add(k) % SIZE];
    [0.0, x, y, z]
}

struct Lattice {
    steps: [u16; SIZE],
    /// Unit vectors.
    gradients: [Vector; SIZE],
}

static LATTICE: LazyLock<Lattice> = LazyLock::new(Lattice::draw);

impl Lattice {
    fn draw() -> Self {
        let mut stream = Stream::open(1);
        let gradients = [(); SIZE].map(|()| direction(&mut stream));
        Self { steps: half_shuffled(&mut stream), gradients }
    }

    fn step(&self, index: usize) -> usize {
        usize::from(self.steps[index % SIZE])
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

    #[test]
    fn every_lattice_point_has_the_mean_value() {
        for x in -40..40 {
            let lattice = Vector::new(f64::from(x), 7.0, -3.0) - Vector::splat(ORIGIN.fract());
            let [value] = noise(lattice.to_array().map(|c| [c]));
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
