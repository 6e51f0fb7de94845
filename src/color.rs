//! Colours, and how numbers encode light.
//!
//! **Invariant:** no other module implements a gamma curve. [`Rgb`] is light: linear, unbounded, `f64`. [`Color`] is a colour of the scene language:
//! light plus `filter` and `transmit`. Encoding for a display happens only in [`srgb_encode`].

mod web;

use crate::math::finite::single;
pub(crate) use web::{rounded, web};

use std::fmt;
use std::ops::{Add, AddAssign, Mul};

use crate::math::elementary::pow;

/// Linear red, green and blue: radiance, intensity or reflectance. 1 is the display's white.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Rgb {
    pub red: f64,
    pub green: f64,
    pub blue: f64,
}

impl Rgb {
    pub const BLACK: Self = Self::gray(0.0);
    pub const WHITE: Self = Self::gray(1.0);

    #[inline]
    pub const fn new(red: f64, green: f64, blue: f64) -> Self {
        Self { red, green, blue }
    }

    #[inline]
    pub const fn gray(value: f64) -> Self {
        Self::new(value, value, value)
    }

    #[inline]
    pub fn map(self, f: impl Fn(f64) -> f64) -> Self {
        Self::new(f(self.red), f(self.green), f(self.blue))
    }

    /// Clamps each component to at most 1.
    #[inline]
    pub fn at_most_one(self) -> Self {
        self.map(|c| c.min(1.0))
    }

    /// Returns the largest absolute component.
    #[inline]
    pub fn largest(self) -> f64 {
        self.red.abs().max(self.green.abs()).max(self.blue.abs())
    }

    /// Returns the brightness.
    ///
    /// **Source:** behaviour of POV-Ray 3.7, measured: where `adc_bailout` cuts rays through filters of one
    /// colour each.
    pub fn brightness(self) -> f64 {
        0.297 * self.red + 0.589 * self.green + 0.114 * self.blue
    }

    #[inline]
    pub fn is_black(self) -> bool {
        self == Self::BLACK
    }

    /// Returns whether any component is above zero.
    pub fn gives_light(self) -> bool {
        self.red > 0.0 || self.green > 0.0 || self.blue > 0.0
    }

    /// Replaces infinities by a large number, as POV-Ray 3.7 shows them (measured), and NaN by 0.
    #[inline]
    pub(crate) fn bounded(self) -> Self {
        if self.is_finite() {
            return self;
        }
        const LARGE: f64 = 1e9;
        self.map(|c| match c {
            _ if c.is_nan() => 0.0,
            _ if c.is_infinite() => LARGE.copysign(c),
            _ => c,
        })
    }

    #[inline]
    pub fn is_finite(self) -> bool {
        self.red.is_finite() && self.green.is_finite() && self.blue.is_finite()
    }

    pub fn components(self) -> [f64; 3] {
        [self.red, self.green, self.blue]
    }
}

/// Formats as in the scene language: `<1, 0.5, 0>`.
impl fmt::Display for Rgb {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // Adding zero turns −0 into 0.
        write!(f, "<{}, {}, {}>", self.red + 0.0, self.green + 0.0, self.blue + 0.0)
    }
}

impl Add for Rgb {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        Self::new(self.red + other.red, self.green + other.green, self.blue + other.blue)
    }
}

impl AddAssign for Rgb {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Mul for Rgb {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        Self::new(self.red * other.red, self.green * other.green, self.blue * other.blue)
    }
}

impl Mul<f64> for Rgb {
    type Output = Self;
    #[inline]
    fn mul(self, factor: f64) -> Self {
        self.map(|c| c * factor)
    }
}

/// A colour of the scene language: light, and how much light passes through, tinted (`filter`) or not
/// (`transmit`).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Color {
    pub rgb: Rgb,
    pub filter: f64,
    pub transmit: f64,
}

/// How clear a colour is that lets light through, beside the light that it lets through.
///
/// **Source:** POV-Ray 3.7's behaviour for scenes of both kinds, measured to 1/65,535.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Clearness {
    /// By `filter` and `transmit`.
    #[default]
    Current,
    /// In scenes for versions below 3.7: by `filter` as far as the brightest component is let through,
    /// and by `transmit`.
    Old,
}

impl Color {
    pub const BLACK: Self = Self::opaque(Rgb::BLACK);
    pub const WHITE: Self = Self::opaque(Rgb::WHITE);

