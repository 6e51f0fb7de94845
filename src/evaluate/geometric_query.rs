//! `trace`, `inside`, `min_extent` and `max_extent`: geometric queries on a declared object.
//!
//! **In:** an object of the Scene. **Out:** a vector or a truth value. **Invariant:** the object is lowered
//! alone, once, and queried by the same code as the tracer's.

use std::rc::Rc;
use std::sync::Arc;

use crate::diagnostic::{Code, Diagnostic, Diagnostics};
use crate::geometry::{self, Extent, Geometry};
use crate::lower::{self, LowerOptions};
use crate::math::{UnitVector, Vector};
use crate::scene::ObjectId;
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
        let single = lower::single(&self.scene, object);
        let objects = self.options.limits.objects;
        let options = LowerOptions { objects, ..LowerOptions::default() };
        // What is wrong with the object is said when it is placed; but part of one is not it.
        let mut told = Diagnostics::new(false);
        let (world, _) = lower::lower(single, &options, &mut told);
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
