//! Fonts; the only module that uses `ttf_parser`.
//!
//! **In:** the bytes of a TrueType or OpenType font, or of a collection, whose first font is used; a string.
//! **Out:** the outlines of its letters as closed curves, set in a row. **Invariant:** never panics, for any
//! bytes.
//!
//! **Source:** Microsoft, "OpenType specification", version 1.9 (tables `cmap`, `glyf`, `hmtx`, `kern`); the
//! positions of letters were measured on POV-Ray 3.7: the left edge of the first is at x = 0, each one
//! follows at the advance width and kerning of the preceding one, and `offset` shifts all that follow.

use ttf_parser::kern::Format;
use ttf_parser::{Face, GlyphId, OutlineBuilder, PlatformId};

use crate::scene::text::{Contour, Letter};

/// The bundled font: DejaVu Serif.
pub const BUILT_IN: &[u8] = include_bytes!("DejaVuSerif.ttf");

/// The fonts that are part of POV-Ray.
pub const POV_RAYS: [&str; 4] = ["povlogo.ttf", "timrom.ttf", "cyrvetic.ttf", "crystal.ttf"];

/// A parsed font.
pub struct Font<'a> {
    face: Face<'a>,
    /// Size of a font unit relative to the em.
    unit: f64,
}

impl<'a> Font<'a> {
    /// Parses a font.
    ///
    /// # Errors
    /// Describes what is wrong with the bytes.
    pub fn parse(bytes: &'a [u8]) -> Result<Self, String> {
        let face = Face::parse(bytes, 0).map_err(|error| error.to_string())?;
        let unit = 1.0 / f64::from(face.units_per_em());
        Ok(Self { face, unit })
    }

    /// Returns the visible letters of a text in a row along x; `None` if `fits` returns `false` for their
    /// total size in bytes.
    pub fn set(
        &self,
        text: &str,
        offset: [f64; 2],
        mut fits: impl FnMut(u64) -> bool,
    ) -> Option<Vec<Letter>> {
        let mut letters = Vec::new();
        let (mut place, mut before) = ([0.0; 2], None);
        let mut held = 0;
        for character in text.chars() {
            let glyph = self.glyph(character);
            let begin = || self.face.glyph_bounding_box(glyph).map_or(0, |bounds| bounds.x_min);
            place[0] += self.unit
                * match before {
                    None => -f64::from(begin()),
                    Some(before) => f64::from(self.kerning(before, glyph)),
                };
            let mut drawn = Drawn { letter: Letter::default(), place, unit: self.unit };
            if self.face.outline_glyph(glyph, &mut drawn).is_some() {
                let letter = drawn.letter;
                held += letter.bytes();
                if !fits(held) {
                    return None;
                }
                letters.push(letter);
            }
            let width = self.face.glyph_hor_advance(glyph).unwrap_or(0);
            place[0] += f64::from(width) * self.unit + offset[0];
            place[1] += offset[1];
            before = Some(glyph);
        }
        Some(letters)
    }

    /// Returns the first character of a text that the font has no glyph for.
    pub fn first_missing(&self, text: &str) -> Option<char> {
        text.chars().find(|character| self.glyph(*character) == GlyphId::default())
    }

    /// Returns the glyph of a character, or the glyph for missing characters. Symbol fonts map theirs to a
    /// private use range.
    fn glyph(&self, character: char) -> GlyphId {
        let code = u32::from(character);
        let tables = self.face.tables().cmap.into_iter().flat_map(|cmap| cmap.subtables);
        let glyph = tables.into_iter().find_map(|table| match table.platform_id {
            PlatformId::Unicode | PlatformId::Windows => {
                table.glyph_index(code).or_else(|| table.glyph_index(0xf000 + code))
            }
            PlatformId::Macintosh if code < 128 => table.glyph_index(code),
            PlatformId::Macintosh | PlatformId::Iso | PlatformId::Custom => None,
        });
        glyph.unwrap_or_default()
    }

