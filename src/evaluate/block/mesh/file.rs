//! `mesh { file "bunny.ply" … }`: triangles from another program's file.
//!
//! **Invariant:** a file is read once, however often it is named, and the resulting data is shared.

use std::collections::HashMap;
use std::rc::Rc;
use std::sync::Arc;

use crate::color::Color;
use crate::diagnostic::{Code, Diagnostic};
use crate::mesh_file::{self, Fault, Model};
use crate::scene::mesh::Triangles;
use crate::scene::{Modifier, ModifierKind, Pigment, PigmentId, PigmentKind, Solid, Texture};
use crate::source::{FileError, FileId, Files, Site, Source, Span};
use crate::syntax::ast::ExpressionKind;
use crate::vocabulary::Word;

use super::super::super::include::missing_file;
use super::super::super::stream::{Token, TokenKind};
use super::super::super::{Evaluator, Here, Outcome, Reported};
use super::flaw::{Flawed, Flaws, is_degenerate};

/// Cache of meshes read from files.
#[derive(Debug, Default)]
pub(in crate::evaluate) struct MeshFiles {
    /// By the name in the scene, and the scene file that contains it.
    named: HashMap<(String, FileId), Rc<Read>>,
    /// By the name under which it was found.
    found: HashMap<String, Rc<Read>>,
    /// Copies with an `inside_vector`.
    solids: HashMap<(*const Triangles, [u64; 3]), Arc<Triangles>>,
    /// The colours of the mesh read last.
    painted: Option<(PigmentId, Site)>,
}

/// The contents of a mesh file.
#[derive(Debug)]
pub(super) struct Read {
    triangles: Arc<Triangles>,
    /// Set if the file has colours.
    pigment: Option<PigmentId>,
    degenerate: u32,
}

