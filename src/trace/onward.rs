//! Several rays that go on from one surface: the first is followed, the others wait on the stack.

use super::Walk;
use super::path::{Fork, Link};
use super::way::Way;
use crate::color::Rgb;

/// A ray that goes on from a surface.
pub(super) struct Onward {
    pub way: Way,
    pub factor: Rgb,
    pub exponent: f64,
    /// It goes on behind the surface.
    pub behind: bool,
}

/// Adds a ray to those that go on. It is one with a ray of the same direction among those from `since` on, which
/// are few: each is compared.
pub(super) fn add(onward: &mut Vec<Onward>, since: usize, new: Onward) {
    let same = |old: &&mut Onward| {
        old.behind == new.behind
            && old.exponent == 1.0
            && new.exponent == 1.0
            && old.way.spectrum == new.way.spectrum
            && old.way.ray.direction == new.way.ray.direction
    };
    match onward[since..].iter_mut().find(same) {
        Some(old) => {
            old.factor += new.factor;
            old.way.weight = old.way.weight.max(new.way.weight);
        }
        None => onward.push(new),
    }
}

/// Follows the first of several rays from one surface; the others wait.
pub(super) fn go_on(walk: &mut Walk, local: Rgb, seed: bool, onward: Vec<Onward>) -> Option<Way> {
    let count = onward.len();
    for (place, Onward { way, factor, exponent, behind }) in onward.into_iter().enumerate().rev() {
        match behind {
            true => walk.counters.transmission += 1,
            false => walk.counters.reflection += 1,
        }
        let more = place + 1 < count;
        if place == 0 {
            walk.chain.push(Link { local, factor, exponent, seed, forks: more });
            if behind {
                walk.media.go_through();
            }
            return Some(way);
        }
        let media = match behind {
            true => walk.media.wait_behind(),
            false => walk.media.wait_here(),
        };
        walk.forks.push(Fork { way, factor, exponent, more, media });
    }
    None
}
