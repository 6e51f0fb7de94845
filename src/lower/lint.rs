//! Lints the scene as a whole.
//!
//! **Invariant:** reports only what is certain. After a fault of another object, only lints of single objects
//! remain; after a fault of the camera, all but those about its view; in a scene read with errors, those that
//! no missing part could change.

use std::cmp::Ordering;

use super::{Fault, Lowering};
use crate::color::Rgb;
use crate::diagnostic::{Code, Diagnostic};
use crate::scene::{CameraItemKind, Object, ObjectKind, Root};
use crate::shape::Body;
use crate::shape::isosurface::Nowhere;
use crate::source::{Site, Span};
use crate::world::{CameraKind, Plain};

/// The default ambient of a white surface: enough to distinguish shapes from black, and no more.
pub(super) const DEFAULT_AMBIENT: f64 = 0.1;
/// The rounding error allowed in a sum of two decimals.
const ROUNDING: f64 = 1e-9;
/// The most similar locations that are named.
const MOST_NAMED: usize = 8;
/// How far a pixel may be from square, relative: POV-Ray's own `right 1.33*x` means 4:3.
const NEARLY_SQUARE: f64 = 0.01;

impl Lowering<'_, '_> {
    pub(super) fn lint(&mut self) {
        // A missing part may be one that an error kept from being read.
        if !self.is_sound {
            // A file that includes itself contains its camera twice.
            let mut spans: Vec<_> = self.scene.cameras.iter().map(|one| one.site.span).collect();
            spans.dedup();
            if spans.len() == self.scene.cameras.len() {
                self.lint_second_camera();
            }
            let is_lit = self.options.lights_known && !self.world.lights.is_empty();
            if is_lit && !self.is_blind && !self.lacks_parts() {
                self.lint_inside();
            }
            return;
        }
        let is_error = |told: &&Diagnostic| told.is_error();
        let errors = self.reporter.diagnostics.iter().filter(is_error).count();
        // A camera that cannot be built affects only the lints about its view.
        let is_whole = errors == usize::from(self.is_blind);
        if is_whole {
            self.lint_cameras();
        }
        if is_whole && !self.is_blind {
            self.lint_picture_shape();
        }
        self.lint_clear();
        if is_whole {
            self.lint_whole();
        } else {
            self.lint_pigment();
        }
    }

    /// Returns whether an error may have left an operation with one part of several.
    fn lacks_parts(&self) -> bool {
        self.scene.objects.iter().any(
            |object| matches!(&object.kind, ObjectKind::Csg { children, .. } if children.len() < 2),
        )
    }

    /// Runs the lints that need the complete scene.
    fn lint_whole(&mut self) {
        self.lint_emptied();
        let is_telescope = !self.is_blind && self.lint_angle();
        let world = &self.world;
        let empty_sky = world.sky.is_none() && world.background.is_black() && !world.has_haze();
        if world.objects.is_empty() {
            return self.lint_empty(empty_sky);
        }
        let is_dark = world.lights.is_empty() && empty_sky && !self.glows();
        if is_dark {
            self.lint_unlit();
            // Without a camera as well, the author is probably trying out a shape.
            if self.origins.camera.is_none() {
                return;
            }
        }
        if !self.is_blind {
            // In a scene without light, that is why it is dark inside.
            if !is_telescope && (is_dark || !self.lint_inside()) {
                self.lint_view();
            }
            self.lint_far();
            self.lint_enclosed();
        }
        self.lint_pigment();
    }

    /// Lints a missing camera, or more than one.
    fn lint_cameras(&mut self) {
        let cameras = &self.scene.cameras;
        // A camera that is only declared was reported before.
        if cameras.is_empty() && !self.scene.unused.iter().any(|unused| unused.is_camera) {
            let message = "the scene has no camera; it is seen from <0, 0, 0>";
            let help = "a camera such as `camera { location <0, 1, 5> look_at <0, 1, 0> }`";
            self.reporter.diagnostics.push(Diagnostic::new(Code::NoCamera, message).help(help));
        }
        self.lint_second_camera();
    }

