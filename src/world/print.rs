//! Prints a World in readable form, for `lucarne show --stage world`.
//!
//! **Invariant:** prints every number of the World, each in the shortest form that reads back to the same
//! bits; an object comes with its shape, a box with the numbers of each face.

mod texture;

use std::fmt::{self, Write};

use super::{
    Absorption, Area, Attenuation, Backdrop, Beam, CameraKind, Churn, Coat, CsgSolid, Cutaway,
    Dispersion, Fade, Focus, Ground, LightKind, Object, Origins, Rainbow, World,
};
use crate::color::{Clearness, Rgb};
use crate::math::placement::{Map, Placement};
use crate::math::vector::written as vector;
use crate::math::{Matrix, UnitVector};
use crate::shape::csg::Node;
use crate::shape::local::Local;
use crate::shape::{Box_, Shape, uv};
use crate::source::{Site, Sources};

/// Returns the World as text, one part a line, each followed by its origin.
pub fn dump(world: &World, origins: &Origins, sources: &Sources) -> String {
    let mut out = String::new();
    let printer = Printer { world, origins, sources };
    // Writing to a string cannot fail.
    let _ = printer.write(&mut out);
    out
}

struct Printer<'a> {
    world: &'a World,
    origins: &'a Origins,
    sources: &'a Sources,
}

