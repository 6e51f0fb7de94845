//! User-defined functions, and calls from a tape to those that are not arithmetic.
//!
//! **Invariant:** a tape identifies one component of another function's value by its [`outside_id`].

use std::sync::Arc;

use crate::color::Color;
use crate::function::{Function, NoiseFunction, Outside, OutsideId};
use crate::math::Vector;
use crate::math::interval::Interval;
use crate::noise::NoiseGenerator;
use crate::syntax::ast::Component;
use crate::texture::Pigment;
use crate::texture::function::Component as Number;
use crate::vocabulary::Word;

use super::super::spline::SplineValue;
use super::super::value::Value;
use super::super::vector::{component_index, gray};

/// A function as it was defined.
#[derive(Debug, Clone, PartialEq)]
pub enum AuthorFunction {
    /// From numbers to a number.
    Formula(Function),
    /// From a time to a vector.
    Spline(Arc<SplineValue>),
    /// From a point and further arguments to a number.
    Noise(NoiseFunction),
    /// From a point to the pattern's value there: the red of this pigment.
    Pattern(Arc<Pigment>),
    /// From a point to a colour.
    Pigment(Arc<Pigment>),
    /// From a point to a point, with one function for each component.
    Transform(Box<[Function; 3]>),
}

/// Index of a user-defined function.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FunctionId(pub u32);

/// Index of `.gray` among a colour's components, and of `.hf`.
const GRAY: usize = 5;

/// Number of components reserved for each function's value.
const COMPONENTS: u32 = 8;

/// Returns the identifier of a component of a function's value in a tape.
pub(in crate::evaluate) fn outside_id(function: FunctionId, component: usize) -> OutsideId {
    OutsideId(function.0 * COMPONENTS + component as u32)
}

/// Decodes an [`outside_id`].
pub(super) fn named_by(id: OutsideId) -> (FunctionId, usize) {
    (FunctionId(id.0 / COMPONENTS), (id.0 % COMPONENTS) as usize)
}

/// The functions that tapes call.
pub(in crate::evaluate) struct Functions<'f> {
    pub all: &'f [AuthorFunction],
    pub noise: NoiseGenerator,
}

impl Functions<'_> {
    fn of(&self, id: OutsideId) -> (Option<&AuthorFunction>, usize) {
        let (function, component) = named_by(id);
        (self.all.get(function.0 as usize), component)
    }
}

impl Outside for Functions<'_> {
    fn value(&self, id: OutsideId, arguments: &[f64]) -> f64 {
        let (function, component) = self.of(id);
        match function {
            Some(AuthorFunction::Formula(function)) => function.run().at(arguments, self),
            Some(AuthorFunction::Spline(spline)) => {
                let values = spline.spline.at(arguments.first().copied().unwrap_or(0.0));
                values.get(component).copied().unwrap_or(f64::NAN)
            }
            Some(AuthorFunction::Noise(noise)) => noise.value(self.noise, arguments),
            Some(AuthorFunction::Pattern(pattern)) => color(pattern, arguments).rgb.red,
            Some(AuthorFunction::Pigment(pigment)) => {
                part(color(pigment, arguments).single(), component)
            }
            Some(AuthorFunction::Transform(functions)) => match functions.get(component) {
                Some(function) => function.run().at(arguments, self),
                None => f64::NAN,
            },
            None => f64::NAN,
        }
    }

    fn bounds(&self, id: OutsideId, arguments: &[Interval]) -> Interval {
        let (function, component) = self.of(id);
        match function {
            Some(AuthorFunction::Formula(function)) => function.run().at(arguments, self),
            Some(AuthorFunction::Noise(noise)) => noise.bounds(self.noise, arguments),
            Some(AuthorFunction::Pattern(pattern)) => pattern.bounds(arguments, Number::Value),
            Some(AuthorFunction::Pigment(pigment)) => match component_of(component) {
                Some(component) => pigment.bounds(arguments, component),
                None => Interval::EVERYTHING,
            },
            Some(AuthorFunction::Transform(functions)) => match functions.get(component) {
                Some(function) => function.run().at(arguments, self),
                None => Interval::EVERYTHING,
            },
            Some(AuthorFunction::Spline(_)) | None => Interval::EVERYTHING,
        }
    }
}

/// Returns the exact colour at a point.
pub(super) fn color(pigment: &Pigment, point: &[f64]) -> Color {
    let coordinate = |axis: usize| point.get(axis).copied().unwrap_or(0.0);
    let point = Vector::new(coordinate(0), coordinate(1), coordinate(2));
    pigment.color_at(point)
}

/// Returns the component of a colour with an index.
pub(super) fn component_of(index: usize) -> Option<Number> {
    Some(match index {
        0 => Number::Red,
        1 => Number::Green,
        2 => Number::Blue,
        3 => Number::Filter,
        4 => Number::Transmit,
        GRAY => Number::Gray,
        _ => return None,
    })
}

pub(super) fn part(color: Color, component: usize) -> f64 {
    match component {
        GRAY => gray(color),
        _ => Value::Color(color)
            .numbers()
            .and_then(|numbers| numbers.as_slice().get(component).copied())
            .unwrap_or(f64::NAN),
    }
}

impl AuthorFunction {
    /// Returns the number of parameters.
    pub(in crate::evaluate) fn parameters(&self) -> usize {
        match self {
            Self::Formula(function) => function.parameters(),
            Self::Spline(_) => 1,
            Self::Noise(noise) => noise.parameters(),
            Self::Pattern(_) | Self::Pigment(_) | Self::Transform(_) => 3,
        }
    }

    /// Returns the description of its value, if that is not a number.
    pub(in crate::evaluate) fn compound(&self) -> Option<&'static str> {
        match self {
            Self::Formula(_) | Self::Noise(_) | Self::Pattern(_) => None,
            Self::Spline(_) | Self::Transform(_) => Some("a vector"),
            Self::Pigment(_) => Some("a colour"),
        }
    }

    /// Returns the index of the component that the word after a dot denotes.
    pub(in crate::evaluate) fn component(&self, component: Component) -> Option<usize> {
        let Component::Word(word, _) = component else { return None };
        let count = match self {
            Self::Formula(_) | Self::Noise(_) | Self::Pattern(_) => 0,
            Self::Spline(spline) => spline.components(),
            Self::Transform(_) => 3,
            Self::Pigment(_) if word == Word::Gray => return Some(GRAY),
            Self::Pigment(_) => GRAY,
        };
        component_index(word).filter(|index| *index < count)
    }
}
