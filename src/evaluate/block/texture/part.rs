//! What a further `pigment`, `normal`, `finish` or `texture` of a texture or an object starts from: the one before
//! it, with all transforms since.
//!
//! **Source:** measured on POV-Ray 3.7, for textures, layers and objects: a pigment, normal or finish changes the
//! part that is there already, of layers that of the last; it refuses one for a pattern of textures. A texture is
//! a layer over those that the object has, from its own block or that of a declared object.

use crate::evaluate::stream::Token;
use crate::evaluate::{Evaluator, Outcome};
use crate::scene::{
    Colors, FinishId, Modifier, ModifierKind, NormalId, ObjectId, ObjectKind, PigmentId,
    PigmentKind, Step, Texture, TextureId, TextureKind, TransformId,
};
use crate::source::Span;
use crate::vocabulary::Word;

/// A part that an object has: one of its own, or that of its texture.
enum Before<T> {
    Part(T),
    Texture(TextureId),
}

impl Evaluator<'_> {
    /// Moves the transforms of a texture into its parts.
    pub(super) fn settle(&mut self, texture: &mut Texture) {
        let transforms = std::mem::take(&mut texture.transforms);
        if transforms.is_empty() {
            return;
        }
        match &mut texture.kind {
            TextureKind::Plain { pigment, normal, .. } => {
                *pigment = self.moved_pigment(*pigment, &transforms);
                *normal = normal.map(|normal| self.moved_normal(normal, &transforms));
            }
            TextureKind::Blend { steps, .. } => {
                steps.extend(transforms.into_iter().map(Step::Transform));
            }
            TextureKind::Layers(layers) => {
                for layer in layers {
                    let mut moved = self.scene.textures[layer.index()].clone();
                    moved.transforms.extend(&transforms);
                    *layer = self.add_texture(moved);
                }
            }
        }
    }

    /// Returns a texture, or its last layer, whose transforms are in its parts.
    pub(super) fn top_of(&mut self, texture: &Texture) -> Texture {
        let mut top = texture.clone();
        loop {
            self.settle(&mut top);
            match &top.kind {
                TextureKind::Layers(layers) => match layers.last() {
                    Some(last) => top = self.scene.textures[last.index()].clone(),
                    None => return top,
                },
                TextureKind::Plain { .. } | TextureKind::Blend { .. } => return top,
            }
        }
    }

    /// Changes a texture, or its last layer.
    pub(in crate::evaluate::block) fn change_top(
        &mut self,
        texture: &mut Texture,
        change: impl FnOnce(&mut Texture),
    ) {
        self.settle(texture);
        let TextureKind::Layers(layers) = &mut texture.kind else { return change(texture) };
        let Some(last) = layers.pop() else { return };
        let last = self.scene.textures[last.index()].clone();
        let mut top = self.top_of(&last);
        change(&mut top);
        layers.push(self.add_texture(top));
    }

    /// Returns the pigment from which another one after these modifiers starts.
    pub(in crate::evaluate::block) fn pigment_of(
        &mut self,
        modifiers: &[Modifier],
        used: Option<ObjectId>,
    ) -> PigmentId {
        let (before, since) = self.part_before(modifiers, used, |kind| match kind {
            ModifierKind::Pigment(pigment) => Some(*pigment),
            _ => None,
        });
        let pigment = match before {
            Before::Part(pigment) => pigment,
            Before::Texture(id) => self.top_of_id(id).kind.first_pigment(),
        };
        self.moved_pigment(pigment, &since)
    }

    /// Returns the normal from which another one after these modifiers starts.
    pub(in crate::evaluate::block) fn normal_of(
        &mut self,
        modifiers: &[Modifier],
        used: Option<ObjectId>,
    ) -> Option<NormalId> {
        let (before, since) = self.part_before(modifiers, used, |kind| match kind {
            ModifierKind::Normal(normal) => Some(*normal),
            _ => None,
        });
        let normal = match before {
            Before::Part(normal) => Some(normal),
            Before::Texture(id) => self.top_of_id(id).kind.first_normal(),
        };
        normal.map(|normal| self.moved_normal(normal, &since))
    }

    /// Returns the finish from which another one after these modifiers starts.
    pub(in crate::evaluate::block) fn finish_of(
        &mut self,
        modifiers: &[Modifier],
        used: Option<ObjectId>,
    ) -> FinishId {
        let (before, _) = self.part_before(modifiers, used, |kind| match kind {
            ModifierKind::Finish(finish) => Some(*finish),
            _ => None,
        });
        match before {
            Before::Part(finish) => finish,
            Before::Texture(id) => self.top_of_id(id).kind.first_finish(),
        }
    }

    /// Returns the word and the place of the pattern of a texture, or its last layer, if it is a pattern of
    /// textures.
    pub(super) fn top_pattern(&self, texture: &Texture) -> Option<(&'static str, Span)> {
        let mut of = texture;
        loop {
            match &of.kind {
                TextureKind::Plain { .. } => return None,
                TextureKind::Blend { pattern, .. } => {
                    return Some((pattern.source.word(), pattern.site.span));
                }
                TextureKind::Layers(layers) => of = &self.scene.textures[layers.last()?.index()],
            }
        }
    }

    /// Reports a pigment, normal or finish after these modifiers, if their texture is a pattern of textures.
    pub(in crate::evaluate::block) fn plain_before(
        &mut self,
        token: &Token,
        word: Word,
        modifiers: &[Modifier],
        used: Option<ObjectId>,
    ) -> Outcome<()> {
        let (Before::Texture(id), _) = self.part_before(modifiers, used, |_| None::<()>) else {
            return Ok(());
        };
        match self.top_pattern(&self.scene.textures[id.index()]) {
            Some(pattern) => Err(self.part_of_pattern(token, word, pattern)),
            None => Ok(()),
        }
    }

    /// Returns a texture that is written after these modifiers, as a layer over the texture that they set.
    pub(in crate::evaluate::block) fn layered(
        &mut self,
        modifiers: &[Modifier],
        used: Option<ObjectId>,
        texture: TextureId,
    ) -> TextureId {
        if self.hides(texture) {
            return texture;
        }
        let mut blocks = vec![modifiers.to_vec()];
        let mut next = used;
        while let Some(object) = next.map(|used| &self.scene.objects[used.index()]) {
            blocks.push(object.modifiers.clone());
            next = match object.kind {
                ObjectKind::Use(used) => Some(used),
                _ => None,
            };
        }
        let mut before: Option<Texture> = None;
        for Modifier { kind, .. } in blocks.into_iter().rev().flatten() {
            self.modify_texture(&mut before, &kind);
        }
        let Some(before) = before else { return texture };
        let mut layers = self.layers_in(before);
        let texture = self.scene.textures[texture.index()].clone();
        layers.extend(self.layers_in(texture));
        let kind = TextureKind::Layers(layers);
        self.add_texture(Texture { kind, transforms: Vec::new(), uv_mapping: false })
    }

    /// Applies a modifier to the texture that the ones before it set.
    pub(in crate::evaluate::block) fn modify_texture(
        &mut self,
        texture: &mut Option<Texture>,
        kind: &ModifierKind,
    ) {
        match (kind, texture) {
            (ModifierKind::Texture(id), texture) => {
                *texture = Some(self.scene.textures[id.index()].clone());
            }
            (ModifierKind::Transform(id), Some(texture)) => texture.transforms.push(*id),
            (ModifierKind::Pigment(id), Some(texture)) => {
                self.change_top(texture, |top| top.set_pigment(*id));
            }
            (ModifierKind::Normal(id), Some(texture)) => {
                self.change_top(texture, |top| top.set_normal(*id));
            }
            (ModifierKind::Finish(id), Some(texture)) => {
                self.change_top(texture, |top| top.set_finish(*id));
            }
            _ => {}
        }
    }

    /// Returns the layers of a texture, from the lowest up.
    fn layers_in(&mut self, mut texture: Texture) -> Vec<TextureId> {
        self.settle(&mut texture);
        match texture.kind {
            TextureKind::Layers(layers) => layers,
            _ => vec![self.add_texture(texture)],
        }
    }

    /// Returns whether no layer below a texture is visible.
    fn hides(&self, texture: TextureId) -> bool {
        match &self.scene.textures[texture.index()].kind {
            TextureKind::Layers(layers) => layers.iter().any(|layer| self.hides(*layer)),
            TextureKind::Blend { .. } => false,
            TextureKind::Plain { pigment, .. } => {
                let pigment = &self.scene.pigments[pigment.index()];
                let colors = match &pigment.kind {
                    PigmentKind::Patterned { colors, .. } => Some(colors),
                    PigmentKind::Color(_) | PigmentKind::Faces(_) => None,
                };
                pigment.clear.is_none() && !matches!(colors, Some(Colors::Pigments(_)))
            }
        }
    }

    fn top_of_id(&mut self, id: TextureId) -> Texture {
        let texture = self.scene.textures[id.index()].clone();
        self.top_of(&texture)
    }

    /// Returns what sets a part last among these modifiers, and the transforms after it. `used` is the declared
    /// object that they modify.
    fn part_before<T>(
        &self,
        modifiers: &[Modifier],
        used: Option<ObjectId>,
        part: impl Fn(&ModifierKind) -> Option<T>,
    ) -> (Before<T>, Vec<TransformId>) {
        let (mut modifiers, mut used) = (modifiers, used);
        let mut since = Vec::new();
        let before = 'found: loop {
            for Modifier { kind, .. } in modifiers.iter().rev() {
                match kind {
                    ModifierKind::Transform(id) => since.push(*id),
                    ModifierKind::Texture(id) => break 'found Before::Texture(*id),
                    kind => {
                        if let Some(part) = part(kind) {
                            break 'found Before::Part(part);
                        }
                    }
                }
            }
            let Some(object) = used.map(|used| &self.scene.objects[used.index()]) else {
                since.clear();
                break Before::Texture(self.default_texture);
            };
            modifiers = &object.modifiers;
            used = match object.kind {
                ObjectKind::Use(used) => Some(used),
                _ => None,
            };
        };
        since.reverse();
        (before, since)
    }

    fn moved_pigment(&mut self, id: PigmentId, transforms: &[TransformId]) -> PigmentId {
        if transforms.is_empty() {
            return id;
        }
        let mut pigment = self.scene.pigments[id.index()].clone();
        pigment.steps.extend(transforms.iter().copied().map(Step::Transform));
        self.add_pigment(pigment)
    }

    fn moved_normal(&mut self, id: NormalId, transforms: &[TransformId]) -> NormalId {
        if transforms.is_empty() {
            return id;
        }
        let mut normal = self.scene.normals[id.index()].clone();
        normal.steps.extend(transforms.iter().copied().map(Step::Transform));
        self.add_normal(normal)
    }
}
