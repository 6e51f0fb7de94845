//! Decoding of escape sequences in string literals.
//!
//! **In:** the text between the quotes, as typed. **Out:** the string. File names after `#include`, and in
//! other positions that take a path, are not decoded, as in POV-Ray; the caller decides.
//!
//! **Source:** POV-Ray 3.7 manual, section 3.3.2.7.2 "Text Formatting"; the program refuses `\0`, which the
//! manual lists, and every escape that the manual does not list.

use std::borrow::Cow;

/// Replaces each escape by its character.
///
/// # Errors
///
/// Returns the byte offset of the backslash in `raw`, and what is wrong there.
pub fn decode_escapes(raw: &str) -> Result<Cow<'_, str>, (usize, String)> {
    if !raw.contains('\\') {
        return Ok(Cow::Borrowed(raw));
    }
    let mut text = String::with_capacity(raw.len());
    let mut at = 0;
    while let Some(plain) = raw[at..].find('\\') {
        text.push_str(&raw[at..at + plain]);
        at += plain;
        let (character, length) = escape(&raw[at..]).map_err(|message| (at, message))?;
        text.push(character);
        at += length;
    }
    text.push_str(&raw[at..]);
    Ok(Cow::Owned(text))
}

/// Returns the character of the escape with which `raw` begins, and the escape's length in bytes.
fn escape(raw: &str) -> Result<(char, usize), String> {
    let character = match raw[1..].chars().next() {
        Some('a') => '\x07',
        Some('b') => '\x08',
        Some('f') => '\x0c',
        Some('n') => '\n',
        Some('r') => '\r',
        Some('t') => '\t',
        Some('v') => '\x0b',
        Some(itself @ ('\\' | '"' | '\'')) => itself,
        Some('u') => return unicode(raw),
        Some(other) => {
            return Err(format!(
                "`\\{other}` is not an escape; a backslash itself is written `\\\\`"
            ));
        }
        None => return Err("a lone backslash is not an escape; write `\\\\`".to_owned()),
    };
    Ok((character, 2))
}

/// Decodes `\uXXXX`, four hexadecimal digits. A character beyond them is written as a surrogate pair, which
/// POV-Ray keeps apart and counts as two characters.
fn unicode(raw: &str) -> Result<(char, usize), String> {
    let first = code_unit(raw).ok_or("`\\u` takes four hexadecimal digits, as in `\\u00e9`")?;
    if first == 0 {
        return Err("a string cannot hold the character `\\u0000`".to_owned());
    }
    if let Some(character) = char::from_u32(u32::from(first)) {
        return Ok((character, 6));
    }
    let second = code_unit(&raw[6..]);
    let pair = second.and_then(|second| char::decode_utf16([first, second]).next()?.ok());
    pair.map(|character| (character, 12))
        .ok_or_else(|| format!("`\\u{first:04x}` is half a character; its other half must follow"))
}

fn code_unit(raw: &str) -> Option<u16> {
    let digits = raw.strip_prefix("\\u")?.get(..4)?;
    let hexadecimal = digits.bytes().all(|b| b.is_ascii_hexdigit());
    hexadecimal.then(|| u16::from_str_radix(digits, 16).ok())?
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn each_escape_stands_for_its_character() {
        let decoded = decode_escapes(r#"\a\b\f\n\r\t\v|\\|\"|\'|\u0041\u00e9\u20AC4"#);
        assert_eq!(decoded.as_deref(), Ok("\x07\x08\x0c\n\r\t\x0b|\\|\"|'|Aé€4"));
    }

    #[test]
    fn two_halves_make_one_character() {
        assert_eq!(decode_escapes(r"<\ud83d\ude00>").as_deref(), Ok("<😀>"));
    }

    #[test]
    fn wrong_escapes_are_pointed_at() {
        let offset = |raw| decode_escapes(raw).expect_err("not an escape").0;
        assert_eq!(offset(r"é\q"), 2);
        for raw in [r"\0", r"\x41", r"\101", r"\U00000041", r"\N", r"\é", r"\"] {
            assert_eq!(offset(raw), 0, "{raw}");
        }
        for raw in [r"a\u", r"a\u004", r"a\u00é0", r"a\uzzzz", r"a\u+041", r"a\u0000"] {
            assert_eq!(offset(raw), 1, "{raw}");
        }
        for raw in [r"ab\ud83d", r"ab\ud83dx", r"ab\ude00\ud83d", r"ab\ud83d\u0041"] {
            assert_eq!(offset(raw), 2, "{raw}");
        }
    }

    proptest! {
        #[test]
        fn any_text_comes_back_from_its_escapes(text in any::<String>()) {
            let escaped = text.replace('\\', r"\\").replace('"', r#"\""#).replace('\n', r"\n");
            prop_assert_eq!(decode_escapes(&escaped), Ok(text.into()));
        }

        #[test]
        fn no_text_is_too_strange(raw in r"(\\|u|[0-9a-f]|é|n){0,20}") {
            if let Err((offset, message)) = decode_escapes(&raw) {
                prop_assert!(raw[offset..].starts_with('\\') && !message.is_empty());
            }
        }
    }
}
