//! Prints a Scene in readable form, for `lucarne show --stage scene`.
//!
//! **Invariant:** objects as written, children indented under their parents, modifiers in written order. A
//! shared child is shown in full once and by name afterwards, so the text exceeds the Scene only by its
//! indentation. The printer does not recurse: the nesting depth is unlimited.

mod camera;
mod haze;
mod texture;

use std::fmt::{self, Write};

use super::{
    Area, Beam, CameraItemKind, CameraKind, CylinderForm, Fade, Finish, Interior, Irid, LightKind,
    LightSource, Modifier, ModifierKind, ObjectId, ObjectKind, Scene, Settings, TextureId,
    TransformId,
};
use crate::color::{Clearness, Rgb};
use crate::math::transform::Step as TransformStep;
use crate::math::vector::written as vector;
use crate::source::Sources;

/// Levels deeper than this are not indented further.
const DEEPEST_INDENT: usize = 20;

/// The most steps printed of one transform.
const MOST_STEPS: usize = 1_000;

/// Returns the Scene as text, one item a line.
pub fn dump(scene: &Scene, sources: &Sources) -> String {
    let mut out = String::new();
    let mut printer = Printer { scene, sources, seen: vec![false; scene.objects.len()] };
    // Writing to a string cannot fail.
    let _ = printer.write(&mut out);
    out
}

struct Printer<'a> {
    scene: &'a Scene,
    sources: &'a Sources,
    seen: Vec<bool>,
}

