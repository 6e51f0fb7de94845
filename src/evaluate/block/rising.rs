//! Maps whose entries do not rise: entries that do, with the same picture as in POV-Ray 3.7.

use crate::evaluate::Evaluator;
use crate::scene::{Colors, Normal, NormalKind, Pigment, PigmentKind, Texture, TextureKind};
use crate::source::Site;

use super::blend_map::Entry;
use super::pattern::OpenPattern;

/// Returns entries in ascending order that render as POV-Ray 3.7 renders these unsorted ones. `between` mixes two
/// entries by the part of the second.
///
/// **Source:** measured on maps of colours, pigments, normals and textures: from the value of the last entry on,
/// that entry; below, the interpolation between the first entry with a larger value and the entry before it.
pub(super) fn rising<T: Copy>(
    entries: &[(f64, T)],
    mut between: impl FnMut(T, T, f64) -> T,
) -> Vec<(f64, T)> {
    let entries: Vec<_> = entries.iter().copied().filter(|(value, _)| !value.is_nan()).collect();
    let Some(&(end, last)) = entries.last() else { return Vec::new() };
    let mut rising = Vec::with_capacity(2 * entries.len());
    let (mut highest, mut before) = (f64::NEG_INFINITY, None);
    for (place, &(value, of)) in entries.iter().enumerate() {
        if value <= highest {
            continue;
        }
        let from = place.checked_sub(1).map(|before| entries[before]);
        let mut at = |at: f64| match from {
            Some((start, first)) => between(first, of, (at - start) / (value - start)),
            None => of,
        };
        // The entries between descend.
        if before != place.checked_sub(1) {
            rising.push((highest, at(highest)));
        }
        if value >= end {
            rising.push((end, at(end)));
            break;
        }
        rising.push((value, of));
        (highest, before) = (value, Some(place));
    }
    rising.push((end, last));
    rising
}

impl Evaluator<'_> {
    /// Returns an entry that is the mean of two, by the part of the second.
    pub(super) fn between(&mut self, first: Entry, second: Entry, part: f64, site: Site) -> Entry {
        let pattern = Box::new(OpenPattern::flat(site));
        let rest = 1.0 - part;
        match (first, second) {
            (Entry::Pigment(first), Entry::Pigment(second)) => {
                let colors = Colors::Pigments(vec![(rest, first), (part, second)]);
                Entry::Pigment(self.add_pigment(Pigment {
                    kind: PigmentKind::Patterned { pattern, colors },
                    steps: Vec::new(),
                    site,
                    clear: None,
                    has_own_colors: false,
                    quick_color: None,
                }))
            }
            (Entry::Normal(first), Entry::Normal(second)) => {
                let entries = vec![(rest, first), (part, second)];
                let kind = NormalKind::Map { pattern, entries };
                let normal = Normal { kind, steps: Vec::new(), site, keeps_depth: false };
                Entry::Normal(self.add_normal(normal))
            }
            (Entry::Texture(first), Entry::Texture(second)) => {
                let entries = vec![(rest, first), (part, second)];
                let kind = TextureKind::Blend { pattern, steps: Vec::new(), entries };
                let (transforms, uv_mapping) = (Vec::new(), false);
                Entry::Texture(self.add_texture(Texture { kind, transforms, uv_mapping }))
            }
            (first, _) => first,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::rising;

    #[test]
    fn entries_that_descend_end_where_the_last_one_is() {
        let lerp = |a: f64, b: f64, part: f64| a + (b - a) * part;
        let rise = |entries: &[(f64, f64)]| rising(entries, lerp);
        assert_eq!(rise(&[(0.75, 1.0), (0.25, 5.0)]), [(0.25, 1.0), (0.25, 5.0)]);
        // From 0.5 on, the entry at 1 and the one before it.
        let fall = [(0.5, 1.0), (0.25, 4.0), (1.0, 7.0)];
        assert_eq!(rise(&fall), [(0.5, 1.0), (0.5, 5.0), (1.0, 7.0), (1.0, 7.0)]);
        assert_eq!(rise(&[(f64::NAN, 1.0)]), []);
    }
}
