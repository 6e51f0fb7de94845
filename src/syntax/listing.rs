//! Blanks the line numbers of a listing, and settings of an `.ini` file before the scene.
//!
//! **In:** a text without comments. **Out:** the same text with blanks in their place. **Invariant:** a text
//! without any is not copied; one diagnostic for all numbers, and one for all settings.

use std::borrow::Cow;
use std::ops::Range;

use super::blank::blanked;
use crate::diagnostic::{Code, Diagnostic, Diagnostics};
use crate::source::{FileId, Span};

/// The fewest consecutive numbered lines that form a listing.
const FEWEST_LINES: usize = 3;

/// The most frequent names of `.ini` settings, in lower case.
const SETTINGS: &[&str] = &[
    "all_console",
    "antialias",
    "antialias_depth",
    "antialias_threshold",
    "clock",
    "cyclic_animation",
    "display",
    "final_clock",
    "final_frame",
    "height",
    "initial_clock",
    "initial_frame",
    "input_file_name",
    "jitter",
    "library_path",
    "output_alpha",
    "output_file_name",
    "output_file_type",
    "output_to_file",
    "pause_when_done",
    "quality",
    "sampling_method",
    "verbose",
    "width",
    "work_threads",
];

pub(super) fn blank<'a>(
    text: Cow<'a, str>,
    file: FileId,
    diagnostics: &mut Diagnostics,
) -> Cow<'a, str> {
    let span = |range: &Range<usize>| Span::new(file, range.start, range.end);
    let numbers = numbers(&text);
    if let Some(first) = numbers.first() {
        let told =
            Diagnostic::new(Code::UnexpectedCharacter, "the lines of this scene are numbered")
                .at(span(first), "a line's number is no part of the scene")
                .help("take the numbers away: they come from a listing");
        diagnostics.push(numbers.iter().fold(told, |told, number| told.fix(span(number), "")));
    }
    let settings = settings(&text);
    if let Some(first) = settings.first() {
        let message = "settings of an `.ini` file stand before this scene";
        let told = Diagnostic::new(Code::UnexpectedCharacter, message)
            .at(span(first), "this is no part of a scene")
            .help("how large a picture is and the like is said where it is rendered: `--size 640x480`");
        let before = |line: &Range<usize>| Span::new(file, line.start, line.start);
        diagnostics.push(settings.iter().fold(told, |told, line| told.fix(before(line), "// ")));
    }
    if numbers.is_empty() && settings.is_empty() {
        return text;
    }
    blanked(text, numbers.into_iter().chain(settings))
}

/// Returns each line without the blanks around it.
fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let mut start = 0;
    text.split_inclusive('\n').map(move |line| {
        let at = start + (line.len() - line.trim_start().len());
        start += line.len();
        (at, line.trim())
    })
}

/// Returns the numbers before all lines, each one more than the last; nothing if they may be data.
fn numbers(text: &str) -> Vec<Range<usize>> {
    let (mut found, mut words, mut first) = (Vec::new(), 0, None);
    for (index, (at, line)) in lines(text).enumerate().filter(|(_, (_, line))| !line.is_empty()) {
        let digits = line.len() - line.trim_start_matches(|c: char| c.is_ascii_digit()).len();
        let sign = usize::from(line[digits..].starts_with([':', '|']));
        let rest = &line[digits + sign..];
        let Some(number) = line[..digits].parse::<usize>().ok() else { return Vec::new() };
        let expected = *first.get_or_insert(number.wrapping_sub(index));
        if number.wrapping_sub(index) != expected
            || !(rest.is_empty() || rest.starts_with([' ', '\t']))
        {
            return Vec::new();
        }
        let begins = |c: char| c.is_ascii_alphabetic() || matches!(c, '#' | '}');
        words += usize::from(rest.trim_start().starts_with(begins));
        found.push(at..at + digits + sign);
    }
    if found.len() < FEWEST_LINES || 2 * words < found.len() { Vec::new() } else { found }
}

/// Returns the lines of settings before everything else, with the comments among them.
fn settings(text: &str) -> Vec<Range<usize>> {
    let is_setting = |line: &str| {
        let name = line.split_once('=').map_or("", |(name, _)| name.trim()).to_lowercase();
        SETTINGS.contains(&name.as_str()) && !line.ends_with(';')
    };
    let is_other =
        |line: &str| line.starts_with(';') || line.starts_with('[') && line.ends_with(']');
    let head = lines(text).take_while(|(_, l)| l.is_empty() || is_setting(l) || is_other(l));
    let head: Vec<_> = head.filter(|(_, line)| !line.is_empty()).collect();
    if !head.iter().any(|(_, line)| is_setting(line)) {
        return Vec::new();
    }
    head.into_iter().map(|(at, line)| at..at + line.len()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_numbers_of_a_listing_are_told_from_data() {
        let found = |text: &str| numbers(text).len();
        assert_eq!(found("1 #version 3.7;\n2 camera { }\n\n4 sphere { 0, 1 }\n"), 3);
        assert_eq!(found("10: camera {\n11: }\n12: plane { y, 0 }"), 3);
        assert_eq!(found("1 2 3\n2 3 4\n3 4 5\n"), 0);
        assert_eq!(found("1, <0, 1>,\n2, <0, 2>,\n3, <1, 1>\n"), 0);
        assert_eq!(found("1 camera { }\n2 sphere { }\n4 box { }\n"), 0);
        assert_eq!(found("camera { }\n2 sphere { }\n"), 0);
    }

    #[test]
    fn settings_stand_before_all_else() {
        let found = |text: &str| settings(text).len();
        assert_eq!(found("; made so\nWidth=640\nHeight = 480\nsphere { 0, 1 }\n"), 3);
        assert_eq!(found("sphere { 0, 1 }\nWidth=640\n"), 0);
        assert_eq!(found("; a comment\nsphere { 0, 1 }\n"), 0);
        assert_eq!(found("Width = 640;\n"), 0);
    }
}