impl Printer<'_> {
    fn write(&self, out: &mut String) -> fmt::Result {
        self.camera(out)?;
        let settings = &self.world.settings;
        writeln!(out, "settings")?;
        writeln!(out, "  max_trace_level {}", settings.max_trace_level)?;
        writeln!(out, "  adc_bailout {}", settings.adc_bailout)?;
        writeln!(out, "  assumed_gamma {}", settings.assumed_gamma)?;
        if settings.clearness == Clearness::Old {
            writeln!(out, "  clear colours of versions below 3.7")?;
        }
        if settings.untinted_layers {
            writeln!(out, "  layers of versions up to 3.1")?;
        }
        let Backdrop { color, only_mirrored } = self.world.backdrop;
        write!(out, "background {}", self.world.background)?;
        if color != Backdrop::default().color {
            write!(out, ", with alpha {color}")?;
        }
        writeln!(out, "{}", if only_mirrored { ", mirrored only" } else { "" })?;
        if let Some(sky) = &self.world.sky {
            writeln!(out, "sky{}", self.at(self.origins.sky.as_ref().map(|sky| sky.site)))?;
            for layer in &sky.pigments {
                texture::pigment(out, layer, "  ")?;
            }
            if sky.emission != Rgb::WHITE {
                writeln!(out, "  emission {}", sky.emission)?;
            }
        }
        self.fogs(out)?;
        self.rainbows(out)?;
        self.lights(out)?;
        writeln!(out, "objects {}", self.world.objects.len())?;
        for (i, object) in self.world.objects.iter().enumerate() {
            self.object(out, i, object)?;
        }
        if !self.world.csg_solids.is_empty() {
            writeln!(out, "csg_solids {}", self.world.csg_solids.len())?;
            for (i, solid) in self.world.csg_solids.iter().enumerate() {
                write!(out, "  {i}")?;
                nodes(out, solid)?;
            }
        }
        writeln!(out, "textures {}", self.world.textures.len())?;
        for (i, texture) in self.world.textures.iter().enumerate() {
            let origin = self.origins.textures.get(i);
            let site = origin.and_then(|origin| origin.pigment.or(origin.finish));
            writeln!(out, "  {i}{}", self.at(site))?;
            texture::texture(out, texture, "    ")?;
        }
        if !self.world.interiors.is_empty() {
            writeln!(out, "interiors {}", self.world.interiors.len())?;
            for (i, interior) in self.world.interiors.iter().enumerate() {
                let origin = self.origins.interiors.get(i);
                let site = self.at(origin.and_then(|origin| origin.ior.first().copied()));
                write!(out, "  {i} ior {}", interior.ior)?;
                if let Some(Absorption { distance, power, color }) = interior.absorption {
                    write!(out, " fade_distance {distance} fade_power {power} fade_color {color}")?;
                }
                if let Some(Dispersion { ratio, samples }) = interior.dispersion {
                    write!(out, " dispersion {ratio} dispersion_samples {samples}")?;
                }
                writeln!(out, "{site}")?;
            }
        }
        if !self.world.texture_maps.is_empty() {
            writeln!(out, "texture_maps {}", self.world.texture_maps.len())?;
            for (i, map) in self.world.texture_maps.iter().enumerate() {
                writeln!(out, "  {i} {}", affine(map))?;
            }
        }
        for (i, uv::Mapping { form, map }) in self.world.uv_mappings.iter().enumerate() {
            writeln!(out, "uv_mapping {i} {form:?} {}", affine(map))?;
        }
        if !self.origins.dropped.is_empty() {
            writeln!(out, "left out")?;
            for dropped in &self.origins.dropped {
                let at = self.at(Some(dropped.site));
                writeln!(out, "  {}: {}{at}", dropped.what, dropped.why)?;
            }
        }
        Ok(())
    }

    fn camera(&self, out: &mut String) -> fmt::Result {
        let camera = &self.world.camera;
        let kind = match camera.kind {
            CameraKind::Perspective => "perspective".to_owned(),
            CameraKind::Orthographic => "orthographic".to_owned(),
            CameraKind::Fisheye { angle } => format!("fisheye, {angle} turns"),
            CameraKind::UltraWideAngle { angle } => format!("ultra_wide_angle, {angle} turns"),
            CameraKind::Omnimax => "omnimax".to_owned(),
            CameraKind::Panoramic => "panoramic".to_owned(),
            CameraKind::Cylinder { upright, moving, angle } => {
                let number = 1 + u32::from(!upright) + 2 * u32::from(moving);
                format!("cylinder {number}, {angle} turns")
            }
            CameraKind::Mesh => "mesh_camera".to_owned(),
            CameraKind::Spherical { across, down } => {
                format!("spherical, {across} by {down} turns")
            }
        };
        writeln!(out, "camera {kind}{}", self.at(self.origins.camera))?;
        writeln!(out, "  location {}", vector(camera.location))?;
        writeln!(out, "  forward {}", vector(camera.forward))?;
        writeln!(out, "  right {}", vector(camera.right))?;
        writeln!(out, "  up {}", vector(camera.up))?;
        if let Some(Focus { radius, distance, least, most, confidence, variance, bokeh }) =
            &camera.focus
        {
            writeln!(out, "  lens of radius {radius}, in focus at {distance}")?;
            writeln!(out, "  {least} to {most} rays, variance {variance} by {confidence}")?;
            if let Some(pigment) = bokeh {
                writeln!(out, "  bokeh {pigment:?}")?;
            }
        }
        if let Some(meshes) = &camera.meshes {
            writeln!(out, "  {meshes:?}")?;
        }
        if let Some(normal) = &camera.normal {
            writeln!(out, "  normal {normal:?}")?;
        }
        Ok(())
    }

    fn fogs(&self, out: &mut String) -> fmt::Result {
        for (i, fog) in self.world.fogs.iter().enumerate() {
            let site = self.at(self.origins.fogs.get(i).copied());
            write!(out, "fog distance {} color {}", fog.distance, fog.color)?;
            writeln!(out, " tint {} least {}{site}", fog.tint, fog.least)?;
            if let Some(Ground { up, offset, alt }) = fog.ground {
                writeln!(out, "  ground up {} fog_offset {offset} fog_alt {alt}", unit(up))?;
            }
            if let Some(Churn { scale, depth, turbulence, noise }) = fog.churn {
                write!(out, "  turbulence {} turb_depth {depth}", vector(scale))?;
                writeln!(out, " {turbulence:?} {noise:?}")?;
            }
        }
        Ok(())
    }

    fn rainbows(&self, out: &mut String) -> fmt::Result {
        for (i, rainbow) in self.world.rainbows.iter().enumerate() {
            let site = self.at(self.origins.rainbows.get(i).copied());
            let Rainbow { direction, up, inner, width, distance, colors, jitter, arc, fade } =
                rainbow;
            write!(out, "rainbow direction {} up {}", unit(*direction), unit(*up))?;
            writeln!(out, " inner {inner} width {width} distance {distance}{site}")?;
            writeln!(out, "  jitter {jitter} arc {arc} fade {fade}")?;
            for (position, color) in colors {
                writeln!(out, "  [{position} {color}]")?;
            }
        }
        Ok(())
    }

    fn lights(&self, out: &mut String) -> fmt::Result {
        writeln!(out, "lights {}", self.world.lights.len())?;
        for (i, light) in self.world.lights.iter().enumerate() {
            let kind = match light.kind {
                LightKind::Point { position } => format!("point {}", vector(position)),
                LightKind::Directional { to_light } => format!("directional {}", unit(to_light)),
                LightKind::Parallel { position, to_light } => {
                    format!("parallel {} to_light {}", vector(position), unit(to_light))
                }
            };
            let shadows = if light.casts_shadows { "" } else { " shadowless" };
            let site = self.at(self.origins.lights.get(i).copied());
            let attenuation = light.attenuation.as_ref().map_or(String::new(), attenuation);
            let area = light.area.as_ref().map_or(String::new(), area);
            let through = light.through.map_or(String::new(), |at| format!(" through {at}"));
            let color = light.color;
            writeln!(out, "  {i} {kind} color {color}{attenuation}{area}{through}{shadows}{site}")?;
        }
        for (i, world) in self.world.projections.iter().enumerate() {
            writeln!(out, "projection {i} objects {}", world.objects.len())?;
            for (j, object) in world.objects.iter().enumerate() {
                Printer { world, ..*self }.object(out, j, object)?;
            }
        }
        Ok(())
    }

    fn object(&self, out: &mut String, i: usize, object: &Object) -> fmt::Result {
        write!(out, "  {i} ")?;
        let mut more = String::new();
        match object.shape {
            Shape::Sphere(at) => {
                let sphere = &self.world.spheres[at as usize];
                write!(out, "sphere centre {} radius {}", vector(sphere.centre), sphere.radius)?;
            }
            Shape::Plane(at) => {
                let plane = &self.world.planes[at as usize];
                write!(out, "plane normal {} distance {}", unit(plane.normal), plane.distance)?;
            }
            Shape::Box(at) => {
                let solid = &self.world.boxes[at as usize];
                write!(out, "box centre {}", vector(solid.centre))?;
                faces(&mut more, solid)?;
            }
            Shape::Ellipsoid(at) => {
                write!(out, "ellipsoid")?;
                placement(out, &mut more, &self.world.ellipsoids[at as usize].placement)?;
            }
            Shape::Placed(at) => {
                let placed = &self.world.placed[at as usize];
                write!(out, "{}{}", placed.body.word(), placed.body.numbers())?;
                placement(out, &mut more, &placed.placement)?;
            }
        }
        write!(out, " texture {}", object.texture)?;
        if let Some(first) = object.places {
            write!(out, " places from {first}")?;
        }
        if let Some(uv) = object.uv {
            write!(out, " uv_mapping {uv}")?;
        }
        if let Some(caustics) = self.world.caustics.get(i).filter(|caustics| **caustics != 0.0) {
            write!(out, " caustics {caustics}")?;
        }
        if let Some(lining) = object.lining {
            let Coat { texture, places, .. } = self.world.linings[lining as usize];
            let places = places.map_or(String::new(), |first| format!(" places from {first}"));
            write!(out, " interior_texture {texture}{places}")?;
        }
        if let Some(interior) = object.interior {
            write!(out, " interior {interior}")?;
        }
        if !object.casts_shadow {
            write!(out, " no_shadow")?;
        }
        if !object.in_image {
            write!(out, " no_image")?;
        }
        if !object.in_reflections {
            write!(out, " no_reflection")?;
        }
        if object.double_illuminate {
            write!(out, " double_illuminate")?;
        }
        if let Some(set) = self.world.light_sets.get(object.lights as usize) {
            write!(out, " lights {set:?}")?;
        }
        if object.hollow {
            write!(out, " hollow")?;
        }
        if object.inverse {
            write!(out, " inverse")?;
        }
        if let Some(solid) = object.csg_solid {
            write!(out, " of csg_solid {solid}")?;
            let solid = &self.world.csg_solids[solid as usize];
            match solid.cutaway.get(i - solid.first as usize) {
                Some(Cutaway::Cut) => write!(out, " cut")?,
                Some(Cutaway::Shown(texture)) => write!(out, " shown as {texture}")?,
                Some(Cutaway::Own) | None => {}
            }
        }
        writeln!(out, "{}", self.at(self.origins.objects.get(i).copied()))?;
        out.push_str(&more);
        self.constants(out, object)
    }

    /// Prints the texture coordinates that are constant over a face.
    fn constants(&self, out: &mut String, object: &Object) -> fmt::Result {
        let Some(start) = object.faces else { return Ok(()) };
        let count = match object.shape {
            Shape::Plane(_) => 1,
            Shape::Box(_) => 6,
            Shape::Sphere(_) | Shape::Ellipsoid(_) | Shape::Placed(_) => 0,
        };
        for (face, constant) in self.world.faces.iter().skip(start as usize).take(count).enumerate()
        {
            let known: Vec<String> = ["x", "y", "z"]
                .iter()
                .zip(constant.0)
                .filter_map(|(axis, value)| value.map(|value| format!("{axis} = {value}")))
                .collect();
            if !known.is_empty() {
                writeln!(out, "      texture on face {face}: {}", known.join(", "))?;
            }
        }
        Ok(())
    }

    fn at(&self, site: Option<Site>) -> String {
        site.map_or(String::new(), |site| format!("  ({})", self.sources.place(site.span)))
    }
}

