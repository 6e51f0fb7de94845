//! User-defined functions in the form that shapes use: with all functions that they call.

use crate::function::{Builder, Function, OutsideId};
use crate::texture::function::Component;
use crate::texture::{Asked, Closed};

use super::super::Evaluator;
use super::tape_call::{AuthorFunction, FunctionId, component_of, named_by, outside_id};

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
            AuthorFunction::Pattern(pigment) => {
                Asked::Pigment { pigment: pigment.clone(), component: Component::Value }
            }
            AuthorFunction::Pigment(pigment) => {
                Asked::Pigment { pigment: pigment.clone(), component: component_of(component)? }
            }
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
