//! Writes the small files that drawn scenes read: pictures and a grid.

use std::path::Path;

use super::draw::{GRID, PICTURES};
use crate::dice::Dice;

/// Writes all of them to a folder.
pub fn write(folder: &Path) {
    let mut dice = Dice(1);
    let mut bytes = |count: usize| (0..count).map(|_| dice.below(256) as u8).collect::<Vec<u8>>();
    let pictures = [
        (png::ColorType::Rgb, bytes(8 * 6 * 3)),
        (png::ColorType::Indexed, (0..8 * 6).map(|i: u8| (i / 3 + i % 5) % 6).collect()),
        (png::ColorType::Rgba, bytes(8 * 6 * 4)),
    ];
    let palette = bytes(6 * 3);
    for (name, (color, data)) in PICTURES.iter().zip(pictures) {
        let file = std::fs::File::create(folder.join(name)).expect("a file");
        let mut encoder = png::Encoder::new(file, 8, 6);
        encoder.set_color(color);
        encoder.set_depth(png::BitDepth::Eight);
        if color == png::ColorType::Indexed {
            encoder.set_palette(palette.clone());
        }
        encoder
            .write_header()
            .and_then(|mut it| it.write_image_data(&data))
            .expect("it is written");
    }
    // Big-endian sizes, then a byte for each cell.
    let mut grid = vec![0, 4, 0, 5, 0, 3];
    grid.extend(bytes(4 * 5 * 3));
    std::fs::write(folder.join(GRID), grid).expect("it is written");
}
