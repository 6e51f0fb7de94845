//! `slope_map`: the height of a bump as a curve over the pattern's value.

/// An entry, `[value <height, slope>]`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Entry {
    pub value: f64,
    pub height: f64,
    /// The slope with respect to the fraction of an interval between entries (not to the pattern's value).
    pub slope: f64,
}

/// Returns the height that replaces the pattern's value: a cubic Hermite curve between entries, in order of
/// their values. It replaces the value in `bump::displacement`, after the wave.
///
/// Beyond the entries it is the height of the last or the first. On a value that several entries have, it is
/// the height of the first of them, but that of the last if no value is greater. Patterns with their own
/// vectors accept a slope map, which has no effect.
///
/// **Source:** POV-Ray manual, section 3.4.6.2.2 "Slope Map"; the curve is measured on POV-Ray 3.7. For the
/// curve see Foley and others, *Computer Graphics: Principles and Practice*, 2nd ed., section 11.2.1.
pub(crate) fn height(entries: &[Entry], value: f64) -> f64 {
    let (Some(first), Some(last)) = (entries.first(), entries.last()) else { return value };
    if value >= last.value {
        return last.height;
    }
    let after = entries.iter().position(|entry| entry.value >= value).unwrap_or(0);
    let (from, to) = match after {
        0 => return first.height,
        after => (entries[after - 1], entries[after]),
    };
    let width = to.value - from.value;
    let t = if width > 0.0 { (value - from.value) / width } else { 1.0 };
    let rest = 1.0 - t;
    let blend = t * t * (3.0 - 2.0 * t);
    let bends = t * rest * (from.slope * rest - to.slope * t);
    from.height + (to.height - from.height) * blend + bends
}
