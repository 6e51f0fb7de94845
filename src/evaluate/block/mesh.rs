//! Triangles: alone, one after another in a `mesh`, as lists of vertices and faces in a `mesh2`.
//!
//! **Invariant:** a face that is a line or a point is told and left out; every index is that of an entry.

use std::collections::HashMap;
use std::sync::Arc;

use crate::diagnostic::{Code, Diagnostic};
use crate::math::Vector;
use crate::math::double::DoubleVector;
use crate::scene::Solid;
use crate::scene::mesh::{Face, Triangles};
use crate::vocabulary::Word;

use super::super::stream::{Token, TokenKind};
use super::super::value::{Poison, Value};
use super::super::{Evaluator, Outcome, Reported};
use super::{Given, Place};

/// Triangles as they are written one by one: equal vertices become one.
#[derive(Default)]
struct Gathered {
    triangles: Triangles,
    known: HashMap<[u64; 3], u32>,
    degenerate: u32,
}

impl Gathered {
    fn add(&mut self, corners: [Vector; 3], normals: Option<[Vector; 3]>) {
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
        self.triangles.faces.push(Face { vertices, normals });
    }
}

/// The lists of a `mesh2`, each with what it was opened by.
#[derive(Default)]
struct Lists {
    vertices: Option<(Token, Vec<Vector>)>,
    normals: Option<(Token, Vec<Vector>)>,
    uv_vectors: Option<(Token, Vec<Vector>)>,
    faces: Option<(Token, Vec<[f64; 3]>)>,
    face_normals: Option<(Token, Vec<[f64; 3]>)>,
    face_uv: Option<(Token, Vec<[f64; 3]>)>,
    inside: Option<Vector>,
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
        gathered.add(corners.each_ref().map(|corner| corner.value), normals);
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

