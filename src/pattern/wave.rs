//! Frequency, phase and wave form, which turn the value of a pattern into the position in its map.
//!
//! **In:** the raw value of a pattern. **Out:** a position in a map, 0 … 1 but for the cases below.
//! **Invariant:** finite for every finite value.
//!
//! With a frequency other than 0, the value becomes value·frequency + phase, reduced modulo 1.00001 towards
//! zero: so exactly 1 stays 1, but each further period starts 10⁻⁵ later. With frequency 0 the value stays as
//! it is, without the phase, and may exceed 1. A negative number then increases by the whole number that
//! makes it 0 … 1. The wave form comes last.
//!
//! **Source:** POV-Ray manual, sections "Frequency and Phase" and "Waveforms"; the modulus, the order and the
//! formulas measured on POV-Ray 3.7, as well as that frequency, phase and the exponent of `poly_wave` are in
//! single precision.

use std::f64::consts::{PI, TAU};
use std::fmt;

use super::Measured;
use crate::math::elementary;
use crate::math::finite::single;
use crate::math::interval::Interval;

/// The modulus.
const PERIOD: f64 = 1.000_01;

/// The form of a wave.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum WaveKind {
    /// `ramp_wave`: the position itself.
    #[default]
    Ramp,
    /// `triangle_wave`: up to 1 in the middle, and down again.
    Triangle,
    /// `sine_wave`: starts in the middle, at ½.
    Sine,
    /// `scallop_wave`: the absolute value of half a turn of the sine.
    Scallop,
    /// `cubic_wave`: from 0 to 1, level at both ends.
    Cubic,
    /// `poly_wave`: the position to the power of an exponent.
    Poly(f64),
}

/// Writes the word, as in the language.
impl fmt::Display for WaveKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Ramp => f.write_str("ramp_wave"),
            Self::Triangle => f.write_str("triangle_wave"),
            Self::Sine => f.write_str("sine_wave"),
            Self::Scallop => f.write_str("scallop_wave"),
            Self::Cubic => f.write_str("cubic_wave"),
            Self::Poly(exponent) => write!(f, "poly_wave {exponent}"),
        }
    }
}

/// A wave form with its frequency and phase.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wave {
    kind: WaveKind,
    frequency: f64,
    phase: f64,
}

impl Default for Wave {
    fn default() -> Self {
        Self { kind: WaveKind::Ramp, frequency: 1.0, phase: 0.0 }
    }
}

/// Writes the words, as in the language.
impl fmt::Display for Wave {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} frequency {} phase {}", self.kind, self.frequency, self.phase)
    }
}

impl Wave {
    /// Builds a wave; its numbers are rounded to single precision.
    pub fn new(kind: WaveKind, frequency: f64, phase: f64) -> Self {
        let kind = match kind {
            WaveKind::Poly(exponent) => WaveKind::Poly(single(exponent)),
            other => other,
        };
        Self { kind, frequency: single(frequency), phase: single(phase) }
    }

    pub fn kind(&self) -> WaveKind {
        self.kind
    }

    pub fn frequency(&self) -> f64 {
        self.frequency
    }

    pub fn phase(&self) -> f64 {
        self.phase
    }

    /// Returns the position in the map of a pattern's value.
    #[inline]
    pub fn value(&self, raw: f64) -> f64 {
        self.kind.value(lifted(self.reduced(self.scaled(raw))))
    }

    /// Returns an interval that contains the position of every value in `raw`.
    pub fn bounds(&self, raw: Interval) -> Interval {
        let is_reduced = self.frequency == 0.0 || raw.low >= 0.0 && raw.high <= 1.0;
        if self.kind == WaveKind::Ramp && raw.low >= 0.0 && is_reduced && self.keeps_range() {
            return raw;
        }
        let reduced = match self.frequency == 0.0 {
            true => raw,
            false => {
                let scaled = raw * Interval::point(self.frequency) + Interval::point(self.phase);
                match scaled.is_finite() {
                    true => scaled.fmod(Interval::point(PERIOD)),
                    false => Interval { low: -PERIOD, high: PERIOD },
                }
            }
        };
        let floor = reduced.low.floor();
        let lifted = if reduced.low >= 0.0 {
            reduced
        } else if floor == reduced.high.floor() {
            reduced - Interval::point(floor)
        } else {
            Interval { low: 0.0, high: reduced.high.max(1.0) }
        };
        self.kind.bounds(Interval { low: lifted.low.max(0.0), high: lifted.high })
    }

    /// Returns an interval that contains the slopes between the positions of any two values in `raw`.
    pub fn steepness(&self, raw: Interval) -> Interval {
        let (scaled, speed) = match self.frequency == 0.0 {
            true => (raw, Interval::point(1.0)),
            false => {
                let frequency = Interval::point(self.frequency);
                (raw * frequency + Interval::point(self.phase), frequency)
            }
        };
        let is_within = |low: f64, high: f64| low <= scaled.low && scaled.high <= high;
        // From −1 to 0, and from 0 on, nothing jumps; frequency 0 goes on beyond 1.
        let is_steady = is_within(0.0, if self.frequency == 0.0 { f64::MAX } else { 1.0 })
            || is_within(-1.0, (-0.0f64).next_down());
        match is_steady {
            true => speed * self.kind.steepness(),
            false => Interval::EVERYTHING,
        }
    }

