//! Parser for the text that `#read` reads: numbers, vectors and strings, separated by commas.
//!
//! **In:** a file's text and an offset in it. **Out:** the value there and the offset of the next one, or the
//! reason why there is none. Comments and blanks are allowed anywhere in between; commas are optional.
//!
//! **Source:** POV-Ray 3.7 manual, section 3.3.2.3.3 "The read Directive"; measured: after a value, the file
//! is at its end if only blanks follow, but not if a comma does. Without commas, the program loses every
//! second number; here none is lost.

use std::ops::Range;

use crate::diagnostic::Code;

use super::super::builtin::escape::decode_escapes;
use super::super::value::{Components, Value};

/// What is wrong, and the affected bytes of the text.
#[derive(Debug, Clone, PartialEq)]
pub struct Fault {
    pub code: Code,
    pub at: Range<usize>,
    pub message: String,
    pub label: &'static str,
}

/// A value, the offset of the next one, and whether the file continues there.
#[derive(Debug, Clone, PartialEq)]
pub struct Datum {
    pub value: Value,
    pub next: usize,
    pub ends: bool,
}

/// Returns the value at `at`; `None` at the end of the text. `commas` are the separators allowed after a
/// value.
///
/// # Errors
///
/// Fails if there is no value at `at`.
pub fn datum(text: &str, at: usize, commas: &[char]) -> Result<Option<Datum>, Fault> {
    let at = skip_blanks(text, at)?;
    let (value, end) = match text[at..].chars().next() {
        None => return Ok(None),
        Some('"') => string(text, at)?,
        Some('<') => vector(text, at)?,
        Some(_) => match number(text, at)? {
            Some((number, end)) => (Value::Number(number), end),
            None => return Err(no_value(text, at, "a number, a vector or a string in quotes")),
        },
    };
    let next = skip_blanks(text, end)?;
    Ok(Some(match text[next..].starts_with(commas) {
        true => Datum { value, next: next + 1, ends: false },
        false => Datum { value, next, ends: next == text.len() },
    }))
}

fn no_value(text: &str, at: usize, wanted: &str) -> Fault {
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    let word = text[at..].find(|c| !is_word(c)).unwrap_or(text.len() - at);
    let one = text[at..].chars().next().map_or(0, char::len_utf8);
    let end = at + word.max(one);
    let (message, label) = match word {
        0 => (format!("expected {wanted}"), "no value begins like this"),
        _ => (
            format!("expected {wanted}, found `{}`", &text[at..end]),
            "a file holds values only, no words or names",
        ),
    };
    Fault { code: Code::ExpectedExpression, at: at..end, message, label }
}

/// Returns the offset of the next character outside blanks and comments.
fn skip_blanks(text: &str, mut at: usize) -> Result<usize, Fault> {
    loop {
        let rest = &text[at..];
        let blanks = rest.len() - rest.trim_start().len();
        let rest = &rest[blanks..];
        at += blanks;
        match rest.as_bytes() {
            [b'/', b'/', ..] => at += rest.find('\n').unwrap_or(rest.len()),
            [b'/', b'*', ..] => match rest.find("*/") {
                Some(end) => at += end + 2,
                None => {
                    let message = "this comment is never closed".to_owned();
                    let (code, at) = (Code::UnclosedComment, at..at + 2);
                    return Err(Fault { code, at, message, label: "opened here" });
                }
            },
            _ => return Ok(at),
        }
    }
}

/// Parses a number with its sign; returns it and where it ends, or `None` if there is none.
fn number(text: &str, start: usize) -> Result<Option<(f64, usize)>, Fault> {
    let bytes = text.as_bytes();
    let digits =
        |from: usize| from + bytes[from..].iter().take_while(|byte| byte.is_ascii_digit()).count();
    let mut at = start;
    let mut negative = false;
    while let Some(sign @ (b'-' | b'+')) = bytes.get(at) {
        negative ^= *sign == b'-';
        at = skip_blanks(text, at + 1)?;
    }
    let whole = digits(at);
    let mut end = whole;
    if bytes.get(end) == Some(&b'.') {
        end = digits(end + 1);
    }
    if end - at == usize::from(end > whole) {
        return Ok(None);
    }
    if let Some(b'e' | b'E') = bytes.get(end) {
        let signed = end + 1 + usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
        if digits(signed) > signed {
            end = digits(signed);
        }
    }
    let fault = |end: usize, message: &str, label| {
        let message = message.to_owned();
        Err(Fault { code: Code::MalformedNumber, at: start..end, message, label })
    };
    let tail = |c: char| c.is_alphanumeric() || c == '_' || c == '.';
    if let Some(more) = text[end..].find(|c| !tail(c)).or(Some(text.len() - end)).filter(|n| *n > 0)
    {
        let label = "expected digits, one point and an exponent at most";
        return fault(end + more, "this is no number", label);
    }
    match text[at..end].parse::<f64>() {
        Ok(size) if size.is_finite() => Ok(Some((if negative { -size } else { size }, end))),
        _ => fault(end, "this number is too large", "larger than any number (about 1.8e308)"),
    }
}