    /// `mesh { triangle { … } smooth_triangle { … } … inside_vector … }`.
    pub(super) fn mesh(&mut self, token: &Token) -> Outcome<Solid> {
        let mut gathered = Gathered::default();
        let mut failed = false;
        loop {
            self.skip_commas();
            let Some(Token { kind: TokenKind::Word(word), .. }) = self.peek() else { break };
            let word = *word;
            let outcome = match word {
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
        let Gathered { triangles, degenerate, .. } = gathered;
        self.whole_mesh(token, Word::Mesh, triangles, degenerate)
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
            all.add(corners.map(|corner| corner.value), normals);
            while let Some(next) = evaluator.next() {
                match next.kind {
                    TokenKind::Comma => {}
                    TokenKind::Word(Word::UvVectors) => {
                        for name in ["first", "second", "third"] {
                            evaluator.uv_after(&next, name)?;
                        }
                    }
                    TokenKind::Word(word @ (Word::Texture | Word::TextureList)) => {
                        evaluator.not_per_face(&next, word);
                    }
                    _ => {
                        evaluator.unexpected(&next, Place::shape(word));
                        return Err(Reported);
                    }
                }
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

    /// A texture for one face is not built: told where the mesh is needed.
    fn not_per_face(&mut self, token: &Token, word: Word) {
        let site = token.here.site(token.span);
        self.skip_arguments(word);
        self.set_poison(Poison { word: Word::TextureList, site });
    }

    /// A point of a texture, of two numbers.
    pub(super) fn uv_after(&mut self, token: &Token, name: &str) -> Outcome<()> {
        let wanted = format!("a vector of two numbers for the {name} corner");
        let given = self.given(token, &wanted)?;
        match given.value.numbers() {
            Some(numbers) if numbers.len() <= 2 => Ok(()),
            _ => Err(self.wrong_type(&given.here, given.span, &wanted, &given.value)),
        }
    }

    /// `mesh2 { vertex_vectors { … } … face_indices { … } … }`.
    pub(super) fn mesh2(&mut self, token: &Token) -> Outcome<Solid> {
        let mut lists = Lists::default();
        let mut failed = false;
        loop {
            self.skip_commas();
            let Some(Token { kind: TokenKind::Word(word), .. }) = self.peek() else { break };
            let word = *word;
            let of_mesh2 = matches!(
                word,
                Word::VertexVectors
                    | Word::NormalVectors
                    | Word::UvVectors
                    | Word::TextureList
                    | Word::FaceIndices
                    | Word::NormalIndices
                    | Word::UvIndices
                    | Word::InsideVector
                    | Word::Hierarchy
            );
            if !of_mesh2 {
                break;
            }
            let Some(list) = self.next() else { break };
            failed |= self.mesh2_list(&list, word, &mut lists).is_err();
        }
        if failed || self.poison.is_some() {
            return Err(Reported);
        }
        let Lists { vertices, normals, uv_vectors, faces, face_normals, face_uv, inside } = lists;
        let missing = [
            vertices.is_none().then_some("vertex_vectors"),
            faces.is_none().then_some("face_indices"),
        ];
        let (Some((_, vertices)), Some((of_faces, faces))) = (vertices, faces) else {
            let missing: Vec<_> = missing.into_iter().flatten().collect();
            let message = format!("this mesh2 has no `{}`", missing.join("` and no `"));
            let diagnostic =
                Diagnostic::new(Code::MissingPart, message).at(token.span, Word::Mesh2.sentence());
            return Err(self.report(&token.here, diagnostic));
        };
        if let Some((of_uv, indices)) = face_uv {
            let count = uv_vectors.map_or(0, |(_, list)| list.len());
            self.as_indices(&of_uv, &indices, count, "uv_vectors")?;
        }
        let corners = self.as_indices(&of_faces, &faces, vertices.len(), "vertex_vectors")?;
        let smooth = match (normals, face_normals) {
            (None, None) => None,
            (Some((_, normals)), Some((of_indices, indices))) => {
                let indices =
                    self.as_indices(&of_indices, &indices, normals.len(), "normal_vectors")?;
                self.one_for_each(&of_indices, indices.len(), "face", corners.len())?;
                Some((normals, indices))
            }
            (Some((of_normals, normals)), None) => {
                self.one_for_each(&of_normals, normals.len(), "vertex", vertices.len())?;
                Some((normals, corners.clone()))
            }
            (None, Some((of_indices, _))) => {
                let message =
                    "this mesh2 has `normal_indices`, and no `normal_vectors` before them";
                let diagnostic = Diagnostic::new(Code::MissingPart, message)
                    .at(of_indices.span, "indices of nothing");
                return Err(self.report(&of_indices.here, diagnostic));
            }
        };
        let (normals, indices) = smooth.map_or((Vec::new(), None), |(n, i)| (n, Some(i)));
        let mut degenerate = 0;
        let faces = corners.into_iter().enumerate().filter_map(|(i, all)| {
            let flat = is_degenerate(all.map(|i| vertices[i as usize]));
            degenerate += u32::from(flat);
            let normals = indices.as_ref().map(|indices| indices[i]);
            (!flat).then_some(Face { vertices: all, normals })
        });
        let faces = faces.collect();
        let triangles = Triangles { vertices, normals, faces, inside };
        self.whole_mesh(token, Word::Mesh2, triangles, degenerate)
    }

    fn mesh2_list(&mut self, list: &Token, word: Word, lists: &mut Lists) -> Outcome<()> {
        let vectors = |all: Vec<[f64; 3]>| all.into_iter().map(Vector::from_array).collect();
        match word {
            Word::VertexVectors => {
                lists.vertices = Some((list.clone(), vectors(self.entries(list, word)?)));
            }
            Word::NormalVectors => {
                lists.normals = Some((list.clone(), vectors(self.entries(list, word)?)));
            }
            Word::UvVectors => {
                lists.uv_vectors = Some((list.clone(), vectors(self.entries(list, word)?)));
            }
            Word::FaceIndices if self.poison.is_some() => self.skip_arguments(word),
            Word::FaceIndices => {
                lists.faces = Some((list.clone(), self.entries(list, word)?));
            }
            Word::NormalIndices => {
                lists.face_normals = Some((list.clone(), self.entries(list, word)?));
            }
            Word::UvIndices => {
                lists.face_uv = Some((list.clone(), self.entries(list, word)?));
            }
            Word::TextureList => self.not_per_face(list, word),
            _ => return self.mesh_word(list, word, &mut lists.inside),
        }
        Ok(())
    }

    /// `{ count, <…>, <…>, … }`: that many vectors, each filled up with zeros to three numbers. There may
    /// be megabytes of them.
    fn entries(&mut self, list: &Token, word: Word) -> Outcome<Vec<[f64; 3]>> {
        let width = if word == Word::UvVectors { 2 } else { 3 };
        self.block(list, word, |evaluator| {
            let count = evaluator.number_after(list, "how many there are")?;
            // No more than memory could hold; a count that is none is told by what is missing.
            let wanted = count.value as u32 as usize;
            let mut entries: Vec<[f64; 3]> = Vec::new();
            while entries.len() < wanted {
                evaluator.take_run(width, wanted - entries.len(), &mut entries);
                if !evaluator.has_memory(size_of_val(&entries[..]) as u64) {
                    return Err(evaluator.too_much_memory(&list.here, list.span));
                }
                if entries.len() == wanted {
                    break;
                }
                let given = evaluator.given(list, &format!("{wanted} vectors"))?;
                entries.push(match given.value.numbers() {
                    Some(numbers) if matches!(given.value, Value::Vector(_)) => {
                        let mut entry = [0.0; 3];
                        let numbers = numbers.as_slice();
                        if numbers.len() > width {
                            let wanted = format!("a vector of {width} numbers");
                            let Given { value, span, here, .. } = &given;
                            return Err(evaluator.wrong_type(here, *span, &wanted, value));
                        }
                        entry[..numbers.len()].copy_from_slice(numbers);
                        entry
                    }
                    Some(numbers) if numbers.len() == 1 => [numbers.as_slice()[0]; 3],
                    _ => {
                        let Given { value, span, here, .. } = &given;
                        return Err(evaluator.wrong_type(here, *span, "a vector", value));
                    }
                });
            }
            evaluator.skip_commas();
            if let Some(next) = evaluator.next() {
                let message = format!("`{}` has more than {wanted} entries", word.name());
                let diagnostic = Diagnostic::new(Code::ExtraPart, message)
                    .at(next.span, "one too many")
                    .also(count.span, "so many were announced");
                return Err(evaluator.report(&next.here, diagnostic));
            }
            Ok(entries)
        })
    }

    /// Indices of a list of `count` entries; what follows the point of each is dropped, as in POV-Ray.
    fn as_indices(
        &mut self,
        list: &Token,
        indices: &[[f64; 3]],
        count: usize,
        of: &str,
    ) -> Outcome<Vec<[u32; 3]>> {
        let fits = |index: f64| index > -1.0 && index < count as f64;
        let stray = indices.iter().enumerate().find(|(_, all)| !all.iter().all(|&i| fits(i)));
        if let Some((face, &[a, b, c])) = stray {
            let message = format!("face {face}, `<{a}, {b}, {c}>`, is not of `{of}`");
            let label = match count {
                0 => format!("there are no `{of}`"),
                _ => format!("`{of}` has entries 0 to {}", count - 1),
            };
            let diagnostic = Diagnostic::new(Code::OutOfRange, message).at(list.span, label);
            return Err(self.report(&list.here, diagnostic));
        }
        Ok(indices.iter().map(|all| all.map(|index| index as u32)).collect())
    }

    fn one_for_each(&mut self, list: &Token, found: usize, what: &str, of: usize) -> Outcome<()> {
        if found == of {
            return Ok(());
        }
        let message = format!("{found} normals for {of} of what has one each: every {what}");
        let diagnostic = Diagnostic::new(Code::WrongArity, message)
            .at(list.span, format!("expected one for each {what}: {of}"));
        Err(self.report(&list.here, diagnostic))
    }

    fn whole_mesh(
        &mut self,
        token: &Token,
        word: Word,
        triangles: Triangles,
        degenerate: u32,
    ) -> Outcome<Solid> {
        self.stored += triangles.bytes();
        if triangles.faces.is_empty() && self.poison.is_none() {
            let message = format!("this `{}` has no triangle", word.name());
            let diagnostic = Diagnostic::new(Code::DegenerateShape, message)
                .at(token.span, "nothing is left of it");
            self.scene.sizeless.push((word.name(), token.here.site(token.span)));
            self.report(&token.here, diagnostic);
        } else if degenerate > 0 {
            let message = match degenerate {
                1 => "a triangle of this mesh is a line or a point".to_owned(),
                count => format!("{count} triangles of this mesh are lines or points"),
            };
            let diagnostic = Diagnostic::new(Code::DegenerateShape, message)
                .at(token.span, "left out: nothing of it could be seen");
            self.report(&token.here, diagnostic);
        }
        Ok(Solid::Triangles { word, triangles: Arc::new(triangles) })
    }
}

/// Whether three corners lie in a line.
fn is_degenerate(corners: [Vector; 3]) -> bool {
    let [a, b, c] = corners.map(DoubleVector::from);
    (b - a).cross(c - a).is_zero()
}
