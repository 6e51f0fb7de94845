//! The functions that are always there: [`call`] gives the value of one call.
//!
//! **In:** a word and its arguments, all of them evaluated; the streams of `rand`. **Out:** a value,
//! or why there is none. **Invariant:** every number of a result is finite; what POV-Ray answers
//! with `nan` or `inf` is an error here. Only elementary functions of `math::elementary` are used,
//! so that a call gives the same bits on every machine.
//!
//! **Source:** POV-Ray 3.7 manual, sections 3.3.1.5.4 "Functions" (numbers), 3.3.1.6.5 "Functions"
//! (vectors) and 3.3.1.9.4 "String Functions"; the tables under `measured/` hold what the program
//! prints, and the comments say where the two differ.

use std::fmt;
use std::ops::RangeInclusive;

use super::value::{Components, Value};
use crate::diagnostic::Code;
use crate::math::Vector;
use crate::vocabulary::Word;

mod date;
pub mod escape;
mod float;
#[cfg(test)]
mod measured;
mod random;
mod rendered;
mod string;
mod vector;

pub use random::RandomStreams;
pub use rendered::{beyond_32_bits, rendered};
pub use vector::wants_vector;

/// Why a call has no value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CallErrorKind {
    /// The word is no function of this table.
    NotCallable,
    /// Too few or too many arguments.
    WrongArity,
    /// An argument is of another kind than the function takes.
    WrongType,
    /// An argument lies outside the function's domain.
    OutOfRange,
    /// The function divides by an argument that is zero.
    DivisionByZero,
    /// A direction is wanted, and the argument is the zero vector.
    ZeroVector,
    /// The result is too large for a number.
    NotFinite,
    /// The result is a longer string than the limit.
    TooLong,
}

impl CallErrorKind {
    /// What the author sees it as.
    pub fn code(self) -> Code {
        match self {
            Self::NotCallable => Code::NotCallable,
            Self::WrongArity => Code::WrongArity,
            Self::WrongType => Code::WrongType,
            Self::OutOfRange => Code::OutOfRange,
            Self::DivisionByZero => Code::DivisionByZero,
            Self::ZeroVector => Code::ZeroVector,
            Self::NotFinite => Code::NotANumber,
            Self::TooLong => Code::StringLimit,
        }
    }
}

/// Why a call has no value, and which argument is to blame where one is.
#[derive(Debug, Clone, PartialEq)]
pub struct CallError {
    pub kind: CallErrorKind,
    /// Counted from 0.
    pub argument: Option<usize>,
    /// What is wrong and what was expected.
    pub message: String,
    pub help: Option<String>,
}

/// How many arguments a function takes, `usize::MAX` for any number; `None` if the word is no
/// function of this table.
pub fn arity(word: Word) -> Option<RangeInclusive<usize>> {
    function(word).map(|function| function.arity)
}

/// The value of `word(arguments…)`.
///
/// Anything done with a poison or broken value is that value again. No string becomes longer than
/// `longest` bytes, since doubling one in a loop must not fill the memory.
///
/// # Errors
/// As [`CallErrorKind`] lists them.
pub fn call(
    word: Word,
    arguments: &[Value],
    streams: &mut RandomStreams,
    longest: usize,
) -> Result<Value, CallError> {
    let Some(function) = function(word) else {
        return Err(CallError {
            kind: CallErrorKind::NotCallable,
            argument: None,
            message: format!("`{}` is not a function that can be called here", word.name()),
            help: None,
        });
    };
    let arguments = Arguments { word, values: arguments, longest };
    arguments.expect_count(&function.arity)?;
    let lost = |value: &&Value| matches!(value, Value::Poison(_) | Value::Broken);
    if let Some(lost) = arguments.values.iter().find(lost) {
        return Ok(lost.clone());
    }
    let value = match function.body {
        Body::Plain(f) => Value::Number(f(arguments.number(0)?)),
        Body::Number(f) => Value::Number(f(&arguments)?),
        Body::Vector(f) => Value::vector3(f(&arguments)?),
        Body::String(f) => Value::string(f(&arguments)?),
        Body::Random(f) => Value::Number(f(&arguments, streams)?),
    };
    if value.is_finite() { Ok(value) } else { Err(arguments.not_finite()) }
}

