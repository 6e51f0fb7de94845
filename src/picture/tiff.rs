//! Whether the colours of a TIFF file are multiplied by alpha, which `image` does not say.
//!
//! **Source:** TIFF revision 6.0, sections 2 and 18 (`ExtraSamples`): 1 is alpha that colours are multiplied
//! by, 2 is alpha that they are not.

const EXTRA_SAMPLES: u64 = 338;

/// Returns whether the first picture of the file says that its colours are multiplied by alpha. False for
/// anything that cannot be read.
pub fn is_multiplied(bytes: &[u8]) -> bool {
    extra_samples(bytes) == Some(1)
}

/// Returns the first value of `ExtraSamples` in the first directory.
fn extra_samples(bytes: &[u8]) -> Option<u64> {
    let is_little = bytes.get(..2)? == b"II";
    let number = |at: usize, length: usize| -> Option<u64> {
        let slice = bytes.get(at..at.checked_add(length)?)?;
        let add = |sum: u64, &byte: &u8| sum << 8 | u64::from(byte);
        Some(match is_little {
            true => slice.iter().rev().fold(0, add),
            false => slice.iter().fold(0, add),
        })
    };
    // The version is 42, or 43 with numbers of 64 bits.
    let (offset, counted, entry, value) = match number(2, 2)? {
        42 => (number(4, 4)?, 2, 12, 8),
        43 => (number(8, 8)?, 8, 20, 12),
        _ => return None,
    };
    let start = usize::try_from(offset).ok()?;
    let count = usize::try_from(number(start, counted)?).ok()?;
    for i in 0..count {
        let at = start.checked_add(counted)?.checked_add(i.checked_mul(entry)?)?;
        match number(at, 2)? {
            EXTRA_SAMPLES => return number(at.checked_add(value)?, 2),
            tag if tag > EXTRA_SAMPLES => return None,
            _ => {}
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A directory with the entry `ExtraSamples`, in either byte order.
    fn file(value: u16, is_little: bool) -> Vec<u8> {
        let two = |n: u16| if is_little { n.to_le_bytes() } else { n.to_be_bytes() };
        let four = |n: u32| if is_little { n.to_le_bytes() } else { n.to_be_bytes() };
        let mut bytes = if is_little { b"II".to_vec() } else { b"MM".to_vec() };
        bytes.extend([two(42).as_slice(), &four(8), &two(2)].concat());
        bytes.extend([two(256).as_slice(), &two(3), &four(1), &two(7), &two(0)].concat());
        bytes.extend([two(338).as_slice(), &two(3), &four(1), &two(value), &two(0)].concat());
        bytes
    }

    #[test]
    fn the_entry_is_found_in_both_byte_orders() {
        for is_little in [true, false] {
            assert!(is_multiplied(&file(1, is_little)));
            assert!(!is_multiplied(&file(2, is_little)));
        }
    }

    #[test]
    fn broken_bytes_say_nothing() {
        let whole = file(1, true);
        for length in 0..whole.len() - 2 {
            assert!(!is_multiplied(&whole[..length]), "{length}");
        }
        let mut wild = b"II\x2b\x00\x08\x00\x00\x00".to_vec();
        wild.extend([0xff; 24]);
        assert!(!is_multiplied(&wild));
    }
}