    /// Searches linearly, as the pairs are not sorted in every font that claims so.
    fn kerning(&self, before: GlyphId, glyph: GlyphId) -> i16 {
        let tables = self.face.tables().kern.into_iter().flat_map(|kern| kern.subtables);
        let mut tables = tables.filter(|table| table.horizontal && !table.has_state_machine);
        let kerning = tables.find_map(|table| match table.format {
            Format::Format0(list) => {
                let mut pairs = list.pairs.into_iter();
                let pair = pairs.find(|pair| pair.left() == before && pair.right() == glyph);
                pair.map(|pair| pair.value)
            }
            _ => table.glyphs_kerning(before, glyph),
        });
        kerning.unwrap_or(0)
    }
}

/// A letter under construction.
struct Drawn {
    letter: Letter,
    place: [f64; 2],
    unit: f64,
}

impl Drawn {
    fn add<const N: usize>(&mut self, points: [(f32, f32); N]) {
        let ([left, base], unit) = (self.place, self.unit);
        let Some(contour) = self.letter.contours.last_mut() else { return };
        let placed = |(x, y)| [left + f64::from(x) * unit, base + f64::from(y) * unit];
        contour.points.extend(points.map(placed));
        if contour.points.len() > 1 {
            contour.degrees.push(N as u8);
        }
    }
}

impl OutlineBuilder for Drawn {
    fn move_to(&mut self, x: f32, y: f32) {
        self.letter.contours.push(Contour::default());
        self.add([(x, y)]);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.add([(x, y)]);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        self.add([(x1, y1), (x, y)]);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        self.add([(x1, y1), (x2, y2), (x, y)]);
    }

    fn close(&mut self) {}
}

#[cfg(test)]
mod tests {
    use super::*;

    fn range(letter: &Letter, axis: usize) -> (f64, f64) {
        let points = letter.contours.iter().flat_map(|contour| &contour.points);
        points.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), point| {
            (low.min(point[axis]), high.max(point[axis]))
        })
    }

    fn set(text: &str, offset: [f64; 2]) -> Vec<Letter> {
        let font = Font::parse(BUILT_IN).expect("a font");
        font.set(text, offset, |_| true).expect("room")
    }

    #[test]
    fn the_first_letter_begins_at_zero_and_others_where_the_one_before_ends() {
        let letters = set("ll l", [0.0; 2]);
        let [a, b, c] = [0, 1, 2].map(|i| range(&letters[i], 0));
        assert_eq!(letters.len(), 3, "a blank shows nothing");
        assert_eq!(a.0, 0.0);
        // Widths of l and of the blank, of 2048.
        assert!((b.0 - a.0 - 655.0 / 2048.0).abs() < 1e-12, "{b:?}");
        assert!((c.0 - b.0 - (655.0 + 651.0) / 2048.0).abs() < 1e-12, "{c:?}");
    }

    #[test]
    fn an_offset_moves_each_letter_after_the_first() {
        let (plain, moved) = (set("lll", [0.0; 2]), set("lll", [0.5, -0.25]));
        for (i, (plain, moved)) in plain.iter().zip(&moved).enumerate() {
            let by = i as f64;
            assert!((range(moved, 0).0 - range(plain, 0).0 - 0.5 * by).abs() < 1e-12);
            assert!((range(moved, 1).0 - range(plain, 1).0 + 0.25 * by).abs() < 1e-12);
        }
    }

    #[test]
    fn letters_that_fit_into_each_other_are_kerned() {
        let (kerned, apart) = (set("AV", [0.0; 2]), set("A", [0.0; 2]));
        let width = Font::parse(BUILT_IN).expect("a font");
        let width = f64::from(width.face.glyph_hor_advance(width.glyph('A')).expect("a width"));
        let v = range(&set("V", [0.0; 2])[0], 0);
        assert_eq!(range(&kerned[0], 0), range(&apart[0], 0));
        assert!(range(&kerned[1], 0).1 - v.1 < width / 2048.0 - 0.01);
    }

    #[test]
    fn what_a_font_lacks_has_a_sign_of_its_own() {
        assert_eq!(set("\u{4e00}", [0.0; 2]), set("\u{4e01}", [0.0; 2]));
        assert!(!set("\u{4e00}", [0.0; 2]).is_empty());
    }

    #[test]
    fn bytes_that_are_no_font_are_an_error() {
        for length in [0, 1, 12, 300, 5000] {
            assert!(Font::parse(&BUILT_IN[..length]).is_err(), "{length}");
        }
        assert!(Font::parse(b"not a font at all").is_err());
    }
}
