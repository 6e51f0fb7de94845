//! Scenes of a single object, for queries and for what is in no picture.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use crate::math::transform::Step;
use crate::scene::{
    LightSource, ModifierKind, Object, ObjectId, ObjectKind, Root, Scene, Solid, TextureId,
    TransformId,
};

/// Returns a scene with the object and its constituents only, without textures and lights.
pub fn single(scene: &Scene, object: ObjectId) -> Scene {
    let mut small = Scene {
        dialect: scene.dialect,
        textures: scene.textures[..1].to_vec(),
        pigments: scene.pigments[..1].to_vec(),
        finishes: scene.finishes[..1].to_vec(),
        ..Scene::default()
    };
    // Children stand before their parents in the arena: in ascending order each finds its own.
    let mut wanted = BTreeSet::from([object]);
    let mut open = vec![object];
    while let Some(id) = open.pop() {
        let Object { kind, modifiers, .. } = &scene.objects[id.index()];
        let clips = modifiers.iter().filter_map(|modifier| match modifier.kind {
            ModifierKind::ClippedBy(region) => Some(region),
            _ => None,
        });
        for child in children(kind).into_iter().chain(clips) {
            if wanted.insert(child) {
                open.push(child);
            }
        }
    }
    let renamed: BTreeMap<ObjectId, ObjectId> =
        wanted.iter().enumerate().map(|(new, &old)| (old, ObjectId(new as u32))).collect();
    let moves = |id: &ObjectId| {
        let object = &scene.objects[id.index()];
        let own = object.modifiers.iter().filter_map(|modifier| match modifier.kind {
            ModifierKind::Transform(id) => Some(id),
            _ => None,
        });
        let components = match &object.kind {
            ObjectKind::Solid(Solid::Blob(blob)) => &blob.components[..],
            _ => &[],
        };
        own.chain(components.iter().flat_map(|component| &component.transforms).copied())
    };
    let transforms = lists(scene, wanted.iter().flat_map(moves));
    let renamed_list: BTreeMap<TransformId, TransformId> =
        transforms.iter().enumerate().map(|(new, &old)| (old, TransformId(new as u32))).collect();
    for id in &transforms {
        let mut steps = scene.transforms[id.index()].clone();
        for step in &mut steps {
            if let Step::Transform(id) | Step::InverseOf(id) = step {
                *id = renamed_list[id];
            }
        }
        small.transforms.push(steps);
    }
    for id in wanted {
        let mut copy = scene.objects[id.index()].clone();
        copy.modifiers.retain(|modifier| {
            matches!(
                modifier.kind,
                ModifierKind::Transform(_) | ModifierKind::Inverse | ModifierKind::ClippedBy(_)
            )
        });
        for modifier in &mut copy.modifiers {
            match &mut modifier.kind {
                ModifierKind::Transform(id) => *id = renamed_list[id],
                ModifierKind::ClippedBy(region) => *region = renamed[region],
                _ => {}
            }
        }
        match &mut copy.kind {
            ObjectKind::Union(children) | ObjectKind::Csg { children, .. } => {
                children.iter_mut().for_each(|child| *child = renamed[child]);
            }
            ObjectKind::Use(child) => *child = renamed[child],
            ObjectKind::Solid(Solid::Blob(blob)) => {
                let components = Arc::make_mut(blob).components.iter_mut();
                let transforms = components.flat_map(|component| &mut component.transforms);
                transforms.for_each(|id| *id = renamed_list[id]);
            }
            // How its faces look does not matter.
            ObjectKind::Solid(Solid::Triangles { triangles, .. })
                if !triangles.textures.is_empty() =>
            {
                let mut bare = triangles.as_ref().clone();
                bare.textures.clear();
                bare.faces.iter_mut().for_each(|face| face.paint = None);
                *triangles = bare.into();
            }
            // Where it is does not matter.
            ObjectKind::LightSource(light) => {
                **light = LightSource::new(light.kind.clone(), light.color);
            }
            ObjectKind::Solid(_) => {}
        }
        small.objects.push(copy);
    }
    small.roots.push(Root { object: renamed[&object], default_texture: TextureId(0) });
    small
}

/// Copies these lists of steps and those that they refer to.
fn lists(scene: &Scene, wanted: impl Iterator<Item = TransformId>) -> BTreeSet<TransformId> {
    let mut all = BTreeSet::new();
    let mut open: Vec<TransformId> = wanted.collect();
    while let Some(id) = open.pop() {
        if all.insert(id) {
            open.extend(scene.transforms[id.index()].iter().filter_map(|step| match *step {
                Step::Transform(part) | Step::InverseOf(part) => Some(part),
                Step::Translate(_) | Step::Scale(_) | Step::Rotate(_) | Step::Matrix(_) => None,
            }));
        }
    }
    all
}

fn children(kind: &ObjectKind) -> Vec<ObjectId> {
    match kind {
        ObjectKind::Union(children) | ObjectKind::Csg { children, .. } => children.clone(),
        ObjectKind::Use(child) => vec![*child],
        ObjectKind::Solid(_) | ObjectKind::LightSource(_) => Vec::new(),
    }
}
