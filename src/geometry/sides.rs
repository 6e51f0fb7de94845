//! Sides: from where the surface of a solid is seen.

use crate::shape::Chord;
use crate::shape::local::Met;

/// Which crossings of a solid are seen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Sides {
    Both,
    /// The surface has the seed's finish: seen from outside only.
    Outside,
    /// The same, inside and outside exchanged.
    Inside,
}

impl Sides {
    /// Whether a surface is seen where a ray leaves the solid, or enters it.
    #[inline(always)]
    pub(super) fn shows(self, leaving: bool) -> bool {
        match self {
            Self::Both => true,
            Self::Outside => !leaving,
            Self::Inside => leaving,
        }
    }

    /// Whether a crossing of a placed body is ahead, and seen.
    pub(super) fn see(self, met: &Met) -> bool {
        met.is_seen() && self.shows(met.leaving) && met.crossing().is_ahead()
    }

    #[inline(always)]
    pub(super) fn first_seen(self, chord: &Chord) -> Option<Met> {
        let enters = || chord.enter.is_ahead().then_some(Met::of(chord.enter, false));
        let leaves = || chord.leave.is_ahead().then_some(Met::of(chord.leave, true));
        match self {
            Self::Both => enters().or_else(leaves),
            Self::Outside => enters(),
            Self::Inside => leaves(),
        }
    }
}