impl Printer<'_> {
    fn write(&mut self, out: &mut String) -> fmt::Result {
        let settings = &self.scene.settings;
        writeln!(out, "global_settings")?;
        writeln!(out, "  ambient_light {}", settings.ambient_light)?;
        if settings.irid_wavelength != Settings::default().irid_wavelength {
            writeln!(out, "  irid_wavelength {}", settings.irid_wavelength)?;
        }
        writeln!(out, "  assumed_gamma {}", settings.assumed_gamma)?;
        if settings.clearness == Clearness::Old {
            writeln!(out, "  clear colours of versions below 3.7")?;
        }
        if settings.untinted_layers {
            writeln!(out, "  layers of versions up to 3.1")?;
        }
        writeln!(out, "  max_trace_level {}", settings.max_trace_level)?;
        writeln!(out, "  adc_bailout {}", settings.adc_bailout)?;
        self.cameras(out)?;
        if let Some(background) = &self.scene.background {
            writeln!(out, "background {}", background.color)?;
        }
        if let Some(sky) = &self.scene.sky_sphere {
            writeln!(out, "sky_sphere")?;
            for &id in &sky.pigments {
                self.pigment(out, id, "  ")?;
            }
            for &id in &sky.transforms {
                self.transform(out, id, "  ")?;
            }
            if sky.emission != Rgb::WHITE {
                writeln!(out, "  emission {}", sky.emission)?;
            }
        }
        self.fogs(out)?;
        self.rainbows(out)?;
        for root in &self.scene.roots {
            self.object(out, root.object)?;
        }
        let mut defaults: Vec<TextureId> =
            self.scene.roots.iter().map(|root| root.default_texture).collect();
        defaults.sort();
        defaults.dedup();
        for id in defaults {
            writeln!(out, "default texture {}", id.0)?;
            self.texture(out, id, "  ")?;
        }
        Ok(())
    }

    fn cameras(&self, out: &mut String) -> fmt::Result {
        for camera in &self.scene.cameras {
            let kind = match camera.kind {
                CameraKind::Perspective => "perspective",
                CameraKind::Orthographic => "orthographic",
                CameraKind::Fisheye => "fisheye",
                CameraKind::UltraWideAngle => "ultra_wide_angle",
                CameraKind::Omnimax => "omnimax",
                CameraKind::Panoramic => "panoramic",
                CameraKind::Cylinder(CylinderForm::Upright) => "cylinder 1",
                CameraKind::Cylinder(CylinderForm::Level) => "cylinder 2",
                CameraKind::Cylinder(CylinderForm::UprightMoving) => "cylinder 3",
                CameraKind::Cylinder(CylinderForm::LevelMoving) => "cylinder 4",
                CameraKind::Spherical => "spherical",
                CameraKind::Mesh => "mesh_camera",
            };
            writeln!(out, "camera {kind}  ({})", self.sources.place(camera.site.span))?;
            self.camera_meshes(out, camera)?;
            for item in &camera.items {
                match item.kind {
                    CameraItemKind::Location(v) => writeln!(out, "  location {}", vector(v))?,
                    CameraItemKind::LookAt(v) => writeln!(out, "  look_at {}", vector(v))?,
                    CameraItemKind::Sky(v) => writeln!(out, "  sky {}", vector(v))?,
                    CameraItemKind::Up(v) => writeln!(out, "  up {}", vector(v))?,
                    CameraItemKind::Right(v) => writeln!(out, "  right {}", vector(v))?,
                    CameraItemKind::Direction(v) => writeln!(out, "  direction {}", vector(v))?,
                    CameraItemKind::Angle(degrees) => writeln!(out, "  angle {degrees}")?,
                    CameraItemKind::VerticalAngle(degrees) => {
                        writeln!(out, "  angle {degrees} from bottom to top")?
                    }
                    CameraItemKind::Shift { x, y } => writeln!(out, "  shift <{x}, {y}>")?,
                    CameraItemKind::Aperture(width) => writeln!(out, "  aperture {width}")?,
                    CameraItemKind::BlurSamples(None, most) => {
                        writeln!(out, "  blur_samples {most}")?
                    }
                    CameraItemKind::BlurSamples(Some(least), most) => {
                        writeln!(out, "  blur_samples {least}, {most}")?
                    }
                    CameraItemKind::FocalPoint(v) => writeln!(out, "  focal_point {}", vector(v))?,
                    CameraItemKind::Confidence(n) => writeln!(out, "  confidence {n}")?,
                    CameraItemKind::Variance(n) => writeln!(out, "  variance {n}")?,
                    CameraItemKind::Bokeh(id) => {
                        writeln!(out, "  bokeh")?;
                        self.pigment(out, id, "    ")?;
                    }
                    CameraItemKind::Normal(id) => self.normal(out, id, "  ")?,
                    CameraItemKind::Orthographic => writeln!(out, "  orthographic, by `look_at`")?,
                    CameraItemKind::Transform(id) => self.transform(out, id, "  ")?,
                }
            }
        }
        Ok(())
    }

    /// Prints an object and its descendants, with an explicit stack.
    fn object(&mut self, out: &mut String, root: ObjectId) -> fmt::Result {
        enum Task {
            Open(ObjectId, usize),
            Modifiers(ObjectId, usize),
        }
        let mut stack = vec![Task::Open(root, 0)];
        while let Some(task) = stack.pop() {
            match task {
                Task::Open(id, depth) => {
                    let object = &self.scene.objects[id.index()];
                    let indent = "  ".repeat(depth.min(DEEPEST_INDENT));
                    write!(out, "{indent}{} ", id.0)?;
                    if std::mem::replace(&mut self.seen[id.index()], true) {
                        writeln!(out, "again")?;
                        continue;
                    }
                    let place = self.sources.place(object.site.span);
                    stack.push(Task::Modifiers(id, depth + 1));
                    match &object.kind {
                        ObjectKind::Solid(solid) => write!(out, "{solid}")?,
                        ObjectKind::Union(children) => {
                            write!(out, "union")?;
                            let children = children.iter().rev();
                            stack.extend(children.map(|&child| Task::Open(child, depth + 1)));
                        }
                        ObjectKind::Csg { operation, children } => {
                            write!(out, "{}", operation.word().name())?;
                            let children = children.iter().rev();
                            stack.extend(children.map(|&child| Task::Open(child, depth + 1)));
                        }
                        ObjectKind::Use(child) => {
                            write!(out, "object")?;
                            stack.push(Task::Open(*child, depth + 1));
                        }
                        ObjectKind::LightSource(source) => {
                            light(out, source)?;
                            let like = source.looks_like.iter().map(|one| one.object);
                            let through = source.projected_through.iter().map(|one| one.object);
                            let objects = like.chain(through);
                            stack.extend(objects.map(|object| Task::Open(object, depth + 1)));
                        }
                    }
                    writeln!(out, "  ({place})")?;
                }
                Task::Modifiers(id, depth) => {
                    let indent = "  ".repeat(depth.min(DEEPEST_INDENT));
                    for modifier in &self.scene.objects[id.index()].modifiers {
                        self.modifier(out, modifier, &indent)?;
                    }
                }
            }
        }
        Ok(())
    }

    fn modifier(&self, out: &mut String, modifier: &Modifier, indent: &str) -> fmt::Result {
        match modifier.kind {
            ModifierKind::Transform(id) => self.transform(out, id, indent),
            ModifierKind::Texture(id) => {
                writeln!(out, "{indent}texture {}", id.0)?;
                self.texture(out, id, &format!("{indent}  "))
            }
            ModifierKind::InteriorTexture(id) => {
                writeln!(out, "{indent}interior_texture {}", id.0)?;
                self.texture(out, id, &format!("{indent}  "))
            }
            ModifierKind::Pigment(id) => self.pigment(out, id, indent),
            ModifierKind::Normal(id) => self.normal(out, id, indent),
            ModifierKind::Finish(id) => self.finish(out, &self.scene.finishes[id.index()], indent),
            ModifierKind::Interior(id) => {
                let interior = &self.scene.interiors[id.index()];
                write!(out, "{indent}interior ior {}", interior.ior)?;
                if interior.fade_distance != 0.0 {
                    let Interior { fade_distance, fade_power, fade_color, .. } = interior;
                    write!(out, " fade_distance {fade_distance} fade_power {fade_power}")?;
                    write!(out, " fade_color {fade_color}")?;
                }
                if interior.dispersion != 1.0 {
                    let Interior { dispersion, dispersion_samples, .. } = interior;
                    write!(
                        out,
                        " dispersion {dispersion} dispersion_samples {dispersion_samples}"
                    )?;
                }
                if let Some(caustics) = interior.caustics {
                    write!(out, " caustics {caustics}")?;
                }
                writeln!(out)
            }
            ModifierKind::NoShadow => writeln!(out, "{indent}no_shadow"),
            ModifierKind::NoImage(on) => writeln!(out, "{indent}no_image{}", off(on)),
            ModifierKind::NoReflection(on) => writeln!(out, "{indent}no_reflection{}", off(on)),
            ModifierKind::DoubleIlluminate(on) => {
                writeln!(out, "{indent}double_illuminate{}", off(on))
            }
            ModifierKind::LightGroup(global) => {
                writeln!(out, "{indent}light_group{}", if global { " global_lights" } else { "" })
            }
            ModifierKind::Hollow(on) => writeln!(out, "{indent}hollow{}", off(on)),
            ModifierKind::CutawayTextures => writeln!(out, "{indent}cutaway_textures"),
            ModifierKind::Inverse => writeln!(out, "{indent}inverse"),
            ModifierKind::ClippedBy(id) => writeln!(out, "{indent}clipped_by {}", id.0),
        }
    }

    fn finish(&self, out: &mut String, finish: &Finish, indent: &str) -> fmt::Result {
        match finish {
            Finish::Seed { kd, ks, phong_exponent } => {
                writeln!(out, "{indent}finish kd {kd} ks {ks} phong_exponent {phong_exponent}")
            }
            Finish::Classic(f) => {
                write!(out, "{indent}finish ambient {}", f.ambient)?;
                if !f.emission.is_black() {
                    write!(out, " emission {}", f.emission)?;
                }
                write!(out, " diffuse {}", f.diffuse)?;
                if f.behind != 0.0 {
                    write!(out, ", {}", f.behind)?;
                }
                write!(out, " brilliance {}", f.brilliance)?;
                write!(out, " phong {} phong_size {}", f.phong, f.phong_size)?;
                write!(out, " specular {} roughness {}", f.specular, f.roughness)?;
                write!(out, " metallic {}", f.metallic)?;
                if let Some(r) = &f.reflection {
                    let (low, high) = (r.minimum, r.maximum);
                    write!(out, " reflection {low} to {high}")?;
                    match r.fresnel {
                        true => write!(out, " fresnel")?,
                        false => write!(out, " falloff {}", r.falloff)?,
                    }
                    write!(out, " exponent {} metallic {}", r.exponent, r.metallic)?;
                }
                if f.conserve_energy {
                    write!(out, " conserve_energy")?;
                }
                if let Some(ior) = f.ior {
                    write!(out, " ior {ior}")?;
                }
                if let Some(caustics) = f.caustics {
                    write!(out, " caustics {caustics}")?;
                }
                if f.crand != 0.0 {
                    write!(out, " crand {}", f.crand)?;
                }
                if let Some(Irid { amount, thickness, turbulence, .. }) = f.irid.as_deref() {
                    write!(out, " irid {amount} thickness {thickness} turbulence {turbulence}")?;
                }
                if f.refraction != 1.0 {
                    write!(out, " refraction {}", f.refraction)?;
                }
                writeln!(out)
            }
        }
    }

    fn transform(&self, out: &mut String, id: TransformId, indent: &str) -> fmt::Result {
        // A list contained twice in another is printed twice, and so on.
        let mut left = MOST_STEPS;
        let steps = |id: TransformId, depth| {
            self.scene.transforms[id.index()].iter().rev().map(move |step| (Some(*step), depth))
        };
        let mut stack: Vec<(Option<TransformStep>, usize)> = steps(id, 0).collect();
        while let Some((step, depth)) = stack.pop() {
            if left == 0 {
                return writeln!(out, "{indent}…");
            }
            left -= 1;
            if let Some(TransformStep::Transform(id)) = step {
                stack.extend(steps(id, depth));
                continue;
            }
            write!(out, "{indent}{}", "  ".repeat(depth.min(DEEPEST_INDENT)))?;
            match step {
                None => writeln!(out, "nothing")?,
                Some(TransformStep::Translate(v)) => writeln!(out, "translate {}", vector(v))?,
                Some(TransformStep::Scale(v)) => writeln!(out, "scale {}", vector(v))?,
                Some(TransformStep::Rotate(v)) => writeln!(out, "rotate {}", vector(v))?,
                Some(TransformStep::Matrix(rows)) => {
                    let numbers: Vec<String> =
                        rows.iter().flat_map(|v| [v.x, v.y, v.z]).map(|n| n.to_string()).collect();
                    writeln!(out, "matrix <{}>", numbers.join(", "))?;
                }
                Some(TransformStep::Transform(_)) => {}
                Some(TransformStep::InverseOf(id)) => {
                    writeln!(out, "inverse of")?;
                    if self.scene.transforms[id.index()].is_empty() {
                        stack.push((None, depth + 1));
                    }
                    stack.extend(steps(id, depth + 1));
                }
            }
        }
        Ok(())
    }
}

