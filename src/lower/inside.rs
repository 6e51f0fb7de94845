//! Lints a camera inside an opaque solid, and lights enclosed in one.
//!
//! **In:** the World. **Out:** lints. **Invariant:** reported only for a solid whose surface is certainly
//! closed and opaque.

use super::Lowering;
use super::lint::DEFAULT_AMBIENT;
use super::view::CLEARLY;
use crate::diagnostic::{Code, Diagnostic};
use crate::geometry::bounds;
use crate::math::Vector;
use crate::shape::csg::Node;
use crate::shape::{Body, Shape};
use crate::source::Site;
use crate::world::{Light, LightKind, Object, Plain};

/// The most lights that are checked.
const MOST_LIGHTS: usize = 1000;

impl Lowering<'_, '_> {
    /// Lints a camera inside a solid that no light enters. Returns whether it was reported.
    pub(super) fn lint_inside(&mut self) -> bool {
        // A missing camera has a diagnostic of its own.
        let Some(camera) = self.origins.camera else { return false };
        // An emitting surface may be inside too.
        if self.glows() {
            return false;
        }
        let world = &self.world;
        // Its rays start elsewhere.
        if world.camera.meshes.is_some() {
            return false;
        }
        let is_starless = world.sky.is_none() && world.background.is_black();
        let is_dim = |object: &Object| {
            let is_bright = |plain: &Plain| plain.finish.emission.largest() > DEFAULT_AMBIENT;
            world.textures_of(object).all(|texture| !texture.any(is_bright))
        };
        // Below a ground plane it is as dark as in a closed room, because no sky is visible.
        let is_plane = |solid: u32| self.is_plane(solid);
        // An error may have kept a part of a solid from being read.
        let is_certain =
            |solid: u32| self.is_sound || world.objects[solid as usize].csg_solid.is_none();
        let is_around = |solid: u32| {
            is_certain(solid)
                && world.parts(solid).iter().all(is_dim)
                && (bounds(world, solid).is_some() || (is_plane(solid) && is_starless))
                && self.is_shut(solid)
                && self.holds(solid, world.camera.location)
        };
        let comes_in = |solid: u32, light: &Light| match light.kind {
            _ if !light.casts_shadows || light.through.is_some() => true,
            LightKind::Point { position } => self.holds(solid, position),
            // Its light may come from below as well.
            LightKind::Directional { .. } | LightKind::Parallel { .. } => is_plane(solid),
        };
        let around = world.solids().find(|&solid| {
            is_around(solid) && !world.lights.iter().any(|light| comes_in(solid, light))
        });
        let Some(site) = around.and_then(|i| self.origins.objects.get(i as usize)).copied() else {
            return false;
        };
        let diagnostic =
            Diagnostic::new(Code::NothingInView, "the camera is inside an object, in the dark")
                .at(camera.span, "it stands inside, and no light does")
                .also(site.span, "this is all around it")
                .help("move the camera's `location` out of it, or a light in");
        let diagnostic = diagnostic.traced(camera, self.reporter.expansions);
        self.reporter.diagnostics.push(diagnostic);
        true
    }

    /// Lints lights inside solids that no light leaves, and that are visible from outside.
    pub(super) fn lint_enclosed(&mut self) {
        if self.origins.camera.is_none() {
            return;
        }
        for (light, solid) in self.enclosed() {
            let Some(&object) = self.origins.objects.get(solid as usize) else { continue };
            let message =
                "this light stands inside an opaque object, and lights nothing outside of it";
            let label = match self.is_plane(solid) {
                true => "this is opaque, and the light is below it, on its inside",
                false => "this is opaque, and all around it",
            };
            let diagnostic = Diagnostic::new(Code::EnclosedLight, message)
                .at(light.span, "its light does not get out")
                .also(object.span, label)
                .help("give the object `no_shadow`, and light goes through; or move the light out")
                .traced(light, self.reporter.expansions);
            self.reporter.diagnostics.push(diagnostic);
        }
    }

