//! Perlin's gradient noise: zero at every lattice point, a random slope through each.
//!
//! **Source:** Perlin, "An Image Synthesizer", 1985; which slopes, scale and offset: found by
//! experiment on POV-Ray 3.7, whose values at lattice points are all 0.4925, whose gradients there
//! are 2048 vectors of length 0.795, each in the ratio of three whole numbers.

use std::sync::LazyLock;

use super::cells;
use super::range::Linear;
use super::table::Stream;
use crate::math::Vector;
use crate::math::interval::Interval;

const SIZE: usize = 2048;

/// The program adds this to each coordinate and keeps what `f64` leaves of the sum: coordinates
/// come in steps of 2⁻²⁹.
const ORIGIN: f64 = 10_000_000.023_157_213;

/// About 0.4925.
pub(super) fn noise(point: Vector) -> f64 {
    let lattice = &*LATTICE;
    let [x, y, z] = cells(point + Vector::splat(ORIGIN), 0);
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

/// Coordinates as the lattice has them.
pub(super) fn shifted(i: Interval) -> Interval {
    Interval { low: i.low + ORIGIN, high: i.high + ORIGIN }
}

/// What a lattice point holds.
pub(super) fn corner([i, j, k]: [usize; 3]) -> Linear {
    let lattice = &*LATTICE;
    let column = lattice.step(lattice.step(i).wrapping_add(j));
    let Vector { x, y, z } = lattice.gradients[column.wrapping_add(k) % SIZE];
    [0.0, x, y, z]
}

struct Lattice {
    steps: [u16; SIZE],
    /// Of length 1.
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

/// Evenly spread: what of the cube is outside the ball is drawn again.
fn direction(stream: &mut Stream) -> Vector {
    loop {
        let v = Vector::from_array([(); 3].map(|()| stream.below(4096) as f64 - 2048.0));
        let squared = v.length_squared();
        if (1.0..=2048.0 * 2048.0).contains(&squared) {
            return v / squared.sqrt();
        }
    }
}

/// Every other number changes places, starting one behind the last: so the table holds 0 twice,
/// and 1017 not at all.
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
            assert!((noise(lattice) - 0.4925).abs() < 1e-8);
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
