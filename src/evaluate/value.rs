//! Values of the language, and their promotion.
//!
//! **Invariant:** the promotion rules are implemented only here (manual, section 3.2.1.4, "Vector
//! Expressions"; checked against the program): a number combined with a vector fills all of its components,
//! and a shorter vector is padded with zeros to the length of a longer one.

use std::fmt;
use std::sync::Arc;

use crate::color::{Color, Rgb};
use crate::math::Vector;
use crate::scene::{FinishId, InteriorId, NormalId, ObjectId, PigmentId, TextureId, TransformId};
use crate::source::Site;
use crate::syntax::ast::{BinaryOperator, UnaryOperator};
use crate::vocabulary::Word;

use super::array::Array;
use super::block::{BlendMap, WrittenMap};
use super::comparison::Comparison;
use super::file::FileHandle;
use super::function::FunctionId;
use super::spline::SplineValue;

/// A vector of two to five numbers.
#[derive(Clone, Copy, PartialEq)]
pub struct Components {
    values: [f64; 5],
    len: u8,
}

impl Components {
    /// Returns `None` for fewer than two or more than five numbers.
    pub fn new(values: &[f64]) -> Option<Self> {
        let mut all = [0.0; 5];
        all.get_mut(..values.len())?.copy_from_slice(values);
        Self::first(values.len(), all)
    }

    /// Returns the first `len` of five numbers, the others of which are zero.
    pub fn first(len: usize, values: [f64; 5]) -> Option<Self> {
        (2..=5).contains(&len).then_some(Self { values, len: len as u8 })
    }

    pub fn len(&self) -> usize {
        usize::from(self.len)
    }

    pub fn as_slice(&self) -> &[f64] {
        &self.values[..self.len()]
    }

    /// Converts to a vector of three. Two numbers get a zero; more than three return `None`.
    pub fn as_vector3(&self) -> Option<Vector> {
        let [x, y, z, ..] = self.values;
        (self.len <= 3).then_some(Vector::new(x, y, z))
    }

    pub(super) fn map(self, f: impl Fn(f64) -> f64) -> Self {
        let mut result = self;
        result.values[..self.len()].iter_mut().for_each(|c| *c = f(*c));
        result
    }
}

impl From<Vector> for Components {
    fn from(Vector { x, y, z }: Vector) -> Self {
        Self { values: [x, y, z, 0.0, 0.0], len: 3 }
    }
}

impl fmt::Debug for Components {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.as_slice()).finish()
    }
}

/// A value of the language.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// A number or a truth value: 0 is false.
    Number(f64),
    Vector(Components),
    /// A colour of five components: red, green, blue, filter, transmit.
    Color(Color),
    String(Arc<str>),
    Transform(TransformId),
    Texture(TextureId),
    Pigment(PigmentId),
    Normal(NormalId),
    Finish(FinishId),
    Interior(InteriorId),
    Material(Material),
    ColorMap(Arc<WrittenMap>),
    /// A `pigment_map` and the like.
    BlendMap(BlendMap),
    Object(ObjectId),
    Camera(Arc<crate::scene::Camera>),
    Array(Arc<Array>),
    Spline(Arc<SplineValue>),
    Function(FunctionId),
    SkySphere(Arc<crate::scene::SkySphere>),
    Fog(Arc<crate::scene::Fog>),
    Rainbow(Arc<crate::scene::Rainbow>),
    /// A file opened by `#fopen`.
    File(FileHandle),
    Macro(super::scope::MacroId),
    /// A value of an unsupported kind: fatal only if it reaches the scene.
    Poison(Poison),
    /// A value whose declaration was reported: uses of it report nothing more.
    Broken,
}

/// Contents of a `material`.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Material {
    pub texture: Option<TextureId>,
    pub interior_texture: Option<TextureId>,
    pub interior: Option<InteriorId>,
}

/// Why a value is missing: the unsupported word and its position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Poison {
    pub word: Word,
    pub site: Site,
    /// The kind of block that it would be, if a name denotes one.
    pub of: Option<Word>,
}

impl Poison {
    pub fn new(word: Word, site: Site) -> Self {
        Self { word, site, of: None }
    }
}

impl Value {
    pub fn truth(value: bool) -> Self {
        Self::Number(f64::from(u8::from(value)))
    }

    pub fn vector3(v: Vector) -> Self {
        Self::Vector(Components { values: [v.x, v.y, v.z, 0.0, 0.0], len: 3 })
    }

    pub fn string(text: impl Into<Arc<str>>) -> Self {
        Self::String(text.into())
    }

    /// Returns the heap size in bytes, for values that may be large.
    pub fn bytes(&self) -> u64 {
        match self {
            Self::String(text) => text.len() as u64,
            Self::ColorMap(map) => size_of_val(&map.map.0[..]) as u64,
            Self::Rainbow(rainbow) => rainbow.bytes(),
            Self::BlendMap(map) => size_of_val(&map.entries[..]) as u64,
            Self::Array(array) => size_of_val(array.elements()) as u64,
            Self::Spline(spline) => size_of_val(spline.spline.knots()) as u64,
            _ => 0,
        }
    }

