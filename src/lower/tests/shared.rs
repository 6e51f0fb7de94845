//! Textures in which a branch occurs often: each is lowered once.

use super::build::*;
use crate::pattern::{Gradient, Kind};
use crate::scene::texture::Modifiers;
use crate::scene::*;

/// More levels would be too deep. A tree of them would have 2⁶⁰ leaves.
const LEVELS: usize = 60;

fn pattern(average: bool) -> Box<Pattern> {
    let gradient = Kind::Gradient(Gradient { direction: v(0.0, 1.0, 0.0) });
    let source = if average { Source::Average } else { Source::Kind(gradient) };
    Box::new(Pattern { source, site: site(902), modifiers: Modifiers::default() })
}

/// Returns two objects with textures of `LEVELS` in which each entry is the level below, of each of the things
/// that a map may contain.
fn doubled(average: bool) -> Build {
    let mut build = Build::new();
    let (mut pigment, mut texture) = (PigmentId(1), CHECKER);
    let bumps =
        NormalKind::Bumps { pattern: pattern(false), amount: 0.5, accuracy: 0.02, slopes: vec![] };
    let normal_of = |kind| Normal { kind, steps: vec![], site: site(903), keeps_depth: false };
    build.0.normals.push(normal_of(bumps));
    for level in 0..LEVELS {
        let entries = vec![(0.4, pigment), (0.4, pigment)];
        let (pattern, colors) = (pattern(average), Colors::Pigments(entries));
        pigment =
            build.pigment(PigmentKind::Patterned { pattern: pattern.clone(), colors }, vec![]);
        let entries = [0.4, 0.4].map(|value| (value, NormalId(level as u32))).to_vec();
        build.0.normals.push(normal_of(NormalKind::Map { pattern: pattern.clone(), entries }));
        let (entries, steps) = (vec![(0.4, texture), (0.4, texture)], vec![]);
        let kind = TextureKind::Blend { pattern, steps, entries };
        build.0.textures.push(Texture { kind, transforms: vec![], uv_mapping: false });
        texture = TextureId(build.0.textures.len() as u32 - 1);
    }
    let normal = NormalId(LEVELS as u32);
    for x in [0.0, 3.0] {
        let parts = vec![
            ModifierKind::Texture(PLAIN),
            ModifierKind::Pigment(pigment),
            ModifierKind::Normal(normal),
        ];
        for modifiers in [parts, vec![ModifierKind::Texture(texture)]] {
            let object = build.object(sphere(x, 0.0, 0.0, 1.0), modifiers);
            build.root(object);
        }
    }
    build
}

#[test]
fn a_branch_that_each_level_contains_twice_is_lowered_and_walked_once() {
    for average in [false, true] {
        let world = doubled(average).world();
        assert_eq!(world.textures.len(), 2);
        let [plain, composite] = [&world.textures[0], &world.textures[1]];
        assert_eq!(plain.colors().len(), 2);
        assert_eq!(composite.plains().count(), 1);
        assert!(composite.is_patterned() && !composite.is_clear() && !composite.has_layers());
        let mut spaces = 0;
        plain.for_each_space(&mut |_, _| spaces += 1);
        assert_eq!(spaces, 2 * (LEVELS + 1));
    }
}

#[test]
fn a_branch_that_fits_near_the_root_may_be_too_deep_further_down() {
    let mut build = doubled(false);
    let mut texture = TextureId(LEVELS as u32 + 1);
    for _ in 0..8 {
        let (entries, steps) = (vec![(0.4, texture), (0.6, CHECKER)], vec![]);
        let kind = TextureKind::Blend { pattern: pattern(false), steps, entries };
        build.0.textures.push(Texture { kind, transforms: vec![], uv_mapping: false });
        texture = TextureId(build.0.textures.len() as u32 - 1);
    }
    let modifiers = vec![ModifierKind::Texture(texture)];
    let object = build.object(sphere(9.0, 0.0, 0.0, 1.0), modifiers);
    build.root(object);
    assert_eq!(build.codes(), [crate::diagnostic::Code::OutOfRange]);
}
