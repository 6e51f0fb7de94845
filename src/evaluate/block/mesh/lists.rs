//! `mesh2`: lists of vertices, normals and faces.

use std::collections::BTreeSet;

use crate::diagnostic::{Code, Diagnostic};
use crate::math::Vector;
use crate::scene::mesh::{Face, Triangles};
use crate::scene::{Solid, TextureId};
use crate::source::Span;
use crate::vocabulary::{Dialect, Word};

use super::super::super::lint::is_literal;
use super::super::super::stream::Token;
use super::super::super::value::Value;
use super::super::super::{Evaluator, Here, Outcome, Reported};
use super::super::counted::entry_of;
use super::flaw::{Flawed, Flaws, is_degenerate};

/// Items of a `mesh2`.
const OF_MESH2: &[Word] = &[
    Word::VertexVectors,
    Word::NormalVectors,
    Word::UvVectors,
    Word::TextureList,
    Word::FaceIndices,
    Word::NormalIndices,
    Word::UvIndices,
    Word::InsideVector,
    Word::Hierarchy,
];

/// The lists of a `mesh2`, each with the token that opened it.
#[derive(Default)]
struct Lists {
    vertices: Option<(Token, Vec<Vector>)>,
    /// The announced number of vertices.
    announced: usize,
    normals: Option<(Token, Vec<Vector>)>,
    uv_vectors: Option<(Token, Vec<Vector>)>,
    textures: Vec<TextureId>,
    /// The texture list could not be read.
    textures_lost: bool,
    faces: Option<(Token, Vec<[f64; 3]>)>,
    /// The textures of each face, if there are any.
    paint: Vec<Option<[u32; 3]>>,
    face_normals: Option<(Token, Vec<[f64; 3]>)>,
    face_uv: Option<(Token, Vec<[f64; 3]>)>,
    inside: Option<Vector>,
}

