//! Blanks control characters, which are invisible and never valid in the language.
//!
//! **In:** a text without comments. **Out:** the same text with blanks in their place. **Invariant:** strings
//! keep theirs; a text without any is not copied; one diagnostic for each kind.

use std::borrow::Cow;

use crate::diagnostic::{Code, Diagnostic, Diagnostics, Fix};
use crate::source::{FileId, Span};

/// The end-of-file character of DOS.
const END_OF_FILE: u8 = 0x1a;

const BLOCK: usize = 1024;

/// Replaces control characters by blanks, and reports their positions.
pub(super) fn blank<'a>(
    text: Cow<'a, str>,
    file: FileId,
    diagnostics: &mut Diagnostics,
) -> Cow<'a, str> {
    // In blocks, to test many bytes at once.
    let holds_control =
        |block: &[u8]| block.iter().fold(false, |held, byte| held | is_control(*byte));
    if !text.as_bytes().chunks(BLOCK).any(holds_control) {
        return text;
    }
    let mut bytes = text.into_owned().into_bytes();
    let (mut blanks, mut wrong) = (Vec::new(), Vec::new());
    let (mut in_string, mut escaped) = (false, false);
    for (at, byte) in bytes.iter_mut().enumerate() {
        if in_string {
            in_string = escaped || *byte != b'"';
            escaped = !escaped && *byte == b'\\';
        } else if *byte == b'"' {
            in_string = true;
        } else if is_control(*byte) {
            // POV-Ray reads these two as blanks (measured), and stops at the others.
            let places = if matches!(*byte, 0 | END_OF_FILE) { &mut blanks } else { &mut wrong };
            places.push((at, std::mem::replace(byte, b' ')));
        }
    }
    tell(Code::ControlCharacter, &blanks, file, diagnostics);
    tell(Code::UnexpectedCharacter, &wrong, file, diagnostics);
    // Single bytes replaced single bytes: still UTF-8.
    Cow::Owned(String::from_utf8(bytes).unwrap_or_default())
}

/// Reports one diagnostic for all `places`; its fix removes them all.
fn tell(code: Code, places: &[(usize, u8)], file: FileId, diagnostics: &mut Diagnostics) {
    let Some(&(first, byte)) = places.first() else { return };
    let span = |at: usize| Span::new(file, at, at + 1);
    let message = match places.len() {
        1 => "a control character stands in the text".to_owned(),
        n => format!("{n} control characters stand in the text"),
    };
    let label = match byte {
        0 => "a NUL, which nobody sees".to_owned(),
        END_OF_FILE => "the end of a DOS file (U+001A), which nobody sees".to_owned(),
        byte => format!("U+{byte:04X}, which nobody sees"),
    };
    let mut told = Diagnostic::new(code, message).at(span(first), label).help("leave it out");
    told.fixes.extend(places.iter().map(|&(at, _)| Fix { span: span(at), text: String::new() }));
    diagnostics.push(told);
}

fn is_control(byte: u8) -> bool {
    byte.is_ascii_control() && !matches!(byte, b'\t' | b'\n' | b'\r' | 0x0b | 0x0c)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn blanked(text: &str) -> (String, Vec<(Code, usize)>) {
        let mut found = Diagnostics::new(true);
        let blanked = blank(Cow::Borrowed(text), FileId(0), &mut found).into_owned();
        (blanked, found.iter().map(|told| (told.code, told.fixes.len())).collect())
    }

    #[test]
    fn each_becomes_a_blank_and_one_message_takes_all_of_a_kind_out() {
        let (text, told) = blanked("a\0b\x01c\0\x7f\t\r\n\x1a");
        assert_eq!(text, "a b c  \t\r\n ");
        assert_eq!(told, [(Code::ControlCharacter, 3), (Code::UnexpectedCharacter, 2)]);
    }

    #[test]
    fn strings_keep_theirs() {
        let text = "\"a\x1b\\\"\x01\" b";
        assert_eq!(blanked(text), (text.to_owned(), vec![]));
    }
}