fn vector(text: &str, start: usize) -> Result<(Value, usize), Fault> {
    let mut numbers = Vec::new();
    let mut at = skip_blanks(text, start + 1)?;
    loop {
        if text[at..].starts_with('>') {
            at += 1;
            break;
        }
        if at == text.len() {
            let message = "this vector is never closed".to_owned();
            let (code, at) = (Code::UnclosedBlock, start..start + 1);
            return Err(Fault { code, at, message, label: "opened here" });
        }
        let Some((number, end)) = number(text, at)? else {
            return Err(no_value(text, at, "a number or `>`"));
        };
        numbers.push(number);
        at = skip_blanks(text, end)?;
        if text[at..].starts_with(',') {
            at = skip_blanks(text, at + 1)?;
        }
    }
    match Components::new(&numbers) {
        Some(components) => Ok((Value::Vector(components), at)),
        None => {
            let message = format!("a vector has 2 to 5 numbers, not {}", numbers.len());
            Err(Fault { code: Code::WrongArity, at: start..at, message, label: "this vector" })
        }
    }
}

fn string(text: &str, start: usize) -> Result<(Value, usize), Fault> {
    let mut escaped = false;
    let end = text[start + 1..].find(|c| {
        let closes = c == '"' && !escaped;
        escaped = c == '\\' && !escaped;
        closes
    });
    let Some(end) = end.map(|end| start + 1 + end) else {
        let message = "this string is never closed".to_owned();
        let (code, at) = (Code::UnclosedString, start..start + 1);
        return Err(Fault { code, at, message, label: "opened here" });
    };
    match decode_escapes(&text[start + 1..end]) {
        Ok(string) => Ok((Value::string(string), end + 1)),
        Err((offset, message)) => {
            let at = start + 1 + offset;
            Err(Fault { code: Code::OutOfRange, at: at..at + 1, message, label: "this escape" })
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// Returns all values of a text, and whether another `#read` would be attempted.
    fn values(text: &str) -> (Vec<String>, bool) {
        let (mut at, mut values) = (0, Vec::new());
        while let Some(Datum { value, next, ends }) = datum(text, at, &[',']).expect("values") {
            values.push(match value {
                Value::String(text) => format!("{text:?}"),
                value => format!("{:?}", value.numbers().expect("numbers").as_slice()),
            });
            at = next;
            if ends {
                return (values, false);
            }
        }
        (values, true)
    }

    fn owned(texts: &[&str]) -> Vec<String> {
        texts.iter().map(|text| (*text).to_owned()).collect()
    }

    fn fault(text: &str) -> (&str, String) {
        let mut at = 0;
        loop {
            match datum(text, at, &[',']) {
                Ok(Some(Datum { next, .. })) => at = next,
                Ok(None) => panic!("no fault in {text}"),
                Err(fault) => return (&text[fault.at.clone()], fault.message),
            }
        }
    }

    #[test]
    fn values_are_read_with_commas_comments_and_without_either() {
        let all = "1, -2e3,.5, 1. +6 - /* minus */ 7 // seven\n <1, -2> , <1 2 3>\"a\\\"b\\n\"\n";
        let read = ["[1.0]", "[-2000.0]", "[0.5]", "[1.0]", "[6.0]", "[-7.0]"];
        let rest = ["[1.0, -2.0]", "[1.0, 2.0, 3.0]", r#""a\"b\n""#];
        assert_eq!(values(all), (owned(&[&read[..], &rest[..]].concat()), false));
    }

    #[test]
    fn a_file_ends_after_its_last_value_but_not_after_a_comma() {
        assert_eq!(values("1,2,3\n"), (owned(&["[1.0]", "[2.0]", "[3.0]"]), false));
        assert_eq!(values("1,2, // more?\n"), (owned(&["[1.0]", "[2.0]"]), true));
        assert_eq!(values(" \n "), (vec![], true));
    }

    #[test]
    fn what_is_no_value_is_pointed_at() {
        assert_eq!(fault("1, pi").0, "pi");
        assert_eq!(fault("1,,2").0, ",");
        assert_eq!(fault("1.5.5").0, "1.5.5");
        assert_eq!(fault("0x10").0, "0x10");
        assert_eq!(fault("1e999").0, "1e999");
        assert_eq!(fault("<1>").1, "a vector has 2 to 5 numbers, not 1");
        assert_eq!(fault("<1,2,3,4,5,6>").0, "<1,2,3,4,5,6>");
        assert_eq!(fault("2 <1, x>").0, "x");
        assert_eq!(fault("<1, 2").0, "<");
        assert_eq!(fault("\"ab").0, "\"");
        assert_eq!(fault("\"a\\q\"").0, "\\");
        assert_eq!(fault("3 /* 4").0, "/*");
        assert_eq!(fault("é").0, "é");
    }

    proptest! {
        #[test]
        fn any_text_ends_in_values_or_a_fault(text in "[-+0-9.,<>\"\\\\e/* né\n]{0,40}") {
            let mut at = 0;
            while let Ok(Some(Datum { next, .. })) = datum(&text, at, &[',', ';']) {
                prop_assert!(next > at && text.is_char_boundary(next));
                at = next;
            }
            if let Err(Fault { at, .. }) = datum(&text, at, &[',', ';']) {
                prop_assert!(text.get(at.clone()).is_some_and(|part| !part.is_empty()));
            }
        }

        #[test]
        fn numbers_come_back_as_they_were(numbers in prop::collection::vec(-1e9..1e9f64, 1..9)) {
            let written: Vec<String> = numbers.iter().map(f64::to_string).collect();
            let read = values(&written.join(", ")).0;
            let wanted: Vec<String> = numbers.iter().map(|n| format!("[{n:?}]")).collect();
            prop_assert_eq!(read, wanted);
        }
    }
}
