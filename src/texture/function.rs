//! Functions of points and numbers, with all noise, splines and pigments that they call.

use std::sync::Arc;

use super::pigment::Pigment;
use crate::color::Color;
use crate::function::{self, Ask, NoiseFunction, Rounded, Sloped};
use crate::math::Vector;
use crate::math::interval::Interval;
use crate::noise::NoiseGenerator;
use crate::spline::Spline;

/// A function that contains everything it calls.
pub type Closed = function::Closed<Asked>;

/// Something that a function calls, in self-contained form.
#[derive(Debug, Clone, PartialEq)]
pub enum Asked {
    Noise {
        function: NoiseFunction,
        /// The generator of the scene.
        generator: NoiseGenerator,
    },
    /// One component of a spline's value.
    Spline { spline: Spline, component: usize },
    /// One component of a pigment's colour at a point.
    Pigment { pigment: Arc<Pigment>, component: Component },
}

/// A number of a colour.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Component {
    /// Red in double precision: the value of a pattern.
    Value,
    Red,
    Green,
    Blue,
    Filter,
    Transmit,
    Gray,
}

impl Component {
    /// Returns this component of a colour in single precision, as functions give it.
    pub fn of(self, color: Color) -> f64 {
        if self == Self::Value {
            return color.rgb.red;
        }
        let color = color.single();
        match self {
            Self::Value | Self::Red => color.rgb.red,
            Self::Green => color.rgb.green,
            Self::Blue => color.rgb.blue,
            Self::Filter => color.filter,
            Self::Transmit => color.transmit,
            Self::Gray => color.rgb.brightness(),
        }
    }
}

impl Ask for Asked {
    fn value(&self, arguments: &[f64]) -> f64 {
        let argument = |at: usize| arguments.get(at).copied().unwrap_or(0.0);
        match self {
            Self::Noise { function, generator } => function.value(*generator, arguments),
            Self::Spline { spline, component } => {
                spline.at(argument(0)).get(*component).copied().unwrap_or(f64::NAN)
            }
            Self::Pigment { pigment, component } => {
                let point = Vector::new(argument(0), argument(1), argument(2));
                component.of(pigment.color_at(point))
            }
        }
    }

    fn bounds(&self, arguments: &[Interval]) -> Interval {
        match self {
            Self::Noise { function, generator } => function.bounds(*generator, arguments),
            Self::Spline { spline, component } => {
                let over = arguments.first().copied().unwrap_or(Interval::EVERYTHING);
                spline.bounds(*component, over)
            }
            Self::Pigment { pigment, component } => pigment.bounds(arguments, *component),
        }
    }

    fn has_slopes(&self) -> bool {
        match self {
            Self::Noise { .. } | Self::Spline { .. } => true,
            Self::Pigment { pigment, .. } => pigment.has_slopes(),
        }
    }

    fn rounded(&self, arguments: &[Rounded]) -> Rounded {
        match self {
            Self::Noise { function, generator } => function.rounded(*generator, arguments),
            Self::Pigment { pigment, component } => pigment.rounded(arguments, *component),
            Self::Spline { .. } => {
                let values: Vec<_> = arguments.iter().map(|argument| argument.value).collect();
                Rounded::anyhow(self.bounds(&values))
            }
        }
    }

    fn sloped<const N: usize>(&self, arguments: &[Sloped<N>]) -> Sloped<N> {
        match self {
            Self::Noise { function, generator } => function.sloped(*generator, arguments),
            Self::Pigment { pigment, component } => pigment.sloped(arguments, *component),
            Self::Spline { .. } => {
                let values: Vec<_> = arguments.iter().map(|argument| argument.value).collect();
                Sloped::anyhow(self.bounds(&values), arguments.iter().all(Sloped::is_level))
            }
        }
    }
}
