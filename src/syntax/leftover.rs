//! Blanks lines left by other programs: Markdown code fences, merge conflict markers, diff signs.
//!
//! **In:** a text without comments. **Out:** the same text with blanks in their place; in a conflict, the
//! second version is blanked with the markers. **Invariant:** a text without any is not copied; one
//! diagnostic for each conflict, and one for all fences.

use std::borrow::Cow;
use std::ops::Range;

use super::blank::blanked;
use crate::diagnostic::{Code, Diagnostic, Diagnostics};
use crate::source::{FileId, Span};
use crate::vocabulary::{Family, Role, Word};

const FENCE: &str = "```";
const OURS: &str = "<<<<<<< ";
const MIDDLE: &str = "=======";
const THEIRS: &str = ">>>>>>> ";

pub(super) fn blank<'a>(
    text: Cow<'a, str>,
    file: FileId,
    diagnostics: &mut Diagnostics,
) -> Cow<'a, str> {
    let is_left =
        |line: &str| change(line).is_some() || line.starts_with(FENCE) || line.starts_with(OURS);
    if !text.lines().any(is_left) {
        return text;
    }
    let span = |range: &Range<usize>| Span::new(file, range.start, range.end);
    let (mut fences, mut gone, mut conflict) = (Vec::new(), Vec::new(), Vec::new());
    let mut signs: Vec<Range<usize>> = Vec::new();
    let mut start = 0;
    for line in text.split_inclusive('\n') {
        let range = start..start + line.trim_end().len();
        start += line.len();
        match change(line) {
            Some('+') => signs.push(range.start..range.start + 1),
            // The diff removed the line before it.
            Some(_) => signs.push(range.clone()),
            None => {}
        }
        if line.starts_with(FENCE) {
            fences.push(range);
        } else if line.starts_with(OURS) {
            conflict = vec![range];
        } else if line.trim_end() == MIDDLE && conflict.len() == 1 {
            conflict.push(range);
        } else if line.starts_with(THEIRS)
            && let [ours, middle] = conflict.as_slice()
        {
            let message = "two versions of these lines stand in the file";
            let diagnostic = Diagnostic::new(Code::UnexpectedCharacter, message)
                .at(span(ours), "a conflict that was left as it is; the first version begins here")
                .also(span(middle), "the second one begins here")
                .also(span(&range), "and ends here")
                .help("keep one of the two, and take the three marks out");
            diagnostics.push(diagnostic);
            gone.extend([ours.clone(), middle.start..range.end]);
            conflict.clear();
        }
    }
    if let Some(first) = signs.first() {
        let sign = Span::new(file, first.start, first.start + 1);
        let message = "the signs of a list of changes (a diff) stand in the file";
        let diagnostic = Diagnostic::new(Code::UnexpectedCharacter, message)
            .at(
                sign,
                "a `+` at the beginning of a line that was added, a `-` of one that was taken out",
            )
            .help("leave the signs out, and the lines with a `-`");
        let diagnostic = signs.iter().fold(diagnostic, |d, sign| d.fix(span(sign), ""));
        diagnostics.push(diagnostic);
    }
    gone.append(&mut signs);
    if let Some(first) = fences.first() {
        let message = "this is a mark of Markdown, not of the language";
        let diagnostic = Diagnostic::new(Code::UnexpectedCharacter, message)
            .at(span(first), "it stands around code in a text")
            .help("leave the line out");
        let diagnostic = fences.iter().fold(diagnostic, |d, fence| d.fix(span(fence), ""));
        diagnostics.push(diagnostic);
    }
    gone.append(&mut fences);
    blanked(text, gone)
}

/// Returns the diff sign at the beginning of a line, if it is followed by something that is not a value.
fn change(line: &str) -> Option<char> {
    let sign = line.chars().next().filter(|sign| "+-".contains(*sign))?;
    let rest = line[1..].trim_start();
    let word =
        &rest[..rest.find(|c: char| !c.is_ascii_alphanumeric() && c != '_').unwrap_or(rest.len())];
    let begins = Word::from_name(word).is_some_and(|word| {
        word.role() == Role::Statement
            && (matches!(
                word.family(),
                Family::Shape | Family::Csg | Family::Camera | Family::Texture
            ) || word.family() == Family::Transform
                || matches!(word, Word::Object | Word::LightSource | Word::Background))
    });
    let directive = rest.strip_prefix('#').is_some_and(|word| {
        word.starts_with("declare") || word.starts_with("include") || word.starts_with("local")
    });
    (begins || directive).then_some(sign)
}
