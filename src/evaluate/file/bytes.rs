//! Serialization of values for `#write`.
//!
//! **Out:** numbers with six digits, vectors in angle brackets with a blank after them, strings unchanged; or
//! integers of 8, 16 or 32 bits.
//!
//! **Source:** measured on POV-Ray 3.7; its manual, section 3.3.2.3.4 "The write Directive".

use super::super::value::Value;
use crate::vocabulary::Word;

/// Binary format of integers; values are rounded, and clamped to what fits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct WordType {
    bits: u32,
    signed: bool,
    /// Big-endian (high byte first).
    big: bool,
}

impl WordType {
    /// Returns the format that a word of the language names.
    pub(super) fn of(word: Word) -> Option<Self> {
        let form = |bits, signed, big| Some(Self { bits, signed, big });
        match word {
            Word::Uint8 => form(8, false, true),
            Word::Sint8 => form(8, true, true),
            Word::Uint16be => form(16, false, true),
            Word::Uint16le => form(16, false, false),
            Word::Sint16be => form(16, true, true),
            Word::Sint16le => form(16, true, false),
            Word::Sint32be => form(32, true, true),
            Word::Sint32le => form(32, true, false),
            _ => None,
        }
    }

    fn append(self, number: f64, bytes: &mut Vec<u8>) {
        let (least, most) = match self.signed {
            true => (-(1_i64 << (self.bits - 1)), (1_i64 << (self.bits - 1)) - 1),
            false => (0, (1_i64 << self.bits) - 1),
        };
        // Halves are rounded up, also below zero. (The conversion saturates.)
        let whole = ((number + 0.5).floor() as i64).clamp(least, most);
        let eight = whole.to_be_bytes();
        let needed = &eight[eight.len() - self.bits as usize / 8..];
        match self.big {
            true => bytes.extend(needed),
            false => bytes.extend(needed.iter().rev()),
        }
    }
}

/// Appends a value; returns `false` if its kind cannot be written.
pub(super) fn append(value: &Value, form: Option<WordType>, bytes: &mut Vec<u8>) -> bool {
    match (value, form) {
        (Value::String(text), None) => bytes.extend(text.as_bytes()),
        (Value::Number(number), None) => bytes.extend(short(*number).bytes()),
        (Value::Vector(vector), None) => {
            let numbers: Vec<String> = vector.as_slice().iter().map(|n| short(*n)).collect();
            bytes.extend(format!("<{}> ", numbers.join(",")).bytes());
        }
        (Value::Number(number), Some(form)) => form.append(*number, bytes),
        (Value::Vector(vector), Some(form)) => {
            vector.as_slice().iter().for_each(|number| form.append(*number, bytes));
        }
        _ => return false,
    }
    true
}

/// Formats a number with six digits, as C's `%g`: `0.333333`, `1e-10`, `1.23457e+08`.
fn short(number: f64) -> String {
    let exact = format!("{number:.5e}");
    let (digits, exponent) = exact.split_once('e').unwrap_or((&exact, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    let trimmed = |text: &str| match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text.to_owned(),
    };
    match exponent {
        -4..6 => trimmed(&format!("{number:.*}", (5 - exponent) as usize)),
        _ => {
            let sign = if exponent < 0 { '-' } else { '+' };
            format!("{}e{sign}{:02}", trimmed(digits), exponent.abs())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_written_as_pov_ray_writes_them() {
        let written = [
            (1.0, "1"),
            (1.5, "1.5"),
            (1.0 / 3.0, "0.333333"),
            (1e-10, "1e-10"),
            (1e10, "1e+10"),
            (123456789.123, "1.23457e+08"),
            (-0.1, "-0.1"),
            (0.1 + 0.2, "0.3"),
            (999999.5, "1e+06"),
            (123456.0, "123456"),
            (0.00001234567, "1.23457e-05"),
            (0.0001, "0.0001"),
            (0.0, "0"),
            (-1e300, "-1e+300"),
            (100.0, "100"),
        ];
        for (number, text) in written {
            assert_eq!(short(number), text);
        }
    }

    #[test]
    fn whole_numbers_are_rounded_and_cut_to_their_bits() {
        let bytes = |word, numbers: &[f64]| {
            let mut bytes = Vec::new();
            let form = WordType::of(word).expect("a form");
            numbers.iter().for_each(|n| form.append(*n, &mut bytes));
            bytes
        };
        let numbers = [1.0, 255.0, 256.0, -1.0, 2.5, 3.5, -0.4, 1.49999];
        assert_eq!(bytes(Word::Uint8, &numbers), [1, 255, 255, 0, 3, 4, 0, 1]);
        let numbers = [-128.0, -129.0, 127.0, 128.0, 0.5, 1.5, -0.5];
        assert_eq!(bytes(Word::Sint8, &numbers), [128, 128, 127, 127, 1, 2, 0]);
        assert_eq!(bytes(Word::Uint16be, &[258.0]), [1, 2]);
        assert_eq!(bytes(Word::Uint16le, &[258.0, 65536.0]), [2, 1, 255, 255]);
        assert_eq!(bytes(Word::Sint16be, &[-2.0]), [255, 254]);
        assert_eq!(bytes(Word::Sint16le, &[-40000.0]), [0, 128]);
        assert_eq!(bytes(Word::Sint32be, &[16909060.0, -2.5]), [1, 2, 3, 4, 255, 255, 255, 254]);
        assert_eq!(bytes(Word::Sint32le, &[16909060.0, 1e20]), [4, 3, 2, 1, 255, 255, 255, 127]);
        assert_eq!(WordType::of(Word::Sphere), None);
    }
}