/// The number that a function of numbers gives; `None` where [`call`] would not, or is of another family.
pub fn number<const N: usize>(word: Word, numbers: [f64; N]) -> Option<f64> {
    let Function { arity, body } = float::function(word)?;
    let number = match body {
        _ if !arity.contains(&N) => return None,
        Body::Plain(f) => f(*numbers.first()?),
        Body::Number(f) => {
            let values = numbers.map(Value::Number);
            f(&Arguments { word, values: &values, longest: 0 }).ok()?
        }
        Body::Vector(_) | Body::String(_) | Body::Random(_) => return None,
    };
    number.is_finite().then_some(number)
}

fn function(word: Word) -> Option<Function> {
    float::function(word)
        .or_else(|| vector::function(word))
        .or_else(|| string::function(word))
        .or_else(|| random::function(word))
        .or_else(|| date::function(word))
}

/// One row of a family's table.
struct Function {
    arity: RangeInclusive<usize>,
    body: Body,
}

/// How a function is computed, by what it gives.
enum Body {
    /// A number of one number, defined everywhere.
    Plain(fn(f64) -> f64),
    Number(fn(&Arguments) -> Result<f64, CallError>),
    Vector(fn(&Arguments) -> Result<Vector, CallError>),
    String(fn(&Arguments) -> Result<String, CallError>),
    Random(fn(&Arguments, &mut RandomStreams) -> Result<f64, CallError>),
}

impl Function {
    fn plain(f: fn(f64) -> f64) -> Option<Self> {
        Some(Self { arity: 1..=1, body: Body::Plain(f) })
    }

    fn number(
        arity: RangeInclusive<usize>,
        f: fn(&Arguments) -> Result<f64, CallError>,
    ) -> Option<Self> {
        Some(Self { arity, body: Body::Number(f) })
    }

    fn vector(
        arity: RangeInclusive<usize>,
        f: fn(&Arguments) -> Result<Vector, CallError>,
    ) -> Option<Self> {
        Some(Self { arity, body: Body::Vector(f) })
    }

    fn string(
        arity: RangeInclusive<usize>,
        f: fn(&Arguments) -> Result<String, CallError>,
    ) -> Option<Self> {
        Some(Self { arity, body: Body::String(f) })
    }
}

/// The arguments of one call, read as the kinds a function wants; their number is right.
struct Arguments<'a> {
    word: Word,
    values: &'a [Value],
    /// The most bytes of a string.
    longest: usize,
}

