//! What a quality below 9 leaves out of a picture, for a quick look at a scene.
//!
//! **Source:** POV-Ray 3.7 manual, section 3.2.8.3 "Quality Settings", and the program, measured for each quality.

use lucarne::color::{Color, Rgb};
use lucarne::scene::{
    Colors, Finish, ModifierKind, PigmentKind, Scene, Texture, TextureId, TextureKind,
};
use lucarne::world::World;

/// Leaves out fogs and rainbows below 9, reflection and normals below 8, pigments with a `quick_color` below 6,
/// and below 2 all but the colours of pigments.
pub fn simplify(scene: &mut Scene, quality: u32) {
    if quality < 9 {
        scene.fogs.clear();
        scene.rainbows.clear();
    }
    if quality < 8 {
        for texture in &mut scene.textures {
            if let TextureKind::Plain { normal, .. } = &mut texture.kind {
                *normal = None;
            }
        }
        for object in &mut scene.objects {
            object.modifiers.retain(|modifier| !matches!(modifier.kind, ModifierKind::Normal(_)));
        }
    }
    for finish in &mut scene.finishes {
        if let Finish::Classic(finish) = finish {
            if quality < 8 {
                finish.reflection = None;
            }
            if quality < 2 {
                (finish.ambient, finish.emission) = (Rgb::BLACK, Rgb::WHITE);
            }
        }
    }
    for pigment in &mut scene.pigments {
        if let Some(color) = pigment.quick_color.filter(|_| quality < 6) {
            pigment.kind = PigmentKind::Color(color);
        }
    }
    if quality < 2 {
        bare_layers(scene);
        let kinds = scene.pigments.iter_mut().map(|pigment| &mut pigment.kind);
        kinds.for_each(be_opaque);
    }
}

/// Leaves out the areas of lights below 5, shadows below 4, and lights below 2.
pub fn dim(world: &mut World, quality: u32) {
    if quality < 2 {
        world.lights.clear();
    }
    for object in &mut world.objects {
        object.casts_shadow &= quality >= 4;
    }
    for light in &mut world.lights {
        light.area = light.area.take().filter(|_| quality >= 5);
    }
}

/// Returns the most surfaces that a ray is followed through, if the quality limits it: nothing is seen through surfaces
/// below 6.
pub fn depth(quality: u32) -> Option<u32> {
    (quality < 6).then_some(1)
}

/// Replaces layers by the lowest that no opaque layer covers.
fn bare_layers(scene: &mut Scene) {
    for at in 0..scene.textures.len() {
        let TextureKind::Layers(layers) = &scene.textures[at].kind else { continue };
        let covers = |layer: &&TextureId| match scene.textures[layer.index()].kind {
            TextureKind::Plain { pigment, .. } => {
                let kind = &scene.pigments[pigment.index()].kind;
                matches!(kind, PigmentKind::Color(color) if !color.is_clear())
            }
            _ => false,
        };
        let seen = layers.iter().rev().find(covers).or(layers.first());
        let Some(seen) = seen.map(|layer| &scene.textures[layer.index()]) else { continue };
        let transforms = [&seen.transforms[..], &scene.textures[at].transforms].concat();
        scene.textures[at] = Texture { transforms, ..seen.clone() };
    }
}

/// Makes the colours of a pigment opaque, except those of pictures.
fn be_opaque(kind: &mut PigmentKind) {
    let opaque = |color: &mut Color| *color = Color::opaque(color.rgb);
    match kind {
        PigmentKind::Color(color) => opaque(color),
        PigmentKind::Patterned { colors: Colors::Map(map), .. } => {
            map.0.iter_mut().for_each(|(_, color)| opaque(color));
        }
        PigmentKind::Patterned { .. } | PigmentKind::Faces(_) => {}
    }
}