/// Prints the placement of a solid with its own space: its centre in `out`, its matrices in `more`.
fn placement(out: &mut String, more: &mut String, placement: &Placement) -> fmt::Result {
    write!(out, " centre {}", vector(placement.centre))?;
    writeln!(more, "      world_from_local {}", matrix(placement.world_from_local))?;
    writeln!(more, "      local_from_world {}", matrix(placement.local_from_world))
}

/// Prints the operations of a CSG solid in postfix order, its leaves by their objects.
fn nodes(out: &mut String, solid: &CsgSolid) -> fmt::Result {
    let mut leaves = solid.leaves();
    for node in &solid.nodes {
        match node {
            Node::Leaf { inverse } => {
                let outside = if *inverse { "outside of " } else { "" };
                write!(out, " {outside}{},", leaves.next().unwrap_or_default())?;
            }
            Node::Union(count) => write!(out, " union of {count},")?,
            Node::Merge(count) => write!(out, " merge of {count},")?,
            Node::Intersection(count) => write!(out, " intersection of {count},")?,
            Node::Clip { inverse: false } => write!(out, " the first clipped by the second,")?,
            Node::Clip { inverse: true } => write!(out, " outside of such, clipped,")?,
        }
    }
    out.pop();
    writeln!(out)
}

/// Prints a box face by face: for each of three pairs of faces N, C_f, d_f, C_o, d_o and l.
fn faces(out: &mut String, solid: &Box_) -> fmt::Result {
    for i in 0..3 {
        let face = solid.face(i);
        writeln!(
            out,
            "      face {} N {} C_f {} d_f {} C_o {} d_o {} l {}",
            i + 1,
            unit(face.normal),
            vector(face.centre),
            face.distance,
            vector(face.opposite_centre),
            face.opposite_distance,
            face.half_width
        )?;
    }
    Ok(())
}

