//! Triangles: single, listed in a `mesh`, or as vertices and faces in a `mesh2`.
//!
//! **Invariant:** a degenerate face is reported and omitted; every index refers to an existing entry.

mod dress;
mod file;
mod flaw;
mod guess;
mod lists;

pub(in crate::evaluate) use file::MeshFiles;

use std::collections::HashMap;
use std::sync::Arc;

use crate::diagnostic::{Code, Diagnostic};
use crate::math::Vector;
use crate::scene::Solid;
use crate::scene::mesh::{Face, Triangles};
use crate::vocabulary::{Dialect, Word};

use super::super::stream::{Token, TokenKind};
use super::super::{Evaluator, Outcome, Reported};
use super::{Given, Place};
use dress::{Dress, Textures};
use flaw::{Flaws, is_degenerate};

/// Triangles that are specified one by one; equal vertices are merged.
#[derive(Default)]
struct Gathered {
    triangles: Triangles,
    known: HashMap<[u64; 3], u32>,
    textures: Textures,
    flaws: Flaws,
}

/// Three corners, and their normals if the triangle is smooth.
type Triangle = ([Given<Vector>; 3], Option<[Given<Vector>; 3]>);

impl Gathered {
    /// Adds the triangle that `token` opened. Returns `false` for a degenerate one, which is omitted.
    fn add(&mut self, token: &Token, (corners, normals): &Triangle, dress: Dress) -> bool {
        let corners = corners.each_ref().map(|corner| corner.value);
        if is_degenerate(corners) {
            self.flaws.degenerate.add(token.here.site(token.span));
            return false;
        }
        let vertices = corners.map(|corner| {
            let list = &mut self.triangles.vertices;
            // Adding zero turns −0 into 0.
            let bits = (corner + Vector::ZERO).to_array().map(f64::to_bits);
            *self.known.entry(bits).or_insert_with(|| {
                list.push(corner);
                list.len() as u32 - 1
            })
        });
        for normal in normals.iter().flatten().filter(|normal| normal.value == Vector::ZERO) {
            self.flaws.aimless.add(normal.site());
        }
        let normals = normals.as_ref().map(|all| {
            let first = self.triangles.normals.len() as u32;
            self.triangles.normals.extend(all.each_ref().map(|normal| normal.value));
            [first, first + 1, first + 2]
        });
        let uvs = dress.uvs.map(|all| {
            let first = self.triangles.uvs.len() as u32;
            self.triangles.uvs.extend(all);
            [first, first + 1, first + 2]
        });
        self.triangles.faces.push(Face { vertices, normals, paint: dress.paint, uvs });
        true
    }
}

