//! User-defined functions in the form that shapes use: with all functions that they call.

use crate::function::{Asked, Builder, Closed, Function, OutsideId};
use crate::world::Pigment;

use super::super::Evaluator;
use super::tape_call::{AuthorFunction, FunctionId, named_by, outside_id, part};

impl Evaluator<'_> {
    /// Returns a self-contained function with a numeric value; `None` for other values.
    pub(in crate::evaluate) fn closed(&self, id: FunctionId) -> Option<Closed> {
        let function = match self.functions.get(id.0 as usize)? {
            AuthorFunction::Formula(function) => function.clone(),
            AuthorFunction::Spline(_)
            | AuthorFunction::Pigment(_)
            | AuthorFunction::Transform(_) => {
                return None;
            }
            asked @ (AuthorFunction::Noise(_) | AuthorFunction::Pattern(_)) => {
                asking(id, asked.parameters())?
            }
        };
        Closed::new(function, |id| self.asked(id))
    }

    fn asked(&self, id: OutsideId) -> Option<Asked> {
        let (id, component) = named_by(id);
        Some(match self.functions.get(id.0 as usize)? {
            AuthorFunction::Noise(function) => {
                Asked::Noise { function: *function, generator: self.noise }
            }
            AuthorFunction::Spline(spline) => {
                Asked::Spline { spline: spline.spline.clone(), component }
            }
            AuthorFunction::Pattern(pigment) => mapped(pigment, 0),
            AuthorFunction::Pigment(pigment) => mapped(pigment, component),
            // The tape contains their operations.
            AuthorFunction::Formula(_) | AuthorFunction::Transform(_) => return None,
        })
    }
}

/// Returns a function that only calls another one.
fn asking(id: FunctionId, parameters: usize) -> Option<Function> {
    let mut builder = Builder::new(parameters).ok()?;
    let arguments: Vec<_> = (0..parameters).filter_map(|at| builder.parameter(at)).collect();
    let result = builder.ask(outside_id(id, 0), &arguments).ok()?;
    Some(builder.finish(result))
}

/// Returns one component of a pigment's colour.
fn mapped(pigment: &Pigment, component: usize) -> Asked {
    match pigment {
        Pigment::Color(color) => Asked::Constant(part(color.single(), component)),
        // It applies to meshes only.
        Pigment::Faces(_) => Asked::Constant(0.0),
        Pigment::Patterned { pattern, pattern_from_texture, map } => Asked::Pattern {
            pattern: *pattern,
            pattern_from_point: *pattern_from_texture,
            map: map.iter().map(|(at, color)| (*at, part(color.single(), component))).collect(),
        },
    }
}