    fn lint_second_camera(&mut self) {
        let cameras = &self.scene.cameras;
        if let [ignored @ .., last] = cameras.as_slice()
            && !ignored.is_empty()
        {
            let count = cameras.len();
            let message = format!("the scene has {count} cameras; the last one is used");
            let told = Diagnostic::new(Code::DuplicateCamera, message)
                .at(last.site.span, "the picture is seen from this one")
                .help("keep one; or `#declare` them, and choose with `camera { Name }`");
            let mut places: Vec<Span> = ignored.iter().map(|camera| camera.site.span).collect();
            places.dedup();
            let places = places.into_iter().take(MOST_NAMED);
            let told = places.fold(told, |told, place| told.also(place, "this one is not used"));
            let told = told.traced(last.site, self.reporter.expansions);
            self.reporter.diagnostics.push(told);
        }
    }

    /// Lints a scene without objects.
    fn lint_empty(&mut self, empty_sky: bool) {
        if self.tells_why_empty() {
            return;
        }
        let told = |message: &str| Diagnostic::new(Code::EmptyScene, message);
        let has_lights = !self.world.lights.is_empty() && self.origins.dropped.is_empty();
        let told = match self.only_declared() {
            _ if empty_sky => told("the scene shows nothing: no object, no background, no sky"),
            Some(declared) => {
                let object = declared.site;
                let before = |site: &Site| {
                    site.span.file == object.span.file && site.span.start < object.span.start
                };
                let names = self.scene.unused.iter().map(|one| one.site).filter(before);
                let site = names.max_by_key(|site| site.span.start).unwrap_or(object);
                told("the scene shows no object: what is declared is never placed in it")
                    .at(site.span, "declared, and not placed")
                    .help("place it: `object { Name }`")
                    .traced(site, self.reporter.expansions)
            }
            None if has_lights => told("the scene has no object: its lights shine on nothing"),
            None => return,
        };
        let told = match self.scene.sizeless.as_slice() {
            [] => told,
            [(word, first), others @ ..] => {
                let label = match others.len() {
                    0 => format!("this `{word}` has no size, and is left out"),
                    more => format!("this `{word}` has no size, and is left out, like {more} more"),
                };
                told.at(first.span, label).traced(*first, self.reporter.expansions)
            }
        };
        self.reporter.diagnostics.push(told);
    }

    /// Reports a shape that is empty or invisible, under its keyword; returns `false` if it is proven empty.
    pub(super) fn is_somewhere(&mut self, body: &Body, word: &str, site: Site) -> bool {
        let nothing = format!("there is nothing of this {word}");
        let (message, label, is_proven) = match body {
            Body::Isosurface(surface) => match surface.nowhere() {
                None => return true,
                Some(Nowhere::Above) => {
                    let threshold = surface.threshold;
                    let label = "in all of its container its function is above its threshold, ";
                    (nothing, format!("{label}{threshold}"), true)
                }
                Some(Nowhere::NoNumber(places)) => {
                    let label = "its function is no number at any of ";
                    (nothing, format!("{label}{places} places in its container"), false)
                }
            },
            Body::Algebraic(surface) => match surface.everywhere() {
                Some(Ordering::Greater) => {
                    let label = "its polynomial is above 0 everywhere, so that nothing is inside";
                    (nothing, label.to_owned(), true)
                }
                Some(Ordering::Less) => {
                    let label = "its polynomial is below 0 everywhere: all of space is inside";
                    (format!("this {word} has no surface"), label.to_owned(), false)
                }
                _ => return true,
            },
            Body::JuliaFractal(fractal) if fractal.is_beyond() => {
                let (distance, radius) = (fractal.distance.abs(), fractal.radius());
                let label =
                    format!("its slice is {distance} from 0, and all of it within {radius:.3}");
                (nothing, label, true)
            }
            Body::Parametric(surface) if surface.is_outside() => {
                (nothing, "all of its points lie outside of its container".to_owned(), true)
            }
            _ => return true,
        };
        self.reporter.fault(Fault::new(Code::DegenerateShape, message).label(label), site);
        !is_proven
    }