impl Arguments<'_> {
    fn number(&self, i: usize) -> Result<f64, CallError> {
        self.values[i].as_number().ok_or_else(|| self.wrong_type(i, "a number"))
    }

    fn all_numbers(&self) -> Result<impl Iterator<Item = f64>, CallError> {
        (0..self.values.len()).try_for_each(|i| self.number(i).map(drop))?;
        Ok(self.values.iter().filter_map(Value::as_number))
    }

    fn vector3(&self, i: usize) -> Result<Vector, CallError> {
        self.values[i].as_vector3().ok_or_else(|| self.wrong_type(i, "a vector of three"))
    }

    fn components(&self, i: usize) -> Result<Components, CallError> {
        self.values[i].numbers().ok_or_else(|| self.wrong_type(i, "a vector"))
    }

    fn string(&self, i: usize) -> Result<&str, CallError> {
        match &self.values[i] {
            Value::String(text) => Ok(text),
            _ => Err(self.wrong_type(i, "a string")),
        }
    }

    /// A number without its fraction, within `range`; `meaning` says what it is ("a length").
    fn whole(&self, i: usize, range: RangeInclusive<i64>, meaning: &str) -> Result<i64, CallError> {
        let n = self.number(i)?;
        let whole = n as i64; // truncates, and saturates far outside any range asked for
        if range.contains(&whole) {
            return Ok(whole);
        }
        let wanted = format!("{meaning} from {} to {}", range.start(), range.end());
        Err(self.out_of_range(i, &wanted))
    }

    fn expect_count(&self, arity: &RangeInclusive<usize>) -> Result<(), CallError> {
        let count = self.values.len();
        if arity.contains(&count) {
            return Ok(());
        }
        let plural = |n: usize| if n == 1 { "argument" } else { "arguments" };
        let (least, most) = (*arity.start(), *arity.end());
        let wanted = match most {
            usize::MAX => format!("at least {least} {}", plural(least)),
            _ if least == most => format!("{least} {}", plural(least)),
            _ => format!("{least} to {most} arguments"),
        };
        Err(CallError {
            kind: CallErrorKind::WrongArity,
            argument: (count > most).then_some(most),
            message: format!("`{}` takes {wanted}, not {count}", self.word.name()),
            help: Some(self.word.sentence().to_owned()),
        })
    }

    fn wrong_type(&self, i: usize, wanted: &str) -> CallError {
        let value = &self.values[i];
        let given = match value {
            Value::Vector(v) if wanted.starts_with("a vector") => {
                format!("a vector of {}", v.len())
            }
            _ => value.kind().to_owned(),
        };
        let message = format!("takes {wanted}, not {given}");
        let error = self.error(CallErrorKind::WrongType, Some(i), message);
        match value {
            Value::Number(_) if wanted == "a string" => {
                error.with_help("a number becomes a string by `str(n, 0, -1)`")
            }
            Value::Vector(_) if wanted == "a string" => {
                error.with_help("a vector becomes a string by `vstr(3, V, \", \", 0, -1)`")
            }
            Value::Vector(_) if self.word == Word::Str => {
                error.with_help("a vector becomes a string by `vstr(3, V, \", \", 0, -1)`")
            }
            Value::String(_) if wanted == "a number" => {
                error.with_help("a string becomes a number by `val(s)`")
            }
            _ => error,
        }
    }

    /// The number at `i` is not what the function takes.
    fn out_of_range(&self, i: usize, wanted: &str) -> CallError {
        let given = self.values[i].as_number().unwrap_or(f64::NAN);
        let message = format!("takes {wanted}, not {}", Written(given));
        self.error(CallErrorKind::OutOfRange, Some(i), message)
    }

    fn not_finite(&self) -> CallError {
        let message = "has a result too large for a number (beyond about 1.8e308)".to_owned();
        self.error(CallErrorKind::NotFinite, None, message)
    }

    /// `message` follows the function's name.
    fn error(&self, kind: CallErrorKind, argument: Option<usize>, message: String) -> CallError {
        let message = format!("`{}` {message}", self.word.name());
        CallError { kind, argument, message, help: None }
    }
}

impl CallError {
    fn with_help(self, help: impl Into<String>) -> Self {
        Self { help: Some(help.into()), ..self }
    }
}

/// A number as an author would write it: no endless rows of zeros.
struct Written(f64);

