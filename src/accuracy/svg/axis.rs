//! A logarithmic scale between two positions on the page.
//!
//! **Invariant:** equal ratios have equal lengths, and at least two ticks have numbers.

use crate::math::elementary::{log10, pow};

/// Minimum ratio of the scale's ends.
const LEAST: f64 = 4.0;
/// Margin around the values, as a factor.
const ROOM: f64 = 1.4;

pub struct Axis {
    pub low: f64,
    pub high: f64,
    from: f64,
    to: f64,
}

impl Axis {
    /// Creates a scale for all positive finite values, with a margin around them.
    pub fn around(values: impl Iterator<Item = f64>, from: f64, to: f64) -> Self {
        let valid = values.filter(|value| value.is_finite() && *value > 0.0);
        let ends = |(low, high): (f64, f64), v: f64| (low.min(v), high.max(v));
        let (low, high) = valid.fold((f64::INFINITY, 0.0), ends);
        let (low, high) = if low <= high { (low / ROOM, high * ROOM) } else { (0.1, 10.0) };
        let more = (LEAST / (high / low)).max(1.0).sqrt();
        Self { low: low / more, high: high * more, from, to }
    }

    /// Returns the position of a value, clamped to the ends of the scale.
    pub fn at(&self, value: f64) -> f64 {
        let value = value.clamp(self.low, self.high);
        let part = log10(value / self.low) / log10(self.high / self.low);
        self.from + part * (self.to - self.from)
    }

    /// Returns grid lines at 1 … 9 times powers of ten, each with whether it has a number: those at 1 do,
    /// at least in every other decade, and, if there is room, those at 2 and 5, or all.
    pub fn ticks(&self) -> Vec<(f64, bool)> {
        let decades = log10(self.high / self.low);
        let named = |digit: u32, exponent: i32| match digit {
            1 => decades < 6.0 || exponent % 2 == 0,
            2 | 5 => decades < 3.0,
            _ => decades < 1.0,
        };
        let mut ticks = Vec::new();
        for exponent in log10(self.low).floor() as i32..=log10(self.high).ceil() as i32 {
            for digit in 1..10 {
                let value = f64::from(digit) * pow(10.0, f64::from(exponent));
                if (self.low..=self.high).contains(&value) {
                    ticks.push((value, named(digit, exponent)));
                }
            }
        }
        ticks
    }
}

/// Formats a digit times a power of ten, as short as possible.
pub fn number(value: f64) -> String {
    let exponent = log10(value * 1.000_001).floor();
    if (-3.0..4.0).contains(&exponent) {
        let digits = (-exponent).max(0.0) as usize;
        format!("{value:.digits$}")
    } else {
        format!("{value:.0e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_axis_is_even_in_ratios_and_names_its_powers_of_ten() {
        let axis = Axis::around([0.001, 10.0, f64::NAN, 0.0, -1.0].into_iter(), 0.0, 100.0);
        let steps: Vec<f64> = [0.01, 0.1, 1.0].map(|v| axis.at(v * 10.0) - axis.at(v)).to_vec();
        assert!((steps[0] - steps[1]).abs() < 1e-9 && (steps[1] - steps[2]).abs() < 1e-9);
        let named: Vec<String> =
            axis.ticks().into_iter().filter(|tick| tick.1).map(|tick| number(tick.0)).collect();
        assert_eq!(named, ["0.001", "0.01", "0.1", "1", "10"]);
        assert!(Axis::around(std::iter::empty(), 0.0, 1.0).at(1.0).is_finite());
    }

    #[test]
    fn at_least_two_ticks_have_numbers() {
        for place in 0..300 {
            let value = pow(10.0, f64::from(place) / 50.0 - 3.0);
            for ratio in [1.0, 1.7, 6.0, 45.0, 1e3, 1e5, 1e8] {
                let axis = Axis::around([value, value * ratio].into_iter(), 0.0, 1.0);
                let named = axis.ticks().iter().filter(|tick| tick.1).count();
                assert!((2..=11).contains(&named), "{value} {ratio}: {named}");
            }
        }
    }

    #[test]
    fn numbers_are_short() {
        let short = [0.002, 0.05, 0.5, 2.0, 5000.0, 2e-5, 1e7].map(number);
        assert_eq!(short, ["0.002", "0.05", "0.5", "2", "5000", "2e-5", "1e7"]);
    }
}
