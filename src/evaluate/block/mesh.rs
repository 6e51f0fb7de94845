//! Triangles: alone, one after another in a `mesh`, as lists of vertices and faces in a `mesh2`.
//!
//! **Invariant:** a face that is a line or a point is told and left out; every index is that of an entry.

mod dress;
mod file;
mod lists;

pub(in crate::evaluate) use file::MeshFiles;

use std::collections::HashMap;
use std::sync::Arc;

use crate::diagnostic::{Code, Diagnostic};
use crate::math::Vector;
use crate::math::double::DoubleVector;
use crate::scene::Solid;
use crate::scene::mesh::{Face, Triangles};
use crate::source::Site;
use crate::vocabulary::Word;

use super::super::stream::{Token, TokenKind};
use super::super::{Evaluator, Outcome, Reported};
use super::{Given, Place};
use dress::{Dress, Textures};

/// Triangles as they are written one by one: equal vertices become one.
#[derive(Default)]
struct Gathered {
    triangles: Triangles,
    known: HashMap<[u64; 3], u32>,
    textures: Textures,
    degenerate: u32,
    first_degenerate: Option<Site>,
}

impl Gathered {
    fn add(&mut self, corners: [Vector; 3], normals: Option<[Vector; 3]>, dress: Dress) {
        if is_degenerate(corners) {
            self.degenerate += 1;
            return;
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
        let normals = normals.map(|all| {
            let first = self.triangles.normals.len() as u32;
            self.triangles.normals.extend(all);
            [first, first + 1, first + 2]
        });
        let uvs = dress.uvs.map(|all| {
            let first = self.triangles.uvs.len() as u32;
            self.triangles.uvs.extend(all);
            [first, first + 1, first + 2]
        });
        self.triangles.faces.push(Face { vertices, normals, paint: dress.paint, uvs });
    }
}

impl Evaluator<'_> {
    pub(super) fn triangle(&mut self, token: &Token) -> Outcome<Solid> {
        let corners = self.corners(token)?;
        self.lone_triangle(token, Word::Triangle, corners, None)
    }

    pub(super) fn smooth_triangle(&mut self, token: &Token) -> Outcome<Solid> {
        let (corners, normals) = self.smooth_corners(token)?;
        self.lone_triangle(token, Word::SmoothTriangle, corners, Some(normals))
    }

    fn lone_triangle(
        &mut self,
        token: &Token,
        word: Word,
        corners: [Given<Vector>; 3],
        normals: Option<[Vector; 3]>,
    ) -> Outcome<Solid> {
        let mut gathered = Gathered::default();
        gathered.add(corners.each_ref().map(|corner| corner.value), normals, Dress::default());
        if gathered.degenerate > 0 {
            let [first, .., last] = &corners;
            let diagnostic = Diagnostic::new(
                self.sizeless(),
                "a triangle whose corners lie in a line is nothing",
            )
            .at(last.span, "expected a corner beside the line through the other two")
            .also(first.span, "the first corner");
            self.nothing(token, &last.here, diagnostic)?;
        }
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

    fn smooth_corners(&mut self, token: &Token) -> Outcome<([Given<Vector>; 3], [Vector; 3])> {
        let mut corner = |name: &str| {
            let corner = self.vector_after(token, &format!("a vector for the {name} corner"));
            let normal = self.vector_after(token, &format!("a vector for the {name} normal"));
            Ok((corner?, normal?.value))
        };
        let (a, b, c) = (corner("first"), corner("second"), corner("third"));
        let ((a, m), (b, n), (c, o)) = (a?, b?, c?);
        Ok(([a, b, c], [m, n, o]))
    }

    /// `mesh { triangle { … } smooth_triangle { … } … inside_vector … }`, or `mesh { file "…" … }`.
    pub(super) fn mesh(&mut self, token: &Token) -> Outcome<Solid> {
        let mut gathered = Gathered::default();
        let mut from_file = None;
        let mut failed = false;
        loop {
            self.skip_commas();
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
        let Gathered { mut triangles, degenerate, first_degenerate, textures, .. } = gathered;
        triangles.textures = textures.into_list();
        match from_file {
            Some((file, read)) => self.mesh_of_file(token, &file, &read, triangles),
            None => self.whole_mesh(token, Word::Mesh, triangles, (degenerate, first_degenerate)),
        }
    }

    /// One triangle of a mesh. A texture of its own, and coordinates for one, it may have.
    fn mesh_triangle(&mut self, token: &Token, word: Word, all: &mut Gathered) -> Outcome<()> {
        self.block(token, word, |evaluator| {
            let (corners, normals) = match word {
                Word::SmoothTriangle => {
                    let (corners, normals) = evaluator.smooth_corners(token)?;
                    (corners, Some(normals))
                }
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
                    _ => {
                        evaluator.unexpected(&next, Place::shape(word));
                        return Err(Reported);
                    }
                }
            }
            let before = all.degenerate;
            all.add(corners.map(|corner| corner.value), normals, dress);
            if all.degenerate > before {
                all.first_degenerate.get_or_insert(token.here.site(token.span));
            }
            Ok(())
        })
    }

    /// `inside_vector` and `hierarchy`, which may stand among a mesh's parts.
    fn mesh_word(&mut self, token: &Token, word: Word, inside: &mut Option<Vector>) -> Outcome<()> {
        match word {
            Word::InsideVector => {
                let way = self.vector_after(token, "a vector for the way out")?;
                // None at all is how a mesh has no inside.
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
        degenerate: (u32, Option<Site>),
    ) -> Outcome<Solid> {
        self.stored += triangles.bytes();
        self.tell_of_degenerate(token, word, triangles.faces.len(), degenerate);
        Ok(Solid::Triangles { word, triangles: Arc::new(triangles) })
    }

    /// Says that a mesh has nothing to be seen, or less than was written.
    fn tell_of_degenerate(
        &mut self,
        token: &Token,
        word: Word,
        left: usize,
        (degenerate, first): (u32, Option<Site>),
    ) {
        if left == 0 && self.poison.is_none() {
            let message = format!("this `{}` has no triangle", word.name());
            let diagnostic = Diagnostic::new(Code::DegenerateShape, message)
                .at(token.span, "nothing is left of it");
            self.scene.sizeless.push((word.name(), token.here.site(token.span)));
            // Unless its triangles stand too late.
            self.owed = Some((token.here.clone(), diagnostic));
        } else if degenerate > 0 {
            let message = match degenerate {
                1 => "a triangle of this mesh is a line or a point".to_owned(),
                count => format!("{count} triangles of this mesh are lines or points"),
            };
            let site = first.unwrap_or(token.here.site(token.span));
            let diagnostic = Diagnostic::new(Code::DegenerateShape, message)
                .at(site.span, "left out: nothing of it could be seen");
            self.report_in(site.expansion, diagnostic);
        }
    }
}

/// Whether three corners lie in a line.
fn is_degenerate(corners: [Vector; 3]) -> bool {
    let [a, b, c] = corners.map(DoubleVector::from);
    (b - a).cross(c - a).is_zero()
}