impl fmt::Display for Written {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(n) = *self;
        if n == 0.0 || (1e-5..1e16).contains(&n.abs()) {
            write!(f, "{n}")
        } else {
            write!(f, "{n:e}")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evaluate::value::Poison;
    use crate::source::{ExpansionId, FileId, Site, Span};
    use crate::vocabulary::{Family, Role};

    fn error(word: Word, arguments: &[Value]) -> CallError {
        call(word, arguments, &mut RandomStreams::default(), 100).expect_err("no value")
    }

    #[test]
    fn the_wrong_number_of_arguments_is_named_with_the_right_one() {
        let number = Value::Number(1.0);
        let two = error(Word::Sin, &[number.clone(), number.clone()]);
        assert_eq!(two.message, "`sin` takes 1 argument, not 2");
        assert_eq!((two.kind, two.argument), (CallErrorKind::WrongArity, Some(1)));
        assert_eq!(error(Word::Max, &[]).message, "`max` takes at least 1 argument, not 0");
        let select = error(Word::Select, &[number]);
        assert_eq!(select.message, "`select` takes 3 to 4 arguments, not 1");
        assert_eq!(select.argument, None);
    }

    #[test]
    fn an_argument_of_the_wrong_kind_is_pointed_at() {
        let string = Value::string("1");
        let number = Value::Number(1.0);
        let five = Value::Vector(Components::new(&[1.0; 5]).expect("five numbers"));
        let pow = error(Word::Pow, &[number.clone(), string]);
        assert_eq!(pow.message, "`pow` takes a number, not a string");
        assert_eq!((pow.kind, pow.argument), (CallErrorKind::WrongType, Some(1)));
        let dot = error(Word::Vdot, &[five, number.clone()]);
        assert_eq!(dot.message, "`vdot` takes a vector of three, not a vector of 5");
        assert_eq!(error(Word::Strlen, &[number]).message, "`strlen` takes a string, not a number");
    }

    #[test]
    fn a_result_without_end_is_an_error() {
        let error = error(Word::Exp, &[Value::Number(1000.0)]);
        assert_eq!(error.kind.code(), Code::NotANumber);
    }

    #[test]
    fn what_is_done_with_poison_is_that_poison() {
        let span = Span { file: FileId(0), start: 1, end: 2 };
        let site = Site { span, expansion: ExpansionId::MAIN };
        let poison = Value::Poison(Poison::new(Word::Torus, site));
        let mut streams = RandomStreams::default();
        let sum = call(Word::Vdot, &[Value::Number(1.0), poison.clone()], &mut streams, 100);
        assert_eq!(sum, Ok(poison));
    }

    #[test]
    fn words_that_are_no_functions_of_this_table_are_refused() {
        assert_eq!(arity(Word::Sphere), None);
        assert_eq!(error(Word::Sphere, &[]).kind, CallErrorKind::NotCallable);
    }

    /// What needs names, files, objects or formulas belongs to the evaluator.
    const OF_THE_EVALUATOR: [Word; 14] = [
        Word::Defined,
        Word::DimensionSize,
        Word::Dimensions,
        Word::FileExists,
        Word::Inside,
        Word::Internal,
        Word::MaxExtent,
        Word::MinExtent,
        Word::Prod,
        Word::Pwr,
        Word::Sqr,
        Word::Sum,
        Word::Trace,
        Word::Xyz,
    ];

    #[test]
    fn every_built_function_of_the_vocabulary_is_here_with_the_arity_its_syntax_needs() {
        for &word in Word::ALL {
            let family = matches!(
                word.family(),
                Family::FloatFunction | Family::VectorFunction | Family::StringFunction
            );
            let wanted = family && word.is_built() && !OF_THE_EVALUATOR.contains(&word);
            assert_eq!(arity(word).is_some(), wanted, "{}", word.name());
            if let (Some(arity), Role::Function { one_argument }) = (arity(word), word.role()) {
                assert_eq!(arity == (1..=1), one_argument, "{}", word.name());
            }
        }
    }

    #[test]
    fn every_function_has_at_least_three_measured_calls() {
        for &word in Word::ALL.iter().filter(|word| arity(**word).is_some()) {
            let count = measured::TABLES
                .iter()
                .flat_map(|table| table.lines())
                .filter(|line| line.split('(').next() == Some(word.name()))
                .count();
            assert!(count >= 3 || matches!(word, Word::Seed | Word::Rand), "{}", word.name());
        }
    }
}