impl Evaluator<'_> {
    /// Reads `file "bunny.ply"`.
    pub(super) fn mesh_file(&mut self, token: &Token) -> Outcome<Rc<Read>> {
        let value = match self.peek() {
            Some(next @ Token { kind: TokenKind::Expression(_), .. }) => next.clone(),
            next => {
                let next = next.cloned();
                let otherwise = (&token.here, token.span);
                return Err(self.expected("the name of a file", next.as_ref(), otherwise));
            }
        };
        self.next();
        let TokenKind::Expression(id) = value.kind else { return Err(Reported) };
        let (here, span) = (&value.here, value.span);
        if let Some(reported) = self.unquoted(here, id) {
            return Err(reported);
        }
        // Paths keep their backslashes.
        let name = match here.unit.expression(id).kind {
            ExpressionKind::String => self.whole_string(span).ok_or(Reported)?,
            _ => self.string(here, id)?,
        };
        if let Some(read) = self.meshes.named.get(&(name.clone(), span.file)) {
            return Ok(read.clone());
        }
        if let Some((faulty, told)) = self.remembered.missing.get(&span)
            && *faulty == name
        {
            let told = told.clone();
            return Err(self.report_again(here, &told));
        }
        let read = self.read_mesh(here, &name, span).map_err(|told| {
            let Some(told) = told else { return Reported };
            let told = Rc::new(told);
            self.remembered.missing.insert(span, (name.clone(), told.clone()));
            self.report_again(here, &told)
        })?;
        self.meshes.named.insert((name, span.file), read.clone());
        Ok(read)
    }

    /// Reads the mesh in a file; returns what is wrong with it, unless that was reported.
    #[expect(clippy::result_large_err, reason = "an error is told once a file")]
    fn read_mesh(
        &mut self,
        here: &Here,
        name: &str,
        span: Span,
    ) -> Result<Rc<Read>, Option<Diagnostic>> {
        let files = self.files;
        let from = self.sources.get(span.file).name.clone();
        let found = files.read(name, &from);
        let found = found.map_err(|error| Some(missing_mesh(files, &from, name, span, error)))?;
        if let Some(read) = self.meshes.found.get(&found.name) {
            return Ok(read.clone());
        }
        // It is not scene text, so the sources hold only its name.
        self.sources.add(Source::new(found.name.clone(), ""));
        let mut beside = |other: &str| {
            let file = files.read(other, &found.name);
            file.map(|file| file.bytes).map_err(|error| match error {
                FileError::NotFound { .. } => "which is not found".to_owned(),
                FileError::Forbidden => {
                    "outside of the folders that `--sandbox` lets a scene read".to_owned()
                }
                FileError::Unreadable(reason) => format!("which cannot be read: {reason}"),
            })
        };
        let model = mesh_file::read(name, &found.bytes, &mut beside, self.memory_left());
        let Model { mut triangles, colors, lacks } = model.map_err(|fault| {
            if fault.is_too_large {
                self.too_much_memory(here, span);
                return None;
            }
            Some(malformed(name, span, &fault))
        })?;
        for lack in lacks {
            let message = format!("`{name}` is read without a part of it");
            self.report(here, Diagnostic::new(Code::IncompleteMesh, message).at(span, lack));
        }
        let before = triangles.faces.len();
        let Triangles { vertices, faces, .. } = &mut triangles;
        faces.retain(|face| !is_degenerate(face.vertices.map(|i| vertices[i as usize])));
        let degenerate = (before - faces.len()) as u32;
        self.stored += triangles.bytes();
        let pigment = (!colors.is_empty()).then(|| self.pigment_of_faces(colors, here.site(span)));
        let triangles = Arc::new(triangles);
        let read = Rc::new(Read { triangles, pigment, degenerate });
        self.meshes.found.insert(found.name, read.clone());
        Ok(read)
    }

    fn pigment_of_faces(&mut self, mut colors: Vec<Color>, site: Site) -> PigmentId {
        let gamma = self.scene.settings.assumed_gamma;
        for color in &mut colors {
            color.rgb = color.rgb.map(|light| gamma.of_light(light));
        }
        let clear = colors.iter().any(|color| color.is_clear()).then_some(site);
        self.add_pigment(Pigment {
            kind: PigmentKind::Faces(colors.into()),
            steps: Vec::new(),
            site,
            clear,
            has_own_colors: false,
            quick_color: None,
        })
    }

    /// Returns the solid for a `mesh` with a `file`. Reports triangles of its `own`, which may only
    /// contribute an `inside_vector`.
    pub(super) fn mesh_of_file(
        &mut self,
        token: &Token,
        file: &Token,
        read: &Read,
        own: Triangles,
    ) -> Outcome<Solid> {
        if !own.faces.is_empty() {
            let message = "this mesh has a `file`, and triangles beside it";
            let diagnostic = Diagnostic::new(Code::ExtraPart, message)
                .at(file.span, "a mesh is of a file, or of triangles")
                .help("a `union` holds two meshes");
            return Err(self.report(&token.here, diagnostic));
        }
        self.meshes.painted = read.pigment.map(|pigment| (pigment, file.here.site(file.span)));
        let degenerate = Flawed { count: read.degenerate, first: None };
        let flaws = Flaws { degenerate, ..Flaws::default() };
        self.tell_of_flaws(token, Word::Mesh, read.triangles.faces.len(), flaws);
        if read.triangles.faces.is_empty() && read.degenerate == 0 && self.poison.is_none() {
            let message = "the file of this mesh has no faces";
            let told = Diagnostic::new(Code::MissingPart, message)
                .at(file.span, "expected one at least")
                .help("points by themselves are not seen: export it with its faces");
            self.owed = Some((token.here.clone(), told));
        }
        let triangles = match own.inside {
            None => read.triangles.clone(),
            Some(way) => {
                let key = (Arc::as_ptr(&read.triangles), way.to_array().map(f64::to_bits));
                let inside = Some(way);
                let solid = || Arc::new(Triangles { inside, ..Triangles::clone(&read.triangles) });
                self.meshes.solids.entry(key).or_insert_with(solid).clone()
            }
        };
        Ok(Solid::Triangles { word: Word::Mesh, triangles })
    }

    /// Returns the texture from the file of the mesh read last, which precedes all modifiers.
    pub(in super::super) fn paint_of_file(&mut self) -> Option<Modifier> {
        let (pigment, site) = self.meshes.painted.take()?;
        let finish = self.scene.textures[self.default_texture.index()].kind.first_finish();
        let texture = self.add_texture(Texture::plain(pigment, finish));
        Some(Modifier { kind: ModifierKind::Texture(texture), site })
    }
}

/// Returns the diagnostic for a mesh file that does not exist, suggesting one with another extension.
fn missing_mesh(
    files: &dyn Files,
    from: &str,
    name: &str,
    span: Span,
    error: FileError,
) -> Diagnostic {
    let stem = if mesh_file::is_named(name) { name.rsplit_once('.') } else { None };
    let stem = stem.map_or(name, |(stem, _)| stem);
    let others = mesh_file::ENDINGS.iter().map(|ending| format!("{stem}.{ending}"));
    let mut there = others.filter(|other| files.read(other, from).is_ok());
    match (error, there.next(), there.next()) {
        (FileError::NotFound { searched, .. }, Some(one), None) => {
            let error = FileError::NotFound { searched, similar: vec![one] };
            missing_file(name, span, error, |_| true)
        }
        (FileError::NotFound { searched, .. }, Some(one), Some(other)) => {
            let error = FileError::NotFound { searched, similar: Vec::new() };
            let told = missing_file(name, span, error, |_| false);
            told.help(format!("did you mean `{one}`, or `{other}`?"))
        }
        (error, ..) => missing_file(name, span, error, mesh_file::is_named),
    }
}

fn malformed(name: &str, span: Span, fault: &Fault) -> Diagnostic {
    let Fault { file, place, reason, .. } = fault;
    let place = place.map_or(String::new(), |place| format!(", {place}"));
    let message = match file {
        None => format!("`{name}` is no mesh that can be read{place}: {reason}"),
        Some(other) => format!("`{other}`, which `{name}` names, cannot be read{place}: {reason}"),
    };
    Diagnostic::new(Code::MalformedMesh, message).at(span, "this file")
}