fn attenuation(attenuation: &Attenuation) -> String {
    let beam = match attenuation.beam {
        None => String::new(),
        Some(Beam::Cone { axis, edge, core, tightness }) => {
            format!(" cone {} edge {edge} core {core} tightness {tightness}", unit(axis))
        }
        Some(Beam::Cylinder { radius, core, tightness }) => {
            format!(" cylinder radius {radius} core {core} tightness {tightness}")
        }
    };
    let fade = attenuation.fade.map_or(String::new(), |Fade { distance, power, signed }| {
        let signed = if signed { " signed" } else { "" };
        format!(" fade distance {distance} power {power}{signed}")
    });
    beam + &fade + if attenuation.fog { " dimmed by fog" } else { "" }
}

fn area(area: &Area) -> String {
    let Area { sides: [a, b], nodes: [m, n], .. } = *area;
    let mut text = format!(" area {} {} {m} × {n}", vector(a), vector(b));
    if area.least_divisions < Area::ALL_NODES {
        text += &format!(" adaptive {}", area.least_divisions);
    }
    let words = [
        (area.jitter, " jitter"),
        (area.circular, " circular"),
        (area.orient, " orient"),
        (area.illuminates, " area_illumination"),
    ];
    text.extend(words.into_iter().filter(|(is, _)| *is).map(|(_, word)| word));
    if let Some(target) = area.target {
        text += &format!(" point_at {}", vector(target));
    }
    text
}

fn unit(v: UnitVector) -> String {
    vector(v.get())
}

/// Returns the matrix row by row.
fn matrix(m: Matrix) -> String {
    [m.row(0), m.row(1), m.row(2)].map(vector).join(" ")
}

fn affine(map: &Map) -> String {
    format!("centre {} rows {}", vector(map.centre), matrix(map.matrix))
}
