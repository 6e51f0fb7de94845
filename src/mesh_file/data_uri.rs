//! File names that contain the file itself or percent-encoded characters: `data:…;base64,…`, `%20`.
//!
//! **Source:** RFC 2397 "The data URL scheme"; RFC 4648, section 4; RFC 3986, section 2.1.

/// Returns the bytes that a data URI contains; `None` for the name of a file.
///
/// # Errors
/// Fails if they are not valid base64.
pub(super) fn held(uri: &str) -> Option<Result<Vec<u8>, &'static str>> {
    let (head, data) = uri.strip_prefix("data:")?.split_once(',').unwrap_or(("", ""));
    Some(match head.ends_with(";base64") {
        true => from_base64(data).ok_or("its data are not in base 64"),
        false => Ok(plain(data)),
    })
}

/// Decodes the percent-encoded characters of a name.
pub(super) fn name(uri: &str) -> String {
    String::from_utf8_lossy(&plain(uri)).into_owned()
}

fn plain(text: &str) -> Vec<u8> {
    let (mut plain, mut rest) = (Vec::with_capacity(text.len()), text.as_bytes());
    while let [first, behind @ ..] = rest {
        let digit = |digit: u8| char::from(digit).to_digit(16);
        rest = behind;
        match *behind {
            [high, low, ref behind @ ..] if *first == b'%' => match (digit(high), digit(low)) {
                (Some(high), Some(low)) => {
                    plain.push((16 * high + low) as u8);
                    rest = behind;
                }
                _ => plain.push(*first),
            },
            _ => plain.push(*first),
        }
    }
    plain
}

fn from_base64(text: &str) -> Option<Vec<u8>> {
    let mut bytes = Vec::with_capacity(text.len() / 4 * 3);
    let (mut bits, mut count) = (0u32, 0);
    for sign in text.trim_end_matches('=').bytes() {
        let value = match sign {
            b'A'..=b'Z' => sign - b'A',
            b'a'..=b'z' => sign - b'a' + 26,
            b'0'..=b'9' => sign - b'0' + 52,
            b'+' | b'-' => 62,
            b'/' | b'_' => 63,
            _ => return None,
        };
        (bits, count) = (bits << 6 | u32::from(value), count + 6);
        if count >= 8 {
            count -= 8;
            bytes.push((bits >> count) as u8);
            bits &= (1 << count) - 1;
        }
    }
    Some(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_holds_bytes_in_base_64_or_hidden_signs() {
        assert_eq!(held("data:application/octet-stream;base64,AP+A"), Some(Ok(vec![0, 255, 128])));
        assert_eq!(held("data:;base64,TQ=="), Some(Ok(b"M".to_vec())));
        assert_eq!(held("data:,a%20b"), Some(Ok(b"a b".to_vec())));
        assert!(held("data:;base64,!").is_some_and(|bytes| bytes.is_err()));
        assert_eq!(held("box.bin"), None);
        assert_eq!(name("a%20box%2.bin%"), "a box%2.bin%");
    }
}