    /// Returns the position with its error bound. A value whose error cannot separate it from a jump of the
    /// wave is on its far side, where a period starts.
    #[inline]
    pub fn measured(&self, raw: Measured) -> Measured {
        if raw.error == 0.0 {
            return Measured { value: self.value(raw.value), error: 0.0 };
        }
        self.measured_near(raw)
    }

    fn measured_near(&self, raw: Measured) -> Measured {
        let scaled = self.scaled(raw.value);
        let slope = if self.frequency == 0.0 { 1.0 } else { self.frequency.abs() };
        let error = raw.error * slope + scaled.abs() * (2.0 * f64::EPSILON);
        let mut reduced = self.reduced(scaled);
        if self.frequency != 0.0 && reduced.abs().min(PERIOD - reduced.abs()) <= error {
            reduced = 0.0;
        } else if reduced < 0.0 && (reduced - reduced.round()).abs() <= error {
            reduced = reduced.round();
        }
        let position = lifted(reduced);
        let value = self.kind.value(position);
        let near = Interval { low: (position - error).max(0.0), high: position + error };
        let Interval { low, high } = self.kind.bounds(near);
        Measured { value, error: (high - value).max(value - low).clamp(0.0, f64::MAX) }
    }

    /// Whether values in 0 … 1 stay as they are, apart from the wave form.
    fn keeps_range(&self) -> bool {
        self.frequency == 0.0 || self.frequency == 1.0 && self.phase == 0.0
    }

    #[inline]
    fn scaled(&self, raw: f64) -> f64 {
        if self.frequency == 0.0 { raw } else { raw * self.frequency + self.phase }
    }

    #[inline]
    fn reduced(&self, scaled: f64) -> f64 {
        if self.frequency == 0.0 || scaled.abs() < PERIOD {
            scaled
        } else if scaled.is_finite() {
            elementary::fmod(scaled, PERIOD)
        } else {
            0.0
        }
    }
}

impl WaveKind {
    /// Returns an interval that contains the slopes between any two positions; of a cubic, those in 0 … 1.
    fn steepness(self) -> Interval {
        let between = |low: f64, high: f64| Interval { low, high };
        match self {
            Self::Ramp => between(1.0, 1.0),
            Self::Triangle => between(-2.0, 2.0),
            Self::Sine | Self::Scallop => between(-PI.next_up(), PI.next_up()),
            Self::Cubic | Self::Poly(_) => Interval::EVERYTHING,
        }
    }

    /// The image of a number that is not negative.
    #[inline]
    fn value(self, position: f64) -> f64 {
        let value = match self {
            Self::Ramp => return position,
            Self::Triangle => {
                let part = position - position.floor();
                return if part < 0.5 { 2.0 * part } else { 2.0 * (1.0 - part) };
            }
            Self::Sine => return 0.5 * (1.0 + elementary::sin(TAU * position.min(FAR))),
            Self::Scallop => return elementary::sin(PI * position.min(FAR)).abs(),
            Self::Cubic => position * position * (3.0 - 2.0 * position),
            Self::Poly(exponent) => elementary::pow(position.abs(), exponent),
        };
        value.clamp(f64::MIN, f64::MAX)
    }

    /// Returns an interval that contains the image of each number; `of` has no negative ones.
    fn bounds(self, of: Interval) -> Interval {
        const RANGE: Interval = Interval { low: 0.0, high: 1.0 };
        let inside = |i: Interval| i.max(Interval::point(0.0)).min(Interval::point(1.0));
        match self {
            Self::Ramp => of,
            Self::Triangle => {
                if of.high - of.low >= 0.5 || of.low.floor() != of.high.floor() {
                    return RANGE;
                }
                let ends = Interval::between(self.value(of.low), self.value(of.high));
                let crest = of.low.floor() + 0.5;
                if of.contains(crest) { Interval { high: 1.0, ..ends } } else { ends }
            }
            Self::Sine => {
                let wave = Interval::sin(of.min(Interval::point(FAR)) * Interval::point(TAU));
                inside((wave + Interval::point(1.0)) * Interval::point(0.5))
            }
            Self::Scallop => {
                inside(Interval::sin(of.min(Interval::point(FAR)) * Interval::point(PI)).abs())
            }
            Self::Cubic | Self::Poly(_) => {
                let ends = Interval::between(self.value(of.low), self.value(of.high));
                // The cubic rises up to 1, and falls from there.
                let has_crest = self == Self::Cubic && of.contains(1.0);
                let high = if has_crest { 1.0 } else { ends.high };
                // Widened by what the elementary functions round.
                let Interval { low, high } = Interval { high, ..ends }.rising(|value| value);
                Interval { low: low.max(f64::MIN), high: high.min(f64::MAX) }
            }
        }
    }
}

