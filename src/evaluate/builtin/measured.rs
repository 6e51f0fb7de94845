//! Tables of what POV-Ray 3.7 prints for calls of its functions, and a parser for them.
//!
//! A line of a table is `word(arguments) = value`, with numbers, `"strings"` and `<vectors>` as literals.
//! Random numbers have a table of a different form.

use super::{RandomStreams, call};
use crate::evaluate::value::{Components, Value};
use crate::vocabulary::Word;

pub const FLOAT: &str = include_str!("measured/float.txt");
pub const VECTOR: &str = include_str!("measured/vector.txt");
pub const STRING: &str = include_str!("measured/string.txt");
pub const RANDOM: &str = include_str!("measured/random.txt");

/// The tables whose lines are calls.
pub const TABLES: [&str; 3] = [FLOAT, VECTOR, STRING];

/// Checks that each call of a table gives its value: strings exactly, numbers to 15 digits.
pub fn check(table: &str) {
    for line in table.lines().filter(|line| !line.starts_with('#')) {
        let (name, rest) = line.split_once('(').expect("a word and its arguments");
        let word = Word::from_name(name).expect("a word");
        let (arguments, rest) = values(rest);
        let wanted = values(rest.strip_prefix(") = ").expect("a value")).0;
        let value = call(word, &arguments, &mut RandomStreams::default(), usize::MAX)
            .unwrap_or_else(|error| panic!("{line}: {}", error.message));
        assert!(wanted.len() == 1 && agree(&value, &wanted[0]), "{line}\n{value:?}");
    }
}

/// Compares relative to the largest component, which determines the program's own error.
fn agree(a: &Value, b: &Value) -> bool {
    let (Some(a), Some(b)) = (a.numbers(), b.numbers()) else {
        return a == b;
    };
    let size = a.as_slice().iter().fold(0.0, |size: f64, n| size.max(n.abs()));
    let near = |(a, b): (&f64, &f64)| (a - b).abs() <= 1e-15 * size;
    a.len() == b.len() && a.as_slice().iter().zip(b.as_slice()).all(near)
}

/// Parses the values at the start, separated by commas; returns them and the rest of the text.
fn values(mut text: &str) -> (Vec<Value>, &str) {
    let mut values = Vec::new();
    loop {
        let (value, rest) = if let Some(string) = text.strip_prefix('"') {
            let (string, rest) = string.split_once('"').expect("a closing quote");
            (Value::string(string), rest)
        } else if let Some(vector) = text.strip_prefix('<') {
            let (vector, rest) = vector.split_once('>').expect("a closing angle");
            let numbers: Vec<f64> = vector.split(", ").map(number).collect();
            (Value::Vector(Components::new(&numbers).expect("a vector")), rest)
        } else {
            let end = text.find([',', ')']).unwrap_or(text.len());
            (Value::Number(number(&text[..end])), &text[end..])
        };
        values.push(value);
        match rest.strip_prefix(", ") {
            Some(next) => text = next,
            None => return (values, rest),
        }
    }
}

fn number(text: &str) -> f64 {
    text.parse().expect("a number")
}
