//! Per-face attributes of a mesh: textures and texture coordinates.
//!
//! **Invariant:** each index refers to an existing entry.

use std::collections::HashMap;

use crate::diagnostic::{Code, Diagnostic};
use crate::scene::{FinishId, PigmentId, TextureId, TextureKind};
use crate::vocabulary::Word;

use super::super::super::lint::is_literal;
use super::super::super::stream::{Token, TokenKind};
use super::super::super::value::Value;
use super::super::super::{Evaluator, Outcome, Reported};
use super::super::{Given, Place};

/// Attributes of one face.
#[derive(Debug, Default, Clone, Copy)]
pub(super) struct Dress {
    /// Index into [`Textures`] for each corner.
    pub paint: Option<[u32; 3]>,
    pub uvs: Option<[[f64; 2]; 3]>,
}

/// The textures of a mesh's triangles, without duplicates.
#[derive(Debug, Default)]
pub(super) struct Textures {
    list: Vec<TextureId>,
    /// The textures that share a pigment, a finish and their parts, to be compared for equality.
    known: HashMap<(PigmentId, FinishId, Vec<TextureId>), Vec<u32>>,
}

impl Textures {
    pub fn into_list(self) -> Vec<TextureId> {
        self.list
    }
}

/// A face of a `mesh2`, and the texture index of each corner.
pub(super) type Painted = ([f64; 3], Option<[u32; 3]>);