impl Evaluator<'_> {
    /// Reads `mesh2 { vertex_vectors { … } … face_indices { … } … }`.
    pub(in super::super) fn mesh2(&mut self, token: &Token) -> Outcome<Solid> {
        if let Some(reported) = self.file_unworded(token, Word::Mesh2) {
            return Err(reported);
        }
        if self.is_other_mesh(token, Word::Mesh) {
            return self.mesh(token);
        }
        let mut lists = Lists::default();
        let mut failed = false;
        while let Some((list, word)) = self.next_part(Word::Mesh2, OF_MESH2) {
            failed |= self.mesh2_list(&list, word, &mut lists).is_err();
        }
        if failed || self.poison.is_some() {
            // Some vertices are missing: which faces are wrong beside that is certain all the same.
            if let (None, Some((of_faces, faces)), 1..) =
                (&lists.vertices, &lists.faces, lists.announced)
            {
                let _: Outcome<_> =
                    self.as_indices(of_faces, faces, lists.announced, "vertex_vectors");
            }
            if let (Some((_, vertices)), Some((of_faces, faces))) = (&lists.vertices, &lists.faces)
            {
                let _: Outcome<_> =
                    self.as_indices(of_faces, faces, vertices.len(), "vertex_vectors");
            }
            return Err(Reported);
        }
        let Lists { vertices, normals, uv_vectors, faces, face_normals, face_uv, .. } = lists;
        let Lists { textures, paint, inside, .. } = lists;
        let missing = [
            vertices.is_none().then_some("vertex_vectors"),
            faces.is_none().then_some("face_indices"),
        ];
        let (Some((of_vertices, vertices)), Some((of_faces, faces))) = (vertices, faces) else {
            let missing: Vec<_> = missing.into_iter().flatten().collect();
            let message = format!("this mesh2 has no `{}`", missing.join("` and no `"));
            let diagnostic =
                Diagnostic::new(Code::MissingPart, message).at(token.span, Word::Mesh2.sentence());
            // Unless they come too late.
            self.owed = Some((token.here.clone(), diagnostic));
            return Err(Reported);
        };
        self.expect_entries(&of_vertices, vertices.len(), "vertices")?;
        self.expect_entries(&of_faces, faces.len(), "faces")?;
        let is_pov = self.options.dialect == Dialect::Pov;
        // POV-Ray 3.7 ignores lists without an entry (measured).
        let is_said = |list: &(Token, Vec<Vector>)| !is_pov || !list.1.is_empty();
        let (normals, uv_vectors) =
            (normals.filter(is_said), uv_vectors.filter(|list| is_said(list) || face_uv.is_some()));
        let face_normals =
            face_normals.filter(|(_, all)| !is_pov || !all.is_empty() || normals.is_some());
        let of_normals = normals.as_ref().map(|(list, _)| list.clone());
        let corners = self.as_indices(&of_faces, &faces, vertices.len(), "vertex_vectors")?;
        let smooth = match (normals, face_normals) {
            (None, None) => None,
            (Some((_, normals)), Some((of_indices, indices))) => {
                let indices =
                    self.as_indices(&of_indices, &indices, normals.len(), "normal_vectors")?;
                // Faces without normals are flat, and come last.
                if indices.len() > corners.len() {
                    let found = (indices.len(), "normals");
                    self.one_for_each(&of_indices, found, ("face", corners.len()))?;
                }
                Some((normals, indices))
            }
            (Some((of_normals, normals)), None) => {
                let found = (normals.len(), "normals");
                self.one_for_each(&of_normals, found, ("vertex", vertices.len()))?;
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
        let places = match (uv_vectors, face_uv) {
            (None, None) => None,
            (uv_vectors, Some((of_indices, indices))) => {
                let uvs = uv_vectors.map_or(Vec::new(), |(_, uvs)| uvs);
                let indices = self.as_indices(&of_indices, &indices, uvs.len(), "uv_vectors")?;
                let found = (indices.len(), "places in a texture");
                self.one_for_each(&of_indices, found, ("face", corners.len()))?;
                Some((uvs, indices))
            }
            // One coordinate for all (measured).
            (Some((_, uvs)), None) if is_pov && uvs.len() == 1 => {
                Some((uvs, vec![[0; 3]; corners.len()]))
            }
            (Some((of_uvs, uvs)), None) => {
                let found = (uvs.len(), "places in a texture");
                self.one_for_each(&of_uvs, found, ("vertex", vertices.len()))?;
                Some((uvs, corners.clone()))
            }
        };
        let (normals, indices) = smooth.unwrap_or_default();
        let (uvs, places) = places.unwrap_or_default();
        let (mut degenerate, mut first) = (0, None);
        let count = corners.len();
        let faces = corners.into_iter().enumerate().filter_map(|(i, all)| {
            let flat = is_degenerate(all.map(|i| vertices[i as usize]));
            degenerate += u32::from(flat);
            if flat {
                first.get_or_insert(i);
            }
            let (normals, uvs) = (indices.get(i).copied(), places.get(i).copied());
            let paint = paint.get(i).copied().flatten();
            (!flat).then_some(Face { vertices: all, normals, paint, uvs })
        });
        let faces: Vec<Face> = faces.collect();
        // Those of omitted faces.
        let somewhere = |vertex: Vector| if vertex.is_finite() { vertex } else { Vector::ZERO };
        let vertices = vertices.into_iter().map(somewhere).collect();
        let first = first.and_then(|first| self.entry_in(&of_faces, count, first));
        let first = first.map(|first| of_faces.here.site(first));
        let flaws = Flaws {
            degenerate: Flawed { count: degenerate, first },
            aimless: self.aimless(of_normals.as_ref(), &normals, &faces),
        };
        let uvs = uvs.into_iter().map(|uv| [uv.x, uv.y]).collect();
        let triangles = Triangles { vertices, normals, uvs, faces, textures, inside };
        self.whole_mesh(token, Word::Mesh2, triangles, flaws)
    }

    /// Returns the normals of length 0 that faces use; unused ones may be anything.
    fn aimless(&self, list: Option<&Token>, normals: &[Vector], faces: &[Face]) -> Flawed {
        let used = faces.iter().filter_map(|face| face.normals).flatten();
        let zero = used.filter(|&i| normals[i as usize] == Vector::ZERO);
        let zero: BTreeSet<u32> = zero.collect();
        let first = zero.first().zip(list).map(|(&first, list)| {
            let entry = self.entry_in(list, normals.len(), first as usize);
            list.here.site(entry.unwrap_or(list.span))
        });
        Flawed { count: zero.len() as u32, first }
    }

    fn mesh2_list(&mut self, list: &Token, word: Word, lists: &mut Lists) -> Outcome<()> {
        let vectors = |all: Vec<[f64; 3]>| all.into_iter().map(Vector::from_array).collect();
        match word {
            Word::VertexVectors => {
                let all = self.entries(list, word, &mut lists.announced)?;
                lists.vertices = Some((list.clone(), vectors(all)));
            }
            Word::NormalVectors => {
                lists.normals = Some((list.clone(), vectors(self.entries(list, word, &mut 0)?)));
            }
            Word::UvVectors => {
                lists.uv_vectors = Some((list.clone(), vectors(self.entries(list, word, &mut 0)?)));
            }
            Word::FaceIndices if self.poison.is_some() || lists.textures_lost => {
                self.skip_arguments(word);
            }
            Word::FaceIndices if !lists.textures.is_empty() => {
                let (painted, told) = self.painted_faces(list, lists.textures.len())?;
                let (faces, paint) = painted.into_iter().unzip();
                (lists.faces, lists.paint) = (Some((list.clone(), faces)), paint);
                if told {
                    return Err(Reported);
                }
            }
            Word::FaceIndices => {
                lists.faces = Some((list.clone(), self.entries(list, word, &mut 0)?));
            }
            Word::NormalIndices => {
                lists.face_normals = Some((list.clone(), self.entries(list, word, &mut 0)?));
            }
            Word::UvIndices => {
                lists.face_uv = Some((list.clone(), self.entries(list, word, &mut 0)?));
            }
            Word::TextureList => {
                let textures = self.texture_list(list);
                lists.textures_lost = textures.is_err();
                let (textures, is_whole) = textures?;
                lists.textures = textures;
                return if is_whole { Ok(()) } else { Err(Reported) };
            }
            _ => return self.mesh_word(list, word, &mut lists.inside),
        }
        Ok(())
    }

    /// Reads `{ count, <…>, <…>, … }`: that many vectors, each padded with zeros to three numbers. The list
    /// may be megabytes long.
    fn entries(
        &mut self,
        list: &Token,
        word: Word,
        announced: &mut usize,
    ) -> Outcome<Vec<[f64; 3]>> {
        let width = if word == Word::UvVectors { 2 } else { 3 };
        self.block(list, word, |evaluator| {
            let name = word.name();
            let (before, label) =
                (format!("{name} {{ "), format!("`{name}` begins with how many follow"));
            if let Some(reported) = evaluator.uncounted(&before, label, "how many there are") {
                return Err(reported);
            }
            let count = evaluator.number_after(list, "how many there are")?;
            let wanted = evaluator.counted(&count);
            *announced = wanted;
            let what = entry_of(word);
            if let Some(reported) = evaluator.bare_entries(what, width, &count) {
                return Err(reported);
            }
            let mut entries: Vec<[f64; 3]> = Vec::new();
            while entries.len() < wanted {
                evaluator.take_run(width, wanted - entries.len(), &mut entries);
                if !evaluator.has_memory(size_of_val(&entries[..]) as u64) {
                    return Err(evaluator.too_much_memory(&list.here, list.span));
                }
                if entries.len() == wanted {
                    break;
                }
                evaluator.announced = Some((count.span, entries.len()));
                let given = evaluator.given(list, &format!("{wanted} vectors"));
                evaluator.announced = None;
                let given = given?;
                entries.push(match given.value.numbers() {
                    Some(numbers) if matches!(given.value, Value::Vector(_)) => {
                        let mut entry = [0.0; 3];
                        let numbers = numbers.as_slice();
                        if let (true, Some(id)) = (numbers.len() < width, given.expression) {
                            evaluator.tell_two_numbers(&given.here, id);
                        }
                        if numbers.len() > width {
                            return Err(evaluator.too_wide(&given, word, what, width));
                        }
                        entry[..numbers.len()].copy_from_slice(numbers);
                        entry
                    }
                    Some(numbers) if numbers.len() == 1 && word == Word::FaceIndices => {
                        let message = "this mesh2 has no `texture_list` before its faces";
                        let told = Diagnostic::new(Code::MissingPart, message)
                            .at(given.span, "expected a face: a number behind one is its texture");
                        return Err(evaluator.report(&given.here, told));
                    }
                    Some(numbers) if numbers.len() == 1 => [numbers.as_slice()[0]; 3],
                    _ => {
                        let (here, value) = (&given.here, &given.value);
                        return Err(evaluator.wrong_type(here, given.span, "a vector", value));
                    }
                });
            }
            evaluator.skip_commas();
            if let Some(next) = evaluator.next() {
                *announced = 0;
                return Err(evaluator.too_many(word, wanted, (&next.here, next.span), count.span));
            }
            Ok(entries)
        })
    }

    /// Reports entries after a list's announced end.
    pub(super) fn too_many(
        &mut self,
        list: Word,
        wanted: usize,
        (here, extra): (&Here, Span),
        count: Span,
    ) -> Reported {
        let message = format!(
            "`{}` has more than {wanted} {}",
            list.name(),
            if wanted == 1 { "entry" } else { "entries" }
        );
        let diagnostic = Diagnostic::new(Code::ExtraPart, message)
            .at(extra, "one too many")
            .also(count, "so many were announced");
        // Each entry has its vector, and a number may stand beside it.
        let rest = self.within_block().and_then(|block| {
            let rest = Span { start: extra.start, ..block.span };
            let inside = rest.file == extra.file && rest.start < rest.end;
            inside.then(|| self.sources.text(rest).matches('<').count())
        });
        let diagnostic = match rest {
            Some(more) if more > 0 && is_literal(self.sources.text(count)) => {
                let (found, text) = (wanted + more, self.sources.text(count));
                let help = format!("if these are all right, write `{found}` instead of `{text}`");
                diagnostic.help(help).fix(count, found.to_string())
            }
            _ => diagnostic,
        };
        self.report(here, diagnostic)
    }

    /// Converts numbers to indices into a list of `count` entries; fractions are truncated, as in POV-Ray.
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
            let stray = [a, b, c].iter().position(|&index| !fits(index)).unwrap_or(0);
            let index = [a, b, c][stray];
            let message = format!(
                "face {face}, `<{a}, {b}, {c}>`, uses entry {index} of `{of}`, which is not there"
            );
            let label = match count {
                0 => format!("there are no `{of}`"),
                _ => format!("`{of}` has entries 0 to {}", count - 1),
            };
            let place = self.place_in(list, indices.len(), face, stray).unwrap_or(list.span);
            let diagnostic = Diagnostic::new(Code::OutOfRange, message).at(place, label);
            let mut all = indices.iter().flatten();
            let from_one = count > 0 && all.all(|&index| index >= 1.0 && index <= count as f64);
            let diagnostic = match from_one {
                true => diagnostic.help("are they counted from 1? the first entry is 0"),
                false => diagnostic,
            };
            return Err(self.report(&list.here, diagnostic));
        }
        Ok(indices.iter().map(|all| all.map(|index| index as u32)).collect())
    }

    /// Returns the span of entry `entry` in a list of literal vectors.
    fn entry_in(&self, list: &Token, entries: usize, entry: usize) -> Option<Span> {
        let text = &self.sources.get(list.span.file).text;
        let rest = text.get(list.span.range().end..)?;
        let block = rest.get(..rest.find('}')?)?;
        if block.contains(['#', '/']) {
            return None;
        }
        let (open, length) = if block.matches('<').count() == entries {
            let (open, _) = block.match_indices('<').nth(entry)?;
            (open, block[open..].find('>')? + 1)
        } else {
            // `-z` may be among them: entries are separated by commas, after the count.
            let mut depth = 0;
            let parts = block.split(|c| {
                depth += i32::from(c == '<') - i32::from(c == '>');
                c == ',' && depth == 0
            });
            let parts: Vec<&str> = parts.collect();
            let part = parts.get(entry + 1).filter(|_| parts.len() == entries + 1)?;
            let before: usize = parts[..=entry].iter().map(|part| part.len() + 1).sum();
            (before + part.len() - part.trim_start().len(), part.trim().len())
        };
        let start = list.span.range().end + open;
        Some(Span::new(list.span.file, start, start + length))
    }

    /// Returns the span of number `part` of entry `entry`, likewise.
    fn place_in(&self, list: &Token, entries: usize, entry: usize, part: usize) -> Option<Span> {
        let entry = self.entry_in(list, entries, entry)?;
        let mut numbers = self.sources.text(entry).strip_prefix('<')?.strip_suffix('>')?.split(',');
        let before: usize = numbers.by_ref().take(part).map(|number| number.len() + 1).sum();
        let number = numbers.next()?;
        let blank = number.len() - number.trim_start().len();
        let start = entry.range().start + 1 + before + blank;
        Some(Span::new(entry.file, start, start + number.trim().len()))
    }
}
