//! `trace`, `inside`, `min_extent` and `max_extent`: geometric queries on a declared object.
//!
//! **In:** an object of the Scene. **Out:** a vector or a truth value. **Invariant:** the object is lowered
//! alone, once, and queried by the same code as the tracer's.

use std::rc::Rc;
use std::sync::Arc;

use crate::diagnostic::{Code, Diagnostic, Diagnostics};
use crate::geometry::{self, Extent, Geometry};
use crate::lower::{self, LowerOptions};
use crate::math::transform::Step;
use crate::math::{UnitVector, Vector};
use crate::scene::{
    LightSource, ModifierKind, Object, ObjectId, ObjectKind, Root, Scene, Solid, TextureId,
    TransformId,
};
use crate::shape::{Bounds, Ray, Rounding, Shape};
use crate::source::Span;
use crate::syntax::ast::{Argument, ExpressionKind};
use crate::texture::region::{Contains, Region};
use crate::vocabulary::Word;
use crate::world::World;

use super::value::Value;
use super::{Evaluator, Here, Outcome};

/// Half-extent that POV-Ray gives to an unbounded object.
const UNBOUNDED: f64 = 1e10;

/// A single lowered object.
#[derive(Debug)]
pub(super) struct Probe {
    world: Arc<World>,
    geometry: Geometry,
    /// Its bounding box, as POV-Ray reports it.
    extent: (Vector, Vector),
}

impl Evaluator<'_> {
    pub(super) fn probe(
        &mut self,
        here: &Here,
        word: Word,
        span: Span,
        list: &[Argument],
    ) -> Outcome<Value> {
        let arity = match word {
            Word::Trace => 3..=4,
            Word::Inside => 2..=2,
            _ => 1..=1,
        };
        if !arity.contains(&list.len()) {
            return Err(self.wrong_arity(here, word, span, arity, (list.len(), list)));
        }
        let unit = here.unit.clone();
        let mut values = Vec::with_capacity(list.len());
        let mut spans = Vec::with_capacity(list.len());
        // The fourth argument of `trace` is where the normal goes: only its name matters.
        for argument in list.iter().take(3) {
            let (value, at) = match *argument {
                Argument::Expression(id) => (self.expression(here, id), unit.expression(id).span),
                Argument::Items(items) => {
                    (self.inside(here, items, |evaluator| evaluator.only_value(here, span)), span)
                }
            };
            values.push(value?);
            spans.push(at);
        }
        if let Some(poison) = values.iter().find(|value| matches!(value, Value::Poison(_))) {
            return Ok(poison.clone());
        }
        let Value::Object(object) = values[0] else {
            // `inside(Point, Object)`
            let turned = values.iter().any(|value| matches!(value, Value::Object(_)));
            let help = turned.then(|| format!("the object comes first: {}", word.sentence()));
            return Err(self.wrong_type_with(here, spans[0], "an object", &values[0], help));
        };
        let mut vectors = [Vector::ZERO; 2];
        for (vector, (value, at)) in vectors.iter_mut().zip(values.iter().zip(&spans).skip(1)) {
            *vector = match value.as_vector3() {
                Some(vector) => vector,
                None => return Err(self.wrong_type(here, *at, "a vector", value)),
            };
        }
        let probe = self.probed(here, span, object)?;
        Ok(match word {
            Word::MinExtent => Value::vector3(probe.extent.0),
            Word::MaxExtent => Value::vector3(probe.extent.1),
            Word::Inside => Value::truth(probe.contains(vectors[0])),
            _ => {
                let Some(direction) = UnitVector::from_direction(vectors[1]) else {
                    let diagnostic = Diagnostic::new(
                        Code::ZeroVector,
                        "the direction of this `trace` is the zero vector",
                    )
                    .at(spans[2], "expected a vector other than <0, 0, 0>");
                    self.opinion(here, diagnostic)?;
                    if let Some(argument) = list.get(3) {
                        self.set_normal(here, argument, span, Vector::ZERO)?;
                    }
                    return Ok(Value::vector3(Vector::ZERO));
                };
                let (point, normal) = probe.trace(vectors[0], direction).unwrap_or_default();
                if let Some(argument) = list.get(3) {
                    self.set_normal(here, argument, span, normal)?;
                }
                Value::vector3(point)
            }
        })
    }

    fn set_normal(
        &mut self,
        here: &Here,
        argument: &Argument,
        span: Span,
        normal: Vector,
    ) -> Outcome<()> {
        if let Argument::Expression(id) = *argument
            && let ExpressionKind::Name(name) = here.unit.expression(id).kind
        {
            let symbol = here.symbol(name);
            if self.scopes.slot(symbol).is_none() {
                self.normal_missing(here, symbol, here.unit.expression(id).span);
            }
            self.scopes.mark_used(symbol);
            match self.scopes.slot(symbol) {
                Some(_) => self.scopes.overwrite(symbol, Value::vector3(normal)),
                None => self.scopes.assign(symbol, Value::vector3(normal)),
            }
            return Ok(());
        }
        if let Argument::Expression(id) = *argument
            && let ExpressionKind::Index(..) = here.unit.expression(id).kind
        {
            return self.assign_indexed(here, id, Value::vector3(normal));
        }
        let diagnostic = Diagnostic::new(
            Code::WrongType,
            "the fourth argument of `trace` receives the normal, and must be a name",
        )
        .at(span, "expected a declared name as fourth argument");
        Err(self.report(here, diagnostic))
    }

    /// Returns the region inside a declared object.
    pub(super) fn region(&mut self, here: &Here, span: Span, object: ObjectId) -> Outcome<Region> {
        Ok(Region(self.probed(here, span, object)?.world.clone()))
    }

    fn probed(&mut self, here: &Here, span: Span, object: ObjectId) -> Outcome<Rc<Probe>> {
        if let Some(probe) = self.probes.get(&object) {
            return Ok(probe.clone());
        }
        let alone = alone(&self.scene, object);
        let objects = self.options.limits.objects;
        let options = LowerOptions { objects, ..LowerOptions::default() };
        // What is wrong with the object is said when it is placed; but part of one is not it.
        let mut told = Diagnostics::new(false);
        let (world, _) = lower::lower(alone, &options, &mut told);
        if told.iter().any(|one| one.code == Code::ObjectLimit) {
            let message = format!("the object asked here has more than {objects} objects");
            let diagnostic = Diagnostic::new(Code::ObjectLimit, message)
                .at(span, "asked here")
                .help("raise the limit with `--limit objects=N`");
            return Err(self.halt(here.expansion, diagnostic));
        }
        let geometry = Geometry::build(&world);
        let probe = Rc::new(Probe { extent: extent(&world), world: Arc::new(world), geometry });
        self.probes.insert(object, probe.clone());
        Ok(probe)
    }
}

