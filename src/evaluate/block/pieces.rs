//! Removable pieces of a colour: the smallest parts of the text whose removal cancels an effect.

use crate::color::Color;
use crate::source::Site;
use crate::vocabulary::Word;

/// Maximum number of components after a colour whose combinations are tried; with more, the whole colour is
/// removed.
const MOST_COMPONENTS: usize = 8;

/// A colour as it is written: a base, and the components set after it.
#[derive(Debug, Clone)]
pub(super) struct WrittenColor {
    /// `None` if it is written by its components alone.
    base: Option<Color>,
    /// The span of the base, if the components suffice without it.
    base_piece: Option<Site>,
    /// Keyword, value and site of each component.
    components: Vec<(Word, f64, Site)>,
    /// It starts with bare numbers, which are a colour only where nothing else is allowed.
    pub bare: bool,
}

impl WrittenColor {
    /// A colour without a base, defined by the components that follow.
    pub fn of_components() -> Self {
        Self { base: None, base_piece: None, components: Vec::new(), bare: false }
    }

    pub fn new(base: Color, base_piece: Option<Site>) -> Self {
        Self { base: Some(base), base_piece, ..Self::of_components() }
    }

    pub fn set(&mut self, word: Word, number: f64, piece: Site) {
        self.components.push((word, number, piece));
    }

    pub fn color(&self) -> Color {
        self.of(|_| true)
    }

    /// Returns the colour with only some of its parts: its base is part 0, its components follow.
    fn of(&self, stays: impl Fn(usize) -> bool) -> Color {
        let mut color = self.base.filter(|_| stays(0)).unwrap_or(Color::BLACK);
        let components = self.components.iter().enumerate();
        for (_, &(word, number, _)) in components.filter(|(i, _)| stays(i + 1)) {
            match word {
                Word::Red => color.rgb.red = number,
                Word::Green => color.rgb.green = number,
                Word::Blue => color.rgb.blue = number,
                Word::Filter => color.filter = number,
                _ => color.transmit = number,
            }
        }
        color
    }

    /// Returns the smallest set of parts whose removal makes the colour satisfy `suits`; among several, the
    /// first in source order. Returns `None` if only removing the whole colour is enough.
    pub fn without(&self, suits: impl Fn(Color) -> bool) -> Option<Vec<Site>> {
        let n = self.components.len();
        if n > MOST_COMPONENTS {
            return suits(self.color()).then(Vec::new);
        }
        // Part of a colour has to remain.
        let has_base = u32::from(self.base.is_some());
        let all = (1_u32 << (n + 1)) - 2 + has_base;
        let fixed = u32::from(self.base_piece.is_none());
        let found = (0..=all)
            .filter(|gone| gone & fixed == 0 && (*gone == 0 || *gone != all))
            .filter(|gone| suits(self.of(|i| gone >> i & 1 == 0)))
            .min_by_key(|gone| gone.count_ones())?;
        let base = self.base_piece.into_iter().filter(|_| found & 1 == 1);
        let components = self.components.iter().enumerate();
        let gone = components.filter(|(i, _)| found >> (i + 1) & 1 == 1);
        Some(base.chain(gone.map(|(_, (.., piece))| *piece)).collect())
    }
}

/// Returns the pieces whose removal makes two colours in one block black; the second may be missing. Returns
/// `None` if only removing the whole block is enough.
pub(super) fn without_light(both: [(&WrittenColor, Site); 2]) -> Option<Vec<Site>> {
    let [first, second] =
        both.map(|(color, item)| (color.without(|color| color.rgb.is_black()), item));
    match [&first.0, &second.0] {
        [None, None] => None,
        _ => {
            let pieces = |(pieces, item): (Option<Vec<Site>>, Site)| pieces.unwrap_or(vec![item]);
            Some([pieces(first), pieces(second)].concat())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::{ExpansionId, FileId, Span};

    fn site(at: usize) -> Site {
        Site { span: Span::new(FileId(0), at, at + 1), expansion: ExpansionId::MAIN }
    }

    fn opaque(color: Color) -> bool {
        !color.is_clear()
    }

    #[test]
    fn the_fewest_parts_of_a_colour_go_and_one_stays() {
        let clear = Color { transmit: 0.5, ..Color::WHITE };
        let mut color = WrittenColor::new(Color::WHITE, Some(site(0)));
        assert_eq!(color.without(opaque), Some(vec![]));
        color.set(Word::Transmit, 0.5, site(1));
        assert_eq!(color.without(opaque), Some(vec![site(1)]));
        color.set(Word::Filter, 0.5, site(2));
        assert_eq!(color.without(opaque), Some(vec![site(1), site(2)]));
        let mut color = WrittenColor::new(clear, Some(site(0)));
        assert_eq!(color.without(opaque), None);
        color.set(Word::Red, 0.5, site(1));
        assert_eq!(color.without(opaque), Some(vec![site(0)]));
        let mut color = WrittenColor::of_components();
        color.set(Word::Transmit, 0.5, site(1));
        assert_eq!(color.without(opaque), None);
        color.set(Word::Transmit, 0.0, site(2));
        assert_eq!(color.without(opaque), Some(vec![]));
    }
}
