//! Removable pieces of a colour or a map: the smallest parts of the text whose removal cancels an effect.

use std::collections::HashSet;

use crate::color::Color;
use crate::scene::ColorMap;
use crate::source::{Site, Span};
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

    /// As [`Self::without`], for an opaque colour.
    pub fn without_clear(&self) -> Option<Vec<Site>> {
        self.without(|color| !color.is_clear())
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

/// A `color_map` and its removable pieces.
#[derive(Debug, Clone, PartialEq)]
pub struct WrittenMap {
    pub map: ColorMap,
    /// The pieces whose removal leaves no transparent colour; `None` if only removing the whole map is
    /// enough.
    pub clear: Option<Vec<Site>>,
    /// The pieces whose removal leaves a single colour, likewise.
    pub pattern: Option<Vec<Site>>,
}

/// A part of a `color_map`: an entry, or the name of another map.
pub(super) struct Part {
    pub item: Site,
    pub colors: Vec<WrittenColor>,
    /// In the old `[from, to color a color b]`, the piece `to color a`, whose removal leaves `[from color
    /// b]`.
    pub first: Option<Site>,
    /// For a name, its [`WrittenMap::clear`] and [`WrittenMap::pattern`].
    named: Option<[Option<Vec<Site>>; 2]>,
}

impl Part {
    pub fn entry(item: Site, colors: Vec<WrittenColor>, first: Option<Site>) -> Self {
        Self { item, colors, first, named: None }
    }

    pub fn name(item: Site, map: &WrittenMap) -> Self {
        let colors = map.map.0.iter().map(|(_, color)| WrittenColor::new(*color, None)).collect();
        Self { item, colors, first: None, named: Some([map.clear.clone(), map.pattern.clone()]) }
    }

    /// Returns the pieces whose removal makes each of its colours satisfy `suits`; `None` if only removing
    /// the whole part is enough.
    fn without(&self, suits: impl Fn(Color) -> bool) -> Option<Vec<Site>> {
        let pieces = self.colors.iter().enumerate().map(|(i, color)| {
            let first = self.first.filter(|_| i == 0).map(|first| vec![first]);
            color.without(&suits).or(first)
        });
        let pieces: Option<Vec<_>> = pieces.collect();
        pieces.map(|pieces| pieces.concat())
    }
}

/// Returns the pieces whose removal leaves a map of these parts without transparent colours.
pub(super) fn without_clear(parts: &[Part]) -> Option<Vec<Site>> {
    pieces(parts, |part| match &part.named {
        Some([clear, _]) => clear.clone(),
        None => part.without(|color| !color.is_clear()),
    })
}

/// Returns the pieces whose removal leaves a map of these parts with a single colour.
pub(super) fn without_pattern(parts: &[Part]) -> Option<Vec<Site>> {
    if let [Part { named: Some([_, pattern]), .. }] = parts {
        return pattern.clone();
    }
    // One entry remains, the first or else the last.
    let mut entries = parts.iter().filter(|part| part.named.is_none());
    let (first, last) = (entries.next(), entries.next_back());
    first.into_iter().chain(last).find_map(|staying| {
        let color = staying.colors.first()?.color();
        pieces(parts, |part| part.without(|other| other == color))
    })
}

/// Returns the pieces of each part, or the whole part; `None` if nothing would remain of the map.
fn pieces(parts: &[Part], of: impl Fn(&Part) -> Option<Vec<Site>>) -> Option<Vec<Site>> {
    let mut all: Vec<Site> = Vec::new();
    // A loop may visit one entry repeatedly; the removal applies to all turns.
    let mut gone: HashSet<Span> = HashSet::new();
    for part in parts {
        match of(part) {
            Some(pieces) => all.extend(pieces),
            None => {
                gone.insert(part.item.span);
                all.push(part.item);
            }
        }
    }
    let mut listed: HashSet<Span> = HashSet::new();
    all.retain(|piece| listed.insert(piece.span));
    parts.iter().any(|part| !gone.contains(&part.item.span)).then_some(all)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::{ExpansionId, FileId};

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

    #[test]
    fn one_entry_of_a_map_stays_and_a_loop_takes_all_of_its_turns() {
        let color = |transmit| WrittenColor::new(Color { transmit, ..Color::WHITE }, None);
        let entry = |at, transmit| Part::entry(site(at), vec![color(transmit)], None);
        let map = [entry(1, 0.5), entry(2, 0.0), entry(3, 1.0), entry(4, 0.0)];
        assert_eq!(without_clear(&map), Some(vec![site(1), site(3)]));
        assert_eq!(without_pattern(&map), Some(vec![site(2), site(3), site(4)]));
        let turns = [entry(1, 0.0), entry(1, 0.5), entry(1, 1.0)];
        assert_eq!((without_clear(&turns), without_pattern(&turns)), (None, None));
        let beside = [entry(1, 0.0), entry(1, 0.5), entry(2, 1.0)];
        assert_eq!(without_clear(&beside[..2]), None);
        assert_eq!(without_pattern(&beside), Some(vec![site(1)]));
    }
}
