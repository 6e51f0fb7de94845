//! Lists what the surfaces of a World consist of: patterns, normals, textures of textures and layers.
//!
//! **In:** the World's [`Origins`]. **Out:** each kind once, under its word in the language, with the cost of one
//! evaluation; pigments first, then normals, patterned textures and layers. **Invariant:** kinds that do not
//! occur are not listed.

use std::collections::BTreeMap;

use super::Kind;
use crate::pattern;
use crate::world::{Origins, SurfacePart};

pub(super) fn surfaces(origins: &Origins) -> Vec<Kind> {
    let mut found: BTreeMap<(SurfacePart, &'static str), Kind> = BTreeMap::new();
    for origin in &origins.surfaces {
        let kind = found.entry((origin.part, origin.word)).or_insert_with(|| Kind {
            word: name(origin.part, origin.word),
            count: 0,
            by: Vec::new(),
            cost: cost(origin.part, origin.word),
        });
        kind.count += 1;
        kind.by.extend(origin.site);
    }
    let mut kinds: Vec<Kind> = found.into_values().collect();
    kinds.iter_mut().for_each(Kind::sort_places);
    kinds
}

fn name(part: SurfacePart, word: &str) -> String {
    match part {
        SurfacePart::Pigment | SurfacePart::Layers => word.to_owned(),
        SurfacePart::Normal => format!("normal of {word}"),
        SurfacePart::Texture => format!("texture of {word}"),
    }
}

/// Returns what a hit costs.
fn cost(part: SurfacePart, word: &str) -> &'static str {
    if part == SurfacePart::Layers {
        return "the light on each layer a hit";
    }
    match word {
        "image_map" | "image_pattern" | "bump_map" | "material_map" | "density_file" => {
            "the pixels or values around a point"
        }
        "average" => "all its entries a point",
        "function" => "its function a point",
        "object" => "a test of its object a point",
        "pigment_pattern" => "its pigment a point",
        word => pattern::Kind::of_word(word).map_or("a formula a point", |pattern| pattern.cost()),
    }
}