    pub const fn opaque(rgb: Rgb) -> Self {
        Self { rgb, filter: 0.0, transmit: 0.0 }
    }

    /// Replaces NaN by 0, as in POV-Ray 3.7 (measured).
    pub(crate) fn of_numbers(self) -> Self {
        let number = |n: f64| if n.is_nan() { 0.0 } else { n };
        let (filter, transmit) = (number(self.filter), number(self.transmit));
        Self { rgb: self.rgb.map(number), filter, transmit }
    }

    /// Rounds each number to single precision, limited to finite numbers; NaN counts as 0.
    pub fn single(self) -> Self {
        let (filter, transmit) = (single(self.filter), single(self.transmit));
        Self { rgb: self.rgb.map(single), filter, transmit }
    }

    /// Returns whether any light passes through.
    #[inline]
    pub fn is_clear(self) -> bool {
        self.filter != 0.0 || self.transmit != 0.0
    }

    /// Returns the fraction of the light behind it that passes through: unchanged, plus tinted.
    #[inline]
    pub fn transmittance(self) -> Rgb {
        self.rgb.map(|c| c * self.filter + self.transmit)
    }

    /// Returns the same without the tint: `filter + transmit`.
    pub(crate) fn untinted(self) -> Rgb {
        Rgb::gray(self.filter + self.transmit)
    }

    /// Returns the colour of its own surface, scaled by its opacity. Negative if `filter` and `transmit` sum
    /// to more than 1.
    ///
    /// **Source:** behaviour of POV-Ray 3.7, measured with ambient, emission and diffuse light.
    #[inline]
    pub fn body(self, clearness: Clearness) -> Rgb {
        if !self.is_clear() {
            return self.rgb;
        }
        let filter = match clearness {
            Clearness::Current => self.filter,
            Clearness::Old => {
                let Rgb { red, green, blue } = self.rgb;
                self.filter * red.max(green).max(blue)
            }
        };
        self.rgb * (1.0 - filter - self.transmit)
    }

    /// Returns the sum with `weight` times `other`, per component.
    #[inline]
    pub fn plus(self, other: Self, weight: f64) -> Self {
        Self {
            rgb: self.rgb + other.rgb * weight,
            filter: self.filter + other.filter * weight,
            transmit: self.transmit + other.transmit * weight,
        }
    }

    /// Interpolates linearly from `self` to `other`, per component.
    #[inline]
    pub fn lerp(self, other: Self, t: f64) -> Self {
        let mix = |a: f64, b: f64| a + (b - a) * t;
        Self {
            rgb: Rgb::new(
                mix(self.rgb.red, other.rgb.red),
                mix(self.rgb.green, other.rgb.green),
                mix(self.rgb.blue, other.rgb.blue),
            ),
            filter: mix(self.filter, other.filter),
            transmit: mix(self.transmit, other.transmit),
        }
    }
}

/// Formats like [`Rgb`], with `filter` and `transmit` if they are not zero.
impl fmt::Display for Color {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.rgb.fmt(f)?;
        if self.filter != 0.0 {
            write!(f, " filter {}", self.filter)?;
        }
        if self.transmit != 0.0 {
            write!(f, " transmit {}", self.transmit)?;
        }
        Ok(())
    }
}

/// How the numbers of a scene's colours encode light.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Gamma {
    /// Light is the number to this power, > 0; 1 for linear numbers.
    Power(f64),
    /// The sRGB curve, continued above 1.
    Srgb,
}

impl Gamma {
    /// Linear numbers.
    pub const LINEAR: Self = Self::Power(1.0);

    /// Converts a component to light, ≥ 0; zero if it is negative or NaN.
    ///
    /// **Source:** `assumed_gamma` of POV-Ray 3.7, measured: within 1/65,535 of each up to 1, and above in
    /// radiance maps.
    #[inline]
    pub fn linear(self, component: f64) -> f64 {
        if component.is_nan() || component <= 0.0 {
            return 0.0;
        }
        match self {
            Self::Power(1.0) => component,
            Self::Power(exponent) => pow(component, exponent),
            Self::Srgb => srgb_decode(component),
        }
    }

    /// Converts a display value to the component that shows the same.
    ///
    /// **Source:** `srgb` of POV-Ray 3.7, measured: the curve continues above 1, its straight part below 0,
    /// and a power maps negative light to 0.
    pub fn of_srgb(self, encoded: f64) -> f64 {
        match self {
            Self::Power(1.0) => srgb_decode(encoded),
            Self::Power(exponent) => pow(srgb_decode(encoded).max(0.0), 1.0 / exponent),
            Self::Srgb => encoded,
        }
    }

