//! `mesh_camera { rays distribution [max_distance] mesh { … } … [smooth] }`: a camera whose rays start on meshes.

use crate::diagnostic::{Code, Diagnostic};
use crate::scene::{Camera, CameraKind, Distribution, MeshCamera};
use crate::vocabulary::Word;

use super::super::stream::{Token, TokenKind};
use super::super::value::Value;
use super::super::{Evaluator, Outcome};
use super::{Given, Place};

/// Which words are valid in a `mesh_camera`.
const PLACE: Place = Place {
    word: Some(Word::MeshCamera),
    families: &[],
    others: &[Word::Mesh, Word::Mesh2, Word::Smooth],
};

/// The most rays of a pixel.
const MOST_RAYS: f64 = 1e6;

impl Evaluator<'_> {
    /// Reads the block of a `mesh_camera`.
    pub(super) fn mesh_camera(&mut self, token: &Token, camera: &mut Camera) -> Outcome<()> {
        let opener = token.clone();
        let read = self.block(token, Word::MeshCamera, |evaluator| {
            let rays = evaluator.number_after(&opener, "the number of rays of a pixel")?;
            if !(1.0..=MOST_RAYS).contains(&rays.value) {
                let message = format!("a pixel cannot have {} rays", rays.value);
                let diagnostic = Diagnostic::new(Code::OutOfRange, message)
                    .at(rays.span, "expected 1 or more")
                    .help(Word::MeshCamera.sentence().to_owned());
                return Err(evaluator.report(&rays.here, diagnostic));
            }
            let distribution = evaluator.distribution(&opener)?;
            let max_distance = match evaluator.is_before_value() {
                true => evaluator.number_after(&opener, "the greatest distance")?.value,
                false => 0.0,
            };
            let site = opener.here.site(opener.span);
            let (rays_given, rays) = (rays.clone(), rays.value as u32);
            let mut read = MeshCamera {
                rays,
                distribution,
                max_distance,
                meshes: Vec::new(),
                smooth: false,
                site,
            };
            while let Some(item) = evaluator.next() {
                match item.kind {
                    TokenKind::Word(word @ (Word::Mesh | Word::Mesh2)) => {
                        match evaluator.object(&item, word)? {
                            Value::Object(mesh) => read.meshes.push(mesh),
                            Value::Poison(poison) => evaluator.set_poison(poison),
                            _ => {}
                        }
                    }
                    TokenKind::Word(Word::Smooth) => evaluator.smooth_camera(&item, &mut read)?,
                    _ => evaluator.other_item(&item, PLACE)?,
                }
            }
            if evaluator.poison.is_none() {
                evaluator.meshes_suffice(&opener, &rays_given, &read)?;
            }
            Ok(read)
        })?;
        camera.kind = CameraKind::Mesh;
        camera.meshes = Some(read);
        Ok(())
    }

    fn distribution(&mut self, opener: &Token) -> Outcome<Distribution> {
        let given = self.number_after(opener, "the distribution, 0 to 3")?;
        let number = (given.value > -1.0).then_some(given.value as u32);
        number.and_then(Distribution::from_number).ok_or_else(|| {
            let message = format!("there is no distribution {}", given.value);
            let diagnostic = Diagnostic::new(Code::OutOfRange, message)
                .at(given.span, "expected 0, 1, 2 or 3")
                .help("0: a mesh for each ray of a pixel; 1: all meshes in turn; 2: meshes side by side; 3: by texture coordinates");
            self.report(&given.here, diagnostic)
        })
    }

    fn smooth_camera(&mut self, token: &Token, read: &mut MeshCamera) -> Outcome<()> {
        if read.distribution != Distribution::Unwrapped {
            let message = "`smooth` needs distribution 3";
            let diagnostic = Diagnostic::new(Code::ExtraPart, message)
                .at(token.span, "the rays of other distributions start in the middle of a face");
            return Err(self.report(&token.here, diagnostic));
        }
        read.smooth = true;
        Ok(())
    }

    /// Reports too few meshes, and too many rays.
    fn meshes_suffice(
        &mut self,
        opener: &Token,
        rays: &Given<f64>,
        read: &MeshCamera,
    ) -> Outcome<()> {
        if read.meshes.is_empty() {
            let diagnostic = Diagnostic::new(Code::MissingPart, "this `mesh_camera` has no mesh")
                .at(opener.span, "expected `mesh { … }` in it");
            return Err(self.report(&opener.here, diagnostic));
        }
        let (most, why) = match read.distribution {
            Distribution::Layers => (read.meshes.len(), "distribution 0 has a mesh for each ray"),
            Distribution::Sum => return Ok(()),
            _ => (1, "distributions 2 and 3 have one ray a pixel"),
        };
        if read.rays as usize <= most {
            return Ok(());
        }
        let message = format!("a pixel has {} rays, and may have {most}", read.rays);
        let diagnostic = Diagnostic::new(Code::OutOfRange, message)
            .at(rays.span, format!("expected {most} or fewer"))
            .help(why);
        Err(self.report(&rays.here, diagnostic))
    }
}
