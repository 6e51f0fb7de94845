//! Built-in functions: [`call`] evaluates one call.
//!
//! **In:** a word and its evaluated arguments; the streams of `rand`. **Out:** a value, or the reason why
//! there is none. **Invariant:** every number of a result is finite; where POV-Ray returns `nan` or `inf`,
//! this is an error. Only the elementary functions of `math::elementary` are used, so that a call gives the
//! same bits on every machine.
//!
//! **Source:** POV-Ray 3.7 manual, sections 3.3.1.5.4 "Functions" (numbers), 3.3.1.6.5 "Functions" (vectors)
//! and 3.3.1.9.4 "String Functions". The tables under `measured/` contain what the program prints; comments
//! state where the two differ.

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
    /// The word is not a function of this table.
    NotCallable,
    /// Too few or too many arguments.
    WrongArity,
    /// An argument is of a kind that the function does not accept.
    WrongType,
    /// An argument is outside the function's domain.
    OutOfRange,
    /// The function divides by an argument that is zero.
    DivisionByZero,
    /// An argument that must be a direction is the zero vector.
    ZeroVector,
    /// The result is too large for a number.
    NotFinite,
    /// The resulting string is longer than the limit.
    TooLong,
}

impl CallErrorKind {
    /// Returns the diagnostic code.
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

/// Why a call has no value, and the argument that causes it, if any.
#[derive(Debug, Clone, PartialEq)]
pub struct CallError {
    pub kind: CallErrorKind,
    /// Zero-based index.
    pub argument: Option<usize>,
    /// What is wrong and what was expected.
    pub message: String,
    pub help: Option<String>,
}

/// Returns the number of arguments that a function takes, with `usize::MAX` for any number; `None` if the
/// word is not a function of this table.
pub fn arity(word: Word) -> Option<RangeInclusive<usize>> {
    function(word).map(|function| function.arity)
}

/// Returns the value of `word(arguments…)`.
///
/// A poison or broken argument is returned unchanged. A resulting string is at most `longest` bytes long,
/// since doubling one in a loop must not exhaust the memory.
///
/// # Errors
///
/// See [`CallErrorKind`].
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

/// Returns the value of a numeric function; `None` if [`call`] would fail, or the function is of another
/// family.
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

/// The implementation of a function, by the kind of its result.
enum Body {
    /// A number from one number, defined everywhere.
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

/// The arguments of one call, with access by kind; their number has been checked.
struct Arguments<'a> {
    word: Word,
    values: &'a [Value],
    /// Maximum length of a string, in bytes.
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

    /// Returns a number truncated to an integer within `range`; `meaning` describes it ("a length").
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

    /// Returns the error for a number at `i` outside the function's domain.
    fn out_of_range(&self, i: usize, wanted: &str) -> CallError {
        let given = self.values[i].as_number().unwrap_or(f64::NAN);
        let message = format!("takes {wanted}, not {}", Written(given));
        self.error(CallErrorKind::OutOfRange, Some(i), message)
    }

    fn not_finite(&self) -> CallError {
        let message = "has a result too large for a number (beyond about 1.8e308)".to_owned();
        self.error(CallErrorKind::NotFinite, None, message)
    }

    /// Returns an error whose `message` follows the function's name.
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

/// A number, displayed as an author would write it, without long runs of zeros.
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

    /// Functions that need names, files, objects or formulas are implemented in the evaluator.
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