    /// Returns each such light, and the solid around it.
    fn enclosed(&self) -> Vec<(Site, u32)> {
        let world = &self.world;
        let is_endless = |solid: u32| self.is_plane(solid) && !self.is_inverse(solid);
        let lights = world.lights.iter().zip(&self.lamps).take(MOST_LIGHTS);
        let lamps = lights.filter_map(|(light, &site)| match light.kind {
            // What is behind the object that a light shines through keeps nothing of it in.
            LightKind::Point { position } if light.casts_shadows && light.through.is_none() => {
                Some((position, site))
            }
            // Their light comes from outside.
            LightKind::Point { .. }
            | LightKind::Directional { .. }
            | LightKind::Parallel { .. } => None,
        });
        let lamps: Vec<(Vector, Site)> = lamps.collect();
        let mut found = Vec::new();
        for solid in world.solids().filter(|_| !lamps.is_empty()) {
            let bounds = bounds(world, solid);
            if bounds.is_none() && !is_endless(solid) {
                continue;
            }
            let size = bounds.as_ref().map_or(0.0, |b| (b.high - b.low).max_element());
            let within = lamps.iter().filter(|(place, _)| {
                bounds.as_ref().is_none_or(|bounds| bounds.contains(*place))
                    && self.is_shut(solid)
                    && !self.may_be_seen_inside(solid)
                    && self.clearly_holds(solid, *place, size)
            });
            found.extend(within.map(|&(_, site)| (site, solid)));
        }
        found
    }

    /// Returns whether a solid is closed to light: opaque all around, and not inside out.
    fn is_shut(&self, solid: u32) -> bool {
        let world = &self.world;
        let is_wall = |object: &Object| {
            !world.is_clear(object)
                && object.in_image
                && object.casts_shadow
                && !object.double_illuminate
                && self.is_closed(object)
        };
        let csg_solid =
            world.objects[solid as usize].csg_solid.map(|i| &world.csg_solids[i as usize]);
        // A clipped solid is open where it is cut.
        let is_clip = |node: &Node| matches!(node, Node::Clip { .. });
        !self.is_inverse(solid)
            && !csg_solid.is_some_and(|csg_solid| csg_solid.nodes.iter().any(is_clip))
            && world.parts(solid).iter().all(is_wall)
    }

    /// Returns whether an object's surface is closed; `false` if that is uncertain.
    fn is_closed(&self, object: &Object) -> bool {
        let body = match object.shape {
            Shape::Sphere(_) | Shape::Plane(_) | Shape::Box(_) | Shape::Ellipsoid(_) => {
                return true;
            }
            Shape::Placed(i) => &*self.world.placed[i as usize].body,
        };
        match body {
            Body::Cone(cone) => !cone.open,
            Body::Cylinder(cylinder) => !cylinder.open,
            Body::Isosurface(surface) => !surface.open,
            Body::Prism(prism) => !prism.open,
            Body::Sor(sor) => !sor.open,
            Body::Blob(_)
            | Body::JuliaFractal(_)
            | Body::Ovus(_)
            | Body::SphereSweep(_)
            | Body::Superellipsoid(_)
            | Body::Text(_)
            | Body::Torus(_) => true,
            // Outlines, meshes and fields may have holes, and sheets have no inside.
            Body::Algebraic(_)
            | Body::BicubicPatch(_)
            | Body::Disc(_)
            | Body::HeightField(_)
            | Body::Lathe(_)
            | Body::Mesh(_)
            | Body::Parametric(_)
            | Body::Polygon(_) => false,
        }
    }

    /// Returns whether the camera may see a solid's inside. The ray origins of an orthographic camera are not
    /// checked.
    fn may_be_seen_inside(&self, solid: u32) -> bool {
        let camera = &self.world.camera;
        let is_seen = self.world.parts(solid).iter().all(|object| object.in_reflections);
        !is_seen || !camera.has_one_origin() || self.holds(solid, camera.location)
    }

    fn holds(&self, solid: u32, place: Vector) -> bool {
        self.world.csg_contains(&self.world.objects[solid as usize], place)
    }

    /// Returns whether a point lies inside a solid of size `size` by more than the accumulated rounding.
    fn clearly_holds(&self, solid: u32, place: Vector, size: f64) -> bool {
        let off = (size + place.abs().max_element()) * CLEARLY;
        let axes = [Vector::X, Vector::Y, Vector::Z];
        axes.into_iter().all(|axis| {
            self.holds(solid, place - axis * off) && self.holds(solid, place + axis * off)
        })
    }

    /// Returns whether a solid is a plane outside any CSG solid: its inside is everything below it.
    fn is_plane(&self, solid: u32) -> bool {
        let object = &self.world.objects[solid as usize];
        object.csg_solid.is_none() && matches!(object.shape, Shape::Plane(_))
    }

    /// Returns whether a solid is inverse, so that its inside is unbounded. (An unbounded CSG solid has no
    /// bounds.)
    pub(super) fn is_inverse(&self, solid: u32) -> bool {
        let object = &self.world.objects[solid as usize];
        object.csg_solid.is_none() && object.inverse
    }
}
