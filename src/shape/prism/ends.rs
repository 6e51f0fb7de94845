//! Where a line that meets walls and an end about the same place passes from the one to the other.
//!
//! **Invariant:** what rounding does not tell of two crossings, a place that is certain tells.

use crate::shape::U;
use crate::shape::body::Met;

pub(super) fn low(met: &Met) -> f64 {
    met.t - met.error
}

pub(super) fn high(met: &Met) -> f64 {
    met.t + met.error
}

/// On the line the other way.
pub(super) fn reversed(met: Met) -> Met {
    Met { t: -met.t, ..met }
}

/// A crossing that is known to lie after a place.
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

/// Where a line that enters the walls at `wall` enters a body that begins at `end`, and whether that is at the
/// end; `None` if not certainly before `limit`. What comes first, if rounding does not tell, the places after
/// the end do: there is one that is certainly within the walls, or still outside.
pub(super) fn entered(
    wall: Met,
    end: Met,
    limit: f64,
    is_within: impl Fn(f64) -> Option<bool>,
) -> Option<(Met, bool)> {
    if low(&wall) > high(&end) {
        return Some((wall, false));
    }
    let mut end = end;
    while high(&end) < limit {
        let place = high(&end);
        match is_within(place) {
            Some(true) => return Some((end, true)),
            Some(false) if place < high(&wall) => return Some((after(place, wall), false)),
            _ => end.error = 2.0 * end.error + f64::MIN_POSITIVE,
        }
    }
    None
}
