//! Truncates lines that are too long to show: to the parts around their labels, or to their end.
//!
//! **In:** a line, the labelled ranges in it, the available columns. **Out:** the parts to show.
//! **Invariant:** with an `…` for each omitted part, the result does not exceed the available columns, as
//! counted by terminals; the work is bounded likewise.

use std::ops::Range;

use unicode_width::UnicodeWidthChar;

use super::excerpt::push_visible;

/// Columns between tab stops.
pub const TAB: usize = 4;
/// Columns kept before and after a label in a truncated line; several labels share this many.
const AROUND: usize = 8;
/// Characters examined per column: most combining characters take no column.
const DENSEST: usize = 4;

/// Returns the width of a text in columns.
pub fn columns(text: &str) -> usize {
    text.chars().map(width).sum()
}

/// Returns the width of a character as drawn; for a tab, the maximum.
fn width(c: char) -> usize {
    match c {
        '\t' => TAB,
        ' '..='~' => 1,
        _ => {
            let mut drawn = String::new();
            push_visible(&mut drawn, c);
            drawn.chars().map(|c| c.width().unwrap_or(0)).sum()
        }
    }
}

/// Returns the byte up to which the text from byte `at` fits into `room` columns.
pub fn forward(text: &str, at: usize, room: usize) -> usize {
    let (mut used, mut count) = (0, 0);
    let beyond = text[at..].char_indices().find(|(_, c)| {
        used += width(*c);
        count += 1;
        used > room || count > DENSEST * room
    });
    beyond.map_or(text.len(), |(i, _)| at + i)
}

/// Returns the byte from which the text up to byte `at` fits into `room` columns, without separating a
/// combining mark from its letter.
fn back(text: &str, at: usize, room: usize) -> usize {
    let (mut used, mut count) = (0, 0);
    let fits = text[..at].char_indices().rev().take_while(|(_, c)| {
        used += width(*c);
        count += 1;
        used <= room && count <= DENSEST * room
    });
    fits.filter(|(_, c)| width(*c) > 0).last().map_or(at, |(i, _)| i)
}

/// Truncates a file name to `room` columns, keeping its end, which identifies it best.
pub fn ending(name: String, room: usize) -> String {
    match forward(&name, 0, room) == name.len() {
        true => name,
        false => format!("…{}", &name[back(&name, name.len(), room.saturating_sub(1))..]),
    }
}

/// Returns the parts of a line to show: all of it if it fits, otherwise what surrounds `places`, which must
/// be in ascending order.
pub fn parts(line: &str, places: &[Range<usize>], room: usize) -> Vec<Range<usize>> {
    if forward(line, 0, room) == line.len() {
        return std::iter::once(0..line.len()).collect();
    }
    let count = places.len().max(1);
    let clipped = |longest: usize| -> Vec<Range<usize>> {
        let clip = |place: &Range<usize>| {
            place.start..place.end.min(forward(line, place.start, longest.max(1)))
        };
        places.iter().map(clip).collect()
    };
    let taken = |places: &[Range<usize>]| -> usize {
        places.iter().map(|place| columns(&line[place.clone()]) + 2).sum()
    };
    // Truncates long labels at their end; several labels share the room.
    let mut places = clipped(room.saturating_sub(2 * AROUND + 2));
    if taken(&places) + AROUND > room {
        places = clipped((room / count).saturating_sub(AROUND / count + 2));
    }
    // The remaining room is shared by the text next to the labels.
    let around = room.saturating_sub(taken(&places)) / (2 * count);
    let mut parts: Vec<Range<usize>> = Vec::new();
    for place in places {
        let part = back(line, place.start, around)..forward(line, place.end, around);
        match parts.last_mut() {
            // Replacing a single column by `…` would gain nothing.
            Some(last) if forward(line, last.end, 1) >= part.start => {
                last.end = last.end.max(part.end)
            }
            _ => parts.push(part),
        }
    }
    // If there is not enough room for all labels, shows the first ones.
    let mut left = room.saturating_sub(1);
    parts.retain_mut(|part| {
        let any = left > 1;
        left = left.saturating_sub(1);
        part.end = part.end.min(forward(line, part.start, left));
        left -= columns(&line[part.clone()]);
        any
    });
    if parts.is_empty() {
        parts.push(0..0);
    }
    let shown = |parts: &[Range<usize>]| -> usize {
        parts.iter().map(|part| columns(&line[part.clone()]) + 1).sum::<usize>() + 1
    };
    // Unused room, at line ends or between close labels, goes to the last part, then the first, then the
    // gaps.
    let spare = |parts: &[Range<usize>]| room.saturating_sub(shown(parts));
    let left = spare(&parts);
    if let Some(last) = parts.last_mut() {
        last.end = forward(line, last.end, left);
    }
    let left = spare(&parts);
    if let Some(first) = parts.first_mut() {
        first.start = back(line, first.start, left);
    }
    for at in 1..parts.len() {
        let left = spare(&parts);
        parts[at - 1].end = forward(line, parts[at - 1].end, left).min(parts[at].start);
    }
    parts
}

#[cfg(test)]
#[allow(clippy::single_range_in_vec_init, reason = "one label")]
mod tests {
    use super::*;

    fn drawn(line: &str, places: &[Range<usize>], room: usize) -> String {
        let mut text = String::new();
        let mut end = 0;
        for part in parts(line, places, room) {
            text += if part.start > end { "…" } else { "" };
            text += &line[part.clone()];
            end = part.end;
        }
        text + if end < line.len() { "…" } else { "" }
    }

    #[test]
    fn a_line_that_fits_is_whole_and_a_longer_one_is_shown_around_its_places() {
        let line = "one two three four five six seven";
        assert_eq!(drawn(line, &[4..7], 33), line);
        assert_eq!(drawn(line, &[14..18], 20), "…o three four five …");
        assert_eq!(drawn(line, &[], 10), "one two …");
        assert_eq!(drawn(line, &[0..3, 28..33], 20), "one two t…ix seven");
    }

    #[test]
    fn whatever_is_marked_the_parts_fit() {
        for unit in ["x", "球", "e\u{301}", "\u{200b}", "\t", "👩\u{200d}🚀 "] {
            let line = unit.repeat(99);
            let at = |i: usize| i * unit.len();
            for places in [
                vec![],
                vec![at(0)..at(99)],
                vec![at(50)..at(51)],
                vec![at(0)..at(60), at(30)..at(90)],
                (0..40).map(|i| at(2 * i)..at(2 * i + 1)).collect(),
            ] {
                for room in [20, 51, 70] {
                    let drawn = drawn(&line, &places, room);
                    assert!(columns(&drawn) <= room, "{places:?} in {room}: {drawn}");
                }
            }
        }
    }

    #[test]
    fn a_long_name_keeps_its_end_and_no_mark_loses_its_letter() {
        assert_eq!(ending("a/b.scene".into(), 9), "a/b.scene");
        assert_eq!(ending("scenes/a/b.scene".into(), 9), "…/b.scene");
        assert_eq!(ending("e\u{301}e\u{301}e\u{301}".into(), 2), "…e\u{301}");
        assert_eq!(ending("球球球".into(), 4), "…球");
    }
}
