//! String functions: conversion from and to numbers, and substrings.
//!
//! **Invariant:** positions count characters from 1, and a character is never split. Case conversion applies
//! to ASCII letters only, as in POV-Ray.

use std::fmt::Write;

use super::{Arguments, CallError, CallErrorKind, Function, Written};
use crate::vocabulary::Word;

/// Maximum field width and number of decimals of `str` and `vstr`: no number has more than 1074 decimals.
/// POV-Ray gives up silently somewhere between 200 and 300.
pub(super) const LONGEST: i64 = 1074;

/// Returns the function that `word` names, if it is in this family.
pub(super) fn function(word: Word) -> Option<Function> {
    match word {
        Word::Asc => Function::number(1..=1, |a| Ok(code(a.string(0)?.chars().next()))),
        Word::Chr => Function::string(1..=1, character),
        Word::Concat => Function::string(1..=usize::MAX, joined),
        Word::Str => Function::string(3..=3, |a| {
            let number = a.number(0)?;
            let mut text = String::new();
            Format::of(a, 1)?.append(number, &mut text);
            Ok(text)
        }),
        Word::Strcmp => Function::number(2..=2, |a| Ok(difference(a.string(0)?, a.string(1)?))),
        Word::Strlen => Function::number(1..=1, |a| Ok(a.string(0)?.chars().count() as f64)),
        Word::Strlwr => Function::string(1..=1, |a| Ok(a.string(0)?.to_ascii_lowercase())),
        Word::Strupr => Function::string(1..=1, |a| Ok(a.string(0)?.to_ascii_uppercase())),
        Word::Substr => Function::string(3..=3, piece),
        Word::Val => Function::number(1..=1, |a| Ok(leading_number(a.string(0)?))),
        Word::Vstr => Function::string(5..=5, vector_text),
        _ => None,
    }
}

fn joined(a: &Arguments) -> Result<String, CallError> {
    let length = (0..a.values.len()).filter_map(|i| Some(a.string(i).ok()?.len())).sum::<usize>();
    let mut text = String::with_capacity(length.min(a.longest));
    for i in 0..a.values.len() {
        let piece = a.string(i)?;
        if text.len() + piece.len() > a.longest {
            return Err(CallError {
                kind: CallErrorKind::TooLong,
                argument: Some(i),
                message: format!("this string grows longer than {} MiB", a.longest >> 20),
                help: Some("`--limit string=N` raises the limit".to_owned()),
            });
        }
        text.push_str(piece);
    }
    Ok(text)
}

/// Returns the character's code point; 0 if there is none.
fn code(character: Option<char>) -> f64 {
    character.map_or(0.0, |c| f64::from(u32::from(c)))
}

/// Returns the character of a code point; `chr(0)` is the empty string, as in POV-Ray.
fn character(a: &Arguments) -> Result<String, CallError> {
    let code = a.whole(0, 0..=65535, "a character's number")?;
    match u32::try_from(code).ok().and_then(char::from_u32) {
        Some('\0') => Ok(String::new()),
        Some(character) => Ok(character.to_string()),
        None => Err(a.out_of_range(0, "a character's number (55296 to 57343 are half characters)")),
    }
}

/// Returns a negative number, 0 or a positive number as `a` sorts before, equal to or after `b`: the
/// difference of the first two characters that differ, where an end counts as 0. The manual guarantees only
/// the sign; the magnitude is the program's.
fn difference(a: &str, b: &str) -> f64 {
    let (mut a, mut b) = (a.chars(), b.chars());
    loop {
        match (a.next(), b.next()) {
            (None, None) => return 0.0,
            (x, y) if x == y => {}
            (x, y) => return code(x) - code(y),
        }
    }
}

