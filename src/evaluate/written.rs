//! Numbers and ranges written as in other languages, which parse as names.

use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;

use super::Evaluator;

/// Number words and their values.
const NUMBERS: [(&str, &str); 14] = [
    ("zero", "0"),
    ("one", "1"),
    ("two", "2"),
    ("three", "3"),
    ("four", "4"),
    ("five", "5"),
    ("six", "6"),
    ("ten", "10"),
    ("twenty", "20"),
    ("thirty", "30"),
    ("forty", "40"),
    ("ninety", "90"),
    ("hundred", "100"),
    ("half", "0.5"),
];

impl Evaluator<'_> {
    /// Returns the diagnostic for `0.25D+00`, `0.1 to 0.5`, `O.5` and the like.
    pub(super) fn of_another_writing(&self, name: &str, span: Span) -> Option<Diagnostic> {
        let text = &self.sources.get(span.file).text;
        let (before, after) = (text.get(..span.range().start)?, text.get(span.range().end..)?);
        let ends_number = |before: &str| before.ends_with(|c: char| c.is_ascii_digit() || c == '.');
        let begins_number = |after: &str| {
            after.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '.' | '-' | '+' | '<'))
        };
        let exponent = name.strip_prefix(['D', 'd']).map(|digits| digits.to_owned());
        if let Some(digits) = exponent.filter(|digits| digits.bytes().all(|b| b.is_ascii_digit()))
            && ends_number(before)
            && (!digits.is_empty() || begins_number(after))
        {
            let message = format!("`{name}` is no exponent");
            let digits_before = |c: char| c.is_ascii_digit() || c == '.';
            let number = before.trim_end_matches(digits_before).len() as u32;
            return Some(
                Diagnostic::new(Code::MalformedNumber, message)
                    .at(
                        Span { start: number, ..span },
                        "an exponent is written with `e`: `1.5e+00`",
                    )
                    .fix(span, format!("e{digits}")),
            );
        }
        let is_fraction = after
            .strip_prefix('.')
            .is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit()));
        if matches!(name, "O" | "o") && is_fraction {
            let digits = after[1..].find(|c: char| !c.is_ascii_digit()).map(|end| end + 1);
            let fraction = &after[..digits.unwrap_or(after.len())];
            let message = format!("`{name}{fraction}` is not a number");
            return Some(
                Diagnostic::new(Code::MalformedNumber, message)
                    .at(span, "this is a letter, and no zero")
                    .help(format!("write `0{fraction}`"))
                    .fix(span, "0"),
            );
        }
        let (blank, close) = (before.trim_end(), after.trim_start());
        if name == "to" && blank.len() < before.len() && begins_number(close) {
            let gap = Span::new(span.file, blank.len(), span.range().end);
            return Some(
                Diagnostic::new(Code::UnknownWord, "`to` is not a word of the language")
                    .at(span, "two values are parted by a comma")
                    .fix(gap, ","),
            );
        }
        None
    }
}

/// Returns the number or vector in a string where one is expected, as written; `None` if it is neither.
pub(super) fn unquoted(text: &str, wanted: &str) -> Option<String> {
    let are_numbers = |text: &str| text.split(',').all(|part| part.trim().parse::<f64>().is_ok());
    match (text, wanted.starts_with("a vector")) {
        ("x" | "y" | "z", true) => Some(text.to_owned()),
        (_, true) if text.contains(',') => are_numbers(text).then(|| format!("<{text}>")),
        (_, false)
            if !wanted.starts_with("a number")
                && !matches!(wanted, "degrees" | "a whole number") =>
        {
            None
        }
        _ => text.parse::<f64>().ok().map(|number| number.to_string()),
    }
}

/// Returns the diagnostic for a name that stands for a number, such as `nan`, `thirty` or `O`, where no
/// similar name exists.
pub(super) fn number_as_a_name(name: &str, span: Span) -> Option<Diagnostic> {
    /// What programs print for an undefined result.
    const NONE: [&str; 7] = ["nan", "inf", "infinity", "none", "null", "nil", "undefined"];
    let told =
        |message: &str| Diagnostic::new(Code::MalformedNumber, format!("`{name}` is {message}"));
    if NONE.contains(&name.to_ascii_lowercase().as_str()) {
        return Some(told("no number").at(span, "the program that wrote this had no number here"));
    }
    if matches!(name, "O" | "o") {
        let told = told("a letter, and no number").at(span, "is the digit `0` meant?");
        return Some(told.fix(span, "0"));
    }
    let (_, number) = NUMBERS.iter().find(|(word, _)| *word == name)?;
    Some(
        Diagnostic::new(Code::UndeclaredName, format!("`{name}` is not declared"))
            .at(span, "numbers are written with digits")
            .help(format!("write `{number}`"))
            .fix(span, *number),
    )
}
