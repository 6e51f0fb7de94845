//! The parameters of patterns as data: the block reader, `show` and the documentation are made from them.

use std::fmt;

use crate::math::Vector;
use crate::math::vector::written;

/// The value of a parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Argument {
    Number(f64),
    /// Two numbers with a comma between them, as after `exterior`.
    Numbers([f64; 2]),
    Vector(Vector),
    /// `on`, `off`, or a number that is not 0.
    Switch(bool),
}

/// A parameter of a pattern.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Parameter {
    /// The word before its value; `None` if the value follows the pattern's own word.
    pub word: Option<&'static str>,
    /// What it is, for a message: `the gradient's direction`.
    pub what: &'static str,
    pub default: Argument,
}

/// A type that parameters may have.
pub(super) trait Value: Copy {
    fn argument(self) -> Argument;

    /// Returns `None` for an argument of another type.
    fn of(argument: Argument) -> Option<Self>;
}

macro_rules! values {
    ($($kind:ident $type:ty),*) => {$(
        impl Value for $type {
            fn argument(self) -> Argument {
                Argument::$kind(self)
            }

            fn of(argument: Argument) -> Option<Self> {
                match argument {
                    Argument::$kind(value) => Some(value),
                    _ => None,
                }
            }
        }
    )*};
}

values! { Number f64, Numbers [f64; 2], Vector Vector, Switch bool }

/// Parameters by their place in [`Parameters::PARAMETERS`].
pub(super) trait Parameters: Default {
    const PARAMETERS: &'static [Parameter];

    /// Returns the value of a parameter; `None` if there is no such place.
    fn get(&self, place: usize) -> Option<Argument>;

    /// Sets a parameter. Does nothing if there is no such place, or its type is another.
    fn set(&mut self, place: usize, argument: Argument);
}

/// Writes the values of parameters that are not the default's, each after its word.
pub(super) fn write(
    f: &mut fmt::Formatter<'_>,
    parameters: &[Parameter],
    value: impl Fn(usize) -> Option<Argument>,
) -> fmt::Result {
    for (place, parameter) in parameters.iter().enumerate() {
        let Some(argument) = value(place) else { continue };
        if parameter.word.is_some() && argument == parameter.default {
            continue;
        }
        if let Some(word) = parameter.word {
            write!(f, " {word}")?;
        }
        match argument {
            Argument::Number(number) => write!(f, " {number}")?,
            Argument::Numbers([a, b]) => write!(f, " {a}, {b}")?,
            Argument::Vector(v) => write!(f, " {}", written(v))?,
            Argument::Switch(on) => f.write_str(if on { " on" } else { " off" })?,
        }
    }
    Ok(())
}

/// Declares the struct of a pattern with its parameters. Each field has the word that sets it, or `after` if
/// its value follows the pattern's own word; its doc comment; and its default.
///
/// ```text
/// parameters! {
///     /// Bricks with mortar between them.
///     pub struct Brick {
///         "brick_size" size: Vector = Vector::new(8.0, 3.0, 4.5), "the size of a brick with its mortar";
///         "mortar" mortar: f64 = 0.5, "the width of the mortar";
///     }
/// }
/// ```
macro_rules! parameters {
    (
        $(#[$meta:meta])*
        pub struct $name:ident {
            $($word:tt $field:ident: $type:tt = $default:expr, $what:literal;)*
        }
    ) => {
        $(#[$meta])*
        #[derive(Debug, Clone, Copy, PartialEq)]
        pub struct $name {
            $(#[doc = $what] pub $field: $type,)*
        }

        impl Default for $name {
            fn default() -> Self {
                Self { $($field: $default),* }
            }
        }

        #[allow(unused_imports, unused_variables, unused_mut, unused_assignments)]
        impl $crate::pattern::parameter::Parameters for $name {
            const PARAMETERS: &'static [$crate::pattern::parameter::Parameter] = &[
                $($crate::pattern::parameter::Parameter {
                    word: $crate::pattern::parameter::word!($word),
                    what: $what,
                    default: $crate::pattern::parameter::default_argument!($type, $default),
                }),*
            ];

            fn get(&self, place: usize) -> Option<$crate::pattern::parameter::Argument> {
                use $crate::pattern::parameter::Value;
                let all: &[$crate::pattern::parameter::Argument] = &[$(self.$field.argument()),*];
                all.get(place).copied()
            }

            fn set(&mut self, place: usize, argument: $crate::pattern::parameter::Argument) {
                use $crate::pattern::parameter::Value;
                let mut at = 0;
                $(
                    if place == at && let Some(value) = <$type>::of(argument) {
                        self.$field = value;
                    }
                    at += 1;
                )*
            }
        }
    };
}

/// The `Option` of a word in [`parameters!`].
macro_rules! word {
    (after) => {
        None
    };
    ($word:literal) => {
        Some($word)
    };
}

/// The argument of a default in [`parameters!`], which a constant cannot make by a trait.
macro_rules! default_argument {
    (f64, $value:expr) => {
        $crate::pattern::parameter::Argument::Number($value)
    };
    (Vector, $value:expr) => {
        $crate::pattern::parameter::Argument::Vector($value)
    };
    (bool, $value:expr) => {
        $crate::pattern::parameter::Argument::Switch($value)
    };
    ([f64; 2], $value:expr) => {
        $crate::pattern::parameter::Argument::Numbers($value)
    };
}

pub(super) use {default_argument, parameters, word};
