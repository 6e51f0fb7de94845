//! The size of an OpenEXR file's largest block, for which `exr` allocates memory before it reads it.
//!
//! **Source:** "OpenEXR File Layout", openexr.com: an attribute is its name, its type, its size and its value.

/// Returns an upper bound on the number of pixels in a block of a picture of this width.
pub fn most_in_block(bytes: &[u8], width: u32) -> u64 {
    let word = |value: &[u8], at: usize| -> u64 {
        let word = value.get(at..).and_then(|rest| rest.first_chunk());
        word.map_or(u64::from(u32::MAX), |&word| u32::from_le_bytes(word).into())
    };
    // Every part of a file has its own attributes.
    let tiles = values(bytes, b"tiles\0tiledesc\0");
    let tiles = tiles.map(|value| word(value, 0).saturating_mul(word(value, 4)));
    let compressions = values(bytes, b"compression\0compression\0");
    let rows = compressions.map(|value| match value.first() {
        // None, run lengths, and single rows by ZIP.
        Some(0..=2) => 1,
        // ZIP and PXR24.
        Some(3 | 5) => 16,
        // PIZ, B44, B44A and DWAA.
        Some(4 | 6..=8) => 32,
        _ => 256,
    });
    tiles.chain(rows.map(|rows| rows * u64::from(width))).max().unwrap_or(0)
}

/// Returns the rest of the file from each value of an attribute on.
fn values<'a>(bytes: &'a [u8], name: &'a [u8]) -> impl Iterator<Item = &'a [u8]> {
    let starts = bytes.windows(name.len()).enumerate().filter(move |(_, window)| *window == name);
    // The size stands between name and value.
    starts.filter_map(move |(at, _)| bytes.get(at + name.len() + 4..))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_block_is_a_tile_or_some_rows() {
        let compression =
            |kind: u8| [b"compression\0compression\0\x01\0\0\0", &[kind][..]].concat();
        assert_eq!(most_in_block(&compression(0), 100), 100);
        assert_eq!(most_in_block(&compression(3), 100), 1600);
        let tiles = b"tiles\0tiledesc\0\x09\0\0\0\x40\0\0\0\0\x01\0\0\0";
        assert_eq!(most_in_block(tiles, 100), 64 * 256);
        assert_eq!(most_in_block(&[compression(4), tiles.to_vec()].concat(), 1000), 32_000);
        assert_eq!(most_in_block(b"", 100), 0);
        assert!(most_in_block(&tiles[..21], 100) > 1 << 60);
    }
}