impl Evaluator<'_> {
    /// Reads an item after the corners of a mesh's triangle.
    pub(super) fn dress(
        &mut self,
        token: &Token,
        word: Word,
        dress: &mut Dress,
        all: &mut Textures,
    ) -> Outcome<()> {
        match word {
            Word::UvVectors => {
                let mut corner = |name| self.uv_after(token, name);
                dress.uvs = Some([corner("first")?, corner("second")?, corner("third")?]);
            }
            Word::Texture => {
                let id = self.face_texture(token)?;
                dress.paint = Some([self.number_of_texture(id, all); 3]);
            }
            _ => {
                let listed = self.block(token, word, Self::listed_textures)?;
                let [a, b, c] = listed[..] else {
                    let message =
                        format!("{} textures for the 3 corners of a triangle", listed.len());
                    let diagnostic = Diagnostic::new(Code::WrongArity, message)
                        .at(token.span, "expected a texture for each corner: 3");
                    return Err(self.report(&token.here, diagnostic));
                };
                dress.paint = Some([a, b, c].map(|id| self.number_of_texture(id, all)));
            }
        }
        Ok(())
    }

    /// Returns the index of a texture in a mesh's list, adding it if it is new.
    fn number_of_texture(&self, id: TextureId, all: &mut Textures) -> u32 {
        let texture = &self.scene.textures[id.index()];
        let parts = match &texture.kind {
            TextureKind::Plain { .. } => Vec::new(),
            TextureKind::Blend { entries, .. } => entries.iter().map(|(_, id)| *id).collect(),
            TextureKind::Layers(layers) => layers.clone(),
        };
        let key = (texture.kind.first_pigment(), texture.kind.first_finish(), parts);
        let alike = all.known.entry(key).or_default();
        let same = |at: &&u32| self.scene.textures[all.list[**at as usize].index()] == *texture;
        if let Some(known) = alike.iter().find(same) {
            return *known;
        }
        all.list.push(id);
        alike.push(all.list.len() as u32 - 1);
        all.list.len() as u32 - 1
    }

    /// Reads `texture { … }`, which cannot have layers here.
    fn face_texture(&mut self, token: &Token) -> Outcome<TextureId> {
        let texture = self.one_texture(token)?;
        Ok(self.add_texture(texture))
    }

    /// Reads textures up to the end of a block, each in braces or as a bare name.
    fn listed_textures(&mut self) -> Outcome<Vec<TextureId>> {
        let mut listed = Vec::new();
        while let Some(token) = self.next() {
            let texture = match token.kind {
                TokenKind::Comma => continue,
                TokenKind::Word(Word::Texture) => Some(self.face_texture(&token)?),
                TokenKind::Expression(id) => match self.declared_item(&token, id, Place::TEXTURE) {
                    Err(_) => return Err(Reported),
                    Ok(Some(Value::Texture(id))) => Some(id),
                    Ok(_) => None,
                },
                _ => None,
            };
            let Some(texture) = texture else {
                return Err(self.expected("a texture", Some(&token), (&token.here, token.span)));
            };
            listed.push(texture);
        }
        Ok(listed)
    }

    /// Reads `texture_list { count, texture { … }, … }` of a `mesh2`. Also returns whether their number
    /// equals the count; if not, it has been reported.
    pub(super) fn texture_list(&mut self, list: &Token) -> Outcome<(Vec<TextureId>, bool)> {
        self.block(list, Word::TextureList, |evaluator| {
            let count = evaluator.number_after(list, "how many there are")?;
            let listed = evaluator.listed_textures()?;
            if listed.len() == evaluator.counted(&count) {
                return Ok((listed, true));
            }
            let found = listed.len();
            let message = format!("`texture_list` has {found} entries");
            let diagnostic = Diagnostic::new(Code::WrongArity, message)
                .at(count.span, "another number was announced");
            let text = evaluator.sources.text(count.span);
            let diagnostic = match is_literal(text) {
                true => diagnostic
                    .help(format!("if these are all, write `{found}` instead of `{text}`"))
                    .fix(count.span, found.to_string()),
                false => diagnostic,
            };
            evaluator.report(&list.here, diagnostic);
            // The faces may have mistakes of their own.
            Ok((listed, false))
        })
    }

    /// Reads `face_indices` after a `texture_list` of `textures`: each face may be followed by the index of
    /// its texture, or one index for each corner. Fractions are truncated, as in POV-Ray. Also returns
    /// whether an invalid texture index was reported.
    pub(super) fn painted_faces(
        &mut self,
        list: &Token,
        textures: usize,
    ) -> Outcome<(Vec<Painted>, bool)> {
        self.block(list, Word::FaceIndices, |evaluator| {
            let count = evaluator.number_after(list, "how many there are")?;
            let wanted = evaluator.counted(&count);
            let mut faces: Vec<([f64; 3], Vec<u32>)> = Vec::new();
            // The faces are read on for mistakes of their own.
            let mut told = false;
            while faces.len() < wanted || evaluator.is_value_next() {
                let given = evaluator.given(list, &format!("{wanted} vectors"))?;
                let is_full = faces.len() == wanted;
                match (given.value.as_number(), given.value.numbers(), faces.last_mut()) {
                    (Some(number), _, Some((_, paint))) => {
                        let is_there = number > -1.0 && number < textures as f64;
                        if !is_there && !std::mem::replace(&mut told, true) {
                            let message = format!("there is no texture {number} in this mesh2");
                            let label = format!("`texture_list` has entries 0 to {}", textures - 1);
                            let diagnostic =
                                Diagnostic::new(Code::OutOfRange, message).at(given.span, label);
                            evaluator.report(&given.here, diagnostic);
                        }
                        paint.push(number as u32);
                    }
                    (None, Some(_), _) if is_full => {
                        let at = (&given.here, given.span);
                        return Err(evaluator.too_many(Word::FaceIndices, wanted, at, count.span));
                    }
                    (None, Some(numbers), _) if numbers.len() <= 3 => {
                        let mut corners = [0.0; 3];
                        corners[..numbers.len()].copy_from_slice(numbers.as_slice());
                        faces.push((corners, Vec::new()));
                    }
                    _ => {
                        let Given { value, span, here, .. } = &given;
                        return Err(evaluator.wrong_type(here, *span, "a vector", value));
                    }
                }
                if !evaluator.has_memory(size_of_val(&faces[..]) as u64) {
                    return Err(evaluator.too_much_memory(&list.here, list.span));
                }
            }
            if let Some(next) = evaluator.next() {
                let at = (&next.here, next.span);
                return Err(evaluator.too_many(Word::FaceIndices, wanted, at, count.span));
            }
            let paint = |paint: &[u32]| match *paint {
                [] => Some(None),
                [one] => Some(Some([one; 3])),
                [a, b, c] => Some(Some([a, b, c])),
                _ => None,
            };
            let painted = faces.iter().map(|(face, all)| paint(all).map(|paint| (*face, paint)));
            painted.collect::<Option<_>>().map(|painted| (painted, told)).ok_or_else(|| {
                let stray = faces.iter().position(|(_, all)| paint(all).is_none()).unwrap_or(0);
                let message = format!("face {stray} has {} textures", faces[stray].1.len());
                let diagnostic = Diagnostic::new(Code::WrongArity, message)
                    .at(list.span, "a face has one texture, or one for each of its three corners");
                evaluator.report(&list.here, diagnostic)
            })
        })
    }

    /// Returns whether a value comes next, after any commas.
    fn is_value_next(&mut self) -> bool {
        self.skip_commas();
        let next = self.peek().map(|token| &token.kind);
        matches!(next, Some(TokenKind::Expression(_) | TokenKind::Literal(_)))
    }

    /// Reads a texture coordinate of two numbers.
    pub(in super::super) fn uv_after(&mut self, token: &Token, name: &str) -> Outcome<[f64; 2]> {
        let wanted = format!("a vector of two numbers for the {name} corner");
        let given = self.given(token, &wanted)?;
        match given.value.numbers().as_ref().map(|numbers| numbers.as_slice()) {
            Some(&[u, v]) => Ok([u, v]),
            Some(&[both]) => Ok([both; 2]),
            Some(&[_, _, ..]) => {
                Err(self.too_wide(&given, Word::UvVectors, "a place in a texture", 2))
            }
            _ => Err(self.wrong_type(&given.here, given.span, &wanted, &given.value)),
        }
    }
}
