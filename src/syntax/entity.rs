//! Replaces HTML entities such as `&lt;`, `&gt;` and `&amp;` by their characters.
//!
//! **In:** a text without comments. **Out:** the same text with the characters, each followed by blanks.
//! **Invariant:** strings keep theirs; a text without any is not copied; one diagnostic for all.

use std::borrow::Cow;

use crate::diagnostic::{Code, Diagnostic, Diagnostics};
use crate::source::{FileId, Span};

/// Each entity and its character. None of them is valid in a scene: no `;` follows an `&` and a name.
const ENTITIES: [(&str, u8); 11] = [
    ("&lt;", b'<'),
    ("&gt;", b'>'),
    ("&amp;", b'&'),
    ("&quot;", b'"'),
    ("&nbsp;", b' '),
    ("&#60;", b'<'),
    ("&#62;", b'>'),
    ("&#38;", b'&'),
    ("&#34;", b'"'),
    ("&#39;", b'\''),
    ("&#160;", b' '),
];

/// Replaces each entity by its character, and reports the positions.
pub(super) fn translate<'a>(
    text: Cow<'a, str>,
    file: FileId,
    diagnostics: &mut Diagnostics,
) -> Cow<'a, str> {
    let entity =
        |rest: &[u8]| ENTITIES.into_iter().find(|(name, _)| rest.starts_with(name.as_bytes()));
    if !text.contains('&') {
        return text;
    }
    let mut bytes = text.as_bytes().to_vec();
    let (mut in_string, mut opens, mut escaped) = (false, false, false);
    let (mut at, mut found) = (0, Vec::new());
    while at < bytes.len() {
        let byte = bytes[at];
        if in_string {
            in_string = escaped || byte != b'"';
            escaped = !escaped && byte == b'\\';
        } else if byte == b'"' {
            in_string = true;
        } else if byte == b'&'
            && let Some((name, sign)) = entity(&bytes[at..])
        {
            let end = at + name.len();
            bytes[at..end].fill(b' ');
            // The content of a string adjoins both of its quotes.
            opens = sign == b'"' && !opens;
            bytes[if opens { end - 1 } else { at }] = sign;
            found.push((Span::new(file, at, end), name, char::from(sign)));
            at = end;
            continue;
        }
        at += 1;
    }
    let Some(&(first, name, sign)) = found.first() else { return text };
    let message = format!("`{name}` is how a web page writes `{sign}`");
    let mut told = Diagnostic::new(Code::UnexpectedCharacter, message)
        .at(first, format!("expected `{sign}`"))
        .help("the text was copied out of a page's source: take it from what the page shows");
    if found.len() > 1 {
        told = told.help(format!("{} of such signs stand in the text", found.len()));
    }
    for (span, _, sign) in found {
        told = told.fix(span, sign.to_string());
    }
    diagnostics.push(told);
    // ASCII characters replaced ASCII characters: still UTF-8.
    Cow::Owned(String::from_utf8(bytes).unwrap_or_default())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn translated(text: &str) -> (String, usize) {
        let mut found = Diagnostics::new(true);
        let text = translate(Cow::Borrowed(text), FileId(0), &mut found).into_owned();
        assert!(found.iter().count() < 2);
        (text, found.iter().map(|told| told.fixes.len()).sum())
    }

    #[test]
    fn each_becomes_its_sign_and_one_message_has_all() {
        assert_eq!(translated("&lt;1, 2&gt; é"), ("<   1, 2>    é".to_owned(), 2));
        assert_eq!(translated("&quot;a.inc&quot; 1"), ("     \"a.inc\"      1".to_owned(), 2));
    }

    #[test]
    fn strings_and_the_languages_own_sign_stay() {
        for text in ["\"&lt;\"", "(A & B)", "(A &lt)", "&unknown;"] {
            assert_eq!(translated(text), (text.to_owned(), 0));
        }
    }
}