    /// Returns the last object of a scene that places only lights.
    fn only_declared(&self) -> Option<&Object> {
        let is_light = |object: &Object| matches!(object.kind, ObjectKind::LightSource(_));
        let objects = &self.scene.objects;
        let placed = |root: &Root| !is_light(&objects[root.object.index()]);
        match self.scene.roots.iter().any(placed) {
            true => None,
            false => objects.iter().rfind(|object| !is_light(object)),
        }
    }

    /// Returns whether an unplaced object or an uncalled macro was reported, which explains an empty scene.
    fn tells_why_empty(&self) -> bool {
        let macros = self.scene.unused.iter().filter(|one| one.directive == "macro");
        let macros: Vec<_> = macros.map(|one| one.site.span).collect();
        self.reporter.diagnostics.iter().any(|told| match told.code {
            Code::NeverPlaced => true,
            Code::UnusedDeclaration => {
                told.primary().is_some_and(|label| macros.contains(&label.span))
            }
            _ => false,
        })
    }

    /// Lints objects that are black because nothing gives them a colour.
    fn lint_pigment(&mut self) {
        let mut sites = std::mem::take(&mut self.unpainted);
        sites.sort_by_key(|site| site.span);
        sites.dedup_by_key(|site| site.span);
        sites.retain(|site| !self.reporter.diagnostics.allows(Code::NoPigment, site.span));
        let Some((&first, others)) = sites.split_first() else { return };
        let message = match others.len() {
            0 => "this object has no pigment, and is black".to_owned(),
            n => format!("{} objects have no pigment, and are black", n + 1),
        };
        let mut diagnostic = Diagnostic::new(Code::NoPigment, message)
            .at(first.span, "this one has none, nor does what holds it")
            .help("write `pigment { rgb 1 }` in it, or `#default { pigment { rgb 1 } }` before it");
        for other in others.iter().take(2) {
            diagnostic = diagnostic.also(other.span, "nor does this one");
        }
        self.reporter.diagnostics.push(diagnostic.traced(first, self.reporter.expansions));
    }

    /// Lints a picture whose proportions differ from the camera's, so that it looks squashed.
    fn lint_picture_shape(&mut self) {
        let (Some((width, height)), Some(camera)) =
            (self.options.picture, self.scene.cameras.last())
        else {
            return;
        };
        use CameraKind::{Cylinder, Mesh, Panoramic, Spherical};
        // Their screens have no proportion: sides are angles, or an angle and a length.
        if matches!(self.world.camera.kind, Mesh | Panoramic | Cylinder { .. } | Spherical { .. }) {
            return;
        }
        let (width, height) = (f64::from(width), f64::from(height));
        let seen = self.world.camera.right.length() / self.world.camera.up.length();
        // Rounding to whole pixels is off by half a pixel at most.
        let off = (width - seen * height).abs();
        // Infinite sides have no proportion: NaN is not reported.
        let is_off = off > NEARLY_SQUARE * width && off > seen.max(1.0);
        if !is_off {
            return;
        }
        let (picture, seen) = (proportion(width / height), proportion(seen));
        let message = format!("the picture is {picture}, the camera {seen}: pixels are not square");
        let right = camera.items.iter().rev().find(|i| matches!(i.kind, CameraItemKind::Right(_)));
        let site = right.map_or(camera.site, |right| right.site);
        let diagnostic = Diagnostic::new(Code::PictureShape, message)
            .at(site.span, format!("this camera sees {seen}"))
            .help("write `right image_width/image_height*x` in `camera`")
            .traced(site, self.reporter.expansions);
        self.reporter.diagnostics.push(diagnostic);
    }

