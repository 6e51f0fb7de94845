//! Resolves the order in which a line crosses a wall and an end that are close together.
//!
//! **Invariant:** where rounding hides the order of two crossings, a point with a certain result decides it.

use std::ops::Range;

use crate::shape::U;
use crate::shape::local::Met;

pub(super) fn low(met: &Met) -> f64 {
    met.t - met.error
}

pub(super) fn high(met: &Met) -> f64 {
    met.t + met.error
}

/// The crossing, on the line in reverse direction.
pub(super) fn reversed(met: Met) -> Met {
    Met { t: -met.t, ..met }
}

/// Adjusts a crossing that is known to lie after a position.
pub(super) fn after(place: f64, met: Met) -> Met {
    if place <= low(&met) {
        return met;
    }
    let t = 0.5 * (place + high(&met));
    Met { t, error: (t - place).max(0.0) + 4.0 * U * (t.abs() + met.error), ..met }
}

pub(super) fn before(place: f64, met: Met) -> Met {
    reversed(after(-place, reversed(met)))
}

/// Returns where a line that enters the walls at `wall` enters a body that begins at `end`, and whether that
/// is at the end; `None` if this is not certainly before `limit`. It is certainly within the
/// walls where `told` says so. If rounding hides the order, points after
/// the end decide it: one of them is certainly within the walls, or still outside.
pub(super) fn entered(
    wall: Met,
    end: Met,
    told: &Range<f64>,
    limit: f64,
    is_within: impl Fn(f64) -> Option<bool>,
) -> Option<(Met, bool)> {
    if low(&wall) > high(&end) {
        return Some((wall, false));
    }
    let mut end = end;
    while high(&end) < limit {
        let place = high(&end);
        let is_within = if told.contains(&place) { Some(true) } else { is_within(place) };
        match is_within {
            Some(true) => return Some((end, true)),
            Some(false) if place < high(&wall) => return Some((after(place, wall), false)),
            _ => end.error = 2.0 * end.error + f64::MIN_POSITIVE,
        }
    }
    None
}