/// Positions beyond this, which only frequency 0 has, count as this in a sine.
const FAR: f64 = 1e15;

/// Increases a negative number by the whole number that makes it 0 … 1.
#[inline]
fn lifted(reduced: f64) -> f64 {
    if reduced < 0.0 { reduced - reduced.floor() } else { reduced }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::{Random, tries};

    fn kinds(exponent: f64) -> [WaveKind; 6] {
        use WaveKind::*;
        [Ramp, Triangle, Sine, Scallop, Cubic, Poly(exponent)]
    }

    #[test]
    fn values_are_those_of_pov_ray() {
        let mut rows = 0;
        for line in include_str!("measured/wave.txt").lines().filter(|l| !l.starts_with('#')) {
            let row: Vec<f64> = line.split(' ').map(|n| n.parse().expect("a number")).collect();
            let [kind, exponent, frequency, phase, raw, measured] = row[..] else {
                panic!("six numbers in {line}");
            };
            let wave = Wave::new(kinds(exponent)[kind as usize], frequency, phase);
            let value = wave.value(raw);
            assert!((value - measured).abs() < 2e-14 * measured.abs().max(1.0), "{line}: {value}");
            rows += 1;
        }
        assert!(rows > 100, "{rows}");
    }

    #[test]
    fn without_frequency_phase_and_form_values_up_to_one_stay_as_they_are() {
        let wave = Wave::default();
        let mut random = Random(3);
        for raw in (0..tries()).map(|_| random.number(0.0, 1.0)).chain([0.0, 1e-300, 1.0]) {
            assert_eq!(wave.value(raw).to_bits(), raw.to_bits());
            assert_eq!(wave.bounds(Interval::point(raw)), Interval::point(raw));
        }
    }

    fn wild(random: &mut Random) -> f64 {
        let size = [0.0, 1.0, 3.0, 1e-300, 1e300, 1e9][random.below(6)];
        [random.number(-1.0, 1.0) * size, size, -size][random.below(3)]
    }

    fn any(random: &mut Random) -> Wave {
        let exponent = [random.number(-2.0, 3.0), wild(random)][random.below(2)];
        let kind = kinds(exponent)[random.below(6)];
        let frequency = [1.0, random.number(-3.0, 3.0), wild(random)][random.below(3)];
        let phase = [0.0, random.number(-3.0, 3.0), wild(random)][random.below(3)];
        Wave::new(kind, frequency, phase)
    }

    #[test]
    fn bounds_contain_the_values_between_them() {
        let mut random = Random(7);
        let mut narrow = 0;
        for _ in 0..tries() {
            let wave = any(&mut random);
            let low = [random.number(-2.0, 2.0), wild(&mut random)][random.below(2)];
            let width = [0.0, 1e-9, 0.01, 0.4, 3.0][random.below(5)];
            let raw = Interval { low, high: low + width };
            let bounds = wave.bounds(raw);
            narrow += usize::from(width > 0.0 && bounds.high - bounds.low < 10.0 * width);
            for part in [0.0, random.number(0.0, 1.0), 0.5, 1.0] {
                let at = (low + width * part).min(raw.high);
                let value = wave.value(at);
                assert!(value.is_finite(), "{wave:?} {at}");
                assert!(bounds.contains(value), "{wave:?} {raw:?}: {value} not in {bounds:?}");
            }
        }
        assert!(narrow > tries() / 10, "{narrow}");
    }

    #[test]
    fn the_error_of_a_position_covers_what_an_error_of_the_value_may_do() {
        let mut random = Random(8);
        for _ in 0..tries() {
            let wave = any(&mut random);
            let raw = random.number(-2.0, 2.0);
            let error = [1e-12, 1e-6][random.below(2)];
            let told = wave.measured(Measured { value: raw, error });
            assert!(told.value.is_finite() && told.error.is_finite());
            for off in [-0.99, 0.3, 0.99] {
                let off = wave.measured(Measured { value: raw + off * error, error });
                let apart = (off.value - told.value).abs();
                // On the two sides of a jump that is settled for one of them only, they may differ.
                assert!(
                    apart <= told.error + off.error
                        || told.value.min(off.value) < 3e-5
                        || apart > 0.4,
                    "{wave:?} {raw} {told:?} {off:?}"
                );
            }
        }
    }

    #[test]
    fn a_value_that_may_be_where_a_period_starts_is_there() {
        let wave = Wave::new(WaveKind::Ramp, -1.0, 0.0);
        for off in [-1e-13, 0.0, 1e-13] {
            let told = wave.measured(Measured { value: off, error: 1e-12 });
            assert_eq!(told.value, 0.0, "{off}");
        }
        assert!(wave.measured(Measured { value: 1e-11, error: 1e-12 }).value > 0.9);
    }
}
