//! Random numbers for the cells of the unit lattice: the point that `crackle` has in each cell, and the value
//! that `cells` has there.
//!
//! **Invariant:** equal to POV-Ray 3.7's, out to 2·10⁹ cells.
//!
//! **Source:** found by experiment on POV-Ray 3.7. The distances of `crackle form x` locate the points; their
//! coordinates are consecutive outputs of the Mersenne Twister, divided by 2³²; the first is selected by the
//! same walk through a shuffled table as the data of noise. M. Matsumoto, T. Nishimura, "Mersenne Twister: A
//! 623-dimensionally equidistributed uniform pseudorandom number generator", ACM Transactions on Modeling and
//! Computer Simulation 8, 1998.

use crate::math::Vector;
use crate::noise::cell_number;

/// Returns three random numbers, 0 … 1, for a cell.
#[inline]
pub(super) fn numbers(cell: [i64; 3]) -> Vector {
    let at = cell_number(cell);
    Vector::new(NUMBERS[at], NUMBERS[at + 1], NUMBERS[at + 2])
}

/// Returns the cell with these lower ends. Beyond 2⁶³ the conversion saturates, so all of those cells are
/// alike.
#[inline]
pub(super) fn cell_at(low: Vector) -> [i64; 3] {
    low.to_array().map(|low| low as i64)
}

/// One start for each of 4096 places, and two more numbers for the last of them.
const COUNT: usize = 4096 + 2;

/// The size of the generator's state.
const SIZE: usize = 624;

static NUMBERS: [f64; COUNT] = generated();

/// Returns the generator's first outputs from its standard seed, 0 … 1.
const fn generated<const COUNT: usize>() -> [f64; COUNT] {
    let mut state = [5489_u32; SIZE];
    let mut i = 1;
    while i < SIZE {
        let last = state[i - 1];
        state[i] = (last ^ (last >> 30)).wrapping_mul(1_812_433_253).wrapping_add(i as u32);
        i += 1;
    }
    let mut numbers = [0.0; COUNT];
    let mut i = 0;
    while i < COUNT {
        let at = i % SIZE;
        let joined = (state[at] & 0x8000_0000) | (state[(at + 1) % SIZE] & 0x7fff_ffff);
        let twist = if joined & 1 == 1 { 0x9908_b0df } else { 0 };
        state[at] = state[(at + 397) % SIZE] ^ (joined >> 1) ^ twist;
        numbers[i] = tempered(state[at]) as f64 / 4_294_967_296.0;
        i += 1;
    }
    numbers
}

const fn tempered(mut word: u32) -> u32 {
    word ^= word >> 11;
    word ^= (word << 7) & 0x9d2c_5680;
    word ^= (word << 15) & 0xefc6_0000;
    word ^ (word >> 18)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ten_thousandth_number_is_the_documented_one() {
        // **Source:** ISO C++, section "Engines and engine adaptors with predefined parameters".
        let last = generated::<10_000>()[9_999] * 4_294_967_296.0;
        assert_eq!(last, 4_123_659_995.0);
    }

    #[test]
    fn numbers_are_within_their_cell_and_repeat_every_4096_cells() {
        for i in 0..1000 {
            let cell = [i - 500, i * i, -3];
            let here = numbers(cell);
            assert!(here.min_element() >= 0.0 && here.max_element() < 1.0);
            assert_eq!(here, numbers([cell[0] + 4096, cell[1] - 8192, cell[2] + 409_600]));
        }
    }
}