impl Probe {
    fn contains(&self, point: Vector) -> bool {
        Contains::contains(&*self.world, point)
    }

    /// Returns the first surface from `origin` on and its normal, oriented as in POV-Ray: outward, except for
    /// a mesh.
    fn trace(&self, origin: Vector, direction: UnitVector) -> Option<(Vector, Vector)> {
        let ray = Ray { origin, direction: direction.get() };
        let hit = self.geometry.nearest(&ray)?;
        let surface = geometry::surface(&self.world, &ray, &hit);
        // As given, whichever side is seen.
        if let Some(smooth) = geometry::shading_normal(&self.world, &hit, &surface) {
            return Some((surface.point, smooth + Vector::ZERO));
        }
        // Out of an inverse object it points into the shape; that of a mesh is as its corners turn, be it a
        // solid or not (measured). Zero has no sign where people read it.
        let object = &self.world.objects[hit.object as usize];
        let is_turned = match object.shape {
            Shape::Placed(i) => self.world.placed[i as usize].is_turned(&surface),
            Shape::Sphere(_) | Shape::Plane(_) | Shape::Box(_) | Shape::Ellipsoid(_) => false,
        };
        let flips = object.inverse != is_turned;
        let normal = if flips { -surface.normal } else { surface.normal };
        Some((surface.point, normal + Vector::ZERO))
    }
}

/// Returns the bounding box of a whole World.
fn extent(world: &World) -> (Vector, Vector) {
    let extent = Extent::of_all(world, Rounding::Nearest);
    if extent.is_empty() {
        return (Vector::ZERO, Vector::ZERO);
    }
    let far = Vector::splat(UNBOUNDED);
    let Bounds { low, high } = extent.bounds().unwrap_or(Bounds { low: -far, high: far });
    // Zero has no sign where people read it.
    (low + Vector::ZERO, high + Vector::ZERO)
}

