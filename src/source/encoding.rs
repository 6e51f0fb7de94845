//! How the bytes of a file are read as text.

/// Typographic characters that Windows has where Latin-1 has none, with their bytes.
///
/// **Source:** the code page Windows-1252.
const TYPOGRAPHY: [(u8, char); 8] = [
    (0x85, '…'),
    (0x91, '‘'),
    (0x92, '’'),
    (0x93, '“'),
    (0x94, '”'),
    (0x95, '•'),
    (0x96, '–'),
    (0x97, '—'),
];

/// Decodes a byte as Latin-1, or as one of the typographic characters of Windows-1252.
fn from_latin(byte: u8) -> char {
    TYPOGRAPHY.iter().find(|(own, _)| *own == byte).map_or(char::from(byte), |(_, sign)| *sign)
}

/// Returns the original bytes of a text that [`decode`] decoded as Latin-1, one per character.
#[doc(hidden)]
pub fn to_latin(text: &str) -> Vec<u8> {
    let byte =
        |c: char| TYPOGRAPHY.iter().find(|(_, sign)| *sign == c).map_or(c as u8, |own| own.0);
    text.chars().map(byte).collect()
}

/// Decodes the bytes of a file as UTF-8 or, failing that, as Latin-1 with the typographic characters of
/// Windows. The flag is `true` if the text was not UTF-8. Drops a byte order mark.
pub fn decode(bytes: Vec<u8>) -> (String, bool) {
    let (text, foreign) = match String::from_utf8(bytes) {
        Ok(text) => (text, false),
        Err(error) => (error.into_bytes().iter().map(|&byte| from_latin(byte)).collect(), true),
    };
    match text.strip_prefix('\u{feff}') {
        Some(rest) => (rest.to_owned(), foreign),
        None => (text, foreign),
    }
}

/// What a file is called that [`is_utf_16`].
#[doc(hidden)]
pub const UTF_16: &str = "it is UTF-16";

/// Whether the text is UTF-16: it has a byte order mark, or almost every other byte is zero. A picture
/// starts with letters that identify its format, whatever its samples are.
#[doc(hidden)]
pub fn is_utf_16(bytes: &[u8]) -> bool {
    let pairs = bytes[..bytes.len().min(4096)].as_chunks::<2>().0;
    let zeros = |at: usize| pairs.iter().filter(|pair| pair[at] == 0).count();
    let most = pairs.len() - pairs.len() / 8;
    let is_half_empty = |at: usize| zeros(at) >= most && zeros(1 - at) == 0;
    matches!(bytes, [0xff, 0xfe, ..] | [0xfe, 0xff, ..])
        || pairs.len() > 8 && [0, 1].into_iter().any(|at| pairs[0][at] == 0 && is_half_empty(at))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_that_are_not_utf_8_are_read_as_latin_1() {
        assert_eq!(decode(vec![b'a', 0xe9]), ("aé".to_owned(), true));
        let all: Vec<u8> = (0..=255).collect();
        let (text, foreign) = decode(all.clone());
        assert!(foreign && text.contains("“”"));
        assert_eq!(to_latin(&text), all);
        assert_eq!(decode("\u{feff}a".as_bytes().to_vec()), ("a".to_owned(), false));
    }

    #[test]
    fn utf_16_is_known_by_its_mark_or_its_zeros() {
        let wide = |text: &str| text.encode_utf16().flat_map(u16::to_le_bytes).collect::<Vec<u8>>();
        let text = "sphere { 0, 1 } // caf\u{e9} \u{2014}";
        assert!(is_utf_16(&wide(&format!("\u{feff}{text}"))));
        assert!(is_utf_16(&wide(text)));
        let swapped: Vec<u8> = text.encode_utf16().flat_map(u16::to_be_bytes).collect();
        assert!(is_utf_16(&swapped));
        assert!(!is_utf_16(text.as_bytes()) && !is_utf_16(&[0; 64]) && !is_utf_16(b""));
        // Heights of 8 bits in a picture of 16.
        let heights = (1..200).flat_map(|height| [height, 0]);
        let picture: Vec<u8> = b"P5 199 1 65535\n".iter().copied().chain(heights).collect();
        assert!(!is_utf_16(&picture));
    }
}