    /// Returns the name of the kind for messages, with its article.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Number(_) => "a number",
            Self::Vector(_) => "a vector",
            Self::Color(_) => "a colour",
            Self::String(_) => "a string",
            Self::Transform(_) => "a transform",
            Self::Texture(_) => "a texture",
            Self::Pigment(_) => "a pigment",
            Self::Normal(_) => "a normal",
            Self::Finish(_) => "a finish",
            Self::Interior(_) => "an interior",
            Self::Material(_) => "a material",
            Self::ColorMap(_) => "a color_map",
            Self::BlendMap(map) => match map.word {
                Word::PigmentMap => "a pigment_map",
                Word::NormalMap => "a normal_map",
                Word::SlopeMap => "a slope_map",
                _ => "a texture_map",
            },
            Self::Object(_) => "an object",
            Self::Camera(_) => "a camera",
            Self::Array(_) => "an array",
            Self::Spline(_) => "a spline",
            Self::Function(_) => "a function",
            Self::SkySphere(_) => "a sky_sphere",
            Self::Fog(_) => "a fog",
            Self::Rainbow(_) => "a rainbow",
            Self::File(_) => "a file",
            Self::Macro(_) => "a macro",
            Self::Poison(_) => "something not built yet",
            Self::Broken => "a faulty value",
        }
    }

    /// Returns whether all its numbers are finite.
    pub fn is_finite(&self) -> bool {
        self.numbers().is_none_or(|numbers| numbers.as_slice().iter().all(|n| n.is_finite()))
    }

    /// Returns the components of a number, vector or colour.
    pub fn numbers(&self) -> Option<Components> {
        match self {
            Self::Number(n) => Some(Components { values: [*n, 0.0, 0.0, 0.0, 0.0], len: 1 }),
            Self::Vector(v) => Some(*v),
            Self::Color(c) => Some(Components {
                values: [c.rgb.red, c.rgb.green, c.rgb.blue, c.filter, c.transmit],
                len: 5,
            }),
            _ => None,
        }
    }

    /// Returns the value as calculations read it from a name: colours, and vectors of five numbers, which are
    /// stored as colours, have single precision (measured in POV-Ray: with `C = rgb 0.1`, `C.red = 0.1` is
    /// false). A value that reaches the scene unchanged keeps all its digits.
    pub fn read_back(self) -> Self {
        match self {
            Self::Color(color) => Self::Color(color.single()),
            Self::Vector(Components { len: 5, .. }) => match self.as_color() {
                Some(color) => Self::Color(color.single()).numbers().map_or(self, Self::Vector),
                None => self,
            },
            other => other,
        }
    }

    pub fn as_number(&self) -> Option<f64> {
        match self {
            Self::Number(n) => Some(*n),
            _ => None,
        }
    }

    /// Converts to a vector of three: a number fills all three components, two numbers get a zero; longer
    /// vectors and colours return `None`.
    pub fn as_vector3(&self) -> Option<Vector> {
        match self {
            Self::Number(n) => Some(Vector::splat(*n)),
            Self::Vector(v) => v.as_vector3(),
            _ => None,
        }
    }

    /// Converts to a colour: a number fills all five components, vectors are padded with zeros.
    pub fn as_color(&self) -> Option<Color> {
        if let Self::Color(color) = self {
            return Some(*color);
        }
        let [red, green, blue, filter, transmit] = match self.numbers()? {
            Components { values, len: 1 } => [values[0]; 5],
            Components { values, .. } => values,
        };
        Some(Color { rgb: Rgb::new(red, green, blue), filter, transmit })
    }

    /// Returns the truth value as `#if` sees it.
    pub fn as_truth(&self, comparison: Comparison) -> Option<bool> {
        self.as_number().map(|number| comparison.is_true(number))
    }
}

/// Why an operation has no result.
#[derive(Debug, Clone, PartialEq)]
pub enum OperationError {
    /// The operand (0: left or only, 1: right) is not numeric.
    NotNumeric(usize),
    DivisionByZero,
    /// A component of the result is infinite or NaN.
    NotFinite,
}

/// Evaluates `-a`, `+a` or `!a`.
pub fn unary(
    operator: UnaryOperator,
    operand: &Value,
    comparison: Comparison,
) -> Result<Value, OperationError> {
    let numbers = operand.numbers().ok_or(OperationError::NotNumeric(0))?;
    let result = match operator {
        UnaryOperator::Plus => numbers,
        UnaryOperator::Minus => numbers.map(|c| -c),
        UnaryOperator::Not => numbers.map(|c| f64::from(u8::from(!comparison.is_true(c)))),
    };
    Ok(same_kind(result, matches!(operand, Value::Color(_))))
}