/// Returns a scene with the object and its constituents only, without textures and lights.
fn alone(scene: &Scene, object: ObjectId) -> Scene {
    let mut small = Scene {
        dialect: scene.dialect,
        textures: scene.textures[..1].to_vec(),
        pigments: scene.pigments[..1].to_vec(),
        finishes: scene.finishes[..1].to_vec(),
        ..Scene::default()
    };
    // Children stand before their parents in the arena: in ascending order each finds its own.
    let mut wanted = std::collections::BTreeSet::from([object]);
    let mut open = vec![object];
    while let Some(id) = open.pop() {
        let Object { kind, modifiers, .. } = &scene.objects[id.index()];
        let clips = modifiers.iter().filter_map(|modifier| match modifier.kind {
            ModifierKind::ClippedBy(region) => Some(region),
            _ => None,
        });
        for child in children(kind).into_iter().chain(clips) {
            if wanted.insert(child) {
                open.push(child);
            }
        }
    }
    let renamed: std::collections::BTreeMap<ObjectId, ObjectId> =
        wanted.iter().enumerate().map(|(new, &old)| (old, ObjectId(new as u32))).collect();
    let moves = |id: &ObjectId| {
        let object = &scene.objects[id.index()];
        let own = object.modifiers.iter().filter_map(|modifier| match modifier.kind {
            ModifierKind::Transform(id) => Some(id),
            _ => None,
        });
        let components = match &object.kind {
            ObjectKind::Solid(Solid::Blob(blob)) => &blob.components[..],
            _ => &[],
        };
        own.chain(components.iter().flat_map(|component| &component.transforms).copied())
    };
    let transforms = lists(scene, wanted.iter().flat_map(moves));
    let renamed_list: std::collections::BTreeMap<TransformId, TransformId> =
        transforms.iter().enumerate().map(|(new, &old)| (old, TransformId(new as u32))).collect();
    for id in &transforms {
        let mut steps = scene.transforms[id.index()].clone();
        for step in &mut steps {
            if let Step::Transform(id) | Step::InverseOf(id) = step {
                *id = renamed_list[id];
            }
        }
        small.transforms.push(steps);
    }
    for id in wanted {
        let mut copy = scene.objects[id.index()].clone();
        copy.modifiers.retain(|modifier| {
            matches!(
                modifier.kind,
                ModifierKind::Transform(_) | ModifierKind::Inverse | ModifierKind::ClippedBy(_)
            )
        });
        for modifier in &mut copy.modifiers {
            match &mut modifier.kind {
                ModifierKind::Transform(id) => *id = renamed_list[id],
                ModifierKind::ClippedBy(region) => *region = renamed[region],
                _ => {}
            }
        }
        match &mut copy.kind {
            ObjectKind::Union(children) | ObjectKind::Csg { children, .. } => {
                children.iter_mut().for_each(|child| *child = renamed[child]);
            }
            ObjectKind::Use(child) => *child = renamed[child],
            ObjectKind::Solid(Solid::Blob(blob)) => {
                let components = Arc::make_mut(blob).components.iter_mut();
                let transforms = components.flat_map(|component| &mut component.transforms);
                transforms.for_each(|id| *id = renamed_list[id]);
            }
            // How its faces look does not matter.
            ObjectKind::Solid(Solid::Triangles { triangles, .. })
                if !triangles.textures.is_empty() =>
            {
                let mut bare = triangles.as_ref().clone();
                bare.textures.clear();
                bare.faces.iter_mut().for_each(|face| face.paint = None);
                *triangles = bare.into();
            }
            // Where it is does not matter.
            ObjectKind::LightSource(light) => {
                **light = LightSource::new(light.kind.clone(), light.color);
            }
            ObjectKind::Solid(_) => {}
        }
        small.objects.push(copy);
    }
    small.roots.push(Root { object: renamed[&object], default_texture: TextureId(0) });
    small
}

/// Copies these lists of steps and those that they refer to.
fn lists(
    scene: &Scene,
    wanted: impl Iterator<Item = TransformId>,
) -> std::collections::BTreeSet<TransformId> {
    let mut all = std::collections::BTreeSet::new();
    let mut open: Vec<TransformId> = wanted.collect();
    while let Some(id) = open.pop() {
        if all.insert(id) {
            open.extend(scene.transforms[id.index()].iter().filter_map(|step| match *step {
                Step::Transform(part) | Step::InverseOf(part) => Some(part),
                Step::Translate(_) | Step::Scale(_) | Step::Rotate(_) | Step::Matrix(_) => None,
            }));
        }
    }
    all
}

fn children(kind: &ObjectKind) -> Vec<ObjectId> {
    match kind {
        ObjectKind::Union(children) | ObjectKind::Csg { children, .. } => children.clone(),
        ObjectKind::Use(child) => vec![*child],
        ObjectKind::Solid(_) | ObjectKind::LightSource(_) => Vec::new(),
    }
}
