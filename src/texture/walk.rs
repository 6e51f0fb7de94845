//! Walks over the trees of textures, pigments and normals that visit a shared branch once.
//!
//! Without that, a tree of n levels, each with the level below as two of its entries, would have 2ⁿ nodes.

use std::collections::HashSet;
use std::sync::Arc;

use smallvec::{SmallVec, smallvec};

use super::blend::Blend;
use super::{Normal, Pigment, Texture};

/// A node of a tree whose branches may be shared.
pub trait Node {
    /// Returns the nodes that it is made of, in written order.
    fn children(&self) -> Vec<&Self>;

    /// Returns the node and all nodes below it, each once, in written order.
    fn nodes(&self) -> SmallVec<[&Self; 1]> {
        let first = self.children();
        let mut found = smallvec![self];
        if first.is_empty() {
            return found;
        }
        let mut seen = HashSet::new();
        let mut ahead: Vec<&Self> = first.into_iter().rev().collect();
        while let Some(node) = ahead.pop() {
            if seen.insert(std::ptr::from_ref(node)) {
                found.push(node);
                ahead.extend(node.children().into_iter().rev());
            }
        }
        found
    }
}

impl Node for Texture {
    fn children(&self) -> Vec<&Self> {
        match self {
            Self::Plain(_) => Vec::new(),
            Self::Blend(blend) => of(&blend.entries),
            Self::Average { entries, .. } => of(entries),
            Self::Layers(all) | Self::Faces(all) => all.iter().map(|texture| &**texture).collect(),
        }
    }
}

impl Node for Pigment {
    fn children(&self) -> Vec<&Self> {
        match self {
            Self::Blend(blend) => of(&blend.entries),
            Self::Average { entries, .. } => of(entries),
            Self::Color(_) | Self::Ramp(_) | Self::Image { .. } | Self::Faces(_) => Vec::new(),
        }
    }
}

impl Node for Normal {
    fn children(&self) -> Vec<&Self> {
        match self {
            Self::Blend { blend: Blend { entries, .. }, .. } | Self::Average { entries, .. } => {
                of(entries)
            }
            Self::Bumps(_) | Self::Image { .. } => Vec::new(),
        }
    }
}

fn of<T>(entries: &[(f64, Arc<T>)]) -> Vec<&T> {
    entries.iter().map(|(_, node)| &**node).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::{Color, Rgb};
    use crate::texture::Space;

    /// Returns a pigment of `levels`, each the mean of two of the level below.
    fn doubled(levels: usize) -> Pigment {
        (0..levels).fold(Pigment::Color(Color::WHITE), |below, _| {
            let below = Arc::new(below);
            let entries = vec![(0.5, below.clone()), (0.5, below)];
            Pigment::Average { space: Space::default(), entries }
        })
    }

    #[test]
    fn a_shared_branch_is_visited_and_compared_once() {
        let pigment = doubled(60);
        assert_eq!(pigment.nodes().len(), 61);
        assert_eq!(pigment.colors(), [Color::WHITE]);
        let same = pigment.clone();
        assert!(pigment == same);
    }

    #[test]
    fn nodes_are_in_written_order() {
        let leaf = |gray| Arc::new(Pigment::Color(Color::opaque(Rgb::gray(gray))));
        let average = |entries: &[&Arc<Pigment>]| Pigment::Average {
            space: Space::default(),
            entries: entries.iter().map(|&entry| (1.0, entry.clone())).collect(),
        };
        let (a, b, c) = (leaf(0.1), leaf(0.2), leaf(0.3));
        let inner = Arc::new(average(&[&b, &a]));
        let whole = average(&[&a, &inner, &c]);
        assert_eq!(whole.colors(), [0.1, 0.2, 0.3].map(|gray| Color::opaque(Rgb::gray(gray))));
    }
}