/// Returns the text after a flag that is not set.
fn off(on: bool) -> &'static str {
    if on { "" } else { " off" }
}

fn write_beam(out: &mut String, beam: Beam) -> fmt::Result {
    let Beam { radius, falloff, tightness } = beam;
    write!(out, " radius {radius} falloff {falloff} tightness {tightness}")
}

fn light(out: &mut String, source: &LightSource) -> fmt::Result {
    write!(out, "light_source ")?;
    match source.kind {
        LightKind::Point { location } => write!(out, "{}", vector(location))?,
        LightKind::Parallel { location, point_at, beam } => {
            write!(out, "{} parallel point_at {}", vector(location), vector(point_at))?;
            if let Some(beam) = beam {
                write!(out, " spotlight")?;
                write_beam(out, beam)?;
            }
        }
        LightKind::Direction { to_light } => write!(out, "direction {}", vector(to_light))?,
        LightKind::Spotlight { location, point_at, beam } => {
            write!(out, "{} spotlight point_at {}", vector(location), vector(point_at))?;
            write_beam(out, beam)?;
        }
        LightKind::Cylinder { location, point_at, beam } => {
            write!(out, "{} cylinder point_at {}", vector(location), vector(point_at))?;
            write_beam(out, beam)?;
        }
    }
    if let Some(Fade { distance, power }) = source.fade {
        write!(out, " fade_distance {distance} fade_power {power}")?;
    }
    area(out, &source.area)?;
    write!(out, " color {}", source.color)?;
    if source.shadowless {
        write!(out, " shadowless")?;
    }
    if source.media_site.is_some() {
        write!(out, " media_attenuation")?;
    }
    if !source.media_interaction {
        write!(out, " media_interaction off")?;
    }
    Ok(())
}

fn area(out: &mut String, area: &Area) -> fmt::Result {
    let Area { sides: [a, b], nodes: [m, n], .. } = *area;
    if [m, n] != [1, 1] {
        write!(out, " area_light {} {} {m} {n}", vector(a), vector(b))?;
    }
    if let Some(adaptive) = area.adaptive {
        write!(out, " adaptive {adaptive}")?;
    }
    let words = [
        (area.jitter, "jitter"),
        (area.circular, "circular"),
        (area.orient, "orient"),
        (area.illuminates, "area_illumination"),
    ];
    for (_, word) in words.into_iter().filter(|(is, _)| *is) {
        write!(out, " {word}")?;
    }
    Ok(())
}