/// Evaluates a binary operation such as `a + b`, component by component after promotion.
pub fn binary(
    operator: BinaryOperator,
    left: &Value,
    right: &Value,
    comparison: Comparison,
) -> Result<Value, OperationError> {
    if let (Value::Number(a), Value::Number(b)) = (left, right) {
        return numbers_meet(operator, *a, *b, comparison).map(Value::Number);
    }
    if let (Value::String(a), Value::String(b)) = (left, right)
        && let Some(answer) = strings_meet(operator, a, b)
    {
        return Ok(Value::truth(answer));
    }
    by_component(left, right, |a, b| numbers_meet(operator, a, b, comparison))
}

/// As [`binary`] for numbers, with POV-Ray 3.7's non-finite results (measured): those of IEEE 754, except
/// that a division by zero gives +inf.
pub fn unbounded(
    operator: BinaryOperator,
    left: &Value,
    right: &Value,
    comparison: Comparison,
) -> Result<Value, OperationError> {
    by_component(left, right, |a, b| match apply(operator, a, b, comparison) {
        Err(OperationError::DivisionByZero) => Ok(f64::INFINITY),
        result => result,
    })
}

fn by_component(
    left: &Value,
    right: &Value,
    meet: impl Fn(f64, f64) -> Result<f64, OperationError>,
) -> Result<Value, OperationError> {
    let a = left.numbers().ok_or(OperationError::NotNumeric(0))?;
    let b = right.numbers().ok_or(OperationError::NotNumeric(1))?;
    let len = a.len.max(b.len);
    let promoted = |c: Components| if c.len == 1 { [c.values[0]; 5] } else { c.values };
    let (a, b) = (promoted(a), promoted(b));
    let mut values = [0.0; 5];
    for i in 0..usize::from(len) {
        values[i] = meet(a[i], b[i])?;
    }
    let color = matches!(left, Value::Color(_)) || matches!(right, Value::Color(_));
    Ok(same_kind(Components { values, len }, color))
}

/// Compares two strings by the code points of their characters; no other operator applies to them (manual,
/// 3.3.1.9.3 "String relational operators").
fn strings_meet(operator: BinaryOperator, a: &str, b: &str) -> Option<bool> {
    Some(match operator {
        BinaryOperator::Equal => a == b,
        BinaryOperator::NotEqual => a != b,
        BinaryOperator::Less => a < b,
        BinaryOperator::LessOrEqual => a <= b,
        BinaryOperator::GreaterOrEqual => a >= b,
        BinaryOperator::Greater => a > b,
        BinaryOperator::Add
        | BinaryOperator::Subtract
        | BinaryOperator::Multiply
        | BinaryOperator::Divide
        | BinaryOperator::And
        | BinaryOperator::Or => return None,
    })
}

/// As [`binary`], for two numbers.
pub fn numbers_meet(
    operator: BinaryOperator,
    a: f64,
    b: f64,
    comparison: Comparison,
) -> Result<f64, OperationError> {
    finite(apply(operator, a, b, comparison)?)
}

fn finite(value: f64) -> Result<f64, OperationError> {
    if value.is_finite() { Ok(value) } else { Err(OperationError::NotFinite) }
}

fn same_kind(numbers: Components, color: bool) -> Value {
    match numbers {
        Components { values, len: 1 } => Value::Number(values[0]),
        Components { values: [red, green, blue, filter, transmit], .. } if color => {
            Value::Color(Color { rgb: Rgb::new(red, green, blue), filter, transmit })
        }
        _ => Value::Vector(numbers),
    }
}

fn apply(
    operator: BinaryOperator,
    a: f64,
    b: f64,
    comparison: Comparison,
) -> Result<f64, OperationError> {
    let same = |a, b| comparison.same(a, b);
    let is_true = |number| comparison.is_true(number);
    let truth = |value: bool| f64::from(u8::from(value));
    Ok(match operator {
        BinaryOperator::Add => a + b,
        BinaryOperator::Subtract => a - b,
        BinaryOperator::Multiply => a * b,
        BinaryOperator::Divide if b == 0.0 => return Err(OperationError::DivisionByZero),
        BinaryOperator::Divide => a / b,
        BinaryOperator::Less => truth(a < b),
        BinaryOperator::LessOrEqual => truth(a <= b || same(a, b)),
        BinaryOperator::Equal => truth(same(a, b)),
        BinaryOperator::NotEqual => truth(!same(a, b)),
        BinaryOperator::GreaterOrEqual => truth(a >= b || same(a, b)),
        BinaryOperator::Greater => truth(a > b),
        BinaryOperator::And => truth(is_true(a) && is_true(b)),
        BinaryOperator::Or => truth(is_true(a) || is_true(b)),
    })
}

#[cfg(test)]
mod tests;