impl Evaluator<'_> {
    pub(super) fn triangle(&mut self, token: &Token) -> Outcome<Solid> {
        let corners = self.corners(token)?;
        self.lone_triangle(token, Word::Triangle, &(corners, None))
    }

    pub(super) fn smooth_triangle(&mut self, token: &Token) -> Outcome<Solid> {
        let triangle = self.smooth_corners(token)?;
        self.lone_triangle(token, Word::SmoothTriangle, &triangle)
    }

    fn lone_triangle(&mut self, token: &Token, word: Word, triangle: &Triangle) -> Outcome<Solid> {
        let mut gathered = Gathered::default();
        if !gathered.add(token, triangle, Dress::default()) {
            let [first, .., last] = &triangle.0;
            // POV-Ray reports it, too.
            let code = match self.options.dialect {
                Dialect::Scene => Code::ZeroSize,
                Dialect::Pov => Code::DegenerateTriangle,
            };
            let diagnostic =
                Diagnostic::new(code, "a triangle whose corners lie in a line is nothing")
                    .at(last.span, "expected a corner beside the line through the other two")
                    .also(first.span, "the first corner");
            self.nothing(token, &last.here, diagnostic)?;
        }
        self.tell_of_aimless(gathered.flaws.aimless, word, token.here.site(token.span));
        Ok(Solid::Triangles { word, triangles: Arc::new(gathered.triangles) })
    }

    fn corners(&mut self, token: &Token) -> Outcome<[Given<Vector>; 3]> {
        if let Some(reported) = self.bare_points(3, 0) {
            return Err(reported);
        }
        let a = self.vector_after(token, "a vector for the first corner");
        let b = self.vector_after(token, "a vector for the second corner");
        let c = self.vector_after(token, "a vector for the third corner");
        Ok([a?, b?, c?])
    }

    fn smooth_corners(&mut self, token: &Token) -> Outcome<Triangle> {
        let before = self.told();
        let mut corner = |name: &str| {
            let corner = self.vector_after(token, &format!("a vector for the {name} corner"));
            let normal = self.vector_after(token, &format!("a vector for the {name} normal"));
            Ok((corner?, normal?))
        };
        let (a, b, c) = (corner("first"), corner("second"), corner("third"));
        if b.is_err() && self.has_plain_points(3) {
            self.take_back(before);
            let message = "a `smooth_triangle` has a normal behind each of its corners";
            let told = Diagnostic::new(Code::MissingPart, message)
                .at(token.span, "without normals it is a `triangle`")
                .help("replace it with `triangle`")
                .fix(token.span, Word::Triangle.name());
            return Err(self.report(&token.here, told));
        }
        let ((a, m), (b, n), (c, o)) = (a?, b?, c?);
        Ok(([a, b, c], Some([m, n, o])))
    }

    /// Reads `mesh { triangle { … } smooth_triangle { … } … inside_vector … }`, or `mesh { file "…" … }`.
    pub(super) fn mesh(&mut self, token: &Token) -> Outcome<Solid> {
        if let Some(reported) = self.file_unworded(token, Word::Mesh) {
            return Err(reported);
        }
        if self.is_other_mesh(token, Word::Mesh2) {
            return self.mesh2(token);
        }
        let mut gathered = Gathered::default();
        let mut from_file = None;
        let mut failed = false;
        loop {
            self.skip_commas();
            if self
                .passes_no_part(Place::shape(Word::Mesh), &[Word::Triangle, Word::SmoothTriangle])
            {
                failed = true;
                continue;
            }
            let Some(Token { kind: TokenKind::Word(word), .. }) = self.peek() else { break };
            let word = *word;
            let outcome = match word {
                Word::File => {
                    let Some(token) = self.next() else { break };
                    self.mesh_file(&token).map(|file| from_file = Some((token, file)))
                }
                Word::Triangle | Word::SmoothTriangle => {
                    let Some(token) = self.next() else { break };
                    self.mesh_triangle(&token, word, &mut gathered)
                }
                Word::InsideVector | Word::Hierarchy => {
                    let Some(token) = self.next() else { break };
                    self.mesh_word(&token, word, &mut gathered.triangles.inside)
                }
                _ => break,
            };
            failed |= outcome.is_err();
        }
        if failed {
            return Err(Reported);
        }
        let Gathered { mut triangles, flaws, textures, .. } = gathered;
        triangles.textures = textures.into_list();
        match from_file {
            Some((file, read)) => self.mesh_of_file(token, &file, &read, triangles),
            None => self.whole_mesh(token, Word::Mesh, triangles, flaws),
        }
    }

    /// Returns whether the first part belongs to the `other` kind of mesh, and reports it: `mesh {
    /// vertex_vectors … }`, `mesh2 { triangle … }`.
    fn is_other_mesh(&mut self, token: &Token, other: Word) -> bool {
        let Some(Token { kind: TokenKind::Word(part), span, here }) = self.peek().cloned() else {
            return false;
        };
        let is_of_other = match other {
            Word::Mesh => matches!(part, Word::Triangle | Word::SmoothTriangle),
            _ => matches!(part, Word::VertexVectors | Word::NormalVectors | Word::FaceIndices),
        };
        let opener = self.sources.text(token.span);
        if !is_of_other || opener == other.name() {
            return false;
        }
        let (name, part) = (other.name(), part.name());
        let told = Diagnostic::new(Code::MisplacedBlock, format!("`{part}` stands in a `{name}`"))
            .at(token.span, format!("did you mean `{name}`?"))
            .also(span, "its first part")
            .help(format!("replace it with `{name}`"))
            .fix(token.span, name);
        self.report(&here, told);
        true
    }

    /// Reads one triangle of a mesh, with an optional texture and texture coordinates of its own.
    fn mesh_triangle(&mut self, token: &Token, word: Word, all: &mut Gathered) -> Outcome<()> {
        self.block(token, word, |evaluator| {
            let triangle = match word {
                Word::SmoothTriangle => evaluator.smooth_corners(token)?,
                _ => (evaluator.corners(token)?, None),
            };
            let mut dress = Dress::default();
            while let Some(next) = evaluator.next() {
                match next.kind {
                    TokenKind::Comma => {}
                    TokenKind::Word(
                        word @ (Word::UvVectors | Word::Texture | Word::TextureList),
                    ) => {
                        evaluator.dress(&next, word, &mut dress, &mut all.textures)?;
                    }
                    TokenKind::Word(Word::Pigment | Word::Finish | Word::Normal) => {
                        return Err(evaluator.untextured(&next));
                    }
                    _ => {
                        evaluator.unexpected(&next, Place::shape(word));
                        return Err(Reported);
                    }
                }
            }
            all.add(token, &triangle, dress);
            Ok(())
        })
    }

    /// Reports a pigment without a texture in a triangle of a mesh: `triangle { <…>, <…>, <…> pigment { … }
    /// }`.
    fn untextured(&mut self, first: &Token) -> Reported {
        let mut next = Some(first.clone());
        while let Some(Token { kind: TokenKind::Word(word), .. }) = next {
            self.skip_arguments(word);
            let of_texture = |kind: &TokenKind| {
                matches!(kind, TokenKind::Word(Word::Pigment | Word::Finish | Word::Normal))
            };
            next = self.next_if(of_texture);
        }
        let whole = self.whole(first).span;
        let text = self.sources.text(whole).to_owned();
        let told = Diagnostic::new(Code::MisplacedBlock, "a triangle of a mesh takes a `texture`")
            .at(first.span, "expected `texture { … }` around this");
        let told = match text.contains('#') {
            true => told,
            false => {
                let right = format!("texture {{ {text} }}");
                told.help(format!("write `{right}`")).fix(whole, right)
            }
        };
        self.report(&first.here, told)
    }

    /// Reads `inside_vector` and `hierarchy`, which are allowed among a mesh's parts.
    fn mesh_word(&mut self, token: &Token, word: Word, inside: &mut Option<Vector>) -> Outcome<()> {
        match word {
            Word::InsideVector => {
                let way = self.vector_after(token, "a vector for the way out")?;
                // The zero vector is how a mesh has no inside.
                *inside = (way.value != Vector::ZERO).then_some(way.value);
                Ok(())
            }
            _ => self.inert(token, Place::shape(Word::Mesh)).unwrap_or(Ok(())),
        }
    }

    fn whole_mesh(
        &mut self,
        token: &Token,
        word: Word,
        triangles: Triangles,
        flaws: Flaws,
    ) -> Outcome<Solid> {
        self.stored += triangles.bytes();
        self.tell_of_flaws(token, word, triangles.faces.len(), flaws);
        Ok(Solid::Triangles { word, triangles: Arc::new(triangles) })
    }
}