/// Returns a substring. POV-Ray also accepts the start 0, and then returns the empty string for any length.
fn piece(a: &Arguments) -> Result<String, CallError> {
    let text = a.string(0)?;
    let (start, length) = (a.number(1)?.trunc(), a.number(2)?.trunc());
    let outside = |i, message: String| Err(a.error(CallErrorKind::OutOfRange, Some(i), message));
    if length == 0.0 && (0.0..=text.chars().count() as f64 + 1.0).contains(&start) {
        return Ok(String::new());
    }
    if start < 1.0 {
        return outside(1, format!("counts characters from 1, not from {}", Written(start)));
    }
    if length < 0.0 {
        return outside(2, format!("takes a length of at least 0, not {}", Written(length)));
    }
    let (before, count) = (start - 1.0, text.chars().count() as f64);
    if before + length > count {
        let last = Written(before + length);
        let i = if before > count { 1 } else { 2 };
        return outside(i, format!("reaches to character {last}, and the string has {count}"));
    }
    Ok(text.chars().skip(before as usize).take(length as usize).collect())
}

/// Number format of `str` and `vstr`.
struct Format {
    /// Minimum number of characters.
    width: usize,
    /// Pads with zeros after the sign instead of blanks before it.
    zeros: bool,
    decimals: usize,
}

impl Format {
    /// Reads the length and the number of decimals from the arguments at `i` and `i + 1`: a negative length
    /// pads with zeros, a negative number of decimals means six.
    fn of(a: &Arguments, i: usize) -> Result<Self, CallError> {
        let length = a.whole(i, -LONGEST..=LONGEST, "a length")?;
        let decimals = a.whole(i + 1, i64::MIN..=LONGEST, "a number of decimals")?;
        Ok(Self {
            width: length.unsigned_abs() as usize,
            zeros: length < 0,
            decimals: usize::try_from(decimals).unwrap_or(6),
        })
    }

    fn append(&self, number: f64, text: &mut String) {
        let Self { width, decimals, .. } = *self;
        // As POV-Ray writes it, except for the sign.
        if number.is_nan() {
            let _ = write!(text, "{:>width$}", "nan");
            return;
        }
        // Integers are formatted much faster as such.
        let whole = number as i64;
        let is_whole = whole as f64 == number && whole != 0 && whole.unsigned_abs() < 1 << 53;
        // Writing into a string cannot fail.
        let _ = if decimals == 0 && is_whole {
            match self.zeros {
                true => write!(text, "{whole:0width$}"),
                false => write!(text, "{whole:width$}"),
            }
        } else if self.zeros {
            write!(text, "{number:0width$.decimals$}")
        } else {
            write!(text, "{number:width$.decimals$}")
        };
    }
}

/// Evaluates `vstr(n, v, separator, length, decimals)`: the first n components of v, with n clamped to 2 … 5;
/// a number fills all components, and a shorter vector is padded with zeros.
///
/// For a longer vector, which the manual calls an error, the program drops the rest; so does this, since
/// `vstr(3, Color, …)` is useful. The manual promotes a number as everywhere else, but the program prints
/// `1.0, 0.0` for `vstr(2, 1, …)`; this follows the manual.
fn vector_text(a: &Arguments) -> Result<String, CallError> {
    let count = a.number(0)?.clamp(2.0, 5.0) as usize;
    let components = a.components(1)?;
    let separator = a.string(2)?;
    let format = Format::of(a, 3)?;
    let mut text = String::new();
    for i in 0..count {
        if i > 0 {
            text.push_str(separator);
        }
        // A number is the first, as in POV-Ray.
        let component = components.as_slice().get(i).copied().unwrap_or(0.0);
        format.append(component, &mut text);
    }
    Ok(text)
}

/// Returns the number with which a string begins, after blanks; 0 if there is none.
///
/// As C's `strtod`, which POV-Ray uses, but without `inf`, `nan` and hexadecimal fractions, which are not
/// numbers of the language.
fn leading_number(text: &str) -> f64 {
    let text = text.trim_start_matches(|c: char| c.is_ascii_whitespace() || c == '\x0b');
    let (negative, unsigned) = match text.strip_prefix('-') {
        Some(rest) => (true, rest),
        None => (false, text.strip_prefix('+').unwrap_or(text)),
    };
    let size = match unsigned.strip_prefix("0x").or_else(|| unsigned.strip_prefix("0X")) {
        Some(hexadecimal) => hexadecimal
            .chars()
            .map_while(|c| c.to_digit(16))
            .fold(0.0, |sum, digit| sum * 16.0 + f64::from(digit)),
        None => unsigned[..decimal_length(unsigned)].parse().unwrap_or(0.0),
    };
    if negative { -size } else { size }
}

