//! Replaces parts of a text that are not scene source by blanks.

use std::borrow::Cow;
use std::ops::Range;

/// Returns the same text, with each byte of `ranges` except line breaks replaced by a blank.
pub(super) fn blanked<'a>(
    text: Cow<'a, str>,
    ranges: impl IntoIterator<Item = Range<usize>>,
) -> Cow<'a, str> {
    let mut ranges = ranges.into_iter().peekable();
    if ranges.peek().is_none() {
        return text;
    }
    let mut bytes = text.into_owned().into_bytes();
    for range in ranges {
        for byte in bytes[range].iter_mut().filter(|byte| !matches!(**byte, b'\n' | b'\r')) {
            // Each byte of a character becomes one blank: still UTF-8.
            *byte = b' ';
        }
    }
    Cow::Owned(String::from_utf8(bytes).unwrap_or_default())
}