    /// Converts light to a component: the inverse of [`Gamma::linear`].
    pub fn of_light(self, light: f64) -> f64 {
        match self {
            Self::Power(1.0) => light,
            Self::Power(exponent) => pow(light.max(0.0), 1.0 / exponent),
            Self::Srgb if light > 1.0 => 1.055 * pow(light, 1.0 / 2.4) - 0.055,
            Self::Srgb => srgb_encode(light),
        }
    }
}

impl Default for Gamma {
    fn default() -> Self {
        Self::LINEAR
    }
}

/// Formats as in the scene language: `2.2`, `srgb`.
impl fmt::Display for Gamma {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Power(exponent) => exponent.fmt(f),
            Self::Srgb => f.write_str("srgb"),
        }
    }
}

/// Encodes linear light by the sRGB curve, both 0 … 1; out-of-range values are clamped and NaN is 0.
///
/// **Source:** IEC 61966-2-1.
pub fn srgb_encode(linear: f64) -> f64 {
    if linear.is_nan() || linear <= 0.0 {
        0.0
    } else if linear >= 1.0 {
        1.0
    } else if linear <= 0.003_130_8 {
        linear * 12.92
    } else {
        1.055 * pow(linear, 1.0 / 2.4) - 0.055
    }
}

/// Returns the inverse of [`srgb_encode`].
pub fn srgb_decode(encoded: f64) -> f64 {
    if encoded <= 0.040_45 { encoded / 12.92 } else { pow((encoded + 0.055) / 1.055, 2.4) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_8_bit_value_survives_decoding_and_encoding() {
        for value in 0..=255u8 {
            let encoded = srgb_encode(srgb_decode(f64::from(value) / 255.0));
            assert_eq!((encoded * 255.0).round() as u8, value);
        }
    }

    #[test]
    fn srgb_is_converted_to_the_scenes_gamma_as_povray_prints_it() {
        let close = |gamma: Gamma, encoded, shown: f64| {
            // Above 1 it calculates in single precision what is raised to 2.4.
            let bound = if shown.abs() <= 1.0 { 6e-8 } else { 3e-7 * shown };
            let off = (gamma.of_srgb(encoded) - shown).abs();
            assert!(off < bound, "{gamma} {encoded} {off:e}");
        };
        close(Gamma::LINEAR, 0.5, 0.214_041_1);
        close(Gamma::LINEAR, 0.02, 0.001_548_0);
        close(Gamma::LINEAR, 3.0, 12.829_836_8);
        close(Gamma::LINEAR, -0.5, -0.038_699_7);
        close(Gamma::Power(2.2), 0.5, 0.496_227_2);
        close(Gamma::Power(2.2), 2.0, 2.069_583_7);
        close(Gamma::Power(2.2), -0.5, 0.0);
        close(Gamma::Srgb, -0.5, -0.5);
    }

    #[test]
    fn a_gamma_is_its_power_or_the_curve_also_above_white() {
        let close = |a: f64, b: f64| (a - b).abs() < 1e-6;
        assert!(close(Gamma::Power(2.2).linear(0.5), 0.217_637_6));
        // The numbers POV-Ray shows: the curve is neither 2.2 nor any power.
        assert!(close(Gamma::Srgb.linear(0.5), 0.214_041_1));
        assert!(close(Gamma::Srgb.linear(0.02), 0.001_547_99));
        assert!(close(Gamma::Srgb.linear(2.01), 5.011_898_1));
        for gamma in [Gamma::LINEAR, Gamma::Power(0.4), Gamma::Srgb] {
            assert_eq!(
                [-1.0, -0.0, 0.0, f64::NAN, 1.0].map(|c| gamma.linear(c)),
                [0., 0., 0., 0., 1.]
            );
        }
        assert_eq!(Gamma::LINEAR.linear(0.3), 0.3);
    }

    #[test]
    fn encoding_is_monotone_and_has_the_right_ends() {
        assert_eq!((srgb_encode(0.0), srgb_encode(1.0), srgb_encode(f64::NAN)), (0.0, 1.0, 0.0));
        let codes: Vec<f64> = (0..=65_535).map(|i| srgb_encode(f64::from(i) / 65_535.0)).collect();
        assert!(codes.windows(2).all(|pair| pair[0] < pair[1]));
    }
}