    /// Lints colours that let through more light than enters, and `fresnel` without an index of refraction.
    fn lint_clear(&mut self) {
        let (world, origins) = (&self.world, &self.origins);
        let origin = |i: usize| origins.textures.get(i);
        let mut lints: Vec<(Site, Diagnostic)> = Vec::new();
        for (i, texture) in world.textures.iter().enumerate() {
            let Some(site) = origin(i).and_then(|origin| origin.pigment) else { continue };
            let mut most = 0.0_f64;
            texture.for_each_color(&mut |color| most = most.max(color.filter + color.transmit));
            if most > 1.0 + ROUNDING && !self.is_percentage(site) {
                let message = format!("`filter` and `transmit` of this pigment come to {most:.3}");
                let diagnostic = Diagnostic::new(Code::TooClear, message)
                    .at(site.span, "it would let more through than comes in")
                    .help("let the two come to 1 at most");
                lints.push((site, diagnostic));
            }
        }
        for (object, site) in world.objects.iter().zip(&origins.objects) {
            let index = object.texture as usize;
            let fresnel =
                |plain: &Plain| plain.finish.reflection.as_ref().is_some_and(|r| r.fresnel);
            if object.interior.is_none() && world.textures[index].any(fresnel) {
                let site = origin(index).and_then(|origin| origin.finish).unwrap_or(*site);
                let message =
                    "`fresnel` goes by the `ior` of an interior, and this object has none";
                let diagnostic = Diagnostic::new(Code::FresnelWithoutIor, message)
                    .at(site.span, "it reflects its `minimum` at every angle")
                    .help("write `interior { ior 1.5 }` beside the texture, for glass");
                lints.push((site, diagnostic));
            }
        }
        lints.sort_by_key(|(site, diagnostic)| (diagnostic.code, site.span));
        lints.dedup_by_key(|(site, diagnostic)| (diagnostic.code, site.span));
        for (site, diagnostic) in lints {
            self.reporter.diagnostics.push(diagnostic.traced(site, self.reporter.expansions));
        }
    }

    /// Returns whether part of what makes the pigment at `site` clear was already reported as a percentage.
    fn is_percentage(&self, site: Site) -> bool {
        let told = self.reporter.diagnostics.iter();
        let told = told.filter(|one| one.code == Code::SuspiciousUnit);
        let mut places = told.filter_map(|one| Some(one.primary()?.span));
        let pigments = self.scene.pigments.iter().filter(|pigment| pigment.site == site);
        let clear: Vec<Site> = pigments.filter_map(|pigment| pigment.clear).collect();
        places.any(|span| {
            clear.iter().any(|piece| {
                piece.span.file == span.file
                    && piece.span.start <= span.start
                    && span.end <= piece.span.end
            })
        })
    }

    /// Returns whether any surface emits more than the default ambient without a light.
    pub(super) fn glows(&self) -> bool {
        self.world.textures.iter().flat_map(|texture| texture.plains()).any(|plain| {
            let bright = |color: Rgb| (color * plain.finish.emission).largest() > DEFAULT_AMBIENT;
            let mut found = false;
            plain.pigment.for_each_color(&mut |color| found |= bright(color.rgb));
            found
        })
    }
}

/// Returns width to height in the usual notation: `4:3`, `16:9`, `2.39:1`.
fn proportion(ratio: f64) -> String {
    let (long, wide) = if ratio >= 1.0 { (ratio, true) } else { (1.0 / ratio, false) };
    let near = |short: &f64| (long * short - (long * short).round()).abs() <= 0.003 * long * short;
    let (long, short) = match (1..=10).map(f64::from).find(near) {
        Some(short) => (format!("{}", (long * short).round()), format!("{short}")),
        None => (format!("{long:.2}"), "1".to_owned()),
    };
    if wide { format!("{long}:{short}") } else { format!("{short}:{long}") }
}

#[cfg(test)]
mod tests {
    use super::proportion;

    #[test]
    fn proportions_are_small_whole_numbers_where_they_can_be() {
        for (ratio, text) in [
            (4.0, "4:1"),
            (4.0 / 3.0, "4:3"),
            (1.33, "4:3"),
            (0.5625, "9:16"),
            (1366.0 / 768.0, "16:9"),
            (1.0, "1:1"),
            (1.0 / 2.39, "1:2.39"),
        ] {
            assert_eq!(proportion(ratio), text);
        }
    }
}