/// Returns the length in bytes of the decimal number at the start.
fn decimal_length(text: &str) -> usize {
    let digits = |from: usize| text[from..].bytes().take_while(u8::is_ascii_digit).count();
    let whole = digits(0);
    let point = usize::from(text[whole..].starts_with('.'));
    let fraction = digits(whole + point);
    if whole + fraction == 0 {
        return 0;
    }
    let mut end = whole + point + fraction;
    if text[end..].starts_with(['e', 'E']) {
        let signed = end + 1 + usize::from(text[end + 1..].starts_with(['+', '-']));
        let exponent = digits(signed);
        if exponent > 0 {
            end = signed + exponent;
        }
    }
    end
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::{RandomStreams, call, measured};
    use super::*;
    use crate::color::{Color, Rgb};
    use crate::evaluate::value::Value;

    fn text(word: Word, arguments: &[Value]) -> Result<String, CallError> {
        match call(word, arguments, &mut RandomStreams::default(), usize::MAX)? {
            Value::String(text) => Ok(text.to_string()),
            other => panic!("{other:?}"),
        }
    }

    fn number(word: Word, arguments: &[Value]) -> f64 {
        let value =
            call(word, arguments, &mut RandomStreams::default(), usize::MAX).expect("a value");
        value.as_number().expect("a number")
    }

    #[test]
    fn whole_numbers_are_written_as_all_others_are() {
        let numbers = [-0.0, 0.0, 1.0, -7.0, 123_456_789.0, 2f64.powi(53), -2f64.powi(63), 1e300];
        for number in numbers.into_iter().chain([0.5, -1.5, 2f64.powi(52) - 0.5]) {
            for (length, width) in [(0, 0), (12, 12), (-12, 12)] {
                let arguments = [number, f64::from(length), 0.0].map(Value::Number);
                let wanted = match length < 0 {
                    true => format!("{number:0width$.0}"),
                    false => format!("{number:width$.0}"),
                };
                assert_eq!(text(Word::Str, &arguments), Ok(wanted));
            }
        }
    }

    #[test]
    fn strings_are_those_that_pov_ray_prints() {
        measured::check(measured::STRING);
    }

    #[test]
    fn pieces_outside_the_string_say_what_it_holds() {
        let substr = |start: f64, length: f64| {
            let arguments =
                [Value::string("ABCDEFGHI"), Value::Number(start), Value::Number(length)];
            text(Word::Substr, &arguments).map_err(|error| error.message)
        };
        let error = |message: &str| Err(format!("`substr` {message}"));
        assert_eq!(substr(10.0, 0.0), Ok(String::new()));
        assert_eq!(substr(0.0, 0.0), Ok(String::new()));
        assert_eq!(substr(8.0, 3.0), error("reaches to character 10, and the string has 9"));
        assert_eq!(substr(0.0, 2.0), error("counts characters from 1, not from 0"));
        assert_eq!(substr(1.0, -1.0), error("takes a length of at least 0, not -1"));
        assert!(substr(1e300, 1e300).is_err());
    }

    #[test]
    fn fields_have_a_limit_and_characters_a_range() {
        let str = |n: f64, l: f64, p: f64| text(Word::Str, &[n, l, p].map(Value::Number));
        assert_eq!(str(-1.0, 1074.0, 0.0).map(|s| s.len()), Ok(1074));
        assert_eq!(str(5e-324, 0.0, 1074.0).map(|s| s.ends_with("625")), Ok(true));
        let error = str(1.0, 1e5, 0.0).expect_err("too long");
        assert_eq!(error.message, "`str` takes a length from -1074 to 1074, not 100000");
        for code in [-1.0, 65536.0, 55296.0] {
            let error = text(Word::Chr, &[Value::Number(code)]).expect_err("no character");
            assert_eq!(error.kind, CallErrorKind::OutOfRange);
        }
    }

    #[test]
    fn a_number_is_the_first_of_a_vector_and_a_colour_is_one() {
        let vstr = |n: f64, value: Value| {
            let rest = [Value::string("|"), Value::Number(0.0), Value::Number(1.0)];
            text(Word::Vstr, &[&[Value::Number(n), value][..], &rest].concat())
        };
        assert_eq!(vstr(1.0, Value::Number(1.0)).as_deref(), Ok("1.0|0.0"));
        assert_eq!(vstr(7.0, Value::Number(1.0)).as_deref(), Ok("1.0|0.0|0.0|0.0|0.0"));
        let red = Value::Color(Color::opaque(Rgb::new(1.0, 0.5, 0.0)));
        assert_eq!(vstr(3.0, red.clone()).as_deref(), Ok("1.0|0.5|0.0"));
        assert_eq!(vstr(5.0, red).as_deref(), Ok("1.0|0.5|0.0|0.0|0.0"));
    }

    #[test]
    fn characters_are_counted_whatever_their_bytes() {
        let word = Value::string("dé€");
        assert_eq!(number(Word::Strlen, std::slice::from_ref(&word)), 3.0);
        let last = text(Word::Substr, &[word, Value::Number(3.0), Value::Number(1.0)]);
        assert_eq!(last.as_deref(), Ok("€"));
        assert_eq!(number(Word::Asc, &[Value::string("€uro")]), 8364.0);
    }

    proptest! {
        #[test]
        fn what_str_writes_val_reads(n in -1e6..1e6f64, decimals in 0..12i32, length in -30..30i32) {
            let arguments = [n, f64::from(length), f64::from(decimals)].map(Value::Number);
            let written = text(Word::Str, &arguments).expect("a string");
            prop_assert!(written.len() >= length.unsigned_abs() as usize);
            let read = number(Word::Val, &[Value::string(written)]);
            prop_assert!((read - n).abs() <= 0.5001 * 10f64.powi(-decimals) + 1e-10);
        }

        #[test]
        fn val_reads_the_longest_number_at_the_start(text in "[ \t]?[-+]?[0-9.eExX]{0,8}[a-z ]{0,3}") {
            let trimmed = text.trim_start();
            let longest = (0..=trimmed.len())
                .filter(|end| !trimmed[..*end].contains(['n', 'i']))
                .filter_map(|end| trimmed[..end].parse::<f64>().ok())
                .next_back();
            prop_assume!(!trimmed.to_ascii_lowercase().contains("0x"));
            prop_assume!(longest.is_none_or(f64::is_finite));
            prop_assert_eq!(number(Word::Val, &[Value::string(text)]), longest.unwrap_or(0.0));
        }

        #[test]
        fn concat_undoes_substr(string in "\\PC{1,20}", at in 0.0..1.0f64) {
            let count = string.chars().count() as f64;
            let cut = (at * count).floor();
            let piece = |start: f64, length: f64| {
                text(Word::Substr, &[Value::string(string.as_str()), Value::Number(start), Value::Number(length)])
            };
            let (head, tail) = (piece(1.0, cut).expect("a head"), piece(cut + 1.0, count - cut).expect("a tail"));
            let whole = text(Word::Concat, &[Value::string(head), Value::string(tail)]);
            prop_assert_eq!(whole, Ok(string));
        }

        #[test]
        fn strcmp_orders_as_characters_do(a in "[a-cé]{0,4}", b in "[a-cé]{0,4}") {
            let sign = number(Word::Strcmp, &[Value::string(a.as_str()), Value::string(b.as_str())]);
            prop_assert_eq!(sign.partial_cmp(&0.0), Some(a.cmp(&b)));
        }
    }
}
